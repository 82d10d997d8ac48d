//! Frames that take turns, which makes a busy moment hit all settings alike, and comparisons of them by the quartiles of the
//! turns.

use crate::measure::{FrameTimes, quartiles};
use serde::Serialize;
use std::sync::Arc;
use tinta::error::Result;
use tinta::plan::Plan;
use tinta::renderer::{Renderer, median};
use tinta::scene::Scene;
use tinta::styles::{Show, Style};

/// Measured frames.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Series {
    /// Their median, milliseconds.
    pub median_ms: f64,
    /// All of them, in the order measured.
    pub frames_ms: Vec<f64>,
    /// Processor time of each, all threads; empty where a device draws or the system does not tell it.
    pub processor_ms: Vec<f64>,
}

impl Series {
    /// Frames per second, by the median.
    pub(crate) fn frames_per_second(&self) -> f64 {
        1e3 / self.median_ms
    }

    /// What a frame costs, milliseconds: its processor time where a program draws, because the load of other programs hardly
    /// changes it; otherwise the clock's time.
    pub(super) fn cost_ms(&self) -> &[f64] {
        if self.processor_ms.is_empty() { &self.frames_ms } else { &self.processor_ms }
    }
}

/// A number measured in every turn: its median and quartiles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Interval {
    /// The median.
    pub middle: f64,
    /// Lower and upper quartile.
    pub quartiles: [f64; 2],
}

impl Interval {
    /// Of these values, one a turn.
    pub(super) fn of(values: Vec<f64>) -> Self {
        let quartiles = quartiles(&values);
        Self { middle: median(values).unwrap_or(f64::NAN), quartiles }
    }
}

/// How much more frames for the same cost `one` gives than `other`, percent, computed in each turn.
pub(super) fn gain_percent(one: &Series, other: &Series) -> Interval {
    let turns = one.cost_ms().iter().zip(other.cost_ms());
    Interval::of(turns.map(|(one, other)| (other / one - 1.0) * 100.0).collect())
}

/// A plan that takes its turns.
pub(super) struct Contestant {
    pub(super) scene: Arc<Scene>,
    pub(super) plan: Plan,
    pub(super) times: FrameTimes,
}

impl Contestant {
    pub(super) fn new(scene: &Arc<Scene>, plan: Plan) -> Self {
        Self { scene: scene.clone(), plan, times: FrameTimes::default() }
    }

    pub(super) fn styled(scene: &Arc<Scene>, style: &Style) -> Result<Self> {
        Ok(Self::new(scene, style.plan(scene, Show::Final)?))
    }

    pub(super) fn series(&self) -> Series {
        let FrameTimes { frames_ms, processor_ms } = self.times.clone();
        Series { median_ms: median(frames_ms.clone()).unwrap_or_default(), frames_ms, processor_ms }
    }
}

/// All contestants' frames, one of each at a time.
pub(super) fn take_turns(
    renderer: &mut Renderer,
    contestants: &mut [Contestant],
    frames: usize,
    step: &mut impl FnMut(),
) -> Result<()> {
    if let Some(first) = contestants.first() {
        renderer.raise_clock(&first.scene, &first.plan)?;
    }
    for _ in 0..frames {
        for Contestant { scene, plan, times } in contestants.iter_mut() {
            // A frame that follows one of another kind also clears up after that one: up to a fifth of a large scene's frame on a
            // software renderer. Each frame therefore follows an untimed one of its kind, as in an animation.
            renderer.time_frames(scene, plan, 0, 1)?;
            times.add_frame(renderer, scene, plan)?;
        }
        step();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_the_median_and_the_quartiles() {
        let interval = Interval::of((1..=21).map(f64::from).collect());
        assert_eq!((interval.middle, interval.quartiles), (11.0, [6.0, 16.0]));
    }

    #[test]
    fn processor_time_is_compared_where_it_is_known() {
        let clock = Series { frames_ms: vec![2.0, 8.0], ..Series::default() };
        let slow = Series { frames_ms: vec![9.0, 9.0], processor_ms: vec![4.0, 16.0], ..Series::default() };
        assert_eq!(gain_percent(&clock, &slow).middle, 100.0);
    }
}
