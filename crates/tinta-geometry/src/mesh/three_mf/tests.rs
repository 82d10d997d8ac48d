//! 3MF files made part by part, whole, cut off and damaged.

use super::*;
use crate::LoadOptions;
use crate::mesh::{LoadedModel, read_bytes};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;

/// How a part is written.
#[derive(Clone, Copy, Default)]
struct How {
    is_deflated: bool,
    is_encrypted: bool,
    is_long: bool,
    /// Bytes promised beyond those that there are.
    surplus: usize,
}

/// A zip file of these parts.
fn zip(parts: &[(&str, &[u8])], how: How) -> Vec<u8> {
    let short = |number: usize| (number as u16).to_le_bytes().to_vec();
    let long = |number: usize| (number as u32).to_le_bytes().to_vec();
    let (mut file, mut list) = (Vec::new(), Vec::new());
    for (name, bytes) in parts {
        let mut packed = bytes.to_vec();
        if how.is_deflated {
            let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(bytes).unwrap();
            packed = encoder.finish().unwrap();
        }
        let (at, size) = (file.len(), bytes.len() + how.surplus);
        let about =
            [short(usize::from(how.is_encrypted)), short(if how.is_deflated { 8 } else { 0 }), long(0), long(0)]
                .concat();
        let sizes = |is_long: bool| {
            if is_long { long(u32::MAX as usize).repeat(2) } else { [long(packed.len()), long(size)].concat() }
        };
        file.extend(
            [
                b"PK\x03\x04".as_slice(),
                &short(20),
                &about,
                &sizes(false),
                &short(name.len()),
                &short(0),
                name.as_bytes(),
                &packed,
            ]
            .concat(),
        );
        let numbers = [size, packed.len(), at].map(|number| (number as u64).to_le_bytes()).concat();
        let field =
            if how.is_long { [short(7), short(1), vec![9], short(1), short(24), numbers].concat() } else { Vec::new() };
        let place = long(if how.is_long { u32::MAX as usize } else { at });
        list.extend([b"PK\x01\x02".as_slice(), &long(20), &about, &sizes(how.is_long)].concat());
        list.extend([short(name.len()), short(field.len()), short(0), vec![0; 8], place].concat());
        list.extend([name.as_bytes(), &field].concat());
    }
    let at = file.len();
    file.extend(list);
    if how.is_long {
        file.extend([b"PK\x06\x06".to_vec(), vec![0; 44], long(at), long(0)].concat());
    }
    file.extend(
        [b"PK\x05\x06".to_vec(), vec![0; 12], long(if how.is_long { u32::MAX as usize } else { at }), short(0)]
            .concat(),
    );
    file
}

const TRIANGLE: &str = r#"<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>
    <triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>"#;

/// The XML of a model with these attributes, resources and items.
fn xml(attributes: &str, resources: &str, build: &str) -> String {
    let core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
    format!(
        "<?xml version=\"1.0\"?><model xmlns=\"{core}\" {attributes}><resources>{resources}</resources><build>{build}</build></model>"
    )
}

/// A valid file: a triangle in a component.
pub(crate) fn triangle() -> Vec<u8> {
    let resources = format!(
        r##"<basematerials id="9"><base name="red" displaycolor="#FF0000"/></basematerials><object id="1" pid="9" pindex="0">{TRIANGLE}</object>
        <object id="2" name="both"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 5 0 0"/></components></object>"##
    );
    file(&xml("", &resources, r#"<item objectid="2"/>"#))
}

fn file(model: &str) -> Vec<u8> {
    zip(&[("3D/3dmodel.model", model.as_bytes())], How::default())
}

fn loaded(bytes: &[u8]) -> Result<LoadedModel> {
    read_bytes(bytes, "t.3mf", &[], &LoadOptions::default())
}

fn problem(bytes: &[u8]) -> String {
    loaded(bytes).map(|loaded| loaded.mesh).unwrap_err().to_string()
}

#[test]
fn objects_stand_where_items_and_components_put_them_in_millimetres_with_z_up() {
    let resources = format!(
        r#"<object id="1" name="leaf">{TRIANGLE}</object><object id="2"><components><component objectid="1"
        transform="0 1 0 -1 0 0 0 0 1 2 0 0"/><component objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 3"/></components></object>"#
    );
    let build = r#"<item objectid="1"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 10 0"/>"#;
    let mesh = loaded(&file(&xml("unit=\"centimeter\"", &resources, build))).unwrap().mesh;
    let parts: Vec<(&str, u32)> = mesh.parts.iter().map(|part| (part.name.as_str(), part.within)).collect();
    assert_eq!(parts, [("leaf", NONE), ("object 2", NONE), ("leaf", 1), ("leaf", 1)]);
    // The corner at x = 1 cm: as it is; turned a quarter around z, moved by 2 and 10; mirrored, raised by 3, moved by 10.
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, z, -y) * 10.0;
    for (part, expected) in [(0, at(1.0, 0.0, 0.0)), (2, at(2.0, 11.0, 0.0)), (3, at(-1.0, 10.0, 3.0))] {
        let place = mesh.triangle_parts.iter().position(|own| *own == part).unwrap();
        let corners = mesh.triangles[place].map(|corner| mesh.positions[corner as usize]);
        assert!(corners.iter().any(|corner| corner.distance(expected) < 1e-9), "{part}: {corners:?}");
        let [a, b, c] = corners;
        assert!((b - a).cross(c - a).y > 0.0, "{part} faces up, the mirrored one too");
    }
}

#[test]
fn triangles_have_their_own_paint_or_their_objects_and_the_mean_where_corners_differ() {
    let triangles = r#"<triangle v1="0" v2="1" v3="2"/><triangle v1="0" v2="2" v3="3" pid="5" p1="1"/><triangle v1="0" v2="1" v3="3"
        pid="5" p1="0" p2="1" p3="1"/><triangle v1="1" v2="2" v3="3" pid="6" p1="0"/><triangle v1="1" v2="2" v3="9"/>"#;
    let resources = format!(
        r##"<basematerials id="4"><base name="steel" displaycolor="#336699FF"/></basematerials>
        <m:colorgroup xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02" id="5"><m:color color="#FF0000"/>
        <m:color color="#0000ff80"/></m:colorgroup><m:texture2dgroup id="6"/><object id="1" pid="4" pindex="0"><mesh><vertices>
        <vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices>
        <triangles>{triangles}</triangles></mesh></object>"##
    );
    let LoadedModel { mesh, remarks, .. } = loaded(&file(&xml("", &resources, r#"<item objectid="1"/>"#))).unwrap();
    let name = |triangle: usize| {
        mesh.materials.get(mesh.triangle_materials[triangle] as usize).map(|material| &*material.name)
    };
    let mut names: Vec<_> = (0..4).map(name).collect();
    names.sort_unstable();
    assert_eq!(names, [None, Some("#0000ff80"), Some("#5500aa"), Some("steel")]);
    assert_eq!(mesh.materials[0].color, Some([0.2, 0.4, 0.6]));
    assert_eq!(mesh.defects.out_of_range_faces, 1);
    assert!(remarks.iter().any(|remark| remark == "t.3mf: not drawn: texture2dgroup"), "{remarks:?}");
}

#[test]
fn parts_of_the_file_are_read_however_they_are_packed() {
    let resources =
        r#"<object id="1"><components><component objectid="7" p:path="/3D/Objects/a.model"/></components></object>"#;
    let production =
        "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\"";
    let model = xml(production, resources, r#"<item objectid="1"/>"#);
    let other = xml("unit=\"inch\"", &format!("<object id=\"7\" name=\"a\">{TRIANGLE}</object>"), "");
    let parts = [("3D/3dmodel.model", model.as_bytes()), ("3D/Objects/A.model", other.as_bytes())];
    for (is_deflated, is_long) in [(false, false), (true, false), (true, true)] {
        let LoadedModel { mesh, remarks, .. } =
            loaded(&zip(&parts, How { is_deflated, is_long, ..How::default() })).unwrap();
        assert_eq!((mesh.triangles.len(), mesh.bounds().1.x, remarks), (1, 25.4, vec![]));
    }
    let message = problem(&zip(&parts[..1], How::default()));
    assert_eq!(message, "t.3mf: its part 3D/Objects/a.model is missing; export it again");
}

#[test]
fn bad_files_are_refused_in_one_sentence() {
    let object =
        |components: &str| xml("", &format!("<object id=\"1\">{components}</object>"), "<item objectid=\"1\"/>");
    let itself = "<components><component objectid=\"1\"/></components>";
    let levels: String = (1..40)
        .map(|id| {
            let below = format!("<component objectid=\"{}\"/>", id + 1);
            format!("<object id=\"{id}\"><components>{below}{below}</components></object>")
        })
        .collect();
    let doubled = xml("", &format!("{levels}<object id=\"40\"/>"), "<item objectid=\"1\"/>");
    let wide = itself.replace("<component objectid=\"1\"/>", &"<component objectid=\"1\"/>".repeat(50_000));
    let much = "t.3mf: its components form a circle, or it has too many objects or materials; export it with fewer";
    let cases = [
        (object(itself), much),
        (object(&wide), much),
        (doubled, much),
        (
            object("<components><component objectid=\"3\"/></components>"),
            "t.3mf: its object 3 is missing; export it again",
        ),
        (
            object("<components><component objectid=\"1\" transform=\"1 0 0\"/></components>"),
            "t.3mf: a transform in its part 3D/3dmodel.model is not twelve numbers; export it again",
        ),
        (object("</mesh>"), "t.3mf: its part 3D/3dmodel.model is no sound XML ("),
        (xml("", "", ""), "t.3mf: it"),
    ];
    for (model, sentence) in cases {
        let message = problem(&file(&model));
        assert!(message.starts_with(sentence), "{message}");
    }
    let parts = [("3D/3dmodel.model", b"<model/>".as_slice())];
    let with = |how: How| problem(&zip(&parts, how));
    assert!(with(How { is_encrypted: true, ..How::default() }).contains("3dmodel.model is encrypted"));
    assert!(with(How { surplus: 9, ..How::default() }).contains("is damaged or cut off"));
    assert!(with(How { surplus: 1 << 30, is_deflated: true, ..How::default() }).contains("unpacks to far more"));
    assert!(
        problem(&zip(&[("a.txt", b"".as_slice())], How::default())).contains("its part 3D/3dmodel.model is missing")
    );
}

#[test]
fn every_truncation_is_refused() {
    let whole = triangle();
    assert_eq!(loaded(&whole).unwrap().mesh.parts.len(), 2);
    // The last two bytes are the length of a comment.
    for length in 1..whole.len() - 2 {
        assert!(problem(&whole[..length]).starts_with("t.3mf: "), "{length}");
    }
}
