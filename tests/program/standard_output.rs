//! Full or closed standard output: the loss of output is reported.

#![cfg(target_os = "linux")]

use crate::program::{assert_refused, said, tinta};
use crate::support::{Folder, root};
use std::fs::File;
use std::process::Command;

#[test]
fn help_versions_scripts_and_pages_that_cannot_be_written_are_errors() {
    for arguments in [
        "--help",
        "-h",
        "--version",
        "help",
        "render --help",
        "help batch",
        "stress -h",
        "generate bash",
        "generate zsh",
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
        let output = command.args(arguments.split(' ')).stdout(full).output().unwrap();
        assert_refused(&output, &["standard output cannot be written"]);
        // As usual, if possible.
        let output = tinta(&arguments.split(' ').collect::<Vec<_>>());
        assert!(output.status.success() && !output.stdout.is_empty() && output.stderr.is_empty(), "{arguments}");
    }
}

#[test]
fn a_result_for_closed_standard_output_is_refused_before_the_work() {
    let folder = Folder::new();
    let run = |script: &str| {
        let program = env!("CARGO_BIN_EXE_tinta");
        Command::new("sh").args(["-c", script, "sh", program]).current_dir(root()).output().unwrap()
    };
    for arguments in [
        // A missing model would be noticed later.
        "render no-such.obj -o -",
        "render no-such.obj --style lines -o -",
        "compare no-such.obj -o -",
        "info",
        "info builtin:ant",
        "--help",
        "render --help",
        "--version",
        "generate fish",
    ] {
        assert_refused(&run(&format!("\"$1\" {arguments} >&-")), &["standard output is closed; name a file"]);
    }
    // Writing to a file needs no standard output.
    let picture = folder.path("a.png");
    let output = run(&format!("\"$1\" render builtin:ant --size 32 -o {picture} >&-"));
    assert!(output.status.success(), "{}", said(&output));
    assert_eq!(image::image_dimensions(&picture).unwrap(), (32, 32));
    // Redirection to /dev/null also works.
    assert!(run("\"$1\" render builtin:ant --size 32 -o - >/dev/null").status.success());
}
