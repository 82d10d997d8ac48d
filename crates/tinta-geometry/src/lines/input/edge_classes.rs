//! The classes of a mesh's edges, each by the crease angle of its part.

use crate::edges::{Class, ClassSet, Classes, CreaseAngle, MeshEdges, lasting_creases};
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
    classes: Arc<Classes>,
    /// For each edge whether it is a lasting crease; `None` if all creases are drawn.
    lasting: Option<Vec<bool>>,
}

impl EdgeClasses {
    /// Finds the classes in `wanted` for the crease angle of each style of parts.
    pub(super) fn new(edges: &MeshEdges, settings: &LineSettings, angles: &[CreaseAngle], wanted: ClassSet) -> Self {
        let mut all = Self { of_angles: Vec::new(), of_looks: Vec::with_capacity(angles.len()) };
        for angle in angles {
            let known = all.of_angles.iter().position(|known| known.angle == *angle);
            all.of_looks.push(known.unwrap_or(all.of_angles.len()));
            if known.is_none() {
                let classes = match *angle == settings.crease_angle {
                    true => edges.classes(*angle, wanted),
                    // The mesh keeps those of one angle.
                    false => Arc::new(Classes::new(edges.mesh(), edges.list(), *angle, wanted)),
                };
                let lasting = lasting(edges, &classes, settings);
                all.of_angles.push(OfAngle { angle: *angle, classes, lasting });
            }
        }
        all
    }

    /// The edges with any class, ascending.
    pub(super) fn marked(&self) -> Cow<'_, [u32]> {
        match self.of_angles.as_slice() {
            [one] => Cow::Borrowed(&one.classes.marked),
            several => {
                let mut marked: Vec<u32> =
                    several.iter().flat_map(|of_angle| &of_angle.classes.marked).copied().collect();
                marked.sort_unstable();
                marked.dedup();
                Cow::Owned(marked)
            }
        }
    }

    /// The classes of an edge whose part has a style, and whether it may be drawn as a crease.
    pub(super) fn of(&self, edge: u32, look: u32) -> (ClassSet, bool) {
        let OfAngle { classes, lasting, .. } = &self.of_angles[self.of_looks[look as usize]];
        let of_edge = classes.of_edges[edge as usize];
        match lasting.as_ref().is_none_or(|lasting| lasting[edge as usize]) {
            true => (of_edge, true),
            false => (of_edge.without(&CREASES), false),
        }
    }
}

fn lasting(edges: &MeshEdges, classes: &Classes, settings: &LineSettings) -> Option<Vec<bool>> {
    let creases = match settings.creases_by_normals {
        true => ClassSet::of(&[Class::Normal]),
        false => ClassSet::of(&CREASES),
    };
    let is_crease = |edge: u32| !classes.of_edges[edge as usize].and(creases).is_empty();
    settings.lasting_creases.then(|| lasting_creases(edges.mesh(), edges.list(), is_crease))
}
