//! Exact regions: a view cut into areas, each seen as one face or as background.
//!
//! Input: a [`Scene`]. Output: [`Regions`], polygons with holes that fill the picture without gaps and overlaps. Neighbours share
//! their vertices. Three steps make them:
//!
//! 1. *Borders*. Where one face gives way to another lies the image of a side of a face, of an intersection of faces, or of a cut
//!    by the near or the far plane. All of these are borders, except those that nearer faces surely hide. One too many does no
//!    harm.
//! 2. *Cells*. Snap rounding cuts the borders where they cross, on a grid of at most 2^-15 pixels; they bound the cells of a
//!    planar map. All of this is exact in integers.
//! 3. *Labels*. In each cell one ray decides what is seen. Borders with the same label on both sides go, which joins their cells.
//!
//! No step closes a gap, since none can open: every border is whole, and the visibility of lines plays no part.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::lines::Regions;
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, load};
//!
//! let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([mesh], &SceneSettings::default())?;
//!
//! let regions = Regions::of(&scene)?;
//! let area: f64 = regions.regions.iter().map(|region| region.area_px).sum();
//! assert!((area - 512.0 * 512.0).abs() < 1e-9 * area);
//! # Ok(())
//! # }
//! ```

mod crossings;
mod grid;
mod planar_map;
mod sheets;
mod snap;
mod tones;
mod view;

pub use tones::{ToneLight, ToneRule, TonedSurface};

use crate::error::Result;
use crate::lines::progress::Progress;
use crate::scene::Scene;
use crate::values::Size;
use glam::DVec2;
use grid::Grid;
use planar_map::{OUTSIDE, PlanarMap};
use snap::{Segment, ordered, snapped};
use view::View;

/// The regions of a view. `T` says what is seen in a region.
#[derive(Debug, Clone, PartialEq)]
pub struct Regions<T = Option<SeenFace>> {
    /// The picture's size, pixels.
    pub size: Size,
    /// The regions, in no order that means something.
    pub regions: Vec<Region<T>>,
    /// Number of loops that bound regions of several labels, and by how much Euler's formula is missed. Each is a defect of tinta.
    pub broken: usize,
}

/// A face of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SeenFace {
    /// The object in the scene.
    pub object: u32,
    /// The face in the object's mesh.
    pub face: u32,
}

/// A connected area of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Region<T = Option<SeenFace>> {
    /// The face that is seen; `None` for background.
    pub seen: T,
    /// Closed polygons without a repeated last corner: the outer one, then holes, which run the other way. Pixels from the upper
    /// left, y down.
    pub loops: Vec<Vec<DVec2>>,
    /// Area without the holes, square pixels.
    pub area_px: f64,
}

impl Regions {
    /// Cuts a view into regions of one face each.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] if the scene has too many faces.
    pub fn of(scene: &Scene) -> Result<Self> {
        Self::with_progress(scene, &Progress::default())
    }

    /// Like [`Regions::of`], and may be ended.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::of`], [`crate::Error::Cancelled`] and [`crate::Error::OutOfTime`].
    pub fn with_progress(scene: &Scene, progress: &Progress) -> Result<Self> {
        let view = View::of(scene, progress)?;
        let seen = |px| view.first_hit(px).map(|hit| SeenFace { object: hit.object, face: hit.face });
        cut(&view, view.borders(|_| true), seen, progress)
    }
}

/// Cuts a view along borders; joins what has the same label.
fn cut<T: Copy + PartialEq + Send + Sync>(
    view: &View,
    borders: Vec<Segment>,
    label: impl Fn(DVec2) -> T + Sync,
    progress: &Progress,
) -> Result<Regions<T>> {
    let map = PlanarMap::new(&snapped(borders, progress)?);
    progress.go_on()?;
    let labels = view.labels(map.cell_count(), |cell| label(view.grid.px(map.inside(cell))), progress)?;
    let (regions, mixed) = dissolved(&map, &labels, &view.grid);
    Ok(Regions { size: view.scene.size, regions, broken: map.defect + mixed })
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

/// A border with what is on its left and on its right, `None` outside.
type Border<T> = (Segment, [Option<T>; 2]);

/// Walks along borders around the regions that they bound. Returns these, and the number of defects.
fn walked<T: Copy + PartialEq>(borders: Vec<Border<T>>, grid: &Grid) -> (Vec<Region<T>>, usize) {
    let segments: Vec<Segment> = borders.iter().map(|(segment, _)| *segment).collect();
    let map = PlanarMap::new(&segments);
    let mut broken = map.defect;
    let mut regions = Vec::with_capacity(map.cell_count());
    for cell in 0..map.cell_count() as u32 {
        let loops = map.loops(cell);
        let side = |half: u32| borders[half as usize / 2].1[half as usize % 2];
        let seen = side(loops[0]);
        let is_mixed = |first: &&u32| map.from(**first).any(|half| side(half) != seen);
        broken += loops.iter().filter(is_mixed).count();
        // What is outside all regions may form cells, too.
        let Some(seen) = seen else { continue };
        let corners = |first: &u32| {
            map.from(*first).map(|half| grid.px(map.points[map.ends(half)[0] as usize].as_dvec2())).collect()
        };
        let area_px = grid.area_px(map.areas[cell as usize]);
        regions.push(Region { seen, loops: loops.iter().map(corners).collect(), area_px });
    }
    (regions, broken)
}

impl<T: Copy> Regions<T> {
    /// Joins neighbouring regions that get the same label; leaves out those that get none. So the outlines of objects come about, or
    /// the area of several tones.
    #[must_use]
    pub fn joined<U: Copy + PartialEq>(&self, label: impl Fn(T) -> Option<U>) -> Regions<U> {
        let size = DVec2::new(f64::from(self.size.width), f64::from(self.size.height));
        let grid = Grid::over(size);
        let mut sides: Vec<(Segment, usize, U)> = Vec::new();
        for region in &self.regions {
            let Some(label) = label(region.seen) else { continue };
            for corners in &region.loops {
                for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                    let [from, to] = [from, to].map(|px| grid.point(*px));
                    let segment = ordered(from, to);
                    sides.push((segment, usize::from(segment[0] != from), label));
                }
            }
        }
        sides.sort_unstable_by_key(|([a, b], side, _)| (a.x, a.y, b.x, b.y, *side));
        let mut borders: Vec<Border<U>> = Vec::new();
        for of_segment in sides.chunk_by(|a, b| a.0 == b.0) {
            let mut labels = [None; 2];
            of_segment.iter().for_each(|(_, side, label)| labels[*side] = Some(*label));
            if labels[0] != labels[1] {
                borders.push((of_segment[0].0, labels));
            }
        }
        let (regions, mixed) = walked(borders, &grid);
        Regions { size: self.size, regions, broken: self.broken + mixed }
    }
}
