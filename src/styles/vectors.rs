//! What a style draws into a file of vectors: exact areas, or strokes that stand for them, and exact lines above. No GL here.

use super::far_light::{FarLight, unit};
use super::surfaces::of_averaged_normals;
use super::{Cartoon, Ink, LineStyle, LineWidth, Mrt, Style, Tones};
use crate::error::{Error, Result};
use crate::lines::{
    Areas, DrawingSettings, FillGroup, Joined, LineSettings, Progress, Regions, Surface, ToneLight, ToneRule,
    TonedSurface, VisibleLines, fills, hatches, painted,
};
use crate::mesh::NONE;
use crate::scene::{Color, Scene, Size};
use glam::DVec3;
use std::f64::consts::TAU;
use tinta_geometry::lines::Length;

/// The vectors of a style.
#[derive(Debug, Clone, PartialEq)]
pub struct Vectors {
    rule: AreaRule,
    /// The lines above; `None` without.
    pub lines: Option<LineSettings>,
    /// How they are drawn, with the style's line widths; and whether tones are hatched.
    pub drawing: DrawingSettings,
}

/// What an area is.
#[derive(Debug, Clone, PartialEq)]
enum AreaRule {
    /// A tone of an object's material, under a far light or the listing's.
    Tones(Tones, Option<FarLight>),
    /// A face, a material or an object.
    Joined(Joined),
}

/// The areas of a view.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewAreas {
    /// The areas with the background, which fill the picture.
    pub regions: Regions<Option<Surface>>,
    /// The drawn areas.
    pub drawn: Areas,
}

/// Place of the light in `toon.vert`, scene radii from the eye.
const LISTED_LIGHT: DVec3 = DVec3::ONE;

/// Width of the listing's border, pixels: its filter marks the pixels on both sides of a step.
const LISTED_WIDTH: LineWidth = LineWidth::Pixels(2);

impl Style {
    /// The far light of this style's tones and the cosines at which they begin; `None` for a style without.
    pub(crate) fn far_tones(&self) -> Option<(FarLight, [f32; 2])> {
        match self {
            Self::Ink(ink) => ink.tone_light.map(|light| (light, ink.tones.far_thresholds())),
            _ => None,
        }
    }

    /// What this style draws into a file of vectors of this size; `None` for a style without areas.
    pub fn vectors(&self, size: Size) -> Option<Vectors> {
        let of_cartoon = |tones: &Tones, border: Option<Option<LineWidth>>| Vectors {
            rule: AreaRule::Tones(tones.clone(), None),
            // The listing's filter compares normals.
            lines: border.map(|_| LineSettings { creases_by_normals: true, ..LineSettings::default() }),
            drawing: drawing([border.flatten().unwrap_or(LISTED_WIDTH); 2], size),
        };
        match self {
            Self::ThreePass(Cartoon { tones, border, .. })
            | Self::TwoPass(Cartoon { tones, border, .. })
            | Self::Mrt(Mrt { tones, border, .. }) => Some(of_cartoon(tones, border.map(|border| border.width))),
            Self::Ink(ink) => Some(of_ink(ink, size)),
            Self::Lines(style) => style.areas.map(|joined| of_lines(style, joined)),
            _ => None,
        }
    }
}

fn of_ink(ink: &Ink, size: Size) -> Vectors {
    let settings = LineSettings { crease_angle: ink.crease_angle, ..LineSettings::default() };
    let widths = [ink.line_width, ink.inner_width.unwrap_or(ink.line_width)];
    Vectors {
        rule: AreaRule::Tones(ink.tones.clone(), ink.tone_light),
        lines: ink.is_inked.then_some(settings),
        drawing: drawing(widths, size),
    }
}

fn of_lines(style: &LineStyle, joined: Joined) -> Vectors {
    let lines = (!style.is_of_areas_alone).then(|| style.lines.clone());
    Vectors { rule: AreaRule::Joined(joined), lines, drawing: style.drawing.clone() }
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

/// A colour light enough to show strokes above it.
fn below_strokes(Color(color): Color) -> Color {
    let luminance = color[0] * 0.2126 + color[1] * 0.7152 + color[2] * 0.0722;
    let missing = ((LEAST_LUMINANCE - luminance) / (1.0 - luminance)).max(0.0);
    Color(color.map(|channel| channel + (1.0 - channel) * missing))
}

/// The least luminance of an area with strokes on it.
const LEAST_LUMINANCE: f32 = 0.5;

impl Vectors {
    /// Returns the areas of a scene that lie below these lines.
    ///
    /// Where strokes stand for tones, what has a colour keeps the brightest tone's as one area, and all else is paper. A pen paints
    /// no areas. Areas of faces, materials and objects without lines above them are their polygons alone.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for invalid tones and settings of the drawing, and for too many strokes; those of [`Regions::toned`] and
    /// [`Regions::joined_by`].
    pub fn areas(&self, scene: &Scene, lines: &VisibleLines, progress: &Progress) -> Result<ViewAreas> {
        self.drawing.check()?;
        let spacing = self.drawing.hatching.spacing;
        match &self.rule {
            AreaRule::Tones(tones, _) if spacing.is_some() && tones.count == 1 => Err(Error::settings(
                &["hatch", "tones"],
                "the one tone stays paper, so no stroke is drawn; choose 2 or 3 tones, or leave the strokes out",
            )),
            AreaRule::Tones(tones, light) => {
                tones.check()?;
                let rule = tone_rule(scene, tones, *light);
                let regions = whole(Regions::toned(scene, &rule, progress)?)?;
                let color = |TonedSurface { object, material, tone }| {
                    let Color(color) = own_color(scene, object, material);
                    Color(color.map(|channel| channel * tones.levels[usize::from(tone)]))
                };
                let brightest = tones.count - 1;
                let is_colored =
                    |it: &TonedSurface| !scene.is_bare(&scene.objects[it.object as usize].mesh, it.material);
                let flat = |seen: Option<TonedSurface>| {
                    seen.filter(is_colored).map(|it| Some(TonedSurface { tone: brightest, ..it }))
                };
                let fills = match spacing {
                    _ if self.drawing.is_for_pen => Vec::new(),
                    Some(_) => fills(&regions.joined(flat), |surface| below_strokes(color(surface))),
                    None => fills(&regions, color),
                };
                let hatches = hatches(scene, (&rule, &regions), lines, &self.drawing, progress)?;
                let drawn = Areas { fills: named(scene, fills), hatches, ..Areas::around(&regions) };
                Ok(ViewAreas { regions: regions.labelled(|seen| seen.map(Surface::from)), drawn })
            }
            AreaRule::Joined(_) if spacing.is_some() => Err(Error::setting(
                "hatch",
                "strokes stand for tones; leave it out, or choose --look print instead of --areas",
            )),
            AreaRule::Joined(joined) => {
                let regions = whole(Regions::joined_by(scene, *joined, progress)?)?;
                let fills =
                    painted(&regions, self.lines.is_some(), |number| joined_color(scene, &regions, number, *joined));
                Ok(ViewAreas { drawn: Areas { fills: named(scene, fills), ..Areas::around(&regions) }, regions })
            }
        }
    }

    /// How light becomes tones in a scene; `None` for areas of faces, materials and objects.
    pub fn rule(&self, scene: &Scene) -> Option<ToneRule> {
        match &self.rule {
            AreaRule::Tones(tones, light) => Some(tone_rule(scene, tones, *light)),
            AreaRule::Joined(_) => None,
        }
    }

    /// Returns remarks on things that the areas leave out, a sentence each.
    pub fn remarks(&self, scene: &Scene) -> Vec<String> {
        let mut remarks = match self.rule {
            AreaRule::Tones(..) => of_averaged_normals(scene),
            AreaRule::Joined(_) => Vec::new(),
        };
        if matches!(self.rule, AreaRule::Joined(Joined::Face | Joined::Object)) {
            return remarks;
        }
        if scene.objects.iter().any(|object| scene.shows_vertex_colors(&object.mesh)) {
            remarks.push("vectors draw each object in the mean of its colours at vertices".to_owned());
        }
        if scene.shows_textures() {
            remarks.push("vectors leave out textures; a picture such as .png has them".to_owned());
        }
        remarks
    }
}

/// Areas with the names that the models' files give their materials.
fn named(scene: &Scene, mut fills: Vec<FillGroup>) -> Vec<FillGroup> {
    for group in &mut fills {
        let object = scene.objects.get(group.object as usize);
        let material = object.and_then(|object| object.mesh.materials.get(group.material as usize));
        group.name = material.map_or_else(String::new, |material| material.name.clone());
    }
    fills
}

fn tone_rule(scene: &Scene, tones: &Tones, light: Option<FarLight>) -> ToneRule {
    let (light, thresholds) = match light {
        None => (ToneLight::Near(LISTED_LIGHT), tones.thresholds()),
        Some(light) => {
            let thresholds = tones.far_thresholds();
            (ToneLight::Far(unit(light.towards(scene, thresholds))), thresholds)
        }
    };
    ToneRule { light, thresholds: thresholds.map(f64::from) }
}

/// Refuses regions with borders that do not close.
fn whole<T>(regions: Regions<T>) -> Result<Regions<T>> {
    if regions.broken == 0 {
        return Ok(regions);
    }
    let problem =
        format!("{} borders of areas do not close; this is a bug in tinta: report it with the model", regions.broken);
    Err(Error::Lines { problem })
}

/// The colour of an area: its material's, or one for its face's or its object's number.
fn joined_color(scene: &Scene, regions: &Regions<Option<Surface>>, number: usize, joined: Joined) -> Color {
    let Some(Surface { object, material, face, .. }) = regions.regions[number].seen else { return Color([1.0; 3]) };
    match joined {
        Joined::Face => numbered(face.unwrap_or_default()),
        Joined::Material => own_color(scene, object, material.unwrap_or(NONE)),
        Joined::Object => numbered(object),
    }
}

/// A light colour for a number, unlike those of the numbers next to it.
fn numbered(number: u32) -> Color {
    /// The golden ratio: its multiples divide the circle of hues evenly.
    const TURN: f64 = 0.618_033_988_749_895;
    let channel = |third: f64| 0.68 + 0.24 * ((f64::from(number) * TURN + third / 3.0) * TAU).cos();
    Color([0.0, 1.0, 2.0].map(|third| channel(third) as f32))
}

/// The colour of an object's material. Under vertex colours a material is white; an area has one colour, so their mean.
fn own_color(scene: &Scene, object: u32, material: u32) -> Color {
    let mesh = &scene.objects[object as usize].mesh;
    let Color(color) = scene.material_color(mesh, material);
    let own = if scene.shows_vertex_colors(mesh) { mean(&mesh.position_colors) } else { [1.0; 3] };
    Color([0, 1, 2].map(|channel| color[channel] * own[channel]))
}

/// The mean of colours.
fn mean(colors: &[[f32; 3]]) -> [f32; 3] {
    let count = colors.len().max(1) as f64;
    [0, 1, 2].map(|channel| (colors.iter().map(|color| f64::from(color[channel])).sum::<f64>() / count) as f32)
}
