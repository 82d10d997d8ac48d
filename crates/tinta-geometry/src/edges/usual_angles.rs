//! The angle that edges have around an edge. On a coarse model of a round shape all edges are sharp; a crease there is sharper still.
//!
//! In: a [`Mesh`], its [`EdgeList`] and the faces' normals. Out: the angle at an edge, and the usual one beside it.

use super::{EdgeList, Incidence};
use crate::mesh::Mesh;
use glam::DVec3;

/// The least cosine between edges that run along one another: across it a tube bends, along it it does not.
const ALONG: f64 = 0.8;

pub(super) struct UsualAngles<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeList,
    normals: &'a [DVec3],
    /// The edges at each position that is asked for, one position after the other, and where each position's begin.
    at_positions: Vec<u32>,
    starts: Vec<u32>,
}

impl<'a> UsualAngles<'a> {
    /// Prepares the angles around some edges.
    pub(super) fn new(mesh: &'a Mesh, edges: &'a EdgeList, normals: &'a [DVec3], asked: &[u32]) -> Self {
        let mut is_asked = vec![false; mesh.positions.len()];
        for edge in asked {
            let corners = edges.faces(*edge).iter().flat_map(|face| mesh.triangles[*face as usize]);
            corners.for_each(|corner| is_asked[corner as usize] = true);
        }
        let all = || (0u32..).zip(edges.positions()).flat_map(|(edge, ends)| ends.map(|end| (edge, end as usize)));
        let ends = || all().filter(|(_, end)| is_asked[*end]);
        let mut starts = vec![0u32; mesh.positions.len() + 1];
        ends().for_each(|(_, end)| starts[end + 1] += 1);
        (0..mesh.positions.len()).for_each(|position| starts[position + 1] += starts[position]);
        let (mut next, mut at_positions) = (starts.clone(), vec![0; starts[mesh.positions.len()] as usize]);
        for (edge, end) in ends() {
            at_positions[next[end] as usize] = edge;
            next[end] += 1;
        }
        Self { mesh, edges, normals, at_positions, starts }
    }

    /// The angle between the two faces of an edge, degrees; `None` without two.
    pub(super) fn angle(&self, edge: u32) -> Option<f64> {
        let &[first, second] = self.edges.faces(edge) else { return None };
        let [first, second] = [first, second].map(|face| self.normals[face as usize]);
        let second = if self.edges.incidence()[edge as usize] == Incidence::InnerReversed { -second } else { second };
        Some(first.cross(second).length().atan2(first.dot(second)).to_degrees())
    }

    /// The usual angle around an edge, degrees; 0 where all edges that meet it are creases, as at polyhedra.
    ///
    /// It is the median of those edges. On a tube most of them run around it and are flat, so the edges beside this one that run along it
    /// count too, those of its flatter side.
    pub(super) fn around(&self, edge: u32, is_crease: impl Fn(u32) -> bool) -> f64 {
        let ends = self.edges.positions()[edge as usize];
        let meeting = || ends.into_iter().flat_map(|end| self.inner_at(end)).filter(|other| *other != edge);
        if meeting().all(is_crease) {
            return 0.0;
        }
        let mut angles: Vec<f64> = meeting().filter_map(|other| self.angle(other)).collect();
        let middle = angles.len() / 2;
        let median = *angles.select_nth_unstable_by(middle, f64::total_cmp).1;
        let beside = self.edges.faces(edge).iter().filter_map(|face| self.beside(edge, *face)).reduce(f64::min);
        beside.map_or(median, |beside| beside.max(median))
    }

    /// The mean angle of the edges that run along an edge from the third corner of a face at it; `None` without any.
    fn beside(&self, edge: u32, face: u32) -> Option<f64> {
        let ends = self.edges.positions()[edge as usize];
        let third = self.mesh.triangles[face as usize].into_iter().find(|corner| !ends.contains(corner))?;
        let along = |other: &u32| {
            let touches = self.edges.positions()[*other as usize].iter().any(|end| ends.contains(end));
            !touches && self.direction(*other).dot(self.direction(edge)).abs() > ALONG
        };
        let (count, sum) = self
            .inner_at(third)
            .filter(along)
            .filter_map(|other| self.angle(other))
            .fold((0, 0.0), |(count, sum), angle| (count + 1, sum + angle));
        (count > 0).then(|| sum / f64::from(count))
    }

    /// The edges of two faces at a position.
    fn inner_at(&self, position: u32) -> impl Iterator<Item = u32> + '_ {
        let [begin, end] = [position, position + 1].map(|position| self.starts[position as usize] as usize);
        self.at_positions[begin..end].iter().copied().filter(|edge| self.edges.faces(*edge).len() == 2)
    }

    fn direction(&self, edge: u32) -> DVec3 {
        let [from, to] = self.edges.positions()[edge as usize].map(|position| self.mesh.positions[position as usize]);
        (to - from).normalize_or_zero()
    }
}
