//! glTF 2.0, as JSON with its data beside it (`.gltf`) or all in one file (`.glb`): the default scene at rest.
//!
//! The gltf-json crate gives the JSON its types. Data, accessors and nodes are read here with checked look-ups only. The gltf
//! crate's readers trust every index and offset after validation, which ignores buffers, and its importer opens any file that a
//! buffer names. docs/guide/formats.md lists the supported and ignored parts.

mod accessors;
mod buffers;
mod cameras;
mod container;
mod edge_marks;
mod materials;
mod nodes;
mod parts;
mod uri;

use super::folder::Folder;
use super::options::LoadOptions;
use super::skin;
use super::soup::{Soup, is_too_much};
use crate::error::{Error, Result};
use crate::files::shown;
use accessors::Accessors;
use buffers::Buffers;
pub use cameras::camera;
pub(crate) use container::glb_container;
pub(crate) use edge_marks::EXTENSION as EDGES_EXTENSION;
use gltf_json::Root;
use materials::Materials;
pub(crate) use materials::to_linear;
use nodes::Nodes;
use parts::Outline;

/// Extensions that are read, or that do not affect the drawing.
const UNDERSTOOD: [&str; 5] =
    ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "KHR_xmp_json_ld", edge_marks::EXTENSION];

/// Reads a glTF or GLB file's bytes. `path` appears in messages; `folder` holds its data and pictures.
pub(super) fn read(
    bytes: &[u8],
    path: &str,
    options: &LoadOptions,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    let mut soup = contents(bytes, path, folder, remarks).map_err(|problem| Error::model(path, problem))?;
    if options.skin.is_none() {
        skin::find_all(&mut soup, folder, path, remarks);
    }
    Ok(soup)
}

/// The same; the error is a sentence without the file's name.
fn contents(
    bytes: &[u8],
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> std::result::Result<Soup, String> {
    let (json, data) = container::open(bytes)?;
    let root = container::parse(json)?;
    refuse_unknown_extensions(&root)?;
    let buffers = Buffers::of(&root, data, folder)?;
    let accessors = Accessors { root: &root, buffers: &buffers };
    let nodes = Nodes::of(&root)?;
    let Materials { list, coordinates, unread_pictures } = Materials::of(&root, &buffers, path)?;
    let mut soup =
        Soup { materials: list, files: buffers.files.clone(), bytes_beside: buffers.bytes_beside, ..Soup::default() };
    let said = edge_marks::Said::of(json)?;
    let outlines = parts::outlines(&nodes, &root, &accessors, &coordinates, &said)?;
    if outlines.is_empty() {
        return Err(match root.meshes.len() {
            0 => "it holds no meshes; is it the right file?".to_owned(),
            1 => "its scene does not show its mesh; export it with a node that does".to_owned(),
            count => format!("its scene shows none of its {count} meshes; export it with nodes that do"),
        });
    }
    refuse_too_much(&outlines, bytes.len() + buffers.bytes_beside)?;
    let left_out = Omissions { unread_pictures, ..Omissions::of(&root) };
    let (named, of_nodes) = nodes.parts(&root);
    for (outline, places) in &outlines {
        parts::put(&mut soup, outline, places, &accessors, &nodes, &of_nodes)?;
    }
    soup.parts = named;
    remarks.extend(left_out.sentence(path));
    Ok(soup)
}

/// Rejects a file that requires an unsupported extension, and advises how to avoid it.
fn refuse_unknown_extensions(root: &Root) -> std::result::Result<(), String> {
    match root.extensions_required.iter().find(|name| !is_understood(name) && !is_of_materials(name)) {
        None => Ok(()),
        Some(name) => {
            let remedy = match name.as_str() {
                "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
                    "decompress it, for instance with: gltf-transform copy IN.glb OUT.glb"
                }
                "KHR_texture_basisu" => "save its pictures as PNG, for instance with: gltf-transform ktxdecompress",
                "EXT_texture_webp" | "EXT_texture_avif" => {
                    "save its pictures as PNG, for instance with: gltf-transform png"
                }
                _ => "export it without that extension",
            };
            Err(format!("it needs the extension {}, which tinta does not read; {remedy}", shown(name)))
        }
    }
}

fn is_understood(extension: &str) -> bool {
    // Material extensions add to the base colour in ways that no style here draws.
    UNDERSTOOD.contains(&extension) || extension.starts_with("KHR_materials_")
}

/// Whether an extension affects materials alone, not meshes.
fn is_of_materials(extension: &str) -> bool {
    ["KHR_techniques_webgl", "KHR_technique_webgl"].contains(&extension)
}

/// Rejects meshes that nodes repeat too often for the file's size, before building them.
fn refuse_too_much(outlines: &[(Outline<'_>, Vec<usize>)], file_bytes: usize) -> std::result::Result<(), String> {
    let sum = |count: fn(&Outline<'_>) -> usize| -> usize {
        outlines
            .iter()
            .map(|(outline, places)| count(outline).saturating_mul(places.len()))
            .fold(0, usize::saturating_add)
    };
    let (vertices, triangles) = (sum(|outline| outline.vertices()), sum(|outline| outline.triangles()));
    if is_too_much(file_bytes, vertices, triangles.saturating_mul(3), triangles) {
        return Err(format!(
            "its nodes draw {vertices} vertices and {triangles} triangles, which take more than {} times the file's size in \
             memory; draw fewer of its parts at once",
            crate::limits::MEMORY_FACTOR
        ));
    }
    Ok(())
}

/// Counts of contents that are not drawn, for one remark.
#[derive(Default)]
struct Omissions {
    animations: usize,
    cameras: usize,
    scenes: usize,
    see_through: usize,
    /// Textures whose picture only an extension names.
    unread_pictures: usize,
    extensions: Vec<String>,
}

impl Omissions {
    fn of(root: &Root) -> Self {
        let unknown = root.extensions_used.iter().filter(|name| !is_understood(name));
        Self {
            animations: root.animations.len(),
            cameras: root.cameras.len(),
            scenes: root.scenes.len().saturating_sub(1),
            see_through: materials::see_through(root),
            extensions: unknown.map(|name| shown(name)).take(crate::limits::REMARKS).collect(),
            ..Self::default()
        }
    }

    fn sentence(&self, path: &str) -> Option<String> {
        let counted = |count: usize, one: &str, many: &str| match count {
            0 => None,
            1 => Some(format!("1 {one}")),
            count => Some(format!("{count} {many}")),
        };
        let mut parts: Vec<String> = [
            counted(self.see_through, "material's transparency", "materials' transparency"),
            counted(
                self.unread_pictures,
                "picture in an unsupported format or at an unsupported address",
                "pictures in unsupported formats or at unsupported addresses",
            ),
            counted(self.animations, "animation (drawn in its rest pose)", "animations (drawn in its rest pose)"),
            counted(self.scenes, "other scene", "other scenes"),
            counted(self.cameras, "camera", "cameras"),
        ]
        .into_iter()
        .flatten()
        .collect();
        parts.extend(self.extensions.iter().map(|name| format!("the extension {name}")));
        (!parts.is_empty()).then(|| format!("{path}: not drawn: {}", parts.join(", ")))
    }
}

#[cfg(test)]
pub(super) mod tests;
