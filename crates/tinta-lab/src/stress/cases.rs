//! The cases, as data.

mod depth;
mod faults;
mod files;
mod mixes;
mod pictures;
mod scale;
mod thresholds;
mod topology;
mod turntable;

use super::{Shape, Variant};
use glam::DVec3;
use serde::Serialize;
use tinta::camera::CameraSettings;
use tinta::gl::Fault;
use tinta::scene::Size;

/// What is extreme about a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// Very small, very large, very far away.
    Scale,
    /// Planes, angles and places of the camera.
    Depth,
    /// Which faces meet where.
    Topology,
    /// Settings and geometry at the very edge of a decision.
    Thresholds,
    /// The picture's own size.
    Pictures,
    /// Some of all that together, by chance.
    Mixes,
    /// A turn by small steps.
    Turns,
    /// A file that lies.
    Files,
    /// A driver that fails.
    Faults,
}

/// What must come of a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Expected {
    /// A picture, the same on every backend and with every omission, from finite numbers.
    Rendered,
    /// An error of this kind whose sentence has these words in it.
    Refused {
        /// As [`tinta::Error::kind`] says it.
        kind: &'static str,
        /// What it must name.
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
    /// Also its exact lines, its error, and what a jitter does to both.
    Full,
    /// Instead of a jitter a turn by small steps.
    Turn,
}

/// A scene to draw. The camera is given around the shape as it is before it is scaled and moved.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// What is drawn.
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
    /// In which styles.
    pub variants: Vec<Variant>,
    /// How much is found out.
    pub study: Study,
    /// Whether its picture is compared with that of the shape as it is.
    pub is_compared_with_unit: bool,
}

impl Drawing {
    /// Whether its size follows from what a backend can draw.
    pub fn is_of_largest(&self) -> bool {
        self.size.width.max(self.size.height) >= pictures::LARGEST
    }
}

/// A side in pixels; the one that stands for the largest becomes that, and one more than it one more.
pub(super) fn side_px(side: u32, largest: u32) -> u32 {
    match side.checked_sub(pictures::LARGEST) {
        None => side,
        Some(more) => largest.saturating_add(more),
    }
}

impl Default for Drawing {
    /// The cube as it is, in all styles.
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
            is_compared_with_unit: false,
        }
    }
}

/// What a model file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// These bytes.
    Bytes(Vec<u8>),
    /// As many zeros, which take no room on most disks.
    Zeros(u64),
    /// Nothing: it is a folder.
    Folder,
    /// Nothing: it is not there.
    Missing,
}

/// What is done.
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
    /// What is done.
    pub work: Work,
    /// What must come of it.
    pub expected: Expected,
    /// Which figures must have which values.
    pub checks: Vec<Check>,
}

impl Case {
    fn rendered(group: Group, name: impl Into<String>, drawing: Drawing) -> Self {
        Self {
            name: name.into(),
            group,
            work: Work::Draw(Box::new(drawing)),
            expected: Expected::Rendered,
            checks: Vec::new(),
        }
    }

    fn refused(
        group: Group,
        name: impl Into<String>,
        drawing: Drawing,
        kind: &'static str,
        words: &'static str,
    ) -> Self {
        let expected = Expected::Refused { kind, words };
        Self { expected, ..Self::rendered(group, name, Drawing { study: Study::Picture, ..drawing }) }
    }

    /// The same with one more figure that must lie between two values.
    fn with(mut self, figure: &'static str, least: f64, most: f64) -> Self {
        self.checks.push(Check { figure, least, most });
        self
    }

    /// The styles in which it is drawn.
    pub fn variants(&self) -> &[Variant] {
        match &self.work {
            Work::Draw(drawing) => &drawing.variants,
            Work::Read(..) => &[],
            Work::Fail(_, variant) => std::slice::from_ref(variant.as_ref()),
        }
    }
}

/// All cases in the groups' order; `seed` decides the mixes, of which there are `mixes`.
pub fn cases(seed: u64, mixes: usize) -> Vec<Case> {
    let mut all = scale::cases();
    all.extend(depth::cases());
    all.extend(topology::cases());
    all.extend(thresholds::cases());
    all.extend(pictures::cases());
    all.extend(mixes::cases(seed, mixes));
    all.extend(turntable::cases());
    all.extend(files::cases());
    all.extend(faults::cases());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_more_than_sixty_cases_with_names_of_their_own_in_every_group() {
        let all = cases(0, 20);
        assert!(all.len() >= 60, "{}", all.len());
        let mut names: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
        names.sort_unstable();
        names.windows(2).for_each(|pair| assert_ne!(pair[0], pair[1]));
        use Group::{Depth, Faults, Files, Mixes, Pictures, Scale, Thresholds, Topology, Turns};
        for group in [Scale, Depth, Topology, Thresholds, Pictures, Mixes, Turns, Files, Faults] {
            assert!(all.iter().any(|case| case.group == group), "{group:?}");
        }
    }

    #[test]
    fn the_mixes_follow_from_the_seed() {
        let text = |seed| format!("{:?}", mixes::cases(seed, 5));
        assert_eq!(text(3), text(3));
        assert_ne!(text(3), text(4));
    }
}
