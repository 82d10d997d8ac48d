//! Pictures drawn without the faces that a view cannot show: equal byte for byte to those drawn with all.

use crate::support::{BACKENDS, public_models, renderer, skip};
use std::sync::Arc;
use tinta::hiding::{DrawnFaces, Hiding};
use tinta::mesh::VertexArrays;
use tinta::{CameraSettings, LoadOptions, Mesh, Renderer, Scene, SceneSettings, Size, Style, StyleName, View, load};

const SIZE: Size = Size { width: 480, height: 360 };

/// A GL that places vertices to 1/256 of a pixel, as Mesa does.
const SUBPIXEL_BITS: u32 = 8;

/// The mesh with its drawn faces only; its positions stay, and with them camera and drawing order.
fn reduced(mesh: &Mesh, arrays: &VertexArrays, drawn: &DrawnFaces) -> Mesh {
    let mut is_drawn = vec![false; mesh.triangles.len()];
    let mut next = drawn.indices.chunks_exact(3).peekable();
    for (triangle, corners) in arrays.order.iter().zip(arrays.indices.chunks_exact(3)) {
        is_drawn[*triangle as usize] = next.next_if_eq(&corners).is_some();
    }
    assert_eq!(next.next(), None);
    let mut reduced = mesh.clone();
    keep(&mut reduced.triangles, &is_drawn);
    keep(&mut reduced.triangle_normals, &is_drawn);
    keep(&mut reduced.triangle_texture_coordinates, &is_drawn);
    keep(&mut reduced.triangle_materials, &is_drawn);
    reduced
}

fn keep<T>(list: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    list.retain(|_| *kept.next().unwrap_or(&false));
}

/// Draws a model from several sides with all faces and without those left out; returns how many of all faces these were.
fn share_left_out(renderer: &mut Renderer, model: &str, views: u32) -> f64 {
    let mesh = Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
    let mut hiding = None;
    let mut left_out = 0;
    for number in 0..views {
        let turn = f64::from(number);
        let view = View { azimuth_degrees: turn * 137.5 + 20.0, elevation_degrees: 60.0 * (turn * 1.7).sin() };
        let camera = CameraSettings { view, parallel: number % 3 == 1, ..CameraSettings::default() };
        let settings = SceneSettings { camera, size: SIZE, ..SceneSettings::default() };
        let scene = Scene::new(vec![mesh.clone()], &settings).unwrap();
        let object = &scene.objects[0];
        let arrays = scene.arrays(object);
        let hiding = hiding.get_or_insert_with(|| Hiding::new(&mesh, arrays));
        let Some(drawn) = hiding.faces_to_draw(&scene.view_of(object), SIZE, SUBPIXEL_BITS) else { continue };
        left_out += drawn.left_out;
        let fewer = Scene::new(vec![Arc::new(reduced(&mesh, arrays, &drawn))], &settings).unwrap();
        assert_eq!(scene.camera, fewer.camera);
        for name in [StyleName::ThreePass, StyleName::Phong, StyleName::Ink] {
            let style = Style::named(name);
            let [all, some] = [&scene, &fewer].map(|scene| renderer.render(scene, &style).unwrap());
            let different = all.pixels.chunks(4).zip(some.pixels.chunks(4)).filter(|(a, b)| a != b).count();
            assert_eq!(different, 0, "{model} {view:?} {name:?}: so many pixels differ");
        }
    }
    left_out as f64 / (mesh.triangles.len() * views as usize) as f64
}

#[test]
fn built_in_models_without_the_faces_left_out_give_the_same_pictures() {
    let mut renderer = renderer(BACKENDS[0]);
    for model in ["builtin:bust", "builtin:ant"] {
        let share = share_left_out(&mut renderer, model, 4);
        assert!(share > 0.02, "{model}: {share}");
    }
}

#[test]
fn public_models_without_the_faces_left_out_give_the_same_pictures() {
    let Some(folder) = public_models() else { return };
    let mut renderer = renderer(BACKENDS[0]);
    for (file, least_share) in [("cow.obj", 0.1), ("fandisk.obj", 0.25), ("stanford-bunny.obj", 0.2)] {
        let path = folder.join(file);
        if !path.is_file() {
            skip(&format!("{file}: not in {}", folder.display()));
            continue;
        }
        let share = share_left_out(&mut renderer, path.to_str().unwrap(), 4);
        assert!(share > least_share, "{file}: {share}");
    }
}
