//! Signed distance fields to sculpt with: solids, blends and brush strokes.
//!
//! Every function takes a point in centimetres and gives a distance in
//! centimetres, negative inside. The distances are close to exact near the
//! surface, which is all that polygonising asks.

use crate::vector::{Vec3, v};

pub fn sphere(p: Vec3, centre: Vec3, radius: f64) -> f64 {
    (p - centre).length() - radius
}

/// An ellipsoid along the axes, after the first-order distance of Quilez.
pub fn ellipsoid(p: Vec3, centre: Vec3, radii: Vec3) -> f64 {
    let q = p - centre;
    let scaled = v(q.x / radii.x, q.y / radii.y, q.z / radii.z);
    let slope = v(scaled.x / radii.x, scaled.y / radii.y, scaled.z / radii.z);
    let level = scaled.length();
    if level < 1e-9 {
        return -radii.x.min(radii.y).min(radii.z);
    }
    level * (level - 1.0) / slope.length()
}

/// A capsule whose radius runs from `ra` at `a` to `rb` at `b`.
pub fn cone(p: Vec3, a: Vec3, b: Vec3, ra: f64, rb: f64) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    (p - a - along * t).length() - (ra + (rb - ra) * t)
}

/// Capsules through a chain of (point, radius) pairs.
pub fn chain(p: Vec3, points: &[(Vec3, f64)]) -> f64 {
    points.windows(2).map(|pair| cone(p, pair[0].0, pair[1].0, pair[0].1, pair[1].1)).fold(f64::INFINITY, f64::min)
}

/// The union with a fillet about `blend` wide.
pub fn join(a: f64, b: f64, blend: f64) -> f64 {
    let h = (blend - (a - b).abs()).max(0.0) / blend;
    a.min(b) - h * h * blend * 0.25
}

/// The intersection with an edge rounded over about `blend`.
pub fn meet(a: f64, b: f64, blend: f64) -> f64 {
    -join(-a, -b, blend)
}

/// `a` with `b` carved out of it.
pub fn carve(a: f64, b: f64, blend: f64) -> f64 {
    meet(a, -b, blend)
}

/// A soft bump of height 1 in an ellipsoid, 0 outside it: a stroke of clay to
/// take from a distance (add matter) or add to it (scrape off).
pub fn stroke(p: Vec3, centre: Vec3, radii: Vec3) -> f64 {
    let q = p - centre;
    let (x, y, z) = (q.x / radii.x, q.y / radii.y, q.z / radii.z);
    let rest = 1.0 - (x * x + y * y + z * z);
    if rest > 0.0 { rest * rest * rest } else { 0.0 }
}

/// The same along a segment, `radius` wide on all sides.
pub fn stroke_along(p: Vec3, a: Vec3, b: Vec3, radius: f64) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    let q = p - a - along * t;
    let rest = 1.0 - q.dot(q) / (radius * radius);
    // Fades toward both ends, so that a furrow runs out in the flesh.
    let fade = 1.0 - (2.0 * t - 1.0) * (2.0 * t - 1.0) * 0.7;
    if rest > 0.0 { rest * rest * fade } else { 0.0 }
}

/// The distance in the xy plane to a closed polygon, negative inside.
pub fn polygon(x: f64, y: f64, corners: &[[f64; 2]]) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut inside = false;
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
        let (wx, wy) = (x - a[0], y - a[1]);
        let t = ((wx * ex + wy * ey) / (ex * ex + ey * ey)).clamp(0.0, 1.0);
        let (dx, dy) = (wx - ex * t, wy - ey * t);
        nearest = nearest.min(dx * dx + dy * dy);
        if (a[1] > y) != (b[1] > y) && x < a[0] + ex * (y - a[1]) / ey {
            inside = !inside;
        }
    }
    if inside { -nearest.sqrt() } else { nearest.sqrt() }
}

/// The foremost surface point above (x, y): walks from +z toward the field.
pub fn front_of(field: &dyn Fn(Vec3) -> f64, x: f64, y: f64) -> Vec3 {
    let mut z = 20.0;
    for _ in 0..200 {
        let distance = field(v(x, y, z));
        if distance < 1e-4 || z < -20.0 {
            break;
        }
        z -= 0.7 * distance;
    }
    v(x, y, z)
}
