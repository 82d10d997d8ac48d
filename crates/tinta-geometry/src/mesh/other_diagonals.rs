//! Four triangles over four corners in a plane, two on the backs of the other two: a quadrilateral written for both sides, along either
//! diagonal.
//!
//! In: triangles and the rings that three of such four form at the lowest corner. Out: the same, both sides along one diagonal, so that
//! each triangle has one with its corners on its back.

use super::coincident::{coincident, sorted};
use super::pieces::Pieces;
use crate::tolerances::NEEDLE;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// Drops polygons that repeat others, after such quadrilaterals are cut on both sides alike.
pub(super) fn drop_duplicates(pieces: &mut Pieces, positions: &[DVec3]) {
    let mut found = coincident(&pieces.triangles, positions.len());
    if align(pieces, positions, &found.rings) {
        found = coincident(&pieces.triangles, positions.len());
    }
    pieces.drop_duplicates(positions, found);
}

/// Cuts one side of each such quadrilateral as the other is, unless the triangles of that side differ in their attributes where
/// they meet. Returns whether there were any.
fn align(pieces: &mut Pieces, positions: &[DVec3], rings: &[[u32; 3]]) -> bool {
    let is_folded = |ring: &&[u32; 3]| {
        let [first, second, third] = ring.map(|face| pieces.face_normals[face as usize]);
        first.dot(third) < 0.0 && second.dot(third) < 0.0
    };
    let rings: Vec<[u32; 3]> = rings.iter().filter(is_folded).copied().collect();
    if rings.is_empty() {
        return false;
    }
    let of_corners: HashMap<([u32; 3], bool), u32> = pieces.triangles.iter().map(|it| sorted(*it)).zip(0..).collect();
    let mut aligned: HashSet<u32> = HashSet::new();
    for ring @ [first, second, third] in rings {
        // The lowest corner, then those of the ring; the third triangle and the fourth meet between x and z.
        let [[a, x, _], [_, y, z]] = [first, second].map(|face| from_lowest(pieces.triangles[face as usize]));
        let Some(&fourth) = of_corners.get(&sorted([x, z, y])) else { continue };
        let normal = pieces.face_normals[third as usize];
        let [to_x, to_y, to_z] = [x, y, z].map(|corner| positions[corner as usize] - positions[a as usize]);
        let is_flat = to_y.dot(normal).abs() <= NEEDLE * to_x.length().max(to_y.length()).max(to_z.length());
        let is_back = pieces.face_normals[fourth as usize].dot(normal) > 0.0;
        let faces = [ring[0], ring[1], third, fourth];
        let is_apart = !faces.iter().any(|face| aligned.contains(face));
        if is_flat && is_back && is_apart && pieces.turn_diagonal([third, fourth], [a, x, y, z]) {
            pieces.face_normals[third as usize] = -pieces.face_normals[second as usize];
            pieces.face_normals[fourth as usize] = -pieces.face_normals[first as usize];
            aligned.extend(faces);
        }
    }
    !aligned.is_empty()
}

/// A triangle's corners in its direction from the lowest on.
fn from_lowest(triangle: [u32; 3]) -> [u32; 3] {
    let ([a, b, c], is_turned_over) = sorted(triangle);
    if is_turned_over { [a, c, b] } else { [a, b, c] }
}

impl Pieces {
    /// Turns the triangles a, z, x and x, z, y into a, z, y and a, y, x, if they agree at x and z.
    fn turn_diagonal(&mut self, [third, fourth]: [u32; 2], [a, x, y, z]: [u32; 4]) -> bool {
        let [third, fourth] = [third as usize, fourth as usize];
        let of = [self.triangles[third], self.triangles[fourth]];
        let place = |side: usize, corner: u32| of[side].iter().position(|it| *it == corner).unwrap_or_default();
        let [at_a, at_x, at_z] = [a, x, z].map(|corner| place(0, corner));
        let [too_x, too_y, too_z] = [x, y, z].map(|corner| place(1, corner));
        let lists = [&self.normals, &self.texture_coordinates];
        let are_alike = lists
            .into_iter()
            .filter(|list| !list.is_empty())
            .all(|list| list[third][at_x] == list[fourth][too_x] && list[third][at_z] == list[fourth][too_z]);
        let is_one = |list: &[u32]| list.get(third) == list.get(fourth);
        if !are_alike || !is_one(&self.materials) || !is_one(&self.parts) {
            return false;
        }
        for list in [&mut self.triangles, &mut self.normals, &mut self.texture_coordinates] {
            if let [Some(own), Some(other)] = [list.get(third), list.get(fourth)].map(|it| it.copied()) {
                list[third] = [own[at_a], own[at_z], other[too_y]];
                list[fourth] = [own[at_a], other[too_y], own[at_x]];
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::super::soup::{Corner, Soup};
    use crate::mesh::{LoadOptions, Mesh};
    use glam::{DQuat, DVec3, Vec2, Vec3};
    use proptest::prelude::*;

    const FRONT: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
    const BACK: [[u32; 3]; 2] = [[0, 3, 1], [1, 3, 2]];

    fn mesh(corners: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
        Mesh::of_triangles("leaf", corners.to_vec(), triangles, &LoadOptions::default()).unwrap()
    }

    fn doubled(third: [f64; 3]) -> usize {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::from_array(third), DVec3::Y];
        mesh(&corners, &[FRONT, BACK].concat()).defects.doubled_triangles
    }

    #[test]
    fn four_corners_written_for_both_sides_along_either_diagonal_are_doubled_where_they_lie_in_a_plane() {
        assert_eq!(doubled([1.0, 1.0, 0.0]), 2);
        assert_eq!(doubled([0.6, 3.0, 0.0]), 2);
        assert_eq!(doubled([1.0, 1.0, 1e-3]), 0, "a bent one is a thin solid");
        assert_eq!(doubled([0.3, 0.3, 0.0]), 0, "a concave one has one diagonal");
        let corners = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        let solid = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        assert_eq!(mesh(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], &solid).defects.doubled_triangles, 0);
        assert_eq!(mesh(&corners, &[FRONT, [[0, 1, 3], [1, 2, 3]]].concat()).defects.doubled_triangles, 0, "one side");
    }

    #[test]
    fn corners_keep_their_texture_and_a_seam_its_diagonal() {
        let leaf = |second_of_1: u32| {
            let texel = |corner: u32, of: usize| if of == 3 && corner == 1 { second_of_1 } else { corner };
            let faces = [FRONT, BACK].concat();
            let corners = faces
                .iter()
                .enumerate()
                .flat_map(|(of, face)| face.map(|corner| Corner { texture: texel(corner, of), ..Corner::at(corner) }));
            let positions = vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
            let texture_coordinates =
                [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]].map(Vec2::from).to_vec();
            let soup = Soup { corners: corners.collect(), positions, texture_coordinates, ..Soup::default() };
            soup.into_mesh("leaf", &LoadOptions::default()).unwrap()
        };
        let same = leaf(1);
        assert_eq!(same.triangles[2..], [[0, 3, 2], [0, 2, 1]]);
        assert_eq!(same.triangle_texture_coordinates, same.triangles);
        assert_eq!((leaf(4).triangles, leaf(4).defects.doubled_triangles), ([FRONT, BACK].concat(), 0));
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

        #[test]
        fn a_folded_strip_is_the_same_along_any_diagonals_of_its_sides(
            heights in prop::collection::vec(-1.0f64..1.0, 8), diagonals: u32, order: u32, turn in prop::array::uniform3(-3.0f64..3.0)
        ) {
            let turn = DQuat::from_scaled_axis(DVec3::from_array(turn));
            let rows = (0..).zip(&heights);
            let corners: Vec<DVec3> =
                rows.flat_map(|(x, y)| [0.0, 1.0].map(|z| turn * DVec3::new(f64::from(x), *y, z))).collect();
            let cut = |[a, b, c, d]: [u32; 4], along_ac: bool| if along_ac { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            let strip = |as_told: bool| {
                let sides = (0..7u32).flat_map(|row| {
                    let [a, b, c, d] = [0, 1, 3, 2].map(|corner| row * 2 + corner);
                    let [front, back] = [0, 1].map(|side| diagonals >> (row * 2 + side) & 1 == 0);
                    // Where they differ, both have the one through the lowest corner.
                    let [front, back] = if as_told || front == back { [front, back] } else { [true; 2] };
                    let mut sides = [cut([a, b, c, d], front), cut([d, c, b, a], !back)];
                    if order >> row & 1 == 1 {
                        sides.reverse();
                    }
                    sides.concat()
                });
                mesh(&corners, &sides.collect::<Vec<_>>())
            };
            let all = |mesh: &Mesh| {
                let normal = |of: &u32| mesh.normals[*of as usize];
                let of_face = |(corners, normals): (&[u32; 3], &[u32; 3])| {
                    let lowest = (0..3).min_by_key(|at| corners[*at]).unwrap_or_default();
                    let (mut corners, mut normals) = (*corners, normals.each_ref().map(normal));
                    corners.rotate_left(lowest);
                    normals.rotate_left(lowest);
                    (corners, normals)
                };
                let mut all: Vec<([u32; 3], [Vec3; 3])> = mesh.triangles.iter().zip(&mesh.triangle_normals).map(of_face).collect();
                all.sort_by_key(|face| face.0);
                all
            };
            let (told, aligned) = (strip(true), strip(false));
            prop_assert_eq!(told.defects.doubled_triangles, 14);
            for ((corners, normals), (other_corners, others)) in all(&told).into_iter().zip(all(&aligned)) {
                prop_assert_eq!(corners, other_corners);
                prop_assert!(normals.iter().zip(others).all(|(one, other)| one.distance(other) < 1e-5), "{normals:?} {others:?}");
            }
        }
    }
}
