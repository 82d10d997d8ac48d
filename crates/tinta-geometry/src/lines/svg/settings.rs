//! The settings of SVG output.

use crate::edges::Class;
use crate::error::{Error, ParseError, Result};
use crate::lines::{ClassColors, line_width};
use crate::scene::{Background, Color, Size};
use crate::settings::{HasSettings, Kind, Problem, Setting, Table, Value, under};
use std::str::FromStr;
use std::sync::LazyLock;

/// How an SVG is written.
#[derive(Debug, Clone, PartialEq)]
pub struct SvgSettings {
    /// Its title. Default none.
    pub title: String,
    /// The command that made it, kept in its metadata. Default none.
    pub command: String,
    /// The recipe to make it again, JSON, kept in its metadata too. Default none.
    pub recipe: String,
    /// What becomes of hidden lines. Default none of them is written.
    pub hidden: Hidden,
    /// Each class's colour. Default black.
    pub class_colors: ClassColors,
    /// Width of the lines, pixels. Default 2.
    pub line_width_px: f32,
    /// Widths of single classes, pixels. Default that of all.
    pub class_widths: ClassWidths,
    /// A rectangle behind everything, or nothing. Default white.
    pub background: Background,
    /// How large it is on paper. Default left to the program that shows it.
    pub page_size: PageSize,
    /// Whether each path names its class, object, mesh edges and angles; then no point is left out. Default no.
    pub has_provenance: bool,
    /// Whether it is for a plotter: thin lines in an order that spares empty ways, dashes as lines of their own, no
    /// background; colours tell its pens apart. Default no.
    pub is_for_pen: bool,
}

impl Default for SvgSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            command: String::new(),
            recipe: String::new(),
            hidden: Hidden::None,
            class_colors: ClassColors::default(),
            line_width_px: 2.0,
            class_widths: ClassWidths::default(),
            background: Background::Color(Color([1.0; 3])),
            page_size: PageSize::Unset,
            has_provenance: false,
            is_for_pen: false,
        }
    }
}

impl HasSettings for SvgSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<SvgSettings>> =
            LazyLock::new(|| Table { settings: SvgSettings::settings(), defaults: vec![SvgSettings::default()] });
        &TABLE
    }
}

/// What a size on paper that is left open is called.
const UNSET: &str = "none";

impl SvgSettings {
    /// The settings; title, recipe and background come from elsewhere.
    fn settings() -> Vec<Setting<Self>> {
        let number = |low: f64, high: f64| Kind::Numbers { count: 1, range: [low, high], decimals: 1 };
        let width = Setting::of(
            "width-mm",
            "MM",
            number(10.0, 1000.0),
            "Width on paper in millimetres; the height follows",
            |svg: &Self| if let PageSize::WidthMm(width) = svg.page_size { width.text() } else { UNSET.to_owned() },
            |svg, text| {
                svg.page_size = if text == UNSET { PageSize::Unset } else { PageSize::WidthMm(f64::parse(text)?) };
                Ok(())
            },
        );
        let dpi = Setting::of(
            "dpi",
            "N",
            number(10.0, 1200.0),
            "Resolution on paper, in pixels per inch",
            |svg: &Self| if let PageSize::Dpi(dpi) = svg.page_size { dpi.text() } else { UNSET.to_owned() },
            |svg, text| {
                svg.page_size = if text == UNSET { PageSize::Unset } else { PageSize::Dpi(f64::parse(text)?) };
                Ok(())
            },
        );
        let settings = vec![
            ClassColors::setting(|svg: &mut Self| &mut svg.class_colors),
            line_width(|svg: &mut Self| &mut svg.line_width_px),
            Setting::field(
                "hidden",
                "HOW",
                "Hidden lines, in layers below the visible ones: none, dashed, ghost (faint; with --pen thin)",
                |svg: &mut Self| &mut svg.hidden,
            ),
            Setting::field(
                "class-widths",
                "WIDTHS",
                "Widths of the lines by class: CLASS=PIXELS, separated by commas; pixels of --size",
                |svg: &mut Self| &mut svg.class_widths,
            )
            .said("--line-width for all"),
            width.open(UNSET).said("none, sizes are in pixels"),
            dpi.open(UNSET).said("none, sizes are in pixels"),
            Setting::flag(
                "provenance",
                "Write each path's class, object, mesh edges and angles into the file, and keep all points",
                |svg: &Self| svg.has_provenance,
                |svg, is_on| svg.has_provenance = is_on,
            ),
            Setting::flag(
                "pen",
                "Draw for a plotter: thin lines, ordered for short moves with the pen up, dashes as separate lines, no \
                 background",
                |svg: &Self| svg.is_for_pen,
                |svg, is_on| svg.is_for_pen = is_on,
            ),
        ];
        let heading = "Style lines: exact visible lines, into FILE.svg or FILE.json; also --classes, --class-colors, \
                       --line-width, --crease-angle";
        under(heading, settings).collect()
    }
}

/// What becomes of hidden lines.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Hidden {
    /// They are left out.
    #[default]
    None,
    /// They are dashed.
    Dashed,
    /// They are faint; for a pen, which cannot be, thin lines in layers of their own.
    Ghost,
}

impl Hidden {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] = [("none", Self::None), ("dashed", Self::Dashed), ("ghost", Self::Ghost)];
}

crate::choices!(Hidden);

/// How large an SVG is on paper.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum PageSize {
    /// In pixels, whatever they are.
    #[default]
    Unset,
    /// This wide, millimetres.
    WidthMm(f64),
    /// This many pixels an inch.
    Dpi(f64),
}

/// The largest width on paper, millimetres, and the most pixels an inch: beyond any paper, within any reader's numbers.
const LARGEST: f64 = 1e6;

/// The least of both: still written as more than 0.
const SMALLEST: f64 = 1e-3;

/// Decimals of a length on paper, which may be a small part of an inch.
const PAGE_DECIMALS: u32 = 6;

impl PageSize {
    /// Width and height as SVG writes them.
    pub(super) fn lengths(self, size: Size) -> [String; 2] {
        let (pixels, scale, unit) = match self {
            Self::Unset => return [size.width.to_string(), size.height.to_string()],
            Self::WidthMm(width) => (f64::from(size.width), width, "mm"),
            Self::Dpi(dpi) => (dpi, 1.0, "in"),
        };
        [size.width, size.height]
            .map(|length| super::text::decimal(f64::from(length) * scale / pixels, PAGE_DECIMALS) + unit)
    }
}

/// Widths of lines by class, pixels, in the order of [`Class::ALL`]; `None` as wide as all others.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ClassWidths(pub [Option<f32>; Class::ALL.len()]);

impl Value for ClassWidths {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "silhouette=3,crease=0.5" }
    }

    fn text(&self) -> String {
        let given = Class::ALL.iter().zip(self.0);
        let given = given.filter_map(|((name, _), width)| width.map(|width| format!("{name}={width}")));
        let text = given.collect::<Vec<_>>().join(",");
        if text.is_empty() { UNSET.to_owned() } else { text }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for ClassWidths {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let mut widths = Self::default();
        if text == UNSET {
            return Ok(widths);
        }
        for setting in text.split(',') {
            let usage = || "write CLASS=PIXELS, separated by commas: silhouette=3,crease=1".to_owned();
            let (class, width) = setting.split_once('=').ok_or_else(usage)?;
            let width = width.trim().parse().map_err(|_| usage())?;
            widths.0[class.trim().parse::<Class>()? as usize] = Some(width);
        }
        Ok(widths)
    }
}

/// Widest and thinnest line, pixels; the widest as in the style inking, the thinnest still written as more than 0.
const WIDTHS: std::ops::RangeInclusive<f32> = 1e-3..=16_384.0;

impl SvgSettings {
    /// Refuses nonsense, before any work.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a width, paper size or resolution that is none.
    pub fn check(&self) -> Result<()> {
        let refuse_width = |name: &str, value: String| {
            let limits = (WIDTHS.start(), WIDTHS.end());
            let problem = format!("a line's width is a number of pixels from {} to {}", limits.0, limits.1);
            Err(Error::value(name, value, problem))
        };
        if !WIDTHS.contains(&self.line_width_px) {
            return refuse_width("line-width", self.line_width_px.to_string());
        }
        for ((name, _), width) in Class::ALL.iter().zip(self.class_widths.0) {
            if let Some(width) = width.filter(|width| !WIDTHS.contains(width)) {
                return refuse_width("class-widths", format!("{name}={width}"));
            }
        }
        let is_sound = |value: f64| (SMALLEST..=LARGEST).contains(&value);
        match self.page_size {
            PageSize::WidthMm(width) if !is_sound(width) => {
                Err(Error::value("width-mm", width, format!("a drawing is {SMALLEST} to {LARGEST} millimetres wide")))
            }
            PageSize::Dpi(dpi) if !is_sound(dpi) => Err(Error::value(
                "dpi",
                dpi,
                format!("a resolution is {SMALLEST} to {LARGEST} pixels per inch; 96 is common"),
            )),
            _ => Ok(()),
        }
    }

    /// A class's width, pixels.
    pub(super) fn width_px(&self, class: Class) -> f64 {
        f64::from(self.class_widths.0[class as usize].unwrap_or(self.line_width_px))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_read_and_nonsense_is_refused_by_name() {
        let widths: ClassWidths = "silhouette=3, crease=0.5".parse().unwrap();
        assert_eq!(widths.0[Class::Silhouette as usize], Some(3.0));
        assert_eq!(widths.0[Class::Boundary as usize], None);
        for bad in ["crease", "crease=", "crease=wide", "edges=2", ""] {
            assert!(bad.parse::<ClassWidths>().is_err(), "{bad}");
        }
        let base = SvgSettings::default;
        let message = |settings: SvgSettings| settings.check().unwrap_err().to_string();
        for width in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(message(SvgSettings { line_width_px: width, ..base() }).starts_with("line-width"));
            let class_widths = ClassWidths([Some(width); Class::ALL.len()]);
            assert!(message(SvgSettings { class_widths, ..base() }).starts_with("class-widths boundary="));
        }
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let with = |page_size| message(SvgSettings { page_size, ..base() });
            assert!(with(PageSize::WidthMm(value)).starts_with("width-mm"));
            assert!(with(PageSize::Dpi(value)).starts_with("dpi"));
        }
        assert!(base().check().is_ok());
    }

    #[test]
    fn sizes_on_a_page_keep_the_pictures_shape() {
        let size = Size { width: 600, height: 400 };
        assert_eq!(PageSize::Unset.lengths(size), ["600", "400"]);
        assert_eq!(PageSize::WidthMm(210.0).lengths(size), ["210mm", "140mm"]);
        assert_eq!(PageSize::Dpi(96.0).lengths(size), ["6.25in", "4.166667in"]);
    }
}
