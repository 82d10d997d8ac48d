//! The page that shows the figures by the texts' own numbers: one XHTML file with its style in it, pictures beside it.
//!
//! In: what was drawn and measured. Out: text. It needs no network and no script, and is as readable on a telephone.

mod numbers;

use super::{Figure, Numbers, Text};
use crate::markup::escaped;
use crate::scene::Size;
use crate::styles::{Show, Style};
use serde::Serialize;
use std::fmt::Write;

/// A figure as it came out, for the page and for `figures.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureRecord {
    /// As `--only` takes it.
    pub id: &'static str,
    /// The text it is in.
    pub text: &'static str,
    /// The text's own number.
    pub number: &'static str,
    /// What it is of.
    pub title: &'static str,
    /// What the text's figure shows and what ours shows.
    pub caption: &'static str,
    /// What was written.
    pub pictures: Vec<PictureRecord>,
    /// Labels of pictures that were left out, each with the reason.
    pub left_out: Vec<String>,
    /// The whole command that made all of it.
    pub command: String,
    #[serde(skip)]
    text_index: Text,
}

/// A file of a figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PictureRecord {
    /// Its name, beside the page.
    pub file: String,
    /// What tells it from its neighbours.
    pub label: String,
    /// Pixels.
    pub size: Size,
    /// What draws it alone.
    pub command: Option<String>,
    /// The style and its settings, for drawn models.
    pub style: Option<Style>,
    /// Which of the style's pictures.
    pub show: Option<Show>,
}

impl FigureRecord {
    /// A record of a figure without pictures yet.
    pub fn new(figure: &Figure, command: String) -> Self {
        let (pictures, left_out) = (Vec::new(), Vec::new());
        let Figure { id, text, number, title, caption, .. } = *figure;
        Self { id, text: text.name(), number, title, caption, pictures, left_out, command, text_index: text }
    }
}

const STYLE: &str = "\
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 76rem; padding: 0 1rem 3rem; color: #222; background: #fff; }
h1 { font-size: 1.6rem; line-height: 1.2; } h2 { margin-top: 3rem; border-bottom: 2px solid #222; } h3 { margin: 2.2rem 0 .3rem; }
nav a { display: inline-block; margin: 0 .9rem .4rem 0; } a { color: #1d5aa6; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; margin: .8rem 0; }
figure { margin: 0; max-width: 100%; } img { max-width: 100%; height: auto; display: block; border: 1px solid #ddd; }
.four figure { flex: 1 1 14rem; max-width: 22rem; } figcaption { font-size: .9rem; color: #444; }
pre { background: #f3f3f3; padding: .5rem .7rem; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem; margin: .5rem 0; }
.table { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; margin: .6rem 0; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid #ddd; text-align: right; } td { white-space: nowrap; } th { vertical-align: bottom; } td.name, th.name { text-align: left; }
p { max-width: 48rem; } .left-out { color: #8a3a00; } .hint { color: #555; }";

/// The page.
pub fn page(records: &[FigureRecord], numbers: Option<&Numbers>, gl: &str, size: Size) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = write(&mut out, records, numbers, gl, size);
    out
}

fn write(
    out: &mut String,
    records: &[FigureRecord],
    numbers: Option<&Numbers>,
    gl: &str,
    size: Size,
) -> std::fmt::Result {
    let version = env!("CARGO_PKG_VERSION");
    writeln!(
        out,
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" xml:lang=\"en\">\n<head>"
    )?;
    writeln!(out, "<meta charset=\"utf-8\" />")?;
    writeln!(out, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />")?;
    writeln!(out, "<title>Three texts' figures, drawn again</title>\n<style>\n{STYLE}\n</style>\n</head>\n<body>")?;
    writeln!(out, "<h1>Three texts' figures, drawn again</h1>")?;
    writeln!(
        out,
        "<p>Every figure that shows a result of its authors, by their number, in pictures and plots of our own. Drawn by \
         tinta {version} at {size} pixels on {}.</p>",
        escaped(gl)
    )?;
    if let Some(numbers) = numbers {
        writeln!(out, "<p>{}</p>", escaped(&numbers::summary(numbers)))?;
    }
    writeln!(out, "<nav>")?;
    for record in records {
        let text = record.text.split(' ').next().unwrap_or_default();
        writeln!(out, "<a href=\"#{}\">{text}, {}</a>", record.id, lower_first(record.number))?;
    }
    writeln!(out, "</nav>")?;
    for text in Text::ALL {
        let mut of_text = records.iter().filter(|record| record.text_index == text).peekable();
        if of_text.peek().is_none() {
            continue;
        }
        writeln!(out, "<h2>{}</h2>\n<p class=\"hint\"><cite>{}</cite></p>", text.name(), text.title())?;
        for record in of_text {
            section(out, record, numbers)?;
        }
    }
    writeln!(out, "</body>\n</html>")
}

fn section(out: &mut String, record: &FigureRecord, numbers: Option<&Numbers>) -> std::fmt::Result {
    writeln!(out, "<section id=\"{}\">", record.id)?;
    writeln!(
        out,
        "<h3>{}. {}</h3>\n<p>{}</p>",
        escaped(record.number),
        escaped(record.title),
        escaped(record.caption)
    )?;
    if !record.pictures.is_empty() {
        let class = if record.pictures.len() > 2 { "pictures four" } else { "pictures" };
        writeln!(out, "<div class=\"{class}\">")?;
        for picture in &record.pictures {
            let (file, label, Size { width, height }) = (escaped(&picture.file), escaped(&picture.label), picture.size);
            let alt = format!("{}: {label}", escaped(record.title));
            writeln!(
                out,
                "<figure><img src=\"{file}\" width=\"{width}\" height=\"{height}\" alt=\"{alt}\" />\
                 <figcaption>{label}</figcaption></figure>"
            )?;
        }
        writeln!(out, "</div>")?;
    }
    for line in &record.left_out {
        writeln!(out, "<p class=\"left-out\">Left out: {}.</p>", escaped(line))?;
    }
    if let Some(measured) = numbers {
        numbers::tables(out, record.id, measured)?;
    }
    let commands: Vec<String> = record.pictures.iter().filter_map(|picture| picture.command.clone()).collect();
    let text = if commands.is_empty() { record.command.clone() } else { commands.join("\n") };
    writeln!(out, "<pre>{}</pre>\n</section>", escaped(&text))
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_and_drivers_cannot_break_the_page() {
        let page = page(&[], None, "<script>", Size { width: 4, height: 3 });
        assert!(page.contains("&lt;script&gt;") && !page.contains("<script"));
    }
}
