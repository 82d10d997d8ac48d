//! Whether a driver draws as the ones that tinta was made with: `tinta info --check`.
//!
//! Takes a backend and returns a [`DriverCheck`] for each of its contexts: pictures of small scenes in every style beside reference
//! pictures, which are part of the program; answers to questions that the styles rest on; the known faults of such a driver.
//! docs/dev/testing.md has the measurements.
//!
//! ```
//! use tinta::drivers::check;
//!
//! for checked in check(tinta::Backend::Auto) {
//!     match &checked.found {
//!         Some(found) => println!("{}: as it should be: {}", checked.device, found.is_good()),
//!         None => println!("{}: {}", checked.device, checked.error.unwrap_or_default()),
//!     }
//! }
//! ```

mod known;

use crate::error::Result;
use crate::gl::context::{Context, each};
pub use crate::gl::probe::Probe;
use crate::gl::{Backend, ContextInfo};
use crate::mesh::{LoadOptions, load};
use crate::picture::Picture;
use crate::renderer::Renderer;
use crate::scene::{Scene, SceneSettings, Size};
use crate::styles::{Style, StyleName};
pub(crate) use known::KNOWN;
pub use known::KnownFault;
use serde::Serialize;
use std::sync::Arc;

/// Width and height of the small scenes, pixels.
const SIDE: u32 = 96;

/// The largest difference of a channel that counts as the same shade. Drivers may round differently. The goldens use the same
/// limit.
const OTHER_SHADE: u8 = 3;

/// Share of pixels of other shades that a driver may have: edges fall on other pixels if it rasterises differently. The goldens
/// use the same limit.
const OTHER_SHARE: f64 = 0.005;

/// The reference pictures, drawn by llvmpipe of Mesa 22.3.6 on EGL and looked at once.
const REFERENCES: [(StyleName, &[u8]); 10] = [
    (StyleName::Phong, include_bytes!("drivers/phong.png")),
    (StyleName::ThreePass, include_bytes!("drivers/three-pass.png")),
    (StyleName::TwoPass, include_bytes!("drivers/two-pass.png")),
    (StyleName::Mrt, include_bytes!("drivers/mrt.png")),
    (StyleName::Inking, include_bytes!("drivers/inking.png")),
    (StyleName::Dietrich, include_bytes!("drivers/dietrich.png")),
    (StyleName::BackFaces, include_bytes!("drivers/back-faces.png")),
    (StyleName::Ink, include_bytes!("drivers/ink.png")),
    (StyleName::Charcoal, include_bytes!("drivers/charcoal.png")),
    (StyleName::Sand, include_bytes!("drivers/sand.png")),
];

/// One backend, and its driver's drawings.
#[derive(Debug, Clone, Serialize)]
pub struct DriverCheck {
    /// The library, and the device if there are several.
    pub device: String,
    /// The check's findings, if a context opened.
    pub found: Option<DriverFindings>,
    /// The reason why no context opened.
    pub error: Option<String>,
}

/// The pictures and answers of a context.
#[derive(Debug, Clone, Serialize)]
pub struct DriverFindings {
    /// The context's own description.
    pub context: ContextInfo,
    /// Its picture of each style, beside the reference.
    pub styles: Vec<StyleCheck>,
    /// The driver's answers.
    pub probes: Vec<Probe>,
    /// The reason why the probe failed, if it failed.
    pub not_probed: Option<String>,
    /// The known faults of such drivers.
    pub known_faults: Vec<KnownFault>,
}

/// A style's picture beside the reference.
#[derive(Debug, Clone, Default, Serialize)]
pub struct StyleCheck {
    /// The style's name.
    pub style: &'static str,
    /// Pixels that are not the reference's, byte for byte; `None` where the style could not be drawn.
    pub differing: Option<usize>,
    /// The number of these whose difference exceeds rounding.
    pub of_other_shades: usize,
    /// The largest difference of a channel, of 255.
    pub largest: u8,
    /// Whether few enough are.
    pub passed: bool,
    /// Why it could not be drawn.
    pub problem: Option<String>,
}

impl DriverFindings {
    /// Whether every style and every answer is as it should be.
    pub fn is_good(&self) -> bool {
        self.not_probed.is_none()
            && self.probes.iter().all(|probe| probe.passed)
            && self.styles.iter().all(|drawn| drawn.passed)
    }
}

/// Checks every way of this backend, one after the other.
pub fn check(backend: Backend) -> Vec<DriverCheck> {
    let found = |mut renderer: Renderer| {
        let context = renderer.context().clone();
        let styles = REFERENCES.map(|(style, reference)| StyleCheck::of(&mut renderer, style, reference)).to_vec();
        let known_faults = KNOWN.iter().filter(|fault| (fault.is_of)(&context)).cloned().collect();
        let (probes, not_probed) = match renderer.probe() {
            Ok(probes) => (probes, None),
            Err(error) => (Vec::new(), Some(error.to_string())),
        };
        DriverFindings { context, styles, probes, not_probed, known_faults }
    };
    let checked = |(device, opened): (String, std::result::Result<Context, String>)| match opened {
        Ok(context) => DriverCheck { device, found: Some(found(Renderer::of(context))), error: None },
        Err(error) => DriverCheck { device, found: None, error: Some(error) },
    };
    each(backend).map(checked).collect()
}

/// The small scene of a style: sand's needs a model with a picture on it.
fn scene(style: StyleName) -> Result<Scene> {
    let model = if style == StyleName::Sand { "builtin:soldier" } else { "builtin:bust" };
    let settings = SceneSettings { size: Size { width: SIDE, height: SIDE }, ..SceneSettings::default() };
    Scene::new(vec![Arc::new(load(model, &LoadOptions::default())?.mesh)], &settings)
}

impl StyleCheck {
    fn of(renderer: &mut Renderer, name: StyleName, reference: &[u8]) -> Self {
        let style = StyleName::of_passes().find(|(_, known)| *known == name).map_or("", |(style, _)| style);
        let pictures = Picture::from_bytes(reference, style)
            .and_then(|reference| Ok((reference, renderer.render(&scene(name)?, &Style::named(name))?.opaque())));
        match pictures {
            Ok((reference, picture)) => Self::compared(style, &reference, &picture),
            Err(error) => Self { style, problem: Some(error.to_string()), ..Self::default() },
        }
    }

    fn compared(style: &'static str, reference: &Picture, picture: &Picture) -> Self {
        let pairs = reference.pixels.chunks_exact(4).zip(picture.pixels.chunks_exact(4));
        let differences = pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or_default());
        let differences: Vec<u8> = differences.collect();
        let more_than = |least: u8| differences.iter().filter(|difference| **difference > least).count();
        let of_other_shades = more_than(OTHER_SHADE);
        Self {
            style,
            differing: Some(more_than(0)),
            of_other_shades,
            largest: differences.iter().copied().max().unwrap_or_default(),
            passed: reference.size == picture.size
                && of_other_shades as f64 <= OTHER_SHARE * reference.size.pixel_count() as f64,
            problem: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_style_has_a_reference() {
        let names = REFERENCES.map(|(name, _)| name);
        assert!(
            StyleName::of_passes().all(|(_, name)| names.contains(&name))
                && names.len() == StyleName::of_passes().count()
        );
    }

    #[test]
    fn references_are_what_is_drawn_here() {
        if std::env::var_os("TINTA_UPDATE_GOLDENS").is_some() {
            let mut renderer = Renderer::new(Backend::Auto).unwrap();
            for (name, _) in REFERENCES {
                let picture = renderer.render(&scene(name).unwrap(), &Style::named(name)).unwrap();
                let style = StyleName::of_passes().find(|(_, known)| *known == name).unwrap().0;
                let path = format!("{}/src/drivers/{style}.png", env!("CARGO_MANIFEST_DIR"));
                picture.opaque().save(path).unwrap();
            }
            panic!("the references were drawn anew: look at them, then run without TINTA_UPDATE_GOLDENS");
        }
        let checked = check(Backend::Auto);
        let found: Vec<&DriverFindings> = checked.iter().filter_map(|checked| checked.found.as_ref()).collect();
        assert!(!found.is_empty());
        found.iter().for_each(|found| assert!(found.is_good(), "{found:#?}"));
    }

    #[test]
    fn a_picture_of_other_shades_is_found_and_counted() {
        let (_, reference) = REFERENCES[1];
        let reference = Picture::from_bytes(reference, "three-pass").unwrap();
        let of = |change: &dyn Fn(usize, &mut [u8])| {
            let mut picture = reference.clone();
            picture.pixels.chunks_exact_mut(4).enumerate().for_each(|(place, pixel)| change(place, pixel));
            let drawn = StyleCheck::compared("three-pass", &reference, &picture);
            (drawn.differing.unwrap(), drawn.of_other_shades, drawn.largest, drawn.passed)
        };
        let all = (SIDE * SIDE) as usize;
        let by = |amount: u8| move |_: usize, pixel: &mut [u8]| pixel[1] ^= amount;
        assert_eq!(of(&by(0)), (0, 0, 0, true));
        assert_eq!(of(&by(1)), (all, 0, 1, true));
        assert_eq!(of(&by(128)), (all, all, 128, false));
        let some = |count: usize| move |place: usize, pixel: &mut [u8]| pixel[0] ^= if place < count { 128 } else { 0 };
        assert_eq!(of(&some(46)), (46, 46, 128, true));
        assert_eq!(of(&some(47)), (47, 47, 128, false));
    }
}
