//! Patches of a mesh that lie on fitted surfaces.
//!
//! In: a [`Mesh`], its [`EdgeList`], the faces' normals. Out: [`Patches`]. Only vertices lie on the true surface. So a section across each
//! edge gives rows of six faces, a surface is fitted to their vertices, and the patch grows over smooth edges to the faces whose
//! vertices it passes through. Through two circles there are always a cone and a sphere; if a torus passes through the next circles
//! too, the patch is that. Of overlapping patches the largest stays. Faces beside them form planes.

use super::fitted_surfaces::{FittedSurface, Kind};
use super::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::threads::in_parallel;
use crate::tolerances::PRINTED_DIGITS;
use glam::DVec3;
use std::collections::HashSet;

/// Largest turn between two faces that counts as flat, radians: more than a file's six digits bend a facet.
pub(super) const FLAT: f64 = 1e-3;

/// Faces of a row: three quadrilaterals.
const ROW: usize = 6;

/// Least depth of a row, in tolerances: a shallower one is flat within rounding.
const DEPTH: f64 = 4.0;

/// Largest spread of a row's vertices around the surface that its faces suggest, as a share of the depth.
const SPREAD: f64 = 0.3;

/// Least cosine between a face's normal and the surface's at its corners: two facets of 30 degrees across both ways.
const STEEP: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Least vertices of a patch: those of a cylinder of four facets.
const LEAST: usize = 10;

/// Least distance of most vertices beyond a patch from its surface, as a multiple of the mean distance within. A part of a surface of
/// another kind ends where the tolerance ends.
const GAP: f64 = 32.0;

/// Most faces of all patches tried, as a multiple of the mesh's.
const MOST: usize = 32;

/// A fitted surface and its faces.
pub(crate) struct Patch {
    pub surface: FittedSurface,
    pub faces: Vec<u32>,
    is_sure: bool,
}

/// What patches that grow share: a mark for each face, and how many faces they may still visit.
struct Growth {
    taken: Vec<bool>,
    left: usize,
}

/// The patches of a mesh.
pub(crate) struct Patches<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeList,
    normals: &'a [[f64; 3]],
    /// For each face its edges.
    edges_of: Vec<[u32; 3]>,
    /// Cosine of the largest turn within a patch. The user's crease angle would not do: looks that keep lasting creases judge by a
    /// smaller one.
    smooth: f64,
    /// Largest distance of a vertex from its surface, file units.
    tolerance: f64,
    pub all: Vec<Patch>,
    /// The patch of each face, or [`NONE`].
    pub of_faces: Vec<u32>,
}

impl<'a> Patches<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        edges: &'a EdgeList,
        normals: &'a [[f64; 3]],
        smooth: f64,
        threads: usize,
    ) -> Self {
        let (low, high) = mesh.bounds();
        let mut patches = Self {
            mesh,
            edges,
            normals,
            edges_of: edges.of_faces(mesh),
            smooth,
            tolerance: PRINTED_DIGITS * (high - low).length(),
            all: Vec::new(),
            of_faces: vec![NONE; mesh.triangles.len()],
        };
        let rows = in_parallel(edges.len(), threads, |range| {
            let rows = range.filter_map(|edge| patches.row(edge as u32));
            rows.filter(|row| !patches.surfaces(row).is_empty()).collect::<Vec<_>>()
        });
        let mut found = patches.round(&rows.concat());
        found.sort_by_key(|patch| std::cmp::Reverse(patch.faces.len()));
        for mut patch in found {
            let count = patch.faces.len();
            patch.faces.retain(|face| patches.of_faces[*face as usize] == NONE);
            if 2 * patch.faces.len() >= count {
                patches.add(patch);
            }
        }
        patches.add_planes();
        patches
    }

    /// The sine of an edge's turn and its faces, unless the surface ends or turns too far there.
    pub(super) fn smooth(&self, edge: u32) -> Option<(f64, [u32; 2])> {
        let sign = match self.edges.incidence.get(edge as usize) {
            Some(Incidence::Inner) => 1.0,
            Some(Incidence::InnerReversed) => -1.0,
            _ => return None,
        };
        let faces = self.edges.faces[edge as usize];
        let [first, second] = faces.map(|face| self.normal(face));
        let cosine = sign * first.dot(second);
        (cosine >= self.smooth).then(|| (first.cross(second).length(), faces))
    }

    /// The face beyond an edge of a face, if the surface is smooth there.
    fn beyond(&self, edge: u32, face: u32) -> Option<u32> {
        self.smooth(edge)?.1.into_iter().find(|side| *side != face)
    }

    /// Whether a face's vertices and normal are those of a surface.
    fn is_on(&self, face: u32, surface: &FittedSurface) -> bool {
        let corners = self.corners(face).map(|corner| surface.at(corner));
        let own = self.normal(face);
        let is_near =
            |(distance, normal): &(f64, DVec3)| distance.abs() <= self.tolerance && normal.dot(own).abs() >= STEEP;
        // A plane that touches a torus has faces with all corners there.
        let turns = corners.iter().any(|(_, normal)| normal.cross(corners[0].1).length() > FLAT);
        corners.iter().all(is_near) && (turns || surface.kind != Kind::Torus)
    }

    fn add(&mut self, patch: Patch) {
        patch.faces.iter().for_each(|face| self.of_faces[*face as usize] = self.all.len() as u32);
        self.all.push(patch);
    }

    /// Adds the planes beside other patches, the largest faces first.
    fn add_planes(&mut self) {
        let area = |face: u32| {
            let [a, b, c] = self.corners(face);
            (b - a).cross(c - a).length()
        };
        let is_free = |face: &u32| self.of_faces[*face as usize] == NONE;
        let smooth = (0..self.edges.len() as u32).filter_map(|edge| self.smooth(edge));
        let ends = smooth.filter(|(_, faces)| !faces.iter().all(is_free));
        let mut beside: Vec<u32> = ends.flat_map(|(_, faces)| faces).filter(is_free).collect();
        beside.sort_by(|one, other| area(*other).total_cmp(&area(*one)).then(one.cmp(other)));
        let taken = (0..self.of_faces.len() as u32).map(|face| !is_free(&face)).collect();
        let mut growth = Growth { taken, left: MOST * self.of_faces.len() };
        for face in beside {
            if self.of_faces[face as usize] == NONE {
                let [point, ..] = self.corners(face);
                let plane = FittedSurface { kind: Kind::Plane, point, axis: self.normal(face), sizes: [0.0; 2] };
                if let Some(patch) = self.grown(&[face], plane, &mut growth) {
                    patch.faces.iter().for_each(|face| growth.taken[*face as usize] = true);
                    self.add(patch);
                }
            }
        }
    }

    /// The patches that grow from rows of faces. They may overlap.
    fn round(&self, rows: &[[u32; ROW]]) -> Vec<Patch> {
        let mut found: Vec<Patch> = Vec::new();
        let mut largest = vec![NONE; self.of_faces.len()];
        let mut growth = Growth { taken: vec![false; self.of_faces.len()], left: MOST * self.of_faces.len() };
        for row in rows {
            let is_known = |face: &u32| {
                let known = largest[*face as usize];
                known != NONE && row.iter().all(|face| self.is_on(*face, &found[known as usize].surface))
            };
            if row.iter().any(is_known) {
                continue;
            }
            let mut surfaces = self.surfaces(row);
            let mut count = 0;
            while let Some(surface) = surfaces.pop() {
                let Some(patch) = self.grown(row, surface, &mut growth) else { continue };
                // A torus takes the next circle whole.
                let least = if surface.kind == Kind::Torus { 2 * count } else { count };
                if patch.faces.len() <= least {
                    continue;
                }
                count = patch.faces.len();
                if matches!(surface.kind, Kind::Cylinder | Kind::Cone) {
                    surfaces.extend(self.tori(row, &patch));
                }
                for face in &patch.faces {
                    let known = &mut largest[*face as usize];
                    if *known == NONE || found[*known as usize].faces.len() < count {
                        *known = found.len() as u32;
                    }
                }
                found.push(patch);
            }
        }
        found.retain(|patch| patch.is_sure);
        found
    }

    /// Grows a patch from faces over smooth edges, and fits its surface again until it grows no more.
    fn grown(&self, first: &[u32], mut surface: FittedSurface, growth: &mut Growth) -> Option<Patch> {
        let mut before = 0;
        loop {
            let mut faces = first.to_vec();
            faces.iter().for_each(|face| growth.taken[*face as usize] = true);
            let mut border = Vec::new();
            let mut next = 0;
            while next < faces.len() {
                for edge in self.edges_of[faces[next] as usize].into_iter().filter(|edge| *edge != NONE) {
                    let beyond = self.beyond(edge, faces[next]);
                    match beyond {
                        Some(face) if growth.taken[face as usize] => {}
                        Some(face) if self.is_on(face, &surface) => {
                            growth.taken[face as usize] = true;
                            faces.push(face);
                        }
                        _ => border.push((edge, beyond)),
                    }
                }
                next += 1;
            }
            faces.iter().for_each(|face| growth.taken[*face as usize] = false);
            growth.left = growth.left.checked_sub(faces.len())?;
            let points = self.points(&faces);
            surface = surface.fitted(&points, self.tolerance)?;
            if faces.len() > before {
                before = faces.len();
                continue;
            }
            let is_likely =
                first.iter().all(|face| self.is_on(*face, &surface)) && self.has_rows(&surface, &faces, &border);
            return is_likely.then(|| {
                let is_sure =
                    surface.kind == Kind::Plane || points.len() >= LEAST && self.ends(&surface, &points, &border);
                Patch { surface, faces, is_sure }
            });
        }
    }

    /// Whether a patch of a sphere or a torus has a face inside: through two circles there is always a sphere, through three a torus.
    fn has_rows(&self, surface: &FittedSurface, faces: &[u32], border: &[(u32, Option<u32>)]) -> bool {
        let rim: HashSet<u32> = border.iter().flat_map(|(edge, _)| self.edges.positions[*edge as usize]).collect();
        let is_inside = |face: &u32| self.mesh.triangles[*face as usize].iter().all(|corner| !rim.contains(corner));
        !matches!(surface.kind, Kind::Sphere | Kind::Torus) || faces.iter().any(is_inside)
    }

    /// Whether a patch ends where its surface does, along most of its border.
    fn ends(&self, surface: &FittedSurface, points: &[DVec3], border: &[(u32, Option<u32>)]) -> bool {
        let distance = |point: &DVec3| surface.at(*point).0.abs();
        let inside = points.iter().map(distance).sum::<f64>() / points.len() as f64;
        let beyond = border.iter().filter_map(|(_, face)| *face);
        let farthest: Vec<f64> =
            beyond.map(|face| self.corners(face).iter().map(distance).fold(0.0, f64::max)).collect();
        let ends = farthest.iter().filter(|distance| **distance > GAP * inside || **distance <= self.tolerance);
        2 * ends.count() >= farthest.len()
    }

    /// Surfaces through the vertices of a row, the likeliest last: between two circles there are many.
    fn surfaces(&self, row: &[u32; ROW]) -> Vec<FittedSurface> {
        let points = self.points(row);
        let mut normal = self.normal(row[ROW / 2]);
        let [low, high] = extent(points.iter().map(|point| (*point - points[0]).dot(normal)));
        let depth = high - low;
        let facets = row.map(|face| {
            let own = self.normal(face);
            normal = if own.dot(normal) < 0.0 { -own } else { own };
            (normal, self.corners(face).iter().sum::<DVec3>() / 3.0)
        });
        let is_near = |surface: &FittedSurface| {
            let [low, high] = extent(points.iter().map(|point| surface.at(*point).0));
            high - low <= SPREAD * depth
        };
        let guesses = FittedSurface::near(&facets).into_iter().flatten();
        let near = guesses.filter(|surface| depth >= DEPTH * self.tolerance && is_near(surface));
        near.filter_map(|surface| surface.fitted(&points, self.tolerance)).collect()
    }

    /// Tori through the circles of a row around a cone's axis and a vertex beyond the patch.
    fn tori(&self, row: &[u32; ROW], patch: &Patch) -> Vec<FittedSurface> {
        let edges = patch.faces.iter().flat_map(|face| self.edges_of[*face as usize]);
        let faces = edges.filter_map(|edge| self.smooth(edge)).flat_map(|(_, faces)| faces);
        let points = self.points(row);
        let mut tori: Vec<FittedSurface> = Vec::new();
        for point in faces.flat_map(|face| self.corners(face)) {
            let is_known = |surface: &FittedSurface| surface.at(point).0.abs() <= self.tolerance;
            if tori.len() < 2 && !is_known(&patch.surface) && !tori.iter().any(is_known) {
                let torus = patch.surface.torus(points.iter().copied().chain([point]));
                tori.extend(torus.filter(|torus| torus.sizes[0].abs() > self.tolerance));
            }
        }
        tori
    }

    /// The row that a section perpendicular to an edge crosses, three faces on each side, unless it ends before.
    fn row(&self, edge: u32) -> Option<[u32; ROW]> {
        let (_, sides) = self.smooth(edge).filter(|(turn, _)| *turn >= FLAT)?;
        let [from, to] = self.ends_of(edge);
        // Off the middle: sections from there run into corners.
        let height = |at: DVec3| (at - from.lerp(to, 0.493)).dot(to - from);
        let mut row = [NONE; ROW];
        for (side, mut face) in sides.into_iter().enumerate() {
            let mut entered = edge;
            for step in 0..ROW / 2 {
                let crosses = |edge: &u32| {
                    let [one, other] = self.ends_of(*edge).map(height);
                    (one < 0.0) != (other < 0.0)
                };
                if step > 0 {
                    let others =
                        self.edges_of[face as usize].into_iter().filter(|edge| *edge != entered && *edge != NONE);
                    entered = others.into_iter().find(crosses)?;
                    face = self.beyond(entered, face)?;
                }
                row[if side == 0 { ROW / 2 - 1 - step } else { ROW / 2 + step }] = face;
            }
        }
        Some(row)
    }

    /// The vertices of faces, each once.
    fn points(&self, faces: &[u32]) -> Vec<DVec3> {
        let mut corners: Vec<u32> = faces.iter().flat_map(|face| self.mesh.triangles[*face as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        corners.into_iter().map(|corner| self.mesh.positions[corner as usize]).collect()
    }

    pub(super) fn corners(&self, face: u32) -> [DVec3; 3] {
        self.mesh.triangles[face as usize].map(|corner| self.mesh.positions[corner as usize])
    }

    fn normal(&self, face: u32) -> DVec3 {
        DVec3::from_array(self.normals[face as usize])
    }

    pub(super) fn ends_of(&self, edge: u32) -> [DVec3; 2] {
        self.edges.positions[edge as usize].map(|number| self.mesh.positions[number as usize])
    }
}

/// The smallest and the largest of numbers.
fn extent(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], number| [low.min(number), high.max(number)])
}
