//! All faces of a scene in the eye's space, and the test for faces that hide a point.

use crate::bvh::{Box3, BoxTree, NO_GROUP};
use crate::lines::visible::planes;
use crate::lines::visible::ranges::{above_zero, clipped};
use crate::lines::visible::space::Space;
use crate::lines::visible::thresholds::THRESHOLDS;
use crate::mesh::Mesh;
use crate::scene::{Object, Scene};
use crate::threads::{cores, filled, in_chunks, threads_for_items};
use crate::tolerances::{ACROSS, CONTACT, WELD};
use glam::{DVec2, DVec3};
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

/// A point of a line, to test whether faces hide it.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Probe {
    /// In the eye's space.
    pub view: DVec3,
    pub px: DVec2,
    pub key: f64,
    /// A unit vector across the line's image, parallel to the picture, in the eye's space.
    pub aside: DVec3,
    pub line: ProbedLine,
}

impl Probe {
    /// The box around the line of sight, up to all that the point may touch.
    pub(in crate::lines) fn column(&self, space: &Space) -> Box3 {
        let tie_px = space.tie_px(-self.view.z);
        let deepest = self.key + self.key.abs() * (2.0 * CONTACT);
        Box3::new((self.px - tie_px).extend(f64::NEG_INFINITY), (self.px + tie_px).extend(deepest))
    }
}

/// A line, to find the faces that hide it.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct ProbedLine {
    /// Its ends among the positions, or the two faces whose intersection it is.
    pub own: Own,
    /// The positions at its ends, see [`Own::corners`].
    pub own_ends: [u32; 2],
    /// Its ends in the eye's space; `None` if the points to test do not lie between them: each point decides on its own then.
    ends: Option<[DVec3; 2]>,
    /// Its length, file units; see [`Own::contact_length`].
    pub length: f64,
    /// The distance below which positions of its object count as one, file units.
    pub weld: f64,
}

impl ProbedLine {
    /// A line between two points in the eye's space.
    pub(in crate::lines) fn new(faces: &Faces, own: Own, ends: [DVec3; 2], weld: f64) -> Self {
        Self { own, own_ends: own.corners(faces), ends: Some(ends), length: own.contact_length(ends), weld }
    }

    /// The same for points beside the line.
    pub(in crate::lines) fn without_ends(self) -> Self {
        Self { ends: None, ..self }
    }

    /// Which corners of a face the line ends in; `None` where the face never hides it: the line belongs to the face, or the face
    /// hides nothing.
    pub(in crate::lines) fn own_corners(&self, faces: &Faces, face: u32) -> Option<[bool; 3]> {
        if faces.is_ghost(face) || matches!(self.own, Own::Faces(own) if own.contains(&face)) {
            return None;
        }
        let [a, b, c] = faces.triangles[face as usize];
        let is_own = |number: u32| number == self.own_ends[0] || number == self.own_ends[1];
        let is_own = [is_own(a), is_own(b), is_own(c)];
        (is_own.iter().filter(|is_own| **is_own).count() != 2).then_some(is_own)
    }
}

/// Whether a line touches a face, which then hides nothing of it, or lies behind it, or passes through it: decided once for both,
/// where the line enters and leaves the face's image.
///
/// A point touches the face if its distance from the plane is below a share of the shorter of the line and the face's longest
/// side, the distance at which positions count as one, and rounding.
pub(in crate::lines) struct Contact {
    corners: [DVec3; 3],
    is_own: [bool; 3],
    /// The face's normal, away from the eye, as long as the product of two sides.
    normal: DVec3,
    /// 1 if the corners turn counter-clockwise in the picture, -1 if clockwise; 0 for a face seen edge-on.
    pub turn: f64,
    /// Multiplied by the normal's length.
    touching: f64,
}

impl Contact {
    pub(in crate::lines) fn new(space: &Space, faces: &Faces, face: u32, line: &ProbedLine, is_own: [bool; 3]) -> Self {
        let corners @ [a, b, c] = faces.corners(face);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let normal = ab.cross(ac);
        let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared()).sqrt();
        let towards_eye = normal.dot(space.to_eye(a));
        let turn = if towards_eye == 0.0 { 0.0 } else { towards_eye.signum() };
        let weld = faces.weld(faces.triangles[face as usize][0]).min(line.weld);
        let touching = (CONTACT * longest.min(line.length) + weld + 4.0 * space.noise) * normal.length();
        Self { corners, is_own, normal: -turn * normal, turn, touching }
    }

    /// How far behind the plane a point lies, multiplied by the normal's length.
    pub(in crate::lines) fn behind(&self, view: DVec3) -> f64 {
        self.normal.dot(view - self.corners[0])
    }

    /// Returns how far behind the plane points of the line must lie for the face to hide them, multiplied by the normal's length:
    /// 0 if the line passes through the face, infinite if it touches the face, and negative infinite if it lies behind.
    pub(in crate::lines) fn hides_from(&self, space: &Space, line: &ProbedLine) -> f64 {
        let Some(ends) = line.ends else { return self.touching };
        let behind = match (0..3).find(|corner| self.is_own[*corner]) {
            // From a common corner on, the angle between both decides, at the line's other end.
            Some(corner) => {
                let distances = ends.map(|end| end.distance_squared(self.corners[corner]));
                let other = if distances[0] > distances[1] { ends[0] } else { ends[1] };
                [self.behind(other); 2]
            }
            None => {
                let behind = ends.map(|end| self.behind(end));
                let is_decided =
                    behind.iter().all(|behind| behind.abs() > self.touching) && (behind[0] > 0.0) == (behind[1] > 0.0);
                match if is_decided { None } else { self.over(space, ends) } {
                    Some(over) => over.map(|share| behind[0] + (behind[1] - behind[0]) * share),
                    None => behind,
                }
            }
        };
        let [is_behind, is_in_front] =
            [1.0, -1.0].map(|side| behind.iter().any(|behind| side * behind > self.touching));
        match (is_behind, is_in_front) {
            (true, false) => f64::NEG_INFINITY,
            (true, true) => 0.0,
            (false, _) => f64::INFINITY,
        }
    }

    /// Returns the shares of the line at which it enters and leaves the face's image; `None` if it lies beside.
    fn over(&self, space: &Space, ends: [DVec3; 2]) -> Option<[f64; 2]> {
        const WHOLE: [f64; 2] = [0.0, 1.0];
        let mut over = above_zero(WHOLE, ends.map(|end| -end.z - space.near));
        let ties = ends.map(|end| space.tie(-end.z));
        for side in 0..3 {
            let (from, to) = (self.corners[side], self.corners[(side + 1) % 3]);
            let inside = [0, 1].map(|end| {
                let (turn, length) = space.turn(from, to, ends[end]);
                self.turn * turn + ties[end] * length
            });
            over = clipped(over, WHOLE, inside);
        }
        over
    }
}

/// Marks an end of a line that is no position.
pub(in crate::lines) const NO_POSITION: u32 = u32::MAX;

/// The edge or the faces that a line belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) enum Own {
    /// The edge between two positions.
    Edge([u32; 2]),
    /// The intersection of two faces.
    Faces([u32; 2]),
    /// None: a curve or a point beside all surfaces, moved towards the eye by [`Space::lifted`]. It touches no face.
    Free,
}

impl Own {
    /// Returns the length that contact with a face is relative to, for a line between two points, file units: none for a free line.
    pub(in crate::lines) fn contact_length(self, ends: [DVec3; 2]) -> f64 {
        if self == Self::Free { 0.0 } else { ends[0].distance(ends[1]) }
    }

    /// Returns the positions at the line's ends, or [`NO_POSITION`]. An intersection of faces with a common corner begins in
    /// that corner.
    pub(in crate::lines) fn corners(self, faces: &Faces) -> [u32; 2] {
        match self {
            Self::Edge(ends) => ends,
            Self::Free => [NO_POSITION; 2],
            Self::Faces([first, second]) => {
                let [first, second] = [first, second].map(|face| faces.triangles[face as usize]);
                let common = first.into_iter().find(|corner| second.contains(corner) && first != second);
                [common.unwrap_or(NO_POSITION), NO_POSITION]
            }
        }
    }
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
        let projected = filled(positions.len(), threads_for_items(positions.len()), (DVec2::ZERO, 0.0), |index| {
            let view: DVec3 = positions[index];
            // Parts that are not in front of the near plane are cut off there first.
            if -view.z >= space.near { space.project(view) } else { (DVec2::NAN, f64::NAN) }
        });
        let mut sorted = SortedFaces::default();
        for ((_, mesh), FacesOfObject { first_position, first_face, .. }) in meshes.iter().zip(&objects) {
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
        drop(projected);
        let (mut tree, order) = BoxTree::new(&sorted.boxes);
        let numbers: Vec<u32> = order.iter().map(|index| sorted.numbers[*index as usize]).collect();
        let triangle = |number: &u32| {
            let (object, face) = in_object(&objects, *number);
            meshes[object].1.triangles[face as usize].map(|corner| corner + objects[object].first_position)
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
            ghosts: Vec::new(),
            objects,
        };
        let limits = (space.size.max_element() / 512.0, faces.smallest_weld());
        faces.planes = planes::planes(
            faces.tree.boxes(),
            |place| faces.corners(place),
            &faces.numbers,
            limits,
            first_face as usize,
        );
        if !faces.planes.is_empty() {
            let of_places: Vec<u32> = faces.numbers.iter().map(|number| faces.plane(*number)).collect();
            faces.tree.set_planes(&of_places);
        }
        faces
    }

    /// Lets faces hide nothing, by their numbers.
    pub(in crate::lines) fn set_ghosts(&mut self, ghosts: &[bool]) {
        self.ghosts = self.numbers.iter().map(|number| ghosts[*number as usize]).collect();
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

    /// Whether a line is visible at a point: on at least one side of it, no face hides the surroundings at the line's own depth.
    /// `any` calls its second argument with each face in a box until that returns true.
    pub(in crate::lines) fn leave_open(
        &self,
        space: &Space,
        probe: &Probe,
        any: impl FnOnce(&Box3, &mut dyn FnMut(u32) -> bool) -> bool,
    ) -> bool {
        let mut is_hidden = [false; 2];
        !any(&probe.column(space), &mut |face| {
            let hidden = self.hides(space, face, probe);
            is_hidden = [is_hidden[0] || hidden[0], is_hidden[1] || hidden[1]];
            is_hidden == [true; 2]
        })
    }

    /// Returns on which sides of a line at a point a face lies between it and the eye. Three conditions hold there. The line lies
    /// behind the face ([`Contact`]). The point's image, moved to that side by an arbitrarily small distance, lies in the face's
    /// image. The ray meets the face no nearer than the near plane. An image within [`Space::tie`] of the face's rim lies on the
    /// rim: then the side decides.
    pub(in crate::lines) fn hides(&self, space: &Space, face: u32, probe: &Probe) -> [bool; 2] {
        const NEITHER: [bool; 2] = [false; 2];
        let Some(is_own) = probe.line.own_corners(self, face) else { return NEITHER };
        let contact = Contact::new(space, self, face, &probe.line, is_own);
        let behind = contact.behind(probe.view);
        if contact.turn == 0.0 || behind < -contact.touching {
            return NEITHER;
        }
        let (corners, tie) = (contact.corners, space.tie(-probe.view.z));
        let mut is_inside = [true; 2];
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            let (turn, length) = space.turn(from, to, probe.view);
            // A side that meets the line's end may run beside it at any distance: there only rounding is forgiven.
            let forgiven = if is_own[side] || is_own[(side + 1) % 3] { 4.0 * space.noise } else { tie } * length;
            if contact.turn * turn < -forgiven {
                return NEITHER;
            }
            if contact.turn * turn <= forgiven {
                let inward = contact.turn * space.turn_aside(from, to, probe.aside);
                is_inside = [is_inside[0] && inward >= -ACROSS * length, is_inside[1] && -inward >= -ACROSS * length];
            }
        }
        if is_inside == NEITHER || behind <= contact.hides_from(space, &probe.line) {
            return NEITHER;
        }
        let is_beyond_near = self.cut_by_near.binary_search(&face).is_err()
            || self.hit_depth(space, [corners[0], contact.normal], probe) >= space.near;
        if is_beyond_near { is_inside } else { NEITHER }
    }

    /// Returns the depth at which the ray from the eye to a point passes a plane, given by a point and a normal.
    pub(in crate::lines) fn hit_depth(&self, space: &Space, [point, normal]: [DVec3; 2], probe: &Probe) -> f64 {
        let to_eye = space.to_eye(probe.view);
        let share = normal.dot(point - probe.view) / normal.dot(to_eye);
        -(probe.view + to_eye * share).z
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

/// Returns the point where the line between two points passes the near plane, if it does.
pub(in crate::lines) fn near_crossing(space: &Space, a: DVec3, b: DVec3) -> Option<DVec3> {
    let (above, below) = (-a.z - space.near, -b.z - space.near);
    if (above >= 0.0) == (below >= 0.0) {
        return None;
    }
    let mut point = a + (b - a) * (above / (above - below));
    point.z = -space.near;
    Some(point)
}
