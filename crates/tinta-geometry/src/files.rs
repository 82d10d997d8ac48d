//! Reads whole files into memory: only ordinary files, each up to a limit, whatever size it claims.
//!
//! A file may grow or shrink during reading, and some systems' files claim 0 bytes and hold many. Only the bytes read count;
//! the size decides the first allocation alone.

use crate::error::{Error, FileKind};
use std::fmt::Write;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Why a file cannot be read.
#[derive(Debug)]
pub enum Failure {
    /// The system reports an error.
    System(io::Error),
    /// It is a folder.
    Folder,
    /// It is a pipe, a socket or a device, which may never begin or end.
    NotAFile,
    /// It lies outside the folder it must lie in.
    Outside,
    /// It has more bytes than the limit.
    TooLarge(u64),
    /// Memory is too small for this many bytes.
    NoMemory(u64),
}

impl Failure {
    /// Returns the problem and its solution, without the file's name; `what` names such a file: "a model file".
    pub(crate) fn problem(&self, what: &str) -> String {
        match self {
            Self::System(error) => match error.kind() {
                ErrorKind::NotFound => "there is no such file; check the name".to_owned(),
                ErrorKind::PermissionDenied => "no permission to read it; change its permissions".to_owned(),
                _ => format!("it cannot be read ({error}); check the file"),
            },
            Self::Folder => format!("this is a directory; name {what} in it"),
            Self::NotAFile => format!("this is a pipe or a device, not a regular file; name {what}"),
            Self::Outside => "it is outside the model's folder; --allow-external reads it".to_owned(),
            Self::TooLarge(limit) => {
                format!("it is larger than {}, the limit for {what}; make it smaller", in_bytes(*limit))
            }
            Self::NoMemory(bytes) => {
                format!("not enough memory for its {}; close other programs or make it smaller", in_bytes(*bytes))
            }
        }
    }
}

impl Failure {
    /// Converts the failure into an error for this file, with its role; `what` as in [`Failure::problem`].
    pub fn into_error(self, kind: FileKind, path: impl Into<PathBuf>, what: &str) -> Error {
        let error = Error::file(kind, path, self.problem(what));
        match &self {
            Self::System(cause) => error.because(cause),
            Self::NoMemory(_) => error.because(&ErrorKind::OutOfMemory.into()),
            _ => error,
        }
    }
}

/// Reads a file of at most `limit` bytes.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
    // Checked before opening: opening a pipe waits for a writer.
    check(&path.metadata().map_err(Failure::System)?)?;
    read_opened(File::open(path).map_err(Failure::System)?, limit)
}

/// Reads a file that must lie in the folder with real path `within`, if any.
///
/// Checks the opened file, not only its name: a link may have replaced it since.
pub fn read_within(path: &Path, within: Option<&Path>, limit: u64) -> Result<Vec<u8>, Failure> {
    let Some(within) = within else { return read(path, limit) };
    check(&path.metadata().map_err(Failure::System)?)?;
    let file = File::open(path).map_err(Failure::System)?;
    let real = path.canonicalize().map_err(Failure::System)?;
    let is_the_same = is_same(&file.metadata().map_err(Failure::System)?, &real);
    if !real.starts_with(within) || !is_the_same {
        return Err(Failure::Outside);
    }
    read_opened(file, limit)
}

/// Whether a file's real path lies in the folder with real path `within`.
pub(crate) fn is_within(path: &Path, within: &Path) -> bool {
    path.canonicalize().is_ok_and(|real| real.starts_with(within))
}

/// Whether an open file is the file at a real path, which is no link.
#[cfg(unix)]
fn is_same(open: &std::fs::Metadata, real: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    real.symlink_metadata().is_ok_and(|there| (there.dev(), there.ino()) == (open.dev(), open.ino()))
}

/// Compares the files' properties, which must be equal: Windows identifies a file by handle alone, and std offers no access to
/// that.
#[cfg(windows)]
fn is_same(open: &std::fs::Metadata, real: &Path) -> bool {
    use std::os::windows::fs::MetadataExt;
    let of = |file: &std::fs::Metadata| (file.creation_time(), file.last_write_time(), file.file_size());
    real.symlink_metadata().is_ok_and(|there| there.is_file() && of(&there) == of(open))
}

/// Other systems cannot identify an open file.
#[cfg(not(any(unix, windows)))]
fn is_same(_: &std::fs::Metadata, real: &Path) -> bool {
    real.symlink_metadata().is_ok_and(|there| there.is_file())
}

/// Reads an open file.
fn read_opened(file: File, limit: u64) -> Result<Vec<u8>, Failure> {
    let metadata = file.metadata().map_err(Failure::System)?;
    check(&metadata)?;
    if metadata.len() > limit {
        return Err(Failure::TooLarge(limit));
    }
    read_from(file, metadata.len(), limit)
}

fn check(metadata: &std::fs::Metadata) -> Result<(), Failure> {
    match metadata.is_file() {
        true => Ok(()),
        false if metadata.is_dir() => Err(Failure::Folder),
        false => Err(Failure::NotAFile),
    }
}

/// Reads everything, at most `limit` bytes; `expected` is only the size of the first allocation.
pub fn read_from(mut from: impl Read, expected: u64, limit: u64) -> Result<Vec<u8>, Failure> {
    /// Least size of a read beyond the expected bytes.
    const STEP_BYTES: u64 = 64 << 10;
    let mut bytes = Vec::new();
    // One byte more than expected, to find the end without growing.
    let mut room = expected.min(limit) + 1;
    loop {
        let count = usize::try_from(room).map_err(|_| Failure::NoMemory(room))?;
        bytes.try_reserve_exact(count).map_err(|_| Failure::NoMemory(bytes.len() as u64 + room))?;
        let read = from.by_ref().take(room).read_to_end(&mut bytes).map_err(Failure::System)?;
        let length = bytes.len() as u64;
        if length > limit {
            return Err(Failure::TooLarge(limit));
        }
        if (read as u64) < room {
            return Ok(bytes);
        }
        room = length.max(STEP_BYTES).min(limit - length + 1);
    }
}

/// Formats a number of bytes for people.
fn in_bytes(bytes: u64) -> String {
    match bytes {
        bytes if bytes >= 1 << 30 && bytes.is_multiple_of(1 << 30) => format!("{} GiB", bytes >> 30),
        bytes if bytes >= 1 << 20 => format!("{} MiB", bytes >> 20),
        bytes => format!("{bytes} bytes"),
    }
}

/// Formats a name from a file for a message: on one line and shortened.
pub fn shown(name: &str) -> String {
    let mut text = String::new();
    for (place, c) in name.chars().enumerate() {
        if place == crate::limits::SHOWN_CHARACTERS {
            text.push('…');
            break;
        }
        match c.is_control() {
            true => drop(write!(text, "{}", c.escape_default())),
            false => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives `count` bytes in pieces of up to 1,000, whatever it said it had.
    struct Liar {
        count: usize,
    }

    impl Read for Liar {
        fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
            let count = self.count.min(out.len()).min(1000);
            out[..count].fill(7);
            self.count -= count;
            Ok(count)
        }
    }

    #[test]
    fn a_file_that_grows_or_shrinks_while_it_is_read_is_read_to_its_end() {
        for (said, has) in [(0, 0), (0, 300_000), (10, 300_000), (300_000, 10), (5_000, 5_000), (5_000, 5_001)] {
            let bytes = read_from(Liar { count: has }, said, 1 << 20).unwrap();
            assert_eq!((bytes.len(), bytes.iter().all(|byte| *byte == 7)), (has, true), "{said} {has}");
        }
    }

    #[test]
    fn what_grows_beyond_the_limit_is_refused_with_hardly_more_memory_than_that() {
        for said in [0, 10, 5_000, u64::MAX] {
            assert_eq!(read_from(Liar { count: 5_000 }, said, 5_000).unwrap().len(), 5_000);
            let failure = read_from(Liar { count: usize::MAX }, said, 5_000).unwrap_err();
            assert!(matches!(failure, Failure::TooLarge(5_000)), "{failure:?}");
        }
    }

    #[test]
    fn memory_that_is_not_there_is_a_sentence() {
        let failure = read_from(Liar { count: 10 }, u64::MAX >> 2, u64::MAX >> 1).unwrap_err();
        assert!(failure.problem("a model file").starts_with("not enough memory for its 4294967296 GiB"));
    }

    #[test]
    fn folders_and_devices_are_no_files() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(read(folder.path(), 10), Err(Failure::Folder)));
        #[cfg(unix)]
        assert!(matches!(read(Path::new("/dev/zero"), 10), Err(Failure::NotAFile)));
        let path = folder.path().join("a");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read(&path, 5).unwrap(), b"12345");
        assert!(matches!(read(&path, 4), Err(Failure::TooLarge(4))));
    }

    #[test]
    fn names_are_shown_on_one_line_and_not_without_end() {
        assert_eq!(shown("a\nb\u{1b}[2J c"), "a\\nb\\u{1b}[2J c");
        assert_eq!(shown(&"ü".repeat(1_000_000)).chars().count(), crate::limits::SHOWN_CHARACTERS + 1);
    }
}
