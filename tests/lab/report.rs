//! Reports on made-up rows: written rows are read back, an interruption loses none, plots hold their points.

use image::{ImageFormat, Rgb, RgbImage};
use roxmltree::Document;
use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use tinta_lab::measure::{Conditions, LineError, PassRow, Row, RunTime, ToneBorderError, ToneError};
use tinta_lab::report::{
    Measure, ROWS_FILE, ReportInfo, ReportPicture, RowLog, Shape, columns, csv, html, machines, pareto, plot, points,
    read_rows, write,
};

/// A name that breaks pages, tables and lines that do not quote it.
pub const NASTY: &str = "\"a\", <b>&amp;</b> '\u{1}' ]]> </script>, é\n.obj";

/// A row of a machine without tones.
pub fn row(machine: &str, model: &str, options: &str, median_ms: f64, f1: f64) -> Row {
    let style = options.split_whitespace().nth(1).unwrap().to_owned();
    let lines = LineError {
        against: tinta_lab::measure::Against::Lines,
        tolerance_px: 2.0,
        ink_from: 64,
        ignored_creases_degrees: [20.0, 66.4],
        reference_px: 4_321.25,
        ink_px: 4_000.5,
        recall: f1,
        precision: f1,
        precision_of_all: f1 * 0.9,
        f1,
        average_precision: f1 * 0.98,
        reference_to_ink_px: Some([0.4, 1.75]),
        ink_to_reference_px: None,
        recall_of_class: BTreeMap::from([("silhouette".to_owned(), 0.97), ("non-manifold".to_owned(), 1.0 / 3.0)]),
    };
    Row {
        version: "0.1.0".to_owned(),
        machine: machine.to_owned(),
        renderer: if style == "lines" { "none" } else { "llvmpipe (LLVM 15.0.6, 256 bits)" }.to_owned(),
        model: model.to_owned(),
        triangles: 69_451,
        size: [800, 600],
        gl_version: "2.1 Mesa 22.3.6".to_owned(),
        conditions: Conditions {
            date: "2026-11-28".to_owned(),
            commit: "0123456789ab".to_owned(),
            processor: "Processor <of> \"tests\"".to_owned(),
            load: Some(0.25),
        },
        is_faithful: options.split_whitespace().count() == 2,
        is_pruned: false,
        has_own_reference: style == "lines",
        style,
        options: options.to_owned(),
        lines: Some(lines),
        tones: None,
        time: RunTime {
            load_ms: 12.5,
            edges_ms: 3.25,
            plan_ms: 0.125,
            frames_ms: vec![median_ms, median_ms * 1.1, median_ms * 0.9],
            processor_ms: vec![median_ms * 1.5, median_ms * 1.7, median_ms * 1.4],
            median_ms,
            passes: vec![
                PassRow { name: "map".to_owned(), cpu_ms: median_ms / 2.0, gpu_ms: Some(median_ms / 3.0) },
                PassRow { name: "tones".to_owned(), cpu_ms: median_ms / 2.0, gpu_ms: None },
            ],
        },
    }
}

fn with_tones(mut row: Row, inner_differing: Option<f64>, mean_difference: f64) -> Row {
    row.tones = Some(ToneError {
        inner_px: 90_000,
        inner_differing,
        rim_px: 4_000,
        rim_differing: inner_differing.map(|share| (share * 20.0).min(1.0)),
        mean_difference,
        largest_difference: 89.25,
        borders: inner_differing
            .map(|_| ToneBorderError { exact_to_drawn_px: [0.25, 0.5], drawn_to_exact_px: [0.24, 0.47] }),
    });
    row
}

/// As many settings as in a real run, on three models.
pub fn made_up_rows(machine: &str, slowness: f64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, weight) in [("builtin:bust", 1.0), ("models/stanford-bunny.obj", 2.2), ("fandisk.obj", 1.3)] {
        let mut add = |options: &str, ms: f64, f1: f64, tone: Option<f64>| {
            let f1 = f1 - (weight - 1.0) * 0.04 * (1.0 - f1);
            let row = row(machine, model, options, ms * weight * slowness, f1);
            rows.push(match options.split_whitespace().nth(1) {
                Some("charcoal" | "phong") => {
                    let mut row = with_tones(row, None, 0.37 * ms);
                    row.lines = None;
                    row
                }
                _ => with_tones(row, tone, 0.02),
            });
        };
        add("--style phong", 2.1, 0.0, None);
        for (style, ms) in [("three-pass", 4.6), ("two-pass", 3.9)] {
            for (filter, factor, f1) in [
                ("", 1.0, 0.71),
                ("laplacian8", 1.25, 0.74),
                ("mitchell", 1.3, 0.7),
                ("sobel", 1.42, 0.78),
                ("roberts", 0.9, 0.66),
            ] {
                let filter = if filter.is_empty() { String::new() } else { format!(" --filter {filter}") };
                let f1 = if style == "two-pass" { f1 + 0.003 } else { f1 };
                add(&format!("--style {style}{filter}"), ms * factor, f1, Some(0.000_31));
                add(&format!("--style {style}{filter} --detection-factor 0.4"), ms * factor, f1 + 0.05, Some(0.000_31));
            }
            add(&format!("--style {style} --tones 2"), ms, 0.71, Some(0.000_12));
            add(&format!("--style {style} --tones tone-lookup=texture"), ms * 0.97, 0.71, Some(0.004_4));
        }
        add("--style inking", 2.9, 0.93, Some(0.0));
        add("--style inking --silhouette exact", 3.0, 0.972, Some(0.0));
        add("--style inking --silhouette exact --line-drawing quads", 3.4, 0.981, Some(0.0));
        add("--style inking --silhouette exact --ink-depth test", 3.1, 0.978, Some(0.0));
        add("--style dietrich", 2.4, 0.52, Some(0.02));
        add("--style charcoal", 7.7, 0.0, None);
        add("--style charcoal --contrast contrast-operator=none", 7.5, 0.0, None);
        add("--style lines", 61.0, 0.996, None);
    }
    rows
}

/// The description of a made-up run.
pub fn info() -> ReportInfo {
    let png = |color: [u8; 3]| {
        let mut png = Cursor::new(Vec::new());
        RgbImage::from_pixel(900, 400, Rgb(color)).write_to(&mut png, ImageFormat::Png).unwrap();
        png.into_inner()
    };
    let picture = |model: &str, color, drawing: Option<[u8; 3]>| ReportPicture {
        caption: format!("two-pass on {model}: agreed black, missed red, invented blue"),
        model: Some(model.to_owned()),
        drawing: drawing.map(png),
        png: png(color),
    };
    ReportInfo {
        command: "tinta measure builtin:bust models/stanford-bunny.obj fandisk.obj -o out --frames 3".to_owned(),
        pictures: vec![
            picture("builtin:bust", [230, 159, 0], None),
            picture("fandisk.obj", [0, 114, 178], Some([204, 121, 167])),
        ],
    }
}

fn rows_with_nasty_names() -> Vec<Row> {
    let mut rows = made_up_rows("a", 1.0);
    rows[3].model = NASTY.to_owned();
    rows[4].machine = NASTY.to_owned();
    rows[5].options = format!("--style two-pass --texture ramp={NASTY}");
    rows
}

#[test]
fn a_row_log_gives_back_the_rows_it_was_given() {
    let folder = tempfile::tempdir().unwrap();
    let rows = rows_with_nasty_names();
    let mut log = RowLog::create(folder.path()).unwrap();
    rows[..5].iter().for_each(|row| log.append(row).unwrap());
    drop(log);
    let again = RowLog::create(folder.path()).unwrap_err().to_string();
    assert!(again.contains(ROWS_FILE) && again.contains("--resume"), "{again}");
    let (mut log, read) = RowLog::resume(folder.path()).unwrap();
    assert_eq!(read, rows[..5]);
    rows[5..].iter().for_each(|row| log.append(row).unwrap());
    let path = folder.path().join(ROWS_FILE);
    assert_eq!(read_rows(&path).unwrap(), rows);
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().count(), rows.len(), "a line each");
    for line in text.lines() {
        assert!(serde_json::from_str::<serde_json::Value>(line).unwrap().is_object());
    }
}

#[test]
fn a_row_cut_off_by_an_interruption_is_dropped_and_the_others_kept() {
    let rows = made_up_rows("a", 1.0);
    let whole: Vec<String> = rows[..3].iter().map(|row| serde_json::to_string(row).unwrap()).collect();
    let last = &whole[2];
    for (rest, kept) in [(1, 2), (last.len() / 2, 2), (last.len() - 1, 2), (last.len(), 3)] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(ROWS_FILE);
        std::fs::write(&path, format!("{}\n{}\n{}", whole[0], whole[1], &last[..rest])).unwrap();
        assert_eq!(read_rows(&path).unwrap(), rows[..kept], "reading alone leaves it out too");
        let (mut log, read) = RowLog::resume(folder.path()).unwrap();
        assert_eq!(read, rows[..kept]);
        log.append(&rows[5]).unwrap();
        let mut expected = rows[..kept].to_vec();
        expected.push(rows[5].clone());
        assert_eq!(read_rows(&path).unwrap(), expected);
    }
    let empty = tempfile::tempdir().unwrap();
    assert!(RowLog::resume(empty.path()).unwrap().1.is_empty(), "resuming nothing begins");
}

#[test]
fn a_line_that_is_no_row_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.jsonl");
    let sound = serde_json::to_string(&made_up_rows("a", 1.0)[0]).unwrap();
    let mut file = std::fs::File::create(&path).unwrap();
    writeln!(file, "{sound}\n\n{{\"version\": 1}}\n{sound}").unwrap();
    let message = read_rows(&path).unwrap_err().to_string();
    assert!(message.contains("results.jsonl: line 3: this is not a row of this version"), "{message}");
    assert_eq!(message.lines().count(), 1);
    let missing = read_rows(&folder.path().join("none.jsonl")).unwrap_err().to_string();
    assert!(missing.contains("none.jsonl: there is no such file"), "{missing}");
}

#[test]
fn a_row_that_is_not_finite_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut log = RowLog::create(folder.path()).unwrap();
    for value in [f64::NAN, f64::INFINITY] {
        let tone = with_tones(made_up_rows("a", 1.0)[2].clone(), Some(value), 0.0);
        let time = row("a", "b", "--style inking", value, 0.5);
        for row in [tone, time] {
            let message = log.append(&row).unwrap_err().to_string();
            assert!(message.contains("not finite"), "{message}");
        }
    }
    assert_eq!(read_rows(&folder.path().join(ROWS_FILE)).unwrap(), []);
}

#[test]
fn the_csv_is_read_back_with_every_digit() {
    let rows = rows_with_nasty_names();
    let text = csv(&rows);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(header, columns().iter().map(|column| column.name.to_string()).collect::<Vec<_>>());
    assert_eq!(header[..4], ["model", "style", "options", "faithful"]);
    let place = |name: &str| header.iter().position(|column| column == name).unwrap();
    let lines: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(lines.len(), rows.len());
    for (line, row) in lines.iter().zip(&rows) {
        assert_eq!((&line[place("model")], &line[place("machine")]), (row.model.as_str(), row.machine.as_str()));
        assert_eq!(line[place("options")], row.options);
        assert_eq!(line[place("median_ms")].parse::<f64>().unwrap(), row.time.median_ms);
        assert_eq!(line[place("f1")].parse::<f64>().ok(), row.lines.as_ref().map(|lines| lines.f1));
        let class = row.lines.as_ref().map(|lines| lines.recall_of_class["non-manifold"]);
        assert_eq!(line[place("recall_non_manifold")].parse::<f64>().ok(), class);
        assert_eq!(&line[place("ink_to_reference_mean_px")], "", "none without ink");
        let share = row.tones.as_ref().and_then(|tones| tones.inner_differing);
        assert_eq!(line[place("tone_differing")].parse::<f64>().ok(), share);
    }
}

#[test]
fn every_column_is_named_once_and_says_what_it_means() {
    let mut names: Vec<String> = columns().iter().map(|column| column.name.to_string()).collect();
    assert!(columns().iter().all(|column| column.meaning.ends_with('.') && !column.title.is_empty()));
    names.sort();
    let count = names.len();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn the_pareto_front_holds_what_nothing_beats() {
    let points = [(1.0, 5.0), (2.0, 3.0), (2.0, 4.0), (3.0, 3.0), (4.0, 1.0), (4.0, 1.0), (9.0, f64::NAN), (0.5, 9.0)];
    assert_eq!(pareto(&points), [true, true, false, false, true, true, false, true]);
    assert_eq!(pareto(&[]), Vec::<bool>::new());
}

#[test]
fn a_point_is_the_mean_over_the_models_that_settings_share() {
    let rows = [
        row("m", "a", "--style inking --view front", 2.0, 0.9),
        row("m", "b", "--style inking --view front", 8.0, 0.7),
        row("m", "a", "--style two-pass --view front", 3.0, 0.5),
        row("m", "b", "--style two-pass --view front", 3.0, 0.5),
        row("m", "a", "--style two-pass --view front --filter sobel", 3.0, 0.5),
    ];
    let points = points(&rows.iter().collect::<Vec<_>>(), Measure::Lines);
    assert_eq!((points.left_out, &points.models[..]), (1, &["a".to_owned(), "b".to_owned()][..]));
    assert_eq!(points.points.len(), 2);
    let inking = &points.points[0];
    assert_eq!(inking.name, "inking", "what all share is left out");
    assert!(
        (inking.time_ms - 6.0).abs() < 1e-12 && (inking.times_ms[0] - 5.6).abs() < 1e-12,
        "processor time: {inking:?}"
    );
    assert!((inking.error - 0.2).abs() < 1e-12, "{inking:?}");
}

/// The page's answer and its axis, from rows whose first is the faster by the clock and the slower by processor time.
fn answered(rows: &[Row]) -> [String; 2] {
    let page = html(rows, &info()).unwrap();
    let between = |start: &str, end: &str| {
        let rest = page.split(start).nth(1).unwrap_or_else(|| panic!("{start}"));
        rest.split(end).next().unwrap().trim().to_owned()
    };
    [between("<p class=\"answer\">", "</p>"), between("time of a frame by ", ", ms (median)")]
}

#[test]
fn processor_time_decides_where_a_program_draws_and_the_clock_where_a_device_does() {
    let mut rows = [row("m", "a", "--style inking", 2.0, 0.9), row("m", "a", "--style two-pass", 3.0, 0.9)];
    rows[0].time.processor_ms = vec![5.0; 3];
    rows[1].time.processor_ms = vec![4.0; 3];
    let [answer, axis] = answered(&rows);
    assert!(answer.contains("two-pass (F1 0.900 in 4.00 ms a frame by processor time)"), "{answer}");
    assert_eq!(axis, "processor time");
    // The load of the machine doubles the clock's times of one of them.
    let mut loaded = rows.clone();
    loaded[1].time.frames_ms.iter_mut().for_each(|ms| *ms *= 2.0);
    loaded[1].time.median_ms *= 2.0;
    assert_eq!(answered(&loaded)[0], answer);
    // On a device the processor waits; where one row lacks processor time, the clock alone compares all.
    rows[0].time.processor_ms.clear();
    let [answer, axis] = answered(&rows);
    assert!(answer.contains("inking (F1 0.900 in 2.00 ms a frame by the clock)"), "{answer}");
    assert_eq!(axis, "the clock");
}

#[test]
fn the_table_of_machines_says_the_clock_of_each() {
    let mut rows = made_up_rows("a", 1.0);
    let mut device = made_up_rows("b", 0.5);
    device.iter_mut().for_each(|row| row.time.processor_ms.clear());
    rows.extend(device);
    let page = html(&rows, &info()).unwrap();
    assert!(page.contains("a, ms by processor time") && page.contains("b, ms by the clock"));
}

#[test]
fn the_renderers_of_a_machine_are_kept_apart_and_lines_belong_to_each() {
    let mut rows = made_up_rows("a", 1.0);
    assert_eq!(machines(&rows).len(), 1);
    let mut other = rows.clone();
    other.iter_mut().filter(|row| row.renderer != "none").for_each(|row| row.renderer = "softpipe".to_owned());
    other.retain(|row| row.renderer != "none");
    rows.extend(other);
    rows.extend(made_up_rows("b", 1.0));
    let names: Vec<String> = machines(&rows).into_iter().map(|machine| machine.name).collect();
    assert_eq!(names, ["a, llvmpipe (LLVM 15.0.6, 256 bits)", "a, softpipe", "b"]);
    let counts: Vec<usize> = machines(&rows).iter().map(|machine| machine.rows.len()).collect();
    assert_eq!(counts, [counts[2]; 3]);
}

#[test]
fn a_plot_names_its_front_and_holds_only_finite_numbers_inside_it() {
    let rows = made_up_rows("a machine", 1.0);
    let all: Vec<&Row> = rows.iter().collect();
    for (name, measure) in Measure::ALL {
        for shape in [Shape::Wide, Shape::Narrow] {
            let points = points(&all, measure);
            let svg = plot(&points, measure, shape, &format!("mean & {NASTY}")).unwrap().unwrap();
            let document = Document::parse(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
            let texts: Vec<&str> = document.descendants().filter_map(|node| node.text()).map(str::trim).collect();
            let front = pareto(&points.points.iter().map(|point| (point.time_ms, point.error)).collect::<Vec<_>>());
            let mut labelled = 0;
            for (point, _) in points.points.iter().zip(front).filter(|(_, is_on)| *is_on) {
                let is_same =
                    |other: &&tinta_lab::report::Point| (other.time_ms, other.error) == (point.time_ms, point.error);
                let names: Vec<&str> = points.points.iter().filter(is_same).map(|point| point.name.as_str()).collect();
                let words = |name: &&str| name.split(' ').next().unwrap().to_owned();
                let is_there = names.iter().any(|name| texts.iter().any(|text| text.starts_with(&words(name))));
                assert!(is_there, "{name} {shape:?}: {names:?} in {texts:?}");
                labelled += 1;
            }
            assert!(labelled > 0);
            let root = document.root_element();
            let number =
                |node: roxmltree::Node<'_, '_>, name| node.attribute(name).and_then(|text| text.parse::<f64>().ok());
            let (width, height) = (number(root, "width").unwrap(), number(root, "height").unwrap());
            for node in document.descendants().filter(|node| node.is_element()) {
                for (name, limit) in [("x", width), ("cx", width), ("y", height), ("cy", height)] {
                    let value = number(node, name).unwrap_or_default();
                    assert!((0.0..=limit).contains(&value), "{name} = {value} of {limit} in {:?}", node.tag_name());
                }
            }
        }
    }
    let none = points(&[], Measure::Lines);
    assert_eq!(plot(&none, Measure::Lines, Shape::Wide, "").unwrap(), None);
}

#[test]
fn an_exact_setting_is_drawn_at_zero() {
    let rows = [row("m", "a", "--style inking", 1.0, 1.0), row("m", "a", "--style two-pass", 2.0, 0.9)];
    for count in [1, 2] {
        let some: Vec<&Row> = rows[..count].iter().collect();
        let svg = plot(&points(&some, Measure::Lines), Measure::Lines, Shape::Wide, "").unwrap().unwrap();
        assert!(
            Document::parse(&svg).unwrap().descendants().any(|node| node.text().is_some_and(|text| text.trim() == "0"))
        );
    }
}

#[test]
fn a_report_is_three_kinds_of_file_and_nothing_beside_them() {
    let folder = tempfile::tempdir().unwrap();
    let files = |rows: &[Row]| {
        write(folder.path(), rows, &info()).unwrap();
        let names =
            std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    };
    let one = ["plot-continuous-tones.svg", "plot-lines.svg", "plot-tones.svg", "report.html", "results.csv"];
    assert_eq!(files(&made_up_rows("a", 1.0)), one);
    let mut two = made_up_rows("a", 1.0);
    two.extend(made_up_rows("b", 0.5));
    assert_eq!(files(&two).iter().filter(|name| name.contains("-machine-")).count(), 6);
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("Machines compared") && page.contains(">0.50<"), "times on b are half of those on a");
    assert!(write(folder.path(), &[], &info()).unwrap_err().to_string().contains("no row to report on"));
}

#[test]
fn the_page_is_well_formed_and_shows_nasty_names_as_they_are() {
    let rows = rows_with_nasty_names();
    let page = html(&rows, &info()).unwrap();
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = Document::parse_with_options(&page, options).unwrap();
    let shown = NASTY.replace('\u{1}', "\u{FFFD}");
    let holds = |tag: &str| {
        document
            .descendants()
            .any(|node| node.has_tag_name(("http://www.w3.org/1999/xhtml", tag)) && node.text() == Some(&shown))
    };
    assert!(["td", "option"].iter().all(|tag| holds(tag)));
    assert_eq!(page.matches("</script>").count(), 1, "nothing ends the script early");
    for outside in ["http://", "https://"] {
        let addresses = page.match_indices(outside).map(|(start, _)| &page[start..start + 18]);
        let others: Vec<&str> = addresses.filter(|address| !address.starts_with("http://www.w3.org/")).collect();
        assert!(others.is_empty(), "the page needs nothing from elsewhere: {others:?}");
    }
    let body = document.descendants().filter(|node| node.tag_name().name() == "tr" && node.has_attribute("data-style"));
    let cells: Vec<usize> = body.map(|row| row.children().filter(|cell| cell.is_element()).count()).collect();
    assert_eq!(cells, vec![1 + columns().len(); rows.len()]);
    let mut ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "ids are unique");
}
