//! Error against run time: every setting of every style on a model, measured against exact references.
//!
//! In: models and a list of settings. Out: a [`Row`] for each as soon as it is known. What the numbers mean stands in
//! docs/measuring.md.

mod ink;
mod reference;
mod row;
mod run;
mod shading;
mod tones;

pub use ink::{INK_FROM, Ink, InkVerdicts, Verdict};
pub use reference::{Reference, SOFT_CREASE_DEGREES, Sample};
pub use row::{LineError, PassRow, Row, RunTime, ToneError};
pub(crate) use run::shading_of;
pub use run::{MeasureSettings, Measured, Setting, Subject, measure, steps};
pub use tones::ReferenceLight;
