//! The two helps: `-h` lists the options that most people need, `--help` all of them in their groups.
//!
//! The settings declare which options are common (`Setting::common`), and single commands do so with clap's `hide_short_help`.
//! clap would give each option of a long help three lines; here both helps use the short form.

use super::Program;
use super::groups::ALSO;
use crate::request::endings_of_lines;
use clap::{Arg, ArgAction, Command};
use std::ffi::OsString;
use tinta::mesh::Format;
use tinta::preset::{LOOKS, OptionValue, Options};
use tinta::settings::on_off;

/// A help of at most so many lines is one page, and needs no shorter one.
const PAGE_LINES: usize = 60;

/// Examples below the program's help before those of the commands.
const EXAMPLE: &str = "tinta cow.obj                                   show a model, or draw it";

/// The meaning of each exit code.
const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  a check found a difference, or a job of a batch failed
  2  not done; one sentence on standard error says why";

/// Below the program's help.
fn after_help(program: &Program) -> String {
    let examples = program.commands().iter().flat_map(|command| command.examples);
    let lines = [&EXAMPLE].into_iter().chain(examples).map(|example| format!("  {example}\n"));
    format!("Examples:\n{}\n{EXIT_CODES}", lines.collect::<String>())
}

/// The program's commands; help lists every option.
pub(super) fn whole(program: &Program) -> Command {
    commands(program).mut_subcommands(unmarked)
}

/// The program's commands; those with looks state the look's defaults.
fn commands(program: &Program) -> Command {
    let look = LOOKS[0].preset().map(|preset| preset.options).unwrap_or_default();
    let all = program.commands().iter().map(|command| (command.arguments)(Command::new(command.name)));
    let whole = Command::new("tinta")
        .version(env!("CARGO_PKG_VERSION"))
        .about("Draw 3D models as cartoons, ink, charcoal and line art")
        .max_term_width(100)
        .subcommand_required(true)
        .arg_required_else_help(true)
        .after_help(after_help(program))
        .subcommands(all);
    whole.mut_subcommands(|command| {
        let command = command.mut_args(with_formats);
        let has_looks = options(&command).any(|arg| arg.get_long() == Some("look"));
        if has_looks { command.mut_args(|arg| with_drawn_default(arg, &look)) } else { command }
    })
}

/// An argument whose help lists the formats of models for `FORMATS`, and of files of lines for `DRAWINGS`.
fn with_formats(arg: Arg) -> Arg {
    let Some(help) = arg.get_help().map(ToString::to_string) else { return arg };
    arg.help(help.replace("FORMATS", &Format::names().join(", ")).replace("DRAWINGS", &endings_of_lines()))
}

/// The beginning of the default at the end of an option's help.
const DEFAULT: &str = "[default: ";

/// What comes between the default look's value and the one that counts with `--style` or `--preset`.
const OTHERWISE: &str = "; no look: ";

/// An option whose help states the default look's value, then the default of a named style.
fn with_drawn_default(arg: Arg, look: &Options) -> Arg {
    let value = match arg.get_long().and_then(|name| look.get(name)) {
        Some(OptionValue::Text(value)) => value.clone(),
        Some(OptionValue::Texts(values)) => values.join(","),
        Some(OptionValue::Switch(is_on)) => on_off(*is_on).to_owned(),
        None => return arg,
    };
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    match help.rsplit_once(DEFAULT) {
        // A value that is the same in both appears once.
        Some((about, published)) if !published.starts_with(&format!("{value}]")) => {
            arg.help(format!("{about}{DEFAULT}{value}{OTHERWISE}{published}"))
        }
        _ => arg,
    }
}

/// A command whose help lists every option, marked or not.
pub(super) fn unmarked(command: Command) -> Command {
    command.mut_args(|arg| arg.hide_short_help(false))
}

/// The program's commands for these words, the program's name first. If the words request the short help, help prints that one.
pub(super) fn command(program: &Program, words: &[OsString]) -> Command {
    if !words.iter().skip(1).take_while(|word| *word != "--").any(|word| word == "-h") {
        return whole(program);
    }
    commands(program).mut_subcommands(|command| {
        let needed: Vec<String> = command.get_arguments().filter(|arg| !arg.is_hide_short_help_set()).map(id).collect();
        let whole = unmarked(command);
        if lines(&whole) <= PAGE_LINES { whole } else { shortened(whole, &needed) }
    })
}

/// The arguments of a command that are options, with a value or without.
pub(super) fn options(command: &Command) -> impl Iterator<Item = &Arg> {
    command.get_arguments().filter(|arg| arg.get_long().is_some() && !arg.is_hide_set())
}

fn id(arg: &Arg) -> String {
    arg.get_id().to_string()
}

/// How many lines a command's help has on a narrow terminal.
fn lines(command: &Command) -> usize {
    command.clone().term_width(80).render_help().to_string().lines().count()
}

/// An option whose help has the first sentence of its own part alone, with one default.
fn in_short(arg: Arg) -> Arg {
    let Some(help) = arg.get_help().map(ToString::to_string) else { return arg };
    let help = help.split(ALSO).next().unwrap_or_default();
    let (about, default) = help.rsplit_once(DEFAULT).map_or((help, String::new()), |(about, default)| {
        let default = default.split(OTHERWISE).next().unwrap_or_default().split(';').next().unwrap_or_default();
        let about = about.split("; ").next().unwrap_or_default();
        (about, format!(" {DEFAULT}{}]", default.trim_end_matches(']')))
    });
    arg.help(about.trim_end().to_owned() + &default)
}

/// A command that lists only these options, in one group, and names the way to the others.
fn shortened(command: Command, needed: &[String]) -> Command {
    let name = command.get_name().to_owned();
    let count = options(&command).count();
    command
        .mut_args(|arg| {
            let is_needed = needed.contains(&id(&arg));
            let is_option = !arg.is_positional();
            let arg = if is_needed { in_short(arg) } else { arg.hide(true) };
            if is_option { arg.help_heading(None) } else { arg }
        })
        .disable_help_flag(true)
        .arg(
            Arg::new("help")
                .short('h')
                .long("help")
                .action(ArgAction::Help)
                .help_heading(None)
                .help("Print help; -h prints this summary"),
        )
        .after_help(format!("All {count} options, in groups: tinta {name} --help"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::request::Request;
    use tinta::settings::{HasSettings, Setting};

    fn help_of(line: &str) -> String {
        let words: Vec<OsString> = line.split(' ').map(OsString::from).collect();
        command(&Program::default(), &words).term_width(80).try_get_matches_from(&words).unwrap_err().to_string()
    }

    /// The options that a help lists.
    fn listed(help: &str) -> Vec<&str> {
        let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
        lines.filter_map(|line| line.split([' ', '[']).find(|word| word.starts_with("--"))).collect()
    }

    #[test]
    fn the_short_help_of_every_command_fits_on_a_page() {
        for subcommand in commands(&Program::default()).get_subcommands() {
            let name = subcommand.get_name();
            let short = help_of(&format!("tinta {name} -h"));
            assert!(short.lines().count() <= PAGE_LINES, "{name}: {} lines\n{short}", short.lines().count());
            assert!(short.lines().all(|line| line.chars().count() <= 80), "{short}");
        }
    }

    #[test]
    fn the_short_help_has_what_is_marked_and_the_whole_one_everything() {
        let (short, whole) = (help_of("tinta render -h"), help_of("tinta render --help"));
        let all = listed(&whole);
        assert!(listed(&short).iter().all(|option| all.contains(option)), "{short}");
        assert!((10..=20).contains(&listed(&short).len()), "{short}");
        let command = commands(&Program::default());
        let render = command.find_subcommand("render").unwrap();
        for arg in options(render) {
            let option = format!("--{}", arg.get_long().unwrap());
            assert!(all.contains(&option.as_str()), "{option}");
            assert_eq!(listed(&short).contains(&option.as_str()), !arg.is_hide_short_help_set(), "{option}\n{short}");
        }
        let end = format!("All {} options, in groups: tinta render --help\n", options(render).count());
        assert!(short.ends_with(&end), "{short}");
        assert!(whole.contains("\nCamera:\n") && !short.contains("\nCamera:\n"));
        let headings: Vec<&str> = short.lines().filter(|line| line.ends_with(':') && !line.starts_with(' ')).collect();
        assert_eq!(headings, ["Arguments:", "Options:"]);
        // At any place; after two dashes it is a model.
        assert_eq!(help_of("tinta render a.obj --style ink -h"), short);
        assert!(help_of("tinta help render").contains("\nCamera:\n"));
    }

    #[test]
    fn help_states_the_defaults_of_the_look_that_is_drawn() {
        let look = LOOKS[0].preset().unwrap().options;
        let command = whole(&Program::default());
        for name in ["render", "view"] {
            let Some(command) = command.find_subcommand(name) else { continue };
            for arg in options(command) {
                let (option, help) = (arg.get_long().unwrap(), arg.get_help().unwrap().to_string());
                let Some(value) = look.get(option) else {
                    assert!(!help.contains(OTHERWISE), "{name} --{option}: {help}");
                    continue;
                };
                let value = match value {
                    OptionValue::Texts(values) => values.join(","),
                    OptionValue::Text(value) => value.clone(),
                    OptionValue::Switch(_) => "on".to_owned(),
                };
                let is_stated = help.contains(&format!("[default: {value}{OTHERWISE}"));
                assert!(is_stated || help.contains(&format!("[default: {value}]")), "{name} --{option}: {help}");
            }
        }
        let info = command.find_subcommand("info").unwrap();
        assert!(options(info).all(|arg| !arg.get_help().unwrap().to_string().contains(OTHERWISE)));
    }

    #[test]
    fn settings_inside_an_option_stand_on_lines_of_their_own() {
        let lines = help_of("tinta render --help");
        let inside = Request::table().settings.iter().filter(|setting| setting.group.is_some());
        let is_listed = |setting: &&Setting<Request>| {
            let begins = |line: &str| {
                let text = line.rsplit("<NAME=VALUE>").next().unwrap_or_default().trim_start();
                text.strip_prefix(setting.name).is_some_and(|rest| rest.starts_with(['=', ':']))
            };
            lines.lines().any(begins)
        };
        let missing: Vec<&str> = inside.filter(|setting| !is_listed(setting)).map(|setting| setting.name).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }

    #[test]
    fn a_help_of_one_page_is_the_same_for_both() {
        for name in ["generate", "again"] {
            assert_eq!(help_of(&format!("tinta {name} -h")), help_of(&format!("tinta {name} --help")));
        }
    }

    #[test]
    fn no_line_of_the_examples_is_broken_on_a_narrow_terminal() {
        let help = help_of("tinta --help");
        let command = commands(&Program::default());
        let written = command.get_after_help().unwrap().to_string();
        assert!(help.contains(&written), "{help}");
    }
}
