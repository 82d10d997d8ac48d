//! Triangle meshes: closed parts made of positions and index triples.
//!
//! In: what the sculpting and construction modules produce. Out: tidied
//! parts, their corner normals and the checks every shipped part must pass.

use crate::vector::Vec3;
use std::collections::BTreeMap;

/// Counter-clockwise triangles, seen from outside, over shared positions.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[usize; 3]>,
}

impl Mesh {
    pub fn add(&mut self, position: Vec3) -> usize {
        self.positions.push(position);
        self.positions.len() - 1
    }

    /// A flat quadrangle as two triangles, cut along a-c.
    pub fn quad(&mut self, [a, b, c, d]: [usize; 4]) {
        self.triangles.push([a, b, c]);
        self.triangles.push([a, c, d]);
    }

    pub fn append(&mut self, other: &Mesh) {
        let first = self.positions.len();
        self.positions.extend_from_slice(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
    }

    /// Twice the area times the outward unit normal.
    pub fn area_vector(&self, triangle: [usize; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|i| self.positions[i]);
        (b - a).cross(c - a)
    }

    /// Six times the enclosed volume; positive when the faces look outward.
    pub fn signed_volume(&self) -> f64 {
        self.triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = t.map(|i| self.positions[i]);
                a.dot(b.cross(c))
            })
            .sum()
    }

    /// Drops positions no triangle uses, keeping the order of the others.
    pub fn compact(&mut self) {
        let mut renamed = vec![usize::MAX; self.positions.len()];
        for &index in self.triangles.iter().flatten() {
            renamed[index] = 0;
        }
        let mut kept = Vec::new();
        for (index, slot) in renamed.iter_mut().enumerate() {
            if *slot == 0 {
                *slot = kept.len();
                kept.push(self.positions[index]);
            }
        }
        self.positions = kept;
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|i| renamed[i]);
        }
    }

    /// The connected pieces, in the order of their first triangle.
    pub fn pieces(&self) -> Vec<Mesh> {
        let mut parent: Vec<usize> = (0..self.positions.len()).collect();
        fn root(parent: &mut [usize], mut i: usize) -> usize {
            while parent[i] != i {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            i
        }
        for &[a, b, c] in &self.triangles {
            let (ra, rb) = (root(&mut parent, a), root(&mut parent, b));
            parent[rb] = ra;
            let rc = root(&mut parent, c);
            parent[rc] = ra;
        }
        let mut order = BTreeMap::new();
        let mut pieces: Vec<Mesh> = Vec::new();
        for &triangle in &self.triangles {
            let piece = *order.entry(root(&mut parent, triangle[0])).or_insert_with(|| {
                pieces.push(Mesh::default());
                pieces.len() - 1
            });
            pieces[piece].triangles.push(triangle);
        }
        for piece in &mut pieces {
            piece.positions.clone_from(&self.positions);
            piece.compact();
        }
        pieces
    }

    /// Keeps the pieces that enclose more than `least` (length cubed): floating
    /// crumbs and inner cavities of a sculpted field are never visible.
    pub fn keep_large_pieces(&self, least: f64) -> Mesh {
        let mut kept = Mesh::default();
        for piece in self.pieces() {
            if piece.signed_volume() / 6.0 > least {
                kept.append(&piece);
            }
        }
        kept
    }

    /// One unit normal per triangle corner, angle-weighted over the triangles
    /// round the vertex that turn away from this one by less than the crease
    /// angle, given as its cosine.
    pub fn corner_normals(&self, crease_cosine: f64) -> Vec<[Vec3; 3]> {
        let units: Vec<Vec3> = self.triangles.iter().map(|&t| self.area_vector(t).normalized()).collect();
        let mut around = vec![Vec::new(); self.positions.len()];
        for (face, triangle) in self.triangles.iter().enumerate() {
            for corner in 0..3 {
                around[triangle[corner]].push((face, self.corner_weight(*triangle, corner)));
            }
        }
        self.triangles
            .iter()
            .enumerate()
            .map(|(face, triangle)| {
                triangle.map(|vertex| {
                    around[vertex]
                        .iter()
                        .filter(|&&(other, _)| units[other].dot(units[face]) >= crease_cosine)
                        .fold(Vec3::ZERO, |sum, &(other, w)| sum + units[other] * w)
                        .normalized()
                })
            })
            .collect()
    }

    /// A stand-in for the corner's angle that needs no arc cosine: 1 - cos.
    fn corner_weight(&self, triangle: [usize; 3], corner: usize) -> f64 {
        let here = self.positions[triangle[corner]];
        let next = (self.positions[triangle[(corner + 1) % 3]] - here).normalized();
        let last = (self.positions[triangle[(corner + 2) % 3]] - here).normalized();
        1.0 - next.dot(last)
    }

    /// Says what is wrong with a part that must be closed, or nothing.
    pub fn closed_fault(&self) -> Option<String> {
        let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let count = edges.entry((from, to)).or_insert(0);
                *count += 1;
                if *count > 1 {
                    return Some(format!("edge {from}-{to} is used twice in one direction"));
                }
            }
        }
        if let Some((from, to)) = edges.keys().find(|(a, b)| !edges.contains_key(&(*b, *a))) {
            return Some(format!("edge {from}-{to} is open"));
        }
        let smallest = self.triangles.iter().map(|&t| self.area_vector(t).length()).fold(f64::INFINITY, f64::min);
        if smallest < 1e-7 {
            return Some(format!("a triangle has twice the area {smallest:e} only"));
        }
        if self.pieces().iter().any(|piece| piece.signed_volume() <= 0.0) {
            return Some("a piece is inside out".to_owned());
        }
        None
    }
}
