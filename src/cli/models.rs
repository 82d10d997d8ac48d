//! Reading the models a command is given.

use std::sync::Arc;
use tinta::mesh::load;
use tinta::{LoadOptions, Mesh, Result};

/// Reads the models and says what is to be said of them.
pub fn load_meshes(paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    let read = |path: &String| {
        let loaded = load(path, options)?;
        loaded.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        Ok(Arc::new(loaded.mesh))
    };
    paths.iter().map(read).collect()
}
