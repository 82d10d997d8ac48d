//! Extreme cases for numbers and input files, each with its expected outcome.
//!
//! Takes [`cases()`], plain values that state an extreme, the required outcome and the number that shows it; returns a [`Row`] for
//! each case, style and backend with its verdict. docs/results/stability.md has the figures and their meaning.
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
mod closed_form;
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
mod written;

pub use cases::{Case, Check, Content, Demand, Drawing, Group, Study, Work, cases};
pub use jitter::Flips;
pub use run::{MissingBackend, Row, StressSettings, Summary, run};
pub use shapes::Shape;
pub use variants::Variant;
pub use written::WrittenShape;
