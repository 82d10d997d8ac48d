//! The program run as a user runs it.

use crate::support::root;
use std::process::{Command, Output};

/// Its output for these arguments, in the project's folder.
pub fn tinta(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tinta")).args(arguments).current_dir(root()).output().unwrap()
}

/// Its output for arguments with which it succeeds.
pub fn done(arguments: &[&str]) -> Output {
    let output = tinta(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", said(&output));
    output
}

/// Its standard output for arguments with which it succeeds and says nothing.
pub fn silent(arguments: &[&str]) -> Vec<u8> {
    let output = done(arguments);
    assert_eq!(said(&output), "", "{arguments:?}");
    output.stdout
}

/// Its answer, as JSON.
pub fn answer(arguments: &[&str]) -> serde_json::Value {
    serde_json::from_slice(&done(arguments).stdout).unwrap()
}

/// Its standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
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
    let output = tinta(arguments);
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_refused(&output, words);
}

/// Asserts exit code 2, by no signal, and one line as [`one_line`] wants it.
pub fn assert_refused(output: &Output, words: &[&str]) {
    assert_eq!(output.status.code(), Some(2), "{:?}: {}", output.status, said(output));
    one_line(&said(output), words);
}

/// Asserts that a message is one line that contains `words` and no terminal control characters.
pub fn one_line(message: &str, words: &[&str]) {
    assert_eq!(message.matches('\n').count(), 1, "{message:?}");
    assert!(message.len() < 1000 && !message.trim_end().contains(|c: char| c.is_control()), "{message:?}");
    assert!(!message.contains("panicked"), "{message:?}");
    for word in words {
        assert!(message.contains(word), "should say {word:?}: {message:?}");
    }
}
