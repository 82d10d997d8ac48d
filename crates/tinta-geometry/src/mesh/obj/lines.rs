//! An OBJ file's lines, and where the file may be cut between them.

use super::super::NONE;
use super::super::number::not_finite;
use std::borrow::Cow;

/// The lines of a text; a line that ends in a backslash continues on the next one.
pub(super) struct Lines<'a> {
    rest: &'a str,
    /// How many lines of the text were handed out, those that continue others counted too.
    pub number: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, number: 0 }
    }

    /// The next line up to its newline.
    fn one(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = memchr::memchr(b'\n', self.rest.as_bytes()).map_or(self.rest.len(), |end| end + 1);
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        Some(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Cow<'a, str>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = self.one()?;
        let Some(mut text) = continued(line) else { return Some(Cow::Borrowed(line)) };
        let mut joined = String::new();
        loop {
            joined.push_str(text);
            joined.push(' ');
            line = self.one().unwrap_or_default();
            match continued(line) {
                Some(more) => text = more,
                None => {
                    joined.push_str(line);
                    return Some(Cow::Owned(joined));
                }
            }
        }
    }
}

/// A line that continues on the next one, without its backslash.
fn continued(line: &str) -> Option<&str> {
    // Nearly every line ends in a digit; only behind other than ASCII a backslash may hide.
    if line.as_bytes().trim_ascii_end().last().is_some_and(|last| last.is_ascii() && *last != b'\\') {
        return None;
    }
    line.trim_end().strip_suffix('\\').filter(|text| comment(text).is_none())
}

/// Cuts a file into pieces of at least `length` bytes, each of whole lines with those that continue them.
pub(super) fn pieces(bytes: &[u8], length: usize) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        let mut end = length.clamp(1, rest.len());
        loop {
            end += memchr::memchr(b'\n', &rest[end..]).map_or(rest.len() - end, |newline| newline + 1);
            let start = memchr::memrchr(b'\n', &rest[..end - 1]).map_or(0, |newline| newline + 1);
            if end == rest.len() || continued(&String::from_utf8_lossy(&rest[start..end])).is_none() {
                break;
            }
        }
        let (piece, others) = rest.split_at(end);
        pieces.push(piece);
        rest = others;
    }
    pieces
}

/// Where a text's comment begins: at its first `#` that is not within a number such as `1.#INF`.
fn comment(text: &str) -> Option<usize> {
    let is_in_number = |place: usize| {
        let before = text[..place].rsplit(char::is_whitespace).next().unwrap_or_default();
        let word = text[place - before.len()..].split_whitespace().next();
        word.is_some_and(|word| not_finite(word).is_some())
    };
    text.match_indices('#').map(|(place, _)| place).find(|place| !is_in_number(*place))
}

/// Words without the comment behind them. Between them other white space than ASCII's becomes a blank.
pub(super) fn plain(words: &str) -> Cow<'_, str> {
    const VERTICAL_TAB: u8 = 0x0b;
    if words.is_ascii() && memchr::memchr2(b'#', VERTICAL_TAB, words.as_bytes()).is_none() {
        return Cow::Borrowed(words);
    }
    let text = comment(words).map_or(words, |start| &words[..start]);
    Cow::Owned(text.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// A 1-based or negative, relative index as a 0-based one: [`NONE`] for an empty field, [`NONE`] - 1 for what can never be
/// in range, `None` for what is no whole number. `count` is how many there are so far.
pub(super) fn resolve(field: &[u8], count: u32) -> Option<u32> {
    let (is_relative, digits) = match field {
        [] => return Some(NONE),
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() {
        return None;
    }
    let mut number = 0i64;
    for digit in digits {
        let digit = digit.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        number = number.saturating_mul(10).saturating_add(i64::from(digit));
    }
    let index = match number {
        0 => -1,
        _ if is_relative => i64::from(count) - number,
        _ => number - 1,
    };
    Some(u32::try_from(index).unwrap_or(NONE - 1).min(NONE - 1))
}
