//! Patches of a mesh that lie on fitted surfaces.
//!
//! In: a [`Mesh`], its [`EdgeList`], the faces' normals. Out: [`Patches`]. Only vertices lie on the true surface. So a section across each
//! edge gives rows of six faces, a surface is fitted to their vertices, and the patch grows over smooth edges to the faces whose
//! vertices it passes through. Through two circles there are always a cone and a sphere; if a torus passes through the next circles
//! too, the patch is that. Of overlapping patches the largest stays. Faces beside them form planes.

use super::fitted_surfaces::{FLAT, FittedSurface, Kind};
use super::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::threads::in_parallel;
use crate::tolerances::PRINTED_DIGITS;
use glam::DVec3;
use std::collections::HashSet;

/// Faces of a row: three quadrilaterals.
const ROW: usize = 6;

/// Least depth of a row, in tolerances: a shallower one is flat within rounding.
const DEPTH: f64 = 4.0;

/// Largest spread of a row's vertices around the surface that its faces suggest, as a share of the depth.
const SPREAD: f64 = 0.3;

/// Least lines or circles on which a patch's vertices lie: four that mirror each other always have a common circle.
const LEAST: usize = 5;

/// Most faces of all patches tried, as a multiple of the mesh's.
const MOST: usize = 32;

/// A fitted surface and its faces.
pub(crate) struct Patch {
    pub surface: FittedSurface,
    pub faces: Vec<u32>,
    /// Whether it lies on more circles than those through which there are always others.
    is_likely: bool,
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

    /// Whether a face's vertices are those of a surface. A plane that touches a torus has faces with all corners there.
    fn is_on(&self, face: u32, surface: &FittedSurface) -> bool {
        let corners = self.corners(face).map(|corner| surface.at(corner));
        let turns = corners.iter().any(|(_, normal)| normal.cross(corners[0].1).length() > FLAT);
        corners.iter().all(|(distance, _)| distance.abs() <= self.tolerance) && (turns || surface.kind != Kind::Torus)
    }

    fn add(&mut self, patch: Patch) {
        patch.faces.iter().for_each(|face| self.of_faces[*face as usize] = self.all.len() as u32);
        self.all.push(patch);
    }

    /// Adds the planes beside other patches.
    fn add_planes(&mut self) {
        let is_free = |face: &u32| self.of_faces[*face as usize] == NONE;
        let smooth = (0..self.edges.len() as u32).filter_map(|edge| self.smooth(edge));
        let ends = smooth.filter(|(_, faces)| !faces.iter().all(is_free));
        let beside: Vec<u32> = ends.flat_map(|(_, faces)| faces).filter(is_free).collect();
        let taken = self.of_faces.iter().map(|patch| *patch != NONE).collect();
        let mut growth = Growth { taken, left: MOST * self.of_faces.len() };
        for face in beside {
            let [point, ..] = self.corners(face);
            let plane = FittedSurface { kind: Kind::Plane, point, axis: self.normal(face), sizes: [0.0; 2] };
            if self.of_faces[face as usize] == NONE
                && let Some(patch) = self.grown(&[face], plane, &mut growth)
            {
                patch.faces.iter().for_each(|face| growth.taken[*face as usize] = true);
                self.add(patch);
            }
        }
    }

    /// The patches that grow from rows of faces. They may overlap.
    fn round(&self, rows: &[[u32; ROW]]) -> Vec<Patch> {
        let mut found: Vec<Patch> = Vec::new();
        let mut largest = vec![NONE; self.of_faces.len()];
        // Through two circles there is always a sphere: a row of each need not try it.
        let mut unlikely: Vec<Option<FittedSurface>> = vec![None; self.of_faces.len()];
        let mut growth = Growth { taken: vec![false; self.of_faces.len()], left: MOST * self.of_faces.len() };
        for row in rows {
            let is_on = |surface: &FittedSurface| row.iter().all(|face| self.is_on(*face, surface));
            let known = row.map(|face| largest[face as usize]).into_iter().filter(|patch| *patch != NONE);
            if known.into_iter().any(|patch| is_on(&found[patch as usize].surface)) {
                continue;
            }
            let mut surfaces = self.surfaces(row);
            let mut count = 0;
            while let Some(surface) = surfaces.pop() {
                let is_sphere = surface.kind == Kind::Sphere;
                if is_sphere && row.iter().any(|face| unlikely[*face as usize].as_ref().is_some_and(is_on)) {
                    continue;
                }
                let Some(patch) = self.grown(row, surface, &mut growth) else { continue };
                if is_sphere && !patch.is_likely {
                    patch.faces.iter().for_each(|face| unlikely[*face as usize] = Some(patch.surface));
                }
                if !patch.is_likely || patch.faces.len() <= count {
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
        found.retain(|patch| patch.surface.lines(&self.points(&patch.faces)) >= LEAST);
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
                    match self.beyond(edge, faces[next]) {
                        Some(face) if growth.taken[face as usize] => {}
                        Some(face) if self.is_on(face, &surface) => {
                            growth.taken[face as usize] = true;
                            faces.push(face);
                        }
                        _ => border.push(edge),
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
            let is_likely = match surface.kind {
                Kind::Sphere => self.has_inside(&faces, &border),
                Kind::Torus => surface.lines(&points) >= LEAST,
                _ => true,
            };
            let has_first = first.iter().all(|face| self.is_on(*face, &surface));
            return has_first.then_some(Patch { surface, faces, is_likely });
        }
    }

    /// Whether a face within the border has no corner on it.
    fn has_inside(&self, faces: &[u32], border: &[u32]) -> bool {
        let rim: HashSet<u32> = border.iter().flat_map(|edge| self.edges.positions[*edge as usize]).collect();
        let is_inside = |face: &u32| self.mesh.triangles[*face as usize].iter().all(|corner| !rim.contains(corner));
        faces.iter().any(is_inside)
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
        let guesses = FittedSurface::near(&facets).filter(|_| depth >= DEPTH * self.tolerance);
        let near = guesses.into_iter().flatten().filter(is_near);
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
                tori.push(patch.surface.torus(points.iter().copied().chain([point])));
            }
        }
        tori
    }

    /// The row across an edge, three faces on each side, unless it ends before. Two triangles in one plane are left at the side opposite
    /// to the one where they are entered, because a section leaves a narrow ring. Others follow a section perpendicular to the edge.
    fn row(&self, edge: u32) -> Option<[u32; ROW]> {
        let (_, sides) = self.smooth(edge).filter(|(turn, _)| *turn >= FLAT)?;
        let [from, to] = self.ends_of(edge);
        // Off the middle: sections from there run into corners.
        let height = |at: DVec3| (at - from.lerp(to, 0.493)).dot(to - from);
        let crosses = |edge: &u32| {
            let [one, other] = self.ends_of(*edge).map(height);
            (one < 0.0) != (other < 0.0)
        };
        let is_flat = |edge: &u32| self.smooth(*edge).is_some_and(|(turn, _)| turn < FLAT);
        let mut row = [NONE; ROW];
        for (side, mut face) in sides.into_iter().enumerate() {
            // The edges by which the face and its plane are entered.
            let [mut entered, mut first] = [edge; 2];
            for step in 0..ROW / 2 {
                if step > 0 {
                    let others =
                        self.edges_of[face as usize].into_iter().filter(|edge| ![entered, NONE].contains(edge));
                    let is_opposite = |edge: &u32| {
                        let ends = self.edges.positions[first as usize];
                        !self.edges.positions[*edge as usize].iter().any(|end| ends.contains(end))
                    };
                    let next = match is_flat(&entered) {
                        true => others.clone().find(is_opposite),
                        false => others.clone().find(is_flat),
                    };
                    entered = next.or_else(|| others.clone().find(crosses))?;
                    if !is_flat(&entered) {
                        first = entered;
                    }
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
