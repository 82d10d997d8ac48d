//! Detects a model file's format, first by content, then by name.

use super::{md2, obj, stl, three_ds};
use std::path::Path;

/// How GLB begins, glTF in one file.
pub(super) const GLB_MAGIC: &[u8] = b"glTF";

/// The formats read here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Ply,
    Stl,
    Md2,
    ThreeDs,
    Gltf,
}

/// Returns the common name of an unsupported format, from the file name's ending.
pub(super) fn unread(path: &str) -> Option<&'static str> {
    Some(match Path::new(path).extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "step" | "stp" => "STEP",
        "iges" | "igs" => "IGES",
        "brep" => "BREP",
        "fcstd" => "FreeCAD",
        "sldprt" | "sldasm" => "SolidWorks",
        "f3d" => "Fusion",
        "ipt" | "iam" => "Inventor",
        "dwg" => "DWG",
        "skp" => "SketchUp",
        "3dm" => "Rhino",
        "scad" => "OpenSCAD",
        "max" => "3ds Max",
        "ma" | "mb" => "Maya",
        "c4d" => "Cinema 4D",
        "usd" | "usda" | "usdc" | "usdz" => "USD",
        "3mf" => "3MF",
        "ase" => "ASE",
        "blend" => "Blender",
        "dae" => "Collada",
        "dxf" => "DXF",
        "fbx" => "FBX",
        "lwo" => "LWO",
        "md3" => "MD3",
        "ms3d" => "MS3D",
        "nff" => "NFF",
        "off" => "OFF",
        "x" => "X",
        _ => return None,
    })
}

/// Whether the file name's ending is that of a format read here.
pub fn is_read(name: &str) -> bool {
    Format::by_name(name).is_some()
}

/// Whether the file name's ending is that of a model format, supported or not.
pub fn is_model_name(name: &str) -> bool {
    is_read(name) || unread(name).is_some()
}

impl Format {
    /// All of them, for messages.
    pub(super) const NAMES: &'static str = "OBJ, PLY, STL, MD2, 3DS or glTF";

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Md2 => "MD2",
            Self::ThreeDs => "3DS",
            Self::Gltf => "glTF",
        }
    }

    pub(super) fn by_name(path: &str) -> Option<Self> {
        match Path::new(path).extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "md2" => Some(Self::Md2),
            "3ds" => Some(Self::ThreeDs),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// Whether the format's beginning is unique. Any text may have a line that looks like OBJ or STL.
    pub(super) fn is_unmistakable(self) -> bool {
        !matches!(self, Self::Obj | Self::Stl)
    }

    pub(super) fn by_content(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(4096)];
        if head.starts_with(b"ply\n") || head.starts_with(b"ply\r") {
            return Some(Self::Ply);
        }
        if head.starts_with(GLB_MAGIC) || is_gltf_json(head) {
            return Some(Self::Gltf);
        }
        if head.starts_with(md2::MAGIC) {
            return Some(Self::Md2);
        }
        if three_ds::looks_like(head) {
            return Some(Self::ThreeDs);
        }
        if stl::is_binary(bytes) || stl::is_text(head) {
            return Some(Self::Stl);
        }
        obj::looks_like(head).then_some(Self::Obj)
    }
}

/// Whether the beginning of a file reads like glTF's JSON.
fn is_gltf_json(head: &[u8]) -> bool {
    const WORDS: [&[u8]; 6] =
        [b"\"asset\"", b"\"accessors\"", b"\"buffers\"", b"\"bufferViews\"", b"\"meshes\"", b"\"nodes\""];
    head.trim_ascii_start().starts_with(b"{") && WORDS.iter().any(|word| memchr::memmem::find(head, word).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_apart_by_content() {
        assert_eq!(Format::by_content(b"ply\nformat ascii 1.0\n"), Some(Format::Ply));
        assert_eq!(Format::by_content(b"solid x\n facet normal 0 0 1\n"), Some(Format::Stl));
        assert_eq!(Format::by_content(b"# made by\nv 1 2 3\n"), Some(Format::Obj));
        assert_eq!(Format::by_content(&[0, 159, 146, 150, 7]), None);
        let mut binary = vec![0u8; 84 + 50];
        binary[80] = 1;
        assert_eq!(Format::by_content(&binary), Some(Format::Stl));
        assert_eq!((Format::by_name("a.MS3D"), unread("a.MS3D")), (None, Some("MS3D")));
        assert_eq!(Format::by_content(b"IDP2\x08\0\0\0"), Some(Format::Md2));
        assert_eq!(Format::by_content(b"MM\x10\0\0\0\x02\0\x0a\0\0\0\x03\0\0\0"), Some(Format::ThreeDs));
        assert_eq!(Format::by_content(b"glTF\x02\0\0\0"), Some(Format::Gltf));
        assert_eq!(Format::by_content(b" {\n  \"asset\": {}}"), Some(Format::Gltf));
        assert_eq!(Format::by_content(b"{\"v\": 1}"), None, "other JSON");
        assert_eq!(Format::by_content(b"MM\0*\0\0\0\x08"), None, "a TIFF picture");
    }
}
