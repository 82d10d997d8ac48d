//! Batches end to end: the same pictures as the command line's, failures written down, slices that make one folder.

use crate::program::{done, refused_in_one_line, said, tinta};
use crate::support::{Folder, backend_names, names};
use serde_json::Value;
use std::path::Path;

/// Writes a list and gives its path.
pub fn list(folder: &Folder, jobs: &[String]) -> String {
    folder.file("jobs.jsonl", (jobs.join("\n") + "\n").as_bytes())
}

/// A small render of a built-in model into `ID.png`, with further keys.
pub fn render(id: &str, more: &str) -> String {
    format!(r#"{{"id":"{id}","command":"render","model":"builtin:open-box","output":"{id}.png","size":32{more}}}"#)
}

/// The lines of a file of JSON.
pub fn rows(path: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_jobs_options_are_those_of_the_command_line_and_its_pictures_too() {
    let folder = Folder::new();
    let preset = folder.file("mine.toml", b"tones = 2\n");
    let [_, second] = backend_names();
    let by_second = format!(r#","backend":"{second}","style":"ink""#);
    let pairs: [(&str, &str, &[&str]); 6] = [
        ("plain", "", &[]),
        (
            "numbers",
            r#","fov":25.5,"tone-levels":[0.4,0.6,0.8],"view":"-20,30""#,
            &["--fov", "25.5", "--tones", "tone-levels=0.4,0.6,0.8", "--view=-20,30"],
        ),
        (
            "switches",
            r#","parallel":true,"background":"transparent","full":false"#,
            &["--parallel", "--background", "transparent"],
        ),
        (
            "styles",
            r#","style":"inking","joints":false,"silhouette":"exact""#,
            &["--style", "inking", "--joints", "off", "--silhouette", "exact"],
        ),
        ("second", &by_second, &["--backend", second, "--style", "ink"]),
        ("preset", &format!(r#","preset":"{preset}""#), &["--preset", &preset]),
    ];
    let jobs: Vec<String> = pairs.iter().map(|(id, more, _)| render(id, more)).collect();
    let out = folder.path("out");
    let output = done(&["batch", &list(&folder, &jobs), "-o", &out, "--jobs", "2"]);
    assert!(output.stdout.is_empty());
    for (id, _, options) in pairs {
        let alone = folder.path("alone.png");
        let mut words = vec!["render", "builtin:open-box", "-o", &alone, "--size", "32"];
        words.extend(options);
        done(&words);
        let (alone, job) = (std::fs::read(&alone).unwrap(), std::fs::read(format!("{out}/{id}.png")).unwrap());
        assert!(alone == job, "{id}: {} and {} bytes", alone.len(), job.len());
    }
    // Each picture has its recipe, so the folder has no journal.
    assert_eq!(names(&out).len(), pairs.len());
    let recipe = tinta::Recipe::read(Path::new(&format!("{out}/second.png"))).unwrap();
    assert_eq!(recipe.gl.unwrap().backend, second);
    let again = done(&["batch", &folder.path("jobs.jsonl"), "-o", &out]);
    assert!(said(&again).contains("tinta: 0 of 6 jobs done, 6 were done before, 0 failed"), "{}", said(&again));
}

#[test]
fn every_command_is_done_and_every_failure_is_written_down_and_stops_nothing() {
    let folder = Folder::new();
    let jobs = [
        render("first", r#","json":true,"dump":"steps","save-preset":"kept/a.toml""#),
        render("bad-value", r#","tones":9"#),
        render("two-ways", r#","eye":"1,2,3","view":"front""#),
        render("no-text", r#","json":"yes""#),
        render("two-presets", r#","preset":["a.toml","b.toml"]"#),
        r#"{"id":"no-model","command":"render","model":"no-such.obj","output":"no.png"}"#.to_owned(),
        r#"{"id":"nul","command":"render","model":"a\u0000b.obj","output":"nul.png"}"#.to_owned(),
        r#"{"id":"none","command":"render","output":"none.png"}"#.to_owned(),
        r#"{"id":"out","command":"render","model":"builtin:ant","output":"../out.png"}"#.to_owned(),
        r#"{"id":"root","command":"render","model":"builtin:ant","output":"/tmp/tinta-root.png"}"#.to_owned(),
        r#"{"id":"own","command":"render","model":"builtin:ant","output":"batch-1-of-1.jsonl"}"#.to_owned(),
        r#"{"model":"builtin:ant","output":"deep/er/lines.svg","size":64}"#.to_owned(),
        r#"{"id":"turn","command":"render","model":"builtin:open-box","output":"turn/%02d.png","size":24,"turntable":3}"#.to_owned(),
        r#"{"id":"both","command":"compare","model":["builtin:open-box"],"output":"both/","size":32,"frames":1}"#.to_owned(),
        r#"{"id":"row","command":"measure","model":"builtin:open-box","output":"row","size":["24x24"],"styles":["phong"],"frames":1}"#.to_owned(),
    ];
    let out = folder.path("out");
    let output = tinta(&["batch", &list(&folder, &jobs), "-o", &out, "--jobs", "1"]);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("tinta: 5 of 15 jobs done, 10 failed"), "{}", said(&output));
    let entries = rows(&format!("{out}/batch-1-of-1.jsonl"));
    let find = |id: &str| entries.iter().find(|entry| entry["job"]["id"] == id);
    let of = |id: &str| find(id).unwrap_or_else(|| panic!("{id}"));
    for (id, kind, words) in [
        ("bad-value", "setting", "tones 9: there are 1, 2 or 3 tones"),
        ("two-ways", "setting", "eye and view: they exclude each other"),
        ("no-text", "setting", "json: write true or false"),
        ("two-presets", "setting", "preset: write one name, as a text"),
        ("no-model", "model", "no-such.obj: there is no such file"),
        ("nul", "model", "a\\u{0}b.obj"),
        ("none", "setting", "model: it is missing"),
        ("out", "setting", "output: ../out.png: a job writes in the batch's folder"),
        ("root", "setting", "output: /tmp/tinta-root.png: a job writes"),
        ("own", "setting", "output: batch-1-of-1.jsonl: the batch's own files"),
    ] {
        let error = &of(id)["error"];
        assert_eq!(error["kind"].as_str(), Some(kind), "{id}: {error}");
        assert!(error["problem"].as_str().unwrap().contains(words), "{id}: {error}");
    }
    // The drawing has a recipe.
    assert_eq!(entries.len(), 14);
    for id in ["first", "turn", "both", "row"] {
        assert!(of(id)["error"].is_null(), "{id}: {}", of(id)["error"]);
    }
    assert!(of("first")["printed"].as_str().unwrap().contains("\"first_frame_ms\""));
    for file in [
        "first.png",
        "kept/a.toml",
        "steps",
        "deep/er/lines.svg",
        "turn/03.png",
        "both/sheet.png",
        "both/lines.png",
        "row/report.html",
        "row/results.csv",
        "row/results.jsonl",
    ] {
        assert!(Path::new(&format!("{out}/{file}")).exists(), "{file}");
    }
    let again = tinta(&["batch", &folder.path("jobs.jsonl"), "-o", &out, "--jobs", "1"]);
    assert!(said(&again).contains("tinta: 0 of 15 jobs done, 5 were done before, 10 failed"), "{}", said(&again));
    let page = std::fs::read_to_string(format!("{out}/row/report.html")).unwrap();
    assert!(
        page.contains("measure --frames=1 --output=") && !page.contains(".tinta-"),
        "the command that measures it again"
    );
    let left = names(&out);
    assert!(left.iter().all(|name| !name.starts_with('.')), "nothing is left in the making: {left:?}");
    assert!(!Path::new("/tmp/tinta-root.png").exists() && !Path::new(&folder.path("out.png")).exists());
}

#[test]
fn names_of_options_are_checked_before_the_first_job_and_several_faults_named_at_once() {
    let folder = Folder::new();
    let jobs = [
        render("good", ""),
        render("one", r#","sice":24"#),
        render("again", r#","sice":32"#),
        render("two", r#","help":true"#),
        render("three", r#","kolor":"red""#),
    ];
    let out = folder.path("out");
    let output = tinta(&["batch", &list(&folder, &jobs), "-o", &out]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    let text = said(&output);
    assert!(text.contains("line 2: sice: there is no such option; did you mean size?"), "{text}");
    assert!(text.contains("; line 4: help: there is no such option") && text.contains("; line 5: kolor: "), "{text}");
    assert!(!text.contains("line 3") && text.lines().count() == 1, "{text}");
    assert!(!Path::new(&out).exists(), "nothing was begun");
}

#[test]
fn slices_of_eight_make_the_folder_that_one_run_makes() {
    let folder = Folder::new();
    let mut jobs: Vec<String> =
        (0..11).map(|view| render(&format!("v{view}"), &format!(r#","view":"{view},10""#))).collect();
    jobs.push(render("wrong", r#","tones":9"#));
    jobs.push(render("turn", r#","turntable":3"#).replace("turn.png", "turn.gif"));
    let list = list(&folder, &jobs);
    let (one, eight) = (folder.path("one"), folder.path("eight"));
    let summary = |folder: &str| tinta(&["batch", &list, "-o", folder, "--summary"]);
    assert_eq!(tinta(&["batch", &list, "-o", &one]).status.code(), Some(1));
    for number in 1..=8 {
        let output = tinta(&["batch", &list, "-o", &eight, "--slice", &format!("{number}/8"), "--jobs", "1"]);
        assert_eq!(output.status.code(), Some(if number == 4 { 1 } else { 0 }), "{number}: {}", said(&output));
        let summary = summary(&eight);
        assert_eq!(summary.status.code(), Some(1), "something is missing or failed");
        let text = String::from_utf8(summary.stdout).unwrap();
        let ended = (0..13).filter(|place| place % 8 < number).count();
        let done = ended - usize::from(number >= 4);
        let counts = format!("13 jobs: {done} done, {} failed, {} missing\n", ended - done, 13 - ended);
        assert!(text.starts_with(&counts), "{number}: {text}");
    }
    let said = String::from_utf8(summary(&one).stdout).unwrap();
    assert_eq!(said, "13 jobs: 12 done, 1 failed, 0 missing\nfailed: wrong: tones 9: there are 1, 2 or 3 tones\n");
    assert_eq!(said.as_bytes(), summary(&eight).stdout);
    let pictures = |folder: &str| -> Vec<String> {
        names(folder).into_iter().filter(|name| !name.starts_with("batch-")).collect()
    };
    assert_eq!(pictures(&one), pictures(&eight));
    for name in pictures(&one) {
        let read = |folder: &str| std::fs::read(format!("{folder}/{name}")).unwrap();
        assert!(read(&one) == read(&eight), "{name}");
    }
    // A slice of another number finds what these have done.
    let output = done(&["batch", &list, "-o", &eight, "--slice", "1/3"]);
    assert!(crate::program::said(&output).contains("0 of 5 jobs done, 5 were done before"));
}

#[test]
fn lists_and_folders_that_are_wrong_are_refused_before_any_work() {
    let folder = Folder::new();
    let out = folder.path("out");
    let refuse = |text: &[u8], words: &[&str]| {
        let list = folder.file("wrong.jsonl", text);
        refused_in_one_line(&["batch", &list, "-o", &out], words);
        assert!(!Path::new(&out).exists());
    };
    let (a, b) = (render("a", ""), render("b", ""));
    refuse(b"", &["wrong.jsonl: it holds no job"]);
    refuse(format!("{a}\n{b}\nnonsense").as_bytes(), &["wrong.jsonl: line 3: this is not a job"]);
    refuse(
        format!("{a}\n\n{a}").as_bytes(),
        &["wrong.jsonl: line 3: output: a.png would also be written by line 1, as a.png; name another"],
    );
    refuse(br#"{"output":"a.png","command":"view"}"#, &["line 1: command: choose one of render, compare, measure"]);
    refuse(br#"{"model":"a.obj"}"#, &["line 1: it has no output; name the file to write"]);
    refuse(&[b"{\"id\":\"a\",\"x\":".as_slice(), &[b'['; 60_000]].concat(), &["line 1: this is not a job"]);
    refuse(&[0, 255, 10, 7], &["line 1: "]);
    refused_in_one_line(&["batch", "no-such.jsonl", "-o", &out], &["no-such.jsonl: there is no such file"]);
    refused_in_one_line(&["batch", "nothing*.stl", "-o", &out], &["nothing*.stl: there is no such file"]);
    assert!(!Path::new(&out).exists());
    for slice in ["0/8", "9/8", "x"] {
        refused_in_one_line(&["batch", "jobs.jsonl", "-o", &out, "--slice", slice], &["--slice"]);
    }
    // Where one run is at work, or a file lies.
    let list = list(&folder, &[a, b]);
    refused_in_one_line(&["batch", &list, "-o", &folder.path("wrong.jsonl")], &["this is a file; name a folder"]);
    refused_in_one_line(&["batch", &list, "-o", "pics/{name}.png"], &["a list names its files", "-o DIR"]);
    refused_in_one_line(
        &["batch", &list, "-o", &out, "--look", "sketch"],
        &["a list names its files and the options of its drawings"],
    );
    refused_in_one_line(&["batch", &list, "a.obj", "-o", &out], &["jobs.jsonl: this is no model;", "one list of jobs"]);
}
