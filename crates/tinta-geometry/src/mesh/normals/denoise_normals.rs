//! Removes a scan's noise from faces' normals: each becomes the mean of its similar neighbours' normals, repeatedly (a
//! bilateral filter: Y. Zheng, H. Fu, O. K.-C. Au, C.-L. Tai, *Bilateral normal filtering for mesh denoising*, 2011).
//!
//! Noise is measured first (`noise.rs`). Normals stay unchanged where the surface is free of noise, and on large faces, as of
//! machine parts and models of few triangles. Elsewhere the filter mixes normals that differ by less than a few times the
//! noise, which keeps relief. It mixes patches of faces (`patches.rs`), so a finer mesh takes hardly more time.

use super::noise::{Place, noise};
use super::patches::{Neighbours, Patches};
use crate::threads::{cores, filled, threads_for};
use glam::{DVec3, Vec3A};
use std::f64::consts::PI;

/// Reach of the filter, in shares of the diagonal of the model's box: the standard deviation of the places mixed into a normal.
const REACH: f64 = 0.012;

/// The area of a patch, in squares of that reach.
const PATCH: f64 = 1.0 / 16.0;

/// The area of a region whose noise is measured, in squares of that reach: in a print three lines wide, too narrow for relief.
const REGION: f64 = 0.6;

/// The reach of mixing patches into a face's normal, in squares of that reach; it hides the patches' borders.
const BLENDED: f64 = 0.5;

/// Noise to ignore, radians: a degree moves a tone's border invisibly.
const CALM: f64 = 0.0175;

/// Relief differs by more than this many times the noise.
const RELIEF: f64 = 5.0;

/// Most rounds, a guard only: as many as patches are worth where all have their least area.
const MOST_ROUNDS: f64 = 80.0;

/// Patches, times rounds, below which a second thread costs more than it brings.
const WORTH_A_THREAD: usize = 500_000;

/// A surface's triangles, with flat faces that are cut into several.
pub(super) struct Faces<'a> {
    pub positions: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    /// Unit normals of the triangles.
    pub normals: &'a [DVec3],
    /// Areas of the triangles.
    pub areas: &'a [f64],
    /// The flat face that each is part of.
    pub flat: &'a [u32],
    pub flat_areas: &'a [f64],
    pub neighbours: &'a Neighbours,
}

impl Faces<'_> {
    fn centre(&self, face: usize) -> DVec3 {
        self.triangles[face].iter().map(|vertex| self.positions[*vertex as usize]).sum::<DVec3>() / 3.0
    }

    fn flat_area(&self, face: u32) -> f64 {
        self.flat_areas[self.flat[face as usize] as usize]
    }
}

/// The triangles' unit normals evened out, and whether each is where there is noise.
pub(super) struct DenoisedNormals {
    pub normals: Vec<DVec3>,
    pub is_noisy: Vec<bool>,
}

/// Evens out normals; `diagonal` is that of the model's box, in its own unit.
pub(super) fn denoised(faces: &Faces<'_>, diagonal: f64, cos_smooth: f64) -> DenoisedNormals {
    let unit = (REACH * diagonal).powi(2);
    let patches = patches(faces, unit, cos_smooth);
    let count = patches.areas.len();
    let mut places = vec![Place { centre: DVec3::ZERO, normal: DVec3::ZERO }; count];
    for (face, patch) in patches.of.iter().enumerate() {
        let place = &mut places[*patch as usize];
        place.centre += faces.areas[face] * faces.centre(face);
        place.normal += faces.areas[face] * faces.normals[face];
    }
    for (place, area) in places.iter_mut().zip(&patches.areas) {
        (place.centre, place.normal) = (place.centre / *area, place.normal.normalize_or_zero());
    }
    let is_small = |patch: u32| patches.areas[patch as usize] < unit;
    let noise = noise(&patches, &places, REGION * unit, cos_smooth, is_small);
    let limit = |patch: usize| {
        let is_noisy = is_small(patch as u32) && noise[patch] > CALM;
        if is_noisy { Limit::new((RELIEF * noise[patch]).min(PI).cos().max(cos_smooth)) } else { Limit::NONE }
    };
    let limits: Vec<Limit> = (0..count).map(limit).collect();
    if !limits.iter().any(|limit| limit.is_noisy()) {
        return DenoisedNormals { normals: faces.normals.to_vec(), is_noisy: vec![false; faces.normals.len()] };
    }
    mix(&patches, &limits, &mut places, unit);
    let threads = threads_for(faces.normals.len());
    let reach = BLENDED * unit;
    let normals = filled(faces.normals.len(), threads, DVec3::ZERO, |face| {
        let patch = patches.of[face] as usize;
        let (own, limit) = (places[patch], limits[patch]);
        if !limit.is_noisy() {
            return faces.normals[face];
        }
        let centre = faces.centre(face);
        let near = |place: &Place| (1.0 - place.centre.distance_squared(centre) / reach).max(0.0);
        let beside = patches.neighbours.of(patch).iter().map(|other| {
            let place = &places[*other as usize];
            near(place) * f64::from(limit.weight(own.normal.dot(place.normal) as f32)) * place.normal
        });
        (near(&own).max(f64::EPSILON) * own.normal + beside.sum::<DVec3>()).normalize_or(own.normal)
    });
    DenoisedNormals { normals, is_noisy: patches.of.iter().map(|patch| limits[*patch as usize].is_noisy()).collect() }
}

/// Which normals are mixed with one.
#[derive(Clone, Copy)]
struct Limit {
    cosine: f32,
    scale: f32,
}

impl Limit {
    /// For a surface without noise.
    const NONE: Self = Self { cosine: 1.0, scale: 0.0 };

    /// Of normals within an angle of that cosine; 1 and more are hardly any.
    fn new(cosine: f64) -> Self {
        let cosine = cosine.min(1.0 - 1e-6);
        Self { cosine: cosine as f32, scale: (1.0 / (1.0 - cosine)) as f32 }
    }

    fn is_noisy(self) -> bool {
        self.scale > 0.0
    }

    /// Returns a normal's weight by its cosine with the filtered one: 1 for equal normals, 0 beyond the limit.
    fn weight(self, cosine: f32) -> f32 {
        ((cosine - self.cosine) * self.scale).max(0.0)
    }
}

/// Gathers small faces into patches. A flat face lies whole in one patch, and a large one forms its own patch.
fn patches(faces: &Faces<'_>, unit: f64, cos_smooth: f64) -> Patches {
    let is_small = |face: u32| faces.flat_area(face) < unit;
    let begins = |face: u32| faces.flat_area(face);
    Patches::new(faces.neighbours, faces.normals.len(), begins, |first, face, other, area| {
        if faces.flat[face as usize] == faces.flat[other as usize] {
            // It was counted with its first triangle.
            return Some(0.0);
        }
        let [normal, other_normal] = [first, other].map(|face| faces.normals[face as usize]);
        let is_near =
            area < PATCH * unit && is_small(first) && is_small(other) && normal.dot(other_normal) > cos_smooth;
        is_near.then(|| faces.flat_area(other))
    })
}

/// Mixes the normals of noisy patches with their neighbours'.
fn mix(patches: &Patches, limits: &[Limit], places: &mut [Place], unit: f64) {
    let noisy: Vec<u32> = (0..limits.len() as u32).filter(|patch| limits[*patch as usize].is_noisy()).collect();
    let mean = noisy.iter().map(|patch| patches.areas[*patch as usize]).sum::<f64>() / noisy.len() as f64;
    // Neighbours' centres are about 0.9 of the root of their area apart; each round adds a quarter of that, squared, to the
    // variance in each direction.
    let rounds = (unit / (0.2 * mean)).min(MOST_ROUNDS).round() as usize;
    // A large face surrounds a small one, but not beyond the filter's reach.
    let weights: Vec<f32> = patches.areas.iter().map(|area| (area / unit).min(1.0) as f32).collect();
    let threads = if noisy.len() * rounds < WORTH_A_THREAD { 1 } else { cores() };
    let mut current: Vec<Vec3A> = places.iter().map(|place| place.normal.as_vec3a()).collect();
    for _ in 0..rounds {
        let mixed = filled(noisy.len(), threads, Vec3A::ZERO, |place| {
            let patch = noisy[place] as usize;
            let (own, limit) = (current[patch], limits[patch]);
            let mut sum = weights[patch] * own;
            for &other in patches.neighbours.of(patch) {
                let normal = current[other as usize];
                sum += weights[other as usize] * limit.weight(own.dot(normal)) * normal;
            }
            sum.try_normalize().unwrap_or(own)
        });
        noisy.iter().zip(mixed).for_each(|(patch, normal)| current[*patch as usize] = normal);
    }
    noisy.iter().for_each(|patch| places[*patch as usize].normal = current[*patch as usize].as_dvec3());
}

#[cfg(test)]
#[path = "denoise_normals_tests.rs"]
mod tests;
