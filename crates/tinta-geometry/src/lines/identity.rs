//! Strokes that stay the same from picture to picture while the eye moves.
//!
//! In: the lines of one picture after another of the same models. Out: their paths, each with the number of its stroke
//! ([`LinePath::stroke`]). A stroke is known by where it lies on the models, not in the picture:
//!
//! - Edges whose class does not depend on the view make *curves*, which end at corners: where other than two edges of one class
//!   meet. A path keeps to one curve, whether its pieces are drawn as creases or as silhouettes. A stroke of a curve that
//!   was hidden has its old number when it comes back, and so have intersections, ridges and valleys.
//! - Silhouettes elsewhere, suggestive contours and apparent ridges slide over the surface. They are compared with those of the
//!   same class and object in the picture before. Each point is taken for the nearest one there, no farther away than a ball as large
//!   as the scene turns its own outline; a stroke that is not seen for one picture is gone.
//!
//! Of all pairs of an old stroke and a new one the pair with the longest common stretch on the surface comes first, then the
//! next of what is left; so a stroke that splits keeps its number in the longer part, and of two that become one the longer gives
//! its number. Less than a quarter ([`LEAST_SHARE`]) of the shorter of both in common is no reason to be the same. What finds
//! no old stroke is a new one; no number is given twice.

use super::{LineSegment, LineSettings, VisibleLines};
use crate::edges::{Class, ClassSet};
use crate::lines::drawing::chain::{LinePath, chain_curves};
use crate::lines::input::features::asked;
use crate::lines::input::object_edges::{ObjectEdges, object_edges};
use crate::scene::Scene;
use glam::{DVec3, IVec3};
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};

/// Points of strokes that are compared are so far apart, radii of the scene; at most a quarter of how far strokes may slide.
const SPACING: f64 = 1.0 / 200.0;

/// Share of the shorter of two strokes that they must have in common.
const LEAST_SHARE: f64 = 0.25;

/// Gives the strokes of one picture after another their numbers.
#[derive(Debug)]
pub struct StrokeIds {
    /// Of an object's edges, by their vertices in the file, the curve that each is part of; from 0.
    curves: HashMap<(u32, [u32; 2]), u32>,
    /// All that may be seen again.
    known: Vec<Stroke>,
    frame: u32,
    count: u32,
    /// From the scene's centre to the eye of the last picture, length 1.
    towards_eye: Option<DVec3>,
}

/// Where a stroke lies.
#[derive(Debug)]
struct Stroke {
    id: u32,
    group: Group,
    /// Points in the world and the length of stroke that each stands for.
    points: Vec<(DVec3, f64)>,
    length: f64,
    /// The last picture that showed it.
    frame: u32,
}

/// Strokes are compared within an object and a curve, or a class of lines that are on none; see [`curve_of_class`].
type Group = (u32, u32);

/// What stands for a class where lines are on no curve.
fn curve_of_class(class: Class) -> u32 {
    u32::MAX - class as u32
}

/// Whether strokes stay where they are on the model.
fn stands((_, curve): Group) -> bool {
    ![Class::Silhouette, Class::Suggestive, Class::ApparentRidge].map(curve_of_class).contains(&curve)
}

impl StrokeIds {
    /// Finds the curves of a scene's models, from wherever it is seen. Nothing has a number yet.
    pub fn new(scene: &Scene, settings: &LineSettings) -> Self {
        let mut curves = HashMap::new();
        let mut count = 0;
        for (object, part) in object_edges(scene).iter().enumerate() {
            add_curves(part, settings, &mut count, |edge, curve| {
                curves.insert((object as u32, edge), curve);
            });
        }
        Self { curves, known: Vec::new(), frame: 0, count: 0, towards_eye: None }
    }

    /// How many numbers were given, from 1 on.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The next picture's paths with their numbers: `lines` of `scene`, which differs from the last one by its camera only.
    pub fn next(&mut self, scene: &Scene, lines: &VisibleLines) -> Vec<LinePath> {
        let towards_eye = (scene.camera.eye - scene.centre).normalize_or_zero();
        let slide = self.towards_eye.map_or(0.0, |before| before.distance(towards_eye)) * scene.radius;
        self.towards_eye = Some(towards_eye);
        self.frame += 1;
        let spacing = (SPACING * scene.radius).max(slide * 0.25);
        let curve = |segment: &LineSegment| {
            let of_edge = segment.edge.and_then(|edge| self.curves.get(&(segment.object, edge)));
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

        // First what was there a moment ago, then what was there before.
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

    /// Gives numbers of known strokes to those that have none, where they lie no farther apart than `reach`: what stands and
    /// what slides.
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
            // Taken ones are of this picture.
            if strokes[number].id == 0 && self.known[known].frame < self.frame {
                strokes[number].id = self.known[known].id;
                self.known[known].frame = self.frame;
            }
        }
    }
}

impl Stroke {
    /// Where a path of some pieces lies.
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
        // What is left belongs to the last point, or is all there is.
        match points.last_mut() {
            Some((_, last)) => *last += waiting,
            None => points.push((segments[path.segments[0]].ends_world[0], waiting)),
        }
        Self { id: 0, group, points, length, frame }
    }
}

/// Calls `add` with the edges of a part that do not depend on the view, by their vertices in the file, and the curve of each,
/// numbered from `count` on.
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
