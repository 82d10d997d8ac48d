//! The settings of form lines.

use crate::error::{Error, Result};
use crate::settings::{Setting, under};

/// Which form lines are strong enough to be drawn. Curvatures have no unit, because lengths are relative to the
/// model's feature size, of [`crate::curvature`].
#[derive(Debug, Clone, PartialEq)]
pub struct FormSettings {
    /// Least strength, in multiples of the usual. Default 1: curvature along the view that grows by 0.01 towards the eye for
    /// a suggestive contour, curvature of 0.1 for a ridge or valley. A larger value drops shallow lines, which come and go
    /// as the model turns.
    pub strength: f64,
    /// Standard deviation of the Gaussian that smooths normals before curvature is computed, in edge lengths. Default
    /// 1; a larger value draws fewer, longer lines and moves them off small features.
    pub smoothing: f64,
}

/// Largest smoothing, in edge lengths: more leaves hardly any shape and takes long.
const LARGEST_SMOOTHING: f64 = 10.0;

impl Default for FormSettings {
    fn default() -> Self {
        Self { strength: 1.0, smoothing: 1.0 }
    }
}

impl FormSettings {
    /// The settings, for tables of structs that contain form lines.
    pub(crate) fn settings() -> Vec<Setting<Self>> {
        let settings = vec![
            Setting::field(
                "form-lines",
                "STRENGTH",
                "Least strength of form lines, in multiples of the usual; more draws fewer",
                |forms: &mut Self| &mut forms.strength,
            )
            .range(0.0, 10.0, 1),
            Setting::field(
                "curvature-smoothing",
                "EDGES",
                "How far normals are smoothed before form lines are found, in edge lengths, 0 to 10; more draws fewer, longer lines",
                |forms: &mut Self| &mut forms.smoothing,
            )
            .inside("form-lines")
            .range(0.0, LARGEST_SMOOTHING, 1),
        ];
        under("Style lines: form lines, with --classes suggestive, ridge, valley", settings).collect()
    }

    /// Refuses invalid thresholds.
    pub(in crate::lines) fn check(&self) -> Result<()> {
        if !(self.strength.is_finite() && self.strength >= 0.0) {
            return Err(Error::value("form-lines", self.strength, "the strength is a number, 0 or more"));
        }
        if !(0.0..=LARGEST_SMOOTHING).contains(&self.smoothing) {
            let problem = format!("the smoothing is between 0 and {LARGEST_SMOOTHING} edge lengths");
            return Err(Error::value("curvature-smoothing", self.smoothing, problem));
        }
        Ok(())
    }
}
