//! The stretches of a line that faces hide for sure, and those that they may hide: one walk of the tree of faces, front to back.
//!
//! The walk keeps the stretches of the line that no face hides yet, and enters only boxes that one of these stretches reaches. Each face
//! in them answers with two ranges ([`Faces::hidden_ranges`](crate::lines::eye::faces::Faces)): where it hides the line by
//! more than any tolerance, and where it may hide it. The walk ends with the last such stretch. Only the stretches that a face may hide
//! need a ray and the exact rules.

use crate::bvh::{Box3, Exclusion, Line3, NO_GROUP, Walk};
use crate::lines::eye::image::Image;
use crate::lines::eye::projected_face::ProjectedFace;
use crate::lines::eye::touch::key_slack;
use crate::lines::input::feature::Own;
use crate::lines::visible::contact::ProbedLine;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::{OccluderProbe, SearchDepth};
use crate::ranges::{gaps, hold, meet, united};
use crate::thresholds::THRESHOLDS;

/// The stretches of a line that are hidden, and those that may be.
#[derive(Default)]
pub(in crate::lines) struct Cover {
    /// The stretches that are hidden for sure.
    hidden: Vec<[f64; 2]>,
    /// The stretches that something may hide.
    maybe: Vec<[f64; 2]>,
    /// Ascending stretches that are not hidden for sure.
    pub open: Vec<[f64; 2]>,
    /// In place of `maybe` of a search at any depth: the faces that may hide a stretch, each with it, perhaps several times.
    pub faces: Vec<(u32, [f64; 2])>,
}

impl Cover {
    /// Whether a place is hidden for sure.
    pub(in crate::lines) fn hides(&self, place: f64) -> bool {
        hold(&self.hidden, place)
    }

    /// Whether no face hides a place, for sure. Unknown in rests too short to be open: the walk may end before it meets their
    /// faces.
    pub(in crate::lines) fn leaves_open(&self, place: f64) -> bool {
        hold(&self.open, place) && !hold(&self.maybe, place)
    }

    /// Hides another stretch. Remaining stretches no longer than `least` are no longer open.
    fn hide(&mut self, stretch: [f64; 2], least: f64) {
        self.hidden.push(stretch);
        let is_outside = |gap: &[f64; 2]| stretch[1] <= gap[0] || stretch[0] >= gap[1];
        if self.open.iter().all(is_outside) {
            return;
        }
        let rest_of = |gap: [f64; 2]| match is_outside(&gap) {
            true => [Some(gap), None],
            false => [[gap[0], stretch[0]], [stretch[1], gap[1]]]
                .map(|rest| Some(rest).filter(|rest| rest[1] - rest[0] > least)),
        };
        self.open = std::mem::take(&mut self.open).into_iter().flat_map(rest_of).flatten().collect();
    }

    /// Sorts the ranges for lookup.
    fn sorted(self) -> Self {
        Self { hidden: united(self.hidden), maybe: united(self.maybe), ..self }
    }
}

/// The walk for one line.
struct CoverWalk<'a> {
    lines: &'a LineIndex<'a>,
    line: Line3,
    probe: OccluderProbe,
    cover: Cover,
    least: f64,
    enough: f64,
    remembered: [Option<u32>; THRESHOLDS.remembered],
}

impl Walk for CoverWalk<'_> {
    fn enters(&self, around: &Box3) -> bool {
        if !self.line.is_near(around) {
            return false;
        }
        self.line.range(around).is_some_and(|range| self.cover.open.iter().any(|open| meet(*open, range)))
    }

    fn visit(&mut self, face: u32) -> bool {
        let remembered = &mut self.remembered[face as usize % THRESHOLDS.remembered];
        if self.probe.line.own_corners(self.lines.faces, face).is_none() || remembered.replace(face) == Some(face) {
            return false;
        }
        let [sure, may] = self.lines.hidden_ranges(face, &self.probe);
        if let Some(sure) = sure {
            self.cover.hide(sure, self.least);
        }
        match self.probe.is_nearer_sought {
            true => self.cover.maybe.extend(may),
            false => self.cover.faces.extend(may.map(|may| (face, may))),
        }
        self.cover.open.iter().all(|gap| gap[1] - gap[0] <= self.enough)
    }
}

impl LineIndex<'_> {
    /// Returns the cover of a line before any test: any face may hide it. Some stretches are known to be hidden.
    pub(in crate::lines) fn unknown_cover(&self, inside: [f64; 2], hidden: &[[f64; 2]]) -> Cover {
        Cover { hidden: hidden.to_vec(), maybe: vec![inside], open: gaps(inside, hidden), ..Cover::default() }
    }

    /// Returns the cover of a line between two places. Some stretches are known to be hidden. The search ends where no open stretch is
    /// longer than `enough`.
    pub(in crate::lines) fn cover(
        &self,
        index: usize,
        image: &Image,
        inside: [f64; 2],
        hidden: &[[f64; 2]],
        search_depth: SearchDepth,
        enough: f64,
    ) -> Cover {
        let least = self.shortest_px / image.length();
        let is_long = |gap: &[f64; 2]| *gap == inside || gap[1] - gap[0] > least;
        let open: Vec<[f64; 2]> = gaps(inside, hidden).into_iter().filter(is_long).collect();
        let cover = Cover { hidden: hidden.to_vec(), open, ..Cover::default() };
        if cover.open.is_empty() {
            return cover.sorted();
        }
        let feature = &self.features[index];
        // A line's own faces hide it nowhere, but they lie beside it.
        let (own, planes) = match search_depth {
            SearchDepth::Nearer => (feature.own, feature.planes),
            SearchDepth::Any => (Own::Free, [NO_GROUP; 2]),
        };
        let line = ProbedLine::new(self.faces, own, feature.ends, feature.weld);
        // A face that the line ends on may lie a little behind one of its ends.
        let slack = key_slack(image.keys[0]).max(key_slack(image.keys[1]));
        let mut walk = CoverWalk {
            lines: self,
            line: self.line(image, search_depth, slack),
            probe: OccluderProbe::new(self.space, (line, feature.ends), image, inside, search_depth),
            cover,
            least,
            enough,
            remembered: [None; THRESHOLDS.remembered],
        };
        self.walk_occluders(Exclusion::planes(planes), &mut walk);
        walk.cover.sorted()
    }

    /// Hides the stretches of a line that lie in the picture on nearer lines.
    pub(in crate::lines) fn hide_all(&self, cover: Cover, image: &Image, hidden: Vec<[f64; 2]>) -> Cover {
        let mut cover = cover;
        hidden.into_iter().for_each(|stretch| cover.hide(stretch, self.shortest_px / image.length()));
        cover.sorted()
    }

    /// Returns the line for tests against boxes: those that begin at most `slack` behind it count, or all at any depth.
    pub(in crate::lines) fn line(&self, image: &Image, search_depth: SearchDepth, slack: f64) -> Line3 {
        /// Behind everything.
        const FARTHEST: f64 = 1e300;
        let keys = if search_depth == SearchDepth::Any { [FARTHEST; 2] } else { image.keys };
        Line3::new([image.a.extend(keys[0]), image.b.extend(keys[1])], image.touch_px(self.space), slack)
    }

    /// The stretch of a line that a face hides for sure, on both sides, and the stretch that it may hide.
    fn hidden_ranges(&self, face: u32, probe: &OccluderProbe) -> [Option<[f64; 2]>; 2] {
        // Most faces lie beside the line. This test is the cheapest.
        let points = self.faces.corners(face).map(|corner| self.space.project(corner).0);
        if self.faces.cut_by_near.is_empty() && probe.is_beside(self.space, points) {
            return [None; 2];
        }
        self.faces.hidden_ranges(self.space, face, &ProjectedFace::of(self.space, self.faces, face), probe)
    }
}
