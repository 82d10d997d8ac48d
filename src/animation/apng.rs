//! Animated PNG: lossless, with alpha. Only this module and `src/picture/png_text.rs` use the png crate; the image crate cannot
//! write APNG.

use super::changes::Rectangle;
use crate::picture::Picture;
use crate::scene::Size;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, Filter, Writer};
use std::io::{Result, Write};
use std::sync::{Arc, Mutex, PoisonError};

pub(super) struct ApngEncoder {
    writer: Writer<SharedBytes>,
    file: SharedBytes,
    size: Size,
    transparent: bool,
    before: Vec<u8>,
}

/// The file in progress, kept here because the writer does not return its own.
#[derive(Clone, Default)]
struct SharedBytes(Arc<Mutex<Vec<u8>>>);

impl Write for SharedBytes {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        Ok(())
    }
}

type ApngResult<T> = std::result::Result<T, String>;

fn in_words(error: png::EncodingError) -> String {
    format!("the animation cannot be encoded ({error}); write .gif or numbered pictures")
}

impl ApngEncoder {
    pub(super) fn new(size: Size, transparent: bool, frames: u32, delay_ms: u16) -> ApngResult<Self> {
        let file = SharedBytes::default();
        let writer = || {
            let mut encoder = Encoder::new(file.clone(), size.width, size.height);
            encoder.set_color(if transparent { ColorType::Rgba } else { ColorType::Rgb });
            encoder.set_depth(BitDepth::Eight);
            encoder.set_compression(Compression::Fast);
            encoder.set_filter(Filter::Adaptive);
            encoder.set_animated(frames, 0)?;
            encoder.set_frame_delay(delay_ms, 1000)?;
            encoder.set_blend_op(BlendOp::Source)?;
            encoder.set_dispose_op(DisposeOp::None)?;
            encoder.write_header()
        };
        Ok(Self { writer: writer().map_err(in_words)?, file, size, transparent, before: Vec::new() })
    }

    /// Stores the changes since the previous picture.
    pub(super) fn add(&mut self, picture: Picture) -> ApngResult<()> {
        let picture = if self.transparent { picture } else { picture.opaque() };
        let part = if self.before.is_empty() {
            Rectangle::whole(self.size)
        } else {
            Rectangle::changed(self.size, &self.before, &picture.pixels)
        };
        let channels = if self.transparent { 4 } else { 3 };
        let mut data = Vec::with_capacity(part.size.pixel_count() * channels);
        for row in part.rows(self.size.width) {
            let pixels = picture.pixels[row.start * 4..row.end * 4].chunks_exact(4);
            pixels.for_each(|pixel| data.extend_from_slice(&pixel[..channels]));
        }
        self.before = picture.pixels;
        let writer = &mut self.writer;
        let mut write = || {
            // To the corner first, because sizes are checked against the place, and places against the size.
            writer.reset_frame_position()?;
            writer.set_frame_dimension(part.size.width, part.size.height)?;
            writer.set_frame_position(part.left, part.top)?;
            writer.write_image_data(&data)
        };
        write().map_err(in_words)
    }

    pub(super) fn finish(self) -> ApngResult<Vec<u8>> {
        self.writer.finish().map_err(in_words)?;
        Ok(std::mem::take(&mut *self.file.0.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}
