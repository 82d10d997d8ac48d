//! Axes of round surfaces: cylinders and cones that go half around at least, and half spheres at least.
//!
//! In: a [`Mesh`], its [`EdgeList`], the faces' normals. Out: [`Axis`] values. Surfaces around one axis share it, as the steps of a
//! shaft do.

use super::EdgeList;
use super::fitted_surfaces::{FLAT, FittedSurface, Kind};
use super::patches::{Patch, Patches};
use crate::mesh::{Mesh, SECTION};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The axis of round surfaces, or a sphere's centre; the mesh's coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    /// Where the surfaces begin and end along it.
    pub ends: [DVec3; 2],
    /// A unit vector along it; 0 for a sphere.
    pub direction: DVec3,
    /// The largest distance of the surfaces from it.
    pub radius: f64,
    /// The surfaces' faces.
    pub faces: Vec<u32>,
}

/// Surfaces around one axis.
struct Round {
    surface: FittedSurface,
    faces: Vec<u32>,
}

/// The axes of a mesh.
pub(super) fn axes(mesh: &Mesh, edges: &EdgeList, normals: &[[f64; 3]], smooth: f64, threads: usize) -> Vec<Axis> {
    let patches = Patches::new(mesh, edges, normals, smooth, threads);
    let mut rounds: Vec<Round> = Vec::new();
    for Patch { surface, faces, .. } in &patches.all {
        let shared = match surface.kind {
            Kind::Plane | Kind::Torus => continue,
            Kind::Sphere => None,
            Kind::Cylinder | Kind::Cone => rounds.iter_mut().find(|round| is_around(surface, &round.surface)),
        };
        match shared {
            Some(round) => round.faces.extend(faces),
            None => rounds.push(Round { surface: *surface, faces: faces.clone() }),
        }
    }
    let is_cut = mesh.parts.iter().any(|part| part.name == SECTION);
    rounds.into_iter().filter_map(|round| round.axis(&patches, normals, is_cut)).collect()
}

/// Whether a surface lies around another's axis.
fn is_around(surface: &FittedSurface, other: &FittedSurface) -> bool {
    other.kind != Kind::Sphere
        && surface.axis.cross(other.axis).length() <= FLAT
        && other.profile(surface.point).0.x <= FLAT * surface.sizes[0].max(other.sizes[0])
}

impl Round {
    /// The axis, if the surfaces go half around, before a cut took a part of them.
    fn axis(self, patches: &Patches<'_>, normals: &[[f64; 3]], is_cut: bool) -> Option<Axis> {
        let Self { surface, faces } = self;
        if surface.kind == Kind::Sphere {
            let area = |face: &u32| {
                let [a, b, c] = patches.corners(*face);
                (b - a).cross(c - a).length()
            };
            let sum: DVec3 = faces.iter().map(|face| DVec3::from_array(normals[*face as usize]) * area(face)).sum();
            // A half sphere's mean normal is half as long as each.
            let is_half = sum.length() <= (0.5 + FLAT) * faces.iter().map(area).sum::<f64>();
            let ends = [surface.point; 2];
            return is_half.then_some(Axis { ends, direction: DVec3::ZERO, radius: surface.sizes[0], faces });
        }
        let [first, second]: [DVec3; 2] = surface.axis.any_orthonormal_pair().into();
        let (mut turns, mut low, mut high, mut radius) = (Vec::new(), f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for point in faces.iter().flat_map(|face| patches.corners(*face)) {
            let (place, outwards) = surface.profile(point);
            turns.push(outwards.dot(second).atan2(outwards.dot(first)));
            (low, high, radius) = (low.min(place.y), high.max(place.y), radius.max(place.x));
        }
        turns.sort_by(f64::total_cmp);
        turns.push(turns[0] + TAU);
        let mut gaps: Vec<f64> = turns.windows(2).map(|pair| pair[1] - pair[0]).collect();
        gaps.sort_by(f64::total_cmp);
        let [.., facet, gap] = gaps[..] else { return None };
        let ends = [low, high].map(|along| surface.point + surface.axis * along);
        // A cut's corners lie on facets: at each end of a cylinder it takes a part of one.
        let lost = if is_cut && surface.kind == Kind::Cylinder { 2.0 * facet } else { 0.0 };
        (gap - lost <= PI + FLAT).then_some(Axis { ends, direction: surface.axis, radius, faces })
    }
}
