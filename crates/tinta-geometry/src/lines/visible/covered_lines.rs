//! The lines that a drawing leaves out, because it draws another line that overlaps them in their place: hidden lines, those of
//! ghosts, which no face of their own hides, and the strokes of a cut seen edge-on.
//!
//! In: pieces of lines. Out: the same pieces, those lines cut where such a line begins or ends, and marked. A visible line replaces
//! every hidden one under it, and one of a solid part every ghost's and every stroke of a cut, except that curves and points replace
//! no line of a surface. Of hidden lines, of ghosts' and of strokes, the one of the first class stays, and within one class the first. Lines overlap up to [`JOINED_PX`], which a file of three decimals barely resolves. Trees of visible and of hidden lines find the
//! candidates. The search for a line ends when it is covered as a whole.

use crate::edges::ClassSet;
use crate::error::Result;
use crate::lines::LineSegment;
use crate::lines::eye::image::Image;
use crate::lines::eye::pieces::{PieceTree, Pieces};
use crate::lines::eye::space::Space;
use crate::lines::parts::scene_parts::SceneParts;
use crate::lines::progress::Progress;
use crate::ranges::with_gaps;
use crate::threads::{cores, in_chunks};
use crate::tolerances::JOINED_PX;

/// All of a line.
const WHOLE: [f64; 2] = [0.0, 1.0];

/// Hidden lines that a thread tests at once.
const CHUNK: usize = 512;

/// Cuts and marks hidden pieces, strokes of a cut, and those that are ghosts'.
///
/// # Errors
///
/// Those of [`Progress::go_on`].
pub(in crate::lines) fn marked(
    segments: Vec<LineSegment>,
    scene_parts: &SceneParts,
    space: &Space,
    progress: &Progress,
) -> Result<Vec<LineSegment>> {
    let rank = |segment: &LineSegment| match segment.is_visible {
        true if is_free(segment) && scene_parts.is_of_cut(segment.part) => Rank::Stroke,
        true if is_free(segment) || !scene_parts.may_be_of_ghost(segment) => Rank::Solid,
        true => Rank::Ghost,
        false => Rank::Hidden,
    };
    let ranks: Vec<Rank> = segments.iter().map(rank).collect();
    if ranks.iter().all(|rank| *rank == Rank::Solid) {
        return Ok(segments);
    }
    let images: Vec<Image> = segments.iter().map(|segment| image_of(space, segment)).collect();
    let tree = |is_visible: bool| {
        let mut stretches = Pieces::default();
        for (number, image) in
            images.iter().enumerate().filter(|(number, _)| segments[*number].is_visible == is_visible)
        {
            for directions in image.directions(JOINED_PX) {
                stretches.add(image.box_around(WHOLE, 0.0, directions), number);
            }
        }
        stretches.tree(progress)
    };
    let lines = LinesAbove { segments: &segments, ranks: &ranks, images: &images, trees: [tree(true), tree(false)] };
    let covered = in_chunks(segments.len(), CHUNK, cores(), |range| {
        let covered = |number: usize| match ranks[number] == Rank::Solid || progress.is_over() {
            true => Vec::new(),
            false => lines.covered(number),
        };
        range.map(covered).collect::<Vec<_>>()
    });
    progress.go_on()?;
    let all = segments.iter().zip(&images).zip(covered.into_iter().flatten());
    Ok(all.flat_map(|((segment, image), covered)| cut(space, segment, image, &covered)).collect())
}

/// Which lines replace others where they overlap: those of the lower rank.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Rank {
    /// Visible lines of parts that hide others, and curves and points. None replaces another.
    Solid,
    /// Visible strokes of a cut.
    Stroke,
    /// Visible lines of ghosts.
    Ghost,
    Hidden,
}

fn is_free(segment: &LineSegment) -> bool {
    ClassSet::FREE.contains(segment.class)
}

/// The image of a piece.
fn image_of(space: &Space, segment: &LineSegment) -> Image {
    let [a, b] = segment.ends_px;
    let keys = segment.ends_world.map(|end| space.project(space.view(end)).1);
    Image { a, b, keys, noise_px: 0.0 }
}

/// Pieces with the trees of visible and of hidden ones.
struct LinesAbove<'a> {
    segments: &'a [LineSegment],
    ranks: &'a [Rank],
    images: &'a [Image],
    trees: [PieceTree; 2],
}

impl LinesAbove<'_> {
    /// Returns the ranges of a line under lines that are drawn in its place, ascending.
    fn covered(&self, number: usize) -> Vec<[f64; 2]> {
        let image = &self.images[number];
        let tolerance = JOINED_PX / image.length();
        let mut covered: Vec<[f64; 2]> = Vec::new();
        for tree in &self.trees {
            let mut found = |other: usize| {
                let lies_on_it = || image.overlap(&self.images[other], JOINED_PX);
                if let Some(range) = self.comes_before(other, number).then(lies_on_it).flatten() {
                    covered = joined(std::mem::take(&mut covered), range, tolerance);
                }
                covered == [WHOLE]
            };
            let mut directions = image.directions(JOINED_PX);
            if directions.any(|directions| tree.any(&image.box_around(WHOLE, JOINED_PX, directions), &mut found)) {
                return covered;
            }
        }
        covered
    }

    /// Whether a line is drawn in place of another that it overlaps.
    fn comes_before(&self, other: usize, number: usize) -> bool {
        if is_free(&self.segments[other]) && !is_free(&self.segments[number]) {
            return false;
        }
        let rank = |number: usize| (self.ranks[number], self.segments[number].class, number);
        rank(other) < rank(number)
    }
}

/// Adds a range to ascending ones. Joins ranges no farther apart than `tolerance`, and extends to the line's ends where these are
/// near.
fn joined(ranges: Vec<[f64; 2]>, [from, to]: [f64; 2], tolerance: f64) -> Vec<[f64; 2]> {
    let from = if from <= tolerance { 0.0 } else { from };
    let to = if to >= 1.0 - tolerance { 1.0 } else { to };
    let mut joined: Vec<[f64; 2]> = Vec::with_capacity(ranges.len() + 1);
    let mut new = [from, to];
    for range in ranges {
        if range[0] <= new[1] + tolerance && new[0] <= range[1] + tolerance {
            new = [new[0].min(range[0]), new[1].max(range[1])];
        } else {
            joined.push(range);
        }
    }
    let place = joined.partition_point(|range| range[0] < new[0]);
    joined.insert(place, new);
    joined
}

/// Cuts a piece into stretches that are covered as a whole or not at all, along it.
fn cut(space: &Space, segment: &LineSegment, image: &Image, covered: &[[f64; 2]]) -> Vec<LineSegment> {
    let stretch = |range: [f64; 2], is_covered: bool| {
        let (px, world) = (range.map(|place| image.at(place)), image.ends_world(space, range));
        // A piece's own ends stay bit for bit.
        let is_own = [range[0] == 0.0, range[1] == 1.0];
        let end = |end: usize| if is_own[end] { segment.ends_world[end] } else { world[end] };
        LineSegment { is_covered, ends_px: px, ends_world: [end(0), end(1)], ..segment.clone() }
    };
    with_gaps(WHOLE, covered).into_iter().map(|(range, is_covered)| stretch(range, is_covered)).collect()
}
