//! The contents of a drawing, and those of a style in a file of vectors: exact areas, or strokes that stand for them, and exact
//! lines above. No GL here.

use super::far_light::{FarLight, unit};
use super::flat_colors::in_flat_colors;
use super::surfaces::of_averaged_normals;
use super::{Cartoon, Ink, LineWidth, Mrt, Style, Tones};
use crate::edges::{Class, ClassSet};
use crate::error::{Error, Result};
use crate::lines::{
    Areas, DrawingSettings, FillGroup, HiddenLines, JoinKey, LineSettings, Progress, ProjectionAngle, Regions, Sight,
    Surface, ToneLight, ToneRule, TonedSurface, VisibleLines, fills, hatches, painted,
};
use crate::mesh::NONE;
use crate::scene::{Color, Scene, Size};
use glam::DVec3;
use std::borrow::Cow;
use std::f64::consts::TAU;
use tinta_geometry::lines::Length;

/// The contents of a drawing: one thing below, and exact lines above.
#[derive(Debug, Clone, PartialEq)]
pub struct Contents {
    /// The part below the lines.
    pub below: Below,
    /// The lines; `None` without. Whether hidden ones are found follows from `drawing`.
    pub lines: Option<LineSettings>,
    /// How they are drawn, with the style's line widths; and whether tones are hatched.
    pub drawing: DrawingSettings,
    /// The views of a sheet in place of the camera's. Default none.
    pub sheet: Option<ProjectionAngle>,
}

/// The part of a drawing below its lines.
#[derive(Debug, Clone, PartialEq)]
pub enum Below {
    /// A picture that OpenGL draws in this style.
    Passes(Box<Style>),
    /// Areas of tone of each object's materials, under a far light or the listing's.
    Tones(Tones, Option<FarLight>),
    /// Areas of faces, materials or objects.
    Joined(JoinKey),
    /// Nothing.
    Nothing,
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

    /// Moves the far light of this style's tones.
    pub(crate) fn put_far_light(&mut self, light: [f32; 3]) {
        if let Self::Ink(Ink { tone_light: Some(of_tones), .. }) = self {
            *of_tones = FarLight::Towards(light);
        }
    }

    /// What this style draws into a file of vectors of this size; `None` for a style of passes alone.
    pub fn vectors(&self, size: Size) -> Option<Contents> {
        let of_tones = |tones: &Tones, light, lines, widths| Contents {
            below: Below::Tones(tones.clone(), light),
            lines,
            drawing: drawing(widths, size),
            sheet: None,
        };
        match self {
            Self::ThreePass(Cartoon { tones, border, .. })
            | Self::TwoPass(Cartoon { tones, border, .. })
            | Self::Mrt(Mrt(Cartoon { tones, border, .. })) => {
                let width = border.and_then(|border| border.width).unwrap_or(LISTED_WIDTH);
                // The listing's filter compares normals.
                let lines = LineSettings { creases_by_normals: true, ..LineSettings::default() };
                Some(of_tones(tones, None, border.map(|_| lines), [width; 2]))
            }
            Self::Ink(ink) => {
                let lines = LineSettings { crease_angle: ink.crease_angle, ..LineSettings::default() };
                let widths = [ink.line_width, ink.inner_width.unwrap_or(ink.line_width)];
                Some(of_tones(&ink.tones, ink.tone_light, ink.is_inked.then_some(lines), widths))
            }
            _ => self.lines().map(|style| Contents {
                below: style.areas.map_or(Below::Nothing, Below::Joined),
                lines: (!style.is_of_areas_alone).then_some(style.lines),
                drawing: style.drawing,
                sheet: style.sheet,
            }),
        }
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

/// A colour light enough to show strokes above it.
fn below_strokes(Color(color): Color) -> Color {
    let luminance = color[0] * 0.2126 + color[1] * 0.7152 + color[2] * 0.0722;
    let missing = ((LEAST_LUMINANCE - luminance) / (1.0 - luminance)).max(0.0);
    Color(color.map(|channel| channel + (1.0 - channel) * missing))
}

/// The least luminance of an area with strokes on it.
const LEAST_LUMINANCE: f32 = 0.5;

impl Contents {
    /// Returns the areas of a scene that lie below these lines; `None` without areas.
    ///
    /// Where strokes stand for tones, a coloured surface is one area in its brightest tone, and all else is paper. A pen paints
    /// no areas. Areas of faces, materials and objects without lines above them are their polygons alone.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for invalid tones and settings of the drawing, and for too many strokes; those of [`Regions::toned`] and
    /// [`Regions::joined_by`].
    pub fn areas(&self, sight: &Sight<'_>, lines: &VisibleLines, progress: &Progress) -> Result<Option<ViewAreas>> {
        let scene = sight.scene;
        self.drawing.check()?;
        match &self.below {
            Below::Passes(_) | Below::Nothing => Ok(None),
            Below::Tones(tones, light) => self.areas_of_tone((tones, *light), sight, lines, progress).map(Some),
            Below::Joined(joined) => {
                let flat = if *joined == JoinKey::Material { in_flat_colors(scene)? } else { Cow::Borrowed(scene) };
                let regions = whole(Regions::joined_by(&sight.of_same_faces(&flat), *joined, progress)?)?;
                let fills =
                    painted(&regions, self.lines.is_some(), |number| joined_color(&flat, &regions, number, *joined));
                let drawn = Areas { fills: named(&flat, fills), ..Areas::around(&regions) };
                Ok(Some(ViewAreas { drawn, regions: of_file(regions, scene, &flat) }))
            }
        }
    }

    fn areas_of_tone(
        &self,
        (tones, light): (&Tones, Option<FarLight>),
        sight: &Sight<'_>,
        lines: &VisibleLines,
        progress: &Progress,
    ) -> Result<ViewAreas> {
        let scene = sight.scene;
        let spacing = self.drawing.hatching.spacing;
        if spacing.is_some() && tones.count == 1 {
            let problem =
                "the one tone stays paper, so no stroke is drawn; choose 2 or 3 tones, or leave the strokes out";
            return Err(Error::settings(&["hatch", "tones"], problem));
        }
        tones.check()?;
        let rule = tone_rule(scene, tones, light);
        let flat = if self.drawing.is_for_pen { Cow::Borrowed(scene) } else { in_flat_colors(scene)? };
        let regions = whole(Regions::toned(&sight.of_same_faces(&flat), &rule, progress)?)?;
        let color = |TonedSurface { object, material, tone }| {
            let Color(color) = own_color(&flat, object, material);
            Color(color.map(|channel| channel * tones.levels[usize::from(tone)]))
        };
        let brightest = tones.count - 1;
        let is_colored = |it: &TonedSurface| !flat.is_bare(&flat.objects[it.object as usize].mesh, it.material);
        let without_tones =
            |seen: Option<TonedSurface>| seen.filter(is_colored).map(|it| Some(TonedSurface { tone: brightest, ..it }));
        let fills = match spacing {
            _ if self.drawing.is_for_pen => Vec::new(),
            Some(_) => fills(&regions.joined(without_tones), |surface| below_strokes(color(surface))),
            None => fills(&regions, color),
        };
        let hatches = hatches(sight, (&rule, &regions), lines, &self.drawing, progress)?;
        let drawn = Areas { fills: named(&flat, fills), hatches, ..Areas::around(&regions) };
        Ok(ViewAreas { regions: of_file(regions.labelled(|seen| seen.map(Surface::from)), scene, &flat), drawn })
    }

    /// How light becomes tones in a scene; `None` without areas of tone.
    pub fn rule(&self, scene: &Scene) -> Option<ToneRule> {
        match &self.below {
            Below::Tones(tones, light) => Some(tone_rule(scene, tones, *light)),
            _ => None,
        }
    }

    /// Returns remarks on things that the areas leave out, a sentence each.
    pub(crate) fn remarks(&self, scene: &Scene) -> Vec<String> {
        let mut remarks = match self.below {
            Below::Tones(..) => of_averaged_normals(scene),
            Below::Joined(JoinKey::Material) => Vec::new(),
            _ => return Vec::new(),
        };
        if scene.objects.iter().any(|object| scene.shows_vertex_colors(&object.mesh)) {
            remarks.push("vectors draw each object in the mean of its colours at vertices".to_owned());
        }
        if scene.shows_textures() && !self.drawing.is_for_pen {
            remarks.push("vectors draw each face of a texture in the mean of its texels".to_owned());
        }
        remarks
    }

    /// Refuses settings that contradict each other.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`].
    pub(crate) fn check(&self) -> Result<()> {
        let has_areas = matches!(self.below, Below::Joined(_));
        if self.lines.is_none() && self.below == Below::Nothing {
            let problem = "style lines draws nothing but lines; leave it out, or add --areas object";
            return Err(Error::setting("no-borders", problem));
        }
        if self.drawing.is_for_pen && has_areas {
            return Err(Error::setting("areas", "a pen draws lines alone; leave out one of --areas and --pen"));
        }
        if self.sheet.is_some() && has_areas {
            return Err(Error::setting("areas", "areas are drawn from one view; leave out one of --areas and --sheet"));
        }
        if self.is_hatched() && !matches!(self.below, Below::Tones(..)) {
            let problem = "lines, faces and objects have no tones; leave it out, or choose --look print";
            return Err(Error::setting("hatch", problem));
        }
        self.drawing.check()?;
        self.lines.as_ref().map_or(Ok(()), |lines| lines.parts.check(&self.drawing))
    }

    /// Whether these lines are asked for by their own name.
    pub(crate) fn asks_for(&self, class: Class) -> bool {
        self.lines.as_ref().is_some_and(|lines| lines.classes != ClassSet::ALL && lines.classes.contains(class))
    }

    /// Whether strokes stand for tones.
    pub(crate) fn is_hatched(&self) -> bool {
        self.drawing.hatching.spacing.is_some()
    }

    /// Whether a picture of pixels has strokes: exact lines, or those of tones.
    pub(crate) fn has_strokes(&self) -> bool {
        self.lines.is_some() || self.is_hatched()
    }

    /// The exact lines over a picture of passes.
    pub fn lines_over(&self) -> Option<&LineSettings> {
        self.lines.as_ref().filter(|_| matches!(self.below, Below::Passes(_)) || self.is_hatched())
    }

    /// The lines to find for this drawing: outlines and hidden lines only if they show; `None` without lines.
    pub(crate) fn wanted(&self) -> Option<LineSettings> {
        self.lines.as_ref().map(|lines| LineSettings {
            finds_outline: self.drawing.tells_outline(),
            finds_hidden: self.drawing.hidden != HiddenLines::None || lines.parts.draw_hidden(),
            ..lines.clone()
        })
    }
}

/// Regions with the materials of the file, of which the flat scene has one for each colour.
fn of_file(regions: Regions<Option<Surface>>, scene: &Scene, flat: &Scene) -> Regions<Option<Surface>> {
    if std::ptr::eq(scene, flat) {
        return regions;
    }
    let count = |surface: Surface| scene.objects[surface.object as usize].mesh.materials.len().max(1) as u32;
    let of_file = |seen: Surface| Surface { material: seen.material.map(|number| number % count(seen)), ..seen };
    regions.joined(|seen| Some(seen.map(of_file)))
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
fn joined_color(scene: &Scene, regions: &Regions<Option<Surface>>, number: usize, joined: JoinKey) -> Color {
    let Some(Surface { object, material, face, .. }) = regions.regions[number].seen else { return Color([1.0; 3]) };
    match joined {
        JoinKey::Face => numbered(face.unwrap_or_default()),
        JoinKey::Material => own_color(scene, object, material.unwrap_or(NONE)),
        JoinKey::Object => numbered(object),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::styles::LineStyle;

    #[test]
    fn only_what_the_drawing_shows_is_looked_for() {
        let size = Size { width: 64, height: 64 };
        let wanted = |style: &LineStyle| Style::Lines(style.clone()).vectors(size).unwrap().wanted().unwrap();
        let mut style = LineStyle::default();
        style.drawing.class_colors.0.set_class(Class::Crease, Color([1.0, 0.0, 0.0]));
        assert!(!wanted(&style).finds_outline && !wanted(&style).finds_hidden);
        style.drawing.class_colors.0.set_outline(Color([1.0, 0.0, 0.0]));
        style.drawing.hidden = HiddenLines::Dashed;
        assert!(wanted(&style).finds_outline && wanted(&style).finds_hidden);
    }
}
