//! The command line: parse, call the library, print the error, choose the exit code.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    outlive_the_limit_on_files();
    match cli::run() {
        Ok(cli::Verdict::Good) => ExitCode::SUCCESS,
        Ok(cli::Verdict::Different) => ExitCode::FAILURE,
        // As a shell says it of a program that a signal has ended.
        Ok(cli::Verdict::Stopped { signal }) => ExitCode::from(128 + signal),
        Err(error) => {
            cli::say(&format!("tinta: {}", error.with_dashes()));
            // EX_TEMPFAIL of sysexits.h: the same will go later.
            ExitCode::from(if matches!(error, tinta::Error::Busy { .. }) { 75 } else { 2 })
        }
    }
}

/// Lets a write beyond the limit on files' sizes (`ulimit -f`) fail like any other, whoever writes, the GL driver too: by
/// default it ends the program by a signal. A handler that does nothing is the safe way to ignore it.
fn outlive_the_limit_on_files() {
    // Where it cannot be had the program is as it would be without.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}
