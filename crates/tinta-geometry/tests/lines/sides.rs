//! The check of both sides: a point of any line, moved by 1e-4 pixels to either side at its own depth. If a side is not
//! hidden, exactly one line must be drawn there; if both are hidden, none may be.
//!
//! In f64 and world space, with separate formulas, over scenes typical of drawings: flat faces seen along an axis, overlapping
//! lines, touching corners and faces.

use crate::support::families::{FAMILIES, Family};
use crate::support::lines::{explicit, length, published_lines, px, scene_of, scenes_wanted, shuffled};
use crate::support::shapes::Random;
use crate::support::{builtin, public_meshes};
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use tinta::camera::Projection;
use tinta::edges::Class;
use tinta::lines::{LineSegment, VisibleLines};
use tinta::tolerances::{CONTACT, WELD};
use tinta::{CameraSettings, Mesh, Scene};

/// How far a point is moved aside, pixels.
const ASIDE_PX: f64 = 1e-4;

/// How near something must be drawn, pixels.
const DRAWN_PX: f64 = 0.002;

/// Sine of the angle to the view below which a face is edge-on, and above which it is not.
const EDGE_ON: [f64; 2] = [1e-12, 1e-7];

/// The result for one side of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    Hidden,
    Open,
    /// Something touches the line, or passes too near to it to tell.
    Unclear,
}

/// A scene as a list of triangles in world space, with the picture's cells.
pub struct Sides<'a> {
    scene: &'a Scene,
    corners: Vec<[DVec3; 3]>,
    normals: Vec<DVec3>,
    edges: BTreeMap<(u32, [u32; 2]), Vec<usize>>,
    cells: Vec<Vec<u32>>,
    /// The distance below which positions count as one, for each object.
    welds: Vec<f64>,
    object_of: Vec<u32>,
}

/// The check's results.
#[derive(Debug, Default, Clone)]
pub struct Found {
    pub samples: usize,
    pub drawn: usize,
    pub missing: Vec<String>,
    pub invented: Vec<String>,
    pub doubled: Vec<String>,
}

const CELLS: usize = 64;

impl<'a> Sides<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut edges: BTreeMap<(u32, [u32; 2]), Vec<usize>> = BTreeMap::new();
        let (mut corners, mut object_of, mut welds) = (Vec::new(), Vec::new(), Vec::new());
        for (number, object) in scene.objects.iter().enumerate() {
            let (low, high) = object.mesh.bounds();
            welds.push(WELD * low.distance(high));
            let mut known = BTreeSet::new();
            for triangle in &object.mesh.triangles {
                let mut sorted = *triangle;
                sorted.sort_unstable();
                // The first of several faces with the same corners counts.
                let sides = if known.insert(sorted) { 0..3 } else { 0..0 };
                for side in sides {
                    let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
                    edges.entry((number as u32, [a.min(b), a.max(b)])).or_default().push(corners.len());
                }
                corners.push(triangle.map(|corner| object.mesh.positions[corner as usize] + object.offset));
                object_of.push(number as u32);
            }
        }
        let normals =
            corners.iter().map(|[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).normalize_or_zero()).collect();
        let mut sides =
            Self { scene, corners, normals, edges, cells: vec![Vec::new(); CELLS * CELLS], welds, object_of };
        for face in 0..sides.corners.len() {
            let depths = sides.corners[face].map(|corner| sides.depth(corner));
            // A face that reaches in front of the near plane may lie anywhere.
            let is_behind = depths.iter().all(|depth| *depth > 0.0) || sides.is_parallel();
            let (low, high) = if is_behind {
                let images = sides.corners[face].map(|corner| px(scene, corner));
                (images[0].min(images[1]).min(images[2]), images[0].max(images[1]).max(images[2]))
            } else {
                (DVec2::NEG_INFINITY, DVec2::INFINITY)
            };
            let [low, high] = [low - 1.0, high + 1.0].map(|px| sides.cell(px));
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    sides.cells[y * CELLS + x].push(face as u32);
                }
            }
        }
        sides
    }

    fn cell(&self, px: DVec2) -> [usize; 2] {
        let size = DVec2::new(f64::from(self.scene.size.width), f64::from(self.scene.size.height));
        let cell = px / size * CELLS as f64;
        [cell.x, cell.y].map(|place| place.clamp(0.0, CELLS as f64 - 1.0) as usize)
    }

    fn is_parallel(&self) -> bool {
        matches!(self.scene.camera.projection, Projection::Parallel { .. })
    }

    fn depth(&self, point: DVec3) -> f64 {
        -(point - self.scene.camera.eye).dot(self.scene.camera.backward())
    }

    /// From a point to the eye, or to the plane through it.
    fn to_eye(&self, point: DVec3) -> DVec3 {
        let backward = self.scene.camera.backward();
        let from_point = self.scene.camera.eye - point;
        if self.is_parallel() { backward * from_point.dot(backward) } else { from_point }
    }

    /// Sine of the angle between a face and the view, positive from its front.
    fn sine(&self, face: usize) -> f64 {
        let to_eye = if self.is_parallel() {
            self.scene.camera.backward()
        } else {
            (self.scene.camera.eye - self.corners[face][0]).normalize()
        };
        self.normals[face].dot(to_eye)
    }

    /// Whether an edge must be a line by the default settings; `None` where rounding decides it, or mending may have.
    fn is_line(&self, [a, b]: [u32; 2], faces: &[usize], is_mended: bool) -> Option<bool> {
        let &[first, second] = faces else { return (faces.len() > 2 || !is_mended).then_some(true) };
        let runs_up = |face: usize| {
            let start = self.object_of.partition_point(|object| *object < self.object_of[face]);
            let corners = self.scene.objects[self.object_of[face] as usize].mesh.triangles[face - start];
            (0..3).any(|i| [corners[i], corners[(i + 1) % 3]] == [a, b])
        };
        let turned = if runs_up(first) == runs_up(second) { -1.0 } else { 1.0 };
        let (one, other) = (self.sine(first), turned * self.sine(second));
        let cosine = turned * self.normals[first].dot(self.normals[second]);
        if self.normals[first] == DVec3::ZERO || self.normals[second] == DVec3::ZERO || (cosine - 0.4).abs() < 1e-9 {
            return None;
        }
        let is = |sine: f64| match sine.abs() {
            size if size <= EDGE_ON[0] => Some(0.0),
            size if size >= EDGE_ON[1] => Some(sine.signum()),
            _ => None,
        };
        let (one, other) = (is(one)?, is(other)?);
        // To an eye just beside this one an edge-on face is front or back; two of them in one plane are both.
        let is_silhouette = one != other;
        Some(is_silhouette || cosine < 0.4 || (one == 0.0 && other == 0.0 && cosine < 1.0 - 1e-9))
    }

    /// Tests one side: `moved` is the point there, `ends` are the line's.
    fn side(&self, moved: DVec3, [a, b]: [DVec3; 2], object: u32, own: &[usize]) -> Side {
        let image = px(self.scene, moved);
        let [x, y] = self.cell(image);
        let to_eye = self.to_eye(moved);
        let length = a.distance(b);
        let camera = &self.scene.camera;
        let mut side = Side::Open;
        for face in &self.cells[y * CELLS + x] {
            let face = *face as usize;
            let normal = self.normals[face];
            if own.contains(&face) || normal == DVec3::ZERO {
                continue;
            }
            let [p, q, r] = self.corners[face];
            let along = normal.dot(to_eye);
            let share = normal.dot(p - moved) / along;
            let hit = moved + to_eye * share;
            if !share.is_finite() || share <= 0.0 || self.depth(hit) < camera.near {
                continue;
            }
            // How far inside the face the ray passes, in pixels; seen edge-on it passes it nowhere.
            let px_per_unit =
                px(self.scene, hit + camera.backward().any_orthonormal_vector()).distance(px(self.scene, hit));
            let inside = [(p, q), (q, r), (r, p)]
                .map(|(from, to)| {
                    let inward = normal.cross(to - from).normalize();
                    let seen = (inward - to_eye * (inward.dot(to_eye) / to_eye.length_squared())).length();
                    inward.dot(hit - from) * px_per_unit * seen
                })
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            if inside < -ASIDE_PX * 0.1 {
                continue;
            }
            let longest = p.distance(q).max(q.distance(r)).max(r.distance(p));
            let touch = CONTACT * longest.min(length)
                + self.welds[self.object_of[face] as usize].min(self.welds[object as usize]);
            let distances = [a, b].map(|end| normal.dot(end - p).abs());
            if distances.iter().all(|distance| *distance < 0.4 * touch) {
                continue;
            }
            if inside > ASIDE_PX * 0.1 && normal.dot(moved - p).abs() > 2.1 * touch {
                return Side::Hidden;
            }
            side = Side::Unclear;
        }
        side
    }

    /// Looks at so many points of all lines.
    pub fn check(&self, found: &VisibleLines, points: usize, random: &mut Random) -> Found {
        let scene = self.scene;
        let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
        let near_and_far = scene.camera.near..=scene.camera.far;
        let visible: Vec<&LineSegment> = found.segments.iter().filter(|segment| segment.is_visible).collect();
        let mut cells: Vec<Vec<u32>> = vec![Vec::new(); CELLS * CELLS];
        for (number, segment) in visible.iter().enumerate() {
            let [a, b] = segment.ends_px;
            let [low, high] = [a.min(b) - 1.0, a.max(b) + 1.0].map(|px| self.cell(px));
            for y in low[1]..=high[1] {
                (low[0]..=high[0]).for_each(|x| cells[y * CELLS + x].push(number as u32));
            }
        }
        let is_mended = self.edges.values().filter(|faces| faces.len() == 1).count() != found.edges.boundary;
        let listed: Vec<_> = self
            .edges
            .iter()
            .filter(|((_, ends), faces)| self.is_line(*ends, faces, is_mended) == Some(true))
            .map(|((object, ends), faces)| (*object, *ends, faces))
            .collect();
        let each = (points / listed.len().max(1)).max(1);
        // With more lines than points, a sample.
        let step = (listed.len() / points.max(1)).max(1);
        let mut result = Found::default();
        for (object, numbers, own) in listed.iter().skip((random.number() * step as f64) as usize).step_by(step) {
            let in_scene = &scene.objects[*object as usize];
            let ends = numbers.map(|number| in_scene.mesh.positions[number as usize] + in_scene.offset);
            for sample in 0..each {
                let share = (sample as f64 + 0.05 + 0.9 * random.number()) / each as f64;
                let point = ends[0] + (ends[1] - ends[0]) * share;
                if !near_and_far.contains(&self.depth(point)) {
                    continue;
                }
                let image = px(scene, point);
                let step =
                    px(scene, point + (ends[1] - ends[0]) * 1e-3) - px(scene, point - (ends[1] - ends[0]) * 1e-3);
                let is_inside = image.cmpgt(DVec2::splat(0.1)).all() && image.cmplt(size - 0.1).all();
                if !is_inside || step.length() * 500.0 < 0.1 || !step.is_finite() {
                    continue;
                }
                let along = step.normalize();
                let right = scene.camera.backward().cross(scene.camera.up).normalize();
                let right = -right;
                let up = scene.camera.backward().cross(right);
                let unit_px = px(scene, point + right).distance(image).max(1e-300);
                let aside = (right * along.y + up * along.x) / unit_px * ASIDE_PX;
                let sides = [aside, -aside].map(|aside| self.side(point + aside, ends, *object, own));
                result.samples += 1;
                let [x, y] = self.cell(image);
                let near: Vec<&LineSegment> = cells[y * CELLS + x]
                    .iter()
                    .map(|number| visible[*number as usize])
                    .filter(|segment| distance(segment, image) <= DRAWN_PX)
                    .collect();
                let what = || format!("object {object} edge {numbers:?} at {share:.4} {image} {sides:?}");
                if sides.contains(&Side::Open) && near.is_empty() {
                    result.missing.push(what());
                }
                let name = numbers.map(|number| in_scene.mesh.file_vertices[number as usize]);
                let is_this = |segment: &&LineSegment| {
                    let ends = segment.ends_px.map(|end| end.distance(image));
                    segment.object == *object && segment.edge == Some(name) && ends.iter().all(|end| *end > DRAWN_PX)
                };
                result.drawn += usize::from(near.iter().any(is_this));
                if sides == [Side::Hidden; 2] && near.iter().any(is_this) {
                    result.invented.push(what());
                }
                let on_one_another = near.iter().filter(|segment| {
                    let [a, b] = segment.ends_px;
                    a.distance(image) > 0.01
                        && b.distance(image) > 0.01
                        && distance(segment, image) < 1e-6
                        && (b - a).normalize().perp_dot(along).abs() < 1e-6
                });
                if on_one_another.count() > 1 {
                    result.doubled.push(what());
                }
            }
        }
        result
    }
}

/// Distance of a pixel from a piece.
fn distance(segment: &LineSegment, px: DVec2) -> f64 {
    let [a, b] = segment.ends_px;
    let along = b - a;
    let share = if along == DVec2::ZERO { 0.0 } else { ((px - a).dot(along) / along.length_squared()).clamp(0.0, 1.0) };
    (a + along * share).distance(px)
}

impl Found {
    pub fn is_right(&self) -> bool {
        self.missing.is_empty() && self.invented.is_empty() && self.doubled.is_empty()
    }

    pub fn summary(&self) -> String {
        let first = |list: &[String]| list.first().cloned().unwrap_or_default();
        format!(
            "{} samples, {} drawn; {} missing ({}), {} invented ({}), {} doubled ({})",
            self.samples,
            self.drawn,
            self.missing.len(),
            first(&self.missing),
            self.invented.len(),
            first(&self.invented),
            self.doubled.len(),
            first(&self.doubled)
        )
    }
}

/// Checks the scenes of a family of seeds 1 to so many.
fn check_family((name, make): &(&str, Family), count: u64) {
    let (mut failures, mut samples, mut drawn) = (Vec::new(), 0, 0);
    for seed in 1..=count {
        let mut random = Random::seeded(seed);
        let scene = make(&mut random);
        let found = Sides::new(&scene).check(&published_lines(&scene), 600, &mut random);
        samples += found.samples;
        drawn += found.drawn;
        if !found.is_right() {
            failures.push(format!("seed {seed}: {}", found.summary()));
        }
    }
    println!("{name}: {} of {count} scenes fail, {samples} samples, {drawn} drawn", failures.len());
    failures.truncate(10);
    assert!(failures.is_empty(), "{name}: {failures:#?}");
    assert!(drawn * 10 > samples && samples as u64 > 100 * count, "{name}: {drawn} of {samples} drawn");
}

/// The same over a mesh in some of the named views.
fn check_views(name: &str, mesh: &Mesh, views: &[&str], failures: &mut Vec<String>) {
    for view in views {
        for parallel in [true, false] {
            let scene = scene_of(vec![mesh.clone()], crate::support::lines::view(view, parallel));
            let found = Sides::new(&scene).check(&published_lines(&scene), 1500, &mut Random(7));
            println!("{name} {view} parallel {parallel}: {}", found.summary());
            if !found.is_right() {
                failures.push(format!("{name} {view} parallel {parallel}: {}", found.summary()));
            }
        }
    }
}

const ALL_VIEWS: [&str; 6] = ["front", "back", "left", "right", "top", "bottom"];

fn check_builtins(names: &[&str], views: &[&str]) {
    let mut failures = Vec::new();
    for name in names {
        let mesh = builtin(name);
        check_views(name, &mesh, views, &mut failures);
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn what_any_side_of_a_line_shows_is_drawn_of_a_box_and_a_gear() {
    check_builtins(&["open-box"], &ALL_VIEWS);
    check_builtins(&["gear"], &["front", "top"]);
}

#[test]
#[ignore = "exhaustive: four models in six views"]
fn what_any_side_of_a_line_shows_is_drawn_of_the_models_that_ship() {
    check_builtins(&["open-box", "gear", "ant", "bust"], &ALL_VIEWS);
}

#[test]
#[ignore = "exhaustive: six public models in six views"]
fn what_any_side_of_a_line_shows_is_drawn_of_public_models_in_the_named_views() {
    let mut failures = Vec::new();
    let files = ["fandisk.obj", "cow.obj", "suzanne.obj", "teapot.obj", "ant.ply", "spot/spot_triangulated.obj"];
    for (file, mesh) in public_meshes(&files) {
        check_views(file, &mesh, &ALL_VIEWS, &mut failures);
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The visible length, by class.
fn seen(scene: &Scene) -> BTreeMap<Class, f64> {
    let mut sums = BTreeMap::new();
    for segment in published_lines(scene).segments.iter().filter(|segment| segment.is_visible) {
        *sums.entry(segment.class).or_default() += length(segment);
    }
    sums
}

fn check_invariance(seeds: u64) {
    let mut failures = Vec::new();
    for (name, make) in &FAMILIES {
        for seed in 1..=seeds {
            let mut random = Random::seeded(seed);
            let scene = make(&mut random);
            let expected = seen(&scene);
            let all: f64 = expected.values().sum();
            let parallel = matches!(scene.camera.projection, Projection::Parallel { .. });
            let camera = explicit(&scene, parallel);
            let mut compare = |what: &str, change: &mut dyn FnMut(&Mesh) -> Mesh, camera: CameraSettings| {
                let meshes = scene.objects.iter().map(|object| change(&object.mesh)).collect();
                let actual = seen(&scene_of(meshes, camera));
                let classes: BTreeSet<Class> = expected.keys().chain(actual.keys()).copied().collect();
                for class in classes {
                    let [a, b] = [&expected, &actual].map(|sums| sums.get(&class).copied().unwrap_or_default());
                    if (a - b).abs() > 1e-5 * all {
                        failures.push(format!("{name}, seed {seed}, {what}: {class:?} {b} px instead of {a} of {all}"));
                    }
                }
            };
            compare("in another order", &mut |mesh| shuffled(mesh, &mut random), camera.clone());
            let inside_out = |mesh: &Mesh| {
                let mut mesh = mesh.clone();
                mesh.triangles.iter_mut().for_each(|corners| corners.reverse());
                mesh
            };
            compare("inside out", &mut { inside_out }, camera.clone());
            for scale in [1.0 / 1024.0, 8.0] {
                let scaled = |mesh: &Mesh| {
                    let positions = mesh.positions.iter().map(|point| *point * scale).collect();
                    Mesh { positions, ..mesh.clone() }
                };
                let camera = CameraSettings {
                    eye: camera.eye.map(|eye| eye * scale),
                    target: camera.target.map(|target| target * scale),
                    near: camera.near.map(|near| near * scale),
                    far: camera.far.map(|far| far * scale),
                    ..camera.clone()
                };
                compare("in another size", &mut { scaled }, camera);
            }
            let far = DVec3::new(1e8, -1e8, 1e8);
            let moved = |mesh: &Mesh| {
                let positions = mesh.positions.iter().map(|point| *point + far).collect();
                Mesh { positions, ..mesh.clone() }
            };
            let camera = CameraSettings {
                eye: camera.eye.map(|eye| eye + far),
                target: camera.target.map(|target| target + far),
                ..camera
            };
            compare("far from the origin", &mut { moved }, camera);
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn neither_order_nor_size_nor_place_nor_turning_inside_out_changes_what_is_seen_of_one_scene_a_family() {
    check_invariance(1);
}

#[test]
#[ignore = "exhaustive: six scenes of each family"]
fn neither_order_nor_size_nor_place_nor_turning_inside_out_changes_what_is_seen() {
    check_invariance(6);
}

fn check_families(count: u64) {
    let failed: Vec<_> = FAMILIES
        .iter()
        .filter(|family| std::panic::catch_unwind(|| check_family(family, count)).is_err())
        .map(|(name, _)| name)
        .collect();
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn what_any_side_of_a_line_shows_in_a_few_scenes_is_drawn_once_and_nothing_else() {
    check_families(4);
}

#[test]
#[ignore = "exhaustive: 15 scenes of each family"]
fn what_any_side_of_a_line_shows_is_drawn_once_and_nothing_else() {
    check_families(scenes_wanted().unwrap_or(15));
}
