//! The commands of the laboratory, one file each.

mod compare;
#[cfg(all(test, feature = "judging", feature = "window"))]
mod documents_tests;
#[cfg(feature = "measuring")]
mod figures;
#[cfg(feature = "judging")]
mod judge;
#[cfg(feature = "measuring")]
mod measure;
#[cfg(all(test, feature = "judging"))]
mod offered_tests;
#[cfg(all(test, feature = "judging"))]
mod option_pictures_tests;
#[cfg(feature = "measuring")]
mod stress;
mod why;

use tinta::cli::{Command, Program};

/// The commands of this package, as help lists them.
const COMMANDS: &[Command] = &[
    why::COMMAND,
    compare::COMMAND,
    #[cfg(feature = "measuring")]
    measure::COMMAND,
    #[cfg(feature = "judging")]
    judge::COMMAND,
    #[cfg(feature = "measuring")]
    figures::COMMAND,
    #[cfg(feature = "measuring")]
    stress::COMMAND,
];

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
