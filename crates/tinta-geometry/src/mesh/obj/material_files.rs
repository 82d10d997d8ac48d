//! The files that `mtllib` names, and the pictures that those name.
//!
//! Exporters write names with blanks, with quotes, with the backslashes of other systems and with comments behind them. All of
//! that may belong to a name, too: what exists decides.

use crate::files::{Failure, shown};
use crate::limits::{MATERIAL_FILE_BYTES, MATERIAL_FILES};
use crate::mesh::folder::{Folder, Lookup, is_library};
use crate::mesh::skin;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// A material file that was found.
pub(super) struct MaterialFile {
    /// Where it lies.
    found: PathBuf,
    /// Its name in the model.
    name: String,
    /// Its folder, from the model's: the names in it count from there.
    pub folder: PathBuf,
}

impl MaterialFile {
    fn find(folder: &Folder<'_>, name: &str) -> Result<Self, Lookup> {
        match folder.find_library(name) {
            Lookup::Here(found) => {
                let slashes = PathBuf::from(name.replace('\\', "/"));
                let own = slashes.parent().unwrap_or(Path::new("")).to_path_buf();
                Ok(Self { found, name: name.to_owned(), folder: own })
            }
            other => Err(other),
        }
    }

    /// Reads its text, or returns a sentence.
    pub(super) fn read<'a>(&self, folder: &Folder<'a>) -> Result<Cow<'a, [u8]>, String> {
        folder.read_found(&self.found, MATERIAL_FILE_BYTES).map_err(|failure| match failure {
            Failure::TooLarge(_) | Failure::NoMemory(_) => {
                format!("the material file {}: {}", shown(&self.name), failure.problem("a material file"))
            }
            _ => missing(&self.name),
        })
    }

    /// Where it lies on disk; `None` for one in memory.
    pub(super) fn on_disk(&self, folder: &Folder<'_>) -> Option<PathBuf> {
        folder.place_of(&self.name).map(|_| self.found.clone())
    }
}

fn missing(name: &str) -> String {
    format!("the material file {} is missing; its faces get the default colour", shown(name))
}

/// Finds the material files that a statement names: one, or several with blanks between them. Also returns a sentence if one is
/// not there; the files before it count. None if the folder holds no files.
pub(super) fn find(folder: &Folder<'_>, statement: &str) -> (Vec<MaterialFile>, Option<String>) {
    if !folder.is_some() {
        return (Vec::new(), None);
    }
    let mut is_outside = false;
    let mut find = |name: &str| match MaterialFile::find(folder, name) {
        Ok(file) => Some(file),
        Err(lookup) => {
            is_outside |= lookup == Lookup::Outside;
            None
        }
    };
    let names = names(statement);
    if let Some(file) = names.iter().find_map(|name| find(name)) {
        return (vec![file], None);
    }
    let mut best = (Vec::new(), names.first().copied().unwrap_or(statement));
    for names in names {
        let (files, rest) = several(names, &mut find);
        if rest.is_empty() {
            return (files, None);
        }
        // The names without a comment come last.
        if !files.is_empty() {
            best = (files, rest);
        }
    }
    let (files, rest) = best;
    let sentence = match is_outside {
        true => format!("{}; its faces get the default colour", skin::outside("material file", rest)),
        false => missing(rest),
    };
    (files, Some(sentence))
}

/// The files of several names up to the first missing one, and the rest of the names. Each may hold blanks and ends where a
/// file is there: one of `.mtl` if possible.
fn several(names: &str, mut find: impl FnMut(&str) -> Option<MaterialFile>) -> (Vec<MaterialFile>, &str) {
    let mut files = Vec::new();
    let mut rest = names;
    while !rest.is_empty() && files.len() < MATERIAL_FILES {
        let blanks = rest.match_indices(char::is_whitespace).map(|(place, _)| place);
        let ends: Vec<usize> = blanks.chain([rest.len()]).take(MATERIAL_FILES).collect();
        let libraries = ends.iter().filter(|end| is_library(rest[..**end].trim_end_matches('"')));
        let mut ends = libraries.chain(&ends);
        let Some((end, file)) = ends.find_map(|end| Some((*end, find(unquoted(rest[..*end].trim()))?))) else { break };
        files.push(file);
        rest = rest[end..].trim_start();
    }
    (files, rest)
}

/// The names that a statement may mean: all of it, and the part before a comment.
pub(super) fn names(statement: &str) -> Vec<&str> {
    let before = |end: Option<usize>| Some(unquoted(statement[..end?].trim()));
    let comment = statement.match_indices('#').map(|(place, _)| place);
    let apart = comment.clone().find(|place| statement[..*place].ends_with(char::is_whitespace));
    let mut names: Vec<&str> =
        [before(Some(statement.len())), before(apart), before(comment.clone().next())].into_iter().flatten().collect();
    names.dedup();
    names.retain(|name| !name.is_empty());
    names
}

/// A name without the quotes around it.
fn unquoted(name: &str) -> &str {
    let quoted = name.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map(str::trim);
    quoted.filter(|name| !name.is_empty() && !name.contains('"')).unwrap_or(name)
}

/// The first of a picture's possible names that a file has; or else the first with a stand-in; or else the first.
pub(super) fn picture<'a>(folder: &Folder<'_>, below: &Path, names: &'a [String]) -> Option<&'a String> {
    if let [only] = names {
        return Some(only);
    }
    let is_there = |name: &&String| matches!(skin::exactly(folder, below, name), Lookup::Here(_));
    let has_stand_in = |name: &&String| matches!(skin::find(folder, below, name, false).lookup, Lookup::Here(_));
    names.iter().find(is_there).or_else(|| names.iter().find(has_stand_in)).or(names.first())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::load::load;
    use crate::mesh::{LoadOptions, Mesh};
    use std::fs;

    const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";

    /// A model `a.obj` with this statement in a folder of these files; the paths of an outer folder count as well.
    fn loaded(statement: &str, files: &[(&str, &str)]) -> (tempfile::TempDir, Mesh, Vec<String>) {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("model");
        fs::create_dir(&folder).unwrap();
        for (name, text) in files {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let path = folder.join("a.obj");
        fs::write(&path, format!("{statement}\n{FACE}")).unwrap();
        let loaded = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap();
        (outer, loaded.mesh, loaded.remarks)
    }

    /// Its first material's picture, from the model's folder.
    fn picture_of(statement: &str, files: &[(&str, &str)]) -> Option<String> {
        let (outer, mesh, _) = loaded(statement, files);
        let picture = mesh.materials.first()?.texture.clone()?;
        Some(picture.strip_prefix(outer.path().join("model")).unwrap().to_str().unwrap().to_owned())
    }

    #[test]
    fn pictures_lie_where_the_material_file_says_or_where_the_model_would() {
        for (picture, places, found) in [
            ("images/t.png", &["materials/images/t.png", "images/t.png"][..], "materials/images/t.png"),
            ("images/t.png", &["images/t.png"], "images/t.png"),
            ("images\\t.png", &["materials/images/t.png"], "materials/images/t.png"),
            ("../t.png", &["t.png", "materials/t.png"], "materials/../t.png"),
            ("IMAGES\\\\T.PNG", &["materials/images/t.png"], "materials/images/t.png"),
            ("C:\\art\\t.png", &["materials/t.png", "t.png"], "materials/t.png"),
            ("C:\\art\\t.png", &["t.tga", "other.png"], "t.tga"),
        ] {
            let mtl = format!("newmtl a\nmap_Kd {picture}\n");
            let mut files: Vec<(&str, &str)> = places.iter().map(|place| (*place, "")).collect();
            files.push(("materials/m.mtl", &mtl));
            assert_eq!(picture_of("mtllib materials/m.mtl", &files).as_deref(), Some(found), "{picture} {places:?}");
        }
    }

    #[test]
    fn comments_and_unknown_options_are_no_part_of_a_pictures_name_unless_such_a_file_is_there() {
        for (statement, place) in [
            ("t.png # a note", "t.png"),
            ("t.png# a note/v1.2", "t.png"),
            ("t#1.png # a note", "t#1.png"),
            ("t #1.png", "t #1.png"),
            ("\"my t.png\" # a note", "my t.png"),
            ("C:\\art\\t.png # from b/c", "t.png"),
            ("-colorspace sRGB t.png", "t.png"),
            ("-colorspace sRGB -s 1 1 1 my t.png # a note", "my t.png"),
            ("-my t.png", "-my t.png"),
        ] {
            let mtl = format!("newmtl a\nmap_Kd {statement}\n");
            let files = [("m.mtl", mtl.as_str()), (place, ""), ("t.pcx", "")];
            assert_eq!(picture_of("mtllib m.mtl", &files).as_deref(), Some(place), "{statement}");
        }
    }

    #[test]
    fn material_files_are_found_however_their_names_are_written() {
        const RED: &str = "newmtl a\nKd 1 0 0\n";
        for (statement, place) in [
            ("sub\\m.mtl", "sub/m.mtl"),
            ("sub\\\\m.mtl", "sub/m.mtl"),
            (".\\sub\\M.MTL", "sub/m.mtl"),
            ("SUB/m.mtl", "sub/m.mtl"),
            ("m.mtl # a note", "m.mtl"),
            ("m.mtl#a note", "m.mtl"),
            ("m #1.mtl", "m #1.mtl"),
            ("\"my m.mtl\"", "my m.mtl"),
            ("\"my m.mtl\" # a note", "my m.mtl"),
            ("my m.mtl", "my m.mtl"),
        ] {
            let (_folder, mesh, remarks) = loaded(&format!("mtllib {statement}"), &[(place, RED)]);
            assert!(remarks.is_empty(), "{statement}: {remarks:?}");
            assert_eq!(mesh.materials[0].color, Some([1.0, 0.0, 0.0]), "{statement}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn names_in_the_code_of_an_old_system_are_found_whatever_the_files_are_in() {
        use std::os::unix::ffi::OsStrExt;
        const LATIN: [&[u8]; 2] = [b"m\xe9.mtl", b"t\xe9\xe0.png"];
        const UTF_8: [&[u8]; 2] = ["mé.mtl".as_bytes(), "téà.png".as_bytes()];
        for (written, there) in [(LATIN, LATIN), (LATIN, UTF_8), (UTF_8, LATIN), (UTF_8, UTF_8)] {
            let folder = tempfile::tempdir().unwrap();
            let place = |name: &[u8]| folder.path().join(std::ffi::OsStr::from_bytes(name));
            fs::write(place(there[0]), [b"newmtl a\nmap_Kd ", written[1], b"\n"].concat()).unwrap();
            fs::write(place(there[1]), "").unwrap();
            fs::write(place(b"a.obj"), [b"mtllib ", written[0], b"\n", FACE.as_bytes()].concat()).unwrap();
            let loaded = load(place(b"a.obj").to_str().unwrap(), &LoadOptions::default()).unwrap();
            assert!(loaded.remarks.is_empty(), "{:?}", loaded.remarks);
            assert_eq!(loaded.mesh.materials[0].texture.as_deref(), Some(place(there[1]).as_path()));
        }
        // Another letter is another file, and so is one more.
        for name in ["ma.mtl", "méé.mtl", "m.mtl"] {
            let (_folder, mesh, remarks) = loaded("mtllib m\u{fffd}.mtl", &[(name, "newmtl a\n"), ("other.mtl", "")]);
            assert!(mesh.materials.is_empty() && remarks[0].contains("is missing"), "{name}: {remarks:?}");
        }
    }

    #[test]
    fn several_names_in_a_statement_may_hold_blanks() {
        let files =
            [("my a.mtl", "newmtl a\n"), ("my b.mtl", "newmtl b\n"), ("c", "newmtl c\n"), ("my", "newmtl my\n")];
        for (statement, names) in [
            ("my a.mtl my b.mtl", "a b"),
            ("my b.mtl c  my a.mtl", "b c a"),
            ("\"my a.mtl\" \"my b.mtl\" # both", "a b"),
            ("my c", "my c"),
        ] {
            let (_folder, mesh, remarks) = loaded(&format!("mtllib {statement}"), &files);
            let found: Vec<&str> = mesh.materials.iter().map(|material| material.name.as_str()).collect();
            assert_eq!(found.join(" "), names, "{statement} {remarks:?}");
        }
        for (statement, found, missing) in
            [("my a.mtl no.mtl my b.mtl # a note", 1, "no.mtl my b.mtl"), ("no such a.mtl", 0, "no such a.mtl")]
        {
            let (_folder, mesh, remarks) = loaded(&format!("mtllib {statement}"), &files);
            assert_eq!((mesh.materials.len(), mesh.defects.missing_materials), (found, 1), "{statement}");
            let sentence = format!("the material file {missing} is missing; its faces get the default colour");
            assert!(remarks[0].ends_with(&sentence), "{remarks:?}");
        }
    }

    #[test]
    fn files_outside_the_models_folder_are_not_read_whatever_their_names_spelling() {
        let mtl = "newmtl a\nmap_Kd ..\\..\\SECRET.png\n";
        let files = [("../secret.png", ""), ("../secret.mtl", "newmtl b\n"), ("sub/m.mtl", mtl)];
        for name in ["../secret.mtl", "..\\secret.mtl", "../secret.mtl # a note", "sub/m.mtl ../secret.mtl"] {
            let (_folder, mesh, remarks) = loaded(&format!("mtllib {name}"), &files);
            assert!(mesh.materials.iter().all(|material| material.name == "a"), "{name}");
            assert!(remarks[0].contains("is outside its folder and was not read"), "{name}: {remarks:?}");
        }
        for name in ["../SECRET.mtl", "../model/../Secret.mtl", "no/../../secret.mtl"] {
            let (_folder, mesh, remarks) = loaded(&format!("mtllib {name}"), &files);
            assert!(mesh.materials.is_empty() && remarks[0].contains("is missing"), "{name}: {remarks:?}");
        }
        let (outer, mesh, remarks) = loaded("mtllib sub/m.mtl", &files);
        assert_eq!(mesh.materials[0].texture, None, "{remarks:?}");
        let absolute = outer.path().join("secret.mtl");
        let (_folder, mesh, remarks) = loaded(&format!("mtllib {}", absolute.display()), &[]);
        assert!(mesh.materials.is_empty() && remarks[0].contains("is outside its folder"), "{remarks:?}");
    }

    #[test]
    fn a_library_in_memory_may_have_its_name_in_quotes() {
        let files: [(&str, &[u8]); 2] = [("my lib.mtl", b"newmtl a\rKd 1 0 0\r"), ("other.mtl", b"")];
        let folder = Folder::of_files(&files);
        for name in ["\"my lib.mtl\"", "my lib.mtl"] {
            let (found, _) = find(&folder, name);
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].read(&folder).unwrap(), files[0].1);
            assert_eq!(found[0].on_disk(&folder), None);
        }
    }
}
