//! Measures, reports, figures and stress. One binary, to link once.

mod charcoal_twin;
mod cli_measure;
mod figures;
mod ink_specks;
mod inking;
mod judge;
mod lines_inking;
mod measure;
mod measure_smooth;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/program.rs"]
mod program;
#[path = "../../crates/tinta-geometry/tests/support/rendered.rs"]
mod rendered;
mod report;
mod report_page;
mod stress;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod twin;
mod why;
