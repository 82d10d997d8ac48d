//! The written rules: contact, edges seen end-on, ties, T-junctions, duplicates, cracks, the near plane.

use crate::support::families::{extruded, prism};
use crate::support::lines::{
    assert_near, length, lines, lines_with, of_class, only, px_between, scene_of, total, view,
};
use crate::support::shapes::{cuboid, joined, mesh};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use tinta::edges::{Class, ClassSet};
use tinta::lines::{LineSegment, LineSettings, VisibleLines};
use tinta::{CameraSettings, Mesh, Scene, SceneSettings};

const NEAR: f64 = 1e-6;

fn vec3(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn unit_box() -> Mesh {
    cuboid(DVec3::ZERO, DVec3::ONE)
}

/// Turned arbitrarily, off every axis.
fn turned(mesh: Mesh) -> Mesh {
    let turn = glam::DMat3::from_axis_angle(vec3(0.3, -0.8, 0.52).normalize(), 0.777);
    Mesh { positions: mesh.positions.iter().map(|point| turn * *point).collect(), ..mesh }
}

/// A square in the plane of a height, seen from above.
fn plate(height: f64) -> Mesh {
    let corner = |x, z| vec3(x, height, z);
    mesh(vec![corner(-2.0, -2.0), corner(-2.0, 3.0), corner(3.0, 3.0), corner(3.0, -2.0)], vec![[0, 1, 2], [0, 2, 3]])
}

fn back_to_front(mut mesh: Mesh) -> Mesh {
    mesh.triangles.iter_mut().for_each(|triangle| triangle.reverse());
    mesh
}

#[test]
fn a_box_on_a_plate_keeps_its_lower_edges_whole() {
    let views = [view("30,15", false), view("-50,40", true), view("iso", false), view("200,4", true)];
    for camera in views {
        for ground in [plate(0.0), back_to_front(plate(0.0)), cuboid(vec3(-2.0, -0.3, -2.0), vec3(3.0, 0.0, 3.0))] {
            for is_turned in [false, true] {
                let place = |mesh: Mesh| if is_turned { turned(mesh) } else { mesh };
                let scene = scene_of(vec![place(unit_box()), place(ground.clone())], camera.clone());
                let found = lines(&scene);
                // Seen from below the plate hides it all.
                let mut pieces = [0; 12];
                let bottom = [[0, 1], [0, 4], [1, 5], [4, 5]];
                for segment in found.segments.iter().filter(|segment| segment.object == 0) {
                    let edge = segment.edge.unwrap();
                    pieces[bottom.iter().position(|known| *known == edge).unwrap_or(11)] += 1;
                }
                assert_eq!(pieces[..4], [1; 4], "{camera:?} turned {is_turned}");
                assert_eq!(
                    of_class(&found, Class::Intersection, true) + of_class(&found, Class::Intersection, false),
                    0.0
                );
            }
        }
    }
}

#[test]
fn a_box_that_touches_a_plate_does_not_intersect_it_whichever_way_the_plate_is_wound() {
    for (low, high) in [(0.0, 1.0), (-1.0, 0.0)] {
        for ground in [plate(0.0), back_to_front(plate(0.0))] {
            let solid = cuboid(vec3(0.0, low, 0.0), vec3(1.0, high, 1.0));
            let scene = scene_of(vec![solid, ground], view("30,15", false));
            let found = lines_with(&scene, &only(&[Class::Intersection]));
            assert_eq!((found.segments.len(), found.edges.intersection), (0, 0), "box from {low} to {high}");
        }
    }
}

#[test]
fn the_common_edges_of_touching_boxes_are_drawn_once() {
    let boxes = [unit_box(), cuboid(DVec3::X, vec3(2.0, 1.0, 1.0))];
    let front = scene_of(boxes.to_vec(), view("front", true));
    let unit = px_between(&front, DVec3::ZERO, DVec3::X);
    let found = lines(&front);
    assert_near(total(&found, true), 7.0 * unit, NEAR, "from the front");
    for (name, parallel) in [("30,30", false), ("iso", true), ("-20,10", false), ("70,20", true)] {
        for are_turned in [false, true] {
            let place = |mesh: &Mesh| if are_turned { turned(mesh.clone()) } else { mesh.clone() };
            let scene = scene_of(boxes.iter().map(place).collect(), view(name, parallel));
            let found = lines(&scene);
            let sum = total(&found, true) + total(&found, false);
            let edge = |object: usize, [a, b]: [u32; 2]| {
                let positions = &scene.objects[object].mesh.positions;
                px_between(&scene, positions[a as usize], positions[b as usize])
            };
            let edges = |axis: u32| (0..8).filter(move |i| i >> axis & 1 == 0).map(move |i| [i, i | 1 << axis]);
            let first: f64 = (0..3).flat_map(edges).map(|ends| edge(0, ends)).sum();
            let second: f64 =
                (0..3).flat_map(edges).filter(|[a, b]| a & 1 == 1 || b & 1 == 1).map(|ends| edge(1, ends)).sum();
            assert_near(sum, first + second, NEAR, &format!("{name} turned {are_turned}"));
        }
    }
}

#[test]
fn an_edge_that_lies_on_a_longer_one_from_the_same_vertex_is_drawn_once() {
    // In one mesh, welded: a low box beside a high one, flush at the front, with shared corners.
    let (low, high) = (unit_box(), cuboid(DVec3::X, vec3(2.0, 2.0, 1.0)));
    for meshes in [vec![low.clone(), high.clone()], vec![joined(&[low, high])]] {
        let scene = scene_of(meshes, view("front", true));
        let unit = px_between(&scene, DVec3::ZERO, DVec3::X);
        // Both outlines: 4 and 6, less the common unit.
        assert_near(total(&lines(&scene), true), 9.0 * unit, NEAR, &format!("{} objects", scene.objects.len()));
    }
}

#[test]
fn edges_seen_end_on_are_left_out() {
    let scene = scene_of(vec![unit_box()], view("front", true));
    let ends_on = |edge: [u32; 2]| edge[0] ^ edge[1] == 4;
    assert!(lines(&scene).segments.iter().all(|segment| !ends_on(segment.edge.unwrap())));
    // The eye on the line of one edge in perspective.
    let eye = Some(vec3(1.0, 1.0, 5.0));
    let scene =
        scene_of(vec![unit_box()], CameraSettings { eye, target: Some(DVec3::ONE), ..CameraSettings::default() });
    let found = lines(&scene);
    assert!(found.segments.iter().all(|segment| segment.edge != Some([3, 7])), "{found:?}");
    assert_eq!(found.segments.len(), 11);
}

#[test]
fn what_lies_exactly_behind_a_rim_is_hidden() {
    // Five equal boxes in a row, each exactly behind the one before.
    for name in ["front", "back", "top", "left"] {
        let axis = if name == "top" {
            DVec3::Y
        } else if name == "left" {
            DVec3::X
        } else {
            DVec3::Z
        };
        let boxes = (0..5).map(|i| cuboid(axis * 1.7 * f64::from(i), axis * 1.7 * f64::from(i) + vec3(1.0, 1.1, 1.3)));
        let scene = scene_of(boxes.collect(), view(name, true));
        let found = lines(&scene);
        assert_eq!(found.segments.iter().filter(|segment| segment.is_visible).count(), 4, "{name}");
        assert_near(total(&found, false), 9.0 * total(&found, true), 1e-4, name);
    }
}

/// Two halves of a square, the left of one triangle pair, the right with more vertices along the seam.
fn t_junctions(right: u32, gap: f64) -> Mesh {
    let mut positions = vec![vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0)];
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    let (lower, upper) = if gap > 0.0 { (4, 4 + right) } else { (1, 2) };
    if gap > 0.0 {
        positions.push(vec3(1.0 + gap, 0.0, 0.0));
    }
    let mut seam = vec![lower];
    for step in 1..right {
        seam.push(positions.len() as u32);
        positions.push(vec3(1.0 + gap, f64::from(step) / f64::from(right), 0.0));
    }
    if gap > 0.0 {
        positions.push(vec3(1.0 + gap, 1.0, 0.0));
    }
    seam.push(upper);
    let far = positions.len() as u32;
    positions.extend([vec3(2.0, 0.0, 0.0), vec3(2.0, 1.0, 0.0)]);
    triangles.extend(seam.windows(2).map(|pair| [far, pair[1], pair[0]]));
    triangles.push([far, far + 1, upper]);
    mesh(positions, triangles)
}

#[test]
fn no_line_is_drawn_across_a_surface_at_t_junctions() {
    for right in [2, 3, 7, 40] {
        let scene = scene_of(vec![t_junctions(right, 0.0)], view("20,10", false));
        let found = lines(&scene);
        let outline: f64 = [(0.0, 0.0, 2.0, 0.0), (2.0, 0.0, 2.0, 1.0), (2.0, 1.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)]
            .map(|(a, b, c, d)| px_between(&scene, vec3(a, b, 0.0), vec3(c, d, 0.0)))
            .iter()
            .sum();
        assert_near(total(&found, true), outline, NEAR, &format!("{right} parts"));
        assert_eq!(total(&found, false), 0.0);
    }
}

#[test]
fn a_face_split_at_a_t_junction_gets_no_seam_within() {
    let mut sheet = t_junctions(3, 0.0);
    sheet.texture_coordinates = sheet.positions.iter().map(|p| DVec2::new(p.x, p.y).as_vec2()).collect();
    sheet.triangle_texture_coordinates = sheet.triangles.clone();
    let scene = scene_of(vec![sheet], view("20,10", false));
    let settings = LineSettings { classes: ClassSet::ALL, ..LineSettings::default() };
    let found = lines_with(&scene, &settings);
    // Across the split face's old side the texture does differ: its middle vertex has no coordinate there.
    let within = found.segments.iter().filter(|s| {
        s.class == Class::Texture
            && !s.ends_px.iter().all(|end| {
                let seam = crate::support::lines::px(&scene, vec3(1.0, 0.0, 0.0));
                let top = crate::support::lines::px(&scene, vec3(1.0, 1.0, 0.0));
                ((top - seam).perp_dot(*end - seam) / top.distance(seam)).abs() < NEAR
            })
    });
    assert_eq!(within.count(), 0, "{:?}", found.segments);
}

#[test]
fn a_crack_wider_than_welding_is_an_opening_with_two_rims() {
    let scene = scene_of(vec![t_junctions(3, 1e-3)], view("20,10", false));
    let found = lines(&scene);
    let outline: f64 = [(0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)]
        .into_iter()
        .chain([(1.001, 0.0, 2.0, 0.0), (2.0, 0.0, 2.0, 1.0), (2.0, 1.0, 1.001, 1.0), (1.001, 1.0, 1.001, 0.0)])
        .map(|(a, b, c, d)| px_between(&scene, vec3(a, b, 0.0), vec3(c, d, 0.0)))
        .sum();
    assert_near(total(&found, true), outline, NEAR, "both rims");
}

#[test]
fn of_faces_with_the_same_corners_only_the_first_counts() {
    let plain = unit_box();
    let mut doubled = plain.clone();
    doubled.triangles.extend(back_to_front(plain.clone()).triangles);
    let mut tripled = doubled.clone();
    tripled.triangles.extend(plain.triangles.iter().map(|[a, b, c]| [*b, *c, *a]));
    let find = |mesh: &Mesh| lines(&scene_of(vec![mesh.clone()], view("30,15", false))).segments;
    assert_eq!(find(&plain), find(&doubled));
    assert_eq!(find(&plain), find(&tripled));
    let sheet = mesh(Mesh::triangle().positions, vec![[0, 1, 2], [0, 2, 1]]);
    let found = find(&sheet);
    assert!(found.len() == 3 && found.iter().all(|s| s.class == Class::Boundary && s.is_visible));
}

fn before_a_wall(near: f64, far: f64) -> (Scene, VisibleLines) {
    // The test examines a wall with a line of two materials across its middle; before it is a board from 2 to 4, slanting.
    let wall = mesh(
        vec![vec3(-3.0, -1.0, 0.0), vec3(3.0, -1.0, 0.0), vec3(3.0, 1.0, 0.0), vec3(-3.0, 1.0, 0.0)],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let board = mesh(
        vec![vec3(-2.0, -2.0, 2.0), vec3(2.0, -2.0, 4.0), vec3(2.0, 2.0, 4.0), vec3(-2.0, 2.0, 2.0)],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let camera = CameraSettings {
        eye: Some(vec3(0.0, 0.0, 10.0)),
        target: Some(DVec3::ZERO),
        parallel: true,
        near: Some(near),
        far: Some(far),
        ..CameraSettings::default()
    };
    let scene =
        Scene::new(vec![Arc::new(wall), Arc::new(board)], &SceneSettings { camera, ..SceneSettings::default() })
            .unwrap();
    let found = lines(&scene);
    (scene, found)
}

#[test]
fn what_is_nearer_than_the_near_plane_hides_nothing_and_what_it_cuts_hides_behind_it() {
    let unit_and_seen = |near: f64, far: f64| {
        let (scene, found) = before_a_wall(near, far);
        let unit = px_between(&scene, DVec3::ZERO, DVec3::X);
        let of = |object: u32, is_visible: bool| -> f64 {
            found.segments.iter().filter(|s| s.object == object && s.is_visible == is_visible).map(length).sum::<f64>()
                / unit
        };
        [of(0, true), of(0, false), of(1, true)]
    };
    for (near, far, expected) in [
        // The whole board is in view: two pieces of 4 of the wall's 16 units are hidden.
        (1.0, 20.0, [8.0, 8.0, 16.0]),
        // The board is out of view.
        (8.5, 20.0, [16.0, 0.0, 0.0]),
        // Up to z = 3, which is its left half.
        (7.0, 20.0, [12.0, 4.0, 8.0]),
        // The wall lies behind the far plane.
        (1.0, 9.0, [0.0, 0.0, 16.0]),
    ] {
        let found = unit_and_seen(near, far);
        for (found, expected) in found.iter().zip(expected) {
            assert_near(*found, expected, 1e-9, &format!("near {near} far {far}"));
        }
    }
}

#[test]
fn a_prism_seen_along_two_of_its_sides_keeps_both_ends_of_its_outline() {
    for (sides, name) in [(6, "front"), (6, "back"), (4, "top"), (8, "front"), (12, "top"), (60, "front"), (60, "top")]
    {
        for start in [0.0, std::f64::consts::TAU / 12.0] {
            let scene = scene_of(vec![prism(sides, 1.0, -1.0, 1.0, start)], view(name, true));
            let found = lines(&scene);
            let height = px_between(&scene, DVec3::ZERO, DVec3::X * 2.0);
            let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
            for end in found.segments.iter().filter(|segment| segment.is_visible).flat_map(|segment| segment.ends_px) {
                (low, high) = (low.min(end.y), high.max(end.y));
            }
            // Along x, with horizontal lines in this view: the uppermost and the lowest are whole.
            for limit in [low, high] {
                let on_it = |segment: &&LineSegment| {
                    segment.is_visible && segment.ends_px.iter().all(|end| (end.y - limit).abs() < NEAR)
                };
                let sum: f64 = found.segments.iter().filter(on_it).map(length).sum();
                assert_near(sum, height, NEAR, &format!("{sides} sides from the {name}, start {start}"));
            }
        }
    }
}

#[test]
fn lines_that_lie_on_one_another_in_the_picture_and_cross_in_depth_are_cut_there() {
    let first = extruded(&[(0.0, 1.0), (1.0, 0.0), (9.0, 8.0), (8.0, 9.0)], 0.0, 1.0);
    let second = extruded(&[(1.0, 9.0), (0.0, 8.0), (8.0, 0.0), (9.0, 1.0)], 0.0, 1.0);
    for meshes in [vec![first.clone(), second.clone()], vec![second, first]] {
        let scene = scene_of(meshes, view("front", true));
        let found = lines(&scene);
        let unit = px_between(&scene, DVec3::ZERO, DVec3::Y);
        let upright =
            |segment: &&LineSegment| segment.is_visible && (segment.ends_px[0].x - segment.ends_px[1].x).abs() < NEAR;
        let sum: f64 = found.segments.iter().filter(upright).map(length).sum();
        assert_near(sum, 18.0 * unit, NEAR, "both outlines, once");
    }
}

#[test]
fn boxes_flush_at_a_corner_are_drawn_alike_in_whatever_order() {
    let (low, high) = (cuboid(DVec3::ZERO, vec3(4.0, 2.0, 2.0)), cuboid(DVec3::ZERO, vec3(3.0, 2.0, 4.0)));
    let seen = |meshes: Vec<Mesh>| {
        let scene = scene_of(meshes, view("140,20", false));
        total(&lines(&scene), true)
    };
    let expected = seen(vec![low.clone(), high.clone()]);
    let orders =
        [vec![high.clone(), low.clone()], vec![joined(&[low.clone(), high.clone()])], vec![joined(&[high, low])]];
    for (order, meshes) in orders.into_iter().enumerate() {
        assert_near(seen(meshes), expected, NEAR, &format!("order {order}"));
    }
}

fn check_rails(counts: &[u32]) {
    for &count in counts {
        // A triangle below the edge, a strip of as many squares above it, which leans towards the eye.
        let mut positions = vec![DVec3::ZERO, DVec3::X, vec3(0.5, -1.0, 0.0)];
        let mut triangles = vec![[0, 2, 1]];
        for step in 0..=count {
            let x = f64::from(step) / f64::from(count);
            positions.extend([vec3(x, 0.0, 0.0), vec3(x, 0.1, 0.05)]);
        }
        // Its ends are the edge's own.
        let number = |vertex: u32| match vertex {
            3 => 0,
            last if last == 3 + 2 * count => 1,
            other => other,
        };
        for step in 0..count {
            let first = 3 + 2 * step;
            triangles.extend([[first, first + 2, first + 1], [first + 1, first + 2, first + 3]].map(|t| t.map(number)));
        }
        let scene = scene_of(vec![mesh(positions, triangles)], view("front", false));
        let found = lines(&scene);
        let outline = [
            (vec3(0.0, 0.0, 0.0), vec3(0.5, -1.0, 0.0)),
            (vec3(0.5, -1.0, 0.0), vec3(1.0, 0.0, 0.0)),
            (vec3(1.0, 0.0, 0.0), vec3(1.0, 0.1, 0.05)),
            (vec3(1.0, 0.1, 0.05), vec3(0.0, 0.1, 0.05)),
            (vec3(0.0, 0.1, 0.05), vec3(0.0, 0.0, 0.0)),
        ];
        let expected: f64 = outline.iter().map(|(a, b)| px_between(&scene, *a, *b)).sum();
        assert_near(total(&found, true) + total(&found, false), expected, 1e-4, &format!("{count} squares"));
    }
}

#[test]
fn a_rail_of_up_to_four_thousand_vertices_on_one_open_edge_has_no_line_across() {
    check_rails(&[10, 1000, 4000]);
}

#[test]
#[ignore = "exhaustive: 100,000 squares on one edge take the better part of a minute"]
fn a_rail_of_any_number_of_vertices_on_one_open_edge_has_no_line_across() {
    check_rails(&[10_000, 100_000]);
}

#[test]
fn a_sheet_on_another_in_whose_corner_it_lies_shows_no_diagonal() {
    // A square and a small one on it that shares a corner: the large one's sides are split where the small one ends, along its diagonal.
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        corner(0.0, 0.0),
        corner(1.0, 0.0),
        corner(1.0, 1.0),
        corner(0.0, 1.0),
        corner(0.8, 0.0),
        corner(1.0, 0.2),
        corner(0.8, 0.2),
    ];
    let scene = scene_of(vec![mesh(positions, vec![[0, 1, 2], [0, 2, 3], [4, 1, 5], [4, 5, 6]])], view("front", true));
    let found = lines(&scene);
    let is_aslant = |segment: &&LineSegment| (segment.ends_px[0] - segment.ends_px[1]).abs().min_element() > 1e-6;
    assert_eq!(found.segments.iter().filter(is_aslant).count(), 0);
    let drawn: f64 = found.segments.iter().filter(|segment| segment.is_visible).map(length).sum();
    let side = 512.0 * 0.92;
    assert!((drawn - 4.4 * side).abs() < 0.05, "{drawn} px, the sides are {side}");
}
