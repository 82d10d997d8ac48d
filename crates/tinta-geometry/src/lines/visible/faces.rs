//! All faces of a scene in the eye's space, and which of them hide a point.

use crate::bvh::{Box3, BoxTree, NO_GROUP};
use crate::lines::visible::planes;
use crate::lines::visible::space::Space;
use crate::mesh::Mesh;
use crate::scene::Object;
use crate::threads::{cores, filled, in_chunks, threads_for_items};
use crate::tolerances::{ACROSS, CONTACT, WELD};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Faces and positions of all objects.
///
/// A face is spoken of by its place in the hierarchy's order, in which neighbours lie together; faces outside the picture or
/// the planes have none.
pub(in crate::lines) struct Faces {
    /// In the eye's space, object by object.
    pub positions: Vec<DVec3>,
    /// Three positions each.
    pub triangles: Vec<[u32; 3]>,
    /// Each one's number in the scene, counted through all objects.
    pub numbers: Vec<u32>,
    /// Places of those that reach through the near plane, ascending.
    pub cut_by_near: Vec<u32>,
    /// Numbers of those that are seen edge-on, or may be, ascending.
    pub edge_on: Vec<u32>,
    /// Of these, those whose direction is no matter of rounding.
    pub edge_on_for_sure: Vec<u32>,
    /// By their boxes of pixels and keys.
    pub tree: BoxTree,
    /// For each place the position that it shares with very many faces, or [`NO_GROUP`]; empty where there is none. The boxes
    /// of all these overlap, so that the tree leaves their pairs to whoever knows better.
    pub high_valence: Vec<u32>,
    /// For each number the plane that it shares with many faces, or [`NO_GROUP`]; empty where there is none.
    pub planes: Vec<u32>,
    /// Each object's first position and the distance below which its positions count as one, file units.
    welds: Vec<(u32, f64)>,
}

/// A point of a line of which it is asked whether it is hidden.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Probe {
    /// In the eye's space.
    pub view: DVec3,
    pub px: DVec2,
    pub key: f64,
    /// A unit vector across the line's image, parallel to the picture, in the eye's space.
    pub aside: DVec3,
    /// The line's length, file units.
    pub line_length: f64,
    /// The distance below which positions of the line's object count as one, file units.
    pub weld: f64,
    /// The line's ends among the positions, or the two faces it is the intersection of.
    pub own: Own,
    /// The positions in which the line ends, see [`Own::corners`].
    pub own_ends: [u32; 2],
}

/// Stands for a position where a line ends in none.
pub(in crate::lines) const NO_POSITION: u32 = u32::MAX;

/// Stands for a face where a line belongs to none.
pub(in crate::lines) const NO_FACE: u32 = u32::MAX;

/// What a line belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) enum Own {
    /// The edge between two positions.
    Edge([u32; 2]),
    /// The intersection of two faces.
    Faces([u32; 2]),
}

impl Own {
    /// The positions in which the line ends, as far as it ends in some: an intersection of faces with a common corner begins in that.
    pub(in crate::lines) fn corners(self, faces: &Faces) -> [u32; 2] {
        match self {
            Self::Edge(ends) => ends,
            Self::Faces([first, second]) => {
                let [first, second] = [first, second].map(|face| faces.triangles[face as usize]);
                let common = first.into_iter().find(|corner| second.contains(corner) && first != second);
                [common.unwrap_or(NO_POSITION), NO_POSITION]
            }
        }
    }
}

/// Faces around one position from which on they are compared by their outer sides only: below, comparing all costs less.
const HIGH_VALENCE: u32 = 256;

impl Faces {
    /// Puts the objects' faces together; the meshes may be repaired ones.
    pub(in crate::lines) fn new(space: &Space, parts: &[(&Object, Arc<Mesh>)]) -> Self {
        let mut positions = Vec::with_capacity(parts.iter().map(|(_, mesh)| mesh.positions.len()).sum());
        let mut welds = Vec::with_capacity(parts.len());
        for (object, mesh) in parts {
            let (low, high) = mesh.bounds();
            welds.push((positions.len() as u32, WELD * (high - low).length()));
            let view = |index: usize| space.view(mesh.positions[index] + object.offset);
            positions.extend(filled(mesh.positions.len(), threads_for_items(mesh.positions.len()), DVec3::ZERO, view));
        }
        let projected = filled(positions.len(), threads_for_items(positions.len()), (DVec2::ZERO, 0.0), |index| {
            let view: DVec3 = positions[index];
            // What is not in front of the near plane is cut off there first.
            if -view.z >= space.near { space.project(view) } else { (DVec2::NAN, f64::NAN) }
        });
        let mut sorted = SortedFaces::default();
        let mut first_number = 0;
        for ((_, mesh), (first_position, _)) in parts.iter().zip(&welds) {
            let chunks = in_chunks(mesh.triangles.len(), CHUNK, cores(), |range| {
                let mut sorted = SortedFaces::default();
                for face in range {
                    let corners = mesh.triangles[face].map(|corner| corner + first_position);
                    let points = corners.map(|corner| positions[corner as usize]);
                    let images = || corners.map(|corner| projected[corner as usize]);
                    sorted.add((first_number + face) as u32, space, points, images);
                }
                sorted
            });
            chunks.into_iter().for_each(|chunk| sorted.append(chunk));
            first_number += mesh.triangles.len();
        }
        drop(projected);
        let (mut tree, order) = BoxTree::new(&sorted.boxes);
        let numbers: Vec<u32> = order.iter().map(|index| sorted.numbers[*index as usize]).collect();
        let starts: Vec<u32> = parts
            .iter()
            .scan(0, |next, (_, mesh)| Some(std::mem::replace(next, *next + mesh.triangles.len() as u32)))
            .collect();
        let triangle = |number: &u32| {
            let part = starts.partition_point(|start| start <= number) - 1;
            parts[part].1.triangles[(number - starts[part]) as usize].map(|corner| corner + welds[part].0)
        };
        let triangles: Vec<[u32; 3]> = numbers.iter().map(triangle).collect();
        let is_cut = |place: &u32| sorted.cut_by_near.binary_search(&numbers[*place as usize]).is_ok();
        let cut_by_near =
            if sorted.cut_by_near.is_empty() { Vec::new() } else { (0..numbers.len() as u32).filter(is_cut).collect() };
        let high_valence = high_valence(&triangles, positions.len(), &cut_by_near);
        if !high_valence.is_empty() {
            tree.set_high_valence(&high_valence);
        }
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
            welds,
        };
        let limits = (space.size.max_element() / 512.0, faces.smallest_weld());
        faces.planes =
            planes::planes(faces.tree.boxes(), |place| faces.corners(place), &faces.numbers, limits, first_number);
        if !faces.planes.is_empty() {
            let of_places: Vec<u32> = faces.numbers.iter().map(|number| faces.plane(*number)).collect();
            faces.tree.set_planes(&of_places);
        }
        faces
    }

    /// The plane that the face with this number shares with many, or [`NO_GROUP`].
    pub(in crate::lines) fn plane(&self, number: u32) -> u32 {
        self.planes.get(number as usize).copied().unwrap_or(NO_GROUP)
    }

    /// The smallest distance below which positions of an object count as one, file units.
    pub(in crate::lines) fn smallest_weld(&self) -> f64 {
        self.welds.iter().map(|(_, weld)| *weld).fold(f64::INFINITY, f64::min)
    }

    /// The distance below which positions of the object with this one count as one, file units.
    pub(in crate::lines) fn weld(&self, position: u32) -> f64 {
        self.welds[self.welds.partition_point(|(first, _)| *first <= position) - 1].1
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

    /// Whether a line is seen at a point: on one side of it at least, no face hides what is beside it at its own depth.
    /// `any` calls what it is given with each face in a box until that returns true.
    pub(in crate::lines) fn leave_open(
        &self,
        space: &Space,
        probe: &Probe,
        any: impl FnOnce(&Box3, &mut dyn FnMut(u32) -> bool) -> bool,
    ) -> bool {
        let tie_px = space.tie_px(-probe.view.z);
        let column = Box3::new((probe.px - tie_px).extend(f64::NEG_INFINITY), (probe.px + tie_px).extend(probe.key));
        let tie = tie_px / space.px_per_unit(-probe.view.z);
        let mut is_hidden = [false; 2];
        !any(&column, &mut |face| {
            let hidden = self.hides(space, face, probe, tie);
            is_hidden = [is_hidden[0] || hidden[0], is_hidden[1] || hidden[1]];
            is_hidden == [true; 2]
        })
    }

    /// On which sides of a line at a point a face is between it and the eye: the point lies clearly behind the face's plane,
    /// its image, moved to that side by as little as one likes, in the face's, and where the ray passes the face is not nearer
    /// than the near plane. The image lies on the face's rim if it is within `tie` file units of it: then the side decides.
    pub(in crate::lines) fn hides(&self, space: &Space, face: u32, probe: &Probe, tie: f64) -> [bool; 2] {
        const NEITHER: [bool; 2] = [false; 2];
        let numbers = self.triangles[face as usize];
        if matches!(probe.own, Own::Faces(own) if own.contains(&face)) {
            return NEITHER;
        }
        let is_own = numbers.map(|number| probe.own_ends.contains(&number));
        if is_own.iter().filter(|is_own| **is_own).count() == 2 {
            return NEITHER;
        }
        let [a, b, c] = self.corners(face);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let normal = ab.cross(ac);
        let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared()).sqrt();
        let touching = CONTACT * longest.min(probe.line_length) + self.weld(numbers[0]).min(probe.weld);
        // From a corner that both have they part: there touching is a matter of the angle.
        let corner = (0..3).find(|corner| is_own[*corner]).map(|corner| [a, b, c][corner]);
        let share = corner.map_or(1.0, |corner| (probe.view.distance(corner) / probe.line_length).min(1.0));
        let contact = (touching * share + 4.0 * space.noise) * normal.length();
        let above = normal.dot(probe.view - a);
        let towards_eye = match space.is_perspective() {
            true => -normal.dot(a),
            false => normal.z,
        };
        // Behind the plane, and farther from it than what counts as touching.
        if above.abs() <= contact || (above > 0.0) == (towards_eye > 0.0) || towards_eye == 0.0 {
            return NEITHER;
        }
        let corners = [(a, is_own[0]), (b, is_own[1]), (c, is_own[2])];
        let mut is_inside = [true; 2];
        for side in 0..3 {
            let ((from, from_is_own), (to, to_is_own)) = (corners[side], corners[(side + 1) % 3]);
            let (turn, length) = space.turn(from, to, probe.view);
            // Counter-clockwise, seen from the front.
            let sign = if towards_eye > 0.0 { 1.0 } else { -1.0 };
            // A side that meets the line's end may run beside it at any distance: there only rounding is forgiven.
            let forgiven = if from_is_own || to_is_own { 4.0 * space.noise } else { tie } * length;
            if sign * turn < -forgiven {
                return NEITHER;
            }
            if sign * turn <= forgiven {
                let inward = sign * space.turn_aside(from, to, probe.aside);
                is_inside = [is_inside[0] && inward >= -ACROSS * length, is_inside[1] && -inward >= -ACROSS * length];
            }
        }
        let is_beyond_near = || {
            self.cut_by_near.binary_search(&face).is_err() || self.hit_depth(space, [a, normal], probe) >= space.near
        };
        if is_inside != NEITHER && is_beyond_near() { is_inside } else { NEITHER }
    }

    /// The depth at which the ray from the eye to a point passes a plane through a point with a normal.
    pub(in crate::lines) fn hit_depth(&self, space: &Space, [point, normal]: [DVec3; 2], probe: &Probe) -> f64 {
        let to_eye = space.to_eye(probe.view);
        let share = normal.dot(point - probe.view) / normal.dot(to_eye);
        -(probe.view + to_eye * share).z
    }
}

/// Faces looked at by a thread at once.
const CHUNK: usize = 8192;

/// Faces sorted by what matters of them.
#[derive(Default, Clone)]
struct SortedFaces {
    /// Those inside the picture and between the planes, with their numbers.
    boxes: Vec<Box3>,
    numbers: Vec<u32>,
    cut_by_near: Vec<u32>,
    edge_on: Vec<u32>,
    edge_on_for_sure: Vec<u32>,
}

impl SortedFaces {
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
        // No squares of products, which scenes of 1e58 do not hold.
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
                if let Some(point) = near_crossing(space, *corner, corners[(index + 1) % 3]) {
                    widen(space.project(point));
                }
            }
            self.cut_by_near.push(number);
        } else {
            images().into_iter().for_each(widen);
        }
        // Far more than rounding moves an image by.
        const MARGIN: f64 = 1.0;
        if low.x <= space.size.x + MARGIN && low.y <= space.size.y + MARGIN && high.x >= -MARGIN && high.y >= -MARGIN {
            self.boxes.push(Box3::new(low, high));
            self.numbers.push(number);
        }
    }
}

/// For each face the position of it that is the corner of most faces, if these are more than [`HIGH_VALENCE`]; nothing if there is no
/// such position. Faces that the near plane cuts have no image of their own sides and are left out.
fn high_valence(triangles: &[[u32; 3]], positions: usize, cut_by_near: &[u32]) -> Vec<u32> {
    let mut counts = vec![0u32; positions];
    triangles.as_flattened().iter().for_each(|position| counts[*position as usize] += 1);
    if counts.iter().all(|count| *count <= HIGH_VALENCE) {
        return Vec::new();
    }
    let vertex = |triangle: &[u32; 3]| {
        let most = triangle.iter().copied().max_by_key(|position| counts[*position as usize]);
        most.filter(|position| counts[*position as usize] > HIGH_VALENCE).unwrap_or(NO_GROUP)
    };
    let mut high_valence: Vec<u32> = triangles.iter().map(vertex).collect();
    cut_by_near.iter().for_each(|place| high_valence[*place as usize] = NO_GROUP);
    high_valence
}

/// Where the line between two points passes the near plane, if it does.
pub(in crate::lines) fn near_crossing(space: &Space, a: DVec3, b: DVec3) -> Option<DVec3> {
    let (above, below) = (-a.z - space.near, -b.z - space.near);
    if (above >= 0.0) == (below >= 0.0) {
        return None;
    }
    let mut point = a + (b - a) * (above / (above - below));
    point.z = -space.near;
    Some(point)
}
