//! The claims about time: rules on section 5's numbers, and frames timed for a claim.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, is_slower};
use crate::figures::measure::{covered, from};
use crate::figures::numbers::{BackgroundRow, Numbers};
use crate::figures::series::{EQUAL_PERCENT, gain_percent};
use glam::DVec3;
use std::sync::Arc;
use tinta::camera::{CameraSettings, View};
use tinta::error::Result;
use tinta::mesh::Mesh;
use tinta::plan::Plan;
use tinta::scene::{Scene, SceneSettings};
use tinta::styles::{Border, Cartoon, Filter, MapEncoding, Show, Style};

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
    let scene = lab.scene("builtin:gear")?;
    let plans: Result<Vec<(Arc<Scene>, Plan)>> =
        styles.iter().map(|style| Ok((scene.clone(), style.plan(&scene, Show::Final)?))).collect();
    let slower = lab.slower_percent(plans?)?[1];
    Ok(Finding::of(is_slower(slower), vec![Number::percent(what, slower)]))
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
    let longer = (eight.square_ms / four.square_ms - 1.0) * 100.0;
    Finding::of(is_slower(longer), vec![Number::percent("longer with nine reads", longer)])
}

pub(super) fn cheaper_filter(numbers: &Numbers) -> Finding {
    let Some(gain) = numbers.filter_gain_percent() else { return Finding::nowhere("no filter was timed") };
    let printed = numbers.article.filter_gain_percent;
    Finding::of(gain >= printed * FOUND_AGAIN, vec![Number::percent("more frames a second", gain)])
}

pub(super) fn two_always_slower(numbers: &Numbers) -> Finding {
    let of_two = numbers.frames.iter().filter(|row| row.passes == 2);
    let gains: Vec<f64> = of_two
        .filter_map(|row| {
            let three = numbers.curve(row.tones, 3).find(|other| other.triangles == row.triangles)?;
            Some(gain_percent(&row.series, &three.series))
        })
        .collect();
    let count = |is: &dyn Fn(f64) -> bool| gains.iter().filter(|gain| is(**gain)).count();
    let slower = count(&|gain| gain < -EQUAL_PERCENT);
    Finding::of(
        slower == gains.len(),
        vec![
            Number::count("cases", gains.len()),
            Number::count("slower", slower),
            Number::count("faster", count(&|gain| gain > EQUAL_PERCENT)),
        ],
    )
}

/// The gains of two passes without the square over three, from near to far.
fn gains(numbers: &Numbers) -> Vec<f64> {
    numbers.backgrounds.iter().map(BackgroundRow::gain_percent).collect()
}

pub(super) fn without_square(numbers: &Numbers) -> Finding {
    let best = gains(numbers).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let printed = numbers.article.background_gain_percent;
    Finding::of(best >= printed * FOUND_AGAIN, vec![Number::percent("largest gain", best)])
}

pub(super) fn gain_varies(numbers: &Numbers) -> Finding {
    let gains = gains(numbers);
    let [least, most] =
        [gains.iter().copied().fold(f64::INFINITY, f64::min), gains.into_iter().fold(f64::NEG_INFINITY, f64::max)];
    Finding::of(
        most - least >= GREATLY,
        vec![Number::percent("smallest gain", least), Number::percent("largest", most)],
    )
}

/// The gain in the row with this distance, relative to the distance at which the bust fills the picture.
fn gain_at(numbers: &Numbers, distance: f64) -> Option<f64> {
    let row = numbers.backgrounds.iter().find(|row| (row.distance - distance).abs() < 1e-9)?;
    Some(row.gain_percent())
}

/// A gain against that of the bust that fills the picture.
fn against_whole(numbers: &Numbers, other: Option<f64>, what: &'static str, sign: f64) -> Finding {
    let (Some(whole), Some(other)) = (gain_at(numbers, 1.0), other) else {
        return Finding::nowhere("no such distance was measured");
    };
    Finding::of(
        (other - whole) * sign >= EQUAL_PERCENT,
        vec![Number::percent(what, other), Number::percent("gain where the bust fills the picture", whole)],
    )
}

pub(super) fn distant(numbers: &Numbers) -> Finding {
    against_whole(numbers, gain_at(numbers, 3.0), "gain at three times the distance", 1.0)
}

pub(super) fn zoomed(numbers: &Numbers) -> Finding {
    let nearest = numbers.backgrounds.iter().min_by(|a, b| a.distance.total_cmp(&b.distance));
    against_whole(numbers, nearest.map(BackgroundRow::gain_percent), "gain from the nearest place", -1.0)
}

pub(super) fn throughput(numbers: &Numbers) -> Finding {
    let [_, tones, border, joint, ..] = numbers.shaders.as_slice() else {
        return Finding::nowhere("no shader was timed");
    };
    let ratio = joint.square_ms / (tones.square_ms + border.square_ms);
    // The same from the paper's millions of pixels a second.
    let cost = |row: &crate::figures::ShaderRow| row.article_mpixels.map_or(f64::NAN, f64::recip);
    let printed = cost(joint) / (cost(tones) + cost(border));
    Finding::of(
        ratio > 1.0,
        vec![
            Number::new("cost of the joint shader, both others together being 1", ratio, "", 2),
            Number::new("in the paper's numbers", printed, "", 2),
        ],
    )
}

pub(super) fn real_time(numbers: &Numbers) -> Finding {
    let slowest = |passes: u8| {
        let rows = numbers.frames.iter().filter(|row| row.passes == passes);
        rows.map(|row| row.series.frames_per_second()).fold(f64::INFINITY, f64::min)
    };
    let [two, three] = [2, 3].map(slowest);
    Finding::of(
        two.min(three) >= REAL_TIME,
        vec![
            Number::new("frames a second of two passes in their slowest scene", two, "", 0),
            Number::new("of three", three, "", 0),
        ],
    )
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
    Ok(Finding::of(
        behind - beside >= EQUAL_PERCENT,
        vec![
            Number::percent("gain one behind the other", behind),
            Number::percent("side by side", beside),
            Number::share("covered by both", wanted),
        ],
    ))
}
