//! The shadow below and the exact lines above a picture of passes.

use super::{Ground, Request, Resolved};
use crate::clock::{Instant, milliseconds_since};
use crate::error::Result;
use crate::lines::{
    Areas, FillGroup, Progress, Strokes, ground_shadow, lay_fills, lay_over, lay_strokes, lay_strokes_by,
    raster_of_strokes,
};
use crate::picture::Picture;
use crate::plan::{Pass, Plan, Step, TOOTH};
use crate::renderer::Renderer;
use crate::scene::{Background, Color, Scene, Size};
use crate::styles::Below;

/// The shadow and the lines around a picture of passes.
#[derive(Debug, Clone)]
pub struct Around {
    background: Background,
    /// The shadow on the ground; all areas of a drawing whose tones are strokes.
    pub(super) below: Option<Areas>,
    /// The strokes of exact lines and of tones.
    strokes: Vec<Strokes>,
    /// How long finding all of it took, milliseconds.
    pub found_ms: f64,
}

/// Exact lines that take less time than this are drawn at once with each picture of a turning model, milliseconds.
pub const LINES_AT_ONCE_MS: f64 = 30.0;

/// The share of the background's red, green and blue in a shadow: a warm grey.
const SHADE: [f32; 3] = [0.85, 0.835, 0.81];

impl Resolved {
    /// Finds the shadow and the lines around the picture of passes; all of a drawing whose tones are strokes.
    ///
    /// # Errors
    ///
    /// As [`Resolved::drawing`].
    pub fn around(&self, progress: &Progress) -> Result<Around> {
        let start = Instant::now();
        let (mut strokes, mut below) = (Vec::new(), None);
        if self.contents.has_strokes() {
            let drawn = self.drawn_lines(Default::default(), progress)?;
            (strokes, below) = (drawn.strokes()?, drawn.areas.map(|areas| areas.drawn));
        }
        // Areas have a shadow of their own.
        if below.is_none() && self.request.ground == Ground::Shadow {
            self.add_shadow(below.insert(Areas::default()), progress)?;
        }
        Ok(Around { background: self.scene.background, below, strokes, found_ms: milliseconds_since(start) })
    }

    /// Adds the shadow on the ground, if the request has one.
    pub(super) fn add_shadow(&self, below: &mut Areas, progress: &Progress) -> Result<()> {
        if self.request.ground != Ground::Shadow {
            return Ok(());
        }
        let ground = match self.scene.background {
            Background::Color(Color(channels)) => channels,
            Background::Transparent => [1.0; 3],
        };
        self.find_shadow(progress)?;
        let shade = Color([0, 1, 2].map(|channel| ground[channel] * SHADE[channel]));
        self.shadow.get().into_iter().for_each(|shadow| below.add_ground(shadow, shade));
        Ok(())
    }

    /// Finds the shadow on the ground, if the request has one and it is not known.
    ///
    /// # Errors
    ///
    /// Those of [`ground_shadow`].
    pub(super) fn find_shadow(&self, progress: &Progress) -> Result<()> {
        if self.request.ground == Ground::Shadow && self.shadow.get().is_none() {
            let shadow = ground_shadow(&self.scene, self.request.shadow_light(&self.scene), progress)?;
            self.shadow.get_or_init(|| shadow);
        }
        Ok(())
    }

    /// The plan of the picture of passes. On a ground it has no background; it is empty where strokes stand for tones.
    ///
    /// # Errors
    ///
    /// Those of [`crate::Style::plan`].
    pub fn plan(&self) -> Result<Plan> {
        let Request { style, show, ground, .. } = &self.request;
        let style = match &self.contents.below {
            Below::Passes(style) => style,
            _ if self.contents.is_hatched() => {
                return Ok(Plan::new(vec![Pass::new("nothing", vec![Step::clear([0.0; 4])])]));
            }
            _ => style,
        };
        match ground {
            Ground::Shadow => style.plan(&Scene { background: Background::Transparent, ..self.lit().clone() }, *show),
            Ground::None | Ground::Auto => style.plan(self.lit(), *show),
        }
    }
}

impl Around {
    /// Carries out a plan of a view, and puts its picture between ground and lines.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub fn drawn(&self, view: &Resolved, plan: &Plan, renderer: &mut Renderer) -> Result<Picture> {
        let mut picture = renderer.draw(view.lit(), plan)?;
        self.put(plan, &mut picture);
        Ok(picture)
    }

    /// The exact lines as they lie over the picture of a plan, on nothing: opacity is their share of a pixel.
    pub fn lines_alone(&self, plan: &Plan, size: Size) -> Picture {
        let mut picture = Picture { size, pixels: vec![0; size.pixel_count() * 4] };
        lay(&self.strokes, plan, &mut picture);
        picture
    }

    /// Puts the picture of a plan between ground and lines.
    pub(super) fn put(&self, plan: &Plan, picture: &mut Picture) {
        self.below.iter().for_each(|below| self.put_on(&below.fills, picture));
        lay(&self.strokes, plan, picture);
    }

    /// Puts the picture of an empty scene on the ground.
    pub(super) fn put_bare(&self, picture: &mut Picture) {
        self.below.iter().for_each(|_| self.put_on(&[], picture));
    }

    /// Puts a picture without a background on the ground with these areas.
    fn put_on(&self, areas: &[FillGroup], picture: &mut Picture) {
        let mut ground = raster_of_strokes(&[], picture.size, self.background).pixels;
        lay_fills(areas, picture.size, &mut ground);
        for (below, pixel) in ground.chunks_exact_mut(4).zip(picture.pixels.chunks_exact(4)) {
            if pixel[3] == 255 {
                below.copy_from_slice(pixel);
            } else if pixel[3] > 0 {
                let [red, green, blue, opacity] = [0, 1, 2, 3].map(|channel| f32::from(pixel[channel]) / 255.0);
                lay_over(below, Color([red, green, blue]), opacity);
            }
        }
        picture.pixels = ground;
    }
}

/// Lays strokes over the picture of a plan: as ink, or as charcoal where the plan has the paper's tooth.
fn lay(strokes: &[Strokes], plan: &Plan, picture: &mut Picture) {
    /// Share of black on paper of middling height, and how much a height of 1 adds to it. Charcoal leaves hollows bare.
    const CHARCOAL: f32 = 0.6;
    const PER_HEIGHT: f32 = 0.8;
    let Picture { size, pixels } = picture;
    let Some(tooth) = plan.pictures.iter().find(|picture| picture.name == TOOTH).map(|tooth| &tooth.picture) else {
        return lay_strokes(strokes, *size, pixels);
    };
    // The paper covers the longer side, as under the drawing.
    let scale = tooth.size.width as f32 / size.width.max(size.height) as f32;
    lay_strokes_by(strokes, *size, pixels, |pixel| {
        let [x, y] = [pixel % size.width as usize, pixel / size.width as usize].map(|at| at as f32 * scale);
        let height = tooth_at(tooth, [x, y]) / 127.5 - 1.0;
        (CHARCOAL + PER_HEIGHT * height).clamp(0.0, 1.0)
    });
}

/// A paper's height between its texels, 0 to 255.
fn tooth_at(tooth: &Picture, place: [f32; 2]) -> f32 {
    let ([x, y], [right, down]) = (place.map(|at| at as i64), place.map(f32::fract));
    let row = |y: i64| {
        let [left, beside] = [x, x + 1].map(|x| f32::from(tooth.pixel(x, y)[0]));
        left + (beside - left) * right
    };
    row(y) + (row(y + 1) - row(y)) * down
}
