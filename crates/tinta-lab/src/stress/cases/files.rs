//! Model files that lie, have another format, or are missing. docs/dev/limits.md has the other findings of fuzzing.

use super::case::{Case, Content, Demand, Group, Work};

pub(super) fn cases() -> Vec<Case> {
    let refused = |words| Demand::Refused { kind: "model", words };
    let text = |text: &str| Content::Bytes(text.as_bytes().to_vec());
    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n\
               property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\nnothing";
    let mut stl = vec![b' '; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([0; 50]);
    // IDP2, version 8, and counts of frames, vertices and triangles that no file could hold.
    let md2: Vec<u8> = b"IDP2".iter().copied().chain([8, 0, 0, 0]).chain([0x7f; 60]).collect();
    // A chunk that declares two gigabytes, inside one that also does.
    let three_ds =
        [&0x4d4d_u16.to_le_bytes()[..], &u32::MAX.to_le_bytes(), &0x3d3d_u16.to_le_bytes(), &u32::MAX.to_le_bytes()];
    let mut all = vec![
        case("an empty file", "empty.obj", Content::Bytes(Vec::new()), refused("empty")),
        case("a missing file", "missing.obj", Content::Missing, refused("no such file")),
        case("a folder", "folder.obj", Content::Folder, refused("directory")),
        case("a gibibyte of zeros", "zeros.stl", Content::Zeros(1 << 30), refused("zeros.stl")),
        case("a million zeros", "zeros", Content::Zeros(1_000_000), refused("not a model")),
        case("vertices without a face", "square.obj", text(SQUARE), refused("no faces")),
        case(
            "faces of missing vertices",
            "beyond.obj",
            text(&format!("{SQUARE}f 5 6 7\n")),
            refused("index out of range"),
        ),
        case(
            "vertices that are not numbers",
            "nan.obj",
            text("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            refused("not finite"),
        ),
        case("a face with a letter", "letter.obj", text(&format!("{SQUARE}f 1 2 x\n")), refused("line 5")),
        case("a header that promises four billion vertices", "lie.ply", text(ply), refused("lie.ply")),
        case("a count of four billion triangles", "lie.stl", Content::Bytes(stl), refused("lie.stl")),
        case("two billion frames", "lie.md2", Content::Bytes(md2), refused("lie.md2")),
        case("chunks longer than their file", "lie.3ds", Content::Bytes(three_ds.concat()), refused("lie.3ds")),
        case("a name of two lines", "two\nlines.obj", text("f"), refused("lines.obj")),
        case("a square", "sound.obj", text(&format!("{SQUARE}f 1 2 3 4\n")), Demand::Rendered).with(
            "has_defects",
            0.0,
            0.0,
        ),
        case("a square that crosses itself", "bow-tie.obj", text(&format!("{SQUARE}f 1 3 2 4\n")), Demand::Rendered)
            .with("has_defects", 1.0, 1.0),
    ];
    // The file is its own material file.
    for (number, kd) in ["Kd nan 0 0", "Kd -1 2 1e30", "Kd", "Kd .5 .5 inf"].into_iter().enumerate() {
        let file = ["kd-0.obj", "kd-1.obj", "kd-2.obj", "kd-3.obj"][number];
        let content = text(&format!("mtllib {file}\nnewmtl a\n{kd}\n{SQUARE}usemtl a\nf 1 2 3 4\n"));
        let name = format!("a material whose colour is {kd}");
        all.push(case(&name, file, content, Demand::Rendered).with("has_defects", 1.0, 1.0));
    }
    all
}

fn case(name: &str, file: &'static str, content: Content, expected: Demand) -> Case {
    Case::of(Group::Files, name, Work::Read(file, content), expected)
}
