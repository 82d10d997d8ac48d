//! Contexts of the system's OpenGL, without a window.

use super::super::Gl;
use super::super::faults::{self, Fault, Faults};
use super::context_lock::{self, ContextGuard, ContextLock};
use super::load::load_functions;
use super::{Attempt, Backend, ContextInfo, Outcome, egl, osmesa};
use crate::error::{Error, Result};
use crate::scene::Size;
use std::ffi::{CStr, c_void};
use std::mem::ManuallyDrop;
use std::rc::Rc;

/// The OpenGL that contexts are asked for.
const VERSION: (u8, u8) = (2, 1);

/// One that no driver has, for [`Fault::ContextRefused`].
const NO_VERSION: (u8, u8) = (9, 9);

/// A context with its loaded functions; current on this thread only between [`Context::enter`] and its guard's end.
pub(crate) struct Context {
    platform: ManuallyDrop<Platform>,
    gl: Rc<Gl>,
    faults: Option<Rc<Faults>>,
    /// Shared with the contexts of the same screen; `None` for those of hardware, which may all be at work at once.
    lock: Option<&'static ContextLock>,
}

/// Why a context cannot be made current.
pub(super) struct NotCurrent {
    pub(super) is_lost: bool,
    pub(super) reason: String,
}

/// The platforms' contexts.
pub(super) enum Platform {
    Egl(egl::EglContext),
    OsMesa(osmesa::OsMesaContext),
}

/// A way not yet tried.
enum Candidate {
    Egl(egl::Device),
    OsMesa,
    /// A whole platform that is not there, and why.
    Missing {
        device: String,
        reason: String,
    },
}

impl Candidate {
    fn all(backend: Backend) -> Vec<Self> {
        let mut candidates = Vec::new();
        if backend != Backend::OsMesa {
            match egl::devices() {
                Ok(devices) => candidates.extend(devices.into_iter().map(Self::Egl)),
                Err(reason) => candidates.push(Self::Missing { device: "EGL".to_owned(), reason }),
            }
        }
        if backend != Backend::Egl {
            candidates.push(Self::OsMesa);
        }
        candidates
    }

    fn name(&self) -> String {
        match self {
            Self::Egl(device) => device.name.clone(),
            Self::OsMesa => osmesa::name(),
            Self::Missing { device, .. } => device.clone(),
        }
    }

    fn open(self, fault: Option<Fault>) -> std::result::Result<Context, String> {
        let device = self.name();
        let version = if fault == Some(Fault::ContextRefused) { NO_VERSION } else { VERSION };
        let (backend, lock) = match &self {
            Self::Egl(_) => ("egl", &context_lock::OF_EGL),
            Self::OsMesa => ("osmesa", &context_lock::OF_OSMESA),
            Self::Missing { reason, .. } => return Err(reason.clone()),
        };
        // Whether the context is software's is known only when it is there.
        let _guard = lock.lock();
        let platform = match self {
            Self::Egl(found) => Platform::Egl(egl::EglContext::open(&found, version)?),
            Self::OsMesa => Platform::OsMesa(osmesa::OsMesaContext::open(version)?),
            Self::Missing { reason, .. } => return Err(reason),
        };
        Context::load(platform, backend, device, fault, lock)
    }
}

/// Tries every way of this backend and tells what came of each.
pub fn attempts(backend: Backend) -> Vec<Attempt> {
    Candidate::all(backend)
        .into_iter()
        .map(|candidate| {
            let device = candidate.name();
            let outcome = match candidate.open(None) {
                Ok(context) => Outcome::Context(Box::new(context.info().clone())),
                Err(reason) => Outcome::Error(reason),
            };
            Attempt { device, outcome }
        })
        .collect()
}

impl Context {
    /// The first way of this backend that works; with a fault something will go wrong in it.
    pub(crate) fn open(backend: Backend, fault: Option<Fault>) -> Result<Self> {
        let mut attempts = Vec::new();
        for candidate in Candidate::all(backend) {
            let name = candidate.name();
            match candidate.open(fault) {
                Ok(context) => return Ok(context),
                Err(reason) => attempts.push(format!("{name}: {reason}")),
            }
        }
        Err(Error::NoContext { attempts })
    }

    /// The first way of this backend, but for these devices, that draws surfaces of this size, or the one that draws the
    /// largest; `None` where no other works.
    pub(crate) fn open_for(backend: Backend, fault: Option<Fault>, surface: Size, but: &[&str]) -> Option<Self> {
        let mut largest: Option<Self> = None;
        for candidate in Candidate::all(backend).into_iter().filter(|other| !but.contains(&other.name().as_str())) {
            let Ok(context) = candidate.open(fault) else { continue };
            if context.draws(surface) {
                return Some(context);
            }
            let pixels = |context: &Self| context.info().largest_picture.pixel_count();
            if largest.as_ref().is_none_or(|other| pixels(&context) > pixels(other)) {
                largest = Some(context);
            }
        }
        largest
    }

    /// Whether surfaces of this size are within its limits.
    pub(crate) fn draws(&self, surface: Size) -> bool {
        let limit = self.info().largest_picture;
        surface.width <= limit.width && surface.height <= limit.height
    }

    fn load(
        platform: Platform,
        backend: &'static str,
        device: String,
        fault: Option<Fault>,
        lock: &'static ContextLock,
    ) -> std::result::Result<Self, String> {
        let faults = fault.map(|fault| Rc::new(Faults::new(fault)));
        platform.make_current().map_err(|failed| failed.reason)?;
        let current = Current::new(&platform, faults.as_ref(), None);
        let loaded = load_functions(&platform, faults.as_deref(), backend, device);
        drop(current);
        let gl = loaded?;
        let lock = gl.info.is_software().then_some(lock);
        Ok(Self { platform: ManuallyDrop::new(platform), gl: Rc::new(gl), faults, lock })
    }

    /// Waits until no other context of the same screen is at work.
    fn lock_context(&self) -> Option<ContextGuard> {
        self.lock.map(ContextLock::lock)
    }

    pub(crate) fn info(&self) -> &ContextInfo {
        &self.gl.info
    }

    pub(crate) fn gl(&self) -> &Rc<Gl> {
        &self.gl
    }

    /// Makes the surface this large; refuses what the context cannot draw.
    pub(crate) fn resize(&mut self, size: Size) -> Result<()> {
        let limit = self.info().largest_picture;
        if !self.draws(size) {
            return Err(Error::PictureTooLarge {
                width: size.width,
                height: size.height,
                limit_width: limit.width,
                limit_height: limit.height,
                renderer: self.info().renderer.clone(),
            });
        }
        let _guard = self.lock_context();
        let resized = match &mut *self.platform {
            Platform::Egl(context) => context.resize(size),
            Platform::OsMesa(context) => context.resize(size),
        };
        resized.map_err(|reason| Error::gl(format!("making a surface of {size} pixels"), reason))
    }

    /// Makes the context current until the guard is dropped, after waiting for its lock: a thread has one such guard at most.
    /// Contexts of both platforms share one dispatch table inside Mesa, so none is left current when another may be entered.
    pub(crate) fn enter(&self) -> Result<Current<'_>> {
        let guard = self.lock_context();
        self.platform.make_current().map_err(|NotCurrent { is_lost, reason }| {
            let during = "making the context current";
            match is_lost {
                true => Error::ContextLost { during: during.to_owned(), what: reason },
                false => Error::gl(during, reason),
            }
        })?;
        Ok(Current::new(&self.platform, self.faults.as_ref(), guard))
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        let _guard = self.lock_context();
        // SAFETY: it is dropped here alone, and nothing uses it afterwards.
        unsafe { ManuallyDrop::drop(&mut self.platform) };
    }
}

/// While it lives its context is current.
pub(crate) struct Current<'a> {
    platform: &'a Platform,
    /// Ends after the context has been released, below.
    _guard: Option<ContextGuard>,
}

impl<'a> Current<'a> {
    fn new(platform: &'a Platform, faults: Option<&Rc<Faults>>, guard: Option<ContextGuard>) -> Self {
        faults::set_current(faults);
        Self { platform, _guard: guard }
    }
}

impl Drop for Current<'_> {
    fn drop(&mut self) {
        faults::set_current(None);
        self.platform.release();
    }
}

impl Platform {
    fn make_current(&self) -> std::result::Result<(), NotCurrent> {
        match self {
            Self::Egl(context) => context.make_current(),
            Self::OsMesa(context) => context.make_current(),
        }
    }

    fn release(&self) {
        match self {
            Self::Egl(context) => context.release(),
            Self::OsMesa(context) => context.release(),
        }
    }

    pub(super) fn proc_address(&self, name: &CStr) -> *const c_void {
        match self {
            Self::Egl(context) => context.proc_address(name),
            Self::OsMesa(context) => context.proc_address(name),
        }
    }

    pub(super) fn largest_surface(&self) -> Size {
        match self {
            Self::Egl(context) => context.largest_surface(),
            Self::OsMesa(context) => context.largest_surface(),
        }
    }
}
