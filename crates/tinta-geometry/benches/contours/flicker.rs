//! Flicker: lines that come and go while the eye moves, although nothing hides them.
//!
//! Input: two pictures of the same models from nearby eyes, and the visible lines of each. Output: [`Flicker`], the
//! length of lines in only one of them. The measure uses drawn lines only and no rule for silhouettes, so it favours
//! none.
//!
//! A place of a drawn line moves with the model into the other picture. It *stays* if a line is drawn there within
//! the caller's distance in pixels. A contour slides over its surface, but along the view: for one degree its image
//! shifts by 0.00015 times the surface's radius. A place that does not stay is *explained* in three cases: it leaves
//! the picture; a face of another object hides it there; or a face of the same object hides it that is nearer to the
//! eye by more than [`FAR_EDGES`] sides. The rest is flicker.
//!
//! A true contour flickers too, where it ends at a cusp, which moves along it, and where a new one begins. Edges of
//! flat faces that turn away behind their own faces are not explained: the measure suits curved models only.

use glam::{DMat4, DVec2, DVec3};
use std::collections::HashMap;
use tinta_geometry::camera::Projection;
use tinta_geometry::{Mesh, Scene, VisibleLines};

/// Largest distance between tested places, pixels at 512 x 512.
const STEP_PX: f64 = 1.0;

/// Least distance, in mean sides of an object's faces, at which a face of the same object counts as a separate part
/// and may hide a place. Nearer faces belong to the adjacent surface.
const FAR_EDGES: f64 = 4.0;

/// Lines that come and go between two pictures, pixels of line.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Flicker {
    /// Drawn length of both pictures.
    pub drawn_px: f64,
    /// Length in only one picture, where a face or the border hides it in the other.
    pub explained_px: f64,
    /// Length in only one picture, without such a reason.
    pub unexplained_px: f64,
}

/// Measures the flicker between two pictures in both directions: lines that vanish and lines that appear. Lines are
/// the same if they are at most `near_px` apart, pixels at 512 x 512. A smaller distance also counts lines that move;
/// a larger one tolerates jumps.
pub fn flicker(pictures: [(&Scene, &VisibleLines); 2], near_px: f64) -> Flicker {
    let mut all = Flicker::default();
    for [(_, from), (scene, to)] in [pictures, [pictures[1], pictures[0]]] {
        add(from, scene, to, near_px, &mut all);
    }
    all
}

/// Adds the lines that are missing in another picture.
fn add(from: &VisibleLines, scene: &Scene, to: &VisibleLines, near_px: f64, all: &mut Flicker) {
    let picture = Picture::of(scene);
    let px = picture.size.max_element() / 512.0;
    let drawn = DrawnView::new(to, near_px * px);
    let mut open: Vec<(usize, DVec3, f64)> = Vec::new();
    for segment in from.segments.iter().filter(|segment| segment.is_visible) {
        let [a, b] = segment.ends_world;
        let length = segment.ends_px[0].distance(segment.ends_px[1]);
        let count = (length / (STEP_PX * px)).ceil().max(1.0);
        for place in 0..count as usize {
            let world = a.lerp(b, (place as f64 + 0.5) / count);
            all.drawn_px += length / count;
            if picture.place(world).is_none_or(|place| !drawn.is_near(place)) {
                open.push((segment.object as usize, world, length / count));
            }
        }
    }
    if open.is_empty() {
        return;
    }
    let faces = Faces::new(scene, &picture);
    for (object, world, length) in open {
        match faces.explain(&picture, object, world) {
            true => all.explained_px += length,
            false => all.unexplained_px += length,
        }
    }
}

/// The camera of a scene and its projection to the picture.
struct Picture {
    clip_from_world: DMat4,
    size: DVec2,
    eye: DVec3,
    backward: DVec3,
    is_perspective: bool,
    near: f64,
}

impl Picture {
    fn of(scene: &Scene) -> Self {
        let camera = &scene.camera;
        let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
        Self {
            clip_from_world: camera.clip_from_view(size.x / size.y) * camera.view_from_world(),
            size,
            eye: camera.eye,
            backward: camera.backward(),
            is_perspective: matches!(camera.projection, Projection::Perspective { .. }),
            near: camera.near,
        }
    }

    /// The distance of a point from the eye along the view.
    fn depth(&self, world: DVec3) -> f64 {
        (self.eye - world).dot(self.backward)
    }

    /// The pixel position of a point, from the upper left; `None` unless it is beyond the near plane.
    fn place(&self, world: DVec3) -> Option<DVec2> {
        let place = self.clip_from_world.project_point3(world).truncate() * DVec2::new(0.5, -0.5) + 0.5;
        (self.depth(world) > self.near).then_some(place * self.size)
    }

    /// Unit vector from a point towards the eye.
    fn towards_eye(&self, world: DVec3) -> DVec3 {
        if self.is_perspective { (self.eye - world).normalize() } else { self.backward }
    }
}

/// A scene's faces, by the squares of the picture that they may cover.
struct Faces {
    /// The object and the corners of each face.
    all: Vec<(usize, [DVec3; 3])>,
    squares: HashMap<[i32; 2], Vec<usize>>,
    /// For each object, the distance above which its faces hide its own places.
    far: Vec<f64>,
}

/// Side of the squares for faces, pixels.
const FACE_SQUARE_PX: f64 = 8.0;

impl Faces {
    fn new(scene: &Scene, picture: &Picture) -> Self {
        let mut faces = Self { all: Vec::new(), squares: HashMap::new(), far: Vec::new() };
        let last = square(picture.size, FACE_SQUARE_PX);
        for (number, object) in scene.objects.iter().enumerate() {
            faces.far.push(FAR_EDGES * mean_side(&object.mesh));
            for face in &object.mesh.triangles {
                let corners = face.map(|corner| object.mesh.positions[corner as usize] + object.offset);
                // The image of a face that reaches the near plane is unbounded.
                let (low, high) = match corners.map(|corner| picture.place(corner)) {
                    [Some(a), Some(b), Some(c)] => {
                        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
                        (square(low, FACE_SQUARE_PX), square(high, FACE_SQUARE_PX))
                    }
                    _ => ([0; 2], last),
                };
                for x in low[0].max(0)..=high[0].min(last[0]) {
                    for y in low[1].max(0)..=high[1].min(last[1]) {
                        faces.squares.entry([x, y]).or_default().push(faces.all.len());
                    }
                }
                faces.all.push((number, corners));
            }
        }
        faces
    }

    /// Whether a place of an object is outside the picture, or hidden by another object or a distant part of the same
    /// one.
    fn explain(&self, picture: &Picture, object: usize, world: DVec3) -> bool {
        let Some(px) = picture.place(world) else { return true };
        if px.cmplt(DVec2::ZERO).any() || px.cmpgt(picture.size).any() {
            return true;
        }
        let towards_eye = picture.towards_eye(world);
        let in_square = self.squares.get(&square(px, FACE_SQUARE_PX)).into_iter().flatten();
        in_square.map(|face| &self.all[*face]).any(|(of, corners)| {
            let least = if *of == object { self.far[object] } else { 0.0 };
            meet(world, towards_eye, corners).is_some_and(|distance| {
                distance > least && picture.depth(world + towards_eye * distance) >= picture.near
            })
        })
    }
}

/// The distance of a face along a line from a point.
fn meet(from: DVec3, along: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let turns = [(a, b), (b, c), (c, a)].map(|(first, second)| (first - from).cross(second - from).dot(along));
    let normal = (b - a).cross(c - a);
    let slope = normal.dot(along);
    let is_inside = turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0);
    (is_inside && slope != 0.0).then(|| normal.dot(a - from) / slope)
}

/// The square with this side that contains a place.
fn square(px: DVec2, side: f64) -> [i32; 2] {
    (px / side).floor().as_ivec2().to_array()
}

fn mean_side(mesh: &Mesh) -> f64 {
    let around = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|corner| mesh.positions[corner as usize]);
        a.distance(b) + b.distance(c) + c.distance(a)
    };
    mesh.triangles.iter().map(around).sum::<f64>() / (3 * mesh.triangles.len().max(1)) as f64
}

/// Visible lines, indexed for proximity queries.
struct DrawnView<'a> {
    lines: &'a VisibleLines,
    near_px: f64,
    /// The segments that may be near, by square of the picture.
    squares: HashMap<[i32; 2], Vec<usize>>,
}

/// Side of the squares, in multiples of the near distance.
const SQUARE: f64 = 4.0;

impl<'a> DrawnView<'a> {
    fn new(lines: &'a VisibleLines, near_px: f64) -> Self {
        let mut squares: HashMap<[i32; 2], Vec<usize>> = HashMap::new();
        let side = SQUARE * near_px;
        for (number, segment) in lines.segments.iter().enumerate().filter(|(_, segment)| segment.is_visible) {
            let [a, b] = segment.ends_px;
            let count = (a.distance(b) / side).ceil().max(1.0);
            for part in 0..count as usize {
                let [from, to] = [part, part + 1].map(|at| a.lerp(b, at as f64 / count));
                let [low, high] = [from.min(to) - near_px, from.max(to) + near_px].map(|px| square(px, side));
                for (x, y) in (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| (x, y))) {
                    squares.entry([x, y]).or_default().push(number);
                }
            }
        }
        Self { lines, near_px, squares }
    }

    fn is_near(&self, px: DVec2) -> bool {
        self.squares.get(&square(px, SQUARE * self.near_px)).into_iter().flatten().any(|number| {
            let [a, b] = self.lines.segments[*number].ends_px;
            let (along, square) = (b - a, a.distance_squared(b));
            let place = if square > 0.0 { ((px - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
            px.distance(a + along * place) <= self.near_px
        })
    }
}
