//! Remarks: each is said where it is true and not near it, by the table in `remarks.toml`.

use crate::program::{done, said, tinta};
use base64::prelude::{BASE64_STANDARD, Engine};
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A text of the table, or a table in it.
fn entry<'t>(table: &'t DeTable<'_>, key: &str) -> Option<&'t DeValue<'t>> {
    table.iter().find(|(name, _)| name.get_ref().as_ref() == key).map(|(_, value)| value.get_ref())
}

#[test]
fn each_remark_is_said_where_it_is_true_and_not_beside_it() {
    let table = DeTable::parse(include_str!("remarks.toml")).unwrap();
    let Some(DeValue::Array(remarks)) = entry(table.get_ref(), "remark") else { panic!("no remarks") };
    assert!(remarks.len() > 90);
    let mut wrong = Vec::new();
    for remark in remarks.iter() {
        let DeValue::Table(remark) = remark.get_ref() else { panic!("{remark:?}") };
        let text =
            |key: &str| entry(remark, key).and_then(DeValue::as_str).unwrap_or_else(|| panic!("{key}: {remark:?}"));
        let folder = tempfile::tempdir().unwrap();
        for kind in ["files", "base64"] {
            let Some(DeValue::Table(files)) = entry(remark, kind) else { continue };
            for (name, text) in files.iter() {
                let (path, text) = (folder.path().join(name.get_ref().as_ref()), text.get_ref().as_str().unwrap());
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                let bytes = if kind == "files" { text.into() } else { BASE64_STANDARD.decode(text).unwrap() };
                std::fs::write(path, bytes).unwrap();
            }
        }
        let before = entry(remark, "before").and_then(DeValue::as_str);
        before.into_iter().flat_map(str::lines).for_each(|line| drop(run(line, folder.path())));
        for (key, is_true) in [("said", true), ("silent", false)] {
            let said = run(text(key), folder.path());
            if said.contains(text("words")) != is_true {
                wrong.push(format!("{}: {:?}, {key}: {said}", text(key), text("words")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The program's standard error; small pictures, unless a line of `render` gives their size.
fn run(line: &str, folder: &Path) -> String {
    let line = line.replace("{}", folder.to_str().unwrap());
    let mut words: Vec<&str> = line.split(' ').collect();
    if line.starts_with("render") && !line.contains("--size") {
        words.extend(["--size", "48"]);
    }
    let output = tinta(&words);
    // 1 says that files differ, or a job failed.
    assert!(matches!(output.status.code(), Some(0 | 1)), "{line}: {}", said(&output));
    said(&output)
}

#[test]
fn what_changes_nothing_is_said_by_explain_alone() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("a.obj");
    std::fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 1 1 2\nf 1 2 3\n").unwrap();
    let [model, picture, lines] = [model, folder.path().join("a.png"), folder.path().join("a.svg")];
    let counts =
        "a.obj: 1 degenerate triangle, 1 duplicate triangle, 1 unused vertex; this does not change the picture";
    for file in [picture, lines] {
        let line = ["render", model.to_str().unwrap(), "-o", file.to_str().unwrap(), "--size", "16"];
        assert_eq!(said(&done(&line)), "");
        let explained = done(&[&line[..], &["--explain"]].concat());
        assert_eq!(said(&explained), "");
        assert!(String::from_utf8_lossy(&explained.stdout).contains(counts), "{explained:?}");
    }
}
