//! Presets as a user meets them: read, written, beaten by the command line, refused with their line.

use crate::program::{done, refused_in_one_line};
use crate::support::{Folder, textured};
use serde_json::Value;
use tinta::LoadOptions;
use tinta::preset::{OptionValue, Preset, SHIPPED};
use tinta::recipe::option_words;
use tinta::settings::HasSettings;
use tinta_lab::measure::Row;

fn made(arguments: &[&str]) -> Vec<u8> {
    done(arguments).stdout
}

/// A picture on standard output, without a recipe: equal pictures are equal bytes.
fn picture(model: &str, options: &[&str]) -> Vec<u8> {
    made(&[&["render", model, "-o", "-", "--size", "80x60", "--no-recipe"], options].concat())
}

fn record(options: &[&str]) -> Value {
    let folder = Folder::new();
    let out = folder.path("a.png");
    let base = ["render", "builtin:open-box", "-o", &out, "--size", "32", "--json"];
    serde_json::from_slice(&made(&[&base[..], options].concat())).unwrap()
}

#[test]
fn each_papers_preset_draws_what_its_style_draws_by_default() {
    let folder = Folder::new();
    let model = textured(&folder);
    let mut pictures = Vec::new();
    for (name, text) in SHIPPED {
        let options = Preset::parse(name, text).unwrap().options;
        let OptionValue::Text(style) = &options["style"] else { panic!("{name}") };
        let by_preset = picture(&model, &["--preset", name]);
        // The settings for reading models belong to no style: the preset's are given beside the style.
        let mut by_hand = vec!["--style".to_owned(), style.clone()];
        let of_models = options.iter().filter(|(option, _)| LoadOptions::table().has(option));
        by_hand.extend(of_models.flat_map(|(option, value)| option_words(option, value)));
        let by_hand: Vec<&str> = by_hand.iter().map(String::as_str).collect();
        assert!(by_preset == picture(&model, &by_hand), "{name}");
        assert!(
            text.starts_with("# ") && text.contains("20") || name.contains("dachsbacher"),
            "{name} names its source"
        );
        pictures.push(by_preset);
    }
    // Three passes and two draw nearly, and inking, charcoal and sand quite, different pictures.
    for (index, picture) in pictures.iter().enumerate().skip(2) {
        assert!(pictures[..index].iter().all(|other| other != picture), "{}", SHIPPED[index].0);
    }
}

#[test]
fn dachsbachers_preset_reads_models_by_his_rule_for_normals() {
    let [preset, style, by_hand] = [
        &["--preset", "paper:dachsbacher-inking"][..],
        &["--style", "inking"],
        &["--style", "inking", "--normals", "dachsbacher"],
    ]
    .map(|options| picture("builtin:gear", options));
    assert!(preset == by_hand && preset != style);
    // The command line overrides it, like any option.
    assert!(picture("builtin:gear", &["--preset", "paper:dachsbacher-inking", "--normals", "file"]) == style);
}

#[test]
fn what_the_command_line_gives_counts_more_and_the_record_states_what_counted() {
    let folder = Folder::new();
    let preset = folder.file(
        "mine.toml",
        b"style = \"mrt\"\ntones = 2\ndetection-factor = 0.7\nview = \"front\"\nbackground = \"red\"\nparallel = true\n",
    );
    let given = record(&["--preset", &preset]);
    assert_eq!((&given["style"]["name"], &given["style"]["tones"]), (&"mrt".into(), &2.into()));
    assert!((given["style"]["detection-factor"].as_f64().unwrap() - 0.7).abs() < 1e-6);
    assert_eq!(given["background"]["color"], serde_json::json!([1.0, 0.0, 0.0]));
    // On either side of --preset; an option that excludes one of the preset overrides it.
    for options in [
        &["--tones", "1", "--preset", &preset, "--eye", "1,2,9", "--background", "transparent"][..],
        &["--preset", &preset, "--background", "transparent", "--eye=1,2,9", "--tones=1"],
    ] {
        let beaten = record(options);
        assert_eq!((&beaten["style"]["name"], &beaten["style"]["tones"]), (&"mrt".into(), &1.into()));
        assert_eq!(beaten["camera"]["eye"], serde_json::json!([1.0, 2.0, 9.0]));
        assert_eq!(beaten["background"], "transparent");
    }
}

#[test]
fn what_a_preset_gets_wrong_is_said_with_file_line_and_key() {
    let folder = Folder::new();
    let out = folder.path("a.png");
    let refused = |command: &str, text: &str, words: &[&str]| {
        let preset = folder.file("bad.toml", text.as_bytes());
        let all: Vec<&str> = ["bad.toml: "].iter().chain(words).copied().collect();
        refused_in_one_line(&[command, "builtin:open-box", "-o", &out, "--preset", &preset], &all);
    };
    refused("render", "tones = 2\n\nfoo = 1\n", &["line 3", "foo", "foo: there is no such option"]);
    refused("render", "tones = \"two\"\n", &["line 1: tones two: give a whole number"]);
    refused("render", "# tones\ntones = 7\n", &["line 2: tones 7"]);
    refused("render", "tones = true\n", &["line 1: tones: this takes a value (N)"]);
    refused("render", "parallel = \"yes\"\n", &["line 1: parallel: write true or false"]);
    refused("render", "smooth = 1\n", &["line 1: smooth 1: ", "on or off"]);
    refused("render", "style = \"oil\"\n", &["line 1: style oil: ", "three-pass"]);
    refused("render", "line-width = -1\nstyle = \"inking\"\n", &["line 1: line-width -1"]);
    refused("render", "fov = 400\nview = \"front\"\n", &["line 1: fov 400"]);
    refused("render", "view = \"front\"\neye = [1, 2, 3]\n", &["line 2: eye and view: they exclude each other"]);
    refused("render", "[inking]\nline-width = 2\n", &["line 1: inking: write a text"]);
    for key in ["output = \"b.png\"", "json = true", "dump = \"d\"", "save-preset = \"p\"", "preset = \"q\""] {
        let name = key.split(' ').next().unwrap();
        refused("render", key, &["line 1", name, "this applies to one run"]);
    }
    refused(
        "compare",
        "hidden = \"dashed\"\n",
        &["line 1: hidden: tinta compare does not have this option, only tinta render does"],
    );
    refused("compare", "style = \"charcoal\"\n", &["line 1: style charcoal"]);
    refused("measure", "background = \"red\"\n", &["line 1: background: tinta measure does not have this option"]);
    refused("measure", "style = \"inking\"\nfilter = \"oil\"\n", &["line 2: filter oil: "]);
    refused_in_one_line(
        &["render", "builtin:ant", "-o", &out, "--preset", "paper:monet"],
        &["paper:monet: no shipped preset has this name", "paper:dachsbacher-inking"],
    );
    refused_in_one_line(&["render", "builtin:ant", "-o", &out, "--preset", "none.toml"], &["none.toml: there is no"]);
    assert!(!std::path::Path::new(&out).exists());
}

#[test]
fn switches_are_true_or_false_and_on_or_off() {
    let folder = Folder::new();
    let with = |text: &str| {
        let preset = folder.file("switch.toml", text.as_bytes());
        picture("builtin:gear", &["--style", "inking", "--preset", &preset])
    };
    let smooth = picture("builtin:gear", &["--style", "inking"]);
    let rough = picture("builtin:gear", &["--style", "inking", "--smooth", "off"]);
    assert!(smooth != rough);
    assert!(with("smooth = false") == rough && with("smooth = \"off\"") == rough && with("smooth = true") == smooth);
    let parallel = picture("builtin:gear", &["--style", "inking", "--parallel"]);
    assert!(with("parallel = true") == parallel && with("parallel = false") == smooth && parallel != smooth);
}

#[test]
fn settings_in_use_are_saved_and_draw_the_same() {
    let folder = Folder::new();
    let [first, second] = ["first.toml", "second.toml"].map(|name| folder.path(name));
    let options = [
        "--style",
        "inking",
        "--line-width=3.5",
        "--view=-20,10",
        "--class-colors",
        "silhouette=#aa0000",
        "--parallel",
    ];
    let asked = picture("builtin:gear", &[&options[..], &["--save-preset", &first]].concat());
    let preset = Preset::read(&first).unwrap();
    assert_eq!(preset.options["line-width"], OptionValue::text("3.5"));
    assert_eq!(preset.options["parallel"], OptionValue::Switch(true));
    assert_eq!(preset.options.len(), 6, "{:?}", preset.options);
    assert!(asked == picture("builtin:gear", &["--preset", &first]));
    // A preset with an additional option becomes another preset.
    let more = picture("builtin:gear", &["--preset", &first, "--line-width", "1", "--save-preset", &second]);
    assert!(more != asked && more == picture("builtin:gear", &["--preset", &second]));
    assert_eq!(Preset::read(&second).unwrap().options["line-width"], OptionValue::text("1"));
    let out = folder.path("a.png");
    let refused = |path: &str, words: &[&str]| {
        refused_in_one_line(&["render", "builtin:ant", "-o", &out, "--save-preset", path], words);
    };
    refused("-", &["--save-preset -", "a preset is a file"]);
    refused(&out, &["--save-preset", "the picture's file"]);
    refused(&folder.path("no/such/a.toml"), &["folder", "does not exist"]);
    assert!(!std::path::Path::new(&out).exists());
}

#[test]
fn a_comparison_takes_a_presets_style_for_the_left() {
    let folder = Folder::new();
    let out = folder.path("both.png");
    let preset = folder.file("ink.toml", b"style = \"inking\"\nline-width = 4\nsize = 64\n");
    let compare = |options: &[&str]| -> Value {
        let base = ["compare", "builtin:open-box", "-o", &out, "--frames", "1", "--json", "--preset", &preset];
        serde_json::from_slice(&made(&[&base[..], options].concat())).unwrap()
    };
    let record = compare(&["--right", "dietrich"]);
    assert_eq!(
        (&record["left"]["style"]["name"], &record["right"]["style"]["name"]),
        (&"inking".into(), &"dietrich".into())
    );
    assert_eq!((&record["left"]["style"]["line-width"], &record["size"]["width"]), (&4.0.into(), &64.into()));
    assert_eq!(compare(&["--left", "ink"])["left"]["style"]["name"], "ink");
}

#[test]
fn a_presets_style_is_measured_beside_the_others() {
    let folder = Folder::new();
    let preset = folder.file("ink.toml", b"style = \"inking\"\nline-width = 4\nview = \"front\"\nsize = 48\n");
    let rows = |name: &str, preset: &str, more: &[&str]| -> Vec<Row> {
        let out = folder.path(name);
        let base = ["measure", "-o", &out, "--quick", "--frames", "1", "--styles", "phong", "--preset", preset];
        made(&[&base[..], more].concat());
        let text = std::fs::read_to_string(format!("{out}/results.jsonl")).unwrap();
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    };
    let of_mine = rows("mine", &preset, &["builtin:open-box"]);
    let told: Vec<(&str, [u32; 2], bool)> =
        of_mine.iter().map(|row| (row.options.as_str(), row.size, row.is_faithful)).collect();
    let expected = [
        ("--style phong --view=front", [48, 48], true),
        ("--style inking --line-width 4 --view=front", [48, 48], false),
    ];
    assert_eq!(told, expected);
    // A picture of the errors has a name that fits, however many options there are, and folders in them.
    let skin = textured(&folder).replace("square.obj", "skin.png");
    let long = format!(
        "style = \"ink\"\ntone-levels = [0.123456, 0.234567, 0.345678]\ntone-thresholds = [0.456789, 0.567891]\n\
         cull = \"back\"\nborder-width = 3\ncrease-angle = 44.4444\nmap-target = \"texture\"\nskin = {skin:?}\n"
    );
    let of_long = rows("long", &folder.file("long.toml", long.as_bytes()), &["--size", "32", &textured(&folder)]);
    assert!(of_long[1].options.len() > 160 && of_long[1].options.contains(&skin), "{}", of_long[1].options);
    let errors = std::fs::read_dir(folder.path("long/errors")).unwrap();
    let names: Vec<String> = errors.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    assert!(!names.is_empty() && names.iter().all(|name| name.len() < 255 && name.ends_with(".png")), "{names:?}");
    let of_paper = rows("paper", "paper:evangelista-two-pass", &["--size", "32", "builtin:open-box"]);
    assert_eq!(of_paper[1].options, "--style two-pass");
    assert_eq!(
        of_paper.iter().map(|row| (row.style.as_str(), row.is_faithful)).collect::<Vec<_>>(),
        [("phong", true), ("two-pass", true)]
    );
}
