//! A model's folder: finds the files that the model names, and keeps it from reading others.
//!
//! A model may name any file on the user's disk: by `..`, absolutely, or by a link in its folder. Without
//! `LoadOptions::allow_external` such files are not read. A file's real path, with links resolved, decides whether it lies
//! inside.

use super::{EmbeddedPicture, Material};
use crate::files::{self, Failure};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::{OsStr, OsString};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

/// The files beside a model.
#[derive(Debug)]
pub(super) struct Folder<'a> {
    place: Place<'a>,
    /// The names in each folder on disk, read on first use.
    names: RefCell<HashMap<PathBuf, Rc<[OsString]>>>,
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
        Self { place: Place::Disk { within: (!allow_external).then(real), path }, names: RefCell::default() }
    }

    /// Creates a folder of these files, by name. If empty, all files count as neither found nor missing.
    pub(super) fn of_files(files: &'a [(&'a str, &'a [u8])]) -> Self {
        Self { place: Place::Memory(files), names: RefCell::default() }
    }

    /// Whether the folder can hold files.
    pub(super) fn is_some(&self) -> bool {
        !matches!(self.place, Place::Memory([]))
    }

    /// Returns the path on disk for a file of this name.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        match &self.place {
            Place::Disk { path, .. } => Some(self.on_disk(path, Path::new(name)).unwrap_or_else(|| path.join(name))),
            Place::Memory(_) => None,
        }
    }

    /// Finds the file of this name, which may begin with folders: as written, or else in any case.
    pub(super) fn find(&self, name: &Path) -> Lookup {
        match &self.place {
            Place::Disk { path, within } => match (self.on_disk(path, name), within) {
                (None, _) => Lookup::Nowhere,
                (Some(file), Some(within)) if !files::is_within(&file, within) => Lookup::Outside,
                (Some(file), _) => Lookup::Here(file),
            },
            Place::Memory(files) => match in_memory(files, name) {
                Some((name, _)) => Lookup::Here(PathBuf::from(name)),
                None => Lookup::Nowhere,
            },
        }
    }

    /// Finds the file of this name in a folder below: as written, or else with slashes for the backslashes of other systems.
    pub(super) fn find_written(&self, below: &Path, name: &str) -> Lookup {
        match self.find(&below.join(name)) {
            Lookup::Nowhere if name.contains('\\') => self.find(&below.join(name.replace('\\', "/"))),
            found => found,
        }
    }

    /// Finds a material library: a file of this name, or in memory the only one, whatever its name.
    pub(super) fn find_library(&self, name: &str) -> Lookup {
        if let Place::Memory(files) = &self.place {
            let mut libraries = files.iter().filter(|(name, _)| is_library(name));
            if let (Some((only, _)), None) = (libraries.next(), libraries.next()) {
                return Lookup::Here(PathBuf::from(only));
            }
        }
        self.find_written(Path::new(""), name)
    }

    /// The file of this name below a folder on disk: as written, or else with its parts in any case.
    fn on_disk(&self, folder: &Path, name: &Path) -> Option<PathBuf> {
        let written = folder.join(name);
        if written.is_file() {
            return Some(written);
        }
        if name.is_absolute() {
            return None;
        }
        let mut file = folder.to_path_buf();
        for part in name {
            let next = file.join(part);
            if next.exists() {
                file = next;
                continue;
            }
            let names = self.names_in(&file);
            let same = names.iter().filter(|name| is_same(name, part));
            // A folder's entries have no fixed order.
            file.push(same.min()?);
        }
        file.is_file().then_some(file)
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

    /// Reads the file of this name, as glTF names its buffers.
    #[cfg(any(feature = "gltf", test))]
    pub(super) fn read(&self, name: &Path, limit: u64) -> Result<Cow<'a, [u8]>, Failure> {
        match &self.place {
            Place::Disk { path, .. } => {
                let file = self.on_disk(path, name).unwrap_or_else(|| path.join(name));
                self.read_found(&file, limit)
            }
            Place::Memory(_) => self.read_found(name, limit),
        }
    }

    /// Reads a file that [`Folder::find`] found.
    pub(super) fn read_found(&self, found: &Path, limit: u64) -> Result<Cow<'a, [u8]>, Failure> {
        match &self.place {
            Place::Disk { within, .. } => files::read_within(found, within.as_deref(), limit).map(Cow::Owned),
            Place::Memory(files) => match in_memory(files, found) {
                Some((_, bytes)) if bytes.len() as u64 <= limit => Ok(Cow::Borrowed(bytes)),
                Some((_, bytes)) => Err(Failure::TooLarge(bytes.len() as u64)),
                None => Err(Failure::System(ErrorKind::NotFound.into())),
            },
        }
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

    /// Returns the names of the files and folders in a folder below.
    pub(super) fn names(&self, below: &Path) -> Rc<[OsString]> {
        match &self.place {
            Place::Disk { path, .. } => self.names_in(&path.join(below)),
            Place::Memory(files) => files.iter().map(|(name, _)| name.into()).collect(),
        }
    }

    /// The names in a folder on disk; none outside the folder whose files may be read.
    fn names_in(&self, folder: &Path) -> Rc<[OsString]> {
        let Place::Disk { within, .. } = &self.place else { return Rc::default() };
        let read = || {
            let may_be_read = within.as_ref().is_none_or(|within| files::is_within(listed(folder), within));
            let entries =
                std::fs::read_dir(listed(folder)).ok().filter(|_| may_be_read).into_iter().flatten().flatten();
            entries.map(|entry| entry.file_name()).collect()
        };
        Rc::clone(self.names.borrow_mut().entry(folder.to_path_buf()).or_insert_with(read))
    }
}

/// Whether a name is that of a material library.
pub(super) fn is_library(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("mtl"))
}

/// Whether two names are the same in any case. A byte that is no UTF-8 may be any letter beyond ASCII: old programs write names in the
/// code of their system.
pub(super) fn is_same(one: &OsStr, other: &OsStr) -> bool {
    let (one, other) = (one.to_string_lossy(), other.to_string_lossy());
    let is_lost = |a: char, b: char| [a, b].contains(&char::REPLACEMENT_CHARACTER) && !a.is_ascii() && !b.is_ascii();
    one.chars().count() == other.chars().count()
        && one.chars().zip(other.chars()).all(|(a, b)| a.eq_ignore_ascii_case(&b) || is_lost(a, b))
}

/// Finds the file of this exact name, or else in any case and without leading folders.
fn in_memory<'f, 'a>(files: &'f [(&'a str, &'a [u8])], name: &Path) -> Option<&'f (&'a str, &'a [u8])> {
    let base = name.file_name()?;
    let exact = files.iter().find(|(known, _)| Path::new(known) == name);
    exact.or_else(|| files.iter().find(|(known, _)| is_same(OsStr::new(known), base)))
}

/// Returns a folder's path for the system: an empty path becomes the current folder.
fn listed(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}
