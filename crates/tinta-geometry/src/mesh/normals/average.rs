//! Corners' normals averaged over a share of the model's size: borders of tones then follow the form rather than its facets, and a
//! scan's noise goes.
//!
//! In: triangles with a normal for each corner. Out: the normals of curved surfaces (`curved.rs`), averaged and not made unit again:
//! where the surface bends within that share they are shorter. So light, their product with a direction, is an average of light for
//! every direction. Flat faces, cylinders and cones keep theirs exactly. Nothing is averaged across a split of normals.
//!
//! Averaging is diffusion over patches of about one area (`patches.rs`), so a finer mesh takes hardly more time.

use super::patches::{Neighbours, Patches};
use super::persistent_creases::PersistentCreases;
use crate::mesh::NONE;
use crate::threads::{filled, threads_for_items};
use glam::{DVec3, Vec3};

/// How far at least where a longer way would erase form, in shares of the diagonal of the model's box.
const LEAST: f64 = 0.006;

/// Both in distances to a corner's neighbours, where these are far apart.
const REACH_IN_EDGES: f32 = 1.5;
const OWN_IN_EDGES: f32 = 1.2;

/// How far averages differ that count as the same, in units of the mesh's noise.
const AGREES: f32 = 4.0;

/// How many normals the noise is measured by, about.
const NOISE_SAMPLES: usize = 10_000;

/// The area of the largest patches, in squares of that reach.
const PATCH: f64 = 0.25;

/// How many times as large as the parts that it is made of a patch is.
const GROWTH: f64 = 4.0;

/// Rounds of diffusion over the largest patches, and over a short way: enough for their size.
const ROUNDS: usize = 8;

/// Rounds over smaller ones, and over corners, which hide the borders of the patches that they are part of.
const FINE_ROUNDS: usize = 4;

/// The most that a normal moves to the mean of its neighbours' in a round; more would overshoot.
const MOST: f32 = 0.5;

/// The least length of an averaged normal; shorter ones have no direction.
const SHORTEST: f32 = 0.05;

/// Least cosine of two normals at a position that count as one.
const SAME: f32 = 0.999_999;

/// Averages normals; `triangle_normals` has each corner's number, and a normal from number `first` on belongs to one position.
pub(super) fn average(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    (lasting, reach): (&PersistentCreases, f64),
    first: u32,
    normals: &mut Vec<Vec3>,
    triangle_normals: &mut [[u32; 3]],
) {
    if reach == 0.0 || !lasting.is_curved.contains(&true) {
        return;
    }
    let nodes = Nodes::of(positions, triangles, lasting, normals, triangle_normals);
    let place = |(number, normal): (&u32, Vec3)| {
        if *number >= first {
            normals[*number as usize] = normal;
            return *number;
        }
        normals.push(normal);
        normals.len() as u32 - 1
    };
    let numbers: Vec<u32> = nodes
        .numbers
        .iter()
        .zip(nodes.averaged([LEAST.min(reach), reach].map(|share| (share * lasting.diagonal) as f32)))
        .map(place)
        .collect();
    for (node, normal) in nodes.of_corners.as_flattened().iter().zip(triangle_normals.as_flattened_mut()) {
        if *node != NONE {
            *normal = numbers[*node as usize];
        }
    }
}

/// The corners that share a position and a normal, each counted once.
struct Nodes {
    /// Each corner's node, or [`NONE`] outside of curved surfaces.
    of_corners: Vec<[u32; 3]>,
    places: Vec<Vec3>,
    /// The normals, and their numbers.
    normals: Vec<Vec3>,
    numbers: Vec<u32>,
    areas: Vec<f64>,
    neighbours: Neighbours,
}

impl Nodes {
    fn of(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        lasting: &PersistentCreases,
        normals: &[Vec3],
        triangle_normals: &[[u32; 3]],
    ) -> Self {
        let mut of_corners = vec![[NONE; 3]; triangles.len()];
        let (mut places, mut numbers, mut areas) = (Vec::new(), Vec::new(), Vec::new());
        // The nodes at each position, as a list: its first, and for each the one after it.
        let (mut firsts, mut nexts) = (vec![NONE; positions.len()], Vec::new());
        for face in (0..triangles.len()).filter(|face| lasting.is_curved[*face]) {
            for (side, position) in triangles[face].iter().enumerate() {
                let number: u32 = triangle_normals[face][side];
                let is_same = |node: u32| {
                    let other: u32 = numbers[node as usize];
                    other == number || normals[other as usize].dot(normals[number as usize]) > SAME
                };
                let first = &mut firsts[*position as usize];
                let mut node = *first;
                while node != NONE && !is_same(node) {
                    node = nexts[node as usize];
                }
                if node == NONE {
                    node = numbers.len() as u32;
                    numbers.push(number);
                    places.push(positions[*position as usize].as_vec3());
                    areas.push(0.0);
                    nexts.push(std::mem::replace(first, node));
                }
                areas[node as usize] += lasting.own_areas[face] / 3.0;
                of_corners[face][side] = node;
            }
        }
        let curved = of_corners.iter().filter(|[first, ..]| *first != NONE);
        let pairs = curved.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        let neighbours = Neighbours::new(numbers.len(), pairs);
        let normals = numbers.iter().map(|number| normals[*number as usize]).collect();
        Self { of_corners, places, normals, numbers, areas, neighbours }
    }

    /// The averaged normal of each, over a way between these.
    fn averaged(&self, [least, most]: [f32; 2]) -> Vec<Vec3> {
        let mut normals = self.normals.clone();
        let reach = Reach { least, most, noise: AGREES * self.noise() };
        spread(&self.neighbours, &self.areas, &self.places, &mut normals, &reach);
        let length = |(mean, own): (Vec3, &Vec3)| if mean.length() < SHORTEST { SHORTEST * *own } else { mean };
        normals.into_iter().zip(&self.normals).map(length).collect()
    }

    /// How far a normal is from the mean of those beside it, times how far these are away: the median over the area of some of them.
    fn noise(&self) -> f32 {
        let step = self.normals.len().div_ceil(NOISE_SAMPLES);
        let of = |part: usize| {
            let beside = || self.neighbours.of(part).iter().map(|other| *other as usize);
            let sum: Vec3 = beside().map(|other| self.normals[other]).sum();
            let distances: f32 = beside().map(|other| self.places[other].distance(self.places[part])).sum();
            let count = beside().count() as f32;
            (sum / count).distance(self.normals[part]) * distances / count
        };
        let parts = (0..self.normals.len()).step_by(step).filter(|part| !self.neighbours.of(*part).is_empty());
        let mut found: Vec<(f32, f64)> = parts.map(|part| (of(part), self.areas[part])).collect();
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut left = found.iter().map(|(_, area)| area).sum::<f64>() / 2.0;
        let is_middle = |(_, area): &&(f32, f64)| {
            left -= area;
            left <= 0.0
        };
        found.iter().find(is_middle).map_or(0.0, |(noise, _)| *noise)
    }
}

/// How far normals are averaged, in the model's units.
struct Reach {
    least: f32,
    most: f32,
    /// How far averages may differ that count as the same, times the distance that they are taken over: the mesh's noise.
    noise: f32,
}

/// Averages normals of corners, or of patches, over a reach: by patches of them where they are small. Each level has at most nine tenths
/// of the connected parts of the one below, so their number bounds the depth, whatever the sizes are.
///
/// Where the average over a long way differs from that over a short one by more than the mesh's noise, the surface has form there, and
/// the short one stays (Lepski's rule).
fn spread(neighbours: &Neighbours, areas: &[f64], places: &[Vec3], normals: &mut Vec<Vec3>, reach: &Reach) {
    // A part without neighbours is a whole surface and grows no further.
    let connected = (0..areas.len()).filter(|part| !neighbours.of(*part).is_empty());
    let (count, sum) = connected.fold((0, 0.0), |(count, sum), part| (count + 1, sum + areas[part]));
    let mean = sum / f64::from(count);
    let limit = GROWTH * mean;
    let area = |part: u32| areas[part as usize];
    let joins = |_, _, other, so_far: f64| (so_far + 0.5 * area(other) < limit).then(|| area(other));
    let is_small = mean <= PATCH * f64::from(reach.most * reach.most) / GROWTH;
    let patches = is_small.then(|| Patches::new(neighbours, areas.len(), area, joins));
    let patches = patches.filter(|patches| 10 * (areas.len() - patches.areas.len()) >= count as usize);
    let diffusion = Diffusion::new(neighbours, places);
    let distance = mean.sqrt() as f32;
    let [short, mut long] = [OWN_IN_EDGES * distance, reach.most.max(REACH_IN_EDGES * distance)];
    let mut averaged = normals.clone();
    if let Some(patches) = patches {
        let (mut centres, mut means) = (vec![Vec3::ZERO; patches.areas.len()], vec![Vec3::ZERO; patches.areas.len()]);
        for (part, patch) in patches.of.iter().enumerate() {
            let share = (areas[part] / patches.areas[*patch as usize].max(f64::MIN_POSITIVE)) as f32;
            centres[*patch as usize] += share * places[part];
            means[*patch as usize] += share * normals[part];
        }
        spread(&patches.neighbours, &patches.areas, &centres, &mut means, reach);
        averaged = filled(areas.len(), 1, Vec3::ZERO, |part| means[patches.of[part] as usize]);
        diffusion.spread(&mut averaged, limit as f32 * MOST * FINE_ROUNDS as f32, FINE_ROUNDS, REACH_IN_EDGES);
        // The patches' own shortest way.
        long = (2.0 * short).max(reach.least);
    } else {
        diffusion.spread(&mut averaged, reach.most * reach.most, ROUNDS, REACH_IN_EDGES);
    }
    if 2.0 * short >= reach.least {
        let short = short.max(reach.least);
        diffusion.spread(normals, short * short, ROUNDS, 0.0);
        let apart = (reach.noise * (short.recip() + long.recip())).max(f32::MIN_POSITIVE);
        let share = |part: usize| (2.0 - normals[part].distance(averaged[part]) / apart).clamp(0.0, 1.0);
        let mut shares = filled(areas.len(), 1, Vec3::ZERO, |part| Vec3::splat(share(part)));
        diffusion.spread(&mut shares, limit as f32, ROUNDS, 0.0);
        averaged = filled(areas.len(), 1, Vec3::ZERO, |part| normals[part].lerp(averaged[part], shares[part].x));
    }
    *normals = averaged;
}

/// Spreads values over neighbours, by weights that fall with the distance.
struct Diffusion<'a> {
    neighbours: &'a Neighbours,
    weights: Vec<f32>,
    /// For each part the sum of its weights, and of its distances to its neighbours.
    sums: Vec<[f32; 2]>,
}

impl<'a> Diffusion<'a> {
    fn new(neighbours: &'a Neighbours, places: &[Vec3]) -> Self {
        let (count, threads) = (places.len(), threads_for_items(places.len()));
        let length = |part: usize, other: &u32| places[*other as usize].distance(places[part]).max(f32::MIN_POSITIVE);
        let mut weights = Vec::with_capacity(neighbours.range(count - 1).end);
        (0..count).for_each(|part| weights.extend(neighbours.of(part).iter().map(|other| length(part, other).recip())));
        let sums = filled(count, threads, [0.0; 2], |part| {
            let weights = &weights[neighbours.range(part)];
            weights.iter().fold([0.0, 0.0], |[sum, distances], weight| [sum + weight, distances + weight.recip()])
        });
        Self { neighbours, weights, sums }
    }

    /// Spreads values by the mean square distance `spread`, at least by the square of `least` distances to neighbours.
    fn spread(&self, values: &mut Vec<Vec3>, spread: f32, rounds: usize, least: f32) {
        let (count, threads) = (values.len(), threads_for_items(values.len()));
        // How far a value moves to the mean of its neighbours' in a round, over the sum of these weights. The mean square distance,
        // weighted likewise, is the sum of the distances over that of the weights.
        let steps = filled(count, threads, 0.0, |part| {
            let [sum, distances] = self.sums[part];
            let wanted = (spread * sum / distances).max(least * least);
            if sum == 0.0 { 0.0 } else { (wanted / rounds as f32).min(MOST) / sum }
        });
        for _ in 0..rounds {
            *values = filled(count, threads, Vec3::ZERO, |part| {
                let (own, step) = (values[part], steps[part]);
                let beside = self.neighbours.of(part).iter().zip(&self.weights[self.neighbours.range(part)]);
                own + beside.map(|(other, weight)| (values[*other as usize] - own) * (*weight * step)).sum::<Vec3>()
            });
        }
    }
}
