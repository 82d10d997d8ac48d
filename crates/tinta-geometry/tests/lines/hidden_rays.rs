//! Tests hidden lines with rays: something lies in front of each point of a hidden segment, and nothing in front of a
//! visible one. Every point of a line belongs to exactly one segment.
//!
//! The rays run in f64 and world space, each against every face, with no formula of the library.

use crate::rays::{Creases, RayFindings, Rays};
use crate::same::difference;
use crate::support::families::{KINDS, scene_of_kind};
use crate::support::growth::FAMILIES;
use crate::support::lines::{
    assert_near, length, lines, lines_with, of_class, px_between, scene_of, scene_of_family, scenes_wanted, view,
};
use crate::support::random_scenes::random_scene;
use crate::support::shapes::{Random, mesh};
use crate::support::{builtin, public_meshes};
use glam::DVec3;
use std::sync::Arc;
use tinta::edges::Class;
use tinta::lines::LineSettings;
use tinta::{Mesh, Scene};

/// Checks a scene and notes its faults.
fn note(name: &str, scene: &Scene, creases: Creases, random: &mut Random, all: &mut RayFindings) {
    let found = Rays::new(scene, creases).check(random);
    let first = |wrong: &String| format!("{name}, {creases:?}: {} wrong, the first: {wrong}", found.wrong.len());
    all.wrong.extend(found.wrong.first().map(first));
    all.add(&found);
}

/// Asserts that no scene has a fault, that hidden and visible points were both tested, and that few remained undecided.
fn judge(mut all: RayFindings, scenes: usize) {
    println!("{} of {scenes} scenes fail; {}", all.wrong.len(), all.summary());
    let failed = all.wrong.len();
    all.wrong.truncate(40);
    assert!(all.wrong.is_empty(), "{failed} of {scenes} scenes fail: {:#?}", all.wrong);
    assert!(all.hidden > 50 * scenes && all.visible > 50 * scenes, "{}", all.summary());
    assert!(all.unclear * 20 < all.hidden + all.visible, "{}", all.summary());
    assert!(all.edges > 10 * scenes && all.exempt * 5 < all.edges, "{}", all.summary());
}

/// Checks the scenes of seeds 1 to `count`, each kind with both limits of creases.
fn check(count: u64) {
    let mut all = RayFindings::default();
    for seed in 1..=count {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        let creases = [Creases::Drawn, Creases::Published][seed as usize / KINDS % 2];
        note(&format!("{name}, seed {seed}"), &scene, creases, &mut random, &mut all);
    }
    judge(all, count as usize);
}

/// The scene pressed together along an axis, its eye beside it as before.
fn squeezed(mut scene: Scene, axis: usize, times: f64) -> Scene {
    let mut factor = DVec3::ONE;
    factor[axis] = times.recip();
    let moved = scene.centre * factor - scene.centre;
    for object in &mut scene.objects {
        let positions = object.mesh.positions.iter().map(|point| point * factor).collect();
        *object = object.with_mesh(Arc::new(Mesh { positions, ..Mesh::clone(&object.mesh) }));
        object.offset *= factor;
    }
    (scene.camera.eye, scene.camera.target) = (scene.camera.eye + moved, scene.camera.target + moved);
    scene
}

#[test]
#[ignore = "counts: exactness.md says how many of 2,000 scenes squeezed by TINTA_SQUEEZE are wrong, 10,000 by default"]
fn of_scenes_squeezed_along_an_axis_some_are_wrong() {
    let times = std::env::var("TINTA_SQUEEZE").map_or(10_000.0, |times| times.parse().expect("a number"));
    let (count, mut all) = (scenes_wanted().unwrap_or(2000), RayFindings::default());
    for seed in 1..=count {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        let scene = squeezed(scene, seed as usize % 3, times);
        let found = Rays::of_thin(&scene, Creases::Drawn).check(&mut random);
        if let Some(first) = found.wrong.first() {
            println!("{name}, seed {seed}, axis {}: {} wrong, the first: {first}", seed % 3, found.wrong.len());
            all.wrong.push(name);
        }
        all.add(&found);
    }
    println!("{} of {count} scenes are wrong; {}", all.wrong.len(), all.summary());
    let most = if times > 1000.0 { 486 } else { 62 };
    assert!(all.wrong.len() as u64 * 2000 <= most * count, "more than the {most} of 2,000 that the document names");
}

#[test]
fn something_lies_in_front_of_hidden_lines_and_nothing_in_front_of_visible_ones_briefly() {
    check(scenes_wanted().unwrap_or(40 * KINDS as u64));
}

#[test]
#[ignore = "exhaustive: 2,000 scenes, or as many as TINTA_LINE_SCENES says"]
fn something_lies_in_front_of_hidden_lines_of_many_scenes_and_nothing_in_front_of_visible_ones() {
    check(scenes_wanted().unwrap_or(2000));
}

#[test]
fn of_every_family_what_rays_see_is_drawn() {
    let (mut all, mut random) = (RayFindings::default(), Random::seeded(26));
    // In `twins`, a part of an edge lies so close to another's face for so long that it touches it, and is hidden with the parts
    // behind.
    for family in FAMILIES.iter().filter(|family| family.name != "twins") {
        for creases in [Creases::Drawn, Creases::Published] {
            note(family.name, &scene_of_family(family, 200), creases, &mut random, &mut all);
        }
    }
    judge(all, 2 * (FAMILIES.len() - 1));
}

#[test]
fn lines_that_cannot_be_told_apart_in_the_picture_are_drawn_once() {
    // Two of 20,000 random scenes have cuts that close to one another.
    let mut all = RayFindings::default();
    for seed in [287_756_342_340_050_861, 7_113_230_251_776_330_223] {
        let mut random = Random::seeded(seed);
        let scene = random_scene(3, &mut random);
        note(&format!("seed {seed}"), &scene, Creases::Published, &mut random, &mut all);
    }
    judge(all, 2);
}

const ALL_VIEWS: [&str; 6] = ["front", "back", "left", "right", "top", "bottom"];

fn check_models<'a>(models: impl IntoIterator<Item = (&'a str, Mesh)>, views: &[&str]) {
    let (mut all, mut scenes) = (RayFindings::default(), 0);
    for (name, mesh) in models {
        for (number, at) in views.iter().enumerate() {
            for parallel in [true, false] {
                let scene = scene_of(vec![mesh.clone()], view(at, parallel));
                let creases = [Creases::Published, Creases::Drawn][(number + usize::from(parallel)) % 2];
                note(&format!("{name} from {at}, parallel {parallel}"), &scene, creases, &mut Random(7), &mut all);
                scenes += 1;
            }
        }
    }
    if scenes > 0 {
        judge(all, scenes);
    }
}

#[test]
fn what_rays_see_of_a_box_and_a_gear_is_drawn_briefly() {
    check_models(["open-box", "gear"].map(|name| (name, builtin(name))), &ALL_VIEWS);
}

#[test]
#[ignore = "exhaustive: four models in eight views"]
fn what_rays_see_of_the_models_that_ship_is_drawn() {
    let views = [&ALL_VIEWS[..], &["33,17", "30,15"]].concat();
    check_models(["open-box", "gear", "ant", "bust"].map(|name| (name, builtin(name))), &views);
}

#[test]
#[ignore = "exhaustive: six public models in six views"]
fn what_rays_see_of_public_models_in_the_named_views_is_drawn() {
    let files = ["fandisk.obj", "cow.obj", "suzanne.obj", "teapot.obj", "ant.ply", "spot/spot_triangulated.obj"];
    check_models(public_meshes(&files), &ALL_VIEWS);
}

#[test]
fn where_hidden_lines_are_left_out_the_visible_ones_are_the_same() {
    let settings = LineSettings { finds_hidden: false, ..LineSettings::default() };
    for seed in 1..=20 * KINDS as u64 {
        let (name, scene) = scene_of_kind(seed as usize, &mut Random::seeded(seed));
        let difference = difference(&lines(&scene), &lines_with(&scene, &settings), false);
        assert_eq!(difference, None, "{name}, seed {seed}");
    }
}

#[test]
fn an_intersection_that_begins_in_a_corner_is_hidden_from_there_on() {
    // Three faces share a corner: a floor, a wall that reaches slightly through it, and a lid that rises from the
    // floor at 0.03 degrees. By distance alone, the lid would touch the first fiftieth of the line. The rim of a
    // small face above crosses all of it.
    let floor = [[2.0, 0.0, -1.0], [2.0, 0.0, 1.0]];
    let wall = [[2.0, -1.0, 0.0], [2.0, 4e-4, 0.0]];
    let lid = [[3.0, 1.5e-3, -2.0], [3.0, 1.5e-3, 2.0]];
    let small = [[0.02, 1e-3, -0.05], [0.02, 1e-3, 0.05], [0.5, 1e-3, 0.0]];
    let corners = [floor, wall, lid].concat().into_iter().chain(small).map(DVec3::from);
    let positions = [DVec3::ZERO].into_iter().chain(corners).collect();
    let model = mesh(positions, vec![[0, 1, 2], [0, 3, 4], [0, 5, 6], [7, 8, 9]]);
    for name in ["30,60", "90,70", "-45,80"] {
        for parallel in [true, false] {
            let found = lines(&scene_of(vec![model.clone()], view(name, parallel)));
            let [visible, hidden] = [true, false].map(|is_visible| of_class(&found, Class::Intersection, is_visible));
            assert!(
                visible == 0.0 && hidden > 100.0,
                "{name}, parallel {parallel}: {visible} px visible, {hidden} hidden"
            );
        }
    }
}

#[test]
fn a_face_touches_what_lies_a_hundred_thousandth_of_a_long_line_behind_it() {
    // A tenth of the thickness of a model 300 long and 0.03 thick: the limit that docs/guide/lines.md states. A
    // narrow sheet lies below a wide one and is seen from above.
    let sheet = |width: f64, y: f64| {
        let corners = [[-150.0, y, -width], [150.0, y, -width], [150.0, y, width], [-150.0, y, width]];
        mesh(corners.map(DVec3::from).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
    };
    for (depth, long_edges) in [(0.0029, 2.0), (0.0031, 0.0)] {
        let scene = scene_of(vec![sheet(30.0, 0.0), sheet(20.0, -depth)], view("top", true));
        let found = lines(&scene);
        let of_lower = |is_visible: bool| -> f64 {
            let pieces = found.segments.iter().filter(|piece| piece.object == 1 && piece.is_visible == is_visible);
            pieces.map(length).sum::<f64>() / px_between(&scene, DVec3::ZERO, DVec3::X)
        };
        assert_near(of_lower(true), 300.0 * long_edges, 1e-6, "seen, though behind");
        assert_near(of_lower(false), 680.0 - 300.0 * long_edges, 1e-6, "hidden");
    }
}
