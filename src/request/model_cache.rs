//! A cache of the models last read. Consecutive jobs with the same model read it once.

use crate::error::Result;
use crate::mesh::{LoadOptions, LoadStage, LoadedModel, Mesh, load};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Reads models, and caches them for many jobs.
#[derive(Debug)]
pub struct ModelCache {
    models: Mutex<Models>,
    read: fn(&str, &LoadOptions) -> Result<LoadedModel>,
    say: fn(&str),
}

impl ModelCache {
    /// For a single job: caches nothing.
    pub fn for_one() -> Self {
        Self::new(false)
    }

    /// For many jobs.
    pub(crate) fn for_many() -> Self {
        Self::new(true)
    }

    fn new(keeps: bool) -> Self {
        Self {
            models: Mutex::new(Models { keeps, kept: Vec::new() }),
            read: |path, options| load(path, options),
            say: |_| (),
        }
    }

    /// With another reader of models, and a function that receives remarks.
    #[must_use]
    pub fn reading(self, read: fn(&str, &LoadOptions) -> Result<LoadedModel>, say: fn(&str)) -> Self {
        Self { read, say, ..self }
    }

    /// Reads a model, or takes it from the cache; reports its remarks either way.
    ///
    /// # Errors
    ///
    /// Those of the readers.
    pub fn read(&self, path: &str, options: &LoadOptions) -> Result<Arc<Model>> {
        let model = self.models.lock().unwrap_or_else(PoisonError::into_inner).read(path, options, self.read)?;
        model.remarks.iter().for_each(|remark| (self.say)(remark));
        Ok(model)
    }
}

/// A model with the files read with it and its remarks.
#[derive(Debug)]
pub struct Model {
    /// Its mesh.
    pub mesh: Arc<Mesh>,
    /// The files read besides its own.
    pub files: Vec<PathBuf>,
    /// Remarks for the user.
    pub remarks: Vec<String>,
    /// How long each stage of reading took, milliseconds.
    pub stages: Vec<(LoadStage, f64)>,
    path: String,
    options: LoadOptions,
    stamps: Vec<Stamp>,
}

/// When a file was last written and its length; `None` for models without a file, such as built-in ones.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let metadata = path.metadata().ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// The models last read.
#[derive(Debug)]
struct Models {
    keeps: bool,
    /// The latest last.
    kept: Vec<Arc<Model>>,
}

impl Models {
    /// Most triangles of the models kept together, some 100 MB; a larger one is kept until another is read.
    const TRIANGLES: usize = 1_000_000;

    /// Most models kept.
    const COUNT: usize = 64;

    fn read(
        &mut self,
        path: &str,
        options: &LoadOptions,
        read: fn(&str, &LoadOptions) -> Result<LoadedModel>,
    ) -> Result<Arc<Model>> {
        let is_it = |model: &Arc<Model>| model.path == path && model.options == *options && model.is_as_it_was();
        if let Some(place) = self.kept.iter().position(is_it) {
            let model = self.kept.remove(place);
            self.kept.push(model.clone());
            return Ok(model);
        }
        self.make_room();
        let own = stamp(Path::new(path));
        let loaded = read(path, options)?;
        let stamps = std::iter::once(own).chain(loaded.files.iter().map(|file| stamp(file))).collect();
        let model = Arc::new(Model {
            mesh: Arc::new(loaded.mesh),
            files: loaded.files,
            remarks: loaded.remarks,
            stages: loaded.stages,
            path: path.to_owned(),
            options: options.clone(),
            stamps,
        });
        if self.keeps {
            self.kept.push(model.clone());
        }
        Ok(model)
    }

    /// Before another is read: lets the oldest go.
    fn make_room(&mut self) {
        self.kept.retain(|model| model.is_as_it_was());
        let is_too_much = |kept: &[Arc<Model>]| {
            kept.len() >= Self::COUNT
                || kept.iter().map(|model| model.mesh.triangles.len()).sum::<usize>() > Self::TRIANGLES
        };
        while is_too_much(&self.kept) {
            self.kept.remove(0);
        }
    }
}

impl Model {
    /// Whether no file of it has been written since.
    fn is_as_it_was(&self) -> bool {
        let paths = std::iter::once(Path::new(&self.path)).chain(self.files.iter().map(PathBuf::as_path));
        paths.zip(&self.stamps).all(|(path, then)| stamp(path) == *then)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    #[test]
    fn a_model_is_read_again_where_it_was_written_since_or_other_options_are_given() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj").to_str().unwrap().to_owned();
        std::fs::write(&path, TRIANGLE).unwrap();
        let model_cache = ModelCache::for_many();
        let options = LoadOptions::default();
        let read = || model_cache.read(&path, &options).unwrap();
        let first = read();
        assert!(Arc::ptr_eq(&first.mesh, &read().mesh));
        let flat = LoadOptions { normals: crate::mesh::Normals::Flat, ..options.clone() };
        assert!(!Arc::ptr_eq(&first.mesh, &model_cache.read(&path, &flat).unwrap().mesh));
        assert!(Arc::ptr_eq(&first.mesh, &read().mesh));
        std::fs::write(&path, format!("{TRIANGLE}f 3 2 1\n")).unwrap();
        assert_eq!(read().mesh.triangles.len(), 2);
        let model_cache = ModelCache::for_one();
        let read = || model_cache.read(&path, &options).unwrap();
        assert!(!Arc::ptr_eq(&read().mesh, &read().mesh));
    }

    #[test]
    fn no_more_models_are_kept_than_there_is_room_for() {
        let folder = tempfile::tempdir().unwrap();
        let model_cache = ModelCache::for_many();
        for number in 0..100 {
            let path = folder.path().join(format!("{number}.obj"));
            std::fs::write(&path, TRIANGLE).unwrap();
            model_cache.read(path.to_str().unwrap(), &LoadOptions::default()).unwrap();
        }
        assert_eq!(model_cache.models.lock().unwrap().kept.len(), Models::COUNT);
    }
}
