//! What filters need to know of the camera to judge depth by the size of pixels.

use crate::camera::Projection;
use crate::plan::{Uniform, Value};
use crate::scene::{Scene, Size};

/// The angle from pixel to pixel in the picture's middle, as a tangent; 0 in parallel projection.
fn pixel_angle(scene: &Scene, surface: Size) -> f64 {
    match scene.camera.projection {
        Projection::Perspective { fov_y_degrees } => {
            2.0 * (fov_y_degrees.to_radians() * 0.5).tan() / f64::from(surface.height)
        }
        Projection::Parallel { .. } => 0.0,
    }
}

/// `footprint`: a pixel's width on the surface is `x - y * depth` of window depth.
///
/// In perspective with the planes n and f, window depth z is f / (f - n) (1 - n / d) at distance d, where a pixel at the
/// angle p is p d wide: as a step in z that is p (f / (f - n) - z).
pub(super) fn footprint(scene: &Scene, surface: Size) -> Uniform {
    let camera = &scene.camera;
    let range = camera.far - camera.near;
    let footprint = match camera.projection {
        Projection::Perspective { .. } => {
            let angle = pixel_angle(scene, surface);
            [angle * camera.far / range, angle]
        }
        Projection::Parallel { height } => [height / f64::from(surface.height) / range, 0.0],
    };
    Uniform { name: "footprint", value: Value::Vec2(footprint.map(|number| number as f32)) }
}

/// `pixelAngle` and `middle`: from them a filter has the ray through each pixel.
pub(super) fn rays(scene: &Scene, surface: Size) -> [Uniform; 2] {
    let middle = [surface.width as f32 * 0.5, surface.height as f32 * 0.5];
    [
        Uniform { name: "pixelAngle", value: Value::Float(pixel_angle(scene, surface) as f32) },
        Uniform { name: "middle", value: Value::Vec2(middle) },
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
                // As wide as a pixel: what a step of 2 / 512 in the picture is at this distance.
                let width = 2.0 / 512.0 * (clip_from_view * DVec4::new(0.0, 0.0, z, 1.0)).w / clip_from_view.y_axis.y;
                let step = (depth(z - width * 1e-3) - depth(z + width * 1e-3)) / 2e-3;
                let Value::Vec2([x, y]) = footprint(&scene, scene.size).value else { panic!("two numbers") };
                let found = f64::from(x) - f64::from(y) * depth(z);
                assert!((found / step - 1.0).abs() < 1e-4, "{parallel} {share}: {found} {step}");
            }
        }
    }
}
