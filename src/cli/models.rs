//! Reading the models a command is given.

use super::model_cache::ModelCache;
use super::standard_input;
use std::path::PathBuf;
use std::sync::Arc;
use tinta::mesh::{Loaded, load, read_as};
use tinta::{LoadOptions, Mesh, Result};

/// Reads a model: a file, a built-in one, or what comes from standard input.
pub(super) fn read(model: &str, options: &LoadOptions) -> Result<Loaded> {
    match model {
        standard_input::DASH => read_as(&standard_input::model()?, standard_input::NAME, options),
        path => load(path, options),
    }
}

/// Reads the models and says what is to be said of them.
pub(super) fn load_meshes(model_cache: &ModelCache, paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    load_with_files(model_cache, paths, options).map(|(meshes, _)| meshes)
}

/// As [`load_meshes`], with the files that were read besides the models' own.
pub(super) fn load_with_files(
    model_cache: &ModelCache,
    paths: &[String],
    options: &LoadOptions,
) -> Result<(Vec<Arc<Mesh>>, Vec<PathBuf>)> {
    let (mut meshes, mut files) = (Vec::new(), Vec::new());
    for path in paths {
        let model = model_cache.read(path, options)?;
        model.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        meshes.push(model.mesh.clone());
        files.extend(model.files.iter().cloned());
    }
    Ok((meshes, files))
}
