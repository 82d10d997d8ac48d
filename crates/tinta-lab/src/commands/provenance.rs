//! `tinta provenance`: the origin of each value of a style.

use crate::provenance::{page, text};
use tinta::cli::messages::print;
use tinta::cli::{Command, Verdict, given};
use tinta::{Result, StyleName};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta provenance three-pass                     which values a text prints"],
    ..Command::new("provenance", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// Show which values of a style its text prints, which follow from it, and which are tinta's
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Style [default: all]
    #[arg(value_name = "STYLE")]
    style: Option<StyleName>,

    /// Write all styles as one page of tables, with the numbers in shaders [default: off]
    #[arg(long, conflicts_with = "style")]
    markdown: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    print(&if arguments.markdown { page() } else { text(arguments.style) })
}
