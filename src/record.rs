//! The record of one rendering, its settings and times, as one JSON object.
//!
//! ```
//! use tinta::record::Summary;
//!
//! let times = Summary::new(vec![3.0, 1.0, 2.0]);
//! assert_eq!((times.min, times.median, times.max), (1.0, 2.0, 3.0));
//! ```

mod camera;
mod json;
mod lines;
mod regions;

pub use camera::CameraRecord;
pub use lines::{LineCounts, LinesMade, drawing_json};
pub(crate) use regions::px_per_unit;
pub use regions::regions_json;

use crate::gl::ContextInfo;
use crate::mesh::{Defects, LoadOptions, Mesh};
use crate::plan::Submission;
use crate::plan::prune::{IdleRule, Omission};
use crate::renderer::{PassTime, median};
use crate::scene::{Background, Color, Size};
use crate::styles::{Show, Style};
use serde::Serialize;

/// A drawing's record: enough to repeat it and to compare its cost.
#[derive(Debug, Clone, Serialize)]
pub struct Record {
    /// tinta's version.
    pub version: &'static str,
    /// All models together, with copies counted once; their paths with commas between them.
    pub model: ModelRecord,
    /// Each model in the order given.
    pub models: Vec<ModelRecord>,
    /// How they were read.
    pub load: LoadOptions,
    /// The number of copies of the models.
    pub copies: u32,
    /// Triangles drawn, all copies together.
    pub triangles: usize,
    /// The style with every setting.
    pub style: Style,
    /// The exact lines over its picture or areas, with every setting.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact_lines: Option<Style>,
    /// The picture's size.
    pub size: Size,
    /// The background behind the objects.
    pub background: Background,
    /// The camera, world space.
    pub camera: CameraRecord,
    /// Remarks on the drawing: deviations of lines from the request.
    pub remarks: Vec<String>,
    /// Time to read the models and make meshes of them.
    pub load_ms: f64,
    /// How it was made.
    #[serde(flatten)]
    pub made: DrawingFacts,
}

/// The settings and times of a drawing.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum DrawingFacts {
    /// In passes, by OpenGL.
    Picture(Box<PictureMade>),
    /// As exact lines.
    Lines(Box<LinesMade>),
}

/// The settings and times of a picture.
#[derive(Debug, Clone, Serialize)]
pub struct PictureMade {
    /// The picture of the style.
    pub show: Show,
    /// The colour of surfaces without one, or of all.
    pub color: Color,
    /// Whether that colour replaces the model's own.
    pub recolor: bool,
    /// The context.
    pub gl: ContextInfo,
    /// Each pass's median times, where frames are timed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<Vec<PassTime>>,
    /// How vertices were passed to GL.
    pub submission: Submission,
    /// The parts of the published plan that were left out, with reasons.
    pub omissions: Vec<Omission>,
    /// The rules that left everything in, with reasons.
    pub kept: Vec<IdleRule>,
    /// Time to make the plan; for the style inking it covers edge list, classes, silhouettes and light.
    pub plan_ms: f64,
    /// Time to open the context, on a separate thread during the loading.
    pub context_ms: f64,
    /// Time to draw one triangle while the models were still being read, which compiles the driver's shaders meanwhile; `null` if
    /// they were read first.
    pub warm_up_ms: Option<f64>,
    /// Time of the first frame, including uploads, and the driver's compiling unless it was warmed up.
    pub first_frame_ms: f64,
    /// The frames after warm-up, read-back included, where frames are timed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_ms: Option<Summary>,
}

/// One model.
#[derive(Debug, Clone, Serialize)]
pub struct ModelRecord {
    /// As the user named it.
    pub path: String,
    /// Welded positions.
    pub vertices: usize,
    /// Triangles with area.
    pub triangles: usize,
    /// The file's defects.
    pub defects: Defects,
}

impl ModelRecord {
    /// A mesh's.
    pub fn new(mesh: &Mesh) -> Self {
        Self {
            path: mesh.name.clone(),
            vertices: mesh.positions.len(),
            triangles: mesh.triangles.len(),
            defects: mesh.defects.clone(),
        }
    }

    /// Returns several models as one.
    pub fn together(models: &[Self]) -> Self {
        let paths: Vec<&str> = models.iter().map(|model| model.path.as_str()).collect();
        Self {
            path: paths.join(", "),
            vertices: models.iter().map(|model| model.vertices).sum(),
            triangles: models.iter().map(|model| model.triangles).sum(),
            defects: models.iter().map(|model| &model.defects).sum(),
        }
    }
}

/// The file of measured rows inside a report's folder.
pub const ROWS_FILE: &str = "results.jsonl";

/// Times and their summary, milliseconds.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    /// The middle one.
    pub median: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// All times in the order measured.
    pub all: Vec<f64>,
}

impl Summary {
    /// Summarises times; zeros for an empty list.
    pub fn new(all: Vec<f64>) -> Self {
        Self {
            median: median(all.clone()).unwrap_or_default(),
            min: all.iter().copied().min_by(f64::total_cmp).unwrap_or_default(),
            max: all.iter().copied().max_by(f64::total_cmp).unwrap_or_default(),
            all,
        }
    }
}
