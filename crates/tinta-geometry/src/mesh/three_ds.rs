//! 3D Studio models (3DS): all meshes of the file as one, with their materials. The reader is our own, since the
//! crate for it (ds3) reads no colours and no textures; every byte it looks at goes through [`Bytes`].
//!
//! The file is a tree of chunks, each a number, a length that counts itself, and data that may be followed by chunks.
//! Vertices lie where the editor had them. The animation's first frame may have a mesh elsewhere: at its carrier's place · its own ·
//! (its matrix⁻¹ · vertex - pivot). Smoothing groups are not used: normals are computed.

use super::soup::{Corner, Soup};
use super::{Material, NONE, NamedPart};
use crate::bytes::Bytes;
use crate::error::{Error, Result};
use crate::limits::{MATERIALS, NODE_LEVELS};
use glam::{DMat3, DMat4, DQuat, DVec3, Vec2};
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::path::PathBuf;

/// The chunks that are looked into; all others are passed over.
mod chunk {
    pub(super) const MAIN: u16 = 0x4d4d;
    pub(super) const VERSION: u16 = 0x0002;
    pub(super) const EDITOR: u16 = 0x3d3d;
    pub(super) const KEYFRAMER: u16 = 0xb000;
    /// Of the light everywhere, objects, cameras, lights and what these look at.
    pub(super) const NODES: std::ops::RangeInclusive<u16> = 0xb001..=0xb007;
    pub(super) const NODE_NUMBER: u16 = 0xb030;
    pub(super) const NODE_HEADER: u16 = 0xb010;
    pub(super) const PIVOT: u16 = 0xb013;
    pub(super) const PLACES: u16 = 0xb020;
    pub(super) const TURNS: u16 = 0xb021;
    pub(super) const SCALES: u16 = 0xb022;
    pub(super) const OBJECT: u16 = 0x4000;
    pub(super) const MESH: u16 = 0x4100;
    pub(super) const VERTICES: u16 = 0x4110;
    pub(super) const FACES: u16 = 0x4120;
    pub(super) const FACE_MATERIAL: u16 = 0x4130;
    pub(super) const TEXTURE_COORDINATES: u16 = 0x4140;
    pub(super) const MATRIX: u16 = 0x4160;
    pub(super) const MATERIAL: u16 = 0xafff;
    pub(super) const MATERIAL_NAME: u16 = 0xa000;
    pub(super) const DIFFUSE: u16 = 0xa020;
    pub(super) const TEXTURE: u16 = 0xa200;
    pub(super) const TEXTURE_FILE: u16 = 0xa300;
    pub(super) const COLOR_FLOATS: [u16; 2] = [0x0010, 0x0013];
    pub(super) const COLOR_BYTES: [u16; 2] = [0x0011, 0x0012];
}

const CHUNK_HEADER_BYTES: usize = 6;

/// Whether a file begins with a main chunk and, in it, a chunk that may be its first; TIFF pictures begin with MM too.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let mut bytes = Bytes(bytes);
    bytes.u16() == Some(chunk::MAIN)
        && bytes.u32().is_some()
        && bytes.u16().is_some_and(|first| [chunk::VERSION, chunk::EDITOR, chunk::KEYFRAMER].contains(&first))
}

/// Why a file is not read to its end.
#[derive(Debug)]
enum Damage {
    /// A chunk's length is wrong, or its data ends too early.
    Part(u16),
    /// There are more materials than are read.
    Materials,
}

/// The chunks that lie one after the other in `bytes`; a rest shorter than a chunk's header is padding.
fn chunks<'a>(mut bytes: Bytes<'a>) -> impl Iterator<Item = std::result::Result<(u16, Bytes<'a>), Damage>> {
    std::iter::from_fn(move || {
        if bytes.0.len() < CHUNK_HEADER_BYTES {
            return None;
        }
        let (number, length) = (bytes.u16()?, bytes.u32()? as usize);
        let data = length.checked_sub(CHUNK_HEADER_BYTES).and_then(|length| bytes.take(length));
        if data.is_none() {
            bytes = Bytes(&[]);
        }
        Some(data.map(|data| (number, Bytes(data))).ok_or(Damage::Part(number)))
    })
}

/// A file's contents before faces know their materials.
#[derive(Default)]
struct Contents {
    soup: Soup,
    /// For each face the place of its material's name in `material_names`, or [`NONE`].
    face_materials: Vec<u32>,
    /// The objects that have faces, as the soup's parts.
    meshes: Vec<Mesh>,
    /// The objects in the animation.
    nodes: Vec<Node>,
    /// The names that faces use, as they come; a name may come more than once.
    material_names: Vec<String>,
}

/// An object that has faces; its name is that of its part.
struct Mesh {
    positions: Range<usize>,
    corners: Range<usize>,
    /// World from its own space, where the editor has it.
    matrix: DMat4,
}

/// Reads a 3DS file's bytes. `path` is for messages.
pub(super) fn read(bytes: &[u8], path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    let mut main = Bytes(bytes);
    let (number, length) = (main.u16(), main.u32());
    if number != Some(chunk::MAIN) {
        return Err(Error::model(
            path,
            "it does not begin like a 3DS file; it is damaged or misnamed, export it again",
        ));
    }
    let length = length.map_or(CHUNK_HEADER_BYTES, |length| length as usize);
    let Some(data) = length.checked_sub(CHUNK_HEADER_BYTES).and_then(|length| main.take(length)) else {
        let has = bytes.len();
        let problem = format!(
            "its header promises {length} bytes but the file has {has}; it is damaged or cut off, export it again"
        );
        return Err(Error::model(path, problem));
    };
    let mut contents = Contents::default();
    contents.main(Bytes(data)).map_err(|damage| {
        let problem = match damage {
            Damage::Part(number) => format!("its part {number:04x} is damaged or cut off; export it again"),
            Damage::Materials => format!("it has more than {MATERIALS} materials; export it with fewer"),
        };
        Error::model(path, problem)
    })?;
    let several = contents.put_in_places();
    if several > 0 {
        let stand = if several == 1 { "mesh stands" } else { "meshes stand" };
        let drawn = "each is drawn once, in the first of them";
        remarks.push(format!("{path}: {several} {stand} in several places by its animation; {drawn}"));
    }
    let mut soup = contents.with_materials(path, remarks);
    remarks.extend(soup.note_more(path, &format!("{length} bytes"), [0, 0], bytes.get(length..).unwrap_or_default()));
    Ok(soup)
}

impl Contents {
    fn main(&mut self, bytes: Bytes<'_>) -> std::result::Result<(), Damage> {
        for item in chunks(bytes) {
            let (number, data) = item?;
            match number {
                chunk::EDITOR => self.editor(data)?,
                chunk::KEYFRAMER => {
                    let nodes = chunks(data).flatten().filter(|(number, _)| chunk::NODES.contains(number));
                    self.nodes.extend(nodes.enumerate().map(|(number, (_, data))| Node::read(number, data)));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Puts meshes where the animation's first frame has them; returns how many of them stand in several places.
    fn put_in_places(&mut self) -> usize {
        /// Matrices of so few digits move no mesh that stands where it was modelled; a share of its farthest place.
        const ROUNDING: f64 = 1e-5;
        let mut named: HashMap<&str, Vec<&Node>> = HashMap::new();
        self.nodes.iter().for_each(|node| named.entry(&node.name).or_default().push(node));
        let numbered = self.nodes.iter().rev().map(|node| (node.number, node)).collect();
        let mut several = 0;
        for (Mesh { positions, corners, matrix }, NamedPart { name, .. }) in self.meshes.iter().zip(&self.soup.parts) {
            let Some(nodes) = named.get(name.as_str()) else { continue };
            several += usize::from(nodes.len() > 1);
            let Some(matrix) = nodes[0].place(*matrix, &numbered) else { continue };
            let positions = &mut self.soup.positions[positions.clone()];
            let far = positions.iter().map(|position| position.length()).fold(0.0, f64::max);
            let place = |position: &DVec3| matrix.transform_point3(*position);
            if positions.iter().any(|position| place(position).distance(*position) > ROUNDING * far) {
                positions.iter_mut().for_each(|position| *position = place(position));
                let (triangles, _) = self.soup.corners[corners.clone()].as_chunks_mut::<3>();
                let is_mirrored = matrix.determinant() < 0.0;
                triangles.iter_mut().filter(|_| is_mirrored).for_each(|triangle| triangle.swap(1, 2));
            }
        }
        several
    }

    fn editor(&mut self, bytes: Bytes<'_>) -> std::result::Result<(), Damage> {
        for item in chunks(bytes) {
            match item? {
                (chunk::MATERIAL, _) if self.soup.materials.len() >= MATERIALS => return Err(Damage::Materials),
                (chunk::MATERIAL, data) => self.soup.materials.push(material(data)?),
                (chunk::OBJECT, mut data) => {
                    let name = data.text().ok_or(Damage::Part(chunk::OBJECT))?;
                    for item in chunks(data) {
                        if let (chunk::MESH, data) = item? {
                            self.mesh(&name, data)?;
                        }
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// One mesh: its parts may come in any order, so they are gathered first.
    fn mesh(&mut self, name: &str, bytes: Bytes<'_>) -> std::result::Result<(), Damage> {
        let (mut vertices, mut texture_coordinates, mut faces) = (Vec::new(), Vec::new(), None);
        let mut matrix = DMat4::IDENTITY;
        for item in chunks(bytes) {
            match item? {
                (chunk::VERTICES, data) => {
                    vertices = numbers::<3>(data).ok_or(Damage::Part(chunk::VERTICES))?;
                }
                (chunk::TEXTURE_COORDINATES, data) => {
                    texture_coordinates = numbers::<2>(data).ok_or(Damage::Part(chunk::TEXTURE_COORDINATES))?;
                }
                (chunk::FACES, data) => faces = Some(data),
                (chunk::MATRIX, mut data) => {
                    // Three axes and where they meet.
                    let [x, y, z, origin] = std::array::from_fn(|_| vector(data.floats().unwrap_or_default()));
                    matrix = DMat4::from_mat3_translation(DMat3::from_cols(x, y, z), origin);
                }
                _ => {}
            }
        }
        let (first_position, first_corner) = (self.soup.positions.len(), self.soup.corners.len());
        if let Some(faces) = faces {
            self.faces(faces, vertices.len(), texture_coordinates.len())?;
        }
        self.soup.positions.extend(vertices.into_iter().map(vector));
        self.soup.texture_coordinates.extend(texture_coordinates.into_iter().map(Vec2::from_array));
        let (positions, corners) = (first_position..self.soup.positions.len(), first_corner..self.soup.corners.len());
        if !corners.is_empty() {
            self.soup.polygon_parts.resize(corners.end / 3, self.meshes.len() as u32);
            self.soup.parts.push(NamedPart { name: name.to_owned(), within: NONE });
            self.meshes.push(Mesh { positions, corners, matrix });
        }
        Ok(())
    }

    /// A mesh's faces and their materials. Its vertices will follow those that are already there.
    fn faces(&mut self, mut bytes: Bytes<'_>, vertices: usize, textures: usize) -> std::result::Result<(), Damage> {
        /// Three indices and flags that say which sides are seen.
        const FACE_BYTES: usize = 8;
        let records = bytes.u16().and_then(|count| bytes.records(count.into(), FACE_BYTES));
        let records = records.ok_or(Damage::Part(chunk::FACES))?;
        let mut materials = vec![NONE; records.len()];
        for item in chunks(bytes) {
            if let (chunk::FACE_MATERIAL, data) = item? {
                let (name, faces) = face_material(data).ok_or(Damage::Part(chunk::FACE_MATERIAL))?;
                let place = self.material_names.len() as u32;
                self.material_names.push(name);
                for face in faces {
                    if let Some(material) = materials.get_mut(usize::from(face)) {
                        *material = place;
                    }
                }
            }
        }
        let first_position = self.soup.positions.len() as u32;
        let first_texture = self.soup.texture_coordinates.len() as u32;
        for (face, material) in records.zip(materials) {
            let mut face = Bytes(face);
            let indices = [face.u16(), face.u16(), face.u16()].map(Option::unwrap_or_default);
            if indices.iter().any(|index| usize::from(*index) >= vertices) {
                self.soup.defects.out_of_range_faces += 1;
                continue;
            }
            self.face_materials.push(material);
            self.soup.corners.extend(indices.map(|index| Corner {
                texture: if usize::from(index) < textures { first_texture + u32::from(index) } else { NONE },
                ..Corner::at(first_position + u32::from(index))
            }));
        }
        Ok(())
    }

    /// Gives faces the materials of the names they use; materials may have come after them.
    fn with_materials(self, path: &str, remarks: &mut Vec<String>) -> Soup {
        let Self { mut soup, face_materials, material_names, .. } = self;
        // Where a name comes more than once the first counts.
        let by_name: HashMap<&str, usize> =
            soup.materials.iter().enumerate().rev().map(|(place, material)| (material.name.as_str(), place)).collect();
        let places: Vec<Option<usize>> =
            material_names.iter().map(|name| by_name.get(name.as_str()).copied()).collect();
        let unknown: BTreeSet<&String> =
            material_names.iter().zip(&places).filter(|(_, place)| place.is_none()).map(|(name, _)| name).collect();
        if !unknown.is_empty() {
            let (are, their) = if unknown.len() == 1 { ("is", "its") } else { ("are", "their") };
            remarks.push(format!(
                "{path}: {} of the materials it uses {are} not in it; {their} faces get the default colour",
                unknown.len()
            ));
        }
        soup.defects.missing_materials = unknown.len();
        let known = |slot: u32| places.get(slot as usize).copied().flatten().map_or(NONE, |place| place as u32);
        soup.polygon_materials = face_materials.into_iter().map(known).collect();
        soup
    }
}

/// An object in the animation.
#[derive(Default)]
struct Node {
    name: String,
    number: u16,
    /// The number of the node that carries it, if there is one of that number.
    carrier: Option<u16>,
    pivot: [f32; 3],
    /// Where its pivot lies in its carrier's space.
    place: Option<[f32; 3]>,
    /// Clockwise by radians around an axis.
    turn: [f32; 4],
    scale: Option<[f32; 3]>,
}

impl Node {
    /// Reads a node up to its first damaged part; it may hold its number, in place of this one.
    fn read(number: usize, bytes: Bytes<'_>) -> Self {
        let mut node = Self { number: number as u16, ..Self::default() };
        for (number, mut data) in chunks(bytes).flatten() {
            match number {
                chunk::NODE_NUMBER => node.number = data.u16().unwrap_or(node.number),
                chunk::NODE_HEADER => {
                    node.name = data.text().unwrap_or_default();
                    // Behind two flags.
                    node.carrier = data.u32().and_then(|_| data.u16());
                }
                chunk::PIVOT => node.pivot = data.floats().unwrap_or_default(),
                chunk::PLACES => node.place = first_key(data),
                chunk::TURNS => node.turn = first_key(data).unwrap_or_default(),
                chunk::SCALES => node.scale = first_key(data),
                _ => {}
            }
        }
        node
    }

    /// From where the editor has the mesh, by its matrix, to where the animation first has it; `None` if that is unknown.
    fn place(&self, world_from_own: DMat4, numbered: &HashMap<u16, &Self>) -> Option<DMat4> {
        self.place?;
        let carriers = std::iter::successors(Some(self), |node| numbered.get(&node.carrier?).copied());
        let placed = carriers.take(NODE_LEVELS).fold(DMat4::IDENTITY, |own, node| node.carrier_from_own() * own);
        // Where the matrix mirrors, the animation turns the mesh's own x round.
        let mirrored = DMat4::from_scale(DVec3::new(world_from_own.determinant().signum(), 1.0, 1.0));
        let own = DMat4::from_translation(-vector(self.pivot)) * mirrored * world_from_own.inverse();
        Some(placed * own).filter(DMat4::is_finite)
    }

    fn carrier_from_own(&self) -> DMat4 {
        let [angle, axis @ ..] = self.turn.map(f64::from);
        let turn = DQuat::from_axis_angle(DVec3::from_array(axis).normalize_or(DVec3::Z), -angle);
        let (scale, place) = (self.scale.unwrap_or([1.0; 3]), self.place.unwrap_or_default());
        DMat4::from_scale_rotation_translation(vector(scale), turn, vector(place))
    }
}

/// A track's value in its first frame.
fn first_key<const N: usize>(mut track: Bytes<'_>) -> Option<[f32; N]> {
    /// Of the flags and lengths before the number of keys.
    const HEAD_BYTES: usize = 10;
    track.take(HEAD_BYTES)?;
    let (_keys, _frame) = (track.u32().filter(|keys| *keys > 0)?, track.u32()?);
    // Five bits say which numbers for splines stand before the values.
    let splines = (track.u16()? & 0x1f).count_ones() as usize;
    track.take(splines * size_of::<f32>())?;
    track.floats()
}

/// A file's vector in the precision that is computed with.
fn vector(of: [f32; 3]) -> DVec3 {
    DVec3::from_array(of.map(f64::from))
}

/// A count and that many groups of `N` floats.
fn numbers<const N: usize>(mut bytes: Bytes<'_>) -> Option<Vec<[f32; N]>> {
    let count = bytes.u16()?;
    bytes.records(count.into(), N * size_of::<f32>())?.map(|record| Bytes(record).floats()).collect()
}

/// A material's name and the numbers of the faces that have it.
fn face_material(mut bytes: Bytes<'_>) -> Option<(String, Vec<u16>)> {
    let name = bytes.text()?;
    let count = bytes.u16()?;
    let faces = bytes.records(count.into(), size_of::<u16>())?.filter_map(|record| Bytes(record).u16()).collect();
    Some((name, faces))
}

/// A material; its texture is the file's name for it until it is looked for.
fn material(bytes: Bytes<'_>) -> std::result::Result<Material, Damage> {
    let mut material = Material { name: String::new(), color: None, ..Material::default() };
    for item in chunks(bytes) {
        match item? {
            (chunk::MATERIAL_NAME, mut data) => {
                material.name = data.text().ok_or(Damage::Part(chunk::MATERIAL_NAME))?;
            }
            (chunk::DIFFUSE, data) => material.color = color(data)?,
            (chunk::TEXTURE, data) => {
                for item in chunks(data) {
                    if let (chunk::TEXTURE_FILE, mut data) = item? {
                        let name = data.text().ok_or(Damage::Part(chunk::TEXTURE_FILE))?;
                        material.texture = (!name.is_empty()).then(|| PathBuf::from(name));
                    }
                }
            }
            _ => {}
        }
    }
    Ok(material)
}

/// The first colour among the chunks: files may repeat it corrected for the screen's gamma.
fn color(bytes: Bytes<'_>) -> std::result::Result<Option<[f32; 3]>, Damage> {
    for item in chunks(bytes) {
        let (number, mut data) = item?;
        let color = if chunk::COLOR_FLOATS.contains(&number) {
            data.floats()
        } else if chunk::COLOR_BYTES.contains(&number) {
            data.take(3)
                .and_then(|bytes| bytes.first_chunk())
                .map(|bytes: &[u8; 3]| bytes.map(|c| f32::from(c) / 255.0))
        } else {
            continue;
        };
        let color = color.ok_or(Damage::Part(number))?;
        return Ok(color.iter().all(|channel| channel.is_finite()).then(|| color.map(|c| c.clamp(0.0, 1.0))));
    }
    Ok(None)
}

#[cfg(test)]
pub(super) mod tests;
