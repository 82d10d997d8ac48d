//! A drawing job and its result: values that the viewer and its drawing threads exchange.

use crate::camera::CameraSettings;
use crate::error::Result;
use crate::orbit::Orbit;
use crate::picture::Picture;
use crate::renderer::PassTime;
use crate::request::{Around, Request};
use crate::scene::{Scene, SceneSettings};
use crate::window::threads::coarse;
use crate::window::values::event::Side;
use std::sync::Arc;

/// A drawing job.
#[derive(Debug, Clone)]
pub struct Job {
    /// The models, at their places.
    pub scene: Arc<Scene>,
    /// From where.
    pub orbit: Orbit,
    /// The rest of the scene's settings.
    pub settings: SceneSettings,
    /// What to show on each visible side; the scene is this job's.
    pub drawings: Vec<(Side, Request)>,
    /// Whether each side's picture has the strokes of its request, exact lines or those of tones.
    pub has_strokes: [bool; 2],
    /// Those found before; others are found with the picture.
    pub found: [Option<Arc<Around>>; 2],
    /// Whether it may be coarser: the view is on its way to another.
    pub is_coarse: bool,
    /// Whether small patches of a tone stay: the view is on its way to another, and finding them takes time.
    pub keeps_patches: bool,
}

impl Job {
    /// The camera.
    ///
    /// # Errors
    ///
    /// As [`Orbit::settings`].
    pub(crate) fn camera(&self) -> Result<CameraSettings> {
        self.orbit.settings(&self.scene, &self.settings)
    }

    /// The scene with the current camera.
    ///
    /// # Errors
    ///
    /// As [`Scene::new`].
    pub(crate) fn scene(&self) -> Result<Scene> {
        let size = if self.is_coarse { coarse::size(self.settings.size) } else { self.settings.size };
        self.scene.seen_with(&SceneSettings { camera: self.camera()?, size, ..self.settings.clone() })
    }

    /// Whether the same models are drawn as in another, in pictures of the same size.
    pub(in crate::window) fn is_of_same_scene_and_size(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.settings.size == other.settings.size
    }

    /// The job of a view that has come to rest.
    pub(in crate::window) fn at_rest(self) -> Self {
        Self { is_coarse: false, keeps_patches: false, ..self }
    }

    /// The same view in other styles.
    pub(in crate::window) fn of(&self, drawings: Vec<(Side, Request)>) -> Self {
        Self { drawings, has_strokes: [false; 2], found: [None, None], ..self.clone().at_rest() }
    }

    /// Whether it shows the same scene in the same view as another, whatever it draws.
    pub(in crate::window) fn is_of_same_picture(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene) && self.orbit == other.orbit && self.settings == other.settings
    }

    /// A request of it, in its scene.
    pub(in crate::window) fn request(&self, request: &Request) -> Request {
        Request { scene: self.settings.clone(), ..request.clone() }
    }

    /// Whether it would draw the same as another.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        self.is_of_same_picture(other)
            && self.drawings == other.drawings
            && self.has_strokes == other.has_strokes
            && (self.is_coarse, self.keeps_patches) == (other.is_coarse, other.keeps_patches)
    }

    /// Whether its picture serves for another job: the same, or finer than needed.
    pub(in crate::window) fn does_for(&self, other: &Self) -> bool {
        let is_coarse = self.is_coarse && other.is_coarse;
        self.is_same(&Self { is_coarse, keeps_patches: self.keeps_patches && other.keeps_patches, ..other.clone() })
    }
}

/// The strokes and shadow of a side.
#[derive(Debug, Clone)]
pub enum Lines {
    /// Lines alone, as a picture.
    Alone(Picture),
    /// The strokes above a picture of passes, and the shadow below.
    Around(Arc<Around>),
}

/// Lines that were found.
#[derive(Debug)]
pub(crate) struct FoundLines {
    /// The view, and the requests of its sides.
    pub job: Job,
    /// The lines of each of its drawings.
    pub lines: Vec<Lines>,
    /// Time taken, milliseconds.
    pub ms: f64,
}

impl FoundLines {
    /// The strokes and shadow of a side, and their request.
    pub(in crate::window) fn of_side(&self, side: Side) -> Option<(&Request, &Lines)> {
        let place = self.job.drawings.iter().position(|(of, _)| *of == side)?;
        Some((&self.job.drawings[place].1, &self.lines[place]))
    }
}

/// A side's picture.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// The side.
    pub side: Side,
    /// The picture.
    pub picture: Picture,
    /// Time from the style's plan to the picture read back, milliseconds.
    pub frame_ms: f64,
}

/// The cost of a side's picture.
#[derive(Debug)]
pub(crate) struct Cost {
    /// The side.
    pub side: Side,
    /// The style's name.
    pub style: &'static str,
    /// Time of a whole frame, from the style's plan to the picture read back: the median of a few, milliseconds.
    pub frame_ms: f64,
    /// Time of each pass.
    pub passes: Vec<PassTime>,
    /// Whether the style draws lines.
    pub has_lines: bool,
    /// The darkness of each pixel of its lines; `None` without lines, and if not measured.
    pub ink: Option<Vec<u8>>,
}
