//! The claims about the drawing: charcoal on the model and along its outline, with one parameter changed at a time.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, changed, greys, mean, roughness};
use crate::figures::figure::{Panel, Shot, panel};
use std::path::PathBuf;
use std::sync::Arc;
use tinta::error::Result;
use tinta::picture::Picture;
use tinta::plan::{Geometry, Step};
use tinta::scene::Size;
use tinta::styles::{CetCoordinate, CetFilter, Charcoal, CharcoalRecipe, Improvements, Show, Style, TextureSource};
use tinta::textures::Generator;

/// A pixel has changed beyond this, of 255.
const CHANGED: u8 = 3;

/// Charcoal below this, of 255, leaves the sheet nearly bare.
const BARE: f64 = 16.0;

/// How far charcoal is sampled around a pixel of the outline, pixels: grain is about one wide.
const AROUND: i64 = 2;

/// As published, with textures as large as the picture, which makes grain one pixel wide.
fn published(lab: &Lab<'_>) -> Charcoal {
    Charcoal { texture_size: lab.size, ..Charcoal::default() }
}

fn draw(lab: &mut Lab<'_>, charcoal: &Charcoal, show: Show) -> Result<Picture> {
    let scene = lab.scene("builtin:bust")?;
    lab.draw(&scene, &Style::Charcoal(charcoal.clone()), show)
}

fn mask(lab: &mut Lab<'_>) -> Result<Vec<bool>> {
    let scene = lab.scene("builtin:bust")?;
    lab.mask(&scene)
}

/// Both lights in front of the model, and both at its left: their sum is above 1 in the middle, and along one outline.
const IN_FRONT: [Option<[f32; 3]>; 2] = [Some([0.0, 0.0, 1.0]); 2];
const AT_THE_LEFT: [Option<[f32; 3]>; 2] = [Some([-1.0, 0.0, 0.0]); 2];

/// The exponents that the report prints.
const EXPONENTS: [f64; 5] = [1.2, 1.3, 1.5, 5.5, 15.0];

pub(super) fn operator_stays_within_one(lab: &mut Lab<'_>) -> Result<Finding> {
    let values = EXPONENTS.iter().flat_map(|m| (0..=1000).map(move |step| (f64::from(step) / 1000.0).powf(*m)));
    let [least, most] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| [value.min(least), value.max(most)]);
    // The listing gives the operator the sum of two lights.
    let scene = lab.scene("builtin:bust")?;
    let view = scene.camera.view_from_world();
    let lights = IN_FRONT.map(|light| glam::Vec3::from(light.unwrap_or_default()).as_dvec3().normalize_or_zero());
    let sums = scene.arrays(&scene.objects[0]).vertices.iter().map(|[_, _, _, x, y, z]| {
        let normal = view.transform_vector3(glam::Vec3::new(*x, *y, *z).as_dvec3()).normalize_or_zero();
        lights.iter().map(|light| normal.dot(*light).max(0.0)).sum::<f64>()
    });
    let above = mean(sums.map(|sum| f64::from(u8::from(sum > 1.0))));
    Ok(Finding::of(
        least >= 0.0 && most <= 1.0,
        vec![
            Number::new("smallest value", least, "", 0),
            Number::new("largest", most, "", 0),
            Number::share(
                "of the vertices, the listing's sum of two lights in one place is above 1 (erratum V3)",
                above,
            ),
        ],
    ))
}

pub(super) fn larger_m_less_grain(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let mut dark = |cet_exponent| -> Result<f64> {
        let grain = draw(lab, &Charcoal { cet_exponent, ..published(lab) }, Show::Cet)?;
        Ok(mean(greys(&grain, &mask).map(|grey| f64::from(u8::from(grey < 128.0)))))
    };
    let [least, middle, most] = [dark(1.3)?, dark(5.5)?, dark(15.0)?];
    Ok(Finding::of(
        least > middle && middle > most,
        vec![
            Number::share("dark with m = 1.3", least),
            Number::share("with 5.5", middle),
            Number::share("with 15", most),
        ],
    ))
}

pub(super) fn more_contrast(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let charcoal = published(lab);
    let mut deviation = |show| -> Result<f64> {
        let picture = draw(lab, &charcoal, show)?;
        let middle = mean(greys(&picture, &mask));
        Ok(mean(greys(&picture, &mask).map(|grey| (grey - middle).powi(2))).sqrt())
    };
    let [light, enhanced] = [deviation(Show::Diffuse)?, deviation(Show::Cem)?];
    Ok(Finding::of(
        enhanced > light,
        vec![
            Number::new("standard deviation of the light, of 255", light, "", 1),
            Number::new("of the enhanced light, m = 1.5", enhanced, "", 1),
        ],
    ))
}

pub(super) fn smudge_darkens(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let plain = draw(lab, &published(lab), Show::Final)?;
    let smudged = draw(lab, &Charcoal { smudge: true, ..published(lab) }, Show::Final)?;
    let [before, after] = [&plain, &smudged].map(|picture| mean(greys(picture, &mask)));
    let lighter = greys(&plain, &mask).zip(greys(&smudged, &mask)).filter(|(plain, smudged)| smudged > plain).count();
    Ok(Finding::of(
        after < before && lighter == 0,
        vec![
            Number::new("darker on average, of 255", before - after, "", 1),
            Number::count("pixels that are lighter", lighter),
        ],
    ))
}

pub(super) fn smudge_softens(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let mut grain = |smudge| -> Result<f64> {
        Ok(roughness(&draw(lab, &Charcoal { smudge, ..published(lab) }, Show::Final)?, &mask))
    };
    let [plain, smudged] = [grain(false)?, grain(true)?];
    Ok(Finding::of(
        smudged < plain,
        vec![Number::new("neighbours differ, of 255", plain, "", 1), Number::new("smudged", smudged, "", 1)],
    ))
}

/// White paper.
fn white(size: Size) -> TextureSource {
    let picture = Arc::new(Picture { size, pixels: vec![u8::MAX; size.pixel_count() * 4] });
    TextureSource::File { path: PathBuf::from("white.png"), picture }
}

pub(super) fn parameters_decide(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let base = published(lab);
    let saturated = || Charcoal { saturation: 1.2, ..published(lab) };
    let pairs = [
        ("density 85", base.clone(), Charcoal { density_percent: 85.0, ..base.clone() }),
        ("the texture's exponent 15", base.clone(), Charcoal { cet_exponent: 15.0, ..base.clone() }),
        ("the model's exponent 2", base.clone(), Charcoal { contrast_exponent: 2.0, ..base.clone() }),
        ("other lights", base.clone(), Charcoal { lights: OTHER_LIGHTS, ..base.clone() }),
        ("the saturated coordinate", saturated(), Charcoal { cet_coordinate: CetCoordinate::Saturated, ..saturated() }),
        ("smudging", base.clone(), Charcoal { smudge: true, ..base.clone() }),
        ("white paper", base.clone(), Charcoal { paper: white(lab.size), ..base.clone() }),
    ];
    let mut numbers = Vec::new();
    for (what, one, other) in pairs {
        let [one, other] = [draw(lab, &one, Show::Final)?, draw(lab, &other, Show::Final)?];
        numbers.push(Number::share(what, changed(&one, &other, CHANGED, Some(&mask))));
    }
    Ok(Finding::of(numbers.iter().all(|number| number.value >= 1.0), numbers))
}

pub(super) fn single_pass(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let plan = Style::Charcoal(published(lab)).plan(&scene, Show::Final)?;
    let is_model = |step: &Step| matches!(step, Step::Draw(draw) if matches!(draw.geometry, Geometry::Objects(_)));
    let draws = plan.steps().filter(|(_, step)| is_model(step)).count();
    Ok(Finding::of(
        plan.passes.len() == 1 && draws == 1,
        vec![Number::count("passes", plan.passes.len()), Number::count("times the model is drawn", draws)],
    ))
}

pub(super) fn mipmap_blurs(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let mut grain = |cet_filter| -> Result<f64> {
        Ok(roughness(&draw(lab, &Charcoal { cet_filter, ..published(lab) }, Show::Cet)?, &mask))
    };
    let [linear, mipmap] = [grain(CetFilter::Linear)?, grain(CetFilter::Mipmap)?];
    Ok(Finding::of(
        mipmap < linear * 0.8,
        vec![
            Number::new("neighbours differ with GL_LINEAR, of 255", linear, "", 1),
            Number::new("with mipmaps", mipmap, "", 1),
        ],
    ))
}

pub(super) fn mipmap_panels() -> Vec<Panel> {
    let shown = |file: &str, label, cet_filter, options: &str| {
        let charcoal = Charcoal { cet_filter, ..Charcoal::default() };
        panel(file, label, "builtin:bust", Shot::face(), Style::Charcoal(charcoal), options).showing(Show::Cet, "cet")
    };
    vec![
        shown("claim-v-mipmap-linear", "GL_LINEAR", CetFilter::Linear, "--style charcoal"),
        shown("claim-v-mipmap", "mipmaps", CetFilter::Mipmap, "--style charcoal --cet-filter mipmap"),
    ]
}

pub(super) fn saturation_is_a_factor(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let mut cem = |saturation| draw(lab, &Charcoal { saturation, ..published(lab) }, Show::Cem);
    let [plain, saturated] = [cem(1.0)?, cem(1.2)?];
    // Bright enough to round little, dark enough to avoid clamping.
    let pairs = greys(&plain, &mask).zip(greys(&saturated, &mask)).filter(|(plain, _)| (100.0..200.0).contains(plain));
    let factor = mean(pairs.map(|(plain, saturated)| saturated / plain));
    Ok(Finding::of((factor / 1.2 - 1.0).abs() <= 0.01, vec![Number::new("times as bright", factor, "", 3)]))
}

/// How much darker each pixel is than its sheet, of 255.
fn charcoal_on(lab: &mut Lab<'_>, charcoal: &Charcoal) -> Result<Vec<f64>> {
    let (drawing, sheet) = (draw(lab, charcoal, Show::Final)?, draw(lab, charcoal, Show::Paper)?);
    let pairs = drawing.pixels.chunks_exact(4).zip(sheet.pixels.chunks_exact(4));
    Ok(pairs.map(|(drawn, bare)| f64::from(bare[0]) - f64::from(drawn[0])).collect())
}

/// Mean charcoal on the model, of 255.
fn darkness(lab: &mut Lab<'_>, charcoal: &Charcoal) -> Result<f64> {
    let mask = mask(lab)?;
    Ok(mean(charcoal_on(lab, charcoal)?.into_iter().zip(mask).filter(|(_, is_in)| *is_in).map(|(value, _)| value)))
}

/// Charcoal along the outline: on the model's pixels next to the background, each with the model's pixels around it. Returns its
/// mean, of 255, and the share of the outline that it leaves nearly bare.
fn outline(lab: &mut Lab<'_>, charcoal: &Charcoal) -> Result<[f64; 2]> {
    let mask = mask(lab)?;
    let values = charcoal_on(lab, charcoal)?;
    let Size { width, height } = lab.size;
    let (width, height) = (i64::from(width), i64::from(height));
    let at = |x: i64, y: i64| (0..width).contains(&x) && (0..height).contains(&y) && mask[(y * width + x) as usize];
    let is_inside = |x: i64, y: i64| (1..width - 1).contains(&x) && (1..height - 1).contains(&y);
    let mut along = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let has_ground = [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().any(|(right, down)| !at(x + right, y + down));
            if at(x, y) && is_inside(x, y) && has_ground {
                let near =
                    (-AROUND..=AROUND).flat_map(|down| (-AROUND..=AROUND).map(move |right| (x + right, y + down)));
                let near = near.filter(|(x, y)| at(*x, *y)).map(|(x, y)| values[(y * width + x) as usize]);
                along.push(mean(near));
            }
        }
    }
    let bare = mean(along.iter().map(|charcoal| f64::from(u8::from(*charcoal < BARE))));
    Ok([mean(along.into_iter()), bare])
}

/// The published settings, and the same with one of them changed.
fn pair(lab: &Lab<'_>, change: impl Fn(&mut Charcoal)) -> [Charcoal; 2] {
    let base = published(lab);
    let mut other = base.clone();
    change(&mut other);
    [base, other]
}

/// The effect of one changed parameter on the charcoal on the model.
fn darkens(lab: &mut Lab<'_>, what: &'static str, change: impl Fn(&mut Charcoal)) -> Result<Finding> {
    let [base, other] = pair(lab, change);
    let [before, after] = [darkness(lab, &base)?, darkness(lab, &other)?];
    Ok(Finding::of(
        after > before,
        vec![Number::new("charcoal on the model, of 255", before, "", 1), Number::new(what, after, "", 1)],
    ))
}

pub(super) fn density_darkens(lab: &mut Lab<'_>) -> Result<Finding> {
    darkens(lab, "with density 85", |charcoal| charcoal.density_percent = 85.0)
}

pub(super) fn smaller_exponent_darkens(lab: &mut Lab<'_>) -> Result<Finding> {
    by_three_lights(
        lab,
        "charcoal on the model, of 255",
        "with exponent 1.2",
        1.2,
        |before, after| after > before,
        darkness,
    )
}

/// Another exponent by three choices of lights: where their sum is above 1, its powers go the other way, and the report does not
/// print its lights.
fn by_three_lights(
    lab: &mut Lab<'_>,
    what: &'static str,
    then: &'static str,
    contrast_exponent: f32,
    rule: fn(f64, f64) -> bool,
    measure: fn(&mut Lab<'_>, &Charcoal) -> Result<f64>,
) -> Result<Finding> {
    let (mut holds, mut numbers) = (Vec::new(), Vec::new());
    let ours = (Charcoal::default().lights, what);
    for (lights, name) in [ours, (IN_FRONT, "with both lights in front"), (AT_THE_LEFT, "with both at the left")] {
        let base = Charcoal { lights, ..published(lab) };
        let [before, after] = [measure(lab, &base)?, measure(lab, &Charcoal { contrast_exponent, ..base.clone() })?];
        holds.push(rule(before, after));
        numbers.extend([Number::new(name, before, "", 1), Number::new(then, after, "", 1)]);
    }
    if holds.iter().all(|one| *one == holds[0]) {
        return Ok(Finding::of(holds[0], numbers));
    }
    Ok(Finding::undecided("the lights decide, and the report does not print its lights", numbers))
}

pub(super) fn smudging_darkens(lab: &mut Lab<'_>) -> Result<Finding> {
    darkens(lab, "smudged", |charcoal| charcoal.smudge = true)
}

/// The effect of one changed parameter along the outline.
fn closes(lab: &mut Lab<'_>, what: &'static str, change: impl Fn(&mut Charcoal)) -> Result<Finding> {
    let [base, other] = pair(lab, change);
    let [[before, bare_before], [after, bare]] = [outline(lab, &base)?, outline(lab, &other)?];
    Ok(Finding::of(
        after < before,
        vec![
            Number::new("charcoal along the outline, of 255", before, "", 1),
            Number::new(what, after, "", 1),
            Number::share("of the outline nearly bare", bare_before),
            Number::share("then", bare),
        ],
    ))
}

pub(super) fn smaller_density_closes(lab: &mut Lab<'_>) -> Result<Finding> {
    closes(lab, "with density 35", |charcoal| charcoal.density_percent = 35.0)
}

pub(super) fn larger_exponent_closes(lab: &mut Lab<'_>) -> Result<Finding> {
    let along = |lab: &mut Lab<'_>, charcoal: &Charcoal| outline(lab, charcoal).map(|[along, _]| along);
    by_three_lights(
        lab,
        "charcoal along the outline, of 255",
        "with exponent 2",
        2.0,
        |before, after| after < before,
        along,
    )
}

pub(super) fn saturation_closes(lab: &mut Lab<'_>) -> Result<Finding> {
    closes(lab, "with saturation 1.4", |charcoal| charcoal.saturation = 1.4)
}

/// Lights from both sides, near the picture's plane: the command's.
const OTHER_LIGHTS: [Option<[f32; 3]>; 2] = [Some([-0.9, 0.3, 0.3]), Some([0.9, -0.3, 0.2])];

pub(super) fn lights_matter(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let base = draw(lab, &published(lab), Show::Final)?;
    let mut change = |charcoal: Charcoal| -> Result<f64> {
        let other = draw(lab, &Charcoal { texture_size: lab.size, ..charcoal }, Show::Final)?;
        Ok(mean(greys(&base, &mask).zip(greys(&other, &mask)).map(|(one, other)| (one - other).abs())))
    };
    let lights = change(Charcoal { lights: OTHER_LIGHTS, ..Charcoal::default() })?;
    let darker = change(Charcoal::recipe(CharcoalRecipe::Darker))?;
    Ok(Finding::of(
        lights > darker,
        vec![
            Number::new("mean change by the lights, of 255", lights, "", 1),
            Number::new("by the recipe darker", darker, "", 1),
        ],
    ))
}

pub(super) fn generators_differ_subtly(lab: &mut Lab<'_>) -> Result<Finding> {
    let mask = mask(lab)?;
    let base = draw(lab, &published(lab), Show::Final)?;
    let (mut is_subtle, mut numbers) = (true, Vec::new());
    for (random, name) in [(Generator::Msvc, "msvc"), (Generator::Glibc, "glibc")] {
        let other = draw(lab, &Charcoal { random, ..published(lab) }, Show::Final)?;
        let share = changed(&base, &other, CHANGED, Some(&mask));
        let tone = mean(greys(&other, &mask)) - mean(greys(&base, &mask));
        is_subtle &= share > 0.0 && tone.abs() < 1.0;
        numbers.push(Number::share(format!("pixels that change with rand() of {name}"), share));
        numbers.push(Number::new("change of the mean, of 255", tone, "", 1));
    }
    Ok(Finding::of(is_subtle, numbers))
}

/// How much of a sand picture is charcoal: the text's mix.
const CHARCOAL_SHARE: f64 = 0.4;

pub(super) fn sand_has_a_texture(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:soldier")?;
    let mask = lab.mask(&scene)?;
    let mut deviation = |luminance| -> Result<f64> {
        let improve = Improvements { luminance, ..Improvements::default() };
        let charcoal = Charcoal { improve, ..published(lab) };
        let sand = lab.draw(&scene, &Style::Sand(charcoal.clone()), Show::Final)?;
        let drawn = lab.draw(&scene, &Style::Charcoal(charcoal), Show::Final)?;
        // Blue, which is clamped least; without the charcoal, the texture's share of it remains.
        let blues = |picture: &Picture| -> Vec<f64> {
            picture.pixels.chunks_exact(4).map(|pixel| f64::from(pixel[2])).collect()
        };
        let pairs = blues(&sand).into_iter().zip(blues(&drawn)).zip(&mask);
        let parts: Vec<f64> = pairs
            .filter(|((sand, _), is_in)| **is_in && *sand < 255.0)
            .map(|((sand, drawn), _)| (sand - CHARCOAL_SHARE * drawn) / (1.0 - CHARCOAL_SHARE))
            .collect();
        let middle = mean(parts.iter().copied());
        Ok(mean(parts.iter().map(|part| (part - middle).powi(2))).sqrt())
    };
    let [published, mended] = [deviation(false)?, deviation(true)?];
    Ok(Finding::of(
        published >= 1.0,
        vec![
            Number::new("standard deviation of the texture's part, of 255", published, "", 1),
            Number::new("with Rec. 709's weights", mended, "", 1),
        ],
    ))
}
