//! Groups of faces in one plane. Faces in one plane neither hide nor pass through one another, however many they are: searches
//! skip such pairs as a group.

use crate::bvh::{Box3, NO_GROUP};
use crate::threads::{filled, threads_for_items};
use crate::thresholds::THRESHOLDS;
use glam::DVec3;
use std::collections::HashMap;

/// Returns for each number of a face its plane, or [`NO_GROUP`] where few others lie in it; an empty list without such a plane.
///
/// In: for each place a face's box, corners and number; the size in pixels below which faces are left out; the smallest distance
/// below which positions count as one, file units; and the count of numbers.
///
/// Two faces of a group are nearer to one another's plane than `--weld`: they touch by the rule for contact. Small faces are left
/// out, because large ones cost the time.
pub(in crate::lines) fn planes(
    boxes: &[Box3],
    corners: impl Fn(u32) -> [DVec3; 3] + Sync,
    numbers: &[u32],
    (least_px, smallest_weld): (f64, f64),
    count: usize,
) -> Vec<u32> {
    let is_large = |place: &u32| {
        let [low, high] = boxes[*place as usize].corners();
        (high - low).truncate().max_element() >= least_px
    };
    let large: Vec<u32> = (0..boxes.len() as u32).filter(is_large).collect();
    if large.len() < THRESHOLDS.group {
        return Vec::new();
    }
    let points = large.iter().flat_map(|place| corners(*place));
    let (low, high) =
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), corner| (low.min(corner), high.max(corner)));
    let (centre, radius) = ((low + high) * 0.5, (high - low).length() * 0.5);
    let step = smallest_weld * 0.1;
    if step <= 0.0 || radius <= 0.0 {
        return Vec::new();
    }
    let plane = |place: u32| {
        let [a, b, c] = corners(place);
        let normal = (b - a).cross(c - a).try_normalize()?;
        let normal = if normal[normal.abs().max_position()] < 0.0 { -normal } else { normal };
        let steps = |value: f64| (value / step).round() as i64;
        Some([normal.x * radius, normal.y * radius, normal.z * radius, normal.dot(a - centre)].map(steps))
    };
    let keys = filled(large.len(), threads_for_items(large.len()), None, |index| plane(large[index]));
    // Most scenes have no such plane. This shows early where few keys share a remainder.
    let remainders = keys.len().next_power_of_two();
    let remainder = |key: &[i64; 4]| mix(key) as usize & (remainders - 1);
    let mut of_remainder = vec![0usize; remainders];
    keys.iter().flatten().for_each(|key| of_remainder[remainder(key)] += 1);
    let mut counts: HashMap<[i64; 4], (u32, usize)> = HashMap::new();
    for key in keys.iter().flatten().filter(|key| of_remainder[remainder(key)] >= THRESHOLDS.group) {
        let number = counts.len() as u32;
        counts.entry(*key).or_insert((number, 0)).1 += 1;
    }
    let mut planes = vec![NO_GROUP; count];
    for (place, key) in large.iter().zip(keys) {
        let group = key.and_then(|key| counts.get(&key)).filter(|(_, count)| *count >= THRESHOLDS.group);
        if let Some((number, _)) = group {
            planes[numbers[*place as usize] as usize] = *number;
        }
    }
    planes
}

/// Returns a number that differs for most different keys.
fn mix(key: &[i64; 4]) -> u64 {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let mixed = key.iter().fold(0, |mixed: u64, part| (mixed ^ *part as u64).wrapping_mul(ODD).rotate_left(29));
    mixed ^ (mixed >> 32)
}
