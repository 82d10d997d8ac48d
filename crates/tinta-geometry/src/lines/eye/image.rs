//! Images of lines in the picture.

use crate::bvh::Box3;
use crate::lines::eye::space::{Space, at_depth};
use crate::ranges::between;
use crate::thresholds::THRESHOLDS;
use crate::tolerances::TURNED;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A line's image: straight, its key linear along it.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Image {
    pub a: DVec2,
    pub b: DVec2,
    pub keys: [f64; 2],
    /// How far the rounding of the world's own numbers may move it, pixels.
    pub noise_px: f64,
}

impl Image {
    /// Returns the image of a line's stretch between the planes.
    pub(in crate::lines) fn of(space: &Space, ends: [DVec3; 2]) -> Option<Self> {
        Self::between(space, ends, [space.near, space.far])
    }

    /// Returns the image of a line's stretch between two depths.
    pub(in crate::lines) fn between(space: &Space, ends: [DVec3; 2], [near, far]: [f64; 2]) -> Option<Self> {
        let depths = ends.map(|end| -end.z);
        let (nearest, farthest) = (depths[0].min(depths[1]), depths[0].max(depths[1]));
        let is_flat = nearest == farthest;
        if farthest < near || nearest > far || !is_flat && (farthest <= near || nearest >= far) {
            return None;
        }
        // The ends themselves stay unchanged: lines that meet there meet in the picture.
        let kept = |end: DVec3| match -end.z {
            depth if depth < near => at_depth(ends, near).unwrap_or(end),
            depth if depth > far => at_depth(ends, far).unwrap_or(end),
            _ => end,
        };
        let [(a, first), (b, second)] = ends.map(|end| space.project(kept(end)));
        let noise_px = space.noise * space.px_per_unit(nearest.max(near));
        Some(Self { a, b, keys: [first, second], noise_px })
    }

    pub(in crate::lines) fn length(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// Returns the range of directions of lines that touch this one at two places, as the third coordinate of boxes. A range that
    /// reaches over an end comes a second time, half a turn away: then of two lines, one has the other's direction.
    pub(in crate::lines) fn directions(&self, touch_px: f64) -> impl Iterator<Item = [f64; 2]> + use<> {
        let along = self.b - self.a;
        let direction = along.y.atan2(along.x).rem_euclid(PI);
        let spread = (2.0 * touch_px / along.length() + TURNED).min(PI);
        let turned = if direction < PI * 0.5 { direction + PI } else { direction - PI };
        let reaches_over = direction < spread || direction + spread > PI;
        let all = [Some(direction), reaches_over.then_some(turned)];
        all.into_iter()
            .flatten()
            .map(move |direction| [direction - spread, direction + spread].map(|it| it * THRESHOLDS.px_per_radian))
    }

    /// The pixel at a place from 0 to 1.
    pub(in crate::lines) fn at(&self, place: f64) -> DVec2 {
        match place {
            0.0 => self.a,
            1.0 => self.b,
            _ => self.a + (self.b - self.a) * place,
        }
    }

    /// The points at two places, in the world.
    pub(in crate::lines) fn ends_world(&self, space: &Space, places: [f64; 2]) -> [DVec3; 2] {
        places.map(|place| space.world(space.point(self.at(place), self.key(place))))
    }

    pub(in crate::lines) fn key(&self, place: f64) -> f64 {
        self.keys[0] + (self.keys[1] - self.keys[0]) * place
    }

    /// The place nearest to a pixel.
    pub(in crate::lines) fn place_of(&self, px: DVec2) -> f64 {
        let along = self.b - self.a;
        let square = along.length_squared();
        if square > 0.0 { (px - self.a).dot(along) / square } else { 0.0 }
    }

    /// Returns the range of a line inside the picture with a margin around it.
    pub(in crate::lines) fn inside(&self, size: DVec2, margin: f64) -> Option<[f64; 2]> {
        let along = self.b - self.a;
        let range = between([0.0, 1.0], self.a.x, along.x, [-margin, size.x + margin])?;
        between(range, self.a.y, along.y, [-margin, size.y + margin])
    }

    /// Cuts a range of places into stretches no longer than `longest_px`.
    pub(in crate::lines) fn stretches(
        &self,
        [from, to]: [f64; 2],
        longest_px: f64,
    ) -> impl Iterator<Item = [f64; 2]> + use<> {
        let count = ((to - from) * self.length() / longest_px).ceil().max(1.0);
        (0..count as usize).map(move |stretch| {
            let place = |stretch: usize| from + (to - from) * (stretch as f64 / count);
            [place(stretch), place(stretch + 1)]
        })
    }

    /// The box around a stretch, wider by a margin in pixels, between two keys.
    pub(in crate::lines) fn box_around(&self, stretch: [f64; 2], margin: f64, keys: [f64; 2]) -> Box3 {
        let [first, second] = stretch.map(|place| self.at(place));
        let (low, high) = (first.min(second) - margin, first.max(second) + margin);
        Box3::new(low.extend(keys[0].min(keys[1])), high.extend(keys[0].max(keys[1])))
    }
}
