//! The smooth surface that a mesh's faces approximate, for contours: a normal for each corner, split at sharp edges.
//!
//! In: a [`Mesh`], its [`EdgeList`] and the crease angle. Out: [`SmoothSurface`]. Around a position, all faces connected over
//! edges that are not sharp share one unit normal in f64. A face's weight is the sine of its angle there over the lengths of
//! its sides there (Max 1999: exact on a sphere). A side counts at least a tenth of its face's longest one, which keeps a
//! needle from deciding for its neighbours. Sharp edges are creases, boundaries, edges of three faces or more, and edges whose
//! faces are wound against each other. A file's own normals are ignored: they describe shading.

mod rims;

use super::{Class, ClassSet, Classes, CreaseAngle, EdgeList, Incidence};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, NONE};
use crate::threads::{filled, threads_for};
use glam::DVec3;

/// Normals of a mesh as a smooth surface between its sharp edges.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SmoothSurface {
    /// The angle above which edges are sharp.
    pub crease_angle: CreaseAngle,
    /// Unit normals; zero where faces around a position cancel out or have no area.
    pub normals: Vec<DVec3>,
    /// Each normal's position in the mesh.
    pub normal_positions: Vec<u32>,
    /// Each face corner's normal.
    pub corner_normals: Vec<[u32; 3]>,
    /// Each face's edges, from each corner to the next; [`NONE`] for a face without edges.
    pub sides: Vec<[u32; 3]>,
    /// For each edge whether the surface may bend or end there.
    pub is_sharp: Vec<bool>,
    /// For each face how its shell is closed.
    pub shells: Vec<Shell>,
    /// For each position the number of its shell, or of one of its shells.
    pub position_shells: Vec<u32>,
}

/// The kind of a set of connected faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Shell {
    /// They have an open rim or an edge of three faces, or some are wound against each other.
    Open,
    /// They enclose a volume, their fronts outside.
    Outward,
    /// They enclose a volume, their fronts inside.
    Inward,
}

/// Least length of a face's side as a share of its longest one, in the weights of normals.
const LEAST_SIDE: f64 = 0.1;

/// Largest volume of a closed shell that is mere rounding, as a share of the volumes it is summed from.
const NO_VOLUME: f64 = 1e-9;

impl SmoothSurface {
    /// Computes the normals; `edges` is the mesh's own list.
    pub(crate) fn new(mesh: &Mesh, edges: &EdgeList, crease_angle: CreaseAngle) -> Self {
        let classes = Classes::new(mesh, edges, crease_angle, ClassSet::of(&[Class::Crease]));
        let mut is_sharp: Vec<bool> =
            edges.incidence().iter().map(|incidence| *incidence != Incidence::Inner).collect();
        for edge in classes.marked {
            is_sharp[edge as usize] = true;
        }
        let sides = edges.of_faces(mesh);
        let (normals, normal_positions, corner_normals) = normals(mesh, edges, &is_sharp);
        let (shells, position_shells) = shells(mesh, edges);
        Self { crease_angle, normals, normal_positions, corner_normals, sides, is_sharp, shells, position_shells }
    }
}

/// The normals, their positions, and each corner's normal.
fn normals(mesh: &Mesh, edges: &EdgeList, is_sharp: &[bool]) -> (Vec<DVec3>, Vec<u32>, Vec<[u32; 3]>) {
    let triangles = &mesh.triangles;
    let mut groups = DisjointSets::new(triangles.len() * 3);
    for (edge, ends) in edges.positions().iter().enumerate() {
        let &[first, second] = edges.faces(edge as u32) else { continue };
        if is_sharp[edge] {
            continue;
        }
        for end in ends {
            let corner = |face: u32| {
                let corner = triangles[face as usize].iter().position(|position| position == end);
                corner.map(|corner| face * 3 + corner as u32)
            };
            if let (Some(first), Some(second)) = (corner(first), corner(second)) {
                groups.join([first, second]);
            }
        }
    }
    let weighted = filled(triangles.len(), threads_for(triangles.len()), [DVec3::ZERO; 3], |face| {
        weighted_normals(triangles[face].map(|position| mesh.positions[position as usize]))
    });
    let mut numbers = vec![NONE; triangles.len() * 3];
    let (mut sums, mut positions): (Vec<DVec3>, Vec<u32>) = (Vec::new(), Vec::new());
    let mut corners = vec![[NONE; 3]; triangles.len()];
    for (corner, position) in triangles.as_flattened().iter().enumerate() {
        let root = groups.root(corner as u32) as usize;
        if numbers[root] == NONE {
            numbers[root] = sums.len() as u32;
            sums.push(DVec3::ZERO);
            positions.push(*position);
        }
        sums[numbers[root] as usize] += weighted[corner / 3][corner % 3];
        corners[corner / 3][corner % 3] = numbers[root];
    }
    let unit = |sum: DVec3| (sum / sum.abs().max_element()).try_normalize().unwrap_or(DVec3::ZERO);
    let mut units: Vec<DVec3> = sums.into_iter().map(unit).collect();
    let of_rims = rims::normals(mesh, edges, is_sharp, &units, &positions, &corners);
    of_rims.into_iter().for_each(|(number, normal)| units[number as usize] = normal);
    (units, positions, corners)
}

/// A face's normal at each of its corners with its weight there.
fn weighted_normals(corners: [DVec3; 3]) -> [DVec3; 3] {
    let [a, b, c] = corners;
    let lengths = [b - a, c - b, a - c].map(DVec3::length);
    let longest = lengths[0].max(lengths[1]).max(lengths[2]);
    // Scaled first, to keep tiny and huge faces from losing their normals to rounding.
    let normal = ((b - a) / longest).cross((c - a) / longest);
    let side = |index: usize| (lengths[index] / longest).max(LEAST_SIDE);
    let weight = |next: usize, previous: usize| 1.0 / (side(next) * side(previous) * longest).powi(2);
    let weights = [weight(0, 2), weight(1, 0), weight(2, 1)];
    let is_one = normal.is_finite() && weights.iter().all(|weight| weight.is_finite());
    if is_one { weights.map(|weight| normal * weight) } else { [DVec3::ZERO; 3] }
}

/// How the shell of each face is closed, and the shell of each position.
fn shells(mesh: &Mesh, edges: &EdgeList) -> (Vec<Shell>, Vec<u32>) {
    let count = mesh.triangles.len();
    let mut groups = DisjointSets::new(count);
    let mut is_open = vec![false; count];
    for edge in 0..edges.len() as u32 {
        let faces = edges.faces(edge);
        match (edges.incidence()[edge as usize], faces) {
            (Incidence::Inner, &[first, second]) => groups.join([first, second]),
            _ => faces.iter().for_each(|face| is_open[*face as usize] = true),
        }
    }
    let (low, high) = mesh.bounds();
    let (centre, scale) = (low * 0.5 + high * 0.5, (high * 0.5 - low * 0.5).max_element().max(f64::MIN_POSITIVE));
    let mut volumes = vec![[0.0f64; 2]; count];
    let mut shell_is_open = vec![false; count];
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        let root = groups.root(face as u32) as usize;
        let [a, b, c] = triangle.map(|position| (mesh.positions[position as usize] - centre) / scale);
        let volume = a.dot(b.cross(c));
        volumes[root][0] += volume;
        volumes[root][1] += volume.abs();
        shell_is_open[root] |= is_open[face];
    }
    let mut shell = |face: usize| {
        let root = groups.root(face as u32) as usize;
        let [volume, sum] = volumes[root];
        match volume {
            _ if shell_is_open[root] || volume.abs() <= NO_VOLUME * sum => Shell::Open,
            volume if volume > 0.0 => Shell::Outward,
            _ => Shell::Inward,
        }
    };
    let shells = (0..count).map(&mut shell).collect();
    let mut position_shells = vec![NONE; mesh.positions.len()];
    for (face, triangle) in mesh.triangles.iter().enumerate() {
        let number = groups.root(face as u32);
        triangle.iter().for_each(|position| position_shells[*position as usize] = number);
    }
    (shells, position_shells)
}
