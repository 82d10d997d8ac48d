//! Killed batches, killed workers, changing folders: no job runs twice and none is lost. The tests kill after an observed event,
//! never by the clock.

#![cfg(target_os = "linux")]

use crate::batch::{list, render, rows};
use crate::program::{done, said, tinta};
use crate::support::Folder;
use std::collections::HashMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::SystemTime;

/// Small jobs of a list.
const JOBS: usize = 48;

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn has_ended(child: &Child) -> bool {
    std::fs::read_to_string(format!("/proc/{}/stat", child.id()))
        .unwrap()
        .rsplit(')')
        .next()
        .unwrap()
        .trim_start()
        .starts_with('Z')
}

/// Waits until so many are there, or the child has ended.
fn wait_for(child: &Child, count: usize, there: impl Fn() -> usize) {
    while there() < count && !has_ended(child) {
        std::thread::yield_now();
    }
    assert!(there() >= count, "{} of {count} are there", there());
}

/// The lines of a file.
fn lines(path: &str) -> usize {
    std::fs::read(path).map_or(0, |bytes| bytes.iter().filter(|byte| **byte == b'\n').count())
}

pub fn signal(name: &str, process: u32) {
    assert!(Command::new("kill").args(["-s", name, &process.to_string()]).status().unwrap().success());
}

/// The processes that a process has started.
fn children(process: u32) -> Vec<u32> {
    let tasks = std::fs::read_dir(format!("/proc/{process}/task")).unwrap();
    let texts = tasks.map(|task| std::fs::read_to_string(task.unwrap().path().join("children")).unwrap());
    texts.flat_map(|text| text.split_ascii_whitespace().map(|id| id.parse().unwrap()).collect::<Vec<u32>>()).collect()
}

/// When each of the pictures there was written.
fn written(folder: &str) -> HashMap<String, SystemTime> {
    let files = std::fs::read_dir(folder).into_iter().flatten().map(|file| file.unwrap());
    let pictures = files.filter(|file| file.path().extension().is_some_and(|extension| extension == "png"));
    pictures
        .map(|file| (file.file_name().into_string().unwrap(), file.metadata().unwrap().modified().unwrap()))
        .collect()
}

#[test]
fn a_killed_run_goes_on_and_does_nothing_twice() {
    let folder = Folder::new();
    let mut jobs: Vec<String> =
        (0..JOBS - 2).map(|view| render(&format!("v{view}"), &format!(r#","view":"{view},10""#))).collect();
    jobs.splice(..0, [render("told", r#","json":true"#), render("wrong", r#","tones":9"#)]);
    let list = list(&folder, &jobs);
    let (out, journal) = (folder.path("out"), folder.path("out/batch-1-of-1.jsonl"));
    let mut before = HashMap::new();
    let mut interrupted = 0;
    for name in ["KILL", "TERM", "KILL"] {
        let mut child = start(&["batch", &list, "-o", &out, "--jobs", "2"]);
        // It takes signals by then.
        wait_for(&child, (before.len() + 4).min(JOBS - 1), || written(&out).len());
        signal(name, child.id());
        let status = child.wait().unwrap();
        let now = written(&out);
        let is_interrupted = now.len() < JOBS - 1;
        if name == "TERM" && is_interrupted {
            // It finishes the current jobs, and says that some are left.
            assert_eq!(status.code(), Some(128 + 15), "{status}");
        }
        interrupted += usize::from(is_interrupted);
        assert!(before.iter().all(|(name, time)| now[name] == *time), "a picture was drawn twice");
        before = now;
        before.remove("told.png");
    }
    assert!(interrupted >= 1, "every signal came after the last job");
    // A torn line, as a kill may leave it.
    let text = std::fs::read_to_string(&journal).unwrap();
    std::fs::write(&journal, format!("{text}{}", &text[..40])).unwrap();
    let run = |list: &str| {
        let output = tinta(&["batch", list, "-o", &out, "--jobs", "2"]);
        assert_eq!(output.status.code(), Some(1), "{}", said(&output));
        said(&output)
    };
    assert!(run(&list).contains("were done before, 1 failed"));
    let after = written(&out);
    assert!(after.len() == JOBS - 1 && before.iter().all(|(name, time)| after[name] == *time));
    let entries = rows(&journal);
    assert!(entries.iter().all(|row| row["job"]["id"] == "told" || row["job"]["id"] == "wrong"), "{entries:?}");
    // A picture that is gone, one that is cut, one without an end, a line that is changed: these four and no others.
    std::fs::remove_file(folder.path("out/v3.png")).unwrap();
    std::fs::write(folder.path("out/v4.png"), b"cut").unwrap();
    let whole = std::fs::read(folder.path("out/v5.png")).unwrap();
    std::fs::write(folder.path("out/v5.png"), &whole[..whole.len() - 1]).unwrap();
    let changed: Vec<String> = jobs.iter().map(|job| job.replace(r#""6,10""#, r#""6,11""#)).collect();
    let changed = folder.file("changed.jsonl", changed.join("\n").as_bytes());
    let text = run(&changed);
    assert!(text.contains(&format!("tinta: 4 of {JOBS} jobs done, {} were done before, 1 failed", JOBS - 5)), "{text}");
    assert!(std::fs::read(folder.path("out/v5.png")).unwrap() == whole);
}

#[test]
fn models_and_presets_that_have_changed_are_drawn_again() {
    let folder = Folder::new();
    let model = |name: &str, x: f32| folder.file(name, format!("v 0 0 0\nv {x} 0 0\nv 0 1 0\nf 1 2 3\n").as_bytes());
    let models = ["a.obj", "b.obj"].map(|name| model(name, 1.0));
    let preset = folder.file("mine.toml", b"tones = 2\n");
    let out = folder.path("out");
    let run = |more: &[&str]| {
        let [a, b] = &models;
        said(&done(&[&["batch", a, b, "-o", &out, "--size", "32", "--preset", &preset], more].concat()))
    };
    assert!(run(&[]).contains("2 of 2 jobs done, 0 failed"));
    assert!(run(&[]).contains("0 of 2 jobs done, 2 were done before"));
    // Written again with the same bytes, though newer.
    model("a.obj", 1.0);
    assert!(run(&[]).contains("0 of 2 jobs done, 2 were done before"));
    model("a.obj", 2.0);
    assert!(run(&[]).contains("1 of 2 jobs done, 1 were done before"));
    folder.file("mine.toml", b"tones = 3\n");
    assert!(run(&[]).contains("2 of 2 jobs done, 0 failed"));
    // An option that is taken out again, though drawing may choose it, too.
    for more in [["--view", "top"], ["--light", "tone-light=0,1,0.3"]] {
        assert!(run(&more).contains("2 of 2 jobs done, 0 failed"), "{more:?}");
        assert!(run(&[]).contains("2 of 2 jobs done, 0 failed"), "{more:?}");
        assert!(run(&[]).contains("0 of 2 jobs done, 2 were done before"), "{more:?}");
    }
}

/// Runs three jobs, kills the worker of the second after the first, and calls `then` with the run; the journal's rows: names, states, tries.
fn killed(
    turntable: usize,
    then: impl Fn(&std::process::Child, &str),
) -> (std::process::Output, Vec<(String, String, u64)>, Folder) {
    let folder = Folder::new();
    let long = format!(
        r#"{{"id":"long","command":"render","model":"builtin:bust","output":"long.gif","size":256,"turntable":{turntable}}}"#
    );
    // The journal records printed text.
    let jobs = [render("before", r#","json":true"#), long, render("after", r#","json":true"#)];
    let (out, journal) = (folder.path("out"), folder.path("out/batch-1-of-1.jsonl"));
    let child = start(&["batch", &list(&folder, &jobs), "-o", &out, "--jobs", "1"]);
    wait_for(&child, 1, || lines(&journal));
    let workers = children(child.id());
    assert_eq!(workers.len(), 1);
    signal("KILL", workers[0]);
    then(&child, &journal);
    let output = child.wait_with_output().unwrap();
    let rows = rows(&journal);
    let state = |row: &serde_json::Value| if row["error"].is_null() { "done" } else { "failed" }.to_owned();
    let id = |row: &serde_json::Value| row["job"]["id"].as_str().unwrap().to_owned();
    let states = rows.iter().map(|row| (id(row), state(row), row["tries"].as_u64().unwrap()));
    (output, states.collect(), folder)
}

fn as_named(states: &[(String, String, u64)]) -> Vec<(&str, &str, u64)> {
    states.iter().map(|(id, status, tries)| (id.as_str(), status.as_str(), *tries)).collect()
}

#[test]
fn a_worker_that_is_killed_once_has_its_job_done_again_at_the_end() {
    let (output, states, folder) = killed(150, |_, _| {});
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(as_named(&states), [("before", "done", 1), ("after", "done", 1), ("long", "done", 2)]);
    assert!(Path::new(&folder.path("out/long.gif")).exists());
}

#[test]
fn a_job_whose_worker_is_killed_again_fails_alone() {
    // It outlasts this test.
    let (output, states, folder) = killed(10_000, |child, journal| {
        wait_for(child, 2, || lines(journal));
        // The worker of the job that was last may still be there.
        while !has_ended(child) {
            for worker in children(child.id()) {
                let _ = Command::new("kill").args(["-s", "KILL", &worker.to_string()]).output();
            }
        }
    });
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("tinta: long: its worker process ended (signal 9)"), "{}", said(&output));
    assert_eq!(as_named(&states), [("before", "done", 1), ("after", "done", 1), ("long", "failed", 1)]);
    assert!(!Path::new(&folder.path("out/long.gif")).exists());
}

#[test]
fn workers_end_with_the_run_that_is_killed() {
    let folder = Folder::new();
    let endless = r#"{"id":"endless","command":"render","model":"builtin:bust","output":"endless.gif","size":1024,"turntable":10000}"#;
    let jobs = [render("before", ""), endless.to_owned()];
    let mut child = start(&["batch", &list(&folder, &jobs), "-o", &folder.path("out"), "--jobs", "1"]);
    wait_for(&child, 1, || written(&folder.path("out")).len());
    let worker = children(child.id())[0];
    signal("KILL", child.id());
    child.wait().unwrap();
    let is_alive = || {
        let stat = std::fs::read_to_string(format!("/proc/{worker}/stat"));
        stat.is_ok_and(|text| !text.rsplit(')').next().unwrap().trim_start().starts_with('Z'))
    };
    while is_alive() {
        std::thread::yield_now();
    }
}

#[test]
fn a_measurement_that_is_killed_goes_on_where_it_was() {
    let folder = Folder::new();
    let job = r#"{"id":"m","command":"measure","model":"builtin:open-box","output":"m","size":["32x32","40x40","48x48"],"styles":["phong","ink"],"frames":1}"#;
    let list = list(&folder, &[job.to_owned()]);
    let (out, rows_file) = (folder.path("out"), folder.path("out/m/results.jsonl"));
    let child = start(&["batch", &list, "-o", &out]);
    wait_for(&child, 1, || lines(&rows_file));
    signal("KILL", child.id());
    drop(child.wait_with_output());
    assert!(!Path::new(&folder.path("out/m/report.html")).exists(), "half a measurement has no report");
    let kept = std::fs::read_to_string(&rows_file).unwrap();
    done(&["batch", &list, "-o", &out]);
    let whole = std::fs::read_to_string(&rows_file).unwrap();
    let sound = &kept[..kept.rfind('\n').unwrap() + 1];
    assert!(whole.starts_with(sound) && whole.len() > sound.len(), "its first rows were not measured again");
    assert!(Path::new(&folder.path("out/m/report.html")).exists());
}

#[test]
fn a_merge_that_is_done_again_begins_anew() {
    let folder = Folder::new();
    let measure = r#"{"id":"m","command":"measure","model":"builtin:open-box","output":"m","size":["24x24"],"styles":["phong"],"frames":1}"#;
    let out = folder.path("out");
    done(&["batch", &list(&folder, &[measure.to_owned()]), "-o", &out]);
    let rows = folder.path("out/m/results.jsonl");
    let merge = format!(r#"{{"id":"both","command":"measure","merge":"{rows}","output":"both"}}"#);
    let (list, out) = (list(&folder, &[merge]), folder.path("merged"));
    done(&["batch", &list, "-o", &out]);
    // As if it had been killed before it was recorded.
    std::fs::remove_file(folder.path("merged/batch-1-of-1.jsonl")).unwrap();
    done(&["batch", &list, "-o", &out]);
    let [first, again] = [rows, folder.path("merged/both/results.jsonl")].map(|rows| std::fs::read(rows).unwrap());
    assert!(first == again && Path::new(&folder.path("merged/both/report.html")).exists());
}
