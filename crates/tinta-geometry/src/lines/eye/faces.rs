//! All faces of a scene in the eye's space.

use crate::bvh::{Box3, BoxTree, NO_GROUP};
use crate::lines::eye::planes;
use crate::lines::eye::space::{Space, at_depth};
use crate::mesh::Mesh;
use crate::scene::{Object, Scene};
use crate::threads::{cores, filled, in_chunks, threads_for_items};
use crate::thresholds::THRESHOLDS;
use crate::tolerances::{CONTACT, MARGIN_PX, WELD};
use glam::{DVec2, DVec3};
use std::borrow::Cow;
use std::sync::Arc;

/// Faces and positions of all objects.
///
/// Functions identify a face by its place in the hierarchy's order, where neighbours lie together. Faces outside the picture or
/// the planes have no place.
pub(in crate::lines) struct Faces {
    /// In the eye's space, object by object.
    pub positions: Vec<DVec3>,
    /// Three positions each.
    pub triangles: Vec<[u32; 3]>,
    /// Each face's number in the scene, counted through all objects.
    pub numbers: Vec<u32>,
    /// Places of faces that reach through the near plane, ascending.
    pub cut_by_near: Vec<u32>,
    /// Numbers of faces that are seen edge-on, or may be, ascending.
    pub edge_on: Vec<u32>,
    /// Those of `edge_on` whose direction does not depend on rounding.
    pub edge_on_for_sure: Vec<u32>,
    /// The hierarchy of their boxes of pixels and keys.
    pub tree: BoxTree,
    /// For each place the position that it shares with very many faces, or [`NO_GROUP`]; empty without such positions. The boxes
    /// of these faces all overlap: the tree leaves out their pairs, and callers find the pairs that matter.
    pub high_valence: Vec<u32>,
    /// For each number the plane that it shares with many faces, or [`NO_GROUP`]; empty without such planes.
    pub planes: Vec<u32>,
    /// For each place whether the face hides nothing; empty without such faces.
    ghosts: Vec<bool>,
    objects: Vec<FacesOfObject>,
}

/// The place of an object's faces among those of all objects.
struct FacesOfObject {
    first_position: u32,
    first_face: u32,
    /// The distance below which its positions count as one, file units.
    weld: f64,
}

impl Faces {
    /// Collects the faces of a scene.
    pub(in crate::lines) fn of(space: &Space, scene: &Scene) -> Self {
        let meshes: Vec<_> = scene.objects.iter().map(|object| (object, object.mesh.clone())).collect();
        Self::new(space, &meshes)
    }

    /// Collects the objects' faces; the meshes may be repaired ones.
    pub(in crate::lines) fn new(space: &Space, meshes: &[(&Object, Arc<Mesh>)]) -> Self {
        let mut positions = Vec::with_capacity(meshes.iter().map(|(_, mesh)| mesh.positions.len()).sum());
        let mut objects: Vec<FacesOfObject> = Vec::with_capacity(meshes.len());
        let mut first_face = 0;
        for (object, mesh) in meshes {
            let (low, high) = mesh.bounds();
            let (first_position, weld) = (positions.len() as u32, WELD * (high - low).length());
            objects.push(FacesOfObject { first_position, first_face, weld });
            first_face += mesh.triangles.len() as u32;
            let view = |index: usize| space.view(mesh.positions[index] + object.offset);
            positions.extend(filled(mesh.positions.len(), threads_for_items(mesh.positions.len()), DVec3::ZERO, view));
        }
        let sorted = SortedFaces::of(space, meshes, &objects, &positions);
        let (tree, order) = BoxTree::new(&sorted.boxes);
        let numbers: Vec<u32> = order.iter().map(|index| sorted.numbers[*index as usize]).collect();
        let triangle = |place: usize| {
            let (object, face) = in_object(&objects, numbers[place]);
            meshes[object].1.triangles[face as usize].map(|corner| corner + objects[object].first_position)
        };
        let triangles = filled(numbers.len(), threads_for_items(numbers.len()), [0; 3], triangle);
        let is_cut = |place: &u32| sorted.cut_by_near.binary_search(&numbers[*place as usize]).is_ok();
        let cut_by_near =
            if sorted.cut_by_near.is_empty() { Vec::new() } else { (0..numbers.len() as u32).filter(is_cut).collect() };
        let high_valence = high_valence(&triangles, positions.len(), &cut_by_near);
        let SortedFaces { edge_on, edge_on_for_sure, .. } = sorted;
        let planes = Vec::new();
        let mut faces = Self {
            positions,
            triangles,
            cut_by_near,
            edge_on,
            edge_on_for_sure,
            tree,
            high_valence,
            planes,
            numbers,
            ghosts: Vec::new(),
            objects,
        };
        let limits = (space.size.max_element() * THRESHOLDS.plane_face, faces.smallest_weld());
        faces.planes = planes::planes(
            faces.tree.boxes(),
            |place| faces.corners(place),
            &faces.numbers,
            limits,
            first_face as usize,
        );
        let [planes, vertices] = faces.groups().map(Cow::into_owned);
        faces.tree.set_groups([&planes, &vertices]);
        faces
    }

    /// For each place the plane and the high-valence vertex of the face; a list without groups is empty.
    pub(in crate::lines) fn groups(&self) -> [Cow<'_, [u32]>; 2] {
        let of_places = self.numbers.iter().filter(|_| !self.planes.is_empty()).map(|number| self.plane(*number));
        [Cow::Owned(of_places.collect()), Cow::Borrowed(&self.high_valence)]
    }

    /// Lets faces hide nothing, by their numbers.
    pub(in crate::lines) fn set_ghosts(&mut self, ghosts: &[bool]) {
        self.ghosts = self.numbers.iter().map(|number| ghosts[*number as usize]).collect();
    }

    /// Lets each object's positions count as one up to these distances, too, file units.
    pub(in crate::lines) fn widen_welds(&mut self, distances: impl Iterator<Item = f64>) {
        self.objects.iter_mut().zip(distances).for_each(|(object, distance)| object.weld = object.weld.max(distance));
    }

    /// Whether the face at this place hides nothing.
    pub(in crate::lines) fn is_ghost(&self, face: u32) -> bool {
        self.ghosts.get(face as usize).copied().unwrap_or(false)
    }

    /// Returns the plane that the face with this number shares with many, or [`NO_GROUP`].
    pub(in crate::lines) fn plane(&self, number: u32) -> u32 {
        self.planes.get(number as usize).copied().unwrap_or(NO_GROUP)
    }

    /// The smallest distance below which positions of an object count as one, file units.
    pub(in crate::lines) fn smallest_weld(&self) -> f64 {
        self.objects.iter().map(|object| object.weld).fold(f64::INFINITY, f64::min)
    }

    /// The distance below which positions count as one in the object that has this position, file units.
    pub(in crate::lines) fn weld(&self, position: u32) -> f64 {
        self.objects[self.objects.partition_point(|object| object.first_position <= position) - 1].weld
    }

    /// The object of the face with this number, and the face's number in it.
    pub(in crate::lines) fn in_object(&self, number: u32) -> (usize, u32) {
        in_object(&self.objects, number)
    }

    /// Whether one place's face has a lower number than another's.
    pub(in crate::lines) fn in_order(&self, first: u32, second: u32) -> bool {
        self.numbers[first as usize] < self.numbers[second as usize]
    }

    /// A face's corners in the eye's space.
    pub(in crate::lines) fn corners(&self, face: u32) -> [DVec3; 3] {
        // Not by `map`, which is not inlined here.
        let [a, b, c] = self.triangles[face as usize];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }
}

fn in_object(objects: &[FacesOfObject], number: u32) -> (usize, u32) {
    let object = objects.partition_point(|object| object.first_face <= number) - 1;
    (object, number - objects[object].first_face)
}

/// Faces that a thread sorts at once.
const CHUNK: usize = 8192;

/// Faces sorted by how the eye sees them: in the picture, cut by the near plane, edge-on.
#[derive(Default, Clone)]
struct SortedFaces {
    /// The boxes of faces inside the picture and between the planes, with the faces' numbers.
    boxes: Vec<Box3>,
    numbers: Vec<u32>,
    cut_by_near: Vec<u32>,
    edge_on: Vec<u32>,
    edge_on_for_sure: Vec<u32>,
}

impl SortedFaces {
    /// Sorts the faces of all objects.
    fn of(space: &Space, meshes: &[(&Object, Arc<Mesh>)], objects: &[FacesOfObject], positions: &[DVec3]) -> Self {
        let projected = filled(positions.len(), threads_for_items(positions.len()), (DVec2::ZERO, 0.0), |index| {
            let view: DVec3 = positions[index];
            // Parts that are not in front of the near plane are cut off there first.
            if -view.z >= space.near { space.project(view) } else { (DVec2::NAN, f64::NAN) }
        });
        let mut sorted = SortedFaces::default();
        for ((_, mesh), FacesOfObject { first_position, first_face, .. }) in meshes.iter().zip(objects) {
            let chunks = in_chunks(mesh.triangles.len(), CHUNK, cores(), |range| {
                let mut sorted = SortedFaces::default();
                for face in range {
                    let corners = mesh.triangles[face].map(|corner| corner + first_position);
                    let points = corners.map(|corner| positions[corner as usize]);
                    let images = || corners.map(|corner| projected[corner as usize]);
                    sorted.add(first_face + face as u32, space, points, images);
                }
                sorted
            });
            chunks.into_iter().for_each(|chunk| sorted.append(chunk));
        }
        sorted
    }

    fn append(&mut self, other: Self) {
        self.boxes.extend(other.boxes);
        self.numbers.extend(other.numbers);
        self.cut_by_near.extend(other.cut_by_near);
        self.edge_on.extend(other.edge_on);
        self.edge_on_for_sure.extend(other.edge_on_for_sure);
    }

    fn add(&mut self, number: u32, space: &Space, corners: [DVec3; 3], images: impl Fn() -> [(DVec2, f64); 3]) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let to_eye = space.to_eye(a);
        // Squares of products overflow in scenes of 1e58.
        let height = normal.dot(to_eye).abs();
        let (length, distance) = (normal.length(), to_eye.length());
        let square = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
        let (for_sure, perhaps) = (space.edge_on * length, 4.0 * space.noise * square.sqrt());
        if height <= (for_sure + perhaps) * distance && height <= for_sure.hypot(perhaps) * distance {
            self.edge_on.push(number);
            if height <= for_sure * distance && length > CONTACT * square {
                self.edge_on_for_sure.push(number);
            }
        }
        let depths = corners.map(|corner| -corner.z);
        let (nearest, farthest) = (depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2]));
        if farthest < space.near || nearest > space.far {
            return;
        }
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut widen = |(px, key): (DVec2, f64)| {
            low = low.min(px.extend(key));
            high = high.max(px.extend(key));
        };
        if nearest < space.near {
            for (index, corner) in corners.iter().enumerate() {
                if depths[index] >= space.near {
                    widen(space.project(*corner));
                }
                if let Some(point) = at_depth([*corner, corners[(index + 1) % 3]], space.near) {
                    widen(space.project(point));
                }
            }
            self.cut_by_near.push(number);
        } else {
            images().into_iter().for_each(widen);
        }
        let (low_px, high_px) = (low.truncate(), high.truncate());
        if low_px.cmple(space.size + MARGIN_PX).all() && high_px.cmpge(-DVec2::splat(MARGIN_PX)).all() {
            self.boxes.push(Box3::new(low, high));
            self.numbers.push(number);
        }
    }
}

/// Returns for each face its position with the most faces, if these form a group of [`THRESHOLDS`]; an empty list without such
/// positions. Leaves out faces that the near plane cuts, because the images of their sides are incomplete.
fn high_valence(triangles: &[[u32; 3]], positions: usize, cut_by_near: &[u32]) -> Vec<u32> {
    let mut counts = vec![0u32; positions];
    triangles.as_flattened().iter().for_each(|position| counts[*position as usize] += 1);
    if counts.iter().all(|count| (*count as usize) < THRESHOLDS.group) {
        return Vec::new();
    }
    let vertex = |triangle: &[u32; 3]| {
        let most = triangle.iter().copied().max_by_key(|position| counts[*position as usize]);
        most.filter(|position| counts[*position as usize] as usize >= THRESHOLDS.group).unwrap_or(NO_GROUP)
    };
    let mut high_valence: Vec<u32> = triangles.iter().map(vertex).collect();
    cut_by_near.iter().for_each(|place| high_valence[*place as usize] = NO_GROUP);
    high_valence
}
