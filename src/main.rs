//! The command line: parse, call the library, print the error, choose the exit code.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(cli::Verdict::Good) => ExitCode::SUCCESS,
        Ok(cli::Verdict::Different) => ExitCode::FAILURE,
        Err(error) => {
            cli::say(&format!("tinta: {error}"));
            ExitCode::from(2)
        }
    }
}
