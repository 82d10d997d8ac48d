//! 3DS files made chunk by chunk, whole, cut off and damaged.

use super::*;
use crate::mesh::folder::Folder;
use crate::mesh::load::soup as read;
use crate::mesh::{LoadOptions, UpAxis};

fn chunk(number: u16, parts: &[&[u8]]) -> Vec<u8> {
    let data = parts.concat();
    let mut bytes = number.to_le_bytes().to_vec();
    bytes.extend(((data.len() + CHUNK_HEADER_BYTES) as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

fn shorts(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// `count` and the numbers behind it.
fn counted(count: u16, numbers: &[f32]) -> Vec<u8> {
    [shorts(&[count]), floats(numbers)].concat()
}

fn material(name: &str, color: &[u8], texture: Option<&str>) -> Vec<u8> {
    let name = chunk(chunk::MATERIAL_NAME, &[name.as_bytes(), b"\0"]);
    let color = chunk(chunk::DIFFUSE, &[color]);
    let percent = chunk(0x0030, &[&shorts(&[100])]);
    let texture = texture
        .map(|file| chunk(chunk::TEXTURE, &[&percent, &chunk(chunk::TEXTURE_FILE, &[file.as_bytes(), b"\0"])]))
        .unwrap_or_default();
    chunk(chunk::MATERIAL, &[&name, &color, &texture])
}

/// Four corners of a square in the plane z = `height` of the file, with texture coordinates and two faces, of which one
/// has the material.
fn object(height: f32, faces: &[[u16; 4]], material: &str) -> Vec<u8> {
    let h = height;
    let vertices = counted(4, &[0.0, 0.0, h, 1.0, 0.0, h, 1.0, 2.0, h, 0.0, 2.0, h]);
    let texture_coordinates = counted(3, &[0.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
    let named = chunk(chunk::FACE_MATERIAL, &[material.as_bytes(), b"\0", &shorts(&[2, 1, 77])]);
    let smoothing = chunk(0x4150, &[&[1; 8]]);
    let count = shorts(&[faces.len() as u16]);
    let faces = chunk(chunk::FACES, &[&count, &shorts(faces.as_flattened()), &named, &smoothing]);
    let matrix = chunk(chunk::MATRIX, &[&floats(&[9.0; 12])]);
    let mesh = chunk(
        chunk::MESH,
        &[
            &chunk(chunk::VERTICES, &[&vertices]),
            &faces,
            &matrix,
            &chunk(chunk::TEXTURE_COORDINATES, &[&texture_coordinates]),
        ],
    );
    chunk(chunk::OBJECT, &[b"square\0", &mesh])
}

fn file(parts: &[&[u8]]) -> Vec<u8> {
    let version = chunk(chunk::VERSION, &[&[3, 0, 0, 0]]);
    chunk(chunk::MAIN, &[&version, &chunk(chunk::EDITOR, parts), &chunk(chunk::KEYFRAMER, &[&[1, 2, 3]])])
}

const FACES: [[u16; 4]; 2] = [[0, 1, 2, 7], [0, 2, 3, 7]];
const RED: [u8; 9] = [0x11, 0, 9, 0, 0, 0, 255, 51, 0];

/// A valid file: two squares, the first in front of its material, the second behind it.
pub(crate) fn square() -> Vec<u8> {
    let red = material("red", &RED, None);
    file(&[&object(0.0, &FACES, "red"), &red, &object(5.0, &FACES, "red")])
}

fn soup_at(bytes: &[u8], path: &str) -> (Soup, Vec<String>) {
    let mut remarks = Vec::new();
    (read(bytes, path, &LoadOptions::default(), &Folder::of(path, false), &mut remarks).unwrap(), remarks)
}

#[test]
fn all_objects_of_a_file_become_one_mesh_that_stands_upright() {
    let (soup, remarks) = soup_at(&square(), "test.3ds");
    assert_eq!((soup.positions.len(), soup.corners.len(), soup.texture_coordinates.len()), (8, 12, 6));
    // x stays, up z becomes y, and the file's front -y becomes z.
    assert_eq!(soup.positions[6], DVec3::new(1.0, 5.0, -2.0));
    assert_eq!(soup.texture_coordinates[5], Vec2::new(1.0, 1.0));
    let positions: Vec<u32> = soup.corners[6..].iter().map(|corner| corner.position).collect();
    assert_eq!(positions, [4, 5, 6, 4, 6, 7]);
    let textures: Vec<u32> = soup.corners[6..].iter().map(|corner| corner.texture).collect();
    assert_eq!(textures, [3, 4, 5, 3, 5, NONE], "three texture coordinates for four vertices");
    assert!(remarks.is_empty() && soup.defects.is_empty());
    let mesh = soup.into_mesh("test.3ds", &LoadOptions::default()).unwrap();
    assert!(mesh.normals.iter().all(|normal| *normal == glam::Vec3::Y), "counter-clockwise seen from above");
}

#[test]
fn faces_get_the_materials_they_are_listed_under() {
    let (soup, _) = soup_at(&square(), "test.3ds");
    assert_eq!(soup.polygon_materials, [NONE, 0, NONE, 0]);
    assert_eq!(soup.materials[0].name, "red");
    assert_eq!(soup.materials[0].color, Some([1.0, 0.2, 0.0]));
}

#[test]
fn colours_are_bytes_or_floats_and_the_first_counts() {
    let color = |parts: &[&[u8]]| color(Bytes(&parts.concat())).ok().unwrap();
    let float = chunk(0x0010, &[&floats(&[0.5, 2.0, 0.25])]);
    assert_eq!(color(&[&float, &RED]), Some([0.5, 1.0, 0.25]));
    assert_eq!(color(&[&chunk(0x0013, &[&floats(&[0.5; 3])])]), Some([0.5; 3]));
    assert_eq!(color(&[&chunk(0x0012, &[&[255, 0, 0]])]), Some([1.0, 0.0, 0.0]));
    assert_eq!(color(&[&chunk(0x0010, &[&floats(&[f32::NAN, 0.0, 0.0])])]), None);
    assert_eq!(color(&[]), None);
}

#[test]
fn textures_are_found_beside_the_model_and_those_that_are_not_there_remarked_once() {
    let folder = tempfile::tempdir().unwrap();
    let brick = folder.path().join("brick.png");
    std::fs::write(&brick, "").unwrap();
    let materials = [
        material("a", &RED, Some("BRICK.PNG")),
        material("b", &RED, Some("LOST.GIF")),
        material("c", &RED, Some("LOST.GIF")),
    ];
    let bytes = file(&[&materials.concat(), &object(0.0, &FACES, "a")]);
    let path = folder.path().join("house.3ds");
    let (soup, remarks) = soup_at(&bytes, path.to_str().unwrap());
    let textures: Vec<Option<PathBuf>> = soup.materials.into_iter().map(|material| material.texture).collect();
    assert_eq!(textures, [Some(brick), None, None]);
    assert!(remarks.len() == 1 && remarks[0].contains("the picture LOST.GIF is not beside it"), "{remarks:?}");
}

#[test]
fn unknown_materials_and_indices_out_of_range_are_counted() {
    let faces = [[0, 1, 9, 7], FACES[1], FACES[0]];
    let (soup, remarks) = soup_at(&file(&[&object(0.0, &faces, "blue")]), "test.3ds");
    assert_eq!((soup.corners.len(), soup.defects.out_of_range_faces, soup.defects.missing_materials), (6, 1, 1));
    assert_eq!(soup.polygon_materials, [NONE, NONE]);
    assert!(remarks[0].starts_with("test.3ds: 1 of the materials"), "{remarks:?}");
    let (soup, _) = soup_at(&file(&[&material("blue", &RED, None), &object(0.0, &faces, "blue")]), "test.3ds");
    assert_eq!(soup.polygon_materials, [0, NONE], "faces keep their materials when others are left out");
}

#[test]
fn an_up_axis_takes_the_files_coordinates_as_they_are() {
    let options = LoadOptions { up_axis: UpAxis::Y, ..LoadOptions::default() };
    let soup = read(&square(), "test.3ds", &options, &Folder::of_files(&[]), &mut Vec::new()).unwrap();
    assert_eq!(soup.positions[6], DVec3::new(1.0, 2.0, 5.0));
}

#[test]
fn every_truncation_is_refused_and_no_changed_byte_panics() {
    let whole = square();
    let attempt = |bytes: &[u8]| {
        read(bytes, "test.3ds", &LoadOptions::default(), &Folder::of_files(&[]), &mut Vec::new())
            .and_then(|soup| soup.into_mesh("test.3ds", &LoadOptions::default()))
    };
    assert!(attempt(&whole).is_ok());
    for length in 1..whole.len() {
        let message = attempt(&whole[..length]).unwrap_err().to_string();
        assert!(message.starts_with("test.3ds: it"), "{length}: {message}");
    }
    // The same with a header that promises what is there, so that the chunks inside are cut.
    for length in CHUNK_HEADER_BYTES..whole.len() {
        let mut bytes = whole[..length].to_vec();
        bytes[2..6].copy_from_slice(&(length as u32).to_le_bytes());
        if let Err(error) = attempt(&bytes) {
            assert!(error.to_string().starts_with("test.3ds: "), "{length}: {error}");
        }
    }
    for place in 0..whole.len() {
        for byte in [0, 0xff] {
            let mut bytes = whole.clone();
            bytes[place] = byte;
            let _ = attempt(&bytes);
        }
    }
}

/// A track of one key, with two of the numbers for splines.
fn track(number: u16, values: &[f32]) -> Vec<u8> {
    let counts = [1u32.to_le_bytes(), 0u32.to_le_bytes()].concat();
    chunk(number, &[&[0; 10], &counts, &shorts(&[0b0101]), &floats(&[9.0, 9.0]), &floats(values)])
}

/// An object in the animation, with its pivot, place, turn and scale.
fn node(number: u16, name: &str, carrier: u16, [pivot, place, scale]: [[f32; 3]; 3], turn: [f32; 4]) -> Vec<u8> {
    let parts = [
        chunk(chunk::NODE_NUMBER, &[&shorts(&[number])]),
        chunk(chunk::NODE_HEADER, &[name.as_bytes(), b"\0", &shorts(&[0, 0, carrier])]),
        chunk(chunk::PIVOT, &[&floats(&pivot)]),
        track(chunk::PLACES, &place),
        track(chunk::TURNS, &turn),
        track(chunk::SCALES, &scale),
    ];
    chunk(0xb002, &[&parts.concat()])
}

/// A triangle's corners and corner numbers as the file has them, its object with this matrix, in these animations.
fn placed(corners: [[f32; 3]; 3], matrix: &[f32], nodes: &[Vec<u8>]) -> (Vec<DVec3>, Vec<u32>) {
    let vertices = chunk(chunk::VERTICES, &[&counted(3, corners.as_flattened())]);
    let faces = chunk(chunk::FACES, &[&shorts(&[1, 0, 1, 2, 7])]);
    let matrix = chunk(chunk::MATRIX, &[&floats(matrix)]);
    let object = chunk(chunk::OBJECT, &[b"wheel\0", &chunk(chunk::MESH, &[&matrix, &vertices, &faces])]);
    let (editor, animation) = (chunk(chunk::EDITOR, &[&object]), chunk(chunk::KEYFRAMER, &[&nodes.concat()]));
    let options = LoadOptions { up_axis: UpAxis::Y, ..LoadOptions::default() };
    let bytes = chunk(chunk::MAIN, &[&editor, &animation]);
    let soup = read(&bytes, "t.3ds", &options, &Folder::of_files(&[]), &mut Vec::new()).unwrap();
    (soup.positions, soup.corners.iter().map(|corner| corner.position).collect())
}

const UNMOVED: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
const ONE: [f32; 3] = [1.0; 3];
const NO_TURN: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
const NO_CARRIER: u16 = u16::MAX;
const CORNERS: [[f32; 3]; 3] = [[4.5, 0.0, 0.0], [4.0, 1.0, 0.0], [4.0, 0.0, 1.0]];

fn assert_near(found: &[DVec3], expected: [[f64; 3]; 3]) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.distance(DVec3::from_array(expected)) < 1e-5, "{found} for {expected:?}");
    }
}

#[test]
fn meshes_stand_where_the_animations_first_frame_has_them() {
    let [mut at_2, mut turned] = [UNMOVED; 2];
    at_2[9] = 2.0;
    // From the editor's place by one matrix and one pivot: a wheel that was modelled one pivot away.
    let body = node(0, "body", NO_CARRIER, [[0.0; 3], [0.0; 3], ONE], NO_TURN);
    let wheel = |carrier| node(1, "wheel", carrier, [[2.0, 0.0, 0.0], [2.0, 0.0, 0.0], ONE], NO_TURN);
    let expected = [[2.5, 0.0, 0.0], [2.0, 1.0, 0.0], [2.0, 0.0, 1.0]];
    for nodes in [vec![body.clone(), wheel(0)], vec![wheel(0), body.clone()], vec![wheel(NO_CARRIER)]] {
        assert_near(&placed(CORNERS, &at_2, &nodes).0, expected);
    }
    // A key turns clockwise: by a quarter around z from x to -y; scaled before, and placed behind that.
    let quarter = [std::f32::consts::FRAC_PI_2, 0.0, 0.0, 2.0];
    let alone = node(0, "wheel", NO_CARRIER, [[4.0, 0.0, 0.0], [7.0, 0.0, 0.0], [2.0, 3.0, 1.0]], quarter);
    assert_near(&placed(CORNERS, &UNMOVED, &[alone]).0, [[7.0, -1.0, 0.0], [10.0, 0.0, 0.0], [7.0, 0.0, 1.0]]);
    // What carries it turns it, too, wherever it stands in the file.
    let carrier = node(7, "$$$DUMMY", NO_CARRIER, [[9.0; 3], [0.0, 0.0, 5.0], ONE], quarter);
    let carried = node(0, "wheel", 7, [[4.0, 0.0, 0.0], [1.0, 0.0, 0.0], ONE], NO_TURN);
    let expected = [[0.0, -1.5, 5.0], [1.0, -1.0, 5.0], [0.0, -1.0, 6.0]];
    assert_near(&placed(CORNERS, &UNMOVED, &[carried, carrier]).0, expected);
    // The editor has the mesh's own x along y, mirrored: that is undone, and what mirrors turns the triangles round.
    turned[..6].copy_from_slice(&[0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
    let (positions, corners) =
        placed(CORNERS, &turned, &[node(0, "wheel", NO_CARRIER, [[0.0; 3], [0.0; 3], ONE], NO_TURN)]);
    assert_near(&positions, [[0.0, 4.5, 0.0], [-1.0, 4.0, 0.0], [0.0, 4.0, 1.0]]);
    assert_eq!(corners, [0, 1, 2]);
    let mirrors = node(0, "wheel", NO_CARRIER, [[0.0; 3], [0.0; 3], [-1.0, 1.0, 1.0]], NO_TURN);
    let (positions, corners) = placed(CORNERS, &UNMOVED, &[mirrors]);
    assert_near(&positions, [[-4.5, 0.0, 0.0], [-4.0, 1.0, 0.0], [-4.0, 0.0, 1.0]]);
    assert_eq!(corners, [0, 2, 1]);
}

#[test]
fn meshes_that_stand_where_they_were_modelled_keep_every_digit() {
    let modelled = CORNERS.map(|corner| DVec3::from_array(corner.map(f64::from)));
    let mut matrix = UNMOVED;
    let (sine, cosine) = 0.3f32.sin_cos();
    matrix[..2].copy_from_slice(&[cosine, -sine]);
    matrix[3..5].copy_from_slice(&[sine, cosine]);
    matrix[9..].copy_from_slice(&[4.1, 0.1, 0.3]);
    let same = node(0, "wheel", NO_CARRIER, [[0.0; 3], [4.1, 0.1, 0.3], ONE], [0.3, 0.0, 0.0, 1.0]);
    assert_eq!(placed(CORNERS, &matrix, &[same]).0, modelled);
    // Without a place in the animation, without an inverse, in a circle of carriers.
    let header = chunk(chunk::NODE_HEADER, &[b"wheel\0", &shorts(&[0, 0, 0])]);
    let still = node(0, "wheel", NO_CARRIER, [[0.0; 3], [1.0; 3], ONE], NO_TURN);
    assert_eq!(placed(CORNERS, &matrix, &[chunk(0xb002, &[&header])]).0, modelled);
    assert_eq!(placed(CORNERS, &matrix, &[]).0, modelled);
    assert_eq!(placed(CORNERS, &[9.0; 12], &[still]).0, modelled);
    let circle = node(0, "wheel", 0, [[0.0; 3], [0.0; 3], [2.0; 3]], NO_TURN);
    assert_eq!(placed(CORNERS, &UNMOVED, &[circle]).0, modelled);
}

#[test]
fn meshes_that_the_animation_places_several_times_are_said_and_drawn_once() {
    let node = |name: &str| {
        let header = chunk(chunk::NODE_HEADER, &[name.as_bytes(), b"\0", &shorts(&[0, 0, 0xffff])]);
        let instance = chunk(0xb011, &[b"copy\0"]);
        chunk(0xb002, &[&header, &instance])
    };
    let of_nodes = |nodes: &[&str]| {
        let nodes: Vec<u8> = nodes.iter().flat_map(|name| node(name)).collect();
        let editor = chunk(chunk::EDITOR, &[&object(0.0, &FACES, "red"), &material("red", &RED, None)]);
        let (soup, remarks) =
            soup_at(&chunk(chunk::MAIN, &[&editor, &chunk(chunk::KEYFRAMER, &[&nodes, &[7; 8]])]), "t.3ds");
        assert_eq!(soup.positions[2], DVec3::new(1.0, 0.0, -2.0), "not moved by the mesh's matrix");
        assert_eq!(soup.corners.len(), 6);
        remarks
    };
    assert!(of_nodes(&["square", "$$$DUMMY", "$$$DUMMY"]).is_empty());
    let sentence = "t.3ds: 1 mesh stands in several places by its animation; each is drawn once, in the first of them";
    assert_eq!(of_nodes(&["square", "square"]), [sentence]);
}
