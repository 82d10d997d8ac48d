//! Whether faces that meet at an edge lie in one plane.
//!
//! Input: a mesh and its edges. Output: for two faces at an edge, how they lie; for an edge, the faces that end there.

use crate::edges::EdgeList;
use crate::mesh::Mesh;
use crate::tolerances::{CONTACT, PRINTED_DIGITS, WELD};
use glam::DVec3;

/// A mesh whose faces are tested against one another's planes.
pub(super) struct Planar<'a> {
    pub mesh: &'a Mesh,
    /// Distances, in file units: below `weld` positions coincide, below `digits` coordinates with six digits may
    /// deviate from a plane.
    pub weld: f64,
    digits: f64,
}

/// Sine of the largest angle between coplanar faces.
pub(super) const LARGEST_SINE: f64 = 0.01;

/// The position of two faces at an edge.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Fold {
    /// Coplanar, on the same side of the edge.
    Closed,
    /// Coplanar, on opposite sides of the edge.
    Flat,
    Bent,
}

impl<'a> Planar<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let diagonal = low.distance(high);
        Self { mesh, weld: WELD * diagonal, digits: PRINTED_DIGITS * diagonal }
    }

    pub(super) fn corners(&self, face: u32) -> [DVec3; 3] {
        self.mesh.triangles[face as usize].map(|corner| self.mesh.positions[corner as usize])
    }

    pub(super) fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a)
    }

    /// The position of two faces at a line between two points; their farthest corners from it decide.
    pub(super) fn fold(&self, [start, end]: [DVec3; 2], faces: [u32; 2]) -> Fold {
        let along = (end - start).normalize_or_zero();
        let across = |face: u32| {
            let corners = self.corners(face).map(|corner| {
                let from_start = corner - start;
                from_start - along * along.dot(from_start)
            });
            let [a, b, c] = corners;
            let farther = |a: DVec3, b: DVec3| if b.length_squared() > a.length_squared() { b } else { a };
            farther(farther(a, b), c)
        };
        let [first, second] = faces.map(across);
        let (short, long) =
            if first.length_squared() <= second.length_squared() { (first, second) } else { (second, first) };
        let distance = short.cross(long).length() / long.length();
        let longest = start.distance(end).max(short.length());
        let is_in_plane = distance <= CONTACT * longest + self.weld
            || distance <= self.digits && distance <= LARGEST_SINE * short.length();
        match short.dot(long) > 0.0 {
            _ if !is_in_plane => Fold::Bent,
            true => Fold::Closed,
            false => Fold::Flat,
        }
    }

    /// Whether two faces at an edge form an angle below 90 degrees: a quick test that settles most edges.
    pub(super) fn is_acute(&self, [start, end]: [DVec3; 2], faces: [u32; 2]) -> bool {
        let along = end - start;
        // Two of a face's corners lie on the edge, so the sum is the third corner, shifted along the edge.
        let [first, second] = faces.map(|face| self.corners(face).iter().map(|corner| *corner - start).sum::<DVec3>());
        first.dot(second) * along.length_squared() > first.dot(along) * second.dot(along)
    }

    pub(super) fn ends(&self, edges: &EdgeList, edge: u32) -> [DVec3; 2] {
        edges.positions()[edge as usize].map(|position| self.mesh.positions[position as usize])
    }

    /// The faces that end at an edge all of whose faces lie in one plane: faces on both sides of it continue one another, and
    /// count no more. `None` if not all lie in one plane, or on one side. If all faces continue, two of them that lie flat.
    fn ending(&self, edges: &EdgeList, edge: u32) -> Option<Vec<u32>> {
        let ends = self.ends(edges, edge);
        let (first, others) = edges.faces(edge).split_first()?;
        let (mut left, mut right) = (vec![*first], Vec::new());
        for other in others {
            match self.fold(ends, [*first, *other]) {
                Fold::Closed => left.push(*other),
                Fold::Flat => right.push(*other),
                Fold::Bent => return None,
            }
        }
        if right.is_empty() {
            return None;
        }
        let mesh = self.mesh;
        let material = |face: u32| mesh.triangle_materials.get(face as usize);
        let part = |face: u32| mesh.triangle_parts.get(face as usize);
        // Faces of one polygon continue one another, then those of one material and part.
        let likeness: [&dyn Fn(u32, u32) -> bool; 3] = [
            &|a, b| mesh.file_face(a) == mesh.file_face(b),
            &|a, b| material(a) == material(b) && part(a) == part(b),
            &|_, _| true,
        ];
        let mut flat = None;
        for continues in likeness {
            left.retain(|face| {
                let Some(place) = right.iter().position(|other| continues(*face, *other)) else { return true };
                flat.get_or_insert([*face, right.remove(place)]);
                false
            });
        }
        left.append(&mut right);
        if left.is_empty() {
            left.extend(flat.into_iter().flatten());
        }
        left.sort_unstable();
        Some(left)
    }
}

/// The edges with three faces or more, all in one plane, of which some continue one another, each with the faces that end there: no
/// diagonal of a flat polygon is an edge, however many polygons lie on one another. A ghost and another face do not continue one
/// another.
pub(super) fn ending_faces(mesh: &Mesh, edges: &EdgeList, is_ghost: impl Fn(u32) -> bool) -> Vec<(u32, Vec<u32>)> {
    let planar = Planar::new(mesh);
    let are_alike = |faces: &[u32]| faces.windows(2).all(|pair| is_ghost(pair[0]) == is_ghost(pair[1]));
    let crowded = edges.non_manifold().filter(|(_, faces)| are_alike(faces));
    crowded.filter_map(|(edge, _)| Some((edge, planar.ending(edges, edge)?))).collect()
}
