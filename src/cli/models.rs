//! Reading the models a command is given.

use super::library::Library;
use std::path::PathBuf;
use std::sync::Arc;
use tinta::{LoadOptions, Mesh, Result};

/// Reads the models and says what is to be said of them.
pub fn load_meshes(library: &Library, paths: &[String], options: &LoadOptions) -> Result<Vec<Arc<Mesh>>> {
    load_with_files(library, paths, options).map(|(meshes, _)| meshes)
}

/// As [`load_meshes`], with the files that were read besides the models' own.
pub fn load_with_files(
    library: &Library,
    paths: &[String],
    options: &LoadOptions,
) -> Result<(Vec<Arc<Mesh>>, Vec<PathBuf>)> {
    let (mut meshes, mut files) = (Vec::new(), Vec::new());
    for path in paths {
        let model = library.read(path, options)?;
        model.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        meshes.push(model.mesh.clone());
        files.extend(model.files.iter().cloned());
    }
    Ok((meshes, files))
}
