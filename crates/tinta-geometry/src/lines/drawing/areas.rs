//! The areas of tone below a drawing's lines, as they are drawn.

use crate::lines::drawing::fills::{Fill, FillGroup, GROUND};
use crate::lines::drawing::hatch::Hatch;
use crate::lines::drawing::key::Key;
use crate::lines::regions::{Regions, Surface};
use crate::mesh::NONE;
use crate::scene::Color;
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
    /// Adds the shadow on the ground, below all other areas.
    pub fn add_ground(&mut self, shadow: &Regions<()>, color: Color) {
        let loops: Vec<Vec<DVec2>> = shadow.regions.iter().flat_map(|region| region.loops.iter().cloned()).collect();
        for point in loops.iter().flatten() {
            let [low, high] = self.corners_px.unwrap_or([*point; 2]);
            self.corners_px = Some([low.min(*point), high.max(*point)]);
        }
        let surface = Surface { object: NONE, material: None, tone: None, face: None };
        let fill = Fill { surface, color, loops, trap: Vec::new() };
        self.fills.insert(0, FillGroup::of(NONE, GROUND, vec![fill]));
    }

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
