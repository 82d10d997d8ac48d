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
    /// How the reader turned the positions from the file's axes.
    pub turn: Option<fn(DVec3) -> DVec3>,
    /// The alternative up axis, for formats that do not name one.
    pub other_up: Option<UpAxis>,
    /// Whether its reader has looked for its materials' pictures, which else are names.
    pub has_pictures: bool,
    /// The files read besides the model's own: its material libraries, its data.
    pub files: Vec<PathBuf>,
    /// Bytes of those files that hold vertices and faces.
    pub bytes_beside: usize,
    /// Whether it may hold one mesh several times: then its reader has compared a single one with the file's size.
    pub has_copies: bool,
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

/// How many of the last bytes only fill a file up.
pub(super) fn padding(bytes: &[u8]) -> usize {
    bytes.iter().rev().take_while(|byte| **byte == 0 || byte.is_ascii_whitespace()).count()
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

/// The amount of data that a mesh is built from.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Size {
    pub vertices: usize,
    pub corners: usize,
    pub triangles: usize,
    /// Segments and points.
    pub curves: usize,
}

impl Size {
    /// Bytes per vertex, corner, triangle, segment or point at the peak of building a mesh.
    const PEAK_BYTES: [usize; 4] = [80, 12, 90, 40];

    fn bytes(self, of_each: [usize; 4]) -> usize {
        let Self { vertices, corners, triangles, curves } = self;
        let counts = [vertices, corners, triangles, curves].into_iter().zip(of_each);
        counts.map(|(count, bytes)| count.saturating_mul(bytes)).fold(0, usize::saturating_add)
    }

    /// Whether its mesh exceeds the memory allowed for files of `file_bytes`.
    pub(super) fn is_too_much(self, file_bytes: usize) -> bool {
        self.bytes(Self::PEAK_BYTES) > bytes_allowed(file_bytes) || self.triangles > TRIANGLES
    }

    /// Rejects a soup of this size if its mesh exceeds the free memory.
    fn check_free(self, free: Option<u64>, name: &str) -> Result<()> {
        /// Further bytes of each at that peak, beside those already allocated: a little less than measured.
        const BYTES: [usize; 4] = [10, 0, 60, 0];
        memory::check(name, self.bytes(BYTES) as u64, free)
    }
}

/// Of the formats that write copies.
#[cfg(any(feature = "3mf", feature = "gltf"))]
impl Size {
    /// This and more.
    pub(super) fn plus(self, more: Self) -> Self {
        Self {
            vertices: self.vertices.saturating_add(more.vertices),
            corners: self.corners.saturating_add(more.corners),
            triangles: self.triangles.saturating_add(more.triangles),
            curves: self.curves.saturating_add(more.curves),
        }
    }

    /// So many times this.
    #[cfg(feature = "gltf")]
    pub(super) fn times(self, count: usize) -> Self {
        Self {
            vertices: self.vertices.saturating_mul(count),
            corners: self.corners.saturating_mul(count),
            triangles: self.triangles.saturating_mul(count),
            curves: self.curves.saturating_mul(count),
        }
    }

    /// Whether there is more than 32 bits count.
    pub(super) fn is_beyond_count(self) -> bool {
        self.vertices.max(self.triangles).max(self.curves) > TRIANGLES
    }

    /// Rejects a mesh that holds copies, before they are made, if it exceeds the free memory: the file's size does not bound it.
    /// Where the system does not tell its free memory, [`COPIES_BYTES`](crate::limits::COPIES_BYTES) bound it beside that size. The
    /// error is a sentence without the file's name.
    pub(super) fn check_copies(self, file_bytes: usize, free: Option<u64>) -> std::result::Result<(), String> {
        let most = free.unwrap_or_else(|| crate::limits::COPIES_BYTES.max(bytes_allowed(file_bytes) as u64));
        memory::refusal(self.bytes(Self::PEAK_BYTES) as u64, Some(most)).map_or(Ok(()), Err)
    }
}

/// Bytes that a mesh from files of `file_bytes` may take.
fn bytes_allowed(file_bytes: usize) -> usize {
    file_bytes.saturating_mul(MEMORY_FACTOR).saturating_add(MEMORY_SLACK_BYTES)
}

impl Soup {
    /// Turns all positions from the file's axes.
    pub(super) fn turn_by(&mut self, turn: fn(DVec3) -> DVec3) {
        self.positions.iter_mut().for_each(|position| *position = turn(*position));
        self.turn = Some(turn);
    }

    /// Returns the number of polygons.
    pub(super) fn polygon_count(&self) -> usize {
        if self.polygon_sizes.is_empty() { self.corners.len() / 3 } else { self.polygon_sizes.len() }
    }

    /// Returns how much of everything it holds.
    pub(super) fn size(&self) -> Size {
        let corners = self.corners.len();
        let triangles = corners.saturating_sub(2 * self.polygon_count());
        let curves = self.segments.len() + self.points.len();
        Size { vertices: self.positions.len(), corners, triangles, curves }
    }

    /// Writes the omitted sizes of the polygons so far, all triangles, for others to follow.
    pub(super) fn write_sizes(&mut self) {
        if self.polygon_sizes.is_empty() {
            self.polygon_sizes = vec![3; self.corners.len() / 3];
        }
    }

    /// Notes a file's contents beyond its header's promise, in words and by count, and an unread rest; returns a sentence.
    pub(super) fn note_more(&mut self, path: &str, promise: &str, of: [usize; 2], unread: &[u8]) -> Option<String> {
        let [promised, has] = of;
        let (is_whole, more) = (padding(unread) == unread.len(), has - promised);
        self.defects.unpromised = more + usize::from(!is_whole);
        let found =
            if is_whole { format!(", the file has {has}") } else { "; what follows them is not read".to_owned() };
        (more > 0 || !is_whole).then(|| format!("{path}: its header promises {promise}{found}"))
    }

    /// Rejects a mesh that would exceed the memory allowed for a file of `file_bytes`. Exporters write more bytes per vertex
    /// and face, but two bytes can name a polygon's corner.
    pub(super) fn check_memory(&self, file_bytes: usize, name: &str) -> Result<()> {
        let size = self.size();
        if self.has_copies || !size.is_too_much(file_bytes.saturating_add(self.bytes_beside)) {
            return size.check_free(memory::free(), name);
        }
        Err(Error::model(
            name,
            format!(
                "its {} vertices and {} triangles take more than {MEMORY_FACTOR} times the file's size in memory; \
                 export it again as triangles, or in another format",
                size.vertices, size.triangles
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
        let size = Size { vertices: 5_000_000, corners: 30_000_000, triangles: 10_000_000, curves: 0 };
        let check = |free| size.check_free(free, "a.obj");
        let message = check(Some(500 << 20)).unwrap_err().to_string();
        let sentence =
            "a.obj: it takes 0.6 GiB of memory, and 0.5 GiB are free; close other programs, or make it smaller";
        assert_eq!(message, sentence);
        assert!(check(Some(800 << 20)).is_ok() && check(None).is_ok());
        let little = Size { vertices: 4, corners: 12, triangles: 4, curves: 0 };
        assert!(little.check_free(Some(0), "a.obj").is_ok(), "what is little is not looked at");
    }

    #[cfg(feature = "gltf")]
    #[test]
    fn copies_are_bounded_by_free_memory_and_by_a_limit_where_nobody_tells_it() {
        // A million triangles of half as many vertices take 0.16 GiB while their mesh is built.
        let million = Size { vertices: 500_000, corners: 3_000_000, triangles: 1_000_000, curves: 0 };
        assert!(million.times(10).check_copies(0, None).is_ok());
        assert!(million.times(100).check_copies(0, Some(17 << 30)).is_ok());
        let sentence = "it takes 15.5 GiB of memory, and 2.0 GiB are free; close other programs, or make it smaller";
        assert_eq!(million.times(100).check_copies(1000, None), Err(sentence.to_owned()));
        // As much as any other file of a gibibyte may take.
        assert!(million.times(100).check_copies(1 << 30, None).is_ok());
        assert!(!million.times(1000).is_beyond_count() && million.times(1100).is_beyond_count());
        assert!(million.times(usize::MAX).is_beyond_count(), "without an overflow");
    }
}
