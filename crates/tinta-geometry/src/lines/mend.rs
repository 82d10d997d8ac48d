//! Repairs a mesh before its lines are found.
//!
//! - Of faces that [cover one another](super::covered), as a surface modelled from both sides has them, one set is kept: the others
//!   would make every edge one of four faces.
//! - Faces no higher than what is welded are left out where they lie at others: they are lines.
//! - Where a vertex of an open rim lies on another edge (a T-junction), the faces at that edge are split there, so that both become
//!   one edge and no line is drawn across a surface that looks whole. What hides is the face as it was: a thousand slivers of it
//!   would hide the same, and be in one another's way.
//!
//! Cracks wider than `--weld` stay openings.

use super::covered::covered_faces;
use crate::bvh::{Box3, BoxTree};
use crate::edges::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::threads::{in_chunks, threads_for};
use crate::tolerances::{CONTACT, WELD};
use glam::DVec3;
use std::borrow::Cow;
use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

/// What was mended of a mesh.
pub(super) struct Mended {
    /// The faces that hide: without repeated ones.
    pub shape: Arc<Mesh>,
    /// The mesh that edges are found on: faces with vertices on their sides are split there.
    pub split: Arc<Mesh>,
    /// Of each of its faces the one of the shape that it is a part of.
    pub whole_faces: Vec<u32>,
    /// The vertices on each edge that was split, in their order along it.
    pub on_edges: BTreeMap<[u32; 2], Vec<u32>>,
    /// How many faces others cover, which were left out.
    pub covered: usize,
}

/// The mended mesh, if there was anything to mend.
pub(super) fn mended(mesh: &Arc<Mesh>, edges: &EdgeList) -> Option<Mended> {
    let lines = faces_without_height(mesh, edges);
    let mut shape = Repaired { mesh: mesh.clone(), edges: Cow::Borrowed(edges) };
    shape.leave_out(&lines);
    let mut along_rims = edges_along_rims(&shape.mesh, &shape.edges);
    let covered = covered_faces(&shape.mesh, &shape.edges, &along_rims);
    shape.leave_out(&covered);
    if !covered.is_empty() {
        along_rims = edges_along_rims(&shape.mesh, &shape.edges);
    }
    let split = split_at_junctions(&shape.mesh, &shape.edges, &along_rims);
    let is_mended = !lines.is_empty() || !covered.is_empty() || split.is_some();
    let shape = shape.mesh;
    let covered = covered.len();
    is_mended.then(|| match split {
        Some(Split { mesh, whole_faces, on_edges }) => {
            Mended { shape, split: Arc::new(mesh), whole_faces, on_edges, covered }
        }
        None => {
            let whole_faces = (0..shape.triangles.len() as u32).collect();
            Mended { split: shape.clone(), shape, whole_faces, on_edges: BTreeMap::new(), covered }
        }
    })
}

/// A mesh with some of its faces left out, and its edges.
struct Repaired<'a> {
    mesh: Arc<Mesh>,
    edges: Cow<'a, EdgeList>,
}

impl Repaired<'_> {
    fn leave_out(&mut self, faces: &HashSet<u32>) {
        if !faces.is_empty() {
            self.mesh = Arc::new(keep_faces(&self.mesh, |face| !faces.contains(&face)));
            self.edges = Cow::Owned(EdgeList::new(&self.mesh));
        }
    }
}

/// Faces whose third corner lies on the side between the other two, as well as welding tells places apart, and that share a side
/// with one that has a height. Others are wires, and drawn.
fn faces_without_height(mesh: &Mesh, edges: &EdgeList) -> HashSet<u32> {
    let (low, high) = mesh.bounds();
    let weld = WELD * low.distance(high);
    let has_height = |face: u32| {
        let [a, b, c] = mesh.triangles[face as usize].map(|corner| mesh.positions[corner as usize]);
        let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared()).sqrt();
        (b - a).cross(c - a).length() > weld * longest
    };
    let found = in_chunks(mesh.triangles.len(), FACES_A_THREAD, threads_for(mesh.triangles.len()), |faces| {
        faces.map(|face| face as u32).filter(|face| !has_height(*face)).collect::<Vec<u32>>()
    });
    let found = found.concat();
    if found.is_empty() {
        return HashSet::new();
    }
    let at_surfaces = (0..edges.len() as u32).map(|edge| edges.faces(edge));
    let at_surfaces: HashSet<u32> =
        at_surfaces.filter(|faces| faces.iter().any(|face| has_height(*face))).flatten().copied().collect();
    found.into_iter().filter(|face| at_surfaces.contains(face)).collect()
}

/// Faces a thread looks at at once.
const FACES_A_THREAD: usize = 8192;

/// How much the directions of edges on one line may differ.
const SAME_DIRECTION: f64 = 1e-4;

/// Edges that a chain of shorter ones covers from end to end, each with one of that chain: pairs where the one edge is a rim or all of the
/// chain are. Solids that merely touch along parts of their edges are not such a pair.
fn edges_along_rims(mesh: &Mesh, edges: &EdgeList) -> Vec<[u32; 2]> {
    let mut is_asked = vec![false; mesh.positions.len()];
    let rims = (0..edges.len()).filter(|edge| edges.incidence()[*edge] == Incidence::Boundary);
    rims.for_each(|rim| edges.positions()[rim].iter().for_each(|end| is_asked[*end as usize] = true));
    loop {
        let leaving = Leaving::new(mesh, edges, |position| is_asked[position as usize]);
        let pairs = leaving.along_one_another();
        let ends = pairs.iter().flatten().flat_map(|edge| edges.positions()[*edge as usize]);
        let new: Vec<u32> = ends.filter(|end| !is_asked[*end as usize]).collect();
        if new.is_empty() {
            return pairs.into_iter().filter(|pair| leaving.is_covered(*pair)).collect();
        }
        new.into_iter().for_each(|end| is_asked[end as usize] = true);
    }
}

/// Edges as they leave some positions, those of one position by their directions.
struct Leaving<'a> {
    edges: &'a EdgeList,
    ways: Vec<Way>,
}

/// An edge as it leaves one of its ends.
#[derive(Clone, Copy)]
struct Way {
    from: u32,
    to: u32,
    edge: u32,
    direction: DVec3,
    length: f64,
    /// The direction's part along one that no grid is aligned with.
    skewed: f64,
}

impl Way {
    fn is_along(&self, other: &Self) -> bool {
        self.direction.dot(other.direction) > 0.0 && self.direction.cross(other.direction).length() <= SAME_DIRECTION
    }
}

impl<'a> Leaving<'a> {
    fn new(mesh: &Mesh, edges: &'a EdgeList, is_asked: impl Fn(u32) -> bool) -> Self {
        let skew = DVec3::new(0.453_5, 0.711_7, 0.536_3);
        let mut ways = Vec::new();
        for (edge, [low, high]) in (0..).zip(edges.positions()) {
            for (from, to) in [(*low, *high), (*high, *low)].into_iter().filter(|(from, _)| is_asked(*from)) {
                let along = mesh.positions[to as usize] - mesh.positions[from as usize];
                let direction = along.normalize_or_zero();
                ways.push(Way { from, to, edge, direction, length: along.length(), skewed: direction.dot(skew) });
            }
        }
        let order =
            |a: &Way, b: &Way| a.from.cmp(&b.from).then(a.skewed.total_cmp(&b.skewed)).then(a.edge.cmp(&b.edge));
        ways.sort_unstable_by(order);
        Self { edges, ways }
    }

    fn is_rim(&self, edge: u32) -> bool {
        self.edges.incidence()[edge as usize] == Incidence::Boundary
    }

    /// Pairs of edges, one of which at least is a rim, that leave a position in one direction.
    fn along_one_another(&self) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        for (index, way) in self.ways.iter().enumerate() {
            let near = self.ways[index + 1..]
                .iter()
                .take_while(|other| other.from == way.from && other.skewed - way.skewed <= SAME_DIRECTION)
                .filter(|other| (self.is_rim(way.edge) || self.is_rim(other.edge)) && way.is_along(other));
            pairs.extend(
                near.map(
                    |other| if way.length > other.length { [way.edge, other.edge] } else { [other.edge, way.edge] },
                ),
            );
        }
        pairs
    }

    /// Whether a chain that begins with the second edge covers the first, and one of both consists of rims.
    fn is_covered(&self, [long, short]: [u32; 2]) -> bool {
        let from = self.edges.positions()[long as usize];
        let common = from.into_iter().find(|end| self.edges.positions()[short as usize].contains(end));
        let leaving = |position: u32| {
            let start = self.ways.partition_point(|way| way.from < position);
            self.ways[start..].iter().take_while(move |way| way.from == position)
        };
        let of = |edge: u32| leaving(common.unwrap_or(u32::MAX)).find(|way| way.edge == edge);
        let (Some(long_way), Some(mut last)) = (of(long), of(short)) else { return false };
        let (mut are_rims, mut covered) = (self.is_rim(short), last.length);
        while last.to != long_way.to {
            let left = long_way.length - covered;
            let next = leaving(last.to)
                .filter(|way| way.is_along(long_way) && way.length <= left * (1.0 + SAME_DIRECTION))
                .min_by(|a, b| a.length.total_cmp(&b.length));
            let Some(next) = next else { return false };
            are_rims &= self.is_rim(next.edge);
            covered += next.length;
            last = next;
        }
        are_rims || self.is_rim(long)
    }
}

/// The mesh with some of its faces.
fn keep_faces(mesh: &Mesh, keep: impl Fn(u32) -> bool) -> Mesh {
    let kept: Vec<usize> = (0..mesh.triangles.len()).filter(|face| keep(*face as u32)).collect();
    with_faces(mesh, kept.iter().map(|face| (*face, mesh.triangles[*face])).collect())
}

/// The mesh with these faces, each with the number of the one whose normals, texture and material it has; corners that one
/// does not have get none.
fn with_faces(mesh: &Mesh, faces: Vec<(usize, [u32; 3])>) -> Mesh {
    let of_corners = |list: &[[u32; 3]]| -> Vec<[u32; 3]> {
        let of_face = |(face, corners): &(usize, [u32; 3])| {
            let values = list.get(*face)?;
            let place = |corner: &u32| mesh.triangles[*face].iter().position(|old| old == corner);
            Some(corners.map(|corner| place(&corner).map_or(NONE, |place| values[place])))
        };
        faces.iter().filter_map(of_face).collect()
    };
    Mesh {
        triangle_normals: of_corners(&mesh.triangle_normals),
        triangle_texture_coordinates: of_corners(&mesh.triangle_texture_coordinates),
        triangle_materials: faces.iter().filter_map(|(face, _)| mesh.triangle_materials.get(*face).copied()).collect(),
        triangles: faces.into_iter().map(|(_, corners)| corners).collect(),
        ..mesh.clone()
    }
}

/// Length of the parts in which rims are looked for, the mesh's radii.
const LONGEST_PART: f64 = 0.1;

/// A mesh whose faces were split.
struct Split {
    mesh: Mesh,
    /// Of each face the one it was part of.
    whole_faces: Vec<u32>,
    /// The vertices on each edge that was split.
    on_edges: BTreeMap<[u32; 2], Vec<u32>>,
}

/// The mesh with every face split where a vertex of an open rim, or of an edge along one, lies on its own side; `None` if there is
/// none.
fn split_at_junctions(mesh: &Mesh, edges: &EdgeList, along_rims: &[[u32; 2]]) -> Option<Split> {
    let is_rim = |edge: &u32| edges.incidence()[*edge as usize] == Incidence::Boundary;
    let mut asked: Vec<u32> = (0..edges.len() as u32).filter(is_rim).collect();
    if asked.is_empty() {
        return None;
    }
    asked.extend(along_rims.as_flattened());
    asked.sort_unstable();
    asked.dedup();
    let ends: Vec<[u32; 2]> = asked.iter().map(|edge| edges.positions()[*edge as usize]).collect();
    let mut vertices = ends.as_flattened().to_vec();
    vertices.sort_unstable();
    vertices.dedup();
    let on_sides = vertices_on(mesh, &ends, &vertices);
    let mut touched: HashSet<u32> = HashSet::new();
    for (edge, ends) in asked.iter().zip(&ends) {
        let Some(on_side) = on_sides.get(ends) else { continue };
        let is_split = |face: &&u32| on_side.iter().any(|vertex| !mesh.triangles[**face as usize].contains(vertex));
        touched.extend(edges.faces(*edge).iter().filter(is_split));
    }
    if touched.is_empty() {
        return None;
    }
    let mut faces = Vec::with_capacity(mesh.triangles.len() + on_sides.len());
    for (face, corners) in mesh.triangles.iter().enumerate() {
        if touched.contains(&(face as u32)) {
            split(*corners, &on_sides, &mut |corners| faces.push((face, corners)));
        } else {
            faces.push((face, *corners));
        }
    }
    let whole_faces = faces.iter().map(|(face, _)| *face as u32).collect();
    Some(Split { mesh: with_faces(mesh, faces), whole_faces, on_edges: on_sides })
}

/// For each edge, the lower position first, the vertices that lie on it, in their order along it; edges without any have no entry.
pub(super) fn vertices_on(mesh: &Mesh, edges: &[[u32; 2]], vertices: &[u32]) -> BTreeMap<[u32; 2], Vec<u32>> {
    let position = |index: u32| mesh.positions[index as usize];
    let (low, high) = mesh.bounds();
    let radius = (high - low).length() * 0.5;
    let weld = WELD * 2.0 * radius;
    let scaled = |point: DVec3| (point - (low + high) * 0.5) / radius;
    let (mut boxes, mut edge_of) = (Vec::new(), Vec::new());
    for (edge, ends) in edges.iter().enumerate() {
        let [a, b] = ends.map(|end| scaled(position(end)));
        let margin = DVec3::splat(CONTACT * a.distance(b) + WELD);
        // In parts, so that a long one is not asked for everything in its box.
        let count = (a.distance(b) / LONGEST_PART).ceil().max(1.0);
        for part in 0..count as u32 {
            let [from, to] = [part, part + 1].map(|place| a.lerp(b, f64::from(place) / count));
            boxes.push(Box3::new(from.min(to) - margin, from.max(to) + margin));
            edge_of.push(edge);
        }
    }
    let (tree, order) = BoxTree::new(&boxes);
    let mut places: BTreeMap<[u32; 2], Vec<(f64, u32)>> = BTreeMap::new();
    for vertex in vertices {
        let point = position(*vertex);
        tree.any(&Box3::around([scaled(point)]), |place| {
            let ends = edges[edge_of[order[place as usize] as usize]];
            let (start, along) = (position(ends[0]), position(ends[1]) - position(ends[0]));
            let place = (point - start).dot(along) / along.length_squared();
            let distance = (start + along * place).distance(point);
            let length = along.length();
            let from_end = place.min(1.0 - place) * length;
            // So near an end it may as well lie on another edge from there, unless it is exactly on this one. What is nearer
            // still is the end: welding has seen to that.
            let touching = if from_end > CONTACT * length { CONTACT * length } else { weld };
            if distance <= touching && from_end > weld {
                places.entry(ends).or_default().push((place, *vertex));
            }
            false
        });
    }
    let in_order = |mut places: Vec<(f64, u32)>| {
        places.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        places.dedup();
        places.into_iter().map(|(_, vertex)| vertex).collect()
    };
    places.into_iter().map(|(ends, places)| (ends, in_order(places))).collect()
}

/// Splits a face at the vertices on its sides: into a fan around the corner opposite to its first side with any, and at that
/// side's two ends into fans around the vertices next to them.
fn split(corners: [u32; 3], on_sides: &BTreeMap<[u32; 2], Vec<u32>>, add: &mut impl FnMut([u32; 3])) {
    // From corner to corner with what is between them.
    let between = |side: usize| {
        let (from, to) = (corners[side], corners[(side + 1) % 3]);
        let mut between = on_sides.get(&[from.min(to), from.max(to)]).cloned().unwrap_or_default();
        between.retain(|vertex| !corners.contains(vertex));
        if from > to {
            between.reverse();
        }
        between
    };
    let sides: [Vec<u32>; 3] = std::array::from_fn(between);
    let Some(first) = sides.iter().position(|side| !side.is_empty()) else { return add(corners) };
    let [a, b, c] = [0, 1, 2].map(|step| corners[(first + step) % 3]);
    let [on_ab, on_bc, on_ca] = [0, 1, 2].map(|step| sides[(first + step) % 3].as_slice());
    let (nearest_a, nearest_b) = (on_ab[0], on_ab[on_ab.len() - 1]);
    fan(nearest_a, &[&[c], on_ca, &[a]].concat(), add);
    fan(c, on_ab, add);
    fan(nearest_b, &[&[b], on_bc, &[c]].concat(), add);
}

/// A triangle around an apex for each two neighbours on a way.
fn fan(apex: u32, way: &[u32], add: &mut impl FnMut([u32; 3])) {
    way.windows(2).for_each(|pair| add([apex, pair[0], pair[1]]));
}
