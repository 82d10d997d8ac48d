//! Tangent edges: where a flat or straight patch of a surface meets a rounding without a crease.
//!
//! In: a [`Mesh`], its [`EdgeList`], the faces' normals. Out: the edges, ascending. A section across an edge is a
//! polygon. Between its chords a circle turns by half of each chord's own angle, a straight line not at all. An edge with the turn
//! of one side's chord alone separates a rounding from a straight patch. A facet of a cylinder and a rounding of one facet look alike;
//! a rounding therefore needs four chords of one curvature.

use super::{EdgeList, Incidence};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, NONE};
use crate::threads::in_parallel;
use glam::DVec3;

/// Largest turn between two faces that counts as flat, radians: more than a file's six digits bend a facet.
const FLAT: f64 = 1e-3;

/// Cosine of the largest turn within a rounding, 25 degrees: four facets a quarter turn have 22.5 between them. A crease angle would
/// not do: looks that keep lasting creases judge by a smaller one.
const TURN: f64 = 0.9063;

/// Largest curvature of the straight side, as a share of the rounding's.
const STRAIGHT: f64 = 0.25;

/// Largest difference between two curvatures of one rounding, as a share of the larger.
const ALIKE: f64 = 0.5;

/// Where sections cross an edge, shares of its length: off the middle, since sections from there run into corners.
const SECTIONS: [f64; 3] = [0.257, 0.493, 0.741];

/// Sections that must agree on an edge.
const DECIDING: usize = 2;

/// Least length of joined edges on which all sections agree, in facets of the rounding. Shorter ones are an accident of a scan.
const LEAST_FACETS: f64 = 3.0;

/// Chords that a section follows to each side.
const CHORDS: usize = 4;

/// Faces that a section crosses to each side.
const LONGEST: usize = 64;

/// One side of a section: the lengths of its chords, and the turn at the end of each, positive where the surface is convex.
#[derive(Default)]
struct Side {
    lengths: [f64; CHORDS],
    turns: [f64; CHORDS],
    count: usize,
}

impl Side {
    /// The curvature, if all chords have one. Two turns together make up for a rounding whose facets are not alike.
    fn curvature(&self) -> Option<f64> {
        let of = |first: usize| {
            let [one, middle, other] = [0, 1, 2].map(|chord| self.lengths[first + chord]);
            (self.turns[first] + self.turns[first + 1]) / (middle + 0.5 * (one + other))
        };
        let [near, far] = [of(0), of(1)];
        (self.count == CHORDS && (far - near).abs() <= ALIKE * near.abs().max(far.abs())).then_some(near)
    }

    /// The turn at the end of the first chord that the second chord's curvature does not explain, twice. 0 where the surface ends before.
    fn rest_beyond(&self) -> f64 {
        let ([_, second, third, fourth], [end, next, last, _]) = (self.lengths, self.turns);
        let curvature = match self.count {
            ..3 => return 0.0,
            3 => 2.0 * next / (second + third),
            _ => (next + last) / (third + 0.5 * (second + fourth)),
        };
        2.0 * end - curvature * second
    }
}

struct Sections<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeList,
    normals: &'a [[f64; 3]],
    /// For each face its edges.
    of_faces: Vec<[u32; 3]>,
}

/// The tangent edges of a mesh, ascending.
pub(super) fn tangents(mesh: &Mesh, edges: &EdgeList, normals: &[[f64; 3]], threads: usize) -> Vec<u32> {
    let sections = Sections { mesh, edges, normals, of_faces: edges.of_faces(mesh) };
    let found = in_parallel(edges.len(), threads, |range| {
        let facets = range.map(|edge| (edge as u32, sections.facets(edge as u32)));
        facets.filter(|(_, agreeing)| agreeing.len() >= DECIDING).collect::<Vec<_>>()
    });
    let found = found.concat();
    let mut joined = DisjointSets::new(mesh.positions.len());
    found.iter().for_each(|(edge, _)| joined.join(edges.positions[*edge as usize]));
    let mut set_of = |edge: u32| joined.root(edges.positions[edge as usize][0]) as usize;
    let mut lengths = vec![0.0; mesh.positions.len()];
    for (edge, facets) in found.iter().filter(|(_, facets)| facets.len() == SECTIONS.len()) {
        lengths[set_of(*edge)] += facets.iter().sum::<f64>() / facets.len() as f64;
    }
    found.into_iter().map(|(edge, _)| edge).filter(|edge| lengths[set_of(*edge)] >= LEAST_FACETS).collect()
}

impl Sections<'_> {
    /// An edge's length in facets of the rounding, by each section that finds one on one side and a straight patch on the other.
    fn facets(&self, edge: u32) -> Vec<f64> {
        let [first, second] = match self.edges.incidence[edge as usize] {
            Incidence::Inner | Incidence::InnerReversed => self.edges.faces[edge as usize],
            _ => return Vec::new(),
        };
        let Some((_, turn)) = self.crossing(edge, first, self.normal(first)) else { return Vec::new() };
        if turn.abs() < FLAT {
            return Vec::new();
        }
        let [from, to] = self.ends(edge);
        let facets = |share: &f64| {
            let start = from.lerp(to, *share);
            let [one, other] = [self.side(edge, first, first, start)?, self.side(edge, second, first, start)?];
            let separates = |straight: &Side, round: &Side| {
                let curvature = round.curvature()?;
                let rest = 2.0 * turn - curvature * round.lengths[0];
                let most = STRAIGHT * (curvature * straight.lengths[0]).abs();
                let is_straight = rest.abs() <= most && straight.rest_beyond().abs() <= most;
                is_straight.then(|| from.distance(to) / round.lengths[0])
            };
            separates(&one, &other).or_else(|| separates(&other, &one))
        };
        let mut found = Vec::new();
        for (section, share) in SECTIONS.iter().enumerate() {
            // So many left cannot decide any more.
            if found.len() + SECTIONS.len() - section < DECIDING {
                break;
            }
            found.extend(facets(share));
        }
        found
    }

    /// Follows the section that begins at an edge perpendicular to it into one of its faces. The front is that of the face `fronts`.
    fn side(&self, edge: u32, face: u32, fronts: u32, start: DVec3) -> Option<Side> {
        let (mut edge, mut face, mut point) = (edge, face, start);
        let mut normal = self.normal(fronts);
        if face != fronts {
            normal = self.crossing(edge, fronts, normal)?.0;
        }
        let [from, to] = self.ends(edge);
        let inwards = normal.cross(to - from).normalize();
        let mut direction = if (self.beyond(edge, face)? - from).dot(inwards) > 0.0 { inwards } else { -inwards };
        let mut side = Side::default();
        for _ in 0..LONGEST {
            let (next, length) = self.exit(edge, face, normal, point, direction)?;
            side.lengths[side.count] += length;
            point += direction * length;
            let crossed = self.crossing(next, face, normal);
            if crossed.is_none_or(|(_, turn)| turn.abs() >= FLAT) {
                side.turns[side.count] = crossed.map_or(0.0, |(_, turn)| turn);
                side.count += 1;
            }
            let Some((beyond, _)) = crossed.filter(|_| side.count < CHORDS) else { break };
            let [from, to] = self.ends(next);
            let along = (to - from).normalize();
            // The same direction in the next face's plane, which meets this one's along the edge.
            let [here, there] = [normal.cross(along), beyond.cross(along)];
            direction = along * direction.dot(along) + there * direction.dot(here);
            face = self.other_face(next, face);
            (edge, normal) = (next, beyond);
        }
        Some(side)
    }

    /// The edge at which a ray within a face leaves it, and the length until there.
    fn exit(&self, entered: u32, face: u32, normal: DVec3, point: DVec3, direction: DVec3) -> Option<(u32, f64)> {
        let leaves = |edge: &u32| {
            let [from, to] = self.ends(*edge);
            let outwards = normal.cross(to - from);
            ((from - point).dot(outwards) / direction.dot(outwards), *edge)
        };
        let others = self.of_faces[face as usize].into_iter().filter(|edge| *edge != entered && *edge != NONE);
        let sides = others.map(|edge| leaves(&edge)).filter(|(length, _)| *length >= 0.0);
        sides.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(length, edge)| (edge, length))
    }

    /// The normal beyond an edge of a face whose normal is `normal`, on the same side of the surface, and the turn there: positive where
    /// the surface is convex. `None` where the surface ends or turns too far.
    fn crossing(&self, edge: u32, face: u32, normal: DVec3) -> Option<(DVec3, f64)> {
        if !matches!(self.edges.incidence[edge as usize], Incidence::Inner | Incidence::InnerReversed) {
            return None;
        }
        let own = self.normal(face);
        let beyond = self.normal(self.other_face(edge, face));
        let is_turned = (own.dot(normal) < 0.0) != (self.edges.incidence[edge as usize] == Incidence::InnerReversed);
        let beyond = if is_turned { -beyond } else { beyond };
        let cosine = normal.dot(beyond);
        let [from, to] = self.ends(edge);
        let along = (to - from).normalize();
        let away = self.beyond(edge, face)?;
        // Outwards of the face, in its plane.
        let outwards = normal.cross(along);
        let outwards = if (away - from).dot(outwards) > 0.0 { -outwards } else { outwards };
        (cosine >= TURN).then(|| (beyond, beyond.dot(outwards).atan2(cosine)))
    }

    /// A face's corner that is not on an edge of it.
    fn beyond(&self, edge: u32, face: u32) -> Option<DVec3> {
        let ends = self.edges.positions[edge as usize];
        let corner = self.mesh.triangles[face as usize].into_iter().find(|corner| !ends.contains(corner));
        corner.map(|corner| self.position(corner))
    }

    fn other_face(&self, edge: u32, face: u32) -> u32 {
        let [first, second] = self.edges.faces[edge as usize];
        if first == face { second } else { first }
    }

    fn normal(&self, face: u32) -> DVec3 {
        DVec3::from_array(self.normals[face as usize])
    }

    fn position(&self, number: u32) -> DVec3 {
        self.mesh.positions[number as usize]
    }

    fn ends(&self, edge: u32) -> [DVec3; 2] {
        self.edges.positions[edge as usize].map(|number| self.position(number))
    }
}
