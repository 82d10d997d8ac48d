//! Polygons to triangles, each keeping the polygon's orientation.
//!
//! Convex polygons become fans; the others go to the earcut crate in the plane of Newell's normal, long ones only if they do
//! not cross themselves: earcut would not come to an end.

mod simple;

use crate::limits::{CONCAVE_CORNERS, CROSSING_CORNERS};
use earcut::Earcut;
use glam::{DVec2, DVec3};
use simple::is_simple;

/// Splits one polygon (its corners' positions, in order) into triangles of corner numbers.
///
/// `out` is cleared and gets `corners.len() - 2` triangles for a simple polygon, fewer where it has no area to cut, none where
/// it has more than [`CONCAVE_CORNERS`] and is not convex, or more than [`CROSSING_CORNERS`] and crosses itself.
pub fn triangulate(corners: &[DVec3], earcut: &mut Earcut<f64>, out: &mut Vec<[u32; 3]>) {
    out.clear();
    match corners.len() {
        0..=2 => {}
        3 => out.push([0, 1, 2]),
        count => {
            let corners = &of_size_one(corners);
            let normal = newell_normal(corners);
            if normal == DVec3::ZERO || is_convex(corners, normal) {
                out.extend((1..count as u32 - 1).map(|i| [0, i, i + 1]));
            } else {
                if count > CONCAVE_CORNERS {
                    return;
                }
                let plane: Vec<DVec2> = project(corners, normal).collect();
                if count > CROSSING_CORNERS && !is_simple(&plane) {
                    return;
                }
                let mut indices: Vec<u32> = Vec::new();
                earcut.earcut(plane.iter().map(|point| point.to_array()), &[], &mut indices);
                out.extend(indices.chunks_exact(3).map(|t| oriented([t[0], t[1], t[2]], corners, normal)));
            }
        }
    }
}

/// The corners moved to the first one and scaled, so that products of lengths stay ordinary numbers.
fn of_size_one(corners: &[DVec3]) -> Vec<DVec3> {
    let size = corners.iter().map(|corner| (corner - corners[0]).abs().max_element()).fold(0.0, f64::max);
    let scale = if size > 0.0 { size } else { 1.0 };
    corners.iter().map(|corner| (corner - corners[0]) / scale).collect()
}

/// Twice the polygon's area as a vector along its normal.
fn newell_normal(corners: &[DVec3]) -> DVec3 {
    let origin = corners[0];
    corners.windows(2).map(|pair| (pair[0] - origin).cross(pair[1] - origin)).sum()
}

/// Whether no corner turns the other way; a star polygon that winds twice is not convex either.
fn is_convex(corners: &[DVec3], normal: DVec3) -> bool {
    let count = corners.len();
    let corner = |i: usize| corners[i % count];
    let turns_left =
        (0..count).all(|i| (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i + 1)).dot(normal) >= 0.0);
    let fan_is_left =
        (1..count - 1).all(|i| (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).dot(normal) >= 0.0);
    turns_left && fan_is_left
}

/// The corners in a plane's coordinates, seen from the side the normal points to.
fn project(corners: &[DVec3], normal: DVec3) -> impl Iterator<Item = DVec2> {
    let across = normal.any_orthogonal_vector().normalize_or_zero();
    let along = normal.cross(across).normalize_or_zero();
    corners.iter().map(move |corner| DVec2::new(corner.dot(across), corner.dot(along)))
}

/// The triangle turned so that it winds like its polygon: earcut does not promise an order.
fn oriented(triangle: [u32; 3], corners: &[DVec3], normal: DVec3) -> [u32; 3] {
    let [a, b, c] = triangle.map(|index| corners[index as usize]);
    if (b - a).cross(c - a).dot(normal) < 0.0 { [triangle[0], triangle[2], triangle[1]] } else { triangle }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area_vector(corners: &[DVec3], triangles: &[[u32; 3]]) -> (DVec3, f64) {
        let mut sum = DVec3::ZERO;
        let mut total = 0.0;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let area = (b - a).cross(c - a) * 0.5;
            sum += area;
            total += area.length();
        }
        (sum, total)
    }

    fn cut(corners: &[DVec3]) -> Vec<[u32; 3]> {
        let mut out = Vec::new();
        triangulate(corners, &mut Earcut::new(), &mut out);
        out
    }

    #[test]
    fn a_convex_polygon_becomes_a_fan() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_concave_polygon_keeps_its_area_and_orientation() {
        // An L of area 3 in a tilted plane, entered at the corner from which a fan would leave the polygon.
        let flat = [(1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0), (2.0, 0.0), (2.0, 1.0)];
        let (u, v) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(-0.48, 0.36, 0.8));
        for (start, size) in (0..flat.len()).flat_map(|start| [(start, 1.0), (start, 1e-60)]) {
            let corners: Vec<DVec3> =
                (0..flat.len()).map(|i| flat[(start + i) % flat.len()]).map(|(x, y)| (u * x + v * y) * size).collect();
            let triangles = cut(&corners);
            let (sum, total) = area_vector(&corners, &triangles);
            assert_eq!(triangles.len(), 4);
            let (sum, total) = (sum / size / size, total / size / size);
            assert!((total - 3.0).abs() < 1e-12, "area {total}");
            assert!(sum.distance(u.cross(v) * 3.0) < 1e-12, "orientation {sum}");
        }
    }

    #[test]
    fn a_polygon_without_area_does_not_panic() {
        assert_eq!(cut(&[DVec3::ZERO; 5]).len(), 3);
        assert_eq!(cut(&[DVec3::ZERO, DVec3::X]).len(), 0);
    }
}
