//! Compares the scripts with the options of the command line.

use super::*;
use crate::cli::help;
use clap::Command;

const SHELLS: [Script; 4] = [Script::Bash, Script::Zsh, Script::Fish, Script::Powershell];

fn whole() -> Command {
    let mut whole = Program::default().command_line().disable_help_subcommand(true);
    whole.build();
    whole
}

/// A script's part for one command.
fn part(shell: Script, script: &str, command: &str) -> String {
    let between = |start: &str, end: &str| {
        let rest = script.split_once(start).unwrap_or_else(|| panic!("{command}: no {start:?}")).1;
        rest.split_once(end).unwrap().0.to_owned()
    };
    match shell {
        Script::Bash => between(&format!("\n        tinta__subcmd__{command})\n"), "\n            ;;"),
        Script::Zsh => between(&format!("({command})\n_arguments"), "\n;;"),
        Script::Powershell => between(&format!("\n        'tinta;{command}' {{"), "\n            break"),
        Script::Man => String::new(),
        Script::Fish => {
            let start = format!("complete -c tinta -n \"__fish_tinta_using_subcommand {command}\"");
            script.lines().filter(|line| line.starts_with(&start)).collect::<Vec<_>>().join("\n") + "\n"
        }
    }
}

#[test]
fn every_command_and_long_option_is_in_every_script() {
    let whole = whole();
    for shell in SHELLS {
        let script = script(shell, &Program::default());
        let mut options = 0;
        for command in whole.get_subcommands() {
            let name = command.get_name();
            let is_named = match shell {
                Script::Bash => script.contains(&format!("tinta,{name})")),
                Script::Zsh => script.contains(&format!("'{name}:")),
                Script::Fish => script.contains(&format!("-a \"{name}\" -d ")),
                Script::Powershell => script.contains(&format!("::new('{name}', '{name}', ")),
                Script::Man => false,
            };
            assert!(is_named, "{shell:?} does not know {name}");
            let part = part(shell, &script, name);
            for option in help::options(command).filter_map(|arg| arg.get_long()) {
                let is_there = match shell {
                    Script::Bash => part.split([' ', '"', '\n']).any(|word| word == format!("--{option}")),
                    Script::Zsh => part.contains(&format!("--{option}[")) || part.contains(&format!("--{option}=[")),
                    Script::Fish => part.contains(&format!(" -l {option} ")),
                    Script::Powershell => part.contains(&format!("::new('--{option}', ")),
                    Script::Man => false,
                };
                assert!(is_there, "{shell:?} does not know {name} --{option}");
                options += 1;
            }
        }
        assert!(options > 150, "{shell:?}: only {options} options");
    }
}

#[test]
fn files_are_offered_where_files_are_taken_and_nothing_where_numbers_are() {
    use clap::ValueHint::{DirPath, FilePath, Other};
    let with_values = with_values(&Program::default());
    let hint = |command: &str, id: &str| {
        let command = with_values.find_subcommand(command).unwrap();
        command.get_arguments().find(|arg| arg.get_id() == id).unwrap().get_value_hint()
    };
    assert_eq!(hint("render", "models"), FilePath);
    assert_eq!(hint("render", "output"), FilePath);
    assert_eq!(hint("render", "preset"), FilePath);
    assert_eq!(hint("render", "dump"), DirPath);
    assert_eq!(hint("again", "picture"), FilePath);
    assert_eq!(hint("render", "fov"), Other);
    assert_eq!(hint("render", "background"), Other);
}
