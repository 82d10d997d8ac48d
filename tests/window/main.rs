//! The window, with and without a display. One binary, to link once.

mod goldens_window;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/program.rs"]
mod program;
#[path = "../../crates/tinta-geometry/tests/support/rendered.rs"]
mod rendered;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod window;
