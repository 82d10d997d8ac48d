//! The extent of a scene in the picture: objects outside it, and pixels that the others can touch.
//!
//! Input: the vertices for GL, grouped in boxes of neighbours. The answers are conservative: "perhaps" may be too
//! frequent, "no" is always right. They are computed in f64 with the same matrices.

use super::{Object, Rectangle, Scene, Size};
use crate::tolerances::{CLIP_ROUNDING, WINDOW_ROUNDING_PX};
use glam::{DMat4, DVec3, DVec4};

impl Scene {
    /// Whether the object, including lines or points of this width along its edges, is certainly outside the picture.
    pub fn is_outside(&self, object: &Object, width_px: f32) -> bool {
        // Half the width plus a pixel beyond the picture's border, as a share of half the picture.
        let beyond = [self.size.width, self.size.height].map(|side| (f64::from(width_px) + 2.0) / f64::from(side));
        let limits = DVec3::new(1.0 + beyond[0], 1.0 + beyond[1], 1.0) * (1.0 + CLIP_ROUNDING);
        // For each axis and direction, whether all corners lie beyond it: right, left, above, below, far, near.
        let mut all_beyond = [true; 6];
        for corner in self.corners_in_clip_space(object) {
            for axis in 0..3 {
                let limit = limits[axis] * corner.w;
                // Behind the eye w is negative and the limits swap sides, so such a point is inside none.
                all_beyond[axis * 2] &= corner[axis] > limit;
                all_beyond[axis * 2 + 1] &= corner[axis] < -limit;
            }
        }
        all_beyond.contains(&true)
    }

    /// The pixels of a surface of this size that faces of these objects can touch; `None` for none, the whole surface
    /// if a box reaches behind the eye.
    pub fn extent_px<'a>(&self, objects: impl Iterator<Item = &'a Object>, surface: Size) -> Option<Rectangle> {
        let whole = [f64::from(surface.width), f64::from(surface.height)];
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for object in objects {
            for corner in self.corners_in_clip_space(object) {
                // A box beside or behind the eye is unbounded in the picture. The near plane only cuts off nearer
                // parts.
                if corner.w <= 0.0 {
                    return Some(Rectangle { x: 0, y: 0, width: surface.width, height: surface.height });
                }
                for axis in 0..2 {
                    let place = (corner[axis] / corner.w * 0.5 + 0.5) * whole[axis];
                    low[axis] = low[axis].min(place);
                    high[axis] = high[axis].max(place);
                }
            }
        }
        let first = |axis: usize| (low[axis] - WINDOW_ROUNDING_PX).clamp(0.0, whole[axis]).floor() as u32;
        let last = |axis: usize| (high[axis] + WINDOW_ROUNDING_PX).clamp(0.0, whole[axis]).ceil() as u32;
        let [x, y] = [0, 1].map(first);
        let [width, height] = [last(0).saturating_sub(x), last(1).saturating_sub(y)];
        (width > 0 && height > 0).then_some(Rectangle { x, y, width, height })
    }

    /// The corners of an object's boxes, in clip space.
    fn corners_in_clip_space<'a>(&self, object: &'a Object) -> impl Iterator<Item = DVec4> + use<'a> {
        let centre = self.arrays(object).centre;
        let clip_from_object: DMat4 =
            self.clip_from_view().as_dmat4() * self.view_from_object(object, centre).as_dmat4();
        self.boxes(object).iter().flat_map(move |[low, high]| {
            (0..8).map(move |corner| {
                let pick = |axis: usize| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] };
                clip_from_object * DVec4::new(pick(0).into(), pick(1).into(), pick(2).into(), 1.0)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::{CameraSettings, View};
    use crate::mesh::Mesh;
    use crate::scene::{Rectangle, Scene, SceneSettings, Size};
    use glam::DVec3;
    use std::sync::Arc;

    fn scene(camera: CameraSettings, copies: u32) -> Scene {
        let settings = SceneSettings { camera, copies, ..SceneSettings::default() };
        Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap()
    }

    #[test]
    fn the_extent_is_the_triangles_box_in_the_picture() {
        let view = View { azimuth_degrees: 0.0, elevation_degrees: 0.0 };
        let scene = scene(CameraSettings { view, parallel: true, ..CameraSettings::default() }, 1);
        let extent = scene.extent_px(scene.objects.iter(), scene.size).unwrap();
        // The triangle's bounding box is a square; fitted, it fills 92 % of the picture, and each end may add a
        // pixel.
        let side = 512.0 * crate::tolerances::FRAME_FILL;
        for (first, length) in [(extent.x, extent.width), (extent.y, extent.height)] {
            assert!((f64::from(length) - side).abs() <= 2.5, "{extent:?}");
            assert!((f64::from(first) - (512.0 - side) * 0.5).abs() <= 1.5, "{extent:?}");
        }
    }

    #[test]
    fn every_projected_vertex_lies_in_the_extent() {
        for azimuth_degrees in [0.0, 33.0, 90.0, 200.0] {
            let view = View { azimuth_degrees, elevation_degrees: 20.0 };
            let scene = scene(CameraSettings { view, ..CameraSettings::default() }, 3);
            let Rectangle { x, y, width, height } = scene.extent_px(scene.objects.iter(), scene.size).unwrap();
            for object in &scene.objects {
                let clip = scene.clip_from_view() * scene.view_from_object(object, scene.arrays(object).centre);
                for vertex in &scene.arrays(object).vertices {
                    let place = clip.project_point3(glam::Vec3::from_slice(vertex)) * 256.0 + 256.0;
                    assert!(place.x >= x as f32 && place.x <= (x + width) as f32, "{place} {x} {width}");
                    assert!(place.y >= y as f32 && place.y <= (y + height) as f32, "{place} {y} {height}");
                }
            }
        }
    }

    #[test]
    fn objects_beside_and_behind_the_picture_are_outside_and_those_in_it_are_not() {
        let looking = |eye: DVec3, target: DVec3| {
            let settings = CameraSettings { eye: Some(eye), target: Some(target), ..CameraSettings::default() };
            let scene = scene(CameraSettings { near: Some(0.01), far: Some(100.0), ..settings }, 1);
            (scene.is_outside(&scene.objects[0], 0.0), scene.extent_px(scene.objects.iter(), scene.size))
        };
        let (outside, extent) = looking(DVec3::new(0.3, 0.3, 5.0), DVec3::new(0.3, 0.3, 0.0));
        assert!(!outside && extent.is_some());
        assert!(looking(DVec3::new(0.3, 0.3, 5.0), DVec3::new(30.0, 0.3, 0.0)).0, "beside");
        assert!(looking(DVec3::new(0.3, 0.3, 5.0), DVec3::new(0.3, 0.3, 9.0)).0, "behind the eye");
        let whole = Rectangle { x: 0, y: 0, width: 512, height: 512 };
        let (outside, extent) = looking(DVec3::new(0.3, -1.0, 0.001), DVec3::new(0.3, 0.3, 0.0));
        assert!(!outside && extent.is_none_or(|extent| extent.pixel_count() <= whole.pixel_count()));
    }

    #[test]
    fn a_wide_line_reaches_in_from_outside() {
        // The triangle's nearest edge lies 3 pixels beyond the right border in parallel projection.
        let view = View { azimuth_degrees: 0.0, elevation_degrees: 0.0 };
        let mut scene = scene(CameraSettings { view, parallel: true, ..CameraSettings::default() }, 1);
        let crate::camera::Projection::Parallel { height } = scene.camera.projection else { panic!("parallel") };
        let shift = DVec3::X * (height * 0.5 + 3.0 * height / 512.0);
        scene.camera.target = DVec3::new(0.0, 0.5, 0.0) - shift;
        scene.camera.eye = scene.camera.target + DVec3::Z * 5.0;
        (scene.camera.near, scene.camera.far) = (1.0, 10.0);
        assert!(scene.is_outside(&scene.objects[0], 0.0));
        assert!(!scene.is_outside(&scene.objects[0], 8.0));
    }

    #[test]
    fn a_rectangle_grows_to_the_surface_and_no_further() {
        let size = Size { width: 10, height: 8 };
        let small = Rectangle { x: 1, y: 6, width: 4, height: 1 };
        assert_eq!(small.grown(2, size), Rectangle { x: 0, y: 4, width: 7, height: 4 });
        assert_eq!(small.grown(u32::MAX, size), Rectangle { x: 0, y: 0, width: 10, height: 8 });
    }
}
