//! Shapes that need a file: normals, texture coordinates and skins as a model brings them, and a sheet of many vertices.

use glam::DVec3;
use std::path::Path;
use tinta::error::{Error, Result};
use tinta::mesh::{LoadOptions, Mesh, load};
use tinta::picture::{Picture, write_rgba_png};
use tinta::scene::Size;

/// A shape that is written into a file and read again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Written {
    /// A cube whose normals all point along (1, 2, 2), with this length; `None` writes no normals.
    Normals(Option<f64>),
    /// A square with a picture of 16 x 16 texels, whose texture coordinates are this much larger; `None` writes none.
    Coordinates(Option<f64>),
    /// A square with a picture of this width and height on it.
    Skin(u32, u32),
    /// A square cut into this many squares along each side.
    Sheet(u32),
}

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const CUBE_FACES: [[u32; 4]; 6] = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];

impl Written {
    /// Writes the shape into a folder and reads it.
    pub(super) fn mesh(self, folder: &Path) -> Result<Mesh> {
        let name = format!("{self:?}").replace(|letter: char| !letter.is_ascii_alphanumeric(), "-");
        match self {
            Self::Normals(length) => read(folder, &name, &cube(length)),
            Self::Coordinates(times) => square(folder, &name, times, Size { width: 16, height: 16 }),
            Self::Skin(width, height) => square(folder, &name, Some(1.0), Size { width, height }),
            Self::Sheet(cells) => sheet(cells),
        }
    }
}

fn cube(length: Option<f64>) -> String {
    let normal = length.map(|length| format!("vn {:e} {:e} {:e}\n", length / 3.0, length / 1.5, length / 1.5));
    let corner = |index: &u32| if normal.is_some() { format!(" {index}//1") } else { format!(" {index}") };
    let face = |corners: &[u32; 4]| format!("f{}\n", corners.iter().map(corner).collect::<String>());
    let faces: String = CUBE_FACES.iter().map(face).collect();
    format!("{CUBE}{}{faces}", normal.clone().unwrap_or_default())
}

fn square(folder: &Path, name: &str, times: Option<f64>, size: Size) -> Result<Mesh> {
    let chequer = |index: usize| match (index % size.width as usize / 2 + index / size.width as usize / 2) % 2 {
        0 => [210, 180, 120, 255],
        _ => [90, 60, 40, 255],
    };
    let picture = Picture { size, pixels: (0..size.pixel_count()).flat_map(chequer).collect() };
    write_rgba_png(&picture, &folder.join(format!("{name}.png")))?;
    write(folder, &format!("{name}.mtl"), &format!("newmtl skin\nmap_Kd {name}.png\n"))?;
    let (far, face) = match times {
        Some(times) => (format!("vt 0 0\nvt {times:e} 0\nvt {times:e} {times:e}\nvt 0 {times:e}\n"), "1/1 2/2 3/3 4/4"),
        None => (String::new(), "1 2 3 4"),
    };
    let text = format!("mtllib {name}.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n{far}usemtl skin\nf {face}\n");
    read(folder, name, &text)
}

fn sheet(cells: u32) -> Result<Mesh> {
    let at = |index: u32| f64::from(index) / f64::from(cells);
    let positions =
        (0..=cells).flat_map(|row| (0..=cells).map(move |column| DVec3::new(at(column), at(row), 0.0))).collect();
    let corner = |row: u32, column: u32| row * (cells + 1) + column;
    let cell = |row: u32, column: u32| {
        let [a, b] = [corner(row, column), corner(row, column + 1)];
        let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[u32; 3]> =
        (0..cells).flat_map(|row| (0..cells).flat_map(move |column| cell(row, column))).collect();
    Mesh::of_triangles("a sheet", positions, &triangles, &LoadOptions::default())
}

fn write(folder: &Path, name: &str, text: &str) -> Result<()> {
    let path = folder.join(name);
    std::fs::write(&path, text).map_err(|error| Error::output(&path, format!("it cannot be written ({error})")))
}

fn read(folder: &Path, name: &str, text: &str) -> Result<Mesh> {
    let file = format!("{name}.obj");
    write(folder, &file, text)?;
    Ok(load(&folder.join(file).to_string_lossy(), &LoadOptions::default())?.mesh)
}
