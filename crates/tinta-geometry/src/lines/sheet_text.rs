//! Words and numbers as strokes, which a pen and a picture of pixels draw like lines.

use glam::DVec2;

/// A sign's lines: x in halves of the height, y from the top in tenths of it.
type Sign = &'static [&'static [[i8; 2]]];

/// Digits of two squares one above the other, capitals for the letters, and the small letters of units.
const SIGNS: &[(char, Sign)] = &[
    ('0', &[&[[0, 0], [1, 0], [1, 10], [0, 10], [0, 0]]]),
    ('1', &[&[[0, 2], [1, 0], [1, 10]]]),
    ('2', &[&[[0, 0], [1, 0], [1, 5], [0, 5], [0, 10], [1, 10]]]),
    ('3', &[&[[0, 0], [1, 0], [1, 5], [0, 5], [1, 5], [1, 10], [0, 10]]]),
    ('4', &[&[[0, 0], [0, 5], [1, 5], [1, 0], [1, 10]]]),
    ('5', &[&[[1, 0], [0, 0], [0, 5], [1, 5], [1, 10], [0, 10]]]),
    ('6', &[&[[1, 0], [0, 0], [0, 10], [1, 10], [1, 5], [0, 5]]]),
    ('7', &[&[[0, 0], [1, 0], [1, 10]]]),
    ('8', &[&[[0, 0], [1, 0], [1, 10], [0, 10], [0, 0], [0, 5], [1, 5]]]),
    ('9', &[&[[1, 5], [0, 5], [0, 0], [1, 0], [1, 10], [0, 10]]]),
    ('.', &[&[[0, 9], [0, 10]]]),
    (':', &[&[[0, 3], [0, 4]], &[[0, 9], [0, 10]]]),
    ('A', &[&[[0, 10], [0, 0], [1, 0], [1, 10]], &[[0, 5], [1, 5]]]),
    ('E', &[&[[1, 0], [0, 0], [0, 10], [1, 10]], &[[0, 5], [1, 5]]]),
    ('F', &[&[[1, 0], [0, 0], [0, 10]], &[[0, 5], [1, 5]]]),
    ('G', &[&[[1, 0], [0, 0], [0, 10], [1, 10], [1, 5]]]),
    ('H', &[&[[0, 0], [0, 10]], &[[1, 0], [1, 10]], &[[0, 5], [1, 5]]]),
    ('L', &[&[[0, 0], [0, 10], [1, 10]]]),
    ('O', &[&[[0, 0], [1, 0], [1, 10], [0, 10], [0, 0]]]),
    ('P', &[&[[0, 10], [0, 0], [1, 0], [1, 5], [0, 5]]]),
    ('R', &[&[[0, 10], [0, 0], [1, 0], [1, 5], [0, 5], [1, 10]]]),
    ('S', &[&[[1, 0], [0, 0], [0, 5], [1, 5], [1, 10], [0, 10]]]),
    ('T', &[&[[0, 0], [2, 0]], &[[1, 0], [1, 10]]]),
    ('C', &[&[[1, 0], [0, 0], [0, 10], [1, 10]]]),
    ('I', &[&[[0, 0], [0, 10]]]),
    ('N', &[&[[0, 10], [0, 0], [1, 10], [1, 0]]]),
    // Of the units alone.
    ('c', &[&[[1, 4], [0, 4], [0, 10], [1, 10]]]),
    ('i', &[&[[0, 4], [0, 10]], &[[0, 1], [0, 2]]]),
    ('m', &[&[[0, 10], [0, 4], [2, 4], [2, 10]], &[[1, 4], [1, 10]]]),
    ('n', &[&[[0, 10], [0, 4], [1, 4], [1, 10]]]),
];

fn sign(letter: char) -> Option<Sign> {
    SIGNS.iter().find(|(known, _)| *known == letter).map(|(_, sign)| *sign)
}

/// From the left of a sign to that of the next, heights.
fn advance(letter: char) -> f64 {
    let right =
        sign(letter).map(|lines| lines.iter().flat_map(|line| line.iter()).map(|[x, _]| *x).max().unwrap_or_default());
    right.map_or(0.5, |right| f64::from(right) * 0.5 + 0.25)
}

/// The width of a text of height 1.
pub(in crate::lines) fn width_of(text: &str) -> f64 {
    text.chars().map(advance).sum::<f64>() - 0.25
}

/// A text in strokes, from its upper left corner.
pub(in crate::lines) fn strokes(text: &str, from: DVec2, height: f64) -> Vec<[DVec2; 2]> {
    let mut left = 0.0;
    let mut all = Vec::new();
    for letter in text.chars() {
        let at = |[x, y]: [i8; 2]| from + DVec2::new(left + f64::from(x) * 0.5, f64::from(y) * 0.1) * height;
        for line in sign(letter).unwrap_or_default() {
            all.extend(line.windows(2).map(|ends| [at(ends[0]), at(ends[1])]));
        }
        left += advance(letter);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_of_a_sheet_has_its_signs() {
        for word in ["FRONT", "TOP", "RIGHT", "LEFT", "ISO", "SCALE 1:2.5", "0123456789 mm", "cm", "m", "in"] {
            assert!(word.chars().all(|letter| letter == ' ' || sign(letter).is_some()), "{word}");
            let all = strokes(word, DVec2::ZERO, 2.0);
            let right = all.iter().flatten().map(|end| end.x).fold(0.0, f64::max);
            assert!((right - 2.0 * width_of(word)).abs() < 1e-12, "{word}: {right}");
        }
    }
}
