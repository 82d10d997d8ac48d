use super::*;
use crate::LoadOptions;
use crate::mesh::read_bytes;

/// Two triangles over the square of the extension's example, corner 3 raised, with these marks.
fn square(marked: &[[u32; 2]]) -> Mesh {
    let corners = vec![DVec3::Y, DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.5)];
    let mesh = Mesh::of_triangles("a square", corners, &[[0, 1, 2], [0, 2, 3]], &LoadOptions::default()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    Mesh { marked: marked.to_vec(), ..mesh }
}

fn bits(mesh: &Mesh, classes: &[Class]) -> (Vec<u8>, Vec<DVec3>) {
    let edges = EdgeList::new(mesh);
    Marks::of(mesh, &edges, ClassSet::of(classes), CreaseAngle::default()).of_triangles(&[0, 1])
}

#[test]
fn the_bytes_of_the_extensions_two_examples_are_written() {
    let (silhouette, normals) = bits(&square(&[[0, 1], [2, 3]]), &[Class::Marked, Class::Silhouette]);
    assert_eq!(silhouette, [18, 2]);
    // The first triangle is level, the second is not.
    assert_eq!((normals.len(), normals[0]), (2, DVec3::Z));
    assert!((normals[1].length() - 1.0).abs() < 1e-12 && normals[1].z < 0.999);
    let (hard, none) = bits(&square(&[[0, 1], [0, 2], [2, 3]]), &[Class::Marked, Class::Silhouette]);
    assert_eq!((hard, none), (vec![226, 2], vec![]));
    assert_eq!(bits(&square(&[[0, 1]]), &[Class::Crease]).0, [0, 0], "no class is wanted that an edge has");
}

#[test]
fn a_file_without_edges_to_draw_has_no_extension_and_one_without_faces_is_refused() {
    let mesh = square(&[]);
    let written = |mesh: &Mesh| {
        glb(mesh, &EdgeList::new(mesh), ClassSet::of(&[Class::Marked]), CreaseAngle::default())
            .map_err(|it| it.to_string())
    };
    let bytes = written(&mesh).unwrap();
    assert!(!bytes.windows(EDGES_EXTENSION.len()).any(|window| window == EDGES_EXTENSION.as_bytes()));
    let read = read_bytes(&bytes, "a.glb", &[], &LoadOptions::default()).unwrap();
    assert!(read.remarks.is_empty() && read.mesh.marked.is_empty(), "{:?}", read.remarks);
    assert_eq!(read.mesh.positions, mesh.positions);
    let empty = Mesh { triangles: Vec::new(), ..mesh };
    assert_eq!(
        written(&empty).unwrap_err(),
        "a square: it has no faces, so no edges to write; choose a model of faces"
    );
}
