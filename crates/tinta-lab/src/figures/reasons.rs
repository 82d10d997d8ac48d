//! Why our numbers differ from the article's: sentences that follow from the measurements and from GL's description of itself.

use super::numbers::{BackgroundRow, FrameRow, Host, Numbers, Reason};
use super::series::{Interval, gain_percent};
use super::throughput::ShaderRow;

/// All sentences, by their subject.
pub(super) fn reasons(numbers: &Numbers) -> Vec<Reason> {
    let about = |about, sentences: Vec<Option<String>>| {
        sentences.into_iter().flatten().map(move |sentence| Reason { about, sentence })
    };
    let frames = vec![Some(drawn_by(&numbers.host)), growth(numbers), passes(numbers), tones(numbers)];
    let all = about("frames", frames)
        .chain(about("filter", vec![filter(numbers)]))
        .chain(about("background", vec![background(numbers), nature_of_square(numbers)]))
        .chain(about("throughput", vec![Some(nature_of_theirs()), shares(numbers), joint(numbers)]));
    all.collect()
}

fn drawn_by(host: &Host) -> String {
    let Host { renderer, threads, .. } = host;
    match host.is_software {
        true => format!(
            "Here {renderer} draws, a program on {threads} {} of the processor, where vertices, shading and read-back \
             share the same cores; the paper had a GeForce FX 5200, whose units for vertices and pixels work side by side.",
            if *threads == 1 { "thread" } else { "threads" }
        ),
        false => format!(
            "Here {renderer} draws, another device than the paper's GeForce FX 5200; each of our frames ends with the \
             picture read back into memory, which the paper's need not do.",
        ),
    }
}

/// The quantity that a frame's time grows with.
fn growth(numbers: &Numbers) -> Option<String> {
    let mut curve = numbers.curve(3, 3);
    let first = curve.next()?;
    let last = curve.last()?;
    let (start, end) = (first.series.median_ms, last.series.median_ms);
    let covered = |triangles| numbers.scenes.iter().find(|scene| scene.mix.triangles == triangles).map(|s| s.covered);
    let (from, to) = (covered(first.triangles)?, covered(last.triangles)?);
    let per_million = (end - start) / (last.triangles - first.triangles) as f64 * 1e6;
    let what = if per_million > 0.0 {
        format!(
            "{:.0} % of the last scene's time comes with its triangles, {per_million:.0} ms for a million",
            (end - start) / end * 100.0
        )
    } else {
        "triangles cost nothing that could be measured".to_owned()
    };
    Some(format!(
        "From the first to the last scene triangles grow {:.0} times, three passes in three tones from {start:.1} to \
         {end:.1} ms, while the models cover {:.0} % and then {:.0} % of the picture: {what}; a frame of nothing but a clear \
         and the read-back takes {:.1} ms.",
        last.triangles as f64 / first.triangles as f64,
        from * 100.0,
        to * 100.0,
        numbers.empty.median_ms
    ))
}

/// Two passes against three.
fn passes(numbers: &Numbers) -> Option<String> {
    let gains = numbers.gains_of_two();
    let middles = || gains.iter().map(|gain| gain.middle);
    let (least, most) = (middles().reduce(f64::min)?, middles().reduce(f64::max)?);
    Some(format!(
        "Two passes change the frames a second of three by {} to {} in {} cases; the paper finds them slower throughout. Both \
         forms draw every triangle twice, and what remains between them is a filter over the whole picture, blended, against \
         one joined to the tones.",
        signed(least),
        signed(most),
        gains.len()
    ))
}

/// One, two, three tones.
fn tones(numbers: &Numbers) -> Option<String> {
    let mut spread: f64 = 0.0;
    for row in &numbers.frames {
        let same = |other: &&FrameRow| other.triangles == row.triangles && other.passes == row.passes;
        let gains = numbers.frames.iter().filter(same).map(|other| gain_percent(&row.series, &other.series).middle);
        spread = gains.fold(spread, f64::max);
    }
    spread.is_finite().then(|| {
        format!(
            "Within a scene the number of tones changes the frames a second by {spread:.0} % at most: fewer tones are the same shader \
             with its thresholds out of reach, which spares no light's computation; how the paper's own shaders of \
             one and two tones looked it does not print."
        )
    })
}

/// The cheaper filter.
fn filter(numbers: &Numbers) -> Option<String> {
    let frame = numbers.filter_gain_percent()?.middle;
    let [.., four, eight] = numbers.shaders.as_slice() else { return None };
    let alone = (eight.square_ms / four.square_ms - 1.0) * 100.0;
    // The square was timed on four times the pixels.
    let whole = Interval::of(numbers.filters.first()?.series.cost_ms().to_vec()).middle;
    let share = four.square_ms / 4.0 / whole * 100.0;
    if !(alone.is_finite() && share.is_finite()) {
        return Some("The filters' squares took no measurable time here.".to_owned());
    }
    Some(format!(
        "The filter of five reads in place of nine changes the frames a second by {}, the border's square alone by {} (paper: \
         {} for its scene); in our smallest scene the border's shading is about {share:.0} % of the frame.",
        signed(frame),
        signed(alone),
        signed(numbers.article.filter_gain_percent)
    ))
}

/// Two passes without the square.
fn background(numbers: &Numbers) -> Option<String> {
    let by_gain = |a: &&BackgroundRow, b: &&BackgroundRow| a.gain_percent().middle.total_cmp(&b.gain_percent().middle);
    let (best, worst) = (numbers.backgrounds.iter().max_by(by_gain)?, numbers.backgrounds.iter().min_by(by_gain)?);
    Some(format!(
        "Against three passes the gain is largest, {}, where the bust covers {:.0} % of the picture, and smallest, {}, where it \
         covers {:.0} % (paper: up to {}, most where objects are far away).",
        signed(best.gain_percent().middle),
        best.covered * 100.0,
        signed(worst.gain_percent().middle),
        worst.covered * 100.0,
        signed(numbers.article.background_gain_percent)
    ))
}

/// The time saved by leaving out the square.
fn nature_of_square(numbers: &Numbers) -> Option<String> {
    let far = numbers.backgrounds.iter().min_by(|a, b| a.covered.total_cmp(&b.covered))?;
    let left = far.two_pass_without.median_ms;
    let empty = numbers.empty.median_ms;
    (left > 0.0).then(|| {
        format!(
            "From farthest away two passes without the square still take {left:.1} ms, {:.0} % of that for the clear and \
             the read-back of an empty frame alone and the rest mostly for the model's triangles, drawn twice, and the \
             map's copy: no shading saved can take those away.",
            (empty / left * 100.0).min(100.0)
        )
    })
}

/// The meaning of the article's throughputs.
fn nature_of_theirs() -> String {
    "The paper's four are reckoned by NVShaderPerf from the compiled fragment programs, 400 million pixels a second divided \
     by 1, 11, 14 and 25.5 steps of the chip; ours are times of squares that fill a picture, with the writing of every pixel."
        .to_owned()
}

/// Our shaders' costs in the map's.
fn shares(numbers: &Numbers) -> Option<String> {
    let cost = |row: &ShaderRow| row.mpixels.map(f64::recip);
    let [map, tones, border, joint, ..] = numbers.shaders.as_slice() else { return None };
    let map = cost(map)?;
    let [tones, border, joint] = [cost(tones)? / map, cost(border)? / map, cost(joint)? / map];
    Some(format!(
        "A pixel of tones, of the border and of both in one costs {tones:.1}, {border:.1} and {joint:.1} times a pixel of the \
         map here, against 11, 14 and 25.5 on the paper's chip; the writing of the pixel is in all of ours."
    ))
}

/// Two shaders one after the other against one.
fn joint(numbers: &Numbers) -> Option<String> {
    let [_, tones, border, joint, ..] = numbers.shaders.as_slice() else { return None };
    let ratio = joint.square_ms / (tones.square_ms + border.square_ms);
    (ratio.is_finite() && ratio > 0.0).then(|| {
        format!(
            "The joint shader costs {ratio:.2} times the cost of the two others together (in the paper's numbers 1.02)."
        )
    })
}

/// A whole number of per cent with its sign; zero has none.
pub(super) fn signed(percent: f64) -> String {
    let whole = percent.round();
    if whole == 0.0 { "0 %".to_owned() } else { format!("{whole:+} %") }
}

#[cfg(test)]
mod tests;
