//! Writes a sequence of pictures as an animation: GIF, APNG or numbered picture files.
//!
//! In: a name, checked before the work, a delay, and finished [`Picture`]s one by one. Out: files that appear whole or not
//! at all. A second thread encodes each picture while the caller draws the next.
//!
//! GIF and APNG are put together in memory and written when the last picture is in. A file growing on the disk would
//! need less memory, but would be left behind, half, when the program is interrupted.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::{AnimationTarget, AnimationWriter, Picture, Size};
//!
//! let folder = tempfile::tempdir().expect("a folder");
//! let name = folder.path().join("two.gif").display().to_string();
//! let mut writer = AnimationWriter::new(AnimationTarget::check(&name, false)?, 2, 100)?;
//! let size = Size { width: 4, height: 4 };
//! for grey in [0, 255] {
//!     writer.add(Picture { size, pixels: [grey, grey, grey, 255].repeat(16) })?;
//! }
//! writer.finish()?;
//! assert!(std::fs::read(name).expect("the file").starts_with(b"GIF89a"));
//! # Ok(())
//! # }
//! ```

mod apng;
mod changes;
mod gif;
mod numbered;
mod palette;
mod quantize;

pub use numbered::NumberedName;

use crate::clock::Instant;
use crate::error::{Error, Result};
use crate::output::{check_file, write_whole};
use crate::picture::{Picture, Target};
use crate::renderer::milliseconds_since;
use crate::scene::Size;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

/// The destination of an animation, checked before the work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnimationTarget {
    name: String,
    format: AnimationFormat,
    transparent: bool,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum AnimationFormat {
    Gif(PathBuf),
    Apng(PathBuf),
    Numbered(NumberedName),
}

/// Most pictures that wait for the encoder, which keeps drawing from running far ahead.
const WAITING: usize = 4;

/// The longest side of a GIF, pixels: the format counts in 16 bits.
const LARGEST_GIF_SIDE_PX: u32 = 65_535;

impl AnimationTarget {
    /// Whether a name always means an animation: `.gif`, `.apng`, or a numbered name such as `frame-%04d.png`.
    pub fn is_meant_by(name: &str) -> bool {
        matches!(extension(Path::new(name)).as_str(), "gif" | "apng") || NumberedName::parse(name).is_some()
    }

    /// Checks that an animation can be written under `name`; with `transparent` the pictures' alpha is kept.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a name that means a single picture, and for whatever [`Target::check`] refuses.
    pub fn check(name: &str, transparent: bool) -> Result<Self> {
        let path = PathBuf::from(name);
        let format = if let Some(numbered) = NumberedName::parse(name) {
            Target::check(&numbered.with(1), transparent)?;
            AnimationFormat::Numbered(numbered)
        } else {
            let format: fn(PathBuf) -> AnimationFormat = match extension(&path).as_str() {
                "gif" => AnimationFormat::Gif,
                "apng" => AnimationFormat::Apng,
                _ => {
                    return Err(Error::output(
                        name,
                        "this names one picture; an animation is a .gif or .apng file, or has numbered names \
                                  such as frame-%04d.png",
                    ));
                }
            };
            check_file(&path)?;
            format(path)
        };
        Ok(Self { name: name.to_owned(), format, transparent })
    }

    fn error(&self, problem: String) -> Error {
        Error::output(self.name.clone(), problem)
    }
}

fn extension(path: &Path) -> String {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Takes the pictures of an animation. If dropped before the last one, it leaves no GIF or APNG.
#[derive(Debug)]
pub struct AnimationWriter {
    target: AnimationTarget,
    frames: u32,
    added: u32,
    pictures: Option<SyncSender<Picture>>,
    worker: Option<JoinHandle<Result<AnimationCost>>>,
}

/// The finished animation's numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimationCost {
    /// Time to encode each picture, milliseconds, on a separate thread during the drawing.
    pub encode_ms: Vec<f64>,
    /// Size of the file, or of all numbered ones together.
    pub bytes: u64,
}

impl AnimationWriter {
    /// Begins an animation of `frames` pictures, each shown for `delay_ms` milliseconds, in an endless loop.
    ///
    /// GIF counts hundredths of a second, so its delays may differ by one to keep the total duration.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for zero frames, or if the encoder's thread cannot start.
    pub fn new(target: AnimationTarget, frames: u32, delay_ms: u16) -> Result<Self> {
        if frames == 0 {
            return Err(target.error("an animation has at least one picture; ask for more".to_owned()));
        }
        let (pictures, received) = sync_channel(WAITING);
        let to = target.clone();
        let worker = std::thread::Builder::new()
            .name("encoder".to_owned())
            .spawn(move || write(&to, &received, frames, delay_ms))
            .map_err(|error| {
                target.error(format!("no thread to encode on could be started ({error}); close other programs"))
            })?;
        Ok(Self { target, frames, added: 0, pictures: Some(pictures), worker: Some(worker) })
    }

    /// Passes the next picture to the encoder; waits while the encoder is several behind.
    ///
    /// # Errors
    ///
    /// [`Error::File`] for one picture too many, or for the encoder's error, such as a full disk or a picture of another size;
    /// the animation is then over.
    pub fn add(&mut self, picture: Picture) -> Result<()> {
        if self.added == self.frames {
            return Err(self.target.error(format!("more pictures came than the {} announced", self.frames)));
        }
        self.added += 1;
        if self.pictures.as_ref().is_some_and(|pictures| pictures.send(picture).is_ok()) {
            return Ok(());
        }
        self.join().map(drop)
    }

    /// Waits for the encoder and writes the file.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when pictures are missing, cannot be encoded or cannot be written.
    pub fn finish(mut self) -> Result<AnimationCost> {
        self.join()
    }

    fn join(&mut self) -> Result<AnimationCost> {
        self.pictures = None;
        match self.worker.take().map(JoinHandle::join) {
            Some(Ok(written)) => written,
            Some(Err(panic)) => std::panic::resume_unwind(panic),
            None => Err(self.target.error("the animation has failed before".to_owned())),
        }
    }
}

enum Encoder {
    Gif(gif::GifEncoder),
    Apng(Box<apng::ApngEncoder>),
    Numbered { name: NumberedName, transparent: bool, count: u32, bytes: u64 },
}

impl Encoder {
    fn new(target: &AnimationTarget, size: Size, frames: u32, delay_ms: u16) -> std::result::Result<Self, String> {
        let transparent = target.transparent;
        match &target.format {
            AnimationFormat::Gif(_) if size.width.max(size.height) > LARGEST_GIF_SIDE_PX => Err(format!(
                "a GIF has at most {LARGEST_GIF_SIDE_PX} pixels on a side; write .apng, or a smaller picture"
            )),
            AnimationFormat::Gif(_) => gif::GifEncoder::new(size, transparent, delay_ms).map(Self::Gif),
            AnimationFormat::Apng(_) => {
                apng::ApngEncoder::new(size, transparent, frames, delay_ms).map(Box::new).map(Self::Apng)
            }
            AnimationFormat::Numbered(name) => {
                Ok(Self::Numbered { name: name.clone(), transparent, count: 0, bytes: 0 })
            }
        }
    }

    fn add(&mut self, target: &AnimationTarget, picture: Picture) -> Result<()> {
        match self {
            Self::Gif(encoder) => encoder.add(picture).map_err(|problem| target.error(problem)),
            Self::Apng(encoder) => encoder.add(picture).map_err(|problem| target.error(problem)),
            Self::Numbered { name, transparent, count, bytes } => {
                *count += 1;
                let path = name.with(*count);
                let picture = if *transparent { picture } else { picture.opaque() };
                Target::check(&path, *transparent)?.write(&picture)?;
                *bytes += Path::new(&path).metadata().map_or(0, |metadata| metadata.len());
                Ok(())
            }
        }
    }

    fn finish(self, target: &AnimationTarget) -> Result<u64> {
        let (bytes, path) = match (self, &target.format) {
            (Self::Numbered { bytes, .. }, _) => return Ok(bytes),
            (Self::Gif(encoder), AnimationFormat::Gif(path)) => (encoder.finish(), path),
            (Self::Apng(encoder), AnimationFormat::Apng(path)) => (encoder.finish(), path),
            // Encoders exist only for their own target.
            (Self::Gif(_) | Self::Apng(_), _) => return Ok(0),
        };
        let bytes = bytes.map_err(|problem| target.error(problem))?;
        write_whole(path, &bytes)?;
        Ok(bytes.len() as u64)
    }
}

/// The encoder's thread: it writes the file only after all pictures have come.
fn write(target: &AnimationTarget, pictures: &Receiver<Picture>, frames: u32, delay_ms: u16) -> Result<AnimationCost> {
    let mut encode_ms = Vec::new();
    let mut encoder: Option<(Size, Encoder)> = None;
    for picture in pictures.iter().take(frames as usize) {
        let start = Instant::now();
        let (size, encoder) = match &mut encoder {
            Some(encoder) => encoder,
            None => {
                let size = picture.size;
                let made = Encoder::new(target, size, frames, delay_ms).map_err(|problem| target.error(problem))?;
                encoder.insert((size, made))
            }
        };
        if picture.size != *size {
            return Err(target.error(format!("a picture of {} follows one of {size}; give all one size", picture.size)));
        }
        encoder.add(target, picture)?;
        encode_ms.push(milliseconds_since(start));
    }
    match encoder {
        Some((_, encoder)) if encode_ms.len() == frames as usize => {
            Ok(AnimationCost { encode_ms, bytes: encoder.finish(target)? })
        }
        _ => Err(target.error(format!("only {} of {frames} pictures came; it was not written", encode_ms.len()))),
    }
}
