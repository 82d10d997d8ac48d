//! Where faces seen almost edge-on lie in the picture, by pixels or small squares of them.
//!
//! Some drivers compute depth from a face's true corners and fill it where sub-pixels have put them. Between the two a face
//! seen edge-on has any depth, and may lose to what it should hide; so nothing is left out behind one.

use crate::mesh::NONE;
use crate::tolerances::WINDOW_ROUNDING_PX;
use crate::values::Size;
use glam::Vec2;

/// Cells on a side at most: they are cleared for every view.
const MOST_CELLS: u32 = 512;

/// Pixels around a face that it may be drawn in.
const MARGIN_PX: f32 = WINDOW_ROUNDING_PX as f32;

/// Cells of a box that are looked at faster than the triangle in it is found.
const SMALL_BOX: usize = 64;

/// Which cells of the picture such faces touch.
pub(super) struct Slivers {
    columns: usize,
    rows: usize,
    cells_per_pixel: f32,
    /// In each the shell whose faces these are, [`NONE`] for several.
    cells: Vec<Option<u32>>,
}

impl Slivers {
    /// None yet, in a picture of this size.
    pub(super) fn new(surface: Size) -> Self {
        let side = surface.width.max(surface.height).div_ceil(MOST_CELLS).max(1);
        let [columns, rows] = [surface.width, surface.height].map(|pixels| pixels.div_ceil(side) as usize);
        Self { columns, rows, cells_per_pixel: 1.0 / side as f32, cells: vec![None; columns * rows] }
    }

    /// Adds a face of a shell, [`NONE`] if it may be of any, by its corners' places in the window, pixels.
    pub(super) fn add(&mut self, corners: [Vec2; 3], shell: u32) {
        if !corners.iter().all(|corner| corner.is_finite()) {
            self.cells.fill(Some(NONE));
            return;
        }
        for row in self.rows_of(corners) {
            let columns = self.columns_of(corners, row);
            for cell in &mut self.cells[row * self.columns..][columns] {
                *cell = Some(if cell.is_none_or(|other| other == shell) { shell } else { NONE });
            }
        }
    }

    /// Whether a face of this shell with these corners overlaps one of its slivers, perhaps.
    pub(super) fn touch(&self, corners: [Vec2; 3], shell: u32) -> bool {
        let is_own = |cell: &Option<u32>| cell.is_some_and(|other| other == shell || other == NONE);
        if !corners.iter().all(|corner| corner.is_finite()) {
            return true;
        }
        let [a, b, c] = corners;
        let mut rows = self.rows_of(corners);
        let columns = self.cells_between(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.columns);
        if rows.len() * columns.len() <= SMALL_BOX {
            return rows.any(|row| self.cells[row * self.columns..][columns.clone()].iter().any(is_own));
        }
        rows.any(|row| self.cells[row * self.columns..][self.columns_of(corners, row)].iter().any(is_own))
    }

    /// The rows of cells that a face reaches.
    fn rows_of(&self, [a, b, c]: [Vec2; 3]) -> std::ops::Range<usize> {
        self.cells_between(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.rows)
    }

    /// The columns of cells that a face reaches in a row: where its sides pass through the row, and what lies between.
    fn columns_of(&self, corners: [Vec2; 3], row: usize) -> std::ops::Range<usize> {
        let (below, above) =
            (row as f32 / self.cells_per_pixel - MARGIN_PX, (row + 1) as f32 / self.cells_per_pixel + MARGIN_PX);
        let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
        for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (corners[from], corners[to])) {
            let (low, high) = if from.y < to.y { (from, to) } else { (to, from) };
            if high.y < below || low.y > above {
                continue;
            }
            let at = |y: f32| match (y - low.y) / (high.y - low.y) {
                share if share > 0.0 && share < 1.0 => low.x + (high.x - low.x) * share,
                share if share >= 1.0 => high.x,
                _ => low.x,
            };
            for x in [at(below), at(above)] {
                (left, right) = (left.min(x), right.max(x));
            }
            // A level side has no share: it is all in the row, or its ends' sides are.
            if low.y == high.y {
                (left, right) = (left.min(low.x).min(high.x), right.max(low.x).max(high.x));
            }
        }
        self.cells_between(left, right, self.columns)
    }

    /// The cells from one place to another and a margin around them, of so many.
    fn cells_between(&self, low: f32, high: f32, count: usize) -> std::ops::Range<usize> {
        let (low, high) = ((low - MARGIN_PX) * self.cells_per_pixel, (high + MARGIN_PX) * self.cells_per_pixel);
        if high < 0.0 || low >= count as f32 || low > high {
            return 0..0;
        }
        let cell = |place: f32| (place.max(0.0) as usize).min(count - 1);
        cell(low)..cell(high) + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_touches_slivers_in_pixels_they_share_and_none_farther_off() {
        let mut slivers = Slivers::new(Size { width: 100, height: 60 });
        let at = |x: f32, y: f32| [Vec2::new(x, y), Vec2::new(x + 3.0, y), Vec2::new(x, y + 0.001)];
        slivers.add(at(50.0, 30.0), 3);
        assert!(slivers.touch(at(50.0, 30.0), 3) && slivers.touch(at(53.0, 30.0), 3));
        assert!(!slivers.touch(at(55.0, 30.0), 3) && !slivers.touch(at(50.0, 32.5), 3));
        assert!(!slivers.touch(at(45.0, 30.0), 3));
        // Beside the picture there is nothing, wherever exactly.
        slivers.add(at(-20.0, 10.0), 3);
        slivers.add(at(200.0, 10.0), 3);
        assert!(!slivers.touch(at(-20.0, 10.0), 3) && !slivers.touch(at(95.0, 10.0), 3));
        let all = slivers.cells.iter().flatten().count();
        assert!((4..=5 * 2).contains(&all), "{all} cells");
    }

    #[test]
    fn a_slanted_sliver_leaves_the_rest_of_its_box_alone() {
        let mut slivers = Slivers::new(Size { width: 100, height: 100 });
        slivers.add([Vec2::new(10.0, 10.0), Vec2::new(90.0, 90.0), Vec2::new(50.0, 50.001)], 3);
        let at = |x: f32, y: f32| [Vec2::new(x, y), Vec2::new(x + 1.0, y), Vec2::new(x, y + 1.0)];
        assert!((10..90).all(|place| slivers.touch(at(place as f32, place as f32), 3)));
        assert!(!slivers.touch(at(60.0, 40.0), 3) && !slivers.touch(at(20.0, 70.0), 3));
        // Every cell that a point of it lies in is marked, whatever its slope.
        for turn in 0..24 {
            let (sin, cos) = (turn as f32 * 0.2618).sin_cos();
            let (from, to) = (Vec2::splat(50.0), Vec2::new(50.0 + 45.0 * cos, 50.0 + 45.0 * sin));
            let mut slivers = Slivers::new(Size { width: 100, height: 100 });
            slivers.add([from, to, from.lerp(to, 0.5)], 3);
            for step in 0..=200 {
                let point = from.lerp(to, step as f32 / 200.0);
                assert!(slivers.cells[point.y as usize * 100 + point.x as usize].is_some(), "{turn} {point}");
            }
        }
    }

    #[test]
    fn another_shells_slivers_do_not_count_and_those_of_any_do() {
        let mut slivers = Slivers::new(Size { width: 10, height: 10 });
        let somewhere = [Vec2::ONE, Vec2::splat(2.0), Vec2::new(1.0, 2.0)];
        slivers.add(somewhere, 3);
        assert!(slivers.touch(somewhere, 3) && !slivers.touch(somewhere, 4));
        slivers.add(somewhere, 4);
        assert!(slivers.touch(somewhere, 3) && slivers.touch(somewhere, 4), "both, so any");
        let mut slivers = Slivers::new(Size { width: 10, height: 10 });
        slivers.add(somewhere, NONE);
        assert!(slivers.touch(somewhere, 0));
    }

    #[test]
    fn a_place_that_is_no_number_is_everywhere() {
        let mut slivers = Slivers::new(Size { width: 10, height: 10 });
        let somewhere = [Vec2::ONE, Vec2::splat(2.0), Vec2::new(1.0, 2.0)];
        assert!(!slivers.touch(somewhere, 3) && slivers.touch([Vec2::NAN, Vec2::ONE, Vec2::ONE], 3));
        slivers.add([Vec2::NAN, Vec2::ONE, Vec2::ONE], 3);
        assert!(slivers.touch(somewhere, 3));
    }

    #[test]
    fn large_pictures_have_cells_of_several_pixels() {
        let mut slivers = Slivers::new(Size { width: 4096, height: 2048 });
        assert_eq!((slivers.columns, slivers.rows), (512, 256));
        let sliver = [Vec2::new(4000.0, 2000.0), Vec2::new(4040.0, 2000.0), Vec2::new(4000.0, 2040.0)];
        slivers.add(sliver, 3);
        assert!(slivers.touch(sliver, 3));
        assert!(!slivers.touch(sliver.map(|corner| corner - 100.0), 3));
    }
}
