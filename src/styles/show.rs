//! The pictures that styles can show.

use serde::Serialize;

/// Which of a style's pictures is wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Show {
    /// The finished picture.
    #[default]
    Final,
    /// The normal map: red, green, blue of the map (figure 9, left).
    Normals,
    /// The depth map: alpha of the map as grey, near is dark (figure 9, right).
    Depth,
    /// The map itself, four channels.
    Map,
    /// The borders alone (figure 12).
    Borders,
    /// The tones alone (figure 5).
    Tones,
    /// The light of a charcoal drawing (Valente 2007, figure 4, left).
    Diffuse,
    /// The contrast-enhanced model (figure 4, right).
    Cem,
    /// The contrast-enhanced texture where the model reads it.
    Cet,
    /// The paper alone.
    Paper,
}
