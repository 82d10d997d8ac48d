//! Areas of tones as they are painted, without seams.
//!
//! Where two areas meet, a program that smooths edges covers a pixel partly by one and partly by the other, and a little of the
//! ground shines through. So areas are painted over one another. Within an object's material, each tone's area includes those of
//! brighter tones, which are painted on top. Where materials or objects meet, the lower one gets a *trap*: a stroke in its own
//! colour along the border, below the upper one.

use crate::lines::drawing::simplify::simplified;
use crate::lines::regions::{Regions, TonedSurface};
use crate::scene::Color;
use glam::{DVec2, I64Vec2};
use std::collections::BTreeSet;
use std::collections::HashMap;

/// The width of a trap, pixels: half of it is seen while the upper area is not painted.
pub const TRAP_PX: f64 = 4.0;

/// The areas of an object's material, from the darkest tone to the brightest.
#[derive(Debug, Clone, PartialEq)]
pub struct FillGroup {
    /// The object in the scene.
    pub object: u32,
    /// The material in the object's mesh, or [`crate::mesh::NONE`].
    pub material: u32,
    /// The areas, in the order in which they are painted.
    pub fills: Vec<Fill>,
}

/// An area of one tone, and below it those of brighter tones.
#[derive(Debug, Clone, PartialEq)]
pub struct Fill {
    /// 0 is the darkest tone.
    pub tone: u8,
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
    let neighbours = neighbours(regions);
    let groups = surfaces.chunk_by(|a, b| (a.object, a.material) == (b.object, b.material));
    let group = |of_group: &[TonedSurface]| {
        let lowest = of_group[0];
        let is_of_group = |it: &TonedSurface| (it.object, it.material) == (lowest.object, lowest.material);
        let fill = |surface: &TonedSurface| {
            let area = regions.joined(|seen| seen.filter(|it| is_of_group(it) && it.tone >= surface.tone).map(|_| ()));
            let loops = area.regions.into_iter().flat_map(|region| region.loops);
            let loops = loops.map(|corners| simplified(&corners, true)).filter(|corners| corners.len() > 2).collect();
            Fill { tone: surface.tone, color: color(*surface), loops, trap: trap(regions, &neighbours, *surface) }
        };
        FillGroup { object: lowest.object, material: lowest.material, fills: of_group.iter().map(fill).collect() }
    };
    groups.map(group).collect()
}

/// What lies to the left of each side of a region.
type Neighbours = HashMap<[I64Vec2; 2], TonedSurface>;

/// A point's numbers: regions share their corners to the last bit.
fn bits(point: DVec2) -> I64Vec2 {
    I64Vec2::new(point.x.to_bits() as i64, point.y.to_bits() as i64)
}

/// The sides of a polygon.
fn sides(corners: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(from, to)| [*from, *to])
}

fn neighbours(regions: &Regions<Option<TonedSurface>>) -> Neighbours {
    let of_region = |region: &crate::lines::Region<Option<TonedSurface>>| {
        let seen = region.seen;
        let all: Vec<_> = region.loops.iter().flat_map(|corners| sides(corners)).collect();
        all.into_iter().filter_map(move |side| Some((side.map(bits), seen?)))
    };
    regions.regions.iter().flat_map(of_region).collect()
}

/// The stretches along which later groups meet a surface.
fn trap(regions: &Regions<Option<TonedSurface>>, neighbours: &Neighbours, surface: TonedSurface) -> Vec<Vec<DVec2>> {
    let group = |it: &TonedSurface| (it.object, it.material);
    let is_below = |[from, to]: [DVec2; 2]| {
        neighbours.get(&[bits(to), bits(from)]).is_some_and(|other| group(other) > group(&surface))
    };
    let mut stretches: Vec<Vec<DVec2>> = Vec::new();
    let of_surface = regions.regions.iter().filter(|region| region.seen == Some(surface));
    for corners in of_surface.flat_map(|region| &region.loops) {
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
