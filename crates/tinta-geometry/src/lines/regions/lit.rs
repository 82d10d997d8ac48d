//! The light of tones, and the patches of a tone that are too small to draw.
//!
//! In: a scene and the thresholds of a far light. Out: a light from above that leaves a fair, connected share of the visible surface
//! dark; the scene with other normals, so that no tone has a patch below [`LEAST_PATCH`] of the visible surface. Light is linear in
//! each triangle: pixels and exact areas lose a patch alike.

use super::seen_normals::{Sample, SeenNormals, is_back, places};
use crate::disjoint_sets::DisjointSets;
use crate::lines::eye::space::Space;
use crate::mesh::{Mesh, NONE};
use crate::scene::{Object, Scene};
use crate::threads::{cores, filled};
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::sync::Arc;

/// The lights to choose from, the preferred first: directions in the eye's space, from above, from the left or the right.
pub const LIGHTS: [[f32; 3]; 8] = [
    [-0.4, 1.0, 0.6],
    [-0.45, 0.8, 0.8],
    [-0.5, 0.65, 1.0],
    [-0.9, 0.8, 0.8],
    [0.45, 0.8, 0.8],
    [0.5, 0.65, 1.0],
    [0.9, 0.8, 0.8],
    [-0.3, 0.5, 1.3],
];

/// The dark share of the visible surface in an illustrator's drawing, least and largest.
const DARK: [f64; 2] = [0.15, 0.25];

/// The cost of a dark that lies apart in many parts, in shares of the visible surface.
const APART: f64 = 0.15;

/// The least share of the middle tone, and the cost of each missing share.
const LEAST_MIDDLE: f64 = 0.1;
const FLAT: f64 = 0.5;

/// The cost of each place in the list.
const LATER: f64 = 0.004;

/// The least patch of a tone, in shares of the visible surface.
const LEAST_PATCH: f64 = 0.002;

/// A patch with this share of its surface is no speck, however small: half of a hole's wall, for example.
const LARGE_PART: f64 = 0.2;

/// How far beyond a threshold a patch is moved that gets the tone beside it: more than light changes within a pixel, or pixels there
/// would be mixed.
const CLEARANCE: f64 = 0.02;

impl SeenNormals {
    /// Returns the direction of the light that suits the view best, in the eye's space, of any length. `thresholds` are the cosines at
    /// which the second and the third tone begin.
    pub fn best_light(&self, thresholds: [f64; 2]) -> [f32; 3] {
        let cost = |place: usize| cost(self, unit(LIGHTS[place]), thresholds) + LATER * place as f64;
        let costs = filled(LIGHTS.len(), cores(), 0.0, cost);
        let best = (0..LIGHTS.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b]));
        LIGHTS[best.unwrap_or(0)]
    }

    /// Returns the scene that was seen, as a light in this direction shows it: without patches of a tone too small to draw. Objects that
    /// share a mesh keep it.
    pub fn lit(&self, scene: &Scene, towards: [f32; 3], thresholds: [f64; 2]) -> Scene {
        let light = unit(towards);
        let least = LEAST_PATCH * self.samples.iter().flatten().count() as f64;
        let space = Space::of(scene);
        let mut samples: Vec<Vec<Sample>> = vec![Vec::new(); scene.objects.len()];
        self.samples.iter().flatten().for_each(|sample| samples[sample.object as usize].push(*sample));
        let is_shared =
            |mesh: &Arc<Mesh>| scene.objects.iter().filter(|other| Arc::ptr_eq(mesh, &other.mesh)).count() > 1;
        let lit = |(object, samples): (&Object, Vec<Sample>)| {
            if samples.is_empty() || is_shared(&object.mesh) {
                return object.clone();
            }
            let mut corners = LitCorners::of(object, &space, light);
            corners.find_surfaces(&samples, least);
            for threshold in thresholds.into_iter().filter(|threshold| *threshold <= 1.0) {
                corners.flatten(&samples, threshold);
            }
            thresholds.into_iter().for_each(|threshold| corners.clear_borderless(threshold, thresholds));
            corners.applied(object, space.world_direction(light))
        };
        Scene { objects: scene.objects.iter().zip(samples).map(lit).collect(), ..scene.clone() }
    }
}

/// The unit vector in a direction.
fn unit(direction: [f32; 3]) -> DVec3 {
    DVec3::from_array(direction.map(f64::from)).normalize_or_zero()
}

/// How far a light is from an illustrator's choice, in shares of the visible surface.
fn cost(seen: &SeenNormals, light: DVec3, [dark, middle]: [f64; 2]) -> f64 {
    let light = light.as_vec3();
    let cosine = |sample: &Option<Sample>| sample.map(|sample| f64::from(sample.normal.dot(light)));
    let cosines: Vec<Option<f64>> = seen.samples.iter().map(cosine).collect();
    let all = cosines.iter().flatten().count().max(1) as f64;
    let is_dark: Vec<bool> = cosines.iter().map(|cosine| cosine.is_some_and(|cosine| cosine < dark)).collect();
    let dark_count = is_dark.iter().filter(|is_dark| **is_dark).count();
    let share = dark_count as f64 / all;
    let in_middle = cosines.iter().flatten().filter(|cosine| (dark..middle).contains(*cosine)).count() as f64 / all;
    let apart = 1.0 - largest(&is_dark, seen.width) as f64 / dark_count.max(1) as f64;
    (DARK[0] - share).max(share - DARK[1]).max(0.0) + APART * apart + FLAT * (LEAST_MIDDLE - in_middle).max(0.0)
}

/// The size of the largest connected set of marked pixels.
fn largest(is_marked: &[bool], width: usize) -> usize {
    let mut sets = DisjointSets::new(is_marked.len());
    for pixel in (0..is_marked.len()).filter(|pixel| is_marked[*pixel]) {
        if pixel % width > 0 && is_marked[pixel - 1] {
            sets.join([pixel as u32, pixel as u32 - 1]);
        }
        if pixel >= width && is_marked[pixel - width] {
            sets.join([pixel as u32, (pixel - width) as u32]);
        }
    }
    let mut sizes = vec![0; is_marked.len()];
    (0..is_marked.len())
        .filter(|pixel| is_marked[*pixel])
        .for_each(|pixel| sizes[sets.root(pixel as u32) as usize] += 1);
    sizes.into_iter().max().unwrap_or(0)
}

/// The light at the corners of an object's faces. Corners that share a position, a normal and the side that is seen are one.
#[derive(Default)]
struct LitCorners {
    /// Each corner's number.
    of_corners: Vec<[u32; 3]>,
    /// The light on the side that is seen.
    light: Vec<f64>,
    /// How much was added to it.
    added: Vec<f64>,
    /// Whether the side that is seen is the back.
    is_back: Vec<bool>,
    /// A third of the area of the faces around it in the small picture, square pixels.
    areas: Vec<f64>,
    /// The size below which a patch around it is too small, pixels of the small picture.
    least: Vec<f64>,
}

/// The patches of an object on both sides of a threshold.
struct TonePatches {
    sets: DisjointSets,
    /// The faces with corners on both sides.
    mixed: Vec<u32>,
    /// For each patch, by its root, its visible area, and its area without other surfaces before it.
    seen: Vec<f64>,
    whole: Vec<f64>,
}

/// Adds up the areas of each set, given those of its members; by roots.
fn summed(sets: &mut DisjointSets, areas: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; areas.len()];
    for member in (0..areas.len()).filter(|member| areas[*member] > 0.0) {
        sums[sets.root(member as u32) as usize] += areas[member];
    }
    sums
}

impl LitCorners {
    fn of(object: &Object, space: &Space, light: DVec3) -> Self {
        let mesh = &object.mesh;
        let of_normals: Vec<f64> =
            mesh.normals.iter().map(|normal| space.direction(normal.as_dvec3()).dot(light)).collect();
        let places = places(object, space);
        let mut lit = Self { of_corners: vec![[0; 3]; mesh.triangles.len()], ..Self::default() };
        // For each normal and side the position that it first comes with, and its number there.
        let mut firsts = vec![[NONE; 2]; 2 * mesh.normals.len()];
        let mut others: HashMap<[u32; 2], u32> = HashMap::new();
        for (face, (triangle, normals)) in mesh.triangles.iter().zip(&mesh.triangle_normals).enumerate() {
            let [a, b, c] = triangle.map(|position| places[position as usize].0);
            let double_area = (b - a).perp_dot(c - a);
            let is_back = is_back(double_area);
            let area = if double_area.is_nan() { 0.0 } else { double_area.abs() / 6.0 };
            for corner in 0..3 {
                let (position, normal) = (triangle[corner], normals[corner]);
                let slot = 2 * normal + u32::from(is_back);
                let mut number = || {
                    let light = of_normals[normal as usize];
                    lit.light.push(if is_back { -light } else { light });
                    lit.is_back.push(is_back);
                    lit.areas.push(0.0);
                    lit.light.len() as u32 - 1
                };
                let first = &mut firsts[slot as usize];
                if first[0] == NONE {
                    *first = [position, number()];
                }
                let known = if first[0] == position {
                    first[1]
                } else {
                    *others.entry([slot, position]).or_insert_with(number)
                };
                lit.of_corners[face][corner] = known;
                lit.areas[known as usize] += area;
            }
        }
        lit.added = vec![0.0; lit.light.len()];
        lit
    }

    /// Finds for each corner the size of patches that are too small: `least`, or a part of its smooth surface, if that is less.
    fn find_surfaces(&mut self, samples: &[Sample], least: f64) {
        let mut surfaces = DisjointSets::new(self.light.len());
        for [a, b, c] in &self.of_corners {
            surfaces.join([*a, *b]);
            surfaces.join([*b, *c]);
        }
        let mut seen = vec![0.0; self.light.len()];
        samples.iter().for_each(|sample| seen[surfaces.root(self.of_corners[sample.face as usize][0]) as usize] += 1.0);
        let least = |corner: u32| least.min(LARGE_PART * seen[surfaces.root(corner) as usize]);
        self.least = (0..self.light.len() as u32).map(least).collect();
    }

    /// Moves patches that are too small across a threshold, if another tone lies beside them on the same
    /// surface: first the dark ones, for each may lie within the other.
    fn flatten(&mut self, samples: &[Sample], threshold: f64) {
        let mut patches = self.patches(samples, threshold);
        let dark = self.small(&mut patches, threshold, false);
        for face in &patches.mixed {
            let corners = self.of_corners[*face as usize];
            if corners.iter().any(|corner| dark[*corner as usize]) {
                patches.sets.join([corners[0], corners[1]]);
                patches.sets.join([corners[1], corners[2]]);
            }
        }
        self.moved(&dark, threshold + CLEARANCE);
        patches.seen = summed(&mut patches.sets, &patches.seen);
        patches.whole = summed(&mut patches.sets, &patches.whole);
        let light = self.small(&mut patches, threshold, true);
        self.moved(&light, threshold - CLEARANCE);
    }

    /// The patches on both sides of a threshold.
    fn patches(&self, samples: &[Sample], threshold: f64) -> TonePatches {
        let is_above = |corner: u32| self.light[corner as usize] >= threshold;
        let count = self.light.len();
        let mut patches =
            TonePatches { sets: DisjointSets::new(count), mixed: Vec::new(), seen: Vec::new(), whole: Vec::new() };
        for (face, [a, b, c]) in (0..).zip(self.of_corners.iter().copied()) {
            let sides = [a, b, c].map(is_above);
            if sides[0] == sides[1] {
                patches.sets.join([a, b]);
            }
            if sides[1] == sides[2] {
                patches.sets.join([b, c]);
            }
            if sides != [sides[0]; 3] {
                patches.mixed.push(face);
                if sides[0] == sides[2] {
                    patches.sets.join([a, c]);
                }
            }
        }
        let mut seen = vec![0.0; count];
        for sample in samples {
            let corners = self.of_corners[sample.face as usize];
            let lights = corners.map(|corner| self.light[corner as usize]);
            let light: f64 = lights.iter().zip(sample.weights).map(|(light, weight)| light * f64::from(weight)).sum();
            let corner = corners.into_iter().find(|corner| is_above(*corner) == (light >= threshold));
            corner.into_iter().for_each(|corner| seen[corner as usize] += 1.0);
        }
        patches.seen = summed(&mut patches.sets, &seen);
        patches.whole = summed(&mut patches.sets, &self.areas);
        patches
    }

    /// For each corner whether its patch is on that side of the threshold, too small, and beside another tone.
    fn small(&self, patches: &mut TonePatches, threshold: f64, is_above: bool) -> Vec<bool> {
        let is_in = |corner: u32| (self.light[corner as usize] >= threshold) == is_above;
        let mut is_small = vec![false; self.light.len()];
        for face in &patches.mixed {
            let corners = self.of_corners[*face as usize];
            // Faces moved across since are mixed no more.
            if corners.iter().all(|corner| is_in(*corner)) {
                continue;
            }
            for corner in corners.into_iter().filter(|corner| is_in(*corner)) {
                let patch = patches.sets.root(corner) as usize;
                let (seen, whole, least) = (patches.seen[patch], patches.whole[patch], self.least[patch]);
                is_small[patch] = seen < least && (seen > 0.0 || whole < least);
            }
        }
        if !is_small.contains(&true) {
            return is_small;
        }
        (0..is_small.len() as u32).map(|corner| is_in(corner) && is_small[patches.sets.root(corner) as usize]).collect()
    }

    /// Moves the light away from a threshold in faces without a border of tones around corners: a pixel beside the threshold is
    /// mixed, and would show a border where none is. No tone changes.
    fn clear_borderless(&mut self, threshold: f64, [dark, middle]: [f64; 2]) {
        let clearance = CLEARANCE.min((middle - dark) * 0.5);
        let mut has_border = vec![false; self.light.len()];
        for corners in &self.of_corners {
            let is_above = corners.map(|corner| self.light[corner as usize] >= threshold);
            if is_above != [is_above[0]; 3] {
                corners.iter().for_each(|corner| has_border[*corner as usize] = true);
            }
        }
        for (is_above, light) in [(true, threshold + clearance), (false, threshold - clearance)] {
            let is_near = |corner: usize| {
                let own = self.light[corner];
                !has_border[corner] && (own >= threshold) == is_above && (own - threshold).abs() < clearance
            };
            let near: Vec<bool> = (0..has_border.len()).map(is_near).collect();
            self.moved(&near, light);
        }
    }

    /// Gives corners this light.
    fn moved(&mut self, corners: &[bool], light: f64) {
        for corner in (0..corners.len()).filter(|corner| corners[*corner]) {
            self.added[corner] += light - self.light[corner];
            self.light[corner] = light;
        }
    }

    /// The object with normals that give this light, whose direction in the world is `light`.
    fn applied(&self, object: &Object, light: DVec3) -> Object {
        if self.added.iter().all(|added| *added == 0.0) {
            return object.clone();
        }
        let mesh = &object.mesh;
        let (mut normals, mut triangle_normals) = (mesh.normals.clone(), mesh.triangle_normals.clone());
        let mut numbers = vec![NONE; self.light.len()];
        for (corner, normal) in self.of_corners.as_flattened().iter().zip(triangle_normals.as_flattened_mut()) {
            let corner = *corner as usize;
            if self.added[corner] == 0.0 {
                continue;
            }
            if numbers[corner] == NONE {
                let side = if self.is_back[corner] { -1.0 } else { 1.0 };
                let changed: Vec3 = normals[*normal as usize] + (light * (side * self.added[corner])).as_vec3();
                normals.push(changed);
                numbers[corner] = normals.len() as u32 - 1;
            }
            *normal = numbers[corner];
        }
        object.with_normals(normals, triangle_normals)
    }
}
