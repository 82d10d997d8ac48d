//! A model's folder: where the files it names are looked for, and what it may not lead out of.
//!
//! A model may name any file of its reader's disk: `..`, absolute, or by a link in its folder. None of them is followed
//! unless `LoadOptions::allow_external`; whether a file lies inside is asked of its real path, links resolved.

use crate::files::{self, Failure};
use std::cell::OnceCell;
use std::path::{Path, PathBuf};

/// The folder of a model, or no place at all: a model out of memory names files that nobody looks for.
#[derive(Debug)]
pub(super) struct Folder {
    path: Option<PathBuf>,
    /// What its files must lie in: its real path; `None` where they may lie anywhere.
    within: Option<PathBuf>,
    /// The names of what lies in it, read when first asked for.
    names: OnceCell<Vec<String>>,
}

/// What became of a file that a model names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Found {
    /// It lies here.
    Here(PathBuf),
    /// It is there but outside the folder.
    Outside,
    /// There is no such file.
    Nowhere,
}

impl Folder {
    /// The folder of a model file.
    pub(super) fn of(model: &str, allow_external: bool) -> Self {
        let path = Path::new(model).parent().unwrap_or(Path::new("")).to_path_buf();
        // A folder that is not there has no files either.
        let real = || listed(&path).canonicalize().unwrap_or_else(|_| path.clone());
        Self { within: (!allow_external).then(real), path: Some(path), names: OnceCell::new() }
    }

    /// No folder: nothing is found and nothing missed.
    pub(super) fn none() -> Self {
        Self { path: None, within: None, names: OnceCell::new() }
    }

    /// Whether there is a folder to look in.
    pub(super) fn is_some(&self) -> bool {
        self.path.is_some()
    }

    /// Where a file of this name would be.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        self.path.as_ref().map(|folder| folder.join(name))
    }

    /// What a file found here must still lie in when it is opened; `None`: anything.
    pub(super) fn within(&self) -> Option<&Path> {
        self.within.as_deref()
    }

    /// The file of this name, which may have folders before it.
    pub(super) fn find(&self, name: &Path) -> Found {
        let Some(path) = self.path.as_ref().map(|folder| folder.join(name)).filter(|path| path.is_file()) else {
            return Found::Nowhere;
        };
        match &self.within {
            Some(within) if !files::is_within(&path, within) => Found::Outside,
            _ => Found::Here(path),
        }
    }

    /// Reads the file of this name.
    pub(super) fn read(&self, name: &Path, limit: u64) -> Result<Vec<u8>, Failure> {
        let path = self.path.as_ref().map_or_else(|| name.to_path_buf(), |folder| folder.join(name));
        files::read_within(&path, self.within(), limit)
    }

    /// The names of the files and folders in it, as far as they are text.
    pub(super) fn names(&self) -> &[String] {
        self.names.get_or_init(|| {
            let entries = self.path.as_deref().and_then(|path| std::fs::read_dir(listed(path)).ok());
            entries.into_iter().flatten().flatten().filter_map(|entry| entry.file_name().into_string().ok()).collect()
        })
    }
}

/// A folder as the system wants it: an empty path is the current folder.
fn listed(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}
