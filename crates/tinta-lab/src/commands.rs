//! The commands of the laboratory, one file each.

mod compare;
#[cfg(all(test, feature = "window"))]
mod documents_tests;
mod figures;
mod judge;
mod measure;
#[cfg(test)]
mod offered_tests;
#[cfg(test)]
mod option_pictures_tests;
mod stress;
mod why;

use tinta::cli::{Command, Program};

/// The commands of this package, as help lists them.
const COMMANDS: &[Command] =
    &[why::COMMAND, compare::COMMAND, measure::COMMAND, judge::COMMAND, figures::COMMAND, stress::COMMAND];

/// The commands of this package, as help lists them.
pub fn commands() -> &'static [Command] {
    COMMANDS
}

/// The program with all commands.
pub fn program() -> Program {
    let program = Program::default().with(COMMANDS.iter().copied());
    #[cfg(feature = "window")]
    let program = program.measuring_lines_by(crate::line_measure());
    program
}
