//! The page of public reports names a test in each row, and the test is there. Tables of figures have the columns and rows that the
//! commands beside them print.

use crate::support::root;

/// The most rows that a reader goes through.
const MOST: usize = 60;

#[test]
fn every_report_names_a_test_that_is_there() {
    let page = std::fs::read_to_string(root().join("docs/results/reports.md")).unwrap();
    // | [owner/name #number](address) | the fault | tinta's value | `file::function` |
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| [")).collect();
    assert!((20..=MOST).contains(&rows.len()), "{} rows", rows.len());
    for row in rows {
        let cells: Vec<&str> = row.trim_start_matches("| ").trim_end_matches(" |").split(" | ").collect();
        assert_eq!(cells.len(), 4, "{row}");
        assert!(cells[0].contains(" #") && cells[0].contains("](https://github.com/"), "{row}");
        let (file, function) = cells[3].trim_matches('`').split_once("::").expect(row);
        let source = std::fs::read_to_string(root().join(file)).expect(row);
        let (rust, python) = (format!("fn {function}("), format!("def {function}("));
        let is_there = source.lines().zip(source.lines().skip(1)).any(|(above, line)| {
            let line = line.trim_start();
            above.trim_start() == "#[test]" && line.starts_with(&rust) || line.starts_with(&python)
        });
        assert!(is_there, "{file} has no test {function}");
    }
}

#[test]
fn the_league_begins_with_figures_of_its_rows() {
    let page = std::fs::read_to_string(root().join("docs/results/league.md")).unwrap();
    let start = page.split("\n## ").next().unwrap();
    for program in ["(tinta lines, nothing left out: the reference)", "Blender Line Art", "tinta lines"] {
        let row = page.lines().find_map(|line| line.strip_prefix(&format!("| {program} |"))).expect(program);
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let (f1, seconds) = (cells[1], format!("{} s", cells[7]));
        assert!(start.contains(f1) && start.contains(&seconds), "{program}: {f1} in {seconds}");
    }
    // 26 views of 2,000 points each, of each model in the table of the truth.
    let truth = page.split("<!-- truth: begin -->").nth(1).unwrap();
    let models = truth.lines().filter(|line| line.starts_with("| ") && line.contains('%')).count() - 1;
    let points = format!("{},000", models * 26 * 2);
    assert!(start.contains(&points), "{points} points");
}

#[test]
fn the_claims_are_a_record_with_its_date_and_no_command() {
    let page = std::fs::read_to_string(root().join("docs/texts/claims.md")).unwrap();
    assert!(page.contains("measured on 2026-11-26"));
    let commands: Vec<&str> = page.lines().filter(|line| line.starts_with("    ")).collect();
    assert!(commands.is_empty(), "the code that ran them is gone: {commands:?}");
}

/// A page of figures, the command beside them, the source that prints them, and some of the columns and rows of both.
const FIGURES: [(&str, &str, &str, &[&str]); 12] = [
    (
        "measuring.md",
        "tinta measure ant.ply",
        "crates/tinta-lab/src/report/columns.rs",
        &["F1", "recall", "precision", "of all ink"],
    ),
    (
        "measuring.md",
        "cargo bench --bench cartoon -- stanford-bunny.obj",
        "benches/cartoon.rs",
        &[
            "mrt --cull back",
            "inking --silhouette exact --cull back",
            "ink",
            "Panda3D",
            "VTK",
            "PyVista",
            "f3d",
            "Freestyle",
        ],
    ),
    (
        "measuring.md",
        "cargo bench --bench looks -- stanford-bunny.obj",
        "benches/looks.rs",
        &["default, png", "default, svg", "technical, svg", "lines, svg", "hatched, svg", "f3d"],
    ),
    (
        "measuring.md",
        "cargo bench --bench edges -- stanford-bunny.obj",
        "benches/edges.rs",
        &["edges + classes, one thread", "vtkFeatureEdges", "silhouette, one thread", "vtkPolyDataSilhouette"],
    ),
    (
        "measuring.md",
        "cargo bench --bench lines -- stanford-bunny.obj",
        "benches/lines.rs",
        &["tinta, lines", "Freestyle, lines", "Freestyle, process"],
    ),
    ("measuring.md", "cargo bench --bench batch", "benches/batch.rs", &["batch", "one process a picture"]),
    (
        "exactness.md",
        "cargo bench -p tinta-geometry --bench contours -- breaks",
        "crates/tinta-geometry/benches/contours.rs",
        &["model", "triangles", "exact", "smooth", "crossings", "cusps"],
    ),
    (
        "exactness.md",
        "cargo bench -p tinta-geometry --bench contours -- truth",
        "crates/tinta-geometry/benches/contours.rs",
        &["exact", "smooth", "sphere", "torus", "patch"],
    ),
    (
        "exactness.md",
        "cargo bench --bench lines_growth",
        "crates/tinta-geometry/tests/support/growth.rs",
        &["soup", "sticks", "book", "fan", "spokes", "twins", "waffle", "hair", "comb", "lattice", "confetti"],
    ),
    ("pruning.md", "cargo bench --bench performance", "benches/performance.rs", &["bust", "gear", "open box"]),
    (
        "league.md",
        "python benches/league/report.py league",
        "benches/league/report.py",
        &["program", "version", "F1", "worst", "found", "of the ink right", "one to one, 1 px", "hidden drawn", "MiB"],
    ),
    ("league.md", "python benches/league/truth.py", "benches/league/truth.py", &["model", "f64", "embree"]),
];

#[test]
fn tables_have_the_columns_and_rows_that_the_commands_beside_them_print() {
    for (page, command, source, labels) in FIGURES {
        let text = std::fs::read_to_string(root().join("docs/results").join(page)).unwrap().replace('`', "");
        assert!(text.contains(command), "{page} has no {command:?}");
        let tables = text.lines().filter(|line| line.starts_with('|')).collect::<String>().to_lowercase();
        let source_text = std::fs::read_to_string(root().join(source)).unwrap().to_lowercase();
        for label in labels {
            let label = label.to_lowercase();
            assert!(tables.contains(&label), "{page} has no column or row {label:?}");
            assert!(source_text.contains(&label), "{source} prints no {label:?}, which {page} has");
        }
    }
}
