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

/// Waits until so many lines are in a file, or the child has ended.
fn wait_for_lines(child: &Child, path: &str, count: usize) {
    let lines = || std::fs::read(path).map_or(0, |bytes| bytes.iter().filter(|byte| **byte == b'\n').count());
    while lines() < count && !has_ended(child) {
        std::thread::yield_now();
    }
    assert!(lines() >= count, "{path} has {} lines", lines());
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
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap());
    let pictures = files.filter(|file| file.path().extension().is_some_and(|extension| extension == "png"));
    pictures
        .map(|file| (file.file_name().into_string().unwrap(), file.metadata().unwrap().modified().unwrap()))
        .collect()
}

#[test]
fn a_killed_run_goes_on_and_does_nothing_twice() {
    let folder = Folder::new();
    let jobs: Vec<String> =
        (0..JOBS).map(|view| render(&format!("v{view}"), &format!(r#","view":"{view},10""#))).collect();
    let list = list(&folder, &jobs);
    let (out, journal) = (folder.path("out"), folder.path("out/batch-1-of-1.jsonl"));
    let mut before = HashMap::new();
    let mut interrupted = 0;
    for (turn, name) in ["KILL", "TERM", "KILL"].into_iter().enumerate() {
        let resume: &[&str] = if turn == 0 { &[] } else { &["--resume"] };
        let known = std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
        let mut child = start(&[&["batch", &list, "-o", &out, "--jobs", "2"], resume].concat());
        // It takes signals by then.
        wait_for_lines(&child, &journal, known + 4);
        signal(name, child.id());
        let status = child.wait().unwrap();
        // Earlier entries are not written again.
        let now = written(&out);
        let ids: Vec<String> = rows(&journal).iter().map(|row| row["id"].as_str().unwrap().to_owned()).collect();
        if name == "TERM" && ids.len() < JOBS {
            // It finishes the current jobs, records them and reports that the list is incomplete.
            assert_eq!(status.code(), Some(128 + 15), "{status}");
        }
        interrupted += usize::from(ids.len() < JOBS);
        assert!(before.iter().all(|(name, time)| now[name] == *time));
        before = now.into_iter().filter(|(name, _)| ids.contains(&name.replace(".png", ""))).collect();
    }
    assert!(interrupted >= 1, "every signal came after the last job");
    // A torn line, as a kill may leave it.
    let text = std::fs::read_to_string(&journal).unwrap();
    std::fs::write(&journal, format!("{text}{}", &text[..40])).unwrap();
    let finished = text.lines().count();
    let output = done(&["batch", &list, "-o", &out, "--resume", "--jobs", "2"]);
    assert!(
        said(&output).contains(&format!(
            "tinta: {} of {JOBS} jobs done, {} were done before, 0 failed",
            JOBS - finished,
            finished
        )),
        "{}",
        said(&output)
    );
    let mut ids: Vec<String> = rows(&journal).iter().map(|row| row["id"].as_str().unwrap().to_owned()).collect();
    ids.sort();
    ids.dedup();
    assert_eq!((ids.len(), rows(&journal).len()), (JOBS, JOBS), "each job is written down once");
    let after = written(&out);
    assert!(
        before.len() >= 12 && before.iter().all(|(name, time)| after[name] == *time),
        "{} pictures stayed",
        before.len()
    );
    // A picture that is gone, one that is cut, a line that is changed: these three and no others.
    std::fs::remove_file(folder.path("out/v3.png")).unwrap();
    std::fs::write(folder.path("out/v4.png"), b"cut").unwrap();
    let changed: Vec<String> = jobs.iter().map(|job| job.replace(r#""5,10""#, r#""5,11""#)).collect();
    let changed = folder.file("changed.jsonl", changed.join("\n").as_bytes());
    let output = tinta(&["batch", &changed, "-o", &out, "--resume"]);
    assert!(
        said(&output).contains(&format!("tinta: 3 of {JOBS} jobs done, {} were done before, 0 failed", JOBS - 3)),
        "{}",
        said(&output)
    );
    assert_eq!(rows(&journal).len(), JOBS + 3);
    let summary = done(&["batch", "--summary", &out]);
    let text = String::from_utf8(summary.stdout).unwrap();
    assert!(
        text.starts_with(&format!("{JOBS} jobs: {JOBS} done, 0 failed, 0 missing\n"))
            && text.ends_with("1 entries of jobs that are no longer in the list\n"),
        "{text}"
    );
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
    let jobs = [render("before", ""), long, render("after", "")];
    let (out, journal) = (folder.path("out"), folder.path("out/batch-1-of-1.jsonl"));
    let child = start(&["batch", &list(&folder, &jobs), "-o", &out, "--jobs", "1"]);
    wait_for_lines(&child, &journal, 1);
    let workers = children(child.id());
    assert_eq!(workers.len(), 1);
    signal("KILL", workers[0]);
    then(&child, &journal);
    let output = child.wait_with_output().unwrap();
    let text = |row: &serde_json::Value, key: &str| row[key].as_str().unwrap().to_owned();
    let rows = rows(&journal);
    let states = rows.iter().map(|row| (text(row, "id"), text(row, "status"), row["run"]["tries"].as_u64().unwrap()));
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
        wait_for_lines(child, journal, 2);
        // The worker of the job that was last may still be there.
        while !has_ended(child) {
            for worker in children(child.id()) {
                let _ = Command::new("kill").args(["-s", "KILL", &worker.to_string()]).output();
            }
        }
    });
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("tinta: line 2, long: its worker process ended (signal 9)"), "{}", said(&output));
    assert_eq!(as_named(&states), [("before", "done", 1), ("after", "done", 1), ("long", "failed", 1)]);
    assert!(!Path::new(&folder.path("out/long.gif")).exists());
}

#[test]
fn workers_end_with_the_run_that_is_killed() {
    let folder = Folder::new();
    let endless = r#"{"id":"endless","command":"render","model":"builtin:bust","output":"endless.gif","size":1024,"turntable":10000}"#;
    let jobs = [render("before", ""), endless.to_owned()];
    let journal = folder.path("out/batch-1-of-1.jsonl");
    let mut child = start(&["batch", &list(&folder, &jobs), "-o", &folder.path("out"), "--jobs", "1"]);
    wait_for_lines(&child, &journal, 1);
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
    wait_for_lines(&child, &rows_file, 1);
    signal("KILL", child.id());
    drop(child.wait_with_output());
    assert!(!Path::new(&folder.path("out/m/report.html")).exists(), "half a measurement has no report");
    let kept = std::fs::read_to_string(&rows_file).unwrap();
    done(&["batch", &list, "-o", &out, "--resume"]);
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
    std::fs::remove_file(folder.path("merged/both/report.html")).unwrap();
    done(&["batch", &list, "-o", &out, "--resume"]);
    let [first, again] = [rows, folder.path("merged/both/results.jsonl")].map(|rows| std::fs::read(rows).unwrap());
    assert!(first == again && Path::new(&folder.path("merged/both/report.html")).exists());
}
