//! Light that no tone depends on.

use super::rule::{Omission, Rule};
use crate::plan::{Plan, Shorter};

/// Replaces programs by versions without the light that reaches no threshold.
pub(super) fn unused_light(plan: &mut Plan) -> Result<Omission, String> {
    let (mut facts, mut left_out) = (Vec::new(), "");
    for draw in plan.draws_mut() {
        let Some(Shorter { program, without, because }) = draw.facts.shorter.take() else { continue };
        draw.program = Some(program);
        if !facts.contains(&because) {
            facts.push(because);
        }
        left_out = without;
    }
    if facts.is_empty() {
        return Err("every kind of light that is computed reaches a tone, or the published listing runs".to_owned());
    }
    Ok(Omission {
        rule: Rule::UnusedLight,
        what: format!("{left_out}, with their interpolated variables"),
        reason: "no light reaches the threshold, so the comparison always comes out the same".to_owned(),
        facts,
    })
}
