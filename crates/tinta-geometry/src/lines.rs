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
mod identity;
mod input;
mod labels;
mod parts;
mod progress;
mod regions;
mod segment;
mod settings;
mod sheet;
mod smooth;
#[cfg(test)]
mod smooth_tests;
#[cfg(test)]
mod stiff_tests;
mod visible;
mod visible_lines;
mod why;
mod write;

pub use drawing::areas::Areas;
pub use drawing::chain::{LinePath, chain};
pub use drawing::curves::{Step, fitted};
pub use drawing::drawn_layers::{DrawnLayer, GHOST_OPACITY, drawn_layers};
pub use drawing::fills::{Fill, FillGroup, TRAP_PX, fills};
pub use drawing::hatch::{Hatch, Hatching};
pub use drawing::hatches::hatches;
pub use drawing::key::{Key, KeyText};
pub use drawing::layers::{ClassColors, ClassWidths, Layer, OfLayers};
pub use drawing::length::{Length, Millimetres, Units, line_width};
pub use drawing::page::{PageSize, Paper, Sheet, Turn};
pub use drawing::painted::painted;
pub use drawing::settings::{DrawingSettings, Hidden};
pub use identity::StrokeIds;
pub use labels::Label;
pub use parts::pattern::Pattern;
pub use parts::rules::{PartRule, PartRules};
pub use parts::scene_parts::ScenePart;
pub use parts::style::{PartRole, PartStyle};
pub use progress::{Phase, Progress};
pub use regions::{Joined, Region, Regions, SeenFace, Surface, ToneLight, ToneRule, TonedSurface};
pub use segment::LineSegment;
pub use settings::LineSettings;
pub use sheet::ProjectionAngle;
pub use smooth::closed_forms;
pub use smooth::forms::FormSettings;
pub use smooth::silhouettes::{SmoothSilhouette, smooth_silhouettes};
pub use smooth::visibility_events::{Inconsistency, InconsistencyKind, VisibilityChanges};
pub use visible::cast::{Hit, first_hits};
pub use visible_lines::{LineTimes, VisibleLines};
pub use why::{Hider, Why, WhyLine, WhyPiece};
pub use write::dxf::{dxf, dxf_of_paths};
#[cfg(feature = "pdf")]
pub use write::pdf::{pdf, pdf_of_paths};
pub use write::raster::{Raster, raster, raster_of_paths, raster_of_strokes};
pub use write::strokes::{Polyline, Strokes, strokes, strokes_of_paths};
pub use write::svg::{svg, svg_of_paths};
pub use write::turn_svg::TurnSvg;

use crate::clock::{Instant, milliseconds_since};
use crate::edges::{Class, ClassSet};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::threads::both;
use input::object_edges::{Edges, IsGhost, ObjectEdges, ghost_faces, object_edges};
use parts::scene_parts::SceneParts;
use settings::{check_on_surface, not_published};
use smooth::contour_visibility::ContourLines;
use smooth::contours::Contours;
use visible::faces::Faces;
use visible::line_index::LineIndex;
use visible::nearest_faces::NearestFaces;
use visible::pyramid::{Pyramid, is_crowded};
use visible::space::Space;

/// Refuses settings without lines, and scenes that are too large.
fn check(scene: &Scene, settings: &LineSettings) -> Result<()> {
    if settings.classes.is_empty() {
        return Err(Error::setting("classes", "name at least one class of lines"));
    }
    let all_positions: usize = scene.objects.iter().map(|object| object.mesh.positions.len()).sum();
    if scene.triangle_count().max(all_positions) > u32::MAX as usize / 4 {
        return Err(Error::setting("copies", "the scene has too many faces to find its lines; ask for fewer"));
    }
    not_published(settings.silhouette)?;
    check_on_surface(settings.on_surface)?;
    settings.forms.check()
}

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
    /// Those of [`VisibleLines::of`], [`Error::Cancelled`] after [`Progress::cancel`], [`Error::OutOfTime`] after
    /// [`Progress::within`], and the same after [`Progress::within_or_part`] while no line is decided.
    pub fn with_progress(scene: &Scene, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        check(scene, settings)?;
        if settings.reference {
            return visible::reference::visible_lines(scene, settings, progress);
        }
        let scene_parts = SceneParts::new(scene, settings)?;
        let settings = &scene_parts.settings(settings);
        let is_ghost = |object: usize, mesh: &Mesh, face| scene_parts.is_ghost(scene_parts.of_face(object, mesh, face));
        let ghosts = scene_parts.has_ghosts().then_some(&is_ghost as IsGhost<'_>);
        let has_forms = !settings.classes.and(ClassSet::FORMS).is_empty();
        let with_hidden;
        let settings = if settings.counts_changes && !settings.finds_hidden {
            with_hidden = LineSettings { finds_hidden: true, ..settings.clone() };
            &with_hidden
        } else {
            settings
        };
        let clock = Instant::now();
        let space = Space::of(scene);
        let unrepaired: Vec<_> = scene.objects.iter().map(|object| (object, object.mesh.clone())).collect();
        // One thread builds the hierarchy, another the edges.
        let (parts, faces) = both(
            || {
                let parts = object_edges(scene, ghosts);
                for part in &parts {
                    part.edges.get().classes(settings.crease_angle, input::features::asked(settings));
                    if has_forms && matches!(part.edges, Edges::OfScene(_)) {
                        smooth::forms::curvatures(scene, part, settings);
                    }
                }
                parts
            },
            || Faces::new(&space, &unrepaired),
        );
        let is_repaired = parts.iter().any(|part| matches!(part.edges, Edges::Repaired(_)));
        let mut faces = if is_repaired {
            let meshes: Vec<_> = parts.iter().map(|part| (part.object, part.shape().clone())).collect();
            Faces::new(&space, &meshes)
        } else {
            faces
        };
        if let Some(is_ghost) = ghosts {
            faces.set_ghosts(&ghost_faces(&parts, is_ghost));
        }
        let all_parts = (parts.as_slice(), &scene_parts);
        let topology_ms = milliseconds_since(clock);
        progress.go_on()?;

        let clock = Instant::now();
        let contours = (settings.has_smooth_contours() || settings.counts_changes).then(|| {
            let is_cut = !faces.cut_by_near.is_empty();
            Contours::with_cusps(scene, &space, &faces.positions, is_cut, &parts, settings.crease_angle)
        });
        let drawn_contours = contours.as_ref().filter(|_| settings.has_smooth_contours());
        let (mut lines, mut edges) =
            input::features::edge_features(scene, &space, &faces, all_parts, drawn_contours, settings);
        let silhouette_ms = milliseconds_since(clock);
        progress.go_on()?;

        let clock = Instant::now();
        let is_crowded = is_crowded(&space, &faces);
        let pyramid = is_crowded.then(|| Pyramid::new(&space, &faces)).flatten();
        let nearest_faces = is_crowded.then(|| NearestFaces::new(&space, &faces, progress));
        let hides = pyramid.as_ref().filter(|_| !settings.finds_hidden);
        let nearest = nearest_faces.as_ref().filter(|_| !settings.finds_hidden);
        let intersections = visible::intersections::intersections(&space, &faces, &parts, (hides, nearest), progress);
        progress.go_on()?;
        let mut compared = intersections.compared;
        if !settings.classes.and(ClassSet::of(&[Class::Intersection, Class::Part])).is_empty() {
            let found = &intersections.lines;
            lines.extend(input::features::intersection_features(&faces, all_parts, found, &mut edges));
        }
        if has_forms {
            lines.extend(smooth::forms::form_features(scene, &space, &faces, all_parts, settings, &mut edges));
        }
        lines.extend(input::features::free_features(&space, all_parts, settings, &mut edges)?);
        lines.extend(input::features::near_plane_features(&space, &faces));
        let found = LineIndex::new(
            &space,
            &faces,
            &lines,
            &intersections.piercings,
            (pyramid.as_ref(), is_crowded),
            settings,
            progress,
        )?;
        drop(intersections);
        progress.go_on()?;
        let (mut segments, steps) = found.segments(progress);
        compared += steps;
        let undecided = progress.undecided()?;
        let mut changes = None;
        if let Some(contours) = &contours {
            let contour_lines = ContourLines { lines: &found, contours, parts: &parts, scene_parts: &scene_parts };
            if settings.has_smooth_contours() {
                edges.silhouette += contours.pieces.len();
                let decided = contour_lines.decided(progress);
                // Smooth contours are all or nothing: a partial set is an error.
                progress.go_on()?;
                changes = settings.counts_changes.then(|| contour_lines.changes(&decided));
                segments.extend(contour_lines.segments(&decided));
            } else {
                progress.go_on()?;
                changes = Some(contour_lines.changes_of_edges(&segments));
            }
        }
        // Overlaps are marked only if all lines are decided.
        if undecided == 0 {
            segments = visible::doubled::marked(segments, &scene_parts, &space, progress)?;
        }
        let labels = labels::labels(scene, &segments);
        scene_parts.put_looks(&mut segments);
        let SceneParts { list, looks, .. } = scene_parts;
        let visibility_ms = milliseconds_since(clock);
        let times = LineTimes { topology_ms, silhouette_ms, visibility_ms, compared };
        let covered_triangles = parts.iter().map(ObjectEdges::covered).sum();
        Ok(Self {
            size: scene.size,
            segments,
            labels,
            parts: list,
            looks,
            edges,
            covered_triangles,
            changes,
            undecided,
            has_specks: false,
            times,
        })
    }
}
