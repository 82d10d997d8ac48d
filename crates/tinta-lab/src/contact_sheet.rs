//! Contact sheets: pictures side by side with titles above and lines of text with colour swatches below. The one file that
//! sets text into pictures: DejaVu Sans, which is in the program, with antialiased outlines.
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

use ab_glyph::{Font as _, FontRef, PxScale, ScaleFont, point};
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

const BACKGROUND: [u8; 4] = [255; 4];
const FRAME: [u8; 4] = [200, 200, 200, 255];
const TEXT: [u8; 3] = [28, 28, 30];
/// The colour of the text below a title.
const SOFT: [u8; 3] = [92, 92, 99];

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
    let mut canvas = Canvas { picture: Picture { size, pixels: BACKGROUND.repeat(size.pixel_count()) } };
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

/// One size of a font.
struct Face {
    /// `None` were the font broken; then texts are left out.
    font: Option<FontRef<'static>>,
    scale: PxScale,
}

impl Face {
    /// The font in this size, pixels of its em.
    fn new(file: &'static [u8], em_px: f32) -> Self {
        let font = FontRef::try_from_slice(file).ok();
        // ab_glyph's scale is that of a line's height.
        let lines_a_em = font.as_ref().and_then(|font| Some(font.height_unscaled() / font.units_per_em()?));
        Self { font, scale: PxScale::from(em_px * lines_a_em.unwrap_or(1.0)) }
    }

    /// Height of a line, pixels.
    fn height(&self) -> u32 {
        self.scale.y.ceil() as u32
    }

    fn width(&self, text: &str) -> u32 {
        self.places(text).1.ceil() as u32
    }

    /// The glyphs of a text, each with its distance from the left, and the width of all.
    fn places(&self, text: &str) -> (Vec<(ab_glyph::GlyphId, f32)>, f32) {
        let Some(font) = &self.font else { return (Vec::new(), 0.0) };
        let font = font.as_scaled(self.scale);
        let (mut left, mut places): (f32, Vec<(ab_glyph::GlyphId, f32)>) = (0.0, Vec::new());
        for character in text.chars() {
            let known = font.glyph_id(character);
            let glyph = if known.0 == 0 { font.glyph_id('?') } else { known };
            left += places.last().map_or(0.0, |(before, _)| font.kern(*before, glyph));
            places.push((glyph, left));
            left += font.h_advance(glyph);
        }
        (places, left)
    }
}

struct Canvas {
    picture: Picture,
}

impl Canvas {
    fn set(&mut self, x: u32, y: u32, pixel: [u8; 4]) {
        let Size { width, height } = self.picture.size;
        if x < width && y < height {
            let start = (y as usize * width as usize + x as usize) * 4;
            self.picture.pixels[start..start + 4].copy_from_slice(&pixel);
        }
    }

    fn fill(&mut self, left: u32, top: u32, size: Size, pixel: [u8; 4]) {
        for y in top..top + size.height {
            (left..left + size.width).for_each(|x| self.set(x, y, pixel));
        }
    }

    /// A transparent picture shows the sheet's background.
    fn paste(&mut self, left: u32, top: u32, picture: &Picture) {
        for y in 0..picture.size.height {
            for x in 0..picture.size.width {
                let [red, green, blue, alpha] = picture.pixel(x.into(), y.into());
                let over = |channel: u8| (255 - (255 - u32::from(channel)) * u32::from(alpha) / 255) as u8;
                self.set(left + x, top + y, [over(red), over(green), over(blue), u8::MAX]);
            }
        }
    }

    /// Lays ink of this share over a pixel.
    fn ink(&mut self, x: u32, y: u32, [red, green, blue]: [u8; 3], share: f32) {
        let behind = self.picture.pixel(x.into(), y.into());
        let mixed = |ink: u8, channel: usize| {
            (f32::from(ink) * share + f32::from(behind[channel]) * (1.0 - share)).round() as u8
        };
        self.set(x, y, [mixed(red, 0), mixed(green, 1), mixed(blue, 2), u8::MAX]);
    }

    fn write(&mut self, left: u32, top: u32, text: &str, face: &Face, ink: [u8; 3]) {
        let Some(font) = &face.font else { return };
        let baseline = top as f32 + font.as_scaled(face.scale).ascent().round();
        for (glyph, place) in face.places(text).0 {
            let at = glyph.with_scale_and_position(face.scale, point(left as f32 + place, baseline));
            let Some(outline) = font.outline_glyph(at) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, share| {
                let [x, y] = [corner.x + x as f32, corner.y + y as f32];
                if x >= 0.0 && y >= 0.0 {
                    self.ink(x as u32, y as u32, ink, share.min(1.0));
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn a_text_is_as_wide_as_its_letters_and_every_letter_is_in_the_font_or_a_question_mark() {
        let face = Face::new(dejavu::sans::regular(), 16.0);
        assert!(face.font.is_some());
        assert_eq!(face.width(""), 0);
        let [one, two] = ["n", "nn"].map(|text| face.places(text).1);
        assert!((two - 2.0 * one).abs() < 1e-3, "{one} {two}");
        assert!(face.places("AV").1 < face.places("A").1 + face.places("V").1, "what leans together is closer");
        assert_eq!(face.places("\u{10ffff}"), face.places("?"));
        // An em of 16 pixels: DejaVu's x is 1120 of 2048 units high.
        let size = Size { width: 40, height: 40 };
        let mut canvas = Canvas { picture: Picture { size, pixels: BACKGROUND.repeat(size.pixel_count()) } };
        canvas.write(4, 4, "x", &face, [0; 3]);
        let has_ink = |y: u32| (0..40).any(|x| canvas.picture.pixel(x, y.into())[0] < 128);
        let rows: Vec<u32> = (0..40).filter(|y| has_ink(*y)).collect();
        assert!(rows.len() == 9 || rows.len() == 8, "8.75 pixels: {rows:?}");
    }
}
