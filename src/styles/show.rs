//! The pictures that styles can show.

tinta_geometry::choices! {
    /// The picture of a style to show.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Show {
        /// The finished picture.
        #[default]
        Final = "final",
        /// The normal map: red, green, blue of the map (figure 9, left).
        Normals = "normals",
        /// The depth map: alpha of the map as grey, near is dark (figure 9, right).
        Depth = "depth",
        /// The map itself, four channels.
        Map = "map",
        /// The borders alone (figure 12).
        Borders = "borders",
        /// The tones alone (figure 5).
        Tones = "tones",
        /// The light of a charcoal drawing (Valente 2007, figure 4, left).
        Diffuse = "diffuse",
        /// The contrast-enhanced model (figure 4, right).
        Cem = "cem",
        /// The contrast-enhanced texture where the model reads it.
        Cet = "cet",
        /// The paper alone.
        Paper = "paper",
    }
}
