//! The claims about passes, maps and tones: pictures compared with pictures, and the contents of plans and shaders.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, changed};
use crate::figures::figure::{Panel, Shot, panel};
use crate::figures::kernels;
use crate::figures::mix::{Kit, TRIANGLES};
use std::collections::BTreeSet;
use std::time::Instant;
use tinta::edges::{EdgeList, Incidence};
use tinta::error::Result;
use tinta::glsl;
use tinta::picture::Picture;
use tinta::renderer::milliseconds_since;
use tinta::scene::{Background, Color, SceneSettings};
use tinta::styles::{Cartoon, Filter, Mrt, Show, Style, ToneLookup, Tones};

/// Share of pixels that may differ between pictures that are the same up to rounding.
const SAME: f64 = 0.01;

/// A pixel differs beyond this, of 255.
const ROUNDING: u8 = 2;

/// The share of pixels that differ from the three passes' picture.
fn against_three(lab: &mut Lab<'_>, style: &Style) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let three = lab.draw(&scene, &Style::ThreePass(Cartoon::default()), Show::Final)?;
    let other = lab.draw(&scene, style, Show::Final)?;
    let share = changed(&three, &other, ROUNDING, None);
    Ok(Finding::of(share <= SAME, vec![Number::share("pixels that differ", share)]))
}

pub(super) fn one_geometry_pass(lab: &mut Lab<'_>) -> Result<Finding> {
    against_three(lab, &Style::Mrt(Mrt::default()))
}

pub(super) fn two_passes(lab: &mut Lab<'_>) -> Result<Finding> {
    against_three(lab, &Style::TwoPass(Cartoon::default()))
}

fn colors(picture: &Picture) -> BTreeSet<&[u8]> {
    picture.pixels.chunks_exact(4).collect()
}

pub(super) fn tones_are_flat(lab: &mut Lab<'_>) -> Result<Finding> {
    let settings = SceneSettings {
        background: Background::Color(Color([0.0; 3])),
        color: Some(Color([1.0; 3])),
        ..SceneSettings::default()
    };
    let scene = lab.seen("builtin:gear", settings)?;
    let picture = lab.draw(&scene, &Style::ThreePass(Cartoon { border: None, ..Cartoon::default() }), Show::Final)?;
    // One of them is the background.
    let count = colors(&picture).len().saturating_sub(1);
    Ok(Finding::of(count <= 3, vec![Number::count("colours of the model", count)]))
}

pub(super) fn tone_texture(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:bust")?;
    let mut with = |lookup| {
        let tones = Tones { lookup, ..Tones::default() };
        lab.draw(&scene, &Style::ThreePass(Cartoon { tones, border: None, ..Cartoon::default() }), Show::Final)
    };
    let [steps, texture] = [with(ToneLookup::Steps)?, with(ToneLookup::Texture)?];
    let mask = lab.mask(&scene)?;
    let share = changed(&steps, &texture, ROUNDING, Some(&mask));
    Ok(Finding::of(share <= SAME, vec![Number::new("pixels of another tone", share * 100.0, "%", 2)]))
}

pub(super) fn memory_of_edges(lab: &mut Lab<'_>) -> Result<Finding> {
    let kit = Kit::new()?;
    let map_bytes = lab.size.pixel_count() * 4;
    // Both ends, both faces and a word for their arrangement: the contents of an edge in `EdgeList`, and in the text of 2001 too.
    let edge_bytes = size_of::<[u32; 2]>() * 2 + size_of::<Incidence>();
    let mut rows = Vec::new();
    for wanted in [TRIANGLES[0], TRIANGLES[TRIANGLES.len() - 1]] {
        let meshes = kit.meshes(&kit.mix(wanted));
        let start = Instant::now();
        let edges: usize = meshes.iter().map(|mesh| EdgeList::new(mesh).len()).sum();
        rows.push((edges * edge_bytes, milliseconds_since(start)));
    }
    let kib = |bytes: usize| bytes as f64 / 1024.0;
    let [(small, _), (large, large_ms)] = [rows[0], rows[1]];
    Ok(Finding::of(
        large > map_bytes,
        vec![
            Number::new("edges of the largest scene", kib(large), "KiB", 0),
            Number::new("found once, in", large_ms, "ms", 1),
            Number::new("edges of the smallest scene", kib(small), "KiB", 0),
            Number::new("the map", kib(map_bytes), "KiB", 0),
        ],
    ))
}

pub(super) fn eight_bits(lab: &mut Lab<'_>) -> Result<Finding> {
    let mut depths = |near_far: Option<(f64, f64)>| -> Result<usize> {
        let mut settings = SceneSettings::default();
        (settings.camera.near, settings.camera.far) = near_far.unzip();
        let scene = lab.seen("builtin:bust", settings)?;
        let map = lab.draw(&scene, &Style::ThreePass(Cartoon::default()), Show::Map)?;
        Ok(map.pixels.chunks_exact(4).map(|pixel| pixel[3]).collect::<BTreeSet<u8>>().len())
    };
    let [fitted, wide] = [depths(None)?, depths(Some((0.001, 1000.0)))?];
    Ok(Finding::of(
        fitted <= 256,
        vec![
            Number::count("depths in the map, planes fitted to the bust", fitted),
            Number::count("planes at 0.001 and 1000", wide),
        ],
    ))
}

/// How often a filter's shader reads the map: its calls, without the declaration.
fn reads_of(shader: &str) -> usize {
    let code = glsl::source(shader).unwrap_or_default().lines().filter(|line| !line.starts_with("//"));
    code.map(|line| line.matches("tap(").count()).sum::<usize>().saturating_sub(1)
}

pub(super) fn reads(_: &mut Lab<'_>) -> Result<Finding> {
    let [full, mitchell, own] =
        ["laplacian8", "mitchell", "laplacian4"].map(|filter| reads_of(&format!("evangelista/filter-{filter}.frag")));
    Ok(Finding::of(
        [full, mitchell, own] == [9, 5, 5],
        vec![
            Number::count("reads of the Laplacian", full),
            Number::count("of Mitchell's filter", mitchell),
            Number::count("of the paper's", own),
        ],
    ))
}

pub(super) fn directions(_: &mut Lab<'_>) -> Result<Finding> {
    let [kernel] = kernels(Filter::Laplacian4)[..] else { return Ok(Finding::nowhere("it is no single matrix")) };
    // The filter's side of the step is 0, the other 1.
    let step = |is_beyond: &dyn Fn(usize, usize) -> bool| -> f64 {
        let cells = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
        cells
            .filter(|(row, column)| is_beyond(*row, *column))
            .map(|(row, column)| kernel.weight(row, column))
            .sum::<f64>()
    };
    let upright = step(&|_, column| column == 2).abs();
    let level = step(&|row, _| row == 0).abs();
    let slanting = step(&|row, column| column > row).abs();
    Ok(Finding::of(
        upright == level && upright > 0.0,
        vec![
            Number::new("answer to an upright step of 1", upright, "", 0),
            Number::new("to a level one", level, "", 0),
            Number::new("to a slanting one", slanting, "", 0),
        ],
    ))
}

fn two_pass(background_square: bool) -> Style {
    Style::TwoPass(Cartoon { background_square, ..Cartoon::default() })
}

pub(super) fn needs_square(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:ant")?;
    let outside: Vec<bool> = lab.mask(&scene)?.into_iter().map(|is_in| !is_in).collect();
    let mut inked = |square| -> Result<usize> {
        let picture = lab.draw(&scene, &two_pass(square), Show::Final)?;
        let pixels = picture.pixels.chunks_exact(4).zip(&outside);
        Ok(pixels.filter(|(pixel, is_out)| **is_out && pixel[..3] != [255; 3]).count())
    };
    let [without, with] = [inked(false)?, inked(true)?];
    Ok(Finding::of(
        without == 0 && with > 0,
        vec![
            Number::count("pixels with ink off the model, without the square", without),
            Number::count("with it", with),
        ],
    ))
}

pub(super) fn needs_square_panels() -> Vec<Panel> {
    let near = || Shot::eye([0.4, 1.9, 4.6], [0.0, 0.8, 0.0], 26.0, "--eye 0.4,1.9,4.6 --target 0,0.8,0 --fov 26");
    let shown =
        |file: &str, label, square, options: &str| panel(file, label, "builtin:ant", near(), two_pass(square), options);
    vec![
        shown("claim-e-needs-square-on", "with the square", true, "--style two-pass"),
        shown("claim-e-needs-square-off", "without", false, "--style two-pass --background-quad off"),
    ]
}
