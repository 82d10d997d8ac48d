//! Meshes of any number of triangles, to see how times grow.

use glam::DVec3;
use tinta::Mesh;
use tinta::mesh::Defects;

/// A closed sphere of about so many triangles with a varying radius, which gives silhouettes in front of other parts.
pub fn bumpy_sphere(triangles: usize) -> Mesh {
    let rows = ((triangles as f64) / 4.0).sqrt().round() as u32;
    let columns = rows * 2;
    let mut positions = vec![DVec3::Y, DVec3::NEG_Y];
    for row in 1..rows {
        for column in 0..columns {
            let (polar, around) = (
                std::f64::consts::PI * f64::from(row) / f64::from(rows),
                std::f64::consts::TAU * f64::from(column) / f64::from(columns),
            );
            let direction = DVec3::new(polar.sin() * around.sin(), polar.cos(), polar.sin() * around.cos());
            positions.push(direction * (1.0 + 0.2 * (9.0 * polar).sin() * (7.0 * around).sin()));
        }
    }
    let at = |row: u32, column: u32| match row {
        0 => 0,
        row if row == rows => 1,
        row => 2 + (row - 1) * columns + column % columns,
    };
    let mut faces = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
            faces.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    Mesh {
        name: "a sphere with bumps".to_owned(),
        file_vertices: (0..positions.len() as u32).collect(),
        normals: positions.iter().map(|position| position.normalize().as_vec3()).collect(),
        triangle_normals: faces.clone(),
        triangles: faces,
        positions,
        texture_coordinates: Vec::new(),
        triangle_texture_coordinates: Vec::new(),
        materials: Vec::new(),
        triangle_materials: Vec::new(),
        file_faces: Vec::new(),
        parts: Vec::new(),
        triangle_parts: Vec::new(),
        position_colors: Vec::new(),
        marked: Vec::new(),
        weld: tinta::tolerances::WELD,
        curves: Default::default(),
        defects: Defects::default(),
    }
}
