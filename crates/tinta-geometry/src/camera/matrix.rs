//! Camera settings from a matrix of another program: clip space from world space.

use super::{CameraSettings, View};
use crate::error::ParseError;
use glam::{DMat3, DMat4, DVec3, DVec4, Vec4Swizzles};

/// Relative tolerance for right angles, a centred axis and equal lengths, because matrices are often written with
/// seven digits.
const SLACK: f64 = 1e-4;

impl CameraSettings {
    /// Returns the aspect (width over height) of the picture that a matrix to clip space is for, with square pixels.
    pub fn aspect_of_clip_from_world(matrix: &DMat4) -> f64 {
        matrix.row(1).xyz().length() / matrix.row(0).xyz().length()
    }

    /// Returns the camera with this matrix to clip space, whose aspect
    /// [`aspect_of_clip_from_world`](Self::aspect_of_clip_from_world) returns. x points right and
    /// y up. In perspective the depth may have any form; in a parallel projection it must grow away from the eye. The
    /// near and far planes stay unset and are fitted.
    ///
    /// # Errors
    ///
    /// A sentence if the matrix is not a camera's, mirrors or shears, or if its axis is not in the picture's centre.
    pub fn of_clip_from_world(matrix: &DMat4) -> std::result::Result<Self, ParseError> {
        if !matrix.is_finite() {
            return Err("a camera's matrix has finite numbers only".to_owned().into());
        }
        let [x, y, w] = [0, 1, 3].map(|row| matrix.row(row));
        let size = x.xyz().length().max(y.xyz().length());
        match w.xyz().length() > SLACK * SLACK * size {
            true => perspective(x, y, w),
            false => parallel(x, y, matrix.row(2).xyz(), w.w),
        }
    }
}

/// Refuses impossible axes: `right` and `up` with their lengths in the matrix, `backward` of length 1.
fn check(right: DVec3, up: DVec3, backward: DVec3) -> std::result::Result<(), ParseError> {
    let refused = |problem: &str| Err(format!("a camera's matrix {problem}").into());
    if !(right.length() > 0.0 && up.length() > 0.0) {
        return refused("shows a width and a height");
    }
    let (right, up) = (right.normalize(), up.normalize());
    if right.dot(up).abs().max(right.dot(backward).abs()).max(up.dot(backward).abs()) > SLACK {
        return refused(
            "has its picture's axes at right angles; this one shears, or its picture's middle is off the axis",
        );
    }
    if right.cross(up).dot(backward) < 0.0 {
        return refused("does not mirror; give the one whose y is up and whose x is to the right");
    }
    Ok(())
}

fn perspective(x: DVec4, y: DVec4, w: DVec4) -> std::result::Result<CameraSettings, ParseError> {
    let length = w.xyz().length();
    let [x, y, w] = [x, y, w].map(|row| row / length);
    let backward = -w.xyz();
    check(x.xyz(), y.xyz(), backward)?;
    // At the eye all three rows are zero.
    let eye = DMat3::from_cols(x.xyz(), y.xyz(), w.xyz()).transpose().inverse() * -DVec3::new(x.w, y.w, w.w);
    if !eye.is_finite() {
        return Err("a camera's matrix has an eye".to_owned().into());
    }
    // Any point on the axis will do; one near the origin, where models are, keeps the most digits.
    let ahead = eye.dot(backward);
    let distance = if ahead > 0.0 { ahead } else { eye.length().max(1.0) };
    Ok(CameraSettings {
        eye: Some(eye),
        target: Some(eye - backward * distance),
        up: Some(y.xyz().normalize()),
        fov_y_degrees: 2.0 * (1.0 / y.xyz().length()).atan().to_degrees(),
        ..CameraSettings::default()
    })
}

fn parallel(x: DVec4, y: DVec4, depth: DVec3, w: f64) -> std::result::Result<CameraSettings, ParseError> {
    if w == 0.0 {
        return Err("a camera's matrix has a last row that is not all zeros".to_owned().into());
    }
    let [x, y] = [x / w, y / w];
    let backward = x.xyz().cross(y.xyz()).try_normalize().unwrap_or(DVec3::ZERO);
    check(x.xyz(), y.xyz(), backward)?;
    // Only the depth tells front from back: a matrix with the opposite depth shows a mirrored picture.
    if (depth / w).dot(backward) >= 0.0 {
        return Err("a camera's matrix does not mirror: with x to the right and y up, depth grows away from the eye; \
                    turn the sign of one of these rows"
            .to_owned()
            .into());
    }
    // The axis's nearest point to the origin.
    let middle = -x.xyz() * (x.w / x.xyz().length_squared()) - y.xyz() * (y.w / y.xyz().length_squared());
    let view = View {
        azimuth_degrees: backward.x.atan2(backward.z).to_degrees(),
        elevation_degrees: backward.y.atan2(backward.x.hypot(backward.z)).to_degrees(),
    };
    Ok(CameraSettings {
        view,
        target: Some(middle),
        up: Some(y.xyz().normalize()),
        parallel: true,
        height: Some(2.0 / y.xyz().length()),
        ..CameraSettings::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> Vec<DVec3> {
        (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1) * 2.0, f64::from(i >> 2) * 3.0)).collect()
    }

    fn matrix_of(settings: &CameraSettings, aspect: f64) -> DMat4 {
        let camera = settings.fit(DVec3::new(0.5, 1.0, 1.5), 2.0, aspect, points().into_iter()).unwrap();
        camera.clip_from_view(aspect) * camera.view_from_world()
    }

    #[test]
    fn every_cameras_matrix_leads_back_to_what_it_shows() {
        for parallel in [false, true] {
            for view in ["30,15", "front", "top", "bottom", "-120,-60", "right"] {
                for aspect in [1.0, 1.6, 0.4] {
                    let view = view.parse().unwrap();
                    let settings = CameraSettings { view, parallel, fov_y_degrees: 41.0, ..CameraSettings::default() };
                    let matrix = matrix_of(&settings, aspect);
                    // Other programs write it with another factor and another depth range.
                    let others = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.5)) * matrix * 3.0;
                    for matrix in [matrix, others] {
                        let again = matrix_of(&CameraSettings::of_clip_from_world(&matrix).unwrap(), aspect);
                        assert!((CameraSettings::aspect_of_clip_from_world(&matrix) - aspect).abs() < 1e-9);
                        for point in points() {
                            let apart = again.project_point3(point) - matrix.project_point3(point);
                            assert!(apart.truncate().length() < 1e-9, "{settings:?}: {apart}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn what_no_camera_does_is_refused() {
        let matrix = matrix_of(&CameraSettings::default(), 1.0);
        let refused = |matrix: DMat4| CameraSettings::of_clip_from_world(&matrix).unwrap_err().to_string();
        assert!(refused(DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * matrix).contains("mirror"));
        let front = CameraSettings { parallel: true, ..CameraSettings::default() };
        for axis in [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, -1.0)] {
            assert!(refused(DMat4::from_scale(axis) * matrix_of(&front, 1.0)).contains("mirror"), "{axis}");
        }
        // x to the left and the nearest points at the largest z, as in a mirror.
        let mirror = [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 4.0];
        assert!(refused(DMat4::from_cols_array(&mirror)).contains("mirror"));
        assert!(refused(DMat4::from_translation(DVec3::new(0.2, 0.0, 0.0)) * matrix).contains("middle"));
        assert!(refused(DMat4::ZERO).contains("matrix"));
        for number in 0..16 {
            for value in [f64::NAN, f64::INFINITY] {
                let mut numbers = matrix_of(&front, 1.0).to_cols_array();
                numbers[number] = value;
                assert!(refused(DMat4::from_cols_array(&numbers)).contains("finite"), "{number}: {value}");
            }
        }
        // Nothing tells front from back.
        assert!(refused(DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0)) * matrix_of(&front, 1.0)).contains("depth"));
        assert!(refused(DMat4::from_cols_array(&[1.0; 16])).contains("matrix"));
    }
}
