//! Scenes whose drawing once depended on how they were written, with their correct lengths.

use crate::support::lines::{lines, of_class, scene_of, total, view};
use crate::support::shapes::{joined, mesh};
use glam::DVec3;
use std::f64::consts::TAU;
use tinta::edges::Class;
use tinta::mesh::read_bytes;
use tinta::{LoadOptions, Mesh};

fn read(text: &str) -> Mesh {
    read_bytes(text.as_bytes(), "model.obj", &[], &LoadOptions::default()).unwrap().mesh
}

#[track_caller]
fn assert_px(actual: f64, expected: f64, what: &str) {
    assert!((actual - expected).abs() <= 0.05, "{what}: {actual:.3} px instead of {expected}");
}

/// A cylinder of polygons, each followed by its reverse; both begin where `first` says.
fn cylinder_from_both_sides(first: impl Fn(usize, usize) -> usize) -> Mesh {
    const SIDES: usize = 24;
    let mut text = String::new();
    for y in [0, 2] {
        for side in 0..SIDES {
            let angle = TAU * side as f64 / SIDES as f64;
            text += &format!("v {:?} {y} {:?}\n", angle.cos(), angle.sin());
        }
    }
    let mut polygons: Vec<Vec<usize>> =
        (0..SIDES).map(|i| vec![i, SIDES + i, SIDES + (i + 1) % SIDES, (i + 1) % SIDES]).collect();
    polygons.extend([(0..SIDES).collect::<Vec<_>>(), (SIDES..2 * SIDES).rev().collect()]);
    for (number, polygon) in polygons.into_iter().enumerate() {
        let reversed: Vec<usize> = polygon.iter().rev().copied().collect();
        for (side, mut corners) in [polygon, reversed].into_iter().enumerate() {
            let count = corners.len();
            corners.rotate_left(first(number, side) % count);
            text += &format!("f {}\n", corners.iter().map(|corner| format!("{} ", corner + 1)).collect::<String>());
        }
    }
    read(&text)
}

#[test]
fn polygons_seen_from_both_sides_count_once_whatever_their_first_corners() {
    for (what, model) in [
        ("as listed", cylinder_from_both_sides(|_, _| 0)),
        ("from other corners", cylinder_from_both_sides(|number, side| number * 7 + side * 5)),
    ] {
        let found = lines(&scene_of(vec![model], view("30,15", false)));
        assert_px(of_class(&found, Class::Silhouette, true), 1409.2, what);
        assert_px(of_class(&found, Class::Crease, true), 359.8, what);
        assert_px(total(&found, true), 1769.0, what);
        // 24 sides with two triangles each, two caps with 22.
        assert_eq!(found.covered_triangles, 92, "{what}");
    }
}

#[test]
fn surfaces_that_pass_through_one_another_along_edges_of_both_intersect_there() {
    let upright = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let strip = |corners: [DVec3; 6]| mesh(corners.to_vec(), vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]]);
    let first =
        strip([-1.0, 0.0, 1.0].map(|x| [upright(x, 0.0, 0.0), upright(x, 0.0, 1.0)]).concat().try_into().unwrap());
    let second =
        strip([-1.0, 0.0, 1.0].map(|y| [upright(0.0, y, 0.2), upright(0.0, y, 0.8)]).concat().try_into().unwrap());
    for (parallel, expected) in [(false, 72.8), (true, 73.6)] {
        for (what, meshes) in [
            ("two objects", vec![first.clone(), second.clone()]),
            ("one object", vec![joined(&[first.clone(), second.clone()])]),
        ] {
            let found = lines(&scene_of(meshes, view("30,20", parallel)));
            assert_px(of_class(&found, Class::Intersection, true), expected, what);
        }
    }
}

#[test]
fn surfaces_that_touch_along_edges_of_both_without_passing_through_do_not_intersect() {
    // Two ridges, back to back: their half-planes do not alternate around the common line.
    let ridge = |towards: f64| {
        let corners = [(-1.0, towards), (0.0, 0.0), (1.0, towards)];
        let positions = corners.iter().flat_map(|(x, y)| [DVec3::new(*x, *y, 0.0), DVec3::new(*x, *y, 1.0)]).collect();
        mesh(positions, vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]])
    };
    let found = lines(&scene_of(vec![ridge(0.2), ridge(-0.2)], view("30,20", false)));
    assert_eq!(found.edges.intersection, 0);
}

#[test]
fn a_line_in_the_plane_of_a_wall_is_cut_where_it_passes_the_corner_of_wall_and_floor() {
    let positions = [
        (1.0, -1.0, -2.0),
        (1.0, 2.0, -1.0),
        (1.0, -1.0, -1.0),
        (1.0, 0.0, -2.0),
        (2.0, 0.0, -1.0),
        (1.0, 0.0, -1.0),
        (1.0, 2.0, -2.0),
    ];
    let positions: Vec<DVec3> = positions.iter().map(|(x, y, z)| DVec3::new(*x, *y, *z)).collect();
    for (at, expected) in [("20,40", 1542.6), ("30,15", 1825.3), ("60,10", 1869.5)] {
        for turned in 0..8 {
            let faces = [[0, 1, 2], [3, 4, 5], [6, 3, 5]];
            let wound = |(number, &[a, b, c]): (usize, &[u32; 3])| {
                if turned >> number & 1 == 1 { [a, c, b] } else { [a, b, c] }
            };
            let model = mesh(positions.clone(), faces.iter().enumerate().map(wound).collect());
            let found = lines(&scene_of(vec![model], view(at, false)));
            assert_px(total(&found, true), expected, &format!("{at}, faces turned {turned:03b}"));
        }
    }
}

/// An L with its wall at x = 2 and its floor at z = 3.
fn bracket() -> Mesh {
    let profile = [(0, 3), (2, 3), (2, 0), (3, 0), (3, 4), (0, 4)];
    let mut text = String::new();
    for y in [0, 3] {
        profile.iter().for_each(|(x, z)| text += &format!("v {x} {y} {z}\n"));
    }
    for i in 0..6 {
        text += &format!("f {} {} {} {}\n", i + 1, (i + 1) % 6 + 1, 6 + (i + 1) % 6 + 1, 6 + i + 1);
    }
    read(&(text + "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n"))
}

#[test]
fn what_lies_on_the_wall_of_a_bracket_is_seen_alike_however_it_is_wound() {
    let sheet = mesh(
        [(1.0, 1.0), (2.0, 1.0), (2.0, 5.0), (1.0, 5.0)].map(|(y, z)| DVec3::new(2.0, y, z)).to_vec(),
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let triangle =
        mesh([(0.5, 2.2), (2.5, 4.1), (0.4, 4.4)].map(|(y, z)| DVec3::new(2.0, y, z)).to_vec(), vec![[0, 1, 2]]);
    let cuboid = crate::support::shapes::cuboid(DVec3::new(1.8, 1.0, 1.0), DVec3::new(2.0, 2.0, 5.0));
    for (what, model, expected) in [
        ("a box", cuboid, [2815.5, 2704.3, 2992.5]),
        ("a sheet", sheet, [2604.9, 2448.8, 2719.3]),
        ("a triangle", triangle, [2580.1, 2380.3, 2699.4]),
    ] {
        for (at, expected) in ["-145,30", "-120,60", "250,45"].iter().zip(expected) {
            for is_turned in [false, true] {
                let mut model = model.clone();
                if is_turned {
                    model.triangles.iter_mut().for_each(|corners| corners.reverse());
                }
                let found = lines(&scene_of(vec![joined(&[bracket(), model])], view(at, false)));
                assert_px(total(&found, true), expected, &format!("{what} at {at}, turned {is_turned}"));
            }
        }
    }
}

#[test]
fn a_face_without_height_along_an_inner_edge_draws_no_line() {
    let [a, b] = [DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.9, 1.1, 0.3)];
    let positions = vec![a, b, DVec3::new(0.1, 1.1, 0.3), DVec3::new(0.9, 0.2, 0.3), a.lerp(b, 0.37)];
    let plain = mesh(positions[..4].to_vec(), vec![[0, 1, 2], [0, 3, 1]]);
    let expected = total(&lines(&scene_of(vec![plain], view("30,15", false))), true);
    for faces in [
        // Beside the edge, and between it and the halves of the other face.
        vec![[0, 1, 2], [0, 3, 1], [0, 1, 4]],
        vec![[0, 1, 2], [0, 4, 1], [0, 3, 4], [4, 3, 1]],
    ] {
        let found = lines(&scene_of(vec![mesh(positions.clone(), faces)], view("30,15", false)));
        assert_px(total(&found, true), expected, "with a face without height");
    }
}

/// A hexagon in a plane.
const HEXAGON: &str = "v 2 0 0\nv 1 2 0\nv -1 2 0\nv -2 0 0\nv -1 -2 0\nv 1 -2 0\n";

#[test]
fn polygons_in_one_plane_count_once_whatever_their_diagonals() {
    let hexagon = "f 2 3 4 5 6 1\n";
    let layers = "f 1 2 3 4 5 6\nf 2 3 4 5 6 1\nf 4 5 6 1 2 3\n";
    let beside = "v 0 5 0\nv 3 3 0\nf 1 3 7 8\n";
    let square = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 3 .5 0\nv .5 3 0\n";
    for (what, text, expected) in [
        ("once", format!("{HEXAGON}{hexagon}"), 1349.5),
        ("three times", format!("{HEXAGON}{layers}"), 1349.5),
        ("four times", format!("{HEXAGON}{layers}f 6 5 4 3 2 1\n"), 1349.5),
        ("once, and a quad on a chord", format!("{HEXAGON}{hexagon}{beside}"), 1616.7),
        ("with a diagonal on the chord", format!("{HEXAGON}f 1 2 3 4 5 6\n{beside}"), 1616.7),
        ("twice, and a quad on a chord", format!("{HEXAGON}f 1 2 3 4 5 6\nf 4 3 2 1 6 5\n{beside}"), 1616.7),
        ("three times, and a quad on a chord", format!("{HEXAGON}{layers}{beside}"), 1616.7),
        ("two quads, one diagonal", format!("{square}f 1 2 3 4\nf 1 5 3 6\n"), 2305.8),
        ("two quads, two diagonals", format!("{square}f 2 3 4 1\nf 1 5 3 6\n"), 2305.8),
        ("two quads, each twice", format!("{square}f 1 2 3 4\nf 3 6 1 5\nf 4 3 2 1\nf 5 3 6 1\n"), 2305.8),
    ] {
        let found = lines(&scene_of(vec![read(&text)], view("20,30", false)));
        assert_px(of_class(&found, Class::Boundary, true), expected, what);
        assert_px(total(&found, true), expected, what);
    }
}

/// The faces of two polygons, from each corner and in each direction.
fn written(first: &[u32], second: &[u32]) -> Vec<String> {
    let face =
        |corners: &[u32]| format!("f{}\n", corners.iter().map(|corner| format!(" {corner}")).collect::<String>());
    let all = |corners: &[u32]| -> Vec<String> {
        let from = |start: usize| {
            let mut corners = corners.to_vec();
            corners.rotate_left(start);
            let reversed: Vec<u32> = corners.iter().rev().copied().collect();
            [face(&corners), face(&reversed)]
        };
        (0..corners.len()).flat_map(from).collect()
    };
    let (firsts, seconds) = (all(first), all(second));
    let both = |first: &String| seconds.iter().map(|second| format!("{first}{second}")).collect::<Vec<_>>();
    firsts.iter().flat_map(both).collect()
}

#[test]
fn a_face_that_crosses_another_along_a_mesh_line_from_their_common_corner_intersects_it() {
    let wall = "v 1 1 0\nv 1 2 0\nv 1 1 1\nv 1 2 1\nv 2 2 1\nv 0 2 1\n";
    let sheet = "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 0 0 -1\nv 0 0 1\n";
    let of_sheet = |faces: String| format!("{sheet}{faces}f 2 1 4\n");
    let walls: Vec<String> = written(&[1, 2, 4, 3], &[5, 1, 6]).iter().map(|faces| format!("{wall}{faces}")).collect();
    let sheets: Vec<String> = written(&[1, 2, 3], &[2, 5, 6]).into_iter().map(of_sheet).collect();
    for (texts, at, parallel, expected) in [
        (&walls, "30,20", false, [1279.8, 170.6]),
        (&walls, "30,20", true, [1238.4, 172.0]),
        (&sheets, "30,15", false, [1299.7, 285.8]),
        (&sheets, "30,15", true, [1324.4, 301.9]),
    ] {
        for text in texts {
            let found = lines(&scene_of(vec![read(text)], view(at, parallel)));
            assert_px(of_class(&found, Class::Boundary, true), expected[0], text);
            assert_px(of_class(&found, Class::Intersection, true), expected[1], text);
        }
    }
}
