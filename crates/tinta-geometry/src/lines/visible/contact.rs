//! Whether faces hide a point of a line, and whether a line touches a face, lies behind it or passes through it.

use crate::bvh::Box3;
use crate::lines::eye::face_pair::FacePlane;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::eye::touch::key_slack;
use crate::lines::input::feature::Own;
use crate::ranges::{above_zero, clipped};
use crate::tolerances::ACROSS;
use glam::{DVec2, DVec3};

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
        let deepest = self.key + key_slack(self.key);
        Box3::new((self.px - tie_px).extend(f64::NEG_INFINITY), (self.px + tie_px).extend(deepest))
    }
}

impl Probe {
    /// Returns whether the point, moved by an arbitrarily small distance to either side of its line, lies in a face's image, whose corners
    /// turn counter-clockwise if `sign` is 1. Within a distance of a side, which `forgiven` returns, the point lies on it, and its way
    /// inwards decides.
    pub(in crate::lines) fn inside(
        &self,
        space: &Space,
        corners: [DVec3; 3],
        sign: f64,
        forgiven: impl Fn(usize) -> f64,
        is_inward: impl Fn(f64, f64) -> bool,
    ) -> [bool; 2] {
        let mut is_inside = [true; 2];
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            let (turn, length) = space.turn(from, to, self.view);
            let forgiven = forgiven(side) * length;
            if sign * turn < -forgiven {
                return [false; 2];
            }
            if sign * turn <= forgiven {
                let inward = sign * space.turn_aside(from, to, self.aside);
                is_inside = [is_inside[0] && is_inward(inward, length), is_inside[1] && is_inward(-inward, length)];
            }
        }
        is_inside
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
        let FacePlane { corners, normal, normal_length, longest, weld, .. } = FacePlane::exact(faces, face);
        let towards_eye = normal.dot(space.to_eye(corners[0]));
        let turn = if towards_eye == 0.0 { 0.0 } else { towards_eye.signum() };
        let touching = space.contact(longest.min(line.length), weld.min(line.weld)) * normal_length;
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

impl Faces {
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
        // A side that meets the line's end may run beside it at any distance: there only rounding is forgiven.
        let forgiven = |side: usize| if is_own[side] || is_own[(side + 1) % 3] { 4.0 * space.noise } else { tie };
        let is_inward = |inward: f64, length: f64| inward >= -ACROSS * length;
        let is_inside = probe.inside(space, corners, contact.turn, forgiven, is_inward);
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
