//! A mesh as smooth surfaces: its vertices, their normals, and the areas nearest to each corner.

use crate::edges::{CreaseAngle, EdgeList, Incidence};
use crate::mesh::{Mesh, triangle_normal};
use crate::threads::filled;
use crate::tolerances::{NEEDLE, PARALLEL_COSINE};
use glam::DVec3;
use std::cmp::Ordering;

/// A mesh as smooth surfaces, in radii from its centre.
pub(super) struct Surface {
    /// Half the diagonal of the mesh's bounding box, file units.
    pub radius: f64,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Each triangle's vertices.
    pub corners: Vec<[u32; 3]>,
    /// The part of each triangle's area that is nearest to each corner; 0 if the triangle is too thin for a plane.
    pub areas: Vec<[f64; 3]>,
    /// Each vertex's unit normal; 0 if it has none.
    pub normals: Vec<DVec3>,
    /// Where the corners of each vertex begin in `around`.
    starts: Vec<u32>,
    /// The corners of each vertex, ascending: three times the triangle's number, plus the corner.
    around: Vec<u32>,
}

impl Surface {
    pub(super) fn new(
        mesh: &Mesh,
        edges: &EdgeList,
        crease_angle: CreaseAngle,
        smoothing: f64,
        threads: usize,
    ) -> Self {
        let (low, high) = mesh.bounds();
        let radius = (high * 0.5 - low * 0.5).length();
        let radius = if radius.is_finite() && radius > 0.0 { radius } else { 1.0 };
        let middle = low * 0.5 + high * 0.5;
        let count = mesh.triangles.len();
        let positions =
            filled(mesh.positions.len(), threads, DVec3::ZERO, |index| (mesh.positions[index] - middle) / radius);
        let corners = vertices(mesh, edges, crease_angle, threads);
        let vertex_count = corners.as_flattened().iter().max().map_or(0, |last| *last as usize + 1);
        let (starts, around) = grouped(corners.as_flattened(), vertex_count);
        let mut surface = Self {
            radius,
            positions,
            triangles: mesh.triangles.clone(),
            corners,
            areas: Vec::new(),
            normals: Vec::new(),
            starts,
            around,
        };
        surface.areas = filled(count, threads, [0.0; 3], |face| areas(surface.points(face)));
        surface.normals = filled(vertex_count, threads, DVec3::ZERO, |vertex| surface.normal(vertex));
        surface.smooth(smoothing, threads);
        surface
    }

    /// A triangle's corners.
    pub(super) fn points(&self, face: usize) -> [DVec3; 3] {
        self.triangles[face].map(|position| self.positions.get(position as usize).copied().unwrap_or(DVec3::NAN))
    }

    /// The triangles around a vertex, each with the part of its area nearest to the vertex.
    pub(super) fn around(&self, vertex: usize) -> impl Iterator<Item = (usize, f64)> {
        let corners = &self.around[self.starts[vertex] as usize..self.starts[vertex + 1] as usize];
        corners.iter().map(|corner| {
            let (face, which) = (*corner as usize / 3, *corner as usize % 3);
            (face, self.areas[face][which])
        })
    }

    /// The mean of the faces' normals with Max's weights: sine of the angle over the product of both sides.
    fn normal(&self, vertex: usize) -> DVec3 {
        let corners = &self.around[self.starts[vertex] as usize..self.starts[vertex + 1] as usize];
        let weighted = |corner: &u32| {
            let (face, which) = (*corner as usize / 3, *corner as usize % 3);
            if self.areas[face] == [0.0; 3] {
                return DVec3::ZERO;
            }
            let points = self.points(face);
            let (next, last) = (points[(which + 1) % 3] - points[which], points[(which + 2) % 3] - points[which]);
            next.cross(last) / (next.length_squared() * last.length_squared())
        };
        corners.iter().map(weighted).filter(|normal| normal.is_finite()).sum::<DVec3>().normalize_or_zero()
    }

    /// Averages normals. Each step takes the area-weighted mean of the faces around a vertex, each with the mean of
    /// its corners. On even triangles, a step is a Gaussian with a variance of 1/3 of an edge's square.
    fn smooth(&mut self, smoothing: f64, threads: usize) {
        for _ in 0..(3.0 * smoothing * smoothing).round() as usize {
            let mean = |vertex: usize| {
                let sum: DVec3 = self
                    .around(vertex)
                    .map(|(face, area)| {
                        area * self.corners[face].iter().map(|corner| self.normals[*corner as usize]).sum::<DVec3>()
                    })
                    .sum();
                sum.try_normalize().unwrap_or(self.normals[vertex])
            };
            self.normals = filled(self.normals.len(), threads, DVec3::ZERO, mean);
        }
    }
}

/// The part of a triangle's area that is nearest to each corner (Meyer et al. 2002); 0 for a needle.
fn areas(points: [DVec3; 3]) -> [f64; 3] {
    let sides = [0, 1, 2].map(|corner| points[(corner + 2) % 3] - points[(corner + 1) % 3]);
    let squares = sides.map(DVec3::length_squared);
    let area = 0.5 * sides[0].cross(sides[1]).length();
    let longest = squares.into_iter().fold(0.0, f64::max);
    // Also true for NaN.
    if area.partial_cmp(&(NEEDLE * longest)) != Some(Ordering::Greater) {
        return [0.0; 3];
    }
    // Twice the cosine at each corner times both its sides: negative for an obtuse angle.
    let blunt = [0, 1, 2].map(|corner| squares[(corner + 1) % 3] + squares[(corner + 2) % 3] - squares[corner]);
    if let Some(obtuse) = blunt.iter().position(|cosine| *cosine <= 0.0) {
        let mut shares = [0.25 * area; 3];
        shares[obtuse] = 0.5 * area;
        return shares;
    }
    // The squares of the other two sides, each times the cotangent of the opposite angle.
    let parts = [0, 1, 2].map(|corner| squares[corner] * blunt[corner] / (32.0 * area));
    [0, 1, 2].map(|corner| parts[(corner + 1) % 3] + parts[(corner + 2) % 3])
}

/// Each triangle's vertices: corners at one position, joined by edges across which the surface continues.
fn vertices(mesh: &Mesh, edges: &EdgeList, crease_angle: CreaseAngle, threads: usize) -> Vec<[u32; 3]> {
    let count = mesh.triangles.len();
    let normals = filled(count, threads, DVec3::ZERO, |face| {
        let corners = mesh.triangles[face].map(|position| mesh.positions.get(position as usize).copied());
        let [Some(a), Some(b), Some(c)] = corners else { return DVec3::ZERO };
        triangle_normal([a, b, c]).unwrap_or(DVec3::ZERO)
    });
    // The lowest corner identifies a set.
    let mut sets: Vec<u32> = (0..3 * count as u32).collect();
    for (edge, ends) in edges.positions().iter().enumerate() {
        let &[first, second] = edges.faces(edge as u32) else { continue };
        let [one, other] = [first, second].map(|face| normals[face as usize]);
        let has_both = one != DVec3::ZERO && other != DVec3::ZERO;
        let is_crease = has_both && one.dot(other) < crease_angle.cosine - PARALLEL_COSINE;
        if edges.incidence()[edge] != Incidence::Inner || is_crease {
            continue;
        }
        for end in ends {
            let corner = |face: u32| {
                let which = mesh.triangles[face as usize].iter().position(|position| position == end);
                which.map(|which| 3 * face + which as u32)
            };
            if let (Some(one), Some(other)) = (corner(first), corner(second)) {
                let (one, other) = (named(&mut sets, one), named(&mut sets, other));
                sets[one.max(other) as usize] = one.min(other);
            }
        }
    }
    let mut next = 0;
    let mut numbers = vec![0u32; sets.len()];
    for corner in 0..sets.len() as u32 {
        let set = named(&mut sets, corner);
        if set == corner {
            numbers[corner as usize] = next;
            next += 1;
        } else {
            numbers[corner as usize] = numbers[set as usize];
        }
    }
    numbers.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect()
}

/// The lowest corner of a corner's set.
fn named(sets: &mut [u32], mut corner: u32) -> u32 {
    while sets[corner as usize] != corner {
        sets[corner as usize] = sets[sets[corner as usize] as usize];
        corner = sets[corner as usize];
    }
    corner
}

/// The indices of each number in a list, ascending: where those of each number begin, and all of them.
fn grouped(list: &[u32], count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; count + 1];
    list.iter().for_each(|number| starts[*number as usize + 1] += 1);
    for number in 0..count {
        starts[number + 1] += starts[number];
    }
    let mut next = starts.clone();
    let mut places = vec![0u32; list.len()];
    for (place, number) in list.iter().enumerate() {
        places[next[*number as usize] as usize] = place as u32;
        next[*number as usize] += 1;
    }
    (starts, places)
}
