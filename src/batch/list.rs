//! The list of a batch's jobs, a line each; blank lines are passed over.

use super::job::Job;
use super::named_outputs::{NamedOutput, first_conflict};
use super::slice::Slice;
use crate::error::{Error, FileKind, Result};
use crate::files::{self, shown};
use crate::limits::BATCH_BYTES;
use crate::output::write_whole;
use std::collections::HashMap;
use std::path::Path;

/// The list as a batch keeps it in its folder.
pub(super) const LIST_FILE: &str = "batch-list.jsonl";

/// Jobs in the order of their list, without repeated names or output files. All lines are checked, but each becomes a job only
/// when needed: a run may do a thousand of a million.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct List {
    /// How many jobs there are.
    pub count: usize,
    /// The file's bytes.
    bytes: Vec<u8>,
}

impl List {
    /// Reads a list.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the line that is invalid, or that has the name or an output of another.
    pub fn read(path: &Path) -> Result<Self> {
        Self::of_bytes(read_list(path)?, &path.display().to_string())
    }

    /// Reads a list's bytes for a batch's folder, and says whether the list kept there has the same jobs in the same lines; `None`
    /// if the folder keeps none.
    ///
    /// # Errors
    ///
    /// As [`List::read`].
    pub fn for_folder(bytes: Vec<u8>, name: &str, folder: &Path) -> Result<(Self, Option<bool>)> {
        let path = folder.join(LIST_FILE);
        let kept = path.symlink_metadata().ok().map(|_| read_list(&path)).transpose()?;
        // Nearly always the very same file, which was checked when it was kept: the slices of a long list begin at once.
        if kept.as_ref() == Some(&bytes) {
            return Ok((Self { count: lines(&bytes).count(), bytes }, Some(true)));
        }
        let list = Self::of_bytes(bytes, name)?;
        let kept = kept.map(|kept| Self::of_bytes(kept, &path.display().to_string())).transpose()?;
        let content = |list: &Self| list.jobs(Slice::WHOLE).map(|job| (job.line, job.sha256)).collect::<Vec<_>>();
        let is_kept = kept.map(|kept| content(&kept) == content(&list));
        Ok((list, is_kept))
    }

    /// Reads a list's bytes; `name` is its name in errors.
    ///
    /// # Errors
    ///
    /// As [`List::read`].
    pub fn of_bytes(bytes: Vec<u8>, name: &str) -> Result<Self> {
        let refused = |line: Option<u64>, problem: String| Error::file(FileKind::Batch, name, problem).at(line);
        let (mut ids, mut outputs, mut twice) = (HashMap::new(), Vec::new(), None);
        for (line, text) in lines(&bytes) {
            let job = Job { line, ..Job::parse(text).map_err(|problem| refused(Some(line), problem))? };
            outputs.extend(NamedOutput::all(&job));
            if let (Some(before), None) = (ids.insert(job.id.clone(), line), &twice) {
                let id = shown(&job.id);
                twice = Some((line, format!("the id {id} is already used by line {before}; choose another")));
            }
        }
        match twice.into_iter().chain(first_conflict(outputs)).min_by_key(|(line, _)| *line) {
            Some((line, problem)) => Err(refused(Some(line), problem)),
            None if ids.is_empty() => Err(refused(None, "it holds no job; write one per line".to_owned())),
            None => Ok(Self { count: ids.len(), bytes }),
        }
    }

    /// The jobs of a slice, in their order.
    pub fn jobs(&self, slice: Slice) -> impl Iterator<Item = Job> {
        let lines = lines(&self.bytes).enumerate().filter(move |(place, _)| slice.has(*place));
        // Every line has been checked.
        lines.filter_map(|(_, (line, text))| Job::parse(text).ok().map(|job| Job { line, ..job }))
    }

    /// Keeps the list in the batch's folder as the record of its jobs.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when it cannot be written.
    pub fn keep(&self, folder: &Path) -> Result<()> {
        write_whole(&folder.join(LIST_FILE), &self.bytes)
    }
}

/// Reads a list's file, which [`List::of_bytes`] understands.
///
/// # Errors
///
/// [`Error::File`] if it cannot be read.
pub fn read_list(path: &Path) -> Result<Vec<u8>> {
    files::read(path, BATCH_BYTES).map_err(|failure| failure.into_error(FileKind::Batch, path, "a list of jobs"))
}

/// The lines that are not blank, with their numbers.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (u64, &[u8])> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    (1..).zip(lines).filter(|(_, text)| !text.is_empty())
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
        let places: Vec<(String, u64)> = read.jobs(Slice::WHOLE).map(|job| (job.id, job.line)).collect();
        assert_eq!(places, [("a".to_owned(), 1), ("b".to_owned(), 1_000_003)]);
    }

    #[test]
    fn names_and_outputs_that_are_there_twice_are_refused_with_both_lines() {
        let said = |text: &str| list(text).unwrap_err().to_string();
        let twice = said(&format!("{}\n\n{}\n", job("a", "a.png"), job("a", "b.png")));
        assert_eq!(twice, "jobs.jsonl: line 3: the id a is already used by line 1; choose another");
        let twice = said(&format!("{}\n{}\n", job("a", "x/a.png"), job("b", "./x//a.png")));
        assert_eq!(twice, "jobs.jsonl: line 2: output: ./x//a.png is also written by line 1; name another");
        // The first such line of the list, whichever name it repeats.
        let lines = [job("a", "a.png"), job("b", "b.png"), job("c", "./a.png"), job("b", "d.png"), job("a", "e.png")];
        let twice = said(&lines.join("\n"));
        assert_eq!(twice, "jobs.jsonl: line 3: output: ./a.png is also written by line 1; name another");
        let twice = said(&[&lines[..2], &lines[3..]].concat().join("\n"));
        assert_eq!(twice, "jobs.jsonl: line 3: the id b is already used by line 2; choose another");
        let twice = said(r#"{"id": "a", "command": "render", "output": "a", "dump": "./a"}"#);
        assert_eq!(twice, "jobs.jsonl: line 1: dump: ./a is also written by line 1; name another");
        assert_eq!(said("\n \r\n"), "jobs.jsonl: it holds no job; write one per line");
        let bad = said(&format!("{}\nnonsense\n", job("a", "a.png")));
        assert!(bad.starts_with("jobs.jsonl: line 2: this is not a job ("), "{bad}");
    }

    /// A render, a turntable or a measurement, and all that it writes: files, or a folder with a slash at the end.
    fn job_with_outputs(
        number: usize,
        (kind, before, width, after, count): (u8, &str, &str, &str, u32),
    ) -> (String, Vec<String>) {
        let digits = |number: u32| if width == "%d" { number.to_string() } else { format!("{number:02}") };
        let line = |command: &str, output: &str| {
            format!(r#"{{"id": "{number}", "command": "{command}", "output": "{output}", "turntable": {count}}}"#)
        };
        match kind {
            0 => {
                let name = format!("{before}{}{after}", digits(count * 3));
                (line("render", &name), vec![name])
            }
            1 => {
                let names = (1..=count).map(|number| format!("{before}{}{after}", digits(number))).collect();
                (line("render", &format!("{before}{width}{after}")), names)
            }
            _ => (line("measure", &format!("{before}y")), vec![format!("{before}y/")]),
        }
    }

    proptest::proptest! {
        #![proptest_config(proptest::test_runner::Config { cases: 5_000, failure_persistence: None, ..Default::default() })]

        #[test]
        fn a_list_is_refused_just_where_the_names_of_two_jobs_meet(jobs in proptest::collection::vec((
            0u8..3,
            proptest::sample::select(&["", "1", "a", "a1", "y/", "y/y/2"][..]),
            proptest::sample::select(&["%d", "%02d"][..]),
            proptest::sample::select(&[".png", "0.png", "1b2.png"][..]),
            1u32..40,
        ), 1..5)) {
            let jobs: Vec<(String, Vec<String>)> =
                jobs.into_iter().enumerate().map(|(number, job)| job_with_outputs(number, job)).collect();
            let meet = |one: &String, other: &String| {
                one == other || one.ends_with('/') && other.starts_with(one) || other.ends_with('/') && one.starts_with(other)
            };
            let mut pairs = jobs.iter().enumerate().flat_map(|(place, job)| jobs[..place].iter().map(move |other| (job, other)));
            let expected = pairs.any(|(one, other)| one.1.iter().any(|name| other.1.iter().any(|other| meet(name, other))));
            let lines: Vec<&str> = jobs.iter().map(|(line, _)| line.as_str()).collect();
            let read = list(&lines.join("\n"));
            proptest::prop_assert_eq!(read.is_err(), expected, "{:?}: {:?}", lines, read.err().map(|error| error.to_string()));
        }
    }

    fn check_long_list(count: usize) {
        let line = |number: usize| match number % 4 {
            0 => format!(r#"{{"id": {number}, "command": "render", "output": "t{number}-%02d.png", "turntable": 36}}"#),
            1 => format!(
                r#"{{"id": {number}, "command": "render", "output": "shared/{number}%03d.png", "turntable": 36}}"#
            ),
            2 => format!(r#"{{"id": {number}, "command": "measure", "output": "m/{number}"}}"#),
            _ => format!(r#"{{"id": {number}, "command": "render", "output": "p/{number}/2026-11-22.png"}}"#),
        };
        let mut lines: Vec<String> = (0..count).map(line).collect();
        assert_eq!(list(&lines.join("\n")).unwrap().count, count);
        let other = count / 2 + 1;
        lines.push(format!(r#"{{"id": "last", "command": "render", "output": "shared/{other}036.png"}}"#));
        assert_eq!(
            list(&lines.join("\n")).unwrap_err().to_string(),
            format!(
                "jobs.jsonl: line {}: output: shared/{other}036.png is also written by line {}, as one of \
                 shared/{other}%03d.png; name another",
                count + 1,
                other + 1
            )
        );
    }

    #[test]
    fn a_list_of_turntables_pictures_and_folders_is_checked_without_comparing_all_of_them() {
        check_long_list(8000);
    }

    #[test]
    #[ignore = "exhaustive: a list of 100,000 jobs"]
    fn a_long_list_of_turntables_pictures_and_folders_is_checked_without_comparing_all_of_them() {
        check_long_list(100_000);
    }

    #[test]
    fn a_kept_list_is_the_list() {
        let folder = tempfile::tempdir().unwrap();
        let read =
            |text: &str, folder: &Path| List::for_folder(text.as_bytes().to_vec(), "jobs.jsonl", folder).unwrap();
        let text = format!("{}\n", job("a", "a.png"));
        let (one, is_kept) = read(&text, folder.path());
        assert_eq!((one.count, is_kept), (1, None));
        one.keep(folder.path()).unwrap();
        assert_eq!(List::read(&folder.path().join(LIST_FILE)).unwrap(), one);
        assert_eq!(read(&text, folder.path()), (one, Some(true)));
        // Blanks do not count; other outputs and a different length do.
        assert_eq!(read(&job("a", "a.png"), folder.path()).1, Some(true));
        assert_eq!(read(&format!("{}\n", job("a", "b.png")), folder.path()).1, Some(false));
        assert_eq!(read(&format!("{text}{}", job("b", "b.png")), folder.path()).1, Some(false));
        assert_eq!(read(&text, &folder.path().join("other")).1, None);
    }

    #[test]
    fn a_slice_has_its_own_jobs_with_the_lists_lines() {
        let lines: Vec<String> = (0..10).map(|number| job(&number.to_string(), &format!("{number}.png"))).collect();
        let read = list(&lines.join("\n\n")).unwrap();
        let places: Vec<(String, u64)> =
            read.jobs(Slice { count: 4, number: 3 }).map(|job| (job.id, job.line)).collect();
        assert_eq!(places, [("2".to_owned(), 5), ("6".to_owned(), 13)]);
        assert_eq!(read.count, 10);
    }
}
