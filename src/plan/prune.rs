//! Pruning: shortens a plan by facts about the scene without changing the picture.
//!
//! In: a published [`Plan`] and the [`Scene`] it was made for. Out: [`PrunedPlan`], the plan without steps that cannot change a byte
//! of the picture. For each [`Rule`] it holds either the [`Omission`], with its reason and the facts it rests on, or why the rule
//! left everything in. Shaders' effects come only from the facts that the plan states of its draws ([`super::Facts`]). So
//! anyone's plans can be shortened, and replaced shaders are never misjudged. Every rule must be exact on every driver; nearly
//! exact shortcuts are options of a style.

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
pub struct IdleRule {
    /// Its name.
    #[serde(rename = "name")]
    pub rule: Rule,
    /// Why.
    pub reason: String,
}

/// A plan without parts that its scene does not need.
#[derive(Debug, Clone, PartialEq)]
pub struct PrunedPlan {
    /// The shortened plan.
    pub plan: Plan,
    /// The parts left out, in order of removal.
    pub omissions: Vec<Omission>,
    /// The other rules.
    pub kept: Vec<IdleRule>,
}

/// Removes all parts of a plan, made for this scene, that cannot change its picture.
pub fn prune(plan: &Plan, scene: &Scene, pruning: &Pruning) -> PrunedPlan {
    let mut pruned = PrunedPlan { plan: plan.clone(), omissions: Vec::new(), kept: Vec::new() };
    pruned.plan.forget_facts_of(&pruning.replaced_shaders);
    let situation = Situation { scene, surface: scene.size.times(plan.supersample), pruning, extent: OnceCell::new() };
    for (_, rule) in Rule::ALL {
        let result = match pruning.keep.contains(&rule) {
            true => Err("--keep asks for it".to_owned()),
            false => rule.apply(&mut pruned.plan, &situation),
        };
        match result {
            Ok(omission) => pruned.omissions.push(omission),
            Err(reason) => pruned.kept.push(IdleRule { rule, reason }),
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
    /// Shortens the plan; the error says why it could not.
    fn apply(self, plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
        match self {
            Self::Border => dead::border(plan),
            Self::OutsideObjects => objects::outside(plan, situation),
            Self::CulledFaces => objects::culled_faces(plan, situation),
            Self::HiddenFaces => objects::hidden_faces(plan, situation),
            Self::UnusedLight => shaders::unused_light(plan),
            Self::BackgroundSquare => background::square(plan),
            Self::EmptyPixels => background::empty_pixels(plan, situation),
            Self::UnreadMap => dead::unread_map(plan),
            Self::OverwrittenClear => background::overwritten_clear(plan, situation),
            Self::UnreadTextures => dead::unread_textures(plan),
        }
    }
}
