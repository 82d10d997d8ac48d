//! Batches whose jobs would write the same file by a number or in a folder, and batches that fill the disk.

use crate::batch::{list, render};
use crate::program::{done, refused_in_one_line};
use crate::support::Folder;
use std::path::Path;

fn job(id: &str, command: &str, output: &str, more: &str) -> String {
    format!(r#"{{"id":"{id}","command":"{command}","model":"builtin:ant","output":"{output}"{more}}}"#)
}

#[test]
fn lists_whose_jobs_write_the_same_by_a_number_or_in_a_folder_are_refused_before_any_work() {
    let folder = Folder::new();
    let out = folder.path("out");
    let refuse = |jobs: &[String], words: &str| {
        let list = list(&folder, jobs);
        refused_in_one_line(&["batch", &list, "-o", &out], &[words]);
        assert!(!Path::new(&out).exists());
    };
    let turn = |id: &str, output: &str, count: u32| job(id, "render", output, &format!(r#","turntable":{count}"#));
    let one = |id: &str, output: &str| job(id, "render", output, "");
    refuse(
        &[turn("a", "a-%d.png", 3), one("b", "./a-1.png")],
        "line 2: output: ./a-1.png would also be written by line 1, as a-%d.png; name another",
    );
    refuse(
        &[one("b", "a-3.png"), one("c", "c.png"), turn("a", "a-%d.png", 3)],
        "line 3: output: a-%d.png would also be written by line 1, as a-3.png; name another",
    );
    refuse(
        &[turn("a", "x/%02d.png", 12), turn("b", "x/1%d.png", 2)],
        "line 2: output: x/1%d.png would also be written by line 1, as x/%02d.png;",
    );
    refuse(
        &[turn("a", "%d0.png", 12), one("b", "110.png")],
        "line 2: output: 110.png would also be written by line 1, as %d0.png;",
    );
    // How many there will be only the model knows.
    refuse(&[job("a", "render", "a-%d.png", r#","animate":true"#), one("b", "a-99.png")], "line 2: output: a-99.png");
    refuse(
        &[job("a", "compare", "x/", ""), one("b", "x/left.png")],
        "line 2: output: x/left.png would also be written by line 1, as x/; name another",
    );
    refuse(
        &[one("b", "m/deep/a.png"), job("a", "measure", "m", "")],
        "line 2: output: m would also be written by line 1, as m/deep/a.png; name another",
    );
    refuse(
        &[job("a", "render", "a.png", r#","dump":"s""#), turn("b", "s/%d.png", 2)],
        "line 2: output: s/%d.png would also be written by line 1, as s;",
    );
    refuse(
        &[job("a", "measure", "m", ""), job("b", "measure", "m/n", "")],
        "line 2: output: m/n would also be written by line 1, as m;",
    );
}

#[test]
fn names_that_only_look_alike_are_no_reason_to_refuse() {
    let folder = Folder::new();
    let small = r#","size":16"#;
    let jobs = [
        job("turn", "render", "a-%d.png", r#","size":16,"turntable":3"#),
        job("next", "render", "a-4.png", small),
        job("padded", "render", "a-01.png", small),
        job("beside", "compare", "x/", r#","size":32,"frames":1"#),
        job("left", "render", "xleft.png", small),
        job("own", "render", "steps/a.png", r#","size":16,"dump":"steps""#),
    ];
    let out = folder.path("out");
    done(&["batch", &list(&folder, &jobs), "-o", &out, "--jobs", "1"]);
    for file in ["a-3.png", "a-4.png", "a-01.png", "x/sheet.png", "xleft.png", "steps/a.png"] {
        assert!(Path::new(&out).join(file).exists(), "{file}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_job_that_finds_the_disk_full_stops_the_batch_and_is_done_when_there_is_room() {
    let folder = Folder::new();
    // A picture takes four pages. Two pictures fit, besides the record, which still has room for all jobs.
    let ppm = |id: usize| render(&format!("p{id}"), "").replace(".png", ".ppm").replace("\"size\":32", "\"size\":64");
    let jobs: Vec<String> = (0..12).map(ppm).collect();
    let list = list(&folder, &jobs);
    std::fs::create_dir(folder.path("out")).unwrap();
    let script = format!(
        "mount -t tmpfs -o size=48k none \"$D/out\"; code=0; \"$T\" batch {list} -o \"$D/out\" --jobs 1 2>\"$D/said\" || code=$?; \
         echo \"exit $code\"; ls \"$D/out\"; echo lines; cat \"$D/out/batch-1-of-1.jsonl\"; mount -o remount,size=1m \"$D/out\"; \
         \"$T\" batch {list} -o \"$D/out\" --jobs 1"
    );
    let Some(text) = crate::output::where_mounts_are_ours(&script, &folder.path("")) else { return };
    let said = std::fs::read_to_string(folder.path("said")).unwrap();
    let (listed, lines) = text.split_once("lines\n").unwrap();
    assert!(listed.starts_with("exit 2\n"), "{text}{said}");
    assert!(said.contains("p2: p2.ppm: the disk is full; free some space; then give the same command again"), "{said}");
    assert!(listed.contains("p1.ppm\n") && !listed.contains("p2.ppm"), "{listed}");
    assert!(lines.lines().count() == 2 && lines.lines().all(|line| line.contains("\"error\":null")), "{lines}");
}
