//! What follows a PLY file's header: elements one after the other, as lines of words or as bytes.

use super::header::{Element, Encoding, PropertyType, ScalarType};
use crate::bytes::Bytes;
use crate::mesh::number::number;
use crate::mesh::soup::padding;
use crate::threads::{listed, threads_for};

/// Why an element cannot be read, in words that go on with "of the file's 9 vertices".
#[derive(Debug)]
pub(super) struct Damage(pub &'static str);

const TOO_FEW: Damage = Damage("it ends before the last");
const NO_NUMBER: Damage = Damage("a number of the wrong type is in one");

/// A part of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Value {
    /// A single number.
    Scalar(f64),
    /// A list begins; no more items than this can follow in the whole file.
    List {
        /// As many as the bytes left can hold.
        at_most: usize,
    },
    /// An item of a list of whole numbers.
    Item(i64),
    /// An item of a list of other numbers.
    Number(f64),
}

impl Value {
    /// An item of a list as an index, which floats may be, too. `None` for anything else.
    pub(super) fn index(self) -> Option<i64> {
        match self {
            Self::Item(index) => Some(index),
            // Out of any range.
            Self::Number(number) => Some(if number.fract() == 0.0 { number as i64 } else { i64::MAX }),
            Self::Scalar(_) | Self::List { .. } => None,
        }
    }
}

/// The part of a file behind its header, from where it was read to.
#[derive(Clone)]
pub(super) struct Payload<'a> {
    rest: Bytes<'a>,
    encoding: Encoding,
    /// The rest of the current line, in a text file.
    line: &'a [u8],
    /// The lines read so far, those of the header among them.
    lines: u64,
}

impl<'a> Payload<'a> {
    pub(super) fn new(bytes: &'a [u8], encoding: Encoding, lines: u64) -> Self {
        Self { rest: Bytes(bytes), encoding, line: &[], lines }
    }

    /// The line read last, where the file has lines.
    pub(super) fn line(&self) -> Option<u64> {
        (self.encoding == Encoding::Ascii).then_some(self.lines)
    }

    /// The rest, and how many elements of this kind it is; 0 if it is anything else.
    pub(super) fn more(&self, element: &Element) -> (&'a [u8], usize) {
        let (mut ahead, mut count, padding) = (self.clone(), 0, padding(self.rest.0));
        while ahead.rest.0.len() > padding {
            count += 1;
            if ahead.element(element, |_, _| {}).is_err() {
                return (self.rest.0, 0);
            }
        }
        (ahead.rest.0, count)
    }

    /// How many of an element's promised ones the bytes left can hold; each has a property.
    pub(super) fn at_most(&self, element: &Element) -> usize {
        let smallest = element.properties.iter().map(|property| match (&property.data_type, self.encoding) {
            // A digit and what ends it.
            (_, Encoding::Ascii) => 2,
            (PropertyType::Scalar(kind) | PropertyType::List(kind, _), _) => size_of(kind),
        });
        element.count.min(self.rest.0.len() / smallest.sum::<usize>().max(1) + 1)
    }

    /// Reads the next element and hands over its properties' names and values.
    pub(super) fn element(&mut self, element: &Element, value: impl FnMut(&str, Value)) -> Result<(), Damage> {
        match self.encoding {
            Encoding::Ascii => self.line_of(element, value),
            Encoding::BinaryLittleEndian => self.bytes_of::<false>(element, value),
            Encoding::BinaryBigEndian => self.bytes_of::<true>(element, value),
        }
    }

    /// The corners of an element's lists, read at once on all cores where each is three numbers from 0 up to `most`, without it, with
    /// its length in a byte, and the element has nothing else: as nearly every binary file's faces are. `None` for any other, of which
    /// nothing is read then.
    pub(super) fn triangles<T: Send>(
        &mut self,
        element: &Element,
        most: u32,
        corner: impl Fn(u32) -> T + Sync,
    ) -> Option<Vec<T>> {
        /// Bytes of a length and three numbers.
        const BYTES: usize = 13;
        let [property] = element.properties.as_slice() else { return None };
        let PropertyType::List(ScalarType::UChar | ScalarType::Char, ScalarType::Int | ScalarType::UInt) =
            property.data_type
        else {
            return None;
        };
        if self.encoding != Encoding::BinaryLittleEndian {
            return None;
        }
        let (faces, rest) = self.rest.0.split_at_checked(element.count.checked_mul(BYTES)?)?;
        let corners = listed(element.count, 3, threads_for(element.count), |range, corners| {
            for face in faces[range.start * BYTES..range.end * BYTES].as_chunks::<BYTES>().0 {
                let [3, numbers @ ..] = face else { return None };
                for number in numbers.as_chunks::<4>().0 {
                    let number = u32::from_le_bytes(*number);
                    if number >= most {
                        return None;
                    }
                    corners.push(corner(number));
                }
            }
            Some(())
        })?;
        self.rest = Bytes(rest);
        Some(corners)
    }

    /// An element's numbers: from the next line that has any on, over as many as they take; what else the last one holds is
    /// passed over.
    fn line_of(&mut self, element: &Element, mut value: impl FnMut(&str, Value)) -> Result<(), Damage> {
        self.line = &[];
        for property in element.properties.iter() {
            let name = property.name.as_str();
            match &property.data_type {
                PropertyType::Scalar(kind) => {
                    value(name, Value::Scalar(scalar_of(self.word()?, kind).ok_or(NO_NUMBER)?));
                }
                PropertyType::List(_, kind) => {
                    let count: u64 = self.word()?.parse().map_err(|_| NO_NUMBER)?;
                    value(name, Value::List { at_most: (self.line.len() + self.rest.0.len()) / 2 + 1 });
                    for _ in 0..count {
                        value(name, item(scalar_of(self.word()?, kind).ok_or(NO_NUMBER)?, kind));
                    }
                }
            }
        }
        Ok(())
    }

    /// The next word of this line or of those behind it.
    fn word(&mut self) -> Result<&'a str, Damage> {
        loop {
            let line = self.line.trim_ascii_start();
            let (word, rest) = line.split_at(line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len()));
            self.line = rest;
            if !word.is_empty() {
                return std::str::from_utf8(word).map_err(|_| NO_NUMBER);
            }
            self.line = self.next_line()?;
        }
    }

    /// The bytes up to the next newline, carriage return, or both.
    fn next_line(&mut self) -> Result<&'a [u8], Damage> {
        let all = self.rest.0;
        if all.is_empty() {
            return Err(TOO_FEW);
        }
        self.lines += 1;
        let end = memchr::memchr2(b'\n', b'\r', all).unwrap_or(all.len());
        let (line, rest) = all.split_at(end);
        let ended = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
        self.rest = Bytes(ended);
        Ok(line)
    }

    fn bytes_of<const IS_BIG: bool>(
        &mut self,
        element: &Element,
        mut value: impl FnMut(&str, Value),
    ) -> Result<(), Damage> {
        for property in element.properties.iter() {
            let name = property.name.as_str();
            match &property.data_type {
                PropertyType::Scalar(kind) => {
                    value(name, Value::Scalar(scalar::<IS_BIG>(&mut self.rest, kind).ok_or(TOO_FEW)?));
                }
                PropertyType::List(count, kind) => {
                    if !is_whole(count) {
                        return Err(Damage("a list whose length is not a whole number is in each"));
                    }
                    let count = scalar::<IS_BIG>(&mut self.rest, count).ok_or(TOO_FEW)?;
                    if count < 0.0 {
                        return Err(Damage("a list of negative length is in one"));
                    }
                    value(name, Value::List { at_most: self.rest.0.len() / size_of(kind) });
                    let items = self.rest.records(count as usize, size_of(kind)).ok_or(TOO_FEW)?;
                    let number = |bytes| scalar::<IS_BIG>(&mut Bytes(bytes), kind).unwrap_or_default();
                    items.for_each(|bytes| value(name, item(number(bytes), kind)));
                }
            }
        }
        Ok(())
    }
}

fn item(number: f64, kind: &ScalarType) -> Value {
    if is_whole(kind) { Value::Item(number as i64) } else { Value::Number(number) }
}

fn is_whole(kind: &ScalarType) -> bool {
    !matches!(kind, ScalarType::Float | ScalarType::Double)
}

/// Bytes of a number.
fn size_of(kind: &ScalarType) -> usize {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// A word as a number of its type.
fn scalar_of(word: &str, kind: &ScalarType) -> Option<f64> {
    match kind {
        ScalarType::Char => word.parse::<i8>().ok().map(f64::from),
        ScalarType::UChar => word.parse::<u8>().ok().map(f64::from),
        ScalarType::Short => word.parse::<i16>().ok().map(f64::from),
        ScalarType::UShort => word.parse::<u16>().ok().map(f64::from),
        ScalarType::Int => word.parse::<i32>().ok().map(f64::from),
        ScalarType::UInt => word.parse::<u32>().ok().map(f64::from),
        ScalarType::Float => number::<f32>(word).map(f64::from),
        ScalarType::Double => number(word),
    }
}

/// A number out of bytes; f64 holds all of them exactly.
fn scalar<const IS_BIG: bool>(bytes: &mut Bytes<'_>, kind: &ScalarType) -> Option<f64> {
    fn in_order<const N: usize, const IS_BIG: bool>(bytes: &mut Bytes<'_>) -> Option<[u8; N]> {
        let mut array: [u8; N] = *bytes.take(N)?.first_chunk()?;
        if IS_BIG {
            array.reverse();
        }
        Some(array)
    }
    Some(match kind {
        ScalarType::Char => f64::from(i8::from_le_bytes(in_order::<1, IS_BIG>(bytes)?)),
        ScalarType::UChar => f64::from(u8::from_le_bytes(in_order::<1, IS_BIG>(bytes)?)),
        ScalarType::Short => f64::from(i16::from_le_bytes(in_order::<2, IS_BIG>(bytes)?)),
        ScalarType::UShort => f64::from(u16::from_le_bytes(in_order::<2, IS_BIG>(bytes)?)),
        ScalarType::Int => f64::from(i32::from_le_bytes(in_order::<4, IS_BIG>(bytes)?)),
        ScalarType::UInt => f64::from(u32::from_le_bytes(in_order::<4, IS_BIG>(bytes)?)),
        ScalarType::Float => f64::from(f32::from_le_bytes(in_order::<4, IS_BIG>(bytes)?)),
        ScalarType::Double => f64::from_le_bytes(in_order::<8, IS_BIG>(bytes)?),
    })
}
