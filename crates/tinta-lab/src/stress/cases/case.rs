//! A case: its work, its required outcome, and the required values of its figures.

use crate::stress::{Shape, Variant};
use glam::{DMat4, DVec3};
use serde::Serialize;
use tinta::camera::{CameraSettings, View};
use tinta::gl::Fault;
use tinta::scene::Size;

/// Placeholders for the largest side that a backend draws, and for one pixel more.
pub(super) const LARGEST: u32 = u32::MAX - 1;

/// Share of pixels that may differ between pictures of one surface whose numbers round differently: an edge that passes a pixel's
/// middle by less than that falls on its other side.
pub(super) const ROUNDED: f64 = 0.002;

/// The extreme property of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// Very small, very large, very far away.
    Scale,
    /// Planes, angles and places of the camera.
    Depth,
    /// How faces meet.
    Topology,
    /// Settings and geometry at the very edge of a decision.
    Thresholds,
    /// The picture's own size.
    Pictures,
    /// What a model or another program gives GL.
    Inputs,
    /// Some of all that together, by chance.
    Mixes,
    /// A turn by small steps.
    Turns,
    /// A file that lies.
    Files,
    /// A driver that fails.
    Faults,
}

/// The required outcome of a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Demand {
    /// A picture, the same on every backend and with every omission, from finite numbers.
    Rendered,
    /// An error of this kind whose sentence contains these words.
    Refused {
        /// The name returned by [`tinta::Error::kind`].
        kind: &'static str,
        /// The words it must contain.
        words: &'static str,
    },
    /// One or the other, but of these kinds only: for cases made by chance.
    Either(&'static [&'static str]),
}

/// A figure and the values it may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// Its name in the row.
    pub figure: &'static str,
    /// Least value.
    pub least: f64,
    /// Largest value.
    pub most: f64,
}

/// How much is found out about a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Study {
    /// Only that it is drawn, the same everywhere: for scenes and pictures too large for more.
    Picture,
    /// Also its exact lines, its error, and the effect of a jitter on both.
    Full,
    /// Instead of a jitter a turn by small steps.
    Turn,
}

/// A scene to draw. The camera is given around the shape before scaling and moving.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// The shape.
    pub shape: Shape,
    /// How much larger than it is.
    pub scale: f64,
    /// Then moved by this, file units.
    pub offset: DVec3,
    /// From where: eye, target and planes in the shape's own units.
    pub camera: CameraSettings,
    /// The picture's size.
    pub size: Size,
    /// How often it is repeated.
    pub copies: u32,
    /// The styles.
    pub variants: Vec<Variant>,
    /// How much is found out.
    pub study: Study,
    /// Another program's matrix in place of the camera: clip space from world space, by columns.
    pub matrix: Option<DMat4>,
    /// A drawing that its picture is compared with.
    pub twin: Option<Box<Drawing>>,
}

impl Drawing {
    /// Whether its size follows from a backend's limit.
    pub(crate) fn is_of_largest(&self) -> bool {
        self.size.width.max(self.size.height) >= LARGEST
    }

    /// Whether the default look draws it, too: where all styles do.
    pub(in crate::stress) fn draws_look(&self) -> bool {
        self.variants == Variant::all()
    }
}

/// A side in pixels; replaces the placeholders for the largest side, and for one pixel more.
pub(in crate::stress) fn side_px(side: u32, largest: u32) -> u32 {
    match side.checked_sub(LARGEST) {
        None => side,
        Some(more) => largest.saturating_add(more),
    }
}

impl Default for Drawing {
    /// The unchanged cube, in all styles.
    fn default() -> Self {
        Self {
            shape: Shape::Cube,
            scale: 1.0,
            offset: DVec3::ZERO,
            camera: CameraSettings::default(),
            size: Size { width: 128, height: 128 },
            copies: 1,
            variants: Variant::all(),
            study: Study::Full,
            matrix: None,
            twin: None,
        }
    }
}

/// The contents of a model file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// These bytes.
    Bytes(Vec<u8>),
    /// As many zeros, which take no space on most disks.
    Zeros(u64),
    /// No content: it is a folder.
    Folder,
    /// No content: it is missing.
    Missing,
}

/// The work of a case.
#[derive(Debug, Clone)]
pub enum Work {
    /// A picture.
    Draw(Box<Drawing>),
    /// A model file of this name is read.
    Read(&'static str, Content),
    /// A cube in this style by a driver that fails, and once more by one that does not.
    Fail(Fault, Box<Variant>),
}

/// A case.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name, unique.
    pub name: String,
    /// Its group.
    pub group: Group,
    /// The work.
    pub work: Work,
    /// Its required outcome.
    pub expected: Demand,
    /// The required values of figures.
    pub checks: Vec<Check>,
    /// The right answer in words; empty where outcome and figures say it all.
    pub answer: &'static str,
    /// Whether the picture loses something by the text's own design, as much as the figures allow.
    pub is_degraded: bool,
}

/// A camera that looks from one place at another.
pub(super) fn looking(eye: DVec3, target: DVec3) -> CameraSettings {
    CameraSettings { eye: Some(eye), target: Some(target), ..CameraSettings::default() }
}

/// A camera fitted to a view by name.
pub(super) fn viewed(view: &str) -> CameraSettings {
    CameraSettings { view: view.parse().unwrap_or(View::DEFAULT), ..CameraSettings::default() }
}

impl Case {
    pub(super) fn of(group: Group, name: impl Into<String>, work: Work, expected: Demand) -> Self {
        Self { name: name.into(), group, work, expected, checks: Vec::new(), answer: "", is_degraded: false }
    }

    pub(super) fn rendered(group: Group, name: impl Into<String>, drawing: Drawing) -> Self {
        Self::of(group, name, Work::Draw(Box::new(drawing)), Demand::Rendered)
    }

    /// The same for a picture that loses something by design.
    pub(super) fn degrades(self) -> Self {
        Self { is_degraded: true, ..self }
    }

    /// The kind of its right answer for a row; `is_known`: whether one of the row's figures has an answer.
    pub(crate) fn kind(&self, is_known: bool) -> &'static str {
        match self.expected {
            Demand::Refused { .. } => "refused",
            Demand::Either(_) => "holds or is refused",
            Demand::Rendered if self.is_degraded => "degrades as computed",
            Demand::Rendered if is_known => "holds",
            Demand::Rendered => "drawn, and the same everywhere",
        }
    }

    pub(super) fn refused(
        group: Group,
        name: impl Into<String>,
        drawing: Drawing,
        kind: &'static str,
        words: &'static str,
    ) -> Self {
        let drawing = Box::new(Drawing { study: Study::Picture, ..drawing });
        Self::of(group, name, Work::Draw(drawing), Demand::Refused { kind, words })
    }

    /// The same with one more figure that must lie between two values.
    pub(super) fn with(mut self, figure: &'static str, least: f64, most: f64) -> Self {
        self.checks.push(Check { figure, least, most });
        self
    }
}
