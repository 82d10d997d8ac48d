//! The origin of a value: printed in a published text, deduced from one, or chosen by this project. Declared with the
//! setting or constant.

/// Where a value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Whose {
    /// A published text prints it.
    Printed,
    /// It follows from a published text's statements.
    Deduced,
    /// No published text gives it; this project chose it.
    Ours,
}

impl Whose {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Deduced => "deduced",
            Self::Ours => "ours",
        }
    }
}

/// The origin of a value, with the evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Provenance {
    /// The origin.
    pub whose: Whose,
    /// Where it is printed, what it follows from, or why it was chosen: a phrase.
    pub why: &'static str,
}

impl Provenance {
    /// Printed at this place.
    pub const fn printed(place: &'static str) -> Self {
        Self { whose: Whose::Printed, why: place }
    }

    /// Follows from this.
    pub const fn deduced(from: &'static str) -> Self {
        Self { whose: Whose::Deduced, why: from }
    }

    /// Chosen by this project for this reason.
    pub const fn ours(reason: &'static str) -> Self {
        Self { whose: Whose::Ours, why: reason }
    }
}
