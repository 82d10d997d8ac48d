//! Approved pictures: compared, drawn anew, listed.

use super::{failure_folder, root, side_by_side};
use tinta::Picture;
use tinta::picture::write_rgba_png;

/// A pixel counts as different beyond this, in 1/255: the rounding of another version of Mesa.
const LARGEST_DIFFERENCE: u8 = 3;

/// Share of pixels that may be different: edges fall on other pixels where another driver rasterises differently.
pub const DIFFERENT_SHARE: f64 = 0.005;

/// Share of pixels that differ by more than the tolerance.
pub fn different_share(expected: &Picture, actual: &Picture) -> f64 {
    if expected.size != actual.size {
        return 1.0;
    }
    let pairs = expected.pixels.chunks_exact(4).zip(actual.pixels.chunks_exact(4));
    let different = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > LARGEST_DIFFERENCE)).count();
    different as f64 / expected.size.pixel_count() as f64
}

/// Compares a picture with the golden of this name, or writes it; returns the difference as an error. `by` names the backend.
pub fn compare(name: &str, actual: &Picture, by: &str) -> Result<(), String> {
    let path = root().join("tests/goldens").join(format!("{name}.png"));
    if std::env::var_os("TINTA_UPDATE_GOLDENS").is_some() {
        write_rgba_png(actual, &path).unwrap();
        return Err(format!("{name} was drawn anew: look at it, then run without TINTA_UPDATE_GOLDENS"));
    }
    let expected = Picture::read_png(&path).map_err(|error| format!("{name}: the golden is missing: {error}"))?;
    let share = different_share(&expected, actual);
    if share <= DIFFERENT_SHARE {
        return Ok(());
    }
    let sheet = failure_folder().join(format!("{name}-{by}.png"));
    write_rgba_png(&side_by_side(&expected, actual), &sheet).unwrap();
    Err(format!(
        "{name} by {by}: {:.2} % of the pixels differ by more than {LARGEST_DIFFERENCE}/255, allowed {:.2} %; \
         expected | difference | actual: {}",
        share * 100.0,
        DIFFERENT_SHARE * 100.0,
        sheet.display()
    ))
}

/// How to accept a new picture of the test with this name.
pub fn how_to_update(test: &str) -> String {
    format!("if you intended the change: TINTA_UPDATE_GOLDENS=1 cargo test {test}, and look at it")
}

/// Groups of goldens, by the beginning of their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goldens {
    /// Styles.
    Styles,
    /// Looks.
    Looks,
    /// The window.
    Window,
}

/// The names of these goldens.
pub fn names(which: Goldens) -> Vec<String> {
    let files = std::fs::read_dir(root().join("tests/goldens")).unwrap().map(|file| file.unwrap().path());
    let names = files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned());
    let of = |name: &String| match name {
        name if name.starts_with("window-") => Goldens::Window,
        name if name.starts_with("look-") => Goldens::Looks,
        _ => Goldens::Styles,
    };
    names.filter(|name| of(name) == which).collect()
}
