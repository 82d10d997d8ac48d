//! Files made to harm: false counts, pictures that decompress to huge sizes, names that break lines, invalid files, endless
//! faces.

use crate::program::{assert_refused, done, one_line, tinta};
use crate::support::{Folder, root, scene_of_mesh};
use std::io::{Seek, Write};
use std::path::Path;
use std::process::{Command, Output};
use tinta::mesh::read_bytes;
use tinta::{LoadOptions, load};

pub const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n";

/// Runs the program with so many MiB of address space: a program that exceeds it is killed and does not exit with code 2.
#[cfg(unix)]
fn tinta_within(mebibytes: usize, arguments: &[&str]) -> Output {
    let script = format!("ulimit -v {}; exec \"$@\"", mebibytes << 10);
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_tinta")]).args(arguments).current_dir(root());
    command.output().unwrap()
}

/// A PNG file's chunk.
fn png_chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind.as_slice(), data].concat();
    let mut remainder = u32::MAX;
    for byte in &body {
        remainder ^= u32::from(*byte);
        (0..8).for_each(|_| remainder = remainder >> 1 ^ if remainder & 1 == 1 { 0xedb8_8320 } else { 0 });
    }
    [(data.len() as u32).to_be_bytes().as_slice(), &body, &(!remainder).to_be_bytes()].concat()
}

/// A PNG file of 200 bytes that declares so many pixels.
fn bomb(width: u32, height: u32) -> Vec<u8> {
    let header = [width.to_be_bytes().as_slice(), &height.to_be_bytes(), &[8, 2, 0, 0, 0]].concat();
    let data = [0x78, 0x01].into_iter().chain([0; 120]).collect::<Vec<u8>>();
    [b"\x89PNG\r\n\x1a\n".to_vec(), png_chunk(b"IHDR", &header), png_chunk(b"IDAT", &data), png_chunk(b"IEND", b"")]
        .concat()
}

#[test]
fn formats_that_are_not_read_are_refused_by_name_whatever_their_lines_look_like() {
    let folder = Folder::new();
    for (name, format) in [
        ("foo.ms3d", "MS3D"),
        ("foo.X", "X"),
        ("foo.dxf", "DXF"),
        ("foo.lwo", "LWO"),
        ("foo.nff", "NFF"),
        ("foo.fbx", "FBX"),
    ] {
        let model = folder.file(name, b"v 0 0 0\nf 1 1 1\n");
        let sentence = format!("{name}: {format} is not read; export it as STL, OBJ or glTF");
        assert_refused(&tinta(&["info", &model]), &[&sentence]);
    }
    let model = folder.file("foo.q3o", b"quick3Do");
    assert_refused(&tinta(&["info", &model]), &["foo.q3o: this is not a model in a supported format"]);
}

#[cfg(unix)]
#[test]
fn files_that_lie_about_their_counts_are_refused_without_the_memory() {
    let folder = Folder::new();
    let words = |numbers: &[u32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let header = "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 3000000000\n\
        property list uint int vertex_indices\n";
    let ply = |format: &str, header: &str, rest: &[u8]| {
        [format!("ply\nformat {format} 1.0\n{header}end_header\n").as_bytes(), rest].concat()
    };
    let md2 = |place: usize| {
        let mut header = [8, 32, 64, 40, 0, 0, 0, 0, 0, 1, 68, 68, 68, 68, 68, 108];
        header[place] = u32::MAX;
        [b"IDP2".as_slice(), &words(&header), &[0; 40]].concat()
    };
    let chunk = |number: u16, data: &[u8]| {
        [number.to_le_bytes().as_slice(), &(data.len() as u32 + 6).to_le_bytes(), data].concat()
    };
    let three_ds = |number: u16| {
        let mesh = chunk(0x4100, &chunk(number, &[0xff, 0xff, 1, 2, 3]));
        chunk(
            0x4d4d,
            &[chunk(2, &[3, 0, 0, 0]), chunk(0x3d3d, &chunk(0x4000, &[b"o\0", mesh.as_slice()].concat()))].concat(),
        )
    };
    let files = [
        (
            "vertices.ply",
            ply("binary_little_endian", header, &[0; 30]),
            "ends before the last of the file's 4000000000 vertices",
        ),
        ("vertices-text.ply", ply("ascii", header, b"0 0 0\n"), "line 8: it is damaged or cut off"),
        ("faces.ply", ply("binary_big_endian", faces, &[0; 30]), "3000000000 face"),
        ("list.ply", ply("binary_little_endian", faces, &[0xff; 30]), "3000000000 face"),
        ("a.stl", [[b' '; 80].as_slice(), &words(&[u32::MAX]), &[0; 60]].concat(), "promises 4294967295 triangles"),
        ("vertices.md2", md2(5), "4294967295 vertices need"),
        ("skins.md2", md2(4), "promises 4294967295 skins"),
        ("triangles.md2", md2(7), "promises 4294967295 triangles"),
        ("frames.md2", md2(9), "promises 4294967295 frames"),
        ("end.md2", md2(15), "promises 4294967295 bytes"),
        ("vertices.3ds", three_ds(0x4110), "its part 4110 is damaged"),
        ("faces.3ds", three_ds(0x4120), "its part 4120 is damaged"),
        ("chunk.3ds", [b"MM".as_slice(), &words(&[u32::MAX]), &[2, 0, 0, 0]].concat(), "promises 4294967295 bytes"),
    ];
    for (name, bytes, sentence) in files {
        assert_refused(&tinta_within(1500, &["info", &folder.file(name, &bytes)]), &[name, sentence]);
    }
}

#[cfg(unix)]
#[test]
fn pictures_that_unfold_are_refused_before_they_do() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let mut pcx = vec![10, 5, 1, 8, 0, 0, 0, 0, 0xff, 0x3f, 0xff, 0x3f];
    pcx.resize(65, 0);
    pcx.extend([3, 0, 0x40]);
    pcx.resize(400, 0xff);
    let whole = bomb(60_000, 60_000);
    assert!(whole.len() < 250);
    let files = [
        ("bomb.png", whole, "longer than 16384 pixels"),
        ("lie.png", bomb(16_384, 16_384), "bytes cannot hold 16384 x 16384 pixels"),
        ("lie.pcx", pcx, "bytes cannot hold 16384 x 16384 pixels"),
        ("lie.ppm", b"P6\n16384 16384\n255\n".to_vec(), "bytes cannot hold"),
        // Long enough for white pixels, but too short to justify a gibibyte.
        ("large.png", [bomb(16_384, 16_384), vec![0; 50_000]].concat(), "take 1024 MiB of memory"),
    ];
    for (name, bytes, sentence) in files {
        let file = folder.file(name, &bytes);
        let arguments =
            ["render", "builtin:ant", "-o", &out, "--style", "inking", "--texture", &format!("ramp={}", file)];
        assert_refused(&tinta_within(700, &arguments), &[name, sentence]);
    }
    // As a model's texture it is read only when a style needs it.
    folder.file("a.mtl", b"newmtl a\nmap_Kd bomb.png\n");
    let model = folder.file("a.obj", format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1/1 2/1 3/2\n").as_bytes());
    let scene = scene_of_mesh(load(&model, &LoadOptions::default()).unwrap().mesh);
    let message = tinta::picture::material_pictures(&scene.objects[0].mesh.materials).unwrap_err().to_string();
    assert!(message.contains("bomb.png: it is longer than 16384 pixels"), "{message}");
}

#[cfg(unix)]
#[test]
fn names_that_break_lines_or_command_the_terminal_are_said_in_one_line() {
    let folder = Folder::new();
    let name = "a\nb\r\u{1b}[2J\u{202e}.obj";
    assert_refused(&tinta(&["info", &folder.path(name)]), &["a\\nb\\r\\u{1b}[2J\\u{202e}.obj: there is no such file"]);
    assert_refused(&tinta(&["info", "--no\n\nsuch\u{1b}"]), &["--no"]);
    // A material's, a picture's and a material file's names, the last without end.
    let text = format!("mtllib \u{1b}]0;x\u{7}.mtl\nmtllib {}\n{SQUARE}f 1 2 3\nf 1 3 4\n", "x".repeat(100_000));
    let model = folder.file("names.obj", text.as_bytes());
    let output = done(&["info", &model]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(said.matches('\n').count(), 2, "{said:.2000}");
    assert!(said.contains("\\u{1b}]0;x\\u{7}.mtl is missing") && said.len() < 1000, "{said:.2000}");
}

#[cfg(unix)]
fn check_zeros(bytes: u64) {
    let folder = Folder::new();
    let zeros = folder.file("zeros.obj", b"");
    std::fs::File::options().write(true).open(&zeros).unwrap().set_len(bytes).unwrap();
    assert_refused(&tinta_within(1600, &["info", &zeros]), &["zeros.obj: it holds no vertices and no faces"]);
    for (name, sentence) in [
        ("zeros.stl", "it holds no vertices"),
        ("zeros.ply", "does not begin like"),
        ("zeros.3ds", "does not begin like"),
    ] {
        let link = folder.path(name);
        std::os::unix::fs::symlink(&zeros, &link).unwrap();
        assert_refused(&tinta_within(1600, &["info", &link]), &[name, sentence]);
    }
    let out = folder.path("out.png");
    let arguments = ["render", "builtin:ant", "-o", &out, "--style", "inking", "--texture", &format!("ramp={}", zeros)];
    let sentence = if bytes > 640 << 20 { "zeros.obj: it is larger than 640 MiB" } else { "zeros.obj: " };
    assert_refused(&tinta_within(600, &arguments), &[sentence]);
    let merge = ["measure", "--merge", &zeros, "-o", &folder.path("merged")];
    assert_refused(&tinta_within(1600, &merge), &["zeros.obj"]);
}

#[cfg(unix)]
#[test]
fn sixteen_mebibytes_of_zeros_are_refused_whatever_they_are_called() {
    check_zeros(16 << 20);
}

#[cfg(unix)]
#[test]
#[ignore = "nightly: a gibibyte is read six times"]
fn a_gibibyte_of_zeros_is_refused_whatever_it_is_called_nightly() {
    check_zeros(1 << 30);
}

#[cfg(unix)]
#[test]
fn pipes_and_folders_are_refused_wherever_a_file_is_read_and_nobody_waits_for_them() {
    let folder = Folder::new();
    let pipe = folder.path("results.jsonl");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let inside = folder.path("");
    let (out, new) = (folder.path("out.png"), folder.path("new"));
    let with_ramp = |file: &str| {
        tinta(&["render", "builtin:ant", "-o", &out, "--style", "inking", "--texture", &format!("ramp={file}")])
    };
    for (file, what) in
        [(pipe.as_str(), "this is a pipe or a device, not a regular file"), (inside.as_str(), "this is a ")]
    {
        assert_refused(&tinta(&["info", file]), &[what]);
        assert_refused(&with_ramp(file), &[what]);
        assert_refused(&tinta(&["measure", "--merge", file, "-o", &new]), &[what]);
    }
    assert_refused(&tinta(&["info", "builtin:ant", "--texture", &format!("skin={}", pipe)]), &["not a regular file"]);
    for open in [tinta_lab::report::RowLog::create, |folder: &Path| {
        tinta_lab::report::RowLog::resume(folder).map(|(log, _)| log)
    }] {
        let message = open(Path::new(&inside)).unwrap_err().to_string();
        assert!(message.contains("results.jsonl: this is not a regular file"), "{message}");
    }
    let model = folder.file("a.obj", format!("mtllib results.jsonl\n{SQUARE}f 1 2 3\nf 1 3 4\n").as_bytes());
    let output = done(&["info", &model]);
    one_line(&String::from_utf8(output.stderr).unwrap(), &["the material file results.jsonl is missing"]);
}

/// Cuts faces of so many corners, every other one recessed by such a depth, into so many triangles.
fn check_many_corners(faces: &[(u32, f64, usize)]) {
    for &(corners, depth, made) in faces {
        let mut text = String::new();
        for i in 0..corners {
            let (y, x) = (f64::from(i) / f64::from(corners) * std::f64::consts::TAU).sin_cos();
            let radius = 1.0 + f64::from(i % 2) * depth;
            text.push_str(&format!("v {} {} 0\n", x * radius, y * radius));
        }
        text.push('f');
        (1..=corners).for_each(|i| text.push_str(&format!(" {i}")));
        // One triangle more, to leave one to draw.
        text.push_str("\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\n");
        let options = LoadOptions { weld: 0.0, ..LoadOptions::default() };
        let mesh = read_bytes(text.as_bytes(), "face.obj", &[], &options).unwrap().mesh;
        let lost = mesh.defects.degenerate_triangles;
        // A face with too many corners is reported as a whole.
        let is_left_out = made == 0;
        assert_eq!(mesh.defects.long_polygons, usize::from(is_left_out), "{corners} {depth}");
        let whole = if is_left_out { 1 } else { corners as usize - 1 };
        assert_eq!(mesh.triangles.len() + lost, whole, "{corners} {depth}");
        assert!(
            mesh.triangles.len() - 1 <= made && mesh.triangles.len() + 1000 > made,
            "{corners} {depth}: {lost} lost"
        );
    }
}

#[test]
fn faces_of_a_hundred_thousand_corners_come_to_an_end_and_convex_ones_are_cut() {
    check_many_corners(&[(100_000, 0.0, 99_998), (10_000, 0.02, 9_998)]);
}

#[test]
#[ignore = "exhaustive: a million corners"]
fn faces_of_a_million_corners_come_to_an_end_and_convex_ones_are_cut() {
    check_many_corners(&[(1_000_000, 0.0, 999_998), (30_000, 0.02, 29_998), (1_000_000, 0.02, 0)]);
}

#[test]
fn polygons_that_cross_themselves_a_hundred_thousand_times_come_to_an_end() {
    let count = 100_000u32;
    let mut text = String::new();
    for i in 0..count {
        let [x, y] = [2_654_435_761, 2_246_822_519].map(|factor: u32| f64::from(i.wrapping_mul(factor)) / 4e9);
        text.push_str(&format!("v {x} {y} 0\n"));
    }
    text.push('f');
    (1..=count).for_each(|i| text.push_str(&format!(" {i}")));
    text.push_str("\nf 1 2 3\n");
    let mesh = read_bytes(text.as_bytes(), "knot.obj", &[], &LoadOptions::default()).unwrap().mesh;
    assert_eq!((mesh.triangles.len(), mesh.defects.degenerate_triangles, mesh.defects.long_polygons), (1, 0, 1));
}

#[cfg(unix)]
#[test]
fn corners_of_two_bytes_each_are_refused_before_they_take_more_than_twenty_times_the_file() {
    let folder = Folder::new();
    let model = folder.path("corners.obj");
    let mut file = std::io::BufWriter::new(std::fs::File::create(&model).unwrap());
    file.write_all(SQUARE.as_bytes()).unwrap();
    file.write_all(b"f").unwrap();
    let words = b" 1 2 3 4".repeat(1000);
    (0..2500).for_each(|_| file.write_all(&words).unwrap());
    let bytes = file.stream_position().unwrap() as usize;
    drop(file);
    assert_eq!(bytes >> 20, 19);
    // 20 times the file, the slack of docs/dev/limits.md, and the basic address space of a process.
    let sentence =
        "corners.obj: its 4 vertices and 9999998 triangles take more than 20 times the file's size in memory";
    assert_refused(&tinta_within(20 * 20 + 64 + 300, &["info", &model]), &[sentence]);
}

#[cfg(unix)]
#[test]
fn chunks_in_chunks_a_hundred_thousand_deep_do_not_go_deeper() {
    let folder = Folder::new();
    // A chunk's length counts all that is in it.
    let depth = 100_000u32;
    let numbers = [0x3d3d_u16, 0x4000, 0x4100, 0x4120, 0x4130, 0xafff, 0xa200];
    let mut bytes = [b"MM".as_slice(), &(depth * 6 + 16).to_le_bytes(), &[2, 0, 10, 0, 0, 0, 3, 0, 0, 0]].concat();
    for level in 0..depth {
        bytes.extend(numbers[level as usize % numbers.len()].to_le_bytes());
        bytes.extend(((depth - level) * 6).to_le_bytes());
    }
    assert_eq!(bytes.len() as u32, depth * 6 + 16);
    assert_refused(&tinta_within(700, &["info", &folder.file("deep.3ds", &bytes)]), &["deep.3ds"]);
}

fn check_long_lines(bytes: usize) {
    let blanks = " ".repeat(bytes);
    for text in [
        format!("v 0 0 0\nv 1 0{blanks}0\nv 0 1 0\nf 1 2 3\n"),
        format!("#{blanks}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n{}3\n", "\\\n".repeat(bytes / 2)),
    ] {
        let mesh = read_bytes(text.as_bytes(), "long.obj", &[], &LoadOptions::default()).unwrap().mesh;
        assert_eq!((mesh.triangles.len(), mesh.positions.len()), (1, 3));
    }
}

#[test]
fn lines_of_a_megabyte_are_read() {
    check_long_lines(1_000_000);
}

#[test]
#[ignore = "nightly: 300 megabytes of blanks"]
fn lines_of_a_hundred_megabytes_are_read_nightly() {
    check_long_lines(100_000_000);
}

#[test]
fn numbers_that_many_names_are_looked_up_by_do_not_multiply() {
    // 16,000 materials, each used 20 times; every other name is in no file.
    let materials: String = (0..16_000).map(|i| format!("newmtl m{i}\n")).collect();
    let uses: String = (0..320_000).map(|i| format!("usemtl m{}\nf 1 2 3\n", i % 32_000)).collect();
    let text = format!("{SQUARE}mtllib a.mtl\n{uses}f 1 3 4\n");
    let loaded =
        read_bytes(text.as_bytes(), "many.obj", &[("many.mtl", materials.as_bytes())], &LoadOptions::default())
            .unwrap();
    assert_eq!((loaded.mesh.defects.missing_materials, loaded.mesh.materials.len()), (16_000, 16_000));
    let more: String = (0..16_385).map(|i| format!("newmtl m{i}\n")).collect();
    let error =
        read_bytes(text.as_bytes(), "many.obj", &[("many.mtl", more.as_bytes())], &LoadOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("many.obj: it has more than 16384 materials"), "{error}");
    let libraries: String = (0..1025).map(|i| format!("mtllib {i}\n")).collect();
    let error = read_bytes(libraries.as_bytes(), "many.obj", &[], &LoadOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("many.obj: it names more than 1024 material files"), "{error}");
}

#[test]
fn hundreds_of_missing_files_are_counted_and_a_few_said() {
    let folder = Folder::new();
    let libraries: String = (0..500).map(|i| format!("mtllib no-{i}.mtl\n")).collect();
    let model = folder.file("a.obj", format!("{libraries}{SQUARE}f 1 2 3\nf 1 3 4\n").as_bytes());
    let remarks = load(&model, &LoadOptions::default()).unwrap().remarks;
    assert_eq!(remarks.len(), 9, "{remarks:?}");
    assert!(remarks[8].ends_with("492 more material files are missing or were not read"), "{remarks:?}");
}

/// Where each corner of a polygon lies.
type Outline<'a> = &'a dyn Fn(u32) -> (f64, f64);

#[test]
fn combs_and_stars_of_many_corners_are_drawn_whole() {
    let folder = Folder::new();
    for count in [1028, 8000, 32_768] {
        let comb = |i: u32| {
            (f64::from(i) / f64::from(count), f64::from(i % 4 == 1 || i % 4 == 2) - f64::from(i == 0 || i == count - 1))
        };
        let star = |i: u32| {
            let (turn, radius) =
                (f64::from(i) / f64::from(count) * std::f64::consts::TAU, 1.0 - 0.5 * f64::from(i % 2));
            (turn.cos() * radius, turn.sin() * radius)
        };
        let shapes: [(&str, Outline<'_>); 2] = [("comb", &comb), ("star", &star)];
        for (name, point) in shapes {
            let mut text: String = (0..count).map(point).map(|(x, y)| format!("v {x} {y} 0\n")).collect();
            text += "f";
            (1..=count).for_each(|corner| text += &format!(" {corner}"));
            let mesh =
                load(&folder.file(&format!("{name}.obj"), text.as_bytes()), &LoadOptions::default()).unwrap().mesh;
            assert_eq!(
                (mesh.triangles.len(), mesh.defects.degenerate_triangles),
                (count as usize - 2, 0),
                "{name} of {count}"
            );
        }
    }
}

#[test]
fn a_polygon_of_too_many_corners_is_named_as_that() {
    let folder = Folder::new();
    let count = 40_000;
    let mut text: String = (0..count)
        .map(|i| format!("v {i} {} 0\n", i32::from(i % 4 == 1 || i % 4 == 2) - i32::from(i == 0 || i == count - 1)))
        .collect();
    text += "f";
    (1..=count).for_each(|corner| text += &format!(" {corner}"));
    let alone = folder.file("alone.obj", text.as_bytes());
    let problem = load(&alone, &LoadOptions::default()).unwrap_err().to_string();
    assert!(problem.contains("1 polygon of too many corners") && problem.contains("cut into triangles"), "{problem}");
    let among = folder.file("among.obj", format!("{text}\nf 1 2 3\n").as_bytes());
    let loaded = load(&among, &LoadOptions::default()).unwrap();
    let defects = &loaded.mesh.defects;
    assert_eq!((loaded.mesh.triangles.len(), defects.long_polygons, defects.degenerate_triangles), (1, 1, 0));
}
