//! Stiff and extreme cases end as they must, on both backends; and would not, if something were wrong.

use crate::support::{BACKENDS, backend_names, full_sizes, root, skip};
use std::collections::BTreeMap;
use std::process::Command;
use std::sync::OnceLock;
use tinta::Backend;
use tinta_lab::stress::{Group, Row, StressSettings, Summary, run};

/// One case of each kind, carried out once for all quick tests, except turns, each of which takes half a minute.
/// `lines_invariance.rs` draws exact lines in other sizes.
fn few() -> &'static Summary {
    static SUMMARY: OnceLock<Summary> = OnceLock::new();
    SUMMARY.get_or_init(|| {
        let names = [
            "steps in depth, far 1e3 times as far as near",
            "the eye in the plane of a face",
            "a cube 1e58 times as large",
            "T-junctions",
            "tone thresholds in reverse",
            "3x5 pixels",
            "mix 1 of seed",
            "a header that promises four billion vertices",
            "a context lost while drawing",
        ];
        let only = |name: &str| {
            let settings = StressSettings { only: Some(name.to_owned()), ..StressSettings::default() };
            run(&settings, |_, _| {}).unwrap_or_else(|error| panic!("{name}: {error}"))
        };
        let joined = |mut all: Summary, one: Summary| {
            all.case_count += one.case_count;
            all.cases.extend(one.cases);
            all
        };
        names.into_iter().map(only).reduce(joined).unwrap()
    })
}

fn check_ends(summary: &Summary, at_least: usize, backends: usize) {
    let failures: Vec<String> = summary
        .failures()
        .map(|row| format!("{}, {}, {}: {} {:?}", row.name, row.style, row.backend, row.verdict, row.remark))
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(summary.case_count >= at_least, "{} cases", summary.case_count);
    // No case was left out silently: each has as many rows by every backend.
    let mut rows: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for row in &summary.cases {
        if row.group == Group::Files {
            rows.entry(&row.name).or_default().iter_mut().for_each(|count| *count += 1);
            continue;
        }
        let backend = backend_names().iter().position(|backend| *backend == row.backend);
        rows.entry(&row.name).or_default()[backend.unwrap_or_else(|| panic!("{row:?}"))] += 1;
    }
    assert_eq!(rows.len(), summary.case_count);
    rows.iter().for_each(|(name, rows)| {
        assert!(rows[..backends].iter().all(|count| *count == rows[0] && *count > 0), "{name}")
    });
}

#[test]
fn a_case_of_each_kind_ends_as_it_must_on_both_backends() {
    check_ends(few(), 9, 2);
}

fn check_compared(summary: &Summary) {
    let compared = |figure: &str| summary.cases.iter().filter(|row| row.figures.contains_key(figure)).count();
    let is_drawn = |row: &&Row| row.verdict == "rendered" && row.group != Group::Files;
    let rendered = summary.cases.iter().filter(is_drawn).count();
    assert_eq!(compared("pruned_differing_px"), rendered);
    // All by the second backend. OSMesa's largest pictures are larger than EGL's and are not compared.
    let second = summary.cases.iter().filter(is_drawn).filter(|row| row.backend == backend_names()[1]).count();
    let sizes = ["the widest picture", "the highest picture", "one pixel wider", "one pixel higher"];
    let of_largest = |name: &str| sizes.contains(&name);
    let largest =
        summary.cases.iter().filter(is_drawn).filter(|row| row.backend == backend_names()[1] && of_largest(&row.name));
    let not_compared = if backend_names()[1] == "osmesa" { largest.count() } else { 0 };
    assert_eq!(compared("backends_differing_px"), second - not_compared);
}

#[test]
fn pictures_of_a_few_cases_are_compared_between_backends_and_against_the_whole_plan() {
    check_compared(few());
}

#[test]
fn the_default_look_draws_the_exact_lines_of_a_few_cases() {
    let looks = few().cases.iter().filter(|row| row.style == "print");
    let scores: Vec<f64> = looks.filter_map(|row| row.figures.get("f1").copied()).collect();
    assert!(scores.len() >= 3 && scores.iter().all(|f1| *f1 > 0.98), "{scores:?}");
}

fn check_jitter(summary: &Summary, least_rows: usize, least_flips: f64) {
    let (mut flipped, mut edges_rows) = (0.0, 0);
    for row in summary.cases.iter().filter(|row| row.figures.contains_key("edges_flipped")) {
        assert_eq!(row.figures["edges_flipped_unexplained"], 0.0, "{}", row.name);
        flipped += row.figures["edges_flipped"];
        edges_rows += 1;
    }
    assert!(
        edges_rows > least_rows && flipped >= least_flips,
        "{edges_rows} rows, {flipped} flips: too few to have shown anything"
    );
}

#[test]
fn no_edge_of_a_few_cases_flips_under_jitter_unless_its_predicate_changes_its_sign() {
    check_jitter(few(), 20, 0.0);
}

/// The mean of one figure less another over the turns of a style, of at least so many rows.
fn excess(summary: &Summary, least_rows: usize, style: &str, figure: &'static str, less: &'static str) -> f64 {
    let turns = summary.cases.iter().filter(|row| row.style == style && row.group == Group::Turns);
    let rows = turns.filter_map(|row| Some((row.figures.get(figure)?, row.figures.get(less)?)));
    let differences: Vec<f64> = rows.map(|(figure, less)| figure - less).collect();
    assert!(differences.len() >= least_rows, "{style} has {} rows with {figure}", differences.len());
    differences.iter().sum::<f64>() / differences.len() as f64
}

fn check_flicker(summary: &Summary, least_rows: usize) {
    let ink = |style| excess(summary, least_rows, style, "turn_ink", "turn_lines");
    let published = ink("three-pass");
    let mended = [
        ink("ink"),
        ink("inking --silhouette exact"),
        ink("three-pass --map-encoding float --slope-threshold on --detection-factor 1"),
    ];
    mended.iter().for_each(|mended| assert!(*mended < published / 2.0, "{mended} of published {published}"));
    let shades = |style| excess(summary, least_rows, style, "turn_shades", "turn_exact_shades");
    let [published, mended] = [shades("charcoal"), shades("charcoal --improve all")];
    assert!(mended < published / 2.0, "{mended} of published {published}");
}

fn check_depth(summary: &Summary, ratios: &[&str]) {
    let f1 = |case: &str, style: &str| {
        let is_it = |row: &&Row| row.name == case && row.style == style && row.figures.contains_key("f1");
        summary.cases.iter().find(is_it).unwrap_or_else(|| panic!("{case}, {style}")).figures["f1"]
    };
    let by = |encoding: &str| format!("three-pass --detection-factor 1 --slope-threshold on --map-encoding {encoding}");
    for ratio in ratios {
        let case = format!("steps in depth, far {ratio} times as far as near");
        assert_eq!(f1(&case, &by("paper")), 0.0, "{case}");
        for style in [by("float").as_str(), by("depth-texture").as_str(), "ink", "inking --silhouette exact"] {
            assert!(f1(&case, style) > 0.99, "{case}, {style}: {}", f1(&case, style));
        }
    }
}

#[test]
fn deeper_maps_hold_where_eight_bits_have_lost_the_steps_of_one_range() {
    check_depth(few(), &["1e3"]);
}

fn check_ink(summary: &Summary, least_broken: usize) {
    let mut broken = 0;
    for row in summary.cases.iter().filter(|row| row.style == "three-pass" && row.group == Group::Depth) {
        // A model of less than a pixel has lines of less than a pixel.
        if row.figures.get("lines_px").is_none_or(|length| *length < 50.0) {
            continue;
        }
        let Some(published) = row.figures.get("f1").filter(|f1| **f1 < 0.3) else { continue };
        let is_ink = |other: &&Row| other.name == row.name && other.style == "ink" && other.figures.contains_key("f1");
        let ink = summary.cases.iter().find(is_ink).map(|row| row.figures["f1"]).unwrap();
        assert!(ink > 0.9, "{}: {published} as published, {ink} mended", row.name);
        broken += 1;
    }
    assert!(broken >= least_broken, "{broken} cases break the published passes");
}

#[test]
fn ink_holds_where_the_published_passes_break_in_the_plane_of_a_face() {
    check_ink(few(), 1);
}

fn check_scale(summary: &Summary) {
    let scaled = summary.cases.iter().filter(|row| row.group == Group::Scale && row.name.starts_with("a gear"));
    let mut count = 0;
    for row in scaled.filter(|row| row.name.ends_with("times as large")) {
        assert_eq!(row.figures["twin_lines_differing"], 0.0, "{}", row.name);
        count += 1;
    }
    assert!(count > 0);
}

/// In one test, because others would wait for all cases.
#[test]
#[ignore = "exhaustive: all cases of tinta stress, with TINTA_FULL_SIZES by both backends"]
fn all_cases_hold_what_one_of_each_kind_does_and_more() {
    let backends = if full_sizes() { BACKENDS.to_vec() } else { vec![BACKENDS[0]] };
    let settings = StressSettings { backends: backends.clone(), ..StressSettings::default() };
    let all = run(&settings, |_, _| {}).unwrap_or_else(|error| panic!("{error}"));
    check_ends(&all, 60, backends.len());
    check_compared(&all);
    check_jitter(&all, 300, 100.0);
    check_flicker(&all, 4);
    check_depth(&all, &["1e2", "1e3", "1e4"]);
    check_ink(&all, 5);
    check_scale(&all);
}

#[test]
fn the_command_writes_its_rows_and_says_how_it_went() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let output =
            Command::new(env!("CARGO_BIN_EXE_tinta")).arg("stress").args(arguments).current_dir(&folder).output();
        let output = output.unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, out, _) = run(&["-o", "out", "--only", "T-junctions"]);
    assert_eq!(code, Some(0), "{out}");
    assert!(out.starts_with("1 cases, 26 pictures and refusals: 26 as they must be, 0 not"), "{out}");
    let json: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("out/stress.json")).unwrap()).unwrap();
    let rows = json["cases"].as_array().unwrap();
    assert_eq!(rows.len(), 26);
    for key in ["name", "group", "style", "backend", "verdict", "expected", "figures"] {
        rows.iter().for_each(|row| assert!(!row[key].is_null(), "{key}"));
    }
    let table = std::fs::read_to_string(folder.path().join("out/stress.md")).unwrap();
    assert_eq!(table.lines().filter(|line| line.contains("T-junctions")).count(), 26);
    let (code, _, message) = run(&["-o", "out", "--only", "no such case"]);
    assert_eq!(code, Some(2));
    assert!(message.contains("--only no such case: no case has this in its name"), "{message}");
}

#[test]
fn a_backend_that_is_not_there_is_an_error_and_no_failed_case() {
    let settings = StressSettings {
        only: Some("one triangle".to_owned()),
        backends: vec![Backend::Egl],
        ..StressSettings::default()
    };
    let alone = run(&settings, |_, _| {}).unwrap();
    assert!(alone.cases.iter().all(|row| row.passed && row.backend == "egl"));
    assert!(root().join("docs/results/stability.md").is_file());
}

#[test]
fn cases_are_tried_without_a_backend_that_is_not_there_and_that_is_said() {
    if BACKENDS[1] != Backend::OsMesa {
        // Without OSMesa both backends are EGL's and both are missing.
        return skip("a missing backend: there is no OSMesa to go on with");
    }
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let output = Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(["stress", "--only", "tone thresholds that", "-o"])
        .arg(&out)
        .env("__EGL_VENDOR_LIBRARY_DIRS", folder.path())
        .env_remove("__EGL_VENDOR_LIBRARY_FILENAMES")
        .current_dir(root())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("tinta: egl is missing (EGL: no devices") && said.contains("no two backends"), "{said}");
    let json = std::fs::read_to_string(out.join("stress.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(record["missing"][0]["backend"], "egl");
    let rows = record["cases"].as_array().unwrap();
    assert!(!rows.is_empty() && rows.iter().all(|row| row["backend"] == "osmesa" && row["passed"] == true), "{json}");
    assert!(std::fs::read_to_string(out.join("stress.md")).unwrap().contains("Without egl, which is not available"));
}
