//! `tinta stress`: runs extreme cases and prints their verdicts.

use crate::stress::{StressSettings, Summary, run as stress};
use std::path::PathBuf;
use tinta::cli::progress::Progress;
use tinta::cli::{Command, Verdict, given};
use tinta::{Result, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta stress -o stress                          test with extreme cases"],
    offers: |option| if option == "only" { GROUPS.to_vec() } else { Vec::new() },
    ..Command::new("stress", <Arguments as clap::Args>::augment_args, |matches, _| run(&given::<Arguments>(matches)?))
};

/// Test the program with extreme cases and print each verdict
#[derive(clap::Args)]
#[command(after_help = "\
Files: stress.json has every case in every style by every backend, with its verdict and figures; stress.md is the same as a \
table. A missing backend is skipped, and both files and standard error say so; without any backend no case \
runs. Exit code: 0 if every case ends as it must, 1 otherwise. docs/results/stability.md explains the figures.")]
pub(super) struct Arguments {
    /// Folder to write into; created if missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Try only cases whose name contains this, or one group: scale, depth, topology, thresholds, pictures, inputs, mixes, turns, files, faults [default: all]
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,

    /// Seed of the random mixes [default: 0]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    seed: u64,

    /// Number of random mixes, 0 to 10000 [default: 24]
    #[arg(long, value_name = "N", default_value_t = 24, hide_default_value = true, value_parser = clap::value_parser!(u16).range(0..=10_000))]
    mixes: u16,

    /// Print stress.json to standard output too [default: off]
    #[arg(long)]
    json: bool,
}

/// Runs the cases, writes both files, prints the table's end.
pub(super) fn run(arguments: &Arguments) -> Result<Verdict> {
    let settings = StressSettings {
        seed: arguments.seed,
        mixes: usize::from(arguments.mixes),
        only: arguments.only.clone(),
        ..StressSettings::default()
    };
    settings.check()?;
    tinta::cli::make_folder(&arguments.output)?;
    let target = |name: &str| TextTarget::check(&arguments.output.join(name).to_string_lossy());
    let (json, table) = (target("stress.json")?, target("stress.md")?);
    let progress = Progress::new("attacking", 0);
    let summary = stress(&settings, |done, count| progress.set(done as u64, count as u64))?;
    drop(progress);
    for missing in &summary.missing {
        tinta::cli::say(&format!(
            "tinta: {} is missing ({}): the cases are tried without it, and no two backends are compared",
            missing.backend, missing.reason
        ));
    }
    let record = tinta::cli::json_text(&summary)?;
    json.write(&record)?;
    table.write(&summary.table())?;
    if arguments.json {
        tinta::cli::print(&record)?;
    } else {
        tinta::cli::print(&said(&summary))?;
    }
    Ok(if summary.failures().next().is_none() { Verdict::Good } else { Verdict::Different })
}

/// Each case that failed, and how many did not.
fn said(summary: &Summary) -> String {
    let mut text = String::new();
    for row in summary.failures() {
        let remark = row.remark.as_deref().unwrap_or_default();
        text += &format!("FAILED {}, {}, {}: {} ({remark})\n", row.name, row.style, row.backend, row.verdict);
    }
    let failed = summary.failures().count();
    text + &format!(
        "{} cases, {} pictures and refusals: {} as they must be, {failed} not\n",
        summary.case_count,
        summary.cases.len(),
        summary.cases.len() - failed
    )
}

/// Groups of cases that `--only` names.
pub(super) const GROUPS: [&str; 10] =
    ["scale", "depth", "topology", "thresholds", "pictures", "inputs", "mixes", "turns", "files", "faults"];
