//! Draws a case by every backend, with and without pruning, and takes its measurements.

use super::cases::{Drawing, Study, side_px};
use super::figures::{Exact, Figures, covered_px, darkness, differing_px, doubled_pairs, non_finite};
use super::jitter::{Flips, Popped, flips, jittered};
use super::outcome::Outcome;
use super::variants::Variant;
use crate::compare::InkMask;
use crate::measure::{Ink, shading_of};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;
use tinta::camera::CameraSettings;
use tinta::error::{Error, Result};
use tinta::picture::Picture;
use tinta::plan::prune::prune;
use tinta::renderer::Renderer;
use tinta::request::empty_remark;
use tinta::scene::{Scene, SceneSettings, Size};
use tinta::styles::Show;

/// Steps of a turn, and the number of steps of a full turn: each is one degree in sixty.
const STEPS: usize = 60;
const STEPS_AROUND: u32 = 360 * 60;

/// A drawing's scene with its exact results, once for all styles.
pub(super) struct Subject {
    scene: Scene,
    /// The scene without jitter, with it, and which edges flip.
    exact: Option<(Exact, Exact, Flips)>,
    /// The scene at every step of a turn.
    turn: Vec<Exact>,
    /// The scene that its picture is compared with.
    twin: Option<Scene>,
    figures: Figures,
}

/// The results for a picture of one style by one backend.
pub(super) struct CasePicture {
    pub picture: Picture,
    pub figures: Figures,
}

impl Subject {
    /// Builds the scene for a backend's largest picture, and studies it.
    pub(super) fn new(drawing: &Drawing, largest: Size, folder: &Path) -> Result<Self> {
        let scene = scene(drawing, largest, folder)?;
        let mut subject = Self {
            figures: Figures::from([
                ("non_finite", non_finite(&scene) as f64),
                ("far_said", f64::from(scene.far_remark().is_some())),
            ]),
            scene,
            exact: None,
            turn: Vec::new(),
            twin: None,
        };
        let aspect = drawing.matrix.as_ref().map(CameraSettings::aspect_of_clip_from_world);
        subject.figures.extend(aspect.map(|aspect| ("matrix_aspect", aspect)));
        // In a large scene copies share a mesh, and so do pairs.
        if drawing.copies == 1 {
            subject.figures.insert("doubled_pairs", doubled_pairs(&subject.scene) as f64);
        }
        match drawing.study {
            Study::Picture => {}
            Study::Full => {
                let exact = Exact::of(subject.scene.clone())?;
                let moved = jittered(&subject.scene);
                let flips = flips(&subject.scene, &moved);
                subject.figures.extend(exact.figures());
                subject.exact = Some((exact, Exact::of(moved)?, flips));
            }
            Study::Turn => {
                let cameras = subject.scene.turntable(&drawing.camera, STEPS_AROUND)?;
                for camera in cameras.into_iter().take(STEPS + 1) {
                    subject.turn.push(Exact::of(Scene { camera, ..subject.scene.clone() })?);
                }
            }
        }
        if let Some(twin) = &drawing.twin {
            subject.twin = Some(self::scene(twin, largest, folder)?);
        }
        subject.figures.extend(subject.twin_lines()?);
        Ok(subject)
    }

    fn twin_lines(&self) -> Result<Option<(&'static str, f64)>> {
        let (Some(twin), Some((exact, ..))) = (&self.twin, &self.exact) else { return Ok(None) };
        let [twin, here] = [Exact::of(twin.clone())?.lines(), exact.lines()];
        Ok(Some(("twin_lines_differing", here.differing(&twin) as f64 / twin.count().max(1) as f64)))
    }

    /// Draws it in a style; `is_first` for the backend that also measures the effect of a jitter or a turn.
    pub(super) fn draw(&self, renderer: &mut Renderer, variant: &Variant, is_first: bool) -> Result<CasePicture> {
        let style = &variant.style;
        let plan = style.plan(&self.scene, Show::Final)?;
        let pruning = renderer.pruning();
        let picture = renderer.draw(&self.scene, &prune(&plan, &self.scene, &pruning).plan)?;
        let full = renderer.draw(&self.scene, &plan)?;
        let mut figures = self.figures.clone();
        let empty_said = empty_remark(&self.scene, &plan, None, &picture, renderer)?.is_some();
        let covered_px = covered_px(&picture);
        figures.extend([
            ("covered_px", covered_px),
            ("darkness", darkness(&picture)),
            ("empty_said", f64::from(empty_said)),
            ("silently_empty", f64::from(covered_px == 0.0 && !empty_said)),
        ]);
        figures.insert("pruned_differing_px", differing_px(&picture, &full));
        if let Some(twin) = &self.twin {
            let twin = renderer.draw(twin, &style.plan(twin, Show::Final)?)?;
            figures.insert("twin_differing", differing_px(&twin, &full) / twin.size.pixel_count() as f64);
        }
        if is_first {
            self.study(renderer, variant, &mut figures)?;
        }
        Ok(CasePicture { picture, figures })
    }

    fn study(&self, renderer: &mut Renderer, variant: &Variant, figures: &mut Figures) -> Result<()> {
        if let Some((exact, moved, flips)) = &self.exact {
            figures.insert("edges_flipped", flips.exact as f64);
            figures.insert("edges_flipped_paper", flips.published as f64);
            figures.insert("edges_flipped_unexplained", flips.unexplained as f64);
            let before = Shown::of(renderer, &exact.scene, variant)?;
            if let Some(ink) = before.ink.as_ref().filter(|_| variant.style.has_lines()) {
                let error = ink.error(&exact.reference, 2.0);
                figures.extend([
                    ("ink_px", ink.mask().count() as f64),
                    ("recall", error.recall),
                    ("precision", error.precision),
                ]);
                figures.insert("f1", error.f1);
            }
            let after = Shown::of(renderer, &moved.scene, variant)?;
            note("jitter", &Popped::of([exact, moved], variant, [&before, &after])?, figures);
        }
        if let Some((first, others)) = self.turn.split_first() {
            let mut sum = Sums::default();
            let (mut exact, mut shown) = (first, Shown::of(renderer, &first.scene, variant)?);
            for next in others {
                let after = Shown::of(renderer, &next.scene, variant)?;
                sum.add(&Popped::of([exact, next], variant, [&shown, &after])?);
                (exact, shown) = (next, after);
            }
            note("turn", &sum.mean(), figures);
        }
        Ok(())
    }
}

/// A style's lines and its shading, separately.
struct Shown {
    ink: Option<Ink>,
    shading: Picture,
}

impl Shown {
    fn of(renderer: &mut Renderer, scene: &Scene, variant: &Variant) -> Result<Self> {
        let style = &variant.style;
        let shading = renderer.draw(scene, &style.plan(scene, shading_of(style))?)?;
        Ok(Self { ink: Ink::of_style(renderer, scene, style)?, shading })
    }

    fn mask(&self) -> Option<InkMask> {
        self.ink.as_ref().map(Ink::mask)
    }
}

impl Popped {
    fn of(exact: [&Exact; 2], variant: &Variant, shown: [&Shown; 2]) -> Result<Self> {
        let [before, after] = shown;
        let ink = [&before.mask(), &after.mask()];
        Self::between(exact, &variant.style, ink, [&before.shading, &after.shading])
    }
}

/// Means over the steps of a turn.
#[derive(Default)]
struct Sums {
    ink: Option<[f64; 2]>,
    shades: Option<[f64; 2]>,
    steps: f64,
}

impl Sums {
    fn add(&mut self, step: &Popped) {
        let sum = |sum: &mut Option<[f64; 2]>, more: Option<[f64; 2]>| {
            if let Some([drawn, exact]) = more {
                let [all_drawn, all_exact] = sum.unwrap_or_default();
                *sum = Some([all_drawn + drawn, all_exact + exact]);
            }
        };
        sum(&mut self.ink, step.ink);
        sum(&mut self.shades, step.shades);
        self.steps += 1.0;
    }

    fn mean(&self) -> Popped {
        let mean = |sum: Option<[f64; 2]>| sum.map(|sum| sum.map(|sum| sum / self.steps.max(1.0)));
        Popped { ink: mean(self.ink), shades: mean(self.shades) }
    }
}

/// Writes the popped ink into the figures: of the drawing, and of the exact scene.
fn note(what: &'static str, popped: &Popped, figures: &mut Figures) {
    let names = match what {
        "jitter" => ["jitter_ink", "jitter_lines", "jitter_shades", "jitter_exact_shades"],
        _ => ["turn_ink", "turn_lines", "turn_shades", "turn_exact_shades"],
    };
    if let Some([drawn, exact]) = popped.ink {
        figures.extend([(names[0], drawn), (names[1], exact)]);
    }
    if let Some([drawn, exact]) = popped.shades {
        figures.extend([(names[2], drawn), (names[3], exact)]);
    }
}

/// The scene of a drawing; sizes that stand for a backend's largest become it.
fn scene(drawing: &Drawing, largest: Size, folder: &Path) -> Result<Scene> {
    let mesh = drawing.shape.mesh(drawing.scale, drawing.offset, folder)?;
    let place = |point: DVec3| point * drawing.scale + drawing.offset;
    let of_matrix = |matrix| {
        CameraSettings::of_clip_from_world(&matrix).map_err(|error| Error::value("camera", "matrix", error.to_string()))
    };
    let camera = CameraSettings {
        eye: drawing.camera.eye.map(place),
        target: drawing.camera.target.map(place),
        near: drawing.camera.near.map(|near| near * drawing.scale),
        far: drawing.camera.far.map(|far| far * drawing.scale),
        ..drawing.camera.clone()
    };
    let camera = drawing.matrix.map_or(Ok(camera), of_matrix)?;
    let size = Size {
        width: side_px(drawing.size.width, largest.width),
        height: side_px(drawing.size.height, largest.height),
    };
    let settings = SceneSettings { camera, size, copies: drawing.copies, ..SceneSettings::default() };
    Scene::new(vec![Arc::new(mesh)], &settings)
}

/// Carries out a drawing in every style by every backend.
pub(super) fn outcomes(
    drawing: &Drawing,
    renderers: &mut [(&'static str, Renderer)],
    folder: &Path,
    mut report: impl FnMut(&Variant, &'static str, Outcome),
) {
    // All backends draw the same scene, except cases with each backend's largest size.
    let mut subjects: Vec<(Size, std::result::Result<Subject, tinta::Error>)> = Vec::new();
    for (_, renderer) in renderers.iter() {
        let largest = renderer.context().largest_picture;
        if !subjects.iter().any(|(known, _)| *known == largest) && (subjects.is_empty() || drawing.is_of_largest()) {
            subjects.push((largest, Subject::new(drawing, largest, folder)));
        }
    }
    for variant in &drawing.variants {
        let mut first: Option<Picture> = None;
        for (index, (backend, renderer)) in renderers.iter_mut().enumerate() {
            let largest = renderer.context().largest_picture;
            let subject = subjects.iter().find(|(known, _)| *known == largest).or(subjects.first());
            let Some((_, subject)) = subject else { continue };
            let outcome = match subject {
                Err(error) => Outcome::refused(error),
                Ok(subject) => match subject.draw(renderer, variant, index == 0) {
                    Err(error) => Outcome::refused(&error),
                    Ok(mut drawn) => {
                        if let Some(first) = first.as_ref().filter(|first| first.size == drawn.picture.size) {
                            drawn.figures.insert("backends_differing_px", differing_px(first, &drawn.picture));
                        }
                        first.get_or_insert(drawn.picture);
                        Outcome::Rendered(drawn.figures)
                    }
                },
            };
            report(variant, backend, outcome);
        }
    }
}
