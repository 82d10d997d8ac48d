//! Drawings of lines and areas: what is found for a request, and the one place where it becomes a file.
//!
//! Every door ends here: it chooses a [`DrawingFormat`] and a target, and may give a recipe or paths whose strokes keep their numbers.

use super::emptiness::reason;
use super::{DrawingFormat, Request, Wanted};
use crate::edges::SilhouetteRule;
use crate::error::{Error, Result};
use crate::lines::{
    DrawingSettings, Hidden, LinePath, LineSettings, PageSize, Progress, Raster, Strokes, VisibleLines, chain,
    dxf_of_paths, raster_of_paths, strokes_of_paths, svg_of_paths,
};
use crate::output::TextTarget;
use crate::picture::{Note, Picture, Target};
use crate::plan::Plan;
use crate::recipe::Recipe;
use crate::record::{drawing_json, px_per_unit};
use crate::scene::{Scene, Unseen};
use crate::settings::HasSettings;
use crate::styles::{LineStyle, Show, Style, Vectors, ViewAreas};
use std::path::PathBuf;
use std::sync::Arc;

/// Lines and areas, and how they were found.
#[derive(Debug, Clone)]
pub struct DrawnLines {
    /// The scene.
    pub scene: Scene,
    /// The files read besides the models' own files.
    pub files: Vec<PathBuf>,
    /// The style that they are drawn in.
    pub style: LineStyle,
    /// The lines.
    pub lines: Arc<VisibleLines>,
    /// The areas below them; `None` in a drawing of lines alone.
    pub areas: Option<ViewAreas>,
    /// Remarks for the user, a sentence each.
    pub remarks: Vec<String>,
    /// How long reading took, milliseconds.
    pub load_ms: f64,
}

/// A drawing as its file holds it.
#[derive(Debug)]
pub enum DrawingFile {
    /// The bytes of a file of vectors or data.
    Bytes(Vec<u8>),
    /// Pixels, and the note that the file has if its format can.
    Picture(Picture, Option<Note>),
}

impl DrawingFile {
    /// The file's bytes, those of a PNG for a picture.
    ///
    /// # Errors
    ///
    /// As [`Picture::png_bytes`].
    pub fn bytes(self) -> Result<Vec<u8>> {
        match self {
            Self::Bytes(bytes) => Ok(bytes),
            Self::Picture(picture, note) => picture.png_bytes(note.as_ref()),
        }
    }

    /// Writes the file, or to standard output for `-`; a picture in the format of its name.
    ///
    /// # Errors
    ///
    /// Those of [`TextTarget`] and [`Target`].
    pub fn write(self, output: &str, is_transparent: bool) -> Result<()> {
        match self {
            Self::Bytes(bytes) => TextTarget::check(output)?.write_bytes(&bytes),
            Self::Picture(picture, note) => Target::check(output, is_transparent)?.write_with(&picture, note.as_ref()),
        }
    }
}

impl DrawnLines {
    /// The paths that the drawing shows, with hidden ones if it shows them.
    pub fn paths(&self) -> Vec<LinePath> {
        let mut paths = chain(&self.lines.segments);
        let shows_hidden = |look: u32| self.lines.drawing(look, &self.style.drawing).hidden != Hidden::None;
        paths.retain(|path| path.is_visible || shows_hidden(path.look));
        paths
    }

    /// The drawing as pixels, without its areas.
    ///
    /// # Errors
    ///
    /// Those of [`raster_of_paths`].
    #[cfg(feature = "window")]
    pub(crate) fn raster(&self) -> Result<Picture> {
        let Raster { size, pixels } = raster_of_paths(&self.lines, self.paths(), &self.style.drawing)?;
        Ok(Picture { size, pixels })
    }

    /// The strokes that lie over a picture of the same view.
    ///
    /// # Errors
    ///
    /// Those of [`strokes_of_paths`].
    pub(crate) fn strokes(&self) -> Result<Vec<Strokes>> {
        strokes_of_paths(&self.lines, self.paths(), None, &self.style.drawing)
    }

    /// Writes these paths of the drawing, or its own, into a file of this format. The recipe's command has a fixed name for the
    /// output: the same drawing is the same bytes wherever it is written.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for settings that this format does not have, and those of the writers.
    pub fn written(
        &self,
        format: DrawingFormat,
        paths: Option<Vec<LinePath>>,
        recipe: Option<&Recipe>,
    ) -> Result<DrawingFile> {
        let output = if format == DrawingFormat::Pdf { "drawing.pdf" } else { "drawing.svg" };
        let settings = DrawingSettings {
            command: recipe.map(|recipe| recipe.command_line(output)).unwrap_or_default(),
            recipe: recipe.and_then(Recipe::json).unwrap_or_default(),
            ..self.style.drawing.clone()
        };
        let (lines, areas) = (&*self.lines, self.areas.as_ref());
        let below = areas.map(|areas| &areas.drawn);
        let paths = || paths.unwrap_or_else(|| self.paths());
        Ok(match format {
            DrawingFormat::Svg => DrawingFile::Bytes(svg_of_paths(lines, paths(), below, &settings)?.into_bytes()),
            #[cfg(feature = "pdf")]
            DrawingFormat::Pdf => DrawingFile::Bytes(crate::lines::pdf_of_paths(lines, paths(), below, &settings)?),
            #[cfg(not(feature = "pdf"))]
            DrawingFormat::Pdf => return Err(Error::setting("o", "this build writes no .pdf file; write a .svg")),
            DrawingFormat::Dxf => DrawingFile::Bytes(dxf_of_paths(lines, paths(), below, &settings)?.into_bytes()),
            DrawingFormat::Json => {
                let regions = areas.map(|areas| &areas.regions);
                DrawingFile::Bytes(drawing_json(lines, regions, &self.scene)?.into_bytes())
            }
            DrawingFormat::Picture => {
                let Raster { size, pixels } = raster_of_paths(lines, paths(), &settings)?;
                DrawingFile::Picture(Picture { size, pixels }, recipe.and_then(Recipe::note))
            }
        })
    }
}

/// The remark on a drawing without any visible line.
fn no_line(scene: &Scene) -> String {
    let why = match scene.unseen(scene.size, false) {
        unseen @ Some(Unseen::Behind | Unseen::Beside | Unseen::CutOff) => format!(": {}", reason(scene, unseen)),
        _ => "; see --classes, --eye and --target".to_owned(),
    };
    format!("no line of these classes is visible in this picture{why}")
}

impl Request {
    /// The areas, and the lines above them, of a style that has areas, with the options of lines and of drawings; `None` for a
    /// style without areas.
    ///
    /// # Errors
    ///
    /// Those of the options of lines and of drawings.
    pub fn vectors(&self) -> Result<Option<Vectors>> {
        let mut vectors = self.style.vectors(self.scene.size);
        if let (Some(vectors), Some(LineStyle { lines, drawing, .. })) = (&mut vectors, self.lines_over()?) {
            (vectors.lines, vectors.drawing) = (Some(lines), drawing);
        } else if let (Some(vectors), None) = (&mut vectors, self.style.lines()) {
            DrawingSettings::table().apply(&mut vectors.drawing, &self.options)?;
            if let Some(lines) = &mut vectors.lines {
                LineSettings::table().apply(lines, &self.options)?;
            }
        }
        Ok(vectors)
    }

    /// Whether the view's exact lines lie over the picture that the style draws in passes. `--no-borders` leaves them out, too.
    pub fn has_lines_over(&self) -> bool {
        let leaves_lines_out = self.style.style_name().has_lines() && !self.style.has_lines();
        self.exact_lines && self.show == Show::Final && self.style.lines().is_none() && !leaves_lines_out
    }

    /// The style that OpenGL draws: without its own borders, where it can leave them out, if exact lines replace them.
    ///
    /// # Errors
    ///
    /// Those of the settings.
    pub fn style_in_passes(&self) -> Result<Style> {
        if self.has_lines_over() { self.style.without_borders() } else { Ok(self.style.clone()) }
    }

    /// The plan of the picture.
    ///
    /// # Errors
    ///
    /// Those of [`Style::plan`].
    pub fn plan(&self, scene: &Scene) -> Result<Plan> {
        self.style_in_passes()?.plan(&self.on_ground(scene), self.show)
    }

    /// How lines are drawn: the style's way, on the scene's background, with the request's title. `None` for a style without
    /// vectors or exact lines over its picture.
    ///
    /// # Errors
    ///
    /// As [`Request::vectors`].
    pub fn line_style(&self) -> Result<Option<LineStyle>> {
        let of_vectors = |Vectors { lines, drawing, .. }| LineStyle {
            lines: lines.unwrap_or_default(),
            drawing,
            ..LineStyle::default()
        };
        let style = match (self.style.lines(), self.lines_over()?) {
            (Some(style), _) | (None, Some(style)) => Some(style),
            (None, None) => self.vectors()?.map(of_vectors),
        };
        Ok(style.map(|mut style| {
            (style.drawing.title, style.drawing.background) = (self.title(), self.scene.background);
            style
        }))
    }

    /// The style of the exact lines over the picture, by the request's options alone: they are the same over every style.
    pub(crate) fn lines_over(&self) -> Result<Option<LineStyle>> {
        if !self.has_lines_over() {
            return Ok(None);
        }
        let mut style = LineStyle::default();
        LineSettings::table().apply(&mut style.lines, &self.options)?;
        DrawingSettings::table().apply(&mut style.drawing, &self.options)?;
        Ok(Some(style))
    }

    /// The lines to find, and the style that they are drawn in.
    fn asked(&self, wanted: Wanted) -> Result<(LineSettings, LineStyle)> {
        let Some(style) = self.line_style()? else {
            let problem = "this style draws a picture in passes; choose a style of lines";
            return Err(Error::value("style", self.style.name(), problem));
        };
        style.check()?;
        let mut lines = style.wanted();
        lines.finds_hidden |= wanted.all || wanted.hidden;
        lines.finds_outline |= wanted.all;
        lines.counts_changes = wanted.hidden && lines.silhouette == SilhouetteRule::Smooth;
        Ok((lines, style))
    }

    /// Whether the lines of this request serve another one that wants more of the same lines.
    ///
    /// # Errors
    ///
    /// As [`Request::all_lines`].
    pub fn finds_all_for(&self, other: &Self, wanted: Wanted) -> Result<bool> {
        let ((own, _), (others, _)) = (self.asked(Wanted::default())?, other.asked(wanted)?);
        Ok(self.is_of_areas_alone()? == other.is_of_areas_alone()?
            && own.finds_hidden >= others.finds_hidden
            && own.finds_outline >= others.finds_outline)
    }

    /// Whether the drawing has areas and no lines.
    fn is_of_areas_alone(&self) -> Result<bool> {
        Ok(self.vectors()?.is_some_and(|vectors| vectors.lines.is_none()))
    }

    /// Finds the lines of a scene that the drawing shows, short ones too.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a style without vectors and for nonsense; those of [`VisibleLines::with_progress`].
    pub fn all_lines(&self, scene: &Scene, wanted: Wanted, progress: &Progress) -> Result<VisibleLines> {
        let (lines, style) = self.asked(wanted)?;
        if self.is_of_areas_alone()? {
            return Ok(VisibleLines::none(scene.size));
        }
        if let Some(angle) = style.sheet {
            return VisibleLines::on_sheet(scene, &lines, (angle, &style.drawing), progress);
        }
        let mut found = VisibleLines::with_progress(scene, &lines, progress)?;
        found.put_to_scale(px_per_unit(scene), &style.drawing)?;
        Ok(found)
    }

    /// Makes the drawing of lines that [`Request::all_lines`] found: without those too short to see, with the areas below.
    ///
    /// # Errors
    ///
    /// As [`Request::all_lines`], and those of [`Vectors::areas`].
    pub fn drawing(
        &self,
        scene: Scene,
        lines: Arc<VisibleLines>,
        wanted: Wanted,
        progress: &Progress,
    ) -> Result<DrawnLines> {
        let (_, style) = self.asked(wanted)?;
        let lines = match wanted.all && style.drawing.min_length.is_none() {
            true => lines,
            false => Arc::new(lines.without_specks_with_progress(&style.drawing, progress)?),
        };
        let mut remarks = scene.crack_remarks();
        remarks.extend(scene.far_remark());
        remarks.extend(scene.cut_remark().filter(|_| self.scene.camera.near.is_none()));
        let fills = matches!(style.drawing.page_size, PageSize::Paper(_)) && lines.px_per_mm.is_none();
        if fills && self.options.contains_key("height") {
            remarks
                .push("--height does not set the scale, as the drawing fills its paper; --scale 1:1 does".to_owned());
        }
        // Over a picture of pixels no areas are wanted.
        let vectors = if wanted.areas || self.style.lines().is_some() { self.vectors()? } else { None };
        let mut areas = vectors.as_ref().map(|vectors| vectors.areas(&scene, &lines, progress)).transpose()?;
        remarks.extend(vectors.into_iter().flat_map(|vectors| vectors.remarks(&scene)));
        if let Some(areas) = areas.as_mut().filter(|_| !style.drawing.is_for_pen)
            && let Some((shadow, color)) = self.shadow(&scene, progress)?
        {
            areas.drawn.add_ground(&shadow, color);
        }
        let has_areas = areas.as_ref().is_some_and(|areas| areas.drawn.corners_px.is_some());
        if !has_areas && !lines.segments.iter().any(|segment| segment.is_visible) {
            remarks.push(no_line(&scene));
        }
        Ok(DrawnLines { scene, files: Vec::new(), style, lines, areas, remarks, load_ms: 0.0 })
    }

    /// Draws the lines and areas of a scene.
    ///
    /// # Errors
    ///
    /// As [`Request::drawing`].
    pub fn drawn_lines(&self, scene: Scene, wanted: Wanted, progress: &Progress) -> Result<DrawnLines> {
        let lines = self.all_lines(&scene, wanted, progress)?;
        self.drawing(scene, Arc::new(lines), wanted, progress)
    }
}
