//! The claims about lines in the picture, and about Dietrich's method compared with the text's.

use super::super::finding::{Finding, Number};
use super::super::lab::{Error, Lab, MODELS, TOLERANCE_PX};
use crate::figures::figure::{Panel, Shot, panel};
use crate::measure::INK_FROM;
use tinta::camera::{CameraSettings, View};
use tinta::edges::SilhouetteRule;
use tinta::error::Result;
use tinta::picture::Picture;
use tinta::scene::{Scene, SceneSettings};
use tinta::styles::{Dietrich, Inking, PaintMode, Show, Style};

fn lines_of(lab: &mut Lab<'_>, scene: &Scene, inking: Inking) -> Result<Picture> {
    lab.draw(scene, &Style::Inking(Inking { paint: PaintMode::None, ..inking }), Show::Borders)
}

/// Pixels of ink in the lines of a scene.
fn ink_px(lab: &mut Lab<'_>, scene: &Scene, inking: Inking) -> Result<f64> {
    let lines = lines_of(lab, scene, inking)?;
    let is_ink = |pixel: &&[u8]| u8::MAX - pixel[0] >= INK_FROM;
    Ok(lines.pixels.chunks_exact(4).filter(is_ink).count() as f64)
}

/// All ink, faint pixels by their darkness.
fn all_ink(lab: &mut Lab<'_>, scene: &Scene, inking: Inking) -> Result<f64> {
    let lines = lines_of(lab, scene, inking)?;
    Ok(lines.pixels.chunks_exact(4).map(|pixel| f64::from(u8::MAX - pixel[0]) / 255.0).sum())
}

pub(super) fn pushed_back(lab: &mut Lab<'_>) -> Result<Finding> {
    let scene = lab.scene("builtin:gear")?;
    let mut with = |polygon_offset| ink_px(lab, &scene, Inking { polygon_offset, ..Inking::default() });
    let [without, with] = [with([0.0, 0.0])?, with([1.0, 5.0])?];
    Ok(Finding::of(
        with >= without * 1.05,
        vec![
            Number::percent("more ink", (with / without - 1.0) * 100.0),
            Number::new("pixels of ink with faces where they are", without, "", 0),
            Number::new("pushed back by (1, 5)", with, "", 0),
        ],
    ))
}

pub(super) fn points_close_gaps(lab: &mut Lab<'_>) -> Result<Finding> {
    let view = View { azimuth_degrees: 0.0, elevation_degrees: 0.0 };
    let camera = CameraSettings { view, parallel: true, ..CameraSettings::default() };
    let scene = lab.seen("builtin:gear", SceneSettings { camera, ..SceneSettings::default() })?;
    let mut added = |writes_depth| -> Result<f64> {
        let inking = Inking { silhouette: SilhouetteRule::Exact, writes_depth, ..Inking::default() };
        let without = all_ink(lab, &scene, Inking { has_joints: false, ..inking.clone() })?;
        Ok(all_ink(lab, &scene, inking)? - without)
    };
    let [published, depth_left] = [added(true)?, added(false)?];
    Ok(Finding::of(
        published >= depth_left * 0.5 && published > 0.0,
        vec![
            Number::new("ink that points add, pixels", published, "", 0),
            Number::new("where lines leave depth alone", depth_left, "", 0),
        ],
    ))
}

pub(super) fn smoothing_is_slow(lab: &mut Lab<'_>) -> Result<Finding> {
    let with = |is_smooth| Style::Inking(Inking { is_smooth, ..Inking::default() });
    let longer = lab.slower_percent("builtin:bust", &[with(false), with(true)])?;
    let numbers = vec![Number::percents("longer with smoothed lines, here", longer)];
    Ok(Finding::undecided("the sentence is about cards of before 2001, and none is here", numbers))
}

pub(super) fn hidden_edges_stay_hidden(lab: &mut Lab<'_>) -> Result<Finding> {
    let exact = Style::Inking(Inking { silhouette: SilhouetteRule::Exact, ..Inking::default() });
    let error = lab.error(&exact)?;
    Ok(Finding::of(
        error.precision >= 0.99,
        vec![Number::share("of the ink on an exact visible line", error.precision)],
    ))
}

fn dietrich() -> Style {
    Style::Dietrich(Dietrich::default())
}

pub(super) fn dietrich_is_faster(lab: &mut Lab<'_>) -> Result<Finding> {
    let longer = lab.slower_percent("builtin:bust", &[dietrich(), Style::Inking(Inking::default())])?;
    let numbers = vec![Number::percents("longer by inking, edges known", longer)];
    Ok(Finding::of_repeats(longer.is_positive(), numbers))
}

pub(super) fn dietrich_is_less_exact(lab: &mut Lab<'_>) -> Result<Finding> {
    let [inking, dietrich]: [Error; 2] = [lab.error(&Style::Inking(Inking::default()))?, lab.error(&dietrich())?];
    Ok(Finding::of(
        dietrich.f1 < inking.f1,
        vec![Number::new("F1 of Dietrich's lines", dietrich.f1, "", 3), Number::new("of inking's", inking.f1, "", 3)],
    ))
}

pub(super) fn dietrich_panels() -> Vec<Panel> {
    let shown =
        |file: &str, label, style, options: &str| panel(file, label, "builtin:gear", Shot::whole(), style, options);
    let inking = Inking { paint: PaintMode::None, ..Inking::default() };
    vec![
        shown("claim-d-dietrich", "Dietrich's", dietrich(), "--style dietrich"),
        shown("claim-d-inking", "inking", Style::Inking(inking), "--style inking --paint none"),
    ]
}

pub(super) fn dietrich_knows_no_creases(lab: &mut Lab<'_>) -> Result<Finding> {
    let (mut found, mut models) = (0.0, 0usize);
    for model in MODELS {
        let (ink, lines) = (lab.ink(model, &dietrich())?, lab.lines(model)?);
        if let Some(recall) = ink.error(&lines, TOLERANCE_PX).recall_of_class.get("crease") {
            found += recall;
            models += 1;
        }
    }
    let share = found / models.max(1) as f64;
    Ok(Finding::of(share < 0.5, vec![Number::share("of the creases drawn", share)]))
}
