//! Approved pictures that must not change: one test for each, named after the picture.
//!
//! `TINTA_UPDATE_GOLDENS=1 cargo test goldens::bust_phong` draws that one anew and then fails, to make every update deliberate;
//! with `goldens` alone it draws them all.

use crate::support::goldens::{DIFFERENT_SHARE, Goldens, compare, different_share, how_to_update, names};
use crate::support::{BACKENDS, renderer, root, scene_with};
use tinta::edges::SilhouetteRule;
use tinta::lines::Length;
use tinta::styles::{
    Border, Cartoon, Charcoal, CharcoalRecipe, ClassColors, Filter, Ink, Inking, LineWidth, MapEncoding, PaintMode,
    Quality, Tones,
};
use tinta::{Picture, SceneSettings, Show, Size, Style, StyleName};

/// Width of borders.
const WIDE: LineWidth = LineWidth::Pixels(5);

const BUST: &str = "builtin:bust";
const GEAR: &str = "builtin:gear";
const ANT: &str = "builtin:ant";
const OPEN_BOX: &str = "builtin:open-box";

/// Draws a model on both backends and compares each picture with the golden.
fn golden(name: &str, model: &str, style: &Style, show: Show) {
    let settings = SceneSettings { size: Size { width: 160, height: 160 }, ..SceneSettings::default() };
    let scene = scene_with(model, settings);
    let plan = style.plan(&scene, show).unwrap();
    let failures: Vec<String> = BACKENDS
        .iter()
        .filter_map(|backend| {
            let mut renderer = renderer(*backend);
            let actual = renderer.draw(&scene, &plan).unwrap();
            let by = format!("{backend:?}");
            compare(name, &actual, &by).err().map(|what| format!("{what}; drawn by {}", renderer.context().renderer))
        })
        .collect();
    let how = how_to_update(&format!("goldens::{}", name.replace('-', "_")));
    assert!(failures.is_empty(), "{}\n{how}", failures.join("\n"));
}

fn tones(count: u8) -> Style {
    Style::ThreePass(Cartoon { tones: Tones { count, ..Tones::default() }, border: None, ..Cartoon::default() })
}

fn border(border: Border) -> Style {
    Style::ThreePass(Cartoon { border: Some(border), ..Cartoon::default() })
}

fn filter(filter: Filter) -> Style {
    border(Border { filter, ..Border::default() })
}

fn encoded(map_encoding: MapEncoding, slope_threshold: bool) -> Style {
    let border = Some(Border { slope_threshold, ..Border::default() });
    Style::ThreePass(Cartoon { map_encoding, border, ..Cartoon::default() })
}

fn charcoal(recipe: CharcoalRecipe) -> Style {
    // As large as the picture, to make every driver read noise and paper in the middle of their texels.
    let texture_size = Size { width: 160, height: 160 };
    Style::Charcoal(Charcoal { texture_size, ..Charcoal::recipe(recipe) })
}

#[test]
fn bust_phong() {
    golden("bust-phong", BUST, &Style::named(StyleName::Phong), Show::Final);
}

#[test]
fn bust_three_pass() {
    golden("bust-three-pass", BUST, &Style::named(StyleName::ThreePass), Show::Final);
}

#[test]
fn bust_two_pass() {
    golden("bust-two-pass", BUST, &Style::named(StyleName::TwoPass), Show::Final);
}

#[test]
fn bust_one_tone() {
    golden("bust-one-tone", BUST, &tones(1), Show::Final);
}

#[test]
fn bust_two_tones() {
    golden("bust-two-tones", BUST, &tones(2), Show::Final);
}

#[test]
fn bust_normals() {
    golden("bust-normals", BUST, &Style::named(StyleName::ThreePass), Show::Normals);
}

#[test]
fn bust_depth() {
    golden("bust-depth", BUST, &Style::named(StyleName::ThreePass), Show::Depth);
}

#[test]
fn bust_borders() {
    golden("bust-borders", BUST, &Style::named(StyleName::ThreePass), Show::Borders);
}

#[test]
fn gear_three_pass() {
    golden("gear-three-pass", GEAR, &Style::named(StyleName::ThreePass), Show::Final);
}

#[test]
fn gear_laplacian8() {
    golden("gear-laplacian8", GEAR, &filter(Filter::Laplacian8), Show::Final);
}

#[test]
fn gear_sobel() {
    golden("gear-sobel", GEAR, &filter(Filter::Sobel), Show::Final);
}

#[test]
fn gear_roberts() {
    golden("gear-roberts", GEAR, &filter(Filter::Roberts), Show::Final);
}

#[test]
fn gear_mitchell() {
    golden("gear-mitchell", GEAR, &filter(Filter::Mitchell), Show::Final);
}

#[test]
fn gear_mitchell_two() {
    golden("gear-mitchell-two", GEAR, &filter(Filter::MitchellTwo), Show::Final);
}

#[test]
fn gear_gaussian() {
    golden("gear-gaussian", GEAR, &filter(Filter::Gaussian), Show::Final);
}

#[test]
fn ant_three_pass() {
    golden("ant-three-pass", ANT, &Style::named(StyleName::ThreePass), Show::Final);
}

#[test]
fn open_box_three_pass() {
    golden("open-box-three-pass", OPEN_BOX, &Style::named(StyleName::ThreePass), Show::Final);
}

#[test]
fn bust_inking() {
    golden("bust-inking", BUST, &Style::named(StyleName::Inking), Show::Final);
}

#[test]
fn bust_inking_ink() {
    golden("bust-inking-ink", BUST, &Style::named(StyleName::Inking), Show::Borders);
}

#[test]
fn bust_inking_paint() {
    golden("bust-inking-paint", BUST, &Style::named(StyleName::Inking), Show::Tones);
}

#[test]
fn ant_inking_exact_flat() {
    let flat =
        Inking { silhouette: SilhouetteRule::Exact, paint: PaintMode::Flat, is_smooth: false, ..Inking::default() };
    golden("ant-inking-exact-flat", ANT, &Style::Inking(flat), Show::Final);
}

#[test]
fn open_box_class_colors() {
    let lines = Inking {
        colors: ClassColors::figure_6(),
        paint: PaintMode::None,
        line_width: Length::Px(3.0),
        ..Inking::default()
    };
    golden("open-box-class-colors", OPEN_BOX, &Style::Inking(lines), Show::Final);
}

#[test]
fn bust_charcoal() {
    golden("bust-charcoal", BUST, &charcoal(CharcoalRecipe::Plain), Show::Final);
}

#[test]
fn bust_charcoal_darker() {
    golden("bust-charcoal-darker", BUST, &charcoal(CharcoalRecipe::Darker), Show::Final);
}

#[test]
fn bust_charcoal_closure() {
    golden("bust-charcoal-closure", BUST, &charcoal(CharcoalRecipe::Closure), Show::Final);
}

#[test]
fn gear_charcoal_cet() {
    golden("gear-charcoal-cet", GEAR, &charcoal(CharcoalRecipe::Plain), Show::Cet);
}

#[test]
fn gear_biased() {
    golden("gear-biased", GEAR, &encoded(MapEncoding::Biased, false), Show::Borders);
}

#[test]
fn gear_slope_threshold() {
    golden("gear-slope-threshold", GEAR, &encoded(MapEncoding::DepthTexture, true), Show::Borders);
}

#[test]
fn gear_float() {
    golden("gear-float", GEAR, &encoded(MapEncoding::Float, false), Show::Borders);
}

#[test]
fn gear_wide() {
    golden("gear-wide", GEAR, &border(Border { width: Some(WIDE), ..Border::default() }), Show::Borders);
}

#[test]
fn bust_ink() {
    golden("bust-ink", BUST, &Style::named(StyleName::Ink), Show::Final);
}

#[test]
fn open_box_ink() {
    golden("open-box-ink", OPEN_BOX, &Style::named(StyleName::Ink), Show::Borders);
}

#[test]
fn ant_ink_best() {
    golden("ant-ink-best", ANT, &Style::Ink(Ink { quality: Quality::Best, ..Ink::default() }), Show::Final);
}

#[test]
fn bust_dietrich() {
    golden("bust-dietrich", BUST, &Style::named(StyleName::Dietrich), Show::Final);
}

#[test]
fn bust_back_faces() {
    golden("bust-back-faces", BUST, &Style::named(StyleName::BackFaces), Show::Final);
}

#[test]
fn bust_numbers() {
    golden("bust-numbers", BUST, &encoded(MapEncoding::Numbers, false), Show::Borders);
}

#[test]
fn every_golden_has_its_test() {
    let names = names(Goldens::Styles);
    let tests = include_str!("goldens.rs");
    for name in &names {
        let test = format!("\nfn {}() {{\n", name.replace('-', "_"));
        assert!(tests.contains(&test) && tests.contains(&format!("golden(\"{name}\", ")), "{name}.png has no test");
    }
    assert_eq!(tests.matches("\n    golden(\"").count(), names.len(), "two tests draw one golden");
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
