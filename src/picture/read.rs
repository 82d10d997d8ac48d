//! Picture files to pictures: skins and textures. Known by content, where that says too little by extension.

use super::{Picture, pcx};
use crate::error::{Error, Result};
use crate::scene::Size;
use image::error::{ImageError, LimitErrorKind};
use image::{ImageFormat, ImageReader, Limits};
use std::io::{Cursor, ErrorKind};
use std::path::Path;

/// The longest side a picture may have, pixels: the largest texture that OpenGL drivers take.
pub const LARGEST_SIDE_PX: u32 = 16_384;

/// What decoding may take: the largest picture with four bytes a pixel.
const LARGEST_BYTES: u64 = LARGEST_SIDE_PX as u64 * LARGEST_SIDE_PX as u64 * 4;

/// How TGA files may end since 1989; the older ones say nothing of what they are.
const TGA_END: &[u8] = b"TRUEVISION-XFILE.\0";

impl Picture {
    /// Reads a PNG, BMP, TGA, JPEG, PPM or PCX file.
    ///
    /// # Errors
    ///
    /// [`Error::Picture`] with the path when it is missing, unreadable, damaged, in no such format, or longer than 16384
    /// pixels on a side.
    pub fn read(path: &Path) -> Result<Self> {
        let failed = |problem: String| Error::picture(path, problem);
        // Only files: a pipe or device would never end.
        let metadata = path.metadata().map_err(|error| failed(cannot_read(&error)))?;
        if metadata.is_dir() {
            return Err(failed("this is a directory; name a picture in it".to_owned()));
        }
        if !metadata.is_file() {
            return Err(failed("this is no ordinary file; name a picture".to_owned()));
        }
        let bytes = std::fs::read(path).map_err(|error| failed(cannot_read(&error)))?;
        let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
        decode(&bytes, extension.as_deref().unwrap_or_default()).map_err(failed)
    }
}

pub(super) fn too_large() -> String {
    format!("it is longer than {LARGEST_SIDE_PX} pixels on a side; scale it down")
}

fn cannot_read(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file; check the name".to_owned(),
        ErrorKind::PermissionDenied => "it may not be read; check its permissions".to_owned(),
        _ => format!("it cannot be read ({error}); check the file"),
    }
}

/// A picture out of a file's bytes; the error is a sentence without the file's name.
fn decode(bytes: &[u8], extension: &str) -> std::result::Result<Picture, String> {
    if bytes.is_empty() {
        return Err("the file is empty; save the picture again".to_owned());
    }
    let known = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Jpeg, ImageFormat::Pnm];
    let format = match image::guess_format(bytes) {
        Ok(format) if known.contains(&format) => format,
        _ if extension == "pcx" || (pcx::looks_like(bytes) && extension != "tga") => return pcx::read(bytes),
        _ if extension == "tga" || bytes.ends_with(TGA_END) => ImageFormat::Tga,
        _ => {
            return Err("this is not a picture in a format known here; use PNG, BMP, TGA, JPEG, PPM or PCX".to_owned());
        }
    };
    let mut limits = Limits::default();
    limits.max_image_width = Some(LARGEST_SIDE_PX);
    limits.max_image_height = Some(LARGEST_SIDE_PX);
    limits.max_alloc = Some(LARGEST_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| in_words(&error))?.into_rgba8();
    let size = Size { width: picture.width(), height: picture.height() };
    if size.width == 0 || size.height == 0 {
        return Err("it has no pixels; save it again".to_owned());
    }
    Ok(Picture { size, pixels: picture.into_raw() })
}

fn in_words(error: &ImageError) -> String {
    match error {
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::DimensionError) => too_large(),
        ImageError::Limits(_) => "it takes too much memory; scale it down".to_owned(),
        error => format!("it is damaged or of a kind that is not read ({error}); save it again"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{PictureFormat, Target};

    fn picture() -> Picture {
        let size = Size { width: 5, height: 4 };
        let pixels = (0..20).flat_map(|index| [index * 12, 255 - index, 7, 255]).collect();
        Picture { size, pixels }
    }

    /// The same picture in each format written here, with its extension.
    fn files() -> Vec<(&'static str, Vec<u8>)> {
        let encoded = |(extension, format): &(&'static str, PictureFormat)| {
            let mut bytes = Vec::new();
            picture().encode(*format, false, &mut bytes).unwrap();
            (*extension, bytes)
        };
        PictureFormat::EXTENSIONS.iter().map(encoded).collect()
    }

    #[test]
    fn every_format_is_read_by_content_and_tga_and_pcx_by_extension() {
        for (extension, bytes) in files() {
            let read = decode(&bytes, extension).unwrap();
            let tolerance = if extension.starts_with("jp") { 40 } else { 0 };
            assert!(picture().difference(&read).unwrap().largest <= tolerance, "{extension}");
            assert_eq!(decode(&bytes, "txt").is_ok(), extension != "tga", "{extension} misnamed");
        }
        let pcx = pcx::tests::with_palette();
        assert_eq!(decode(&pcx, "pcx"), decode(&pcx, ""));
        assert_eq!(decode(&pcx, "pcx").unwrap().size.width, 3);
    }

    #[test]
    fn files_are_read_and_what_is_none_is_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        Target::check(at("a.tga").to_str().unwrap(), false).unwrap().write(&picture()).unwrap();
        assert_eq!(Picture::read(&at("a.tga")).unwrap(), picture());
        std::fs::write(at("empty.png"), "").unwrap();
        std::fs::write(at("notes.txt"), "dear diary").unwrap();
        let message = |path: &Path| Picture::read(path).unwrap_err().to_string();
        assert!(message(&at("none.pcx")).ends_with("none.pcx: there is no such file; check the name"));
        assert!(message(&at("empty.png")).contains("empty.png: the file is empty"));
        assert!(message(&at("notes.txt")).contains("not a picture in a format known here"));
        assert!(message(folder.path()).contains("directory"));
        #[cfg(unix)]
        assert!(message(Path::new("/dev/null")).contains("no ordinary file"));
    }

    #[test]
    fn pictures_that_are_too_long_are_refused_before_they_are_decoded() {
        let ppm =
            |width: u32, height: u32| decode(format!("P6\n{width} {height}\n255\n").as_bytes(), "ppm").unwrap_err();
        assert!(ppm(16_385, 1).contains("longer than 16384 pixels"));
        assert!(ppm(1, 100_000).contains("longer than 16384 pixels"));
        assert!(ppm(100, 100).contains("damaged"));
    }

    #[test]
    fn no_truncation_and_no_changed_byte_panics() {
        for (extension, whole) in files() {
            for length in 0..whole.len() {
                if let Ok(read) = decode(&whole[..length], extension) {
                    assert_eq!(read.pixels.len(), read.size.width as usize * read.size.height as usize * 4);
                }
            }
            for place in 0..whole.len() {
                for byte in [0, 0xff] {
                    let mut bytes = whole.clone();
                    bytes[place] = byte;
                    let _ = decode(&bytes, extension);
                }
            }
        }
    }
}
