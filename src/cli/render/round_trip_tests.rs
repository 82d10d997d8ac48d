//! Settings to options and back: every option of the command line that makes a picture, for every style. An option's table gives
//! its values: the test covers new settings too.

use super::super::run_settings::is_of_one_run;
use super::Arguments;
use crate::cli::help;
use crate::request::{OptionLayer, Request};
use crate::styles::{is_ignored, is_of_lines_alone};
use clap::{CommandFactory, Parser};
use std::collections::BTreeSet;
use std::path::Path;
use tinta::preset::{OptionValue, Options, Preset, SHIPPED};
use tinta::recipe::option_word;
use tinta::settings::{HasSettings, Kind, Table};
use tinta::{LoadOptions, Picture, Size, Style, StyleName, Target};

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    arguments: Arguments,
}

fn parsed(words: &[String]) -> Arguments {
    let head = ["tinta", "m.obj", "-o", "a.png"].map(str::to_owned);
    Line::try_parse_from(head.iter().chain(words)).unwrap_or_else(|error| panic!("{words:?}: {error}")).arguments
}

fn words(options: &Options) -> Vec<String> {
    options.iter().filter_map(|(name, value)| option_word(name, value)).collect()
}

/// An option with a value other than its default.
struct Sample {
    name: &'static str,
    kind: Kind,
    value: String,
}

impl Sample {
    fn words(&self) -> Vec<String> {
        match self.kind {
            Kind::Flag => option_word(self.name, &OptionValue::Switch(true)).into_iter().collect(),
            _ => option_word(self.name, &OptionValue::text(&self.value)).into_iter().collect(),
        }
    }
}

/// A sample of each setting of a table.
fn of_table<T: HasSettings>(table: &'static Table<T>, file: &Path) -> Vec<Sample> {
    let sample = |setting: &&'static tinta::settings::Setting<T>| {
        let defaults: Vec<String> =
            table.defaults.iter().filter_map(|form| table.find(form, setting.name)?.value(form)).collect();
        let differs = |sample: &String| !defaults.contains(sample);
        // A value that only one form accepts does not represent all of them.
        let is_taken = |sample: &String| {
            let has_it = table.defaults.iter().filter_map(|form| Some((form, table.find(form, setting.name)?)));
            has_it.filter(|(form, setting)| setting.set(&mut (*form).clone(), sample).is_ok()).count() > 0
        };
        let value = match setting.kind {
            Kind::File => file.to_str().unwrap().to_owned(),
            _ => setting.kind.samples(&defaults[0]).into_iter().filter(differs).find(is_taken)?,
        };
        Some(Sample { name: setting.name, kind: setting.kind.clone(), value })
    };
    table.of(None).iter().filter_map(sample).collect()
}

/// A sample of each setting of a request.
fn samples(file: &Path) -> Vec<Sample> {
    let mut samples = of_table(Request::table(), file);
    samples.retain(|sample| sample.name != "style");
    // Values that a panel does not offer.
    for (name, value) in [
        ("seed", "12345678901234567890"),
        ("tone-levels", "0.1,-0.9,1e-7"),
        ("eye", "-1,2.5,1e10"),
        ("view", "-37.25,12"),
        ("weld", "0.000001"),
        ("up-axis", "-z"),
    ] {
        let sample = samples.iter_mut().find(|sample| sample.name == name).unwrap();
        sample.value = value.to_owned();
    }
    samples
}

/// The request made by the words in a style; `None` if the settings exclude one another.
fn asked(given: &[String], style: &str) -> Option<Request> {
    let words: Vec<String> = given.iter().cloned().chain([format!("--style={style}")]).collect();
    Some(parsed(&words).asked().ok()?.0)
}

/// All options that differ from their defaults, and the style.
fn written(request: &Request) -> Options {
    let style = request.style.style_name();
    let mut options = Request::table().options(request, &Request::of_style(style)).unwrap();
    options.insert("style".to_owned(), OptionValue::text(style.name()));
    options
}

/// Asserts that the written options give the same request.
fn assert_survives(request: &Request) -> Options {
    let options = written(request);
    let again = parsed(&words(&options)).asked().unwrap().0;
    let record = |request: &Request| serde_json::to_string(&Request::table().record(request)).unwrap();
    assert_eq!(record(&again), record(request), "{options:?}");
    assert_eq!(again.style, request.style);
    assert_eq!((again.read.clone(), again.scene.camera.clone()), (request.read.clone(), request.scene.camera.clone()));
    options
}

fn picture_file() -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".png").tempfile().unwrap();
    let size = Size { width: 2, height: 4 };
    let target = Target::check(file.path().to_str().unwrap(), false).unwrap();
    target.write(&Picture { size, pixels: vec![200; size.pixel_count() * 4] }).unwrap();
    file
}

#[test]
fn every_option_is_the_requests_or_of_one_run() {
    let others = ["output", "look", "preset", "camera", "help"];
    for name in help::options(&Line::command()).filter_map(|arg| arg.get_long()) {
        let holds = Request::table().settings.iter().any(|setting| setting.group == Some(name));
        let homes = [Request::table().has(name) || holds, is_of_one_run(name), others.contains(&name)];
        assert_eq!(homes.iter().filter(|is_it| **is_it).count(), 1, "--{name}");
    }
}

#[test]
fn every_option_of_a_picture_survives_being_written_and_read() {
    let file = picture_file();
    let samples = samples(file.path());
    assert!(samples.len() > 80, "{}", samples.len());
    for sample in samples {
        let mut is_written = false;
        for (style, _) in StyleName::ALL {
            let Some(request) = asked(&sample.words(), style) else { continue };
            let options = assert_survives(&request);
            // A recipe is written as the settings it stands for.
            let sought = if sample.name == "charcoal" { "density" } else { sample.name };
            is_written |= options.contains_key(sought);
        }
        assert!(is_written, "--{} is written for no style", sample.name);
    }
}

#[test]
fn an_option_is_said_to_have_no_effect_exactly_where_it_changes_nothing() {
    let file = picture_file();
    let mut ignored = 0;
    for sample in samples(file.path()) {
        let name = sample.name;
        let options = Options::from([match sample.kind {
            Kind::Flag => (name.to_owned(), OptionValue::Switch(true)),
            _ => (name.to_owned(), OptionValue::text(&sample.value)),
        }]);
        for (style_name, style) in StyleName::ALL {
            // A style that refuses the option speaks for itself.
            let is_changed =
                Style::with_options(style, &options).map_or(true, |changed| changed != Style::named(style));
            match is_ignored(name, &[]) {
                false => assert!(!is_changed, "--{name} is an option of styles"),
                // Lines always use exact, and refuse the listing's rule.
                true if name == "silhouette" && style.draws_lines() => {}
                true => assert_eq!(is_ignored(name, &[style_name]), !is_changed, "--{name} in {style_name}"),
            }
            ignored += usize::from(!is_changed);
        }
    }
    assert!(ignored > 200, "{ignored}");
}

#[test]
fn all_options_together_survive_too() {
    let file = picture_file();
    let excluded = [
        "no-borders",
        "eye",
        "dpi",
        "page",
        "ink-threshold",
        "pen",
        "sheet",
        "fit-curves",
        "turntable",
        "animate",
        "full",
    ];
    let samples = samples(file.path());
    let mut fewest = usize::MAX;
    for (style_name, style) in StyleName::ALL {
        let is_given = |sample: &&Sample| {
            let is_refused = (style == StyleName::Mrt && sample.name == "map-encoding")
                || (style.draws_lines() && sample.name == "silhouette")
                || (!style.draws_lines() && is_of_lines_alone(sample.name));
            !excluded.contains(&sample.name) && !is_refused
        };
        let given: Vec<String> = samples.iter().filter(is_given).flat_map(Sample::words).collect();
        let request = asked(&given, style_name).unwrap_or_else(|| panic!("{style_name}: {given:?}"));
        fewest = fewest.min(assert_survives(&request).len());
    }
    assert!(fewest >= 18, "{fewest}");
}

#[test]
fn the_papers_presets_are_the_styles_defaults() {
    for (name, _) in SHIPPED {
        let preset = Preset::read(name).unwrap();
        let style = Request::from_layers(&[OptionLayer::File(preset.clone())]).unwrap().0.style;
        assert_eq!(style, Style::named(style.style_name()), "{name}");
        assert!(preset.options.len() > 12, "{name} spells its constants out");
        // All the style's options are written out, except files, which have none.
        let is_a_constant = |kind: &Kind| !matches!(kind, Kind::File | Kind::Flag);
        let settings = Style::table().of(Some(&style));
        let expected: BTreeSet<&str> =
            settings.iter().filter(|setting| is_a_constant(&setting.kind)).map(|setting| setting.name).collect();
        let is_of_style = |name: &&str| *name != "style" && !LoadOptions::table().has(name);
        let named: BTreeSet<&str> = preset.options.keys().map(String::as_str).filter(is_of_style).collect();
        assert_eq!(named, expected, "{name}");
    }
}
