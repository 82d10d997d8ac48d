//! A script with which a shell completes commands, options, values and files: clap_complete writes it from the definition that also
//! parses the command line.

mod values;

use super::Program;
use clap_complete::Shell;
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

/// The script of a shell; empty for man.
pub(super) fn script(shell: Script, program: &Program) -> String {
    let shell = match shell {
        Script::Bash => Shell::Bash,
        Script::Zsh => Shell::Zsh,
        Script::Fish => Shell::Fish,
        Script::Powershell => Shell::PowerShell,
        Script::Man => return String::new(),
    };
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut with_values(program), "tinta", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

#[cfg(test)]
mod tests;
