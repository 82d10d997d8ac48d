//! Scenes of public bug reports of other programs that draw lines, rebuilt from their words: each with its length by hand.
//!
//! Lengths are in the model's units, in a parallel projection. Models are z up, as the reports' are, unless a case says so.

use crate::support::lines::{length, lines, lines_with, scene_of, total, view};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use tinta::camera::Projection;
use tinta::edges::Class;
use tinta::lines::{LineSettings, VisibleLines};
use tinta::mesh::UpAxis;
use tinta::{CameraSettings, LoadOptions, Mesh};

/// Vertices, and polygons by their numbers.
type Solid = (Vec<DVec3>, Vec<Vec<u32>>);

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Solid {
    let ends = [low, high];
    let corner = |i: usize| DVec3::new(ends[i & 1][0], ends[i >> 1 & 1][1], ends[i >> 2][2]);
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    ((0..8).map(corner).collect(), faces.map(|face| face.to_vec()).to_vec())
}

/// A polygon in the plane z = 0.
fn flat(corners: &[[f64; 2]]) -> Solid {
    let points = corners.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect();
    (points, vec![(0..corners.len() as u32).collect()])
}

/// The corners of a regular polygon about the z axis.
fn ring(sides: u32, radius: f64, z: f64) -> Vec<DVec3> {
    let at = |k: u32| (TAU * f64::from(k) / f64::from(sides)).sin_cos();
    (0..sides).map(at).map(|(sine, cosine)| DVec3::new(radius * cosine, radius * sine, z)).collect()
}

/// The side of a prism between two rings, and its ends.
fn prism(sides: u32, radius: f64, [low, high]: [f64; 2], has_ends: bool) -> Solid {
    let points = [ring(sides, radius, low), ring(sides, radius, high)].concat();
    let mut faces: Vec<Vec<u32>> =
        (0..sides).map(|k| vec![k, (k + 1) % sides, sides + (k + 1) % sides, sides + k]).collect();
    if has_ends {
        faces.extend([(0..sides).rev().collect(), (sides..2 * sides).collect()]);
    }
    (points, faces)
}

fn reversed((points, mut faces): Solid, which: fn(usize) -> bool) -> Solid {
    faces.iter_mut().enumerate().filter(|(number, _)| which(*number)).for_each(|(_, face)| face.reverse());
    (points, faces)
}

fn mesh_with(solids: &[Solid], options: &LoadOptions) -> Mesh {
    let (mut points, mut corners, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
    for (own, faces) in solids {
        for face in faces {
            corners.extend(face.iter().map(|corner| points.len() as u32 + corner));
            sizes.push(face.len() as u32);
        }
        points.extend(own);
    }
    Mesh::of_polygons("a report's", points, &corners, sizes, options).unwrap()
}

fn mesh(solids: &[Solid]) -> Mesh {
    mesh_with(solids, &LoadOptions { up_axis: UpAxis::Z, ..LoadOptions::default() })
}

/// The lines of a mesh, and how many units a pixel is.
fn drawn(mesh: Mesh, from: &str, settings: &LineSettings) -> (VisibleLines, f64) {
    let scene = scene_of(vec![mesh], view(from, true));
    let Projection::Parallel { height } = scene.camera.projection else { unreachable!("it is parallel") };
    (lines_with(&scene, settings), height / 512.0)
}

/// The visible length of some solids, units.
fn seen(solids: &[Solid], from: &str) -> f64 {
    let (found, unit) = drawn(mesh(solids), from, &LineSettings::default());
    total(&found, true) * unit
}

fn assert_length(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-6 * expected.max(1.0), "{what}: {found}, not {expected}");
}

/// A view along the diagonal of a corner, from the left.
const CORNER: &str = "-45,35.26438968275465";

#[test]
fn the_scenes_of_reports_have_the_length_they_should_have() {
    let square = |x: f64, y: f64, side: f64| [[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    let tall = || cuboid([0.0; 3], [1.0, 1.0, 30.0]);
    let [left, right] = [-25_333.0, 25_333.0];
    let [low, high] = [-10_808.0, 33_190.0];
    // Around two holes by way of two bridges.
    let mut plate = vec![[left, low]];
    let [mut a, mut b] = [square(-9000.0, 1191.0, 5000.0), square(4663.0, 1191.0, 5000.0)];
    a[1..].reverse();
    b.reverse();
    b.rotate_left(2);
    plate.extend(a.iter().chain([&a[0], &[left, low], &[right, low]]));
    plate.extend(b.iter().chain([&b[0], &[right, low], &[right, high], &[left, high]]));
    let comb = [
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 8.0],
        [0.0, 8.0],
        [0.0, 0.0],
        [3.0, 3.0],
        [3.0, 6.0],
        [5.0, 6.0],
        [5.0, 3.0],
        [3.0, 3.0],
    ];
    let cross = [
        [480, 320],
        [440, 320],
        [440, 360],
        [460, 360],
        [460, 440],
        [440, 440],
        [440, 480],
        [480, 480],
        [480, 460],
        [560, 460],
        [560, 480],
        [600, 480],
        [600, 440],
        [580, 440],
        [580, 360],
        [600, 360],
        [600, 320],
        [560, 320],
        [560, 340],
        [480, 340],
    ];
    let pinwheel = [
        [500, 320],
        [460, 320],
        [460, 420],
        [360, 420],
        [360, 460],
        [460, 460],
        [460, 560],
        [500, 560],
        [500, 460],
        [600, 460],
        [600, 420],
        [500, 420],
    ];
    let whole = |corners: &[[i32; 2]]| flat(&corners.iter().map(|corner| corner.map(f64::from)).collect::<Vec<_>>());
    let repeated = flat(&[[2.0, 4.0], [2.0, 2.0], [4.0, 2.0], [4.0, 0.0], [0.0, 0.0], [0.0, 4.0], [2.0, 4.0]]);
    let circle = |sides: f64, radius: f64| 2.0 * sides * radius * (PI / sides).sin();
    let isometric = (2.0f64 / 3.0).sqrt();
    let touching = (
        prism(49, 0.1, [-0.5, 0.5], false).0.iter().map(|p| *p + DVec3::X * 0.1).collect(),
        prism(49, 0.1, [0.0; 2], false).1,
    );
    let sheet = (
        [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[y, z]| DVec3::new(0.0, y, z)).to_vec(),
        vec![vec![0, 1, 2, 3]],
    );
    let cases: Vec<(&str, Vec<Solid>, &str, f64)> = vec![
        (
            "CadQuery 593: a bar through a block",
            vec![cuboid([-0.05, -1.0, -0.05], [0.05, 1.0, 0.05]), cuboid([-1.0, -0.5, -0.5], [1.0, 0.5, 0.5])],
            "top",
            6.0 + 2.2,
        ),
        ("kernelCAD 445: a box, front", vec![cuboid([0.0; 3], [3.0, 2.0, 1.0])], "front", 8.0),
        ("kernelCAD 445: a box, right", vec![cuboid([0.0; 3], [3.0, 2.0, 1.0])], "right", 6.0),
        ("kernelCAD 445: a box, top", vec![cuboid([0.0; 3], [3.0, 2.0, 1.0])], "top", 10.0),
        (
            "IfcOpenShell 4595: a shelf over another",
            vec![cuboid([0.0; 3], [2.0, 1.0, 0.1]), cuboid([0.5, 0.25, 1.0], [2.5, 1.25, 1.1])],
            "top",
            9.75,
        ),
        (
            "IfcOpenShell 6424: a beam under a slab",
            vec![cuboid([0.0, 0.0, 1.0], [4.0, 4.0, 1.2]), cuboid([0.5, 1.9, 0.5], [3.5, 2.1, 0.7])],
            "top",
            16.0,
        ),
        (
            "IfcOpenShell 3742: slabs side by side",
            vec![cuboid([0.0; 3], [1.0, 1.0, 0.2]), cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 0.2])],
            "top",
            7.0,
        ),
        (
            "heerich 10: boxes flush at a corner",
            vec![cuboid([0.0; 3], [5.0, 5.0, 1.0]), cuboid([0.0, 0.0, 1.0], [2.0, 2.0, 2.0])],
            CORNER,
            44.0 * isometric,
        ),
        ("ifc-lite 2682: a tall box wound outwards", vec![tall()], "top", 4.0),
        ("ifc-lite 2682: a tall box wound inwards", vec![reversed(tall(), |_| true)], "top", 4.0),
        ("ifc-lite 2682: half of its faces turned", vec![reversed(tall(), |face| face % 2 == 0)], "top", 4.0),
        (
            "trimesh 1934: squares that share a corner",
            vec![flat(&square(1.0, 1.0, 2.0)), flat(&square(3.0, 3.0, 2.0))],
            "top",
            16.0,
        ),
        ("three.js 26557: a plate with two holes", vec![flat(&plate)], "top", 229_328.0),
        (
            "three.js 10517: a long edge beside two short ones",
            vec![
                flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]),
                flat(&square(1.0, 0.0, 1.0)),
                flat(&square(1.0, 1.0, 1.0)),
            ],
            "top",
            8.0,
        ),
        (
            "ImportLDraw 59: a stud on a brick",
            vec![cuboid([-2.0, -2.0, 0.0], [2.0, 2.0, 1.0]), prism(16, 0.6, [1.0, 1.2], true)],
            "top",
            16.0 + circle(16.0, 0.6),
        ),
        ("matplotlib 16071: a cylinder touches a sheet, from behind", vec![sheet.clone(), touching], "left", 4.0),
        ("trimesh 2519: a polygon around a hole", vec![flat(&comb)], "top", 36.0 + 10.0),
        ("libtess.js 16: a cross", vec![whole(&cross)], "top", 800.0),
        ("libtess.js 16: a pinwheel", vec![whole(&pinwheel)], "top", 960.0),
        ("LibTessDotNet 6: a corner twice", vec![repeated], "top", 16.0),
    ];
    for (what, solids, from, expected) in cases {
        assert_length(seen(&solids, from), expected, what);
    }
}

#[test]
fn a_turned_cube_shows_nine_edges_and_hides_three() {
    // three-mesh-bvh 464, y up.
    let (points, faces) = cuboid([-0.5; 3], [0.5; 3]);
    let turn = DMat3::from_rotation_x(1.225_402_031_264_409_2)
        * DMat3::from_rotation_y(-0.909_226_641_363_524_7)
        * DMat3::from_rotation_z(2.282_300_016_092_882_4);
    let turned = (points.into_iter().map(|point| turn * point).collect(), faces);
    let (found, unit) = drawn(mesh_with(&[turned], &LoadOptions::default()), "top", &LineSettings::default());
    assert_length(total(&found, true) * unit, 7.281_710_000_646_445, "seen");
    assert_length(total(&found, false) * unit, 2.427_236_666_882_148, "hidden");
}

#[test]
fn a_prism_seen_nearly_end_on_has_two_lines_along_it() {
    // itwinjs-core 1129, 1226.
    for degrees in [1.0f64, 0.1, 0.01] {
        let angle = degrees.to_radians();
        let rim: f64 = (0..64)
            .map(|k| {
                let [(s, c), (t, d)] = [k, k + 1].map(|k| (TAU * f64::from(k) / 64.0).sin_cos());
                (d - c).hypot((t - s) * angle.cos())
            })
            .sum();
        // The near rim, half of the far one, two lines.
        let found = seen(&[prism(64, 1.0, [0.0, 10.0], true)], &format!("0,{}", 90.0 - degrees));
        assert_length(found, 1.5 * rim + 20.0 * angle.sin(), &format!("{degrees} degrees"));
    }
}

#[test]
fn where_two_boxes_meet_there_is_one_line_at_every_angle() {
    // Malt 272.
    let boxes = [cuboid([0.0; 3], [1.0; 3]), cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])];
    for azimuth in [-1.0, -0.1, 0.0, 1.0, 89.0, 89.9] {
        let (found, unit) = drawn(mesh(&boxes), &format!("{azimuth},0"), &LineSettings::default());
        let shared = found.segments.iter().filter(|it| it.is_visible && it.class == Class::NonManifold);
        assert_length(shared.map(length).sum::<f64>() * unit, 1.0, &format!("{azimuth} degrees"));
    }
}

#[test]
fn the_order_and_direction_of_three_faces_at_an_edge_change_nothing() {
    // three.js 20327.
    let points =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(DVec3::from_array);
    let faces = [[0, 1, 2], [0, 2, 3], [0, 4, 2]];
    let mut lengths = Vec::new();
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for turned in 0..8 {
            let face = |number: usize| {
                let mut face = faces[number].to_vec();
                if turned >> number & 1 == 1 {
                    face.reverse();
                }
                face
            };
            let solid = (points.to_vec(), order.map(face).to_vec());
            let (found, unit) = drawn(mesh(&[solid]), "iso", &LineSettings::default());
            let shared = found.segments.iter().filter(|segment| segment.class == Class::NonManifold).count();
            assert!(shared > 0, "{order:?} {turned}");
            lengths.push(total(&found, true) * unit);
        }
    }
    lengths.iter().for_each(|length| assert_length(*length, lengths[0], "all 48 alike"));
}

#[test]
fn a_disc_whose_last_corner_is_not_quite_the_first_has_no_spoke() {
    // three.js 22341.
    for (scale, offset) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e6)] {
        let rim = (0..=16)
            .map(|k| 2.0 * PI * f64::from(k) / 16.0)
            .map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.0) * 0.4);
        let points = std::iter::once(DVec3::ZERO).chain(rim).map(|point| point * scale + DVec3::X * offset).collect();
        let found = seen(&[(points, (1..=16).map(|k| vec![0, k, k + 1]).collect())], "top");
        // Far from the origin the file's numbers have ten digits less.
        let expected = 12.8 * (PI / 16.0).sin();
        assert!((found / scale - expected).abs() < 1e-6, "{scale} {offset}: {found}");
    }
}

#[test]
fn what_is_only_written_otherwise_is_drawn_alike() {
    let cube = seen(&[cuboid([0.0; 3], [10.0; 3])], "30,20");
    // SketchUp's api-issue-tracker 611: mixed windings, a long edge along two short ones.
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let sides = [
        [at(5.0, 0.0, 10.0), at(5.0, 10.0, 10.0), at(0.0, 10.0, 10.0), at(0.0, 0.0, 10.0)],
        [at(5.0, 0.0, 10.0), at(5.0, 10.0, 10.0), at(10.0, 10.0, 10.0), at(10.0, 0.0, 10.0)],
        [at(0.0, 0.0, 10.0), at(0.0, 10.0, 10.0), at(0.0, 10.0, 0.0), at(0.0, 0.0, 0.0)],
        [at(10.0, 0.0, 10.0), at(10.0, 10.0, 10.0), at(10.0, 10.0, 0.0), at(10.0, 0.0, 0.0)],
        [at(0.0, 10.0, 10.0), at(10.0, 10.0, 10.0), at(10.0, 10.0, 0.0), at(0.0, 10.0, 0.0)],
        [at(0.0, 0.0, 10.0), at(10.0, 0.0, 10.0), at(10.0, 0.0, 0.0), at(0.0, 0.0, 0.0)],
        [at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0), at(10.0, 10.0, 0.0), at(0.0, 10.0, 0.0)],
    ];
    let halves: Vec<Solid> = sides.iter().map(|side| (side.to_vec(), vec![vec![0, 1, 2, 3]])).collect();
    assert_length(seen(&halves, "30,20"), cube, "a top of two halves");
    // papercraft 9: sides of four squares, and one of one.
    let mut squares: Vec<Solid> = Vec::new();
    for side in &sides[2..] {
        let [a, b, c, d] = *side;
        let point = |u: f64, v: f64| a + (b - a) * u + (d - a) * v;
        assert_eq!(point(1.0, 1.0), c);
        for (u, v) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)] {
            squares.push((
                vec![point(u, v), point(u + 0.5, v), point(u + 0.5, v + 0.5), point(u, v + 0.5)],
                vec![vec![0, 1, 2, 3]],
            ));
        }
    }
    squares.push((
        vec![at(0.0, 0.0, 10.0), at(10.0, 0.0, 10.0), at(10.0, 10.0, 10.0), at(0.0, 10.0, 10.0)],
        vec![vec![0, 1, 2, 3]],
    ));
    assert_length(seen(&squares, "30,20"), cube, "sides of squares");
    // FreeCAD 9572: a view that is off the axis by 1e-7 degrees.
    let box_of_three = [cuboid([0.0; 3], [3.0, 2.0, 1.0])];
    assert!((seen(&box_of_three, "1e-7,1e-7") - 8.0).abs() < 1e-6);
    // three.js 22094: a tetrahedron of four separate triangles.
    let corners = [at(0.0, 0.0, 0.0), at(2.0, 0.0, 0.0), at(0.0, 2.0, 0.0), at(0.0, 0.0, 2.0)];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let shared = (corners.to_vec(), faces.map(|face| face.map(|corner| corner as u32).to_vec()).to_vec());
    let apart: Vec<Solid> =
        faces.iter().map(|face| (face.map(|corner| corners[corner]).to_vec(), vec![vec![0, 1, 2]])).collect();
    assert_length(seen(&apart, "iso"), seen(&[shared], "iso"), "a tetrahedron");
}

#[test]
fn strips_a_little_apart_are_a_whole_cylinder_once_welded() {
    // ldparteditor 651.
    let strips: Vec<Solid> = (0..24)
        .map(|strip| {
            let radius = if strip % 2 == 0 { 10.0 } else { 10.0004 };
            let corner = |k: u32, z: f64| ring(24, radius, z)[(k % 24) as usize];
            let corners = vec![corner(strip, 0.0), corner(strip + 1, 0.0), corner(strip + 1, 5.0), corner(strip, 5.0)];
            (corners, vec![vec![0, 1, 2, 3]])
        })
        .collect();
    let options = LoadOptions { weld: 1e-4, up_axis: UpAxis::Z, ..LoadOptions::default() };
    let (found, unit) = drawn(mesh_with(&strips, &options), "30,15", &LineSettings::default());
    let plain = seen(&[prism(24, 10.0, [0.0, 5.0], false)], "30,15");
    assert!((total(&found, true) * unit - plain).abs() < 0.01, "{} {plain}", total(&found, true) * unit);
}

#[test]
fn what_lies_behind_the_eye_is_not_drawn_mirrored() {
    // three.js 15476: a floor under the eye that reaches far behind it.
    let floor = mesh(&[cuboid([-0.5, -20.0, -1.2], [0.5, 5.0, -1.0])]);
    for height in [0.0, -1.0 + 1e-9] {
        let eye = DVec3::new(0.0, height, 0.0);
        let camera = CameraSettings {
            eye: Some(eye),
            target: Some(eye + DVec3::Z),
            fov_y_degrees: 60.0,
            ..CameraSettings::default()
        };
        let found = lines(&scene_of(vec![floor.clone()], camera));
        let seen: Vec<_> = found.segments.iter().filter(|segment| segment.is_visible).collect();
        assert!(!seen.is_empty());
        for segment in seen {
            assert!(segment.ends_px.iter().all(|end| end.y >= 256.0 - 1e-5), "{height}: {segment:?}");
        }
    }
}
