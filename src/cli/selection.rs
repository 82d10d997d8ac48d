//! Some of a table's settings, which a command has as options.

use tinta::settings::{HasSettings, Setting};

/// Some of a table's settings as options.
pub trait Selection {
    /// The struct that the settings belong to.
    type Of: HasSettings;

    /// Whether they have their own headings.
    const HAS_HEADINGS: bool = true;

    /// Whether this is one of them.
    fn has(_setting: &Setting<Self::Of>) -> bool {
        true
    }
}
