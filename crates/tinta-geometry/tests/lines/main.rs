//! Which lines are visible. One binary, to link once.

extern crate tinta_geometry as tinta;

mod centre_lines;
mod corners;
mod degenerate;
mod flicker;
mod free_lines;
mod growth;
mod hidden;
mod hidden_rays;
mod invariance;
mod known_shapes;
mod lasting;
mod outline;
mod rays;
mod reference;
mod reports;
mod rewritings;
mod rules;
mod same;
mod smooth_waves;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
