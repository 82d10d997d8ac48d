//! The input of a search for lines: a scene's objects with their edges and parts, and all faces in the eye's space.

use crate::edges::{Class, ClassSet};
use crate::error::{Error, Result};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::input::object_edges::{Edges, IsGhost, ObjectEdges, ghost_faces, object_edges};
use crate::lines::parts::scene_parts::SceneParts;
use crate::lines::settings::{LineSettings, check_on_surface, not_published};
use crate::lines::sight::Sight;
use crate::memory::{DrawingWork, LINES};
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::threads::both;
use std::sync::Arc;

/// Classes at which a surface ends or turns away.
pub(in crate::lines) const OCCLUDING: ClassSet =
    ClassSet::of(&[Class::Boundary, Class::NonManifold, Class::Silhouette]);

/// A scene, repaired where needed.
pub(in crate::lines) struct LineInput<'a> {
    pub sight: &'a Sight<'a>,
    pub scene: &'a Scene,
    /// With the classes of all parts together. Hidden pieces are found wherever anything depends on them.
    pub settings: LineSettings,
    pub space: Space,
    pub objects: Vec<ObjectEdges<'a>>,
    pub scene_parts: SceneParts,
    pub faces: Arc<Faces>,
    /// The lines' purpose.
    pub asked: DrawingWork,
}

impl<'a> LineInput<'a> {
    /// Finds the objects' edges, repairs their meshes, and collects all faces.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`]: settings without lines, a pattern that names no part, too large a scene.
    pub(in crate::lines) fn of(sight: &'a Sight<'_>, settings: &LineSettings) -> Result<Self> {
        let scene = sight.scene;
        check(scene, settings)?;
        let scene_parts = SceneParts::new(scene, settings)?;
        let mut settings = scene_parts.settings(settings);
        settings.finds_hidden |= settings.counts_changes || settings.reference;
        let is_ghost = |object: usize, mesh: &Mesh, face| scene_parts.is_ghost(scene_parts.of_face(object, mesh, face));
        let ghosts = scene_parts.has_ghosts().then_some(&is_ghost as IsGhost<'_>);
        let has_forms = !settings.classes.and(ClassSet::FORMS).is_empty();
        let space = Space::of(scene);
        // One thread builds the hierarchy, another the edges.
        let edges = || {
            let objects = object_edges(scene, ghosts);
            for object in &objects {
                object.edges.get().classes(settings.crease_angle, asked(&settings));
                if has_forms && matches!(object.edges, Edges::OfScene(_)) {
                    object.curvatures(scene, &settings.forms);
                }
            }
            objects
        };
        let (objects, mut faces) = both(edges, || sight.faces(&space));
        let is_repaired = objects.iter().any(|object| matches!(object.edges, Edges::Repaired(_)));
        if is_repaired || ghosts.is_some() {
            let meshes: Vec<_> = objects.iter().map(|object| (object.object, object.shape().clone())).collect();
            let mut own = Faces::new(&space, &meshes);
            if is_repaired {
                own.widen_welds(objects.iter().map(ObjectEdges::beside));
            }
            if let Some(is_ghost) = ghosts {
                own.set_ghosts(&ghost_faces(&objects, is_ghost));
            }
            faces = Arc::new(own);
        }
        Ok(Self { sight, scene, settings, space, objects, scene_parts, faces, asked: LINES })
    }

    /// A given scene without repairs and styles of parts, for areas and strokes.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for too large a scene.
    pub(in crate::lines) fn as_given(sight: &'a Sight<'_>, asked: DrawingWork) -> Result<Self> {
        let scene = sight.scene;
        let classes = ClassSet::of(&[Class::Intersection]);
        let settings = LineSettings { classes, finds_hidden: false, ..LineSettings::default() };
        check(scene, &settings)?;
        let (scene_parts, space) = (SceneParts::new(scene, &settings)?, Space::of(scene));
        let edges = || ObjectEdges::all(scene, |_, object| Edges::OfScene(scene.edges(object)));
        let (objects, faces) = both(edges, || sight.faces(&space));
        Ok(Self { sight, scene, settings, space, objects, scene_parts, faces, asked })
    }
}

/// Refuses settings without lines, and scenes that are too large.
fn check(scene: &Scene, settings: &LineSettings) -> Result<()> {
    if settings.classes.is_empty() {
        return Err(Error::setting("classes", "name at least one class of lines"));
    }
    let all_positions: usize = scene.objects.iter().map(|object| object.mesh.positions.len()).sum();
    if scene.triangle_count().max(all_positions) > u32::MAX as usize / 4 {
        return Err(Error::setting(
            "classes",
            "the scene has too many faces to find its lines; draw fewer models at once",
        ));
    }
    if settings.reference && (settings.has_smooth_contours() || settings.counts_changes) {
        return Err(Error::setting("silhouette", "smooth silhouettes follow other rules; ask for exact ones"));
    }
    not_published(settings.silhouette)?;
    check_on_surface(settings.on_surface)?;
    settings.forms.check()
}

/// The classes of a mesh's edges that these settings need.
pub(in crate::lines) fn asked(settings: &LineSettings) -> ClassSet {
    let of_normals = match settings.creases_by_normals && settings.classes.contains(Class::Crease) {
        true => ClassSet::of(&[Class::Normal]),
        false => ClassSet::default(),
    };
    let of_contours = if settings.has_smooth_contours() { ClassSet::of(&[Class::Crease]) } else { ClassSet::default() };
    settings.classes.or(OCCLUDING).or(of_contours).or(of_normals).and(ClassSet::EDGES)
}
