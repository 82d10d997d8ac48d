//! The settings of a request as controls: the panel's selection, and how they are read and set.
//!
//! Values are the texts that the command line takes: a control, a recorded event and a command use the same words. The settings
//! are declared in the request's table; this file chooses those of a window.

use crate::error::Result;
use crate::preset::LOOKS;
use crate::request::Request;
use crate::scene::SceneSettings;
use crate::settings::{HasSettings, Kind, Options, Setting};
use crate::styles::{Style, StyleName};
use crate::window::values::line_style::LINE_SETTINGS;

/// The settings of the scene that a window shows and sets: the others are the models' or the mouse's.
pub(crate) const SCENE_SETTINGS: [&str; 8] =
    ["view", "fov", "parallel", "framing", "background", "color", "bare-color", "surface"];

/// The settings for reading models that a window offers; the others are for untrusted files.
const LOAD_SETTINGS: [&str; 7] = ["up-axis", "normals", "smooth-angle", "reach", "weld", "model-frame", "skin"];

/// What settings are about.
#[derive(Clone, Copy)]
pub(in crate::window) enum Group {
    /// The style.
    Style,
    /// The scene.
    Scene,
    /// The reading of models.
    Models,
}

impl Group {
    /// The settings that a window has of it.
    fn settings(self, of: &Request) -> impl Iterator<Item = &'static Setting<Request>> {
        let draws_lines = of.style.style_name().draws_lines();
        let has = move |name: &str| match self {
            Self::Style if draws_lines => LINE_SETTINGS.contains(&name),
            Self::Style => Style::table().find(&of.style, name).is_some(),
            Self::Scene => SCENE_SETTINGS.contains(&name),
            Self::Models => LOAD_SETTINGS.contains(&name),
        };
        let settings = Request::table().settings.iter();
        settings.filter(move |setting| has(setting.name) && setting.value(of).is_some())
    }

    /// The controls of it: all settings but those that have one value only, or stand for several others.
    pub(in crate::window) fn controls(self, of: &Request) -> Vec<Control> {
        let published = published(of);
        let turns = |setting: &&Setting<Request>| match &setting.kind {
            Kind::Choice(names) => names.len() > 1,
            Kind::Recipe(_) => false,
            _ => true,
        };
        let text = |setting: &Setting<Request>, of| setting.value(of).unwrap_or_default();
        let control = |setting| Control { setting, value: text(setting, of), default: text(setting, &published) };
        self.settings(of).filter(turns).map(control).collect()
    }
}

/// The request's style with its source's settings, and all else at its default.
fn published(of: &Request) -> Request {
    Request::of_style(of.style.style_name())
}

/// Gives a request this style, and the options that make it.
pub(in crate::window) fn put_style(request: &mut Request, style: Style) {
    request.options.retain(|name, _| Style::table().find(&style, name).is_none());
    // A style that no text describes is drawn and not remembered.
    request.options.extend(style.to_options().unwrap_or_default());
    request.style = style;
}

/// The request in another style with the options that it has; as published if it does not accept them.
pub(in crate::window) fn in_style(request: &Request, name: StyleName) -> Request {
    request.in_style(name).unwrap_or_else(|_| Request { style: Style::named(name), ..request.clone() })
}

/// Sets what looks say of a scene back to the defaults.
pub(in crate::window) fn forget_looks(scene: &mut SceneSettings) -> Result<()> {
    let table = SceneSettings::table();
    for look in LOOKS {
        for name in of_scene_in(&look.preset()?.options).keys() {
            if let Some(setting) = table.find(scene, name) {
                setting.set(scene, &table.default_of(setting))?;
            }
        }
    }
    Ok(())
}

/// A colour to begin with.
const WHITE: &str = "#ffffff";

/// A setting as a panel shows it.
pub(in crate::window) struct Control {
    /// The setting.
    pub setting: &'static Setting<Request>,
    /// Its value.
    pub value: String,
    /// Its value as published.
    pub default: String,
}

impl Control {
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

/// Sets an option of a request, or sets it back to its published value.
///
/// # Errors
///
/// A sentence that begins with the option, for one that a window does not have and for invalid values. The style's plan refuses
/// invalid combinations.
pub(in crate::window) fn set(
    request: &mut Request,
    group: Group,
    option: &str,
    value: Option<&str>,
) -> std::result::Result<(), String> {
    // Recordings of earlier versions name options that the command line did not have without dashes.
    let name = option.trim_start_matches("--");
    let has = || group.settings(request).map(|setting| setting.name).collect::<Vec<_>>().join(", ");
    let setting = group.settings(request).find(|setting| setting.name == name).ok_or_else(|| match group {
        Group::Style => format!("{option}: the style {} has no such setting", request.style.name()),
        Group::Scene => format!("{option}: the window has no such setting; it has {}", has()),
        Group::Models => format!("{option}: the window has no such setting of models; it has {}", has()),
    })?;
    let value = value.map(|value| value.trim().to_owned());
    let value = value.or_else(|| setting.value(&published(request))).unwrap_or_default();
    if let Kind::Numbers { .. } = setting.kind
        && value.split(',').any(|number| number.trim().parse().is_ok_and(|number: f64| !number.is_finite()))
    {
        return Err(format!("{option} {value}: give a finite number"));
    }
    setting.set(request, &value).map_err(|error| error.with_dashes())?;
    put_style(request, request.style.clone());
    Ok(())
}

/// Those of the options that say something of the scene that a window can set.
pub(in crate::window) fn of_scene_in(options: &Options) -> Options {
    let is_one = |name: &str| SCENE_SETTINGS.contains(&name);
    options.iter().filter(|(name, _)| is_one(name)).map(|(name, value)| (name.clone(), value.clone())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn styles() -> impl Iterator<Item = Request> {
        StyleName::ALL.into_iter().map(|(_, name)| Request::of_style(name))
    }

    #[test]
    fn every_style_has_controls_and_none_twice() {
        for request in styles() {
            let options: Vec<String> = Group::Style.controls(&request).iter().map(Control::option).collect();
            assert!(options.len() >= 2, "{}: {options:?}", request.style.name());
            let different: std::collections::HashSet<_> = options.iter().collect();
            assert_eq!(different.len(), options.len(), "{}: {options:?}", request.style.name());
        }
    }

    #[test]
    fn every_dial_turns_and_goes_back() {
        let mut count = 0;
        for request in styles() {
            let published = &request.style;
            for control in Group::Style.controls(&request) {
                let option = control.option();
                let mut turned = request.clone();
                set(&mut turned, Group::Style, &option, Some(&control.value)).unwrap();
                assert_eq!(turned.style, *published, "{option} of {}", published.name());
                for other in
                    control.setting.kind.samples(&control.value).iter().filter(|sample| **sample != control.value)
                {
                    set(&mut turned, Group::Style, &option, Some(other)).unwrap_or_else(|problem| panic!("{problem}"));
                    assert!(turned.style != *published, "{option} {other}");
                    let again = turned.in_style(published.style_name()).unwrap();
                    assert_eq!(again.style, turned.style, "its options make it: {option} {other}");
                    set(&mut turned, Group::Style, &option, None).unwrap();
                    assert_eq!(turned.style, *published, "{option} of {}", published.name());
                    count += 1;
                }
            }
        }
        assert!(count > 200, "{count}");
    }

    #[test]
    fn of_exact_lines_a_window_has_no_settings_of_paper() {
        let mut request = Request::of_style(StyleName::Lines);
        assert_eq!(Group::Style.controls(&request).len(), LINE_SETTINGS.len());
        let problem = set(&mut request, Group::Style, "--dpi", Some("300")).unwrap_err();
        assert_eq!(problem, "--dpi: the style lines has no such setting");
    }

    #[test]
    fn a_control_is_found_by_words_of_its_name_and_its_help_and_by_no_others() {
        let found = |words: &str| {
            let controls = Group::Scene.controls(&Request::default());
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
        let mut request = Request::default();
        let controls = Group::Scene.controls(&request);
        let control = controls.into_iter().find(|control| control.setting.name == "color").unwrap();
        assert_eq!((control.value.as_str(), &control.setting.kind), ("own", &Kind::Color));
        set(&mut request, Group::Scene, "--color", Some(&control.given())).unwrap();
        assert_eq!(control.setting.value(&request).as_deref(), Some(WHITE));
        set(&mut request, Group::Scene, "--color", None).unwrap();
        assert_eq!(request.scene, SceneSettings::default());
    }

    #[test]
    fn what_can_be_left_open_is_given_numbers_and_left_open_again() {
        for mut request in styles() {
            for control in Group::Style.controls(&request) {
                let (Some(open), Kind::Numbers { .. }) = (control.setting.open, &control.setting.kind) else {
                    continue;
                };
                let option = control.option();
                set(&mut request, Group::Style, &option, Some(&control.given())).unwrap();
                assert_ne!(control.setting.value(&request).as_deref(), Some(open), "{option}");
                set(&mut request, Group::Style, &option, Some(open)).unwrap();
                assert_eq!(control.setting.value(&request).as_deref(), Some(open), "{option}");
            }
        }
    }

    #[test]
    fn nonsense_is_refused_in_a_sentence_that_names_the_option() {
        for request in styles() {
            for control in Group::Style.controls(&request).iter().filter(|control| control.setting.kind != Kind::File) {
                for nonsense in ["", "much?", "NaN", "inf", "1,2,3,4,5,6"] {
                    let option = control.option();
                    let problem = set(&mut request.clone(), Group::Style, &option, Some(nonsense)).unwrap_err();
                    assert!(problem.starts_with(&option), "{problem}");
                }
            }
        }
        let tones = |style, option: &str| set(&mut Request::of_style(style), Group::Style, option, Some("2"));
        let problem = tones(StyleName::Phong, "--tones").unwrap_err();
        assert_eq!(problem, "--tones: the style phong has no such setting");
        assert!(tones(StyleName::Ink, "least-gap").is_ok(), "as older recordings name it");
    }
}
