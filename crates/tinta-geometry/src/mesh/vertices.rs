//! A mesh as GL wants it: f32 vertices with one normal each, indices, and runs of one material.

use super::coincident::coincident;
use super::hilbert::hilbert_code;
use super::normals::Incidence;
use super::{Mesh, NONE};
use crate::threads::{both, filled, sort_by, threads_for};
use glam::DVec3;

/// Interleaved vertex and index arrays.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexArrays {
    /// Position (x, y, z, in scene radii from `centre`) and unit normal of each vertex.
    pub vertices: Vec<[f32; 6]>,
    /// Texture coordinates of each vertex, origin at the lower left; empty where the mesh has no texture to read by them.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Red, green, blue and an alpha of 1 at each vertex; empty where the mesh has no colours at its positions.
    pub colors: Vec<[f32; 4]>,
    /// Three indices a triangle.
    pub indices: Vec<u32>,
    /// For each of the mesh's positions one vertex that lies there, or [`NONE`] where no triangle does.
    pub position_vertices: Vec<u32>,
    /// The mesh's triangles in drawing order: whose indices come first, second and so on.
    pub order: Vec<u32>,
    /// The runs of triangles that share a material and are all doubled or none, in drawing order.
    pub parts: Vec<Part>,
    /// The mesh's own centre, world space, subtracted in f64 before anything becomes f32.
    pub centre: DVec3,
}

/// A run of indices with one material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Into the mesh's materials, or [`NONE`].
    pub material: u32,
    /// Whether each of its triangles lies on another with the same corners the other way round: one of both faces the eye.
    pub is_doubled: bool,
    /// First index.
    pub first: u32,
    /// Number of indices.
    pub count: u32,
}

impl VertexArrays {
    /// Builds the arrays of a mesh; `unit` is the length in file units that becomes 1, the scene's radius.
    pub fn new(mesh: &Mesh, unit: f64) -> Self {
        let (low, high) = if mesh.positions.is_empty() { mesh.extent() } else { mesh.bounds() };
        let centre = low * 0.5 + high * 0.5;
        let is_doubled = doubled(mesh);
        let (corners, order) = both(|| CornerVertices::new(mesh, centre, unit), || drawing_order(mesh, &is_doubled));
        let CornerVertices { vertices, texture_coordinates, colors, corner_vertices, position_vertices } = corners;
        let indices: Vec<[u32; 3]> = order.iter().map(|triangle| corner_vertices[*triangle as usize]).collect();
        let indices = indices.into_flattened();
        let parts = parts(mesh, &order, &is_doubled);
        let mut arrays =
            Self { vertices, texture_coordinates, colors, indices, position_vertices, order, parts, centre };
        arrays.number_by_first_use();
        arrays
    }

    /// Renumbers the vertices in the order of drawing.
    fn number_by_first_use(&mut self) {
        let mut number = vec![NONE; self.vertices.len()];
        let mut order = Vec::with_capacity(self.vertices.len());
        for index in &mut self.indices {
            let slot = &mut number[*index as usize];
            if *slot == NONE {
                *slot = order.len() as u32;
                order.push(*index);
            }
            *index = *slot;
        }
        self.vertices = order.iter().map(|old| self.vertices[*old as usize]).collect();
        if !self.texture_coordinates.is_empty() {
            self.texture_coordinates = order.iter().map(|old| self.texture_coordinates[*old as usize]).collect();
        }
        if !self.colors.is_empty() {
            self.colors = order.iter().map(|old| self.colors[*old as usize]).collect();
        }
        let vertices = self.position_vertices.iter_mut().filter(|vertex| **vertex != NONE);
        vertices.for_each(|vertex| *vertex = number[*vertex as usize]);
    }
}

/// The mesh's vertices position by position, before they get the numbers they are drawn by.
struct CornerVertices {
    vertices: Vec<[f32; 6]>,
    texture_coordinates: Vec<[f32; 2]>,
    colors: Vec<[f32; 4]>,
    /// Each triangle's vertices.
    corner_vertices: Vec<[u32; 3]>,
    position_vertices: Vec<u32>,
}

impl CornerVertices {
    fn new(mesh: &Mesh, centre: DVec3, unit: f64) -> Self {
        let incidence = Incidence::new(mesh.positions.len(), &mesh.triangles);
        let keys = CornerKeys::new(mesh);
        let mut vertices: Vec<[f32; 6]> = Vec::with_capacity(mesh.positions.len());
        let (mut texture_coordinates, mut colors) = (Vec::new(), Vec::new());
        let mut corner_vertices = vec![[NONE; 3]; mesh.triangles.len()];
        let mut position_vertices = Vec::with_capacity(mesh.positions.len());
        let mut corners = Vec::new();
        for (position, point) in mesh.positions.iter().enumerate() {
            let [x, y, z] = ((point - centre) / unit).as_vec3().to_array();
            corners.clear();
            corners.extend(incidence.corners(position).iter().map(|corner| (keys.of(*corner as usize), *corner)));
            // A single vertex, as on smooth surfaces, needs no sorting.
            if corners.windows(2).any(|pair| pair[0].0 != pair[1].0) {
                corners.sort_unstable();
            }
            position_vertices.push(if corners.is_empty() { NONE } else { vertices.len() as u32 });
            for group in corners.chunk_by(|a, b| a.0 == b.0) {
                let [normal, texture, ..] = group[0].0;
                let [nx, ny, nz] = mesh.normals[normal as usize].to_array();
                for (_, corner) in group {
                    corner_vertices[*corner as usize / 3][*corner as usize % 3] = vertices.len() as u32;
                }
                vertices.push([x, y, z, nx, ny, nz]);
                colors.extend(mesh.position_colors.get(position).map(|[red, green, blue]| [*red, *green, *blue, 1.0]));
                if keys.has_textures {
                    let coordinate = mesh.texture_coordinates.get(texture as usize).copied().unwrap_or_default();
                    texture_coordinates.push(coordinate.to_array());
                }
            }
        }
        Self { vertices, texture_coordinates, colors, corner_vertices, position_vertices }
    }
}

/// What tells the vertices at one position apart: normal, texture coordinate where the mesh has textures, material and part where
/// it has several.
struct CornerKeys<'a> {
    mesh: &'a Mesh,
    has_textures: bool,
    has_kinds: bool,
}

impl<'a> CornerKeys<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        let has_coordinates = !mesh.triangle_texture_coordinates.is_empty();
        Self {
            mesh,
            has_textures: has_coordinates && mesh.materials.iter().any(|material| material.has_texture()),
            has_kinds: mesh.materials.len() > 1 || mesh.parts.len() > 1,
        }
    }

    fn of(&self, corner: usize) -> [u32; 4] {
        let (triangle, corner) = (corner / 3, corner % 3);
        let normal = self.mesh.triangle_normals[triangle][corner];
        let texture = match self.has_textures {
            true => self.mesh.triangle_texture_coordinates[triangle][corner],
            false => NONE,
        };
        let [part, material] = if self.has_kinds { self.mesh.part_and_material(triangle) } else { [NONE; 2] };
        [normal, texture, material, part]
    }
}

/// Sorts the triangles by material and then along a space-filling curve: neighbours are drawn together and share cached
/// vertices. A scan in its file's order costs a quarter more (GL picks among equal depths the triangle drawn first, so only the
/// order of coincident triangles can show).
fn drawing_order(mesh: &Mesh, is_doubled: &[bool]) -> Vec<u32> {
    let (low, high) = mesh.bounds();
    let scale = 1023.0 / (high - low).max_element();
    let threads = threads_for(mesh.triangles.len());
    // A triangle's place on the curve and its number, as one number.
    let mut keys = filled(mesh.triangles.len(), threads, 0, |index| {
        let triangle = mesh.triangles[index].map(|position| mesh.positions[position as usize] - low);
        let middle = triangle.iter().sum::<DVec3>() / 3.0;
        u64::from(hilbert_code(middle * scale)) << 32 | index as u64
    });
    sort_by(&mut keys, threads, u64::cmp);
    let mut order: Vec<u32> = keys.into_iter().map(|key| key as u32).collect();
    if !mesh.triangle_materials.is_empty() || !is_doubled.is_empty() {
        order.sort_by_key(|triangle| kind(mesh, is_doubled, *triangle));
    }
    order
}

/// A triangle's material, and whether it is doubled: what its [`Part`] has in common.
fn kind(mesh: &Mesh, is_doubled: &[bool], triangle: u32) -> (u32, bool) {
    let material = mesh.triangle_materials.get(triangle as usize).copied().unwrap_or(NONE);
    (material, is_doubled.get(triangle as usize).copied().unwrap_or_default())
}

/// Which triangles have another with the same corners on their back; empty if none has.
fn doubled(mesh: &Mesh) -> Vec<bool> {
    if mesh.defects.doubled_triangles == 0 {
        return Vec::new();
    }
    let mut is_doubled = vec![false; mesh.triangles.len()];
    let pairs = coincident(&mesh.triangles, mesh.positions.len()).opposite;
    pairs.as_flattened().iter().for_each(|triangle| is_doubled[*triangle as usize] = true);
    is_doubled
}

fn parts(mesh: &Mesh, order: &[u32], is_doubled: &[bool]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for (place, &triangle) in order.iter().enumerate() {
        let (material, is_doubled) = kind(mesh, is_doubled, triangle);
        match parts.last_mut() {
            Some(part) if (part.material, part.is_doubled) == (material, is_doubled) => part.count += 3,
            _ => parts.push(Part { material, is_doubled, first: place as u32 * 3, count: 3 }),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use crate::mesh::{LoadOptions, Mesh, VertexArrays, load};

    #[test]
    fn the_open_box_has_four_vertices_a_side_and_keeps_every_corner() {
        let mesh = load("../../models/open-box.obj", &LoadOptions::default()).unwrap().mesh;
        let arrays = VertexArrays::new(&mesh, 2.0);
        assert_eq!(arrays.vertices.len(), 20, "five sides of four corners, creases split");
        // Triangles may be reordered, so both sides are compared as sorted lists of corners.
        let mut drawn: Vec<[u32; 6]> =
            arrays.indices.iter().map(|index| arrays.vertices[*index as usize].map(f32::to_bits)).collect();
        let corners = mesh.triangles.as_flattened().iter().zip(mesh.triangle_normals.as_flattened());
        let mut expected: Vec<[u32; 6]> = corners
            .map(|(position, normal)| {
                let [x, y, z] = ((mesh.positions[*position as usize] - arrays.centre) / 2.0).as_vec3().to_array();
                let [nx, ny, nz] = mesh.normals[*normal as usize].to_array();
                [x, y, z, nx, ny, nz].map(f32::to_bits)
            })
            .collect();
        drawn.sort_unstable();
        expected.sort_unstable();
        assert_eq!(drawn, expected);
    }

    #[test]
    fn every_position_has_a_vertex_that_lies_there() {
        for model in ["../../models/ant.obj", "../../models/bust.obj"] {
            let mesh = load(model, &LoadOptions::default()).unwrap().mesh;
            let arrays = VertexArrays::new(&mesh, 3.0);
            assert_eq!(arrays.position_vertices.len(), mesh.positions.len());
            for (point, vertex) in mesh.positions.iter().zip(&arrays.position_vertices) {
                let expected = ((point - arrays.centre) / 3.0).as_vec3().to_array();
                assert_eq!(arrays.vertices[*vertex as usize][..3], expected, "{model}");
            }
        }
    }

    #[test]
    fn a_vertex_has_one_material() {
        let mesh = load("../../models/ant.obj", &LoadOptions::default()).unwrap().mesh;
        let arrays = VertexArrays::new(&mesh, 1.0);
        let mut materials = vec![None; arrays.vertices.len()];
        for part in &arrays.parts {
            for index in &arrays.indices[part.first as usize..][..part.count as usize] {
                let seen = materials[*index as usize].replace(part.material);
                assert!(seen.is_none_or(|seen| seen == part.material));
            }
        }
    }

    /// A 60 x 60 grid of squares given row by row in a scrambled order of rows.
    fn grid() -> Mesh {
        let side = 61u32;
        let mut text = String::new();
        for i in 0..side * side {
            text.push_str(&format!("v {} {} 0\n", i % side, i / side));
        }
        for row in (0..side - 1).map(|row| row * 37 % (side - 1)) {
            for column in 0..side - 1 {
                let a = row * side + column + 1;
                text.push_str(&format!("f {} {} {} {}\n", a, a + 1, a + 1 + side, a + side));
            }
        }
        let file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
        std::fs::write(file.path(), text).unwrap();
        load(file.path().to_str().unwrap(), &LoadOptions::default()).unwrap().mesh
    }

    #[test]
    fn a_triangle_of_a_large_mesh_of_squares_takes_about_75_bytes() {
        let (mesh, arrays) = (grid(), VertexArrays::new(&grid(), 1.0));
        // Half a vertex a triangle: 14 bytes of position and 6 of normal; 24 of indices; 4 of its square's number,
        // which a mesh of triangles lacks; for GL 14 of vertex and 12 of indices.
        fn held<T>(list: &Vec<T>) -> usize {
            list.capacity() * size_of::<T>()
        }
        let of_vertices = held(&mesh.positions) + held(&mesh.file_vertices) + held(&mesh.normals);
        let of_triangles = held(&mesh.triangles) + held(&mesh.triangle_normals) + held(&mesh.file_faces);
        let for_gl = held(&arrays.vertices) + held(&arrays.indices) + held(&arrays.position_vertices);
        let bytes = (of_vertices + of_triangles + for_gl) as f64 / mesh.triangles.len() as f64;
        let others =
            [held(&mesh.texture_coordinates), held(&mesh.triangle_materials), held(&mesh.marked), held(&arrays.colors)];
        assert_eq!(others, [0; 4]);
        assert!((74.0..78.0).contains(&bytes), "{bytes} bytes a triangle");
    }

    #[test]
    fn neighbours_on_a_grid_are_drawn_together() {
        let mesh = grid();
        let arrays = VertexArrays::new(&mesh, 1.0);
        let distinct: usize =
            arrays.indices.chunks(1023).map(|chunk| chunk.iter().collect::<std::collections::HashSet<_>>().len()).sum();
        assert!(distinct < arrays.vertices.len() * 3 / 2, "{distinct} of {}", arrays.vertices.len());
    }

    #[test]
    fn the_ants_parts_cover_all_its_triangles_once_by_material() {
        let mesh = load("../../models/ant.obj", &LoadOptions::default()).unwrap().mesh;
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
