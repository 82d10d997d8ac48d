//! Reading the models a command is given.

use std::path::PathBuf;
use std::sync::Arc;
use tinta::mesh::load;
use tinta::{LoadOptions, Mesh, Result};

/// Reads the models and says what is to be said of them.
pub fn load_meshes(paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    load_with_files(paths, options).map(|(meshes, _)| meshes)
}

/// As [`load_meshes`], with the files that were read besides the models' own.
pub fn load_with_files(paths: &[String], options: &LoadOptions) -> Result<(Vec<Arc<Mesh>>, Vec<PathBuf>)> {
    let (mut meshes, mut files) = (Vec::new(), Vec::new());
    for path in paths {
        let loaded = load(path, options)?;
        loaded.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        meshes.push(Arc::new(loaded.mesh));
        files.extend(loaded.files);
    }
    Ok((meshes, files))
}
