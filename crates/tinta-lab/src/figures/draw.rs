//! A figure's panels as pictures.

use super::figure::{Drawing, Model, Panel, SceneDrawing};
use std::collections::HashMap;
use std::sync::Arc;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, Mesh, Normals, load};
use tinta::picture::Picture;
use tinta::renderer::Renderer;
use tinta::scene::{Scene, SceneSettings, Size};
use tinta::styles::Ramp;

/// Draws panels; reads each built-in model once, and again where its normals are made by another rule.
#[derive(Debug, Default)]
pub struct Artist {
    builtin: HashMap<(&'static str, Normals), Arc<Mesh>>,
    textured: Option<Arc<Mesh>>,
}

impl Artist {
    /// An artist who has this model for the panels that need a texture.
    pub fn new(textured: Option<Arc<Mesh>>) -> Self {
        Self { textured, ..Self::default() }
    }

    /// Draws a panel; `None` for one that needs a texture where there is no textured model.
    ///
    /// # Errors
    ///
    /// Those of [`Renderer::draw`]; [`tinta::Error::Setting`] for a model without a texture.
    pub fn draw(&mut self, renderer: &mut Renderer, panel: &Panel, size: Size) -> Result<Option<Picture>> {
        match &panel.drawing {
            Drawing::Grains(texture) => texture.picture().map(Some),
            Drawing::Ramp => Ok(Some(Picture::clone(&Ramp::default().picture))),
            Drawing::Scene(drawing) => {
                let Some(mesh) = self.mesh(drawing.model, drawing.normals)? else { return Ok(None) };
                let scene = Scene::new(vec![mesh], &settings(drawing, size))?;
                renderer.draw(&scene, &drawing.style.plan(&scene, drawing.show)?).map(Some)
            }
        }
    }

    fn mesh(&mut self, model: Model, normals: Normals) -> Result<Option<Arc<Mesh>>> {
        let Model::Builtin(name) = model else { return Ok(self.textured.clone()) };
        if let Some(known) = self.builtin.get(&(name, normals)) {
            return Ok(Some(known.clone()));
        }
        let mesh = Arc::new(load(name, &LoadOptions { normals, ..LoadOptions::default() })?.mesh);
        self.builtin.insert((name, normals), mesh.clone());
        Ok(Some(mesh))
    }
}

fn settings(drawing: &SceneDrawing, size: Size) -> SceneSettings {
    SceneSettings { copies: drawing.copies, camera: drawing.camera.clone(), size, ..SceneSettings::default() }
}
