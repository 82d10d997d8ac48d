//! All faces of a scene in the eye's space, and which of them hide a point.

use super::boxes::{Box3, BoxTree};
use super::space::Space;
use crate::mesh::Mesh;
use crate::scene::Object;
use crate::threads::{cores, filled};
use crate::tolerances::CONTACT;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Faces and positions of all objects, numbered through.
pub(super) struct Faces {
    /// In the eye's space.
    pub positions: Vec<DVec3>,
    /// Three positions each.
    pub triangles: Vec<[u32; 3]>,
    /// Which of them reach through the near plane.
    pub cut_by_near: Vec<u32>,
    /// Those with a part inside the picture, between the planes, by their boxes of pixels and keys.
    pub tree: BoxTree,
}

/// A point of a line of which it is asked whether it is hidden.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    /// In the eye's space.
    pub view: DVec3,
    pub px: DVec2,
    pub key: f64,
    /// The line's length, file units.
    pub line_length: f64,
    /// The line's ends among the positions, or the two faces it is the intersection of.
    pub own: Own,
}

/// What a line belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Own {
    /// The edge between two positions.
    Edge([u32; 2]),
    /// The intersection of two faces.
    Faces([u32; 2]),
}

impl Faces {
    /// Puts the objects' faces together; the meshes may be mended ones.
    pub fn new(space: &Space, parts: &[(&Object, Arc<Mesh>)]) -> Self {
        let threads = cores();
        let mut positions = Vec::with_capacity(parts.iter().map(|(_, mesh)| mesh.positions.len()).sum());
        let mut triangles = Vec::with_capacity(parts.iter().map(|(_, mesh)| mesh.triangles.len()).sum());
        for (object, mesh) in parts {
            let base = positions.len() as u32;
            let view = |index: usize| space.view(mesh.positions[index] + object.offset);
            positions.extend(filled(mesh.positions.len(), worth(threads, mesh.positions.len()), DVec3::ZERO, view));
            triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|corner| corner + base)));
        }
        let projected = filled(positions.len(), worth(threads, positions.len()), (DVec2::ZERO, 0.0), |index| {
            let view: DVec3 = positions[index];
            // What is not in front of the near plane is cut off there first, below.
            if -view.z >= space.near { space.project(view) } else { (DVec2::NAN, f64::NAN) }
        });
        let whole = Box3::around([DVec3::ZERO, DVec3::ZERO]);
        let boxes = filled(triangles.len(), worth(threads, triangles.len()), (whole, Reach::None), |face| {
            let corners: [u32; 3] = triangles[face];
            face_box(space, corners.map(|corner| positions[corner as usize]), || {
                corners.map(|corner| projected[corner as usize])
            })
        });
        let cut_by_near = (0..triangles.len() as u32).filter(|face| boxes[*face as usize].1 == Reach::ThroughNear);
        let cut_by_near = cut_by_near.collect();
        let (kept, numbers) = boxes
            .iter()
            .enumerate()
            .filter(|(_, (_, reach))| *reach != Reach::None)
            .map(|(number, (around, _))| (*around, number as u32))
            .unzip();
        Self { tree: BoxTree::new(kept, numbers), positions, triangles, cut_by_near }
    }

    /// A face's corners in the eye's space.
    pub fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|corner| self.positions[corner as usize])
    }

    /// Whether the eye lies so nearly in a face's plane that the sine of the angle is below a bound.
    pub fn is_edge_on(&self, space: &Space, face: usize, sine: f64) -> bool {
        let [a, b, c] = self.corners(face as u32);
        let normal = (b - a).cross(c - a);
        let to_eye = space.to_eye(a);
        normal.dot(to_eye).abs() <= sine * normal.length() * to_eye.length()
    }

    /// Whether any face hides a point.
    pub fn hide(&self, space: &Space, probe: &Probe) -> bool {
        let tie_px = space.tie_px(-probe.view.z);
        let column = Box3::new((probe.px - tie_px).extend(f64::NEG_INFINITY), (probe.px + tie_px).extend(probe.key));
        let tie = tie_px / space.px_per_unit(-probe.view.z);
        self.tree.any(&column, |face| self.hides(space, face, probe, tie))
    }

    /// Whether a face is between a point and the eye: the point lies clearly behind its plane, its image in the face's or,
    /// within `tie` file units, on its rim, and where the ray passes the face is not nearer than the near plane.
    fn hides(&self, space: &Space, face: u32, probe: &Probe, tie: f64) -> bool {
        let numbers = self.triangles[face as usize];
        let own_ends = match probe.own {
            Own::Faces(own) if own.contains(&face) => return false,
            Own::Faces(_) => [u32::MAX; 2],
            Own::Edge(ends) => ends,
        };
        let is_own = numbers.map(|number| own_ends.contains(&number));
        if is_own.iter().filter(|is_own| **is_own).count() == 2 {
            return false;
        }
        let [a, b, c] = self.corners(face);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let normal = ab.cross(ac);
        let longest = ab.length_squared().max(ac.length_squared()).max(bc.length_squared()).sqrt();
        let contact = (CONTACT * longest.min(probe.line_length) + 4.0 * space.noise) * normal.length();
        let above = normal.dot(probe.view - a);
        let towards_eye = match space.is_perspective() {
            true => -normal.dot(a),
            false => normal.z,
        };
        // Behind the plane, and farther from it than what counts as touching.
        if above.abs() <= contact || (above > 0.0) == (towards_eye > 0.0) || towards_eye == 0.0 {
            return false;
        }
        let corners = [(a, is_own[0]), (b, is_own[1]), (c, is_own[2])];
        let is_inside = (0..3).all(|side| {
            let ((from, from_is_own), (to, to_is_own)) = (corners[side], corners[(side + 1) % 3]);
            let (turn, length) = space.turn(from, to, probe.view);
            // Counter-clockwise, seen from the front.
            let inward = if towards_eye > 0.0 { turn } else { -turn };
            // A side that meets the line's end may run beside it at any distance: there only rounding is forgiven.
            let forgiven = if from_is_own || to_is_own { 4.0 * space.noise } else { tie };
            inward >= 0.0 || -inward <= forgiven * length
        });
        is_inside
            && (self.cut_by_near.binary_search(&face).is_err()
                || self.hit_depth(space, [a, normal], probe) >= space.near)
    }

    /// The depth at which the ray from the eye to a point passes a plane through a point with a normal.
    fn hit_depth(&self, space: &Space, [point, normal]: [DVec3; 2], probe: &Probe) -> f64 {
        let to_eye = space.to_eye(probe.view);
        let share = normal.dot(point - probe.view) / normal.dot(to_eye);
        -(probe.view + to_eye * share).z
    }
}

/// How much of a face matters.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reach {
    /// None of it.
    None,
    /// All of it.
    Whole,
    /// What is behind the near plane.
    ThroughNear,
}

/// A face's box in the picture, and how much of the face matters.
fn face_box(space: &Space, corners: [DVec3; 3], projected: impl Fn() -> [(DVec2, f64); 3]) -> (Box3, Reach) {
    let nothing = (Box3::around([DVec3::ZERO]), Reach::None);
    let depths = corners.map(|corner| -corner.z);
    let (nearest, farthest) = (depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2]));
    if farthest < space.near || nearest > space.far {
        return nothing;
    }
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    let mut add = |(px, key): (DVec2, f64)| {
        low = low.min(px.extend(key));
        high = high.max(px.extend(key));
    };
    let is_cut = nearest < space.near;
    if is_cut {
        for (index, corner) in corners.iter().enumerate() {
            if depths[index] >= space.near {
                add(space.project(*corner));
            }
            if let Some(point) = near_crossing(space, *corner, corners[(index + 1) % 3]) {
                add(space.project(point));
            }
        }
    } else {
        projected().into_iter().for_each(add);
    }
    // Rounding may move an image by no more than a tie.
    let margin = 1.0;
    if low.x > space.size.x + margin || low.y > space.size.y + margin || high.x < -margin || high.y < -margin {
        return nothing;
    }
    (Box3::new(low, high), if is_cut { Reach::ThroughNear } else { Reach::Whole })
}

/// Where the line between two points passes the near plane, if it does.
pub(super) fn near_crossing(space: &Space, a: DVec3, b: DVec3) -> Option<DVec3> {
    let (above, below) = (-a.z - space.near, -b.z - space.near);
    if (above >= 0.0) == (below >= 0.0) {
        return None;
    }
    let mut point = a + (b - a) * (above / (above - below));
    point.z = -space.near;
    Some(point)
}

/// Threads for so many simple things.
pub(super) fn worth(threads: usize, count: usize) -> usize {
    const WORTH_A_THREAD: usize = 20_000;
    threads.min(count / WORTH_A_THREAD).max(1)
}
