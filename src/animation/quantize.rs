//! Chooses the 256 colours that best replace thousands: flat tones exactly, the others by NeuQuant (Dekker 1994).

use gif::Frame;
use std::cmp::Reverse;

/// A colour as one number, red in the high byte.
pub(super) type Packed = u32;

/// Colours with the number of their pixels.
pub(super) type Histogram = Vec<(Packed, u32)>;

/// Two palette entries, and how many of 64 pixels get the second, at most half of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mix {
    pub first: u8,
    pub second: u8,
    pub share: u8,
}

/// Weights of red, green and blue in a distance, roughly those of the eye.
const WEIGHTS: [i32; 3] = [3, 4, 2];

/// A colour that covers this share of the picture keeps its exact place …
const FLAT_SHARE: f64 = 1.0 / 512.0;

/// … but no more than this share of the palette.
const FLAT_ENTRIES: f64 = 0.5;

/// NeuQuant learns from every so many-th pixel.
const STEP: i32 = 10;

fn channels(color: Packed) -> [i32; 3] {
    let [_, red, green, blue] = color.to_be_bytes();
    [red, green, blue].map(i32::from)
}

/// Returns the square of the weighted distance of two colours, in square steps of 255 (the weights' sum makes it three times too
/// large).
pub(super) fn distance(a: Packed, b: Packed) -> f32 {
    let (a, b) = (channels(a), channels(b));
    let sum: i32 = (0..3).map(|channel| WEIGHTS[channel] * (a[channel] - b[channel]).pow(2)).sum();
    sum as f32 / 3.0
}

/// Returns at most `room` colours for a picture of RGBA pixels of this width that has more.
pub(super) fn choose(pixels: &[u8], width: usize, histogram: &Histogram, room: usize) -> Vec<Packed> {
    let count: f64 = histogram.iter().map(|(_, count)| f64::from(*count)).sum();
    let mut flat = histogram.clone();
    flat.retain(|(_, of_color)| f64::from(*of_color) >= count * FLAT_SHARE);
    flat.sort_unstable_by_key(|(color, of_color)| (Reverse(*of_color), *color));
    flat.truncate((room as f64 * FLAT_ENTRIES) as usize);
    let height = pixels.len() / 4 / width;
    let learnt = Frame::from_rgba_speed(width as u16, height as u16, &mut pixels.to_vec(), STEP).palette;
    let mut others: Vec<Packed> = learnt
        .unwrap_or_default()
        .chunks_exact(3)
        .map(|color| u32::from_be_bytes([0, color[0], color[1], color[2]]))
        .collect();
    // Each flat tone takes the place of the entry that it is nearest to.
    for (color, _) in &flat {
        others.swap_remove(nearest(*color, &others));
    }
    while flat.len() + others.len() > room {
        others.pop();
    }
    let mut colors: Vec<Packed> = flat.into_iter().map(|(color, _)| color).chain(others).collect();
    colors.sort_unstable();
    colors.dedup();
    colors
}

fn nearest(color: Packed, colors: &[Packed]) -> usize {
    let mut best = (0, f32::INFINITY);
    for (index, entry) in colors.iter().enumerate() {
        let distance = distance(color, *entry);
        if distance < best.1 {
            best = (index, distance);
        }
    }
    best.0
}

/// Returns two entries, at `first_color` or later, and their shares; their mix is nearest to a colour without being rough.
pub(super) fn mix(color: Packed, colors: &[Packed], first_color: usize) -> Mix {
    /// The weight of the entries' difference against the difference between their mean and the colour.
    const ROUGHNESS: f32 = 0.25;
    let first = first_color + nearest(color, &colors[first_color..]);
    let single = distance(color, colors[first]);
    let mut best = (Mix { first: first as u8, second: first as u8, share: 0 }, single);
    if single == 0.0 {
        return best.0;
    }
    let weights = WEIGHTS.map(|weight| weight as f32);
    let (target, start) = (channels(color), channels(colors[first]));
    let wanted = [0, 1, 2].map(|channel| (target[channel] - start[channel]) as f32);
    let dot = |a: [f32; 3], b: [f32; 3]| (0..3).map(|channel| weights[channel] * a[channel] * b[channel]).sum::<f32>();
    for (second, entry) in colors.iter().enumerate().skip(first_color).filter(|(index, _)| *index != first) {
        let end = channels(*entry);
        let step = [0, 1, 2].map(|channel| (end[channel] - start[channel]) as f32);
        let length = dot(step, step);
        if length == 0.0 {
            continue;
        }
        let share = (dot(wanted, step) / length).clamp(0.0, 0.5);
        let rest = [0, 1, 2].map(|channel| wanted[channel] - share * step[channel]);
        let error = (dot(rest, rest) + ROUGHNESS * share * (1.0 - share) * length) / 3.0;
        if error < best.1 {
            best = (Mix { first: first as u8, second: second as u8, share: (share * 64.0).round() as u8 }, error);
        }
    }
    best.0
}
