//! Cuts a mesh by a plane and closes the cut.
//!
//! In: a [`Mesh`] and a [`SectionPlane`]. Out: the faces behind the plane, and caps over the loops where they end at it. Faces that
//! the plane crosses are clipped; neighbours share the new vertices, so a closed mesh stays closed. Loops inside others are holes.

use super::{Curves, Mesh, NONE, NamedPart};
use crate::error::{Error, Result};
use crate::settings::{Kind, Problem, Value};
use crate::tolerances::ON_PLANE;
use earcut::Earcut;
use glam::{DVec2, DVec3};
use std::collections::{HashMap, HashSet};

/// The name of the part that holds the cut's faces.
pub const SECTION: &str = "section";

const NO_PLANE: &str = "its numbers must be finite, and its normal not 0";

const AXES: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];

/// A plane in world space: all points whose product with `normal` is `offset`. Everything with a larger product is cut away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPlane {
    /// Its normal, of any length above 0.
    pub normal: DVec3,
    /// The product of its points with the normal, file units.
    pub offset: f64,
}

impl Value for SectionPlane {
    fn kind() -> Kind {
        Kind::Text { offered: &["x=0", "y=0", "z=0"], example: "x=0" }
    }

    fn text(&self) -> String {
        let axis = AXES.iter().find(|(_, axis)| *axis == self.normal);
        let normal = axis.map_or_else(|| self.normal.text(), |(name, _)| (*name).to_owned());
        format!("{normal}={}", self.offset)
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        let problem = || "write an axis and where it is cut, such as x=12, or a normal and a number, such as 1,1,0=5";
        let (normal, offset) = text.split_once('=').ok_or_else(|| problem().to_owned())?;
        let axis = AXES.iter().find(|(name, _)| *name == normal.trim());
        let normal = match axis {
            Some((_, axis)) => *axis,
            None => DVec3::parse(normal.trim()).map_err(|_| problem().to_owned())?,
        };
        let offset: f64 = offset.trim().parse().map_err(|_| problem().to_owned())?;
        let plane = Self { normal, offset };
        if plane.unit().is_none() {
            return Err(NO_PLANE.to_owned().into());
        }
        Ok(plane)
    }
}

impl SectionPlane {
    /// The same plane with a normal of length 1; `None` if its numbers give no plane.
    fn unit(&self) -> Option<Self> {
        let length = self.normal.length();
        let unit = Self { normal: self.normal / length, offset: self.offset / length };
        (unit.normal.is_finite() && unit.offset.is_finite()).then_some(unit)
    }
}

/// How a plane cut a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// The whole mesh lies behind the plane.
    Missed,
    /// Caps close all of the cut.
    Closed,
    /// The surface is open or winds both ways, and part of the cut has no cap.
    Open,
}

impl Mesh {
    /// Cuts away the mesh in front of a plane, and closes the cut with faces of the part [`SECTION`].
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] if the plane is none, or leaves nothing.
    pub fn section(self, plane: &SectionPlane) -> Result<(Self, Cut)> {
        let Some(unit) = plane.unit() else {
            return Err(Error::setting("section", NO_PLANE));
        };
        let (low, high) = self.extent();
        let tolerance = (high - low).length() * ON_PLANE;
        let side = |point: &DVec3| {
            let distance = unit.normal.dot(*point) - unit.offset;
            if distance.abs() <= tolerance { 0.0 } else { distance }
        };
        let sides: Vec<f64> = self.positions.iter().map(side).collect();
        let of_curves: Vec<f64> = self.curves.positions.iter().map(side).collect();
        if sides.iter().chain(&of_curves).all(|side| *side <= 0.0) {
            return Ok((self, Cut::Missed));
        }
        let name = self.name.clone();
        let mut cutter = Cutter::new(&self, sides);
        cutter.clip_faces(unit.normal);
        let is_closed = cutter.close(unit.normal);
        let curves = clipped(&self.curves, &of_curves, cutter.next_vertex);
        let mesh = cutter.finished(&self, curves);
        if mesh.triangles.is_empty() && mesh.curves.is_empty() {
            let problem = format!("{name} lies wholly in front of the plane, which cuts it away; move the plane");
            return Err(Error::value("section", plane.text(), problem));
        }
        Ok((mesh, if is_closed { Cut::Closed } else { Cut::Open }))
    }
}

/// A mesh being cut: its old vertices and faces, and the new ones.
struct Cutter {
    mesh: Mesh,
    /// For each position its distance in front of the plane.
    sides: Vec<f64>,
    /// The new position on each edge that the plane crosses.
    on_edges: HashMap<[u32; 2], u32>,
    /// The new normals and texture coordinates on such edges, each between two of its kind.
    normals_on_edges: HashMap<[u32; 3], u32>,
    coordinates_on_edges: HashMap<[u32; 3], u32>,
    /// The next free vertex and face number of the file.
    next_vertex: u32,
    next_face: u32,
    /// The faces kept, each with the face of the mesh that it is or is cut from.
    faces: Vec<Face>,
}

/// A kept face.
#[derive(Clone, Copy)]
struct Face {
    positions: [u32; 3],
    normals: [u32; 3],
    coordinates: [u32; 3],
    /// The face of the mesh; for a cap one whose material it takes.
    from: u32,
    /// The cap's number among the file's faces.
    cap: Option<u32>,
}

/// A corner of a face: position, normal, texture coordinate.
type Corner = [u32; 3];

impl Cutter {
    fn new(mesh: &Mesh, sides: Vec<f64>) -> Self {
        let highest = |numbers: &[u32]| numbers.iter().max().map_or(0, |highest| highest + 1);
        Self {
            next_vertex: highest(&mesh.file_vertices).max(highest(&mesh.curves.file_vertices)),
            next_face: highest(&mesh.file_faces).max(mesh.triangles.len() as u32),
            mesh: mesh.clone(),
            sides,
            on_edges: HashMap::new(),
            normals_on_edges: HashMap::new(),
            coordinates_on_edges: HashMap::new(),
            faces: Vec::new(),
        }
    }

    /// Keeps the faces behind the plane, and the parts behind it of those that it crosses. Of the faces in it those stay that look
    /// to its front: they close the solid behind it.
    fn clip_faces(&mut self, normal: DVec3) {
        for face in 0..self.mesh.triangles.len() {
            let positions = self.mesh.triangles[face];
            let normals = self.mesh.triangle_normals.get(face).copied().unwrap_or([NONE; 3]);
            let coordinates = self.mesh.triangle_texture_coordinates.get(face).copied().unwrap_or([NONE; 3]);
            let corners: [Corner; 3] = [0, 1, 2].map(|at| [positions[at], normals[at], coordinates[at]]);
            let sides = positions.map(|position| self.sides[position as usize]);
            let is_in_plane = sides.iter().all(|side| *side == 0.0);
            let looks_to_front = || {
                let [a, b, c] = positions.map(|position| self.mesh.positions[position as usize]);
                (b - a).cross(c - a).dot(normal) > 0.0
            };
            let mut kept: Vec<Corner> = Vec::with_capacity(4);
            if is_in_plane {
                if looks_to_front() {
                    kept.extend(corners);
                }
            } else if sides.iter().any(|side| *side < 0.0) {
                for at in 0..3 {
                    let next = (at + 1) % 3;
                    if sides[at] <= 0.0 {
                        kept.push(corners[at]);
                    }
                    if sides[at] * sides[next] < 0.0 {
                        kept.push(self.between(corners[at], corners[next]));
                    }
                }
            }
            for last in 2..kept.len() {
                let [a, b, c] = [kept[0], kept[last - 1], kept[last]];
                let of = |kind: usize| [a[kind], b[kind], c[kind]];
                let (positions, normals, coordinates) = (of(0), of(1), of(2));
                self.faces.push(Face { positions, normals, coordinates, from: face as u32, cap: None });
            }
        }
    }

    /// The corner where the plane crosses a side, whichever way the side runs.
    fn between(&mut self, first: Corner, second: Corner) -> Corner {
        let [low, high] = if first[0] < second[0] { [first, second] } else { [second, first] };
        let mesh = &mut self.mesh;
        let [low_side, high_side] = [low, high].map(|corner| self.sides[corner[0] as usize]);
        let share = low_side / (low_side - high_side);
        let position = *self.on_edges.entry([low[0], high[0]]).or_insert_with(|| {
            let [a, b] = [low, high].map(|corner| mesh.positions[corner[0] as usize]);
            mesh.positions.push(a.lerp(b, share));
            mesh.file_vertices.push(self.next_vertex);
            self.next_vertex += 1;
            self.sides.push(0.0);
            if !mesh.position_colors.is_empty() {
                let [a, b] = [low, high].map(|corner| mesh.position_colors[corner[0] as usize]);
                mesh.position_colors.push([0, 1, 2].map(|at| a[at] + (b[at] - a[at]) * share as f32));
            }
            mesh.positions.len() as u32 - 1
        });
        let normal = if low[1] == NONE || high[1] == NONE {
            NONE
        } else {
            *self.normals_on_edges.entry([position, low[1], high[1]]).or_insert_with(|| {
                let [a, b] = [low, high].map(|corner| mesh.normals[corner[1] as usize]);
                mesh.normals.push(a.lerp(b, share as f32).try_normalize().unwrap_or(a));
                mesh.normals.len() as u32 - 1
            })
        };
        let coordinate = if low[2] == NONE || high[2] == NONE {
            NONE
        } else {
            *self.coordinates_on_edges.entry([position, low[2], high[2]]).or_insert_with(|| {
                let [a, b] = [low, high].map(|corner| mesh.texture_coordinates[corner[2] as usize]);
                mesh.texture_coordinates.push(a.lerp(b, share as f32));
                mesh.texture_coordinates.len() as u32 - 1
            })
        };
        [position, normal, coordinate]
    }

    /// Adds the caps; returns whether they close the whole cut.
    fn close(&mut self, normal: DVec3) -> bool {
        let mut open: HashMap<[u32; 2], u32> = HashMap::new();
        let mut order = Vec::new();
        for face in &self.faces {
            let [a, b, c] = face.positions;
            for [from, to] in [[a, b], [b, c], [c, a]] {
                // Sides of the surface in the plane; those that two faces share need no cap.
                if [from, to].iter().all(|end| self.sides[*end as usize] == 0.0) && open.remove(&[to, from]).is_none() {
                    open.insert([from, to], face.from);
                    order.push([from, to]);
                }
            }
        }
        // A cap runs along the sides the other way.
        let mut used = HashSet::new();
        let sides = order.into_iter().filter(|side| open.contains_key(side) && used.insert(*side));
        let sides: Vec<[u32; 2]> = sides.map(|[from, to]| [to, from]).collect();
        let (loops, mut is_closed) = loops(&sides);
        let across = normal.any_orthonormal_vector();
        let up = normal.cross(across);
        let origin = loops.first().map_or(DVec3::ZERO, |first| self.mesh.positions[first[0] as usize]);
        let in_plane = |position: u32| {
            let point = self.mesh.positions[position as usize] - origin;
            DVec2::new(point.dot(across), point.dot(up))
        };
        let planes: Vec<Vec<DVec2>> =
            loops.iter().map(|ring| ring.iter().map(|position| in_plane(*position)).collect()).collect();
        let mut caps = Vec::new();
        let nested = nested(&planes);
        is_closed &= nested.iter().map(|(_, holes)| 1 + holes.len()).sum::<usize>() == loops.len();
        for (outer, holes) in nested {
            let rings: Vec<&Vec<u32>> = [outer].iter().chain(&holes).map(|ring| &loops[*ring]).collect();
            let points: Vec<&Vec<DVec2>> = [outer].iter().chain(&holes).map(|ring| &planes[*ring]).collect();
            match cap(&rings, &points) {
                Some(triangles) => caps.push((triangles, [loops[outer][1], loops[outer][0]])),
                None => is_closed = false,
            }
        }
        if caps.is_empty() {
            return is_closed;
        }
        let number = self.mesh.normals.len() as u32;
        self.mesh.normals.push(normal.as_vec3());
        for (triangles, side) in caps {
            let (cap, from) = (Some(self.next_face), open.get(&side).copied().unwrap_or(0));
            self.next_face += 1;
            for positions in triangles {
                self.faces.push(Face { positions, normals: [number; 3], coordinates: [NONE; 3], from, cap });
            }
        }
        self.mesh.marked.extend(sides.iter().map(|[a, b]| [*a.min(b), *a.max(b)]));
        is_closed
    }

    /// The mesh of the faces kept.
    fn finished(self, old: &Mesh, curves: Curves) -> Mesh {
        let Self { mut mesh, faces, on_edges, sides, .. } = self;
        let mut number = vec![NONE; mesh.positions.len()];
        faces.iter().flat_map(|face| face.positions).for_each(|position| number[position as usize] = 0);
        let kept: Vec<u32> = (0..number.len() as u32).filter(|position| number[*position as usize] == 0).collect();
        kept.iter().enumerate().for_each(|(at, position)| number[*position as usize] = at as u32);
        let behind = |position: u32| sides[position as usize] <= 0.0;
        let marked = mesh.marked.iter().filter_map(|[a, b]| match on_edges.get(&[*a, *b]) {
            Some(middle) => Some([if behind(*a) { *a } else { *b }, *middle]),
            None => (behind(*a) && behind(*b)).then_some([*a, *b]),
        });
        let marked = marked.map(|ends| ends.map(|end| number[end as usize])).filter(|ends| !ends.contains(&NONE));
        let mut marked: Vec<[u32; 2]> = marked.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        marked.sort_unstable();
        marked.dedup();
        let cap_part = mesh.parts.len() as u32;
        let has_caps = faces.iter().any(|face| face.cap.is_some());
        if has_caps {
            mesh.parts.push(NamedPart { name: SECTION.to_owned(), within: NONE });
        }
        let of = |list: &[u32], face: &Face| list.get(face.from as usize).copied().unwrap_or(NONE);
        let lists = |list: &[u32], is_needed: bool, cap: Option<u32>| -> Vec<u32> {
            let value = |face: &Face| cap.filter(|_| face.cap.is_some()).unwrap_or_else(|| of(list, face));
            if is_needed { faces.iter().map(value).collect() } else { Vec::new() }
        };
        let has_coordinates = !old.triangle_texture_coordinates.is_empty();
        let color = |position: &u32| mesh.position_colors.get(*position as usize).copied();
        Mesh {
            position_colors: kept.iter().filter_map(color).collect(),
            file_vertices: kept.iter().map(|position| mesh.file_vertices[*position as usize]).collect(),
            triangle_materials: lists(&old.triangle_materials, !old.triangle_materials.is_empty(), None),
            triangle_parts: lists(&old.triangle_parts, has_caps || !old.triangle_parts.is_empty(), Some(cap_part)),
            file_faces: faces.iter().map(|face| face.cap.unwrap_or_else(|| old.file_face(face.from))).collect(),
            triangles: faces.iter().map(|face| face.positions.map(|position| number[position as usize])).collect(),
            triangle_normals: faces.iter().map(|face| face.normals).collect(),
            triangle_texture_coordinates: match has_coordinates {
                true => faces.iter().map(|face| face.coordinates).collect(),
                false => Vec::new(),
            },
            positions: kept.iter().map(|position| mesh.positions[*position as usize]).collect(),
            marked,
            curves,
            ..mesh
        }
    }
}

/// Joins sides into closed loops that pass no vertex twice; returns whether no side is left over.
fn loops(sides: &[[u32; 2]]) -> (Vec<Vec<u32>>, bool) {
    let mut after: HashMap<u32, Vec<u32>> = HashMap::new();
    sides.iter().rev().for_each(|[from, to]| after.entry(*from).or_default().push(*to));
    let (mut loops, mut is_closed) = (Vec::new(), true);
    for [start, _] in sides {
        let mut path = vec![*start];
        let mut places = HashMap::from([(*start, 0)]);
        while let Some(next) = after.get_mut(&path[path.len() - 1]).and_then(Vec::pop) {
            if let Some(place) = places.get(&next).copied() {
                let ring: Vec<u32> = path.drain(place..).collect();
                ring.iter().for_each(|vertex| {
                    places.remove(vertex);
                });
                loops.push(ring);
            }
            places.insert(next, path.len());
            path.push(next);
        }
        is_closed &= path.len() == 1;
    }
    (loops, is_closed)
}

/// Twice a loop's area, positive counter-clockwise.
fn area(ring: &[DVec2]) -> f64 {
    (1..ring.len().saturating_sub(1)).map(|at| (ring[at] - ring[0]).perp_dot(ring[at + 1] - ring[0])).sum()
}

/// Whether a loop goes around a point.
fn encloses(ring: &[DVec2], point: DVec2) -> bool {
    let crosses = |at: &usize| {
        let (a, b) = (ring[*at] - point, ring[(at + 1) % ring.len()] - point);
        (a.y > 0.0) != (b.y > 0.0) && (a.perp_dot(b) > 0.0) == (b.y > a.y)
    };
    (0..ring.len()).filter(crosses).count() % 2 == 1
}

/// The counter-clockwise loops, each with its holes: the clockwise loops that no smaller one encloses.
fn nested(rings: &[Vec<DVec2>]) -> Vec<(usize, Vec<usize>)> {
    let areas: Vec<f64> = rings.iter().map(|ring| area(ring)).collect();
    let mut nested: Vec<(usize, Vec<usize>)> =
        (0..rings.len()).filter(|ring| areas[*ring] > 0.0).map(|ring| (ring, Vec::new())).collect();
    for hole in (0..rings.len()).filter(|ring| areas[*ring] <= 0.0) {
        // Between two vertices, where no loop that touches this one in a vertex is met.
        let inner = (rings[hole][0] + rings[hole][1]) * 0.5;
        let around =
            nested.iter_mut().filter(|(outer, _)| areas[*outer] > -areas[hole] && encloses(&rings[*outer], inner));
        if let Some((_, holes)) = around.min_by(|a, b| areas[a.0].total_cmp(&areas[b.0])) {
            holes.push(hole);
        }
    }
    nested
}

/// Triangles over an outer loop and its holes that use every side of them; `None` if that fails.
fn cap(rings: &[&Vec<u32>], points: &[&Vec<DVec2>]) -> Option<Vec<[u32; 3]>> {
    let positions: Vec<u32> = rings.iter().flat_map(|ring| ring.iter().copied()).collect();
    let starts: Vec<u32> = rings
        .iter()
        .scan(0, |sum, ring| {
            *sum += ring.len() as u32;
            Some(*sum)
        })
        .collect();
    let mut indices: Vec<u32> = Vec::new();
    let corners = points.iter().flat_map(|ring| ring.iter().map(|point| point.to_array()));
    Earcut::new().earcut(corners, &starts[..starts.len() - 1], &mut indices);
    let next: HashMap<u32, u32> =
        rings.iter().flat_map(|ring| (0..ring.len()).map(|at| (ring[at], ring[(at + 1) % ring.len()]))).collect();
    let mut triangles: Vec<[u32; 3]> =
        indices.chunks_exact(3).map(|it| [0, 1, 2].map(|at| positions[it[at] as usize])).collect();
    let flat: HashMap<u32, DVec2> =
        positions.iter().copied().zip(points.iter().flat_map(|ring| ring.iter().copied())).collect();
    // All turn one way, slivers too, whose own areas may round to the other sign.
    if triangles.iter().map(|triangle| area(&triangle.map(|corner| flat[&corner]))).sum::<f64>() < 0.0 {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    // earcut drops corners in line with their neighbours; each goes back into the triangle along whose side it lies.
    let mut all: HashSet<[u32; 2]> = triangles.iter().flat_map(sides_of).collect();
    let mut waiting = triangles;
    let mut done = Vec::new();
    while let Some(triangle) = waiting.pop() {
        let skipping = (0..3).find(|at| {
            let [from, to] = [triangle[*at], triangle[(at + 1) % 3]];
            next.get(&from) != Some(&to) && !all.contains(&[to, from]) && is_along(&next, from, to)
        });
        match skipping {
            None => done.push(triangle),
            Some(at) => {
                let [from, to, opposite] = [0, 1, 2].map(|it| triangle[(at + it) % 3]);
                let mut corner = from;
                while corner != to {
                    // The first and last of these keep a side of the triangle, which may skip corners too.
                    let part = [corner, next[&corner], opposite];
                    all.extend(sides_of(&part));
                    waiting.push(part);
                    corner = next[&corner];
                }
            }
        }
    }
    let mut left: HashSet<[u32; 2]> = HashSet::new();
    for side in done.iter().flat_map(sides_of) {
        if !left.remove(&[side[1], side[0]]) && !left.insert(side) {
            return None;
        }
    }
    (left.len() == next.len() && next.iter().all(|(from, to)| left.contains(&[*from, *to]))).then_some(done)
}

/// Whether the loop of a corner leads to another.
fn is_along(next: &HashMap<u32, u32>, from: u32, to: u32) -> bool {
    let mut corner = from;
    while let Some(after) = next.get(&corner).filter(|after| **after != from) {
        corner = *after;
        if corner == to {
            return true;
        }
    }
    false
}

/// The sides of a triangle, each from corner to corner.
fn sides_of(triangle: &[u32; 3]) -> [[u32; 2]; 3] {
    let [a, b, c] = *triangle;
    [[a, b], [b, c], [c, a]]
}

/// The curves and points behind the plane.
fn clipped(curves: &Curves, sides: &[f64], mut next_vertex: u32) -> Curves {
    let mut kept = Curves { segments: Vec::new(), points: Vec::new(), labels: Vec::new(), ..curves.clone() };
    for [a, b] in &curves.segments {
        let [side_a, side_b] = [a, b].map(|end| sides[*end as usize]);
        if side_a <= 0.0 && side_b <= 0.0 {
            kept.segments.push([*a, *b]);
        } else if side_a * side_b < 0.0 {
            let [first, second] = [a, b].map(|end| curves.positions[*end as usize]);
            kept.positions.push(first.lerp(second, side_a / (side_a - side_b)));
            kept.file_vertices.push(next_vertex);
            next_vertex += 1;
            let middle = kept.positions.len() as u32 - 1;
            kept.segments.push(if side_a < 0.0 { [*a, middle] } else { [middle, *b] });
        }
    }
    for (number, point) in curves.points.iter().enumerate().filter(|(_, point)| sides[**point as usize] <= 0.0) {
        let texts = curves.labels.iter().filter(|(of, _)| *of == number as u32);
        kept.labels.extend(texts.map(|(_, text)| (kept.points.len() as u32, text.clone())));
        kept.points.push(*point);
    }
    // Only the positions still used: the camera frames them all.
    let mut number = vec![NONE; kept.positions.len()];
    let mut positions = Vec::new();
    let mut file_vertices = Vec::new();
    for end in kept.segments.as_flattened_mut().iter_mut().chain(&mut kept.points) {
        let slot = &mut number[*end as usize];
        if *slot == NONE {
            *slot = positions.len() as u32;
            positions.push(kept.positions[*end as usize]);
            file_vertices.push(kept.file_vertices[*end as usize]);
        }
        *end = *slot;
    }
    Curves { positions, file_vertices, ..kept }
}
