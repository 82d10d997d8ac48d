//! The camera: the user's settings, fitted to the scene and checked, as f64 matrices.
//!
//! Input: [`CameraSettings`] and the scene's points. Output: a [`Camera`] in world space, file units, y up.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use glam::DVec3;
//! use std::sync::Arc;
//! use tinta_geometry::{CameraSettings, LoadOptions, Scene, SceneSettings, load};
//!
//! let mesh = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let settings = CameraSettings { eye: Some(DVec3::new(0.0, 0.0, 9.0)), fov_y_degrees: 45.0, ..Default::default() };
//! let seen = scene.seen_with(&SceneSettings { camera: settings, ..Default::default() })?;
//! assert_eq!(seen.camera.eye, DVec3::new(0.0, 0.0, 9.0));
//! // The camera looks along -z, so backward is +z.
//! assert!(seen.camera.backward().z > 0.99);
//! # Ok(())
//! # }
//! ```

mod framing;
mod matrix;

pub use framing::Framing;

use crate::error::{Error, ParseError, Result};
use crate::settings::{Kind, Problem, Setting, Value, under};
use crate::tolerances::{
    CAMERA_ALIGNMENT, DEPTH_MARGIN, LARGEST_COORDINATE, LARGEST_EXACT_DISTANCE, NEAREST_FRACTION, SAME_POINT,
};
use crate::values::short;
use glam::dcamera::rh::proj::opengl;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec2, DVec3};
use serde::Serialize;
use std::str::FromStr;

/// A camera in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The eye's position.
    pub eye: DVec3,
    /// The point in the centre of the picture.
    pub target: DVec3,
    /// The direction that points up in the picture.
    pub up: DVec3,
    /// The projection.
    pub projection: Projection,
    /// Distance of the near plane from the eye, file units.
    pub near: f64,
    /// Distance of the far plane from the eye, file units.
    pub far: f64,
}

/// The projection from space to the picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Perspective projection with a vertical field of view.
    Perspective {
        /// Full vertical angle, degrees.
        fov_y_degrees: f64,
    },
    /// Parallel projection with a height of the picture.
    Parallel {
        /// Picture height, file units.
        height: f64,
    },
}

impl Camera {
    /// The rigid matrix from world to eye space (x right, y up, looking along -z).
    pub fn view_from_world(&self) -> DMat4 {
        look_at_mat4(self.eye, self.target, self.up)
    }

    /// Unit vector from the target towards the eye in world space: the z axis of eye space, the view vector of the
    /// published texts.
    pub fn backward(&self) -> DVec3 {
        self.view_from_world().row(2).truncate()
    }

    /// The projection for a picture with this aspect (width over height): GL's clip space, depth in [-1, 1].
    pub fn clip_from_view(&self, aspect: f64) -> DMat4 {
        match self.projection {
            Projection::Perspective { fov_y_degrees } => {
                opengl::perspective(fov_y_degrees.to_radians(), aspect, self.near, self.far)
            }
            Projection::Parallel { height } => {
                let (x, y) = (height * aspect * 0.5, height * 0.5);
                opengl::orthographic(-x, x, -y, y, self.near, self.far)
            }
        }
    }
}

/// The direction of a view: the angles of the eye, seen from the target.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct View {
    /// Degrees around the up axis; 0 is the front (+z), 90 the model's +x side.
    pub azimuth_degrees: f64,
    /// Degrees above the horizon, -90 to 90.
    pub elevation_degrees: f64,
}

impl View {
    /// Three quarters from the front and slightly from above: the default.
    pub const DEFAULT: Self = Self { azimuth_degrees: 30.0, elevation_degrees: 15.0 };

    const NAMED: [(&str, f64, f64); 7] = [
        ("iso", 45.0, 35.264_389_682_754_654),
        ("front", 0.0, 0.0),
        ("back", 180.0, 0.0),
        ("left", -90.0, 0.0),
        ("right", 90.0, 0.0),
        ("top", 0.0, 90.0),
        ("bottom", 0.0, -90.0),
    ];

    /// Unit vector from the target to the eye.
    fn towards_eye(&self) -> DVec3 {
        let (sin_azimuth, cos_azimuth) = exact_sin_cos(self.azimuth_degrees);
        let (sin_elevation, cos_elevation) = exact_sin_cos(self.elevation_degrees);
        DVec3::new(sin_azimuth * cos_elevation, sin_elevation, cos_azimuth * cos_elevation)
    }
}

/// Sine and cosine, exact at multiples of 90 degrees, so a front view is exactly from the front.
fn exact_sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}

impl FromStr for View {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let named = Self::NAMED.iter().find(|(name, ..)| *name == text);
        if let Some(&(_, azimuth_degrees, elevation_degrees)) = named {
            return Ok(Self { azimuth_degrees, elevation_degrees });
        }
        let usage = || {
            "a view is iso, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees with the elevation \
             from -90 to 90"
                .to_owned()
        };
        let (azimuth, elevation) = text.split_once(',').ok_or_else(usage)?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let (Some(azimuth_degrees), Some(elevation_degrees)) = (number(azimuth), number(elevation)) else {
            return Err(usage().into());
        };
        if !(-90.0..=90.0).contains(&elevation_degrees) {
            return Err(usage().into());
        }
        Ok(Self { azimuth_degrees, elevation_degrees })
    }
}

impl Value for View {
    fn kind() -> Kind {
        Kind::Text { offered: &["iso", "front", "back", "left", "right", "top", "bottom"], example: "-37.25,12" }
    }

    fn text(&self) -> String {
        format!("{},{}", self.azimuth_degrees, self.elevation_degrees)
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// The user's settings of the camera; unset ones are fitted to the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraSettings {
    /// Direction of the view if no eye is given. Default 30,15.
    pub view: View,
    /// The centre of the picture if neither eye nor target is given. Default the middle of the scene's bounding box.
    pub framing: Framing,
    /// Position of the eye, world space. Default fitted.
    pub eye: Option<DVec3>,
    /// The point that the camera looks at, world space. Default the scene's centre.
    pub target: Option<DVec3>,
    /// The direction that points up in the picture. Default +y, or the scene's back if the view runs along y.
    pub up: Option<DVec3>,
    /// Vertical field of view, degrees. Default 30; a larger angle brings the camera nearer and strengthens the
    /// perspective.
    pub fov_y_degrees: f64,
    /// Whether the projection is parallel instead of perspective. Default false.
    pub parallel: bool,
    /// Height of a parallel projection's picture, file units. Default fitted; a smaller height magnifies.
    pub height: Option<f64>,
    /// Distance of the near plane, file units. Default fitted.
    pub near: Option<f64>,
    /// Distance of the far plane, file units. Default fitted.
    pub far: Option<f64>,
}

impl Default for CameraSettings {
    fn default() -> Self {
        Self {
            view: View::DEFAULT,
            framing: Framing::Middle,
            eye: None,
            target: None,
            up: None,
            fov_y_degrees: 30.0,
            parallel: false,
            height: None,
            near: None,
            far: None,
        }
    }
}

/// The heading of the camera's settings.
pub const HEADING: &str = "Camera";

impl CameraSettings {
    /// The camera's settings.
    pub(crate) fn settings() -> Vec<Setting<Self>> {
        let view = Setting::of(
            "view",
            "VIEW",
            View::kind(),
            "View from iso, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees; if you see the \
             model's back, try 210,23 or 180,0",
            // The position of an eye does not depend on the view.
            |camera: &Self| if camera.eye.is_some() { View::DEFAULT.text() } else { camera.view.text() },
            |camera, text| {
                camera.view = View::parse(text)?;
                Ok(())
            },
        );
        let settings = vec![
            view.common(),
            Setting::field("fov", "DEGREES", "Vertical field of view in degrees", |camera: &mut Self| {
                &mut camera.fov_y_degrees
            })
            .range(5.0, 120.0, 1),
            Setting::flag(
                "parallel",
                "Parallel projection instead of perspective",
                |camera: &Self| camera.parallel,
                |camera, is_on| camera.parallel = is_on,
            )
            .common(),
            Setting::field(
                "framing",
                "WHAT",
                "Fit of the model in the picture: middle (centre its bounding box, the same point in every view) or outline \
                 (centre its outline, which then fills the picture)",
                |camera: &mut Self| &mut camera.framing,
            ),
            Setting::open_field(
                "height",
                "LENGTH",
                "fitted",
                "Height that a parallel projection shows, in model units; less zooms in",
                |camera: &mut Self| &mut camera.height,
            ),
            Setting::open_field(
                "eye",
                "X,Y,Z",
                "fitted",
                "Position of the eye, in model units; y is up, after --up-axis",
                |camera: &mut Self| &mut camera.eye,
            )
            .said("in direction --view, far enough to show the whole scene"),
            Setting::open_field(
                "target",
                "X,Y,Z",
                "centre",
                "Point that the camera looks at, in the coordinates of \
                --eye",
                |camera: &mut Self| &mut camera.target,
            )
            .said("the scene's centre"),
            Setting::open_field("up", "X,Y,Z", "y", "Direction that is up in the picture", |camera: &mut Self| {
                &mut camera.up
            })
            .said("0,1,0"),
            Setting::open_field(
                "near",
                "LENGTH",
                "fitted",
                "Distance from the eye to the near plane, in model units",
                |camera: &mut Self| &mut camera.near,
            ),
            Setting::open_field(
                "far",
                "LENGTH",
                "fitted",
                "Distance from the eye to the far plane, in model units",
                |camera: &mut Self| &mut camera.far,
            ),
        ];
        under(HEADING, settings).collect()
    }

    /// Returns the camera for a picture of this aspect (width over height); unset settings are fitted so that it
    /// shows all points.
    ///
    /// `centre` and `radius` are the scene's, in world space. The error names the setting that makes the camera
    /// impossible.
    pub(crate) fn fit(
        &self,
        centre: DVec3,
        radius: f64,
        aspect: f64,
        points: impl Iterator<Item = DVec3> + Clone,
    ) -> Result<Camera> {
        self.check_numbers()?;
        let target = self.target.unwrap_or(centre);
        let towards_eye = match self.eye {
            Some(eye) => eye - target,
            None => self.view.towards_eye(),
        };
        let scale = self.eye.map_or(1.0, |eye| eye.abs().max_element().max(target.abs().max_element()));
        let Some(back) = towards_eye.try_normalize().filter(|_| towards_eye.length() > scale * SAME_POINT) else {
            return Err(Error::settings(&["eye", "target"], "they are the same point; move one of them"));
        };
        let up = self.up_for(back)?;
        let right = up.cross(back).normalize();
        let true_up = back.cross(right);
        let in_frame = |point: DVec3| {
            let from_target = point - target;
            DVec3::new(from_target.dot(right), from_target.dot(true_up), from_target.dot(back))
        };
        let across = self.middle(points.clone().map(in_frame), aspect);
        let frame = points.map(|point| in_frame(point) - across.extend(0.0));
        let target = target + right * across.x + true_up * across.y;
        let fill = self.framing.fill();
        let half_height = frame.clone().map(|p| p.y.abs().max(p.x.abs() / aspect)).fold(0.0, f64::max);
        let projection = if self.parallel {
            let fitted = (2.0 * half_height / fill).max(radius * NEAREST_FRACTION);
            Projection::Parallel { height: self.height.unwrap_or(fitted) }
        } else {
            Projection::Perspective { fov_y_degrees: self.fov_y_degrees }
        };
        let distance = match (self.eye, projection) {
            (Some(eye), _) => (eye - target).length(),
            (None, Projection::Parallel { .. }) => frame.clone().map(|p| p.z).fold(0.0, f64::max) + radius,
            (None, Projection::Perspective { fov_y_degrees }) => {
                let tan_y = (fov_y_degrees.to_radians() * 0.5).tan() * fill;
                let needed = frame.clone().map(|p| p.z + p.y.abs().max(p.x.abs() / aspect) / tan_y);
                needed.fold(0.0, f64::max).max(radius * NEAREST_FRACTION)
            }
        };
        if self.eye.is_none() && distance.is_nan() | (distance > LARGEST_EXACT_DISTANCE * radius) {
            return Err(Error::value(
                "fov",
                self.fov_y_degrees,
                "so small an angle puts the eye too far away for the precision of numbers; use --parallel instead",
            ));
        }
        let (near, far) = self.depth_range(distance, radius, frame.map(|p| distance - p.z))?;
        let eye = self.eye.unwrap_or(target + back * distance);
        Ok(Camera { eye, target, up, projection, near, far })
    }

    /// How far the picture's middle lies beside the target, given the scene's points around it.
    fn middle(&self, points: impl Iterator<Item = DVec3> + Clone, aspect: f64) -> DVec2 {
        let tan_half = (self.fov_y_degrees.to_radians() * 0.5).tan();
        match self.framing {
            Framing::Outline if self.eye.is_some() || self.target.is_some() => DVec2::ZERO,
            Framing::Outline if self.parallel => framing::middle_of_parallel(points),
            Framing::Outline => framing::middle_of_perspective(points, DVec2::new(tan_half * aspect, tan_half)),
            _ => DVec2::ZERO,
        }
    }

    fn check_numbers(&self) -> Result<()> {
        if !(self.fov_y_degrees > 0.0 && self.fov_y_degrees < 180.0) {
            return Err(Error::value(
                "fov",
                self.fov_y_degrees,
                "the field of view is an angle between 0 and 180 degrees, both excluded",
            ));
        }
        for (name, vector) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            let within = |vector: DVec3| vector.is_finite() && vector.abs().max_element() <= LARGEST_COORDINATE;
            if vector.is_some_and(|vector| !within(vector)) {
                return Err(Error::setting(name, format!("its three numbers must lie within {LARGEST_COORDINATE:e}")));
            }
        }
        if self.height.is_some_and(|height| !(height > 0.0 && height <= LARGEST_COORDINATE)) {
            return Err(Error::setting("height", format!("a height is above 0 and at most {LARGEST_COORDINATE:e}")));
        }
        if self.height.is_some() && !self.parallel {
            return Err(Error::setting("height", "only a parallel projection has one; give --parallel too"));
        }
        for (name, distance) in [("near", self.near), ("far", self.far)] {
            if distance.is_some_and(|distance| !(distance > 0.0 && distance.is_finite())) {
                return Err(Error::setting(name, "the distance of a plane from the eye is a finite number above 0"));
            }
        }
        Ok(())
    }

    /// The given up vector if it is valid; else +y, or the scene's back or front when looking straight down or up.
    fn up_for(&self, back: DVec3) -> Result<DVec3> {
        let is_along_view = |up: DVec3| up.cross(back).length() < CAMERA_ALIGNMENT;
        match self.up.map(DVec3::try_normalize) {
            Some(None) => Err(Error::setting("up", "a vector of length 0 points nowhere")),
            Some(Some(up)) if is_along_view(up) => {
                Err(Error::setting("up", "it points along the view; choose another direction"))
            }
            Some(Some(up)) => Ok(up),
            None if is_along_view(DVec3::Y) => Ok(if back.y > 0.0 { DVec3::NEG_Z } else { DVec3::Z }),
            None => Ok(DVec3::Y),
        }
    }

    fn depth_range(&self, distance: f64, radius: f64, depths: impl Iterator<Item = f64>) -> Result<(f64, f64)> {
        let (nearest, farthest) =
            depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), depth| (low.min(depth), high.max(depth)));
        let margin = DEPTH_MARGIN * (farthest - nearest).max(radius * NEAREST_FRACTION);
        // If everything is behind the eye, any range will do: the picture is empty.
        let fitted_far = if farthest + margin > 0.0 { farthest + margin } else { distance + radius };
        let far = self.far.unwrap_or(fitted_far.max(self.near.map_or(0.0, |near| near * 2.0)));
        // Based on the fitted far plane: a distant given one must not push the near plane into the scene.
        let least_near = far.min(fitted_far) * NEAREST_FRACTION;
        let fitted_near = (nearest - margin).max(least_near);
        let near = self.near.unwrap_or(if fitted_near < far { fitted_near } else { far * 0.5 });
        if near >= far {
            return Err(Error::settings(
                &["near", "far"],
                format!(
                    "the near plane must be nearer to the eye than the far plane; they are {} and {} away",
                    short(near),
                    short(far)
                ),
            ));
        }
        Ok((near, far))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerances::{FRAME_FILL, OUTLINE_FILL};

    fn box_corners(half: DVec3, centre: DVec3) -> Vec<DVec3> {
        (0..8).map(|i| centre + half * DVec3::new(sign(i & 1), sign(i >> 1 & 1), sign(i >> 2))).collect()
    }

    fn sign(bit: i32) -> f64 {
        f64::from(bit * 2 - 1)
    }

    fn fit(settings: &CameraSettings, points: &[DVec3], aspect: f64) -> Result<Camera> {
        let (low, high) = crate::mesh::bounds(points);
        settings.fit((low + high) * 0.5, (high - low).length() * 0.5, aspect, points.iter().copied())
    }

    #[test]
    fn every_named_view_shows_all_of_the_scene_and_fills_the_picture() {
        let points = box_corners(DVec3::new(1.0, 2.0, 3.0), DVec3::new(10.0, -20.0, 5.0));
        for (name, ..) in View::NAMED {
            for (parallel, aspect) in [(false, 1.0), (true, 1.0), (false, 3.0), (true, 0.25)] {
                let settings = CameraSettings { view: name.parse().unwrap(), parallel, ..CameraSettings::default() };
                let camera = fit(&settings, &points, aspect).unwrap();
                let clip_from_world = camera.clip_from_view(aspect) * camera.view_from_world();
                let drawn: Vec<DVec3> = points.iter().map(|point| clip_from_world.project_point3(*point)).collect();
                let largest = drawn.iter().map(|ndc| ndc.x.abs().max(ndc.y.abs())).fold(0.0, f64::max);
                let (nearest, farthest) =
                    drawn.iter().fold((1.0f64, -1.0f64), |(n, f), ndc| (n.min(ndc.z), f.max(ndc.z)));
                assert!((-1.0..-0.9).contains(&nearest), "{name}: the nearest point has depth {nearest}");
                assert!((0.9..1.0).contains(&farthest), "{name}: the farthest point has depth {farthest}");
                assert!((largest - FRAME_FILL).abs() < 1e-9, "{name} parallel {parallel}: reaches {largest}");
            }
        }
    }

    #[test]
    fn the_front_view_looks_along_minus_z_and_the_right_view_from_plus_x() {
        let points = box_corners(DVec3::ONE, DVec3::ZERO);
        let camera = |view: &str| {
            fit(&CameraSettings { view: view.parse().unwrap(), ..CameraSettings::default() }, &points, 1.0).unwrap()
        };
        let front = camera("front");
        assert_eq!((front.eye.x, front.eye.y), (0.0, 0.0));
        assert!(front.eye.z > 1.0);
        assert!(camera("right").eye.x > 1.0);
        assert!(camera("left").eye.x < -1.0);
        assert_eq!(camera("top").up, DVec3::NEG_Z);
        assert!(camera("45,10").eye.y > 0.0);
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let points = box_corners(DVec3::ONE, DVec3::ZERO);
        let refused = |settings: CameraSettings| fit(&settings, &points, 1.0).unwrap_err().to_string();
        let base = CameraSettings::default;
        let eye = Some(DVec3::new(0.0, 0.0, 5.0));
        assert!(refused(CameraSettings { eye, target: eye, ..base() }).contains("same point"));
        assert!(refused(CameraSettings { eye, up: Some(DVec3::Z), ..base() }).contains("along the view"));
        for length in [0.0, 1e-200, 1e200, f64::NAN] {
            assert!(refused(CameraSettings { up: Some(DVec3::X * length), ..base() }).contains("up"), "{length}");
        }
        assert!(refused(CameraSettings { eye: Some(DVec3::Z * 1e200), ..base() }).contains("eye"));
        for fov_y_degrees in [0.0, -1.0, 180.0, f64::NAN] {
            assert!(refused(CameraSettings { fov_y_degrees, ..base() }).contains("fov"));
        }
        assert!(refused(CameraSettings { near: Some(3.0), far: Some(3.0), ..base() }).contains("near and far: "));
        assert!(refused(CameraSettings { near: Some(-1.0), ..base() }).contains("near"));
        assert!(refused(CameraSettings { eye: Some(DVec3::NAN), ..base() }).contains("eye"));
        for view in ["sideways", "1", "1,2,3", "0,91", "nan,0"] {
            assert!(view.parse::<View>().is_err(), "{view}");
        }
    }

    #[test]
    fn by_its_outline_a_scene_is_centred_and_reaches_the_margin() {
        let lopsided: Vec<DVec3> = (0..40)
            .map(|n| f64::from(n) * 0.7)
            .map(|a| DVec3::new(a.sin() * 3.0 + a, (a * 1.7).cos() * (2.0 + a * 0.1), (a * 0.3).sin() * a))
            .collect();
        for (parallel, fov_y_degrees, aspect) in
            [(false, 30.0, 1.0), (false, 90.0, 2.5), (false, 60.0, 0.3), (true, 30.0, 1.5)]
        {
            for view in ["30,15", "front", "200,-70", "top"] {
                let view = view.parse().unwrap();
                let settings = CameraSettings {
                    view,
                    parallel,
                    fov_y_degrees,
                    framing: Framing::Outline,
                    ..CameraSettings::default()
                };
                let camera = fit(&settings, &lopsided, aspect).unwrap();
                let clip_from_world = camera.clip_from_view(aspect) * camera.view_from_world();
                let seen = lopsided.iter().map(|point| clip_from_world.project_point3(*point));
                let (low, high) =
                    seen.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), ndc| (low.min(ndc), high.max(ndc)));
                // A thousandth of the half-width is a quarter of a pixel of 512.
                assert!((low + high).truncate().abs().max_element() < 1e-3, "{settings:?}: {low} to {high}");
                assert!((high.truncate().max_element() - OUTLINE_FILL).abs() < 1e-3, "{settings:?}: {high}");
                // A given target is not moved.
                let settings = CameraSettings { target: Some(DVec3::X), ..settings };
                assert_eq!(fit(&settings, &lopsided, aspect).unwrap().target, DVec3::X);
            }
        }
    }

    #[test]
    fn a_far_plane_given_far_away_cuts_nothing_off() {
        let points = box_corners(DVec3::ONE, DVec3::ZERO);
        for far in [1e3, 1e6, 1e9] {
            let camera = fit(&CameraSettings { far: Some(far), ..CameraSettings::default() }, &points, 1.0).unwrap();
            let nearest =
                points.iter().map(|point| -camera.view_from_world().transform_point3(*point).z).fold(far, f64::min);
            assert!(camera.near < nearest, "near plane {} but the scene begins at {nearest}", camera.near);
        }
    }

    #[test]
    fn an_eye_inside_the_scene_still_has_a_near_plane() {
        let points = box_corners(DVec3::ONE, DVec3::ZERO);
        let settings = CameraSettings {
            eye: Some(DVec3::new(0.1, 0.0, 0.0)),
            target: Some(DVec3::X),
            ..CameraSettings::default()
        };
        let camera = fit(&settings, &points, 1.0).unwrap();
        assert!(camera.near > 0.0 && camera.near < camera.far);
    }
}
