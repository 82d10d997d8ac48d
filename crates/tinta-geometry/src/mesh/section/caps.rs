//! The caps over the cut of one solid: triangles that use every side of their rings.

use super::rings::{double_area, nested, rings};
use crate::tolerances::ON_PLANE;
use earcut::Earcut;
use glam::DVec2;
use std::collections::{HashMap, HashSet};

/// Triangles over an outline and its holes.
pub(super) struct Cap {
    /// Their positions, counter-clockwise like the outline.
    pub(super) triangles: Vec<[u32; 3]>,
    /// A given side of the outline.
    pub(super) side: [u32; 2],
    /// Whether all sides ran with the solid at their right: an open surface wound inwards.
    pub(super) is_turned: bool,
}

/// The caps at the left of directed sides, and whether they use all of these. Sides without anything at their left
/// are turned.
pub(super) fn over(sides: &[[u32; 2]], in_plane: impl Fn(u32) -> DVec2) -> (Vec<Cap>, bool) {
    let found = CapRings::of(sides, &in_plane);
    if !found.outlines.is_empty() || found.rings.is_empty() {
        return found.caps(false);
    }
    let turned: Vec<[u32; 2]> = sides.iter().map(|[from, to]| [*to, *from]).collect();
    CapRings::of(&turned, &in_plane).caps(true)
}

/// The rings of some sides.
struct CapRings {
    rings: Vec<Vec<u32>>,
    points: Vec<Vec<DVec2>>,
    /// The outlines among them, each with its holes.
    outlines: Vec<(usize, Vec<usize>)>,
    /// Whether the outlines and their holes use all sides.
    is_closed: bool,
}

impl CapRings {
    fn of(sides: &[[u32; 2]], in_plane: &impl Fn(u32) -> DVec2) -> Self {
        let (rings, is_closed) = rings(sides, in_plane);
        let points: Vec<Vec<DVec2>> =
            rings.iter().map(|ring| ring.iter().map(|position| in_plane(*position)).collect()).collect();
        let outlines = nested(&points);
        let used = outlines.iter().map(|(_, holes)| 1 + holes.len()).sum::<usize>();
        Self { is_closed: is_closed && used == rings.len(), rings, points, outlines }
    }

    fn caps(&self, is_turned: bool) -> (Vec<Cap>, bool) {
        let (mut caps, mut is_closed) = (Vec::new(), self.is_closed);
        for (outer, holes) in &self.outlines {
            let of = || [outer].into_iter().chain(holes);
            let rings: Vec<&[u32]> = of().map(|ring| self.rings[*ring].as_slice()).collect();
            let points: Vec<&[DVec2]> = of().map(|ring| self.points[*ring].as_slice()).collect();
            let [first, second, ..] = rings[0] else { continue };
            let side = if is_turned { [*second, *first] } else { [*first, *second] };
            match triangles(&rings, &points) {
                Some(triangles) => caps.push(Cap { triangles, side, is_turned }),
                None => is_closed = false,
            }
        }
        (caps, is_closed)
    }
}

/// Directions in which a cap is tried. Rounding decides for earcut which corners in line it drops, and it drops too
/// much of one cap in ten thousand; turned by an angle it decides otherwise.
const TURNS: u32 = 8;

/// Triangles over an outline and its holes that use every side of them; `None` if that fails. A ring may meet a corner twice.
fn triangles(rings: &[&[u32]], points: &[&[DVec2]]) -> Option<Vec<[u32; 3]>> {
    let sides = Sides::of(rings, points);
    let turned = |turn: u32| {
        let turn = DVec2::from_angle(f64::from(turn));
        points.iter().flat_map(|ring| ring.iter()).map(|point| turn.rotate(*point)).collect::<Vec<_>>()
    };
    let with_skipped = |turn: u32| sides.with_skipped_corners(cut(rings, &turned(turn)));
    (0..TURNS).map(with_skipped).find(|triangles| sides.are_those_of(triangles))
}

/// What earcut makes of an outline and its holes, from the points of all.
fn cut(rings: &[&[u32]], flat: &[DVec2]) -> Vec<[u32; 3]> {
    let positions: Vec<u32> = rings.iter().flat_map(|ring| ring.iter().copied()).collect();
    let ends = rings.iter().scan(0, |sum, ring| {
        *sum += ring.len() as u32;
        Some(*sum)
    });
    let starts: Vec<u32> = ends.collect();
    let mut indices: Vec<u32> = Vec::new();
    Earcut::new().earcut(flat.iter().map(|point| point.to_array()), &starts[..starts.len() - 1], &mut indices);
    let corners = || indices.chunks_exact(3).map(|it| [it[0], it[1], it[2]]);
    // All turn one way, slivers too, whose own areas may round to the other sign.
    let is_clockwise =
        corners().map(|corners| double_area(&corners.map(|corner| flat[corner as usize]))).sum::<f64>() < 0.0;
    let of_positions = corners().map(|corners| corners.map(|corner| positions[corner as usize]));
    of_positions.map(|[a, b, c]| if is_clockwise { [a, c, b] } else { [a, b, c] }).collect()
}

/// The sides of some rings.
struct Sides {
    /// The places of the rings, one ring after the other.
    places: Vec<Place>,
    places_of: HashMap<u32, Vec<usize>>,
    /// Largest distance of a point that lies on a line.
    tolerance: f64,
}

/// A corner of a ring.
struct Place {
    position: u32,
    point: DVec2,
    /// The number of the next one.
    next: usize,
}

impl Sides {
    fn of(rings: &[&[u32]], points: &[&[DVec2]]) -> Self {
        let (mut places, mut places_of): (Vec<Place>, HashMap<u32, Vec<usize>>) = Default::default();
        for (ring, points) in rings.iter().zip(points) {
            let first = places.len();
            for (at, (position, point)) in ring.iter().zip(*points).enumerate() {
                places_of.entry(*position).or_default().push(places.len());
                places.push(Place { position: *position, point: *point, next: first + (at + 1) % ring.len() });
            }
        }
        let size =
            points.iter().flat_map(|ring| ring.iter()).map(|point| point.distance(places[0].point)).fold(0.0, f64::max);
        Self { places, places_of, tolerance: size * ON_PLANE }
    }

    /// The positions on the line from one to another, both included: those of a ring's sides in line, or else all that lie on it.
    fn along(&self, from: u32, to: u32) -> Option<Vec<u32>> {
        let starts = self.places_of.get(&from)?;
        let [first, last] = [starts, self.places_of.get(&to)?].map(|places| self.places[places[0]].point);
        let line = last - first;
        let is_on = |place: &Place| {
            let (along, length) = ((place.point - first).dot(line), line.length());
            (0.0..=length * length).contains(&along)
                && (place.point - first).perp_dot(line).abs() <= self.tolerance * length
        };
        let way = |start: &usize| {
            let (mut way, mut place) = (vec![from], &self.places[self.places[*start].next]);
            while is_on(place) && place.position != from {
                way.push(place.position);
                if place.position == to {
                    return Some(way);
                }
                place = &self.places[place.next];
            }
            None
        };
        starts.iter().find_map(way).or_else(|| {
            // Away from both ends: each part is shorter.
            let least = self.tolerance * line.length();
            let is_within = |along: f64| along > least && along < line.length_squared() - least;
            let mut between: Vec<&Place> = self.places.iter().filter(|place| is_on(place)).collect();
            between.retain(|place| is_within((place.point - first).dot(line)));
            between.sort_by(|a, b| (a.point - first).dot(line).total_cmp(&(b.point - first).dot(line)));
            let mut way: Vec<u32> =
                [from].into_iter().chain(between.iter().map(|place| place.position)).chain([to]).collect();
            way.dedup();
            Some(way)
        })
    }

    /// Triangles with the corners that earcut drops, in line with their neighbours in a ring or at the end of a bridge between two:
    /// each goes back into the triangle along whose side it lies.
    fn with_skipped_corners(&self, triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
        let mut all: HashSet<[u32; 2]> = triangles.iter().flat_map(sides_of).collect();
        let mut waiting = triangles;
        let mut done = Vec::new();
        while let Some(triangle) = waiting.pop() {
            let skipped = (0..3).find_map(|at| {
                let [from, to] = [triangle[at], triangle[(at + 1) % 3]];
                let way = if all.contains(&[to, from]) { None } else { self.along(from, to) };
                way.filter(|way| way.len() > 2).map(|way| (way, triangle[(at + 2) % 3]))
            });
            let Some((way, opposite)) = skipped else {
                done.push(triangle);
                continue;
            };
            // The first and last of these keep a side of the triangle, which may skip corners too. Of a triangle in line, nothing is
            // left where its third corner is met.
            for pair in way.windows(2).filter(|pair| !pair.contains(&opposite)) {
                let part = [pair[0], pair[1], opposite];
                all.extend(sides_of(&part));
                waiting.push(part);
            }
        }
        done
    }

    /// Whether these are the sides of triangles that no two of them share.
    fn are_those_of(&self, triangles: &[[u32; 3]]) -> bool {
        let own = self.places.iter().map(|place| [self.places[place.next].position, place.position]);
        let mut balance: HashMap<[u32; 2], i32> = HashMap::new();
        for [from, to] in triangles.iter().flat_map(sides_of).chain(own) {
            *balance.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
        balance.values().all(|sum| *sum == 0)
    }
}

/// The sides of a triangle, each from corner to corner.
fn sides_of(triangle: &[u32; 3]) -> [[u32; 2]; 3] {
    let [a, b, c] = *triangle;
    [[a, b], [b, c], [c, a]]
}
