//! Cuts a soup's polygons into triangles with area, each once, with their corners' attributes.
//!
//! In: polygons and the vertices' welding. Out: triangles over welded but not yet renumbered positions.

use super::soup::{Corner, Soup};
use super::triangulate::{self, Cut};
use super::{NONE, triangle_normal};
use crate::threads::{in_parallel, threads_for};
use earcut::Earcut;
use glam::DVec3;

/// Triangles in the polygons' order; each list is as long as `triangles`, or empty if the soup has no such data.
#[derive(Default)]
pub(super) struct Pieces {
    pub triangles: Vec<[u32; 3]>,
    /// Each triangle's unit normal.
    pub face_normals: Vec<DVec3>,
    pub normals: Vec<[u32; 3]>,
    pub texture_coordinates: Vec<[u32; 3]>,
    pub materials: Vec<u32>,
    /// Each triangle's polygon; empty unless numbered.
    pub polygons: Vec<u32>,
    /// Whether a triangle has another number than its polygon, counted from the first.
    is_numbered: bool,
    /// The first polygon.
    first: usize,
    pub parts: Vec<u32>,
    /// How many triangles had no area.
    pub degenerate: usize,
    /// How many polygons had too many corners to be cut.
    pub too_long: usize,
    /// How many polygons cross themselves.
    pub crossing: usize,
    /// How many repeated another.
    pub duplicate: usize,
    /// How many polygons named a corner twice in a row.
    pub repeated_corners: usize,
}

impl Pieces {
    /// Returns all triangles with area of the polygons with finite vertices.
    pub(super) fn of(soup: &Soup, finite: &[bool], welded: &[u32]) -> Self {
        let starts = starts(soup);
        let count = soup.polygon_count();
        let pieces = in_parallel(count, threads_for(count), |polygons| {
            let mut pieces = Self { first: polygons.start, ..Self::default() };
            pieces.reserve(polygons.len(), soup);
            let (mut earcut, mut cut, mut points, mut once) = (Earcut::new(), Vec::new(), Vec::new(), Vec::new());
            for polygon in polygons {
                let corners = match starts.as_slice() {
                    [] => &soup.corners[polygon * 3..][..3],
                    starts => &soup.corners[starts[polygon] as usize..starts[polygon + 1] as usize],
                };
                if corners.iter().any(|corner| !finite[corner.position as usize]) {
                    continue;
                }
                if let [a, b, c] = *corners {
                    pieces.push(soup, welded, [a, b, c], polygon);
                    continue;
                }
                once.clear();
                once.extend_from_slice(corners);
                once.dedup_by_key(|corner| corner.position);
                while once.len() > 1 && once.first().map(|own| own.position) == once.last().map(|own| own.position) {
                    once.pop();
                }
                pieces.repeated_corners += usize::from(once.len() < corners.len());
                let corners = once.as_slice();
                if corners.len() <= 3 {
                    match *corners {
                        [a, b, c] => pieces.push(soup, welded, [a, b, c], polygon),
                        _ => pieces.degenerate += 1,
                    }
                    continue;
                }
                points.clear();
                points.extend(corners.iter().map(|corner| soup.positions[corner.position as usize]));
                match triangulate::triangulate(&points, &mut earcut, &mut cut) {
                    Cut::Whole => {}
                    Cut::Crossing => pieces.crossing += 1,
                    Cut::TooLong => {
                        pieces.too_long += 1;
                        continue;
                    }
                }
                // If earcut finds no area, the lost triangles count as degenerate.
                pieces.degenerate += (corners.len() - 2).saturating_sub(cut.len());
                cut.iter().for_each(|triangle| {
                    pieces.push(soup, welded, triangle.map(|index| corners[index as usize]), polygon);
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
        if !soup.polygon_parts.is_empty() {
            self.parts.reserve_exact(count);
        }
    }

    /// Adds a triangle of a polygon, or counts it where it has no area.
    fn push(&mut self, soup: &Soup, welded: &[u32], corners: [Corner; 3], polygon: usize) {
        let triangle = corners.map(|corner| welded[corner.position as usize]);
        let Some(face_normal) = triangle_normal(triangle.map(|index| soup.positions[index as usize])) else {
            self.degenerate += 1;
            return;
        };
        if polygon != self.first + self.triangles.len() {
            self.number();
        }
        if self.is_numbered {
            self.polygons.push(polygon as u32);
        }
        self.triangles.push(triangle);
        self.face_normals.push(face_normal);
        self.normals.push(corners.map(|corner| corner.normal));
        if !soup.texture_coordinates.is_empty() {
            self.texture_coordinates.push(corners.map(|corner| corner.texture));
        }
        if !soup.polygon_materials.is_empty() {
            self.materials.push(soup.polygon_materials.get(polygon).copied().unwrap_or(NONE));
        }
        if !soup.polygon_parts.is_empty() {
            self.parts.push(soup.polygon_parts.get(polygon).copied().unwrap_or(NONE));
        }
    }

    /// Writes down each triangle's polygon.
    fn number(&mut self) {
        if !std::mem::replace(&mut self.is_numbered, true) {
            self.polygons = (self.first as u32..).take(self.triangles.len()).collect();
        }
    }

    fn append(&mut self, mut other: Self) {
        if self.is_numbered || other.is_numbered || other.first != self.first + self.triangles.len() {
            self.number();
            other.number();
        }
        self.triangles.append(&mut other.triangles);
        self.face_normals.append(&mut other.face_normals);
        self.normals.append(&mut other.normals);
        self.texture_coordinates.append(&mut other.texture_coordinates);
        self.materials.append(&mut other.materials);
        self.polygons.append(&mut other.polygons);
        self.parts.append(&mut other.parts);
        self.degenerate += other.degenerate;
        self.repeated_corners += other.repeated_corners;
    }

    /// Drops triangles that repeat an earlier one with the same orientation; the opposite side is another triangle.
    ///
    /// `vertices` is the total number of vertices.
    pub(super) fn drop_duplicates(&mut self, vertices: usize) {
        let mut repeated = repeated(&self.triangles, vertices);
        if repeated.is_empty() {
            return;
        }
        repeated.sort_unstable();
        self.number();
        self.duplicate += repeated.len();
        let keep: Vec<bool> =
            (0..self.triangles.len() as u32).map(|index| repeated.binary_search(&index).is_err()).collect();
        retain(&mut self.triangles, &keep);
        retain(&mut self.face_normals, &keep);
        retain(&mut self.normals, &keep);
        retain(&mut self.texture_coordinates, &keep);
        retain(&mut self.materials, &keep);
        retain(&mut self.polygons, &keep);
        retain(&mut self.parts, &keep);
    }
}

/// Rotates a triangle to put its lowest vertex first.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Returns the numbers of all triangles that repeat an earlier one, in any order.
///
/// Triangles are ordered by their lowest vertex alone, by counting; the few that share it are sorted.
fn repeated(triangles: &[[u32; 3]], vertices: usize) -> Vec<u32> {
    // For each vertex where its triangles end; once they are ordered, where they begin.
    let mut ends = vec![0u32; vertices + 1];
    let lowest = |[a, b, c]: &[u32; 3]| *a.min(b).min(c) as usize;
    triangles.iter().for_each(|triangle| ends[lowest(triangle)] += 1);
    let mut end = 0;
    for count in &mut ends {
        end += *count;
        *count = end;
    }
    let mut order = vec![0u32; triangles.len()];
    for (number, triangle) in triangles.iter().enumerate().rev() {
        let end = &mut ends[lowest(triangle)];
        *end -= 1;
        order[*end as usize] = number as u32;
    }
    let starts = ends;
    let found = in_parallel(vertices, threads_for(triangles.len()), |range| {
        let mut found = Vec::new();
        let mut some: Vec<([u32; 3], u32)> = Vec::new();
        for vertex in range {
            let group = &order[starts[vertex] as usize..starts[vertex + 1] as usize];
            if group.len() > 1 {
                some.clear();
                some.extend(group.iter().map(|number| (turned(triangles[*number as usize]), *number)));
                some.sort_unstable();
                let pairs = some.windows(2).filter(|pair| pair[0].0 == pair[1].0);
                found.extend(pairs.map(|pair| pair[1].1));
            }
        }
        found
    });
    found.concat()
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::HashSet;

    proptest! {
        #[test]
        fn triangles_that_come_again_are_those_a_set_has_seen(
            triangles in prop::collection::vec(prop::array::uniform3(0u32..5), 0..200)
        ) {
            let is_sound = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
            let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(is_sound).collect();
            let mut seen = HashSet::new();
            let expected: Vec<u32> =
                (0..triangles.len()).filter(|i| !seen.insert(turned(triangles[*i]))).map(|i| i as u32).collect();
            let mut found = repeated(&triangles, 5);
            found.sort_unstable();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn a_turned_triangle_goes_the_same_way_round() {
        for triangle in [[1, 2, 3], [3, 1, 2], [2, 3, 1]] {
            assert_eq!(turned(triangle), [1, 2, 3]);
        }
        for triangle in [[1, 3, 2], [3, 2, 1], [2, 1, 3]] {
            assert_eq!(turned(triangle), [1, 3, 2]);
        }
    }
}
