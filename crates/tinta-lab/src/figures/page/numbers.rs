//! The measured numbers as tables with the article's, and the reasons for the differences.

use crate::figures::numbers::Numbers;
use crate::figures::reasons::signed;
use crate::figures::series::{Interval, Series};
use std::fmt::{Result, Write};
use tinta::styles::Filter;
use tinta_geometry::markup::escaped;

/// A sentence that names the measurements and the machine.
pub(super) fn summary(numbers: &Numbers) -> String {
    let frames = numbers.empty.frames_ms.len();
    format!(
        "Times are medians of {frames} {} of each setting, the settings taking turns, the picture read back each time, on {} \
         with {} processor {}; gains are medians of the ratios within a turn, with their quartiles, {}. figures.json holds \
         every raw time.",
        if frames == 1 { "frame" } else { "frames" },
        numbers.host.renderer,
        numbers.host.threads,
        if numbers.host.threads == 1 { "thread" } else { "threads" },
        if numbers.host.is_software { "by processor time" } else { "by the clock" }
    ) + if frames < ENOUGH_FRAMES { TOO_FEW } else { "" }
}

/// Least number of frames that gives stable medians and ratios on a busy machine.
const ENOUGH_FRAMES: usize = 11;

const TOO_FEW: &str = " So few frames say little: the times, gains and conclusions below may contradict each other; more frames \
                       settle it.";

/// The tables of this figure.
pub(super) fn tables(out: &mut String, id: &str, numbers: &Numbers) -> Result {
    match id {
        "evangelista-13" => {
            scenes(out, numbers)?;
            why(out, numbers, "frames")
        }
        "evangelista-numbers" => {
            filter(out, numbers)?;
            background(out, numbers)?;
            throughput(out, numbers)
        }
        _ => Ok(()),
    }
}

fn scenes(out: &mut String, numbers: &Numbers) -> Result {
    let mut heads = vec!["triangles: paper", "ours", "gears, ants, busts", "cuts of the box", "covered"];
    heads.extend(["1 tone, 2 passes", "3 passes", "2 tones, 2 passes", "3 passes", "3 tones, 2 passes", "3 passes"]);
    let mut rows = Vec::new();
    for (index, scene) in numbers.scenes.iter().enumerate() {
        let mix = &scene.mix;
        // The text prints the first scene's triangles and the last one's.
        let is_printed = numbers.article.triangles.contains(&mix.wanted);
        let mut row = vec![
            if is_printed { grouped(mix.wanted) } else { format!("({})", grouped(mix.wanted)) },
            grouped(mix.triangles),
            format!("{}, {}, {}", mix.gears, mix.ants, mix.busts),
            mix.box_cuts.to_string(),
            format!("{:.0} %", scene.covered * 100.0),
        ];
        for (tones, passes) in [(1, 2), (1, 3), (2, 2), (2, 3), (3, 2), (3, 3)] {
            row.push(numbers.curve(tones, passes).nth(index).map_or_else(String::new, |point| rate(&point.series)));
        }
        rows.push(row);
    }
    writeln!(out, "<p>Frames per second:</p>")?;
    table(out, &heads, &rows)?;
    writeln!(
        out,
        "<p class=\"hint\">Triangles in brackets are not printed in the text; between the two that are, each scene here has \
         as many times more than the one before. Each is built from gears, ants and busts added in turn while they fit, all of \
         one size, and an open box whose ten triangles are each cut into as many as then are missing. The text prints no \
         frame rate.</p>"
    )
}

fn filter(out: &mut String, numbers: &Numbers) -> Result {
    writeln!(out, "<h4>The cheaper filter</h4>")?;
    let name = |filter| if filter == Filter::Laplacian4 { "five reads (the paper's)" } else { "nine reads" };
    let mut rows: Vec<Vec<String>> =
        numbers.filters.iter().map(|row| vec![name(row.filter).to_owned(), rate(&row.series), String::new()]).collect();
    let gain = numbers.filter_gain_percent().map(between).unwrap_or_default();
    rows.push(vec!["gain".to_owned(), gain, signed(numbers.article.filter_gain_percent)]);
    table(out, &["filter", "frames per second", "paper"], &rows)?;
    why(out, numbers, "filter")
}

fn background(out: &mut String, numbers: &Numbers) -> Result {
    writeln!(out, "<h4>Two passes without the square behind the scene</h4>")?;
    let rows: Vec<Vec<String>> = numbers
        .backgrounds
        .iter()
        .map(|row| {
            vec![
                format!("{} x", row.distance),
                format!("{:.0} %", row.covered * 100.0),
                rate(&row.three_pass),
                rate(&row.two_pass),
                rate(&row.two_pass_without),
                between(row.gain_percent()),
            ]
        })
        .collect();
    let heads = ["distance", "covered", "three passes", "two, with", "two, without", "gain over three"];
    table(out, &heads, &rows)?;
    writeln!(
        out,
        "<p class=\"hint\">Frames per second of the bust; the paper: up to {}.</p>",
        signed(numbers.article.background_gain_percent)
    )?;
    why(out, numbers, "background")
}

fn throughput(out: &mut String, numbers: &Numbers) -> Result {
    writeln!(out, "<h4>Shader throughput, million pixels a second</h4>")?;
    let number =
        |value: Option<f64>, digits: usize| value.map_or("–".to_owned(), |value| format!("{value:.digits$}"));
    let rows: Vec<Vec<String>> = numbers
        .shaders
        .iter()
        .map(|row| vec![row.name.to_owned(), number(row.article_mpixels, 2), number(row.mpixels, 1)])
        .collect();
    table(out, &["shader", "paper", "here"], &rows)?;
    why(out, numbers, "throughput")
}

fn why(out: &mut String, numbers: &Numbers, about: &str) -> Result {
    for reason in numbers.reasons.iter().filter(|reason| reason.about == about) {
        writeln!(out, "<p>{}</p>", escaped(&reason.sentence))?;
    }
    Ok(())
}

fn table(out: &mut String, heads: &[&str], rows: &[Vec<String>]) -> Result {
    let class = |column: usize| if column == 0 { "" } else { " class=\"number\"" };
    writeln!(out, "<div class=\"scroll\" tabindex=\"0\"><table>\n<tr>")?;
    for (column, head) in heads.iter().enumerate() {
        writeln!(out, "<th{}>{}</th>", class(column), escaped(head))?;
    }
    writeln!(out, "</tr>")?;
    for row in rows {
        let cells: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(column, cell)| format!("<td{}>{}</td>", class(column), escaped(cell)))
            .collect();
        writeln!(out, "<tr>{}</tr>", cells.concat())?;
    }
    writeln!(out, "</table></div>")
}

/// Percent with the quartiles in brackets.
fn between(gain: Interval) -> String {
    let [low, high] = gain.quartiles.map(signed);
    format!("{} ({low} to {high})", signed(gain.middle))
}

fn rate(series: &Series) -> String {
    let rate = series.frames_per_second();
    if rate >= 100.0 { format!("{rate:.0}") } else { format!("{rate:.1}") }
}

fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let parts: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|part| std::str::from_utf8(part).ok()).collect();
    parts.join(",")
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn thousands_are_grouped() {
        assert_eq!([7, 3_039, 122_646].map(grouped), ["7", "3,039", "122,646"]);
    }
}
