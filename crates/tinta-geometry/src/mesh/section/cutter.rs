//! A mesh being cut: the faces behind the plane, whole or clipped, and the caps that close them.

use super::caps::{self, Cap};
use super::hatching::{self, upright};
use crate::mesh::{Curves, Mesh, NONE, NamedPart, PatternMatches, Shells};
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, HashMap};

/// The name of the part that holds the cut's faces.
pub const SECTION: &str = "section";

/// A mesh being cut: its old vertices and faces, and the new ones.
#[derive(Default)]
pub(super) struct Cutter {
    mesh: Mesh,
    /// For each position its distance in front of the plane.
    sides: Vec<f64>,
    /// The new position on each edge that the plane crosses.
    on_edges: HashMap<[u32; 2], u32>,
    /// The new normals and texture coordinates on such edges, each between two of its kind.
    normals_on_edges: HashMap<[u32; 3], u32>,
    coordinates_on_edges: HashMap<[u32; 3], u32>,
    /// The next free vertex and face number of the file.
    pub(super) next_vertex: u32,
    next_face: u32,
    /// For each face of the mesh its solid, and whether its front is outside.
    solids: Vec<u32>,
    is_outside: Vec<bool>,
    /// For each face of the mesh whether it is of a part that is left whole.
    pub(super) is_whole: Vec<bool>,
    /// The faces kept, each with the face of the mesh that it is or is cut from.
    faces: Vec<Face>,
    /// Whether the parts in front are kept, too.
    keeps_front: bool,
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

/// A side in the plane at which a solid is open, and the face of the mesh that ends there.
#[derive(Clone, Copy)]
pub(super) struct OpenSide {
    pub(super) ends: [u32; 2],
    pub(super) from: u32,
}

/// A corner of a face: position, normal, texture coordinate.
type Corner = [u32; 3];

impl Cutter {
    pub(super) fn new(mesh: &Mesh, sides: Vec<f64>, uncut: &[(PatternMatches, bool)], keeps_front: bool) -> Self {
        let highest = |numbers: &[u32]| numbers.iter().max().map_or(0, |highest| highest + 1);
        let count = mesh.triangles.len();
        let shells = Shells::of(mesh);
        let is_whole = |face: usize| {
            let key = mesh.part_and_material(face);
            uncut.iter().find(|(named, _)| named.holds(key)).is_some_and(|(_, is_whole)| *is_whole)
        };
        Self {
            next_vertex: highest(&mesh.file_vertices).max(highest(&mesh.curves.file_vertices)),
            next_face: if mesh.file_faces.is_empty() { count as u32 } else { highest(&mesh.file_faces) },
            solids: shells.solids(count),
            is_outside: shells.fronts_outside(count),
            is_whole: (0..count).map(is_whole).collect(),
            mesh: mesh.clone(),
            sides,
            keeps_front,
            ..Self::default()
        }
    }

    /// Keeps the faces behind the plane, and the parts behind it of those that it crosses; all parts if those in front are kept. Of the faces in it those stay that look
    /// to its front: they close the solid behind it.
    pub(super) fn clip_faces(&mut self, normal: DVec3) {
        for face in 0..self.mesh.triangles.len() {
            if self.is_whole[face] {
                self.keep_whole(face);
                continue;
            }
            let positions = self.mesh.triangles[face];
            let normals = self.mesh.triangle_normals.get(face).copied().unwrap_or([NONE; 3]);
            let coordinates = self.mesh.triangle_texture_coordinates.get(face).copied().unwrap_or([NONE; 3]);
            let corners: [Corner; 3] = [0, 1, 2].map(|at| [positions[at], normals[at], coordinates[at]]);
            let sides = positions.map(|position| self.sides[position as usize]);
            let is_in_plane = sides.iter().all(|side| *side == 0.0);
            if is_in_plane {
                if self.keeps_front || self.looks_to(face, normal) {
                    self.keep(face, &corners);
                }
                continue;
            }
            let ways: &[f64] = if self.keeps_front { &[1.0, -1.0] } else { &[1.0] };
            for sides in ways.iter().map(|way| sides.map(|side| side * way)) {
                if sides.iter().all(|side| *side >= 0.0) {
                    continue;
                }
                let mut kept: Vec<Corner> = Vec::with_capacity(4);
                for at in 0..3 {
                    let next = (at + 1) % 3;
                    if sides[at] <= 0.0 {
                        kept.push(corners[at]);
                    }
                    if sides[at] * sides[next] < 0.0 {
                        kept.push(self.between(corners[at], corners[next]));
                    }
                }
                self.keep(face, &kept);
            }
        }
    }

    /// Whether a face's outside looks the way of a normal.
    pub(super) fn looks_to(&self, face: usize, normal: DVec3) -> bool {
        let [a, b, c] = self.corners(face).map(|corner| self.position(corner));
        ((b - a).cross(c - a).dot(normal) > 0.0) == self.is_outside[face]
    }

    pub(super) fn face_count(&self) -> usize {
        self.mesh.triangles.len()
    }

    pub(super) fn corners(&self, face: usize) -> [u32; 3] {
        self.mesh.triangles[face]
    }

    pub(super) fn position(&self, number: u32) -> DVec3 {
        self.mesh.positions[number as usize]
    }

    /// Adds a position in a plane.
    pub(super) fn add_position(&mut self, position: DVec3) -> u32 {
        self.mesh.positions.push(position);
        self.mesh.file_vertices.push(self.next_vertex);
        self.next_vertex += 1;
        self.sides.push(0.0);
        if !self.mesh.position_colors.is_empty() {
            self.mesh.position_colors.push([1.0; 3]);
        }
        self.mesh.positions.len() as u32 - 1
    }

    /// Keeps a face as it is.
    pub(super) fn keep_whole(&mut self, face: usize) {
        let mesh = &self.mesh;
        let positions = mesh.triangles[face];
        let normals = mesh.triangle_normals.get(face).copied().unwrap_or([NONE; 3]);
        let coordinates = mesh.triangle_texture_coordinates.get(face).copied().unwrap_or([NONE; 3]);
        self.faces.push(Face { positions, normals, coordinates, from: face as u32, cap: None });
    }

    /// Keeps a convex polygon of a face.
    fn keep(&mut self, face: usize, corners: &[Corner]) {
        for last in 2..corners.len() {
            let [a, b, c] = [corners[0], corners[last - 1], corners[last]];
            let of = |kind: usize| [a[kind], b[kind], c[kind]];
            let (positions, normals, coordinates) = (of(0), of(1), of(2));
            self.faces.push(Face { positions, normals, coordinates, from: face as u32, cap: None });
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
                // Averaged normals are shorter than 1.
                let length = a.length() + (b.length() - a.length()) * share as f32;
                mesh.normals.push(a.lerp(b, share as f32).try_normalize().map_or(a, |normal| normal * length));
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

    /// Adds the caps; returns whether they close the whole cut, and the strokes that hatch it at this spacing, 0 for none.
    pub(super) fn close(
        &mut self,
        open: BTreeMap<u32, Vec<OpenSide>>,
        normal: DVec3,
        spacing: f64,
    ) -> (bool, Vec<[DVec3; 2]>) {
        // Strokes rise to the right where the cut stands upright.
        let [up, across] = upright(normal);
        let mut is_closed = true;
        let mut strokes = Vec::new();
        for (number, (_, sides)) in open.into_iter().enumerate() {
            let origin = self.mesh.positions[sides[0].ends[0] as usize];
            let in_plane = |position: u32| {
                let point = self.mesh.positions[position as usize] - origin;
                DVec2::new(point.dot(across), point.dot(up))
            };
            let ends: Vec<[u32; 2]> = sides.iter().map(|side| side.ends).collect();
            let (caps, is_whole) = caps::over(&ends, in_plane);
            is_closed &= is_whole;
            if caps.is_empty() {
                continue;
            }
            if spacing > 0.0 {
                let sides = ends.iter().map(|ends| ends.map(|end| self.mesh.positions[end as usize]));
                strokes.extend(hatching::strokes(sides, [across, up], spacing, number));
            }
            self.mesh.marked.extend(ends.iter().map(|[a, b]| [*a.min(b), *a.max(b)]));
            let from: HashMap<[u32; 2], u32> = sides.iter().map(|side| (side.ends, side.from)).collect();
            for cap in caps {
                self.add_cap(&cap, from.get(&cap.side).copied().unwrap_or(0), normal);
            }
        }
        (is_closed, strokes)
    }

    /// The sides in the plane at which each solid is open, the way its caps run along them: with the solid at their left, seen from
    /// the plane's front. Faces of no solid come last.
    pub(super) fn open_sides(&self) -> BTreeMap<u32, Vec<OpenSide>> {
        let mut open: HashMap<(u32, [u32; 2]), Vec<u32>> = HashMap::new();
        let mut order = Vec::new();
        for face in self.faces.iter().filter(|face| !self.is_whole[face.from as usize]) {
            let [a, b, c] = face.positions;
            let (solid, is_outside) = (self.solids[face.from as usize], self.is_outside[face.from as usize]);
            for [from, to] in [[a, b], [b, c], [c, a]] {
                if [from, to].iter().any(|end| self.sides[*end as usize] != 0.0) {
                    continue;
                }
                let [from, to] = if is_outside { [to, from] } else { [from, to] };
                // Sides that two faces of a solid share need no cap.
                let opposite = open.get_mut(&(solid, [to, from])).and_then(Vec::pop);
                if opposite.is_none() {
                    open.entry((solid, [from, to])).or_default().push(face.from);
                    order.push((solid, [from, to]));
                }
            }
        }
        let mut sides: BTreeMap<u32, Vec<OpenSide>> = BTreeMap::new();
        for (solid, ends) in order {
            if let Some(from) = open.get_mut(&(solid, ends)).and_then(Vec::pop) {
                sides.entry(solid).or_default().push(OpenSide { ends, from });
            }
        }
        sides
    }

    /// Adds a cap that belongs to a face's solid and is wound as that face is.
    fn add_cap(&mut self, cap: &Cap, from: u32, normal: DVec3) {
        let is_turned = self.is_outside[from as usize] == cap.is_turned;
        let number = self.mesh.normals.len() as u32;
        self.mesh.normals.push((if is_turned { -normal } else { normal }).as_vec3());
        for [a, b, c] in &cap.triangles {
            let positions = if is_turned { [*a, *c, *b] } else { [*a, *b, *c] };
            let cap = Some(self.next_face);
            self.faces.push(Face { positions, normals: [number; 3], coordinates: [NONE; 3], from, cap });
        }
        self.next_face += 1;
    }

    /// The mesh of the faces kept.
    pub(super) fn finished(self, old: &Mesh, curves: Curves) -> Mesh {
        let Self { mut mesh, faces, on_edges, .. } = self;
        let mut number = vec![NONE; mesh.positions.len()];
        faces.iter().flat_map(|face| face.positions).for_each(|position| number[position as usize] = 0);
        let kept: Vec<u32> = (0..number.len() as u32).filter(|position| number[*position as usize] == 0).collect();
        kept.iter().enumerate().for_each(|(at, position)| number[*position as usize] = at as u32);
        let marked = mesh.marked.iter().flat_map(|[a, b]| match on_edges.get(&[*a, *b]) {
            Some(middle) => vec![[*a, *middle], [*middle, *b]],
            None => vec![[*a, *b]],
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
