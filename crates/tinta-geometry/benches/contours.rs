//! Measures the error of silhouettes against the smooth surface's, the breaks in their visibility, and their cost.
//! docs/results/exactness.md has the commands and the results.

#[path = "../tests/support/contour_distance.rs"]
mod contour_distance;
#[path = "contours/flicker.rs"]
mod flicker;

use flicker::{Flicker, flicker};
use glam::DVec3;
use std::collections::HashSet;
use std::sync::Arc;
use std::time::Instant;
use tinta_geometry::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use tinta_geometry::lines::closed_forms::{ClosedForm, Patch};
use tinta_geometry::lines::{LineSettings, VisibilityChanges};
use tinta_geometry::{CameraSettings, LoadOptions, Mesh, Result, Scene, SceneSettings, View, VisibleLines, load};

const USAGE: &str = "cargo bench -p tinta-geometry --bench contours -- truth [SURFACE...] | breaks [MODEL...] | times MODEL... | flicker VIEWS [MODEL...]
  truth    Hausdorff distance from closed forms at 1,000, 10,000 and 100,000 triangles, with its order
  breaks   inconsistencies of visibility, mean of 26 views; of closed forms where no model is given
  times    milliseconds to find the lines, one view, rounds in turn
  flicker  what comes and goes per degree of a turn, pixels of silhouette: VIEWS places of it, a degree each; 360 are the whole";

/// Views of a model: the faces, edges and corners of a cube, slightly turned, so no view runs along an axis.
fn views() -> Vec<DVec3> {
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.11, 0.23, 0.07);
    let step = |number: i32| f64::from(number % 3 - 1);
    let all = (0..27).map(|number| DVec3::new(step(number), step(number / 3), step(number / 9)));
    all.filter(|way| *way != DVec3::ZERO).map(|way| turn * way.normalize()).collect()
}

/// A model at 512 x 512, seen from a direction.
fn scene(mesh: &Arc<Mesh>, way: DVec3) -> Result<Scene> {
    let (azimuth, elevation) = (way.x.atan2(way.z).to_degrees(), way.y.asin().to_degrees());
    let view = View { azimuth_degrees: azimuth, elevation_degrees: elevation };
    let camera = CameraSettings { view, ..CameraSettings::default() };
    Scene::new(vec![mesh.clone()], &SceneSettings { camera, ..SceneSettings::default() })
}

const RULES: [(&str, SilhouetteRule); 2] = [("exact", SilhouetteRule::Exact), ("smooth", SilhouetteRule::Smooth)];

fn settings(silhouette: SilhouetteRule) -> LineSettings {
    LineSettings { silhouette, ..LineSettings::default() }
}

fn forms() -> [(&'static str, ClosedForm); 5] {
    [
        ("sphere", ClosedForm::ellipsoid(1.0, 1.0, 1.0)),
        ("ellipsoid", ClosedForm::ellipsoid(1.0, 0.6, 1.4)),
        ("torus", ClosedForm::Torus { ring: 1.0, tube: 0.4 }),
        ("superquadric", ClosedForm::Superquadric { half_axes: DVec3::new(1.0, 0.6, 1.4), power: 4 }),
        ("patch", ClosedForm::Patch(Patch::HILLS)),
    ]
}

fn truth(surfaces: &[String]) -> Result<()> {
    println!("| surface | mesh | rule | triangles | Hausdorff px, worst of 26 | median | mean distance px | order |");
    println!("|---|---|---|---|---|---|---|---|");
    let is_asked = |name: &str| surfaces.is_empty() || surfaces.iter().any(|surface| surface == name);
    for (name, form) in forms().into_iter().filter(|(name, _)| is_asked(name)) {
        for (kind, jitter) in [("regular", 0.0), ("irregular", 0.2)] {
            for (rule, silhouette) in RULES {
                let mut before: Option<(f64, f64)> = None;
                for triangles in [1_000, 10_000, 100_000] {
                    let mesh = Arc::new(form.mesh(triangles, jitter)?);
                    let (mut distances, mut sum) = (Vec::new(), 0.0);
                    for way in views() {
                        let scene = scene(&mesh, way)?;
                        let lines = VisibleLines::of(&scene, &settings(silhouette))?;
                        let is_drawn = |class, is_visible| class == Class::Silhouette && is_visible;
                        let drawn = lines.segments.iter().filter(|segment| is_drawn(segment.class, segment.is_visible));
                        let drawn: Vec<_> = drawn.map(|segment| segment.ends_px).collect();
                        let distance = contour_distance::distance(&drawn, &form.visible_contour(&scene));
                        distances.push(distance.hausdorff_px());
                        sum += distance.mean_px;
                    }
                    distances.sort_by(f64::total_cmp);
                    let (worst, median) = (distances[distances.len() - 1], distances[distances.len() / 2]);
                    let count = mesh.triangles.len() as f64;
                    // The order in edge length, which falls with the square root of the number of triangles.
                    let order = before.map(|(error, triangles)| 2.0 * (error / worst).ln() / (count / triangles).ln());
                    let order = order.map_or("".to_owned(), |order| format!("{order:.2}"));
                    let mean = sum / distances.len() as f64;
                    println!("| {name} | {kind} | {rule} | {count} | {worst:.4} | {median:.4} | {mean:.4} | {order} |");
                    before = Some((worst, count));
                }
            }
        }
    }
    Ok(())
}

fn meshes(models: &[String]) -> Result<Vec<(String, Arc<Mesh>)>> {
    if models.is_empty() {
        let mut meshes = Vec::new();
        for (name, form) in forms() {
            for (kind, jitter) in [("regular", 0.0), ("irregular", 0.2)] {
                for triangles in [1_000, 10_000] {
                    meshes.push((format!("{name}, {kind}, {triangles}"), Arc::new(form.mesh(triangles, jitter)?)));
                }
            }
        }
        return Ok(meshes);
    }
    let named = |model: &String| {
        let name =
            std::path::Path::new(model).file_stem().map_or(model.clone(), |name| name.to_string_lossy().into_owned());
        Ok((name, Arc::new(load(model, &LoadOptions::default())?.mesh)))
    };
    models.iter().map(named).collect()
}

fn breaks(models: &[String]) -> Result<()> {
    println!("| model | triangles | rule | inconsistencies | crossings | cusps | pieces seen, px |");
    println!("|---|---|---|---|---|---|---|");
    for (name, mesh) in meshes(models)? {
        for (rule, silhouette) in RULES {
            let mut sums = [0.0; 4];
            let views = views();
            for way in &views {
                let settings = LineSettings { counts_changes: true, ..settings(silhouette) };
                let lines = VisibleLines::of(&scene(&mesh, *way)?, &settings)?;
                let VisibilityChanges { crossings, cusps, inconsistencies, .. } = lines.changes.unwrap_or_default();
                let seen =
                    lines.segments.iter().filter(|segment| segment.is_visible && segment.class == Class::Silhouette);
                let length: f64 = seen.map(|segment| segment.ends_px[0].distance(segment.ends_px[1])).sum();
                let numbers = [inconsistencies as f64, crossings as f64, cusps as f64, length];
                sums.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number / views.len() as f64);
            }
            let [inconsistencies, crossings, cusps, length] = sums;
            let count = mesh.triangles.len();
            println!(
                "| {name} | {count} | {rule} | {inconsistencies:.2} | {crossings:.2} | {cusps:.2} | {length:.0} |"
            );
        }
    }
    Ok(())
}

fn times(models: &[String]) -> Result<()> {
    const ROUNDS: usize = 11;
    println!("| model | triangles | classes | rule | ms, median of {ROUNDS} | all |");
    println!("|---|---|---|---|---|---|");
    for (name, mesh) in meshes(models)? {
        let all = LineSettings::default().classes;
        for (classes_name, classes) in [("silhouette", ClassSet::of(&[Class::Silhouette])), ("default", all)] {
            let mut taken = [const { Vec::new() }; 2];
            for round in 0..=ROUNDS {
                for (rule, taken) in RULES.iter().zip(&mut taken) {
                    // Cold each time: a new scene has no cached edges.
                    let scene = scene(&mesh, DVec3::new(0.4, 0.3, 1.0).normalize())?;
                    let settings = LineSettings { classes, finds_hidden: false, ..settings(rule.1) };
                    let start = Instant::now();
                    let lines = VisibleLines::of(&scene, &settings)?;
                    let ms = start.elapsed().as_secs_f64() * 1e3;
                    assert!(!lines.segments.is_empty());
                    // The first round is a warm-up.
                    if round > 0 {
                        taken.push(ms);
                    }
                }
            }
            for ((rule, _), taken) in RULES.iter().zip(&mut taken) {
                let raw = taken.iter().map(|ms| format!("{ms:.1}")).collect::<Vec<_>>().join(" ");
                taken.sort_by(f64::total_cmp);
                let median = taken[taken.len() / 2];
                println!("| {name} | {} | {classes_name} | {rule} | {median:.1} | {raw} |", mesh.triangles.len());
            }
        }
    }
    Ok(())
}

/// The visible silhouettes of a scene under each rule. The listing's rule has no exact lines; its silhouettes are the
/// visible parts of all edges that it selects.
fn silhouettes(scene: &Scene, rule: &str) -> Result<VisibleLines> {
    let silhouette = if rule == "smooth" { SilhouetteRule::Smooth } else { SilhouetteRule::Exact };
    let only = LineSettings {
        classes: ClassSet::of(&[Class::Silhouette]),
        silhouette,
        finds_hidden: false,
        ..LineSettings::default()
    };
    if rule != "paper" {
        return VisibleLines::of(scene, &only);
    }
    let classes = ClassSet::of(&[Class::Silhouette, Class::Crease]);
    let all = LineSettings { classes, crease_angle: CreaseAngle::from_degrees(0.0)?, ..only };
    let object = &scene.objects[0];
    let (edges, rule) = (scene.edges(object), SilhouetteRule::Published);
    let ends = |edge: &u32| edges.list().positions()[*edge as usize].map(|at| object.mesh.file_vertices[at as usize]);
    let named: HashSet<[u32; 2]> = edges.silhouette(scene.eye(object, rule), rule).iter().map(ends).collect();
    let mut lines = VisibleLines::of(scene, &all)?;
    lines.segments.retain(|segment| segment.edge.is_some_and(|edge| named.contains(&edge)));
    Ok(lines)
}

fn turns(views: &str, models: &[String]) -> Result<()> {
    let views: usize = views.parse().ok().filter(|views| (1..=360).contains(views)).unwrap_or(360);
    println!("| model | triangles | rule | drawn px | flicker px a degree, within 1, 2, 4 and 8 px |");
    println!("|---|---|---|---|---|");
    for (name, mesh) in meshes(models)? {
        let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default())?;
        let cameras = scene.turntable(&CameraSettings::default(), 360)?;
        for rule in ["paper", "exact", "smooth"] {
            let picture = |view: usize| -> Result<(Scene, VisibleLines)> {
                let scene = Scene { camera: cameras[view % 360], ..scene.clone() };
                let lines = silhouettes(&scene, rule)?;
                Ok((scene, lines))
            };
            let mut sum = [0.0; 5];
            let mut known: Option<(usize, (Scene, VisibleLines))> = None;
            for place in 0..views {
                let first = place * 360 / views;
                let before = match known.take() {
                    Some((view, picture)) if view == first => picture,
                    _ => picture(first)?,
                };
                let after = picture(first + 1)?;
                let pair = [(&before.0, &before.1), (&after.0, &after.1)];
                for (slot, near_px) in [1.0, 2.0, 4.0, 8.0].into_iter().enumerate() {
                    let Flicker { drawn_px, unexplained_px, .. } = flicker(pair, near_px);
                    sum[slot] += unexplained_px / views as f64;
                    // Drawn lines are counted in both pictures, each time.
                    sum[4] += drawn_px / (8 * views) as f64;
                }
                known = Some((first + 1, after));
            }
            let [one, two, four, eight, drawn] = sum;
            let count = mesh.triangles.len();
            println!("| {name} | {count} | {rule} | {drawn:.0} | {one:.2}, {two:.2}, {four:.2}, {eight:.2} |");
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    match words.split_first().map(|(first, rest)| (first.as_str(), rest)) {
        Some(("truth", surfaces)) => truth(surfaces),
        Some(("breaks", models)) => breaks(models),
        Some(("times", models @ [_, ..])) => times(models),
        Some(("flicker", [views, models @ ..])) => turns(views, models),
        _ => {
            println!("{USAGE}");
            Ok(())
        }
    }
}
