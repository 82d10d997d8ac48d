//! The visible lines stay the same under changes that leave the picture the same.

use crate::support::families::FAMILIES;
use crate::support::lines::{explicit, length, lines, moved_camera, scene_of, shuffled, view};
use crate::support::shapes::{Random, cuboid, icosphere};
use crate::support::{builtin, public_meshes};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use std::sync::Arc;
use tinta::edges::Class;
use tinta::lines::VisibleLines;
use tinta::{CameraSettings, Mesh, Scene, SceneSettings};

/// The scene of a model, with the camera given in numbers to move it with the model.
fn seen(mesh: &Mesh, camera: &CameraSettings) -> Scene {
    scene_of(vec![mesh.clone()], camera.clone())
}

/// A mesh and its camera under a similarity.
fn moved(mesh: &Mesh, camera: &CameraSettings, turn: DMat3, scale: f64, shift: DVec3) -> (Mesh, CameraSettings) {
    let positions = mesh.positions.iter().map(|point| turn * *point * scale + shift).collect();
    (Mesh { positions, ..mesh.clone() }, moved_camera(camera, turn, scale, shift))
}

/// Length by class and visibility.
fn sums(lines: &VisibleLines) -> BTreeMap<(Class, bool), f64> {
    let mut sums = BTreeMap::new();
    for segment in &lines.segments {
        *sums.entry((segment.class, segment.is_visible)).or_default() += length(segment);
    }
    sums
}

/// Asserts that lengths agree to a share of all, class by class.
#[track_caller]
fn assert_same_sums(expected: &VisibleLines, actual: &VisibleLines, share: f64, what: &str) {
    let (expected, actual) = (sums(expected), sums(actual));
    let all: f64 = expected.values().sum();
    let keys: std::collections::BTreeSet<_> = expected.keys().chain(actual.keys()).collect();
    for key in keys {
        let [a, b] = [&expected, &actual].map(|sums| sums.get(key).copied().unwrap_or_default());
        assert!((a - b).abs() <= share * all, "{what}: {key:?} {b} px instead of {a}, of {all}");
    }
}

/// Asserts that pieces agree one by one.
#[track_caller]
fn assert_same_pieces(expected: &VisibleLines, actual: &VisibleLines, distance_px: f64, what: &str) {
    assert_eq!(expected.segments.len(), actual.segments.len(), "{what}");
    for (a, b) in expected.segments.iter().zip(&actual.segments) {
        assert_eq!((a.class, a.is_visible, a.edge), (b.class, b.is_visible, b.edge), "{what}: {a:?} {b:?}");
        let distance = (0..2).map(|end| a.ends_px[end].distance(b.ends_px[end])).fold(0.0, f64::max);
        assert!(distance <= distance_px, "{what}: {distance} px between {a:?} and {b:?}");
    }
}

fn models() -> Vec<(&'static str, Mesh)> {
    let mut models: Vec<(&'static str, Mesh)> =
        ["open-box", "gear", "ant", "bust"].map(|name| (name, builtin(name))).to_vec();
    models.push(("a box", cuboid(DVec3::new(-1.0, 0.5, 2.0), DVec3::new(1.5, 1.0, 4.0))));
    models.push(("a sphere", icosphere(3)));
    models
}

#[test]
fn the_same_scene_twice_has_the_same_lines() {
    for (name, mesh) in models() {
        let camera = view("30,15", false);
        assert_eq!(lines(&seen(&mesh, &camera)).segments, lines(&seen(&mesh, &camera)).segments, "{name}");
    }
}

#[test]
fn lines_turn_with_their_camera() {
    let mut random = Random(11);
    for (name, mesh) in models() {
        for parallel in [false, true] {
            let scene = seen(&mesh, &view("33,17", parallel));
            let camera = explicit(&scene);
            let expected = lines(&seen(&mesh, &camera));
            for _ in 0..2 {
                let turn = DMat3::from_axis_angle(random.direction(), random.number() * 6.0);
                let (mesh, camera) = moved(&mesh, &camera, turn, 1.0, DVec3::ZERO);
                let actual = lines(&seen(&mesh, &camera));
                let what = format!("{name} parallel {parallel}");
                assert_same_sums(&expected, &actual, 1e-6, &what);
            }
        }
    }
}

#[test]
fn rolling_the_camera_in_an_axis_view_of_flat_faces_changes_no_line() {
    for (name, mesh) in models().into_iter().filter(|(name, _)| !name.ends_with("bust") && !name.ends_with("sphere")) {
        for direction in ["front", "right", "top"] {
            for parallel in [false, true] {
                let scene = seen(&mesh, &view(direction, parallel));
                // From farther away, to keep the corners in the picture.
                let mut camera = explicit(&scene);
                let away = scene.camera.eye - scene.camera.target;
                camera.eye = Some(scene.camera.target + away * 2.0);
                camera.far = None;
                camera.near = None;
                if parallel {
                    camera.height = Some(scene.radius * 3.0);
                }
                let expected = lines(&seen(&mesh, &camera));
                for degrees in [27.0, 45.0, 63.0, 90.0, 152.0f64] {
                    let roll = DMat3::from_axis_angle(away.normalize(), degrees.to_radians());
                    let rolled = CameraSettings { up: Some(roll * scene.camera.up), ..camera.clone() };
                    let actual = lines(&seen(&mesh, &rolled));
                    let what = format!("{name} from the {direction}, parallel {parallel}, rolled by {degrees} degrees");
                    assert_same_sums(&expected, &actual, 1e-6, &what);
                }
            }
        }
    }
}

#[test]
fn lines_of_any_size_are_the_same() {
    for (name, mesh) in models() {
        for parallel in [false, true] {
            let expected = lines(&seen(&mesh, &view("33,17", parallel)));
            for scale in [1e-6, 1e-3, 1.0 / 1024.0, 1024.0, 1e3, 1e6] {
                let (mesh, _) = moved(&mesh, &CameraSettings::default(), DMat3::IDENTITY, scale, DVec3::ZERO);
                let actual = lines(&seen(&mesh, &view("33,17", parallel)));
                let what = format!("{name} times {scale} parallel {parallel}");
                assert_same_sums(&expected, &actual, 1e-6, &what);
                if scale.log2().fract() == 0.0 {
                    assert_same_pieces(&expected, &actual, 1e-6, &what);
                }
            }
        }
    }
}

#[test]
fn lines_a_million_units_away_are_the_same_as_far_as_numbers_reach() {
    for (name, mesh) in models() {
        for parallel in [false, true] {
            // Rounded to make the conversion exact.
            let positions = mesh.positions.iter().map(|p| (*p * 65536.0).round() / 65536.0).collect();
            let mesh = Mesh { positions, ..mesh.clone() };
            let expected = lines(&seen(&mesh, &view("33,17", parallel)));
            let (mesh, _) = moved(&mesh, &CameraSettings::default(), DMat3::IDENTITY, 1.0, DVec3::new(1e6, -1e6, 1e6));
            let actual = lines(&seen(&mesh, &view("33,17", parallel)));
            assert_same_sums(&expected, &actual, 1e-5, &format!("{name} parallel {parallel}"));
        }
    }
}

#[test]
fn families_of_scenes_far_from_the_origin_are_seen_alike() {
    for (name, make) in &FAMILIES {
        let scene = make(&mut Random::seeded(1));
        let camera = explicit(&scene);
        let far = |mesh: &Mesh| moved(mesh, &camera, DMat3::IDENTITY, 1.0, DVec3::new(1e8, -1e8, 1e8));
        let away = scene_of(scene.objects.iter().map(|it| far(&it.mesh).0).collect(), far(&scene.objects[0].mesh).1);
        assert_same_sums(&lines(&scene), &lines(&away), 1e-5, name);
    }
}

#[test]
fn the_order_of_vertices_and_faces_does_not_matter() {
    let mut random = Random(5);
    for (name, mesh) in models() {
        for parallel in [false, true] {
            let camera = view("33,17", parallel);
            let expected = lines(&seen(&mesh, &camera));
            let actual = lines(&seen(&shuffled(&mesh, &mut random), &camera));
            assert_same_sums(&expected, &actual, 1e-9, &format!("{name} parallel {parallel}"));
            assert_eq!(expected.edges, actual.edges, "{name}");
        }
    }
}

#[test]
fn lines_need_no_depth_buffer_and_no_near_eye() {
    for (name, mesh) in models() {
        let seen_by = |camera: CameraSettings| lines(&seen(&mesh, &camera));
        let (near, far) = (Some(1e-12), Some(1e12));
        let expected = seen_by(view("33,17", false));
        let actual = seen_by(CameraSettings { near, far, ..view("33,17", false) });
        assert_same_sums(&expected, &actual, 1e-9, &format!("{name} between planes far apart"));
        let expected = seen_by(view("33,17", true));
        let from_afar = seen_by(CameraSettings { fov_y_degrees: 0.001, ..view("33,17", false) });
        assert_same_sums(&expected, &from_afar, 1e-4, &format!("{name} from very far away"));
    }
}

#[test]
fn the_order_of_objects_does_not_matter() {
    let meshes = [builtin("gear"), builtin("ant"), cuboid(DVec3::splat(-0.4), DVec3::splat(0.6))];
    let expected = lines(&scene_of(meshes.to_vec(), view("iso", false)));
    let actual = lines(&scene_of(meshes.iter().rev().cloned().collect(), view("iso", false)));
    assert_same_sums(&expected, &actual, 1e-9, "three models in one place");
}

#[test]
fn copies_are_seen_as_the_same_mesh_at_other_places() {
    let mesh = Arc::new(builtin("gear"));
    let settings = SceneSettings { copies: 4, ..SceneSettings::default() };
    let scene = Scene::new(vec![mesh.clone()], &settings).unwrap();
    let expected = lines(&scene);
    let apart = scene.objects.iter().map(|object| {
        let positions = mesh.positions.iter().map(|point| *point + object.offset).collect();
        Arc::new(Mesh { positions, ..(*mesh).clone() })
    });
    let actual = lines(&Scene::new(apart, &SceneSettings::default()).unwrap());
    assert_same_sums(&expected, &actual, 1e-6, "four gears");
    assert_eq!(expected.edges.boundary, actual.edges.boundary);
}

#[test]
fn lines_of_public_models_turn_and_grow_with_their_camera() {
    for (file, mesh) in public_meshes(&["cow.obj", "suzanne.obj", "teapot.obj", "beethoven.obj"]) {
        let scene = seen(&mesh, &view("33,17", false));
        let camera = explicit(&scene);
        let expected = lines(&scene);
        let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
        let (turned, its_camera) = moved(&mesh, &camera, turn, 1e3, DVec3::new(10.0, 20.0, -30.0));
        assert_same_sums(&expected, &lines(&seen(&turned, &its_camera)), 1e-4, file);
        let order = shuffled(&mesh, &mut Random(3));
        assert_same_sums(&expected, &lines(&seen(&order, &view("33,17", false))), 1e-6, file);
    }
}
