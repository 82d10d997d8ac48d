//! Choices: values with fixed names, and suggestions for misspelt names.

use crate::error::ParseError;
/// Parts of serde for the macro `choices`.
pub use serde::{Serialize, Serializer};

/// A value from a table of names; the table serves reading, writing, help and shell completion.
pub trait Choice: Copy + PartialEq + 'static {
    /// Every value with its name, as users write it.
    const NAMED: &'static [(&'static str, Self)];

    /// Returns the value's name.
    fn choice_name(self) -> &'static str {
        // Every value is in its table.
        Self::NAMED.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }

    /// Returns the value with this name.
    ///
    /// # Errors
    ///
    /// Suggests the nearest name, or lists all names.
    fn of_name(name: &str) -> Result<Self, ParseError> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).ok_or_else(|| {
            let names: Vec<&str> = Self::NAMED.iter().map(|(name, _)| *name).collect();
            ParseError(meant_or(name, &names, &format!("choose one of {}", names.join(", "))))
        })
    }
}

/// Returns a message for an unknown name: a suggestion, or else `otherwise`.
pub fn meant_or(name: &str, names: &[&str], otherwise: &str) -> String {
    nearest(name, names).map_or_else(|| otherwise.to_owned(), |nearest| format!("did you mean {nearest}?"))
}

/// Returns a message for an unknown option of `owner`, both as users write them, with the suggestion `meant` if any.
///
/// ```
/// use tinta_geometry::choice::no_option;
/// let sentence = "tinta render has no option --colour; did you mean --color?";
/// assert_eq!(no_option("tinta render", "--colour", Some("--color")), sentence);
/// ```
pub fn no_option(owner: &str, given: &str, meant: Option<&str>) -> String {
    let sentence = format!("{owner} has no option {given}");
    meant.map_or(sentence.clone(), |meant| format!("{sentence}; did you mean {meant}?"))
}

/// Returns the name nearest to `word`, counting letters added, left out, exchanged or swapped with the next, at most one for
/// every three letters; else the only name that begins with `word`. Capitals count as small letters, underscores and blanks as
/// hyphens. `None` if no name is near.
///
/// ```
/// use tinta_geometry::choice::nearest;
/// assert_eq!(nearest("sobell", &["laplacian4", "sobel"]), Some("sobel"));
/// assert_eq!(nearest("sharp", &["laplacian4", "sobel"]), None);
/// ```
pub fn nearest<'n>(word: &str, names: &[&'n str]) -> Option<&'n str> {
    /// Longer words are not compared: they are no misspelt names.
    const LONGEST: usize = 64;
    /// Shorter beginnings fit too many names.
    const LEAST_BEGINNING: usize = 3;
    let letters = |text: &str| -> Vec<char> {
        let lower = text.chars().take(LONGEST + 1).flat_map(char::to_lowercase);
        lower.map(|c| if c == '_' || c == ' ' { '-' } else { c }).collect()
    };
    let word = letters(word);
    if word.len() > LONGEST {
        return None;
    }
    let near = names.iter().map(|name| (edits(&word, &letters(name)), word.len().max(name.chars().count()) / 3, *name));
    let best = near.filter(|(edits, most, _)| edits <= most).min_by_key(|(edits, ..)| *edits);
    best.map(|(.., name)| name).or_else(|| {
        let mut begun = names.iter().filter(|name| word.len() >= LEAST_BEGINNING && letters(name).starts_with(&word));
        begun.next().filter(|_| begun.next().is_none()).copied()
    })
}

/// Returns the number of letters to add, leave out, exchange or swap with the next to turn one word into the other.
fn edits(from: &[char], to: &[char]) -> usize {
    let mut rows: Vec<Vec<usize>> = vec![(0..=to.len()).collect()];
    for (i, &letter) in from.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, &other) in to.iter().enumerate() {
            let exchanged = rows[i][j] + usize::from(letter != other);
            let mut least = exchanged.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && letter == to[j - 1] && from[i - 1] == other {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[from.len()][to.len()]
}

/// Makes an enum of named values: the type, its table `ALL` in the same order, parsing, display and serialisation by name.
///
/// ```
/// tinta_geometry::choices! {
///     /// What a shop has.
///     #[derive(Default)]
///     pub enum Fruit {
///         /// Red or green.
///         #[default]
///         Apple = "apple",
///         /// With a stone.
///         StoneFruit = "stone-fruit",
///     }
/// }
/// assert_eq!("stone-fruit".parse(), Ok(Fruit::StoneFruit));
/// assert_eq!(Fruit::ALL[0], ("apple", Fruit::default()));
/// ```
#[macro_export]
#[doc(hidden)]
macro_rules! choices {
    (
        $(#[$about:meta])*
        $access:vis enum $choice:ident {
            $($(#[$what:meta])* $value:ident = $name:literal,)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        $access enum $choice {
            $($(#[$what])* $value,)+
        }

        impl $choice {
            /// All values in order, with their names as users write them.
            $access const ALL: [(&'static str, Self); [$($name),+].len()] = [$(($name, Self::$value)),+];
        }

        impl $crate::choice::Choice for $choice {
            const NAMED: &'static [(&'static str, Self)] = &Self::ALL;
        }

        impl std::str::FromStr for $choice {
            type Err = $crate::error::ParseError;

            fn from_str(name: &str) -> std::result::Result<Self, Self::Err> {
                $crate::choice::Choice::of_name(name)
            }
        }

        impl std::fmt::Display for $choice {
            fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.write_str($crate::choice::Choice::choice_name(*self))
            }
        }

        impl $crate::choice::Serialize for $choice {
            fn serialize<S: $crate::choice::Serializer>(&self, to: S) -> std::result::Result<S::Ok, S::Error> {
                to.serialize_str($crate::choice::Choice::choice_name(*self))
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted_as_by_hand() {
        for (from, to, count) in [
            ("", "", 0),
            ("", "abc", 3),
            ("sobel", "sobel", 0),
            ("sobell", "sobel", 1),
            ("redner", "render", 1),
            ("kitten", "sitting", 3),
            ("abcd", "badc", 2),
            ("flaw", "lawn", 2),
        ] {
            let letters = |text: &str| text.chars().collect::<Vec<_>>();
            assert_eq!(edits(&letters(from), &letters(to)), count, "{from} {to}");
            assert_eq!(edits(&letters(to), &letters(from)), count, "{to} {from}");
        }
    }

    #[test]
    fn the_nearest_name_is_meant_or_none() {
        let styles = ["phong", "three-pass", "two-pass", "inking", "ink", "charcoal"];
        for (word, meant) in [
            ("three_pass", Some("three-pass")),
            ("Three Pass", Some("three-pass")),
            ("threepass", Some("three-pass")),
            ("INK", Some("ink")),
            ("inkin", Some("inking")),
            ("three", Some("three-pass")),
            ("charcaol", Some("charcoal")),
            ("toon", None),
            ("", None),
            ("i", None),
            ("xx", None),
            (&"ink".repeat(1000), None),
        ] {
            assert_eq!(nearest(word, &styles), meant, "{word}");
        }
        assert_eq!(nearest("lap", &["laplacian4", "laplacian8"]), None, "either may be meant");
        assert_eq!(nearest("laplacian", &["laplacian4", "laplacian8"]), Some("laplacian4"), "the first of equals");
        assert_eq!(meant_or("toon", &styles, "choose one of them"), "choose one of them");
        assert_eq!(meant_or("mrt", &["mrtt"], ""), "did you mean mrtt?");
    }
}
