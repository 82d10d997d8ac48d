//! Messages from threads to the viewer, and how they wake it.

use crate::error::{Error, Result};
use crate::gl::ContextInfo;
use crate::mesh::LoadOptions;
use crate::pixel::Explanation;
use crate::scene::Scene;
use crate::window::threads::job::{Cost, Drawing, FoundLines};
use crate::window::threads::line_measure::LineScore;
use crate::window::values::event::Side;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// News from a thread.
#[derive(Debug)]
pub(crate) enum Report {
    /// A drawing thread has something to draw with.
    Renderer(usize, Box<ContextInfo>),
    /// A thread has no renderer.
    NoRenderer(usize, Error),
    /// A job is done; where a new shader was refused, its log.
    Drawn {
        /// The drawing thread.
        thread: usize,
        /// The pictures.
        drawings: Vec<Drawing>,
        /// The driver's message.
        shader_log: Option<String>,
    },
    /// A drawing thread's job cannot be done.
    NotDrawn(usize, Error),
    /// The cost of a job, and the scene it draws.
    Cost {
        /// The scene.
        scene: Box<Scene>,
        /// A cost for each side.
        costs: Vec<Cost>,
    },
    /// The measurement of a job's cost failed.
    NotPriced(Error),
    /// A pixel explained, or why not.
    Explained(Box<Result<Explanation>>),
    /// A drawing thread has new shaders.
    ShadersTaken,
    /// It has refused them and uses those before.
    ShadersRefused(Error),
    /// Progress of loading: the number of the load, and its stage.
    Stage(u64, Stage),
    /// Models are loaded: the number of the load, and the models.
    Loaded(u64, Box<LoadedModels>),
    /// Models cannot be loaded.
    NotLoaded(u64, Error),
    /// The error of a side's lines against the exact ones.
    Measured(u64, Vec<(Side, LineScore)>),
    /// The exact lines of a view, or the reason why they failed.
    Lines(Box<Result<FoundLines>>),
    /// Chosen models, possibly none.
    Chosen(Vec<String>),
    /// A model's file has changed.
    ModelChanged,
    /// Shaders' files have changed: their texts by their paths below `glsl/`.
    ShadersChanged(HashMap<String, String>),
    /// A file was written, or why not.
    Saved(String),
}

/// Models that were read.
#[derive(Debug)]
pub(crate) struct LoadedModels {
    /// As the user named them.
    pub models: Vec<String>,
    /// How they were read.
    pub options: LoadOptions,
    /// Their files and the files read with them.
    pub files: Vec<PathBuf>,
    /// They at their places.
    pub scene: Arc<Scene>,
    /// Remarks to show once.
    pub remarks: Vec<String>,
}

/// How far reading is.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// The current stage.
    pub text: String,
    /// Steps done, share of all; steps take different times.
    pub share: f32,
}

/// Sends the viewer reports and wakes it.
#[derive(Clone)]
pub(crate) struct Reporter {
    sender: Sender<Report>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl std::fmt::Debug for Reporter {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Reporter").finish_non_exhaustive()
    }
}

impl Reporter {
    /// Sends reports here and calls `wake` after each.
    pub(crate) fn new(sender: Sender<Report>, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { sender, wake: Arc::new(wake) }
    }

    /// Sends the report; a closed receiver is no error.
    pub(crate) fn say(&self, report: Report) {
        if self.sender.send(report).is_ok() {
            (self.wake)();
        }
    }
}
