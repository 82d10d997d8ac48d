//! Extreme cases for numbers and input files, each with its expected outcome.
//!
//! In: [`cases`], plain values that say what is extreme, what must happen and which number shows it. Out: a [`Row`] for each
//! case, style and backend with its verdict. What the figures mean, and what they were, stands in docs/results/stability.md.
//!
//! ```no_run
//! # fn main() -> tinta::Result<()> {
//! use tinta::Backend;
//! use tinta_lab::stress::{StressSettings, run};
//!
//! let settings = StressSettings { only: Some("empty".to_owned()), backends: vec![Backend::Auto], ..Default::default() };
//! let summary = run(&settings, |done, all| println!("{done} of {all}"))?;
//! assert_eq!(summary.failures().count(), 0);
//! # Ok(())
//! # }
//! ```

mod cases;
mod drawing;
mod failing;
mod figures;
mod jitter;
mod outcome;
mod reading;
mod run;
mod shapes;
mod table;
mod variants;

pub use cases::{Case, Check, Content, Drawing, Expected, Group, Study, Work, cases};
pub use jitter::{Flips, Popped};
pub use run::{MissingBackend, Row, StressSettings, Summary, run};
pub use shapes::Shape;
pub use variants::Variant;
