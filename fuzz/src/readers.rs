//! The duty of every reader for any bytes: read them or refuse them in one sentence, without a panic, without infinite numbers or
//! NaN, in bounded memory.
//!
//! One function per reader, for the fuzz targets beside this file and for `tests/documents/corpus.rs`, which runs every file of the corpus
//! through the same function with an ordinary compiler.

use tinta::batch::{Job, List, Slice, add_entries, place_in};
use tinta::mesh::{LoadOptions, LoadedModel, VertexArrays, read_bytes};
use tinta::settings::OptionValue;
use tinta::{EdgeList, Picture, Preset, Recipe, Result, Scene, SceneSettings};

/// An OBJ model; behind a zero byte the material file that it may name.
pub fn obj(bytes: &[u8]) {
    let (model, materials) = match bytes.iter().position(|byte| *byte == 0) {
        Some(end) => (&bytes[..end], &bytes[end + 1..]),
        None => (bytes, [].as_slice()),
    };
    // Text that looks like another format would be read as that.
    model_of([b"o o\n", model].concat().as_slice(), materials, "fuzz.obj");
}

/// A PLY model.
pub fn ply(bytes: &[u8]) {
    model_of(bytes, b"", "fuzz.ply");
}

/// An STL model.
pub fn stl(bytes: &[u8]) {
    model_of(bytes, b"", "fuzz.stl");
}

/// An MD2 model.
pub fn md2(bytes: &[u8]) {
    model_of(bytes, b"", "fuzz.md2");
}

/// A 3DS model.
pub fn three_ds(bytes: &[u8]) {
    model_of(bytes, b"", "fuzz.3ds");
}

/// A 3MF model: a zip file, or the XML of its model alone.
pub fn three_mf(bytes: &[u8]) {
    let zipped = || {
        const NAME: &str = "3D/3dmodel.model";
        let size = (bytes.len() as u32).to_le_bytes();
        let (short, long) = ([NAME.len() as u8, 0], [0; 4]);
        let local =
            [b"PK\x03\x04".as_slice(), &[0; 14], &size, &size, &short, &[0; 2], NAME.as_bytes(), bytes].concat();
        let row = [b"PK\x01\x02".as_slice(), &[0; 16], &size, &size, &short, &[0; 12], &long, NAME.as_bytes()].concat();
        let at = (local.len() as u32).to_le_bytes();
        [local.as_slice(), &row, b"PK\x05\x06", &[0; 12], &at, &[0; 2]].concat()
    };
    let file = if bytes.starts_with(b"PK") { bytes.to_vec() } else { zipped() };
    model_of(&file, b"", "fuzz.3mf");
}

/// A glTF model, JSON or GLB; its pictures are no longer than the file.
pub fn gltf(bytes: &[u8]) {
    let loaded = read_bytes(bytes, "fuzz.gltf", &[], &LoadOptions::default());
    if let Ok(LoadedModel { mesh, .. }) = &loaded {
        let pictures = mesh.materials.iter().filter_map(|material| material.embedded.as_ref());
        pictures.for_each(|picture| assert!(picture.bytes.len() <= bytes.len()));
    }
    check_model(loaded);
}

/// A model of any format, recognised by its content, with other options than the default: the first byte selects them.
pub fn load(bytes: &[u8]) {
    let Some((how, bytes)) = bytes.split_first() else { return };
    let options = LoadOptions {
        weld: if how & 1 == 0 { 0.0 } else { 0.05 },
        normals: tinta::mesh::Normals::ALL[usize::from(how >> 1) % tinta::mesh::Normals::ALL.len()].1,
        strict: how & 8 != 0,
        ..LoadOptions::default()
    };
    check_model(read_bytes(bytes, "fuzz", &[], &options));
}

fn model_of(bytes: &[u8], materials: &[u8], name: &str) {
    check_model(read_bytes(bytes, name, &[("fuzz.mtl", materials)], &LoadOptions::default()));
}

/// A model is sound down to its drawing, and reports its faults in single lines.
fn check_model(loaded: Result<LoadedModel>) {
    /// Larger meshes are not made into scenes: the reader is under test.
    const TRIANGLES: usize = 2000;
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return check_sentence(&error.to_string()),
    };
    loaded.remarks.iter().for_each(|remark| check_sentence(remark));
    let mesh = loaded.mesh;
    assert!(!mesh.triangles.is_empty() || !mesh.curves.is_empty());
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    assert!(mesh.normals.iter().all(|normal| normal.is_finite() && (normal.length() - 1.0).abs() < 1e-3));
    assert!(mesh.triangles.as_flattened().iter().all(|index| (*index as usize) < mesh.positions.len()));
    assert!(mesh.triangle_normals.as_flattened().iter().all(|index| (*index as usize) < mesh.normals.len()));
    assert_eq!(mesh.triangle_normals.len(), mesh.triangles.len());
    let is_index = |index: &u32, count: usize| *index == tinta::mesh::NONE || (*index as usize) < count;
    let coordinates = mesh.triangle_texture_coordinates.as_flattened();
    assert!(coordinates.iter().all(|index| is_index(index, mesh.texture_coordinates.len())));
    assert!(mesh.triangle_materials.iter().all(|index| is_index(index, mesh.materials.len())));
    let colors = mesh.materials.iter().filter_map(|material| material.color);
    assert!(colors.flatten().all(|channel| (0.0..=1.0).contains(&channel)));
    if mesh.triangles.len() > TRIANGLES {
        return;
    }
    let edges = EdgeList::new(&mesh);
    assert!(edges.len() <= mesh.triangles.len() * 3);
    match Scene::new(vec![std::sync::Arc::new(mesh)], &SceneSettings::default()) {
        Err(error) => check_sentence(&error.to_string()),
        Ok(scene) => {
            let arrays: &VertexArrays = scene.arrays(&scene.objects[0]);
            assert!(arrays.vertices.as_flattened().iter().all(|number| number.is_finite()));
            assert!(scene.clip_from_view().is_finite());
        }
    }
}

/// A picture of any format; the first byte selects the extension of its name.
pub fn picture(bytes: &[u8]) {
    let Some((how, bytes)) = bytes.split_first() else { return };
    let name = ["a.png", "a.tga", "a.pcx", "a"][usize::from(*how) % 4];
    match Picture::from_bytes(bytes, name) {
        Ok(picture) => check_picture(&picture),
        Err(error) => check_sentence(&error.to_string()),
    }
}

fn check_picture(picture: &Picture) {
    let pixels = u64::from(picture.size.width) * u64::from(picture.size.height);
    assert!(pixels > 0);
    assert_eq!(picture.pixels.len() as u64, pixels * 4);
}

/// A ramp: a picture with four gradients.
pub fn ramp(bytes: &[u8]) {
    match tinta::styles::Ramp::from_bytes(bytes, "ramp.png") {
        Ok(ramp) => {
            check_picture(&ramp.picture);
            assert!(ramp.picture.size.height >= 4);
        }
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// Measured rows, as `results.jsonl` has them: written again they are the same.
pub fn rows(bytes: &[u8]) {
    match tinta_lab::report::rows_of_bytes(bytes, "results.jsonl") {
        Ok(rows) => rows.iter().for_each(|row| {
            let line = serde_json::to_string(row).expect("a row is text and numbers");
            assert_eq!(
                tinta_lab::report::rows_of_bytes(line.as_bytes(), "again").expect("just written").first(),
                Some(row)
            );
        }),
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// A list of jobs, and its journal: a job's own text gives the same job, and its outputs lie in the folder.
pub fn batch(bytes: &[u8]) {
    let folder = std::path::Path::new("out");
    match List::of_bytes(bytes.to_vec(), "jobs.jsonl") {
        Ok(list) => {
            for job in list.jobs(Slice::WHOLE) {
                let again = Job::parse(job.json.as_bytes()).expect("just written");
                assert_eq!((&again.id, &again.options, &again.json), (&job.id, &job.options, &job.json));
                for value in job.options.values() {
                    let OptionValue::Text(output) = value else { continue };
                    if let Ok(place) = place_in(folder, output) {
                        let is_parent = |part| part == std::path::Component::ParentDir;
                        assert!(place.starts_with(folder) && !place.components().any(is_parent), "{}", place.display());
                    }
                }
            }
            assert_eq!(list.jobs(Slice::WHOLE).count(), list.count);
        }
        Err(error) => check_sentence(&error.to_string()),
    }
    add_entries(&mut std::collections::HashMap::new(), bytes);
}

/// A preset: written again it has the same options.
pub fn preset(bytes: &[u8]) {
    match Preset::parse("fuzz.toml", &String::from_utf8_lossy(bytes)) {
        Ok(preset) => {
            let again =
                Preset::parse("again.toml", &tinta::preset::to_toml(&preset.options, "fuzz")).expect("just written");
            assert_eq!(again.options, preset.options);
        }
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// A picture with a recipe, PNG or SVG: its command line stays finite and gives the same recipe.
pub fn recipe(bytes: &[u8]) {
    match Recipe::of_bytes(bytes, "fuzz.png") {
        Ok(recipe) => {
            assert!(recipe.command_line("again.png").len() < 64 * (bytes.len() + 64));
            assert!(recipe.differences(&recipe).is_empty());
        }
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// One sentence of limited length that names the file. Characters that break lines are escaped.
fn check_sentence(sentence: &str) {
    assert!(sentence.len() > 8 && sentence.len() < 2000, "{} bytes: {sentence:.500}", sentence.len());
}
