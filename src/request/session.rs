//! State shared by the jobs of one process: contexts with their programs and textures, and the models last read.
//!
//! A command line opens a context when it needs one and closes it at its end; a batch's worker passes the same session to every
//! job. Contexts belong to the thread that opened them.

use super::ModelCache;
use crate::error::Result;
use crate::gl::Backend;
use crate::mesh::{LoadOptions, LoadedModel};
use crate::plan::Submission;
use crate::renderer::Renderer;

/// Contexts and models.
#[derive(Debug)]
pub struct Session {
    open: fn(Backend) -> Result<Renderer>,
    renderers: Vec<(Backend, Renderer)>,
    /// Other threads use it too: models are read while the first context opens.
    pub models: ModelCache,
    /// How vertices are handed to GL. Default in buffers.
    pub submission: Submission,
}

impl Default for Session {
    fn default() -> Self {
        Self::for_one()
    }
}

impl Session {
    /// For a single job: keeps nothing after it.
    pub fn for_one() -> Self {
        Self::new(Renderer::new, ModelCache::for_one())
    }

    /// For many jobs, with this way to open a context.
    pub fn for_many(open: fn(Backend) -> Result<Renderer>) -> Self {
        Self::new(open, ModelCache::for_many())
    }

    fn new(open: fn(Backend) -> Result<Renderer>, models: ModelCache) -> Self {
        Self { open, renderers: Vec::new(), models, submission: Submission::default() }
    }

    /// With another reader of models, and a function that receives remarks.
    #[must_use]
    pub fn reading(mut self, read: fn(&str, &LoadOptions) -> Result<LoadedModel>, say: fn(&str)) -> Self {
        self.models = self.models.reading(read, say);
        self
    }

    /// Whether this way to OpenGL is open.
    pub(crate) fn has(&self, backend: Backend) -> bool {
        self.renderers.iter().any(|(known, _)| *known == backend)
    }

    /// Opens a context that [`Session::keep`] may be given.
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn open(&self, backend: Backend) -> Result<Renderer> {
        (self.open)(backend)
    }

    /// Keeps an open context for the jobs to come.
    pub fn keep(&mut self, backend: Backend, renderer: Renderer) -> &mut Renderer {
        self.renderers.retain(|(known, _)| *known != backend);
        self.renderers.push((backend, renderer));
        let last = self.renderers.len() - 1;
        &mut self.renderers[last].1
    }

    /// The context that is open, or one that is opened now.
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn renderer(&mut self, backend: Backend) -> Result<&mut Renderer> {
        match self.renderers.iter().position(|(known, _)| *known == backend) {
            Some(place) => Ok(&mut self.renderers[place].1),
            None => {
                let renderer = self.open(backend)?;
                Ok(self.keep(backend, renderer))
            }
        }
    }

    /// How many GL objects all contexts hold.
    pub fn live_objects(&self) -> usize {
        self.renderers.iter().map(|(_, renderer)| renderer.live_objects()).sum()
    }

    /// Closes all contexts, because one of them is lost.
    pub fn close(&mut self) {
        self.renderers.clear();
    }
}
