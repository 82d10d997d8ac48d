//! Reading the models a command is given: from files, built-in, or from standard input.

use super::standard_input;
use std::sync::Arc;
use tinta::mesh::{Loaded, load, read_as};
use tinta::request::{ModelCache, Session};
use tinta::{Backend, LoadOptions, Mesh, Renderer, Result};

/// Reads a model: a file, a built-in one, or standard input.
pub(super) fn read(model: &str, options: &LoadOptions) -> Result<Loaded> {
    match model {
        standard_input::DASH => read_as(&standard_input::model()?, standard_input::NAME, options),
        path => load(path, options),
    }
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
