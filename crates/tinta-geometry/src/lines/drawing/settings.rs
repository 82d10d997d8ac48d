//! The settings of drawings in SVG and PDF.

use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::drawing::curves::FIT_PX;
use crate::lines::drawing::hatch::Hatching;
use crate::lines::drawing::layers::{ClassColors, ClassWidths, Layer};
use crate::lines::drawing::length::{LINE_WIDTH, LINE_WIDTH_RANGE, LINE_WIDTH_SAID, Length, Millimetres, Units};
use crate::lines::drawing::page::{PageSize, Paper};
use crate::lines::drawing::scale::{ModelUnit, Scale};
use crate::scene::{Background, Color};
use crate::settings::{HasSettings, Kind, Setting, Table, Value, under, within};
use std::sync::LazyLock;

/// The settings of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingSettings {
    /// Its title. Default none.
    pub title: String,
    /// The command that made it, stored in its metadata. Default none.
    pub command: String,
    /// The recipe that reproduces it, as JSON, stored in the metadata of an SVG. Default none.
    pub recipe: String,
    /// How hidden lines are drawn. Default: not at all.
    pub hidden: HiddenLines,
    /// Colours of layers. Default black; dashed hidden lines have a colour half-way to the paper's.
    pub class_colors: ClassColors,
    /// Width of the lines. Default 2 pixels, on [`PageSize::Paper`] half a millimetre.
    pub line_width: Option<Length>,
    /// Widths of layers. Default the line width; hidden lines have half the width of their class.
    pub class_widths: ClassWidths,
    /// Strokes and branches with a free end that are shorter than this are removed, unless that would open a line.
    /// For creases the limit is eight times this length or eight line widths, whichever is less, but never below this
    /// length. Default the line width.
    pub min_length: Option<Length>,
    /// Largest distance of the drawn cubic Bézier curves from the lines, pixels. Default none, which draws polylines.
    pub fit_px: Option<f64>,
    /// How tones are drawn as strokes. Default not: a style with tones fills their areas.
    pub hatching: Hatching,
    /// A rectangle behind the drawing, or none. Default white.
    pub background: Background,
    /// Size on paper. Default unset: the program that shows the drawing decides.
    pub page_size: PageSize,
    /// Margin around the drawing on [`PageSize::Paper`]. Default 15 millimetres.
    pub margin: Millimetres,
    /// Lengths on [`PageSize::Paper`] over those of the model, in parallel projection. Default none: the drawing fills the paper.
    pub scale: Option<Scale>,
    /// The unit of the model's numbers. Default millimetres.
    pub units: ModelUnit,
    /// Whether visible lines that end free taper off. Not for a pen, or in DXF. Default false.
    pub tapers: bool,
    /// Whether the drawing is for a plotter. Paths are then sorted to shorten pen-up travel, dashes are separate
    /// lines, and the background and areas are omitted. Layers, widths and colours distinguish the pens; lines without a width
    /// are half a pixel wide. Default false.
    pub is_for_pen: bool,
}

impl Default for DrawingSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            command: String::new(),
            recipe: String::new(),
            hidden: HiddenLines::None,
            class_colors: ClassColors::default(),
            line_width: None,
            class_widths: ClassWidths::default(),
            min_length: None,
            fit_px: None,
            hatching: Hatching::default(),
            background: Background::Color(WHITE),
            page_size: PageSize::Unset,
            margin: Millimetres(15.0),
            scale: None,
            units: ModelUnit::Mm,
            tapers: false,
            is_for_pen: false,
        }
    }
}

const WHITE: Color = Color([1.0; 3]);

impl HasSettings for DrawingSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<DrawingSettings>> = LazyLock::new(|| Table {
            settings: DrawingSettings::settings(),
            defaults: vec![DrawingSettings::default()],
        });
        &TABLE
    }
}

/// The text for an unset size on paper.
const UNSET: &str = "none";

/// The text for a length that follows from others.
const AUTO: &str = "auto";

/// Default line width, and that on a sheet of paper.
const WIDTH: Length = Length::Px(2.0);
const WIDTH_ON_PAPER: Length = Length::Mm(0.5);

impl DrawingSettings {
    /// The settings, for the table of a struct that may contain a drawing. Title, recipe and background come from
    /// elsewhere.
    pub fn settings() -> Vec<Setting<Self>> {
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
        )
        .inside("page");
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
        )
        .inside("page");
        let paper = Setting::of(
            "page",
            "PAPER",
            Paper::kind(),
            "Sheet of paper, which the drawing fills up to --margin: A3, A4, A5, letter or WIDTHxHEIGHTmm; it lies \
             as the drawing fills it better, or in a fixed way: A4-landscape, A4-portrait",
            |svg: &Self| if let PageSize::Paper(paper) = svg.page_size { paper.text() } else { UNSET.to_owned() },
            |svg, text| {
                svg.page_size = if text == UNSET { PageSize::Unset } else { PageSize::Paper(Paper::parse(text)?) };
                Ok(())
            },
        )
        .common();
        let (name, value_name, help) = LINE_WIDTH;
        let (low, high, decimals) = LINE_WIDTH_RANGE;
        let settings = vec![
            ClassColors::setting_of_drawing(|svg: &mut Self| &mut svg.class_colors),
            Setting::open_field(name, value_name, AUTO, help, |svg: &mut Self| &mut svg.line_width)
                .range(low, high, decimals)
                .said(LINE_WIDTH_SAID),
            Setting::field(
                "hidden",
                "HOW",
                "Hidden lines: none, dashed (grey, on --page black) or ghost (faint, or unbroken and in full colour with --pen); half as \
                 wide as the visible ones, or as --class-widths and the look say, in layers below them",
                |svg: &mut Self| &mut svg.hidden,
            )
            .common(),
            Setting::field(
                "class-widths",
                "WIDTHS",
                "Widths of the lines by class: CLASS=WIDTH, separated by commas, in pixels of --size, millimetres (0.35mm) or \
                 line widths (2x); also outline (at the background), hatch, hidden, hidden-CLASS",
                |svg: &mut Self| &mut svg.class_widths,
            )
            .said("the width of all lines, half of it for hidden and tangent ones, 0.4 of it for hatch"),
            Setting::open_field(
                "min-length",
                "LENGTH",
                AUTO,
                "Leave out lines with a free end that are shorter than this, in pixels of --size or millimetres on \
                 paper (1mm); 0 keeps all",
                |svg: &mut Self| &mut svg.min_length,
            )
            .range(0.0, 20.0, 1)
            .said("the line's width, 8 widths for creases, 16 with --taper; 0 into .json and .dxf"),
            Setting::open_field(
                "fit-curves",
                "PX",
                UNSET,
                "Turn bent lines into cubic Bézier curves, at most this far from them in pixels of --size; more \
                 writes fewer curves",
                |svg: &mut Self| &mut svg.fit_px,
            )
            .range(*FIT_PX.start(), *FIT_PX.end(), 2)
            .said("none, only straight segments"),
            width.open(UNSET).said("none, sizes are in pixels"),
            dpi.open(UNSET).said("none, sizes are in pixels"),
            paper.open(UNSET).said("none, sizes are in pixels"),
            Setting::field("margin", "MM", "Free border of --page, in millimetres", |svg: &mut Self| &mut svg.margin).inside("page"),
            Setting::open_field(
                "scale",
                "PAPER:MODEL",
                UNSET,
                "Lengths on the paper of --page over those of the model, in parallel projection: 1:2, 2:1, 1:2.5; a sheet takes the \
                 largest round one that fits",
                |svg: &mut Self| &mut svg.scale,
            )
            .said("none, the drawing fills its paper")
            .common(),
            Setting::field("units", "UNIT", "Unit of the model's numbers, for --scale: mm, cm, m, in", |svg: &mut Self| {
                &mut svg.units
            }),
            Setting::flag(
                "taper",
                "Let visible lines that end free taper off over 12 widths, as a pen leaves the paper; not in .dxf, or with \
                 --pen",
                |svg: &Self| svg.tapers,
                |svg, is_on| svg.tapers = is_on,
            ),
            Setting::flag(
                "pen",
                "Draw for a plotter: order lines for short moves with the pen up, write dashes as separate lines, \
                 leave out the background and areas; an outline with its own width (--class-widths, --look technical) is a layer \
                 for a second pen",
                |svg: &Self| svg.is_for_pen,
                |svg, is_on| svg.is_for_pen = is_on,
            ),
        ];
        let heading = "Style lines: exact visible lines, as vectors into FILE.svg and the like, as pixels \
            into FILE.png with --look technical or --style lines; also --classes, --class-colors, --line-width, \
            --crease-angle";
        let hatching = within(Hatching::settings(), |svg: &mut Self| Some(&mut svg.hatching));
        under(heading, settings.into_iter().chain(hatching).collect()).collect()
    }
}

crate::choices! {
    /// How hidden lines are drawn.
    #[derive(Default)]
    pub enum HiddenLines {
        /// Not at all.
        #[default]
        None = "none",
        /// Dashed.
        Dashed = "dashed",
        /// Faint; for a pen, which cannot draw faintly, thin lines in separate layers.
        Ghost = "ghost",
    }
}

/// Thinnest and widest line, pixels or millimetres. The thinnest is still written as more than 0; the widest is that
/// of style inking.
const WIDTHS: std::ops::RangeInclusive<f64> = 1e-3..=16_384.0;

impl DrawingSettings {
    /// Refuses invalid settings, before any work.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for an invalid width, length, paper size or resolution, and for millimetres without a size
    /// on paper.
    pub fn check(&self) -> Result<()> {
        let has_paper = self.page_size.is_set();
        let is_wrong = |width: Length| !width.all(|number| WIDTHS.contains(&number));
        let refuse_width = |name: &str, value: String| {
            let limits = (WIDTHS.start(), WIDTHS.end());
            let problem = format!("a line's width is a number from {} to {}", limits.0, limits.1);
            Err(Error::value(name, value, problem))
        };
        if let Some(width) = self.line_width {
            if is_wrong(width) {
                return refuse_width("line-width", width.to_string());
            }
            width.check_unit("line-width", has_paper)?;
            width.check_is_no_multiple("line-width")?;
        }
        if let Some((name, width)) = self.class_widths.0.find(is_wrong) {
            return refuse_width("class-widths", format!("{name}={width}"));
        }
        if let Some((_, width)) = self.class_widths.0.find(|width| width.check_unit("", has_paper).is_err()) {
            width.check_unit("class-widths", has_paper)?;
        }
        if let Some(length) = self.min_length {
            length.check_unit("min-length", has_paper)?;
            length.check_is_no_multiple("min-length")?;
            if !length.all(|number| number >= 0.0 && number.is_finite()) {
                return Err(Error::value("min-length", length, "a length is a number, 0 or more"));
            }
        }
        self.hatching.check(WIDTHS, has_paper)?;
        if let Some(error) = self.fit_px.filter(|error| !FIT_PX.contains(error)) {
            let problem = format!("the error of curves is a number from {} to {}", FIT_PX.start(), FIT_PX.end());
            return Err(Error::value("fit-curves", error, problem));
        }
        if self.margin != Self::default().margin && !matches!(self.page_size, PageSize::Paper(_)) {
            return Err(Error::setting("margin", "only a sheet of paper has a margin; add --page A4, or leave it out"));
        }
        if let Some(scale) = self.scale.filter(|_| !matches!(self.page_size, PageSize::Paper(_))) {
            let problem = "only a sheet of paper has a scale; add --page A4, or leave it out";
            return Err(Error::value("scale", scale.text(), problem));
        }
        self.page_size.check(self.margin)
    }

    /// Whether outlines must be found because they have a width or colour.
    pub fn tells_outline(&self) -> bool {
        self.class_widths.0.tells_outline() || self.class_colors.0.tells_outline()
    }

    /// Whether visible or hidden lines are drawn.
    pub(in crate::lines) fn draws(&self, is_visible: bool) -> bool {
        is_visible || self.hidden != HiddenLines::None
    }

    /// The common line width.
    fn width(&self) -> Length {
        self.line_width.unwrap_or(match self.page_size {
            PageSize::Paper(_) => WIDTH_ON_PAPER,
            _ => WIDTH,
        })
    }

    /// A layer's width in pixels: its own, or a share of that of all lines. Hidden lines have half of their class's.
    pub(in crate::lines) fn width_px(&self, layer: Layer, units: Units) -> f64 {
        let px = |length: Length| length.px(units).unwrap_or(0.0);
        match (self.class_widths.0.of(layer), layer) {
            (Some(Length::Times(times)), _) => times * px(self.width()),
            (Some(width), _) => px(width),
            (None, Layer::Hidden(Class::Centre)) => self.width_px(Layer::Visible(Class::Centre), units),
            (None, Layer::Hidden(class)) => self.width_px(Layer::Visible(class), units) * HIDDEN_WIDTH,
            (None, Layer::Visible(Class::Point)) => px(self.width()) * POINT_WIDTHS,
            (None, Layer::Visible(Class::Tangent | Class::Centre)) => px(self.width()) * HIDDEN_WIDTH,
            (None, Layer::Hatch(_)) => HATCH_WIDTH_ON_PAPER.px(units).unwrap_or(px(self.width()) * HATCH_WIDTH),
            (None, _) => px(self.width()),
        }
    }

    /// Whether it is drawn on a sheet of paper, by the lines of technical drawings.
    pub(in crate::lines) fn is_on_paper(&self) -> bool {
        matches!(self.page_size, PageSize::Paper(_))
    }

    /// Whether a layer's width is set.
    pub(in crate::lines) fn says_width(&self, layer: Layer) -> bool {
        self.line_width.is_some() || self.class_widths.0.of(layer).is_some()
    }

    /// A layer's colour: its own, or that of its class. Dashed hidden lines have half its strength, but not for a
    /// pen, which has one ink for both; ghosts are faint anyway.
    pub(in crate::lines) fn color(&self, layer: Layer) -> Color {
        match (self.class_colors.0.of(layer), layer) {
            (Some(color), _) => color,
            (None, Layer::Hidden(class)) => {
                let color = self.color(Layer::Visible(class));
                let is_grey = self.hidden == HiddenLines::Dashed
                    && class != Class::Centre
                    && !self.is_for_pen
                    && !self.is_on_paper();
                if is_grey { mixed(color, self.paper_color(), HIDDEN_STRENGTH) } else { color }
            }
            (None, _) => Color([0.0; 3]),
        }
    }

    /// The colour behind the lines; white without a background.
    pub(in crate::lines) fn paper_color(&self) -> Color {
        match self.background {
            Background::Color(color) if !self.is_for_pen => color,
            _ => WHITE,
        }
    }

    /// Length in pixels below which a stroke of a layer may be removed. It is longer for lines that may be noise:
    /// creases with a free end are mostly folds of a scan, because creases on a part's edge end at other lines. Where
    /// outlines are found, silhouettes inside them with a free end are single facets of a curved surface that turn
    /// away. A pen's width counts like any other.
    pub(in crate::lines) fn min_length_px(&self, layer: Layer, units: Units) -> f64 {
        let width = self.width_px(layer, units);
        let length = self.min_length.and_then(|length| length.px(units)).unwrap_or(width);
        let may_be_a_fold = match layer {
            Layer::Visible(Class::Crease) | Layer::Hidden(Class::Crease) => true,
            Layer::Visible(Class::Silhouette) => self.tells_outline(),
            _ => false,
        };
        let widths = if self.tapers { LEAST_TAPERED } else { LEAST_FOLD };
        if may_be_a_fold { length.max(widths * length.min(width)) } else { length }
    }
}

/// Mixes a colour into the paper's: strength 0 gives the paper's.
pub(in crate::lines) fn mixed(color: Color, paper: Color, strength: f32) -> Color {
    let [Color(color), Color(paper)] = [color, paper];
    Color(std::array::from_fn(|channel| paper[channel] + (color[channel] - paper[channel]) * strength))
}

/// Factor of the least length for creases, and for silhouettes inside the outline, with a free end or without a
/// connection.
const LEAST_FOLD: f64 = 8.0;

/// The same for lines that taper: a shorter one hardly reaches its full width.
const LEAST_TAPERED: f64 = 16.0;

/// Diameter of the dots that show points, in line widths.
const POINT_WIDTHS: f64 = 2.0;

/// Width of the strokes of tones on paper; without paper, in line widths.
const HATCH_WIDTH_ON_PAPER: Length = Length::Mm(0.2);
const HATCH_WIDTH: f64 = 0.4;

/// Hidden lines' width and strength, as shares of their class's.
const HIDDEN_WIDTH: f64 = 0.5;
const HIDDEN_STRENGTH: f32 = 0.5;

#[cfg(test)]
mod tests {
    use super::*;

    fn units(px_per_mm: Option<f64>) -> Units {
        Units { px_per_mm, height_px: 512.0 }
    }

    fn base() -> DrawingSettings {
        DrawingSettings::default()
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let message = |settings: DrawingSettings| settings.check().unwrap_err().to_string();
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let line_width = Some(Length::Px(width));
            assert!(message(DrawingSettings { line_width, ..base() }).starts_with("line-width"));
            let mut class_widths = ClassWidths::default();
            class_widths.0.set_class(Class::Boundary, Length::Px(width));
            assert!(message(DrawingSettings { class_widths, ..base() }).starts_with("class-widths boundary="));
        }
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let with = |page_size| message(DrawingSettings { page_size, ..base() });
            assert!(with(PageSize::WidthMm(value)).starts_with("width-mm"));
            assert!(with(PageSize::Dpi(value)).starts_with("dpi"));
        }
        for length in [-1.0, f64::NAN, f64::INFINITY] {
            let min_length = Some(Length::Px(length));
            assert!(message(DrawingSettings { min_length, ..base() }).starts_with("min-length"));
        }
        assert!(message(DrawingSettings { margin: Millimetres(3.0), ..base() }).starts_with("margin: only"));
        let spacings =
            [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9].map(Length::Px).into_iter().chain([Length::Times(0.0)]);
        for spacing in spacings {
            let hatching = Hatching { spacing: Some(spacing), ..Hatching::default() };
            assert!(
                message(DrawingSettings { hatching, ..base() }).starts_with(&format!("hatch {spacing}: a distance"))
            );
        }
        for angle_degrees in [f64::NAN, f64::INFINITY, 1e9] {
            let hatching = Hatching { angle_degrees: Some(angle_degrees), ..Hatching::default() };
            assert!(message(DrawingSettings { hatching, ..base() }).starts_with("hatch-angle"));
        }
        assert!(base().check().is_ok());
    }

    #[test]
    fn millimetres_need_paper() {
        let mm = Some(Length::Mm(0.5));
        let class_widths: ClassWidths = "hidden=0.2mm".parse().unwrap();
        let on_screen = [
            DrawingSettings { line_width: mm, ..base() },
            DrawingSettings { min_length: mm, ..base() },
            DrawingSettings { hatching: Hatching { spacing: mm, ..Hatching::default() }, ..base() },
            DrawingSettings { class_widths, ..base() },
        ];
        for settings in on_screen {
            assert!(settings.check().unwrap_err().to_string().contains("--page A4"));
            for page_size in [PageSize::WidthMm(90.0), PageSize::Dpi(96.0), PageSize::Paper("A4".parse().unwrap())] {
                assert!(DrawingSettings { page_size, ..settings.clone() }.check().is_ok());
            }
        }
    }

    #[test]
    fn hidden_lines_are_half_as_wide_and_grey_unless_said_otherwise() {
        let hidden = Layer::Hidden(Class::Crease);
        let dashed = DrawingSettings { hidden: HiddenLines::Dashed, ..base() };
        assert_eq!((dashed.width_px(hidden, units(None)), dashed.color(hidden)), (1.0, Color([0.5; 3])));
        let red = Color([1.0, 0.0, 0.0]);
        let mut told = dashed.clone();
        told.class_widths.0.set_class(Class::Crease, Length::Mm(3.0));
        told.class_colors.0.set_class(Class::Crease, red);
        assert_eq!((told.width_px(hidden, units(Some(2.0))), told.color(hidden)), (3.0, Color([1.0, 0.5, 0.5])));
        told.class_widths = "crease=3mm,hidden=0.25".parse().unwrap();
        told.class_colors = "crease=red,hidden=red".parse().unwrap();
        assert_eq!((told.width_px(hidden, units(Some(2.0))), told.color(hidden)), (0.25, red));
        let pen = DrawingSettings { is_for_pen: true, ..dashed.clone() };
        assert_eq!(pen.color(hidden), Color([0.0; 3]), "a pen's ink does not thin");
        let on_paper = DrawingSettings { page_size: PageSize::Paper("A4".parse().unwrap()), ..dashed.clone() };
        assert_eq!(on_paper.color(hidden), Color([0.0; 3]), "narrow and black, as in technical drawings");
        let on_black = DrawingSettings { background: Background::Color(Color([0.0; 3])), ..told };
        assert_eq!(on_black.paper_color(), Color([0.0; 3]));
    }

    #[test]
    fn widths_of_classes_may_be_multiples_of_all_lines_width() {
        let class_widths = "outline=2x,hidden=1x".parse().unwrap();
        let line_width = Some(Length::ScreenOrPaper { percent: 0.5, mm: 0.35 });
        let settings = DrawingSettings { class_widths, line_width, page_size: PageSize::Dpi(96.0), ..base() };
        let layers = [Layer::Outline, Layer::Visible(Class::Crease), Layer::Hidden(Class::Crease)];
        let widths =
            |settings: &DrawingSettings, px_per_mm| layers.map(|layer| settings.width_px(layer, units(px_per_mm)));
        assert_eq!(widths(&settings, Some(10.0)), [7.0, 3.5, 3.5]);
        assert_eq!(widths(&settings, None), [5.12, 2.56, 2.56]);
        let told = DrawingSettings { line_width: Some(Length::Mm(0.25)), ..settings.clone() };
        assert_eq!(widths(&told, Some(10.0)), [5.0, 2.5, 2.5]);
        assert!(settings.check().is_ok() && told.check().is_ok());
        let itself = DrawingSettings { line_width: Some(Length::Times(2.0)), ..settings.clone() };
        assert!(itself.check().unwrap_err().to_string().contains("line-width 2x"));
        let nothing = DrawingSettings { class_widths: "outline=0x".parse().unwrap(), ..settings };
        assert!(nothing.check().unwrap_err().to_string().contains("outline=0x"));
    }

    #[test]
    fn lines_are_half_a_millimetre_wide_on_a_sheet() {
        let layer = Layer::Visible(Class::Silhouette);
        assert_eq!(base().width_px(layer, units(None)), 2.0);
        let paper = DrawingSettings { page_size: PageSize::Paper("A4".parse().unwrap()), ..base() };
        assert_eq!(paper.width_px(layer, units(Some(3.0))), 1.5);
        assert_eq!(paper.min_length_px(layer, units(Some(3.0))), 1.5);
        assert_eq!(paper.min_length_px(Layer::Visible(Class::Crease), units(Some(3.0))), 12.0);
        assert_eq!(
            DrawingSettings { line_width: Some(Length::Px(4.0)), ..paper }.width_px(layer, units(Some(3.0))),
            4.0
        );
    }

    #[test]
    fn strokes_of_tones_are_as_wide_on_every_paper_whatever_the_style() {
        let widths = [None, Some(Length::Px(2.5)), Some(Length::ScreenOrPaper { percent: 0.3, mm: 0.35 })];
        for line_width in widths {
            let settings = DrawingSettings { line_width, ..base() };
            let width = |px_per_mm| settings.width_px(Layer::Hatch(1), units(px_per_mm));
            assert_eq!([width(Some(2.0)), width(Some(5.0))], [0.4, 1.0]);
            assert_eq!(width(None), settings.width_px(Layer::Outline, units(None)) * 0.4);
        }
    }

    #[test]
    fn silhouettes_within_an_outline_that_is_told_apart_are_as_long_as_creases() {
        let length = |settings: &DrawingSettings, layer| settings.min_length_px(layer, units(None));
        let told = DrawingSettings { class_widths: "outline=2x".parse().unwrap(), ..base() };
        assert_eq!(length(&base(), Layer::Visible(Class::Silhouette)), 2.0);
        assert_eq!(length(&told, Layer::Visible(Class::Silhouette)), 16.0);
        assert_eq!(length(&told, Layer::Outline), 4.0);
        assert_eq!(length(&told, Layer::Visible(Class::Boundary)), 2.0);
    }
}
