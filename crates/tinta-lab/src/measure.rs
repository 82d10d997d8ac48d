//! Error against run time: every setting of every style on a model, measured against exact references.
//!
//! Takes models and a list of settings, and returns a [`Row`] for each as soon as it is known. docs/results/measuring.md explains
//! the numbers.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use std::sync::Arc;
//! use tinta_lab::measure::Reference;
//! use tinta::{LineSettings, LoadOptions, Scene, SceneSettings, load};
//!
//! let mesh = load("builtin:open-box", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let reference = Reference::of(&scene, &LineSettings::as_published())?;
//! assert!(reference.length_px() > 1000.0, "all visible lines of the box, in a picture of 512 pixels");
//! # Ok(())
//! # }
//! ```

mod error_picture;
mod ink;
mod reference;
mod row;
#[cfg(feature = "measuring")]
mod drawn;
#[cfg(feature = "measuring")]
mod run;
#[cfg(feature = "measuring")]
mod shading;
#[cfg(feature = "measuring")]
mod tone_borders;
#[cfg(feature = "measuring")]
mod tones;

#[cfg(feature = "measuring")]
pub use drawn::{line_options, measure_lines};
pub use error_picture::error_picture;
pub use ink::{INK_FROM, Ink, InkVerdicts, Verdict};
#[cfg(feature = "judging")]
pub(crate) use reference::samples_of;
pub use reference::{Reference, SOFT_CREASE_DEGREES, Sample};
pub use row::{Against, LineError, PassRow, Row, RunTime, ToneBorderError, ToneError};
#[cfg(feature = "measuring")]
pub use run::{MeasureSettings, MeasureStep, Measured, MeasuredStyle, Subject, frames_a_turn, measure, turns};
#[cfg(feature = "measuring")]
pub(crate) use run::{quartiles, shading_of};
#[cfg(feature = "measuring")]
pub use tones::ReferenceLight;
