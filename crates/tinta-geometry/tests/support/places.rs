//! Where tests find models and write files, and how they say that one is skipped.

use std::io::Write;
use std::path::{Path, PathBuf};
use tinta::{LoadOptions, Mesh, load};

/// The project's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().find(|folder| folder.join("Cargo.lock").exists()).unwrap()
}

/// Reports that a test checks less than it could, bypassing the test harness's capture.
pub fn skip(what: &str) {
    let _ = writeln!(std::io::stderr(), "SKIPPED {what}");
}

/// The folder of optional public models for tests: `TINTA_MODELS`, by default `../shared/models`.
pub fn public_models() -> Option<PathBuf> {
    let folder = std::env::var_os("TINTA_MODELS").map_or_else(|| root().join("../shared/models"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    skip(&format!("public models: none in {}; set TINTA_MODELS to a folder that has them", folder.display()));
    None
}

/// Public models that every style and the exact lines draw.
pub const PUBLIC_MODELS: [&str; 9] = [
    "ant.ply",
    "beethoven.obj",
    "cow.obj",
    "faerie.md2",
    "fandisk.obj",
    "spot/spot_triangulated.obj",
    "stanford-bunny.obj",
    "suzanne.obj",
    "teapot.obj",
];

/// The path of a public model, if it is there.
pub fn public_model(file: &str) -> Option<String> {
    let folder = public_models()?;
    let path = folder.join(file);
    if !path.is_file() {
        skip(&format!("{file}: not in {}", folder.display()));
        return None;
    }
    path.to_str().map(str::to_owned)
}

/// Public models by their files' names, those that there are.
pub fn public_meshes<'a>(files: &[&'a str]) -> Vec<(&'a str, Mesh)> {
    public_meshes_with(files, &LoadOptions::default())
}

/// The same, read by these options.
pub fn public_meshes_with<'a>(files: &[&'a str], options: &LoadOptions) -> Vec<(&'a str, Mesh)> {
    files.iter().filter_map(|file| Some((*file, load(&public_model(file)?, options).unwrap().mesh))).collect()
}

/// A built-in model of one file, such as `gear`.
pub fn builtin(name: &str) -> Mesh {
    load(root().join(format!("models/{name}.obj")).to_str().unwrap(), &LoadOptions::default()).unwrap().mesh
}

/// The names in a folder, hidden ones too, sorted.
pub fn names(folder: impl AsRef<Path>) -> Vec<String> {
    let files = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A temporary folder.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    pub fn file(&self, name: &str, bytes: &[u8]) -> String {
        std::fs::write(self.0.path().join(name), bytes).unwrap();
        self.path(name)
    }
}
