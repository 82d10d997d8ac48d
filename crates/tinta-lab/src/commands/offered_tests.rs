//! A shell's suggestions for the options of all commands.

use super::{program, stress};
use clap::Command;
use clap::error::ErrorKind;
use tinta::cli::completions::with_values;

/// clap's error about a value, if any.
fn refusal(command: &Command, option: &str, value: &str) -> Option<String> {
    let words = [command.get_name().to_owned(), format!("--{option}={value}")];
    let error = command.clone().try_get_matches_from(words).err()?;
    matches!(error.kind(), ErrorKind::InvalidValue | ErrorKind::ValueValidation).then(|| error.to_string())
}

#[test]
fn every_name_offered_is_taken_and_every_choice_is_offered() {
    let mut whole = program().command_line().disable_help_subcommand(true);
    whole.build();
    let with_values = with_values(&program());
    let (mut names, mut choices) = (0, 0);
    for command in whole.get_subcommands() {
        let offering = with_values.find_subcommand(command.get_name()).unwrap();
        for arg in offering.get_arguments().filter(|arg| arg.get_long().is_some() && arg.get_action().takes_values()) {
            let option = arg.get_long().unwrap();
            let what = format!("{} --{option}", command.get_name());
            let offered = arg.get_possible_values();
            let offered: Vec<&str> = offered.iter().map(|value| value.get_name()).collect();
            for value in &offered {
                assert_eq!(refusal(command, option, value), None, "{what} offers {value}");
                names += 1;
            }
            // The error for a choice lists its names; all of them must be offered.
            let Some(text) = refusal(command, option, "?") else { continue };
            if let Some(list) = text.split_once("choose ").map(|(_, list)| list.lines().next().unwrap()) {
                assert!(!offered.is_empty(), "{what} is a choice ({list}): offer its names");
                choices += 1;
                // Options inside this one are written, not chosen.
                let list = list.split(", or write NAME=VALUE").next().unwrap();
                for name in list.strip_prefix("one of ").into_iter().flat_map(|list| list.split(", ")) {
                    let name = name.trim_start_matches("or ").split(';').next().unwrap();
                    assert!(offered.contains(&name), "{what} takes {name}, which is not offered");
                }
            }
        }
    }
    assert!(names > 300 && choices > 40, "{names} names of {choices} choices");
}

#[test]
fn groups_of_stress_are_those_its_help_names() {
    let whole = program().command_line();
    let only = whole.find_subcommand("stress").unwrap().get_arguments().find(|arg| arg.get_long() == Some("only"));
    let help = only.unwrap().get_help().unwrap().to_string();
    let listed = help.split_once(": ").unwrap().1.split_once(" [").unwrap().0;
    assert_eq!(listed.split(", ").collect::<Vec<_>>(), stress::GROUPS);
}

#[test]
fn files_are_offered_where_files_are_taken() {
    use clap::ValueHint::{AnyPath, DirPath, FilePath};
    let with_values = with_values(&program());
    let hint = |command: &str, id: &str| {
        let command = with_values.find_subcommand(command).unwrap();
        command.get_arguments().find(|arg| arg.get_id() == id).unwrap().get_value_hint()
    };
    assert_eq!(hint("measure", "output"), DirPath);
    assert_eq!(hint("measure", "merge"), FilePath);
    assert_eq!(hint("compare", "output"), AnyPath);
}
