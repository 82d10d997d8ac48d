//! The format of a drawing of lines, and the parts to find for it.

use super::Request;
use crate::error::{Error, Result};
use crate::picture::PictureFormat;
use std::path::Path;

/// The files lines are written to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingFormat {
    /// Paths and areas.
    Svg,
    /// The same on paper.
    Pdf,
    /// Polylines.
    Dxf,
    /// Every piece of line with its data.
    Json,
    /// Pixels, in the format of the file's name.
    Picture,
}

/// The parts to find for a drawing besides those it shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Every piece of line: hidden ones, short ones, those of the outline marked.
    pub all: bool,
    /// Hidden lines, and the number of places where smooth silhouettes break.
    pub hidden: bool,
}

fn extension(output: &str) -> Option<&str> {
    Path::new(output).extension().and_then(|extension| extension.to_str())
}

impl DrawingFormat {
    /// The parts found for a file of this format; `is_told`: its numbers are reported.
    pub fn wanted(self, is_told: bool) -> Wanted {
        Wanted { all: self == Self::Json, hidden: is_told }
    }

    /// Whether files of this format hold lines and no tones, unless a style with tones is asked for.
    #[cfg(feature = "cli")]
    pub(crate) fn is_of_lines_alone(self) -> bool {
        matches!(self, Self::Dxf | Self::Json)
    }

    /// The format of a file of this name, if it holds lines.
    pub fn of_name(output: &str) -> Option<Self> {
        match extension(output).map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => Some(Self::Svg),
            Some("pdf") => Some(Self::Pdf),
            Some("dxf") => Some(Self::Dxf),
            Some("json") => Some(Self::Json),
            _ => None,
        }
    }

    /// The format where lines are drawn, `None` for a picture.
    ///
    /// # Errors
    ///
    /// Where style and file's name do not go together.
    pub fn of(request: &Request, output: &str) -> Result<Option<Self>> {
        let style = request.style.name();
        let draws_lines = request.style.style_name().draws_lines();
        let refuse = |problem: String| Err(Error::output(output, problem));
        match (draws_lines, Self::of_name(output)) {
            (true, None) if output == "-" => Ok(Some(Self::Svg)),
            (true, None) if PictureFormat::of(Path::new(output)).is_some() => Ok(Some(Self::Picture)),
            (true, None) => refuse(format!(
                "style {style} writes .svg, .pdf, .dxf, .json or a still picture such as .png; name the file so, or leave out --style {style}"
            )),
            (_, Some(format)) if request.style.vectors(request.scene.size).is_some() => Ok(Some(format)),
            (_, Some(_)) => refuse(format!(
                "{} draws pixels; --look print in its place draws areas and lines, --look technical lines, or name a picture \
                 such as drawing.png",
                request.style_said()
            )),
            // A name that is no picture either is refused later, with the full list of formats.
            (false, None) if output == "-" || Path::new(output).is_dir() => {
                request.refuse_vectors_options().map(|()| None)
            }
            (false, None) => match extension(output) {
                Some(extension) if !is_of_a_picture(extension) => {
                    refuse(format!("tinta writes no .{extension}; {EXTENSIONS}"))
                }
                None if !output.ends_with('/') && !has_extension_alone(output) => {
                    refuse(format!("the name has no extension; {EXTENSIONS}"))
                }
                _ => request.refuse_vectors_options().map(|()| None),
            },
        }
    }
}

/// The use of each format.
const EXTENSIONS: &str = "use .png, .jpg, .bmp, .tga or .ppm for a picture, .svg, .pdf, .dxf or .json for lines, .gif or .apng for an \
                          animation";

/// Whether the file's name is an extension without a name, as `.png`.
fn has_extension_alone(output: &str) -> bool {
    Path::new(output).file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
}

fn is_of_a_picture(extension: &str) -> bool {
    let extension = extension.to_ascii_lowercase();
    ["png", "jpg", "jpeg", "bmp", "tga", "ppm", "gif", "apng"].contains(&extension.as_str())
}
