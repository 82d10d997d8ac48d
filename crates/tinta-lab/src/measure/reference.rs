//! The exact lines of a scene as the yardstick of its ink: points along them, a tree that finds the nearest.

use super::Against;
use glam::DVec2;
use rstar::{PointDistance, RTree, RTreeObject};
use tinta::edges::{Class, ClassSet, CreaseAngle};
use tinta::error::Result;
use tinta::lines::closed_forms::ClosedForm;
use tinta::lines::{LineSegment, LineSettings, Progress, VisibleLines};
use tinta::scene::{Scene, Size};

/// Distance between points along a line, pixels: at a tolerance of 2 they see a distance by less than 0.001 too far.
const STEP_PX: f64 = 0.125;

/// The same for comparing lines with a contour in closed form, where distances are as small as thousandths of a pixel.
const FINE_STEP_PX: f64 = 1.0 / 128.0;

/// Creases between this angle and the reference's own threshold are ignored: filters of a picture may respond to any angle.
pub(super) const SOFT_CREASE_DEGREES: f64 = 20.0;

/// The visible lines of a scene.
#[derive(Debug)]
pub struct Reference {
    /// The picture's size.
    pub size: Size,
    /// The lines; empty for a surface.
    pub lines: VisibleLines,
    /// Their kind.
    pub against: Against,
    /// Least angle of a crease.
    pub crease_angle: CreaseAngle,
    /// Points along the lines.
    pub samples: Vec<Sample>,
    nearest: RTree<Place>,
    /// Points along the soft creases.
    ignored: RTree<Place>,
}

/// A point on a line that represents a piece of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Pixels from the upper left, y down.
    pub px: DVec2,
    /// Length of the piece, pixels.
    pub length_px: f64,
    /// The line's class.
    pub class: Class,
}

/// A point in a tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place(pub DVec2);

impl RTreeObject for Place {
    type Envelope = rstar::AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        rstar::AABB::from_point(self.0.to_array())
    }
}

impl PointDistance for Place {
    fn distance_2(&self, point: &[f64; 2]) -> f64 {
        self.0.distance_squared(DVec2::from_array(*point))
    }
}

/// A tree over points.
pub(super) fn tree(points: impl Iterator<Item = DVec2>) -> RTree<Place> {
    RTree::bulk_load(points.map(Place).collect())
}

/// Distance from a point to the nearest in a tree; infinite if it has none.
pub(super) fn distance(tree: &RTree<Place>, point: DVec2) -> f64 {
    tree.nearest_neighbor(point.to_array()).map_or(f64::INFINITY, |nearest| nearest.0.distance(point))
}

impl Reference {
    /// Finds the lines of a scene.
    ///
    /// # Errors
    ///
    /// As [`VisibleLines::of`].
    pub fn of(scene: &Scene, settings: &LineSettings) -> Result<Self> {
        Self::with_progress(scene, settings, &Progress::default())
    }

    /// Like [`Reference::of`], with the hidden lines.
    ///
    /// # Errors
    ///
    /// As [`VisibleLines::of`].
    pub fn with_hidden(scene: &Scene, settings: &LineSettings) -> Result<Self> {
        let all = LineSettings { finds_hidden: true, ..settings.clone() };
        Self::of_lines(scene, VisibleLines::of(scene, &all)?, &all, &Progress::default())
    }

    /// Like [`Reference::of`], with progress and cancellation.
    ///
    /// # Errors
    ///
    /// As [`VisibleLines::with_progress`].
    pub(crate) fn with_progress(scene: &Scene, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        // Ink is compared with visible lines.
        let seen = LineSettings { finds_hidden: false, ..settings.clone() };
        Self::of_lines(scene, VisibleLines::with_progress(scene, &seen, progress)?, settings, progress)
    }

    fn of_lines(scene: &Scene, lines: VisibleLines, settings: &LineSettings, progress: &Progress) -> Result<Self> {
        let soft = LineSettings {
            classes: ClassSet::of(&[Class::Crease]),
            crease_angle: CreaseAngle::from_degrees(SOFT_CREASE_DEGREES)?,
            finds_hidden: false,
            finds_outline: false,
            counts_changes: false,
            ..settings.clone()
        };
        let limit = settings.crease_angle.degrees();
        let is_between = |segment: &&LineSegment| segment.angle_degrees.is_none_or(|angle| angle <= limit);
        let soft = VisibleLines::with_progress(scene, &soft, progress)?;
        let ignored = soft.segments.iter().filter(|segment| segment.is_visible).filter(is_between).flat_map(samples_of);
        let ignored = tree(ignored.map(|sample| sample.px));
        let visible = lines.segments.iter().filter(|segment| segment.is_visible);
        let samples: Vec<Sample> = visible.flat_map(samples_of).collect();
        let nearest = tree(samples.iter().map(|sample| sample.px));
        let against = Against::Lines;
        Ok(Self { size: lines.size, crease_angle: settings.crease_angle, against, samples, nearest, ignored, lines })
    }

    /// The visible contour of the surface that the scene's only object is a mesh of. The rims of an open surface are ignored,
    /// like soft creases.
    ///
    /// # Errors
    ///
    /// As [`VisibleLines::of`].
    pub fn of_surface(scene: &Scene, surface: &ClosedForm) -> Result<Self> {
        let boundary = ClassSet::of(&[Class::Boundary]);
        let rims = LineSettings { classes: boundary, finds_hidden: false, ..LineSettings::as_published() };
        let rims = VisibleLines::of(scene, &rims)?;
        let ignored = rims.segments.iter().filter(|segment| segment.is_visible).flat_map(samples_of);
        let contour = surface.visible_contour(scene);
        let pieces = contour.iter().flat_map(|points| points.windows(2).map(|ends| [ends[0], ends[1]]));
        let samples = pieces.clone().flat_map(|ends| samples_between(ends, Class::Silhouette)).collect();
        Ok(Self {
            size: scene.size,
            crease_angle: CreaseAngle::default(),
            against: Against::Smooth,
            nearest: fine_tree(pieces),
            ignored: tree(ignored.map(|sample| sample.px)),
            samples,
            lines: VisibleLines { segments: Vec::new(), ..rims },
        })
    }

    /// The same with each visible point moved; the lines themselves do not move.
    #[must_use]
    pub(crate) fn moved(&self, to: impl Fn(DVec2) -> DVec2) -> Self {
        let samples: Vec<Sample> = self.samples.iter().map(|sample| Sample { px: to(sample.px), ..*sample }).collect();
        Self {
            size: self.size,
            lines: self.lines.clone(),
            against: self.against,
            crease_angle: self.crease_angle,
            nearest: tree(samples.iter().map(|sample| sample.px)),
            ignored: tree(self.ignored.iter().map(|place| to(place.0))),
            samples,
        }
    }

    /// Length of all visible lines, pixels.
    pub fn length_px(&self) -> f64 {
        total(self.samples.iter().map(|sample| sample.length_px))
    }

    /// Distance from a place in the picture to the nearest visible line, pixels.
    pub fn distance_px(&self, px: DVec2) -> f64 {
        distance(&self.nearest, px)
    }

    /// Distance to the nearest visible soft crease, pixels.
    pub fn distance_to_ignored_px(&self, px: DVec2) -> f64 {
        distance(&self.ignored, px)
    }
}

/// The middles of a segment's equal pieces.
pub(crate) fn samples_of(segment: &LineSegment) -> impl Iterator<Item = Sample> + use<> {
    samples_between(segment.ends_px, segment.class)
}

fn samples_between(ends: [DVec2; 2], class: Class) -> impl Iterator<Item = Sample> {
    let length_px = ends[0].distance(ends[1]) / count_of_steps(ends, STEP_PX);
    middles(ends, STEP_PX).map(move |px| Sample { px, length_px, class })
}

fn count_of_steps([a, b]: [DVec2; 2], step_px: f64) -> f64 {
    (a.distance(b) / step_px).ceil().max(1.0)
}

/// The middles of equal pieces of a line, none longer than a step.
pub(super) fn middles(ends: [DVec2; 2], step_px: f64) -> impl Iterator<Item = DVec2> {
    let count = count_of_steps(ends, step_px);
    (0..count as usize).map(move |index| ends[0].lerp(ends[1], (index as f64 + 0.5) / count))
}

/// A tree over points of lines, so dense that distances to them equal those to the lines within thousandths of a pixel.
pub(super) fn fine_tree(lines: impl Iterator<Item = [DVec2; 2]>) -> RTree<Place> {
    tree(lines.flat_map(|ends| middles(ends, FINE_STEP_PX)))
}

/// The sum, 0 if empty: the standard library's empty sum is -0.
pub(super) fn total(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |sum, value| sum + value)
}
