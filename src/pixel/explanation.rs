//! A pixel explained in words: pass by pass, statement by statement, beside the driver's value and the exact lines.

use super::{
    AgainstLines, Event, Explainer, PixelStep, Recomputation, Sample, Verdict, What, against_lines, flips,
    is_background,
};
use crate::error::{Error, Result};
use crate::lines::{LineSettings, VisibleLines};
use crate::plan::Plan;
use crate::renderer::{Renderer, StepValues};
use crate::scene::{Rectangle, Scene, Size};
use crate::styles::{Show, Style};
use glam::DVec2;
use serde::Serialize;
use std::fmt::{Display, Formatter, Write};
use tinta_geometry::threads::both;

/// How far around the pixel the buffers are read back: further than any of the styles' shaders reads.
const MARGIN_PX: u32 = 72;

/// Statements told of one triangle.
const MOST_EVENTS: usize = 80;

/// Characters shown of a statement.
const SOURCE_LENGTH: usize = 58;

/// A pixel of a style's picture, explained.
#[derive(Debug, Serialize)]
pub struct Explanation {
    /// The style's name.
    pub style: &'static str,
    /// Right and down from the upper left corner.
    pub pixel: [u32; 2],
    /// The same right and up from the lower left corner, as GL counts texels.
    pub place_in_textures: [u32; 2],
    /// Red, green, blue and alpha of the picture, of 255.
    pub color: [u8; 4],
    /// OpenGL's name of the driver.
    pub renderer: String,
    /// The objects' names, by their numbers.
    pub objects: Vec<String>,
    /// Each step of the plan.
    pub steps: Vec<PixelStep>,
    /// The pixel's line beside the exact ones; `None` for styles that draw no lines.
    pub lines: Option<AgainstLines>,
    /// The texts of the shaders that ran, by their paths.
    #[serde(skip)]
    texts: Vec<(String, String)>,
}

impl Explanation {
    /// Draws a scene in a style and explains the pixel at a place, x right and y down from the upper left corner.
    ///
    /// # Errors
    ///
    /// [`Error::Text`] for a place outside of the picture or of background; those of [`Renderer::step_values`] and of
    /// [`Explainer`].
    pub fn of(style: &Style, scene: &Scene, renderer: &mut Renderer, place: DVec2) -> Result<Self> {
        let mut explained = Self::without_lines(style, scene, renderer, place)?;
        if !style.has_lines() {
            return Ok(explained);
        }
        let (at, plan) = (explained.place_in_textures, style.plan(scene, Show::Borders)?);
        let part = read_back(renderer, at, scene.size);
        let (values, lines) =
            both(|| renderer.step_values(scene, &plan, part), || VisibleLines::of(scene, &LineSettings::default()));
        let values = values?;
        let mut against = against_lines(scene, &values, &lines?, at);
        // Other settings may run other shaders than those replaced.
        if explained.texts.is_empty() {
            let how = Recomputation::like(renderer.context());
            against.flips = flips(scene, style, (&plan, &values), at, how)?;
        }
        explained.lines = Some(against);
        Ok(explained)
    }

    /// Like [`Explanation::of`], without the verdict of the exact lines, which take longer.
    ///
    /// # Errors
    ///
    /// As there.
    pub fn without_lines(style: &Style, scene: &Scene, renderer: &mut Renderer, place: DVec2) -> Result<Self> {
        let size = scene.size;
        let refuse = |problem: String| Error::Text(format!("{},{}: {problem}", place.x, place.y).into());
        let is_within = |at: f64, count: u32| (0.0..f64::from(count)).contains(&at);
        if !is_within(place.x, size.width) || !is_within(place.y, size.height) {
            let (right, low) = (size.width - 1, size.height - 1);
            return Err(refuse(format!(
                "this is outside of the picture; choose x from 0 to {right} and y from 0 to {low}"
            )));
        }
        let pixel = [place.x as u32, place.y as u32];
        let plan = style.plan(scene, Show::Final)?;
        let at = [pixel[0], size.height - 1 - pixel[1]];
        let part = read_back(renderer, at, size);
        let values = renderer.step_values(scene, &plan, part)?;
        Self::of_values(style, scene, (&plan, &values), renderer, pixel)
    }

    /// Explains a pixel of the finished picture, right and down from the upper left corner, from what the steps of its plan left
    /// there ([`around`]).
    ///
    /// # Errors
    ///
    /// As [`Explanation::of`].
    pub(crate) fn of_values(
        style: &Style,
        scene: &Scene,
        (plan, values): (&Plan, &[StepValues]),
        renderer: &Renderer,
        pixel: [u32; 2],
    ) -> Result<Self> {
        let [x, y] = pixel;
        let refuse = |problem: String| Error::Text(format!("{x},{y}: {problem}").into());
        let at = [x, scene.size.height - 1 - y];
        let how = Recomputation::like(renderer.context());
        let replaced = renderer.replaced_shaders();
        let steps = Explainer::at(scene, plan, values, how, &replaced, Some(at))?.pixel(at, true)?;
        if is_background(&steps) {
            return Err(refuse("this is background, where nothing is drawn; choose a pixel of the model".to_owned()));
        }
        let color = steps.last().and_then(|step| step.drawn.first()).copied().unwrap_or_default();
        Ok(Self {
            style: style.name(),
            pixel,
            place_in_textures: at,
            color: color.map(|channel| (channel * 255.0).round().clamp(0.0, 255.0) as u8),
            renderer: renderer.context().renderer.clone(),
            objects: scene.objects.iter().map(|object| object.mesh.name.clone()).collect(),
            steps,
            lines: None,
            texts: replaced.into_iter().collect(),
        })
    }

    /// The text of a shader that ran.
    pub(super) fn text(&self, shader: &str) -> &str {
        let replaced = self.texts.iter().find(|(path, _)| path == shader).map(|(_, text)| text.as_str());
        replaced.or_else(|| crate::glsl::source(shader)).unwrap_or_default()
    }

    /// The line of a shader that an event comes from, shortened.
    pub fn source(&self, event: &Event) -> String {
        let text = self.text(&event.shader);
        let line = text.lines().nth((event.line as usize).saturating_sub(1)).unwrap_or_default();
        line.trim().chars().take(SOURCE_LENGTH).collect()
    }

    /// What a statement did.
    pub fn in_words(&self, event: &Event) -> String {
        match &event.what {
            What::Set { variable, value } => format!("{variable} = {value}"),
            What::Branched { is_taken, compared: None } => format!("the condition is {is_taken}"),
            What::Branched { is_taken, compared: Some(compared) } => format!("{} is {is_taken}", compared.in_words(6)),
            What::Read { texture, sample, .. } => format!("{texture} {}", of_sample(sample, self.place_in_textures)),
            What::Returned { function, value } => format!("{function} returns {value}"),
            What::Discarded => "the pixel stays as it was".to_owned(),
        }
    }

    /// The triangles over the pixel: the one that stays statement by statement, the others as a number.
    fn write_fragments(&self, text: &mut String, step: &PixelStep) {
        let decisive = step.decisive();
        let others = step.fragments.len() - usize::from(decisive.is_some());
        let Some(fragment) = decisive else {
            if others > 0 {
                let _ = writeln!(text, "  {others} triangles cover it, all behind what is there");
            }
            return;
        };
        if let Some(object) = fragment.object {
            let side = if fragment.is_front { "front" } else { "back" };
            let name = self.objects.get(object).map_or("", String::as_str).escape_debug();
            let _ = write!(text, "  triangle {} of {name}, its {side}, depth {:.6}", fragment.triangle, fragment.depth);
            let shares: Vec<String> = fragment.corners.iter().map(|corner| format!("{:.4}", corner.share)).collect();
            let _ = write!(text, ", corners' shares {}", shares.join(" "));
            let _ = writeln!(text, "{}", if others > 0 { format!("; {others} more cover it") } else { String::new() });
            for (name, value) in &fragment.varyings {
                let _ = writeln!(text, "    in   {name} = {value}");
            }
        }
        for event in fragment.events.iter().take(MOST_EVENTS) {
            let (line, value) = (self.source(event), self.in_words(event));
            let _ = writeln!(text, "  {:>5}  {line:<SOURCE_LENGTH$} {value}", event.line);
        }
        if fragment.events.len() > MOST_EVENTS {
            let _ = writeln!(text, "         and {} more; --json lists all", fragment.events.len() - MOST_EVENTS);
        }
    }
}

impl Display for Explanation {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { style, pixel: [x, y], color, renderer, steps, lines, .. } = self;
        let mut text = format!("Pixel {x},{y} of {style} is {color:?}, drawn by {renderer}.\n");
        if let Some(lines) = lines {
            let _ = writeln!(text, "{lines}");
        }
        for step in steps {
            let _ = write!(text, "\n{}, {}", step.pass, step.step);
            if let Some(program) = &step.program {
                let _ = write!(text, " with {program}");
            }
            text.push('\n');
            self.write_fragments(&mut text, step);
            let _ = writeln!(text, "  {}", written(step));
        }
        out.write_str(&text)
    }
}

/// What the exact lines say, and what would turn the ink over, a line for each setting.
impl Display for AgainstLines {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { verdict, darkness, class, distance_px, flips } = self;
        let nearest = match (class, distance_px) {
            (Some(class), Some(distance)) => {
                let article = if class.starts_with(['a', 'i']) { "an" } else { "a" };
                format!("the nearest visible line is {article} {class} at {distance:.2} px")
            }
            _ => "no line is visible".to_owned(),
        };
        let verdict = match verdict {
            Verdict::Right => "as the exact lines",
            Verdict::Invented => "invented",
            Verdict::Missed => "missed",
            Verdict::Empty => "no line here, as in the exact lines",
        };
        write!(out, "Its line is {darkness} of 255 dark: {verdict}; {nearest}.")?;
        let becomes = if *darkness >= super::INK_FROM { "no ink" } else { "ink" };
        for flip in flips {
            write!(out, "\nIt becomes {becomes} with --{} {}.", flip.setting, three_digits(flip.value))?;
        }
        Ok(())
    }
}

fn three_digits(value: f64) -> String {
    format!("{value:.3}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The pixels to read back to explain one, counted from the lower left, and those up to `reach_px` from it.
pub fn around(at: [u32; 2], size: Size, reach_px: u32) -> Rectangle {
    let margin = MARGIN_PX + reach_px;
    let (x, y) = (at[0].saturating_sub(margin), at[1].saturating_sub(margin));
    let until = |at: u32, count: u32| (at + margin + 1).min(count);
    Rectangle { x, y, width: until(at[0], size.width) - x, height: until(at[1], size.height) - y }
}

/// The pixels to read back to explain one with the renderer's shaders: shaders of a user's own may read anywhere.
fn read_back(renderer: &Renderer, at: [u32; 2], size: Size) -> Rectangle {
    if renderer.replaced_shaders().is_empty() {
        around(at, size, 0)
    } else {
        around(at, size, size.width.max(size.height))
    }
}

/// The letter of the texts' filters for a texel around the pixel: A to I from the lower left.
pub fn tap(place: [u32; 2], at: [u32; 2]) -> Option<char> {
    let [across, up] = [0, 1].map(|axis| i64::from(place[axis]) - i64::from(at[axis]) + 1);
    let letter = ((0..3).contains(&across) && (0..3).contains(&up)).then_some(3 * up + across)?;
    "ABCDEFGHI".chars().nth(letter as usize)
}

/// The texels of a read; those around the pixel by their letters.
fn of_sample(sample: &Sample, at: [u32; 2]) -> String {
    let color = |value: [f64; 4]| value.map(|channel| format!("{:.4}", channel)).join(", ");
    match sample.texels.as_slice() {
        [] => format!("has no picture here: {}", color(sample.value)),
        [texel] => {
            let tap = tap(texel.place, at).map_or_else(String::new, |letter| format!("tap {letter}, "));
            format!("{tap}texel {},{}: {}", texel.place[0], texel.place[1], color(texel.value))
        }
        texels => {
            let parts: Vec<String> = texels
                .iter()
                .map(|texel| format!("{},{} by {:.3}", texel.place[0], texel.place[1], texel.weight))
                .collect();
            format!("texels {}: {}", parts.join(", "), color(sample.value))
        }
    }
}

/// The value that a step leaves, and the driver's.
fn written(step: &PixelStep) -> String {
    let bytes =
        |color: &[f64]| color.iter().map(|channel| three_digits(channel * 255.0)).collect::<Vec<_>>().join(", ");
    let drawn: Vec<String> = step.drawn.iter().map(|color| bytes(&color.map(f64::from))).collect();
    let drawn = drawn.join(" and ");
    match (&step.computed, step.difference) {
        (Some(_), Some(difference)) if difference < 0.01 => format!("leaves {drawn}; the driver: the same"),
        (Some(computed), Some(difference)) => {
            let computed: Vec<String> = computed.iter().map(|color| bytes(color)).collect();
            let computed = computed.join(" and ");
            format!("leaves {computed}; the driver: {drawn}, {} steps of 255 away", three_digits(difference))
        }
        _ => format!("leaves {drawn} by the driver; {}", step.remark.unwrap_or_default()),
    }
}
