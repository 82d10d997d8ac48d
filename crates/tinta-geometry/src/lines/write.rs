//! Writes drawings as SVG, PDF, DXF, pixels and polylines. The formats of files have a row each, which help and messages list.

pub(super) mod dxf;
#[cfg(feature = "pdf")]
pub(super) mod pdf;
#[cfg(feature = "pdf")]
mod pdf_font;
mod part_groups;
pub(super) mod raster;
pub(super) mod strokes;
pub(super) mod svg;

use super::drawing::areas::Areas;
use super::drawing::chain::LinePath;
use super::drawing::settings::DrawingSettings;
use super::visible_lines::VisibleLines;
use crate::error::Result;
use std::path::Path;

/// Writes paths above areas; lines alone have no areas.
type Write = fn(&VisibleLines, Vec<LinePath>, Option<&Areas>, &DrawingSettings) -> Result<Vec<u8>>;

/// A format of drawings: a row of [`DrawingFormat::ALL`], or pixels.
#[derive(Debug, Clone, Copy)]
pub struct DrawingFormat {
    /// The ending of its files' names, in small letters and without a dot; empty for pixels.
    pub ending: &'static str,
    /// Whether its files hold lines and no tones, unless a style with tones is asked for. They carry no recipe and show no turn.
    pub is_of_lines_alone: bool,
    /// The options that it has no place for, with blanks between them, and why: the words after "a .pdf file".
    lacks: &'static [(&'static str, &'static str)],
    /// What its files hold.
    pub content: DrawingContent,
}

/// What the files of a format hold.
#[derive(Debug, Clone, Copy)]
pub enum DrawingContent {
    /// What this function writes.
    Vectors(Write),
    /// Every piece of line with its data, hidden ones too, without appearance.
    Data,
    /// Pixels, in the format of the file's name.
    Pixels,
}

impl DrawingFormat {
    /// SVG.
    pub const SVG: Self = {
        let write: Write = |lines, paths, areas, settings| Ok(svg::svg_of_paths(lines, paths, areas, settings)?.into());
        Self { ending: "svg", is_of_lines_alone: false, lacks: &[], content: DrawingContent::Vectors(write) }
    };

    /// JSON.
    const JSON: Self = {
        let lacks = &[("sheet", "holds one view")];
        Self { ending: "json", is_of_lines_alone: true, lacks, content: DrawingContent::Data }
    };

    /// A picture's pixels.
    pub const PIXELS: Self = {
        const PATHS: (&str, &str) = ("pen fit-curves", "has pixels and no paths");
        let lacks = &[PATHS, ("areas", "of exact lines has no areas")];
        Self { ending: "", is_of_lines_alone: false, lacks, content: DrawingContent::Pixels }
    };

    /// The formats that a file's ending names.
    pub const ALL: &'static [Self] = &[
        Self::SVG,
        #[cfg(feature = "pdf")]
        Self { ending: "pdf", content: DrawingContent::Vectors(pdf::pdf_of_paths), ..Self::SVG },
        Self {
            ending: "dxf",
            is_of_lines_alone: true,
            lacks: &[("fit-curves areas", "holds polylines without curves, fills and their edges")],
            content: DrawingContent::Vectors(|lines, paths, areas, settings| {
                Ok(dxf::dxf_of_paths(lines, paths, areas, settings)?.into())
            }),
        },
        Self::JSON,
    ];

    /// Returns the format of a file of this name, if it holds lines.
    pub fn of_name(name: &str) -> Option<Self> {
        let ending = Path::new(name).extension()?;
        Self::ALL.iter().find(|format| ending.eq_ignore_ascii_case(format.ending)).copied()
    }

    /// Returns why it has no place for an option.
    pub fn lacks(self, option: &str) -> Option<String> {
        let is_named = |options: &str| options.split(' ').any(|named| named == option);
        let (_, why) = self.lacks.iter().find(|(options, _)| is_named(options))?;
        let file = if self.ending.is_empty() { "picture".to_owned() } else { format!(".{} file", self.ending) };
        Some(format!("a {file} {why}; leave it out, or write a .svg"))
    }
}
