//! PCX pictures from games and paint programs of the nineties: 256 colours with the palette at the end, or 24 bits in three
//! planes; run-length coded. The reader is our own, over [`Bytes`].

use super::Picture;
use super::size::check_size;
use crate::bytes::Bytes;
use crate::values::Size;

const HEADER_BYTES: usize = 128;
/// A marker byte and 256 colours.
const PALETTE_BYTES: usize = 1 + 256 * 3;
const PALETTE_MARK: u8 = 12;
const MANUFACTURER: u8 = 10;
/// Bytes from this value up are counts: the lower six bits say how often the next byte repeats.
const RUN: u8 = 0xc0;

const CUT_OFF: &str = "it is cut off or damaged; save it again";

/// Whether a file begins like PCX: the maker's number, an existing version, and the coding flag.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    matches!(bytes, [MANUFACTURER, 0 | 2 | 3 | 4 | 5, 0 | 1, 1 | 2 | 4 | 8, ..])
}

/// Reads a PCX file's bytes into at most `most` bytes of pixels; the error is a sentence without the file's name.
pub(super) fn read(bytes: &[u8], most: u64) -> Result<Picture, String> {
    if !looks_like(bytes) {
        return Err("it does not begin like a PCX picture; it is damaged or misnamed, save it again".to_owned());
    }
    let mut header = Bytes(bytes);
    let header = header.take(HEADER_BYTES).zip(Some(header.0)).and_then(|(head, data)| Header::read(head, data));
    let header = header.ok_or(CUT_OFF)?;
    let size = header.size()?;
    check_size(size, bytes.len(), most)?;
    let Size { width, height } = size;
    let (data, palette) = match (header.bits, header.planes) {
        (8, 1) => {
            let split = header.data.len().checked_sub(PALETTE_BYTES).and_then(|end| header.data.split_at_checked(end));
            match split {
                Some((data, [PALETTE_MARK, palette @ ..])) => (data, Some(palette)),
                _ => return Err("its palette of 256 colours is not at its end; save it again".to_owned()),
            }
        }
        (8, 3) => (header.data, None),
        (bits, planes) => {
            let problem = format!("{planes} planes of {bits} bits are not read; save it with 256 colours or 24 bits");
            return Err(problem);
        }
    };
    let line_bytes = usize::from(header.line_bytes);
    if line_bytes < width as usize {
        return Err(format!("its lines have {line_bytes} bytes for {width} pixels; it is damaged, save it again"));
    }
    let row_bytes = line_bytes * usize::from(header.planes);
    let rows = if header.coded { decode(data, row_bytes * height as usize) } else { Some(data.to_vec()) };
    let rows = rows.filter(|rows| rows.len() >= row_bytes * height as usize).ok_or(CUT_OFF)?;
    let mut pixels = Vec::with_capacity(width as usize * height as usize * 4);
    for row in rows.chunks_exact(row_bytes).take(height as usize) {
        for x in 0..width as usize {
            let [red, green, blue] = match palette {
                Some(palette) => [0, 1, 2].map(|channel| palette[usize::from(row[x]) * 3 + channel]),
                None => [0, 1, 2].map(|plane| row[plane * line_bytes + x]),
            };
            pixels.extend([red, green, blue, u8::MAX]);
        }
    }
    Ok(Picture { size: Size { width, height }, pixels })
}

struct Header<'a> {
    coded: bool,
    bits: u8,
    /// Left, top, right and bottom pixel, inclusive.
    window: [u16; 4],
    planes: u8,
    line_bytes: u16,
    /// The data after the header.
    data: &'a [u8],
}

impl<'a> Header<'a> {
    fn read(head: &[u8], data: &'a [u8]) -> Option<Self> {
        let mut head = Bytes(head);
        head.take(2)?;
        let (coded, bits) = (head.u8()? == 1, head.u8()?);
        let window = [head.u16()?, head.u16()?, head.u16()?, head.u16()?];
        // Dots per inch, a palette of 16 colours, a reserved byte.
        head.take(2 * 2 + 16 * 3 + 1)?;
        Some(Self { coded, bits, window, planes: head.u8()?, line_bytes: head.u16()?, data })
    }

    fn size(&self) -> Result<Size, String> {
        let [left, top, right, bottom] = self.window.map(u32::from);
        if right < left || bottom < top {
            return Err("its right or lower side lies before the other; it is damaged, save it again".to_owned());
        }
        Ok(Size { width: right - left + 1, height: bottom - top + 1 })
    }
}

/// Undoes the run-length coding up to `count` bytes; `None` if there are fewer.
fn decode(data: &[u8], count: usize) -> Option<Vec<u8>> {
    // Two bytes decode to at most 63, which stops a header from requesting more memory than its file justifies.
    if count > data.len().saturating_mul(32) {
        return None;
    }
    let mut rows = Vec::with_capacity(count);
    let mut data = data.iter().copied();
    while rows.len() < count {
        let byte = data.next()?;
        if byte < RUN {
            rows.push(byte);
        } else {
            let length = usize::from(byte - RUN).min(count - rows.len());
            rows.extend(std::iter::repeat_n(data.next()?, length));
        }
    }
    Some(rows)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    fn header(width: u16, height: u16, planes: u8, line_bytes: u16) -> Vec<u8> {
        let mut bytes = vec![MANUFACTURER, 5, 1, 8];
        // The picture need not begin at 0.
        [7, 9, width + 6, height + 8, 300, 300].iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        bytes.extend([0; 49]);
        bytes.push(planes);
        bytes.extend(line_bytes.to_le_bytes());
        bytes.resize(HEADER_BYTES, 0);
        bytes
    }

    /// Three pixels by two with 256 colours; colour n is (n, 255 - n, 1). A run crosses the end of the first line.
    pub(crate) fn with_palette() -> Vec<u8> {
        let mut bytes = header(3, 2, 1, 4);
        bytes.extend([3, RUN + 1, 0xfe, RUN + 4, 5, 0, RUN + 9, 8]);
        bytes.push(PALETTE_MARK);
        (0..=255).for_each(|color| bytes.extend([color, 255 - color, 1]));
        bytes
    }

    /// Two pixels by two in three planes.
    fn with_planes() -> Vec<u8> {
        let mut bytes = header(2, 2, 3, 2);
        bytes.extend([1, 2, 3, 4, 5, 6, RUN + 6, 200]);
        bytes
    }

    #[test]
    fn palette_pictures_are_read() {
        let picture = read(&with_palette(), u64::MAX).unwrap();
        assert_eq!(picture.size, Size { width: 3, height: 2 });
        let reds: Vec<u8> = picture.pixels.chunks_exact(4).map(|pixel| pixel[0]).collect();
        assert_eq!(reds, [3, 0xfe, 5, 5, 5, 0]);
        assert_eq!(picture.pixel(1, 0), [0xfe, 1, 1, 255]);
    }

    #[test]
    fn pictures_in_three_planes_are_read() {
        let picture = read(&with_planes(), u64::MAX).unwrap();
        assert_eq!(picture.pixels, [1, 3, 5, 255, 2, 4, 6, 255, 200, 200, 200, 255, 200, 200, 200, 255]);
    }

    #[test]
    fn pictures_without_coding_are_read() {
        let mut bytes = header(2, 1, 3, 2);
        bytes[2] = 0;
        bytes.extend([0xff, 2, 3, 4, 5, 6]);
        assert_eq!(read(&bytes, u64::MAX).unwrap().pixel(0, 0), [0xff, 3, 5, 255]);
    }

    #[test]
    fn what_is_not_read_is_explained() {
        let with = |place: usize, byte: u8| {
            let mut bytes = with_palette();
            bytes[place] = byte;
            read(&bytes, u64::MAX).unwrap_err()
        };
        assert!(with(3, 1).contains("1 planes of 1 bits are not read"));
        assert!(with(66, 2).contains("2 bytes for 3 pixels"));
        assert!(with(9, 0xff).contains("16384"));
        assert!(with(8, 0).contains("right or lower side"));
        assert!(with(11, 0x20).contains("cut off"));
        assert!(read(b"GIF89a", u64::MAX).unwrap_err().contains("does not begin like a PCX"));
    }

    #[test]
    fn every_truncation_is_refused_and_no_changed_byte_panics() {
        for whole in [with_palette(), with_planes()] {
            for length in 0..whole.len() {
                assert!(read(&whole[..length], u64::MAX).is_err(), "{length}");
            }
            for place in 0..whole.len() {
                for byte in [0, 0xff] {
                    let mut bytes = whole.clone();
                    bytes[place] = byte;
                    let _ = read(&bytes, u64::MAX);
                }
            }
        }
    }
}
