//! The program killed half way, and its folder taken away: the remaining files are whole. The tests kill after an observed event,
//! never by the clock; the assertions hold for any moment.

#![cfg(target_os = "linux")]

use crate::batch_killed::signal as send;
use crate::support::{Folder, names, root, skip};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};

const OLD: &[u8] = b"what was there";

fn start(arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
    command.args(arguments).current_dir(root()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// State and processor time, hundredths of a second, of a child that has not been waited for.
fn state(child: &Child) -> (char, u64) {
    let text = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
    let fields: Vec<&str> = text.rsplit(')').next().unwrap().split_ascii_whitespace().collect();
    (fields[0].chars().next().unwrap(), fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap())
}

/// Waits for a moment by looking again and again, then sends a signal; how the child ended.
fn end_when(mut child: Child, signal: &str, mut is_moment: impl FnMut(&Child) -> bool) -> ExitStatus {
    while state(&child).0 != 'Z' && !is_moment(&child) {
        std::thread::yield_now();
    }
    send(signal, child.id());
    child.wait().unwrap()
}

/// Whether the child holds a file open in this folder that no name leads to.
fn writes_unnamed(child: &Child, folder: &Path) -> bool {
    let Ok(files) = std::fs::read_dir(format!("/proc/{}/fd", child.id())) else { return false };
    let targets = files.flatten().filter_map(|file| std::fs::read_link(file.path()).ok());
    targets.into_iter().any(|path| path.starts_with(folder) && path.to_string_lossy().ends_with(" (deleted)"))
}

/// Kills the program at moments of its work, in eighths, and of its writing, counted in checks of the written file: while it
/// replaces `file`, and while it creates it.
fn killed_at(file: &str, options: &[&str], eighths: &[u64], looks: &[usize]) {
    let folder = Folder::new();
    let place = Path::new(&folder.path("")).canonicalize().unwrap();
    let path = place.join(file);
    let mut arguments = vec!["render", "builtin:ant", "-o", path.to_str().unwrap()];
    arguments.extend(options);
    // Once undisturbed: its output and its run time.
    let mut child = start(&arguments);
    let mut whole = 0;
    while state(&child).0 != 'Z' {
        std::thread::yield_now();
    }
    whole = whole.max(state(&child).1);
    assert!(child.wait().unwrap().success());
    let new = std::fs::read(&path).unwrap();
    assert!(whole >= 4, "{file}: {whole} hundredths of a second are too few to be interrupted in");
    let (mut killed, mut killed_writing) = (0, 0);
    for old in [Some(OLD), None] {
        let mut check = |status: ExitStatus, moment: &str| {
            let left = names(&place);
            // Between two system calls the new file, whole, has a second name.
            let beside: Vec<&String> = left.iter().filter(|name| *name != file).collect();
            let is_whole =
                |name: &&String| name.starts_with(".tinta-") && std::fs::read(place.join(name)).unwrap() == new;
            assert!(beside.len() <= usize::from(old.is_some()) && beside.iter().all(is_whole), "{moment}: {left:?}");
            match std::fs::read(&path) {
                Ok(bytes) => assert!(Some(&bytes[..]) == old || bytes == new, "{moment}: {} bytes", bytes.len()),
                Err(_) => assert!(old.is_none(), "{moment}: the old file is gone"),
            }
            killed += usize::from(status.signal().is_some());
            beside.iter().for_each(|name| std::fs::remove_file(place.join(name)).unwrap());
        };
        let prepare = || match old {
            Some(old) => std::fs::write(&path, old).unwrap(),
            None => std::fs::remove_file(&path).unwrap_or_default(),
        };
        for &eighth in eighths {
            prepare();
            let signal = ["KILL", "TERM"][eighth as usize % 2];
            let status = end_when(start(&arguments), signal, |child| state(child).1 >= whole * eighth / 8);
            check(status, &format!("{signal} after {eighth} eighths of the work"));
        }
        // At the first sight of the unfinished file, and checks later: the first may belong to the test write before the work.
        for &looks in looks {
            prepare();
            let (mut seen, mut is_seen) = (0, false);
            let status = end_when(start(&arguments), "KILL", |child| {
                is_seen = writes_unnamed(child, &place);
                seen += usize::from(is_seen);
                seen == looks
            });
            killed_writing += usize::from(is_seen && status.signal().is_some());
            check(status, &format!("killed at look {looks} at the file in the making"));
        }
    }
    let runs = 2 * (eighths.len() + looks.len());
    assert!(killed * 13 >= runs * 4, "{file}: killed {killed} times of {runs}");
    if killed_writing == 0 {
        skip(&format!(
            "{file} killed while it is written: it was never seen, or this file system has no unnamed files"
        ));
    }
}

const EIGHTHS: [u64; 4] = [0, 3, 5, 7];
const LOOKS: [usize; 3] = [1, 4, 16];

#[test]
fn a_picture_killed_while_it_is_drawn_or_written_leaves_the_old_file_or_the_new_one_briefly() {
    killed_at("a.ppm", &["--size", "1600", "--style", "phong"], &[3], &[2]);
}

#[test]
#[ignore = "exhaustive: killed at 14 moments"]
fn a_picture_killed_half_way_leaves_the_old_file_or_the_new_one_and_nothing_half() {
    killed_at("a.ppm", &["--size", "1600", "--style", "phong"], &EIGHTHS, &LOOKS);
}

#[test]
#[ignore = "exhaustive: killed at 14 moments"]
fn an_animation_killed_half_way_leaves_the_old_file_or_the_new_one_and_nothing_half() {
    killed_at("a.apng", &["--size", "96", "--turntable", "60"], &EIGHTHS, &LOOKS);
}

/// Numbered frames after the program's end: all whole, without a gap, and no other file.
fn assert_whole_frames(folder: &Path, at_least: usize) {
    let left = names(folder);
    assert!(left.len() >= at_least && left.len() < 300, "{} frames", left.len());
    for number in 1..=left.len() {
        let name = format!("{number:04}.png");
        assert!(left.contains(&name), "{name} is missing: {left:?}");
        assert_eq!(image::open(folder.join(&name)).unwrap_or_else(|error| panic!("{name}: {error}")).width(), 48);
    }
}

#[test]
fn numbered_frames_of_a_program_that_was_killed_are_whole() {
    for (frames, signal) in [(1, "KILL"), (10, "TERM"), (25, "KILL")] {
        let folder = Folder::new();
        let (place, last) = (folder.path(""), folder.path(&format!("{frames:04}.png")));
        let child =
            start(&["render", "builtin:ant", "-o", &folder.path("%04d.png"), "--size", "48", "--turntable", "300"]);
        let status = end_when(child, signal, |_| Path::new(&last).exists());
        assert!(status.signal().is_some(), "{status}");
        assert_whole_frames(Path::new(&place), frames);
    }
}

#[test]
fn a_folder_taken_away_ends_an_animation_with_a_sentence() {
    let folder = Folder::new();
    let (place, taken) = (folder.path("frames"), folder.path("taken"));
    std::fs::create_dir(&place).unwrap();
    let pattern = format!("{place}/%04d.png");
    let child = start(&["render", "builtin:ant", "-o", &pattern, "--size", "48", "--turntable", "300"]);
    let first = Path::new(&place).join("0001.png");
    while !first.exists() {
        assert!(state(&child).0 != 'Z', "it ended before its first frame");
        std::thread::yield_now();
    }
    std::fs::rename(&place, &taken).unwrap();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(&format!("the folder {place} does not exist; create it first")), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert_whole_frames(Path::new(&taken), 1);
}
