//! A program's command line, from words to a command that is carried out.

use super::command::{Call, Program, Verdict};
use super::{help, messages, mistakes};
use clap::ArgMatches;
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::time::Instant;
use tinta::{Error, Result};

/// Why a command line is not carried out.
#[derive(Debug)]
enum Stop {
    /// The requested help or version.
    Help(clap::Error),
    /// It is wrong.
    Wrong(Error),
}

impl Program {
    /// The whole command line as clap has it; help lists every option.
    pub fn command_line(&self) -> clap::Command {
        help::whole(self)
    }

    /// Carries out a command line, the program's name first.
    ///
    /// # Errors
    ///
    /// One sentence for a wrong command line, and those of the command.
    pub fn carry_out(&self, words: Vec<OsString>, started: Instant) -> Result<Verdict> {
        let as_given: Vec<String> = words.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
        let matches = match self.parse(words) {
            Ok(matches) => matches,
            Err(Stop::Help(help)) => return messages::print_help(&help).map(|()| Verdict::Good),
            Err(Stop::Wrong(error)) => return Err(error),
        };
        let none = || Error::CommandLine { problem: "a command is missing; see --help".to_owned() };
        let (name, matches) = matches.subcommand().ok_or_else(none)?;
        let command = self.named(name).ok_or_else(none)?;
        let words = tinta::shell::command_line(as_given.into_iter());
        let mut session = super::models::session();
        (command.run)(matches, &mut Call { program: self, words: &words, started, session: &mut session })
    }

    /// Parses a command line, the program's name first, without running it. Returns the text of requested help, or a one-sentence
    /// error.
    ///
    /// # Errors
    ///
    /// The error sentence, as the program prints it.
    pub fn check(&self, words: impl IntoIterator<Item = OsString>) -> std::result::Result<Option<String>, String> {
        match self.parse(super::bare::with_command(words.into_iter().collect(), false).0) {
            Ok(_) => Ok(None),
            Err(Stop::Help(help)) => Ok(Some(help.to_string())),
            Err(Stop::Wrong(error)) => Err(messages::plain(&error.with_dashes().to_string())),
        }
    }

    /// Parses the words, the program's name first.
    fn parse(&self, words: Vec<OsString>) -> std::result::Result<ArgMatches, Stop> {
        let mut whole = help::command(self, &words);
        whole.try_get_matches_from_mut(&words).map_err(|error| match error.kind() {
            ErrorKind::DisplayHelp
            | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
            | ErrorKind::DisplayVersion => Stop::Help(error),
            _ => Stop::Wrong(Error::CommandLine { problem: mistakes::sentence(&error, &whole, &words) }),
        })
    }
}
