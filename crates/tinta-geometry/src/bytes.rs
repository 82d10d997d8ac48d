//! Little-endian numbers and names out of a binary file, one after the other: where our own readers touch bytes.
//!
//! Nothing here panics or allocates by a file's own count: where the bytes end there is `None`, for the reader to explain.

/// The rest of a file or of a part of it.
#[derive(Debug, Clone, Copy)]
pub struct Bytes<'a>(pub &'a [u8]);

impl<'a> Bytes<'a> {
    /// The next `count` bytes.
    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    /// The next `count` records of `size` bytes each; `size` is not 0.
    pub(crate) fn records(&mut self, count: usize, size: usize) -> Option<std::slice::ChunksExact<'a, u8>> {
        Some(self.take(count.checked_mul(size)?)?.chunks_exact(size))
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*taken)
    }

    pub fn u8(&mut self) -> Option<u8> {
        self.array().map(u8::from_le_bytes)
    }

    pub fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub(crate) fn i16(&mut self) -> Option<i16> {
        self.array().map(i16::from_le_bytes)
    }

    pub fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Option<f32> {
        self.array().map(f32::from_le_bytes)
    }

    /// `N` floats.
    pub(crate) fn floats<const N: usize>(&mut self) -> Option<[f32; N]> {
        let mut floats = [0.0; N];
        for float in &mut floats {
            *float = self.f32()?;
        }
        Some(floats)
    }

    /// A text that ends with a zero byte.
    pub(crate) fn text(&mut self) -> Option<String> {
        let length = self.0.iter().position(|byte| *byte == 0)?;
        let text = name(self.take(length)?);
        self.take(1)?;
        Some(text)
    }
}

/// A name in a field of fixed length: up to the first zero byte; invalid UTF-8 is replaced.
pub(crate) fn name(field: &[u8]) -> String {
    let text = field.split(|byte| *byte == 0).next().unwrap_or_default();
    String::from_utf8_lossy(text).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_follow_each_other_and_end_with_the_bytes() {
        let mut bytes = Bytes(b"\x01\x02\x03\xff\xffskin\0\x00\x00\x80\x3f\x07");
        assert_eq!((bytes.u8(), bytes.u16(), bytes.i16()), (Some(1), Some(0x0302), Some(-1)));
        assert_eq!(bytes.text().as_deref(), Some("skin"));
        assert_eq!(bytes.floats::<1>(), Some([1.0]));
        assert_eq!((bytes.u16(), bytes.u8(), bytes.u8()), (None, Some(7), None));
        assert!(bytes.text().is_none() && bytes.records(usize::MAX, 2).is_none());
    }
}
