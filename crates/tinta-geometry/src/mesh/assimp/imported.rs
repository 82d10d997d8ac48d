//! A file as libassimp imported it: plain lists, copied out of the library and not yet checked.

/// What the library made of a file.
#[derive(Debug, Default)]
pub(super) struct Imported {
    pub meshes: Vec<ImportedMesh>,
    /// The tree's root first, every node after the one it lies below.
    pub nodes: Vec<ImportedNode>,
    pub materials: Vec<ImportedMaterial>,
    pub animations: usize,
}

/// Vertices and polygons of one material.
#[derive(Debug, Default)]
pub(super) struct ImportedMesh {
    pub positions: Vec<[f32; 3]>,
    /// As many as positions, or none; so the next.
    pub normals: Vec<[f32; 3]>,
    /// Origin at the lower left.
    pub texture_coordinates: Vec<[f32; 3]>,
    /// The polygons' corners one after the other.
    pub indices: Vec<u32>,
    /// How many corners each polygon has; points have one, lines two.
    pub sizes: Vec<u32>,
    pub material: u32,
    pub has_colors: bool,
}

/// A place in the scene.
#[derive(Debug)]
pub(super) struct ImportedNode {
    pub parent: Option<usize>,
    /// Parent from node, row after row.
    pub matrix: [f32; 16],
    pub meshes: Vec<u32>,
}

/// A surface.
#[derive(Debug, Default)]
pub(super) struct ImportedMaterial {
    pub name: String,
    pub color: Option<[f32; 3]>,
    /// Its picture's name in the file.
    pub texture: Option<String>,
}
