//! The numbers that choose between ways to the same lines. They change times, never lines.

/// See [`THRESHOLDS`].
pub(crate) struct Thresholds {
    /// How often boxes of faces cover the picture before it has a depth buffer, nearest faces and pieces of faces. With fewer
    /// layers these cost more than they save.
    pub crowded: f64,
    /// Cells of the depth buffer, and samples of nearest faces, along the picture's larger side, as a power of 2. Smaller cells
    /// hide more of dense scenes, and cost more to fill.
    pub cells: usize,
    /// Pieces along the picture's larger side into which faces and rims are cut: the box of a longer diagonal one is mostly empty.
    pub pieces: f64,
    /// About the most pieces of faces, for memory.
    pub most_pieces: usize,
    /// Fewest faces or lines that are handled as a group: those of one plane, of one vertex, or on one line of the picture. Of
    /// fewer, to compare all pairs costs less.
    pub group: usize,
    /// Least size of a face that may share a plane with many, as a share of the picture's larger side: large ones cost the time.
    pub plane_face: f64,
    /// Pixels per radian of a line's direction in a hierarchy of lines: lines of different directions lie apart there.
    pub px_per_radian: f64,
    /// Most boxes whose hierarchy is built at once. The builder joins boxes that are nearest to one another. In a row where each is nearest
    /// to the one before, such as a railing seen from its end, each pass over all joins only two.
    pub built_at_once: usize,
    /// Most things in a leaf of a hierarchy.
    pub largest_leaf: u32,
    /// The cost of a step down a hierarchy, in tests of a box: a higher cost makes larger leaves.
    pub step_cost: f32,
    /// Fewest pairs of nodes to share among threads, where the hierarchy has enough.
    pub node_pairs: usize,
    /// Faces that a walk remembers, because a large face comes once for each of its pieces.
    pub remembered: usize,
}

/// Measured over the families of scenes in `benches/lines_growth.rs`, with 1,000 to 80,000 triangles, and public models.
pub(crate) const THRESHOLDS: Thresholds = Thresholds {
    crowded: 24.0,
    cells: 9,
    pieces: 16.0,
    most_pieces: 600_000,
    group: 16,
    plane_face: 1.0 / 512.0,
    px_per_radian: 1024.0,
    built_at_once: 8192,
    largest_leaf: 8,
    step_cost: 3.0,
    node_pairs: 1024,
    remembered: 256,
};
