//! The format of a drawing of lines, and the parts to find for it.

use super::Request;
use super::layers::{OF_PAPER, pixels_on_paper};
use crate::animation::AnimationTarget;
use crate::error::{Error, Result};
use crate::lines::{DrawingContent, DrawingFormat, DrawingSettings};
use crate::picture::PictureFormat;
use crate::settings::HasSettings;
use crate::styles::is_of_lines_alone;
use std::path::Path;

/// The parts to find for a drawing besides those it shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WantedLines {
    /// Every piece of line: hidden ones, short ones, those of the outline marked.
    pub all: bool,
    /// Hidden lines, and the number of places where smooth silhouettes break.
    pub hidden: bool,
    /// Short lines, unless a least length is given.
    pub short: bool,
}

impl WantedLines {
    /// The parts found for a file of this format; `is_told`: its numbers are reported.
    pub fn of(format: DrawingFormat, is_told: bool) -> Self {
        let all = matches!(format.content, DrawingContent::Data);
        Self { all, hidden: is_told, short: format.is_of_lines_alone }
    }
}

impl Request {
    /// The format of a file of this name where lines are drawn, `None` for a picture.
    ///
    /// # Errors
    ///
    /// Where style and file's name do not go together, or the format has no place for an option.
    pub fn drawing_format(&self, output: &str) -> Result<Option<DrawingFormat>> {
        let style = self.style.name();
        let refuse = |problem: String| Err(Error::output(output, problem));
        let format = match (self.style.style_name().draws_lines(), DrawingFormat::of_name(output)) {
            (true, None) if output == "-" => DrawingFormat::SVG,
            (true, None) if PictureFormat::of(Path::new(output)).is_some() => DrawingFormat::PIXELS,
            (true, None) => {
                return refuse(format!(
                    "style {style} writes {} or a still picture such as .png; name the file so, or leave out --style {style}",
                    endings_of_lines()
                ));
            }
            (_, Some(format)) if self.style.vectors(self.scene.size).is_some() => format,
            (_, Some(_)) => {
                return refuse(format!(
                    "{} draws pixels; --look print in its place draws areas and lines, --look technical lines, or name a \
                     picture such as drawing.png",
                    self.style_said()
                ));
            }
            (false, None) => {
                check_picture_name(output)?;
                return self.refuse_vectors_options().map(|()| None);
            }
        };
        self.refuse_what_lacks(format).map(|()| Some(format))
    }

    /// Refuses the options that a format has no place for. What a look says of them is left out.
    fn refuse_what_lacks(&self, format: DrawingFormat) -> Result<()> {
        let is_of_looks =
            |option: &str| option != "min-length" && is_of_lines_alone(option) && DrawingSettings::table().has(option);
        for option in self.options.keys().filter(|option| !self.is_of_look(option)) {
            let problem = match (format.lacks(option), format.content) {
                (Some(problem), _) => problem,
                (None, DrawingContent::Pixels) if OF_PAPER.contains(&option.as_str()) => pixels_on_paper(&self.options),
                (None, DrawingContent::Data) if is_of_looks(option) => {
                    let file = format.ending;
                    format!("a .{file} file holds all lines but no appearance; leave it out, or write a .svg")
                }
                _ => continue,
            };
            return Err(Error::setting(option.clone(), problem));
        }
        Ok(())
    }
}

/// The endings of files of lines, for messages.
pub(crate) fn endings_of_lines() -> String {
    DrawingFormat::ALL.iter().map(|format| format!(".{}", format.ending)).collect::<Vec<_>>().join(", ")
}

/// Whether a file of this name holds lines or a picture.
#[cfg(feature = "cli")]
pub(crate) fn is_drawn_into(name: &str) -> bool {
    DrawingFormat::of_name(name).is_some() || PictureFormat::of(Path::new(name)).is_some()
}

/// Refuses a picture's name whose ending nothing is written with. Other names that are no picture's are refused later.
fn check_picture_name(output: &str) -> Result<()> {
    let path = Path::new(output);
    let is_picture = PictureFormat::of(path).is_some() || AnimationTarget::is_meant_by(output);
    // As `.png`.
    let is_ending_alone = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    let problem = match path.extension().and_then(|extension| extension.to_str()) {
        _ if is_picture || output == "-" || path.is_dir() => return Ok(()),
        Some(extension) => format!("tinta writes no .{extension}"),
        None if output.ends_with('/') || is_ending_alone => return Ok(()),
        None => "the name has no extension".to_owned(),
    };
    let (pictures, lines) = (".png, .jpg, .bmp, .tga or .ppm for a picture", endings_of_lines());
    let problem = format!("{problem}; use {pictures}, {lines} for lines, .gif or .apng for an animation");
    Err(Error::output(output, problem))
}
