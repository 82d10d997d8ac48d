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
mod extensions;
mod instances;
mod materials;
mod nodes;
mod outline;
mod parts;
mod uri;

use super::folder::Folder;
use super::left_out::{self, counted};
use super::soup::Soup;
use crate::error::{Error, Result};
use crate::files::shown;
use crate::memory;
use accessors::Accessors;
use buffers::Buffers;
pub use cameras::camera;
use container::Parts;
pub(super) use container::looks_like;
use gltf_json::Root;
use materials::{LeftOut, Materials};
use nodes::Nodes;

/// Reads a glTF or GLB file's bytes. `path` appears in messages; `folder` holds its data and pictures.
pub(super) fn read(bytes: &[u8], path: &str, folder: &Folder<'_>, remarks: &mut Vec<String>) -> Result<Soup> {
    contents(bytes, path, folder, remarks).map_err(|problem| Error::model(path, problem))
}

/// The same; the error is a sentence without the file's name.
fn contents(
    bytes: &[u8],
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> std::result::Result<Soup, String> {
    let Parts { json, data, unread } = container::open(bytes)?;
    let root = container::parse(json)?;
    extensions::refuse_unknown(&root)?;
    let buffers = Buffers::of(&root, data, folder);
    let accessors = Accessors { root: &root, buffers: &buffers };
    let nodes = Nodes::of(&root)?;
    let Materials { list, coordinates, left_out } = Materials::of(&root, &buffers, path);
    let outlines = outline::outlines(&nodes, &accessors, &coordinates)?;
    if outlines.is_empty() {
        return Err(match root.meshes.len() {
            0 => "it holds no meshes; is it the right file?".to_owned(),
            1 => "its scene does not show its mesh; export it with a node that does".to_owned(),
            count => format!("its scene shows none of its {count} meshes; export it with nodes that do"),
        });
    }
    outline::refuse_too_much(&outlines, &accessors, bytes.len() + buffers.bytes_beside, memory::free())?;
    remarks.extend(outline::many_copies(&outlines).map(|sentence| format!("{path}: {sentence}")));
    let mut soup = Soup {
        materials: list,
        files: buffers.files.clone(),
        bytes_beside: buffers.bytes_beside,
        has_copies: true,
        ..Soup::default()
    };
    let (named, of_nodes) = nodes.parts(&root);
    for outline in &outlines {
        parts::put(&mut soup, outline, &accessors, &nodes, &of_nodes)?;
    }
    soup.parts = named;
    remarks.extend(soup.note_more(path, &format!("{} bytes", bytes.len() - unread.len()), [0, 0], unread));
    remarks.extend(not_drawn(&root, left_out, path));
    Ok(soup)
}

/// A sentence about contents that are not drawn, if there are any.
fn not_drawn(root: &Root, of_materials: LeftOut, path: &str) -> Option<String> {
    let LeftOut { pictures, empty_textures, emission, emission_as_color } = of_materials;
    let see_through = materials::see_through(root);
    let mut parts: Vec<String> =
        counted(see_through, "material's transparency", "materials' transparency").into_iter().collect();
    parts.extend(left_out::emission(emission_as_color, emission));
    let others = [
        counted(
            pictures,
            "picture in an unsupported format or at an unsupported address",
            "pictures in unsupported formats or at unsupported addresses",
        ),
        counted(empty_textures, "texture that names no picture", "textures that name no picture"),
        counted(root.animations.len(), "animation (drawn in its rest pose)", "animations (drawn in its rest pose)"),
        counted(root.scenes.len().saturating_sub(1), "other scene", "other scenes"),
        counted(root.cameras.len(), "camera", "cameras"),
    ];
    parts.extend(others.into_iter().flatten());
    let extensions = || extensions::not_drawn(root, pictures > 0);
    parts.extend(extensions().take(crate::limits::REMARKS).map(|name| format!("the extension {}", shown(name))));
    let remedy = extensions().find_map(extensions::pictures_remedy);
    let remedy = remedy.map(|remedy| format!("; {remedy}")).unwrap_or_default();
    (!parts.is_empty()).then(|| format!("{path}: not drawn: {}{remedy}", parts.join(", ")))
}

#[cfg(test)]
pub(super) mod tests;
