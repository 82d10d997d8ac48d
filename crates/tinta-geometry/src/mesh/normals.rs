//! Normals for the corners a file gives none for: smooth inside a group of faces, split along creases.
//!
//! Beside it the simpler rule of C. Dachsbacher's article ([`one_a_position`]).
//!
//! In: welded triangles and a smoothing angle. Out: one unit normal per group of faces around a vertex, and each
//! corner's index. A group is what can be reached around the vertex over shared edges whose faces differ by no more
//! than the angle. Faces weigh in with the sine of their angle at the vertex over the lengths of the sides there (Max 1999:
//! exact on a sphere), which needs no arc cosine and, on a square, does not depend on how it is cut.

use super::NONE;
use crate::threads::{in_parallel, threads_for};
use crate::tolerances::CANCELLED_NORMALS;
use glam::{DVec3, Vec3};
use std::ops::Range;

/// Computes a normal for every corner whose entry in `triangle_normals` is [`NONE`] and appends it to `normals`.
///
/// `face_normals` holds each triangle's unit normal; `cos_smooth` is the cosine of the largest angle between neighbouring
/// faces that still share a normal; above 1 none do.
pub(super) fn fill_missing(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    face_normals: &[DVec3],
    cos_smooth: f64,
    normals: &mut Vec<Vec3>,
    triangle_normals: &mut [[u32; 3]],
) {
    if !triangle_normals.as_flattened().contains(&NONE) {
        return;
    }
    let incidence = Incidence::new(positions.len(), triangles);
    let cos_half = ((1.0 + cos_smooth) * 0.5).max(0.0).sqrt();
    let is_missing = |corner: u32| triangle_normals[corner as usize / 3][corner as usize % 3] == NONE;
    let found = in_parallel(positions.len(), threads_for(triangles.len()), |vertices| {
        let corners = incidence.corners_of(&vertices);
        let mut found =
            Found { normals: Vec::with_capacity(vertices.len()), indices: Vec::with_capacity(corners.len()) };
        let mut fan = Fan::default();
        for vertex in vertices {
            let corners = incidence.corners(vertex);
            if !corners.iter().any(|corner| is_missing(*corner)) {
                found.indices.resize(found.indices.len() + corners.len(), NONE);
                continue;
            }
            let face_normal = |corner: &u32| face_normals[*corner as usize / 3];
            // Most fans are smooth throughout; then any two faces are within the angle and no edge needs to be looked at.
            // Fans that only touch in the vertex are joined too when they agree so well; that does no harm.
            let mean = corners.iter().map(face_normal).sum::<DVec3>().normalize_or_zero();
            if corners.iter().all(|corner| face_normal(corner).dot(mean) >= cos_half) {
                let sum = corners.iter().map(|corner| weighted_normal(positions, triangles, *corner)).sum();
                if let Some(normal) = smooth(sum) {
                    found.normals.push(normal.as_vec3());
                    let index = found.normals.len() as u32 - 1;
                    found.indices.extend(corners.iter().map(|corner| if is_missing(*corner) { index } else { NONE }));
                    continue;
                }
                fan.join_all(corners.len());
            } else {
                fan.group(triangles, face_normals, corners, cos_smooth);
            }
            fan.write(positions, triangles, face_normals, corners, is_missing, &mut found);
        }
        found
    });
    normals.reserve_exact(found.iter().map(|found| found.normals.len()).sum());
    let mut corners = incidence.corners.iter();
    for mut found in found {
        let before = normals.len() as u32;
        normals.append(&mut found.normals);
        for (index, corner) in found.indices.iter().zip(corners.by_ref()).filter(|(index, _)| **index != NONE) {
            triangle_normals[*corner as usize / 3][*corner as usize % 3] = before + index;
        }
    }
}

/// The rule of *Beethoven aus Bits und Bytes*: one normal a position, the sum of its triangles' unit normals, made a unit
/// again. Every triangle counts alike, and nothing is split at creases.
///
/// Where a position's normals cancel each other out, the article divides by 0; here the first of its triangles gives the normal.
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
struct Found {
    normals: Vec<Vec3>,
    /// For each corner in the incidence's order its normal here, or [`NONE`] where it has one already.
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

/// For every position the triangle corners that meet there, as `3 * triangle + corner`.
pub(super) struct Incidence {
    starts: Vec<u32>,
    corners: Vec<u32>,
}

impl Incidence {
    pub(super) fn new(position_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0u32; position_count + 1];
        for index in triangles.as_flattened() {
            starts[*index as usize + 1] += 1;
        }
        for vertex in 0..position_count {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut corners = vec![0u32; triangles.len() * 3];
        for (corner, index) in triangles.as_flattened().iter().enumerate() {
            let slot = &mut next[*index as usize];
            corners[*slot as usize] = corner as u32;
            *slot += 1;
        }
        Self { starts, corners }
    }

    /// The corners at some vertices, one after the other.
    fn corners_of(&self, vertices: &Range<usize>) -> &[u32] {
        &self.corners[self.starts[vertices.start] as usize..self.starts[vertices.end] as usize]
    }

    pub(super) fn corners(&self, vertex: usize) -> &[u32] {
        &self.corners[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// The faces around one vertex; kept between vertices for its memory.
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
    /// All faces are one group.
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

    fn root(&mut self, mut face: u32) -> u32 {
        while self.parents[face as usize] != face {
            // Halves the way for the next who asks, so that long chains stay cheap.
            self.parents[face as usize] = self.parents[self.parents[face as usize] as usize];
            face = self.parents[face as usize];
        }
        face
    }

    fn write(
        &mut self,
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        face_normals: &[DVec3],
        corners: &[u32],
        is_missing: impl Fn(u32) -> bool,
        found: &mut Found,
    ) {
        self.sums.clear();
        self.sums.resize(corners.len(), DVec3::ZERO);
        self.indices.clear();
        self.indices.resize(corners.len(), NONE);
        for (face, &corner) in corners.iter().enumerate() {
            let root = self.root(face as u32) as usize;
            self.sums[root] += weighted_normal(positions, triangles, corner);
        }
        for (face, &corner) in corners.iter().enumerate() {
            if !is_missing(corner) {
                found.indices.push(NONE);
                continue;
            }
            let root = self.root(face as u32) as usize;
            // Faces that cancel each other out leave no direction: then the face's own normal is the best there is.
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
mod tests {
    use super::*;
    use crate::mesh::triangle_normal;

    fn computed(positions: &[DVec3], triangles: &[[u32; 3]], angle: f64) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (mut normals, mut indices) = (Vec::new(), vec![[NONE; 3]; triangles.len()]);
        let corners = |triangle: &[u32; 3]| triangle.map(|index| positions[index as usize]);
        let face_normals: Vec<DVec3> = triangles.iter().map(|t| triangle_normal(corners(t)).unwrap()).collect();
        fill_missing(positions, triangles, &face_normals, angle.to_radians().cos(), &mut normals, &mut indices);
        (normals, indices)
    }

    fn cube() -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let positions = (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
        (positions, triangles)
    }

    #[test]
    fn a_cube_gets_flat_faces_below_its_right_angle() {
        let (positions, triangles) = cube();
        let (normals, indices) = computed(&positions, &triangles, 60.0);
        for (triangle, corners) in triangles.iter().zip(&indices) {
            let [a, b, c] = triangle.map(|i| positions[i as usize]);
            let face = (b - a).cross(c - a).normalize().as_vec3();
            for corner in corners {
                assert!(normals[*corner as usize].distance(face) < 1e-6);
            }
        }
        assert_eq!(normals.len(), 24, "three faces at each of eight corners");
    }

    #[test]
    fn a_cube_gets_its_diagonals_above_its_right_angle_whatever_way_its_squares_are_cut() {
        let (positions, triangles) = cube();
        let (normals, indices) = computed(&positions, &triangles, 91.0);
        assert_eq!(normals.len(), 8);
        for (vertex, normal) in triangles.as_flattened().iter().zip(indices.as_flattened()) {
            let diagonal = (positions[*vertex as usize] - DVec3::splat(0.5)).normalize().as_vec3();
            assert!(normals[*normal as usize].distance(diagonal) < 1e-6);
        }
    }

    #[test]
    fn a_sheet_drawn_from_both_sides_keeps_both_normals() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let (normals, indices) = computed(&positions, &[[0, 1, 2], [0, 2, 1]], 180.0);
        assert_eq!(normals[indices[0][0] as usize], Vec3::Z);
        assert_eq!(normals[indices[1][0] as usize], Vec3::NEG_Z);
    }

    /// The article's normals.
    fn of_the_article(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
        let corners = |triangle: &[u32; 3]| triangle.map(|index| positions[index as usize]);
        let face_normals: Vec<DVec3> = triangles.iter().map(|t| triangle_normal(corners(t)).unwrap()).collect();
        one_a_position(positions.len(), triangles, &face_normals)
    }

    #[test]
    fn by_the_article_a_cubes_corner_leans_to_the_squares_whose_diagonal_ends_there() {
        let (positions, triangles) = cube();
        let normals = of_the_article(&positions, &triangles);
        assert_eq!(normals.len(), 8, "one normal a corner");
        // Outward along x, y and z; a square with a diagonal at the corner has two triangles there.
        let expected = |corner: usize, counts: [f64; 3]| {
            let outward = (positions[corner] - DVec3::splat(0.5)).signum();
            (outward * DVec3::from_array(counts)).normalize().as_vec3()
        };
        // The cube's squares are cut from 0 and from 7 three times each, and once to each of the others.
        let corners = [
            (0, [2.0, 2.0, 2.0]),
            (7, [2.0, 2.0, 2.0]),
            (3, [1.0, 1.0, 2.0]),
            (4, [1.0, 1.0, 2.0]),
            (5, [1.0, 2.0, 1.0]),
            (2, [1.0, 2.0, 1.0]),
            (6, [2.0, 1.0, 1.0]),
            (1, [2.0, 1.0, 1.0]),
        ];
        for (corner, counts) in corners {
            assert!(normals[corner].distance(expected(corner, counts)) < 1e-6, "{corner}: {}", normals[corner]);
        }
        assert!(normals[7].distance(Vec3::splat(3f32.sqrt().recip())) < 1e-6, "the diagonal");
        assert!(normals[3].distance(Vec3::new(1.0, 1.0, -2.0) / 6f32.sqrt()) < 1e-6, "not the diagonal");
    }

    #[test]
    fn by_the_article_a_cones_apex_points_along_its_axis_and_its_rim_along_its_slope() {
        let (sides, height) = (12u32, 2.0);
        let rim = |side: u32| {
            let turn = f64::from(side) / f64::from(sides) * std::f64::consts::TAU;
            DVec3::new(turn.cos(), 0.0, turn.sin())
        };
        let positions: Vec<DVec3> = std::iter::once(DVec3::Y * height).chain((0..sides).map(rim)).collect();
        let triangles: Vec<[u32; 3]> = (0..sides).map(|side| [0, 1 + (side + 1) % sides, 1 + side]).collect();
        let normals = of_the_article(&positions, &triangles);
        assert!(normals[0].distance(Vec3::Y) < 1e-6);
        // Each side's normal is (height, inradius) across and up; two of them, half a side to the left and right, add up.
        let half = std::f64::consts::PI / f64::from(sides);
        let (across, up) = (height * half.cos(), half.cos());
        let expected = DVec3::new(across, up, 0.0).normalize().as_vec3();
        assert!(normals[1].distance(expected) < 1e-6, "{} instead of {expected}", normals[1]);
    }

    #[test]
    fn the_article_counts_triangles_where_the_default_weighs_them() {
        // A square on the floor, cut at the origin, and one triangle of a wall.
        let positions = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y, DVec3::Z];
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4]];
        let counted = of_the_article(&positions, &triangles)[0];
        assert!(counted.distance(Vec3::new(1.0, 0.0, 2.0) / 5f32.sqrt()) < 1e-6, "{counted}");
        let (weighed, indices) = computed(&positions, &triangles, 180.0);
        let weighed = weighed[indices[0][0] as usize];
        assert!(weighed.distance(Vec3::new(1.0, 0.0, 1.0) / 2f32.sqrt()) < 1e-6, "{weighed}");
    }

    #[test]
    fn where_the_articles_sum_is_nothing_the_first_triangle_counts() {
        let sheet = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(of_the_article(&sheet, &[[0, 1, 2], [0, 2, 1]]), [Vec3::Z; 3]);
        assert_eq!(of_the_article(&sheet, &[[0, 2, 1], [0, 1, 2]]), [Vec3::NEG_Z; 3]);
        // Three wings around the z axis, turned alike: their sum is 0 but for rounding.
        let wing = |turn: f64| DVec3::new(turn.to_radians().cos(), turn.to_radians().sin(), 0.0);
        let positions = [DVec3::ZERO, DVec3::Z, wing(0.0), wing(120.0), wing(240.0)];
        let normals = of_the_article(&positions, &[[0, 2, 1], [0, 3, 1], [0, 4, 1]]);
        assert_eq!(normals[..3], [Vec3::NEG_Y; 3], "the axis has the first wing's normal");
    }

    #[test]
    fn a_fan_of_a_hundred_thousand_triangles_is_done_in_the_time_of_a_sort() {
        let count = 100_000;
        let rim = |i: u32| {
            let turn = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            DVec3::new(turn.cos(), 0.0, turn.sin())
        };
        let positions: Vec<DVec3> = std::iter::once(DVec3::Y * 2.0).chain((0..count).map(rim)).collect();
        let triangles: Vec<[u32; 3]> = (0..count).map(|i| [0, 1 + (i + 1) % count, 1 + i]).collect();
        let backwards: Vec<[u32; 3]> = triangles.iter().rev().copied().collect();
        for triangles in [triangles, backwards] {
            // Neighbours differ by little here, but the whole fan by more than the angle, so edges are looked at.
            let (normals, indices) = computed(&positions, &triangles, 100.0);
            let tip = indices.iter().zip(&triangles).map(|(normals, corners)| (corners[0], normals[0]));
            assert!(tip.clone().all(|(corner, normal)| corner == 0 && normal == indices[0][0]), "one group at the tip");
            assert!(normals[indices[0][0] as usize].distance(Vec3::Y) < 1e-3);
        }
    }
}
