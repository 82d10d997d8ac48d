//! Historical formats that libassimp still reads: MS3D, LWO, ASE, DXF, X and others, by their names.
//!
//! The library is the system's, loaded when such a file is opened (cargo feature `assimp`), and does all the reading; it sees only
//! the model and what lies in its folder. It is C++ that parses files from anywhere: where it crashes, so does the program.
//! What comes out of it, and of which version, is in `library.rs`, the one file with `unsafe` code here.

#[cfg(feature = "assimp")]
mod imported;
#[cfg(feature = "assimp")]
mod library;
#[cfg(feature = "assimp")]
mod scene;

#[cfg(feature = "assimp")]
pub(super) use scene::read;

#[cfg(not(feature = "assimp"))]
use super::{folder::Folder, load::LoadOptions, soup::Soup};

/// The endings of files that libassimp is asked to read, with what people call their format.
const FORMATS: [(&str, &str); 32] = [
    ("3mf", "3MF"),
    ("ac", "AC3D"),
    ("ac3d", "AC3D"),
    ("acc", "AC3D"),
    ("ase", "ASE"),
    ("ask", "ASE"),
    ("b3d", "Blitz 3D"),
    ("blend", "Blender"),
    ("cob", "Caligari"),
    ("dae", "Collada"),
    ("dxf", "DXF"),
    ("enff", "NFF"),
    ("fbx", "FBX"),
    ("hmp", "HMP"),
    ("irr", "Irrlicht"),
    ("irrmesh", "Irrlicht"),
    ("lwo", "LWO"),
    ("lws", "LWS"),
    ("lxo", "LXO"),
    ("md3", "MD3"),
    ("md5mesh", "MD5"),
    ("mdc", "MDC"),
    ("mdl", "MDL"),
    ("ms3d", "MS3D"),
    ("ndo", "NDO"),
    ("nff", "NFF"),
    ("off", "OFF"),
    ("q3o", "Quick3D"),
    ("scn", "TrueSpace"),
    ("smd", "SMD"),
    ("ter", "Terragen"),
    ("x", "X"),
];

/// The format of a file with this ending, in small letters, if libassimp reads it.
pub(super) fn format_of(extension: &str) -> Option<&'static str> {
    FORMATS.iter().find(|(known, _)| *known == extension).map(|(_, name)| *name)
}

/// Says what is missing.
#[cfg(not(feature = "assimp"))]
pub(super) fn read(
    _: &[u8],
    format: &str,
    path: &str,
    _: &LoadOptions,
    _: &Folder<'_>,
    _: &mut Vec<String>,
) -> crate::Result<Soup> {
    let problem = format!(
        "{format} is read by libassimp: install libassimp5 and build tinta by cargo build --release --features assimp, \
         or save it as OBJ"
    );
    Err(crate::Error::model(path, problem))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_is_there_once_and_none_is_one_that_is_read_here() {
        assert!(FORMATS.is_sorted_by(|a, b| a.0 < b.0));
        for (extension, _) in FORMATS {
            let format = crate::mesh::format::Format::by_name(&format!("a.{}", extension.to_uppercase())).unwrap();
            assert!(format.name() == format_of(extension).unwrap(), "{extension}");
        }
    }
}
