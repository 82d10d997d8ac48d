//! A temporary file on the target's file system: without a name if the system supports that.
//!
//! Linux has files without a name (`O_TMPFILE`) and frees them when the process ends, however it ends. Such a file gets its name
//! when it is complete. Elsewhere, and on file systems without them (NFS, FAT), its temporary name is `.tinta-` and six letters,
//! and stays behind if the process is killed.

use std::fs::File;
use std::io::Result;
use std::path::Path;
use tempfile::NamedTempFile;

/// An unnamed or temporary file, deleted when dropped.
#[derive(Debug)]
pub(super) enum StagedFile {
    /// No name leads to it.
    #[cfg(target_os = "linux")]
    Unnamed(File),
    /// With a temporary name.
    Named(NamedTempFile),
}

impl StagedFile {
    /// Opens an empty file in the folder of `target`, with the permissions of a new file there.
    pub(super) fn open(target: &Path) -> Result<Self> {
        #[cfg(target_os = "linux")]
        if let Some(file) = unnamed(folder(target))? {
            return Ok(Self::Unnamed(file));
        }
        Self::open_named(target)
    }

    fn open_named(target: &Path) -> Result<Self> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder.prefix(PREFIX).tempfile_in(folder(target)).map(Self::Named)
    }

    /// To be written.
    pub(super) fn file(&mut self) -> &mut File {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => file,
            Self::Named(file) => file.as_file_mut(),
        }
    }

    /// Atomically renames the file to `target`, replacing any existing file.
    pub(super) fn put_in_place(self, target: &Path) -> Result<()> {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => name(&file, target),
            Self::Named(file) => file.persist(target).map(drop).map_err(|error| error.error),
        }
    }
}

/// The prefix of temporary names.
const PREFIX: &str = ".tinta-";

fn folder(target: &Path) -> &Path {
    target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Opens a file without a name in this folder; `None` if it cannot be made or cannot be named.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Result<Option<File>> {
    use rustix::fs::{Mode, OFlags, open};
    use rustix::io::Errno;
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    match open(folder, flags, Mode::from_raw_mode(0o666)) {
        Ok(file) => {
            let file = File::from(file);
            // Without /proc the file cannot be named.
            Ok(door(&file).symlink_metadata().is_ok().then_some(file))
        }
        // Errors of the file system, and of kernels that do not support the flag.
        Err(Errno::OPNOTSUPP | Errno::ISDIR | Errno::INVAL) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Links the file to its name. A link cannot replace an existing file, but a rename can: the file then has a temporary name
/// between two system calls.
#[cfg(target_os = "linux")]
fn name(file: &File, target: &Path) -> Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    let link = |name: &Path| -> Result<()> { Ok(linkat(CWD, door(file), CWD, name, AtFlags::SYMLINK_FOLLOW)?) };
    match link(target) {
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
        done => return done,
    }
    let named = tempfile::Builder::new().prefix(PREFIX).make_in(folder(target), link)?;
    named.persist(target).map_err(|error| error.error)
}

/// The path that an open file can be linked from.
#[cfg(target_os = "linux")]
fn door(file: &File) -> std::path::PathBuf {
    use std::os::fd::AsRawFd;
    format!("/proc/self/fd/{}", file.as_raw_fd()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn names(folder: &Path) -> Vec<String> {
        let files = std::fs::read_dir(folder).unwrap();
        files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn both_ways_make_and_replace_a_file_and_leave_nothing_beside_it() {
        for open in [StagedFile::open, StagedFile::open_named] {
            let folder = tempfile::tempdir().unwrap();
            let target = folder.path().join("drawing.svg");
            for text in ["<svg/>", "<svg></svg>"] {
                let mut staged = open(&target).unwrap();
                staged.file().write_all(text.as_bytes()).unwrap();
                staged.put_in_place(&target).unwrap();
                assert_eq!(std::fs::read_to_string(&target).unwrap(), text);
            }
            drop(open(&target).unwrap());
            assert_eq!(names(folder.path()), ["drawing.svg"]);
        }
    }

    #[test]
    fn both_ways_refuse_a_directory_and_a_folder_that_went_away_and_leave_nothing() {
        for open in [StagedFile::open, StagedFile::open_named] {
            let folder = tempfile::tempdir().unwrap();
            let target = folder.path().join("taken");
            std::fs::create_dir(&target).unwrap();
            assert!(open(&target).unwrap().put_in_place(&target).is_err());
            assert_eq!(names(folder.path()), ["taken"]);
            let gone = folder.path().join("taken").join("a.svg");
            let staged = open(&gone).unwrap();
            std::fs::remove_dir_all(&target).unwrap();
            assert!(staged.put_in_place(&gone).is_err());
            assert!(names(folder.path()).is_empty());
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_in_the_making_has_no_name() {
        let folder = tempfile::tempdir().unwrap();
        let mut staged = StagedFile::open(&folder.path().join("drawing.svg")).unwrap();
        staged.file().write_all(b"<svg/>").unwrap();
        match staged {
            StagedFile::Unnamed(_) => assert!(names(folder.path()).is_empty()),
            // The folder for temporary files may be on a file system without unnamed files.
            StagedFile::Named(_) => assert_eq!(names(folder.path()).len(), 1),
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_takes_no_file_of_either_kind_is_refused() {
        assert!(StagedFile::open(Path::new("/proc/no-such-folder/a.svg")).is_err());
        assert!(StagedFile::open(Path::new("/proc/self/a.svg")).is_err());
    }
}
