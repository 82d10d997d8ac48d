//! The parts of the picture that single faces hide for sure: a hierarchical depth buffer (Greene, Kass and Miller 1993) in f64.
//!
//! The picture consists of cells; four cells make one of the next level. Each cell has a key beyond which everything in it is
//! hidden: the farthest key of the nearest face that covers the whole cell, plus the distance within which a point still touches
//! the face. The nearest faces come first, and each face descends only to cells where it may still hide something. So where many
//! faces overlap, most need few steps. The buffer decides only clear cases and leaves the rest to the exact rules.

use crate::bvh::Box3;
use crate::lines::eye::face_pair::FacePlane;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::projected_face::ProjectedFace;
use crate::lines::eye::space::Space;
use crate::threads::{cores, filled, in_chunks, threads_for_items};
use crate::thresholds::THRESHOLDS;
use glam::DVec2;

/// Faces that a thread projects at once.
const PROJECTED_AT_ONCE: usize = 4096;

/// Whether so many faces overlap in the picture that accelerators pay.
pub(in crate::lines) fn is_crowded(space: &Space, faces: &Faces) -> bool {
    let area = |around: &Box3| {
        let [low, high] = around.corners();
        let (low, high) = (low.truncate().max(DVec2::ZERO), high.truncate().min(space.size));
        (high - low).max(DVec2::ZERO).element_product()
    };
    let covered: f64 = faces.tree.boxes().iter().map(area).sum();
    covered >= THRESHOLDS.crowded * space.size.element_product()
}

/// The cells of the picture, each with the key beyond which everything is hidden.
pub(in crate::lines) struct Pyramid {
    /// Level by level, from the finest to the one cell around everything, row by row.
    levels: Vec<Vec<f64>>,
    cell_px: f64,
    size: DVec2,
}

/// A face that may hide something for sure.
struct Occluder {
    image: ProjectedFace,
    low: DVec2,
    high: DVec2,
    nearest_key: f64,
    /// How much larger a key must be to be behind the face for sure.
    beyond: f64,
    /// How far from a side a point must be to be inside for sure, pixels.
    margin: f64,
    area_px: f64,
}

impl Occluder {
    /// Projects a face; `None` if it cannot hide anything for sure.
    fn new(space: &Space, faces: &Faces, place: u32) -> Option<Self> {
        if faces.cut_by_near.binary_search(&place).is_ok() || faces.is_ghost(place) {
            return None;
        }
        let FacePlane { corners: corners @ [a, b, c], normal, longest, weld, .. } = FacePlane::exact(faces, place);
        let images = corners.map(|corner| space.project(corner));
        let [(pa, key_a), (pb, key_b), (pc, key_c)] = images;
        let nearest = (-a.z).min(-b.z).min(-c.z);
        let touching = space.contact(longest, weld);
        let beyond = space.key_beyond([a, normal.normalize_or_zero()], nearest, 2.0 * touching);
        let image = ProjectedFace::of_corners(space, images);
        let occluder = Self {
            image,
            low: pa.min(pb).min(pc),
            high: pa.max(pb).max(pc),
            nearest_key: key_a.min(key_b).min(key_c),
            beyond,
            margin: 2.0 * (space.touch_px() + space.noise * space.px_per_unit(nearest)) + image.rounding_px,
            area_px: (pb - pa).perp_dot(pc - pa).abs() * 0.5,
        };
        (image.growth().is_finite() && beyond.is_finite() && occluder.margin.is_finite()).then_some(occluder)
    }

    /// Whether the face is large enough to cover a cell. No triangle holds a square of more than half its area. A face that
    /// reaches out of the picture needs to cover only part of a cell.
    fn may_cover(&self, cell_px: f64, size: DVec2) -> bool {
        let reaches_out = self.low.cmplt(DVec2::ZERO).any() || self.high.cmpgt(size).any();
        reaches_out || self.area_px >= 2.0 * cell_px * cell_px
    }

    /// Whether all of a rectangle, given by its middle and half its size, is inside.
    fn covers(&self, middle: DVec2, half: DVec2) -> bool {
        self.image.sides().all(|(inwards, start)| inwards.dot(middle) - start - inwards.abs().dot(half) >= self.margin)
    }

    /// Whether any of a rectangle may be inside.
    fn overlaps(&self, middle: DVec2, half: DVec2) -> bool {
        let wide = half + self.margin;
        (middle - wide).cmple(self.high).all()
            && (middle + wide).cmpge(self.low).all()
            && self.image.sides().all(|(inwards, start)| inwards.dot(middle) - start + inwards.abs().dot(wide) >= 0.0)
    }

    /// The smallest and the largest key in a rectangle.
    fn keys(&self, middle: DVec2, half: DVec2) -> [f64; 2] {
        let (key, spread) = (self.image.key(middle), self.image.growth().abs().dot(half));
        [(key - spread).max(self.nearest_key), key + spread]
    }
}

impl Pyramid {
    /// Builds the pyramid of all faces; `None` if it would hide too little.
    pub(in crate::lines) fn new(space: &Space, faces: &Faces) -> Option<Self> {
        let top = THRESHOLDS.cells;
        let cell_px = space.size.max_element() / f64::from(1u32 << top);
        // Whether any cell lies in a box, as far as the box is in the picture.
        let is_large = |around: &Box3| {
            let [low, high] = around.corners().map(|corner| corner.truncate().clamp(DVec2::ZERO, space.size));
            let last = DVec2::select(high.cmpge(space.size), (high / cell_px).ceil(), (high / cell_px).floor());
            (low / cell_px).ceil().cmplt(last).all()
        };
        let boxes = faces.tree.boxes();
        let large: Vec<u32> = (0..boxes.len() as u32).filter(|place| is_large(&boxes[*place as usize])).collect();
        let occluders = in_chunks(large.len(), PROJECTED_AT_ONCE, cores(), |range| {
            let occluder = |index: usize| {
                Occluder::new(space, faces, large[index]).filter(|occluder| occluder.may_cover(cell_px, space.size))
            };
            range.filter_map(occluder).collect::<Vec<Occluder>>()
        });
        let mut occluders: Vec<Occluder> = occluders.into_iter().flatten().collect();
        if occluders.is_empty() {
            return None;
        }
        occluders.sort_by(|a, b| a.nearest_key.total_cmp(&b.nearest_key));
        let levels = (0..=top).map(|level| vec![f64::INFINITY; 1 << (2 * (top - level))]).collect();
        let mut pyramid = Self { levels, cell_px, size: space.size };
        pyramid.leave_out_what_lies_beside_the_picture();
        occluders.iter().for_each(|occluder| pyramid.add_where_it_lies(occluder));
        pyramid.settle();
        let is_of_use = pyramid.levels[0].iter().any(|key| key.is_finite());
        is_of_use.then_some(pyramid)
    }

    /// The number of the level with one cell.
    fn top(&self) -> usize {
        self.levels.len() - 1
    }

    fn leave_out_what_lies_beside_the_picture(&mut self) {
        for level in 0..=self.top() {
            let width = 1usize << (self.top() - level);
            let cell = self.cell_px * (1u32 << level) as f64;
            let [columns, rows] = self.size.to_array().map(|px| ((px / cell).ceil() as usize).min(width));
            for (row, cells) in self.levels[level].chunks_mut(width).enumerate() {
                let inside = if row < rows { columns } else { 0 };
                cells[inside..].fill(f64::NEG_INFINITY);
            }
        }
    }

    /// The middle of a cell and half its size, clipped to the picture.
    fn rectangle(&self, level: usize, column: usize, row: usize) -> (DVec2, DVec2) {
        let cell = self.cell_px * (1u32 << level) as f64;
        let low = DVec2::new(column as f64, row as f64) * cell;
        let high = (low + cell).min(self.size);
        ((low + high) * 0.5, (high - low) * 0.5)
    }

    fn index(&self, level: usize, column: usize, row: usize) -> usize {
        (row << (self.top() - level)) + column
    }

    /// Adds a face to the smallest cell that contains all of it, and updates the larger cells around that one.
    fn add_where_it_lies(&mut self, occluder: &Occluder) {
        let corner = |px: DVec2| {
            let [column, row] = (px.clamp(DVec2::ZERO, self.size) / self.cell_px).to_array();
            [column, row].map(|at| (at as usize).min((1 << self.top()) - 1))
        };
        let [low, high] = [corner(occluder.low - occluder.margin), corner(occluder.high + occluder.margin)];
        let differing = (low[0] ^ high[0]) | (low[1] ^ high[1]);
        let start = (usize::BITS - differing.leading_zeros()) as usize;
        let cell = |level: usize| (low[0] >> level, low[1] >> level);
        let around = |pyramid: &Self, level: usize| {
            let (column, row) = cell(level);
            pyramid.index(level, column, row)
        };
        let mut own = [f64::INFINITY; THRESHOLDS.cells + 2];
        for level in (start..=self.top()).rev() {
            own[level] = own[level + 1].min(self.levels[level][around(self, level)]);
        }
        let (column, row) = cell(start);
        self.add(occluder, start, column, row, own[start + 1]);
        for (level, own) in own.into_iter().enumerate().take(self.top() + 1).skip(start + 1) {
            let (column, row) = cell(level);
            let children = [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(right, down)| self.levels[level - 1][self.index(level - 1, column * 2 + right, row * 2 + down)]);
            let key = own.min(children.into_iter().fold(f64::NEG_INFINITY, f64::max));
            let index = around(self, level);
            if key >= self.levels[level][index] {
                break;
            }
            self.levels[level][index] = key;
        }
    }

    /// Adds a face to a cell and the cells below it; returns the cell's key.
    fn add(&mut self, occluder: &Occluder, level: usize, column: usize, row: usize, above: f64) -> f64 {
        let (middle, half) = self.rectangle(level, column, row);
        // A cell beside the picture.
        if half.min_element() <= 0.0 {
            return f64::NEG_INFINITY;
        }
        let index = self.index(level, column, row);
        let own = self.levels[level][index].min(above);
        if !occluder.overlaps(middle, half) {
            return own;
        }
        let [nearest, farthest] = occluder.keys(middle, half);
        if nearest >= own {
            return own;
        }
        let mut key = own;
        if occluder.covers(middle, half) {
            key = key.min(farthest + occluder.beyond);
        } else if level > 0 {
            let mut of_children = f64::NEG_INFINITY;
            for (right, down) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                of_children = of_children.max(self.add(occluder, level - 1, column * 2 + right, row * 2 + down, own));
            }
            key = key.min(of_children);
        }
        self.levels[level][index] = key;
        key
    }

    /// Gives each cell the key of the larger cells around it where that is smaller.
    fn settle(&mut self) {
        let top = self.top();
        for level in (0..top).rev() {
            let (finer, coarser) = self.levels.split_at_mut(level + 1);
            let width = 1usize << (top - level);
            for (index, key) in finer[level].iter_mut().enumerate() {
                let (column, row) = (index % width, index / width);
                *key = key.min(coarser[0][(row / 2) * (width / 2) + column / 2]);
            }
        }
    }

    /// The largest key beyond which everything between two pixels is hidden.
    fn key_between(&self, low: DVec2, high: DVec2) -> f64 {
        let low = low.clamp(DVec2::ZERO, self.size);
        let high = high.clamp(DVec2::ZERO, self.size);
        let cells = ((high - low).max_element() / self.cell_px).max(1.0);
        // The logarithm, rounded up.
        let level = ((cells.ceil() as u32).next_power_of_two().trailing_zeros() as usize).min(self.top());
        let cell = self.cell_px * (1u32 << level) as f64;
        let last = (1usize << (self.top() - level)) - 1;
        let at = |px: f64| ((px / cell) as usize).min(last);
        let mut key = f64::NEG_INFINITY;
        for row in at(low.y)..=at(high.y) {
            for column in at(low.x)..=at(high.x) {
                key = key.max(self.levels[level][self.index(level, column, row)]);
            }
        }
        key
    }

    /// Whether everything between two pixels with at least this key is hidden.
    pub(in crate::lines) fn hides(&self, low: DVec2, high: DVec2, nearest_key: f64) -> bool {
        nearest_key > self.key_between(low, high)
    }

    /// Whether a straight line between two pixels with these keys is hidden all along.
    pub(in crate::lines) fn hides_line(&self, [from, to]: [(DVec2, f64); 2]) -> bool {
        let is_open_at = |(px, key): (DVec2, f64)| !self.hides(px, px, key);
        if is_open_at(from) || is_open_at(to) {
            return false;
        }
        let mut open = vec![[from, to]];
        while let Some([from, to]) = open.pop() {
            let (low, high) = (from.0.min(to.0), from.0.max(to.0));
            if self.hides(low, high, from.1.min(to.1)) {
                continue;
            }
            if (high - low).max_element() <= self.cell_px {
                return false;
            }
            let middle = ((from.0 + to.0) * 0.5, (from.1 + to.1) * 0.5);
            open.extend([[from, middle], [middle, to]]);
        }
        true
    }

    /// Returns for each face whether any part of it may be visible.
    pub(in crate::lines) fn seen(&self, space: &Space, faces: &Faces) -> Vec<bool> {
        let boxes = faces.tree.boxes();
        filled(boxes.len(), threads_for_items(boxes.len()), false, |place| {
            let [low, high] = boxes[place].corners();
            if !self.hides(low.truncate(), high.truncate(), low.z) {
                let is_small = (high - low).truncate().max_element() <= 2.0 * self.cell_px;
                let occluder = || Occluder::new(space, faces, place as u32);
                return is_small || occluder().is_none_or(|occluder| self.sees(&occluder, self.top(), 0, 0));
            }
            false
        })
    }

    fn sees(&self, occluder: &Occluder, level: usize, column: usize, row: usize) -> bool {
        let (middle, half) = self.rectangle(level, column, row);
        if half.min_element() <= 0.0 || !occluder.overlaps(middle, half) {
            return false;
        }
        if occluder.keys(middle, half)[0] > self.levels[level][self.index(level, column, row)] {
            return false;
        }
        let children = [(0, 0), (1, 0), (0, 1), (1, 1)];
        level == 0
            || children.iter().any(|(right, down)| self.sees(occluder, level - 1, column * 2 + right, row * 2 + down))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::scene::{Scene, SceneSettings};
    use glam::DVec3;
    use std::sync::Arc;

    #[test]
    fn going_down_from_where_a_face_lies_hides_what_going_down_from_the_top_does() {
        let mut state = 5u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        const FACES: u32 = 2_000;
        // From a hundredth of the scene to all of it.
        let corners = (0..FACES).flat_map(|face| {
            let size = 0.01f64.powf(f64::from(face) / f64::from(FACES));
            let place = DVec3::new(number(), number(), number());
            [(); 3].map(|()| place + DVec3::new(number(), number(), number()) * size)
        });
        let positions: Vec<DVec3> = corners.collect();
        let triangles = (0..FACES).map(|face| [face * 3, face * 3 + 1, face * 3 + 2]).collect();
        let file_vertices = (0..FACES * 3).collect();
        let (normals, triangle_normals) = (Vec::new(), Vec::new());
        let mesh = Mesh { positions, triangles, file_vertices, normals, triangle_normals, ..Mesh::triangle() };
        let size = "500x310".parse().unwrap();
        let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
        let space = Space::of(&scene);
        let faces = Faces::of(&space, &scene);
        let found = Pyramid::new(&space, &faces).unwrap();
        let mut occluders: Vec<Occluder> =
            (0..faces.triangles.len() as u32).filter_map(|place| Occluder::new(&space, &faces, place)).collect();
        occluders.sort_by(|a, b| a.nearest_key.total_cmp(&b.nearest_key));
        let levels =
            (0..=THRESHOLDS.cells).map(|level| vec![f64::INFINITY; 1 << (2 * (THRESHOLDS.cells - level))]).collect();
        let mut from_top = Pyramid { levels, cell_px: found.cell_px, size: found.size };
        from_top.leave_out_what_lies_beside_the_picture();
        occluders.iter().for_each(|occluder| {
            from_top.add(occluder, THRESHOLDS.cells, 0, 0, f64::INFINITY);
        });
        from_top.settle();
        let hidden = found.levels[0].iter().filter(|key| key.is_finite()).count();
        assert!(hidden > 10_000, "only {hidden} cells hide anything");
        assert_eq!(found.levels, from_top.levels);
    }
}
