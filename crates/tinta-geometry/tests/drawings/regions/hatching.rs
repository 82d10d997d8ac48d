//! Hatching: strokes lie in their tones as rays find these, cover them evenly, and keep their places from view to view.

use super::{NEAR_BORDER_PX, distance, rules, tone};
use crate::support::families::{KINDS, scene_of_kind};
use crate::support::lines::{scenes_wanted, view};
use crate::support::shapes::{self, Random};
use crate::support::{builtin, public_meshes};
use glam::{DVec2, DVec3};
use tinta::camera::Projection;
use tinta::lines::{
    Areas, Hatch, Hatching, Hit, Length, PageSize, Progress, Region, Regions, Sight, ToneRule, TonedSurface, chain,
    hatches, svg_of_paths,
};
use tinta::mesh::Normals;
use tinta::{CameraSettings, DrawingSettings, LoadOptions, Mesh, Scene, SceneSettings, Size, VisibleLines};

/// The brightest tone of a rule.
fn brightest(rule: &ToneRule) -> u8 {
    rule.thresholds.iter().filter(|threshold| **threshold <= 1.0).count() as u8
}

/// Strokes of one direction.
#[derive(Debug)]
struct Straight {
    tone: u8,
    strokes: Vec<[DVec2; 2]>,
}

fn settings(spacing: Length, angle_degrees: f64) -> DrawingSettings {
    let hatching = Hatching { spacing: Some(spacing), angle_degrees: Some(angle_degrees) };
    DrawingSettings { hatching, min_length: Some(Length::Px(0.0)), ..DrawingSettings::default() }
}

fn hatched(
    scene: &Scene,
    regions: &Regions<Option<TonedSurface>>,
    rule: &ToneRule,
    settings: &DrawingSettings,
) -> tinta::Result<Vec<Straight>> {
    let found =
        hatches(&Sight::of(scene), (rule, regions), &VisibleLines::none(scene.size), settings, &Progress::default())?;
    let ends = |stroke: Vec<DVec2>| <[DVec2; 2]>::try_from(stroke).unwrap();
    let straight = |Hatch { tone, strokes }: Hatch| Straight { tone, strokes: strokes.into_iter().map(ends).collect() };
    Ok(found.into_iter().map(straight).collect())
}

/// A scene whose meshes have smooth normals, or those of their faces.
fn with_normals(mut scene: Scene, is_smooth: bool) -> Scene {
    let normals = if is_smooth { Normals::Dachsbacher } else { Normals::Flat };
    for object in &mut scene.objects {
        let (positions, options) = (object.mesh.positions.clone(), LoadOptions { normals, ..LoadOptions::default() });
        object.mesh = Mesh::of_triangles("made", positions, &object.mesh.triangles, &options).unwrap().into();
    }
    scene
}

/// The image of a point of the eye's space.
fn image(scene: &Scene, view: DVec3) -> DVec2 {
    let half = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height)) * 0.5;
    let scale = match scene.camera.projection {
        Projection::Perspective { fov_y_degrees } => half.y / (fov_y_degrees.to_radians() * 0.5).tan() / -view.z,
        Projection::Parallel { height } => 2.0 * half.y / height,
    };
    half + DVec2::new(view.x, -view.y) * scale
}

/// The depths and tones of all faces that the ray through a place hits, the nearest first.
fn tones_at(scene: &Scene, rule: &ToneRule, px: DVec2) -> Vec<(f64, u8)> {
    let half = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height)) * 0.5;
    let flat = DVec2::new(px.x - half.x, half.y - px.y);
    let (origin, along) = match scene.camera.projection {
        Projection::Perspective { fov_y_degrees } => {
            let focal = half.y / (fov_y_degrees.to_radians() * 0.5).tan();
            (DVec3::ZERO, (flat / focal).extend(-1.0))
        }
        Projection::Parallel { height } => ((flat * (height / (2.0 * half.y))).extend(0.0), DVec3::NEG_Z),
    };
    let to_view = scene.camera.view_from_world();
    let mut hits = Vec::new();
    for (number, object) in scene.objects.iter().enumerate() {
        let places: Vec<DVec3> =
            object.mesh.positions.iter().map(|position| to_view.transform_point3(*position + object.offset)).collect();
        for (face, corners) in object.mesh.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|corner| places[corner as usize]);
            // Möller and Trumbore 1997.
            let (right, up) = (b - a, c - a);
            let across = along.cross(up);
            let volume = right.dot(across);
            let from = origin - a;
            let v = from.dot(across) / volume;
            let w = along.dot(from.cross(right)) / volume;
            let depth = up.dot(from.cross(right)) / volume;
            let is_drawn = (scene.camera.near..=scene.camera.far).contains(&depth);
            if v >= 0.0 && w >= 0.0 && v + w <= 1.0 && is_drawn {
                let hit = Hit { object: number as u32, face: face as u32, weights: [1.0 - v - w, v, w], depth };
                hits.push((depth, tone(scene, rule, &hit)));
            }
        }
    }
    hits.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    hits
}

/// Whether a place has a tone up to this one: what a ray hits first, or what touches it there.
fn has_tone(scene: &Scene, rule: &ToneRule, px: DVec2, most: u8) -> bool {
    let hits = tones_at(scene, rule, px);
    let Some((nearest, _)) = hits.first() else { return false };
    hits.iter().take_while(|(depth, _)| depth - nearest <= 1e-6 * scene.radius).any(|(_, tone)| *tone <= most)
}

fn is_inside(region: &Region<()>, px: DVec2) -> bool {
    let sides = region.loops.iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
    let is_right = |(a, b): &(&DVec2, &DVec2)| {
        (a.y > px.y) != (b.y > px.y) && a.x + (b.x - a.x) * ((px.y - a.y) / (b.y - a.y)) > px.x
    };
    sides.filter(is_right).count() % 2 == 1
}

#[derive(Debug, Default)]
struct StrokeTally {
    strokes: usize,
    samples: usize,
    wrong: usize,
    regions: usize,
    length_times_spacing: f64,
    area: f64,
}

/// Checks the strokes of a scene, with rays along at most so many of each direction.
fn check(name: &str, scene: &Scene, random: &mut Random, most_strokes: usize, all: &mut StrokeTally) {
    for rule in rules() {
        let regions = Regions::toned(&Sight::of(scene), &rule, &Progress::default()).unwrap();
        let (spacing, angle) = (2.0 + 14.0 * random.number(), -90.0 + 180.0 * random.number());
        let found = hatched(scene, &regions, &rule, &settings(Length::Px(spacing), angle)).unwrap();
        assert_eq!(
            found.iter().map(|hatch| hatch.tone).collect::<Vec<_>>(),
            (0..brightest(&rule)).rev().collect::<Vec<_>>()
        );
        for Straight { tone, strokes } in &found {
            let turned = if (brightest(&rule), *tone) == (2, 0) { angle + 90.0 } else { angle };
            let along = DVec2::from_angle(-turned.to_radians());
            let area = regions.joined(|seen| seen.filter(|it| it.tone <= *tone).map(|_| ()));
            // A sum over equidistant lines misses an integral by at most the spacing times the variation of what is summed:
            // how much of a line is inside changes by the sides along it.
            let total: f64 = strokes.iter().map(|[from, to]| from.distance(*to)).sum();
            let whole: f64 = area.regions.iter().map(|region| region.area_px).sum();
            let sides = |corners: &Vec<DVec2>| -> f64 {
                corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (*b - *a).dot(along).abs()).sum()
            };
            let variation: f64 = area.regions.iter().flat_map(|region| &region.loops).map(sides).sum();
            assert!(
                (total * spacing - whole).abs() <= spacing * variation + 1e-6,
                "{name}: {total} x {spacing}, {whole}"
            );
            all.length_times_spacing += total * spacing;
            all.area += whole;
            let view = scene.camera.view_from_world().transform_point3(scene.centre);
            // What lies before the near plane has no image: then lines run through the picture's middle.
            let middle = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height)) * 0.5;
            let centre = if -view.z > scene.camera.near { image(scene, view) } else { middle };
            for [from, to] in strokes {
                assert!(
                    (*to - *from).normalize().dot(along) > 1.0 - 1e-6 || from.distance(*to) < 1e-3,
                    "{name}: {from} {to}"
                );
                let line = along.perp_dot(*from - centre) / spacing;
                assert!((line - line.round()).abs() < 1e-5, "{name}: line {line}");
            }
            for region in &area.regions {
                let across = |px: &DVec2| along.perp_dot(*px);
                let places = || region.loops[0].iter().map(across);
                let width = places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min);
                if width > spacing * (1.0 + 1e-9) {
                    all.regions += 1;
                    let middle = |[from, to]: &[DVec2; 2]| from.lerp(*to, 0.5);
                    assert!(
                        strokes.iter().any(|stroke| is_inside(region, middle(stroke))),
                        "{name}: {:?}",
                        region.loops
                    );
                }
            }
            all.strokes += strokes.len();
            for stroke in strokes.iter().step_by(strokes.len() / most_strokes + 1) {
                let [from, to] = *stroke;
                for share in [0.0, random.number(), random.number(), 1.0] {
                    let px = from.lerp(to, share);
                    let is_near = || {
                        let mut loops = area.regions.iter().flat_map(|region| &region.loops);
                        loops.any(|corners| distance(corners, px) < NEAR_BORDER_PX)
                    };
                    all.samples += 1;
                    if !has_tone(scene, &rule, px, *tone) && !is_near() {
                        all.wrong += 1;
                        println!("{name}: {px} of {from} to {to} is not of tone {tone}");
                    }
                }
            }
        }
    }
}

fn judge(all: &StrokeTally) {
    println!("{all:?}");
    assert!(all.strokes > 0 && all.regions > 0 && all.wrong as f64 <= 1e-5 * all.samples as f64, "{all:?}");
    assert!((all.length_times_spacing / all.area - 1.0).abs() < 0.01, "{all:?}");
}

fn check_families(count: u64) {
    let mut all = StrokeTally::default();
    for seed in 1..=count {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        let scene = with_normals(scene, seed % 3 == 0);
        check(&format!("{name}, seed {seed}"), &scene, &mut random, 60, &mut all);
    }
    judge(&all);
}

#[test]
fn strokes_lie_in_their_tones_and_cover_them_in_every_family_briefly() {
    check_families(KINDS as u64);
}

#[test]
#[ignore = "exhaustive: three scenes of each family, or as many scenes as TINTA_LINE_SCENES says"]
fn strokes_lie_in_their_tones_and_cover_them_in_many_scenes() {
    check_families(scenes_wanted().unwrap_or(3 * KINDS as u64));
}

#[test]
fn strokes_of_public_models_lie_in_their_tones() {
    let models = public_meshes(&["cow.obj", "teapot.obj", "suzanne.obj"]);
    let mut all = StrokeTally::default();
    for (name, mesh) in &models {
        let settings = SceneSettings { camera: view("30,23", false), ..SceneSettings::default() };
        let scene = Scene::new([mesh.clone()], &settings).unwrap();
        check(name, &scene, &mut Random::seeded(1), 40, &mut all);
    }
    if !models.is_empty() {
        judge(&all);
    }
}

fn ball(camera: CameraSettings, size: Size) -> Scene {
    let scene =
        Scene::new([shapes::icosphere(3)], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
    with_normals(scene, true)
}

const SIZE: Size = Size { width: 512, height: 512 };

/// A view that does not look at the middle, turned by so many degrees.
fn looking_past(degrees: f64) -> CameraSettings {
    let eye = DVec3::new(4.0 * degrees.to_radians().sin(), 1.0, 4.0 * degrees.to_radians().cos());
    CameraSettings { eye: Some(eye), target: Some(DVec3::new(0.3, 0.1, -0.2)), ..CameraSettings::default() }
}

#[test]
fn strokes_move_with_the_scene_from_view_to_view() {
    let [_, rule, _] = rules();
    let lines_of = |degrees: f64| {
        let scene = ball(looking_past(degrees), SIZE);
        let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
        let found = hatched(&scene, &regions, &rule, &settings(Length::Px(9.0), 30.0)).unwrap();
        let centre = image(&scene, scene.camera.view_from_world().transform_point3(scene.centre));
        let along = DVec2::from_angle(-30f64.to_radians());
        let lines = found[0].strokes.iter().map(|[from, _]| along.perp_dot(*from - centre) / 9.0);
        (centre, lines.map(|line| line.round() as i64).collect::<std::collections::BTreeSet<_>>())
    };
    let [(centre, lines), (moved, others)] = [20.0, 20.5].map(lines_of);
    assert!(centre.distance(moved) > 0.1 && centre.distance(DVec2::splat(256.0)) > 20.0, "{centre} {moved}");
    // The ball is as large in both: the same lines cross it, except at its ends.
    assert!(lines.len() > 20 && lines.symmetric_difference(&others).count() <= 2, "{lines:?} {others:?}");
}

#[test]
fn spacing_is_in_millimetres_on_paper_or_in_widths_of_a_stroke() {
    let [rule, ..] = rules();
    let scene = ball(view("30,23", false), SIZE);
    let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
    let gap = |settings: &DrawingSettings| {
        let found = hatched(&scene, &regions, &rule, settings).unwrap();
        let mut places: Vec<f64> = found[0].strokes.iter().map(|[from, _]| from.y).collect();
        places.sort_unstable_by(f64::total_cmp);
        places.windows(2).map(|pair| pair[1] - pair[0]).find(|gap| *gap > 1e-6).unwrap()
    };
    let on_paper = DrawingSettings { page_size: PageSize::WidthMm(256.0), ..settings(Length::Mm(3.0), 0.0) };
    assert!((gap(&on_paper) - 6.0).abs() < 1e-9);
    let sheet = PageSize::Paper("A4".parse().unwrap());
    let [low, high] = Areas::around(&regions).corners_px.unwrap();
    let px_per_mm = ((high - low) / DVec2::new(180.0, 267.0)).max_element();
    let on_sheet = DrawingSettings { page_size: sheet, ..settings(Length::Mm(3.0), 0.0) };
    assert!((gap(&on_sheet) - 3.0 * px_per_mm).abs() < 1e-9, "{px_per_mm}");
    // Of `auto`, whatever the style's lines are.
    for line_width in [Length::Px(2.5), Length::Percent(0.4), Length::ScreenOrPaper { percent: 0.3, mm: 0.35 }] {
        let auto = settings(Length::Times(6.0), 0.0);
        let auto = DrawingSettings { line_width: Some(line_width), page_size: sheet, ..auto };
        assert!((gap(&auto) - 1.2 * px_per_mm).abs() < 1e-9, "{line_width}");
    }
    let mut wide = settings(Length::Times(4.0), 0.0);
    assert!((gap(&wide) - 3.2).abs() < 1e-9, "0.4 of 2 pixels");
    wide.class_widths = "hatch=2.5".parse().unwrap();
    assert!((gap(&wide) - 10.0).abs() < 1e-9);
}

#[test]
fn one_tone_has_no_strokes_and_too_many_are_refused_before_they_are_made() {
    let [rule, ..] = rules();
    let size = Size { width: 4096, height: 4096 };
    let scene = ball(view("front", true), size);
    let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
    let lines = VisibleLines::none(size);
    let one = ToneRule { thresholds: [2.0; 2], ..rule };
    for hatching in [settings(Length::Px(5.0), 45.0), along_form(5.0)] {
        assert!(
            hatches(&Sight::of(&scene), (&one, &regions), &lines, &hatching, &Progress::default()).unwrap().is_empty()
        );
    }
    let refused = hatched(&scene, &regions, &rule, &settings(Length::Px(0.001), 45.0)).unwrap_err().to_string();
    assert!(refused.starts_with("hatch 0.001: this makes ") && refused.contains("at most 1000000;"), "{refused}");
}

#[test]
fn a_drawing_has_a_layer_of_strokes_for_each_tone_and_lines_alone_have_none() {
    let [rule, ..] = rules();
    let scene = ball(view("30,23", false), SIZE);
    let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
    let lines = VisibleLines::of(&scene, &tinta::LineSettings::default()).unwrap();
    let mut settings = settings(Length::Px(8.0), 45.0);
    settings.class_colors = "hatch=#010203".parse().unwrap();
    let strokes = hatches(&Sight::of(&scene), (&rule, &regions), &lines, &settings, &Progress::default()).unwrap();
    let counts: Vec<usize> = strokes.iter().map(|hatch| hatch.strokes.len()).collect();
    let areas = Areas { hatches: strokes, ..Areas::around(&regions) };
    for is_for_pen in [false, true] {
        let settings = DrawingSettings { is_for_pen, ..settings.clone() };
        let text = svg_of_paths(&lines, chain(&lines.segments), Some(&areas), &settings).unwrap();
        let layers: Vec<&str> = text.split("<g ").skip(1).collect();
        for (layer, (tone, count)) in layers.iter().zip([1, 0].into_iter().zip(&counts)) {
            let head = format!(r#"id="hatch-{tone}" inkscape:groupmode="layer" inkscape:label="hatch {tone}""#);
            assert!(layer.starts_with(&head) && layer.contains(&format!(r#"data-tone="{tone}""#)), "{layer}");
            assert!(layer.contains(r##"stroke="#010203""##));
            assert_eq!(layer.matches("<path d=").count(), *count);
        }
        assert!(layers[2].starts_with(r#"id="visible-"#), "{}", layers[2]);
    }
    let refused = svg_of_paths(&lines, chain(&lines.segments), None, &settings).unwrap_err().to_string();
    assert!(refused.starts_with("hatch: lines alone have no tones"), "{refused}");
}

fn along_form(spacing_px: f64) -> DrawingSettings {
    let hatching = Hatching { spacing: Some(Length::Px(spacing_px)), angle_degrees: None };
    DrawingSettings { hatching, min_length: Some(Length::Px(0.0)), ..DrawingSettings::default() }
}

/// The strokes along the form.
fn formed(scene: &Scene, rule: &ToneRule, spacing_px: f64) -> Vec<Vec<DVec2>> {
    let regions = Regions::toned(&Sight::of(scene), rule, &Progress::default()).unwrap();
    let lines = VisibleLines::none(scene.size);
    let found =
        hatches(&Sight::of(scene), (rule, &regions), &lines, &along_form(spacing_px), &Progress::default()).unwrap();
    assert_eq!(found.iter().map(|hatch| hatch.tone).collect::<Vec<_>>(), [brightest(rule) - 1]);
    found.into_iter().flat_map(|hatch| hatch.strokes).collect()
}

/// Points along strokes, about one for each of so many pixels.
fn samples(strokes: &[Vec<DVec2>], every_px: f64) -> impl Iterator<Item = DVec2> + '_ {
    strokes.iter().flat_map(|stroke| stroke.windows(2)).flat_map(move |ends| {
        let count = (ends[0].distance(ends[1]) / every_px).ceil() as usize;
        (0..count).map(move |sample| ends[0].lerp(ends[1], (sample as f64 + 0.5) / count as f64))
    })
}

fn distance_to(strokes: &[Vec<DVec2>], px: DVec2) -> f64 {
    strokes.iter().map(|stroke| distance_to_polyline(stroke, px)).fold(f64::INFINITY, f64::min)
}

fn distance_to_polyline(stroke: &[DVec2], px: DVec2) -> f64 {
    let to_piece = |ends: &[DVec2]| {
        let along = ends[1] - ends[0];
        let share = ((px - ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        px.distance(ends[0] + along * share)
    };
    stroke.windows(2).map(to_piece).fold(f64::INFINITY, f64::min)
}

#[test]
fn strokes_along_the_form_lie_in_their_tones_in_every_family() {
    let (mut samples_seen, mut wrong) = (0, 0);
    for seed in 1..=KINDS as u64 {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        let scene = with_normals(scene, seed % 3 == 0);
        for rule in rules() {
            let strokes = formed(&scene, &rule, 6.0);
            let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
            let dark = regions.joined(|seen| seen.filter(|it| it.tone < brightest(&rule)).map(|_| ()));
            for px in samples(&strokes, 8.0).step_by(1 + strokes.len() / 100) {
                let mut loops = dark.regions.iter().flat_map(|region| &region.loops);
                samples_seen += 1;
                if !has_tone(&scene, &rule, px, brightest(&rule) - 1)
                    && !loops.any(|it| distance(it, px) < NEAR_BORDER_PX)
                {
                    wrong += 1;
                    println!("{name}, seed {seed}: {px}");
                }
            }
        }
    }
    println!("{samples_seen} samples");
    assert!(samples_seen > 5000 && f64::from(wrong) <= 1e-4 * f64::from(samples_seen), "{wrong} of {samples_seen}");
}

/// The diameter of the largest circle in an area, whose middle lies on a grid.
fn width_px(area: &Region<()>) -> f64 {
    const STEP: f64 = 0.5;
    let corners = || area.loops.iter().flatten().copied();
    let (low, high) = (corners().reduce(DVec2::min).unwrap(), corners().reduce(DVec2::max).unwrap());
    let count = ((high - low) / STEP).ceil();
    let at = |row: u32, column: u32| low + DVec2::new(f64::from(column), f64::from(row)) * STEP;
    let places = (0..=count.y as u32).flat_map(|row| (0..=count.x as u32).map(move |column| at(row, column)));
    let radius = |px: DVec2| area.loops.iter().map(|corners| distance(corners, px)).fold(f64::INFINITY, f64::min);
    2.0 * places.filter(|px| is_inside(area, *px)).map(radius).fold(0.0, f64::max)
}

#[test]
fn an_area_without_a_stroke_is_narrower_than_the_distance_of_strokes() {
    const SPACING_PX: f64 = 6.0;
    let [_, rule, _] = rules();
    let (mut small, mut empty) = (0, 0);
    for (model, camera) in ["ant", "car"]
        .iter()
        .flat_map(|model| ["30,23", "front", "80,10", "200,40", "310,20", "120,5"].map(|camera| (model, camera)))
    {
        let settings = SceneSettings { camera: view(camera, false), size: SIZE, ..SceneSettings::default() };
        let scene = Scene::new([builtin(model)], &settings).unwrap();
        let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
        let strokes = DrawingSettings { min_length: None, ..along_form(SPACING_PX) };
        let lines = VisibleLines::none(scene.size);
        let found = hatches(&Sight::of(&scene), (&rule, &regions), &lines, &strokes, &Progress::default()).unwrap();
        let strokes: Vec<Vec<DVec2>> = found.into_iter().flat_map(|hatch| hatch.strokes).collect();
        for tone in 0..brightest(&rule) {
            let of_tone = regions.joined(|seen| seen.filter(|surface| surface.tone == tone).map(|_| ()));
            for area in of_tone.regions.iter().filter(|area| area.area_px >= 150.0) {
                let is_small = area.area_px < 280.0;
                let is_empty = !samples(&strokes, 1.0).any(|px| is_inside(area, px));
                small += usize::from(is_small);
                empty += usize::from(is_small && is_empty);
                // A face keeps the distance to a factor of 1.4; a brighter tone has twice that of a darker one.
                let most_px = 1.4 * SPACING_PX * f64::from(1 << tone);
                let width_px = if is_empty { width_px(area) } else { 0.0 };
                assert!(width_px < most_px, "{model} from {camera}, tone {tone}: {width_px} px wide");
            }
        }
    }
    assert!(small > 20 && empty <= 2, "{empty} of {small}");
}

#[test]
fn a_view_turned_by_a_degree_moves_strokes_along_the_form_with_the_surface() {
    let [_, rule, _] = rules();
    let of = |degrees: f64| {
        let eye = DVec3::new(4.0 * degrees.to_radians().sin(), 1.0, 4.0 * degrees.to_radians().cos());
        let scene = ball(CameraSettings { eye: Some(eye), ..CameraSettings::default() }, SIZE);
        let strokes = formed(&scene, &rule, 8.0);
        (scene, strokes)
    };
    let ((scene, strokes), (turned, others)) = (of(20.0), of(21.0));
    let (mut all, mut stayed) = (0, 0);
    for px in samples(&strokes, 20.0) {
        let hits = tinta::lines::first_hits(&scene);
        let Some(hit) = hits[px.y as usize * SIZE.width as usize + px.x as usize] else { continue };
        // The point of the surface itself, on the plane of the face that is seen.
        let mesh = &scene.objects[0].mesh;
        let [a, b, c] = mesh.triangles[hit.face as usize].map(|corner| mesh.positions[corner as usize]);
        let to_view = scene.camera.view_from_world();
        let [a, b, c] = [a, b, c].map(|corner| to_view.transform_point3(corner));
        let half = DVec2::splat(256.0);
        let Projection::Perspective { fov_y_degrees } = scene.camera.projection else { panic!("a perspective view") };
        let focal = half.y / (fov_y_degrees.to_radians() * 0.5).tan();
        let ray = DVec3::new((px.x - half.x) / focal, (half.y - px.y) / focal, -1.0);
        let across = (b - a).cross(c - a);
        let point = ray * (across.dot(a) / across.dot(ray));
        let moved =
            image(&turned, turned.camera.view_from_world().transform_point3(to_view.inverse().transform_point3(point)));
        all += 1;
        stayed += usize::from(distance_to(&others, moved) < 0.3);
    }
    // The rest is where a tone ends, or where the ball turns away.
    assert!(all > 200 && stayed as f64 > 0.9 * all as f64, "{stayed} of {all}");
}

#[test]
fn each_face_of_a_block_has_strokes_of_its_own_direction_at_the_distance_asked_for() {
    let block = shapes::cuboid(DVec3::ZERO, DVec3::new(3.0, 2.0, 4.0));
    let seen = |camera| {
        let settings = SceneSettings { camera, size: SIZE, ..SceneSettings::default() };
        with_normals(Scene::new([block.clone()], &settings).unwrap(), false)
    };
    let scene = seen(view("30,30", true));
    // Every face is dark.
    let rule = ToneRule { thresholds: [0.999, 2.0], ..rules()[0] };
    let mut directions: Vec<DVec2> = Vec::new();
    for stroke in formed(&scene, &rule, 8.0) {
        let along = (stroke[stroke.len() - 1] - stroke[0]).normalize();
        if !directions.iter().any(|known| known.perp_dot(along).abs() < 1e-3) {
            directions.push(along);
        }
    }
    assert!(directions.len() >= 2, "{directions:?}");
    let front = seen(view("front", false));
    let mut rows: Vec<f64> = formed(&front, &rule, 8.0).iter().map(|stroke| stroke[0].y).collect();
    rows.sort_unstable_by(f64::total_cmp);
    let gaps: Vec<f64> = rows.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 0.5).collect();
    assert!(gaps.len() > 10 && gaps.iter().all(|gap| (0.7..1.42).contains(&(gap / 8.0))), "{gaps:?}");
}

/// Two squares that overlap in one plane: strokes of the first alone lie where both are.
#[test]
fn where_sheets_lie_on_one_another_one_has_strokes() {
    let square = |from: f64| {
        let at = |x: f64, y: f64| DVec3::new(from + x, y, 0.0);
        shapes::mesh(vec![at(0.0, 0.0), at(2.0, 0.0), at(2.0, 2.0), at(0.0, 2.0)], vec![[0, 1, 2], [0, 2, 3]])
    };
    let rule = ToneRule { thresholds: [0.999, 2.0], ..rules()[0] };
    let total = |meshes: Vec<Mesh>| {
        let settings = SceneSettings { camera: view("front", true), size: SIZE, ..SceneSettings::default() };
        let scene = with_normals(Scene::new(meshes, &settings).unwrap(), false);
        let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
        let seen = regions.regions.iter().filter(|region| region.seen.is_some());
        let area: f64 = seen.map(|region| region.area_px).sum();
        let strokes = formed(&scene, &rule, 8.0);
        strokes.iter().flat_map(|stroke| stroke.windows(2)).map(|ends| ends[0].distance(ends[1])).sum::<f64>() / area
    };
    let [one, both] = [vec![square(0.0)], vec![square(0.0), square(1.0)]].map(total);
    assert!((both / one - 1.0).abs() < 0.2, "length of strokes by area: {one} of one, {both} of both");
}
