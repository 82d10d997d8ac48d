//! The outputs that jobs name, and conflicts between them: files, pictures with numbers in their names, folders.
//!
//! In the order of their paths a folder stands before its contents, and names with the same beginning stand together. One pass
//! over the sorted outputs therefore finds the conflicts of a million jobs in seconds. The price: patterns that begin alike, such
//! as `%d-cow.png` and `%d-ant.png` in one folder, are compared pair by pair.

use super::job::{Job, JobCommand};
use super::output_path::same_place;
use crate::animation::NumberedName;
use crate::files::shown;
use crate::picture::PictureFormat;
use crate::settings::OptionValue;
use std::path::Path;

/// Most pictures of a turntable, and of any animation of unknown length.
const MOST_PICTURES: u32 = 10_000;

/// A file or folder that a job's option names for output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NamedOutput {
    /// The option.
    option: &'static str,
    /// As written in the line.
    output: String,
    /// Its place in the batch's folder.
    place: String,
    kind: Kind,
    /// The job's line.
    line: u64,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    File,
    /// Pictures from 1 to so many.
    Numbered(NumberedName, u32),
    /// With all its contents.
    Folder,
}

impl NamedOutput {
    /// All of a job that [`super::place_in`] does not refuse.
    pub(super) fn all(job: &Job) -> impl Iterator<Item = Self> {
        let turntable = match job.options.get("turntable") {
            Some(OptionValue::Text(count)) => count.parse().unwrap_or(MOST_PICTURES),
            _ => MOST_PICTURES,
        };
        job.outputs().filter_map(move |(option, output)| {
            let place = same_place(output)?;
            let is_picture = PictureFormat::of(Path::new(&place)).is_some();
            let numbered = NumberedName::parse(&place).filter(|_| job.command == JobCommand::Render);
            let kind = match (option, job.command, numbered) {
                ("output", _, Some(name)) => Kind::Numbered(name, turntable.min(MOST_PICTURES)),
                ("output", JobCommand::Measure, _) | ("dump", _, _) => Kind::Folder,
                // Without a slash at the end it is one where a folder of this name is there.
                ("output", JobCommand::Compare, _) if output.ends_with('/') || !is_picture => Kind::Folder,
                _ => Kind::File,
            };
            Some(Self { option, output: output.to_owned(), place, kind, line: job.line })
        })
    }

    fn path(&self) -> &Path {
        Path::new(&self.place)
    }

    fn is_in(&self, folder: &Self) -> bool {
        folder.kind == Kind::Folder && self.path().starts_with(folder.path())
    }

    /// Whether this file, named in the batch's folder, is one of its numbered files.
    fn has_numbered(&self, name: &str) -> bool {
        let Kind::Numbered(numbered, count) = &self.kind else { return false };
        numbered.number_in(name).is_some_and(|number| (1..=*count).contains(&number))
    }

    /// Whether both write a file, at least one of them as a numbered one.
    fn shares(&self, other: &Self) -> bool {
        match (&self.kind, &other.kind) {
            (Kind::Numbered(name, count), Kind::Numbered(other_name, _)) => {
                let [after, other_after] = [name, other_name].map(|name| name.parts().2);
                let are_alike = after.ends_with(other_after) || other_after.ends_with(after);
                are_alike && (1..=*count).any(|number| other.has_numbered(&name.with(number)))
            }
            (Kind::Numbered(..), _) => self.has_numbered(&other.place),
            (_, Kind::Numbered(..)) => other.shares(self),
            _ => false,
        }
    }

    /// Why it and one of an earlier line exclude each other.
    fn problem(&self, before: &Self) -> String {
        let [output, other] = [self, before].map(|named| shown(&named.output));
        format!("{}: {output} would also be written by line {}, as {other}; name another", self.option, before.line)
    }
}

/// Whether all outputs that a job names are there; of numbered pictures the first.
pub(crate) fn are_there(job: &Job, folder: &Path) -> bool {
    NamedOutput::all(job).all(|named| match &named.kind {
        Kind::File => folder.join(&named.place).is_file(),
        Kind::Numbered(name, _) => folder.join(name.with(1)).is_file(),
        Kind::Folder => folder.join(&named.place).is_dir(),
    })
}

/// A line that writes what an earlier one writes, with the reason; of those found, the first in the list.
pub(super) fn first_conflict(mut outputs: Vec<NamedOutput>) -> Option<(u64, String)> {
    outputs.sort_by(|one, other| one.path().cmp(other.path()).then(one.line.cmp(&other.line)));
    let mut pairs: Vec<[&NamedOutput; 2]> = Vec::new();
    let mut folder: Option<&NamedOutput> = None;
    for (place, output) in outputs.iter().enumerate() {
        pairs.extend(outputs[..place].last().filter(|other| other.place == output.place).map(|other| [other, output]));
        match folder.filter(|folder| output.is_in(folder)) {
            // A job's own folder may hold its other files.
            Some(folder) => pairs.extend((folder.line != output.line).then_some([folder, output])),
            None => folder = Some(output).filter(|output| output.kind == Kind::Folder),
        }
        // Two patterns with a common name begin alike: the beginning of one is a beginning of the other.
        if let Kind::Numbered(name, _) = &output.kind {
            let begins = name.parts().0;
            let first = outputs.partition_point(|other| other.path() <= Path::new(begins));
            let mut alike = outputs[first..].iter().take_while(|other| other.place.starts_with(begins));
            let found = alike.find(|other| other.line != output.line && output.shares(other));
            pairs.extend(found.map(|other| [output, other]));
        }
    }
    let pairs = pairs.into_iter().map(|[one, other]| if one.line > other.line { [one, other] } else { [other, one] });
    let [later, before] = pairs.min_by_key(|[later, _]| later.line)?;
    Some((later.line, later.problem(before)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_folders_and_numbered_pictures_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let job = r#"{"output": "f-%02d.png", "turntable": 3, "dump": "./steps", "save-preset": "a.toml"}"#;
        let job = Job::parse(job.as_bytes()).unwrap();
        std::fs::create_dir(at("steps")).unwrap();
        std::fs::write(at("f-01.png"), "").unwrap();
        assert!(!are_there(&job, folder.path()));
        std::fs::write(at("a.toml"), "").unwrap();
        assert!(are_there(&job, folder.path()));
        std::fs::rename(at("f-01.png"), at("f-1.png")).unwrap();
        assert!(!are_there(&job, folder.path()));
    }
}
