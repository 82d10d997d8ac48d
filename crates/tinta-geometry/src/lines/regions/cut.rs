//! Cuts a view along borders into cells, asks one ray in each, and joins cells of one label.

use super::grid::Grid;
use super::planar_map::{OUTSIDE, PlanarMap};
use super::region::{Border, Region, Regions, SeenFace, walked};
use super::snap::{Segment, ordered, snapped};
use super::view::View;
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::lines::sight::Sight;
use crate::memory::AREAS;
use crate::scene::Scene;
use crate::threads::{cores, in_chunks};
use glam::DVec2;

/// Cells that a thread labels at once.
const CHUNK: usize = 256;

impl Regions {
    /// Cuts a view into regions of one face each.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] if the scene has too many faces.
    pub fn of(scene: &Scene) -> Result<Self> {
        Self::with_progress(&Sight::of(scene), &Progress::default())
    }

    /// Like [`Regions::of`], and may be ended.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::of`], [`crate::Error::Cancelled`] and [`crate::Error::OutOfTime`].
    pub fn with_progress(sight: &Sight<'_>, progress: &Progress) -> Result<Self> {
        let view = View::of(sight, AREAS, progress)?;
        let seen = |px| view.first_hit(px).map(|hit| SeenFace { object: hit.object, face: hit.face });
        cut(&view, view.borders([], |_| true, progress)?, seen, progress)
    }
}

/// Cuts a view along borders; joins cells with the same label.
pub(super) fn cut<T: Copy + PartialEq + Send + Sync>(
    view: &View,
    borders: Vec<Segment>,
    label: impl Fn(DVec2) -> T + Sync,
    progress: &Progress,
) -> Result<Regions<T>> {
    let map = PlanarMap::new(&snapped(borders, view.input.asked, progress)?);
    progress.go_on()?;
    let labels = in_chunks(map.cell_count(), CHUNK, cores(), |range| {
        let rest = range.take_while(|_| !progress.is_over());
        rest.map(|cell| label(view.grid.px(map.inside(cell as u32)))).collect::<Vec<T>>()
    });
    progress.go_on()?;
    let (regions, mixed) = dissolved(&map, &labels.concat(), &view.grid);
    Ok(Regions { size: view.input.scene.size, regions, broken: map.defect + mixed })
}

/// Joins neighbouring cells of one label. Returns the regions, and the number of defects.
fn dissolved<T: Copy + PartialEq>(map: &PlanarMap, labels: &[T], grid: &Grid) -> (Vec<Region<T>>, usize) {
    let label = |cell: u32| (cell != OUTSIDE).then(|| labels[cell as usize]);
    let point = |point: u32| map.points[point as usize];
    let mut kept: Vec<Border<T>> = Vec::new();
    for (edge, [a, b]) in map.edges.iter().enumerate() {
        let sides = [label(map.cells[2 * edge]), label(map.cells[2 * edge + 1])];
        if sides[0] != sides[1] {
            kept.push((ordered(point(*a), point(*b)), sides));
        }
    }
    walked(kept, grid)
}
