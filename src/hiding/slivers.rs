//! Where faces seen almost edge-on lie in the picture, by pixels or small squares of them.
//!
//! Some drivers compute depth from a face's true corners and fill it where sub-pixels have put them. Between the two a face
//! seen edge-on has any depth, and may lose to what it should hide; so nothing is left out behind one.

use crate::scene::Size;
use glam::Vec2;

/// Cells on a side at most: they are cleared for every view.
const MOST_CELLS: u32 = 512;

/// Pixels around a face that it may be drawn in.
const MARGIN_PX: f32 = 1.0;

/// Which cells of the picture such faces touch.
pub(super) struct Slivers {
    columns: usize,
    rows: usize,
    cells_per_pixel: f32,
    cells: Vec<bool>,
}

impl Slivers {
    /// None yet, in a picture of this size.
    pub fn new(surface: Size) -> Self {
        let side = surface.width.max(surface.height).div_ceil(MOST_CELLS).max(1);
        let [columns, rows] = [surface.width, surface.height].map(|pixels| pixels.div_ceil(side) as usize);
        Self { columns, rows, cells_per_pixel: 1.0 / side as f32, cells: vec![false; columns * rows] }
    }

    /// Adds a face by its corners' places in the window, pixels.
    pub fn add(&mut self, corners: [Vec2; 3]) {
        let [columns, rows] = self.cells_of(corners, MARGIN_PX);
        for row in rows {
            self.cells[row * self.columns..][columns.clone()].fill(true);
        }
    }

    /// Whether a face with these corners overlaps one of them, perhaps.
    pub fn touch(&self, corners: [Vec2; 3]) -> bool {
        let [columns, mut rows] = self.cells_of(corners, MARGIN_PX);
        rows.any(|row| self.cells[row * self.columns..][columns.clone()].contains(&true))
    }

    /// The columns and rows of cells that the corners' box covers.
    fn cells_of(&self, [a, b, c]: [Vec2; 3], margin: f32) -> [std::ops::Range<usize>; 2] {
        let cell = |place: f32, last: usize| ((place * self.cells_per_pixel).max(0.0) as usize).min(last);
        let (low, high) = (a.min(b).min(c) - margin, a.max(b).max(c) + margin);
        let is_beside = !(high.x >= 0.0 && high.y >= 0.0)
            || low.x * self.cells_per_pixel >= self.columns as f32
            || low.y * self.cells_per_pixel >= self.rows as f32;
        if is_beside {
            return [0..0, 0..0];
        }
        [
            cell(low.x, self.columns - 1)..cell(high.x, self.columns - 1) + 1,
            cell(low.y, self.rows - 1)..cell(high.y, self.rows - 1) + 1,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_touches_slivers_within_two_pixels_of_it_and_none_farther_off() {
        let mut slivers = Slivers::new(Size { width: 100, height: 60 });
        let at = |x: f32, y: f32| [Vec2::new(x, y), Vec2::new(x + 3.0, y), Vec2::new(x, y + 0.001)];
        slivers.add(at(50.0, 30.0));
        assert!(slivers.touch(at(50.0, 30.0)) && slivers.touch(at(54.5, 30.0)) && slivers.touch(at(45.6, 31.9)));
        assert!(!slivers.touch(at(57.0, 30.0)) && !slivers.touch(at(50.0, 34.5)) && !slivers.touch(at(43.0, 30.0)));
        // Beside the picture there is nothing, wherever exactly.
        slivers.add(at(-20.0, 10.0));
        slivers.add(at(200.0, 10.0));
        assert!(!slivers.touch(at(-20.0, 10.0)) && !slivers.touch(at(95.0, 10.0)));
        let all: usize = slivers.cells.iter().map(|cell| usize::from(*cell)).sum();
        assert!(all <= 6 * 4, "{all} cells");
    }

    #[test]
    fn large_pictures_have_cells_of_several_pixels() {
        let mut slivers = Slivers::new(Size { width: 4096, height: 2048 });
        assert_eq!((slivers.columns, slivers.rows), (512, 256));
        let sliver = [Vec2::new(4000.0, 2000.0), Vec2::new(4040.0, 2000.0), Vec2::new(4000.0, 2040.0)];
        slivers.add(sliver);
        assert!(slivers.touch(sliver));
        assert!(!slivers.touch(sliver.map(|corner| corner - 100.0)));
    }
}
