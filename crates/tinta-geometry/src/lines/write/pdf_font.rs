//! The font of a PDF's labels: the letters of DejaVu Sans that they use, embedded.
//!
//! Input: texts. Output: their glyphs as numbers of two bytes, their widths, and the font's objects: a CID font with the
//! encoding Identity-H (ISO 32000-1, 9.7), and a map from glyphs to letters. Readers search and copy texts by it.

use crate::error::{Error, Result};
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, Str};
use std::fmt::Display;
use subsetter::{GlyphRemapper, subset};
use ttf_parser::Face;

/// The objects that a font takes.
pub(super) const OBJECTS: usize = 5;

const SYSTEM: SystemInfo<'_> = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The width of its upright strokes, thousandths of an em.
const STEM: f32 = 90.0;

/// A font of the letters given so far.
pub(super) struct LabelFont {
    face: Face<'static>,
    glyphs: GlyphRemapper,
    /// The letter of each glyph but number 0, and its width in thousandths of an em.
    letters: Vec<(char, f32)>,
}

impl LabelFont {
    /// A font without letters.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a broken font, a mistake of ours.
    pub(super) fn new() -> Result<Self> {
        let face = Face::parse(dejavu::sans::regular(), 0).map_err(broken)?;
        Ok(Self { face, glyphs: GlyphRemapper::new(), letters: Vec::new() })
    }

    /// Returns a text's glyphs and its width in ems, and adds its letters.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for letters that the font lacks, or that would have to be joined and written from the right.
    pub(super) fn encoded(&mut self, text: &str) -> Result<(Vec<u8>, f64)> {
        let (mut bytes, mut thousandths) = (Vec::new(), 0.0);
        for letter in text.chars() {
            let letter = if matches!(letter, '\t' | '\n' | '\r') { ' ' } else { letter };
            let is_from_right =
                matches!(letter, '\u{590}'..='\u{8ff}' | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{feff}');
            let Some(glyph) = self.face.glyph_index(letter).filter(|_| !is_from_right && !letter.is_control()) else {
                let shown: String = text.chars().take(40).collect();
                let problem = format!("a PDF's font has no letter {letter:?}; write it as .svg");
                return Err(Error::value("labels", shown, problem));
            };
            let number = self.glyphs.remap(glyph.0);
            if usize::from(number) > self.letters.len() {
                let width = self.face.glyph_hor_advance(glyph).unwrap_or_default();
                self.letters.push((letter, self.thousandths(width.into())));
            }
            bytes.extend(number.to_be_bytes());
            thousandths += f64::from(self.letters[usize::from(number) - 1].1);
        }
        Ok((bytes, thousandths / 1000.0))
    }

    /// A length of the font's units in thousandths of an em.
    fn thousandths(&self, units: f32) -> f32 {
        units * 1000.0 / f32::from(self.face.units_per_em())
    }

    /// Writes the objects; the first is the font that a page names.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`].
    pub(super) fn write(
        &self,
        [font, of_glyphs, description, file, letters]: [Ref; OBJECTS],
        pdf: &mut Pdf,
    ) -> Result<()> {
        let name = self.name();
        let name = Name(name.as_bytes());
        let mut written = pdf.type0_font(font);
        written.base_font(name).encoding_predefined(Name(b"Identity-H")).descendant_font(of_glyphs).to_unicode(letters);
        written.finish();

        let mut written = pdf.cid_font(of_glyphs);
        written.subtype(CidFontType::Type2).base_font(name).system_info(SYSTEM).font_descriptor(description);
        written.cid_to_gid_map_predefined(Name(b"Identity"));
        written.widths().consecutive(1, self.letters.iter().map(|(_, width)| *width));
        written.finish();

        let of = |units: i16| self.thousandths(units.into());
        let face = &self.face;
        let bounds = face.global_bounding_box();
        let mut written = pdf.font_descriptor(description);
        written.name(name).flags(FontFlags::SYMBOLIC).italic_angle(0.0).stem_v(STEM).font_file2(file);
        written.bbox(Rect::new(of(bounds.x_min), of(bounds.y_min), of(bounds.x_max), of(bounds.y_max)));
        written.ascent(of(face.ascender())).descent(of(face.descender()));
        written.cap_height(of(face.capital_height().unwrap_or_else(|| face.ascender())));
        written.finish();

        let data = subset(dejavu::sans::regular(), 0, &self.glyphs).map_err(broken)?;
        pdf.stream(file, &data).pair(Name(b"Length1"), data.len() as i32);
        let mut map = UnicodeCmap::new(Name(b"Letters"), SYSTEM);
        (1_u16..).zip(&self.letters).for_each(|(number, (letter, _))| map.pair(number, *letter));
        pdf.cmap(letters, &map.finish());
        Ok(())
    }

    /// Subsets bear six capitals before their names, of other letters other ones (ISO 32000-1, 9.6.4).
    fn name(&self) -> String {
        // FNV-1a.
        let step = |hash: u64, (letter, _): &(char, f32)| (hash ^ u64::from(*letter)).wrapping_mul(0x0100_0000_01b3);
        let mut hash = self.letters.iter().fold(0xcbf2_9ce4_8422_2325, step);
        let mut capital = || {
            hash /= 26;
            char::from(b'A' + (hash % 26) as u8)
        };
        (0..6).map(|_| capital()).chain("+DejaVuSans".chars()).collect()
    }
}

fn broken(problem: impl Display) -> Error {
    Error::setting("labels", format!("the font of PDF files: {problem}; report this, and write them as .svg"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::labels::Label;
    use crate::lines::{DrawingSettings, VisibleLines, pdf};
    use crate::scene::Size;
    use glam::DVec2;

    /// A drawing of these labels alone.
    fn drawn(texts: &[&str]) -> Vec<u8> {
        let label =
            |text: &&str| Label { text: (*text).to_owned(), px: DVec2::new(10.0, 20.0), is_visible: true, object: 0 };
        let labels = texts.iter().map(label).collect();
        pdf(&VisibleLines { labels, ..VisibleLines::none(Size { width: 99, height: 50 }) }, &DrawingSettings::default())
            .unwrap()
    }

    /// The text of the file, and the bytes of its font.
    fn read(pdf: &[u8]) -> (String, Vec<u8>) {
        let text: String = pdf.iter().map(|byte| char::from(*byte)).collect();
        let start = text.find("/Length1").unwrap();
        let length = text[start..].split_whitespace().nth(1).unwrap().parse().unwrap();
        let start = start + text[start..].find("stream\n").unwrap() + 7;
        let font = text.chars().skip(text[..start].chars().count()).take(length).map(|byte| byte as u8).collect();
        (text, font)
    }

    #[test]
    fn greek_arrows_and_accents_are_embedded_with_the_outlines_and_widths_of_the_font() {
        let label = "α → é σ / MPa";
        let (text, file) = read(&drawn(&[label]));
        assert!(text.contains("+DejaVuSans") && text.contains("/FontFile2") && text.contains("/Identity-H"));
        let (all, few) = (Face::parse(dejavu::sans::regular(), 0).unwrap(), Face::parse(&file, 0).unwrap());
        assert!(file.len() < 20_000, "{} bytes", file.len());
        let mut letters: Vec<char> = Vec::new();
        label.chars().for_each(|letter| {
            if !letters.contains(&letter) {
                letters.push(letter)
            }
        });
        assert_eq!(usize::from(few.number_of_glyphs()), 1 + letters.len() + 2, "and the parts of é");
        for (number, letter) in (1..).zip(letters) {
            let [glyph, embedded] = [all.glyph_index(letter).unwrap(), ttf_parser::GlyphId(number)];
            assert_eq!(few.glyph_bounding_box(embedded), all.glyph_bounding_box(glyph), "{letter}");
            assert_eq!(few.glyph_hor_advance(embedded), all.glyph_hor_advance(glyph), "{letter}");
            let pair = format!("<{number:04X}> <{:04X}>", u32::from(letter));
            assert!(text.contains(&pair), "{pair} lets {letter} be copied");
        }
    }

    #[test]
    fn a_text_is_as_wide_as_its_letters_in_dejavu() {
        let mut font = LabelFont::new().unwrap();
        // Units of 2,048 an em: H 1540, e 1260, i 569, g 1300, h 1298, t 803.
        let (glyphs, ems) = font.encoded("Height").unwrap();
        assert_eq!(glyphs, [0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6]);
        assert!((ems - 6770.0 / 2048.0).abs() < 1e-6, "{ems}");
        assert_eq!(font.encoded("he\tH").unwrap().0, [0, 5, 0, 2, 0, 7, 0, 1]);
        assert_eq!(font.encoded("").unwrap(), (Vec::new(), 0.0));
    }

    #[test]
    fn a_letter_that_the_font_lacks_is_named_with_the_remedy() {
        for (text, letter) in
            [("Höhe 山", "'山'"), ("\u{1}", r"'\u{1}'"), ("\u{81}", r"'\u{81}'"), ("a\0", r"'\0'"), ("שלום", "'ש'")]
        {
            let said = LabelFont::new().unwrap().encoded(text).unwrap_err().to_string();
            assert!(said.contains(letter) && said.contains("write it as .svg"), "{said}");
        }
    }

    #[test]
    fn subsets_of_other_letters_have_other_names_and_a_drawing_without_labels_no_font() {
        let name = |texts: &[&str]| {
            let (text, _) = read(&drawn(texts));
            let end = text.find("+DejaVuSans").unwrap();
            text[end - 6..end].to_owned()
        };
        let [one, same, other] = [&["a", "b"][..], &["ab"], &["abc"]].map(name);
        assert!(one == same && one != other && one.bytes().all(|byte| byte.is_ascii_uppercase()), "{one} {other}");
        assert!(!drawn(&[]).windows(5).any(|bytes| bytes == b"/Font"));
    }
}
