//! The savings of pruning, how a frame's cost grows with triangles and with pixels, compared with lower bounds (clearing, drawing
//! the mesh once, one filter over the picture), and frames and cold starts of model files. docs/results/measuring.md has the command.
//!
//! Contestants take turns, round by round. The model turns by 3 degrees a round. Every frame includes making the plan and pruning
//! it; the search for omissions that hold in all views is timed separately.

#[path = "report/growth.rs"]
mod growth;
mod report;
#[path = "report/search.rs"]
mod search;
#[path = "report/sphere.rs"]
mod sphere;

use glam::{DVec3, Vec2, Vec3};
use growth::{Curve, plot};
use report::{Series, print_table, write_record};
use search::only;
use serde_json::{Value, json};
use sphere::bumpy_sphere;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;
use tinta::culling::DrawnFaces;
use tinta::mesh::Part;
use tinta::plan::prune::{Rule, prune};
use tinta::plan::{Draw, Faces, Geometry, Paint, Pass, Plan, Step};
use tinta::renderer::milliseconds_since;
use tinta::styles::{Cartoon, Mrt};
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName, load};

const USAGE: &str =
    "cargo bench --bench performance -- [MODEL…] [--rounds N] [--largest N] [--only saved|search|sizes|triangles|pixels|models]
  MODEL          model files beside the built-in ones; one that is missing is skipped
  --rounds N     interleaved rounds (default 21)
  --largest N    triangles of the largest mesh (default 4000000)
  --only PART    one of the six tables; models: frames and cold starts of each model file";

struct Settings {
    models: Vec<String>,
    rounds: usize,
    largest: usize,
    only: Option<String>,
}

fn settings() -> Option<Settings> {
    let mut settings = Settings { models: Vec::new(), rounds: 21, largest: 4_000_000, only: None };
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--rounds" => settings.rounds = arguments.next()?.parse().ok()?,
            "--largest" => settings.largest = arguments.next()?.parse().ok()?,
            "--only" => settings.only = Some(arguments.next()?),
            option if option.starts_with("--") => return None,
            missing if !Path::new(missing).is_file() => println!("SKIPPED: there is no file {missing}"),
            _ => settings.models.push(argument),
        }
    }
    Some(settings)
}

fn main() {
    let Some(settings) = settings() else {
        println!("{USAGE}");
        return;
    };
    let mut renderer = Renderer::new(Backend::Auto).expect("a context");
    println!("{}", renderer.context().renderer);
    let is_wanted = |part: &str| settings.only.as_ref().is_none_or(|only| only == part);
    let mut record = json!({ "gl": renderer.context() });
    if is_wanted("saved") {
        record["saved"] = saved(&mut renderer, &settings);
    }
    if is_wanted("search") {
        let scenes = scenes(&settings.models).map(|(name, scene)| (name, turned(&scene, 0.0))).collect::<Vec<_>>();
        record["search"] = search::ratios(&mut renderer, &scenes, settings.rounds);
    }
    if is_wanted("sizes") {
        record["sizes"] = by_sizes(&mut renderer, settings.rounds);
    }
    if is_wanted("triangles") {
        record["triangles"] = by_triangles(&mut renderer, &settings);
    }
    if is_wanted("pixels") {
        record["pixels"] = by_pixels(&mut renderer, settings.rounds);
    }
    if is_wanted("models") {
        record["models"] = of_models(&mut renderer, &settings);
    }
    write_record("performance", &record);
}

/// The contestants of a frame.
enum Contestant {
    /// As published.
    Full(Style),
    /// The same, pruned for each view.
    Pruned(Style),
    /// The same by all other rules, and only faces that own a pixel, which are found before the time starts: what leaving out
    /// hidden faces can reach.
    Ceiling(Style),
    /// A plan of single steps.
    Limit(Plan),
}

impl Contestant {
    /// The milliseconds of one frame, its plan included.
    fn frame_ms(&self, renderer: &mut Renderer, scene: &Scene) -> f64 {
        let mut pruning = renderer.pruning();
        let owners = matches!(self, Self::Ceiling(_)).then(|| owners(scene));
        if owners.is_some() {
            pruning.keep.push(Rule::HiddenFaces);
        }
        let start = Instant::now();
        let mut made;
        let plan = match self {
            Self::Full(style) => {
                made = style.plan(scene, Show::Final).expect("a plan");
                &made
            }
            Self::Pruned(style) => {
                made = prune(&style.plan(scene, Show::Final).expect("a plan"), scene, &pruning).plan;
                &made
            }
            Self::Ceiling(style) => {
                made = prune(&style.plan(scene, Show::Final).expect("a plan"), scene, &pruning).plan;
                owners.iter().for_each(|owners| {
                    only(&mut made, owners);
                });
                &made
            }
            Self::Limit(plan) => plan,
        };
        renderer.time_frames(scene, plan, 0, 1).expect("a frame");
        milliseconds_since(start)
    }
}

/// The faces of a scene's one object that are nearest at a pixel's centre.
fn owners(scene: &Scene) -> Arc<Vec<Faces>> {
    let (object, size) = (&scene.objects[0], scene.size);
    let arrays = scene.arrays(object);
    let clip_from_object = scene.clip_from_view() * scene.view_from_object(object, arrays.centre);
    let half = Vec2::new(size.width as f32, size.height as f32) * 0.5;
    let place = |[x, y, z, ..]: &[f32; 6]| {
        let place = clip_from_object.project_point3(Vec3::new(*x, *y, *z));
        (place.truncate() * half + half).extend(place.z)
    };
    let places: Vec<Vec3> = arrays.vertices.iter().map(place).collect();
    let mut nearest = vec![(f32::INFINITY, usize::MAX); size.pixel_count()];
    for (face, corners) in arrays.indices.chunks_exact(3).enumerate() {
        let [a, b, c] = [0, 1, 2].map(|corner| places[corners[corner] as usize]);
        let (low, high) = (a.min(b).min(c).max(Vec3::ZERO), a.max(b).max(c).min((half * 2.0 - 0.5).extend(1.0)));
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        for y in low.y as u32..=high.y.max(0.0) as u32 {
            for x in low.x as u32..=high.x.max(0.0) as u32 {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let part = |p: Vec3, q: Vec3| (q - p).truncate().perp_dot(at - p.truncate()) / area;
                let [of_c, of_a, of_b] = [part(a, b), part(b, c), part(c, a)];
                if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                    let pixel = &mut nearest[(y * size.width + x) as usize];
                    let depth = a.z * of_a + b.z * of_b + c.z * of_c;
                    if depth < pixel.0 {
                        *pixel = (depth, face);
                    }
                }
            }
        }
    }
    let owners: BTreeSet<u32> =
        nearest.iter().filter(|(_, face)| *face != usize::MAX).map(|(_, face)| *face as u32).collect();
    let (mut indices, mut parts) = (Vec::new(), Vec::new());
    for part in &arrays.parts {
        let first = indices.len() as u32;
        let faces = owners.range(part.first / 3..(part.first + part.count) / 3);
        faces.for_each(|face| indices.extend_from_slice(&arrays.indices[*face as usize * 3..][..3]));
        parts.push(Part { first, count: indices.len() as u32 - first, ..*part });
    }
    Arc::new(vec![Faces::Listed(Arc::new(DrawnFaces { indices, parts, left_out: 0 }))])
}

/// The scene with the eye turned by so many degrees.
fn turned(scene: &Scene, degrees: f64) -> Scene {
    let mut turned = scene.clone();
    let (sin, cos) = degrees.to_radians().sin_cos();
    let offset = scene.camera.eye - scene.camera.target;
    let offset = DVec3::new(offset.x * cos + offset.z * sin, offset.y, offset.z * cos - offset.x * sin);
    turned.camera.eye = scene.camera.target + offset;
    (turned.camera.near, turned.camera.far) =
        (offset.length() - scene.radius * 1.05, offset.length() + scene.radius * 1.05);
    turned
}

/// Every contestant's times, in turn.
fn race(renderer: &mut Renderer, scene: &Scene, contestants: &[(String, Contestant)], rounds: usize) -> Vec<Series> {
    let mut series: Vec<Series> = contestants.iter().map(|(name, _)| Series::new(name)).collect();
    for (_, contestant) in contestants {
        contestant.frame_ms(renderer, scene);
    }
    for round in 0..rounds {
        let view = turned(scene, round as f64 * 10.0);
        for ((_, contestant), series) in contestants.iter().zip(&mut series) {
            series.times.push(contestant.frame_ms(renderer, &view));
        }
    }
    series
}

fn rows(series: &[Series]) -> Value {
    series.iter().map(|one| json!({ "name": one.name, "ms": one.times })).collect()
}

fn fitted(model: &str) -> Scene {
    let mesh = Arc::new(load(model, &LoadOptions::default()).expect("a model").mesh);
    Scene::new(vec![mesh], &SceneSettings::default()).expect("a scene")
}

/// The bust filling the picture, gear and open box on about a quarter of it, and model files.
fn scenes(files: &[String]) -> impl Iterator<Item = (String, Scene)> {
    let from_afar = |model: &str, times: f64| {
        let mut scene = fitted(model);
        scene.camera.eye = scene.camera.target + (scene.camera.eye - scene.camera.target) * times;
        scene
    };
    let built_in = [
        ("the bust, fitted", fitted("builtin:bust")),
        ("the gear, on a quarter of the picture", from_afar("builtin:gear", 1.85)),
        ("the open box, on a quarter of the picture", from_afar("builtin:open-box", 1.85)),
    ];
    let built_in = built_in.map(|(name, scene)| (name.to_owned(), scene));
    built_in.into_iter().chain(files.iter().map(|file| (file.clone(), fitted(file))))
}

/// Styles in full and pruned over a turn.
fn saved(renderer: &mut Renderer, settings: &Settings) -> Value {
    let tables = scenes(&settings.models).map(|(name, scene)| {
        let view = turned(&scene, 0.0);
        let extent = view.extent_px(view.objects.iter(), view.size).map_or(0, |extent| extent.pixel_count());
        println!(
            "\n{name}: {} triangles, their box covers {} % of {}",
            scene.triangle_count(),
            extent * 100 / view.size.pixel_count(),
            view.size
        );
        let names = StyleName::of_passes().filter(|(name, _)| *name != "sand");
        let tables: Vec<Value> = names
            .map(|(name, style)| {
                let full = format!("{name} --full");
                let contestants = [
                    (full.clone(), Contestant::Full(Style::named(style))),
                    (name.to_owned(), Contestant::Pruned(Style::named(style))),
                    (format!("{name}, the faces that own a pixel"), Contestant::Ceiling(Style::named(style))),
                ];
                let series = race(renderer, &scene, &contestants, settings.rounds);
                let [full_ms, pruned, ceiling] = [0, 1, 2].map(|number| series[number].median());
                println!(
                    "  {full:<24}{full_ms:>9.2} ms{pruned:>9.2} ms pruned: {:.2} x, at most {:.2} x",
                    full_ms / pruned,
                    full_ms / ceiling
                );
                rows(&series)
            })
            .collect();
        json!({ "scene": name, "styles": tables })
    });
    tables.collect()
}

/// Pruned styles over full ones at three sizes: whether the pruning checks ever make a frame slower.
fn by_sizes(renderer: &mut Renderer, rounds: usize) -> Value {
    const SIZES: [u32; 3] = [512, 1100, 2048];
    let mut tables = Vec::new();
    for model in ["builtin:bust", "builtin:open-box", "builtin:torus:70000"] {
        println!("\n{model}: pruned over in full, median and quartiles of {rounds} rounds' ratios");
        let mesh = Arc::new(load(model, &LoadOptions::default()).expect("a model").mesh);
        for (name, style) in StyleName::of_passes().filter(|(name, _)| *name != "sand") {
            print!("  {name:<12}");
            for pixels in SIZES {
                let size = Size { width: pixels, height: pixels };
                let scene = Scene::new(vec![mesh.clone()], &SceneSettings { size, ..SceneSettings::default() });
                let scene = scene.expect("a scene");
                let contestants = [
                    ("full".to_owned(), Contestant::Full(Style::named(style))),
                    ("pruned".to_owned(), Contestant::Pruned(Style::named(style))),
                ];
                let series = race(renderer, &scene, &contestants, rounds);
                let ratios = series[0].times.iter().zip(&series[1].times).map(|(full, pruned)| pruned / full);
                let mut ratios: Vec<f64> = ratios.collect();
                ratios.sort_by(f64::total_cmp);
                let [low, middle, high] = [1, 2, 3].map(|quarter| ratios[ratios.len() * quarter / 4]);
                print!("  {pixels}: {middle:.3} ({low:.3}-{high:.3})");
                tables.push(json!({ "model": model, "style": name, "pixels": pixels, "ms": rows(&series) }));
            }
            println!();
        }
    }
    json!(tables)
}

/// A plan of one pass.
fn limit(name: &'static str, steps: Vec<Step>) -> Contestant {
    Contestant::Limit(Plan::new(vec![Pass::new(name, steps)]))
}

fn mesh_once(cull_back_faces: bool) -> Contestant {
    let draw = Draw { cull_back_faces, ..Draw::new(Geometry::Objects(Paint::Uniform([0.5; 4])), None) };
    limit("mesh", vec![Step::clear([1.0; 4]), Step::Draw(draw)])
}

/// The published border's square over a copy of the framebuffer.
fn filter_once(scene: &Scene) -> Contestant {
    let plan = Style::named(StyleName::ThreePass).plan(scene, Show::Final).expect("a plan");
    let square = plan.steps().find_map(|(_, step)| match step {
        Step::Draw(draw) if draw.geometry == Geometry::ScreenSquare => Some(step.clone()),
        _ => None,
    });
    limit("filter", vec![Step::clear([1.0; 4]), Step::CopyFramebuffer, square.expect("a border")])
}

fn contestants(scene: &Scene) -> Vec<(String, Contestant)> {
    let named = |name: &str, contestant| (name.to_owned(), contestant);
    vec![
        named("three-pass --full", Contestant::Full(Style::named(StyleName::ThreePass))),
        named("three-pass", Contestant::Pruned(Style::named(StyleName::ThreePass))),
        named(
            "three-pass --cull back",
            Contestant::Pruned(Style::ThreePass(Cartoon { cull_back_faces: true, ..Cartoon::default() })),
        ),
        named(
            "mrt --cull back",
            Contestant::Pruned(Style::Mrt(Mrt(Cartoon { cull_back_faces: true, ..Cartoon::default() }))),
        ),
        named("limit: the mesh once, untextured and unlit, culled", mesh_once(true)),
        named("limit: clear and one filter", filter_once(scene)),
        named("limit: clear and read back", limit("clear", vec![Step::clear([1.0; 4])])),
    ]
}

/// Adds one size's medians to the curves.
fn add(curves: &mut Vec<Curve>, series: &[Series], size: f64) {
    if curves.is_empty() {
        curves.extend(series.iter().map(|one| Curve { name: one.name.clone(), points: Vec::new() }));
    }
    for (curve, one) in curves.iter_mut().zip(series) {
        curve.points.push((size, one.median()));
    }
}

/// Prints each curve's fitted line and draws all curves.
fn finish(curves: &[Curve], title: &str, sizes: &str, file: &str) {
    println!("\n  straight lines through them: start, and nanoseconds for each of the {sizes}; the worst miss");
    for curve in curves {
        let [start, slope] = curve.line();
        println!("  {:<52}{start:>9.3} ms{:>10.3} ns{:>7.0} %", curve.name, slope * 1e6, curve.worst_miss() * 100.0);
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("target/bench").join(file);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder can be made");
    plot(curves, [title, sizes, "milliseconds a frame"], &path).expect("the plot can be drawn");
    println!("  plot: {}", path.display());
}

fn by_triangles(renderer: &mut Renderer, settings: &Settings) -> Value {
    println!("\nframes by triangles: a sphere with bumps, 512x512");
    let sizes = (0..).map(|power| 1000 << (2 * power)).take_while(|size| *size < settings.largest);
    let mut curves = Vec::new();
    let tables: Vec<Value> = sizes
        .chain([settings.largest])
        .map(|size| {
            let mesh = Arc::new(bumpy_sphere(size));
            let scene = Scene::new(vec![mesh.clone()], &SceneSettings::default()).expect("a scene");
            let start = Instant::now();
            scene.make_arrays();
            let arrays_ms = milliseconds_since(start);
            println!("\n  {} triangles; arrays {arrays_ms:.1} ms", mesh.triangles.len());
            let series = race(renderer, &scene, &contestants(&scene), settings.rounds.min(4_000_000_000 / size / 500));
            print_table(&series, "three-pass --full");
            add(&mut curves, &series, mesh.triangles.len() as f64);
            json!({ "triangles": mesh.triangles.len(), "arrays_ms": arrays_ms, "series": rows(&series) })
        })
        .collect();
    finish(&curves, "Frames of a sphere with bumps, 512 x 512", "triangles", "frame-triangles.svg");
    Value::Array(tables)
}

fn by_pixels(renderer: &mut Renderer, rounds: usize) -> Value {
    println!("\nframes by pixels: the bust, fitted");
    let mesh = Arc::new(load("builtin:bust", &LoadOptions::default()).expect("a model").mesh);
    let mut curves = Vec::new();
    let tables: Vec<Value> = [256, 512, 1024, 2048, 4096]
        .into_iter()
        .map(|side| {
            let size = Size { width: side, height: side };
            let settings = SceneSettings { size, ..SceneSettings::default() };
            let scene = Scene::new(vec![mesh.clone()], &settings).expect("a scene");
            println!("\n  {size}");
            let series = race(renderer, &scene, &contestants(&scene), rounds);
            print_table(&series, "three-pass --full");
            add(&mut curves, &series, size.pixel_count() as f64);
            json!({ "size": size, "series": rows(&series) })
        })
        .collect();
    finish(&curves, "Frames of the bust by size of the picture", "pixels", "frame-pixels.svg");
    Value::Array(tables)
}

/// Frames of each model file, and whole processes from the file to a PNG.
fn of_models(renderer: &mut Renderer, settings: &Settings) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let tables = settings.models.iter().map(|model| {
        let scene = fitted(model);
        println!("\nframes of {model}: {} triangles, {}", scene.triangle_count(), scene.size);
        let frames = race(renderer, &scene, &contestants(&scene), settings.rounds);
        print_table(&frames, "three-pass --full");
        println!("\n  cold starts, {model} to PNG");
        let looks: [&[&str]; 4] =
            [&["--style", "phong"], &["--style", "three-pass"], &["--style", "ink"], &["--look", "print"]];
        let mut starts: Vec<Series> = looks.iter().map(|look| Series::new(&look.join(" "))).collect();
        for round in 0..=settings.rounds {
            for (look, series) in looks.iter().zip(&mut starts) {
                let mut tinta = Command::new(env!("CARGO_BIN_EXE_tinta"));
                tinta.args(["render", model, "--size", "512", "-o"]).arg(folder.path().join("start.png")).args(*look);
                let start = Instant::now();
                assert!(tinta.status().expect("tinta starts").success(), "{model} {look:?}");
                // The first picture of each contestant is not counted.
                series.times.extend((round > 0).then(|| milliseconds_since(start)));
            }
        }
        print_table(&starts, "--style phong");
        json!({ "model": model, "frames": rows(&frames), "starts": rows(&starts) })
    });
    tables.collect()
}
