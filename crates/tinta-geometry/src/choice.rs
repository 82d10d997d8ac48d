//! Choices: values that are one of a few names.

use crate::error::ParseError;

/// A value that is one of a few names: what stands in its table is read, written, listed in help and offered by shells.
pub trait Choice: Copy + PartialEq + 'static {
    /// Every value with its name, as the user writes it.
    const NAMED: &'static [(&'static str, Self)];

    /// The value's name.
    fn choice_name(self) -> &'static str {
        // Every value is in its table.
        Self::NAMED.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }

    /// The value of a name.
    ///
    /// # Errors
    ///
    /// The names that there are.
    fn of_name(name: &str) -> Result<Self, ParseError> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).ok_or_else(|| {
            let names: Vec<&str> = Self::NAMED.iter().map(|(name, _)| *name).collect();
            ParseError(format!("choose one of {}", names.join(", ")))
        })
    }
}

/// Makes choices of types with a table `ALL`, which are read by `parse` and displayed as their names.
///
/// A macro because a trait of another crate cannot be implemented for every [`Choice`] at once.
#[macro_export]
#[doc(hidden)]
macro_rules! choices {
    ($($choice:ty),+) => {$(
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
    )+};
}
