//! Edges written into GLB files: the reader finds the same ones, a viewer that follows the extension draws the same silhouettes,
//! and Khronos' validator has no complaint.

use crate::support::families::FAMILIES;
use crate::support::shapes::{Random, icosphere};
use crate::support::{Folder, builtin, public_meshes, root, skip};
use glam::DVec3;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::process::Command;
use tinta::edges::{self, Class, ClassSet, Classes, CreaseAngle, Eye, SilhouetteRule, Silhouettes};
use tinta::lines::closed_forms::{ClosedForm, Patch};
use tinta::mesh::read_bytes;
use tinta::{EdgeList, LineSettings, LoadOptions, Mesh, load};

/// Meshes of every kind: of families of scenes, built in, public ones.
fn meshes() -> Vec<(String, Mesh)> {
    let options = LoadOptions::default();
    let mut meshes = vec![("a ball".to_owned(), icosphere(3))];
    for (name, family) in FAMILIES {
        for seed in 0..6 {
            let scene = family(&mut Random::seeded(seed));
            meshes.extend(scene.objects.iter().map(|object| (format!("{name} {seed}"), (*object.mesh).clone())));
        }
    }
    meshes.extend(["bust", "open-box", "ant", "gear"].map(|name| (name.to_owned(), builtin(name))));
    let soldier = load(root().join("models/soldier.md2").to_str().unwrap(), &options).unwrap().mesh;
    meshes.push(("soldier".to_owned(), soldier));
    let half_axes = DVec3::new(1.0, 0.6, 1.4);
    for form in [
        ClosedForm::Ellipsoid { half_axes: DVec3::ONE },
        ClosedForm::Ellipsoid { half_axes },
        ClosedForm::Torus { ring: 1.0, tube: 0.4 },
        ClosedForm::Superquadric { half_axes, power: 4 },
        ClosedForm::Patch(Patch::HILLS),
    ] {
        meshes.push((format!("{form:?}"), form.mesh_with(10_000, 0.0, &options).unwrap()));
    }
    let files = ["cow.obj", "fandisk.obj", "suzanne.obj", "teapot.obj", "beethoven.obj", "spot/spot_triangulated.obj"];
    meshes.extend(public_meshes(&files).into_iter().map(|(file, mesh)| (file.to_owned(), mesh)));
    meshes
}

/// For each position of a written mesh the nearest one of the original; `None` where two of the original became one.
fn originals(mesh: &Mesh, written: &Mesh) -> Option<Vec<u32>> {
    if written.positions.len() != mesh.positions.len() {
        return None;
    }
    let (low, high) = mesh.bounds();
    let cell = (high - low).length() * 1e-5;
    let place = |point: &DVec3| ((*point - low) / cell).round().as_i64vec3();
    let mut cells: HashMap<glam::I64Vec3, Vec<u32>> = HashMap::new();
    for (number, point) in mesh.positions.iter().enumerate() {
        cells.entry(place(point)).or_default().push(number as u32);
    }
    let around = |number: i64| glam::I64Vec3::new(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
    let nearest = |point: &DVec3| {
        let near = (0..27).filter_map(|number| cells.get(&(place(point) + around(number)))).flatten().copied();
        near.min_by(|a, b| {
            let distance = |number: &u32| mesh.positions[*number as usize].distance_squared(*point);
            distance(a).total_cmp(&distance(b))
        })
    };
    let found: Vec<u32> = written.positions.iter().filter_map(nearest).collect();
    let all: BTreeSet<u32> = found.iter().copied().collect();
    (all.len() == mesh.positions.len()).then_some(found)
}

type Edge = [u32; 2];

fn edge(a: u32, b: u32) -> Edge {
    [a.min(b), a.max(b)]
}

/// A GLB file's JSON and data.
fn parts_of(file: &[u8]) -> (Value, &[u8]) {
    let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&file[..4], number(4), number(8)), (&b"glTF"[..], 2, file.len()));
    let end = 20 + number(12);
    (serde_json::from_slice(&file[20..end]).unwrap(), &file[end + 8..])
}

/// The bytes of an accessor.
fn accessor<'a>(json: &Value, data: &'a [u8], number: &Value) -> &'a [u8] {
    let accessor = &json["accessors"][number.as_u64().unwrap() as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let of = |name: &str| view[name].as_u64().unwrap() as usize;
    &data[of("byteOffset")..][..of("byteLength")]
}

fn vectors(bytes: &[u8]) -> Vec<DVec3> {
    let floats: Vec<f64> = bytes.chunks(4).map(|it| f32::from_le_bytes(it.try_into().unwrap()).into()).collect();
    floats.chunks(3).map(DVec3::from_slice).collect()
}

/// The edges of a file by the extension's text: those of value 2 or 3, and those of value 1 with the normals of their faces.
/// Edges are of bit patterns of positions.
struct Decoded {
    hard: BTreeSet<[[u64; 3]; 2]>,
    silhouettes: BTreeMap<[[u64; 3]; 2], [DVec3; 2]>,
}

impl Decoded {
    fn of(file: &[u8]) -> Self {
        let (json, data) = parts_of(file);
        let (mut hard, mut silhouettes) = (BTreeSet::new(), BTreeMap::new());
        for primitive in
            json["meshes"].as_array().unwrap().iter().flat_map(|mesh| mesh["primitives"].as_array().unwrap())
        {
            let extension = &primitive["extensions"]["EXT_mesh_primitive_edge_visibility"];
            if extension.is_null() {
                continue;
            }
            let positions = vectors(accessor(&json, data, &primitive["attributes"]["POSITION"]));
            let indices = accessor(&json, data, &primitive["indices"]).chunks(4);
            let indices: Vec<usize> = indices.map(|it| u32::from_le_bytes(it.try_into().unwrap()) as usize).collect();
            let bits = accessor(&json, data, &extension["visibility"]);
            assert_eq!(bits.len(), (indices.len() * 2).div_ceil(8));
            let mut normals = match &extension["silhouetteNormals"] {
                Value::Null => Vec::new(),
                number => vectors(accessor(&json, data, number)),
            }
            .into_iter();
            let mut hard_here = BTreeSet::new();
            for side in 0..indices.len() {
                let next = side / 3 * 3 + (side + 1) % 3;
                let mut ends = [side, next].map(|at| positions[indices[at]].to_array().map(f64::to_bits));
                ends.sort_unstable();
                match bits[side / 4] >> (side % 4 * 2) & 3 {
                    0 => {}
                    1 => {
                        let of_edge = [normals.next().unwrap(), normals.next().unwrap()];
                        assert!(silhouettes.insert(ends, of_edge).is_none(), "a silhouette edge is written once");
                    }
                    2 => assert!(hard_here.insert(ends), "2 is written once in a primitive"),
                    _ => assert!(hard_here.contains(&ends), "3 follows 2"),
                }
            }
            assert!(normals.next().is_none());
            hard.extend(hard_here);
        }
        Self { hard, silhouettes }
    }
}

#[test]
fn a_round_trip_keeps_every_hard_edge_and_viewers_find_the_same_silhouettes() {
    let settings = LineSettings::default();
    let exact = LoadOptions { weld: 0.0, ..LoadOptions::default() };
    let (mut compared, mut hard_edges, mut merged) = (0, 0, Vec::new());
    for (name, mesh) in meshes() {
        let list = EdgeList::new(&mesh);
        let wanted = settings.classes.and(ClassSet::EDGES);
        let classes = Classes::new(&mesh, &list, settings.crease_angle, wanted);
        let file = edges::glb(&mesh, &list, wanted, settings.crease_angle).unwrap();
        let read = read_bytes(&file, "a.glb", &[], &exact).unwrap();
        assert!(read.remarks.is_empty(), "{name}: {:?}", read.remarks);
        let Some(originals) = originals(&mesh, &read.mesh) else {
            merged.push(name);
            continue;
        };
        let hard: BTreeSet<Edge> = classes.marked.iter().map(|edge| list.positions()[*edge as usize]).collect();
        let found = read.mesh.marked.iter().map(|[a, b]| edge(originals[*a as usize], originals[*b as usize]));
        assert_eq!(found.collect::<BTreeSet<Edge>>(), hard, "{name}");
        hard_edges += hard.len();

        // What a viewer sees that knows the extension alone.
        let decoded = Decoded::of(&file);
        assert_eq!(decoded.hard.len(), hard.len(), "{name}");
        let written: HashMap<[u64; 3], u32> = {
            let (low, high) = mesh.bounds();
            let is_exact = mesh.positions.iter().all(|point| point.as_vec3().as_dvec3() == *point);
            let centre = if is_exact { DVec3::ZERO } else { (low * 0.5 + high * 0.5).as_vec3().as_dvec3() };
            let bits = |point: &DVec3| (*point - centre).as_vec3().as_dvec3().to_array().map(f64::to_bits);
            mesh.positions.iter().enumerate().map(|(number, point)| (bits(point), number as u32)).collect()
        };
        let planes = Silhouettes::new(&mesh, &list);
        let (low, high) = mesh.bounds();
        let size = (high - low).length();
        for seed in 0..8 {
            let eye = (low + high) * 0.5 + Random::seeded(seed).direction() * size * 1.5;
            let exact: BTreeSet<Edge> = planes
                .find(&mesh, &list, Eye::Point(eye), SilhouetteRule::Exact)
                .into_iter()
                .filter(|edge| classes.of_edges[*edge as usize].is_empty())
                .map(|edge| list.positions()[edge as usize])
                .collect();
            let (mut seen, mut doubtful) = (BTreeSet::new(), BTreeSet::new());
            for (ends, normals) in &decoded.silhouettes {
                let ends = edge(written[&ends[0]], written[&ends[1]]);
                let towards = (eye - mesh.positions[ends[0] as usize]).normalize();
                let [first, second] = normals.map(|normal| normal.dot(towards));
                // The file's normals are f32.
                if first.abs().min(second.abs()) < 1e-5 {
                    doubtful.insert(ends);
                } else if (first > 0.0) != (second > 0.0) {
                    seen.insert(ends);
                }
            }
            let certain = exact.difference(&doubtful).copied().collect::<BTreeSet<Edge>>();
            assert_eq!(seen, certain, "{name}, eye {seed}");
            compared += certain.len();
        }
    }
    println!("{hard_edges} hard edges, {compared} silhouette edges; merged by f32: {merged:?}");
    assert!(hard_edges > 1000 && compared > 1000 && merged.len() < 3, "{hard_edges} {compared} {merged:?}");
}

#[test]
fn parts_materials_and_normals_are_kept() {
    let mesh = builtin("ant");
    let list = EdgeList::new(&mesh);
    let file = edges::glb(&mesh, &list, ClassSet::of(&[Class::Crease]), CreaseAngle::default()).unwrap();
    let read = read_bytes(&file, "a.glb", &[], &LoadOptions::default()).unwrap().mesh;
    assert_eq!(read.triangles.len(), mesh.triangles.len());
    let colors = |mesh: &Mesh| mesh.materials.iter().map(|it| (it.name.clone(), it.color)).collect::<Vec<_>>();
    for ((name, color), (read_name, read_color)) in colors(&mesh).into_iter().zip(colors(&read)) {
        let differ =
            color.unwrap().into_iter().zip(read_color.unwrap()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(name == read_name && differ < 1e-6, "{name} {read_name} {differ}");
    }
    let of = |mesh: &Mesh, class: Class| {
        *Classes::new(mesh, &EdgeList::new(mesh), CreaseAngle::default(), ClassSet::EDGES).counts().of(class)
    };
    let halves = Mesh {
        triangle_materials: (0..mesh.triangles.len() as u32).map(|face| face % 2).collect(),
        triangle_parts: Vec::new(),
        ..mesh.clone()
    };
    let bytes = edges::glb(&halves, &list, ClassSet::of(&[Class::Material]), CreaseAngle::default()).unwrap();
    let of_halves = read_bytes(&bytes, "a.glb", &[], &LoadOptions::default()).unwrap().mesh;
    for (read, mesh) in [(&read, &mesh), (&of_halves, &halves)] {
        for class in [Class::Boundary, Class::Crease, Class::Material, Class::Normal] {
            assert_eq!(of(read, class), of(mesh, class), "{class:?}");
        }
    }
    let seams = of(&halves, Class::Material);
    assert!(seams > 100 && of_halves.marked.len() == seams, "{seams}");
    // Names of parts, those that hold others among them.
    let assembly = tinta::Mesh {
        parts: ["machine", "gear", "shaft"]
            .into_iter()
            .enumerate()
            .map(|(number, name)| tinta::mesh::NamedPart {
                name: name.to_owned(),
                within: if number == 0 { tinta::mesh::NONE } else { 0 },
            })
            .collect(),
        triangle_parts: (0..mesh.triangles.len()).map(|face| 1 + (face % 2) as u32).collect(),
        ..mesh
    };
    let file = edges::glb(&assembly, &list, ClassSet::of(&[Class::Part]), CreaseAngle::default()).unwrap();
    let read = read_bytes(&file, "a.glb", &[], &LoadOptions::default()).unwrap().mesh;
    let by_name = |mesh: &Mesh| -> BTreeMap<String, (Option<String>, usize)> {
        let of = |(number, part): (u32, &tinta::mesh::NamedPart)| {
            let holder = mesh.parts.get(part.within as usize).map(|holder| holder.name.clone());
            (part.name.clone(), (holder, mesh.triangle_parts.iter().filter(|it| **it == number).count()))
        };
        (0..).zip(&mesh.parts).map(of).collect()
    };
    assert_eq!(by_name(&read), by_name(&assembly));
    assert_eq!(by_name(&read)["gear"], (Some("machine".to_owned()), assembly.triangles.len() / 2));
}

/// Reports the number of errors, warnings and infos of each file.
const VALIDATE: &str = "
const { validateBytes } = require('gltf-validator'), fs = require('fs');
(async () => {
    for (const name of process.argv.slice(1)) {
        const { issues } = await validateBytes(new Uint8Array(fs.readFileSync(name)));
        console.log(issues.numErrors, issues.numWarnings, [...new Set(issues.messages.map(it => it.code))].join(' '));
    }
})();";

#[test]
fn the_validator_of_khronos_finds_no_error() {
    let node = |arguments: &[&str]| Command::new("node").args(arguments).current_dir(root()).output();
    if !node(&["-e", "require('gltf-validator')"]).is_ok_and(|done| done.status.success()) {
        return skip("gltf-validator: npm has not installed it where NODE_PATH says");
    }
    let folder = Folder::new();
    let settings = LineSettings::default();
    let mut arguments = vec!["-e".to_owned(), VALIDATE.to_owned()];
    for (number, (_, mesh)) in meshes().into_iter().enumerate() {
        let file = edges::glb(&mesh, &EdgeList::new(&mesh), settings.classes, settings.crease_angle).unwrap();
        arguments.push(folder.file(&format!("{number}.glb"), &file));
    }
    let done = node(&arguments.iter().map(String::as_str).collect::<Vec<_>>()).unwrap();
    let text = String::from_utf8_lossy(&done.stdout);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert_eq!(text.lines().count(), arguments.len() - 2);
    assert!(text.lines().all(|line| line.starts_with("0 0 ")), "{text}");
}
