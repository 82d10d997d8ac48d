//! Areas of tones as they are painted, without seams.
//!
//! Where two areas meet, a program that smooths edges covers a pixel partly by one and partly by the other, and a little of the
//! ground shines through. So areas are painted over one another. Within an object's material, each tone's area includes those of
//! brighter tones, which are painted on top. Where materials or objects meet, the lower one gets a *trap*: a stroke in its own
//! colour along the border, below the upper one.

use crate::lines::drawing::simplify::simplified;
use crate::lines::regions::{Regions, Surface, TonedSurface};
use crate::mesh::NONE;
use crate::scene::Color;
use glam::{DVec2, I64Vec2};
use std::collections::BTreeSet;
use std::collections::HashMap;

/// The width of a trap, pixels: half of it is seen while the upper area is not painted.
pub(crate) const TRAP_PX: f64 = 4.0;

/// The material of the shadow on the ground, which belongs to no object.
pub(crate) const GROUND: u32 = NONE - 1;

/// The areas of an object's material, or strokes below all areas.
#[derive(Debug, Clone, PartialEq)]
pub struct FillGroup {
    /// The object in the scene; [`crate::mesh::NONE`] for strokes below all areas.
    pub object: u32,
    /// The material in the object's mesh, or [`crate::mesh::NONE`]; of strokes below areas the number of their view, if there are several.
    pub material: u32,
    /// The material's name in the model's file; empty without one.
    pub name: String,
    /// The opacity of the group, and of those with the same one before and after it, as one picture: from 0 to 1.
    pub opacity: f32,
    /// Whether edges are not smoothed: then each pixel is of one area.
    pub is_crisp: bool,
    /// Closed polygons by the even-odd rule, pixels, outside of which nothing of the group is drawn; empty: all of it is.
    pub clip: Vec<Vec<DVec2>>,
    /// The areas, the first painted first.
    pub fills: Vec<Fill>,
}

impl FillGroup {
    /// Opaque areas with smoothed edges and without a name.
    pub(super) fn of(object: u32, material: u32, fills: Vec<Fill>) -> Self {
        Self { object, material, name: String::new(), opacity: 1.0, is_crisp: false, clip: Vec::new(), fills }
    }
}

/// An area of one colour. One of a tone includes those of brighter tones, which are painted above it.
#[derive(Debug, Clone, PartialEq)]
pub struct Fill {
    /// What it shows.
    pub surface: Surface,
    /// The colour.
    pub color: Color,
    /// Closed polygons and their holes by the even-odd rule, pixels.
    pub loops: Vec<Vec<DVec2>>,
    /// Where groups painted later meet this tone, polylines, pixels.
    pub trap: Vec<Vec<DVec2>>,
}

/// Returns the areas of regions as they are painted, in the colours of their surfaces.
pub fn fills(regions: &Regions<Option<TonedSurface>>, color: impl Fn(TonedSurface) -> Color) -> Vec<FillGroup> {
    let surfaces: BTreeSet<TonedSurface> = regions.regions.iter().filter_map(|region| region.seen).collect();
    let surfaces: Vec<TonedSurface> = surfaces.into_iter().collect();
    let neighbours = neighbours(regions, |_, seen| *seen);
    let groups = surfaces.chunk_by(|a, b| (a.object, a.material) == (b.object, b.material));
    let group = |of_group: &[TonedSurface]| {
        let lowest = of_group[0];
        let is_of_group = |it: &TonedSurface| (it.object, it.material) == (lowest.object, lowest.material);
        let fill = |surface: &TonedSurface| {
            let area = regions.joined(|seen| seen.filter(|it| is_of_group(it) && it.tone >= surface.tone).map(|_| ()));
            let loops = area.regions.into_iter().flat_map(|region| region.loops);
            let loops = loops.map(|corners| simplified(&corners, true)).filter(|corners| corners.len() > 2).collect();
            let own = regions.regions.iter().filter(|region| region.seen == Some(*surface));
            let is_above = |other: TonedSurface| (other.object, other.material) > (surface.object, surface.material);
            let trap = trap(own.flat_map(|region| &region.loops), &neighbours, is_above);
            Fill { surface: (*surface).into(), color: color(*surface), loops, trap }
        };
        let fills = of_group.iter().map(fill).collect();
        FillGroup::of(lowest.object, lowest.material, fills)
    };
    groups.map(group).collect()
}

/// What lies to the left of each side of a region.
pub(super) type Neighbours<V> = HashMap<[I64Vec2; 2], V>;

/// A point's numbers: regions share their corners to the last bit.
fn bits(point: DVec2) -> I64Vec2 {
    I64Vec2::new(point.x.to_bits() as i64, point.y.to_bits() as i64)
}

/// The sides of a polygon.
fn sides(corners: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(from, to)| [*from, *to])
}

/// The values of the regions at each side, by their number and what they show.
pub(super) fn neighbours<T, V: Copy>(regions: &Regions<T>, value: impl Fn(usize, &T) -> Option<V>) -> Neighbours<V> {
    let mut neighbours = Neighbours::new();
    for (number, region) in regions.regions.iter().enumerate() {
        let Some(value) = value(number, &region.seen) else { continue };
        let of_region = region.loops.iter().flat_map(|corners| sides(corners));
        neighbours.extend(of_region.map(|side| (side.map(bits), value)));
    }
    neighbours
}

/// The stretches of polygons along which they meet what is painted above them.
pub(super) fn trap<'a, V: Copy>(
    loops: impl Iterator<Item = &'a Vec<DVec2>>,
    neighbours: &Neighbours<V>,
    is_above: impl Fn(V) -> bool,
) -> Vec<Vec<DVec2>> {
    let is_below = |[from, to]: [DVec2; 2]| neighbours.get(&[bits(to), bits(from)]).copied().is_some_and(&is_above);
    let mut stretches: Vec<Vec<DVec2>> = Vec::new();
    for corners in loops {
        let mut is_open = false;
        for side in sides(corners) {
            match (is_below(side), stretches.last_mut().filter(|_| is_open)) {
                (true, Some(stretch)) => stretch.push(side[1]),
                (true, None) => stretches.push(side.to_vec()),
                (false, _) => {}
            }
            is_open = is_below(side);
        }
    }
    stretches.into_iter().map(|stretch| simplified(&stretch, false)).collect()
}
