//! The planes whose sections with a mesh are its strokes: fixed in the model, whatever the view.
//!
//! In: a [`Mesh`] and its [`EdgeList`]. Out: for each face the normal of its planes. A flat piece between creases has strokes along its
//! longest border. A curved piece has rings around the axis along which it turns least, and where it faces along that axis, lines across.

use crate::disjoint_sets::DisjointSets;
use crate::edges::{Class, ClassSet, Classes, CreaseAngle, EdgeList};
use crate::mesh::Mesh;
use glam::DVec3;

/// Least length of the mean of unit normals that counts as flat: they differ by some four degrees.
const FLAT: f64 = 0.998;

/// Cosine of the angle between a face's normal and the axis above which rings would be too far apart.
const ALONG_AXIS: f64 = 0.9;

/// By how much an axis other than the upright one must be better, as a share of its turning.
const BETTER: f64 = 0.8;

/// The normals of the planes of a mesh.
pub(super) struct FormPlanes {
    pub normals: Vec<DVec3>,
    /// For each face the number of its normal.
    pub of_faces: Vec<u32>,
}

/// Sums over a piece between creases.
#[derive(Clone, Copy, Default)]
struct Piece {
    area: f64,
    /// Sum of unit normals times areas, and of the squares of their components.
    normal: DVec3,
    squares: DVec3,
    /// The directions of its edges, by how much the surface turns there.
    turning: DVec3,
    /// Squares of the normals' components along `turning`.
    along_turning: f64,
    /// The longest border.
    longest: DVec3,
}

impl FormPlanes {
    pub(super) fn of(mesh: &Mesh, edges: &EdgeList) -> Self {
        let creases = Classes::new(mesh, edges, CreaseAngle::of_drawings(), ClassSet::of(&[Class::Crease]));
        let is_border = |edge: u32| edges.faces(edge).len() != 2 || !creases.of_edges[edge as usize].is_empty();
        let mut sets = DisjointSets::new(mesh.triangles.len());
        for edge in (0..edges.len() as u32).filter(|edge| !is_border(*edge)) {
            sets.join([0, 1].map(|side| edges.faces(edge)[side]));
        }
        let product =
            |triangle: &[u32; 3]| mesh.corners(triangle).map_or(DVec3::ZERO, |[a, b, c]| (b - a).cross(c - a));
        let products: Vec<DVec3> = mesh.triangles.iter().map(product).collect();
        let roots: Vec<usize> = (0..mesh.triangles.len() as u32).map(|face| sets.root(face) as usize).collect();
        let mut pieces = vec![Piece::default(); mesh.triangles.len()];
        for (product, root) in products.iter().zip(&roots) {
            pieces[*root].add_face(*product);
        }
        for edge in 0..edges.len() as u32 {
            let [from, to] = edges.positions()[edge as usize].map(|position| mesh.positions[position as usize]);
            let faces = edges.faces(edge);
            if is_border(edge) {
                faces.iter().for_each(|face| pieces[roots[*face as usize]].add_border(to - from));
            } else {
                let [first, second] = [0, 1].map(|side| products[faces[side] as usize].normalize_or_zero());
                pieces[roots[faces[0] as usize]].add_turn((to - from) * first.cross(second).length());
            }
        }
        pieces.iter_mut().for_each(|piece| piece.turning = piece.turning.normalize_or_zero());
        for (product, root) in products.iter().zip(&roots) {
            let piece = &mut pieces[*root];
            piece.along_turning += product.normalize_or_zero().dot(piece.turning).powi(2) * product.length();
        }
        let mut planes = Self { normals: Vec::new(), of_faces: Vec::with_capacity(mesh.triangles.len()) };
        let mut numbers = vec![None; mesh.triangles.len()];
        for (product, root) in products.iter().zip(&roots) {
            let [rings, across] = pieces[*root].normals();
            let first = *numbers[*root].get_or_insert_with(|| {
                planes.normals.extend([rings, across]);
                planes.normals.len() as u32 - 2
            });
            let is_along = product.normalize_or_zero().dot(rings).abs() > ALONG_AXIS;
            planes.of_faces.push(first + u32::from(is_along));
        }
        planes
    }
}

impl Piece {
    /// Adds a face by the product of two of its sides.
    fn add_face(&mut self, product: DVec3) {
        let (area, unit) = (product.length(), product.normalize_or_zero());
        self.area += area;
        self.normal += product;
        self.squares += unit * unit * area;
    }

    fn add_border(&mut self, along: DVec3) {
        let normal = self.normal.abs();
        // Of equal sides those of neighbouring faces of a block differ.
        let preferred = if normal.y >= normal.max_element() {
            DVec3::X
        } else if normal.z >= normal.x {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let length = |edge: DVec3| edge.length() * (1.0 + 0.01 * edge.normalize_or_zero().dot(preferred).abs());
        if length(along) > length(self.longest) {
            self.longest = along;
        }
    }

    /// Adds an inner edge, as long as the surface turns there.
    fn add_turn(&mut self, turn: DVec3) {
        self.turning += if self.turning.dot(turn) < 0.0 { -turn } else { turn };
    }

    /// The normals of the planes for its faces, and for those that face along the first.
    fn normals(&self) -> [DVec3; 2] {
        let mean = self.normal / self.area;
        if mean.length() >= FLAT {
            let across = mean.cross(self.longest).normalize_or(mean.any_orthogonal_vector().normalize_or(DVec3::Y));
            return [across; 2];
        }
        let axes = [
            (DVec3::Y, self.squares.y * BETTER),
            (DVec3::X, self.squares.x),
            (DVec3::Z, self.squares.z),
            (self.turning, if self.turning == DVec3::ZERO { f64::INFINITY } else { self.along_turning }),
        ];
        let axis =
            axes.into_iter().min_by(|(_, one), (_, other)| one.total_cmp(other)).map_or(DVec3::Y, |(axis, _)| axis);
        let side = if axis.x.abs() < 0.7 { DVec3::X } else { DVec3::Z };
        [axis, (side - axis * axis.dot(side)).normalize_or(DVec3::X)]
    }
}
