//! Quadric edge collapse after Garland and Heckbert (SIGGRAPH 1997).
//!
//! In: a fine closed mesh, the number of triangles wanted, and a weight per
//! vertex that says how much the eye cares (features of the face high, what
//! lies hidden under the hair low). Out: the coarse closed mesh.

use crate::mesh::Mesh;
use crate::vector::Vec3;
use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

/// The squared distance to a set of planes: p'Ap + 2b'p + c.
#[derive(Clone, Copy, Default)]
struct Quadric {
    /// xx, xy, xz, yy, yz, zz of the symmetric matrix A.
    a: [f64; 6],
    b: Vec3,
    c: f64,
}

impl Quadric {
    fn plane(normal: Vec3, point: Vec3, weight: f64) -> Quadric {
        let d = -normal.dot(point);
        let n = normal;
        let a = [n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z];
        Quadric { a: a.map(|entry| entry * weight), b: n * (d * weight), c: d * d * weight }
    }

    /// The squared distance to a point: a light pull that settles vertices on
    /// flat ground, where the planes alone leave them free to slide.
    fn point(point: Vec3, weight: f64) -> Quadric {
        Quadric { a: [weight, 0.0, 0.0, weight, 0.0, weight], b: point * -weight, c: point.dot(point) * weight }
    }

    fn plus(&self, other: &Quadric) -> Quadric {
        Quadric { a: std::array::from_fn(|i| self.a[i] + other.a[i]), b: self.b + other.b, c: self.c + other.c }
    }

    fn times(&self, p: Vec3) -> Vec3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        Vec3 { x: xx * p.x + xy * p.y + xz * p.z, y: xy * p.x + yy * p.y + yz * p.z, z: xz * p.x + yz * p.y + zz * p.z }
    }

    fn error(&self, p: Vec3) -> f64 {
        (p.dot(self.times(p)) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// The point of least error, by Cramer's rule, when it is well defined.
    fn best(&self) -> Option<Vec3> {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        let (r0, r1, r2) = (Vec3 { x: xx, y: xy, z: xz }, Vec3 { x: xy, y: yy, z: yz }, Vec3 { x: xz, y: yz, z: zz });
        let determinant = r0.dot(r1.cross(r2));
        let size = xx + yy + zz;
        if determinant.abs() < 1e-9 * size * size * size {
            return None;
        }
        let rhs = -self.b;
        Some((r1.cross(r2) * rhs.x + r2.cross(r0) * rhs.y + r0.cross(r1) * rhs.z) / determinant)
    }
}

struct Candidate {
    cost: f64,
    edge: (usize, usize),
    stamps: (u32, u32),
    target: Vec3,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Candidate {
    /// The cheapest edge is the greatest; equal costs go by vertex number, so
    /// that the order never depends on how the heap was filled.
    fn cmp(&self, other: &Self) -> Ordering {
        (other.cost.total_cmp(&self.cost)).then_with(|| other.edge.cmp(&self.edge))
    }
}

struct Collapser {
    mesh: Mesh,
    alive: Vec<bool>,
    faces: Vec<Vec<usize>>,
    quadrics: Vec<Quadric>,
    stamps: Vec<u32>,
    heap: BinaryHeap<Candidate>,
    face_count: usize,
}

/// Collapses edges until `target` triangles are left or no edge may go.
pub fn decimate(mesh: &Mesh, target: usize, weight: &dyn Fn(Vec3) -> f64) -> Mesh {
    let mut collapser = Collapser::new(mesh, weight);
    while collapser.face_count > target {
        let Some(candidate) = collapser.heap.pop() else {
            break;
        };
        let (a, b) = candidate.edge;
        if candidate.stamps == (collapser.stamps[a], collapser.stamps[b])
            && collapser.may_collapse(a, b, candidate.target)
        {
            collapser.collapse(a, b, candidate.target);
        }
    }
    collapser.clear_needles();
    let mut result = collapser.mesh;
    let mut alive = collapser.alive.iter();
    result.triangles.retain(|_| alive.next() == Some(&true));
    result.compact();
    result
}

impl Collapser {
    fn new(mesh: &Mesh, weight: &dyn Fn(Vec3) -> f64) -> Collapser {
        let count = mesh.positions.len();
        let mut collapser = Collapser {
            alive: vec![true; mesh.triangles.len()],
            faces: vec![Vec::new(); count],
            quadrics: vec![Quadric::default(); count],
            stamps: vec![0; count],
            heap: BinaryHeap::new(),
            face_count: mesh.triangles.len(),
            mesh: mesh.clone(),
        };
        let importances: Vec<f64> = mesh.positions.iter().map(|&p| weight(p)).collect();
        let mut edges = BTreeSet::new();
        for (face, &triangle) in mesh.triangles.iter().enumerate() {
            let area = mesh.area_vector(triangle);
            let size = area.length();
            let normal = area.normalized();
            for corner in 0..3 {
                let vertex = triangle[corner];
                let position = mesh.positions[vertex];
                let importance = importances[vertex] * size;
                let plane = Quadric::plane(normal, position, importance);
                let pull = Quadric::point(position, 3e-4 * importance);
                collapser.quadrics[vertex] = collapser.quadrics[vertex].plus(&plane).plus(&pull);
                collapser.faces[vertex].push(face);
                let next = triangle[(corner + 1) % 3];
                edges.insert((vertex.min(next), vertex.max(next)));
            }
        }
        for (a, b) in edges {
            collapser.offer(a, b);
        }
        collapser
    }

    fn offer(&mut self, a: usize, b: usize) {
        let quadric = self.quadrics[a].plus(&self.quadrics[b]);
        let (pa, pb) = (self.mesh.positions[a], self.mesh.positions[b]);
        let middle = pa.lerp(pb, 0.5);
        let reach = (pb - pa).length();
        let target = quadric.best().filter(|&p| (p - middle).length() < 1.5 * reach).unwrap_or_else(|| {
            let cheaper = |x: Vec3, y: Vec3| {
                if quadric.error(x) <= quadric.error(y) { x } else { y }
            };
            cheaper(middle, cheaper(pa, pb))
        });
        self.heap.push(Candidate {
            cost: quadric.error(target),
            edge: (a.min(b), a.max(b)),
            stamps: (self.stamps[a.min(b)], self.stamps[a.max(b)]),
            target,
        });
    }

    /// Folds up the few needles that sharp edges leave behind: each goes with
    /// its shortest edge, which is far too short for anyone to miss.
    fn clear_needles(&mut self) {
        for face in 0..self.mesh.triangles.len() {
            if !self.alive[face] {
                continue;
            }
            let triangle = self.mesh.triangles[face];
            let side = |i: usize| {
                let [a, b] = [triangle[i], triangle[(i + 1) % 3]];
                ((self.mesh.positions[b] - self.mesh.positions[a]).length(), a, b)
            };
            let mut sides = [side(0), side(1), side(2)];
            sides.sort_by(|x, y| x.0.total_cmp(&y.0));
            let (shortest, a, b) = sides[0];
            let needle = self.mesh.area_vector(triangle).length() < 0.01 * sides[2].0 * sides[2].0;
            if needle && shortest < 0.03 * sides[2].0 && self.stays_closed(a, b) {
                let target = self.mesh.positions[a];
                self.collapse(a, b, target);
            }
        }
    }

    /// The link condition: only the two triangles on the edge vanish.
    fn stays_closed(&self, a: usize, b: usize) -> bool {
        let shared = self.neighbours(a).intersection(&self.neighbours(b)).count();
        shared == 2 && self.faces[a].len() + self.faces[b].len() > 6
    }

    fn neighbours(&self, vertex: usize) -> BTreeSet<usize> {
        self.faces[vertex].iter().flat_map(|&face| self.mesh.triangles[face]).filter(|&other| other != vertex).collect()
    }

    /// Refuses a collapse that would pinch the surface, flip a triangle or
    /// leave a needle behind.
    fn may_collapse(&self, a: usize, b: usize, target: Vec3) -> bool {
        if !self.stays_closed(a, b) {
            return false;
        }
        for (moved, other) in [(a, b), (b, a)] {
            for &face in &self.faces[moved] {
                let triangle = self.mesh.triangles[face];
                if triangle.contains(&other) {
                    continue;
                }
                let before = self.mesh.area_vector(triangle);
                let corners = triangle.map(|i| if i == moved { target } else { self.mesh.positions[i] });
                let after = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
                let longest = (0..3).map(|i| (corners[(i + 1) % 3] - corners[i]).length()).fold(0.0, f64::max);
                // A triangle that is a needle already has no direction to keep.
                let straight = before.dot(after) > 0.25 * before.length() * after.length()
                    || before.length() < 1e-3 * longest * longest;
                // Height over the longest edge; the fine mesh has few needles
                // itself, but those it has must be free to go.
                let needle = after.length() < 0.08 * longest * longest && after.length() < before.length();
                if !straight || needle {
                    return false;
                }
            }
        }
        true
    }

    fn collapse(&mut self, a: usize, b: usize, target: Vec3) {
        self.mesh.positions[a] = target;
        self.quadrics[a] = self.quadrics[a].plus(&self.quadrics[b]);
        for face in std::mem::take(&mut self.faces[b]) {
            let triangle = self.mesh.triangles[face];
            if triangle.contains(&a) {
                self.alive[face] = false;
                self.face_count -= 1;
                for vertex in triangle {
                    self.faces[vertex].retain(|&f| f != face);
                }
            } else {
                self.mesh.triangles[face] = triangle.map(|i| if i == b { a } else { i });
                self.faces[a].push(face);
            }
        }
        self.stamps[a] += 1;
        self.stamps[b] += 1;
        for other in self.neighbours(a) {
            self.offer(a, other);
        }
    }
}
