//! The visible lines by the rules alone: no hierarchy, pyramid, cache or shortcut decides anything here. The fast search must find
//! the same; this is where to read what it computes, and what it is tested against.
//!
//! Every wanted line is decided on its own, in three steps:
//!
//! 1. *Cuts*. The visibility of a line can change only where the image of an edge at which a surface ends crosses it, where it passes
//!    through a face, and where the image of another line that lies on it begins, ends, or is as near. It is cut at all these places.
//! 2. *Faces*. In the middle of a piece each face of the scene is tested ([`Faces::hides`](crate::lines::eye::faces::Faces::hides)):
//!    the piece is hidden where faces hide both of its sides.
//! 3. *Lines*. Of the lines that lie on a piece the nearest is seen. Of lines that coincide in space one stands for all.
//!
//! The geometric rules themselves are those of the fast search. So are the intersections of faces, and the outline of what is seen.

use crate::error::Result;
use crate::lines::eye::image::Image;
use crate::lines::eye::touch::piercing;
use crate::lines::input::feature::{Feature, Own};
use crate::lines::progress::{Phase, Progress};
use crate::lines::segment::LineSegment;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::overlapping_lines::OverlappingLines;

impl LineIndex<'_> {
    /// The wanted lines' pieces, in the lines' order.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`].
    pub(in crate::lines) fn segments_by_rules(
        &self,
        finds_hidden: bool,
        progress: &Progress,
    ) -> Result<Vec<LineSegment>> {
        progress.begin(Phase::Lines, self.features.len());
        let mut segments = Vec::new();
        for index in 0..self.features.len() {
            progress.go_on()?;
            let wanted = self.pieces(index).into_iter().filter(|piece| piece.is_visible || finds_hidden);
            segments.extend(wanted.flat_map(|piece| self.segments_of(index, piece)));
            progress.advance(1, 0);
        }
        Ok(segments)
    }

    /// The pieces of a wanted line, each visible or hidden as a whole. What another line in the same place stands for is none.
    pub(in crate::lines) fn pieces(&self, index: usize) -> Vec<Interval> {
        let Some((image, inside)) = self.wanted(index) else { return Vec::new() };
        let overlapping = self.all_lying_on(index, &image);
        let mut pieces: Vec<Interval> = Vec::new();
        for place in self.places(&image, inside, self.all_cuts(index, &image)).windows(2) {
            let [from, to] = [place[0], place[1]];
            let middle = (from + to) * 0.5;
            let Some(is_visible) = self.is_visible(index, &image, &overlapping, middle) else { continue };
            Interval { from, to, is_visible, background: [false; 2] }.add_to(&mut pieces);
        }
        pieces
    }

    /// Step 1: all places where the visibility of a line may change, in no order. One too many does no harm.
    fn all_cuts(&self, index: usize, image: &Image) -> Vec<f64> {
        let feature = &self.features[index];
        let mut cuts = Vec::new();
        for (other, other_image) in self.others(index) {
            let occludes = other.occludes && !feature.own.meets(other.own);
            self.add_crossings(image, other_image, occludes, &mut cuts);
        }
        match feature.own {
            // An edge passes through a face where the intersections say so: what only touches a face is not cut.
            Own::Edge(_) => self.add_piercings(index, image, &mut cuts),
            Own::Faces(_) | Own::Free => {
                let is_own = |face: &u32| matches!(feature.own, Own::Faces(own) if own.contains(face));
                let passed = self.all_faces().filter(|face| !is_own(face));
                let points = passed.filter_map(|face| piercing(feature.ends, self.faces.corners(face)));
                cuts.extend(points.map(|point| image.place_of(self.space.project(point).0)));
            }
        }
        cuts
    }

    /// Steps 2 and 3: whether a line is seen at a place; `None` where another line in the same place stands for both.
    pub(in crate::lines) fn is_visible(
        &self,
        index: usize,
        image: &Image,
        overlapping: &OverlappingLines,
        place: f64,
    ) -> Option<bool> {
        let probe = self.probe(index, image, place);
        let is_nearest = self.is_nearest(index, image, overlapping, place, true)?;
        Some(is_nearest && self.faces.leave_open(self.space, &probe, |_, hides| self.all_faces().any(hides)))
    }

    /// The wanted lines that lie on one at a place and are as near to the eye or nearer, each with how much nearer it is in depth.
    pub(in crate::lines) fn nearer_lines(&self, index: usize, image: &Image, place: f64) -> Vec<(usize, f64)> {
        let (px, depth) = (image.at(place), self.space.depth_of_key(image.key(place)));
        let nearer = |other: usize| {
            let overlap = self.features[other].overlaps() && self.features[index].overlaps();
            let (other_image, _) = self.wanted(other).filter(|_| other != index && overlap)?;
            let range = image.lies_on(&other_image, self.space)?;
            let key = other_image.key(other_image.place_of(px).clamp(0.0, 1.0));
            let in_front = depth - self.space.depth_of_key(key);
            let touches = in_front.abs() <= self.contact(index, other);
            let stands_for_both = (self.features[other].class, other) < (self.features[index].class, index);
            ((range[0]..=range[1]).contains(&place) && if touches { stands_for_both } else { in_front > 0.0 })
                .then_some((other, if touches { 0.0 } else { in_front }))
        };
        (0..self.features.len()).filter_map(nearer).collect()
    }

    /// The wanted lines that lie on one somewhere in the picture.
    pub(in crate::lines) fn all_lying_on(&self, index: usize, image: &Image) -> OverlappingLines {
        let lies_on_it = |other: &usize| {
            let Some(other_image) = self.images[*other].filter(|_| *other != index) else { return false };
            let overlap = self.features[*other].overlaps() && self.features[index].overlaps();
            overlap && image.lies_on(&other_image, self.space).is_some()
        };
        let lying_on = (0..self.features.len()).filter(lies_on_it).collect();
        OverlappingLines::new(index, image, [0.0, 1.0]).known(lying_on)
    }

    fn others(&self, index: usize) -> impl Iterator<Item = (&Feature, &Image)> {
        let all = self.features.iter().zip(&self.images).enumerate();
        let is_other = move |other: usize, feature: &Feature| other != index && feature.own != Own::Free;
        all.filter(move |(other, (feature, _))| is_other(*other, feature))
            .filter_map(|(_, (other, image))| Some((other, image.as_ref()?)))
    }

    /// Every face that is in the picture.
    pub(in crate::lines) fn all_faces(&self) -> std::ops::Range<u32> {
        0..self.faces.triangles.len() as u32
    }
}
