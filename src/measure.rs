//! Error against run time: every setting of every style on a model, measured against exact references.
//!
//! In: models and a list of settings. Out: a [`Row`] for each as soon as it is known. What the numbers mean stands in
//! docs/measuring.md.

mod row;

pub use row::{LineError, PassRow, Row, RunTime, ToneError};
