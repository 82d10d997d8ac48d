//! Widgets: they read the state and make events.

pub(super) mod keys;
pub(super) mod label;
pub(super) mod listing;
pub(super) mod panel;
pub(super) mod plot;
pub(super) mod ui;
pub(super) mod widget;
