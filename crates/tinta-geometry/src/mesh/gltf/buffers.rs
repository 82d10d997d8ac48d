//! A glTF file's data: in GLB behind the JSON, in the JSON itself, or in files of its folder.

use super::extensions::refuse_compressed;
use super::uri::{self, Uri};
use crate::files::{Failure, shown};
use crate::limits::MODEL_BYTES;
use crate::mesh::folder::Folder;
use crate::mesh::skin;
use gltf_json::{Buffer, Index, Root, buffer::View};
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;

/// All buffers' bytes.
pub(super) struct Buffers<'a> {
    /// Each buffer's place in `contents`, or why it is not there: that is said where it is needed.
    places: Vec<Result<usize, String>>,
    contents: Vec<Cow<'a, [u8]>>,
    /// The files that were read.
    pub files: Vec<PathBuf>,
    /// Their bytes.
    pub bytes_beside: usize,
}

impl<'a> Buffers<'a> {
    /// Reads all buffers of a file; `data` is what GLB has behind the JSON.
    pub(super) fn of(root: &Root, data: Option<&'a [u8]>, folder: &Folder<'a>) -> Self {
        let mut buffers = Self { places: Vec::new(), contents: Vec::new(), files: Vec::new(), bytes_beside: 0 };
        // Several buffers may be one file.
        let mut known = HashMap::new();
        for (number, Buffer { uri, byte_length, extensions, .. }) in root.buffers.iter().enumerate() {
            let place = match uri.as_ref().map(|uri| uri::parse(uri)) {
                None => match data.filter(|_| number == 0) {
                    Some(data) => Ok(buffers.keep(Cow::Borrowed(data))),
                    None => refuse_compressed(extensions.as_ref().map(|extensions| &extensions.others))
                        .and_then(|()| Err(format!("its buffer {number} names no data; export it again"))),
                },
                Some(Ok(Uri::Data(bytes))) => Ok(buffers.keep(Cow::Owned(bytes))),
                Some(Ok(Uri::File(name))) => {
                    known.entry(name).or_insert_with_key(|name| buffers.read(name, folder)).clone()
                }
                Some(Err(problem)) => Err(problem),
            };
            buffers.places.push(place.and_then(|place| {
                let has = buffers.contents.get(place).map_or(0, |bytes| bytes.len());
                match byte_length.0 > has as u64 {
                    false => Ok(place),
                    true => Err(format!(
                        "its buffer {number} should have {} bytes and has {has}; it is damaged or cut off, export it again",
                        byte_length.0
                    )),
                }
            }));
        }
        buffers
    }

    fn keep(&mut self, bytes: Cow<'a, [u8]>) -> usize {
        self.contents.push(bytes);
        self.contents.len() - 1
    }

    /// Reads a file of the model's folder.
    fn read(&mut self, name: &str, folder: &Folder<'a>) -> Result<usize, String> {
        if !folder.is_some() {
            return Err(format!("its data is in {}, which is not read; give both files or a GLB", shown(name)));
        }
        // Some programs write their own system's slashes.
        let slashes = name.replace('\\', "/");
        let most = MODEL_BYTES - self.bytes_beside as u64;
        let bytes = folder.read(slashes.as_ref(), most).map_err(|failure| match failure {
            Failure::Outside => skin::outside("data file", name),
            Failure::System(_) => format!("its data file {} is missing; put it beside the model", shown(name)),
            failure => format!("its data file {}: {}", shown(name), failure.problem("a model's data")),
        })?;
        self.bytes_beside += bytes.len();
        self.files.extend(folder.place_of(&slashes));
        Ok(self.keep(bytes))
    }

    /// The bytes of all of them together.
    pub(super) fn all_bytes(&self) -> usize {
        self.contents.iter().map(|bytes| bytes.len()).sum()
    }

    /// The bytes of a part of a buffer.
    pub(super) fn view(&self, root: &Root, index: Index<View>) -> Result<&[u8], String> {
        let view = root.get(index).ok_or_else(|| format!("its buffer view {index} does not exist; export it again"))?;
        let number = view.buffer.value();
        let place =
            self.places.get(number).ok_or_else(|| format!("its buffer {number} does not exist; export it again"))?;
        let bytes = self.contents.get(*place.as_ref().map_err(Clone::clone)?).map_or(&[][..], |bytes| bytes);
        let (start, length) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
        let part = usize::try_from(start)
            .ok()
            .zip(usize::try_from(length).ok())
            .and_then(|(start, length)| bytes.get(start..start.checked_add(length)?));
        part.ok_or_else(|| {
            format!("its buffer view {index} reaches beyond the {} bytes of its buffer; export it again", bytes.len())
        })
    }
}
