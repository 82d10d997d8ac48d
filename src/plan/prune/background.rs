//! Pixels without an object: squares that could be a clear, squares that need not reach there, clears that are drawn over.

use super::{Facts, Omission, Rule, counted};
use crate::plan::{Depth, Draw, Geometry, Pass, Plan, Step, Target, Texture, Uniform, Value};
use crate::scene::Rectangle;
use crate::tolerances::EIGHT_BIT_TIE;

/// Clears to what the background square would draw.
pub(super) fn square(plan: &mut Plan) -> Result<Omission, String> {
    let mut passes = Vec::new();
    let mut kept = "no step draws one".to_owned();
    for pass in &mut plan.passes {
        let [Step::Clear { color: Some(color), depth: true }, Step::Draw(draw), ..] = pass.steps.as_mut_slice() else {
            continue;
        };
        let Geometry::BackgroundSquare { color: given } = draw.geometry else { continue };
        let Some(drawn) = constant_color(draw, given) else {
            kept = "borders are drawn on the background square".to_owned();
            continue;
        };
        if has_eight_bits(pass.target) && !drawn.iter().all(|channel| rounds_alike(*channel)) {
            kept = "the background's colour lies in the middle between two of 8 bits, and drivers may round either way"
                .to_owned();
            continue;
        }
        *color = drawn;
        pass.steps.remove(1);
        passes.push(pass.name);
    }
    if passes.is_empty() {
        return Err(kept);
    }
    Ok(Omission {
        rule: Rule::BackgroundSquare,
        what: format!("the background square in {}: {}", counted(passes.len(), "pass", "passes"), passes.join(", ")),
        reason: "clearing to the colour it draws leaves the same pixels".to_owned(),
        facts: vec![
            "it faces the eye from far away: its shaders give one normal, one depth and one tone all over".to_owned(),
        ],
    })
}

/// The colour that a background square of this colour has in all its pixels, if it is one.
fn constant_color(draw: &Draw, [red, green, blue, _]: [f32; 4]) -> Option<[f32; 4]> {
    let program = draw.program.as_ref()?;
    if draw.blend || draw.depth != Depth::Ignore || draw.scissor.is_some() {
        return None;
    }
    match (program.vertex, program.fragments.first().copied()?) {
        // Its normal in eye space, and depth that of the far plane.
        ("evangelista/map.vert", "evangelista/map.frag") => Some([0.0, 0.0, 1.0, 1.0]),
        ("improved/map-biased.vert", "evangelista/map.frag") => Some([0.5, 0.5, 1.0, 1.0]),
        ("improved/map-float.vert", "improved/map-float.frag") => Some([0.0, 0.0, 1.0, 1.0]),
        // Its tone is 1: the published highlight's, or that of settings with all levels 1.
        ("evangelista/toon.vert", "evangelista/toon.frag" | "evangelista/toon-settings.frag") => {
            Some([red, green, blue, 1.0])
        }
        _ => None,
    }
}

/// Whether a channel of what is drawn into has 8 bits.
fn has_eight_bits(target: Target) -> bool {
    match target {
        Target::Framebuffer => true,
        Target::Textures(attachments) => attachments.colors.iter().any(|attachment| !attachment.format.is_float()),
    }
}

/// Whether clearing and drawing round this channel to the same of 8 bits, whichever way they round a tie.
fn rounds_alike(channel: f32) -> bool {
    ((f64::from(channel) * 255.0).fract() - 0.5).abs() > EIGHT_BIT_TIE
}

/// Confines squares to the pixels that an object can change.
pub(super) fn empty_pixels(plan: &mut Plan, facts: &Facts<'_>) -> Result<Omission, String> {
    let whole = facts.surface.pixel_count();
    let (mut changed, mut saved) = (Vec::new(), 0);
    for pass in &mut plan.passes {
        let cleared = match pass.steps.first() {
            Some(Step::Clear { color, .. }) => *color,
            _ => None,
        };
        let Some(place) = pass.steps.iter().position(|step| answers_to_objects_only(step, cleared)) else { continue };
        let Step::Draw(draw) = &mut pass.steps[place] else { continue };
        let reach = reach_px(draw);
        let needed = facts.extent().map(|extent| extent.grown(reach, facts.surface));
        let count = needed.map_or(0, Rectangle::pixel_count);
        // Nothing is saved by a frame of single pixels.
        if draw.scissor.is_some() || count * 20 > whole * 19 {
            continue;
        }
        changed.push(pass.name);
        saved += whole - count;
        match needed {
            Some(rectangle) => draw.scissor = Some(rectangle),
            None => drop(pass.steps.remove(place)),
        }
    }
    if changed.is_empty() {
        return Err("no square answers to objects alone, or they fill the picture".to_owned());
    }
    plan.passes.retain(|pass| !pass.steps.is_empty());
    confine_maps(plan, facts);
    let percent = saved * 100 / (whole * changed.len());
    Ok(Omission {
        rule: Rule::EmptyPixels,
        what: format!("{percent} % of the pixels of the square in {}, and of the map it reads", changed.join(", ")),
        reason:
            "no object reaches them, the map is the same all around them, and the filter answers to differences alone"
                .to_owned(),
        facts: vec![match facts.extent() {
            Some(Rectangle { x, y, width, height }) => {
                format!("objects lie in {width} x {height} pixels from ({x}, {y}) of {}", facts.surface)
            }
            None => "no object lies in the picture".to_owned(),
        }],
    })
}

/// Confines clearing, drawing and copying a map to the pixels that are read of it, where only confined squares and objects do.
fn confine_maps(plan: &mut Plan, facts: &Facts<'_>) {
    let Some(extent) = facts.extent() else { return };
    for number in 0..plan.passes.len() - 1 {
        let pass = &plan.passes[number];
        let leaves: Vec<Texture> = match pass.target {
            Target::Textures(attachments) => {
                attachments.colors.iter().map(|attachment| Texture::Drawn(attachment.name)).collect()
            }
            Target::Framebuffer => pass.steps.iter().filter_map(copied).collect(),
        };
        let later = || plan.passes[number + 1..].iter();
        // What the pass itself draws must be gone, or read by these textures alone.
        let is_gone = match pass.target {
            Target::Framebuffer => later()
                .find(|pass| pass.target == Target::Framebuffer)
                .is_some_and(|pass| matches!(pass.steps.first(), Some(Step::Clear { color: Some(_), depth: true }))),
            Target::Textures(_) => !later().any(|later| later.target != Target::Framebuffer),
        };
        // The readers end where the texture is copied anew.
        let reads = |draw: &Draw| draw.textures.iter().any(|(_, texture)| leaves.contains(texture));
        let steps = later().flat_map(|pass| &pass.steps);
        let until = steps.take_while(|step| !copied(step).is_some_and(|texture| leaves.contains(&texture)));
        let readers: Vec<&Draw> = until
            .filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None })
            .filter(|d| reads(d))
            .collect();
        let is_confined = |draw: &&Draw| draw.scissor.is_some() || draw.is_of_objects();
        if leaves.is_empty() || readers.is_empty() || !is_gone || !readers.iter().all(is_confined) {
            continue;
        }
        let reach = readers.iter().map(|draw| reach_px(draw)).max().unwrap_or_default();
        // As far as the squares go, and from there as far as they look.
        plan.passes[number].scissor = Some(extent.grown(reach.saturating_mul(2), facts.surface));
    }
}

/// The texture that a step copies into.
fn copied(step: &Step) -> Option<Texture> {
    match step {
        Step::CopyFramebuffer => Some(Texture::BorderMap),
        Step::CopyDepth => Some(Texture::DepthMap),
        Step::Clear { .. } | Step::ClearEach { .. } | Step::Draw(_) => None,
    }
}

/// Whether a step is a square that leaves pixels as they are, or cleared, wherever the map is the same all around.
fn answers_to_objects_only(step: &Step, cleared: Option<[f32; 4]>) -> bool {
    let Step::Draw(draw) = step else { return false };
    let borders = ["evangelista/border.frag", "evangelista/border-settings.frag"];
    match draw.geometry {
        Geometry::ScreenSquare => {
            draw.blend && borders.iter().any(|shader| draw.has_shader(shader))
                || draw.has_shader("improved/plane-ink.frag")
        }
        Geometry::BackgroundSquare { color } if cleared == Some(color) => {
            let two_pass = ["evangelista/two-pass.frag", "evangelista/two-pass-settings.frag"];
            two_pass.iter().any(|shader| draw.has_shader(shader)) && color.iter().all(|channel| rounds_alike(*channel))
        }
        _ => false,
    }
}

/// How far a draw's filter looks, pixels.
fn reach_px(draw: &Draw) -> u32 {
    let given = draw.uniforms.iter().find(|uniform| uniform.name == "reach").map(|Uniform { value, .. }| *value);
    let taps = match given {
        Some(Value::Vec2([before, behind])) => before.max(behind).ceil() as u32,
        _ => 1,
    };
    // The slope's threshold looks twice as far; one pixel more costs nothing.
    taps * if draw.has_shader("improved/slope-threshold.frag") { 2 } else { 1 } + 1
}

/// Leaves a colour uncleared that the next step draws over.
pub(super) fn overwritten_clear(plan: &mut Plan, facts: &Facts<'_>) -> Result<Omission, String> {
    let covers = |draw: &Draw| {
        let is_full = matches!(draw.geometry, Geometry::ScreenSquare | Geometry::BackgroundSquare { .. });
        is_full
            && draw.depth == Depth::Ignore
            && !draw.blend
            && draw.scissor.is_none()
            // It leaves pixels out.
            && !draw.has_shader("improved/plane-ink.frag")
    };
    let mut passes = Vec::new();
    // Measured: charcoal takes 1.1 times as long without it.
    if facts.pruning.is_software {
        return Err(
            "drawing on the processor goes tile by tile, and a tile that is not cleared is first read".to_owned()
        );
    }
    for Pass { name, steps, .. } in &mut plan.passes {
        if let [Step::Clear { color: color @ Some(_), depth: true }, Step::Draw(draw), ..] = steps.as_mut_slice()
            && covers(draw)
        {
            *color = None;
            passes.push(*name);
        }
    }
    if passes.is_empty() {
        return Err("no step draws over all that was cleared before it".to_owned());
    }
    Ok(Omission {
        rule: Rule::OverwrittenClear,
        what: format!("clearing the colour in {}", passes.join(", ")),
        reason: "the next step draws over every pixel without blending".to_owned(),
        facts: vec!["that step is an opaque square over the whole picture".to_owned()],
    })
}
