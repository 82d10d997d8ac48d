//! Exact visible lines: which parts of a model's edges are seen, computed in f64 without GL.
//!
//! In: a [`Scene`] and the classes of edges wanted. Out: [`VisibleLines`], every piece of every line inside the picture,
//! marked visible or hidden: the reference that ink is measured against, and what the SVG is drawn from. A point of a line is
//! seen if on one of its two sides in the picture no face hides what is just beside it, and no other wanted line lies on it
//! nearer to the eye. Along an edge that can change only where its image crosses that of a nearer edge at which a surface ends
//! or turns away (boundary, non-manifold, silhouette), where the edge passes through a face (Appel 1967), and where the image
//! of another edge lies on its own: where that one begins or ends, and where both are equally near. The edge is cut at all these
//! places, and each piece is decided by one ray.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use std::sync::{Arc, LazyLock};
//! use tinta_geometry::lines::svg;
//! use tinta_geometry::{LineSettings, LoadOptions, Scene, SceneSettings, SvgSettings, VisibleLines, load};
//!
//! let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let lines = VisibleLines::of(&scene, &LineSettings::default())?;
//! assert!(lines.segments.iter().any(|segment| segment.is_visible) && lines.segments.iter().any(|segment| !segment.is_visible));
//! assert!(svg(&lines, &SvgSettings::default())?.contains("<svg"));
//! # Ok(())
//! # }
//! ```

mod beside;
mod bundles;
mod cast;
mod chain;
mod changes;
pub mod closed_forms;
mod contours;
mod covered;
mod crossings;
mod curves;
mod doubled;
mod drawing;
mod face_image;
mod faces;
mod features;
mod foremost;
mod forms;
mod identity;
mod image;
mod intersections;
mod junctions;
mod layers;
mod length;
mod mend;
mod occluders;
mod outline;
mod page;
#[cfg(feature = "pdf")]
mod pdf;
mod pen;
mod planes;
mod progress;
mod pyramid;
mod ranges;
mod raster;
mod search;
mod silhouettes;
mod simplify;
#[cfg(test)]
mod smooth_tests;
mod space;
mod specks;
#[cfg(test)]
mod stiff_tests;
mod strokes;
mod summits;
mod svg;
mod turns;
mod visibility;

pub use cast::{Hit, first_hits};
pub use chain::{LinePath, chain};
pub use changes::{Inconsistency, InconsistencyKind, VisibilityChanges};
pub use curves::{Step, fitted};
pub use drawing::{DrawnLayer, GHOST_OPACITY, drawn_layers};
pub use forms::FormSettings;
pub use identity::StrokeIds;
pub use layers::{ClassColors, ClassWidths, Layer, OfLayers};
pub use length::{Length, Millimetres, Units, line_width};
pub use page::{PageSize, Paper, Sheet, Turn};
#[cfg(feature = "pdf")]
pub use pdf::{pdf, pdf_of_paths};
pub use progress::{Phase, Progress};
pub use raster::{Raster, raster, raster_of_paths};
pub use silhouettes::{SmoothSilhouette, smooth_silhouettes};
pub use strokes::{Polyline, Strokes, strokes, strokes_of_paths};
pub use svg::{Hidden, SvgSettings, svg, svg_of_paths};

use crate::clock::{Instant, milliseconds_since};
use crate::edges::{Class, ClassCounts, ClassSet, CreaseAngle, SilhouetteRule};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::scene::{Scene, Size};
use crate::settings::{HasSettings, Setting, Table, Value as _, within};
use crate::threads::both;
use contours::Contours;
use faces::Faces;
use features::{Edges, MendedEdges, Part};
use foremost::Foremost;
use glam::{DVec2, DVec3};
use pyramid::Pyramid;
use serde::Serialize;
use space::Space;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock};
use summits::ContourLines;
use visibility::Lines;

/// From how many intersections on the cells that hide some are made smaller.
const MANY_INTERSECTIONS: usize = 10_000;

/// Which lines are wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSettings {
    /// Classes of lines. Default all but the seams of textures and normals, which belong to a model's data, not its shape, and the
    /// form lines, which are those of a smooth surface.
    pub classes: ClassSet,
    /// From which angle between faces an edge is a crease. Default 30 degrees; more find fewer lines.
    pub crease_angle: CreaseAngle,
    /// Whether creases are drawn only where they last: closed or long ones, and those at which a flat face of several triangles ends. Default
    /// no; then single folds of scans are drawn, too.
    pub lasting_creases: bool,
    /// Where silhouettes run: exact ones, the default, are what the faces show; smooth ones are what a curved surface that the faces stand
    /// for would show. The listing's rule is refused: it knows no exact lines.
    pub silhouette: SilhouetteRule,
    /// Whether hidden parts are found too. Default yes; without them [`VisibleLines::segments`] has what is seen alone, and no time
    /// is spent on what lies behind.
    pub finds_hidden: bool,
    /// Whether outlines are found, for [`LineSegment::is_outline`]; lines are cut where they begin and end. Default no: it takes
    /// time, and nobody else needs the cuts.
    pub finds_outline: bool,
    /// How strong form lines must be, where their classes are wanted.
    pub forms: FormSettings,
    /// Whether it is counted where silhouettes begin and end to be seen, and why, for [`VisibleLines::changes`]. Default no; then hidden
    /// parts are found, too.
    pub counts_changes: bool,
}

impl Default for LineSettings {
    fn default() -> Self {
        Self {
            classes: ClassSet::of(&[
                Class::Boundary,
                Class::NonManifold,
                Class::Silhouette,
                Class::Crease,
                Class::Material,
                Class::Intersection,
            ]),
            crease_angle: CreaseAngle::of_drawings(),
            lasting_creases: false,
            silhouette: SilhouetteRule::Exact,
            finds_hidden: true,
            finds_outline: false,
            forms: FormSettings::default(),
            counts_changes: false,
        }
    }
}

impl HasSettings for LineSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<LineSettings>> =
            LazyLock::new(|| Table { settings: LineSettings::settings(), defaults: vec![LineSettings::default()] });
        &TABLE
    }
}

impl LineSettings {
    /// As by default, with the creases of Dachsbacher's listing: what the ink of all styles is measured against.
    pub fn as_published() -> Self {
        Self { crease_angle: CreaseAngle::default(), ..Self::default() }
    }

    /// Whether smooth contours are drawn.
    fn has_smooth_contours(&self) -> bool {
        self.silhouette == SilhouetteRule::Smooth && self.classes.contains(Class::Silhouette)
    }

    /// The settings, for a table of something that has lines in it.
    pub fn settings() -> Vec<Setting<Self>> {
        let edges = vec![
            ClassSet::setting(ClassSet::ALL, |lines: &mut Self| &mut lines.classes),
            CreaseAngle::setting(|lines: &mut Self| &mut lines.crease_angle),
            Setting::flag(
                "lasting-creases",
                "Leave out the folds of scans: draw only creases that are long, closed, or at the end of a flat face",
                |lines: &Self| lines.lasting_creases,
                |lines, is_on| lines.lasting_creases = is_on,
            ),
            SilhouetteRule::setting(|lines: &mut Self| &mut lines.silhouette)
                .refusing(|lines| not_published(lines.silhouette))
                .offering(&["exact", "smooth"]),
        ];
        let forms = within(FormSettings::settings(), |lines: &mut Self| Some(&mut lines.forms));
        edges.into_iter().chain(forms).collect()
    }
}

/// Refuses the listing's rule.
fn not_published(rule: SilhouetteRule) -> Result<()> {
    let problem = "style lines finds silhouettes exactly or smooth; leave it out, or draw --style inking into a .png";
    if rule == SilhouetteRule::Published { Err(Error::value("silhouette", rule.text(), problem)) } else { Ok(()) }
}

/// A piece of a line of one class that is seen or hidden as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSegment {
    /// Its class; of several the first in the order of [`Class::ALL`].
    pub class: Class,
    /// Whether it is seen.
    pub is_visible: bool,
    /// Whether it is drawn as outline: it is seen and has nothing but background on one side at least; `false` throughout unless outlines
    /// were asked for. A drawing leaves out runs that are too short to read, see [`VisibleLines::without_specks`].
    pub is_outline: bool,
    /// On which sides it has nothing but background, on its right and on its left, seen from its first end.
    pub background: [bool; 2],
    /// Whether it is hidden and another line lies on it in the picture, a visible one or a hidden one of an earlier class: that one is
    /// drawn in its place. `false` throughout where lines are missing, see [`VisibleLines::undecided`].
    pub is_covered: bool,
    /// Where it begins and ends in the picture: pixels from the upper left corner, y down. Pieces that meet at a vertex have
    /// bit for bit the same end there.
    pub ends_px: [DVec2; 2],
    /// The same ends in the world.
    pub ends_world: [DVec3; 2],
    /// The mesh edge it is part of: two vertices by their 0-based numbers in the file; `None` where faces intersect, and for form
    /// lines and smooth contours, which run through faces.
    pub edge: Option<[u32; 2]>,
    /// The angle between its two faces' normals, degrees; `None` for an edge without exactly two faces with area.
    pub angle_degrees: Option<f64>,
    /// The object in the scene.
    pub object: u32,
}

impl LineSegment {
    /// The layer it is drawn in.
    pub fn layer(&self) -> Layer {
        chain::layer(self.class, self.is_visible, self.is_outline)
    }
}

/// The lines of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleLines {
    /// The picture's size.
    pub size: Size,
    /// All pieces with any length inside the picture and between the near and the far plane, in a stable order: by
    /// object, then edge, then along it; then intersections, then form lines, then smooth contours, by object and face.
    pub segments: Vec<LineSegment>,
    /// How many edges there are of each class, each counted in its first one.
    pub edges: ClassCounts,
    /// How many triangles others cover in one plane, as in models made to be seen from both sides; each region counts once.
    pub covered_triangles: usize,
    /// Where along silhouettes what is seen begins and ends, if that was asked for.
    pub changes: Option<VisibilityChanges>,
    /// How many lines are missing because the time was over before they were decided: none but after
    /// [`Progress::within_or_part`]. What is there is as in the whole.
    pub undecided: usize,
    /// Whether the time was over before what is too short to be a line was left out, so that all of it is there: not but after
    /// [`Progress::within_or_part`] and [`VisibleLines::without_specks_with_progress`].
    pub has_specks: bool,
    /// How it went.
    pub times: LineTimes,
}

/// Milliseconds of the clock, and what they went by.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct LineTimes {
    /// Mending, edge list, classes that do not depend on the view, the faces' hierarchy.
    pub topology_ms: f64,
    /// Which faces are seen from which side, and the edges between them.
    pub silhouette_ms: f64,
    /// Intersections, cuts and rays.
    pub visibility_ms: f64,
    /// Boxes of faces, lines and groups of them that were looked at for that: the same on every machine for the same scene.
    pub compared: u64,
}

impl VisibleLines {
    /// Finds the lines of a scene.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] when no class is wanted, the scene has more than 2^30 faces or positions, or its lines take more memory than there is.
    pub fn of(scene: &Scene, settings: &LineSettings) -> Result<Self> {
        Self::with_progress(scene, settings, &Progress::default())
    }

    /// As [`VisibleLines::of`], saying how far it is.
    ///
    /// # Errors
    ///
    /// As there, [`Error::Cancelled`] after [`Progress::cancel`], and [`Error::OutOfTime`] after [`Progress::within`] and, while
    /// nothing is certain, after [`Progress::within_or_part`].
    pub fn with_progress(scene: &Scene, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        if settings.classes.is_empty() {
            return Err(Error::setting("classes", "name at least one class of lines"));
        }
        let all_positions: usize = scene.objects.iter().map(|object| object.mesh.positions.len()).sum();
        if scene.triangle_count().max(all_positions) > u32::MAX as usize / 4 {
            return Err(Error::setting("copies", "the scene has too many faces to find its lines; ask for fewer"));
        }
        not_published(settings.silhouette)?;
        settings.forms.check()?;
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
        let unmended: Vec<_> = scene.objects.iter().map(|object| (object, object.mesh.clone())).collect();
        // The hierarchy is built on one thread, the edges on another.
        let (parts, faces) = both(
            || {
                let parts = parts(scene);
                for part in &parts {
                    part.edges.get().classes(settings.crease_angle, features::asked(settings));
                    if has_forms && matches!(part.edges, Edges::OfScene(_)) {
                        forms::curvatures(scene, part, settings);
                    }
                }
                parts
            },
            || Faces::new(&space, &unmended),
        );
        let is_mended = parts.iter().any(|part| matches!(part.edges, Edges::Mended(_)));
        let faces = if is_mended {
            let meshes: Vec<_> = parts.iter().map(|part| (part.object, part.shape().clone())).collect();
            Faces::new(&space, &meshes)
        } else {
            faces
        };
        let topology_ms = milliseconds_since(clock);
        progress.go_on()?;

        let clock = Instant::now();
        let contours = (settings.has_smooth_contours() || settings.counts_changes).then(|| {
            let is_cut = !faces.cut_by_near.is_empty();
            Contours::new(scene, &space, &faces.positions, is_cut, &parts, settings.crease_angle)
        });
        let drawn_contours = contours.as_ref().filter(|_| settings.has_smooth_contours());
        let (mut lines, mut edges) = features::edge_features(scene, &space, &faces, &parts, drawn_contours, settings);
        let silhouette_ms = milliseconds_since(clock);
        progress.go_on()?;

        let clock = Instant::now();
        let mut pyramid = Pyramid::new(&space, &faces);
        let foremost = Foremost::new(&space, &faces, progress);
        let hides = pyramid.as_ref().filter(|_| !settings.finds_hidden);
        let nearest = foremost.as_ref().filter(|_| !settings.finds_hidden);
        let mut intersections = intersections::intersections(&space, &faces, &parts, (hides, nearest), progress);
        progress.go_on()?;
        if hides.is_some() && intersections.lines.len() > MANY_INTERSECTIONS {
            pyramid = Pyramid::fine(&space, &faces);
            if let Some(fine) = &pyramid {
                intersections.leave_out_hidden(&space, fine);
            }
        }
        let mut compared = intersections.compared;
        if settings.classes.contains(Class::Intersection) {
            edges.intersection = intersections.lines.len();
            lines.extend(features::intersection_features(&faces, &parts, &intersections.lines));
        }
        if has_forms {
            lines.extend(forms::form_features(scene, &space, &faces, &parts, settings, &mut edges));
        }
        lines.extend(features::near_plane_features(&space, &faces));
        let found = Lines::new(
            &space,
            &faces,
            &lines,
            &intersections.piercings,
            (pyramid.as_ref(), foremost.as_ref()),
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
            let contour_lines = ContourLines { lines: &found, contours, parts: &parts };
            if settings.has_smooth_contours() {
                edges.silhouette += contours.pieces.len();
                let decided = contour_lines.decided(progress);
                // A part of smooth contours is none.
                progress.go_on()?;
                changes = settings.counts_changes.then(|| contour_lines.changes(&decided));
                segments.extend(contour_lines.segments(&decided));
            } else {
                progress.go_on()?;
                changes = Some(contour_lines.changes_of_edges(&segments));
            }
        }
        // What lies on what is known of a whole only.
        if undecided == 0 {
            segments = doubled::marked(segments, &space, progress)?;
        }
        let visibility_ms = milliseconds_since(clock);
        let times = LineTimes { topology_ms, silhouette_ms, visibility_ms, compared };
        let covered_triangles = parts.iter().map(Part::covered).sum();
        let has_specks = false;
        Ok(Self { size: scene.size, segments, edges, covered_triangles, changes, undecided, has_specks, times })
    }

    /// What files say of lines of which some are missing, see [`VisibleLines::undecided`], or specks are left.
    pub fn partial_note(&self) -> Option<String> {
        let lines = if self.undecided == 1 { "1 line was" } else { &format!("{} lines were", self.undecided) };
        let specks = "specks were left out";
        let before = match (self.undecided > 0, self.has_specks) {
            (false, false) => return None,
            (true, false) => format!("{lines} decided"),
            (false, true) => specks.to_string(),
            (true, true) => format!("{lines} decided and {specks}"),
        };
        Some(format!("partial: the time was over before {before}"))
    }

    /// Refuses lines that no drawing can hold: not finite, or outside the picture.
    pub fn check(&self) -> Result<()> {
        let limits = [self.size.width, self.size.height].map(f64::from);
        // What rounds to the border is on it.
        let is_inside = |value: f64, limit: f64| value > -5e-4 && value < limit + 5e-4;
        for (number, segment) in self.segments.iter().enumerate() {
            let mut points = segment.ends_px.iter();
            let is_drawable = points.all(|point| is_inside(point.x, limits[0]) && is_inside(point.y, limits[1]));
            if !is_drawable || segment.angle_degrees.is_some_and(|angle| !angle.is_finite()) {
                let [a, b] = segment.ends_px;
                return Err(Error::Lines {
                    problem: format!(
                        "line {number} from {a} to {b}: it is not a number or leaves the picture; this is a bug in \
                         tinta: report it with the model"
                    ),
                });
            }
        }
        Ok(())
    }
}

/// The scene's objects with their edges, mended where that is needed; objects of one mesh share them.
fn parts(scene: &Scene) -> Vec<Part<'_>> {
    let mut known: HashMap<*const Mesh, Option<Arc<MendedEdges>>> = HashMap::new();
    let mut parts = Vec::with_capacity(scene.objects.len());
    for object in &scene.objects {
        let (mesh, edges) = (&object.mesh, scene.edges(object));
        let mend = || mend::mended(mesh, edges.list()).map(|mended| Arc::new(MendedEdges::new(mended)));
        let edges = match known.entry(Arc::as_ptr(mesh)).or_insert_with(mend) {
            None => Edges::OfScene(edges),
            Some(edges) => Edges::Mended(edges.clone()),
        };
        parts.push(Part { object, edges });
    }
    parts
}
