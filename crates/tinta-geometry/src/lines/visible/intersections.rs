//! The lines where faces pass through one another.
//!
//! Pairs of faces come from the tree of faces. A face with an edge in the other's plane only touches the other face. There the
//! *surfaces* decide: they intersect if their half-planes around that edge alternate. No rule depends on a face's winding.

use crate::bvh::{Box3, NO_GROUP, NodeSelection, counting_steps, steps};
use crate::lines::eye::face_pair::{FaceCrossing, FacePlane, Piercing};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::pyramid::Pyramid;
use crate::lines::eye::space::Space;
use crate::lines::input::feature::Own;
use crate::lines::input::line_input::LineInput;
use crate::lines::input::object_edges::ObjectEdges;
use crate::lines::progress::{Phase, Progress};
use crate::lines::sight::{Intersection, Intersections};
use crate::lines::visible::contact::ProbedLine;
use crate::lines::visible::half_planes::{HalfPlanes, SplitEdges};
use crate::lines::visible::nearest_faces::NearestFaces;
use crate::lines::visible::search::Search;
use crate::threads::{cores, filled, in_chunks, spread_chunks, threads_for_items};
use crate::thresholds::THRESHOLDS;
use crate::tolerances::{CONTACT, SAME_PLACE};
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Whether a pyramid hides a line.
fn is_hidden(space: &Space, pyramid: &Pyramid, ends: [DVec3; 2]) -> bool {
    ends.iter().all(|end| -end.z >= space.near) && pyramid.hides_line(ends.map(|end| space.project(end)))
}

/// Returns all intersections of a scene's faces, and the points where edges pierce faces. Unless hidden ones are wanted, leaves out
/// those that the search finds hidden. The list is incomplete if the time runs out.
pub(in crate::lines) fn intersections(
    input: &LineInput<'_>,
    search: &Arc<Search>,
    progress: &Progress,
) -> Arc<Intersections> {
    let found = || found(input, search, progress);
    if input.settings.finds_hidden { Arc::new(found()) } else { input.sight.intersections(search, found) }
}

fn found(input: &LineInput<'_>, search: &Search, progress: &Progress) -> Intersections {
    let LineInput { space, faces, objects, .. } = input;
    let pyramid = search.pyramid.as_ref().filter(|_| !input.settings.finds_hidden);
    let nearest_faces = search.nearest_faces.as_ref().filter(|_| !input.settings.finds_hidden);
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
        let mut face_planes: [Option<FacePlane>; THRESHOLDS.largest_leaf as usize] = Default::default();
        faces.tree.pairs_below(&node_pairs[batches], &wanted, &mut |first, second| {
            pairs = pairs.wrapping_add(1);
            if pairs % PAIRS_A_GLANCE == 0 && progress.is_over() {
                return true;
            }
            if !is_seen(first) || !is_seen(second) {
                return false;
            }
            let face_plane = &mut face_planes[(first % THRESHOLDS.largest_leaf) as usize];
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
    let split = SplitEdges::new(objects);
    let touched = HalfPlanes::at_touched_edges(&split, &all.lines);
    let lines = all.lines.into_iter().filter(|found| touched.pass_through(space, faces, found));
    let lines = lines.map(|found| Intersection { faces: found.faces, ends: found.ends });
    let mut lines: Vec<Intersection> = lines.chain(along_diagonals(faces, objects)).collect();
    lines.sort_by_key(|line| line.faces.map(|face| faces.numbers[face as usize]));
    Intersections {
        lines: without_repeated(space, faces, lines),
        piercings: split.piercings(faces, all.piercings),
        compared,
    }
}

/// The intersections of polygons with surfaces that pass through them along one of their diagonals: there both have an edge in common.
fn along_diagonals(faces: &Faces, objects: &[ObjectEdges]) -> Vec<Intersection> {
    let mut found = Vec::new();
    for object in objects {
        found.extend(object.crossings().map(|(ends, of_faces)| {
            let ends = ends.map(|end| faces.positions[(end + object.first_position) as usize]);
            (of_faces.map(|face| face + object.first_face), ends)
        }));
    }
    if found.is_empty() {
        return Vec::new();
    }
    let place_of: HashMap<u32, u32> = faces.numbers.iter().copied().zip(0..).collect();
    let line = |([a, b], ends): ([u32; 2], [DVec3; 2])| {
        let [first, second] = [place_of.get(&a.min(b))?, place_of.get(&a.max(b))?];
        Some(Intersection { faces: [*first, *second], ends })
    };
    found.into_iter().filter_map(line).collect()
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
    let mut places: HashSet<[[i64; 3]; 2]> = HashSet::new();
    lines.retain(|line| {
        let touching = space.contact(0.0, faces.weld(faces.triangles[line.faces[0] as usize][0]));
        let place = |end: DVec3| (end / (SAME_PLACE * touching)).round().to_array().map(|number| number as i64);
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
