//! Style by part: rules that name parts of a scene by patterns, and the style that each part gets.
//!
//! Input: [`PartRules`](rules::PartRules), and the names of a scene's models, parts and materials. Output: the part that each line belongs to, its
//! role in hiding, its classes, and how it is drawn.

mod fills;
pub(super) mod rules;
pub(super) mod scene_parts;
pub(super) mod style;
