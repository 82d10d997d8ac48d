//! The stretches of a line that single faces hide for sure, and those that they may hide.
//!
//! Plain linear equations decide both. The exact rules decide the rest; where the equations are sure, the exact rules agree.

use crate::lines::eye::faces::Faces;
use crate::lines::eye::image::Image;
use crate::lines::eye::projected_face::ProjectedFace;
use crate::lines::eye::space::Space;
use crate::lines::input::feature::Own;
use crate::lines::visible::contact::{Contact, ProbedLine};
use crate::ranges::{above_zero, clipped, common};
use crate::tolerances::{IMAGE_ROUNDING, TIP};
use glam::{DVec2, DVec3};

/// The depths at which a search finds faces.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::lines) enum SearchDepth {
    /// Faces nearer to the eye.
    Nearer,
    /// Faces at any depth.
    Any,
}

/// A stretch of a line, to find the faces that hide it.
pub(in crate::lines) struct OccluderProbe {
    stretch: [f64; 2],
    pub px: [DVec2; 2],
    /// In the eye's space.
    view: [DVec3; 2],
    pub line: ProbedLine,
    /// The distance from the stretch's ends within which any hidden range reaches them, shares of the line.
    tips: [f64; 2],
    touch_px: f64,
    /// How far rounding may move a point, pixels.
    noise_px: f64,
    pub is_nearer_sought: bool,
}

impl Own {
    /// Returns the distance from the line's end within which a hidden range reaches the end, a share of the length. An
    /// intersection ends where an edge passes through a face, often in a plane that holds other faces, too. None of these hides
    /// the end for sure.
    pub(in crate::lines) fn tip(self, space: &Space, length_px: f64) -> f64 {
        match self {
            Self::Edge(_) | Self::Free => 0.0,
            Self::Faces(_) => TIP * space.size.max_element() / length_px,
        }
    }
}

impl OccluderProbe {
    /// Creates the probe for the stretch between two places of the line's image.
    pub(in crate::lines) fn new(
        space: &Space,
        (line, ends): (ProbedLine, [DVec3; 2]),
        image: &Image,
        stretch: [f64; 2],
        search_depth: SearchDepth,
    ) -> Self {
        let length_px = image.length();
        let is_at = |end: usize, px: DVec2| space.project(ends[end]).0 == px;
        let is_at_end = [stretch[0] == 0.0 && is_at(0, image.a), stretch[1] == 1.0 && is_at(1, image.b)];
        Self {
            stretch,
            tips: is_at_end.map(|is_at_end| if is_at_end { line.own.tip(space, length_px) } else { 0.0 }),
            px: stretch.map(|place| image.at(place)),
            view: stretch.map(|place| space.point(image.at(place), image.key(place))),
            line,
            touch_px: image.touch_px(space),
            noise_px: image.noise_px,
            is_nearer_sought: search_depth == SearchDepth::Nearer,
        }
    }

    /// Whether the stretch lies beyond one side of a face's image by more than any tolerance. [`Faces::hidden_ranges`] would find
    /// the same at more cost.
    pub(in crate::lines) fn is_beside(&self, space: &Space, points: [DVec2; 3]) -> bool {
        let sign = (points[1] - points[0]).perp_dot(points[2] - points[0]).signum();
        let reach = points.iter().map(|px| px.abs().max_element()).fold(space.size.max_element(), f64::max);
        let forgiven_px = 2.0 * self.touch_px + reach * IMAGE_ROUNDING;
        (0..3).any(|side| {
            let (from, along) = (points[side], points[(side + 1) % 3] - points[side]);
            // At least the length, without a root.
            let length = along.abs().element_sum();
            let is_side = along.abs().max_element() > 2.0 * self.touch_px;
            is_side && self.px.iter().all(|px| sign * along.perp_dot(*px - from) < -forgiven_px * length)
        })
    }

    /// Extends a range that a face hides to an end that is very near: no third face comes between.
    fn up_to_ends(&self, mut range: [f64; 2]) -> [f64; 2] {
        for (end, place) in range.iter_mut().enumerate() {
            if (*place - self.stretch[end]).abs() <= self.tips[end] {
                *place = self.stretch[end];
            }
        }
        range
    }
}

impl Faces {
    pub(in crate::lines) fn hidden_ranges(
        &self,
        space: &Space,
        face: u32,
        image: &ProjectedFace,
        probe: &OccluderProbe,
    ) -> [Option<[f64; 2]>; 2] {
        const NOTHING: [Option<[f64; 2]>; 2] = [None; 2];
        let is_cut = !self.cut_by_near.is_empty() && self.cut_by_near.binary_search(&face).is_ok();
        // How far inside of each side both ends are. Most faces in the box of a stretch lie beside it.
        let [from, to] = probe.px;
        let of_side = |side: usize| [image.inside(side, from), image.inside(side, to)];
        let inside = [of_side(0), of_side(1), of_side(2)];
        let outside = -2.0 * probe.touch_px - image.rounding_px;
        let is_side = |side: usize| image.lengths_px[side] > 2.0 * probe.touch_px;
        if !is_cut && (0..3).any(|side| is_side(side) && inside[side][0].max(inside[side][1]) < outside) {
            return NOTHING;
        }
        let Some(is_own) = probe.line.own_corners(self, face) else { return NOTHING };
        if is_cut {
            return [None, Some(probe.stretch)];
        }
        let [mut sure, mut may] = [Some(probe.stretch); 2];
        for side in 0..3 {
            if !is_side(side) {
                // Too short for a direction.
                sure = None;
                continue;
            }
            // A side that begins at the line's end runs beside the line at any small distance.
            let is_beside = probe.is_nearer_sought && (is_own[side] || is_own[(side + 1) % 3]);
            let margin = if is_beside { 8.0 * probe.noise_px } else { 2.0 * probe.touch_px } + image.rounding_px;
            let [start, end] = inside[side];
            sure = clipped(sure, probe.stretch, [start - margin, end - margin]);
            may = clipped(may, probe.stretch, [start - outside, end - outside]);
            if may.is_none() {
                return NOTHING;
            }
        }
        if !probe.is_nearer_sought {
            return [sure, may];
        }
        let contact = Contact::new(space, self, face, &probe.line, is_own);
        let behind = probe.view.map(|view| contact.behind(view));
        let sure = sure.map(|sure| probe.up_to_ends(sure));
        match contact.hides_from(space, &probe.line) {
            f64::NEG_INFINITY => return [sure, may],
            f64::INFINITY => return NOTHING,
            _ => {}
        }
        // Converts places along the line to places along its image.
        let depths = probe.view.map(|view| if space.is_perspective() { -view.z } else { 1.0 });
        let place = |share: f64| {
            if share == 1.0 {
                return probe.stretch[1];
            }
            let far = share * depths[1];
            probe.stretch[0] + (probe.stretch[1] - probe.stretch[0]) * (far / ((1.0 - share) * depths[0] + far))
        };
        let clip = |range: Option<[f64; 2]>| common(range?, above_zero([0.0, 1.0], behind)?.map(place));
        [clip(sure), clip(may)]
    }
}
