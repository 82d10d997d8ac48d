//! Every setting of every style as a dial: its name on the command line, what it can be, how it is read and turned.
//!
//! Values are the texts that the command line takes, so that a dial, a recorded event and a command say the same thing in
//! the same words. A dial that a style has not got has no value there.

mod inking;
mod painting;
mod passes;

use crate::names::find;
use crate::styles::{Charcoal, Style, StyleName};

/// A setting that some styles have.
#[derive(Debug, Clone, Copy)]
pub struct Dial {
    /// Its option on the command line, `--tones`; a name without dashes where the command line has none.
    pub option: &'static str,
    /// Its name in the panel.
    pub label: &'static str,
    /// What turning it does to the picture.
    pub help: &'static str,
    /// What it can be.
    pub kind: Kind,
    read: fn(&mut Style) -> Option<String>,
    turn: fn(&mut Style, &str) -> Result<(), String>,
}

/// What a dial can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Numbers with commas between, each from the first to the last of these; so many decimals are worth showing.
    Numbers {
        /// How many.
        count: usize,
        /// Least and most that the panel offers.
        range: [f64; 2],
        /// Decimals.
        decimals: usize,
    },
    /// One of a few names.
    Choice(&'static [&'static str]),
    /// `on` or `off`.
    Switch,
    /// `on` or `off`, and an option without a value on the command line where it is on.
    Flag,
    /// A text of its own grammar: classes, colours, a file's path.
    Text,
}

impl Kind {
    const fn number(low: f64, high: f64, decimals: usize) -> Self {
        Self::Numbers { count: 1, range: [low, high], decimals }
    }
}

impl Dial {
    /// Its value in a style; `None` for a style without it.
    pub fn value(&self, style: &Style) -> Option<String> {
        (self.read)(&mut style.clone())
    }

    /// Its value in the paper's settings of the same style.
    pub fn default_value(&self, style: &Style) -> Option<String> {
        self.value(&Style::named(name_of(style)))
    }

    /// Whether the style has the paper's value.
    pub fn is_default(&self, style: &Style) -> bool {
        self.value(style) == self.default_value(style)
    }

    /// Sets it.
    ///
    /// # Errors
    ///
    /// A sentence that begins with the option, for a style without it and for values it cannot have. What no value of its
    /// own can tell, the style's plan refuses.
    pub fn set(&self, style: &mut Style, value: &str) -> Result<(), String> {
        if self.value(style).is_none() {
            return Err(format!("{}: the style {} has no such setting", self.option, style.name()));
        }
        (self.turn)(style, value.trim()).map_err(|problem| format!("{} {value}: {problem}", self.option))
    }
}

/// The style's name.
pub fn name_of(style: &Style) -> StyleName {
    match style {
        Style::Phong(_) => StyleName::Phong,
        Style::ThreePass(_) => StyleName::ThreePass,
        Style::TwoPass(_) => StyleName::TwoPass,
        Style::Mrt(_) => StyleName::Mrt,
        Style::Inking(_) => StyleName::Inking,
        Style::Dietrich(_) => StyleName::Dietrich,
        Style::Ink(_) => StyleName::Ink,
        Style::Charcoal(_) => StyleName::Charcoal,
        Style::Sand(_) => StyleName::Sand,
    }
}

/// Whether a style is as its source has it.
pub fn is_faithful(style: &Style) -> bool {
    *style == Style::named(name_of(style))
}

/// All dials.
pub fn all() -> impl Iterator<Item = &'static Dial> {
    passes::DIALS.iter().chain(inking::DIALS).chain(painting::DIALS)
}

/// Those that a style has.
pub fn of(style: &Style) -> impl Iterator<Item = &'static Dial> + '_ {
    all().filter(|dial| dial.value(style).is_some())
}

/// A style's dial of this option; options may mean different things in different styles.
pub fn find_dial(style: &Style, option: &str) -> Result<&'static Dial, String> {
    of(style)
        .find(|dial| dial.option == option)
        .ok_or_else(|| format!("{option}: the style {} has no such setting", style.name()))
}

fn number<T: std::str::FromStr + Into<f64> + Copy>(text: &str) -> Result<T, String> {
    let number = text.trim().parse::<T>().map_err(|_| "give a number".to_owned())?;
    if number.into().is_finite() { Ok(number) } else { Err("give a finite number".to_owned()) }
}

fn numbers<const N: usize>(text: &str) -> Result<[f32; N], String> {
    let numbers: Result<Vec<f32>, String> = text.split(',').map(number).collect();
    numbers?.try_into().map_err(|_| format!("give {N} numbers with commas between them"))
}

fn joined(numbers: &[f32]) -> String {
    numbers.iter().map(f32::to_string).collect::<Vec<_>>().join(",")
}

fn switch(text: &str) -> Result<bool, String> {
    find(&[("on", true), ("off", false)], text)
}

fn on_off(is_on: bool) -> String {
    if is_on { "on" } else { "off" }.to_owned()
}

/// The name of a value in its table of names.
fn name_in<T: PartialEq>(table: &[(&'static str, T)], value: &T) -> Option<String> {
    table.iter().find(|(_, known)| known == value).map(|(name, _)| (*name).to_owned())
}

/// Turns a setting that a style may not have; [`Dial::set`] has made sure that it has.
fn put<T>(place: Option<&mut T>, value: T) -> Result<(), String> {
    if let Some(place) = place {
        *place = value;
    }
    Ok(())
}

fn charcoal(style: &mut Style) -> Option<&mut Charcoal> {
    match style {
        Style::Charcoal(charcoal) | Style::Sand(charcoal) => Some(charcoal),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn styles() -> impl Iterator<Item = Style> {
        StyleName::ALL.into_iter().map(|(_, name)| Style::named(name))
    }

    #[test]
    fn every_dial_belongs_to_a_style_and_every_style_has_dials() {
        for dial in all() {
            assert!(styles().any(|style| dial.value(&style).is_some()), "{} is of no style", dial.option);
        }
        for style in styles() {
            let options: Vec<&str> = of(&style).map(|dial| dial.option).collect();
            assert!(options.len() >= 3, "{}: {options:?}", style.name());
            let different: std::collections::HashSet<_> = options.iter().collect();
            assert_eq!(different.len(), options.len(), "{}: {options:?}", style.name());
        }
    }

    #[test]
    fn setting_a_dial_to_its_own_value_changes_nothing() {
        let mut count = 0;
        for style in styles() {
            for dial in of(&style) {
                let mut again = style.clone();
                let value = dial.value(&style).unwrap();
                dial.set(&mut again, &value).unwrap_or_else(|problem| panic!("{problem}"));
                assert_eq!(again, style, "{} of {}", dial.option, style.name());
                count += 1;
            }
        }
        assert!(count > 80, "{count}");
    }

    #[test]
    fn every_dial_turns_and_goes_back() {
        for style in styles() {
            for dial in of(&style) {
                let default = dial.value(&style).unwrap();
                let other = match dial.kind {
                    Kind::Numbers { count, range: [low, high], decimals } => {
                        let value = |share: f64| (low + (high - low) * share).round_to(decimals);
                        let text = |share| vec![value(share); count].join(",");
                        if text(0.4) == default { text(0.7) } else { text(0.4) }
                    }
                    Kind::Choice(names) => names.iter().find(|name| **name != default).unwrap().to_string(),
                    Kind::Switch | Kind::Flag => on_off(default == "off"),
                    Kind::Text => continue,
                };
                let mut turned = style.clone();
                dial.set(&mut turned, &other).unwrap_or_else(|problem| panic!("{problem}"));
                assert!(!is_faithful(&turned) && !dial.is_default(&turned), "{} {other}", dial.option);
                assert_eq!(dial.value(&turned).unwrap(), other, "{}", dial.option);
                dial.set(&mut turned, &default).unwrap();
                assert!(is_faithful(&turned), "{} of {}", dial.option, style.name());
            }
        }
    }

    trait RoundTo {
        fn round_to(self, decimals: usize) -> String;
    }

    impl RoundTo for f64 {
        fn round_to(self, decimals: usize) -> String {
            format!("{}", format!("{self:.decimals$}").parse::<f64>().unwrap())
        }
    }

    #[test]
    fn nonsense_is_refused_in_a_sentence_that_names_the_option() {
        for style in styles() {
            for dial in of(&style).filter(|dial| dial.kind != Kind::Text) {
                for nonsense in ["", "much", "NaN", "inf", "1,2,3,4,5,6"] {
                    let problem = dial.set(&mut style.clone(), nonsense).unwrap_err();
                    assert!(problem.starts_with(dial.option), "{problem}");
                }
            }
        }
        let mut phong = Style::named(StyleName::Phong);
        assert!(find_dial(&phong, "--tones").is_err());
        let tones = find_dial(&Style::named(StyleName::ThreePass), "--tones").unwrap();
        assert!(tones.set(&mut phong, "2").unwrap_err().contains("phong has no such setting"));
    }
}
