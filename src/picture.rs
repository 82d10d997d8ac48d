//! A picture: RGBA8 and its size, written to files and read from them. Only this file and `src/picture/read.rs` use the image
//! crate.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::{Picture, Size};
//!
//! let folder = tempfile::tempdir().expect("a folder");
//! let name = folder.path().join("red.png");
//! let red = Picture { size: Size { width: 2, height: 1 }, pixels: [255, 0, 0, 255].repeat(2) };
//! red.save(&name)?;
//! assert_eq!(Picture::read_png(&name)?, red);
//! # Ok(())
//! # }
//! ```

mod averaged;
mod materials;
mod pcx;
pub(crate) mod png_text;
mod powers_of_two;
mod read;
mod size;
mod small;

pub use materials::{MaterialPictures, material_pictures};

use crate::error::{Error, Result};
use crate::output::{StagedContents, check_file, check_name, write_standard_output, write_whole};
use crate::values::Size;
#[cfg(feature = "gltf")]
use image::codecs::jpeg::JpegEncoder;
use image::codecs::{bmp::BmpEncoder, png, pnm, tga::TgaEncoder};
use image::imageops::thumbnail;
use image::{ExtendedColorType, ImageBuffer, ImageEncoder, Rgba};
use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Pixels as red, green, blue, alpha bytes (alpha straight), top row first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width and height.
    pub size: Size,
    /// Four bytes per pixel, row by row from the top.
    pub pixels: Vec<u8>,
}

impl Picture {
    /// Returns the pixel in column `x` from the left and row `y` from the top, both clamped to the picture.
    pub fn pixel(&self, x: i64, y: i64) -> [u8; 4] {
        let x = x.clamp(0, i64::from(self.size.width) - 1) as usize;
        let y = y.clamp(0, i64::from(self.size.height) - 1) as usize;
        let start = (y * self.size.width as usize + x) * 4;
        [0, 1, 2, 3].map(|channel| self.pixels[start + channel])
    }

    /// Returns the picture in a smaller size, each pixel the mean of those in its place.
    #[must_use]
    fn reduced(&self, Size { width, height }: Size) -> Self {
        let image = ImageBuffer::<Rgba<u8>, &[u8]>::from_raw(self.size.width, self.size.height, &self.pixels);
        let pixels = image.map_or_else(Vec::new, |image| thumbnail(&image, width, height).into_raw());
        Self { size: Size { width, height }, pixels }
    }

    /// Whether all its pixels are the same.
    pub(crate) fn is_of_one_color(&self) -> bool {
        // Bytes that equal those of the pixel before.
        self.pixels.get(4..).is_none_or(|rest| *rest == self.pixels[..rest.len()])
    }

    /// Returns the same colours without transparency.
    #[must_use]
    pub fn opaque(mut self) -> Self {
        self.pixels.chunks_exact_mut(4).for_each(|pixel| pixel[3] = u8::MAX);
        self
    }

    /// Returns alpha as an opaque grey.
    #[must_use]
    pub fn alpha_as_grey(mut self) -> Self {
        self.pixels.chunks_exact_mut(4).for_each(|pixel| {
            let alpha = pixel[3];
            pixel[..3].fill(alpha);
            pixel[3] = u8::MAX;
        });
        self
    }

    /// Returns the pixels without alpha.
    fn rgb(&self) -> Vec<u8> {
        let mut rgb = vec![0; self.size.pixel_count() * 3];
        for (to, from) in rgb.chunks_exact_mut(3).zip(self.pixels.chunks_exact(4)) {
            to.copy_from_slice(&from[..3]);
        }
        rgb
    }

    fn is_opaque(&self) -> bool {
        self.pixels.chunks_exact(4).all(|pixel| pixel[3] == u8::MAX)
    }

    /// Returns the largest difference of any byte between two pictures of one size, and the number of pixels that differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Option<Difference> {
        if self.size != other.size {
            return None;
        }
        let pairs = self.pixels.chunks_exact(4).zip(other.pixels.chunks_exact(4));
        let largest_of = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        Some(pairs.map(largest_of).fold(Difference { largest: 0, pixels: 0 }, |sum, difference| Difference {
            largest: sum.largest.max(difference),
            pixels: sum.pixels + usize::from(difference > 0),
        }))
    }

    /// Encodes the picture. Opaque pictures are written without an alpha channel unless `keep_alpha`.
    fn encode(&self, format: PictureFormat, keep_alpha: bool, out: &mut impl Write) -> image::ImageResult<()> {
        let has_alpha = keep_alpha || !self.is_opaque();
        let rgb: Vec<u8>;
        let (pixels, color) = if has_alpha && format.has_alpha() {
            (&self.pixels, ExtendedColorType::Rgba8)
        } else {
            rgb = self.rgb();
            (&rgb, ExtendedColorType::Rgb8)
        };
        let Size { width, height } = self.size;
        match format {
            PictureFormat::Png => {
                let (compression, filter) = (png::CompressionType::Fast, png::FilterType::Adaptive);
                png::PngEncoder::new_with_quality(out, compression, filter).write_image(pixels, width, height, color)
            }
            #[cfg(feature = "gltf")]
            PictureFormat::Jpeg => JpegEncoder::new_with_quality(out, 92).write_image(pixels, width, height, color),
            PictureFormat::Bmp => BmpEncoder::new(out).write_image(pixels, width, height, color),
            PictureFormat::Tga => TgaEncoder::new(out).write_image(pixels, width, height, color),
            PictureFormat::Ppm => {
                let subtype = pnm::PnmSubtype::Pixmap(pnm::SampleEncoding::Binary);
                pnm::PnmEncoder::new(out).with_subtype(subtype).write_image(pixels, width, height, color)
            }
        }
    }

    /// Returns the bytes of a file, for PNG with a note in it. The error is the encoder's text.
    fn file(&self, format: PictureFormat, note: Option<&Note>) -> std::result::Result<Vec<u8>, String> {
        match note.filter(|_| format == PictureFormat::Png) {
            Some(Note { keyword, text }) => {
                let is_opaque = self.is_opaque();
                let pixels = if is_opaque { Cow::Owned(self.rgb()) } else { Cow::Borrowed(&self.pixels) };
                png_text::encode(self.size, &pixels, is_opaque, [keyword, text]).map_err(|error| error.to_string())
            }
            None => {
                let mut bytes = Vec::new();
                self.encode(format, false, &mut bytes).map_err(|error| error.to_string())?;
                Ok(bytes)
            }
        }
    }

    /// Returns the bytes of a PNG file, with the note if given: the same as [`Target::write_with`] writes.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a picture of more pixels than the format holds.
    pub fn png_bytes(&self, note: Option<&Note>) -> Result<Vec<u8>> {
        self.file(PictureFormat::Png, note)
            .map_err(|error| Error::output("-", format!("the picture cannot be encoded ({error}); draw a smaller one")))
    }

    /// Writes the picture to a file, in the format of the name's extension. The file is replaced completely or stays unchanged.
    /// [`Target::check`] finds obstacles to writing before the work.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for an unknown extension, a directory, a missing or write-protected folder, a failed write, and for a
    /// picture that is not opaque in a format without transparency.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        Target::of_file(path.as_ref(), !self.is_opaque())?.write(self)
    }

    /// Reads a PNG file, for comparisons.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the path when it is missing or not a picture.
    pub fn read_png(path: &Path) -> Result<Self> {
        let failed = |error: image::ImageError| {
            Error::output(path, format!("it cannot be read as a picture ({error}); draw it again"))
        };
        let image = image::open(path).map_err(failed)?.into_rgba8();
        Ok(Self { size: Size { width: image.width(), height: image.height() }, pixels: image.into_raw() })
    }
}

/// The difference between two pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Difference {
    /// Largest difference of any channel, 0 to 255.
    pub largest: u8,
    /// Pixels that differ in any channel.
    pub pixels: usize,
}

/// The file formats for writing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PictureFormat {
    /// Portable Network Graphics, with alpha if the picture has any.
    Png,
    /// JPEG, quality 92, no alpha.
    #[cfg(feature = "gltf")]
    Jpeg,
    /// Windows bitmap, no alpha.
    Bmp,
    /// Truevision TGA, with alpha if the picture has any.
    Tga,
    /// Portable pixmap, binary, no alpha.
    Ppm,
}

impl PictureFormat {
    const EXTENSIONS: &[(&'static str, Self)] = &[
        ("png", Self::Png),
        #[cfg(feature = "gltf")]
        ("jpg", Self::Jpeg),
        #[cfg(feature = "gltf")]
        ("jpeg", Self::Jpeg),
        ("bmp", Self::Bmp),
        ("tga", Self::Tga),
        ("ppm", Self::Ppm),
    ];

    /// Returns the format of a file's name, by its extension.
    pub(crate) fn of(file: &Path) -> Option<Self> {
        let extension = file.extension()?.to_str()?.to_ascii_lowercase();
        Self::EXTENSIONS.iter().find(|(known, _)| *known == extension).map(|(_, format)| *format)
    }

    fn has_alpha(self) -> bool {
        matches!(self, Self::Png | Self::Tga)
    }
}

/// The destination of a picture, checked before the work and written completely or not at all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// Standard output, as PNG.
    Stdout,
    /// A file.
    File {
        /// As the user named it.
        path: PathBuf,
        /// By its extension.
        format: PictureFormat,
    },
}

impl Target {
    /// Checks that `path` (or `-`) can be written and has a known extension; `transparent` pictures need one with alpha.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for an unknown extension, a directory, a folder that is missing or may not be written.
    pub fn check(path: &str, transparent: bool) -> Result<Self> {
        match path {
            "-" => Ok(Self::Stdout),
            _ => Self::of_file(Path::new(path), transparent),
        }
    }

    /// Checks a file as [`Target::check`] does, whatever its name; `-` is a file here.
    ///
    /// # Errors
    ///
    /// As there.
    pub fn of_file(file: &Path, transparent: bool) -> Result<Self> {
        let refuse = |problem: String| Error::output(file, problem);
        check_name(file)?;
        let known = || PictureFormat::EXTENSIONS.iter().map(|(extension, _)| *extension).collect::<Vec<_>>().join(", ");
        let format = match (PictureFormat::of(file), file.extension()) {
            (Some(format), _) => format,
            (None, Some(extension)) => {
                let extension = extension.to_string_lossy().to_ascii_lowercase();
                return Err(refuse(format!("pictures are not written as .{extension}; use one of {}", known())));
            }
            (None, None) => return Err(refuse(format!("the name has no extension; use one of {}", known()))),
        };
        if transparent && !format.has_alpha() {
            return Err(refuse("this format has no transparency; write .png, or leave out --transparent".to_owned()));
        }
        check_file(file)?;
        Ok(Self::File { path: file.to_owned(), format })
    }

    /// Writes the picture; a file is replaced completely or stays unchanged.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when the disk is full, the folder gone, the pipe closed.
    pub fn write(&self, picture: &Picture) -> Result<()> {
        self.write_with(picture, None)
    }

    /// Writes the picture, as PNG with a note in it; other formats hold no note.
    ///
    /// # Errors
    ///
    /// As [`Target::write`].
    pub fn write_with(&self, picture: &Picture, note: Option<&Note>) -> Result<()> {
        let (name, format) = match self {
            Self::Stdout => ("-".to_owned(), PictureFormat::Png),
            Self::File { path, format } => (path.display().to_string(), *format),
        };
        let bytes = picture.file(format, note).map_err(|error| {
            Error::output(
                name,
                match self {
                    Self::Stdout => format!("the picture cannot be encoded ({error}); name a file"),
                    Self::File { .. } => format!("the picture cannot be encoded ({error}); try .png"),
                },
            )
        })?;
        match self {
            Self::Stdout => write_standard_output(&bytes),
            Self::File { path, .. } => write_whole(path, &bytes),
        }
    }

    /// Writes pictures that belong together: no file appears or changes before all of them are on the disk.
    ///
    /// # Errors
    ///
    /// As [`Target::write`].
    pub fn write_all<'a>(pictures: impl IntoIterator<Item = (&'a Self, &'a Picture)>) -> Result<()> {
        let mut staged = Vec::new();
        for (target, picture) in pictures {
            match target {
                Self::Stdout => target.write(picture)?,
                Self::File { path, format } => {
                    staged.push(StagedContents::new(path, &encoded(path, |out| picture.encode(*format, false, out))?)?);
                }
            }
        }
        staged.into_iter().try_for_each(StagedContents::put_in_place)
    }
}

/// A text stored in a PNG beside its pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// The note's keyword, 1 to 79 letters.
    pub keyword: &'static str,
    /// ASCII.
    pub text: String,
}

/// Writes a picture as RGBA PNG whatever its alpha: GL's bytes, unchanged.
///
/// # Errors
///
/// [`Error::File`] when the file cannot be written.
pub fn write_rgba_png(picture: &Picture, path: &Path) -> Result<()> {
    write_whole(path, &encoded(path, |out| picture.encode(PictureFormat::Png, true, out))?)
}

/// Encodes a picture's file in memory.
fn encoded(path: &Path, encode: impl FnOnce(&mut Vec<u8>) -> image::ImageResult<()>) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    encode(&mut bytes)
        .map_err(|error| Error::output(path, format!("the picture cannot be encoded ({error}); try .png")))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        let size = Size { width: 3, height: 2 };
        Picture { size, pixels: (0..24).collect() }
    }

    #[test]
    fn a_picture_written_as_png_is_read_back_byte_for_byte() {
        let folder = tempfile::tempdir().unwrap();
        for (name, picture) in [("alpha.png", picture()), ("opaque.png", picture().opaque())] {
            let path = folder.path().join(name);
            Target::check(path.to_str().unwrap(), false).unwrap().write(&picture).unwrap();
            assert_eq!(Picture::read_png(&path).unwrap(), picture);
        }
    }

    #[test]
    fn a_note_changes_nothing_but_its_own_chunk() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, note: Option<&Note>, picture: &Picture| {
            let path = folder.path().join(name);
            Target::check(path.to_str().unwrap(), false).unwrap().write_with(picture, note).unwrap();
            std::fs::read(path).unwrap()
        };
        let note = Note { keyword: "word", text: "{}".to_owned() };
        // Length, type, keyword, a zero, text, checksum.
        let length = 4 + 4 + 4 + 1 + 2 + 4;
        for picture in [picture(), picture().opaque()] {
            let (plain, noted) = (file("a.png", None, &picture), file("b.png", Some(&note), &picture));
            assert_eq!(noted.len(), plain.len() + length);
            let start = noted.windows(4).position(|word| word == b"tEXt").unwrap() - 4;
            assert_eq!([&noted[..start], &noted[start + length..]].concat(), plain);
            for name in ["a.bmp", "a.jpg", "a.tga", "a.ppm"] {
                assert_eq!(file(name, Some(&note), &picture), file(name, None, &picture), "{name}");
            }
        }
    }

    #[test]
    fn differences_are_counted() {
        let mut other = picture();
        other.pixels[5] += 7;
        other.pixels[6] -= 1;
        assert_eq!(picture().difference(&other), Some(Difference { largest: 7, pixels: 1 }));
        assert_eq!(picture().difference(&picture()), Some(Difference { largest: 0, pixels: 0 }));
    }

    #[test]
    fn every_format_is_written_and_nothing_else_is_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        for (extension, _) in PictureFormat::EXTENSIONS {
            let path = folder.path().join(format!("picture.{extension}"));
            Target::check(path.to_str().unwrap(), false).unwrap().write(&picture().opaque()).unwrap();
            let read = image::open(&path).unwrap();
            assert_eq!((read.width(), read.height()), (3, 2), "{extension}");
        }
        let files = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(files, PictureFormat::EXTENSIONS.len());
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_permissions_and_links_stay_links() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("old.png"), "old").unwrap();
        std::fs::set_permissions(at("old.png"), std::fs::Permissions::from_mode(0o600)).unwrap();
        symlink("old.png", at("link.png")).unwrap();
        Target::check(at("link.png").to_str().unwrap(), false).unwrap().write(&picture()).unwrap();
        assert_eq!(Picture::read_png(&at("old.png")).unwrap(), picture());
        assert_eq!(at("old.png").metadata().unwrap().permissions().mode() & 0o777, 0o600);
        assert!(at("link.png").symlink_metadata().unwrap().is_symlink());
        symlink("nowhere", at("broken.png")).unwrap();
        symlink("/dev/null", at("device.png")).unwrap();
        for name in ["broken.png", "device.png"] {
            let message = Target::check(at(name).to_str().unwrap(), false).unwrap_err().to_string();
            assert!(message.contains("not a regular file"), "{message}");
        }
    }

    #[test]
    fn what_cannot_be_written_is_refused_before_any_work() {
        let message = |path: &str, transparent| Target::check(path, transparent).unwrap_err().to_string();
        assert!(message("drawing.xyz", false).contains("not written as .xyz"));
        assert!(message("drawing", false).contains("no extension"));
        assert!(message("drawing.jpg", true).contains("no transparency"));
        assert!(message("no/such/folder/a.png", false).contains("folder no/such/folder does not exist"));
        let see_through = Picture { size: Size { width: 1, height: 1 }, pixels: vec![0; 4] };
        assert!(see_through.save("drawing.jpg").unwrap_err().to_string().contains("no transparency"));
        assert!(see_through.save("-").unwrap_err().to_string().contains("no extension"));
        let folder = tempfile::Builder::new().suffix(".png").tempdir().unwrap();
        assert!(message(folder.path().to_str().unwrap(), false).contains("directory"));
    }
}
