//! `--part`, `--join-parts` and `--sheet` as a user meets them.

use crate::program::{done, refused_in_one_line, tinta};
use crate::support::{Folder, public_model};
use serde_json::Value;

/// Two boxes one behind the other, objects `near` and `far box`, with a material each.
fn boxes(folder: &Folder) -> String {
    let mut text = "mtllib boxes.mtl\n".to_owned();
    for (number, (name, material, z)) in
        [("near", "steel", 1.0), ("far box", "brass plate", -1.0)].into_iter().enumerate()
    {
        text.push_str(&format!("o {name}\nusemtl {material}\n"));
        (0..8).for_each(|k| text.push_str(&format!("v {} {} {}\n", k & 1, k >> 1 & 1, f64::from(k >> 2) * 0.5 + z)));
        let sides = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
        for side in sides {
            let [a, b, c, d] = side.map(|corner| corner + 8 * number);
            text.push_str(&format!("f {a} {b} {c} {d}\n"));
        }
    }
    folder.file("boxes.mtl", b"newmtl steel\nKd 0.5 0.5 0.6\nnewmtl brass plate\nKd 0.8 0.7 0.2\n");
    folder.file("boxes.obj", text.as_bytes())
}

fn drawn(folder: &Folder, model: &str, name: &str, options: &[&str]) -> String {
    let out = folder.path(name);
    let all = [&["render", model, "-o", &out, "--style", "lines", "--view", "20,15", "--no-recipe"], options].concat();
    done(&all);
    std::fs::read_to_string(out).unwrap()
}

/// The labels of a drawing's layers with their colours.
fn layers(svg: &str) -> Vec<(String, String)> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let groups = document.descendants().filter(|node| node.tag_name().name() == "g");
    let label = "http://www.inkscape.org/namespaces/inkscape";
    groups
        .map(|group| {
            let text = |value: Option<&str>| value.unwrap_or_default().to_owned();
            (text(group.attribute((label, "label"))), text(group.attribute("stroke")))
        })
        .collect()
}

#[test]
fn rules_given_twice_together_or_in_a_preset_are_the_same() {
    let folder = Folder::new();
    let model = boxes(&folder);
    let (red, ghost) = ("far*: color=red, classes=silhouette+crease", "near: ghost");
    let twice = drawn(&folder, &model, "a.svg", &["--part", red, "--part", ghost]);
    let together = drawn(&folder, &model, "b.svg", &["--part", &format!("{red}; {ghost}")]);
    let preset =
        "[part.\"far*\"]\ncolor = \"red\"\nclasses = [\"silhouette\", \"crease\"]\n[part.near]\nghost = true\n";
    let preset = folder.file("parts.toml", preset.as_bytes());
    let of_preset = drawn(&folder, &model, "c.svg", &["--preset", &preset]);
    assert!(twice == together && twice == of_preset);
    let layers = layers(&twice);
    assert!(layers.contains(&("visible crease far*".to_owned(), "#ff0000".to_owned())), "{layers:?}");
    assert!(layers.contains(&("visible crease near".to_owned(), "#000000".to_owned())), "{layers:?}");
    let saved = folder.path("saved.toml");
    drawn(&folder, &model, "d.svg", &["--part", red, "--part", ghost, "--save-preset", &saved]);
    assert_eq!(drawn(&folder, &model, "e.svg", &["--preset", &saved]), twice);
}

#[test]
fn a_filled_part_is_drawn_as_one_whose_material_has_that_colour() {
    let (filled, red) = (Folder::new(), Folder::new());
    let models = [boxes(&filled), boxes(&red)];
    red.file("boxes.mtl", b"newmtl steel\nKd 0.5 0.5 0.6\nnewmtl brass plate\nKd 1 0 0\n");
    let drawn = |folder: &Folder, model: &str, name: &str, options: &[&str]| {
        let out = folder.path(name);
        done(&[&["render", model, "-o", &out, "--size", "160x120", "--no-recipe"], options].concat());
        // A filled part has a material more.
        String::from_utf8_lossy(&std::fs::read(out).unwrap()).replace("fill-0-2", "fill-0-1")
    };
    let fills = ["far box: fill=red", "material:brass*: fill=blue; far*: fill=#ff0000"];
    for (name, options) in
        [("a.png", &[][..]), ("a.svg", &[]), ("b.png", &["--look", "published"]), ("b.svg", &["--hatch", "auto"])]
    {
        let expected = drawn(&red, &models[1], name, options);
        assert!(drawn(&filled, &models[0], name, options) != expected);
        for fill in &fills[..if name.starts_with('a') { 2 } else { 1 }] {
            let with_fill = [options, &["--part", fill]].concat();
            assert!(drawn(&filled, &models[0], name, &with_fill) == expected, "{name} {fill}");
        }
    }
    // One colour for all surfaces leaves those that were chosen.
    let one = drawn(&red, &models[1], "c.svg", &["--color", "white"]);
    let chosen = drawn(&filled, &models[0], "c.svg", &["--color", "white", "--part", "far*: fill=#ff0000"]);
    assert!(one != chosen && chosen.contains("#ff0000"));
}

#[test]
fn parts_and_materials_are_named_and_unknown_ones_refused() {
    let folder = Folder::new();
    let model = boxes(&folder);
    let plain = drawn(&folder, &model, "a.svg", &[]);
    let gone = drawn(&folder, &model, "b.svg", &["--part", "material:brass*: occlude-only"]);
    assert!(gone.len() < plain.len());
    let lines: Value = serde_json::from_str(&drawn(&folder, &model, "a.json", &[])).unwrap();
    let of = |key: &str| lines["segments"].as_array().unwrap().iter().filter(|it| it["part"] == key).count();
    assert!(of("near") > 0 && of("far box") > 0);
    assert_eq!(lines["segments"][0]["material"], "steel");
    let refused = |rule: &str, words: &[&str]| {
        refused_in_one_line(&["render", &model, "-o", &folder.path("c.svg"), "--part", rule], words);
    };
    refused("nearr: ghost", &["--part nearr", "did you mean near?"]);
    refused("wheel*: ghost", &["there are boxes.obj, far box, near"]);
    refused("material:gold: ghost", &["no material", "there are brass plate, steel"]);
    refused("near: line-width=2mm", &["line-width"]);
    refused("near", &["PATTERN: SETTINGS"]);
}

#[test]
fn a_sheet_has_four_views_in_vectors_and_pixels_but_not_in_json() {
    let folder = Folder::new();
    let model = boxes(&folder);
    let svg = |angle: &str| {
        let out = folder.path("a.svg");
        let output =
            tinta(&["render", &model, "-o", &out, "--sheet", angle, "--hidden", "dashed", "--look", "technical"]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read_to_string(&out).unwrap()
    };
    let (third, first) = (svg("third"), svg("first"));
    assert_ne!(third, first);
    // The scale bar is a curve, and its number is no text.
    assert!(!third.contains("<text"));
    for part in ["hidden", "curve"] {
        assert!(layers(&third).iter().any(|(label, _)| label.contains(part)), "{part}");
    }
    for name in ["a.pdf", "a.png"] {
        done(&["render", &model, "-o", &folder.path(name), "--style", "lines", "--sheet", "third"]);
    }
    let json = folder.path("a.json");
    refused_in_one_line(&["render", &model, "-o", &json, "--sheet", "third"], &["sheet", "one view"]);
    let out = folder.path("b.svg");
    refused_in_one_line(&["render", &model, "-o", &out, "--sheet", "third", "--view", "top"], &["sheet", "view"]);
    refused_in_one_line(&["render", &model, "-o", &out, "--sheet", "third", "--size", "64x8"], &["larger --size"]);
}

#[test]
fn an_assembly_has_parts_by_its_nodes() {
    let Some(model) = public_model("parts/assembly.glb") else { return };
    let folder = Folder::new();
    let lines: Value = serde_json::from_str(&drawn(&folder, &model, "a.json", &[])).unwrap();
    let mut names: Vec<&str> =
        lines["segments"].as_array().unwrap().iter().filter_map(|it| it["part"].as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names, ["bolt0", "bolt1", "bolt2", "bolt3", "bracket"]);
    let svg = drawn(&folder, &model, "a.svg", &["--part", "*: ghost", "--part", "bolt*: solid, color=red"]);
    assert!(layers(&svg).iter().any(|(label, color)| label == "visible crease * + bolt*" && color == "#ff0000"));
}

#[test]
fn two_planes_cut_a_quarter_away_and_the_recipe_holds_both() {
    let folder = Folder::new();
    let [svg, again] = ["half.svg", "again.svg"].map(|name| folder.path(name));
    let given = ["render", "builtin:plates", "--section", "x=0", "--section", "z=0", "--look", "technical", "-o", &svg];
    done(&given);
    let text = std::fs::read_to_string(&svg).unwrap();
    assert!(text.contains("file:x=0; file:z=0"), "its recipe");
    done(&["again", &svg, "-o", &again]);
    assert_eq!(std::fs::read_to_string(&again).unwrap(), text);
}

#[test]
fn of_several_models_one_beyond_a_sections_plane_is_left_out() {
    let folder = Folder::new();
    let (boxes, out) = (boxes(&folder), folder.path("cut.svg"));
    let beyond = folder.file("beyond.obj", b"v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n");
    let output = tinta(&["render", &boxes, &beyond, "--section", "z=1.25", "-o", &out, "--json", "--copies", "2"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("beyond.obj: it lies wholly in front") && said.lines().count() == 1, "{said}");
    let record: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(record.to_string().contains("boxes.obj") && std::fs::metadata(&out).is_ok(), "{record}");
    let alone = tinta(&["render", &beyond, "--section", "z=1.25", "-o", &out]);
    let said = String::from_utf8_lossy(&alone.stderr);
    assert_eq!(alone.status.code(), Some(2), "{said}");
    assert!(said.contains("nothing is left of") && said.contains("move the plane"), "{said}");
}

#[test]
fn later_rules_undo_uncut_and_narrow_sheets_hold_their_titles() {
    let folder = Folder::new();
    let cut = |rules: &[&str]| {
        let parts: Vec<&str> = rules.iter().flat_map(|rule| ["--part", rule]).collect();
        drawn(&folder, "builtin:plates", "a.svg", &[&["--section", "z=0"], &parts[..]].concat())
    };
    let paths = |svg: &str| svg.matches("<path").count();
    assert_eq!(paths(&cut(&["pin*: uncut", "pin*: solid"])), paths(&cut(&["pin*: solid"])));
    assert_eq!(paths(&cut(&["pin*: uncut", "pin*: ghost"])), paths(&cut(&["pin*: ghost"])));
    assert!(paths(&cut(&["pin*: ghost", "pin*: uncut"])) < paths(&cut(&["pin*: solid"])));
    for page in ["210x297mm", "150x150mm", "1000x1400mm", "99x99mm", "A5", "letter"] {
        let out = folder.path("sheet.svg");
        done(&[
            "render",
            "builtin:plates",
            "-o",
            &out,
            "--look",
            "technical",
            "--sheet",
            "third",
            "--title",
            "P",
            "--page",
            page,
        ]);
    }
    let sheet = |title: &str, words: &[&str]| {
        let out = folder.path("refused.svg");
        refused_in_one_line(&["render", "builtin:plates", "-o", &out, "--sheet", "first", "--title", title], words);
    };
    sheet("Größe", &["--title Größe", "no sign 'Ö'"]);
    sheet(&"long ".repeat(30), &["too long for its field, which holds some"]);
}
