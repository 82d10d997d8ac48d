//! The faces that no eye can reach in a view: those outside the picture, and those behind a layer of faces that has no end there.
//!
//! In: a scene, and how its driver draws. Out: for each object the faces to draw. Call an edge an *end* unless it has exactly two
//! faces, wound alike, that both surely point the same way in the picture: rims, folds and edge-on faces are ends. The picture is cut
//! into cells. A layer of faces that reaches into a cell in which it has no end covers all of the cell, because a path within the cell
//! can be followed on the layer and meets no end. So something lies there at most as far as the layer's farthest depth, and a face that
//! is behind such a depth in every cell that it touches owns no pixel.
//!
//! The depths of a layer in a cell are one interval. Each cell keeps a mask of depth bins that faces pointing to the eye touch, and a
//! second mask of those that surely reach into it. From the first sure bin the run of touched bins holds all of that layer. Where an
//! end is nearer than the run's end, the cell hides nothing.
//!
//! Margins: corners move by the driver's sub-pixels, depths by as much times their slope, by steps of the depth buffer, and by an
//! offset that pushes faces back.
//!
//! ```
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, hidden_faces::faces_not_hidden, load};
//!
//! let mesh = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([mesh], &SceneSettings::default())?;
//! let lists = faces_not_hidden(&scene, scene.size, 8, [0.0; 2], 1).unwrap();
//! assert!(lists[0].as_ref().is_some_and(|drawn| drawn.left_out > 0));
//! # Ok::<(), tinta_geometry::Error>(())
//! ```

use crate::culling::{DrawnFaces, moved, window_places, without};
use crate::edges::Incidence;
use crate::scene::{Object, Scene};
use crate::threads::{filled, in_parallel, threads_for_items};
use crate::values::Size;
use glam::{Mat4, Vec2, Vec3, Vec3Swizzles};
use std::ops::Range;
use std::sync::atomic::Ordering::Relaxed;

/// Side of a cell, pixels of the surface drawn into.
const CELL: f32 = 8.0;

/// How far around a cell its layers may have no end, pixels: more than corners move.
const MARGIN: f32 = 1.0;

/// Bins of depth in a cell.
const BINS: u32 = 64;

/// How far behind a depth a face must lie: two steps of a depth buffer of 16 bits.
const BEHIND: f32 = 1.0 / 32_768.0;

/// The most cells that faces may touch on average. Where faces are long and thin, looking at all cells costs more than drawing.
const MOST_CELLS: usize = 24;

/// How long a driver on the processor takes to draw a face, and the search to look at one on one thread, nanoseconds: measured on
/// llvmpipe, two cores.
const DRAWING_NS: f64 = 150.0;
const SEARCHING_NS: f64 = 90.0;

/// For how many views the search rests if it cost more than it saved.
const REST: u32 = 31;

/// The threads for so many faces or edges: each takes as long as several simple items.
fn threads(count: usize) -> usize {
    threads_for_items(4 * count)
}

/// Returns for each object the faces that may own a pixel, `None` where all may. Nothing is left out where a face reaches the near or
/// the far plane, or where faces are long and thin. `None` for all if the search rests, because an earlier one saved less than it cost.
///
/// `surface` is the size drawn into, pixels (the picture's times its supersampling); GL places vertices to 2^-`subpixel_bits` of a
/// pixel, pushes faces back by `polygon_offset` (glPolygonOffset's factor and units), and draws the objects `draws` times.
pub fn faces_not_hidden(
    scene: &Scene,
    surface: Size,
    subpixel_bits: u32,
    polygon_offset: [f32; 2],
    draws: usize,
) -> Option<Vec<Option<DrawnFaces>>> {
    let rest = &scene.hidden_faces_rest;
    rest.fetch_update(Relaxed, Relaxed, |views| views.checked_sub(1)).err()?;
    let lists = View::of(scene, surface, subpixel_bits, polygon_offset).lists(scene);
    let left_out: usize = lists.iter().flatten().map(|list| list.left_out).sum();
    let all = scene.triangle_count();
    if (left_out * draws) as f64 * DRAWING_NS < all as f64 * SEARCHING_NS / threads(all) as f64 {
        rest.store(REST, Relaxed);
    }
    Some(lists)
}

/// A view of a scene in the driver's coordinates.
struct View {
    size: Vec2,
    /// Columns and rows of cells.
    cells: [u16; 2],
    /// How far GL may have moved a corner, pixels.
    moved: f32,
    polygon_offset: [f32; 2],
    clip_from_view: Mat4,
}

/// An object's corners in the picture, and its faces in drawing order.
struct ObjectFaces {
    /// Pixels from the lower left corner, and depth from 0 to 1.
    places: Vec<Vec3>,
    faces: Vec<Face>,
    /// The side of each of the mesh's faces.
    sides: Vec<Side>,
}

/// The side of a face that the eye sees, if GL can see no other.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Front,
    Back,
    Unsure,
}

/// A face in the picture.
#[derive(Clone, Copy)]
struct Face {
    /// Its least depth without a polygon offset, and its largest with it, as a driver may have them.
    near: f32,
    far: f32,
    /// The first cell that it may touch and the one after the last, column and row.
    low: [u16; 2],
    high: [u16; 2],
    side: Side,
}

impl Face {
    fn rows(&self) -> Range<u16> {
        self.low[1]..self.high[1]
    }

    fn columns(&self) -> Range<u16> {
        self.low[0]..self.high[0]
    }

    fn cell_count(&self) -> usize {
        self.rows().len() * self.columns().len()
    }
}

impl View {
    fn lists(&self, scene: &Scene) -> Vec<Option<DrawnFaces>> {
        let mut grid = Grid::new(self);
        // An offset towards the eye may bring a face before its corners.
        let is_pulled = self.polygon_offset.iter().any(|offset| *offset < 0.0);
        let objects = || scene.objects.iter().map(|object| self.add_faces(scene, object, &mut grid)).collect();
        let found: Option<Vec<ObjectFaces>> = (!is_pulled).then(objects).flatten();
        let Some(objects) = found else { return vec![None; scene.objects.len()] };
        for (object, faces) in scene.objects.iter().zip(&objects) {
            self.add_ends(scene, object, faces, &mut grid);
        }
        let depths = grid.depths();
        let left = |(object, ObjectFaces { faces, .. }): (&Object, &ObjectFaces)| {
            let is_hidden =
                filled(faces.len(), threads(faces.len()), false, |face| self.is_hidden(&faces[face], &depths));
            let left_out = is_hidden.iter().filter(|is_hidden| **is_hidden).count();
            (left_out > 0).then(|| without(scene.arrays(object), &is_hidden, left_out))
        };
        scene.objects.iter().zip(&objects).map(left).collect()
    }

    fn of(scene: &Scene, surface: Size, subpixel_bits: u32, polygon_offset: [f32; 2]) -> Self {
        let size = Vec2::new(surface.width as f32, surface.height as f32);
        let cells = (size / CELL).ceil().to_array().map(|count| count as u16);
        let moved = moved(subpixel_bits, size * 0.5);
        Self { size, cells, moved, polygon_offset, clip_from_view: scene.clip_from_view() }
    }

    /// Finds an object's faces, and adds the depths of those that point to the eye; `None` where a corner lies beyond the near or far
    /// plane, or faces touch too many cells.
    fn add_faces(&self, scene: &Scene, object: &Object, grid: &mut Grid) -> Option<ObjectFaces> {
        let arrays = scene.arrays(object);
        let clip_from_object = self.clip_from_view * scene.view_from_object(object, arrays.centre);
        let places = window_places(arrays, clip_from_object, self.size * 0.5);
        let count = arrays.indices.len() / 3;
        let most_cells = MOST_CELLS * count.max(grid.ends.len()) / threads(count);
        let parts = in_parallel(count, threads(count), |range| {
            let (mut grid, mut cells) = (Grid::new(self), 0);
            let mut faces = Vec::with_capacity(range.len());
            for face in range {
                let corners = [0, 1, 2].map(|corner| places[arrays.indices[face * 3 + corner] as usize]);
                let face = self.face(corners);
                cells += face.cell_count();
                if corners.iter().any(|corner| corner.is_nan()) || cells > most_cells {
                    return None;
                }
                self.add_face(&face, corners, &mut grid);
                faces.push(face);
            }
            Some((faces, grid))
        });
        let mut faces = Vec::with_capacity(count);
        for part in parts {
            let (mut own, other) = part?;
            faces.append(&mut own);
            grid.add(&other);
        }
        let mut sides = vec![Side::Unsure; count];
        faces.iter().zip(&arrays.order).for_each(|(face, number)| sides[*number as usize] = face.side);
        Some(ObjectFaces { places, faces, sides })
    }

    fn face(&self, [a, b, c]: [Vec3; 3]) -> Face {
        let (first, second) = (b - a, c - a);
        let normal = first.cross(second);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        // What moving the corners may change of twice the area.
        let most = self.moved * (first.xy().abs().element_sum() + second.xy().abs().element_sum())
            + 4.0 * self.moved * self.moved;
        // More than a picture's width outside, each driver cuts faces off at different places.
        let is_cut =
            (low.xy() + 0.5 * self.size).min_element() < 0.0 || (high.xy() - 1.5 * self.size).max_element() > 0.0;
        let side = match normal.z {
            area if is_cut || area.abs() <= 2.0 * most => Side::Unsure,
            area if area > 0.0 => Side::Front,
            _ => Side::Back,
        };
        let slope = (normal.x.abs() + normal.y.abs()) / normal.z.abs();
        let [factor, units] = self.polygon_offset;
        // How far moved corners and an offset move its depths; a unit is no more than a step of 16 bits.
        let moves = [2.0 * slope * self.moved, factor * slope + units / 65_536.0];
        // A face without a slope may have any depth.
        let [sliding, offset] = if slope.is_finite() { moves } else { [1.0; 2] };
        let (low_cell, high_cell) = self.cells_of(low.xy(), high.xy());
        Face { near: low.z - sliding, far: high.z + sliding + offset, low: low_cell, high: high_cell, side }
    }

    /// The first cell that a box touches, its margin included, and the one after the last.
    fn cells_of(&self, low: Vec2, high: Vec2) -> ([u16; 2], [u16; 2]) {
        let (low, high) = (low - MARGIN, high + MARGIN);
        if high.min_element() < 0.0 || (low - self.size).max_element() > 0.0 {
            return ([0; 2], [0; 2]);
        }
        // A number below 0 becomes 0.
        let [low, high] = [low, high].map(|corner| (corner / CELL).to_array().map(|place| place as u16));
        (low, [0, 1].map(|axis| high[axis].saturating_add(1).min(self.cells[axis])))
    }

    fn index(&self, column: u16, row: u16) -> usize {
        usize::from(row) * usize::from(self.cells[0]) + usize::from(column)
    }

    fn add_face(&self, face: &Face, corners: [Vec3; 3], grid: &mut Grid) {
        if face.side == Side::Back {
            return;
        }
        let [a, b, c] = corners;
        let bits = bins(face.near, face.far);
        for row in face.rows() {
            for column in face.columns() {
                grid.touched[self.index(column, row)] |= bits;
            }
        }
        if face.side == Side::Unsure {
            return;
        }
        let middle = (a + b + c).xy() / 3.0;
        if middle.min_element() >= 0.0 && (self.size - middle).min_element() > 0.0 {
            let [column, row] = (middle / CELL).to_array().map(|place| place as u16);
            grid.sure[self.index(column, row)] |= bits;
        }
        if (a.max(b).max(c) - a.min(b).min(c)).xy().max_element() <= CELL {
            return;
        }
        // The middle of a cell lies in the face, wherever its corners moved.
        let is_inside = |place: Vec2| {
            [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
                let along = to.xy() - from.xy();
                along.perp_dot(place - from.xy()) > 2.0 * self.moved * (along.abs().element_sum() + 1.0)
            })
        };
        for row in face.rows() {
            for column in face.columns() {
                if is_inside((Vec2::new(f32::from(column), f32::from(row)) + 0.5) * CELL) {
                    grid.sure[self.index(column, row)] |= bits;
                }
            }
        }
    }

    /// Notes where an object's layers end.
    fn add_ends(&self, scene: &Scene, object: &Object, faces: &ObjectFaces, grid: &mut Grid) {
        let (list, arrays) = (scene.edges(object).list(), scene.arrays(object));
        let count = list.len();
        let nearest = in_parallel(count, threads(count), |edges| {
            let mut nearest = vec![f32::INFINITY; grid.ends.len()];
            for edge in edges {
                let sides = || list.faces(edge as u32).iter().map(|face| faces.sides[*face as usize]);
                let is_inner = list.incidence()[edge] == Incidence::Inner
                    && (sides().all(|side| side == Side::Front) || sides().all(|side| side == Side::Back));
                // Layers turned away hide nothing, so folds between them do not matter.
                if is_inner {
                    continue;
                }
                let [a, b] = list.positions()[edge]
                    .map(|position| faces.places[arrays.position_vertices[position as usize] as usize]);
                let (low, high) = self.cells_of(a.xy().min(b.xy()), a.xy().max(b.xy()));
                // An end belongs to its faces, which may seem nearer than its corners.
                let depth = a.z.min(b.z) - BEHIND;
                for row in low[1]..high[1] {
                    for column in low[0]..high[0] {
                        let cell = &mut nearest[self.index(column, row)];
                        *cell = cell.min(depth);
                    }
                }
            }
            nearest
        });
        for nearest in nearest {
            grid.ends.iter_mut().zip(nearest).for_each(|(cell, depth)| *cell = cell.min(depth));
        }
    }

    /// Whether a face is behind the known depth of every cell that it may touch.
    fn is_hidden(&self, face: &Face, depths: &[f32]) -> bool {
        let is_behind = |column: u16, row: u16| face.near - BEHIND > depths[self.index(column, row)];
        face.rows().all(|row| face.columns().all(|column| is_behind(column, row)))
    }
}

/// The bins from one depth to another.
fn bins(near: f32, far: f32) -> u64 {
    let bin = |depth: f32| ((depth * BINS as f32).clamp(0.0, (BINS - 1) as f32)) as u32;
    let (first, last) = (bin(near), bin(far));
    (u64::MAX >> (BINS - 1 - (last - first))) << first
}

/// The cells' layers.
struct Grid {
    /// The bins that faces touch which may point to the eye.
    touched: Vec<u64>,
    /// The bins of faces that surely reach into the cell and point to the eye.
    sure: Vec<u64>,
    /// The least depth of an end.
    ends: Vec<f32>,
}

impl Grid {
    fn new(view: &View) -> Self {
        let count = usize::from(view.cells[0]) * usize::from(view.cells[1]);
        Self { touched: vec![0; count], sure: vec![0; count], ends: vec![f32::INFINITY; count] }
    }

    fn add(&mut self, other: &Self) {
        self.touched.iter_mut().zip(&other.touched).for_each(|(own, other)| *own |= other);
        self.sure.iter_mut().zip(&other.sure).for_each(|(own, other)| *own |= other);
    }

    /// The depth at which something lies everywhere in each cell, at the latest.
    fn depths(&self) -> Vec<f32> {
        let depth = |((touched, sure), end): ((&u64, &u64), &f32)| {
            if *sure == 0 {
                return f32::INFINITY;
            }
            let first = sure.trailing_zeros();
            let run = (touched >> first).trailing_ones();
            let last = (first + run) as f32 / BINS as f32;
            if *end > last { last } else { f32::INFINITY }
        };
        self.touched.iter().zip(&self.sure).zip(&self.ends).map(depth).collect()
    }
}
