//! Reads a model file, and checks that its folder is unchanged.

use super::cases::Content;
use super::figures::Figures;
use super::outcome::Outcome;
use std::io;
use std::path::Path;
use tinta::mesh::{LoadOptions, load};

/// Makes the file, reads it as a model and takes it away.
pub(super) fn outcome(path: &Path, content: &Content) -> Outcome {
    if let Err(error) = make(path, content) {
        return Outcome::Refused { kind: "test", sentence: format!("the file cannot be made ({error})") };
    }
    let outcome = match load(&path.to_string_lossy(), &LoadOptions::default()) {
        Ok(loaded) => Outcome::Rendered(Figures::from([
            ("triangles", loaded.mesh.triangles.len() as f64),
            ("has_defects", f64::from(!loaded.mesh.defects.is_empty())),
        ])),
        Err(error) => Outcome::refused(&error),
    };
    // It lies in a temporary folder, which goes in the end in any case.
    let _ = std::fs::remove_file(path);
    outcome
}

fn make(path: &Path, content: &Content) -> io::Result<()> {
    match content {
        Content::Bytes(bytes) => std::fs::write(path, bytes),
        Content::Zeros(count) => std::fs::File::create(path)?.set_len(*count),
        Content::Folder => std::fs::create_dir_all(path),
        Content::Missing => Ok(()),
    }
}
