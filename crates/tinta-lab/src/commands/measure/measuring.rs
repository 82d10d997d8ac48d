//! Measures a group: references once, then the settings in turns, and the exact lines by their rules.

use super::errors::is_shown;
use super::groups::{Group, KINDS};
use super::look::measure_look;
use super::results::{Results, is_of};
use super::settings::{HowMeasured, settings, smooth_inking, varied};
use crate::measure::{
    Against, MeasureSettings, MeasureStep, MeasuredStyle, Subject, line_options, measure, measure_lines, turns,
};
use tinta::cli::progress::TimedProgress;
use tinta::cli::say;
use tinta::edges::SilhouetteRule;
use tinta::preset::LOOKS;
use tinta::recipe::{option_word, option_words};
use tinta::request::{OptionLayer, Request};
use tinta::settings::{HasSettings, Kind, OptionValue, Options};
use tinta::{LoadOptions, Renderer, Result, SceneSettings, Style};

/// Timed frames of a setting.
const FRAMES: [usize; 2] = [21, 7];

/// Number of timed searches for exact lines.
const FRAMES_OF_LINES: usize = 3;

/// Settings whose frames are timed in turns.
const SETTINGS_IN_TURN: usize = 8;

/// The measurements of every group.
pub(super) struct Measuring {
    pub(super) settings: Vec<MeasuredStyle>,
    pub(super) how: MeasureSettings,
    pub(super) against: Against,
    /// The options that every row of the run has.
    of_scene: String,
    /// What draws exact lines: the default look, and the reference itself, the ceiling of every size; each with its row's options.
    exact: Vec<(&'static str, Request, String)>,
}

impl Measuring {
    /// The measurement as requested, with the options of the scene; `own_setting` is a preset's style.
    pub(super) fn asked(asked: &HowMeasured, request: &Request, own_setting: Option<MeasuredStyle>) -> Result<Self> {
        let how = MeasureSettings {
            tolerance: asked.tolerance,
            frames: asked.frames.map_or(FRAMES[usize::from(asked.quick)], |frames| frames as usize),
            machine: asked
                .machine
                .clone()
                .filter(|name| !name.trim().is_empty())
                .unwrap_or_else(|| MeasureSettings::default().machine),
        };
        how.check()?;
        let of_scene = scene_options(&request.options);
        let against = asked.against.unwrap_or_default();
        let mut settings = match &asked.vary {
            Some(vary) => varied(&asked.styles, vary)?,
            None => settings(&asked.styles, asked.quick)?,
        };
        if against == Against::Smooth && settings.iter().any(|setting| matches!(setting.style, Style::Inking(_))) {
            settings.push(smooth_inking()?);
        }
        // A preset's style is measured with the others, unless it is one of them.
        if let Some(setting) = own_setting.filter(|own| settings.iter().all(|other| other.style != own.style)) {
            settings.push(setting);
        }
        settings.iter_mut().for_each(|setting| setting.options.push_str(&of_scene));
        let has_look = against == Against::Lines && asked.vary.is_none() && asked.styles.is_empty();
        let has_ceiling = has_look || (against == Against::Lines && asked.sizes.len() > 1);
        let look = has_look.then(|| exact(request, OptionLayer::Look(LOOKS[0]), &[("look", LOOKS[0].name)]));
        let given = CEILING.map(|(name, value)| (name.to_owned(), OptionValue::text(value)));
        let ceiling = has_ceiling.then(|| exact(request, OptionLayer::Given(given.into()), &CEILING));
        let exact = look.into_iter().chain(ceiling).collect::<Result<_>>()?;
        Ok(Self { settings, how, against, of_scene, exact })
    }

    /// Measures the group of this number, except settings already in the results.
    pub(super) fn measure(
        &self,
        renderer: &mut Renderer,
        number: usize,
        group: Group,
        results: &mut Results<'_>,
        progress: &TimedProgress,
    ) -> Result<()> {
        let [reference, errors, turn] = KINDS.map(|kind| number * KINDS.len() + kind);
        let subject = match &group.surface {
            None => Subject::new(&group.model, group.scene, group.load_ms)?,
            Some(surface) => Subject::of_surface(&group.model, group.scene, surface, group.load_ms)?,
        };
        progress.step(reference);
        results.show_known(|row| is_of(row, &subject, &self.how.machine) && is_shown(row));
        let is_known = |options: &str| {
            results.rows.iter().any(|row| is_of(row, &subject, &self.how.machine) && row.options == options)
        };
        let left: Vec<MeasuredStyle> =
            self.settings.iter().filter(|setting| !is_known(&setting.options)).cloned().collect();
        let rules = self.rules().into_iter().filter(|(_, options)| !is_known(options));
        let rules: Vec<(SilhouetteRule, String)> = rules.collect();
        let exact = self.exact.iter().filter(|(.., options)| !is_known(options)).collect::<Vec<_>>();
        progress.skip(errors, self.settings.len() - left.len());
        progress.skip(turn, (self.settings.len() - left.len()) * turns(self.how.frames));
        // Settings take turns in groups: rows reach the disk soon and an interruption costs little.
        for some in left.chunks(SETTINGS_IN_TURN) {
            let step = |step| progress.step(if step == MeasureStep::Errors { errors } else { turn });
            let (measured, left_out) = measure(renderer, &subject, some, &self.how, step)?;
            progress.skip(turn, left_out.len() * turns(self.how.frames));
            left_out.iter().for_each(|reason| say(&format!("tinta: {reason}")));
            measured.into_iter().try_for_each(|measured| results.keep(measured))?;
        }
        for (name, request, options) in exact {
            results.keep(measure_look(renderer, &subject, (*name, request), options.clone(), &self.how)?)?;
        }
        for (rule, options) in rules {
            results.keep(measure_lines(&subject, rule, options, FRAMES_OF_LINES, &self.how)?)?;
        }
        Ok(())
    }

    /// The rules for measuring exact lines, each with its row's options.
    fn rules(&self) -> Vec<(SilhouetteRule, String)> {
        let rules: &[SilhouetteRule] = match self.against {
            Against::Lines => &[],
            Against::Smooth => &[SilhouetteRule::Exact, SilhouetteRule::Smooth],
        };
        rules.iter().map(|rule| (*rule, line_options(*rule, &self.of_scene))).collect()
    }
}

/// The options of the reference itself, drawn by the pen of two pixels.
const CEILING: [(&str, &str); 3] = [("style", "lines"), ("crease-angle", "66.42182"), ("min-length", "0")];

/// A drawing of exact lines: its row's name, and the options that draw it in the measured view; the first gives the name.
fn exact(
    measured: &Request,
    layer: OptionLayer,
    own: &[(&str, &'static str)],
) -> Result<(&'static str, Request, String)> {
    let (request, _) = Request::from_layers(&[layer])?;
    let mut options = SceneSettings::table().options(&measured.scene, &request.scene)?;
    options.extend(LoadOptions::table().options(&measured.read, &request.read)?);
    // Each row names its size.
    options.remove("size");
    let own_words = own.iter().flat_map(|(name, value)| [format!("--{name}"), (*value).to_owned()]);
    let words = own_words.chain(options.iter().flat_map(|(name, value)| option_words(name, value)));
    let text = words.map(|word| tinta::shell::quoted(&word)).collect::<Vec<_>>().join(" ");
    Ok((own[0].1, request, text))
}

/// The user's options of camera and model, which are needed to draw a row again.
fn scene_options(options: &Options) -> String {
    // The refusal of defects does not change a picture, and files outside the folder are the user's decision.
    let is_flag = |name: &str| {
        LoadOptions::table().settings.iter().any(|setting| setting.name == name && setting.kind == Kind::Flag)
    };
    let kept = options.iter().filter(|(name, _)| !is_flag(name));
    kept.filter_map(|(name, value)| option_word(name, value))
        .fold(String::new(), |options, word| options + " " + &tinta::shell::quoted(&word))
}
