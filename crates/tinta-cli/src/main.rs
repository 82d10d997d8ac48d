//! The program `tinta`: the commands that draw, and those of the laboratory.

fn main() -> std::process::ExitCode {
    tinta::cli::main(&tinta_lab::program())
}
