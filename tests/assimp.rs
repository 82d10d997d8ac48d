//! Formats that libassimp reads: a box of 1 x 2 x 3 in each, written here. Without the library they are skipped, aloud.

use crate::cli::{Folder, tinta};
use crate::hostile::refused;

#[cfg(not(feature = "assimp"))]
#[test]
fn without_the_feature_these_formats_are_named_with_what_to_do() {
    let folder = Folder::new();
    for (name, format) in
        [("foo.ms3d", "MS3D"), ("foo.X", "X"), ("foo.dxf", "DXF"), ("foo.lwo", "LWO"), ("foo.ase", "ASE")]
    {
        // Whatever its lines look like.
        let model = folder.file(name, b"v 0 0 0\nf 1 1 1\n");
        let sentence =
            format!("{name}: {format} is read by libassimp; install libassimp5 and build with --features assimp");
        refused(&tinta(&["edges", &model]), &[&sentence]);
    }
}

#[cfg(feature = "assimp")]
mod with_the_library {
    use super::*;
    use crate::hostile::one_line;
    use crate::support::skip;
    use glam::{DVec3, Vec3, dvec3};
    use tinta::mesh::{UpAxis, read_bytes};
    use tinta::{LoadOptions, Mesh, load};

    /// The corners of the box, in each format's own axes.
    fn corners() -> [[f32; 3]; 8] {
        std::array::from_fn(|number| [(number >> 2) as f32, (number >> 1 & 1) as f32 * 2.0, (number & 1) as f32 * 3.0])
    }

    /// Its sides, counter-clockwise from outside where x, y, z are right-handed.
    const SIDES: [[usize; 4]; 6] = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

    fn triangles() -> impl Iterator<Item = [usize; 3]> {
        SIDES.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
    }

    fn lines(items: impl Iterator<Item = String>, between: &str) -> String {
        items.collect::<Vec<_>>().join(between)
    }

    /// DirectX, as text; its axes are left-handed, its faces clockwise, which is the same order.
    fn x_file() -> Vec<u8> {
        let vertices = lines(corners().iter().map(|[x, y, z]| format!("{x:.1};{y:.1};{z:.1};")), ",\n");
        let faces = lines(SIDES.into_iter().map(|[a, b, c, d]| format!("4;{a},{b},{c},{d};")), ",\n");
        let coordinates = lines(corners().iter().map(|[x, y, _]| format!("{x:.2};{:.2};", y / 2.0)), ",\n");
        format!(
            "xof 0303txt 0032\nMesh box {{\n8;\n{vertices};\n6;\n{faces};\nMeshMaterialList {{\n1;\n6;\n0,0,0,0,0,0;\n\
            Material orange {{\n1.0;0.5;0.25;1.0;;\n0.0;\n0.0;0.0;0.0;;\n0.0;0.0;0.0;;\n\
            TextureFilename {{ \"skin.png\"; }}\n}}\n}}\nMeshTextureCoords {{\n8;\n{coordinates};\n}}\n}}\n"
        )
        .into_bytes()
    }

    /// AutoCAD's exchange format: a 3DFACE a side.
    fn dxf_file() -> Vec<u8> {
        let face = |side: [usize; 4]| {
            let corner = |(place, number): (usize, usize)| {
                let [x, y, z] = corners()[number];
                format!("{}\n{x}\n{}\n{y}\n{}\n{z}\n", 10 + place, 20 + place, 30 + place)
            };
            format!("0\n3DFACE\n8\n0\n{}", lines(side.into_iter().enumerate().map(corner), ""))
        };
        format!("0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", lines(SIDES.into_iter().map(face), "")).into_bytes()
    }

    /// 3D Studio Max's text export.
    fn ase_file() -> Vec<u8> {
        let vertex = |(number, [x, y, z]): (usize, &[f32; 3])| format!("*MESH_VERTEX {number} {x} {y} {z}\n");
        let face = |(number, [a, b, c]): (usize, [usize; 3])| {
            format!("*MESH_FACE {number}: A: {a} B: {b} C: {c} AB: 1 BC: 1 CA: 1 *MESH_SMOOTHING 1 *MESH_MTLID 0\n")
        };
        format!(
            "*3DSMAX_ASCIIEXPORT 200\n*MATERIAL_LIST {{\n*MATERIAL_COUNT 1\n*MATERIAL 0 {{\n*MATERIAL_NAME \"orange\"\n\
            *MATERIAL_CLASS \"Standard\"\n*MATERIAL_DIFFUSE 1.0 0.5 0.25\n}}\n}}\n*GEOMOBJECT {{\n*NODE_NAME \"box\"\n\
            *NODE_TM {{\n*NODE_NAME \"box\"\n*TM_ROW0 1.0 0.0 0.0\n*TM_ROW1 0.0 1.0 0.0\n*TM_ROW2 0.0 0.0 1.0\n\
            *TM_ROW3 0.0 0.0 0.0\n}}\n*MESH {{\n*TIMEVALUE 0\n*MESH_NUMVERTEX 8\n*MESH_NUMFACES 12\n*MESH_VERTEX_LIST {{\n{}}}\n\
            *MESH_FACE_LIST {{\n{}}}\n}}\n*MATERIAL_REF 0\n}}\n",
            lines(corners().iter().enumerate().map(vertex), ""),
            lines(triangles().enumerate().map(face), "")
        )
        .into_bytes()
    }

    /// LightWave's chunks of version 2: axes left-handed, faces clockwise.
    fn lwo_file() -> Vec<u8> {
        let chunk = |name: &[u8; 4], data: &[u8]| {
            let padding = vec![0; data.len() % 2];
            [name.as_slice(), &(data.len() as u32).to_be_bytes(), data, &padding].concat()
        };
        let part = |name: &[u8; 4], data: &[u8]| [name.as_slice(), &(data.len() as u16).to_be_bytes(), data].concat();
        let floats = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_be_bytes()).collect::<Vec<u8>>();
        let shorts = |numbers: &[usize]| numbers.iter().flat_map(|n| (*n as u16).to_be_bytes()).collect::<Vec<u8>>();
        let side = |side: [usize; 4]| [shorts(&[4]), shorts(&side)].concat();
        let polygons: Vec<u8> = SIDES.into_iter().flat_map(side).collect();
        let tags: Vec<u8> = (0..6).flat_map(|number| shorts(&[number, 0])).collect();
        let color = part(b"COLR", &[floats(&[1.0, 0.5, 0.25]), shorts(&[0])].concat());
        let diffuse = part(b"DIFF", &[floats(&[1.0]), shorts(&[0])].concat());
        let body = [
            b"LWO2".to_vec(),
            chunk(b"TAGS", b"orange\0\0"),
            chunk(b"LAYR", &[0; 18]),
            chunk(b"PNTS", &floats(corners().as_flattened())),
            chunk(b"POLS", &[b"FACE".as_slice(), &polygons].concat()),
            chunk(b"PTAG", &[b"SURF".as_slice(), &tags].concat()),
            chunk(b"SURF", &[b"orange\0\0\0\0".as_slice(), &color, &diffuse].concat()),
        ]
        .concat();
        chunk(b"FORM", &body)
    }

    /// Milkshape, version 4.
    fn ms3d_file() -> Vec<u8> {
        let floats = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
        let short = |number: usize| (number as u16).to_le_bytes().to_vec();
        let name = |name: &str, length: usize| [name.as_bytes(), &vec![0; length - name.len()]].concat();
        let vertex = |corner: &[f32; 3]| [vec![0], floats(corner), vec![0xff, 3]].concat();
        let triangle = |places: [usize; 3]| {
            let indices: Vec<u8> = places.into_iter().flat_map(short).collect();
            let [a, b, c] = places.map(|place| Vec3::from_array(corners()[place]));
            let normal = (b - a).cross(c - a).normalize().to_array();
            [short(0), indices, floats(&[normal; 3].concat()), floats(&[0.0; 6]), vec![1, 0]].concat()
        };
        let colors =
            floats(&[0.0, 0.0, 0.0, 1.0, 1.0, 0.5, 0.25, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
        [
            [b"MS3D000000".as_slice(), &4u32.to_le_bytes()].concat(),
            [short(8), corners().iter().flat_map(vertex).collect()].concat(),
            [short(12), triangles().flat_map(triangle).collect()].concat(),
            [short(1), vec![0], name("box", 32), short(12), (0..12).flat_map(short).collect(), vec![0]].concat(),
            [short(1), name("orange", 32), colors, vec![0], name("", 256)].concat(),
            [floats(&[25.0, 0.0]), vec![0; 4], short(0)].concat(),
        ]
        .concat()
    }

    fn files() -> [(&'static str, Vec<u8>); 5] {
        [
            ("box.x", x_file()),
            ("box.dxf", dxf_file()),
            ("box.ase", ase_file()),
            ("box.lwo", lwo_file()),
            ("box.ms3d", ms3d_file()),
        ]
    }

    /// Whether there is a library to test; says so where not.
    fn has_library() -> bool {
        let read = read_bytes(&dxf_file(), "box.dxf", &[], &LoadOptions::default());
        match read.map_err(|error| error.to_string()) {
            Err(message) if message.contains("is read by libassimp, which is not installed") => {
                skip("libassimp: the library is not there; on Debian: apt-get install libassimp5");
                false
            }
            read => {
                read.unwrap();
                true
            }
        }
    }

    fn volume(mesh: &Mesh) -> f64 {
        let corners = mesh.triangles.iter().map(|corners| corners.map(|index| mesh.positions[index as usize]));
        corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn a_box_in_each_format_stands_upright_in_its_colour_and_looks_outwards() {
        if !has_library() {
            return;
        }
        let folder = Folder::new();
        for (name, bytes) in files() {
            let loaded = load(&folder.file(name, &bytes), &LoadOptions::default()).unwrap();
            let mesh = loaded.mesh;
            assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12), "{name}");
            // X and LWO have z into the picture, DXF and ASE upwards; Milkshape has it as here.
            let place: fn(DVec3) -> DVec3 = match name {
                "box.x" | "box.lwo" => |v| dvec3(v.x, v.y, -v.z),
                "box.ms3d" => |v| v,
                _ => |v| dvec3(v.x, v.z, -v.y),
            };
            for corner in corners() {
                let expected = place(DVec3::from_array(corner.map(f64::from)));
                assert!(mesh.positions.iter().any(|at| at.distance(expected) < 1e-6), "{name}: {expected}");
            }
            assert!((volume(&mesh) - 6.0).abs() < 1e-5, "{name}: {}", volume(&mesh));
            let material = &mesh.materials[mesh.triangle_materials[0] as usize];
            if name != "box.dxf" {
                let color = material.color.unwrap();
                let off = color.iter().zip([1.0, 0.5, 0.25]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(material.name == "orange" && off < 1e-6, "{name}: {material:?}");
            }
            assert!(mesh.defects.is_empty(), "{name}: {}", mesh.defects);
        }
    }

    #[test]
    fn a_picture_that_such_a_file_names_is_found_beside_it_and_the_axis_can_be_named() {
        if !has_library() {
            return;
        }
        let folder = Folder::new();
        let model = folder.file("box.x", &x_file());
        let loaded = load(&model, &LoadOptions::default()).unwrap();
        assert!(!loaded.mesh.materials[0].has_texture());
        one_line(&format!("{}\n", loaded.remarks.join(" ")), &["box.x: the picture skin.png is not beside it"]);
        folder.file("skin.png", b"");
        let loaded = load(&model, &LoadOptions { up_axis: UpAxis::MinusY, ..LoadOptions::default() }).unwrap();
        let texture = loaded.mesh.materials.iter().find_map(|material| material.texture.clone()).unwrap();
        assert!(loaded.remarks.is_empty() && texture.ends_with("skin.png"), "{:?}", loaded.remarks);
        let (low, high) = loaded.mesh.bounds();
        assert_eq!((low, high), (dvec3(-1.0, -2.0, -3.0), DVec3::ZERO));
        assert_eq!(loaded.mesh.triangle_texture_coordinates.len(), 12);
    }

    /// A scene of LightWave that shows the box twice, the second time moved by 10 along x.
    fn scene(object: &str) -> String {
        let item = |x: f32| {
            format!(
                "LoadObjectLayer 1 {object}\nShowObject 8 -1 0 0 0\nObjectMotion\nNumChannels 9\n{}",
                lines(
                    [x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0].iter().enumerate().map(|(number, value)| format!(
                        "Channel {number}\n{{ Envelope\n  1\n  Key {value} 0 0 0 0 0 0 0 0\n  Behaviors 1 1\n}}\n"
                    )),
                    ""
                )
            )
        };
        format!("LWSC\n3\n\n{}{}", item(0.0), item(10.0))
    }

    #[test]
    fn files_that_such_a_file_names_are_read_in_its_folder_and_elsewhere_only_when_asked_to() {
        if !has_library() {
            return;
        }
        let folder = Folder::new();
        std::fs::create_dir(folder.path("scene")).unwrap();
        folder.file("scene/box.lwo", &lwo_file());
        folder.file("outside.lwo", &lwo_file());
        let inside = folder.file("scene/inside.lws", scene("box.lwo").as_bytes());
        let loaded = load(&inside, &LoadOptions::default()).unwrap();
        assert_eq!((loaded.mesh.triangles.len(), loaded.mesh.positions.len()), (24, 16));
        assert!(loaded.files.contains(&folder.path("scene/box.lwo").into()), "{:?}", loaded.files);
        let (low, high) = loaded.mesh.bounds();
        assert!((high.x - low.x - 11.0).abs() < 1e-6, "{low} {high}");
        let outside = folder.file("scene/outside.lws", scene("../outside.lwo").as_bytes());
        let output = tinta(&["edges", &outside]);
        assert_eq!(output.status.code(), Some(2));
        let loaded = load(&outside, &LoadOptions { allow_external: true, ..LoadOptions::default() }).unwrap();
        assert_eq!(loaded.mesh.triangles.len(), 24);
    }

    #[test]
    fn files_that_the_library_does_not_read_are_refused_in_a_sentence() {
        if !has_library() {
            return;
        }
        let folder = Folder::new();
        for (name, bytes) in files() {
            let cut = folder.file(name, &bytes[..bytes.len() / 3]);
            let output = tinta(&["edges", &cut]);
            // Text that ends early may still hold some faces.
            if output.status.code() != Some(0) {
                refused(&output, &[name]);
            }
        }
        for name in ["garbage.ms3d", "garbage.lwo", "garbage.x"] {
            let model = folder.file(name, b"v 0 0 0\nnothing of the kind\n");
            refused(&tinta(&["edges", &model]), &[name, "libassimp cannot read it (", "export it again"]);
        }
    }
}
