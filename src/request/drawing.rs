//! Drawings of lines and areas: finding them, and the one place where they become a file.
//!
//! Every door ends here: it chooses a [`DrawingFormat`] and a target, and may give a recipe or paths whose strokes keep their numbers.

use super::emptiness::reason;
use super::{Resolved, WantedLines};
use crate::edges::{Class, SilhouetteRule};
use crate::error::{Error, Result};
use crate::lines::{
    DrawingContent, DrawingFormat, DrawingSettings, HiddenLines, Length, LinePath, LineSegment, LineSettings, PageSize,
    Progress, Raster, Sight, Strokes, VisibleLines, chain, raster_of_paths, strokes_of_paths,
};
use crate::output::TextTarget;
use crate::picture::{Note, Picture, Target};
use crate::recipe::Recipe;
use crate::record::{drawing_json, px_per_unit};
use crate::scene::{Scene, UnseenReason};
use crate::styles::{Below, Contents, ViewAreas};
use crate::threads::both;
use std::path::PathBuf;
use std::sync::Arc;

/// Lines and areas, and how they were found.
#[derive(Debug, Clone)]
pub struct DrawnLines {
    /// The request and the scene.
    pub resolved: Resolved,
    /// The files read besides the models' own files.
    pub files: Vec<PathBuf>,
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
    pub(crate) fn paths(&self) -> Vec<LinePath> {
        let mut paths = chain(&self.lines.segments);
        let shows_hidden =
            |look: u32| self.lines.drawing(look, &self.resolved.contents.drawing).hidden != HiddenLines::None;
        paths.retain(|path| path.is_visible || shows_hidden(path.look));
        paths
    }

    /// The strokes that lie over a picture of the same view, those of tones included.
    ///
    /// # Errors
    ///
    /// Those of [`strokes_of_paths`].
    pub(crate) fn strokes(&self) -> Result<Vec<Strokes>> {
        let areas = self.areas.as_ref().map(|areas| &areas.drawn);
        strokes_of_paths(&self.lines, self.paths(), areas, &self.resolved.contents.drawing)
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
        let output = format!("drawing.{}", format.ending);
        let settings = DrawingSettings {
            command: recipe.map(|recipe| recipe.command_line(&output)).unwrap_or_default(),
            recipe: recipe.and_then(Recipe::json).unwrap_or_default(),
            ..self.resolved.contents.drawing.clone()
        };
        let (lines, areas) = (&*self.lines, self.areas.as_ref());
        let below = areas.map(|areas| &areas.drawn);
        let paths = || paths.unwrap_or_else(|| self.paths());
        Ok(match format.content {
            DrawingContent::Vectors(write) => DrawingFile::Bytes(write(lines, paths(), below, &settings)?),
            DrawingContent::Data => {
                let regions = areas.map(|areas| &areas.regions);
                DrawingFile::Bytes(drawing_json(lines, regions, &self.resolved.scene)?.into_bytes())
            }
            DrawingContent::Pixels => {
                let Raster { size, pixels } = raster_of_paths(lines, paths(), &settings)?;
                DrawingFile::Picture(Picture { size, pixels }, recipe.and_then(Recipe::note))
            }
        })
    }
}

/// The remark on a drawing without any visible line.
fn no_line(scene: &Scene) -> String {
    let why = match scene.unseen(scene.size, false) {
        unseen @ Some(UnseenReason::Behind | UnseenReason::Beside | UnseenReason::CutOff) => {
            format!(": {}", reason(scene, unseen))
        }
        _ => "; see --classes, --eye and --target".to_owned(),
    };
    format!("no line of these classes is visible in this picture{why}")
}

impl Contents {
    /// The lines to find.
    fn to_find(&self, wanted: WantedLines) -> Option<LineSettings> {
        self.wanted().map(|mut lines| {
            lines.finds_hidden |= wanted.all || wanted.hidden;
            lines.finds_outline |= wanted.all;
            lines.counts_changes = wanted.hidden && lines.silhouette == SilhouetteRule::Smooth;
            lines
        })
    }

    /// Whether the lines found for these contents serve others that want more of the same lines.
    pub fn finds_all_for(&self, other: &Self, wanted: WantedLines) -> bool {
        match (self.to_find(WantedLines::default()), other.to_find(wanted)) {
            (Some(own), Some(others)) => {
                own.finds_hidden >= others.finds_hidden && own.finds_outline >= others.finds_outline
            }
            (own, others) => own.is_none() == others.is_none(),
        }
    }
}

impl Resolved {
    /// Finds the lines that the drawing shows, short ones too.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a picture of passes without exact lines; those of [`VisibleLines::with_progress`].
    pub fn all_lines(&self, sight: &Sight<'_>, wanted: WantedLines, progress: &Progress) -> Result<VisibleLines> {
        let (scene, Contents { below, drawing, sheet, .. }) = (&self.scene, &self.contents);
        let Some(lines) = self.contents.to_find(wanted) else {
            if let Below::Passes(style) = below {
                let problem = "this style draws a picture in passes; choose a style of lines";
                return Err(Error::value("style", style.name(), problem));
            }
            return Ok(VisibleLines::none(scene.size));
        };
        if let Some(angle) = sheet {
            return VisibleLines::on_sheet(scene, &lines, (*angle, drawing, self.request.title_block()), progress);
        }
        let mut found = VisibleLines::in_sight(sight, &lines, progress)?;
        found.put_to_scale(px_per_unit(scene), drawing)?;
        Ok(found)
    }

    /// Makes the drawing of lines that [`Resolved::all_lines`] found: without those too short to see, with the areas below.
    ///
    /// # Errors
    ///
    /// Those of [`Contents::areas`].
    pub fn drawing(
        &self,
        sight: &Sight<'_>,
        lines: Arc<VisibleLines>,
        wanted: WantedLines,
        progress: &Progress,
    ) -> Result<DrawnLines> {
        let (scene, contents) = (&self.scene, &self.contents);
        let drawing = &contents.drawing;
        let keeps_short = wanted.short && drawing.min_length.is_none();
        let min_length = if keeps_short { Some(Length::Px(0.0)) } else { drawing.min_length };
        let of_specks = DrawingSettings { min_length, ..drawing.clone() };
        let lines = match keeps_short && wanted.all {
            true => lines,
            false => Arc::new(lines.without_specks_with_progress(&of_specks, progress)?),
        };
        let mut remarks = scene.crack_remarks();
        remarks.extend(scene.far_remark());
        remarks.extend(scene.cut_remark().filter(|_| self.request.scene.camera.near.is_none()));
        let fills = matches!(drawing.page_size, PageSize::Paper(_)) && lines.px_per_mm.is_none();
        if fills && self.request.options.contains_key("height") {
            remarks
                .push("--height does not set the scale, as the drawing fills its paper; --scale 1:1 does".to_owned());
        }
        let is_centre = |segment: &LineSegment| segment.class == Class::Centre;
        if contents.asks_for(Class::Centre) && !lines.segments.iter().any(is_centre) {
            remarks
                .push("--classes centre: these models have no cylinder, cone or sphere to draw an axis of".to_owned());
        }
        let mut areas = contents.areas(&sight.of_same_faces(self.lit()), &lines, progress)?;
        remarks.extend(contents.remarks(scene));
        if let Some(areas) = areas.as_mut().filter(|_| !drawing.is_for_pen) {
            self.add_shadow(&mut areas.drawn, progress)?;
        }
        let has_areas = areas.as_ref().is_some_and(|areas| areas.drawn.corners_px.is_some());
        if !has_areas && !lines.segments.iter().any(|segment| segment.is_visible) {
            remarks.push(no_line(scene));
        }
        Ok(DrawnLines { resolved: self.clone(), files: Vec::new(), lines, areas, remarks, load_ms: 0.0 })
    }

    /// Finds and draws the lines and areas.
    ///
    /// # Errors
    ///
    /// Those of [`Resolved::all_lines`] and [`Resolved::drawing`].
    pub fn drawn_lines(&self, wanted: WantedLines, progress: &Progress) -> Result<DrawnLines> {
        let sight = Sight::of(&self.scene);
        // Light and shadow take one thread, and the lines leave one free at times.
        let has_tones = matches!(self.contents.below, Below::Tones(..));
        let (lines, _) = both(
            || self.all_lines(&sight, wanted, progress),
            || {
                has_tones.then(|| self.lit());
                // What ends it is told where it is drawn.
                self.find_shadow(&progress.beside())
            },
        );
        self.drawing(&sight, Arc::new(lines?), wanted, progress)
    }
}
