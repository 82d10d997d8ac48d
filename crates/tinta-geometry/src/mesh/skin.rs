//! Pictures that belong on a model: found beside it, or given with `--skin`.

use super::folder::{Folder, Lookup, is_same};
use super::soup::Soup;
use super::{Material, NONE};
use crate::error::{Error, Result};
use crate::files::shown;
use crate::limits::REMARKS;
use std::collections::HashMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Extensions of pictures, in the order they are tried.
pub(super) const EXTENSIONS: [&str; 6] = ["pcx", "png", "tga", "bmp", "jpg", "jpeg"];

/// A picture that a model file names.
pub(super) struct SkinFile {
    pub lookup: Lookup,
    /// A sentence if a picture beside the model stands for the one named, which lies in another folder or nowhere.
    pub remark: Option<String>,
}

/// Finds a picture that a model file names: at the path that the file gives, or in the model's folder, in any case and, where it
/// is not there, with any other extension of a picture. Models name pictures as they lay on their author's disk,
/// `C:\ART\SKIN.PCX`. The path counts from the folder `below` that of the model, where the file lies that names the picture; then
/// from the model's. `is_outside` says that the path was found outside the folder already.
pub(super) fn find(folder: &Folder<'_>, below: &Path, name: &str, is_outside: bool) -> SkinFile {
    let mut best = if is_outside { Lookup::Outside } else { Lookup::Nowhere };
    match exactly(folder, below, name) {
        Lookup::Nowhere => {}
        Lookup::Outside => best = Lookup::Outside,
        here @ Lookup::Here(_) => return SkinFile { lookup: here, remark: None },
    }
    let slashes = name.replace('\\', "/");
    let (path, base) = slashes.rsplit_once('/').unwrap_or(("", &slashes));
    match first_here(below, |place| beside(folder, place, base)) {
        Lookup::Nowhere => SkinFile { lookup: best, remark: None },
        lookup => SkinFile { remark: stand_in(folder, name, path, &lookup, best == Lookup::Outside), lookup },
    }
}

/// Finds the picture at the path that a file gives.
pub(super) fn exactly(folder: &Folder<'_>, below: &Path, name: &str) -> Lookup {
    first_here(below, |place| folder.find_written(place, name))
}

/// Searches the folder `below` the model's, then the model's.
fn first_here(below: &Path, find: impl Fn(&Path) -> Lookup) -> Lookup {
    match find(below) {
        here @ Lookup::Here(_) => here,
        other if below.as_os_str().is_empty() => other,
        other => match find(Path::new("")) {
            Lookup::Nowhere => other,
            found => found,
        },
    }
}

/// A sentence where a picture beside a model stands for one of another folder: one that is there, or one whose folder has another
/// name than the model's.
fn stand_in(folder: &Folder<'_>, name: &str, path: &str, found: &Lookup, is_outside: bool) -> Option<String> {
    let Lookup::Here(found) = found else { return None };
    let own = folder.name_of_parent(found)?;
    let named = path.rsplit('/').next().unwrap_or_default();
    if !is_outside && (["", "."].contains(&named) || named.eq_ignore_ascii_case(&own)) {
        return None;
    }
    let why =
        if is_outside { "which is outside its folder; --allow-external reads that" } else { "which was not found" };
    let base = found.file_name()?.to_string_lossy();
    Some(format!("{} beside it stands for {}, {why}", shown(&base), shown(name)))
}

/// Pictures in a model's folder that may be its skin, a few of them: those that begin like it, and all PCX files.
pub(super) fn lying_there(folder: &Folder<'_>, stem: &str) -> Vec<String> {
    const MOST: usize = 3;
    let stem = stem.to_lowercase();
    let may_be = |name: &String| {
        let name = name.to_lowercase();
        let extension = Path::new(&name).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        EXTENSIONS.contains(&extension) && (name.starts_with(&stem) || extension == EXTENSIONS[0])
    };
    let all = folder.names(Path::new(""));
    let mut names: Vec<String> = all.iter().map(|name| shown(&name.to_string_lossy())).filter(may_be).collect();
    names.sort_unstable_by_key(|name| (!name.to_lowercase().starts_with(&stem), name.clone()));
    names.truncate(MOST);
    names
}

/// The picture of this name in a folder below, in any case, or else the first with its stem and an extension of a picture.
fn beside(folder: &Folder<'_>, below: &Path, base: &str) -> Lookup {
    let Some(stem) = Path::new(base).file_stem().and_then(|stem| stem.to_str()) else { return Lookup::Nowhere };
    let rank = |name: &OsStr| {
        if is_same(name, OsStr::new(base)) {
            return Some(0);
        }
        let path = Path::new(name);
        let same_stem = path.file_stem().is_some_and(|other| is_same(other, OsStr::new(stem)));
        let extension = path.extension().and_then(|extension| extension.to_str()).filter(|_| same_stem)?;
        Some(EXTENSIONS.iter().position(|known| known.eq_ignore_ascii_case(extension))? + 1)
    };
    let names = folder.names(below);
    let mut candidates: Vec<(usize, &OsString)> = names.iter().filter_map(|name| Some((rank(name)?, name))).collect();
    // A folder's entries have no fixed order: rank, then name decide.
    candidates.sort_unstable();
    let mut best = Lookup::Nowhere;
    for (_, name) in candidates {
        match folder.find(&below.join(name)) {
            found @ Lookup::Here(_) => return found,
            Lookup::Outside => best = Lookup::Outside,
            Lookup::Nowhere => {}
        }
    }
    best
}

/// Puts where each material's picture lies in place of the name the file has for it; a sentence for each that is
/// nowhere, or outside the model's folder.
pub(super) fn find_all(soup: &mut Soup, folder: &Folder<'_>, path: &str, remarks: &mut Vec<String>) {
    let mut known: HashMap<(&Path, PathBuf), Lookup> = HashMap::new();
    let mut lost = Vec::new();
    for (number, material) in soup.materials.iter_mut().enumerate() {
        let Some(name) = material.texture.take().filter(|_| folder.is_some()) else { continue };
        let below = soup.material_folders.get(number).map_or(Path::new(""), PathBuf::as_path);
        let found = known.entry((below, name)).or_insert_with_key(|(below, name)| {
            let name = name.to_string_lossy();
            let SkinFile { lookup, remark } = find(folder, below, &name, false);
            lost.extend(remark);
            match &lookup {
                Lookup::Here(_) => {}
                Lookup::Outside => lost.push(outside("picture", &name)),
                Lookup::Nowhere => lost.push(format!(
                    "the picture {} is not beside it; its faces get the material's colour; --skin names another \
                     picture",
                    shown(&name)
                )),
            }
            lookup
        });
        if let Lookup::Here(place) = found {
            folder.put_picture(material, place.clone());
        }
    }
    remark(path, lost, "pictures are missing or were not read", remarks);
}

/// Why an existing file is not read.
pub(super) fn outside(what: &str, name: &str) -> String {
    format!("the {what} {} is outside its folder and was not read; --allow-external reads it", shown(name))
}

/// Says the first of some sentences about a file, and how many more there are.
pub(super) fn remark(path: &str, sentences: Vec<String>, others: &str, remarks: &mut Vec<String>) {
    let more = sentences.len().saturating_sub(REMARKS);
    remarks.extend(sentences.iter().take(REMARKS).map(|sentence| format!("{path}: {sentence}")));
    if more > 0 {
        remarks.push(format!("{path}: {more} more {others}"));
    }
}

/// Makes a picture the texture of every material; faces without one get one.
pub(super) fn put_on(soup: &mut Soup, skin: &Path, path: &str) -> Result<()> {
    if soup.corners.iter().all(|corner| corner.texture == NONE) {
        return Err(Error::value(
            "skin",
            skin.display(),
            format!("{path} has no texture coordinates; export it with them, or leave the option out"),
        ));
    }
    for material in &mut soup.materials {
        // Whoever names it himself may have it anywhere.
        let Material { name, color, .. } = std::mem::take(material);
        *material = Material { name, color, texture: Some(skin.to_path_buf()), ..Material::default() };
    }
    soup.polygon_materials.resize(soup.polygon_count(), NONE);
    if soup.polygon_materials.contains(&NONE) {
        let added = soup.materials.len() as u32;
        let texture = Some(skin.to_path_buf());
        soup.materials.push(Material { name: "skin".to_owned(), color: None, texture, ..Material::default() });
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
        let model = at("model.3ds");
        let found =
            |name: &str| match find(&Folder::of(model.to_str().unwrap(), false), Path::new(""), name, false).lookup {
                Lookup::Here(path) => Some(path),
                other => {
                    assert_eq!(other, Lookup::Nowhere, "{name}");
                    None
                }
            };
        assert_eq!(found("art\\deep.png"), Some(at("art/deep.png")));
        assert_eq!(found("players/female/SKIN.BMP"), Some(at("skin.bmp")));
        assert_eq!(found("C:\\ART\\SKIN.TGA"), Some(at("Skin.PCX")), "pcx comes before bmp");
        assert_eq!(found("skin"), Some(at("Skin.PCX")));
        assert_eq!(found("my\\two words.tif"), Some(at("two words.png")));
        assert_eq!(found("trap.pcx"), Some(at("trap.jpg")), "a folder is no picture");
        for name in ["other.png", "model", "", "..", "art", "/", "\\"] {
            assert_eq!(found(name), None, "{name}");
        }
        let nowhere = |folder: &Folder<'_>, name| find(folder, Path::new(""), name, false).lookup == Lookup::Nowhere;
        assert!(nowhere(&Folder::of("/no/such/folder/a.obj", false), "skin.png"));
        assert!(nowhere(&Folder::of_files(&[]), "/etc/passwd"));
    }

    #[test]
    fn files_out_of_memory_are_found_by_their_names_in_any_case_and_a_single_library_by_any() {
        let files: [(&str, &[u8]); 3] = [("Wood.PNG", b"wood"), ("art/deep.png", b"deep"), ("other.mtl", b"library")];
        let folder = Folder::of_files(&files);
        let found = |name: &str| match find(&folder, Path::new(""), name, false).lookup {
            Lookup::Here(path) => Some(path),
            _ => None,
        };
        assert_eq!(found("C:\\ART\\wood.png"), Some(PathBuf::from("Wood.PNG")));
        assert_eq!(found("wood.tga"), Some(PathBuf::from("Wood.PNG")), "another extension");
        assert_eq!(found("art\\deep.png"), Some(PathBuf::from("art/deep.png")));
        assert_eq!(found("stone.png"), None);
        let Lookup::Here(library) = folder.find_library("scene.mtl") else { panic!("the only library is found") };
        assert_eq!(folder.read_found(&library, 7).unwrap(), &b"library"[..]);
        assert!(folder.read_found(&library, 6).is_err() && folder.read("scene.bin".as_ref(), 7).is_err());
        let two: [(&str, &[u8]); 2] = [("a.mtl", b"a"), ("b.mtl", b"b")];
        assert_eq!(Folder::of_files(&two).find_library("c.mtl"), Lookup::Nowhere);
        assert!(!Folder::of_files(&[]).is_some() && folder.is_some());
    }

    #[test]
    fn a_skin_goes_onto_all_materials_and_faces_without_one_get_one() {
        let corner = |position| Corner { texture: 0, ..Corner::at(position) };
        let material = Material { name: "red".to_owned(), color: Some([1.0, 0.0, 0.0]), ..Material::default() };
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
        assert!(message.starts_with("skin a.png: a.obj has no texture coordinates"), "{message}");
    }
}
