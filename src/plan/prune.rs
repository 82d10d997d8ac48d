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
mod shaders;

use super::{Draw, Geometry, Plan, Step};
use crate::choice::Choice;
use crate::scene::{Rectangle, Scene, Size};
use serde::Serialize;
use std::cell::OnceCell;

tinta_geometry::choices! {
    /// A kind of thing that can be left out, in the order in which the rules are applied.
    #[non_exhaustive]
    pub enum Rule {
        /// Draws that add nothing: the border's square where its filter is multiplied by 0.
        Border = "border",
        /// Objects outside the picture.
        OutsideObjects = "outside-objects",
        /// Faces that the driver would cull anyway.
        CulledFaces = "culled-faces",
        /// Light that no tone depends on: highlights below three tones, all of it with one.
        UnusedLight = "unused-light",
        /// The background square where clearing does the same.
        BackgroundSquare = "background-square",
        /// Pixels of full-screen squares that no object reaches.
        EmptyPixels = "empty-pixels",
        /// Drawing and copying that nothing reads: the map of a picture without borders.
        UnreadMap = "unread-map",
        /// Clearing colours that the next step draws over.
        OverwrittenClear = "overwritten-clear",
        /// Pictures and tables of tones that no step reads.
        UnreadTextures = "unread-textures",
    }
}

impl Rule {
    /// As the user writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.choice_name()
    }

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

/// How to prune; [`crate::Renderer::pruning`] has what holds of a renderer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pruning {
    /// Rules that are not to be applied. Default none.
    pub keep: Vec<Rule>,
    /// Whether GL draws on the processor, where faces left out here are worth the search for them. Default yes.
    pub is_software: bool,
    /// Bits to which GL places a vertex within a pixel. Default 4, as many as every driver has.
    pub subpixel_bits: u32,
    /// Shaders, by their paths, whose texts are no longer those that the styles know: what a plan states of draws by them
    /// does not count. Default none.
    pub replaced_shaders: Vec<String>,
}

impl Default for Pruning {
    fn default() -> Self {
        Self { keep: Vec::new(), is_software: true, subpixel_bits: 4, replaced_shaders: Vec::new() }
    }
}

/// Something left out that cannot change the picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Omission {
    /// Its name.
    #[serde(rename = "name")]
    pub rule: Rule,
    /// What is not done any more.
    pub what: String,
    /// Why the picture is the same without it.
    pub reason: String,
    /// What about this scene and plan that rests on.
    pub facts: Vec<String>,
}

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

/// What is known of the scene, found out when first asked for.
struct Situation<'a> {
    scene: &'a Scene,
    /// The size of what is drawn into.
    surface: Size,
    pruning: &'a Pruning,
    extent: OnceCell<Option<Rectangle>>,
}

impl Situation<'_> {
    /// The pixels that faces of objects can touch.
    fn extent(&self) -> Option<Rectangle> {
        *self.extent.get_or_init(|| {
            let inside = self.scene.objects.iter().filter(|object| !self.scene.is_outside(object, 0.0));
            self.scene.extent_px(inside, self.surface)
        })
    }
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

/// Leaves out passes without steps; the last one stays where the picture would be another target's without it.
fn drop_empty_passes(plan: &mut Plan) {
    let (target, last) = (plan.picture_target(), plan.passes.last().cloned());
    plan.passes.retain(|pass| !pass.steps.is_empty());
    if plan.picture_target().picture() != target.picture() {
        plan.passes.extend(last);
    }
}

/// `1 pass`, `2 passes`.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
