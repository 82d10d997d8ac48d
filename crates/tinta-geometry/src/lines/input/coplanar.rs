//! Whether faces that meet at an edge lie in one plane, and corners on a line between others.
//!
//! Input: a mesh and its edges. Output: for two faces at an edge, how they lie; for an edge, the faces that end there.

use crate::edges::EdgeList;
use crate::mesh::Mesh;
use crate::tolerances::{CONTACT, PRINTED_DIGITS, WELD};
use glam::DVec3;

/// A mesh whose faces and corners are tested against one another's planes and sides.
pub(super) struct Planar<'a> {
    pub mesh: &'a Mesh,
    /// The centre and the length of the bounding box's diagonal, file units.
    pub middle: DVec3,
    pub diagonal: f64,
    /// Distances, in file units: below `weld` positions coincide, below `digits` coordinates with six digits may
    /// deviate from a plane, below `beside` from a side.
    pub weld: f64,
    digits: f64,
    pub beside: f64,
}

/// Sine of the largest angle between coplanar faces, and between a side and a corner on it.
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
        let [weld, digits, beside] =
            [WELD, PRINTED_DIGITS, PRINTED_DIGITS.max(mesh.weld)].map(|share| share * diagonal);
        Self { mesh, middle: (low + high) * 0.5, diagonal, weld, digits, beside }
    }

    /// Whether a corner lies on the line between two others, by its distances from the line and from the nearer of them.
    pub(super) fn is_on_line(&self, distance: f64, from_end: f64) -> bool {
        distance <= self.weld || distance <= self.beside && distance <= LARGEST_SINE * from_end
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

    /// The faces that end at an edge with three or more. Two flat parts of one polygon continue one another; if all others lie in one
    /// plane, those on both sides of the edge do too. `None` if no faces continue one another.
    fn ending(&self, edges: &EdgeList, edge: u32, kinds: &Kinds) -> Option<Ending> {
        let (ends, mesh) = (self.ends(edges, edge), self.mesh);
        let whole = kinds.whole;
        let lie_flat = |a: u32, b: u32| self.fold(ends, [a, b]) == Fold::Flat;
        let (mut faces, mut continuing) = (Vec::new(), Vec::new());
        let mut by_polygon = edges.faces(edge).to_vec();
        by_polygon.sort_by_key(|face| mesh.file_face(*face));
        for polygon in by_polygon.chunk_by(|a, b| mesh.file_face(*a) == mesh.file_face(*b)) {
            let mut polygon = polygon.to_vec();
            continuing.extend(paired(&mut polygon, |a, b| whole(a) == whole(b) || lie_flat(a, b)));
            faces.append(&mut polygon);
        }
        faces.sort_unstable();
        let mut diagonals = continuing.iter().filter(|[a, b]| whole(*a) != whole(*b));
        let crossing = diagonals.find_map(|pair| Some([pair[0], self.across(edges, edge, *pair)?]));
        if let [first, _, _, ..] = *faces.as_slice()
            && faces.iter().all(|other| *other == first || self.fold(ends, [first, *other]) != Fold::Bent)
        {
            let material = |face: u32| mesh.triangle_materials.get(face as usize);
            let part = |face: u32| mesh.triangle_parts.get(face as usize);
            let is_ghost = kinds.is_ghost;
            let continue_one_another = |a: u32, b: u32| is_ghost(a) == is_ghost(b) && lie_flat(a, b);
            let are_alike = |a: u32, b: u32| material(a) == material(b) && part(a) == part(b);
            continuing.extend(paired(&mut faces, |a, b| are_alike(a, b) && continue_one_another(a, b)));
            continuing.extend(paired(&mut faces, continue_one_another));
        }
        if faces.is_empty() {
            faces.extend(continuing.first()?);
        }
        (!continuing.is_empty()).then_some(Ending { edge, faces, crossing })
    }

    /// One of the other faces at an edge along which a polygon continues, if there are some on both sides of its plane.
    fn across(&self, edges: &EdgeList, edge: u32, polygon: [u32; 2]) -> Option<u32> {
        let (ends, start) = (self.ends(edges, edge), self.ends(edges, edge)[0]);
        let is_bent = |face: &u32| polygon.iter().all(|of_polygon| self.fold(ends, [*of_polygon, *face]) == Fold::Bent);
        let others = || edges.faces(edge).iter().copied().filter(|face| !polygon.contains(face) && is_bent(face));
        let normal = self.normal(polygon[0]);
        // Two of a face's corners lie on the edge.
        let height = |face: u32| self.corners(face).iter().map(|corner| (*corner - start).dot(normal)).sum::<f64>();
        let has_below = others().any(|face| height(face) < 0.0);
        others().find(|face| height(*face) > 0.0).filter(|_| has_below)
    }
}

/// The faces that end at an edge; if none does, two that continue one another.
pub(super) struct Ending {
    pub edge: u32,
    pub faces: Vec<u32>,
    /// Two faces of surfaces that pass through one another along the edge, which is the first one's own diagonal.
    pub crossing: Option<[u32; 2]>,
}

/// Takes pairs out of a list of faces.
fn paired(faces: &mut Vec<u32>, are_pair: impl Fn(u32, u32) -> bool) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    let mut next = 0;
    while let Some(first) = faces.get(next).copied() {
        match faces[next + 1..].iter().position(|other| are_pair(first, *other)) {
            Some(after) => {
                pairs.push([first, faces.remove(next + 1 + after)]);
                faces.remove(next);
            }
            None => next += 1,
        }
    }
    pairs
}

/// What decides whether two faces continue one another, besides their places.
pub(super) struct Kinds<'a> {
    /// The unsplit face that a face is a part of.
    pub whole: &'a dyn Fn(u32) -> u32,
    /// Whether it hides nothing.
    pub is_ghost: &'a dyn Fn(u32) -> bool,
}

/// The edges with three faces or more where some continue one another, each with the faces that end there: no diagonal of a flat
/// polygon is an edge, whatever else lies along it. A ghost and another face do not continue one another.
pub(super) fn ending_faces(mesh: &Mesh, edges: &EdgeList, kinds: &Kinds) -> Vec<Ending> {
    let planar = Planar::new(mesh);
    edges.non_manifold().filter_map(|(edge, _)| planar.ending(edges, edge, kinds)).collect()
}
