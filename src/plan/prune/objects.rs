//! Objects outside the picture, and faces that a view cannot show.

use super::{Facts, Omission, Rule, counted};
use crate::plan::{Draw, EdgeRun, Faces, Geometry, Plan, Step};
use std::sync::Arc;

/// Leaves out objects outside the picture, with their edges.
pub(super) fn outside(plan: &mut Plan, facts: &Facts<'_>) -> Result<Omission, String> {
    let scene = facts.scene;
    let all_outside = |width_px: f32| -> Vec<bool> {
        scene.objects.iter().map(|object| scene.is_outside(object, width_px)).collect()
    };
    let outside = all_outside(0.0);
    let count = outside.iter().filter(|is_outside| **is_outside).count();
    if count == 0 {
        return Err("no object is outside the picture".to_owned());
    }
    let selection = Arc::new(
        outside.iter().map(|is_outside| if *is_outside { Faces::None } else { Faces::All }).collect::<Vec<_>>(),
    );
    let (mut is_changed, mut edges) = (false, 0);
    for draw in plan.draws_mut() {
        match &mut draw.geometry {
            Geometry::Objects(_) if draw.faces.is_none() => {
                draw.faces = Some(selection.clone());
                is_changed = true;
            }
            Geometry::Edges { runs, width_px, .. } => {
                let beyond = all_outside(*width_px);
                let is_left_out = |run: &EdgeRun| beyond.get(run.object).is_some_and(|is_outside| *is_outside);
                let left_out: usize = runs.iter().filter(|run| is_left_out(run)).map(|run| run.ends.len()).sum();
                if left_out > 0 {
                    *runs = Arc::new(runs.iter().filter(|run| !is_left_out(run)).cloned().collect());
                    edges += left_out;
                    is_changed = true;
                }
            }
            _ => {}
        }
    }
    if !is_changed {
        return Err("objects outside the picture are left out already".to_owned());
    }
    if count == outside.len() {
        let draws_nothing = |step: &Step| matches!(step, Step::Draw(draw) if draw.is_of_objects());
        plan.passes.iter_mut().for_each(|pass| pass.steps.retain(|step| !draws_nothing(step)));
    }
    let lines = if edges > 0 { format!(" and {}", counted(edges, "of their edges", "of their edges")) } else { String::new() };
    Ok(Omission {
        rule: Rule::OutsideObjects,
        what: format!("{} of {}{lines}", count, counted(outside.len(), "object", "objects")),
        reason: "none of their pixels would lie in the picture".to_owned(),
        facts: vec!["the boxes around them lie beyond one side of what the camera sees".to_owned()],
    })
}

/// Leaves out faces that are turned away and behind others of their own closed surface.
pub(super) fn hidden_faces(_plan: &mut Plan, _facts: &Facts<'_>) -> Result<Omission, String> {
    Err("not yet".to_owned())
}

#[expect(dead_code, reason = "used by hidden faces")]
fn is_candidate(draw: &Draw) -> bool {
    draw.is_of_objects()
}
