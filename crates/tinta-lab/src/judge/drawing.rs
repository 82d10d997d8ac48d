//! A drawing by any program, read as a picture: PNG and the like unchanged, an SVG drawn by resvg.
//!
//! ```
//! use tinta_lab::judge::drawing;
//!
//! let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><path d="M0 5h20" stroke="black"/></svg>"#;
//! let picture = drawing::of_bytes(svg.as_bytes(), "line.svg", None)?;
//! assert_eq!((picture.size.width, picture.size.height), (20, 10));
//! # Ok::<(), tinta::Error>(())
//! ```

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, ImageHrefResolver, Options, Tree};
use std::path::Path;
use tinta::error::{Error, FileKind, Result};
use tinta::limits::{DRAWING_BYTES, PICTURE_BYTES, PICTURE_SIDE_PX};
use tinta::picture::Picture;
use tinta::scene::Size;
use tinta_geometry::files;

/// Reads a drawing; an SVG is drawn in this size, or in its own.
///
/// External pictures and fonts that a drawing names are not read.
///
/// # Errors
///
/// [`Error::File`] when it is missing, unreadable, damaged or too large, and for a picture of another size than this.
pub fn read(path: &Path, size: Option<Size>) -> Result<Picture> {
    let bytes = files::read_within(path, None, DRAWING_BYTES)
        .map_err(|failure| failure.into_error(FileKind::Picture, path, "a drawing"))?;
    of_bytes(&bytes, &path.to_string_lossy(), size)
}

/// The same for a file's bytes; `name` is for messages, and its extension identifies formats without a signature.
///
/// # Errors
///
/// As [`read`].
pub fn of_bytes(bytes: &[u8], name: &str, size: Option<Size>) -> Result<Picture> {
    if is_svg(bytes) {
        return of_svg(bytes, size).map_err(|problem| Error::picture(name, problem));
    }
    if bytes.starts_with(&[0x1f, 0x8b]) {
        return Err(Error::picture(name, "this is a compressed SVG; unpack it, with gzip for example"));
    }
    let picture = Picture::from_bytes(bytes, name)?;
    match size {
        Some(size) if size != picture.size => {
            let problem =
                format!("it has {} px, not the {size} px that --size asks for; leave --size out", picture.size);
            Err(Error::picture(name, problem))
        }
        _ => Ok(picture),
    }
}

/// Whether the file begins like XML, after the marks that editors add.
fn is_svg(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'<')
}

fn of_svg(bytes: &[u8], size: Option<Size>) -> std::result::Result<Picture, String> {
    let no_pictures = ImageHrefResolver {
        resolve_data: ImageHrefResolver::default_data_resolver(),
        resolve_string: Box::new(|_, _| None),
    };
    let options = Options { image_href_resolver: no_pictures, ..Options::default() };
    let tree = Tree::from_data(bytes, &options)
        .map_err(|error| format!("it is no SVG that can be read ({}); save it again", in_words(&error)))?;
    let own = tree.size();
    let size = match size {
        Some(size) => size,
        None => {
            let whole = |length: f32| (f64::from(length).round().clamp(1.0, f64::from(u32::MAX))) as u32;
            Size { width: whole(own.width()), height: whole(own.height()) }
        }
    };
    let Size { width, height } = size;
    let bytes = u64::from(width) * u64::from(height) * 4;
    let mut pixmap = Some(())
        .filter(|()| width.max(height) <= PICTURE_SIDE_PX && bytes <= PICTURE_BYTES)
        .and_then(|()| Pixmap::new(width, height))
        .ok_or_else(|| format!("{width} x {height} px are too many to draw it in; give a smaller --size"))?;
    let (x, y) = (width as f32 / own.width(), height as f32 / own.height());
    // Another proportion than its own would make circles ellipses: it is centred.
    let scale = x.min(y);
    let shift = [(width as f32 - own.width() * scale) * 0.5, (height as f32 - own.height() * scale) * 0.5];
    resvg::render(&tree, Transform::from_row(scale, 0.0, 0.0, scale, shift[0], shift[1]), &mut pixmap.as_mut());
    let pixels = pixmap.pixels().iter().flat_map(|pixel| {
        let pixel = pixel.demultiply();
        [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]
    });
    Ok(Picture { size, pixels: pixels.collect() })
}

fn in_words(error: &usvg::Error) -> String {
    match error {
        usvg::Error::ElementsLimitReached => "it repeats its parts more than a million times".to_owned(),
        usvg::Error::InvalidSize => "it has no size".to_owned(),
        usvg::Error::NotAnUtf8Str => "it is not UTF-8 text".to_owned(),
        usvg::Error::ParsingFailed(error) => error.to_string(),
        error => error.to_string(),
    }
}
