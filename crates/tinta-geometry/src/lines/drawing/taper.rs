//! Tapers lines that end free, as a pen leaves the paper.
//!
//! Input: the visible lines of a drawing's layers. Output: paths without the stretches before their free ends, and these stretches as
//! tips. An end is free where no other line's ink covers it and the picture goes on.

use crate::bvh::{Box3, BoxTree};
use crate::edges::ClassSet;
use crate::lines::drawing::chain::LinePath;
use crate::lines::drawing::simplify::{distance, simplified};
use crate::scene::Size;
use crate::tolerances::JOINED_PX;
use glam::DVec2;

/// Length of a tip in line widths; it is at most the third part of its line.
const WIDTHS: f64 = 12.0;

/// The width at the end of a tip, as a share of the line's.
const END: f64 = 0.2;

/// A straight part of a drawn line.
struct Piece {
    ends: [DVec2; 2],
    radius: f64,
    /// Its layer and its path.
    path: (usize, usize),
    /// Its distance along the path from the path's ends.
    from_ends: [f64; 2],
}

/// The lines of a layer, and the width of each.
pub(in crate::lines) struct Lines<'a> {
    pub width_px: f64,
    pub paths: &'a mut [LinePath],
}

/// Cuts the stretches before free ends off the visible lines, and returns them for each layer: middle lines, from the full width to the
/// point.
pub(in crate::lines) fn taper(layers: &mut [Lines<'_>], size: Size) -> Vec<Vec<Vec<DVec2>>> {
    let pieces = pieces(layers);
    let around = |piece: &Piece| Box3::around(piece.ends.map(|end| end.extend(0.0)));
    let (tree, order) = BoxTree::new(&pieces.iter().map(around).collect::<Vec<Box3>>());
    let widest = pieces.iter().map(|piece| piece.radius).fold(0.0, f64::max);
    let corner = DVec2::new(f64::from(size.width), f64::from(size.height));
    let is_free = |end: DVec2, path: (usize, usize), side: usize, width: f64| {
        let reach = DVec2::splat(widest + JOINED_PX);
        let query = Box3::new((end - reach).extend(0.0), (end + reach).extend(0.0));
        let covers = |place: u32| {
            let piece = &pieces[order[place as usize] as usize];
            // A line may end on itself, but not on its own end.
            let is_other = piece.path != path || piece.from_ends[side] > width;
            is_other && distance(piece.ends, end) <= piece.radius + JOINED_PX
        };
        end.min_element() > JOINED_PX && (corner - end).min_element() > JOINED_PX && !tree.any(&query, covers)
    };
    let of_layer = |(number, Lines { width_px, paths }): (usize, &mut Lines<'_>)| {
        let mut tips = Vec::new();
        for (path_number, path) in paths.iter_mut().enumerate().filter(|(_, path)| can_taper(path)) {
            let ends = [path.points_px.first(), path.points_px.last()].map(|end| end.copied().unwrap_or_default());
            let [start, end] = [0, 1].map(|side| is_free(ends[side], (number, path_number), side, *width_px));
            let length = (WIDTHS * *width_px).min(length(path) / 3.0);
            if end {
                tips.push(cut(path, length));
            }
            if start {
                path.reverse();
                tips.push(cut(path, length));
                path.reverse();
            }
        }
        tips
    };
    layers.iter_mut().enumerate().map(of_layer).collect()
}

/// Whether a path may: not a ring, nor a model's own curve or point.
fn can_taper(path: &LinePath) -> bool {
    !path.is_closed && !ClassSet::OF_NO_SURFACE.contains(path.class) && length(path) > 0.0
}

fn length(path: &LinePath) -> f64 {
    path.points_px.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The parts of all lines.
fn pieces(layers: &[Lines<'_>]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (number, layer) in layers.iter().enumerate() {
        for (path_number, path) in layer.paths.iter().enumerate() {
            let closing = path.points_px.last().zip(path.points_px.first()).filter(|_| path.is_closed);
            let pairs = path.points_px.windows(2).map(|pair| [pair[0], pair[1]]);
            let whole = length(path);
            let mut along = 0.0;
            for ends in pairs.chain(closing.map(|(last, first)| [*last, *first])) {
                let next = along + ends[0].distance(ends[1]);
                let from_ends = [along, whole - next];
                pieces.push(Piece { ends, radius: layer.width_px / 2.0, path: (number, path_number), from_ends });
                along = next;
            }
        }
    }
    pieces
}

/// Cuts the last stretch of a length off a longer path, and returns it.
fn cut(path: &mut LinePath, length: f64) -> Vec<DVec2> {
    let mut tip = Vec::new();
    let mut left = length;
    while let [.., before, end] = path.points_px[..] {
        path.points_px.pop();
        tip.push(end);
        let step = before.distance(end);
        if step > left {
            let place = end + (before - end) * (left / step);
            path.points_px.push(place);
            tip.push(place);
            break;
        }
        left -= step;
        path.segments.pop();
    }
    tip.reverse();
    simplified(&tip, false)
}

/// At each point of a tip, the share of the line's width.
pub(in crate::lines) fn shares(tip: &[DVec2]) -> Vec<f64> {
    let mut along = vec![0.0];
    along.extend(tip.windows(2).scan(0.0, |along, pair| {
        *along += pair[0].distance(pair[1]);
        Some(*along)
    }));
    let whole = along[along.len() - 1];
    along.into_iter().map(|along| 1.0 + (END - 1.0) * along / whole).collect()
}

/// The outline of a tip: both sides of its middle line, which begins with this width.
pub(in crate::lines) fn outline(tip: &[DVec2], width: f64) -> Vec<DVec2> {
    let across = |place: usize, share: f64| {
        let way = tip[(place + 1).min(tip.len() - 1)] - tip[place.saturating_sub(1)];
        way.normalize_or_zero().perp() * (width / 2.0 * share)
    };
    let sides: Vec<[DVec2; 2]> = (0..)
        .zip(tip)
        .zip(shares(tip))
        .map(|((place, point), share)| {
            let across = across(place, share);
            [*point + across, *point - across]
        })
        .collect();
    let back = sides.iter().rev().map(|[_, right]| *right);
    sides.iter().map(|[left, _]| *left).chain(back).collect()
}
