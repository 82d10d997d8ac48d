//! The options of `tinta render` that control the use of a drawing, not its contents: presets and recipes never contain them.

use super::selection::Selection;
use std::path::PathBuf;
use std::sync::LazyLock;
use tinta::plan::Submission;
use tinta::settings::{HasSettings, Kind, Setting, Table, under};
use tinta::{Error, Result};

/// The use of one drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::cli) struct RunSettings {
    pub submission: Submission,
    /// Frames to time; `None` times one to explain it, and none for a record.
    pub frames: Option<u32>,
    pub json: bool,
    pub explain: bool,
    /// Seconds that exact lines may take.
    pub within: Option<f64>,
    pub dump: Option<PathBuf>,
    pub verify: bool,
    pub save_preset: Option<String>,
    pub no_recipe: bool,
}

/// All of them.
pub(in crate::cli) struct OfRun;

impl Selection for OfRun {
    type Of = RunSettings;
}

/// Whether this is one of them.
pub(in crate::cli) fn is_of_one_run(option: &str) -> bool {
    RunSettings::table().has(option)
}

/// The name of an open setting.
const OFF: &str = "off";

impl HasSettings for RunSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<RunSettings>> =
            LazyLock::new(|| Table { settings: settings(), defaults: vec![RunSettings::default()] });
        &TABLE
    }
}

fn settings() -> Vec<Setting<RunSettings>> {
    let frames = Setting::open_field(
        "frames",
        "N",
        OFF,
        "Frames to draw and time after warm-up, with --json or --explain",
        |run: &mut RunSettings| &mut run.frames,
    )
    .whole(1..=1_000_000)
    .range(1.0, 101.0, 0)
    .said("off; 1 with --explain");
    let within = Setting::of(
        "within",
        "SECONDS",
        Kind::Numbers { count: 1, range: [0.1, 60.0], decimals: 1 },
        "Stop after this time if the exact lines are not complete, with an error and no file",
        |run: &RunSettings| run.within.map_or(OFF.to_owned(), |seconds| seconds.to_string()),
        |run, text| {
            let seconds = text.parse().ok().filter(|seconds: &f64| *seconds > 0.0 && seconds.is_finite());
            run.within = match text {
                OFF => None,
                _ => Some(seconds.ok_or_else(|| "write seconds, a number above 0: 5".to_owned())?),
            };
            Ok(())
        },
    );
    let running = vec![
        Setting::field(
            "submission",
            "HOW",
            "How vertices reach GL: buffers, or one by one as in programs of 2001 (immediate); the picture is the same",
            |run: &mut RunSettings| &mut run.submission,
        ),
        frames,
        Setting::flag(
            "json",
            "Print one JSON record: model, style, camera, GL, times",
            |run: &RunSettings| run.json,
            |run, is_on| run.json = is_on,
        ),
        Setting::flag(
            "explain",
            "Print the plan, its passes and steps, with times; for style lines their classes and the breaks in \
             smooth silhouettes",
            |run: &RunSettings| run.explain,
            |run, is_on| run.explain = is_on,
        ),
        within.open(OFF).said("no limit"),
        Setting::open_field(
            "dump",
            "DIR",
            OFF,
            "Write GL's buffers after every step of the published plan into this folder, as RGBA PNG",
            |run: &mut RunSettings| &mut run.dump,
        ),
    ];
    let verify = Setting::flag(
        "verify",
        "Draw twice, with everything skipped and with nothing skipped, and compare; if a pixel differs, exit with 1 \
         and write OUTPUT-difference.png",
        |run: &RunSettings| run.verify,
        |run, is_on| run.verify = is_on,
    );
    let save_preset = Setting::open_field(
        "save-preset",
        "FILE",
        OFF,
        "Save the options of this command line and of --preset as a preset, once the picture is drawn",
        |run: &mut RunSettings| &mut run.save_preset,
    );
    let no_recipe = Setting::flag(
        "no-recipe",
        "Leave out the recipe, with the file names in it; without it `tinta again` cannot redraw the .png or .svg",
        |run: &RunSettings| run.no_recipe,
        |run, is_on| run.no_recipe = is_on,
    );
    under("Skipping work that cannot change the picture", vec![verify])
        .chain(under("Presets", vec![save_preset.like("mine.toml"), no_recipe]))
        .chain(under("Running", running))
        .collect()
}

impl RunSettings {
    /// Whether something is printed of the drawing.
    pub(super) fn is_told(&self) -> bool {
        self.json || self.explain
    }

    /// The first of these that is given.
    fn refuse(given: &[(&str, bool)], problem: &str) -> Result<()> {
        match given.iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => Err(Error::setting(*option, problem)),
            None => Ok(()),
        }
    }

    /// Refuses options of lines.
    pub(super) fn refuse_for_pictures(&self) -> Result<()> {
        let problem = "only exact lines can end before they are done; leave it out, or write a .svg";
        Self::refuse(&[("within", self.within.is_some())], problem)
    }

    /// Refuses options for single pictures.
    pub(super) fn refuse_for_animations(&self) -> Result<()> {
        let given = [("explain", self.explain), ("dump", self.dump.is_some()), ("frames", self.frames.is_some())];
        Self::refuse(&given, "this is for one picture; leave it out, or name a picture such as drawing.png")
    }

    /// Refuses options of pictures.
    pub(super) fn refuse_for_lines(&self) -> Result<()> {
        let problem =
            "vectors have no passes and no model's frames; leave it out, or name a picture such as drawing.png";
        Self::refuse(&[("dump", self.dump.is_some()), ("frames", self.frames.is_some())], problem)?;
        let problem = "vectors are computed, not drawn by passes; leave it out here";
        Self::refuse(&[("verify", self.verify)], problem)
    }
}
