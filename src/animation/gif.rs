//! Animated GIF, looping. Only this module uses the gif crate. The image crate's encoder quantizes every picture separately,
//! which would make tones flicker.
//!
//! GIF has no half-transparent pixels. A pixel with at least half its alpha is kept, opaque, in its own straight colour; the
//! others are dropped. So ink stays ink up to its edge on any background, without a white or black fringe. Edges are hard; APNG
//! keeps them soft.

use super::changes::Rectangle;
use super::palette::{Palette, TRANSPARENT};
use crate::picture::Picture;
use crate::scene::Size;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;

/// The least alpha of a pixel that is kept.
const KEPT: u8 = 128;

pub(super) struct GifEncoder {
    encoder: Encoder<Vec<u8>>,
    size: Size,
    transparent: bool,
    delay_ms: u16,
    frames: u64,
    palette: Palette,
    before: Vec<u8>,
}

type GifResult<T> = std::result::Result<T, String>;

fn in_words(error: EncodingError) -> String {
    format!("the animation cannot be encoded ({error}); write .apng or numbered pictures")
}

impl GifEncoder {
    pub(super) fn new(size: Size, transparent: bool, delay_ms: u16) -> GifResult<Self> {
        let [width, height] = [size.width, size.height].map(|side| side as u16);
        let mut encoder = Encoder::new(Vec::new(), width, height, &[]).map_err(in_words)?;
        encoder.set_repeat(Repeat::Infinite).map_err(in_words)?;
        let palette = Palette::new(transparent);
        Ok(Self { encoder, size, transparent, delay_ms, frames: 0, palette, before: vec![] })
    }

    /// Stores the changes since the previous picture, or the whole visible picture if new holes appear.
    pub(super) fn add(&mut self, picture: Picture) -> GifResult<()> {
        let picture = if self.transparent { with_hard_edges(picture) } else { picture.opaque() };
        self.palette.fit(&picture.pixels);
        let part = if self.transparent {
            Rectangle::around(self.size, |index| picture.pixels[index * 4 + 3] > 0)
        } else if self.before.is_empty() {
            Rectangle::whole(self.size)
        } else {
            Rectangle::changed(self.size, &self.before, &picture.pixels)
        };
        let mut buffer = Vec::with_capacity(part.size.pixel_count());
        for (y, row) in (part.top..).zip(part.rows(self.size.width)) {
            let pixels = picture.pixels[row.start * 4..row.end * 4].chunks_exact(4);
            self.palette.map_row(pixels, part.left, y, &mut buffer);
        }
        let frame = Frame {
            delay: self.next_delay(),
            dispose: if self.transparent { DisposalMethod::Background } else { DisposalMethod::Keep },
            transparent: self.transparent.then_some(TRANSPARENT),
            left: part.left as u16,
            top: part.top as u16,
            width: part.size.width as u16,
            height: part.size.height as u16,
            palette: Some(self.palette.bytes()),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        };
        self.before = picture.pixels;
        self.encoder.write_frame(&frame).map_err(in_words)
    }

    /// Returns the delay in hundredths of a second; all delays together keep the total duration.
    fn next_delay(&mut self) -> u16 {
        let hundredths = |frames: u64| (frames * u64::from(self.delay_ms) + 5) / 10;
        let delay = hundredths(self.frames + 1) - hundredths(self.frames);
        self.frames += 1;
        delay as u16
    }

    pub(super) fn finish(self) -> GifResult<Vec<u8>> {
        self.encoder.into_inner().map_err(in_words)
    }
}

/// Makes every pixel opaque in its own colour or fully transparent.
fn with_hard_edges(mut picture: Picture) -> Picture {
    for pixel in picture.pixels.chunks_exact_mut(4) {
        if pixel[3] < KEPT {
            pixel.fill(0);
        } else {
            pixel[3] = u8::MAX;
        }
    }
    picture
}
