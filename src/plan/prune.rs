//! Pruning: shortens a plan by facts about the scene so that it draws the same picture.
//!
//! In: a [`Plan`] as published and the [`Scene`] it was made for. Out: [`Pruned`], the plan without what cannot change a
//! byte of the picture, and of each [`Rule`] either the [`Omission`] it led to, with its reason and the facts it rests on,
//! or why it left everything in. What shaders do is known from what the plan states of its draws ([`super::Facts`]), so that
//! plans of anybody's making are shortened, and none by a shader that was replaced meanwhile. Every rule has to be exact on every driver, not nearly so; what is only nearly exact is an
//! option of a style.

mod background;
mod dead;
mod ground;
mod objects;
mod rule;
mod shaders;

pub use rule::{Omission, Pruning, Rule};

use super::{Draw, Geometry, Plan, Step};
use crate::scene::Scene;
use rule::Situation;
use serde::Serialize;
use std::cell::OnceCell;

/// A rule that left everything in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Kept {
    /// Its name.
    #[serde(rename = "name")]
    pub rule: Rule,
    /// Why.
    pub reason: String,
}

/// A plan without what its scene does not need.
#[derive(Debug, Clone, PartialEq)]
pub struct Pruned {
    /// What is left.
    pub plan: Plan,
    /// What is not, in the order it was left out.
    pub omissions: Vec<Omission>,
    /// The other rules.
    pub kept: Vec<Kept>,
}

/// Leaves out of a plan made for this scene what cannot change its picture.
pub fn prune(plan: &Plan, scene: &Scene, pruning: &Pruning) -> Pruned {
    let mut pruned = Pruned { plan: plan.clone(), omissions: Vec::new(), kept: Vec::new() };
    pruned.plan.forget_facts_of(&pruning.replaced_shaders);
    let situation = Situation { scene, surface: scene.size.times(plan.supersample), pruning, extent: OnceCell::new() };
    for (_, rule) in Rule::ALL {
        let result = match pruning.keep.contains(&rule) {
            true => Err("--keep asks for it".to_owned()),
            false => rule.apply(&mut pruned.plan, &situation),
        };
        match result {
            Ok(omission) => pruned.omissions.push(omission),
            Err(reason) => pruned.kept.push(Kept { rule, reason }),
        }
    }
    pruned
}

impl Plan {
    fn draws(&self) -> impl Iterator<Item = &Draw> {
        self.steps().filter_map(|(_, step)| if let Step::Draw(draw) = step { Some(draw) } else { None })
    }

    fn draws_mut(&mut self) -> impl Iterator<Item = &mut Draw> {
        let steps = self.passes.iter_mut().flat_map(|pass| &mut pass.steps);
        steps.filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None })
    }
}

impl Draw {
    fn is_of_objects(&self) -> bool {
        matches!(self.geometry, Geometry::Objects(_))
    }
}

impl Rule {
    /// Shortens the plan, or says why not.
    fn apply(self, plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
        match self {
            Self::Border => dead::border(plan),
            Self::OutsideObjects => objects::outside(plan, situation),
            Self::CulledFaces => objects::culled_faces(plan, situation),
            Self::UnusedLight => shaders::unused_light(plan),
            Self::BackgroundSquare => background::square(plan),
            Self::EmptyPixels => background::empty_pixels(plan, situation),
            Self::UnreadMap => dead::unread_map(plan),
            Self::OverwrittenClear => background::overwritten_clear(plan, situation),
            Self::UnreadTextures => dead::unread_textures(plan),
        }
    }
}
