//! Quake 2 models (MD2, version 8): one frame, or a place between two, with its skin. The reader is our own: small, and
//! every byte it looks at goes through [`Bytes`].
//!
//! In the file x is forward, y left and z up, triangles are clockwise and texture coordinates count texels from the upper
//! left. The latter two are turned here to this program's: counter-clockwise, shares from the lower left. The file's normals, numbers into a table of the game's, are not used:
//! they are computed. Layout: the game's `dmdl_t` and its tables, as its authors published it.

use super::Material;
use super::folder::{Folder, Lookup};
use super::frame::Between;
use super::options::LoadOptions;
use super::skin::{self, SkinFile};
use super::soup::{Corner, Soup};
use crate::bytes::{Bytes, name};
use crate::error::{Error, Result};
use crate::limits::SKINS;
use glam::{DVec3, Vec2};
use std::path::{Path, PathBuf};

/// What every file begins with.
const MAGIC: &[u8] = b"IDP2";

const VERSION: usize = 8;
const SKIN_BYTES: usize = 64;
const TEXTURE_COORDINATE_BYTES: usize = 4;
const TRIANGLE_BYTES: usize = 12;
const VERTEX_BYTES: usize = 4;
/// Scale, translation and name, before the vertices.
const FRAME_HEADER_BYTES: usize = 40;
const FRAME_NAME_BYTES: usize = 16;

/// The numbers a file begins with, in its order, without the magic.
struct Header {
    version: usize,
    skin_width: usize,
    skin_height: usize,
    frame_bytes: usize,
    skins: usize,
    vertices: usize,
    texture_coordinates: usize,
    triangles: usize,
    frames: usize,
    skins_at: usize,
    texture_coordinates_at: usize,
    triangles_at: usize,
    frames_at: usize,
    end: usize,
}

impl Header {
    fn read(bytes: &[u8]) -> Option<Self> {
        let mut bytes = Bytes(bytes.strip_prefix(MAGIC)?);
        let mut next = || bytes.u32().map(|number| number as usize);
        Some(Self {
            version: next()?,
            skin_width: next()?,
            skin_height: next()?,
            frame_bytes: next()?,
            skins: next()?,
            vertices: next()?,
            texture_coordinates: next()?,
            triangles: next()?,
            // Behind the number of GL commands, and below behind their place.
            frames: next().and(next())?,
            skins_at: next()?,
            texture_coordinates_at: next()?,
            triangles_at: next()?,
            frames_at: next()?,
            end: next().and(next())?,
        })
    }

    /// What contradicts itself whatever the file holds.
    fn problem(&self) -> Option<String> {
        if self.version != VERSION {
            return Some(format!("it is MD2 version {}; only version {VERSION} (Quake 2) is read", self.version));
        }
        if self.frames == 0 {
            return Some("it holds no frames; export it again with at least one".to_owned());
        }
        let needed = self.vertices.saturating_mul(VERTEX_BYTES).saturating_add(FRAME_HEADER_BYTES);
        (self.frame_bytes < needed).then(|| {
            format!(
                "its frames have {} bytes but {} vertices need {needed}; it is damaged, export it again",
                self.frame_bytes, self.vertices
            )
        })
    }
}

/// Whether a file begins like MD2.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Reads an MD2 file's bytes. `path` is for messages; `folder` holds its skin.
pub(super) fn read(
    bytes: &[u8],
    path: &str,
    options: &LoadOptions,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    if !bytes.starts_with(MAGIC) {
        let problem = "it does not begin like an MD2 file; it is damaged or misnamed, export it again";
        return Err(Error::model(path, problem));
    }
    let cut_off = |promise: String| {
        let has = bytes.len();
        Error::model(path, format!("{promise} but the file has {has}; it is damaged or cut off, export it again"))
    };
    let header = Header::read(bytes).ok_or_else(|| cut_off("its header has 68 bytes".to_owned()))?;
    if let Some(problem) = header.problem() {
        return Err(Error::model(path, problem));
    }
    if header.end > bytes.len() {
        return Err(cut_off(format!("its header promises {} bytes", header.end)));
    }
    let table = |what: &str, at: usize, count: usize, size: usize| {
        let records = bytes.get(at..).and_then(|rest| Bytes(rest).records(count, size));
        records.ok_or_else(|| cut_off(format!("its header promises {count} {what} of {size} bytes from byte {at}")))
    };
    let skins = table("skins", header.skins_at, header.skins, SKIN_BYTES)?;
    let (texels_at, texels) = (header.texture_coordinates_at, header.texture_coordinates);
    let texels = table("texture coordinates", texels_at, texels, TEXTURE_COORDINATE_BYTES)?;
    let triangles = table("triangles", header.triangles_at, header.triangles, TRIANGLE_BYTES)?;
    let frames = table("frames", header.frames_at, header.frames, header.frame_bytes)?;

    let names: Vec<String> = frames.clone().map(frame_name).collect();
    let between = options.model_frame.find(&names, path)?;
    let mut soup = Soup {
        positions: positions(frames, between, header.vertices),
        texture_coordinates: texels.map(|texel| texture_coordinate(texel, &header)).collect(),
        frames: names,
        has_pictures: true,
        ..Soup::default()
    };
    for triangle in triangles {
        match corners(triangle, &header) {
            Some(corners) => soup.corners.extend(corners),
            None => soup.defects.out_of_range_faces += 1,
        }
    }
    let mut skin = Material { name: "skin".to_owned(), color: None, ..Material::default() };
    let names = skins.take(SKINS).map(name);
    if let Some(found) = options.skin.is_none().then(|| find_skin(names, path, folder, remarks)).flatten() {
        folder.put_picture(&mut skin, found);
    }
    let end = header.end.max(header.frames_at + header.frames * header.frame_bytes);
    remarks.extend(soup.note_more(path, &format!("{} bytes", header.end), [0, 0], &bytes[end..]));
    soup.polygon_materials = vec![0; soup.polygon_count()];
    soup.materials = vec![skin];
    Ok(soup)
}

fn frame_name(frame: &[u8]) -> String {
    let field = frame.get(FRAME_HEADER_BYTES - FRAME_NAME_BYTES..FRAME_HEADER_BYTES);
    name(field.unwrap_or_default())
}

/// The vertices of a frame or between two, in the file's axes and units.
fn positions<'a>(frames: impl Iterator<Item = &'a [u8]> + Clone, between: Between, count: usize) -> Vec<DVec3> {
    let of = |frame: usize| frames.clone().nth(frame).and_then(|frame| vertices(frame, count)).unwrap_or_default();
    let first = of(between.first);
    if between.share == 0.0 {
        return first;
    }
    first.into_iter().zip(of(between.second)).map(|(from, to)| from.lerp(to, between.share)).collect()
}

/// A frame's vertices: bytes, scaled and moved by the numbers at the frame's start.
fn vertices(frame: &[u8], count: usize) -> Option<Vec<DVec3>> {
    let mut bytes = Bytes(frame);
    let [scale, translation] =
        [bytes.floats::<3>()?, bytes.floats::<3>()?].map(|v| DVec3::from_array(v.map(f64::from)));
    bytes.take(FRAME_NAME_BYTES)?;
    let place = |vertex: &[u8]| {
        let [x, y, z, _normal] = vertex.first_chunk().copied().unwrap_or_default().map(f64::from);
        DVec3::new(x, y, z) * scale + translation
    };
    Some(bytes.records(count, VERTEX_BYTES)?.map(place).collect())
}

/// Turns forward x, left y and up z into +z, +x and +y: a rotation.
pub(super) fn to_y_up(v: DVec3) -> DVec3 {
    DVec3::new(v.y, v.z, v.x)
}

fn texture_coordinate(texel: &[u8], header: &Header) -> Vec2 {
    let mut bytes = Bytes(texel);
    let mut texel = || f32::from(bytes.i16().unwrap_or_default());
    let [s, t] = [texel(), texel()];
    // A skin without size has no texels to share out.
    let [width, height] = [header.skin_width, header.skin_height].map(|size| size.max(1) as f32);
    Vec2::new(s / width, 1.0 - t / height)
}

/// A triangle's corners, counter-clockwise; `None` if an index is out of range.
fn corners(triangle: &[u8], header: &Header) -> Option<[Corner; 3]> {
    let mut bytes = Bytes(triangle);
    let mut indices = || -> Option<[u16; 3]> { Some([bytes.u16()?, bytes.u16()?, bytes.u16()?]) };
    let (positions, textures) = (indices()?, indices()?);
    let in_range = |indices: [u16; 3], count: usize| indices.iter().all(|index| usize::from(*index) < count);
    (in_range(positions, header.vertices) && in_range(textures, header.texture_coordinates)).then(|| {
        [0, 2, 1].map(|corner| {
            let [position, texture] = [positions[corner], textures[corner]].map(u32::from);
            Corner { texture, ..Corner::at(position) }
        })
    })
}

/// The first of the skins a file names that is beside it, or a picture that has the model's own name.
fn find_skin(
    names: impl Iterator<Item = String>,
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Option<PathBuf> {
    let own = Path::new(path).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let mut outside = Vec::new();
    for name in names.filter(|name| !name.is_empty()).chain(own.clone()) {
        let from_above = folder.find_from_above(Path::new(&name.replace('\\', "/")));
        if let Lookup::Here(place) = from_above {
            return Some(place);
        }
        let SkinFile { lookup, remark } = skin::find(folder, Path::new(""), &name, from_above == Lookup::Outside);
        remarks.extend(remark.map(|remark| format!("{path}: {remark}")));
        match lookup {
            Lookup::Here(place) => return Some(place),
            Lookup::Nowhere => {}
            Lookup::Outside => outside.push(skin::outside("skin", &name)),
        }
    }
    if outside.is_empty() && folder.is_some() {
        let extensions = skin::EXTENSIONS.join(", .");
        let remedy = match skin::lying_there(folder, &own.unwrap_or_default()).as_slice() {
            [] => "name one with --skin".to_owned(),
            pictures => format!("--skin takes another, for instance of those there: {}", pictures.join(", ")),
        };
        remarks.push(format!(
            "{path}: no skin was found beside it, neither one it names nor a .{extensions} of its own name; {remedy}"
        ));
    }
    skin::remark(path, outside, "skins were not read", remarks);
    None
}

#[cfg(test)]
pub(super) mod tests;
