//! Loads a [`Mesh`] from a path, built-in or file; the content determines the format first, the name second.

use super::folder::Folder;
use super::format::{self, Format, ModelFile};
use super::options::check;
use super::{Mesh, skin, soup::Soup, stl, text, up_axis_guess};
use crate::clock::Instant;
use crate::error::{Error, FileKind, Result};
use crate::files::{self, Failure};
use crate::limits::MODEL_BYTES;
use crate::memory;
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

pub use super::options::{LoadOptions, LoadStage, Normals, UpAxis};

/// The model that [`load`] read, with remarks to report once.
#[derive(Debug)]
pub struct LoadedModel {
    /// The model.
    pub mesh: Mesh,
    /// The names of the file's frames in order, as `LoadOptions::model_frame` takes them; empty if it has none.
    pub frames: Vec<String>,
    /// The files read besides the model's own: its material libraries, its data. A style reads pictures when it needs them.
    pub files: Vec<PathBuf>,
    /// Sentences about the file, each with its name: an unexpected format, defects, missing materials, skins.
    pub remarks: Vec<String>,
    /// The stages in order, each with its time, milliseconds.
    pub stages: Vec<(LoadStage, f64)>,
}

/// Reads a model: a file in one of the formats [`Format::ALL`].
///
/// # Errors
///
/// [`Error::File`] if the file is missing, unreadable, empty, damaged, of an unknown format or without anything to draw, or if
/// `options.skin` is no file; [`Error::Strict`] if it has defects and `options.strict` is set; [`Error::Setting`] if an option
/// is invalid or does not suit this model.
pub fn load(path: &str, options: &LoadOptions) -> Result<LoadedModel> {
    load_watched(path, options, &|_| {})
}

/// Like [`load`], and calls `watch` at the start of each stage, for progress displays.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_watched(path: &str, options: &LoadOptions, watch: &dyn Fn(LoadStage)) -> Result<LoadedModel> {
    check(options)?;
    timed(watch, |watch| {
        watch(LoadStage::Reading);
        refuse_address(path)?;
        check_free(path, memory::free())?;
        let bytes =
            files::read(Path::new(path), MODEL_BYTES).map_err(|failure| match (&failure, format::unread(path)) {
                (Failure::System(error), Some(format)) if error.kind() == ErrorKind::NotFound => {
                    Error::model(path, format!("there is no such file, and {}", not_read(&format)))
                }
                _ => failure.into_error(FileKind::Model, path, "a model file"),
            })?;
        let mut remarks = Vec::new();
        let soup = parsed(&bytes, path, options, &mut remarks, watch)?;
        // The bytes take a fifth of the memory of a mesh under construction.
        drop(bytes);
        made(soup, path, options, remarks, watch)
    })
}

/// Rejects a file if twice its bytes exceed the free memory: every format needs at least that.
fn check_free(path: &str, free: Option<u64>) -> Result<()> {
    let bytes = Path::new(path).metadata().map_or(0, |file| if file.is_file() { file.len() } else { 0 });
    // A file above the limit gets a separate message, which names the limit.
    if bytes > MODEL_BYTES { Ok(()) } else { memory::check(path, bytes.saturating_mul(2), free) }
}

/// Runs `work` and records the time of each stage it begins.
fn timed(
    watch: &dyn Fn(LoadStage),
    work: impl FnOnce(&dyn Fn(LoadStage)) -> Result<LoadedModel>,
) -> Result<LoadedModel> {
    let begun = RefCell::new(Vec::new());
    let mut loaded = work(&|stage| {
        begun.borrow_mut().push((stage, Instant::now()));
        watch(stage);
    })?;
    let (mut begun, mut end) = (begun.into_inner(), Instant::now());
    while let Some((stage, start)) = begun.pop() {
        loaded.stages.insert(0, (stage, end.duration_since(start).as_secs_f64() * 1e3));
        end = start;
    }
    Ok(loaded)
}

/// Reads bytes as the content of the model file `path`, and looks for the files they name beside it. A model from a pipe is
/// read like a file this way.
///
/// # Errors
///
/// Those of [`load`].
pub fn read_as(bytes: &[u8], path: &str, options: &LoadOptions) -> Result<LoadedModel> {
    check(options)?;
    timed(&|_| {}, |watch| {
        let mut remarks = Vec::new();
        let soup = parsed(bytes, path, options, &mut remarks, watch)?;
        made(soup, path, options, remarks, watch)
    })
}

/// Parses a file's bytes, and looks for the files they name beside `path`.
fn parsed(
    bytes: &[u8],
    path: &str,
    options: &LoadOptions,
    remarks: &mut Vec<String>,
    watch: &dyn Fn(LoadStage),
) -> Result<Soup> {
    watch(LoadStage::Parsing);
    soup(bytes, path, options, &Folder::of(path, options.allow_external), remarks)
}

/// Rejects network addresses, which tinta does not read.
///
/// # Errors
///
/// [`Error::File`] with how to fetch it.
pub fn refuse_address(path: &str) -> Result<()> {
    let is_address = ["https://", "http://", "ftp://"]
        .iter()
        .any(|scheme| path.get(..scheme.len()).is_some_and(|start| start.eq_ignore_ascii_case(scheme)));
    match is_address {
        false => Ok(()),
        true => Err(Error::model(
            path,
            "this is an address, and only files are read; fetch it first, for instance with: curl -L ADDRESS | tinta render - -o picture.png",
        )),
    }
}

/// Reads a model from memory: a file's bytes in one of the formats [`Format::ALL`]. `beside` holds the files that it names,
/// materials, data and pictures, as names with bytes. A name matches in any case and without its folders, and a single `.mtl`
/// file matches any name. If `beside` is empty, pictures are left out without a remark, and no other file is read.
///
/// `name` appears in messages, and its extension gives the format if the bytes do not.
///
/// # Errors
///
/// Those of [`load`].
pub fn read_bytes(bytes: &[u8], name: &str, beside: &[(&str, &[u8])], options: &LoadOptions) -> Result<LoadedModel> {
    check(options)?;
    timed(&|_| {}, |watch| {
        let mut remarks = Vec::new();
        watch(LoadStage::Parsing);
        let mut soup = soup(bytes, name, options, &Folder::of_files(beside), &mut remarks)?;
        // A missing file must not refer to a disk.
        soup.materials.iter_mut().for_each(|material| material.texture = None);
        made(soup, name, options, remarks, watch)
    })
}

/// Makes the mesh from the file's contents.
fn made(
    mut soup: Soup,
    path: &str,
    options: &LoadOptions,
    mut remarks: Vec<String>,
    watch: &dyn Fn(LoadStage),
) -> Result<LoadedModel> {
    watch(LoadStage::Joining);
    if soup.frames.is_empty() {
        options.model_frame.check_still(path)?;
    }
    if let Some(skin) = &options.skin {
        skin::put_on(&mut soup, skin, path)?;
    }
    let frames = std::mem::take(&mut soup.frames);
    let files = std::mem::take(&mut soup.files);
    let other_up = soup.other_up.filter(|_| options.up_axis == UpAxis::Auto);
    let mesh = soup.into_mesh_watched(path, options, &mut remarks, watch)?;
    if let Some(up) =
        other_up.filter(|_| !mesh.triangles.is_empty()).filter(|up| up_axis_guess::seems_to_lie(&mesh, *up))
    {
        remarks.push(format!(
            "{path}: the model's flat base suggests that {up} points up; if it lies on its side, add --up-axis {up}"
        ));
    }
    let others = mesh.defects.others();
    remarks.extend(others.consequence().map(|consequence| format!("{path}: {others}; {consequence}")));
    Ok(LoadedModel { mesh, frames, files, remarks, stages: Vec::new() })
}

/// Advises on a file of an unsupported format.
fn not_read(format: &str) -> String {
    format!("{format} is not read; export it as STL, OBJ or glTF from the program that made it")
}

/// Reads a file's bytes by the row of their format.
pub(super) fn soup(
    bytes: &[u8],
    path: &str,
    options: &LoadOptions,
    folder: &Folder<'_>,
    remarks: &mut Vec<String>,
) -> Result<Soup> {
    if bytes.is_empty() {
        return Err(Error::model(path, "the file is empty; export the model again"));
    }
    let bytes = &*if stl::is_binary(bytes) { Cow::Borrowed(bytes) } else { text::decoded(bytes) };
    let named = Format::of_name(path);
    let found = Format::of_content(bytes).filter(|found| format::unread(path).is_none() || found.is_unmistakable);
    let format = found.or(named).ok_or_else(|| {
        let problem = match format::unread(path) {
            Some(format) => not_read(&format),
            None => format!("this is not a model in a supported format; use one of {}", Format::names().join(", ")),
        };
        Error::model(path, problem)
    })?;
    if let Some(named) = named.filter(|named| named.name != format.name) {
        let found = format.name;
        remarks.push(format!("{path}: the name says {} but the content is {found}, and is read as that", named.name));
    }
    let mut soup = (format.read)(&ModelFile { bytes, path, folder, options }, remarks)?;
    let (turn, other_up) = format.up;
    turn.filter(|_| options.up_axis == UpAxis::Auto).into_iter().for_each(|turn| soup.turn_by(turn));
    soup.other_up = other_up;
    if options.skin.is_none() && !soup.has_pictures {
        skin::find_all(&mut soup, folder, path, remarks);
    }
    soup.check_memory(bytes.len(), path)?;
    Ok(soup)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_file_that_memory_does_not_hold_is_refused_before_it_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large.stl");
        // All holes: it takes no room on the disk.
        std::fs::File::create(&path).unwrap().set_len(3 << 30).unwrap();
        let path = path.to_str().unwrap();
        let message = check_free(path, Some(1 << 30)).unwrap_err().to_string();
        let sentence =
            "large.stl: it takes 6.0 GiB of memory, and 1.0 GiB are free; close other programs, or make it smaller";
        assert!(message.ends_with(sentence), "{message}");
        assert!(check_free(path, Some(6 << 30)).is_ok() && check_free(path, None).is_ok());
        assert!(check_free("no such file", Some(0)).is_ok(), "which has a sentence of its own");
    }

    #[test]
    fn stl_stands_up_unless_an_axis_is_given() {
        let text =
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 2 3\nvertex 1 5 3\nendloop\nendfacet\n\
            endsolid a\n";
        let corners = [[1.0f32, 2.0, 3.0], [4.0, 2.0, 3.0], [1.0, 5.0, 3.0]];
        let numbers = corners.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let binary = [vec![0; 80], 1u32.to_le_bytes().to_vec(), vec![0; 12], numbers, vec![0; 2]].concat();
        for bytes in [text.as_slice(), &binary] {
            let positions = |up_axis| {
                let options = LoadOptions { up_axis, ..LoadOptions::default() };
                let mut positions = read_bytes(bytes, "a.stl", &[], &options).unwrap().mesh.positions;
                positions.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap());
                positions
            };
            let file = [[1.0, 2.0, 3.0], [1.0, 5.0, 3.0], [4.0, 2.0, 3.0]].map(DVec3::from_array);
            let standing = [[1.0, 3.0, -5.0], [1.0, 3.0, -2.0], [4.0, 3.0, -2.0]].map(DVec3::from_array);
            assert_eq!(positions(UpAxis::Auto), standing);
            assert_eq!(positions(UpAxis::Z), standing);
            assert_eq!(positions(UpAxis::Y), file);
        }
    }

    #[test]
    fn a_byte_order_mark_does_not_cost_the_first_vertex() {
        for (name, bytes) in valid_files().into_iter().filter(|(name, _)| !name.starts_with('b')) {
            let marked = [b"\xef\xbb\xbf".as_slice(), &bytes].concat();
            assert_eq!(mesh_of(&marked, name).unwrap(), mesh_of(&bytes, name).unwrap(), "{name}");
        }
    }

    /// Small valid files of every format, each with all that its reader knows.
    fn valid_files() -> Vec<(&'static str, Vec<u8>)> {
        let obj =
            "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4//-1 -2 -1\n";
        let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
            property list uchar int vertex_indices\nend_header\n";
        let text_ply = format!("ply\nformat ascii 1.0\n{header}0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        let mut binary_ply = format!("ply\nformat binary_little_endian 1.0\n{header}").into_bytes();
        [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().for_each(|x| binary_ply.extend(x.to_le_bytes()));
        binary_ply.push(3);
        [0i32, 1, 2].iter().for_each(|index| binary_ply.extend(index.to_le_bytes()));
        let text_stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
            endsolid a\n";
        let mut binary_stl = vec![b' '; 80];
        binary_stl.extend(1u32.to_le_bytes());
        binary_stl.extend([0u8; 12]);
        [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().for_each(|x| binary_stl.extend(x.to_le_bytes()));
        binary_stl.extend([0u8; 2]);
        // Names of texts begin with another letter than b.
        vec![
            ("a.obj", obj.into()),
            ("t.ply", text_ply.into()),
            ("b.ply", binary_ply),
            ("t.stl", text_stl.into()),
            ("b.stl", binary_stl),
            ("b.md2", crate::mesh::md2::tests::pyramid()),
            ("b.3ds", crate::mesh::three_ds::tests::square()),
            ("b.3mf", crate::mesh::three_mf::tests::triangle()),
            ("t.gltf", crate::mesh::gltf::tests::json()),
            ("b.glb", crate::mesh::gltf::tests::binary()),
        ]
    }

    fn mesh_of(bytes: &[u8], name: &str) -> Result<Mesh> {
        let options = LoadOptions::default();
        Ok(read_bytes(bytes, name, &[], &options)?.mesh)
    }

    #[test]
    fn the_valid_files_are_valid() {
        for (name, bytes) in valid_files() {
            let mesh = mesh_of(&bytes, name).unwrap();
            assert!(mesh.defects.is_empty() || name == "a.obj", "{name}: {}", mesh.defects);
        }
    }

    #[test]
    fn what_follows_the_length_that_a_header_promises_is_said_and_strictly_refused() {
        for (name, bytes) in valid_files().into_iter().filter(|(name, _)| ["b.md2", "b.3ds", "b.glb"].contains(name)) {
            let with = |more: &[u8], strict: bool| {
                let options = LoadOptions { strict, ..LoadOptions::default() };
                read_bytes(&[&bytes, more].concat(), name, &[], &options)
            };
            let sentence = format!("{name}: its header promises {} bytes; what follows them is not read", bytes.len());
            for padding in [&b""[..], b"\0\0\0", b"\r\n", &[0; 100]] {
                let loaded = with(padding, false).unwrap();
                assert!(!loaded.remarks.contains(&sentence) && loaded.mesh.defects.unpromised == 0, "{name}");
            }
            for more in [&b"end"[..], &bytes] {
                let loaded = with(more, false).unwrap();
                assert!(loaded.remarks.contains(&sentence), "{name}: {:?}", loaded.remarks);
                assert_eq!(
                    loaded.mesh.defects,
                    crate::mesh::Defects { unpromised: 1, ..with(b"", false).unwrap().mesh.defects }
                );
                let refusal = with(more, true).unwrap_err().to_string();
                assert!(refusal.contains("1 part beyond what the header promises"), "{refusal}");
            }
        }
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(6000))]

        /// Changed bytes, inserted numbers, cut ends: a mesh of finite numbers or an error that names the file.
        #[test]
        fn damaged_files_give_a_sound_mesh_or_an_error_and_never_a_panic(
            file in 0..valid_files().len(),
            changes in proptest::collection::vec((0usize..600, proptest::num::u8::ANY), 0..6),
            insertion in (0usize..600, proptest::sample::select(vec!["", "nan", "-1", "1e999", "4294967296", "\\\n", "\n", "/", "#"])),
            keep in 0usize..600,
        ) {
            let (name, mut bytes) = valid_files()[file].clone();
            for (place, byte) in changes {
                let length = bytes.len();
                bytes[place % length] = byte;
            }
            let place = insertion.0 % bytes.len();
            bytes.splice(place..place, insertion.1.bytes());
            if keep < bytes.len() {
                bytes.truncate(keep);
            }
            match mesh_of(&bytes, name) {
                Ok(mesh) => {
                    assert!(mesh.positions.iter().all(|position| position.is_finite()));
                    assert!(mesh.normals.iter().all(|normal| normal.is_finite()));
                    let count = mesh.positions.len() as u32;
                    assert!(mesh.triangles.as_flattened().iter().all(|index| *index < count));
                    let normals = mesh.normals.len() as u32;
                    assert!(mesh.triangle_normals.as_flattened().iter().all(|index| *index < normals));
                    super::super::VertexArrays::new(&mesh, 1.0);
                }
                Err(error) => assert!(error.to_string().starts_with(name), "{error}"),
            }
        }
    }
}
