//! `tinta MODEL…`, without a command: opens a window, or without a display draws a picture beside the model.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use tinta::mesh::is_model_name;

/// Most pictures of one model beside it.
const MOST_PICTURES: usize = 10_000;

/// Adds the implied command to the words, the program's name first; words that name a command stay unchanged. The second value is
/// the picture to draw, if any.
pub(super) fn with_command(words: Vec<OsString>, has_window: bool) -> (Vec<OsString>, Option<PathBuf>) {
    let Some(model) = words.get(1).filter(|word| is_model(word)).cloned() else { return (words, None) };
    let names_output = words.iter().skip(2).any(|word| {
        let word = word.to_string_lossy();
        word == "-o" || word == "--output" || word.starts_with("--output=")
    });
    let (command, output) = match (names_output, has_window) {
        (true, _) => ("render", None),
        (false, true) => ("view", None),
        (false, false) => ("render", Some(free_name(&model))),
    };
    let mut all = words;
    all.insert(1, command.into());
    if let Some(output) = &output {
        all.insert(2, "-o".into());
        all.insert(3, output.clone().into());
    }
    (all, output)
}

/// Whether a word can only be a model: a built-in one, or a file name with a model's ending.
pub(super) fn is_model(word: &OsStr) -> bool {
    let text = word.to_string_lossy();
    text.starts_with("builtin:") || is_model_name(&text)
}

/// A new picture name beside the model.
fn free_name(model: &OsStr) -> PathBuf {
    let text = model.to_string_lossy();
    let path = text.strip_prefix("builtin:").map_or_else(|| PathBuf::from(model), PathBuf::from);
    let stem = path.file_stem().unwrap_or(OsStr::new("picture")).to_owned();
    let named = |number: usize| {
        let mut name = stem.clone();
        if number > 1 {
            name.push(format!("-{number}"));
        }
        name.push(".png");
        path.with_file_name(name)
    };
    (1..MOST_PICTURES).map(named).find(|path| !path.exists()).unwrap_or_else(|| named(MOST_PICTURES))
}

/// Whether a window can be opened here.
pub(super) fn has_window() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(feature = "window") && (!cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"))
}

/// The message with the automatic name of a picture.
pub(super) fn said(picture: &Path) -> String {
    format!("{}\n", picture.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meant(words: &[&str], has_window: bool) -> Vec<String> {
        let (words, _) = with_command(words.iter().map(OsString::from).collect(), has_window);
        words.iter().map(|word| word.to_string_lossy().into_owned()).collect()
    }

    #[test]
    fn a_model_alone_opens_a_window_or_is_drawn_beside_itself() {
        assert_eq!(
            meant(&["tinta", "cow.OBJ", "--style", "ink"], true),
            ["tinta", "view", "cow.OBJ", "--style", "ink"]
        );
        assert_eq!(
            meant(&["tinta", "a/b.c/cow.obj"], false),
            ["tinta", "render", "-o", "a/b.c/cow.png", "a/b.c/cow.obj"]
        );
        assert_eq!(meant(&["tinta", "builtin:bust"], false), ["tinta", "render", "-o", "bust.png", "builtin:bust"]);
        assert_eq!(meant(&["tinta", "cow.obj", "-o", "x.svg"], true), ["tinta", "render", "cow.obj", "-o", "x.svg"]);
    }

    #[test]
    fn what_is_no_model_stays_as_it_is() {
        for words in [
            &["tinta"][..],
            &["tinta", "render", "a.obj"],
            &["tinta", "redner"],
            &["tinta", "--help"],
            &["tinta", "a.png"],
        ] {
            assert_eq!(meant(words, true), words);
        }
    }

    #[test]
    fn a_picture_that_is_there_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let model = folder.path().join("cow.stl");
        assert_eq!(free_name(model.as_os_str()), folder.path().join("cow.png"));
        std::fs::write(folder.path().join("cow.png"), "kept").unwrap();
        assert_eq!(free_name(model.as_os_str()), folder.path().join("cow-2.png"));
        std::fs::write(folder.path().join("cow-2.png"), "kept").unwrap();
        assert_eq!(free_name(model.as_os_str()), folder.path().join("cow-3.png"));
    }
}
