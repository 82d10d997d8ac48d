//! What libassimp read of a file, as polygons in one space.
//!
//! The library stands models upright, whatever axis is up in their format, so that nothing is turned here but by `--up-axis`.

use super::imported::{Imported, ImportedMaterial, ImportedMesh};
use super::library::{self, Files};
use crate::error::{Error, Result};
use crate::files::shown;
use crate::limits::MATERIALS;
use crate::mesh::folder::Folder;
use crate::mesh::load::LoadOptions;
use crate::mesh::soup::{Corner, Soup, is_too_much};
use crate::mesh::{Material, NONE, skin};
use glam::{DMat3, DMat4, DVec3, Vec2};
use std::path::Path;

/// Reads a file's bytes as the library reads this format. `path` is for messages; files it names are looked for in `folder`.
pub(crate) fn read(
    bytes: &[u8],
    format: &str,
    path: &str,
    options: &LoadOptions,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    library::check().map_err(|reason| {
        Error::model(
            path,
            format!(
                "{format} is read by libassimp, {}; install it, on Debian: apt-get install libassimp5, or save the model as OBJ",
                shown(&reason)
            ),
        )
    })?;
    // Its ending tells the library the format, and its stem files that belong to it.
    let name = Path::new(path).file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let mut files = Files::new(bytes, name.to_owned(), folder);
    let imported = library::import(&mut files).map_err(|reason| {
        let reason = shown(reason.trim());
        Error::model(path, format!("libassimp cannot read it ({reason}); it is damaged or misnamed, export it again"))
    })?;
    let outside = files.outside.iter().map(|name| skin::outside("file", name)).collect();
    skin::remark(path, outside, "files were not read", remarks);
    let mut soup = soup_of(&imported, bytes.len() + files.bytes_beside(), path, remarks)?;
    (soup.files, soup.bytes_beside) = (std::mem::take(&mut files.opened), files.bytes_beside());
    if options.skin.is_none() {
        skin::find_all(&mut soup, folder, path, remarks);
    }
    Ok(soup)
}

fn soup_of(imported: &Imported, file_bytes: usize, path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    if imported.materials.len() > MATERIALS {
        return Err(Error::model(path, format!("it has more than {MATERIALS} materials; merge some")));
    }
    refuse_too_much(imported, file_bytes, path)?;
    let mut soup = Soup { materials: imported.materials.iter().map(material).collect(), ..Soup::default() };
    let mut scene_from_node: Vec<DMat4> = Vec::new();
    let mut others = 0;
    for node in &imported.nodes {
        let parent_from_node = DMat4::from_cols_array(&node.matrix.map(f64::from)).transpose();
        let above = node.parent.and_then(|parent| scene_from_node.get(parent)).copied().unwrap_or(DMat4::IDENTITY);
        let place = above * parent_from_node;
        scene_from_node.push(place);
        for mesh in &node.meshes {
            others += put(&mut soup, imported, *mesh as usize, &place);
        }
    }
    let not_drawn = [
        (others, "points and lines"),
        (imported.animations, "its animations (drawn in its rest pose)"),
        (imported.meshes.iter().filter(|mesh| mesh.has_colors).count(), "colours at vertices"),
    ];
    let not_drawn: Vec<&str> = not_drawn.iter().filter(|(count, _)| *count > 0).map(|(_, what)| *what).collect();
    if !not_drawn.is_empty() {
        remarks.push(format!("{path}: not drawn: {}", not_drawn.join(", ")));
    }
    Ok(soup)
}

/// Refuses meshes that nodes repeat beyond what the file is worth.
fn refuse_too_much(imported: &Imported, file_bytes: usize, path: &str) -> Result<()> {
    let meshes =
        || imported.nodes.iter().flat_map(|node| &node.meshes).filter_map(|mesh| imported.meshes.get(*mesh as usize));
    let sum = |count: fn(&ImportedMesh) -> usize| meshes().map(count).fold(0, usize::saturating_add);
    let (vertices, corners) = (sum(|mesh| mesh.positions.len()), sum(|mesh| mesh.indices.len()));
    if is_too_much(file_bytes, vertices, corners, corners) {
        return Err(Error::model(
            path,
            format!(
                "its {vertices} vertices and {corners} corners take more than {} times the file's size in memory; \
                 draw fewer of its parts at once",
                crate::limits::MEMORY_FACTOR
            ),
        ));
    }
    Ok(())
}

fn material(material: &ImportedMaterial) -> Material {
    let color = material.color.filter(|color| color.iter().all(|channel| channel.is_finite()));
    // A number behind an asterisk is a picture that the library holds itself.
    let texture = material.texture.as_ref().filter(|name| !name.starts_with('*'));
    Material {
        name: material.name.clone(),
        color: color.map(|color| color.map(|channel| channel.clamp(0.0, 1.0))),
        texture: texture.map(Into::into),
        ..Material::default()
    }
}

/// Adds a mesh where a node has it; returns how many of its faces are points or lines.
fn put(soup: &mut Soup, imported: &Imported, mesh: usize, place: &DMat4) -> usize {
    let Some(mesh) = imported.meshes.get(mesh) else { return 0 };
    let first = |is_empty: bool, length: usize| if is_empty { NONE } else { length as u32 };
    let first_position = soup.positions.len() as u32;
    let first_normal = first(mesh.normals.is_empty(), soup.normals.len());
    let first_texture = first(mesh.texture_coordinates.is_empty(), soup.texture_coordinates.len());
    let point = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
    soup.positions.extend(mesh.positions.iter().map(|position| place.transform_point3(point(position))));
    let linear = DMat3::from_mat4(*place);
    let (turn, is_mirrored) = (linear.inverse().transpose(), linear.determinant() < 0.0);
    // The library writes NaN where it has no normal; one is then computed, as for 0.
    soup.normals.extend(mesh.normals.iter().map(|normal| (turn * point(normal)).normalize_or_zero().as_vec3()));
    soup.texture_coordinates.extend(mesh.texture_coordinates.iter().map(|[u, v, _]| Vec2::new(*u, *v)));
    let material = if (mesh.material as usize) < imported.materials.len() { mesh.material } else { NONE };
    let (mut rest, mut others) = (mesh.indices.as_slice(), 0);
    for size in &mesh.sizes {
        let Some((corners, after)) = rest.split_at_checked(*size as usize) else { break };
        rest = after;
        if corners.len() < 3 {
            others += 1;
            continue;
        }
        if corners.iter().any(|index| *index as usize >= mesh.positions.len()) {
            soup.defects.out_of_range_faces += 1;
            continue;
        }
        let from = |first: u32, index: u32| if first == NONE { NONE } else { first + index };
        let start = soup.corners.len();
        soup.corners.extend(corners.iter().map(|index| Corner {
            position: first_position + index,
            normal: from(first_normal, *index),
            texture: from(first_texture, *index),
        }));
        if is_mirrored {
            soup.corners[start..].reverse();
        }
        soup.polygon_sizes.push(*size);
        soup.polygon_materials.push(material);
    }
    others
}
