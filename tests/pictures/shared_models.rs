//! Public models beside the checkout; without them the test prints that it is skipped.
//!
//! `TINTA_MODELS` names their folder, by default `../shared/models`.

use crate::support::{BACKENDS, public_model, renderer, styles};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;
use tinta::mesh::{BUILTINS, ModelFrame, UpAxis};
use tinta::{LoadOptions, Mesh, Picture, Scene, SceneSettings, Size, load};

/// File and triangles in it.
const MODELS: [(&str, usize); 9] = [
    ("ant.ply", 912),
    ("beethoven.obj", 20_884),
    ("cow.obj", 5_804),
    ("faerie.md2", 654),
    ("fandisk.obj", 12_946),
    ("spot/spot_triangulated.obj", 5_856),
    ("stanford-bunny.obj", 69_451),
    ("suzanne.obj", 968),
    ("teapot.obj", 6_320),
];

#[test]
fn public_models_have_the_triangles_their_authors_say_and_are_drawn_in_every_style() {
    let mut renderer = renderer(BACKENDS[0]);
    for (file, triangles) in MODELS {
        let Some(path) = public_model(file) else { continue };
        let mesh = load(&path, &LoadOptions::default()).unwrap().mesh;
        assert_eq!(mesh.triangles.len() + mesh.defects.degenerate_triangles, triangles, "{file}");
        assert!(mesh.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5), "{file}");
        let settings = SceneSettings { size: Size { width: 96, height: 96 }, ..SceneSettings::default() };
        let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
        for (name, style) in styles() {
            let picture = renderer.render(&scene, &style).unwrap_or_else(|error| panic!("{file} {name}: {error}"));
            let drawn = picture.pixels.chunks_exact(4).filter(|pixel| pixel[..3] != [255; 3]).count();
            assert!(drawn > 500, "{file} {name}: {drawn} pixels are not background");
        }
    }
}

/// The volume that a mesh encloses, negative if it is inside out, in cubic file units.
fn volume(mesh: &Mesh) -> f64 {
    let middle = mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64;
    let from_middle = |index: u32| mesh.positions[index as usize] - middle;
    mesh.triangles.iter().map(|corners| corners.map(from_middle)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn at_frame(path: &str, model_frame: ModelFrame) -> Mesh {
    load(path, &LoadOptions { model_frame, ..LoadOptions::default() }).unwrap().mesh
}

#[test]
fn the_faerie_has_her_frames_and_her_skin_and_is_not_inside_out() {
    let Some(path) = public_model("faerie.md2") else { return };
    let loaded = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(loaded.frames.len(), 198);
    assert_eq!((loaded.frames[0].as_str(), loaded.frames[197].as_str()), ("stand01", "death308"));
    assert!(loaded.mesh.triangle_texture_coordinates.len() == loaded.mesh.triangles.len());
    assert!(loaded.mesh.texture_coordinates.iter().all(|at| at.min_element() >= 0.0 && at.max_element() <= 1.0));
    let skin = loaded.mesh.materials[0].texture.clone().unwrap();
    assert_eq!(skin, Path::new(&path).with_file_name("faerie.bmp"));
    assert_eq!(Picture::read(&skin).unwrap().size, Size { width: 220, height: 193 });
    for number in 0..loaded.frames.len() {
        let mesh = at_frame(&path, ModelFrame::Number(number as f64));
        assert!(volume(&mesh) > 0.0, "frame {number}");
    }
    let (low, high) = loaded.mesh.bounds();
    let extent = high - low;
    assert!(extent.y > extent.x && extent.y > extent.z, "she stands: {extent}");
}

#[test]
fn between_two_frames_the_faerie_is_between_them() {
    let Some(path) = public_model("faerie.md2") else { return };
    let by_name = at_frame(&path, ModelFrame::Name("run1".to_owned()));
    let number = load(&path, &LoadOptions::default()).unwrap().frames.iter().position(|name| name == "run1").unwrap();
    let frame = |share: f64| at_frame(&path, ModelFrame::Number(number as f64 + share));
    assert_eq!(by_name, frame(0.0));
    let place = |mesh: &Mesh, vertex: u32| {
        let index = mesh.file_vertices.iter().position(|file_vertex| *file_vertex == vertex)?;
        Some(mesh.positions[index])
    };
    let (first, middle, second) = (frame(0.0), frame(0.5), frame(1.0));
    let mut compared = 0;
    for vertex in 0..366 {
        if let (Some(a), Some(b), Some(c)) = (place(&first, vertex), place(&middle, vertex), place(&second, vertex)) {
            assert!(b.distance((a + c) / 2.0) < 1e-4, "vertex {vertex}: {a} {b} {c}");
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn a_faerie_cut_off_anywhere_is_refused_in_a_sentence() {
    let Some(path) = public_model("faerie.md2") else { return };
    let whole = std::fs::read(&path).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let cut = folder.path().join("cut.md2");
    for part in 0..500 {
        // From one byte to one too few, with every length of the header on the way.
        let length = if part < 100 { part } else { (whole.len() - 1) * (part - 99) / 400 };
        std::fs::write(&cut, &whole[..length]).unwrap();
        let message = load(cut.to_str().unwrap(), &LoadOptions::default()).unwrap_err().to_string();
        assert!(message.contains("cut.md2: ") && message.lines().count() == 1, "{length}: {message}");
    }
}

#[test]
fn of_the_models_only_the_one_that_lies_gets_the_hint() {
    for (name, lies) in [
        ("beethoven.obj", true),
        ("ant.ply", false),
        ("cow.obj", false),
        ("fandisk.obj", false),
        ("spot/spot_triangulated.obj", false),
        ("stanford-bunny.obj", false),
        ("suzanne.obj", false),
        ("teapot.obj", false),
    ] {
        let Some(path) = public_model(name) else { continue };
        let hints = |up_axis| {
            let loaded = load(&path, &LoadOptions { up_axis, ..LoadOptions::default() }).unwrap();
            loaded.remarks.iter().filter(|remark| remark.contains("--up-axis z")).count()
        };
        assert_eq!(hints(UpAxis::Auto), usize::from(lies), "{name}");
        assert_eq!((hints(UpAxis::Z), hints(UpAxis::Y)), (0, 0), "{name}: who names an axis knows it");
    }
    // Upright in files with y up, all of them lie in an STL, which is read with z up; unturned, they are parts with several ends.
    let folder = tempfile::tempdir().unwrap();
    let stl = folder.path().join("model.stl");
    for (name, lies) in [
        ("ant.ply", true),
        ("cow.obj", true),
        ("doll.obj", true),
        ("spot/spot_triangulated.obj", true),
        ("stanford-bunny.obj", true),
        // Lower than half its width.
        ("teapot.obj", false),
        ("fandisk.obj", false),
        ("parts/bolt.stl", false),
        ("parts/bracket.stl", false),
        ("parts/flange.stl", false),
        ("parts/rounded.stl", false),
        ("parts/tee.stl", false),
    ] {
        let Some(path) = public_model(name) else { continue };
        let mesh = load(&path, &LoadOptions { up_axis: UpAxis::Y, ..LoadOptions::default() }).unwrap().mesh;
        std::fs::write(&stl, text_stl(&mesh)).unwrap();
        let remarks = load(stl.to_str().unwrap(), &LoadOptions::default()).unwrap().remarks;
        assert_eq!(remarks.iter().any(|remark| remark.contains("--up-axis y")), lies, "{name}: {remarks:?}");
    }
    for builtin in BUILTINS {
        let loaded = load(&format!("builtin:{}", builtin.name), &LoadOptions::default()).unwrap();
        assert!(loaded.remarks.is_empty(), "{}", builtin.name);
    }
}

/// A mesh as a text STL, its coordinates unchanged.
fn text_stl(mesh: &Mesh) -> String {
    let mut text = "solid a\n".to_owned();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|index| mesh.positions[index as usize]);
        let corners = corners.map(|corner| format!("vertex {} {} {}\n", corner.x, corner.y, corner.z)).concat();
        text += &format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n");
    }
    text + "endsolid a\n"
}
