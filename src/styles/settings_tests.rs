//! Tables of settings, and the values in them.

use super::{Charcoal, CharcoalRecipe, Inking, Ramp, Style, StyleName, TextureSource};
use crate::camera::CameraSettings;
use crate::edges::ClassSet;
use crate::lines::{DrawingSettings, LineSettings};
use crate::mesh::LoadOptions;
use crate::scene::SceneSettings;
use crate::settings::*;
use std::fmt::Debug;
use std::sync::Arc;

/// Sets every setting of every form to each of its samples, writes it and asserts that it reads back equal.
fn there_and_back<T: HasSettings + Debug>(record: fn(&T) -> String) -> usize {
    let table = T::table();
    let mut count = 0;
    for default in &table.defaults {
        let names: Vec<&str> = table.of(Some(default)).iter().map(|setting| setting.name).collect();
        let different: std::collections::HashSet<_> = names.iter().collect();
        assert_eq!(different.len(), names.len(), "{names:?}");
        for setting in table.of(Some(default)) {
            let text = setting.value(default).unwrap();
            let mut same = default.clone();
            setting.set(&mut same, &text).unwrap();
            assert_eq!(record(&same), record(default), "{} {text}", setting.name);
            assert!(setting.help.len() > 10 && !setting.help.contains("[default"), "{}", setting.name);
            for sample in setting.kind.samples(&text) {
                let mut changed = default.clone();
                setting.set(&mut changed, &sample).unwrap_or_else(|error| panic!("{error}"));
                let options = table.options(&changed, default).unwrap_or_else(|error| panic!("{sample}: {error}"));
                let mut again = default.clone();
                table.apply(&mut again, &options).unwrap();
                assert_eq!(record(&again), record(&changed), "{} {sample}: {options:?}", setting.name);
                assert_eq!(format!("{again:?}"), format!("{changed:?}"), "{} {sample}", setting.name);
                if !setting.is_recipe() && setting.value(&changed).as_ref() != Some(&text) {
                    assert!(options.contains_key(setting.name), "{} {sample}: {options:?}", setting.name);
                }
                assert_eq!(table.check(setting.name, &sample), Ok(()), "{}", setting.name);
                count += 1;
            }
        }
        assert!(table.options(default, default).unwrap().is_empty());
    }
    count
}

fn json<T: HasSettings>(of: &T) -> String {
    serde_json::to_string(&T::table().record(of)).unwrap()
}

#[test]
fn every_setting_goes_there_and_back() {
    let counts = [
        there_and_back::<Style>(json),
        there_and_back::<SceneSettings>(json),
        there_and_back::<LoadOptions>(json),
        there_and_back::<LineSettings>(json),
        there_and_back::<DrawingSettings>(json),
    ];
    assert!(counts.iter().sum::<usize>() > 350, "{counts:?}");
}

fn options(given: &[(&str, &str)]) -> Options {
    given.iter().map(|(name, value)| ((*name).to_owned(), OptionValue::text(*value))).collect()
}

#[test]
fn a_style_is_what_its_options_say() {
    let style = Style::from_options(&options(&[("style", "charcoal"), ("charcoal", "darker"), ("seed", "7")])).unwrap();
    let darker = Charcoal { seed: 7, ..Charcoal::recipe(CharcoalRecipe::Darker) };
    assert_eq!(style, Style::Charcoal(darker));
    // A recipe holds the style's options.
    let written = style.to_options().unwrap();
    assert_eq!(written["density"], OptionValue::text("85"));
    assert!(!written.contains_key("charcoal"));
    assert_eq!(Style::from_options(&written).unwrap(), style);
    // Options beside a recipe override it, whatever its name.
    let beside = options(&[("charcoal", "darker"), ("density", "50")]);
    let Style::Sand(sand) = Style::with_options(StyleName::Sand, &beside).unwrap() else { panic!("sand") };
    assert_eq!((sand.density_percent, sand.smudge), (50.0, true));
    assert_eq!(Style::from_options(&Options::new()).unwrap(), Style::named(StyleName::ThreePass));
    for (name, style) in StyleName::ALL {
        assert_eq!(Style::named(style).to_options().unwrap(), options(&[("style", name)]));
    }
}

#[test]
fn what_is_no_value_is_refused_by_the_settings_name() {
    let refused = |name: &str, value: &str| {
        Style::with_options(StyleName::ThreePass, &options(&[(name, value)])).unwrap_err().to_string()
    };
    assert_eq!(refused("tones", "many"), "tones many: give a whole number from 0 to 255");
    assert!(refused("filter", "sharp").starts_with("filter sharp: choose one of laplacian4, "));
    assert!(refused("tone-levels", "1,2").starts_with("tone-levels 1,2: give 3 numbers"));
    let switch = |name: &str, value| {
        let options = Options::from([(name.to_owned(), OptionValue::Switch(value))]);
        Style::with_options(StyleName::ThreePass, &options)
    };
    assert!(switch("tones", true).unwrap_err().to_string().contains("tones: this takes a value (N), not true"));
    assert_eq!(
        switch("slope-threshold", true).unwrap().to_options().unwrap()["slope-threshold"],
        OptionValue::text("on")
    );
    assert_eq!(switch("no-borders", true).unwrap().to_options().unwrap()["no-borders"], OptionValue::Switch(true));
    let flag = Style::with_options(StyleName::ThreePass, &options(&[("no-borders", "on")]));
    assert!(flag.unwrap_err().to_string().contains("write true or false"));
    let mrt = Style::with_options(StyleName::Mrt, &options(&[("map-encoding", "float")])).unwrap_err();
    assert!(mrt.to_string().starts_with("map-encoding: style mrt keeps its map as published"));
    let lines = LineSettings::from_options(&options(&[("silhouette", "paper")])).unwrap_err();
    assert!(lines.to_string().starts_with("silhouette paper: style lines finds silhouettes exactly"));
}

#[test]
fn what_no_text_says_is_not_written() {
    let refused = |style: Style| style.to_options().unwrap_err().to_string();
    let inking = |change: &dyn Fn(&mut Inking)| {
        let mut inking = Inking::default();
        change(&mut inking);
        refused(Style::Inking(inking))
    };
    assert!(inking(&|inking| inking.classes = ClassSet::default()).starts_with("classes: nothing is chosen"));
    let ramp = |path: Option<&str>| Ramp { path: path.map(Into::into), ..other_ramp() };
    assert!(inking(&|inking| inking.ramp = ramp(None)).starts_with("ramp: it does not come from a file"));
    assert!(inking(&|inking| inking.ramp = ramp(Some("a\u{fffd}.png"))).contains("rename the file"));
    let paper = TextureSource::File { path: "\u{fffd}".into(), picture: other_ramp().picture };
    assert!(
        refused(Style::Sand(Charcoal { paper, ..Charcoal::default() })).starts_with("paper \u{fffd}: this file name")
    );
}

fn other_ramp() -> Ramp {
    let mut picture = (*Ramp::default().picture).clone();
    picture.pixels[0] ^= 1;
    Ramp { picture: Arc::new(picture), rows: 4, path: None }
}

#[test]
fn an_eye_stands_where_it_stands_whatever_the_view() {
    let camera = CameraSettings {
        eye: Some(glam::DVec3::new(-1.0, 2.5, 1e10)),
        view: "front".parse().unwrap(),
        ..CameraSettings::default()
    };
    let written = SceneSettings { camera, ..SceneSettings::default() }.to_options().unwrap();
    assert_eq!(written, options(&[("eye", "-1,2.5,10000000000")]));
}

#[test]
fn a_record_has_numbers_as_numbers_and_null_for_what_is_left_open() {
    let style =
        Style::with_options(StyleName::Inking, &options(&[("classes", "crease"), ("line-width", "3")])).unwrap();
    let record = serde_json::to_value(style).unwrap();
    assert_eq!((&record["name"], &record["line-width"]), (&"inking".into(), &3.0.into()));
    assert_eq!((&record["classes"], &record["polygon-offset"]), (&["crease"][..].into(), &[1.0, 5.0][..].into()));
    assert_eq!((&record["smooth"], &record["ramp"]), (&true.into(), &"built-in".into()));
    let three_pass = serde_json::to_value(Style::named(StyleName::ThreePass)).unwrap();
    assert!(three_pass["border-width"].is_null() && three_pass["supersample"] == 1, "{three_pass}");
}
