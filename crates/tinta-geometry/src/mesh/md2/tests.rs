//! MD2 files made byte by byte, whole, cut off and damaged.

use super::*;
use crate::mesh::load::soup as read;
use crate::mesh::{ModelFrame, NONE, UpAxis};

/// A frame, in the file's form.
struct Frame {
    name: &'static str,
    scale: [f32; 3],
    translation: [f32; 3],
    vertices: Vec<[u8; 4]>,
}

/// A file as a test wants it: two frames of four vertices, four triangles.
struct TestFile {
    frames: Vec<Frame>,
    triangles: Vec<[u16; 6]>,
    texels: Vec<[i16; 2]>,
    skins: Vec<&'static str>,
}

/// A pyramid, three corners on the ground and its tip up in the file's axes; in the second frame the tip has moved.
fn made() -> TestFile {
    let frame = |name, forward: f32, tip: u8| Frame {
        name,
        scale: [0.5, 1.0, 2.0],
        translation: [forward, 0.0, -1.0],
        vertices: vec![[0, 0, 0, 9], [10, 0, 0, 9], [0, 10, 0, 9], [0, 0, tip, 9]],
    };
    TestFile {
        frames: vec![frame("stand01", 100.0, 10), frame("run1", 102.0, 20)],
        // Clockwise seen from outside, as in the game.
        triangles: vec![[0, 1, 2, 0, 1, 2], [0, 3, 1, 0, 1, 2], [0, 2, 3, 0, 1, 2], [1, 3, 2, 2, 1, 0]],
        texels: vec![[0, 0], [64, 0], [0, 32]],
        skins: vec!["players\\female\\ATHENA.pcx"],
    }
}

fn field<const N: usize>(text: &str) -> [u8; N] {
    let mut field = [0; N];
    field[..text.len()].copy_from_slice(text.as_bytes());
    field
}

impl TestFile {
    fn bytes(&self) -> Vec<u8> {
        let vertices = self.frames.first().map_or(0, |frame| frame.vertices.len());
        let frame_bytes = FRAME_HEADER_BYTES + vertices * VERTEX_BYTES;
        let skins_at = 68;
        let texels_at = skins_at + self.skins.len() * SKIN_BYTES;
        let triangles_at = texels_at + self.texels.len() * TEXTURE_COORDINATE_BYTES;
        let frames_at = triangles_at + self.triangles.len() * TRIANGLE_BYTES;
        let end = frames_at + self.frames.len() * frame_bytes;
        let counts = [self.skins.len(), vertices, self.texels.len(), self.triangles.len(), 0, self.frames.len()];
        let places = [skins_at, texels_at, triangles_at, frames_at, end, end];
        let mut bytes = MAGIC.to_vec();
        let header = [8, 64, 32, frame_bytes].into_iter().chain(counts).chain(places);
        header.for_each(|number| bytes.extend((number as u32).to_le_bytes()));
        self.skins.iter().for_each(|skin| bytes.extend(field::<SKIN_BYTES>(skin)));
        self.texels.as_flattened().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        self.triangles.as_flattened().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        for Frame { name, scale, translation, vertices } in &self.frames {
            scale.iter().chain(translation).for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend(field::<FRAME_NAME_BYTES>(name));
            bytes.extend(vertices.as_flattened());
        }
        bytes
    }
}

/// A valid file.
pub(crate) fn pyramid() -> Vec<u8> {
    made().bytes()
}

fn read_at(path: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    read(&pyramid(), path, &LoadOptions::default(), &Folder::of(path, false), remarks)
}

fn options(frame: &str) -> LoadOptions {
    LoadOptions { model_frame: frame.parse().unwrap(), ..LoadOptions::default() }
}

fn soup(bytes: &[u8], frame: &str) -> Result<Soup> {
    read(bytes, "nowhere/test.md2", &options(frame), &Folder::of("nowhere/test.md2", false), &mut Vec::new())
}

fn message(bytes: &[u8]) -> String {
    soup(bytes, "0").unwrap_err().to_string()
}

#[test]
fn a_frame_is_read_with_its_names_texture_coordinates_and_skin() {
    let mut remarks = Vec::new();
    let soup = read_at("nowhere/test.md2", &mut remarks).unwrap();
    assert_eq!(soup.frames, ["stand01", "run1"]);
    // In the file: 0.5 x + 100, y, 2 z - 1; forward x becomes z, left y becomes x, up z becomes y.
    let expected = [[0.0, -1.0, 100.0], [0.0, -1.0, 105.0], [10.0, -1.0, 100.0], [0.0, 19.0, 100.0]];
    assert_eq!(soup.positions, expected.map(DVec3::from_array));
    assert_eq!(soup.texture_coordinates, [Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 0.0)]);
    let last = &soup.corners[9..];
    assert_eq!(last.iter().map(|corner| corner.position).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(last.iter().map(|corner| corner.texture).collect::<Vec<_>>(), [2, 0, 1]);
    assert!(soup.corners.iter().all(|corner| corner.normal == NONE));
    assert_eq!((soup.polygon_materials.len(), soup.materials.len()), (4, 1));
    assert_eq!(soup.materials[0].texture, None);
    assert!(
        remarks.len() == 1 && remarks[0].starts_with("nowhere/test.md2: no skin was found beside it"),
        "{remarks:?}"
    );
}

#[test]
fn triangles_face_outwards() {
    let mesh = soup(&pyramid(), "0").unwrap().into_mesh("test.md2", &LoadOptions::default()).unwrap();
    let volume: f64 = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|index| mesh.positions[index as usize] - mesh.positions[0]))
        .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
        .sum();
    assert!((volume - 5.0 * 10.0 * 20.0 / 6.0).abs() < 1e-9, "{volume}");
    assert!(mesh.defects.is_empty(), "{}", mesh.defects);
}

#[test]
fn frames_are_taken_by_name_and_between_two_the_positions_lie_on_the_way() {
    let tip = |frame: &str| soup(&pyramid(), frame).unwrap().positions[3];
    assert_eq!(tip("run1"), DVec3::new(0.0, 39.0, 102.0));
    assert_eq!(tip("0.25"), DVec3::new(0.0, 24.0, 100.5));
    assert_eq!(tip("1"), tip("run1"));
    let message = soup(&pyramid(), "1.5").unwrap_err().to_string();
    assert!(message.contains("model-frame 1.5: nowhere/test.md2 has 2 frames"), "{message}");
}

#[test]
fn an_up_axis_takes_the_files_coordinates_as_they_are() {
    let options = LoadOptions { up_axis: UpAxis::Y, ..LoadOptions::default() };
    let soup = read(&pyramid(), "test.md2", &options, &Folder::of_files(&[]), &mut Vec::new()).unwrap();
    assert_eq!(soup.positions[3], DVec3::new(100.0, 0.0, 19.0));
}

#[test]
fn skins_are_found_by_the_files_names_then_by_the_models_own() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("hero.md2");
    let texture = || {
        let mut remarks = Vec::new();
        let soup = read_at(model.to_str().unwrap(), &mut remarks).unwrap();
        let found = soup.materials[0].texture.clone();
        // The file names it in another folder.
        let is_silent = found.as_ref().is_some_and(|found| found.ends_with("Hero.BMP"));
        assert_eq!(remarks.is_empty(), is_silent, "{remarks:?}");
        let says = if found.is_some() { "beside it stands for" } else { "no skin was found" };
        assert!(remarks.iter().all(|remark| remark.contains(says)), "{remarks:?}");
        found
    };
    let write = |name: &str| {
        std::fs::write(folder.path().join(name), "").unwrap();
        Some(folder.path().join(name))
    };
    assert_eq!(texture(), None);
    assert_eq!(write("Hero.BMP"), texture());
    assert_eq!(write("athena.jpg"), texture());
    assert_eq!(write("athena.TGA"), texture());
    assert_eq!(write("athena.pcx"), texture());
}

#[test]
fn triangles_with_indices_out_of_range_are_counted_and_the_others_kept() {
    let mut made = made();
    made.triangles[1][2] = 4;
    made.triangles[2][5] = 3;
    let soup = soup(&made.bytes(), "0").unwrap();
    assert_eq!((soup.corners.len(), soup.polygon_materials.len(), soup.defects.out_of_range_faces), (6, 2, 2));
}

#[test]
fn contradictions_are_explained() {
    let with = |place: usize, number: u32| {
        let mut bytes = pyramid();
        bytes[place..place + 4].copy_from_slice(&number.to_le_bytes());
        message(&bytes)
    };
    assert!(with(4, 15).contains("MD2 version 15; only version 8"));
    assert!(with(16, 55).contains("its frames have 55 bytes but 4 vertices need 56"));
    assert!(with(24, u32::MAX).contains("vertices need"));
    assert!(with(32, u32::MAX).contains("promises 4294967295 triangles of 12 bytes"));
    assert!(with(40, 0).contains("no frames"));
    assert!(with(40, 1_000_000).contains("1000000 frames of 56 bytes"));
    assert!(with(52, u32::MAX).contains("from byte 4294967295"));
    assert!(message(b"IDP3").contains("does not begin like an MD2"));
}

#[test]
fn every_truncation_is_refused_and_no_changed_byte_panics() {
    let whole = pyramid();
    for length in 1..whole.len() {
        let message = message(&whole[..length]);
        assert!(message.starts_with("nowhere/test.md2: it"), "{length}: {message}");
    }
    for place in 0..whole.len() {
        for byte in [0, 0xff] {
            let mut bytes = whole.clone();
            bytes[place] = byte;
            for frame in ["0", "0.5", "run1"] {
                let _ = soup(&bytes, frame).and_then(|soup| soup.into_mesh("test.md2", &LoadOptions::default()));
            }
        }
    }
}

#[test]
fn a_model_frame_of_a_file_with_one_frame_is_that_frame() {
    let mut made = made();
    made.frames.truncate(1);
    let soup = read(&made.bytes(), "test.md2", &options("STAND01"), &Folder::of_files(&[]), &mut Vec::new()).unwrap();
    assert_eq!(soup.frames.len(), 1);
    assert!(ModelFrame::Number(0.5).find(&soup.frames, "test.md2").is_err());
}

#[test]
fn a_skin_of_another_folder_is_taken_where_it_is_or_said_to_be_replaced() {
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name);
    for folder in ["a/tank", "a/ctank"] {
        std::fs::create_dir_all(at(folder)).unwrap();
    }
    let mut made = made();
    made.skins = vec!["a\\tank\\..\\ctank\\skin.pcx"];
    let bytes = made.bytes();
    let model = at("a/tank/tris.md2");
    let skin = |allow_external| {
        let mut remarks = Vec::new();
        let path = model.to_str().unwrap();
        let soup = read(&bytes, path, &options("0"), &Folder::of(path, allow_external), &mut remarks).unwrap();
        let place = soup.materials[0].texture.as_ref().map(|found| found.canonicalize().unwrap());
        (place, remarks.into_iter().map(|remark| remark.replace(path, "tris.md2")).collect::<Vec<_>>())
    };
    let write = |name: &str| {
        std::fs::write(at(name), "").unwrap();
        Some(at(name).canonicalize().unwrap())
    };
    let beside = write("a/tank/skin.pcx");
    let stands = "tris.md2: skin.pcx beside it stands for a\\tank\\..\\ctank\\skin.pcx, which";
    assert_eq!(skin(false), (beside.clone(), vec![format!("{stands} was not found")]));
    let named = write("a/ctank/skin.pcx");
    let sentence = format!("{stands} is outside its folder; --allow-external reads that");
    assert_eq!(skin(false), (beside, vec![sentence]));
    assert_eq!(skin(true), (named, vec![]));
    std::fs::remove_file(at("a/tank/skin.pcx")).unwrap();
    let (place, remarks) = skin(false);
    assert!(place.is_none() && remarks[0].contains("is outside its folder and was not read"), "{remarks:?}");
}

#[test]
fn pictures_beside_a_model_without_a_skin_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.pcx", "b.png", "hero2.bmp", "hero.txt"] {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    let mut remarks = Vec::new();
    read_at(folder.path().join("hero.md2").to_str().unwrap(), &mut remarks).unwrap();
    assert!(remarks[0].ends_with("--skin takes another, for instance of those there: hero2.bmp, a.pcx"), "{remarks:?}");
}

#[test]
fn a_file_without_skins_is_drawn_and_that_is_said() {
    let made = TestFile { skins: Vec::new(), ..made() };
    let mut remarks = Vec::new();
    let soup = read(&made.bytes(), "a.md2", &options("0"), &Folder::of("nowhere/a.md2", false), &mut remarks).unwrap();
    assert_eq!((soup.corners.len(), remarks.len()), (12, 1));
    assert!(remarks[0].contains("no skin was found beside it"), "{remarks:?}");
}
