//! A polygon soup: a file's vertices and polygons as a reader found them.

use super::{Defects, Material, NONE, NamedPart, UpAxis};
use crate::error::{Error, Result};
use crate::limits::{MEMORY_FACTOR, MEMORY_SLACK_BYTES, TRIANGLES};
use crate::memory;
use glam::{DVec3, Vec2, Vec3};
use std::path::PathBuf;

/// A file's contents. Only two things are checked: every index is [`NONE`] or within its array, and every polygon has at least
/// three corners.
#[derive(Debug, Default)]
pub(super) struct Soup {
    /// All vertices in the file's order and units.
    pub positions: Vec<DVec3>,
    /// All normals; any length.
    pub normals: Vec<Vec3>,
    /// All texture coordinates.
    pub texture_coordinates: Vec<Vec2>,
    /// Colours at the vertices, red, green, blue in [0, 1]; empty or as many as positions.
    pub colors: Vec<[f32; 3]>,
    /// The polygons' corners one after the other.
    pub corners: Vec<Corner>,
    /// How many corners each polygon has; empty when all are triangles.
    pub polygon_sizes: Vec<u32>,
    /// Each polygon's material or [`NONE`]; empty without materials.
    pub polygon_materials: Vec<u32>,
    /// The materials.
    pub materials: Vec<Material>,
    /// For each material the folder, from the model's, of the file that describes it; empty if that is the model's.
    pub material_folders: Vec<PathBuf>,
    /// Each polygon's part or [`NONE`]; empty without parts.
    pub polygon_parts: Vec<u32>,
    /// The parts, each after the one that holds it.
    pub parts: Vec<NamedPart>,
    /// The names of the file's frames; the soup is one of them or between two. Empty if the format has none.
    pub frames: Vec<String>,
    /// Defects found by the reader.
    pub defects: Defects,
    /// Sides of polygons that the file marks as edges to draw, each by its two positions.
    pub marked: Vec<[u32; 2]>,
    /// The straight segments of curves, each between two positions.
    pub segments: Vec<[u32; 2]>,
    /// The positions of single points.
    pub points: Vec<u32>,
    /// The alternative up axis, for formats that do not name one.
    pub other_up: Option<UpAxis>,
    /// The files read besides the model's own: its material libraries, its data.
    pub files: Vec<PathBuf>,
    /// Bytes of those files that hold vertices and faces.
    pub bytes_beside: usize,
}

/// Scales a file's normal by a power of two, without rounding, to a length that f32 can square. A normal without a direction
/// stays so.
pub(super) fn direction(file: DVec3) -> Vec3 {
    let largest = file.abs().max_element();
    let is_sound = (1e-12..1e12).contains(&largest);
    if is_sound || !(file.is_finite() && largest > 0.0) {
        return file.as_vec3();
    }
    let power = largest.log2().floor();
    // In two halves, because the whole may exceed f64.
    let half = (-power / 2.0).floor();
    (file * half.exp2() * (-power - half).exp2()).as_vec3()
}

/// One corner of a polygon: indices into the soup's arrays, [`NONE`] where it has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Corner {
    /// Into `positions`; never [`NONE`].
    pub position: u32,
    /// Into `normals`.
    pub normal: u32,
    /// Into `texture_coordinates`.
    pub texture: u32,
}

impl Corner {
    /// A corner that has a position only.
    pub(super) fn at(position: u32) -> Self {
        Self { position, normal: NONE, texture: NONE }
    }
}

/// Whether a mesh with this many vertices, corners and triangles exceeds the memory allowed for files of `file_bytes`.
pub(super) fn is_too_much(file_bytes: usize, vertices: usize, corners: usize, triangles: usize) -> bool {
    /// Bytes per vertex, corner and triangle at the peak of building a mesh.
    const BYTES: [usize; 3] = [80, 12, 90];
    let most = file_bytes.saturating_mul(MEMORY_FACTOR).saturating_add(MEMORY_SLACK_BYTES);
    sum(vertices, corners, triangles, BYTES) > most || triangles > TRIANGLES
}

/// Bytes of so many vertices, corners and triangles.
fn sum(vertices: usize, corners: usize, triangles: usize, bytes: [usize; 3]) -> usize {
    let of_each =
        [vertices, corners, triangles].into_iter().zip(bytes).map(|(count, bytes)| count.saturating_mul(bytes));
    of_each.fold(0, usize::saturating_add)
}

/// Rejects a soup with this many vertices, corners and triangles if its mesh exceeds the free memory.
fn check_free(vertices: usize, corners: usize, triangles: usize, free: Option<u64>, name: &str) -> Result<()> {
    /// Further bytes per vertex, corner and triangle at that peak, beside those already allocated: a little less than measured.
    const BYTES: [usize; 3] = [10, 0, 60];
    memory::check(name, sum(vertices, corners, triangles, BYTES) as u64, free)
}

impl Soup {
    /// Returns the number of polygons.
    pub(super) fn polygon_count(&self) -> usize {
        if self.polygon_sizes.is_empty() { self.corners.len() / 3 } else { self.polygon_sizes.len() }
    }

    /// Writes the omitted sizes of the polygons so far, all triangles, for others to follow.
    pub(super) fn write_sizes(&mut self) {
        if self.polygon_sizes.is_empty() {
            self.polygon_sizes = vec![3; self.corners.len() / 3];
        }
    }

    /// Rejects a mesh that would exceed the memory allowed for a file of `file_bytes`. Exporters write more bytes per vertex
    /// and face, but two bytes can name a polygon's corner.
    pub(super) fn check_memory(&self, file_bytes: usize, name: &str) -> Result<()> {
        let triangles = self.corners.len().saturating_sub(2 * self.polygon_count());
        let file_bytes = file_bytes.saturating_add(self.bytes_beside);
        let (vertices, corners) = (self.positions.len(), self.corners.len());
        if !is_too_much(file_bytes, vertices, corners, triangles) {
            return check_free(vertices, corners, triangles, memory::free(), name);
        }
        Err(Error::model(
            name,
            format!(
                "its {} vertices and {triangles} triangles take more than {MEMORY_FACTOR} times the file's size in memory; \
                 export it again as triangles, or in another format",
                self.positions.len()
            ),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_that_memory_does_not_hold_is_refused_before_it_is_made() {
        // 10 million triangles take 0.6 GiB beside the soup.
        let check = |free| check_free(5_000_000, 30_000_000, 10_000_000, free, "a.obj");
        let message = check(Some(500 << 20)).unwrap_err().to_string();
        let sentence =
            "a.obj: it takes 0.6 GiB of memory, and 0.5 GiB are free; close other programs, or make it smaller";
        assert_eq!(message, sentence);
        assert!(check(Some(800 << 20)).is_ok() && check(None).is_ok());
        assert!(check_free(4, 12, 4, Some(0), "a.obj").is_ok(), "what is little is not looked at");
    }
}
