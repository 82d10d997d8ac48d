//! Polygons that go round the same corners as an earlier one, in either direction: a file may hold a face twice, once for each side.
//!
//! In: a soup and its welding. Out: for each such polygon the first of its kind. Both are then cut into triangles along the same
//! diagonals, so that they lie on each other even where they are not flat. A polygon that meets a corner twice is left alone.

use super::soup::{Corner, Soup};
use crate::threads::{in_parallel, threads_for};
use std::collections::HashMap;

/// The polygons that go round the same corners as an earlier one, each with the first of them.
pub(super) type SamePolygons = HashMap<u32, u32>;

/// Returns the polygons of more than three corners that go round those of an earlier one. `starts` tells where each polygon's
/// corners begin, and where the last one's end; it is empty where all are triangles.
pub(super) fn same_polygons(soup: &Soup, starts: &[u32], welded: &[u32]) -> SamePolygons {
    let count = starts.len().saturating_sub(1);
    let corners_of = |polygon: u32| {
        let polygon = polygon as usize;
        &soup.corners[starts[polygon] as usize..starts[polygon + 1] as usize]
    };
    let keys = in_parallel(count, threads_for(count), |polygons| {
        let polygons = polygons.map(|polygon| polygon as u32).filter(|polygon| corners_of(*polygon).len() > 3);
        // A sum does not depend on the first corner or the direction.
        let key = |polygon: u32| corners_of(polygon).iter().fold(0u64, |sum, it| sum.wrapping_add(mixed(it, welded)));
        polygons.map(|polygon| (key(polygon), polygon)).collect::<Vec<_>>()
    });
    let mut keys = keys.concat();
    keep_repeated(&mut keys);
    keys.sort_unstable();
    let mut same = SamePolygons::new();
    for alike in keys.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
        let mut firsts: HashMap<Vec<u32>, u32> = HashMap::new();
        for (_, polygon) in alike {
            let Some((round, _)) = from_lowest(corners_of(*polygon), welded) else { continue };
            let first = *firsts.entry(vertices(&round, welded)).or_insert(*polygon);
            if first != *polygon {
                same.insert(*polygon, first);
            }
        }
    }
    same
}

/// Drops most entries whose key comes once, and none of the others, in less time than sorting takes.
fn keep_repeated(keys: &mut Vec<(u64, u32)>) {
    // With 16 slots an entry, few keys share one by chance.
    let bits = (keys.len() * 16).next_power_of_two().max(64);
    let slot = |key: u64| {
        let bit = (key >> (64 - bits.trailing_zeros())) as usize;
        (bit / 64, 1u64 << (bit % 64))
    };
    let (mut once, mut again) = (vec![0u64; bits / 64], vec![0u64; bits / 64]);
    for (key, _) in keys.iter() {
        let (word, bit) = slot(*key);
        again[word] |= once[word] & bit;
        once[word] |= bit;
    }
    keys.retain(|(key, _)| {
        let (word, bit) = slot(*key);
        again[word] & bit != 0
    });
}

/// Returns the corners of a polygon in the order of the first of its kind, and whether they run the other way there.
pub(super) fn in_order_of(first: &[Corner], corners: &[Corner], welded: &[u32]) -> Option<(Vec<Corner>, bool)> {
    let ((of_first, first_is_turned), (own, is_turned)) = (from_lowest(first, welded)?, from_lowest(corners, welded)?);
    // Where the first one's first corner lies.
    let start = of_first.iter().position(|corner| corner == &first[0])?;
    let mut ordered = own;
    if first_is_turned {
        ordered.reverse();
        ordered.rotate_right(start + 1);
    } else {
        ordered.rotate_left(start);
    }
    Some((ordered, is_turned != first_is_turned))
}

/// Returns a polygon's corners from its lowest vertex on, towards the lower of that one's neighbours, and whether that is against
/// its direction; `None` if it meets a vertex twice.
fn from_lowest(corners: &[Corner], welded: &[u32]) -> Option<(Vec<Corner>, bool)> {
    let mut round = corners.to_vec();
    let vertex = |corner: &Corner| welded[corner.position as usize];
    let mut all = vertices(corners, welded);
    all.sort_unstable();
    if all.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    let lowest = round.iter().position(|corner| vertex(corner) == all[0])?;
    round.rotate_left(lowest);
    let is_turned = vertex(&round[1]) > vertex(round.last()?);
    if is_turned {
        round[1..].reverse();
    }
    Some((round, is_turned))
}

fn vertices(corners: &[Corner], welded: &[u32]) -> Vec<u32> {
    corners.iter().map(|corner| welded[corner.position as usize]).collect()
}

/// A corner's vertex as a number that spreads over 64 bits.
fn mixed(corner: &Corner, welded: &[u32]) -> u64 {
    let spread = (u64::from(welded[corner.position as usize]) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (spread ^ spread >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

#[cfg(test)]
mod tests {
    use super::*;

    const POLYGONS: [&[u32]; 9] = [
        &[0, 1, 2, 3],
        &[2, 3, 0, 1],
        &[1, 0, 3, 2],
        &[0, 2, 1, 3],
        &[0, 1, 2],
        &[2, 1, 0],
        &[2, 3, 4, 0, 1],
        &[3, 2, 6, 0, 4],
        &[0, 1, 2, 1],
    ];

    /// Vertex 6 is welded to vertex 1.
    const WELDED: [u32; 7] = [0, 1, 2, 3, 4, 5, 1];

    fn at(polygon: &[u32]) -> Vec<Corner> {
        polygon.iter().map(|index| Corner::at(*index)).collect()
    }

    #[test]
    fn polygons_are_the_same_from_any_corner_and_either_side() {
        let soup = Soup {
            corners: POLYGONS.iter().flat_map(|polygon| at(polygon)).collect(),
            polygon_sizes: POLYGONS.iter().map(|polygon| polygon.len() as u32).collect(),
            ..Soup::default()
        };
        let starts: Vec<u32> = (0..=POLYGONS.len()).map(|end| soup.polygon_sizes[..end].iter().sum()).collect();
        assert_eq!(same_polygons(&soup, &starts, &WELDED), SamePolygons::from([(1, 0), (2, 0), (7, 6)]));
    }

    #[test]
    fn corners_come_in_the_order_of_the_first_polygon() {
        for (first, own, expected, is_expected_turned) in [
            (POLYGONS[6], POLYGONS[7], [2, 3, 4, 0, 6], true),
            (POLYGONS[7], POLYGONS[6], [3, 2, 1, 0, 4], true),
            (POLYGONS[6], &[4, 0, 6, 2, 3], [2, 3, 4, 0, 6], false),
            (POLYGONS[7], &[4, 3, 2, 1, 0], [3, 2, 1, 0, 4], false),
        ] {
            let (corners, is_turned) = in_order_of(&at(first), &at(own), &WELDED).unwrap();
            assert_eq!((corners, is_turned), (at(&expected), is_expected_turned), "{first:?} {own:?}");
        }
    }

    #[test]
    fn keys_that_repeat_are_kept_and_nearly_all_others_dropped() {
        let mut keys: Vec<(u64, u32)> =
            (0..1000u32).map(|it| (mixed(&Corner::at(it), &(0..1000).collect::<Vec<_>>()), it)).collect();
        let again: Vec<(u64, u32)> = (0..10).map(|it| (keys[it * 7].0, 1000 + it as u32)).collect();
        keys.extend(again);
        keep_repeated(&mut keys);
        let kept = |number: u32| keys.iter().any(|(_, it)| *it == number);
        assert!((0..10).all(|it| kept(it * 7) && kept(1000 + it)));
        assert!(keys.len() < 200, "{}", keys.len());
    }
}
