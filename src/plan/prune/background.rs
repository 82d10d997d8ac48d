//! Pixels without an object: squares that a clear can replace, squares that need not cover them, clears that are overdrawn.

use super::ground::{Ground, covers, stays_in_objects};
use super::rule::{Omission, Rule, Situation, counted, drop_empty_passes};
use crate::plan::{Blend, Depth, Draw, Geometry, Pass, Plan, Step, Target, Texture, WhereEven};
use crate::scene::Rectangle;
use crate::tolerances::EIGHT_BIT_TIE;

/// Replaces the background square by a clear to its values.
pub(super) fn square(plan: &mut Plan) -> Result<Omission, String> {
    let mut passes = Vec::new();
    let mut kept = "no step draws one".to_owned();
    for pass in &mut plan.passes {
        let [Step::Clear { color: Some(color), depth: true }, Step::Draw(draw), ..] = pass.steps.as_mut_slice() else {
            continue;
        };
        let Geometry::BackgroundSquare { .. } = draw.geometry else { continue };
        let constant = draw.facts.constant_color.filter(|_| covers(draw) && pass.target.color_count() == 1);
        let Some(drawn) = constant else {
            kept = match draw.facts.where_even {
                Some(_) => "borders are drawn on the background square".to_owned(),
                None => "its shaders may not give a uniform colour".to_owned(),
            };
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
        facts: vec!["it faces the eye from far away: its shaders give a uniform normal, depth and tone".to_owned()],
    })
}

/// Whether the target has 8 bits per channel.
fn has_eight_bits(target: Target) -> bool {
    match target {
        Target::Framebuffer => true,
        Target::Textures(attachments) => attachments.colors.iter().any(|attachment| !attachment.format.is_float()),
    }
}

/// Whether clearing and drawing round this channel to the same 8 bits, whichever way they round a tie.
fn rounds_alike(channel: f32) -> bool {
    ((f64::from(channel) * 255.0).fract() - 0.5).abs() > EIGHT_BIT_TIE
}

/// Confines squares to the pixels that an object can change.
pub(super) fn empty_pixels(plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
    let whole = situation.surface.pixel_count();
    let (mut changed, mut saved) = (Vec::new(), 0);
    let mut ground = Ground::default();
    for pass in &mut plan.passes {
        let mut confined = None;
        for (place, step) in pass.steps.iter().enumerate() {
            if let Step::Draw(draw) = step
                && confined.is_none()
                && draw.scissor.or(pass.scissor).is_none()
                && let Some(reach) = reach_beyond_objects(draw, &pass.steps[..place], &ground)
            {
                confined = Some((place, reach));
            }
            ground.follow(step, pass.target, pass.scissor);
        }
        let Some((place, reach)) = confined else { continue };
        let needed = situation.extent().map(|extent| extent.grown(reach, situation.surface));
        let count = needed.map_or(0, Rectangle::pixel_count);
        // A frame of single pixels saves no time.
        if count * 20 > whole * 19 {
            continue;
        }
        changed.push(pass.name);
        saved += whole - count;
        match (&mut pass.steps[place], needed) {
            (Step::Draw(draw), Some(rectangle)) => draw.scissor = Some(rectangle),
            _ => drop(pass.steps.remove(place)),
        }
    }
    if changed.is_empty() {
        return Err("no square depends on the objects alone, or the objects fill the picture".to_owned());
    }
    drop_empty_passes(plan);
    confine_maps(plan, situation);
    let percent = saved * 100 / (whole * changed.len());
    Ok(Omission {
        rule: Rule::EmptyPixels,
        what: format!("{percent} % of the pixels of the square in {}, and of the map it reads", changed.join(", ")),
        reason: "no object reaches them, the map is uniform around them, and the filter responds to differences only"
            .to_owned(),
        facts: vec![match situation.extent() {
            Some(Rectangle { x, y, width, height }) => {
                format!("objects lie in {width} x {height} pixels from ({x}, {y}) of {}", situation.surface)
            }
            None => "no object lies in the picture".to_owned(),
        }],
    })
}

/// Confines clearing, drawing and copying of a map to the pixels that are read, where only confined squares and objects read it.
fn confine_maps(plan: &mut Plan, situation: &Situation<'_>) {
    for number in 0..plan.passes.len().saturating_sub(1) {
        let pass = &plan.passes[number];
        let leaves: Vec<Texture> = match pass.target {
            Target::Textures(attachments) => {
                attachments.colors.iter().map(|attachment| Texture::Drawn(attachment.name)).collect()
            }
            Target::Framebuffer => pass.steps.iter().filter_map(copied).collect(),
        };
        let later = || plan.passes[number + 1..].iter();
        let clears_all = |pass: &Pass| {
            matches!(pass.steps.first(), Some(Step::Clear { color: Some(_), depth: true })) && pass.scissor.is_none()
        };
        // The pass's own picture must be gone, or read by these textures alone.
        let is_gone = match pass.target {
            Target::Framebuffer => later().find(|pass| pass.target == Target::Framebuffer).is_some_and(clears_all),
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
        if readers.is_empty() || !is_gone || pass.scissor.is_some() {
            continue;
        }
        // The squares' pixels, extended by their reach.
        let read: Option<Vec<Rectangle>> = readers.iter().map(|draw| read_px(draw, situation)).collect();
        if let Some(all) = read.and_then(|parts| parts.into_iter().reduce(Rectangle::around)) {
            plan.passes[number].scissor = Some(all);
        }
    }
}

/// Returns the pixels of a map that a draw reads; `None` if it may read all.
fn read_px(draw: &Draw, situation: &Situation<'_>) -> Option<Rectangle> {
    let drawn = match draw.scissor {
        Some(scissor) => scissor,
        None if stays_in_objects(draw) => situation.extent()?,
        None => return None,
    };
    Some(drawn.grown(draw.facts.reach_px?, situation.surface))
}

/// Returns the texture that a step copies into.
fn copied(step: &Step) -> Option<Texture> {
    match step {
        Step::CopyFramebuffer => Some(Texture::BorderMap),
        Step::CopyDepth => Some(Texture::DepthMap),
        Step::Clear { .. } | Step::ClearEach { .. } | Step::Draw(_) => None,
    }
}

/// Returns the distance from objects, in pixels, within which a square may change pixels. Beyond it the square leaves them
/// unchanged, or as cleared, wherever the surrounding map is uniform. `None` for any other draw.
fn reach_beyond_objects(draw: &Draw, before: &[Step], ground: &Ground) -> Option<u32> {
    let is_square = matches!(draw.geometry, Geometry::ScreenSquare | Geometry::BackgroundSquare { .. });
    let is_seen = match draw.facts.where_even? {
        WhereEven::Unchanged => true,
        WhereEven::Color(even) => match before {
            [Step::Clear { color: Some(cleared), .. }] => {
                *cleared == even && draw.blend == Blend::Replace && even.iter().all(|channel| rounds_alike(*channel))
            }
            _ => false,
        },
    };
    let beyond = ground.even_beyond(draw).filter(|_| is_square && is_seen && draw.depth != Depth::TestAndWrite)?;
    draw.facts.reach_px?.checked_add(beyond)
}

/// Skips clearing a colour that the next step draws over.
pub(super) fn overwritten_clear(plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
    let mut passes = Vec::new();
    // Measured: charcoal takes 1.1 times as long without it.
    if situation.pruning.is_software {
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
        return Err("no step overwrites everything that was cleared before it".to_owned());
    }
    Ok(Omission {
        rule: Rule::OverwrittenClear,
        what: format!("clearing the colour in {}", passes.join(", ")),
        reason: "the next step draws over every pixel without blending".to_owned(),
        facts: vec!["that step is an opaque square over the whole picture".to_owned()],
    })
}
