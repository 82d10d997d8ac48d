//! Which visible lines are outline: nothing but background is drawn just beside them on one side at least.
//!
//! A visible piece is cut again wherever the image of a place at which a surface ends or turns away crosses its own, however
//! far away that is: only there can background begin or end. Each part is decided in its middle by all faces there, whatever
//! their depth. Faces seen edge-on cover nothing, and background narrower than what counts as touching is none. Lines at which
//! no surface ends have a face on either side.

use super::beside::Beside;
use super::faces::{Faces, Own, Probe};
use super::image::Image;
use super::search::{LastHider, Sought};
use super::space::Space;
use super::visibility::{Lines, Piece};
use crate::bvh::Box3;

/// Of boxes whose depth does not matter.
const ANY_KEY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl Lines<'_> {
    /// The parts of a visible piece, told apart.
    pub(super) fn with_outline(&self, index: usize, image: &Image, piece: Piece) -> Vec<Piece> {
        if !self.features[index].occludes {
            return vec![piece];
        }
        let touch_px = image.touch_px(self.space);
        let add = |part, most, cuts: &mut Vec<f64>| {
            let mut count = 0;
            self.rims.any(&image.part_box(part, touch_px, ANY_KEY), |other_index| {
                if let Some(other) = self.images[other_index].filter(|_| other_index != index) {
                    cuts.extend(image.meetings(&other, touch_px.max(other.touch_px(self.space))));
                }
                count += 1;
                count > most
            })
        };
        let looked = self.look(index, image, [piece.from, piece.to], Vec::new(), Sought::Any, &LastHider::default());
        let mut cuts = self.search(index, image, looked, Sought::Any, &Beside::none(), add);
        let mut parts: Vec<Piece> = Vec::new();
        let places = self.places(image, [piece.from, piece.to], std::mem::take(&mut cuts.places));
        for place in places.windows(2) {
            let middle = (place[0] + place[1]) * 0.5;
            let probe = self.probe(index, image, middle);
            let is_outline = !cuts.hides(middle) && self.faces.cover(self.space, &probe, touch_px) != [true; 2];
            match parts.last_mut() {
                Some(last) if last.is_outline == is_outline => last.to = place[1],
                _ => parts.push(Piece { from: place[0], to: place[1], is_outline, ..piece }),
            }
        }
        parts
    }
}

impl Image {
    /// Where another line's image crosses or touches this one, or lies on it and ends, in places of this one.
    pub(super) fn meetings(&self, other: &Self, touch_px: f64) -> impl Iterator<Item = f64> + use<> {
        let along = self.b - self.a;
        let length = along.length();
        let (c, d) = (along.perp_dot(other.a - self.a) / length, along.perp_dot(other.b - self.a) / length);
        let is_beside = (c > touch_px && d > touch_px) || (c < -touch_px && d < -touch_px);
        let crossing = (!is_beside && c != d).then(|| self.place_of(other.at((c / (c - d)).clamp(0.0, 1.0))));
        let overlap = if is_beside { None } else { self.overlap(other, touch_px) };
        overlap.into_iter().flatten().chain(crossing)
    }
}

impl Faces {
    /// On which sides of a line at a point something is drawn, at any depth, if the point moves to that side by as little as
    /// one likes. A side of a face within `touch_px` of the point counts as going through it.
    pub(super) fn cover(&self, space: &Space, probe: &Probe, touch_px: f64) -> [bool; 2] {
        let column =
            Box3::new((probe.px - touch_px).extend(f64::NEG_INFINITY), (probe.px + touch_px).extend(f64::INFINITY));
        let touch = touch_px / space.px_per_unit(-probe.view.z);
        let mut covered = [false; 2];
        self.tree.any(&column, |face| {
            let by_this = self.covers(space, face, probe, touch);
            covered = [covered[0] || by_this[0], covered[1] || by_this[1]];
            covered == [true; 2]
        });
        covered
    }

    fn covers(&self, space: &Space, face: u32, probe: &Probe, touch: f64) -> [bool; 2] {
        const NEITHER: [bool; 2] = [false; 2];
        if self.edge_on.binary_search(&self.numbers[face as usize]).is_ok() {
            return NEITHER;
        }
        let numbers = self.triangles[face as usize];
        let is_own = numbers.map(|number| matches!(probe.own, Own::Edge(ends) if ends.contains(&number)));
        let corners = self.corners(face);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        // Counter-clockwise, seen from the front.
        let sign = if normal.dot(space.to_eye(a)) > 0.0 { 1.0 } else { -1.0 };
        let mut is_inside = [true; 2];
        for side in 0..3 {
            let next = (side + 1) % 3;
            let (from, to) = (corners[side], corners[next]);
            let (turn, length) = space.turn(from, to, probe.view);
            // The line itself, whatever rounding says.
            let turn = if is_own[side] && is_own[next] { 0.0 } else { sign * turn };
            if turn < -touch * length {
                return NEITHER;
            }
            if turn <= touch * length {
                let inward = sign * space.turn_aside(from, to, probe.aside);
                is_inside = [is_inside[0] && inward > 0.0, is_inside[1] && -inward > 0.0];
            }
        }
        let is_cut = is_inside != NEITHER && self.cut_by_near.binary_search(&face).is_ok();
        if is_cut && self.hit_depth(space, [a, normal], probe) < space.near { NEITHER } else { is_inside }
    }
}
