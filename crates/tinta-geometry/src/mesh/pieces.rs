//! Cuts a soup's polygons into triangles with area, each once, with their corners' attributes.
//!
//! In: polygons and the vertices' welding. Out: triangles over welded but not yet renumbered positions.

use super::coincident::{Coincident, sorted};
use super::same_polygons::{in_order_of, same_polygons};
use super::soup::{Corner, Soup};
use super::triangulate::{self, Cut};
use super::{Defects, NONE, outside, triangle_normal};
use crate::threads::{in_parallel, threads_for};
use earcut::Earcut;
use glam::DVec3;
use std::collections::HashSet;

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
    /// Those of them that have area in the file, by their welded vertices.
    collapsed: Vec<[u32; 3]>,
    /// How many polygons had too many corners to be cut.
    pub too_long: usize,
    /// How many polygons cross themselves.
    pub crossing: usize,
    /// How many belonged to a polygon that repeated another.
    pub duplicate: usize,
    /// How many have another on their back: pairs with the same corners that may be seen.
    pub doubled: usize,
    /// How many polygons named a corner twice in a row.
    pub repeated_corners: usize,
}

impl Pieces {
    /// Adds what was left out to a file's defects. `vertices` is the total number of vertices.
    pub(super) fn count(&self, vertices: usize, defects: &mut Defects) {
        let mut is_left = vec![false; vertices];
        self.triangles.as_flattened().iter().for_each(|vertex| is_left[*vertex as usize] = true);
        let vanished = self.collapsed.iter().filter(|corners| !corners.iter().any(|it| is_left[*it as usize])).count();
        defects.vanished_triangles += vanished;
        defects.degenerate_triangles += self.degenerate - vanished;
        defects.long_polygons += self.too_long;
        defects.crossing_polygons += self.crossing;
        defects.repeated_corners += self.repeated_corners;
        defects.duplicate_triangles += self.duplicate;
        defects.doubled_triangles += self.doubled;
    }

    /// Returns all triangles with area of the polygons with finite vertices.
    pub(super) fn of(soup: &Soup, finite: &[bool], welded: &[u32]) -> Self {
        let starts = starts(soup);
        let same = same_polygons(soup, &starts, welded);
        let count = soup.polygon_count();
        let pieces = in_parallel(count, threads_for(count), |polygons| {
            let mut pieces = Self { first: polygons.start, ..Self::default() };
            // The first has room for all.
            pieces.reserve(if polygons.start == 0 { count } else { polygons.len() }, soup);
            let mut knife = Knife::default();
            let corners_of = |polygon: usize| match starts.as_slice() {
                [] => &soup.corners[polygon * 3..][..3],
                starts => &soup.corners[starts[polygon] as usize..starts[polygon + 1] as usize],
            };
            for polygon in polygons {
                let corners = corners_of(polygon);
                if corners.iter().any(|corner| !finite[corner.position as usize]) {
                    continue;
                }
                match (corners, same.get(&(polygon as u32)).map(|first| corners_of(*first as usize))) {
                    ([a, b, c], _) => pieces.push(soup, welded, [*a, *b, *c], polygon),
                    (_, None) => pieces.cut(soup, welded, corners, polygon, &mut knife),
                    (_, Some(first)) => pieces.cut_like(first, soup, welded, corners, polygon, &mut knife),
                }
            }
            pieces
        });
        let mut pieces = pieces.into_iter();
        let mut all = pieces.next().unwrap_or_default();
        pieces.for_each(|piece| all.append(piece));
        all
    }

    /// Adds the triangles of a polygon.
    fn cut(&mut self, soup: &Soup, welded: &[u32], corners: &[Corner], polygon: usize, knife: &mut Knife) {
        let once = &mut knife.once;
        once.clear();
        once.extend_from_slice(corners);
        once.dedup_by_key(|corner| corner.position);
        while once.len() > 1 && once.first().map(|own| own.position) == once.last().map(|own| own.position) {
            once.pop();
        }
        self.repeated_corners += usize::from(once.len() < corners.len());
        match *once.as_slice() {
            [a, b, c] => self.push(soup, welded, [a, b, c], polygon),
            [] | [_] | [_, _] => self.degenerate += 1,
            _ => {
                let once = std::mem::take(once);
                self.triangulate(&once, soup, knife);
                for triangle in &knife.cut {
                    self.push(soup, welded, triangle.map(|index| once[index as usize]), polygon);
                }
                knife.once = once;
            }
        }
    }

    /// Adds the triangles of a polygon that goes round the corners of an earlier one, along that one's diagonals.
    fn cut_like(
        &mut self,
        first: &[Corner],
        soup: &Soup,
        welded: &[u32],
        corners: &[Corner],
        polygon: usize,
        knife: &mut Knife,
    ) {
        let Some((corners, is_turned)) = in_order_of(first, corners, welded) else { return };
        self.triangulate(first, soup, knife);
        for [a, b, c] in &knife.cut {
            // Each begins at the same corner: drivers may round the rest differently.
            let triangle = if is_turned { [a, c, b] } else { [a, b, c] };
            self.push(soup, welded, triangle.map(|index| corners[*index as usize]), polygon);
        }
    }

    /// Finds the triangles of a polygon of four corners or more.
    fn triangulate(&mut self, corners: &[Corner], soup: &Soup, knife: &mut Knife) {
        let Knife { earcut, cut, points, .. } = knife;
        points.clear();
        points.extend(corners.iter().map(|corner| soup.positions[corner.position as usize]));
        match triangulate::triangulate(points, earcut, cut) {
            Cut::Whole => {}
            Cut::Crossing => self.crossing += 1,
            Cut::TooLong => {
                self.too_long += 1;
                return cut.clear();
            }
        }
        // If earcut finds no area, the lost triangles count as degenerate.
        self.degenerate += (corners.len() - 2).saturating_sub(cut.len());
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
            if triangle_normal(corners.map(|corner| soup.positions[corner.position as usize])).is_some() {
                self.collapsed.push(triangle);
            }
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
        self.collapsed.append(&mut other.collapsed);
        self.crossing += other.crossing;
        self.too_long += other.too_long;
        self.repeated_corners += other.repeated_corners;
    }

    /// Drops polygons with the same triangles as an earlier one, in the same orientation; the opposite side is another polygon. A
    /// triangle that two different polygons have in common belongs to both. Counts triangles that have another on their back and may
    /// be seen.
    pub(super) fn drop_duplicates(&mut self, positions: &[DVec3], Coincident { repeated, opposite, .. }: Coincident) {
        self.doubled += outside::pairs(&self.triangles, positions, opposite).len();
        if repeated.is_empty() {
            return;
        }
        self.number();
        let repeated: HashSet<([u32; 3], bool)> =
            repeated.into_iter().map(|index| sorted(self.triangles[index as usize])).collect();
        let mut known: HashSet<Vec<([u32; 3], bool)>> = HashSet::new();
        let mut keep = Vec::with_capacity(self.triangles.len());
        for polygon in self.polygons.chunk_by(|a, b| a == b) {
            let mut triangles: Vec<([u32; 3], bool)> =
                self.triangles[keep.len()..][..polygon.len()].iter().map(|triangle| sorted(*triangle)).collect();
            triangles.sort_unstable();
            let occurs_again = triangles.iter().all(|triangle| repeated.contains(triangle));
            let is_new = !occurs_again || known.insert(triangles);
            self.duplicate += if is_new { 0 } else { polygon.len() };
            keep.resize(keep.len() + polygon.len(), is_new);
        }
        if self.duplicate == 0 {
            return;
        }
        retain(&mut self.triangles, &keep);
        retain(&mut self.face_normals, &keep);
        retain(&mut self.normals, &keep);
        retain(&mut self.texture_coordinates, &keep);
        retain(&mut self.materials, &keep);
        retain(&mut self.polygons, &keep);
        retain(&mut self.parts, &keep);
    }
}

/// What cutting needs, kept between polygons to reuse its memory.
#[derive(Default)]
struct Knife {
    earcut: Earcut<f64>,
    /// A polygon's triangles, by its corners.
    cut: Vec<[u32; 3]>,
    points: Vec<DVec3>,
    /// A polygon's corners without those that it names again in a row.
    once: Vec<Corner>,
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
