//! Chooses the 256 colours that best replace thousands: flat tones exactly, then one after the other the colour that is served worst,
//! moved to the means of their neighbours (Lloyd). Crates for this bring large dependencies or shift flat tones.

/// A colour as one number, red in the high byte.
pub(super) type PackedColor = u32;

/// Colours with the number of their pixels.
pub(super) type Histogram = Vec<(PackedColor, u32)>;

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

/// Rounds that move entries to the means of their colours.
const ROUNDS: usize = 3;

fn channels(color: PackedColor) -> [i32; 3] {
    let [_, red, green, blue] = color.to_be_bytes();
    [red, green, blue].map(i32::from)
}

/// Returns the square of the weighted distance of two colours, in square steps of 255 (the weights' sum makes it three times too
/// large).
pub(super) fn distance(a: PackedColor, b: PackedColor) -> f32 {
    let (a, b) = (channels(a), channels(b));
    let sum: i32 = (0..3).map(|channel| WEIGHTS[channel] * (a[channel] - b[channel]).pow(2)).sum();
    sum as f32 / 3.0
}

/// Returns at most `room` colours for a picture that has more.
pub(super) fn choose(histogram: &Histogram, room: usize) -> Vec<PackedColor> {
    let pixels: f64 = histogram.iter().map(|(_, count)| f64::from(*count)).sum();
    let mut by_count = histogram.clone();
    by_count.sort_unstable_by_key(|(color, count)| (std::cmp::Reverse(*count), *color));
    let flat_room = (room as f64 * FLAT_ENTRIES) as usize;
    let flat_count = by_count.iter().take(flat_room).take_while(|(_, n)| f64::from(*n) >= pixels * FLAT_SHARE).count();
    let others = by_count.split_off(flat_count);
    let mut colors: Vec<PackedColor> = by_count.iter().map(|(color, _)| *color).collect();
    fill(&mut colors, &others, room);
    for _ in 0..ROUNDS {
        move_to_means(&mut colors, flat_count, &others);
    }
    colors.sort_unstable();
    colors.dedup();
    colors
}

/// Adds colours of a histogram up to so many: each time the one whose pixels the others serve worst.
fn fill(colors: &mut Vec<PackedColor>, histogram: &Histogram, room: usize) {
    let mut errors = vec![f32::INFINITY; histogram.len()];
    let mut known = 0;
    while known < room {
        for added in &colors[known..] {
            errors
                .iter_mut()
                .zip(histogram)
                .for_each(|(error, (color, _))| *error = error.min(distance(*color, *added)));
        }
        known = colors.len();
        let weight = |index: usize| errors[index] * histogram[index].1 as f32;
        let worst = (0..histogram.len()).max_by(|a, b| weight(*a).total_cmp(&weight(*b)));
        let Some(worst) = worst.filter(|worst| known < room && errors[*worst] > 0.0) else { return };
        colors.push(histogram[worst].0);
    }
}

/// Moves all entries except the first, fixed ones to the mean of their nearest colours.
fn move_to_means(colors: &mut [PackedColor], fixed: usize, histogram: &Histogram) {
    let mut sums = vec![[0.0f64; 4]; colors.len()];
    for (color, count) in histogram {
        let sum = &mut sums[nearest(*color, colors)];
        let count = f64::from(*count);
        channels(*color).iter().zip(sum.iter_mut()).for_each(|(value, sum)| *sum += f64::from(*value) * count);
        sum[3] += count;
    }
    for (color, [red, green, blue, count]) in colors.iter_mut().zip(sums).skip(fixed).filter(|(_, sum)| sum[3] > 0.0) {
        let [red, green, blue] = [red, green, blue].map(|sum| (sum / count).round() as u8);
        *color = u32::from_be_bytes([0, red, green, blue]);
    }
}

fn nearest(color: PackedColor, colors: &[PackedColor]) -> usize {
    let distances = colors.iter().map(|entry| distance(color, *entry)).enumerate();
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}

/// Returns two entries, at `first_color` or later, and their shares; their mix is nearest to a colour without being rough.
pub(super) fn mix(color: PackedColor, colors: &[PackedColor], first_color: usize) -> Mix {
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
