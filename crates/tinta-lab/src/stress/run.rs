//! Runs cases, several at once, and judges them.

use super::cases::{Case, Demand, Group, Work, cases};
use super::figures::{ANSWERS, Figures};
use super::outcome::Outcome;
use super::{drawing, failing, reading};
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use tinta::choice::Choice;
use tinta::error::{Error, Result};
use tinta::gl::Backend;
use tinta::gl::context::witnesses;
use tinta::renderer::Renderer;
use tinta_geometry::threads::cores;

/// The cases and their backends.
#[derive(Debug, Clone, PartialEq)]
pub struct StressSettings {
    /// Where the mixes' random numbers begin. Default 0.
    pub seed: u64,
    /// How many mixes. Default 24.
    pub mixes: usize,
    /// Only cases with this text in their name or group; default all.
    pub only: Option<String>,
    /// The backends, each of which must draw the same; missing ones are left out. Default [`witnesses`].
    pub backends: Vec<Backend>,
}

impl Default for StressSettings {
    fn default() -> Self {
        Self { seed: 0, mixes: 24, only: None, backends: witnesses().to_vec() }
    }
}

impl StressSettings {
    /// The cases they choose.
    fn cases(&self) -> Result<Vec<Case>> {
        let mut chosen = cases(self.seed, self.mixes);
        let Some(only) = &self.only else { return Ok(chosen) };
        let group = |case: &Case| format!("{:?}", case.group).to_lowercase();
        chosen.retain(|case| group(case) == *only || (!only.is_empty() && case.name.contains(only.as_str())));
        match chosen.is_empty() {
            false => Ok(chosen),
            true => Err(Error::value(
                "only",
                only,
                "no case has this in its name; give some of a name, or a group: scale, depth, topology, thresholds, pictures, \
                 inputs, mixes, turns, files or faults",
            )),
        }
    }

    /// Whether there is anything to do.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] when no case has such a name.
    pub fn check(&self) -> Result<()> {
        self.cases().map(drop)
    }
}

/// One case in one style by one backend.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The case.
    pub name: String,
    /// Its group.
    pub group: Group,
    /// The style with the options that make it.
    pub style: String,
    /// The backend.
    pub backend: &'static str,
    /// Its outcome: rendered, or refused with a kind of error.
    pub verdict: String,
    /// The required outcome.
    pub expected: String,
    /// The kind of the right answer: holds, degrades as computed, refused.
    pub kind: &'static str,
    /// The right answer in words; empty where outcome and figures say it all.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub answer: &'static str,
    /// Whether it did, and every figure is as it must be.
    pub passed: bool,
    /// The fault, or the error's sentence.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Its figures by name; see docs/results/stability.md.
    pub figures: Figures,
}

/// All rows, in the cases' order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// tinta's version.
    pub version: &'static str,
    /// GL_RENDERER of each backend that took part.
    pub renderers: Vec<String>,
    /// The missing backends, which have no results.
    pub missing: Vec<MissingBackend>,
    /// How many cases there were.
    pub case_count: usize,
    /// The rows.
    pub cases: Vec<Row>,
}

/// A backend that could not be opened.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MissingBackend {
    /// Its backend's name.
    pub backend: &'static str,
    /// The attempts and why they failed.
    pub reason: String,
}

impl Summary {
    /// Rows that did not end as their case requires.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.cases.iter().filter(|row| !row.passed)
    }
}

/// Figures that must be 0 wherever they are known: no infinite value, no visible omission, no difference between backends, no
/// edge that flips without cause, no empty picture without a remark.
const ALWAYS_NONE: [&str; 5] =
    ["non_finite", "pruned_differing_px", "backends_differing_px", "edges_flipped_unexplained", "silently_empty"];

impl Demand {
    fn text(&self) -> String {
        match self {
            Self::Rendered => "rendered".to_owned(),
            Self::Refused { kind, words } => format!("refused ({kind}), naming \"{words}\""),
            Self::Either(kinds) => format!("rendered, or refused ({})", kinds.join(", ")),
        }
    }

    /// The fault of an outcome, if any.
    fn fault(&self, outcome: &Outcome) -> Option<String> {
        match (self, outcome) {
            (Self::Rendered | Self::Either(_), Outcome::Rendered(_)) => None,
            (Self::Refused { kind, words }, Outcome::Refused { kind: actual, sentence }) => {
                let is_named = actual == kind && sentence.contains(words);
                (!is_named).then(|| format!("refused for another reason: {sentence}"))
            }
            (Self::Either(kinds), Outcome::Refused { kind, sentence }) => {
                (!kinds.contains(kind)).then(|| format!("refused for another reason: {sentence}"))
            }
            (Self::Rendered, Outcome::Refused { sentence, .. }) => Some(sentence.clone()),
            (Self::Refused { .. }, Outcome::Rendered(_)) => Some("rendered all the same".to_owned()),
            (_, Outcome::Panicked) => Some("panicked; see the message above".to_owned()),
        }
    }
}

fn row(case: &Case, style: &str, backend: &'static str, outcome: Outcome) -> Row {
    let mut faults: Vec<String> = case.expected.fault(&outcome).into_iter().collect();
    let verdict = outcome.verdict();
    let (figures, sentence) = match outcome {
        Outcome::Rendered(figures) => (figures, None),
        Outcome::Refused { sentence, .. } => (Figures::new(), Some(sentence)),
        Outcome::Panicked => (Figures::new(), None),
    };
    for (name, value) in &figures {
        let own = case.checks.iter().find(|check| check.figure == *name).map(|check| [check.least, check.most]);
        let common =
            ANSWERS.iter().copied().chain(ALWAYS_NONE.map(|none| (none, 0.0))).find(|(known, _)| known == name);
        let most = common.map_or(f64::INFINITY, |(_, most)| most);
        let [least, most] = own.unwrap_or([f64::NEG_INFINITY, most]);
        if !value.is_finite() || !(least..=most).contains(value) {
            faults.push(format!("{name} is {value}, not between {least} and {most}"));
        }
    }
    let mut answers = case.checks.iter().map(|check| check.figure).chain(ANSWERS.map(|(answer, _)| answer));
    let is_known = answers.any(|answer| figures.contains_key(answer));
    let remark = if faults.is_empty() { sentence } else { Some(faults.join("; ")) };
    Row {
        name: case.name.clone(),
        group: case.group,
        style: style.to_owned(),
        backend,
        verdict,
        expected: case.expected.text(),
        kind: case.kind(is_known),
        answer: case.answer,
        passed: faults.is_empty(),
        remark,
        figures,
    }
}

/// A failure for a check on a figure that no row has: it would check nothing.
fn never_checked(case: &Case, rows: &[Row]) -> Option<Row> {
    let is_known = |figure: &str| rows.iter().any(|row| row.figures.contains_key(figure));
    let missing = case.checks.iter().find(|check| !is_known(check.figure))?;
    let verdict = "unchecked".to_owned();
    let remark = Some(format!("no row says what {} is", missing.figure));
    Some(Row { verdict, remark, passed: false, ..row(case, "", "", Outcome::Rendered(Figures::new())) })
}

/// Carries out all cases, on as many threads as the machine has; `progress` receives the number done and the total.
///
/// # Errors
///
/// [`Error::NoContext`] without any backend, [`Error::Setting`] for an unknown case, [`Error::File`] if the cases' files cannot
/// be placed.
pub fn run(settings: &StressSettings, mut progress: impl FnMut(usize, usize)) -> Result<Summary> {
    let chosen = settings.cases()?;
    let folder = tempfile::tempdir().map_err(|error| {
        let problem = format!("no temporary folder can be made there ({error}); set TMPDIR to one where it can");
        Error::output(std::env::temp_dir(), problem).because(&error)
    })?;
    let folder = folder.path();
    // Before any work: a missing backend would fail every case.
    let (found, missing) = find(&settings.backends)?;
    let (backends, renderers): (Vec<Backend>, Vec<String>) = found.into_iter().unzip();
    let (next, count) = (AtomicUsize::new(0), chosen.len());
    let mut rows: Vec<(usize, Vec<Row>)> = Vec::with_capacity(count);
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..cores().min(count) {
            let (sender, next, chosen, backends) = (sender.clone(), &next, &chosen, &backends);
            scope.spawn(move || {
                let mut worker = Worker { backends, renderers: Vec::new(), folder };
                let take = || chosen.iter().enumerate().nth(next.fetch_add(1, Ordering::Relaxed));
                while let Some((index, case)) = take() {
                    if sender.send((index, worker.carry_out(case))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        progress(0, count);
        for done in receiver {
            rows.push(done);
            progress(rows.len(), count);
        }
    });
    rows.sort_by_key(|(index, _)| *index);
    let cases = rows.into_iter().flat_map(|(_, rows)| rows).collect();
    Ok(Summary { version: env!("CARGO_PKG_VERSION"), renderers, missing, case_count: count, cases })
}

/// A backend and its renderer's name.
type NamedBackend = (Backend, String);

/// The available ones of the requested backends with their renderers' names, and the missing ones; an error if none opens.
fn find(asked: &[Backend]) -> Result<(Vec<NamedBackend>, Vec<MissingBackend>)> {
    let (mut found, mut missing, mut all_attempts) = (Vec::new(), Vec::new(), Vec::new());
    for backend in asked {
        match Renderer::new(*backend) {
            Ok(renderer) => found.push((*backend, renderer.context().renderer.clone())),
            Err(Error::NoContext { attempts }) => {
                missing.push(MissingBackend { backend: backend.choice_name(), reason: attempts.join("; ") });
                all_attempts.extend(attempts);
            }
            Err(error) => return Err(error),
        }
    }
    if found.is_empty() { Err(Error::NoContext { attempts: all_attempts }) } else { Ok((found, missing)) }
}

/// A thread with its own contexts.
struct Worker<'a> {
    backends: &'a [Backend],
    renderers: Vec<(&'static str, Renderer)>,
    folder: &'a Path,
}

impl Worker<'_> {
    fn carry_out(&mut self, case: &Case) -> Vec<Row> {
        let mut rows = Vec::new();
        let attempt = catch_unwind(AssertUnwindSafe(|| {
            if self.renderers.is_empty() {
                let open = |backend: &Backend| Ok((backend.choice_name(), Renderer::new(*backend)?));
                match self.backends.iter().map(open).collect() {
                    Ok(renderers) => self.renderers = renderers,
                    Err(error) => rows.push(row(case, "", "", Outcome::refused(&error))),
                }
            }
            match &case.work {
                Work::Draw(drawing) => {
                    drawing::outcomes(drawing, &mut self.renderers, self.folder, |style, backend, outcome| {
                        rows.push(row(case, style, backend, outcome));
                    });
                }
                Work::Read(name, content) => {
                    rows.push(row(case, "", "", reading::outcome(&self.folder.join(name), content)));
                }
                Work::Fail(fault, variant) => {
                    for (backend, (name, renderer)) in self.backends.iter().zip(&mut self.renderers) {
                        let outcome = failing::outcome(*backend, *fault, variant, renderer);
                        rows.push(row(case, &variant.name, name, outcome));
                    }
                }
            }
        }));
        if attempt.is_err() {
            // State left behind by a panic cannot be trusted.
            self.renderers.clear();
            rows.push(row(case, "", "", Outcome::Panicked));
        }
        rows.extend(never_checked(case, &rows));
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(expected: Demand, outcome: Outcome) -> Row {
        let case = cases(0, 0).swap_remove(0);
        row(&Case { expected, checks: Vec::new(), ..case }, "style", "egl", outcome)
    }

    #[test]
    fn an_outcome_that_is_not_the_expected_one_fails() {
        let refused = || Outcome::Refused { kind: "setting", sentence: "--fov 0: too small".to_owned() };
        let naming = |words| Demand::Refused { kind: "setting", words };
        assert!(judged(naming("--fov"), refused()).passed);
        assert!(!judged(naming("--eye"), refused()).passed);
        assert!(!judged(Demand::Refused { kind: "model", words: "--fov" }, refused()).passed);
        assert!(!judged(Demand::Rendered, refused()).passed);
        assert!(judged(Demand::Either(&["setting"]), refused()).passed);
        assert!(!judged(Demand::Either(&["gl"]), refused()).passed);
        assert!(!judged(naming("--fov"), Outcome::Rendered(Figures::new())).passed);
        assert!(!judged(Demand::Either(&["setting"]), Outcome::Panicked).passed);
    }

    #[test]
    fn figures_that_are_not_as_they_must_be_fail() {
        let drawn = |name: &'static str, value: f64| {
            judged(Demand::Rendered, Outcome::Rendered(Figures::from([(name, value)])))
        };
        assert!(drawn("covered_px", 7.0).passed);
        assert!(!drawn("covered_px", f64::NAN).passed);
        for name in ALWAYS_NONE {
            assert!(drawn(name, 0.0).passed && !drawn(name, 1.0).passed, "{name}");
        }
    }
}
