//! The format of an output by its name: lines or pixels.

use std::path::Path;
use tinta::picture::PictureFormat;
use tinta::request::Request;
use tinta::{Error, Result};

/// The files lines are written to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Pdf,
    Dxf,
    Json,
    /// Pixels, in the format of the file's name.
    Picture,
}

/// Whether a file of this name holds lines.
pub(in crate::cli) fn is_of_lines(output: &str) -> bool {
    Format::of_name(output).is_some()
}

fn extension(output: &str) -> Option<&str> {
    Path::new(output).extension().and_then(|extension| extension.to_str())
}

impl Format {
    /// The format of a file of this name, if it holds lines.
    fn of_name(output: &str) -> Option<Self> {
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
    pub(super) fn of(request: &Request, output: &str) -> Result<Option<Self>> {
        let style = request.style.name();
        let has_vectors = request.style.vectors(request.scene.size).is_some();
        let refuse = |problem: String| Err(Error::output(output, problem));
        match (request.style.lines().is_some(), Self::of_name(output)) {
            (true, Some(format)) => Ok(Some(format)),
            (true, None) if output == "-" => Ok(Some(Self::Svg)),
            (true, None) if PictureFormat::of(Path::new(output)).is_some() => Ok(Some(Self::Picture)),
            (true, None) => refuse(format!(
                "style {style} writes .svg, .pdf, .dxf, .json or a still picture such as .png; name the file so, or leave out --style {style}"
            )),
            (false, Some(format)) if has_vectors => Ok(Some(format)),
            (false, Some(_)) => refuse(format!(
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

/// What the formats are for.
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
