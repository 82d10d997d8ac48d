//! How surfaces continue at an edge that lies in another face's plane.
//!
//! Input: the objects with their split edges, and faces that meet. Output: whether the surfaces pass through one another, and the
//! pieces of split edges that faces pierce.

use crate::lines::eye::face_pair::{FaceCrossing, FacePlane, Piercing};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::input::object_edges::ObjectEdges;
use glam::{DVec2, DVec3};
use std::collections::{HashMap, HashSet};

/// The splits of edges at T-junctions.
pub(in crate::lines::visible) struct SplitEdges<'a> {
    objects: &'a [ObjectEdges<'a>],
}

impl<'a> SplitEdges<'a> {
    pub(in crate::lines::visible) fn new(objects: &'a [ObjectEdges<'a>]) -> Self {
        Self { objects }
    }

    /// The positions along an edge, its own first and last.
    fn way(&self, edge: [u32; 2]) -> Vec<u32> {
        let number = self.objects.partition_point(|object| object.first_position <= edge[0]) - 1;
        let (object, start) = (&self.objects[number], self.objects[number].first_position);
        let on_edge = object.on_edge(edge.map(|position| position - start)).iter();
        [edge[0]].into_iter().chain(on_edge.map(|position| position + start)).chain([edge[1]]).collect()
    }

    /// Assigns each piercing of an edge to the piece that holds it, and to that piece's neighbours, because they may meet there.
    /// A point beyond a piece's end does not cut the piece.
    pub(in crate::lines::visible) fn piercings(&self, faces: &Faces, found: Vec<Piercing>) -> Vec<Piercing> {
        if !self.objects.iter().any(ObjectEdges::has_split_edges) {
            return found;
        }
        let of_pieces = |piercing: Piercing| {
            let Piercing { edge, point } = piercing;
            let way = self.way(edge);
            let number = piece_at(faces, &way, point);
            let near = &way[number.saturating_sub(1)..way.len().min(number + 3)];
            pieces(near).map(|edge| Piercing { edge, point }).collect::<Vec<_>>()
        };
        found.into_iter().flat_map(of_pieces).collect()
    }
}

/// The pieces between positions along an edge, the lower position of each first.
fn pieces(way: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    way.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
}

/// The number of the piece of an edge that is nearest to a point on it.
fn piece_at(faces: &Faces, way: &[u32], point: DVec3) -> usize {
    let position = |index: usize| faces.positions[way[index] as usize];
    let along = position(way.len() - 1) - position(0);
    way[1..way.len() - 1].partition_point(|at| (faces.positions[*at as usize] - point).dot(along) <= 0.0)
}

/// The faces at each edge that lies in another face's plane: how the surface continues there, with T-junctions split.
pub(in crate::lines::visible) struct HalfPlanes {
    /// The positions along each edge at which it was split, with its own.
    ways: HashMap<[u32; 2], Vec<u32>>,
    /// All faces at a piece: the third corner of each, and the number of the whole face that it is a part of.
    at_pieces: HashMap<[u32; 2], Vec<(u32, u32)>>,
}

impl HalfPlanes {
    pub(in crate::lines::visible) fn at_touched_edges(split: &SplitEdges, lines: &[FaceCrossing]) -> Self {
        let touched: HashSet<[u32; 2]> = lines.iter().flat_map(|found| found.touching.into_iter().flatten()).collect();
        let ways: HashMap<[u32; 2], Vec<u32>> = touched.into_iter().map(|edge| (edge, split.way(edge))).collect();
        let mut at_pieces: HashMap<[u32; 2], Vec<(u32, u32)>> =
            ways.values().flat_map(|way| pieces(way)).map(|piece| (piece, Vec::new())).collect();
        if ways.is_empty() {
            return Self { ways, at_pieces };
        }
        for object in split.objects {
            for (face, triangle) in (0..).zip(&object.edges.get().mesh().triangles) {
                let [a, b, c] = triangle.map(|corner| corner + object.first_position);
                for (from, to, third) in [(a, b, c), (b, c, a), (c, a, b)] {
                    if let Some(at_piece) = at_pieces.get_mut(&[from.min(to), from.max(to)]) {
                        at_piece.push((third, object.first_face + object.whole_face(face)));
                    }
                }
            }
        }
        Self { ways, at_pieces }
    }

    /// The third corners of the faces at the piece of an edge that is nearest to a point. The parts of a face that passes through the
    /// edge, given by its number, are not among them.
    fn at(&self, faces: &Faces, edge: [u32; 2], point: DVec3, passing: u32) -> impl Iterator<Item = u32> {
        let way = &self.ways[&edge];
        let number = piece_at(faces, way, point);
        let at_piece = &self.at_pieces[&[way[number].min(way[number + 1]), way[number].max(way[number + 1])]];
        at_piece.iter().filter(move |(_, whole)| *whole != passing).map(|(third, _)| *third)
    }

    /// Whether two surfaces pass through one another along a line: around it, half-planes of one and of the other follow one
    /// another twice. Half-planes of both that coincide count for neither.
    pub(in crate::lines::visible) fn pass_through(&self, space: &Space, faces: &Faces, found: &FaceCrossing) -> bool {
        if found.touching == [None; 2] {
            return true;
        }
        let [start, end] = found.ends;
        let Some(along) = (end - start).try_normalize() else { return false };
        let (right, up) = along.any_orthonormal_pair();
        let around = |point: DVec3| {
            let across = point - start;
            DVec2::new(across.dot(right), across.dot(up))
        };
        let farthest = |corners: [DVec2; 3], towards: DVec2| {
            let reach = |corner: &DVec2| corner.dot(towards);
            corners.into_iter().max_by(|a, b| reach(a).total_cmp(&reach(b))).unwrap_or_default()
        };
        // Each half-plane by its farthest point, seen along the line.
        let half_planes = |side: usize| -> Vec<DVec2> {
            match found.touching[side] {
                Some(edge) => {
                    let passing = faces.numbers[found.faces[1 - side] as usize];
                    let thirds = self.at(faces, edge, start.lerp(end, 0.5), passing);
                    thirds.map(|third| around(faces.positions[third as usize])).collect()
                }
                None => {
                    let corners = faces.corners(found.faces[side]).map(around);
                    let some = corners.into_iter().max_by(|a, b| a.length().total_cmp(&b.length())).unwrap_or_default();
                    [some, -some].map(|towards| farthest(corners, towards)).to_vec()
                }
            }
        };
        let [first, second] = [half_planes(0), half_planes(1)];
        let face_planes = found.faces.map(|place| FacePlane::new(space, faces, place));
        let contact = face_planes[0].contact(space, &face_planes[1]);
        let lie_on_one_another = |a: DVec2, b: DVec2| {
            let (short, long) = if a.length() <= b.length() { (a, b) } else { (b, a) };
            short.dot(long) > 0.0 && short.perp_dot(long).abs() <= contact * long.length()
        };
        let without = |some: &[DVec2], others: &[DVec2]| -> Vec<f64> {
            let apart = some.iter().filter(|a| !others.iter().any(|b| lie_on_one_another(**a, *b)));
            apart.map(|towards| towards.to_angle()).collect()
        };
        let (first_apart, second_apart) = (without(&first, &second), without(&second, &first));
        let mut round: Vec<(f64, bool)> = first_apart.into_iter().map(|angle| (angle, false)).collect();
        round.extend(second_apart.into_iter().map(|angle| (angle, true)));
        round.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        (0..round.len()).filter(|index| round[*index].1 != round[(index + 1) % round.len()].1).count() >= 4
    }
}
