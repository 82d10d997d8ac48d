//! The improved variants of image-space ink: each has its option's effect and no other.

use crate::support::lines::view;
use crate::support::{BACKENDS, renderer, scene, scene_with};
use glam::DVec3;
use std::sync::Arc;
use tinta::mesh::Normals;
use tinta::plan::{Step, Value};
use tinta::renderer::StepPicture;
use tinta::styles::{Border, Cartoon, Filter, Ink, LineWidth, MapEncoding, MapTarget, Quality, Supersample};
use tinta::{CameraSettings, LoadOptions, Mesh, Picture, Renderer, Scene, SceneSettings, Show, Size, Style};

const SIZE: Size = Size { width: 160, height: 160 };

/// A scene of quads with a normal a face, by their corners.
fn quads(corners: &[[DVec3; 4]], camera: CameraSettings) -> Scene {
    let options = LoadOptions { normals: Normals::Flat, ..LoadOptions::default() };
    let numbers: Vec<u32> = (0..4 * corners.len() as u32).collect();
    let mesh = Mesh::of_polygons("made", corners.concat(), &numbers, vec![4; corners.len()], &options).unwrap();
    Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, size: SIZE, ..SceneSettings::default() }).unwrap()
}

/// A rectangle of the ground.
fn ground(half: f64) -> [DVec3; 4] {
    [[-half, half], [half, half], [half, -half], [-half, -half]].map(|[x, z]| DVec3::new(x, 0.0, z))
}

fn three_pass(border: Border, map_encoding: MapEncoding) -> Style {
    Style::ThreePass(Cartoon { border: Some(border), map_encoding, ..Cartoon::default() })
}

fn borders(renderer: &mut Renderer, scene: &Scene, style: &Style) -> Picture {
    renderer.draw(scene, &style.plan(scene, Show::Borders).unwrap()).unwrap()
}

/// How dark a pixel of ink on white is, 0 to 1.
fn ink(picture: &Picture, x: i64, y: i64) -> f64 {
    1.0 - f64::from(picture.pixel(x, y)[0]) / 255.0
}

/// The ink of all pixels at least `margin` away from everything but this surface, by a picture of its tones on white.
fn inner_ink(renderer: &mut Renderer, scene: &Scene, style: &Style, margin: i64) -> f64 {
    let lines = borders(renderer, scene, style);
    let tones = renderer.draw(scene, &style.plan(scene, Show::Tones).unwrap()).unwrap();
    let is_surface = |x, y| tones.pixel(x, y) != [255; 4];
    let places = (margin..160 - margin).flat_map(|y| (margin..160 - margin).map(move |x| (x, y)));
    let around = |x: i64, y: i64| (-margin..=margin).all(|dy| (-margin..=margin).all(|dx| is_surface(x + dx, y + dy)));
    let inside: Vec<_> = places.filter(|(x, y)| around(*x, *y)).collect();
    assert!(inside.len() > 100, "only {} pixels lie inside", inside.len());
    // Fainter than this is the rounding of normals that are the same.
    inside.iter().map(|(x, y)| ink(&lines, *x, *y)).filter(|ink| *ink > 0.1).sum()
}

#[test]
fn a_plane_at_a_grazing_angle_draws_no_ink_where_the_threshold_knows_its_slope() {
    let mut renderer = renderer(BACKENDS[0]);
    for parallel in [false, true] {
        // At 8 degrees the surface recedes by 7 pixels' widths from one to the next.
        let scene = quads(&[ground(1.0)], view("20,8", parallel));
        let sobel = Border { filter: Filter::Sobel, detection_factor: 1.0, ..Border::default() };
        let published = inner_ink(&mut renderer, &scene, &three_pass(sobel, MapEncoding::Published), 3);
        assert!(published > 10.0, "a gradient answers to the slope: {published}");
        let with_depth = MapEncoding::ALL.into_iter().filter(|(_, encoding)| *encoding != MapEncoding::Numbers);
        for (name, encoding) in with_depth {
            let threshold = Border { slope_threshold: true, ..sobel };
            let found = inner_ink(&mut renderer, &scene, &three_pass(threshold, encoding), 3);
            assert_eq!(found, 0.0, "{name}, parallel {parallel}");
        }
        let found = inner_ink(&mut renderer, &scene, &Style::Ink(Ink::default()), 3);
        assert_eq!(found, 0.0, "ink, parallel {parallel}");
    }
}

#[test]
fn steps_of_equal_size_in_pixels_are_lines_near_the_eye_and_far_from_it() {
    let mut renderer = renderer(BACKENDS[0]);
    // Cards that face the eye, each with another 6 pixels' widths behind it, from 10 to 1,000 units away.
    let card = |x: f64, distance: f64, right: f64| {
        let corners = [[-0.1, -0.1], [right, -0.1], [right, 0.1], [-0.1, 0.1]];
        corners.map(|[dx, dy]| DVec3::new((x + dx) * distance, dy * distance, -distance))
    };
    let places = [(-0.15, 10.0), (0.15, 1000.0)];
    let cards: Vec<_> = places.iter().flat_map(|(x, d)| [card(*x, *d, 0.0), card(*x, d * 1.02, 0.1)]).collect();
    let camera = CameraSettings {
        eye: Some(DVec3::ZERO),
        target: Some(-DVec3::Z),
        near: Some(5.0),
        far: Some(2000.0),
        ..CameraSettings::default()
    };
    let scene = quads(&cards, camera);
    let column = |x: f64| (80.0 + 80.0 * x / 15f64.to_radians().tan()) as i64;
    let styles = [
        Style::Ink(Ink::default()),
        three_pass(Border { slope_threshold: true, ..Border::default() }, MapEncoding::DepthTexture),
        three_pass(Border::default(), MapEncoding::DepthTexture),
    ];
    let found = styles.map(|style| {
        let picture = borders(&mut renderer, &scene, &style);
        places.map(|(x, _)| (-2..=2).map(|dx| ink(&picture, column(x) + dx, 80)).fold(0.0, f64::max))
    });
    assert_eq!(found[0][0], 1.0, "ink, near: {found:?}");
    assert_eq!(found[1], [1.0; 2], "the threshold answers to both: {found:?}");
    assert!(found[2].iter().all(|ink| *ink < 0.1), "the filter does not: {found:?}");
}

#[test]
fn ink_draws_a_crease_of_thirty_five_degrees_and_none_of_twenty_five() {
    let mut renderer = renderer(BACKENDS[0]);
    for parallel in [false, true] {
        for (angle, is_line) in [(10.0f64, false), (25.0, false), (35.0, true), (90.0, true)] {
            let half = (angle * 0.5).to_radians();
            let (back, side) = (-half.sin(), half.cos());
            let left = [[-side, -1.0, back], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [-side, 1.0, back]];
            let right = [[0.0, -1.0, 0.0], [side, -1.0, back], [side, 1.0, back], [0.0, 1.0, 0.0]];
            for turned in ["0,0", "12,5"] {
                let scene = quads(&[left.map(DVec3::from_array), right.map(DVec3::from_array)], view(turned, parallel));
                let found = inner_ink(&mut renderer, &scene, &Style::Ink(Ink::default()), 4);
                assert_eq!(found > 100.0, is_line, "{angle} degrees from {turned}, parallel {parallel}: {found}");
            }
        }
    }
}

#[test]
fn a_straight_outline_is_as_wide_as_asked_for() {
    let mut renderer = renderer(BACKENDS[0]);
    let wall = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let behind = wall.map(|corner| corner * 1.6 - DVec3::Z);
    let scene = quads(&[wall, behind], view("front", true));
    let mut check = |name: &str, style: &Style, width: u32| {
        let picture = borders(&mut renderer, &scene, style);
        // Row 80 crosses the wall's left edge once between these columns.
        let found: f64 = (20..80).map(|x| ink(&picture, x, 80)).sum();
        assert!((found - f64::from(width)).abs() < 0.02, "{name}, {width} px asked for: {found}");
    };
    for width in 1..=7 {
        for (name, filter) in Filter::ALL {
            let border = Border {
                filter,
                detection_factor: 50.0,
                width: Some(LineWidth::Pixels(width)),
                slope_threshold: false,
            };
            check(name, &three_pass(border, MapEncoding::DepthTexture), width);
        }
        let threshold = Border { slope_threshold: true, width: Some(LineWidth::Pixels(width)), ..Border::default() };
        check("slope threshold", &three_pass(threshold, MapEncoding::DepthTexture), width);
        for supersample in [Supersample::One, Supersample::Two] {
            let ink = Ink { line_width: LineWidth::Pixels(width), supersample: Some(supersample), ..Ink::default() };
            check("ink", &Style::Ink(ink), width);
        }
    }
    check("as published", &three_pass(Border { detection_factor: 50.0, ..Border::default() }, MapEncoding::Float), 2);
}

#[test]
fn biased_normals_draw_equal_creases_equally_strong() {
    // The picture of errata E6: two right angles, slanting to the left and to the right of the corner at (107, 94).
    let camera = view("-45,-35.26", false);
    let size = Size { width: 240, height: 240 };
    let scene = scene_with("builtin:open-box", SceneSettings { camera, size, ..SceneSettings::default() });
    let mut renderer = renderer(BACKENDS[0]);
    let mut creases = |encoding| {
        let picture = borders(&mut renderer, &scene, &three_pass(Border::default(), encoding));
        [(40..80, -61.0 / 96.0), (140..200, 73.0 / 118.0)].map(|(columns, slope): (std::ops::Range<i64>, f64)| {
            let darkest = |x: i64| {
                let y = (94.0 + (x - 107) as f64 * slope) as i64;
                (y - 4..=y + 4).map(|y| ink(&picture, x, y)).fold(0.0, f64::max)
            };
            let count = columns.clone().count() as f64;
            columns.map(darkest).sum::<f64>() / count
        })
    };
    let [left, right] = creases(MapEncoding::Published);
    assert!(left < 0.5 * right, "as published: {left} and {right}");
    for (name, encoding) in MapEncoding::ALL.into_iter().skip(1) {
        let [left, right] = creases(encoding);
        assert!((left - right).abs() < 0.03 && left > 0.7, "{name}: {left} and {right}");
    }
}

#[test]
fn every_encoding_can_be_dumped_and_a_second_form_of_it_draws_the_same() {
    let scene = scene("builtin:gear", 120, 90);
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (name, map_encoding) in MapEncoding::ALL {
            let cartoon = Cartoon { map_encoding, ..Cartoon::default() };
            let plan = Style::ThreePass(cartoon.clone()).plan(&scene, Show::Final).unwrap();
            let steps = renderer.step_pictures(&scene, &plan).unwrap();
            assert_eq!(steps.len(), plan.steps().count(), "{name}");
            let three = renderer.draw(&scene, &plan).unwrap();
            assert_eq!(steps.last().unwrap().picture, three, "{name}");
            let two = renderer.render(&scene, &Style::TwoPass(cartoon)).unwrap();
            assert!(three.difference(&two).unwrap().largest <= 1, "{name}: two passes draw what three do");
        }
    }
}

/// Ink at a pixel of the plane map, as `improved/plane-ink.frag` defines it but in f64, and whether rounding may decide.
struct PlaneInk<'a> {
    map: &'a Picture,
    footprint: [f64; 2],
    angle: f64,
    gap: [f64; 2],
    cosine: f64,
}

impl PlaneInk<'_> {
    fn texel(&self, x: i64, y: i64) -> Option<([f64; 2], f64)> {
        let [red, green, high, low] = self.map.pixel(x, y).map(f64::from);
        let slope = |byte: f64| (byte / 127.5 - 1.0) / (1.0 - (byte / 127.5 - 1.0).abs());
        (red > 0.0).then(|| ([slope(red), slope(green)], (high * 256.0 + low) / 65535.0))
    }

    fn at(&self, x: i64, y: i64) -> (bool, bool) {
        // Beyond the rim the map is that of the rim.
        let (width, height) = (i64::from(self.map.size.width) - 1, i64::from(self.map.size.height) - 1);
        let texel = |dx: i64, dy: i64| self.texel((x + dx).clamp(0, width), (y - dy).clamp(0, height));
        let ray = [x as f64 - width as f64 * 0.5, height as f64 * 0.5 - y as f64].map(|offset| offset * self.angle);
        let along = |[a, b]: [f64; 2]| 1.0 + ray[0] * a + ray[1] * b;
        let (mut is_line, mut is_close) = (false, false);
        for (axis, pair) in [[texel(-1, 0), texel(1, 0)], [texel(0, -1), texel(0, 1)]].into_iter().enumerate() {
            let [Some((s, depth)), Some((t, other))] = pair else {
                is_line |= pair[0].is_some() != pair[1].is_some();
                continue;
            };
            let away = (other - depth) / (self.footprint[0] - self.footprint[1] * depth);
            let (near, far) = (2.0 * s[axis], 2.0 * t[axis]);
            let (a, b) = (away - near, away - far);
            let gap = if a * b >= 0.0 { a.abs().min(b.abs()) } else { 0.0 };
            let limit = self.gap[0] + self.gap[1] * near.abs().min(far.abs());
            let (m, n) = (along(s), along(t));
            let cosine = (m * n + s[0] * t[0] + s[1] * t[1]) / (s[0].hypot(s[1]).hypot(m) * t[0].hypot(t[1]).hypot(n));
            is_line |= gap > limit || cosine < self.cosine;
            is_close |= (gap - limit).abs() < 1e-3 || (cosine - self.cosine).abs() < 1e-4 || (a * b).abs() < 1e-3;
        }
        (is_line, is_close)
    }
}

#[test]
fn ink_agrees_with_its_twin_on_the_cpu() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for model in ["builtin:bust", "builtin:gear", "builtin:ant"] {
            let scene = scene(model, 160, 120);
            let plan = Style::Ink(Ink::default()).plan(&scene, Show::Borders).unwrap();
            let steps: Vec<StepPicture> = renderer.step_pictures(&scene, &plan).unwrap();
            let map = &steps.iter().find(|step| step.step == "copy").unwrap().picture;
            let Some((_, Step::Draw(square))) = plan.steps().last() else { panic!("the last step draws") };
            let value = |name: &str| square.uniforms.iter().find(|uniform| uniform.name == name).unwrap().value;
            let pair = |name| match value(name) {
                Value::Vec2(pair) => pair.map(f64::from),
                other => panic!("{other:?}"),
            };
            let number = |name| match value(name) {
                Value::Float(number) => f64::from(number),
                other => panic!("{other:?}"),
            };
            let twin = PlaneInk {
                map,
                footprint: pair("footprint"),
                angle: number("pixelAngle"),
                gap: [number("gapThreshold"), 0.3],
                cosine: number("creaseCosine"),
            };
            let drawn = &steps.last().unwrap().picture;
            let mut lines = 0;
            for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (x, y))) {
                let (expected, is_close) = twin.at(x, y);
                let found = ink(drawn, x, y) > 0.5;
                assert!(found == expected || is_close, "{backend:?} {model} at {x},{y}: {found}, the twin {expected}");
                lines += usize::from(expected);
            }
            assert!(lines > 300, "{model}: {lines} pixels of ink");
        }
    }
}

#[test]
fn the_best_ink_has_more_than_two_shades_and_the_same_lines() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 160, 160);
    let pictures = [Quality::Standard, Quality::Best]
        .map(|quality| borders(&mut renderer, &scene, &Style::Ink(Ink { quality, ..Ink::default() })));
    let amounts = pictures.each_ref().map(|picture| -> f64 {
        (0..160).flat_map(|y| (0..160).map(move |x| (x, y))).map(|(x, y)| ink(picture, x, y)).sum()
    });
    assert!((amounts[0] / amounts[1] - 1.0).abs() < 0.15, "{amounts:?}");
    let shades = |picture: &Picture| {
        picture.pixels.chunks_exact(4).map(|pixel| pixel[0]).collect::<std::collections::BTreeSet<_>>().len()
    };
    assert_eq!(shades(&pictures[0]), 2);
    assert!(shades(&pictures[1]) > 2);
}

#[test]
fn a_map_drawn_into_a_texture_is_the_same_whatever_was_drawn_into_the_framebuffer_before() {
    for backend in *BACKENDS {
        let scene = scene("builtin:bust", 90, 90);
        let ink = |map_target| Style::Ink(Ink { map_target, ..Ink::default() });
        let plan = ink(MapTarget::Texture).plan(&scene, Show::Final).unwrap();
        let alone = renderer(backend).draw(&scene, &plan).unwrap();
        let mut renderer = renderer(backend);
        // Its last program is the other's first, and the framebuffer is upside down to the driver where a texture is not.
        let before = ink(MapTarget::Copy).plan(&scene, Show::Map).unwrap();
        renderer.draw(&scene, &before).unwrap();
        assert!(renderer.draw(&scene, &plan).unwrap() == alone, "{backend:?}");
    }
}
