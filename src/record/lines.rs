//! Exact lines as JSON: their record, and the file that holds all of them.

use super::CameraRecord;
use super::json::json;
use super::regions::write_regions;
use crate::edges::ClassCounts;
use crate::error::Result;
use crate::lines::{LinePath, LineTimes, Regions, Surface, VisibilityChanges, VisibleLines};
use crate::scene::Scene;
use serde::Serialize;
use std::fmt::Write;

/// The settings and times of exact lines.
#[derive(Debug, Clone, Serialize)]
pub struct LinesMade {
    /// Number of edges in each class; an edge counts in its first class.
    pub edges: ClassCounts,
    /// Places along smooth silhouettes where visibility changes; absent with other silhouettes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes: Option<VisibilityChanges>,
    /// Pieces of lines, and the numbers after chaining.
    pub counts: LineCounts,
    /// Times for topology, silhouettes and visibility.
    #[serde(flatten)]
    pub times: LineTimes,
    /// Time to chain the lines and write the text.
    pub lines_ms: f64,
}

/// The number of pieces and paths.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct LineCounts {
    /// Pieces seen.
    pub visible_segments: usize,
    /// Pieces hidden.
    pub hidden_segments: usize,
    /// Polylines seen.
    pub visible_paths: usize,
    /// Hidden polylines that are drawn: none without `--hidden`, and none under other lines.
    pub hidden_paths: usize,
}

impl LineCounts {
    /// Counts pieces and the paths made of them.
    pub fn new(lines: &VisibleLines, paths: &[LinePath]) -> Self {
        let visible_segments = lines.segments.iter().filter(|segment| segment.is_visible).count();
        let visible_paths = paths.iter().filter(|path| path.is_visible).count();
        Self {
            visible_segments,
            hidden_segments: lines.segments.len() - visible_segments,
            visible_paths,
            hidden_paths: paths.len() - visible_paths,
        }
    }
}

/// A piece of a line as written to the file.
#[derive(Serialize)]
struct SegmentRecord<'a> {
    class: &'static str,
    visible: bool,
    outline: bool,
    covered: bool,
    a: [f64; 2],
    b: [f64; 2],
    edge: Option<[u32; 2]>,
    angle_degrees: Option<f64>,
    object: u32,
    #[serde(skip_serializing_if = "str::is_empty")]
    part: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    material: &'a str,
}

/// A point's label as written to the file.
#[derive(Serialize)]
struct LabelRecord<'a> {
    text: &'a str,
    visible: bool,
    at: [f64; 2],
    object: u32,
}

/// Returns all lines as one JSON object: `size`, `camera`, `labels` if points have any, `segments`, one per line of the text, and
/// areas as [`regions_json`](super::regions_json) writes them; pixels, y down.
///
/// # Errors
///
/// [`crate::Error::Lines`] for lines that are not finite or leave the picture.
pub fn drawing_json(lines: &VisibleLines, regions: Option<&Regions<Option<Surface>>>, scene: &Scene) -> Result<String> {
    lines.check()?;
    let mut text = format!("{{\"size\": {},\n", json(&lines.size)?);
    let _ = writeln!(text, "\"camera\": {},", json(&CameraRecord::new(scene))?);
    if !lines.labels.is_empty() {
        let labels = lines.labels.iter().map(|label| LabelRecord {
            text: &label.text,
            visible: label.is_visible,
            at: label.px.to_array(),
            object: label.object,
        });
        let _ = writeln!(text, "\"labels\": {},", json(&labels.collect::<Vec<_>>())?);
    }
    text.push_str("\"segments\": [");
    for (index, segment) in lines.segments.iter().enumerate() {
        let [a, b] = segment.ends_px.map(|end| end.to_array());
        let record = SegmentRecord {
            class: segment.class.name(),
            visible: segment.is_visible,
            outline: segment.is_outline,
            covered: segment.is_covered,
            a,
            b,
            edge: segment.edge,
            angle_degrees: segment.angle_degrees,
            object: segment.object,
            part: lines.parts.get(segment.part as usize).map_or("", |part| &part.name),
            material: lines.parts.get(segment.part as usize).map_or("", |part| &part.material),
        };
        text.push_str(if index == 0 { "\n" } else { ",\n" });
        text.push_str(&json(&record)?);
    }
    text.push_str("\n]");
    if let Some(regions) = regions {
        text.push_str(",\n");
        write_regions(regions, scene, &mut text)?;
    }
    text.push_str("}\n");
    Ok(text)
}
