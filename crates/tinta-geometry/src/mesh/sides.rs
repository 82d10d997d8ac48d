//! The two sides of surfaces that a file writes twice, once for each side.
//!
//! In: triangles and the pairs with the same corners. Out: of each pair the triangle that belongs to the front, so that the fronts
//! agree on the outside across their common edges, with each other and with triangles that are there once. Files write the sides
//! in any order.

use super::NONE;
use std::collections::VecDeque;

/// A side of a triangle: its two positions, the lower first, whether it runs from the lower one, and the pair, or [`NONE`] for a
/// triangle that is there once.
type Side = ([u32; 2], bool, u32);

/// Returns each pair with its front first.
pub(super) fn fronts_and_backs(triangles: &[[u32; 3]], pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
    // For each pair its neighbours, and whether the first triangles of both agree on the outside.
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); pairs.len()];
    let mut is_turned: Vec<Option<bool>> = vec![None; pairs.len()];
    let mut queue = VecDeque::new();
    for around in sides(triangles, pairs).chunk_by(|a, b| a.0 == b.0) {
        // Where more surfaces meet, any two may belong together.
        let [(_, first_way, first), (_, second_way, second)] = around else { continue };
        let agree = first_way != second_way;
        match (*first, *second) {
            (NONE, NONE) => {}
            (NONE, pair) | (pair, NONE) => {
                if is_turned[pair as usize].replace(!agree).is_none() {
                    queue.push_back(pair as usize);
                }
            }
            (first, second) => {
                neighbours[first as usize].push((second as usize, agree));
                neighbours[second as usize].push((first as usize, agree));
            }
        }
    }
    for start in 0..pairs.len() {
        while let Some(pair) = queue.pop_front() {
            let is_own_turned = is_turned[pair] == Some(true);
            for (other, agree) in &neighbours[pair] {
                if is_turned[*other].is_none() {
                    is_turned[*other] = Some(is_own_turned == *agree);
                    queue.push_back(*other);
                }
            }
        }
        if is_turned[start].is_none() {
            is_turned[start] = Some(false);
            queue.push_back(start);
        }
    }
    let ordered = pairs.iter().zip(is_turned);
    ordered.map(|([a, b], is_turned)| if is_turned == Some(true) { [*b, *a] } else { [*a, *b] }).collect()
}

/// The sides of all triangles but the second ones of pairs, by edge.
fn sides(triangles: &[[u32; 3]], pairs: &[[u32; 2]]) -> Vec<Side> {
    let mut pair_of = vec![Some(NONE); triangles.len()];
    for ([first, second], pair) in pairs.iter().zip(0..) {
        pair_of[*first as usize] = Some(pair);
        pair_of[*second as usize] = None;
    }
    let mut sides = Vec::new();
    for ([a, b, c], pair) in triangles.iter().zip(pair_of) {
        let Some(pair) = pair else { continue };
        sides.extend([[a, b], [b, c], [c, a]].map(|[from, to]| ([*from.min(to), *from.max(to)], from < to, pair)));
    }
    sides.sort_unstable();
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of triangles that agree on the outside.
    const STRIP: [[u32; 3]; 4] = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]];

    fn turned_over([a, b, c]: [u32; 3]) -> [u32; 3] {
        [b, a, c]
    }

    #[test]
    fn the_fronts_agree_in_whatever_order_the_sides_are_written() {
        for order in 0..16 {
            let is_front_first = |place: usize| order >> place & 1 == 0;
            let triangles: Vec<[u32; 3]> = STRIP
                .iter()
                .enumerate()
                .flat_map(|(place, front)| match is_front_first(place) {
                    true => [*front, turned_over(*front)],
                    false => [turned_over(*front), *front],
                })
                .collect();
            let pairs: Vec<[u32; 2]> = (0..4).map(|place| [2 * place, 2 * place + 1]).collect();
            let fronts = fronts_and_backs(&triangles, &pairs);
            let are_of_strip: Vec<bool> =
                fronts.iter().zip(STRIP).map(|([front, _], of_strip)| triangles[*front as usize] == of_strip).collect();
            assert_eq!(are_of_strip, [is_front_first(0); 4], "the first pair keeps its order: {order:b}");
        }
    }

    #[test]
    fn a_face_that_is_there_once_tells_which_side_is_the_front() {
        let [first, second, third, fourth] = STRIP;
        let triangles = [turned_over(first), first, turned_over(second), second, third, fourth];
        assert_eq!(fronts_and_backs(&triangles, &[[0, 1], [2, 3]]), [[1, 0], [3, 2]]);
    }
}
