//! What the integration tests share: scenes, renderers, and comparing pictures so that a failure can be looked at.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::{Backend, LoadOptions, Picture, Renderer, Scene, SceneSettings, Size, Style, StyleName, load};

/// Both ways to a context; each must work wherever the tests run.
pub const BACKENDS: [Backend; 2] = [Backend::Egl, Backend::OsMesa];

/// The project's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Says that a test checks less than it could; written past the test harness, which would keep it to itself.
pub fn skip(what: &str) {
    let _ = writeln!(std::io::stderr(), "SKIPPED {what}");
}

/// The folder of public models that tests try where they have it: `TINTA_MODELS`, by default `../shared/models`.
pub fn public_models() -> Option<PathBuf> {
    let folder = std::env::var_os("TINTA_MODELS").map_or_else(|| root().join("../shared/models"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    skip(&format!("public models: none in {}; set TINTA_MODELS to a folder that has them", folder.display()));
    None
}

/// A renderer; without one the test fails with the program's own sentence.
pub fn renderer(backend: Backend) -> Renderer {
    Renderer::new(backend).unwrap_or_else(|error| panic!("{backend:?}: {error}"))
}

/// One built-in model, at a small size.
pub fn scene(model: &str, width: u32, height: u32) -> Scene {
    scene_with(model, SceneSettings { size: Size { width, height }, ..SceneSettings::default() })
}

/// One built-in model with these settings.
pub fn scene_with(model: &str, settings: SceneSettings) -> Scene {
    let mesh = load(model, &LoadOptions::default()).unwrap().mesh;
    Scene::new(vec![Arc::new(mesh)], &settings).unwrap()
}

/// Every style with the papers' settings that can draw any model; sand cannot: it needs a model with a texture.
pub fn styles() -> Vec<(&'static str, Style)> {
    let of_any_model = StyleName::ALL.iter().filter(|(_, style)| *style != StyleName::Sand);
    of_any_model.map(|(name, style)| (*name, Style::named(*style))).collect()
}

/// Where pictures of failed comparisons go.
pub fn failure_folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("failures");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Expected, difference (amplified) and actual side by side.
pub fn side_by_side(expected: &Picture, actual: &Picture) -> Picture {
    let Size { width, height } = expected.size;
    let size = Size { width: width * 3, height };
    let mut pixels = Vec::new();
    for y in 0..i64::from(height) {
        let row = |picture: &Picture| (0..i64::from(width)).map(|x| picture.pixel(x, y)).collect::<Vec<_>>();
        let (left, right) = (row(expected), row(actual));
        let middle = left.iter().zip(&right).map(|(a, b)| {
            let difference = |channel: usize| a[channel].abs_diff(b[channel]).saturating_mul(8);
            [255 - difference(0), 255 - difference(1), 255 - difference(2), 255]
        });
        pixels.extend(left.iter().copied().chain(middle).chain(right.iter().copied()).flatten());
    }
    Picture { size, pixels }
}
