//! How a plan's vertices reach GL: the same picture by the calls of two times.

use serde::Serialize;

/// How vertices are handed to GL. The picture is the same, byte for byte; what it costs is not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Submission {
    /// Vertex buffers, uploaded once, and one call for each run of faces or edges (OpenGL 1.5).
    #[default]
    Buffers,
    /// glBegin, a call for each vertex and each of its attributes, glEnd, in every picture: as C. Dachsbacher's listing.
    Immediate,
}

impl Submission {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 2] = [("buffers", Self::Buffers), ("immediate", Self::Immediate)];
}

tinta_geometry::choices!(Submission);
