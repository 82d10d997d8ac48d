//! Command lines as a shell takes them, for files and reports that carry the command that made them.
//!
//! ```
//! assert_eq!(tinta::shell::quoted("my cow.obj"), "'my cow.obj'");
//! assert_eq!(tinta::shell::quoted("cow.obj"), "cow.obj");
//! ```

/// The program's name and its words, quoted where needed.
pub(crate) fn command_line(words: impl Iterator<Item = String>) -> String {
    words.fold("tinta".to_owned(), |text, word| text + " " + &quoted(&word))
}

/// A word, quoted for a shell.
pub fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_=+,.:/@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
