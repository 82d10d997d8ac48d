//! Light that no tone depends on.

use super::{Omission, Rule};
use crate::plan::{Draw, Plan, Program, Value};
use crate::tolerances::UNREACHED_LIGHT;

/// The part that compares both kinds of light, and the parts that look at less.
const BY_BOTH: &str = "evangelista/tone-steps.frag";
const BY_DIFFUSE: &str = "improved/tone-diffuse.frag";
const BY_NONE: &str = "improved/tone-one.frag";

/// Exchanges the comparison of light with its thresholds for one that asks less, where a threshold is out of reach: the
/// driver then leaves the light itself out of both shaders.
pub(super) fn unused_light(plan: &mut Plan) -> Result<Omission, String> {
    let (mut facts, mut without) = (Vec::new(), "");
    for draw in plan.draws_mut() {
        let Some([diffuse, specular]) = thresholds(draw) else { continue };
        if specular < UNREACHED_LIGHT {
            continue;
        }
        let (part, what) = match diffuse < UNREACHED_LIGHT {
            true => (BY_DIFFUSE, "highlights"),
            false => (BY_NONE, "diffuse light and highlights"),
        };
        let Some(Program { fragments, .. }) = &mut draw.program else { continue };
        fragments.iter_mut().filter(|fragment| **fragment == BY_BOTH).for_each(|fragment| *fragment = part);
        let fact = format!("light ends at 1, and the thresholds are {diffuse} and {specular}");
        if !facts.contains(&fact) {
            facts.push(fact);
        }
        without = what;
    }
    if facts.is_empty() {
        return Err("every kind of light that is computed reaches a tone, or the published listing runs".to_owned());
    }
    Ok(Omission {
        rule: Rule::UnusedLight,
        what: format!("{without}, with what they interpolate"),
        reason: "no light reaches the threshold, so the comparison always comes out the same".to_owned(),
        facts,
    })
}

/// The thresholds of diffuse and specular light of a draw that compares with both.
fn thresholds(draw: &Draw) -> Option<[f32; 2]> {
    let uniform = draw.uniforms.iter().find(|uniform| uniform.name == "toneThresholds")?;
    match uniform.value {
        Value::Vec2(thresholds) if draw.has_shader(BY_BOTH) => Some(thresholds),
        _ => None,
    }
}
