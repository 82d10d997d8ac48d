//! Coplanar faces that cover one another, as in models made to be seen from both sides.
//!
//! Input: a mesh and its edges. Output: the faces to remove. Then each region of a plane counts once, whatever the diagonals,
//! first corners and directions of its polygons: only sides of whole polygons are compared.
//!
//! Layers with the same outline cover one another. A layer continues across each stretch of an edge that has exactly
//! one polygon on either side. A region ends at stretches with more polygons on one side than on the other, so all parts of it are
//! covered equally often. Regions covered three times or more come first: there, two layers may have a triangle in common that is
//! no layer. Faces can overlap only if two of them lie on the same side of an edge, or of collinear edges; other meshes need one
//! test per edge.

use crate::disjoint_sets::DisjointSets;
use crate::edges::EdgeList;
use crate::lines::input::coplanar::{Fold, LARGEST_SINE, Planar};
use crate::lines::input::layers::{Side, one_layer};
use crate::lines::input::split_t_junctions::{Chain, vertices_on};
use crate::mesh::Mesh;
use crate::threads::{in_chunks, threads_for};
use crate::tolerances::CONTACT;
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
    for cluster in planar.clusters(edges, &edge_of, &pairs, &links) {
        let mut plane = planar.plane(&cluster);
        while plane.remove_covered(3, is_region)
            || plane.remove_covered(2, is_layer)
            || plane.remove_covered(2, is_region)
        {}
        let kept: HashSet<u32> = plane.polygons.iter().flat_map(|polygon| &polygon.faces).copied().collect();
        covered.extend(cluster.into_iter().filter(|face| !kept.contains(face)));
    }
    covered
}

/// Edges per batch of a thread.
const EDGES_A_THREAD: usize = 8192;

/// At each stretch, the faces to the left minus those to the right.
type Balances = BTreeMap<[u32; 2], i32>;

/// A polygon of the file, without the parts that leave a plane.
struct Polygon {
    faces: Vec<u32>,
    /// The stretches of its outline, without its own diagonals.
    sides: Vec<Side>,
}

/// The polygons of a plane.
struct Plane<'a> {
    planar: &'a Planar<'a>,
    normal: DVec3,
    polygons: Vec<Polygon>,
}

/// The polygons at a stretch of an edge.
#[derive(Default)]
struct AtPiece {
    /// Their indices in the list of the plane's polygons.
    polygons: Vec<u32>,
    /// Polygons to the left of the stretch minus those to the right.
    balance: i32,
}

/// Polygons connected across some stretches of edges.
#[derive(Default)]
struct Region {
    /// Their indices in the list of the plane's polygons.
    polygons: Vec<usize>,
    /// At each stretch, these polygons to the left minus those to the right: 0 inside.
    balances: HashMap<[u32; 2], i32>,
}

fn is_layer(at_piece: &AtPiece) -> bool {
    at_piece.balance == 0 && at_piece.polygons.len() == 2
}

fn is_region(at_piece: &AtPiece) -> bool {
    at_piece.balance == 0
}

impl Planar<'_> {
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

    /// The polygons of a cluster of coplanar faces.
    fn plane(&self, cluster: &[u32]) -> Plane<'_> {
        let largest = cluster.iter().map(|face| self.normal(*face)).max_by(|a, b| a.length().total_cmp(&b.length()));
        let normal = largest.unwrap_or_default();
        let mut polygons: BTreeMap<u32, (Vec<u32>, Balances)> = BTreeMap::new();
        for (face, pieces) in cluster.iter().zip(self.pieces(cluster)) {
            let is_turned = self.normal(*face).dot(normal) < 0.0;
            let (faces, balances) = polygons.entry(self.mesh.file_face(*face)).or_default();
            faces.push(*face);
            for [from, to] in pieces {
                let is_left = (from < to) != is_turned;
                *balances.entry([from.min(to), from.max(to)]).or_default() += if is_left { 1 } else { -1 };
            }
        }
        let polygon = |(faces, balances): (Vec<u32>, Balances)| {
            let sides = balances.into_iter().filter(|(_, balance)| *balance != 0).collect();
            Polygon { faces, sides }
        };
        Plane { planar: self, normal, polygons: polygons.into_values().map(polygon).collect() }
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
        let on_sides = vertices_on(self, &distinct, &vertices);
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

impl Plane<'_> {
    /// Removes regions whose outline another one has, and of regions covered at least so often all but one layer. Returns whether
    /// there were any.
    fn remove_covered(&mut self, least: i32, joins: fn(&AtPiece) -> bool) -> bool {
        let (mut outlines, mut covered) = (HashSet::new(), HashSet::new());
        for Region { polygons, balances } in self.regions(joins) {
            let mut outline: Vec<Side> = balances.into_iter().filter(|(_, side)| *side != 0).collect();
            outline.sort_unstable();
            let times = outline.first().map_or(0, |(_, side)| side.abs());
            if times == 0 || outline.iter().any(|(_, side)| side.abs() != times) {
                continue;
            }
            outline.iter_mut().for_each(|(_, side)| *side = side.signum());
            if !outlines.insert(outline) {
                covered.extend(polygons);
            } else if times >= least {
                covered.extend(self.beyond_one_layer(&polygons));
            }
        }
        let mut numbers = 0..;
        self.polygons.retain(|_| numbers.next().is_some_and(|number| !covered.contains(&number)));
        !covered.is_empty()
    }

    /// The polygons connected across the stretches that join them.
    fn regions(&self, joins: fn(&AtPiece) -> bool) -> Vec<Region> {
        let mut at_pieces: HashMap<[u32; 2], AtPiece> = HashMap::new();
        for (number, polygon) in (0..).zip(&self.polygons) {
            for (piece, side) in &polygon.sides {
                let at_piece = at_pieces.entry(*piece).or_default();
                at_piece.polygons.push(number);
                at_piece.balance += side;
            }
        }
        let mut sets = DisjointSets::new(self.polygons.len());
        for at_piece in at_pieces.values().filter(|at_piece| joins(at_piece)) {
            at_piece.polygons.windows(2).for_each(|pair| sets.join([pair[0], pair[1]]));
        }
        let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
        for (number, polygon) in self.polygons.iter().enumerate() {
            let region = regions.entry(sets.root(number as u32)).or_default();
            region.polygons.push(number);
            polygon.sides.iter().for_each(|(piece, side)| *region.balances.entry(*piece).or_default() += side);
        }
        regions.into_values().collect()
    }

    /// Of polygons that cover a region several times: all except one layer of them; none if no layer is found.
    fn beyond_one_layer(&self, numbers: &[usize]) -> Vec<usize> {
        let (right, up) = self.normal.normalize_or_zero().any_orthonormal_pair();
        let flat = |face: &u32| self.planar.corners(*face).map(|corner| DVec2::new(corner.dot(right), corner.dot(up)));
        let polygons = || numbers.iter().map(|number| &self.polygons[*number]);
        let sides: Vec<&[Side]> = polygons().map(|polygon| polygon.sides.as_slice()).collect();
        let flat = polygons().map(|polygon| polygon.faces.iter().map(flat).collect()).collect();
        match one_layer(&sides, flat, self.planar.weld) {
            Some(kept) => {
                (0..numbers.len()).filter(|index| !kept.contains(index)).map(|index| numbers[index]).collect()
            }
            None => Vec::new(),
        }
    }
}
