//! A hierarchy of normal cones: silhouettes in time that grows with the silhouette, not with the mesh.
//!
//! Edges are sorted along Hilbert's curve and grouped; each group knows a cone that holds the normals of all its faces and
//! how far their planes lie from its middle. From that follows, for most eyes and groups, that all its faces are seen from
//! the front or all from the back, so that none of its edges can be silhouette (Sander et al. 2000 clip so; the distances
//! of the planes make the test sharper than a bounding sphere does).

use super::silhouette::{LocalEye, PLANE_ERROR, PUBLISHED_CLEAR, is_published_silhouette};
use super::{EdgeList, Eye, Incidence, SilhouetteRule, Silhouettes};
use crate::mesh::{Mesh, hilbert_code};
use crate::threads::{in_parallel, threads_for};
use glam::{Vec3, Vec4, Vec4Swizzles};

/// Edges in a group of the lowest level: fewer make more groups to test, more make more edges to test.
const LEAF: usize = 32;

/// Faces of such a group at most.
const LEAF_FACES: usize = 2 * LEAF;

/// Groups in a group of the next level.
const BRANCH: usize = 8;

/// Levels end when there are no more groups than this.
const TOP: usize = 64;

/// Searching so many edges here costs about what looking at one face costs elsewhere: it decides about threads.
const EDGES_WORTH_A_FACE: usize = 4;

/// The hierarchy over the edges of a mesh.
#[derive(Debug, Clone)]
pub struct NormalCones {
    /// The edges that can be silhouette, in the hierarchy's order.
    edges: Vec<u32>,
    /// The places of each one's two faces among its group's; apart from the numbers, which only silhouettes are asked for.
    edge_faces: Vec<[u8; 2]>,
    /// The faces of each lowest group, each face once a group: asked together, they lie together.
    faces: LeafFaces,
    /// From the lowest level up.
    levels: Vec<Vec<Cone>>,
}

/// The lowest groups' faces, group by group.
#[derive(Debug, Clone, Default)]
struct LeafFaces {
    /// Where each group's faces begin, and the end.
    starts: Vec<u32>,
    /// Each face's number in [`Silhouettes`].
    numbers: Vec<u32>,
    /// Four numbers a face: each group's first numbers, then its second, third and fourth ones, so that several planes are
    /// computed with at once and all of a group's lie on one page.
    planes: Vec<f32>,
}

/// What is known of a group's faces.
#[derive(Debug, Clone, Copy)]
struct Cone {
    /// Unit vector.
    axis: Vec3,
    /// Cosine and sine of the largest angle between the axis and a normal; the sine is infinite from 90 degrees on.
    cosine: f32,
    sine: f32,
    middle: Vec3,
    /// Smallest and largest signed distance of the middle from a face's plane.
    lowest: f32,
    highest: f32,
}

/// What a group's cone says of its faces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    NoSilhouette,
    Unknown,
}

impl NormalCones {
    /// Builds the hierarchy; worth it from the second or third view of a mesh on.
    pub fn new(mesh: &Mesh, edges: &EdgeList, silhouettes: &Silhouettes) -> Self {
        let faces = &edges.faces;
        let point = |position: u32| silhouettes.frame.local(mesh.positions[position as usize]);
        let parts = in_parallel(edges.len(), threads_for(edges.len()), |range| {
            // The listing's rule takes reversed edges as they are, the exact one turns a face round, so that a cone of one
            // orientation says nothing of them: each is looked at by itself.
            let is_candidate = |edge: &usize| matches!(edges.incidence[*edge], Incidence::Inner);
            let candidates = range.filter(is_candidate);
            let key = |edge: usize| {
                let [a, b] = edges.positions()[edge].map(point);
                let code = hilbert_code(((a + b) * 0.5 + Vec3::ONE).as_dvec3() * 511.5);
                u64::from(code) << 32 | edge as u64
            };
            let mut keys: Vec<u64> = candidates.map(key).collect();
            keys.sort_unstable();
            keys
        });
        let mut keys = parts.concat();
        // Stable sorting merges the sorted parts.
        keys.sort();
        let sorted: Vec<(u32, [u32; 2])> = keys.iter().map(|key| (*key as u32, faces[*key as u32 as usize])).collect();
        let mut levels: Vec<Vec<Cone>> = Vec::new();
        let mut size = LEAF;
        loop {
            let groups: Vec<&[(u32, [u32; 2])]> = sorted.chunks(size).collect();
            let parts = in_parallel(groups.len(), threads_for(sorted.len()), |range| {
                groups[range].iter().map(|group| Cone::around(&silhouettes.planes, group)).collect::<Vec<Cone>>()
            });
            levels.push(parts.concat());
            if groups.len() <= TOP {
                break;
            }
            size *= BRANCH;
        }
        let mut cones = Self {
            edges: Vec::with_capacity(sorted.len()),
            edge_faces: Vec::with_capacity(sorted.len()),
            faces: LeafFaces::default(),
            levels,
        };
        cones.faces.planes.reserve(sorted.len() * 4);
        sorted.chunks(LEAF).for_each(|group| cones.add_leaf(&silhouettes.planes, group));
        cones.faces.starts.push(cones.faces.numbers.len() as u32);
        cones
    }

    /// The silhouette edges, ascending: the same as [`Silhouettes::find`] finds. The other arguments are those this was
    /// made from.
    pub fn find(
        &self,
        mesh: &Mesh,
        edges: &EdgeList,
        silhouettes: &Silhouettes,
        eye: Eye,
        rule: SilhouetteRule,
    ) -> Vec<u32> {
        let local = silhouettes.local_eye(eye, rule);
        let exactly = |face: u32| silhouettes.is_front_exactly(mesh, face as usize, eye);
        let mut found = match rule {
            SilhouetteRule::Exact | SilhouetteRule::Smooth => self.search::<true>(&local, local.error, exactly),
            // The listing's bound is to be cleared beside the error.
            SilhouetteRule::Published => self.search::<false>(&local, local.error + PUBLISHED_CLEAR, exactly),
        };
        silhouettes.add_reversed(mesh, edges, eye, rule, &mut found);
        found
    }

    /// Goes down wherever a cone leaves it open whether its group has silhouettes; large meshes' top groups on two threads
    /// or more.
    fn search<const IS_EXACT: bool>(
        &self,
        eye: &LocalEye,
        clearance: f32,
        is_front_exactly: impl Fn(u32) -> bool + Sync,
    ) -> Vec<u32> {
        let top = self.levels.len() - 1;
        let threads = threads_for(self.edges.len() / EDGES_WORTH_A_FACE);
        let parts = in_parallel(self.levels[top].len(), threads, |groups| {
            let mut found = Vec::new();
            let mut open: Vec<(u32, u32)> = groups.rev().map(|group| (top as u32, group as u32)).collect();
            while let Some((level, group)) = open.pop() {
                if self.levels[level as usize][group as usize].verdict(eye, clearance) == Verdict::NoSilhouette {
                    continue;
                }
                match level.checked_sub(1) {
                    Some(below) => {
                        let first = group * BRANCH as u32;
                        let end = (first + BRANCH as u32).min(self.levels[below as usize].len() as u32);
                        open.extend((first..end).rev().map(|group| (below, group)));
                    }
                    None => self.search_leaf::<IS_EXACT>(group as usize, eye, &is_front_exactly, &mut found),
                }
            }
            found.sort_unstable();
            found
        });
        let mut found = parts.concat();
        // Stable sorting merges the sorted parts.
        found.sort();
        found
    }

    fn add_leaf(&mut self, planes: &[[f32; 4]], group: &[(u32, [u32; 2])]) {
        let first = self.faces.numbers.len();
        self.faces.starts.push(first as u32);
        for (edge, faces) in group {
            let faces = faces.map(|face| {
                let known = self.faces.numbers[first..].iter().position(|number| *number == face);
                known.unwrap_or_else(|| {
                    self.faces.numbers.push(face);
                    self.faces.numbers.len() - 1 - first
                }) as u8
            });
            self.edges.push(*edge);
            self.edge_faces.push(faces);
        }
        for coordinate in 0..4 {
            let planes = self.faces.numbers[first..].iter().map(|face| planes[*face as usize][coordinate]);
            self.faces.planes.extend(planes);
        }
    }

    /// Tests every edge of a lowest group. `IS_EXACT` is the rule, known when compiling, so that the loops
    /// have no branch.
    #[inline(always)]
    fn search_leaf<const IS_EXACT: bool>(
        &self,
        group: usize,
        eye: &LocalEye,
        is_front_exactly: impl Fn(u32) -> bool,
        found: &mut Vec<u32>,
    ) {
        let range = self.faces.starts[group] as usize..self.faces.starts[group + 1] as usize;
        let numbers = &self.faces.numbers[range.clone()];
        let count = numbers.len().min(LEAF_FACES);
        let planes = &self.faces.planes[range.start * 4..][..count * 4];
        let [x, y, z, w] = [0, 1, 2, 3].map(|coordinate| &planes[coordinate * count..][..count]);
        let [eye_x, eye_y, eye_z, eye_w] = eye.homogeneous.to_array();
        let mut distances = [0f32; LEAF_FACES];
        for face in 0..count {
            let along_view = x[face] * eye_x + y[face] * eye_y + z[face] * eye_z;
            distances[face] = if IS_EXACT { along_view + w[face] * eye_w } else { along_view };
        }
        if IS_EXACT {
            // A NaN is not clear either.
            let clear = distances[..count].iter().map(|distance| u32::from(distance.abs() > eye.error)).sum::<u32>();
            if clear as usize != count {
                for (distance, number) in distances.iter_mut().zip(numbers) {
                    let is_clear = distance.abs() > eye.error;
                    if !is_clear {
                        *distance = if is_front_exactly(*number) { 1.0 } else { -1.0 };
                    }
                }
            }
        }
        let first_edge = group * LEAF;
        let end = (first_edge + LEAF).min(self.edges.len());
        let mut hits = 0u64;
        for (place, faces) in self.edge_faces[first_edge..end].iter().enumerate() {
            let [first, second] = faces.map(|face| distances[face as usize % LEAF_FACES]);
            let is_silhouette =
                if IS_EXACT { (first > 0.0) ^ (second > 0.0) } else { is_published_silhouette(first, second) };
            hits |= u64::from(is_silhouette) << place;
        }
        while hits != 0 {
            found.push(self.edges[first_edge + hits.trailing_zeros() as usize]);
            hits &= hits - 1;
        }
    }
}

impl Cone {
    /// The cone of the faces of some edges.
    fn around(planes: &[[f32; 4]], edges: &[(u32, [u32; 2])]) -> Self {
        let group = || edges.iter().flat_map(|(_, faces)| faces).map(|face| Vec4::from_array(planes[*face as usize]));
        let unknown = Self {
            axis: Vec3::ZERO,
            cosine: -1.0,
            sine: f32::INFINITY,
            middle: Vec3::ZERO,
            lowest: f32::NEG_INFINITY,
            highest: f32::INFINITY,
        };
        let sum: Vec3 = group().map(|plane| plane.xyz()).sum();
        let Some(axis) = sum.try_normalize() else { return unknown };
        // The point of the planes nearest the origin stands for the face: any point will do, a near one is sharpest.
        let feet: Vec3 = group().map(|plane| plane.xyz() * -plane.w).sum();
        let middle = feet / (edges.len() * 2) as f32;
        let cosine = group().map(|plane| plane.xyz().dot(axis)).fold(1.0f32, |least, cosine| match cosine < least {
            true => cosine,
            false => least,
        });
        let distances = || group().map(|plane| plane.xyz().dot(middle) + plane.w);
        let (lowest, highest) =
            distances().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)));
        // A little wider than computed, so that rounding cannot leave a normal outside.
        let cosine = cosine - PLANE_ERROR;
        if !(cosine > 0.0 && sum.is_finite()) {
            return unknown;
        }
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        Self { axis, cosine, sine: sine + PLANE_ERROR, middle, lowest, highest }
    }

    /// Whether all faces of the group show the same side.
    ///
    /// A plane's distance from the eye is n . (eye - middle) + its distance from the middle; over the cone the first lies
    /// within what the two angles allow.
    #[inline(always)]
    fn verdict(&self, eye: &LocalEye, clearance: f32) -> Verdict {
        let is_point = eye.homogeneous.w;
        let towards_eye = eye.homogeneous.xyz() - self.middle * is_point;
        let along = self.axis.dot(towards_eye);
        let across = (towards_eye - self.axis * along).length();
        let (middle, reach) = (along * self.cosine, across * self.sine);
        let clearance = clearance + PLANE_ERROR * (across + along.abs());
        // Before a cone the least of the products is at the angle farthest from the eye's, behind it the greatest at the
        // nearest; from the other side the bounds would not hold.
        let all_front = along >= 0.0 && middle - reach + self.lowest * is_point > clearance;
        let all_back = along <= 0.0 && middle + reach + self.highest * is_point < -clearance;
        if all_front || all_back { Verdict::NoSilhouette } else { Verdict::Unknown }
    }
}
