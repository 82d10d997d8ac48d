//! The classes of a mesh's edges, each by the crease angle of its part.

use crate::edges::{Class, ClassSet, Classes, CreaseAngle, LastingCreases, MeshEdges};
use crate::lines::LineSettings;
use std::borrow::Cow;
use std::sync::Arc;

/// Classes of edges that `lasting_creases` restricts.
pub(super) const CREASES: [Class; 3] = [Class::Crease, Class::ConvexCrease, Class::ConcaveCrease];

/// The classes of a mesh's edges for the crease angles of all parts.
pub(super) struct EdgeClasses {
    of_angles: Vec<OfAngle>,
    /// For each style of parts its place in `of_angles`.
    of_looks: Vec<usize>,
}

/// The classes for one crease angle.
struct OfAngle {
    angle: CreaseAngle,
    found: AngleClasses,
}

/// Edges with classes, and which of them are creases.
enum AngleClasses {
    /// Every edge alone.
    Each(Arc<Classes>),
    /// Creases only where they last.
    Lasting(Arc<LastingCreases>),
}

impl AngleClasses {
    fn classes(&self) -> &Classes {
        match self {
            Self::Each(classes) => classes,
            Self::Lasting(lasting) => &lasting.classes,
        }
    }
}

impl EdgeClasses {
    /// Finds the classes in `wanted` for the crease angle of each style of parts.
    pub(super) fn new(edges: &MeshEdges, settings: &LineSettings, angles: &[CreaseAngle], wanted: ClassSet) -> Self {
        let mut all = Self { of_angles: Vec::new(), of_looks: Vec::with_capacity(angles.len()) };
        for angle in angles {
            let known = all.of_angles.iter().position(|known| known.angle == *angle);
            all.of_looks.push(known.unwrap_or(all.of_angles.len()));
            if known.is_some() {
                continue;
            }
            let found = match *angle == settings.crease_angle {
                _ if settings.lasting_creases => {
                    AngleClasses::Lasting(edges.lasting(*angle, wanted, settings.creases_by_normals))
                }
                true => AngleClasses::Each(edges.classes(*angle, wanted)),
                // The mesh keeps those of one angle.
                false => AngleClasses::Each(Arc::new(Classes::new(edges.mesh(), edges.list(), *angle, wanted))),
            };
            all.of_angles.push(OfAngle { angle: *angle, found });
        }
        all
    }

    /// The edges with any class, ascending.
    pub(super) fn marked(&self) -> Cow<'_, [u32]> {
        match self.of_angles.as_slice() {
            [one] => Cow::Borrowed(&one.found.classes().marked),
            several => {
                let mut marked: Vec<u32> =
                    several.iter().flat_map(|of_angle| &of_angle.found.classes().marked).copied().collect();
                marked.sort_unstable();
                marked.dedup();
                Cow::Owned(marked)
            }
        }
    }

    /// The classes of an edge whose part has a style, and whether it may be drawn as a crease.
    pub(super) fn of(&self, edge: u32, look: u32) -> (ClassSet, bool) {
        let OfAngle { found, .. } = &self.of_angles[self.of_looks[look as usize]];
        let of_edge = found.classes().of_edges[edge as usize];
        match found {
            AngleClasses::Lasting(lasting) if !lasting.lasts[edge as usize] => (of_edge.without(&CREASES), false),
            _ => (of_edge, true),
        }
    }
}
