//! One measured setting: error and time together, as a line of `results.jsonl`.

use super::Conditions;
use super::frames::FrameTimes;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use tinta::renderer::median;

/// A setting on a model: how wrong and how slow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// tinta's version.
    pub version: String,
    /// Operating system, processor architecture and parallel threads, or the value of `--machine`.
    pub machine: String,
    /// GL_RENDERER; `none` for lines found without GL.
    pub renderer: String,
    /// GL_VERSION; empty without GL.
    #[serde(default)]
    pub gl_version: String,
    /// Date, commit, processor, load.
    #[serde(flatten)]
    pub conditions: Conditions,
    /// The model as the user named it.
    pub model: String,
    /// Triangles drawn.
    pub triangles: usize,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The style's name.
    pub style: String,
    /// The options that make this setting, as `tinta render` takes them, the style among them.
    pub options: String,
    /// Whether these are the published program's own settings.
    pub is_faithful: bool,
    /// Whether steps that this scene does not need were left out, as `tinta render` does.
    #[serde(default)]
    pub is_pruned: bool,
    /// Whether the style draws the very lines that it is judged by: its error then says little.
    #[serde(default)]
    pub has_own_reference: bool,
    /// How well its lines are those of the reference; `None` for a style without lines.
    pub lines: Option<LineError>,
    /// The agreement of its tones with the reference's; `None` for a style without separate tones.
    pub tones: Option<ToneError>,
    /// How long it takes.
    pub time: RunTime,
}

impl Row {
    /// The key of a row: machine, model, size and options.
    pub(crate) fn key(&self) -> String {
        format!(
            "{} | {} | {} | {}x{} | {}",
            self.machine, self.renderer, self.model, self.size[0], self.size[1], self.options
        )
    }
}

tinta_geometry::choices! {
    /// The reference of lines.
    #[derive(Default, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Against {
        /// The exact visible lines of the mesh.
        #[default]
        Lines = "lines",
        /// The visible contour of the smooth surface in closed form that the mesh approximates.
        Smooth = "smooth",
    }
}

/// The error of a picture's ink against the visible lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LineError {
    /// The kind of reference.
    #[serde(default)]
    pub against: Against,
    /// Distance within which ink and line count as the same, pixels.
    pub tolerance_px: f64,
    /// Least darkness of a pixel that counts as ink, of 255.
    pub ink_from: u8,
    /// Angles between faces, degrees: creases between the two are neither missed nor invented.
    pub ignored_creases_degrees: [f64; 2],
    /// Length of the reference, pixels.
    pub reference_px: f64,
    /// Ink, pixels weighted by their darkness.
    pub ink_px: f64,
    /// Share of the reference's length with ink within the tolerance.
    pub recall: f64,
    /// Share of the ink of at least that darkness, weighted by it, within the tolerance of the reference; 1 without any ink.
    pub precision: f64,
    /// The same share of all ink, however faint: it includes the ink below the threshold.
    pub precision_of_all: f64,
    /// Harmonic mean of recall and precision.
    pub f1: f64,
    /// Precision averaged over recall, over all thresholds of ink.
    pub average_precision: f64,
    /// Mean and 95th percentile of the distance from the reference to the nearest ink, pixels; `None` without any ink.
    pub reference_to_ink_px: Option<[f64; 2]>,
    /// Mean and 95th percentile of the distance from ink to the reference, pixels; `None` without any ink.
    pub ink_to_reference_px: Option<[f64; 2]>,
    /// Recall of each class that the reference has.
    pub recall_of_class: BTreeMap<String, f64>,
}

/// The error of a picture's tones against those of rays cast in f64.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ToneError {
    /// Covered pixels farther than 1 pixel from every visible line.
    pub inner_px: usize,
    /// Share of them with another tone; `None` for continuous tones.
    pub inner_differing: Option<f64>,
    /// Covered pixels within 1 pixel of a visible line.
    pub rim_px: usize,
    /// Share of them with another tone; `None` for continuous tones.
    pub rim_differing: Option<f64>,
    /// Mean and largest difference of any channel over the inner pixels, of 255.
    pub mean_difference: f64,
    /// The largest.
    pub largest_difference: f64,
    /// The places where tones change; `None` for continuous tones, and without any inside.
    #[serde(default)]
    pub borders: Option<ToneBorderError>,
}

/// How far a picture's borders between tones are from the exact ones, farther than 1 pixel from every visible line: mean and 95th
/// percentile, pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ToneBorderError {
    /// From the exact borders, weighted by length, to the nearest in the picture.
    pub exact_to_drawn_px: [f64; 2],
    /// From the picture's, each time two pixels beside each other differ, to the nearest exact one.
    pub drawn_to_exact_px: [f64; 2],
}

/// Time of a setting, wall-clock milliseconds unless noted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunTime {
    /// Reading the model.
    pub load_ms: f64,
    /// Finding its edges, if the style draws them; 0 otherwise.
    pub edges_ms: f64,
    /// Making the plan, edges ready.
    pub plan_ms: f64,
    /// The frames after warm-up, each ended by reading the picture back; in the order measured.
    pub frames_ms: Vec<f64>,
    /// Processor time of each, all threads; empty where a device draws or the system does not tell it.
    #[serde(default)]
    pub processor_ms: Vec<f64>,
    /// The median of the frames.
    pub median_ms: f64,
    /// Each pass.
    pub passes: Vec<PassRow>,
}

impl RunTime {
    /// Times of frames, after those of reading the model, finding its edges and making the plan.
    pub(crate) fn new([load_ms, edges_ms, plan_ms]: [f64; 3], frames: FrameTimes, passes: Vec<PassRow>) -> Self {
        let FrameTimes { frames_ms, processor_ms } = frames;
        let median_ms = median(frames_ms.clone()).unwrap_or_default();
        Self { load_ms, edges_ms, plan_ms, frames_ms, processor_ms, median_ms, passes }
    }
}

/// A pass's median times, milliseconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassRow {
    /// Its name in the plan.
    pub name: String,
    /// Wall-clock time until GL has finished it.
    pub cpu_ms: f64,
    /// By a timer query; `None` if GL has none.
    pub gpu_ms: Option<f64>,
}
