//! The style of a part: its role in hiding, its classes of lines, and how they are drawn.

use crate::edges::{Class, ClassSet, CreaseAngle};
use crate::lines::drawing::layers::{ClassColors, ClassWidths, OfLayers};
use crate::lines::drawing::length::Length;
use crate::lines::drawing::settings::{DrawingSettings, HiddenLines};
use crate::scene::Color;
use crate::settings::{HasSettings, Kind, Setting, Table};
use std::borrow::Cow;
use std::sync::LazyLock;

crate::choices! {
    /// Whether a part is drawn, and whether it hides others.
    #[derive(Default)]
    pub enum PartRole {
        /// Both.
        #[default]
        Solid = "solid",
        /// Both; a section leaves it whole.
        Uncut = "uncut",
        /// Drawn, but hides nothing.
        Ghost = "ghost",
        /// Hides others, but is not drawn.
        OccludeOnly = "occlude-only",
    }
}

/// The style of a part; everything unset is as for all other lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PartStyle {
    /// The patterns that gave it, for the names of layers; empty for the style of all other lines.
    pub name: String,
    /// The colour of its lines, whatever their classes; hidden ones follow.
    pub color: Option<Color>,
    /// The colour of its surface, whatever colours the model has.
    pub fill: Option<Color>,
    /// The width of its lines, whatever their classes; widths of classes in line widths (`2x`) follow.
    pub line_width: Option<Length>,
    /// How its hidden lines are drawn.
    pub hidden: Option<HiddenLines>,
    /// Its classes of lines.
    pub classes: Option<ClassSet>,
    /// The smallest angle of its creases.
    pub crease_angle: Option<CreaseAngle>,
    /// Its role.
    pub role: Option<PartRole>,
    /// Whether it is the hatched cut of a section: its lines are then twice as wide unless `line_width` is set.
    pub is_cut: bool,
    /// Whether it is a sheet's own: lettering, frame, scale bar, half as wide as other lines.
    pub is_of_sheet: bool,
}

/// Width of the lines of a hatched cut.
const CUT_WIDTH: Length = Length::Times(2.0);

/// Width of the strokes on it.
const STROKE_WIDTH: Length = Length::Times(0.7);

/// Width of a sheet's own lines.
const SHEET_WIDTH: Length = Length::Times(0.5);

/// The text of an unset value, which cannot be given.
const UNSET: &str = "";

/// Separates classes here, because commas separate settings.
const BETWEEN_CLASSES: &str = "+";

impl HasSettings for PartStyle {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<PartStyle>> =
            LazyLock::new(|| Table { settings: PartStyle::settings(), defaults: vec![PartStyle::default()] });
        &TABLE
    }
}

impl PartStyle {
    /// The name of the setting whose values may be written alone: `ghost` for `as=ghost`.
    pub(super) const ROLE: &'static str = "as";

    fn settings() -> Vec<Setting<Self>> {
        vec![
            Setting::open_field("color", "COLOR", UNSET, "Colour of its lines", |style: &mut Self| &mut style.color),
            Setting::open_field(
                "fill",
                "COLOR",
                UNSET,
                "Colour of its surface, in looks with tones",
                |style: &mut Self| &mut style.fill,
            ),
            Setting::open_field("line-width", "WIDTH", UNSET, "Width of its lines", |style: &mut Self| {
                &mut style.line_width
            }),
            Setting::of(
                "classes",
                "CLASSES",
                Kind::Several(Class::ALL.map(|(name, _)| name).into_iter().chain(["all"]).collect()),
                "Its classes of lines, with + between them",
                |style: &Self| {
                    style.classes.map_or(UNSET.to_owned(), |classes| classes.text().replace(',', BETWEEN_CLASSES))
                },
                |style, text| {
                    style.classes = match text {
                        UNSET => None,
                        _ => Some(ClassSet::parsed(&text.replace(BETWEEN_CLASSES, ","), ClassSet::ALL)?),
                    };
                    Ok(())
                },
            ),
            Setting::open_field(
                "crease-angle",
                "DEGREES",
                UNSET,
                "Smallest angle of its creases",
                |style: &mut Self| &mut style.crease_angle,
            ),
            Setting::open_field("hidden", "HOW", UNSET, "Its hidden lines", |style: &mut Self| &mut style.hidden),
            Setting::open_field(Self::ROLE, "ROLE", UNSET, "Its role in hiding", |style: &mut Self| &mut style.role),
        ]
    }

    /// This style over another: what it leaves unset is the other's.
    pub(super) fn over(&self, below: &Self) -> Self {
        let name = match (below.name.as_str(), self.name.as_str()) {
            (below, "") => below.to_owned(),
            ("", own) => own.to_owned(),
            (below, own) if below == own => own.to_owned(),
            (below, own) => format!("{below} + {own}"),
        };
        Self {
            name,
            is_cut: self.is_cut || below.is_cut,
            is_of_sheet: self.is_of_sheet || below.is_of_sheet,
            color: self.color.or(below.color),
            fill: self.fill.or(below.fill),
            line_width: self.line_width.or(below.line_width),
            hidden: self.hidden.or(below.hidden),
            classes: self.classes.or(below.classes),
            crease_angle: self.crease_angle.or(below.crease_angle),
            role: self.role.or(below.role),
        }
    }

    /// Whether it changes how lines are drawn, and not only which.
    pub(super) fn changes_drawing(&self) -> bool {
        self.color.is_some() || self.line_width.is_some() || self.hidden.is_some() || self.is_cut || self.is_of_sheet
    }

    /// Whether it is about the surface and sections alone, which all drawings have.
    pub fn is_of_surface(&self) -> bool {
        let of_lines = Self { name: String::new(), fill: None, ..self.clone() };
        of_lines == Self { role: of_lines.role.filter(|role| *role == PartRole::Uncut), ..Self::default() }
    }

    /// Whether its hidden lines are drawn.
    pub(super) fn draws_hidden(&self) -> bool {
        self.hidden.is_some_and(|hidden| hidden != HiddenLines::None)
    }

    /// The settings of a drawing for this part's lines.
    pub(in crate::lines) fn drawing<'d>(&self, drawing: &'d DrawingSettings) -> Cow<'d, DrawingSettings> {
        if !self.changes_drawing() {
            return Cow::Borrowed(drawing);
        }
        let mut own = drawing.clone();
        own.hidden = self.hidden.unwrap_or(own.hidden);
        if let Some(color) = self.color {
            own.class_colors = ClassColors(OfLayers::of_visible(color));
        }
        if self.is_cut && self.line_width.is_none() {
            own.class_widths = ClassWidths(OfLayers::of_visible(CUT_WIDTH));
            own.class_widths.0.set_class(Class::Curve, STROKE_WIDTH);
        }
        if self.is_of_sheet {
            own.class_widths.0.set_class(Class::Curve, SHEET_WIDTH);
        }
        if self.line_width.is_some() {
            own.line_width = self.line_width;
            own.class_widths = ClassWidths(own.class_widths.0.only(|width| matches!(width, Length::Times(_))));
        }
        Cow::Owned(own)
    }
}
