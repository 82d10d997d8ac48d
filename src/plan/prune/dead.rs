//! Dead code elimination for plans: draws that add nothing, maps and copies without a filter, textures without a shader.

use super::rule::{Omission, Rule, counted, drop_empty_passes};
use crate::plan::{Draw, Plan, Step, Target, Texture};

/// Leaves out draws that add nothing, such as borders whose response is multiplied by 0.
pub(super) fn border(plan: &mut Plan) -> Result<Omission, String> {
    let reason = |step: &Step| if let Step::Draw(draw) = step { draw.facts.adds_nothing.clone() } else { None };
    let (mut what, mut facts) = (Vec::new(), Vec::new());
    for (pass, step) in plan.steps() {
        let Some(reason) = reason(step) else { continue };
        what.push(format!("the {pass}'s {}", step.name()));
        if !facts.contains(&reason) {
            facts.push(reason);
        }
    }
    if what.is_empty() {
        return Err("no border is multiplied by 0".to_owned());
    }
    plan.passes.iter_mut().for_each(|pass| pass.steps.retain(|step| reason(step).is_none()));
    drop_empty_passes(plan);
    Ok(Omission { rule: Rule::Border, what: what.join(", "), reason: "it changes no pixel".to_owned(), facts })
}

/// Leaves out passes, draws and copies whose result no later step reads, from the picture backwards.
pub(super) fn unread_map(plan: &mut Plan) -> Result<Omission, String> {
    let textures_of = |target: Target| -> Vec<Texture> {
        match target {
            Target::Framebuffer => Vec::new(),
            Target::Textures(attachments) => {
                attachments.colors.iter().map(|attachment| Texture::Drawn(attachment.name)).collect()
            }
        }
    };
    // Textures that later steps read, and whether they read the framebuffer.
    let mut framebuffer_is_read = plan.picture_target() == Target::Framebuffer;
    let mut read: Vec<Texture> = textures_of(plan.picture_target()).into_iter().take(1).collect();
    let mut dropped = Vec::new();
    for pass in plan.passes.iter_mut().rev() {
        let (name, drawn, is_partial) = (pass.name, textures_of(pass.target), pass.scissor.is_some());
        let mut kept = Vec::new();
        for step in std::mem::take(&mut pass.steps).into_iter().rev() {
            let is_read = match (&step, pass.target) {
                // After a partial copy the rest still holds the earlier copy.
                (Step::CopyFramebuffer, _) if is_partial => read.contains(&Texture::BorderMap),
                (Step::CopyDepth, _) if is_partial => read.contains(&Texture::DepthMap),
                (Step::CopyFramebuffer, _) => take(&mut read, &[Texture::BorderMap]),
                (Step::CopyDepth, _) => take(&mut read, &[Texture::DepthMap]),
                (_, Target::Framebuffer) => framebuffer_is_read,
                (_, Target::Textures(_)) => drawn.iter().any(|texture| read.contains(texture)),
            };
            if !is_read {
                dropped.push(format!("{name}: {}", step.name()));
                continue;
            }
            match &step {
                Step::CopyFramebuffer | Step::CopyDepth => framebuffer_is_read = true,
                // The clear erases the earlier contents.
                Step::Clear { color: Some(_), depth: true } | Step::ClearEach { .. } if !is_partial => {
                    match pass.target {
                        Target::Framebuffer => framebuffer_is_read = false,
                        Target::Textures(_) => drop(take(&mut read, &drawn)),
                    }
                }
                Step::Clear { .. } | Step::ClearEach { .. } => {}
                Step::Draw(Draw { textures, .. }) => read.extend(textures.iter().map(|(_, texture)| *texture)),
            }
            kept.push(step);
        }
        kept.reverse();
        pass.steps = kept;
    }
    if dropped.is_empty() {
        return Err("the result of every pass and every copy is read".to_owned());
    }
    drop_empty_passes(plan);
    dropped.reverse();
    Ok(Omission {
        rule: Rule::UnreadMap,
        what: format!("{}: {}", counted(dropped.len(), "step", "steps"), dropped.join(", ")),
        reason: "their drawing is cleared or never read before the picture is".to_owned(),
        facts: vec!["no later step reads their texture".to_owned()],
    })
}

/// Removes textures from those that are read; returns whether any was read.
fn take(read: &mut Vec<Texture>, textures: &[Texture]) -> bool {
    let count = read.len();
    read.retain(|other| !textures.contains(other));
    read.len() < count
}

/// Leaves out pictures and tables that no step reads.
pub(super) fn unread_textures(plan: &mut Plan) -> Result<Omission, String> {
    let read: Vec<Texture> = plan.draws().flat_map(|draw| draw.textures.iter().map(|(_, texture)| *texture)).collect();
    let tables = drop_unread(&mut plan.tables, |number| read.contains(&Texture::Table(number)));
    let pictures = drop_unread(&mut plan.pictures, |number| read.contains(&Texture::Picture(number)));
    let dropped: Vec<&str> = tables
        .dropped
        .iter()
        .map(|table| table.name)
        .chain(pictures.dropped.iter().map(|picture| picture.name))
        .collect();
    if dropped.is_empty() {
        return Err("every texture of this plan is read".to_owned());
    }
    for (_, texture) in plan.draws_mut().flat_map(|draw| &mut draw.textures) {
        match texture {
            Texture::Table(number) => *number = tables.number(*number),
            Texture::Picture(number) => *number = pictures.number(*number),
            Texture::BorderMap | Texture::DepthMap | Texture::Drawn(_) | Texture::Material { .. } => {}
        }
    }
    Ok(Omission {
        rule: Rule::UnreadTextures,
        what: format!("{}: {}", counted(dropped.len(), "texture", "textures"), dropped.join(", ")),
        reason: "no shader that is left samples them".to_owned(),
        facts: vec![format!("{} of the plan are read", counted(plan.pictures.len(), "picture", "pictures"))],
    })
}

/// The parts of a list that remain, and the others.
struct RemainingItems<T> {
    is_read: Vec<bool>,
    dropped: Vec<T>,
}

impl<T> RemainingItems<T> {
    /// Returns the new number of the item that had this number.
    fn number(&self, old: usize) -> usize {
        self.is_read[..old].iter().filter(|is_read| **is_read).count()
    }
}

/// Drops a list's unread items, by number.
fn drop_unread<T: Clone>(list: &mut Vec<T>, is_read: impl Fn(usize) -> bool) -> RemainingItems<T> {
    let is_read: Vec<bool> = (0..list.len()).map(is_read).collect();
    let of =
        |wanted: bool| list.iter().zip(&is_read).filter(move |(_, read)| **read == wanted).map(|(one, _)| one.clone());
    let (kept, dropped) = (of(true).collect(), of(false).collect());
    *list = kept;
    RemainingItems { is_read, dropped }
}
