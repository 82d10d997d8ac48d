//! A mesh's normals: those of the file where they are wanted and can be believed, computed ones elsewhere.
//!
//! In: triangles, their corners' normals in the file, and the faces' own. Out: a normal for each corner, and a count of those in the
//! file that are averaged over sharp edges. Of two triangles that show one surface from both sides, one has the other's normals,
//! turned round: each side is as smooth as if it were alone.

use super::coincident::{Coincident, coincident};
use super::normals::Splitting;
use super::sides::fronts_and_backs;
use super::{LoadOptions, Mesh, NONE, Normals, normals};
use crate::tolerances::{AVERAGED_NORMAL, AVERAGED_SHARE};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Least share of the smoothing angle at which an edge continues a crease that ends at it: chamfers of 30 degrees beside one of
/// 45.
const NEARLY: f64 = 2.0 / 3.0;

/// Least cosine between a face's own normal and the file's normal for it, which may have few digits or belong to a polygon that
/// is not flat: 5 degrees.
const OWN: f64 = 0.996;

impl Mesh {
    /// Takes the file's normals where wanted and usable, and computes the rest; remarks on those that are wanted and not believed.
    pub(super) fn take_normals(
        &mut self,
        file_normals: &[Vec3],
        face_normals: &[DVec3],
        options: &LoadOptions,
        remarks: &mut Vec<String>,
    ) {
        let angle = options.smooth_angle_degrees.to_radians();
        let all = Splitting { cos_smooth: angle.cos(), cos_beside: None, reach: options.normal_reach };
        let lasting = Splitting { cos_beside: Some((angle * NEARLY).cos()), ..all };
        let (mut file_normals, splitting): (&[Vec3], Splitting) = match options.normals {
            Normals::File | Normals::Checked => (file_normals, all),
            Normals::Smooth => (&[], all),
            Normals::Lasting => (file_normals, lasting),
            Normals::Flat => {
                self.normals = face_normals.iter().map(|normal| normal.as_vec3()).collect();
                self.triangle_normals = (0..self.triangles.len() as u32).map(|face| [face; 3]).collect();
                return;
            }
            Normals::Dachsbacher => {
                self.normals = normals::one_a_position(self.positions.len(), &self.triangles, face_normals);
                self.triangle_normals.clone_from(&self.triangles);
                return;
            }
        };
        let Leaning { given, own, averaged, areas: [of_given, of_averaged] } =
            self.leaning(file_normals, face_normals, options);
        // Of a part on a large plain many corners are a little area, and a flat cap of few corners is much.
        let is_averaged = averaged as f64 > AVERAGED_SHARE * given as f64 || of_averaged > AVERAGED_SHARE * of_given;
        if is_averaged && options.normals == Normals::File {
            self.defects.averaged_normals = averaged;
        } else if is_averaged {
            file_normals = &[];
            remarks.push(format!(
                "{}: {averaged} of the file's {given} normals stand more than 45 degrees off their faces, so tones use computed \
                 ones; --normals file takes the file's",
                self.name
            ));
        } else if options.normals == Normals::Lasting && own * 100 > given * 95 {
            // Such a file does not tell smooth from sharp.
            file_normals = &[];
        }
        self.take_from_file(file_normals, options);
        if options.normals == Normals::Lasting && !self.normals.is_empty() {
            self.turn_inward(face_normals);
        }
        self.compute_missing(face_normals, splitting, options.normals != Normals::File);
    }

    /// Takes the corners' normals from the file's, each once; [`NONE`] for those that are missing.
    fn take_from_file(&mut self, file_normals: &[Vec3], options: &LoadOptions) {
        let mut number = vec![NONE; file_normals.len()];
        for slot in self.triangle_normals.as_flattened_mut() {
            let Some(normal) = file_normals.get(*slot as usize).and_then(|normal| normal.try_normalize()) else {
                *slot = NONE;
                continue;
            };
            let file_index = std::mem::replace(slot, number[*slot as usize]) as usize;
            if *slot == NONE {
                *slot = self.normals.len() as u32;
                number[file_index] = *slot;
                self.normals.push(options.up_axis.to_y_up(normal.as_dvec3()).as_vec3());
            }
        }
    }

    /// Turns the normals of triangles round whose normals all point to their inner sides: files may run round faces the wrong way, and
    /// a style that lights the side that is seen goes by that.
    fn turn_inward(&mut self, face_normals: &[DVec3]) {
        let (normals, triangle_normals) = (&mut self.normals, &mut self.triangle_normals);
        let mut turned =
            TwoSidedNormals { triangles: &self.triangles, normals, triangle_normals, opposites: HashMap::new() };
        for (triangle, face) in face_normals.iter().enumerate() {
            if turned.points_inward(triangle, *face) {
                let corners = turned.triangle_normals[triangle];
                turned.triangle_normals[triangle] = corners.map(|normal| turned.opposite(normal));
            }
        }
    }

    /// Computes the missing normals.
    fn compute_missing(&mut self, face_normals: &[DVec3], splitting: Splitting, are_checked: bool) {
        let (normals, triangle_normals) = (&mut self.normals, &mut self.triangle_normals);
        if self.defects.doubled_triangles == 0 {
            normals::fill_missing(&self.positions, &self.triangles, face_normals, splitting, normals, triangle_normals);
            return;
        }
        let Coincident { opposite, .. } = coincident(&self.triangles, self.positions.len());
        let sides = fronts_and_backs(&self.triangles, &opposite);
        let mut turned =
            TwoSidedNormals { triangles: &self.triangles, normals, triangle_normals, opposites: HashMap::new() };
        if are_checked {
            // Both sides may share the front's normals.
            sides.as_flattened().iter().for_each(|triangle| turned.drop_inward(*triangle, face_normals));
        }
        for [front, back] in &sides {
            turned.complete(*front, *back);
            turned.complete(*back, *front);
        }
        let mut is_back = vec![false; self.triangles.len()];
        sides.iter().for_each(|[_, back]| is_back[*back as usize] = true);
        let fronts: Vec<usize> = (0..is_back.len()).filter(|triangle| !is_back[*triangle]).collect();
        let triangles: Vec<[u32; 3]> = fronts.iter().map(|triangle| self.triangles[*triangle]).collect();
        let of_faces: Vec<DVec3> = fronts.iter().map(|triangle| face_normals[*triangle]).collect();
        let mut of_fronts: Vec<[u32; 3]> = fronts.iter().map(|triangle| turned.triangle_normals[*triangle]).collect();
        normals::fill_missing(&self.positions, &triangles, &of_faces, splitting, turned.normals, &mut of_fronts);
        fronts.iter().zip(of_fronts).for_each(|(triangle, corners)| turned.triangle_normals[*triangle] = corners);
        sides.iter().for_each(|[front, back]| turned.complete(*back, *front));
    }

    /// Counts how far the file's normals lean from the faces.
    fn leaning(&self, file_normals: &[Vec3], face_normals: &[DVec3], options: &LoadOptions) -> Leaning {
        let mut leaning = Leaning::default();
        if file_normals.is_empty() {
            return leaning;
        }
        for (triangle, (corners, face)) in self.triangles.iter().zip(self.triangle_normals.iter().zip(face_normals)) {
            let normals = corners.iter().filter_map(|corner| file_normals.get(*corner as usize)?.try_normalize());
            let [a, b, c] = triangle.map(|position| self.positions[position as usize]);
            for normal in normals {
                let cosine = options.up_axis.to_y_up(normal.as_dvec3()).dot(*face);
                let (area, is_averaged) = ((b - a).cross(c - a).length(), cosine.abs() < AVERAGED_NORMAL);
                leaning.given += 1;
                leaning.own += usize::from(cosine > OWN);
                leaning.averaged += usize::from(is_averaged);
                leaning.areas[0] += area;
                leaning.areas[1] += if is_averaged { area } else { 0.0 };
            }
        }
        leaning
    }
}

/// The normals of triangles that show one surface from both sides.
struct TwoSidedNormals<'a> {
    triangles: &'a [[u32; 3]],
    normals: &'a mut Vec<Vec3>,
    triangle_normals: &'a mut [[u32; 3]],
    /// For each normal that was turned round its opposite.
    opposites: HashMap<u32, u32>,
}

impl TwoSidedNormals<'_> {
    /// Leaves out the normals of a triangle if all three point to its inner side.
    fn drop_inward(&mut self, triangle: u32, face_normals: &[DVec3]) {
        if self.points_inward(triangle as usize, face_normals[triangle as usize]) {
            self.triangle_normals[triangle as usize] = [NONE; 3];
        }
    }

    /// Whether all normals of a triangle point to its inner side.
    fn points_inward(&self, triangle: usize, face: DVec3) -> bool {
        self.triangle_normals[triangle]
            .iter()
            .all(|corner| self.normals.get(*corner as usize).is_some_and(|normal| normal.as_dvec3().dot(face) < 0.0))
    }

    /// The number of a normal's opposite.
    fn opposite(&mut self, normal: u32) -> u32 {
        *self.opposites.entry(normal).or_insert_with(|| {
            self.normals.push(-self.normals[normal as usize]);
            self.normals.len() as u32 - 1
        })
    }

    /// Gives a triangle's corners without a normal the opposite of the other side's.
    fn complete(&mut self, triangle: u32, other: u32) {
        let [triangle, other] = [triangle, other].map(|triangle| triangle as usize);
        for corner in 0..3 {
            let position = self.triangles[triangle][corner];
            let there = self.triangles[other].iter().position(|of_other| *of_other == position);
            let normal = there.map_or(NONE, |there| self.triangle_normals[other][there]);
            if self.triangle_normals[triangle][corner] != NONE || normal == NONE {
                continue;
            }
            self.triangle_normals[triangle][corner] = self.opposite(normal);
        }
    }
}

/// How far a file's normals lean from the faces at whose corners they are.
#[derive(Default)]
struct Leaning {
    /// Corners with a normal.
    given: usize,
    /// Those where it is the face's own.
    own: usize,
    /// Those where it stands far off the face, from either of its sides: the file may run round its faces the wrong way.
    averaged: usize,
    /// The sums of the areas of the faces at all of these corners and at the last.
    areas: [f64; 2],
}

#[cfg(test)]
mod tests;
