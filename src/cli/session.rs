//! What the jobs of one process share: contexts with their programs and textures, and the models last read.
//!
//! A command line opens what it needs and leaves it at its end; a batch's worker hands the same session to every job. Contexts
//! belong to the thread that opened them.

use super::model_cache::ModelCache;
use tinta::{Backend, Renderer, Result};

/// Contexts and models.
pub(super) struct Session {
    open: fn(Backend) -> Result<Renderer>,
    renderers: Vec<(Backend, Renderer)>,
    /// What the job at hand draws by.
    used: Option<Backend>,
    /// Also for other threads: models are read while the first context opens.
    pub model_cache: ModelCache,
}

impl Session {
    /// For one job: nothing is kept that it does not need.
    pub(super) fn for_one() -> Self {
        Self { open: Renderer::new, renderers: Vec::new(), used: None, model_cache: ModelCache::for_one() }
    }

    /// For many jobs, with this way to open a context.
    pub(super) fn for_many(open: fn(Backend) -> Result<Renderer>) -> Self {
        Self { open, renderers: Vec::new(), used: None, model_cache: ModelCache::for_many() }
    }

    /// Whether this way to OpenGL is open.
    pub(super) fn has(&self, backend: Backend) -> bool {
        self.renderers.iter().any(|(known, _)| *known == backend)
    }

    /// Opens a context that [`Session::keep`] may be given.
    pub(super) fn open(&self, backend: Backend) -> Result<Renderer> {
        (self.open)(backend)
    }

    /// Keeps an open context for the jobs to come.
    pub(super) fn keep(&mut self, backend: Backend, renderer: Renderer) -> &mut Renderer {
        self.renderers.retain(|(known, _)| *known != backend);
        self.renderers.push((backend, renderer));
        self.used = Some(backend);
        let last = self.renderers.len() - 1;
        &mut self.renderers[last].1
    }

    /// The context that is open, or one that is opened now.
    pub(super) fn renderer(&mut self, backend: Backend) -> Result<&mut Renderer> {
        match self.renderers.iter().position(|(known, _)| *known == backend) {
            Some(place) => {
                self.used = Some(backend);
                Ok(&mut self.renderers[place].1)
            }
            None => {
                let renderer = self.open(backend)?;
                Ok(self.keep(backend, renderer))
            }
        }
    }

    /// The context that was asked for since this was asked last.
    pub(super) fn take_used(&mut self) -> Option<&Renderer> {
        let used = self.used.take()?;
        self.renderers.iter().find(|(known, _)| *known == used).map(|(_, renderer)| renderer)
    }

    /// How many GL objects all contexts hold.
    #[cfg(test)]
    pub(super) fn live_objects(&self) -> usize {
        self.renderers.iter().map(|(_, renderer)| renderer.live_objects()).sum()
    }

    /// Lets go of all contexts: one of them is lost.
    pub(super) fn close(&mut self) {
        self.renderers.clear();
    }
}
