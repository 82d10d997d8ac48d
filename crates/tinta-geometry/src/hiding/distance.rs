//! Whether two triangles come near each other or pass through each other.

use crate::mesh::triangle_normal;
use crate::tolerances::COORDINATE_NOISE;
use glam::DVec3;
use robust::{Coord3D, orient3d};

/// A triangle's corners and its unit normal, zeros where it has no area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    pub corners: [DVec3; 3],
    pub normal: DVec3,
}

impl Triangle {
    pub(super) fn new(corners: [DVec3; 3]) -> Self {
        Self { corners, normal: triangle_normal(corners).unwrap_or_default() }
    }

    fn sides(&self) -> [[DVec3; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }
}

/// Whether some points of two triangles are less than `distance` apart.
pub(super) fn come_near(a: &Triangle, b: &Triangle, distance: f64) -> bool {
    if is_beyond_a_side(a, b, distance) || is_beyond_a_side(b, a, distance) {
        return false;
    }
    let limit = distance * distance;
    a.sides().iter().any(|side| passes_through(*side, b))
        || b.sides().iter().any(|side| passes_through(*side, a))
        || a.corners.iter().any(|point| square_to_triangle(*point, b) < limit)
        || b.corners.iter().any(|point| square_to_triangle(*point, a) < limit)
        || a.sides().iter().any(|first| b.sides().iter().any(|second| square_of_segments(*first, *second) < limit))
}

/// Whether two triangles that share just one corner also meet elsewhere: then a side of one of them that lies opposite to the
/// corner passes through the other.
pub(super) fn cross_beyond_corner(a: &Triangle, opposite_a: [DVec3; 2], b: &Triangle, opposite_b: [DVec3; 2]) -> bool {
    passes_through(opposite_a, b) || passes_through(opposite_b, a)
}

/// Whether `other` lies wholly on one side of a triangle's plane, or of a plane upright on one of its sides, and at least
/// `distance` away: the quick answer for most.
fn is_beyond_a_side(triangle: &Triangle, other: &Triangle, distance: f64) -> bool {
    let Triangle { corners, normal } = *triangle;
    if normal == DVec3::ZERO {
        return false;
    }
    let heights = other.corners.map(|point| normal.dot(point - corners[0]));
    if heights.iter().all(|height| *height >= distance) || heights.iter().all(|height| *height <= -distance) {
        return true;
    }
    triangle.sides().iter().any(|[from, to]| {
        let outwards = (*to - *from).cross(normal);
        let heights = other.corners.map(|point| outwards.dot(point - *from));
        let least = heights[0].min(heights[1]).min(heights[2]);
        least > 0.0 && least * least >= distance * distance * outwards.length_squared()
    })
}

/// Whether a segment surely passes a triangle by: it lies on one side of its plane, or of a plane upright on one of its sides.
/// The quick answer for most; what rounding could make of it is left to exact arithmetic.
fn is_clear_of(ends: [DVec3; 2], triangle: &Triangle) -> bool {
    let Triangle { corners, normal } = *triangle;
    let noise = COORDINATE_NOISE;
    let heights = ends.map(|end| normal.dot(end - corners[0]));
    heights.iter().all(|height| *height > noise)
        || heights.iter().all(|height| *height < -noise)
        || triangle.sides().iter().any(|[from, to]| {
            let outwards = (*to - *from).cross(normal);
            ends.iter().all(|end| outwards.dot(*end - *from) > noise)
        })
}

/// Whether a segment meets a triangle, exactly but for what lies in the triangle's plane.
fn passes_through([from, to]: [DVec3; 2], triangle: &Triangle) -> bool {
    if is_clear_of([from, to], triangle) {
        return false;
    }
    let [a, b, c] = triangle.corners;
    let side = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| {
        let [a, b, c, d] = [a, b, c, d].map(|DVec3 { x, y, z }| Coord3D { x, y, z });
        orient3d(a, b, c, d)
    };
    let (below, above) = (side(a, b, c, from), side(a, b, c, to));
    if (below > 0.0 && above > 0.0) || (below < 0.0 && above < 0.0) || (below == 0.0 && above == 0.0) {
        return false;
    }
    let turns = [side(from, to, a, b), side(from, to, b, c), side(from, to, c, a)];
    turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
}

/// Square of a point's distance from a triangle: where it is above the inside, from its plane, else from its sides.
fn square_to_triangle(point: DVec3, triangle: &Triangle) -> f64 {
    let Triangle { corners, normal } = *triangle;
    let is_left_of = |[from, to]: &[DVec3; 2]| (*to - *from).cross(point - *from).dot(normal) >= 0.0;
    if normal != DVec3::ZERO && triangle.sides().iter().all(is_left_of) {
        return normal.dot(point - corners[0]).powi(2);
    }
    triangle.sides().iter().map(|side| square_of_segments([point, point], *side)).fold(f64::INFINITY, f64::min)
}

/// Square of the distance between two segments, either of which may be a point (Ericson, *Real-Time Collision Detection*,
/// section 5.1.9).
fn square_of_segments([p, p_end]: [DVec3; 2], [q, q_end]: [DVec3; 2]) -> f64 {
    let (along_p, along_q, between) = (p_end - p, q_end - q, p - q);
    let (a, e, f) = (along_p.length_squared(), along_q.length_squared(), along_q.dot(between));
    let share = |part: f64, whole: f64| if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 };
    let c = along_p.dot(between);
    let b = along_p.dot(along_q);
    let mut s = share(b * f - c * e, a * e - b * b);
    let mut t = (b * s + f) / if e > 0.0 { e } else { 1.0 };
    if !(0.0..=1.0).contains(&t) || e == 0.0 {
        t = if e == 0.0 { 0.0 } else { t.clamp(0.0, 1.0) };
        s = share(b * t - c, a);
    }
    (between + along_p * s - along_q * t).length_squared()
}
