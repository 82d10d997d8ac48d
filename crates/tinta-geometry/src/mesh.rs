//! A model as triangles over welded positions, with its normals, texture coordinates and materials.
//!
//! In: a file's polygons (`Soup`, one reader a format). Out: [`Mesh`], which everything after it shares:
//! the edge list needs the welded positions, GL the corners' normals, the reference lines the f64 coordinates.
//! Positions stay in f64 and in the file's own units; what GL gets is recentred and scaled by the scene.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::{LoadOptions, load};
//!
//! let loaded = load("../../models/gear.obj", &LoadOptions::default())?;
//! assert_eq!(loaded.mesh.triangles.len(), 1880);
//! assert!(loaded.remarks.is_empty(), "nothing is wrong with it");
//! # Ok(())
//! # }
//! ```

pub mod defects;
mod folder;
mod format;
mod frame;
#[cfg(feature = "gltf")]
mod gltf;
mod hilbert;
pub mod load;
mod lying;
mod md2;
mod normals;
mod obj;
mod pieces;
mod ply;
mod skin;
mod soup;
mod stl;
mod text;
mod three_ds;
mod triangulate;
mod vertices;
mod weld;

use glam::{DVec3, Vec2, Vec3};
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

pub use defects::Defects;
pub use format::is_model_name;
pub use frame::ModelFrame;
#[cfg(feature = "gltf")]
pub use gltf::camera as gltf_camera;
pub use load::{
    LoadOptions, LoadStage, Loaded, Normals, UpAxis, load, load_watched, read_as, read_bytes, refuse_address,
};
pub use vertices::{Part, VertexArrays};
pub(crate) use weld::weld;

/// Stands in index arrays for "this corner has none".
pub const NONE: u32 = u32::MAX;

/// A triangle mesh with shared positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// How the user named it: a path or `builtin:…`.
    pub name: String,
    /// Welded positions in world space, file units, f64; each is used by at least one triangle.
    pub positions: Vec<DVec3>,
    /// For each position the lowest 0-based vertex number of the file that was welded into it.
    pub file_vertices: Vec<u32>,
    /// Colours at the positions, red, green, blue in [0, 1]; empty where the model has none.
    pub position_colors: Vec<[f32; 3]>,
    /// Each triangle's three positions, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, world space.
    pub normals: Vec<Vec3>,
    /// Each triangle corner's normal; as long as `triangles`.
    pub triangle_normals: Vec<[u32; 3]>,
    /// Texture coordinates, origin at the lower left; empty when the model has none.
    pub texture_coordinates: Vec<Vec2>,
    /// Each triangle corner's texture coordinate or [`NONE`]; empty or as long as `triangles`.
    pub triangle_texture_coordinates: Vec<[u32; 3]>,
    /// The model's materials; may be empty.
    pub materials: Vec<Material>,
    /// Each triangle's material or [`NONE`]; empty or as long as `triangles`.
    pub triangle_materials: Vec<u32>,
    /// What was wrong with the file.
    pub defects: Defects,
}

/// What a file says about a surface; the styles of the three texts use colour and texture only.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Material {
    /// Its name in the file.
    pub name: String,
    /// Diffuse colour, red, green, blue in [0, 1] (MTL `Kd`, glTF's base colour as sRGB); `None` where the file gives none.
    pub color: Option<[f32; 3]>,
    /// The colour texture's file (MTL `map_Kd`, an MD2 model's skin, glTF's base colour) where it was found; not opened until a style needs it.
    pub texture: Option<PathBuf>,
    /// The folder, by its real path, that the texture must still lie in when it is opened; `None`: anywhere.
    #[serde(skip)]
    pub texture_within: Option<PathBuf>,
    /// The colour texture where the model's own file holds it (glTF); then `texture` is `None`.
    #[serde(skip)]
    pub embedded: Option<Arc<EmbeddedPicture>>,
    /// What the colour texture is multiplied with, red, green, blue in [0, 1]: glTF's base colour, MTL's `Kd`; `None` for white.
    #[serde(skip)]
    pub texture_color: Option<[f32; 3]>,
    /// What the texture's alpha means.
    #[serde(skip)]
    pub texture_alpha: TextureAlpha,
}

/// What the alpha of a material's texture means. Nothing is drawn transparent: what would show through is white, as paper.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum TextureAlpha {
    /// Nothing: colours count as they are.
    #[default]
    Ignored,
    /// Texels of less alpha, of 255, are not there; others count as they are.
    Cutoff(u8),
    /// Colours are mixed by it.
    Blended,
}

impl Material {
    /// Whether it has a colour texture, in a file or in the model's own.
    pub fn has_texture(&self) -> bool {
        self.texture.is_some() || self.embedded.is_some()
    }
}

/// A picture file inside a model file; not decoded until a style needs it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EmbeddedPicture {
    /// The model and which of its pictures, for messages.
    pub name: String,
    /// The file's bytes: in a glTF model PNG or JPEG.
    pub bytes: Vec<u8>,
}

impl Mesh {
    /// One triangle in the plane z = 0, facing +z.
    pub fn triangle() -> Self {
        Self {
            name: "a triangle".to_owned(),
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            file_vertices: vec![0, 1, 2],
            position_colors: Vec::new(),
            triangles: vec![[0, 1, 2]],
            normals: vec![Vec3::Z],
            triangle_normals: vec![[0; 3]],
            texture_coordinates: Vec::new(),
            triangle_texture_coordinates: Vec::new(),
            materials: Vec::new(),
            triangle_materials: Vec::new(),
            defects: Defects::default(),
        }
    }

    /// A mesh of a program's own: triangles, counter-clockwise seen from outside, over positions in units of your choice.
    ///
    /// It goes the way of a file's: vertices are welded, triangles without area dropped and counted, normals computed.
    ///
    /// # Errors
    ///
    /// [`crate::Error::File`] when a triangle names a position that there is not, coordinates are too large, or nothing is
    /// left to draw; [`crate::Error::Strict`] and [`crate::Error::Setting`] as [`load()`] has them.
    pub fn of_triangles(
        name: &str,
        positions: Vec<DVec3>,
        triangles: &[[u32; 3]],
        options: &LoadOptions,
    ) -> crate::Result<Self> {
        Self::of_polygons(name, positions, triangles.as_flattened(), Vec::new(), options)
    }

    /// The same of polygons, which are cut into triangles as a file's are: all their corners one after the other, and how many
    /// each of them has, at least 3; where no sizes are given, all are triangles.
    ///
    /// ```
    /// # fn main() -> tinta_geometry::Result<()> {
    /// use glam::DVec3;
    /// use tinta_geometry::{LoadOptions, Mesh};
    ///
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
    /// let square = Mesh::of_polygons("a square", corners, &[0, 1, 2, 3], vec![4], &LoadOptions::default())?;
    /// assert_eq!(square.triangles.len(), 2);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Mesh::of_triangles`], and [`crate::Error::File`] for sizes that are not those of the corners.
    pub fn of_polygons(
        name: &str,
        positions: Vec<DVec3>,
        corners: &[u32],
        sizes: Vec<u32>,
        options: &LoadOptions,
    ) -> crate::Result<Self> {
        load::check(options)?;
        if corners.iter().any(|index| *index as usize >= positions.len()) {
            let problem = format!("a face uses a position that does not exist; there are {}", positions.len());
            return Err(crate::Error::model(name, problem));
        }
        let counted: u64 = sizes.iter().map(|size| u64::from(*size)).sum();
        let is_even = if sizes.is_empty() { corners.len().is_multiple_of(3) } else { counted == corners.len() as u64 };
        if !is_even || sizes.iter().any(|size| *size < 3) {
            let problem = format!("its faces do not have {} corners together, and 3 or more each", corners.len());
            return Err(crate::Error::model(name, problem));
        }
        let corners = corners.iter().map(|index| soup::Corner::at(*index)).collect();
        let soup = soup::Soup { positions, corners, polygon_sizes: sizes, ..soup::Soup::default() };
        soup.into_mesh(name, options)
    }

    /// Bytes of main memory the mesh takes, materials' names aside.
    pub fn memory_bytes(&self) -> usize {
        bytes_of(&self.positions)
            + bytes_of(&self.file_vertices)
            + bytes_of(&self.position_colors)
            + bytes_of(&self.triangles)
            + bytes_of(&self.normals)
            + bytes_of(&self.triangle_normals)
            + bytes_of(&self.texture_coordinates)
            + bytes_of(&self.triangle_texture_coordinates)
            + bytes_of(&self.triangle_materials)
    }

    /// Smallest and largest corner of the axis-aligned bounding box, world space, file units.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        bounds(&self.positions)
    }
}

/// The unit normal of a triangle, counter-clockwise seen from its tip; `None` if it has no area.
///
/// Scaled before and after the product, so that neither tiny nor huge nor needle-thin triangles lose it to rounding alone.
pub(crate) fn triangle_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (first, second) = (b - a, c - a);
    let scale = first.abs().max(second.abs()).max_element();
    let product = (first / scale).cross(second / scale);
    (product / product.abs().max_element()).try_normalize()
}

/// Bytes set aside for a list.
fn bytes_of<T>(list: &Vec<T>) -> usize {
    list.capacity() * size_of::<T>()
}

/// Smallest and largest corner of some points' bounding box; infinities, inverted, for no points.
pub fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| (low.min(*point), high.max(*point)))
}
