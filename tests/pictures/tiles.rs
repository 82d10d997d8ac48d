//! Pictures in tiles against the same pictures in one piece.

use crate::support::{BACKENDS, failure_folder, renderer, scene, side_by_side, styles};
use tinta::lines::Length;
use tinta::picture::write_rgba_png;
use tinta::styles::{Cartoon, Charcoal, Improvements, Ink, Inking, LineWidth, MapTarget, Quality, Supersample};
use tinta::{Picture, Renderer, Scene, Show, Size, Style, StyleName};

const SIZE: Size = Size { width: 900, height: 640 };

/// Draws by a context that draws surfaces of this size at most.
fn in_tiles(renderer: &mut Renderer, side: u32, scene: &Scene, style: &Style) -> Picture {
    renderer.confine(Some(Size { width: side, height: side }));
    let picture = renderer.render(scene, style).unwrap();
    renderer.confine(None);
    picture
}

/// Every style, and the other separate ways to draw.
fn all() -> Vec<(&'static str, Style)> {
    let mut all = styles();
    let three_pass = |supersample| Style::ThreePass(Cartoon { supersample, ..Cartoon::default() });
    let wide = LineWidth::Pixels(9);
    all.extend([
        ("ink best", Style::Ink(Ink { quality: Quality::Best, line_width: wide, ..Ink::default() })),
        ("ink by textures", Style::Ink(Ink { map_target: MapTarget::Texture, ..Ink::default() })),
        ("three-pass, 9 samples", three_pass(Supersample::Three)),
        ("wide inking", Style::Inking(Inking { line_width: Length::Px(30.0), ..Inking::default() })),
        ("charcoal, improved", Style::Charcoal(Charcoal { improve: Improvements::ALL, ..Charcoal::default() })),
    ]);
    all
}

/// The share of these pixels that differ by more than this in any channel.
fn share(a: &Picture, b: &Picture, largest: u8, of: impl Fn(i64, i64) -> bool) -> f64 {
    let (mut different, mut all) = (0, 0);
    for y in 0..i64::from(a.size.height) {
        for x in (0..i64::from(a.size.width)).filter(|x| of(*x, y)) {
            all += 1;
            let pairs = a.pixel(x, y).into_iter().zip(b.pixel(x, y));
            different += usize::from(pairs.map(|(a, b)| a.abs_diff(b)).max() > Some(largest));
        }
    }
    assert!(all > 0);
    different as f64 / f64::from(all)
}

/// In a tiled picture at most so many pixels differ by one step of 8 bits from the picture in one piece, and at most so many by
/// more: docs/dev/limits.md explains why.
fn limits(name: &str) -> (f64, f64) {
    match name {
        // The middle between two steps, where even faces of one tone lie.
        "dietrich" => (0.15, 0.0005),
        // A random number picks a texel for each pixel.
        "charcoal" | "charcoal, improved" => (0.005, 0.003),
        _ => (0.002, 0.0005),
    }
}

#[test]
fn tiles_make_the_picture_of_one_piece_and_no_seam() {
    for model in ["builtin:bust", "builtin:gear"] {
        let scene = scene(model, SIZE.width, SIZE.height);
        for (name, style) in &all() {
            let mut renderer = renderer(BACKENDS[0]);
            let whole = renderer.render(&scene, style).unwrap();
            let tiled = in_tiles(&mut renderer, 300, &scene, style);
            let everywhere = share(&whole, &tiled, 0, |_, _| true);
            let beyond_a_step = share(&whole, &tiled, 1, |_, _| true);
            // For every factor, tiles begin at multiples of 16 pixels.
            let beside_seams =
                share(&whole, &tiled, 1, |x, y| [x, y].iter().any(|place| (place + 3).rem_euclid(16) < 6));
            let (any, more) = limits(name);
            let sheet = failure_folder().join(format!("tiles-{name}.png"));
            if everywhere > any || beyond_a_step > more || beside_seams > 2.0 * more {
                write_rgba_png(&side_by_side(&whole, &tiled), &sheet).unwrap();
                panic!("{model} {name}: {everywhere} {beyond_a_step} {beside_seams}: {}", sheet.display());
            }
        }
    }
}

#[test]
fn tiles_are_the_same_bytes_by_every_context() {
    for (name, style) in &all() {
        let scene = scene("builtin:ant", 500, 333);
        let [egl, osmesa] = BACKENDS.map(|backend| in_tiles(&mut renderer(backend), 256, &scene, style));
        assert!(egl == osmesa, "{name}");
    }
}

#[test]
fn every_picture_of_every_style_can_be_drawn_in_tiles() {
    let scene = scene("builtin:gear", 64, 64);
    for (name, style) in &all() {
        for (show, what) in Show::ALL {
            let Ok(plan) = style.plan(&scene, what) else { continue };
            let limits = tinta::plan::TileLimits {
                surface: Size { width: 1024, height: 1024 },
                viewport: Size { width: 16_384, height: 16_384 },
            };
            assert!(plan.tiles(Size { width: 9000, height: 5000 }, limits).is_some(), "{name} --show {show}");
        }
    }
}

#[test]
fn steps_and_times_of_a_picture_in_tiles_are_those_of_all_tiles() {
    let scene = scene("builtin:gear", 400, 300);
    let plan = Style::named(StyleName::Ink).plan(&scene, Show::Final).unwrap();
    let mut renderer = renderer(BACKENDS[0]);
    let whole = renderer.step_pictures(&scene, &plan).unwrap();
    renderer.confine(Some(Size { width: 256, height: 256 }));
    let tiled = renderer.step_pictures(&scene, &plan).unwrap();
    assert_eq!(whole.len(), tiled.len());
    for (whole, tiled) in whole.iter().zip(&tiled) {
        assert_eq!((whole.pass, whole.step), (tiled.pass, tiled.step));
        let share = share(&whole.picture, &tiled.picture, 1, |_, _| true);
        assert!(share < 0.002, "{} {}: {share}", whole.pass, whole.step);
    }
    assert_eq!(renderer.time_passes(&scene, &plan, 2).unwrap().len(), plan.passes.len());
    assert_eq!(renderer.close(), 0);
}

#[test]
fn a_picture_wider_than_any_viewport_is_drawn_where_it_belongs() {
    let mut renderer = renderer(BACKENDS[0]);
    let widest = renderer.context().largest_viewport.width;
    // A tenth wider than the widest: no tile sees both ends in its viewport.
    let width = widest / 10 * 11 / 16 * 16;
    let styles = [
        Style::named(StyleName::Ink),
        Style::named(StyleName::Inking),
        Style::Charcoal(Charcoal { improve: Improvements::ALL, ..Charcoal::default() }),
    ];
    for style in styles {
        let large = renderer.render(&scene("builtin:ant", width, 160), &style).unwrap();
        let small = renderer.render(&scene("builtin:ant", width / 4, 40), &style).unwrap();
        // Means of blocks of the large picture against those of the small one, whose lines are as many pixels wide.
        let mean = |picture: &Picture, x: u32, y: u32, side: u32| {
            let pixels =
                (0..side * side).map(|n| picture.pixel((x * side + n % side).into(), (y * side + n / side).into()));
            pixels.map(|pixel| f64::from(pixel[1])).sum::<f64>() / f64::from(side * side)
        };
        let mut sum = 0.0;
        let (columns, rows) = (width / 16, 10);
        for x in 0..columns {
            for y in 0..rows {
                sum += (mean(&large, x, y, 16) - mean(&small, x, y, 4)).abs();
            }
        }
        let mean_difference = sum / f64::from(columns * rows);
        assert!(mean_difference < 2.0, "{style:?}: {mean_difference}");
        let other = in_tiles(&mut renderer, 1000, &scene("builtin:ant", width, 160), &style);
        let share = share(&large, &other, 1, |_, _| true);
        assert!(share < 0.003, "{style:?}: {share}");
    }
}
