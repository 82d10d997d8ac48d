//! The rules of pruning, the facts they use of a scene, and the parts they leave out.

use crate::choice::Choice;
use crate::plan::Plan;
use crate::scene::{ObjectIdentity, Rectangle, Scene, Size};
use serde::Serialize;
use std::cell::OnceCell;
use std::sync::{Arc, Mutex};

tinta_geometry::choices! {
    /// A kind of part that can be left out. The rules apply in this order.
    #[non_exhaustive]
    pub enum Rule {
        /// Draws that add nothing: the border's square if its filter is multiplied by 0.
        Border = "border",
        /// Objects outside the picture.
        OutsideObjects = "outside-objects",
        /// Faces that the driver would cull anyway.
        CulledFaces = "culled-faces",
        /// Faces that cover no pixel's centre, and those behind others at every centre that they cover.
        HiddenFaces = "hidden-faces",
        /// Light that no tone depends on: highlights below three tones, all light with one.
        UnusedLight = "unused-light",
        /// The background square, if a clear does the same.
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
    /// Returns the name as the user writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.choice_name()
    }
}

/// Settings of pruning; [`crate::Renderer::pruning`] returns those for a renderer.
#[derive(Debug, Clone, Serialize)]
pub struct Pruning {
    /// Rules to skip. Default none.
    pub keep: Vec<Rule>,
    /// Whether GL draws on the processor, where leaving faces out here is worth the search. Default yes.
    pub is_software: bool,
    /// Bits of a vertex's position within a pixel. Default 4, the number that every driver has.
    pub subpixel_bits: u32,
    /// Shaders, by path, whose texts have been replaced: facts of draws that use them are ignored. Default none.
    pub replaced_shaders: Vec<String>,
    /// The models whose hidden faces are not searched, because a search cost more than it saved, and for how many more views. A
    /// renderer remembers them. Default none.
    #[serde(skip)]
    pub rest: Arc<Mutex<Option<(ObjectIdentity, u32)>>>,
}

impl Default for Pruning {
    fn default() -> Self {
        let rest = Arc::default();
        Self { keep: Vec::new(), is_software: true, subpixel_bits: 4, replaced_shaders: Vec::new(), rest }
    }
}

/// An omission that cannot change the picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Omission {
    /// Its name.
    #[serde(rename = "name")]
    pub rule: Rule,
    /// The work that is left out.
    pub what: String,
    /// Why the picture is the same without it.
    pub reason: String,
    /// The facts about this scene and plan behind that reason.
    pub facts: Vec<String>,
}

/// The facts about a scene, computed on first use.
pub(super) struct Situation<'a> {
    pub scene: &'a Scene,
    /// The size of the drawing surface.
    pub surface: Size,
    pub pruning: &'a Pruning,
    pub extent: OnceCell<Option<Rectangle>>,
}

impl Situation<'_> {
    /// Returns the pixels that faces of objects can touch.
    pub(super) fn extent(&self) -> Option<Rectangle> {
        *self.extent.get_or_init(|| {
            let inside = self.scene.objects.iter().filter(|object| !self.scene.is_outside(object, 0.0));
            self.scene.extent_px(inside, self.surface)
        })
    }
}

/// Drops passes without steps, except the last one if the picture would otherwise be another target's.
pub(super) fn drop_empty_passes(plan: &mut Plan) {
    let (target, last) = (plan.picture_target(), plan.passes.last().cloned());
    plan.passes.retain(|pass| !pass.steps.is_empty());
    if plan.picture_target().picture() != target.picture() {
        plan.passes.extend(last);
    }
}

/// `1 pass`, `2 passes`.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
