//! A mesh as GL wants it: f32 vertices with one normal each, indices, and runs of one material.

use super::normals::Incidence;
use super::{Mesh, NONE};
use glam::DVec3;

/// Interleaved vertex and index arrays.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexArrays {
    /// Position (x, y, z, in scene radii from `centre`) and unit normal of each vertex.
    pub vertices: Vec<[f32; 6]>,
    /// Three indices a triangle.
    pub indices: Vec<u32>,
    /// The runs of triangles that share a material, in drawing order.
    pub parts: Vec<Part>,
    /// The mesh's own centre, world space, subtracted in f64 before anything becomes f32.
    pub centre: DVec3,
}

/// A run of indices with one material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Into the mesh's materials, or [`NONE`].
    pub material: u32,
    /// First index.
    pub first: u32,
    /// Number of indices.
    pub count: u32,
}

impl VertexArrays {
    /// Builds the arrays of a mesh; `unit` is the length in file units that becomes 1, the scene's radius.
    pub fn new(mesh: &Mesh, unit: f64) -> Self {
        let (low, high) = mesh.bounds();
        let centre = low * 0.5 + high * 0.5;
        let incidence = Incidence::new(mesh.positions.len(), &mesh.triangles);
        let corner_normals = mesh.triangle_normals.as_flattened();
        let mut vertices: Vec<[f32; 6]> = Vec::with_capacity(mesh.positions.len());
        let mut corner_vertices = vec![NONE; corner_normals.len()];
        let mut corners = Vec::new();
        for (position, point) in mesh.positions.iter().enumerate() {
            let [x, y, z] = ((point - centre) / unit).as_vec3().to_array();
            corners.clear();
            corners.extend(incidence.corners(position).iter().map(|corner| (corner_normals[*corner as usize], *corner)));
            corners.sort_unstable();
            for group in corners.chunk_by(|a, b| a.0 == b.0) {
                let [nx, ny, nz] = mesh.normals[group[0].0 as usize].to_array();
                group.iter().for_each(|(_, corner)| corner_vertices[*corner as usize] = vertices.len() as u32);
                vertices.push([x, y, z, nx, ny, nz]);
            }
        }
        let order = material_order(mesh);
        let indices = order.iter().flat_map(|&triangle| &corner_vertices[triangle as usize * 3..][..3]).copied().collect();
        let parts = parts(mesh, &order);
        Self { vertices, indices, parts, centre }
    }
}

/// The triangles sorted by material, otherwise in the file's order.
fn material_order(mesh: &Mesh) -> Vec<u32> {
    let mut order: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    if !mesh.triangle_materials.is_empty() {
        order.sort_by_key(|triangle| mesh.triangle_materials[*triangle as usize]);
    }
    order
}

fn parts(mesh: &Mesh, order: &[u32]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for (place, &triangle) in order.iter().enumerate() {
        let material = mesh.triangle_materials.get(triangle as usize).copied().unwrap_or(NONE);
        match parts.last_mut() {
            Some(part) if part.material == material => part.count += 3,
            _ => parts.push(Part { material, first: place as u32 * 3, count: 3 }),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use crate::mesh::{LoadOptions, VertexArrays, load};

    #[test]
    fn the_open_box_has_four_vertices_a_side_and_keeps_every_corner() {
        let mesh = load("builtin:open-box", &LoadOptions::default()).unwrap().mesh;
        let arrays = VertexArrays::new(&mesh, 2.0);
        assert_eq!(arrays.vertices.len(), 20, "five sides of four corners, creases split");
        let corners = mesh.triangles.as_flattened().iter().zip(mesh.triangle_normals.as_flattened());
        for (index, (position, normal)) in arrays.indices.iter().zip(corners) {
            let [x, y, z, nx, ny, nz] = arrays.vertices[*index as usize];
            let expected = ((mesh.positions[*position as usize] - arrays.centre) / 2.0).as_vec3();
            assert_eq!([x, y, z], expected.to_array());
            assert_eq!([nx, ny, nz], mesh.normals[*normal as usize].to_array());
        }
    }

    #[test]
    fn the_ants_parts_cover_all_its_triangles_once_by_material() {
        let mesh = load("builtin:ant", &LoadOptions::default()).unwrap().mesh;
        let arrays = VertexArrays::new(&mesh, 1.0);
        let mut next = 0;
        for part in &arrays.parts {
            assert_eq!(part.first, next);
            next += part.count;
        }
        assert_eq!(next as usize, mesh.triangles.len() * 3);
        assert!(arrays.parts.windows(2).all(|pair| pair[0].material < pair[1].material));
    }
}
