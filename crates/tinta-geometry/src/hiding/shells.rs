//! A mesh's triangles in drawing order, parted into shells: those connected over edges, closed by caps where they are open.

use super::groups::Groups;
use crate::edges::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE, VertexArrays, triangle_normal};
use crate::threads::{filled, threads_for};
use glam::DVec3;

/// The mesh as its arrays draw it.
pub(super) struct Surface {
    /// Relative to the mesh's centre, in its radii, numbered by first use; behind them the middles of caps.
    pub points: Vec<DVec3>,
    /// In drawing order.
    pub triangles: Vec<[u32; 3]>,
    /// Where each of the arrays' vertices lies.
    pub point_of_vertex: Vec<u32>,
    /// Each triangle's unit normal; zeros where it has no area.
    pub normals: Vec<DVec3>,
    pub edges: EdgeList,
}

/// Triangles that are connected over edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shell {
    /// Whether with its caps it is a closed surface of one orientation.
    pub is_sound: bool,
    /// Number of holes that caps close.
    pub holes: u32,
}

/// A face that nobody draws, between a hole's edge and its middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cap {
    pub shell: u32,
    pub corners: [u32; 3],
}

/// The shells of a surface.
pub(super) struct Shells {
    pub list: Vec<Shell>,
    /// Each face's shell.
    pub of_face: Vec<u32>,
    pub caps: Vec<Cap>,
}

impl Surface {
    /// `radius` in file units.
    pub(super) fn new(mesh: &Mesh, arrays: &VertexArrays, radius: f64) -> Self {
        let mut point_of_position = vec![NONE; mesh.positions.len()];
        let mut point_of_vertex = vec![NONE; arrays.vertices.len()];
        let mut points = Vec::with_capacity(mesh.positions.len());
        let mut triangles = Vec::with_capacity(mesh.triangles.len());
        for (triangle, vertices) in arrays.order.iter().zip(arrays.indices.chunks_exact(3)) {
            let positions = mesh.triangles[*triangle as usize];
            triangles.push(std::array::from_fn(|corner| {
                let point = &mut point_of_position[positions[corner] as usize];
                if *point == NONE {
                    *point = points.len() as u32;
                    points.push((mesh.positions[positions[corner] as usize] - arrays.centre) / radius);
                }
                point_of_vertex[vertices[corner] as usize] = *point;
                *point
            }));
        }
        let threads = threads_for(triangles.len());
        let edges = EdgeList::of_triangles(&triangles, points.len() as u32, threads);
        let corners = |face: usize| triangles[face].map(|point| points[point as usize]);
        let normal = |face| triangle_normal(corners(face)).unwrap_or_default();
        let normals = filled(triangles.len(), threads, DVec3::ZERO, normal);
        Self { points, triangles, point_of_vertex, normals, edges }
    }

    pub(super) fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|point| self.points[point as usize])
    }

    /// Mean length of the edges, mesh radii.
    pub(super) fn mean_edge(&self) -> f64 {
        let length = |[a, b]: &[u32; 2]| self.points[*a as usize].distance(self.points[*b as usize]);
        self.edges.positions().iter().map(length).sum::<f64>() / self.edges.len().max(1) as f64
    }
}

/// A side of a face that has no neighbour: shell, and from which point to which.
type OpenSide = (u32, u32, u32);

impl Shells {
    /// Parts a surface and adds to it the middles of the caps.
    pub(super) fn new(surface: &mut Surface) -> Self {
        let edges = &surface.edges;
        let mut groups = Groups::new(surface.triangles.len());
        for edge in 0..edges.len() as u32 {
            let faces = edges.faces(edge);
            faces.windows(2).for_each(|pair| groups.join(pair[0], pair[1]));
        }
        let (of_face, count) = groups.numbers();
        let mut list = vec![Shell { is_sound: true, holes: 0 }; count];
        // A face that names a point twice has no edges: a shell of its own, and no sound one.
        for ([a, b, c], shell) in surface.triangles.iter().zip(&of_face) {
            list[*shell as usize].is_sound &= a != b && b != c && c != a;
        }
        let mut open: Vec<OpenSide> = Vec::new();
        for (edge, incidence) in edges.incidence().iter().enumerate() {
            let face = edges.faces(edge as u32)[0];
            let shell = of_face[face as usize];
            match incidence {
                Incidence::Inner => {}
                Incidence::InnerReversed | Incidence::NonManifold => list[shell as usize].is_sound = false,
                Incidence::Boundary => {
                    let [low, high] = edges.positions()[edge];
                    let [a, b, c] = surface.triangles[face as usize];
                    let is_upwards = [(a, b), (b, c), (c, a)].contains(&(low, high));
                    open.push(if is_upwards { (shell, low, high) } else { (shell, high, low) });
                }
            }
        }
        open.sort_unstable();
        for pair in open.windows(2).filter(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            list[pair[0].0 as usize].is_sound = false;
        }
        open.retain(|(shell, ..)| list[*shell as usize].is_sound);
        let caps = caps(&open, &mut list, &mut surface.points);
        Self { list, of_face, caps }
    }

    pub(super) fn is_sound(&self, face: u32) -> bool {
        self.list[self.of_face[face as usize] as usize].is_sound
    }
}

/// Closes every loop of open sides, sorted, by a fan around its middle.
fn caps(open: &[OpenSide], list: &mut [Shell], points: &mut Vec<DVec3>) -> Vec<Cap> {
    let mut caps = Vec::with_capacity(open.len());
    let mut is_closed = vec![false; open.len()];
    for first in 0..open.len() {
        let (shell, start, _) = open[first];
        let (begin, middle) = (caps.len(), points.len() as u32);
        let (mut place, mut sum) = (first, DVec3::ZERO);
        while !std::mem::replace(&mut is_closed[place], true) {
            let (_, from, to) = open[place];
            sum += points[from as usize];
            caps.push(Cap { shell, corners: [to, from, middle] });
            // On a surface of one orientation every side that arrives at a point is followed by one that leaves it.
            let next = open.binary_search_by_key(&(shell, to), |(shell, from, _)| (*shell, *from));
            place = next.unwrap_or(first);
        }
        let sides = caps.len() - begin;
        if sides == 0 {
            continue;
        }
        let is_loop = caps.last().is_some_and(|cap| cap.corners[0] == start);
        list[shell as usize].is_sound &= is_loop;
        list[shell as usize].holes += 1;
        points.push(sum / sides as f64);
    }
    caps
}
