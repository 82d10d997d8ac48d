//! Visible lines of shapes with lines known by hand.

use crate::support::lines::{
    assert_near, distance, length, lines, lines_with, of_class, only, px, px_between, scene_of, total, view,
};
use crate::support::shapes::{cuboid, icosphere, loops, mesh};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use tinta::edges::{Class, CreaseAngle};
use tinta::lines::LineSettings;
use tinta::{EdgeList, Mesh, Scene};

const NEAR: f64 = 1e-6;

fn unit_box() -> Mesh {
    cuboid(DVec3::ZERO, DVec3::ONE)
}

fn vec3(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A box's twelve edges, each with the outward normals of its two faces.
fn box_edges(low: DVec3, high: DVec3) -> Vec<([DVec3; 2], [DVec3; 2])> {
    let mut edges = Vec::new();
    for axis in 0..3 {
        for corner in 0..4 {
            let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
            let is_high = [corner & 1 == 1, corner & 2 == 2];
            let mut ends = [low; 2];
            let mut normals = [DVec3::ZERO; 2];
            ends[1][axis] = high[axis];
            for (side, other) in [first, second].into_iter().enumerate() {
                ends.iter_mut().for_each(|end| end[other] = if is_high[side] { high[other] } else { low[other] });
                normals[side][other] = if is_high[side] { 1.0 } else { -1.0 };
            }
            edges.push((ends, normals));
        }
    }
    edges
}

/// Whether the eye sees the outer side of a plane.
fn sees(scene: &Scene, point: DVec3, normal: DVec3, parallel: bool) -> bool {
    let to_eye = if parallel { scene.camera.backward() } else { scene.camera.eye - point };
    normal.dot(to_eye) > 0.0
}

#[test]
fn of_a_box_nine_edges_are_seen_and_three_are_hidden_from_any_corner() {
    let (low, high) = (vec3(-3.0, 1.0, 2.0), vec3(1.0, 2.5, 4.0));
    for name in ["iso", "30,15", "-120,50", "200,-35", "80,-5"] {
        for parallel in [false, true] {
            let scene = scene_of(vec![cuboid(low, high)], view(name, parallel));
            let found = lines(&scene);
            let mut expected: BTreeMap<(Class, bool), f64> = BTreeMap::new();
            let mut hidden = 0;
            for ([a, b], normals) in box_edges(low, high) {
                let front = normals.map(|normal| sees(&scene, a, normal, parallel));
                let class = if front[0] == front[1] { Class::Crease } else { Class::Silhouette };
                *expected.entry((class, front[0] || front[1])).or_default() += px_between(&scene, a, b);
                hidden += usize::from(!front[0] && !front[1]);
            }
            assert!(hidden >= 3, "{name} {hidden}");
            for class in [Class::Crease, Class::Silhouette] {
                for is_visible in [true, false] {
                    let expected = expected.get(&(class, is_visible)).copied().unwrap_or_default();
                    let what = format!("{name} parallel {parallel} {class:?} visible {is_visible}");
                    assert_near(of_class(&found, class, is_visible), expected, NEAR, &what);
                }
            }
            assert_eq!(found.segments.len(), 12, "{name}: no edge is cut");
            assert!(found.segments.iter().all(|segment| segment.angle_degrees == Some(90.0)));
        }
    }
}

#[test]
fn of_a_box_seen_along_an_axis_four_lines_are_visible_and_the_ones_behind_hidden() {
    for name in ["front", "back", "left", "right", "top", "bottom"] {
        let scene = scene_of(vec![cuboid(vec3(0.3, 1.0, -2.0), vec3(1.3, 3.0, 1.0))], view(name, true));
        let found = lines(&scene);
        let visible = found.segments.iter().filter(|segment| segment.is_visible).count();
        assert_eq!((visible, found.segments.len()), (4, 8), "{name}: {:#?}", found.segments);
        assert!(found.segments.iter().filter(|s| s.is_visible).all(|s| s.class == Class::Silhouette), "{name}");
        assert_near(total(&found, true), total(&found, false), NEAR, name);
        let scene = scene_of(vec![unit_box()], view(name, false));
        let found = lines(&scene);
        let visible: Vec<_> = found.segments.iter().filter(|segment| segment.is_visible).collect();
        assert_eq!((visible.len(), found.segments.len()), (4, 12), "{name} in perspective");
    }
}

#[test]
fn a_box_behind_another_is_hidden_where_the_nearer_one_is_in_front() {
    let front = cuboid(vec3(-0.5, -0.5, 2.0), vec3(0.5, 0.5, 3.0));
    let behind = cuboid(vec3(-0.25, -0.25, 0.0), vec3(1.75, 0.25, 1.0));
    for parallel in [false, true] {
        let scene = scene_of(vec![front.clone(), behind.clone()], view("front", parallel));
        let found = lines(&scene);
        let at = |x, y, z| px(&scene, vec3(x, y, z));
        let rim = at(0.5, 0.5, 3.0).x;
        let (corner, far) = (at(1.75, 0.25, 1.0), at(1.75, -0.25, 1.0));
        let (nearest, lower) = (at(-0.5, -0.5, 3.0), at(0.5, 0.5, 3.0));
        let outline = 2.0 * ((lower.x - nearest.x) + (nearest.y - lower.y));
        let of_object = |object: u32, is_visible: bool| -> f64 {
            let pieces = found.segments.iter().filter(|s| s.object == object && s.is_visible == is_visible);
            pieces.map(length).sum()
        };
        let mut front_visible = outline;
        if !parallel {
            // The eye is not on this box's axis but on the scene's: it sees its left side.
            let eye = scene.camera.eye;
            assert!(eye.x > 0.5, "{eye}");
            let right =
                [(-0.5, 3.0), (0.5, 3.0)].map(|(y, z)| px_between(&scene, vec3(0.5, y, z), vec3(0.5, y, z - 1.0)));
            front_visible += right[0] + right[1] + px_between(&scene, vec3(0.5, -0.5, 2.0), vec3(0.5, 0.5, 2.0));
        }
        assert_near(of_object(0, true), front_visible, NEAR, &format!("the nearer box, parallel {parallel}"));
        if parallel {
            let seen = 2.0 * (corner.x - rim) + (far.y - corner.y);
            assert_near(of_object(1, true), seen, NEAR, "the farther box");
            let cut: Vec<f64> = found
                .segments
                .iter()
                .filter(|s| s.object == 1 && s.is_visible)
                .flat_map(|s| s.ends_px)
                .map(|end| end.x)
                .filter(|x| (x - rim).abs() < 1.0)
                .collect();
            assert_eq!(cut.len(), 2);
            cut.iter().for_each(|x| assert_near(*x, rim, NEAR, "where it disappears"));
        } else {
            // The farther rim of the nearer box's right side is where the other one appears.
            let rim = at(0.5, 0.5, 3.0).x.max(at(0.5, 0.5, 2.0).x);
            let seen = 2.0 * (corner.x - rim) + (far.y - corner.y);
            assert_near(of_object(1, true), seen, NEAR, "the farther box");
        }
    }
}

#[test]
fn a_box_half_through_a_box_is_cut_by_four_lines_in_the_place_where_it_enters() {
    let outer = cuboid(DVec3::splat(-1.0), DVec3::ONE);
    let (low, high) = (vec3(0.0, -0.5, -0.25), vec3(2.0, 0.5, 0.75));
    for parallel in [false, true] {
        let scene = scene_of(vec![outer.clone(), cuboid(low, high)], view("50,20", parallel));
        let found = lines(&scene);
        let corner = |y: f64, z: f64| vec3(1.0, y, z);
        let rim = [corner(low.y, low.z), corner(low.y, high.z), corner(high.y, high.z), corner(high.y, low.z)];
        let sides: Vec<[DVec2; 2]> =
            (0..4).map(|side| [px(&scene, rim[side]), px(&scene, rim[(side + 1) % 4])]).collect();
        let side_length = |side: usize| sides[side][0].distance(sides[side][1]);
        // Visible above the entering box and in front of it; hidden under it and behind it.
        let (visible, hidden) = (side_length(1) + side_length(2), side_length(0) + side_length(3));
        assert_near(of_class(&found, Class::Intersection, true), visible, NEAR, "visible intersection");
        assert_near(of_class(&found, Class::Intersection, false), hidden, NEAR, "hidden intersection");
        for segment in found.segments.iter().filter(|segment| segment.class == Class::Intersection) {
            let lies_on = |[a, b]: &[DVec2; 2]| {
                segment.ends_px.iter().all(|end| ((*b - *a).perp_dot(*end - *a) / a.distance(*b)).abs() < NEAR)
            };
            assert!(sides.iter().any(lies_on), "{segment:?}");
            assert_near(segment.angle_degrees.unwrap(), 90.0, 1e-9, "angle");
        }
        // The four edges along x are visible where they emerge, except the one below and behind.
        let along_x = [(low.y, low.z), (low.y, high.z), (high.y, high.z), (high.y, low.z)];
        let seen: f64 =
            along_x[1..].iter().map(|(y, z)| px_between(&scene, vec3(1.0, *y, *z), vec3(2.0, *y, *z))).sum();
        let is_along_x = |edge: [u32; 2]| edge[0] ^ edge[1] == 1;
        let found_seen: f64 = found
            .segments
            .iter()
            .filter(|s| s.object == 1 && s.is_visible && s.edge.is_some_and(is_along_x))
            .map(length)
            .sum();
        assert_near(found_seen, seen, NEAR, "edges that come out");
        assert_eq!(found.edges.intersection, found.segments.iter().filter(|s| s.edge.is_none()).count());
    }
}

#[test]
fn the_rim_of_an_open_box_is_seen_from_above_and_its_floor_where_the_walls_let_it() {
    let mut open = unit_box();
    let top = |triangle: &[u32; 3]| triangle.iter().all(|corner| corner >> 1 & 1 == 1);
    open.triangles.retain(|triangle| !top(triangle));
    assert_eq!(open.triangles.len(), 10);
    // Straight ahead and from above: in parallel projection heights are scaled by the cosine, depths by the sine.
    let scene = scene_of(vec![open], view("0,60", true));
    let unit = px_between(&scene, DVec3::ZERO, DVec3::X);
    let found = lines(&scene);
    let sin = f64::to_radians(60.0).sin();
    assert_near(of_class(&found, Class::Boundary, true), unit * (2.0 + 2.0 * sin), NEAR, "rim");
    assert_near(of_class(&found, Class::Boundary, false), 0.0, NEAR, "hidden rim");
    // The front wall hides the floor as far back as cot 60 = 0.577. The rest of both sides is in view, exactly behind the side
    // walls' rims and thus hidden; the back edge of the floor is visible between, and both back uprights are behind rims.
    let floor_back: f64 = found.segments.iter().filter(|s| s.edge == Some([0, 1]) && s.is_visible).map(length).sum();
    assert_near(floor_back, unit, NEAR, "the floor's back edge");
    let front_bottom: f64 = found.segments.iter().filter(|s| s.edge == Some([4, 5]) && s.is_visible).map(length).sum();
    assert_near(front_bottom, unit, NEAR, "the front wall's lower edge");
}

#[test]
fn the_contour_of_an_icosphere_is_one_closed_loop_that_is_seen_whole() {
    for level in 0..=5 {
        for (name, parallel) in [("30,15", false), ("iso", true), ("-77,-41", false), ("12,34", true)] {
            let sphere = icosphere(level);
            let scene = scene_of(vec![sphere.clone()], view(name, parallel));
            let settings =
                LineSettings { crease_angle: CreaseAngle::from_degrees(180.0).unwrap(), ..LineSettings::default() };
            let found = lines_with(&scene, &settings);
            let what = format!("level {level} {name} parallel {parallel}");
            assert!(found.segments.iter().all(|s| s.is_visible && s.class == Class::Silhouette), "{what}");
            let edges = EdgeList::new(&sphere);
            let numbers: Vec<u32> = found
                .segments
                .iter()
                .map(|segment| edges.positions().iter().position(|ends| Some(*ends) == segment.edge).unwrap() as u32)
                .collect();
            assert_eq!(loops(&edges, &numbers), Some(1), "{what}");
            // Bit for bit the same ends, two at each vertex.
            let mut ends: BTreeMap<[u64; 2], usize> = BTreeMap::new();
            for end in found.segments.iter().flat_map(|segment| segment.ends_px) {
                *ends.entry(end.to_array().map(f64::to_bits)).or_default() += 1;
            }
            assert!(ends.values().all(|count| *count == 2), "{what}");
            assert_eq!(found.edges.silhouette, numbers.len(), "{what}");
        }
    }
}

/// A torus around y.
fn torus(ring: f64, tube: f64, around: u32, across: u32) -> Mesh {
    let angle = |part: u32, parts: u32| f64::from(part % parts) / f64::from(parts) * TAU;
    let point = |index: u32| {
        let (u, v) = (angle(index / across, around), angle(index % across, across));
        vec3((ring + tube * v.cos()) * u.cos(), tube * v.sin(), (ring + tube * v.cos()) * u.sin())
    };
    let number = |i: u32, j: u32| i % around * across + j % across;
    let quads = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)];
        [[a, b, c], [a, c, d]]
    });
    mesh((0..around * across).map(point).collect(), triangles.collect())
}

#[test]
fn of_a_torus_the_inner_contour_is_hidden_where_the_tube_lies_before_it() {
    let (ring, tube) = (2.0, 0.6);
    let torus = torus(ring, tube, 240, 120);
    for degrees in [5.0, 20.0, 30.0, 40.0, 65.0] {
        let elevation = f64::to_radians(degrees);
        let scene = scene_of(vec![torus.clone()], view(&format!("0,{degrees}"), true));
        let found = lines_with(&scene, &only(&[Class::Silhouette]));
        // The smooth torus: its contour is where the normal is across the view; whether that is seen, by its equation.
        let to_eye = vec3(0.0, elevation.sin(), elevation.cos());
        let is_in_tube = |p: DVec3| (p.x.hypot(p.z) - ring).hypot(p.y) < tube - 2e-4;
        let mut smooth: [Vec<DVec2>; 2] = Default::default();
        let parts = 1500;
        for shift in [0.0, TAU / 2.0] {
            for part in 0..parts {
                let u = part as f64 / parts as f64 * TAU;
                let v = (-u.sin() * elevation.cos() / elevation.sin()).atan() + shift;
                let at = vec3((ring + tube * v.cos()) * u.cos(), tube * v.sin(), (ring + tube * v.cos()) * u.sin());
                let is_hidden = (1..1500).any(|step| is_in_tube(at + to_eye * (f64::from(step) * 4e-3)));
                assert!(shift > 0.0 || !is_hidden, "the outer contour is seen");
                smooth[usize::from(!is_hidden)].push(px(&scene, at));
            }
        }
        // A contour with folds zigzags on a mesh: its place agrees with the smooth one, its length does not.
        for is_visible in [true, false] {
            let pieces: Vec<[DVec2; 2]> =
                found.segments.iter().filter(|s| s.is_visible == is_visible).map(|s| s.ends_px).collect();
            let points = &smooth[usize::from(is_visible)];
            // Hidden folds lie along the visible contour too.
            let places: Vec<DVec2> = smooth[0].iter().filter(|_| !is_visible).chain(&smooth[1]).copied().collect();
            let from_points = |p: DVec2| places.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            let from_pieces = |p: DVec2| pieces.iter().map(|ends| distance(p, *ends)).fold(f64::INFINITY, f64::min);
            let missed = points.iter().filter(|point| from_pieces(**point) > 0.5).count();
            let all: f64 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
            let invented = pieces.iter().filter(|[a, b]| from_points((*a + *b) * 0.5) > 1.5);
            let invented: f64 = invented.map(|[a, b]| a.distance(*b)).sum();
            let what = format!("{degrees} degrees, visible {is_visible}: of {} points", points.len());
            assert!(missed as f64 <= 0.01 * points.len() as f64, "{what} {missed} have no line");
            assert!(invented <= 0.05 * all, "{what} {invented} of {all} px are none");
        }
        // The ellipse in the middle of the tube has its smallest radius of curvature, 2 sin^2, above the tube's.
        assert_eq!(smooth[0].is_empty(), ring * elevation.sin().powi(2) > tube, "it folds at {degrees}");
    }
}

/// Steps of height and depth 1 and width 3, the first at the front.
fn stairs(steps: u32) -> Mesh {
    let count = f64::from(steps);
    let mut profile = vec![DVec2::new(0.0, 0.0), DVec2::new(count, 0.0)];
    for step in 0..steps {
        let (z, y) = (count - f64::from(step), f64::from(step) + 1.0);
        profile.extend([DVec2::new(z, y), DVec2::new(z - 1.0, y)]);
    }
    let sides = profile.len() as u32;
    let positions: Vec<DVec3> = [0.0, 3.0].iter().flat_map(|x| profile.iter().map(|p| vec3(*x, p.y, p.x))).collect();
    let mut triangles = Vec::new();
    for side in 0..sides {
        let next = (side + 1) % sides;
        triangles.extend([[side, side + sides, next + sides], [side, next + sides, next]]);
    }
    // Every point of a cheek is seen from its lower back corner.
    for corner in 1..sides - 1 {
        triangles.extend([[0, corner, corner + 1], [sides, sides + corner + 1, sides + corner]]);
    }
    mesh(positions, triangles)
}

#[test]
fn of_stairs_from_the_front_one_line_is_seen_for_each_step_and_one_for_the_floor() {
    let scene = scene_of(vec![stairs(4)], view("front", true));
    let found = lines(&scene);
    let unit = px_between(&scene, DVec3::ZERO, DVec3::X);
    assert_near(total(&found, true), unit * (5.0 * 3.0 + 2.0 * 4.0), NEAR, "visible");
    for y in 0..=4 {
        let row = px(&scene, vec3(0.0, f64::from(y), 0.0)).y;
        let on_row =
            found.segments.iter().filter(|s| s.is_visible && s.ends_px.iter().all(|p| (p.y - row).abs() < NEAR));
        assert_near(on_row.map(length).sum(), 3.0 * unit, NEAR, &format!("the line at {y}"));
    }
}

#[test]
fn a_tiny_box_a_million_units_away_has_the_lines_of_any_box() {
    let size = 1.0 / 1024.0;
    let here = cuboid(DVec3::ZERO, DVec3::splat(size));
    let away = vec3(1e6, -1e6, 1e6);
    let there = cuboid(away, away + size);
    for (name, parallel) in [("30,15", false), ("iso", true), ("front", true)] {
        let [near, far] = [&here, &there].map(|mesh| lines(&scene_of(vec![mesh.clone()], view(name, parallel))));
        assert_eq!(near.segments.len(), far.segments.len(), "{name}");
        for (a, b) in near.segments.iter().zip(&far.segments) {
            assert_eq!((a.class, a.is_visible, a.edge), (b.class, b.is_visible, b.edge), "{name}");
            for end in 0..2 {
                assert!(a.ends_px[end].distance(b.ends_px[end]) < 1e-3, "{name} {a:?} {b:?}");
            }
        }
    }
}
