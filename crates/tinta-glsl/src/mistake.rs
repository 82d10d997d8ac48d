//! Mistakes in a shader, with their line.

/// What is wrong with a shader, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}, line {line}: {problem}")]
pub struct Mistake {
    /// The shader's name, as given.
    pub path: String,
    /// Counted from 1, in the text as written.
    pub line: u32,
    /// What is wrong, a sentence without its full stop.
    pub problem: String,
}
