//! Frames that take turns, which makes a busy moment hit all settings alike, and the comparison of two series of them.

use serde::Serialize;
use std::sync::Arc;
use tinta::error::Result;
use tinta::plan::Plan;
use tinta::renderer::{Renderer, median};
use tinta::scene::Scene;
use tinta::styles::{Show, Style};

/// Measured frames.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// Their median, milliseconds.
    pub median_ms: f64,
    /// All of them, in the order measured.
    pub frames_ms: Vec<f64>,
}

impl Series {
    pub(super) fn new(frames_ms: Vec<f64>) -> Self {
        Self { median_ms: median(frames_ms.clone()).unwrap_or_default(), frames_ms }
    }

    /// Frames per second, by the median.
    pub fn frames_per_second(&self) -> f64 {
        1e3 / self.median_ms
    }
}

/// Rates nearer to each other than this are equal, percent: medians of a busy machine differ by as much.
pub(super) const EQUAL_PERCENT: f64 = 3.0;

/// How much more frames a second `one` gives than `other`, percent: the median of the ratios within a turn, which a busy
/// moment's frames, slow for both, do not move.
pub(super) fn gain_percent(one: &Series, other: &Series) -> f64 {
    let ratios = other.frames_ms.iter().zip(&one.frames_ms).map(|(other, one)| other / one);
    (median(ratios.collect()).unwrap_or(1.0) - 1.0) * 100.0
}

/// A plan that takes its turns.
pub(super) struct Contestant {
    pub(super) scene: Arc<Scene>,
    pub(super) plan: Plan,
    pub(super) times: Vec<f64>,
}

impl Contestant {
    pub(super) fn new(scene: &Arc<Scene>, plan: Plan) -> Self {
        Self { scene: scene.clone(), plan, times: Vec::new() }
    }

    pub(super) fn styled(scene: &Arc<Scene>, style: &Style) -> Result<Self> {
        Ok(Self::new(scene, style.plan(scene, Show::Final)?))
    }

    pub(super) fn series(&self) -> Series {
        Series::new(self.times.clone())
    }
}

/// All contestants' frames, one of each at a time.
pub(super) fn take_turns(
    renderer: &mut Renderer,
    contestants: &mut [Contestant],
    frames: usize,
    step: &mut impl FnMut(),
) -> Result<()> {
    for _ in 0..frames {
        for Contestant { scene, plan, times } in contestants.iter_mut() {
            // A frame that follows one of another kind also clears up after that one: up to a fifth of a large scene's frame on a
            // software renderer. Each frame therefore follows an untimed one of its kind, as in an animation.
            times.extend(renderer.time_frames(scene, plan, 1, 1)?);
        }
        step();
    }
    Ok(())
}
