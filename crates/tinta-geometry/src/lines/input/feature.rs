//! A line before its visibility is decided.

use crate::bvh::NO_GROUP;
use crate::edges::Class;
use crate::lines::eye::faces::Faces;
use glam::DVec3;

/// A line in eye space.
#[derive(Debug, Clone)]
pub(in crate::lines) struct Feature {
    /// The class that it is drawn as; `None` for a line that only hides others.
    pub class: Option<Class>,
    /// Whether a surface ends or turns away at it, so things behind may appear or disappear there.
    pub occludes: bool,
    pub object: u32,
    /// The number of its part in the scene.
    pub part: u32,
    /// Whether it belongs to a ghost: it hides no other line.
    pub is_ghost: bool,
    pub own: Own,
    pub ends: [DVec3; 2],
    /// The distance below which positions of its object coincide, file units.
    pub weld: f64,
    /// The planes with many faces that contain the line.
    pub planes: [u32; 2],
    /// The plane that contains all faces at the line.
    pub plane: u32,
    /// Its vertex numbers in the file: of an edge or a free line.
    pub edge: Option<[u32; 2]>,
    pub angle_degrees: Option<f64>,
}

impl Feature {
    /// A line of the first object that is not drawn and hides nothing, with nothing else known of it.
    pub(in crate::lines) fn new(own: Own, ends: [DVec3; 2]) -> Self {
        Self {
            class: None,
            occludes: false,
            object: 0,
            part: 0,
            is_ghost: false,
            own,
            ends,
            weld: 0.0,
            planes: [NO_GROUP; 2],
            plane: NO_GROUP,
            edge: None,
            angle_degrees: None,
        }
    }

    /// Whether it is drawn and takes part where lines lie on one another in the picture: free lines and ghosts do not, they hide
    /// nothing and nothing but faces hides them.
    pub(in crate::lines) fn overlaps(&self) -> bool {
        self.class.is_some() && self.own != Own::Free && !self.is_ghost
    }
}

/// Marks an end of a line that is no position.
pub(in crate::lines) const NO_POSITION: u32 = u32::MAX;

/// The edge or the faces that a line belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) enum Own {
    /// The edge between two positions.
    Edge([u32; 2]),
    /// The intersection of two faces.
    Faces([u32; 2]),
    /// None: a curve or a point beside all surfaces, moved towards the eye by [`Space::lifted`](crate::lines::eye::space::Space::lifted). It touches no face.
    Free,
}

impl Own {
    /// Returns the length that contact with a face is relative to, for a line between two points, file units: none for a free line.
    pub(in crate::lines) fn contact_length(self, ends: [DVec3; 2]) -> f64 {
        if self == Self::Free { 0.0 } else { ends[0].distance(ends[1]) }
    }

    /// Returns the positions at the line's ends, or [`NO_POSITION`]. An intersection of faces with a common corner begins in
    /// that corner.
    pub(in crate::lines) fn corners(self, faces: &Faces) -> [u32; 2] {
        match self {
            Self::Edge(ends) => ends,
            Self::Free => [NO_POSITION; 2],
            Self::Faces([first, second]) => {
                let [first, second] = [first, second].map(|face| faces.triangles[face as usize]);
                let common = first.into_iter().find(|corner| second.contains(corner) && first != second);
                [common.unwrap_or(NO_POSITION), NO_POSITION]
            }
        }
    }
}
