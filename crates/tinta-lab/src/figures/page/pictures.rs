//! Pictures on the page: each embedded, with its label and, for filters, its matrices.

use super::diagrams;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;
use std::fmt::Write;
use tinta::picture::Picture;
use tinta::scene::Size;
use tinta::styles::{Show, Style};
use tinta_geometry::markup::escaped;

/// A file of a figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PictureRecord {
    /// Its file name, beside the page.
    pub file: String,
    /// Its label among its neighbours.
    pub label: String,
    /// Pixels.
    pub size: Size,
    /// The command that draws it alone.
    pub command: Option<String>,
    /// The style and its settings, for drawn models.
    pub style: Option<Style>,
    /// The style's picture.
    pub show: Option<Show>,
    /// The page's source: [`png_source`] or [`svg_source`].
    #[serde(skip)]
    pub source: String,
}

/// The largest size of a picture of the page, bytes, unless it is all grain: more than fifty of them stay below six million in
/// base 64.
const MOST_BYTES: usize = 80_000;

/// A picture as an address that holds it.
pub fn png_source(picture: &Picture) -> String {
    let bytes = picture.small_png(MOST_BYTES).unwrap_or_default();
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(bytes))
}

/// A plot as an address that holds it.
pub fn svg_source(text: &str) -> String {
    format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(text))
}

/// Figures shown with their filters' matrices.
const WITH_MATRICES: [&str; 2] = ["evangelista-10", "evangelista-11"];

/// Pictures side by side.
pub(super) fn pictures<'p>(
    out: &mut String,
    records: impl ExactSizeIterator<Item = &'p PictureRecord>,
    title: &str,
) -> std::fmt::Result {
    if records.len() == 0 {
        return Ok(());
    }
    let class = if records.len() > 2 { "row many" } else { "row" };
    writeln!(out, "<div class=\"{class}\">")?;
    for picture in records {
        let (file, label, Size { width, height }) = (escaped(&picture.file), escaped(&picture.label), picture.size);
        let alt = format!("{}: {label}", escaped(title));
        writeln!(
            out,
            "<figure><img src=\"{}\" data-file=\"{file}\" width=\"{width}\" height=\"{height}\" alt=\"{alt}\" />\
             <figcaption>{label}</figcaption>",
            picture.source
        )?;
        if WITH_MATRICES.iter().any(|id| picture.file.starts_with(id)) {
            diagrams::matrices(out, picture.style.as_ref())?;
        }
        writeln!(out, "</figure>")?;
    }
    writeln!(out, "</div>")
}
