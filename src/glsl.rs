//! The shaders, whole files from `glsl/`, carried inside the program.
//!
//! ```
//! let filter = tinta::glsl::source("evangelista/border.frag").expect("a shader of the article");
//! assert!(filter.starts_with("#version 120") && filter.contains("DETECTION_FACTOR 0.2f"));
//! ```

use crate::choice::meant_or;
use crate::error::{Error, Result};
use std::collections::HashMap;
use std::path::Path;

pub mod es;

/// A shader's path below `glsl/` and its text.
pub(crate) type Source = (&'static str, &'static str);

macro_rules! sources {
    ($($path:literal),* $(,)?) => {
        /// All shaders; a test compares this with the folder. Static: a program holds them once.
        pub static SOURCES: &[Source] = &[$(($path, include_str!(concat!("../glsl/", $path)))),*];
    };
}

// A macro because include_str! takes only literals; a function would need every path twice.
sources![
    "dachsbacher/ramp.vert",
    "dietrich/dietrich.frag",
    "dietrich/dietrich.vert",
    "evangelista/border-settings.frag",
    "evangelista/border.frag",
    "evangelista/border.vert",
    "evangelista/depth-as-filtered.frag",
    "evangelista/filter-gaussian.frag",
    "evangelista/filter-laplacian4.frag",
    "evangelista/filter-laplacian8.frag",
    "evangelista/filter-mitchell-depth.frag",
    "evangelista/filter-mitchell-normals.frag",
    "evangelista/filter-mitchell.frag",
    "evangelista/filter-roberts.frag",
    "evangelista/filter-sobel.frag",
    "evangelista/map.frag",
    "evangelista/map.vert",
    "evangelista/tap-next.frag",
    "evangelista/texel-map.frag",
    "evangelista/tone-steps.frag",
    "evangelista/tone-texture.frag",
    "evangelista/toon-settings.frag",
    "evangelista/toon.frag",
    "evangelista/toon.vert",
    "evangelista/two-pass-settings.frag",
    "evangelista/two-pass.frag",
    "evangelista/two-pass.vert",
    "fixed/one-texture.frag",
    "fixed/smooth-line.frag",
    "fixed/smooth-point.frag",
    "fixed/transform.vert",
    "fixed/two-textures.frag",
    "fixed/untextured.frag",
    "improved/box-filter.frag",
    "improved/ink-depth-map.frag",
    "improved/ink-turn-planes.frag",
    "improved/map-biased.vert",
    "improved/map-float.frag",
    "improved/map-float.vert",
    "improved/map-numbers.frag",
    "improved/map-numbers.vert",
    "improved/numbers-differ.frag",
    "improved/plane-ink.frag",
    "improved/plane-map.frag",
    "improved/plane-map.vert",
    "improved/slope-threshold.frag",
    "improved/specks.frag",
    "improved/tap-apart.frag",
    "improved/texel-biased.frag",
    "improved/texel-depth-texture.frag",
    "improved/tone-diffuse.frag",
    "improved/tone-one.frag",
    "improved/tones-far.frag",
    "improved/tones-far.vert",
    "improved/two-targets-settings.frag",
    "improved/two-targets.frag",
    "improved/two-targets.vert",
    "phong/phong.frag",
    "phong/phong.vert",
    "valente/charcoal-object.vert",
    "valente/charcoal-parts.frag",
    "valente/charcoal.frag",
    "valente/charcoal.vert",
    "valente/clamp-discarded.frag",
    "valente/clamp-kept.frag",
    "valente/finish-cem.frag",
    "valente/finish-cet.frag",
    "valente/finish-diffuse.frag",
    "valente/finish-drawing.frag",
    "valente/finish-sand.frag",
    "valente/grain-pixel.frag",
    "valente/grain-sample.frag",
    "valente/lights-one.frag",
    "valente/lights-two.frag",
    "valente/luminance-published.frag",
    "valente/luminance-rec709.frag",
    "valente/noise-object.frag",
    "valente/noise-screen.frag",
    "valente/operator-bias.frag",
    "valente/operator-power.frag",
    "valente/operator-sigmoid.frag",
    "valente/paper-even.frag",
    "valente/paper-pixel.frag",
    "valente/paper-vertex.frag",
    "valente/paper.frag",
    "valente/paper.vert",
    "valente/row-original.frag",
    "valente/row-saturated.frag",
    "valente/sand.frag",
    "valente/sand.vert",
    "valente/side-outer.frag",
    "valente/side-seen.frag",
    "valente/spread-even.frag",
    "valente/spread-stretched.frag",
    "valente/strokes-hand.frag",
    "valente/strokes-none.frag",
    "valente/tooth-none.frag",
    "valente/tooth-paper.frag",
    "valente/wrap-edge.frag",
    "valente/wrap-repeat.frag",
];

/// The folder of the built-in shaders, in messages.
pub(crate) const BUILT_IN: &str = "glsl/";

/// Longest shader read from a folder, bytes: some hundred times the longest there is.
const LONGEST: u64 = 1 << 20;

/// The shaders that a folder laid out like `glsl/` has in place of those built in, by their paths: files of the same names with other
/// texts.
pub(crate) fn in_folder(folder: &Path) -> HashMap<String, String> {
    let read = |path: &str| {
        let file = folder.join(path);
        let is_short = std::fs::metadata(&file).is_ok_and(|file| file.is_file() && file.len() <= LONGEST);
        is_short.then(|| std::fs::read_to_string(&file).ok()).flatten()
    };
    let changed = SOURCES.iter().filter_map(|(path, built_in)| Some((*path, *built_in, read(path)?)));
    changed.filter(|(_, built_in, text)| text != built_in).map(|(path, _, text)| (path.to_owned(), text)).collect()
}

/// Refuses a folder that does not exist, and one with a shader whose name is none of the built-in ones: nothing would run it.
///
/// # Errors
///
/// [`Error::Setting`] that names the folder.
pub(crate) fn check_folder(folder: &str) -> Result<()> {
    let refused = |problem: String| Err(Error::value("glsl", folder, problem));
    if !Path::new(folder).is_dir() {
        return refused("there is no such folder; check the name".to_owned());
    }
    let Some(path) = stray(Path::new(folder)) else { return Ok(()) };
    let known: Vec<&str> = SOURCES.iter().map(|(known, _)| *known).collect();
    let name_of = |path: &str| path.rsplit('/').next().unwrap_or_default().to_owned();
    let meant = match known.iter().find(|known| name_of(known) == name_of(&path)) {
        Some(place) => format!("did you mean {place}?"),
        None => meant_or(&path, &known, "name it like the shader of glsl/ that it replaces, or remove it"),
    };
    refused(format!("no style runs {path}; {meant}"))
}

/// A vertex or fragment shader of a folder, or of a folder in it, without a built-in one of its name; the first in the alphabet.
fn stray(folder: &Path) -> Option<String> {
    let entries = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten();
    let name = |entry: &std::fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let within = |entry: std::fs::DirEntry| {
        let (path, at_top) = (name(&entry), !entry.path().is_dir());
        let inner = entries(&entry.path()).map(|inner| format!("{path}/{}", name(&inner)));
        if at_top { vec![path.clone()] } else { inner.collect() }
    };
    let is_stray = |path: &String| {
        let is_shader = [".vert", ".frag"].iter().any(|ending| path.ends_with(ending));
        is_shader && source(path).is_none()
    };
    entries(folder).flat_map(within).filter(is_stray).min()
}

/// Returns the text of a shader; `None` for an unknown path.
pub fn source(path: &str) -> Option<&'static str> {
    SOURCES.iter().find(|(name, _)| *name == path).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_is_its_tokens_put_together() {
        for (path, text) in SOURCES {
            let together: String = tinta_glsl::tokens::tokens(text).iter().map(|token| token.text).collect();
            assert_eq!(together, *text, "{path}");
        }
    }

    #[test]
    fn the_table_holds_the_folder_and_every_file_begins_with_its_version() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl");
        let mut files = Vec::new();
        for folder in std::fs::read_dir(&root).unwrap() {
            let folder = folder.unwrap().path();
            for file in std::fs::read_dir(&folder).unwrap() {
                let path = file.unwrap().path();
                files.push(path.strip_prefix(&root).unwrap().to_str().unwrap().to_owned());
            }
        }
        files.sort();
        assert!(!files.is_empty());
        assert_eq!(files, SOURCES.iter().map(|(path, _)| (*path).to_owned()).collect::<Vec<_>>());
        for (path, text) in SOURCES {
            assert!(text.starts_with("#version 120\n//"), "{path} begins with its version and says what it is");
        }
    }

    #[test]
    fn a_shader_that_no_style_runs_is_refused_with_the_name_that_is_meant() {
        let folder = tempfile::tempdir().unwrap();
        let own = folder.path().join("evangelista");
        std::fs::create_dir(&own).unwrap();
        let refused = || check_folder(folder.path().to_str().unwrap()).unwrap_err().to_string();
        std::fs::write(own.join("notes.txt"), "").unwrap();
        std::fs::write(own.join("border.frag"), "").unwrap();
        check_folder(folder.path().to_str().unwrap()).unwrap();
        std::fs::write(own.join("z-quite-different-name.vert"), "").unwrap();
        assert!(refused().ends_with(
            "no style runs evangelista/z-quite-different-name.vert; name it like the shader of glsl/ that it replaces, or remove it"
        ));
        std::fs::write(own.join("boarder.frag"), "").unwrap();
        assert!(refused().ends_with("no style runs evangelista/boarder.frag; did you mean evangelista/border.frag?"));
        std::fs::write(folder.path().join("border.frag"), "").unwrap();
        assert!(refused().ends_with("no style runs border.frag; did you mean evangelista/border.frag?"));
    }

    #[test]
    fn only_shaders_that_differ_from_those_built_in_replace_them() {
        let folder = tempfile::tempdir().unwrap();
        let (path, text) = SOURCES[0];
        std::fs::create_dir_all(folder.path().join(path).parent().unwrap()).unwrap();
        std::fs::write(folder.path().join(path), text).unwrap();
        std::fs::write(folder.path().join("other.frag"), "void main() {}").unwrap();
        assert!(in_folder(folder.path()).is_empty());
        std::fs::write(folder.path().join(path), format!("{text}\n")).unwrap();
        assert_eq!(in_folder(folder.path()).into_keys().collect::<Vec<_>>(), [path]);
    }
}
