//! Exact visible lines as a style: the lines to find and how to draw them.

use super::headings::no_borders;
use crate::lines::{DrawingSettings, JoinKey, LineSettings, ProjectionAngle};
use crate::settings::{Setting, under, within};

/// The heading of edge settings.
const LINES: &str = "Style lines: which lines";

/// The heading of settings of areas.
const AREAS: &str = "Style lines: areas below the lines";

/// Exact visible lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LineStyle {
    /// The classes of lines. Further lines to find follow from `drawing`.
    pub lines: LineSettings,
    /// How they are drawn.
    pub drawing: DrawingSettings,
    /// By what the areas below the lines are joined. Default `None`: no areas.
    pub areas: Option<JoinKey>,
    /// Whether the areas are drawn without lines. Default no.
    pub is_of_areas_alone: bool,
    /// The views of a sheet in place of the camera's. Default none.
    pub sheet: Option<ProjectionAngle>,
}

impl LineStyle {
    /// Returns the settings of the lines, of the areas, then of the drawing.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let lines = within(LineSettings::settings(), |style: &mut Self| Some(&mut style.lines));
        // Settings of edges have no heading here because other styles share them.
        let lines = lines.map(|mut setting| {
            setting.heading = if setting.heading.is_empty() { LINES } else { setting.heading };
            setting
        });
        let areas = Setting::open_field(
            "areas",
            "WHAT",
            "none",
            "Exact areas below the lines: of each face, of each material, or of each object, whose outlines they are; a .json \
             file lists them",
            |style: &mut Self| &mut style.areas,
        );
        let alone = no_borders(|style: &Self| style.is_of_areas_alone, |style, is_it| style.is_of_areas_alone = is_it);
        let lines = lines.chain(under(AREAS, vec![areas, alone]));
        let drawing: Vec<_> =
            within(DrawingSettings::settings(), |style: &mut Self| Some(&mut style.drawing)).collect();
        let sheet = Setting::open_field(
            "sheet",
            "ANGLE",
            "none",
            "Draw a sheet with front, top, side and isometric views to one scale, and a scale bar in model units: third \
             (American) or first (European) angle; --size is that of the sheet",
            |style: &mut Self| &mut style.sheet,
        )
        .said("none, one view");
        let heading = drawing[0].heading;
        lines.chain(drawing).chain(under(heading, vec![sheet])).collect()
    }
}
