//! Polygons to triangles, each keeping the polygon's orientation.
//!
//! Convex polygons become fans; the others go to the earcut crate in the plane of Newell's normal. Long ones, for which earcut
//! would not come to an end, are cut by [`ears`] if they do not cross themselves. A bent polygon may have corners that are in one line
//! of that plane and in none in space: where an ear there would have no area in the plane, the polygon is cut for the least area.

mod blockers;
mod ears;
mod simple_polygon;

use crate::limits::{CONCAVE_CORNERS, CROSSING_CORNERS};
use crate::tolerances::NEEDLE;
use earcut::Earcut;
use ears::cut_ears;
use glam::{DVec2, DVec3};
use simple_polygon::is_simple;

/// Most corners of a polygon that is cut by its area, which takes their cube.
const BENT_CORNERS: usize = 64;

/// How a polygon was cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cut {
    /// Into triangles that lie side by side.
    Whole,
    /// Into triangles of another area than its own, because it crosses itself: what they fill is chance.
    Crossing,
    /// Not at all: it has more than [`CONCAVE_CORNERS`] and is not convex, or more than [`CROSSING_CORNERS`] and crosses itself.
    TooLong,
}

/// Splits one polygon (its corners' positions, in order) into triangles of corner numbers.
///
/// `out` is cleared and gets `corners.len() - 2` triangles for a simple polygon, fewer where it has no area to cut.
/// Time grows with n log n for most long polygons; the slowest known of 32,768 corners takes a third of a second.
pub(super) fn triangulate(corners: &[DVec3], earcut: &mut Earcut<f64>, out: &mut Vec<[u32; 3]>) -> Cut {
    out.clear();
    match corners.len() {
        0..=2 => {}
        3 => out.push([0, 1, 2]),
        count => {
            let corners = &of_size_one(corners);
            let normal = newell_normal(corners);
            let cut = cut_in_plane(corners, normal, earcut, out);
            if cut == Cut::Whole && count <= BENT_CORNERS && has_upright_ears(corners, normal, out) {
                cut_by_area(corners, normal, out);
            }
            return cut;
        }
    }
    Cut::Whole
}

/// Splits a polygon of four corners or more by what is seen along its normal.
fn cut_in_plane(corners: &[DVec3], normal: DVec3, earcut: &mut Earcut<f64>, out: &mut Vec<[u32; 3]>) -> Cut {
    let count = corners.len();
    if normal == DVec3::ZERO || is_convex(corners, normal) {
        out.extend((1..count as u32 - 1).map(|i| [0, i, i + 1]));
        let has_area = normal == DVec3::ZERO && out.iter().any(|cut| area(cut.map(|i| corners[i as usize])) > NEEDLE);
        return if has_area { Cut::Crossing } else { Cut::Whole };
    }
    if count > CONCAVE_CORNERS {
        return Cut::TooLong;
    }
    let plane: Vec<DVec2> = project(corners, normal).collect();
    if count > CROSSING_CORNERS {
        let is_simple = is_simple(&plane);
        if is_simple {
            cut_ears(&plane, out);
        }
        return if is_simple { Cut::Whole } else { Cut::TooLong };
    }
    let mut indices: Vec<u32> = Vec::new();
    earcut.earcut(plane.iter().map(|point| point.to_array()), &[], &mut indices);
    out.extend(indices.chunks_exact(3).map(|t| oriented([t[0], t[1], t[2]], corners, normal)));
    let cut: f64 = out.iter().map(|cut| area(cut.map(|i| plane[i as usize].extend(0.0)))).sum();
    if (cut - normal.length() * 0.5).abs() > NEEDLE { Cut::Crossing } else { Cut::Whole }
}

/// Whether a cut lacks corners, or it or a corner has a triangle with area in space and none in the polygon's plane.
fn has_upright_ears(corners: &[DVec3], normal: DVec3, cut: &[[u32; 3]]) -> bool {
    let count = corners.len();
    let at_corners = (0..count).map(|i| [corners[i], corners[(i + 1) % count], corners[(i + 2) % count]]);
    let mut ears = at_corners.chain(cut.iter().map(|ear| ear.map(|corner| corners[corner as usize])));
    cut.len() + 2 < count || ears.any(|ear| area(ear) > NEEDLE && area_in_plane(ear, normal).abs() <= NEEDLE)
}

/// A triangle's area as seen along a normal, negative if it goes round it the other way.
fn area_in_plane(triangle: [DVec3; 3], normal: DVec3) -> f64 {
    turn(triangle).dot(normal) / normal.length() * 0.5
}

/// Splits a polygon into the triangles of least area that go round like it in its plane, if it has such.
fn cut_by_area(corners: &[DVec3], normal: DVec3, out: &mut Vec<[u32; 3]>) {
    let count = corners.len();
    // Of the corners from one to another the least area, and the third corner of the triangle at those two.
    let mut least = vec![(0.0, 0); count * count];
    for (first, last) in (0..count).rev().flat_map(|first| (first + 2..count).map(move |last| (first, last))) {
        let cut_at = |middle: usize| {
            let triangle = [first, middle, last].map(|corner| corners[corner]);
            let own = if area_in_plane(triangle, normal) > NEEDLE { area(triangle) } else { f64::INFINITY };
            (own + least[first * count + middle].0 + least[middle * count + last].0, middle)
        };
        let cuts = (first + 1..last).map(cut_at);
        least[first * count + last] = cuts.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or_default();
    }
    if least[count - 1].0.is_infinite() {
        return;
    }
    out.clear();
    let mut waiting = vec![[0, count - 1]];
    while let Some([first, last]) = waiting.pop() {
        let middle = least[first * count + last].1;
        out.push([first, middle, last].map(|corner| corner as u32));
        waiting.extend([[first, middle], [middle, last]].into_iter().filter(|[first, last]| first + 1 < *last));
    }
}

/// Twice a triangle's area as a vector along its normal.
fn turn([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

fn area(triangle: [DVec3; 3]) -> f64 {
    turn(triangle).length() * 0.5
}

/// The corners moved to the first one and scaled to a size of 1 to 2, which keeps products of lengths ordinary numbers. The
/// scale is a power of two: no division rounds, and corners in line stay so.
fn of_size_one(corners: &[DVec3]) -> Vec<DVec3> {
    let size = corners.iter().map(|corner| (corner - corners[0]).abs().max_element()).fold(0.0, f64::max);
    let power_of_two = f64::from_bits(size.to_bits() & f64::INFINITY.to_bits());
    let scale = if power_of_two > 0.0 { power_of_two } else { 1.0 };
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

/// Turns the triangle to wind like its polygon: earcut does not promise an order.
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

    /// The band between two bent lines, one unit apart, with this first corner, turned somehow.
    fn band(line: &[[f64; 2]], start: usize) -> Vec<DVec3> {
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
        let back = line.iter().rev().map(|[x, y]| DVec3::new(*x, *y, 1.0));
        let mut corners: Vec<DVec3> = line.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).chain(back).collect();
        corners.rotate_left(start);
        corners.iter().map(|corner| turn * *corner * 0.7).collect()
    }

    #[test]
    fn bent_polygons_are_cut_where_they_bend() {
        let arc: Vec<[f64; 2]> = (0..9).map(|i| f64::from(i) * 0.2).map(|turn| [turn.sin(), turn.cos()]).collect();
        let waves = [[0.0, 0.0], [1.0, 0.3], [2.0, 0.0], [3.0, -0.4], [4.0, 0.0]];
        for line in [&[[0.0, 0.0], [1.0, 0.3], [2.0, 0.0]][..], &arc, &waves] {
            let length: f64 = line.windows(2).map(|ends| DVec2::from(ends[0]).distance(ends[1].into())).sum();
            for start in 0..line.len() * 2 {
                let corners = band(line, start);
                let triangles = cut(&corners);
                assert_eq!(triangles.len(), corners.len() - 2);
                let area = area_vector(&corners, &triangles).1 / 0.49;
                assert!((area - length).abs() < 1e-12, "{area} of {length} from corner {start}");
            }
        }
        // Notches and corners in line of one that is bent lose nothing either.
        let notched =
            [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [1.0, 0.3, 0.5], [0.0, 0.0, 2.0]];
        let corners = notched.map(DVec3::from_array);
        let triangles = cut(&corners);
        let (half, whole) = (1.09f64.sqrt() * 1.25, area_vector(&corners, &triangles).1);
        assert_eq!(triangles.len(), 4);
        assert!((whole - 2.0 * half).abs() < 1e-12, "{whole}");
    }

    #[test]
    fn bent_polygons_on_a_grid_are_cut_as_in_their_plane_unless_an_ear_has_no_area_there() {
        let mut seed = 1u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 24) / 64.0
        };
        let mut otherwise = 0;
        for case in 0..20_000 {
            // Round a middle, some corners in line and all out of the plane by up to a quarter.
            let count = 4 + case % 5;
            let corner = |i: usize| DVec2::from_angle(std::f64::consts::TAU * i as f64 / count as f64) * 4.0;
            let flat: Vec<DVec2> = (0..count).map(|i| (corner(i) * (1.0 + next() / 4.0)).round()).collect();
            let corners: Vec<DVec3> = flat.iter().map(|at| at.extend((next() - 2.0).trunc() * 0.5)).collect();
            let (normal, mut in_plane) = (newell_normal(&corners), Vec::new());
            let size_one = of_size_one(&corners);
            let kind = cut_in_plane(&size_one, newell_normal(&size_one), &mut Earcut::new(), &mut in_plane);
            let triangles = cut(&corners);
            if triangles != in_plane {
                otherwise += 1;
                assert!(kind == Cut::Whole && has_upright_ears(&size_one, normal, &in_plane), "{corners:?}");
                let (was, is) = (area_vector(&corners, &in_plane), area_vector(&corners, &triangles));
                assert!(is.1 < was.1 + 1e-9 && is.0.distance(was.0) < 1e-9 || in_plane.len() < triangles.len());
                let upright = |ear: &[u32; 3]| area_in_plane(ear.map(|i| corners[i as usize]), normal) < 1e-9;
                assert!(!triangles.iter().any(upright), "{corners:?} {triangles:?}");
            }
        }
        assert!((20..200).contains(&otherwise), "{otherwise} of 20000");
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

    /// A comb of this many corners, with teeth as long as it is wide.
    fn comb(count: u32) -> Vec<DVec2> {
        let height = |i: u32| f64::from(matches!(i % 4, 1 | 2)) - f64::from(i == 0 || i == count - 1);
        (0..count).map(|i| DVec2::new(f64::from(i) / f64::from(count), height(i))).rev().collect()
    }

    /// A star of this many corners whose inner ones lie at `inner` of the outer ones' distance.
    fn star(count: u32, inner: f64) -> Vec<DVec2> {
        let radius = |i: u32| if i % 2 == 1 { inner } else { 1.0 };
        let turn = |i: u32| f64::from(i) / f64::from(count) * std::f64::consts::TAU;
        (0..count).map(|i| DVec2::from_angle(turn(i)) * radius(i)).collect()
    }

    /// A ring with a ring-shaped hole, joined to it by a cut.
    fn keyhole(count: u32) -> Vec<DVec2> {
        let rim = star(count - count / 2, 1.0);
        let mut keyhole: Vec<DVec2> = rim.into_iter().map(|point| point * 2.0).collect();
        keyhole.push(keyhole[0]);
        let hole = star(count / 2, 1.0);
        keyhole.push(hole[0]);
        keyhole.extend(hole.into_iter().rev());
        keyhole
    }

    /// A thin band in zigzag: only its ends are ears.
    fn zigzag(count: u32) -> Vec<DVec2> {
        let half = count / 2;
        let point = |i: u32, up: f64| DVec2::new(f64::from(i) / f64::from(half), f64::from(i % 2) + up);
        (0..half).map(|i| point(i, 0.0)).chain((0..half).rev().map(|i| point(i, 0.25))).collect()
    }

    /// A band that winds around a point forty times.
    fn spiral(count: u32) -> Vec<DVec2> {
        let half = count / 2;
        let point = |i: u32, out: f64| {
            let way = f64::from(i) / f64::from(half);
            DVec2::from_angle(way * 40.0 * std::f64::consts::TAU) * (0.05 + way + out)
        };
        (0..half).map(|i| point(i, 0.0125)).chain((0..half).rev().map(|i| point(i, 0.0))).collect()
    }

    #[test]
    fn combs_stars_keyholes_zigzags_and_spirals_of_up_to_the_promised_corners_keep_their_area() {
        let (u, v) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(-0.48, 0.36, 0.8));
        let mut counts: Vec<u32> = (2..=15).map(|power| 1 << power).collect();
        counts.extend([5, 7, 33, 1023, 1025, 1027, 1029, 8001, 16_383, 32_766]);
        for count in counts {
            let shapes = [
                ("comb", comb(count)),
                ("blunt star", star(count, 0.9)),
                ("sharp star", star(count, 1e-3)),
                ("keyhole", keyhole(count.saturating_sub(2).max(6))),
                ("zigzag", zigzag(count.max(6))),
                ("spiral", if count < 2000 { star(count, 0.5) } else { spiral(count) }),
            ];
            for (name, flat) in shapes {
                assert!(flat.len() <= CONCAVE_CORNERS);
                let corners: Vec<DVec3> = flat.iter().map(|point| u * point.x + v * point.y).collect();
                let area = (0..flat.len()).map(|i| flat[i].perp_dot(flat[(i + 1) % flat.len()])).sum::<f64>() / 2.0;
                let triangles = cut(&corners);
                let (sum, total) = area_vector(&corners, &triangles);
                assert_eq!(triangles.len(), corners.len() - 2, "{name} of {count}");
                assert!((total - area.abs()).abs() < 1e-9, "{name} of {count}: {total} instead of {area}");
                assert!(sum.distance(u.cross(v) * area) < 1e-9, "{name} of {count} is turned round");
            }
        }
    }

    #[test]
    fn polygons_of_many_corners_that_cross_wind_or_go_back_come_to_an_end() {
        let many = CONCAVE_CORNERS as u32;
        let knot = |i: u32| [2_654_435_761, 2_246_822_519].map(|factor: u32| f64::from(i.wrapping_mul(factor)));
        let flat = |points: Vec<DVec2>| -> Vec<DVec3> { points.into_iter().map(|point| point.extend(0.0)).collect() };
        assert_eq!(cut(&flat((0..many).map(|i| DVec2::from_array(knot(i))).collect())), [[0; 3]; 0]);
        let there_and_back = comb(many / 2).into_iter().chain(comb(many / 2).into_iter().rev());
        let mut none = Vec::new();
        cut_ears(&there_and_back.collect::<Vec<_>>(), &mut none);
        assert_eq!(none, [[0; 3]; 0]);
        cut(&flat((0..many as usize).map(|i| star(64, 0.5)[i % 64]).collect()));
        assert_eq!(cut(&vec![DVec3::ONE; many as usize]).len(), many as usize - 2);
        cut(&(0..many).map(|i| DVec3::X * f64::from(i % 7)).collect::<Vec<_>>());
        // A spike without area stands out of a comb, bent, and nothing is drawn beside it.
        let mut spiked = comb(2000);
        let area = area_vector(&flat(spiked.clone()), &cut(&flat(spiked.clone()))).1;
        let tip = spiked[0];
        spiked.splice(0..0, [tip, tip + DVec2::X, tip + DVec2::ONE, tip + DVec2::X]);
        let spiked = flat(spiked);
        assert!((area_vector(&spiked, &cut(&spiked)).1 - area).abs() < 1e-12);
    }

    #[test]
    fn polygons_that_cross_themselves_are_told_from_those_that_touch_themselves() {
        let of = |flat: &[DVec2]| {
            let (u, v) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(-0.48, 0.36, 0.8));
            let corners: Vec<DVec3> = flat.iter().map(|point| (u * point.x + v * point.y) * 300.0).collect();
            triangulate(&corners, &mut Earcut::new(), &mut Vec::new())
        };
        let points = |flat: &[(f64, f64)]| -> Vec<DVec2> { flat.iter().map(|(x, y)| DVec2::new(*x, *y)).collect() };
        // A bow tie of two equal halves, whose areas cancel, one of two unequal ones, and a star drawn in one go.
        assert_eq!(of(&points(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])), Cut::Crossing);
        assert_eq!(of(&points(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.3)])), Cut::Crossing);
        let pentagram: Vec<DVec2> =
            (0..5).map(|i| DVec2::from_angle(f64::from(i) * 0.8 * std::f64::consts::PI)).collect();
        assert_eq!(of(&pentagram), Cut::Crossing);
        for count in [4, 5, 32, 600, 1000] {
            assert_eq!(of(&comb(count)), Cut::Whole, "comb of {count}");
            assert_eq!(of(&star(count, 1e-3)), Cut::Whole, "star of {count}");
            assert_eq!(of(&keyhole(count.max(6))), Cut::Whole, "keyhole of {count}");
            assert_eq!(of(&zigzag(count.max(6))), Cut::Whole, "zigzag of {count}");
        }
        assert_eq!(of(&[DVec2::ZERO; 6]), Cut::Whole);
        assert_eq!(of(&points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.5, 0.0)])), Cut::Whole);
    }

    #[test]
    fn a_polygon_without_area_does_not_panic() {
        assert_eq!(cut(&[DVec3::ZERO; 5]).len(), 3);
        assert_eq!(cut(&[DVec3::ZERO, DVec3::X]).len(), 0);
    }
}
