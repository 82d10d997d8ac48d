//! Lasting creases: those of the surface, without the single chance folds of its faces, as on scans.
//!
//! In: a [`Mesh`], its [`EdgeList`] and the crease angle. Out: the lasting creases. A crease continues in the straightest one
//! at its end, if it turns by less than 45 degrees there; where no other does, in an edge that is a little less sharp. So a crease
//! whose angle varies around the limit is one line (hysteresis, as in Canny 1986). It is lasting if it is closed or long, or if a
//! flat face of several triangles ends at it, as at all edges of a part. Only edges as sharp as creases count as length.

use super::classes::CREASES;
use super::usual_angles::UsualAngles;
use super::{Class, ClassSet, Classes, CreaseAngle, EdgeList};
use crate::mesh::{Mesh, triangle_normal};
use crate::threads::{filled, threads_for, threads_for_items};
use glam::DVec3;

/// Least length of a lasting crease, as a share of the diagonal of the model's box.
const LEAST_LENGTH: f64 = 0.06;

/// The cosine of the largest turn along one crease.
const STRAIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Most creases at a position; more of them do not continue.
const MOST_CREASES: usize = 16;

/// The least angle of an edge that continues a crease, as a share of the crease angle.
const CONTINUES: f64 = 2.0 / 3.0;

/// The least share of a crease's length at which it has its whole angle: with less, curved surfaces have creases.
const LEAST_SHARP: f64 = 1.0 / 3.0;

/// How much sharper a crease is than the edges around it.
const STANDS_OUT: f64 = 2.4;

/// The angle that is sharp among any edges, degrees: that of a hexagonal prism.
const SHARP_ANYWHERE: f64 = 60.0;

/// How sharp an edge is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sharpness {
    /// It is not part of any crease.
    Blunt,
    /// It continues creases.
    Continuing,
    /// It makes a crease.
    Crease,
    /// Likewise, and a flat face ends there.
    OfFlatFace,
}

/// The lasting creases of a mesh.
#[derive(Debug)]
pub(crate) struct LastingCreases {
    /// The angle of creases.
    pub angle: CreaseAngle,
    /// The classes of edges found.
    pub wanted: ClassSet,
    /// Whether split normals make creases.
    pub by_normals: bool,
    /// The classes of edges; those of creases at a smaller angle too.
    pub classes: Classes,
    /// For each edge whether it is part of a lasting crease.
    pub lasts: Vec<bool>,
}

impl LastingCreases {
    /// Finds the edges' classes in `wanted` and those of lasting creases, with whether each triangle is part of a flat face.
    pub(super) fn find(
        of: (&Mesh, &EdgeList, &[bool]),
        angle: CreaseAngle,
        wanted: ClassSet,
        by_normals: bool,
    ) -> Self {
        let (mesh, edges, is_flat) = of;
        // Where normals do not decide, only creases are read from these classes.
        let at_angle = Classes::new(mesh, edges, angle, if by_normals { wanted } else { wanted.and(CREASES) });
        let ends_flat = |edge: u32| edges.faces(edge).iter().any(|face| is_flat[*face as usize]);
        let found = |classes, sharpness: Vec<Sharpness>| {
            let lasts = lasting(mesh, edges, &sharpness);
            Self { angle, wanted, by_normals, classes, lasts }
        };
        let all = || 0..edges.len() as u32;
        if by_normals {
            let sharpness = all().map(|edge| match at_angle.of_edges[edge as usize].contains(Class::Normal) {
                true if ends_flat(edge) => Sharpness::OfFlatFace,
                true => Sharpness::Crease,
                false => Sharpness::Blunt,
            });
            let sharpness = sharpness.collect();
            return found(at_angle, sharpness);
        }
        let less = CreaseAngle { cosine: (CONTINUES * angle.degrees()).to_radians().cos() };
        let at_less = Classes::new(mesh, edges, less, wanted);
        let has = |classes: &Classes, edge: u32| !classes.of_edges[edge as usize].and(CREASES).is_empty();
        let asked: Vec<u32> = all().filter(|edge| has(&at_less, *edge)).collect();
        let normals = face_normals(mesh);
        let usual = UsualAngles::new(mesh, edges, &normals, &asked);
        let mut sharpness = vec![Sharpness::Blunt; edges.len()];
        let found_at = |edge: u32| {
            let is_crease = has(&at_angle, edge);
            if is_crease && ends_flat(edge) {
                return Sharpness::OfFlatFace;
            }
            let around = usual.around(edge, |other| has(&at_angle, other));
            let stands_out = |share: f64| {
                usual.angle(edge).is_some_and(|angle| angle >= (share * STANDS_OUT * around).min(SHARP_ANYWHERE))
            };
            match () {
                () if is_crease && stands_out(1.0) => Sharpness::Crease,
                () if stands_out(CONTINUES) => Sharpness::Continuing,
                () => Sharpness::Blunt,
            }
        };
        let of_asked = filled(asked.len(), threads_for_items(asked.len()), Sharpness::Blunt, |at| found_at(asked[at]));
        asked.iter().zip(of_asked).for_each(|(edge, found)| sharpness[*edge as usize] = found);
        found(at_less, sharpness)
    }
}

/// Makes the ends of pairs partners, each end of one other: first in pairs without the mark, then in the straightest. A pair is its
/// mark, the cosine between its lines, which is -1 where they are straight, and its ends.
pub(crate) fn pair(mut pairs: Vec<(bool, f64, usize, usize)>, partners: &mut [Option<usize>]) {
    pairs.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then((a.2, a.3).cmp(&(b.2, b.3))));
    for (_, _, first, second) in pairs {
        if partners[first].is_none() && partners[second].is_none() {
            (partners[first], partners[second]) = (Some(second), Some(first));
        }
    }
}

/// Returns for each edge whether it is a lasting crease.
fn lasting(mesh: &Mesh, edges: &EdgeList, sharpness: &[Sharpness]) -> Vec<bool> {
    let creases: Vec<u32> =
        (0..edges.len() as u32).filter(|edge| sharpness[*edge as usize] > Sharpness::Blunt).collect();
    let sharpness = |crease: usize| sharpness[creases[crease] as usize];
    let end = |end: usize| edges.positions()[creases[end / 2] as usize][end % 2];
    let place = |end_number: usize| mesh.positions[end(end_number) as usize];
    let length = |crease: usize| place(2 * crease).distance(place(2 * crease + 1));
    // Ends are numbered: crease `k` has ends `2k` and `2k + 1`.
    let mut partners: Vec<Option<usize>> = vec![None; creases.len() * 2];
    let mut ends: Vec<usize> = (0..creases.len() * 2).collect();
    ends.sort_unstable_by_key(|number| (end(*number), *number));
    for meeting in ends.chunk_by(|a, b| end(*a) == end(*b)).filter(|meeting| meeting.len() <= MOST_CREASES) {
        let away = |number: usize| (place(number ^ 1) - place(number)).normalize_or_zero();
        let mut pairs: Vec<(bool, f64, usize, usize)> = Vec::new();
        for (index, first) in meeting.iter().copied().enumerate() {
            let with_second = meeting[index + 1..].iter().copied().map(|second| {
                let continues = [first, second].iter().any(|end| sharpness(end / 2) == Sharpness::Continuing);
                (continues, away(first).dot(away(second)), first, second)
            });
            pairs.extend(with_second.filter(|(_, cosine, ..)| *cosine < -STRAIGHT));
        }
        pair(pairs, &mut partners);
    }
    let (low, high) = mesh.bounds();
    let least = LEAST_LENGTH * (high - low).length();
    let mut lasts = vec![false; edges.len()];
    let mut is_known = vec![false; creases.len()];
    for first in 0..creases.len() {
        let mut begin = 2 * first;
        let mut is_closed = false;
        while let Some(partner) = partners[begin].filter(|_| !is_known[first] && !is_closed) {
            begin = partner ^ 1;
            is_closed = begin == 2 * first;
        }
        let (mut chain, mut all, mut sharp) = (Vec::new(), 0.0, 0.0);
        let mut next = Some(begin);
        while let Some(number) = next.filter(|number| !is_known[number / 2]) {
            let crease = number / 2;
            is_known[crease] = true;
            chain.push(crease);
            all += length(crease);
            sharp += if sharpness(crease) == Sharpness::Continuing { 0.0 } else { length(crease) };
            next = partners[number ^ 1];
        }
        let is_long = (is_closed || sharp >= least) && sharp > LEAST_SHARP * all;
        let stays = |crease: &usize| is_long || sharpness(*crease) == Sharpness::OfFlatFace;
        chain.into_iter().filter(stays).for_each(|crease| lasts[creases[crease] as usize] = true);
    }
    lasts
}

/// The unit normals of all faces; 0 for a face without area.
fn face_normals(mesh: &Mesh) -> Vec<DVec3> {
    let normal = |face: &[u32; 3]| mesh.corners(face).and_then(triangle_normal).unwrap_or(DVec3::ZERO);
    filled(mesh.triangles.len(), threads_for(mesh.triangles.len()), DVec3::ZERO, |face| normal(&mesh.triangles[face]))
}
