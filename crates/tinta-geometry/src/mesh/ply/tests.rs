//! PLY files written here, text and binary, whole, odd and damaged.

use super::*;

const HEADER: &str = "ply\nformat ascii 1.0\ncomment test\nelement vertex 4\nproperty float x\nproperty float y\n\
    property double z\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n\
    element edge 1\nproperty int a\nend_header\n";

#[test]
fn a_text_file_with_polygons_and_foreign_elements_is_read() {
    let text = format!("{HEADER}0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3 9\n3 0 1 7 9\n5\n");
    let soup = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
    assert_eq!(soup.positions[2], DVec3::new(1.0, 1.0, 0.5));
    assert_eq!(soup.polygon_sizes, [4]);
    assert_eq!(soup.defects.out_of_range_faces, 1);
}

#[test]
fn empty_lines_faces_of_several_lines_and_any_order_of_elements_are_understood() {
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    let (vertex, face) =
        (format!("element vertex 3\n{xyz}"), "element face 1\nproperty list uchar int vertex_indices\n");
    let camera = format!("element camera 1\n{xyz}");
    let (points, corners) = ("0 0 0\n1 0 0 0 7\n0 1 0\n", "3 0 1 2\n");
    for text in [
        format!("ply\nformat ascii 1.0\n{vertex}{face}end_header\n\n{points}\n \n{corners}"),
        format!("ply\nformat ascii 1.0\n\n{vertex}\n{face}end_header\n{points}3 0\n\n1\n2"),
        format!("ply\nformat ascii 1.0\n{face}{vertex}end_header\n{corners}{points}"),
        format!("ply\nformat ascii 1.0\n{camera}{vertex}{face}end_header\n9 9 9\n{points}{corners}"),
        format!("ply\nformat ascii 1.0\n{vertex}{face}{camera}end_header\n{points}{corners}9 9 9"),
    ] {
        for text in [text.clone(), text.replace('\n', "\r"), text.replace('\n', "\r\n")] {
            let soup = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
            assert_eq!(soup.positions, [DVec3::ZERO, DVec3::X, DVec3::Y], "{text}");
            assert_eq!(soup.corners.iter().map(|corner| corner.position).collect::<Vec<_>>(), [0, 1, 2], "{text}");
        }
    }
}

#[test]
fn a_face_of_three_hundred_corners_is_read_from_every_kind_of_binary_file() {
    let head = |encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex 300\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list ushort uint vertex_indices\nend_header\n"
        )
    };
    let angle = |k: u16| f32::from(k) * std::f32::consts::TAU / 300.0;
    let floats: Vec<f32> = (0..300).flat_map(|k| [angle(k).cos(), angle(k).sin(), 0.0]).collect();
    for (encoding, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut file = head(encoding).into_bytes();
        let order = |mut bytes: Vec<u8>| {
            if is_big {
                bytes.reverse();
            }
            bytes
        };
        floats.iter().for_each(|number| file.extend(order(number.to_le_bytes().to_vec())));
        file.extend(order(300u16.to_le_bytes().to_vec()));
        (0u32..300).for_each(|index| file.extend(order(index.to_le_bytes().to_vec())));
        let soup = read(&file, "t.ply", &mut Vec::new()).unwrap();
        assert_eq!((soup.polygon_sizes.as_slice(), soup.corners.len()), (&[300][..], 300), "{encoding}");
        let mesh = soup.into_mesh("t.ply", &crate::LoadOptions::default()).unwrap();
        assert_eq!(mesh.triangles.len(), 298, "{encoding}");
    }
}

#[test]
fn coordinates_without_a_picture_and_foreign_header_lines_are_said() {
    let text = "ply\nformat ascii 1.0\nCreated by a program\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nproperty float s\nproperty float t\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n";
    let mut remarks = Vec::new();
    read(text.as_bytes(), "t.ply", &mut remarks).unwrap();
    let foreign = "t.ply: line 3 of its header is none of PLY and was passed over";
    let picture = "t.ply: it has texture coordinates but names no picture; --skin FILE puts one on";
    assert_eq!(remarks, [foreign, picture]);
}

#[test]
fn triangles_read_at_once_are_those_read_one_by_one() {
    // With a colour behind each face none are read at once.
    let file = |faces: &[(u8, [i32; 3])], has_color: bool| {
        let color = if has_color { "property uchar red\n" } else { "" };
        let mut file = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\nproperty float s\nproperty float t\nelement face {}\n\
             property list uchar int vertex_indices\n{color}element other 1\nproperty uchar a\nend_header\n",
            faces.len()
        )
        .into_bytes();
        file.extend([0u8; 4 * 20]);
        for (count, corners) in faces {
            file.push(*count);
            file.extend(corners[..usize::from(*count)].iter().flat_map(|corner| corner.to_le_bytes()));
            file.extend(has_color.then_some(7));
        }
        file.push(1);
        read(&file, "t.ply", &mut Vec::new()).unwrap()
    };
    for (faces, kept, wrong) in [
        (&[(3, [0, 1, 2]), (3, [3, 2, 1])][..], 2, [0, 0]),
        (&[(3, [0, 1, 2]), (3, [3, 2, 4]), (3, [1, 2, 3])], 2, [1, 0]),
        (&[(3, [0, 1, -1]), (3, [3, 2, 1])], 1, [1, 0]),
        (&[(3, [0, 1, 2]), (2, [3, 2, 0]), (3, [1, 2, 3])], 2, [0, 1]),
    ] {
        let [at_once, one_by_one] = [false, true].map(|has_color| {
            let soup = file(faces, has_color);
            let corners: Vec<_> = soup.corners.iter().map(|own| [own.position, own.normal, own.texture]).collect();
            assert_eq!(soup.defects.out_of_range_faces, wrong[0]);
            assert_eq!(soup.defects.degenerate_triangles, wrong[1]);
            (corners, soup.polygon_count())
        });
        assert_eq!(at_once, one_by_one);
        assert_eq!(at_once.1, kept);
    }
}

#[test]
fn colours_at_vertices_are_shares_of_their_types_largest_number() {
    for (kind, written, expected) in [
        ("uchar", "255 51 0", [1.0, 0.2, 0.0]),
        ("ushort", "65535 13107 0", [1.0, 0.2, 0.0]),
        ("float", "1 0.2 -3", [1.0, 0.2, 0.0]),
    ] {
        let colors = ["red", "green", "blue"].map(|name| format!("property {kind} {name}\n")).concat();
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{colors}\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 {written}\n1 0 0 {written}\n\
             0 1 0 {written}\n3 0 1 2\n"
        );
        let soup = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
        assert_eq!(soup.colors, [expected; 3], "{kind}");
        let mesh = soup.into_mesh("t.ply", &crate::LoadOptions::default()).unwrap();
        assert_eq!(mesh.position_colors, [expected; 3], "{kind}");
    }
    let without = format!("{HEADER}0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3 9\n3 0 1 7 9\n5\n");
    assert!(
        read(without.as_bytes(), "t.ply", &mut Vec::new()).unwrap().colors.is_empty(),
        "a face's red is no vertex's"
    );
}

#[test]
fn every_type_of_number_is_read_at_its_extremes_from_both_kinds_of_binary_file() {
    /// A value with its bytes, little end first.
    type ValueBytes = (f64, &'static [u8]);
    // Of each type its largest and its smallest value.
    let types: [(&str, ValueBytes, ValueBytes); 8] = [
        ("char", (127.0, &[0x7f]), (-128.0, &[0x80])),
        ("uchar", (255.0, &[0xff]), (0.0, &[0])),
        ("short", (32_767.0, &[0xff, 0x7f]), (-32_768.0, &[0, 0x80])),
        ("ushort", (65_535.0, &[0xff, 0xff]), (0.0, &[0, 0])),
        ("int", (2_147_483_647.0, &[0xff, 0xff, 0xff, 0x7f]), (-2_147_483_648.0, &[0, 0, 0, 0x80])),
        ("uint", (4_294_967_295.0, &[0xff; 4]), (0.0, &[0; 4])),
        ("float", (1.5, &[0, 0, 0xc0, 0x3f]), (-1.5, &[0, 0, 0xc0, 0xbf])),
        ("double", (1.5, &[0, 0, 0, 0, 0, 0, 0xf8, 0x3f]), (-1.5, &[0, 0, 0, 0, 0, 0, 0xf8, 0xbf])),
    ];
    for (name, (largest, largest_bytes), (smallest, smallest_bytes)) in types {
        for (encoding, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
            let mut file = format!(
                "ply\nformat {encoding} 1.0\nelement vertex 1\nproperty {name} x\nproperty {name} y\n\
                 property {name} z\nend_header\n"
            )
            .into_bytes();
            for bytes in [largest_bytes, smallest_bytes, largest_bytes] {
                let in_order: Vec<u8> = if is_big { bytes.iter().rev().copied().collect() } else { bytes.to_vec() };
                file.extend(in_order);
            }
            let soup = read(&file, "t.ply", &mut Vec::new()).unwrap();
            assert_eq!(soup.positions, [DVec3::new(largest, smallest, largest)], "{name} in {encoding}");
        }
    }
}

#[test]
fn a_cut_off_file_is_an_error_with_its_line() {
    let message = read(format!("{HEADER}0 0 0\n1 0\n").as_bytes(), "t.ply", &mut Vec::new()).unwrap_err().to_string();
    let sentence = "line 15: it is damaged or cut off (it ends before the last of the file's 4 vertices)";
    assert!(message.starts_with(&format!("t.ply: {sentence}")), "{message}");
}

#[test]
fn headers_that_cannot_be_a_model_are_refused_with_the_reason() {
    let refused = |header: &str, reason: &str| {
        let text = format!("ply\nformat ascii 1.0\n{header}end_header\n");
        let message = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap_err().to_string();
        assert!(message.contains(reason), "{message}");
        assert!(!message.contains('{'), "{message}");
    };
    let xyz = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    refused("element vertex 1\nproperty float x\nproperty float y\n", "no x, y and z");
    refused(&format!("{xyz}element face 1\nproperty int a\n"), "no list of vertex_indices");
    refused(&format!("{xyz}element tristrips 1\nproperty int a\n"), "its triangle strips have no list");
    refused("forma", "damaged");
}

#[test]
fn a_strip_turns_every_other_triangle_and_begins_anew_behind_a_negative_index() {
    let triangles = |indices: &[i64]| {
        let mut strip = Strip::default();
        indices.iter().filter_map(|index| strip.triangle(*index)).collect::<Vec<_>>()
    };
    assert_eq!(triangles(&[4, 5, 6, 7, 8]), [[4, 5, 6], [6, 5, 7], [6, 7, 8]]);
    assert_eq!(triangles(&[0, 1, 2, -1, 3, 4, 5, 6]), [[0, 1, 2], [3, 4, 5], [5, 4, 6]]);
    assert!(triangles(&[0, 1, -1, 2, 3, -1]).is_empty());
}

#[test]
fn strips_are_the_faces_that_they_stand_for() {
    // A field of 5 by 4 vertices, row by row: the first two rows as one strip, the others stitched to one.
    let (columns, rows) = (5, 4);
    let vertices: String = (0..columns * rows).map(|i| format!("{} {} 0\n", i % columns, i / columns)).collect();
    let (mut faces, mut strip) = (Vec::new(), Vec::<String>::new());
    for row in 0..rows - 1 {
        for column in 0..columns {
            let (below, above) = (row * columns + column, (row + 1) * columns + column);
            if row == 2 && column == 0 {
                let last = strip.last().unwrap().clone();
                strip.extend([last, above.to_string()]);
            }
            strip.extend([above.to_string(), below.to_string()]);
            if column > 0 {
                faces.push([above - 1, below - 1, above]);
                faces.push([above, below - 1, below]);
            }
        }
        strip.extend((row == 0).then(|| "-1".to_owned()));
    }
    let head = "ply\nformat ascii 1.0\nelement vertex 20\nproperty float x\nproperty float y\nproperty float z\n";
    let list = "property list int int vertex_indices\nend_header\n";
    let of_faces: String = faces.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    let as_faces = format!("{head}element face {}\n{list}{vertices}{of_faces}", faces.len());
    let as_strips = format!("{head}element tristrips 1\n{list}{vertices}{} {}\n", strip.len(), strip.join(" "));
    let corners = |text: &str| {
        let soup = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
        assert!(soup.polygon_sizes.iter().all(|size| *size == 3) && soup.defects.is_empty());
        // The same way round, whichever corner comes first.
        let mut triangles: Vec<[u32; 3]> = soup
            .corners
            .chunks(3)
            .map(|corners| {
                let mut triangle = [corners[0].position, corners[1].position, corners[2].position];
                let least = (0..3).min_by_key(|place| triangle[*place]).unwrap();
                triangle.rotate_left(least);
                triangle
            })
            .collect();
        triangles.sort_unstable();
        triangles
    };
    assert_eq!(corners(&as_faces).len(), 24);
    assert_eq!(corners(&as_strips), corners(&as_faces));
    let (before, _) = as_strips.trim_end().rsplit_once(' ').unwrap();
    assert_eq!(
        read(format!("{before} 20\n").as_bytes(), "t.ply", &mut Vec::new()).unwrap().defects.out_of_range_faces,
        1
    );
}

#[test]
fn a_strip_of_more_triangles_than_its_bytes_are_worth_is_refused() {
    let mut file = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement tristrips 1\nproperty list int uchar vertex_indices\nend_header\n"
        .to_vec();
    file.extend(
        [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].as_flattened().iter().flat_map(|x| x.to_le_bytes()),
    );
    let count = 1_000_000;
    file.extend(i32::to_le_bytes(count));
    file.extend((0..count).map(|place| (place % 3) as u8));
    let soup = read(&file, "t.ply", &mut Vec::new()).unwrap();
    assert!(soup.polygon_sizes.len() < count as usize, "no more is kept than shows that it is too much");
    let message = soup.check_memory(file.len(), "t.ply").unwrap_err().to_string();
    assert!(message.contains("times the file's size in memory"), "{message}");
}

#[test]
fn a_header_that_promises_billions_is_refused_without_the_memory() {
    let text = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n\
        property float z\nend_header\nabc";
    assert!(read(text.as_bytes(), "t.ply", &mut Vec::new()).is_err());
    let text = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nend_header\n";
    let message = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap_err().to_string();
    assert!(message.contains("element without properties"), "{message}");
}

#[test]
fn pictures_named_by_the_models_own_name_and_indices_written_as_floats_are_understood() {
    let file = |encoding: &str, kind: &str| {
        format!(
            "ply\nformat {encoding} 1.0\ncomment TextureFile <this>_A.png\nelement vertex 3\nproperty float x\n\
             property float y\nproperty float z\nelement face 1\nproperty list uchar {kind} vertex_indices\nend_header\n"
        )
    };
    let points = "0 0 0\n1 0 0\n0 1 0\n";
    for (kind, corners, count) in [
        ("float", "3 0 1 2", 3),
        ("double", "3 0.0 1 2e0", 3),
        ("float", "3 0 1 2.5", 0),
        ("float", "3 0 1 3", 0),
        ("float", "3 0 1 nan", 0),
        ("double", "3 0 1 -1", 0),
    ] {
        let text = format!("{}{points}{corners}\n", file("ascii", kind));
        let soup = read(text.as_bytes(), "art/my.model.ply", &mut Vec::new()).unwrap();
        assert_eq!(soup.materials[0].texture.as_deref(), Some(Path::new("my.model_A.png")));
        assert_eq!(
            (soup.corners.len(), soup.defects.out_of_range_faces),
            (count, usize::from(count == 0)),
            "{corners}"
        );
    }
    let floats = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<_>>();
    let positions = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let binary = [file("binary_little_endian", "float").into_bytes(), positions, vec![3], floats(&[2.0, 0.0, 1.0])];
    let soup = read(&binary.concat(), "t.ply", &mut Vec::new()).unwrap();
    assert_eq!(soup.corners.iter().map(|corner| corner.position).collect::<Vec<_>>(), [2, 0, 1]);
}

#[test]
fn strips_of_floats_are_strips() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list uchar float vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 0 1 2 3 0.5\n";
    let soup = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
    assert_eq!((soup.corners.len(), soup.defects.out_of_range_faces), (6, 1));
}

#[test]
fn numbers_that_are_none_in_any_librarys_spelling_cost_their_vertex_alone() {
    for none in ["nan", "-nan(ind)", "1.#IND", "-1.#INF", "1.#QNAN0"] {
        for kind in ["float", "double"] {
            let text = format!(
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty {kind} x\nproperty {kind} y\nproperty {kind} z\n\
                 element face 2\nproperty list uchar int vertex_indices\nend_header\n\
                 0 0 0\n1 0 0\n0 1 0\n{none} {none} 0\n3 0 1 2\n3 0 1 3\n"
            );
            let mesh = read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap();
            let mesh = mesh.into_mesh("t.ply", &crate::LoadOptions::default()).unwrap();
            assert_eq!((mesh.triangles.len(), mesh.defects.non_finite_vertices), (1, 1), "{none} {kind}");
        }
    }
}

#[test]
fn what_follows_the_headers_count_is_read_where_it_is_of_the_last_kind_and_said() {
    let read = |encoding: &str, count: usize, color: &str, data: &[u8]| {
        let head = format!(
            "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             element face {count}\nproperty list uchar int vertex_indices\n{color}end_header\n"
        );
        let mut remarks = Vec::new();
        let soup = read(&[head.as_bytes(), data].concat(), "t.ply", &mut remarks).unwrap();
        let corners: Vec<u32> = soup.corners.iter().map(|corner| corner.position).collect();
        (corners, soup.materials.len(), soup.defects.unpromised, remarks.concat())
    };
    let said = |words: &str| format!("t.ply: its header promises {words}");
    let all = vec![0, 1, 2, 0, 2, 3];
    let points = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    let face = |corners: [u32; 3]| [&[3][..], &corners.map(u32::to_le_bytes).concat()].concat();
    let faces = [face([0, 1, 2]), face([0, 2, 3])].concat();
    let binary = |count: usize, more: &[u8]| {
        read("binary_little_endian", count, "", &[points.as_slice(), &faces, more].concat())
    };
    assert_eq!(binary(2, b""), (all.clone(), 0, 0, String::new()));
    assert_eq!(binary(1, b""), (all.clone(), 0, 1, said("1 face, the file has 2")));
    assert_eq!(binary(0, b"\n"), (all.clone(), 0, 2, said("0 faces, the file has 2")));
    for padding in [&b"\n"[..], &[0; 7], b"\r\n "] {
        assert_eq!(binary(2, padding), (all.clone(), 0, 0, String::new()));
    }
    assert_eq!(binary(2, b"\x03end"), (all.clone(), 0, 1, said("2 faces; what follows them is not read")));
    let text = |count: usize, more: &str| {
        let color = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        let text = format!("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 9 9 9\n3 0 2 3 7 7 7\n{more}");
        read("ascii", count, color, text.as_bytes())
    };
    assert_eq!(text(2, "\n \n"), (all.clone(), 2, 0, String::new()));
    assert_eq!(text(1, "\n\n"), (all.clone(), 2, 1, said("1 face, the file has 2")));
    assert_eq!(text(2, "the end\n"), (all, 2, 1, said("2 faces; what follows them is not read")));
}
