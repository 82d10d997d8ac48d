//! The threads that work for the window, and what they report.

pub(super) mod coarse;
pub(super) mod cost;
pub(super) mod dialogue;
pub(super) mod draw;
pub(super) mod exact;
pub(super) mod explain;
pub(super) mod job;
pub(super) mod line_measure;
pub(super) mod load;
pub(super) mod render_threads;
pub(super) mod report;
pub(super) mod save;
pub(super) mod viewer;
pub(super) mod watch;
