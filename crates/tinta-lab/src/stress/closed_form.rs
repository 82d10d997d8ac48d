//! What must be seen of triangles that do not hide one another, in f64 from their corners and the camera alone: without the library's
//! edges, classes, visibility and regions.

use super::figures::{Figures, LINES};
use glam::{DMat3, DVec2, DVec3};
use std::collections::BTreeMap;
use tinta::camera::Projection;
use tinta::edges::{Class, CreaseAngle};
use tinta::scene::Scene;

/// Sine of the angle between a face and the line of sight below which the face is edge-on.
const EDGE_ON: f64 = 1e-7;

/// Triangles none of which hides part of another one that faces the eye.
pub(super) struct UnhiddenTriangles {
    /// Corners in world space, file units.
    pub points: Vec<DVec3>,
    /// The triangles, by their corners' numbers.
    pub faces: Vec<[u32; 3]>,
    /// Whether they close solids, and only those towards the eye are seen.
    pub is_closed: bool,
}

/// A triangle as the eye sees it.
struct Face {
    normal: DVec3,
    /// Whether its front is towards the eye.
    is_front: bool,
    is_seen: bool,
}

impl UnhiddenTriangles {
    /// The number of seen lines of each class, their length and the triangles' area, pixels; `None` if part of them is outside the
    /// picture, or a triangle edge-on.
    pub(super) fn figures(mut self, scene: &Scene) -> Option<Figures> {
        let px = self.points.iter().map(|point| px(point, scene)).collect::<Option<Vec<DVec2>>>()?;
        // Corners in one place are one.
        let place = |corner: u32| self.points.iter().position(|point| *point == self.points[corner as usize]);
        self.faces.iter_mut().flatten().for_each(|corner| *corner = place(*corner).map_or(*corner, |at| at as u32));
        let faces = self.faces.iter().map(|face| self.face(face, scene)).collect::<Option<Vec<Face>>>()?;
        let mut edges: BTreeMap<[u32; 2], Vec<&Face>> = BTreeMap::new();
        let mut figures = Figures::from(LINES.map(|(_, seen, _)| (seen, 0.0)));
        let mut sum = |name: &'static str, more: f64| *figures.entry(name).or_default() += more;
        for (&[a, b, c], face) in self.faces.iter().zip(&faces) {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                edges.entry([from.min(to), from.max(to)]).or_default().push(face);
            }
            let [a, b, c] = [a, b, c].map(|corner| px[corner as usize]);
            sum("areas_px", if face.is_seen { (b - a).perp_dot(c - a).abs() * 0.5 } else { 0.0 });
        }
        for ([from, to], faces) in edges {
            if let Some((_, seen, _)) = class(&faces).and_then(|class| LINES.iter().find(|(.., of)| *of == class)) {
                sum(seen, 1.0);
                sum("lines_px", px[from as usize].distance(px[to as usize]));
            }
        }
        Some(figures)
    }

    /// `None` for one that is edge-on.
    fn face(&self, corners: &[u32; 3], scene: &Scene) -> Option<Face> {
        let [a, b, c] = corners.map(|corner| self.points[corner as usize]);
        let normal = (b - a).normalize().cross((c - a).normalize()).normalize();
        let sine = match scene.camera.projection {
            Projection::Parallel { .. } => normal.dot(scene.camera.backward()),
            Projection::Perspective { .. } => normal.dot((scene.camera.eye - a).normalize()),
        };
        // Where solids touch, a face lies on another one.
        let is_same = |other: &&[u32; 3]| other.iter().all(|corner| corners.contains(corner));
        let is_outside = self.faces.iter().filter(is_same).count() == 1;
        let is_seen = is_outside && (sine > 0.0 || !self.is_closed);
        (sine.abs() > EDGE_ON).then_some(Face { normal, is_front: sine > 0.0, is_seen })
    }
}

/// A point's place in the picture; `None` outside it.
fn px(point: &DVec3, scene: &Scene) -> Option<DVec2> {
    let half = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height)) * 0.5;
    // The difference first: far from the origin it is exact, and a matrix's product is not.
    let view = DMat3::from_mat4(scene.camera.view_from_world()) * (point - scene.camera.eye);
    let clip = scene.camera.clip_from_view(scene.size.aspect()).project_point3(view);
    (view.z < 0.0 && clip.abs().max_element() < 1.0).then(|| half + half * clip.truncate())
}

/// The class of the line between faces, if it is one and seen.
fn class(faces: &[&Face]) -> Option<Class> {
    let is_seen = faces.iter().any(|face| face.is_seen);
    let class = match faces {
        [_] => Class::Boundary,
        [a, b] if a.is_front != b.is_front => Class::Silhouette,
        [a, b] if a.normal.dot(b.normal) <= CreaseAngle::default().cosine => Class::Crease,
        [_, _] => return None,
        _ => Class::NonManifold,
    };
    is_seen.then_some(class)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::Shape;
    use std::path::Path;
    use std::sync::Arc;
    use tinta::camera::CameraSettings;
    use tinta::scene::SceneSettings;

    /// Boundaries, non-manifold edges, silhouettes and creases that are seen, and the area, pixels.
    fn seen(shape: Shape, camera: CameraSettings) -> Option<([f64; 4], f64)> {
        let mesh = shape.mesh(1.0, DVec3::ZERO, Path::new(""), &Default::default()).unwrap();
        let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap();
        let figures = shape.unhidden().unwrap().figures(&scene)?;
        let names = ["seen_boundary", "seen_non_manifold", "seen_silhouette", "seen_crease"];
        Some((names.map(|name| figures[name]), figures["areas_px"]))
    }

    #[test]
    fn shapes_show_the_lines_that_one_counts() {
        let lines = |shape| seen(shape, CameraSettings::default()).unwrap().0;
        assert_eq!(lines(Shape::Cube), [0.0, 0.0, 6.0, 3.0]);
        assert_eq!(lines(Shape::Specks(1e-3)), [0.0, 0.0, 48.0, 24.0]);
        // Of the square between them two sides are seen; it divides two silhouettes and a crease.
        assert_eq!(lines(Shape::Touching), [0.0, 2.0, 8.0, 4.0]);
        assert_eq!(lines(Shape::Triangle(1e-4)), [3.0, 0.0, 0.0, 0.0]);
        assert_eq!(lines(Shape::Corrugated(5)), [14.0, 0.0, 0.0, 5.0]);
    }

    #[test]
    fn a_square_seen_from_the_front_has_its_area_and_a_cube_edge_on_is_not_decided() {
        let front = |eye_x: f64, parallel| CameraSettings {
            eye: Some(DVec3::new(eye_x, 0.5, 5.0)),
            target: Some(DVec3::new(eye_x, 0.5, 0.0)),
            parallel,
            ..CameraSettings::default()
        };
        // The far plane's distance does not matter: half the picture's height is 4 tan(15 degrees) at the cube's front.
        let side_px = 512.0 / (8.0 * 15_f64.to_radians().tan());
        let (lines, area_px) = seen(Shape::Cube, front(0.5, false)).unwrap();
        assert_eq!(lines, [0.0, 0.0, 4.0, 0.0]);
        assert!((area_px - side_px * side_px).abs() < 1e-6, "{area_px}");
        assert_eq!(seen(Shape::Cube, front(1.0, false)), None);
        assert_eq!(seen(Shape::Cube, front(0.5, true)), None);
    }
}
