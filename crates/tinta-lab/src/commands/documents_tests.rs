//! The commands named in the documents are commands of this program: the test parses each unchanged and runs none.
//!
//! In blocks of code a command must be whole; between backquotes it may lack required parts (`tinta render`), because text there
//! only names it. A command ends where two blanks or a `#` begin an explanation. Commands of other programs are skipped.

use std::path::{Path, PathBuf};

/// A command as a document has it.
struct DocumentCommand {
    document: PathBuf,
    /// 1-based.
    line: usize,
    text: String,
    in_block: bool,
}

fn documents() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    let in_folder = |folder: &str| {
        let files = std::fs::read_dir(root.join(folder)).into_iter().flatten();
        files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
    };
    let mut paths: Vec<PathBuf> =
        [".", "docs", "docs/guide", "docs/results", "docs/texts", "docs/dev", "models", "contrib", "fuzz"]
            .into_iter()
            .flat_map(|folder| -> Vec<PathBuf> { in_folder(folder) })
            .collect();
    paths.sort();
    paths
}

/// All commands of a document that begin with this program's name, or reach it through cargo.
fn commands(document: &Path) -> Vec<DocumentCommand> {
    let text = std::fs::read_to_string(document).unwrap();
    let mut all = Vec::new();
    let mut is_fenced = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            is_fenced = !is_fenced;
            continue;
        }
        let mut add = |command: &str, in_block: bool| {
            let command = command.trim().trim_start_matches("$ ").trim_start_matches("time ");
            let command = command.split(" #").next().unwrap().split("  ").next().unwrap().trim();
            let through_cargo =
                command.starts_with("cargo run") && !command.contains("--example") && command.contains(" -- ");
            let own = if through_cargo {
                command.split_once(" -- ").map(|(_, words)| format!("tinta {words}"))
            } else {
                None
            };
            let own = own.or_else(|| {
                (command == "tinta" || command.starts_with("tinta ") && !command.starts_with("tinta = "))
                    .then(|| command.to_owned())
            });
            if let Some(text) = own {
                all.push(DocumentCommand { document: document.to_owned(), line: number + 1, text, in_block });
            }
        };
        if is_fenced || line.starts_with("    ") {
            add(line, true);
        } else {
            line.split('`').skip(1).step_by(2).for_each(|span| add(span, false));
        }
    }
    all
}

/// The words as a shell splits them, up to the first shell syntax.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for letter in command.chars() {
        match (quote, letter) {
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            (None, ' ') => words.push(String::new()),
            _ => words.last_mut().unwrap().push(letter),
        }
    }
    words.retain(|word| !word.is_empty());
    let end = words.iter().position(|word| [">", ">>", "<", "|", "&&", ";"].contains(&word.as_str()));
    words.truncate(end.unwrap_or(words.len()));
    words
}

#[test]
fn every_command_in_the_documents_is_one() {
    let mut checked = 0;
    let mut wrong = Vec::new();
    for named in documents().iter().flat_map(|document| commands(document)) {
        checked += 1;
        let words: Vec<std::ffi::OsString> = words(&named.text).iter().map(Into::into).collect();
        let Err(sentence) = super::program().check(words) else { continue };
        let lacks_something =
            ["missing", "required arguments were not provided"].iter().any(|said| sentence.contains(said));
        if named.in_block || !lacks_something {
            wrong.push(format!("{}:{}: {}: {sentence}", named.document.display(), named.line, named.text));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
    assert!(checked > 150, "only {checked} commands were found");
}

#[test]
fn commands_are_found_where_they_stand_and_split_as_by_a_shell() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.md");
    let text = "Say `tinta render` or `cargo build`.\n\n    tinta edges a.obj     counts\n\n```\n$ time tinta info # now\n\
                cargo run --release -- view\ncargo run --example x -- y\n```\n";
    std::fs::write(&page, text).unwrap();
    let found: Vec<_> = commands(&page).into_iter().map(|named| (named.line, named.text, named.in_block)).collect();
    let expected =
        [(1, "tinta render", false), (3, "tinta edges a.obj", true), (6, "tinta info", true), (7, "tinta view", true)];
    assert_eq!(found, expected.map(|(line, text, in_block)| (line, text.to_owned(), in_block)));
    assert_eq!(
        words("tinta render 'a b.obj' --color \"rgb(1 2 3)\""),
        ["tinta", "render", "a b.obj", "--color", "rgb(1 2 3)"]
    );
}
