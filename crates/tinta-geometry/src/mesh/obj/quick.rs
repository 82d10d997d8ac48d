//! Vertices and faces as nearly every file writes them, read byte by byte; whatever else a line may hold is left to the general
//! reader, which says the same of these.

use super::super::NONE;
use super::super::soup::Corner;
use glam::DVec3;

/// A vertex of three plain decimals, from behind its keyword to the end of the line; `None` for anything else.
pub(super) fn vertex(line: &[u8]) -> Option<DVec3> {
    let (x, rest) = decimal(blanks(line))?;
    let (y, rest) = decimal(blanks(rest))?;
    let (z, rest) = decimal(blanks(rest))?;
    rest.trim_ascii_start().is_empty().then_some(DVec3::new(x, y, z))
}

/// Adds a face's corners, whose numbers count from the file's first and are below `most` of positions, texture coordinates and
/// normals; returns how many there are. `None` for anything else; the caller then removes the additions.
pub(super) fn face(line: &[u8], most: [u32; 3], corners: &mut Vec<Corner>) -> Option<usize> {
    let mut rest = blanks(line);
    let before = corners.len();
    while !rest.trim_ascii_start().is_empty() {
        let mut numbers = [NONE; 3];
        (numbers[0], rest) = index(rest, most[0])?;
        for place in [1, 2] {
            let [b'/', behind @ ..] = rest else { break };
            // Nothing between two slashes: no texture coordinate.
            (numbers[place], rest) = match behind {
                [b'/', ..] if place == 1 => (NONE, behind),
                _ => index(behind, most[place])?,
            };
        }
        let [position, texture, normal] = numbers;
        corners.push(Corner { position, normal, texture });
        rest = match rest {
            [b' ', ..] => blanks(rest),
            _ if rest.trim_ascii_start().is_empty() => b"",
            _ => return None,
        };
    }
    Some(corners.len() - before)
}

fn blanks(mut bytes: &[u8]) -> &[u8] {
    while let [b' ', rest @ ..] = bytes {
        bytes = rest;
    }
    bytes
}

/// A number that counts from one, as one that counts from zero, if it is below `most`.
fn index(bytes: &[u8], most: u32) -> Option<(u32, &[u8])> {
    let (number, rest, digits) = digits(bytes, 0);
    let index = u32::try_from(number).ok()?.checked_sub(1)?;
    ((1..=10).contains(&digits) && index < most).then_some((index, rest))
}

/// Reads digits on from a number that some were read of; with how many there were. No more than a `u64` holds for sure.
fn digits(mut bytes: &[u8], mut number: u64) -> (u64, &[u8], usize) {
    let mut count = 0;
    while let [digit @ b'0'..=b'9', rest @ ..] = bytes {
        // Where that is too much the count says so.
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        count += 1;
        bytes = rest;
    }
    (number, bytes, count)
}

/// Powers of ten that f64 holds.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// A decimal without an exponent whose digits and power of ten f64 both holds: one division then rounds it correctly (Clinger
/// 1990); any other is read by the standard library.
fn decimal(bytes: &[u8]) -> Option<(f64, &[u8])> {
    /// Digits that any whole number below 2^53 may have.
    const DIGITS: usize = 15;
    let (is_negative, behind) = match bytes {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, bytes),
    };
    let (whole, rest, before) = digits(behind, 0);
    let (number, rest, after) = match rest {
        [b'.', rest @ ..] => digits(rest, whole),
        _ => (whole, rest, 0),
    };
    let ends = matches!(rest, [] | [b' ' | b'\r' | b'\n', ..]);
    if ends && before + after > 0 && before + after <= DIGITS {
        let number = number as f64 / POWERS[after];
        return Some((if is_negative { -number } else { number }, rest));
    }
    let end = bytes.iter().position(u8::is_ascii_whitespace).unwrap_or(bytes.len());
    let (word, rest) = bytes.split_at(end);
    Some((std::str::from_utf8(word).ok()?.parse().ok()?, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Option<f64> {
        decimal(text.as_bytes()).filter(|(_, rest)| rest.is_empty()).map(|(number, _)| number)
    }

    #[test]
    fn decimals_are_the_standard_librarys_to_the_bit() {
        for text in [
            "0",
            "-0",
            "1",
            "-1",
            "0.1",
            ".5",
            "5.",
            "-.5",
            "123456789012345",
            "1234567890123456",
            "0.1e-3",
            "1E5",
            "+3",
            "inf",
            "NaN",
            "0.000000000000001",
            "99999999999999.9",
            "9007199254740993",
            "1e400",
            "00000000000000000001",
        ] {
            let (own, other) = (read(text).map(f64::to_bits), text.parse::<f64>().ok().map(f64::to_bits));
            assert_eq!(own, other, "{text}");
        }
        for text in ["", "-", ".", "-.", "x", "1x", "1..2", "1-2", "--1"] {
            assert_eq!((read(text), text.parse::<f64>().ok()), (None, None), "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_decimal_is_the_standard_librarys_to_the_bit(number: f64, places in 0usize..18) {
            for text in [format!("{number}"), format!("{number:e}"), format!("{:.places$}", number % 1e6)] {
                prop_assert_eq!(read(&text).map(f64::to_bits), text.parse::<f64>().ok().map(f64::to_bits), "{}", text);
            }
        }
    }

    #[test]
    fn faces_in_every_plain_form_are_read_and_others_left() {
        let face = |line: &str| {
            let mut corners = Vec::new();
            face(line.as_bytes(), [9, 5, 4], &mut corners).map(|count| {
                assert_eq!(count, corners.len());
                corners.into_iter().map(|corner| [corner.position, corner.texture, corner.normal]).collect::<Vec<_>>()
            })
        };
        assert_eq!(face(" 1 2  3\r\n").unwrap(), [[0, NONE, NONE], [1, NONE, NONE], [2, NONE, NONE]]);
        assert_eq!(face("9/5/4 8//3 7/2 ").unwrap(), [[8, 4, 3], [7, NONE, 2], [6, 1, NONE]]);
        assert_eq!(face("").unwrap(), [[0; 3]; 0]);
        for other in [
            "0 1 2",
            "1 2 10",
            "1/6 2 3",
            "1//5 2 3",
            "-1 1 2",
            "+1 2 3",
            "1/ 2 3",
            "1// 2 3",
            "1/1/1/1 2 3",
            "1\t2 3",
            "1 2 3 # three",
            "1 2 x",
            "1 2 99999999999999999999",
        ] {
            assert_eq!(face(other), None, "{other}");
        }
    }

    #[test]
    fn vertices_of_three_numbers_are_read_and_others_left() {
        assert_eq!(vertex(b"1 -2.5  3e1\r\n"), Some(DVec3::new(1.0, -2.5, 30.0)));
        for other in [&b"1 2"[..], b"1 2 3 1", b"1 2 3 # c", b"1 2 x", b"1,2,3", b"1 2\t3 4"] {
            assert_eq!(vertex(other), None, "{}", String::from_utf8_lossy(other));
        }
    }
}
