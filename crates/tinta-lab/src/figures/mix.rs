//! Scenes of a given number of triangles, for figure 13: built-in models added one by one, as the article's scenes grew, and
//! an open box cut into as many triangles as then are missing.

use glam::DVec3;
use serde::Serialize;
use std::sync::Arc;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, Mesh, load};

/// Triangles of the six scenes. The article prints the first and the last; each of the four between them has as many times
/// more than the one before it.
pub const TRIANGLES: [usize; 6] = [3_039, 6_367, 13_338, 27_944, 58_542, 122_646];

/// The models to add, in this order, repeated.
const CYCLE: [&str; 3] = ["gear", "ant", "bust"];

/// Gap between neighbours with a largest extent of 1.
const GAP: f64 = 0.15;

/// The contents of a scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mix {
    /// Triangles aimed at.
    pub wanted: usize,
    /// Triangles there are.
    pub triangles: usize,
    /// How many gears, ants and busts.
    pub gears: usize,
    /// See `gears`.
    pub ants: usize,
    /// See `gears`.
    pub busts: usize,
    /// Into how many pieces each side of the box's triangles is cut; 0 without a box.
    pub box_cuts: usize,
}

/// The models that mixes are made of, each on the ground, as large as the others.
pub(super) struct Kit {
    models: [Mesh; 3],
    open_box: Mesh,
}

impl Kit {
    /// Reads them.
    ///
    /// # Errors
    ///
    /// Like [`load()`], which does not fail for built-in models.
    pub(super) fn new() -> Result<Self> {
        let model = |name: &str| -> Result<Mesh> {
            Ok(of_one_size(load(&format!("builtin:{name}"), &LoadOptions::default())?.mesh))
        };
        let [gear, ant, bust] = CYCLE.map(model);
        Ok(Self { models: [gear?, ant?, bust?], open_box: model("open-box")? })
    }

    /// Chooses models for about `wanted` triangles.
    pub(super) fn mix(&self, wanted: usize) -> Mix {
        let counts = [0, 1, 2].map(|kind| self.models[kind].triangles.len());
        let mut numbers = [0; 3];
        let mut left = wanted;
        while counts.iter().any(|count| *count <= left) {
            for (number, count) in numbers.iter_mut().zip(counts) {
                if count <= left {
                    *number += 1;
                    left -= count;
                }
            }
        }
        let in_box = self.open_box.triangles.len();
        let box_cuts = (left as f64 / in_box as f64).sqrt().round() as usize;
        let triangles = wanted - left + in_box * box_cuts * box_cuts;
        let [gears, ants, busts] = numbers;
        Mix { wanted, triangles, gears, ants, busts, box_cuts }
    }

    /// The models of a mix, side by side in rows that go back.
    pub(super) fn meshes(&self, mix: &Mix) -> Vec<Arc<Mesh>> {
        let mut numbers = [mix.gears, mix.ants, mix.busts];
        let mut chosen: Vec<Mesh> = Vec::new();
        while numbers != [0; 3] {
            for (number, model) in numbers.iter_mut().zip(&self.models) {
                if *number > 0 {
                    *number -= 1;
                    chosen.push(model.clone());
                }
            }
        }
        if mix.box_cuts > 0 {
            chosen.push(cut(&self.open_box, mix.box_cuts));
        }
        let columns = (chosen.len() as f64).sqrt().ceil() as usize;
        let place = |(index, mut mesh): (usize, Mesh)| {
            let step = 1.0 + GAP;
            let offset = DVec3::new((index % columns) as f64 * step, 0.0, -((index / columns) as f64) * step);
            mesh.positions.iter_mut().for_each(|position| *position += offset);
            Arc::new(mesh)
        };
        chosen.into_iter().enumerate().map(place).collect()
    }
}

/// The mesh with a largest extent of 1, standing on y = 0 around the y axis.
fn of_one_size(mut mesh: Mesh) -> Mesh {
    let (low, high) = mesh.bounds();
    let foot = DVec3::new((low.x + high.x) * 0.5, low.y, (low.z + high.z) * 0.5);
    let scale = (high - low).max_element().recip();
    mesh.positions.iter_mut().for_each(|position| *position = (*position - foot) * scale);
    mesh
}

/// Every triangle cut into `pieces` times `pieces` like itself; flat faces stay flat.
fn cut(mesh: &Mesh, pieces: usize) -> Mesh {
    let (mut positions, mut triangles, mut triangle_normals) = (Vec::new(), Vec::new(), Vec::new());
    for (corners, normals) in mesh.triangles.iter().zip(&mesh.triangle_normals) {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
        let first = positions.len();
        // Rows from `a` towards the side from `b` to `c`: row r has r + 1 points.
        let at = |row: usize, column: usize| (first + row * (row + 1) / 2 + column) as u32;
        for row in 0..=pieces {
            for column in 0..=row {
                let [down, along] = [row, column].map(|steps| steps as f64 / pieces as f64);
                positions.push(a + (b - a) * (down - along) + (c - a) * along);
            }
        }
        for row in 0..pieces {
            for column in 0..=row {
                triangles.push([at(row, column), at(row + 1, column), at(row + 1, column + 1)]);
                if column < row {
                    triangles.push([at(row, column), at(row + 1, column + 1), at(row, column + 1)]);
                }
            }
        }
        triangle_normals.extend(std::iter::repeat_n(*normals, pieces * pieces));
    }
    Mesh {
        name: mesh.name.clone(),
        file_vertices: (0..positions.len() as u32).collect(),
        positions,
        triangles,
        normals: mesh.normals.clone(),
        triangle_normals,
        weld: mesh.weld,
        defects: mesh.defects.clone(),
        ..Mesh::triangle()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_within_two_per_cent_the_triangles_it_should_have() {
        let kit = Kit::new().unwrap();
        for wanted in TRIANGLES {
            let mix = kit.mix(wanted);
            let there: usize = kit.meshes(&mix).iter().map(|mesh| mesh.triangles.len()).sum();
            assert_eq!(there, mix.triangles);
            assert!(there.abs_diff(wanted) * 50 <= wanted, "{mix:?}");
        }
    }

    #[test]
    fn the_scenes_between_the_printed_ones_grow_evenly() {
        let growth = (122_646f64 / 3_039.0).powf(0.2);
        for pair in TRIANGLES.windows(2) {
            assert!((pair[1] as f64 / pair[0] as f64 / growth - 1.0).abs() < 1e-3, "{pair:?}");
        }
    }

    #[test]
    fn a_cut_box_has_its_area_and_its_normals() {
        let mesh = load("builtin:open-box", &LoadOptions::default()).unwrap().mesh;
        let area = |mesh: &Mesh| -> f64 {
            let corners = mesh.triangles.iter().map(|triangle| triangle.map(|corner| mesh.positions[corner as usize]));
            corners.map(|[a, b, c]| (b - a).cross(c - a).length() * 0.5).sum()
        };
        let pieces = cut(&mesh, 7);
        assert_eq!(pieces.triangles.len(), 490);
        assert!((area(&pieces) / area(&mesh) - 1.0).abs() < 1e-12);
        for (triangle, normals) in pieces.triangles.iter().zip(&pieces.triangle_normals) {
            let [a, b, c] = triangle.map(|corner| pieces.positions[corner as usize]);
            let normal = (b - a).cross(c - a).normalize().as_vec3();
            assert!(normals.iter().all(|corner| pieces.normals[*corner as usize].dot(normal) > 0.999));
        }
    }
}
