//! Numbers out of a glTF file's data: every offset, stride and count is compared with the bytes there are.

use super::buffers::Buffers;
use crate::bytes::Bytes;
use gltf_json::accessor::{ComponentType, Type, sparse::Sparse};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Index, Root, buffer::View};

/// What accessors are read from.
pub(super) struct Accessors<'a> {
    pub root: &'a Root,
    pub buffers: &'a Buffers<'a>,
}

/// How an accessor's elements are written.
#[derive(Clone, Copy)]
struct Layout {
    kind: ComponentType,
    /// Numbers in an element.
    numbers: usize,
    /// Whether whole numbers stand for shares of their largest.
    normalized: bool,
}

impl Layout {
    fn bytes(self) -> usize {
        self.kind.size() * self.numbers
    }

    /// A number of an element; 0 beyond its bytes.
    fn number(self, element: &[u8], place: usize) -> f64 {
        let size = self.kind.size();
        let mut bytes = Bytes(element.get(place * size..).unwrap_or_default());
        let (whole, largest) = match self.kind {
            ComponentType::F32 => return bytes.f32().map(f64::from).unwrap_or_default(),
            ComponentType::I8 => (bytes.u8().map(|byte| f64::from(byte as i8)), 127.0),
            ComponentType::U8 => (bytes.u8().map(f64::from), 255.0),
            ComponentType::I16 => (bytes.i16().map(f64::from), 32_767.0),
            ComponentType::U16 => (bytes.u16().map(f64::from), 65_535.0),
            ComponentType::U32 => (bytes.u32().map(f64::from), 1.0),
        };
        let whole = whole.unwrap_or_default();
        if self.normalized { (whole / largest).max(-1.0) } else { whole }
    }
}

impl<'a> Accessors<'a> {
    /// How many elements an accessor has.
    pub(super) fn count(&self, index: Index<Accessor>) -> Result<usize, String> {
        usize::try_from(self.get(index)?.count.0).map_err(|_| format!("its accessor {index} has too many elements"))
    }

    fn get(&self, index: Index<Accessor>) -> Result<&'a Accessor, String> {
        self.root.get(index).ok_or_else(|| format!("its accessor {index} does not exist; export it again"))
    }

    /// The largest number that an accessor's type of whole numbers holds.
    pub(super) fn largest(&self, index: Index<Accessor>) -> Result<u32, String> {
        Ok(match &self.get(index)?.component_type {
            Valid(component) if component.0 == ComponentType::U8 => u8::MAX.into(),
            Valid(component) if component.0 == ComponentType::U16 => u16::MAX.into(),
            _ => u32::MAX,
        })
    }

    /// The first `count` elements of `N` numbers each.
    pub(super) fn numbers<const N: usize>(
        &self,
        index: Index<Accessor>,
        count: usize,
    ) -> Result<Vec<[f64; N]>, String> {
        let mut numbers = Vec::new();
        self.elements(index, N, count, |place, element, layout| {
            let element: [f64; N] = std::array::from_fn(|number| layout.number(element, number));
            match numbers.get_mut(place) {
                Some(slot) => *slot = element,
                None => numbers.push(element),
            }
        })?;
        Ok(numbers)
    }

    /// The first `count` elements as colours, red, green and blue; linear light becomes sRGB, and alpha is left out.
    pub(super) fn colors(&self, index: Index<Accessor>, count: usize) -> Result<Vec<[f32; 3]>, String> {
        let rgb = match self.numbers::<4>(index, count) {
            Ok(colors) => colors.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect(),
            Err(_) => self.numbers::<3>(index, count)?,
        };
        Ok(rgb.into_iter().map(|color| color.map(|channel| super::materials::to_srgb(channel as f32))).collect())
    }

    /// The first `count` elements as indices.
    pub(super) fn indices(&self, index: Index<Accessor>, count: usize) -> Result<Vec<u32>, String> {
        let mut indices = Vec::new();
        self.elements(index, 1, count, |place, element, layout| {
            let number = layout.number(element, 0) as u32;
            match indices.get_mut(place) {
                Some(slot) => *slot = number,
                None => indices.push(number),
            }
        })?;
        Ok(indices)
    }

    /// Gives the first `count` elements' bytes to `put` in order, then those that are put in other's places.
    fn elements(
        &self,
        index: Index<Accessor>,
        numbers: usize,
        count: usize,
        mut put: impl FnMut(usize, &[u8], Layout),
    ) -> Result<(), String> {
        let accessor = self.get(index)?;
        let (Valid(component), Valid(kind)) = (&accessor.component_type, &accessor.type_) else {
            return Err(format!("its accessor {index} has an unknown type; export it again"));
        };
        if kind.multiplicity() != numbers {
            return Err(format!(
                "its accessor {index} has {} numbers per element where {numbers} are needed; export it again",
                kind.multiplicity()
            ));
        }
        let has = self.count(index)?;
        if has < count {
            return Err(format!("its accessor {index} has {has} elements where {count} are needed; export it again"));
        }
        let layout = Layout { kind: component.0, numbers, normalized: accessor.normalized };
        if matches!(kind, Type::Mat2 | Type::Mat3) {
            // Their columns are padded; nothing that is read here is one.
            return Err(format!("its accessor {index} holds matrices where none are expected; export it again"));
        }
        match accessor.buffer_view {
            None => (0..count).for_each(|place| put(place, &[], layout)),
            Some(view) => {
                let offset = accessor.byte_offset.unwrap_or_default().0;
                let elements = self.records(index, view, offset, has, layout.bytes(), true)?;
                elements.take(count).enumerate().for_each(|(place, element)| put(place, element, layout));
            }
        }
        match &accessor.sparse {
            None => Ok(()),
            Some(sparse) => self.replacements(index, sparse, has, count, layout, put),
        }
    }

    /// Gives the elements of a sparse accessor that take the places of the first `most` others to `put`.
    fn replacements(
        &self,
        index: Index<Accessor>,
        sparse: &Sparse,
        has: usize,
        most: usize,
        layout: Layout,
        mut put: impl FnMut(usize, &[u8], Layout),
    ) -> Result<(), String> {
        let damaged = || {
            format!("its accessor {index} replaces elements that it does not have, or out of order; export it again")
        };
        let Valid(kind) = &sparse.indices.component_type else { return Err(damaged()) };
        let count = usize::try_from(sparse.count.0).map_err(|_| damaged())?;
        let places = Layout { kind: kind.0, numbers: 1, normalized: false };
        let (at, values) = (&sparse.indices, &sparse.values);
        let numbers = self.records(index, at.buffer_view, at.byte_offset.0, count, places.bytes(), false)?;
        let elements = self.records(index, values.buffer_view, values.byte_offset.0, count, layout.bytes(), false)?;
        let mut next = 0;
        for (number, element) in numbers.zip(elements) {
            let place = places.number(number, 0) as usize;
            if place < next || place >= has {
                return Err(damaged());
            }
            if place >= most {
                break;
            }
            put(place, element, layout);
            next = place + 1;
        }
        Ok(())
    }

    /// `count` records of `size` bytes in a buffer view, from an offset.
    fn records(
        &self,
        index: Index<Accessor>,
        view: Index<View>,
        offset: u64,
        count: usize,
        size: usize,
        has_stride: bool,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, String> {
        let bytes = self.buffers.view(self.root, view)?;
        let given = self.root.get(view).and_then(|view| view.byte_stride).filter(|_| has_stride);
        // 0 is not allowed, and means what no stride does: programs of Google wrote it.
        let stride = given.filter(|stride| stride.0 > 0).map_or(size, |stride| stride.0);
        let bytes = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..));
        let needed = count.saturating_sub(1).checked_mul(stride).and_then(|bytes| bytes.checked_add(size));
        match (bytes, needed) {
            (Some(bytes), Some(needed)) if stride >= size && (needed <= bytes.len() || count == 0) => {
                Ok(bytes.chunks(stride).take(count).map(move |record| record.get(..size).unwrap_or_default()))
            }
            _ => Err(format!(
                "its accessor {index} reaches beyond its buffer view; it is damaged or cut off, export it again"
            )),
        }
    }
}
