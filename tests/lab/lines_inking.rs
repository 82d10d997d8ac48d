//! The exact lines, written as SVG and drawn by an independent rasteriser, against the same edges drawn by GL.

use crate::rendered::rendered;
use crate::support::families::FAMILIES;
use crate::support::shapes::{Random, shaded};
use crate::support::{BACKENDS, PUBLIC_MODELS, failure_folder, public_model, renderer};
use std::sync::Arc;
use tinta::camera::{CameraSettings, View};
use tinta::edges::{Class, ClassSet, SilhouetteRule};
use tinta::lines::closed_forms::ClosedForm;
use tinta::lines::{Length, svg};
use tinta::styles::{Inking, PaintMode};
use tinta::{
    DrawingSettings, LineSettings, LoadOptions, Picture, Renderer, Scene, SceneSettings, Size, Style, VisibleLines,
    load,
};
use tinta_lab::compare::{Agreement, InkMask};

/// Share of either drawing's ink that the other has within 2 pixels.
const SHARE: f64 = 0.99;

const TOLERANCE_PX: u32 = 2;

/// GL draws no intersections, and this test excludes them from the exact lines.
const CLASSES: ClassSet = ClassSet::of(&[Class::Boundary, Class::NonManifold, Class::Silhouette, Class::Crease]);

#[test]
fn the_svg_of_public_models_has_the_ink_that_gl_draws() {
    let mut renderer = renderer(BACKENDS[0]);
    let mut failures = Vec::new();
    for file in PUBLIC_MODELS {
        let Some(path) = public_model(file) else { continue };
        let [of_svg, of_gl] = shares(&mut renderer, &path);
        println!("{file}: {of_svg:.4} of the SVG's ink, {of_gl:.4} of GL's");
        if of_svg < SHARE || of_gl < SHARE {
            failures.push(format!("{file}: {of_svg:.4} of the SVG's ink is GL's too, {of_gl:.4} of GL's the SVG's"));
        }
    }
    assert!(failures.is_empty(), "below {SHARE}; see {}: {failures:#?}", failure_folder().display());
}

/// Scenes without T-junctions, which GL draws unchanged.
fn check_outlines(seeds: u64) {
    let mut renderer = renderer(BACKENDS[0]);
    let mut failures = Vec::new();
    for (name, make) in FAMILIES.iter().filter(|(name, _)| ["regular prisms", "bars in one plane"].contains(name)) {
        for seed in 1..=seeds {
            let scene = with_normals(&make(&mut Random::seeded(seed)));
            let [_, of_gl] = shares_of(&mut renderer, &scene, &format!("{name} {seed}"));
            if of_gl < SHARE {
                failures.push(format!("{name}, seed {seed}: the lines have {of_gl:.4} of GL's ink"));
            }
        }
    }
    assert!(failures.is_empty(), "below {SHARE}; see {}: {failures:#?}", failure_folder().display());
}

#[test]
fn no_outline_that_gl_draws_of_three_scenes_of_flat_faces_along_an_axis_is_missing_briefly() {
    check_outlines(3);
}

#[test]
#[ignore = "exhaustive: twelve scenes of each family"]
fn no_outline_that_gl_draws_of_flat_faces_along_an_axis_is_missing() {
    check_outlines(12);
}

#[test]
fn smooth_silhouettes_of_closed_forms_are_those_of_the_exact_lines() {
    let mut renderer = renderer(BACKENDS[0]);
    let forms =
        [("ellipsoid", ClosedForm::ellipsoid(1.0, 0.6, 1.4)), ("torus", ClosedForm::Torus { ring: 1.0, tube: 0.4 })];
    for (name, form) in forms {
        for jitter in [0.0, 0.2] {
            let view = View { azimuth_degrees: 30.0, elevation_degrees: 40.0 };
            let camera = CameraSettings { view, ..CameraSettings::default() };
            let settings = SceneSettings { camera, ..SceneSettings::default() };
            let scene = Scene::new(vec![Arc::new(form.mesh(10_000, jitter).unwrap())], &settings).unwrap();
            let [of_svg, of_gl] = shares_by(&mut renderer, &scene, name, SilhouetteRule::Smooth);
            assert!(of_svg >= SHARE && of_gl >= SHARE, "{name} {jitter}: {of_svg} of the SVG's ink, {of_gl} of GL's");
        }
    }
}

/// The same scene of meshes that GL can shade.
fn with_normals(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let meshes = scene.objects.iter().map(|object| shaded(&object.mesh));
    scene.objects = Scene::new(meshes, &SceneSettings::default()).unwrap().objects;
    scene
}

/// The share of the SVG's ink that GL draws too, and of GL's that the SVG has.
fn shares(renderer: &mut Renderer, path: &str) -> [f64; 2] {
    let mesh = Arc::new(load(path, &LoadOptions::default()).unwrap().mesh);
    let scene = Scene::new(vec![mesh], &SceneSettings::default()).unwrap();
    shares_of(renderer, &scene, path.rsplit('/').next().unwrap())
}

fn shares_of(renderer: &mut Renderer, scene: &Scene, name: &str) -> [f64; 2] {
    shares_by(renderer, scene, name, SilhouetteRule::Exact)
}

fn shares_by(renderer: &mut Renderer, scene: &Scene, name: &str, silhouette: SilhouetteRule) -> [f64; 2] {
    let inking = Inking { classes: CLASSES, silhouette, paint: PaintMode::None, ..Inking::default() };
    let of_gl = renderer.render(scene, &Style::Inking(inking)).unwrap();
    let settings = LineSettings { classes: CLASSES, silhouette, ..LineSettings::as_published() };
    let lines = VisibleLines::of(scene, &settings).unwrap();
    // GL draws short lines too.
    let all = DrawingSettings { min_length: Some(Length::Px(0.0)), ..DrawingSettings::default() };
    let pixels = rendered(&svg(&lines, &all).unwrap(), 1.0);
    let size = Size { width: pixels.width(), height: pixels.height() };
    let of_svg = Picture { size, pixels: pixels.data().to_vec() };
    let masks = [InkMask::of(&of_svg), InkMask::of(&of_gl)];
    assert!(masks.iter().all(|mask| mask.count() > 500), "{name}: there is nothing to compare");
    let numbers = Agreement::of(&masks[0], &masks[1], TOLERANCE_PX).unwrap().numbers;
    for (picture, what) in [(&of_svg, "svg"), (&of_gl, "gl")] {
        tinta::Target::check(failure_folder().join(format!("{name}-{what}.png")).to_str().unwrap(), false)
            .unwrap()
            .write(picture)
            .unwrap();
    }
    [numbers.left_shared.unwrap(), numbers.right_shared.unwrap()]
}
