//! Batches: the jobs of a list, and a journal of their results.
//!
//! The input is a list of jobs, one line of JSON each ([`List`]). A run, or one of N [`Slice`]s of it, does the unfinished jobs,
//! on any machine. A finished picture has a recipe with its models and options. An [`Entry`] of the run's own [`Journal`] records
//! everything else: failures, remarks, printed text, files without a recipe. This module draws nothing; `src/cli/batch.rs` carries
//! the jobs out. For use, see docs/guide/batches.md.
//!
//! ```
//! use tinta::batch::{List, Slice};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let list = List::of_bytes(br#"{"model": "builtin:ant", "output": "ant.png"}"#.to_vec(), "jobs.jsonl")?;
//! let names: Vec<String> = list.jobs(Slice::WHOLE).map(|job| job.id).collect();
//! assert_eq!(names, ["ant.png"]);
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

pub use entry::{Entry, Failure, Outcome};
pub(crate) use job::OUTPUTS;
pub use job::{Job, JobCommand};
pub(crate) use journal::entries;
pub use journal::{Journal, add_entries};
pub use list::List;
pub(crate) use list::read_list;
pub(crate) use named_outputs::are_there;
pub use output_path::place_in;
pub use slice::Slice;
