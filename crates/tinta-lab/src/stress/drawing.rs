//! Draws a case by every backend, with and without pruning, and takes its measurements.

use super::cases::{Drawing, Study, side_px};
use super::figures::{
    ANSWERS, Exact, Figures, covered_px, darkness, differing_px, doubled_pairs, non_finite, popped, shades_popped,
};
use super::jitter::{Flips, PoppedShares, flips, jittered};
use super::outcome::Outcome;
use super::variants::Variant;
use crate::compare::InkMask;
use crate::measure::{Ink, LineError, shading_of};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;
use tinta::camera::CameraSettings;
use tinta::error::{Error, Result};
use tinta::lines::Progress;
use tinta::mesh::LoadOptions;
use tinta::picture::Picture;
use tinta::plan::prune::{PrunedPlan, prune};
use tinta::preset::LOOKS;
use tinta::renderer::Renderer;
use tinta::request::{OptionLayer, Request, empty_remark};
use tinta::scene::{Scene, SceneSettings, Size};
use tinta::styles::Show;

/// Steps of a turn, and the number of steps of a full turn: each is one degree in sixty.
const STEPS: usize = 60;
const STEPS_AROUND: u32 = 360 * 60;

/// The figures of what pops by a jitter, and by a step of a turn.
const OF_JITTER: [&str; 4] = ["jitter_ink", "jitter_lines", "jitter_shades", "jitter_exact_shades"];
const OF_TURN: [&str; 4] = ["turn_ink", "turn_lines", "turn_shades", "turn_exact_shades"];

/// Distance within which ink and line count as the same.
const TOLERANCE_PX: f64 = 2.0;

/// Least length of lines that judge a look, pixels: what is shorter is hardly there.
const LEAST_LINES_PX: f64 = 50.0;

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

/// A picture of one style by one backend, and its results.
type Trial = (Picture, Figures);

impl Subject {
    /// Builds the scene for a backend's largest picture, and studies it.
    pub(super) fn new(drawing: &Drawing, largest: Size, folder: &Path) -> Result<Self> {
        let scene = scene(drawing, largest, folder, &LoadOptions::default())?;
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
                subject.figures.extend(exact.figures()?);
                subject.figures.extend(subject.off_closed_form(drawing));
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
            subject.twin = Some(self::scene(twin, largest, folder, &LoadOptions::default())?);
        }
        subject.figures.extend(subject.twin_lines()?);
        Ok(subject)
    }

    /// By how much its lines and areas miss the closed form that its shape has.
    fn off_closed_form(&self, drawing: &Drawing) -> Option<(&'static str, f64)> {
        let mut shape = drawing.shape.unhidden().filter(|_| drawing.copies == 1)?;
        shape.points.iter_mut().for_each(|point| *point = *point * drawing.scale + drawing.offset);
        let off = shape.figures(&self.scene)?.into_iter().map(|(name, value)| (value - self.figures[name]).abs());
        Some(("off_closed_form", off.fold(0.0, f64::max)))
    }

    fn twin_lines(&self) -> Result<Option<(&'static str, f64)>> {
        let (Some(twin), Some((exact, ..))) = (&self.twin, &self.exact) else { return Ok(None) };
        let [twin, here] = [Exact::of(twin.clone())?.lines(), exact.lines()];
        Ok(Some(("twin_lines_differing", here.differing(&twin) as f64 / twin.count().max(1) as f64)))
    }

    /// The figures of any of its pictures, and of the same drawn in full.
    fn figures(&self, picture: &Picture, full: &Picture, empty_said: bool) -> Figures {
        let covered_px = covered_px(picture);
        let mut figures = self.figures.clone();
        figures.extend([
            ("covered_px", covered_px),
            ("darkness", darkness(picture)),
            ("empty_said", f64::from(empty_said)),
            ("silently_empty", f64::from(covered_px == 0.0 && !empty_said)),
            ("pruned_differing_px", differing_px(picture, full)),
        ]);
        figures
    }

    /// Draws it in a style; `is_first` for the backend that also measures the effect of a jitter or a turn.
    pub(super) fn draw(&self, renderer: &mut Renderer, variant: &Variant, is_first: bool) -> Result<Trial> {
        let style = &variant.style;
        let plan = style.plan(&self.scene, Show::Final)?;
        let pruning = renderer.pruning();
        let picture = renderer.draw(&self.scene, &prune(&plan, &self.scene, &pruning).plan)?;
        let full = renderer.draw(&self.scene, &plan)?;
        let empty_said = empty_remark(&self.scene, &plan, None, &picture, renderer)?.is_some();
        let mut figures = self.figures(&picture, &full, empty_said);
        if let Some(twin) = &self.twin {
            let twin = renderer.draw(twin, &style.plan(twin, Show::Final)?)?;
            figures.insert("twin_differing", differing_px(&twin, &full) / twin.size.pixel_count() as f64);
            figures.insert("twin_darker", darkness(&twin) - darkness(&full));
        }
        if is_first {
            self.study(renderer, variant, &mut figures)?;
        }
        Ok((picture, figures))
    }

    /// Draws the default look, as `tinta render` does: its lines must be the exact ones.
    fn draw_look(&self, drawing: &Drawing, folder: &Path, renderer: &mut Renderer, is_first: bool) -> Result<Trial> {
        let (request, _) = Request::from_layers(&[OptionLayer::Look(LOOKS[0])])?;
        let scene = scene(drawing, renderer.context().largest_picture, folder, &request.read)?;
        let look = request.still(scene, false)?;
        let (published, PrunedPlan { plan, .. }) = look.plans(renderer)?;
        let around = look.around(&Progress::default())?;
        let picture = around.drawn(&look, &plan, renderer)?;
        let full = around.drawn(&look, &published, renderer)?;
        let empty_said = empty_remark(look.lit(), &published, Some(&around), &picture, renderer)?.is_some();
        let mut figures = self.figures(&picture, &full, empty_said);
        let exact = self.exact.as_ref().filter(|(exact, ..)| is_first && exact.reference.length_px() > LEAST_LINES_PX);
        if let Some((exact, ..)) = exact {
            let alone = around.lines_alone(&plan, look.scene.size);
            let darkness = alone.pixels.chunks_exact(4).map(|pixel| pixel[3]).collect();
            figures.extend(found(&Ink { size: alone.size, darkness }.error(&exact.reference, TOLERANCE_PX)));
            figures.insert("look_lines_off", 1.0 - figures["f1"]);
        }
        Ok((picture, figures))
    }

    fn study(&self, renderer: &mut Renderer, variant: &Variant, figures: &mut Figures) -> Result<()> {
        if let Some((exact, moved, flips)) = &self.exact {
            figures.insert("edges_flipped", flips.exact as f64);
            figures.insert("edges_flipped_paper", flips.published as f64);
            figures.insert("edges_flipped_unexplained", flips.unexplained as f64);
            let before = InkAndShading::of(renderer, &exact.scene, variant)?;
            if let Some(ink) = before.ink.as_ref().filter(|_| variant.style.has_lines()) {
                figures.insert("ink_px", ink.mask().count() as f64);
                figures.extend(found(&ink.error(&exact.reference, TOLERANCE_PX)));
            }
            // Charcoal also draws its paper, where rays meet nothing; of two faces in one place either may show.
            let is_known = self.figures.get("doubled_pairs") <= Some(&0.0) && !variant.name.starts_with("charcoal");
            if let Some(by_rays) = exact.shading(&variant.style)?.filter(|_| is_known) {
                figures.insert("shades_differing", shades_popped(&before.shading, &by_rays));
            }
            let after = InkAndShading::of(renderer, &moved.scene, variant)?;
            note(OF_JITTER, &PoppedShares::of([exact, moved], variant, [&before, &after])?, figures);
        }
        if let Some((first, others)) = self.turn.split_first() {
            let mut steps = Vec::new();
            let (mut exact, mut shown) = (first, InkAndShading::of(renderer, &first.scene, variant)?);
            for next in others {
                let after = InkAndShading::of(renderer, &next.scene, variant)?;
                steps.push(PoppedShares::of([exact, next], variant, [&shown, &after])?);
                (exact, shown) = (next, after);
            }
            note(OF_TURN, &mean(&steps), figures);
        }
        Ok(())
    }
}

/// Its figures.
fn found(error: &LineError) -> [(&'static str, f64); 3] {
    [("recall", error.recall), ("precision", error.precision), ("f1", error.f1)]
}

/// A style's lines and its shading, separately.
struct InkAndShading {
    ink: Option<Ink>,
    shading: Picture,
}

impl InkAndShading {
    fn of(renderer: &mut Renderer, scene: &Scene, variant: &Variant) -> Result<Self> {
        let style = &variant.style;
        let shading = renderer.draw(scene, &style.plan(scene, shading_of(style))?)?;
        Ok(Self { ink: Ink::of_style(renderer, scene, style)?, shading })
    }

    fn mask(&self) -> Option<InkMask> {
        self.ink.as_ref().map(Ink::mask)
    }
}

impl PoppedShares {
    /// Compares a style's ink and shading before and after.
    fn of([before, after]: [&Exact; 2], variant: &Variant, [was, is]: [&InkAndShading; 2]) -> Result<Self> {
        let ink = was.mask().zip(is.mask());
        let ink = ink.map(|(was, is)| [popped(&was, &is), popped(&before.lines(), &after.lines())]);
        let exact = before.shading(&variant.style)?.zip(after.shading(&variant.style)?);
        let shown = shades_popped(&was.shading, &is.shading);
        Ok(Self { ink, shades: exact.map(|(before, after)| [shown, shades_popped(&before, &after)]) })
    }
}

/// The means over the steps of a turn.
fn mean(steps: &[PoppedShares]) -> PoppedShares {
    let mean = |of: fn(&PoppedShares) -> Option<[f64; 2]>| {
        let all: Vec<[f64; 2]> = steps.iter().filter_map(of).collect();
        let share = |which: usize| all.iter().map(|both| both[which]).sum::<f64>() / steps.len() as f64;
        (!all.is_empty()).then(|| [0, 1].map(share))
    };
    PoppedShares { ink: mean(|step| step.ink), shades: mean(|step| step.shades) }
}

/// Writes the popped ink into the figures: of the drawing, and of the exact scene.
fn note(names: [&'static str; 4], popped: &PoppedShares, figures: &mut Figures) {
    figures.extend(names[..2].iter().copied().zip(popped.ink.into_iter().flatten()));
    figures.extend(names[2..].iter().copied().zip(popped.shades.into_iter().flatten()));
}

/// The scene of a drawing; sizes that stand for a backend's largest become it.
pub(super) fn scene(drawing: &Drawing, largest: Size, folder: &Path, options: &LoadOptions) -> Result<Scene> {
    let mesh = drawing.shape.mesh(drawing.scale, drawing.offset, folder, options)?;
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
    mut report: impl FnMut(&str, &'static str, Outcome),
) {
    // All backends draw the same scene, except cases with each backend's largest size.
    let mut subjects: Vec<(Size, std::result::Result<Subject, tinta::Error>)> = Vec::new();
    for (_, renderer) in renderers.iter() {
        let largest = renderer.context().largest_picture;
        if !subjects.iter().any(|(known, _)| *known == largest) && (subjects.is_empty() || drawing.is_of_largest()) {
            subjects.push((largest, Subject::new(drawing, largest, folder)));
        }
    }
    let mut draw_by_all = |name: &str, draw: &dyn Fn(&Subject, &mut Renderer, bool) -> Result<Trial>| {
        let mut first: Option<Trial> = None;
        for (index, (backend, renderer)) in renderers.iter_mut().enumerate() {
            let largest = renderer.context().largest_picture;
            let subject = subjects.iter().find(|(known, _)| *known == largest).or(subjects.first());
            let Some((_, subject)) = subject else { continue };
            let outcome = match subject {
                Err(error) => Outcome::refused(error),
                Ok(subject) => match draw(subject, renderer, index == 0) {
                    Err(error) => Outcome::refused(&error),
                    Ok((picture, mut figures)) => {
                        if let Some((first, known)) = first.as_ref().filter(|(first, _)| first.size == picture.size) {
                            let differing_px = differing_px(first, &picture);
                            figures.insert("backends_differing_px", differing_px);
                            // The same picture has the same answers.
                            let known = ANSWERS.iter().filter_map(|(answer, _)| known.get_key_value(answer));
                            figures.extend(known.filter(|_| differing_px == 0.0));
                        }
                        first.get_or_insert((picture, figures.clone()));
                        Outcome::Rendered(figures)
                    }
                },
            };
            report(name, backend, outcome);
        }
    };
    for variant in &drawing.variants {
        draw_by_all(&variant.name, &|subject, renderer, is_first| subject.draw(renderer, variant, is_first));
    }
    if drawing.draws_look() {
        draw_by_all(LOOKS[0].name, &|subject, renderer, is_first| {
            subject.draw_look(drawing, folder, renderer, is_first)
        });
    }
}
