//! Turns visible lines into a drawing: layers, paths, their order and shape, paper.

pub(super) mod areas;
pub(super) mod chain;
pub(super) mod coincident;
pub(super) mod curves;
pub(super) mod drawn_labels;
pub(super) mod drawn_layers;
pub(super) mod fills;
mod form_planes;
mod form_strokes;
pub(super) mod hatch;
pub(super) mod hatches;
pub(super) mod key;
pub(super) mod layers;
pub(super) mod length;
pub(super) mod outline_runs;
pub(super) mod page;
pub(super) mod scale;
pub(super) mod painted;
pub(super) mod pen;
pub(super) mod settings;
pub(super) mod simplify;
pub(super) mod specks;
pub(super) mod taper;
pub(super) mod text;
