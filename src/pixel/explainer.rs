//! Every step of a plan recomputed for one pixel.

use super::fragment::{Fragment, PreparedDraw, blended, misunderstood};
use super::recomputation::Recomputation;
use super::textures::Images;
use super::triangles::Triangles;
use crate::error::{Error, Result};
use crate::gl::fixed_function;
use crate::glsl;
use crate::plan::{self, Attachments, Blend, Draw, Format, Geometry, Pass, Plan, Step, Target};
use crate::renderer::StepValues;
use crate::scene::Scene;
use serde::Serialize;
use std::collections::HashMap;
use std::sync::Mutex;
use tinta_glsl::Trace;

/// A step of a plan at one pixel.
#[derive(Debug, Clone, Serialize)]
pub struct PixelStep {
    /// The pass's name.
    pub pass: &'static str,
    /// The step's name.
    pub step: &'static str,
    /// The shaders that draw it; `None` if nothing is drawn.
    pub program: Option<String>,
    /// Whether it reads what earlier steps left.
    pub reads_buffers: bool,
    /// The triangles that cover the pixel, in drawing order.
    pub fragments: Vec<Fragment>,
    /// How they are combined with what is there; `None` if nothing is drawn.
    pub blend: Option<Blend>,
    /// Red, green, blue and alpha that the driver held before, for each texture of the target; empty in a first step.
    pub before: Vec<[f32; 4]>,
    /// The same after the step, recomputed; `None` for steps that are not explained.
    pub computed: Option<Vec<[f64; 4]>>,
    /// What the driver held after the step.
    pub drawn: Vec<[f32; 4]>,
    /// The largest difference between the two last, in steps of 1/255; `None` if the step is not explained.
    pub difference: Option<f64>,
    /// Why the step is not explained.
    pub remark: Option<&'static str>,
}

impl PixelStep {
    /// The triangle that decides on the pixel: the last one written, or else the nearest one discarded.
    pub fn decisive(&self) -> Option<&Fragment> {
        let discarded = self.fragments.iter().filter(|fragment| fragment.is_discarded);
        let nearest = discarded.min_by(|a, b| a.depth.total_cmp(&b.depth));
        self.fragments.iter().rfind(|fragment| fragment.is_written()).or(nearest)
    }
}

/// A plan prepared for questions about its pixels.
pub struct Explainer<'a> {
    plan: &'a Plan,
    values: &'a [StepValues],
    /// The steps' shaders, triangles and textures, if they draw triangles.
    draws: Vec<Option<PreparedDraw<'a>>>,
}

impl std::fmt::Debug for Explainer<'_> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Explainer").field("passes", &self.plan.passes.len()).finish_non_exhaustive()
    }
}

impl<'a> Explainer<'a> {
    /// Parses the plan's shaders and finds its triangles. `values` are those of the plan's steps, in order.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for supersampled plans and for textures that cannot be recomputed, [`Error::Statement`] for shaders that the
    /// interpreter does not understand.
    pub fn new(scene: &'a Scene, plan: &'a Plan, values: &'a [StepValues], how: Recomputation) -> Result<Self> {
        Self::at(scene, plan, values, how, &HashMap::new(), None)
    }

    /// Like [`Explainer::new`], of a renderer with these shaders, by their paths below `glsl/`, instead of those built in; for this
    /// pixel alone if one is given, which takes less time.
    pub(super) fn at(
        scene: &'a Scene,
        plan: &'a Plan,
        values: &'a [StepValues],
        how: Recomputation,
        replaced: &HashMap<String, String>,
        only_at: Option<[u32; 2]>,
    ) -> Result<Self> {
        if plan.supersample > 1 {
            let problem = "a pixel of it has several colours; explain a pixel of the picture drawn once, without this";
            return Err(Error::value("supersample", plan.supersample, problem));
        }
        let draws = (0..values.len())
            .map(|number| prepared(scene, plan, values, (number, replaced), (how, only_at)))
            .collect::<Result<_>>()?;
        Ok(Self { plan, values, draws })
    }

    /// Explains one step of a plan at one pixel, without a trace, from the values that another plan of the same steps left.
    ///
    /// # Errors
    ///
    /// As [`Explainer::new`] and [`Explainer::pixel`].
    pub(crate) fn step(
        scene: &'a Scene,
        plan: &'a Plan,
        values: &'a [StepValues],
        how: Recomputation,
        (number, at): (usize, [u32; 2]),
    ) -> Result<PixelStep> {
        let mut draws: Vec<Option<PreparedDraw<'a>>> = (0..number).map(|_| None).collect();
        draws.push(prepared(scene, plan, values, (number, &HashMap::new()), (how, Some(at)))?);
        Self { plan, values, draws }.at_step(number, at, Trace::Nothing)
    }

    /// Explains a pixel, counted from the picture's lower left as GL does. It must lie within the values' part.
    ///
    /// # Errors
    ///
    /// [`Error::Statement`] for a statement that cannot be carried out.
    pub fn pixel(&self, at: [u32; 2], is_traced: bool) -> Result<Vec<PixelStep>> {
        let trace = if is_traced { Trace::Everything } else { Trace::Nothing };
        (0..self.values.len()).map(|number| self.at_step(number, at, trace)).collect()
    }

    /// Explains one prepared step at a pixel.
    pub(super) fn at_step(&self, number: usize, at: [u32; 2], trace: Trace) -> Result<PixelStep> {
        let steps: Vec<(&Pass, &Step)> = all_steps(self.plan).collect();
        let (pass, step) = steps[number];
        let StepValues { part, colors, .. } = &self.values[number];
        let place = (at[1] - part.y) as usize * part.width as usize + (at[0] - part.x) as usize;
        // A texture, or the framebuffer, as the last step that drew into it left it.
        let before = (0..colors.len()).map_while(|wanted| {
            let wanted = texture(pass.target, wanted);
            (0..number).rev().find_map(|earlier| {
                let names = (0..).map_while(|n| texture(steps[earlier].0.target, n));
                let color = names.into_iter().position(|name| Some(name) == wanted)?;
                Some(self.values[earlier].colors[color][place])
            })
        });
        let is_framebuffer = |target: Target| target == Target::Framebuffer;
        let has_its_depth = |earlier: &usize| {
            is_framebuffer(steps[*earlier].0.target) == is_framebuffer(pass.target)
                && !self.values[*earlier].depth.is_empty()
        };
        let depth = (0..number).rev().find(has_its_depth).map(|earlier| self.values[earlier].depth[place]);
        let reads = |draw: &Draw| {
            draw.textures.iter().any(|(_, read)| {
                matches!(read, plan::Texture::BorderMap | plan::Texture::DepthMap | plan::Texture::Drawn(_))
            })
        };
        let mut explained = PixelStep {
            pass: pass.name,
            step: step.name(),
            program: None,
            reads_buffers: matches!(step, Step::Draw(draw) if reads(draw)),
            fragments: Vec::new(),
            blend: if let Step::Draw(draw) = step { Some(draw.blend) } else { None },
            before: before.collect(),
            computed: None,
            drawn: colors.iter().map(|color| color[place]).collect(),
            difference: None,
            remark: None,
        };
        self.explain(step, (number, pass.target), (at, depth, trace), &mut explained)?;
        explained.difference = explained.computed.as_ref().map(|computed| difference(computed, &explained.drawn));
        Ok(explained)
    }

    fn explain(
        &self,
        step: &Step,
        (number, target): (usize, Target),
        (at, depth, trace): ([u32; 2], Option<f32>, Trace),
        explained: &mut PixelStep,
    ) -> Result<()> {
        let before: Vec<[f64; 4]> = explained.before.iter().map(|color| color.map(f64::from)).collect();
        let count = explained.drawn.len();
        match step {
            Step::Clear { color: Some(color), .. } => {
                explained.computed = Some(vec![stored(color.map(f64::from), target, 0); count]);
            }
            Step::ClearEach { colors } => {
                let colors = colors.iter().enumerate();
                explained.computed =
                    Some(colors.map(|(number, color)| stored(color.map(f64::from), target, number)).collect());
            }
            Step::Clear { color: None, .. } | Step::CopyFramebuffer | Step::CopyDepth => {
                explained.computed = Some(before);
            }
            Step::Draw(draw) => {
                let Some(prepared) = &self.draws[number] else {
                    explained.remark = Some("lines and points are drawn by GL itself and are not recomputed");
                    return Ok(());
                };
                explained.program = Some(prepared.program.clone());
                explained.fragments = prepared.fragments(at, depth, trace)?;
                let mut colors = if before.is_empty() { vec![[0.0; 4]; count] } else { before };
                for fragment in explained.fragments.iter().filter(|fragment| fragment.is_written()) {
                    for (number, (color, given)) in colors.iter_mut().zip(&fragment.colors).enumerate() {
                        *color = stored(blended(draw.blend, stored(*given, target, number), *color), target, number);
                    }
                }
                explained.computed = Some(colors);
            }
        }
        Ok(())
    }
}

/// Prepares a step of the plan; `None` if it draws no triangles.
fn prepared<'a>(
    scene: &'a Scene,
    plan: &'a Plan,
    values: &'a [StepValues],
    (number, replaced): (usize, &HashMap<String, String>),
    (how, only_at): (Recomputation, Option<[u32; 2]>),
) -> Result<Option<PreparedDraw<'a>>> {
    let Some((pass, Step::Draw(draw))) = all_steps(plan).nth(number) else { return Ok(None) };
    if matches!(draw.geometry, Geometry::Edges { .. }) || draw.back_faces_as_lines.is_some() {
        return Ok(None);
    }
    let program = fixed_function::program_of(draw, false)
        .ok_or_else(|| Error::gl("explaining a pixel", "a draw has no shaders"))?;
    fn text<'t>(path: &'t str, replaced: &'t HashMap<String, String>) -> Result<(&'t str, &'t str)> {
        let missing = || Error::gl("explaining a pixel", format!("{path} is no shader of tinta"));
        let replaced = replaced.get(path).map(String::as_str);
        replaced.or_else(|| glsl::source(path)).map(|text| (path, text)).ok_or_else(missing)
    }
    let fragments: Vec<(&str, &str)> =
        program.fragments.iter().map(|path| text(path, replaced)).collect::<Result<_>>()?;
    let stage = |texts: &[(&str, &str)]| tinta_glsl::Stage::new(texts).map_err(misunderstood);
    let material = draw.material_unit().map(|(unit, _)| unit);
    let samplers = (0_u32..)
        .zip(&draw.textures)
        .map(|(unit, (name, _))| fixed_function::sampler(draw, &program, unit).unwrap_or(name));
    Ok(Some(PreparedDraw {
        draw,
        program: program.to_string(),
        vertex: stage(&[text(&program.vertex, replaced)?])?,
        fragment: stage(&fragments)?,
        triangles: Triangles::of(scene, draw, material, how.subpixel_bits, only_at),
        samplers: samplers.collect(),
        images: Images::of(scene, plan, values, (number, draw), how.filtering)?,
        precision: how.precision,
        corners: Mutex::default(),
        height: scene.size.height,
        is_texture: pass.target != Target::Framebuffer,
    }))
}

/// A plan's steps, each with its pass.
fn all_steps(plan: &Plan) -> impl Iterator<Item = (&Pass, &Step)> {
    plan.passes.iter().flat_map(|pass| pass.steps.iter().map(move |step| (pass, step)))
}

/// Whether nothing but background is drawn at a pixel: no object covers it, and steps that read earlier ones leave it unchanged.
pub(crate) fn is_background(steps: &[PixelStep]) -> bool {
    let is_still = |step: &PixelStep| {
        step.fragments.iter().all(|fragment| fragment.object.is_none())
            && (!step.reads_buffers || step.fragments.is_empty() || step.before.is_empty() || step.before == step.drawn)
            && (step.remark.is_none() || step.before == step.drawn)
    };
    steps.iter().all(is_still)
}

/// The name of a target's texture of this number; the framebuffer has one without a name.
fn texture(target: Target, number: usize) -> Option<&'static str> {
    match target {
        Target::Framebuffer => (number == 0).then_some(""),
        Target::Textures(Attachments { colors, .. }) => colors.get(number).map(|color| color.name.0),
    }
}

/// The format of a target's texture.
fn format(target: Target, number: usize) -> Format {
    match target {
        Target::Framebuffer => Format::Unorm8,
        Target::Textures(Attachments { colors, .. }) => colors.get(number).map_or(Format::Unorm8, |color| color.format),
    }
}

/// Returns a colour as it is stored.
fn stored(color: [f64; 4], target: Target, number: usize) -> [f64; 4] {
    match format(target, number) {
        // A NaN is stored as 0.
        Format::Unorm8 => color.map(|channel| (channel.clamp(0.0, 1.0).max(0.0) * 255.0).round() / 255.0),
        Format::Float16 | Format::Float32 => color,
    }
}

/// The largest difference of two colours, in steps of 1/255.
fn difference(computed: &[[f64; 4]], drawn: &[[f32; 4]]) -> f64 {
    let pairs = computed.as_flattened().iter().zip(drawn.as_flattened());
    pairs.map(|(a, b)| (a - f64::from(*b)).abs() * 255.0).fold(0.0, f64::max)
}
