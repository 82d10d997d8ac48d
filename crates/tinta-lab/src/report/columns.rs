//! The columns of the reports: one list for `results.csv`, the page's table and the meaning of each.

use crate::measure::{LineError, Row, RunTime, ToneError, quartiles};
use std::borrow::Cow;
use tinta::edges::Class;
use tinta::renderer::median;

/// One column of every report.
pub struct Column {
    /// Its name in `results.csv`.
    pub name: Cow<'static, str>,
    /// Its title on the page.
    pub title: Cow<'static, str>,
    /// Its meaning, with its unit.
    pub meaning: Cow<'static, str>,
    /// Digits after the point on the page; `results.csv` has all.
    pub(super) decimals: usize,
    /// Whether the page shows it at first.
    pub(super) is_main: bool,
    source: Source,
}

impl std::fmt::Debug for Column {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Column").field("name", &self.name).finish_non_exhaustive()
    }
}

/// The contents of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    Number(f64),
    Missing,
}

enum Source {
    Row(fn(&Row) -> Value),
    Time(fn(&RunTime) -> Option<f64>),
    Lines(fn(&LineError) -> Option<f64>),
    Tones(fn(&ToneError) -> Option<f64>),
    /// Recall of this class of lines.
    Class(&'static str),
}

use Source::{Lines, Time, Tones};

impl Column {
    pub(super) fn value(&self, row: &Row) -> Value {
        let number = match self.source {
            Source::Row(value) => return value(row),
            Time(value) => value(&row.time),
            Source::Lines(value) => row.lines.as_ref().and_then(value),
            Source::Tones(value) => row.tones.as_ref().and_then(value),
            Source::Class(class) => row.lines.as_ref().and_then(|lines| lines.recall_of_class.get(class).copied()),
        };
        number.map_or(Value::Missing, Value::Number)
    }

    fn says(self, meaning: &'static str) -> Self {
        Self { meaning: meaning.into(), ..self }
    }
}

/// All columns, in the order of `results.csv`; new ones are added at the end of their group.
pub fn columns() -> Vec<Column> {
    let of_classes = Class::ALL.map(|(class, _)| Column {
        name: format!("recall_{}", class.replace('-', "_")).into(),
        title: format!("Recall, {class}").into(),
        meaning: format!("Recall over the reference's lines of class {class}.").into(),
        decimals: 3,
        is_main: false,
        source: Source::Class(class),
    });
    let groups = [setting_columns(), time_columns(), line_columns(), of_classes.into(), tone_columns()];
    groups.into_iter().flatten().collect()
}

fn column(name: &'static str, title: &'static str, decimals: usize, source: Source) -> Column {
    Column { name: name.into(), title: title.into(), meaning: "".into(), decimals, is_main: false, source }
}

/// A column that the page shows at first.
fn main(name: &'static str, title: &'static str, decimals: usize, source: Source) -> Column {
    Column { is_main: true, ..column(name, title, decimals, source) }
}

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

/// A text that older rows lack.
fn known(it: &str) -> Value {
    if it.is_empty() { Value::Missing } else { text(it) }
}

fn yes(is_so: bool) -> Value {
    text(if is_so { "yes" } else { "no" })
}

/// The mean of distances, of which the second number is that of 95 %.
fn mean(distances: Option<[f64; 2]>) -> Option<f64> {
    distances.map(|[mean, _]| mean)
}

fn of_95(distances: Option<[f64; 2]>) -> Option<f64> {
    distances.map(|[_, of_95]| of_95)
}

fn setting_columns() -> Vec<Column> {
    vec![
        main("model", "Model", 0, Source::Row(|row| text(&row.model))).says("The model's name, as given."),
        main("style", "Style", 0, Source::Row(|row| text(&row.style))).says("The style drawn."),
        main("options", "Setting", 0, Source::Row(|row| text(&row.options)))
            .says("The options that make this setting; tinta render takes them."),
        main("faithful", "Published", 0, Source::Row(|row| yes(row.is_faithful)))
            .says("Whether these are the published program's own settings."),
        column("triangles", "Triangles", 0, Source::Row(|row| Value::Number(row.triangles as f64)))
            .says("Triangles drawn."),
        column("width_px", "Width", 0, Source::Row(|row| Value::Number(row.size[0].into())))
            .says("Width of the picture, pixels."),
        column("height_px", "Height", 0, Source::Row(|row| Value::Number(row.size[1].into())))
            .says("Height of the picture, pixels."),
        column("machine", "Machine", 0, Source::Row(|row| text(&row.machine))).says("The machine it was measured on."),
        column("renderer", "Renderer", 0, Source::Row(|row| text(&row.renderer)))
            .says("The OpenGL renderer (GL_RENDERER); none for lines found without OpenGL."),
        column("version", "Version", 0, Source::Row(|row| text(&row.version))).says("The version of tinta."),
        column("commit", "Commit", 0, Source::Row(|row| known(&row.conditions.commit)))
            .says("The commit that it was built from."),
        column("date", "Date", 0, Source::Row(|row| known(&row.conditions.date)))
            .says("The day of the measurement, UTC."),
        column("processor", "Processor", 0, Source::Row(|row| known(&row.conditions.processor)))
            .says("The processor's name, where the system tells it."),
        column("load", "Load", 1, Source::Row(|row| row.conditions.load.map_or(Value::Missing, Value::Number)))
            .says("Processes that wanted a processor during the minute before, on average."),
        column("gl_version", "OpenGL", 0, Source::Row(|row| known(&row.gl_version))).says("GL_VERSION, the driver's."),
        column("pruned", "Pruned", 0, Source::Row(|row| yes(row.is_pruned)))
            .says("Whether steps that the scene does not need were left out, as tinta render does."),
        column("own_reference", "Judged by own lines", 0, Source::Row(|row| yes(row.has_own_reference)))
            .says("Whether the style draws the very lines that it is judged by: its F1 is near 1 by construction."),
    ]
}

fn time_columns() -> Vec<Column> {
    vec![
        main("median_ms", "Clock, ms", 2, Time(|time| Some(time.median_ms))).says(
            "Median time of a frame, milliseconds of the clock, reading the picture back included; lower is better.",
        ),
        column("lower_quartile_ms", "Clock, 25 %, ms", 2, Time(|time| quartile(&time.frames_ms, 0)))
            .says("A quarter of the frames took no longer, milliseconds."),
        column("upper_quartile_ms", "Clock, 75 %, ms", 2, Time(|time| quartile(&time.frames_ms, 1)))
            .says("Three quarters of the frames took no longer, milliseconds."),
        column("frames", "Frames", 0, Time(|time| Some(time.frames_ms.len() as f64)))
            .says("Frames measured after warm-up; the time of each stands in results.jsonl."),
        main("processor_ms", "Processor, ms", 2, Time(|time| median(time.processor_ms.clone()))).says(
            "Median processor time of a frame, all threads, milliseconds; plots and answers take it where all rows of a \
             machine have it. Empty where a device draws.",
        ),
        column("processor_lower_quartile_ms", "Processor, 25 %, ms", 2, Time(|time| quartile(&time.processor_ms, 0)))
            .says("A quarter of the frames took no more processor time, milliseconds."),
        column("processor_upper_quartile_ms", "Processor, 75 %, ms", 2, Time(|time| quartile(&time.processor_ms, 1)))
            .says("Three quarters of the frames took no more processor time, milliseconds."),
        column("load_ms", "Load, ms", 2, Time(|time| Some(time.load_ms)))
            .says("Reading the model, milliseconds."),
        column("edges_ms", "Edges, ms", 2, Time(|time| Some(time.edges_ms)))
            .says("Finding the model's edges, milliseconds; 0 for a style that needs none."),
        column("plan_ms", "Plan, ms", 3, Time(|time| Some(time.plan_ms)))
            .says("Making the plan, milliseconds."),
        column("passes", "Passes, ms", 0, Source::Row(passes)).says(
            "Median time of each pass by the clock and, after a slash, by the GPU's timer where it has one, \
             milliseconds.",
        ),
    ]
}

/// The lower (0) or upper quartile of the frames' times, which some rows lack.
fn quartile(times: &[f64], which: usize) -> Option<f64> {
    (!times.is_empty()).then(|| quartiles(times)[which])
}

fn passes(row: &Row) -> Value {
    let of_pass = |pass: &crate::measure::PassRow| match pass.gpu_ms {
        Some(gpu_ms) => format!("{} {:.3}/{gpu_ms:.3}", pass.name, pass.cpu_ms),
        None => format!("{} {:.3}", pass.name, pass.cpu_ms),
    };
    let all: Vec<String> = row.time.passes.iter().map(of_pass).collect();
    if all.is_empty() { Value::Missing } else { Value::Text(all.join("; ")) }
}

fn line_columns() -> Vec<Column> {
    vec![
        main("f1", "Lines F1", 3, Lines(|lines| Some(lines.f1))).says(
            "Harmonic mean of precision and recall of the picture's ink against the exact visible lines: 1 is full \
             agreement, 0 no agreement.",
        ),
        main("precision", "Precision", 3, Lines(|lines| Some(lines.precision))).says(
            "Share of the ink at or above the threshold (Ink from), weighted by darkness, within the tolerance of an \
             exact line; the rest is invented.",
        ),
        column("precision_of_all", "Precision of all ink", 3, Lines(|lines| Some(lines.precision_of_all)))
            .says("The same of all ink, however faint: nets of faint lines that fall below the threshold count here."),
        main("recall", "Recall", 3, Lines(|lines| Some(lines.recall)))
            .says("Share of the exact lines' length with ink within the tolerance; the rest is missed."),
        column("average_precision", "Average precision", 3, Lines(|lines| Some(lines.average_precision))).says(
            "Precision averaged over recall, over all thresholds of ink: the lines without a choice of threshold.",
        ),
        column("tolerance_px", "Tolerance, px", 1, Lines(|lines| Some(lines.tolerance_px)))
            .says("Distance within which ink and line count as the same, pixels."),
        column("ink_from", "Ink from", 0, Lines(|lines| Some(lines.ink_from.into())))
            .says("Least darkness of a pixel that counts as ink, of 255."),
        column("ignored_from_degrees", "Ignored from, °", 1, Lines(|lines| Some(lines.ignored_creases_degrees[0])))
            .says("Creases from this angle up to the next column's are neither missed nor invented, degrees."),
        column("ignored_to_degrees", "Ignored to, °", 1, Lines(|lines| Some(lines.ignored_creases_degrees[1])))
            .says("Creases beyond this angle belong to the exact lines, degrees."),
        column("reference_px", "Reference, px", 0, Lines(|lines| Some(lines.reference_px)))
            .says("Length of the exact visible lines, pixels."),
        column("ink_px", "Ink, px", 0, Lines(|lines| Some(lines.ink_px)))
            .says("Ink in the picture, pixels weighted by darkness."),
        column("reference_to_ink_mean_px", "Line to ink, mean px", 2, Lines(|lines| mean(lines.reference_to_ink_px)))
            .says("Mean distance from the exact lines to the nearest ink, pixels."),
        column("reference_to_ink_95_px", "Line to ink, 95 % px", 2, Lines(|lines| of_95(lines.reference_to_ink_px)))
            .says("95 % of the exact lines' length is no farther from ink than this, pixels."),
        column("ink_to_reference_mean_px", "Ink to line, mean px", 2, Lines(|lines| mean(lines.ink_to_reference_px)))
            .says("Mean distance from ink to the nearest exact line, pixels."),
        column("ink_to_reference_95_px", "Ink to line, 95 % px", 2, Lines(|lines| of_95(lines.ink_to_reference_px)))
            .says("95 % of the ink is no farther from an exact line than this, pixels."),
    ]
}

fn tone_columns() -> Vec<Column> {
    vec![
        main("tone_differing", "Tones differing", 4, Tones(|tones| tones.inner_differing)).says(
            "Share of covered pixels away from lines whose tone is not that of a ray cast in f64; empty for \
             continuous tones.",
        ),
        main("tone_mean_difference", "Tone difference, mean", 2, Tones(|tones| Some(tones.mean_difference)))
            .says("Mean difference of any channel from a ray cast in f64 over the same pixels, of 255."),
        column("tone_largest_difference", "Tone difference, largest", 0, Tones(|tones| Some(tones.largest_difference)))
            .says("The largest difference of any channel over the same pixels, of 255."),
        column(
            "tone_border_to_drawn_mean_px",
            "Tone border to drawn, mean px",
            2,
            Tones(|tones| Some(tones.borders.as_ref()?.exact_to_drawn_px[0])),
        )
        .says(
            "Mean distance from the exact borders between tones to the nearest in the picture, away from lines, \
             pixels.",
        ),
        column(
            "drawn_to_tone_border_mean_px",
            "Drawn tone border to exact, mean px",
            2,
            Tones(|tones| Some(tones.borders.as_ref()?.drawn_to_exact_px[0])),
        )
        .says(
            "Mean distance from the picture's borders between tones to the nearest exact one, away from lines, \
             pixels.",
        ),
        column("tone_pixels", "Tone pixels", 0, Tones(|tones| Some(tones.inner_px as f64)))
            .says("Covered pixels farther than 1 pixel from every visible line."),
        column("tone_rim_differing", "Tones differing at lines", 4, Tones(|tones| tones.rim_differing))
            .says("Share of covered pixels within 1 pixel of a visible line whose tone differs."),
        column("tone_rim_pixels", "Tone pixels at lines", 0, Tones(|tones| Some(tones.rim_px as f64)))
            .says("Covered pixels within 1 pixel of a visible line."),
    ]
}
