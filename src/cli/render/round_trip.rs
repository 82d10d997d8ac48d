//! Settings to options and back: every option of the command line that makes a picture, for every style.

use super::super::options::ignored::is_ignored;
use super::{Arguments, lines};
use clap::{CommandFactory, Parser};
use std::collections::BTreeSet;
use std::path::Path;
use tinta::preset::{OptionValue, Options, Preset, SHIPPED, of_lines, of_load, of_scene, of_show, of_style};
use tinta::recipe::option_words;
use tinta::{LineSettings, Picture, Size, Style, StyleName, SvgSettings, Target};

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

/// A value for each option that differs from its default; `FILE` stands for a picture that is there.
const SAMPLES: [(&str, &str); 75] = [
    ("show", "tones"),
    ("no-borders", ""),
    ("cull", "back"),
    ("tones", "2"),
    ("tone-thresholds", "0.7,0.3333"),
    ("tone-levels", "0.1,-0.9,1e-7"),
    ("tone-lookup", "texture"),
    ("filter", "sobel"),
    ("detection-factor", "0.37"),
    ("background-quad", "off"),
    ("map-encoding", "float16"),
    ("slope-threshold", "on"),
    ("border-width", "5"),
    ("supersample", "2"),
    ("map-target", "texture"),
    ("crease-angle", "33.3"),
    ("silhouette", "exact"),
    ("classes", "silhouette,material"),
    ("class-colors", "silhouette=red,crease=rgb(1 2.5 3),normal=#010203"),
    ("line-width", "3.25"),
    ("smooth", "off"),
    ("joints", "off"),
    ("back-edges", "off"),
    ("line-drawing", "quads"),
    ("ink-depth", "test"),
    ("polygon-offset", "-2,7.5"),
    ("paint", "flat"),
    ("ramp", "FILE"),
    ("ramp-row", "2"),
    ("light", "vertex-shader"),
    ("texture", "on"),
    ("ink-threshold", "0.1"),
    ("quality", "best"),
    ("charcoal", "darker"),
    ("seed", "12345678901234567890"),
    ("density", "33.3"),
    ("cet-exponent", "2.2"),
    ("contrast-exponent", "1.1"),
    ("saturation", "1.25"),
    ("smudge", "on"),
    ("light-1", "-1,0.5,0.1"),
    ("light-2", "0,0,-1"),
    ("paper", "FILE"),
    ("texture-size", "64x32"),
    ("cet-filter", "mipmap"),
    ("cet-coordinate", "saturated"),
    ("contrast-operator", "bias"),
    ("noise", "object"),
    ("improve", "clamp,luminance"),
    ("size", "96x64"),
    ("background", "rgb(10.5 20 30)"),
    ("transparent", ""),
    ("color", "tan"),
    ("copies", "4"),
    ("view", "-37.25,12"),
    ("fov", "45.5"),
    ("parallel", ""),
    ("height", "2.5"),
    ("eye", "-1,2.5,1e10"),
    ("target", "0,-0.1,0"),
    ("up", "0,0,1"),
    ("near", "0.125"),
    ("far", "1000"),
    ("up-axis", "-z"),
    ("weld", "0.000001"),
    ("normals", "flat"),
    ("smooth-angle", "33"),
    ("strict", ""),
    ("skin", "FILE"),
    ("allow-external", ""),
    ("model-frame", "run3"),
    ("hidden", "ghost"),
    ("class-widths", "crease=0.5,silhouette=3"),
    ("width-mm", "210.5"),
    ("dpi", "96"),
];

/// Options that make a picture and are no settings of style, scene, models or lines.
const OTHERS: [&str; 7] = ["style", "turntable", "animate", "frame-delay", "full", "keep", "backend"];

/// Options with a sample of their own below, as they exclude others or stand for several.
const SWITCHES_OF_LINES: [&str; 2] = ["provenance", "pen"];

fn sample_words(name: &str, value: &str, file: &Path) -> Vec<String> {
    match value {
        "" => vec![format!("--{name}")],
        value => vec![format!("--{name}={}", value.replace("FILE", file.to_str().unwrap()))],
    }
}

/// All options that differ from their defaults, and the arguments they make; none if the settings refuse one another.
fn written(arguments: &Arguments, style: StyleName) -> Option<Options> {
    let settings = arguments.scene.settings(arguments.camera.settings());
    let mut all = of_style(&arguments.styles.style(style).ok()?).unwrap();
    all.extend(of_show(arguments.styles.show));
    all.extend(of_scene(&settings));
    all.extend(of_load(&arguments.model.options()).unwrap());
    Some(all)
}

/// Asserts that both mean the same.
fn assert_same(arguments: &Arguments, again: &Arguments, style: StyleName) {
    assert_eq!(again.style_name(), style);
    assert_eq!(again.styles.style(style).unwrap(), arguments.styles.style(style).unwrap());
    assert_eq!(again.styles.show, arguments.styles.show);
    assert_eq!(again.model.options(), arguments.model.options());
    let scenes = [arguments, again].map(|one| one.scene.settings(one.camera.settings()));
    assert_eq!(scenes[0].camera, scenes[1].camera);
    assert_eq!((scenes[0].size, scenes[0].copies), (scenes[1].size, scenes[1].copies));
    assert_eq!((scenes[0].background, scenes[0].color), (scenes[1].background, scenes[1].color));
}

fn lines_written(arguments: &Arguments) -> Options {
    let drawn = lines::svg_settings(arguments, None);
    of_lines(&arguments.styles.line_settings().unwrap(), &drawn).unwrap()
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
fn every_option_has_a_sample_here() {
    let known: BTreeSet<&str> = SAMPLES.iter().map(|(name, _)| *name).chain(OTHERS).chain(SWITCHES_OF_LINES).collect();
    let command = Line::command();
    let options: BTreeSet<&str> = command
        .get_arguments()
        .filter_map(|arg| arg.get_long())
        .filter(|name| super::super::preset::is_kept(name))
        .collect();
    assert_eq!(options, known, "each option that makes a picture needs a sample and its line in src/preset/");
}

#[test]
fn every_option_of_a_picture_survives_being_written_and_read() {
    let file = picture_file();
    for (name, value) in SAMPLES {
        let mut is_written = false;
        for (style_name, style) in StyleName::ALL {
            let mut given = sample_words(name, value, file.path());
            if ["hidden", "class-widths", "width-mm", "dpi"].contains(&name) {
                continue;
            }
            given.push(format!("--style={style_name}"));
            let arguments = parsed(&given);
            let Some(options) = written(&arguments, style) else { continue };
            assert_eq!(options["style"], OptionValue::text(style_name));
            let again = parsed(&words(&options));
            assert_same(&arguments, &again, style);
            // A recipe is written as what it sets.
            let sought = if name == "charcoal" { "density" } else { name };
            is_written |= options.contains_key(sought);
        }
        let arguments = sample_words(name, value, file.path());
        // Lines refuse the other rule for silhouettes, which is their only one.
        if name != "silhouette" {
            let arguments = parsed(&arguments);
            let options = lines_written(&arguments);
            assert_same_lines(&arguments, &parsed(&words(&options)));
            is_written |= options.contains_key(name);
        }
        assert!(is_written, "--{name} is written for no style");
    }
    for name in SWITCHES_OF_LINES {
        let arguments = parsed(&sample_words(name, "", file.path()));
        let options = lines_written(&arguments);
        assert_eq!(options[name], OptionValue::Switch(true));
        assert_same_lines(&arguments, &parsed(&words(&options)));
    }
}

#[test]
fn an_option_is_said_to_have_no_effect_exactly_where_it_changes_nothing() {
    let file = picture_file();
    let default_lines = lines_of(&parsed(&[]));
    let mut ignored = 0;
    for (name, value) in SAMPLES {
        let arguments = parsed(&sample_words(name, value, file.path()));
        // A style that refuses the option speaks for itself.
        let changes = |style| arguments.styles.style(style).map_or(true, |changed| changed != Style::named(style));
        if !is_ignored(name, &[]) {
            assert!(!StyleName::ALL.iter().any(|(_, style)| changes(*style)), "--{name} belongs into the list");
            continue;
        }
        for (style_name, style) in StyleName::ALL {
            assert_eq!(is_ignored(name, &[style_name]), !changes(style), "--{name} in {style_name}");
            ignored += usize::from(!changes(style));
        }
        // Exact is what lines have anyway, and they refuse the other rule.
        if name != "silhouette" {
            let is_changed = lines_of(&arguments) != default_lines;
            assert_eq!(is_ignored(name, &["lines"]), !is_changed, "--{name} in lines");
        }
    }
    assert!(ignored > 200, "{ignored}");
}

/// All that the style lines takes from the options of styles.
fn lines_of(arguments: &Arguments) -> (LineSettings, SvgSettings) {
    let drawn = lines::svg_settings(arguments, None);
    (arguments.styles.line_settings().unwrap(), SvgSettings { title: String::new(), ..drawn })
}

#[test]
fn all_options_together_survive_too() {
    let file = picture_file();
    let excluded = ["no-borders", "transparent", "eye", "dpi", "ink-threshold"];
    let given: Vec<String> = SAMPLES
        .iter()
        .filter(|(name, _)| !excluded.contains(name))
        .flat_map(|(name, value)| sample_words(name, value, file.path()))
        .collect();
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
        let OptionValue::Text(style) = &preset.options["style"] else { panic!("{name} names no style") };
        let style: StyleName = style.parse().unwrap();
        let arguments = parsed(&words(&preset.options));
        assert_eq!(arguments.styles.style(style).unwrap(), Style::named(style), "{name}");
        assert!(preset.options.len() > 12, "{name} spells its constants out");
        // Every one of the style's own options is spelt out, but for files, which have none.
        let mut named = preset.options.clone();
        named.remove("style");
        let is_written = |option: &str| {
            let sample = SAMPLES.iter().find(|(sample, _)| *sample == option).unwrap();
            let mut given = sample_words(sample.0, sample.1, Path::new("none"));
            given.push(format!("--style={}", style.name()));
            parsed(&given).styles.style(style).is_ok_and(|changed| changed != Style::named(style))
        };
        for (sample, value) in SAMPLES.iter().filter(|(sample, value)| *value != "FILE" && *sample != "no-borders") {
            assert_eq!(named.contains_key(*sample), is_written(sample), "{name}: {sample} = {value}");
        }
    }
}
