//! The parts of a zip file, stored or deflated, of any length.

use crate::bytes::Bytes;
use crate::files::shown;
use crate::limits::{MEMORY_SLACK_BYTES, UNPACKED_FACTOR};
use crate::memory;
use flate2::read::DeflateDecoder;
use memchr::memmem::rfind;
use std::collections::HashMap;
use std::io::Read;

/// A zip file.
pub(super) struct Zip<'a> {
    file: &'a [u8],
    /// The parts by their names in small letters: how each is packed, how long it is, how long in the file, and where.
    parts: HashMap<String, (u16, [u64; 3])>,
    /// How many bytes have been unpacked.
    pub unpacked: u64,
}

impl<'a> Zip<'a> {
    /// Reads the list of a file's parts, which lies at its end.
    pub(super) fn open(file: &'a [u8]) -> Option<Self> {
        let end = rfind(file, b"PK\x05\x06")?;
        let number = |place: usize| Bytes(file.get(place..)?).u32();
        let start = match number(end + 16)? {
            u32::MAX => number(rfind(&file[..end], b"PK\x06\x06")? + 48)?,
            start => start,
        };
        let (mut list, mut parts) = (Bytes(file.get(start as usize..end)?), HashMap::new());
        while list.take(4) == Some(b"PK\x01\x02") {
            let (_, flags, method, _) = (list.u32()?, list.u16()?, list.u16()?, list.take(8)?);
            let (packed, size) = (list.u32()?, list.u32()?);
            let [name, fields, comment] = [list.u16()?, list.u16()?, list.u16()?].map(usize::from);
            list.take(8)?;
            let mut numbers = [size, packed, list.u32()?].map(u64::from);
            let name = String::from_utf8_lossy(list.take(name)?).to_ascii_lowercase();
            let mut fields = Bytes(list.take(fields)?);
            list.take(comment)?;
            while let (Some(id), Some(length)) = (fields.u16(), fields.u16()) {
                let mut field = Bytes(fields.take(length.into())?);
                // Zip64: the numbers that have no room above.
                for number in numbers.iter_mut().filter(|number| id == 1 && **number == u64::from(u32::MAX)) {
                    *number = u64::from(field.u32()?) | u64::from(field.u32()?) << 32;
                }
            }
            // An encrypted part's method has its highest bit set.
            parts.insert(name, (method | flags << 15, numbers));
        }
        Some(Self { file, parts, unpacked: 0 })
    }

    /// Unpacks a part. The error is a sentence without the file's name.
    pub(super) fn part(&mut self, name: &str) -> Result<Vec<u8>, String> {
        let refused = |why: &str| format!("its part {} {why}", shown(name));
        let found = self.parts.get(&name.to_ascii_lowercase());
        let (method, [size, packed, at]) = *found.ok_or_else(|| refused("is missing; export it again"))?;
        if method != 0 && method != 8 {
            return Err(refused("is encrypted, or packed otherwise than by deflate; save it without that"));
        }
        self.unpacked = self.unpacked.saturating_add(size.max(packed));
        let most = (self.file.len() as u64).saturating_mul(UNPACKED_FACTOR as u64);
        if self.unpacked > most.saturating_add(MEMORY_SLACK_BYTES as u64) {
            return Err(refused("unpacks to far more than models do; export it again"));
        }
        memory::refusal(2 * self.unpacked, memory::free()).map_or(Ok(()), Err)?;
        let unpacked = || {
            let mut rest = Bytes(self.file.get(usize::try_from(at).ok()?..)?);
            rest.take(26)?;
            let names = usize::from(rest.u16()?) + usize::from(rest.u16()?);
            let (_, packed, mut bytes) = (rest.take(names)?, rest.take(usize::try_from(packed).ok()?)?, Vec::new());
            match method {
                0 => bytes.extend(packed),
                _ => _ = DeflateDecoder::new(packed).take(size + 1).read_to_end(&mut bytes).ok()?,
            }
            (bytes.len() as u64 == size).then_some(bytes)
        };
        unpacked().ok_or_else(|| refused("is damaged or cut off; export it again"))
    }
}
