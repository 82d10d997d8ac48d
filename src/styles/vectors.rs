//! What a cartoon style draws into a file of vectors: exact areas of tone or strokes that stand for them, and exact lines above. No
//! GL here.

use super::{Cartoon, CreaseBy, Ink, LineWidth, Mrt, Style, Tones};
use crate::error::{Error, Result};
use crate::lines::{
    Areas, DrawingSettings, LineSettings, Progress, Regions, ToneLight, ToneRule, TonedSurface, VisibleLines, fills,
    hatches,
};
use crate::scene::{Color, Scene, Size};
use glam::DVec3;
use tinta_geometry::lines::Length;

/// The vectors of a style of passes.
#[derive(Debug, Clone, PartialEq)]
pub struct Vectors {
    /// The tones.
    tones: Tones,
    light: ToneLight,
    /// The lines above; `None` without.
    pub lines: Option<LineSettings>,
    /// How they are drawn, with the style's line widths; and whether tones are hatched.
    pub drawing: DrawingSettings,
}

/// Place of the light in `toon.vert`, scene radii from the eye.
const LISTED_LIGHT: DVec3 = DVec3::ONE;

/// Width of the listing's border, pixels: its filter marks the pixels on both sides of a step.
const LISTED_WIDTH: LineWidth = LineWidth::Pixels(2);

impl Style {
    /// What this style draws into a file of vectors of this size; `None` for a style that has no areas of tone.
    pub fn vectors(&self, size: Size) -> Option<Vectors> {
        let of_cartoon = |tones: &Tones, border: Option<Option<LineWidth>>| Vectors {
            tones: tones.clone(),
            light: ToneLight::Near(LISTED_LIGHT),
            // The listing's filter compares normals.
            lines: border.map(|_| LineSettings { creases_by_normals: true, ..LineSettings::default() }),
            drawing: drawing([border.flatten().unwrap_or(LISTED_WIDTH); 2], size),
        };
        match self {
            Self::ThreePass(Cartoon { tones, border, .. })
            | Self::TwoPass(Cartoon { tones, border, .. })
            | Self::Mrt(Mrt { tones, border, .. }) => Some(of_cartoon(tones, border.map(|border| border.width))),
            Self::Ink(ink) => Some(of_ink(ink, size)),
            _ => None,
        }
    }
}

fn of_ink(ink: &Ink, size: Size) -> Vectors {
    let direction = |light: [f32; 3]| DVec3::from_array(light.map(f64::from)).normalize_or_zero();
    let all = LineSettings { crease_angle: ink.crease_angle, ..LineSettings::default() };
    // The pixels' creases are where the model's normals are split.
    let settings = LineSettings { creases_by_normals: ink.crease_by == CreaseBy::Normals, ..all };
    let widths = [ink.line_width, ink.inner_width.unwrap_or(ink.line_width)];
    Vectors {
        tones: ink.tones.clone(),
        light: ink.tone_light.map_or(ToneLight::Near(LISTED_LIGHT), |light| ToneLight::Far(direction(light))),
        lines: ink.is_inked.then_some(settings),
        drawing: drawing(widths, size),
    }
}

/// A drawing with lines of these widths: the outline's, and those inside.
fn drawing([outline, inner]: [LineWidth; 2], size: Size) -> DrawingSettings {
    let px = |width: LineWidth| Length::Px(f64::from(width.pixels(size)));
    let mut drawing = DrawingSettings { line_width: Some(px(inner)), ..DrawingSettings::default() };
    if outline != inner {
        drawing.class_widths.0.set_outline(px(outline));
    }
    drawing
}

impl Vectors {
    /// Returns the areas of a scene as they are drawn below these lines.
    ///
    /// Where strokes stand for tones, what has a colour keeps the brightest tone's as one area, and all else is paper. A pen paints
    /// no areas.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for invalid tones and settings of the drawing, and for too many strokes; those of [`Regions::toned`].
    pub fn areas(&self, scene: &Scene, lines: &VisibleLines, progress: &Progress) -> Result<Areas> {
        self.tones.check()?;
        self.drawing.check()?;
        let regions = self.regions(scene, progress)?;
        if regions.broken > 0 {
            let problem = format!(
                "{} borders of areas do not close; this is a bug in tinta: report it with the model",
                regions.broken
            );
            return Err(Error::Lines { problem });
        }
        let brightest = self.tones.count - 1;
        let is_colored = |it: &TonedSurface| !scene.is_bare(&scene.objects[it.object as usize].mesh, it.material);
        let flat =
            |seen: Option<TonedSurface>| seen.filter(is_colored).map(|it| Some(TonedSurface { tone: brightest, ..it }));
        let fills = match self.drawing.hatching.spacing {
            _ if self.drawing.is_for_pen => Vec::new(),
            Some(_) => fills(&regions.joined(flat), |surface| self.color(scene, surface)),
            None => fills(&regions, |surface| self.color(scene, surface)),
        };
        let hatches = hatches(scene, &regions, brightest, lines, &self.drawing)?;
        Ok(Areas { fills, hatches, ..Areas::around(&regions) })
    }

    /// Returns the areas of a scene by object, material and tone.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::toned`].
    pub fn regions(&self, scene: &Scene, progress: &Progress) -> Result<Regions<Option<TonedSurface>>> {
        Regions::toned(scene, &self.rule(), progress)
    }

    /// How light becomes tones.
    pub fn rule(&self) -> ToneRule {
        ToneRule { light: self.light, thresholds: self.tones.thresholds().map(f64::from) }
    }

    /// The colour of a surface: its material's, times its tone.
    pub fn color(&self, scene: &Scene, surface: TonedSurface) -> Color {
        let mesh = &scene.objects[surface.object as usize].mesh;
        let Color(color) = scene.material_color(mesh, surface.material);
        let level = self.tones.levels[usize::from(surface.tone)];
        // Under vertex colours a material is white; an area has one colour, so their mean.
        let own = if scene.shows_vertex_colors(mesh) { mean(&mesh.position_colors) } else { [1.0; 3] };
        Color([0, 1, 2].map(|channel| color[channel] * own[channel] * level))
    }

    /// Returns remarks on what the areas leave out, a sentence each.
    pub fn remarks(&self, scene: &Scene) -> Vec<String> {
        let mut remarks = Vec::new();
        if scene.objects.iter().any(|object| scene.shows_vertex_colors(&object.mesh)) {
            remarks.push("vectors draw each object in the mean of its colours at vertices".to_owned());
        }
        if scene.shows_textures() {
            remarks.push("vectors leave out textures; a picture such as .png has them".to_owned());
        }
        remarks
    }
}

/// The mean of colours.
fn mean(colors: &[[f32; 3]]) -> [f32; 3] {
    let count = colors.len().max(1) as f64;
    [0, 1, 2].map(|channel| (colors.iter().map(|color| f64::from(color[channel])).sum::<f64>() / count) as f32)
}
