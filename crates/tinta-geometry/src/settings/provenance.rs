//! Whose a value is: a text's, drawn from a text, or ours. Declared with the setting or the constant it is said of.

/// Whose a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Whose {
    /// A text prints it.
    Printed,
    /// It follows from what a text says.
    Deduced,
    /// No text gives it; it was chosen here.
    Ours,
}

impl Whose {
    /// As it is written in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Deduced => "deduced",
            Self::Ours => "ours",
        }
    }
}

/// Whose a value is, and how one knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Provenance {
    /// Whose.
    pub whose: Whose,
    /// Where it is printed, what it follows from, or why it was chosen: a phrase.
    pub why: &'static str,
}

impl Provenance {
    /// A text prints it there.
    pub const fn printed(place: &'static str) -> Self {
        Self { whose: Whose::Printed, why: place }
    }

    /// It follows from this.
    pub const fn deduced(from: &'static str) -> Self {
        Self { whose: Whose::Deduced, why: from }
    }

    /// It was chosen here for this reason.
    pub const fn ours(reason: &'static str) -> Self {
        Self { whose: Whose::Ours, why: reason }
    }
}
