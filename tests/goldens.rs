//! Pictures that were looked at once and must stay as they are.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens` writes them anew and then fails, so that nobody does so unnoticed.

use crate::support::{BACKENDS, failure_folder, renderer, root, scene_with, side_by_side};
use tinta::edges::SilhouetteRule;
use tinta::picture::write_rgba_png;
use tinta::styles::{
    Border, Cartoon, Charcoal, CharcoalRecipe, ClassColors, Filter, Ink, Inking, MapEncoding, PaintMode, Quality, Tones,
};
use tinta::{Picture, SceneSettings, Show, Size, Style, StyleName};

/// A pixel counts as different beyond this, in 1/255: what another version of Mesa may round differently.
const LARGEST_DIFFERENCE: u8 = 3;

/// Share of pixels that may be different: edges fall on other pixels where another driver rasterises differently.
const DIFFERENT_SHARE: f64 = 0.005;

struct Case {
    name: &'static str,
    model: &'static str,
    style: Style,
    show: Show,
}

fn cases() -> Vec<Case> {
    let three = |cartoon| Style::ThreePass(cartoon);
    let paper = Cartoon::default;
    let tones = |count| three(Cartoon { tones: Tones { count, ..Tones::default() }, border: None, ..paper() });
    let filter = |filter| three(Cartoon { border: Some(Border { filter, ..Border::default() }), ..paper() });
    let exact_flat =
        Inking { silhouette: SilhouetteRule::Exact, paint: PaintMode::Flat, is_smooth: false, ..Inking::default() };
    let class_colors =
        Inking { colors: ClassColors::figure_6(), paint: PaintMode::None, line_width_px: 3.0, ..Inking::default() };
    // As large as the picture, so that every driver reads noise and paper in the middle of their texels.
    let texture_size = Size { width: 160, height: 160 };
    let charcoal = |recipe| Style::Charcoal(Charcoal { texture_size, ..Charcoal::recipe(recipe) });
    let encoded = |map_encoding, slope_threshold| {
        three(Cartoon { map_encoding, border: Some(Border { slope_threshold, ..Border::default() }), ..paper() })
    };
    let wide = three(Cartoon { border: Some(Border { width_px: Some(5), ..Border::default() }), ..paper() });
    let best = Ink { quality: Quality::Best, ..Ink::default() };
    let case = |name, model, style, show| Case { name, model, style, show };
    let (bust, gear, ant, open_box) = ("builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box");
    vec![
        case("bust-phong", bust, Style::named(StyleName::Phong), Show::Final),
        case("bust-three-pass", bust, three(paper()), Show::Final),
        case("bust-two-pass", bust, Style::TwoPass(paper()), Show::Final),
        case("bust-one-tone", bust, tones(1), Show::Final),
        case("bust-two-tones", bust, tones(2), Show::Final),
        case("bust-normals", bust, three(paper()), Show::Normals),
        case("bust-depth", bust, three(paper()), Show::Depth),
        case("bust-borders", bust, three(paper()), Show::Borders),
        case("gear-three-pass", gear, three(paper()), Show::Final),
        case("gear-laplacian8", gear, filter(Filter::Laplacian8), Show::Final),
        case("gear-sobel", gear, filter(Filter::Sobel), Show::Final),
        case("gear-roberts", gear, filter(Filter::Roberts), Show::Final),
        case("gear-mitchell", gear, filter(Filter::Mitchell), Show::Final),
        case("ant-three-pass", ant, three(paper()), Show::Final),
        case("open-box-three-pass", open_box, three(paper()), Show::Final),
        case("bust-inking", bust, Style::named(StyleName::Inking), Show::Final),
        case("bust-inking-ink", bust, Style::named(StyleName::Inking), Show::Borders),
        case("bust-inking-paint", bust, Style::named(StyleName::Inking), Show::Tones),
        case("ant-inking-exact-flat", ant, Style::Inking(exact_flat), Show::Final),
        case("open-box-class-colors", open_box, Style::Inking(class_colors), Show::Final),
        case("bust-charcoal", bust, charcoal(CharcoalRecipe::Published), Show::Final),
        case("bust-charcoal-darker", bust, charcoal(CharcoalRecipe::Darker), Show::Final),
        case("bust-charcoal-closure", bust, charcoal(CharcoalRecipe::Closure), Show::Final),
        case("gear-charcoal-cet", gear, charcoal(CharcoalRecipe::Published), Show::Cet),
        case("gear-biased", gear, encoded(MapEncoding::Biased, false), Show::Borders),
        case("gear-slope-threshold", gear, encoded(MapEncoding::DepthTexture, true), Show::Borders),
        case("gear-float", gear, encoded(MapEncoding::Float, false), Show::Borders),
        case("gear-wide", gear, wide, Show::Borders),
        case("bust-ink", bust, Style::named(StyleName::Ink), Show::Final),
        case("open-box-ink", open_box, Style::named(StyleName::Ink), Show::Borders),
        case("ant-ink-best", ant, Style::Ink(best), Show::Final),
        case("bust-dietrich", bust, Style::named(StyleName::Dietrich), Show::Final),
    ]
}

/// Share of pixels that differ by more than the tolerance.
fn different_share(expected: &Picture, actual: &Picture) -> f64 {
    if expected.size != actual.size {
        return 1.0;
    }
    let pairs = expected.pixels.chunks_exact(4).zip(actual.pixels.chunks_exact(4));
    let different = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > LARGEST_DIFFERENCE)).count();
    different as f64 / expected.size.pixel_count() as f64
}

#[test]
fn goldens_are_drawn_on_both_backends() {
    let update = std::env::var_os("TINTA_UPDATE_GOLDENS").is_some();
    let folder = root().join("tests/goldens");
    let mut failures = Vec::new();
    for backend in BACKENDS {
        let mut renderer = renderer(backend);
        for case in cases() {
            let settings = SceneSettings { size: Size { width: 160, height: 160 }, ..SceneSettings::default() };
            let scene = scene_with(case.model, settings);
            let actual = renderer.draw(&scene, &case.style.plan(&scene, case.show).unwrap()).unwrap();
            let path = folder.join(format!("{}.png", case.name));
            if update {
                std::fs::create_dir_all(&folder).unwrap();
                write_rgba_png(&actual, &path).unwrap();
                continue;
            }
            let Ok(expected) = Picture::read_png(&path) else {
                failures.push(format!("{}: the golden is missing", case.name));
                continue;
            };
            let share = different_share(&expected, &actual);
            if share > DIFFERENT_SHARE {
                let sheet = failure_folder().join(format!("{}-{backend:?}.png", case.name));
                write_rgba_png(&side_by_side(&expected, &actual), &sheet).unwrap();
                failures.push(format!(
                    "{} on {}: {:.2} % of pixels differ by more than {LARGEST_DIFFERENCE}/255, allowed {:.2} %; \
                     expected | difference | actual: {}",
                    case.name,
                    renderer.context().renderer,
                    share * 100.0,
                    DIFFERENT_SHARE * 100.0,
                    sheet.display()
                ));
            }
        }
    }
    assert!(!update, "goldens were written anew: look at them, then run without TINTA_UPDATE_GOLDENS");
    let how = "if the change is wanted: TINTA_UPDATE_GOLDENS=1 cargo test goldens, and look at them";
    assert!(failures.is_empty(), "{}\n{how}", failures.join("\n"));
}

#[test]
fn the_harness_notices_a_picture_that_is_not_the_golden() {
    let folder = root().join("tests/goldens");
    let read = |name: &str| Picture::read_png(&folder.join(name)).unwrap();
    let golden = read("gear-three-pass.png");
    assert_eq!(different_share(&golden, &golden), 0.0);
    assert!(different_share(&golden, &read("gear-laplacian8.png")) > DIFFERENT_SHARE, "another filter");
    let mut shifted = golden.clone();
    shifted.pixels.rotate_right(4);
    assert!(different_share(&golden, &shifted) > DIFFERENT_SHARE, "one pixel to the right");
}
