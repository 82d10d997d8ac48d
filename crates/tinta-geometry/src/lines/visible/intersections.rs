//! The lines where faces pass through one another.
//!
//! Two faces do if each reaches across the other's plane and their parts of the line common to both planes overlap. A corner
//! nearer to a plane than the contact distance lies in it. A face with an edge in the other's plane only touches the other face.
//! There the *surfaces* decide: they intersect if their half-planes around that edge alternate. No rule depends on a face's
//! winding.

use crate::bvh::{Box3, LARGEST_LEAF, NO_GROUP, NodeSelection, counting_steps, steps};
use crate::lines::input::object_edges::ObjectEdges;
use crate::lines::progress::{Phase, Progress};
use crate::lines::visible::faces::{Faces, Own, ProbedLine};
use crate::lines::visible::nearest_faces::NearestFaces;
use crate::lines::visible::pyramid::Pyramid;
use crate::lines::visible::space::Space;
use crate::threads::{cores, filled, in_chunks, spread_chunks, threads_for_items};
use crate::tolerances::CONTACT;
use glam::{DVec2, DVec3};
use std::collections::{HashMap, HashSet};

/// A piece of line common to two faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Intersection {
    /// The one with the lower number first.
    pub faces: [u32; 2],
    /// In the eye's space.
    pub ends: [DVec3; 2],
}

/// A point where an edge passes through a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Piercing {
    /// The edge's positions, the lower number first.
    pub edge: [u32; 2],
    /// In the eye's space.
    pub point: DVec3,
}

/// The common lines and points of faces that pass through one another.
#[derive(Default)]
pub(in crate::lines) struct Intersections {
    /// By their faces' numbers.
    pub lines: Vec<Intersection>,
    pub piercings: Vec<Piercing>,
    /// Count of tested boxes.
    pub compared: u64,
}

/// Whether a pyramid hides a line.
fn is_hidden(space: &Space, pyramid: &Pyramid, ends: [DVec3; 2]) -> bool {
    ends.iter().all(|end| -end.z >= space.near) && pyramid.hides_line(ends.map(|end| space.project(end)))
}

/// Finds all intersections of a scene's faces that a pyramid does not hide, and the points where edges pierce faces. The list is
/// incomplete if the time runs out.
pub(in crate::lines) fn intersections(
    space: &Space,
    faces: &Faces,
    parts: &[ObjectEdges],
    (pyramid, nearest_faces): (Option<&Pyramid>, Option<&NearestFaces>),
    progress: &Progress,
) -> Intersections {
    let seen = pyramid.map(|pyramid| pyramid.seen(space, faces));
    let is_seen = |place: u32| seen.as_ref().is_none_or(|seen| seen[place as usize]);
    let wanted = seen.as_ref().map_or_else(NodeSelection::default, |seen| faces.tree.wanted(seen));
    let is_open = |ends: [DVec3; 2]| !pyramid.is_some_and(|pyramid| is_hidden(space, pyramid, ends));
    let node_pairs = faces.tree.node_pairs(&wanted);
    const PAIRS_A_GLANCE: u32 = 1024;
    progress.begin(Phase::Intersections, node_pairs.len());
    let meeting = Meeting { space, faces, nearest_faces };
    let in_batches = |batches: std::ops::Range<usize>| {
        let (count, before) = (batches.len(), steps());
        let (mut kept, mut pairs) = (Findings::default(), 0u32);
        // Pairs come leaf by leaf, and the places in a leaf follow one another.
        let mut face_planes: [Option<FacePlane>; LARGEST_LEAF as usize] = Default::default();
        faces.tree.pairs_below(&node_pairs[batches], &wanted, &mut |first, second| {
            pairs = pairs.wrapping_add(1);
            if pairs % PAIRS_A_GLANCE == 0 && progress.is_over() {
                return true;
            }
            if !is_seen(first) || !is_seen(second) {
                return false;
            }
            let face_plane = &mut face_planes[(first % LARGEST_LEAF) as usize];
            if face_plane.as_ref().is_none_or(|face_plane| face_plane.place != first) {
                *face_plane = Some(FacePlane::new(space, faces, first));
            }
            let found = face_plane.as_ref().and_then(|first| first.meet(space, faces, second));
            found.filter(|found| is_open(found.ends)).into_iter().for_each(|found| kept.add(&meeting, found));
            false
        });
        progress.advance(count, steps().wrapping_sub(before));
        kept
    };
    let mut chunks = spread_chunks(node_pairs.len(), 8, cores(), |batches| counting_steps(|| in_batches(batches)));
    chunks.extend(around_high_valence(&meeting, is_seen, is_open, progress));
    let compared = chunks.iter().map(|(_, steps)| steps).sum();
    if progress.is_over() {
        return Intersections { compared, ..Intersections::default() };
    }
    let mut all = Findings::default();
    chunks.into_iter().for_each(|(some, _)| all.append(some));
    all.lines.sort_unstable_by_key(|found| found.faces.map(|face| faces.numbers[face as usize]));
    let split = SplitEdges::new(parts);
    let touched = HalfPlanes::at_touched_edges(&split, &all.lines);
    let lines = all.lines.into_iter().filter(|found| touched.pass_through(space, faces, found));
    let lines = lines.map(|found| Intersection { faces: found.faces, ends: found.ends }).collect();
    Intersections {
        lines: without_repeated(space, faces, lines),
        piercings: split.piercings(faces, all.piercings),
        compared,
    }
}

/// The input of a search for faces that meet.
struct Meeting<'a> {
    space: &'a Space,
    faces: &'a Faces,
    nearest_faces: Option<&'a NearestFaces>,
}

/// The results that a search keeps.
#[derive(Default)]
struct Findings {
    /// Lines that the nearest faces do not hide.
    lines: Vec<FaceCrossing>,
    piercings: Vec<Piercing>,
}

impl Findings {
    fn add(&mut self, &Meeting { space, faces, nearest_faces }: &Meeting, found: FaceCrossing) {
        self.piercings.extend(found.piercings.into_iter().flatten());
        let is_hidden = |nearest_faces: &NearestFaces| {
            let weld = faces.weld(faces.triangles[found.faces[0] as usize][0]);
            let line = ProbedLine::new(faces, Own::Faces(found.faces), found.ends, weld);
            nearest_faces.hide(space, faces, line, found.ends)
        };
        if found.is_line && !nearest_faces.is_some_and(is_hidden) {
            self.lines.push(found);
        }
    }

    fn append(&mut self, other: Self) {
        self.lines.extend(other.lines);
        self.piercings.extend(other.piercings);
    }
}

/// Keeps the first of lines in the same place. Spokes that end in one axis have one line there, not one for each two.
fn without_repeated(space: &Space, faces: &Faces, mut lines: Vec<Intersection>) -> Vec<Intersection> {
    /// The resolution of places, as a share of the contact distance.
    const SAME: f64 = 0.01;
    let mut places: HashSet<[[i64; 3]; 2]> = HashSet::new();
    lines.retain(|line| {
        let touching = faces.weld(faces.triangles[line.faces[0] as usize][0]) + 4.0 * space.noise;
        let place = |end: DVec3| (end / (SAME * touching)).round().to_array().map(|number| number as i64);
        let [a, b] = line.ends.map(place);
        places.insert([a.min(b), a.max(b)])
    });
    lines
}

/// Returns the intersections of faces around one high-valence vertex that may be visible, with the number of boxes compared. They
/// begin at that vertex and end where the side opposite to it passes through a face.
fn around_high_valence(
    meeting: &Meeting,
    is_seen: impl Fn(u32) -> bool + Sync,
    is_open: impl Fn([DVec3; 2]) -> bool + Sync,
    progress: &Progress,
) -> Vec<(Findings, u64)> {
    const AT_ONCE: usize = 64;
    let &Meeting { space, faces, .. } = meeting;
    if faces.high_valence.is_empty() {
        return Vec::new();
    }
    let shared_edges = shared_edges(faces);
    let is_asked = |place: u32| {
        let vertex = faces.high_valence[place as usize];
        vertex != NO_GROUP && !shared_edges.contains(&vertex) && is_seen(place)
    };
    // The box around the side opposite to the high-valence vertex, for faces in the search.
    let side_box = |place: usize| {
        is_asked(place as u32).then(|| {
            let vertex = faces.high_valence[place];
            let opposite = faces.triangles[place].into_iter().filter(|position| *position != vertex);
            let images = opposite.map(|position| {
                let (px, key) = space.project(faces.positions[position as usize]);
                px.extend(key)
            });
            let (low, high) = crate::mesh::bounds(&images.collect::<Vec<_>>());
            // The contact distance is a hundred-thousandth of a side.
            let margin = (high - low).max_element() * (8.0 * CONTACT);
            Box3::new(low - margin, high + margin)
        })
    };
    let sides = filled(faces.high_valence.len(), threads_for_items(faces.high_valence.len()), None, side_box);
    let boxes = faces.tree.boxes();
    let add_of = |place: usize, kept: &mut Findings| {
        let Some(side) = sides[place].filter(|_| !progress.is_over()) else { return };
        let face_plane = FacePlane::new(space, faces, place as u32);
        faces.tree.any(&side, |other| {
            let other_place = other as usize;
            let is_of_same_vertex =
                other_place != place && faces.high_valence[other_place] == faces.high_valence[place];
            // Where each side is near the other face, the pair comes from the first.
            let comes_once =
                place < other_place || !sides[other_place].is_some_and(|side| side.overlaps(&boxes[place]));
            if is_of_same_vertex && comes_once && sides[other_place].is_some() {
                let found = face_plane.meet(space, faces, other).filter(|found| is_open(found.ends));
                found.into_iter().for_each(|found| kept.add(meeting, found));
            }
            false
        });
    };
    in_chunks(faces.high_valence.len(), AT_ONCE, cores(), |range| {
        counting_steps(|| {
            let mut kept = Findings::default();
            range.for_each(|place| add_of(place, &mut kept));
            kept
        })
    })
}

/// Returns the high-valence vertices whose faces all share a second corner: these faces have only that edge in common.
fn shared_edges(faces: &Faces) -> HashSet<u32> {
    let mut common: HashMap<u32, Vec<u32>> = HashMap::new();
    for (vertex, corners) in faces.high_valence.iter().zip(&faces.triangles).filter(|(vertex, _)| **vertex != NO_GROUP)
    {
        common.entry(*vertex).or_insert_with(|| corners.to_vec()).retain(|corner| corners.contains(corner));
    }
    common.into_iter().filter(|(_, corners)| corners.len() > 1).map(|(vertex, _)| vertex).collect()
}

/// The common part of two faces.
#[derive(Debug, Clone, Copy)]
struct FaceCrossing {
    /// The one with the lower number first.
    faces: [u32; 2],
    ends: [DVec3; 2],
    /// Whether it is long enough, and between faces high enough, to be a line: needles are cut but draw none.
    is_line: bool,
    piercings: [Option<Piercing>; 4],
    /// Each face's edge that lies in the other's plane, if any.
    touching: [Option<[u32; 2]>; 2],
}

/// The splits of edges at T-junctions.
struct SplitEdges<'a> {
    parts: &'a [ObjectEdges<'a>],
    /// Each part's first position.
    starts: Vec<u32>,
}

impl<'a> SplitEdges<'a> {
    fn new(parts: &'a [ObjectEdges<'a>]) -> Self {
        let next_start = |next: &mut u32, part: &ObjectEdges| {
            Some(std::mem::replace(next, *next + part.shape().positions.len() as u32))
        };
        Self { parts, starts: parts.iter().scan(0, next_start).collect() }
    }

    /// The positions along an edge, its own first and last.
    fn way(&self, edge: [u32; 2]) -> Vec<u32> {
        let part = self.starts.partition_point(|start| *start <= edge[0]) - 1;
        let start = self.starts[part];
        let on_edge = self.parts[part].on_edge(edge.map(|position| position - start)).iter();
        [edge[0]].into_iter().chain(on_edge.map(|position| position + start)).chain([edge[1]]).collect()
    }

    /// Assigns each piercing of an edge to the piece that holds it, and to that piece's neighbours, because they may meet there.
    /// A point beyond a piece's end does not cut the piece.
    fn piercings(&self, faces: &Faces, found: Vec<Piercing>) -> Vec<Piercing> {
        if !self.parts.iter().any(ObjectEdges::has_split_edges) {
            return found;
        }
        let of_pieces = |piercing: Piercing| {
            let Piercing { edge, point } = piercing;
            let way = self.way(edge);
            let number = piece_at(faces, &way, point);
            let near = &way[number.saturating_sub(1)..way.len().min(number + 3)];
            pieces(near).map(|edge| Piercing { edge, point }).collect::<Vec<_>>()
        };
        found.into_iter().flat_map(of_pieces).collect()
    }
}

/// The pieces between positions along an edge, the lower position of each first.
fn pieces(way: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    way.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
}

/// The number of the piece of an edge that is nearest to a point on it.
fn piece_at(faces: &Faces, way: &[u32], point: DVec3) -> usize {
    let position = |index: usize| faces.positions[way[index] as usize];
    let along = position(way.len() - 1) - position(0);
    way[1..way.len() - 1].partition_point(|at| (faces.positions[*at as usize] - point).dot(along) <= 0.0)
}

/// The faces at each edge that lies in another face's plane: how the surface continues there, with T-junctions split.
struct HalfPlanes {
    /// The positions along each edge at which it was split, with its own.
    ways: HashMap<[u32; 2], Vec<u32>>,
    /// All faces at a piece: the third corner of each, and the number of the whole face that it is a part of.
    at_pieces: HashMap<[u32; 2], Vec<(u32, u32)>>,
}

impl HalfPlanes {
    fn at_touched_edges(split: &SplitEdges, lines: &[FaceCrossing]) -> Self {
        let touched: HashSet<[u32; 2]> = lines.iter().flat_map(|found| found.touching.into_iter().flatten()).collect();
        let ways: HashMap<[u32; 2], Vec<u32>> = touched.into_iter().map(|edge| (edge, split.way(edge))).collect();
        let mut at_pieces: HashMap<[u32; 2], Vec<(u32, u32)>> =
            ways.values().flat_map(|way| pieces(way)).map(|piece| (piece, Vec::new())).collect();
        if ways.is_empty() {
            return Self { ways, at_pieces };
        }
        let mut first_face = 0;
        for (part, start) in split.parts.iter().zip(&split.starts) {
            for (face, triangle) in (0..).zip(&part.edges.get().mesh().triangles) {
                let [a, b, c] = triangle.map(|corner| corner + start);
                for (from, to, third) in [(a, b, c), (b, c, a), (c, a, b)] {
                    if let Some(at_piece) = at_pieces.get_mut(&[from.min(to), from.max(to)]) {
                        at_piece.push((third, first_face + part.whole_face(face)));
                    }
                }
            }
            first_face += part.shape().triangles.len() as u32;
        }
        Self { ways, at_pieces }
    }

    /// The third corners of the faces at the piece of an edge that is nearest to a point. The parts of a face that passes through the
    /// edge, given by its number, are not among them.
    fn at(&self, faces: &Faces, edge: [u32; 2], point: DVec3, passing: u32) -> impl Iterator<Item = u32> {
        let way = &self.ways[&edge];
        let number = piece_at(faces, way, point);
        let at_piece = &self.at_pieces[&[way[number].min(way[number + 1]), way[number].max(way[number + 1])]];
        at_piece.iter().filter(move |(_, whole)| *whole != passing).map(|(third, _)| *third)
    }

    /// Whether two surfaces pass through one another along a line: around it, half-planes of one and of the other follow one
    /// another twice. Half-planes of both that coincide count for neither.
    fn pass_through(&self, space: &Space, faces: &Faces, found: &FaceCrossing) -> bool {
        if found.touching == [None; 2] {
            return true;
        }
        let [start, end] = found.ends;
        let Some(along) = (end - start).try_normalize() else { return false };
        let (right, up) = along.any_orthonormal_pair();
        let around = |point: DVec3| {
            let across = point - start;
            DVec2::new(across.dot(right), across.dot(up))
        };
        let farthest = |corners: [DVec2; 3], towards: DVec2| {
            let reach = |corner: &DVec2| corner.dot(towards);
            corners.into_iter().max_by(|a, b| reach(a).total_cmp(&reach(b))).unwrap_or_default()
        };
        // Each half-plane by its farthest point, seen along the line.
        let half_planes = |side: usize| -> Vec<DVec2> {
            match found.touching[side] {
                Some(edge) => {
                    let passing = faces.numbers[found.faces[1 - side] as usize];
                    let thirds = self.at(faces, edge, start.lerp(end, 0.5), passing);
                    thirds.map(|third| around(faces.positions[third as usize])).collect()
                }
                None => {
                    let corners = faces.corners(found.faces[side]).map(around);
                    let some = corners.into_iter().max_by(|a, b| a.length().total_cmp(&b.length())).unwrap_or_default();
                    [some, -some].map(|towards| farthest(corners, towards)).to_vec()
                }
            }
        };
        let [first, second] = [half_planes(0), half_planes(1)];
        let face_planes = found.faces.map(|place| FacePlane::new(space, faces, place));
        let contact = face_planes[0].contact(space, &face_planes[1]);
        let lie_on_one_another = |a: DVec2, b: DVec2| {
            let (short, long) = if a.length() <= b.length() { (a, b) } else { (b, a) };
            short.dot(long) > 0.0 && short.perp_dot(long).abs() <= contact * long.length()
        };
        let without = |some: &[DVec2], others: &[DVec2]| -> Vec<f64> {
            let apart = some.iter().filter(|a| !others.iter().any(|b| lie_on_one_another(**a, *b)));
            apart.map(|towards| towards.to_angle()).collect()
        };
        let (first_apart, second_apart) = (without(&first, &second), without(&second, &first));
        let mut round: Vec<(f64, bool)> = first_apart.into_iter().map(|angle| (angle, false)).collect();
        round.extend(second_apart.into_iter().map(|angle| (angle, true)));
        round.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        (0..round.len()).filter(|index| round[*index].1 != round[(index + 1) % round.len()].1).count() >= 4
    }
}

/// A face with its plane.
struct FacePlane {
    place: u32,
    numbers: [u32; 3],
    corners: [DVec3; 3],
    /// Not normalised.
    normal: DVec3,
    normal_length: f64,
    /// The longest side.
    longest: f64,
    weld: f64,
    /// The largest contact distance with any other face, times the normal's length.
    loose: f64,
}

/// Two faces that each reach across the other's plane or have an edge in it.
struct Pair<'a> {
    faces: &'a Faces,
    places: [u32; 2],
    /// Each face's corners' distances from the other's plane times the length of its normal, 0 where they touch it.
    distances: [[f64; 3]; 2],
    /// Along both planes.
    direction: DVec3,
    /// The place in each face of the one corner they share.
    shared: Option<[usize; 2]>,
    /// The length of the shortest line.
    shortest: f64,
    /// Each face's edge that lies in the other's plane.
    touching: [Option<[u32; 2]>; 2],
}

/// A point where a side of one face passes the other's plane.
#[derive(Clone, Copy)]
struct Crossing {
    /// Along the common line.
    along: f64,
    piercing: Piercing,
}

impl FacePlane {
    fn new(space: &Space, faces: &Faces, place: u32) -> Self {
        let numbers = faces.triangles[place as usize];
        let corners = faces.corners(place);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let (normal_length, weld) = (normal.length(), faces.weld(numbers[0]));
        let longest = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared()).sqrt();
        let loose = (CONTACT * longest + weld + 4.0 * space.noise) * normal_length;
        Self { place, numbers, corners, normal, normal_length, longest, weld, loose }
    }

    /// Returns the common part of this face and another, if each has corners on both sides of the other's plane.
    fn meet(&self, space: &Space, faces: &Faces, other: u32) -> Option<FaceCrossing> {
        let numbers = faces.triangles[other as usize];
        let mut shared = None;
        let mut shared_count = 0;
        for (i, corner) in self.numbers.iter().enumerate() {
            if let Some(j) = numbers.iter().position(|other| other == corner) {
                shared = Some([i, j]);
                shared_count += 1;
            }
        }
        // Neighbours along an edge have only the edge in common, unless they lie on one another.
        if shared_count > 1 {
            return None;
        }
        let own = shared.map(|[_, j]| j);
        let raw = self.raw_distances(faces.corners(other));
        let all = |holds: &dyn Fn(f64) -> bool| (0..3).all(|index| own == Some(index) || holds(raw[index]));
        if all(&|distance| distance > self.loose) || all(&|distance| distance < -self.loose) {
            return None;
        }
        let other = Self::new(space, faces, other);
        let contact = self.contact(space, &other);
        // A face no higher than the contact distance is a line and has no plane, but may still pass through a face.
        let is_needle = |face_plane: &Self| face_plane.normal_length <= contact * face_plane.longest;
        match (is_needle(self), is_needle(&other)) {
            (true, true) => return None,
            (true, false) => return self.needle_through(faces, &other, contact),
            (false, true) => return other.needle_through(faces, self, contact),
            (false, false) => {}
        }
        let second = Sides::of(raw, own, contact * self.normal_length)?;
        let raw = other.raw_distances(self.corners);
        let first = Sides::of(raw, shared.map(|[i, _]| i), contact * other.normal_length)?;
        // Where each only touches the other's plane, they have a line in common if both edges lie on one another.
        if let (Some(edge), Some(other_edge)) = (first.edge, second.edge)
            && !lie_on_one_line(edge.map(|i| self.corners[i]), other_edge.map(|i| other.corners[i]), contact)
        {
            return None;
        }
        let (face_planes, sides) = match faces.in_order(self.place, other.place) {
            true => ([self, &other], [first, second]),
            false => ([&other, self], [second, first]),
        };
        let touching = [0, 1].map(|face| {
            let [a, b] = sides[face].edge?.map(|corner| face_planes[face].numbers[corner]);
            Some([a.min(b), a.max(b)])
        });
        Pair {
            faces,
            places: face_planes.map(|face_plane| face_plane.place),
            distances: sides.map(|sides| sides.distances),
            direction: face_planes[0].normal.cross(face_planes[1].normal),
            shared: if face_planes[0].place == self.place { shared } else { shared.map(|[i, j]| [j, i]) },
            shortest: contact,
            touching,
        }
        .common()
    }

    /// Returns the points where the sides of this face, too thin to have a plane, pass through another.
    fn needle_through(&self, faces: &Faces, other: &Self, contact: f64) -> Option<FaceCrossing> {
        let distances = Sides::of(other.raw_distances(self.corners), None, contact * other.normal_length)?.distances;
        let (places, kept) = match faces.in_order(self.place, other.place) {
            true => ([self.place, other.place], [distances, [0.0; 3]]),
            false => ([other.place, self.place], [[0.0; 3], distances]),
        };
        let face = usize::from(places[1] == self.place);
        let pair = Pair {
            faces,
            places,
            distances: kept,
            direction: DVec3::ZERO,
            shared: None,
            shortest: contact,
            touching: [None; 2],
        };
        let mut piercings = (0..3)
            .filter_map(|corner| pair.crossing(face, corner, (corner + 1) % 3))
            .map(|crossing| crossing.piercing)
            .filter(|piercing| other.contains(piercing.point));
        let piercings = [piercings.next(), piercings.next(), None, None];
        let point = piercings[0]?.point;
        Some(FaceCrossing { faces: places, ends: [point; 2], is_line: false, piercings, touching: [None; 2] })
    }

    /// Whether a point of the plane lies in the face, or so near its rim that the error is at most a needless cut.
    fn contains(&self, point: DVec3) -> bool {
        let [a, b, c] = self.corners;
        let least = -CONTACT * self.normal_length * self.normal_length;
        [(a, b), (b, c), (c, a)].iter().all(|(from, to)| (*to - *from).cross(point - *from).dot(self.normal) >= least)
    }

    /// The distance below which this face and another touch, file units.
    fn contact(&self, space: &Space, other: &Self) -> f64 {
        CONTACT * self.longest.min(other.longest) + self.weld.min(other.weld) + 4.0 * space.noise
    }

    /// Points' distances from the plane, times the normal's length.
    fn raw_distances(&self, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
        let distance = |point: DVec3| self.normal.dot(point - self.corners[0]);
        [distance(a), distance(b), distance(c)]
    }
}

/// The position of a face relative to a plane that it reaches.
struct Sides {
    /// 0 for corners that touch the plane. Negative where all others lie on one side.
    distances: [f64; 3],
    /// The two corners that touch it, where the third lies clearly on one side: the face ends or bends there.
    edge: Option<[usize; 2]>,
}

impl Sides {
    /// Returns the position of a face with corners on both sides of a plane, or with an edge in it. A corner that two faces share
    /// lies in both planes.
    fn of(mut distances: [f64; 3], shared: Option<usize>, touching: f64) -> Option<Self> {
        let (mut below, mut above) = (false, false);
        for (index, distance) in distances.iter_mut().enumerate() {
            if shared == Some(index) || distance.abs() <= touching {
                *distance = 0.0;
            }
            below |= *distance < 0.0;
            above |= *distance > 0.0;
        }
        if below && above {
            return Some(Self { distances, edge: None });
        }
        let third = distances.iter().position(|distance| *distance != 0.0)?;
        let edge = [(third + 1) % 3, (third + 2) % 3];
        let touches = edge.iter().all(|corner| distances[*corner] == 0.0);
        touches.then(|| Self { distances: distances.map(|distance| -distance.abs()), edge: Some(edge) })
    }
}

/// Whether the ends of an edge are nearer to the line through another than a distance.
fn lie_on_one_line([a, b]: [DVec3; 2], other: [DVec3; 2], distance: f64) -> bool {
    let along = (b - a).normalize_or_zero();
    other.iter().all(|end| along.cross(*end - a).length() <= distance)
}

impl Pair<'_> {
    /// Returns the line that both have in common, if their parts of it overlap.
    fn common(&self) -> Option<FaceCrossing> {
        let same_place = self.shortest * self.direction.length();
        // Where an edge passes through an edge, both are cut.
        let at_end = |nearer: Crossing, farther: Crossing| {
            let is_in_both = (nearer.along - farther.along).abs() <= same_place;
            [Some(nearer.piercing), is_in_both.then_some(farther.piercing)]
        };
        let mut overlap = true;
        let (ends, piercings) = match self.shared {
            None => {
                let [first, second] = [self.both_crossings(0)?, self.both_crossings(1)?];
                let low = if first.0.along >= second.0.along { [first.0, second.0] } else { [second.0, first.0] };
                let high = if first.1.along <= second.1.along { [first.1, second.1] } else { [second.1, first.1] };
                // Rounding must not lose such a cut.
                if low[0].along - high[0].along > same_place {
                    return None;
                }
                overlap = low[0].along < high[0].along;
                let [a, b] = at_end(low[0], low[1]);
                let [c, d] = at_end(high[0], high[1]);
                ([low[0].piercing.point, high[0].piercing.point], [a, b, c, d])
            }
            Some([i, j]) => {
                let start = self.faces.corners(self.places[0])[i];
                let from_start = start.dot(self.direction);
                let first = self.crossing(0, (i + 1) % 3, (i + 2) % 3)?;
                let second = self.crossing(1, (j + 1) % 3, (j + 2) % 3)?;
                let (first_way, second_way) = (first.along - from_start, second.along - from_start);
                if (first_way > 0.0) != (second_way > 0.0) {
                    return None;
                }
                let nearer = if first_way.abs() <= second_way.abs() { [first, second] } else { [second, first] };
                // The shared corner is no piercing: both edges there end anyway.
                let [a, b] = at_end(nearer[0], nearer[1]);
                ([start, nearer[0].piercing.point], [a, b, None, None])
            }
        };
        let is_line = overlap && ends[0].distance(ends[1]) > self.shortest;
        Some(FaceCrossing { faces: self.places, ends, is_line, piercings, touching: self.touching })
    }

    /// Returns the points where a face's rim passes the other's plane, the lower place along the common line first.
    fn both_crossings(&self, face: usize) -> Option<(Crossing, Crossing)> {
        let mut crossings = (0..3).filter_map(|corner| self.crossing(face, corner, (corner + 1) % 3));
        let (first, second) = (crossings.next()?, crossings.next()?);
        Some(if first.along <= second.along { (first, second) } else { (second, first) })
    }

    /// Returns the point where the side between two corners of a face passes the other's plane, if it does.
    fn crossing(&self, face: usize, from: usize, to: usize) -> Option<Crossing> {
        let numbers = self.faces.triangles[self.places[face] as usize];
        // Two faces that share the side both get the same point, bit for bit.
        let (from, to) = if numbers[from] < numbers[to] { (from, to) } else { (to, from) };
        let (start, end) = (self.distances[face][from], self.distances[face][to]);
        if (start < 0.0) == (end < 0.0) {
            return None;
        }
        let positions = [numbers[from], numbers[to]].map(|number| self.faces.positions[number as usize]);
        let point = positions[0] + (positions[1] - positions[0]) * (start / (start - end));
        let piercing = Piercing { edge: [numbers[from], numbers[to]], point };
        Some(Crossing { along: point.dot(self.direction), piercing })
    }
}
