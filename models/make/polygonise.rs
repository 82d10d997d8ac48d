//! From a signed distance field to a fine closed triangle mesh.
//!
//! In: a field (negative inside) and a box. Out: the zero surface by marching
//! tetrahedra, which is a closed manifold whatever the field does, with every
//! vertex pulled onto the surface along the field's gradient.

use crate::mesh::Mesh;
use crate::vector::{Vec3, v};
use std::collections::BTreeMap;

/// The grid: a box and the edge of its cells, in the field's unit of length.
#[derive(Clone, Copy)]
pub struct Grid {
    pub low: Vec3,
    pub high: Vec3,
    pub step: f64,
}

/// Cells along the edge of one block; a block far from the surface is skipped.
const BLOCK: usize = 8;

/// The corners of a cube walked from 0 to 7 along the three axes, one path per
/// order of the axes: six tetrahedra that fill the cube and meet their
/// neighbours' faces (Kuhn's subdivision).
const PATHS: [[usize; 4]; 6] = [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]];

/// Polygonises the zero surface of `field`, which must be positive on the
/// faces of the box and change by at most about 1.6 per unit of length.
pub fn polygonise(field: &dyn Fn(Vec3) -> f64, grid: Grid) -> Mesh {
    let extent = grid.high - grid.low;
    let blocks = [extent.x, extent.y, extent.z].map(|e| (e / (grid.step * BLOCK as f64)).ceil() as usize);
    let mut surface = Surface { field, grid, mesh: Mesh::default(), crossings: BTreeMap::new() };
    let block_size = grid.step * BLOCK as f64;
    let reach = block_size * 0.5 * 3f64.sqrt() * 1.7;
    for bz in 0..blocks[2] {
        for by in 0..blocks[1] {
            for bx in 0..blocks[0] {
                let centre = grid.low + v(bx as f64 + 0.5, by as f64 + 0.5, bz as f64 + 0.5) * block_size;
                if field(centre).abs() < reach {
                    surface.block([bx * BLOCK, by * BLOCK, bz * BLOCK]);
                }
            }
        }
    }
    let mut mesh = surface.mesh;
    for position in &mut mesh.positions {
        *position = pulled_onto(field, *position, grid.step);
    }
    mesh
}

/// The field's gradient by central differences over `2 * reach`.
pub fn gradient(field: &dyn Fn(Vec3) -> f64, p: Vec3, reach: f64) -> Vec3 {
    let slope = |d: Vec3| (field(p + d) - field(p - d)) / (2.0 * reach);
    v(slope(v(reach, 0.0, 0.0)), slope(v(0.0, reach, 0.0)), slope(v(0.0, 0.0, reach)))
}

fn pulled_onto(field: &dyn Fn(Vec3) -> f64, start: Vec3, step: f64) -> Vec3 {
    let mut p = start;
    for _ in 0..2 {
        let slope = gradient(field, p, 0.1 * step);
        let square = slope.dot(slope);
        if square < 0.05 {
            break;
        }
        // Half a cell at most in all: a longer pull would fold the surface.
        let pulled = p - slope * (field(p) / square);
        let total = pulled - start;
        let limit = 0.35 * step;
        p = start + total * (limit / total.length().max(limit));
    }
    p
}

type GridPoint = [usize; 3];

struct Surface<'a> {
    field: &'a dyn Fn(Vec3) -> f64,
    grid: Grid,
    mesh: Mesh,
    crossings: BTreeMap<(GridPoint, GridPoint), usize>,
}

impl Surface<'_> {
    fn position(&self, point: GridPoint) -> Vec3 {
        self.grid.low + v(point[0] as f64, point[1] as f64, point[2] as f64) * self.grid.step
    }

    fn block(&mut self, first: GridPoint) {
        const SIDE: usize = BLOCK + 1;
        let mut values = vec![0.0; SIDE * SIDE * SIDE];
        for (index, value) in values.iter_mut().enumerate() {
            let at = [index % SIDE, index / SIDE % SIDE, index / (SIDE * SIDE)];
            *value = (self.field)(self.position([0, 1, 2].map(|k| first[k] + at[k])));
        }
        for cell in 0..BLOCK * BLOCK * BLOCK {
            let at = [cell % BLOCK, cell / BLOCK % BLOCK, cell / (BLOCK * BLOCK)];
            let offset = |corner: usize| [0, 1, 2].map(|k| at[k] + (corner >> k & 1));
            let corners: [(GridPoint, f64); 8] = std::array::from_fn(|corner| {
                let [x, y, z] = offset(corner);
                let point = [first[0] + x, first[1] + y, first[2] + z];
                (point, values[x + SIDE * (y + SIDE * z)])
            });
            let inside = corners.iter().filter(|(_, value)| *value < 0.0).count();
            if inside != 0 && inside != 8 {
                for path in PATHS {
                    self.tetrahedron(path.map(|corner| corners[corner]));
                }
            }
        }
    }

    fn tetrahedron(&mut self, corners: [(GridPoint, f64); 4]) {
        let inside: Vec<usize> = (0..4).filter(|&i| corners[i].1 < 0.0).collect();
        let outside: Vec<usize> = (0..4).filter(|&i| corners[i].1 >= 0.0).collect();
        let mut cross = |a: usize, b: usize| self.crossing(corners[a], corners[b]);
        let polygon = match (inside.as_slice(), outside.as_slice()) {
            (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => {
                vec![cross(a, b), cross(a, c), cross(a, d)]
            }
            (&[a, b], &[c, d]) => vec![cross(a, c), cross(a, d), cross(b, d), cross(b, c)],
            _ => return,
        };
        // Outward is from the mean of the inside corners to the outside ones.
        let mean = |side: &[usize]| {
            side.iter().fold(Vec3::ZERO, |sum, &i| sum + self.position(corners[i].0)) / side.len() as f64
        };
        let outward = mean(&outside) - mean(&inside);
        for i in 1..polygon.len() - 1 {
            let [a, b, c] = [polygon[0], polygon[i], polygon[i + 1]];
            let along = self.mesh.area_vector([a, b, c]).dot(outward);
            self.mesh.triangles.push(if along > 0.0 { [a, b, c] } else { [a, c, b] });
        }
    }

    fn crossing(&mut self, a: (GridPoint, f64), b: (GridPoint, f64)) -> usize {
        let (low, high) = if a.0 < b.0 { (a, b) } else { (b, a) };
        let key = (low.0, high.0);
        if let Some(&index) = self.crossings.get(&key) {
            return index;
        }
        // Kept off the grid points, or neighbouring crossings would coincide
        // there and leave slivers behind.
        let amount = (low.1 / (low.1 - high.1)).clamp(0.12, 0.88);
        let position = self.position(low.0).lerp(self.position(high.0), amount);
        let index = self.mesh.add(position);
        self.crossings.insert(key, index);
        index
    }
}
