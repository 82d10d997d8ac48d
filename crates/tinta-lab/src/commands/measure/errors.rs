//! Pictures of a row's drawing and of its errors, for the report page.

use crate::measure::Row;
use crate::report::ReportPicture;
use std::path::{Path, PathBuf};
use tinta::cli::make_folder;
use tinta::picture::PictureFormat;
use tinta::{Error, Picture, Result, Target};

/// Whether the page shows a row's errors: those of each style's published settings, and of the best.
pub(super) fn is_shown(row: &Row) -> bool {
    let is_exact = row.options.starts_with("--style inking --silhouette exact")
        && !["smooth", "line-", "polygon", "classes", "ink-depth"].iter().any(|other| row.options.contains(other));
    row.lines.is_some() && (row.is_faithful || row.style == "ink" || is_exact)
}

/// The endings of the names of drawings and of pictures of errors.
const DRAWING: &str = "-drawing";
const ERRORS: &str = "";

/// The largest size of a drawing in the page, bytes: a hundred of them stay below five million in base 64.
const MOST_BYTES: usize = 36_000;

/// Where a picture of a row lies.
fn path(folder: &Path, row: &Row, end: &str) -> PathBuf {
    let safe = |text: &str, others: &[char]| -> String {
        text.chars().map(|c| if c.is_ascii_alphanumeric() || others.contains(&c) { c } else { '-' }).collect()
    };
    let model = safe(&row.model, &[]);
    let options = row.options.replace("--style ", "").replace(" --", "-");
    let options = shortened(safe(&options, &['.', '_', '#', '+', '=']));
    let name = format!("{}-{}x{}-{options}{end}.png", model.trim_matches('-'), row.size[0], row.size[1]);
    folder.join("errors").join(name)
}

/// A name that every file system accepts: a long one is cut, with a number for the rest.
fn shortened(name: String) -> String {
    const MOST_LETTERS: usize = 120;
    if name.chars().count() <= MOST_LETTERS {
        return name;
    }
    // FNV-1a: the same number wherever a run is resumed.
    let number = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |number: u64, byte| (number ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    format!("{}-{number:016x}", name.chars().take(MOST_LETTERS).collect::<String>())
}

/// Writes a drawing and the picture of its errors and hands them over for the page.
pub(super) fn error_page(folder: &Path, row: &Row, pictures: [&Picture; 2]) -> Result<ReportPicture> {
    make_folder(&folder.join("errors"))?;
    let paths = [DRAWING, ERRORS].map(|end| path(folder, row, end));
    for (path, picture) in paths.iter().zip(pictures) {
        Target::File { path: path.clone(), format: PictureFormat::Png }.write(picture)?;
    }
    let [_, errors] = paths;
    known_picture(folder, row).ok_or_else(|| Error::output(errors, "it cannot be read again; choose another folder"))
}

/// The pictures of a row for the page, if that of its errors is there.
pub(super) fn known_picture(folder: &Path, row: &Row) -> Option<ReportPicture> {
    let png = std::fs::read(path(folder, row, ERRORS)).ok()?;
    let drawing = Picture::read_png(&path(folder, row, DRAWING)).ok();
    let drawing = drawing.and_then(|drawing| drawing.small_png(MOST_BYTES));
    let f1 = row.lines.as_ref().map(|lines| format!(", F1 {:.3}", lines.f1)).unwrap_or_default();
    let caption = format!("{}x{}: {}{f1}", row.size[0], row.size[1], row.options);
    Some(ReportPicture { caption, model: Some(row.model.clone()), drawing, png })
}
