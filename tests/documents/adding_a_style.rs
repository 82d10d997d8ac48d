//! `docs/dev/adding-a-style.md` holds: its blocks, put at the stated places into a copy of the sources, make a style, and every
//! interface has its one setting.

use crate::support::root;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A block of code that belongs into a file.
struct Block {
    path: String,
    /// The line before which it is inserted; `None` for a new file.
    before: Option<String>,
    text: String,
}

/// The page's blocks, each under a line that names its file: `` `FILE`: `` or `` `FILE`, before `LINE`: ``.
fn blocks() -> Vec<Block> {
    let page = std::fs::read_to_string(root().join("docs/dev/adding-a-style.md")).unwrap();
    let mut all = Vec::new();
    let mut parts = page.split("\n```");
    let mut above = parts.next().unwrap();
    while let (Some(block), Some(below)) = (parts.next(), parts.next()) {
        let label: Vec<&str> = above.trim_end().lines().last().unwrap().split('`').collect();
        let text = block.split_once('\n').unwrap().1.to_owned() + "\n";
        let (path, before) = match label.as_slice() {
            ["", path, ":"] => (*path, None),
            ["", path, ", before ", line, ":"] => (*path, Some((*line).to_owned())),
            _ => panic!("no file is named above the block\n{text}"),
        };
        all.push(Block { path: path.to_owned(), before, text });
        above = below;
    }
    all
}

/// The files that the page makes, which are not there.
pub fn new_files() -> Vec<String> {
    blocks().into_iter().filter(|block| block.before.is_none()).map(|block| block.path).collect()
}

fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        std::fs::create_dir_all(to).unwrap();
        for entry in std::fs::read_dir(from).unwrap() {
            let name = entry.unwrap().file_name();
            copy(&from.join(&name), &to.join(&name));
        }
    } else {
        std::fs::copy(from, to).unwrap();
    }
}

/// A copy of the program's sources, always in the same folder: in another one cargo would build all of it again.
fn copy_of_the_sources() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adding-a-style/sources");
    let _ = std::fs::remove_dir_all(&folder);
    for parent in ["python", "web"] {
        std::fs::create_dir_all(folder.join(parent)).unwrap();
    }
    // Without the tests, benchmarks and packages that Cargo.toml names it is refused.
    let files = ["Cargo.toml", "Cargo.lock", "python/Cargo.toml", "web/Cargo.toml"];
    let folders = ["benches", "crates", "glsl", "models", "presets", "python/src", "src", "tests", "web/src"];
    for part in files.into_iter().chain(folders) {
        copy(&root().join(part), &folder.join(part));
    }
    folder
}

impl Block {
    fn put_into(&self, folder: &Path) {
        let path = folder.join(&self.path);
        let text = match &self.before {
            None => {
                assert!(!path.exists(), "{} is there already", self.path);
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                self.text.clone()
            }
            Some(line) => {
                let text = std::fs::read_to_string(&path).unwrap();
                let is_it = |candidate: &&str| candidate.trim() == line;
                assert_eq!(text.lines().filter(is_it).count(), 1, "{}: {line}", self.path);
                let of_line =
                    |candidate| if is_it(&candidate) { self.text.clone() + candidate } else { candidate.into() };
                text.lines().map(of_line).collect::<Vec<String>>().join("\n") + "\n"
            }
        };
        std::fs::write(path, text).unwrap();
    }
}

/// A style that draws exact lines, which is only a row.
fn lines_style() -> Block {
    let text = r#"    /// Exact lines by another name.
    Hatches(LineStyle) {
        name: "hatches",
        draw: Draw::Lines(LineStyle::clone),
        has_lines: |_| false,
        shows: &[Show::Final],
        origin: Origin::Own,
        mark: None,
    }

"#;
    let before = Some("// A new style's row comes here: docs/dev/adding-a-style.md.".to_owned());
    Block { path: "src/styles.rs".to_owned(), before, text: text.to_owned() }
}

fn succeeds(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    assert!(status.success(), "{command:?}\n{}", String::from_utf8_lossy(&stderr));
    String::from_utf8(stdout).unwrap()
}

#[test]
#[ignore = "nightly: builds a copy of the program"]
fn the_page_adds_a_style_whose_setting_is_found_at_every_door_nightly() {
    let folder = copy_of_the_sources();
    blocks().iter().for_each(|block| block.put_into(&folder));
    lines_style().put_into(&folder);
    let build = folder.with_file_name("build");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--offline", "--locked", "--bin", "tinta", "--no-default-features"]);
    succeeds(cargo.current_dir(&folder).env("CARGO_TARGET_DIR", &build));
    let tinta = |words: &str| {
        let mut command = Command::new(build.join("debug/tinta"));
        succeeds(command.args(words.split(' ')).current_dir(&folder))
    };

    // Help, completions, manual.
    let help = tinta("render --help");
    assert!(help.contains("sand, stripes, hatches, lines"), "{help}");
    assert!(help.contains("Style stripes:") && help.contains("--stripe-distance <PIXELS>"), "{help}");
    assert!(tinta("completions bash").contains("--stripe-distance"));
    tinta("man -o manuals");
    assert!(std::fs::read_to_string(folder.join("manuals/tinta-render.1")).unwrap().contains("stripe\\-distance"));

    // An option, a preset, a job, and a picture's recipe draw the same.
    let record = tinta("render builtin:bust --size 96 -o option.png --style stripes --stripe-distance 12 --json");
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    assert_eq!((&record["style"]["name"], &record["style"]["stripe-distance"]), (&"stripes".into(), &12.into()));
    tinta("render builtin:bust --size 96 -o default.png --style stripes");
    tinta("render builtin:bust --size 96 -o preset.png --preset stripes.toml");
    tinta("again option.png -o again.png");
    let job = r#"{"id": 1, "command": "render", "model": "builtin:bust", "output": "job.png", "size": 96, "style": "stripes", "stripe-distance": 12}"#;
    std::fs::write(folder.join("jobs.jsonl"), job).unwrap();
    tinta("batch jobs.jsonl -o .");
    let pixels = |name: &str| image::open(folder.join(name)).unwrap().into_rgba8().into_raw();
    for other in ["preset.png", "again.png", "job.png"] {
        assert!(pixels(other) == pixels("option.png"), "{other}");
    }
    assert!(pixels("default.png") != pixels("option.png"));

    // A style that draws lines needs only its row: it gets the settings of lines, writes their formats, and can be drawn again.
    let drawn = |name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        text.lines().filter(|line| line.contains("<path")).map(str::to_owned).collect::<Vec<_>>()
    };
    tinta("render builtin:gear --size 96 -o hatches.svg --style hatches --hidden dashed");
    tinta("render builtin:gear --size 96 -o lines.svg --hidden dashed");
    assert!(drawn("hatches.svg").len() > 2 && drawn("hatches.svg") == drawn("lines.svg"));
    tinta("again hatches.svg -o hatches-again.svg");
    assert_eq!(drawn("hatches-again.svg"), drawn("hatches.svg"));
    tinta("render builtin:gear --size 96 -o hatches.png --style hatches");
    tinta("render builtin:gear --size 96 -o lines.png --style lines");
    assert!(pixels("hatches.png") == pixels("lines.png"));

    // The measurement uses the default settings.
    tinta("measure builtin:open-box --styles stripes --quick --size 64 -o measured");
    let rows = std::fs::read_to_string(folder.join("measured/results.csv")).unwrap();
    assert!(rows.contains("--style stripes"), "{rows}");
}
