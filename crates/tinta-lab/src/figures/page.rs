//! The page that shows the figures by the texts' own numbers: one XHTML file with its style and its pictures in it.
//!
//! Takes drawings and measurements, and returns text. It needs no other file, no network and no script, and is as readable on a
//! telephone. Its pictures have fewer colours than the separate files, to fit all of them into one page.

mod diagrams;
mod numbers;
mod pictures;

use super::{Content, Figure, Numbers, PassColumn, Text};
use pictures::pictures;
pub use pictures::{PictureRecord, png_source, svg_source};
use serde::Serialize;
use std::fmt::Write;
use tinta::page::{Pictures, beginning};
use tinta::scene::Size;
use tinta_geometry::markup::escaped;

/// A finished figure, for the page and for `figures.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureRecord {
    /// Its name for `--only`.
    pub id: &'static str,
    /// The text it is in.
    pub text: &'static str,
    /// The text's own number.
    pub number: &'static str,
    /// Its subject.
    pub title: &'static str,
    /// The contents of the text's figure and of ours.
    pub caption: &'static str,
    /// The written pictures.
    pub pictures: Vec<PictureRecord>,
    /// Labels of pictures that were left out, each with the reason.
    pub left_out: Vec<String>,
    /// The reason, for a figure that is never drawn.
    pub not_drawn: Option<&'static str>,
    /// The passes that it is a diagram of.
    pub passes: Vec<PassColumn>,
    /// The whole command that made all of it.
    pub command: String,
    #[serde(skip)]
    text_index: Text,
}

impl FigureRecord {
    /// A record of a figure without pictures yet.
    pub fn new(figure: &Figure, command: String) -> Self {
        let Figure { id, text, number, title, caption, .. } = *figure;
        Self {
            id,
            text: text.name(),
            number,
            title,
            caption,
            pictures: Vec::new(),
            left_out: Vec::new(),
            not_drawn: if let Content::NotDrawn(reason) = figure.content { Some(reason) } else { None },
            passes: Vec::new(),
            command,
            text_index: text,
        }
    }
}

/// The drawings and measurements.
#[derive(Debug, Clone, Copy)]
pub struct PageContent<'a> {
    /// The figures.
    pub figures: &'a [FigureRecord],
    /// Section 5's numbers, if they were measured.
    pub numbers: Option<&'a Numbers>,
}

/// The page.
pub fn page(shown: PageContent<'_>, gl: &str, size: Size) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = write(&mut out, shown, gl, size);
    out
}

fn write(out: &mut String, shown: PageContent<'_>, gl: &str, size: Size) -> std::fmt::Result {
    let PageContent { figures: records, numbers, .. } = shown;
    let version = env!("CARGO_PKG_VERSION");
    out.push_str(&beginning("Three texts' figures, drawn again", Pictures::Within));
    writeln!(out, "<h1>Three texts' figures, drawn again</h1>")?;
    writeln!(
        out,
        "<p>Every figure of the three texts by its own number, diagrams included: drawn anew with models of our own, or named with \
         the reason why not. Drawn by tinta {version} at {size} pixels on {}; the files beside this page hold each picture in all \
         its colours.</p>\n<p>The originals' pictures were not at hand: the texts were read as text alone, so a figure's content is \
         known from its caption and the text around it.</p>",
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
        writeln!(out, "<div class=\"figures\">")?;
        for record in of_text {
            section(out, record, shown)?;
        }
        writeln!(out, "</div>")?;
    }
    writeln!(out, "</body>\n</html>")
}

fn section(out: &mut String, record: &FigureRecord, shown: PageContent<'_>) -> std::fmt::Result {
    let has_columns = !record.passes.is_empty() || record.id.ends_with("-numbers");
    let class = if record.pictures.len() > 1 || has_columns { " class=\"wide\"" } else { "" };
    writeln!(out, "<section id=\"{}\"{class}>", record.id)?;
    writeln!(
        out,
        "<h3>{}. {}</h3>\n<p>{}</p>",
        escaped(record.number),
        escaped(record.title),
        escaped(record.caption)
    )?;
    pictures(out, record.pictures.iter(), record.title)?;
    for line in &record.left_out {
        writeln!(out, "<p class=\"left-out\">Left out: {}.</p>", escaped(line))?;
    }
    if let Some(reason) = record.not_drawn {
        return writeln!(out, "<p class=\"left-out\">Not drawn: {}.</p>\n</section>", escaped(reason));
    }
    if !record.passes.is_empty() {
        diagrams::passes(out, &record.passes)?;
        return writeln!(out, "</section>");
    }
    if let Some(measured) = shown.numbers {
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
        let nothing = PageContent { figures: &[], numbers: None };
        let page = page(nothing, "<script>", Size { width: 4, height: 3 });
        assert!(page.contains("&lt;script&gt;") && !page.contains("<script"));
    }
}
