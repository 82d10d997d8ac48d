//! The layers of a drawing, and their colours and widths. Drawings by GL have only those of classes.
//!
//! Input: texts such as `silhouette=3,hidden=0.5`. Output: [`OfLayers`], with a value for some of the names. `CLASS`
//! means a class's visible lines, `hidden-CLASS` its hidden ones, `hidden` all hidden lines, `outline` the visible
//! lines with only background on one side, `hatch` the strokes of tones.

use crate::choice::nearest;
use crate::edges::Class;
use crate::error::ParseError;
use crate::lines::drawing::length::Length;
use crate::settings::{Kind, Problem, Setting, Value};
use crate::values::Color;
use std::fmt::Display;
use std::str::FromStr;

/// Lines with the same style, drawn as one layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Strokes that stand for a tone, 0 being the darkest.
    Hatch(u8),
    /// Visible lines of any class with only background on one side.
    Outline,
    /// A class's other visible lines.
    Visible(Class),
    /// A class's hidden lines.
    Hidden(Class),
}

impl Layer {
    pub(in crate::lines) fn of(class: Class, is_visible: bool, is_outline: bool) -> Self {
        match (is_visible, is_outline) {
            (true, true) => Self::Outline,
            (true, false) => Self::Visible(class),
            (false, _) => Self::Hidden(class),
        }
    }

    /// All layers from lowest to highest: strokes of tones at the bottom, then hidden lines, the first class at the top, because
    /// an edge of several classes belongs to the first.
    pub(crate) fn upwards() -> impl Iterator<Item = Self> {
        let classes = || Class::ALL.into_iter().rev().map(|(_, class)| class);
        let hatches = (0..HATCHED_TONES).rev().map(Self::Hatch);
        hatches.chain(classes().map(Self::Hidden)).chain(classes().map(Self::Visible)).chain([Self::Outline])
    }

    /// Whether its lines lie on visible surfaces.
    pub fn is_visible(self) -> bool {
        !matches!(self, Self::Hidden(_))
    }

    /// Its label in programs that show layers, in two words.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Hatch(0) => ["hatch", "0"],
            Self::Hatch(_) => ["hatch", "1"],
            Self::Outline => ["visible", "outline"],
            Self::Visible(class) => ["visible", class.name()],
            Self::Hidden(class) => ["hidden", class.name()],
        }
    }

    /// The names that give the layer a value; the first one with a value counts. An outline is usually silhouette.
    fn names(self) -> [Option<Name>; 2] {
        match self {
            Self::Hatch(_) => [Some(Name::Hatch), None],
            Self::Outline => [Some(Name::Outline), Some(Name::Class(Class::Silhouette))],
            Self::Visible(class) => [Some(Name::Class(class)), None],
            Self::Hidden(class) => [Some(Name::HiddenClass(class)), Some(Name::Hidden)],
        }
    }
}

const CLASSES: usize = Class::ALL.len();

/// Number of names with a value.
const NAMES: usize = 2 * CLASSES + 3;

/// Most tones that have strokes: all but the brightest of three.
const HATCHED_TONES: u8 = 2;

/// A name in the settings of layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Name {
    Class(Class),
    Outline,
    Hidden,
    HiddenClass(Class),
    Hatch,
}

/// The name of all hidden lines, and the prefix of hidden classes.
const HIDDEN_LINES: &str = "hidden";
const HIDDEN: &str = "hidden-";

/// The name of the strokes of all tones.
const HATCH: &str = "hatch";

impl Name {
    /// Its place among all.
    fn index(self) -> usize {
        Self::all().take_while(|name| *name != self).count()
    }

    fn all() -> impl Iterator<Item = Self> {
        let classes = || Class::ALL.into_iter().map(|(_, class)| class);
        let of_hidden = classes().map(Self::HiddenClass);
        classes().map(Self::Class).chain([Self::Outline, Self::Hidden]).chain(of_hidden).chain([Self::Hatch])
    }

    fn text(self) -> String {
        match self {
            Self::Class(class) => class.name().to_owned(),
            Self::Outline => "outline".to_owned(),
            Self::Hidden => HIDDEN_LINES.to_owned(),
            Self::HiddenClass(class) => format!("{HIDDEN}{}", class.name()),
            Self::Hatch => HATCH.to_owned(),
        }
    }
}

impl FromStr for Name {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        match text {
            "outline" => Ok(Self::Outline),
            HIDDEN_LINES => Ok(Self::Hidden),
            HATCH => Ok(Self::Hatch),
            _ => match text.strip_prefix(HIDDEN) {
                Some(class) => Ok(Self::HiddenClass(class.parse()?)),
                None => Ok(Self::Class(text.parse().map_err(|problem: ParseError| {
                    match nearest(text, &["outline", HIDDEN_LINES, HATCH]) {
                        Some(meant) => format!("did you mean {meant}?"),
                        None if problem.to_string().ends_with('?') => problem.to_string(),
                        None => format!("{problem}, outline, hatch, hidden, or hidden- and a class"),
                    }
                })?)),
            },
        }
    }
}

/// A value for some of the names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfLayers<T>([Option<T>; NAMES]);

impl<T> Default for OfLayers<T> {
    fn default() -> Self {
        Self([const { None }; NAMES])
    }
}

impl<T: Copy> OfLayers<T> {
    /// Sets the value of a class's visible lines only.
    pub fn set_class(&mut self, class: Class, value: T) {
        self.0[Name::Class(class).index()] = Some(value);
    }

    /// Sets the outline's value.
    pub fn set_outline(&mut self, value: T) {
        self.0[Name::Outline.index()] = Some(value);
    }

    /// The same value for all visible lines.
    pub(in crate::lines) fn of_visible(value: T) -> Self {
        let mut values = Self::default();
        Class::ALL.into_iter().for_each(|(_, class)| values.set_class(class, value));
        values.set_outline(value);
        values
    }

    /// Only the values that `is_kept` keeps.
    pub(in crate::lines) fn only(self, is_kept: impl Fn(T) -> bool) -> Self {
        Self(self.0.map(|value| value.filter(|value| is_kept(*value))))
    }

    /// Returns a layer's value.
    pub(crate) fn of(&self, layer: Layer) -> Option<T> {
        layer.names().into_iter().flatten().find_map(|name| self.0[name.index()])
    }

    /// Whether the outline has a value and must therefore be found.
    pub(crate) fn tells_outline(&self) -> bool {
        self.0[Name::Outline.index()].is_some()
    }

    /// The first name with a value that is not a class; drawings by GL do not support it.
    pub fn first_beyond_classes(&self) -> Option<String> {
        self.given().map(|(name, _)| name).find(|name| !matches!(name, Name::Class(_))).map(Name::text)
    }

    /// The names with their values.
    fn given(&self) -> impl Iterator<Item = (Name, T)> {
        Name::all().filter_map(|name| Some((name, self.0[name.index()]?)))
    }

    /// The first invalid value, with its name.
    pub(in crate::lines) fn find(&self, mut is_wrong: impl FnMut(T) -> bool) -> Option<(String, T)> {
        self.given().find(|(_, value)| is_wrong(*value)).map(|(name, value)| (name.text(), value))
    }
}

impl<T: Copy + Display> OfLayers<T> {
    /// `NAME=VALUE`, separated by commas.
    fn text(&self) -> String {
        self.given().map(|(name, value)| format!("{}={value}", name.text())).collect::<Vec<_>>().join(",")
    }
}

impl<T: Copy> OfLayers<T> {
    fn parsed(text: &str, usage: &str, value: impl Fn(&str) -> Result<T, ParseError>) -> Result<Self, ParseError> {
        let mut values = Self::default();
        for setting in text.split(',') {
            let (name, text) = setting.split_once('=').ok_or_else(|| usage.to_owned())?;
            values.0[name.trim().parse::<Name>()?.index()] = Some(value(text.trim())?);
        }
        Ok(values)
    }
}

const BLACK: Color = Color([0.0; 3]);

/// Colours of lines. Visible lines without a colour are black.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ClassColors(pub OfLayers<Color>);

impl ClassColors {
    /// Outer lines red, inner ones blue: figure 6 of Evangelista et al. 2005.
    pub fn figure_6() -> Self {
        let is_outer = |class| matches!(class, Class::Boundary | Class::NonManifold | Class::Silhouette);
        let mut colors = OfLayers::default();
        for (_, class) in Class::ALL {
            let color = if is_outer(class) { Color([0.9, 0.05, 0.05]) } else { Color([0.1, 0.2, 0.9]) };
            colors.set_class(class, color);
        }
        Self(colors)
    }

    /// The colour of a class's visible lines.
    pub fn of_class(&self, class: Class) -> Color {
        self.0.of(Layer::Visible(class)).unwrap_or(BLACK)
    }

    /// Returns the colour of a name: a class, `outline`, `hatch`, `hidden`, or `hidden-` and a class.
    ///
    /// # Errors
    ///
    /// The known names, if this one is unknown.
    pub fn named(&self, name: &str) -> Result<Option<Color>, ParseError> {
        Ok(self.0.0[name.parse::<Name>()?.index()])
    }

    /// Sets or removes the colour of a name.
    ///
    /// # Errors
    ///
    /// Those of [`ClassColors::named`].
    pub fn set_named(&mut self, name: &str, color: Option<Color>) -> Result<(), ParseError> {
        self.0.0[name.parse::<Name>()?.index()] = color;
        Ok(())
    }

    /// The kind of a setting of colours: every class, and the given names.
    fn kind_of(more: &[&'static str]) -> Kind {
        let names = Class::ALL.iter().map(|(name, _)| *name).chain(more.iter().copied()).collect();
        let example = "silhouette=red,crease=rgb(1 2.5 3),normal=#010203";
        Kind::Colors { names, offered: &["figure-6", "black"], example }
    }

    /// The setting of a drawing's colours, which include layers as well as classes.
    pub(crate) fn setting_of_drawing<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let mut setting = Self::setting(field);
        setting.kind = Self::kind_of(&["outline", HIDDEN_LINES, HATCH]);
        setting
    }

    /// The setting of the colours of classes.
    pub fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let help = "Colours of the lines by class: CLASS=COLOR, separated by commas, or figure-6 (outer red, inner \
            blue); in vectors also outline, hatch, hidden and hidden-CLASS";
        Setting::field("class-colors", "COLORS", help, field).labelled("class colours")
    }
}

impl Value for ClassColors {
    fn kind() -> Kind {
        Self::kind_of(&[])
    }

    /// `NAME=COLOR` for each name with a colour.
    fn text(&self) -> String {
        if *self == Self::figure_6() {
            return "figure-6".to_owned();
        }
        let text = self.0.text();
        if text.is_empty() { "black".to_owned() } else { text }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for ClassColors {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let usage = "write figure-6, or CLASS=COLOR, separated by commas: silhouette=red,crease=blue";
        match text {
            "figure-6" => Ok(Self::figure_6()),
            "black" => Ok(Self::default()),
            _ => {
                let mut colors = OfLayers::parsed(text, usage, str::parse)?;
                // Black is the default of a class.
                colors.0[..CLASSES].iter_mut().for_each(|color| *color = color.filter(|color| *color != BLACK));
                Ok(Self(colors))
            }
        }
    }
}

/// Widths of lines. Visible lines without a width use the common one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ClassWidths(pub OfLayers<Length>);

/// The text for no widths.
const NONE: &str = "none";

impl Value for ClassWidths {
    fn kind() -> Kind {
        Kind::Text { offered: &[], example: "silhouette=3,crease=0.5mm,hidden-crease=0.25mm" }
    }

    fn text(&self) -> String {
        let text = self.0.text();
        if text.is_empty() { NONE.to_owned() } else { text }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

impl FromStr for ClassWidths {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        let usage = "write CLASS=PIXELS, separated by commas: outline=3,crease=1,hidden=0.5; on paper also 0.35mm";
        match text {
            NONE => Ok(Self::default()),
            _ => OfLayers::parsed(text, usage, |text| text.parse().map_err(|_| usage.to_owned().into())).map(Self),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_of_a_layer_itself_comes_before_what_is_said_of_several() {
        let widths: ClassWidths = "silhouette=3, hidden=0.5,hidden-crease=0.25mm".parse().unwrap();
        let of = |layer| widths.0.of(layer);
        assert_eq!(of(Layer::Visible(Class::Silhouette)), Some(Length::Px(3.0)));
        assert_eq!(of(Layer::Outline), Some(Length::Px(3.0)), "most of an outline is silhouette");
        assert_eq!(of(Layer::Visible(Class::Boundary)), None);
        assert_eq!(of(Layer::Hidden(Class::Boundary)), Some(Length::Px(0.5)));
        assert_eq!(of(Layer::Hidden(Class::Crease)), Some(Length::Mm(0.25)));
        assert!(!widths.0.tells_outline() && "outline=1".parse::<ClassWidths>().unwrap().0.tells_outline());
        for bad in ["crease", "crease=", "crease=wide", "edges=2", "", "hidden-=1", "hidden-outline=1", "visible=1"] {
            assert!(bad.parse::<ClassWidths>().is_err(), "{bad}");
        }
    }

    #[test]
    fn every_name_is_read_and_written() {
        let names: Vec<String> = Name::all().map(Name::text).collect();
        assert_eq!(names.len(), NAMES);
        for (number, name) in names.iter().enumerate() {
            assert_eq!(name.parse::<Name>().unwrap().index(), number);
            let text = format!("{name}=#010203");
            let colors: ClassColors = text.parse().unwrap();
            assert_eq!(Value::text(&colors), text);
            assert_eq!(colors.named(name).unwrap(), Some(Color([1.0 / 255.0, 2.0 / 255.0, 3.0 / 255.0])), "{name}");
            let mut without = colors;
            without.set_named(name, None).unwrap();
            assert_eq!(without, ClassColors::default());
            let beyond = (number >= CLASSES).then(|| name.clone());
            assert_eq!(colors.0.first_beyond_classes(), beyond);
        }
        assert_eq!("crease=black".parse(), Ok(ClassColors::default()));
        assert_eq!(Value::text(&ClassColors::figure_6()), "figure-6");
        assert_eq!(Value::text(&ClassColors::default()), "black");
        assert_eq!(Value::text(&ClassWidths::default()), "none");
    }

    #[test]
    fn strokes_of_tones_lie_below_hidden_layers_and_these_below_visible_ones() {
        let layers: Vec<Layer> = Layer::upwards().collect();
        assert_eq!(layers.len(), 2 * CLASSES + 3);
        assert_eq!(layers[..3], [Layer::Hatch(1), Layer::Hatch(0), Layer::Hidden(Class::Centre)]);
        assert_eq!(layers[2 * CLASSES + 1..], [Layer::Visible(Class::Boundary), Layer::Outline]);
        assert!(layers[2..].iter().position(|layer| layer.is_visible()) == Some(CLASSES));
    }
}
