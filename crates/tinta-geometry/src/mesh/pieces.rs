//! A soup's polygons as triangles with area, each once, with what belongs to their corners.
//!
//! In: polygons and the vertices' welding. Out: triangles over welded but not yet renumbered positions.

use super::soup::{Corner, Soup};
use super::{NONE, triangle_normal, triangulate};
use crate::threads::{in_parallel, sort_by, threads_for};
use earcut::Earcut;
use glam::DVec3;

/// Triangles in the polygons' order; lists as long as `triangles`, or empty where the soup has nothing for them.
#[derive(Default)]
pub(super) struct Pieces {
    pub triangles: Vec<[u32; 3]>,
    /// Each triangle's unit normal.
    pub face_normals: Vec<DVec3>,
    pub normals: Vec<[u32; 3]>,
    pub texture_coordinates: Vec<[u32; 3]>,
    pub materials: Vec<u32>,
    /// How many triangles had no area.
    pub degenerate: usize,
    /// How many repeated another.
    pub duplicate: usize,
}

impl Pieces {
    /// All triangles with area of the polygons whose vertices are finite.
    pub(super) fn of(soup: &Soup, finite: &[bool], welded: &[u32]) -> Self {
        let starts = starts(soup);
        let count = soup.polygon_count();
        let pieces = in_parallel(count, threads_for(count), |polygons| {
            let mut pieces = Self::default();
            pieces.reserve(polygons.len(), soup);
            let (mut earcut, mut cut, mut points) = (Earcut::new(), Vec::new(), Vec::new());
            for polygon in polygons {
                let corners = match starts.as_slice() {
                    [] => &soup.corners[polygon * 3..][..3],
                    starts => &soup.corners[starts[polygon] as usize..starts[polygon + 1] as usize],
                };
                let material = soup.polygon_materials.get(polygon).copied().unwrap_or(NONE);
                if corners.iter().any(|corner| !finite[corner.position as usize]) {
                    continue;
                }
                if let [a, b, c] = *corners {
                    pieces.push(soup, welded, [a, b, c], material);
                    continue;
                }
                points.clear();
                points.extend(corners.iter().map(|corner| soup.positions[corner.position as usize]));
                triangulate::triangulate(&points, &mut earcut, &mut cut);
                // A polygon whose area earcut cannot find loses triangles there: they are as good as degenerate.
                pieces.degenerate += (corners.len() - 2).saturating_sub(cut.len());
                cut.iter().for_each(|triangle| {
                    pieces.push(soup, welded, triangle.map(|index| corners[index as usize]), material);
                });
            }
            pieces
        });
        let mut pieces = pieces.into_iter();
        let mut all = pieces.next().unwrap_or_default();
        all.reserve(count.saturating_sub(all.triangles.len()), soup);
        pieces.for_each(|piece| all.append(piece));
        all
    }

    /// Room for so many triangles of a soup.
    fn reserve(&mut self, count: usize, soup: &Soup) {
        self.triangles.reserve_exact(count);
        self.face_normals.reserve_exact(count);
        self.normals.reserve_exact(count);
        if !soup.texture_coordinates.is_empty() {
            self.texture_coordinates.reserve_exact(count);
        }
        if !soup.polygon_materials.is_empty() {
            self.materials.reserve_exact(count);
        }
    }

    /// Adds a triangle, or counts it where it has no area.
    fn push(&mut self, soup: &Soup, welded: &[u32], corners: [Corner; 3], material: u32) {
        let triangle = corners.map(|corner| welded[corner.position as usize]);
        let Some(face_normal) = triangle_normal(triangle.map(|index| soup.positions[index as usize])) else {
            self.degenerate += 1;
            return;
        };
        self.triangles.push(triangle);
        self.face_normals.push(face_normal);
        self.normals.push(corners.map(|corner| corner.normal));
        if !soup.texture_coordinates.is_empty() {
            self.texture_coordinates.push(corners.map(|corner| corner.texture));
        }
        if !soup.polygon_materials.is_empty() {
            self.materials.push(material);
        }
    }

    fn append(&mut self, mut other: Self) {
        self.triangles.append(&mut other.triangles);
        self.face_normals.append(&mut other.face_normals);
        self.normals.append(&mut other.normals);
        self.texture_coordinates.append(&mut other.texture_coordinates);
        self.materials.append(&mut other.materials);
        self.degenerate += other.degenerate;
    }

    /// Drops triangles that repeat an earlier one with the same orientation; the opposite side is another triangle.
    pub(super) fn drop_duplicates(&mut self) {
        // A triangle turned so that its lowest vertex comes first, and its number, as one number.
        let turned = |(index, [a, b, c]): (usize, [u32; 3])| {
            let [a, b, c] = if a < b && a < c {
                [a, b, c]
            } else if b < c {
                [b, c, a]
            } else {
                [c, a, b]
            };
            [a, b, c, index as u32].iter().fold(0, |number, part| number << 32 | u128::from(*part))
        };
        let mut order: Vec<u128> = self.triangles.iter().copied().enumerate().map(turned).collect();
        sort_by(&mut order, threads_for(self.triangles.len()), u128::cmp);
        let pairs = order.windows(2).filter(|pair| pair[0] >> 32 == pair[1] >> 32);
        let mut repeated: Vec<u32> = pairs.map(|pair| pair[1] as u32).collect();
        if repeated.is_empty() {
            return;
        }
        repeated.sort_unstable();
        self.duplicate += repeated.len();
        let keep: Vec<bool> =
            (0..self.triangles.len() as u32).map(|index| repeated.binary_search(&index).is_err()).collect();
        retain(&mut self.triangles, &keep);
        retain(&mut self.face_normals, &keep);
        retain(&mut self.normals, &keep);
        retain(&mut self.texture_coordinates, &keep);
        retain(&mut self.materials, &keep);
    }
}

/// Where each polygon's corners begin, and where the last one's end; empty where all are triangles.
fn starts(soup: &Soup) -> Vec<u32> {
    if soup.polygon_sizes.is_empty() {
        return Vec::new();
    }
    let ends = soup.polygon_sizes.iter().scan(0, |end, size| {
        *end += size;
        Some(*end)
    });
    std::iter::once(0).chain(ends).collect()
}

fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    items.retain(|_| flags.next().copied().unwrap_or(false));
}
