//! The numbers that choose between ways to the same lines. They change times, never lines.

/// See [`THRESHOLDS`].
pub(crate) struct Thresholds {
    /// How often boxes of faces cover the picture before it has a depth buffer, nearest faces and parts of faces. With fewer
    /// layers these cost more than they save.
    pub crowded: f64,
    /// Cells of the depth buffer, and samples of nearest faces, along the picture's larger side, as a power of 2. Smaller cells
    /// hide more of dense scenes, and cost more to fill.
    pub cells: usize,
    /// Parts along the picture's larger side into which faces and rims are cut: the box of a longer diagonal one is mostly empty.
    pub parts: f64,
    /// About the most parts of faces, for memory.
    pub most_parts: usize,
    /// Fewest faces or lines that are handled as a group: those of one plane, of one vertex, or on one line of the picture. Of
    /// fewer, to compare all pairs costs less.
    pub group: usize,
    /// Faces that a walk remembers, because a large face comes once for each of its parts.
    pub remembered: usize,
}

/// Measured over the families of scenes in `benches/lines_growth.rs`, with 1,000 to 80,000 triangles, and public models.
pub(crate) const THRESHOLDS: Thresholds =
    Thresholds { crowded: 24.0, cells: 9, parts: 16.0, most_parts: 600_000, group: 16, remembered: 256 };
