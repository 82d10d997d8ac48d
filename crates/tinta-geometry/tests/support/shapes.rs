//! Meshes with known counts, and random ones.

use glam::DVec3;
use std::collections::BTreeMap;
use tinta::edges::EdgeList;
use tinta::{LoadOptions, Mesh};

/// A mesh of positions and triangles alone.
pub fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    let file_vertices = (0..positions.len() as u32).collect();
    Mesh { positions, file_vertices, triangles, normals: Vec::new(), triangle_normals: Vec::new(), ..Mesh::triangle() }
}

/// A mesh as a file's is read, with normals.
pub fn shaded(mesh: &Mesh) -> Mesh {
    Mesh::of_triangles("made", mesh.positions.clone(), &mesh.triangles, &LoadOptions::default()).unwrap()
}

/// A box, two triangles a side, wound outwards.
pub fn cuboid(low: DVec3, high: DVec3) -> Mesh {
    let corner = |i: u32| {
        let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
        DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    mesh((0..8).map(corner).collect(), triangles)
}

/// Meshes put together, equal positions joined.
pub fn joined(meshes: &[Mesh]) -> Mesh {
    let mut all = mesh(Vec::new(), Vec::new());
    for one in meshes {
        let mut number = |position: &DVec3| {
            all.positions.iter().position(|known| known == position).unwrap_or_else(|| {
                all.positions.push(*position);
                all.positions.len() - 1
            }) as u32
        };
        let numbers: Vec<u32> = one.positions.iter().map(&mut number).collect();
        all.triangles.extend(one.triangles.iter().map(|triangle| triangle.map(|corner| numbers[corner as usize])));
    }
    all.file_vertices = (0..all.positions.len() as u32).collect();
    all
}

/// A sphere from an icosahedron, each triangle cut into four `levels` times.
pub fn icosphere(levels: u32) -> Mesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let corner = |number: usize| {
        let [a, b] = [number & 1, number >> 1 & 1].map(|bit| if bit == 1 { 1.0 } else { -1.0 });
        DVec3::from_array([[0.0, a, b * golden], [a, b * golden, 0.0], [b * golden, 0.0, a]][number / 4]).normalize()
    };
    let mut positions: Vec<DVec3> = (0..12).map(corner).collect();
    let mut triangles = Vec::new();
    for a in 0..12 {
        for (b, c) in (a + 1..12).flat_map(|b| (b + 1..12).map(move |c| (b, c))) {
            let [p, q, r] = [a, b, c].map(|number| positions[number as usize]);
            if p.distance(q).max(q.distance(r)).max(r.distance(p)) < 1.2 {
                triangles.push(if p.cross(q).dot(r) > 0.0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    for _ in 0..levels {
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    positions.push((positions[a as usize] + positions[b as usize]).normalize());
                    positions.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    mesh(positions, triangles)
}

/// Numbers that look random and are the same every time (xorshift).
pub struct Random(pub u64);

impl Random {
    /// A generator that gives other numbers for every seed.
    pub fn seeded(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        (0..10).for_each(|_| {
            random.number();
        });
        random
    }

    /// A whole number from one to another, both included.
    pub fn whole(&mut self, low: i32, high: i32) -> i32 {
        low + (self.number() * f64::from(high - low + 1)) as i32
    }

    /// A whole number below another.
    pub fn below(&mut self, count: u32) -> u32 {
        (self.number() * f64::from(count)) as u32
    }

    /// In [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.number() * 2.0 - 1.0
    }

    /// One of a list.
    pub fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.whole(0, list.len() as i32 - 1) as usize]
    }

    /// In [0, 1).
    pub fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A unit vector.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let vector = DVec3::new(self.number(), self.number(), self.number()) * 2.0 - DVec3::ONE;
            if (0.01..1.0).contains(&vector.length_squared()) {
                return vector.normalize();
            }
        }
    }
}

/// The loops formed by edges: `None` unless exactly two of them meet at every position.
pub fn loops(edges: &EdgeList, chosen: &[u32]) -> Option<usize> {
    let mut neighbours: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for edge in chosen {
        let [a, b] = edges.positions()[*edge as usize];
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    if neighbours.values().any(|ends| ends.len() != 2) {
        return None;
    }
    let mut count = 0;
    while let Some((&start, _)) = neighbours.first_key_value() {
        let mut next = Some(start);
        while let Some(at) = next {
            let ends = neighbours.remove(&at).unwrap_or_default();
            next = ends.into_iter().find(|end| neighbours.contains_key(end));
        }
        count += 1;
    }
    Some(count)
}
