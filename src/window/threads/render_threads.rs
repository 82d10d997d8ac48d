//! The rendering threads and their current jobs.
//!
//! One thread draws, until the picture changes faster than it can draw. Then, where the processor draws, a second one takes every
//! other picture. Mesa's software drivers compute vertices on one core; a second core would wait for them. Two contexts of one
//! screen of such a driver take turns (see `gl`). The second therefore uses EGL's surfaceless platform where the first uses a
//! device: the same library's driver with its own screen.

use crate::gl::{Backend, ContextInfo};
use crate::threads::cores;
use crate::window::threads::draw::{self, Order};
use crate::window::threads::explain::PixelJob;
use crate::window::threads::job::Job;
use crate::window::threads::line_measure::LineMeasure;
use crate::window::threads::report::Reporter;
use std::collections::HashMap;
use std::sync::mpsc::Sender;
use std::thread::JoinHandle;

/// Most threads that draw.
const MOST: usize = 2;

/// How the second one draws.
const SECOND: Backend = Backend::Surfaceless;

/// The threads.
pub(in crate::window) struct RenderThreads {
    backend: Backend,
    /// The first thread's context's own description.
    first: Option<ContextInfo>,
    reporter: Reporter,
    threads: Vec<Thread>,
    /// Replaced shaders, for a thread that starts later.
    shaders: Option<HashMap<String, String>>,
    /// Whether another thread would draw more pictures.
    may_grow: bool,
    /// Jobs so far.
    count: u64,
}

/// A rendering thread.
struct Thread {
    /// Until it shall end.
    orders: Option<Sender<Order>>,
    handle: Option<JoinHandle<()>>,
    /// Its job, with the job's number.
    job: Option<(u64, Job)>,
}

impl RenderThreads {
    /// Starts the first.
    ///
    /// # Errors
    ///
    /// When the thread cannot be started.
    pub(in crate::window) fn start(backend: Backend, reporter: Reporter) -> std::io::Result<Self> {
        let mut started =
            Self { backend, first: None, reporter, threads: Vec::new(), shaders: None, may_grow: false, count: 0 };
        started.add()?;
        Ok(started)
    }

    fn add(&mut self) -> std::io::Result<()> {
        let backend = if self.threads.is_empty() { self.backend } else { SECOND };
        let (orders, handle) = draw::start(backend, self.threads.len(), self.reporter.clone())?;
        if let Some(shaders) = &self.shaders {
            // One that has ended will be found to have when it is to draw.
            let _ = orders.send(Order::Shaders(shaders.clone()));
        }
        self.threads.push(Thread { orders: Some(orders), handle: Some(handle), job: None });
        Ok(())
    }

    /// Takes a thread's context description: decides whether a second thread helps, and whether the second one draws the same
    /// pictures.
    pub(in crate::window) fn opened(&mut self, thread: usize, context: &ContextInfo) {
        if thread == 0 {
            let has_another = self.backend == Backend::Auto && context.backend == "egl";
            self.may_grow = context.is_software() && has_another && cores() > 1;
            self.first = Some(context.clone());
        } else if self.first.as_ref().is_none_or(|first| !is_same_driver(first, context)) {
            self.lost(thread);
        }
    }

    /// Does without a thread that cannot draw; whether there is still one that can.
    pub(in crate::window) fn lost(&mut self, thread: usize) -> bool {
        self.may_grow = false;
        if let Some(lost) = self.threads.get_mut(thread) {
            (lost.orders, lost.job) = (None, None);
        }
        self.threads.iter().any(|thread| thread.orders.is_some())
    }

    /// The last job that was given out and is not done.
    pub(in crate::window) fn newest(&self) -> Option<&Job> {
        let jobs = self.threads.iter().filter_map(|thread| thread.job.as_ref());
        jobs.max_by_key(|(number, _)| *number).map(|(_, job)| job)
    }

    /// Gives a job to an idle thread. While the view changes and none is idle, starts one if it helps.
    ///
    /// # Errors
    ///
    /// When a thread has ended.
    pub(in crate::window) fn draw(&mut self, job: Job, is_moving: bool) -> Result<(), LostThread> {
        let is_free = |thread: &Thread| thread.orders.is_some() && thread.job.is_none();
        let may_add = is_moving && self.may_grow && self.threads.len() < MOST;
        // If no other thread can start, the picture waits.
        if !self.threads.iter().any(is_free) && (!may_add || self.add().is_err()) {
            return Ok(());
        }
        let Some(thread) = self.threads.iter_mut().find(|thread| is_free(thread)) else { return Ok(()) };
        self.count += 1;
        thread.job = Some((self.count, job.clone()));
        thread.send(Order::Draw(Box::new(job)))
    }

    /// Has a job timed by the first thread.
    ///
    /// # Errors
    ///
    /// When it has ended.
    pub(in crate::window) fn measure_cost(&self, job: Job, measure: Option<LineMeasure>) -> Result<(), LostThread> {
        self.threads.first().map_or(Err(LostThread), |thread| thread.send(Order::MeasureCost(Box::new(job), measure)))
    }

    /// Has a pixel explained by the first thread.
    ///
    /// # Errors
    ///
    /// When it has ended.
    pub(in crate::window) fn explain(&self, job: PixelJob) -> Result<(), LostThread> {
        self.threads.first().map_or(Err(LostThread), |thread| thread.send(Order::Explain(Box::new(job))))
    }

    /// Replaces shaders.
    ///
    /// # Errors
    ///
    /// When a thread has ended.
    pub(in crate::window) fn replace_shaders(&mut self, shaders: HashMap<String, String>) -> Result<(), LostThread> {
        self.shaders = Some(shaders.clone());
        let mut working = self.threads.iter().filter(|thread| thread.orders.is_some());
        working.try_for_each(|thread| thread.send(Order::Shaders(shaders.clone())))
    }

    /// The job that a thread has done, with its number.
    pub(in crate::window) fn done(&mut self, thread: usize) -> Option<(u64, Job)> {
        self.threads.get_mut(thread)?.job.take()
    }
}

/// A thread has ended that should not have.
#[derive(Debug)]
pub(in crate::window) struct LostThread;

/// Whether two contexts belong to the same driver and draw the same pictures.
fn is_same_driver(a: &ContextInfo, b: &ContextInfo) -> bool {
    (&a.renderer, &a.version) == (&b.renderer, &b.version)
}

impl Thread {
    fn send(&self, order: Order) -> Result<(), LostThread> {
        self.orders.as_ref().ok_or(LostThread)?.send(order).map_err(|_| LostThread)
    }
}

impl Drop for RenderThreads {
    /// Waits for running drawings: a driver does not survive the program's end while it draws.
    fn drop(&mut self) {
        self.threads.iter_mut().for_each(|thread| thread.orders = None);
        for handle in self.threads.iter_mut().filter_map(|thread| thread.handle.take()) {
            // A panicked thread has printed its message.
            let _ = handle.join();
        }
    }
}
