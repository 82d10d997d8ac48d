//! The faces that no eye can reach in a view: those that cover no pixel's centre, and those behind others at every centre they cover.
//!
//! In: a scene, and how its driver draws. Out: for each object the faces to draw. A driver gives a pixel to the nearest of the faces
//! that cover its centre. So one depth is kept for each centre: the nearest of the faces that surely cover it, taken as far away as
//! the driver may draw them. A face that is behind it, taken as near as the driver may draw it, at every centre that it may cover,
//! owns no pixel. Soups and open sheets do as well as closed meshes.
//!
//! Margins: corners move by the driver's sub-pixels, depths by as much times their slope, by rounding, by steps of the depth buffer,
//! and by an offset that pushes faces back.
//!
//! ```
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, hidden_faces::faces_not_hidden, load};
//!
//! let mesh = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([mesh], &SceneSettings::default())?;
//! let (lists, _) = faces_not_hidden(&scene, scene.size, 8, [0.0; 2], 1);
//! assert!(lists[0].as_ref().is_some_and(|drawn| drawn.left_out > 0));
//! # Ok::<(), tinta_geometry::Error>(())
//! ```

use crate::culling::{DrawnFaces, moved, window_places, without};
use crate::scene::Scene;
use crate::threads::{each_piece, filled, listed, threads_for_items};
use crate::values::Size;
use glam::{Mat4, Vec2, Vec3, Vec3Swizzles, Vec4};
use std::ops::Range;

/// How far behind a depth a face must lie: two steps of a depth buffer of 16 bits.
const BEHIND: f32 = 1.0 / 32_768.0;

/// Some of f32's last places, as a share: of a corner's place for each of the far plane's distances over the near plane's, and of the
/// slope of a face for each of its lengths over its width.
const ROUNDING: f32 = 1e-6;

/// The most pixels that the boxes of faces may hold on average. Where faces are long and thin, looking at all costs more than drawing.
const MOST_PIXELS: usize = 4000;

/// One thread looks at five faces while a driver on the processor draws four; starting threads takes it as long as looking at so many
/// faces more. `cargo bench --bench performance -- --only search` measures the ratio.
const SEARCHED: usize = 5;
const DRAWN: usize = 4;
const STARTING: usize = 3_750;

/// The centres of a row that are computed together.
const GROUP: usize = 4;

/// The threads for so many faces and pixels of their boxes: a face takes as long as several simple items, a pixel less than one.
fn threads(faces: usize, pixels: usize) -> usize {
    threads_for_items(8 * faces + pixels / 8)
}

/// Returns for each object the faces that may own a pixel, `None` where all may. A face that reaches the near or the far plane stays,
/// and all do where faces are long and thin. And whether so many go that the search is worth it: by counts alone.
///
/// `surface` is the size drawn into, pixels (the picture's times its supersampling); GL places vertices to 2^-`subpixel_bits` of a
/// pixel, pushes faces back by `polygon_offset` (glPolygonOffset's factor and units), and draws the objects `draws` times.
pub fn faces_not_hidden(
    scene: &Scene,
    surface: Size,
    subpixel_bits: u32,
    polygon_offset: [f32; 2],
    draws: usize,
) -> (Vec<Option<DrawnFaces>>, bool) {
    let view = View::of(scene, surface, subpixel_bits, polygon_offset);
    let Some(lists) = view.and_then(|view| view.find(scene)) else {
        return (vec![None; scene.objects.len()], true);
    };
    let left_out: usize = lists.iter().flatten().map(|drawn| drawn.left_out).sum();
    let faces = scene.triangle_count();
    let threads = threads(faces, 0);
    let searched = faces / threads + if threads > 1 { STARTING } else { 0 };
    (lists, left_out * draws * SEARCHED >= searched * DRAWN)
}

/// A view of a scene in the driver's coordinates.
struct View {
    /// The surface, pixels: columns and rows.
    size: [u16; 2],
    half: Vec2,
    /// How far GL may have moved a corner, pixels.
    moved: f32,
    polygon_offset: [f32; 2],
    clip_from_view: Mat4,
}

/// A face that may cover the centre of a pixel.
#[derive(Clone, Copy)]
struct Face {
    /// Its place in drawing order.
    number: u32,
    /// The first column and row whose centres it may cover and the ones after the last: none for a face that stays in any case.
    low: [u16; 2],
    high: [u16; 2],
    /// Whether it points to the eye. Layers turned away lie behind others, or are rare.
    hides: bool,
}

impl Face {
    /// The centres in its box.
    fn pixels(&self) -> usize {
        usize::from(self.high[0] - self.low[0]) * usize::from(self.high[1] - self.low[1])
    }

    /// The columns of its groups of centres.
    fn columns(&self) -> Range<usize> {
        let low = usize::from(self.low[0]);
        low..low + usize::from(self.high[0] - self.low[0]).next_multiple_of(GROUP)
    }
}

/// An object's corners in the picture, pixels from the lower left corner and depth from 0 to 1, and the faces that may be seen.
struct ObjectFaces<'a> {
    indices: &'a [u32],
    places: Vec<Vec3>,
    faces: Vec<Face>,
}

fn corners(indices: &[u32], places: &[Vec3], face: u32) -> [Vec3; 3] {
    [0, 1, 2].map(|corner| places[indices[face as usize * 3 + corner] as usize])
}

/// The part of a face at the centres of pixels: to hide, and then it is taken as far away and as small as a driver may draw it; or to
/// be hidden, and then it is taken as near and as large.
#[derive(Clone, Copy)]
enum Role {
    Hides,
    IsHidden,
}

/// A face's depth and its three borders, positive inside, as linear functions in the picture.
struct Plane {
    /// Where they have the value `start`.
    origin: Vec2,
    start: Vec4,
    by_column: Vec4,
    by_row: Vec4,
}

impl View {
    /// `None` for a surface larger than any driver's.
    fn of(scene: &Scene, surface: Size, subpixel_bits: u32, polygon_offset: [f32; 2]) -> Option<Self> {
        let size = [u16::try_from(surface.width).ok()?, u16::try_from(surface.height).ok()?];
        let half = Vec2::from(size.map(f32::from)) * 0.5;
        let depths = (scene.camera.far / scene.camera.near) as f32;
        let moved = moved(subpixel_bits) + ROUNDING * depths * half.max_element();
        Some(Self { size, half, moved, polygon_offset, clip_from_view: scene.clip_from_view() })
    }

    fn find(&self, scene: &Scene) -> Option<Vec<Option<DrawnFaces>>> {
        // An offset towards the eye may bring a face before its corners.
        if self.polygon_offset.iter().any(|offset| *offset < 0.0) {
            return None;
        }
        let found = scene.objects.iter().map(|object| {
            let arrays = scene.arrays(object);
            let clip_from_object = self.clip_from_view * scene.view_from_object(object, arrays.centre);
            self.faces(&arrays.indices, window_places(arrays, clip_from_object, self.half))
        });
        let objects: Vec<ObjectFaces<'_>> = found.collect::<Option<_>>()?;
        let all = scene.triangle_count();
        let pixels: usize = objects.iter().flat_map(|object| &object.faces).map(Face::pixels).sum();
        let depths = self.depths(&objects, threads(all, pixels));
        let lists = scene.objects.iter().zip(&objects).map(|(object, ObjectFaces { indices, places, faces })| {
            let may_be_seen = filled(faces.len(), threads(all, pixels), false, |index| {
                let face = &faces[index];
                self.may_be_seen(face, corners(indices, places, face.number), &depths)
            });
            let mut is_hidden = vec![true; indices.len() / 3];
            for (face, _) in faces.iter().zip(may_be_seen).filter(|(_, may_be_seen)| *may_be_seen) {
                is_hidden[face.number as usize] = false;
            }
            let left_out = is_hidden.iter().filter(|is_hidden| **is_hidden).count();
            (left_out > 0).then(|| without(scene.arrays(object), &is_hidden, left_out))
        });
        Some(lists.collect())
    }

    /// The faces that may cover the centre of a pixel; `None` where they are long and thin.
    fn faces<'a>(&self, indices: &'a [u32], places: Vec<Vec3>) -> Option<ObjectFaces<'a>> {
        let count = indices.len() / 3;
        let faces = listed(count, 1, threads(count, 0), |range, faces| {
            let mut pixels = usize::from(self.size[0]) * usize::from(self.size[1]) + MOST_PIXELS * range.len();
            for number in range {
                if let Some(face) = self.face(number as u32, corners(indices, &places, number as u32)) {
                    pixels = pixels.checked_sub(face.pixels())?;
                    faces.push(face);
                }
            }
            Some(())
        })?;
        Some(ObjectFaces { indices, places, faces })
    }

    /// `None` for a face that covers no centre.
    fn face(&self, number: u32, corners: [Vec3; 3]) -> Option<Face> {
        let stays = Face { number, low: [0; 2], high: [0; 2], hides: false };
        let [a, b, c] = corners.map(Vec3::xy);
        // A corner beyond the near or the far plane has no place.
        if corners.iter().any(|corner| corner.is_nan()) {
            return Some(stays);
        }
        let (low, high) = (a.min(b).min(c) - self.moved, a.max(b).max(c) + self.moved);
        if high.min_element() < 0.0 || (low - 2.0 * self.half).max_element() > 0.0 {
            return None;
        }
        // More than a picture's width outside, each driver cuts faces off at different places.
        if (low + self.half).min_element() < 0.0 || (high - 3.0 * self.half).max_element() > 0.0 {
            return Some(stays);
        }
        // A number below 0 becomes 0.
        let first = (low + 0.5).to_array().map(|place| place as u16);
        let end = (high + 0.5).to_array().map(|place| place as u16);
        let end = [0, 1].map(|axis| end[axis].min(self.size[axis]));
        (first[0] < end[0] && first[1] < end[1]).then_some(Face {
            low: first,
            high: end,
            hides: (b - a).perp_dot(c - a) > 0.0,
            ..stays
        })
    }

    /// `None` for a face seen from its edge, whose plane has no known slope.
    fn plane(&self, [a, b, c]: [Vec3; 3], role: Role) -> Option<Plane> {
        let (first, second) = (b - a, c - a);
        let normal = first.cross(second);
        let length = first.xy().abs().element_sum() + second.xy().abs().element_sum();
        // What moving the corners may change of twice the area.
        let most = self.moved * length + 4.0 * self.moved * self.moved;
        if normal.z.abs() <= 2.0 * most {
            return None;
        }
        let growth = -normal.xy() / normal.z;
        let slope = growth.abs().element_sum();
        let slides = slope * (2.0 * self.moved + ROUNDING * length * length * length / normal.z.abs());
        let [factor, units] = self.polygon_offset;
        let sides = [first.xy(), second.xy() - first.xy(), -second.xy()].map(|along| along * normal.z.signum());
        let [of_a, of_b, of_c] = sides.map(|along| self.moved * (along.abs().element_sum() + 1.0));
        let slack = Vec4::new(0.0, of_a, of_b, of_c);
        let start = Vec4::new(a.z, 0.0, sides[1].perp_dot(-first.xy()), 0.0);
        let start = match role {
            // A unit is no more than a step of 16 bits.
            Role::Hides => start - slack + Vec4::X * (slides + factor * slope + units / 65_536.0),
            Role::IsHidden => start + slack - Vec4::X * (slides + BEHIND),
        };
        let by_column = Vec4::new(growth.x, -sides[0].y, -sides[1].y, -sides[2].y);
        let by_row = Vec4::new(growth.y, sides[0].x, sides[1].x, sides[2].x);
        Some(Plane { origin: a.xy(), start, by_column, by_row })
    }

    /// The floats of a row of depths: rows are read and written by groups of four.
    fn stride(&self) -> usize {
        usize::from(self.size[0]) + GROUP - 1
    }

    /// The depth at which something is seen at the centre of each pixel, at the latest.
    fn depths(&self, objects: &[ObjectFaces<'_>], threads: usize) -> Vec<f32> {
        let mut depths = vec![f32::MAX; self.stride() * usize::from(self.size[1])];
        let mut rows: Vec<&mut [f32]> = depths.chunks_mut(self.stride()).collect();
        each_piece(&mut rows, threads, 2 * threads, |first, rows| {
            for object in objects {
                for face in object.faces.iter().filter(|face| face.hides) {
                    let low = usize::from(face.low[1]).max(first);
                    let high = usize::from(face.high[1]).min(first + rows.len());
                    if low >= high {
                        continue;
                    }
                    let Some(plane) = self.plane(corners(object.indices, &object.places, face.number), Role::Hides)
                    else {
                        continue;
                    };
                    for row in low..high {
                        let depths = rows[row - first][face.columns()].chunks_exact_mut(GROUP);
                        for (known, depth) in depths.zip(plane.row(face.low[0], row)) {
                            depth.min(Vec4::from_slice(known)).write_to_slice(known);
                        }
                    }
                }
            }
        });
        depths
    }

    /// Whether a face is not behind the known depth of every centre that it may cover.
    fn may_be_seen(&self, face: &Face, corners: [Vec3; 3], depths: &[f32]) -> bool {
        if face.low == face.high {
            return true;
        }
        let Some(plane) = self.plane(corners, Role::IsHidden) else { return true };
        (face.low[1]..face.high[1]).map(usize::from).any(|row| {
            let depths = depths[row * self.stride()..][face.columns()].chunks_exact(GROUP);
            depths.zip(plane.row(face.low[0], row)).any(|(known, depth)| depth.cmple(Vec4::from_slice(known)).any())
        })
    }
}

impl Plane {
    /// The depths at a row's centres, by groups that start at a column, infinite outside the face.
    fn row(&self, column: u16, row: usize) -> impl Iterator<Item = Vec4> {
        let start = self.start + self.by_row * (row as f32 + 0.5 - self.origin.y);
        let first = Vec4::new(0.5, 1.5, 2.5, 3.5) + (f32::from(column) - self.origin.x);
        let function = |number: usize| (Vec4::splat(start[number]), Vec4::splat(self.by_column[number]));
        let [depth, a, b, c] = [0, 1, 2, 3].map(function);
        (0_u16..).map(move |group| {
            let x = first + f32::from(group) * GROUP as f32;
            let at = |(start, growth): (Vec4, Vec4)| start + growth * x;
            let is_inside = at(a).cmpgt(Vec4::ZERO) & at(b).cmpgt(Vec4::ZERO) & at(c).cmpgt(Vec4::ZERO);
            Vec4::select(is_inside, at(depth), Vec4::INFINITY)
        })
    }
}
