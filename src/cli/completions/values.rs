//! What stands after an option: names, files or folders. clap knows how to read values, not which there are; a shell has
//! to be told. Reading and help stay as they are: only the scripts are made from this.

use clap::builder::{PossibleValuesParser, Resettable};
use clap::{Arg, Command, ValueHint};
use tinta::StyleName;
use tinta::plan::Submission;
use tinta::request::Request;
use tinta::settings::{HasSettings, names_of};

/// The command with what a shell offers for each value.
pub(super) fn with_values(command: Command) -> Command {
    let names: Vec<String> = command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    names.into_iter().fold(command, |whole, name| {
        whole.mut_subcommand(&name, |command| command.mut_args(|arg| with_value(&name, arg)))
    })
}

/// Whether a value stands after it.
pub(super) fn takes_value(arg: &Arg) -> bool {
    arg.get_long().is_some() && arg.get_action().takes_values()
}

fn with_value(command: &str, arg: Arg) -> Arg {
    if !arg.get_action().takes_values() || !arg.get_possible_values().is_empty() {
        return arg;
    }
    let value_name = arg.get_value_names().unwrap_or_default().first().map_or("", |name| name.as_str());
    let offered = arg.get_long().map(|option| offered(command, option)).unwrap_or_default();
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

/// The names an option takes, or the usual ones where it takes others too.
fn offered(command: &str, option: &str) -> Vec<&'static str> {
    match option {
        "right" if command == "view" => names_of::<StyleName>(),
        "left" | "right" | "styles" => StyleName::of_passes().map(|(name, _)| name).collect(),
        "look" => tinta::preset::LOOKS.iter().map(|look| look.name).collect(),
        "submission" => names_of::<Submission>(),
        "ink" => vec!["dark", "light", "alpha"],
        "suite" => vec!["papers", "solids", "all"],
        #[cfg(feature = "measuring")]
        "against" => names_of::<tinta::measure::Against>(),
        "only" if command == "stress" => GROUPS.to_vec(),
        #[cfg(feature = "measuring")]
        "only" => tinta::figures::figures(tinta::Size { width: 1, height: 1 }).iter().map(|figure| figure.id).collect(),
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

/// What a table of settings offers for an option; nothing for one of another table.
#[cfg(test)]
pub(crate) fn of_table<T: HasSettings>(option: &str) -> Vec<&'static str> {
    let settings = T::table().settings.iter().filter(|setting| setting.name == option);
    settings.map(|setting| setting.kind.offered()).next().unwrap_or_default()
}

/// Groups of cases that `tinta stress --only` names.
pub(super) const GROUPS: [&str; 9] =
    ["scale", "depth", "topology", "thresholds", "pictures", "mixes", "turns", "files", "faults"];
