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

/// How far normals are averaged, in shares of the diagonal of the model's box: the root of the mean square of the distance.
const REACH: f64 = 0.021;

/// The same in distances to a corner's neighbours, where these are far apart.
const REACH_IN_EDGES: f32 = 1.5;

/// The area of the largest patches, in squares of that reach.
const PATCH: f64 = 0.25;

/// How many times as large as the parts that it is made of a patch is.
const GROWTH: f64 = 4.0;

/// Rounds of diffusion over the largest patches: enough for their size.
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
    lasting: &PersistentCreases,
    first: u32,
    normals: &mut Vec<Vec3>,
    triangle_normals: &mut [[u32; 3]],
) {
    if !lasting.is_curved.contains(&true) {
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
    let numbers: Vec<u32> = nodes.numbers.iter().zip(nodes.averaged(REACH * lasting.diagonal)).map(place).collect();
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

    /// The averaged normal of each.
    fn averaged(&self, reach: f64) -> Vec<Vec3> {
        let mut normals = self.normals.clone();
        spread(&self.neighbours, &self.areas, &self.places, &mut normals, reach);
        let length = |(mean, own): (Vec3, &Vec3)| if mean.length() < SHORTEST { SHORTEST * *own } else { mean };
        normals.into_iter().zip(&self.normals).map(length).collect()
    }
}

/// Averages normals of corners, or of patches, over a reach: by patches of them where they are small. Each level has at most nine tenths
/// of the connected parts of the one below, so their number bounds the depth, whatever the sizes are.
fn spread(neighbours: &Neighbours, areas: &[f64], places: &[Vec3], normals: &mut Vec<Vec3>, reach: f64) {
    // A part without neighbours is a whole surface and grows no further.
    let connected = (0..areas.len()).filter(|part| !neighbours.of(*part).is_empty());
    let (count, sum) = connected.fold((0, 0.0), |(count, sum), part| (count + 1, sum + areas[part]));
    let mean = sum / f64::from(count);
    let limit = GROWTH * mean;
    let area = |part: u32| areas[part as usize];
    let joins = |_, _, other, so_far: f64| (so_far + 0.5 * area(other) < limit).then(|| area(other));
    let is_small = mean <= PATCH * reach * reach / GROWTH;
    let patches = is_small.then(|| Patches::new(neighbours, areas.len(), area, joins));
    let Some(patches) = patches.filter(|patches| 10 * (areas.len() - patches.areas.len()) >= count as usize) else {
        diffuse(neighbours, places, normals, (reach * reach) as f32, ROUNDS);
        return;
    };
    let (mut centres, mut means) = (vec![Vec3::ZERO; patches.areas.len()], vec![Vec3::ZERO; patches.areas.len()]);
    for (part, patch) in patches.of.iter().enumerate() {
        let share = (areas[part] / patches.areas[*patch as usize].max(f64::MIN_POSITIVE)) as f32;
        centres[*patch as usize] += share * places[part];
        means[*patch as usize] += share * normals[part];
    }
    spread(&patches.neighbours, &patches.areas, &centres, &mut means, reach);
    *normals = filled(areas.len(), 1, Vec3::ZERO, |part| means[patches.of[part] as usize]);
    diffuse(neighbours, places, normals, (limit * f64::from(MOST)) as f32 * FINE_ROUNDS as f32, FINE_ROUNDS);
}

/// Spreads normals by the mean square distance `spread`.
fn diffuse(neighbours: &Neighbours, places: &[Vec3], normals: &mut Vec<Vec3>, spread: f32, rounds: usize) {
    let (count, threads) = (normals.len(), threads_for_items(normals.len()));
    let length = |part: usize, other: &u32| places[*other as usize].distance(places[part]).max(f32::MIN_POSITIVE);
    let mut weights = Vec::with_capacity(neighbours.range(count - 1).end);
    (0..count).for_each(|part| weights.extend(neighbours.of(part).iter().map(|other| length(part, other).recip())));
    // How far each moves to the mean of its neighbours' in a round, over the sum of these weights. The mean square distance, weighted
    // likewise, is the sum of the distances over that of the weights.
    let steps = filled(count, threads, 0.0, |part| {
        let weights = &weights[neighbours.range(part)];
        let (sum, distances) =
            weights.iter().fold((0.0, 0.0), |(sum, distances), weight| (sum + weight, distances + weight.recip()));
        if weights.is_empty() {
            return 0.0;
        }
        let wanted = (spread * sum / distances).max(REACH_IN_EDGES * REACH_IN_EDGES);
        (wanted / rounds as f32).min(MOST) / sum
    });
    for _ in 0..rounds {
        *normals = filled(count, threads, Vec3::ZERO, |part| {
            let (own, step) = (normals[part], steps[part]);
            let beside = neighbours.of(part).iter().zip(&weights[neighbours.range(part)]);
            own + beside.map(|(other, weight)| (normals[*other as usize] - own) * (*weight * step)).sum::<Vec3>()
        });
    }
}
