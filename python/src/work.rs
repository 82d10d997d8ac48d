//! Work on a separate thread while Python's other threads run, cancelled by Ctrl-C.

use crate::errors::raised;
use pyo3::exceptions::PyRuntimeError;
use pyo3::{PyResult, Python};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;
use tinta::Result;

/// How often a waiting thread checks Python's signals.
const GLANCE: Duration = Duration::from_millis(50);

/// Does the work and returns its result. If a signal raises an exception, this function raises it at once: `cancel` asks the work
/// to end, and the rest of the work runs without a waiting caller.
pub(crate) fn done<T: Send + 'static>(
    py: Python<'_>,
    cancel: impl Fn(),
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = sync_channel(1);
    let thread = std::thread::Builder::new().name("tinta".to_owned());
    // The caller may have stopped waiting.
    let started = thread.spawn(move || drop(sender.send(work())));
    started.map_err(|error| PyRuntimeError::new_err(format!("no thread can be started ({error}); try again later")))?;
    wait(py, receiver, cancel)
}

/// Waits for another thread's result.
pub(crate) fn wait<T: Send>(py: Python<'_>, receiver: Receiver<Result<T>>, cancel: impl Fn()) -> PyResult<T> {
    let mut receiver = receiver;
    loop {
        let answer;
        (receiver, answer) = py.detach(move || {
            let answer = receiver.recv_timeout(GLANCE);
            (receiver, answer)
        });
        match answer {
            Ok(result) => return result.map_err(raised),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| cancel())?,
            Err(RecvTimeoutError::Disconnected) => {
                let problem = "the work ended without an answer; this is a bug in tinta: report it with the mesh";
                return Err(PyRuntimeError::new_err(problem));
            }
        }
    }
}
