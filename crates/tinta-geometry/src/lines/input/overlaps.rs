//! Faces of several materials that overlap in one plane, as a badge on a shield: which of them areas do not show.
//!
//! In: a scene. Out: the faces of each object that lie below others. Of faces that touch, areas show the first. To a driver they are
//! equally near, and rounding would mix them.

use super::layers::overlap;
use crate::bvh::{Box3, BoxTree};
use crate::culling::{DrawnFaces, without};
use crate::mesh::NONE;
use crate::scene::Scene;
use crate::tolerances::CONTACT;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Steps of a unit normal, and of a plane's place in scene radii: planes nearer than one are compared.
const STEPS: f64 = 1e4;

/// Most compared pairs, as a multiple of the faces.
const PAIRS_OF_A_FACE: usize = 100;

/// A face in scene radii around the scene's centre, with its object and material.
struct Face {
    surface: [u32; 2],
    corners: [DVec3; 3],
}

impl Face {
    fn normal(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// A number that other planes rarely have; opposite faces have opposite normals.
    fn plane(&self) -> u64 {
        const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
        let normal = self.normal().normalize_or_zero();
        let steps = normal.extend(normal.dot(self.corners[0])).to_array().map(|value| (value * STEPS).round() as i64);
        let mixed = steps.iter().fold(0, |mixed: u64, step| (mixed ^ *step as u64).wrapping_mul(ODD).rotate_left(29));
        mixed ^ (mixed >> 32)
    }

    /// Whether both lie in one plane, and overlap there.
    fn is_on(&self, other: &Self) -> bool {
        let (large, small) =
            if self.normal().length() > other.normal().length() { (self, other) } else { (other, self) };
        let normal = large.normal().normalize_or_zero();
        let (right, up) = normal.any_orthonormal_pair();
        let flat = |face: &Self| face.corners.map(|corner| DVec2::new(right.dot(corner), up.dot(corner)));
        let [a, b, c] = small.corners;
        let near = a.distance(b).max(b.distance(c)).max(c.distance(a)) * CONTACT;
        let is_near = |corner: &DVec3| normal.dot(*corner - large.corners[0]).abs() < near;
        normal.dot(small.normal()) > 0.0 && small.corners.iter().all(is_near) && overlap(flat(large), flat(small), near)
    }
}

/// Returns for each object its faces that are seen first in their plane and those below them, `None` for an object without such, and
/// where no object has them.
pub fn stacked_faces(scene: &Scene) -> Option<Vec<Option<[Arc<DrawnFaces>; 2]>>> {
    let materials = |number: usize| scene.objects[number].mesh.triangle_materials.as_slice();
    if scene.objects.len() == 1 && materials(0).iter().all(|material| *material == materials(0)[0]) {
        return None;
    }
    let mut faces = Vec::new();
    for (number, object) in scene.objects.iter().enumerate() {
        let place = |it: u32| (object.mesh.positions[it as usize] + object.offset - scene.centre) / scene.radius;
        faces.extend(object.mesh.triangles.iter().enumerate().map(|(face, corners)| Face {
            surface: [number as u32, materials(number).get(face).copied().unwrap_or(NONE)],
            corners: corners.map(place),
        }));
    }
    let is_below = below(&faces);
    let mut begin = 0;
    let lists = scene.objects.iter().map(|object| {
        let arrays = scene.arrays(object);
        let is_below: Vec<bool> = arrays.order.iter().map(|face| is_below[begin + *face as usize]).collect();
        begin += is_below.len();
        let is_first: Vec<bool> = is_below.iter().map(|is_below| !is_below).collect();
        let list = |left_out: &[bool]| Arc::new(without(arrays, left_out, left_out.iter().filter(|it| **it).count()));
        Some([list(&is_below), list(&is_first)]).filter(|[first, _]| first.left_out > 0)
    });
    is_below.contains(&true).then(|| lists.collect())
}

/// Whether each face lies below another.
fn below(faces: &[Face]) -> Vec<bool> {
    // Planes that share a slot by chance are told apart below.
    let mut slots = vec![(None, false); (faces.len() * 4).next_power_of_two()];
    let slot_of: Vec<usize> = faces.iter().map(|face| face.plane() as usize & (slots.len() - 1)).collect();
    for (face, slot) in faces.iter().zip(&slot_of) {
        let (first, has_others) = &mut slots[*slot];
        *has_others |= *first.get_or_insert(face.surface) != face.surface;
    }
    let shared: Vec<usize> = (0..faces.len()).filter(|number| slots[slot_of[*number]].1).collect();
    let around = |number: &usize| {
        let [a, b, c] = faces[*number].corners;
        Box3::new(a.min(b).min(c) - CONTACT, a.max(b).max(c) + CONTACT)
    };
    let (tree, order) = BoxTree::new(&shared.iter().map(around).collect::<Vec<_>>());
    let (mut is_below, mut compared) = (vec![false; faces.len()], 0);
    tree.pairs(|one, other| {
        let [one, other] = [one, other].map(|place| shared[order[place as usize] as usize]);
        compared += 1;
        let is_candidate = slot_of[one] == slot_of[other] && faces[one].surface != faces[other].surface;
        if is_candidate && faces[one].is_on(&faces[other]) {
            is_below[one.max(other)] = true;
        }
        compared > faces.len().saturating_mul(PAIRS_OF_A_FACE)
    });
    is_below
}
