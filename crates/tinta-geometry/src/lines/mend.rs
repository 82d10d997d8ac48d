//! Repairs a mesh before its lines are found.
//!
//! - Of faces with the same three corners, as a surface modelled from both sides has them, only the first is kept: the
//!   others would make every edge one of four faces.
//! - Where a vertex of one open rim lies on an edge of another (a T-junction), the face behind that edge is split there, so
//!   that the two rims become one inner edge and no line is drawn across a surface that looks whole. What hides is the face as
//!   it was: a thousand slivers of it would hide the same, and be in one another's way.
//!
//! Cracks wider than `--weld` stay openings.

use crate::bvh::{Box3, BoxTree};
use crate::edges::{EdgeList, Incidence};
use crate::mesh::{Mesh, NONE};
use crate::tolerances::{CONTACT, WELD};
use glam::DVec3;
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
}

/// The mended mesh, if there was anything to mend.
pub(super) fn mended(mesh: &Arc<Mesh>, edges: &EdgeList) -> Option<Mended> {
    let repeated = repeated_faces(mesh, edges);
    let without = (!repeated.is_empty()).then(|| Arc::new(keep_faces(mesh, |face| !repeated.contains(&face))));
    let split = match &without {
        None => split_at_junctions(mesh, edges),
        Some(mesh) => split_at_junctions(mesh, &EdgeList::new(mesh)),
    };
    let is_mended = without.is_some() || split.is_some();
    let shape = without.unwrap_or_else(|| mesh.clone());
    let (split, whole_faces) = match split {
        Some((split, whole_faces)) => (Arc::new(split), whole_faces),
        None => (shape.clone(), (0..shape.triangles.len() as u32).collect()),
    };
    is_mended.then_some(Mended { shape, split, whole_faces })
}

/// Faces that have the same corners as one of a lower number.
fn repeated_faces(mesh: &Mesh, edges: &EdgeList) -> HashSet<u32> {
    let sorted = |face: u32| {
        let mut corners = mesh.triangles[face as usize];
        corners.sort_unstable();
        corners
    };
    let mut repeated = HashSet::new();
    for edge in 0..edges.len() as u32 {
        let faces = edges.faces(edge);
        if let &[first, second] = faces {
            if first != second && sorted(first) == sorted(second) {
                repeated.insert(second);
            }
            continue;
        }
        let mut by_corners: Vec<([u32; 3], usize)> =
            faces.iter().enumerate().map(|(index, face)| (sorted(*face), index)).collect();
        by_corners.sort_unstable();
        for same in by_corners.chunk_by(|a, b| a.0 == b.0) {
            let first = faces[same[0].1];
            repeated.extend(same.iter().map(|(_, index)| faces[*index]).filter(|face| *face != first));
        }
    }
    repeated
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

/// The mesh with every face split where a vertex of an open rim lies on its own, and of each face the one it was part of;
/// `None` if there is none.
fn split_at_junctions(mesh: &Mesh, edges: &EdgeList) -> Option<(Mesh, Vec<u32>)> {
    let rims: Vec<u32> =
        (0..edges.len() as u32).filter(|edge| edges.incidence()[*edge as usize] == Incidence::Boundary).collect();
    if rims.is_empty() {
        return None;
    }
    let ends = |rim: u32| edges.positions()[rim as usize];
    let position = |index: u32| mesh.positions[index as usize];
    let (low, high) = mesh.bounds();
    let radius = (high - low).length() * 0.5;
    let weld = WELD * 2.0 * radius;
    let scaled = |point: DVec3| (point - (low + high) * 0.5) / radius;
    let (mut boxes, mut rim_of) = (Vec::new(), Vec::new());
    for rim in &rims {
        let [a, b] = ends(*rim).map(|end| scaled(position(end)));
        let margin = DVec3::splat(CONTACT * a.distance(b) + WELD);
        // In parts, so that a long one is not asked for everything in its box.
        let count = (a.distance(b) / LONGEST_PART).ceil().max(1.0);
        for part in 0..count as u32 {
            let [from, to] = [part, part + 1].map(|place| a.lerp(b, f64::from(place) / count));
            boxes.push(Box3::new(from.min(to) - margin, from.max(to) + margin));
            rim_of.push(*rim);
        }
    }
    let (tree, order) = BoxTree::new(&boxes);
    let mut vertices: Vec<u32> = rims.iter().flat_map(|rim| ends(*rim)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    // For each edge the vertices on it, by their place along it.
    let mut junctions: BTreeMap<u32, Vec<(f64, u32)>> = BTreeMap::new();
    for vertex in vertices {
        let point = position(vertex);
        tree.any(&Box3::around([scaled(point)]), |place| {
            let rim = rim_of[order[place as usize] as usize];
            let [a, b] = ends(rim);
            let (start, along) = (position(a), position(b) - position(a));
            let place = (point - start).dot(along) / along.length_squared();
            let distance = (start + along * place).distance(point);
            let length = along.length();
            let from_end = place.min(1.0 - place) * length;
            // So near an end it may as well lie on another rim from there, unless it is exactly on this one. What is nearer
            // still is the end: welding has seen to that.
            let touching = if from_end > CONTACT * length { CONTACT * length } else { weld };
            let is_on_it = distance <= touching && from_end > weld;
            let corners = mesh.triangles[edges.faces(rim)[0] as usize];
            if is_on_it && !corners.contains(&vertex) {
                junctions.entry(rim).or_default().push((place, vertex));
            }
            false
        });
    }
    if junctions.is_empty() {
        return None;
    }
    let mut on_sides: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    let mut touched: HashSet<u32> = HashSet::new();
    for (rim, mut places) in junctions {
        places.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        places.dedup();
        on_sides.insert(ends(rim), places.into_iter().map(|(_, vertex)| vertex).collect());
        touched.extend(edges.faces(rim));
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
    Some((with_faces(mesh, faces), whole_faces))
}

/// Splits a face at the vertices on its sides: into a fan around the corner opposite to its first side with any, and at that
/// side's two ends into fans around the vertices next to them.
fn split(corners: [u32; 3], on_sides: &BTreeMap<[u32; 2], Vec<u32>>, add: &mut impl FnMut([u32; 3])) {
    // From corner to corner with what is between them.
    let between = |side: usize| {
        let (from, to) = (corners[side], corners[(side + 1) % 3]);
        let mut between = on_sides.get(&[from.min(to), from.max(to)]).cloned().unwrap_or_default();
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
