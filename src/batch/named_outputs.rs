//! The outputs that jobs name, and conflicts between them: files, pictures with numbers in their names, folders.
//!
//! Names are kept as hashes and sorted: a list of a million jobs is checked in seconds. A match of hashes is verified by name
//! before the list is refused.

use super::job::{Asked, JobCommand};
use super::output_path::same_place;
use crate::animation::NumberedName;
use crate::files::shown;
use crate::picture::PictureFormat;
use sha2::{Digest, Sha256};
use std::path::Path;

/// Most pictures of a turntable, and of any animation of unknown length.
const MOST_PICTURES: u32 = 10_000;

/// So many last digits are compared as a number; earlier digits are compared as text.
const DIGITS: usize = 9;

/// A file or folder that a job's option names for output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NamedOutput {
    /// The option.
    pub option: String,
    /// As written in the line.
    pub output: String,
    /// Its place in the batch's folder.
    place: String,
    kind: Kind,
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
    pub(super) fn all(asked: &Asked) -> impl Iterator<Item = Self> {
        let turntable = asked.text("turntable").and_then(|count| count.parse().ok());
        asked.outputs().filter_map(move |(option, output)| {
            let place = same_place(output)?;
            let is_picture = PictureFormat::of(Path::new(&place)).is_some();
            let numbered = NumberedName::parse(&place).filter(|_| asked.command == JobCommand::Render);
            let kind = match (option, asked.command, numbered) {
                ("output", _, Some(name)) => {
                    Kind::Numbered(name, turntable.map_or(MOST_PICTURES, |count: u32| count.min(MOST_PICTURES)))
                }
                ("output", JobCommand::Measure, _) | ("dump", _, _) => Kind::Folder,
                // Without a slash at the end it is one where a folder of this name is there.
                ("output", JobCommand::Compare, _) if output.ends_with('/') || !is_picture => Kind::Folder,
                _ => Kind::File,
            };
            Some(Self { option: option.to_owned(), output: output.to_owned(), place, kind })
        })
    }

    /// Its normalised place in the batch's folder; equal places are one output.
    pub(super) fn place(&self) -> &str {
        &self.place
    }

    /// Whether this file, named in the batch's folder, is one of its numbered files.
    pub(super) fn has_numbered(&self, name: &str) -> bool {
        let Kind::Numbered(numbered, count) = &self.kind else { return false };
        numbered.number_in(name).is_some_and(|number| (1..=*count).contains(&number))
    }

    /// Why it and one of another job, in an earlier line, exclude each other, if they do; without the option's name.
    fn clash(&self, before: &Self, line: u32) -> Option<String> {
        let output = shown(&self.output);
        if self.place == before.place {
            return Some(format!("{output} is also written by line {line}; name another"));
        }
        let is_in = |inner: &Self, outer: &Self| {
            let rest = inner.place.strip_prefix(&outer.place);
            outer.kind == Kind::Folder && rest.is_some_and(|rest| rest.starts_with('/'))
        };
        if is_in(self, before) {
            let folder = shown(&before.output);
            return Some(format!("{output} lies in {folder}, the folder that line {line} writes; name another"));
        }
        if is_in(before, self) {
            let inner = shown(&before.output);
            return Some(format!("{output} is a folder in which line {line} writes {inner}; name another"));
        }
        let shared = match (&self.kind, &before.kind) {
            (Kind::File, Kind::Numbered(..)) => before.has_numbered(&self.place).then(|| self.place.clone()),
            (Kind::Numbered(numbered, count), _) => {
                let is_shared = |name: &String| before.place == *name || before.has_numbered(name);
                (1..=*count).map(|number| numbered.with(number)).find(is_shared)
            }
            _ => None,
        }?;
        let pattern = shown(&before.output);
        Some(match self.place == shared {
            true => format!("{output} is also written by line {line}, as one of {pattern}; name another"),
            false => format!("{output} writes {}, as does line {line} by {pattern}; name another", shown(&shared)),
        })
    }
}

/// The beginning of a job's problem: the option's output, and the conflict.
pub(super) fn problem(asked: &Asked, before: &Asked, line: u32) -> Option<String> {
    let mut outputs: Vec<NamedOutput> = NamedOutput::all(asked).collect();
    // The last one, where both stand in one line.
    outputs.reverse();
    outputs.iter().find_map(|named| {
        let others = NamedOutput::all(before).filter(|other| other.option != named.option || asked.id != before.id);
        others.into_iter().find_map(|other| Some(format!("{}: {}", named.option, named.clash(&other, line)?)))
    })
}

/// Half of a SHA-256: no two of even a billion names share it by chance.
pub(super) type Key = [u8; 16];

/// A name's.
pub(super) fn key(name: &str) -> Key {
    half(&Sha256::digest(name.as_bytes()))
}

fn half(hash: &[u8]) -> Key {
    let mut key = Key::default();
    key.copy_from_slice(&hash[..16]);
    key
}

/// Two lines that may write the same: the later one, then the earlier one.
pub(super) type Lines = (u32, u32);

/// The folders and the numbered names of a list, and the outputs that may be among them.
#[derive(Default)]
pub(super) struct Shared {
    folders: Vec<(Key, u32)>,
    numbered: Vec<Numbers>,
    /// Files with numbers in their names, as far as they may be among the numbered.
    files: Vec<Numbers>,
    inside: Vec<Lines>,
}

/// Names in one line that differ only in a number of so many digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Numbers {
    key: Key,
    first: u32,
    last: u32,
    line: u32,
}

impl Shared {
    /// Notes the folders and the numbered names of a line.
    pub(super) fn note(&mut self, named: &NamedOutput, line: u32) {
        match &named.kind {
            Kind::File => {}
            Kind::Folder => self.folders.push((key(&named.place), line)),
            Kind::Numbered(name, count) => self.numbered.extend(numbers(name, *count, line)),
        }
    }

    /// Whether it is empty, which ends the check.
    pub(super) fn is_empty(&self) -> bool {
        self.folders.is_empty() && self.numbered.is_empty()
    }

    /// Call it once, before checking the list again.
    pub(super) fn sort(&mut self) {
        self.folders.sort_unstable();
        self.numbered.sort_unstable();
    }

    /// Searches for conflicts with a line's output.
    pub(super) fn compare(&mut self, named: &NamedOutput, line: u32) {
        if !self.folders.is_empty() {
            let mut hash = Sha256::new();
            let mut names = named.place.split('/').peekable();
            while let (Some(name), Some(_)) = (names.next(), names.peek()) {
                hash.update(name.as_bytes());
                let folder = half(&hash.clone().finalize());
                hash.update(b"/");
                let found = self.folders.partition_point(|(key, _)| *key < folder);
                let same = self.folders[found..].iter().take_while(|(key, _)| *key == folder);
                // A name given twice is refused earlier.
                self.inside
                    .extend(same.take(1).filter(|(_, other)| *other != line).map(|(_, other)| ordered(*other, line)));
            }
        }
        if !self.numbered.is_empty() && named.kind == Kind::File {
            for point in points(&named.place, line) {
                let found = self.numbered.partition_point(|numbers| numbers.key < point.key);
                if self.numbered.get(found).is_some_and(|numbers| numbers.key == point.key) {
                    self.files.push(point);
                }
            }
        }
    }

    /// Pairs of lines that may write the same file, ordered by the later line.
    pub(super) fn suspects(mut self) -> Vec<Lines> {
        let mut suspects = self.inside;
        self.numbered.append(&mut self.files);
        self.numbered.sort_unstable();
        for same in self.numbered.chunk_by(|one, other| one.key == other.key) {
            let mut furthest = same[0];
            for numbers in &same[1..] {
                if numbers.first <= furthest.last && numbers.line != furthest.line {
                    suspects.push(ordered(numbers.line, furthest.line));
                }
                if numbers.last > furthest.last {
                    furthest = *numbers;
                }
            }
        }
        suspects.sort_unstable();
        suspects.dedup();
        suspects
    }
}

fn ordered(one: u32, other: u32) -> Lines {
    (one.max(other), one.min(other))
}

/// The names that a pattern stands for, in few ranges: one for each number of digits.
fn numbers(name: &NumberedName, count: u32, line: u32) -> Vec<Numbers> {
    let (before, width, after) = name.parts();
    // A digit behind the number breaks its range into single names.
    if after.starts_with(|c: char| c.is_ascii_digit()) {
        return (1..=count).flat_map(|number| points(&name.with(number), line)).collect();
    }
    let text = before.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &before[text.len()..];
    let lengths = width.max(1)..=width.max(count.max(1).ilog10() as usize + 1);
    let ranges = lengths.map(|length| {
        let first = if length == width.max(1) { 1 } else { 10u32.pow(length as u32 - 1) };
        let last = count.min(10u32.saturating_pow(length as u32).saturating_sub(1));
        let [first, last] = [first, last].map(|number| format!("{digits}{number:0length$}"));
        let range = of(text, &first, after, line);
        Numbers { last: of(text, &last, after, line).last, ..range }
    });
    ranges.collect()
}

/// A file's name for each number in it.
fn points(place: &str, line: u32) -> Vec<Numbers> {
    let start = place.rfind('/').map_or(0, |slash| slash + 1);
    let is_digit = |at: usize| place.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    let mut points = Vec::new();
    let mut at = start;
    while at < place.len() {
        let end = (at..).find(|end| !is_digit(*end)).unwrap_or(at);
        if end > at {
            points.push(of(&place[..at], &place[at..end], &place[end..], line));
        }
        at = end.max(at + 1);
    }
    points
}

/// One name, taken apart around a number.
fn of(before: &str, digits: &str, after: &str, line: u32) -> Numbers {
    let (head, tail) = digits.split_at(digits.len().saturating_sub(DIGITS));
    // At most nine digits.
    let number = tail.parse().unwrap_or(0);
    let key = key(&format!("{before}\0{}\0{head}\0{after}", digits.len()));
    Numbers { key, first: number, last: number, line }
}
