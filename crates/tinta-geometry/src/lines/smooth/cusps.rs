//! The bend of smooth contours, averaged over several faces, and their cusps, where it changes.
//!
//! Input: the segments of [`Contours`], each with the bend of its own face. Output: the same segments, each with the
//! mean bend of its contour within two edges in both directions, weighted by the faces' areas. The mean is linear
//! between the midpoints of two segments, so a cusp has a place inside a segment, which is cut in two there. Slopes
//! of a linear n . v are right only on average: where the contour runs along the view, the sign may differ from face
//! to face. A change that lasts for less than two edges is not a cusp.

use crate::edges::Shell;
use crate::lines::smooth::contours::{ContourPiece, Contours, Link, ObjectSurface, between};
use crate::mesh::NONE;
use glam::DVec3;

/// How far along its contour a segment's mean reaches, in edges.
pub(in crate::lines) const REACH: f64 = 2.0;

impl Contours {
    /// Links the segments, averages their bends and cuts them at their cusps. `positions` are those of all objects in eye space.
    pub(super) fn linked(mut self, positions: &[DVec3]) -> Self {
        self.links = links(&self.surfaces, &self.pieces);
        settle(&self.surfaces, &mut self.pieces, positions, &mut self.links);
        self
    }
}

/// The places where two segments meet: on edges that are not sharp.
fn links(surfaces: &[ObjectSurface], pieces: &[ContourPiece]) -> Vec<Link> {
    let mut ends: Vec<(u32, u32, usize, usize)> = Vec::with_capacity(pieces.len() * 2);
    for (number, piece) in pieces.iter().enumerate() {
        let is_sharp = &surfaces[piece.object as usize].surface.is_sharp;
        let smooth = piece.edges.iter().enumerate().filter(|(_, edge)| **edge != NONE && !is_sharp[**edge as usize]);
        ends.extend(smooth.map(|(end, edge)| (piece.object, *edge, number, end)));
    }
    ends.sort_unstable();
    let links = ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter_map(|ends| match ends {
        [a, b] => Some(Link { object: a.0, ends: [(a.2, a.3), (b.2, b.3)] }),
        _ => None,
    });
    links.collect()
}

/// The mean bend around each segment, and whether its whole contour is shorter than the range of the mean.
fn means(
    surfaces: &[ObjectSurface],
    pieces: &[ContourPiece],
    lengths: &[f64],
    positions: &[DVec3],
    links: &[Link],
) -> Vec<(f64, bool)> {
    let mut neighbours = vec![[None; 2]; pieces.len()];
    for Link { ends: [first, second], .. } in links {
        neighbours[first.0][first.1] = Some(*second);
        neighbours[second.0][second.1] = Some(*first);
    }
    let mean = |number: usize| {
        let reach = REACH * surfaces[pieces[number].object as usize].longest_side(positions, pieces[number].face);
        let (mut sum, mut length) = (pieces[number].bend * lengths[number], lengths[number]);
        let mut is_short = true;
        for end in 0..2 {
            let mut left = reach;
            let mut next = neighbours[number][end];
            while let Some((other, came)) = next.filter(|(other, _)| left > 0.0 && *other != number) {
                sum += pieces[other].bend * lengths[other].min(left);
                length += lengths[other].min(left);
                left -= lengths[other];
                next = neighbours[other][came ^ 1];
            }
            is_short &= left > 0.0;
        }
        let own = if pieces[number].bends_away { f64::MIN_POSITIVE } else { -f64::MIN_POSITIVE };
        (if sum == 0.0 { own } else { sum / length }, is_short)
    };
    (0..pieces.len()).map(mean).collect()
}

/// Gives each segment the mean bend of its contour, and cuts segments in two where it changes.
fn settle(surfaces: &[ObjectSurface], pieces: &mut Vec<ContourPiece>, positions: &[DVec3], links: &mut Vec<Link>) {
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.ends[0].distance(piece.ends[1])).collect();
    let means = means(surfaces, pieces, &lengths, positions, links);
    for (piece, (mean, is_short)) in pieces.iter_mut().zip(&means).filter(|(piece, _)| piece.on_edge.is_none()) {
        let shell = surfaces[piece.object as usize].surface.shells[piece.face as usize];
        piece.bends_away = match (is_short, shell) {
            (false, _) | (_, Shell::Open) => *mean > 0.0,
            (true, Shell::Outward) => true,
            (true, Shell::Inward) => false,
        };
    }
    let mut is_cut = vec![false; pieces.len()];
    for index in 0..links.len() {
        let Link { object, ends: [first, second] } = links[index];
        if pieces[first.0].bends_away == pieces[second.0].bends_away || means[first.0].1 || means[second.0].1 {
            continue;
        }
        // The mean applies at the segments' midpoints and is linear between them.
        let halves = [first, second].map(|(piece, _)| lengths[piece] * 0.5);
        let [before, after] = [first, second].map(|(piece, _)| means[piece].0);
        let zero = before / (before - after) * (halves[0] + halves[1]) - halves[0];
        // The segment in which it changes, and the distance from the edge.
        let (near, far, depth) = if zero < 0.0 { (second, first, -zero) } else { (first, second, zero) };
        let share = depth / lengths[far.0];
        if !(share > 0.0 && share < 1.0) || is_cut[far.0] {
            continue;
        }
        is_cut[far.0] = true;
        let new = pieces.len();
        let piece = &mut pieces[far.0];
        let at = if far.1 == 0 { share } else { 1.0 - share };
        let middle = between(piece.ends[0], piece.ends[1], at);
        let normal = between(piece.normals[0], piece.normals[1], at);
        let mut cut = *piece;
        // The piece at the edge is the new segment.
        (cut.ends[far.1 ^ 1], cut.normals[far.1 ^ 1]) = (middle, normal);
        (piece.ends[far.1], piece.normals[far.1]) = (middle, normal);
        cut.bends_away = !piece.bends_away;
        pieces.push(cut);
        links[index].ends = [near, (new, far.1)];
        links.push(Link { object, ends: [(new, far.1 ^ 1), far] });
    }
}
