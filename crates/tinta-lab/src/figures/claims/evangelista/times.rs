//! The claims about time: rules on section 5's numbers, and frames timed for a claim.

use super::super::finding::{Finding, Number};
use super::super::lab::Lab;
use crate::figures::measure::{covered, from};
use crate::figures::numbers::{BackgroundRow, Numbers};
use crate::figures::series::{Interval, gain_percent};
use crate::figures::throughput::ShaderRow;
use glam::DVec3;
use std::sync::Arc;
use tinta::camera::{CameraSettings, View};
use tinta::error::Result;
use tinta::mesh::Mesh;
use tinta::scene::{Scene, SceneSettings};
use tinta::styles::{Border, Cartoon, Filter, MapEncoding, Show, Style};

/// The text's graphics card, as its driver names it.
const CARD: &str = "GeForce FX 5200";

/// Least share of a printed percentage that counts as reproducing it.
const FOUND_AGAIN: f64 = 0.5;

/// Least frames a second that the eye sees as motion, as in the cinema.
const REAL_TIME: f64 = 24.0;

/// How many points count as a great variation of the gain.
const GREATLY: f64 = 20.0;

fn three_pass(border: Border) -> Style {
    Style::ThreePass(Cartoon { border: Some(border), ..Cartoon::default() })
}

/// Frames of the gear in two styles, the second's price.
fn price(lab: &mut Lab<'_>, what: &'static str, styles: [Style; 2]) -> Result<Finding> {
    let slower = lab.slower_percent("builtin:gear", &styles)?;
    Ok(Finding::of_repeats(slower.is_positive(), vec![Number::percents(what, slower)]))
}

pub(super) fn mitchell_in_two(lab: &mut Lab<'_>) -> Result<Finding> {
    let with = |filter| three_pass(Border { filter, ..Border::default() });
    price(lab, "longer with two programs", [with(Filter::Mitchell), with(Filter::MitchellTwo)])
}

pub(super) fn second_texture(lab: &mut Lab<'_>) -> Result<Finding> {
    let with = |map_encoding| Style::ThreePass(Cartoon { map_encoding, ..Cartoon::default() });
    price(lab, "longer with a second texture", [with(MapEncoding::Biased), with(MapEncoding::DepthTexture)])
}

pub(super) fn nine_reads(numbers: &Numbers) -> Finding {
    let [.., four, eight] = numbers.shaders.as_slice() else { return Finding::nowhere("no shader was timed") };
    let longer = eight.against(&[four], |ratio| (ratio - 1.0) * 100.0);
    Finding::of_repeats(longer.is_positive(), vec![Number::percents("longer with nine reads", longer)])
}

/// A rule on a rate or a percentage that the text measured on its graphics card: only that card decides it.
fn on_a_card(numbers: &Numbers, holds: Option<bool>, measured: Vec<Number>) -> Finding {
    match numbers.host.renderer.contains(CARD) {
        true => Finding::of_repeats(holds, measured),
        false => Finding::undecided(
            "the text's number is that of a GeForce FX 5200, and another renderer draws here",
            measured,
        ),
    }
}

pub(super) fn cheaper_filter(numbers: &Numbers) -> Finding {
    let Some(gain) = numbers.filter_gain_percent() else { return Finding::nowhere("no filter was timed") };
    let limit = numbers.article.filter_gain_percent * FOUND_AGAIN;
    on_a_card(numbers, gain.is_above(limit), vec![Number::percents("more frames a second", gain)])
}

pub(super) fn two_always_slower(numbers: &Numbers) -> Finding {
    let gains = numbers.gains_of_two();
    let are_slower: Vec<Option<bool>> =
        gains.iter().map(|gain| gain.is_positive().map(|is_faster| !is_faster)).collect();
    let count = |wanted: Option<bool>| are_slower.iter().filter(|is| **is == wanted).count();
    let decided = if count(Some(false)) > 0 { Some(false) } else { (count(None) == 0).then_some(true) };
    Finding::of_repeats(
        decided,
        vec![
            Number::count("cases", gains.len()),
            Number::percents("the fastest against three", extreme(&gains, f64::max)),
            Number::percents("the slowest", extreme(&gains, f64::min)),
        ],
    )
}

/// The interval with the largest or the smallest median.
fn extreme(intervals: &[Interval], choose: fn(f64, f64) -> f64) -> Interval {
    let middle = intervals.iter().map(|interval| interval.middle).reduce(choose);
    intervals.iter().copied().find(|interval| Some(interval.middle) == middle).unwrap_or(Interval::of(Vec::new()))
}

/// The gains of two passes without the square over three, from near to far.
fn gains(numbers: &Numbers) -> Vec<Interval> {
    numbers.backgrounds.iter().map(BackgroundRow::gain_percent).collect()
}

pub(super) fn without_square(numbers: &Numbers) -> Finding {
    let best = extreme(&gains(numbers), f64::max);
    let limit = numbers.article.background_gain_percent * FOUND_AGAIN;
    on_a_card(numbers, best.is_above(limit), vec![Number::percents("largest gain", best)])
}

pub(super) fn gain_varies(numbers: &Numbers) -> Finding {
    let gains = gains(numbers);
    let [least, most] = [extreme(&gains, f64::min), extreme(&gains, f64::max)];
    let row = |of: Interval| numbers.backgrounds.iter().find(|row| row.gain_percent() == of);
    let (Some(worst), Some(best)) = (row(least), row(most)) else {
        return Finding::nowhere("no distance was measured");
    };
    Finding::of_repeats(
        best.gains_more_than(worst).is_above(GREATLY),
        vec![Number::percents("smallest gain", least), Number::percents("largest", most)],
    )
}

/// A gain against that of the bust that fills the picture; `sign` is 1 where it should be larger.
fn against_whole(numbers: &Numbers, distance: f64, what: &'static str, sign: f64) -> Finding {
    let row = |distance: f64| numbers.backgrounds.iter().find(|row| (row.distance - distance).abs() < 1e-9);
    let (Some(whole), Some(other)) = (row(1.0), row(distance)) else {
        return Finding::nowhere("no such distance was measured");
    };
    let [more, less] = if sign > 0.0 { [other, whole] } else { [whole, other] };
    Finding::of_repeats(
        more.gains_more_than(less).is_positive(),
        vec![
            Number::percents(what, other.gain_percent()),
            Number::percents("gain where the bust fills the picture", whole.gain_percent()),
        ],
    )
}

pub(super) fn distant(numbers: &Numbers) -> Finding {
    against_whole(numbers, 3.0, "gain at three times the distance", 1.0)
}

pub(super) fn zoomed(numbers: &Numbers) -> Finding {
    let nearest = numbers.backgrounds.iter().map(|row| row.distance).fold(f64::INFINITY, f64::min);
    against_whole(numbers, nearest, "gain from the nearest place", -1.0)
}

pub(super) fn throughput(numbers: &Numbers) -> Finding {
    let [_, tones, border, joint, ..] = numbers.shaders.as_slice() else {
        return Finding::nowhere("no shader was timed");
    };
    let ratio = joint.against(&[tones, border], |ratio| ratio);
    // The same from the paper's millions of pixels a second.
    let cost = |row: &ShaderRow| row.article_mpixels.map_or(f64::NAN, f64::recip);
    let printed = cost(joint) / (cost(tones) + cost(border));
    Finding::of_repeats(
        ratio.is_above(1.0),
        vec![
            Number::repeated("cost of the joint shader, both others together being 1", ratio, "", 2),
            Number::new("in the paper's numbers", printed, "", 2),
        ],
    )
}

pub(super) fn real_time(numbers: &Numbers) -> Finding {
    let slowest = |passes: u8| {
        let rows = numbers.frames.iter().filter(move |row| row.passes == passes);
        let rates = rows.map(|row| Interval::of(row.series.frames_ms.iter().map(|ms| 1e3 / ms).collect()));
        extreme(&rates.collect::<Vec<_>>(), f64::min)
    };
    let rates = [2, 3].map(slowest);
    let measured = vec![
        Number::repeated("frames a second of two passes in their slowest scene", rates[0], "", 0),
        Number::repeated("of three", rates[1], "", 0),
    ];
    let [two, three] = rates.map(|rate| rate.is_above(REAL_TIME));
    let decided = if [two, three].contains(&Some(false)) { Some(false) } else { two.and(three) };
    on_a_card(numbers, decided, measured)
}

/// How many busts stand in a row, and how far apart, of their width.
const ROW: (usize, f64) = (4, 1.3);

/// The busts in a row across the view or along it.
fn row(lab: &Lab<'_>, direction: DVec3) -> Result<Vec<Arc<Mesh>>> {
    let bust = lab.mesh("builtin:bust")?;
    let (low, high) = bust.bounds();
    let step = direction * (high - low).max_element() * ROW.1;
    let place = |index: usize| {
        let mut mesh = (*bust).clone();
        mesh.positions.iter_mut().for_each(|position| *position += step * index as f64);
        Arc::new(mesh)
    };
    Ok((0..ROW.0).map(place).collect())
}

/// Two passes without the square against three, with four busts that hide each other and with four that do not.
pub(super) fn hidden(lab: &mut Lab<'_>) -> Result<Finding> {
    let settings = SceneSettings { size: lab.size, ..SceneSettings::default() };
    let front = View { azimuth_degrees: 0.0, elevation_degrees: 0.0 };
    let settings = SceneSettings { camera: CameraSettings { view: front, ..settings.camera }, ..settings };
    let beside = Scene::new(row(lab, DVec3::X)?, &settings)?;
    let behind = Scene::new(row(lab, DVec3::NEG_Z)?, &settings)?;
    let wanted = covered(lab.renderer, &beside)?;
    // Nearer covers more: halve the interval until both cover the same share of the picture.
    let (mut near, mut far): (f64, f64) = (0.3, 8.0);
    for _ in 0..10 {
        let middle = (near * far).sqrt();
        let share = covered(lab.renderer, &from(&behind, middle, lab.size)?)?;
        if share > wanted { near = middle } else { far = middle }
    }
    let behind = from(&behind, (near * far).sqrt(), lab.size)?;
    let without = || Style::TwoPass(Cartoon { background_square: false, ..Cartoon::default() });
    let mut frames = Vec::new();
    for scene in [Arc::new(beside), Arc::new(behind)] {
        for style in [without(), Style::ThreePass(Cartoon::default())] {
            frames.push((scene.clone(), style.plan(&scene, Show::Final)?));
        }
    }
    let series = lab.times(frames)?;
    let [beside, behind] = [0, 2].map(|first| gain_percent(&series[first], &series[first + 1]));
    let more =
        Interval::of_turns([0, 1, 2, 3].map(|index| &series[index]), |[two_beside, three_beside, two, three]| {
            (three / two - three_beside / two_beside) * 100.0
        });
    Ok(Finding::of_repeats(
        more.is_positive(),
        vec![
            Number::percents("gain one behind the other", behind),
            Number::percents("side by side", beside),
            Number::share("covered by both", wanted),
        ],
    ))
}
