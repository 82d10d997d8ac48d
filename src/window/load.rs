//! Reading models on a thread of its own, so that the window goes on meanwhile.

use super::report::{Report, Reporter};
use crate::error::Result;
use crate::mesh::{LoadOptions, Mesh, load};
use crate::scene::{Scene, SceneSettings};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Models that were read.
#[derive(Debug)]
pub struct LoadedModels {
    /// As the user named them.
    pub models: Vec<String>,
    /// Their files and what was read beside them.
    pub files: Vec<PathBuf>,
    /// They at their places.
    pub scene: Arc<Scene>,
    /// What was noticed, to be said once.
    pub remarks: Vec<String>,
}

/// Starts threads that read models; the last one asked counts.
pub struct Loader {
    options: LoadOptions,
    reporter: Reporter,
    /// The number of the last load.
    last: Arc<AtomicU64>,
}

impl Loader {
    /// Reads models with these options and tells this reporter.
    pub fn new(options: LoadOptions, reporter: Reporter) -> Self {
        Self { options, reporter, last: Arc::default() }
    }

    /// Whether this load is the last one asked for.
    pub fn is_last(&self, number: u64) -> bool {
        self.last.load(Ordering::Relaxed) == number
    }

    /// Starts to read.
    ///
    /// # Errors
    ///
    /// When there is no thread to be had.
    pub fn start(&self, models: Vec<String>) -> std::io::Result<()> {
        let number = self.last.fetch_add(1, Ordering::Relaxed) + 1;
        let (options, reporter, last) = (self.options.clone(), self.reporter.clone(), self.last.clone());
        let work = move || {
            let stage = |text: String| reporter.say(Report::Stage(number, text));
            match scene_of(&models, &options, &stage) {
                Err(error) => reporter.say(Report::NotLoaded(number, error)),
                Ok(loaded) => {
                    let scene = loaded.scene.clone();
                    reporter.say(Report::Loaded(number, Box::new(loaded)));
                    // What makes later frames faster; of no use to a scene that is no longer shown.
                    for object in &scene.objects {
                        if last.load(Ordering::Relaxed) != number {
                            return;
                        }
                        scene.hiding(object);
                    }
                    reporter.say(Report::Prepared);
                }
            }
        };
        std::thread::Builder::new().name("loading".to_owned()).spawn(work).map(drop)
    }
}

/// Reads models and puts them together; says what it does.
fn scene_of(models: &[String], options: &LoadOptions, stage: &dyn Fn(String)) -> Result<LoadedModels> {
    let (mut meshes, mut remarks): (Vec<Arc<Mesh>>, Vec<String>) = Default::default();
    let mut files: Vec<PathBuf> =
        models.iter().filter(|model| !model.starts_with("builtin:")).map(PathBuf::from).collect();
    for (index, model) in models.iter().enumerate() {
        let size = std::fs::metadata(model).map_or(String::new(), |file| format!(", {}", size_text(file.len())));
        let which = if models.len() > 1 { format!(" ({} of {})", index + 1, models.len()) } else { String::new() };
        stage(format!("reading {model}{size}{which}"));
        let loaded = load(model, options)?;
        remarks.extend(loaded.remarks);
        files.extend(loaded.files);
        meshes.push(Arc::new(loaded.mesh));
    }
    let triangles: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    stage(format!("preparing {triangles} triangles for drawing"));
    let scene = Scene::new(meshes, &SceneSettings::default())?;
    scene.make_arrays();
    Ok(LoadedModels { models: models.to_vec(), files, scene: Arc::new(scene), remarks })
}

fn size_text(bytes: u64) -> String {
    match bytes {
        0..1_000_000 => format!("{} kB", bytes.div_ceil(1000)),
        _ => format!("{} MB", bytes / 1_000_000),
    }
}
