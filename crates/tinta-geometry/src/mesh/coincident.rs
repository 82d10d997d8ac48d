//! Triangles with the same three corners: those that repeat another, and pairs that show one surface from both sides.
//!
//! In: triangles over welded positions. Out: their numbers. The corners decide alone: of triangles that lie on each other with other
//! corners, only rings are found that may show one quadrilateral from both sides.

use crate::threads::{in_parallel, threads_for};

/// Triangles with the same corners as others, in any order.
#[derive(Default)]
pub(super) struct Coincident {
    /// Those that repeat an earlier one of the same orientation.
    pub repeated: Vec<u32>,
    /// Two of opposite orientation that repeat none, the earlier one first.
    pub opposite: Vec<[u32; 2]>,
    /// Three that close a ring round the lowest vertex of all of them, in the ring's direction.
    pub rings: Vec<[u32; 3]>,
}

/// Returns all triangles with the same corners as another; the corners are below `vertices`.
///
/// Triangles are ordered by their lowest vertex alone, by counting; the few that share it are sorted.
pub(super) fn coincident(triangles: &[[u32; 3]], vertices: usize) -> Coincident {
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
        let mut found = Coincident::default();
        let (mut some, mut ways) = (Vec::new(), Vec::new());
        for vertex in range {
            let group = &order[starts[vertex] as usize..starts[vertex + 1] as usize];
            if group.len() > 1 {
                some.clear();
                some.extend(group.iter().map(|number| {
                    let (corners, is_turned_over) = sorted(triangles[*number as usize]);
                    (corners, is_turned_over, *number)
                }));
                some.sort_unstable();
                some.chunk_by(|a, b| a.0 == b.0).for_each(|same| found.add(same));
                found.add_rings(&some, &mut ways);
            }
        }
        found
    });
    found.into_iter().fold(Coincident::default(), |mut all, mut one| {
        all.repeated.append(&mut one.repeated);
        all.opposite.append(&mut one.opposite);
        all.rings.append(&mut one.rings);
        all
    })
}

impl Coincident {
    /// Adds the triangles of the same corners: by orientation, then by number.
    fn add(&mut self, same: &[([u32; 3], bool, u32)]) {
        let mut firsts = Vec::new();
        for side in same.chunk_by(|a, b| a.1 == b.1) {
            firsts.push(side[0].2);
            self.repeated.extend(side[1..].iter().map(|(_, _, number)| number));
        }
        if let [first, second] = *firsts {
            self.opposite.push([first.min(second), first.max(second)]);
        }
    }

    /// Adds the rings of triangles round their lowest vertex. `ways` is room for each triangle's other corners, in its direction.
    fn add_rings(&mut self, triangles: &[([u32; 3], bool, u32)], ways: &mut Vec<[u32; 3]>) {
        ways.clear();
        ways.extend(triangles.iter().map(
            |([_, b, c], is_turned_over, number)| {
                if *is_turned_over { [*c, *b, *number] } else { [*b, *c, *number] }
            },
        ));
        ways.sort_unstable();
        // A surface leads on once, its back once more.
        let from = |corner: u32| ways[ways.partition_point(|way| way[0] < corner)..].iter().take(2);
        for [start, second, first_face] in &*ways {
            for [from_second, third, second_face] in from(*second) {
                let closing = from(*third).find(|way| way[..2] == [*third, *start]).filter(|_| from_second == second);
                self.rings.extend(closing.map(|way| [*first_face, *second_face, way[2]]));
            }
        }
    }
}

/// A triangle's corners in ascending order, and whether it goes round them the other way.
pub(super) fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let [first, second, third] = if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    };
    if second < third { ([first, second, third], false) } else { ([first, third, second], true) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::HashMap;

    proptest! {
        #[test]
        fn triangles_that_come_again_are_those_a_map_has_seen(
            triangles in prop::collection::vec(prop::array::uniform3(0u32..5), 0..200)
        ) {
            let is_sound = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
            let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(is_sound).collect();
            let turns = |[a, b, c]: [u32; 3]| [[a, b, c], [b, c, a], [c, a, b]];
            let mut firsts: HashMap<[u32; 3], u32> = HashMap::new();
            let (mut repeated, mut opposite) = (Vec::new(), Vec::new());
            for (triangle, number) in triangles.iter().zip(0u32..) {
                let [a, b, c] = *triangle;
                if firsts.contains_key(triangle) {
                    repeated.push(number);
                    continue;
                }
                opposite.extend(firsts.get(&[c, b, a]).map(|other| [*other, number]));
                firsts.extend(turns([a, b, c]).map(|turn| (turn, number)));
            }
            let mut found = coincident(&triangles, 5);
            found.repeated.sort_unstable();
            found.opposite.sort_unstable();
            opposite.sort_unstable();
            prop_assert_eq!((found.repeated, found.opposite), (repeated, opposite));
        }
    }

    #[test]
    fn three_triangles_that_close_a_ring_at_their_lowest_vertex_are_found() {
        let ring = [[0, 1, 2], [2, 3, 0], [1, 0, 3], [1, 3, 2]];
        let mut rings = coincident(&ring, 4).rings;
        rings.sort_unstable();
        assert_eq!(rings, [[0, 1, 2], [1, 2, 0], [2, 0, 1]]);
        assert!(coincident(&[[0, 1, 2], [0, 2, 3], [0, 1, 3]], 4).rings.is_empty(), "the last one goes the other way");
        assert!(coincident(&[[0, 1, 2], [0, 2, 1], [0, 2, 3]], 4).rings.is_empty(), "two are one from both sides");
    }

    #[test]
    fn a_turned_triangle_goes_the_same_way_round() {
        for triangle in [[1, 2, 3], [3, 1, 2], [2, 3, 1]] {
            assert_eq!(sorted(triangle), ([1, 2, 3], false));
        }
        for triangle in [[1, 3, 2], [3, 2, 1], [2, 1, 3]] {
            assert_eq!(sorted(triangle), ([1, 2, 3], true));
        }
    }
}
