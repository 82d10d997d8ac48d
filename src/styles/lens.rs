//! Camera data that filters need to judge depth by the size of pixels.

use crate::camera::Projection;
use crate::plan::{Uniform, Value};
use crate::scene::{Scene, Size};

/// The angle between neighbouring pixels in the picture's middle, as a tangent; 0 in parallel projection.
fn pixel_angle(scene: &Scene, surface: Size) -> f64 {
    match scene.camera.projection {
        Projection::Perspective { fov_y_degrees } => {
            2.0 * (fov_y_degrees.to_radians() * 0.5).tan() / f64::from(surface.height)
        }
        Projection::Parallel { .. } => 0.0,
    }
}

/// Distances from the eye where a map's depth is 0 and 1, file units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DepthRange {
    near: f64,
    far: f64,
}

impl DepthRange {
    /// The camera's planes, for a map that takes its depth from the window.
    pub(super) fn of_camera(scene: &Scene) -> Self {
        Self { near: scene.camera.near, far: scene.camera.far }
    }

    /// The camera's planes, but no farther apart than the ball around the scene. Distant planes then do not waste a map's few
    /// bits on empty space. Fitted planes are closer than that, and stay.
    pub(super) fn of_scene(scene: &Scene) -> Self {
        let camera = &scene.camera;
        let middle = (scene.centre - camera.eye).dot(-camera.backward());
        let near = camera.near.max(middle - scene.radius);
        let far = camera.far.min(middle + scene.radius);
        if near < far { Self { near, far } } else { Self::of_camera(scene) }
    }

    /// `depthOfDistance`: at distance d, scene radii, depth is x + y / d + z d: in perspective window depth between these
    /// planes, which is linear in the picture wherever a surface is flat.
    pub(super) fn of_distance(self, scene: &Scene) -> Uniform {
        let (near, far) = (self.near / scene.radius, self.far / scene.radius);
        let range = far - near;
        let terms = match scene.camera.projection {
            Projection::Perspective { .. } => [far / range, -near * far / range, 0.0],
            Projection::Parallel { .. } => [-near / range, 0.0, 1.0 / range],
        };
        Uniform::new("depthOfDistance", Value::Vec3(terms.map(|term| term as f32)))
    }
}

/// `footprint`: a pixel's width on the surface is `x - y * depth` of depth between these planes.
///
/// In perspective with the planes n and f, window depth z is f / (f - n) (1 - n / d) at distance d, where a pixel at the
/// angle p is p d wide: as a step in z that is p (f / (f - n) - z).
pub(super) fn footprint(scene: &Scene, surface: Size, depth: DepthRange) -> Uniform {
    let range = depth.far - depth.near;
    let footprint = match scene.camera.projection {
        Projection::Perspective { .. } => {
            let angle = pixel_angle(scene, surface);
            [angle * depth.far / range, angle]
        }
        Projection::Parallel { height } => [height / f64::from(surface.height) / range, 0.0],
    };
    Uniform::new("footprint", Value::Vec2(footprint.map(|number| number as f32)))
}

/// `pixelAngle` and `middle`: a filter computes the ray through each pixel from them.
pub(super) fn rays(scene: &Scene, surface: Size) -> [Uniform; 2] {
    let middle = [surface.width as f32 * 0.5, surface.height as f32 * 0.5];
    [
        Uniform::new("pixelAngle", Value::Float(pixel_angle(scene, surface) as f32)),
        Uniform::new("middle", Value::PixelPlace(middle)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraSettings;
    use crate::mesh::Mesh;
    use crate::scene::SceneSettings;
    use glam::{DVec3, DVec4};
    use std::sync::Arc;

    #[test]
    fn depth_by_distance_is_window_depth_and_planes_far_apart_come_together_around_the_scene() {
        for parallel in [false, true] {
            let scene = |camera: CameraSettings| {
                let settings = SceneSettings { camera, ..SceneSettings::default() };
                Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap()
            };
            let fitted = scene(CameraSettings { parallel, ..CameraSettings::default() });
            assert_eq!(DepthRange::of_scene(&fitted), DepthRange::of_camera(&fitted));
            let clip_from_view = fitted.camera.clip_from_view(1.0);
            let Value::Vec3([x, y, z]) = DepthRange::of_scene(&fitted).of_distance(&fitted).value else { panic!() };
            for share in [0.0, 0.3, 1.0] {
                let distance = fitted.camera.near + share * (fitted.camera.far - fitted.camera.near);
                let expected = clip_from_view.project_point3(DVec3::new(0.0, 0.0, -distance)).z * 0.5 + 0.5;
                let radii = distance / fitted.radius;
                let found = f64::from(x) + f64::from(y) / radii + f64::from(z) * radii;
                assert!((found - expected).abs() < 1e-5, "{parallel} {share}: {found} {expected}");
            }
            let apart =
                scene(CameraSettings { parallel, near: Some(1e-3), far: Some(1e3), ..CameraSettings::default() });
            let range = DepthRange::of_scene(&apart);
            assert!((range.far - range.near - 2.0 * apart.radius).abs() < 1e-9, "{range:?}");
        }
    }

    #[test]
    fn a_footprint_is_the_step_in_depth_of_a_step_as_long_as_a_pixel_is_wide() {
        for parallel in [false, true] {
            let camera = CameraSettings { parallel, ..CameraSettings::default() };
            let settings = SceneSettings { camera, ..SceneSettings::default() };
            let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap();
            let camera = &scene.camera;
            let clip_from_view = camera.clip_from_view(1.0);
            let depth = |z: f64| clip_from_view.project_point3(DVec3::new(0.0, 0.0, z)).z * 0.5 + 0.5;
            for share in [0.1, 0.5, 0.9] {
                let z = -(camera.near + share * (camera.far - camera.near));
                // One pixel wide: the length at this distance of a step of 2 / 512 in the picture.
                let width = 2.0 / 512.0 * (clip_from_view * DVec4::new(0.0, 0.0, z, 1.0)).w / clip_from_view.y_axis.y;
                let step = (depth(z - width * 1e-3) - depth(z + width * 1e-3)) / 2e-3;
                let Value::Vec2([x, y]) = footprint(&scene, scene.size, DepthRange::of_camera(&scene)).value else {
                    panic!("two numbers")
                };
                let found = f64::from(x) - f64::from(y) * depth(z);
                assert!((found / step - 1.0).abs() < 1e-4, "{parallel} {share}: {found} {step}");
            }
        }
    }
}
