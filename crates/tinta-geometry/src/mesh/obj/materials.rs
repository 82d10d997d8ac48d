//! MTL: the material files that an OBJ file names, and its faces' materials.

use super::chunk::Naming;
use crate::error::{Error, Result};
use crate::files::{Failure, shown};
use crate::limits::{MATERIAL_FILE_BYTES, MATERIAL_FILES, MATERIALS};
use crate::mesh::folder::Folder;
use crate::mesh::soup::Soup;
use crate::mesh::{Material, NONE, skin, text};
use glam::Vec2;
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

/// Returns the text of a material library with its files, or a sentence on its absence. A name that is no file is split at
/// blanks into several names. Empty if the folder holds no files.
pub(super) fn library<'a>(
    folder: &Folder<'a>,
    name: &str,
) -> std::result::Result<(Cow<'a, [u8]>, Vec<PathBuf>), String> {
    if !folder.is_some() {
        return Ok((Cow::Borrowed(b""), Vec::new()));
    }
    let name = unquoted(name);
    let read = |name: &str| folder.read_library(name, MATERIAL_FILE_BYTES);
    let several = || -> Option<Vec<Cow<'_, [u8]>>> { name.split_whitespace().map(|name| read(name).ok()).collect() };
    let failure = match read(name) {
        Ok(text) => return Ok((text, folder.place_of(name).into_iter().collect())),
        Err(failure) => failure,
    };
    match several() {
        Some(texts) => {
            let files = name.split_whitespace().filter_map(|name| folder.place_of(name)).collect();
            Ok((Cow::Owned(texts.join(&b'\n')), files))
        }
        None => Err(match failure {
            Failure::Outside => {
                format!("{}; its faces get the default colour", skin::outside("material file", name))
            }
            Failure::TooLarge(_) | Failure::NoMemory(_) => {
                format!("the material file {}: {}", shown(name), failure.problem("a material file"))
            }
            _ => format!("the material file {} is missing; its faces get the default colour", shown(name)),
        }),
    }
}

/// Reads the material files named and gives the faces their materials.
pub(super) fn put_on(
    soup: &mut Soup,
    namings: &[(usize, Naming)],
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<()> {
    let mut found: Vec<Described> = Vec::new();
    // A name refers to the material read last, but only for later faces.
    let mut numbers: HashMap<String, usize> = HashMap::new();
    let (mut libraries, mut used) = (HashSet::new(), HashSet::new());
    let mut missing = Vec::new();
    let mut current = NONE;
    for (before, naming) in namings {
        match naming {
            // Exporters name one file before every part.
            Naming::Library(name) if !libraries.insert(name.as_str()) => {}
            Naming::Library(_) if libraries.len() > MATERIAL_FILES => {
                let problem = format!("it names more than {MATERIAL_FILES} material files; merge them");
                return Err(Error::model(path, problem));
            }
            Naming::Library(name) => {
                let (text, files) = library(folder, name).unwrap_or_else(|sentence| {
                    missing.push(sentence);
                    (Cow::Borrowed(b""), Vec::new())
                });
                soup.files.extend(files);
                let more = described(&text, MATERIALS - found.len())
                    .ok_or_else(|| Error::model(path, format!("it has more than {MATERIALS} materials; merge some")))?;
                // The last material of a name counts.
                let names = more.iter().map(|one| one.material.name.clone());
                numbers.extend(names.zip(found.len()..));
                found.extend(more);
            }
            Naming::Object(_) | Naming::Group(_) => {}
            Naming::Use(name) => {
                soup.polygon_materials.resize(*before, current);
                current = numbers.get(name).map_or(NONE, |number| *number as u32);
                used.insert(name.as_str());
            }
        }
    }
    if !used.is_empty() {
        soup.polygon_materials.resize(soup.polygon_count(), current);
    }
    let unknown = used.iter().filter(|name| !numbers.contains_key(**name)).count();
    // A missing file's materials are missing, too: they are counted and reported once.
    soup.defects.missing_materials = unknown.max(missing.len());
    if unknown > 0 && missing.is_empty() {
        let (are, their) = if unknown == 1 { ("is", "its") } else { ("are", "their") };
        remarks.push(format!(
            "{path}: {unknown} of the materials it uses {are} in no material file; {their} faces get the default colour"
        ));
    }
    skin::remark(path, missing, "material files are missing or were not read", remarks);
    match found.iter().filter(|one| one.is_see_through).count() {
        0 => {}
        1 => remarks.push(format!("{path}: not drawn: 1 material's transparency")),
        count => remarks.push(format!("{path}: not drawn: {count} materials' transparency")),
    }
    move_coordinates(soup, &found);
    soup.materials = found.into_iter().map(|one| one.material).collect();
    Ok(())
}

/// A material and its change to texture coordinates.
pub(super) struct Described {
    pub material: Material,
    /// Texture coordinates are multiplied by the first and moved by the second (`-s` and `-o` of `map_Kd`).
    placing: [Vec2; 2],
    /// The share of light that it stops (`d`).
    opacity: f32,
    /// Whether that is not all, or a picture says how much (`map_d`, which names that of the colours).
    is_see_through: bool,
}

/// Unchanged coordinates.
const AS_IT_IS: [Vec2; 2] = [Vec2::ONE, Vec2::ZERO];

/// Returns the materials of a library's text, with complete `newmtl`, `Kd` and `map_Kd` statements; `None` for more than
/// `most`.
pub(super) fn described(text: &[u8], most: usize) -> Option<Vec<Described>> {
    let mut all: Vec<Described> = Vec::new();
    let text = text::decoded(text);
    for line in String::from_utf8_lossy(&text::with_newlines(&text)).lines() {
        let Some((keyword, rest)) = line.trim().split_once(char::is_whitespace) else { continue };
        let rest = rest.trim();
        match (keyword, all.last_mut()) {
            ("newmtl", _) => {
                if all.len() >= most {
                    return None;
                }
                let material = Material { name: rest.to_owned(), color: None, ..Material::default() };
                all.push(Described { material, placing: AS_IT_IS, opacity: 1.0, is_see_through: false });
            }
            ("Kd", Some(Described { material, .. })) => {
                let numbers = rest.split_whitespace().take(3).filter_map(|word| word.parse::<f64>().ok());
                let color: Vec<f32> =
                    numbers.filter(|number| number.is_finite()).map(|x| x.clamp(0.0, 1.0) as f32).collect();
                material.color = color.first_chunk().copied().or(material.color);
            }
            ("map_Kd", Some(Described { material, placing, .. })) => {
                let (name, placed) = texture(rest);
                (material.texture, *placing) = (Some(PathBuf::from(name)), placed);
            }
            ("d", Some(Described { opacity, is_see_through, .. })) => {
                *opacity = rest.parse().ok().filter(|share| (0.0..1.0).contains(share)).unwrap_or(1.0);
                *is_see_through |= *opacity < 1.0;
            }
            ("map_d", Some(Described { is_see_through, .. })) => *is_see_through = true,
            _ => {}
        }
    }
    for Described { material, opacity, is_see_through, .. } in &mut all {
        // A factor of black would hide the picture; exporters write it to mean no colour.
        material.texture_color = material.color.filter(|color| *color != [0.0; 3]);
        if *is_see_through {
            material.blend(*opacity);
        }
    }
    Some(all)
}

/// Gives separate texture coordinates to corners whose material scales or moves its picture.
fn move_coordinates(soup: &mut Soup, materials: &[Described]) {
    if materials.iter().all(|one| one.placing == AS_IT_IS) {
        return;
    }
    let mut moved: HashMap<(u32, u32), u32> = HashMap::new();
    let mut start = 0;
    for (polygon, material) in soup.polygon_materials.iter().enumerate() {
        let end = start + soup.polygon_sizes.get(polygon).map_or(3, |size| *size as usize);
        if let Some([scale, offset]) =
            materials.get(*material as usize).map(|one| one.placing).filter(|it| *it != AS_IT_IS)
        {
            for corner in soup.corners[start..end].iter_mut().filter(|corner| corner.texture != NONE) {
                corner.texture = *moved.entry((*material, corner.texture)).or_insert_with(|| {
                    let own = soup.texture_coordinates[corner.texture as usize];
                    soup.texture_coordinates.push(own * scale + offset);
                    soup.texture_coordinates.len() as u32 - 1
                });
            }
        }
        start = end;
    }
}

/// A texture statement's file, whose name may hold blanks, behind its options and between its quotes, if it has any; and what `-s`
/// and `-o` among those say of the picture's place.
fn texture(statement: &str) -> (&str, [Vec2; 2]) {
    let (mut rest, mut placing) = (statement.trim(), AS_IT_IS);
    while let Some((option, mut after)) = rest.split_once(char::is_whitespace) {
        let option = option.to_ascii_lowercase();
        let (least, most) = match option.as_str() {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-boost" | "-bm" | "-cc" | "-clamp" | "-imfchan" | "-texres" | "-type" => (1, 1),
            _ => break,
        };
        // One to three numbers may follow; the last word is the name in any case.
        let mut numbers = [None; 3];
        for (place, slot) in numbers.iter_mut().enumerate().take(most) {
            let Some((word, next)) = after.trim_start().split_once(char::is_whitespace) else { break };
            let number = word.parse::<f32>().ok().filter(|number| number.is_finite());
            if place >= least && number.is_none() {
                break;
            }
            (*slot, after) = (number, next);
        }
        let [x, y, _] = numbers;
        let given = |own: Vec2| Vec2::new(x.unwrap_or(own.x), y.unwrap_or(own.y));
        match option.as_str() {
            "-s" => placing[0] = given(placing[0]),
            "-o" => placing[1] = given(placing[1]),
            _ => {}
        }
        rest = after.trim_start();
    }
    (unquoted(rest), placing)
}

/// A name without the quotes around it.
fn unquoted(name: &str) -> &str {
    let quoted = name.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map(str::trim);
    quoted.filter(|name| !name.is_empty()).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TextureAlpha;

    fn of(text: &str) -> Vec<Described> {
        described(text.as_bytes(), 9).unwrap()
    }

    #[test]
    fn texture_names_stand_behind_options_and_may_hold_blanks_and_backslashes() {
        let names = [
            ("skin.png", "skin.png"),
            ("-s 1 1 1 skin.png", "skin.png"),
            ("-s 2 skin.png", "skin.png"),
            ("-o 0.5 0 my skin.png", "my skin.png"),
            ("-blendu on -mm 0 1  -clamp off art\\my skin.png ", "art\\my skin.png"),
            ("-t 1 2 3 4.png", "4.png"),
            ("-s 1 1 1 2 faces.png", "2 faces.png"),
            ("\"my skin.png\"", "my skin.png"),
            ("-s 1 1 1", "1"),
            ("-clamp", "-clamp"),
        ];
        for (statement, name) in names {
            let all = of(&format!("newmtl a\nmap_Kd\t{statement}\r\n"));
            assert_eq!(all[0].material.texture, Some(PathBuf::from(name)), "{statement}");
        }
    }

    #[test]
    fn scale_and_offset_of_a_picture_move_the_coordinates_of_its_materials_faces_alone() {
        let mtl = b"newmtl a\nmap_Kd -s 3 2 1 -o 0.5 a.png\nnewmtl b\nmap_Kd a.png\n";
        let text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nusemtl a\nf 1/1 2/1 3\nusemtl b\nf 1/1 3/1 2/1\n";
        let soup = super::super::read(text.as_bytes(), "t.obj", &Folder::of_files(&[("m.mtl", mtl)]), &mut Vec::new());
        let soup = soup.unwrap();
        let textures: Vec<u32> = soup.corners.iter().map(|corner| corner.texture).collect();
        assert_eq!(textures, [1, 1, NONE, 0, 0, 0]);
        assert_eq!(soup.texture_coordinates, [Vec2::ONE, Vec2::new(3.5, 2.0)]);
    }

    #[test]
    fn only_whole_statements_count_and_the_last_of_each() {
        let all = of("Kd 1 1 1\nnewmtl a b\nKd 0 1 7\nKd 1\nKd 1 nan 1 1\nKd x 0 0\nmap_Kd\nnewmtl\nNewmtl c\n");
        assert_eq!(all.len(), 1);
        assert_eq!((all[0].material.name.as_str(), all[0].material.color), ("a b", Some([0.0, 1.0, 1.0])));
        assert_eq!(all[0].material.texture, None);
        assert!(described(&b"newmtl a\n".repeat(10), 9).is_none());
    }

    #[test]
    fn what_a_material_lets_through_is_white() {
        let mixed = |text: &str| {
            let Described { material, is_see_through, .. } = of(text).remove(0);
            (material.color, material.texture_color, material.texture_alpha, is_see_through)
        };
        let (red, opaque) = (Some([1.0, 0.0, 0.0]), TextureAlpha::Ignored);
        for d in ["", "d 1", "d 1.0", "d 2", "d -1", "d nan", "d x", "Tr 1", "d -halo 0.5"] {
            assert_eq!(mixed(&format!("newmtl a\nKd 1 0 0\n{d}\n")), (red, red, opaque, false), "{d}");
        }
        let half = TextureAlpha::Blended([255, 0, 0, 64]);
        assert_eq!(mixed("newmtl a\n d 0.25\nKd 1 0 0"), (Some([1.0, 0.75, 0.75]), None, half, true));
        assert_eq!(mixed("newmtl a\nKd 1 0 0\n d 0").0, Some([1.0; 3]));
        let by_picture = TextureAlpha::Blended([255; 4]);
        assert_eq!(mixed("newmtl a\nmap_Kd a.png\nmap_d a.png"), (None, None, by_picture, true));
    }

    #[test]
    fn a_library_in_quotes_is_the_one_without_and_its_lines_may_end_in_carriage_returns() {
        let files: [(&str, &[u8]); 2] = [("my lib.mtl", b"newmtl a\rKd 1 0 0\r"), ("other.mtl", b"")];
        let folder = Folder::of_files(&files);
        for name in ["\"my lib.mtl\"", "my lib.mtl"] {
            let (text, _) = library(&folder, name).unwrap();
            assert_eq!(described(&text, 9).unwrap()[0].material.color, Some([1.0, 0.0, 0.0]));
        }
    }
}
