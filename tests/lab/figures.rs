//! `tinta figures`: the list, the files, the page, the record, and each command's picture.

use crate::program::{done, refused_in_one_line, tinta};
use crate::support::Folder;
use roxmltree::{Document, ParsingOptions};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use tinta::gl::is_software;
use tinta::{Backend, Picture, Size};
use tinta_lab::figures::{
    Content, Drawing, Figure, HowToMeasure, Panel, TRIANGLES, Turn, figures, kernels, measure, only, pass_columns,
};

const SIZE: Size = Size { width: 48, height: 48 };

/// Every figure of the texts, and the additional ones.
const IDS: [&str; 33] = [
    "evangelista-1",
    "evangelista-2",
    "evangelista-3",
    "evangelista-4",
    "evangelista-5",
    "evangelista-6",
    "evangelista-7",
    "evangelista-8",
    "evangelista-9",
    "evangelista-10",
    "evangelista-11",
    "evangelista-12",
    "evangelista-13",
    "evangelista-14",
    "evangelista-numbers",
    "valente-1",
    "valente-2",
    "valente-3",
    "valente-4",
    "valente-5",
    "valente-6",
    "valente-7",
    "valente-8",
    "valente-9",
    "valente-10",
    "valente-11",
    "valente-12",
    "dachsbacher-result",
    "dachsbacher-edges",
    "dachsbacher-options",
    "dachsbacher-shading",
    "dachsbacher-ramp",
    "dachsbacher-ants",
];

/// Every panel.
fn panels(figures: &[Figure]) -> Vec<Panel> {
    figures.iter().flat_map(Figure::panels).cloned().collect()
}

fn run(arguments: &[&str]) -> String {
    let output = tinta(&[&["figures"], arguments].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    assert!(output.stdout.is_empty());
    said
}

/// The page's pictures, after checking that it is valid and loads nothing from elsewhere.
fn pictures_of_page(folder: &Folder) -> Vec<String> {
    let text = std::fs::read_to_string(folder.path("index.html")).unwrap();
    let page =
        Document::parse_with_options(&text, ParsingOptions { allow_dtd: true, ..ParsingOptions::default() }).unwrap();
    let ids: Vec<&str> = page.descendants().filter_map(|node| node.attribute("id")).collect();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "an id stands twice");
    for link in page.descendants().filter_map(|node| node.attribute("href")) {
        assert!(ids.contains(&link.strip_prefix('#').unwrap()), "{link}");
    }
    assert!(page.descendants().all(|node| !node.has_tag_name("script") && !node.has_tag_name("link")));
    let images = page.descendants().filter(|node| node.tag_name().name() == "img");
    let files = images.map(|image| {
        assert!(image.attribute("alt").is_some_and(|alt| !alt.is_empty()));
        let source = image.attribute("src").unwrap();
        assert!(source.starts_with("data:image/") && source.len() > 100, "the page holds its pictures: {source:.40}");
        image.attribute("data-file").unwrap().to_owned()
    });
    files.collect()
}

/// Checks every number in a value, and that null appears only where allowed.
fn check_numbers(value: &Value, name: &str, count: &mut usize) {
    match value {
        Value::Number(number) => {
            assert!(number.as_f64().unwrap().is_finite(), "{name}");
            *count += 1;
        }
        Value::Null => assert!(["paper_mpixels", "mpixels"].contains(&name), "{name} is empty"),
        Value::Array(values) => values.iter().for_each(|value| check_numbers(value, name, count)),
        Value::Object(fields) => fields.iter().for_each(|(name, value)| check_numbers(value, name, count)),
        Value::Bool(_) | Value::String(_) => {}
    }
}

#[test]
fn every_figure_of_the_texts_is_in_the_list_once() {
    let ids: Vec<&str> = figures(SIZE).iter().map(|figure| figure.id).collect();
    assert_eq!(ids, IDS);
    let chosen = only(figures(SIZE), &["valente-9".to_owned(), "evangelista-1".to_owned()]).unwrap();
    assert_eq!(chosen.iter().map(|figure| figure.id).collect::<Vec<_>>(), ["evangelista-1", "valente-9"]);
    // Fourteen and twelve have numbers.
    for (text, count) in [("evangelista", 14), ("valente", 12)] {
        for number in 1..=count {
            assert!(ids.contains(&format!("{text}-{number}").as_str()), "{text} {number}");
        }
    }
}

#[test]
fn a_figure_that_is_not_drawn_has_a_reason_and_no_other_has() {
    for figure in figures(SIZE) {
        match figure.content {
            Content::NotDrawn(reason) => assert!(reason.len() > 40 && !reason.ends_with('.'), "{}", figure.id),
            Content::Pictures(panels) => assert!(!panels.is_empty(), "{}", figure.id),
            Content::Frames | Content::OtherNumbers | Content::Passes => {}
        }
    }
}

#[test]
fn the_diagram_of_passes_is_what_the_plans_do() {
    let columns = pass_columns(&HowToMeasure { size: SIZE, frames: 1, scenes: 1 }).unwrap();
    let names: Vec<Vec<&str>> =
        columns.iter().map(|column| column.passes.iter().map(|pass| pass.name).collect()).collect();
    assert_eq!(names, [vec!["map", "tones-and-border"], vec!["map", "tones", "border"]]);
    assert_eq!(columns[0].passes[0], columns[1].passes[0], "both begin with the same map");
    assert!(columns[1].passes[2].steps[0].contains("evangelista/border.frag") && columns[1].passes[2].steps.len() == 1);
}

#[test]
fn a_quick_run_writes_a_page_with_all_its_pictures_and_finite_numbers() {
    let folder = Folder::new();
    let said = run(&["-o", &folder.path(""), "--size", "48", "--quick", "--frames", "2"]);
    assert_eq!(said, "", "every figure is drawn without a file");
    let shown: BTreeSet<String> = pictures_of_page(&folder).into_iter().collect();
    let page = std::fs::read_to_string(folder.path("index.html")).unwrap();
    assert!(page.contains("The originals' pictures were not at hand") && page.contains("Not drawn: "));
    let mut expected: BTreeSet<String> = panels(&figures(SIZE)).into_iter().map(|panel| panel.file).collect();
    expected.extend([1, 2, 3].map(|tones| format!("evangelista-13-tones-{tones}.svg")));
    assert_eq!(shown, expected);
    for file in &expected {
        let bytes = std::fs::read(folder.path(file)).unwrap();
        match file.ends_with(".svg") {
            true => drop(Document::parse(std::str::from_utf8(&bytes).unwrap()).unwrap()),
            false => assert!(image::load_from_memory(&bytes).is_ok(), "{file}"),
        }
    }
    let record: Value = serde_json::from_slice(&std::fs::read(folder.path("figures.json")).unwrap()).unwrap();
    assert_eq!(record["figures"].as_array().unwrap().len(), IDS.len());
    let numbers = &record["numbers"];
    let mut count = 0;
    check_numbers(numbers, "numbers", &mut count);
    assert_eq!(numbers["frames"].as_array().unwrap().len(), TRIANGLES.len() / 2 * 6);
    assert!(numbers["frames"].as_array().unwrap().iter().all(|row| row["frames_ms"].as_array().unwrap().len() == 2));
    assert_eq!(numbers["shaders"].as_array().unwrap().len(), 6);
    assert!(count > 100, "only {count} numbers");
    let renderer = record["gl"]["renderer"].as_str().unwrap();
    assert_eq!(numbers["host"]["is_software"], is_software(renderer));
}

#[test]
fn matrices_are_what_the_filters_compute() {
    for (name, filter) in tinta::styles::Filter::ALL {
        for kernel in kernels(filter) {
            let cells = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
            let sum: f64 = cells.map(|(row, column)| kernel.weight(row, column)).sum();
            // The text prints the pattern of Mitchell's five reads, without weights.
            let expected = if name.starts_with("mitchell") { 5.0 } else { 0.0 };
            assert!((sum - expected).abs() < 1e-12, "{name}: {sum}");
        }
    }
}

#[test]
fn each_command_draws_the_picture_it_stands_below() {
    let folder = Folder::new();
    let is_of_pictures = |content: &Content| matches!(content, Content::Pictures(_));
    let chosen: Vec<Figure> = figures(SIZE).into_iter().filter(|figure| is_of_pictures(&figure.content)).collect();
    let ids: Vec<&str> = chosen.iter().map(|figure| figure.id).collect();
    run(&["-o", &folder.path(""), "--size", "48", "--quick", "--frames", "1", "--only", &ids.join(",")]);
    let read = |path: &str| Picture::read_png(Path::new(path)).unwrap();
    let mut compared = 0;
    for panel in &panels(&chosen) {
        let command = panel.command(SIZE, Some("builtin:soldier"));
        let again = match &panel.drawing {
            Drawing::Grains(_) | Drawing::Ramp => {
                // The command of all figures, which ran above.
                assert!(command.ends_with(&format!("# figures/{}", panel.file)), "{command}");
                continue;
            }
            Drawing::Scene(_) => {
                let again = folder.path("again.png");
                let words = command.split(' ').skip(1);
                let words: Vec<&str> = words.map(|word| if word == panel.file { &again } else { word }).collect();
                done(&words);
                again
            }
        };
        assert!(read(&folder.path(&panel.file)) == read(&again), "{command} draws another picture than {}", panel.file);
        compared += 1;
    }
    assert!(compared > 35, "only {compared} pictures were compared");
}

#[test]
fn a_model_with_a_texture_fills_the_figures_that_need_one() {
    let folder = Folder::new();
    let model = folder.file("leaf.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 .2\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    let skin = folder.file("skin.ppm", b"P3 2 1 255 200 40 30 20 90 200\n");
    let output = folder.path("out");
    let figures = ["-o", &output, "--size", "48", "--only", "valente-9,valente-12"];
    let said = run(&[&figures[..], &["--model", &model, "--model-picture", &skin]].concat());
    assert_eq!(said, "");
    let page = std::fs::read_to_string(format!("{output}/index.html")).unwrap();
    assert!(page.contains(&format!("tinta render {model} --texture skin={skin} -o valente-9.png")), "{page}");
    assert!(!page.contains("Left out"));
    assert!(Path::new(&format!("{output}/valente-12-model.png")).exists());
}

#[test]
fn what_cannot_be_done_is_said_in_a_sentence() {
    let folder = Folder::new();
    let out = folder.path("out");
    refused_in_one_line(&["figures"], &["--output is missing; name the folder", "see --help"]);
    let unknown = ["figures", "-o", &out, "--only", "evangelista-5,evangelista-15"];
    refused_in_one_line(&unknown, &["--only evangelista-15: there is no such figure; choose from evangelista-1,"]);
    assert!(!Path::new(&out).exists(), "nothing is made before the words are understood");
    let file = folder.file("file", b"");
    refused_in_one_line(&["figures", "-o", &file], &["this is a file; name a folder"]);
    refused_in_one_line(&["figures", "-o", &format!("{file}/below")], &["the folder cannot be created"]);
    let bare = ["figures", "-o", &out, "--only", "valente-9", "--model", "builtin:ant"];
    refused_in_one_line(&bare, &["--model builtin:ant: no picture for it was found", "--model-picture"]);
    refused_in_one_line(&["figures", "-o", &out, "--model-picture", "a.png"], &["--model"]);
    refused_in_one_line(&["figures", "-o", &out, "--frames", "0"], &["--frames"]);
}

#[test]
fn every_measured_number_has_a_sentence_and_none_calls_this_renderer_what_it_is_not() {
    let mut renderer = crate::support::renderer(Backend::Auto);
    let how = HowToMeasure { size: SIZE, frames: 4, scenes: 2 };
    let mut turns = Vec::new();
    let numbers = measure(&mut renderer, &how, |turn| turns.push(turn)).unwrap();
    let [of_scenes, of_squares] = [Turn::Scenes, Turn::Squares].map(|turn| vec![turn; how.frames]);
    assert_eq!(turns, [of_scenes, of_squares].concat());
    for about in ["frames", "filter", "background", "throughput"] {
        assert!(numbers.reasons.iter().any(|reason| reason.about == about), "nothing about {about}");
    }
    let name = renderer.context().renderer.clone();
    let first = &numbers.reasons[0].sentence;
    assert!(first.contains(&name), "{first}");
    assert_eq!(first.contains("a program"), is_software(&name), "{first}");
    // The bust is nearer, larger, and covers more.
    let covered: Vec<f64> = numbers.backgrounds.iter().map(|row| row.covered).collect();
    assert!(covered.is_sorted_by(|near, far| near > far), "{covered:?}");
}
