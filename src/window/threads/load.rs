//! Reads models on a separate thread; the window stays responsive.

use crate::error::Result;
use crate::lines::PartRules;
use crate::mesh::{LoadOptions, LoadStage, Mesh, load_watched};
use crate::request::Request;
use crate::window::threads::report::{LoadedModels, Report, Reporter, Stage};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Starts threads that read models; the last request counts.
pub(in crate::window) struct Loader {
    reporter: Reporter,
    /// The number of the last load.
    last: AtomicU64,
}

impl Loader {
    /// With this reporter.
    pub(in crate::window) fn new(reporter: Reporter) -> Self {
        Self { reporter, last: AtomicU64::default() }
    }

    /// Whether this load is the last request.
    pub(in crate::window) fn is_last(&self, number: u64) -> bool {
        self.last.load(Ordering::Relaxed) == number
    }

    /// Starts to read.
    ///
    /// # Errors
    ///
    /// When the thread cannot be started.
    pub(in crate::window) fn start(
        &self,
        models: Vec<String>,
        options: LoadOptions,
        rules: PartRules,
    ) -> std::io::Result<()> {
        let number = self.last.fetch_add(1, Ordering::Relaxed) + 1;
        let reporter = self.reporter.clone();
        let work = move || {
            let stage = |stage: Stage| reporter.say(Report::Stage(number, stage));
            match scene_of(&models, (&options, &rules), &stage) {
                Err(error) => reporter.say(Report::NotLoaded(number, error)),
                Ok(loaded) => reporter.say(Report::Loaded(number, Box::new(loaded))),
            }
        };
        std::thread::Builder::new().name("loading".to_owned()).spawn(work).map(drop)
    }
}

/// Steps of reading a model.
const STEPS_A_MODEL: usize = 4;

/// Reads models with their parts whole or filled as rules say, puts them together, and reports progress.
fn scene_of(
    models: &[String],
    (options, rules): (&LoadOptions, &PartRules),
    stage: &dyn Fn(Stage),
) -> Result<LoadedModels> {
    let read = LoadOptions { uncut: rules.uncut(), ..options.clone() };
    let (mut meshes, mut remarks): (Vec<Arc<Mesh>>, Vec<String>) = Default::default();
    let mut files: Vec<PathBuf> =
        models.iter().filter(|model| !model.starts_with("builtin:")).map(PathBuf::from).collect();
    let steps = (STEPS_A_MODEL * models.len() + 1) as f32;
    for (index, model) in models.iter().enumerate() {
        let size = std::fs::metadata(model).map_or(String::new(), |file| format!(", {}", size_text(file.len())));
        let which = if models.len() > 1 { format!(" ({} of {})", index + 1, models.len()) } else { String::new() };
        let loaded = load_watched(model, &read, &|step| {
            let (done, doing) = match step {
                LoadStage::Reading => (0, "reading"),
                LoadStage::Parsing => (1, "understanding"),
                LoadStage::Joining => (2, "joining the vertices of"),
                _ => (3, "finding the normals of"),
            };
            let share = (STEPS_A_MODEL * index + done) as f32 / steps;
            stage(Stage { text: format!("{doing} {model}{size}{which}"), share });
        })?;
        remarks.extend(loaded.remarks);
        files.extend(loaded.files);
        meshes.push(Arc::new(loaded.mesh));
    }
    let triangles: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let text = format!("preparing {triangles} triangles for drawing");
    stage(Stage { text, share: (steps - 1.0) / steps });
    let scene = Request::default().placed(meshes)?.with_fills(rules);
    scene.make_arrays();
    Ok(LoadedModels { models: models.to_vec(), options: options.clone(), files, scene: Arc::new(scene), remarks })
}

fn size_text(bytes: u64) -> String {
    match bytes {
        0..1_000_000 => format!("{} kB", bytes.div_ceil(1000)),
        _ => format!("{} MB", bytes / 1_000_000),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::SectionPlanes;
    use crate::settings::Value;
    use std::cell::RefCell;

    #[test]
    fn steps_of_several_models_go_up_to_the_whole() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.obj").display().to_string();
        std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        let stages = RefCell::new(Vec::new());
        let models = [file, "builtin:ant".to_owned()];
        let as_read = (&LoadOptions::default(), &PartRules::default());
        let loaded = scene_of(&models, as_read, &|stage| stages.borrow_mut().push(stage)).unwrap();
        assert_eq!(loaded.scene.objects.len(), 2);
        let shares: Vec<f32> = stages.borrow().iter().map(|stage| (stage.share * 9.0).round()).collect();
        // A built-in model is neither read from a disk nor understood.
        assert_eq!(shares, [0.0, 1.0, 2.0, 3.0, 6.0, 8.0]);
        assert!(stages.borrow()[1].text.contains("understanding") && stages.borrow()[1].text.contains("(1 of 2)"));
    }

    #[test]
    fn parts_are_whole_and_filled_as_rules_say() {
        let cut = LoadOptions { section: Some(SectionPlanes::parse("z=0").unwrap()), ..LoadOptions::default() };
        let read = |rules: &str| {
            let models = ["builtin:plates".to_owned()];
            let scene = scene_of(&models, (&cut, &PartRules::parse(rules).unwrap()), &|_| ()).unwrap().scene;
            let mesh = &scene.objects[0].mesh;
            (mesh.extent(), mesh.materials.iter().filter(|material| material.is_fill).count())
        };
        let (cut, whole) = (read("none"), read("pin*: uncut; *: fill=red"));
        assert!(whole.0.1.z > cut.0.1.z, "{cut:?} {whole:?}");
        assert!(cut.1 == 0 && whole.1 > 0, "{cut:?} {whole:?}");
    }
}
