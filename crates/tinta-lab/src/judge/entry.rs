//! A judged drawing as a row of measured settings, for the same tables and plots.

use super::Judgement;
use crate::measure::{Conditions, FrameTimes, Row, RunTime};
use tinta::scene::{Scene, Size};

/// A drawing and its data besides its ink.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its name, such as the program that drew it.
    pub name: String,
    /// The model as the user named it.
    pub model: String,
    /// The machine's name.
    pub machine: String,
    /// Its drawing time, seconds; 0 if unknown.
    pub seconds: f64,
}

impl Entry {
    /// The row of its judgement.
    pub fn row(&self, scene: &Scene, judgement: &Judgement) -> Row {
        let Size { width, height } = scene.size;
        let frames_ms = if self.seconds > 0.0 { vec![self.seconds * 1e3] } else { Vec::new() };
        let times = FrameTimes { frames_ms, ..FrameTimes::default() };
        Row {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: self.machine.clone(),
            renderer: "none".to_owned(),
            gl_version: String::new(),
            conditions: Conditions::now(),
            model: self.model.clone(),
            triangles: scene.triangle_count(),
            size: [width, height],
            style: self.name.clone(),
            options: self.name.clone(),
            is_faithful: true,
            is_pruned: false,
            has_own_reference: false,
            lines: Some(judgement.lines.clone()),
            tones: None,
            time: RunTime::new([0.0; 3], times, Vec::new()),
        }
    }
}
