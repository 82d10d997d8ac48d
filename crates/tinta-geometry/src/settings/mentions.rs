//! Options that a sentence mentions as the command line writes them, for doors that write them otherwise.

/// Returns the sentence with each `--name` as `write` has it. That is given the text before, the name, and the text up to the next
/// option, which it returns with the name; `None` leaves both.
pub fn with_mentions(sentence: &str, write: impl Fn(&str, &str, &str) -> Option<String>) -> String {
    let mut parts = sentence.split("--");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let is_of_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        let end = part.find(|c| !is_of_name(c)).unwrap_or(part.len());
        let (name, rest) = part.split_at(end);
        text += &write(&text, name, rest).unwrap_or_else(|| format!("--{part}"));
    }
    text
}
