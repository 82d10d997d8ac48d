//! A rendering in progress: the request and its output.

use super::super::inputs::Inputs;
use super::super::run_settings::RunSettings;
use tinta::Scene;
use tinta::record::{CameraRecord, DrawingFacts, ModelRecord, Record};
use tinta::request::{Request, Resolved};
use tinta::styles::{Contents, LineStyle, Style};

/// A rendering on its way.
pub(super) struct Rendering<'a> {
    pub(super) request: &'a Request,
    pub(super) run: &'a RunSettings,
    pub(super) output: &'a str,
}

impl Rendering<'_> {
    /// Records of the models that a section leaves.
    pub(super) fn model_records(&self, scene: &Scene) -> Vec<ModelRecord> {
        let count = scene.objects.len() / self.request.scene.copies as usize;
        scene.objects[..count].iter().map(|object| ModelRecord::new(&object.mesh)).collect()
    }

    /// The record of this drawing.
    pub(super) fn record(&self, resolved: &Resolved, load_ms: f64, remarks: Vec<String>, made: DrawingFacts) -> Record {
        let Resolved { scene, contents: Contents { lines, drawing, .. }, .. } = resolved;
        let models = self.model_records(scene);
        let is_over = self.request.exact_lines && !self.request.style.style_name().draws_lines();
        let over = lines.as_ref().filter(|_| is_over);
        Record {
            version: env!("CARGO_PKG_VERSION"),
            model: ModelRecord::together(&models),
            models,
            load: self.request.read.clone(),
            copies: self.request.scene.copies,
            triangles: scene.triangle_count(),
            style: self.request.style.clone(),
            exact_lines: over.map(|lines| {
                Style::Lines(LineStyle { lines: lines.clone(), drawing: drawing.clone(), ..LineStyle::default() })
            }),
            size: scene.size,
            background: scene.background,
            camera: CameraRecord::new(scene),
            remarks,
            load_ms,
            made,
        }
    }
}

/// The pictures on the models of a scene.
pub(super) fn pictures_of(scene: &Scene) -> Inputs {
    let materials = scene.objects.iter().flat_map(|object| &object.mesh.materials);
    Inputs::of_pictures(materials.filter_map(|material| material.texture.clone()))
}
