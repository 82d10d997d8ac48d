//! The cameras of a full turn around a scene.
//!
//! GL's lights move with the camera, so turning the camera is equivalent to turning the scene under a fixed light.

use super::{FITTED_POINTS, Object, Scene};
use crate::camera::{Camera, CameraSettings};
use crate::error::{Error, Result};
use crate::mesh::hull;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Corners of the polygon around a circle that the camera is fitted to.
const CORNERS: u32 = 64;

impl Scene {
    /// Returns the cameras of `views` pictures of a full turn about the up axis (`--up`, default +y) through the
    /// scene's centre.
    ///
    /// All have the same distance, so the scene does not pulse: with the given settings, they are fitted to the space
    /// that the turning scene fills. The first camera looks from the direction in `settings`; a given eye moves
    /// along.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] if `views` is 0, and those of [`Scene::new`] for an impossible camera.
    pub fn turntable(&self, settings: &CameraSettings, views: u32) -> Result<Vec<Camera>> {
        if views == 0 {
            return Err(Error::value("turntable", "0", "a turn has at least one view"));
        }
        let axis = settings.up.and_then(DVec3::try_normalize).unwrap_or(DVec3::Y);
        let (across, _) = axis.any_orthonormal_pair();
        let turn = |point: DVec3, angle: f64| DQuat::from_axis_angle(axis, angle) * point;
        let around = 1.0 / (PI / f64::from(CORNERS)).cos();
        let room = self.profile(axis).into_iter().flat_map(|at| {
            let corner = across * (at.y * around);
            (0..CORNERS).map(move |n| (at.x, corner, TAU * f64::from(n) / f64::from(CORNERS)))
        });
        let room: Vec<DVec3> = room.map(|(up, corner, angle)| self.centre + axis * up + turn(corner, angle)).collect();
        let camera = settings.fit(self.centre, self.radius, self.size.aspect(), room.iter().copied())?;
        Self { camera, ..self.clone() }.check_distance()?;
        let view = |number: u32| {
            let angle = TAU * f64::from(number) / f64::from(views);
            let [eye, target] = [camera.eye, camera.target].map(|it| self.centre + turn(it - self.centre, angle));
            let camera = Camera { eye, target, up: turn(camera.up, angle), ..camera };
            Self { camera, ..self.clone() }.with_near_plane(settings).camera
        };
        Ok((0..views).map(view).collect())
    }

    /// The outline of the turning scene: the corners of the convex hull of all points, each as height along the axis
    /// from the centre and distance from the axis.
    fn profile(&self, axis: DVec3) -> Vec<DVec2> {
        let outline = |point: DVec3| {
            let from_centre = point - self.centre;
            let up = from_centre.dot(axis);
            DVec2::new(up, (from_centre - axis * up).length())
        };
        let point_count: usize = self.objects.iter().map(|object| object.mesh.positions.len()).sum();
        let points: Vec<DVec2> = if point_count <= FITTED_POINTS {
            let points = self.objects.iter().flat_map(|o| o.mesh.all_positions().map(|point| point + o.offset));
            points.map(outline).collect()
        } else {
            self.objects.iter().flat_map(Object::box_corners).map(outline).collect()
        };
        hull(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, load, read_as};
    use crate::scene::SceneSettings;
    use crate::tolerances::FRAME_FILL;
    use std::sync::Arc;

    fn scene(model: &str, camera: CameraSettings) -> Scene {
        let mesh = load(model, &LoadOptions::default()).unwrap().mesh;
        Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
    }

    /// The scene's reach towards the picture's border; 1 is at the border.
    fn reach(scene: &Scene, camera: &Camera) -> f64 {
        let clip_from_world = camera.clip_from_view(scene.size.aspect()) * camera.view_from_world();
        let points = scene.objects[0].mesh.positions.iter().map(|point| clip_from_world.project_point3(*point));
        points.map(|ndc| ndc.x.abs().max(ndc.y.abs()).max(ndc.z.abs())).fold(0.0, f64::max)
    }

    #[test]
    fn the_whole_turn_is_in_the_picture_and_the_distance_stays() {
        for model in ["../../models/bust.obj", "../../models/open-box.obj", "../../models/ant.obj"] {
            for parallel in [false, true] {
                let settings = CameraSettings { parallel, ..CameraSettings::default() };
                let scene = scene(model, settings.clone());
                let cameras = scene.turntable(&settings, 24).unwrap();
                let distances: Vec<f64> = cameras.iter().map(|camera| camera.eye.distance(scene.centre)).collect();
                assert!(distances.iter().all(|distance| (distance / distances[0] - 1.0).abs() < 1e-12));
                let widest = cameras.iter().map(|camera| reach(&scene, camera)).fold(0.0, f64::max);
                assert!(widest < 1.0 && widest > FRAME_FILL - 0.1, "{model} parallel {parallel}: {widest}");
            }
        }
    }

    #[test]
    fn what_is_flat_or_has_no_faces_is_in_the_picture_too() {
        let corners = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n";
        for elements in ["f 1 2 3 4", "l 1 2 3 4 1", "l 1 3", "p 1 2 3 4"] {
            let text = format!("{corners}{elements}\n");
            let mesh = read_as(text.as_bytes(), "flat.obj", &LoadOptions::default()).unwrap().mesh;
            let mesh = Arc::new(mesh);
            let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default()).unwrap();
            let settings = CameraSettings::default();
            for camera in scene.turntable(&settings, 24).unwrap() {
                let clip_from_world = camera.clip_from_view(scene.size.aspect()) * camera.view_from_world();
                let farthest =
                    mesh.all_positions().map(|point| clip_from_world.project_point3(point).abs().max_element());
                let farthest = farthest.fold(0.0, f64::max);
                assert!(farthest < 1.0 && farthest > 0.5, "{elements}: {farthest}");
            }
        }
    }

    #[test]
    fn the_turn_begins_at_the_view_asked_for_and_goes_round() {
        let settings = CameraSettings { view: "front".parse().unwrap(), ..CameraSettings::default() };
        let scene = scene("../../models/open-box.obj", settings.clone());
        let cameras = scene.turntable(&settings, 4).unwrap();
        let towards = |camera: &Camera| (camera.eye - camera.target).normalize();
        for (camera, expected) in cameras.iter().zip([DVec3::Z, DVec3::X, DVec3::NEG_Z, DVec3::NEG_X]) {
            assert!(towards(camera).distance(expected) < 1e-12 && camera.up.distance(DVec3::Y) < 1e-12);
        }
    }

    #[test]
    fn an_eye_given_goes_round_and_no_view_is_refused() {
        let settings = CameraSettings { eye: Some(DVec3::new(3.0, 9.0, 5.0)), ..CameraSettings::default() };
        let scene = scene("../../models/open-box.obj", settings.clone());
        let cameras = scene.turntable(&settings, 8).unwrap();
        assert_eq!(cameras[0].eye, DVec3::new(3.0, 9.0, 5.0));
        assert!(cameras.iter().all(|camera| (camera.eye.y - 9.0).abs() < 1e-12));
        assert!(scene.turntable(&settings, 0).is_err());
    }
}
