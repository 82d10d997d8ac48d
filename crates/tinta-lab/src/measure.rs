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

mod conditions;
mod error_picture;
mod frames;
mod ink;
mod reference;
mod row;
mod drawn;
mod run;
mod shading;
mod tone_borders;
mod tones;

pub use conditions::Conditions;
pub use drawn::{line_options, measure_lines};
pub(crate) use error_picture::error_picture;
pub(crate) use frames::{FrameTimes, quartiles};
pub use ink::{INK_FROM, Ink, InkVerdicts, Verdict};
pub(crate) use reference::samples_of;
pub use reference::{Reference, Sample};
pub use row::{Against, LineError, PassRow, Row, RunTime, ToneBorderError, ToneError};
pub(crate) use run::shading_of;
pub use run::{MeasureSettings, MeasureStep, MeasuredStyle, Measurement, Subject, frames_a_turn, measure, turns};
pub use tones::ReferenceLight;
