//! Settings to options and back: every option of the command line that makes a picture, for every style. What values an option
//! takes is known from its table, so that a new setting is tried here too.

use super::{Arguments, lines};
use crate::styles::is_ignored;
use clap::{CommandFactory, Parser};
use std::collections::BTreeSet;
use std::path::Path;
use tinta::preset::{OptionValue, Options, Preset, SHIPPED};
use tinta::recipe::option_words;
use tinta::settings::{HasSettings, Kind, Table};
use tinta::{LineSettings, LoadOptions, Picture, SceneSettings, Size, Style, StyleName, SvgSettings, Target};

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
    options.iter().flat_map(|(name, value)| option_words(name, value)).collect()
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
            Kind::Flag => vec![format!("--{}", self.name)],
            _ => vec![format!("--{}={}", self.name, self.value)],
        }
    }
}

/// A sample of each setting of a table.
fn of_table<T: HasSettings>(table: &'static Table<T>, file: &Path) -> Vec<Sample> {
    let sample = |setting: &&'static tinta::settings::Setting<T>| {
        let defaults: Vec<String> =
            table.defaults.iter().filter_map(|form| table.find(form, setting.name)?.value(form)).collect();
        let differs = |sample: &String| !defaults.contains(sample);
        // What one form alone takes is no sample of all of them.
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

/// A sample of each setting, those of styles first.
fn samples(file: &Path) -> Vec<Sample> {
    let mut samples = of_table(Style::table(), file);
    for sample in of_table(SceneSettings::table(), file)
        .into_iter()
        .chain(of_table(LoadOptions::table(), file))
        .chain(of_table(SvgSettings::table(), file))
        .chain(of_table(LineSettings::table(), file))
    {
        if samples.iter().all(|known| known.name != sample.name) {
            samples.push(sample);
        }
    }
    // Beyond what a panel offers.
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

/// Whether it is a setting of exact lines that no style of pictures has.
fn is_of_lines(name: &str) -> bool {
    SvgSettings::table().has(name) && !Style::table().has(name)
}

/// Options that make a picture and are no settings of style, scene, models or lines.
const OTHERS: [&str; 8] = ["show", "style", "turntable", "animate", "frame-delay", "full", "keep", "backend"];

/// All options that differ from their defaults, and the arguments they make; none if the settings refuse one another.
fn written(arguments: &Arguments, style: StyleName) -> Option<Options> {
    let mut all = arguments.styles.style(style).ok()?.to_options().unwrap();
    all.extend(arguments.styles.show.to_options());
    all.extend(arguments.scene_settings().unwrap().to_options().unwrap());
    all.extend(arguments.model.settings().unwrap().to_options().unwrap());
    Some(all)
}

/// Asserts that both mean the same.
fn assert_same(arguments: &Arguments, again: &Arguments, style: StyleName) {
    assert_eq!(again.style_name(), style);
    assert_eq!(again.styles.style(style).unwrap(), arguments.styles.style(style).unwrap());
    assert_eq!(again.styles.show, arguments.styles.show);
    assert_eq!(again.model.settings().unwrap(), arguments.model.settings().unwrap());
    let scenes = [arguments, again].map(|one| one.scene_settings().unwrap());
    assert_eq!(scenes[0].camera, scenes[1].camera);
    assert_eq!((scenes[0].size, scenes[0].copies), (scenes[1].size, scenes[1].copies));
    assert_eq!((scenes[0].background, scenes[0].color), (scenes[1].background, scenes[1].color));
}

fn lines_written(arguments: &Arguments) -> Options {
    let (lines, drawn) = lines_of(arguments);
    let mut all = lines.to_options().unwrap();
    all.extend(drawn.to_options().unwrap());
    all.insert("style".to_owned(), OptionValue::text("lines"));
    all
}

fn assert_same_lines(arguments: &Arguments, again: &Arguments) {
    let (lines, drawn) = lines_of(again);
    let (expected_lines, expected) = lines_of(arguments);
    assert_eq!((lines, &drawn.background), (expected_lines, &SvgSettings::default().background));
    assert_eq!(SvgSettings { background: expected.background, ..drawn }, expected);
}

fn picture_file() -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".png").tempfile().unwrap();
    let size = Size { width: 2, height: 4 };
    let target = Target::check(file.path().to_str().unwrap(), false).unwrap();
    target.write(&Picture { size, pixels: vec![200; size.pixel_count() * 4] }).unwrap();
    file
}

#[test]
fn every_option_that_makes_a_picture_is_in_a_table_or_named_here() {
    let samples = samples(Path::new("none"));
    let known: BTreeSet<&str> = samples.iter().map(|sample| sample.name).chain(OTHERS).collect();
    let command = Line::command();
    let options: BTreeSet<&str> = command
        .get_arguments()
        .filter_map(|arg| arg.get_long())
        .filter(|name| super::super::preset::is_kept(name))
        .collect();
    assert_eq!(options, known);
    assert!(options.iter().all(|name| tinta::preset::is_known(name)), "{options:?}");
}

#[test]
fn every_option_of_a_picture_survives_being_written_and_read() {
    let file = picture_file();
    let samples = samples(file.path());
    assert!(samples.len() > 80, "{}", samples.len());
    for sample in samples {
        let mut is_written = false;
        for (style_name, style) in StyleName::ALL.into_iter().filter(|_| !is_of_lines(sample.name)) {
            let mut given = sample.words();
            given.push(format!("--style={style_name}"));
            let arguments = parsed(&given);
            let Some(options) = written(&arguments, style) else { continue };
            assert_eq!(options["style"], OptionValue::text(style_name));
            assert_same(&arguments, &parsed(&words(&options)), style);
            // A recipe is written as what it sets.
            let sought = if sample.name == "charcoal" { "density" } else { sample.name };
            is_written |= options.contains_key(sought);
        }
        // Lines refuse one of the rules for silhouettes.
        if sample.words() != ["--silhouette=paper"] {
            let arguments = parsed(&sample.words());
            let options = lines_written(&arguments);
            assert_same_lines(&arguments, &parsed(&words(&options)));
            is_written |= options.contains_key(sample.name);
        }
        assert!(is_written, "--{} is written for no style", sample.name);
    }
}

#[test]
fn an_option_is_said_to_have_no_effect_exactly_where_it_changes_nothing() {
    let file = picture_file();
    let default_lines = lines_of(&parsed(&[]));
    let mut ignored = 0;
    for sample in samples(file.path()) {
        let name = sample.name;
        let arguments = parsed(&sample.words());
        // A style that refuses the option speaks for itself.
        let changes = |style| arguments.styles.style(style).map_or(true, |changed| changed != Style::named(style));
        if !is_ignored(name, &[]) {
            assert!(!StyleName::ALL.iter().any(|(_, style)| changes(*style)), "--{name} is an option of styles");
            continue;
        }
        for (style_name, style) in StyleName::ALL {
            assert_eq!(is_ignored(name, &[style_name]), !changes(style), "--{name} in {style_name}");
            ignored += usize::from(!changes(style));
        }
        // Exact is what lines have anyway, and they refuse the listing's rule.
        if name != "silhouette" {
            let is_changed = lines_of(&arguments) != default_lines;
            assert_eq!(is_ignored(name, &["lines"]), !is_changed, "--{name} in lines");
        }
    }
    assert!(ignored > 200, "{ignored}");
}

/// All that the style lines takes from the options of styles.
fn lines_of(arguments: &Arguments) -> (LineSettings, SvgSettings) {
    let drawn = lines::svg_settings(arguments, None).unwrap();
    (arguments.styles.line_settings(&arguments.forms).unwrap(), SvgSettings { title: String::new(), ..drawn })
}

#[test]
fn all_options_together_survive_too() {
    let file = picture_file();
    let excluded = ["no-borders", "transparent", "eye", "dpi", "page", "ink-threshold", "pen", "fit-curves"];
    let given: Vec<String> =
        samples(file.path()).iter().filter(|sample| !excluded.contains(&sample.name)).flat_map(Sample::words).collect();
    let mut fewest = usize::MAX;
    for (style_name, style) in StyleName::ALL {
        let mut given = given.clone();
        if style == StyleName::Mrt {
            given.retain(|word| !word.starts_with("--map-encoding"));
        }
        given.push(format!("--style={style_name}"));
        let arguments = parsed(&given);
        let options = written(&arguments, style).unwrap();
        fewest = fewest.min(options.len());
        assert_same(&arguments, &parsed(&words(&options)), style);
    }
    assert!(fewest >= 18, "{fewest}");
}

#[test]
fn the_papers_presets_are_the_styles_defaults() {
    for (name, _) in SHIPPED {
        let preset = Preset::read(name).unwrap();
        let style = preset.style().unwrap();
        assert_eq!(style, Style::named(style.style_name()), "{name}");
        let arguments = parsed(&words(&preset.options));
        assert_eq!(arguments.styles.style(style.style_name()).unwrap(), style, "{name}");
        assert!(preset.options.len() > 12, "{name} spells its constants out");
        // Every one of the style's own options is spelt out, but for files, which have none.
        let is_a_constant = |kind: &Kind| !matches!(kind, Kind::File | Kind::Flag);
        let settings = Style::table().of(Some(&style));
        let expected: BTreeSet<&str> =
            settings.iter().filter(|setting| is_a_constant(&setting.kind)).map(|setting| setting.name).collect();
        let is_of_style = |name: &&str| *name != "style" && !LoadOptions::table().has(name);
        let named: BTreeSet<&str> = preset.options.keys().map(String::as_str).filter(is_of_style).collect();
        assert_eq!(named, expected, "{name}");
    }
}
