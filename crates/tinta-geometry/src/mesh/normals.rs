//! Computes normals for corners without one in the file: smooth inside a group of faces, split along creases.
//!
//! Also holds the simpler rule of C. Dachsbacher's article ([`one_a_position`]).
//!
//! In: welded triangles and a smoothing angle. Out: one unit normal per group of faces around a vertex, and each corner's
//! index. A group contains the faces connected around the vertex over shared edges whose faces differ by at most the angle. A
//! face's weight is the sine of its angle at the vertex over the lengths of its sides there (Max 1999: exact on a sphere). This
//! needs no arc cosine and, on a square, does not depend on the diagonal. If only persistent creases are split
//! (`persistent_creases.rs`), all other vertices are smooth, flat faces are weighted by area, and normals of curved surfaces are
//! averaged over a share of the model's size (`average.rs`), those of the file too.

mod average;
mod curved;
mod incidence;
mod patches;
mod persistent_creases;

use super::NONE;
use crate::threads::{in_parallel, threads_for};
use crate::tolerances::CANCELLED_NORMALS;
use average::average;
use glam::{DVec3, Vec3};
pub(super) use incidence::Incidence;
use persistent_creases::PersistentCreases;

/// The angles at which normals are split.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Splitting {
    /// Cosine of the largest angle between neighbouring faces that share a normal; above 1 none do.
    pub cos_smooth: f64,
    /// The same around flat faces, and beside a persistent crease that ends at a vertex, where a near-crease continues it. `None`
    /// if all creases are split.
    pub cos_beside: Option<f64>,
    /// How far normals are averaged then, in shares of the diagonal of the model's box; 0: not.
    pub reach: f64,
}

/// Computes a normal for every corner whose entry in `triangle_normals` is [`NONE`] and appends it to `normals`.
///
/// `face_normals` holds each triangle's unit normal.
pub(super) fn fill_missing(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    face_normals: &[DVec3],
    Splitting { cos_smooth, cos_beside, reach }: Splitting,
    normals: &mut Vec<Vec3>,
    triangle_normals: &mut [[u32; 3]],
) {
    if cos_beside.is_none() && !triangle_normals.as_flattened().contains(&NONE) {
        return;
    }
    let incidence = Incidence::new(positions.len(), triangles);
    let lasting =
        cos_beside.map(|cos| PersistentCreases::find(positions, triangles, face_normals, &incidence, cos_smooth, cos));
    let cos_smooth = lasting.as_ref().map_or(cos_smooth, |lasting| lasting.cos_smooth);
    let is_smooth = |vertex: usize| lasting.as_ref().is_some_and(|lasting| !lasting.vertices[vertex]);
    let weighted = |corner: u32| match &lasting {
        None => weighted_normal(positions, triangles, corner),
        // Also weighted by the angle: a face then counts the same however it is cut into triangles.
        Some(lasting) => {
            let face = corner as usize / 3;
            face_normals[face] * (lasting.areas[face] * lasting.angles[corner as usize])
        }
    };
    let half = |cos: f64| ((1.0 + cos) * 0.5).max(0.0).sqrt();
    let cos_of = |vertex: usize| match (&lasting, cos_beside) {
        (Some(lasting), Some(cos_beside)) if lasting.borders[vertex] => cos_beside,
        _ => cos_smooth,
    };
    let is_missing = |corner: u32| triangle_normals[corner as usize / 3][corner as usize % 3] == NONE;
    let found = in_parallel(positions.len(), threads_for(triangles.len()), |vertices| {
        let corners = incidence.corners_of(&vertices);
        let mut found =
            CornerNormals { normals: Vec::with_capacity(vertices.len()), indices: Vec::with_capacity(corners.len()) };
        let mut fan = Fan::default();
        for vertex in vertices {
            let corners = incidence.corners(vertex);
            if !corners.iter().any(|corner| is_missing(*corner)) {
                found.indices.resize(found.indices.len() + corners.len(), NONE);
                continue;
            }
            let face_normal = |corner: &u32| face_normals[*corner as usize / 3];
            // Most fans are smooth throughout: any two faces are within the angle, and no edge needs a test. Fans that only
            // touch in the vertex are joined too when they agree so well; that does no harm.
            let mean = corners.iter().map(face_normal).sum::<DVec3>().normalize_or_zero();
            let is_smooth = is_smooth(vertex);
            let cos_smooth = cos_of(vertex);
            let cos_half = half(cos_smooth);
            if is_smooth || corners.iter().all(|corner| face_normal(corner).dot(mean) >= cos_half) {
                let sum = corners.iter().map(|corner| weighted(*corner)).sum();
                let is_its_own =
                    |normal: &DVec3| !is_smooth || corners.iter().all(|it| face_normal(it).dot(*normal) > 0.0);
                if let Some(normal) = smooth(sum).filter(is_its_own) {
                    found.normals.push(normal.as_vec3());
                    let index = found.normals.len() as u32 - 1;
                    found.indices.extend(corners.iter().map(|corner| if is_missing(*corner) { index } else { NONE }));
                    continue;
                }
                match is_smooth {
                    // A face that is turned over forms a separate group; otherwise it would be drawn from inside.
                    true => fan.group(triangles, face_normals, corners, 0.0),
                    false => fan.join_all(corners.len()),
                }
            } else {
                fan.group(triangles, face_normals, corners, cos_smooth);
                if let Some(cos_beside) = cos_beside
                    && fan.strays(face_normals, corners, [cos_smooth, cos_half], weighted)
                {
                    fan.group(triangles, face_normals, corners, cos_beside);
                }
            }
            fan.write(face_normals, corners, weighted, is_missing, &mut found);
        }
        found
    });
    let first = normals.len() as u32;
    normals.reserve_exact(found.iter().map(|found| found.normals.len()).sum());
    let mut corners = incidence.all_corners.iter();
    for mut found in found {
        let before = normals.len() as u32;
        normals.append(&mut found.normals);
        for (index, corner) in found.indices.iter().zip(corners.by_ref()).filter(|(index, _)| **index != NONE) {
            triangle_normals[*corner as usize / 3][*corner as usize % 3] = before + index;
        }
    }
    if let Some(lasting) = &lasting {
        average(positions, triangles, (lasting, reach), first, normals, triangle_normals);
    }
}

/// Computes normals by the rule of *Beethoven aus Bits und Bytes*: each position gets the normalised sum of its triangles' unit
/// normals. Every triangle has the same weight, and creases are not split.
///
/// If a position's normals cancel out, the article divides by 0; here its first triangle gives the normal.
pub(super) fn one_a_position(position_count: usize, triangles: &[[u32; 3]], face_normals: &[DVec3]) -> Vec<Vec3> {
    let mut sums = vec![DVec3::ZERO; position_count];
    for (triangle, normal) in triangles.iter().zip(face_normals) {
        triangle.iter().for_each(|position| sums[*position as usize] += normal);
    }
    let has_direction = |sum: &DVec3| sum.length() > CANCELLED_NORMALS;
    let mut normals: Vec<Option<DVec3>> =
        sums.into_iter().map(|sum| has_direction(&sum).then(|| sum.normalize())).collect();
    for (triangle, normal) in triangles.iter().zip(face_normals) {
        for position in triangle {
            normals[*position as usize].get_or_insert(*normal);
        }
    }
    normals.into_iter().map(|normal| normal.unwrap_or(DVec3::Y).as_vec3()).collect()
}

/// The normals of some vertices' corners.
struct CornerNormals {
    normals: Vec<Vec3>,
    /// For each corner, in the incidence's order, its normal here, or [`NONE`] if it already has one.
    indices: Vec<u32>,
}

/// A face's normal with its weight at one of its corners (Max 1999).
fn weighted_normal(positions: &[DVec3], triangles: &[[u32; 3]], corner: u32) -> DVec3 {
    let triangle = triangles[corner as usize / 3];
    let [at, next, previous] = [0, 1, 2].map(|step| positions[triangle[(corner as usize % 3 + step) % 3] as usize]);
    let (to_next, to_previous) = (next - at, previous - at);
    to_next.cross(to_previous) / (to_next.length_squared() * to_previous.length_squared())
}

/// The direction of a sum of normals, if it has one.
fn smooth(sum: DVec3) -> Option<DVec3> {
    (sum / sum.abs().max_element()).try_normalize()
}

/// The faces around one vertex; kept between vertices to reuse its memory.
#[derive(Default)]
struct Fan {
    /// (far end of an edge at the vertex, face in the fan), two a face.
    spokes: Vec<(u32, u32)>,
    /// Union-find over the faces.
    parents: Vec<u32>,
    /// Each group's summed normal, then its index in the mesh's normals.
    sums: Vec<DVec3>,
    indices: Vec<u32>,
}

impl Fan {
    /// Makes all faces one group.
    fn join_all(&mut self, count: usize) {
        self.parents.clear();
        self.parents.resize(count, 0);
    }

    /// Joins faces that share an edge at this vertex and differ by no more than the angle.
    fn group(&mut self, triangles: &[[u32; 3]], face_normals: &[DVec3], corners: &[u32], cos_smooth: f64) {
        self.spokes.clear();
        self.parents.clear();
        self.parents.extend(0..corners.len() as u32);
        for (face, &corner) in corners.iter().enumerate() {
            let triangle = triangles[corner as usize / 3];
            let far = [1, 2].map(|step| triangle[(corner as usize % 3 + step) % 3]);
            self.spokes.extend(far.map(|far| (far, face as u32)));
        }
        self.spokes.sort_unstable();
        let face_normal = |face: u32| face_normals[corners[face as usize] as usize / 3];
        for pair in 0..self.spokes.len() - 1 {
            let ((far, face), (other_far, other_face)) = (self.spokes[pair], self.spokes[pair + 1]);
            if far == other_far && face_normal(face).dot(face_normal(other_face)) >= cos_smooth {
                let (root, other_root) = (self.root(face), self.root(other_face));
                self.parents[root.max(other_root) as usize] = root.min(other_root);
            }
        }
    }

    /// Sums each group's normals.
    fn sum(&mut self, corners: &[u32], weighted: impl Fn(u32) -> DVec3) {
        self.sums.clear();
        self.sums.resize(corners.len(), DVec3::ZERO);
        for (face, &corner) in corners.iter().enumerate() {
            let root = self.root(face as u32) as usize;
            self.sums[root] += weighted(corner);
        }
    }

    /// Whether a face beside a crease deviates from its group's normal by more than half the angle, which would blur the
    /// crease.
    fn strays(
        &mut self,
        face_normals: &[DVec3],
        corners: &[u32],
        [cos_smooth, cos_half]: [f64; 2],
        weighted: impl Fn(u32) -> DVec3,
    ) -> bool {
        self.sum(corners, weighted);
        let face_normal = |face: u32| face_normals[corners[face as usize] as usize / 3];
        (1..self.spokes.len()).any(|spoke| {
            let ((far, face), (other_far, other)) = (self.spokes[spoke - 1], self.spokes[spoke]);
            far == other_far
                && face_normal(face).dot(face_normal(other)) < cos_smooth
                && [face, other].iter().any(|face| {
                    let root = self.root(*face) as usize;
                    smooth(self.sums[root]).is_none_or(|normal| normal.dot(face_normal(*face)) < cos_half)
                })
        })
    }

    fn root(&mut self, mut face: u32) -> u32 {
        while self.parents[face as usize] != face {
            // Path halving keeps long chains cheap.
            self.parents[face as usize] = self.parents[self.parents[face as usize] as usize];
            face = self.parents[face as usize];
        }
        face
    }

    fn write(
        &mut self,
        face_normals: &[DVec3],
        corners: &[u32],
        weighted: impl Fn(u32) -> DVec3,
        is_missing: impl Fn(u32) -> bool,
        found: &mut CornerNormals,
    ) {
        self.sum(corners, weighted);
        self.indices.clear();
        self.indices.resize(corners.len(), NONE);
        for (face, &corner) in corners.iter().enumerate() {
            if !is_missing(corner) {
                found.indices.push(NONE);
                continue;
            }
            let root = self.root(face as u32) as usize;
            // If faces cancel out, the face's own normal is the best choice.
            let smooth = smooth(self.sums[root]);
            if smooth.is_none() || self.indices[root] == NONE {
                found.normals.push(smooth.unwrap_or(face_normals[corner as usize / 3]).as_vec3());
                self.indices[root] = found.normals.len() as u32 - 1;
            }
            found.indices.push(self.indices[root]);
        }
    }
}

#[cfg(test)]
mod tests;
