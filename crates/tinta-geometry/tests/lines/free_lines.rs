//! Curves and points beside surfaces, against rays in f64 and world space: each sampled point of a curve is hidden where a face lies
//! between the eye and the point lifted by `on_surface`, and nowhere else. The rays use no formula of the library.

use crate::support::lines::px;
use crate::support::random_scenes::random_scene;
use crate::support::shapes::{Random, cuboid};
use glam::DVec3;
use std::sync::Arc;
use tinta::camera::Projection;
use tinta::edges::{Class, ClassSet};
use tinta::lines::{LineSegment, svg};
use tinta::mesh::read_bytes;
use tinta::{CameraSettings, DrawingSettings, LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines};

/// Weights of a face's corners within which a ray may hit the face or pass beside it, and the same for depths, of the scene's radius.
const UNCLEAR: f64 = 1e-7;

fn is_parallel(scene: &Scene) -> bool {
    matches!(scene.camera.projection, Projection::Parallel { .. })
}

/// The share of its depth, or the length, that a lift of this size moves a point by.
fn lift(scene: &Scene, on_surface: f64) -> f64 {
    let distance = scene.camera.eye.distance(scene.centre).max(scene.radius);
    on_surface * scene.radius / if is_parallel(scene) { 1.0 } else { distance }
}

/// Whether faces hide a point that is lifted; `None` where rounding decides.
fn is_hidden(scene: &Scene, point: DVec3, on_surface: f64) -> Option<bool> {
    let camera = &scene.camera;
    let (backward, lift) = (camera.backward(), lift(scene, on_surface));
    let (point, to_eye) = match is_parallel(scene) {
        true => (point + backward * lift, backward),
        false => (point + (camera.eye - point) * lift, (camera.eye - point) * (1.0 - lift)),
    };
    let depth = (camera.eye - point).dot(backward);
    let mut is_unclear = false;
    for object in &scene.objects {
        for triangle in &object.mesh.triangles {
            let [a, b, c] = triangle.map(|corner| object.mesh.positions[corner as usize] + object.offset);
            // Möller and Trumbore: the point plus `along` times the ray is on the face.
            let (ab, ac, across) = (b - a, c - a, to_eye.cross(c - a));
            let determinant = ab.dot(across);
            let to_point = point - a;
            let first = to_point.dot(across) / determinant;
            let second = to_eye.dot(to_point.cross(ab)) / determinant;
            let along = ac.dot(to_point.cross(ab)) / determinant;
            let inside = first.min(second).min(1.0 - first - second);
            let steepness = determinant.abs() / (ab.length() * ac.length() * to_eye.length());
            let behind = along * to_eye.dot(backward);
            let before_near = depth - behind - camera.near;
            let margin = UNCLEAR * scene.radius;
            if steepness < 1e-6
                || !inside.is_finite()
                || inside < -UNCLEAR / steepness
                || behind < -margin
                || before_near < -margin
            {
                // Edge-on, beside, behind or cut off: edge-on faces are unclear only where the ray is in their plane.
                let is_in_plane = ab.cross(ac).normalize_or_zero().dot(to_point).abs() < 1e-5;
                is_unclear |= steepness < 1e-6 && is_in_plane;
                continue;
            }
            if inside > UNCLEAR / steepness && behind > margin && before_near > margin {
                return Some(true);
            }
            is_unclear = true;
        }
    }
    if is_unclear { None } else { Some(false) }
}

/// A point of space, sometimes on a face, sometimes close below or above one.
fn somewhere(scene: &Scene, reach: f64, random: &mut Random) -> DVec3 {
    let around = |random: &mut Random| DVec3::new(random.number(), random.number(), random.number()) * 2.0 - DVec3::ONE;
    if random.number() < 0.5 {
        return scene.centre + around(random) * scene.radius * reach;
    }
    let mesh = &scene.objects[(random.number() * scene.objects.len() as f64) as usize].mesh;
    let face = mesh.triangles[(random.number() * mesh.triangles.len() as f64) as usize];
    let [a, b, c] = face.map(|corner| mesh.positions[corner as usize]);
    let (u, v) = (random.number(), random.number());
    let on_it = a + (b - a) * u * (1.0 - v) + (c - a) * v * u;
    match (random.number() * 3.0) as u32 {
        0 => on_it,
        _ => on_it + around(random) * scene.radius * 10f64.powf(-1.0 - 6.0 * random.number()),
    }
}

/// Random curves and points as a model of their own.
fn free_lines(scene: &Scene, reach: f64, random: &mut Random) -> Mesh {
    let curve = |random: &mut Random| {
        let count = 2 + (random.number() * 6.0) as usize;
        (0..count).map(|_| somewhere(scene, reach, random)).collect::<Vec<_>>()
    };
    let curves: Vec<Vec<DVec3>> = (0..8).map(|_| curve(random)).collect();
    let points: Vec<DVec3> = (0..40).map(|_| somewhere(scene, reach, random)).collect();
    Mesh::of_curves("curves", &curves, &points, &[], &LoadOptions::default()).unwrap()
}

/// The scene with another model, under the same camera.
fn with(scene: &Scene, free: Mesh) -> Scene {
    let meshes = scene.objects.iter().map(|object| object.mesh.clone()).chain([Arc::new(free)]);
    let settings = SceneSettings { size: scene.size, ..SceneSettings::default() };
    Scene { camera: scene.camera, ..Scene::new(meshes, &settings).unwrap() }
}

/// Scenes of four kinds, with curves that leave the models' box by `reach`; each with settings.
fn scenes(count: u64, reach: f64) -> impl Iterator<Item = (Scene, Scene, LineSettings, Random)> {
    (1..=count).map(move |seed| {
        let mut random = Random::seeded(seed);
        let scene = random_scene(seed as u32 % 4, &mut random);
        let free = free_lines(&scene, reach, &mut random);
        let on_surface = [1e-6, 1e-4, 0.0, 0.03][seed as usize / 4 % 4];
        (scene.clone(), with(&scene, free), LineSettings { on_surface, ..LineSettings::default() }, random)
    })
}

fn is_free(segment: &&LineSegment) -> bool {
    ClassSet::FREE.contains(segment.class)
}

/// Samples the free lines of many scenes; returns how many points were visible, hidden and unclear.
fn check(count: u64, samples: usize) -> [usize; 3] {
    let mut counts = [0; 3];
    for (number, (_, scene, settings, mut random)) in scenes(count, 1.2).enumerate() {
        let lines = VisibleLines::of(&scene, &settings).unwrap();
        for segment in lines.segments.iter().filter(is_free) {
            let [a, b] = segment.ends_world;
            let samples = if segment.class == Class::Point { 1 } else { samples };
            for _ in 0..samples {
                let share = random.number();
                let image = segment.ends_px[0].lerp(segment.ends_px[1], share);
                // The point of the curve that is drawn there.
                let along = b - a;
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..60 {
                    let middle = (low + high) * 0.5;
                    let drawn = px(&scene, a + along * middle);
                    let is_before = (drawn - segment.ends_px[0]).length() < (image - segment.ends_px[0]).length();
                    *(if is_before { &mut low } else { &mut high }) = middle;
                }
                let point = a + along * low;
                let from_ends = segment.ends_px.map(|end| end.distance(image)).into_iter().fold(f64::MAX, f64::min);
                // Within a thousandth of a pixel of where it changes rounding decides.
                if segment.class == Class::Curve && from_ends < 1e-3 {
                    continue;
                }
                let expected = is_hidden(&scene, point, settings.on_surface);
                counts[expected.map_or(2, usize::from)] += 1;
                let found = !segment.is_visible;
                assert!(
                    expected.is_none_or(|it| it == found),
                    "scene {number}: hidden is {found} at {image} {point} of {segment:?}"
                );
            }
        }
    }
    counts
}

#[test]
fn curves_and_points_are_hidden_where_rays_meet_faces_and_nowhere_else() {
    let [visible, hidden, unclear] = check(240, 1);
    println!("{visible} visible, {hidden} hidden, {unclear} unclear");
    assert!(visible > 5_000 && hidden > 5_000 && unclear * 20 < visible + hidden);
}

#[test]
#[ignore = "exhaustive: 100,000 points of 1,200 scenes"]
fn a_hundred_thousand_points_of_curves_are_as_rays_say() {
    let [visible, hidden, unclear] = check(1_200, 2);
    println!("{visible} visible, {hidden} hidden, {unclear} unclear");
    assert!(visible + hidden > 100_000 && unclear * 20 < visible + hidden);
}

#[test]
fn the_pieces_of_a_curve_follow_one_another_from_end_to_end() {
    for (_, scene, settings, _) in scenes(80, 0.7) {
        let lines = VisibleLines::of(&scene, &settings).unwrap();
        let pieces: Vec<&LineSegment> = lines.segments.iter().filter(|it| it.class == Class::Curve).collect();
        for of_one in pieces.chunk_by(|a, b| a.edge == b.edge) {
            for pair in of_one.windows(2) {
                assert_eq!(pair[0].ends_px[1], pair[1].ends_px[0]);
                assert!(pair[0].is_visible != pair[1].is_visible || pair[0].is_covered != pair[1].is_covered);
                let gap = pair[0].ends_world[1].distance(pair[1].ends_world[0]);
                assert!(gap < 1e-9, "{gap}");
            }
            // The ends in the world are those given, not lifted ones, where the picture does not cut them off.
            let curves = &scene.objects.last().unwrap().mesh.curves;
            let given = of_one[0]
                .edge
                .unwrap()
                .map(|vertex| curves.positions[curves.file_vertices.iter().position(|it| *it == vertex).unwrap()]);
            let found = [of_one[0].ends_world[0], of_one[of_one.len() - 1].ends_world[1]];
            for (given, found) in given.into_iter().zip(found) {
                let along = (found - given).length();
                let is_on_border = px(&scene, found).distance(px(&scene, given)) > 1e-6;
                assert!(along < 1e-8 || is_on_border, "{given} {found}");
            }
        }
    }
}

#[test]
fn curves_change_no_line_of_a_surface() {
    for (alone, scene, settings, _) in scenes(80, 0.0) {
        // The box and with it all tolerances stay: curves lie within it.
        let scene = Scene { centre: alone.centre, radius: alone.radius, ..scene };
        for finds_hidden in [true, false] {
            let settings = LineSettings { finds_hidden, finds_outline: true, ..settings.clone() };
            let [without, with] = [&alone, &scene].map(|scene| VisibleLines::of(scene, &settings).unwrap());
            let others: Vec<&LineSegment> = with.segments.iter().filter(|segment| !is_free(segment)).collect();
            assert_eq!(others, without.segments.iter().collect::<Vec<_>>());
            assert!(with.segments.iter().filter(is_free).all(|segment| !segment.is_outline));
        }
    }
}

#[test]
fn the_search_finds_the_curves_of_the_reference() {
    for (_, scene, settings, _) in scenes(40, 1.2) {
        let of = |reference| {
            let lines = VisibleLines::of(&scene, &LineSettings { reference, ..settings.clone() }).unwrap();
            let free = lines.segments.into_iter().filter(|segment| is_free(&segment) && !segment.is_covered);
            free.collect::<Vec<_>>()
        };
        let (search, reference) = (of(false), of(true));
        let length = |segments: &[LineSegment], class: Class, is_visible: bool| -> f64 {
            let of_it = segments.iter().filter(|it| (it.class, it.is_visible) == (class, is_visible));
            of_it.map(|it| it.ends_px[0].distance(it.ends_px[1]) + f64::from(u8::from(class == Class::Point))).sum()
        };
        for class in [Class::Curve, Class::Point] {
            for is_visible in [true, false] {
                let [a, b] = [&search, &reference].map(|segments| length(segments, class, is_visible));
                assert!((a - b).abs() < 1e-3, "{class:?} visible {is_visible}: {a} for {b}");
            }
        }
    }
}

/// A cube from -1 to 1 with a curve and a point this far below the middle of its top, seen from above.
fn below_the_top(depth: f64, parallel: bool) -> Scene {
    let at = |x: f64| DVec3::new(x, 1.0 - depth, 0.1);
    let free =
        Mesh::of_curves("curve", &[vec![at(-0.5), at(0.5)]], &[at(0.2)], &["A & B"], &LoadOptions::default()).unwrap();
    let camera = CameraSettings { view: "top".parse().unwrap(), parallel, ..CameraSettings::default() };
    let settings = SceneSettings { camera, ..SceneSettings::default() };
    Scene::new([cuboid(-DVec3::ONE, DVec3::ONE), free], &settings).unwrap()
}

#[test]
fn what_lies_within_the_tolerance_below_a_face_is_seen_and_what_is_deeper_is_not() {
    for parallel in [true, false] {
        for on_surface in [1e-6, 1e-4, 0.05] {
            let scene = below_the_top(0.0, parallel);
            // In perspective the lift is proportional to the depth, and the top is nearer than the centre.
            let nearness = if parallel { 1.0 } else { 1.0 - 1.0 / scene.camera.eye.distance(scene.centre) };
            let limit = on_surface * scene.radius * nearness;
            for (share, is_seen) in [(0.0, true), (0.95, true), (1.1, false)] {
                let scene = below_the_top(limit * share, parallel);
                let settings = LineSettings { on_surface, ..LineSettings::default() };
                let lines = VisibleLines::of(&scene, &settings).unwrap();
                let free: Vec<bool> = lines.segments.iter().filter(is_free).map(|it| it.is_visible).collect();
                assert_eq!(free, [is_seen; 2], "{on_surface} {share} parallel {parallel}");
            }
        }
    }
}

#[test]
fn curves_far_outside_and_through_the_eye_are_cut_off() {
    let mut scene = below_the_top(-1.0, false);
    let eye = scene.camera.eye;
    for line in [
        [eye - DVec3::Y, eye + DVec3::Y],
        [eye, eye + DVec3::X],
        [DVec3::X * 1e12, -DVec3::X * 1e12],
        [DVec3::Z * 1e12; 2],
    ] {
        let curves = Mesh::of_curves("curve", &[line.to_vec()], &line, &[], &LoadOptions::default()).unwrap();
        scene.objects[1] = scene.objects[1].with_mesh(Arc::new(curves));
        for reference in [false, true] {
            let settings = LineSettings { reference, ..LineSettings::default() };
            let lines = VisibleLines::of(&scene, &settings).unwrap();
            assert!(lines.check().is_ok());
            assert!(
                lines.segments.iter().filter(is_free).all(|segment| segment.ends_world.iter().all(|it| it.is_finite()))
            );
        }
    }
}

#[test]
fn bad_curves_are_refused_in_one_sentence() {
    let refused = |curves: &[Vec<DVec3>], points: &[DVec3]| {
        Mesh::of_curves("c", curves, points, &[], &LoadOptions::default()).unwrap_err().to_string()
    };
    let line = vec![DVec3::ZERO, DVec3::X];
    assert_eq!(
        refused(&[line.clone(), vec![DVec3::X]], &[]),
        "c: curve 1 has fewer than two positions; give it two or more, or give a point"
    );
    assert!(
        refused(&[vec![DVec3::ZERO, DVec3::NAN]], &[]).contains("curve 0 has a coordinate that is not a finite number")
    );
    assert!(refused(&[], &[DVec3::INFINITY]).contains("point 0 has a coordinate that is not a finite number"));
    assert!(refused(&[vec![DVec3::ZERO, DVec3::X * 1e200]], &[]).contains("reach beyond"));
    for on_surface in [-1e-9, 0.2, f64::NAN] {
        let settings = LineSettings { on_surface, ..LineSettings::default() };
        let error = VisibleLines::of(&below_the_top(0.0, true), &settings).unwrap_err().to_string();
        assert!(error.starts_with("on-surface"), "{error}");
    }
}

#[test]
fn a_model_of_curves_alone_is_drawn_with_dots_for_points() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.25 0\nl 1 2 3 1\np 4\n";
    let mesh = read_bytes(text.as_bytes(), "a.obj", &[], &LoadOptions::default()).unwrap().mesh;
    let scene = Scene::new([mesh], &SceneSettings::default()).unwrap();
    for settings in [
        LineSettings::default(),
        LineSettings { classes: ClassSet::ALL, finds_outline: true, ..LineSettings::default() },
        LineSettings { silhouette: "smooth".parse().unwrap(), ..LineSettings::default() },
    ] {
        let lines = VisibleLines::of(&scene, &settings).unwrap();
        assert_eq!((lines.segments.len(), lines.edges.curve, lines.edges.point), (4, 3, 1));
        for fit_px in [None, Some(0.5)] {
            let drawing = svg(&lines, &DrawingSettings { fit_px, ..DrawingSettings::default() }).unwrap();
            let layers =
                ["visible-curve", "visible-point"].map(|id| drawing.split(&format!("id=\"{id}\"")).nth(1).unwrap());
            assert!(layers[0].contains("Z\"/>"), "a closed curve is one path: {drawing}");
            let dot = layers[1].split("d=\"M").nth(1).unwrap().split('"').next().unwrap();
            let (from, to) = dot.split_once('L').unwrap();
            assert_eq!(from, to);
            assert!(layers[1].contains("stroke-width=\"4\""), "{drawing}");
        }
    }
}

#[test]
fn clouds_of_points_and_edges_of_ply_are_read() {
    let ply = |elements: &str, body: &str| {
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{elements}end_header\n0 0 0\n1 0 0\n0 1 0\n{body}"
        );
        read_bytes(text.as_bytes(), "a.ply", &[], &LoadOptions::default()).unwrap()
    };
    let cloud = ply("", "");
    assert_eq!((cloud.mesh.curves.points.len(), cloud.remarks.len()), (3, 0));
    let edges = ply(
        "element edge 3\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n",
        "0 1 9\n1 2 9\n2 7 9\n",
    );
    assert_eq!(edges.mesh.curves.segments, [[0, 1], [1, 2]]);
    assert!(edges.mesh.curves.points.is_empty() && edges.mesh.defects.out_of_range_faces == 1);
    let others = ply(
        "element edge 1\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\n",
        "9\n3 0 1 2\n",
    );
    assert!(others.mesh.curves.is_empty() && others.mesh.triangles.len() == 1);
}

#[test]
fn labels_are_texts_where_their_points_are_seen() {
    let texts = |depth: f64, hidden: &str| {
        let settings = LineSettings::default();
        let lines = VisibleLines::of(&below_the_top(depth, true), &settings).unwrap();
        let reference = LineSettings { reference: true, ..settings };
        assert_eq!(lines.labels, VisibleLines::of(&below_the_top(depth, true), &reference).unwrap().labels);
        let drawing = DrawingSettings { hidden: hidden.parse().unwrap(), ..DrawingSettings::default() };
        svg(&lines, &drawing).unwrap().matches(">A &amp; B</text>").count()
    };
    assert_eq!((texts(0.0, "none"), texts(0.5, "none"), texts(0.5, "dashed")), (1, 0, 1));
    let refused = |labels: &[&str]| {
        Mesh::of_curves("c", &[], &[DVec3::ZERO], labels, &LoadOptions::default()).unwrap_err().to_string()
    };
    assert_eq!(refused(&["a", "b"]), "c: there are 2 labels for 1 points; give each point one");
    assert_eq!(refused(&[&"\u{1f600}".repeat(1_001)]), "c: label 0 has more than 1000 letters; shorten it");
}
