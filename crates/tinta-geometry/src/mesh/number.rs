//! Numbers in text files. NaN and infinity are read as every system's C library writes them.

use std::str::FromStr;

/// A word as an `f32` or `f64`; `None` if it is no number.
pub(super) fn number<T: FromStr + From<f32>>(word: &str) -> Option<T> {
    word.parse().ok().or_else(|| not_finite(word).map(T::from))
}

/// What Microsoft's C library writes after `1.#`: whole, or rounded like digits to fewer places.
const AFTER_HASH: [&str; 11] = ["INF", "IND", "QNAN", "SNAN", "QNB", "SNB", "IO", "QO", "SO", "J", "R"];

/// NaN or infinity in the spellings that Rust does not read: `-nan(ind)`, `nan(0x7)`, `1.#QNAN`, `-1.#INF00`.
pub(super) fn not_finite(word: &str) -> Option<f32> {
    let (sign, rest) = match word.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, word.strip_prefix('+').unwrap_or(word)),
    };
    if let Some(name) = rest.strip_prefix("1.#") {
        // Zeros or an exponent may follow.
        let name = name.trim_end_matches(|letter: char| letter.is_ascii_digit() || "e+-".contains(letter));
        return AFTER_HASH.contains(&name).then_some(if name == "INF" { sign * f32::INFINITY } else { f32::NAN });
    }
    let is_nan = rest.ends_with(')') && rest.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("nan("));
    is_nan.then_some(f32::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_and_infinity_are_read_as_every_c_library_writes_them() {
        for word in [
            "nan",
            "-nan",
            "NaN",
            "-nan(ind)",
            "nan(snan)",
            "NAN(0x7ff)",
            "1.#IND",
            "-1.#IND",
            "-1.#IND00",
            "1.#QNAN",
            "1.#QNAN0",
            "1.#SNAN",
            "1.#J",
            "-1.#J",
            "1.#IO",
            "1.#QO",
            "1.#R",
            "1.#QNBe+000",
        ] {
            assert!(number::<f64>(word).unwrap().is_nan() && number::<f32>(word).unwrap().is_nan(), "{word}");
        }
        for word in ["inf", "Infinity", "1.#INF", "+1.#INF", "1.#INF00", "1.#INFe+000", "1e999"] {
            assert_eq!(number::<f64>(word), Some(f64::INFINITY), "{word}");
            assert_eq!(number::<f64>(&format!("-{}", word.trim_start_matches('+'))), Some(f64::NEG_INFINITY), "{word}");
        }
        assert_eq!((number("1.5"), number("-2e3")), (Some(1.5f32), Some(-2e3)));
    }

    #[test]
    fn other_words_are_no_numbers() {
        for word in ["", "x", "1.#", "1.#a", "1.#Inline", "1.#INFx", "2.#INF", "nan(", "nan)", "nano(1)", "é", "--1.#J"]
        {
            assert_eq!((number::<f64>(word), number::<f32>(word)), (None, None), "{word}");
        }
    }
}
