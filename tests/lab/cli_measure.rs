//! `tinta measure` as a user meets it.

use crate::program::{answer, done, refused_in_one_line, tinta};
use crate::support::Folder;
use tinta_lab::measure::Row;

/// A run small enough for a test.
fn run(folder: &str, more: &[&str]) -> std::process::Output {
    let base = [
        "measure",
        "builtin:open-box",
        "-o",
        folder,
        "--quick",
        "--size",
        "64",
        "--frames",
        "2",
        "--tolerance",
        "1/32",
    ];
    tinta(&[&base[..], more].concat())
}

fn rows(folder: &str) -> Vec<Row> {
    let text = std::fs::read_to_string(format!("{folder}/results.jsonl")).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_run_leaves_rows_a_table_plots_and_a_page() {
    let folder = Folder::new();
    let out = folder.path("a/new folder");
    let output = run(&out, &[]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("about"), "it says how long it will take: {said}");
    assert!(said.contains("--style sand is left out"), "an open box has no texture: {said}");
    for name in ["results.csv", "plot-lines.svg", "plot-tones.svg", "report.html"] {
        assert!(std::fs::metadata(format!("{out}/{name}")).unwrap().len() > 200, "{name}");
    }
    let rows = rows(&out);
    let style = |name: &str| rows.iter().find(|row| row.style == name && row.is_faithful).unwrap();
    for row in &rows {
        assert_eq!((row.size, row.time.frames_ms.len()), ([64, 64], 2));
        assert!(row.time.median_ms > 0.0 && row.time.passes.is_empty() == ["print", "lines"].contains(&&*row.style));
        assert_eq!(row.time.processor_ms.len(), 2);
        // Each row can be quoted.
        assert!(row.conditions.date.len() == 10 && !row.gl_version.is_empty(), "{:?}", row.conditions);
    }
    let own: Vec<&str> = rows.iter().filter(|row| row.has_own_reference).map(|row| row.style.as_str()).collect();
    assert!(own.contains(&"print") && own.contains(&"inking") && !own.contains(&"ink"), "{own:?}");
    let print = rows.iter().find(|row| row.style == "print").unwrap();
    let ceiling = rows.iter().find(|row| row.style == "lines").unwrap();
    assert_eq!(ceiling.options, "--style lines --crease-angle 66.42182 --min-length 0");
    assert!(print.is_pruned && print.lines.as_ref().unwrap().f1 > 0.98, "{:?}", print.lines);
    assert!(style("phong").lines.is_none() && style("charcoal").lines.is_none());
    assert!(style("three-pass").tones.is_some() && style("inking").tones.is_none());
    assert!(style("inking").time.edges_ms > 0.0 && style("three-pass").time.edges_ms == 0.0);
    let exact = rows.iter().find(|row| row.options == "--style inking --silhouette exact").unwrap();
    assert!(exact.lines.as_ref().unwrap().f1 > 0.95);
    assert!(std::path::Path::new(&format!("{out}/errors/builtin-open-box-64x64-three-pass.png")).is_file());
}

#[test]
fn a_style_has_one_f1_in_measure_and_judge_and_the_exact_lines_are_the_ceiling_of_every_size() {
    let folder = Folder::new();
    let out = folder.path("sizes");
    let measure = ["measure", "builtin:open-box", "-o", &out, "--quick", "--frames", "1", "--size", "64,128"];
    done(&[&measure[..], &["--styles", "three-pass,inking"]].concat());
    let f1 = |row: &Row| row.lines.as_ref().unwrap().f1;
    for side in [64, 128] {
        let rows: Vec<Row> = rows(&out).into_iter().filter(|row| row.size == [side; 2]).collect();
        let ceiling = rows.iter().find(|row| row.style == "lines").unwrap();
        assert!(f1(ceiling) > 0.9, "{side}: {}", f1(ceiling));
        for row in rows.iter().filter(|row| row.is_faithful) {
            let path = folder.path("drawing.png");
            let (style, size) = (format!("--style={}", row.style), side.to_string());
            done(&["render", "builtin:open-box", "-o", &path, &style, "--show", "borders", "--size", &size]);
            let judged = answer(&["judge", &path, "--model", "builtin:open-box", "--json"]);
            let judged = judged["lines"]["f1"].as_f64().unwrap();
            assert!((judged - f1(row)).abs() < 1e-9, "{} at {side}: {judged} and {}", row.style, f1(row));
            assert!(f1(row) <= f1(ceiling) + 0.01, "{} at {side}: {}, exact {}", row.style, f1(row), f1(ceiling));
        }
    }
    let plot = std::fs::read_to_string(format!("{out}/plot-lines.svg")).unwrap();
    assert!(plot.contains("ceiling: the exact lines themselves"));
}

#[test]
fn an_interrupted_run_goes_on_and_a_finished_one_is_not_overwritten() {
    let folder = Folder::new();
    let out = folder.path("run");
    assert_eq!(run(&out, &["--styles", "three-pass"]).status.code(), Some(0));
    let first = rows(&out);
    refused_in_one_line(
        &["measure", "builtin:open-box", "-o", &out, "--quick", "--size", "64"],
        &["results.jsonl", "--resume"],
    );
    // As after an interruption: a whole row, and half of the next.
    let path = format!("{out}/results.jsonl");
    let text = std::fs::read_to_string(&path).unwrap();
    let first_line = text.lines().next().unwrap();
    std::fs::write(&path, format!("{first_line}\n{}", &first_line[..first_line.len() / 2])).unwrap();
    assert_eq!(run(&out, &["--styles", "three-pass", "--resume"]).status.code(), Some(0));
    let resumed = rows(&out);
    assert_eq!(resumed.len(), first.len());
    assert_eq!(resumed[0], first[0], "a row that was there is not measured again");
    // Another yardstick would mix rows that cannot be compared; another view is another row.
    refused_in_one_line(
        &["measure", "builtin:open-box", "-o", &out, "--size", "64", "--frames", "3", "--resume"],
        &["2 frames", "--tolerance"],
    );
    assert_eq!(
        run(&out, &["--styles", "dietrich", "--resume", "--view", "front", "--parallel"]).status.code(),
        Some(0)
    );
    let last = rows(&out).pop().unwrap();
    assert_eq!(last.options, "--style dietrich --parallel --view=front");
}

#[test]
fn runs_of_two_machines_are_put_together() {
    let folder = Folder::new();
    let [left, right, both] = ["left", "right", "both"].map(|name| folder.path(name));
    for (out, machine) in [(&left, "this one"), (&right, "that one")] {
        assert_eq!(run(out, &["--styles", "dietrich", "--machine", machine]).status.code(), Some(0));
    }
    let files = [&left, &right].map(|out| format!("{out}/results.jsonl"));
    done(&["measure", "--merge", &files[0], &files[1], "-o", &both]);
    let page = std::fs::read_to_string(format!("{both}/report.html")).unwrap();
    assert!(page.contains("this one") && page.contains("that one"));
    let table = std::fs::read_to_string(format!("{both}/results.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + rows(&left).len() + rows(&right).len());
    assert_eq!(rows(&both).len(), rows(&left).len() + rows(&right).len());
    refused_in_one_line(&["measure", "--merge", &files[0], "-o", &both], &["results.jsonl", "another folder"]);
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let folder = Folder::new();
    let out = folder.path("out");
    let file = folder.path("file");
    std::fs::write(&file, "text\n").unwrap();
    for (arguments, words) in [
        (&["measure", "-o", &out][..], &["a model is missing"][..]),
        (&["measure", "no-such.obj", "-o", &out], &["no-such.obj"]),
        (&["measure", "builtin:gear", "-o", &file], &["file", "name a folder"]),
        (&["measure", "builtin:gear", "-o", &out, "--tolerance", "0"], &["'0' for '--tolerance"]),
        (&["measure", "builtin:gear", "-o", &out, "--tolerance", "nan"], &["--tolerance"]),
        (&["measure", "builtin:gear", "-o", &out, "--styles", "oil"], &["oil", "three-pass"]),
        (&["measure", "builtin:gear", "-o", &out, "--size", "0x0"], &["0x0"]),
        (&["measure", "--suite", "everything", "-o", &out], &["everything", "papers"]),
        (&["measure", "--merge", &file, "-o", &out], &["file", "line 1"]),
        (&["measure", "--merge", "no-such.jsonl", "-o", &out], &["no-such.jsonl"]),
        (&["measure", "--merge", "/dev/null", "-o", &out], &["/dev/null", "not a regular file"]),
        (&["measure", "builtin:gear", "--merge", &file, "-o", &out], &["--merge"]),
    ] {
        refused_in_one_line(arguments, words);
    }
    // Without a drawing, no file is left that a second try would have to respect.
    for _ in 0..2 {
        let output = tinta(&["measure", "builtin:gear", "--styles", "sand", "-o", &folder.path("sand")]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.lines().last().is_some_and(|line| line.contains("none of these settings can be drawn")), "{said}");
    }
}
