//! MTL: the material files that an OBJ file names, and its faces' materials.

use super::chunk::Naming;
use super::emission::Emission;
use super::lines::plain;
use super::material_files;
use crate::error::{Error, Result};
use crate::limits::{MATERIAL_FILES, MATERIALS};
use crate::mesh::folder::Folder;
use crate::mesh::number::number;
use crate::mesh::soup::Soup;
use crate::mesh::{Material, NONE, skin, text};
use glam::Vec2;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

/// Reads the material files named and gives the faces their materials.
pub(super) fn put_on(
    soup: &mut Soup,
    namings: &[(usize, Naming)],
    path: &str,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<()> {
    let mut read = MaterialFiles::default();
    let (mut libraries, mut used) = (HashSet::new(), HashSet::new());
    let mut current = NONE;
    for (before, naming) in namings {
        match naming {
            // Exporters name one file before every part.
            Naming::Library(name) if !libraries.insert(name.as_str()) => {}
            Naming::Library(_) if libraries.len() > MATERIAL_FILES => {
                let problem = format!("it names more than {MATERIAL_FILES} material files; merge them");
                return Err(Error::model(path, problem));
            }
            Naming::Library(name) => read
                .statement(name, folder)
                .ok_or_else(|| Error::model(path, format!("it has more than {MATERIALS} materials; merge some")))?,
            Naming::Object(_) | Naming::Group(_) => {}
            Naming::Use(name) => {
                soup.polygon_materials.resize(*before, current);
                current = read.numbers.get(name).map_or(NONE, |number| *number as u32);
                used.insert(name.as_str());
            }
        }
    }
    if !used.is_empty() {
        soup.polygon_materials.resize(soup.polygon_count(), current);
    }
    let MaterialFiles { mut found, numbers, files, missing } = read;
    soup.files.extend(files);
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
    found.iter_mut().for_each(|one| one.finish(!soup.colors.is_empty()));
    let of_materials =
        |count: usize| if count == 1 { "1 material's".to_owned() } else { format!("{count} materials'") };
    let see_through = found.iter().filter(|one| one.is_see_through()).count();
    if see_through > 0 {
        remarks.push(format!("{path}: not drawn: {} transparency", of_materials(see_through)));
    }
    let foreign = found.iter().filter(|one| one.has_foreign_color).count();
    if foreign > 0 {
        let of = of_materials(foreign);
        remarks.push(format!("{path}: not drawn: {of} Kd as a spectrum or as XYZ; write red, green and blue"));
    }
    remarks.extend(Emission::remark(path, found.iter().map(|one| &one.emission)));
    soup.defects.unusable_colors = found.iter().filter(|one| one.has_unusable_color).count();
    move_coordinates(soup, &found);
    (soup.materials, soup.material_folders) = found.into_iter().map(|one| (one.material, one.folder)).collect();
    Ok(())
}

/// The material files read so far.
#[derive(Default)]
struct MaterialFiles {
    found: Vec<FileMaterial>,
    /// A name refers to the material read last, but only for later faces.
    numbers: HashMap<String, usize>,
    files: Vec<PathBuf>,
    /// A sentence for each missing file.
    missing: Vec<String>,
}

impl MaterialFiles {
    /// Reads the files that a statement names; `None` if their materials are too many.
    fn statement(&mut self, statement: &str, folder: &Folder<'_>) -> Option<()> {
        let (files, missing) = material_files::find(folder, statement);
        self.missing.extend(missing);
        for file in files {
            let text = match file.read(folder) {
                Ok(text) => text,
                Err(sentence) => {
                    self.missing.push(sentence);
                    continue;
                }
            };
            self.files.extend(file.on_disk(folder));
            let mut more = described(&text, MATERIALS - self.found.len())?;
            for one in &mut more {
                one.material.texture = material_files::picture(folder, &file.folder, &one.pictures).map(PathBuf::from);
                one.folder.clone_from(&file.folder);
            }
            // The last material of a name counts.
            let names = more.iter().map(|one| one.material.name.clone());
            self.numbers.extend(names.zip(self.found.len()..));
            self.found.extend(more);
        }
        Some(())
    }
}

/// A material as its file describes it.
#[derive(Default)]
pub(super) struct FileMaterial {
    pub material: Material,
    /// The names that its picture may have (`map_Kd`).
    pictures: Vec<String>,
    /// The folder of the file that describes it, from the model's.
    folder: PathBuf,
    /// Texture coordinates are multiplied by the first and moved by the second (`-s` and `-o` of `map_Kd`).
    placing: Placing,
    /// The share of light that it stops (`d`).
    opacity: Option<f32>,
    /// The share of light that it lets through (`Tr`), which counts where the other is not given.
    transparency: Option<f32>,
    /// Whether a picture says how much (`map_d`, which names that of the colours).
    has_opacity_picture: bool,
    /// Whether its colour is a spectrum or in XYZ.
    has_foreign_color: bool,
    /// The light that it emits (`Ke`, `map_Ke`).
    emission: Emission,
    /// Whether its colour is neither three numbers from 0 to 1 nor one.
    has_unusable_color: bool,
}

impl FileMaterial {
    /// The share of light that it stops. Some programs write `Tr 1` for opaque, others for invisible.
    fn opacity(&self) -> f32 {
        let opacity = self.opacity.or(self.transparency.map(|share| 1.0 - share).filter(|share| *share > 0.0));
        opacity.filter(|share| (0.0..1.0).contains(share)).unwrap_or(1.0)
    }

    fn is_see_through(&self) -> bool {
        self.has_opacity_picture || self.opacity() < 1.0
    }

    /// Decides the material's colours, in a model with colours at its vertices or without.
    fn finish(&mut self, has_vertex_colors: bool) {
        let (opacity, is_see_through) = (self.opacity(), self.is_see_through());
        let material = &mut self.material;
        // A factor of black would hide the picture or the vertices' colours; exporters write it to mean no colour.
        let factor = material.color.filter(|color| *color != [0.0; 3]);
        material.texture_color = factor;
        if has_vertex_colors {
            material.color = factor;
        }
        self.emission.put_on(material);
        if is_see_through {
            material.blend(opacity);
        }
    }
}

/// A scale and an offset of texture coordinates.
type Placing = [Vec2; 2];

/// Unchanged coordinates.
const AS_IT_IS: Placing = [Vec2::ONE, Vec2::ZERO];

/// Returns the materials of a library's text, with complete `newmtl`, `Kd` and `map_Kd` statements; `None` for more than
/// `most`.
pub(super) fn described(text: &[u8], most: usize) -> Option<Vec<FileMaterial>> {
    let mut all: Vec<FileMaterial> = Vec::new();
    let text = text::decoded(text);
    for line in String::from_utf8_lossy(&text::with_newlines(&text)).lines() {
        // `Kd` alone is one word.
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        if rest.is_empty() && keyword != "Kd" {
            continue;
        }
        match (keyword, all.last_mut()) {
            ("newmtl", _) => {
                if all.len() >= most {
                    return None;
                }
                let material = Material { name: rest.to_owned(), color: None, ..Material::default() };
                all.push(FileMaterial { material, placing: AS_IT_IS, ..FileMaterial::default() });
            }
            ("Kd", Some(one)) => {
                let is_foreign = rest.starts_with("spectral") || rest.starts_with("xyz");
                one.has_foreign_color |= is_foreign;
                one.has_unusable_color |= !is_foreign && !is_color(rest);
                one.material.color = color(rest).or(one.material.color);
            }
            ("map_Kd", Some(one)) => (one.pictures, one.placing) = texture(rest),
            ("Ke", Some(one)) => one.emission.color = color(rest).unwrap_or(one.emission.color),
            ("map_Ke", Some(one)) => one.emission.has_picture = true,
            ("d", Some(one)) => one.opacity = share(rest.strip_prefix("-halo").unwrap_or(rest)).or(one.opacity),
            ("Tr", Some(one)) => one.transparency = share(rest).or(one.transparency),
            ("map_d", Some(one)) => one.has_opacity_picture = true,
            _ => {}
        }
    }
    Some(all)
}

/// Whether a text is three numbers from 0 to 1, or a single one, but for a last digit.
fn is_color(text: &str) -> bool {
    let numbers: Vec<Option<f64>> = plain(text).split_whitespace().take(3).map(number).collect();
    let is_right = |number: &Option<f64>| number.is_some_and(|number| (-1e-6..=1.0 + 1e-6).contains(&number));
    [1, 3].contains(&numbers.len()) && numbers.iter().all(is_right)
}

/// Three numbers as a colour, or a single one as a grey; `None` for anything else.
fn color(text: &str) -> Option<[f32; 3]> {
    let text = plain(text);
    let channel = |word| number::<f64>(word).filter(|channel| channel.is_finite()).map(|x| x.clamp(0.0, 1.0) as f32);
    let channels: Option<Vec<f32>> = text.split_whitespace().take(3).map(channel).collect();
    match *channels?.as_slice() {
        [grey] => Some([grey; 3]),
        [red, green, blue] => Some([red, green, blue]),
        _ => None,
    }
}

/// A share of light: the text's first word.
fn share(text: &str) -> Option<f32> {
    number(plain(text).split_whitespace().next()?)
}

/// Gives separate texture coordinates to corners whose material scales or moves its picture.
fn move_coordinates(soup: &mut Soup, materials: &[FileMaterial]) {
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

/// The names that a texture statement's file may have, which may hold blanks, behind its options; and what `-s` and `-o` among
/// those say of the picture's place.
fn texture(statement: &str) -> (Vec<String>, Placing) {
    let (mut rest, mut placing) = (statement.trim(), AS_IT_IS);
    // A name may begin like an unknown option.
    let mut unknown = None;
    while let Some((option, mut after)) = rest.split_once(char::is_whitespace) {
        let option = option.to_ascii_lowercase();
        let (least, most) = match option.as_str() {
            "-o" | "-s" | "-t" => (1, 3),
            "-mm" => (2, 2),
            "-blendu" | "-blendv" | "-boost" | "-bm" | "-cc" | "-clamp" | "-imfchan" | "-texres" | "-type" => (1, 1),
            _ if option.strip_prefix('-').is_some_and(|word| word.starts_with(|first: char| first.is_alphabetic())) => {
                unknown = unknown.or(Some(rest));
                (1, 3)
            }
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
    let names = material_files::names(rest).into_iter().chain(unknown);
    (names.map(str::to_owned).collect(), placing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TextureAlpha;

    fn of(text: &str) -> Vec<FileMaterial> {
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
            ("-colorspace sRGB t.png", "t.png"),
            ("-gamma 2.2 1 -clamp on my t.png", "my t.png"),
            ("-5 t.png", "-5 t.png"),
        ];
        for (statement, name) in names {
            let all = of(&format!("newmtl a\nmap_Kd\t{statement}\r\n"));
            assert_eq!(all[0].pictures[0], name, "{statement}");
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
        let all = of(
            "Kd 1 1 1\nnewmtl a b\nKd 0 1 7\nKd 1 0\nKd 1 nan 1 1\nKd x 0 0\nKd -nan(ind)\nKd\nmap_Kd\nnewmtl\nNewmtl c\n",
        );
        assert_eq!(all.len(), 1);
        assert_eq!((all[0].material.name.as_str(), all[0].material.color), ("a b", Some([0.0, 1.0, 1.0])));
        assert!(all[0].pictures.is_empty());
        assert!(described(&b"newmtl a\n".repeat(10), 9).is_none());
    }

    #[test]
    fn a_single_number_is_a_grey_and_other_kinds_of_colour_are_said() {
        let one = |text: &str| of(&format!("newmtl a\n{text}\n")).remove(0);
        assert_eq!(one("Kd 0.5").material.color, Some([0.5; 3]));
        assert_eq!(one("Kd 0.25 # dark 1").material.color, Some([0.25; 3]));
        assert_eq!(one("Kd 1 0 0 # red").material.color, Some([1.0, 0.0, 0.0]));
        let text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        for kind in ["spectral a.rfl 1", "xyz 0.5 0.4 0.3", "xyz 0.5"] {
            let mtl = format!("newmtl a\nKd {kind}\nnewmtl b\nKd 0 0 1\n");
            let mut remarks = Vec::new();
            let files = [("m.mtl", mtl.as_bytes())];
            let soup = super::super::read(text.as_bytes(), "t.obj", &Folder::of_files(&files), &mut remarks).unwrap();
            assert_eq!(soup.materials[0].color, None, "{kind}");
            let sentence = "t.obj: not drawn: 1 material's Kd as a spectrum or as XYZ; write red, green and blue";
            assert_eq!(remarks, [sentence], "{kind}");
        }
    }

    #[test]
    fn a_black_material_does_not_blacken_the_colours_at_vertices() {
        let color = |vertex: &str, mtl: &str| {
            let text = format!("mtllib m.mtl\nv 0 0 0 {vertex}\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
            let mtl = format!("newmtl a\n{mtl}\n");
            let files = [("m.mtl", mtl.as_bytes())];
            let read = super::super::read(text.as_bytes(), "t.obj", &Folder::of_files(&files), &mut Vec::new());
            read.unwrap().materials[0].color
        };
        assert_eq!(color("1 0.5 0", "Kd 0 0 0"), None);
        assert_eq!(color("1 0.5 0", "Kd 0 0 0\n d 0.5"), None);
        assert_eq!(color("1 0.5 0", "Kd 0 0.5 0"), Some([0.0, 0.5, 0.0]));
        assert_eq!(color("", "Kd 0 0 0"), Some([0.0; 3]), "black where nothing else has a colour");
    }

    #[test]
    fn colours_that_are_none_are_counted_and_sound_ones_are_not() {
        let is_counted = |kd: &str| of(&format!("newmtl a\n{kd}\n"))[0].has_unusable_color;
        for kd in ["Kd nan 0 0", "Kd -1 2 1e30", "Kd", "Kd ", "Kd .5 .5 inf", "Kd 1 1", "Kd red 0 0", "Kd 1 1 1\nKd x"]
        {
            assert!(is_counted(kd), "{kd}");
        }
        for kd in ["", "Kd 0 0.5 1", "Kd 1 1 1.0000001", "Kd 1e-9 -0 1 4", "Kd 0.5", "Kd xyz 1 1 2"] {
            assert!(!is_counted(kd), "{kd}");
        }
    }

    #[test]
    fn what_a_material_lets_through_is_white() {
        let mixed = |text: &str| {
            let mut one = of(text).remove(0);
            one.finish(false);
            let is_see_through = one.is_see_through();
            (one.material.color, one.material.texture_color, one.material.texture_alpha, is_see_through)
        };
        let (red, opaque) = (Some([1.0, 0.0, 0.0]), TextureAlpha::Ignored);
        for d in ["", "d 1", "d 1.0", "d 2", "d -1", "d nan", "d x", "Tr 0", "Tr 1", "Tr 2", "Tr -1", "d 1\nTr 0.5"] {
            assert_eq!(mixed(&format!("newmtl a\nKd 1 0 0\n{d}\n")), (red, red, opaque, false), "{d}");
        }
        let half = TextureAlpha::Blended([255, 0, 0, 64]);
        assert_eq!(mixed("newmtl a\n d 0.25\nKd 1 0 0"), (Some([1.0, 0.75, 0.75]), None, half, true));
        assert_eq!(mixed("newmtl a\nKd 1 0 0\n d 0").0, Some([1.0; 3]));
        for quarter in
            ["Tr 0.75", "d -halo 0.25", "d 0.25 # glass", "Tr 0.5\n d 0.25", "d 0.25\nTr 0.25", "d 0.25\nTr 1"]
        {
            assert_eq!(mixed(&format!("newmtl a\nKd 1 0 0\n{quarter}\n")).2, half, "{quarter}");
        }
        let by_picture = TextureAlpha::Blended([255; 4]);
        assert_eq!(mixed("newmtl a\nmap_Kd a.png\nmap_d a.png"), (None, None, by_picture, true));
    }
}
