//! Exact visible lines: the visible and hidden parts of a model's edges, computed in f64 without GL.
//!
//! Input: a [`Scene`] and the edge classes. Output: [`VisibleLines`], every line segment inside the picture, marked
//! visible or hidden. It is the reference for measuring ink, and the source of the SVG.
//!
//! A point of a line is visible under two conditions. On at least one of its two sides in the picture, no face hides
//! the place next to it. And no other selected line covers it from nearer to the eye. Along an edge the visibility
//! can change only at these places:
//!
//! - where the edge's image crosses that of a nearer edge at which a surface ends or turns away (boundary,
//!   non-manifold, silhouette);
//! - where the edge passes through a face (Appel 1967);
//! - where another edge's image overlaps its own: at that edge's ends, and where both are equally near.
//!
//! The edge is cut at all these places, and one ray decides each segment. The curves and points of a model
//! ([`Curves`](crate::mesh::Curves)) are decided likewise: only faces hide them, and they hide nothing.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use std::sync::{Arc, LazyLock};
//! use tinta_geometry::lines::svg;
//! use tinta_geometry::{LineSettings, LoadOptions, Scene, SceneSettings, DrawingSettings, VisibleLines, load};
//!
//! let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let lines = VisibleLines::of(&scene, &LineSettings::default())?;
//! assert!(lines.segments.iter().any(|segment| segment.is_visible) && lines.segments.iter().any(|segment| !segment.is_visible));
//! assert!(svg(&lines, &DrawingSettings::default())?.contains("<svg"));
//! # Ok(())
//! # }
//! ```

mod drawing;
mod eye;
mod input;
mod labels;
mod parts;
mod progress;
mod regions;
mod segment;
mod settings;
mod sheet;
mod sheet_text;
mod sight;
mod smooth;
#[cfg(test)]
#[path = "../tests/support/contour_distance.rs"]
mod contour_distance;
#[cfg(test)]
mod smooth_tests;
#[cfg(test)]
mod stiff_tests;
mod title_block;
mod to_scale;
mod visible;
mod visible_lines;
mod why;
mod write;

#[doc(hidden)]
pub use crate::mesh::Pattern;
#[doc(hidden)]
pub use drawing::areas::Areas;
pub use drawing::chain::{LinePath, chain};
#[doc(hidden)]
pub use drawing::curves::{Step, fitted};
#[doc(hidden)]
pub use drawing::drawn_layers::{DrawnLayer, GHOST_OPACITY, drawn_layers};
pub use drawing::fills::{Fill, FillGroup, fills};
pub use drawing::hatch::{Hatch, Hatching};
#[doc(hidden)]
pub use drawing::hatches::hatches;
#[doc(hidden)]
pub use drawing::key::{Key, KeyText};
pub use drawing::layers::{ClassColors, ClassWidths, Layer, OfLayers};
pub use drawing::length::{Length, Millimetres, Units, line_width};
pub use drawing::page::{PageSize, Paper, Sheet, Turn};
#[doc(hidden)]
pub use drawing::painted::painted;
pub use drawing::scale::{ModelUnit, Scale};
pub use drawing::settings::{DrawingSettings, HiddenLines};
pub use parts::rules::{PartRule, PartRules};
#[doc(hidden)]
pub use parts::scene_parts::ScenePart;
pub use parts::style::{PartRole, PartStyle};
pub use progress::{Phase, Progress};
#[doc(hidden)]
pub use regions::{
    JoinKey, LIGHTS, Region, Regions, SeenFace, SeenNormals, Surface, ToneLight, ToneRule, TonedSurface, ground_light,
    ground_shadow,
};
pub use segment::LineSegment;
pub use settings::LineSettings;
pub use sheet::ProjectionAngle;
#[doc(hidden)]
pub use sight::Sight;
#[doc(hidden)]
pub use smooth::closed_forms;
pub use smooth::forms::FormSettings;
#[doc(hidden)]
pub use smooth::silhouettes::{SmoothSilhouette, smooth_silhouettes};
#[doc(hidden)]
pub use smooth::visibility_events::{Inconsistency, InconsistencyKind, VisibilityChanges};
pub use visible_lines::{LineTimes, VisibleLines};
pub use why::{Hider, Why, WhyLine, WhyPiece};
pub use write::dxf::dxf;
#[cfg(feature = "pdf")]
pub use write::pdf::pdf;
#[doc(hidden)]
pub use write::raster::{
    Raster, lay_fills, lay_over, lay_strokes, lay_strokes_by, raster, raster_of_paths, raster_of_strokes,
};
pub use write::strokes::{Polyline, Strokes, strokes, strokes_of_paths};
pub use write::svg::{svg, svg_of_paths};
pub use write::{DrawingContent, DrawingFormat};
#[doc(hidden)]
pub use {
    eye::cast::{Hit, first_hits},
    input::overlaps::stacked_faces,
    labels::Label,
};

use crate::clock::{Instant, milliseconds_since};
use crate::error::Result;
use crate::scene::Scene;
use input::candidates::Candidates;
use input::centre_lines::add_centre_lines;
use input::line_input::LineInput;
use input::object_edges::ObjectEdges;
use parts::scene_parts::SceneParts;
use smooth::contour_visibility::ContourLines;
use std::sync::Arc;
use visible::line_index::LineIndex;

impl VisibleLines {
    /// Finds the visible and hidden lines of a scene.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] if no class is selected, if the scene has more than 2^30 faces or positions, or if
    /// its lines need more memory than is available.
    pub fn of(scene: &Scene, settings: &LineSettings) -> Result<Self> {
        Self::with_progress(scene, settings, &Progress::default())
    }

    /// Like [`VisibleLines::of`], and reports progress.
    ///
    /// # Errors
    ///
    /// Those of [`VisibleLines::of`], [`Error::Cancelled`](crate::Error::Cancelled) after [`Progress::cancel`], and
    /// [`Error::OutOfTime`](crate::Error::OutOfTime) after [`Progress::within`].
    pub fn with_progress(scene: &Scene, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        Self::in_sight(&Sight::of(scene), settings, progress)
    }

    /// Like [`VisibleLines::with_progress`]; shares its work with the areas of the sight.
    ///
    /// # Errors
    ///
    /// Those of [`VisibleLines::with_progress`].
    #[doc(hidden)]
    pub fn in_sight(sight: &Sight<'_>, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        let clock = Instant::now();
        progress.begin(Phase::Preparing, 0);
        let input = LineInput::of(sight, settings)?;
        let topology_ms = milliseconds_since(clock);
        progress.go_on()?;
        let search = match settings.reference {
            true => Arc::default(),
            false => sight.search(&input.space, &input.faces, progress),
        };
        let candidates = Candidates::of(&input, &search, progress)?;
        let lines = LineIndex::new(&input, &candidates, &search, progress)?;
        progress.go_on()?;
        let (mut segments, compared) = match settings.reference {
            true => (lines.segments_by_rules(settings.finds_hidden, progress)?, 0),
            false => lines.segments(progress),
        };
        progress.go_on()?;
        let contours =
            candidates.contours.as_ref().map(|contours| ContourLines { lines: &lines, contours, input: &input });
        let changes = contours.map(|contours| contours.add(&mut segments, progress)).transpose()?.flatten();
        segments = visible::covered_lines::marked(segments, &input.scene_parts, &input.space, progress)?;
        add_centre_lines(&input, &mut segments);
        input.scene_parts.put_looks(&mut segments);
        let (silhouette_ms, compared) = (candidates.silhouette_ms, candidates.compared + compared);
        let visibility_ms = milliseconds_since(clock) - topology_ms - silhouette_ms;
        let LineInput { objects, scene_parts: SceneParts { list, looks, .. }, .. } = input;
        Ok(Self {
            size: sight.scene.size,
            labels: labels::labels(sight.scene, &segments),
            segments,
            parts: list,
            looks,
            edges: candidates.counts,
            covered_triangles: objects.iter().map(ObjectEdges::covered).sum(),
            changes,
            px_per_mm: None,
            times: LineTimes { topology_ms, silhouette_ms, visibility_ms, compared },
        })
    }
}
