//! Hatching: parallel strokes that end exactly at the borders of an area.
//!
//! Input: an area as [`Regions`], and a [`Ruling`] of the picture. Output: strokes. All strokes of a ruling lie on its lines,
//! whatever area they are in: so strokes of neighbouring areas continue each other.
//!
//! Each side of the area is cut with the lines that it crosses. Along a line every second stretch between cuts is inside. A line
//! through a corner belongs to the side above it, so each loop has an even number of cuts on each line.

use crate::error::{Error, Result};
use crate::lines::drawing::length::Length;
use crate::lines::regions::Regions;
use crate::settings::{Kind, Setting, Value};
use glam::DVec2;
use std::ops::RangeInclusive;

/// How tones are drawn as strokes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hatching {
    /// Distance from stroke to stroke; [`Length::Times`] counts widths of a stroke. Default none: tones are painted areas.
    pub spacing: Option<Length>,
    /// Direction of the strokes, degrees from the horizontal, counter-clockwise; crossed strokes are perpendicular. Default none: they run
    /// along the form.
    pub angle_degrees: Option<f64>,
}

/// The text for no strokes.
const NONE: &str = "none";

/// The text for [`AUTO_SPACING`].
const AUTO: &str = "auto";

/// The text for no direction.
const FORM: &str = "form";

/// The error for a text that is no spacing.
const USAGE: &str = "give pixels, millimetres on paper, widths of a stroke, or auto: 8, 1mm or 6x";

/// The spacing that follows from the strokes' width: they cover a sixth of a tone, a third of the next darker one.
const AUTO_SPACING: Length = Length::Times(6.0);

impl Hatching {
    /// Its settings.
    pub(in crate::lines) fn settings() -> Vec<Setting<Self>> {
        let spacing = Setting::of(
            "hatch",
            "SPACING",
            Kind::Text { offered: &[AUTO, "1mm", "6x"], example: "8x" },
            "Distance between strokes that draw the tones of --look print and other styles with tones, in place of areas: pixels \
             of --size, millimetres (1mm), widths of a stroke (8x), or auto (6x)",
            |hatching: &Self| hatching.spacing.map_or(NONE.to_owned(), |spacing| spacing.text()),
            |hatching, text| {
                hatching.spacing = match text {
                    NONE => None,
                    AUTO => Some(AUTO_SPACING),
                    text => Some(text.parse().map_err(|_| USAGE.to_owned())?),
                };
                Ok(())
            },
        );
        let angle = Setting::open_field(
            "hatch-angle",
            "DEGREES",
            FORM,
            "Straight strokes of --hatch in this direction, degrees from the horizontal, rising to the right, crossed in the darkest tone; \
             by default they run along the form",
            |hatching: &mut Self| &mut hatching.angle_degrees,
        )
        .inside("hatch");
        vec![spacing.open(NONE).said("none, areas").common(), angle.range(-90.0, 90.0, 0).said("along the form")]
    }

    /// Refuses a spacing outside `allowed`, millimetres without a size on paper, and angles beyond a full turn.
    pub(in crate::lines) fn check(self, allowed: RangeInclusive<f64>, has_paper: bool) -> Result<()> {
        if let Some(spacing) = self.spacing {
            if !spacing.all(|number| allowed.contains(&number)) {
                let problem =
                    format!("a distance between strokes is a number from {} to {}", allowed.start(), allowed.end());
                return Err(Error::value("hatch", spacing, problem));
            }
            spacing.check_unit("hatch", has_paper)?;
        }
        match self.angle_degrees {
            Some(angle) if !(-360.0..=360.0).contains(&angle) => {
                Err(Error::value("hatch-angle", angle, "an angle is a number of degrees from -360 to 360"))
            }
            _ => Ok(()),
        }
    }
}

/// The strokes of one direction, through every tone from the darkest to one; all of those along the form.
#[derive(Debug, Clone, PartialEq)]
pub struct Hatch {
    /// The brightest tone that the strokes are in; 0 is the darkest.
    pub tone: u8,
    /// The points of each stroke, pixels, y down.
    pub strokes: Vec<Vec<DVec2>>,
}

/// Parallel lines through the whole picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Ruling {
    /// A point on one of the lines, pixels.
    pub anchor_px: DVec2,
    /// The direction of the lines, a unit vector, y down.
    along: DVec2,
    /// The distance between the lines, pixels.
    spacing_px: f64,
}

impl Ruling {
    /// Lines at an angle from the horizontal, counter-clockwise as seen.
    pub(in crate::lines) fn new(anchor_px: DVec2, angle_degrees: f64, spacing_px: f64) -> Self {
        let (sin, cos) = angle_degrees.to_radians().sin_cos();
        Self { anchor_px, along: DVec2::new(cos, -sin), spacing_px }
    }

    /// A point's distance along the lines, pixels, and the number of the line through it.
    fn place(&self, px: DVec2) -> DVec2 {
        let away = px - self.anchor_px;
        DVec2::new(self.along.dot(away), self.along.perp_dot(away) / self.spacing_px)
    }

    fn px(&self, along: f64, line: f64) -> DVec2 {
        self.anchor_px + self.along * along + self.along.perp() * (line * self.spacing_px)
    }

    /// The sides of an area in the ruling's coordinates.
    fn sides<'a, T>(&'a self, area: &'a Regions<T>) -> impl Iterator<Item = [DVec2; 2]> + 'a {
        let loops = area.regions.iter().flat_map(|region| &region.loops);
        loops.flat_map(|corners| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(from, to)| [self.place(*from), self.place(*to)])
        })
    }

    /// The number of strokes in an area, found without making them.
    pub(in crate::lines) fn count<T>(&self, area: &Regions<T>) -> f64 {
        let cuts = |[from, to]: [DVec2; 2]| (from.y.ceil() - to.y.ceil()).abs();
        self.sides(area).map(cuts).sum::<f64>() * 0.5
    }

    /// The strokes in an area, line by line, without those shorter than `least_px`.
    pub(in crate::lines) fn strokes<T>(&self, area: &Regions<T>, least_px: f64) -> Vec<[DVec2; 2]> {
        let mut cuts: Vec<(i64, f64)> = Vec::with_capacity(2 * self.count(area) as usize);
        for [from, to] in self.sides(area) {
            let [low, high] = if from.y < to.y { [from, to] } else { [to, from] };
            let lines = low.y.ceil() as i64..high.y.ceil() as i64;
            cuts.extend(lines.map(|line| {
                let share = (line as f64 - low.y) / (high.y - low.y);
                (line, low.x + (high.x - low.x) * share)
            }));
        }
        cuts.sort_unstable_by(|(line, along), (other, other_along)| line.cmp(other).then(along.total_cmp(other_along)));
        let mut strokes: Vec<(i64, [f64; 2])> = Vec::with_capacity(cuts.len() / 2);
        for pair in cuts.chunks_exact(2) {
            let (line, [from, to]) = (pair[0].0, [pair[0].1, pair[1].1]);
            match strokes.last_mut() {
                // Loops touch here.
                Some((last, [_, end])) if *last == line && *end >= from => *end = to,
                _ => strokes.push((line, [from, to])),
            }
        }
        let is_long = |(_, [from, to]): &(i64, [f64; 2])| to - from > 0.0 && to - from >= least_px;
        let ends = |(line, ends): (i64, [f64; 2])| ends.map(|along| self.px(along, line as f64));
        strokes.into_iter().filter(is_long).map(ends).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::regions::Region;
    use crate::scene::Size;

    fn area(loops: &[&[[f64; 2]]]) -> Regions<()> {
        let loops = loops.iter().map(|corners| corners.iter().map(|corner| DVec2::from(*corner)).collect()).collect();
        let regions = vec![Region { seen: (), loops, area_px: 0.0 }];
        Regions { size: Size { width: 100, height: 100 }, regions, broken: 0 }
    }

    const SQUARE: [[f64; 2]; 4] = [[10.0, 10.0], [50.0, 10.0], [50.0, 50.0], [10.0, 50.0]];

    fn level(spacing_px: f64) -> Ruling {
        Ruling::new(DVec2::new(0.0, 5.0), 0.0, spacing_px)
    }

    #[test]
    fn strokes_end_at_borders_and_at_holes() {
        let hole: [[f64; 2]; 4] = [[20.0, 20.0], [20.0, 30.0], [30.0, 30.0], [30.0, 20.0]];
        let area = area(&[&SQUARE, &hole]);
        let strokes = level(10.0).strokes(&area, 0.0);
        let ends: Vec<[[f64; 2]; 2]> = strokes.iter().map(|ends| ends.map(|end| end.to_array())).collect();
        let row = |y: f64| [[10.0, y], [50.0, y]];
        let expected = [row(15.0), [[10.0, 25.0], [20.0, 25.0]], [[30.0, 25.0], [50.0, 25.0]], row(35.0), row(45.0)];
        assert_eq!(ends, expected);
        assert_eq!(level(10.0).count(&area), 5.0);
        assert_eq!(level(10.0).strokes(&area, 15.0).len(), 4, "without the short one");
    }

    #[test]
    fn a_line_through_corners_is_cut_twice_or_not_at_all() {
        let diamond: [[f64; 2]; 4] = [[30.0, 5.0], [55.0, 35.0], [30.0, 65.0], [5.0, 35.0]];
        let strokes = level(30.0).strokes(&area(&[&diamond]), 0.0);
        assert_eq!(strokes, [[DVec2::new(5.0, 35.0), DVec2::new(55.0, 35.0)]]);
        let along_sides = level(5.0).strokes(&area(&[&SQUARE]), 0.0);
        assert_eq!(along_sides.len(), 8, "of the sides along lines, one has a stroke");
    }

    #[test]
    fn strokes_of_areas_that_touch_are_one() {
        let right: [[f64; 2]; 4] = [[50.0, 10.0], [90.0, 10.0], [90.0, 50.0], [50.0, 50.0]];
        let mut both = area(&[&SQUARE]);
        both.regions.extend(area(&[&right]).regions);
        let strokes = level(10.0).strokes(&both, 0.0);
        assert!(strokes.len() == 4 && strokes.iter().all(|[from, to]| to.x - from.x == 80.0), "{strokes:?}");
    }

    #[test]
    fn angles_turn_counter_clockwise() {
        let [from, to] = Ruling::new(DVec2::new(30.0, 30.0), 45.0, 100.0).strokes(&area(&[&SQUARE]), 0.0)[0];
        assert!(
            from.distance(DVec2::new(10.0, 50.0)) < 1e-9 && to.distance(DVec2::new(50.0, 10.0)) < 1e-9,
            "{from} {to}"
        );
    }
}
