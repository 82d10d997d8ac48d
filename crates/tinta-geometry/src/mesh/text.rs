//! A text file's bytes as UTF-8 whose lines end in newlines.
//!
//! Some programs write UTF-16, and old ones end lines with a carriage return alone. Readers see neither.

use std::borrow::Cow;

/// A model file's bytes without a byte order mark, and from UTF-16 in UTF-8.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, rest @ ..] => Cow::Owned(of_utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(of_utf16(rest, u16::from_be_bytes)),
        _ => Cow::Borrowed(bytes),
    }
}

/// A text with a newline for each carriage return, where those alone end its lines.
pub(super) fn with_newlines(text: &[u8]) -> Cow<'_, [u8]> {
    match memchr::memchr(b'\n', text).is_none() && memchr::memchr(b'\r', text).is_some() {
        false => Cow::Borrowed(text),
        true => Cow::Owned(text.iter().map(|byte| if *byte == b'\r' { b'\n' } else { *byte }).collect()),
    }
}

/// The bytes that a format is recognised by.
pub(super) fn head(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(4096)]
}

fn of_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Vec<u8> {
    let units = bytes.as_chunks::<2>().0.iter().map(|pair| unit(*pair));
    let characters = char::decode_utf16(units).map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER));
    characters.collect::<String>().into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_16_of_both_byte_orders_and_utf_8_with_a_mark_are_the_same_text() {
        let text = "v 1 2 3 # é 𝄞\n";
        let units: Vec<u16> = std::iter::once(0xfeff).chain(text.encode_utf16()).collect();
        let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
        let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
        let marked = [b"\xef\xbb\xbf", text.as_bytes()].concat();
        for bytes in [little.as_slice(), &big, &marked, text.as_bytes()] {
            assert_eq!(decoded(bytes), text.as_bytes());
        }
        assert_eq!(decoded(&[0xff, 0xfe, 0, 0xd8]), "\u{fffd}".as_bytes(), "half a character");
    }

    #[test]
    fn carriage_returns_become_newlines_only_where_they_alone_end_lines() {
        assert_eq!(&*with_newlines(b"a\rb\r"), b"a\nb\n");
        for text in [&b"a\r\nb"[..], b"a\nb\rc", b"a", b""] {
            assert_eq!(&*with_newlines(text), text);
        }
    }
}
