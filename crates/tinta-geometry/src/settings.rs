//! Settings: their names, kinds, help, and how they are read from and written to a struct.
//!
//! Each setting is declared once, next to its struct: [`crate::scene`] has those of [`crate::SceneSettings`].
//! Everything else is a loop over a [`Table`]: command-line options with their help and defaults, completions, manual
//! pages, presets, recipes, batch jobs, keys of JSON records, the viewer's panel, and the round-trip test of all
//! settings. This module knows none of these uses.
//!
//! Input: the values as the user's texts. Output: structs, and from them the same texts.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::settings::{HasSettings, OptionValue, Options};
//! use tinta_geometry::{SceneSettings, Size};
//!
//! let options: Options = [("size", "640x480"), ("fov", "40")]
//!     .map(|(name, value)| (name.to_owned(), OptionValue::text(value)))
//!     .into();
//! let scene = SceneSettings::from_options(&options)?;
//! assert_eq!(scene.size, Size { width: 640, height: 480 });
//! // Defaults are not written.
//! assert_eq!(scene.to_options()?, options);
//! # Ok(())
//! # }
//! ```

mod kind;
mod mentions;
mod value;

use crate::choice::meant_or;

pub use crate::choice::Choice;
pub use kind::{Kind, ON_OFF, Problem, on_off};
pub use mentions::with_mentions;
pub use value::{Value, names_of};

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::{Debug, Formatter};
use std::ops::RangeInclusive;

/// Options by their long names without dashes, each at most once.
pub type Options = BTreeMap<String, OptionValue>;

/// The value given for an option.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum OptionValue {
    /// `true` or `false`: an option without a value that is given or not, or `on` and `off`.
    Switch(bool),
    /// The value as written on the command line.
    Text(String),
    /// Several values; joined with commas, unless the option may be repeated.
    Texts(Vec<String>),
}

impl OptionValue {
    /// A value given as text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }
}

/// Returns the text of a rule, as options for parts take it: `bolt*: color=red, ghost` for a name, a text and a switch that is
/// on.
pub fn rule_text(name: &str, settings: Vec<(String, OptionValue)>) -> String {
    let setting = |(name, value): (String, OptionValue)| match value {
        OptionValue::Switch(true) => Some(name),
        OptionValue::Switch(false) => None,
        OptionValue::Text(text) => Some(format!("{name}={text}")),
        OptionValue::Texts(texts) => Some(format!("{name}={}", texts.join("+"))),
    };
    format!("{name}: {}", settings.into_iter().filter_map(setting).collect::<Vec<_>>().join(", "))
}

/// Mutually exclusive settings: each with those that it excludes.
pub const EXCLUSIVE: [(&str, &[&str]); 8] = [
    ("eye", &["view"]),
    ("width-mm", &["dpi"]),
    ("page", &["width-mm", "dpi"]),
    ("sheet", &["view", "eye", "target", "up", "height", "framing", "turntable"]),
    ("turntable", &["animate"]),
    ("animate", &["model-frame"]),
    ("full", &["keep", "verify"]),
    ("json", &["explain"]),
];

/// Refuses options that exclude each other.
///
/// # Errors
///
/// [`Error::Settings`] with the names of both.
pub fn refuse_exclusive(options: &Options) -> Result<()> {
    let is_given = |name: &str| options.get(name).is_some_and(|value| *value != OptionValue::Switch(false));
    for (one, others) in EXCLUSIVE.iter().filter(|(one, _)| is_given(one)) {
        if let Some(other) = others.iter().find(|other| is_given(other)) {
            return Err(Error::settings(&[one, other], "they exclude each other; leave one of them out"));
        }
    }
    Ok(())
}

/// Reads a setting; `None` if the struct does not have it.
type Get<T> = Box<dyn Fn(&T) -> Option<String> + Send + Sync>;

/// Writes a setting.
type Set<T> = Box<dyn Fn(&mut T, &str) -> std::result::Result<(), Problem> + Send + Sync>;

/// A setting of a `T`.
pub struct Setting<T> {
    /// Its name: the option without dashes, and the key in presets, jobs and records.
    pub name: &'static str,
    /// The kind of its values.
    pub kind: Kind,
    /// The placeholder for its value in the option's help.
    pub value_name: &'static str,
    /// Its effect on the picture.
    pub help: &'static str,
    /// The default as the help gives it, if the plain text is not clear enough.
    pub said_default: Option<&'static str>,
    /// The heading that lists it.
    pub heading: &'static str,
    /// Whether it is common: short lists show it too.
    pub is_common: bool,
    /// The text for an unset value.
    pub open: Option<&'static str>,
    /// Texts of earlier versions, each with its present equivalent: they are accepted, but never written or offered.
    pub former: &'static [(&'static str, &'static str)],
    /// Whether its option may be given without a value; its text is then empty.
    pub stands_alone: bool,
    /// What joins its values if its option is given several times; `None` if it may not be.
    pub between: Option<&'static str>,
    /// The option of the command line that holds this one: `--page margin=10mm`. `None`: it has its own.
    pub group: Option<&'static str>,
    /// Whether it decides which other settings exist, and is therefore set first.
    is_first: bool,
    label: Option<&'static str>,
    get: Get<T>,
    set: Set<T>,
}

impl<T> Debug for Setting<T> {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Setting").field("name", &self.name).field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl<T: Clone + 'static> Setting<T> {
    /// A setting that is one field.
    pub fn field<V: Value + 'static>(
        name: &'static str,
        value_name: &'static str,
        help: &'static str,
        field: fn(&mut T) -> &mut V,
    ) -> Self {
        let get = move |of: &T| field(&mut of.clone()).text();
        let set = move |of: &mut T, text: &str| {
            *field(of) = V::parse(text)?;
            Ok(())
        };
        Self::of(name, value_name, V::kind(), help, get, set)
    }

    /// A field that may be unset, with a word for that.
    pub fn open_field<V: Value + 'static>(
        name: &'static str,
        value_name: &'static str,
        open: &'static str,
        help: &'static str,
        field: fn(&mut T) -> &mut Option<V>,
    ) -> Self {
        let get = move |of: &T| field(&mut of.clone()).as_ref().map_or(open.to_owned(), V::text);
        let set = move |of: &mut T, text: &str| {
            let parsed = || match V::parse(text) {
                Err(Problem::Text(problem)) if !open.is_empty() => Err(format!("{problem}, or {open}").into()),
                parsed => parsed,
            };
            *field(of) = if text == open { None } else { Some(parsed()?) };
            Ok(())
        };
        let kind = match V::kind() {
            Kind::Choice(names) if !open.is_empty() => Kind::Choice([open].into_iter().chain(names).collect()),
            kind => kind,
        };
        Self { open: Some(open), said_default: Some(open), ..Self::of(name, value_name, kind, help, get, set) }
    }

    /// A field with two values, the one for `false` first.
    pub fn either(
        name: &'static str,
        value_name: &'static str,
        names: [&'static str; 2],
        help: &'static str,
        field: fn(&mut T) -> &mut bool,
    ) -> Self {
        let get = move |of: &T| names[usize::from(*field(&mut of.clone()))].to_owned();
        let set = move |of: &mut T, text: &str| {
            let found = names.iter().position(|name| *name == text);
            *field(of) = found.ok_or_else(|| format!("choose {} or {}", names[0], names[1]))? == 1;
            Ok(())
        };
        Self::of(name, value_name, Kind::Choice(names.to_vec()), help, get, set)
    }

    /// A setting that is on or off; its option takes no value.
    pub fn flag(name: &'static str, help: &'static str, get: fn(&T) -> bool, set: fn(&mut T, bool)) -> Self {
        let get = move |of: &T| on_off(get(of)).to_owned();
        let set = move |of: &mut T, text: &str| {
            set(of, bool::parse(text)?);
            Ok(())
        };
        Self::of(name, "", Kind::Flag, help, get, set)
    }

    /// A setting with functions to read and to set it.
    pub fn of(
        name: &'static str,
        value_name: &'static str,
        kind: Kind,
        help: &'static str,
        get: impl Fn(&T) -> String + Send + Sync + 'static,
        set: impl Fn(&mut T, &str) -> std::result::Result<(), Problem> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name,
            kind,
            value_name,
            help,
            said_default: None,
            heading: "",
            is_common: false,
            open: None,
            former: &[],
            stands_alone: false,
            between: None,
            group: None,
            is_first: false,
            label: None,
            get: Box::new(move |of| Some(get(of))),
            set: Box::new(set),
        }
    }

    /// Sets the range of numbers that a panel offers, and the number of decimals worth showing.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64, decimals: usize) -> Self {
        let count = if let Kind::Numbers { count, .. } = self.kind { count } else { 1 };
        self.kind = Kind::Numbers { count, range: [low, high], decimals };
        self
    }

    /// Sets the texts that a shell and a panel offer.
    #[must_use]
    pub(crate) fn offering(mut self, texts: &[&'static str]) -> Self {
        self.kind = Kind::Choice(texts.to_vec());
        self
    }

    /// Sets the text for an unset value.
    #[must_use]
    pub fn open(mut self, text: &'static str) -> Self {
        self.open = Some(text);
        self
    }

    /// Sets texts of earlier versions, each followed by its present equivalent.
    #[must_use]
    pub fn formerly(mut self, texts: &'static [(&'static str, &'static str)]) -> Self {
        self.former = texts;
        self
    }

    /// Sets the words that the help uses for the default.
    #[must_use]
    pub fn said(mut self, default: &'static str) -> Self {
        self.said_default = Some(default);
        self
    }

    /// Allows its option without a value.
    #[must_use]
    pub fn standing_alone(mut self) -> Self {
        self.stands_alone = true;
        self
    }

    /// Allows its option several times, with the values joined by this text.
    #[must_use]
    pub(crate) fn repeated(mut self, between: &'static str) -> Self {
        self.between = Some(between);
        self
    }

    /// Puts it into another option of the command line.
    #[must_use]
    pub fn inside(mut self, group: &'static str) -> Self {
        self.group = Some(group);
        self
    }

    /// Marks it as a setting that decides which others exist.
    #[must_use]
    pub fn first(mut self) -> Self {
        self.is_first = true;
        self
    }

    /// Refuses values that `check` rejects for this struct.
    #[must_use]
    pub(crate) fn refusing(mut self, check: fn(&T) -> Result<()>) -> Self {
        let set = self.set;
        self.set = Box::new(move |of, text| {
            set(of, text)?;
            Ok(check(of)?)
        });
        self
    }

    /// Accepts only whole numbers within these limits.
    #[must_use]
    pub fn whole(self, limits: RangeInclusive<u32>) -> Self {
        let sentence = format!("give a whole number from {} to {}", limits.start(), limits.end());
        self.accepting(move |text| text.parse().is_ok_and(|number| limits.contains(&number)), sentence)
    }

    /// Accepts only numbers within these limits.
    #[must_use]
    pub fn limits(self, limits: RangeInclusive<f64>) -> Self {
        let sentence = format!("give a number from {} to {}", limits.start(), limits.end());
        self.accepting(move |text| text.parse().is_ok_and(|number| limits.contains(&number)), sentence)
    }

    /// Refuses texts other than these, and other than the word of an open setting, with this sentence.
    fn accepting(mut self, is_right: impl Fn(&str) -> bool + Send + Sync + 'static, sentence: String) -> Self {
        let (set, open) = (self.set, self.open);
        self.set = Box::new(move |of, text| match Some(text) == open || is_right(text.trim()) {
            true => set(of, text),
            false => Err(sentence.clone().into()),
        });
        self
    }

    /// Sets an example text that is not the default, for tests.
    #[must_use]
    pub fn like(mut self, example: &'static str) -> Self {
        self.kind = Kind::Text { offered: &[], example };
        self
    }

    /// Marks it as common: the short help (`-h`) lists it.
    #[must_use]
    pub fn common(mut self) -> Self {
        self.is_common = true;
        self
    }

    /// Sets a panel label that differs from its name.
    #[must_use]
    pub fn labelled(mut self, label: &'static str) -> Self {
        self.label = Some(label);
        self
    }

    /// Its label in a panel.
    pub fn label(&self) -> String {
        self.label.map_or_else(|| self.name.replace('-', " "), str::to_owned)
    }

    /// Returns this setting for a struct that may contain a `T`; without a `T` the struct does not have the setting.
    pub(crate) fn within<S: Clone + 'static>(self, part: fn(&mut S) -> Option<&mut T>) -> Setting<S> {
        let (get, set) = (self.get, self.set);
        Setting {
            name: self.name,
            kind: self.kind,
            value_name: self.value_name,
            help: self.help,
            said_default: self.said_default,
            heading: self.heading,
            is_common: self.is_common,
            open: self.open,
            former: self.former,
            stands_alone: self.stands_alone,
            between: self.between,
            group: self.group,
            is_first: self.is_first,
            label: self.label,
            get: Box::new(move |whole: &S| part(&mut whole.clone()).and_then(|part| get(part))),
            set: Box::new(move |whole: &mut S, text: &str| part(whole).map_or(Ok(()), |part| set(part, text))),
        }
    }

    /// Returns the present text for one of an earlier version; any other text is unchanged.
    pub(crate) fn present<'t>(&self, text: &'t str) -> &'t str {
        self.former.iter().find(|(former, _)| *former == text).map_or(text, |(_, present)| present)
    }

    /// Returns its value as text; `None` if `of` does not have the setting, empty if no text describes the value.
    pub fn value(&self, of: &T) -> Option<String> {
        (self.get)(of)
    }

    /// Sets it; without effect if `of` does not have the setting.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for an invalid text, [`Error::File`] for a file that cannot be read. Values that are
    /// invalid only in combination are refused later, for a style by its plan.
    pub fn set(&self, of: &mut T, text: &str) -> Result<()> {
        if self.value(of).is_none() {
            return Ok(());
        }
        (self.set)(of, self.present(text)).map_err(|problem| match problem {
            Problem::Text(problem) => Error::value(self.name, text, self.said_of(text, problem)),
            Problem::Refused(error) => error,
        })
    }

    /// Returns the message for an invalid text: the nearest known name, or the problem.
    fn said_of(&self, text: &str, problem: String) -> String {
        match &self.kind {
            Kind::Numbers { .. } => problem,
            kind => {
                let names = kind.offered();
                let is_list = matches!(kind, Kind::Several(_));
                let mut words = text.split(|c| is_list && c == ',').map(str::trim);
                let unknown = words.find(|word| !names.contains(word));
                meant_or(unknown.unwrap_or_default(), &names, &problem)
            }
        }
    }

    /// Returns a value as recipes and presets store it, in this version's words.
    ///
    /// # Errors
    ///
    /// What to write instead.
    pub fn kept(&self, value: OptionValue) -> std::result::Result<OptionValue, String> {
        let text = self.text_of(&value)?;
        Ok(match (&self.kind, value) {
            (Kind::Flag, value) => value,
            (_, OptionValue::Switch(is_on)) if self.stands_alone => OptionValue::Switch(is_on),
            _ => OptionValue::Text(self.present(&text).to_owned()),
        })
    }

    /// Returns the text of a given value; the error says what to write instead.
    fn text_of(&self, value: &OptionValue) -> std::result::Result<String, String> {
        match (&self.kind, value) {
            (Kind::Flag, OptionValue::Text(_) | OptionValue::Texts(_)) => {
                Err("write true or false, without quotes".to_owned())
            }
            (_, OptionValue::Text(text)) => Ok(text.clone()),
            (_, OptionValue::Texts(texts)) => Ok(texts.join(self.between.unwrap_or(","))),
            (Kind::Flag | Kind::Switch, OptionValue::Switch(is_on)) => Ok(on_off(*is_on).to_owned()),
            (_, OptionValue::Switch(true)) if self.stands_alone => Ok(String::new()),
            (_, OptionValue::Switch(false)) if self.stands_alone => Ok(self.open.unwrap_or_default().to_owned()),
            (_, OptionValue::Switch(_)) => Err(format!("this takes a value ({}), not true or false", self.value_name)),
        }
    }

    /// Whether it stands for several others.
    pub fn is_recipe(&self) -> bool {
        matches!(self.kind, Kind::Recipe(_))
    }

    /// Its place in the order of setting: recipes come before the settings they contain, flags last.
    fn turn(&self) -> usize {
        match self.kind {
            _ if self.is_first => 0,
            Kind::Recipe(_) => 1,
            Kind::Flag => 3,
            _ => 2,
        }
    }
}

/// Settings listed under this heading.
pub fn under<T>(heading: &'static str, settings: Vec<Setting<T>>) -> impl Iterator<Item = Setting<T>> {
    settings.into_iter().map(move |setting| Setting { heading, ..setting })
}

/// The same settings, for a struct that may contain a `T`.
pub fn within<S: Clone + 'static, T: Clone + 'static>(
    settings: Vec<Setting<T>>,
    part: fn(&mut S) -> Option<&mut T>,
) -> impl Iterator<Item = Setting<S>> {
    settings.into_iter().map(move |setting| setting.within(part))
}

/// All settings of a `T`, which may have several forms with different settings, as styles do. Settings with the same
/// name in different forms are one option.
#[derive(Debug)]
pub struct Table<T> {
    /// The settings, in the order of the help.
    pub settings: Vec<Setting<T>>,
    /// The default of every form.
    pub defaults: Vec<T>,
}

impl<T: Clone + 'static> Table<T> {
    /// The settings of one form, or of all if none is given, each name once.
    pub fn of(&self, form: Option<&T>) -> Vec<&Setting<T>> {
        let is_first = |index: usize, name: &str| self.settings[..index].iter().all(|earlier| earlier.name != name);
        let is_of_it = |(index, setting): &(usize, &Setting<T>)| match form {
            Some(form) => setting.value(form).is_some(),
            None => is_first(*index, setting.name),
        };
        self.settings.iter().enumerate().filter(is_of_it).map(|(_, setting)| setting).collect()
    }

    /// A form's setting with this name.
    pub fn find(&self, form: &T, name: &str) -> Option<&Setting<T>> {
        self.settings.iter().find(|setting| setting.name == name && setting.value(form).is_some())
    }

    /// Whether any form has a setting with this name.
    pub fn has(&self, name: &str) -> bool {
        self.settings.iter().any(|setting| setting.name == name)
    }

    /// The default of a setting in the first form that has it.
    pub fn default_of(&self, setting: &Setting<T>) -> String {
        self.defaults.iter().find_map(|form| setting.value(form)).unwrap_or_default()
    }

    /// Refuses a text that no form accepts for this setting; the error does not name the setting.
    pub fn check(&self, name: &str, text: &str) -> std::result::Result<(), String> {
        let mut first = Ok(());
        for setting in self.settings.iter().filter(|setting| setting.name == name) {
            // The file is read when it is used.
            if setting.kind == Kind::File {
                return if text.is_empty() { Err("name a file".to_owned()) } else { Ok(()) };
            }
            let forms = self.defaults.iter().filter(|form| setting.value(form).is_some());
            for form in forms.take(1) {
                match (setting.set)(&mut form.clone(), setting.present(text)) {
                    Err(Problem::Text(problem)) => first = first.and(Err(setting.said_of(text, problem))),
                    _ => return Ok(()),
                }
            }
        }
        first
    }

    /// Sets all given options; options that this form does not have are ignored.
    ///
    /// # Errors
    ///
    /// Those of [`Setting::set`], and [`Error::Setting`] for `true` or `false` where the setting needs a value.
    pub fn apply(&self, to: &mut T, options: &Options) -> Result<()> {
        let mut given: Vec<_> =
            self.settings.iter().filter_map(|setting| Some((setting, options.get(setting.name)?))).collect();
        given.sort_by_key(|(setting, _)| setting.turn());
        for (setting, value) in given {
            if setting.value(to).is_none() {
                continue;
            }
            let text = setting.text_of(value);
            setting.set(to, &text.map_err(|problem| Error::setting(setting.name, problem))?)?;
        }
        Ok(())
    }

    /// Returns the differences from `default` as options.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a value without a text: a file whose name is not UTF-8, or no class at all.
    pub fn options(&self, of: &T, default: &T) -> Result<Options> {
        let mut options = Options::new();
        for setting in self.of(Some(of)).into_iter().filter(|setting| !setting.is_recipe()) {
            let value = setting.value(of).unwrap_or_default();
            if setting.value(default).as_ref() == Some(&value) {
                continue;
            }
            // A name that is not UTF-8 was read with replacement characters.
            if setting.kind == Kind::File && value.contains(char::REPLACEMENT_CHARACTER) {
                let problem = "this file name is not valid UTF-8 and cannot be saved; rename the file";
                return Err(Error::value(setting.name, value, problem));
            }
            if value.is_empty() {
                let problem = match setting.kind {
                    Kind::File => "it does not come from a file and cannot be saved; keep its default",
                    _ => "nothing is chosen; choose at least one",
                };
                return Err(Error::setting(setting.name, problem));
            }
            let value = match setting.kind {
                Kind::Flag => OptionValue::Switch(value == "on"),
                _ => OptionValue::Text(value),
            };
            options.insert(setting.name.to_owned(), value);
        }
        Ok(options)
    }

    /// Returns every setting of a form with its value as JSON.
    pub fn record(&self, of: &T) -> serde_json::Map<String, serde_json::Value> {
        let settings = self.of(Some(of)).into_iter().filter(|setting| !setting.is_recipe());
        settings.map(|setting| (setting.name.to_owned(), setting.json(of))).collect()
    }
}

/// A struct with a table of settings.
pub trait HasSettings: Clone + Send + Sync + 'static {
    /// All its settings.
    fn table() -> &'static Table<Self>;

    /// Returns the default with the given options set; unknown options are ignored.
    ///
    /// # Errors
    ///
    /// Those of [`Table::apply`].
    fn from_options(options: &Options) -> Result<Self>
    where
        Self: Default,
    {
        let mut made = Self::default();
        Self::table().apply(&mut made, options)?;
        Ok(made)
    }

    /// Returns the differences from the default as options.
    ///
    /// # Errors
    ///
    /// Those of [`Table::options`].
    fn to_options(&self) -> Result<Options>
    where
        Self: Default,
    {
        Self::table().options(self, &Self::default())
    }
}

impl<T: Clone + 'static> Setting<T> {
    /// Returns its value as JSON: numbers as numbers, `null` if unset.
    fn json(&self, of: &T) -> serde_json::Value {
        let text = self.value(of).unwrap_or_default();
        let is_whole = !matches!(self.kind, Kind::Numbers { decimals: 1.., .. });
        let number = |text: &str| {
            let whole = text.parse::<u64>().ok().filter(|_| is_whole).map(Into::into);
            let float = || text.parse().ok().and_then(serde_json::Number::from_f64);
            whole.or_else(float).map(serde_json::Value::Number)
        };
        let plain = |text: &str| number(text).unwrap_or_else(|| text.into());
        match &self.kind {
            _ if self.open == Some(&text) => serde_json::Value::Null,
            Kind::Switch | Kind::Flag => (text == "on").into(),
            Kind::Several(_) if text.is_empty() || text == "none" => serde_json::Value::Array(Vec::new()),
            Kind::Several(_) => text.split(',').map(Into::<serde_json::Value>::into).collect(),
            Kind::Numbers { count, .. } if *count > 1 => text.split(',').map(plain).collect(),
            _ => plain(&text),
        }
    }
}
