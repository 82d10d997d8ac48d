//! Strokes that keep their identity from frame to frame while the eye moves.
//!
//! Input: the lines of successive pictures of the same models. Output: their paths, each with a stroke number
//! ([`LinePath::stroke`]). A stroke is identified by its place on the models, not in the picture:
//!
//! - Edges whose class does not depend on the view form *curves*. A curve ends at corners, where more or fewer than
//!   two edges of one class meet. A path stays on one curve, whether its segments are drawn as creases or as
//!   silhouettes. Strokes on curves, intersections, ridges and valleys get their old numbers back when they reappear.
//! - Other silhouettes and suggestive contours slide over the surface. They are compared with
//!   strokes of the same class and object in the previous picture. Each point is matched to the nearest one there, at
//!   most as far as the outline of a ball as large as the scene moves. A stroke that is missing from one picture
//!   loses its number.
//!
//! Of all pairs of an old and a new stroke, the pair with the longest common stretch on the surface is matched first,
//! then the next. So if a stroke splits, its longer part keeps the number; if two strokes merge, the longer one gives
//! its number. Two strokes match only if they share at least a quarter ([`LEAST_SHARE`]) of the shorter one. A stroke
//! without a match gets a new number; numbers are never reused.

use super::{LineSegment, LineSettings, VisibleLines};
use crate::edges::{Class, ClassSet};
use crate::lines::drawing::chain::{LinePath, chain_curves};
use crate::lines::input::line_input::asked;
use crate::lines::input::object_edges::{ObjectEdges, object_edges};
use crate::scene::Scene;
use glam::{DVec3, IVec3};
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};

/// Distance between compared points of strokes, in radii of the scene; at most a quarter of how far strokes may
/// slide.
const SPACING: f64 = 1.0 / 200.0;

/// Share of the shorter of two strokes that they must have in common.
const LEAST_SHARE: f64 = 0.25;

/// Numbers the strokes of successive pictures.
#[derive(Debug)]
pub struct StrokeIds {
    /// The curve of each view-independent edge, numbered from 0, by object and the edge's vertices in the file.
    curves: HashMap<(u32, [u32; 2]), u32>,
    /// All strokes that may reappear.
    known: Vec<Stroke>,
    frame: u32,
    count: u32,
    /// Unit vector from the scene's centre to the last picture's eye.
    towards_eye: Option<DVec3>,
}

/// The place of a stroke on the models.
#[derive(Debug)]
struct Stroke {
    id: u32,
    group: Group,
    /// Points in world coordinates, each with the length of stroke that it represents.
    points: Vec<(DVec3, f64)>,
    length: f64,
    /// The last picture that showed it.
    frame: u32,
}

/// Object and curve of a stroke. For a line without a curve, its class takes the curve's place; see
/// [`curve_of_class`]. Only strokes of one group are compared.
type Group = (u32, u32);

/// The curve number that represents a class of lines without curves.
fn curve_of_class(class: Class) -> u32 {
    u32::MAX - class as u32
}

/// Whether the strokes of a group stay in place on the model.
fn stands((_, curve): Group) -> bool {
    ![Class::Silhouette, Class::Suggestive].map(curve_of_class).contains(&curve)
}

impl StrokeIds {
    /// Finds the curves of a scene's models, which do not depend on the view. No stroke has a number yet.
    pub fn new(scene: &Scene, settings: &LineSettings) -> Self {
        let mut curves = HashMap::new();
        let mut count = 0;
        for (object, part) in object_edges(scene, None).iter().enumerate() {
            add_curves(part, settings, &mut count, |edge, curve| {
                curves.insert((object as u32, edge), curve);
            });
        }
        Self { curves, known: Vec::new(), frame: 0, count: 0, towards_eye: None }
    }

    /// The count of numbers given so far; the first is 1.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Returns the next picture's paths with their numbers. `lines` are those of `scene`, which may differ from the
    /// last scene only in its camera.
    pub fn next(&mut self, scene: &Scene, lines: &VisibleLines) -> Vec<LinePath> {
        let towards_eye = (scene.camera.eye - scene.centre).normalize_or_zero();
        let slide = self.towards_eye.map_or(0.0, |before| before.distance(towards_eye)) * scene.radius;
        self.towards_eye = Some(towards_eye);
        self.frame += 1;
        let spacing = (SPACING * scene.radius).max(slide * 0.25);
        let curve = |segment: &LineSegment| {
            let edge = segment.edge.filter(|_| !ClassSet::FREE.contains(segment.class));
            let of_edge = edge.and_then(|edge| self.curves.get(&(segment.object, edge)));
            of_edge.copied().unwrap_or_else(|| curve_of_class(segment.class))
        };
        let mut paths = chain_curves(&lines.segments, curve);
        let mut strokes: Vec<Stroke> = paths
            .iter()
            .map(|path| {
                let group = (path.object, curve(&lines.segments[path.segments[0]]));
                Stroke::of(path, &lines.segments, group, spacing, self.frame)
            })
            .collect();

        // Strokes of the previous picture first, then earlier ones.
        let before = self.frame - 1;
        self.take_over(&mut strokes, |known| known.frame == before, [spacing, slide.max(spacing)]);
        self.take_over(&mut strokes, |known| known.frame < before, [spacing; 2]);
        for stroke in strokes.iter_mut().filter(|stroke| stroke.id == 0) {
            self.count += 1;
            stroke.id = self.count;
        }
        for (path, stroke) in paths.iter_mut().zip(&strokes) {
            path.stroke = Some(stroke.id);
        }
        self.known.retain(|known| known.frame < self.frame && stands(known.group));
        self.known.extend(strokes);
        paths
    }

    /// Gives the numbers of known strokes to new strokes that lie within `reach`: one distance for strokes that stay,
    /// one for those that slide.
    fn take_over(&mut self, strokes: &mut [Stroke], is_asked: impl Fn(&Stroke) -> bool, reach: [f64; 2]) {
        let reach_of = |group: Group| if stands(group) { reach[0] } else { reach[1] };
        let cell = |group: Group, point: DVec3| (point / reach_of(group)).floor().as_ivec3();
        let mut grid: HashMap<(Group, IVec3), Vec<(usize, DVec3)>> = HashMap::new();
        for (number, known) in self.known.iter().enumerate().filter(|(_, known)| is_asked(known)) {
            for (point, _) in &known.points {
                grid.entry((known.group, cell(known.group, *point))).or_default().push((number, *point));
            }
        }
        let nearest = |group: Group, point: DVec3| {
            let middle = cell(group, point);
            let mut best: Option<(f64, usize)> = None;
            for around in (0..27).map(|n| IVec3::new(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) {
                for (number, other) in grid.get(&(group, middle + around)).into_iter().flatten() {
                    let distance = point.distance(*other);
                    if distance <= reach_of(group) && best.is_none_or(|best| (distance, *number) < best) {
                        best = Some((distance, *number));
                    }
                }
            }
            best.map(|(_, number)| number)
        };
        let mut pairs: Vec<(f64, Reverse<usize>, Reverse<usize>)> = Vec::new();
        for (number, stroke) in strokes.iter().enumerate().filter(|(_, stroke)| stroke.id == 0) {
            let mut common: BTreeMap<usize, f64> = BTreeMap::new();
            for (point, length) in &stroke.points {
                if let Some(known) = nearest(stroke.group, *point) {
                    *common.entry(known).or_default() += length;
                }
            }
            let is_enough =
                |known: usize, common: f64| common >= LEAST_SHARE * stroke.length.min(self.known[known].length);
            let enough = common.into_iter().filter(|(known, common)| is_enough(*known, *common));
            pairs.extend(enough.map(|(known, common)| (common, Reverse(known), Reverse(number))));
        }
        pairs.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then((b.1, b.2).cmp(&(a.1, a.2))));
        for (_, Reverse(known), Reverse(number)) in pairs {
            // A known stroke of this frame is already matched.
            if strokes[number].id == 0 && self.known[known].frame < self.frame {
                strokes[number].id = self.known[known].id;
                self.known[known].frame = self.frame;
            }
        }
    }
}

impl Stroke {
    /// The stroke of a path, from its segments.
    fn of(path: &LinePath, segments: &[LineSegment], group: Group, spacing: f64, frame: u32) -> Self {
        let (mut points, mut length, mut waiting) = (Vec::new(), 0.0, 0.0);
        for piece in &path.segments {
            let [a, b] = segments[*piece].ends_world;
            let of_piece = a.distance(b);
            let count = (of_piece / spacing).ceil().max(1.0);
            for part in 0..count as usize {
                waiting += of_piece / count;
                if waiting >= spacing * 0.5 {
                    points.push((a.lerp(b, (part as f64 + 0.5) / count), waiting));
                    waiting = 0.0;
                }
            }
            length += of_piece;
        }
        // The remaining length belongs to the last point, or is the whole stroke.
        match points.last_mut() {
            Some((_, last)) => *last += waiting,
            None => points.push((segments[path.segments[0]].ends_world[0], waiting)),
        }
        Self { id: 0, group, points, length, frame }
    }
}

/// Calls `add` with each view-independent edge of an object, by its vertices in the file, and with its curve,
/// numbered from `count`.
fn add_curves(part: &ObjectEdges<'_>, settings: &LineSettings, count: &mut u32, mut add: impl FnMut([u32; 2], u32)) {
    let edges = part.edges.get();
    let (list, mesh) = (edges.list(), edges.mesh());
    let classes = edges.classes(settings.crease_angle, asked(settings));
    let wanted = settings.classes.and(ClassSet::EDGES);
    let mut ends: Vec<(u32, Class, usize)> = Vec::new();
    let drawn: Vec<u32> = classes.marked.iter().copied().filter(|edge| !part.is_within_a_face(*edge)).collect();
    for (number, edge) in drawn.iter().enumerate() {
        if let Some(class) = classes.of_edges[*edge as usize].and(wanted).first() {
            ends.extend(list.positions()[*edge as usize].map(|position| (position, class, number)));
        }
    }
    ends.sort_unstable();
    let mut of_edge: Vec<usize> = (0..drawn.len()).collect();
    let root = |of_edge: &mut [usize], mut number: usize| {
        while of_edge[number] != number {
            of_edge[number] = of_edge[of_edge[number]];
            number = of_edge[number];
        }
        number
    };
    for meeting in ends.chunk_by(|a, b| a.0 == b.0) {
        if let &[(_, first_class, first), (_, second_class, second)] = meeting
            && first_class == second_class
        {
            let (first, second) = (root(&mut of_edge, first), root(&mut of_edge, second));
            of_edge[first.max(second)] = first.min(second);
        }
    }
    let mut numbers: HashMap<usize, u32> = HashMap::new();
    ends.sort_unstable_by_key(|(.., number)| *number);
    for (.., number) in ends.iter().step_by(2) {
        let curve = *numbers.entry(root(&mut of_edge, *number)).or_insert_with(|| {
            *count += 1;
            *count - 1
        });
        let positions = list.positions()[drawn[*number] as usize];
        add(positions.map(|position| mesh.file_vertices[position as usize]), curve);
    }
}

#[cfg(test)]
mod tests;
