//! Cracks: open edges so close to one another that the model was probably meant to be closed there.

use super::{EdgeList, Incidence};
use crate::mesh::{Mesh, weld};
use crate::tolerances::CRACK;
use glam::DVec3;

/// Returns the number of open edges with another one whose ends are both within `CRACK` of the model's size of theirs.
///
/// Each such edge after the first of a place counts: a crack of one edge's length is 1.
pub fn cracks(mesh: &Mesh, edges: &EdgeList) -> usize {
    let incidence = edges.incidence().iter();
    let open = edges.positions().iter().zip(incidence).filter(|(_, kind)| **kind == Incidence::Boundary);
    let mut open: Vec<[u32; 2]> = open.map(|(ends, _)| *ends).collect();
    let mut ends: Vec<u32> = open.iter().flatten().copied().collect();
    ends.sort_unstable();
    ends.dedup();
    let points: Vec<DVec3> = ends.iter().map(|end| mesh.positions[*end as usize]).collect();
    let (low, high) = mesh.bounds();
    let joined = weld(&points, CRACK * (high - low).length());
    for edge in &mut open {
        *edge = edge.map(|end| ends.binary_search(&end).map_or(end, |place| joined[place]));
        edge.sort_unstable();
    }
    open.retain(|[a, b]| a != b);
    open.sort_unstable();
    open.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, read_bytes};

    /// Two squares side by side, this far apart.
    fn squares(gap: f64, weld: f64) -> usize {
        let x = 1.0 + gap;
        let text = format!(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv {x} 0 0\nv 2 0 0\nv 2 1 0\nv {x} 1 0\nf 1 2 3 4\nf 5 6 7 8\n"
        );
        let mesh =
            read_bytes(text.as_bytes(), "a.obj", &[], &LoadOptions { weld, ..LoadOptions::default() }).unwrap().mesh;
        cracks(&mesh, &EdgeList::new(&mesh))
    }

    #[test]
    fn open_edges_a_little_apart_are_a_crack_until_they_are_welded_or_further_apart() {
        assert_eq!(squares(1e-4, 1e-7), 1);
        assert_eq!(squares(-1e-4, 1e-7), 1, "a little over one another");
        assert_eq!(squares(1e-4, 1e-4), 0);
        assert_eq!(squares(1e-3, 1e-7), 0);
        assert_eq!(squares(0.0, 1e-7), 0);
    }

    #[test]
    fn strips_moved_apart_have_a_crack_a_side() {
        // A cylinder of 24 strips, every other one moved outwards.
        let mut text = String::new();
        for strip in 0..24 {
            let radius = if strip % 2 == 0 { 10.0 } else { 10.0004 };
            for (end, z) in [(strip, 0), (strip + 1, 0), (strip + 1, 5), (strip, 5)] {
                let (sine, cosine) = (f64::from(end) * std::f64::consts::TAU / 24.0).sin_cos();
                text.push_str(&format!("v {} {} {z}\n", radius * cosine, radius * sine));
            }
            text.push_str("f -4 -3 -2 -1\n");
        }
        let mesh = read_bytes(text.as_bytes(), "a.obj", &[], &LoadOptions::default()).unwrap().mesh;
        assert_eq!(cracks(&mesh, &EdgeList::new(&mesh)), 24);
    }
}
