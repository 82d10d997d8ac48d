//! The curvature of the smooth surface that a mesh approximates. Each vertex has a normal, two principal curvatures
//! with their directions, and the derivative of curvature along these.
//!
//! Input: a [`Mesh`] and its [`EdgeList`]. Output: [`Curvatures`]. The method is Rusinkiewicz's (*Estimating
//! curvatures and their derivatives on triangle meshes*, 2004). In each triangle a tensor is fitted to the
//! differences of the vertices' normals along its sides. It is rotated into each vertex's tangent plane and averaged
//! there, weighted by the areas nearest to the vertex. The derivative is fitted in the same way to the differences of
//! the tensors. Normals are averaged with Max's weights (1999), which are exact on a sphere.
//!
//! Surfaces end at creases, boundaries, edges with three or more faces, and edges whose faces have opposite
//! orientations. A position there has one *vertex* for each smooth piece that meets in it: the faces connected around
//! it without crossing such an edge. A crease that ends in the middle of a smooth piece therefore splits nothing.
//!
//! Curvature is positive where the surface is convex from outside. It is 0 where it is undefined: in triangles
//! without area, and at vertices that have no others.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::curvature::Curvatures;
//! use tinta_geometry::edges::CreaseAngle;
//! use tinta_geometry::{EdgeList, LoadOptions, load};
//!
//! let gear = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let curvatures = Curvatures::new(&gear, &EdgeList::new(&gear), CreaseAngle::of_drawings(), 0.0);
//! // A gear's corners are those of several surfaces.
//! assert!(curvatures.all().len() > gear.positions.len());
//! assert!(curvatures.all().iter().all(|at| at.principal[0].abs() >= at.principal[1].abs()));
//! # Ok(())
//! # }
//! ```

#[cfg(test)]
pub(crate) mod shapes;
mod surface;
mod tensor;
#[cfg(test)]
mod tests;

use crate::edges::{CreaseAngle, EdgeList};
use crate::mesh::Mesh;
use crate::threads::{filled, threads_for};
use crate::tolerances::{FEATURE_SHARE, LARGEST_FEATURE};
use glam::DVec3;
use std::sync::{Arc, Mutex, PoisonError};
use surface::Surface;

pub use tensor::Curvature;
use tensor::{Basis, Derivative, Tensor, of_triangle};

impl Curvature {
    /// The curvature tensor for two vectors; only their components in the tangent plane count.
    pub fn second(&self, [a, b]: [DVec3; 2]) -> f64 {
        let [u, v] = self.directions;
        self.principal[0] * a.dot(u) * b.dot(u) + self.principal[1] * a.dot(v) * b.dot(v)
    }

    /// The derivative of the tensor for the same vector three times.
    pub fn third(&self, along: DVec3) -> f64 {
        let (u, v) = (along.dot(self.directions[0]), along.dot(self.directions[1]));
        let [a, b, c, d] = self.derivative;
        u * u * (a * u + 3.0 * b * v) + v * v * (3.0 * c * u + d * v)
    }
}

/// The curvatures of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Curvatures {
    /// Each triangle's vertices.
    corners: Vec<[u32; 3]>,
    /// Each vertex's position in the mesh.
    positions: Vec<u32>,
    at: Vec<Curvature>,
    feature_size: f64,
}

impl Curvatures {
    /// Computes the curvatures; edges sharper than `crease_angle` are creases. First a Gaussian with a standard
    /// deviation of about `smoothing` edge lengths smooths the normals; 0 leaves them unchanged.
    pub fn new(mesh: &Mesh, edges: &EdgeList, crease_angle: CreaseAngle, smoothing: f64) -> Self {
        let threads = threads_for(mesh.triangles.len());
        let surface = Surface::new(mesh, edges, crease_angle, smoothing, threads);
        let at = curvatures(&surface, threads);
        let feature_size = feature_size(&at) * surface.radius;
        // Convert from the mesh's radius to file units.
        let in_file = |at: &Curvature| Curvature {
            principal: at.principal.map(|curvature| curvature / surface.radius),
            derivative: at.derivative.map(|derivative| derivative / surface.radius / surface.radius),
            ..*at
        };
        let at: Vec<Curvature> = at.iter().map(in_file).collect();
        let mut positions = vec![0; at.len()];
        for (vertices, triangle) in surface.corners.iter().zip(&mesh.triangles) {
            (0..3).for_each(|corner| positions[vertices[corner] as usize] = triangle[corner]);
        }
        Self { corners: surface.corners, positions, at, feature_size }
    }

    /// The curvatures for form lines, whose creases are the listing's: sharper than 66.4 degrees, because a coarse mesh of a round
    /// shape has many edges above the 30 degrees at which a drawing shows a crease.
    pub(crate) fn of_form(mesh: &Mesh, edges: &EdgeList, smoothing: f64) -> Self {
        Self::new(mesh, edges, CreaseAngle::default(), smoothing)
    }

    /// Each triangle's three vertices, in the order of the mesh's triangles and their corners.
    pub fn corners(&self) -> &[[u32; 3]] {
        &self.corners
    }

    /// Each vertex's position, by its number in the mesh.
    pub fn positions(&self) -> &[u32] {
        &self.positions
    }

    /// The curvature at every vertex.
    pub fn all(&self) -> &[Curvature] {
        &self.at
    }

    /// The curvature at a vertex.
    pub fn at(&self, vertex: u32) -> &Curvature {
        &self.at[vertex as usize]
    }

    /// The unit of length for thresholds, in file units. Take the 10th percentile of all principal curvatures by
    /// absolute value: the unit is 1 % of its radius of curvature, and at most 5 % of the mesh's radius. The viewer
    /// by the authors of suggestive contours uses the same unit.
    pub(crate) fn feature_size(&self) -> f64 {
        self.feature_size
    }
}

/// The curvatures of a mesh for the latest settings.
#[derive(Debug, Default)]
pub(crate) struct KeptCurvatures(Mutex<Option<(f64, Arc<Curvatures>)>>);

impl KeptCurvatures {
    /// Returns those of a mesh, which must be the same in every call.
    pub(crate) fn get(&self, mesh: &Mesh, edges: &EdgeList, smoothing: f64) -> Arc<Curvatures> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((kept, curvatures)) if *kept == smoothing => curvatures.clone(),
            _ => {
                let curvatures = Arc::new(Curvatures::of_form(mesh, edges, smoothing));
                *kept = Some((smoothing, curvatures.clone()));
                curvatures
            }
        }
    }
}

/// The curvature at each vertex of a surface, relative to the surface's radius.
fn curvatures(surface: &Surface, threads: usize) -> Vec<Curvature> {
    let faces = surface.corners.len();
    let bases: Vec<Option<Basis>> =
        filled(faces, threads, None, |face| Basis::of_face(surface.points(face), surface.areas[face]));
    let normals = |face: usize| surface.corners[face].map(|vertex| surface.normals[vertex as usize]);
    let tensors = filled(faces, threads, None, |face| {
        let basis = bases[face]?;
        of_triangle::<2, 3>(&basis.sides, normals(face).map(|normal| basis.flat(normal)))
    });
    let mut at = filled(surface.normals.len(), threads, Curvature::default(), |vertex| {
        let Some(own) = Basis::of_normal(surface.normals[vertex]) else { return Curvature::default() };
        let mut sum = Sum::<3>::default();
        for (face, area) in surface.around(vertex) {
            if let (Some(basis), Some(tensor)) = (bases[face], tensors[face]) {
                sum.add(own.turned(&basis).map(|turn| Tensor(tensor).seen(turn).0), area);
            }
        }
        let (principal, directions) = Tensor(sum.mean()).principal(&own);
        Curvature { normal: surface.normals[vertex], principal, directions, derivative: [0.0; 4] }
    });
    let derivatives = filled(faces, threads, None, |face| {
        let basis = bases[face]?;
        let mut seen = [[0.0; 3]; 3];
        for (seen, vertex) in seen.iter_mut().zip(surface.corners[face]) {
            let at = &at[vertex as usize];
            let turn = basis.turned(&Basis::of_curvature(at)?)?;
            *seen = Tensor([at.principal[0], 0.0, at.principal[1]]).seen(turn).0;
        }
        of_triangle::<3, 4>(&basis.sides, seen)
    });
    let derivative = |vertex: usize| {
        let mut sum = Sum::<4>::default();
        let Some(own) = Basis::of_curvature(&at[vertex]) else { return sum.mean() };
        for (face, area) in surface.around(vertex) {
            if let (Some(basis), Some(derivative)) = (bases[face], derivatives[face]) {
                sum.add(own.turned(&basis).map(|turn| Derivative(derivative).seen(turn).0), area);
            }
        }
        sum.mean()
    };
    let all: Vec<[f64; 4]> = filled(at.len(), threads, [0.0; 4], derivative);
    at.iter_mut().zip(all).for_each(|(at, derivative)| at.derivative = derivative);
    at
}

/// A mean weighted by area.
struct Sum<const N: usize> {
    sum: [f64; N],
    area: f64,
}

impl<const N: usize> Default for Sum<N> {
    fn default() -> Self {
        Self { sum: [0.0; N], area: 0.0 }
    }
}

impl<const N: usize> Sum<N> {
    fn add(&mut self, numbers: Option<[f64; N]>, area: f64) {
        if let Some(numbers) = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite())) {
            self.sum.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += area * number);
            self.area += area;
        }
    }

    /// 0 if nothing was added.
    fn mean(&self) -> [f64; N] {
        if self.area > 0.0 { self.sum.map(|sum| sum / self.area) } else { [0.0; N] }
    }
}

/// The unit of length for thresholds, in radii of the mesh.
fn feature_size(at: &[Curvature]) -> f64 {
    let mut amounts: Vec<f64> = at.iter().flat_map(|at| at.principal).map(f64::abs).collect();
    let tenth = amounts.len() / 10;
    if amounts.is_empty() {
        return LARGEST_FEATURE;
    }
    let (_, flattest, _) = amounts.select_nth_unstable_by(tenth, f64::total_cmp);
    (FEATURE_SHARE / *flattest).min(LARGEST_FEATURE)
}
