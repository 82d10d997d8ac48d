//! Shared parts of the integration tests: scenes, renderers, and comparisons that leave pictures for inspection.

pub mod charcoal;
pub mod gltf_files;
pub mod goldens;

// What tests of tinta-geometry share with these.
#[path = "../../crates/tinta-geometry/tests/support/drawn.rs"]
pub mod drawn;
#[path = "../../crates/tinta-geometry/tests/support/families.rs"]
pub mod families;
#[path = "../../crates/tinta-geometry/tests/support/growth.rs"]
pub mod growth;
#[path = "../../crates/tinta-geometry/tests/support/lines.rs"]
pub mod lines;
#[path = "../../crates/tinta-geometry/tests/support/places.rs"]
pub mod places;
#[path = "../../crates/tinta-geometry/tests/support/random_scenes.rs"]
pub mod random_scenes;
#[path = "../../crates/tinta-geometry/tests/support/shapes.rs"]
pub mod shapes;

pub use places::*;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};
use tinta::gl::context::witnesses;
use tinta::{Backend, LoadOptions, Picture, Renderer, Scene, SceneSettings, Size, Style, StyleName, load};

/// Two backends, for pictures drawn twice; both must work wherever the tests run: EGL, and OSMesa or, where Mesa lacks it, EGL's
/// surfaceless platform. A message names them.
pub static BACKENDS: LazyLock<[Backend; 2]> = LazyLock::new(|| {
    let both = witnesses();
    let _ = writeln!(std::io::stderr(), "DRAWN by {} and {}", both[0], both[1]);
    both
});

/// Their names.
pub fn backend_names() -> [&'static str; 2] {
    BACKENDS.map(|backend| Backend::ALL.iter().find(|(_, known)| *known == backend).unwrap().0)
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

/// A sphere of 20 * 4^cuts triangles, an icosahedron cut again and again.
pub fn ball(cuts: u32) -> Scene {
    let settings = SceneSettings { size: Size { width: 256, height: 256 }, ..SceneSettings::default() };
    Scene::new([shapes::shaded(&shapes::icosphere(cuts))], &settings).unwrap()
}

/// Every style with the published settings that can draw any model; sand cannot: it needs a model with a texture.
/// Clones share charcoal's textures, which are then made once for all tests.
pub fn styles() -> Vec<(&'static str, Style)> {
    static STYLES: LazyLock<Vec<(&str, Style)>> = LazyLock::new(|| {
        let of_any_model = StyleName::of_passes().filter(|(_, style)| *style != StyleName::Sand);
        of_any_model.map(|(name, style)| (name, Style::named(style))).collect()
    });
    STYLES.clone()
}

/// The pictures that an animated GIF shows one after another.
pub fn frames_of_gif(path: &str) -> Vec<image::Frame> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(std::fs::File::open(path).unwrap()).unwrap();
    let mut screen = image::RgbaImage::new(decoder.width().into(), decoder.height().into());
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let before = screen.clone();
        let (left, top) = (u32::from(frame.left), u32::from(frame.top));
        let pixels = frame.buffer.to_vec();
        let part = image::RgbaImage::from_raw(frame.width.into(), frame.height.into(), pixels).unwrap();
        for (x, y, pixel) in part.enumerate_pixels().filter(|(.., pixel)| pixel.0[3] > 0) {
            screen.put_pixel(left + x, top + y, *pixel);
        }
        let delay = image::Delay::from_numer_denom_ms(u32::from(frame.delay) * 10, 1);
        frames.push(image::Frame::from_parts(screen.clone(), 0, 0, delay));
        match frame.dispose {
            gif::DisposalMethod::Any | gif::DisposalMethod::Keep => {}
            gif::DisposalMethod::Previous => screen = before,
            gif::DisposalMethod::Background => {
                part.enumerate_pixels().for_each(|(x, y, _)| screen.put_pixel(left + x, top + y, image::Rgba([0; 4])));
            }
        }
    }
    frames
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

/// Whether tests draw as much as they can: the variable `TINTA_FULL_SIZES` is set.
pub fn full_sizes() -> bool {
    std::env::var_os("TINTA_FULL_SIZES").is_some()
}

/// A scene of one mesh, as by default.
pub fn scene_of_mesh(mesh: tinta::Mesh) -> Scene {
    Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap()
}

/// A square with a picture on it, which sand needs.
pub fn textured(folder: &Folder) -> String {
    let picture =
        tinta::Picture { size: tinta::Size { width: 2, height: 2 }, pixels: [[200, 90, 40, 255]; 4].concat() };
    tinta::Target::check(&folder.path("skin.png"), false).unwrap().write(&picture).unwrap();
    folder.file("square.mtl", b"newmtl a\nKd 0.2 0.9 0.3\nmap_Kd skin.png\n");
    let square = b"mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        usemtl a\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    folder.file("square.obj", square)
}
