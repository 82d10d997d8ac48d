//! Regions joined by their faces of the file, materials or objects.

use super::region::{Regions, SeenFace};
use super::tones::TonedSurface;
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::lines::sight::Sight;
use crate::mesh::NONE;
use crate::scene::Scene;

/// What is seen in a region: an object, and as much more as all of the region has in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Surface {
    /// The object in the scene.
    pub object: u32,
    /// The material in the object's mesh; `None` without materials, and in regions of whole objects.
    pub material: Option<u32>,
    /// The tone, 0 the darkest; `None` in regions that are not of tones.
    pub tone: Option<u8>,
    /// The 0-based face of the object's file; `None` in regions of several faces.
    pub face: Option<u32>,
}

crate::choices! {
    /// By what regions are joined.
    pub enum JoinKey {
        /// By face of the file: the triangles of a polygon become one.
        Face = "face",
        /// By object and material.
        Material = "material",
        /// By object, which makes the objects' outlines.
        Object = "object",
    }
}

impl Surface {
    /// What regions joined so show where this face is seen.
    fn of(scene: &Scene, SeenFace { object, face }: SeenFace, joined: JoinKey) -> Self {
        let mesh = &scene.objects[object as usize].mesh;
        let material = mesh.triangle_materials.get(face as usize).copied().filter(|material| *material != NONE);
        Self {
            object,
            material: material.filter(|_| joined != JoinKey::Object),
            tone: None,
            face: (joined == JoinKey::Face).then(|| mesh.file_face(face)),
        }
    }
}

impl From<TonedSurface> for Surface {
    fn from(TonedSurface { object, material, tone }: TonedSurface) -> Self {
        Self { object, material: Some(material).filter(|material| *material != NONE), tone: Some(tone), face: None }
    }
}

impl Regions<Option<Surface>> {
    /// Cuts a view into regions, joined by what they show; `None` is background.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::with_progress`].
    pub fn joined_by(sight: &Sight<'_>, joined: JoinKey, progress: &Progress) -> Result<Self> {
        let of_triangles = Regions::with_progress(sight, progress)?;
        let scene = sight.scene;
        let surface = |seen: Option<SeenFace>| seen.map(|seen| Surface::of(scene, seen, joined));
        let is_cut = scene.objects.iter().any(|object| !object.mesh.file_faces.is_empty());
        match joined == JoinKey::Face && !is_cut {
            true => Ok(of_triangles.labelled(surface)),
            false => Ok(of_triangles.joined(|seen| Some(surface(seen)))),
        }
    }
}
