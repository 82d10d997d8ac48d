//! The documents' examples run: the first ten minutes as written, and every quoted sentence is printed.

use crate::support::{root, skip};
use std::process::Command;
use tinta::Backend;
use tinta::gl::context::witnesses;

/// A file that cannot be drawn, or only with a remark.
const ODD_FILES: [(&str, &str); 5] = [
    ("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
    ("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 2 2\nf 1 2 3\nf 1 1 2\n"),
    ("plain.obj", "mtllib none.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ("noise.ply", "no header\n"),
    ("empty.obj", ""),
];

/// Each exercise of a page: its command, and what its answer quotes.
fn exercises(page: &str) -> Vec<(String, Vec<String>)> {
    let (_, exercises) = page.split_once("## Predict, then look").unwrap_or_default();
    let code = |text: &str| text.lines().filter_map(|line| line.strip_prefix("    ")).map(str::to_owned).collect();
    let parts = exercises.split("</details>").filter_map(|exercise| exercise.split_once("<details>"));
    parts
        .map(|(question, answer)| {
            let commands: Vec<String> = code(question);
            (commands.join("\n"), code(answer))
        })
        .collect()
}

#[test]
fn the_answers_of_exercises_are_printed() {
    let mut count = 0;
    for text in ["evangelista", "dachsbacher", "valente"] {
        let page = std::fs::read_to_string(root().join(format!("docs/texts/how-{text}-works.md"))).unwrap();
        for (command, quoted) in exercises(&page) {
            let words = command.strip_prefix("tinta ").unwrap_or_else(|| panic!("{text}: {command}")).split(' ');
            let output = Command::new(env!("CARGO_BIN_EXE_tinta")).args(words).output().unwrap();
            let printed = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(!quoted.is_empty(), "{command}");
            for line in quoted {
                assert!(printed.contains(&line), "{text}: {command} does not print {line:?}");
            }
            count += 1;
        }
    }
    assert_eq!(count, 9, "three exercises for each text");
}

#[test]
fn the_lesson_for_teachers_goes_as_it_is_written() {
    let page = std::fs::read_to_string(root().join("docs/guide/for-teachers.md")).unwrap();
    let (_, lesson) = page.split_once("## A lesson").unwrap();
    let lesson = lesson.split_once("\n## ").map_or(lesson, |(lesson, _)| lesson);
    let folder = tempfile::tempdir().unwrap();
    let (mut printed, mut commands, mut quoted) = (String::new(), 0, 0);
    let mut is_new = true;
    for line in lesson.lines() {
        let Some(code) = line.strip_prefix("    ") else {
            is_new |= !line.is_empty();
            continue;
        };
        let Some(words) = code.strip_prefix("tinta ") else {
            assert!(printed.contains(code), "{code:?} is not in\n{printed}");
            quoted += 1;
            continue;
        };
        if std::mem::take(&mut is_new) {
            printed.clear();
        }
        let words: Vec<&str> = words.split(' ').collect();
        let output =
            Command::new(env!("CARGO_BIN_EXE_tinta")).args(&words).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{code}: {output:?}");
        printed.push_str(&String::from_utf8_lossy(&output.stdout));
        if let Some(file) = words.iter().position(|word| *word == "-o").map(|place| words[place + 1]) {
            assert!(folder.path().join(file).is_file(), "{code}");
        }
        commands += 1;
    }
    assert!(commands >= 7 && quoted >= 6, "{commands} {quoted}");
}

#[test]
fn every_sentence_quoted_in_troubleshooting_is_said() {
    let folder = tempfile::tempdir().unwrap();
    ODD_FILES.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    let nowhere = folder.path().join("nowhere").display().to_string();
    let said = |environment: &[(&str, &str)], words: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "GALLIUM_DRIVER"] {
            command.env_remove(name);
        }
        let words = words.split(' ');
        let output = command.args(words).envs(environment.iter().copied()).current_dir(folder.path()).output().unwrap();
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat()
    };
    let mut all = String::new();
    for words in [
        "render bad.obj -o a.png",
        "render odd.obj -o a.png --size 16 --explain",
        "render plain.obj -o a.png --size 16",
        "render noise.ply -o a.png",
        "render empty.obj -o a.png",
        "render nowhere.obj -o a.png",
        "render builtin:ant -o nodir/a.png",
        "render builtin:ant -o a.png --look published --size 30000",
        "render builtin:open-box -o a.png --style inking --line-width 300 --size 16",
        "render builtin:open-box -o a.png --style inking --texture on --size 16",
        "render builtin:open-box -o a.svg --eye 100,0,0 --target 200,0,0",
        "render builtin:open-box -o a.png --eye 100,0,0 --target 200,0,0",
    ] {
        all.push_str(&said(&[], words));
    }
    if cfg!(feature = "window") {
        all.push_str(&said(&[], "view"));
    } else {
        skip("the window's sentence: built without the window");
        all.push_str("tinta: no window can be opened (neither WAYLAND_DISPLAY nor WAYLAND_SOCKET nor DISPLAY is set)");
    }
    // One driver's library is enough to draw with; both must fail.
    all.push_str(&said(&[("GALLIUM_DRIVER", "none"), ("LIBGL_DRIVERS_PATH", &nowhere)], "info"));
    if witnesses()[1] != Backend::OsMesa {
        skip("OSMesa's sentence: there is no OSMesa");
        all.push_str(
            "it has no driver \"none\", which GALLIUM_DRIVER asks for; choose llvmpipe or softpipe, or unset it",
        );
    }
    let page = std::fs::read_to_string(root().join("docs/guide/troubleshooting.md")).unwrap();
    let quoted: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("> ")).map(str::trim).collect();
    assert!(quoted.len() >= 14, "only {quoted:?} were found");
    let missing: Vec<&str> = quoted.into_iter().filter(|sentence| !all.contains(*sentence)).collect();
    assert!(
        missing.is_empty(),
        "docs/guide/troubleshooting.md quotes what no command here says: {missing:#?}\nsaid was:\n{all}"
    );
}

#[test]
fn the_first_ten_minutes_go_as_they_are_written() {
    let folder = tempfile::tempdir().unwrap();
    for (from, to) in [("models/pawn.obj", "cow.obj"), ("models/pawn.ppm", "cow.ppm")] {
        std::fs::copy(root().join(from), folder.path().join(to)).unwrap();
    }
    let page = std::fs::read_to_string(root().join("docs/guide/installing.md")).unwrap();
    let (_, section) = page.split_once("## The first ten minutes").unwrap();
    let (section, _) = section.split_once("\n## ").unwrap();
    let mut count = 0;
    for command in section.lines().filter_map(|line| line.strip_prefix("    tinta ")) {
        if command.starts_with("view") {
            continue;
        }
        let output = Command::new(env!("CARGO_BIN_EXE_tinta"))
            .args(command.split(' '))
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "tinta {command}: {}", String::from_utf8_lossy(&output.stderr));
        let words: Vec<&str> = command.split(' ').collect();
        if let Some(at) = words.iter().position(|word| *word == "-o") {
            let written = folder.path().join(words[at + 1]);
            assert!(written.exists(), "tinta {command} wrote nothing");
        }
        count += 1;
    }
    assert!(count >= 11, "only {count} commands were found");
}

#[test]
fn the_documents_drawings_are_those_that_their_recipes_draw() {
    let again = |path: &std::path::Path| {
        Command::new(env!("CARGO_BIN_EXE_tinta")).arg("again").arg(path).current_dir(root()).output().unwrap()
    };
    let files = std::fs::read_dir(root().join("docs/pictures")).unwrap().map(|file| file.unwrap().path());
    let drawings = files.filter(|path| {
        path.extension().is_some_and(|ending| ending == "svg")
            && std::fs::read_to_string(path).unwrap().contains("<tinta:recipe")
    });
    let (mut count, mut others) = (0, Vec::new());
    for path in drawings {
        let output = again(&path);
        count += 1;
        others.extend((!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    assert!(count >= 10 && others.is_empty(), "{count} drawings; draw these anew by again -o: {others:#?}");
}
