//! The program `tinta`.

fn main() -> std::process::ExitCode {
    tinta::cli::main()
}
