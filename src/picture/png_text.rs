//! Writes and reads PNG files with a text in them, which the image crate cannot do.

use crate::values::Size;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

/// Memory limit for reading a text, bytes.
const LARGEST_BYTES: usize = 4 << 20;

/// Encodes with the image crate's settings used elsewhere, and adds a `tEXt` chunk; `text` is ASCII. Opaque pixels have three
/// bytes, others four.
pub(super) fn encode(
    Size { width, height }: Size,
    pixels: &[u8],
    is_opaque: bool,
    [keyword, text]: [&str; 2],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(if is_opaque { ColorType::Rgb } else { ColorType::Rgba });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    encoder.add_text_chunk(keyword.to_owned(), text.to_owned())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// Whether a file begins like PNG.
pub(crate) fn is_png(head: &[u8]) -> bool {
    head.starts_with(b"\x89PNG\r\n\x1a\n")
}

/// Returns the `tEXt` chunk of this keyword, if it precedes the pixels; the error is a sentence without the file's name.
pub(crate) fn find(head: &[u8], keyword: &str) -> Result<Option<String>, String> {
    use png::{Decoder, Limits};
    let decoder = Decoder::new_with_limits(std::io::Cursor::new(head), Limits { bytes: LARGEST_BYTES });
    let reader = decoder.read_info().map_err(|error| format!("the PNG is damaged ({error}); draw it again"))?;
    let texts = &reader.info().uncompressed_latin1_text;
    Ok(texts.iter().find(|text| text.keyword == keyword).map(|text| text.text.clone()))
}
