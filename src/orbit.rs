//! The viewer's camera: turned, moved and zoomed by hand, and converted to camera settings.
//!
//! Takes degrees, shares of the picture's height and a zoom; returns [`CameraSettings`], the same as those of `--view`, or after
//! a move or zoom those of `--eye`, `--target`, `--up` and `--height`.
//!
//! ```
//! use tinta::orbit::Orbit;
//!
//! let mut orbit = Orbit::default();
//! orbit.turn(0.25, 0.0);
//! assert_eq!(orbit.view.azimuth_degrees, -15.0);
//! ```

use crate::camera::{Camera, CameraSettings, Projection, View};
use crate::error::Result;
use crate::scene::{Scene, SceneSettings};
use glam::DVec3;

/// The eye on a sphere around the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// From where.
    pub view: View,
    /// How many times as large as fitted the scene is shown where the target is.
    pub zoom: f64,
    /// How far the picture's middle is from the scene's, to the right and up, shares of the fitted picture's height.
    pub pan: [f64; 2],
    /// Parallel instead of perspective projection.
    pub parallel: bool,
    /// Vertical field of view, degrees.
    pub fov_y_degrees: f64,
}

/// Least and most zoom: beyond, depth has too few steps or the scene is a dot.
const ZOOM: [f64; 2] = [0.05, 50.0];

/// Farthest the picture's middle is moved, shares of the fitted picture's height.
const FARTHEST_PAN: f64 = 2.0;

/// Degrees that a drag over the whole height of a picture turns.
const DEGREES_A_HEIGHT: f64 = 180.0;

impl Default for Orbit {
    fn default() -> Self {
        let CameraSettings { view, parallel, fov_y_degrees, .. } = CameraSettings::default();
        Self { view, zoom: 1.0, pan: [0.0; 2], parallel, fov_y_degrees }
    }
}

impl Orbit {
    /// Turns by a drag to the right and down, shares of the picture's height: the surface follows the pointer.
    pub fn turn(&mut self, right: f64, down: f64) {
        let View { azimuth_degrees, elevation_degrees } = self.view;
        self.view = View {
            azimuth_degrees: rounded(wrapped(azimuth_degrees - right * DEGREES_A_HEIGHT), ANGLE_STEP),
            elevation_degrees: rounded((elevation_degrees + down * DEGREES_A_HEIGHT).clamp(-90.0, 90.0), ANGLE_STEP),
        };
    }

    /// Moves the scene with a drag to the right and down, shares of the picture's height.
    pub fn move_by(&mut self, right: f64, down: f64) {
        let limited = |value: f64| value.clamp(-FARTHEST_PAN, FARTHEST_PAN);
        self.pan = [limited(self.pan[0] - right / self.zoom), limited(self.pan[1] + down / self.zoom)];
    }

    /// Brings the scene nearer by this factor, or farther below 1.
    pub fn zoom_by(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(ZOOM[0], ZOOM[1]);
    }

    /// Looks from here at the whole scene.
    pub fn look_from(&mut self, view: View) {
        *self = Self { view, parallel: self.parallel, fov_y_degrees: self.fov_y_degrees, ..Self::default() };
    }

    /// Whether the whole scene is fitted into the picture.
    pub(crate) fn is_fitted(&self) -> bool {
        self.zoom == 1.0 && self.pan == [0.0; 2]
    }

    /// As fitted to any scene, without move and zoom; settings that an orbit lacks come from `other`.
    pub(crate) fn fitted(&self, other: &CameraSettings) -> CameraSettings {
        let Self { view, parallel, fov_y_degrees, .. } = *self;
        CameraSettings { view, parallel, fov_y_degrees, ..other.clone() }
    }

    /// The camera settings for a scene shown with these others.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] where the fitted camera is refused.
    pub fn settings(&self, scene: &Scene, settings: &SceneSettings) -> Result<CameraSettings> {
        let fitted = self.fitted(&settings.camera);
        if self.is_fitted() {
            return Ok(fitted);
        }
        let camera = scene.seen_with(&SceneSettings { camera: fitted.clone(), ..settings.clone() })?.camera;
        Ok(readable(self.moved(&camera, fitted)))
    }

    /// The fitted camera, moved and zoomed.
    fn moved(&self, camera: &Camera, fitted: CameraSettings) -> CameraSettings {
        let view = camera.view_from_world();
        let [right, up, back] = [0, 1, 2].map(|row| view.row(row).truncate());
        let distance = camera.eye.distance(camera.target);
        let height = match camera.projection {
            Projection::Perspective { fov_y_degrees } => 2.0 * distance * (fov_y_degrees.to_radians() * 0.5).tan(),
            Projection::Parallel { height } => height,
        };
        let target: DVec3 = camera.target + (right * self.pan[0] + up * self.pan[1]) * height;
        let (distance, height) = match camera.projection {
            Projection::Perspective { .. } => (distance / self.zoom, None),
            Projection::Parallel { height } => (distance, Some(height / self.zoom)),
        };
        let eye = Some(target + back * distance);
        CameraSettings { eye, target: Some(target), up: Some(camera.up), height, ..fitted }
    }
}

/// Angles are multiples of this, degrees. Smaller steps are invisible, and three decimals are readable.
const ANGLE_STEP: f64 = 0.001;

/// A camera with few digits: places are multiples of a power of ten below a hundred-thousandth of the distance from eye to
/// target, far below a pixel.
fn readable(settings: CameraSettings) -> CameraSettings {
    let (Some(eye), Some(target)) = (settings.eye, settings.target) else { return settings };
    let step = |length: f64| 10f64.powf((length * 1e-5).log10().floor());
    let place = |place: DVec3, step: f64| DVec3::from_array(place.to_array().map(|value| rounded(value, step)));
    let of_distance = step(eye.distance(target));
    CameraSettings {
        eye: Some(place(eye, of_distance)),
        target: Some(place(target, of_distance)),
        up: settings.up.map(|up| place(up, 1e-6)),
        height: settings.height.map(|height| rounded(height, step(height))),
        ..settings
    }
}

/// The nearest multiple of a power of ten, with no digits behind its own.
fn rounded(value: f64, step: f64) -> f64 {
    // Divided by a whole number a decimal has the nearest of all texts; multiplied by 0.001 it has not.
    let rounded =
        if step < 1.0 { (value / step).round() / (1.0 / step).round() } else { (value / step).round() * step };
    // Zero without a sign.
    rounded + 0.0
}

/// An angle between -180 and 180 degrees.
fn wrapped(degrees: f64) -> f64 {
    let turned = degrees.rem_euclid(360.0);
    if turned > 180.0 { turned - 360.0 } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use std::sync::Arc;

    fn scene() -> Scene {
        Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap()
    }

    /// The camera before its numbers are rounded.
    fn camera(orbit: &Orbit) -> Camera {
        let (scene, settings) = (scene(), SceneSettings::default());
        let fitted = orbit.fitted(&settings.camera);
        let camera = scene.seen_with(&SceneSettings { camera: fitted.clone(), ..settings.clone() }).unwrap().camera;
        let camera = orbit.moved(&camera, fitted);
        scene.seen_with(&SceneSettings { camera, ..settings }).unwrap().camera
    }

    #[test]
    fn an_orbit_left_alone_is_the_cameras_default() {
        assert_eq!(Orbit::default().settings(&scene(), &SceneSettings::default()).unwrap(), CameraSettings::default());
    }

    #[test]
    fn turning_wraps_around_and_stops_at_the_poles() {
        let mut orbit = Orbit::default();
        orbit.turn(-1.0, 0.0);
        assert_eq!(orbit.view.azimuth_degrees, -150.0);
        orbit.turn(0.0, 3.0);
        assert_eq!(orbit.view.elevation_degrees, 90.0);
        orbit.turn(0.0, -7.0);
        assert_eq!(orbit.view.elevation_degrees, -90.0);
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        for parallel in [false, true] {
            for zoom in [1.0, 4.0] {
                let mut orbit = Orbit { parallel, ..Orbit::default() };
                orbit.zoom_by(zoom);
                let before = camera(&orbit);
                orbit.move_by(0.25, 0.1);
                let after = camera(&orbit);
                let place = |camera: &Camera| {
                    let clip = camera.clip_from_view(1.0) * camera.view_from_world();
                    clip.project_point3(before.target)
                };
                let [before, after] = [place(&before), place(&after)];
                // A picture is 2 clip units high; in the plane of the target, perspective has no effect.
                assert!((after.x - before.x - 0.5).abs() < 1e-9, "{parallel} {zoom}: {before} {after}");
                assert!((after.y - before.y + 0.2).abs() < 1e-9, "{parallel} {zoom}: {before} {after}");
            }
        }
    }

    #[test]
    fn zooming_twice_by_two_shows_everything_four_times_as_large() {
        for parallel in [false, true] {
            let size = |zoom: f64| {
                let camera = camera(&Orbit { parallel, zoom, ..Orbit::default() });
                let clip = camera.clip_from_view(1.0) * camera.view_from_world();
                let right = camera.view_from_world().row(0).truncate() * 1e-6;
                clip.project_point3(camera.target + right).x - clip.project_point3(camera.target).x
            };
            assert!((size(4.0) / size(1.0) - 4.0).abs() < 1e-6, "{parallel}");
        }
    }

    #[test]
    fn a_camera_has_at_most_six_digits_and_moves_nothing_by_a_fiftieth_of_a_pixel() {
        let digits = |value: f64| value.abs().to_string().replace('.', "").trim_start_matches('0').len();
        for (parallel, size) in [(false, 1.0), (true, 1.0), (false, 7e-4), (true, 3e5)] {
            let mut mesh = Mesh::triangle();
            mesh.positions.iter_mut().for_each(|position| *position *= size);
            let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap();
            let mut orbit = Orbit { parallel, ..Orbit::default() };
            for step in 1..20 {
                orbit.turn(0.1234567 * f64::from(step), -0.0154321);
                let View { azimuth_degrees, elevation_degrees } = orbit.view;
                assert!(
                    [azimuth_degrees, elevation_degrees].iter().all(|angle| digits(*angle) <= 6),
                    "{:?}",
                    orbit.view
                );
                orbit.zoom_by(1.0123456);
                orbit.move_by(0.0123, 0.0045);
                let camera = orbit.settings(&scene, &SceneSettings::default()).unwrap();
                let numbers = [camera.eye, camera.target].map(|place| place.unwrap().to_array()).concat();
                assert!(numbers.iter().chain(&camera.height).all(|number| digits(*number) <= 6), "{camera:?}");
                let [rounded, exact] = [camera, {
                    let fitted = orbit.fitted(&CameraSettings::default());
                    let settings = SceneSettings { camera: fitted.clone(), ..SceneSettings::default() };
                    orbit.moved(&scene.seen_with(&settings).unwrap().camera, fitted)
                }]
                .map(|camera| {
                    let camera = scene.seen_with(&SceneSettings { camera, ..SceneSettings::default() }).unwrap().camera;
                    let clip = camera.clip_from_view(1.0) * camera.view_from_world();
                    clip.project_point3(scene.centre).truncate() * 256.0
                });
                assert!(rounded.distance(exact) < 0.02, "{rounded} {exact}");
            }
        }
    }

    #[test]
    fn zoom_and_movement_have_limits() {
        let mut orbit = Orbit::default();
        orbit.zoom_by(1e300);
        orbit.move_by(1e300, -1e300);
        assert_eq!((orbit.zoom, orbit.pan), (50.0, [-2.0, -2.0]));
        orbit.zoom_by(0.0);
        assert_eq!(orbit.zoom, 0.05);
        orbit.look_from(View { azimuth_degrees: 0.0, elevation_degrees: 0.0 });
        assert!(orbit.is_fitted());
    }
}
