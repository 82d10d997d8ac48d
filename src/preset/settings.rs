//! Settings written as options: those that differ from the default, in words that the command line reads back as the same
//! settings. A test beside the options' definitions shows that for every option.
//!
//! Each struct is taken apart by name, so that a new setting without an option here does not compile.

use super::{OptionValue, Options};
use crate::camera::{CameraSettings, View};
use crate::edges::{Class, ClassSet, CreaseAngle};
use crate::error::{Error, Result};
use crate::lines::{ClassWidths, Hidden, LineSettings, PaperSize, SvgSettings};
use crate::mesh::{LoadOptions, Normals, UpAxis};
use crate::names::name_of;
use crate::scene::{Background, SceneSettings};
use crate::styles::{ClassColors, Show};
use glam::DVec3;
use std::fmt::Display;
use std::path::Path;

/// The option that shows this picture; none for the finished one.
pub fn of_show(show: Show) -> Options {
    let mut changed = Changed::default();
    changed.choice("show", &Show::ALL, show, Show::default());
    changed.0
}

/// The options that make a scene's settings.
pub fn of_scene(settings: &SceneSettings) -> Options {
    let SceneSettings { copies, camera, size, background, color } = settings;
    let default = SceneSettings::default();
    let mut changed = Changed::default();
    changed.number("copies", *copies, default.copies);
    changed.number("size", *size, default.size);
    match background {
        Background::Transparent => changed.flag("transparent", true),
        Background::Color(color) if *background != default.background => changed.set("background", color),
        Background::Color(_) => {}
    }
    changed.given("color", *color);
    changed.camera(camera);
    changed.0
}

/// The options that make models be read so.
///
/// # Errors
///
/// [`Error::Setting`] for a skin whose name is no text.
pub fn of_load(options: &LoadOptions) -> Result<Options> {
    let LoadOptions { weld, normals, smooth_angle_degrees, up_axis, strict, model_frame, skin, allow_external } =
        options;
    let default = LoadOptions::default();
    let mut changed = Changed::default();
    changed.number("weld", *weld, default.weld);
    changed.choice("normals", &Normals::ALL, *normals, default.normals);
    changed.number("smooth-angle", *smooth_angle_degrees, default.smooth_angle_degrees);
    changed.choice("up-axis", &UpAxis::ALL, *up_axis, default.up_axis);
    changed.flag("strict", *strict);
    if *model_frame != default.model_frame {
        changed.set("model-frame", model_frame);
    }
    changed.path("skin", skin.as_deref())?;
    changed.flag("allow-external", *allow_external);
    Ok(changed.0)
}

/// The options that make the style `lines` find and draw so; background and picture size belong to the scene.
///
/// # Errors
///
/// [`Error::Setting`] for no class at all.
pub fn of_lines(lines: &LineSettings, drawn: &SvgSettings) -> Result<Options> {
    let LineSettings { classes, crease_angle } = lines;
    let SvgSettings {
        title: _,
        command: _,
        recipe: _,
        hidden,
        class_colors,
        line_width_px,
        class_widths,
        background: _,
        paper_size,
        has_provenance,
        is_for_pen,
    } = drawn;
    let default = SvgSettings::default();
    let mut changed = Changed::default();
    changed.set("style", "lines");
    changed.classes(*classes, LineSettings::default().classes)?;
    changed.crease_angle(*crease_angle);
    changed.choice("hidden", &Hidden::ALL, *hidden, default.hidden);
    changed.class_colors(class_colors);
    changed.number("line-width", *line_width_px, default.line_width_px);
    if *class_widths != ClassWidths::default() {
        let widths = Class::ALL.iter().zip(class_widths.0);
        let widths = widths.filter_map(|((name, _), width)| width.map(|width| format!("{name}={width}")));
        changed.set("class-widths", widths.collect::<Vec<_>>().join(","));
    }
    match paper_size {
        PaperSize::Unset => {}
        PaperSize::WidthMm(width) => changed.set("width-mm", width),
        PaperSize::Dpi(dpi) => changed.set("dpi", dpi),
    }
    changed.flag("provenance", *has_provenance);
    changed.flag("pen", *is_for_pen);
    Ok(changed.0)
}

/// The options that differ from the default.
#[derive(Default)]
pub(super) struct Changed(pub(super) Options);

impl Changed {
    pub(super) fn set(&mut self, name: &str, value: impl Display) {
        self.0.insert(name.to_owned(), OptionValue::Text(value.to_string()));
    }

    /// Whatever is written as the command line reads it.
    pub(super) fn number<T: Display + PartialEq>(&mut self, name: &str, value: T, default: T) {
        if value != default {
            self.set(name, value);
        }
    }

    pub(super) fn numbers<const N: usize>(&mut self, name: &str, values: [f32; N], default: [f32; N]) {
        if values != default {
            self.set(name, values.map(|value| value.to_string()).join(","));
        }
    }

    pub(super) fn given(&mut self, name: &str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.set(name, value);
        }
    }

    pub(super) fn choice<T: Copy + PartialEq>(
        &mut self,
        name: &str,
        table: &[(&'static str, T)],
        value: T,
        default: T,
    ) {
        if value != default {
            self.set(name, name_of(table, value));
        }
    }

    pub(super) fn on_off(&mut self, name: &str, value: bool, default: bool) {
        if value != default {
            self.set(name, if value { "on" } else { "off" });
        }
    }

    pub(super) fn flag(&mut self, name: &str, value: bool) {
        if value {
            self.0.insert(name.to_owned(), OptionValue::Switch(true));
        }
    }

    pub(super) fn path(&mut self, name: &str, path: Option<&Path>) -> Result<()> {
        let Some(path) = path else { return Ok(()) };
        let text = path.to_str().ok_or_else(|| {
            Error::setting(
                format!("--{name} {}", path.display()),
                "this name is no text that could be kept; rename the file",
            )
        })?;
        self.set(name, text);
        Ok(())
    }

    pub(super) fn cull(&mut self, cull_back_faces: bool) {
        if cull_back_faces {
            self.set("cull", "back");
        }
    }

    pub(super) fn crease_angle(&mut self, angle: CreaseAngle) {
        if angle != CreaseAngle::default() {
            self.set("crease-angle", written_degrees(angle));
        }
    }

    pub(super) fn classes(&mut self, classes: ClassSet, default: ClassSet) -> Result<()> {
        if classes.is_empty() {
            return Err(Error::setting("--classes", "no class is left; choose one at least, or --no-borders"));
        }
        if classes != default {
            self.set("classes", classes.classes().map(Class::name).collect::<Vec<_>>().join(","));
        }
        Ok(())
    }

    pub(super) fn class_colors(&mut self, colors: &ClassColors) {
        let default = ClassColors::default();
        if *colors != default {
            let all = Class::ALL.iter().zip(colors.0.iter().zip(default.0));
            let all = all.filter(|(_, (color, default))| *color != default);
            let all = all.map(|((name, _), (color, _))| format!("{name}={color}"));
            self.set("class-colors", all.collect::<Vec<_>>().join(","));
        }
    }

    pub(super) fn camera(&mut self, camera: &CameraSettings) {
        let CameraSettings { view, eye, target, up, fov_y_degrees, parallel, height, near, far } = camera;
        let default = CameraSettings::default();
        let vector = |vector: DVec3| format!("{},{},{}", vector.x, vector.y, vector.z);
        // An eye stands where it stands, wherever the view would have put it.
        if eye.is_none() && *view != default.view {
            let View { azimuth_degrees, elevation_degrees } = view;
            self.set("view", format!("{azimuth_degrees},{elevation_degrees}"));
        }
        self.given("eye", eye.map(vector));
        self.given("target", target.map(vector));
        self.given("up", up.map(vector));
        self.number("fov", *fov_y_degrees, default.fov_y_degrees);
        self.flag("parallel", *parallel);
        self.given("height", *height);
        self.given("near", *near);
        self.given("far", *far);
    }
}

/// The shortest number of degrees that is read back as this angle, or the nearest one where none is.
fn written_degrees(angle: CreaseAngle) -> f64 {
    let degrees = angle.degrees();
    let is_it = |degrees: &f64| CreaseAngle::from_degrees(*degrees).is_ok_and(|found| found == angle);
    let rounded = (0..=14).filter_map(|decimals| format!("{degrees:.decimals$}").parse::<f64>().ok());
    let near = (0..32).scan((degrees, degrees), |(below, above), _| {
        (*below, *above) = (below.next_down(), above.next_up());
        Some([*below, *above])
    });
    rounded.chain(near.flatten()).find(is_it).unwrap_or(degrees)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_as_by_default_is_not_written() {
        assert!(of_scene(&SceneSettings::default()).is_empty());
        assert!(of_load(&LoadOptions::default()).unwrap().is_empty() && of_show(Show::Final).is_empty());
        assert_eq!(of_lines(&LineSettings::default(), &SvgSettings::default()).unwrap().len(), 1);
    }

    #[test]
    fn every_angle_given_in_degrees_is_written_as_that_angle() {
        assert_eq!(written_degrees(CreaseAngle::from_degrees(45.0).unwrap()), 45.0);
        for step in 0..=18_000 {
            let angle = CreaseAngle::from_degrees(f64::from(step) * 0.01 * (1.0 - 1e-13)).unwrap();
            assert_eq!(CreaseAngle::from_degrees(written_degrees(angle)).unwrap(), angle, "{step}");
        }
        let listing = CreaseAngle::default();
        assert_eq!(CreaseAngle::from_degrees(listing.degrees()).unwrap(), listing);
        assert_ne!(CreaseAngle::from_degrees(66.4).unwrap(), listing);
    }
}
