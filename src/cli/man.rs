//! A manual page for the program and one for each command: clap_mangen writes them from the definition that also reads the command
//! line.

use super::Program;
use clap::Command;
use clap_mangen::Man;

/// A manual page.
pub(super) struct Page {
    /// Its file: `tinta-render.1`.
    pub file: String,
    /// The page in man's language.
    pub text: String,
}

/// The pages of the program and of each command.
pub(super) fn pages(program: &Program) -> Vec<Page> {
    let mut whole = program.command_line().disable_help_subcommand(true);
    whole.build();
    let commands: Vec<Command> = whole.get_subcommands().cloned().collect();
    std::iter::once(whole).chain(commands).map(page).collect()
}

/// The page of a command.
pub(super) fn page(command: Command) -> Page {
    let title = command.get_display_name().unwrap_or("tinta").to_owned();
    let usage = command.clone().render_usage().to_string();
    let usage = usage.strip_prefix("Usage: ").unwrap_or(&usage).to_owned();
    let mut text = Vec::new();
    // Writing into memory does not fail.
    let _ = Man::new(command.override_usage(usage)).title(&title).render(&mut text);
    Page { file: format!("{title}.1"), text: String::from_utf8_lossy(&text).into_owned() }
}

#[cfg(test)]
mod tests;
