//! Output that cannot be written: one sentence, exit code 2, the old file unchanged, no other file left.

use crate::program::assert_refused;
use crate::support::{Folder, names, root, skip};
use std::fs::File;
use std::path::Path;
use std::process::{Command, Output};

const OLD: &[u8] = b"what was there";

/// Commands that write into the folder `{}`, one for each kind of file, and the file each would write.
const WRITERS: [(&str, &str); 6] = [
    ("render builtin:ant --size 200 -o {}/a.ppm", "a.ppm"),
    ("render builtin:ant --size 400 -o {}/a.svg", "a.svg"),
    ("render builtin:ant --size 400 -o {}/a.json", "a.json"),
    ("render builtin:ant --size 200 --turntable 40 -o {}/a.gif", "a.gif"),
    ("render builtin:ant --size 200 --turntable 40 -o {}/a.apng", "a.apng"),
    ("render builtin:ant --size 200 --turntable 3 -o {}/%d.ppm", "1.ppm"),
];

fn arguments(command: &str, folder: &str) -> Vec<String> {
    command.split(' ').map(|word| word.replace("{}", folder.trim_end_matches('/'))).collect()
}

/// Runs the program by a shell that first does something to its world.
fn through_shell(prepare: &str, arguments: &[String]) -> Output {
    let script = format!("{prepare}; exec \"$@\"");
    let program = env!("CARGO_BIN_EXE_tinta");
    Command::new("sh").args(["-c", &script, "sh", program]).args(arguments).current_dir(root()).output().unwrap()
}

#[test]
fn a_directory_in_the_files_place_is_refused_and_left_alone() {
    for (command, file) in WRITERS {
        let folder = Folder::new();
        std::fs::create_dir(folder.path(file)).unwrap();
        let output = through_shell(":", &arguments(command, &folder.path("")));
        assert_refused(&output, &[file, "this is a directory; name a file in it"]);
        assert_eq!(names(Path::new(&folder.path(""))), [file]);
        assert!(names(Path::new(&folder.path(file))).is_empty());
    }
    for command in [
        "generate man -o {}/taken",
        "render builtin:ant --look all -o {}/taken",
        "measure builtin:ant --quick -o {}/taken",
        "figures -o {}/taken",
    ] {
        let folder = Folder::new();
        folder.file("taken", OLD);
        let output = through_shell(":", &arguments(command, &folder.path("")));
        assert_refused(&output, &["taken", "this is a file; name a folder"]);
        assert_eq!(std::fs::read(folder.path("taken")).unwrap(), OLD);
    }
}

#[cfg(unix)]
#[test]
fn a_limit_on_files_sizes_is_an_error_and_no_signal() {
    // Four or eight KiB, by the shell: less than any of these files needs.
    let limit = "ulimit -f 8";
    for (command, file) in WRITERS {
        let folder = Folder::new();
        folder.file(file, OLD);
        assert_refused(&through_shell(limit, &arguments(command, &folder.path(""))), &[file, "ulimit -f"]);
        assert_eq!(names(Path::new(&folder.path(""))), [file]);
        assert_eq!(std::fs::read(folder.path(file)).unwrap(), OLD, "{command}");
        std::fs::remove_file(folder.path(file)).unwrap();
        assert_refused(&through_shell(limit, &arguments(command, &folder.path(""))), &[file, "ulimit -f"]);
        assert!(names(Path::new(&folder.path(""))).is_empty(), "{command}");
    }
    // If several pictures belong together, none appears.
    let folder = Folder::new();
    let place = folder.path("both/");
    let compare = "compare builtin:ant --size 200 --frames 1 -o {}/";
    assert_refused(&through_shell(limit, &arguments(compare, &place)), &["ulimit -f"]);
    assert!(names(Path::new(&place)).is_empty());
    // And of measured rows no half one.
    let place = folder.path("measured");
    let rows = "measure builtin:ant --size 64 --styles phong,two-pass --frames 3 -o {}";
    assert_refused_at_end(&through_shell("ulimit -f 1", &arguments(rows, &place)), "continue with --resume");
    let text = std::fs::read_to_string(Path::new(&place).join("results.jsonl")).unwrap();
    assert!(text.is_empty() || text.ends_with('\n'), "{text}");
}

/// Like [`assert_refused`], for a command that prints its plan first.
fn assert_refused_at_end(output: &Output, words: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{:?}: {said}", output.status);
    assert!(said.trim_end().lines().last().is_some_and(|line| line.contains(words)), "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_takes_nothing_is_an_error() {
    let folder = Folder::new();
    let json = format!("render builtin:ant --size 32 --json -o {}", folder.path("a.png"));
    let commands =
        ["render builtin:ant --size 32 -o -", "info", "info --json", "info builtin:ant", "info builtin:ant --json"];
    for command in commands.into_iter().chain([json.as_str()]) {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_tinta")).args(command.split(' ')).stdout(full).output().unwrap();
        assert_refused(&output, &["standard output cannot be written", "No space left"]);
    }
    assert_eq!(names(Path::new(&folder.path(""))), ["a.png"], "the picture was written, its record was not");
    // A pipe without a reader is no fault of the picture, but the write fails.
    let limit = format!("ulimit -f 1; exec > {}", folder.path("out.png"));
    assert_refused(&through_shell(&limit, &arguments("render builtin:ant --size 200 -o -", "")), &["standard output"]);
}

/// Runs a script in which `$T` is the program and `$D` a folder, with permission to mount file systems; `None` where the system
/// does not allow it.
pub fn where_mounts_are_ours(script: &str, folder: &str) -> Option<String> {
    let own = ["--user", "--map-root-user", "--mount", "sh", "-ec"];
    let may = Command::new("unshare").args(own).arg("mount -t tmpfs none /tmp").output();
    if !may.is_ok_and(|output| output.status.success()) {
        skip("full disk and read-only folder: file systems cannot be mounted here");
        return None;
    }
    let output = Command::new("unshare")
        .args(own)
        .arg(script)
        .env("T", env!("CARGO_BIN_EXE_tinta"))
        .env("D", folder.trim_end_matches('/'))
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap())
}

/// In a shell script: runs a command, prints its exit code and sentence, and the folder's contents afterwards.
const TRY: &str = r#"
try() { if said=$("$T" "$@" 2>&1 >/dev/null); then code=0; else code=$?; fi; echo "exit $code"; echo "said $said"; }
hold() { echo "holds $(ls -A "$D" | tr '\n' ' ')"; }
"#;

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_old_file_and_nothing_else() {
    for (command, file) in WRITERS {
        let folder = Folder::new();
        let command = command.replace("{}", "\"$D\"");
        // 8 KiB in total, 4 of them used by the old file.
        let script = format!(
            "{TRY} mount -t tmpfs -o size=8k none \"$D\"; head -c 4096 /dev/zero > \"$D/{file}\"; \
             try {command}; hold; head -c 4096 /dev/zero | cmp - \"$D/{file}\" && echo same; \
             rm \"$D/{file}\"; try {command}; hold"
        );
        let Some(text) = where_mounts_are_ours(&script, &folder.path("")) else { return };
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        let [first, said, holds, same, second, said_again, nothing] = lines[..] else { panic!("{text}") };
        assert_eq!((first, second, same), ("exit 2", "exit 2", "same"), "{command}: {text}");
        for said in [said, said_again] {
            assert!(said.contains(file) && said.ends_with("the disk is full; free some space"), "{text}");
        }
        assert_eq!((holds, nothing), (format!("holds {file}").as_str(), "holds"), "{command}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_keeps_whole_frames_and_no_half_set_of_pictures() {
    let folder = Folder::new();
    // A frame is 3 * 64 * 64 bytes and a few, so four pages; there is room for three.
    let script = format!(
        "{TRY} mount -t tmpfs -o size=52k none \"$D\"; try render builtin:ant --size 64 --turntable 9 -o \"$D/%d.ppm\"; hold; \
         wc -c < \"$D/3.ppm\"; rm \"$D\"/*; echo old > \"$D/lines.png\"; try compare builtin:ant --size 600 --frames 1 -o \"$D/\"; hold; cat \"$D/lines.png\""
    );
    let Some(text) = where_mounts_are_ours(&script, &folder.path("")) else { return };
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    let [exit, said, frames, bytes, exit_of_set, said_of_set, set, old] = lines[..] else { panic!("{text}") };
    assert_eq!((exit, frames), ("exit 2", "holds 1.ppm 2.ppm 3.ppm"), "{text}");
    assert!(said.contains("4.ppm: the disk is full"), "{said}");
    assert_eq!(bytes, (3 * 64 * 64 + "P6\n64 64\n255\n".len()).to_string());
    assert_eq!((exit_of_set, set, old), ("exit 2", "holds lines.png", "old"), "{text}");
    assert!(said_of_set.contains("the disk is full"), "{said_of_set}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_read_only_folder_is_refused_before_the_work() {
    for (command, file) in WRITERS {
        let folder = Folder::new();
        folder.file(file, OLD);
        // The model is missing too: that would be noticed later.
        let command = command.replace("{}", "\"$D\"").replace("builtin:ant", "no-such.obj");
        let script = format!(
            "{TRY} mount --bind \"$D\" \"$D\"; mount -o remount,ro,bind \"$D\"; try {command}; hold; cat \"$D/{file}\""
        );
        let Some(text) = where_mounts_are_ours(&script, &folder.path("")) else { return };
        let [exit, said, holds, old] = text.lines().collect::<Vec<_>>()[..] else { panic!("{text}") };
        assert_eq!(
            (exit, holds.trim_end(), old),
            ("exit 2", format!("holds {file}").as_str(), "what was there"),
            "{text}"
        );
        let is_refused = said.contains("no permission to write into the folder ");
        assert!(is_refused && said.contains(file) && said.ends_with("; choose another"), "{said}");
    }
}

#[test]
fn nothing_that_is_read_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nmtllib m.mtl\nusemtl a\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(at("m.mtl"), "newmtl a\nmap_Kd worn.png\n").unwrap();
    for name in ["m.obj", "model.png", "fr-0001.png"] {
        std::fs::write(at(name), square).unwrap();
    }
    let tinta = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_tinta")).args(arguments).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    for name in ["skin.png", "ramp.png", "paper.png", "cet.png", "noise.png", "worn.png"] {
        assert_eq!(tinta(&["render", "builtin:gear", "-o", &at(name), "--size", "8", "--no-recipe"]).0, Some(0));
    }
    std::fs::write(at("preset.png"), "style = \"phong\"\n").unwrap();
    let (model, skin, ramp, paper) = (at("model.png"), at("skin.png"), at("ramp.png"), at("paper.png"));
    let (obj, preset, worn, frames) = (at("m.obj"), at("preset.png"), at("worn.png"), at("fr-%04d.png"));
    let (cet, noise) = (at("cet.png"), at("noise.png"));
    let attempts: [&[&str]; 11] = [
        &["render", &model, "-o", &model],
        &["render", &obj, "-o", &at("x.png"), "--save-preset", &obj],
        &["render", &obj, "-o", &skin, "--texture", &format!("skin={}", skin)],
        &["render", &obj, "-o", &ramp, "--style", "inking", "--texture", &format!("ramp={}", ramp)],
        &["render", &obj, "-o", &paper, "--style", "charcoal", "--texture", &format!("paper={}", paper)],
        &["render", &obj, "-o", &cet, "--style", "charcoal", "--texture", &format!("cet={}", cet)],
        &["render", &obj, "-o", &noise, "--style", "sand", "--texture", &format!("noise-texture={}", noise)],
        &["render", &obj, "-o", &preset, "--preset", &preset],
        &["render", &obj, "-o", &worn],
        &["render", &at("fr-0001.png"), "-o", &frames, "--turntable", "2"],
        &["compare", &model, "-o", &model],
    ];
    let contents = || {
        let files = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
        files.map(|path| (path.clone(), std::fs::read(path).unwrap())).collect::<std::collections::BTreeMap<_, _>>()
    };
    let before = contents();
    for attempt in attempts {
        let (code, message) = tinta(attempt);
        assert_eq!(code, Some(2), "{attempt:?}: {message}");
        assert!(message.contains("this would overwrite the "), "{attempt:?}: {message}");
        assert!(contents() == before, "{attempt:?} changed the folder");
    }
}
