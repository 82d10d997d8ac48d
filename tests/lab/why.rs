//! `tinta why` as a user meets it.

use crate::program::{answer, done, refused_in_one_line, said, tinta};
use crate::support::{Folder, root};
use serde_json::Value;
use tinta::Picture;

/// A plate, faces 0 and 1, and a cube before its lower edge.
const PLATE_AND_CUBE: &[u8] = b"v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\n\
    v -1 -4 1\nv 1 -4 1\nv 1 -1 1\nv -1 -1 1\nv -1 -4 3\nv 1 -4 3\nv 1 -1 3\nv -1 -1 3\n\
    f 1 2 3 4\nf 5 8 7 6\nf 9 10 11 12\nf 5 6 10 9\nf 7 8 12 11\nf 6 7 11 10\nf 5 9 12 8\n";

const FRONT: [&str; 5] = ["--view", "0,0", "--parallel", "--size", "512"];

/// The middle, as the command takes it, of a piece of the plate's rim.
fn middle(folder: &Folder, model: &str, is_visible: bool) -> String {
    let json = folder.path("lines.json");
    assert!(tinta(&[&["render", model, "-o", &json], &FRONT[..]].concat()).status.success());
    let lines: Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    let is_it = |line: &&Value| line["class"] == "boundary" && line["visible"] == is_visible;
    let line = lines["segments"].as_array().unwrap().iter().find(is_it).unwrap_or_else(|| panic!("{lines}"));
    let at = |end: &str, axis: usize| line[end][axis].as_f64().unwrap();
    let [x, y] = [0, 1].map(|axis| (at("a", axis) + at("b", axis)) * 0.5);
    format!("{x},{y}")
}

#[test]
fn a_hidden_line_names_the_faces_in_front_of_it_and_a_visible_one_none() {
    let folder = Folder::new();
    let model = folder.file("plate.obj", PLATE_AND_CUBE);
    let why = |place: &str, json: &[&str]| {
        let output = done(&[&["why", &model, place], &FRONT[..], json].concat());
        String::from_utf8(output.stdout).unwrap()
    };
    let place = middle(&folder, &model, false);
    let hidden: Value = serde_json::from_str(&why(&place, &["--json"])).unwrap();
    assert_eq!((&hidden["line"]["class"], &hidden["is_visible"]), (&"boundary".into(), &false.into()), "{hidden}");
    assert_eq!(hidden["line"]["edge"], serde_json::json!([0, 1]));
    let by = hidden["hidden_by"].as_array().unwrap();
    // The cube's front, then its back.
    for (hider, in_front) in by.iter().zip([3.0, 1.0]) {
        assert_eq!((&hider["kind"], &hider["left"], &hider["right"]), (&"face".into(), &true.into(), &true.into()));
        assert!(hider["face"].as_u64().unwrap() >= 2, "{hider}");
        assert!((hider["in_front"].as_f64().unwrap() - in_front).abs() < 1e-9, "{hider}");
    }
    let pieces = hidden["pieces"].as_array().unwrap();
    let states: Vec<&Value> = pieces.iter().map(|piece| &piece["is_visible"]).collect();
    assert_eq!(states, [true, false, true]);
    let text = why(&place, &[]);
    assert!(text.contains("It is hidden at") && text.contains("on both sides") && text.contains("face "), "{text}");

    let place = middle(&folder, &model, true);
    let text = why(&place, &["--style", "lines"]);
    assert!(text.contains("It is visible at"), "{text}");
    let visible: Value = serde_json::from_str(&why(&place, &["--json"])).unwrap();
    assert_eq!((&visible["is_visible"], &visible["hidden_by"]), (&true.into(), &serde_json::json!([])));
}

#[test]
fn what_cannot_be_explained_is_refused_in_one_sentence() {
    let box_ = "builtin:open-box";
    refused_in_one_line(&["why", box_, "9000,5"], &["9000,5: this is outside of the picture; choose x from 0 to"]);
    refused_in_one_line(&["why", box_, "-1,5"], &["-1,5: this is outside of the picture"]);
    refused_in_one_line(&["why", box_, "middle"], &["'middle'", "such as 240,310"]);
    refused_in_one_line(&["why", box_, "1,2,3"], &["two numbers"]);
    refused_in_one_line(&["why", box_], &["X,Y"]);
    refused_in_one_line(&["why", box_, "5,5", "--classes", "non-manifold"], &["no line of these classes"]);
    refused_in_one_line(&["why", box_, "5,5", "--style", "inks"], &["inks", "ink"]);
    let three = ["--style", "three-pass", "--size", "64"];
    let refused = |place, words: &[&str]| refused_in_one_line(&[&["why", box_, place], &three[..]].concat(), words);
    refused("64,5", &["64,5: this is outside of the picture; choose x from 0 to 63 and y from 0 to 63"]);
    refused("-1,5", &["-1,5: this is outside of the picture"]);
    refused("1,1", &["1,1: this is background, where nothing is drawn; choose a pixel of the model"]);
    // The window and the page, which say the same, have no --help.
    let output = tinta(&[&["why", box_, "1,1"], &three[..]].concat());
    assert!(said(&output).trim_end().ends_with("of the model"), "{}", said(&output));
    refused_in_one_line(&["why", box_, "5,5", "--silhouette", "smooth"], &["ask for exact ones"]);
    refused_in_one_line(&["why", box_, "5,5", "-o", "a.png"], &["--output: it explains shaders", "--style three-pass"]);
}

#[test]
fn a_sheet_that_cannot_be_made_is_refused_in_one_sentence() {
    let refused = |more: &[&str], words: &[&str]| {
        let drawn = ["why", "builtin:open-box", "--size", "64", "--style", "three-pass"];
        refused_in_one_line(&[&drawn[..], more].concat(), words);
    };
    refused(&["32,32", "-o", "a.svg"], &["a.svg", "pictures are not written as .svg", "png"]);
    refused(&["32,32", "-o", "a.npy"], &["a.npy", "pictures are not written as .npy"]);
    refused(&["32,32", "-o", "-", "--json"], &["cannot share standard output"]);
    refused(&["32,32", "-o", "no/such/a.png"], &["no/such"]);
}

/// The text and the JSON of a pixel of the open box, in the style and with the options given.
fn pixel(place: &str, options: &[&str]) -> (String, Value) {
    let why = |more: &[&str]| {
        let output = done(&[&["why", "builtin:open-box", place, "--size", "64"], options, more].concat());
        String::from_utf8(output.stdout).unwrap()
    };
    (why(&[]), serde_json::from_str(&why(&["--json"])).unwrap())
}

#[test]
fn a_pixel_is_explained_pass_by_pass_with_each_statement_and_the_driver_s_value() {
    let (text, json) = pixel("32,32", &["--style", "three-pass"]);
    for word in ["Pixel 32,32 of three-pass", "map, objects", "tones, objects", "border, square", "tap B, texel 32,30"]
    {
        assert!(text.contains(word), "{word}: {text}");
    }
    // The listing's own line, and the variable that it sets.
    assert!(text.contains("float border=filter.r+filter.g+filter.b+filter.a;"), "{text}");
    let steps = json["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 8, "{json}");
    for step in steps {
        assert!(step["difference"].as_f64().unwrap() <= 1.01, "{step}");
    }
    let border = &steps[7]["fragments"][0]["events"];
    let reads = border.as_array().unwrap().iter().filter(|event| event.get("read").is_some()).count();
    assert_eq!(reads, 5, "{border}");
}

#[test]
fn a_pixel_names_the_setting_that_turns_its_ink_over() {
    let places: Vec<String> = (4..60).step_by(5).map(|x| format!("{x},32")).collect();
    let mut turned = 0;
    for place in &places {
        let output = tinta(&["why", "builtin:open-box", place, "--size", "64", "--style", "three-pass", "--json"]);
        if !output.status.success() {
            continue;
        }
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let darkness = |json: &Value| json["lines"]["darkness"].as_u64().unwrap();
        let was_ink = darkness(&json) >= 64;
        for flip in json["lines"]["flips"].as_array().unwrap() {
            let (option, value) =
                (format!("--{}", flip["setting"].as_str().unwrap()), flip["value"].as_f64().unwrap().to_string());
            let with =
                ["why", "builtin:open-box", place, "--size", "64", "--style", "three-pass", "--json", &option, &value];
            let Ok(changed) = serde_json::from_slice::<Value>(&tinta(&with).stdout) else {
                // The border is gone, and with it all that the pixel had.
                assert!(was_ink, "{place} {option} {value}: {json}");
                continue;
            };
            // What the driver draws with it.
            assert_eq!(darkness(&changed) >= 64, !was_ink, "{place} {option} {value}: {json}");
            turned += 1;
        }
    }
    assert!(turned >= 2, "{turned}");
}

#[test]
fn a_sheet_shows_the_pixel_enlarged_in_its_colour_in_every_style() {
    let folder = Folder::new();
    let styles = ["three-pass", "two-pass", "mrt", "inking", "charcoal", "dietrich", "phong", "ink"];
    for (model, style) in
        styles.map(|style| ("builtin:open-box", style)).into_iter().chain([("builtin:soldier", "sand")])
    {
        let sheet = folder.path("sheet.png");
        let words = ["why", model, "32,32", "--size", "64", "--style", style, "--json", "-o", &sheet];
        let json = answer(&words);
        let color = [0, 1, 2].map(|channel| json["color"][channel].as_u64().unwrap() as u8);
        let sheet = tinta::Picture::read_png(std::path::Path::new(&sheet)).unwrap();
        let is_it = |x: i64, y: i64| sheet.pixel(x, y)[..3] == color;
        // A square of 12 by 12 within the mark, in the second panel.
        let has_square = |x: i64, y: i64| (0..12).all(|dy| (0..12).all(|dx| is_it(x + dx, y + dy)));
        let mark = |x: i64, y: i64| sheet.pixel(x, y)[..3] == [213, 94, 0];
        let places = (400..800).flat_map(|x| (60..600).map(move |y| (x, y)));
        let found = places.filter(|(x, y)| mark(x - 1, *y) && mark(x + 12, *y) && has_square(*x, *y)).count();
        assert_eq!(found, 1, "{style}");
        // Text below the panels.
        let dark = (600..i64::from(sheet.size.height)).filter(|y| (0..600).any(|x| sheet.pixel(x, *y)[0] < 60)).count();
        assert!(dark > 40, "{style}: {dark}");
    }
}

/// The guide's listing of two passes in a folder, its filter changed from one text to another.
fn own_listing(from: &str, to: &str) -> (Folder, String) {
    let page = std::fs::read_to_string(root().join("docs/guide/for-teachers.md")).unwrap();
    let (_, listing) = page.split_once("```glsl\n").unwrap();
    let (listing, _) = listing.split_once("\n```").unwrap();
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("my-listing/evangelista")).unwrap();
    let mut count = 0;
    for file in listing.split("// my-listing/").skip(1) {
        let (path, text) = file.split_once('\n').unwrap();
        let changed = if path.ends_with("border.frag") { text.replace(from, to) } else { text.to_owned() };
        std::fs::write(folder.path(&format!("my-listing/{path}")), changed).unwrap();
        count += 1;
    }
    assert_eq!(count, 3, "{listing}");
    let own = folder.path("my-listing");
    (folder, own)
}

#[test]
fn a_listing_of_two_passes_is_explained_with_its_own_lines_and_judged_by_the_exact_ones() {
    let (_folder, own) = own_listing("gl_FragColor", "gl_FragColor");
    let mut inks = 0;
    for x in (8..56).step_by(4) {
        let place = format!("{x},32");
        let options = ["--size", "64", "--style", "three-pass", "--glsl", &own, "--json"];
        let output = tinta(&[&["why", "builtin:bust", &place], &options[..]].concat());
        if !output.status.success() {
            continue;
        }
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let steps = json["steps"].as_array().unwrap();
        for step in steps {
            assert!(step["difference"].as_f64().unwrap() <= 1.01, "{place}: {step}");
        }
        let border = steps.last().unwrap();
        let events = border["fragments"][0]["events"].as_array().unwrap();
        let set = |variable: &str| {
            let event = events.iter().find(|event| event["set"]["variable"] == variable).unwrap();
            assert_eq!(event["shader"], "evangelista/border.frag");
            (event["line"].as_u64().unwrap(), event["set"]["value"].clone())
        };
        let (line, change) = set("change");
        assert_eq!(line, 9);
        let number = change.as_f64().or_else(|| change[0].as_f64()).unwrap_or_else(|| panic!("{change}"));
        // The filter's own rule decides on the ink that is judged.
        let darkness = json["lines"]["darkness"].as_u64().unwrap();
        assert_eq!(darkness, if number > 0.25 { 255 } else { 0 }, "{place}: {number}");
        assert!(json["lines"]["verdict"].is_string());
        // Other settings would run other shaders.
        assert_eq!(json["lines"]["flips"], serde_json::json!([]));
        inks += u64::from(darkness > 0);
    }
    assert!(inks > 0, "no pixel was ink");
}

#[test]
fn mistakes_in_the_second_pass_of_a_listing_are_told_with_its_file_and_line() {
    let why = |own: &str| {
        ["why", "builtin:bust", "32,32", "--size", "64", "--style", "three-pass", "--glsl", own].map(str::to_owned)
    };
    let refused = |from: &str, to: &str, words: &[&str]| {
        let (_folder, own) = own_listing(from, to);
        let line = why(&own);
        refused_in_one_line(&line.each_ref().map(String::as_str), words);
    };
    // Mesa names line 9 so.
    refused("float change =", "float change 5 =", &["/my-listing: evangelista/border.frag does not compile (0:9(15)"]);
    let endless = "for (float i = 0.0; i >= 0.0; ) change = i;\n    gl_FragColor";
    refused(
        "gl_FragColor =",
        &format!("{endless} ="),
        &["/my-listing/evangelista/border.frag, line 10: it still runs after", "end its loop"],
    );
    let array = "float taps[3];\n    gl_FragColor";
    refused(
        "gl_FragColor =",
        &format!("{array} ="),
        &["/my-listing/evangelista/border.frag, line 10: arrays of a shader's own"],
    );
    // A file that no style runs.
    let (_folder, own) = own_listing("gl_FragColor", "gl_FragColor");
    std::fs::rename(format!("{own}/evangelista/border.frag"), format!("{own}/evangelista/boarder.frag")).unwrap();
    let line = why(&own);
    let words = ["no style runs evangelista/boarder.frag; did you mean evangelista/border.frag?"];
    refused_in_one_line(&line.each_ref().map(String::as_str), &words);
}

#[test]
fn a_listing_that_the_settings_do_not_run_is_named() {
    let (_folder, own) = own_listing("gl_FragColor", "gl_FragColor");
    let said = |options: &[&str]| {
        let line = ["why", "builtin:bust", "32,32", "--size", "64", "--style", "three-pass", "--glsl", &own];
        let output = done(&[&line[..], options].concat());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(said(&[]), "");
    // The published filter has this number in its text; another number runs a twin of it.
    let unused = said(&["--detection-factor", "0.4"]);
    assert!(unused.starts_with("tinta: no pass of this drawing runs your evangelista/border.frag; "), "{unused}");
}

/// A folder with this text in place of a style's fragment shader.
fn own_shader(style: &str, text: &str) -> (Folder, String) {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path(&format!("own/{style}"))).unwrap();
    std::fs::write(folder.path(&format!("own/{style}/{style}.frag")), text).unwrap();
    let own = folder.path("own");
    (folder, own)
}

#[test]
fn gls_own_lights_and_materials_are_explained_as_the_driver_has_them() {
    let members = [
        "gl_LightSource[0].position * 0.5 + 0.25",
        "gl_LightSource[0].diffuse * 0.5 + gl_LightSource[1].specular * 0.25",
        "gl_FrontMaterial.diffuse * gl_LightModel.ambient + 0.1 * gl_FrontLightProduct[0].diffuse",
        "gl_FrontLightModelProduct.sceneColor + 0.3 * gl_BackMaterial.ambient",
        "vec4(gl_LightSource[2].spotCutoff / 360.0, gl_LightSource[0].constantAttenuation * 0.5, gl_DepthRange.diff * 0.3, gl_Fog.scale * 0.2)",
        "vec4(0.5 + 0.25 * gl_LightSource[0].spotDirection, 0.1 + gl_FrontMaterial.shininess)",
    ];
    for member in members {
        let (_folder, own) =
            own_shader("phong", &format!("#version 120\nvoid main() {{ gl_FragColor = {member}; }}\n"));
        let options = ["--size", "64", "--style", "phong", "--glsl", &own, "--json"];
        let json = answer(&[&["why", "builtin:bust", "32,32"], &options[..]].concat());
        let difference = json["steps"].as_array().unwrap().last().unwrap()["difference"].as_f64().unwrap();
        assert!(difference <= 1.01, "{member}: {difference}");
    }
}

#[test]
fn uniforms_that_nothing_sets_are_named_once() {
    let text = "#version 120\nuniform vec3 WarmColor;\nuniform float DiffuseWarm, threshold;\nuniform sampler2D Noise;\n\
                void main() { gl_FragColor = vec4(WarmColor * DiffuseWarm + threshold, texture2D(Noise, vec2(0.5)).r); }\n";
    let (folder, own) = own_shader("dietrich", text);
    let picture = folder.path("a.png");
    let common = ["--size", "32", "--style", "dietrich", "--glsl", &own];
    for line in [&["render", "builtin:bust", "-o", &picture][..], &["why", "builtin:bust", "16,16"]] {
        let output = tinta(&[line, &common].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        let expected =
            "tinta: nothing sets DiffuseWarm, Noise, WarmColor of your dietrich/dietrich.frag: numbers are 0";
        assert_eq!(said.matches("nothing sets").count(), 1, "{said}");
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn a_pixel_under_an_exact_line_has_the_colour_of_the_picture() {
    let folder = Folder::new();
    let out = folder.path("gear.png");
    done(&["render", "builtin:gear", "-o", &out, "--size", "96"]);
    let picture = Picture::read_png(std::path::Path::new(&out)).unwrap();
    let places = (0..96 * 96).map(|place| (place % 96, place / 96));
    let dark: Vec<(i64, i64)> = places.filter(|(x, y)| picture.pixel(*x, *y)[0] < 90).collect();
    assert!(dark.len() > 100, "{}", dark.len());
    let ink = dark.iter().map(|(x, y)| picture.pixel(*x, *y)).min_by_key(|color| color[0]).unwrap();
    let half_covered = (0..96 * 96)
        .map(|place| (place % 96, place / 96))
        .find(|(x, y)| (120..160).contains(&picture.pixel(*x, *y)[0]));
    for (x, y) in dark.iter().step_by(dark.len() / 3).chain(&half_covered) {
        let [red, green, blue, _] = picture.pixel(*x, *y);
        let json = answer(&["why", &out, &format!("{x},{y}"), "--json"]);
        let share = json["with_lines"]["share"].as_f64().unwrap();
        assert_eq!(json["with_lines"]["color"], serde_json::json!([red, green, blue]));
        // Of the ink's colour, the darkest, as much as the share says; of the colour below, or of the white ground, the rest.
        for (channel, drawn) in [red, green, blue].into_iter().enumerate() {
            let below = json["color"][channel].as_f64().unwrap_or(255.0);
            let mixed = below + share * (f64::from(ink[channel]) - below);
            assert!((mixed - f64::from(drawn)).abs() <= 2.0, "{x},{y}: {mixed} for {drawn}, {share} over {below}");
        }
        let output = done(&["why", &out, &format!("{x},{y}")]);
        let text = String::from_utf8(output.stdout).unwrap();
        let said = format!(
            "With its lines the pixel is [{red}, {green}, {blue}].\nTheir share of it is {:.0} %.\n",
            share * 100.0
        );
        assert!(text.starts_with(&said), "{text}");
        assert!(text.contains("\nBelow the lines:\n"), "{text}");
    }
}
