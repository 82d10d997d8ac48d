//! The faces, search and intersections that lines, areas and strokes of one view share.

use crate::lines::eye::face_pair::Piercing;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::lines::visible::search::Search;
use crate::scene::Scene;
use glam::DVec3;
use std::sync::{Arc, OnceLock};

/// A scene with the faces that its camera sees, what speeds up the search among them, and their intersections. Each is made when it is
/// first asked for.
#[expect(missing_debug_implementations, reason = "nobody prints a hierarchy")]
pub struct Sight<'a> {
    /// The scene.
    pub scene: &'a Scene,
    faces: OnceLock<Arc<Faces>>,
    search: OnceLock<Arc<Search>>,
    intersections: OnceLock<Arc<Intersections>>,
}

/// A piece of line common to two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Intersection {
    /// The one with the lower number first.
    pub faces: [u32; 2],
    /// In the eye's space.
    pub ends: [DVec3; 2],
}

/// The common lines and points of faces that pass through one another.
#[derive(Default)]
pub(in crate::lines) struct Intersections {
    /// By their faces' numbers.
    pub lines: Vec<Intersection>,
    pub piercings: Vec<Piercing>,
    /// Count of tested boxes.
    pub compared: u64,
}

impl<'a> Sight<'a> {
    /// Returns the sight of a scene.
    pub fn of(scene: &'a Scene) -> Self {
        Self { scene, faces: OnceLock::new(), search: OnceLock::new(), intersections: OnceLock::new() }
    }

    /// Returns the sight of a scene with the same faces, whose normals and colours may be others.
    pub fn of_same_faces<'b>(&self, scene: &'b Scene) -> Sight<'b> {
        let Self { faces, search, intersections, .. } = self;
        Sight { scene, faces: faces.clone(), search: search.clone(), intersections: intersections.clone() }
    }

    /// The faces of the scene without repairs.
    pub(in crate::lines) fn faces(&self, space: &Space) -> Arc<Faces> {
        self.faces.get_or_init(|| Arc::new(Faces::of(space, self.scene))).clone()
    }

    /// What speeds up the search among faces, which may be repaired ones.
    pub(in crate::lines) fn search(&self, space: &Space, faces: &Arc<Faces>, progress: &Progress) -> Arc<Search> {
        let found = || Arc::new(Search::of(space, faces, progress));
        match self.faces.get().is_some_and(|given| Arc::ptr_eq(given, faces)) {
            true => self.search.get_or_init(found).clone(),
            false => found(),
        }
    }

    /// The intersections that may be visible by a search: those that are known, where it is that of the faces as given.
    pub(in crate::lines) fn intersections(
        &self,
        search: &Arc<Search>,
        found: impl FnOnce() -> Intersections,
    ) -> Arc<Intersections> {
        match self.search.get().is_some_and(|of_given| Arc::ptr_eq(of_given, search)) {
            true => self.intersections.get_or_init(|| Arc::new(found())).clone(),
            false => Arc::new(found()),
        }
    }
}
