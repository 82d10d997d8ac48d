//! Writes drawings as SVG, PDF, pixels and polylines.

#[cfg(feature = "pdf")]
pub(super) mod pdf;
pub(super) mod raster;
pub(super) mod strokes;
pub(super) mod svg;
