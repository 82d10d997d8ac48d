//! The numbers of a measured row: on made-up pictures with a known answer, and against a recount.

use crate::support::lines::{distance, view};
use crate::support::{BACKENDS, renderer, scene_with};
use glam::DVec2;
use serde_json::Value;
use tinta::edges::{Class, SilhouetteRule};
use tinta::lines::{LineSettings, first_hits};
use tinta::record::drawing_json;
use tinta::styles::{Border, Cartoon, Charcoal, Filter, Improvements, Inking, PaintMode, Tones};
use tinta::{Background, CameraSettings, Color, Mesh, Picture, Scene, SceneSettings, Show, Size, Style, StyleName};
use tinta_lab::measure::{INK_FROM, Ink, Reference, ReferenceLight, Verdict};

const SIZE: u32 = 100;

/// One triangle facing the eye: three boundary edges are all its lines.
fn triangle() -> Scene {
    let camera = view("front", true);
    let settings = SceneSettings { size: Size { width: SIZE, height: SIZE }, camera, ..SceneSettings::default() };
    Scene::new([Mesh::triangle()], &settings).unwrap()
}

fn reference(scene: &Scene) -> Reference {
    Reference::of(scene, &LineSettings::as_published()).unwrap()
}

/// Black ink where `is_ink` is true.
fn ink(is_ink: impl Fn(DVec2) -> bool) -> Ink {
    let middle = |index: u32| DVec2::new(f64::from(index % SIZE) + 0.5, f64::from(index / SIZE) + 0.5);
    let darkness = (0..SIZE * SIZE).map(|index| if is_ink(middle(index)) { 255 } else { 0 }).collect();
    Ink { size: Size { width: SIZE, height: SIZE }, darkness }
}

/// Ink on the reference, one to two pixels wide.
fn on_the_lines(reference: &Reference) -> Ink {
    ink(|middle| reference.distance_px(middle) <= 0.75)
}

#[test]
fn ink_on_the_lines_is_without_error() {
    let reference = reference(&triangle());
    let error = on_the_lines(&reference).error(&reference, 2.0);
    assert_eq!((error.recall, error.precision, error.f1), (1.0, 1.0, 1.0));
    assert!((error.average_precision - 1.0).abs() < 1e-12);
    assert!(error.reference_to_ink_px.unwrap()[0] < 0.6 && error.ink_to_reference_px.unwrap()[0] < 0.6);
    assert_eq!(error.recall_of_class.keys().collect::<Vec<_>>(), ["boundary"]);
}

#[test]
fn the_references_length_is_the_triangles() {
    // The legs span FRAME_FILL of the picture, the long side the root of two times that.
    let reference = reference(&triangle());
    let leg = 0.92 * f64::from(SIZE);
    assert!((reference.length_px() - leg * (2.0 + 2f64.sqrt())).abs() < 1e-6, "{}", reference.length_px());
}

#[test]
fn lines_moved_by_three_pixels_are_missed_within_two_and_found_within_four() {
    let reference = reference(&triangle());
    // Ink on the lower leg only, along x: moved up into the triangle it is near no other line except at its ends.
    let lowest = reference.samples.iter().map(|sample| sample.px.y).fold(0.0, f64::max);
    let (left, right) = (DVec2::new(16.0, lowest - 3.0), DVec2::new(84.0, lowest - 3.0));
    let moved = ink(|middle| (middle.y - left.y).abs() <= 0.5 && (left.x..=right.x).contains(&middle.x));
    let [near, far] = [2.0, 4.0].map(|tolerance| moved.error(&reference, tolerance));
    assert!(near.precision < 0.06, "{}", near.precision);
    assert!(far.precision > 0.94, "{}", far.precision);
    let [mean, at_95th] = near.ink_to_reference_px.unwrap();
    assert!((2.4..=3.5).contains(&mean) && (2.5..=3.6).contains(&at_95th), "{mean} {at_95th}");
}

#[test]
fn a_missing_half_halves_recall_and_leaves_precision() {
    let reference = reference(&triangle());
    // Both legs' halves next to the right angle and no other part.
    let middle = f64::from(SIZE) * 0.5;
    let whole = on_the_lines(&reference);
    let half = ink(|place| reference.distance_px(place) <= 0.75 && place.y >= middle);
    let error = half.error(&reference, 2.0);
    let kept: f64 =
        reference.samples.iter().filter(|sample| sample.px.y >= middle).map(|sample| sample.length_px).sum();
    let expected = kept / reference.length_px();
    assert!((error.recall - expected).abs() < 4.0 * 2.0 / reference.length_px() + 1e-9, "{} {expected}", error.recall);
    assert_eq!(error.precision, 1.0);
    assert!(error.f1 < whole.error(&reference, 2.0).f1);
}

#[test]
fn ink_everywhere_finds_all_and_is_as_precise_as_the_lines_are_wide() {
    let reference = reference(&triangle());
    let everywhere = ink(|_| true);
    let error = everywhere.error(&reference, 2.0);
    let near = ink(|middle| reference.distance_px(middle) <= 2.0).darkness.iter().filter(|ink| **ink > 0).count();
    assert_eq!(error.recall, 1.0);
    assert!((error.precision - near as f64 / f64::from(SIZE * SIZE)).abs() < 1e-12);
}

#[test]
fn no_ink_finds_nothing_and_invents_nothing() {
    let error = ink(|_| false).error(&reference(&triangle()), 2.0);
    assert_eq!((error.recall, error.precision, error.f1, error.average_precision), (0.0, 1.0, 0.0, 0.0));
    assert_eq!((error.reference_to_ink_px, error.ink_to_reference_px), (None, None));
}

#[test]
fn more_tolerance_finds_more_and_more_ink_never_less() {
    let reference = reference(&triangle());
    // Every third pixel of a band around the lines, faint ones among them.
    let mut sparse =
        ink(|middle| reference.distance_px(middle) <= 6.0 && ((middle.x + middle.y) as u32).is_multiple_of(3));
    sparse.darkness.iter_mut().enumerate().filter(|(index, _)| index % 2 == 0).for_each(|(_, ink)| *ink /= 5);
    let mut last = (0.0, 0.0);
    for tolerance in [0.5, 1.0, 2.0, 4.0, 8.0] {
        let error = sparse.error(&reference, tolerance);
        assert!(error.recall >= last.0 && error.precision >= last.1, "{tolerance}");
        last = (error.recall, error.precision);
    }
    let mut more = sparse.clone();
    more.darkness.iter_mut().for_each(|ink| *ink = ink.saturating_mul(2));
    assert!(more.error(&reference, 1.0).recall >= sparse.error(&reference, 1.0).recall);
}

#[test]
fn soft_creases_are_neither_missed_nor_invented() {
    let scene =
        scene_with("builtin:ant", SceneSettings { size: Size { width: 200, height: 200 }, ..SceneSettings::default() });
    let reference = reference(&scene);
    let soft = |middle: DVec2| reference.distance_to_ignored_px(middle) <= 1.0 && reference.distance_px(middle) > 4.0;
    let width = 200;
    let middle = |index: u32| DVec2::new(f64::from(index % width) + 0.5, f64::from(index / width) + 0.5);
    let darkness: Vec<u8> = (0..width * width).map(|index| if soft(middle(index)) { 255 } else { 0 }).collect();
    assert!(darkness.iter().any(|ink| *ink > 0), "the ant has soft creases away from other lines");
    let ink = Ink { size: scene.size, darkness };
    let error = ink.error(&reference, 2.0);
    assert_eq!((error.recall, error.precision), (0.0, 1.0));
    let verdicts = ink.verdicts(&reference, 2.0);
    assert!(verdicts.pixels.iter().flatten().all(|verdict| *verdict == Verdict::Ignored));
}

#[test]
fn a_rows_error_is_found_again_from_the_picture_and_the_written_lines() {
    let scene = scene_with(
        "builtin:gear",
        SceneSettings { size: Size { width: 200, height: 200 }, ..SceneSettings::default() },
    );
    let border = Some(Border { filter: Filter::Sobel, ..Border::default() });
    let style = Style::ThreePass(Cartoon { border, ..Cartoon::default() });
    let mut renderer = renderer(BACKENDS[0]);
    let picture = renderer.draw(&scene, &style.plan(&scene, Show::Borders).unwrap()).unwrap();
    let reference = reference(&scene);
    let error = Ink::on_white(&picture).error(&reference, 2.0);

    // Again, from the file: independently of the code above.
    let read = |settings: &LineSettings| -> Vec<([DVec2; 2], f64)> {
        let lines = tinta::VisibleLines::of(&scene, settings).unwrap();
        let written: Value = serde_json::from_str(&drawing_json(&lines, None, &scene).unwrap()).unwrap();
        let place = |value: &Value| DVec2::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap());
        let visible = written["segments"].as_array().unwrap().iter().filter(|segment| segment["visible"] == true);
        visible
            .map(|segment| {
                ([place(&segment["a"]), place(&segment["b"])], segment["angle_degrees"].as_f64().unwrap_or(0.0))
            })
            .collect()
    };
    let lines = read(&LineSettings::as_published());
    let soft_settings = LineSettings {
        classes: tinta::edges::ClassSet::of(&[Class::Crease]),
        crease_angle: tinta::edges::CreaseAngle::from_degrees(20.0).unwrap(),
        ..LineSettings::as_published()
    };
    let limit = LineSettings::as_published().crease_angle.degrees();
    let soft: Vec<_> = read(&soft_settings).into_iter().filter(|(_, angle)| *angle <= limit).collect();
    let inked: Vec<(DVec2, f64)> = picture
        .pixels
        .chunks_exact(4)
        .enumerate()
        .map(|(index, pixel)| (index, 255 - pixel[..3].iter().min().unwrap()))
        .filter(|(_, darkness)| *darkness >= INK_FROM)
        .map(|(index, darkness)| {
            (DVec2::new((index % 200) as f64 + 0.5, (index / 200) as f64 + 0.5), f64::from(darkness))
        })
        .collect();
    let (mut agreed, mut counted) = (0.0, 0.0);
    for (middle, darkness) in &inked {
        let is_near = |lines: &[([DVec2; 2], f64)]| lines.iter().any(|(ends, _)| distance(*middle, *ends) <= 2.0);
        if is_near(&lines) {
            agreed += darkness;
            counted += darkness;
        } else if !is_near(&soft) {
            counted += darkness;
        }
    }
    let (mut found, mut all) = (0.0, 0.0);
    for ([a, b], _) in &lines {
        let pieces = (a.distance(*b) / 0.05).ceil().max(1.0) as usize;
        for piece in 0..pieces {
            let place = a.lerp(*b, (piece as f64 + 0.5) / pieces as f64);
            let length = a.distance(*b) / pieces as f64;
            all += length;
            found += if inked.iter().any(|(middle, _)| middle.distance(place) <= 2.0) { length } else { 0.0 };
        }
    }
    assert!((error.precision - agreed / counted).abs() < 5e-4, "{} {}", error.precision, agreed / counted);
    assert!((error.recall - found / all).abs() < 5e-4, "{} {}", error.recall, found / all);
    assert!(error.precision < 1.0 && error.recall < 1.0, "there is something to find");
}

#[test]
fn a_ray_through_each_pixel_meets_the_triangle_where_it_is() {
    let scene = triangle();
    let hits = first_hits(&scene);
    let reference = reference(&scene);
    let covered = hits.iter().flatten().count() as f64;
    let leg = 0.92 * f64::from(SIZE);
    assert!((covered - leg * leg * 0.5).abs() < leg, "{covered}");
    for hit in hits.iter().flatten() {
        let [a, b, c] = hit.weights;
        assert!((a + b + c - 1.0).abs() < 1e-12 && [a, b, c].iter().all(|weight| *weight >= -1e-12));
        assert_eq!((hit.object, hit.face), (0, 0));
    }
    assert!(hits[0].is_none() && reference.distance_px(DVec2::splat(0.5)) > 2.0);
}

#[test]
fn gls_tones_are_those_of_the_rays_but_for_what_was_changed() {
    let mut renderer = renderer(BACKENDS[0]);
    for parallel in [false, true] {
        let camera = CameraSettings { parallel, ..CameraSettings::default() };
        let settings = SceneSettings {
            size: Size { width: 160, height: 160 },
            camera,
            background: Background::Color(Color([1.0; 3])),
            ..SceneSettings::default()
        };
        let scene = scene_with("builtin:bust", settings);
        let (reference, light) = (reference(&scene), ReferenceLight::of(&scene));
        let style = Style::named(StyleName::ThreePass);
        let drawn = renderer.draw(&scene, &style.plan(&scene, Show::Tones).unwrap()).unwrap();
        let against =
            |picture: &Picture, style: &Style| light.error(picture, style, &scene, &reference).unwrap().unwrap();
        let error = against(&drawn, &style);
        assert!(error.inner_px > 1000 && error.inner_differing.unwrap() < 0.005, "{error:?}");
        // The twin of one tone fewer differs exactly where the third tone is.
        let tones = Tones { count: 2, ..Tones::default() };
        let fewer = against(&drawn, &Style::ThreePass(Cartoon { tones, ..Cartoon::default() }));
        assert!(fewer.inner_differing.unwrap() > 0.01, "{fewer:?}");
        // A picture a third darker differs everywhere.
        let darker = Picture { pixels: drawn.pixels.iter().map(|byte| byte / 3 * 2).collect(), ..drawn };
        assert_eq!(against(&darker, &style).inner_differing, Some(1.0));
        // Continuous shading has no tones; the published coordinate of the paper is off in perspective (V4).
        let mut drawn = |style: &Style| renderer.draw(&scene, &style.plan(&scene, Show::Final).unwrap()).unwrap();
        let phong = Style::named(StyleName::Phong);
        let error = against(&drawn(&phong), &phong);
        assert!(error.mean_difference < 0.5 && error.inner_differing.is_none(), "{error:?}");
        let texture_size = scene.size;
        let charcoal = |improve| Style::Charcoal(Charcoal { texture_size, improve, ..Charcoal::default() });
        let mended = charcoal(Improvements { paper_coordinate: true, ..Improvements::default() });
        let error = against(&drawn(&mended), &mended);
        assert!(error.mean_difference < 1.0, "{error:?}");
        if !parallel {
            let published = charcoal(Improvements::default());
            assert!(against(&drawn(&published), &published).mean_difference > error.mean_difference);
        }
    }
}

#[test]
fn ink_over_tones_is_the_light_that_is_gone() {
    let size = Size { width: 2, height: 1 };
    let without = Picture { size, pixels: vec![200, 100, 0, 255, 80, 80, 80, 255] };
    let with = Picture { size, pixels: vec![100, 100, 0, 255, 80, 80, 80, 255] };
    assert_eq!(Ink::over(&without, &with).darkness, [128, 0]);
}

#[test]
fn exact_inking_is_nearly_without_error_and_the_papers_rule_is_not_in_perspective() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene_with("builtin:bust", SceneSettings::default());
    let reference = reference(&scene);
    let mut f1 = |silhouette| {
        let inking = Inking { silhouette, paint: PaintMode::None, ..Inking::default() };
        let style = Style::Inking(inking);
        let picture = renderer.draw(&scene, &style.plan(&scene, Show::Borders).unwrap()).unwrap();
        Ink::on_white(&picture).error(&reference, 2.0).f1
    };
    let (exact, paper) = (f1(SilhouetteRule::Exact), f1(SilhouetteRule::Published));
    assert!(exact > paper && exact > 0.9, "{exact} {paper}");
}

#[test]
fn recall_counts_length_and_not_pieces() {
    let scene = scene_with(
        "builtin:ant",
        SceneSettings { size: Size { width: SIZE, height: SIZE }, ..SceneSettings::default() },
    );
    let reference = reference(&scene);
    let is_inked = |middle: DVec2| middle.x < f64::from(SIZE) * 0.5;
    let error = ink(is_inked).error(&reference, 2.0);

    let middles = (0..SIZE * SIZE).map(|at| DVec2::new(f64::from(at % SIZE) + 0.5, f64::from(at / SIZE) + 0.5));
    let inked: Vec<DVec2> = middles.filter(|middle| is_inked(*middle)).collect();
    let is_found = |px: DVec2| inked.iter().any(|middle| middle.distance_squared(px) <= 4.0);
    let share = |weight: fn(f64) -> f64| {
        let sum = |found_only: bool| -> f64 {
            let counted = reference.samples.iter().filter(|sample| !found_only || is_found(sample.px));
            counted.map(|sample| weight(sample.length_px)).sum()
        };
        sum(true) / sum(false)
    };
    let [by_length, by_pieces] = [share(|length| length), share(|_| 1.0)];
    assert!((error.recall - by_length).abs() < 1e-12, "{} {by_length}", error.recall);
    assert!((by_length - by_pieces).abs() > 1e-3, "{by_length} {by_pieces}: pieces differ in length");
}
