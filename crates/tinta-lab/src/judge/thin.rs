//! Ink thinned to lines a pixel wide that stay connected: a count of pixels must not count a thick line twice.
//!
//! The two-step parallel thinning of Guo and Hall (Communications of the ACM 32, 1989).

use crate::compare::InkMask;

/// Offsets of a pixel's eight neighbours, clockwise from the one above.
const AROUND: [(i64, i64); 8] = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)];

/// The same ink, thinned until every pixel that is left is needed.
pub fn thinned(mask: &InkMask) -> InkMask {
    let (width, height) = (i64::from(mask.size.width), i64::from(mask.size.height));
    let mut ink = mask.ink.clone();
    let mut left: Vec<usize> = (0..ink.len()).filter(|index| ink[*index]).collect();
    let mut unchanged = 0;
    let mut is_second = false;
    while unchanged < 2 {
        let neighbours = |index: usize| {
            let (x, y) = (index as i64 % width, index as i64 / width);
            AROUND.map(|(dx, dy)| {
                let (x, y) = (x + dx, y + dy);
                (0..width).contains(&x) && (0..height).contains(&y) && ink[(y * width + x) as usize]
            })
        };
        let gone: Vec<usize> = left.iter().copied().filter(|index| can_go(neighbours(*index), is_second)).collect();
        unchanged = if gone.is_empty() { unchanged + 1 } else { 0 };
        gone.iter().for_each(|index| ink[*index] = false);
        left.retain(|index| ink[*index]);
        is_second = !is_second;
    }
    InkMask { size: mask.size, ink }
}

/// Whether a pixel with these neighbours may be removed in the first or the second step: it lies on that step's rim, ends no line
/// and joins no parts.
fn can_go([n, ne, e, se, s, sw, w, nw]: [bool; 8], is_second: bool) -> bool {
    let count = |pairs: [bool; 4]| pairs.into_iter().filter(|is_set| *is_set).count();
    let crossings = count([!n && (ne || e), !e && (se || s), !s && (sw || w), !w && (nw || n)]);
    let neighbours = count([nw || n, ne || e, se || s, sw || w]).min(count([n || ne, e || se, s || sw, w || nw]));
    let is_inside = if is_second { (n || ne || !se) && e } else { (s || sw || !nw) && w };
    crossings == 1 && (2..=3).contains(&neighbours) && !is_inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    fn mask(rows: &[&str]) -> InkMask {
        let size = Size { width: rows[0].len() as u32, height: rows.len() as u32 };
        InkMask { size, ink: rows.iter().flat_map(|row| row.chars()).map(|c| c == '#').collect() }
    }

    /// Ink in pieces that touch at sides or corners.
    fn pieces(mask: &InkMask) -> usize {
        let width = mask.size.width as usize;
        let mut left = mask.ink.clone();
        let mut pieces = 0;
        while let Some(first) = left.iter().position(|ink| *ink) {
            pieces += 1;
            let mut open = vec![first];
            while let Some(index) = open.pop() {
                if !std::mem::take(&mut left[index]) {
                    continue;
                }
                for (dx, dy) in AROUND {
                    let (x, y) = ((index % width) as i64 + dx, (index / width) as i64 + dy);
                    if (0..width as i64).contains(&x) && (0..i64::from(mask.size.height)).contains(&y) {
                        open.push(y as usize * width + x as usize);
                    }
                }
            }
        }
        pieces
    }

    #[test]
    fn a_thick_bar_becomes_a_line_and_a_thin_line_stays() {
        let bar = mask(&["............", ".##########.", ".##########.", ".##########.", "............"]);
        let line = thinned(&bar);
        let rows: Vec<usize> =
            (0..5).map(|y| line.ink[y * 12..(y + 1) * 12].iter().filter(|ink| **ink).count()).collect();
        assert_eq!((rows[0], rows[1], rows[3], rows[4]), (0, 0, 0, 0));
        assert!((8..=10).contains(&rows[2]), "{rows:?}");
        assert_eq!(thinned(&line), line);
        let diagonal = mask(&["#....", ".#...", "..#..", "...#.", "....#"]);
        assert_eq!(thinned(&diagonal), diagonal);
    }

    #[test]
    fn random_ink_keeps_its_pieces_and_has_no_block_left() {
        let mut random = tinta::random::Random::new(7, "ink");
        for density in [30, 50, 70, 95] {
            let size = Size { width: 40, height: 30 };
            let mask = InkMask { size, ink: (0..1200).map(|_| random.below(100) < density).collect() };
            let thin = thinned(&mask);
            assert!(thin.ink.iter().zip(&mask.ink).all(|(thin, ink)| !thin || *ink));
            assert!(thin.count() < mask.count());
            assert_eq!(pieces(&thin), pieces(&mask), "{density}");
            assert_eq!(thinned(&thin), thin);
        }
    }
}
