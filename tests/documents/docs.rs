//! The documents name only existing files, folders, headings, options and commands; quoted output is real output.
//!
//! A test beside the parser checks that each `tinta` command parses: `crates/tinta-lab/src/commands/documents_tests.rs`.

use crate::support::root;
use std::path::PathBuf;
use std::process::Command;

fn documents() -> Vec<(PathBuf, String)> {
    let mut paths = vec![root().join("README.md"), root().join("CHANGELOG.md"), root().join("CONTRIBUTING.md")];
    for folder in
        ["docs", "docs/guide", "docs/results", "docs/texts", "docs/dev", "models", "fuzz", "contrib", "python"]
    {
        let files = std::fs::read_dir(root().join(folder)).into_iter().flatten();
        paths.extend(files.map(|file| file.unwrap().path()));
    }
    paths
        .into_iter()
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .map(|path| (path.clone(), std::fs::read_to_string(&path).unwrap()))
        .collect()
}

/// Folders of this project; a word that begins with one is a path.
const FOLDERS: [&str; 20] = [
    ".ci/",
    "crates/",
    "src/",
    "glsl/",
    "models/",
    "presets/",
    "tests/",
    "docs/",
    "scripts/",
    "benches/",
    "examples/",
    "fuzz/",
    "contrib/",
    "python/",
    "evangelista/",
    "improved/",
    "phong/",
    "dachsbacher/",
    "dietrich/",
    "valente/",
];

/// The words of a line that begin like a path of this project, quoted or not, except patterns and placeholders.
fn named_paths(line: &str) -> impl Iterator<Item = &str> {
    let is_end =
        |letter: char| letter.is_whitespace() || matches!(letter, '`' | '(' | ')' | '[' | ']' | '"' | ',' | ';' | ':');
    let words = line.split(is_end).map(|word| word.split('#').next().unwrap().trim_end_matches('.'));
    words.filter(|word| {
        FOLDERS.iter().any(|folder| word.starts_with(folder))
            && !word.contains(['*', '…', '%', '{', '<', '$', '|'])
            && !word.split('/').any(|part| part.len() > 1 && part.chars().all(|letter| letter.is_ascii_uppercase()))
    })
}

/// The targets of a line's links and pictures that are of this project.
fn link_targets(line: &str) -> impl Iterator<Item = &str> {
    let targets = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.is_empty() && !target.contains("://"))
}

/// The anchors of headings: letters and digits in lower case, with - for blanks.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let letter = |letter: char| match letter {
        ' ' => Some('-'),
        '-' | '_' => Some(letter),
        _ if letter.is_alphanumeric() => Some(letter.to_ascii_lowercase()),
        _ => None,
    };
    headings.map(|heading| heading.chars().filter_map(letter).collect()).collect()
}

fn fail_with(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_path_named_in_the_documents_exists() {
    let made = crate::adding_a_style::new_files();
    let mut checked = 0;
    let mut wrong = Vec::new();
    for (document, text) in documents() {
        let folder = document.parent().unwrap();
        for (number, line) in text.lines().enumerate() {
            let place = format!("{}:{}", document.display(), number + 1);
            for path in named_paths(line) {
                checked += 1;
                let places = [root().join(path), root().join("glsl").join(path), folder.join(path)];
                if !places.iter().any(|path| path.exists()) && !made.iter().any(|file| file == path) {
                    wrong.push(format!("{place}: {path} is not there"));
                }
            }
            for target in link_targets(line) {
                checked += 1;
                let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
                let file = if file.is_empty() { document.clone() } else { folder.join(file) };
                if !file.exists() {
                    wrong.push(format!("{place}: the link's target {target} is not there"));
                } else if !anchor.is_empty()
                    && !anchors(&std::fs::read_to_string(&file).unwrap()).contains(&anchor.to_owned())
                {
                    wrong.push(format!("{place}: {} has no heading that #{anchor} links to", file.display()));
                }
            }
        }
    }
    fail_with(wrong);
    assert!(checked > 250, "only {checked} paths were found to check");
}

#[test]
fn every_page_and_every_picture_is_reached_from_somewhere() {
    let all = documents();
    let linked: Vec<PathBuf> = all
        .iter()
        .flat_map(|(document, text)| {
            let folder = document.parent().unwrap().to_owned();
            text.lines()
                .flat_map(link_targets)
                .map(move |target| folder.join(target.split('#').next().unwrap()))
                .collect::<Vec<_>>()
        })
        .filter_map(|path| path.canonicalize().ok())
        .collect();
    let mut files: Vec<PathBuf> =
        all.iter().map(|(path, _)| path.clone()).filter(|path| path.starts_with(root().join("docs"))).collect();
    for folder in ["docs/pictures", "docs/pictures/options"] {
        files.extend(std::fs::read_dir(root().join(folder)).unwrap().map(|file| file.unwrap().path()));
    }
    let is_picture_or_page = |path: &PathBuf| {
        path.extension().is_some_and(|end| ["md", "png", "svg", "gif"].iter().any(|known| end == *known))
    };
    let lost =
        files.into_iter().filter(is_picture_or_page).filter(|path| !linked.contains(&path.canonicalize().unwrap()));
    fail_with(lost.map(|path| format!("{}: no document links to it", path.display())).collect());
}

/// The commands in a document, each with its line, from blocks of code and backquotes.
fn commands(text: &str) -> Vec<(usize, String)> {
    let mut all = Vec::new();
    let mut is_fenced = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            is_fenced = !is_fenced;
            continue;
        }
        let spans: Vec<&str> = if is_fenced || line.starts_with("    ") {
            vec![line]
        } else {
            line.split('`').skip(1).step_by(2).collect()
        };
        for span in spans {
            let command = span.trim().trim_start_matches("$ ").split("  ").next().unwrap().split(" #").next().unwrap();
            // Variables before a command do not belong to it.
            let mut words = command.trim().split(' ').skip_while(|word| {
                word.split_once('=').is_some_and(|(name, _)| {
                    name.chars().all(|c| c.is_ascii_uppercase() || c == '_' || c.is_ascii_digit())
                })
            });
            let first = words.next().unwrap_or_default();
            all.push((number + 1, std::iter::once(first).chain(words).collect::<Vec<_>>().join(" ")));
        }
    }
    all
}

/// Subcommands of cargo that come with it, and those that scripts and documents say how to install.
const CARGO: [&str; 16] = [
    "add",
    "bench",
    "build",
    "check",
    "clippy",
    "deny",
    "doc",
    "fmt",
    "fuzz",
    "install",
    "package",
    "publish",
    "run",
    "test",
    "tree",
    "uninstall",
];

/// The error in a cargo command, if any.
fn cargo_fault(words: &[&str], manifest: &str, sources: &str) -> Option<String> {
    let words: Vec<&str> = words.iter().copied().filter(|word| !word.starts_with('+')).collect();
    let subcommand = words.get(1)?;
    if !CARGO.contains(subcommand) {
        return Some(format!("cargo has no {subcommand} here"));
    }
    let own: Vec<&str> = words[2..].iter().copied().take_while(|word| *word != "--").collect();
    for pair in own.windows(2) {
        let [option, name] = [pair[0], pair[1]];
        let is_there = match option {
            "--bench" => ["benches", "crates/tinta-geometry/benches"]
                .iter()
                .any(|folder| root().join(format!("{folder}/{name}.rs")).exists()),
            "--example" => {
                manifest.contains(&format!("name = \"{name}\""))
                    || ["examples", "crates/tinta-lab/examples"]
                        .iter()
                        .any(|folder| root().join(format!("{folder}/{name}.rs")).exists())
            }
            "--test" => {
                manifest.contains(&format!("[[test]]\nname = \"{name}\""))
                    || ["{name}.rs", "{name}/main.rs"].iter().any(|file| {
                        root().join("crates/tinta-geometry/tests").join(file.replace("{name}", name)).exists()
                    })
            }
            "--bin" => name == "tinta",
            "--features" => manifest.contains(&format!("\n{name} = [")),
            _ => true,
        };
        if !is_there {
            return Some(format!("there is no {option} {name}"));
        }
    }
    // The other arguments of `cargo test` are parts of test names.
    let takes_value = ["-p", "--bench", "--example", "--test", "--bin", "--features"];
    let filter = own.iter().enumerate().find(|(at, word)| {
        !word.starts_with('-') && *subcommand == "test" && (*at == 0 || !takes_value.contains(&own[at - 1]))
    });
    let is_there = |name: &str| name.split("::").all(|part| sources.contains(part));
    filter.filter(|(_, name)| !is_there(name)).map(|(_, name)| format!("no test is called {name}"))
}

/// An option after the name of a benchmark or a script that its source does not read.
fn unread_option(words: &[&str]) -> Option<String> {
    let bench = words.windows(2).find(|pair| pair[0] == "--bench").map(|pair| pair[1]);
    let is_script = |word: &&str| word.ends_with(".py") || word.starts_with("scripts/");
    let (is_name, paths): (&dyn Fn(&&str) -> bool, _) = match bench {
        Some(name) => {
            (&|word| *word == "--", [format!("benches/{name}.rs"), format!("crates/tinta-geometry/benches/{name}.rs")])
        }
        None => (&is_script, [(*words.iter().find(|word| is_script(word))?).to_owned(), String::new()]),
    };
    let source = paths.iter().find_map(|path| std::fs::read_to_string(root().join(path)).ok())?;
    let own = words.iter().skip_while(|word| !is_name(word)).skip(1);
    let unread = own.filter(|word| word.starts_with("--")).find(|option| !source.contains(**option));
    unread.map(|option| format!("its source reads no {option}"))
}

#[test]
fn every_cargo_and_script_command_in_the_documents_names_what_is_there() {
    let manifests = ["Cargo.toml", "crates/tinta-cli/Cargo.toml", "crates/tinta-lab/Cargo.toml"];
    let manifest: String = manifests.map(|path| std::fs::read_to_string(root().join(path)).unwrap()).concat();
    let mut sources = String::new();
    let mut folders =
        ["tests", "src", "crates/tinta-lab/src", "crates/tinta-geometry"].map(|folder| root().join(folder)).to_vec();
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()) {
            match path.extension() {
                Some(end) if end == "rs" => {
                    sources.push_str(&path.file_stem().unwrap().to_string_lossy());
                    let text = std::fs::read_to_string(&path).unwrap();
                    sources.extend(
                        text.lines()
                            .filter(|line| line.trim_start().starts_with("fn "))
                            .map(|line| format!("{line}\n")),
                    );
                }
                None if path.is_dir() => folders.push(path),
                _ => {}
            }
        }
    }
    let mut checked = 0;
    let mut wrong = Vec::new();
    for (document, text) in documents() {
        for (line, command) in commands(&text) {
            // Words with = before a command set its environment.
            let is_variable = |word: &&str| word.split_once('=').is_some_and(|(name, _)| name.starts_with("TINTA_"));
            let words: Vec<&str> = command.split(' ').skip_while(is_variable).collect();
            let fault = match words.first().copied().unwrap_or_default() {
                "cargo" => cargo_fault(&words, &manifest, &sources).or_else(|| unread_option(&words)),
                python if python.contains("python") => unread_option(&words),
                "scripts/fuzz" => words[1..]
                    .iter()
                    .filter(|word| word.parse::<u64>().is_err())
                    .find(|word| !root().join(format!("fuzz/fuzz_targets/{word}.rs")).exists())
                    .map(|word| format!("there is no fuzz target {word}")),
                script if script.starts_with("scripts/") => {
                    let is_there = root().join(script).is_file();
                    if is_there { unread_option(&words) } else { Some(format!("there is no {script}")) }
                }
                _ => continue,
            };
            checked += 1;
            wrong.extend(fault.map(|fault| format!("{}:{line}: {command}: {fault}", document.display())));
        }
    }
    fail_with(wrong);
    assert!(checked > 20, "only {checked} commands were found");
    for command in
        ["cargo bench --bench none", "cargo run --example none", "cargo frobnicate", "cargo test no_such_name"]
    {
        assert!(
            cargo_fault(&command.split(' ').collect::<Vec<_>>(), &manifest, &sources).is_some(),
            "{command} was taken"
        );
    }
    for command in
        ["cargo bench --bench lines -- --none 3", "python3 benches/league/run.py --none", "scripts/pages --none"]
    {
        assert!(unread_option(&command.split(' ').collect::<Vec<_>>()).is_some(), "{command} was taken");
    }
}

#[test]
fn every_option_named_in_the_documents_exists() {
    let help = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_tinta")).args(words).arg("--help").output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let all = help(&[]);
    // A command starts two blanks from the margin; its description continues farther right.
    let lines = all.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let commands = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).filter(|word| !word.is_empty());
    let known: String = commands.map(|command| help(&[command])).collect();
    assert!(known.matches("--").count() > 100, "the help pages were not found");
    for (document, text) in documents() {
        for line in text.lines().filter(|line| line.contains("tinta ")) {
            for option in line.split([' ', '`']).filter(|word| word.starts_with("--") && word.len() > 2) {
                let option = option.trim_end_matches([',', '.', ';', ':', ')']);
                let named = option.split('=').next().unwrap_or(option);
                let is_cargos =
                    ["--no-default-features", "--features", "--locked", "--release", "--example", "--bench"]
                        .contains(&named);
                assert!(
                    known.contains(named) || named == "--help" || is_cargos,
                    "{}: {named} in {line:?}",
                    document.display()
                );
            }
        }
    }
}

#[test]
fn the_limits_are_documented_as_they_are() {
    use tinta::limits::*;
    let limits = [
        ("MEMORY_FACTOR", MEMORY_FACTOR as u64),
        ("MEMORY_SLACK_BYTES", MEMORY_SLACK_BYTES as u64),
        ("COPIES_BYTES", COPIES_BYTES),
        ("MODEL_BYTES", MODEL_BYTES),
        ("MATERIAL_FILE_BYTES", MATERIAL_FILE_BYTES),
        ("DRAWING_BYTES", DRAWING_BYTES),
        ("PICTURE_FILE_BYTES", PICTURE_FILE_BYTES),
        ("ROWS_BYTES", ROWS_BYTES),
        ("BATCH_BYTES", BATCH_BYTES),
        ("HATCH_STROKES", HATCH_STROKES as u64),
        ("JOB_BYTES", JOB_BYTES as u64),
        ("LABEL_CHARACTERS", LABEL_CHARACTERS as u64),
        ("PICTURE_SIDE_PX", u64::from(PICTURE_SIDE_PX)),
        ("PICTURE_BYTES", PICTURE_BYTES),
        ("MODEL_PICTURES_BYTES", MODEL_PICTURES_BYTES),
        ("PIXELS_A_BYTE", PIXELS_A_BYTE),
        ("TRIANGLES", TRIANGLES as u64),
        ("CONCAVE_CORNERS", CONCAVE_CORNERS as u64),
        ("CROSSING_CORNERS", CROSSING_CORNERS as u64),
        ("PLY_HEADER_BYTES", PLY_HEADER_BYTES as u64),
        ("FACE_COLORS", FACE_COLORS as u64),
        ("MATERIALS", MATERIALS as u64),
        ("MATERIAL_FILES", MATERIAL_FILES as u64),
        ("NODE_LEVELS", NODE_LEVELS as u64),
        ("PLACES", PLACES as u64),
        ("UNPACKED_FACTOR", UNPACKED_FACTOR as u64),
        ("SKINS", SKINS as u64),
        ("REMARKS", REMARKS as u64),
        ("SHOWN_CHARACTERS", SHOWN_CHARACTERS as u64),
        ("DRAWN_PIXELS", DRAWN_PIXELS as u64),
        ("DRAWN_AT_ONCE_PIXELS", DRAWN_AT_ONCE_PIXELS as u64),
        ("TILE_SIDE_PX", u64::from(TILE_SIDE_PX)),
    ];
    let source = std::fs::read_to_string(root().join("crates/tinta-geometry/src/limits.rs")).unwrap();
    assert_eq!(source.matches("pub const ").count(), limits.len(), "a limit that this test does not know");
    let document = std::fs::read_to_string(root().join("docs/dev/limits.md")).unwrap();
    for (name, value) in limits {
        // | `NAME` | 64 MiB | why |
        let row = document.lines().find_map(|line| line.strip_prefix(&format!("| `{name}` | "))).expect(name);
        let cell = row.split(" |").next().unwrap();
        let (number, unit) = cell.split_once(' ').unwrap_or((cell, ""));
        let number: u64 = number.replace(',', "").parse().expect(row);
        let documented = match unit {
            "GiB" => number << 30,
            "MiB" => number << 20,
            "KiB" => number << 10,
            _ => number,
        };
        assert_eq!(documented, value, "{name}: {row}");
    }
}

#[test]
fn every_public_module_has_an_example_that_is_compiled() {
    let mut modules = Vec::new();
    for folder in ["src", "crates/tinta-geometry/src", "crates/tinta-lab/src"] {
        let library = std::fs::read_to_string(root().join(folder).join("lib.rs")).unwrap();
        let lines: Vec<&str> = library.lines().collect();
        let public = lines.windows(2).filter(|pair| pair[0] != "#[doc(hidden)]");
        let names = public.filter_map(|pair| pair[1].strip_prefix("pub mod ")?.strip_suffix(';'));
        modules.extend(names.map(|name| format!("{folder}/{name}.rs")));
    }
    assert!(modules.len() > 20, "only {modules:?} were found");
    for module in modules {
        let text = std::fs::read_to_string(root().join(&module)).unwrap();
        let mut head = text.lines().take_while(|line| line.starts_with("//!"));
        let is_compiled = |line: &str| matches!(line, "//! ```" | "//! ```no_run");
        assert!(head.any(is_compiled), "src/{module}.rs has no example in its first lines");
    }
}
