//! Reading the models a command is given: from files, built-in, or from standard input.

use super::standard_input;
use std::path::Path;
use std::sync::Arc;
use tinta::mesh::{LoadedModel, load, read_as, refuse_address};
use tinta::request::{ModelCache, Session};
use tinta::{Backend, Error, LoadOptions, Mesh, Renderer, Result};

/// Reads a model: a file, a built-in one, or standard input.
pub(super) fn read(model: &str, options: &LoadOptions) -> Result<LoadedModel> {
    match model {
        standard_input::DASH => read_as(&standard_input::model()?, standard_input::NAME, options),
        path => load(path, options),
    }
}

/// Refuses a model whose file is missing; a broken one is for its reader.
pub(super) fn refuse_missing(model: &str) -> Result<()> {
    if model.starts_with("builtin:") || Path::new(model).exists() {
        return Ok(());
    }
    refuse_address(model)?;
    Err(Error::model(model, "there is no such file; check the name"))
}

fn say(remark: &str) {
    super::say(&format!("tinta: {remark}"));
}

/// A session for one job, which reads models so.
pub(super) fn session() -> Session {
    Session::for_one().reading(read, say)
}

/// A session for many jobs, with this way to open a context.
pub(super) fn session_for_many(open: fn(Backend) -> Result<Renderer>) -> Session {
    Session::for_many(open).reading(read, say)
}

/// Reads models and prints their remarks.
pub fn load_meshes(paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    let cache = ModelCache::for_one().reading(read, say);
    paths.iter().map(|path| Ok(cache.read(path, options)?.mesh.clone())).collect()
}
