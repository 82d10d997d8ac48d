//! Regions of faces, materials or objects as they are painted: one area each.

use super::fills::{Fill, FillGroup, neighbours, trap};
use super::simplify::simplified;
use crate::lines::regions::{Regions, Surface};
use crate::mesh::NONE;
use crate::scene::Color;
use glam::DVec2;

/// Returns each region but the background as an area, grouped by object and material, in the colours of their numbers among
/// `regions`.
///
/// With traps the areas have no seams: below all of them lies a group of strokes along their common borders, each in the colour of
/// one of the two, within the outline of all. Without traps each area is its polygon alone, and edges are not smoothed.
pub fn painted(regions: &Regions<Option<Surface>>, has_traps: bool, color: impl Fn(usize) -> Color) -> Vec<FillGroup> {
    let seen = regions.regions.iter().enumerate().filter_map(|(number, region)| Some((region.seen?, number)));
    let mut order: Vec<(Surface, usize)> = seen.collect();
    order.sort_unstable();
    let fill = |(surface, number): &(Surface, usize)| {
        let loops = polygons(&regions.regions[*number].loops);
        Fill { surface: *surface, color: color(*number), loops, trap: Vec::new() }
    };
    let of_objects = order.chunk_by(|(a, _), (b, _)| (a.object, a.material) == (b.object, b.material));
    let group = |of_group: &[(Surface, usize)]| {
        let Surface { object, material, .. } = of_group[0].0;
        let fills = of_group.iter().map(fill).collect();
        FillGroup { is_crisp: !has_traps, ..FillGroup::of(object, material.unwrap_or(NONE), fills) }
    };
    let below = has_traps.then(|| seams(regions, &order, &color)).filter(|below| !below.fills.is_empty());
    below.into_iter().chain(of_objects.map(group)).collect()
}

/// The strokes below all areas.
fn seams(regions: &Regions<Option<Surface>>, order: &[(Surface, usize)], color: impl Fn(usize) -> Color) -> FillGroup {
    let neighbours = neighbours(regions, |number, seen| seen.map(|_| number));
    let fill = |(surface, number): &(Surface, usize)| {
        let trap = trap(regions.regions[*number].loops.iter(), &neighbours, |other| other > *number);
        Fill { surface: *surface, color: color(*number), loops: Vec::new(), trap }
    };
    let all = regions.joined(|seen| seen.map(|_| ()));
    let clip = polygons(all.regions.iter().flat_map(|region| &region.loops));
    let fills = order.iter().map(fill).filter(|fill| !fill.trap.is_empty()).collect();
    FillGroup { clip, ..FillGroup::of(NONE, NONE, fills) }
}

/// Loops without corners that do not change their shape.
fn polygons<'a>(loops: impl IntoIterator<Item = &'a Vec<DVec2>>) -> Vec<Vec<DVec2>> {
    loops.into_iter().map(|corners| simplified(corners, true)).filter(|corners| corners.len() > 2).collect()
}
