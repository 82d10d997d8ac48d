//! Coplanar faces that cover one another, as in models made to be seen from both sides.
//!
//! Input: a mesh and its edges. Output: the faces to remove so that each region of a plane counts once. The result
//! does not depend on diagonals, first corners or directions of the triangles.
//!
//! Sheets with the same outline cover one another. A sheet continues across each stretch of an edge that has exactly
//! one face on either side. If shared diagonals join or split sheets, regions are used instead. A region ends at
//! stretches with more faces on one side than on the other, so all parts of it are covered equally often. Faces can
//! overlap only if two of them lie on the same side of an edge, or of collinear edges; other meshes need one test per
//! edge.

use crate::edges::EdgeList;
use crate::lines::input::split_t_junctions::{Chain, vertices_on};
use crate::mesh::Mesh;
use crate::threads::{in_chunks, threads_for};
use crate::tolerances::{CONTACT, PRINTED_DIGITS, WELD};
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, HashMap, HashSet};

/// The covered faces: in each region all except the set with the lowest number. `chains` are the edges that others
/// cover.
pub(in crate::lines) fn covered_faces(mesh: &Mesh, edges: &EdgeList, chains: &[Chain]) -> HashSet<u32> {
    let planar = Planar::new(mesh);
    let at_edges = in_chunks(edges.len(), EDGES_A_THREAD, threads_for(edges.len()), |range| {
        let mut pairs = Vec::new();
        range.for_each(|edge| planar.add_pairs_at(edges, edge as u32, &mut pairs));
        pairs
    });
    let mut pairs = at_edges.concat();
    let links = planar.links(edges, chains);
    pairs.extend(links.iter().filter(|(_, fold)| *fold == Fold::Closed).map(|(pair, _)| pair));
    if pairs.is_empty() {
        return HashSet::new();
    }
    let edge_of: HashMap<[u32; 2], u32> = edges.positions().iter().copied().zip(0..).collect();
    let mut covered = HashSet::new();
    for mut cluster in planar.clusters(edges, &edge_of, &pairs, &links) {
        // A single repeated face splits its sheet until it is removed.
        loop {
            let mut of_cluster = planar.covered_of(&cluster, is_sheet);
            if of_cluster.is_empty() {
                of_cluster = planar.covered_of(&cluster, is_region);
            }
            if of_cluster.is_empty() {
                break;
            }
            cluster.retain(|face| !of_cluster.contains(face));
            covered.extend(of_cluster);
        }
    }
    covered
}

/// A mesh whose faces are tested against one another's planes.
struct Planar<'a> {
    mesh: &'a Mesh,
    /// Distances, in file units: below `weld` positions coincide, below `digits` coordinates with six digits may
    /// deviate from a plane.
    weld: f64,
    digits: f64,
}

/// Edges per batch of a thread.
const EDGES_A_THREAD: usize = 8192;

/// Sine of the largest angle between coplanar faces.
const LARGEST_SINE: f64 = 0.01;

/// The coplanar faces at a stretch of an edge.
#[derive(Default)]
struct AtPiece {
    /// Their indices in the list of the plane's faces.
    faces: Vec<usize>,
    /// Faces to the left of the stretch minus those to the right.
    balance: i32,
}

/// Faces connected across some stretches of edges.
#[derive(Default)]
struct Region {
    /// Their indices in the list of the plane's faces.
    faces: Vec<usize>,
    /// At each stretch, these faces to the left minus those to the right: 0 inside.
    balances: HashMap<[u32; 2], i32>,
}

fn is_sheet(at_piece: &AtPiece) -> bool {
    at_piece.balance == 0 && at_piece.faces.len() == 2
}

fn is_region(at_piece: &AtPiece) -> bool {
    at_piece.balance == 0
}

/// The position of two faces at an edge.
#[derive(Clone, Copy, PartialEq)]
enum Fold {
    /// Coplanar, on the same side of the edge.
    Closed,
    /// Coplanar, on opposite sides of the edge.
    Flat,
    Bent,
}

impl<'a> Planar<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let diagonal = low.distance(high);
        Self { mesh, weld: WELD * diagonal, digits: PRINTED_DIGITS * diagonal }
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.mesh.triangles[face as usize].map(|corner| self.mesh.positions[corner as usize])
    }

    fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a)
    }

    /// The position of two faces at a line between two points; their farthest corners from it decide.
    fn fold(&self, [start, end]: [DVec3; 2], faces: [u32; 2]) -> Fold {
        let along = (end - start).normalize_or_zero();
        let across = |face: u32| {
            let corners = self.corners(face).map(|corner| {
                let from_start = corner - start;
                from_start - along * along.dot(from_start)
            });
            let [a, b, c] = corners;
            let farther = |a: DVec3, b: DVec3| if b.length_squared() > a.length_squared() { b } else { a };
            farther(farther(a, b), c)
        };
        let [first, second] = faces.map(across);
        let (short, long) =
            if first.length_squared() <= second.length_squared() { (first, second) } else { (second, first) };
        let distance = short.cross(long).length() / long.length();
        let longest = start.distance(end).max(short.length());
        let is_in_plane = distance <= CONTACT * longest + self.weld
            || distance <= self.digits && distance <= LARGEST_SINE * short.length();
        match short.dot(long) > 0.0 {
            _ if !is_in_plane => Fold::Bent,
            true => Fold::Closed,
            false => Fold::Flat,
        }
    }

    /// Whether two faces at an edge form an angle below 90 degrees: a quick test that settles most edges.
    fn is_acute(&self, [start, end]: [DVec3; 2], faces: [u32; 2]) -> bool {
        let along = end - start;
        // Two of a face's corners lie on the edge, so the sum is the third corner, shifted along the edge.
        let [first, second] = faces.map(|face| self.corners(face).iter().map(|corner| *corner - start).sum::<DVec3>());
        first.dot(second) * along.length_squared() > first.dot(along) * second.dot(along)
    }

    fn ends(&self, edges: &EdgeList, edge: u32) -> [DVec3; 2] {
        edges.positions()[edge as usize].map(|position| self.mesh.positions[position as usize])
    }

    /// Adds the pairs of coplanar faces on the same side of an edge.
    fn add_pairs_at(&self, edges: &EdgeList, edge: u32, pairs: &mut Vec<[u32; 2]>) {
        let ends = self.ends(edges, edge);
        match *edges.faces(edge) {
            [] | [_] => {}
            [first, second] => {
                if self.is_acute(ends, [first, second]) && self.fold(ends, [first, second]) == Fold::Closed {
                    pairs.push([first, second]);
                }
            }
            ref faces => {
                let [start, end] = ends;
                let Some(along) = (end - start).try_normalize() else { return };
                let (right, up) = along.any_orthonormal_pair();
                let angle = |face: u32| {
                    let middle = self.corners(face).iter().map(|corner| *corner - start).sum::<DVec3>();
                    middle.dot(up).atan2(middle.dot(right))
                };
                let mut round: Vec<(f64, u32)> = faces.iter().map(|face| (angle(*face), *face)).collect();
                round.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                // The last face is the neighbour of the first.
                let next = round.iter().cycle().skip(1);
                for (first, second) in round.iter().zip(next).map(|(first, second)| (first.1, second.1)) {
                    if first != second && self.fold(ends, [first, second]) == Fold::Closed {
                        pairs.push([first, second]);
                    }
                }
            }
        }
    }

    /// Coplanar faces at an edge and at one edge of a chain that covers it.
    fn links(&self, edges: &EdgeList, chains: &[Chain]) -> Vec<([u32; 2], Fold)> {
        let mut links = Vec::new();
        for (long, short) in
            chains.iter().flat_map(|Chain { long, edges }| edges.iter().map(move |short| (long, short)))
        {
            let ends = self.ends(edges, *long);
            let of_both = edges.faces(*long).iter().flat_map(|a| edges.faces(*short).iter().map(move |b| [*a, *b]));
            links.extend(of_both.map(|pair| (pair, self.fold(ends, pair))).filter(|(_, fold)| *fold != Fold::Bent));
        }
        links
    }

    /// The pairs, together with all connected coplanar faces, plane by plane.
    fn clusters(
        &self,
        edges: &EdgeList,
        edge_of: &HashMap<[u32; 2], u32>,
        pairs: &[[u32; 2]],
        links: &[([u32; 2], Fold)],
    ) -> Vec<Vec<u32>> {
        let mut partners: HashMap<u32, Vec<u32>> = HashMap::new();
        for [a, b] in pairs.iter().chain(links.iter().map(|(pair, _)| pair)) {
            partners.entry(*a).or_default().push(*b);
            partners.entry(*b).or_default().push(*a);
        }
        let mut first_faces = pairs.as_flattened().to_vec();
        first_faces.sort_unstable();
        let mut known: HashSet<u32> = HashSet::new();
        let mut clusters = Vec::new();
        for first in &first_faces {
            if !known.insert(*first) {
                continue;
            }
            let normal = self.normal(*first).normalize_or_zero();
            let is_of_plane = |face: u32| {
                let own = self.normal(face);
                let [a, b, c] = self.corners(face);
                let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
                // A face no higher than the contact tolerance has no reliable direction.
                let is_needle = own.length() <= (CONTACT * longest + self.weld) * longest;
                is_needle || own.cross(normal).length() <= LARGEST_SINE * own.length()
            };
            let mut cluster = vec![*first];
            // Each edge is used once, for all its faces in the plane of the first one that arrives there.
            let mut edges_left: HashSet<u32> = HashSet::new();
            let mut next = 0;
            while let Some(face) = cluster.get(next).copied() {
                next += 1;
                let mut more = partners.get(&face).cloned().unwrap_or_default();
                let [a, b, c] = self.mesh.triangles[face as usize];
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    let Some(edge) = edge_of.get(&[from.min(to), from.max(to)]) else { continue };
                    if edges_left.insert(*edge) {
                        let ends = [from, to].map(|end| self.mesh.positions[end as usize]);
                        let others = edges.faces(*edge).iter().copied().filter(|other| *other != face);
                        more.extend(others.filter(|other| self.fold(ends, [face, *other]) != Fold::Bent));
                    }
                }
                more.retain(|other| is_of_plane(*other));
                cluster.extend(more.into_iter().filter(|other| known.insert(*other)));
            }
            cluster.sort_unstable();
            clusters.push(cluster);
        }
        clusters
    }

    /// The faces of a plane that are not needed to cover each connected region once.
    fn covered_of(&self, cluster: &[u32], joins: fn(&AtPiece) -> bool) -> HashSet<u32> {
        let largest = cluster.iter().map(|face| self.normal(*face)).max_by(|a, b| a.length().total_cmp(&b.length()));
        let normal = largest.unwrap_or_default();
        let pieces = self.pieces(cluster);
        // A face to the left of a stretch adds 1, one to the right subtracts 1.
        let mut at_piece: HashMap<[u32; 2], AtPiece> = HashMap::new();
        let mut sides: Vec<Vec<([u32; 2], i32)>> = Vec::with_capacity(cluster.len());
        for (index, face) in cluster.iter().enumerate() {
            let is_turned = self.normal(*face).dot(normal) < 0.0;
            let side = |[from, to]: &[u32; 2]| {
                let is_left = (from < to) != is_turned;
                ([*from.min(to), *from.max(to)], if is_left { 1 } else { -1 })
            };
            let of_face: Vec<_> = pieces[index].iter().map(side).collect();
            for (piece, side) in &of_face {
                let at_piece = at_piece.entry(*piece).or_default();
                at_piece.faces.push(index);
                at_piece.balance += side;
            }
            sides.push(of_face);
        }
        let mut region_of: Vec<usize> = (0..cluster.len()).collect();
        for at_piece in at_piece.values().filter(|at_piece| joins(at_piece)) {
            for pair in at_piece.faces.windows(2) {
                let (a, b) = (root(&mut region_of, pair[0]), root(&mut region_of, pair[1]));
                region_of[a.max(b)] = a.min(b);
            }
        }
        let mut regions: BTreeMap<usize, Region> = BTreeMap::new();
        for (index, of_face) in sides.iter().enumerate() {
            let region = regions.entry(root(&mut region_of, index)).or_default();
            region.faces.push(index);
            of_face.iter().for_each(|(piece, side)| *region.balances.entry(*piece).or_default() += side);
        }
        let (mut outlines, mut covered) = (HashSet::new(), HashSet::new());
        for Region { faces, balances } in regions.into_values() {
            let mut outline: Vec<([u32; 2], i32)> = balances.into_iter().filter(|(_, side)| *side != 0).collect();
            outline.sort_unstable();
            let times = outline.first().map_or(0, |(_, side)| side.abs());
            if times == 0 || outline.iter().any(|(_, side)| side.abs() != times) {
                continue;
            }
            outline.iter_mut().for_each(|(_, side)| *side = side.signum());
            let numbers: Vec<u32> = faces.iter().map(|face| cluster[*face]).collect();
            if !outlines.insert(outline) {
                covered.extend(numbers);
            } else if times > 1 {
                let of_region: Vec<&[([u32; 2], i32)]> = faces.iter().map(|face| sides[*face].as_slice()).collect();
                covered.extend(self.beyond_one_layer(&numbers, &of_region, normal));
            }
        }
        covered
    }

    /// For faces that cover a region several times: all except one layer of them; none if no layer is found.
    fn beyond_one_layer(&self, faces: &[u32], sides: &[&[([u32; 2], i32)]], normal: DVec3) -> Vec<u32> {
        if faces.len() > MOST_IN_LAYERS {
            return Vec::new();
        }
        let (right, up) = normal.normalize_or_zero().any_orthonormal_pair();
        let flat = |face: &u32| self.corners(*face).map(|corner| DVec2::new(corner.dot(right), corner.dot(up)));
        let mut at_piece: HashMap<[u32; 2], Vec<(usize, i32)>> = HashMap::new();
        for (index, of_face) in sides.iter().enumerate() {
            of_face.iter().for_each(|(piece, side)| at_piece.entry(*piece).or_default().push((index, *side)));
        }
        let balance = |piece: &[u32; 2]| at_piece[piece].iter().map(|(_, side)| *side).sum::<i32>();
        let mut rim: Vec<([u32; 2], i32)> = at_piece.keys().map(|piece| (*piece, balance(piece).signum())).collect();
        rim.retain(|(_, side)| *side != 0);
        rim.sort_unstable();
        let flat = faces.iter().map(flat).collect();
        let mut layer =
            Layer { sides, at_piece: &at_piece, flat, weld: self.weld, kept: Vec::new(), tries: MOST_TRIES };
        let is_whole = layer.fill(rim);
        let beyond = (0..faces.len()).filter(|face| !layer.kept.contains(face)).map(|face| faces[face]);
        if is_whole { beyond.collect() } else { Vec::new() }
    }

    /// Each face's sides, cut into stretches at all of the cluster's vertices on them.
    fn pieces(&self, cluster: &[u32]) -> Vec<Vec<[u32; 2]>> {
        let sides = |face: &u32| {
            let [a, b, c] = self.mesh.triangles[*face as usize];
            [[a, b], [b, c], [c, a]]
        };
        let mut distinct: Vec<[u32; 2]> = cluster.iter().flat_map(sides).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        distinct.sort_unstable();
        distinct.dedup();
        let mut vertices = distinct.as_flattened().to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let on_sides = vertices_on(self.mesh, &distinct, &vertices);
        let of_face = |face: &u32| {
            let in_pieces = |[from, to]: [u32; 2]| {
                let mut way = vec![from];
                let between = on_sides.get(&[from.min(to), from.max(to)]).map_or(&[][..], Vec::as_slice);
                match from < to {
                    true => way.extend(between),
                    false => way.extend(between.iter().rev()),
                }
                way.push(to);
                way.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>()
            };
            sides(face).into_iter().flat_map(in_pieces).collect()
        };
        cluster.iter().map(of_face).collect()
    }
}

/// One layer of a region, while it is assembled.
struct Layer<'a> {
    /// For each face its stretches, and its side of each.
    sides: &'a [&'a [([u32; 2], i32)]],
    at_piece: &'a HashMap<[u32; 2], Vec<(usize, i32)>>,
    flat: Vec<[DVec2; 3]>,
    weld: f64,
    kept: Vec<usize>,
    tries: usize,
}

/// Most faces of a region that is split into layers: each is compared with all, recursively.
const MOST_IN_LAYERS: usize = 1000;

/// Most faces tried for one layer.
const MOST_TRIES: usize = 100_000;

impl Layer<'_> {
    /// Adds faces until each of these stretches has one on the given side, and each stretch of the added faces one on
    /// the other side. Adds nothing if such faces do not exist.
    fn fill(&mut self, mut open: Vec<([u32; 2], i32)>) -> bool {
        let has = |layer: &Self, (piece, side): ([u32; 2], i32)| {
            layer.at_piece[&piece].iter().any(|(face, of_face)| *of_face == side && layer.kept.contains(face))
        };
        while let Some(wanted) = open.pop() {
            if has(self, wanted) {
                continue;
            }
            let (piece, side) = wanted;
            for (face, of_face) in &self.at_piece[&piece] {
                let fits = |other: &usize| !overlap(self.flat[*face], self.flat[*other], self.weld);
                if *of_face != side || self.tries == 0 || !self.kept.iter().all(fits) {
                    continue;
                }
                self.tries -= 1;
                let before = self.kept.len();
                self.kept.push(*face);
                let is_inner = |piece: &[u32; 2]| self.at_piece[piece].iter().map(|(_, side)| side).sum::<i32>() == 0;
                let across = self.sides[*face].iter().filter(|(piece, _)| is_inner(piece));
                let more = open.iter().copied().chain(across.map(|(piece, side)| (*piece, -side))).collect();
                if self.fill(more) {
                    return true;
                }
                self.kept.truncate(before);
            }
            return false;
        }
        true
    }
}

/// Whether two coplanar triangles overlap by more than a strip of this width along a side.
fn overlap(first: [DVec2; 3], second: [DVec2; 3], distance: f64) -> bool {
    let is_apart = |one: [DVec2; 3], other: [DVec2; 3]| {
        let turn = (one[1] - one[0]).perp_dot(one[2] - one[0]).signum();
        (0..3).any(|side| {
            let (from, along) = (one[side], one[(side + 1) % 3] - one[side]);
            let inward = along.perp() * turn;
            let margin = (distance + CONTACT * along.length()) * along.length();
            other.iter().all(|corner| inward.dot(*corner - from) <= margin)
        })
    };
    !is_apart(first, second) && !is_apart(second, first)
}

/// The root of an element, among sets stored as lists of parents.
fn root(parents: &mut [usize], mut element: usize) -> usize {
    while parents[element] != element {
        parents[element] = parents[parents[element]];
        element = parents[element];
    }
    element
}
