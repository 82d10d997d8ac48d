//! What GL is given: normals, texture coordinates and skins of files, camera matrices of other programs, mirrored models, many
//! vertices, and depth in 8 bits.

use super::case::{Case, Demand, Drawing, Group, ROUNDED, Study, viewed};
use super::depth::{FAR, terraces};
use crate::stress::{Shape, Variant, WrittenShape};
use glam::{DMat4, DVec3, DVec4};
use tinta::scene::Size;
use tinta::styles::{Border, Cartoon, Charcoal, Inking, MapEncoding, PaintMode, Style, StyleName};

pub(super) fn cases() -> Vec<Case> {
    [normals(), textures(), matrices(), models(), combs(), depths()].concat()
}

fn drawn(name: impl Into<String>, answer: &'static str, drawing: Drawing) -> Case {
    Case { answer, ..Case::rendered(Group::Inputs, name, drawing) }
}

/// A drawing that must show the same as another, but for rounding.
fn same(name: impl Into<String>, answer: &'static str, drawing: Drawing, twin: Drawing) -> Case {
    let drawing = Drawing { twin: Some(Box::new(twin)), ..drawing };
    drawn(name, answer, drawing).with("twin_differing", 0.0, ROUNDED)
}

fn written(shape: WrittenShape) -> Drawing {
    Drawing { shape: Shape::Written(shape), study: Study::Picture, ..Drawing::default() }
}

fn normals() -> Vec<Case> {
    let of = |length| written(WrittenShape::Normals(length));
    let computed = "the program's own normals replace them";
    let direction = "only a normal's direction counts";
    vec![
        same("file normals that are no numbers", computed, of(Some(f64::NAN)), of(None)),
        same("file normals without length", computed, of(Some(0.0)), of(None)),
        same("infinite file normals", computed, of(Some(f64::INFINITY)), of(None)),
        same("file normals of length 1e300", direction, of(Some(1e300)), of(Some(1.0))),
        same("file normals of length 1e-300", direction, of(Some(1e-300)), of(Some(1.0))),
    ]
}

/// The styles that read a model's picture.
fn textured() -> Vec<Variant> {
    let inking = Inking { has_texture: true, ..Inking::default() };
    vec![Variant::published(StyleName::Sand), Variant::new("inking --texture on", Style::Inking(inking))]
}

fn textures() -> Vec<Case> {
    let of = |shape| Drawing { variants: textured(), ..written(shape) };
    let coordinates = |times| of(WrittenShape::Coordinates(times));
    let unusable = "corners without usable coordinates read the picture's corner";
    let mut all = vec![same(
        "texture coordinates that are no numbers",
        unusable,
        coordinates(Some(f64::NAN)),
        coordinates(Some(0.0)),
    )];
    let some = "each pixel reads some texel, because 24 bits hold no fraction of such a number";
    let [few, many] = [16, 1024].map(|side| of(WrittenShape::Skin(side, side)));
    let many = Drawing { twin: Some(Box::new(few)), ..many };
    let many = drawn("a skin with some seventy texels for a pixel", "it is as dark as one with few texels", many);
    all.push(many.with("twin_darker", -0.002, 0.002));
    all.push(drawn("texture coordinates of 1e30", some, coordinates(Some(1e30))).degrades());
    let skins = [
        ("a skin of one texel", "the surface has its colour", 1, 1),
        ("a skin 16,384 texels high", "it is drawn, or refused by the driver's limit", 2, 16_384),
        ("a skin 65,537 texels high", "a skin beyond the driver's limit is refused", 2, 65_537),
    ];
    all.extend(skins.map(|(name, answer, width, height)| {
        let case = drawn(name, answer, of(WrittenShape::Skin(width, height)));
        Case { expected: Demand::Either(&["picture", "gl"]), ..case }
    }));
    let grain = |side: u32| {
        let style = Charcoal { texture_size: Size { width: side, height: side }, ..Charcoal::default() };
        let variants = vec![Variant::new(format!("charcoal --texture-size {side}"), Style::Charcoal(style))];
        Drawing { shape: Shape::Ball(3), variants, study: Study::Picture, ..Drawing::default() }
    };
    all.push(drawn("charcoal's largest textures", "they are drawn", grain(4096)));
    let larger = "charcoal's textures one texel larger";
    let refused = Case::refused(Group::Inputs, larger, grain(4097), "setting", "texture-size");
    all.push(Case { answer: "the limit is named", ..refused });
    all
}

/// The cube's camera as a matrix, clip space from world space.
fn matrix() -> DMat4 {
    let backward = DVec3::new(1.4, 1.1, 3.1).normalize();
    let eye = DVec3::splat(0.5) + backward * 4.0;
    let view = glam::dcamera::rh::view::look_at_mat4(eye, DVec3::splat(0.5), DVec3::Y);
    DMat4::from_cols(
        DVec4::new(3.5, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 3.5, 0.0, 0.0),
        DVec4::new(0.0, 0.0, -1.5, -1.0),
        DVec4::new(0.0, 0.0, -7.5, 0.0),
    ) * view
}

fn matrices() -> Vec<Case> {
    let of = |matrix| Drawing { matrix: Some(matrix), study: Study::Picture, ..Drawing::default() };
    let scaled = |x: f64, y: f64, z: f64| DMat4::from_scale(DVec3::new(x, y, z)) * matrix();
    let factor = "a matrix to clip space has any factor";
    let wider = "its vertical scale counts, and --camera says what its sides lose";
    let sames = [
        ("a camera matrix times 1e-30", factor, matrix() * 1e-30, 1.0),
        ("a camera matrix times 1e30", factor, matrix() * 1e30, 1.0),
        ("a camera matrix with half the depth", "depth runs as the program chooses", scaled(1.0, 1.0, 0.5), 1.0),
        ("a camera matrix five times as wide", wider, scaled(5.0, 1.0, 1.0), 0.2),
    ];
    let case = |(name, answer, matrix, aspect): (&str, _, _, f64)| {
        let case = same(name, answer, of(matrix), of(self::matrix()));
        case.with("matrix_aspect", aspect - 1e-9, aspect + 1e-9)
    };
    let mut all = sames.map(case).to_vec();
    let mut sheared = DMat4::IDENTITY;
    sheared.y_axis.x = 0.3;
    let refused = [
        ("a camera matrix of zeros", DMat4::ZERO, "matrix"),
        ("a singular camera matrix", scaled(0.0, 1.0, 1.0), "matrix"),
        ("a camera matrix that is no number", DMat4::NAN, "finite"),
        ("a sheared camera matrix", sheared * matrix(), "matrix"),
        ("a mirrored camera matrix", scaled(-1.0, 1.0, 1.0), "mirror"),
        ("a camera matrix with y down", scaled(1.0, -1.0, 1.0), "mirror"),
    ];
    let case = |(name, matrix, words)| Case::refused(Group::Inputs, name, of(matrix), "setting", words);
    all.extend(refused.map(|of| Case { answer: "no camera of the program has it", ..case(of) }));
    all
}

fn models() -> Vec<Case> {
    let ball = Drawing { shape: Shape::Ball(3), ..Drawing::default() };
    let mirrored = Drawing { scale: -1.0, twin: Some(Box::new(ball.clone())), ..ball };
    let denormal = |value| Drawing { shape: Shape::BadVertex(value), ..Drawing::default() };
    let shaded = [StyleName::Phong, StyleName::ThreePass, StyleName::Ink].map(Variant::published).to_vec();
    let many = |side| {
        let variants = shaded.clone();
        Drawing { shape: Shape::Flat(side), variants, study: Study::Picture, ..Drawing::default() }
    };
    let none = Drawing { scale: 1e-310, ..Drawing::default() };
    let none = Case::refused(Group::Inputs, "a model of denormal numbers", none, "model", "radius");
    let other = "its lines are the same; its faces are inside out and their tones those of the other side";
    vec![
        drawn("a mirrored model", other, mirrored).degrades().with("twin_lines_differing", 0.0, ROUNDED),
        same("a vertex at 1e-310", "a denormal number is next to nothing", denormal(1e-310), denormal(0.0)),
        same("a vertex at 1e-40", "and so is one that only f32 makes denormal", denormal(1e-40), denormal(0.0)),
        Case { answer: "a model of that size has no radius", ..none },
        same("90,601 vertices in one draw", "indices beyond 65,535 reach their vertices", many(300), many(250)),
    ]
}

/// Smoothed lines write depth even where their alpha is next to 0, and GL_LESS refuses every later line there: what lies
/// dense fades (D11). How dark a front view of 512 x 512 pixels is, by the number of a comb's teeth.
fn combs() -> Vec<Case> {
    let comb = |teeth: u32, writes_depth: bool, darkness: f64| {
        let inking = Inking { paint: PaintMode::None, writes_depth, ..Inking::default() };
        let option = if writes_depth { "write" } else { "test" };
        let drawing = Drawing {
            shape: Shape::Comb(teeth),
            camera: viewed("front"),
            size: Size { width: 512, height: 512 },
            variants: vec![Variant::new(format!("inking --paint none --ink-depth {option}"), Style::Inking(inking))],
            study: Study::Picture,
            ..Drawing::default()
        };
        let answer = if writes_depth { "lines keep out those drawn later beside them" } else { "dense lines are dark" };
        let case = drawn(format!("a comb of {teeth} teeth, --ink-depth {option}"), answer, drawing);
        case.with("darkness", darkness - 0.02, darkness + 0.02)
    };
    let written = [(200, 0.49), (500, 0.21), (2000, 0.055)];
    let mut all: Vec<Case> = written.map(|(teeth, darkness)| comb(teeth, true, darkness).degrades()).into();
    all.extend(written.map(|(teeth, _)| comb(teeth, false, 0.85)));
    all
}

/// Distances of the eye from the four squares of [`Shape::Terraces`], and a pixel's width at distance 1.
const SQUARES: [f64; 4] = [4.0, 4.1, 4.2, 4.3];
const PIXEL: f64 = 0.0042;

/// The share of the outlines' length that 8 bits of window depth keep: where depth steps by more than the filter's least gap, two
/// steps of the map and a pixel and a half along the surface.
fn kept_by_8_bits(near: f64) -> f64 {
    let range = near.recip() - FAR.recip();
    let depth = |z: f64| ((near.recip() - z.recip()) / range * 255.0).round() / 255.0;
    let is_kept = |z: f64, behind: f64| depth(behind) - depth(z) > 2.0 / 255.0 + 1.5 * PIXEL / z / range;
    let [first, second, third, last] = SQUARES;
    // Left, right, and above and below each square; between the first two the background shows, so both their sides are seen.
    let mut edges = vec![(1.0 / first, is_kept(first, FAR)), (1.0 / last, is_kept(last, FAR))];
    edges.extend(SQUARES.map(|z| (1.0 / z, is_kept(z, FAR))));
    edges.extend([(1.0 / first, is_kept(first, FAR)), (1.0 / second, is_kept(second, FAR))]);
    edges.extend([(1.0 / second, is_kept(second, third)), (1.0 / third, is_kept(third, last))]);
    let sum = |all: bool| edges.iter().filter(|(_, kept)| all || *kept).map(|(length, _)| length).sum::<f64>();
    sum(false) / sum(true)
}

/// The text's own limit (E:118): how many outlines 8 bits of depth keep, for planes farther and farther apart.
fn depths() -> Vec<Case> {
    let border = Border { detection_factor: 1.0, slope_threshold: true, ..Border::default() };
    let cartoon = Cartoon { border: Some(border), map_encoding: MapEncoding::Published, ..Cartoon::default() };
    let name = "three-pass --detection-factor 1 --slope-threshold on --map-encoding paper";
    let of = |ratio: f64| terraces(ratio, vec![Variant::new(name, Style::ThreePass(cartoon.clone()))]);
    let case = |ratio: f64| {
        let name = format!("outlines by 8 bits of depth, far {ratio:e} times as far as near");
        let answer = "the outlines survive whose step in depth is more than two of 255 steps";
        if ratio > 1e4 {
            let refused = Case::refused(Group::Inputs, name, of(ratio), "setting", "--near");
            return Case { answer: "fewer than 256 steps of the depth buffer would be left", ..refused };
        }
        let share = kept_by_8_bits(FAR / ratio);
        // Ink at a corner also covers the next line's end.
        drawn(name, answer, of(ratio)).degrades().with("recall", share - 0.01, share + 0.05)
    };
    [1.3, 3.0, 6.0, 10.0, 20.0, 100.0, 1e4, 1e5, 1e9].map(case).to_vec()
}
