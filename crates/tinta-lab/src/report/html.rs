//! The report as one self-contained page: plots, pictures, a sortable table, the meaning of every column.
//!
//! It is HTML and well-formed XML, checkable by an XML parser, and it forbids itself the network. Without scripts everything is
//! shown; `page.js` hides unchosen rows and sorts.

use super::answer::{answer, budgets};
use super::columns::{Column, Value, columns};
use super::convergence::{curves, plot as convergence_plot, surfaces};
use super::frame::Shape;
use super::info::ReportInfo;
use super::plot::{plot, subtitle};
use super::ratios::ratios;
use super::settings::{Clock, Machine, Measure, Point, Points, machines, model_names, models, points};
use crate::measure::{Against, Row};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use tinta::error::Result;
use tinta::page::{Pictures, beginning};
use tinta_geometry::markup::escaped;

const SCRIPT: &str = include_str!("page.js");

/// The page of these rows.
///
/// # Errors
///
/// [`tinta::Error::File`] should a plot not be drawn.
pub fn html(rows: &[Row], info: &ReportInfo) -> Result<String> {
    let machines = machines(rows);
    let all: Vec<&Row> = rows.iter().collect();
    let models = models(&all);
    let mut page = beginning("Error and run time - tinta measure", Pictures::Within);
    page.push_str(&heading(rows, &models, &machines));
    page.push_str("<main>\n");
    page.push_str(&choices(rows, &models, &machines));
    page.push_str(&plots(rows, &models, &machines)?);
    page.push_str(&convergence(&machines)?);
    page.push_str(&machine_table(&machines));
    page.push_str(&pictures(info, &models));
    page.push_str(&row_table(rows, &machines));
    page.push_str(&run(rows, info, &machines));
    page.push_str(&meanings());
    page.push_str("</main>\n<script>\n/*<![CDATA[*/\n");
    page.push_str(SCRIPT);
    page.push_str("/*]]>*/\n</script>\n</body>\n</html>\n");
    Ok(page)
}

/// "1 model", "3 models".
pub(crate) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

fn distinct<'a>(rows: &'a [Row], value: impl Fn(&'a Row) -> &'a str) -> BTreeSet<&'a str> {
    rows.iter().map(value).collect()
}

fn heading(rows: &[Row], models: &[&str], machines: &[Machine<'_>]) -> String {
    let settings = rows.iter().map(|row| (&row.style, &row.options, row.size)).collect::<BTreeSet<_>>().len();
    let machine = match machines {
        [one] => format!("measured on {}", escaped(&one.name)),
        _ => format!("measured on {}", counted(machines.len(), "machine")),
    };
    let is_smooth = |row: &Row| row.lines.as_ref().is_some_and(|lines| lines.against == Against::Smooth);
    let reference = match rows.iter().any(is_smooth) {
        true => "the visible contour of smooth surfaces in closed form",
        false => "the exact visible lines",
    };
    format!(
        "<header>\n<h1>Error and run time</h1>\n{}<p>{} on {}, {machine}. Lines are compared with {reference}, \
         tones with rays cast in double precision.</p>\n<nav aria-label=\"Sections\">{}</nav>\n</header>\n",
        answers(machines),
        counted(settings, "setting"),
        counted(models.len(), "model"),
        [("plots", "Plots"), ("rows", "Table"), ("run", "Machine and command"), ("columns", "What the columns mean")]
            .map(|(id, name)| format!("<a href=\"#{id}\">{name}</a>"))
            .join(" "),
    )
}

/// The answer for each machine, in a sentence or two.
fn answers(machines: &[Machine<'_>]) -> String {
    let mut text = String::new();
    for machine in machines {
        let Some(answer) = answer(&points(&machine.rows, Measure::Lines)) else { continue };
        let place = if machines.len() > 1 { format!("On {}: ", machine.name) } else { String::new() };
        let _ = writeln!(text, "<p class=\"answer\">{}</p>", escaped(&format!("{place}{answer}")));
    }
    text
}

/// The choices of models, styles and machines.
fn choices(rows: &[Row], models: &[&str], machines: &[Machine<'_>]) -> String {
    let as_they_are = BTreeMap::new();
    let select = |id: &str, label: &str, all: &str, names: &[&str], shown: &BTreeMap<&str, String>| {
        if names.len() < 2 {
            return String::new();
        }
        let option = |name: &&str| {
            let shown = shown.get(name).map_or(*name, String::as_str);
            format!("<option value=\"{}\">{}</option>", escaped(name), escaped(shown))
        };
        let options: String = names.iter().map(option).collect();
        format!(
            "<label>{label} <select id=\"choose-{id}\"><option value=\"\">{all}</option>{options}</select></label>\n"
        )
    };
    let styles: Vec<&str> = distinct(rows, |row| &row.style).into_iter().collect();
    let machines: Vec<&str> = machines.iter().map(|machine| machine.name.as_str()).collect();
    format!(
        "<form class=\"choices\" hidden=\"hidden\">\n{}{}{}</form>\n",
        select("model", "Model", "all, plots of their mean", models, &model_names(models.iter().copied())),
        select("style", "Style, table only", "all", &styles, &as_they_are),
        select("machine", "Machine", "all", &machines, &as_they_are),
    )
}

fn plots(rows: &[Row], models: &[&str], machines: &[Machine<'_>]) -> Result<String> {
    let mut text =
        "<section id=\"plots\">\n<h2>Error against run time</h2>\n<p>A mark is a setting; the lower and the \
                    farther left, the better. Both axes are logarithmic. Bars are quartiles: of a frame's time, and of the models' errors.</p>\n<div class=\"plots\">\n"
            .to_owned();
    for machine in machines {
        for model in std::iter::once(None).chain(models.iter().copied().filter(|_| models.len() > 1).map(Some)) {
            let of_model = machine.rows.iter().copied().filter(|row| model.is_none_or(|model| row.model == model));
            let shown = Machine { name: machine.name.clone(), rows: of_model.collect() };
            for (_, measure) in Measure::ALL {
                let points = points(&shown.rows, measure);
                let subtitle = subtitle(&shown, measure);
                let of_shape = |shape| plot(&points, measure, shape, &subtitle);
                if let (Some(wide), Some(narrow)) = (of_shape(Shape::Wide)?, of_shape(Shape::Narrow)?) {
                    let _ = write!(
                        text,
                        "<figure class=\"plot\" data-model=\"{}\" data-machine=\"{}\">\n<div class=\"wide\">{wide}</div>\n\
                         <div class=\"narrow\">{narrow}</div>\n{}</figure>\n",
                        escaped(model.unwrap_or_default()),
                        escaped(&machine.name),
                        if measure == Measure::Lines {
                            best_for_each_time(&points, &shown, rows)
                        } else {
                            String::new()
                        },
                    );
                }
            }
        }
    }
    text.push_str("</div>\n</section>\n");
    Ok(text)
}

/// The settings on the front, below their plot; each links its rows in the table, to be cited.
fn best_for_each_time(points: &Points, machine: &Machine<'_>, rows: &[Row]) -> String {
    let entry = |(point, sentence): (&Point, String)| {
        let is_its = |row: &Row| {
            (&row.style, &row.options, row.size) == (&point.style, &point.options, point.size)
                && points.models.contains(&row.model)
                && machine.rows.iter().any(|other| std::ptr::eq(*other, row))
        };
        let numbers = (1..).zip(rows).filter(|(_, row)| is_its(row));
        let links: Vec<String> = numbers.map(|(number, _)| format!("<a href=\"#row-{number}\">{number}</a>")).collect();
        let what = if links.len() == 1 { "row" } else { "rows" };
        format!("<li>{}; {what} {}</li>\n", escaped(&sentence), links.join(", "))
    };
    let entries: String = budgets(points).into_iter().map(entry).collect();
    format!("<details><summary>The best for each time, to cite</summary>\n<ul>\n{entries}</ul>\n</details>\n")
}

/// Error against the number of triangles; empty unless a surface was measured with several meshes.
fn convergence(machines: &[Machine<'_>]) -> Result<String> {
    let curves = machines.first().map(|machine| curves(&machine.rows)).unwrap_or_default();
    if curves.is_empty() {
        return Ok(String::new());
    }
    let mut text = "<section id=\"convergence\">\n<h2>Convergence</h2>\n<p>Error is the larger of two mean distances, from ink to \
                    the surface's true contour and from that to ink; the order is that in edge length. Ink has a width and lies \
                    on pixels, which no mesh makes finer.</p>\n<div class=\"plots\">\n"
        .to_owned();
    for surface in surfaces(&curves) {
        let [wide, narrow] = [Shape::Wide, Shape::Narrow].map(|shape| convergence_plot(&curves, surface, shape));
        let _ = write!(
            text,
            "<figure class=\"plot\">\n<div class=\"wide\">{}</div>\n<div class=\"narrow\">{}</div>\n</figure>\n",
            wide?, narrow?
        );
    }
    text.push_str("</div>\n</section>\n");
    Ok(text)
}

/// A cell of a table: its text and, for a number, its sort key.
struct Cell {
    text: String,
    number: Option<f64>,
    is_code: bool,
}

/// The title, meaning and kind of a table's column.
struct Head<'a> {
    title: &'a str,
    meaning: &'a str,
    is_number: bool,
    is_main: bool,
}

/// A table that scrolls within itself; `rows` are attributes and cells.
fn table(name: &str, heads: &[Head<'_>], rows: impl Iterator<Item = (String, Vec<Cell>)>) -> String {
    let class = |head: &Head<'_>| match (head.is_number, head.is_main) {
        (true, true) => " class=\"number\"",
        (true, false) => " class=\"number more\"",
        (false, true) => "",
        (false, false) => " class=\"more\"",
    };
    let mut text =
        format!("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{name}\">\n<table>\n<thead><tr>");
    for head in heads {
        let _ = write!(
            text,
            "<th scope=\"col\" aria-sort=\"none\"{} title=\"{}\"><button type=\"button\">{}</button></th>",
            class(head),
            escaped(head.meaning),
            escaped(head.title),
        );
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for (attributes, cells) in rows {
        let _ = write!(text, "<tr{attributes}>");
        for (head, cell) in heads.iter().zip(cells) {
            let value = cell.number.map(|number| format!(" data-value=\"{number}\"")).unwrap_or_default();
            let shown = if cell.is_code { options(&cell.text) } else { escaped(&cell.text) };
            let _ = write!(text, "<td{}{value}>{shown}</td>", class(head));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody>\n</table>\n</div>\n");
    text
}

/// Options that break between one another only, not at their hyphens.
fn options(text: &str) -> String {
    let parts: Vec<String> = text.split(" --").map(|part| format!("<span>{}</span>", escaped(part))).collect();
    format!("<code>{}</code>", parts.join(" <span>--").replace("<span>--<span>", "<span>--"))
}

/// Times on every machine side by side; empty for one machine.
fn machine_table(machines: &[Machine<'_>]) -> String {
    if machines.len() < 2 {
        return String::new();
    }
    let time = |machine: &Machine<'_>| format!("{}, ms by {}", machine.name, Clock::of(&machine.rows).name());
    let times: Vec<String> = machines.iter().map(time).collect();
    let factors: Vec<String> =
        machines[1..].iter().map(|machine| format!("{}, times the first", machine.name)).collect();
    let head = |title, meaning, is_number| Head { title, meaning, is_number, is_main: true };
    let mut heads = vec![
        head("Setting", "The style and its differences from other settings.", false),
        head("Models", "Models measured on all of these machines.", true),
    ];
    heads.extend(times.iter().map(|title| head(title, "Geometric mean over those models of the median time.", true)));
    heads.extend(factors.iter().map(|title| head(title, "That time over the first machine's.", true)));
    let number = |number: Option<f64>, decimals: usize| Cell {
        text: number.map(|number| format!("{number:.decimals$}")).unwrap_or_default(),
        number,
        is_code: false,
    };
    let rows = ratios(machines).into_iter().map(|ratio| {
        let mut cells =
            vec![Cell { text: ratio.name.clone(), number: None, is_code: false }, number(Some(ratio.models as f64), 0)];
        cells.extend(ratio.times_ms.iter().map(|time| number(*time, 2)));
        cells.extend((1..machines.len()).map(|machine| number(ratio.to_first(machine), 2)));
        (String::new(), cells)
    });
    format!(
        "<section id=\"machines\">\n<h2>Machines compared</h2>\n{}</section>\n",
        table("Times on the machines", &heads, rows)
    )
}

fn pictures(info: &ReportInfo, models: &[&str]) -> String {
    if info.pictures.is_empty() {
        return String::new();
    }
    let mut text =
        "<section id=\"pictures\">\n<h2>Drawings and their errors</h2>\n<p>Beside each drawing its lines: black is ink on a line, red a line without ink, blue ink without a line, grey ink that does not count (soft creases). Shown are each style's published settings and the best. Press a picture to see it in full size.</p>\n\
                    <div class=\"pictures\">\n"
            .to_owned();
    let names = model_names(models.iter().copied());
    for picture in &info.pictures {
        let model = picture.model.as_deref().and_then(|model| names.get(model));
        let caption = escaped(&model.into_iter().chain([&picture.caption]).cloned().collect::<Vec<_>>().join(", "));
        let img = |what: &str, png: &Vec<u8>| {
            let source = BASE64_STANDARD.encode(png);
            format!("<img alt=\"{what} {caption}\" src=\"data:image/png;base64,{source}\"/>")
        };
        let drawing = picture.drawing.as_ref().map(|png| img("drawing:", png)).unwrap_or_default();
        let _ = writeln!(
            text,
            "<figure data-model=\"{}\"><button type=\"button\" class=\"picture\" aria-pressed=\"false\">{drawing}{}\
             </button><figcaption>{caption}</figcaption></figure>",
            escaped(picture.model.as_deref().unwrap_or_default()),
            img("errors:", &picture.png),
        );
    }
    text.push_str("</div>\n</section>\n");
    text
}

fn row_table(rows: &[Row], machines: &[Machine<'_>]) -> String {
    let columns = columns();
    let names = model_names(rows.iter().map(|row| row.model.as_str()));
    // Only columns that differ are informative.
    let differs = |column: &Column| {
        let mut values = rows.iter().map(|row| column.value(row));
        let first = values.next();
        values.any(|value| Some(value) != first)
    };
    let is_missing = |column: &Column| rows.iter().all(|row| column.value(row) == Value::Missing);
    let is_number = |column: &Column| rows.iter().any(|row| matches!(column.value(row), Value::Number(_)));
    let number = Head { title: "Row", meaning: "The row's number, to cite.", is_number: true, is_main: true };
    let heads = std::iter::once(number).chain(columns.iter().map(|column| Head {
        title: &column.title,
        meaning: &column.meaning,
        is_number: is_number(column),
        is_main: (column.is_main && !is_missing(column))
            || (machines.len() > 1 && column.name == "machine")
            || (column.name == "width_px" && differs(column)),
    }));
    let heads: Vec<Head<'_>> = heads.collect();
    let cell = |column: &Column, row: &Row| match column.value(row) {
        Value::Text(text) if column.name == "model" => {
            Cell { text: names.get(&*text).cloned().unwrap_or(text), number: None, is_code: false }
        }
        Value::Text(text) => Cell { text, number: None, is_code: column.name == "options" },
        Value::Number(number) => {
            Cell { text: format!("{number:.*}", column.decimals), number: Some(number), is_code: false }
        }
        Value::Missing => Cell { text: String::new(), number: None, is_code: false },
    };
    let table_rows = (1..).zip(rows).map(|(number, row)| {
        let names: Vec<&str> = machines
            .iter()
            .filter(|machine| machine.rows.iter().any(|other| std::ptr::eq(*other, row)))
            .map(|machine| machine.name.as_str())
            .collect();
        let attributes = format!(
            " id=\"row-{number}\" data-model=\"{}\" data-style=\"{}\" data-machine=\"{}\"",
            escaped(&row.model),
            escaped(&row.style),
            // A row without GL belongs to every renderer of its machine.
            escaped(if names.len() == 1 { names[0] } else { "" }),
        );
        let number = Cell { text: number.to_string(), number: Some(f64::from(number)), is_code: false };
        (attributes, std::iter::once(number).chain(columns.iter().map(|column| cell(column, row))).collect())
    });
    format!(
        "<section id=\"rows\">\n<h2>All settings</h2>\n<p class=\"table-line\"><span id=\"count\" role=\"status\">{} rows</span> \
         <label id=\"all-columns\" hidden=\"hidden\"><input type=\"checkbox\"/> all {} columns</label></p>\n{}</section>\n",
        rows.len(),
        columns.len(),
        table("All settings", &heads, table_rows),
    )
}

fn run(rows: &[Row], info: &ReportInfo, machines: &[Machine<'_>]) -> String {
    let mut entries: Vec<(String, String)> =
        vec![("Command".to_owned(), format!("<code>{}</code>", escaped(&info.command)))];
    entries.push(("Version".to_owned(), format!("tinta {}", env!("CARGO_PKG_VERSION"))));
    for machine in machines {
        let renderers = machine.rows.iter().map(|row| row.renderer.as_str()).filter(|renderer| *renderer != "none");
        let renderers: BTreeSet<&str> = renderers.filter(|renderer| !machine.name.ends_with(renderer)).collect();
        let renderer = renderers.into_iter().map(|name| format!("; renderer {name}")).collect::<String>();
        entries.push(("Machine".to_owned(), escaped(&format!("{}{renderer}", machine.name))));
    }
    let processors: BTreeSet<(&str, &str, &str)> = rows
        .iter()
        .map(|row| (&*row.conditions.processor, &*row.gl_version, &*row.conditions.commit))
        .filter(|it| it != &("", "", ""))
        .collect();
    for (processor, gl_version, commit) in processors {
        let facts = [processor, &format!("OpenGL {gl_version}"), &format!("commit {commit}")];
        entries.push(("Processor, driver, commit".to_owned(), escaped(&facts.join("; "))));
    }
    let models = distinct(rows, |row| &row.model).into_iter().map(escaped).collect::<Vec<_>>().join(", ");
    entries.push(("Models".to_owned(), models));
    entries.push((
        "Raw values".to_owned(),
        "results.jsonl beside this page: every row with the time of every frame; \
        results.csv: this table with all digits."
            .to_owned(),
    ));
    format!("<section id=\"run\">\n<h2>Machine and command</h2>\n{}</section>\n", definitions(entries.into_iter()))
}

fn meanings() -> String {
    let columns = columns();
    let entries = columns.iter().map(|column| {
        let name = format!("{} <code>{}</code>", escaped(&column.title), escaped(&column.name));
        (name, escaped(&column.meaning))
    });
    format!(
        "<section id=\"columns\">\n<h2>Meaning of the columns</h2>\n<p>The second name is the column's in results.csv.</p>\n\
         {}</section>\n",
        definitions(entries)
    )
}

/// A list of names with descriptions, both HTML already.
fn definitions(entries: impl Iterator<Item = (String, String)>) -> String {
    let entries: String =
        entries.map(|(name, value)| format!("<div><dt>{name}</dt><dd>{value}</dd></div>\n")).collect();
    format!("<dl>\n{entries}</dl>\n")
}
