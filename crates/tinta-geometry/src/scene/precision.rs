//! Refuses cameras beyond numeric precision: f64 for every scene, f32 and the depth buffer for drawing with GL.

use super::Scene;
use crate::camera::{Camera, Projection};
use crate::error::{Error, Result};
use crate::tolerances::{LARGEST_DISTANCE, LARGEST_EXACT_DISTANCE, LEAST_DEPTH_STEPS};

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
        if distance > LARGEST_DISTANCE || !self.clip_from_view().is_finite() {
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
                    "the planes, {near} and {far} away, are so far apart that {steps:.0} of the depth buffer's 16777216 steps are left for the scene, \
                     which is {nearest:.3} to {farthest:.3} away; leave the options out, or bring the planes closer to that"
                ),
            ));
        }
        Ok(())
    }
}
