//! The claims about edges: counts, silhouettes from many places, and the listing's own search, timed.

use super::super::finding::{Finding, Number};
use super::super::lab::Lab;
use crate::figures::figure::{Panel, Shot, panel};
use crate::figures::series::{Interval, cost_ms_of};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use tinta::camera::{CameraSettings, View};
use tinta::edges::{Class, ClassSet, CreaseAngle, EdgeList, Incidence, SilhouetteRule};
use tinta::error::Result;
use tinta::mesh::{LoadOptions, Mesh, load};
use tinta::plan::Step;
use tinta::scene::{Scene, SceneSettings};
use tinta::styles::{Inking, PaintMode, Show, Style};

/// Public models in [`MODELS_FOLDER`], those of the errata and of the measurements.
const PUBLIC: [&str; 9] = [
    "ant.ply",
    "beethoven.obj",
    "cow.obj",
    "faerie.md2",
    "fandisk.obj",
    "spot/spot_triangulated.obj",
    "stanford-bunny.obj",
    "suzanne.obj",
    "teapot.obj",
];

/// Names the folder of the public models, as for the tests.
const MODELS_FOLDER: &str = "TINTA_MODELS";

pub(super) fn one_or_two_faces(_: &mut Lab<'_>) -> Result<Finding> {
    let Some(folder) = std::env::var_os(MODELS_FOLDER).map(PathBuf::from) else {
        return Ok(Finding::nowhere(
            "the models here are tinta's own, so their edges decide nothing; TINTA_MODELS names a folder with public ones",
        ));
    };
    let (mut edges, mut more, mut models) = (0, 0, 0);
    for name in PUBLIC {
        let list = EdgeList::new(&load(&folder.join(name).to_string_lossy(), &LoadOptions::default())?.mesh);
        let of_many = list.incidence().iter().filter(|incidence| **incidence == Incidence::NonManifold).count();
        edges += list.len();
        more += of_many;
        models += usize::from(of_many > 0);
    }
    Ok(Finding::of(
        more == 0,
        vec![
            Number::count("edges of three triangles or more", more),
            Number::count("of", edges),
            Number::count("models that have one, of nine", models),
        ],
    ))
}

/// The silhouette edges of the first object.
fn silhouette(scene: &Scene, rule: SilhouetteRule) -> BTreeSet<u32> {
    let object = &scene.objects[0];
    scene.edges(object).silhouette(scene.eye(object, rule), rule).into_iter().collect()
}

fn from(lab: &mut Lab<'_>, azimuth_degrees: f64, fov_y_degrees: f64) -> Result<Arc<Scene>> {
    let view = View { azimuth_degrees, elevation_degrees: 20.0 };
    let camera = CameraSettings { view, fov_y_degrees, ..CameraSettings::default() };
    lab.seen("builtin:bust", SceneSettings { camera, ..SceneSettings::default() })
}

pub(super) fn every_frame(lab: &mut Lab<'_>) -> Result<Finding> {
    let fov = CameraSettings::default().fov_y_degrees;
    let [before, after] = [0.0, 5.0].map(|azimuth| from(lab, azimuth, fov));
    let [before, after] = [before?, after?].map(|scene| silhouette(&scene, SilhouetteRule::Exact));
    let stayed = before.intersection(&after).count();
    let changed = 1.0 - stayed as f64 / before.len().max(1) as f64;
    Ok(Finding::of(changed > 0.0, vec![Number::share("of the silhouette edges no longer are any", changed)]))
}

pub(super) fn sixty_six_degrees(_: &mut Lab<'_>) -> Result<Finding> {
    let degrees = 0.4f64.acos().to_degrees();
    Ok(Finding::of(degrees.round() == 66.0, vec![Number::new("arccos(0.4)", degrees, "degrees", 2)]))
}

pub(super) fn needs_no_shader(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let plan = Style::Inking(Inking::default()).plan(&scene, Show::Final)?;
    let shaders = plan.steps().filter(|(_, step)| matches!(step, Step::Draw(draw) if draw.program.is_some())).count();
    Ok(Finding::of(shaders == 0, vec![Number::count("steps with a shader", shaders)]))
}

/// How many places around the bust.
const PLACES: usize = 24;

pub(super) fn every_view(lab: &mut Lab<'_>) -> Result<Finding> {
    let mut numbers = Vec::new();
    let mut is_correct = true;
    for (fov, what) in [(60.0, "found, seen with 60 degrees"), (30.0, "with 30 degrees")] {
        let (mut found, mut exact, mut wrong) = (0, 0, 0);
        for place in 0..PLACES {
            let scene = from(lab, place as f64 * 360.0 / PLACES as f64, fov)?;
            let [listing, right] =
                [SilhouetteRule::Published, SilhouetteRule::Exact].map(|rule| silhouette(&scene, rule));
            found += listing.intersection(&right).count();
            wrong += listing.difference(&right).count();
            exact += right.len();
        }
        is_correct &= found == exact && wrong == 0;
        numbers.push(Number::share(what, found as f64 / exact.max(1) as f64));
    }
    Ok(Finding::of(is_correct, numbers))
}

pub(super) fn every_view_panels() -> Vec<Panel> {
    let wide =
        || Shot { camera: CameraSettings { fov_y_degrees: 60.0, ..CameraSettings::default() }, options: "--fov 60" };
    let shown = |file: &str, label, silhouette, rule: &str| {
        let inking = Inking { paint: PaintMode::None, silhouette, ..Inking::default() };
        let options = format!("--style inking --paint none --silhouette {rule}");
        panel(file, label, "builtin:bust", wide(), Style::Inking(inking), &options)
    };
    vec![
        shown("claim-d-every-view-listing", "the listing's rule", SilhouetteRule::Published, "paper"),
        shown("claim-d-every-view-exact", "the exact rule", SilhouetteRule::Exact, "exact"),
    ]
}

pub(super) fn threshold(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let edges = scene.edges(&scene.objects[0]);
    let creases = |degrees| -> Result<usize> {
        let classes = edges.classes(CreaseAngle::from_degrees(degrees)?, ClassSet::of(&[Class::Crease]));
        Ok(*classes.counts().of(Class::Crease))
    };
    let [fine, text, coarse] = [creases(20.0)?, creases(0.4f64.acos().to_degrees())?, creases(100.0)?];
    Ok(Finding::of(
        fine > text && text > coarse,
        vec![
            Number::count("creases from 20 degrees on", fine),
            Number::count("from the text's 66", text),
            Number::count("from 100", coarse),
        ],
    ))
}

/// The listing's list: it searches all edges so far for each side of each triangle. Returns the number of edges.
fn listings_search(mesh: &Mesh) -> usize {
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(mesh.triangles.len() * 3);
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (a, c), (b, c)] {
            let edge = [*from.min(to), *from.max(to)];
            if !edges.contains(&edge) {
                edges.push(edge);
            }
        }
    }
    edges.len()
}

/// How often a search is timed.
const SEARCHES: usize = 9;

pub(super) fn computing(lab: &mut Lab<'_>) -> Result<Finding> {
    let mesh = lab.mesh("builtin:bust")?;
    // The search gives the listing's result: as many edges as the library's.
    debug_assert_eq!(listings_search(&mesh), EdgeList::new(&mesh).len());
    let scene = lab.scene("builtin:bust")?;
    let plan = Style::Inking(Inking::default()).plan(&scene, Show::Final)?;
    let frame = Interval::of_turns([&lab.times(vec![(scene.clone(), plan)])?[0]], |[ms]| ms);
    let repeated = |work: &dyn Fn() -> usize| Interval::of((0..SEARCHES).map(|_| cost_ms_of(work)).collect());
    let search = repeated(&|| listings_search(&mesh));
    let each_frame = repeated(&|| silhouette(&scene, SilhouetteRule::Published).len());
    Ok(Finding::of_repeats(
        search.is_above(frame.quartiles[1]),
        vec![
            Number::repeated("the listing's search, once a model", search, "ms", 1),
            Number::repeated("a frame", frame, "ms", 1),
            Number::repeated("silhouettes, of each frame", each_frame, "ms", 2),
        ],
    ))
}
