//! PLY, text and binary: vertices with normals, colours and texture coordinates, polygon faces, triangle strips.
//!
//! `header.rs` reads the header, `payload.rs` the elements, `paint.rs` the faces' colours and texture coordinates.

mod colors;
mod header;
mod paint;
mod payload;

use super::NONE;
use super::soup::{Corner, Soup, direction};
use crate::error::{Error, Result};
use crate::files::shown;
use crate::limits::PLY_HEADER_BYTES;
use colors::{full_color, share};
use glam::{DVec3, Vec2};
use header::{Element, Header};
use paint::Paint;
use payload::{Damage, Payload, Value};
use std::path::Path;

/// Whether elements were read.
type ElementResult = std::result::Result<(), Damage>;

/// Whether a file begins like PLY.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// Reads a PLY file's bytes. `path` appears in messages; `remarks` gets a sentence for each ignored part.
pub(super) fn read(bytes: &[u8], path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    if !bytes.starts_with(b"ply") {
        return Err(Error::model(
            path,
            "it does not begin like a PLY file; it is damaged or misnamed, export it again",
        ));
    }
    let head = &bytes[..bytes.len().min(PLY_HEADER_BYTES)];
    if head.len() < bytes.len() && memchr::memmem::find(head, b"end_header").is_none() {
        let problem =
            format!("its header does not end within {PLY_HEADER_BYTES} bytes; it is damaged, export it again");
        return Err(Error::model(path, problem));
    }
    let damaged = |line: Option<u64>, cause: &str| {
        Error::model(path, format!("it is damaged or cut off ({cause}); export it again")).at(line)
    };
    let mut header = Header::read(head).map_err(|(line, cause)| damaged(Some(line), cause))?;
    if let Some(line) = header.foreign {
        remarks.push(format!("{path}: line {line} of its header is none of PLY and was passed over"));
    }
    check_header(&header).map_err(|problem| Error::model(path, problem))?;
    // MeshLab's way to name a picture by the model's own name.
    let stem = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
    header.pictures.iter_mut().for_each(|picture| *picture = picture.replace("<this>", &stem));
    let mut payload = Payload::new(&bytes[header.bytes..], header.encoding, header.lines);
    let mut contents = Contents::new(&header);
    for element in &header.elements {
        contents.element(&mut payload, element, bytes.len()).map_err(|Damage(cause)| {
            damaged(payload.line(), &format!("{cause} of the file's {}", many(element.count, &element.name)))
        })?;
    }
    if let Some(last) = header.elements.last_mut() {
        let (promised, (rest, more)) = (last.count, payload.more(last));
        last.count = more;
        if more > 0 {
            // They have been looked through.
            contents.element(&mut payload, last, bytes.len()).unwrap_or_default();
        }
        last.count += promised;
        remarks.extend(contents.soup.note_more(path, &many(promised, &last.name), [promised, last.count], rest));
    }
    let mut soup = contents.soup;
    contents.paint.put_on(&mut soup);
    // A file of vertices alone is a cloud of points.
    if header.elements.iter().all(|element| element.name == "vertex" || element.count == 0) {
        soup.points = (0..soup.positions.len() as u32).collect();
    }
    let has_coordinates = soup.corners.iter().any(|corner| corner.texture != NONE);
    if has_coordinates && soup.materials.is_empty() && soup.colors.is_empty() {
        remarks.push(format!("{path}: it has texture coordinates but names no picture; --skin FILE puts one on"));
    }
    Ok(soup)
}

/// So many elements, in words.
fn many(count: usize, name: &str) -> String {
    let (one, several) = match name {
        "vertex" => ("vertex", "vertices"),
        "face" => ("face", "faces"),
        "tristrips" => ("triangle strip", "triangle strips"),
        "edge" => ("edge", "edges"),
        _ => return format!("{count} elements {}", shown(name)),
    };
    format!("{count} {}", if count == 1 { one } else { several })
}

/// Rejects headers that would be misread or never end.
fn check_header(header: &Header) -> std::result::Result<(), &'static str> {
    // An element without properties takes no bytes, so any number of them fits into any file.
    if header.elements.iter().any(|element| element.properties.is_empty() && element.count > 0) {
        return Err("its header has an element without properties; export it again");
    }
    let has = |element: &str, property: &str| header.element(element).is_some_and(|element| element.has(property));
    if !["x", "y", "z"].into_iter().all(|axis| has("vertex", axis)) {
        return Err("its vertices have no x, y and z; export it again");
    }
    let lacks_list = |name| header.element(name).is_some_and(|of| !of.has("vertex_indices") && !of.has("vertex_index"));
    if lacks_list("face") {
        return Err("its faces have no list of vertex_indices; export it again");
    }
    if lacks_list("tristrips") {
        return Err("its triangle strips have no list of vertex_indices; export it again");
    }
    Ok(())
}

/// A file's contents.
struct Contents {
    soup: Soup,
    /// Number of vertices in the header: faces may come before them.
    vertices: u32,
    has_normals: bool,
    has_texture: bool,
    /// Value of a full-strength colour channel in the file; `None` if vertices have no colours.
    full_color: Option<f64>,
    paint: Paint,
}

impl Contents {
    fn new(header: &Header) -> Self {
        let vertex = header.element("vertex");
        let has = |property: &str| vertex.is_some_and(|vertex| vertex.has(property));
        Self {
            soup: Soup::default(),
            vertices: vertex.map_or(0, |vertex| u32::try_from(vertex.count).unwrap_or(NONE)),
            has_normals: ["nx", "ny", "nz"].into_iter().all(has),
            has_texture: [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]]
                .into_iter()
                .any(|names| names.into_iter().all(has)),
            full_color: vertex.and_then(full_color),
            paint: Paint::of(header),
        }
    }

    /// Reads all elements of a kind.
    fn element(&mut self, payload: &mut Payload<'_>, element: &Element, file_bytes: usize) -> ElementResult {
        match element.name.as_str() {
            "vertex" => self.vertices(payload, element),
            "face" => self.faces(payload, element),
            "tristrips" => self.strips(payload, element, file_bytes),
            "edge" if element.has("vertex1") && element.has("vertex2") => self.edges(payload, element),
            _ => (0..element.count).try_for_each(|_| payload.element(element, |_, _| {})),
        }
    }

    fn vertices(&mut self, payload: &mut Payload<'_>, element: &Element) -> ElementResult {
        let count = payload.at_most(element);
        self.soup.positions.reserve_exact(count);
        self.soup.normals.reserve_exact(if self.has_normals { count } else { 0 });
        self.soup.texture_coordinates.reserve_exact(if self.has_texture { count } else { 0 });
        self.soup.colors.reserve_exact(if self.full_color.is_some() { count } else { 0 });
        for _ in 0..element.count {
            let (mut position, mut normal, mut texture) = (DVec3::ZERO, DVec3::ZERO, Vec2::ZERO);
            let mut color = DVec3::ZERO;
            payload.element(element, |name, value| {
                let Value::Scalar(number) = value else { return };
                match name {
                    "x" => position.x = number,
                    "y" => position.y = number,
                    "z" => position.z = number,
                    "nx" => normal.x = number,
                    "ny" => normal.y = number,
                    "nz" => normal.z = number,
                    "red" | "diffuse_red" => color.x = number,
                    "green" | "diffuse_green" => color.y = number,
                    "blue" | "diffuse_blue" => color.z = number,
                    "u" | "s" | "texture_u" => texture.x = number as f32,
                    "v" | "t" | "texture_v" => texture.y = number as f32,
                    _ => {}
                }
            })?;
            self.soup.positions.push(position);
            if self.has_normals {
                self.soup.normals.push(direction(normal));
            }
            self.soup.colors.extend(self.full_color.map(|full| share(color, full)));
            if self.has_texture {
                self.soup.texture_coordinates.push(texture);
            }
        }
        Ok(())
    }

    fn faces(&mut self, payload: &mut Payload<'_>, element: &Element) -> ElementResult {
        let Self { soup, vertices, has_normals, has_texture, paint, .. } = self;
        /// Corners for which there is room before a face is read.
        const LIST: usize = 1024;
        let with = |used: bool, index: u32| if used { index } else { NONE };
        let is_list = |name: &str| name == "vertex_indices" || name == "vertex_index";
        let is_first = soup.corners.is_empty() && soup.polygon_sizes.is_empty();
        if is_first && element.properties.iter().any(|property| is_list(&property.name)) {
            let corner = |index| Corner {
                position: index,
                normal: with(*has_normals, index),
                texture: with(*has_texture, index),
            };
            // Indices may be negative in the file: these are no smaller than any count of vertices here.
            if let Some(corners) = payload.triangles(element, (*vertices).min(i32::MAX as u32), corner) {
                soup.corners = corners;
                return Ok(());
            }
        }
        soup.write_sizes();
        soup.polygon_sizes.reserve_exact(payload.at_most(element));
        for _ in 0..element.count {
            let start = soup.corners.len();
            let mut is_in_range = true;
            paint.begin();
            payload.element(element, |name, value| {
                if !is_list(name) {
                    paint.take(name, value);
                    return;
                }
                if let Value::List { at_most } = value {
                    soup.corners.truncate(start);
                    is_in_range = true;
                    // Doubled as usual, but never beyond the capacity of the remaining bytes.
                    if soup.corners.capacity() - soup.corners.len() < at_most.min(LIST) {
                        soup.corners.reserve_exact(at_most.min(soup.corners.len() + LIST));
                    }
                }
                match value.index() {
                    Some(index) if (0..i64::from(*vertices)).contains(&index) => {
                        let index = index as u32;
                        let (normal, texture) = (with(*has_normals, index), with(*has_texture, index));
                        soup.corners.push(Corner { position: index, normal, texture });
                    }
                    Some(_) => is_in_range = false,
                    None => {}
                }
            })?;
            let count = soup.corners.len() - start;
            if count >= 3 && is_in_range {
                soup.polygon_sizes.push(count as u32);
                paint.end(soup, start);
                continue;
            }
            soup.corners.truncate(start);
            let defects = &mut soup.defects;
            *(if is_in_range { &mut defects.degenerate_triangles } else { &mut defects.out_of_range_faces }) += 1;
        }
        Ok(())
    }

    /// Edges between two vertices: segments of curves.
    fn edges(&mut self, payload: &mut Payload<'_>, element: &Element) -> ElementResult {
        self.soup.segments.reserve_exact(payload.at_most(element));
        for _ in 0..element.count {
            let mut ends = [f64::NAN; 2];
            payload.element(element, |name, value| match (name, value) {
                ("vertex1", Value::Scalar(number)) => ends[0] = number,
                ("vertex2", Value::Scalar(number)) => ends[1] = number,
                _ => {}
            })?;
            match ends.iter().all(|end| (0.0..f64::from(self.vertices)).contains(end)) {
                true => self.soup.segments.push(ends.map(|end| end as u32)),
                false => self.soup.defects.out_of_range_faces += 1,
            }
        }
        Ok(())
    }

    /// Strips of triangles, as old scans have them: often a single one, with negative indices where a new one begins.
    fn strips(&mut self, payload: &mut Payload<'_>, element: &Element, file_bytes: usize) -> ElementResult {
        let Self { soup, vertices, has_normals, has_texture, .. } = self;
        let with = |used: bool, index: u32| if used { index } else { NONE };
        let mut is_full = false;
        soup.write_sizes();
        for _ in 0..element.count {
            let mut strip = Strip::default();
            payload.element(element, |name, value| {
                let (true, Some(index)) = (name == "vertex_indices" || name == "vertex_index", value.index()) else {
                    return;
                };
                let Some([a, b, c]) = strip.triangle(index) else { return };
                // A repeated corner only moves the strip to its next place.
                if is_full || a == b || b == c || c == a {
                    return;
                }
                if [a, b, c].iter().any(|index| *index >= i64::from(*vertices)) {
                    soup.defects.out_of_range_faces += 1;
                    return;
                }
                soup.corners.extend([a, b, c].map(|index| {
                    let index = index as u32;
                    Corner { position: index, normal: with(*has_normals, index), texture: with(*has_texture, index) }
                }));
                soup.polygon_sizes.push(3);
                // A byte may be a triangle: a mesh too large is rejected by the faces read so far.
                is_full = soup.polygon_sizes.len().is_multiple_of(1 << 16) && soup.size().is_too_much(file_bytes);
            })?;
        }
        Ok(())
    }
}

/// Turns a strip into triangles: each corner makes one with the two before it, in alternating direction.
#[derive(Default)]
struct Strip {
    before: [Option<i64>; 2],
    is_turned: bool,
}

impl Strip {
    /// Returns the triangle that ends with the next corner, if any; a negative index ends the strip and begins another.
    fn triangle(&mut self, index: i64) -> Option<[i64; 3]> {
        if index < 0 {
            *self = Self::default();
            return None;
        }
        let [first, second] = self.before;
        self.before = [second, Some(index)];
        let (first, second) = (first?, second?);
        self.is_turned = !self.is_turned;
        Some(if self.is_turned { [first, second, index] } else { [second, first, index] })
    }
}

#[cfg(test)]
mod tests;
