//! Ranges along a line, each between two shares of its length: their union, gaps, and what linear functions leave of them.

/// Whether a place lies in one of ascending, disjoint ranges.
pub(crate) fn hold(ranges: &[[f64; 2]], place: f64) -> bool {
    let next = ranges.partition_point(|range| range[1] <= place);
    ranges.get(next).is_some_and(|range| range[0] <= place)
}

/// Whether two ranges have a place in common, be it an end.
pub(crate) fn meet(first: [f64; 2], second: [f64; 2]) -> bool {
    first[0] <= second[1] && first[1] >= second[0]
}

/// Returns ranges, given in any order, as ascending, disjoint ones.
pub(crate) fn united(mut ranges: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    ranges.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let mut united: Vec<[f64; 2]> = Vec::with_capacity(ranges.len());
    for range in ranges {
        match united.last_mut() {
            Some(last) if range[0] <= last[1] => last[1] = last[1].max(range[1]),
            _ => united.push(range),
        }
    }
    united
}

/// Returns the gaps that ranges leave in a stretch. The ranges that meet the stretch must ascend.
pub(crate) fn gaps(stretch: [f64; 2], ranges: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut gaps = Vec::new();
    let mut from = stretch[0];
    for range in ranges.iter().filter(|range| range[1] > stretch[0] && range[0] < stretch[1]) {
        if range[0] > from {
            gaps.push([from, range[0]]);
        }
        from = from.max(range[1]);
    }
    if from < stretch[1] {
        gaps.push([from, stretch[1]]);
    }
    gaps
}

/// Returns ascending, disjoint ranges of a stretch and the gaps between them, in order, each with whether it is a range.
pub(crate) fn with_gaps(stretch: [f64; 2], ranges: &[[f64; 2]]) -> Vec<([f64; 2], bool)> {
    let mut all: Vec<_> = ranges.iter().map(|range| (*range, true)).collect();
    all.extend(gaps(stretch, ranges).into_iter().map(|gap| (gap, false)));
    all.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    all
}

/// Returns the stretch of a range where a linear function is not negative, from the function's values at the range's ends.
pub(crate) fn above_zero([from, to]: [f64; 2], [start, end]: [f64; 2]) -> Option<[f64; 2]> {
    match (start >= 0.0, end >= 0.0) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, from + (to - from) * (start / (start - end))]),
        (false, true) => Some([from + (to - from) * (start / (start - end)), to]),
        (false, false) => None,
    }
}

/// Returns the overlap of a range with the stretch of `whole` where a linear function, given by its values at the ends, is not
/// negative.
pub(crate) fn clipped(range: Option<[f64; 2]>, whole: [f64; 2], at_ends: [f64; 2]) -> Option<[f64; 2]> {
    common(range?, above_zero(whole, at_ends)?)
}

/// Returns the stretch of a range in which a value that grows linearly, `start + along * place`, lies between two limits (Liang and
/// Barsky 1984).
pub(crate) fn between(range: [f64; 2], start: f64, along: f64, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
    if along == 0.0 {
        return (low <= start && start <= high).then_some(range);
    }
    let (one, other) = ((low - start) / along, (high - start) / along);
    let range = [range[0].max(one.min(other)), range[1].min(one.max(other))];
    (range[0] <= range[1]).then_some(range)
}

/// Returns the overlap of two ranges, if it has a length.
pub(crate) fn common(first: [f64; 2], second: [f64; 2]) -> Option<[f64; 2]> {
    let common = [first[0].max(second[0]), first[1].min(second[1])];
    (common[0] < common[1]).then_some(common)
}
