//! Gathers faces into patches: connected sets of about one area, for a scale that does not depend on the mesh's fineness.
//!
//! In: the neighbours among faces (or patches), their areas, and the pairs that may share a patch. Out: each one's patch.

use std::ops::Range;

/// Which faces, or patches of them, lie beside which.
pub(super) struct Neighbours {
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl Neighbours {
    pub(super) fn new(count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut starts = vec![0u32; count + 1];
        pairs.clone().flatten().for_each(|face| starts[face as usize + 1] += 1);
        (0..count).for_each(|face| starts[face + 1] += starts[face]);
        let mut next = starts.clone();
        let mut faces = vec![0; starts[count] as usize];
        for [a, b] in pairs {
            for [face, other] in [[a, b], [b, a]] {
                faces[next[face as usize] as usize] = other;
                next[face as usize] += 1;
            }
        }
        Self { starts, faces }
    }

    pub(super) fn of(&self, face: usize) -> &[u32] {
        &self.faces[self.range(face)]
    }

    /// The places of a face's neighbours in the list of all faces' neighbours, face by face.
    pub(super) fn range(&self, face: usize) -> Range<usize> {
        self.starts[face] as usize..self.starts[face + 1] as usize
    }

    /// Which of so many patches lie beside which, each pair once.
    fn of_patches(&self, patch_of: &[u32], count: usize) -> Self {
        let pairs = patch_of.iter().enumerate().flat_map(|(face, patch)| {
            let beside = self.of(face).iter().map(|other| patch_of[*other as usize]);
            beside.filter(|other| other > patch).map(|other| [*patch, other])
        });
        let with_repeats = Self::new(count, pairs);
        let (mut starts, mut faces) = (vec![0u32], with_repeats.faces);
        let mut end = 0;
        for patch in 0..count {
            let range = with_repeats.starts[patch] as usize..with_repeats.starts[patch + 1] as usize;
            faces[range.clone()].sort_unstable();
            let first = end;
            for place in range {
                let other = faces[place];
                if end == first || faces[end - 1] != other {
                    faces[end] = other;
                    end += 1;
                }
            }
            starts.push(end as u32);
        }
        faces.truncate(end);
        Self { starts, faces }
    }
}

/// Patches of faces, or of patches.
pub(super) struct Patches {
    /// The patch that each is part of.
    pub of: Vec<u32>,
    /// Each patch's area.
    pub areas: Vec<f64>,
    /// Which patches lie beside which.
    pub neighbours: Neighbours,
}

/// Gathers so many faces, or patches, in the order of their numbers. A patch begins with one that has the area `begins` says; `joins` gets
/// the patch's first, one of it, another beside that, and the patch's area so far, and says what area is added if the other joins.
pub(super) fn gathered(
    neighbours: &Neighbours,
    count: usize,
    begins: impl Fn(u32) -> f64,
    joins: impl Fn(u32, u32, u32, f64) -> Option<f64>,
) -> (Vec<u32>, Vec<f64>) {
    const NO_PATCH: u32 = u32::MAX;
    let (mut of, mut areas) = (vec![NO_PATCH; count], Vec::new());
    let mut queue = Vec::new();
    for first in 0..count as u32 {
        if of[first as usize] != NO_PATCH {
            continue;
        }
        let patch = areas.len() as u32;
        of[first as usize] = patch;
        queue.clear();
        queue.push(first);
        let (mut area, mut next) = (begins(first), 0);
        while let Some(&face) = queue.get(next) {
            next += 1;
            for &other in neighbours.of(face as usize) {
                if of[other as usize] == NO_PATCH
                    && let Some(added) = joins(first, face, other, area)
                {
                    of[other as usize] = patch;
                    area += added;
                    queue.push(other);
                }
            }
        }
        areas.push(area);
    }
    (of, areas)
}

impl Patches {
    pub(super) fn new(
        neighbours: &Neighbours,
        count: usize,
        begins: impl Fn(u32) -> f64,
        joins: impl Fn(u32, u32, u32, f64) -> Option<f64>,
    ) -> Self {
        let (of, areas) = gathered(neighbours, count, begins, joins);
        let neighbours = neighbours.of_patches(&of, areas.len());
        Self { of, areas, neighbours }
    }
}
