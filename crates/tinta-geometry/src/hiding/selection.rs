//! Some of an object's faces, picked one by one on all threads, in the order all of them are drawn in.

use super::DrawnFaces;
use crate::mesh::{Part, VertexArrays};
use crate::threads::{in_parallel, threads_for};

/// The faces for which `is_kept` holds, given a face's place in drawing order and its three vertices.
pub(super) fn select(arrays: &VertexArrays, is_kept: impl Fn(usize, &[u32]) -> bool + Sync) -> DrawnFaces {
    let count = arrays.indices.len() / 3;
    let kept = in_parallel(count, threads_for(count), |faces| {
        let mut kept = FaceSelection { indices: Vec::with_capacity(faces.len() * 3), counts: Vec::new() };
        let first_part = arrays.parts.partition_point(|part| part.first + part.count <= faces.start as u32 * 3);
        for (number, part) in arrays.parts.iter().enumerate().skip(first_part) {
            let begin = (part.first as usize / 3).max(faces.start);
            let end = ((part.first + part.count) as usize / 3).min(faces.end);
            if begin >= end {
                break;
            }
            let before = kept.indices.len();
            for (face, corners) in (begin..end).zip(arrays.indices[begin * 3..end * 3].chunks_exact(3)) {
                if is_kept(face, corners) {
                    kept.indices.extend_from_slice(corners);
                }
            }
            kept.counts.push((number, (kept.indices.len() - before) as u32));
        }
        kept
    });
    joined(kept, arrays)
}

/// What is kept of a range of faces.
struct FaceSelection {
    indices: Vec<u32>,
    /// Parts, and how many of the indices are each one's.
    counts: Vec<(usize, u32)>,
}

fn joined(kept: Vec<FaceSelection>, arrays: &VertexArrays) -> DrawnFaces {
    let mut parts: Vec<Part> = Vec::with_capacity(arrays.parts.len());
    let mut last = None;
    let mut first = 0;
    for (number, count) in kept.iter().flat_map(|kept| &kept.counts) {
        match parts.last_mut() {
            Some(part) if last == Some(number) => part.count += count,
            _ if *count > 0 => {
                parts.push(Part { material: arrays.parts[*number].material, first, count: *count });
                last = Some(number);
            }
            _ => {}
        }
        first += count;
    }
    let mut lists = kept.into_iter().map(|kept| kept.indices);
    let mut indices = lists.next().unwrap_or_default();
    lists.for_each(|list| indices.extend_from_slice(&list));
    let left_out = (arrays.indices.len() - indices.len()) / 3;
    DrawnFaces { indices, parts, left_out }
}
