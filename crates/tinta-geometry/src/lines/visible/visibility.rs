//! Which parts of the lines are seen: cuts wherever that can change, then one ray for each piece.
//!
//! Three questions use one rule, [`Image::overlap`]: which lines lie on one another in the picture. They are cut where one of
//! them ends and where both are equally near; the nearest is drawn; of equally near ones, one.

use crate::bvh::{counting_steps, steps};
use crate::lines::eye::image::Image;
use crate::lines::progress::{Phase, Progress};
use crate::lines::segment::LineSegment;
use crate::lines::visible::cover::Cover;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::SearchDepth;
use crate::lines::visible::overlapping_lines::OverlappingLines;
use crate::ranges::gaps;
use crate::threads::{cores, spread_chunks};

/// Pieces of one line between two looks at the time.
const PIECES_A_GLANCE: usize = 64;

impl LineIndex<'_> {
    /// The wanted lines' pieces, in the lines' order; with the count of tested boxes. Some are missing if the time runs out.
    pub(in crate::lines) fn segments(&self, progress: &Progress) -> (Vec<LineSegment>, u64) {
        /// Few: of any part of the time the lines done represent the rest.
        const LINES: usize = 16;
        progress.begin(Phase::Lines, self.features.len());
        // Not one after the other: what is left then takes as long as what is done.
        let chunks = spread_chunks(self.features.len(), LINES, cores(), |range| {
            counting_steps(|| {
                let mut segments = Vec::new();
                for index in range {
                    if progress.is_over() {
                        break;
                    }
                    let before = steps();
                    let pieces = self.decided(index, progress).into_iter();
                    segments.extend(pieces.flat_map(|piece| self.segments_of(index, piece)));
                    progress.advance(1, steps().wrapping_sub(before));
                }
                segments
            })
        });
        let compared = chunks.iter().map(|(_, steps)| steps).sum();
        let mut segments = Vec::with_capacity(chunks.iter().map(|(segments, _)| segments.len()).sum());
        chunks.into_iter().for_each(|(some, _)| segments.extend(some));
        (segments, compared)
    }

    /// The pieces of a wanted line: the visible ones, and if wanted the rest as hidden ones; none if the time runs out.
    pub(in crate::lines) fn decided(&self, index: usize, progress: &Progress) -> Vec<Interval> {
        let Some((image, inside)) = self.wanted(index) else { return Vec::new() };
        let overlapping = match self.features[index].overlaps() {
            true => OverlappingLines::new(index, &image, inside),
            false => OverlappingLines::none(index, &image, inside),
        };
        let visible = self.visible(index, &image, inside, &overlapping, progress);
        if !self.finds_hidden {
            return visible;
        }
        let seen: Vec<[f64; 2]> = visible.iter().map(|piece| [piece.from, piece.to]).collect();
        let rest = gaps(inside, &seen).into_iter().take_while(|_| !progress.is_over());
        let hidden = rest.flat_map(|gap| self.hidden(index, &image, gap, &overlapping));
        let mut pieces: Vec<Interval> = visible.iter().copied().chain(hidden).collect();
        pieces.sort_by(|one, other| one.from.total_cmp(&other.from));
        pieces
    }

    /// The visible pieces of a line; none if the time runs out.
    fn visible(
        &self,
        index: usize,
        image: &Image,
        inside: [f64; 2],
        overlapping: &OverlappingLines,
        progress: &Progress,
    ) -> Vec<Interval> {
        let behind = self.behind_nearest(index, image, inside);
        let mut cuts = Vec::new();
        let mut cover = self.unknown_cover(inside, &behind);
        // Of a line that nothing cuts, one ray decides all.
        if cover.open.iter().any(|gap| self.add_cuts(index, image, overlapping, *gap, true, &mut cuts)) {
            cuts.clear();
            cover = self.cover(index, image, inside, &behind, SearchDepth::Nearer, 0.0);
            let mut hidden = Vec::new();
            for gap in &cover.open {
                self.behind_overlapping_lines(index, image, overlapping, *gap, &mut hidden);
            }
            cover = self.hide_all(cover, image, hidden);
            for gap in &cover.open {
                self.add_cuts(index, image, overlapping, *gap, false, &mut cuts);
            }
        }
        let mut pieces: Vec<Interval> = Vec::new();
        if cover.open.is_empty() {
            return pieces;
        }
        self.add_piercings(index, image, &mut cuts);
        for (number, place) in self.places(image, inside, cuts).windows(2).enumerate() {
            if number % PIECES_A_GLANCE == PIECES_A_GLANCE - 1 && progress.is_over() {
                return Vec::new();
            }
            let [from, to] = [place[0], place[1]];
            let place = (from + to) * 0.5;
            if !cover.hides(place) && self.is_seen(index, image, overlapping, place, &cover) {
                Interval { from, to, is_visible: true, background: [false; 2] }.add_to(&mut pieces);
            }
        }
        pieces
    }

    /// The hidden pieces of a stretch of which nothing is visible: all but what another line in the same place stands for.
    fn hidden(&self, index: usize, image: &Image, stretch: [f64; 2], overlapping: &OverlappingLines) -> Vec<Interval> {
        let (mut cuts, mut pieces) = (Vec::new(), Vec::new());
        self.add_overlaps(index, image, overlapping, stretch, [false, true], &mut cuts);
        for place in self.places(image, stretch, cuts).windows(2) {
            let [from, to] = [place[0], place[1]];
            let stands_for_itself = || self.is_nearest(index, image, overlapping, (from + to) * 0.5, true).is_some();
            if overlapping.are_none(self) || stands_for_itself() {
                Interval { from, to, is_visible: false, background: [false; 2] }.add_to(&mut pieces);
            }
        }
        pieces
    }

    /// A piece of a wanted line as segments: one, or several where the outline begins and ends.
    pub(in crate::lines) fn segments_of(&self, index: usize, piece: Interval) -> Vec<LineSegment> {
        let feature = &self.features[index];
        let (Some(class), Some(image)) = (feature.class, self.images[index]) else { return Vec::new() };
        let segment = |piece: Interval| LineSegment {
            edge: feature.edge,
            angle_degrees: feature.angle_degrees,
            object: feature.object,
            part: feature.part,
            ..piece.segment(class, &image, self.ends_world(index, &image, [piece.from, piece.to]))
        };
        match self.finds_outline && piece.is_visible && feature.overlaps() {
            true => self.with_outline(index, &image, piece).into_iter().map(segment).collect(),
            false => vec![segment(piece)],
        }
    }

    /// Whether a line is seen at a place that is not hidden for sure, and no line in the same place stands for it.
    fn is_seen(&self, index: usize, image: &Image, overlapping: &OverlappingLines, place: f64, cover: &Cover) -> bool {
        let is_nearest =
            || overlapping.are_none(self) || self.is_nearest(index, image, overlapping, place, false) == Some(true);
        let leave_open = || {
            let (probe, planes) = (self.probe(index, image, place), self.features[index].planes);
            self.faces.leave_open(self.space, &probe, |column, visit| self.any_occluder(column, planes, visit))
        };
        is_nearest() && (cover.leaves_open(place) || leave_open())
    }
}
