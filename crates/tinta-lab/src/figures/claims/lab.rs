//! The tools that measure claims: scenes read once, pictures, ink against exact lines, frames that take turns, and a few numbers
//! about pictures.

use super::finding::Number;
use crate::figures::measure::HowToMeasure;
use crate::figures::series::{Contestant, Interval, Series, gain_percent, take_turns};
use crate::measure::{Ink, Reference};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;
use tinta::error::Result;
use tinta::lines::LineSettings;
use tinta::mesh::{LoadOptions, Mesh, load};
use tinta::picture::Picture;
use tinta::plan::Plan;
use tinta::renderer::Renderer;
use tinta::scene::{Background, Scene, SceneSettings, Size};
use tinta::styles::{Phong, Show, Style};

/// The models that errors are the mean of.
pub(super) const MODELS: [&str; 4] = ["builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box"];

/// Distance within which ink and line are the same, pixels.
pub(super) const TOLERANCE_PX: f64 = 2.0;

/// A renderer with the models and results so far.
pub(super) struct Lab<'a> {
    pub(super) renderer: &'a mut Renderer,
    pub(super) size: Size,
    frames: usize,
    scenes: HashMap<&'static str, Arc<Scene>>,
    references: HashMap<&'static str, Rc<Reference>>,
}

impl<'a> Lab<'a> {
    pub(super) fn new(renderer: &'a mut Renderer, how: &HowToMeasure) -> Self {
        let (scenes, references) = (HashMap::new(), HashMap::new());
        Self { renderer, size: how.size, frames: how.frames, scenes, references }
    }

    /// A built-in model alone.
    pub(super) fn mesh(&self, model: &str) -> Result<Arc<Mesh>> {
        Ok(Arc::new(load(model, &LoadOptions::default())?.mesh))
    }

    /// A built-in model from the default view.
    pub(super) fn scene(&mut self, model: &'static str) -> Result<Arc<Scene>> {
        if !self.scenes.contains_key(model) {
            let settings = SceneSettings { size: self.size, ..SceneSettings::default() };
            self.scenes.insert(model, Arc::new(Scene::new(vec![self.mesh(model)?], &settings)?));
        }
        Ok(self.scenes[model].clone())
    }

    /// The same model as other settings show it, in the lab's size.
    pub(super) fn seen(&mut self, model: &'static str, settings: SceneSettings) -> Result<Arc<Scene>> {
        let size = self.size;
        Ok(Arc::new(self.scene(model)?.seen_with(&SceneSettings { size, ..settings })?))
    }

    pub(super) fn draw(&mut self, scene: &Scene, style: &Style, show: Show) -> Result<Picture> {
        self.renderer.draw(scene, &style.plan(scene, show)?)
    }

    /// The exact lines of a model from the default view.
    pub(super) fn lines(&mut self, model: &'static str) -> Result<Rc<Reference>> {
        if !self.references.contains_key(model) {
            let scene = self.scene(model)?;
            self.references.insert(model, Rc::new(Reference::of(&scene, &LineSettings::as_published())?));
        }
        Ok(self.references[model].clone())
    }

    /// A style's lines of a model from the default view.
    pub(super) fn ink(&mut self, model: &'static str, style: &Style) -> Result<Ink> {
        let scene = self.scene(model)?;
        let none = Ink { size: self.size, darkness: vec![0; self.size.pixel_count()] };
        Ok(Ink::of_style(self.renderer, &scene, style)?.unwrap_or(none))
    }

    /// A style's lines against the exact ones, mean over the built-in models.
    pub(super) fn error(&mut self, style: &Style) -> Result<Error> {
        let mut sum = Error::default();
        for model in MODELS {
            let (ink, lines) = (self.ink(model, style)?, self.lines(model)?);
            let error = ink.error(&lines, TOLERANCE_PX);
            sum.recall += error.recall / MODELS.len() as f64;
            sum.precision += error.precision / MODELS.len() as f64;
            sum.precision_of_all += error.precision_of_all / MODELS.len() as f64;
            sum.f1 += error.f1 / MODELS.len() as f64;
        }
        Ok(sum)
    }

    /// How much more a frame of the second style costs than one of the first, percent.
    pub(super) fn slower_percent(&mut self, model: &'static str, styles: &[Style; 2]) -> Result<Interval> {
        let scene = self.scene(model)?;
        let frames: Result<Vec<_>> =
            styles.iter().map(|style| Ok((scene.clone(), style.plan(&scene, Show::Final)?))).collect();
        let series = self.times(frames?)?;
        Ok(gain_percent(&series[0], &series[1]))
    }

    /// Frames of each, one of each in turn.
    pub(super) fn times(&mut self, frames: Vec<(Arc<Scene>, Plan)>) -> Result<Vec<Series>> {
        let mut contestants: Vec<Contestant> =
            frames.into_iter().map(|(scene, plan)| Contestant::new(&scene, plan)).collect();
        take_turns(self.renderer, &mut contestants, self.frames, &mut || {})?;
        Ok(contestants.iter().map(Contestant::series).collect())
    }

    /// Where a scene's objects are in the picture: a flag for each pixel.
    pub(super) fn mask(&mut self, scene: &Scene) -> Result<Vec<bool>> {
        let bare = Scene { background: Background::Transparent, ..scene.clone() };
        let picture = self.draw(&bare, &Style::Phong(Phong::default()), Show::Final)?;
        Ok(picture.pixels.chunks_exact(4).map(|pixel| pixel[3] > 0).collect())
    }
}

/// A mean error of lines.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Error {
    pub(super) recall: f64,
    pub(super) precision: f64,
    /// Faint ink too.
    pub(super) precision_of_all: f64,
    pub(super) f1: f64,
}

impl Error {
    pub(super) fn numbers(self, of: &str) -> Vec<Number> {
        let name = |what: &str| if of.is_empty() { what.to_owned() } else { format!("{of}, {what}") };
        vec![Number::share(name("lines found"), self.recall), Number::share(name("ink on a line"), self.precision)]
    }
}

/// Share of pixels with a channel that differs by more than `limit`; with flags, of the flagged pixels.
pub(super) fn changed(one: &Picture, other: &Picture, limit: u8, mask: Option<&[bool]>) -> f64 {
    let (mut changed, mut all) = (0usize, 0usize);
    for (index, (a, b)) in one.pixels.chunks_exact(4).zip(other.pixels.chunks_exact(4)).enumerate() {
        if mask.is_none_or(|mask| mask[index]) {
            all += 1;
            changed += usize::from(a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > limit));
        }
    }
    changed as f64 / all.max(1) as f64
}

/// The red of the pixels with a flag: charcoal's pictures are grey.
pub(super) fn greys<'p>(picture: &'p Picture, mask: &'p [bool]) -> impl Iterator<Item = f64> + 'p {
    let pixels = picture.pixels.chunks_exact(4).zip(mask);
    pixels.filter(|(_, is_in)| **is_in).map(|(pixel, _)| f64::from(pixel[0]))
}

pub(super) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0usize), |(sum, count), value| (sum + value, count + 1));
    sum / count.max(1) as f64
}

/// Mean difference between pixels with a flag and their right neighbours with one, of 255: how much grain there is.
pub(super) fn roughness(picture: &Picture, mask: &[bool]) -> f64 {
    let width = picture.size.width as usize;
    let grey = |index: usize| f64::from(picture.pixels[index * 4]);
    let pairs = (1..mask.len()).filter(|index| index % width > 0 && mask[*index] && mask[index - 1]);
    mean(pairs.map(|index| (grey(index) - grey(index - 1)).abs()))
}
