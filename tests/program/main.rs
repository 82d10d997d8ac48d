//! The program as a user meets it: files, messages, exit codes, records. One binary, to link once.

mod batch;
mod batch_killed;
mod batch_places;
mod cli;
mod cli_ink;
mod cli_lines;
mod cli_mistakes;
mod cli_parts;
mod cli_stdin;
mod doors;
#[cfg(unix)]
mod external;
mod faults;
mod gltf_refused;
mod goldens_looks;
mod hatching;
mod hostile;
mod one_drawing;
mod output;
mod output_killed;
mod page_file;
mod presets;
#[path = "../support/program.rs"]
mod program;
mod recipes;
mod remarks;
#[path = "../../crates/tinta-geometry/tests/support/rendered.rs"]
mod rendered;
mod standard_output;
mod styles;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod turntable;
mod vectors;
