//! On which side of the surface a smooth contour bends away, told by more than one face.
//!
//! In: the pieces of [`Contours`](super::contours::Contours), each with what its own face says. Out: the same, each with what most of the contour says within
//! two edges of it, along it and either way. Linear n . v has slopes that are right only on average: where the contour runs along the
//! view, single faces say now this, now that. What lasts for less than two edges is no cusp.

use super::contours::{PartSurface, Piece};
use super::faces::Faces;
use crate::edges::Shell;

/// How far a piece is looked around for what its contour does, edges.
pub(super) const REACH: f64 = 2.0;

/// An edge with the two pieces that meet on it, and which end of each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub part: u32,
    pub edge: u32,
    pub ends: [(usize, usize); 2],
}

/// The places where two pieces hang together: on edges that are not sharp.
pub(super) fn links(parts: &[PartSurface], pieces: &[Piece]) -> Vec<Link> {
    let mut ends: Vec<(u32, u32, usize, usize)> = Vec::with_capacity(pieces.len() * 2);
    for (number, piece) in pieces.iter().enumerate() {
        let is_sharp = &parts[piece.part as usize].surface.is_sharp;
        let smooth = piece.edges.iter().enumerate().filter(|(_, edge)| !is_sharp[**edge as usize]);
        ends.extend(smooth.map(|(end, edge)| (piece.part, *edge, number, end)));
    }
    ends.sort_unstable();
    let links = ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter_map(|ends| match ends {
        [a, b] => Some(Link { part: a.0, edge: a.1, ends: [(a.2, a.3), (b.2, b.3)] }),
        _ => None,
    });
    links.collect()
}

/// Lets each piece bend as most of its contour around it does.
pub(super) fn settle(parts: &[PartSurface], pieces: &mut [Piece], faces: &Faces, links: &[Link]) {
    let mut neighbours = vec![[None; 2]; pieces.len()];
    for Link { ends: [first, second], .. } in links {
        neighbours[first.0][first.1] = Some(*second);
        neighbours[second.0][second.1] = Some(*first);
    }
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.ends[0].distance(piece.ends[1])).collect();
    let settled: Vec<(bool, bool)> = (0..pieces.len())
        .map(|number| {
            let sign = |number: usize| if pieces[number].bends_away { 1.0 } else { -1.0 };
            let reach = REACH * parts[pieces[number].part as usize].longest_side(faces, pieces[number].face);
            let (mut sum, mut is_short) = (sign(number) * lengths[number], true);
            for end in 0..2 {
                let mut left = reach;
                let mut next = neighbours[number][end];
                while let Some((other, came)) = next.filter(|(other, _)| left > 0.0 && *other != number) {
                    sum += sign(other) * lengths[other].min(left);
                    left -= lengths[other];
                    next = neighbours[other][came ^ 1];
                }
                is_short &= left > 0.0;
            }
            (if sum == 0.0 { pieces[number].bends_away } else { sum > 0.0 }, is_short)
        })
        .collect();
    for (piece, (bends_away, is_short)) in pieces.iter_mut().zip(settled).filter(|(piece, _)| piece.on_edge.is_none()) {
        let shell = parts[piece.part as usize].surface.shells[piece.face as usize];
        piece.bends_away = match (is_short, shell) {
            (false, _) | (_, Shell::Open) => bends_away,
            (true, Shell::Outward) => true,
            (true, Shell::Inward) => false,
        };
    }
}
