//! Atomic output: a path is checked before the work, written to a temporary file, then renamed into place.
//!
//! Pictures, animations and texts all go through here. No incomplete file remains however the program ends, even
//! without signal handling: the contents are complete in memory first, and on the disk before the file gets its name. The price
//! is their size in memory. Guarantees and limits: docs/dev/limits.md.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::TextTarget;
//!
//! let folder = tempfile::tempdir().expect("a folder");
//! let name = folder.path().join("lines.svg").display().to_string();
//! // Checked before the work, written whole after it.
//! let target = TextTarget::check(&name)?;
//! target.write("<svg/>")?;
//! assert_eq!(std::fs::read_to_string(name).expect("the file"), "<svg/>");
//! # Ok(())
//! # }
//! ```

mod staged_file;

use crate::error::{Error, Result};
use crate::lines::DrawingFormat;
use staged_file::StagedFile;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The destination of a text: an SVG, JSON or PDF file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TextTarget {
    /// Standard output.
    Stdout,
    /// A file.
    File(PathBuf),
}

impl TextTarget {
    /// Checks that `path` (or `-`) can be written.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a directory, a device, and a missing or write-protected folder.
    pub fn check(path: &str) -> Result<Self> {
        if path == "-" {
            return Ok(Self::Stdout);
        }
        let file = PathBuf::from(path);
        check_file(&file)?;
        Ok(Self::File(file))
    }

    /// Writes the text; a file is replaced completely or stays unchanged.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when the disk is full, the folder gone, the pipe closed.
    pub fn write(&self, text: &str) -> Result<()> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes bytes, like [`TextTarget::write`].
    ///
    /// # Errors
    ///
    /// As there.
    pub fn write_bytes(&self, bytes: &[u8]) -> Result<()> {
        match self {
            Self::Stdout => write_standard_output(bytes),
            Self::File(path) => write_whole(path, bytes),
        }
    }
}

/// Writes all bytes to standard output.
pub(crate) fn write_standard_output(bytes: &[u8]) -> Result<()> {
    let mut out = std::io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(|error| {
        Error::output("-", format!("standard output cannot be written ({error}); check where it goes")).because(&error)
    })
}

/// Returns an error for names of folders, and for extensions without a name.
pub(crate) fn check_name(file: &Path) -> Result<()> {
    let refuse = |problem: String| Err(Error::output(file, problem));
    let text = file.to_string_lossy();
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    if file.is_dir() {
        return refuse("this is a directory; name a file in it".to_owned());
    }
    if text.ends_with(std::path::is_separator) {
        return refuse(format!("this names a folder; name a file in it, such as {text}drawing.png"));
    }
    match name.strip_prefix('.') {
        Some(ending) if ["png", "gif"].contains(&ending) || DrawingFormat::of_name(&format!("a{name}")).is_some() => {
            refuse(format!("this is an ending without a name; write drawing{name}"))
        }
        _ => Ok(()),
    }
}

/// Checks that a file of any kind can be written here.
pub(crate) fn check_file(file: &Path) -> Result<()> {
    check_name(file)?;
    let refuse = |problem: String| Error::output(file, problem);
    if cfg!(windows) && is_device(file) {
        return Err(refuse(
            "Windows has a device of this name; name another file, or - for standard output".to_owned(),
        ));
    }
    // A new file replaces the old one, which must be a file: not a device, a pipe or a broken link.
    if file.symlink_metadata().is_ok() && !file.is_file() {
        return Err(refuse("this is not a regular file; name another, or - for standard output".to_owned()));
    }
    StagedFile::open(&resolved(file)).map(drop).map_err(|error| refused(file, &error))
}

/// Whether a path's last name is a Windows device name, in any folder and with any extension: `aux.png`.
fn is_device(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
    let stem = name.split('.').next().unwrap_or_default().trim_end();
    let is_numbered = |kind: &str| {
        let number = stem.strip_prefix(kind).and_then(|rest| rest.chars().next().filter(|_| rest.chars().count() == 1));
        number.is_some_and(|number| number.is_ascii_digit() || "¹²³".contains(number))
    };
    ["CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"].contains(&stem) || is_numbered("COM") || is_numbered("LPT")
}

/// A file's new contents, complete on the disk, without a name or under a temporary one that is removed with this.
#[derive(Debug)]
pub struct StagedContents {
    path: PathBuf,
    temporary: StagedFile,
}

impl StagedContents {
    /// Writes the contents to a temporary file beside `path`, which stays unchanged.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when the disk is full, or the folder gone.
    pub fn new(path: &Path, bytes: &[u8]) -> Result<Self> {
        let write = || {
            let mut temporary = StagedFile::open(&resolved(path))?;
            let file = temporary.file();
            file.write_all(bytes)?;
            // A replaced file keeps its permissions. The replacement must reach the disk first: otherwise a power cut could
            // destroy both. A new file replaces nothing, so it need not wait.
            if let Ok(metadata) = path.metadata() {
                file.set_permissions(metadata.permissions())?;
                file.sync_data()?;
            }
            Ok(temporary)
        };
        let temporary = write().map_err(|error| refused(path, &error))?;
        Ok(Self { path: path.to_owned(), temporary })
    }

    /// Gives the contents their name; follows a link, replaces an old file.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when the folder is gone.
    pub fn put_in_place(self) -> Result<()> {
        self.temporary.put_in_place(&resolved(&self.path)).map_err(|error| refused(&self.path, &error))
    }
}

/// Writes a complete file, or leaves the existing one unchanged.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    StagedContents::new(path, bytes)?.put_in_place()
}

fn refused(path: &Path, error: &std::io::Error) -> Error {
    Error::output(path, cannot_write(path, error)).because(error)
}

/// Returns the file that a link at `path` points to; writing there keeps the link.
fn resolved(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

fn cannot_write(path: &Path, error: &std::io::Error) -> String {
    use std::io::ErrorKind;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory if folder.is_file() => {
            format!("{} is a file, not a folder; name another", folder.display())
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory if folder.is_dir() => {
            format!("nothing can be written into the folder {}; choose another", folder.display())
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            format!("the folder {} does not exist; create it first", folder.display())
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            format!("no permission to write into the folder {}; choose another", folder.display())
        }
        ErrorKind::StorageFull => "the disk is full; free some space".to_owned(),
        ErrorKind::QuotaExceeded => "your disk quota is used up; free some space".to_owned(),
        ErrorKind::FileTooLarge => {
            "it would exceed the limit on file sizes (see ulimit -f); raise the limit".to_owned()
        }
        ErrorKind::IsADirectory => "this is a directory; name a file in it".to_owned(),
        _ => format!("it cannot be written ({error})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_replaces_a_file_whole_and_leaves_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("drawing.svg");
        for text in ["<svg/>", "<svg></svg>"] {
            TextTarget::check(path.to_str().unwrap()).unwrap().write(text).unwrap();
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        assert_eq!(TextTarget::check("-").unwrap(), TextTarget::Stdout);
    }

    #[test]
    fn names_of_windows_devices_are_known_with_any_ending_and_in_any_folder() {
        for name in ["nul", "NUL.png", "out/aux.svg", "Com1.png", "lpt9", "COM².png", "con .txt", "prn.tar.gz"] {
            assert!(is_device(Path::new(name)), "{name}");
        }
        for name in ["null.png", "com.png", "com10.png", "lpt", "auxiliary.png", "out.nul", "nul/a.png", "", "."] {
            assert!(!is_device(Path::new(name)), "{name}");
        }
    }

    #[test]
    fn a_text_that_cannot_be_written_is_refused_before_the_work() {
        let folder = tempfile::tempdir().unwrap();
        let message = |path: &str| TextTarget::check(path).unwrap_err().to_string();
        assert!(message(folder.path().to_str().unwrap()).contains("directory"));
        assert!(message("no/such/folder/a.svg").contains("folder no/such/folder does not exist"));
    }
}
