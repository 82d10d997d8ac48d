//! What a model's surfaces are like where that changes a style's picture: faces written twice, normals that blur edges.

use super::Style;
use crate::lines::stacked_faces;
use crate::mesh::{Defects, Mesh};
use crate::plan::{Draw, Faces, Geometry, Plan, Step};
use crate::scene::Scene;
use std::sync::Arc;

/// How far faces below others in their plane are pushed back: shares of their slope, and steps of depth. Touching faces are up to a
/// hundred-thousandth of a side apart, and GL moves corners by a 256th of a pixel.
const BELOW: [f32; 2] = [0.125, 64.0];

/// Whether a model of the scene has faces that lie on each other, one each way.
pub(super) fn has_doubled_faces(scene: &Scene) -> bool {
    scene.objects.iter().any(|object| object.mesh.defects.doubled_triangles > 0)
}

/// Draws faces below others of their plane behind them, as areas show them.
pub(super) fn stacked(mut plan: Plan, scene: &Scene) -> Plan {
    let Some(lists) = stacked_faces(scene) else { return plan };
    let of = |layer: usize, whole: Faces| {
        let listed = |lists: &[_; 2]| Faces::Listed(Arc::clone(&lists[layer]));
        Some(Arc::new(lists.iter().map(|lists| lists.as_ref().map_or(whole.clone(), listed)).collect::<Vec<_>>()))
    };
    let (first, below) = (of(0, Faces::All), of(1, Faces::None));
    let both = |step: Step| match step {
        Step::Draw(draw) if matches!(draw.geometry, Geometry::Objects(_)) => vec![
            Step::Draw(Draw { faces: first.clone(), ..draw.clone() }),
            Step::Draw(Draw { faces: below.clone(), polygon_offset: Some(BELOW), ..draw }),
        ],
        step => vec![step],
    };
    for pass in &mut plan.passes {
        pass.steps = std::mem::take(&mut pass.steps).into_iter().flat_map(both).collect();
    }
    plan
}

/// Returns a remark for each model with faces written for both sides, if chance decides which of them the style draws, and a remedy.
pub(super) fn of_doubled_faces(style: &Style, scene: &Scene) -> Vec<String> {
    let chooses = match style {
        Style::Phong(phong) => phong.cull_back_faces,
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => cartoon.cull_back_faces,
        Style::Mrt(mrt) => mrt.0.cull_back_faces,
        Style::Inking(inking) => inking.cull_back_faces,
        Style::Charcoal(charcoal) | Style::Sand(charcoal) => charcoal.cull_back_faces || charcoal.improve.two_sided,
        // The others draw both sides alike or the one that faces the eye.
        _ => true,
    };
    if chooses {
        return Vec::new();
    }
    of_models(scene, |mesh, Defects { doubled_triangles: count, .. }| {
        let triangles = if *count == 1 { "triangle is" } else { "triangles are" };
        (*count > 0).then(|| {
            format!(
                "{}: {count} {triangles} written twice, once for each side, and chance decides which side is drawn; --cull back \
                 draws the one that faces the eye",
                mesh.name
            )
        })
    })
}

/// Returns a remark for each model that takes normals from its file which are averaged over sharp edges, and a remedy.
pub(super) fn of_averaged_normals(scene: &Scene) -> Vec<String> {
    of_models(scene, |mesh, Defects { averaged_normals: count, .. }| {
        (*count > 0).then(|| {
            format!(
                "{}: {count} of its normals stand more than 45 degrees off their faces, which blurs tones at sharp edges; \
                 --normals smooth computes others",
                mesh.name
            )
        })
    })
}

/// The remarks on the scene's meshes, each once.
fn of_models(scene: &Scene, remark: impl Fn(&Mesh, &Defects) -> Option<String>) -> Vec<String> {
    scene.originals().filter_map(|object| remark(&object.mesh, &object.mesh.defects)).collect()
}
