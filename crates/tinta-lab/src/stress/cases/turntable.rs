//! A turntable, by small steps: ink and tones may move, but not come and go.

use super::case::{Case, Drawing, Group, Study};
use crate::stress::Shape;

pub(super) fn cases() -> Vec<Case> {
    let turned = |name: &str, shape| {
        Case::rendered(Group::Turns, name, Drawing { shape, study: Study::Turn, ..Drawing::default() })
    };
    vec![
        turned("the gear turns", Shape::Builtin("builtin:gear")),
        turned("the bust turns", Shape::Builtin("builtin:bust")),
        turned("cubes that share part of a face turn", Shape::Contact),
        turned("cubes that pass through one another turn", Shape::Piercing),
    ]
}
