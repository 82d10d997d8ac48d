//! Protects input files from being overwritten: a model, its pictures, a preset, a camera's file.

use std::path::{Path, PathBuf};
use tinta::request::files_named;
use tinta::settings::Options;
use tinta::{Error, Result};

/// The files that a command reads, as far as the command line names them.
#[derive(Debug)]
pub struct Inputs(Vec<(&'static str, PathBuf)>);

impl Inputs {
    /// The models, the files that options name, and presets, a camera's file among them.
    pub fn new(models: &[String], options: &Options, presets: &[&str]) -> Self {
        let models = models.iter().map(|model| ("model", PathBuf::from(model)));
        let presets = presets.iter().map(|preset| ("preset", PathBuf::from(preset)));
        Self(models.chain(files_named(options)).chain(presets).collect())
    }

    /// Pictures that models name, known once these are read.
    pub(super) fn of_pictures(pictures: impl Iterator<Item = PathBuf>) -> Self {
        Self(pictures.map(|picture| ("model's picture", picture)).collect())
    }

    /// Refuses to overwrite any of them; a numbered output such as `frame-%04d.png` stands for all of its pictures.
    pub fn keep(&self, output: &str) -> Result<()> {
        let is_it = |input: &Path| match output.split_once('%') {
            None => same(Path::new(output), input),
            Some((before, after)) => is_numbered(before, after, input),
        };
        match self.0.iter().find(|(_, input)| is_it(input)) {
            None => Ok(()),
            Some((what, _)) => {
                Err(Error::output(output, format!("this would overwrite the {what}; name another file")))
            }
        }
    }

    /// The same of files in a folder.
    pub fn keep_in<'a>(&self, folder: &Path, names: impl IntoIterator<Item = &'a str>) -> Result<()> {
        names.into_iter().try_for_each(|name| self.keep(&folder.join(name).to_string_lossy()))
    }
}

/// Whether both paths are one file.
fn same(output: &Path, input: &Path) -> bool {
    output.canonicalize().is_ok_and(|output| input.canonicalize().is_ok_and(|input| input == output))
}

/// Whether a file name may be `before`, a number, and the part of `after` behind its `d`.
fn is_numbered(before: &str, after: &str, input: &Path) -> bool {
    let end = after.split_once('d').map_or("", |(_, end)| end);
    let pattern = Path::new(before);
    let (folder, start) = match before.ends_with('/') {
        true => (pattern, ""),
        false => (
            pattern.parent().unwrap_or(Path::new("")),
            pattern.file_name().and_then(|name| name.to_str()).unwrap_or_default(),
        ),
    };
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let Some(name) = input.file_name().and_then(|name| name.to_str()) else { return false };
    let number = name.strip_prefix(start).and_then(|name| name.strip_suffix(end));
    let is_number =
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()));
    is_number && same(&folder.join(name), input)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::settings::OptionValue;

    #[test]
    fn inputs_are_kept_by_whatever_name_they_would_be_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        for name in ["model.png", "skin.png", "frame-0007.png", "frame-x.png"] {
            std::fs::write(at(name), "kept").unwrap();
        }
        let options = Options::from([("skin".to_owned(), OptionValue::text(at("skin.png")))]);
        let inputs = Inputs::new(&[at("model.png"), at("frame-0007.png"), "builtin:bust".to_owned()], &options, &[]);
        for output in ["model.png", "./model.png", "skin.png", "frame-%04d.png", "frame-%d.png"] {
            let message = inputs.keep(&at(output)).unwrap_err().to_string();
            assert!(message.contains("this would overwrite the "), "{output}: {message}");
        }
        for output in ["other.png", "frame-x.png", "frame-x%d.png", "frame-%d.ppm"] {
            inputs.keep(&at(output)).unwrap();
        }
        assert!(inputs.keep_in(folder.path(), ["a.png", "skin.png"]).is_err());
        inputs.keep_in(folder.path(), ["a.png"]).unwrap();
    }
}
