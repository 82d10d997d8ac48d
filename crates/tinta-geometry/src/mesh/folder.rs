//! A model's folder: finds the files that the model names, and keeps it from reading others.
//!
//! A model may name any file on the user's disk: by `..`, absolutely, or by a link in its folder. Without
//! `LoadOptions::allow_external` such files are not read. A file's real path, with links resolved, decides whether it lies
//! inside.

use super::{EmbeddedPicture, Material};
use crate::files::{self, Failure};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The files beside a model.
#[derive(Debug)]
pub(super) struct Folder<'a> {
    place: Place<'a>,
    /// The names of its entries, read on first use.
    names: OnceCell<Vec<String>>,
}

#[derive(Debug)]
enum Place<'a> {
    /// A folder on disk, and the real path that its files must lie in; `None` allows any place.
    Disk { path: PathBuf, within: Option<PathBuf> },
    /// Files in memory. If empty, missing files are ignored.
    Memory(&'a [(&'a str, &'a [u8])]),
}

/// The result of looking for a file that a model names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Lookup {
    /// Found here.
    Here(PathBuf),
    /// It exists, but outside the folder.
    Outside,
    /// It does not exist.
    Nowhere,
}

impl<'a> Folder<'a> {
    /// Returns the folder of a model file.
    pub(super) fn of(model: &str, allow_external: bool) -> Self {
        let path = Path::new(model).parent().unwrap_or(Path::new("")).to_path_buf();
        // A missing folder has no files either.
        let real = || listed(&path).canonicalize().unwrap_or_else(|_| path.clone());
        Self { place: Place::Disk { within: (!allow_external).then(real), path }, names: OnceCell::new() }
    }

    /// Creates a folder of these files, by name. If empty, all files count as neither found nor missing.
    pub(super) fn of_files(files: &'a [(&'a str, &'a [u8])]) -> Self {
        Self { place: Place::Memory(files), names: OnceCell::new() }
    }

    /// Whether the folder can hold files.
    pub(super) fn is_some(&self) -> bool {
        !matches!(self.place, Place::Memory([]))
    }

    /// Returns the path on disk for a file of this name.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        match &self.place {
            Place::Disk { path, .. } => Some(path.join(name)),
            Place::Memory(_) => None,
        }
    }

    /// Finds the file of this name, which may begin with folders.
    pub(super) fn find(&self, name: &Path) -> Lookup {
        match &self.place {
            Place::Disk { path, within } => {
                let path = path.join(name);
                match within {
                    _ if !path.is_file() => Lookup::Nowhere,
                    Some(within) if !files::is_within(&path, within) => Lookup::Outside,
                    _ => Lookup::Here(path),
                }
            }
            Place::Memory(files) => match in_memory(files, name) {
                Some((name, _)) => Lookup::Here(PathBuf::from(name)),
                None => Lookup::Nowhere,
            },
        }
    }

    /// Finds the file of this name from a folder above the model's: games name pictures from their installation folder.
    pub(super) fn find_from_above(&self, name: &Path) -> Lookup {
        let Place::Disk { path, within } = &self.place else { return Lookup::Nowhere };
        let (Ok(real), true) = (listed(path).canonicalize(), name.is_relative()) else { return Lookup::Nowhere };
        let places = real.ancestors().skip(1).take(name.components().count()).map(|above| above.join(name));
        match places.into_iter().find(|place| place.is_file()) {
            None => Lookup::Nowhere,
            Some(place) if within.as_ref().is_some_and(|within| !files::is_within(&place, within)) => Lookup::Outside,
            Some(place) => Lookup::Here(place),
        }
    }

    /// Returns the name of the folder that a file on disk lies in.
    pub(super) fn name_of_parent(&self, file: &Path) -> Option<String> {
        let Place::Disk { .. } = self.place else { return None };
        let real = listed(file.parent()?).canonicalize().ok()?;
        Some(real.file_name()?.to_string_lossy().into_owned())
    }

    /// Reads the file of this name.
    pub(super) fn read(&self, name: &Path, limit: u64) -> Result<Cow<'a, [u8]>, Failure> {
        match &self.place {
            Place::Disk { path, within } => {
                files::read_within(&path.join(name), within.as_deref(), limit).map(Cow::Owned)
            }
            Place::Memory(files) => match in_memory(files, name) {
                Some((_, bytes)) if bytes.len() as u64 <= limit => Ok(Cow::Borrowed(bytes)),
                Some((_, bytes)) => Err(Failure::TooLarge(bytes.len() as u64)),
                None => Err(Failure::System(ErrorKind::NotFound.into())),
            },
        }
    }

    /// Reads a material library: the file of this name, or in memory the only one, whatever its name.
    pub(super) fn read_library(&self, name: &str, limit: u64) -> Result<Cow<'a, [u8]>, Failure> {
        let is_library =
            |name: &str| Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mtl"));
        if let Place::Memory(files) = &self.place {
            let mut libraries = files.iter().filter(|(name, _)| is_library(name));
            if let (Some((only, _)), None) = (libraries.next(), libraries.next()) {
                return self.read(only.as_ref(), limit);
            }
        }
        self.read(name.as_ref(), limit)
    }

    /// Makes the found file a material's picture, which a style reads when it needs it.
    pub(super) fn put_picture(&self, material: &mut Material, found: PathBuf) {
        match &self.place {
            Place::Disk { within, .. } => {
                material.texture = Some(found);
                material.texture_within.clone_from(within);
            }
            Place::Memory(files) => {
                material.embedded = in_memory(files, &found)
                    .map(|(name, bytes)| Arc::new(EmbeddedPicture { name: (*name).to_owned(), bytes: bytes.to_vec() }));
            }
        }
    }

    /// Returns the names of its files and folders that are text.
    pub(super) fn names(&self) -> &[String] {
        self.names.get_or_init(|| match &self.place {
            Place::Disk { path, .. } => {
                let entries = std::fs::read_dir(listed(path)).ok().into_iter().flatten().flatten();
                entries.filter_map(|entry| entry.file_name().into_string().ok()).collect()
            }
            Place::Memory(files) => files.iter().map(|(name, _)| (*name).to_owned()).collect(),
        })
    }
}

/// Finds the file of this exact name, or else in any case and without leading folders.
fn in_memory<'f, 'a>(files: &'f [(&'a str, &'a [u8])], name: &Path) -> Option<&'f (&'a str, &'a [u8])> {
    let base = name.file_name()?.to_str()?;
    let exact = files.iter().find(|(known, _)| Path::new(known) == name);
    exact.or_else(|| files.iter().find(|(known, _)| known.eq_ignore_ascii_case(base)))
}

/// Returns a folder's path for the system: an empty path becomes the current folder.
fn listed(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}
