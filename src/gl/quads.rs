//! Lines and points as quads that face the eye, of any width: pure geometry in clip space.

use crate::scene::Size;
use glam::{Vec2, Vec4};

/// Returns four corners per line in clip space: the line's image, widened at right angles to the line.
///
/// `ends` are in clip space. Parts before the near plane are cut off; lines seen end-on have no image.
pub(super) fn line_quads(ends: impl Iterator<Item = [Vec4; 2]>, size: Size, width_px: f32) -> Vec<[f32; 4]> {
    let pixels = half_size(size);
    ends.filter_map(behind_near_plane)
        .filter_map(|[a, b]| {
            let along = (image(b) - image(a)) * pixels;
            let across = along.perp().try_normalize()? * (width_px * 0.5) / pixels;
            Some([moved(a, -across), moved(b, -across), moved(b, across), moved(a, across)])
        })
        .flatten()
        .collect()
}

/// Returns four corners per point, at both ends of each line: squares of this size.
pub(super) fn point_quads(ends: impl Iterator<Item = [Vec4; 2]>, size: Size, size_px: f32) -> Vec<[f32; 4]> {
    let half = Vec2::splat(size_px * 0.5) / half_size(size);
    ends.flatten()
        .filter(|point| point.w > 0.0 && point.z >= -point.w)
        .flat_map(|point| {
            let corner = |x: f32, y: f32| moved(point, half * Vec2::new(x, y));
            [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
        })
        .collect()
}

/// Pixels from the picture's middle to its edges.
fn half_size(size: Size) -> Vec2 {
    Vec2::new(size.width as f32, size.height as f32) * 0.5
}

/// Returns a point's place in the picture, [-1, 1] both ways.
fn image(point: Vec4) -> Vec2 {
    Vec2::new(point.x, point.y) / point.w
}

/// Moves a point in the picture; its depth stays.
fn moved(point: Vec4, by: Vec2) -> [f32; 4] {
    [point.x + by.x * point.w, point.y + by.y * point.w, point.z, point.w]
}

/// The part of a line behind the near plane, z = -w, where w is above 0.
pub(super) fn behind_near_plane([a, b]: [Vec4; 2]) -> Option<[Vec4; 2]> {
    let (depth_a, depth_b) = (a.z + a.w, b.z + b.w);
    let at_plane = || a.lerp(b, depth_a / (depth_a - depth_b));
    let ends = match (depth_a >= 0.0, depth_b >= 0.0) {
        (true, true) => [a, b],
        (true, false) => [a, at_plane()],
        (false, true) => [at_plane(), b],
        (false, false) => return None,
    };
    (ends[0].w > 0.0 && ends[1].w > 0.0).then_some(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size { width: 200, height: 100 };

    #[test]
    fn a_line_becomes_a_quad_of_its_width_in_pixels() {
        let ends = [Vec4::new(-1.0, 0.0, 0.5, 2.0), Vec4::new(0.5, 0.5, 0.0, 1.0)];
        let quad: Vec<Vec2> = line_quads([ends].into_iter(), SIZE, 6.0)
            .into_iter()
            .map(|corner| image(Vec4::from_array(corner)) * half_size(SIZE))
            .collect();
        let [a, b, c, d] = quad[..] else { panic!("{quad:?}") };
        assert!(((d - a).length() - 6.0).abs() < 1e-4 && ((c - b).length() - 6.0).abs() < 1e-4);
        assert!((b - a).dot(d - a).abs() < 1e-3, "its ends are square");
        assert!(((a + d) * 0.5 - Vec2::new(-50.0, 0.0)).length() < 1e-4);
    }

    #[test]
    fn what_is_before_the_near_plane_is_cut_off() {
        let behind = Vec4::new(0.0, 0.0, 0.0, 1.0);
        let before = Vec4::new(4.0, 0.0, -3.0, 1.0);
        let quads = line_quads([[behind, before], [before, before]].into_iter(), SIZE, 2.0);
        assert_eq!(quads.len(), 4);
        assert!(quads.iter().all(|[_, _, z, w]| *z >= -*w - 1e-6));
        assert!(line_quads([[behind, behind]].into_iter(), SIZE, 2.0).is_empty(), "no image, no direction");
    }

    #[test]
    fn a_point_becomes_a_square() {
        let quad = point_quads([[Vec4::W, Vec4::new(0.0, 0.0, -9.0, 1.0)]].into_iter(), SIZE, 10.0);
        assert_eq!(quad.len(), 4, "the other end is before the near plane");
        assert_eq!(quad[2], [0.05, 0.1, 0.0, 1.0]);
    }
}
