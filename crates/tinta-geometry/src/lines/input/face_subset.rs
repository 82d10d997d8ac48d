//! A mesh with some of its faces.

use crate::mesh::{Mesh, NONE};

pub(in crate::lines) fn keep_faces(mesh: &Mesh, keep: impl Fn(u32) -> bool) -> Mesh {
    let kept: Vec<usize> = (0..mesh.triangles.len()).filter(|face| keep(*face as u32)).collect();
    with_faces(mesh, kept.iter().map(|face| (*face, mesh.triangles[*face])).collect())
}

/// The mesh with these faces, each with the number of the face that gives its normals, texture and material. Corners
/// that this face does not have get none.
pub(in crate::lines) fn with_faces(mesh: &Mesh, faces: Vec<(usize, [u32; 3])>) -> Mesh {
    let of_corners = |list: &[[u32; 3]]| -> Vec<[u32; 3]> {
        let of_face = |(face, corners): &(usize, [u32; 3])| {
            let values = list.get(*face)?;
            let place = |corner: &u32| mesh.triangles[*face].iter().position(|old| old == corner);
            Some(corners.map(|corner| place(&corner).map_or(NONE, |place| values[place])))
        };
        faces.iter().filter_map(of_face).collect()
    };
    let of_faces = |list: &[u32]| faces.iter().filter_map(|(face, _)| list.get(*face).copied()).collect();
    Mesh {
        triangle_normals: of_corners(&mesh.triangle_normals),
        triangle_texture_coordinates: of_corners(&mesh.triangle_texture_coordinates),
        triangle_materials: of_faces(&mesh.triangle_materials),
        triangle_parts: of_faces(&mesh.triangle_parts),
        file_faces: faces.iter().map(|(face, _)| mesh.file_face(*face as u32)).collect(),
        triangles: faces.into_iter().map(|(_, corners)| corners).collect(),
        ..mesh.clone()
    }
}
