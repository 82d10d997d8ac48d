//! A made-up setting of a made-up style passes through every loop over tables. The viewer's is tested with its controls.

use super::super::{completions, man};
use super::*;
use std::sync::LazyLock;
use tinta::preset::{Preset, to_toml};
use tinta::settings::{Choice, under};

/// A style of dots.
#[derive(Debug, Clone, PartialEq)]
struct Halftone {
    spacing_px: f32,
    shape: Shape,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Round,
    Square,
}

impl Choice for Shape {
    const NAMED: &'static [(&'static str, Self)] = &[("round", Self::Round), ("square", Self::Square)];
}

impl Default for Halftone {
    fn default() -> Self {
        Self { spacing_px: 6.0, shape: Shape::Round }
    }
}

impl HasSettings for Halftone {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<Halftone>> = LazyLock::new(|| {
            let settings = vec![
                Setting::field("dot-spacing", "PIXELS", "From dot to dot; more is coarser", |style: &mut Halftone| {
                    &mut style.spacing_px
                }),
                Setting::field("dot-shape", "SHAPE", "Shape of the dots: round, square", |style: &mut Halftone| {
                    &mut style.shape
                }),
            ];
            Table { settings: under("Style halftone", settings).collect(), defaults: vec![Halftone::default()] }
        });
        &TABLE
    }
}

struct OfHalftone;

impl Selection for OfHalftone {
    type Of = Halftone;
}

fn command() -> Command {
    <GivenOptions<OfHalftone> as clap::Args>::augment_args(Command::new("halftone"))
}

fn given(words: &[&str]) -> std::result::Result<Options, clap::Error> {
    let words = ["halftone"].iter().chain(words).map(|word| (*word).to_owned());
    let matches = command().try_get_matches_from(words)?;
    GivenOptions::<OfHalftone>::from_arg_matches(&matches).map(|chosen| chosen.options)
}

#[test]
fn a_setting_is_found_at_every_door() {
    let made = Halftone { spacing_px: 2.5, shape: Shape::Square };
    // Parsing, with values checked at once.
    let options = given(&["--dot-spacing", "2.5", "--dot-shape=square"]).unwrap();
    assert_eq!(Halftone::from_options(&options).unwrap(), made);
    let refused = given(&["--dot-shape", "oval"]).unwrap_err().to_string();
    assert!(
        refused.contains("'oval'") && refused.contains("--dot-shape") && refused.contains("round, square"),
        "{refused}"
    );
    assert!(given(&["--dot-spacing=wide"]).unwrap_err().to_string().contains("give a number"));
    // Help, with the default of the struct.
    let command = super::super::help::unmarked(command());
    let help = command.clone().render_help().to_string();
    for text in
        ["Style halftone:", "--dot-spacing <PIXELS>", "more is coarser [default: 6]", "round, square [default: round]"]
    {
        assert!(help.contains(text), "{text}: {help}");
    }
    // The manual page.
    let page = man::page(command).text;
    assert!(page.contains("dot\\-spacing") && page.contains("more is coarser"), "{page}");
    // A shell's suggestions.
    assert_eq!(completions::of_table::<Halftone>("dot-shape"), ["round", "square"]);
    assert!(completions::of_table::<Halftone>("dot-spacing").is_empty());
    // Presets, and with them recipes and jobs, which hold the same options.
    let written = made.to_options().unwrap();
    assert_eq!(written, options);
    let preset = Preset::parse("dots.toml", &to_toml(&written, "")).unwrap();
    assert_eq!(Halftone::from_options(&preset.options).unwrap(), made);
    assert!(Halftone::default().to_options().unwrap().is_empty());
    // Records.
    let record = serde_json::Value::from(Halftone::table().record(&made));
    assert_eq!(record, serde_json::json!({ "dot-spacing": 2.5, "dot-shape": "square" }));
}
