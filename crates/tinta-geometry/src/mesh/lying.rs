//! Whether a model seems to lie on its back: it stands on a flat base, and that faces z instead of y.
//!
//! OBJ and PLY do not say which axis is up. A bust or a figure made with z up has its base at the lowest z, and no flat end
//! elsewhere. This only hints: a slab may well stand on its edge.

use super::Mesh;
use crate::tolerances::{BASE_DEPTH, BASE_FLATNESS, BASE_HEIGHT, BASE_SHARE, OTHER_ENDS_SHARE};

/// The place of the lowest z among the six ends of a model: the lowest of x, y and z, then the highest.
const LOWEST_Z: usize = 2;

/// Whether the only flat end of a mesh is its lowest z, and it is no slab.
pub(super) fn seems_to_lie(mesh: &Mesh) -> bool {
    let (low, high) = mesh.bounds();
    let extent = high - low;
    if extent.z < BASE_HEIGHT * extent.max_element() {
        return false;
    }
    let shares = flat_shares(mesh);
    let others = shares.iter().enumerate().filter(|(end, _)| *end != LOWEST_Z);
    shares[LOWEST_Z] >= BASE_SHARE && others.into_iter().all(|(_, share)| *share <= OTHER_ENDS_SHARE)
}

/// Of the bounding box's side at each end, the share that faces lying in it cover.
fn flat_shares(mesh: &Mesh) -> [f64; 6] {
    let (low, high) = mesh.bounds();
    let extent = high - low;
    let mut areas = [0.0; 6];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| mesh.positions[index as usize]);
        let twice = (b - a).cross(c - a);
        let double_area = twice.length();
        for axis in 0..3 {
            if twice[axis].abs() < BASE_FLATNESS * double_area {
                continue;
            }
            let (height, whole) = ((a[axis] + b[axis] + c[axis]) / 3.0 - low[axis], extent[axis]);
            if height <= BASE_DEPTH * whole {
                areas[axis] += double_area / 2.0;
            }
            // What is flat all over is both ends at once.
            if height >= (1.0 - BASE_DEPTH) * whole {
                areas[axis + 3] += double_area / 2.0;
            }
        }
    }
    std::array::from_fn(|end| {
        let side = extent[(end + 1) % 3] * extent[(end + 2) % 3];
        if side > 0.0 { areas[end] / side } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::UpAxis;
    use glam::DVec3;

    /// A pyramid of so many sides on a base at the lowest z, as high as wide.
    fn pyramid(has_base: bool) -> Mesh {
        let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 2.0]];
        let positions: Vec<DVec3> = corners.map(DVec3::from_array).to_vec();
        let sides = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let base = [[0, 2, 1], [0, 3, 2]];
        let triangles = sides.into_iter().chain(base.into_iter().filter(|_| has_base)).collect();
        Mesh { positions, triangles, ..Mesh::triangle() }
    }

    fn turned(mesh: &Mesh, up: UpAxis) -> Mesh {
        Mesh { positions: mesh.positions.iter().map(|point| up.to_y_up(*point)).collect(), ..mesh.clone() }
    }

    #[test]
    fn a_base_covers_its_side_of_the_box_and_nothing_else_does() {
        assert_eq!(flat_shares(&pyramid(true)), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        assert_eq!(flat_shares(&pyramid(false)), [0.0; 6]);
        assert_eq!(flat_shares(&turned(&pyramid(true), UpAxis::Z)), [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(flat_shares(&turned(&pyramid(true), UpAxis::MinusZ))[4], 1.0);
    }

    #[test]
    fn only_what_stands_on_its_lowest_z_seems_to_lie() {
        assert!(seems_to_lie(&pyramid(true)));
        assert!(!seems_to_lie(&pyramid(false)), "without a base nobody knows");
        for (up, lies) in [
            (UpAxis::Z, false),
            (UpAxis::MinusZ, false),
            // These turn about z.
            (UpAxis::X, true),
            (UpAxis::MinusY, true),
        ] {
            assert_eq!(seems_to_lie(&turned(&pyramid(true), up)), lies, "{up}");
        }
        assert!(!seems_to_lie(&Mesh::triangle()), "flat all over");
        let mut slab = pyramid(true);
        slab.positions.iter_mut().for_each(|point| point.z *= 0.4);
        assert!(!seems_to_lie(&slab), "lower than wide");
    }

    #[test]
    fn a_box_has_flat_ends_all_over() {
        let positions: Vec<DVec3> =
            (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let cube = Mesh { positions, triangles, ..Mesh::triangle() };
        assert_eq!(flat_shares(&cube), [1.0; 6]);
        assert!(!seems_to_lie(&cube));
    }
}
