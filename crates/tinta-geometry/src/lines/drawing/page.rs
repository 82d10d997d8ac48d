//! The size of a drawing on paper, and the part of the picture's plane that the paper shows.
//!
//! Input: a [`PageSize`] and the extent of the drawing's lines and areas. Output: a [`Page`]. Lines keep the picture's pixel
//! coordinates; the page holds the rectangle of pixels that it shows and its size on paper. A drawing thus has the
//! same numbers on any paper.

use crate::error::{Error, ParseError, Result};
use crate::lines::LineSegment;
use crate::lines::drawing::length::{Millimetres, Units};
use crate::scene::Size;
use crate::settings::{Kind, Problem, Value};
use glam::DVec2;
use std::fmt;
use std::str::FromStr;

/// The size of a drawing on paper.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum PageSize {
    /// Pixels of unknown size.
    #[default]
    Unset,
    /// Width of the picture, millimetres.
    WidthMm(f64),
    /// Pixels of the picture per inch.
    Dpi(f64),
    /// The drawing fills this sheet inside its margins.
    Paper(Paper),
}

/// A sheet of paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Its size.
    pub sheet: Sheet,
    /// Its orientation; ignored if the sides are given in millimetres.
    pub turn: Turn,
}

/// The size of a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sheet {
    /// 297 x 420 mm.
    A3,
    /// 210 x 297 mm.
    A4,
    /// 148 x 210 mm.
    A5,
    /// 8.5 x 11 inches.
    Letter,
    /// Width and height in millimetres.
    Mm([f64; 2]),
}

/// The orientation of a sheet.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Turn {
    /// That of the drawing.
    #[default]
    ByDrawing,
    /// Upright.
    Portrait,
    /// With the longer side horizontal.
    Landscape,
}

const SHEETS: [(&str, Sheet); 4] = [("A3", Sheet::A3), ("A4", Sheet::A4), ("A5", Sheet::A5), ("letter", Sheet::Letter)];

const TURNS: [(&str, Turn); 3] =
    [("", Turn::ByDrawing), ("-portrait", Turn::Portrait), ("-landscape", Turn::Landscape)];

impl Sheet {
    /// Width and height in millimetres; a named sheet is upright.
    fn sides_mm(self) -> [f64; 2] {
        match self {
            Self::A3 => [297.0, 420.0],
            Self::A4 => [210.0, 297.0],
            Self::A5 => [148.0, 210.0],
            Self::Letter => [8.5, 11.0].map(|inches| inches * MM_PER_INCH),
            Self::Mm(sides) => sides,
        }
    }
}

impl Paper {
    /// Width and height in millimetres, for a drawing of this shape.
    pub(in crate::lines) fn sides_mm(self, drawing: DVec2) -> [f64; 2] {
        let [width, height] = self.sheet.sides_mm();
        let lies = match (self.sheet, self.turn) {
            (Sheet::Mm(_), _) | (_, Turn::Portrait) => false,
            (_, Turn::Landscape) => true,
            (_, Turn::ByDrawing) => drawing.x > drawing.y,
        };
        if lies { [height, width] } else { [width, height] }
    }
}

impl PageSize {
    /// Returns the sheet's size in pixels at this resolution, upright unless landscape is set; `None` if no sheet is
    /// set.
    pub fn pixels(self, dpi: f64) -> Option<Size> {
        let Self::Paper(paper) = self else { return None };
        let [width, height] = paper.sides_mm(DVec2::ZERO).map(|side| (side / MM_PER_INCH * dpi).round() as u32);
        Some(Size { width, height })
    }
}

impl fmt::Display for Paper {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Sheet::Mm([width, height]) = self.sheet {
            return write!(out, "{width}x{height}mm");
        }
        let name = SHEETS.iter().find(|(_, sheet)| *sheet == self.sheet).map_or("", |(name, _)| name);
        let turn = TURNS.iter().find(|(_, turn)| *turn == self.turn).map_or("", |(turn, _)| turn);
        write!(out, "{name}{turn}")
    }
}

impl FromStr for Paper {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let lower = text.trim().to_ascii_lowercase();
        for (name, sheet) in SHEETS {
            let turn = lower.strip_prefix(&name.to_ascii_lowercase());
            if let Some((_, turn)) = turn.and_then(|rest| TURNS.into_iter().find(|(turn, _)| *turn == rest)) {
                return Ok(Self { sheet, turn });
            }
        }
        let usage = "choose A3, A4, A5 or letter, with -portrait or -landscape after it if it is to lie so, or write \
                     WIDTHxHEIGHTmm: 300x200mm";
        let sides = lower.strip_suffix("mm").and_then(|sides| sides.split_once('x'));
        match sides.map(|(width, height)| (width.trim().parse(), height.trim().parse())) {
            Some((Ok(width), Ok(height))) => Ok(Self { sheet: Sheet::Mm([width, height]), turn: Turn::ByDrawing }),
            _ => Err(usage.to_owned().into()),
        }
    }
}

impl Value for Paper {
    fn kind() -> Kind {
        let offered = &["A3", "A4", "A4-landscape", "A4-portrait", "A5", "letter"];
        Kind::Text { offered, example: "A4" }
    }

    fn text(&self) -> String {
        self.to_string()
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// Largest width on paper in millimetres, and most pixels per inch: beyond any paper, within any reader's range.
const LARGEST: f64 = 1e6;

/// Least width and resolution: still written as more than 0.
const SMALLEST: f64 = 1e-3;

const MM_PER_INCH: f64 = 25.4;

/// Pixels per inch for a page of unknown size, as SVG readers assume.
#[cfg(feature = "pdf")]
const PX_PER_INCH: f64 = 96.0;

/// Points per inch, PDF's unit.
#[cfg(feature = "pdf")]
const POINTS_PER_INCH: f64 = 72.0;

/// Decimals of a length on paper, which may be a small fraction of an inch.
pub(in crate::lines) const PAGE_DECIMALS: u32 = 6;

impl PageSize {
    pub(in crate::lines) fn check(self, margin: Millimetres) -> Result<()> {
        let is_sound = |value: f64| (SMALLEST..=LARGEST).contains(&value);
        match self {
            Self::WidthMm(width) if !is_sound(width) => {
                Err(Error::value("width-mm", width, format!("a drawing is {SMALLEST} to {LARGEST} millimetres wide")))
            }
            Self::Dpi(dpi) if !is_sound(dpi) => Err(Error::value(
                "dpi",
                dpi,
                format!("a resolution is {SMALLEST} to {LARGEST} pixels per inch; 96 is common"),
            )),
            Self::Paper(paper) => {
                let sides = paper.sheet.sides_mm();
                if !sides.into_iter().all(is_sound) {
                    let problem = format!("each side of a paper is {SMALLEST} to {LARGEST} millimetres long");
                    return Err(Error::value("page", paper, problem));
                }
                let most = sides[0].min(sides[1]) * 0.5;
                if !(0.0..most).contains(&margin.0) {
                    let problem = format!("on this paper a margin is at least 0 and less than {most} millimetres");
                    return Err(Error::value("margin", margin.text(), problem));
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Whether the drawing has a size on paper.
    pub(in crate::lines) fn is_set(self) -> bool {
        self != Self::Unset
    }
}

/// The paper of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Page {
    /// Its upper left corner in the picture's plane, pixels.
    pub origin_px: DVec2,
    /// Its extent in the picture's plane, pixels.
    pub extent_px: DVec2,
    /// Its width and height on paper as SVG writes them, and their unit.
    lengths: DVec2,
    unit: &'static str,
    /// The scale of lengths.
    pub units: Units,
}

impl Page {
    /// The page of a drawing of a picture's size; the drawn lines and the corners around its areas matter only for a sheet, which
    /// they fill, or on which a millimetre is as many pixels as `to_scale` says.
    pub(in crate::lines) fn new<'a>(
        Size { width, height }: Size,
        drawn: impl Iterator<Item = &'a LineSegment>,
        areas_px: Option<[DVec2; 2]>,
        size: PageSize,
        margin: f64,
        to_scale: Option<f64>,
    ) -> Self {
        let picture = DVec2::new(f64::from(width), f64::from(height));
        let units = |px_per_mm| Units { px_per_mm, height_px: picture.y };
        let whole = |lengths, unit, px_per_mm| Self {
            origin_px: DVec2::ZERO,
            extent_px: picture,
            lengths,
            unit,
            units: units(px_per_mm),
        };
        match size {
            PageSize::Unset => whole(picture, "", None),
            PageSize::WidthMm(width) => {
                let lengths = DVec2::new(picture.x * width / picture.x, picture.y * width / picture.x);
                whole(lengths, "mm", Some(picture.x / width))
            }
            PageSize::Dpi(dpi) => whole(picture / dpi, "in", Some(dpi / MM_PER_INCH)),
            PageSize::Paper(paper) => {
                let (low, high) = bounds(drawn, areas_px).unwrap_or((DVec2::ZERO, picture));
                let paper_mm = DVec2::from_array(paper.sides_mm(high - low));
                // A horizontal or vertical line has an extent of 0 in one direction.
                let room = (paper_mm - 2.0 * margin) / (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
                let px_per_mm = to_scale.unwrap_or(1.0 / room.min_element());
                let extent_px = paper_mm * px_per_mm;
                let origin_px = (low + high - extent_px) * 0.5;
                Self { origin_px, extent_px, lengths: paper_mm, unit: "mm", units: units(Some(px_per_mm)) }
            }
        }
    }

    /// Width and height as SVG writes them.
    pub(in crate::lines) fn lengths(&self) -> [String; 2] {
        self.lengths.to_array().map(|length| crate::lines::drawing::text::decimal(length, PAGE_DECIMALS) + self.unit)
    }

    #[cfg(feature = "pdf")]
    pub(in crate::lines) fn points_per_px(&self) -> f64 {
        match self.units.px_per_mm {
            Some(px_per_mm) => POINTS_PER_INCH / (px_per_mm * MM_PER_INCH),
            None => POINTS_PER_INCH / PX_PER_INCH,
        }
    }
}

/// The bounding box of segments and further points; `None` if it has no extent.
fn bounds<'a>(pieces: impl Iterator<Item = &'a LineSegment>, more: Option<[DVec2; 2]>) -> Option<(DVec2, DVec2)> {
    let ends = pieces.flat_map(|piece| piece.ends_px).chain(more.into_iter().flatten());
    let around = ends.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), end| (low.min(end), high.max(end)));
    ((around.1 - around.0).max_element() > 0.0).then_some(around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;

    const SIZE: Size = Size { width: 600, height: 400 };

    fn line(a: [f64; 2], b: [f64; 2]) -> LineSegment {
        LineSegment {
            ends_world: [glam::DVec3::ZERO; 2],
            class: Class::Crease,
            is_visible: true,
            is_outline: false,
            background: [false; 2],
            is_covered: false,
            ends_px: [a.into(), b.into()],
            edge: None,
            angle_degrees: None,
            object: 0,
            part: 0,
            look: 0,
        }
    }

    fn page(line: &LineSegment, size: PageSize, margin: f64) -> Page {
        Page::new(SIZE, std::iter::once(line), None, size, margin, None)
    }

    #[test]
    fn sizes_on_a_page_keep_the_pictures_shape() {
        let lengths = |size| page(&line([0.0; 2], [1.0; 2]), size, 15.0).lengths();
        assert_eq!(lengths(PageSize::Unset), ["600", "400"]);
        assert_eq!(lengths(PageSize::WidthMm(210.0)), ["210mm", "140mm"]);
        assert_eq!(lengths(PageSize::Dpi(96.0)), ["6.25in", "4.166667in"]);
    }

    #[test]
    fn papers_are_read_and_written_in_any_turn() {
        for text in ["A3", "A4", "A5", "letter", "A4-landscape", "letter-portrait", "300x200mm", "88.9x50.8mm"] {
            assert_eq!(text.parse::<Paper>().unwrap().to_string(), text);
        }
        assert_eq!("a4".parse(), "A4".parse::<Paper>());
        for bad in ["A9", "", "A4-upright", "A4landscape", "300x200", "x200mm", "300mm", "wide"] {
            assert!(bad.parse::<Paper>().is_err(), "{bad}");
        }
    }

    #[test]
    fn a_drawing_fills_its_sheet_but_for_the_margin_and_lies_as_it_does() {
        let sheet = |text: &str| PageSize::Paper(text.parse().unwrap());
        let assert_fits = |[a, b]: [[f64; 2]; 2], text: &str, margin: f64, sides: [f64; 2]| {
            let page = page(&line(a, b), sheet(text), margin);
            assert_eq!(page.lengths(), sides.map(|side| format!("{side}mm")), "{text}");
            let mm = |px: [f64; 2]| (DVec2::from(px) - page.origin_px) / page.units.px_per_mm.unwrap();
            let (low, high) = (mm(a), mm(b));
            assert!((low + high - DVec2::from(sides)).abs().max_element() < 1e-9, "{text}: centred");
            let free = low.min(DVec2::from(sides) - high);
            assert!(
                (free.min_element() - margin).abs() < 1e-9 && free.max_element() >= margin - 1e-9,
                "{text}: {free}"
            );
        };
        assert_fits([[100.0, 100.0], [200.0, 150.0]], "A4", 15.0, [297.0, 210.0]);
        assert_fits([[100.0, 100.0], [150.0, 200.0]], "A4", 15.0, [210.0, 297.0]);
        assert_fits([[100.0, 100.0], [150.0, 200.0]], "A4-landscape", 0.0, [297.0, 210.0]);
        assert_fits([[0.0, 0.0], [600.0, 400.0]], "A3-portrait", 20.0, [297.0, 420.0]);
        assert_fits([[0.0, 0.0], [600.0, 400.0]], "100x300mm", 49.0, [100.0, 300.0]);
        assert_fits([[10.0, 50.0], [20.0, 50.0]], "letter", 15.0, [279.4, 215.9]);
        // An empty drawing shows the whole picture.
        let nothing = Page::new(SIZE, std::iter::empty(), None, sheet("A4"), 15.0, None);
        assert_eq!(nothing.units.px_per_mm, Some(600.0 / 267.0));
        // Areas without lines fill it too.
        let corners = Some([DVec2::ZERO, DVec2::new(267.0, 100.0)]);
        let areas = Page::new(SIZE, std::iter::empty(), corners, sheet("A4"), 15.0, None);
        assert_eq!(areas.units.px_per_mm, Some(1.0));
    }

    #[test]
    fn margins_that_leave_nothing_are_refused() {
        let check = |text: &str, margin| PageSize::Paper(text.parse().unwrap()).check(Millimetres(margin));
        assert!(check("A4", 0.0).is_ok() && check("A4", 104.9).is_ok());
        for margin in [-1.0, 105.0, f64::NAN] {
            assert!(check("A4", margin).unwrap_err().to_string().starts_with("margin"));
        }
        for paper in ["0x20mm", "-3x20mm", "20x1e9mm", "NaNxNaNmm"] {
            assert!(check(paper, 0.0).unwrap_err().to_string().starts_with("page"), "{paper}");
        }
    }
}
