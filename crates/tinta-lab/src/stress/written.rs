//! Shapes that need a file: normals, texture coordinates and skins as a model brings them.

use std::path::Path;
use tinta::error::{Error, Result};
use tinta::mesh::{LoadOptions, Mesh, load};
use tinta::picture::{Picture, write_rgba_png};
use tinta::scene::Size;

/// A shape that is written into a file and read again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrittenShape {
    /// A cube whose normals all point along (1, 2, 2), with this length; `None` writes no normals.
    Normals(Option<f64>),
    /// A square with a picture of 16 x 16 texels, whose texture coordinates are this much larger; `None` writes none.
    Coordinates(Option<f64>),
    /// A square with a picture of this width and height on it.
    Skin(u32, u32),
}

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const CUBE_FACES: [[u32; 4]; 6] = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];

impl WrittenShape {
    /// Writes the shape into a folder of its own below this one, which stays because pictures are read when they are drawn.
    pub(super) fn mesh(self, folder: &Path, options: &LoadOptions) -> Result<Mesh> {
        let own = tempfile::tempdir_in(folder)
            .map_err(|error| Error::output(folder, format!("no folder in it ({error})")))?;
        let folder = &own.keep();
        match self {
            Self::Normals(length) => read(folder, &cube(length), options),
            Self::Coordinates(times) => square(folder, times, Size { width: 16, height: 16 }, options),
            Self::Skin(width, height) => square(folder, Some(1.0), Size { width, height }, options),
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

fn square(folder: &Path, times: Option<f64>, size: Size, options: &LoadOptions) -> Result<Mesh> {
    let chequer = |index: usize| match (index % size.width as usize / 2 + index / size.width as usize / 2) % 2 {
        0 => [210, 180, 120, 255],
        _ => [90, 60, 40, 255],
    };
    let picture = Picture { size, pixels: (0..size.pixel_count()).flat_map(chequer).collect() };
    write_rgba_png(&picture, &folder.join("skin.png"))?;
    write(folder, "skin.mtl", "newmtl skin\nmap_Kd skin.png\n")?;
    let (far, face) = match times {
        Some(times) => (format!("vt 0 0\nvt {times:e} 0\nvt {times:e} {times:e}\nvt 0 {times:e}\n"), "1/1 2/2 3/3 4/4"),
        None => (String::new(), "1 2 3 4"),
    };
    let text = format!("mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n{far}usemtl skin\nf {face}\n");
    read(folder, &text, options)
}

fn write(folder: &Path, name: &str, text: &str) -> Result<()> {
    let path = folder.join(name);
    std::fs::write(&path, text).map_err(|error| Error::output(&path, format!("it cannot be written ({error})")))
}

fn read(folder: &Path, text: &str, options: &LoadOptions) -> Result<Mesh> {
    write(folder, "shape.obj", text)?;
    Ok(load(&folder.join("shape.obj").to_string_lossy(), options)?.mesh)
}
