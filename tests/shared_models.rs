//! Public models, where they lie beside the checkout; said aloud where they do not.
//!
//! `TINTA_MODELS` names their folder, by default `../shared/models`.

use crate::support::{BACKENDS, public_models, renderer, skip, styles};
use std::sync::Arc;
use tinta::{LoadOptions, Scene, SceneSettings, Size, load};

/// File and triangles in it.
const MODELS: [(&str, usize); 8] = [
    ("ant.ply", 912),
    ("beethoven.obj", 20_884),
    ("cow.obj", 5_804),
    ("fandisk.obj", 12_946),
    ("spot/spot_triangulated.obj", 5_856),
    ("stanford-bunny.obj", 69_451),
    ("suzanne.obj", 968),
    ("teapot.obj", 6_320),
];

#[test]
fn public_models_have_the_triangles_their_authors_say_and_are_drawn_in_every_style() {
    let Some(folder) = public_models() else { return };
    let mut renderer = renderer(BACKENDS[0]);
    for (file, triangles) in MODELS {
        let path = folder.join(file);
        if !path.is_file() {
            skip(&format!("{file}: not in {}", folder.display()));
            continue;
        }
        let mesh = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
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
