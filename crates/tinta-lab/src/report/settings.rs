//! Groups rows: by machine, and a setting's rows of several models into one point of a plot.

use crate::measure::{Row, quartiles};
use std::collections::{BTreeMap, BTreeSet};
use tinta::renderer::median;

/// The quantity that a plot shows against time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// How far the ink is from the exact lines: 1 - F1.
    Lines,
    /// Share of pixels with another tone than a ray's.
    Tones,
    /// Mean difference from a ray's, of 255, where tones are continuous.
    ContinuousTones,
}

impl Measure {
    /// All of them, with their file names.
    pub const ALL: [(&'static str, Self); 3] =
        [("lines", Self::Lines), ("tones", Self::Tones), ("continuous-tones", Self::ContinuousTones)];

    /// The row's error; 0 is best.
    pub(crate) fn error(self, row: &Row) -> Option<f64> {
        match self {
            // Cut at zero: rounding may take F1 past 1.
            Self::Lines => row.lines.as_ref().map(|lines| (1.0 - lines.f1).max(0.0)),
            Self::Tones => row.tones.as_ref().and_then(|tones| tones.inner_differing),
            Self::ContinuousTones => {
                row.tones.as_ref().filter(|tones| tones.inner_differing.is_none()).map(|tones| tones.mean_difference)
            }
        }
    }

    /// The plot's title.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Lines => "Lines: error against time",
            Self::Tones => "Tones: error against time",
            Self::ContinuousTones => "Continuous tones: error against time",
        }
    }

    /// The error's axis.
    pub(super) fn axis(self) -> &'static str {
        match self {
            Self::Lines => "1 − F1 against the true lines",
            Self::Tones => "share of pixels with another tone",
            Self::ContinuousTones => "mean difference of tones, of 255",
        }
    }
}

/// What the time of a frame is in a plot, a sentence and a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Clock {
    /// Processor time of all threads, where a program draws: the load of other programs hardly changes it.
    Processor,
    /// The clock's time, where a device draws.
    Wall,
}

impl Clock {
    /// Processor time if all of these rows, which are one machine's, have it: the two cannot be compared.
    pub(super) fn of(rows: &[&Row]) -> Self {
        if rows.iter().all(|row| !row.time.processor_ms.is_empty()) { Self::Processor } else { Self::Wall }
    }

    /// Follows "by".
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Processor => "processor time",
            Self::Wall => "the clock",
        }
    }

    /// Lower quartile, median, upper quartile of a row's frames, milliseconds; one number where it was measured once.
    pub(super) fn times_of(self, row: &Row) -> [f64; 3] {
        let frames = if self == Self::Processor { &row.time.processor_ms } else { &row.time.frames_ms };
        let [low, high] = quartiles(frames);
        median(frames.clone()).map_or([row.time.median_ms; 3], |middle| [low, middle, high])
    }
}

/// The rows of one machine and renderer.
#[derive(Debug, Clone)]
pub struct Machine<'a> {
    /// The machine, and the renderer where the same machine has several.
    pub name: String,
    /// Its rows; those found without GL belong to each renderer of theirs.
    pub rows: Vec<&'a Row>,
}

/// Machines in the order of first appearance.
pub fn machines(rows: &[Row]) -> Vec<Machine<'_>> {
    const NONE: &str = "none";
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.machine.as_str()) {
            names.push(&row.machine);
        }
    }
    let mut machines = Vec::new();
    for name in names {
        let mut renderers: Vec<&str> = Vec::new();
        let of_machine = || rows.iter().filter(move |row| row.machine == name);
        for row in of_machine().filter(|row| row.renderer != NONE) {
            if !renderers.contains(&row.renderer.as_str()) {
                renderers.push(&row.renderer);
            }
        }
        match renderers[..] {
            [] | [_] => machines.push(Machine { name: name.to_owned(), rows: of_machine().collect() }),
            _ => machines.extend(renderers.into_iter().map(|renderer| Machine {
                name: format!("{name}, {renderer}"),
                rows: of_machine().filter(|row| row.renderer == renderer || row.renderer == NONE).collect(),
            })),
        }
    }
    machines
}

/// Models in the order of first appearance.
pub(super) fn models<'a>(rows: &[&'a Row]) -> Vec<&'a str> {
    let mut models = Vec::new();
    for row in rows {
        if !models.contains(&row.model.as_str()) {
            models.push(row.model.as_str());
        }
    }
    models
}

/// Each model's short name: its file's name, if unique.
pub(super) fn model_names<'a>(models: impl Iterator<Item = &'a str>) -> BTreeMap<&'a str, String> {
    let file = |model: &str| {
        let name = std::path::Path::new(model).file_name();
        name.map_or_else(|| model.to_owned(), |name| name.to_string_lossy().into_owned())
    };
    let models: BTreeSet<&str> = models.collect();
    let is_shared = |model: &str| models.iter().filter(|other| file(other) == file(model)).count() > 1;
    models.iter().map(|model| (*model, if is_shared(model) { (*model).to_owned() } else { file(model) })).collect()
}

/// A setting in a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its short name.
    pub name: String,
    /// The style.
    pub style: String,
    /// Whether these are the published program's settings.
    pub is_faithful: bool,
    /// Whether it draws the very lines that it is judged by.
    pub has_own_reference: bool,
    /// The options of its rows.
    pub options: String,
    /// Its name without the picture's size, and its name without the numbers of its options: the points of a curve share one.
    pub curves: [String; 2],
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// Geometric mean over models of the time by `Points::clock`, milliseconds; of frames the median.
    pub time_ms: f64,
    /// The same of the lower and upper quartiles of the frames.
    pub times_ms: [f64; 2],
    /// Mean over models of the error.
    pub error: f64,
    /// Lower and upper quartile of the models' errors; of fewer than four models twice the mean.
    pub errors: [f64; 2],
}

impl Point {
    /// Whether its time may be as short as another's: the quartiles of their frames overlap.
    pub(super) fn is_as_fast_as(&self, other: &Self) -> bool {
        self.times_ms[0] <= other.times_ms[1]
    }
}

/// Follows the name of a setting that draws the very lines that it is judged by.
pub(super) const OWN_MARK: &str = " †";

/// A plot's points, with the models of their means.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// One for each setting measured on all of the models.
    pub points: Vec<Point>,
    /// The models.
    pub models: Vec<String>,
    /// Settings not measured on all of them, which a mean would compare unfairly.
    pub left_out: usize,
    /// What their times are.
    pub(super) clock: Clock,
}

/// A point for each setting of these rows, which are one machine's: the setting's mean over the models most settings share.
pub fn points(rows: &[&Row], measure: Measure) -> Points {
    let is_measured = |row: &&Row| measure.error(row).is_some_and(f64::is_finite) && row.time.median_ms > 0.0;
    let rows: Vec<&Row> = rows.iter().copied().filter(is_measured).collect();
    let clock = Clock::of(&rows);
    // If a setting was measured twice on a model, the last row counts.
    let mut by_setting: BTreeMap<SettingKey<'_>, BTreeMap<&str, &Row>> = BTreeMap::new();
    let mut order = Vec::new();
    for row in &rows {
        let key = setting_key(row);
        if !by_setting.contains_key(&key) {
            order.push(key);
        }
        by_setting.entry(key).or_default().insert(&row.model, row);
    }
    let mut count_of_models: BTreeMap<BTreeSet<&str>, usize> = BTreeMap::new();
    for of_setting in by_setting.values() {
        *count_of_models.entry(of_setting.keys().copied().collect()).or_default() += 1;
    }
    let shared = count_of_models.iter().max_by_key(|(models, count)| (**count, models.len()));
    let shared = shared.map(|(models, _)| models.clone()).unwrap_or_default();
    let names = short_names(&rows);
    let mut points = Vec::new();
    for key in &order {
        let of_models: Vec<&Row> = shared.iter().filter_map(|model| by_setting[key].get(model).copied()).collect();
        let (Some(first), true) = (of_models.first(), of_models.len() == shared.len()) else { continue };
        let count = of_models.len() as f64;
        let [low, middle, high] =
            [0, 1, 2].map(|at| (of_models.iter().map(|row| clock.times_of(row)[at].ln()).sum::<f64>() / count).exp());
        let errors: Vec<f64> = of_models.iter().filter_map(|row| measure.error(row)).collect();
        let error = errors.iter().sum::<f64>() / count;
        let size = first.size;
        let size_said = format!("{}×{}", size[0], size[1]);
        let without = |word: &str| word != size_said;
        let words = |is_kept: &dyn Fn(&str) -> bool| {
            names[key].split(' ').filter(|word| is_kept(word.trim_end_matches(','))).collect::<Vec<_>>().join(" ")
        };
        let own = if first.has_own_reference && measure == Measure::Lines { OWN_MARK } else { "" };
        points.push(Point {
            name: format!("{}{own}", names[key]),
            options: first.options.clone(),
            curves: [
                words(&without).trim_end_matches([',', ':']).to_owned(),
                words(&|word| word.parse::<f64>().is_err()),
            ],
            size,
            style: first.style.clone(),
            is_faithful: first.is_faithful,
            has_own_reference: first.has_own_reference,
            time_ms: middle,
            times_ms: [low, high],
            error,
            errors: if errors.len() < 4 { [error; 2] } else { quartiles(&errors) },
        });
    }
    let left_out = order.len() - points.len();
    let models = models(&rows).into_iter().filter(|model| shared.contains(model)).map(str::to_owned).collect();
    Points { points, models, left_out, clock }
}

/// The key of a setting on a machine.
pub(super) type SettingKey<'a> = (&'a str, &'a str, [u32; 2]);

pub(super) fn setting_key(row: &Row) -> SettingKey<'_> {
    (&row.style, &row.options, row.size)
}

/// Short names: the style and the options without dashes, without those that all settings share.
pub(super) fn short_names<'a>(rows: &[&'a Row]) -> BTreeMap<SettingKey<'a>, String> {
    let keys: BTreeSet<SettingKey<'_>> = rows.iter().map(|row| setting_key(row)).collect();
    let mut count_of_option: BTreeMap<String, usize> = BTreeMap::new();
    for (_, options, _) in &keys {
        for option in options_of(options).into_iter().collect::<BTreeSet<_>>() {
            *count_of_option.entry(option).or_default() += 1;
        }
    }
    let has_sizes = keys.iter().map(|(.., size)| size).collect::<BTreeSet<_>>().len() > 1;
    let name = |(style, options, size): &SettingKey<'_>| {
        let tells_apart = |option: &String| count_of_option[option] < keys.len() || keys.len() == 1;
        let is_said_already = |option: &String| {
            let size = format!("size {}x{}", size[0], size[1]);
            *option == format!("style {style}") || *option == *style || *option == size
        };
        let mut parts = vec![(*style).to_owned()];
        // A look is what its name says; its options put it into the measured view.
        let is_look = options.starts_with("--look ");
        parts.extend(
            options_of(options)
                .into_iter()
                .filter(|option| !is_look && tells_apart(option) && !is_said_already(option)),
        );
        if has_sizes {
            parts.push(format!("{}×{}", size[0], size[1]));
        }
        if parts.len() == 1 { parts.remove(0) } else { format!("{}: {}", parts.remove(0), parts.join(", ")) }
    };
    keys.iter().map(|key| (*key, name(key))).collect()
}

/// `--filter sobel --cull=back` as "filter sobel" and "cull back".
fn options_of(options: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for word in options.split_whitespace() {
        match (word.strip_prefix("--"), all.last_mut()) {
            (Some(option), _) => all.push(option.replacen('=', " ", 1)),
            (None, Some(option)) => {
                option.push(' ');
                option.push_str(word);
            }
            (None, None) => all.push(word.to_owned()),
        }
    }
    all
}

/// Marks the points that no other one beats: none is at least as fast and as right, and better in one of both.
///
/// Takes the time and error of each. A point with a NaN is never on the front.
pub fn pareto(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1);
    points
        .iter()
        .map(|point| !point.0.is_nan() && !point.1.is_nan() && !points.iter().any(|other| beats(other, point)))
        .collect()
}
