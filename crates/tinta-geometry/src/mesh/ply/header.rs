//! A PLY file's header: which elements follow, how many of each, and what each consists of.

/// How what follows the header is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Lines of words.
    Ascii,
    /// Bytes, the least significant first.
    BinaryLittleEndian,
    /// Bytes, the most significant first.
    BinaryBigEndian,
}

/// A number's type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ScalarType {
    Char,
    UChar,
    Short,
    UShort,
    Int,
    UInt,
    Float,
    Double,
}

/// One number, or a list of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PropertyType {
    Scalar(ScalarType),
    /// The type of the list's length, and that of its items.
    List(ScalarType, ScalarType),
}

/// A part of every element of a kind.
#[derive(Debug)]
pub(super) struct Property {
    pub name: String,
    pub data_type: PropertyType,
}

/// A kind of element.
#[derive(Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

impl Element {
    pub(super) fn has(&self, property: &str) -> bool {
        self.properties.iter().any(|own| own.name == property)
    }
}

/// A whole header.
#[derive(Debug)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Bytes up to the end of its last line.
    pub bytes: usize,
    /// Lines, its last among them.
    pub lines: u64,
    /// The pictures that MeshLab names in comments, in order: what a face's `texnumber` counts in.
    pub pictures: Vec<String>,
    /// The first line that begins with no word of a header and was passed over.
    pub foreign: Option<u64>,
}

impl Header {
    pub(super) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }

    /// Reads the header at the beginning of a file.
    ///
    /// # Errors
    ///
    /// The faulty line, 1-based, and its problem.
    pub(super) fn read(file: &[u8]) -> Result<Self, (u64, &'static str)> {
        let (mut encoding, mut elements) = (None, Vec::<Element>::new());
        let (mut bytes, mut lines) = (0, 0);
        let (mut pictures, mut foreign) = (Vec::new(), None);
        let end = line_end(file);
        for line in file.split_inclusive(|byte| *byte == end) {
            bytes += line.len();
            lines += 1;
            let line = String::from_utf8_lossy(line);
            let words: Vec<&str> = line.split_whitespace().collect();
            let wrong = |problem| Err((lines, problem));
            match words.as_slice() {
                ["ply"] if lines == 1 => {}
                _ if lines == 1 => return wrong("its first line is not ply"),
                ["comment", "TextureFile", ..] => {
                    // A name may hold blanks.
                    let name = line.split_once("TextureFile").map_or("", |(_, name)| name.trim());
                    pictures.extend((!name.is_empty()).then(|| name.to_owned()));
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["format", name, version] => {
                    let found = match *name {
                        "ascii" => Encoding::Ascii,
                        "binary_little_endian" => Encoding::BinaryLittleEndian,
                        "binary_big_endian" => Encoding::BinaryBigEndian,
                        _ => return wrong("its format is unknown"),
                    };
                    if !version.starts_with(|digit: char| digit.is_ascii_digit()) {
                        return wrong("its format has no version");
                    }
                    if encoding.replace(found).is_some_and(|before| before != found) {
                        return wrong("it has two formats");
                    }
                }
                ["element", name, count] => {
                    let Ok(count) = count.parse() else { return wrong("this is not a number of elements") };
                    elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
                }
                ["property", types @ .., name] => {
                    let Some(data_type) = property_type(types) else { return wrong("this is not a property type") };
                    let Some(element) = elements.last_mut() else {
                        return wrong("this property belongs to no element");
                    };
                    element.properties.push(Property { name: (*name).to_owned(), data_type });
                }
                ["end_header"] => {
                    let Some(encoding) = encoding else { return wrong("its header names no format") };
                    return Ok(Self { encoding, elements, bytes, lines, pictures, foreign });
                }
                ["ply" | "format" | "element" | "property" | "end_header", ..] => {
                    return wrong("this is not a header line");
                }
                _ => foreign = foreign.or(Some(lines)),
            }
        }
        Err((lines.max(1), "its header has no end_header"))
    }
}

/// The byte that ends each line of a file that begins with `ply` and the end of that line: a carriage return where it stands
/// alone, as behind it a newline may be data.
fn line_end(file: &[u8]) -> u8 {
    match file.iter().position(|byte| matches!(byte, b'\r' | b'\n')).and_then(|first| file.get(first..)) {
        Some([b'\r', rest @ ..]) if !rest.starts_with(b"\n") => b'\r',
        _ => b'\n',
    }
}

fn property_type(words: &[&str]) -> Option<PropertyType> {
    Some(match words {
        ["list", length, item] => PropertyType::List(scalar(length)?, scalar(item)?),
        [kind] => PropertyType::Scalar(scalar(kind)?),
        _ => return None,
    })
}

fn scalar(name: &str) -> Option<ScalarType> {
    Some(match name {
        "char" | "int8" => ScalarType::Char,
        "uchar" | "uint8" => ScalarType::UChar,
        "short" | "int16" => ScalarType::Short,
        "ushort" | "uint16" => ScalarType::UShort,
        "int" | "int32" => ScalarType::Int,
        "uint" | "uint32" => ScalarType::UInt,
        "float" | "float32" => ScalarType::Float,
        "double" | "float64" => ScalarType::Double,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_read_to_its_last_line() {
        let text = b"ply\r\nformat binary_big_endian 1.0\r\ncomment \xfc\r\nobj_info\r\nelement vertex 3\r\n\
            property float32  x\r\nelement face 0\r\nproperty list uchar int vertex_index\r\nend_header\r\n\n7";
        let header = Header::read(text).unwrap();
        assert_eq!((header.encoding, header.lines), (Encoding::BinaryBigEndian, 9));
        assert_eq!(&text[header.bytes..], b"\n7");
        assert_eq!(header.element("vertex").unwrap().count, 3);
        assert!(header.element("face").unwrap().has("vertex_index") && header.element("edge").is_none());
        let kinds: Vec<PropertyType> = header.elements.iter().map(|element| element.properties[0].data_type).collect();
        let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
        assert_eq!(kinds, [PropertyType::Scalar(ScalarType::Float), list]);
    }

    #[test]
    fn empty_and_foreign_lines_are_passed_over_and_pictures_are_named() {
        let text =
            b"ply\nformat ascii 1.0\n\nCreated by Blender3D 247\ncomment TextureFile a skin.png\nend_header\n\n0";
        let header = Header::read(text).unwrap();
        assert_eq!((header.lines, header.foreign, &text[header.bytes..]), (6, Some(4), &b"\n0"[..]));
        assert_eq!(header.pictures, ["a skin.png"]);
    }

    #[test]
    fn where_lines_end_in_a_carriage_return_a_newline_behind_them_is_data() {
        for (text, data) in [
            (&b"ply\rformat binary_little_endian 1.0\rend_header\r\n7"[..], &b"\n7"[..]),
            (b"ply\r\nformat binary_little_endian 1.0\r\nend_header\r\n\n7", b"\n7"),
            (b"ply\nformat binary_little_endian 1.0\nend_header\n\r7", b"\r7"),
        ] {
            let header = Header::read(text).unwrap();
            assert_eq!((&text[header.bytes..], header.lines), (data, 3));
        }
    }

    #[test]
    fn every_wrong_line_is_named() {
        let after = |lines: &str| Header::read(format!("ply\nformat ascii 1.0\n{lines}").as_bytes()).unwrap_err();
        assert_eq!(Header::read(b"plyx\n").unwrap_err().0, 1);
        assert_eq!(Header::read(b"").unwrap_err().0, 1);
        assert_eq!(Header::read(b"ply\nend_header\n").unwrap_err(), (2, "its header names no format"));
        assert_eq!(Header::read(b"ply\nformat ascii\n").unwrap_err().0, 2);
        assert_eq!(Header::read(b"ply\nformat utf8 1.0\n").unwrap_err().0, 2);
        for wrong in [
            "ply\n",
            "format binary_big_endian 1.0\n",
            "element vertex -1\n",
            "element vertex\n",
            "property float x\n",
            "end_header now\n",
        ] {
            assert_eq!(after(wrong).0, 3, "{wrong}");
        }
        assert_eq!(after("element a 1\nproperty half x\n").0, 4);
        assert_eq!(after("element a 1\nproperty list float x\n").0, 4);
        assert_eq!(after("element a 1\n"), (3, "its header has no end_header"));
    }
}
