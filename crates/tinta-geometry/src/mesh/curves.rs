//! The curves and points of a model that are no edges of its surface.

use glam::DVec3;

/// The curves and points of a model that are no edges of its surface: statements `l` and `p` of OBJ, edges of PLY, glTF's primitives
/// of lines and points. Exact lines draw them, and the style inking through depth; no other
/// style does. They hide nothing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Curves {
    /// Their positions in world space, file units, f64, finite; not welded.
    pub positions: Vec<DVec3>,
    /// For each position its 0-based vertex number in the file.
    pub file_vertices: Vec<u32>,
    /// The straight segments of the curves, each between two positions. Segments that share an end are one line.
    pub segments: Vec<[u32; 2]>,
    /// The positions of single points.
    pub points: Vec<u32>,
    /// Texts of points, each with the number of its point in `points`; no file gives any.
    pub labels: Vec<(u32, String)>,
    /// How many of the last segments are strokes on a cut, not the model's own.
    pub hatching: usize,
}

impl Curves {
    /// Whether the model has curves or points of its own.
    pub fn has_own(&self) -> bool {
        self.segments.len() > self.hatching || !self.points.is_empty()
    }

    /// Adds strokes on a cut, with the next free vertex numbers of the file.
    pub(super) fn add_hatching(&mut self, strokes: &[[DVec3; 2]], next_vertex: &mut u32) {
        for ends in strokes {
            let first = self.positions.len() as u32;
            self.positions.extend(ends);
            self.file_vertices.extend([*next_vertex, *next_vertex + 1]);
            *next_vertex += 2;
            self.segments.push([first, first + 1]);
        }
        self.hatching += strokes.len();
    }

    /// Adds other curves without strokes on cuts.
    pub(super) fn add(&mut self, other: Self) {
        let (positions, points) = (self.positions.len() as u32, self.points.len() as u32);
        self.positions.extend(other.positions);
        self.file_vertices.extend(other.file_vertices);
        self.segments.extend(other.segments.iter().map(|ends| ends.map(|end| end + positions)));
        self.points.extend(other.points.iter().map(|point| point + positions));
        self.labels.extend(other.labels.into_iter().map(|(point, text)| (point + points, text)));
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty() && self.points.is_empty()
    }
}
