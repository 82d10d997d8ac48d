//! Faces' normals without the bumps of a scan: each is made the mean of its neighbours' that differ little from it, again and again (a
//! bilateral filter: Y. Zheng, H. Fu, O. K.-C. Au, C.-L. Tai, *Bilateral normal filtering for mesh denoising*, 2011). Edges sharper than the
//! smoothing angle stay, and so do faces that are large: those of machine parts and of models of few triangles.

use crate::threads::{cores, filled};
use glam::{DVec3, Vec3A};

/// How far normals are evened out, in shares of the diagonal of the model's box: the standard deviation of what a normal is mixed from.
const REACH: f64 = 0.012;

/// Most rounds: more than finely meshed models of a million triangles are worth.
const MOST_ROUNDS: f64 = 48.0;

/// Faces, times rounds, below which a second thread costs more than it brings.
const WORTH_A_THREAD: usize = 500_000;

/// Which faces lie beside which.
pub(super) struct Neighbours {
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Neighbours {
    pub(super) fn new(count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut starts = vec![0u32; count + 1];
        pairs.clone().flatten().for_each(|face| starts[face as usize + 1] += 1);
        (0..count).for_each(|face| starts[face + 1] += starts[face]);
        let mut next = starts.clone();
        let mut faces = vec![0; starts[count] as usize];
        for [a, b] in pairs {
            for [face, other] in [[a, b], [b, a]] {
                faces[next[face as usize] as usize] = other;
                next[face as usize] += 1;
            }
        }
        Self { starts, faces }
    }

    fn of(&self, face: usize) -> &[u32] {
        &self.faces[self.starts[face] as usize..self.starts[face + 1] as usize]
    }
}

/// Whether a flat face of that area is smaller than what is evened out.
pub(super) fn is_small(area: f64, diagonal: f64) -> bool {
    area < (REACH * diagonal).powi(2)
}

/// The unit normals evened out. `areas` are those of the flat faces, in the square of the unit of `diagonal`.
pub(super) fn even(
    normals: &[DVec3],
    areas: &[f64],
    neighbours: &Neighbours,
    diagonal: f64,
    cos_smooth: f64,
) -> Vec<DVec3> {
    let reach = REACH * diagonal;
    let small: Vec<u32> = (0..normals.len() as u32).filter(|face| is_small(areas[*face as usize], diagonal)).collect();
    let mean = small.iter().map(|face| areas[*face as usize]).sum::<f64>() / small.len().max(1) as f64;
    // Neighbours' centres are about 0.9 of the root of their area apart; a quarter of that, squared, is what a round adds to the
    // variance in each direction.
    let rounds = (reach * reach / (0.2 * mean)).min(MOST_ROUNDS).round() as usize;
    if small.is_empty() || rounds == 0 {
        return normals.to_vec();
    }
    // A large face is all round a small one, but not farther than what is evened out.
    let weights: Vec<f32> = areas.iter().map(|area| (area / (reach * reach)).min(1.0) as f32).collect();
    let threads = if small.len() * rounds < WORTH_A_THREAD { 1 } else { cores() };
    let (cos_smooth, scale) = (cos_smooth as f32, (1.0 / (1.0 - cos_smooth).max(f64::EPSILON)) as f32);
    let mut current: Vec<Vec3A> = normals.iter().map(|normal| normal.as_vec3a()).collect();
    for _ in 0..rounds {
        let mixed = filled(small.len(), threads, Vec3A::ZERO, |place| {
            let face = small[place] as usize;
            let own = current[face];
            let mut sum = weights[face] * own;
            for &other in neighbours.of(face) {
                let normal = current[other as usize];
                sum += weights[other as usize] * ((own.dot(normal) - cos_smooth) * scale).max(0.0) * normal;
            }
            sum.try_normalize().unwrap_or(own)
        });
        small.iter().zip(mixed).for_each(|(face, normal)| current[*face as usize] = normal);
    }
    let mut evened = normals.to_vec();
    small.iter().for_each(|face| evened[*face as usize] = current[*face as usize].as_dvec3());
    evened
}

#[cfg(test)]
#[path = "even_tests.rs"]
mod tests;
