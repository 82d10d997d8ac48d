//! Which faces of a mesh a view cannot show, so that GL need not draw them and the picture stays the same byte for byte.
//!
//! In: a mesh and its arrays, once; then an [`ObjectView`], for every view. Out: the arrays' indices without those faces.
//!
//! Leaving out all back faces would not do: at silhouettes, folds and holes a back face may win a pixel, by a tie in depth or
//! because nothing is in front of it. A face is left out only where a front face of its own shell is surely nearer in every
//! pixel that it covers:
//!
//! - Triangles connected over edges form a shell. With caps over its holes a sound one is a closed surface of one orientation,
//!   and how often it surrounds a point (its winding number) says what a ray from outside must have met on the way there.
//!   Behind the back of a face that it surrounds 0 times or more outside, it surrounds the space at least once: a ray that
//!   arrives there from the eye has come in through a front face.
//! - That face must be nearer by more than sub-pixel rounding and depth can confuse. So faces near another part of their shell
//!   are never left out, nor are those that are not seen steeply from behind, nor their neighbours.
//! - Drivers may give faces seen almost edge-on any depth, so nothing is left out where one lies in the picture.
//! - The face it came in through must be one that is drawn: what may be seen through a cap's front is not left out.
//!
//! This holds for faces that are drawn with a depth test (GL_LESS or GL_LEQUAL) and without polygon offset, which would push
//! steep faces behind what they hide.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use std::sync::Arc;
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, load};
//!
//! let mesh = load("../../models/gear.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let counts = scene.hiding(&scene.objects[0]).counts();
//! assert_eq!((counts.shells, counts.sound_shells), (1, 1), "a gear is one closed surface");
//! # Ok(())
//! # }
//! ```

mod backface;
mod distance;
mod doubled;
mod flags;
mod groups;
mod openings;
mod selection;
mod shells;
mod slivers;
mod view;
mod winding;

#[cfg(test)]
mod tests;

use crate::camera::Camera;
use crate::mesh::{Mesh, NONE, Part, VertexArrays, triangle_normal};
use crate::threads::{filled, threads_for};
use crate::tolerances::{LARGEST_THICKNESS, SHELL_THICKNESS};
use flags::Hierarchy;
use glam::{DVec3, Mat4, Vec3};
use serde::Serialize;
use shells::{Cap, Shells, Surface};

pub use backface::faces_not_culled;
pub use doubled::doubled_faces;

/// What holds for every view of a mesh: its faces' planes and whether something of their own shell can hide them.
///
/// Lengths in it are in the mesh's radii, half its bounding box's diagonal, and relative to its centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Hiding {
    /// The mesh's radius, file units.
    radius: f64,
    /// Least distance of faces that may be hidden from others of their shell.
    thickness: f64,
    /// Each face's plane, in drawing order: unit normal and its product with the plane's points; zeros without an area.
    planes: Vec<[f32; 4]>,
    /// The shell of each face that may be hidden, else [`NONE`]; in drawing order.
    shells: Vec<u32>,
    /// Of each of the arrays' vertices the point where it lies; empty where each vertex is a point of its own.
    points: Vec<u32>,
    point_count: usize,
    /// Smallest and largest corner of boxes around every so many of the arrays' vertices.
    vertex_boxes: Vec<[Vec3; 2]>,
    /// Likewise of their faces, in drawing order.
    face_boxes: Vec<[Vec3; 2]>,
    caps: Vec<CapPlane>,
    counts: HidingCounts,
}

/// A cap, which closes a hole and is not drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CapPlane {
    shell: u32,
    plane: [f32; 4],
    corners: [Vec3; 3],
}

/// Where an object is seen from, mesh radii, relative to the mesh's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sight {
    eye: DVec3,
    /// Unit vectors to the right, up and towards the eye.
    axes: [DVec3; 3],
    is_parallel: bool,
}

/// An object as a scene shows it.
#[derive(Debug, Clone, Copy)]
pub struct ObjectView<'a> {
    /// What GL draws of it.
    pub arrays: &'a VertexArrays,
    /// The camera, world space.
    pub camera: &'a Camera,
    /// Where the mesh's own origin is, world space.
    pub offset: DVec3,
    /// The scene's radius, file units.
    pub scene_radius: f64,
    /// The picture's width over its height.
    pub aspect: f64,
    /// From the arrays' coordinates to the picture.
    pub clip_from_object: Mat4,
}

/// How much of a mesh may be hidden.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct HidingCounts {
    /// Groups of triangles that are connected over edges.
    pub shells: usize,
    /// Of these, those that are closed surfaces of one orientation, with caps over their holes.
    pub sound_shells: usize,
    /// Holes of these that caps close.
    pub capped_holes: usize,
    /// Faces that come near another part of their shell.
    pub flagged_faces: usize,
    /// Faces that some views may leave out.
    pub hideable_faces: usize,
    /// Share of all faces that a view from far away leaves out, percent, as the mean of fourteen directions.
    pub usual_percent: usize,
}

/// The faces that a view needs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawnFaces {
    /// The arrays' indices, in unchanged order, without the faces left out.
    pub indices: Vec<u32>,
    /// The runs of these that share a material.
    pub parts: Vec<Part>,
    /// Number of faces left out.
    pub left_out: usize,
}

/// Vertices in one of their boxes.
const VERTICES_IN_A_BOX: usize = 64;

/// Faces in one of theirs.
const FACES_IN_A_BOX: usize = 32;

impl Hiding {
    /// Looks at all faces of a mesh, whose arrays these are, on as many threads as the machine has.
    pub fn new(mesh: &Mesh, arrays: &VertexArrays) -> Self {
        let (low, high) = mesh.bounds();
        let radius = (high * 0.5 - low * 0.5).length();
        let mut surface = Surface::new(mesh, arrays, radius);
        let point_count = surface.points.len();
        let thickness = (surface.mean_edge() * SHELL_THICKNESS).min(LARGEST_THICKNESS);
        let mut shells = Shells::new(&mut surface);
        let hierarchy = Hierarchy::new(&surface, &shells, thickness);
        let flags = flags::flagged(&surface, &mut shells, &hierarchy, thickness);
        let may_hide = winding::faces_with_outside(&surface, &shells, &hierarchy, &flags);
        let counts = HidingCounts {
            shells: shells.list.len(),
            sound_shells: shells.list.iter().filter(|shell| shell.is_sound).count(),
            capped_holes: shells.list.iter().filter(|shell| shell.is_sound).map(|shell| shell.holes as usize).sum(),
            flagged_faces: flags.iter().filter(|flag| **flag).count(),
            hideable_faces: may_hide.iter().filter(|may| **may).count(),
            usual_percent: 0,
        };
        let threads = threads_for(surface.triangles.len());
        let plane_of = |face: usize| plane(surface.normals[face], surface.points[surface.triangles[face][0] as usize]);
        let planes = filled(surface.triangles.len(), threads, [0.0; 4], plane_of);
        let shell_of = |face: usize| if may_hide[face] { shells.of_face[face] } else { NONE };
        let cap_plane = |cap: &Cap| {
            let corners = surface.corners(cap.corners);
            let plane = plane(triangle_normal(corners).unwrap_or_default(), corners[0]);
            CapPlane { shell: cap.shell, plane, corners: corners.map(|corner| corner.as_vec3()) }
        };
        let is_used = |cap: &&Cap| shells.list[cap.shell as usize].is_sound;
        let is_by_itself = surface.point_of_vertex.iter().enumerate().all(|(vertex, point)| vertex == *point as usize);
        let mut hiding = Self {
            radius,
            thickness,
            planes,
            shells: filled(surface.triangles.len(), threads, NONE, shell_of),
            vertex_boxes: boxes(surface.point_of_vertex.chunks(VERTICES_IN_A_BOX), &surface.points),
            face_boxes: boxes(
                surface.triangles.chunks(FACES_IN_A_BOX).map(|faces| faces.as_flattened()),
                &surface.points,
            ),
            caps: shells.caps.iter().filter(is_used).map(cap_plane).collect(),
            points: if is_by_itself { Vec::new() } else { surface.point_of_vertex },
            point_count,
            counts,
        };
        hiding.counts.usual_percent = hiding.usual_percent(arrays);
        hiding
    }

    /// How much of the mesh may be hidden.
    pub fn counts(&self) -> HidingCounts {
        self.counts
    }
}

fn plane(normal: DVec3, point: DVec3) -> [f32; 4] {
    normal.extend(normal.dot(point)).as_vec4().to_array()
}

fn boxes<'a>(groups: impl Iterator<Item = &'a [u32]>, points: &[DVec3]) -> Vec<[Vec3; 2]> {
    let around = |group: &[u32]| {
        let (low, high) = group.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(points[*point as usize]), high.max(points[*point as usize]))
        });
        [low.as_vec3(), high.as_vec3()]
    };
    groups.map(around).collect()
}
