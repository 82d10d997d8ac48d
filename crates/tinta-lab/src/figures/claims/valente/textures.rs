//! The claims about preparations before drawing, and about GLSL's own noise.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, roughness};
use tinta::error::Result;
use tinta::plan::{Depth, Draw, Geometry, Pass, Plan, Program, Step};
use tinta::scene::Size;
use tinta::textures::ContrastTexture;

const SIZE: Size = Size { width: 256, height: 256 };

pub(super) fn grains_move(_: &mut Lab<'_>) -> Result<Finding> {
    let mean_t = |texture: ContrastTexture| Ok::<f64, tinta::Error>(texture.grains()?.mean_t().unwrap_or(f64::NAN));
    let base = || ContrastTexture { size: SIZE, ..ContrastTexture::default() };
    let [scattered, moved] = [mean_t(ContrastTexture { exponent: 1.0, ..base() })?, mean_t(base())?];
    Ok(Finding::of(
        moved < scattered,
        vec![Number::new("mean t as scattered", scattered, "", 2), Number::new("moved with m = 5.5", moved, "", 2)],
    ))
}

pub(super) fn blur_softens(_: &mut Lab<'_>) -> Result<Finding> {
    let all = vec![true; SIZE.pixel_count()];
    let difference = |blur_px| {
        let texture = ContrastTexture { size: SIZE, blur_px, ..ContrastTexture::default() };
        texture.picture().map(|picture| roughness(&picture, &all))
    };
    let [sharp, blurred] = [difference(0.0)?, difference(0.8)?];
    Ok(Finding::of(
        blurred < sharp,
        vec![
            Number::new("neighbours differ, of 255", sharp, "", 1),
            Number::new("after a blur of 0.8 pixels", blurred, "", 1),
        ],
    ))
}

pub(super) fn noise_is_zero(lab: &mut Lab<'_>) -> Result<Finding> {
    let program = Program { vertex: "evangelista/border.vert", fragments: vec!["valente/noise-function.frag"] };
    let square = Draw { depth: Depth::Ignore, ..Draw::new(Geometry::ScreenSquare, Some(program)) };
    let plan = Plan::new(vec![Pass::new("noise", vec![Step::clear([0.0; 4]), Step::Draw(square)])]);
    let scene = lab.scene("builtin:open-box")?;
    let picture = lab.renderer.draw(&scene, &plan)?;
    let pixels = picture.pixels.chunks_exact(4);
    let other = pixels.filter(|pixel| pixel.iter().any(|channel| *channel > 0)).count();
    Ok(Finding::of(
        other == 0,
        vec![Number::count("pixels where noise is not 0", other), Number::count("of", picture.size.pixel_count())],
    ))
}
