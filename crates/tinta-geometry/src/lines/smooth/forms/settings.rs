//! The settings of form lines.

use crate::error::{Error, Result};
use crate::settings::{Setting, under};

/// Which form lines are strong enough to be drawn. Thresholds have no unit, because lengths are relative to the
/// model's feature size, of [`crate::curvature`].
#[derive(Debug, Clone, PartialEq)]
pub struct FormSettings {
    /// Least growth of the curvature along the view, towards the eye, for a suggestive contour. Default 0.01; a
    /// larger value drops shallow contours, which come and go as the model turns.
    pub suggestive_threshold: f64,
    /// Least curvature of a ridge or valley. Default 0.1; a larger value keeps only sharp ones.
    pub ridge_threshold: f64,
    /// Standard deviation of the Gaussian that smooths normals before curvature is computed, in edge lengths. Default
    /// 1; a larger value draws fewer, longer lines and moves them off small features.
    pub smoothing: f64,
}

/// Largest smoothing, in edge lengths: more leaves hardly any shape and takes long.
const LARGEST_SMOOTHING: f64 = 10.0;

impl Default for FormSettings {
    fn default() -> Self {
        Self { suggestive_threshold: 0.01, ridge_threshold: 0.1, smoothing: 1.0 }
    }
}

impl FormSettings {
    /// The settings, for tables of structs that contain form lines.
    pub fn settings() -> Vec<Setting<Self>> {
        let settings = vec![
            Setting::field(
                "suggestive-threshold",
                "NUMBER",
                "Least growth of the curvature along the view that makes a suggestive contour; more draws fewer",
                |forms: &mut Self| &mut forms.suggestive_threshold,
            )
            .inside("form-lines")
            .range(0.0, 0.1, 3),
            Setting::field(
                "ridge-threshold",
                "NUMBER",
                "Least curvature of a ridge or valley; more draws fewer",
                |forms: &mut Self| &mut forms.ridge_threshold,
            )
            .inside("form-lines")
            .range(0.0, 1.0, 2),
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
        let thresholds =
            [("suggestive-threshold", self.suggestive_threshold), ("ridge-threshold", self.ridge_threshold)];
        if let Some((name, value)) = thresholds.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0)) {
            return Err(Error::value(name, value, "the threshold is a number, 0 or more"));
        }
        if !(0.0..=LARGEST_SMOOTHING).contains(&self.smoothing) {
            let problem = format!("the smoothing is between 0 and {LARGEST_SMOOTHING} edge lengths");
            return Err(Error::value("curvature-smoothing", self.smoothing, problem));
        }
        Ok(())
    }
}
