//! Visible lines of degenerate scenes: no panic, no NaN, no endless work.

use crate::support::lines::{lines, lines_with, only, scene_of, total, view};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use glam::DVec3;
use std::sync::Arc;
use tinta::edges::{Class, ClassSet};
use tinta::lines::{LineSettings, VisibleLines};
use tinta::{CameraSettings, Mesh, Scene, SceneSettings};

fn vec3(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

#[test]
fn a_triangle_seen_edge_on_is_the_lines_that_are_left_of_it() {
    let found = lines(&scene_of(vec![Mesh::triangle()], view("right", true)));
    assert!(found.segments.len() <= 2 && found.segments.iter().all(|segment| segment.class == Class::Boundary));
    assert!(total(&found, true) > 100.0);
    for (name, parallel) in [("top", false), ("right", false), ("90,45", true), ("0,90", true)] {
        lines(&scene_of(vec![Mesh::triangle()], view(name, parallel)));
    }
}

#[test]
fn no_class_wanted_is_refused_in_a_sentence() {
    let scene = scene_of(vec![Mesh::triangle()], view("front", false));
    let settings = LineSettings { classes: ClassSet::default(), ..LineSettings::default() };
    assert!(VisibleLines::of(&scene, &settings).unwrap_err().to_string().contains("classes"));
}

fn check_same_face(times: usize) {
    let all = mesh(Mesh::triangle().positions, vec![[0, 1, 2]; times]);
    assert_eq!(lines(&scene_of(vec![all], view("30,15", false))).segments.len(), 3);
}

#[test]
fn a_thousand_times_the_same_face_is_one() {
    check_same_face(1000);
}

#[test]
#[ignore = "exhaustive: 100,000 faces on one another take a minute"]
fn a_hundred_thousand_times_the_same_face_is_one() {
    check_same_face(100_000);
}

#[test]
fn a_book_of_many_pages_has_one_spine() {
    let pages = 1000;
    let page = |i: u32| vec3((f64::from(i) * 0.001).cos(), 0.5, (f64::from(i) * 0.001).sin());
    let positions = [DVec3::ZERO, DVec3::Y].into_iter().chain((0..pages).map(page)).collect();
    let found =
        lines(&scene_of(vec![mesh(positions, (0..pages).map(|i| [0, 1, i + 2]).collect())], view("30,15", false)));
    assert_eq!((found.edges.non_manifold, found.edges.boundary), (1, 2 * pages as usize));
}

#[test]
fn hundreds_of_faces_in_one_plane_hide_nothing_of_one_another() {
    let mut random = Random(17);
    let count = 150;
    let corner = |random: &mut Random| vec3(random.number(), random.number(), 0.25);
    let positions = (0..3 * count).map(|_| corner(&mut random)).collect();
    let flat = mesh(positions, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
    let found = lines(&scene_of(vec![flat], view("20,10", false)));
    assert_eq!(total(&found, false), 0.0);
    assert_eq!(found.edges.intersection, 0);
}

#[test]
fn needles_have_lines_like_anything_else() {
    let mut random = Random(23);
    for thickness in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0] {
        let mut positions = Vec::new();
        for _ in 0..60 {
            let (a, along) = (random.direction(), random.direction());
            positions.extend([a, a + along, a + along * 0.5 + random.direction() * thickness]);
        }
        let needles = mesh(positions, (0..60).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
        for parallel in [false, true] {
            let found = lines(&scene_of(vec![needles.clone(), icosphere(1)], view("30,15", parallel)));
            assert!(total(&found, true) > 1000.0, "{thickness}");
        }
    }
}

#[test]
fn an_eye_in_the_plane_of_a_face_or_on_the_line_of_an_edge_sees_lines_all_the_same() {
    let solid = joined(&[cuboid(DVec3::ZERO, DVec3::ONE), cuboid(vec3(2.0, 0.0, 0.0), vec3(3.0, 2.0, 1.0))]);
    for eye in [
        vec3(0.5, 1.0, 6.0),
        vec3(1.0, 1.0, 6.0),
        vec3(-5.0, 0.0, 1.0),
        vec3(0.5, 0.5, 0.5),
        vec3(1.0, 1.0, 1.0),
        vec3(1.0, 0.5, 0.5),
    ] {
        for target in [vec3(1.5, 1.0, 0.5), DVec3::ZERO, vec3(2.0, 2.0, 0.0)] {
            let camera = CameraSettings {
                eye: Some(eye),
                target: Some(target),
                near: Some(1e-3),
                far: Some(30.0),
                ..CameraSettings::default()
            };
            let settings = SceneSettings { camera, ..SceneSettings::default() };
            // Straight up or down, or zero distance: refused by the camera.
            let Ok(scene) = Scene::new(vec![Arc::new(solid.clone())], &settings) else { continue };
            lines(&scene);
        }
    }
}

fn check_boxes_in_boxes(count: i32, factors: &[f64]) {
    for &factor in factors {
        for parallel in [false, true] {
            let boxes: Vec<Mesh> = (0..count)
                .map(|i| {
                    let size = factor.powi(i);
                    cuboid(DVec3::splat(-size), vec3(size, size * 0.5, size * 0.75))
                })
                .collect();
            let found = lines(&scene_of(vec![joined(&boxes)], view("iso", parallel)));
            // Nine edges of the outermost; inside it everything except points is hidden.
            assert_eq!(found.segments.iter().filter(|segment| segment.is_visible).count(), 9, "{factor} {parallel}");
        }
    }
}

#[test]
fn two_hundred_boxes_in_boxes_each_twice_as_large_are_done_soon() {
    check_boxes_in_boxes(200, &[2.0]);
}

#[test]
#[ignore = "exhaustive: 200 boxes with thousands of lines"]
fn two_hundred_boxes_in_boxes_each_half_as_large_again_are_done_soon() {
    check_boxes_in_boxes(200, &[1.5]);
}

#[test]
fn sizes_at_the_ends_of_what_is_drawn_have_lines() {
    for scale in [1e-59, 1e-20, 1e20, 1e58] {
        let scaled = |mesh: Mesh| Mesh { positions: mesh.positions.iter().map(|p| *p * scale).collect(), ..mesh };
        for parallel in [false, true] {
            let meshes =
                vec![scaled(cuboid(DVec3::ZERO, DVec3::ONE)), scaled(cuboid(DVec3::splat(0.5), vec3(1.5, 0.8, 1.2)))];
            let found = lines(&scene_of(meshes, view("iso", parallel)));
            let reference = lines(&scene_of(
                vec![cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::splat(0.5), vec3(1.5, 0.8, 1.2))],
                view("iso", parallel),
            ));
            let (a, b) = (total(&found, true), total(&reference, true));
            assert!((a - b).abs() < 1e-6 * b, "{scale:e} parallel {parallel}: {a} px instead of {b}");
        }
    }
}

#[test]
fn a_face_without_area_beside_real_ones_does_no_harm() {
    let mut sphere = icosphere(2);
    let all = sphere.positions.len() as u32;
    sphere.positions.extend([DVec3::X, DVec3::X, DVec3::X, DVec3::ZERO, DVec3::X, DVec3::X * 0.5]);
    sphere.file_vertices.extend(all..all + 6);
    sphere.triangles.extend([[all, all + 1, all + 2], [all + 3, all + 4, all + 5]]);
    for class in [Class::Silhouette, Class::Intersection, Class::Boundary] {
        lines_with(&scene_of(vec![sphere.clone()], view("30,15", false)), &only(&[class]));
    }
}
