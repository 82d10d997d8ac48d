//! Regions, and their union.

use super::grid::Grid;
use super::planar_map::PlanarMap;
use super::snap::{Segment, ordered};
use crate::values::Size;
use glam::DVec2;
use std::collections::HashMap;

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
    /// Closed polygons without a repeated last corner: the outer one, then holes, which run the other way. None meets a corner twice;
    /// holes may touch the others in corners. Pixels from the upper left, y down.
    pub loops: Vec<Vec<DVec2>>,
    /// Area without the holes, square pixels.
    pub area_px: f64,
}

/// A border with what is on its left and on its right, `None` outside.
pub(super) type Border<T> = (Segment, [Option<T>; 2]);

/// Walks along borders around the regions that they bound. Returns these, and the number of defects.
pub(super) fn walked<T: Copy + PartialEq>(borders: Vec<Border<T>>, grid: &Grid) -> (Vec<Region<T>>, usize) {
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
        let rings = loops.iter().flat_map(|first| {
            let mut rings = simple_rings(map.from(*first).map(|half| map.ends(half)[0]));
            // The outer one first, of those that an outer loop falls into.
            rings.sort_by_key(|ring| map.area(ring) <= 0);
            rings
        });
        let px = |point: &u32| grid.px(map.points[*point as usize].as_dvec2());
        let loops = rings.map(|ring| ring.iter().map(px).collect()).collect();
        let area_px = grid.area_px(map.areas[cell as usize]);
        regions.push(Region { seen, loops, area_px });
    }
    (regions, broken)
}

/// A closed walk as rings that meet no point twice: those of a loop that touches itself, each an outline or a hole.
fn simple_rings(points: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
    let mut rings = Vec::new();
    let mut path: Vec<u32> = Vec::new();
    let mut places: HashMap<u32, usize> = HashMap::new();
    for point in points {
        if let Some(place) = places.get(&point).copied() {
            path[place..].iter().for_each(|passed| {
                places.remove(passed);
            });
            rings.push(path.drain(place..).collect());
        }
        places.insert(point, path.len());
        path.push(point);
    }
    rings.push(path);
    rings
}

impl<T: Copy> Regions<T> {
    /// The same regions with other labels.
    #[must_use]
    pub fn labelled<U>(self, label: impl Fn(T) -> U) -> Regions<U> {
        let of_region = |Region { seen, loops, area_px }: Region<T>| Region { seen: label(seen), loops, area_px };
        Regions { size: self.size, regions: self.regions.into_iter().map(of_region).collect(), broken: self.broken }
    }

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
