//! Reading the models a command is given.

use super::model_cache::ModelCache;
use super::standard_input;
use std::path::PathBuf;
use std::sync::Arc;
use tinta::mesh::{LoadStage, Loaded, load, read_as};
use tinta::{LoadOptions, Mesh, Result};

/// Reads a model: a file, a built-in one, or what comes from standard input.
pub(super) fn read(model: &str, options: &LoadOptions) -> Result<Loaded> {
    match model {
        standard_input::DASH => read_as(&standard_input::model()?, standard_input::NAME, options),
        path => load(path, options),
    }
}

/// The models a command is given.
pub(super) struct ReadModels {
    pub meshes: Vec<Arc<Mesh>>,
    /// The files that were read besides the models' own.
    pub files: Vec<PathBuf>,
    /// How long each stage of reading took for all of them together, milliseconds.
    pub stages: Vec<(LoadStage, f64)>,
}

/// Reads the models and says what is to be said of them.
pub(super) fn load_meshes(model_cache: &ModelCache, paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    load_models(model_cache, paths, options).map(|models| models.meshes)
}

/// As [`load_meshes`], with what else is known of them.
pub(super) fn load_models(model_cache: &ModelCache, paths: &[String], options: &LoadOptions) -> Result<ReadModels> {
    let mut models = ReadModels { meshes: Vec::new(), files: Vec::new(), stages: Vec::new() };
    for path in paths {
        let model = model_cache.read(path, options)?;
        model.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        models.meshes.push(model.mesh.clone());
        models.files.extend(model.files.iter().cloned());
        for (stage, ms) in &model.stages {
            match models.stages.iter_mut().find(|(other, _)| other == stage) {
                Some((_, sum)) => *sum += ms,
                None => models.stages.push((*stage, *ms)),
            }
        }
    }
    Ok(models)
}
