//! A model, its scene, and its exact lines: the parts without a canvas, which a worker can use too.

use crate::errors::{said, unreadable};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::lines::{DrawingFormat, Progress};
use tinta::mesh::{LoadedModel, load, read_bytes};
use tinta::recipe::{Driver, FileRecord};
use tinta::request::{DrawingFile, OptionLayer, Request, Resolved, WantedLines};
use tinta::settings::Options;
use tinta::{LineSettings, Mesh, Recipe, Scene, StyleName};
use tinta_lab::measure::{Ink, Reference};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Distance within which ink lies on a line, pixels: the default of `tinta measure`.
const TOLERANCE_PX: f64 = 2.0;

/// A model, with its remarks from reading.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Model {
    name: String,
    mesh: Arc<Mesh>,
    remarks: Vec<String>,
    files: Vec<FileRecord>,
}

/// Files beside a model, by their names.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Files(Vec<(String, Vec<u8>)>);

#[wasm_bindgen]
impl Files {
    /// Without files.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Files {
        Self::default()
    }

    /// One more.
    pub fn add(&mut self, name: String, bytes: Vec<u8>) {
        self.0.push((name, bytes));
    }
}

#[wasm_bindgen]
impl Model {
    /// A built-in one, by its name, read with these options.
    ///
    /// # Errors
    ///
    /// If the name is unknown, or an option.
    pub fn builtin(name: &str, options: &str) -> Result<Model, JsError> {
        let path = format!("builtin:{name}");
        let loaded = load(&path, &asked(StyleName::ThreePass, options)?.read).map_err(said)?;
        Ok(Self::of(path, loaded, Vec::new()))
    }

    /// One from a file's bytes, read with these options, and the files that it may name: materials, data, pictures.
    ///
    /// # Errors
    ///
    /// Those of the library's readers, a sentence each.
    pub fn read(name: &str, bytes: &[u8], files: &Files, options: &str) -> Result<Model, JsError> {
        let how = asked(StyleName::ThreePass, options)?.read;
        let beside: Vec<(&str, &[u8])> = files.0.iter().map(|(name, bytes)| (name.as_str(), &bytes[..])).collect();
        let loaded = read_bytes(bytes, name, &beside, &how).map_err(said)?;
        let all = std::iter::once((name, bytes)).chain(beside.iter().copied());
        let records = all.map(|(name, bytes)| FileRecord::of_bytes(name, bytes)).collect();
        Ok(Self::of(name.to_owned(), loaded, records))
    }

    fn of(name: String, loaded: LoadedModel, files: Vec<FileRecord>) -> Self {
        Self { name, mesh: Arc::new(loaded.mesh), remarks: loaded.remarks, files }
    }

    /// Its name, size and remarks, as JSON.
    pub fn about(&self) -> String {
        let Mesh { triangles, .. } = &*self.mesh;
        json!({ "name": self.name, "triangles": triangles.len(), "remarks": self.remarks }).to_string()
    }

    /// The exact lines of a view as the SVG that the command line writes with these options, with its recipe if requested.
    ///
    /// # Errors
    ///
    /// Those of the options and of the lines.
    pub fn svg(&self, options: &str, has_recipe: bool) -> Result<String, JsError> {
        let request = self.request(StyleName::Lines, options)?;
        let resolved = request.resolve(vec![self.mesh.clone()], true).map_err(said)?;
        let recipe = has_recipe.then(|| self.recipe(&resolved, None));
        let drawn = resolved.drawn_lines(WantedLines::default(), &Progress::default()).map_err(said)?;
        let bytes =
            drawn.written(DrawingFormat::SVG, None, recipe.as_ref()).and_then(DrawingFile::bytes).map_err(said)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// How well ink agrees with the exact lines of a view, F1 from 0 to 1, as the command line measures it; `ink` is how dark each
    /// pixel is.
    ///
    /// # Errors
    ///
    /// Those of the options and of the lines.
    pub fn error(&self, options: &str, ink: &[u8]) -> Result<f64, JsError> {
        let scene = self.placed(&self.request(StyleName::Lines, options)?)?;
        let reference = Reference::of(&scene, &LineSettings::as_published()).map_err(said)?;
        let ink = Ink { size: scene.size, darkness: ink.to_vec() };
        Ok(ink.error(&reference, TOLERANCE_PX).f1)
    }
}

impl Model {
    /// The request of the page's options, which are the command line's; in this style if they name none.
    pub(crate) fn request(&self, style: StyleName, options: &str) -> Result<Request, JsError> {
        Ok(asked(style, options)?.with_models(vec![self.name.clone()]))
    }

    /// The recipe of a drawing of it.
    pub(crate) fn recipe(&self, drawn: &Resolved, gl: Option<Driver>) -> Recipe {
        let beside: Vec<PathBuf> = self.files.iter().map(|file| PathBuf::from(&file.path)).collect();
        let record = |path: &Path| self.files.iter().find(|file| Path::new(&file.path) == path).cloned();
        drawn.request.recipe(&drawn.scene, &beside, gl, record)
    }

    /// It under a request's settings.
    pub(crate) fn placed(&self, request: &Request) -> Result<Scene, JsError> {
        request.placed(vec![self.mesh.clone()]).map_err(said)
    }
}

/// The request of the page's options, in this style if they name none.
pub(crate) fn asked(style: StyleName, options: &str) -> Result<Request, JsError> {
    let options: Options = serde_json::from_str(options).map_err(unreadable)?;
    Ok(Request::from_layers(&[OptionLayer::Style(style), OptionLayer::Given(options)]).map_err(said)?.0)
}
