//! The model's own textures and colours at vertices under a style's shading: multiplied with what has been drawn, so that no style's
//! shaders know of them.

use crate::plan::{Blend, Depth, Draw, Facts, Geometry, Paint, Step, Texture};
use crate::scene::Scene;
use std::sync::Arc;

/// The objects that `shaded` drew once more, unlit in these, multiplied with what of them is seen; `None` where nothing
/// has any, or the scene is to be without.
pub(super) fn textured(scene: &Scene, shaded: &Draw) -> Option<Step> {
    scene.has_textured_surfaces().then(|| {
        let paint = match scene.vertex_colors() {
            Some(lists) => Paint::Colors(Arc::new(lists)),
            None => Paint::Uniform([1.0; 4]),
        };
        let Draw { cull_back_faces, polygon_offset, .. } = *shaded;
        Step::Draw(Draw {
            textures: vec![("own", Texture::Material)],
            depth: Depth::Equal,
            blend: Blend::Multiply,
            cull_back_faces,
            polygon_offset,
            faces: shaded.faces.clone(),
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(paint), None)
        })
    })
}
