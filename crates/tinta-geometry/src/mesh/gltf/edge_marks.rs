//! The edges that a glTF file marks as edges to draw: EXT_mesh_primitive_edge_visibility.
//!
//! In: a primitive and its triangles. Out: its hard edges, each as two of its vertices. Each edge of each triangle has two
//! bits, 0 hidden, 1 silhouette, 2 hard, 3 hard and already said; other hard edges are strings of vertices. Silhouettes are left
//! out: exact lines find those of every view.

use super::accessors::Accessors;
use super::extensions;
use gltf_json::Index;
use gltf_json::mesh::Primitive;
use serde::Deserialize;

/// The values of two bits that mark an edge.
const HARD: [u32; 2] = [2, 3];

/// The extension of a primitive.
#[derive(Deserialize)]
pub(super) struct Edges {
    visibility: Option<u32>,
    #[serde(default, rename = "lineStrings")]
    line_strings: Vec<LineString>,
}

#[derive(Deserialize)]
struct LineString {
    indices: u32,
}

impl Edges {
    /// Reads a primitive's extension; `None` if it has none.
    pub(super) fn of(primitive: &Primitive) -> Result<Option<Self>, String> {
        extensions::said(primitive.extensions.as_ref().map(|extensions| &extensions.others), extensions::EDGES)
    }

    /// Returns the marked edges of these triangles, some perhaps several times.
    pub(super) fn marks(&self, triangles: &[[u32; 3]], accessors: &Accessors<'_>) -> Result<Vec<[u32; 2]>, String> {
        let mut marks = Vec::new();
        if let Some(index) = self.visibility.map(Index::new) {
            let (count, needed) = (accessors.count(index)?, (triangles.len() * 6).div_ceil(8));
            if count < needed {
                return Err(format!(
                    "its accessor {index} has {count} bytes for the edges of {} triangles, which need {needed}; export it again",
                    triangles.len()
                ));
            }
            let bytes = accessors.indices(index, needed)?;
            let sides = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
            let is_marked = |(place, _): &(usize, [u32; 2])| HARD.contains(&(bytes[place / 4] >> (place % 4 * 2) & 3));
            marks.extend(sides.enumerate().filter(is_marked).map(|(_, side)| side));
        }
        for index in self.line_strings.iter().map(|string| Index::new(string.indices)) {
            let (count, edges) = (accessors.count(index)?, triangles.len() * 3);
            // Of each edge two vertices and an end.
            if count > edges * 3 {
                return Err(format!(
                    "its accessor {index} has {count} numbers for the strings of {edges} edges; export it again"
                ));
            }
            let (indices, end) = (accessors.indices(index, count)?, accessors.largest(index)?);
            let strings = indices.split(|index| *index == end);
            marks.extend(strings.flat_map(|string| string.windows(2).map(|pair| [pair[0], pair[1]])));
        }
        Ok(marks)
    }
}

#[cfg(test)]
mod tests {
    use crate::LoadOptions;
    use crate::edges::{Class, ClassSet, CreaseAngle, MeshEdges};
    use crate::mesh::{Mesh, read_bytes};
    use std::sync::Arc;

    /// The square of the standard's example, flat: vertices 0 above 1, 2 and 3 to the right; its extension as JSON over accessors
    /// 2, the bytes, and 3, the strings.
    fn square(extension: &str, bytes: &[u8], strings: &[u8]) -> crate::Result<Mesh> {
        let corners = [[0.0f32, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        let mut data: Vec<u8> = corners.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        data.extend([0, 1, 2, 0, 2, 3]);
        let views = [(0, 48), (48, 6), (54, bytes.len()), (54 + bytes.len(), strings.len())];
        data.extend([bytes, strings].concat());
        let views: Vec<String> = views
            .iter()
            .map(|(start, length)| format!(r#"{{"buffer":0,"byteOffset":{start},"byteLength":{}}}"#, (*length).max(1)))
            .collect();
        data.extend([0; 4]);
        let accessor = |view: usize, kind: u32, count: usize, of: &str| {
            format!(r#"{{"bufferView":{view},"componentType":{kind},"count":{count},"type":"{of}"}}"#)
        };
        let accessors = [
            accessor(0, 5126, 4, r#"VEC3","min":[0,0,0],"max":[1,1,0],"name":""#),
            accessor(1, 5121, 6, "SCALAR"),
            accessor(2, 5121, bytes.len().max(1), "SCALAR"),
            accessor(3, 5121, strings.len().max(1), "SCALAR"),
        ];
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":["EXT_mesh_primitive_edge_visibility"],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,
            "extensions":{{"EXT_mesh_primitive_edge_visibility":{extension}}}}}]}}],
            "accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{},"uri":"a.bin"}}]}}"#,
            accessors.join(","),
            views.join(","),
            data.len()
        );
        let loaded = read_bytes(json.as_bytes(), "a.gltf", &[("a.bin", &data)], &LoadOptions::default())?;
        assert!(loaded.remarks.is_empty(), "{:?}", loaded.remarks);
        Ok(loaded.mesh)
    }

    /// The marked edges by their vertices in the file.
    fn marked(mesh: Mesh) -> Vec<[u32; 2]> {
        let edges = MeshEdges::new(Arc::new(mesh));
        let classes = edges.classes(CreaseAngle::default(), ClassSet::EDGES);
        let is_marked = |edge: &u32| classes.of_edges[*edge as usize].contains(Class::Marked);
        let vertices =
            |edge: u32| edges.list().positions()[edge as usize].map(|at| edges.mesh().file_vertices[at as usize]);
        let all = (0..edges.list().len() as u32).filter(is_marked).map(vertices);
        let mut all: Vec<[u32; 2]> = all.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn the_bytes_of_the_standards_example_mark_its_two_hard_edges() {
        let mesh = square(r#"{"visibility":2,"silhouetteNormals":9}"#, &[18, 2], &[]).unwrap();
        assert_eq!(marked(mesh), [[0, 1], [2, 3]]);
        // All edges hard, the diagonal said twice.
        let mesh = square(r#"{"visibility":2}"#, &[0b1010_1010 | 0b01 << 6, 0b1010], &[]).unwrap();
        assert_eq!(marked(mesh), [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]);
    }

    #[test]
    fn strings_of_vertices_mark_edges_up_to_their_ends() {
        let mesh = square(r#"{"lineStrings":[{"indices":3}]}"#, &[], &[0, 1, 2, 255, 3, 0]).unwrap();
        assert_eq!(marked(mesh), [[0, 1], [0, 3], [1, 2]]);
        assert!(marked(square("{}", &[], &[]).unwrap()).is_empty());
    }

    #[test]
    fn damaged_marks_are_refused_in_one_sentence() {
        let message = |extension: &str, bytes: &[u8], strings: &[u8]| {
            square(extension, bytes, strings).map(marked).unwrap_err().to_string()
        };
        let few = "a.gltf: its accessor 2 has 1 bytes for the edges of 2 triangles, which need 2; export it again";
        assert_eq!(message(r#"{"visibility":2}"#, &[18], &[]), few);
        assert!(message(r#"{"visibility":9}"#, &[], &[]).contains("its accessor 9 does not exist"));
        let damaged = message(r#"{"visibility":"two"}"#, &[], &[]);
        assert!(
            damaged.contains("its EXT_mesh_primitive_edge_visibility is damaged (invalid type: string"),
            "{damaged}"
        );
        let many = message(r#"{"lineStrings":[{"indices":3}]}"#, &[], &[1; 19]);
        assert!(many.contains("has 19 numbers for the strings of 6 edges"), "{many}");
        // A vertex that is not there marks nothing.
        assert!(marked(square(r#"{"lineStrings":[{"indices":3}]}"#, &[], &[0, 9]).unwrap()).is_empty());
    }
}
