//! The list of a batch's jobs, a line each; blank lines are passed over.

use super::job::{Asked, Job};
use super::named_outputs::{Key, Lines, NamedOutput, Shared, key, problem};
use super::slice::Slice;
use crate::error::{Error, FileKind, Result};
use crate::files::{self, shown};
use crate::limits::BATCH_BYTES;
use crate::output::write_whole;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The list as a batch keeps it in its folder.
pub const LIST_FILE: &str = "batch-list.jsonl";

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
        let name = path.display().to_string();
        let bytes = files::read(path, BATCH_BYTES)
            .map_err(|failure| failure.into_error(FileKind::Batch, path, "a list of jobs"))?;
        Self::of_bytes(bytes, &name)
    }

    /// Reads a list's bytes; `name` is its name in errors.
    ///
    /// # Errors
    ///
    /// As [`List::read`].
    pub fn of_bytes(bytes: Vec<u8>, name: &str) -> Result<Self> {
        let mut list = Self { count: 0, bytes };
        let (mut ids, mut outputs, mut shared) = (Seen::default(), Seen::default(), Shared::default());
        for (line, text) in list.lines() {
            let asked = Asked::of_line(text).map_err(|problem| refused(name, Some(line), problem))?;
            ids.add(&asked.id, line);
            for named in NamedOutput::all(&asked) {
                outputs.add(named.place(), line);
                shared.note(&named, in_32_bits(line));
            }
        }
        list.count = ids.0.len();
        let id = ids.first_twice();
        let suspects = outputs.first_twice().into_iter().chain(list.suspects(shared));
        let output = suspects.filter_map(|lines| Some((lines, list.clash(lines)?))).min_by_key(|((line, _), _)| *line);
        match (id, output) {
            (Some(id), output) if output.as_ref().is_none_or(|((line, _), _)| id.0 <= *line) => {
                Err(list.refuse_id(name, id))
            }
            (_, Some(((line, _), problem))) => Err(refused(name, Some(line.into()), problem)),
            _ if list.count == 0 => Err(refused(name, None, "it holds no job; write one per line".to_owned())),
            _ => Ok(list),
        }
    }

    /// The jobs of a slice, in their order.
    pub fn jobs(&self, slice: Slice) -> impl Iterator<Item = Job> {
        let lines = self.lines().enumerate().filter(move |(place, _)| slice.has(*place));
        // Every line has been checked.
        lines.filter_map(|(_, (line, text))| Job::parse(text).ok().map(|job| Job { line, ..job }))
    }

    /// Whether both ask for the same, in the same order.
    pub fn is_same(&self, other: &Self) -> bool {
        fn content(list: &List) -> impl Iterator<Item = (u64, String)> {
            list.jobs(Slice::WHOLE).map(|job| (job.line, job.sha256))
        }
        self.count == other.count && (self.bytes == other.bytes || content(self).eq(content(other)))
    }

    /// Keeps the list in the batch's folder as the record of its jobs.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when it cannot be written.
    pub fn keep(&self, folder: &Path) -> Result<()> {
        write_whole(&folder.join(LIST_FILE), &self.bytes)
    }

    /// The list kept in a batch's folder; `None` if missing.
    ///
    /// # Errors
    ///
    /// [`Error::File`] if it cannot be read.
    pub fn kept(folder: &Path) -> Result<Option<Self>> {
        let path = folder.join(LIST_FILE);
        match path.symlink_metadata() {
            Ok(_) => Self::read(&path).map(Some),
            Err(_) => Ok(None),
        }
    }

    /// Whether the list kept in a batch's folder has the same jobs; `None` if missing.
    ///
    /// # Errors
    ///
    /// As [`List::kept`].
    pub fn is_kept(&self, folder: &Path) -> Result<Option<bool>> {
        // Nearly always the very same file, which need not be understood again.
        if has_bytes(&folder.join(LIST_FILE), &self.bytes) {
            return Ok(Some(true));
        }
        Ok(Self::kept(folder)?.map(|kept| kept.is_same(self)))
    }

    /// The lines that are not blank, with their numbers.
    fn lines(&self) -> impl Iterator<Item = (u64, &[u8])> {
        let text = self.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&self.bytes);
        let lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
        (1..).zip(lines).filter(|(_, text)| !text.is_empty())
    }

    /// The parsed contents of a checked line.
    fn asked(&self, line: u32) -> Option<Asked> {
        let (_, text) = self.lines().find(|(number, _)| *number == u64::from(line))?;
        Asked::of_line(text).ok()
    }

    fn refuse_id(&self, name: &str, (line, before): Lines) -> Error {
        let id = self.asked(line).map_or_else(String::new, |asked| asked.id);
        let problem = format!("the id {} is already used by line {before}; choose another", shown(&id));
        refused(name, Some(line.into()), problem)
    }

    /// Lines that may write the same file by a number or in a folder; only the first few.
    fn suspects(&self, mut shared: Shared) -> Vec<Lines> {
        if shared.is_empty() {
            return Vec::new();
        }
        shared.sort();
        for (line, text) in self.lines() {
            // Every line has been checked.
            let Ok(asked) = Asked::of_line(text) else { continue };
            NamedOutput::all(&asked).for_each(|named| shared.compare(&named, in_32_bits(line)));
        }
        let mut suspects = shared.suspects();
        suspects.truncate(SUSPECTS);
        suspects
    }

    /// The error for the later of two lines, if both write the same file.
    fn clash(&self, (line, before): Lines) -> Option<String> {
        problem(&self.asked(line)?, &self.asked(before)?, before)
    }
}

/// Number of possibly conflicting lines compared by name; one is enough unless hashes collide.
const SUSPECTS: usize = 8;

/// A list has at most [`BATCH_BYTES`] lines, which 32 bits count.
fn in_32_bits(line: u64) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}

/// Names, or places of outputs, and the lines they stand in: 20 bytes each, however long they are.
#[derive(Default)]
struct Seen(Vec<(Key, u32)>);

impl Seen {
    fn add(&mut self, name: &str, line: u64) {
        self.0.push((key(name), in_32_bits(line)));
    }

    /// The first line that repeats a name of an earlier line, or of itself; then the earlier line.
    fn first_twice(mut self) -> Option<Lines> {
        self.0.sort_unstable();
        let twice = self.0.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        twice.map(|pair| (pair[1].1, pair[0].1)).min_by_key(|(line, _)| *line)
    }
}

/// Whether a file has exactly these bytes; false if it cannot be read.
fn has_bytes(path: &Path, bytes: &[u8]) -> bool {
    // A pipe would be waited for.
    if !path.metadata().is_ok_and(|metadata| metadata.is_file() && metadata.len() == bytes.len() as u64) {
        return false;
    }
    let Ok(mut file) = File::open(path) else { return false };
    let (mut chunk, mut rest) = (vec![0; 1 << 16], bytes);
    loop {
        match file.read(&mut chunk) {
            Ok(0) => return rest.is_empty(),
            Ok(count) => match rest.strip_prefix(&chunk[..count]) {
                Some(after) => rest = after,
                None => return false,
            },
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(_) => return false,
        }
    }
}

fn refused(name: &str, line: Option<u64>, problem: String) -> Error {
    Error::file(FileKind::Batch, name, problem).at(line)
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
        assert_eq!(List::kept(folder.path()).unwrap(), None);
        let one = list(&format!("{}\n", job("a", "a.png"))).unwrap();
        one.keep(folder.path()).unwrap();
        assert!(List::kept(folder.path()).unwrap().unwrap().is_same(&one));
        assert!(!list(&job("a", "b.png")).unwrap().is_same(&one));
        assert_eq!(one.is_kept(folder.path()).unwrap(), Some(true));
        // Blanks do not count; other outputs and a different length do.
        assert_eq!(list(&job("a", "a.png")).unwrap().is_kept(folder.path()).unwrap(), Some(true));
        assert_eq!(list(&format!("{}\n", job("a", "b.png"))).unwrap().is_kept(folder.path()).unwrap(), Some(false));
        assert_eq!(one.is_kept(&folder.path().join("other")).unwrap(), None);
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
