//! `tinta generate`: files that a package installs beside the program: manual pages, and a shell's script of completions.

use super::completions::{self, Script};
use super::{Command, Program, Verdict, given, man};
use std::path::PathBuf;
use tinta::{Result, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta generate bash                             print completions for a shell",
        "tinta generate man -o man                       write the manual pages",
    ],
    ..Command::new("generate", <Arguments as clap::Args>::augment_args, |matches, call| {
        run(&given::<Arguments>(matches)?, call.program).map(|()| Verdict::Good)
    })
};

/// Print a shell's completions of commands, options, values and files, or write the manual pages
#[derive(clap::Args)]
#[command(after_help = "Run one of these once; it takes effect in new shells:
  tinta generate bash > ~/.local/share/bash-completion/completions/tinta
  tinta generate zsh > ~/.zfunc/_tinta          with fpath+=~/.zfunc before compinit in ~/.zshrc
  tinta generate fish > ~/.config/fish/completions/tinta.fish
  tinta generate powershell >> $PROFILE
  tinta generate man -o ~/.local/share/man/man1

The folders of shells must exist: mkdir -p creates them. The manual pages are tinta.1, and one for each command, such as \
tinta-render.1; man -l man/tinta.1 shows one of another folder. The Debian package installs all of these.")]
pub(super) struct Arguments {
    /// Shell to complete for, or man
    #[arg(value_name = "WHAT")]
    what: Script,

    /// Folder for the manual pages; created if missing
    #[arg(short, long, value_name = "DIR", required_if_eq("what", "man"))]
    output: Option<PathBuf>,
}

fn run(arguments: &Arguments, program: &Program) -> Result<()> {
    if arguments.what != Script::Man {
        return super::print(&completions::script(arguments.what, program));
    }
    let folder = arguments.output.clone().unwrap_or_default();
    super::make_folder(&folder)?;
    let targets = man::pages(program).into_iter().map(|page| {
        let path = folder.join(&page.file);
        TextTarget::check(&path.to_string_lossy()).map(|target| (target, page.text))
    });
    let targets = targets.collect::<Result<Vec<_>>>()?;
    targets.iter().try_for_each(|(target, text)| target.write(text))
}
