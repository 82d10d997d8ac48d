//! Meshes cut by planes: areas and volumes by formula, closed caps, planes through vertices, edges and faces.

mod windings;

use crate::support::shapes::Random;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use std::sync::Arc;
use tinta::edges::{EdgeList, Incidence};
use tinta::mesh::{Curves, Cut, Pattern, SECTION, SectionPlane, SectionPlanes};
use tinta::settings::Value;
use tinta::{CameraSettings, LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines, load};

fn plane(text: &str) -> SectionPlane {
    SectionPlane::parse(text).unwrap_or_else(|_| panic!("{text}"))
}

fn made(positions: Vec<DVec3>, corners: &[u32], sizes: Vec<u32>) -> Mesh {
    Mesh::of_polygons("made", positions, corners, sizes, &LoadOptions::default()).unwrap()
}

/// A prism over a polygon in x and z, from y = 0 to `height`, its sides facing outside; inside for a clockwise polygon.
fn prism(base: &[DVec2], height: f64) -> Mesh {
    let count = base.len() as u32;
    let at = |y: f64| base.iter().map(move |point| DVec3::new(point.x, y, -point.y));
    let mut corners: Vec<u32> = (0..count).rev().chain(count..2 * count).collect();
    let mut sizes = vec![count; 2];
    for side in 0..count {
        let next = (side + 1) % count;
        corners.extend([side, next, count + next, count + side]);
        sizes.push(4);
    }
    made(at(0.0).chain(at(height)).collect(), &corners, sizes)
}

fn regular(count: u32, radius: f64) -> Vec<DVec2> {
    (0..count).map(|at| DVec2::from_angle(f64::from(at) / f64::from(count) * TAU) * radius).collect()
}

fn square(half: f64) -> Vec<DVec2> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|it| DVec2::from_array(it) * half).to_vec()
}

/// A sphere of rings of quadrilaterals with triangles at its poles.
fn sphere(rings: u32, count: u32) -> Mesh {
    let mut positions = vec![DVec3::Y, -DVec3::Y];
    for ring in 1..rings {
        let (sine, cosine) = (f64::from(ring) / f64::from(rings) * TAU / 2.0).sin_cos();
        positions.extend(regular(count, sine).into_iter().map(|it| DVec3::new(it.x, cosine, -it.y)));
    }
    let at = |ring: u32, place: u32| 2 + (ring - 1) * count + place % count;
    let (mut corners, mut sizes) = (Vec::new(), Vec::new());
    for place in 0..count {
        corners.extend([0, at(1, place), at(1, place + 1), 1, at(rings - 1, place + 1), at(rings - 1, place)]);
        sizes.extend([3, 3]);
        for ring in 1..rings - 1 {
            corners.extend([at(ring, place), at(ring + 1, place), at(ring + 1, place + 1), at(ring, place + 1)]);
            sizes.push(4);
        }
    }
    made(positions, &corners, sizes)
}

/// Two meshes as one.
fn both(first: &Mesh, second: &Mesh) -> Mesh {
    let offset = first.positions.len() as u32;
    let corners = first.triangles.iter().copied().chain(second.triangles.iter().map(|it| it.map(|at| at + offset)));
    let positions = first.positions.iter().chain(&second.positions).copied().collect();
    made(positions, corners.collect::<Vec<_>>().as_flattened(), Vec::new())
}

fn volume(mesh: &Mesh) -> f64 {
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        a.dot(b.cross(c)) / 6.0
    };
    mesh.triangles.iter().map(of).sum()
}

/// The area of the faces of the part `section`.
fn cap_area(mesh: &Mesh) -> f64 {
    let Some(part) = mesh.parts.iter().position(|part| part.name == SECTION) else { return 0.0 };
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        (b - a).cross(c - a).length() / 2.0
    };
    let faces = mesh.triangles.iter().zip(&mesh.triangle_parts).filter(|(_, of)| **of == part as u32);
    faces.map(|(triangle, _)| of(triangle)).sum()
}

#[track_caller]
fn assert_closed(mesh: &Mesh, what: &str) {
    let edges = EdgeList::new(mesh);
    let open = edges.incidence().iter().filter(|it| **it != Incidence::Inner).count();
    assert_eq!(open, 0, "{what}: {open} edges of {} are open", edges.len());
}

#[track_caller]
fn assert_near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{what}: {found} for {expected}");
}

#[track_caller]
fn closed_cut(mesh: &Mesh, plane: &SectionPlane) -> Mesh {
    let (cut, how) = mesh.clone().section(&[*plane], Some(0.0)).unwrap();
    assert_eq!(how, Cut::Closed, "{}", plane.text());
    assert_closed(&cut, &plane.text());
    let lengths = [&cut.triangle_normals, &cut.triangles].map(Vec::len);
    assert_eq!(lengths, [cut.triangles.len(); 2]);
    assert_eq!((cut.triangle_parts.len(), cut.file_faces.len()), (lengths[0], lengths[0]));
    cut
}

#[test]
fn a_cut_boxs_volume_and_area_are_those_of_the_formula() {
    let cube = prism(&square(1.0), 2.0);
    for tenths in 1..20 {
        let at = f64::from(tenths) / 10.0;
        let cut = closed_cut(&cube, &plane(&format!("y={at}")));
        assert_near(volume(&cut), 4.0 * at, "volume");
        assert_near(cap_area(&cut), 4.0, "area");
        let other = closed_cut(&cube, &plane(&format!("-y={}", -at)));
        assert_near(volume(&other), 8.0 - 4.0 * at, "volume of the other side");
        // A corner cut off along its diagonal plane: x + y + z = t above the corner (-1, 0, -1).
        let corner = closed_cut(&cube, &plane(&format!("1,1,1={}", at - 2.0)));
        assert_near(volume(&corner), at.powi(3) / 6.0, "corner");
        assert_near(cap_area(&corner), 3f64.sqrt() / 2.0 * at * at, "its triangle");
    }
}

#[test]
fn a_cylinders_and_a_tubes_section_have_the_areas_of_their_polygons() {
    let area = |count: u32, radius: f64| f64::from(count) * 0.5 * radius * radius * (TAU / f64::from(count)).sin();
    for count in [3, 7, 24, 100] {
        let cylinder = prism(&regular(count, 1.0), 3.0);
        let cut = closed_cut(&cylinder, &plane("y=1.25"));
        assert_near(cap_area(&cut), area(count, 1.0), "cylinder");
        assert_near(volume(&cut), area(count, 1.0) * 1.25, "its volume");
        // A hollow inside, whose faces look into it.
        let mut hole = regular(count, 0.5);
        hole.reverse();
        let hollow = both(&cylinder, &{
            let mut inside = prism(&hole, 2.0);
            inside.positions.iter_mut().for_each(|it| it.y += 0.5);
            inside
        });
        let cut = closed_cut(&hollow, &plane("y=1.25"));
        assert_near(cap_area(&cut), area(count, 1.0) - area(count, 0.5), "tube");
        // A core in the hollow is a face of its own.
        let core = prism(&regular(count, 0.25), 3.0);
        let cut = closed_cut(&both(&hollow, &core), &plane("y=1.25"));
        assert_near(cap_area(&cut), area(count, 1.0) - area(count, 0.5) + area(count, 0.25), "core");
    }
}

/// Cuts by several planes, with strokes that must lie on the caps.
#[track_caller]
fn wedge_cut(mesh: &Mesh, planes: &[SectionPlane]) -> Mesh {
    let (cut, how) = mesh.clone().section(planes, Some(0.05)).unwrap();
    assert_eq!(how, Cut::Closed);
    let hatching = &cut.curves.segments[cut.curves.segments.len() - cut.curves.hatching..];
    assert!(!hatching.is_empty());
    for end in hatching.as_flattened() {
        let sides = planes.iter().map(|plane| {
            (plane.normal.dot(cut.curves.positions[*end as usize]) - plane.offset) / plane.normal.length()
        });
        let nearest = sides.fold(f64::INFINITY, f64::min);
        assert!(nearest.abs() < 1e-9, "a stroke ends {nearest} in front of all planes");
    }
    cut
}

#[test]
fn several_planes_cut_away_the_part_in_front_of_all_of_them() {
    let cube = prism(&square(1.0), 2.0);
    for (x, z) in [(0.0, 0.0), (0.3, -0.4), (-0.7, 0.9)] {
        let planes = [plane(&format!("x={x}")), plane(&format!("z={z}"))];
        for planes in [planes, [planes[1], planes[0]]] {
            let cut = wedge_cut(&cube, &planes);
            assert_near(volume(&cut), 8.0 - 2.0 * (1.0 - x) * (1.0 - z), "volume");
            assert_near(cap_area(&cut), 2.0 * (1.0 - x) + 2.0 * (1.0 - z), "area");
            // No line where the surface goes on beside a plane.
            let inside = |point: DVec3| point.x < x - 1e-9 || point.z < z - 1e-9;
            let is_new = |point: DVec3| [point.x - x, point.z - z].iter().any(|side| side.abs() < 1e-9);
            for ends in &cut.marked {
                let ends = ends.map(|end| cut.positions[end as usize]);
                assert!(!(ends.iter().all(|end| is_new(*end) && inside(*end))), "{ends:?}");
            }
        }
        let corner = wedge_cut(&cube, &[planes[0], planes[1], plane("y=1.5")]);
        assert_near(volume(&corner), 8.0 - 0.5 * (1.0 - x) * (1.0 - z), "a corner");
        assert_near(cap_area(&corner), (1.0 - x) * (1.0 - z) + 0.5 * (2.0 - x - z), "its area");
    }
    for missing in [[plane("x=0"), plane("y=3")], [plane("y=3"), plane("x=0")], [plane("x=0.5"), plane("-x=0")]] {
        assert_eq!(cube.clone().section(&missing, None).unwrap(), (cube.clone(), Cut::Missed));
    }
    let (nothing, how) = cube.section(&[plane("x=-2"), plane("y=-1")], None).unwrap();
    assert_eq!((nothing.triangles.len(), how), (0, Cut::Gone));
}

#[test]
fn a_plane_given_twice_is_one_and_none_cuts_nothing() {
    let cube = prism(&square(1.0), 2.0);
    let once = cube.clone().section(&[plane("x=0.25")], Some(0.1)).unwrap();
    let twice = [plane("x=0.25"), plane("2,0,0=0.5")];
    assert_eq!(cube.clone().section(&twice, Some(0.1)).unwrap(), once);
    assert_eq!(cube.clone().section(&[], None).unwrap(), (cube, Cut::Missed));
}

#[test]
fn several_planes_cut_a_building_far_from_the_origin() {
    let mut cube = prism(&square(10.0), 20.0);
    let place = DVec3::new(351_234.5, 12.25, 5_500_000.75);
    cube.positions.iter_mut().for_each(|position| *position += place);
    for (x, z) in [(0.3, 0.7), (-3.1, 5.9)] {
        let plane = |normal: DVec3, at: f64| SectionPlane { normal, offset: normal.dot(place) + at, is_of_file: false };
        let tilted = DVec3::new(1.0, 0.2, 0.1).normalize();
        let (cut, how) = cube.clone().section(&[plane(tilted, x), plane(DVec3::Z, z)], Some(1.0)).unwrap();
        assert_eq!(how, Cut::Closed);
        assert_closed(&cut, "far");
    }
}

#[test]
fn a_curve_that_begins_on_a_plane_and_lies_behind_another_stays_whole() {
    let curves = Curves {
        positions: vec![DVec3::new(0.0, 1.0, -0.5), DVec3::new(0.5, 1.0, -0.5)],
        file_vertices: vec![100, 101],
        segments: vec![[0, 1]],
        ..Curves::default()
    };
    let mesh = Mesh { curves, ..prism(&square(1.0), 2.0) };
    let (cut, _) = mesh.section(&[plane("x=0"), plane("z=0")], Some(0.0)).unwrap();
    let ends: Vec<[DVec3; 2]> =
        cut.curves.segments.iter().map(|ends| ends.map(|end| cut.curves.positions[end as usize])).collect();
    let length: f64 = ends.iter().map(|[a, b]| a.distance(*b)).sum();
    assert_near(length, 0.5, "length");
}

#[test]
fn of_a_sphere_and_a_hollow_several_planes_cut_away_the_part_in_front_of_all() {
    let mut numbers = Random::seeded(7);
    let mut random = || numbers.signed();
    let shell = both(&sphere(12, 17), &{
        let mut inside = sphere(9, 11);
        inside.positions.iter_mut().for_each(|it| *it *= 0.5);
        inside.triangles.iter_mut().for_each(|it| it.swap(0, 1));
        inside
    });
    let whole = volume(&shell);
    let mut compared = 0;
    for round in 0..100 {
        let planes: Vec<SectionPlane> = (0..2 + round % 2)
            .map(|_| SectionPlane {
                normal: DVec3::new(random(), random(), random()),
                offset: 0.2 * random(),
                is_of_file: false,
            })
            .collect();
        let (cut, how) = shell.clone().section(&planes, Some(0.0)).unwrap();
        // One plane after the other: such a cut through an older cut's cap may stay open, and its volume is none.
        let mut front = shell.clone();
        let hows: Vec<Cut> = planes
            .iter()
            .map(|plane| {
                let back = SectionPlane { normal: -plane.normal, offset: -plane.offset, ..*plane };
                let how;
                (front, how) = std::mem::replace(&mut front, sphere(2, 3)).section(&[back], Some(0.0)).unwrap();
                how
            })
            .collect();
        let is_missed = front.triangles.is_empty();
        assert_eq!(how, if is_missed { Cut::Missed } else { Cut::Closed }, "{planes:?}");
        if !hows.contains(&Cut::Open) {
            compared += 1;
            assert_near(volume(&cut), whole - volume(&front), "volume");
        }
        if planes.len() == 2 {
            assert_closed(&cut, &format!("{planes:?}"));
        }
    }
    assert!(compared > 70, "{compared}");
}

#[test]
fn parts_that_stay_whole_count_on_both_sides_of_a_plane() {
    let cut = |planes: &str, uncut: &[&str]| {
        let section = (!planes.is_empty()).then(|| SectionPlanes::parse(planes).unwrap());
        // A part with a minus before it is cut.
        let pattern = |name: &&str| (Pattern(name.trim_start_matches('-').to_owned()), !name.starts_with('-'));
        let uncut = uncut.iter().map(pattern).collect();
        let options = LoadOptions { section, uncut, ..LoadOptions::default() };
        load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/plates.obj"), &options).unwrap().mesh
    };
    let is_pin = |mesh: &Mesh, face: &usize| mesh.parts[mesh.triangle_parts[*face] as usize].name.starts_with("pin");
    let pins = |mesh: &Mesh| {
        let faces = (0..mesh.triangles.len()).filter(|face| is_pin(mesh, face));
        faces.map(|face| mesh.triangles[face].map(|corner| mesh.positions[corner as usize])).collect::<Vec<_>>()
    };
    let whole = cut("", &[]);
    let of_pins = Mesh {
        triangles: (0..whole.triangles.len())
            .filter(|face| is_pin(&whole, face))
            .map(|face| whole.triangles[face])
            .collect(),
        ..whole.clone()
    };
    for offset in [0.0, 0.13, -0.31] {
        let sides = [format!("z={offset}"), format!("-z={}", -offset)];
        let sum: f64 = sides.iter().map(|plane| volume(&cut(plane, &["pin*"]))).sum();
        assert_near(sum, volume(&whole) + volume(&of_pins), "both sides");
    }
    for planes in ["z=0", "z=0; x=0", "y=5"] {
        let kept = cut(planes, &["pin 1", "pin*"]);
        assert_eq!(pins(&kept), pins(&whole), "{planes}");
        assert_eq!(kept == whole, planes == "y=5", "{planes}");
    }
    assert_eq!(cut("z=0", &["pin*", "-*"]), cut("z=0", &[]), "the last rule counts");
    assert_eq!(cut("z=0", &["lower plate", "upper plate", "pin*", "spacer", "block"]).triangles, whole.triangles);
}

#[test]
fn the_two_sides_of_many_planes_make_up_a_sphere() {
    let mut numbers = Random::seeded(1);
    let mut random = || numbers.signed();
    let sphere = sphere(12, 17);
    let whole = volume(&sphere);
    assert_closed(&sphere, "whole");
    assert!(whole > 4.0);
    for _ in 0..300 {
        let normal = DVec3::new(random(), random(), random());
        let offset = random() * 0.9 * normal.length();
        let front = SectionPlane { normal, offset, is_of_file: false };
        let back = SectionPlane { normal: -normal, offset: -offset, is_of_file: false };
        let sides = [&front, &back].map(|plane| closed_cut(&sphere, plane));
        assert_near(volume(&sides[0]) + volume(&sides[1]), whole, "sides");
        assert_near(cap_area(&sides[0]), cap_area(&sides[1]), "caps");
        let height = offset / normal.length();
        // Between the circles of the spheres around it and within it.
        let within = (TAU / 34.0).cos() * (TAU / 48.0).cos();
        let [most, least] = [1.0, within].map(|radius| TAU / 2.0 * (radius * radius - height * height));
        let area = cap_area(&sides[0]);
        assert!((least..most).contains(&area), "{least} {area} {most}");
    }
}

#[test]
fn planes_through_vertices_edges_and_faces_cut_too() {
    let cube = prism(&square(1.0), 2.0);
    // Through four vertices: half the cube.
    let half = closed_cut(&cube, &plane("1,1,0=1"));
    assert_near(volume(&half), 4.0, "half");
    assert_near(cap_area(&half), 4.0 * 2f64.sqrt(), "diagonal");
    // A step of which one face lies in the plane and looks to its front, the other away from it.
    let step = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]].map(DVec2::from_array);
    let step = prism(&step, 1.0);
    let lower = closed_cut(&step, &plane("-z=1"));
    assert_near(volume(&lower), 2.0, "below the step");
    assert_near(cap_area(&lower), 1.0, "beside the step's own face");
    let upper = closed_cut(&step, &plane("z=-1"));
    assert_near(volume(&upper), 1.0, "above the step");
    assert_near(cap_area(&upper), 1.0, "its base");
    // Rings of a sphere's vertices.
    let sphere = sphere(12, 16);
    let half = closed_cut(&sphere, &plane("y=0"));
    assert_near(volume(&half) * 2.0, volume(&sphere), "hemisphere");
    let half = closed_cut(&sphere, &plane("x=0"));
    assert_near(volume(&half) * 2.0, volume(&sphere), "hemisphere through the poles");
}

#[test]
fn a_plane_that_meets_nothing_changes_nothing_and_one_that_leaves_nothing_is_refused() {
    let cube = prism(&square(1.0), 2.0);
    for text in ["y=2", "y=3", "-x=1", "1,1,1=9"] {
        assert_eq!(cube.clone().section(&[plane(text)], Some(0.0)).unwrap(), (cube.clone(), Cut::Missed), "{text}");
    }
    for text in ["y=-1", "-y=-2.5"] {
        let (nothing, cut) = cube.clone().section(&[plane(text)], Some(0.0)).unwrap();
        assert_eq!((nothing.triangles.len(), cut), (0, Cut::Gone), "{text}");
        let settings = SceneSettings::default();
        let error = Scene::new([nothing.clone()], &settings).unwrap_err().to_string();
        assert!(error.contains("lies wholly in front of the plane") && !error.contains('\n'), "{error}");
        // Beside another model it takes no part.
        let scene = Scene::new([nothing, cube.clone()], &settings).unwrap();
        assert_eq!((scene.objects.len(), scene.radius), (1, Scene::new([cube.clone()], &settings).unwrap().radius));
    }
}

#[test]
fn an_open_surface_is_cut_and_has_no_cap() {
    let mut cube = prism(&square(1.0), 2.0);
    cube.triangles.remove(8);
    cube.triangle_normals.remove(8);
    cube.file_faces.remove(8);
    let (cut, how) = cube.section(&[plane("y=1")], Some(0.0)).unwrap();
    assert_eq!((how, cap_area(&cut)), (Cut::Open, 0.0));
    assert!(cut.positions.iter().all(|position| position.y <= 1.0));
}

#[test]
fn curves_end_at_the_plane_and_points_beyond_it_go_with_their_labels() {
    let curves = [vec![-DVec3::X, DVec3::X * 3.0, DVec3::Y]];
    let points = [DVec3::X * 2.0, DVec3::ZERO];
    let mesh = Mesh::of_curves("c", &curves, &points, &["far", "near"], &LoadOptions::default()).unwrap();
    let (cut, _) = mesh.section(&[plane("x=1")], Some(0.0)).unwrap();
    let Curves { positions, segments, points, labels, .. } = &cut.curves;
    assert_eq!(segments.len(), 2);
    let highest = positions.iter().map(|it| it.x).fold(f64::MIN, f64::max);
    assert_near(highest, 1.0, "the end");
    assert_eq!((points.len(), labels.as_slice()), (1, &[(0, "near".to_owned())][..]));
    assert_eq!(positions[points[0] as usize], DVec3::ZERO);
}

#[test]
fn planes_are_written_as_they_are_read_and_others_are_refused() {
    for text in ["x=12", "-z=-0.5", "1,1,0.5=3"] {
        assert_eq!(plane(text).text(), text);
    }
    for text in ["", "x", "x=", "w=1", "x=nan", "x=inf", "0,0,0=1", "nan,0,1=2", "1,2=3"] {
        assert!(SectionPlane::parse(text).is_err(), "{text}");
    }
    let nan = SectionPlane { normal: DVec3::NAN, offset: 0.0, is_of_file: false };
    assert!(prism(&square(1.0), 2.0).section(&[nan], Some(0.0)).unwrap_err().to_string().starts_with("section"));
}

#[test]
fn the_lines_of_the_cut_are_the_sections() {
    let mut parts_seen = 0;
    for text in ["y=0.5", "x=0.25", "1,1,0=0.75", "z=-0.5"] {
        let plane = plane(text);
        let (mesh, cut) = prism(&square(1.0), 1.0).section(&[plane], Some(0.0)).unwrap();
        assert_eq!(cut, Cut::Closed, "{text}");
        for view in ["30,20", "-60,-15", "200,40"] {
            let camera = CameraSettings { view: view.parse().unwrap(), ..CameraSettings::default() };
            let settings = SceneSettings { camera, ..SceneSettings::default() };
            let scene = Scene::new(vec![Arc::new(mesh.clone())], &settings).unwrap();
            let lines = VisibleLines::of(&scene, &LineSettings::default()).unwrap();
            for segment in &lines.segments {
                let is_on_cut =
                    segment.ends_world.iter().all(|end| (plane.normal.dot(*end) - plane.offset).abs() < 1e-6);
                let name = &lines.parts[segment.part as usize].name;
                assert_eq!(name == SECTION, is_on_cut, "{text} {view}: {segment:?}");
                parts_seen += usize::from(is_on_cut);
            }
        }
    }
    assert!(parts_seen > 40, "{parts_seen}");
}

#[test]
fn a_cut_in_the_axes_of_the_file_is_turned_with_it_and_hatched() {
    use tinta_geometry::mesh::{LoadOptions, read_bytes};
    // A tetrahedron in a format whose z points up; the plane is below its tip.
    let facets = [
        [[0, 0, 0], [0, 1, 0], [1, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
        [[0, 0, 0], [0, 0, 1], [0, 1, 0]],
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ];
    let facet = |corners: &[[i32; 3]; 3]| {
        let vertices: String = corners.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let text = format!("solid t\n{}endsolid t\n", facets.iter().map(facet).collect::<String>());
    let read = |section: &str, section_hatch: Option<f64>| {
        let options =
            LoadOptions { section: Some(SectionPlanes(vec![plane(section)])), section_hatch, ..LoadOptions::default() };
        read_bytes(text.as_bytes(), "t.stl", &[], &options).unwrap().mesh
    };
    let top = |mesh: &Mesh| mesh.positions.iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
    let of_file = read("file:z=0.5", Some(0.02));
    assert!((top(&of_file) - 0.5).abs() < 1e-12, "z of the file is y of the world");
    assert!(of_file.curves.hatching > 10 && !of_file.curves.has_own());
    // The strokes lie on the cut, a triangle of half the size.
    assert!(of_file.curves.positions.iter().all(|point| (point.y - 0.5).abs() < 1e-12));
    let length: f64 = of_file
        .curves
        .segments
        .iter()
        .map(|[a, b]| of_file.curves.positions[*a as usize].distance(of_file.curves.positions[*b as usize]))
        .sum();
    assert!((length * 0.02 - 0.125).abs() < 0.02, "{length}");
    assert_eq!(read("file:z=0.5", Some(0.0)).curves.hatching, 0);
    // In the coordinates of the world, as recorded before, nothing is hatched.
    let of_world = read("y=0.5", None);
    assert_eq!((top(&of_world), of_world.curves.hatching), (0.5, 0));
    assert_eq!((&of_world.triangles, &of_world.positions), (&of_file.triangles, &of_file.positions));
    assert_eq!(plane("file:1,2,0=5").text(), "file:1,2,0=5");
}
