//! Multiplies the model's own textures and vertex colours into the finished picture. No style's shaders need to handle them.

use crate::plan::{Blend, Depth, Draw, Facts, Geometry, Paint, Step, Texture};
use crate::scene::Scene;
use std::sync::Arc;

/// Returns a step that redraws the objects of `shaded`, unlit in their textures and colours, multiplied with the visible pixels.
/// `None` if no object has any, or if the scene turns them off.
pub(super) fn textured(scene: &Scene, shaded: &Draw) -> Option<Step> {
    scene.has_textured_surfaces().then(|| {
        let paint = match scene.vertex_colors() {
            Some(lists) => Paint::Colors(Arc::new(lists)),
            None => Paint::Uniform([1.0; 4]),
        };
        let Draw { cull_back_faces, culls_doubled_faces, polygon_offset, .. } = *shaded;
        Step::Draw(Draw {
            textures: vec![("own", Texture::Material { is_averaged: true })],
            depth: Depth::Equal,
            blend: Blend::Multiply,
            cull_back_faces,
            culls_doubled_faces,
            polygon_offset,
            faces: shaded.faces.clone(),
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(paint), None)
        })
    })
}
