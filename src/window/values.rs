//! Plain values: what the window shows, what happens, how it changes.

pub(super) mod buffer;
pub(super) mod compose;
pub(super) mod controls;
pub(super) mod event;
pub(super) mod line_style;
pub(super) mod shown;
pub(super) mod state;
