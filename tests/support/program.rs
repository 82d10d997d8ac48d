//! The program run as a user runs it.

use crate::support::root;
use std::process::{Command, Output};

/// Its output for these arguments, in the project's folder.
pub fn tinta(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tinta")).args(arguments).current_dir(root()).output().unwrap()
}

/// Asserts exit code 2, empty standard output and one sentence that contains all `words`.
pub fn refused(arguments: &[&str], words: &[&str]) {
    let output = tinta(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    for word in words {
        assert!(message.contains(word), "{arguments:?} should say {word:?} but says {message:?}");
    }
    assert!(!message.contains("panicked"), "{message}");
}

/// Like [`refused`], in one line.
pub fn refused_in_one_line(arguments: &[&str], words: &[&str]) {
    refused(arguments, words);
    let message = String::from_utf8_lossy(&tinta(arguments).stderr).into_owned();
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
}
