//! Choices: settings that are one of a few names.

/// A setting that is one of a few names: what stands in its table is read, written, listed in help and offered by shells.
pub trait Choice: Copy + PartialEq + 'static {
    /// Every value with its name, as the user writes it.
    const NAMED: &'static [(&'static str, Self)];

    /// The value's name.
    fn choice_name(self) -> &'static str {
        // Every value is in its table.
        Self::NAMED.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }
}

/// The value of a name in a table of names; the error lists them.
pub(crate) fn find<T: Copy>(table: &[(&str, T)], text: &str) -> Result<T, String> {
    table.iter().find(|(name, _)| *name == text).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
        format!("choose one of {}", names.join(", "))
    })
}
