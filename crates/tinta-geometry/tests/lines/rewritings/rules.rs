//! Ways to rewrite a model without changing its surface.

use super::model::Model;
use crate::support::lines::shuffled;
use crate::support::shapes::{Random, joined, mesh};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use tinta::Mesh;

/// A named rule.
pub struct Rewriting {
    pub name: &'static str,
    pub rewrite: fn(Model, &mut Random) -> Model,
}

pub const REWRITINGS: [Rewriting; 16] = [
    Rewriting { name: "faces turned", rewrite: turn_faces },
    Rewriting { name: "parts inside out", rewrite: turn_parts },
    Rewriting { name: "faces from another corner", rewrite: rotate_faces },
    Rewriting { name: "other diagonals", rewrite: flip_diagonals },
    Rewriting { name: "edges split on one side", rewrite: split_one_side },
    Rewriting { name: "edges split on both sides", rewrite: split_both_sides },
    Rewriting { name: "faces repeated", rewrite: repeat_faces },
    Rewriting { name: "all faces repeated with other diagonals, turned", rewrite: repeat_all },
    Rewriting { name: "vertices split and welded", rewrite: split_and_weld },
    Rewriting { name: "parts as objects", rewrite: parts_as_objects },
    Rewriting { name: "objects as one", rewrite: objects_as_one },
    Rewriting { name: "another order", rewrite: reorder },
    Rewriting { name: "moved with its camera", rewrite: move_rigidly },
    Rewriting { name: "mirrored", rewrite: mirror },
    Rewriting { name: "another size", rewrite: resize },
    Rewriting { name: "polygons repeated with other diagonals", rewrite: repeat_polygons },
];

/// The rule that comes last in a chain: the others know triangles only.
pub const OF_POLYGONS: usize = REWRITINGS.len() - 1;

fn each(mut model: Model, mut change: impl FnMut(&mut Mesh)) -> Model {
    model.meshes.iter_mut().for_each(&mut change);
    model
}

fn turn_faces(model: Model, random: &mut Random) -> Model {
    each(model, |mesh| {
        mesh.triangles.iter_mut().filter(|_| random.number() < 0.5).for_each(|corners| corners.reverse());
    })
}

fn turn_parts(model: Model, random: &mut Random) -> Model {
    each(model, |mesh| {
        let parts = parts(mesh);
        let is_turned: Vec<bool> = (0..mesh.triangles.len()).map(|_| random.number() < 0.5).collect();
        for (corners, part) in mesh.triangles.iter_mut().zip(parts) {
            if is_turned[part] {
                corners.reverse();
            }
        }
    })
}

fn rotate_faces(model: Model, random: &mut Random) -> Model {
    each(model, |mesh| {
        mesh.triangles.iter_mut().for_each(|corners| corners.rotate_left((random.number() * 3.0) as usize));
    })
}

/// The faces of each edge.
pub fn edges(mesh: &Mesh) -> BTreeMap<[u32; 2], Vec<usize>> {
    let mut edges: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (face, [a, b, c]) in mesh.triangles.iter().enumerate() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            edges.entry([*from.min(to), *from.max(to)]).or_default().push(face);
        }
    }
    edges
}

/// The corner of a face that is not on an edge.
fn third(mesh: &Mesh, face: usize, edge: [u32; 2]) -> u32 {
    mesh.triangles[face].into_iter().find(|corner| !edge.contains(corner)).unwrap()
}

/// Whether an edge that other faces have lies along a segment in part.
fn lies_along_others(mesh: &Mesh, [a, b]: [u32; 2]) -> bool {
    let [start, end] = [a, b].map(|corner| mesh.positions[corner as usize]);
    let along = end - start;
    let place = |corner: u32| {
        let from_start = mesh.positions[corner as usize] - start;
        let is_on_line = along.cross(from_start).length() <= 1e-9 * along.length_squared();
        is_on_line.then(|| from_start.dot(along) / along.length_squared())
    };
    edges(mesh).keys().filter(|edge| **edge != [a.min(b), a.max(b)]).any(|[p, q]| {
        let places = place(*p).zip(place(*q));
        places.is_some_and(|(p, q)| p.min(q) < 1.0 - 1e-9 && p.max(q) > 1e-9)
    })
}

/// Flips the diagonals of half of the flat quadrangles. It skips models with repeated faces: mixing triangles of two
/// layers would break both, which never happens in a file of a surface.
fn flip_diagonals(model: Model, random: &mut Random) -> Model {
    if model.has_layers {
        return model;
    }
    each(model, |mesh| {
        let mut is_changed = vec![false; mesh.triangles.len()];
        let old = mesh.clone();
        for (edge, faces) in edges(&old) {
            let &[first, second] = faces.as_slice() else { continue };
            if is_changed[first] || is_changed[second] || random.number() < 0.5 {
                continue;
            }
            let ([a, b], c, d) = (edge, third(&old, first, edge), third(&old, second, edge));
            let point = |corner: u32| old.positions[corner as usize];
            let normal = |x: u32, y: u32, z: u32| (point(y) - point(x)).cross(point(z) - point(x));
            let normals = [normal(a, b, c), normal(b, a, d), normal(a, d, c), normal(b, c, d)];
            let largest = normals.iter().map(|normal| normal.length()).fold(0.0, f64::max);
            let is_flat = normals.iter().all(|other| other.cross(normals[0]).length() <= 1e-14 * largest * largest);
            // The other diagonal must lie well inside.
            let is_convex = normals.iter().all(|other| other.dot(normals[0]) > 0.01 * largest * normals[0].length());
            // An existing edge must not get two more faces, or lose two.
            let is_alone = c != d && !lies_along_others(mesh, [a, b]) && !lies_along_others(mesh, [c, d]);
            let is_new = !edges(mesh).contains_key(&[c.min(d), c.max(d)]);
            if is_flat && is_convex && is_new && is_alone {
                // Each keeps the orientation of the face that it replaces.
                let is_up = |face: usize, [x, y, z]: [u32; 3]| {
                    let corners = old.triangles[face];
                    let of_face = normal(corners[0], corners[1], corners[2]);
                    if normal(x, y, z).dot(of_face) > 0.0 { [x, y, z] } else { [x, z, y] }
                };
                mesh.triangles[first] = is_up(first, [a, d, c]);
                mesh.triangles[second] = is_up(second, [b, c, d]);
                (is_changed[first], is_changed[second]) = (true, true);
            }
        }
    })
}

/// Splits a face at a vertex on one of its edges.
fn split_face(mesh: &mut Mesh, face: usize, edge: [u32; 2], vertex: u32) {
    let corners = mesh.triangles[face];
    let with = |old: u32| corners.map(|corner| if corner == old { vertex } else { corner });
    mesh.triangles[face] = with(edge[0]);
    mesh.triangles.push(with(edge[1]));
}

fn split_edges(
    model: Model,
    random: &mut Random,
    split: impl Fn(&mut Mesh, &mut Random, [u32; 2], &[usize], u32),
) -> Model {
    each(model, |mesh| {
        for _ in 0..1 + mesh.triangles.len() / 10 {
            let edges = edges(mesh);
            let (edge, faces) = edges.iter().nth((random.number() * edges.len() as f64) as usize).unwrap();
            let [a, b] = edge.map(|end| mesh.positions[end as usize]);
            let point = a.lerp(b, 0.1 + 0.8 * random.number());
            let vertex = mesh.positions.len() as u32;
            mesh.positions.push(point);
            mesh.file_vertices.push(vertex);
            split(mesh, random, *edge, faces, vertex);
        }
    })
}

fn split_one_side(model: Model, random: &mut Random) -> Model {
    split_edges(model, random, |mesh, random, edge, faces, vertex| {
        let face = faces[(random.number() * faces.len() as f64) as usize];
        split_face(mesh, face, edge, vertex);
    })
}

fn split_both_sides(model: Model, random: &mut Random) -> Model {
    split_edges(model, random, |mesh, _, edge, faces, vertex| {
        faces.iter().for_each(|face| split_face(mesh, *face, edge, vertex));
    })
}

fn repeat_faces(mut model: Model, random: &mut Random) -> Model {
    model.has_layers = true;
    each(model, |mesh| {
        for face in 0..mesh.triangles.len() {
            if random.number() < 0.3 {
                let mut corners = mesh.triangles[face];
                if random.number() < 0.5 {
                    corners.reverse();
                }
                mesh.triangles.push(corners);
            }
        }
    })
}

fn repeat_all(mut model: Model, random: &mut Random) -> Model {
    let other = flip_diagonals(model.clone(), random);
    model.has_layers = true;
    let mut others = other.meshes.into_iter();
    each(model, |mesh| {
        let other = others.next().unwrap();
        mesh.triangles.extend(other.triangles.into_iter().map(|[a, b, c]| [c, b, a]));
    })
}

/// Writes each polygon up to four times, from any corner, in any direction. It skips models with repeated faces, as
/// `flip_diagonals` does.
fn repeat_polygons(mut model: Model, random: &mut Random) -> Model {
    if std::mem::replace(&mut model.has_layers, true) {
        return model;
    }
    each(model, |mesh| {
        let (most, is_even) = (random.whole(1, 4), random.number() < 0.5);
        let polygons = polygons(mesh);
        (mesh.triangles, mesh.file_faces) = (Vec::new(), Vec::new());
        let mut number = 0;
        for mut corners in polygons {
            for _ in 0..if is_even { most } else { random.whole(1, most) } {
                let count = corners.len();
                corners.rotate_left((random.number() * count as f64) as usize);
                if random.number() < 0.5 {
                    corners.reverse();
                }
                mesh.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
                mesh.file_faces.resize(mesh.triangles.len(), number);
                number += 1;
            }
        }
    })
}

/// A mesh's triangles joined into convex polygons across edges that two flat ones share.
fn polygons(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut polygons: Vec<Vec<u32>> = mesh.triangles.iter().map(|corners| corners.to_vec()).collect();
    let mut polygon_of: Vec<usize> = (0..polygons.len()).collect();
    for (edge, faces) in edges(mesh) {
        let &[first, second] = faces.as_slice() else { continue };
        let (first, second) = (polygon_of[first], polygon_of[second]);
        if first == second {
            continue;
        }
        // From one end of the edge the long way to the other, and back.
        let from = |polygon: usize, start: u32| {
            let mut corners = polygons[polygon].clone();
            let place = corners.iter().position(|corner| *corner == start).unwrap();
            corners.rotate_left(place);
            if edge.contains(&corners[1]) {
                corners[1..].reverse();
            }
            corners
        };
        let (there, back) = (from(first, edge[0]), from(second, edge[1]));
        let joined = [&there[..there.len() - 1], &back[..back.len() - 1]].concat();
        if is_convex(mesh, &joined) {
            polygon_of.iter_mut().filter(|polygon| **polygon == second).for_each(|polygon| *polygon = first);
            polygons[first] = joined;
            polygons[second].clear();
        }
    }
    polygons.retain(|corners| !corners.is_empty());
    polygons
}

/// Whether corners in one plane turn the same way, all by more than rounding.
fn is_convex(mesh: &Mesh, corners: &[u32]) -> bool {
    let point = |corner: u32| mesh.positions[corner as usize];
    let normal = |[a, b, c]: [u32; 3]| (point(b) - point(a)).cross(point(c) - point(a));
    let mut normals = Vec::new();
    for (place, from) in corners.iter().enumerate() {
        let to = corners[(place + 1) % corners.len()];
        let others = corners.iter().filter(|other| *other != from && **other != to);
        normals.extend(others.map(|other| normal([*from, to, *other])));
    }
    let largest = normals.iter().map(|normal| normal.length()).fold(0.0, f64::max);
    let agrees = |other: &DVec3| {
        other.cross(normals[0]).length() <= 1e-14 * largest * largest
            && other.dot(normals[0]) > 0.01 * largest * normals[0].length()
    };
    normals.len() == corners.len() * (corners.len() - 2) && normals.iter().all(agrees)
}

fn split_and_weld(model: Model, random: &mut Random) -> Model {
    each(model, |whole| {
        let corners = whole.triangles.as_flattened().iter().map(|corner| whole.positions[*corner as usize]).collect();
        let faces = (0..whole.triangles.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        let apart = shuffled(&mesh(corners, faces), random);
        // Objects that were joined stay separate.
        let is_welded = joined(std::slice::from_ref(whole)).positions.len() == whole.positions.len();
        if is_welded {
            *whole = joined(&[apart]);
        }
    })
}

/// For each face, the first face that it is connected to by common positions.
fn parts(mesh: &Mesh) -> Vec<usize> {
    let mut first_at: Vec<usize> = (0..mesh.positions.len()).collect();
    fn root(parents: &mut [usize], mut one: usize) -> usize {
        while parents[one] != one {
            parents[one] = parents[parents[one]];
            one = parents[one];
        }
        one
    }
    for [a, b, c] in &mesh.triangles {
        for other in [b, c] {
            let (one, other) = (root(&mut first_at, *a as usize), root(&mut first_at, *other as usize));
            first_at[one.max(other)] = one.min(other);
        }
    }
    let mut first_face: BTreeMap<usize, usize> = BTreeMap::new();
    let part_of = |(face, corners): (usize, &[u32; 3])| {
        *first_face.entry(root(&mut first_at, corners[0] as usize)).or_insert(face)
    };
    mesh.triangles.iter().enumerate().map(part_of).collect()
}

/// Skips open surfaces. Within one mesh, rims that meet at a T-junction are joined, because sheets side by side are
/// one surface; rims of separate objects stay. docs/guide/lines.md states this rule, so the drawing would change.
fn parts_as_objects(mut model: Model, _: &mut Random) -> Model {
    if model.is_open {
        return model;
    }
    let apart = |mesh: &Mesh| -> Vec<Mesh> {
        let parts = parts(mesh);
        let mut numbers = parts.clone();
        numbers.sort_unstable();
        numbers.dedup();
        let of_part = |number: usize| {
            let faces = mesh.triangles.iter().zip(&parts).filter(|(_, part)| **part == number);
            super::model::compact(mesh, faces.map(|(corners, _)| *corners).collect())
        };
        numbers.into_iter().map(of_part).collect()
    };
    model.meshes = model.meshes.iter().flat_map(apart).collect();
    model
}

/// Skips open surfaces, for the same reason.
fn objects_as_one(mut model: Model, _: &mut Random) -> Model {
    if model.is_open {
        return model;
    }
    let mut all = mesh(Vec::new(), Vec::new());
    for one in &model.meshes {
        let first = all.positions.len() as u32;
        all.positions.extend(&one.positions);
        all.triangles.extend(one.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    }
    all.file_vertices = (0..all.positions.len() as u32).collect();
    model.meshes = vec![all];
    model
}

fn reorder(mut model: Model, random: &mut Random) -> Model {
    let turn = (random.number() * model.meshes.len() as f64) as usize;
    model.meshes.rotate_left(turn);
    each(model, |mesh| *mesh = shuffled(mesh, random))
}

fn move_rigidly(model: Model, random: &mut Random) -> Model {
    let turn = DMat3::from_axis_angle(random.direction(), random.number() * 6.0);
    // A few model sizes away, so no coordinate loses more than a digit.
    let reach = model.meshes.iter().map(|mesh| mesh.bounds()).map(|(low, high)| low.distance(high)).fold(0.0, f64::max);
    let shift = random.direction() * 5.0 * reach;
    model.moved(turn, 1.0, shift)
}

fn mirror(model: Model, _: &mut Random) -> Model {
    let mut mirrored = model.moved(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)), 1.0, DVec3::ZERO);
    mirrored.is_mirrored ^= true;
    mirrored
}

fn resize(model: Model, random: &mut Random) -> Model {
    let scale = if random.number() < 0.5 { 1e-6 } else { 1e6 };
    model.moved(DMat3::IDENTITY, scale, DVec3::ZERO)
}
