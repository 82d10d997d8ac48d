//! One view: which faces are surely back faces, and which of them are surrounded by such faces.

use super::backface::window_places;
use super::openings::Openings;
use super::selection::select;
use super::slivers::Slivers;
use super::{DrawnFaces, FACES_IN_A_BOX, Hiding, ObjectView, Sight, VERTICES_IN_A_BOX};
use crate::camera::Projection;
use crate::mesh::{NONE, VertexArrays};
use crate::threads::{in_parallel, threads_for};
use crate::tolerances::{HIDING_DEPTH, HIDING_DEPTH_STEPS, NEAR_PLANE_NOISE, SUBPIXEL_STEPS, SURELY_BACK};
use crate::values::Size;
use glam::{DVec2, DVec3, Vec3};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// When a face is surely a back face, by [`Sight`].
#[derive(Debug, Clone, Copy, PartialEq)]
struct View {
    sight: Sight,
    /// The eye, or in parallel projection the direction to it.
    eye: Vec3,
    /// A face is surely back if its plane's height over the eye, or the product of its normal and the direction, is more.
    least_back: f32,
    /// What GL may move a point by on the picture plane.
    margin: f64,
}

/// How steeply from behind a face is seen that a usual view leaves out, as a cosine.
const USUAL_COSINE: f32 = 0.05;

impl Hiding {
    /// The faces to draw of `object`, the one this was made of, on a surface of so many pixels (the picture's, times its
    /// supersampling), by a GL that places vertices to 2^-`subpixel_bits` of a pixel (GL_SUBPIXEL_BITS; 8 on Mesa, 4 at
    /// least). `None` where no face can be left out, or where nothing can be said of this view: a part of the object may lie
    /// before the near plane, or a pixel or a step of depth is too coarse for the mesh's faces.
    pub fn faces_to_draw(&self, seen: &ObjectView<'_>, surface: Size, subpixel_bits: u32) -> Option<DrawnFaces> {
        let arrays = seen.arrays;
        let is_made_of_it = arrays.indices.len() == self.planes.len() * 3;
        if self.counts.hideable_faces == 0 || !is_made_of_it {
            return None;
        }
        let view = self.view(seen, surface, subpixel_bits)?;
        // Through a cap that may show its front a ray may come in, and it is not drawn.
        let mut is_shut = vec![true; self.counts.shells];
        let open = self.caps.iter().filter(|cap| !view.is_surely_back(&cap.plane));
        open.clone().for_each(|cap| is_shut[cap.shell as usize] = false);
        let openings = Openings::new(&view.sight, open.map(|cap| cap.corners), view.margin);
        let threads = threads_for(self.planes.len());
        let is_marked: Vec<AtomicBool> = (0..self.point_count).map(|_| AtomicBool::new(false)).collect();
        let edge_on = in_parallel(self.planes.len(), threads, |faces| self.mark(&view, arrays, faces, &is_marked));
        let places = window_places(seen, surface, false);
        let places_of = |corners: &[u32]| [0, 1, 2].map(|corner| places[corners[corner] as usize]);
        let mut slivers = Slivers::new(surface);
        for face in edge_on.iter().flatten() {
            // One that may not be left out may hide others of its shell, whichever that is.
            slivers.add(places_of(&arrays.indices[*face as usize * 3..][..3]), self.shells[*face as usize]);
        }
        let may_show = openings.boxes_that_may_show(&view.sight, &self.face_boxes, threads);
        let is_kept = |face: usize, corners: &[u32]| {
            let is_marked = |vertex: &u32| is_marked[self.point(*vertex)].load(Ordering::Relaxed);
            match self.shells[face] {
                NONE => true,
                _ if corners.iter().any(is_marked) => true,
                shell if !is_shut[shell as usize] && may_show[face / FACES_IN_A_BOX] => true,
                shell => slivers.touch(places_of(corners), shell),
            }
        };
        let drawn = select(arrays, is_kept);
        (drawn.left_out > 0).then_some(drawn)
    }

    /// The mean share of faces that are left out from fourteen sides, percent: along the axes and the diagonals, from far away,
    /// without a look at holes and at faces seen edge-on.
    pub(super) fn usual_percent(&self, arrays: &VertexArrays) -> usize {
        if self.counts.hideable_faces == 0 {
            return 0;
        }
        let directions: Vec<Vec3> = (0..27)
            .map(|number| Vec3::new((number % 3) as f32, (number / 3 % 3) as f32, (number / 9) as f32) - 1.0)
            .filter(|direction| [1.0, 3.0].contains(&direction.length_squared()))
            .collect();
        let left_out = in_parallel(directions.len(), threads_for(self.planes.len() * directions.len()), |range| {
            let of_direction = |direction: &Vec3| {
                let towards_eye = direction.normalize();
                let is_back = |[x, y, z, _]: &[f32; 4]| Vec3::new(*x, *y, *z).dot(towards_eye) < -USUAL_COSINE;
                let mut is_marked = vec![false; self.point_count];
                for (plane, corners) in self.planes.iter().zip(arrays.indices.chunks_exact(3)) {
                    if !is_back(plane) {
                        corners.iter().for_each(|vertex| is_marked[self.point(*vertex)] = true);
                    }
                }
                let faces = self.shells.iter().zip(arrays.indices.chunks_exact(3));
                faces
                    .filter(|(shell, corners)| **shell != NONE && !corners.iter().any(|v| is_marked[self.point(*v)]))
                    .count()
            };
            directions[range].iter().map(of_direction).sum::<usize>()
        });
        left_out.iter().sum::<usize>() * 100 / (directions.len() * self.planes.len())
    }

    fn view(&self, seen: &ObjectView<'_>, surface: Size, subpixel_bits: u32) -> Option<View> {
        let ObjectView { arrays, camera, .. } = *seen;
        let is_parallel = matches!(camera.projection, Projection::Parallel { .. });
        let eye = (camera.eye - seen.offset - arrays.centre) / self.radius;
        let view_from_world = camera.view_from_world();
        let axes = [0, 1, 2].map(|row| view_from_world.row(row).truncate());
        let backward = axes[2];
        let half =
            self.vertex_boxes.iter().flatten().fold(DVec3::ZERO, |half, corner| half.max(corner.as_dvec3().abs()));
        let farthest_depth = backward.dot(eye) + backward.abs().dot(half);
        let farthest = (eye.abs() + half).length();
        let near = camera.near / self.radius + farthest * NEAR_PLANE_NOISE;
        let nearest_depth = self.nearest_depth(arrays, seen.scene_radius, eye, backward, near)?;
        let (tangent, whole_depth) = match camera.projection {
            Projection::Perspective { fov_y_degrees } => {
                let tangent = (fov_y_degrees.to_radians() * 0.5).tan() * farthest_depth;
                // Of all depth, which is as one over the distance, the part that a unit of distance is at the far side.
                let nearer = (1.0 / camera.near - 1.0 / camera.far) * self.radius;
                (tangent, nearer * farthest_depth.powi(2))
            }
            Projection::Parallel { height } => (height * 0.5 / self.radius, (camera.far - camera.near) / self.radius),
        };
        let pixel = 2.0 * tangent * (1.0 / f64::from(surface.height)).max(seen.aspect / f64::from(surface.width));
        let sideways = pixel * SUBPIXEL_STEPS * 0.5f64.powi(subpixel_bits.min(24) as i32);
        let depth = self.thickness * HIDING_DEPTH;
        let cosine = (2.0 * sideways / depth).max(*SURELY_BACK.start());
        // Along a slanted ray less of the distance is depth.
        let slant = if is_parallel { 1.0 } else { nearest_depth / farthest };
        let confused = whole_depth * HIDING_DEPTH_STEPS / f64::from(1 << 24);
        let is_fine =
            cosine <= *SURELY_BACK.end() && depth + 2.0 * sideways < self.thickness && confused < depth * slant;
        is_fine.then(|| View {
            sight: Sight { eye, axes, is_parallel },
            margin: if is_parallel { sideways } else { sideways / farthest_depth },
            eye: if is_parallel { backward } else { eye }.as_vec3(),
            least_back: (if is_parallel { cosine } else { cosine * farthest }) as f32,
        })
    }

    /// A depth that no vertex is nearer than and that is beyond `near`; `None` where one is not.
    fn nearest_depth(
        &self,
        arrays: &VertexArrays,
        scene_radius: f64,
        eye: DVec3,
        backward: DVec3,
        near: f64,
    ) -> Option<f64> {
        let unit = scene_radius / self.radius;
        let from_plane = backward.dot(eye);
        let mut nearest = f64::INFINITY;
        for ([low, high], vertices) in self.vertex_boxes.iter().zip(arrays.vertices.chunks(VERTICES_IN_A_BOX)) {
            let (low, high) = (low.as_dvec3(), high.as_dvec3());
            let most = (backward * low).max(backward * high).element_sum();
            let mut depth = from_plane - most;
            if depth <= near {
                let of_vertex = |[x, y, z, ..]: &[f32; 6]| backward.dot(Vec3::new(*x, *y, *z).as_dvec3()) * unit;
                depth = from_plane - vertices.iter().map(of_vertex).fold(f64::NEG_INFINITY, f64::max);
            }
            if depth.is_nan() || depth <= near {
                return None;
            }
            nearest = nearest.min(depth);
        }
        Some(nearest)
    }

    fn point(&self, vertex: u32) -> usize {
        self.points.get(vertex as usize).copied().unwrap_or(vertex) as usize
    }

    /// Marks the corners of faces that are not surely back, and returns those of them that are not surely front either.
    fn mark(&self, view: &View, arrays: &VertexArrays, faces: Range<usize>, is_marked: &[AtomicBool]) -> Vec<u32> {
        let corners = arrays.indices[faces.start * 3..faces.end * 3].chunks_exact(3);
        let mut edge_on = Vec::new();
        for ((face, plane), corners) in faces.clone().zip(&self.planes[faces]).zip(corners) {
            let height = view.height(plane);
            if height < -view.least_back {
                continue;
            }
            corners.iter().for_each(|vertex| is_marked[self.point(*vertex)].store(true, Ordering::Relaxed));
            // A face whose plane is no number counts as edge-on.
            if height <= view.least_back || height.is_nan() {
                edge_on.push(face as u32);
            }
        }
        edge_on
    }
}

impl View {
    fn is_surely_back(&self, plane: &[f32; 4]) -> bool {
        self.height(plane) < -self.least_back
    }

    /// How far before a face's plane the eye is; in parallel projection the product of its normal and the direction.
    fn height(&self, &[x, y, z, offset]: &[f32; 4]) -> f32 {
        let height = Vec3::new(x, y, z).dot(self.eye);
        if self.sight.is_parallel { height } else { height - offset }
    }
}

impl Sight {
    /// Where a point lies on the picture plane: its distances to the right and up, in perspective by its depth.
    pub(super) fn on_picture_plane(&self, point: DVec3) -> DVec2 {
        let [x, y, z] = self.axes.map(|axis| axis.dot(point - self.eye));
        let depth = if self.is_parallel { 1.0 } else { -z };
        if depth > 0.0 { DVec2::new(x, y) / depth } else { DVec2::NAN }
    }
}
