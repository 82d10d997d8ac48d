//! `tinta page`: a model in the browser's page. What the page does with it is tested in a browser, by `scripts/web --test`.

use crate::program::{done, refused, refused_in_one_line, tinta};
use crate::support::Folder;

/// A page like the built one: two files, one of a lecture, and the place for a lesson.
const BUILT: &str = "<script type=\"text/plain\" data-file=\"main.js\">QQ==</script>\n\
    <script type=\"text/plain\" data-file=\"how.md\" data-lecture=\"dachsbacher\">QQ==</script>\n<!-- lesson -->\n<script></script>\n";

/// The lesson in the page that these words make.
fn lesson(folder: &Folder, words: &[&str]) -> (serde_json::Value, String) {
    let (built, made) = (folder.file("built.html", BUILT.as_bytes()), folder.path("made.html"));
    done(&[&["page", "--from", &built, "-o", &made], words].concat());
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
fn shaders_of_one_s_own_are_in_the_link_and_the_lines_that_browsers_change_are_told() {
    let folder = Folder::new();
    let own = folder.path("own");
    std::fs::create_dir_all(format!("{own}/phong")).unwrap();
    let text = "#version 120\nuniform float edge = 0.3;\nvoid main() {\n    gl_FragColor = vec4(edge * 2);\n}\n";
    let file = format!("{own}/phong/phong.frag");
    std::fs::write(&file, text).unwrap();
    let words = ["builtin:gear", "--style", "phong", "--glsl", &own];
    let (lesson, _) = lesson(&folder, &words);
    let link = lesson["link"].as_str().unwrap();
    let published = tinta::glsl::source("phong/phong.frag").unwrap().len();
    let shader =
        format!("shader:phong%2Fphong.frag=0,{published},%23version%20120%0Auniform%20float%20edge%20%3D%200.3%3B%0A");
    assert!(link.split('&').any(|word| word.starts_with(&shader)), "{shader} in {link}");
    assert!(!link.contains("glsl"), "{link}");
    let page = |words: &[&str]| {
        let (built, made) = (folder.file("built.html", BUILT.as_bytes()), folder.path("made.html"));
        let output = tinta(&[&["page", "--from", &built, "-o", &made], words].concat());
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, said) = page(&words);
    assert_eq!(code, Some(0));
    // The version, the uniform with a value, and the whole number that is a float.
    assert!(
        said.contains("browsers need other words of phong/phong.frag in lines 1, 2, 4; the page marks them"),
        "{said}"
    );
    let endless = "for (float x = edge; x < 1.0; x += 0.1) { continue; }\n    gl_FragColor";
    std::fs::write(&file, text.replace("gl_FragColor", endless)).unwrap();
    let (code, said) = page(&words);
    assert_eq!(code, Some(2));
    let refused = "phong/phong.frag cannot run in browsers: a loop that does not begin at a number cannot be continued";
    assert!(said.contains(refused) && said.trim_end().lines().count() == 1, "{said}");
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
    page(&["builtin:gear", "--texture", "skin=a.png"], &["skin"]);
    refused_in_one_line(&["page", "builtin:gear", "-o", &made, "--from", &other], &["other.html", "scripts/web"]);
    refused_in_one_line(
        &["page", "builtin:gear", "-o", &made, "--from", &folder.path("no.html")],
        &["no.html", "no such file"],
    );
    if cfg!(unix) {
        refused_in_one_line(
            &["page", "builtin:gear", "-o", &made, "--from", "/dev/zero"],
            &["/dev/zero", "a device", "scripts/web"],
        );
    }
    assert!(!std::path::Path::new(&made).exists(), "nothing was written");
}
