//! Drawings as files and values: SVG, PDF, pixels, polylines.

#[cfg(feature = "pdf")]
pub(super) mod pdf;
pub(super) mod raster;
pub(super) mod strokes;
pub(super) mod svg;
