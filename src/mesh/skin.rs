//! Pictures that belong on a model: found beside it, or given with `--skin`.

use super::soup::Soup;
use super::{Material, NONE};
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// Extensions of pictures, in the order they are tried.
pub const EXTENSIONS: [&str; 6] = ["pcx", "png", "tga", "bmp", "jpg", "jpeg"];

/// A picture that a model file names, as the file writes it: where it says, or in the model's folder whatever folder it
/// says, in any case and, where it is not there, with any other extension of a picture.
///
/// Models name pictures as they lay on their author's disk, `C:\ART\SKIN.PCX`.
pub fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let slashes = name.replace('\\', "/");
    let written = [name, &slashes].map(|name| folder.join(name)).into_iter().find(|path| path.is_file());
    let base = slashes.rsplit('/').next().unwrap_or_default();
    written.or_else(|| beside(folder, base))
}

/// The picture of this name in a folder, in any case, or else the first with its stem and an extension of a picture.
fn beside(folder: &Path, base: &str) -> Option<PathBuf> {
    let stem = Path::new(base).file_stem()?.to_str()?;
    let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut found: Option<(usize, PathBuf)> = None;
    for entry in std::fs::read_dir(listed).ok()?.flatten() {
        let file = entry.file_name();
        let Some(name) = file.to_str() else { continue };
        let rank = if name.eq_ignore_ascii_case(base) {
            0
        } else {
            let path = Path::new(name);
            let same_stem = path.file_stem().is_some_and(|other| other.eq_ignore_ascii_case(stem));
            let known = |extension: &str| EXTENSIONS.iter().position(|known| known.eq_ignore_ascii_case(extension));
            match path.extension().and_then(|extension| extension.to_str()).and_then(known) {
                Some(place) if same_stem => place + 1,
                _ => continue,
            }
        };
        let candidate = (rank, folder.join(name));
        // The order of a folder's entries is nobody's promise: rank, then name decide.
        if found.as_ref().is_none_or(|best| candidate < *best) && candidate.1.is_file() {
            found = Some(candidate);
        }
    }
    found.map(|(_, path)| path)
}

/// Puts where each material's picture lies in place of the name the file has for it; one sentence for each that is
/// nowhere.
pub fn find_all(soup: &mut Soup, folder: &Path, path: &str, remarks: &mut Vec<String>) {
    let mut missing: Vec<String> = Vec::new();
    for material in &mut soup.materials {
        let Some(name) = material.texture.take() else { continue };
        let name = name.to_string_lossy();
        material.texture = find(folder, &name);
        if material.texture.is_none() && !missing.iter().any(|other| *other == name) {
            missing.push(name.into_owned());
        }
    }
    remarks.extend(missing.iter().map(|name| {
        format!(
            "{path}: the picture {name} is not beside it; its faces get the material's colour, or name one with --skin"
        )
    }));
}

/// Refuses a skin that is not there.
pub fn check(skin: &Path) -> Result<()> {
    if skin.is_file() {
        return Ok(());
    }
    let problem = if skin.is_dir() {
        "this is a directory; name a picture in it"
    } else if skin.exists() {
        "this is no ordinary file; name a picture"
    } else {
        "there is no such file; check the name after --skin"
    };
    Err(Error::picture(skin, problem))
}

/// Makes a picture the texture of every material; faces without one get one.
pub fn put_on(soup: &mut Soup, skin: &Path, path: &str) -> Result<()> {
    if soup.corners.iter().all(|corner| corner.texture == NONE) {
        return Err(Error::setting(
            format!("--skin {}", skin.display()),
            format!("{path} has no texture coordinates; export it with them, or leave the option out"),
        ));
    }
    soup.materials.iter_mut().for_each(|material| material.texture = Some(skin.to_path_buf()));
    soup.polygon_materials.resize(soup.polygon_count(), NONE);
    if soup.polygon_materials.contains(&NONE) {
        let added = soup.materials.len() as u32;
        soup.materials.push(Material { name: "skin".to_owned(), color: None, texture: Some(skin.to_path_buf()) });
        soup.polygon_materials.iter_mut().filter(|material| **material == NONE).for_each(|material| *material = added);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::soup::Corner;
    use glam::{DVec3, Vec2};

    #[test]
    fn pictures_are_found_where_written_then_beside_in_any_case_then_by_their_stem() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("art")).unwrap();
        std::fs::create_dir(at("trap.pcx")).unwrap();
        for name in ["art/deep.png", "Skin.PCX", "skin.bmp", "two words.png", "trap.jpg", "model.3ds"] {
            std::fs::write(at(name), "").unwrap();
        }
        let found = |name: &str| find(folder.path(), name);
        assert_eq!(found("art\\deep.png"), Some(at("art/deep.png")));
        assert_eq!(found("players/female/SKIN.BMP"), Some(at("skin.bmp")));
        assert_eq!(found("C:\\ART\\SKIN.TGA"), Some(at("Skin.PCX")), "pcx comes before bmp");
        assert_eq!(found("skin"), Some(at("Skin.PCX")));
        assert_eq!(found("my\\two words.tif"), Some(at("two words.png")));
        assert_eq!(found("trap.pcx"), Some(at("trap.jpg")), "a folder is no picture");
        for name in ["other.png", "model", "", "..", "art", "/", "\\"] {
            assert_eq!(found(name), None, "{name}");
        }
        assert_eq!(find(Path::new("/no/such/folder"), "skin.png"), None);
    }

    #[test]
    fn a_skin_goes_onto_all_materials_and_faces_without_one_get_one() {
        let corner = |position| Corner { texture: 0, ..Corner::at(position) };
        let material = Material { name: "red".to_owned(), color: Some([1.0, 0.0, 0.0]), texture: None };
        let mut soup = Soup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            texture_coordinates: vec![Vec2::ZERO],
            corners: [0, 1, 2, 2, 1, 0].map(corner).to_vec(),
            polygon_materials: vec![0, NONE],
            materials: vec![material],
            ..Soup::default()
        };
        put_on(&mut soup, Path::new("a.png"), "a.obj").unwrap();
        assert_eq!(soup.polygon_materials, [0, 1]);
        assert!(soup.materials.iter().all(|material| material.texture.as_deref() == Some(Path::new("a.png"))));
        soup.corners.iter_mut().for_each(|corner| corner.texture = NONE);
        let message = put_on(&mut soup, Path::new("a.png"), "a.obj").unwrap_err().to_string();
        assert!(message.starts_with("--skin a.png: a.obj has no texture coordinates"), "{message}");
    }

    #[test]
    fn a_skin_that_is_not_there_is_refused_by_name() {
        let message = |path: &str| check(Path::new(path)).unwrap_err().to_string();
        assert!(message("no-such.pcx").starts_with("no-such.pcx: there is no such file"));
        assert!(message("/").contains("directory"));
    }
}
