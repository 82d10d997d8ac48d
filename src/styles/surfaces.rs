//! What a model's surfaces are like where that changes a style's picture: faces written twice, normals that blur edges.

use super::Style;
use crate::mesh::{Defects, Mesh};
use crate::scene::Scene;

/// Whether a model of the scene has faces that lie on each other, one each way.
pub(super) fn has_doubled_faces(scene: &Scene) -> bool {
    scene.objects.iter().any(|object| object.mesh.defects.doubled_triangles > 0)
}

/// Returns a remark for each model with faces written for both sides, if chance decides which of them the style draws, and a remedy.
pub(super) fn of_doubled_faces(style: &Style, scene: &Scene) -> Vec<String> {
    let chooses = match style {
        Style::Phong(phong) => phong.cull_back_faces,
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => cartoon.cull_back_faces,
        Style::Mrt(mrt) => mrt.cull_back_faces,
        Style::Inking(inking) => inking.cull_back_faces,
        // The others draw both sides alike or the one that faces the eye, or find such faces by their own rule.
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
