//! Triangles over shared positions, with their normals, texture coordinates and materials.

use super::{Curves, Defects};
use crate::threads::filled;
use crate::tolerances::WELD;
use glam::{DVec3, Vec2, Vec3};
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Means "this corner has none" in index arrays.
pub const NONE: u32 = u32::MAX;

/// A triangle mesh with shared positions.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// The user's name for the model: a path or `builtin:…`.
    pub name: String,
    /// Welded positions in world space, file units, f64; each is used by at least one triangle. Empty for a model of curves and
    /// points alone.
    pub positions: Vec<DVec3>,
    /// For each position the lowest 0-based vertex number of the file that was welded into it.
    pub file_vertices: Vec<u32>,
    /// Colours at the positions, red, green, blue in [0, 1]; empty where the model has none.
    pub position_colors: Vec<[f32; 3]>,
    /// Each triangle's three positions, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Normals, world space: unit vectors, or shorter ones where [`Normals::Lasting`](super::Normals::Lasting) averages them.
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
    /// Each triangle's 0-based face among those of the file; empty where that is the triangle's own number.
    pub file_faces: Vec<u32>,
    /// The model's parts, each after the one that holds it; may be empty.
    pub parts: Vec<NamedPart>,
    /// Each triangle's part or [`NONE`]; empty or as long as `triangles`.
    pub triangle_parts: Vec<u32>,
    /// The edges that the file marks as edges to draw, each by its two positions, the lower first; ascending.
    pub marked: Vec<[u32; 2]>,
    /// The share of its size below which its vertices were joined, as in [`LoadOptions::weld`](super::LoadOptions::weld).
    pub weld: f64,
    /// Curves and points beside the surface.
    pub curves: Curves,
    /// The file's defects.
    pub defects: Defects,
}

/// A part of a model: an object or a group of an OBJ file, a node of a glTF file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedPart {
    /// Its name in the file.
    pub name: String,
    /// The part that holds it, by its number, which is lower; or [`NONE`].
    pub within: u32,
}

/// A surface's material; the styles of the three texts use colour and texture only.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Material {
    /// Its name in the file.
    pub name: String,
    /// Diffuse colour, red, green, blue in [0, 1] (MTL `Kd`, glTF's base colour as sRGB); `None` where the file gives none.
    pub color: Option<[f32; 3]>,
    /// The colour texture's file (MTL `map_Kd`, an MD2 model's skin, glTF's base colour), if found; opened only when a style
    /// needs it.
    pub texture: Option<PathBuf>,
    /// The folder, by its real path, that the texture must still lie in when it is opened; `None`: anywhere.
    #[serde(skip)]
    pub texture_within: Option<PathBuf>,
    /// The colour texture where the model's own file holds it (glTF); then `texture` is `None`.
    #[serde(skip)]
    pub embedded: Option<Arc<EmbeddedPicture>>,
    /// Factor of the colour texture, red, green, blue in [0, 1]: glTF's base colour, MTL's `Kd`; `None` for white.
    #[serde(skip)]
    pub texture_color: Option<[f32; 3]>,
    /// The meaning of the texture's alpha.
    #[serde(skip)]
    pub texture_alpha: TextureAlpha,
    /// Whether the colour was chosen for a part, so that no other replaces it.
    #[serde(skip)]
    pub is_fill: bool,
}

/// The meaning of a texture's alpha. Surfaces are never drawn transparent: anything behind them shows as white, like paper.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum TextureAlpha {
    /// Ignored: colours keep their values.
    #[default]
    Ignored,
    /// Texels below this alpha, of 255, are left out; others keep their colours.
    Cutoff(u8),
    /// Blends colours, times this factor of red, green, blue and alpha, of 255.
    Blended([u8; 4]),
}

impl Material {
    /// Whether it has a colour texture, in a file or in the model's own.
    pub fn has_texture(&self) -> bool {
        self.texture.is_some() || self.embedded.is_some()
    }

    /// Blends its colour, and its texture by the texture's alpha, with white: it is this opaque, from 0 to 1.
    pub(crate) fn blend(&mut self, opacity: f32) {
        let [red, green, blue] = self.texture_color.unwrap_or([1.0; 3]);
        let factor = [red, green, blue, opacity].map(|share| (share * 255.0).round() as u8);
        self.texture_alpha = TextureAlpha::Blended(factor);
        self.texture_color = None;
        self.color = self.color.map(|color| color.map(|channel| channel * opacity + (1.0 - opacity)));
    }
}

/// A picture file inside a model file, decoded only when a style needs it.
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
            triangles: vec![[0, 1, 2]],
            normals: vec![Vec3::Z],
            triangle_normals: vec![[0; 3]],
            weld: WELD,
            ..Self::default()
        }
    }

    /// Whether it has no face, curve or point: a section may leave nothing.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.curves.is_empty()
    }

    /// The 0-based face of the file that a triangle is, or is cut from.
    pub fn file_face(&self, triangle: u32) -> u32 {
        self.file_faces.get(triangle as usize).copied().unwrap_or(triangle)
    }

    /// The numbers of a triangle's part and material, [`NONE`] for none.
    pub fn part_and_material(&self, triangle: usize) -> [u32; 2] {
        [&self.triangle_parts, &self.triangle_materials].map(|list| list.get(triangle).copied().unwrap_or(NONE))
    }

    /// Returns a triangle's corners; `None` if one does not exist.
    pub(crate) fn corners(&self, triangle: &[u32; 3]) -> Option<[DVec3; 3]> {
        let corner = |position: u32| self.positions.get(position as usize).copied();
        Some([corner(triangle[0])?, corner(triangle[1])?, corner(triangle[2])?])
    }

    /// Returns the smallest and largest corner of the surface's axis-aligned bounding box, world space, file units; inverted
    /// infinities without faces.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        bounds(&self.positions)
    }

    /// Returns the same for all that may be drawn: the surface, curves and points.
    pub fn extent(&self) -> (DVec3, DVec3) {
        let ((low, high), (curves_low, curves_high)) = (self.bounds(), bounds(&self.curves.positions));
        (low.min(curves_low), high.max(curves_high))
    }

    /// The positions of the surface, its curves and points.
    pub(crate) fn all_positions(&self) -> impl Iterator<Item = DVec3> + Clone {
        self.positions.iter().chain(&self.curves.positions).copied()
    }
}

/// Returns the unit normal of a triangle, counter-clockwise seen from its tip; `None` if it has no area.
///
/// The sides are scaled before and after the product, to save tiny, huge and needle-thin triangles from rounding.
pub(crate) fn triangle_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (first, second) = (b - a, c - a);
    let scale = first.abs().max(second.abs()).max_element();
    let product = (first / scale).cross(second / scale);
    (product / product.abs().max_element()).try_normalize()
}

/// Returns the smallest and largest corner of the points' bounding box; inverted infinities for no points.
pub fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| (low.min(*point), high.max(*point)))
}

/// Computes the unit normals of all faces; NaN for a face without area, which makes every comparison with it fail.
pub(crate) fn face_normals(mesh: &Mesh, threads: usize) -> Vec<[f64; 3]> {
    let normal = |triangle: &[u32; 3]| {
        let Some([a, b, c]) = mesh.corners(triangle) else { return DVec3::NAN };
        let product = (b - a).cross(c - a);
        let squared = product.length_squared();
        // Plain arithmetic unless it overflows, underflows or loses a needle; the careful way otherwise.
        if (1e-200..1e200).contains(&squared) {
            product / squared.sqrt()
        } else {
            triangle_normal([a, b, c]).unwrap_or(DVec3::NAN)
        }
    };
    filled(mesh.triangles.len(), threads, [0.0; 3], |face| normal(&mesh.triangles[face]).to_array())
}
