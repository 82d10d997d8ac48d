//! Reads picture files: skins and textures. The content identifies the format, or else the extension.

use super::size::{check_size, too_large};
use super::{Picture, pcx};
use crate::bytes::Bytes;
use crate::error::{Error, FileKind, Result};
use crate::files::{self, shown};
use crate::limits::{MEMORY_FACTOR, MEMORY_SLACK_BYTES, PICTURE_BYTES, PICTURE_FILE_BYTES, PICTURE_SIDE_PX};
use crate::values::Size;
use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;

/// The footer of TGA files since 1989; older files have no signature.
const TGA_END: &[u8] = b"TRUEVISION-XFILE.\0";

impl Picture {
    /// Reads a PNG, BMP, TGA, JPEG, PPM or PCX file.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the path when it is missing, unreadable, damaged, in another format, longer than 16384 pixels on a
    /// side, or larger in memory than [`PICTURE_BYTES`] without a file of matching size.
    pub fn read(path: &Path) -> Result<Self> {
        Self::read_within(path, None, u64::MAX).map(|(picture, _)| picture)
    }

    /// Reads a file in the folder of real path `within`, if given, whose pixels may take `most` bytes; returns the file's size
    /// too.
    pub(crate) fn read_within(path: &Path, within: Option<&Path>, most: u64) -> Result<(Self, u64)> {
        let failed = |problem: String| Error::picture(path, problem);
        let bytes = files::read_within(path, within, PICTURE_FILE_BYTES)
            .map_err(|failure| failure.into_error(FileKind::Picture, path, "a picture"))?;
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let picture = decode(&bytes, &extension.to_ascii_lowercase(), most).map_err(failed)?;
        Ok((picture, bytes.len() as u64))
    }

    /// Reads a picture file's bytes. `name` is for messages; its extension identifies TGA and PCX, which have no signature.
    ///
    /// # Errors
    ///
    /// Those of [`Picture::read`].
    pub fn from_bytes(bytes: &[u8], name: &str) -> Result<Self> {
        Self::from_bytes_of(bytes, name, u64::MAX)
    }

    /// Reads a picture whose pixels may take `most` bytes.
    pub(crate) fn from_bytes_of(bytes: &[u8], name: &str, most: u64) -> Result<Self> {
        let path = Path::new(name);
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        decode(bytes, &extension.to_ascii_lowercase(), most).map_err(|problem| Error::picture(path, problem))
    }
}

/// Decodes a file's bytes into a picture of at most `most` bytes; the error is a sentence without the file's name.
fn decode(bytes: &[u8], extension: &str, most: u64) -> std::result::Result<Picture, String> {
    if bytes.is_empty() {
        return Err("the file is empty; save the picture again".to_owned());
    }
    let known = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Jpeg, ImageFormat::Pnm];
    let format = match image::guess_format(bytes) {
        Ok(format) if known.contains(&format) => format,
        _ if extension == "pcx" || (pcx::looks_like(bytes) && extension != "tga") => return pcx::read(bytes, most),
        _ if extension == "tga" || bytes.ends_with(TGA_END) => ImageFormat::Tga,
        _ => {
            return Err("this is not a picture in a supported format; use PNG, BMP, TGA, JPEG, PPM or PCX".to_owned());
        }
    };
    if format == ImageFormat::Png && !has_sound_palette(bytes) {
        return Err("its palette is not a list of up to 256 colours; it is damaged, save it again".to_owned());
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(PICTURE_SIDE_PX);
    limits.max_image_height = Some(PICTURE_SIDE_PX);
    // Twice the pixels' memory, because files may have 16 bits per channel, and the decoder's own memory.
    limits.max_alloc = Some(2 * PICTURE_BYTES.max((bytes.len() * MEMORY_FACTOR) as u64) + MEMORY_SLACK_BYTES as u64);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| in_words(&error))?;
    let (width, height) = decoder.dimensions();
    check_size(Size { width, height }, bytes.len(), most)?;
    let picture = DynamicImage::from_decoder(decoder).map_err(|error| in_words(&error))?.into_rgba8();
    let size = Size { width: picture.width(), height: picture.height() };
    if size.width == 0 || size.height == 0 {
        return Err("it has no pixels; save it again".to_owned());
    }
    Ok(Picture { size, pixels: picture.into_raw() })
}

/// Whether a PNG file's palette, if any, has whole colours and not too many: the png crate (0.18) panics otherwise.
fn has_sound_palette(file: &[u8]) -> bool {
    const SIGNATURE_BYTES: usize = 8;
    let mut bytes = Bytes(file);
    bytes.take(SIGNATURE_BYTES);
    loop {
        let length = bytes.u32().map(|length| length.swap_bytes() as usize);
        let (Some(length), Some(kind)) = (length, bytes.take(4)) else { return true };
        if kind == b"PLTE" && (length > 256 * 3 || length % 3 != 0) {
            return false;
        }
        // A checksum of four bytes follows; the decoder reports a file that ends too early.
        if bytes.take(length).and_then(|_| bytes.take(4)).is_none() {
            return true;
        }
    }
}

fn in_words(error: &ImageError) -> String {
    match error {
        ImageError::Limits(limit) if matches!(limit.kind(), LimitErrorKind::DimensionError) => too_large(),
        ImageError::Limits(_) => "it takes too much memory; scale it down".to_owned(),
        // Its text may quote the file.
        error => {
            let cause = shown(&error.to_string());
            format!("it is damaged or of an unsupported kind ({cause}); save it again")
        }
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

    /// Returns the same picture in each written format, with its extension.
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
            let read = decode(&bytes, extension, u64::MAX).unwrap();
            let tolerance = if extension.starts_with("jp") { 40 } else { 0 };
            assert!(picture().difference(&read).unwrap().largest <= tolerance, "{extension}");
            assert_eq!(decode(&bytes, "txt", u64::MAX).is_ok(), extension != "tga", "{extension} misnamed");
        }
        let pcx = pcx::tests::with_palette();
        assert_eq!(decode(&pcx, "pcx", u64::MAX), decode(&pcx, "", u64::MAX));
        assert_eq!(decode(&pcx, "pcx", u64::MAX).unwrap().size.width, 3);
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
        assert!(message(&at("notes.txt")).contains("not a picture in a supported format"));
        assert!(message(folder.path()).contains("directory"));
        #[cfg(unix)]
        assert!(message(Path::new("/dev/null")).contains("not a regular file"));
    }

    #[test]
    fn pictures_that_are_too_long_are_refused_before_they_are_decoded() {
        let ppm = |width: u32, height: u32| {
            decode(format!("P6\n{width} {height}\n255\n").as_bytes(), "ppm", u64::MAX).unwrap_err()
        };
        assert!(ppm(16_385, 1).contains("longer than 16384 pixels"));
        assert!(ppm(1, 100_000).contains("longer than 16384 pixels"));
        assert!(ppm(100, 100).contains("damaged"));
    }

    #[test]
    fn palettes_of_broken_colours_or_too_many_are_refused() {
        // A PNG of 4 x 1 pixels with a palette of this many bytes; its checksums are irrelevant here.
        let with = |length: u32| {
            let chunk = |kind: &[u8], data: &[u8]| [&(data.len() as u32).to_be_bytes(), kind, data, &[0; 4]].concat();
            let header = chunk(b"IHDR", &[0, 0, 0, 4, 0, 0, 0, 1, 8, 3, 0, 0, 0]);
            let palette = chunk(b"PLTE", &vec![7; length as usize]);
            [b"\x89PNG\r\n\x1a\n".as_slice(), &header, &palette, &chunk(b"IDAT", &[0; 9])].concat()
        };
        for length in [1, 2, 4, 5, 766, 767, 769, 771, 3000] {
            assert!(decode(&with(length), "png", u64::MAX).unwrap_err().contains("palette"), "{length}");
        }
        for length in [0, 3, 6, 768] {
            assert!(has_sound_palette(&with(length)), "{length}");
        }
    }

    #[test]
    fn a_picture_that_is_quoted_by_its_message_is_not_quoted_without_end() {
        let long = format!("P7\n{} 1\nENDHDR\n", "\u{12}".repeat(100_000));
        let message = decode(long.as_bytes(), "ppm", u64::MAX).unwrap_err();
        assert!(message.len() < 1000 && message.starts_with("it is damaged"), "{message:.200}");
    }

    #[test]
    fn no_truncation_and_no_changed_byte_panics() {
        for (extension, whole) in files() {
            for length in 0..whole.len() {
                if let Ok(read) = decode(&whole[..length], extension, u64::MAX) {
                    assert_eq!(read.pixels.len(), read.size.width as usize * read.size.height as usize * 4);
                }
            }
            for place in 0..whole.len() {
                for byte in [0, 0xff] {
                    let mut bytes = whole.clone();
                    bytes[place] = byte;
                    let _ = decode(&bytes, extension, u64::MAX);
                }
            }
        }
    }
}
