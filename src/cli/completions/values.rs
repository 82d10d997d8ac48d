//! What stands after an option: names, files or folders. clap knows how to read values, not which there are; a shell has
//! to be told. Reading and help stay as they are: only the scripts are made from this.

use super::super::preset::ON_OFF;
use clap::builder::{PossibleValuesParser, Resettable};
use clap::{Arg, Command, ValueHint};
use tinta::edges::{Class, SilhouetteRule};
use tinta::figures::figures;
use tinta::lines::Hidden;
use tinta::mesh::{Normals, UpAxis};
use tinta::plan::LineDrawing;
use tinta::plan::prune::Rule;
use tinta::styles::{
    CetCoordinate, CetFilter, ContrastOperator, Filter, LightOn, MapEncoding, MapTarget, Noise, PaintMode, Quality,
    Recipe, Supersample, ToneLookup,
};
use tinta::{Backend, Show, Size, StyleName};

/// The command with what a shell offers for each value.
pub fn with_values(command: Command) -> Command {
    let names: Vec<String> = command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    names.into_iter().fold(command, |whole, name| {
        whole.mut_subcommand(&name, |command| command.mut_args(|arg| with_value(&name, arg)))
    })
}

/// Whether a value stands after it.
pub fn takes_value(arg: &Arg) -> bool {
    arg.get_long().is_some() && arg.get_action().takes_values()
}

fn with_value(command: &str, arg: Arg) -> Arg {
    if !arg.get_action().takes_values() || !arg.get_possible_values().is_empty() {
        return arg;
    }
    let value_name = arg.get_value_names().unwrap_or_default().first().map_or("", |name| name.as_str());
    let offered = match arg.get_long() {
        Some(_) if value_name == ON_OFF => vec!["on", "off"],
        Some(option) => offered(command, option),
        None => Vec::new(),
    };
    if !offered.is_empty() {
        // A default need not be one of them: a view may be two angles.
        return arg.default_value(Resettable::Reset).value_parser(PossibleValuesParser::new(offered));
    }
    match value_name {
        "FILE" | "MODEL" | "PICTURE" => arg.value_hint(ValueHint::FilePath),
        // zsh takes what stands after a colon for what it is to do.
        "FILE|paper:NAME" => arg.value_hint(ValueHint::FilePath).value_name("FILE"),
        "FILE|DIR" => arg.value_hint(ValueHint::AnyPath),
        "DIR" => arg.value_hint(ValueHint::DirPath),
        // A number, a colour, a text: no file's name.
        _ => arg.value_hint(ValueHint::Other),
    }
}

/// The names an option takes, or the usual ones where it takes others too.
fn offered(command: &str, option: &str) -> Vec<&'static str> {
    match option {
        "style" if command == "view" => names(&StyleName::ALL),
        "style" => with(names(&StyleName::ALL), &["lines"]),
        "left" | "right" | "styles" => names(&StyleName::ALL),
        "backend" => names(&Backend::ALL),
        "show" => names(&Show::ALL),
        "view" => vec!["iso", "front", "back", "left", "right", "top", "bottom"],
        "up-axis" => names(&UpAxis::ALL),
        "normals" => names(&Normals::ALL),
        "cull" => vec!["none", "back"],
        "tones" => vec!["1", "2", "3"],
        "tone-lookup" => names(&ToneLookup::ALL),
        "filter" => names(&Filter::ALL),
        "map-encoding" => names(&MapEncoding::ALL),
        "border-width" => vec!["paper", "1", "2", "3", "4"],
        "supersample" => names(&Supersample::ALL),
        "map-target" => names(&MapTarget::ALL),
        "silhouette" => names(&SilhouetteRule::ALL),
        "classes" => with(names(&Class::ALL), &["all"]),
        "class-colors" => vec!["figure-6"],
        "line-drawing" => names(&LineDrawing::ALL),
        "ink-depth" => vec!["write", "test"],
        "paint" => names(&PaintMode::ALL),
        "ramp-row" => vec!["material", "object", "0", "1", "2", "3"],
        "light" => names(&LightOn::ALL),
        "quality" => names(&Quality::ALL),
        "charcoal" => names(&Recipe::ALL),
        "cet-filter" => names(&CetFilter::ALL),
        "cet-coordinate" => names(&CetCoordinate::ALL),
        "contrast-operator" => names(&ContrastOperator::ALL),
        "noise" => names(&Noise::ALL),
        "improve" => vec!["all", "none", "clamp", "wrap", "paper-coordinate", "luminance"],
        "hidden" => names(&Hidden::ALL),
        "keep" => names(&Rule::ALL),
        "suite" => vec!["papers", "solids", "all"],
        "only" if command == "stress" => GROUPS.to_vec(),
        "only" => figures(Size { width: 1, height: 1 }).iter().map(|figure| figure.id).collect(),
        _ => Vec::new(),
    }
}

/// Groups of cases that `tinta stress --only` names.
pub const GROUPS: [&str; 9] =
    ["scale", "depth", "topology", "thresholds", "pictures", "mixes", "turns", "files", "faults"];

fn names<T>(table: &[(&'static str, T)]) -> Vec<&'static str> {
    table.iter().map(|(name, _)| *name).collect()
}

fn with(mut names: Vec<&'static str>, more: &[&'static str]) -> Vec<&'static str> {
    names.extend_from_slice(more);
    names
}
