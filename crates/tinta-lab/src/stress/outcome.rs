//! The outcome of a case: a picture with its figures, an error, or a panic.

use super::figures::Figures;
use tinta::error::Error;

/// The outcome of a drawing.
pub(super) enum Outcome {
    Rendered(Figures),
    Refused { kind: &'static str, sentence: String },
    Panicked,
}

impl Outcome {
    pub(super) fn refused(error: &Error) -> Self {
        Self::Refused { kind: error.kind(), sentence: error.with_dashes() }
    }

    pub(super) fn verdict(&self) -> String {
        match self {
            Self::Rendered(_) => "rendered".to_owned(),
            Self::Refused { kind, .. } => format!("refused ({kind})"),
            Self::Panicked => "panicked".to_owned(),
        }
    }
}
