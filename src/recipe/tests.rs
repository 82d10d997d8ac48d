//! Recipes written and read back; files that are damaged or mean harm.

use super::*;
use crate::markup::recipe_element;
use crate::picture::{Picture, PictureFormat, Target};
use crate::scene::Size;

fn recipe() -> Recipe {
    let text = |text: &str| text.to_owned();
    Recipe {
        version: text("0.1.0"),
        command: text("render"),
        style: text("inking"),
        size: [3, 2],
        models: vec![text("my <cow> & \"é→🖋\u{7f}\u{1}.obj"), text("-b.ply")],
        options: [
            (text("style"), OptionValue::text("inking")),
            (text("eye"), OptionValue::text("-1,2,3")),
            (text("parallel"), OptionValue::Switch(true)),
        ]
        .into(),
        files: vec![FileRecord { path: text("a"), bytes: 3, sha256: text("ab") }],
        gl: Some(Driver {
            backend: text("egl"),
            device: text("EGL"),
            vendor: text("Mesa"),
            renderer: text("llvmpipe"),
            version: text("4.5"),
        }),
    }
}

fn picture() -> Picture {
    Picture { size: Size { width: 3, height: 2 }, pixels: (0..24).collect() }
}

fn png() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    Target::File { path: path.clone(), format: PictureFormat::Png }
        .write_with(&picture(), recipe().note().as_ref())
        .unwrap();
    assert_eq!(Picture::read_png(&path).unwrap(), picture());
    assert_eq!(Recipe::read(&path).unwrap(), recipe());
    std::fs::read(&path).unwrap()
}

fn svg() -> String {
    format!("<svg><metadata>\n{}</metadata></svg>", recipe_element(&recipe().json().unwrap()))
}

#[test]
fn a_recipe_is_ascii_and_comes_back_from_png_and_svg() {
    let json = recipe().json().unwrap();
    assert!(json.bytes().all(|byte| (b' '..=b'~').contains(&byte)), "{json}");
    assert!(json.contains("\\u00e9\\u2192\\ud83d\\udd8b\\u007f\\u0001"), "{json}");
    assert_eq!(Recipe::in_bytes(&png()).unwrap(), recipe());
    assert_eq!(Recipe::in_bytes(svg().as_bytes()).unwrap(), recipe());
    assert!(roxmltree::Document::parse(&svg()).is_ok());
    let long = Recipe { models: vec!["m".repeat(LARGEST_BYTES)], ..recipe() };
    assert_eq!(long.json(), None);
}

#[test]
fn its_command_line_is_one_for_a_shell() {
    let plain = Recipe { models: vec!["my cow.obj".to_owned()], ..recipe() };
    let expected = "tinta render 'my cow.obj' -o a.png --eye=-1,2,3 --parallel --style inking";
    assert_eq!(plain.command_line("a.png"), expected);
    assert!(recipe().command_line("a.png").ends_with("--style inking -- -b.ply"));
}

#[test]
fn a_files_digest_is_sha_256() {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), b"abc").unwrap();
    let record = FileRecord::of(file.path()).unwrap();
    assert_eq!(record.bytes, 3);
    assert_eq!(record.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

#[test]
fn every_difference_is_said() {
    let then = recipe();
    assert!(then.differences(&then).is_empty());
    let mut now = recipe();
    now.version = "0.2.0".to_owned();
    now.files[0].sha256 = "cd".to_owned();
    now.size = [4, 2];
    if let Some(gl) = &mut now.gl {
        gl.backend = "osmesa".to_owned();
        gl.renderer = "softpipe".to_owned();
    }
    let said = then.differences(&now);
    assert_eq!(said.len(), 5, "{said:?}");
    assert_eq!(said[0], "tinta's version was 0.1.0 and is 0.2.0 now");
    assert!(said[1].starts_with("a was 3 bytes with SHA-256 ab") && said[4] == "the size was 3x2 and is 4x2 now");
    now.gl = None;
    assert!(then.differences(&now).iter().any(|line| line == "the driver was llvmpipe and is none now"));
}

#[test]
fn pictures_without_a_recipe_are_told_from_files_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let message = |path: &Path| Recipe::read(path).unwrap_err().to_string();
    Target::File { path: path.clone(), format: PictureFormat::Png }.write(&picture()).unwrap();
    assert!(message(&path).contains("carries no recipe"));
    for (bytes, words) in [
        (&b"<svg></svg>"[..], "carries no recipe"),
        (b"\xff\xd8\xff", "neither PNG nor SVG"),
        (b"", "neither PNG nor SVG"),
        (b"\x89PNG\r\n\x1a\n", "damaged"),
    ] {
        std::fs::write(&path, bytes).unwrap();
        assert!(message(&path).contains(words), "{}", message(&path));
    }
    let element = recipe_element("{}");
    std::fs::write(&path, format!("<svg>{element}")).unwrap();
    assert!(message(&path).contains("cannot be understood"));
    std::fs::write(&path, format!("<svg>{}", recipe_element(&" ".repeat(LARGEST_BYTES + 1)))).unwrap();
    assert!(message(&path).contains("longer than"), "{}", message(&path));
    assert!(message(folder.path()).contains("not a regular file"));
    assert!(message(&folder.path().join("none")).contains("no such file"));
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_pictures_give_a_recipe_or_a_sentence(
        is_svg in proptest::bool::ANY,
        changes in proptest::collection::vec((0usize..2000, proptest::num::u8::ANY), 0..8),
        keep in 0usize..2000,
    ) {
        let mut bytes = if is_svg { svg().into_bytes() } else { PNG.clone() };
        for (place, byte) in changes {
            let length = bytes.len();
            bytes[place % length] = byte;
        }
        bytes.truncate(keep);
        if let Err(problem) = Recipe::in_bytes(&bytes) {
            assert!(!problem.is_empty());
        }
    }
}

static PNG: std::sync::LazyLock<Vec<u8>> = std::sync::LazyLock::new(png);
