//! Creases that last: chains of edges at which faces differ by more than the smoothing angle and that go on for a while. On scans
//! and on models of few triangles single edges are as sharp by chance, and to split normals there makes specks.
//!
//! In: welded triangles and the angle's cosine. Out: the vertices where normals may be split, and for each triangle the area of the flat
//! face it is part of. By it a face counts more than the chamfer beside it, which so bends from face to face and leaves them flat.

use super::Incidence;
use crate::threads::{in_parallel, threads_for};
use glam::DVec3;

/// How far a chain must reach to last, in shares of the diagonal of the model's box: farther than single edges of the scans and low
/// models looked at, less far than the edges of their shortest chamfers.
const LEAST_REACH: f64 = 0.04;

/// The least cosine between triangles of one flat face: half a degree, as exported planes keep.
const FLAT: f64 = 0.99996;

/// Where normals may be split, and how much faces weigh in.
pub(super) struct Lasting {
    /// For each vertex whether it lies on a crease that lasts.
    pub vertices: Vec<bool>,
    /// For each triangle the area of its flat face, in units of the model's own.
    pub areas: Vec<f64>,
}

impl Lasting {
    pub(super) fn find(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        face_normals: &[DVec3],
        incidence: &Incidence,
        cos_smooth: f64,
    ) -> Self {
        let found = in_parallel(positions.len(), threads_for(triangles.len()), |vertices| {
            let (mut sharp, mut flat, mut spokes) = (Vec::new(), Vec::new(), Vec::new());
            for vertex in vertices {
                spokes.clear();
                for &corner in incidence.corners(vertex) {
                    let triangle = triangles[corner as usize / 3];
                    let far = [1, 2].map(|step| triangle[(corner as usize % 3 + step) % 3]);
                    // Each edge once, by its lower end.
                    spokes.extend(far.into_iter().filter(|far| *far as usize > vertex).map(|far| (far, corner / 3)));
                }
                spokes.sort_unstable();
                for pair in spokes.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
                    let [(far, face), (_, other)] = [pair[0], pair[1]];
                    let cosine = face_normals[face as usize].dot(face_normals[other as usize]);
                    if cosine < cos_smooth {
                        sharp.push([vertex as u32, far]);
                    } else if cosine > FLAT {
                        flat.push([face, other]);
                    }
                }
            }
            [sharp, flat]
        });
        let mut chains = Sets::new(positions.len());
        let mut faces = Sets::new(triangles.len());
        for [sharp, flat] in &found {
            sharp.iter().for_each(|[a, b]| chains.join(*a, *b));
            flat.iter().for_each(|[a, b]| faces.join(*a, *b));
        }
        let sharp = || found.iter().flat_map(|[sharp, _]| sharp.as_flattened());
        let mut boxes = vec![Span::NONE; positions.len()];
        sharp().for_each(|end| boxes[chains.root(*end)].take(positions[*end as usize]));
        let mut whole = Span::NONE;
        positions.iter().for_each(|position| whole.take(*position));
        let mut vertices = vec![false; positions.len()];
        sharp().for_each(|end| {
            vertices[*end as usize] = boxes[chains.root(*end)].diagonal() >= LEAST_REACH * whole.diagonal();
        });
        let mut areas = vec![0.0; triangles.len()];
        for (number, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
            areas[faces.root(number as u32)] += (b - a).cross(c - a).length() * 0.5;
        }
        let areas = (0..triangles.len() as u32).map(|number| areas[faces.root(number)]).collect();
        Self { vertices, areas }
    }
}

/// Numbers joined into sets.
struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    fn root(&mut self, mut number: u32) -> usize {
        while self.parents[number as usize] != number {
            self.parents[number as usize] = self.parents[self.parents[number as usize] as usize];
            number = self.parents[number as usize];
        }
        number as usize
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b) as u32;
    }
}

/// A box around points.
#[derive(Clone, Copy)]
struct Span {
    low: DVec3,
    high: DVec3,
}

impl Span {
    const NONE: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn take(&mut self, point: DVec3) {
        (self.low, self.high) = (self.low.min(point), self.high.max(point));
    }

    fn diagonal(&self) -> f64 {
        (self.high - self.low).length()
    }
}
