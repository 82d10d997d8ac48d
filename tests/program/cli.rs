//! The program as a user meets it: files, messages, exit codes, records.

use crate::program::{answer, done, refused_in_one_line, tinta};
use crate::support::{Folder, skip};
use std::path::Path;
use std::process::Command;
use tinta::StyleName;

#[test]
fn a_picture_is_written_and_nothing_is_said() {
    let folder = Folder::new();
    let picture = folder.path("bust.png");
    let output = done(&["render", "builtin:bust", "-o", &picture, "--size", "64x48"]);
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
    let size = image::image_dimensions(&picture).unwrap();
    assert_eq!(size, (64, 48));
}

#[test]
fn a_dash_writes_png_to_standard_output() {
    let output = tinta(&["render", "builtin:ant", "-o", "-", "--size", "40"]);
    assert_eq!(image::load_from_memory(&output.stdout).unwrap().width(), 40);
    refused_in_one_line(&["render", "builtin:ant", "-o", "-", "--json"], &["-o -", "name a file"]);
}

#[test]
fn models_that_cannot_be_read_are_refused_by_name() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let render = |model: &str, words: &[&str]| refused_in_one_line(&["render", model, "-o", &out], words);
    render("no-such.obj", &["no-such.obj: there is no such file"]);
    render(&folder.path(""), &["this is a directory"]);
    render(&folder.file("empty.obj", b""), &["empty.obj: the file is empty"]);
    render(&folder.file("garbage.obj", &[0, 200, 3, 255, 0, 17]), &["garbage.obj"]);
    render(&folder.file("garbage.ply", b"\x00\x01\x02 not ply"), &["garbage.ply: it does not begin like a PLY"]);
    render(&folder.file("garbage.stl", &[7; 500]), &["garbage.stl: its header promises"]);
    render(&folder.file("notes.txt", b"dear diary"), &["notes.txt: this is not a model"]);
    render(&folder.file("cut.obj", b"v 0 0 0\nv 1 0 0\nv 0 1"), &["cut.obj: line 3: a vertex is not three numbers"]);
    render(&folder.file("points.obj", b"v 0 0 0\nv 1 0 0\n"), &["points.obj: it holds 2 vertices but no faces"]);
    render(&folder.file("line.obj", b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), &["1 degenerate triangle"]);
    render("builtin:unicorn", &["builtin:unicorn: there is no such built-in model", "builtin:bust"]);
    assert!(!Path::new(&out).exists());
}

#[cfg(unix)]
#[test]
fn a_model_without_permission_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let model = folder.file("secret.obj", b"v 0 0 0\n");
    std::fs::set_permissions(&model, std::fs::Permissions::from_mode(0o000)).unwrap();
    if std::fs::read(&model).is_ok() {
        skip("a model without permission: the super-user may read everything");
        return;
    }
    refused_in_one_line(&["render", &model, "-o", &folder.path("out.png")], &["secret.obj: no permission to read it"]);
}

#[test]
fn a_model_is_read_by_its_content_where_its_name_disagrees() {
    let folder = Folder::new();
    let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let model = folder.file("misnamed.obj", ply);
    let output = done(&["render", &model, "-o", &folder.path("out.png"), "--size", "32"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("misnamed.obj: the name says OBJ but the content is PLY"));
}

#[test]
fn defects_are_said_once_and_refused_when_strict() {
    let folder = Folder::new();
    let model = folder.file("faulty.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 2 3\nf 1 1 2\nf 1 2 99\n");
    let out = folder.path("out.png");
    let arguments = ["render", &model, "-o", &out, "--size", "32"];
    let output = tinta(&arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    let counts = "1 degenerate triangle, 1 duplicate triangle, 1 face with an index out of range, 1 unused vertex";
    assert!(said.contains(counts), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    refused_in_one_line(&["render", &model, "-o", &out, "--strict"], &["faulty.obj", counts, "--strict"]);
}

#[test]
fn nonsensical_settings_are_refused_by_name() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let render = |options: &[&str], words: &[&str]| {
        let mut arguments = vec!["render", "builtin:open-box", "-o", &out, "--look", "published"];
        arguments.extend(options);
        refused_in_one_line(&arguments, words);
    };
    render(&["--size", "0x10"], &["--size"]);
    // Before anything is made for its pixels: any style, any file.
    for (style, _) in StyleName::ALL {
        render(&["--size", "40000000", "--style", style], &["--size 40000000x40000000", "the largest picture"]);
    }
    for (file, look) in [("a.svg", "print"), ("a.pdf", "technical"), ("a.dxf", "technical"), ("a.png", "print")] {
        let out = folder.path(file);
        let words = ["--size 40000000x40000000", "the largest picture"];
        refused_in_one_line(&["render", "builtin:open-box", "-o", &out, "--look", look, "--size", "40000000"], &words);
    }
    render(&["--eye", "1,2,3", "--target", "1,2,3"], &["--eye and --target", "same point"]);
    render(&["--up", "0,0,0"], &["--up"]);
    render(&["--eye", "0,0,9", "--target", "0,0,0", "--up", "0,0,1"], &["--up", "along the view"]);
    render(&["--fov", "180"], &["--fov 180"]);
    render(&["--fov", "-1"], &["--fov -1"]);
    render(&["--near", "5", "--far", "4"], &["--near and --far", "5 and 4 away"]);
    render(&["--near", "0"], &["--near"]);
    render(&["--tones", "4"], &["--tones 4"]);
    render(&["--tones", "tone-levels=1,2"], &["tone-levels=1,2", "3 numbers"]);
    render(&["--detection-factor", "nan"], &["--detection-factor NaN"]);
    render(&["--weld", "2"], &["--weld 2"]);
    render(&["--normals", "smooth-angle=181"], &["--normals smooth-angle=181"]);
    render(&["--copies", "0"], &["--copies 0"]);
    render(&["--copies", "4000000000"], &["--copies 4000000000"]);
    render(&["--tones", "tone-levels=1,2,3"], &["--tones tone-levels"]);
    render(&["--fov", "1e-9"], &["--fov"]);
    render(&["--show", "tones", "--style", "phong"], &["--show"]);
    render(&["--style", "mrt", "--map-encoding", "float"], &["--map-encoding", "mrt", "three-pass"]);
    render(&["--style", "cubist"], &["cubist", "three-pass"]);
    render(&["--background", "blurple"], &["blurple", "CSS name"]);
    render(&["--background", "transparent", "--style", "two-pass"], &["--background transparent", "three-pass"]);
    render(&["--show", "map", "--style", "phong"], &["--show", "phong has no lines, tones or map"]);
    render(&["--show", "borders", "--no-borders"], &["--show borders", "--no-borders"]);
    render(&["--no-such-option"], &["--no-such-option"]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn command_lines_that_are_not_understood_are_answered_in_one_line() {
    refused_in_one_line(
        &["render", "builtin:ant"],
        &["tinta: --output is missing; name the picture to write: -o ant.png", "--help"],
    );
    refused_in_one_line(&["render", "-o", "a.png"], &["a model is missing; name a file, or a built-in one"]);
    refused_in_one_line(&["paint"], &["paint"]);
    refused_in_one_line(&["render", "a\nb.obj", "-o", "a.png"], &["a\\nb.obj"]);
    refused_in_one_line(
        &["render", "/dev/zero", "-o", "a.png"],
        &["/dev/zero: this is a pipe or a device, not a regular file"],
    );
}

#[test]
fn outputs_are_checked_before_the_work_and_kept_when_it_fails() {
    let folder = Folder::new();
    refused_in_one_line(&["render", "no-such.obj", "-o", "drawing.xyz"], &["drawing.xyz: tinta writes no .xyz"]);
    refused_in_one_line(
        &["render", "builtin:ant", "-o", "no/such/a.png"],
        &["no/such/a.png: the folder no/such does not exist"],
    );
    refused_in_one_line(
        &["render", "builtin:ant", "-o", "a.jpg", "--background", "transparent"],
        &["a.jpg", "no transparency"],
    );
    let kept = folder.file("kept.png", b"what was there");
    refused_in_one_line(&["render", "no-such.obj", "-o", &kept], &["no-such.obj"]);
    assert_eq!(std::fs::read(&kept).unwrap(), b"what was there");
}

#[test]
fn the_record_says_what_was_drawn_and_how_long_it_took() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let options =
        ["--json", "--frames", "3", "--size", "80x60", "--view", "front", "--copies", "4", "--look", "published"];
    let mut arguments = vec!["render", "builtin:open-box", "-o", &out];
    arguments.extend(options);
    let record = answer(&arguments);
    assert_eq!(record["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(record["model"], record["models"][0]);
    assert_eq!(record["models"][0]["path"], "builtin:open-box");
    assert_eq!(record["models"][0]["triangles"], 10);
    assert_eq!(record["models"][0]["vertices"], 8);
    assert_eq!(record["triangles"], 40);
    assert_eq!(record["style"]["name"], "three-pass");
    assert_eq!(record["style"]["filter"], "laplacian4");
    assert_eq!(record["size"], serde_json::json!({ "width": 80, "height": 60 }));
    assert_eq!(record["camera"]["fov_y_degrees"], 30.0);
    let passes: Vec<&str> = record["passes"].as_array().unwrap().iter().map(|p| p["name"].as_str().unwrap()).collect();
    assert_eq!(passes, ["map", "tones", "border"]);
    assert!(record["passes"][0]["cpu_ms"].as_f64().unwrap() > 0.0);
    assert_eq!(record["frame_ms"]["all"].as_array().unwrap().len(), 3);
    for key in ["load_ms", "context_ms", "first_frame_ms"] {
        assert!(record[key].as_f64().unwrap() > 0.0, "{key}");
    }
    assert_eq!(record["gl"]["alpha_bits"], 8);
    // The matrices are column by column: the view takes the eye to the origin, the projection the target to the middle.
    let matrix = |name: &str| {
        let numbers: Vec<f64> =
            record["camera"][name].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect();
        glam::DMat4::from_cols_slice(&numbers)
    };
    let point = |name: &str| {
        let numbers: Vec<f64> =
            record["camera"][name].as_array().unwrap().iter().map(|n| n.as_f64().unwrap()).collect();
        glam::DVec3::from_slice(&numbers)
    };
    let eye = matrix("view_from_world").transform_point3(point("eye"));
    assert!(eye.length() < 1e-9);
    let middle = (matrix("clip_from_view") * matrix("view_from_world")).project_point3(point("target"));
    assert!(middle.x.abs() < 1e-9 && middle.y.abs() < 1e-9 && middle.z.abs() < 1.0);
}

#[test]
fn the_plan_is_explained_with_times() {
    let folder = Folder::new();
    let output = tinta(&[
        "render",
        "builtin:open-box",
        "-o",
        &folder.path("a.png"),
        "--explain",
        "--size",
        "50",
        "--look",
        "published",
    ]);
    let text = String::from_utf8(output.stdout).unwrap();
    for words in [
        "pass 1: map",
        "copy the framebuffer",
        "evangelista/border.frag",
        "whole picture",
        "joining vertices",
        "first frame",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn a_dump_holds_every_step() {
    let folder = Folder::new();
    let steps = folder.path("steps");
    done(&[
        "render",
        "builtin:ant",
        "-o",
        &folder.path("a.png"),
        "--size",
        "50",
        "--style",
        "three-pass",
        "--dump",
        &steps,
    ]);
    let mut names: Vec<String> =
        std::fs::read_dir(&steps).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names.first().unwrap(), "01-map-clear.png");
    assert_eq!(names.last().unwrap(), "08-border-square.png");
    let map = image::open(Path::new(&steps).join("04-map-copy.png")).unwrap();
    assert_eq!(map.color(), image::ColorType::Rgba8);
}

#[test]
fn info_lists_every_attempt_in_words_and_as_json() {
    let text = String::from_utf8(tinta(&["info"]).stdout).unwrap();
    assert!(
        ["EGL device 0", "OSMesa", "EGL surfaceless", "largest picture"].iter().all(|word| text.contains(word)),
        "{text}"
    );
    let json: serde_json::Value = serde_json::from_slice(&tinta(&["info", "--json"]).stdout).unwrap();
    let attempts = json["attempts"].as_array().unwrap();
    assert!(attempts.len() >= 3);
    let working = attempts.iter().find(|attempt| attempt["context"].is_object()).unwrap();
    for key in ["vendor", "renderer", "version", "glsl_version", "alpha_bits", "depth_bits", "aliased_line_width"] {
        assert!(!working["context"][key].is_null(), "{key}");
    }
}

#[test]
fn info_says_the_size_of_curves_and_points_alone_and_no_minus_zero() {
    let folder = Folder::new();
    for (text, size) in [
        ("v 0 0 0\nv 1 0 2\nl 1 2\n", "[0, 0, 0] to [1, 0, 2]"),
        ("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\nv 3 0 0\np 4\n", "[0, 0, 0] to [3, 0, 1]"),
    ] {
        let model = folder.file("a.obj", text.as_bytes());
        let output = done(&["info", &model]);
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains(&format!("{size}, in the axes of the file")), "{said}");
    }
    let model = folder.file("z.obj", b"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    let said = String::from_utf8(done(&["info", &model, "--up-axis", "z"]).stdout).unwrap();
    assert!(said.contains("[0, 0, 0] to [1, 0, 1]"), "{said}");
}

#[cfg(unix)]
#[test]
fn an_argument_that_is_not_in_utf_8_is_named_with_a_way_round_it() {
    use std::os::unix::ffi::OsStrExt;
    let name = std::ffi::OsStr::from_bytes(b"m\xe9.obj");
    let output = Command::new(env!("CARGO_BIN_EXE_tinta")).args([std::ffi::OsStr::new("info"), name]).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    let sentence =
        "tinta: m\u{fffd}.obj is not in UTF-8; rename the file, or give a model as - on standard input; see --help\n";
    assert_eq!(said, sentence);
}

#[test]
fn a_check_of_the_drivers_says_of_each_style_and_question_how_it_came_out() {
    let output = tinta(&["info", "--check", "--backend", "egl"]);
    let text = String::from_utf8(output.stdout).unwrap();
    let json: serde_json::Value =
        serde_json::from_slice(&tinta(&["info", "--check", "--json", "--backend", "egl"]).stdout).unwrap();
    let found = &json["checked"][0]["found"];
    let names = |list: &str, key: &str| -> Vec<String> {
        found[list].as_array().unwrap().iter().map(|row| row[key].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names("styles", "style").len(), tinta::StyleName::of_passes().count());
    assert_eq!(names("probes", "name").len(), 5);
    for name in [names("styles", "style"), names("probes", "name")].concat() {
        assert!(text.contains(&format!("  {name} ")), "{name}: {text}");
    }
    let all = ["styles", "probes"].iter().flat_map(|list| found[list].as_array().unwrap());
    let passed: Vec<bool> = all.map(|row| row["passed"].as_bool().unwrap()).collect();
    let is_good = passed.iter().all(|passed| *passed);
    assert_eq!(output.status.code(), Some(if is_good { 0 } else { 1 }), "{text}");
    let refused = tinta(&["info", "--check", "--backend", "wgl"]);
    let said = String::from_utf8(refused.stderr).unwrap();
    assert!(refused.status.code() == Some(2) && said.contains("it is of Windows, and this is "), "{said}");
}

#[test]
fn without_any_driver_the_sentence_says_what_was_tried_and_what_to_install() {
    // A vendor folder without vendors leaves libEGL without a driver.
    let folder = Folder::new();
    let output = Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(["render", "builtin:ant", "--backend", "egl", "-o", &folder.path("a.png")])
        .env("__EGL_VENDOR_LIBRARY_DIRS", folder.path(""))
        .env_remove("__EGL_VENDOR_LIBRARY_FILENAMES")
        .output()
        .unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("EGL") && message.contains("apt-get install"), "{message}");
}

#[test]
fn help_states_every_default() {
    for (command, least) in [("render", 50), ("again", 3), ("compare", 50), ("info", 10)] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_tinta"));
        let output = program.args([command, "--help"]).env_remove("COLUMNS").output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        // An option's description reaches to the next line that begins with a dash or ends a section.
        let mut options: Vec<String> = Vec::new();
        for line in text.lines() {
            // Words that begin with a dash stand farther in.
            if line.starts_with("  -") || line.starts_with("      --") {
                options.push(String::new());
            }
            if let Some(option) = options.last_mut() {
                option.push_str(line);
                option.push(' ');
            }
        }
        assert!(options.len() >= least, "{command} has {} options", options.len());
        for option in options {
            let has_none = ["-o, --output", "-h, --help"].iter().any(|name| option.contains(name));
            assert!(has_none || option.contains("[default: "), "{command}: {option} states no default");
        }
    }
    let text = String::from_utf8(tinta(&["render", "--help"]).stdout).unwrap();
    assert!(text.contains("builtin:bust"));
    done(&["--help"]);
    assert_eq!(tinta(&[]).status.code(), Some(2));
}

#[test]
fn frames_and_skins_are_refused_where_a_model_has_none_and_recorded_where_it_has() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    let skin = folder.file("skin.pcx", b"");
    refused_in_one_line(
        &["render", "builtin:ant", "-o", &out, "--model-frame", "3"],
        &["--model-frame 3: builtin:ant has no frames"],
    );
    refused_in_one_line(&["render", "builtin:ant", "-o", &out, "--model-frame", "-1"], &["counted from 0"]);
    refused_in_one_line(
        &["render", "builtin:ant", "-o", &out, "--texture", "skin=no-such.pcx"],
        &["no-such.pcx: there is no such file"],
    );
    refused_in_one_line(
        &["render", "builtin:ant", "-o", &out, "--texture", &format!("skin={}", skin)],
        &["has no texture coordinates"],
    );
    let model =
        folder.file("card.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nmtllib a.mtl\n");
    folder.file("a.mtl", b"newmtl a\nmap_Kd -s 1 1 1 ART\\my skin.png\n");
    let render = |options: &[&str]| {
        let mut arguments = vec!["render", &model, "-o", &out, "--size", "32", "--json", "--look", "published"];
        arguments.extend(options);
        let output = done(&arguments);
        let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        (record["load"].clone(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (load, said) = render(&[]);
    assert!(load["skin"].is_null() && load["model-frame"] == 0 && load["up-axis"] == "auto", "{load}");
    assert!(said.contains("the picture ART\\my skin.png is not beside it"), "{said}");
    folder.file("My Skin.png", b"");
    assert_eq!(
        render(&[]).1.matches("not drawn").count(),
        1,
        "its skin is there now, and the published style leaves it out"
    );
    assert_eq!(render(&["--texture", &format!("skin={}", skin)]).0["skin"], skin);
}
