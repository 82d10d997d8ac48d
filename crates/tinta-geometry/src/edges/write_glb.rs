//! A mesh with its edges as GLB: glTF 2.0 with EXT_mesh_primitive_edge_visibility.
//!
//! In: a mesh, its edge list, the classes of edges to draw. Out: a file's bytes. Each part is a node, each of its materials a
//! primitive with two bits for each side of each triangle: 0 hidden, 1 silhouette, 2 hard, 3 hard and written before.

use super::{Class, ClassSet, Classes, CreaseAngle, EdgeList, Incidence};
use crate::error::{Error, Result};
use crate::mesh::{EDGES_EXTENSION, Mesh, NONE, bounds, glb_container, to_linear, triangle_normal};
use glam::DVec3;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};

/// The two bits of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Visibility {
    Hidden = 0,
    Silhouette = 1,
    Hard = 2,
    RepeatedHard = 3,
}

/// glTF's numbers for component types and for a view's use.
const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Returns a mesh and its edges as GLB, with EXT_mesh_primitive_edge_visibility.
///
/// An edge of one of `classes` is hard, which means always drawn. With [`Class::Silhouette`] among them, every other edge
/// between two faces that are not coplanar is a silhouette edge: viewers draw it where one face is seen from the front and the
/// other from the back. Faces, normals, base colours and parts' names are written too; textures, vertex colours, curves and
/// points are not. Positions are f32, relative to the model's centre if f32 does not hold them exactly.
///
/// # Errors
///
/// [`Error::File`] for a mesh without faces, and for one that exceeds the 4 GiB of a GLB file.
pub fn glb(mesh: &Mesh, edges: &EdgeList, classes: ClassSet, crease_angle: CreaseAngle) -> Result<Vec<u8>> {
    if mesh.triangles.is_empty() {
        return Err(Error::model(&mesh.name, "it has no faces, so no edges to write; choose a model of faces"));
    }
    let mut file = File::of(mesh);
    let mut marks = Marks::of(mesh, edges, classes, crease_angle);
    let mut meshes = Vec::new();
    let mut of_parts: BTreeMap<u32, BTreeMap<u32, Vec<usize>>> = BTreeMap::new();
    for triangle in 0..mesh.triangles.len() {
        let of = |list: &[u32]| list.get(triangle).copied().unwrap_or(NONE);
        let of_part = of_parts.entry(of(&mesh.triangle_parts)).or_default();
        of_part.entry(of(&mesh.triangle_materials)).or_default().push(triangle);
    }
    let mut nodes: Vec<Value> = mesh.parts.iter().map(|part| json!({ "name": part.name })).collect();
    for (part, of_materials) in of_parts {
        if part as usize >= nodes.len() {
            nodes.push(json!({ "name": mesh.name }));
        }
        let place = (part as usize).min(nodes.len() - 1);
        nodes[place]["mesh"] = json!(meshes.len());
        meshes.push(json!({ "primitives": file.primitives(&of_materials, &mut marks) }));
    }
    let tops = file.join(&mut nodes);
    let mut root = json!({
        "asset": { "version": "2.0", "generator": concat!("tinta ", env!("CARGO_PKG_VERSION")) },
        "scene": 0, "scenes": [{ "nodes": tops }], "nodes": nodes, "meshes": meshes,
        "accessors": file.accessors, "bufferViews": file.views, "buffers": [{ "byteLength": file.data.len() }],
    });
    if !mesh.materials.is_empty() {
        root["materials"] =
            mesh.materials.iter().map(|material| json_of_material(&material.name, material.color)).collect();
    }
    if file.has_edges {
        root["extensionsUsed"] = json!([EDGES_EXTENSION]);
    }
    let too_large = || Error::model(&mesh.name, "it takes more than the 4 GiB of a GLB file; write it in parts");
    glb_container(root.to_string().as_bytes(), &file.data).ok_or_else(too_large)
}

fn json_of_material(name: &str, color: Option<[f32; 3]>) -> Value {
    let mut surface = json!({ "metallicFactor": 0 });
    if let Some(color) = color {
        let [red, green, blue] = color.map(to_linear);
        surface["baseColorFactor"] = json!([red, green, blue, 1.0]);
    }
    json!({ "name": name, "pbrMetallicRoughness": surface })
}

/// A file's data so far and the JSON that describes it.
struct File<'a> {
    mesh: &'a Mesh,
    /// What is subtracted from positions; each number is an f32.
    centre: DVec3,
    data: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    has_edges: bool,
}

impl<'a> File<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let is_exact = |position: &DVec3| position.as_vec3().as_dvec3() == *position;
        let centre = match mesh.positions.iter().all(is_exact) {
            true => DVec3::ZERO,
            false => (low * 0.5 + high * 0.5).as_vec3().as_dvec3(),
        };
        Self { mesh, centre, data: Vec::new(), views: Vec::new(), accessors: Vec::new(), has_edges: false }
    }

    /// Makes parts children of those that hold them and moves the others to the centre; returns these others.
    fn join(&self, nodes: &mut [Value]) -> Vec<usize> {
        let mut children: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut tops = Vec::new();
        for number in 0..nodes.len() {
            match self.mesh.parts.get(number).map_or(NONE, |part| part.within) {
                NONE => tops.push(number),
                within => children.entry(within as usize).or_default().push(number),
            }
        }
        for (parent, children) in children {
            nodes[parent]["children"] = json!(children);
        }
        if self.centre != DVec3::ZERO {
            tops.iter().for_each(|top| nodes[*top]["translation"] = json!(self.centre.to_array()));
        }
        tops
    }

    /// Writes the triangles of a part, by material; returns its primitives.
    fn primitives(&mut self, of_materials: &BTreeMap<u32, Vec<usize>>, marks: &mut Marks<'_>) -> Vec<Value> {
        let mut vertices = Vertices::default();
        let mut indices = |triangle: usize| (0..3).map(|corner| vertices.number(self.mesh, triangle, corner)).collect();
        let of_each: Vec<Vec<u32>> = of_materials
            .values()
            .map(|list| list.iter().flat_map(|it| -> Vec<u32> { indices(*it) }).collect())
            .collect();
        let positions: Vec<DVec3> = vertices
            .keys
            .iter()
            .map(|[position, _]| (self.mesh.positions[*position as usize] - self.centre).as_vec3().as_dvec3())
            .collect();
        let (low, high) = bounds(&positions);
        let limits = json!({ "min": low.to_array(), "max": high.to_array() });
        let mut attributes = json!({ "POSITION": self.put_vectors(positions.into_iter(), Some(VERTICES), limits) });
        if !self.mesh.normals.is_empty() {
            let normal = |[_, normal]: &[u32; 2]| self.mesh.normals[*normal as usize].as_dvec3().normalize_or_zero();
            let normals = vertices.keys.iter().map(normal);
            attributes["NORMAL"] = json!(self.put_vectors(normals, Some(VERTICES), json!({})));
        }
        let mut primitives = Vec::new();
        for ((material, triangles), indices) in of_materials.iter().zip(of_each) {
            let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
            let indices = self.put(&bytes, Some(INDICES), UNSIGNED_INT, "SCALAR", indices.len(), json!({}));
            let mut primitive = json!({ "attributes": attributes, "indices": indices });
            if *material != NONE {
                primitive["material"] = json!(material);
            }
            let (bits, normals) = marks.of_triangles(triangles);
            if bits.iter().any(|bits| *bits != 0) {
                let mut edges =
                    json!({ "visibility": self.put(&bits, None, UNSIGNED_BYTE, "SCALAR", bits.len(), json!({})) });
                if !normals.is_empty() {
                    edges["silhouetteNormals"] = json!(self.put_vectors(normals.into_iter(), None, json!({})));
                }
                primitive["extensions"] = json!({ EDGES_EXTENSION: edges });
                self.has_edges = true;
            }
            primitives.push(primitive);
        }
        primitives
    }

    /// Writes vectors as f32; returns their accessor.
    fn put_vectors(
        &mut self,
        vectors: impl ExactSizeIterator<Item = DVec3>,
        target: Option<u32>,
        more: Value,
    ) -> usize {
        let count = vectors.len();
        let bytes: Vec<u8> =
            vectors.flat_map(|vector| vector.as_vec3().to_array()).flat_map(f32::to_le_bytes).collect();
        self.put(&bytes, target, FLOAT, "VEC3", count, more)
    }

    /// Writes an accessor's bytes at a multiple of 4; returns its number.
    fn put(
        &mut self,
        bytes: &[u8],
        target: Option<u32>,
        component: u32,
        kind: &str,
        count: usize,
        more: Value,
    ) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.data.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        let mut accessor =
            json!({ "bufferView": self.views.len(), "componentType": component, "type": kind, "count": count });
        for (name, value) in more.as_object().into_iter().flatten() {
            accessor[name] = value.clone();
        }
        self.data.extend_from_slice(bytes);
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// A part's vertices: each pair of a position and a normal of the mesh once, in the order of use.
#[derive(Default)]
struct Vertices {
    keys: Vec<[u32; 2]>,
    numbers: HashMap<[u32; 2], u32>,
}

impl Vertices {
    fn number(&mut self, mesh: &Mesh, triangle: usize, corner: usize) -> u32 {
        let normal = mesh.triangle_normals.get(triangle).map_or(NONE, |corners| corners[corner]);
        let key = [mesh.triangles[triangle][corner], normal];
        *self.numbers.entry(key).or_insert_with(|| {
            self.keys.push(key);
            self.keys.len() as u32 - 1
        })
    }
}

/// How each edge is drawn, and where it is written already.
struct Marks<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeList,
    of_edges: Vec<Visibility>,
    /// The edges of each triangle's sides, in their order, or [`NONE`].
    sides: Vec<[u32; 3]>,
    /// The last primitive that wrote each edge, counted from 1; 0 for none.
    written: Vec<u32>,
    primitives: u32,
}

impl<'a> Marks<'a> {
    fn of(mesh: &'a Mesh, edges: &'a EdgeList, classes: ClassSet, crease_angle: CreaseAngle) -> Self {
        let hard = Classes::new(mesh, edges, crease_angle, classes).of_edges;
        // An edge between coplanar faces is no silhouette from any eye.
        let any_angle = CreaseAngle { cosine: 1.0 };
        let bent = match classes.contains(Class::Silhouette) {
            true => Classes::new(mesh, edges, any_angle, ClassSet::of(&[Class::Crease])).of_edges,
            false => vec![ClassSet::default(); edges.len()],
        };
        let of_edge = |(hard, bent): (&ClassSet, &ClassSet)| match (hard.is_empty(), bent.is_empty()) {
            (false, _) => Visibility::Hard,
            (true, false) => Visibility::Silhouette,
            (true, true) => Visibility::Hidden,
        };
        let mut sides = vec![[NONE; 3]; mesh.triangles.len()];
        for (edge, ends) in edges.positions().iter().enumerate() {
            for face in edges.faces(edge as u32) {
                let [a, b, c] = mesh.triangles[*face as usize];
                let is_it = |side: &[u32; 2]| [side[0].min(side[1]), side[0].max(side[1])] == *ends;
                if let Some(side) = [[a, b], [b, c], [c, a]].iter().position(is_it) {
                    sides[*face as usize][side] = edge as u32;
                }
            }
        }
        let of_edges = hard.iter().zip(&bent).map(of_edge).collect();
        Self { mesh, edges, of_edges, sides, written: vec![0; edges.len()], primitives: 0 }
    }

    /// Returns the bits of a primitive's triangles, and the normals of the two faces of each silhouette edge among them.
    ///
    /// A hard edge is written once in each primitive, because viewers draw these separately. A silhouette edge is written once.
    fn of_triangles(&mut self, triangles: &[usize]) -> (Vec<u8>, Vec<DVec3>) {
        self.primitives += 1;
        let (mut bits, mut normals) = (vec![0; (triangles.len() * 6).div_ceil(8)], Vec::new());
        let sides = triangles.iter().flat_map(|triangle| self.sides[*triangle].map(|edge| (*triangle, edge)));
        for (place, (triangle, edge)) in sides.enumerate().filter(|(_, (_, edge))| *edge != NONE) {
            let before = std::mem::replace(&mut self.written[edge as usize], self.primitives);
            let visibility = match self.of_edges[edge as usize] {
                Visibility::Hard if before == self.primitives => Visibility::RepeatedHard,
                Visibility::Silhouette if before != 0 => Visibility::Hidden,
                visibility => visibility,
            };
            if visibility == Visibility::Silhouette {
                normals.extend(self.normals(triangle as u32, edge));
            }
            bits[place / 4] |= (visibility as u8) << (place % 4 * 2);
        }
        (bits, normals)
    }

    /// The normals of a silhouette edge's two faces, first that of `triangle`. One of two faces wound against each other is
    /// reversed.
    fn normals(&self, triangle: u32, edge: u32) -> [DVec3; 2] {
        let normal = |face: u32| {
            self.mesh.corners(&self.mesh.triangles[face as usize]).and_then(triangle_normal).unwrap_or_default()
        };
        let other = self.edges.faces(edge).iter().find(|face| **face != triangle).copied().unwrap_or(triangle);
        let is_reversed = self.edges.incidence()[edge as usize] == Incidence::InnerReversed;
        [normal(triangle), if is_reversed { -normal(other) } else { normal(other) }]
    }
}

#[cfg(test)]
#[path = "write_glb_tests.rs"]
mod tests;
