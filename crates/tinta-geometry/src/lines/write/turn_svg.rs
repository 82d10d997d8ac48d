//! Writes a turn as one animated SVG: a path for each stroke, whose course SMIL exchanges from view to view.
//!
//! Input: the lines of each view with the paths of [`StrokeIds`](crate::lines::StrokeIds), and [`DrawingSettings`]. Output: a text
//! without scripts that browsers play in an endless loop. Programs that know no animation show the first view.

use super::svg::{begin, layer_tag, path_data_of};
use crate::error::Result;
use crate::lines::VisibleLines;
use crate::lines::drawing::chain::LinePath;
use crate::lines::drawing::drawn_layers::Drawing;
use crate::lines::drawing::layers::Layer;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::drawing::text::decimal;
use crate::mesh::NONE;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The course of a stroke that a view lacks: a place without a line.
const NOTHING: &str = "M0 0";

/// Decimals of a share of the turn, for up to 10,000 views.
const SHARE_DECIMALS: u32 = 6;

/// The views of a turn so far.
#[derive(Debug, Default)]
pub struct TurnSvg {
    /// Everything before the layers, as the first view has it.
    head: String,
    /// By the layers' order from below and their style.
    layers: BTreeMap<(usize, u32), StrokesOfLayer>,
    views: usize,
}

/// The strokes of a layer in all views.
#[derive(Debug, Default)]
struct StrokesOfLayer {
    id: String,
    tag: String,
    /// For each stroke its courses, each with the first view that shows it so; a later one replaces it. All paths without a number,
    /// such as a pen's dashes, are [`NONE`].
    courses: BTreeMap<u32, Vec<(usize, String)>>,
}

impl TurnSvg {
    /// Adds the next view. Page, colours and widths are those of the first.
    ///
    /// # Errors
    ///
    /// Those of [`crate::lines::svg`].
    pub fn add(&mut self, lines: &VisibleLines, paths: Vec<LinePath>, settings: &DrawingSettings) -> Result<()> {
        let drawing = Drawing::new(lines, paths, None, settings)?;
        if self.views == 0 {
            begin(&drawing, &mut self.head);
        }
        let mut shown: BTreeMap<((usize, u32), u32), String> = BTreeMap::new();
        for drawn in &drawing.layers {
            let height = Layer::upwards().position(|layer| layer == drawn.layer).unwrap_or(0);
            let key = (height, drawn.look);
            let layer = self.layers.entry(key).or_default();
            if layer.tag.is_empty() {
                (layer.id, layer.tag) = (drawn.id(), layer_tag(drawn));
            }
            for path in &drawn.paths {
                *shown.entry((key, path.stroke.unwrap_or(NONE))).or_default() += &path_data_of(&drawing, path);
            }
        }
        for ((key, stroke), course) in &mut shown {
            let layer = self.layers.entry(*key).or_default();
            let courses = layer.courses.entry(*stroke).or_insert_with(|| vec![(0, NOTHING.to_owned())]);
            put(courses, self.views, std::mem::take(course));
        }
        for (key, layer) in &mut self.layers {
            let missing = layer.courses.iter_mut().filter(|(stroke, _)| !shown.contains_key(&(*key, **stroke)));
            missing.for_each(|(_, courses)| put(courses, self.views, NOTHING.to_owned()));
        }
        self.views += 1;
        Ok(())
    }

    /// Returns the file, each view of which lasts so long.
    pub fn finish(self, milliseconds_per_view: u16) -> String {
        let views = self.views.max(1);
        let seconds = decimal(views as f64 * f64::from(milliseconds_per_view) / 1000.0, SHARE_DECIMALS);
        let mut out = self.head;
        for layer in self.layers.into_values() {
            out.push_str(&layer.tag);
            for (stroke, courses) in layer.courses {
                let first = &courses[0].1;
                let id = if stroke == NONE { "others".to_owned() } else { format!("stroke-{stroke}") };
                let _ = write!(out, r#"<path id="{}-{id}" d="{first}""#, layer.id);
                if let [_] = courses[..] {
                    out.push_str("/>\n");
                    continue;
                }
                let times: Vec<String> =
                    courses.iter().map(|(view, _)| decimal(*view as f64 / views as f64, SHARE_DECIMALS)).collect();
                let values: Vec<&str> = courses.iter().map(|(_, course)| course.as_str()).collect();
                let _ = writeln!(
                    out,
                    r#"><animate attributeName="d" calcMode="discrete" dur="{seconds}s" repeatCount="indefinite" keyTimes="{}" values="{}"/></path>"#,
                    times.join(";"),
                    values.join(";")
                );
            }
            out.push_str("</g>\n");
        }
        out.push_str("</svg>\n");
        out
    }
}

/// Notes the course that a view shows, if it is another than before.
fn put(courses: &mut Vec<(usize, String)>, view: usize, course: String) {
    match courses.last_mut() {
        Some((_, last)) if *last == course => {}
        Some((from, last)) if *from == view => *last = course,
        _ => courses.push((view, course)),
    }
}
