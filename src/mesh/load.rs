//! From a path to a [`Mesh`]: built-in or file, its format found by content first and by name second.

use super::{Mesh, builtin, obj, ply, soup::Soup, stl};
use crate::error::{Error, Result};
use glam::DVec3;
use serde::Serialize;
use std::{fs, path::Path, str::FromStr};

/// How a model is read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadOptions {
    /// Vertices nearer than this share of the bounding-box diagonal become one. Default 1e-7, one unit in the last
    /// place of an f32 file; 0 welds equal ones only; more closes cracks, too much eats small parts.
    pub weld: f64,
    /// Where normals come from. Default: the file, computed where it has none.
    pub normals: Normals,
    /// Neighbouring faces that differ by more than this angle do not share a computed normal. Default 60 degrees;
    /// more rounds edges off, less makes facets.
    pub smooth_angle_degrees: f64,
    /// The axis that points up in the file. Default y.
    pub up_axis: UpAxis,
    /// Whether a defect is an error. Default: no, it is counted.
    pub strict: bool,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { weld: 1e-7, normals: Normals::File, smooth_angle_degrees: 60.0, up_axis: UpAxis::Y, strict: false }
    }
}

/// Where a mesh's normals come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Normals {
    /// From the file; computed smooth where the file has none.
    File,
    /// Computed: smooth up to the smoothing angle.
    Smooth,
    /// Computed: each face its own.
    Flat,
}

/// The model's axis that shall point up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum UpAxis {
    /// +x is up.
    X,
    /// +y is up, as here.
    Y,
    /// +z is up; -y is then the front.
    Z,
    /// -x is up.
    #[serde(rename = "-x")]
    MinusX,
    /// -y is up.
    #[serde(rename = "-y")]
    MinusY,
    /// -z is up.
    #[serde(rename = "-z")]
    MinusZ,
}

impl UpAxis {
    /// Rotates a vector so that this axis becomes +y; exact, components only change places and signs.
    pub fn to_y_up(self, v: DVec3) -> DVec3 {
        match self {
            Self::X => DVec3::new(-v.y, v.x, v.z),
            Self::Y => v,
            Self::Z => DVec3::new(v.x, v.z, -v.y),
            Self::MinusX => DVec3::new(v.y, -v.x, v.z),
            Self::MinusY => DVec3::new(-v.x, -v.y, v.z),
            Self::MinusZ => DVec3::new(v.x, -v.z, v.y),
        }
    }
}

impl FromStr for UpAxis {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        match text.strip_prefix('+').unwrap_or(text) {
            "x" => Ok(Self::X),
            "y" => Ok(Self::Y),
            "z" => Ok(Self::Z),
            "-x" => Ok(Self::MinusX),
            "-y" => Ok(Self::MinusY),
            "-z" => Ok(Self::MinusZ),
            _ => Err("an axis is one of x, y, z, -x, -y, -z".to_owned()),
        }
    }
}

/// The formats read here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Ply,
    Stl,
}

impl Format {
    fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
        }
    }

    fn by_name(path: &str) -> Option<Self> {
        match Path::new(path).extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            _ => None,
        }
    }

    fn by_content(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(4096)];
        if head.starts_with(b"ply\n") || head.starts_with(b"ply\r") {
            return Some(Self::Ply);
        }
        if stl::is_binary(bytes) || stl::is_text(head) {
            return Some(Self::Stl);
        }
        obj::looks_like(head).then_some(Self::Obj)
    }
}

/// What [`load`] read and what it noticed on the way, to be said once.
#[derive(Debug)]
pub struct Loaded {
    /// The model.
    pub mesh: Mesh,
    /// Sentences about the file, each naming it: a format other than the name says, defects, missing materials.
    pub remarks: Vec<String>,
}

/// Reads a model: `builtin:NAME`, or an OBJ, PLY or STL file.
///
/// # Errors
///
/// [`Error::Model`] when the file is missing, unreadable, empty, damaged, of no known format or holds nothing to draw;
/// [`Error::Strict`] when it has defects and `options.strict`; [`Error::Setting`] when an option is nonsense.
pub fn load(path: &str, options: &LoadOptions) -> Result<Loaded> {
    check(options)?;
    let mut remarks = Vec::new();
    let soup = match builtin::find(path) {
        Some(model) => builtin::read(&model?, path, &mut remarks)?,
        None => read_file(path, &mut remarks)?,
    };
    let mesh = soup.into_mesh(path, options)?;
    if !mesh.defects.is_empty() {
        remarks.push(format!("{path}: {}", mesh.defects));
    }
    Ok(Loaded { mesh, remarks })
}

fn check(options: &LoadOptions) -> Result<()> {
    if !(0.0..=0.1).contains(&options.weld) {
        return Err(Error::setting(
            format!("--weld {}", options.weld),
            "the tolerance is a share of the model's size from 0 to 0.1",
        ));
    }
    if !(0.0..=180.0).contains(&options.smooth_angle_degrees) {
        return Err(Error::setting(
            format!("--smooth-angle {}", options.smooth_angle_degrees),
            "the angle is between 0 and 180 degrees",
        ));
    }
    Ok(())
}

fn read_file(path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    let bytes = fs::read(path).map_err(|error| Error::model(path, cannot_read(Path::new(path), &error)))?;
    if bytes.is_empty() {
        return Err(Error::model(path, "the file is empty; export the model again"));
    }
    let named = Format::by_name(path);
    let found = Format::by_content(&bytes);
    let format = found
        .or(named)
        .ok_or_else(|| Error::model(path, "this is not a model in a format known here; use an OBJ, PLY or STL file"))?;
    if let (Some(named), Some(found)) = (named, found)
        && named != found
    {
        remarks.push(format!("{path}: named {} but holds {}, read as that", named.name(), found.name()));
    }
    match format {
        Format::Obj => {
            let folder = Path::new(path).parent().unwrap_or(Path::new("")).to_path_buf();
            obj::read(&bytes, path, &obj::Materials::Beside(folder), remarks)
        }
        Format::Ply => ply::read(&bytes, path),
        Format::Stl => stl::read(&bytes, path),
    }
}

fn cannot_read(path: &Path, error: &std::io::Error) -> String {
    use std::io::ErrorKind;
    match error.kind() {
        ErrorKind::NotFound => "there is no such file; check the name".to_owned(),
        ErrorKind::PermissionDenied => "it may not be read; check its permissions".to_owned(),
        _ if path.is_dir() => "this is a directory; name a model file in it".to_owned(),
        _ => format!("it cannot be read ({error})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_up_axis_turns_into_y_by_a_rotation() {
        let axes = [
            ("x", DVec3::X),
            ("y", DVec3::Y),
            ("z", DVec3::Z),
            ("-x", DVec3::NEG_X),
            ("-y", DVec3::NEG_Y),
            ("-z", DVec3::NEG_Z),
        ];
        for (text, up) in axes {
            let axis: UpAxis = text.parse().unwrap();
            assert_eq!(axis.to_y_up(up), DVec3::Y, "{text}");
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| axis.to_y_up(v));
            assert_eq!(x.cross(y), z, "{text} keeps handedness");
        }
    }

    #[test]
    fn formats_are_told_apart_by_content() {
        assert_eq!(Format::by_content(b"ply\nformat ascii 1.0\n"), Some(Format::Ply));
        assert_eq!(Format::by_content(b"solid x\n facet normal 0 0 1\n"), Some(Format::Stl));
        assert_eq!(Format::by_content(b"# made by\nv 1 2 3\n"), Some(Format::Obj));
        assert_eq!(Format::by_content(&[0, 159, 146, 150, 7]), None);
        let mut binary = vec![0u8; 84 + 50];
        binary[80] = 1;
        assert_eq!(Format::by_content(&binary), Some(Format::Stl));
    }
}
