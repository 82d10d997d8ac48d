//! Refuses cameras beyond numeric precision: f64 for every scene, f32 and the depth buffer for drawing with GL.

use super::Scene;
use crate::camera::{Camera, Projection};
use crate::error::{Error, Result};
use crate::tolerances::{
    COORDINATE_NOISE, LARGEST_DISTANCE, LARGEST_EXACT_DISTANCE, LEAST_DEPTH_STEPS, LOST_PX, NARROW,
};
use crate::values::short;

impl Scene {
    /// The eye's distance from the scene's centre, scene radii.
    fn distance(&self) -> f64 {
        (self.camera.eye - self.centre).length() / self.radius
    }

    /// Refuses an eye too distant for f64 to place the scene in the picture.
    pub(super) fn check_distance(&self) -> Result<()> {
        let distance = self.distance();
        match distance > LARGEST_EXACT_DISTANCE {
            false => Ok(()),
            true => Err(Error::settings(
                &["fov", "eye"],
                format!(
                    "the eye is {distance:.3e} scene radii away, more than the {LARGEST_EXACT_DISTANCE:e} that numbers can resolve; \
                     use --parallel, or bring it closer"
                ),
            )),
        }
    }

    /// Returns a remark on exact lines of a scene so far from the origin, for its size, that numbers do not tell its points
    /// apart to `LOST_PX` of the picture.
    pub fn far_remark(&self) -> Option<String> {
        let reach = self.centre.abs().max_element().max(self.camera.eye.abs().max_element());
        let shown = match self.camera.projection {
            Projection::Perspective { fov_y_degrees } => {
                2.0 * (fov_y_degrees.to_radians() * 0.5).tan() * (self.camera.eye - self.centre).length()
            }
            Projection::Parallel { height } => height,
        };
        let px_per_unit = f64::from(self.size.height) / shown;
        (COORDINATE_NOISE * reach * px_per_unit > LOST_PX).then(|| {
            format!(
                "{reach:.1e} units from the origin numbers are {:.1e} apart, {} pixels here: lines may be missing, and hidden ones \
                 drawn; move the model nearer to the origin",
                reach * f64::EPSILON,
                short((reach * f64::EPSILON * px_per_unit * 1e3).round() / 1e3)
            )
        })
    }

    /// Refuses a scene without faces, because GL draws nothing else, and a camera that GL cannot draw this scene with: f32
    /// matrices are too coarse for the depth, or the planes leave the depth buffer too few steps. Exact lines need neither.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the first model, and [`Error::Setting`] with the names of the options.
    pub fn check_precision(&self) -> Result<()> {
        if self.triangle_count() == 0 {
            let problem = "it has no faces, only curves and points; draw it with --style lines, or into a .svg";
            let name = self.objects.first().map(|object| object.mesh.name.clone()).unwrap_or_default();
            return Err(Error::model(name, problem));
        }
        let distance = self.distance();
        let clip_from_view = self.clip_from_view();
        if let Projection::Parallel { height } = self.camera.projection
            && !(clip_from_view.x_axis.is_finite() && clip_from_view.y_axis.is_finite())
        {
            let problem = "GL cannot enlarge the model so much; show more of it";
            return Err(Error::value("height", short(height), problem));
        }
        let aspect = self.size.aspect();
        if distance > LARGEST_DISTANCE && distance * aspect < LARGEST_DISTANCE && aspect < NARROW {
            let problem = "so narrow a picture puts the eye too far away for GL; make it wider, or use --parallel";
            return Err(Error::value("size", self.size, problem));
        }
        if distance > LARGEST_DISTANCE || !clip_from_view.is_finite() {
            return Err(Error::settings(
                &["fov", "eye", "near", "far"],
                format!(
                    "the eye is {distance:.3e} scene radii away, more than the {LARGEST_DISTANCE:e} GL can resolve, or the \
                     planes are too far apart; use --parallel, or bring them closer"
                ),
            ));
        }
        self.check_depth()
    }

    /// Refuses planes so far apart that the depth buffer has hardly any steps for the scene.
    fn check_depth(&self) -> Result<()> {
        let Camera { near, far, .. } = self.camera;
        let middle = (self.centre - self.camera.eye).dot(-self.camera.backward());
        let (nearest, farthest) = (near.max(middle - self.radius), far.min(middle + self.radius));
        // Either no point lies between the planes, or the eye is inside the scene, where points may be as near as the
        // plane.
        if nearest >= farthest || nearest == near {
            return Ok(());
        }
        let share = match self.camera.projection {
            Projection::Perspective { .. } => near * far / (far - near) * (1.0 / nearest - 1.0 / farthest),
            Projection::Parallel { .. } => (farthest - nearest) / (far - near),
        };
        let steps = share * f64::from(1u32 << 24);
        if steps < LEAST_DEPTH_STEPS {
            return Err(Error::settings(
                &["near", "far"],
                format!(
                    "the planes, {} and {} away, are so far apart that {steps:.0} of the depth buffer's 16777216 steps are left for the scene, \
                     which is {nearest:.3} to {farthest:.3} away; leave the options out, or bring the planes closer to that",
                    short(near),
                    short(far)
                ),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::CameraSettings;
    use crate::lines::{LineSettings, VisibleLines};
    use crate::mesh::{LoadOptions, Mesh};
    use crate::scene::{Scene, SceneSettings};
    use glam::DVec3;
    use std::sync::Arc;

    /// A cube of side 2 with its middle here: all its coordinates are whole numbers up to 1e15.
    fn cube(middle: DVec3, camera: CameraSettings) -> Scene {
        let corner = |number: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(number >> axis & 1) * 2.0 - 1.0));
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let corners = (0..8).map(|number| corner(number) + middle).collect();
        let mesh = Mesh::of_triangles("a cube", corners, &triangles, &LoadOptions::default()).unwrap();
        Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
    }

    fn visible_px(scene: &Scene) -> f64 {
        let lines = VisibleLines::of(scene, &LineSettings::default()).unwrap();
        lines.segments.iter().filter(|segment| segment.is_visible).map(|it| it.ends_px[0].distance(it.ends_px[1])).sum()
    }

    #[test]
    fn lines_far_from_the_origin_are_right_or_remarked() {
        let mut wrong = 0;
        for parallel in [false, true] {
            let camera = CameraSettings { parallel, ..CameraSettings::default() };
            let near = visible_px(&cube(DVec3::ZERO, camera.clone()));
            for power in 3..=15 {
                let far = cube(DVec3::new(1.0, -1.0, 1.0) * 10.0f64.powi(power), camera.clone());
                let (remark, px) = (far.far_remark(), visible_px(&far));
                let is_right = (px - near).abs() < 0.01 * near;
                assert!(is_right || remark.is_some(), "1e{power}: {px} instead of {near}");
                wrong += usize::from(!is_right);
                assert!(remark.is_none() || power > 9, "1e{power}: {remark:?}");
            }
        }
        assert!(wrong > 0, "the remark has a reason");
        let remark = cube(DVec3::splat(1e15), CameraSettings::default()).far_remark().unwrap();
        assert!(remark.contains("1.0e15") && remark.contains("nearer to the origin"), "{remark}");
    }

    #[test]
    fn numbers_of_messages_are_short_and_name_the_right_option() {
        let refused = |camera| cube(DVec3::ZERO, camera).check_precision().unwrap_err().to_string();
        let height = refused(CameraSettings { parallel: true, height: Some(1e-300), ..CameraSettings::default() });
        assert!(height.starts_with("height 1e-300: "), "{height}");
        let thin = SceneSettings { size: crate::scene::Size { width: 1, height: 40_000 }, ..SceneSettings::default() };
        let thin =
            cube(DVec3::ZERO, CameraSettings::default()).seen_with(&thin).unwrap().check_precision().unwrap_err();
        assert!(thin.to_string().starts_with("size 1x40000: so narrow a picture"), "{thin}");
        let planes = refused(CameraSettings { near: Some(1e-300), ..CameraSettings::default() });
        assert!(planes.contains("1e-300") && planes.len() < 300, "{planes}");
        let crossed = CameraSettings { near: Some(1e300), far: Some(1e-300), ..CameraSettings::default() };
        let crossed = cube(DVec3::ZERO, CameraSettings::default())
            .seen_with(&SceneSettings { camera: crossed, ..SceneSettings::default() })
            .unwrap_err()
            .to_string();
        assert!(crossed.contains("1e300 and 1e-300") && crossed.len() < 200, "{crossed}");
        let tiny = Mesh::of_triangles(
            "a speck",
            [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner * 1e-300).to_vec(),
            &[[0, 1, 2]],
            &LoadOptions::default(),
        );
        let said = tiny.and_then(|mesh| Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())).unwrap_err();
        assert!(said.to_string().contains("e-301"), "{said}");
    }
}
