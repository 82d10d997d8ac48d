//! The settings of the styles as controls: the panel's selection, and how they are read and set.
//!
//! Values are the texts that the command line takes: a control, a recorded event and a command use the same words. The settings
//! are declared with the styles; this file lists none.

use crate::error::Result;
use crate::mesh::LoadOptions;
use crate::preset::{LOOKS, Look};
use crate::request::{OptionLayer, Request};
use crate::scene::SceneSettings;
use crate::settings::{HasSettings, Kind, Options, Setting, Table};
use crate::styles::{Style, StyleName};
use crate::window::values::line_style::LINE_SETTINGS;

/// The settings of the scene that a window shows and sets: the others are the models' or the mouse's.
pub(crate) const SCENE_SETTINGS: [&str; 8] =
    ["view", "fov", "parallel", "framing", "background", "color", "bare-color", "surface"];

/// The settings for reading models that a window offers; the others are for untrusted files.
const LOAD_SETTINGS: [&str; 7] = ["up-axis", "normals", "smooth-angle", "reach", "weld", "model-frame", "skin"];

/// The same style with its source's settings.
fn published(style: &Style) -> Style {
    Style::named(style.style_name())
}

/// The controls of a style: all of its settings but those that have one value only, or stand for several others.
pub(in crate::window) fn of(style: &Style) -> Vec<Control<Style>> {
    let all = of_table(Style::table(), style, &published(style));
    all.into_iter().filter(|control| is_shown(style, control.setting.name)).collect()
}

/// Whether a window has this setting of a style.
fn is_shown(style: &Style, name: &str) -> bool {
    !style.style_name().draws_lines() || LINE_SETTINGS.contains(&name)
}

/// The controls of the scene.
pub(in crate::window) fn of_scene(scene: &SceneSettings) -> Vec<Control<SceneSettings>> {
    let all = of_table(SceneSettings::table(), scene, &SceneSettings::default());
    all.into_iter().filter(|control| SCENE_SETTINGS.contains(&control.setting.name)).collect()
}

/// The controls of how models are read.
pub(in crate::window) fn of_load(load: &LoadOptions) -> Vec<Control<LoadOptions>> {
    let all = of_table(LoadOptions::table(), load, &LoadOptions::default());
    all.into_iter().filter(|control| LOAD_SETTINGS.contains(&control.setting.name)).collect()
}

/// Another style with a look's settings; as published if it does not accept them.
pub(in crate::window) fn sibling(look: Look, name: StyleName) -> Style {
    let options = look.preset().map(|preset| preset.options);
    options.and_then(|options| Style::with_options(name, &options)).unwrap_or_else(|_| Style::named(name))
}

/// The look whose sibling a style is; the published one if it has only its own settings.
pub(in crate::window) fn look_of_sibling(style: &Style) -> Option<Look> {
    let is_of = |look: &Look| sibling(*look, style.style_name()) == *style;
    // A style that a look does not mention is as published.
    LOOKS.into_iter().rev().find(is_of)
}

/// Returns the style, the exact lines over its picture, and the scene that a look or a preset makes of these; a layer without a
/// style keeps the drawn one.
///
/// # Errors
///
/// As [`Request::from_layers`].
pub(in crate::window) fn of_layer(
    layer: OptionLayer,
    drawn: StyleName,
    mut scene: SceneSettings,
) -> Result<(Style, Option<Style>, SceneSettings)> {
    let table = SceneSettings::table();
    if let OptionLayer::Look(_) = layer {
        // Settings of another look return to their defaults.
        for other in LOOKS {
            for name in of_scene_in(&other.preset()?.options).keys() {
                if let Some(setting) = table.find(&scene, name) {
                    setting.set(&mut scene, &table.default_of(setting))?;
                }
            }
        }
    }
    let (request, _) = Request::from_layers(&[OptionLayer::Style(drawn), layer])?;
    table.apply(&mut scene, &of_scene_in(&request.options)).map_err(|error| request.attributed(error))?;
    let has_lines_over = request.contents(false)?.lines_over().is_some();
    let lines = has_lines_over.then(|| request.in_style(StyleName::Lines)).transpose()?;
    Ok((request.style, lines.map(|request| request.style), scene))
}

/// The same for settings of any table.
fn of_table<T: Clone + 'static>(table: &'static Table<T>, of: &T, published: &T) -> Vec<Control<T>> {
    let turns = |kind: &Kind| match kind {
        Kind::Choice(names) => names.len() > 1,
        Kind::Recipe(_) => false,
        _ => true,
    };
    let control = |setting: &'static Setting<T>| {
        let (value, default) = (setting.value(of)?, setting.value(published).unwrap_or_default());
        Some(Control { setting, value, default })
    };
    table.of(Some(of)).into_iter().filter(|setting| turns(&setting.kind)).filter_map(control).collect()
}

/// A colour to begin with.
const WHITE: &str = "#ffffff";

/// A setting as a panel shows it.
pub(in crate::window) struct Control<T: 'static> {
    /// The setting.
    pub setting: &'static Setting<T>,
    /// Its value.
    pub value: String,
    /// Its value as published.
    pub default: String,
}

impl<T: Clone + 'static> Control<T> {
    /// Its option, as events and the command line have it.
    pub(in crate::window) fn option(&self) -> String {
        format!("--{}", self.setting.name)
    }

    /// The first value after leaving the open state: the default if it has one, else the range's upper ends, or white.
    pub(in crate::window) fn given(&self) -> String {
        match self.setting.kind {
            Kind::Numbers { count, range: [_, high], .. } if self.setting.open == Some(&*self.default) => {
                vec![high.to_string(); count].join(",")
            }
            Kind::Color if self.setting.open == Some(&*self.default) => WHITE.to_owned(),
            _ => self.default.clone(),
        }
    }

    /// Whether its name or its help has all of these words in it.
    pub(in crate::window) fn is_found_by(&self, words: &str) -> bool {
        let text = format!("{} {} {}", self.setting.name, self.setting.label(), self.setting.help).to_lowercase();
        words.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }

    /// Whether it is as published.
    pub(in crate::window) fn is_default(&self) -> bool {
        self.value == self.default
    }
}

/// Sets a style's control; options may mean different things in different styles.
///
/// # Errors
///
/// Returns a sentence that begins with the option, for a style without it and for invalid values. The style's plan refuses
/// invalid combinations.
pub(in crate::window) fn turn(style: &mut Style, option: &str, value: &str) -> std::result::Result<(), String> {
    let setting = find(style, option)?;
    set(setting, style, option, value)
}

/// The window's settings other than those of styles.
pub(in crate::window) struct Group {
    /// The owner of the settings, for the error about an unknown one.
    what: &'static str,
    names: &'static [&'static str],
}

/// Those of the scene, and of reading models.
pub(in crate::window) const SCENE: Group = Group { what: "", names: &SCENE_SETTINGS };
pub(in crate::window) const LOAD: Group = Group { what: " of models", names: &LOAD_SETTINGS };

/// Sets a control of a group.
///
/// # Errors
///
/// A sentence that begins with the option, for one that a window does not have and for values it cannot have.
pub(in crate::window) fn turn_in<T: HasSettings>(
    group: &Group,
    of: &mut T,
    option: &str,
    value: &str,
) -> std::result::Result<(), String> {
    set(find_in(group, option)?, of, option, value)
}

/// Sets it back to its default.
///
/// # Errors
///
/// Those of [`turn_in`].
pub(in crate::window) fn turn_back_in<T: HasSettings>(
    group: &Group,
    of: &mut T,
    option: &str,
) -> std::result::Result<(), String> {
    let setting: &Setting<T> = find_in(group, option)?;
    turned(setting.set(of, &T::table().default_of(setting)))
}

fn find_in<T: HasSettings>(group: &Group, option: &str) -> std::result::Result<&'static Setting<T>, String> {
    let name = option.trim_start_matches("--");
    let setting = T::table().settings.iter().find(|setting| setting.name == name);
    setting.filter(|setting| group.names.contains(&setting.name)).ok_or_else(|| {
        format!("{option}: the window has no such setting{}; it has {}", group.what, group.names.join(", "))
    })
}

/// Those of the options that say something of the scene that a window can set.
pub(in crate::window) fn of_scene_in(options: &Options) -> Options {
    let is_one = |name: &str| SCENE_SETTINGS.contains(&name);
    options.iter().filter(|(name, _)| is_one(name)).map(|(name, value)| (name.clone(), value.clone())).collect()
}

fn set<T: Clone + 'static>(
    setting: &Setting<T>,
    of: &mut T,
    option: &str,
    value: &str,
) -> std::result::Result<(), String> {
    let value = value.trim();
    if let Kind::Numbers { .. } = setting.kind
        && value.split(',').any(|number| number.trim().parse().is_ok_and(|number: f64| !number.is_finite()))
    {
        return Err(format!("{option} {value}: give a finite number"));
    }
    turned(setting.set(of, value))
}

/// Restores the published value.
///
/// # Errors
///
/// Those of [`turn`].
pub(in crate::window) fn turn_back(style: &mut Style, option: &str) -> std::result::Result<(), String> {
    let setting = find(style, option)?;
    let default = setting.value(&published(style)).unwrap_or_default();
    turned(setting.set(style, &default))
}

fn turned(result: Result<()>) -> std::result::Result<(), String> {
    result.map_err(|error| error.with_dashes())
}

/// Recordings of earlier versions name options that the command line did not have without dashes.
fn find(style: &Style, option: &str) -> std::result::Result<&'static Setting<Style>, String> {
    let name = option.trim_start_matches("--");
    let setting = Style::table().find(style, name).filter(|_| is_shown(style, name));
    setting.ok_or_else(|| format!("{option}: the style {} has no such setting", style.name()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_faithful(style: &Style) -> bool {
        *style == published(style)
    }

    fn styles() -> impl Iterator<Item = Style> {
        StyleName::ALL.into_iter().map(|(_, name)| Style::named(name))
    }

    #[test]
    fn every_style_has_controls_and_none_twice() {
        for style in styles() {
            let options: Vec<String> = of(&style).iter().map(Control::option).collect();
            assert!(options.len() >= 3, "{}: {options:?}", style.name());
            let different: std::collections::HashSet<_> = options.iter().collect();
            assert_eq!(different.len(), options.len(), "{}: {options:?}", style.name());
        }
    }

    #[test]
    fn every_dial_turns_and_goes_back() {
        let mut count = 0;
        for style in styles() {
            for control in of(&style) {
                let mut turned = style.clone();
                turn(&mut turned, &control.option(), &control.value).unwrap();
                assert_eq!(turned, style, "{} of {}", control.option(), style.name());
                for other in
                    control.setting.kind.samples(&control.value).iter().filter(|sample| **sample != control.value)
                {
                    turn(&mut turned, &control.option(), other).unwrap_or_else(|problem| panic!("{problem}"));
                    assert!(!is_faithful(&turned), "{} {other}", control.option());
                    turn_back(&mut turned, &control.option()).unwrap();
                    assert!(is_faithful(&turned), "{} of {}", control.option(), style.name());
                    count += 1;
                }
            }
        }
        assert!(count > 200, "{count}");
    }

    #[test]
    fn of_exact_lines_a_window_has_no_settings_of_paper() {
        let mut style = Style::named(StyleName::Lines);
        assert_eq!(of(&style).len(), LINE_SETTINGS.len());
        assert_eq!(turn(&mut style, "--dpi", "300").unwrap_err(), "--dpi: the style lines has no such setting");
    }

    #[test]
    fn a_control_is_found_by_words_of_its_name_and_its_help_and_by_no_others() {
        let found = |words: &str| {
            let scene = SceneSettings::default();
            let controls = of_scene(&scene);
            let found = controls.iter().filter(|control| control.is_found_by(words));
            found.map(|control| control.setting.name).collect::<Vec<_>>()
        };
        assert_eq!(found("").len(), SCENE_SETTINGS.len());
        assert_eq!(found("bare color"), ["bare-color"]);
        assert_eq!(found("TEXTURES vertex"), ["surface"], "words of its help, in either case");
        assert_eq!(found("parallel projection"), ["parallel"]);
        assert_eq!(found("zebra"), [""; 0]);
    }

    #[test]
    fn a_colour_that_is_the_models_own_can_be_given_and_taken_back() {
        let mut scene = SceneSettings::default();
        let control = of_scene(&scene).into_iter().find(|control| control.setting.name == "color").unwrap();
        assert_eq!((control.value.as_str(), &control.setting.kind), ("own", &Kind::Color));
        turn_in(&SCENE, &mut scene, "--color", &control.given()).unwrap();
        assert_eq!(control.setting.value(&scene).as_deref(), Some(WHITE));
        turn_back_in(&SCENE, &mut scene, "--color").unwrap();
        assert_eq!(scene, SceneSettings::default());
    }

    #[test]
    fn what_can_be_left_open_is_given_numbers_and_left_open_again() {
        for mut style in styles() {
            for control in of(&style) {
                let (Some(open), Kind::Numbers { .. }) = (control.setting.open, &control.setting.kind) else {
                    continue;
                };
                turn(&mut style, &control.option(), &control.given()).unwrap();
                assert_ne!(control.setting.value(&style).as_deref(), Some(open), "{}", control.option());
                turn(&mut style, &control.option(), open).unwrap();
                assert_eq!(control.setting.value(&style).as_deref(), Some(open), "{}", control.option());
            }
        }
    }

    #[test]
    fn a_setting_is_a_dial_wherever_it_is_declared() {
        let table: &'static Table<f32> = Box::leak(Box::new(Table {
            settings: vec![
                Setting::field("grain-size", "PIXELS", "How large grains are; more is coarser", |grain: &mut f32| {
                    grain
                })
                .range(1.0, 9.0, 1),
            ],
            defaults: vec![2.0],
        }));
        let controls = of_table(table, &3.5, &2.0);
        let [control] = &controls[..] else { panic!("one control") };
        assert_eq!((control.option().as_str(), control.setting.label().as_str()), ("--grain-size", "grain size"));
        assert_eq!((control.value.as_str(), control.default.as_str(), control.is_default()), ("3.5", "2", false));
    }

    #[test]
    fn nonsense_is_refused_in_a_sentence_that_names_the_option() {
        for style in styles() {
            for control in of(&style).iter().filter(|control| control.setting.kind != Kind::File) {
                for nonsense in ["", "much?", "NaN", "inf", "1,2,3,4,5,6"] {
                    let problem = turn(&mut style.clone(), &control.option(), nonsense).unwrap_err();
                    assert!(problem.starts_with(&control.option()), "{problem}");
                }
            }
        }
        let problem = turn(&mut Style::named(StyleName::Phong), "--tones", "2").unwrap_err();
        assert_eq!(problem, "--tones: the style phong has no such setting");
        assert!(turn(&mut Style::named(StyleName::Ink), "least-gap", "2").is_ok(), "as older recordings name it");
    }
}
