//! The values that a shell offers after an option: names, files or folders. clap knows how to parse values but does not list them
//! for shells. Parsing and help do not use this module: it only makes the scripts.

use super::super::Program;
use super::super::groups::HOLDING;
use clap::builder::{PossibleValuesParser, Resettable};
use clap::{Arg, Command, ValueHint};
use tinta::plan::Submission;
use tinta::preset::LOOKS;
use tinta::request::Request;
use tinta::settings::{HasSettings, names_of};

/// The whole command line with the values that a shell offers.
pub fn with_values(program: &Program) -> Command {
    program.commands().iter().fold(program.command_line(), |whole, of| {
        whole.mut_subcommand(of.name, |command| command.mut_args(|arg| with_value(of.offers, arg)))
    })
}

fn with_value(offers: fn(&str) -> Vec<&'static str>, arg: Arg) -> Arg {
    if !arg.get_action().takes_values() || !arg.get_possible_values().is_empty() {
        return arg;
    }
    let value_name = arg.get_value_names().unwrap_or_default().first().map_or("", |name| name.as_str());
    // One that only holds other settings takes their names alone.
    let option = arg.get_long().filter(|_| value_name != HOLDING);
    let offered = option.map(|option| offered(offers, option)).unwrap_or_default();
    if !offered.is_empty() {
        // A default need not be one of them: a view may be two angles.
        return arg.default_value(Resettable::Reset).value_parser(PossibleValuesParser::new(offered));
    }
    match value_name {
        "FILE" | "MODEL" | "PICTURE" => arg.value_hint(ValueHint::FilePath),
        "FILE|DIR" => arg.value_hint(ValueHint::AnyPath),
        "DIR" => arg.value_hint(ValueHint::DirPath),
        // A number, a colour, a text: no file's name.
        _ => arg.value_hint(ValueHint::Other),
    }
}

/// The names an option takes, or the default suggestions where it takes other values too.
fn offered(offers: fn(&str) -> Vec<&'static str>, option: &str) -> Vec<&'static str> {
    let of_command = offers(option);
    match option {
        _ if !of_command.is_empty() => of_command,
        "look" => LOOKS.iter().map(|look| look.name).collect(),
        "submission" => names_of::<Submission>(),
        _ => {
            // Styles and lines have settings of one name that take different ones.
            let mut names: Vec<&str> = Vec::new();
            for setting in Request::table().settings.iter().filter(|setting| setting.name == option) {
                names.extend(
                    setting.kind.offered().into_iter().filter(|name| !names.contains(name)).collect::<Vec<_>>(),
                );
            }
            names
        }
    }
}

/// The values from a table of settings for an option; empty for an option of another table.
pub fn of_table<T: HasSettings>(option: &str) -> Vec<&'static str> {
    let settings = T::table().settings.iter().filter(|setting| setting.name == option);
    let offered = settings.map(|setting| setting.kind.offered()).next().unwrap_or_default();
    offered.into_iter().filter(|name| !name.is_empty()).collect()
}
