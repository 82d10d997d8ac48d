//! The areas of tone below a drawing's lines, as they are drawn.

use crate::lines::drawing::fills::FillGroup;
use crate::lines::drawing::hatch::Hatch;
use crate::lines::drawing::key::Key;
use crate::lines::regions::Regions;
use glam::DVec2;

/// The areas of tone below a drawing's lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Areas {
    /// Painted areas, in the order in which they are painted.
    pub fills: Vec<FillGroup>,
    /// Strokes above them, from the brightest hatched tone to the darkest.
    pub hatches: Vec<Hatch>,
    /// Keys to the colours, above all lines.
    pub keys: Vec<Key>,
    /// The upper left and the lower right corner around everything that is not background, pixels; `None` where all is background.
    pub corners_px: Option<[DVec2; 2]>,
}

impl Areas {
    /// Returns the corners around regions, and neither fills nor strokes.
    pub fn around<T>(regions: &Regions<Option<T>>) -> Self {
        let seen = regions.regions.iter().filter(|region| region.seen.is_some());
        // Holes lie inside.
        let mut points = seen.flat_map(|region| region.loops.iter().take(1).flatten().copied());
        let corners_px =
            points.next().map(|first| points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]));
        Self { corners_px, ..Self::default() }
    }
}
