//! Keeps the outline readable: lines at narrow slits become inner lines, and short runs take the class of their neighbours.
//!
//! In: pieces of lines and the width of the outline. Out: the same pieces, cut where their class changes. Two rules apply:
//!
//! - *Slits.* The ink of two outline lines nearer than [`SLIT`] widths would fill the background between them: both become inner
//!   lines there. Of two with background on the same side, as at a face seen nearly edge-on, the outer one stays outline: the inner
//!   one does in its place where the outer one's run is shorter than [`SHORT_RUN`] widths. Along the outline, a part shorter than that,
//!   slit or not, takes the class of its neighbours.
//! - *Short runs.* A run of inner line shorter than [`SHORT_RUN`] widths between two runs of outline becomes outline. A short run
//!   of outline between two runs of inner line becomes inner line, unless other lines continue the outline at both of its ends: at
//!   corners, and where silhouettes cross. The shortest run changes first.
//!
//! Runs follow chains: pieces that continue one another, whatever their classes and objects. Where pieces meet, two of the
//! outline are paired first, then the pair that continues straightest.

use crate::edges::pair;
use crate::lines::LineSegment;
use crate::lines::eye::image::Image;
use crate::lines::eye::pieces::Pieces;
use crate::lines::progress::Progress;
use crate::ranges::{above_zero, clipped, gaps, united, with_gaps};
use crate::tolerances::JOINED_PX;
use glam::DVec2;
use std::collections::HashMap;

/// Distance between the middles of two outline lines, in widths: a third of that distance is free.
const SLIT: f64 = 1.5;

/// Shortest run of the outline, or gap in it, in widths of the outline.
const SHORT_RUN: f64 = 4.0;

/// Pixels. The box of a longer diagonal part overlaps too much.
const LONGEST_PART: f64 = 8.0;

/// Returns the pieces as drawn with an outline of this width, pixels. Hidden pieces stay unchanged.
pub(in crate::lines) fn readable(segments: &[LineSegment], width_px: f64, progress: &Progress) -> Vec<LineSegment> {
    let least_px = SHORT_RUN * width_px;
    let (mut pieces, mut is_outline) = cut_at_slits(segments, [SLIT * width_px, least_px], progress);
    for chain in chains(&pieces, |piece| piece.is_outline) {
        settle(&pieces, &mut is_outline, &chain, least_px, 1, |_| false);
    }
    pieces.iter_mut().zip(&is_outline).for_each(|(piece, is_outline)| piece.is_outline = *is_outline);
    let mut ends = Squares::new(width_px);
    for (number, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.is_outline) {
        piece.ends_px.into_iter().for_each(|px| ends.add(px, number));
    }
    for chain in chains(&pieces, |piece| piece.is_visible) {
        settle(&pieces, &mut is_outline, &chain, least_px, 2, |run| continue_both(&ends, run, &pieces));
    }
    pieces.iter_mut().zip(is_outline).for_each(|(piece, is_outline)| piece.is_outline = is_outline);
    pieces
}

/// Cuts pieces where a slit beside them begins or ends. Returns them and, for each, whether it is outline and borders on no slit.
fn cut_at_slits(
    segments: &[LineSegment],
    [slit_px, least_px]: [f64; 2],
    progress: &Progress,
) -> (Vec<LineSegment>, Vec<bool>) {
    let is_short = short_runs(segments, least_px);
    let image = |segment: &LineSegment| {
        let [a, b] = segment.ends_px;
        Image { a, b, keys: [0.0; 2], noise_px: 0.0 }
    };
    let mut parts = Pieces::default();
    for (number, segment) in segments.iter().enumerate().filter(|(_, segment)| segment.is_outline) {
        let image = image(segment);
        image
            .stretches([0.0, 1.0], LONGEST_PART)
            .for_each(|part| parts.add(image.box_around(part, 0.0, [0.0; 2]), number));
    }
    let tree = parts.tree(progress);
    let (mut pieces, mut is_outline) = (Vec::with_capacity(segments.len()), Vec::with_capacity(segments.len()));
    for (number, segment) in segments.iter().enumerate() {
        let has_no_side = segment.background == [false; 2] || segment.ends_px[0] == segment.ends_px[1];
        if !segment.is_outline || has_no_side {
            pieces.push(segment.clone());
            is_outline.push(segment.is_outline);
            continue;
        }
        let image = image(segment);
        let mut wide: Vec<[f64; 2]> = Vec::new();
        for side in [0, 1].into_iter().filter(|side| segment.background[*side]) {
            let mut narrow: Vec<[f64; 2]> = Vec::new();
            for part in image.stretches([0.0, 1.0], LONGEST_PART) {
                tree.any(&image.box_around(part, slit_px, [0.0; 2]), |other| {
                    let faced = before(&image, side, &segments[other], slit_px);
                    let range = faced.filter(|(_, is_facing)| other != number && (*is_facing || !is_short[other]));
                    narrow.extend(range.map(|(range, _)| range));
                    false
                });
            }
            wide.extend(gaps([0.0, 1.0], &united(narrow)));
        }
        // A very short gap between two successive lines on the other side is no free side.
        wide.retain(|range| (range[1] - range[0]) * image.length() > 4.0 * JOINED_PX || *range == [0.0, 1.0]);
        let wide = united(wide);
        let part = |range: [f64; 2]| {
            // On the line; in perspective only near the place, because the eye is unknown here.
            let world = |place: f64| segment.ends_world[0].lerp(segment.ends_world[1], place);
            let ends_px = range.map(|place| image.at(place));
            LineSegment { ends_px, ends_world: range.map(world), ..segment.clone() }
        };
        let told = with_gaps([0.0, 1.0], &wide);
        pieces.extend(told.iter().map(|(range, _)| part(*range)));
        is_outline.extend(told.iter().map(|(_, is_wide)| *is_wide));
    }
    (pieces, is_outline)
}

/// Returns for each piece of the outline whether its chain is shorter than this.
fn short_runs(segments: &[LineSegment], least_px: f64) -> Vec<bool> {
    let mut is_short = vec![false; segments.len()];
    for Chain { pieces, .. } in chains(segments, |piece| piece.is_outline) {
        let length = |piece: &usize| segments[*piece].ends_px[0].distance(segments[*piece].ends_px[1]);
        let is_short_run = pieces.iter().map(length).sum::<f64>() < least_px;
        pieces.into_iter().for_each(|piece| is_short[piece] = is_short_run);
    }
    is_short
}

/// Returns the range of a line that has another line on its right (0) or left (1), nearer than a distance, and whether the other has
/// background towards it.
fn before(image: &Image, side: usize, other: &LineSegment, distance_px: f64) -> Option<([f64; 2], bool)> {
    let along = (image.b - image.a) / image.length();
    let aside = if side == 0 { along.perp() } else { -along.perp() };
    let [first, second] = other.ends_px.map(|end| DVec2::new(along.dot(end - image.a), aside.dot(end - image.a)));
    // The part of the other line in the strip beside this line.
    let range = above_zero([0.0, 1.0], [first.y - JOINED_PX, second.y - JOINED_PX]);
    let range = clipped(range, [0.0, 1.0], [distance_px - first.y, distance_px - second.y])?;
    let places = range.map(|share| (first.x + (second.x - first.x) * share) / image.length());
    let places = [places[0].min(places[1]).max(0.0), places[0].max(places[1]).min(1.0)];
    let is_along = along.dot(other.ends_px[1] - other.ends_px[0]) > 0.0;
    let is_facing = other.background[if is_along { 1 - side } else { side }];
    ((places[1] - places[0]) * image.length() > JOINED_PX).then_some((places, is_facing))
}

/// Pieces in order: each continues the one before.
struct Chain {
    pieces: Vec<usize>,
    is_closed: bool,
}

/// Most ends in one place that are paired. Where more meet, none continues.
const MOST_ENDS: usize = 16;

/// Returns the chains of the selected pieces. Piece `k` has ends `2k` and `2k + 1`.
fn chains(pieces: &[LineSegment], is_meant: fn(&LineSegment) -> bool) -> Vec<Chain> {
    let partners = partners(pieces, is_meant);
    let mut is_known = vec![false; pieces.len()];
    let mut chains = Vec::new();
    for first in (0..pieces.len()).filter(|piece| is_meant(&pieces[*piece])) {
        if is_known[first] {
            continue;
        }
        let mut begin = first * 2;
        let mut is_closed = false;
        while let Some(partner) = partners[begin] {
            begin = partner ^ 1;
            is_closed = begin == first * 2;
            if is_closed {
                break;
            }
        }
        let mut chain = Chain { pieces: Vec::new(), is_closed };
        let mut next = Some(begin);
        while let Some(end) = next.filter(|end| !is_known[end / 2]) {
            is_known[end / 2] = true;
            chain.pieces.push(end / 2);
            next = partners[end ^ 1];
        }
        chains.push(chain);
    }
    chains
}

/// Returns for each end the end that continues it.
fn partners(pieces: &[LineSegment], is_meant: fn(&LineSegment) -> bool) -> Vec<Option<usize>> {
    let position = |end: usize| pieces[end / 2].ends_px[end % 2];
    let mut partners = vec![None; pieces.len() * 2];
    let ends = (0..pieces.len() * 2).filter(|end| is_meant(&pieces[end / 2]));
    for meeting in meetings(ends, position) {
        if meeting.len() > MOST_ENDS {
            continue;
        }
        let away = |end: usize| (position(end ^ 1) - position(end)).normalize_or_zero();
        let mut pairs: Vec<(bool, f64, usize, usize)> = Vec::new();
        for (index, first) in meeting.iter().enumerate() {
            for second in meeting[index + 1..].iter().filter(|second| **second / 2 != first / 2) {
                let are_outline = pieces[first / 2].is_outline && pieces[second / 2].is_outline;
                pairs.push((!are_outline, away(*first).dot(away(*second)), *first, *second));
            }
        }
        pair(pairs, &mut partners);
    }
    partners
}

/// Points in a grid of squares, each with a number.
struct Squares {
    squares: HashMap<[i64; 2], Vec<(DVec2, usize)>>,
    side_px: f64,
}

impl Squares {
    fn new(side_px: f64) -> Self {
        Self { squares: HashMap::new(), side_px }
    }

    fn square(&self, px: DVec2) -> [i64; 2] {
        (px / self.side_px).floor().as_i64vec2().to_array()
    }

    fn add(&mut self, px: DVec2, number: usize) {
        self.squares.entry(self.square(px)).or_default().push((px, number));
    }

    /// The numbers of the points no farther from a place than a square's side.
    fn near(&self, px: DVec2) -> impl Iterator<Item = usize> {
        let [x, y] = self.square(px);
        let around = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        let points = around.filter_map(|square| self.squares.get(&square)).flatten();
        points.filter(move |(point, _)| point.distance(px) <= self.side_px).map(|(_, number)| *number)
    }
}

/// Groups ends that lie in one place, nearer than [`JOINED_PX`]: a rim may continue as another edge at the same place.
fn meetings(ends: impl Iterator<Item = usize>, position: impl Fn(usize) -> DVec2) -> Vec<Vec<usize>> {
    let (mut places, mut meetings) = (Squares::new(JOINED_PX), Vec::<Vec<usize>>::new());
    for end in ends {
        let px = position(end);
        let known = places.near(px).next();
        match known {
            Some(place) => meetings[place].push(end),
            None => {
                places.add(px, meetings.len());
                meetings.push(vec![end]);
            }
        }
    }
    meetings
}

/// A part of a chain, all outline or all inner line.
struct Run {
    pieces: Vec<usize>,
    length: f64,
    is_outline: bool,
}

/// Whether other pieces of the outline, of whose ends `ends` has the pieces' numbers, end within its width of both ends of a run.
fn continue_both(ends: &Squares, run: &Run, pieces: &[LineSegment]) -> bool {
    let all: Vec<DVec2> = run.pieces.iter().flat_map(|piece| pieces[*piece].ends_px).collect();
    let farthest = |from: DVec2| all.iter().copied().max_by(|a, b| a.distance(from).total_cmp(&b.distance(from)));
    let Some(first) = all.first().and_then(|any| farthest(*any)) else { return false };
    let is_continued = |px: DVec2| ends.near(px).any(|piece| !run.pieces.contains(&piece));
    is_continued(first) && farthest(first).is_some_and(is_continued)
}

/// Gives each run that is too short the class of its neighbours, if it has at least `least_beside` of them. A run of the outline that
/// `stays` keeps its class.
fn settle(
    pieces: &[LineSegment],
    of_pieces: &mut [bool],
    chain: &Chain,
    least_px: f64,
    least_beside: usize,
    stays: impl Fn(&Run) -> bool,
) {
    let mut runs: Vec<Run> = Vec::new();
    for &number in &chain.pieces {
        let (is_outline, [a, b]) = (of_pieces[number], pieces[number].ends_px);
        match runs.last_mut() {
            Some(run) if run.is_outline == is_outline => {
                run.pieces.push(number);
                run.length += a.distance(b);
            }
            _ => runs.push(Run { pieces: vec![number], length: a.distance(b), is_outline }),
        }
    }
    if chain.is_closed && runs.len() > 1 && runs[0].is_outline == runs[runs.len() - 1].is_outline {
        let first = runs.remove(0);
        if let Some(last) = runs.last_mut() {
            last.length += first.length;
            last.pieces.extend(first.pieces);
        }
    }
    loop {
        let count = runs.len();
        let beside = |index: usize| match (count, chain.is_closed) {
            (1, _) => 0,
            (_, true) => 2,
            (_, false) => usize::from(index > 0) + usize::from(index + 1 < count),
        };
        let may_change = |index: &usize| {
            let run = &runs[*index];
            run.length < least_px && beside(*index) >= least_beside && !(run.is_outline && stays(run))
        };
        let shortest = (0..count).filter(may_change);
        let Some(index) = shortest.min_by(|a, b| runs[*a].length.total_cmp(&runs[*b].length)) else { break };
        // The run and its neighbours become one; in a ring, across its end, too.
        if chain.is_closed {
            runs.rotate_left((index + count - 1) % count);
        }
        let index = if chain.is_closed { 1 } else { index };
        let joined = index.saturating_sub(1)..(index + 2).min(count);
        let is_outline = !runs[index].is_outline;
        let mut run = Run { pieces: Vec::new(), length: 0.0, is_outline };
        for other in runs.drain(joined.clone()) {
            run.length += other.length;
            run.pieces.extend(other.pieces);
        }
        runs.insert(joined.start, run);
    }
    for run in runs {
        run.pieces.iter().for_each(|piece| of_pieces[*piece] = run.is_outline);
    }
}
