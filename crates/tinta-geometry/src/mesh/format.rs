//! The formats of models: a row for each that is read, found by a file's content first, then by its name.
//!
//! Help, messages, the page and Python list the rows, and [`load`](super::load()) does what they say.

use super::folder::Folder;
use super::options::{LoadOptions, UpAxis};
use super::soup::Soup;
use super::{md2, obj, ply, stl, three_ds};
use crate::error::Result;
use glam::DVec3;
use std::path::Path;

/// A model file for its reader.
pub(super) struct ModelFile<'a> {
    pub bytes: &'a [u8],
    /// Its name in messages.
    pub path: &'a str,
    /// What holds the files that it names.
    pub folder: &'a Folder<'a>,
    pub options: &'a LoadOptions,
}

/// Reads a file; the list gets a sentence for each remark.
type FormatReader = fn(&ModelFile<'_>, &mut Vec<String>) -> Result<Soup>;

/// A format that is read: a row of [`Format::ALL`].
#[derive(Debug)]
pub struct Format {
    /// Its name in help and messages.
    pub name: &'static str,
    /// The endings of its files' names, in small letters and without a dot.
    pub endings: &'static [&'static str],
    /// Whether bytes are such a file.
    is_it: fn(&[u8]) -> bool,
    /// Whether no other file begins so. Any text may have a line that looks like OBJ or STL.
    pub(super) is_unmistakable: bool,
    /// Which of its axes is up.
    pub(super) up: Up,
    pub(super) read: FormatReader,
}

/// How a file's positions turn to y up with the front towards +z, `None` where they are so; and the other axis that may be up, where the
/// format does not say which is.
type Up = (Option<fn(DVec3) -> DVec3>, Option<UpAxis>);

const FROM_Z_UP: Option<fn(DVec3) -> DVec3> = Some(|position| UpAxis::Z.to_y_up(position));
const MOSTLY_Y: Up = (None, Some(UpAxis::Z));
const Z: Up = (FROM_Z_UP, None);
const MOSTLY_Z: Up = (FROM_Z_UP, Some(UpAxis::Y));

impl Format {
    /// Every format that is read. Of several that a file's content may be, the last is taken.
    pub const ALL: &'static [Self] = &[
        Self {
            is_unmistakable: false,
            ..Self::new("OBJ", &["obj"], obj::looks_like, MOSTLY_Y, |it, said| {
                obj::read(it.bytes, it.path, it.folder, said)
            })
        },
        Self {
            is_unmistakable: false,
            ..Self::new("STL", &["stl"], stl::looks_like, MOSTLY_Z, |it, said| stl::read(it.bytes, it.path, said))
        },
        Self::new("PLY", &["ply"], ply::looks_like, MOSTLY_Y, |it, said| ply::read(it.bytes, it.path, said)),
        Self::new("MD2", &["md2"], md2::looks_like, (Some(md2::to_y_up), None), |it, said| {
            md2::read(it.bytes, it.path, it.options, it.folder, said)
        }),
        Self::new("3DS", &["3ds"], three_ds::looks_like, Z, |it, said| three_ds::read(it.bytes, it.path, said)),
        #[cfg(feature = "3mf")]
        Self::new("3MF", &["3mf"], super::three_mf::looks_like, Z, |it, said| {
            super::three_mf::read(it.bytes, it.path, said)
        }),
        #[cfg(feature = "gltf")]
        Self::new("glTF", &["gltf", "glb"], super::gltf::looks_like, (None, None), |it, said| {
            super::gltf::read(it.bytes, it.path, it.folder, said)
        }),
    ];

    const fn new(
        name: &'static str,
        endings: &'static [&'static str],
        is_it: fn(&[u8]) -> bool,
        up: Up,
        read: FormatReader,
    ) -> Self {
        Self { name, endings, is_it, is_unmistakable: true, up, read }
    }

    /// Returns their names.
    pub fn names() -> Vec<&'static str> {
        Self::ALL.iter().map(|format| format.name).collect()
    }

    /// Returns the format with this ending of a file's name.
    pub fn of_name(name: &str) -> Option<&'static Self> {
        let ending = ending(name)?;
        Self::ALL.iter().find(|format| format.endings.contains(&ending.as_str()))
    }

    /// Returns the format that a file's content is in.
    pub(super) fn of_content(bytes: &[u8]) -> Option<&'static Self> {
        Self::ALL.iter().rev().find(|format| (format.is_it)(bytes))
    }
}

/// Whether the file name's ending is that of a model format, supported or not.
pub fn is_model_name(name: &str) -> bool {
    Format::of_name(name).is_some() || unread(name).is_some()
}

fn ending(name: &str) -> Option<String> {
    Some(Path::new(name).extension()?.to_str()?.to_ascii_lowercase())
}

/// The formats that are not read, each with the endings of its files' names.
const UNREAD: &str = "\
    STEP step stp, IGES iges igs, BREP brep, FreeCAD fcstd, SolidWorks sldprt sldasm, Fusion f3d, Inventor ipt iam, DWG dwg, \
    SketchUp skp, Rhino 3dm, OpenSCAD scad, 3ds_Max max, Maya ma mb, Cinema_4D c4d, USD usd usda usdc usdz, ASE ase, \
    Blender blend, Collada dae, DXF dxf, FBX fbx, LWO lwo, MD3 md3, MS3D ms3d, NFF nff, OFF off, X x";

/// Returns the common name of an unsupported format, from the file name's ending.
pub(super) fn unread(path: &str) -> Option<String> {
    let ending = ending(path)?;
    let found = UNREAD.split(", ").find(|row| row.split(' ').skip(1).any(|known| known == ending))?;
    Some(found.split(' ').next()?.replace('_', " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_apart_by_content() {
        let name = |bytes: &[u8]| Format::of_content(bytes).map(|format| format.name);
        assert_eq!(name(b"ply\nformat ascii 1.0\n"), Some("PLY"));
        assert_eq!(name(b"solid x\n facet normal 0 0 1\n"), Some("STL"));
        assert_eq!(name(b"# made by\nv 1 2 3\n"), Some("OBJ"));
        assert_eq!(name(&[0, 159, 146, 150, 7]), None);
        let mut binary = vec![0u8; 84 + 50];
        binary[80] = 1;
        assert_eq!(name(&binary), Some("STL"));
        assert!(Format::of_name("a.MS3D").is_none() && unread("a.MS3D").as_deref() == Some("MS3D"));
        assert_eq!(name(b"IDP2\x08\0\0\0"), Some("MD2"));
        assert_eq!(name(b"MM\x10\0\0\0\x02\0\x0a\0\0\0\x03\0\0\0"), Some("3DS"));
        assert_eq!(name(b"glTF\x02\0\0\0"), Some("glTF"));
        assert_eq!(name(b" {\n  \"asset\": {}}"), Some("glTF"));
        assert_eq!(name(b"{\"v\": 1}"), None, "other JSON");
        assert_eq!(name(b"MM\0*\0\0\0\x08"), None, "a TIFF picture");
    }

    #[test]
    fn every_ending_is_of_one_format_that_is_read() {
        let endings: Vec<&str> = Format::ALL.iter().flat_map(|format| format.endings).copied().collect();
        for (place, ending) in endings.iter().enumerate() {
            assert!(!endings[..place].contains(ending) && unread(&format!("a.{ending}")).is_none(), "{ending}");
        }
    }
}
