//! The laboratory of tinta, which measures the quality of drawings. It lies above the library `tinta`, which draws.
//!
//! | for | see |
//! |---|---|
//! | error against run time | [`measure`], `report`, `figures` |
//! | two styles' lines beside each other | [`compare`] |
//! | anyone's drawing against the exact lines | `judge` |
//! | extreme cases | `stress` |
//! | the commands, as the program registers them | `commands` |
//!
//! # Cargo features
//!
//! None is on by default. `cli` brings the commands, `window` the measure that the window shows.

#![deny(unreachable_pub)]

// Floors, from the ground up: a module uses only those above it in this list (`tests/documents/floors.rs`).
pub mod compare;
#[cfg(feature = "cli")]
mod canvas;
#[cfg(feature = "cli")]
pub mod contact_sheet;
pub mod measure;
pub mod judge;
pub mod report;
pub mod figures;
pub mod stress;
#[cfg(feature = "window")]
mod window;
#[cfg(feature = "cli")]
mod commands;

#[cfg(feature = "cli")]
pub use commands::{commands, program};
#[cfg(feature = "window")]
pub use window::line_measure;
