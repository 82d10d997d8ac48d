//! The near plane of an eye among the faces: fitted to the visible scene, as near as the depth buffer allows.
//!
//! A share of the far plane's distance serves an eye outside. Among the faces it may cut one in the picture, and then the plane comes
//! nearer.

use super::Scene;
use super::unseen::{SIDES, inside};
use crate::camera::{CameraSettings, Projection};
use crate::tolerances::{DEPTH_MARGIN, LEAST_NEAR_FRACTION, NEAREST_FRACTION};
use crate::values::short;
use glam::DVec3;

impl Scene {
    /// With the fitted near plane before all faces in the picture, if depth allows.
    pub(super) fn with_near_plane(mut self, settings: &CameraSettings) -> Self {
        if let (None, Some(nearest)) = (settings.near, self.nearest_cut()) {
            let least = self.camera.near * (LEAST_NEAR_FRACTION / NEAREST_FRACTION);
            self.camera.near = (nearest * (1.0 - DEPTH_MARGIN)).max(least);
        }
        self
    }

    /// Returns a remark where the near plane, as fitted, cuts faces off that the picture would show.
    pub fn cut_remark(&self) -> Option<String> {
        self.nearest_cut().map(|_| {
            format!(
                "the near plane, {} away, cuts off faces before it and shows what lies behind them; move the eye away from them, or \
                 bring the far plane nearer with --far",
                short(self.camera.near)
            )
        })
    }

    /// The least distance, along the view, of faces between the picture's sides, if the near plane is no farther from the
    /// eye than a share of the far plane, and cuts something off. In parallel projection the eye's own plane cuts.
    fn nearest_cut(&self) -> Option<f64> {
        let near = self.camera.near;
        let Projection::Perspective { .. } = self.camera.projection else { return None };
        if near > self.camera.far * NEAREST_FRACTION {
            return None;
        }
        let view = self.camera.view_from_world();
        let clip_from_view = self.camera.clip_from_view(self.size.aspect());
        let mut nearest = near;
        for object in &self.objects {
            let place = |point: DVec3| view.transform_vector3(point - self.camera.eye + object.offset);
            let faces = object.mesh.triangles.iter().filter_map(|face| object.mesh.corners(face));
            for corners in faces.map(|corners| corners.map(place)).filter(|it| it.iter().any(|corner| -corner.z < near))
            {
                let mut clip = corners.map(|corner| clip_from_view * corner.extend(1.0)).to_vec();
                SIDES.iter().for_each(|side| clip = inside(&clip, *side));
                nearest = clip.iter().map(|corner| corner.w).fold(nearest, f64::min);
            }
        }
        (nearest < near).then_some(nearest)
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::CameraSettings;
    use crate::lines::{LineSettings, VisibleLines};
    use crate::mesh::{LoadOptions, Mesh};
    use crate::scene::{Scene, SceneSettings};
    use glam::DVec3;

    /// A box of 0.5 x 1 x 0.5 on a square floor of this side.
    fn box_on_floor(side: f64, camera: CameraSettings) -> Scene {
        let corner = |number: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(number >> axis & 1)));
        let floor = |x: f64, z: f64| DVec3::new(x, 0.0, z) * (side * 0.5);
        let mut corners: Vec<DVec3> =
            (0..8).map(corner).map(|at| DVec3::new(at.x - 0.5, at.y * 2.0, at.z - 0.5) * 0.5).collect();
        corners.extend([floor(-1.0, -1.0), floor(1.0, -1.0), floor(1.0, 1.0), floor(-1.0, 1.0)]);
        let sides =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [11, 10, 9, 8]];
        let triangles: Vec<[u32; 3]> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let mesh = Mesh::of_triangles("a box", corners, &triangles, &LoadOptions::default()).unwrap();
        Scene::new([mesh], &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
    }

    /// An eye so far above the box and before it, which looks down at it.
    fn above(height: f64) -> CameraSettings {
        let eye = Some(DVec3::new(0.0, 1.0 + height, 0.25 + height * 0.75));
        CameraSettings { eye, target: Some(DVec3::new(0.0, 0.5, 0.0)), ..CameraSettings::default() }
    }

    fn visible_px(scene: &Scene) -> f64 {
        let lines = VisibleLines::of(scene, &LineSettings::default()).unwrap();
        lines.segments.iter().filter(|it| it.is_visible).map(|it| it.ends_px[0].distance(it.ends_px[1])).sum()
    }

    #[test]
    fn a_wide_floor_opens_no_box_near_the_eye_or_it_is_remarked() {
        let mut remarked = 0;
        for height in [0.5, 0.2, 0.1, 0.05, 0.01, 0.001] {
            let right = visible_px(&box_on_floor(10.0, CameraSettings { near: Some(1e-5), ..above(height) }));
            for side in [10.0, 1e3, 1e4] {
                let scene = box_on_floor(side, above(height));
                let (px, remark) = (visible_px(&scene), scene.cut_remark());
                // The floors' own sides are out of the picture.
                let is_right = (px - right).abs() < 0.01 * right;
                assert!(is_right || remark.is_some(), "{height} above, floor of {side}: {px} instead of {right}");
                assert!(
                    remark.is_none() || scene.camera.near < scene.camera.far * 4e-5,
                    "{height}, {side}: {remark:?}"
                );
                remarked += usize::from(remark.is_some());
            }
        }
        assert!(remarked > 0, "where depth allows no nearer plane");
        let far_out = box_on_floor(1e3, CameraSettings::default());
        assert_eq!((far_out.cut_remark(), far_out.camera.near > 0.1), (None, true));
    }

    #[test]
    fn every_view_of_a_turn_has_its_near_plane_before_the_box() {
        for height in [0.2, 0.1] {
            let settings = above(height);
            let scene = box_on_floor(1e3, settings.clone());
            let right = visible_px(&box_on_floor(10.0, CameraSettings { near: Some(1e-5), ..settings.clone() }));
            for camera in scene.turntable(&settings, 4).unwrap() {
                let view = Scene { camera, ..scene.clone() };
                let px = visible_px(&view);
                assert!((px - right).abs() < 0.01 * right, "{height} above: {px} instead of {right}");
                assert_eq!(view.cut_remark(), None);
            }
        }
    }
}
