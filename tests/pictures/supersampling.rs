//! Drawing larger and shrinking: the mean of the large picture, with the requested width of lines and grain.

use crate::support::{BACKENDS, ball, renderer, scene};
use tinta::lines::Length;
use tinta::styles::{Cartoon, Charcoal, Dietrich, Improvements, Ink, Inking, LineWidth, Noise, Phong, Supersample};
use tinta::{Picture, Scene, Show, Size, Style};

/// All that draw larger.
const LARGER: [Supersample; 3] = [Supersample::Two, Supersample::Three, Supersample::Four];

/// Each style except charcoal, whose grain does not grow with its picture: at its own size with everything in pixels scaled, and
/// supersampled by the same factor.
fn styles(supersample: Supersample) -> Vec<(&'static str, [Style; 2])> {
    let factor = supersample.factor();
    let scale = factor as f32;
    let cartoon = |supersample| Cartoon { supersample, ..Cartoon::default() };
    let phong = |supersample| Style::Phong(Phong { supersample, ..Phong::default() });
    let dietrich = |supersample| Style::Dietrich(Dietrich { supersample, ..Dietrich::default() });
    let (ink, inking) = (Ink::default(), Inking::default());
    let [steps, units] = inking.polygon_offset;
    let large_ink =
        Ink { line_width: LineWidth::Pixels(2 * factor), least_gap_px: ink.least_gap_px * scale, ..ink.clone() };
    let large_inking = Inking {
        line_width: Length::Px(f64::from(2.0 * scale)),
        polygon_offset: [steps * scale, units],
        ..inking.clone()
    };
    let one = Supersample::One;
    vec![
        ("three-pass", [one, supersample].map(|sampling| Style::ThreePass(cartoon(sampling)))),
        ("two-pass", [one, supersample].map(|sampling| Style::TwoPass(cartoon(sampling)))),
        ("phong", [one, supersample].map(phong)),
        ("dietrich", [one, supersample].map(dietrich)),
        ("ink", [Style::Ink(large_ink), Style::Ink(Ink { supersample: Some(supersample), ..ink })]),
        ("inking", [Style::Inking(large_inking), Style::Inking(Inking { supersample, ..inking })]),
    ]
}

#[test]
fn a_supersampled_picture_is_the_large_one_with_its_pixels_averaged() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for supersample in LARGER {
            let factor = i64::from(supersample.factor());
            let [small, large] = [60, 60 * factor as u32].map(|side| scene("builtin:bust", side, side));
            for (name, [plain, sampled]) in styles(supersample) {
                let large = renderer.render(&large, &plain).unwrap();
                let sampled = renderer.render(&small, &sampled).unwrap();
                assert_eq!(sampled.size, small.size);
                for (x, y) in (0..60).flat_map(|y| (0..60).map(move |x| (x, y))) {
                    for channel in 0..4 {
                        let block = (0..factor).flat_map(|dy| (0..factor).map(move |dx| (dx, dy)));
                        let sum: u32 = block
                            .map(|(dx, dy)| u32::from(large.pixel(x * factor + dx, y * factor + dy)[channel]))
                            .sum();
                        let mean = f64::from(sum) / (factor * factor) as f64;
                        let found = f64::from(sampled.pixel(x, y)[channel]);
                        assert!((mean - found).abs() <= 1.0, "{name} x{factor} at {x},{y}: {mean} {found}");
                    }
                }
            }
        }
    }
}

#[test]
fn lines_are_as_wide_as_without() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 160, 160);
    for width in [2.0, 5.0] {
        // Lines that do not hide each other: without joints, which only half of the samples may need.
        let mut ink = |supersample| {
            let inking = Inking {
                line_width: Length::Px(width),
                supersample,
                is_smooth: false,
                has_joints: false,
                ..Inking::default()
            };
            let plan = Style::Inking(inking).plan(&scene, Show::Borders).unwrap();
            let picture = renderer.draw(&scene, &plan).unwrap();
            picture.pixels.chunks_exact(4).map(|pixel| f64::from(255 - pixel[0]) / 255.0).sum::<f64>()
        };
        let without = ink(Supersample::One);
        for supersample in LARGER {
            let share = ink(supersample) / without;
            assert!((share - 1.0).abs() < 0.06, "{width} px, {supersample:?}: {share} times the ink");
        }
    }
}

/// Whether all pixels around this one are covered, as far as `reach`.
fn is_inside(tones: &Picture, x: i64, y: i64, reach: i64) -> bool {
    (-reach..=reach).all(|dy| (-reach..=reach).all(|dx| tones.pixel(x + dx, y + dy)[3] == 255))
}

/// How far neighbours differ on average, in pixels that lie inside the ball.
fn contrast(picture: &Picture, inside: &[(i64, i64)]) -> f64 {
    let steps = inside.iter().map(|(x, y)| picture.pixel(*x, *y)[1].abs_diff(picture.pixel(x + 1, *y)[1]));
    steps.map(f64::from).sum::<f64>() / inside.len() as f64
}

#[test]
fn grain_and_paper_stay_as_wide_and_as_strong_and_the_outline_is_smooth() {
    let mut renderer = renderer(BACKENDS[0]);
    let ball = ball(4);
    let Size { width, height } = ball.size;
    let settings =
        tinta::SceneSettings { size: ball.size, background: tinta::Background::Transparent, ..Default::default() };
    let clear = Scene::new(vec![ball.objects[0].mesh.clone()], &settings).unwrap();
    let coverage = renderer.render(&clear, &Style::Phong(Phong::default())).unwrap();
    let places = (0..i64::from(height)).flat_map(|y| (0..i64::from(width)).map(move |x| (x, y)));
    let inside: Vec<(i64, i64)> = places.filter(|(x, y)| is_inside(&coverage, *x, *y, 3)).collect();
    assert!(inside.len() > 10_000);
    let with = |noise, improve: &str, supersample| {
        let improve: Improvements = improve.parse().unwrap();
        Style::Charcoal(Charcoal { noise, improve, supersample, texture_size: ball.size, ..Charcoal::default() })
    };
    for (noise, improve) in [(Noise::Screen, "none"), (Noise::Object, "none"), (Noise::Screen, "everything")] {
        let without = renderer.render(&ball, &with(noise, improve, Supersample::One)).unwrap();
        for supersample in LARGER {
            let sampled = renderer.render(&ball, &with(noise, improve, supersample)).unwrap();
            let ratio = contrast(&sampled, &inside) / contrast(&without, &inside);
            assert!((0.8..1.1).contains(&ratio), "{noise:?} {improve} {supersample:?}: {ratio} of the contrast");
            // The same grains in the same places.
            let same = inside.iter().filter(|(x, y)| sampled.pixel(*x, *y)[1].abs_diff(without.pixel(*x, *y)[1]) < 24);
            let share = same.count() as f64 / inside.len() as f64;
            assert!(share > 0.8, "{noise:?} {improve} {supersample:?}: {share} of the pixels");
        }
        // Drawn by its own sheet alone, the paper is that of the picture at its own size.
        let paper = |supersample| with(noise, improve, supersample).plan(&ball, Show::Paper).unwrap();
        let [one, four] = [Supersample::One, Supersample::Four].map(|it| renderer.draw(&ball, &paper(it)).unwrap());
        assert!(one.difference(&four).unwrap().largest <= 1, "{noise:?} {improve}");
    }
}

#[test]
fn a_picture_too_large_to_be_supersampled_is_refused_by_the_options_name() {
    let mut renderer = renderer(BACKENDS[0]);
    // Other styles draw this size in any number of tiles, this one in one viewport: its paper uses clip coordinates.
    let limit = renderer.context().largest_viewport;
    let scene = scene("builtin:open-box", limit.width / 4 + 1, 1);
    let style = Style::Charcoal(Charcoal { supersample: Supersample::Four, ..Charcoal::default() });
    let message = renderer.render(&scene, &style).unwrap_err().to_string();
    assert!(message.starts_with("supersample 4"), "{message}");
}
