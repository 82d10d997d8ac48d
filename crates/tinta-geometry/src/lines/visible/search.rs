//! Accelerators of the search for lines in crowded scenes. No line depends on them.

use crate::lines::eye::faces::Faces;
use crate::lines::eye::pieces::PieceTree;
use crate::lines::eye::pyramid::{Pyramid, is_crowded};
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::lines::visible::nearest_faces::NearestFaces;
use crate::lines::visible::occluders::occluders;

/// Accelerators; by default none.
#[derive(Default)]
pub(in crate::lines) struct Search {
    /// The parts of the picture that single faces hide.
    pub pyramid: Option<Pyramid>,
    /// The nearest face at samples of the picture.
    pub nearest_faces: Option<NearestFaces>,
    /// The faces that may hide lines, in short pieces.
    pub occluders: Option<PieceTree>,
}

impl Search {
    /// Builds what pays for a scene.
    pub(in crate::lines) fn of(space: &Space, faces: &Faces, progress: &Progress) -> Self {
        if !is_crowded(space, faces) {
            return Self::default();
        }
        let pyramid = Pyramid::new(space, faces);
        let occluders = occluders(space, faces, pyramid.as_ref(), progress);
        Self { nearest_faces: Some(NearestFaces::new(space, faces, progress)), occluders: Some(occluders), pyramid }
    }
}
