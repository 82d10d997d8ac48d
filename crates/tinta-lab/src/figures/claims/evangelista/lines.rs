//! The claims about which lines are found: ink against the exact visible lines.

use super::super::finding::{Finding, Number};
use super::super::lab::{Lab, MODELS, TOLERANCE_PX};
use crate::figures::figure::{Panel, Shot, panel};
use crate::measure::{Ink, Reference};
use glam::DVec2;
use tinta::error::Result;
use tinta::styles::{Border, Cartoon, Filter, MapEncoding, Show, Style};

/// Least share of found lines, or of correct ink, that counts as precise.
const PRECISELY: f64 = 0.9;

fn with(filter: Filter) -> Style {
    let border = Some(Border { filter, ..Border::default() });
    Style::ThreePass(Cartoon { border, ..Cartoon::default() })
}

pub(super) fn mitchell(lab: &mut Lab<'_>) -> Result<Finding> {
    let error = lab.error(&with(Filter::Mitchell))?;
    Ok(Finding::undecided(
        "of Mitchell's two filters only that of normals and depth is here, not that of normals and object numbers",
        error.numbers(""),
    ))
}

pub(super) fn published(lab: &mut Lab<'_>) -> Result<Finding> {
    let error = lab.error(&with(Filter::Laplacian4))?;
    Ok(Finding::of(error.recall >= PRECISELY && error.precision >= PRECISELY, error.numbers("")))
}

/// Darkness that one filter adds to another's, and how much of it lies on a line.
fn added(one: &Ink, other: &Ink, lines: &Reference) -> [f64; 2] {
    let width = one.size.width as usize;
    let (mut all, mut right) = (0.0, 0.0);
    for (index, (before, after)) in one.darkness.iter().zip(&other.darkness).enumerate() {
        let more = f64::from(after.saturating_sub(*before)) / 255.0;
        if more > 0.0 {
            all += more;
            let middle = DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            right += if lines.distance_px(middle) <= TOLERANCE_PX { more } else { 0.0 };
        }
    }
    [all, right]
}

pub(super) fn too_many(lab: &mut Lab<'_>) -> Result<Finding> {
    let (mut all, mut right, mut before) = (0.0, 0.0, 0.0);
    for model in MODELS {
        let [four, eight] = [lab.ink(model, &with(Filter::Laplacian4))?, lab.ink(model, &with(Filter::Laplacian8))?];
        let [more, on_lines] = added(&four, &eight, &*lab.lines(model)?);
        all += more;
        right += on_lines;
        before += four.darkness.iter().map(|darkness| f64::from(*darkness) / 255.0).sum::<f64>();
    }
    let [four, eight] = [lab.error(&with(Filter::Laplacian4))?, lab.error(&with(Filter::Laplacian8))?];
    let mut numbers = vec![
        Number::share("of the added ink on an exact line", right / all),
        Number::percent("ink added", all / before * 100.0),
    ];
    numbers.extend(four.numbers("simplified"));
    numbers.extend(eight.numbers("full"));
    Ok(Finding::of(right / all < 0.5, numbers))
}

pub(super) fn too_many_panels() -> Vec<Panel> {
    let shown = |file: &str, label, filter, option: &str| {
        panel(file, label, "builtin:bust", Shot::view(20.0, 10.0, "--view 20,10"), with(filter), option)
            .showing(Show::Borders, "borders")
    };
    vec![
        shown("claim-e-too-many-simplified", "simplified", Filter::Laplacian4, ""),
        shown("claim-e-too-many-full", "full", Filter::Laplacian8, "--filter laplacian8"),
    ]
}

pub(super) fn deeper_maps(lab: &mut Lab<'_>) -> Result<Finding> {
    let with = |map_encoding| Style::ThreePass(Cartoon { map_encoding, ..Cartoon::default() });
    let [eight, deeper] = [lab.error(&with(MapEncoding::Biased))?, lab.error(&with(MapEncoding::Float))?];
    Ok(Finding::of(
        deeper.precision_of_all > eight.precision_of_all,
        vec![
            Number::share("of all ink on a line with 8 bits", eight.precision_of_all),
            Number::share("with floating-point numbers", deeper.precision_of_all),
        ],
    ))
}
