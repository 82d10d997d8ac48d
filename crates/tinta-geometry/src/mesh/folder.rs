//! A model's folder: where the files it names are looked for, and what it may not lead out of.
//!
//! A model may name any file of its reader's disk: `..`, absolute, or by a link in its folder. None of them is followed
//! unless `LoadOptions::allow_external`; whether a file lies inside is asked of its real path, links resolved.

use super::{EmbeddedPicture, Material};
use crate::files::{self, Failure};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What lies beside a model.
#[derive(Debug)]
pub(super) struct Folder<'a> {
    place: Place<'a>,
    /// The names of what lies in it, read when first asked for.
    names: OnceCell<Vec<String>>,
}

#[derive(Debug)]
enum Place<'a> {
    /// A folder of the disk, and what its files must lie in: its real path; `None` where they may lie anywhere.
    Disk { path: PathBuf, within: Option<PathBuf> },
    /// Files out of memory. Of none, nobody looks for any.
    Memory(&'a [(&'a str, &'a [u8])]),
}

/// What became of a file that a model names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Lookup {
    /// It lies here.
    Here(PathBuf),
    /// It is there but outside the folder.
    Outside,
    /// There is no such file.
    Nowhere,
}

impl<'a> Folder<'a> {
    /// The folder of a model file.
    pub(super) fn of(model: &str, allow_external: bool) -> Self {
        let path = Path::new(model).parent().unwrap_or(Path::new("")).to_path_buf();
        // A folder that is not there has no files either.
        let real = || listed(&path).canonicalize().unwrap_or_else(|_| path.clone());
        Self { place: Place::Disk { within: (!allow_external).then(real), path }, names: OnceCell::new() }
    }

    /// These files, by their names. Of none, nothing is found and nothing missed.
    pub(super) fn of_files(files: &'a [(&'a str, &'a [u8])]) -> Self {
        Self { place: Place::Memory(files), names: OnceCell::new() }
    }

    /// Whether there is anything to look in.
    pub(super) fn is_some(&self) -> bool {
        !matches!(self.place, Place::Memory([]))
    }

    /// Where on the disk a file of this name would be.
    pub(super) fn place_of(&self, name: &str) -> Option<PathBuf> {
        match &self.place {
            Place::Disk { path, .. } => Some(path.join(name)),
            Place::Memory(_) => None,
        }
    }

    /// The file of this name, which may have folders before it.
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

    /// The file of this name as seen from a folder above the model's: games name pictures from where they are installed.
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

    /// The name of the folder that a file of the disk lies in.
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

    /// Reads a material library: the file of this name, or out of memory the only one, whatever it is called.
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

    /// Makes what was found here a material's picture; it is read when a style needs it.
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

    /// The names of the files and folders in it, as far as they are text.
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

/// The file of this name: as it is written, or in any case without the folders before it.
fn in_memory<'f, 'a>(files: &'f [(&'a str, &'a [u8])], name: &Path) -> Option<&'f (&'a str, &'a [u8])> {
    let base = name.file_name()?.to_str()?;
    let exact = files.iter().find(|(known, _)| Path::new(known) == name);
    exact.or_else(|| files.iter().find(|(known, _)| known.eq_ignore_ascii_case(base)))
}

/// A folder as the system wants it: an empty path is the current folder.
fn listed(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}
