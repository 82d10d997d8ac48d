//! How a model is read: the options, and the stages of reading.

use super::ModelFrame;
use crate::error::{Error, Result};
use crate::settings::{HasSettings, Setting, Table, under};
use crate::tolerances::{LARGEST_WELD, WELD};
use glam::DVec3;
use serde::{Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// How a model is read.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadOptions {
    /// Vertices nearer than this share of the bounding-box diagonal become one. Default 1e-7, one unit in the last
    /// place of an f32 file; 0 welds equal ones only; more closes cracks, too much eats small parts.
    pub weld: f64,
    /// Where normals come from. Default: the file, computed where it has none.
    pub normals: Normals,
    /// Neighbouring faces that differ by more than this angle do not share a computed normal. Default 60 degrees;
    /// more rounds edges off, less makes facets.
    pub smooth_angle_degrees: f64,
    /// The axis that points up in the file. Default: its format's, z for STL, MD2 and 3DS, y for the others.
    pub up_axis: UpAxis,
    /// Whether a defect is an error. Default: no, it is counted.
    pub strict: bool,
    /// The frame of an animated model (MD2). Default 0, the first; a fraction lies between two.
    pub model_frame: ModelFrame,
    /// A picture for all of the model's surfaces. Default: those the file names, found beside it; for MD2 also one that
    /// has the model's own name.
    pub skin: Option<PathBuf>,
    /// Whether files that the model names, materials, data and pictures, may lie outside its folder. Default: no, they are not
    /// followed, whether named by `..`, absolutely or through links, and that is said.
    pub allow_external: bool,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            weld: WELD,
            normals: Normals::File,
            smooth_angle_degrees: 60.0,
            up_axis: UpAxis::Auto,
            strict: false,
            model_frame: ModelFrame::default(),
            skin: None,
            allow_external: false,
        }
    }
}

impl HasSettings for LoadOptions {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<LoadOptions>> =
            LazyLock::new(|| Table { settings: LoadOptions::settings(), defaults: vec![LoadOptions::default()] });
        &TABLE
    }
}

impl LoadOptions {
    /// The settings, also for a table of something that is read.
    pub fn settings() -> Vec<Setting<Self>> {
        let settings = vec![
            Setting::field(
                "up-axis",
                "AXIS",
                "Axis that points up in the file: auto (z in STL, MD2 and 3DS, else y), x, y, z, -x, -y, -z",
                |load: &mut Self| &mut load.up_axis,
            )
            .common(),
            Setting::field(
                "weld",
                "SHARE",
                "Join vertices closer than this share of the model's size",
                |load: &mut Self| &mut load.weld,
            )
            .range(0.0, 0.001, 6)
            .said("1e-7"),
            Setting::field(
                "normals",
                "WHERE",
                "Normals: file (the file's; if it has none, as smooth), smooth (computed, see --smooth-angle), \
                 lasting (the file's; if it has none, computed without the noise of scans, with sharp edges only at \
                 long creases), flat (one for each face), dachsbacher (one for each vertex, as in his text)",
                |load: &mut Self| &mut load.normals,
            ),
            Setting::field(
                "smooth-angle",
                "DEGREES",
                "Largest angle between two faces that computed normals round off, in degrees; more rounds off \
                 sharper edges",
                |load: &mut Self| &mut load.smooth_angle_degrees,
            )
            .range(0.0, 180.0, 1),
            Setting::flag(
                "strict",
                "Refuse models with defects",
                |load: &Self| load.strict,
                |load, is_on| load.strict = is_on,
            )
            .said("off, defects are counted and skipped"),
            Setting::open_field(
                "skin",
                "FILE",
                "",
                "Picture for all surfaces (PCX, PNG, TGA, BMP, JPEG, PPM)",
                |load: &mut Self| &mut load.skin,
            )
            .said("the picture that the model names"),
            Setting::flag(
                "allow-external",
                "Also read material files, data and pictures outside the model's folder",
                |load: &Self| load.allow_external,
                |load, is_on| load.allow_external = is_on,
            )
            .said("off, they are reported and skipped"),
            Setting::field(
                "model-frame",
                "N|NAME",
                "Frame of an animated model (MD2): a number from 0, or a name; 1.5 is halfway between 1 and 2",
                |load: &mut Self| &mut load.model_frame,
            ),
        ];
        under("Models", settings).collect()
    }
}

/// Each setting under its name; of a path whose bytes are no text what can be kept.
impl Serialize for LoadOptions {
    fn serialize<S: Serializer>(&self, to: S) -> std::result::Result<S::Ok, S::Error> {
        Self::table().record(self).serialize(to)
    }
}

crate::choices! {
    /// Where a mesh's normals come from.
    #[derive(Hash)]
    pub enum Normals {
        /// From the file; computed smooth where the file has none.
        File = "file",
        /// Computed: smooth up to the smoothing angle.
        Smooth = "smooth",
        /// From the file; where it has none smooth, and split only along creases that reach through a share of the model: the single sharp
        /// edges of scans and of models of few triangles are smoothed. Where a surface has a scan's noise, that is evened out.
        Lasting = "lasting",
        /// Computed: each face its own.
        Flat = "flat",
        /// Computed by the listing of C. Dachsbacher's article: one normal a vertex, to which each triangle there adds its unit
        /// normal; nothing is split at creases.
        Dachsbacher = "dachsbacher",
    }
}

crate::choices! {
    /// The model's axis that shall point up.
    pub enum UpAxis {
        /// As the file's format has it: z up in STL and 3DS (where -y is the front) and in MD2 (where x is), y in the others.
        Auto = "auto",
        /// +x is up.
        X = "x",
        /// +y is up, as here.
        Y = "y",
        /// +z is up; -y is then the front.
        Z = "z",
        /// -x is up.
        MinusX = "-x",
        /// -y is up.
        MinusY = "-y",
        /// -z is up.
        MinusZ = "-z",
    }
}

impl UpAxis {
    /// Rotates a vector so that this axis becomes +y; exact, components only change places and signs. For `Auto` the
    /// vector stays: it was turned as its format has it.
    pub fn to_y_up(self, v: DVec3) -> DVec3 {
        match self {
            Self::X => DVec3::new(-v.y, v.x, v.z),
            Self::Auto | Self::Y => v,
            Self::Z => DVec3::new(v.x, v.z, -v.y),
            Self::MinusX => DVec3::new(v.y, -v.x, v.z),
            Self::MinusY => DVec3::new(-v.x, -v.y, v.z),
            Self::MinusZ => DVec3::new(v.x, -v.z, v.y),
        }
    }
}

/// What is being done while a model is read, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadStage {
    /// Its bytes come from the disk.
    Reading,
    /// They are understood.
    Parsing,
    /// Vertices become one, polygons triangles, faces that are none are dropped.
    Joining,
    /// Normals are made, or those of the file taken over.
    Normals,
}

impl LoadStage {
    /// What it does, in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reading => "reading the file",
            Self::Parsing => "parsing",
            Self::Joining => "joining vertices",
            Self::Normals => "normals",
        }
    }
}

/// Refuses options that are nonsense.
pub(super) fn check(options: &LoadOptions) -> Result<()> {
    if !(0.0..=LARGEST_WELD).contains(&options.weld) {
        return Err(Error::value(
            "weld",
            options.weld,
            format!("the tolerance is a share of the model's size from 0 to {LARGEST_WELD}"),
        ));
    }
    if !(0.0..=180.0).contains(&options.smooth_angle_degrees) {
        return Err(Error::value(
            "smooth-angle",
            options.smooth_angle_degrees,
            "the angle is between 0 and 180 degrees",
        ));
    }
    options.skin.as_deref().map_or(Ok(()), check_skin)
}

/// Refuses a skin that is not there.
fn check_skin(skin: &Path) -> Result<()> {
    if skin.is_file() {
        return Ok(());
    }
    let problem = if skin.is_dir() {
        "this is a directory; name a picture in it"
    } else if skin.exists() {
        "this is not a regular file; name a picture"
    } else {
        "there is no such file; check the name after --skin"
    };
    Err(Error::picture(skin, problem))
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
            let axis = <UpAxis as crate::settings::Value>::parse(text).unwrap();
            assert_eq!(axis.to_y_up(up), DVec3::Y, "{text}");
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| axis.to_y_up(v));
            assert_eq!(x.cross(y), z, "{text} keeps handedness");
        }
    }
    #[test]
    fn a_skin_that_is_not_there_is_refused_by_name() {
        let message = |path: &str| check_skin(Path::new(path)).unwrap_err().to_string();
        assert!(message("no-such.pcx").starts_with("no-such.pcx: there is no such file"));
        assert!(message("/").contains("directory"));
    }
}
