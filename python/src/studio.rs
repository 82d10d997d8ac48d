//! The drawing thread: OpenGL's contexts belong to the thread that opened them, and Python's threads come and go. One thread
//! keeps the contexts, their programs and their mesh data, and draws for all others, one picture after another.

use crate::errors::raised;
use crate::work::wait;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use tinta::request::Session;
use tinta::{Backend, Error, Renderer, Result};

/// A job for the open contexts.
type Job = Box<dyn FnOnce(&mut Session) + Send>;

struct Studio {
    /// A process that was forked from this one has the value and not the thread.
    process: u32,
    jobs: Sender<Job>,
    thread: JoinHandle<()>,
}

static STUDIO: Mutex<Option<Studio>> = Mutex::new(None);

impl Studio {
    fn open() -> std::io::Result<Self> {
        let (jobs, receiver) = channel::<Job>();
        let work = move || {
            let mut session = Session::for_many(Renderer::new);
            while let Ok(job) = receiver.recv() {
                job(&mut session);
            }
        };
        let thread = std::thread::Builder::new().name("tinta-studio".to_owned()).spawn(work)?;
        Ok(Self { process: std::process::id(), jobs, thread })
    }
}

/// Draws with this backend and returns the result; cancelled as [`crate::work::done`] is.
pub(crate) fn drawn<T: Send + 'static>(
    py: Python<'_>,
    backend: Backend,
    work: impl FnOnce(&mut Renderer) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = sync_channel(1);
    let is_cancelled = Arc::new(AtomicBool::new(false));
    let cancelled = is_cancelled.clone();
    let job: Job = Box::new(move |session| {
        if cancelled.load(Ordering::Relaxed) {
            return;
        }
        let result = session.renderer(backend).and_then(work);
        if matches!(result, Err(Error::ContextLost { .. })) {
            session.close();
        }
        // The caller may have stopped waiting.
        drop(sender.send(result));
    });
    submit(job)?;
    wait(py, receiver, || is_cancelled.store(true, Ordering::Relaxed))
}

/// Hands a job to the thread, which starts with the first job, and again if it has died.
fn submit(job: Job) -> PyResult<()> {
    let mut studio = STUDIO.lock().unwrap_or_else(PoisonError::into_inner);
    if studio.as_ref().is_some_and(|studio| studio.process != std::process::id()) {
        return Err(PyRuntimeError::new_err(
            "this process was forked from one that had drawn, and OpenGL does not bear that; start it with \
             multiprocessing.get_context(\"spawn\")",
        ));
    }
    if studio.as_ref().is_none_or(|studio| studio.thread.is_finished()) {
        let opened = Studio::open();
        let problem = |error| PyRuntimeError::new_err(format!("no thread can be started ({error}); try again later"));
        *studio = Some(opened.map_err(problem)?);
    }
    match &*studio {
        Some(studio) if studio.jobs.send(job).is_ok() => Ok(()),
        _ => Err(raised(Error::Cancelled)),
    }
}

/// Ends the thread, and with it the contexts: Python calls this before it ends, and the driver before its own end.
#[pyfunction]
pub(crate) fn close(py: Python<'_>) {
    let studio = STUDIO.lock().unwrap_or_else(PoisonError::into_inner).take();
    let Some(studio) = studio.filter(|studio| studio.process == std::process::id()) else { return };
    let Studio { jobs, thread, .. } = studio;
    drop(jobs);
    // A panicked job has printed its message.
    py.detach(|| drop(thread.join()));
}
