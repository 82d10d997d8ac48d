//! `tinta page`: a model in the browser's page. What the page does with it is tested in a browser, by `scripts/web --test`.

use crate::cli::{Folder, refused, refused_in_one_line, tinta};

/// A page like the built one: two files, one of a lecture, and the place for a lesson.
const BUILT: &str = "<script type=\"text/plain\" data-file=\"main.js\">QQ==</script>\n\
    <script type=\"text/plain\" data-file=\"how.md\" data-lecture=\"dachsbacher\">QQ==</script>\n<!-- lesson -->\n<script></script>\n";

/// The lesson in the page that these words make.
fn lesson(folder: &Folder, words: &[&str]) -> (serde_json::Value, String) {
    let (built, made) = (folder.file("built.html", BUILT.as_bytes()), folder.path("made.html"));
    let output = tinta(&[&["page", "--from", &built, "-o", &made], words].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let page = std::fs::read_to_string(made).unwrap();
    let json = page.split_once("id=\"lesson\">").unwrap().1.split_once("</script>").unwrap().0;
    (serde_json::from_str(json).unwrap(), page)
}

#[test]
fn a_page_holds_the_model_with_its_files_and_the_options_of_the_left_side() {
    let folder = Folder::new();
    let words = ["models/ant.obj", "--tones", "2", "--normals", "smooth", "--copies", "3", "--right", "phong"];
    let (lesson, page) = lesson(&folder, &words);
    let files: Vec<&str> = lesson["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert_eq!(files[0], "ant.obj");
    assert!(files.contains(&"ant.mtl"), "its materials too: {files:?}");
    assert_eq!(page.matches("data-file=\"model/").count(), files.len());
    assert!(!page.contains("how.md"), "no lecture was asked for");
    let link = lesson["link"].as_str().unwrap();
    // The look print, as tinta render draws it, and the given options over it.
    for part in [
        "left=ink",
        "left:tones=2",
        "read:normals=smooth",
        "scene:copies=3",
        "scene:framing=outline",
        "right=phong",
        "orbit=30,23,",
    ] {
        assert!(link.split('&').any(|word| word.starts_with(part)), "{part} in {link}");
    }
}

#[test]
fn a_lecture_brings_its_style_and_a_built_in_model_no_files() {
    let folder = Folder::new();
    let (lesson, page) = lesson(&folder, &["builtin:gear", "--lecture", "dachsbacher"]);
    assert!(page.contains("how.md") && !page.contains("data-file=\"model/"), "{page}");
    assert!(lesson.get("files").is_none());
    let link = lesson["link"].as_str().unwrap();
    assert!(link.starts_with("model=gear&lecture=dachsbacher&divider=100&left=inking&"), "{link}");
    let (other, _) = self::lesson(&folder, &["builtin:gear", "--lecture", "dachsbacher", "--style", "charcoal"]);
    assert!(other["link"].as_str().unwrap().contains("&left=charcoal&"), "a given style is drawn");
}

#[test]
fn what_cannot_be_a_page_is_refused_in_a_sentence() {
    let folder = Folder::new();
    let (built, made) = (folder.file("built.html", BUILT.as_bytes()), folder.path("made.html"));
    let other = folder.file("other.html", b"<p>");
    let page = |words: &[&'static str], said: &[&str]| {
        refused(&[&["page", "--from", &built, "-o", &made], words].concat(), said);
    };
    page(&["-"], &["save it as a file"]);
    page(&["models/none.obj"], &["none.obj"]);
    page(&["builtin:gear", "--lecture", "nobody"], &["lecture", "evangelista"]);
    page(&["builtin:gear", "--style", "three-pass", "--tones", "9"], &["tones"]);
    page(&["builtin:gear", "--skin", "a.png"], &["skin"]);
    refused_in_one_line(&["page", "builtin:gear", "-o", &made, "--from", &other], &["other.html", "scripts/web"]);
    refused_in_one_line(
        &["page", "builtin:gear", "-o", &made, "--from", &folder.path("no.html")],
        &["no.html", "scripts/web"],
    );
    assert!(!std::path::Path::new(&made).exists(), "nothing was written");
}
