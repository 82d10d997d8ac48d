//! The options and stages of reading a model.

use super::{ModelFrame, Pattern, SectionPlanes};
use crate::error::{Error, Result};
use crate::settings::{HasSettings, Setting, Table, under};
use crate::tolerances::{LARGEST_WELD, WELD};
use glam::DVec3;
use serde::{Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Options for reading a model.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadOptions {
    /// Welding distance, as a share of the bounding-box diagonal: nearer vertices become one. Default 1e-7, one unit in the
    /// last place of an f32 file; 0 welds only equal vertices; more closes cracks, too much removes small parts.
    pub weld: f64,
    /// Source of the normals. Default: the file, or computed where it has none.
    pub normals: Normals,
    /// Largest angle between neighbouring faces that share a computed normal. Default 60 degrees; more rounds edges off, less
    /// makes facets.
    pub smooth_angle_degrees: f64,
    /// How far lasting normals are averaged on surfaces that bend both ways: the root of the mean square of the distance, as a share of
    /// the bounding-box diagonal. Default 0.021; less keeps more relief, 0 all.
    pub normal_reach: f64,
    /// The axis that points up in the file. Default: its format's.
    pub up_axis: UpAxis,
    /// Whether a defect is an error. Default: no, it is counted.
    pub strict: bool,
    /// The frame of an animated model (MD2). Default 0, the first; a fraction interpolates between two frames.
    pub model_frame: ModelFrame,
    /// A picture for all of the model's surfaces. Default: the pictures that the file names, found beside it; for MD2 also one
    /// with the model's own name.
    pub skin: Option<PathBuf>,
    /// Whether the model may name files outside its folder: materials, data and pictures. Default: no. Such files, named by
    /// `..`, absolutely or through links, are skipped with a remark.
    pub allow_external: bool,
    /// The planes in front of all of which the model is cut away. Default: none.
    pub section: Option<SectionPlanes>,
    /// Spacing of the strokes on a cut in the file's axes, file units; 0 draws none. Default a sixtieth of the model.
    pub section_hatch: Option<f64>,
    /// Patterns of parts, and whether the planes leave them whole, as a drawing leaves shafts and bolts. The last pattern of a part
    /// counts. Default: none.
    pub uncut: Vec<(Pattern, bool)>,
}

/// The largest [`LoadOptions::normal_reach`].
const LARGEST_REACH: f64 = 0.1;

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            weld: WELD,
            normals: Normals::File,
            smooth_angle_degrees: 60.0,
            normal_reach: 0.021,
            up_axis: UpAxis::Auto,
            strict: false,
            model_frame: ModelFrame::default(),
            skin: None,
            allow_external: false,
            section: None,
            section_hatch: None,
            uncut: Vec::new(),
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
    /// The settings, which also suit a table that holds a `LoadOptions`.
    pub fn settings() -> Vec<Setting<Self>> {
        let settings = vec![
            Setting::field(
                "up-axis",
                "AXIS",
                "Axis that points up in the file: auto (that of its format), x, y, z, -x, -y, -z",
                |load: &mut Self| &mut load.up_axis,
            ),
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
                 checked (the file's, unless many stand far off their faces), \
                 lasting (as checked; if the file has none, computed with sharp edges only at long creases; averaged \
                 over their reach where it bends both ways), flat (one for each face), dachsbacher (one for each vertex, as in his text)",
                |load: &mut Self| &mut load.normals,
            ),
            Setting::field(
                "smooth-angle",
                "DEGREES",
                "Largest angle between two faces that computed normals round off, in degrees; more rounds off \
                 sharper edges",
                |load: &mut Self| &mut load.smooth_angle_degrees,
            )
            .inside("normals")
            .range(0.0, 180.0, 1),
            Setting::field(
                "reach",
                "SHARE",
                "How far lasting normals are averaged, as a share of the model's size; less keeps more relief, 0 all",
                |load: &mut Self| &mut load.normal_reach,
            )
            .inside("normals")
            .range(0.0, LARGEST_REACH, 3),
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
            .inside("texture")
            .said("the picture that the model names"),
            Setting::open_field(
                "section",
                "PLANE",
                "",
                "Cut away all beyond a plane, such as x=12 or 1,1,0=5, in the axes of the model's file; given twice, what lies \
                 beyond both, for a half-section; cut faces are hatched, and the part section",
                |load: &mut Self| &mut load.section,
            )
            .said("nothing is cut away")
            .common()
            .repeated(SectionPlanes::BETWEEN),
            Setting::open_field(
                "section-hatch",
                "SPACING",
                "auto",
                "Distance of the strokes on the cut of --section, in model units; 0 draws none",
                |load: &mut Self| &mut load.section_hatch,
            )
            .inside("section")
            .said("a sixtieth of the model, with --scale 2.5 mm on paper"),
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

/// Writes each setting under its name; a path that is not text is written lossily.
impl Serialize for LoadOptions {
    fn serialize<S: Serializer>(&self, to: S) -> std::result::Result<S::Ok, S::Error> {
        Self::table().record(self).serialize(to)
    }
}

crate::choices! {
    /// The source of a mesh's normals.
    #[derive(Hash)]
    pub enum Normals {
        /// From the file; computed smooth where the file has none.
        File = "file",
        /// From the file, unless many of them are averaged over sharp edges; computed smooth otherwise.
        Checked = "checked",
        /// Computed: smooth up to the smoothing angle.
        Smooth = "smooth",
        /// Checked as well. Where the file has none, or only repeats those of the faces, smooth, and split only along creases that
        /// extend over a share of the model. On surfaces that bend both ways they are averaged over a share of the model and not made
        /// unit again, which takes the noise of scans and the facets of figures out of tones.
        Lasting = "lasting",
        /// Computed: one normal per face.
        Flat = "flat",
        /// Computed by the listing of C. Dachsbacher's article: each position's normal is the normalised sum of its triangles'
        /// unit normals, without splits at creases.
        Dachsbacher = "dachsbacher",
    }
}

crate::choices! {
    /// The model's up axis.
    pub enum UpAxis {
        /// The format's up axis.
        Auto = "auto",
        /// +x is up.
        X = "x",
        /// +y is up, as in a [`Mesh`](super::Mesh).
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
    /// Rotates a vector to turn this axis into +y. Exact: components only change places and signs. For `Auto` the vector stays
    /// unchanged, because the file's positions have been turned by its [`Format`](super::Format).
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

/// The stages of reading a model, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadStage {
    /// Reads the bytes from the disk.
    Reading,
    /// Parses the bytes.
    Parsing,
    /// Welds vertices, cuts polygons into triangles and drops invalid faces.
    Joining,
    /// Computes normals, or takes them from the file.
    Normals,
}

impl LoadStage {
    /// Describes the stage in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reading => "reading the file",
            Self::Parsing => "parsing",
            Self::Joining => "joining vertices",
            Self::Normals => "normals",
        }
    }
}

/// Rejects invalid options.
pub(super) fn check(options: &LoadOptions) -> Result<()> {
    let within = |name: &'static str, value: f64, most: f64, problem: String| match (0.0..=most).contains(&value) {
        true => Ok(()),
        false => Err(Error::value(name, value, problem)),
    };
    let share = |of: &str, most: f64| format!("the {of} is a share of the model's size from 0 to {most}");
    within("weld", options.weld, LARGEST_WELD, share("tolerance", LARGEST_WELD))?;
    within("reach", options.normal_reach, LARGEST_REACH, share("reach", LARGEST_REACH))?;
    let angle = "the angle is between 0 and 180 degrees";
    within("smooth-angle", options.smooth_angle_degrees, 180.0, angle.to_owned())?;
    let spacing = options.section_hatch.unwrap_or_default();
    within("section-hatch", spacing, f64::MAX, "the spacing is a length, 0 or more".to_owned())?;
    options.skin.as_deref().map_or(Ok(()), check_skin)
}

/// Rejects a missing skin.
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
