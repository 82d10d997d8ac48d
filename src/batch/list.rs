//! The list of a batch's jobs, a line each; blank lines are passed over.

use super::job::Job;
use super::named_outputs::{NamedOutput, first_conflict};
use super::slice::Slice;
use crate::error::{Error, FileKind, Result};
use crate::files;
use crate::limits::BATCH_BYTES;
use std::path::Path;

/// Jobs in the order of their list, without repeated output files. All lines are checked, but each becomes a job only
/// when needed: a run may do a thousand of a million.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct List {
    /// How many jobs there are.
    pub count: usize,
    /// The file's bytes.
    bytes: Vec<u8>,
}

impl List {
    /// Reads a list's bytes; `name` is its name in errors.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the line that is invalid, or that has an output of another.
    pub fn of_bytes(bytes: Vec<u8>, name: &str) -> Result<Self> {
        let refused = |line: Option<u64>, problem: String| Error::file(FileKind::Batch, name, problem).at(line);
        let (mut count, mut outputs) = (0, Vec::new());
        for (line, text) in lines(&bytes) {
            let job = Job { line, ..Job::parse(text).map_err(|problem| refused(Some(line), problem))? };
            outputs.extend(NamedOutput::all(&job));
            count += 1;
        }
        match first_conflict(outputs) {
            Some((line, problem)) => Err(refused(Some(line), problem)),
            None if count == 0 => Err(refused(None, "it holds no job; write one per line".to_owned())),
            None => Ok(Self { count, bytes }),
        }
    }

    /// The jobs of a slice, in their order.
    pub fn jobs(&self, slice: Slice) -> impl Iterator<Item = Job> {
        let lines = lines(&self.bytes).enumerate().filter(move |(place, _)| slice.has(*place));
        // Every line has been checked.
        lines.filter_map(|(_, (line, text))| Job::parse(text).ok().map(|job| Job { line, ..job }))
    }
}

/// Reads a list's file, which [`List::of_bytes`] understands.
///
/// # Errors
///
/// [`Error::File`] if it cannot be read.
pub(crate) fn read_list(path: &Path) -> Result<Vec<u8>> {
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
    fn outputs_that_are_there_twice_are_refused_with_both_lines() {
        let said = |text: &str| list(text).unwrap_err().to_string();
        let twice = said(&format!("{}\n\n{}\n", job("a", "x/a.png"), job("b", "./x//a.png")));
        assert_eq!(
            twice,
            "jobs.jsonl: line 3: output: ./x//a.png would also be written by line 1, as x/a.png; name another"
        );
        // The first such line of the list, whichever name it repeats. An id may be repeated.
        let lines = [job("a", "a.png"), job("b", "b.png"), job("a", "./b.png"), job("b", "d.png"), job("a", "a.png")];
        let twice = said(&lines.join("\n"));
        assert_eq!(
            twice,
            "jobs.jsonl: line 3: output: ./b.png would also be written by line 2, as b.png; name another"
        );
        assert_eq!(list(&[&lines[..2], &lines[3..4]].concat().join("\n")).unwrap().count, 3);
        let twice = said(r#"{"output": "a", "dump": "./a"}"#);
        assert_eq!(twice, "jobs.jsonl: line 1: dump: ./a would also be written by line 1, as a; name another");
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
                "jobs.jsonl: line {}: output: shared/{other}036.png would also be written by line {}, as \
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
    fn a_slice_has_its_own_jobs_with_the_lists_lines() {
        let lines: Vec<String> = (0..10).map(|number| job(&number.to_string(), &format!("{number}.png"))).collect();
        let read = list(&lines.join("\n\n")).unwrap();
        let places: Vec<(String, u64)> =
            read.jobs(Slice { count: 4, number: 3 }).map(|job| (job.id, job.line)).collect();
        assert_eq!(places, [("2".to_owned(), 5), ("6".to_owned(), 13)]);
        assert_eq!(read.count, 10);
    }
}
