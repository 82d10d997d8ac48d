//! The list of a batch's jobs, a line each; blank lines are passed over.

use super::job::{Job, JobValue, OUTPUTS};
use super::place::same_place;
use crate::error::{Error, Result};
use crate::files::{self, shown};
use crate::limits::BATCH_BYTES;
use crate::output::write_whole;
use std::collections::HashMap;
use std::path::Path;

/// The list as a batch keeps it in its folder.
pub const LIST_FILE: &str = "batch-list.jsonl";

/// Jobs in the order of their list, none of the same name, no two with the same output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct List {
    /// The jobs.
    pub jobs: Vec<Job>,
    /// The file's bytes.
    bytes: Vec<u8>,
}

impl List {
    /// Reads a list.
    ///
    /// # Errors
    ///
    /// [`Error::Batch`] with the line that is no job, or that has the name or an output of another.
    pub fn read(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let bytes = files::read(path, BATCH_BYTES)
            .map_err(|failure| refused(&name, None, failure.problem("a list of jobs")))?;
        Self::of_bytes(bytes, &name)
    }

    /// Reads a list's bytes; `name` is what errors call it.
    ///
    /// # Errors
    ///
    /// As [`List::read`].
    pub fn of_bytes(bytes: Vec<u8>, name: &str) -> Result<Self> {
        let mut jobs: Vec<Job> = Vec::new();
        // Name or output, and the line it stands in.
        let (mut names, mut outputs) = (HashMap::<String, u64>::new(), HashMap::<String, u64>::new());
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        for (line, text) in (1..).zip(text.split(|byte| *byte == b'\n')) {
            let text = text.trim_ascii();
            if text.is_empty() {
                continue;
            }
            let job = Job::parse(text).map_err(|problem| refused(name, Some(line), problem))?;
            if let Some(other) = names.insert(job.id.clone(), line) {
                let problem = format!("the id {} is that of line {other} too; give it another", shown(&job.id));
                return Err(refused(name, Some(line), problem));
            }
            for (option, output) in outputs_of(&job) {
                let Some(place) = same_place(output) else { continue };
                if let Some(other) = outputs.insert(place, line) {
                    let problem = format!("{option}: {} is written by line {other} too; name another", shown(output));
                    return Err(refused(name, Some(line), problem));
                }
            }
            jobs.push(Job { line, ..job });
        }
        match jobs.is_empty() {
            true => Err(refused(name, None, "it holds no job; write one a line".to_owned())),
            false => Ok(Self { jobs, bytes }),
        }
    }

    /// Whether both ask for the same, in the same order.
    pub fn is_same(&self, other: &Self) -> bool {
        let content = |list: &Self| -> Vec<(u64, String)> {
            list.jobs.iter().map(|job| (job.line, job.sha256.clone())).collect()
        };
        content(self) == content(other)
    }

    /// Keeps the list in the batch's folder, so that it is known later what belongs to it.
    ///
    /// # Errors
    ///
    /// [`Error::Output`] when it cannot be written.
    pub fn keep(&self, folder: &Path) -> Result<()> {
        write_whole(&folder.join(LIST_FILE), &self.bytes)
    }

    /// The list that a batch's folder keeps; `None` where it keeps none.
    ///
    /// # Errors
    ///
    /// [`Error::Batch`] where it cannot be read.
    pub fn kept(folder: &Path) -> Result<Option<Self>> {
        let path = folder.join(LIST_FILE);
        match path.symlink_metadata() {
            Ok(_) => Self::read(&path).map(Some),
            Err(_) => Ok(None),
        }
    }
}

fn outputs_of(job: &Job) -> impl Iterator<Item = (&str, &str)> {
    job.options.iter().filter_map(|(key, value)| match value {
        JobValue::Text(output) if OUTPUTS.contains(&key.as_str()) => Some((key.as_str(), output.as_str())),
        _ => None,
    })
}

fn refused(name: &str, line: Option<u64>, problem: String) -> Error {
    Error::Batch { path: name.to_owned(), line, problem }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(text: &str) -> Result<List> {
        List::of_bytes(text.as_bytes().to_vec(), "jobs.jsonl")
    }

    fn job(id: &str, output: &str) -> String {
        format!(r#"{{"id": "{id}", "command": "render", "model": "builtin:ant", "output": "{output}"}}"#)
    }

    #[test]
    fn a_mark_at_the_beginning_windows_lines_and_a_million_blank_ones_are_passed_over() {
        let text = format!("\u{feff}{}\r\n\r\n{}{}", job("a", "a.png"), "\n".repeat(1_000_000), job("b", "b.png"));
        let read = list(&text).unwrap();
        let places: Vec<(&str, u64)> = read.jobs.iter().map(|job| (job.id.as_str(), job.line)).collect();
        assert_eq!(places, [("a", 1), ("b", 1_000_003)]);
    }

    #[test]
    fn names_and_outputs_that_are_there_twice_are_refused_with_both_lines() {
        let said = |text: &str| list(text).unwrap_err().to_string();
        let twice = said(&format!("{}\n\n{}\n", job("a", "a.png"), job("a", "b.png")));
        assert_eq!(twice, "jobs.jsonl: line 3: the id a is that of line 1 too; give it another");
        let twice = said(&format!("{}\n{}\n", job("a", "x/a.png"), job("b", "./x//a.png")));
        assert_eq!(twice, "jobs.jsonl: line 2: output: ./x//a.png is written by line 1 too; name another");
        assert_eq!(said("\n \r\n"), "jobs.jsonl: it holds no job; write one a line");
        let bad = said(&format!("{}\nnonsense\n", job("a", "a.png")));
        assert!(bad.starts_with("jobs.jsonl: line 2: this is no job ("), "{bad}");
    }

    #[test]
    fn a_kept_list_is_the_list() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(List::kept(folder.path()).unwrap(), None);
        let one = list(&format!("{}\n", job("a", "a.png"))).unwrap();
        one.keep(folder.path()).unwrap();
        assert!(List::kept(folder.path()).unwrap().unwrap().is_same(&one));
        assert!(!list(&job("a", "b.png")).unwrap().is_same(&one));
    }
}
