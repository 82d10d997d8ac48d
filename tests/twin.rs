//! An independent twin on the CPU: border filter and blending recomputed in f64 from what GL dumped.

use crate::support::{BACKENDS, failure_folder, renderer, scene, side_by_side};
use tinta::picture::write_rgba_png;
use tinta::styles::{Border, Cartoon, Filter};
use tinta::{Picture, Show, Style};

/// The border at a pixel from the dumped map; y is turned over, as GL's rows go up.
fn border_at(border: &Border, map: &Picture, x: i64, y: i64) -> f64 {
    border.response(|dx, dy| map.pixel(x + i64::from(dx), y - i64::from(dy)).map(|byte| f64::from(byte) / 255.0))
}

/// Ink over a tone: black with the border as alpha, clamped as GL clamps.
fn inked(tone: u8, border: f64) -> f64 {
    f64::from(tone) * (1.0 - border.clamp(0.0, 1.0))
}

#[test]
fn every_filter_and_both_styles_agree_with_the_twin_within_one_step_of_255_everywhere() {
    for backend in BACKENDS {
        let mut renderer = renderer(backend);
        for model in ["builtin:bust", "builtin:gear"] {
            let scene = scene(model, 160, 120);
            for (name, filter) in Filter::ALL {
                for detection_factor in [0.2, 0.7] {
                    let border = Border { filter, detection_factor };
                    let cartoon = Cartoon { border: Some(border), ..Cartoon::default() };
                    let mut show =
                        |style: &Style, show| renderer.draw(&scene, &style.plan(&scene, show).unwrap()).unwrap();
                    let (three, two) = (Style::ThreePass(cartoon.clone()), Style::TwoPass(cartoon));
                    let (map, tones) = (show(&three, Show::Map), show(&three, Show::Tones));
                    for (style, picture) in
                        [("three-pass", show(&three, Show::Final)), ("two-pass", show(&two, Show::Final))]
                    {
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
    let mut worst: f64 = 0.0;
    for y in 0..i64::from(actual.size.height) {
        for x in 0..i64::from(actual.size.width) {
            let response = border_at(border, map, x, y);
            for channel in 0..3 {
                let ink = inked(tones.pixel(x, y)[channel], response);
                worst = worst.max((ink - f64::from(actual.pixel(x, y)[channel])).abs());
                let place = (y as usize * actual.size.width as usize + x as usize) * 4 + channel;
                expected.pixels[place] = ink.round() as u8;
            }
        }
    }
    // The tones are rounded to 1/255 before and the result after blending: half a step each, and a hair.
    if worst > 1.01 {
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
            (inked(tones.pixel(x, y)[0], border_at(&other, &map, x, y)) - f64::from(drawn.pixel(x, y)[0])).abs()
        })
        .fold(0.0, f64::max);
    assert!(worst > 20.0, "Sobel passes for the Laplacian: {worst}");
}
