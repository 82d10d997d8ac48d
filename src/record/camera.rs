//! A camera in numbers.

use crate::camera::Projection;
use crate::scene::Scene;
use serde::Serialize;

/// A camera in numbers; lengths in file units, matrices as 16 numbers column by column.
#[derive(Debug, Clone, Serialize)]
pub struct CameraRecord {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Full vertical angle; `null` in parallel projection.
    fov_y_degrees: Option<f64>,
    /// Height of the picture in parallel projection; `null` in perspective.
    parallel_height: Option<f64>,
    near: f64,
    far: f64,
    view_from_world: [f64; 16],
    clip_from_view: [f64; 16],
}

impl CameraRecord {
    /// Returns the camera of a scene.
    pub fn new(scene: &Scene) -> Self {
        let camera = &scene.camera;
        let (fov_y_degrees, parallel_height) = match camera.projection {
            Projection::Perspective { fov_y_degrees } => (Some(fov_y_degrees), None),
            Projection::Parallel { height } => (None, Some(height)),
        };
        Self {
            eye: camera.eye.to_array(),
            target: camera.target.to_array(),
            up: camera.up.to_array(),
            fov_y_degrees,
            parallel_height,
            near: camera.near,
            far: camera.far,
            view_from_world: camera.view_from_world().to_cols_array(),
            clip_from_view: camera.clip_from_view(scene.size.aspect()).to_cols_array(),
        }
    }
}
