//! Contact sheets: pictures side by side with titles above and lines of text with colour swatches below.
//!
//! ```
//! use tinta_lab::contact_sheet::{Caption, Panel, sheet};
//! use tinta::{Picture, Size};
//!
//! let size = Size { width: 40, height: 30 };
//! let picture = Picture { size, pixels: [255, 0, 0, 255].repeat(size.pixel_count()) };
//! let panel = |title: &str| Panel { title: title.to_owned(), subtitle: String::new(), picture: picture.clone() };
//! let whole = sheet(&[panel("left"), panel("right")], &[Caption { swatch: None, text: "two".to_owned() }]);
//! assert!(whole.size.width > 80 && whole.size.height > 30);
//! ```

use crate::canvas::{Canvas, FRAME, Face, SOFT, TEXT};
use tinta::picture::Picture;
use tinta::scene::Size;

/// A picture with its title.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Above it, bold.
    pub title: String,
    /// Below the title, plain; may be empty.
    pub subtitle: String,
    /// The picture, not scaled.
    pub picture: Picture,
}

/// A line below the panels.
#[derive(Debug, Clone)]
pub struct Caption {
    /// A square of this colour before the text.
    pub swatch: Option<[u8; 3]>,
    /// The text; letters missing in the font become a question mark.
    pub text: String,
}

/// Pixels around and between things.
const MARGIN: u32 = 16;

/// Puts panels next to each other, each as wide as its picture or its titles, and captions below.
pub fn sheet(panels: &[Panel], captions: &[Caption]) -> Picture {
    let font = Font::for_width(panels.iter().map(|panel| panel.picture.size.width).max().unwrap_or_default());
    let column = |panel: &Panel| {
        let titles = font.title.width(&panel.title).max(font.text.width(&panel.subtitle));
        (panel.picture.size.width + 2).max(titles)
    };
    let caption_width = |caption: &Caption| {
        font.text.width(&caption.text) + if caption.swatch.is_some() { font.text.height() * 3 / 2 } else { 0 }
    };
    let panels_width = panels.iter().map(|panel| column(panel) + MARGIN).sum::<u32>();
    let captions_width = captions.iter().map(caption_width).max().unwrap_or_default() + MARGIN;
    let titles_height = font.title.height() + font.text.height();
    let picture_height = panels.iter().map(|panel| panel.picture.size.height + 2).max().unwrap_or_default();
    let line_height = font.text.height() * 5 / 4;
    let captions_top = MARGIN + titles_height + MARGIN / 2 + picture_height + MARGIN;
    let size = Size {
        width: panels_width.max(captions_width) + MARGIN,
        height: captions_top + line_height * captions.len() as u32 + MARGIN,
    };
    let mut canvas = Canvas::new(size);
    let mut left = MARGIN;
    for panel in panels {
        canvas.write(left, MARGIN, &panel.title, &font.title, TEXT);
        canvas.write(left, MARGIN + font.title.height(), &panel.subtitle, &font.text, SOFT);
        let top = MARGIN + titles_height + MARGIN / 2;
        let Size { width, height } = panel.picture.size;
        canvas.fill(left, top, Size { width: width + 2, height: height + 2 }, FRAME);
        canvas.paste(left + 1, top + 1, &panel.picture);
        left += column(panel) + MARGIN;
    }
    for (line, caption) in captions.iter().enumerate() {
        let top = captions_top + line_height * line as u32;
        let mut left = MARGIN;
        if let Some([red, green, blue]) = caption.swatch {
            let side = font.text.height() * 2 / 3;
            let size = Size { width: side, height: side };
            canvas.fill(left, top + (font.text.height() - side) / 2, size, [red, green, blue, u8::MAX]);
            left += font.text.height() * 3 / 2;
        }
        canvas.write(left, top, &caption.text, &font.text, TEXT);
    }
    canvas.picture
}

/// The sizes of a sheet's text.
struct Font {
    title: Face,
    text: Face,
}

impl Font {
    /// Large pictures are viewed from further away.
    fn for_width(width_px: u32) -> Self {
        let (title, text) = match width_px {
            0..400 => (16.0, 13.0),
            400..900 => (20.0, 16.0),
            _ => (24.0, 19.0),
        };
        Self { title: Face::new(dejavu::sans::bold(), title), text: Face::new(dejavu::sans::regular(), text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::BACKGROUND;

    #[test]
    fn a_sheet_holds_its_pictures_unscaled_and_its_text_in_full() {
        let size = Size { width: 40, height: 30 };
        let color = |color: [u8; 4]| Picture { size, pixels: color.repeat(size.pixel_count()) };
        let panel = |title: &str, picture| Panel { title: title.to_owned(), subtitle: String::new(), picture };
        let long = "a title far wider than its picture, with an accent: é";
        let panels = [panel(long, color([255, 0, 0, 255])), panel("b", color([0, 0, 255, 0]))];
        let caption = Caption { swatch: Some([0, 114, 178]), text: "blue".to_owned() };
        let sheet = sheet(&panels, &[caption]);
        let count = |wanted: [u8; 4]| sheet.pixels.chunks_exact(4).filter(|pixel| **pixel == wanted).count();
        assert_eq!(count([255, 0, 0, 255]), size.pixel_count());
        assert_eq!(count([0, 0, 255, 255]), 0, "what is transparent shows the paper");
        let side = Font::for_width(size.width).text.height() as usize * 2 / 3;
        assert_eq!(count([0, 114, 178, 255]), side * side);
        let rightmost = (0..sheet.size.width)
            .rev()
            .find(|x| (0..sheet.size.height).any(|y| sheet.pixel((*x).into(), y.into()) != BACKGROUND));
        assert!(rightmost.is_some_and(|x| x + 4 < sheet.size.width), "nothing reaches the rim: {rightmost:?}");
    }
}
