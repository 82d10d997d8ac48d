//! Flicker: what of lines comes and goes while the eye moves, though nothing hides it.
//!
//! In: two pictures of the same models, with eyes near each other, and the visible lines of each. Out: the length that is in one
//! and not in the other, [`Flicker`]. No rule of silhouettes takes part, and none is favoured: only what is drawn counts.
//!
//! A place of a drawn line, taken along with the model into the other picture, *stays* if a line is drawn there within
//! so many pixels of it as whoever asks says. A contour slides over its surface, but along the view: by one degree its image is off by the radius of the surface
//! times 0.00015. What does not stay is *explained* if in the other picture a face of another object hides the place, or one
//! of its own that is nearer to the eye by more than [`FAR_EDGES`] sides, or if the place leaves the picture. The rest is flicker.
//!
//! A true contour flickers, too, where it ends at a cusp, which moves along it, and where a new one begins. Edges of flat faces that turn
//! away behind their own faces are not explained either: the measure is one for curved models.

use super::VisibleLines;
use crate::bvh::Box3;
use crate::lines::visible::cast::meet;
use crate::lines::visible::faces::Faces;
use crate::lines::visible::space::Space;
use crate::mesh::Mesh;
use crate::scene::Scene;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Places that are asked about are at most so far apart, pixels at 512 x 512.
const STEP_PX: f64 = 1.0;

/// From how far on a face hides a place of its object as something else, not as the surface just beside it: mean sides of the
/// object's faces.
const FAR_EDGES: f64 = 4.0;

/// What comes and goes between two pictures, pixels of line.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Flicker {
    /// What is drawn, both pictures together.
    pub drawn_px: f64,
    /// What is in one picture only, explained by what hides it in the other.
    pub explained_px: f64,
    /// What is in one picture only for no such reason.
    pub unexplained_px: f64,
}

/// The flicker between two pictures, both ways: what vanishes and what appears. Lines are the same if they are no farther than `near_px`
/// apart, pixels at 512 x 512: less also counts lines that move, more forgives what jumps.
pub fn flicker(pictures: [(&Scene, &VisibleLines); 2], near_px: f64) -> Flicker {
    let mut all = Flicker::default();
    for [(_, from), (scene, to)] in [pictures, [pictures[1], pictures[0]]] {
        add(from, scene, to, near_px, &mut all);
    }
    all
}

/// Adds what of some lines is not in another picture.
fn add(from: &VisibleLines, scene: &Scene, to: &VisibleLines, near_px: f64, all: &mut Flicker) {
    let space = Space::of(scene);
    let px = space.size.max_element() / 512.0;
    let drawn = Drawn::new(to, near_px * px);
    let mut open: Vec<(u32, DVec3, f64)> = Vec::new();
    for segment in from.segments.iter().filter(|segment| segment.is_visible) {
        let [a, b] = segment.ends_world;
        let length = segment.ends_px[0].distance(segment.ends_px[1]);
        let count = (length / (STEP_PX * px)).ceil().max(1.0);
        for place in 0..count as usize {
            let view = space.view(a.lerp(b, (place as f64 + 0.5) / count));
            all.drawn_px += length / count;
            if -view.z <= space.near || !drawn.is_near(space.project(view).0) {
                open.push((segment.object, view, length / count));
            }
        }
    }
    if open.is_empty() {
        return;
    }
    let parts: Vec<_> = scene.objects.iter().map(|object| (object, object.mesh.clone())).collect();
    let faces = Faces::new(&space, &parts);
    // Of each object where its faces' numbers begin, and from how far on they hide.
    let mut first = 0;
    let far: Vec<(u32, f64)> = parts
        .iter()
        .map(|(_, mesh)| {
            let start = first;
            first += mesh.triangles.len() as u32;
            (start, FAR_EDGES * mean_side(mesh))
        })
        .collect();
    for (object, view, length) in open {
        match is_explained(&space, &faces, &far, object, view) {
            true => all.explained_px += length,
            false => all.unexplained_px += length,
        }
    }
}

/// The mean side of a mesh's faces.
fn mean_side(mesh: &Mesh) -> f64 {
    let around = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|corner| mesh.positions[corner as usize]);
        a.distance(b) + b.distance(c) + c.distance(a)
    };
    mesh.triangles.iter().map(around).sum::<f64>() / (3 * mesh.triangles.len().max(1)) as f64
}

/// Whether a place of an object is out of the picture, or hidden by another object or something far before it.
fn is_explained(space: &Space, faces: &Faces, far: &[(u32, f64)], object: u32, view: DVec3) -> bool {
    if -view.z <= space.near {
        return true;
    }
    let (px, key) = space.project(view);
    if px.cmplt(DVec2::ZERO).any() || px.cmpgt(space.size).any() {
        return true;
    }
    let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(key));
    let (ray, slant) = (space.ray(px), if space.is_perspective() { view.length() / -view.z } else { 1.0 });
    faces.tree.any(&column, |place| {
        let of_it = far.partition_point(|(start, _)| *start <= faces.numbers[place as usize]) - 1;
        let least = if of_it as u32 == object { far[of_it].1 } else { 0.0 };
        meet(space, faces.corners(place), ray)
            .is_some_and(|(depth, _)| depth >= space.near && (-view.z - depth) * slant > least)
    })
}

/// Visible lines, to be asked what is near.
struct Drawn<'a> {
    lines: &'a VisibleLines,
    near_px: f64,
    /// Of squares of the picture, so wide, the pieces that may be near.
    squares: HashMap<[i32; 2], Vec<usize>>,
}

/// Sides of the squares, in distances that are near.
const SQUARE: f64 = 4.0;

impl<'a> Drawn<'a> {
    fn new(lines: &'a VisibleLines, near_px: f64) -> Self {
        let mut squares: HashMap<[i32; 2], Vec<usize>> = HashMap::new();
        let side = SQUARE * near_px;
        let square = |px: DVec2| (px / side).floor().as_ivec2();
        for (number, segment) in lines.segments.iter().enumerate().filter(|(_, segment)| segment.is_visible) {
            let [a, b] = segment.ends_px;
            let count = (a.distance(b) / side).ceil().max(1.0);
            for part in 0..count as usize {
                let [from, to] = [part, part + 1].map(|at| a.lerp(b, at as f64 / count));
                let (low, high) = (square(from.min(to) - near_px), square(from.max(to) + near_px));
                for (x, y) in (low.x..=high.x).flat_map(|x| (low.y..=high.y).map(move |y| (x, y))) {
                    squares.entry([x, y]).or_default().push(number);
                }
            }
        }
        Self { lines, near_px, squares }
    }

    fn is_near(&self, px: DVec2) -> bool {
        let square = (px / (SQUARE * self.near_px)).floor().as_ivec2().to_array();
        self.squares.get(&square).into_iter().flatten().any(|number| {
            let [a, b] = self.lines.segments[*number].ends_px;
            let (along, square) = (b - a, a.distance_squared(b));
            let place = if square > 0.0 { ((px - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
            px.distance(a + along * place) <= self.near_px
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraSettings;
    use crate::edges::{Class, ClassSet, SilhouetteRule};
    use crate::lines::LineSettings;
    use crate::lines::smooth::closed_forms::ClosedForm;
    use crate::mesh::LoadOptions;
    use crate::scene::SceneSettings;
    use std::sync::Arc;

    fn of(meshes: Vec<Mesh>) -> Scene {
        Scene::new(meshes.into_iter().map(Arc::new).collect::<Vec<_>>(), &SceneSettings::default()).unwrap()
    }

    /// Two pictures a degree apart, somewhere in a turn, and their silhouettes.
    fn a_degree(scene: &Scene, at: usize, silhouette: SilhouetteRule) -> [(Scene, VisibleLines); 2] {
        let cameras = scene.turntable(&CameraSettings::default(), 360).unwrap();
        let classes = ClassSet::of(&[Class::Silhouette]);
        let settings = LineSettings { classes, silhouette, finds_hidden: false, ..LineSettings::default() };
        [at, at + 1].map(|view| {
            let scene = Scene { camera: cameras[view], ..scene.clone() };
            let lines = VisibleLines::of(&scene, &settings).unwrap();
            (scene, lines)
        })
    }

    fn of_pictures([a, b]: &[(Scene, VisibleLines); 2]) -> Flicker {
        flicker([(&a.0, &a.1), (&b.0, &b.1)], 1.0)
    }

    #[test]
    fn a_sphere_that_turns_does_not_flicker_drawn_smooth() {
        for jitter in [0.0, 0.2] {
            let ball = of(vec![ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, jitter).unwrap()]);
            for at in [0, 77, 200] {
                let Flicker { drawn_px, explained_px, unexplained_px } =
                    of_pictures(&a_degree(&ball, at, SilhouetteRule::Smooth));
                assert!(drawn_px > 2000.0);
                assert_eq!([explained_px, unexplained_px], [0.0; 2], "jitter {jitter} at {at}");
            }
        }
    }

    #[test]
    fn what_is_left_out_of_one_picture_is_flicker_by_its_length() {
        let ball = of(vec![ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, 0.0).unwrap()]);
        let mut pictures = a_degree(&ball, 10, SilhouetteRule::Smooth);
        let is_out = |px: DVec2| px.x > 300.0;
        let middle = |ends: [DVec2; 2]| (ends[0] + ends[1]) * 0.5;
        let left_out: f64 = pictures[1]
            .1
            .segments
            .iter()
            .filter(|segment| is_out(middle(segment.ends_px)))
            .map(|segment| segment.ends_px[0].distance(segment.ends_px[1]))
            .sum();
        pictures[1].1.segments.retain(|segment| !is_out(middle(segment.ends_px)));
        let found = of_pictures(&pictures);
        // The ends of the gap stay over a pixel or two.
        assert!(left_out > 300.0 && (found.unexplained_px - left_out).abs() < 6.0, "{left_out} {found:?}");
        // Vanishing or appearing is all the same.
        let [a, b] = pictures;
        assert_eq!(of_pictures(&[b, a]).unexplained_px, found.unexplained_px);
    }

    #[test]
    fn what_goes_behind_something_is_explained() {
        // A sheet before a ball hides half of it in the second picture.
        let ball = || ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, 0.0).unwrap();
        let scene = of(vec![ball()]);
        let [first, second] = a_degree(&scene, 0, SilhouetteRule::Smooth);
        let eye = second.0.camera.eye;
        let (ahead, up) = ((second.0.camera.target - eye).normalize(), second.0.camera.up);
        let right = ahead.cross(up).normalize();
        let before = second.0.camera.target - ahead * 0.7;
        let corner = |x: f64, y: f64| before + right * x + up * y;
        let corners = vec![corner(0.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0), corner(0.0, 2.0)];
        let sheet = Mesh::of_triangles("sheet", corners, &[[0, 1, 2], [0, 2, 3]], &LoadOptions::default()).unwrap();
        let mut hidden = of(vec![ball(), sheet]);
        (hidden.camera, hidden.centre, hidden.radius) = (second.0.camera, second.0.centre, second.0.radius);
        // Nothing is drawn there any more: half of that is right.
        let nothing = VisibleLines { segments: Vec::new(), ..second.1.clone() };
        let pictures = [(&first.0, &first.1), (&hidden, &nothing)];
        let Flicker { drawn_px, explained_px, unexplained_px } = flicker(pictures, 1.0);
        assert!((drawn_px - explained_px - unexplained_px).abs() < 1e-6);
        assert!((explained_px - 0.5 * drawn_px).abs() < 0.02 * drawn_px, "{explained_px} of {drawn_px}");
    }
}
