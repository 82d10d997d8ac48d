//! Pictures that carry their recipe, and `tinta again` as a user meets it.

use crate::program::{done, refused_in_one_line, tinta};
use crate::support::{Folder, backend_names, textured};
use std::path::Path;
use std::process::Output;
use tinta::preset::OptionValue;
use tinta::{Picture, Recipe, Target};

fn again(picture: &str, out: &str, more: &[&str]) -> (Option<i32>, String) {
    let Output { status, stderr, stdout } = tinta(&[&["again", picture, "-o", out], more].concat());
    assert!(stdout.is_empty());
    let said = String::from_utf8(stderr).unwrap();
    assert!(said.lines().all(|line| line.starts_with("tinta: ")), "{said}");
    (status.code(), said)
}

fn read(path: &str) -> Recipe {
    Recipe::read(Path::new(path)).unwrap()
}

/// Writes the picture at `path` with another recipe.
fn with_recipe(path: &str, change: impl FnOnce(&mut Recipe)) {
    let mut recipe = read(path);
    change(&mut recipe);
    let picture = Picture::read_png(Path::new(path)).unwrap();
    Target::check(path, false).unwrap().write_with(&picture, recipe.note().as_ref()).unwrap();
}

#[test]
fn pictures_of_every_kind_are_made_again_byte_for_byte() {
    let folder = Folder::new();
    let model = textured(&folder);
    let preset = folder.file("mine.toml", b"style = \"two-pass\"\ntones = 2\n");
    let [first, second] = backend_names();
    let mut made_again = 0;
    for (kind, options) in [
        ("png", &["--style", "sand", "--light=light-1=-1,0.5,2"][..]),
        ("png", &["--style", "inking", "--texture", "on", "--background", "transparent", "--backend", second]),
        ("png", &["--style", "ink", "--background", "rgb(10.5 20 30)", "--full", "--surface", "textured"]),
        (
            "png",
            &[
                "--preset",
                &preset,
                "--surface",
                "textured",
                "--view=-20,30",
                "--copies",
                "3",
                "--show",
                "borders",
                "--backend",
                first,
            ],
        ),
        ("svg", &["--style", "lines", "--hidden", "dashed", "--class-colors", "silhouette=red"]),
        ("svg", &["--style", "lines", "--pen", "--page", "dpi=96.5", "--background", "transparent"]),
    ] {
        let [first, second] = ["first", "second"].map(|name| folder.path(&format!("{name}.{kind}")));
        done(&[&["render", &model, "-o", &first, "--size", "64x48"], options].concat());
        let (code, said) = again(&first, &second, &[]);
        assert_eq!((code, said.lines().count()), (Some(0), 1), "{options:?}: {said}");
        assert!(said.contains("second") && said.contains("is the same, byte for byte"), "{said}");
        assert!(std::fs::read(&first).unwrap() == std::fs::read(&second).unwrap(), "{options:?}");
        made_again += 1;
    }
    assert_eq!(made_again, 6);
}

#[test]
fn what_a_look_switches_on_can_be_switched_off_and_its_recipe_draws_the_same_again() {
    let folder = Folder::new();
    for look in ["print", "technical", "sketch"] {
        let [whole, first, second] =
            ["whole", "first", "second"].map(|name| folder.path(&format!("{look}-{name}.png")));
        let render = |out: &str, more: &[&str]| {
            done(&[&["render", "builtin:bust", "-o", out, "--look", look, "--size", "160x120"], more].concat());
        };
        render(&whole, &[]);
        // The lines are all that technical draws.
        let first_off = if look == "technical" { 2 } else { 0 };
        for off in &["--no-exact-lines", "--no-borders", "--no-lasting-creases", "--no-taper"][first_off..] {
            render(&first, &[off]);
            let (code, said) = again(&first, &second, &[]);
            assert_eq!(code, Some(0), "{look} {off}: {said}");
            assert!(std::fs::read(&first).unwrap() == std::fs::read(&second).unwrap(), "{look} {off}");
            assert!(read(&first) != read(&whole), "{look} {off}");
        }
    }
}

#[test]
fn a_recipe_says_what_was_drawn_with_which_files_by_whom() {
    let folder = Folder::new();
    let model = textured(&folder);
    let [png, svg, other] = ["a.png", "a.svg", "b.png"].map(|name| folder.path(name));
    let render = |out: &str, options: &[&str]| {
        done(&[&["render", &model, "builtin:ant", "-o", out, "--size", "40x30"], options].concat());
    };
    render(&png, &["--style", "inking", "--texture", "on", "--explain"]);
    let recipe = read(&png);
    assert_eq!((recipe.version.as_str(), recipe.command.as_str()), (env!("CARGO_PKG_VERSION"), "render"));
    assert_eq!((recipe.style.as_str(), recipe.size), ("inking", [40, 30]));
    assert_eq!(recipe.models, [model.as_str(), "builtin:ant"]);
    let options: Vec<&str> = recipe.options.keys().map(String::as_str).collect();
    assert_eq!(options, ["size", "style", "texture"], "nothing of the run, nothing of where it went");
    let names: Vec<&str> = recipe.files.iter().map(|file| file.path.rsplit('/').next().unwrap()).collect();
    assert_eq!(names, ["square.obj", "square.mtl", "skin.png"]);
    assert!(recipe.files.iter().all(|file| file.sha256.len() == 64 && file.bytes > 20));
    let driver = recipe.gl.unwrap();
    assert!(driver.backend == backend_names()[0] && !driver.renderer.is_empty());
    // A style that does not look at textures does not depend on them.
    render(&other, &["--look", "published"]);
    assert_eq!(read(&other).files.len(), 2);
    assert_eq!(read(&other).style, "three-pass");
    render(&svg, &["--style", "lines"]);
    assert_eq!((read(&svg).gl, read(&svg).style.as_str()), (None, "lines"));
    // The same drawing is the same bytes wherever it is written.
    render(&other, &["--style", "inking", "--texture", "on"]);
    assert!(std::fs::read(&other).unwrap() == std::fs::read(&png).unwrap());
}

#[test]
fn without_a_recipe_no_name_is_told_and_nothing_can_be_made_again() {
    let folder = Folder::new();
    let model = textured(&folder);
    for (name, kind) in [("a.png", "png"), ("a.svg", "svg"), ("a.jpg", "png"), ("a.apng", "png")] {
        let path = folder.path(name);
        // These formats never carry a recipe.
        let keep: &[&str] = if ["a.jpg", "a.apng"].contains(&name) { &[] } else { &["--no-recipe"] };
        let turn: &[&str] = if name == "a.apng" { &["--turntable", "2"] } else { &[] };
        done(&[&["render", &model, "-o", &path, "--size", "30"], keep, turn].concat());
        let bytes = std::fs::read(&path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(!text.contains("tinta-recipe") && !text.contains("tinta:recipe") && !text.contains("tinta render"));
        let out = folder.path(&format!("out.{kind}"));
        let words = if name == "a.jpg" { "neither PNG nor SVG" } else { "carries no recipe" };
        refused_in_one_line(&["again", &path, "-o", &out], &[name, words]);
        assert!(!Path::new(&out).exists());
    }
}

#[test]
fn what_differs_is_said_and_counted() {
    let folder = Folder::new();
    let model = folder.file("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let [first, second] = ["first.png", "second.png"].map(|name| folder.path(name));
    let [lines, lines_again] = ["first.svg", "second.svg"].map(|name| folder.path(name));
    done(&["render", &model, "-o", &first, "--size", "32"]);
    done(&["render", &model, "-o", &lines, "--size", "32"]);
    // Another version and driver that draw the same.
    let original = std::fs::read(&first).unwrap();
    with_recipe(&first, |recipe| {
        recipe.version = "0.0.9".to_owned();
        recipe.gl.as_mut().unwrap().renderer = "a card of 2005".to_owned();
    });
    let (code, said) = again(&first, &second, &[]);
    assert_eq!(code, Some(0), "{said}");
    for words in ["tinta's version was 0.0.9 and is", "the driver was a card of 2005 and is", "has the same pixels"] {
        assert!(said.contains(words), "{said}");
    }
    assert_eq!(said.lines().count(), 3, "{said}");
    // Another model under the same name.
    std::fs::write(&first, &original).unwrap();
    folder.file("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
    let (code, said) = again(&first, &second, &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("m.obj was 32 bytes with SHA-256") && said.contains("now"), "{said}");
    let counted: usize = said.split("differs in ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    let pictures = [&first, &second].map(|path| Picture::read_png(Path::new(path)).unwrap());
    assert_eq!(pictures[0].difference(&pictures[1]).unwrap().pixels, counted);
    assert!(counted > 20 && said.contains(&format!("{counted} of 1024 pixels")), "{said}");
    let (code, said) = again(&lines, &lines_again, &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("m.obj was") && said.contains("lines of the file"), "{said}");
}

#[test]
fn a_model_that_has_moved_is_asked_for_and_found() {
    let folder = Folder::new();
    let old = folder.file("old.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let new = folder.path("new.obj");
    for kind in ["png", "svg"] {
        std::fs::copy(&old, &new).unwrap();
        let [first, second] = ["first", "second"].map(|name| folder.path(&format!("{name}.{kind}")));
        done(&["render", &old, "-o", &first, "--size", "32", "--background", "transparent"]);
        std::fs::rename(&old, folder.path("hidden.obj")).unwrap();
        refused_in_one_line(&["again", &first, "-o", &second], &["old.obj: ", "--model FILE"]);
        assert!(!Path::new(&second).exists());
        let (code, said) = again(&first, &second, &["--model", &new]);
        assert_eq!((code, said.lines().count()), (Some(0), 1), "{said}");
        assert!(said.contains("has the same"), "{said}");
        refused_in_one_line(
            &["again", &first, "-o", &second, "--model", &new, "--model", &new],
            &["--model", "1 models"],
        );
        std::fs::rename(folder.path("hidden.obj"), &old).unwrap();
    }
}

#[test]
fn outputs_that_cannot_be_compared_are_refused() {
    let folder = Folder::new();
    let [png, svg] = ["a.png", "a.svg"].map(|name| folder.path(name));
    done(&["render", "builtin:ant", "-o", &png, "--size", "16"]);
    done(&["render", "builtin:ant", "-o", &svg, "--size", "16"]);
    let before = std::fs::read(&png).unwrap();
    refused_in_one_line(&["again", &png, "-o", &png], &["this is the picture to compare with"]);
    for out in ["b.jpg", "b.svg", "b", "-"] {
        refused_in_one_line(&["again", &png, "-o", out], &["name a .png file"]);
    }
    refused_in_one_line(&["again", &svg, "-o", &png], &["name a .svg file"]);
    refused_in_one_line(&["again", &png, "-o", &folder.path("no/b.png")], &["folder", "does not exist"]);
    refused_in_one_line(&["again", "none.png", "-o", &svg], &["none.png: there is no such file"]);
    assert!(std::fs::read(&png).unwrap() == before);
}

#[test]
fn a_recipe_that_means_harm_writes_nothing() {
    let folder = Folder::new();
    let [png, out, target] = ["a.png", "b.png", "target"].map(|name| folder.path(name));
    let text = OptionValue::Text;
    done(&["render", "builtin:ant", "-o", &png, "--size", "16"]);
    let original = std::fs::read(&png).unwrap();
    for (name, value) in [
        ("dump", text(target.clone())),
        ("output", text(target.clone())),
        ("save-preset", text(target.clone())),
        ("preset", text("/dev/zero".to_owned())),
        ("tones --output=c.png", text("2".to_owned())),
        ("tones=2 --dump", text(target.clone())),
        ("json", OptionValue::Switch(true)),
        ("allow-external", OptionValue::Switch(true)),
        ("glsl", text("glsl".to_owned())),
        ("oil", text("2".to_owned())),
        ("", text("2".to_owned())),
        ("tones", text(format!("2 --dump={target}"))),
        ("help", OptionValue::Switch(true)),
    ] {
        with_recipe(&png, |recipe| {
            recipe.options.insert(name.to_owned(), value);
        });
        refused_in_one_line(&["again", &png, "-o", &out], &["a.png: its recipe"]);
        std::fs::write(&png, &original).unwrap();
    }
    with_recipe(&png, |recipe| recipe.models = vec![format!("--dump={target}")]);
    refused_in_one_line(&["again", &png, "-o", &out], &["--model FILE"]);
    with_recipe(&png, |recipe| recipe.models = Vec::new());
    refused_in_one_line(&["again", &png, "-o", &out], &["its recipe"]);
    with_recipe(&png, |recipe| recipe.command = "figures".to_owned());
    refused_in_one_line(&["again", &png, "-o", &out], &["its recipe is for tinta figures"]);
    for path in [&out, &target, &folder.path("target-difference.png")] {
        assert!(!Path::new(path).exists(), "{path}");
    }
}

#[test]
fn a_recipe_for_a_much_larger_picture_than_the_one_that_has_it_is_refused_before_it_is_drawn() {
    let folder = Folder::new();
    let [picture, out] = ["small.png", "out.png"].map(|name| folder.path(name));
    done(&["render", "builtin:ant", "-o", &picture, "--size", "64x48"]);
    with_recipe(&picture, |recipe| {
        recipe.options.insert("size".to_owned(), OptionValue::Text("16384x16384".to_owned()));
    });
    refused_in_one_line(
        &["again", &picture, "-o", &out],
        &["small.png: it has 64x48 pixels but its recipe is for 16384x16384; give the picture"],
    );
    assert!(!Path::new(&out).exists());
}

#[test]
fn without_an_output_the_two_are_compared_and_no_file_is_left() {
    let folder = Folder::new();
    for name in ["a.png", "a.svg"] {
        let path = folder.path(name);
        done(&["render", "builtin:gear", "-o", &path, "--size", "40"]);
        let output = done(&["again", &path]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(said, format!("tinta: {path}, drawn again, is the same, byte for byte\n"));
        // Another picture with the same recipe.
        let bytes = std::fs::read(&path).unwrap();
        let other = match name {
            "a.svg" => String::from_utf8(bytes).unwrap().replacen("<path d=\"M", "<path d=\"M1,1 ", 1).into_bytes(),
            _ => continue,
        };
        std::fs::write(&path, other).unwrap();
        let output = tinta(&["again", &path]);
        assert_eq!(output.status.code(), Some(1), "{output:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path(".")).unwrap().count(), 2);
}
