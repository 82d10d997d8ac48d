//! Times of frames: by the clock, and of the processor.

use tinta::error::Result;
use tinta::plan::Plan;
use tinta::renderer::{Renderer, milliseconds_since, processor_milliseconds};
use tinta::scene::Scene;
use tinta_geometry::clock::Instant;

/// Times of frames in the order measured, milliseconds.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct FrameTimes {
    /// By the clock, each ended by reading the picture back.
    pub frames_ms: Vec<f64>,
    /// Processor time of each, all threads; empty where a device draws or the system does not tell it. The load of other programs
    /// changes it far less than the clock's time.
    pub processor_ms: Vec<f64>,
}

impl FrameTimes {
    /// Draws a plan's frame and adds its times.
    ///
    /// # Errors
    ///
    /// As [`Renderer::draw`].
    pub(crate) fn add_frame(&mut self, renderer: &mut Renderer, scene: &Scene, plan: &Plan) -> Result<()> {
        let before = processor_milliseconds().filter(|_| renderer.context().is_software());
        self.frames_ms.extend(renderer.time_frames(scene, plan, 0, 1)?);
        self.add_processor_since(before);
        Ok(())
    }

    /// Does some work on the processor and adds its times.
    ///
    /// # Errors
    ///
    /// Those of the work.
    pub(crate) fn add_work(&mut self, work: impl FnOnce() -> Result<()>) -> Result<()> {
        let (before, start) = (processor_milliseconds(), Instant::now());
        work()?;
        self.frames_ms.push(milliseconds_since(start));
        self.add_processor_since(before);
        Ok(())
    }

    fn add_processor_since(&mut self, before: Option<f64>) {
        self.processor_ms.extend(before.zip(processor_milliseconds()).map(|(before, after)| after - before));
    }
}

/// Lower and upper quartile; 0 without values.
pub(crate) fn quartiles(times: &[f64]) -> [f64; 2] {
    let mut sorted = times.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    [1, 3].map(|quarter| sorted.get(sorted.len() * quarter / 4).copied().unwrap_or_default())
}
