use super::*;
use crate::camera::CameraSettings;
use crate::edges::{ClassCounts, SilhouetteRule};
use crate::lines::smooth::closed_forms::ClosedForm;
use crate::lines::{DrawingSettings, LineTimes, svg_of_paths};
use crate::mesh::{LoadOptions, Mesh};
use crate::scene::{SceneSettings, Size};
use glam::DVec2;
use std::collections::BTreeSet;
use std::sync::Arc;

fn scene(mesh: Mesh) -> Scene {
    Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap()
}

fn cube() -> Scene {
    let at = |n: u32, bit: u32| f64::from(n >> bit & 1);
    let corners = (0..8).map(|n| DVec3::new(at(n, 0), at(n, 1), at(n, 2))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    scene(Mesh::of_triangles("cube", corners, &triangles, &LoadOptions::default()).unwrap())
}

/// The lines and paths of each picture of a turn.
fn turn(scene: &Scene, settings: &LineSettings, views: u32) -> Vec<(VisibleLines, Vec<LinePath>)> {
    let mut ids = StrokeIds::new(scene, settings);
    let cameras = scene.turntable(&CameraSettings::default(), views).unwrap();
    let frame = |camera| {
        let scene = Scene { camera, ..scene.clone() };
        let lines = VisibleLines::of(&scene, settings).unwrap();
        let paths = ids.next(&scene, &lines);
        (lines, paths)
    };
    cameras.into_iter().map(frame).collect()
}

#[test]
fn the_twelve_edges_of_a_cube_keep_their_numbers_over_a_turn() {
    let scene = cube();
    for finds_hidden in [false, true] {
        let settings = LineSettings { finds_hidden, ..LineSettings::default() };
        let mut known: HashMap<[u32; 2], u32> = HashMap::new();
        for (lines, paths) in turn(&scene, &settings, 24) {
            let mut of_frame = BTreeSet::new();
            for path in &paths {
                let edges: BTreeSet<_> =
                    path.segments.iter().map(|piece| lines.segments[*piece].edge.unwrap()).collect();
                assert_eq!(edges.len(), 1, "a path keeps to one edge");
                let (edge, id) = (*edges.first().unwrap(), path.stroke.unwrap());
                assert_eq!(*known.entry(edge).or_insert(id), id, "edge {edge:?}");
                assert!(of_frame.insert(id), "{id} twice");
            }
            assert!(!finds_hidden || of_frame.len() == 12);
        }
        assert_eq!(known.len(), 12);
        assert_eq!(known.values().collect::<BTreeSet<_>>().len(), 12);
    }
}

#[test]
fn the_outline_of_a_sphere_is_one_stroke_for_the_whole_turn() {
    let ball = scene(ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(2_000, 0.0).unwrap());
    let settings = LineSettings { silhouette: SilhouetteRule::Smooth, finds_hidden: false, ..LineSettings::default() };
    for views in [6, 36, 90] {
        for (_, paths) in turn(&ball, &settings, views) {
            let ids: Vec<_> = paths.iter().map(|path| (path.stroke, path.is_closed)).collect();
            assert_eq!(ids, [(Some(1), true)], "{views} views");
        }
    }
}

/// Creases along the x axis, each between two given places.
fn creases(of: &[[f64; 2]]) -> VisibleLines {
    let crease = |ends: &[f64; 2]| LineSegment {
        class: Class::Crease,
        is_visible: true,
        is_outline: false,
        background: [false; 2],
        is_covered: false,
        ends_px: ends.map(|x| DVec2::new(x * 10.0, 20.0)),
        ends_world: ends.map(|x| DVec3::new(x, 0.0, 0.0)),
        edge: Some([0, 1]),
        angle_degrees: None,
        object: 0,
        part: 0,
        look: 0,
    };
    VisibleLines {
        size: Size { width: 100, height: 100 },
        segments: of.iter().map(crease).collect(),
        edges: ClassCounts::default(),
        changes: None,
        px_per_mm: None,
        covered_triangles: 0,
        labels: Vec::new(),
        parts: Vec::new(),
        looks: Vec::new(),
        times: LineTimes::default(),
    }
}

#[test]
fn a_stroke_that_splits_keeps_its_number_in_the_longer_part_and_a_hidden_one_comes_back() {
    let scene = cube();
    let mut ids = StrokeIds::new(&scene, &LineSettings::default());
    let mut next = |of: &[[f64; 2]]| -> Vec<u32> {
        let lines = creases(of);
        let paths = ids.next(&scene, &lines);
        let text = svg_of_paths(&lines, paths.clone(), None, &DrawingSettings::default()).unwrap();
        let strokes: Vec<u32> = paths.iter().filter_map(|path| path.stroke).collect();
        assert!(strokes.iter().all(|id| text.contains(&format!(r#"id="stroke-{id}""#))), "{text}");
        strokes
    };
    assert_eq!(next(&[[0.0, 1.0]]), [1]);
    assert_eq!(next(&[[0.0, 0.3], [0.4, 1.0]]), [2, 1], "the longer part");
    assert_eq!(next(&[[0.0, 0.6], [0.7, 1.0]]), [2, 1], "each has most in common with itself");
    assert_eq!(next(&[]), [0; 0]);
    assert_eq!(next(&[[0.75, 1.0]]), [1], "as it was when it was seen last");
    assert_eq!(next(&[[0.0, 1.0]]), [1], "of two that become one, what was there a moment ago");
    assert_eq!(next(&[[3.0, 4.0]]), [3], "nothing in common");
}

#[test]
fn what_slides_is_gone_when_it_is_not_seen_and_the_longer_of_two_gives_its_number() {
    let scene = cube();
    let mut ids = StrokeIds::new(&scene, &LineSettings::default());
    let mut next = |of: &[[f64; 2]]| -> Vec<u32> {
        let mut lines = creases(of);
        lines.segments.iter_mut().for_each(|segment| {
            segment.class = Class::Silhouette;
            segment.edge = None;
        });
        ids.next(&scene, &lines).iter().filter_map(|path| path.stroke).collect()
    };
    assert_eq!(next(&[[0.0, 0.3], [0.4, 1.0]]), [1, 2]);
    assert_eq!(next(&[[0.0, 1.0]]), [2]);
    assert_eq!(next(&[]), [0; 0]);
    assert_eq!(next(&[[0.0, 1.0]]), [3]);
}

#[test]
fn the_strokes_of_a_torus_are_few_over_a_turn_and_the_same_in_every_run() {
    let torus = scene(ClosedForm::Torus { ring: 1.0, tube: 0.4 }.mesh(10_000, 0.0).unwrap());
    let settings = LineSettings { silhouette: SilhouetteRule::Smooth, finds_hidden: false, ..LineSettings::default() };
    let numbers = || -> Vec<Vec<Option<u32>>> {
        let of = |(_, paths): (VisibleLines, Vec<LinePath>)| paths.iter().map(|path| path.stroke).collect();
        turn(&torus, &settings, 72).into_iter().map(of).collect()
    };
    let first = numbers();
    assert_eq!(first, numbers());
    // The hole turns about an axis in its plane: strokes are the outline, and the hole's rim each time it opens.
    let count = first.iter().flatten().collect::<BTreeSet<_>>().len();
    assert!(count <= 12, "{count}: {first:?}");
}
