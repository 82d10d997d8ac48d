//! How a plan's vertices reach GL: the same picture by the calls of two eras.

tinta_geometry::choices! {
    /// How vertices are passed to GL. The picture is the same, byte for byte; the cost differs.
    #[derive(Default)]
    pub enum Submission {
        /// Vertex buffers, uploaded once, and one call for each run of faces or edges (OpenGL 1.5).
        #[default]
        Buffers = "buffers",
        /// glBegin, a call for each vertex and each of its attributes, glEnd, in every picture: as in C. Dachsbacher's listing.
        Immediate = "immediate",
    }
}
