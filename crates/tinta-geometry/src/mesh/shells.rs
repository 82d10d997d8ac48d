//! Finds a mesh's closed shells and the outside of each, whatever their winding.
//!
//! In: a [`Mesh`]. Out: [`Shells`]. The faces of each shell are turned to one orientation, and
//! the sign of its volume tells the outside. Shells that meet along an edge of four faces stay two if each is closed without the
//! other. A shell inside another one bounds a hollow of it: its outside is the enclosed space. Wound alike and of another part, it
//! is another solid. Open and one-sided surfaces belong to no shell.

use super::{Mesh, NONE};
use crate::disjoint_sets::DisjointSets;
use glam::DVec3;
use std::collections::BTreeMap;

/// A face at an edge.
struct HalfEdge {
    /// The edge's positions, the lower number first.
    ends: [u32; 2],
    face: u32,
    /// Whether the face runs from the higher position to the lower.
    is_down: bool,
}

/// The faces' sides, those of one edge together.
fn half_edges(mesh: &Mesh) -> Vec<HalfEdge> {
    let mut sides = Vec::with_capacity(mesh.triangles.len() * 3);
    for (face, [a, b, c]) in
        mesh.triangles.iter().copied().enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a)
    {
        let side =
            |from: u32, to: u32| HalfEdge { ends: [from.min(to), from.max(to)], face: face as u32, is_down: from > to };
        sides.extend([side(a, b), side(b, c), side(c, a)]);
    }
    sides.sort_unstable_by_key(|side| (side.ends, side.face));
    sides
}

/// The closed shells of a mesh.
pub(crate) struct Shells {
    shells: Vec<Shell>,
    /// For each shell the one whose hollow it bounds.
    hollow_of: Vec<Option<usize>>,
}

/// A closed shell.
struct Shell {
    /// Its faces, reversed where the second value says so.
    faces: Vec<(u32, bool)>,
    bounds: [DVec3; 2],
    /// Six times its volume, negative if its turned faces show their fronts inside.
    volume: f64,
}

impl Shells {
    /// Finds a mesh's shells.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let shells = Orientation::of(mesh.triangles.len(), &half_edges(mesh)).shells(mesh);
        let hollow_of = hollows(&shells, mesh);
        Self { shells, hollow_of }
    }

    /// For each face of a mesh of this many whether its front is outside; faces of no shell keep the file's winding.
    pub(crate) fn fronts_outside(&self, faces: usize) -> Vec<bool> {
        let mut is_outside = vec![true; faces];
        for (shell, hollow_of) in self.shells.iter().zip(&self.hollow_of) {
            for (face, is_turned) in &shell.faces {
                is_outside[*face as usize] = ((shell.volume > 0.0) != *is_turned) != hollow_of.is_some();
            }
        }
        is_outside
    }

    /// For each face of a mesh of this many the number of its solid: a shell with its hollows. [`NONE`] for faces of no shell.
    pub(crate) fn solids(&self, faces: usize) -> Vec<u32> {
        let mut solids = vec![NONE; faces];
        for (number, (shell, hollow_of)) in self.shells.iter().zip(&self.hollow_of).enumerate() {
            shell.faces.iter().for_each(|(face, _)| solids[*face as usize] = hollow_of.unwrap_or(number) as u32);
        }
        solids
    }
}

/// Faces in sets that share an orientation across edges of two faces.
struct Orientation {
    /// Each face twice, unchanged and reversed.
    sets: DisjointSets,
    count: usize,
    /// The shell of each face.
    shell_of: Vec<ShellOf>,
}

/// The shell that a face belongs to.
#[derive(Clone, Copy, PartialEq)]
enum ShellOf {
    /// None: its surface is open or one-sided.
    None,
    /// Its set, which is closed alone.
    Set,
    /// Several sets that are closed together as the file winds them, by the number of the first.
    Joint(u32),
}

impl Orientation {
    fn of(count: usize, half_edges: &[HalfEdge]) -> Self {
        let mut own = Self { sets: DisjointSets::new(count * 2), count, shell_of: vec![ShellOf::None; count] };
        let edges = || half_edges.chunk_by(|a, b| a.ends == b.ends);
        for edge in edges() {
            if let [first, second] = edge {
                let is_reversed = first.is_down == second.is_down;
                let [first, second] = [first.face, second.face];
                let others = [second, second + count as u32];
                own.sets.join([first, others[usize::from(is_reversed)]]);
                own.sets.join([first + count as u32, others[usize::from(!is_reversed)]]);
            }
        }
        // Where a set's faces do not leave an edge as often as they come to it, the set is open there.
        let mut is_open: Vec<bool> =
            (0..count as u32).map(|face| own.sets.root(face) == own.sets.root(face + count as u32)).collect();
        for face in 0..count {
            let (set, _) = own.set_of(face as u32);
            is_open[set as usize] |= is_open[face];
        }
        let mut joints = DisjointSets::new(count);
        for edge in edges().filter(|edge| edge.len() != 2) {
            let open = unbalanced(edge.iter().map(|side| {
                let (set, is_turned) = own.set_of(side.face);
                (set, side.is_down != is_turned)
            }));
            for set in &open {
                is_open[*set as usize] = true;
                joints.join([open[0], *set]);
            }
        }
        let set: Vec<u32> = (0..count as u32).map(|face| own.set_of(face).0).collect();
        let joint: Vec<u32> = set.iter().map(|set| joints.root(*set)).collect();
        let mut is_joint = vec![true; count];
        for edge in edges() {
            let open = edge.iter().filter(|side| is_open[set[side.face as usize] as usize]);
            for joint in unbalanced(open.map(|side| (joint[side.face as usize], side.is_down))) {
                is_joint[joint as usize] = false;
            }
        }
        for (face, shell_of) in own.shell_of.iter_mut().enumerate() {
            *shell_of = match (is_open[set[face] as usize], is_joint[joint[face] as usize]) {
                (false, _) => ShellOf::Set,
                (true, true) => ShellOf::Joint(joint[face]),
                (true, false) => ShellOf::None,
            };
        }
        own
    }

    /// A face's set and whether it is reversed in it: of a set and its reverse the one with the lower number counts.
    fn set_of(&mut self, face: u32) -> (u32, bool) {
        let roots = [face, face + self.count as u32].map(|node| self.sets.root(node));
        (roots[0].min(roots[1]), roots[1] < roots[0])
    }

    fn shells(mut self, mesh: &Mesh) -> Vec<Shell> {
        let (low, high) = mesh.bounds();
        let centre = low * 0.5 + high * 0.5;
        let mut shells: Vec<Option<Shell>> = (0..self.count * 2).map(|_| None).collect();
        for face in 0..self.count as u32 {
            let (key, is_turned) = match self.shell_of[face as usize] {
                ShellOf::None => continue,
                ShellOf::Set => self.set_of(face),
                // No set has a number so high: the lower of two roots counts.
                ShellOf::Joint(first) => (first + self.count as u32, false),
            };
            let Some(corners) = mesh.corners(&mesh.triangles[face as usize]) else { continue };
            let [a, b, c] = corners.map(|corner| corner - centre);
            let volume = a.dot(b.cross(c)) * if is_turned { -1.0 } else { 1.0 };
            let [low, high] = [a.min(b).min(c) + centre, a.max(b).max(c) + centre];
            let new = || Shell { faces: Vec::new(), bounds: [low, high], volume: 0.0 };
            let shell = shells[key as usize].get_or_insert_with(new);
            shell.faces.push((face, is_turned));
            shell.bounds = [shell.bounds[0].min(low), shell.bounds[1].max(high)];
            shell.volume += volume;
        }
        shells.into_iter().flatten().collect()
    }
}

/// The keys that do not come as often with `true` as with `false`, ascending.
fn unbalanced(sides: impl Iterator<Item = (u32, bool)>) -> Vec<u32> {
    let mut balance: BTreeMap<u32, i32> = BTreeMap::new();
    sides.for_each(|(key, is_down)| *balance.entry(key).or_default() += if is_down { 1 } else { -1 });
    balance.into_iter().filter(|(_, sum)| *sum != 0).map(|(key, _)| key).collect()
}

/// For each shell the one whose hollow it bounds.
fn hollows(shells: &[Shell], mesh: &Mesh) -> Vec<Option<usize>> {
    let furthest = furthest_corners(shells, mesh);
    let is_around = |outer: usize, inner: usize| {
        outer != inner
            && shells[outer].is_larger(&shells[inner])
            && !furthest[inner].is_empty()
            && furthest[inner].iter().all(|corner| shells[outer].is_around(mesh, *corner))
    };
    let around: Vec<Vec<usize>> =
        (0..shells.len()).map(|inner| (0..shells.len()).filter(|outer| is_around(*outer, inner)).collect()).collect();
    let mut order: Vec<usize> = (0..shells.len()).collect();
    order.sort_by_key(|shell| around[*shell].len());
    let mut hollow_of = vec![None; shells.len()];
    for shell in order {
        let volume = |it: usize| shells[it].volume.abs();
        let depth_then_smallness =
            |a: &usize, b: &usize| (around[*a].len().cmp(&around[*b].len())).then(volume(*b).total_cmp(&volume(*a)));
        let innermost = around[shell].iter().copied().max_by(depth_then_smallness);
        hollow_of[shell] =
            innermost.filter(|outer| hollow_of[*outer].is_none() && !shells[*outer].is_beside(mesh, &shells[shell]));
    }
    hollow_of
}

/// The outermost corners of each shell along the axes, without those that shells share.
fn furthest_corners(shells: &[Shell], mesh: &Mesh) -> Vec<Vec<DVec3>> {
    let corners =
        |shell: &Shell| shell.faces.iter().flat_map(|(face, _)| mesh.triangles[*face as usize]).collect::<Vec<_>>();
    let mut owners = vec![NONE; mesh.positions.len()];
    let mut is_shared = vec![false; mesh.positions.len()];
    for (number, shell) in (0u32..).zip(shells) {
        for corner in corners(shell) {
            let owner = std::mem::replace(&mut owners[corner as usize], number);
            is_shared[corner as usize] |= owner != NONE && owner != number;
        }
    }
    let along = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let of_shell = |shell: &Shell| {
        let own = corners(shell).into_iter().filter(|corner| !is_shared[*corner as usize]);
        let points: Vec<DVec3> = own.map(|corner| mesh.positions[corner as usize]).collect();
        let furthest = |axis: &DVec3| points.iter().copied().max_by(|a, b| a.dot(*axis).total_cmp(&b.dot(*axis)));
        along.iter().filter_map(furthest).collect()
    };
    shells.iter().map(of_shell).collect()
}

impl Shell {
    /// Whether another shell is another solid even inside this one: of another part, and wound like this one in the file.
    fn is_beside(&self, mesh: &Mesh, other: &Self) -> bool {
        let part = |shell: &Self| shell.faces.first().and_then(|(face, _)| mesh.triangle_parts.get(*face as usize));
        let is_outward = |shell: &Self| (shell.volume > 0.0) != shell.faces.first().is_some_and(|(_, turned)| *turned);
        part(self) != part(other) && is_outward(self) == is_outward(other)
    }

    /// Whether another shell may lie within this one.
    fn is_larger(&self, other: &Self) -> bool {
        let [[low, high], [other_low, other_high]] = [self.bounds, other.bounds];
        low.cmple(other_low).all() && other_high.cmple(high).all() && self.volume.abs() > other.volume.abs()
    }

    /// Whether a ray from a point leaves this shell an odd number of times.
    fn is_around(&self, mesh: &Mesh, from: DVec3) -> bool {
        /// Along no axis and in no plane that models have.
        const AWAY: DVec3 = DVec3::new(0.537_912, 0.733_871, 0.414_877);
        let is_crossed = |[a, b, c]: [DVec3; 3]| {
            let turn = |p: DVec3, q: DVec3| (p - from).cross(q - from).dot(AWAY);
            let turns = [turn(a, b), turn(b, c), turn(c, a)];
            let normal = (b - a).cross(c - a);
            let is_before = normal.dot(a - from) * normal.dot(AWAY) > 0.0;
            is_before && (turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0))
        };
        let corners = self.faces.iter().filter_map(|(face, _)| mesh.corners(&mesh.triangles[*face as usize]));
        corners.filter(|corners| is_crossed(*corners)).count() % 2 == 1
    }
}
