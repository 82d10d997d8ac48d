//! Writes drawings as SVG, PDF, DXF, pixels and polylines.

pub(super) mod dxf;
#[cfg(feature = "pdf")]
pub(super) mod pdf;
#[cfg(feature = "pdf")]
mod pdf_font;
pub(super) mod raster;
pub(super) mod strokes;
pub(super) mod svg;
