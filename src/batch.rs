//! Batches: the jobs of a list, the journal of their results, and the summary of all journals.
//!
//! The input is a list of jobs, one line of JSON each ([`List`]). A run, or one of N [`Slice`]s of it, appends an [`Entry`] to
//! its own file for every finished job ([`Journal`]), on any machine. All those files together give a [`Summary`], with the same
//! bytes however the list was sliced. Times and drivers differ between runs and have a separate file. This module draws nothing;
//! `src/cli/batch.rs` carries the jobs out. For use, see docs/guide/batches.md.
//!
//! ```
//! use tinta::batch::{List, Slice};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let file = tempfile::NamedTempFile::new()?;
//! # let path = file.path();
//! let job = r#"{"id": "ant", "command": "render", "model": "builtin:ant", "output": "ant.png"}"#;
//! std::fs::write(path, job)?;
//! let ids: Vec<String> = List::read(path)?.jobs(Slice::WHOLE).map(|job| job.id).collect();
//! assert_eq!(ids, ["ant"]);
//! # Ok(())
//! # }
//! ```

mod entry;
mod job;
mod journal;
mod list;
mod named_outputs;
mod output_path;
mod slice;
mod summary;

pub use entry::{Entry, Failure, Outcome, Run, Status, Written, written};
pub use job::{Job, JobCommand, OUTPUTS};
pub use journal::{Entries, Journal, begun, done};
pub use list::{List, read_list};
pub use output_path::place_in;
pub use slice::Slice;
pub use summary::Summary;
