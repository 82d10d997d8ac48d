//! An independent twin on the CPU: border filter and blending recomputed in f64 from GL's dumped pictures.

use crate::support::{BACKENDS, failure_folder, renderer, scene, side_by_side};
use tinta::picture::write_rgba_png;
use tinta::styles::{Border, Cartoon, Filter};
use tinta::{Picture, Show, Style};

/// The border at a pixel from the map around it, as the shaders define it but in f64: 0 none, 1 and more black; one for each
/// blended program.
///
/// `map(x, y)` is the map's four channels in [0, 1] at this offset in pixels, y up, clamped at the rim.
fn responses(border: &Border, map: impl Fn(i32, i32) -> [f64; 4]) -> Vec<f64> {
    let factor = f64::from(border.detection_factor);
    let channel = |channel: usize| {
        let at = |x, y| map(x, y)[channel];
        match border.filter {
            Filter::Laplacian4 => ((4.0 * at(0, 0) - at(0, -1) - at(-1, 0) - at(1, 0) - at(0, 1)) * factor).abs(),
            Filter::Laplacian8 => {
                let block = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                ((9.0 * at(0, 0) - block.map(|(x, y)| at(x, y)).sum::<f64>()) * factor).abs()
            }
            Filter::Mitchell | Filter::MitchellTwo => {
                let corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)];
                corners.map(|(x, y)| (at(0, 0) - at(x, y)).abs()).iter().sum::<f64>() * factor.abs()
            }
            Filter::Sobel => {
                let weight = |along: i32, across: i32| f64::from(along * (2 - across.abs()));
                let block = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                let (x, y) = block.fold((0.0, 0.0), |(sum_x, sum_y), (x, y)| {
                    (sum_x + weight(x, y) * at(x, y), sum_y + weight(y, x) * at(x, y))
                });
                x.hypot(y) * factor.abs()
            }
            Filter::Roberts => {
                let falling: f64 = at(0, 0) - at(1, 1);
                falling.hypot(at(1, 0) - at(0, 1)) * factor.abs()
            }
            Filter::Gaussian => {
                let block = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                let weight = |x: i32, y: i32| f64::from((2 - x.abs()) * (2 - y.abs())) / 16.0;
                let mean: f64 = block.map(|(x, y)| weight(x, y) * at(x, y)).sum();
                ((at(0, 0) - mean) * 16.0 / 3.0 * factor).abs()
            }
        }
    };
    match border.filter {
        Filter::MitchellTwo => vec![(0..3).map(channel).sum(), channel(3)],
        _ => vec![(0..4).map(channel).sum()],
    }
}

/// All of it.
fn response(border: &Border, map: impl Fn(i32, i32) -> [f64; 4]) -> f64 {
    responses(border, map).into_iter().sum()
}

/// The border at a pixel from the dumped map; y is turned over, as GL's rows go up.
fn border_at(border: &Border, map: &Picture, x: i64, y: i64) -> Vec<f64> {
    responses(border, |dx, dy| map.pixel(x + i64::from(dx), y - i64::from(dy)).map(|byte| f64::from(byte) / 255.0))
}

/// Ink over a tone: black with each border as alpha, clamped as GL clamps.
fn inked(tone: u8, borders: &[f64]) -> f64 {
    borders.iter().fold(f64::from(tone), |tone, border| tone * (1.0 - border.clamp(0.0, 1.0)))
}

#[test]
fn every_filter_and_both_styles_agree_with_the_twin_within_one_step_of_255_everywhere() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for model in ["builtin:bust", "builtin:gear"] {
            let scene = scene(model, 160, 120);
            for (name, filter) in Filter::ALL {
                for detection_factor in [0.2, 0.7] {
                    let border = Border { filter, detection_factor, ..Border::default() };
                    let cartoon = Cartoon { border: Some(border), ..Cartoon::default() };
                    let mut show =
                        |style: &Style, show| renderer.draw(&scene, &style.plan(&scene, show).unwrap()).unwrap();
                    let (three, two) = (Style::ThreePass(cartoon.clone()), Style::TwoPass(cartoon));
                    let (map, tones) = (show(&three, Show::Map), show(&three, Show::Tones));
                    let mut pictures = vec![("three-pass", show(&three, Show::Final))];
                    // A filter blended in two programs is no single one.
                    if filter != Filter::MitchellTwo {
                        pictures.push(("two-pass", show(&two, Show::Final)));
                    }
                    for (style, picture) in pictures {
                        let context = format!("{backend:?} {model} {name} {detection_factor} {style}");
                        compare(&context, &border, &map, &tones, &picture);
                    }
                }
            }
        }
    }
}

fn compare(context: &str, border: &Border, map: &Picture, tones: &Picture, actual: &Picture) {
    let mut expected = actual.clone();
    let (mut worst, mut blends): (f64, usize) = (0.0, 1);
    for y in 0..i64::from(actual.size.height) {
        for x in 0..i64::from(actual.size.width) {
            let response = border_at(border, map, x, y);
            blends = response.len();
            for channel in 0..3 {
                let ink = inked(tones.pixel(x, y)[channel], &response);
                worst = worst.max((ink - f64::from(actual.pixel(x, y)[channel])).abs());
                let place = (y as usize * actual.size.width as usize + x as usize) * 4 + channel;
                expected.pixels[place] = ink.round() as u8;
            }
        }
    }
    // The tones are rounded to 1/255 before and the result after blending: half a step each, and a hair. A second blending
    // rounds its alpha and its result once more.
    if worst > 0.01 + blends as f64 {
        let path = failure_folder().join(format!("twin-{}.png", context.replace([' ', ':'], "-")));
        write_rgba_png(&side_by_side(&expected, actual), &path).unwrap();
        panic!("{context}: off by {worst} of 255; expected | difference | actual: {}", path.display());
    }
}

#[test]
fn the_twin_notices_a_filter_that_is_not_the_one_drawn() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 160, 120);
    let style = Style::ThreePass(Cartoon::default());
    let mut show = |show| renderer.draw(&scene, &style.plan(&scene, show).unwrap()).unwrap();
    let (map, tones, drawn) = (show(Show::Map), show(Show::Tones), show(Show::Final));
    let other = Border { filter: Filter::Sobel, ..Border::default() };
    let worst = (0..120)
        .flat_map(|y| (0..160).map(move |x| (x, y)))
        .map(|(x, y)| {
            (inked(tones.pixel(x, y)[0], &border_at(&other, &map, x, y)) - f64::from(drawn.pixel(x, y)[0])).abs()
        })
        .fold(0.0, f64::max);
    assert!(worst > 20.0, "Sobel passes for the Laplacian: {worst}");
}

fn with(filter: Filter) -> Border {
    Border { filter, detection_factor: 1.0, ..Border::default() }
}

#[test]
fn every_filter_is_silent_on_an_even_map_and_speaks_at_a_step() {
    for (name, filter) in Filter::ALL {
        assert!(response(&with(filter), |_, _| [0.3; 4]).abs() < 1e-12, "{name}");
        let step = |x: i32, _| [f64::from(i32::from(x > 0)), 0.0, 0.0, 0.0];
        assert!(response(&with(filter), step) > 0.5, "{name}");
    }
}

#[test]
fn only_filters_of_second_differences_are_silent_on_a_ramp() {
    let ramp = |x: i32, y: i32| [0.5 + 0.1 * f64::from(x) + 0.05 * f64::from(y), 0.0, 0.0, 0.0];
    let on_ramp = |filter| response(&with(filter), ramp);
    assert!(on_ramp(Filter::Laplacian4) < 1e-12);
    assert!(on_ramp(Filter::Laplacian8) < 1e-12);
    assert!(on_ramp(Filter::Gaussian) < 1e-12);
    // Central differences of 0.2 and 0.1 weighted 1 + 2 + 1.
    assert!((on_ramp(Filter::Sobel) - 0.8f64.hypot(0.4)).abs() < 1e-12);
    assert!((on_ramp(Filter::Roberts) - 0.15f64.hypot(0.05)).abs() < 1e-12);
    assert!((on_ramp(Filter::Mitchell) - 2.0 * (0.15 + 0.05)).abs() < 1e-12);
}

#[test]
fn a_right_angle_is_forty_percent_black_with_the_papers_factor() {
    // Errata E9: a crease between normals (0, 0, 1) and (1, 0, 0), seen on the z side.
    let crease = |x: i32, _| if x > 0 { [1.0, 0.0, 0.0, 0.5] } else { [0.0, 0.0, 1.0, 0.5] };
    assert!((response(&Border::default(), crease) - 0.4).abs() < 1e-7);
}

#[test]
fn the_gaussian_weighs_its_centre_as_the_papers_filter_does_and_nothing_in_all() {
    let point = |at: (i32, i32)| move |x: i32, y: i32| [f64::from(u8::from((x, y) == at)), 0.0, 0.0, 0.0];
    let answer = |at| response(&with(Filter::Gaussian), point(at));
    assert!((answer((0, 0)) - 4.0).abs() < 1e-12);
    assert!((answer((0, 1)) - 2.0 / 3.0).abs() < 1e-12 && (answer((1, 1)) - 1.0 / 3.0).abs() < 1e-12);
    // The centre's weight balances those beside it and of the corners.
    assert!((4.0 * answer((1, 0)) + 4.0 * answer((1, 1)) - answer((0, 0))).abs() < 1e-12);
}

#[test]
fn the_printed_matrices_are_the_twins_weights() {
    for (name, filter) in Filter::ALL {
        let [kernel] = tinta_lab::figures::kernels(filter)[..] else { continue };
        if name.starts_with("mitchell") {
            continue;
        }
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
            // The upper row is that of y = 1.
            let at = (column as i32 - 1, 1 - row as i32);
            let point = |x: i32, y: i32| [f64::from(u8::from((x, y) == at)), 0.0, 0.0, 0.0];
            let expected = kernel.weight(row, column).abs();
            assert!((response(&with(filter), point) - expected).abs() < 1e-12, "{name} {at:?}");
        }
    }
}

#[test]
fn two_programs_draw_fainter_lines_than_one_where_normals_and_depth_both_answer_and_nowhere_else() {
    // Right of the pixel another normal and another depth; above it another normal only.
    let corner = |x: i32, y: i32| match (x, y) {
        (1, _) => [0.5, 0.0, 0.0, 0.5],
        (_, 1) => [0.5, 0.0, 0.0, 0.0],
        _ => [0.0; 4],
    };
    let ink = |filter, map: &dyn Fn(i32, i32) -> [f64; 4]| {
        inked(255, &responses(&Border { filter, detection_factor: 0.2, ..Border::default() }, map))
    };
    let [one, two] = [Filter::Mitchell, Filter::MitchellTwo].map(|filter| ink(filter, &corner));
    // Three corners differ by 0.5 in the normal, two in depth: alphas of 0.3 and 0.2.
    assert!((one - 255.0 * 0.5).abs() < 1e-4 && (two - 255.0 * 0.7 * 0.8).abs() < 1e-4, "{one} {two}");
    let above = |_: i32, y: i32| [f64::from(u8::from(y > 0)), 0.0, 0.0, 0.0];
    assert_eq!(ink(Filter::Mitchell, &above), ink(Filter::MitchellTwo, &above));
}
