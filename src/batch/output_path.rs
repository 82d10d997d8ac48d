//! Output paths of jobs: always inside the batch's own folder.

use std::path::{Component, Path, PathBuf};

/// Returns the place in `folder` that a job's output names. A final `/`, which marks a folder, stays.
///
/// # Errors
///
/// A sentence for an output that is empty, standard output, absolute, outside the folder or one of the batch's files.
pub fn place_in(folder: &Path, output: &str) -> Result<PathBuf, String> {
    let Some(names) = names(output) else {
        return Err(match output {
            "" => "it is empty; name a file".to_owned(),
            "-" => "a job has no standard output; name a file".to_owned(),
            _ => "a job writes in the batch's folder; give a name without .. that is not absolute".to_owned(),
        });
    };
    if names.first().is_some_and(|first| first.starts_with("batch-") && first.ends_with(".jsonl")) {
        return Err("the batch's own files have such names; give it another".to_owned());
    }
    let mut place = folder.to_path_buf();
    place.extend(&names);
    if output.ends_with(['/', std::path::MAIN_SEPARATOR]) {
        place.push("");
    }
    Ok(place)
}

/// The output's normalised name, equal for equal places; `None` where [`place_in`] refuses it.
pub(super) fn same_place(output: &str) -> Option<String> {
    names(output).map(|names| names.join("/"))
}

fn names(output: &str) -> Option<Vec<&str>> {
    let mut names = Vec::new();
    for component in Path::new(output).components() {
        match component {
            Component::Normal(name) => names.push(name.to_str()?),
            Component::CurDir => {}
            Component::ParentDir | Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    (output != "-" && !names.is_empty()).then_some(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_lie_in_the_folder_or_are_refused() {
        let folder = Path::new("out");
        for (output, place) in
            [("a.png", "out/a.png"), ("./b/./a.png", "out/b/a.png"), ("b/", "out/b/"), ("a..b", "out/a..b")]
        {
            assert_eq!(place_in(folder, output).unwrap().to_str(), Some(place));
        }
        for output in [
            "",
            "-",
            ".",
            "..",
            "../a.png",
            "a/../../b.png",
            "a/..",
            "/tmp/a.png",
            "batch-list.jsonl",
            "batch-1-of-1.jsonl",
        ] {
            assert!(place_in(folder, output).is_err(), "{output}");
        }
        assert!(place_in(folder, "batch.png").is_ok());
        assert_eq!(same_place("./a//b/"), same_place("a/b"));
        assert_ne!(same_place("a/b"), same_place("a/c"));
    }
}
