//! 3MF, the models of slicers and printers: a zip file of XML.
//!
//! Read are triangles, objects and components as parts, base materials and groups of colours, the unit, which becomes millimetres, and
//! objects in other parts of the file, of the production extension. The XML is read as a stream: a tree of it takes ten times its length.

mod zip;

use super::number::number;
use super::soup::{Corner, Size, Soup};
use super::{Material, NONE, NamedPart, text};
use crate::error::{Error, Result};
use crate::files::shown;
use crate::limits::{LABEL_CHARACTERS, MATERIALS, NODE_LEVELS, PLACES};
use crate::memory;
use glam::{DMat4, DVec3};
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap, HashSet};
use zip::Zip;

/// The part of the file that holds the model; its build lies like an object under this number.
const MODEL: [&str; 2] = ["3D/3dmodel.model", "build"];

/// The elements that are left out with a remark.
const OTHERS: [&[u8]; 5] =
    [b"texture2dgroup", b"compositematerials", b"multiproperties", b"beamlattice", b"slicestack"];

/// Millimetres of the units other than millimetres.
const MM: [(&str, f64); 5] = [("micron", 1e-3), ("centimeter", 10.0), ("inch", 25.4), ("foot", 304.8), ("meter", 1e3)];

/// What was read; the error is a sentence without the file's name.
type PackageResult<T> = std::result::Result<T, String>;

/// The name of a material or a colour, and its red, green and blue.
type Paint = (String, [u8; 3]);

/// An object by its part of the file and its number, and where it lies.
type Place = ([String; 2], DMat4);

/// A mesh, or other objects at places.
#[derive(Default)]
struct Object {
    name: String,
    /// Whether it is not printed: slicers mark regions by such objects.
    is_other: bool,
    /// The group and the number of what paints it.
    paint: [String; 2],
    positions: Vec<DVec3>,
    /// Each triangle's corners and material.
    triangles: Vec<([u32; 3], u32)>,
    components: Vec<Place>,
}

/// A file's contents.
#[derive(Default)]
struct Contents {
    soup: Soup,
    objects: Vec<Object>,
    /// Where the objects are in that list.
    numbers: HashMap<[String; 2], usize>,
    /// Where the materials will be in the soup's.
    paints: HashMap<Paint, u32>,
    /// What is not drawn, in words.
    left_out: BTreeSet<String>,
    /// How many objects and components there are.
    elements: usize,
}

/// Whether a file is a zip file with a model in it.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") && memchr::memmem::rfind(bytes, b".model").is_some()
}

/// Reads a 3MF file's bytes. `path` is for messages.
pub(super) fn read(bytes: &[u8], path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    let mut contents = Contents::default();
    contents.read(bytes).map_err(|problem| Error::model(path, problem))?;
    let left_out = Vec::from_iter(contents.left_out);
    remarks.extend((!left_out.is_empty()).then(|| format!("{path}: not drawn: {}", left_out.join(", "))));
    Ok(contents.soup)
}

impl Contents {
    /// Reads the model's part and those that it names, and puts its objects in their places.
    fn read(&mut self, bytes: &[u8]) -> PackageResult<()> {
        let mut zip = Zip::open(bytes).ok_or("its list of parts is damaged or cut off; is it a 3MF file?")?;
        let (mut unread, mut known) = (vec![MODEL[0].to_owned()], HashSet::new());
        while let Some(part) = unread.pop() {
            if known.insert(part.to_ascii_lowercase()) {
                let before = self.objects.len();
                self.read_part(&zip.part(&part)?, &part)?;
                let places = self.objects[before..].iter().flat_map(|object| &object.components);
                unread.extend(places.map(|([part, _], _)| part.clone()));
            }
        }
        let mut paints: Vec<_> = self.paints.drain().collect();
        paints.sort_unstable_by_key(|(_, number)| *number);
        let color = |rgb: [u8; 3]| Some(rgb.map(|channel| f32::from(channel) / 255.0));
        let material = |((name, rgb), _)| Material { name, color: color(rgb), ..Material::default() };
        self.soup.materials = paints.into_iter().map(material).collect();
        self.soup.bytes_beside = zip.unpacked as usize;
        self.place_all(bytes.len())
    }

    /// Reads the objects of a part.
    fn read_part(&mut self, xml: &[u8], part: &str) -> PackageResult<()> {
        let (mut unit, mut groups, mut group) = (1.0, HashMap::<_, Vec<Paint>>::new(), String::new());
        let xml = text::decoded(xml);
        let mut reader = Reader::from_reader(&*xml);
        let damaged = |why: &str| format!("its part {} is no sound XML ({}); export it again", shown(part), shown(why));
        loop {
            let it = match reader.read_event().map_err(|error| damaged(&error.to_string()))? {
                Event::Start(it) | Event::Empty(it) => it,
                Event::Eof => return Ok(()),
                _ => continue,
            };
            let text = |name: &str| get(&it, name).into_owned();
            match (it.local_name().as_ref(), self.objects.last_mut()) {
                (b"model", _) => {
                    unit = MM.iter().find(|(name, _)| *name == get(&it, "unit")).map_or(1.0, |(_, mm)| *mm);
                }
                (b"basematerials" | b"colorgroup", _) => group = text("id"),
                (b"base" | b"color", _) => {
                    let color = text("displaycolor") + &get(&it, "color");
                    let name = Some(text("name")).filter(|name| !name.is_empty());
                    groups.entry(group.clone()).or_default().push((name.unwrap_or(color.clone()), rgb(&color)));
                }
                (name @ (b"object" | b"build"), _) => {
                    let id = if name == b"build" { MODEL[1].to_owned() } else { text("id") };
                    let name = Some(text("name")).filter(|name| !name.is_empty()).unwrap_or(format!("object {id}"));
                    self.numbers.insert([part.to_owned(), id], self.objects.len());
                    let (is_other, paint) = (text("type") == "other", [text("pid"), text("pindex")]);
                    self.objects.push(Object { name, is_other, paint, ..Object::default() });
                    self.count_element()?;
                }
                // Those of slices have no height.
                (b"vertex", Some(object)) if !get(&it, "z").is_empty() => {
                    let place = ["x", "y", "z"].map(|axis| number(&get(&it, axis)).unwrap_or(f64::NAN));
                    object.positions.push(unit * DVec3::from_array(place));
                }
                (b"triangle", Some(object)) => {
                    let corners = ["v1", "v2", "v3"].map(|name| get(&it, name).parse().unwrap_or(NONE));
                    let next = self.paints.len() as u32;
                    let material = paint(&it, &object.paint, &groups).map(|it| *self.paints.entry(it).or_insert(next));
                    match corners.iter().all(|corner| (*corner as usize) < object.positions.len()) {
                        true => object.triangles.push((corners, material.unwrap_or(NONE))),
                        false => self.soup.defects.out_of_range_faces += 1,
                    }
                }
                (b"component" | b"item", Some(object)) => {
                    object.components.push(place(&it, part, unit)?);
                    self.count_element()?;
                }
                (name, _) if OTHERS.contains(&name) => {
                    self.left_out.insert(String::from_utf8_lossy(name).into_owned());
                }
                _ => {}
            }
        }
    }

    /// Counts an object or a component.
    fn count_element(&mut self) -> PackageResult<()> {
        self.elements += 1;
        if self.elements > PLACES { Err(TOO_MUCH.to_owned()) } else { Ok(()) }
    }

    /// Puts the build's objects in their places.
    fn place_all(&mut self, file_bytes: usize) -> PackageResult<()> {
        let Self { soup, objects, numbers, .. } = self;
        soup.has_copies = true;
        let (mut size, free) = (Size::default(), memory::free());
        let build = (MODEL.map(str::to_owned), DMat4::IDENTITY);
        let mut waiting = vec![(&build, DMat4::IDENTITY, NONE, 0)];
        let mut placed = 0;
        while let Some(((key, matrix), above, within, level)) = waiting.pop() {
            let missing = || format!("its object {} is missing; export it again", shown(&key[1]));
            let object = &objects[*numbers.get(key).ok_or_else(missing)?];
            placed += 1;
            if placed + waiting.len() + object.components.len() > PLACES {
                return Err(TOO_MUCH.to_owned());
            }
            if object.is_other {
                continue;
            }
            let (vertices, triangles) = (object.positions.len(), object.triangles.len());
            size = size.plus(Size { vertices, corners: 3 * triangles, triangles, curves: 0 });
            size.check_copies(file_bytes, free)?;
            let is_too_much = soup.materials.len() > MATERIALS || size.is_beyond_count();
            if level > NODE_LEVELS || is_too_much {
                return Err(TOO_MUCH.to_owned());
            }
            let (matrix, first) = (above * *matrix, soup.positions.len() as u32);
            let is_mirrored = matrix.determinant() < 0.0;
            let part = if level == 0 { NONE } else { soup.parts.len() as u32 };
            soup.parts.extend((level > 0).then(|| NamedPart { name: object.name.clone(), within }));
            soup.positions.extend(object.positions.iter().map(|position| matrix.transform_point3(*position)));
            for ([a, b, c], material) in &object.triangles {
                let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
                soup.corners.extend(corners.map(|corner| Corner::at(first + corner)));
                soup.polygon_materials.push(*material);
            }
            soup.polygon_parts.resize(soup.polygon_materials.len(), part);
            waiting.extend(object.components.iter().rev().map(|place| (place, matrix, part, level + 1)));
        }
        Ok(())
    }
}

/// The sentence about what grows without an end.
const TOO_MUCH: &str = "its components form a circle, or it has too many objects or materials; export it with fewer";

/// An element's attribute of this name, whatever its prefix; empty where it has none or a longer one than any text of a model.
fn get<'a>(it: &'a BytesStart<'_>, name: &str) -> Cow<'a, str> {
    let mut attributes = it.attributes();
    let found = attributes.with_checks(false).flatten().find(|one| one.key.local_name().as_ref() == name.as_bytes());
    let value = found.and_then(|one| one.normalized_value(XmlVersion::Implicit1_0).ok());
    value.filter(|value| value.len() <= LABEL_CHARACTERS).unwrap_or_default()
}

/// The colour of `#rrggbb`, with an opacity behind it or without; white for what is none.
fn rgb(text: &str) -> [u8; 3] {
    let digits = text.trim().strip_prefix('#').and_then(|digits| digits.get(..6));
    let [_, rgb @ ..] =
        digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()).unwrap_or(0xff_ff_ff).to_be_bytes();
    rgb
}

/// What paints a triangle of an object. Of colours that differ at its corners it is the mean, in sixteen shades of each channel.
fn paint(it: &BytesStart<'_>, [group, number]: &[String; 2], groups: &HashMap<String, Vec<Paint>>) -> Option<Paint> {
    let own = get(it, "pid");
    let paints = groups.get(if own.is_empty() { group.as_str() } else { &own })?;
    let named = |number: &str| paints.get(number.parse::<usize>().ok()?);
    let first = named(&get(it, "p1")).or_else(|| named(number))?;
    let corners = [first, named(&get(it, "p2")).unwrap_or(first), named(&get(it, "p3")).unwrap_or(first)];
    if corners.iter().all(|paint| *paint == first) {
        return Some(first.clone());
    }
    let mean = |channel: usize| corners.iter().map(|(_, rgb)| u32::from(rgb[channel])).sum::<u32>() / 3;
    let [red, green, blue] = [0, 1, 2].map(|channel| ((mean(channel) + 8) / 17 * 17) as u8);
    Some((format!("#{red:02x}{green:02x}{blue:02x}"), [red, green, blue]))
}

/// The object that a component or an item puts somewhere, and where.
fn place(it: &BytesStart<'_>, part: &str, unit: f64) -> PackageResult<Place> {
    let (path, transform) = (get(it, "path"), get(it, "transform"));
    let of = if path.is_empty() { part } else { path.trim_start_matches('/') };
    let numbers: Vec<f64> = transform.split_ascii_whitespace().map(|word| number(word).unwrap_or(f64::NAN)).collect();
    let matrix = match numbers[..] {
        [] => DMat4::IDENTITY,
        [a, b, c, d, e, f, g, h, i, x, y, z] => DMat4::from_cols_array_2d(&[
            [a, b, c, 0.0],
            [d, e, f, 0.0],
            [g, h, i, 0.0],
            [x * unit, y * unit, z * unit, 1.0],
        ]),
        _ => return Err(format!("a transform in its part {} is not twelve numbers; export it again", shown(part))),
    };
    Ok(([of.to_owned(), get(it, "objectid").into_owned()], matrix))
}

#[cfg(test)]
pub(super) mod tests;
