//! The command line out of any bytes: one word a line.

use std::ffi::OsString;

/// Parses the words; the error is one line.
pub fn command_line(bytes: &[u8]) {
    let words = bytes.split(|byte| *byte == b'\n').map(word);
    match tinta_lab::program().check(std::iter::once(OsString::from("tinta")).chain(words)) {
        Ok(help) => assert!(help.is_none_or(|help| !help.is_empty())),
        Err(said) => assert!(said.len() > 8 && !said.contains(char::is_control), "{said}"),
    }
}

#[cfg(unix)]
fn word(bytes: &[u8]) -> OsString {
    <std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(bytes).to_owned()
}

#[cfg(not(unix))]
fn word(bytes: &[u8]) -> OsString {
    String::from_utf8_lossy(bytes).into_owned().into()
}
