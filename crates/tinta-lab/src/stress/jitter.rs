//! Moves a scene by a millionth of its size to find the unstable parts of its picture.

use glam::DVec3;
use std::sync::Arc;
use tinta::edges::{ClassSet, Classes, CreaseAngle, EdgeList, Eye, Incidence, SilhouetteRule};
use tinta::mesh::Mesh;
use tinta::random::Random;
use tinta::scene::{Object, Scene};

/// How far vertices and camera are moved, scene radii.
const JITTER: f64 = 1e-6;

/// Relative error bound of a determinant in plain f64 arithmetic, as a share of its largest product: below it the sign is unknown
/// here.
const UNKNOWN_SIGN: f64 = 64.0 * f64::EPSILON;

/// Edges whose class changes when a scene is moved a little.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Flips {
    /// All edges.
    pub edges: usize,
    /// Edges whose exact silhouette or static class changed.
    pub exact: usize,
    /// Edges that change under the listing's rule for silhouettes.
    pub published: usize,
    /// Edges among `exact` without a sign change in any predicate that decides them: this must be 0.
    pub unexplained: usize,
}

/// How much came and went, in a picture and by the exact scene, as shares.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PoppedShares {
    /// The popped share of a style's ink, and of the exact lines.
    pub ink: Option<[f64; 2]>,
    /// The popped share of a style's shading, and of the same formula in f64, if computed.
    pub shades: Option<[f64; 2]>,
}

/// The scene with every vertex and the camera moved by up to a millionth of its radius along each axis.
pub(super) fn jittered(scene: &Scene) -> Scene {
    let mut random = Random::new(1, "jitter");
    let step = JITTER * scene.radius;
    let mut moved =
        move |point: DVec3| point + DVec3::new(random.signed_f64(), random.signed_f64(), random.signed_f64()) * step;
    let mut jittered = scene.clone();
    for object in &mut jittered.objects {
        let positions = object.mesh.positions.iter().map(|point| moved(*point)).collect();
        *object = object.with_mesh(Arc::new(Mesh { positions, ..Mesh::clone(&object.mesh) }));
    }
    jittered.camera.eye = moved(scene.camera.eye);
    jittered.camera.target = moved(scene.camera.target);
    jittered
}

/// Compares the classes of a scene's edges before and after.
pub(super) fn flips(before: &Scene, after: &Scene) -> Flips {
    let crease_angle = CreaseAngle::default();
    let mut flips = Flips::default();
    for (was, is) in before.objects.iter().zip(&after.objects) {
        let (was, is) = (View::of(before, was, crease_angle), View::of(after, is, crease_angle));
        flips.edges += was.list.len();
        for edge in 0..was.list.len() as u32 {
            let silhouette = was.is_silhouette(edge) != is.is_silhouette(edge);
            let fixed = was.classes.of_edges[edge as usize] != is.classes.of_edges[edge as usize];
            flips.published +=
                usize::from(was.published.binary_search(&edge).is_ok() != is.published.binary_search(&edge).is_ok());
            if !silhouette && !fixed {
                continue;
            }
            flips.exact += 1;
            let faces = was.list.faces(edge);
            let side_changed = || faces.iter().any(|face| may_have_changed(was.side(*face), is.side(*face)));
            let angle_changed = || may_have_changed(was.angle(edge), is.angle(edge));
            let is_explained = (!silhouette || side_changed()) && (!fixed || angle_changed());
            flips.unexplained += usize::from(!is_explained);
        }
    }
    flips
}

/// A number and how far it may be off.
type BoundedNumber = (f64, f64);

/// Whether a predicate's value has another sign, or may have for all that is known.
fn may_have_changed(was: BoundedNumber, is: BoundedNumber) -> bool {
    (was.0 > 0.0) != (is.0 > 0.0) || was.0.abs() <= was.1 || is.0.abs() <= is.1
}

/// An object's edges for one eye, and the predicates that decide on them, computed here in plain f64 and in other words than
/// where the decision is made.
struct View<'a> {
    mesh: &'a Mesh,
    list: &'a EdgeList,
    classes: Classes,
    exact: Vec<u32>,
    published: Vec<u32>,
    eye: Eye,
    crease_angle: CreaseAngle,
}

impl<'a> View<'a> {
    fn of(scene: &'a Scene, object: &'a Object, crease_angle: CreaseAngle) -> Self {
        let mesh: &Mesh = &object.mesh;
        let edges = scene.edges(object);
        let eye = scene.eye(object, SilhouetteRule::Exact);
        let classes = Classes::new(mesh, edges.list(), crease_angle, ClassSet::EDGES);
        let exact = edges.silhouette(eye, SilhouetteRule::Exact);
        let published = edges.silhouette(scene.eye(object, SilhouetteRule::Published), SilhouetteRule::Published);
        Self { mesh, list: edges.list(), classes, exact, published, eye, crease_angle }
    }

    fn is_silhouette(&self, edge: u32) -> bool {
        self.exact.binary_search(&edge).is_ok()
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.mesh.triangles[face as usize].map(|index| self.mesh.positions[index as usize])
    }

    /// Volume between the eye and a face: the sum of three products of three.
    fn side(&self, face: u32) -> BoundedNumber {
        let corners = self.corners(face);
        let [a, b, c, direction] = match self.eye {
            Eye::Point(eye) => {
                let [a, b, c] = corners.map(|corner| corner - eye);
                [a, b, c, -a]
            }
            Eye::Direction(direction) => [corners[0], corners[1], corners[2], direction],
        };
        let (u, v) = (c - b, a - b);
        let value = u.cross(v).dot(direction);
        let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        // The differences themselves are rounded from coordinates that may be far from the origin.
        let lost = largest * f64::EPSILON;
        let (u, v, d) = (u.length() + lost, v.length() + lost, direction.length() + lost);
        (value, UNKNOWN_SIGN * u * v * d + 4.0 * lost * (u * v + v * d + d * u))
    }

    /// How much the cosine between an edge's two faces is above that of the crease angle.
    fn angle(&self, edge: u32) -> BoundedNumber {
        let &[first, second] = self.list.faces(edge) else { return (1.0, 0.0) };
        let normal = |face: u32| {
            let [a, b, c] = self.corners(face);
            let (u, v) = (a - c, b - c);
            let scale = u.length() * v.length();
            let normal = u.cross(v);
            // A needle's normal is a difference of two numbers much larger than it.
            let lost = UNKNOWN_SIGN * scale / normal.length();
            (normal.normalize_or_zero(), lost)
        };
        let ((first, lost_first), (second, lost_second)) = (normal(first), normal(second));
        let turned = if self.list.incidence()[edge as usize] == Incidence::InnerReversed { -1.0 } else { 1.0 };
        (first.dot(second) * turned - self.crease_angle.cosine, lost_first + lost_second + UNKNOWN_SIGN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::Shape;
    use std::path::Path;
    use tinta::camera::CameraSettings;
    use tinta::scene::SceneSettings;

    fn scene(shape: Shape, camera: CameraSettings) -> Scene {
        let mesh = shape.mesh(1.0, DVec3::ZERO, Path::new(""), &Default::default()).unwrap();
        Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap()
    }

    #[test]
    fn nothing_flips_on_a_cube_seen_from_afar_and_nothing_ever_when_nothing_moves() {
        let sound = scene(Shape::Cube, CameraSettings::default());
        let flipped = flips(&sound, &jittered(&sound));
        assert_eq!(flipped, Flips { edges: 18, ..Flips::default() });
        assert_eq!(flips(&sound, &sound), Flips { edges: 18, ..Flips::default() });
    }

    #[test]
    fn edges_of_a_face_seen_edge_on_flip_and_every_flip_is_a_change_of_sign() {
        let mut found = 0;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            // In the planes of the faces where that coordinate is 0, and, looking along it, of none.
            let eye = DVec3::splat(0.3) * (DVec3::ONE - axis) + DVec3::new(5.0, 4.0, 6.0) * (DVec3::ONE - axis);
            let camera =
                CameraSettings { eye: Some(eye), target: Some(DVec3::splat(0.5)), ..CameraSettings::default() };
            let edge_on = scene(Shape::Cube, camera);
            let flipped = flips(&edge_on, &jittered(&edge_on));
            assert_eq!(flipped.unexplained, 0, "{axis} {flipped:?}");
            found += flipped.exact;
        }
        assert!(found > 0);
    }

    #[test]
    fn a_flip_without_a_change_of_sign_would_be_noticed() {
        assert!(!may_have_changed((1.0, 1e-12), (2.0, 1e-12)));
        assert!(may_have_changed((1.0, 1e-12), (-1.0, 1e-12)));
        assert!(may_have_changed((1.0, 1e-12), (1e-13, 1e-12)));
        // A cube's silhouette edges seen from two sides, judged by one side's predicates: they do not change, the classes do.
        let front = scene(Shape::Cube, CameraSettings { view: "30,15".parse().unwrap(), ..CameraSettings::default() });
        let back = scene(Shape::Cube, CameraSettings { view: "200,15".parse().unwrap(), ..CameraSettings::default() });
        let view = View::of(&front, &front.objects[0], CreaseAngle::default());
        let other = View::of(&back, &back.objects[0], CreaseAngle::default());
        let changed: Vec<u32> =
            (0..18).filter(|edge| view.is_silhouette(*edge) != other.is_silhouette(*edge)).collect();
        assert!(!changed.is_empty());
        let unexplained = |edge: &&u32| {
            view.list.faces(**edge).iter().all(|face| !may_have_changed(view.side(*face), view.side(*face)))
        };
        assert_eq!(changed.iter().filter(unexplained).count(), changed.len());
    }
}
