//! Whether a model seems to lie: put down on each of its six ends, it stands on one alone, and that end is not at the bottom.
//!
//! OBJ, PLY and STL do not say which axis is up. An animal stands on its feet and a bust on its base, and on nothing else. This only hints:
//! parts of machines stand on several ends, and a slab may well stand on its edge. A model that stands on its bottom has a shadow.

use super::{Mesh, UpAxis, double_area};
use crate::tolerances::{BASE_DEPTH, BASE_HEIGHT, BASE_MARGIN, BASE_SHARE};
use glam::{DVec2, DVec3};

/// An end of a model: an axis, and whether it is the highest place on it.
type End = (usize, bool);

/// A model's bottom, as read.
const BOTTOM: End = (1, false);

/// Whether this model, y up as it was read, stands firmly once the file's axis `up` is up, on no other of its ends, and is no slab then.
pub(super) fn seems_to_lie(mesh: &Mesh, up: UpAxis) -> bool {
    // A file with z up by custom was turned: its y is now -z.
    let base = match up {
        UpAxis::Z => (2, false),
        UpAxis::Y => (2, true),
        _ => return false,
    };
    if is_slab(mesh, base) {
        return false;
    }
    let middle = middle_of_surface(mesh);
    // Most models do not stand there, and are done.
    stands(mesh, base, middle, BASE_MARGIN)
        && ends().filter(|end| *end != base).all(|end| !stands(mesh, end, middle, 0.0))
}

/// Whether a model is low above an end.
fn is_slab(mesh: &Mesh, (axis, _): End) -> bool {
    let (low, high) = mesh.bounds();
    let extent = high - low;
    extent[axis] < BASE_HEIGHT * extent.max_element()
}

impl Mesh {
    /// Whether it stands on its bottom: its base is wide, the middle of the surface is above it, and it is no slab.
    pub(crate) fn stands(&self) -> bool {
        !is_slab(self, BOTTOM) && stands(self, BOTTOM, middle_of_surface(self), 0.0)
    }
}

/// All six, the bottom first: most models stand on it.
fn ends() -> impl Iterator<Item = End> {
    let all = (0..3).flat_map(|axis| [(axis, false), (axis, true)]);
    [BOTTOM].into_iter().chain(all.filter(|end| *end != BOTTOM))
}

/// Whether a model stands on an end: what touches the ground there is wide, and the model's middle is above it, so far from its rim.
fn stands(mesh: &Mesh, (axis, is_highest): End, middle: DVec3, margin: f64) -> bool {
    let (low, high) = mesh.bounds();
    let (extent, flat) = (high - low, |place: DVec3| DVec2::new(place[(axis + 1) % 3], place[(axis + 2) % 3]));
    let side = flat(extent);
    let depth = |place: &DVec3| if is_highest { high[axis] - place[axis] } else { place[axis] - low[axis] };
    let touching = mesh.positions.iter().filter(|place| depth(place) <= BASE_DEPTH * extent[axis]);
    let rim = hull(touching.map(|place| flat(*place)).collect());
    if rim.len() < 3 || side.x * side.y <= 0.0 {
        return false;
    }
    let sides = || rim.iter().zip(rim.iter().cycle().skip(1));
    let inside = sides().map(|(a, b)| (*b - *a).normalize_or_zero().perp_dot(flat(middle) - *a));
    double_area(&rim) >= 2.0 * BASE_SHARE * side.x * side.y
        && inside.fold(f64::INFINITY, f64::min) > margin * (side.x * side.y).sqrt()
}

/// The middle of a model's surface, every piece of it by its area.
fn middle_of_surface(mesh: &Mesh) -> DVec3 {
    let (mut sum, mut areas) = (DVec3::ZERO, 0.0);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| mesh.positions[index as usize]);
        let area = (b - a).cross(c - a).length();
        sum += (a + b + c) * (area / 3.0);
        areas += area;
    }
    sum / areas.max(f64::MIN_POSITIVE)
}

/// The corners of the convex hull, counterclockwise (Andrew's monotone chain); two of points on a line or in one
/// place.
pub(crate) fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., before, last] = chain[..]
                && (last - before).perp_dot(*point - last) <= 0.0
            {
                chain.pop();
            }
            chain.push(*point);
        }
        // The last one begins the other half, unless it is the only one.
        chain.truncate(chain.len().saturating_sub(1).max(1));
        chain
    };
    let mut all = half(&mut points.iter());
    all.extend(half(&mut points.iter().rev()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, load};

    /// A pyramid as high as wide that stands on four corners at the lowest z, closed below or not.
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
    fn a_bust_stands_and_a_slab_and_a_pyramid_on_its_side_do_not() {
        let mesh = |name: &str| load(name, &LoadOptions::default()).unwrap().mesh;
        assert!(mesh("../../models/bust.obj").stands());
        assert!(!pyramid(true).stands());
        let mut slab = mesh("../../models/open-box.obj");
        slab.positions.iter_mut().for_each(|place| place.y *= 0.3);
        assert!(!slab.stands());
    }

    #[test]
    fn what_stands_on_its_feet_alone_lies_wherever_they_are_not_below() {
        for has_base in [true, false] {
            let mesh = pyramid(has_base);
            // As a file with y up is read, whose z is up indeed; and as one with z up, whose y is.
            assert!(seems_to_lie(&mesh, UpAxis::Z) && !seems_to_lie(&mesh, UpAxis::Y), "on its lowest z");
            let over = turned(&turned(&mesh, UpAxis::Z), UpAxis::Z);
            assert!(
                seems_to_lie(&over, UpAxis::Y) && !seems_to_lie(&over, UpAxis::Z),
                "a file with y up, read with z up"
            );
            let upright = turned(&mesh, UpAxis::Z);
            assert!(!seems_to_lie(&upright, UpAxis::Z) && !seems_to_lie(&upright, UpAxis::Y));
            for unknown in [UpAxis::X, UpAxis::MinusY, UpAxis::Auto] {
                assert!(!seems_to_lie(&mesh, unknown));
            }
        }
    }

    #[test]
    fn what_stands_on_two_ends_or_nearly_falls_or_is_low_gives_no_hint() {
        let mut prism = pyramid(true);
        prism.positions.push(DVec3::new(0.0, 0.0, 1.0));
        prism.positions[4] = DVec3::new(-1.0, 0.0, 2.0);
        let top = prism.positions.len() as u32;
        prism.positions.extend([DVec3::new(1.0, -0.8, 2.0), DVec3::new(1.0, 0.8, 2.0)]);
        prism.triangles.push([4, top, top + 1]);
        assert!(!seems_to_lie(&prism, UpAxis::Z), "a triangle at the highest z is an end to stand on, too");
        let mut leaning = pyramid(false);
        leaning.positions[4].x = 4.0;
        assert!(!seems_to_lie(&leaning, UpAxis::Z), "its middle is beside its feet");
        let mut slab = pyramid(true);
        slab.positions.iter_mut().for_each(|point| point.z *= 0.4);
        assert!(!seems_to_lie(&slab, UpAxis::Z), "lower than wide");
        assert!(!seems_to_lie(&Mesh::triangle(), UpAxis::Z), "flat all over");
    }

    #[test]
    fn a_box_stands_on_every_end() {
        let positions: Vec<DVec3> =
            (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let cube = Mesh { positions, triangles, ..Mesh::triangle() };
        let middle = middle_of_surface(&cube);
        assert!((middle - DVec3::splat(0.5)).length() < 1e-12);
        assert_eq!(ends().filter(|end| stands(&cube, *end, middle, 0.4)).count(), 6);
        assert!(!seems_to_lie(&cube, UpAxis::Z) && !seems_to_lie(&cube, UpAxis::Y));
    }

    #[test]
    fn a_hull_has_the_outer_corners_and_a_line_has_two() {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0], [0.0, 0.0]];
        let hull_of = |points: &[[f64; 2]]| hull(points.iter().map(|point| DVec2::from_array(*point)).collect());
        assert_eq!(hull_of(&points), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(DVec2::from_array));
        assert!(hull_of(&points[..3]).len() < 3 && hull_of(&points[..1]) == [DVec2::ZERO; 2]);
    }
}
