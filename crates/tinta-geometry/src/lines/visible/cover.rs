//! Which parts of a line faces hide for sure, and which they may hide: one walk of the faces' tree from front to back.

use crate::bvh::{Exclusion, Ray3, Walk};
use crate::lines::visible::face_image::FaceImage;
use crate::lines::visible::image::Image;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::{OccluderProbe, ProbedLine, SearchDepth};
use crate::lines::visible::ranges::{gaps, hold, united};
use obvhs::aabb::Aabb;

/// Which parts of a line are hidden.
#[derive(Default)]
pub(in crate::lines) struct Cover {
    /// Ascending parts that are hidden for sure.
    pub hidden: Vec<[f64; 2]>,
    /// Ascending parts of the others in which something may hide the line.
    pub maybe: Vec<[f64; 2]>,
    /// Ascending parts that are not hidden for sure.
    pub open: Vec<[f64; 2]>,
}

impl Cover {
    /// Whether a place is hidden for sure.
    pub(in crate::lines) fn hides(&self, place: f64) -> bool {
        hold(&self.hidden, place)
    }

    /// Whether a place is seen for sure, as far as faces are concerned.
    pub(in crate::lines) fn leaves_open(&self, place: f64) -> bool {
        !hold(&self.maybe, place)
    }

    /// Hides a part more.
    pub(in crate::lines) fn hide(&mut self, part: [f64; 2], least: f64) {
        self.hidden.push(part);
        let mut open = Vec::with_capacity(self.open.len() + 1);
        for gap in self.open.drain(..) {
            if part[1] <= gap[0] || part[0] >= gap[1] {
                open.push(gap);
                continue;
            }
            let rest = [[gap[0], part[0]], [part[1], gap[1]]];
            open.extend(rest.into_iter().filter(|rest| rest[1] - rest[0] > least));
        }
        self.open = open;
    }
}

static NOSEED: std::sync::LazyLock<bool> = std::sync::LazyLock::new(|| std::env::var("NOSEED").is_ok());
/// The walk of one line.
struct CoverWalk<'a> {
    lines: &'a LineIndex<'a>,
    ray: Ray3,
    probe: OccluderProbe,
    cover: Cover,
    least: f64,
    /// Faces looked at lately: a large face comes in parts.
    known: [u32; 256],
    is_short: bool,
}

/// Whether any of a few ranges meets another.
fn meets(ranges: &[[f64; 2]], [from, to]: [f64; 2]) -> bool {
    ranges.iter().any(|range| range[0] <= to && range[1] >= from)
}

impl Walk for CoverWalk<'_> {
    fn enters(&self, around: &Aabb) -> bool {
        self.ray.is_near(around)
            && (self.is_short && self.cover.hidden.is_empty()
                || self.ray.range(around).is_some_and(|range| meets(&self.cover.open, range)))
    }

    fn visit(&mut self, face: u32) -> bool {
        let numbers = self.lines.faces.triangles[face as usize];
        if self.probe.holds(numbers) {
            return false;
        }
        let known = &mut self.known[face as usize % 256];
        if std::mem::replace(known, face) == face {
            return false;
        }
        let [sure, may] = self.lines.hidden_ranges(face, &self.probe);
        if let Some(sure) = sure {
            self.cover.hide(sure, self.least);
        }
        self.cover.maybe.extend(may);
        self.cover.open.is_empty()
    }
}

impl LineIndex<'_> {
    /// Which parts of a line between two places faces hide; some of which is known to be hidden.
    pub(in crate::lines) fn cover(
        &self,
        index: usize,
        image: &Image,
        inside: [f64; 2],
        hidden: Vec<[f64; 2]>,
        search_depth: SearchDepth,
    ) -> Cover {
        let least = self.shortest_px / image.length();
        let is_long = |gap: &[f64; 2]| *gap == inside || gap[1] - gap[0] > least;
        let open: Vec<[f64; 2]> = gaps(inside, &hidden).into_iter().filter(is_long).collect();
        let mut cover = Cover { hidden, open, maybe: Vec::new() };
        if let Some(nearest_faces) = self.nearest_faces.filter(|_| !*NOSEED) {
            for gap in std::mem::take(&mut cover.open) {
                cover.open.push(gap);
                let probe = |part| {
                    let feature = &self.features[index];
                    let line = ProbedLine { own: feature.own, ends: feature.ends, weld: feature.weld };
                    OccluderProbe::new(self.space, self.faces, line, image, part, search_depth)
                };
                for part in nearest_faces.hidden(self.space, self.faces, gap, probe, 4) {
                    cover.hide(part, least);
                }
            }
        }
        if !cover.open.is_empty() {
            let feature = &self.features[index];
            let line = ProbedLine { own: feature.own, ends: feature.ends, weld: feature.weld };
            let probe = OccluderProbe::new(self.space, self.faces, line, image, inside, search_depth);
            let ray = self.ray(image, search_depth, 0.0);
            let is_short = image.length() * 16.0 < self.space.size.max_element();
            let mut walk = CoverWalk { lines: self, ray, probe, cover, least, known: [u32::MAX; 256], is_short };
            match &self.occluders {
                Some(occluders) => occluders.walk(Exclusion::planes(feature.planes), &mut walk),
                None => self.faces.tree.walk(Exclusion::planes(feature.planes), &mut walk),
            }
            cover = walk.cover;
        }
        cover.hidden = united(cover.hidden);
        cover.maybe = united(cover.maybe);
        cover
    }

    /// A line as boxes are asked about it: of all that begins at most `slack` behind it, or of all.
    pub(in crate::lines) fn ray(&self, image: &Image, search_depth: SearchDepth, slack: f64) -> Ray3 {
        let keys = match search_depth {
            SearchDepth::Nearer => image.keys,
            SearchDepth::Any => [1e300; 2],
        };
        let ends = [image.a.extend(keys[0]), image.b.extend(keys[1])];
        Ray3::new(ends, image.touch_px(self.space), slack)
    }

    /// What of a part of a line a face hides for sure, on both sides, and what it may hide.
    fn hidden_ranges(&self, face: u32, probe: &OccluderProbe) -> [Option<[f64; 2]>; 2] {
        match self.nearest_faces {
            Some(nearest_faces) => {
                self.faces.hidden_ranges(self.space, face, &nearest_faces.image(self.space, self.faces, face), probe)
            }
            None => {
                let points = self.faces.corners(face).map(|corner| self.space.project(corner).0);
                let is_cut = !self.faces.cut_by_near.is_empty();
                if !is_cut && probe.is_beside(points) {
                    return [None; 2];
                }
                self.faces.hidden_ranges(self.space, face, &FaceImage::of(self.space, self.faces, face), probe)
            }
        }
    }
}

/// Calls a function with each thing whose box a part of a line enters, until that returns true.
pub(in crate::lines) struct PartWalk<F> {
    pub ray: Ray3,
    pub part: [f64; 2],
    pub visit: F,
    pub is_found: bool,
}

impl<F: FnMut(u32) -> bool> Walk for PartWalk<F> {
    fn enters(&self, around: &Aabb) -> bool {
        self.ray.is_near(around) && self.ray.range(around).is_some_and(|range| meets(&[self.part], range))
    }

    fn visit(&mut self, place: u32) -> bool {
        self.is_found = (self.visit)(place);
        self.is_found
    }
}
