//! A script with which a shell completes commands, options, values and files.
//!
//! clap_complete writes the scripts from the definition that also parses the command line. This module adds two things: a model
//! or preset is either a built-in one or a file, and in bash a word may hold a colon or an equals sign.

mod values;

use super::Program;
use clap::Command;
use clap_complete::Shell as Written;
use tinta::mesh::BUILTINS;
use tinta::preset::SHIPPED;
pub use values::{of_table, with_values};

/// What is generated: a shell's script, or the manual pages, which are no script.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Script {
    Bash,
    Zsh,
    Fish,
    Powershell,
    Man,
}

/// Options that take a preset, and arguments that take models.
const PRESET: &str = "preset";
const MODELS: [&str; 2] = ["models", "model"];

/// The script of a shell; empty for man.
pub(super) fn script(shell: Script, program: &Program) -> String {
    let command = with_values(program);
    let written = |shell: Written| {
        let mut script = Vec::new();
        clap_complete::generate(shell, &mut command.clone(), "tinta", &mut script);
        String::from_utf8_lossy(&script).into_owned()
    };
    match shell {
        Script::Bash => bash(&command, &written(Written::Bash)),
        Script::Zsh => zsh(&written(Written::Zsh)),
        Script::Fish => fish(&command, &written(Written::Fish)),
        Script::Powershell => written(Written::PowerShell),
        Script::Man => String::new(),
    }
}

/// The script first joins words, then calls clap's function: `src/cli/completions/words.bash`.
fn bash(command: &Command, written: &str) -> String {
    let words = include_str!("completions/words.bash")
        .replace("@models@", &models().join(" "))
        .replace("@presets@", &presets().join(" "))
        .replace("@with-models@", &with_models(command).join("|"))
        .replace("@with-value@", &with_value(command).join("|"));
    written.replace("complete -F _tinta ", "complete -F _tinta_words ") + "\n" + &words
}

/// Where clap offers only files, `src/cli/completions/names.zsh` also offers built-in names.
fn zsh(written: &str) -> String {
    let escaped = |names: Vec<String>| names.join(" ").replace(':', "\\:");
    let names = include_str!("completions/names.zsh")
        .replace("@models@", &escaped(models()))
        .replace("@presets@", &escaped(presets()));
    let asks_for_model = |line: &str| MODELS.iter().any(|id| line.contains(&format!(":{id} -- ")));
    let lines = written.lines().map(|line| {
        let better = if asks_for_model(line) {
            line.replace(":_files' \\", ":_tinta_models' \\")
        } else if line.contains(&format!("--{PRESET}=[")) {
            line.replace(":_files' \\", ":_tinta_presets' \\")
        } else {
            line.to_owned()
        };
        // The script's last lines call the functions it defines.
        if line.starts_with("if [ \"$funcstack[1]\"") { format!("{names}\n{better}\n") } else { better + "\n" }
    });
    lines.collect()
}

/// fish combines the suggestions of several lines.
fn fish(command: &Command, written: &str) -> String {
    let mut script = written.to_owned();
    for name in with_models(command) {
        for builtin in BUILTINS {
            script.push_str(&format!(
                "complete -c tinta -n \"__fish_tinta_using_subcommand {name}\" -a \"builtin:{}\" -d '{}'\n",
                builtin.name, builtin.what
            ));
        }
    }
    for command in command.get_subcommands() {
        // clap's own script omits positional arguments.
        for arg in command.get_positionals().filter(|arg| !arg.get_possible_values().is_empty()) {
            let names: Vec<String> =
                arg.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
            script.push_str(&format!(
                "complete -c tinta -n \"__fish_tinta_using_subcommand {}\" -f -a \"{}\"\n",
                command.get_name(),
                names.join(" ")
            ));
        }
        if command.get_arguments().any(|arg| arg.get_long() == Some(PRESET)) {
            script.push_str(&format!(
                "complete -c tinta -n \"__fish_tinta_using_subcommand {}\" -l {PRESET} -r -F -a \"{}\"\n",
                command.get_name(),
                presets().join(" ")
            ));
        }
    }
    script
}

fn models() -> Vec<String> {
    BUILTINS.iter().map(|builtin| format!("builtin:{}", builtin.name)).collect()
}

fn presets() -> Vec<String> {
    SHIPPED.iter().map(|(name, _)| (*name).to_owned()).collect()
}

/// The commands that are given models.
fn with_models(command: &Command) -> Vec<&str> {
    let takes_models =
        |command: &&Command| command.get_positionals().any(|arg| MODELS.contains(&arg.get_id().as_str()));
    command.get_subcommands().filter(takes_models).map(Command::get_name).collect()
}

/// All commands' options that a value must follow, short and long.
fn with_value(command: &Command) -> Vec<String> {
    let arguments = command.get_subcommands().flat_map(Command::get_arguments);
    let taking = arguments.filter(|arg| values::takes_value(arg) && !arg.is_require_equals_set());
    let names = taking.flat_map(|arg| {
        let short = arg.get_short().map(|short| format!("-{short}"));
        short.into_iter().chain(arg.get_long().map(|long| format!("--{long}")))
    });
    names.collect::<std::collections::BTreeSet<_>>().into_iter().collect()
}

#[cfg(test)]
mod tests;
