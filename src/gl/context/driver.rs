//! Contexts of the system's OpenGL, without a window.

use super::super::Gl;
use super::super::faults::{self, Fault, Faults};
#[cfg(target_os = "macos")]
use super::cgl;
use super::context_lock::{self, ContextGuard, ContextLock};
#[cfg(not(target_os = "macos"))]
use super::egl;
use super::load::load_functions;
use super::platform::{NotCurrent, Platform};
#[cfg(all(unix, not(target_os = "macos")))]
use super::surfaceless;
#[cfg(windows)]
use super::wgl;
use super::{Attempt, Backend, Outcome, osmesa};
use crate::error::{Error, Result};
use crate::scene::Size;
use std::mem::ManuallyDrop;
use std::rc::Rc;

/// The OpenGL version requested for contexts.
pub(super) const VERSION: (u8, u8) = (2, 1);

/// A version that no driver has, for [`Fault::ContextRefused`].
const NO_VERSION: (u8, u8) = (9, 9);

/// A context with its loaded functions; current on this thread only from [`Context::enter`] until its guard is dropped.
pub(crate) struct Context {
    platform: ManuallyDrop<Box<dyn Platform>>,
    pub(super) gl: Rc<Gl>,
    faults: Option<Rc<Faults>>,
    /// Shared with the contexts of the same screen; `None` for those of hardware, which can all work at once.
    lock: Option<&'static ContextLock>,
}

/// Opens a platform's context of this version of OpenGL.
type Open = Box<dyn FnOnce((u8, u8)) -> std::result::Result<Box<dyn Platform>, String>>;

/// A way not yet tried.
struct Candidate {
    backend: &'static str,
    /// Returns the name to display: the library, and the device if there are several. OSMesa has to be loaded to tell it, which
    /// takes some 10 ms.
    name: Rc<dyn Fn() -> String>,
    lock: &'static ContextLock,
    open: Open,
}

impl Candidate {
    /// This backend's ways on this system, in the order they are tried.
    fn all(backend: Backend) -> Vec<Self> {
        let is_wanted = |one: Backend| backend == one || backend == Backend::Auto;
        let mut candidates = Vec::new();
        #[cfg(windows)]
        if is_wanted(Backend::Wgl) {
            let open = |version| wgl::open(version).map(boxed);
            candidates.push(Self::new("wgl", "WGL", &context_lock::OF_WGL, open));
        }
        #[cfg(target_os = "macos")]
        if is_wanted(Backend::Cgl) {
            let open = |version| cgl::CglContext::open(version).map(boxed);
            candidates.push(Self::new("cgl", "CGL", &context_lock::OF_CGL, open));
        }
        #[cfg(not(target_os = "macos"))]
        if is_wanted(Backend::Egl) {
            match egl::devices() {
                Ok(devices) => candidates.extend(devices.into_iter().map(|device| {
                    let name = device.name.clone();
                    let open = move |version| egl::open(&device, version).map(boxed);
                    Self { name: Rc::new(move || name.clone()), ..Self::new("egl", "EGL", &context_lock::OF_EGL, open) }
                })),
                Err(reason) => candidates.push(Self::new("egl", "EGL", &context_lock::OF_EGL, |_| Err(reason))),
            }
        }
        if is_wanted(Backend::OsMesa) {
            let open = |version| osmesa::OsMesaContext::open(version).map(boxed);
            let osmesa = Self::new("osmesa", "OSMesa", &context_lock::OF_OSMESA, open);
            candidates.push(Self { name: Rc::new(osmesa::name), ..osmesa });
        }
        #[cfg(all(unix, not(target_os = "macos")))]
        if is_wanted(Backend::Surfaceless) {
            let open = |version| surfaceless::SurfacelessContext::open(version).map(boxed);
            candidates.push(Self::new("surfaceless", "EGL surfaceless", &context_lock::OF_SURFACELESS, open));
        }
        if candidates.is_empty() {
            let (name, whose) = match backend {
                Backend::Wgl => ("WGL", "Windows"),
                Backend::Cgl => ("CGL", "macOS"),
                _ => ("EGL", "Linux"),
            };
            let reason = format!("it is of {whose}, and this is {}; choose the backend auto", std::env::consts::OS);
            candidates.push(Self::new("none", name, &context_lock::OF_EGL, |_| Err(reason)));
        }
        candidates
    }

    fn new(
        backend: &'static str,
        name: &'static str,
        lock: &'static ContextLock,
        open: impl FnOnce((u8, u8)) -> std::result::Result<Box<dyn Platform>, String> + 'static,
    ) -> Self {
        Self { backend, name: Rc::new(|| name.to_owned()), lock, open: Box::new(open) }
    }

    fn open(self, fault: Option<Fault>) -> std::result::Result<Context, String> {
        let version = if fault == Some(Fault::ContextRefused) { NO_VERSION } else { VERSION };
        // Only an open context shows whether it is software.
        let _guard = self.lock.lock();
        let platform = (self.open)(version)?;
        Context::load(platform, self.backend, (self.name)(), fault, self.lock)
    }
}

fn boxed(context: impl Platform + 'static) -> Box<dyn Platform> {
    Box::new(context)
}

/// Tries every way of this backend and returns each outcome.
pub fn attempts(backend: Backend) -> Vec<Attempt> {
    each(backend)
        .map(|(device, opened)| {
            let outcome = match opened {
                Ok(context) => Outcome::Context(Box::new(context.info().clone())),
                Err(reason) => Outcome::Error(reason),
            };
            Attempt { device, outcome }
        })
        .collect()
}

/// Returns a context for every way of this backend, one after the other, with its device's name; or the reason for its failure.
pub(crate) fn each(backend: Backend) -> impl Iterator<Item = (String, std::result::Result<Context, String>)> {
    Candidate::all(backend).into_iter().map(|candidate| ((candidate.name)(), candidate.open(None)))
}

/// Two backends of this system for comparing two drawings of one picture: its own, and OSMesa. Without OSMesa the second is
/// another screen of the first one's driver, or where the driver has none, the first again.
pub fn witnesses() -> [Backend; 2] {
    let own = match () {
        () if cfg!(windows) => Backend::Wgl,
        () if cfg!(target_os = "macos") => Backend::Cgl,
        () => Backend::Egl,
    };
    let opens = |backend| each(backend).any(|(_, opened)| opened.is_ok());
    let other = match osmesa::is_there() {
        true => Backend::OsMesa,
        false if own == Backend::Egl && opens(Backend::Surfaceless) => Backend::Surfaceless,
        false => own,
    };
    [own, other]
}

impl Context {
    /// Opens the first working context of this backend; `fault` makes something go wrong in it.
    pub(crate) fn open(backend: Backend, fault: Option<Fault>) -> Result<Self> {
        let mut attempts = Vec::new();
        for candidate in Candidate::all(backend) {
            let name = candidate.name.clone();
            match candidate.open(fault) {
                Ok(context) => return Ok(context),
                Err(reason) => attempts.push(format!("{}: {reason}", name())),
            }
        }
        Err(Error::NoContext { attempts })
    }

    /// Returns this backend's first context, except on these devices, that draws surfaces of this size; otherwise the one that
    /// draws the largest. `None` if every other way fails.
    pub(crate) fn open_for(backend: Backend, fault: Option<Fault>, surface: Size, but: &[&str]) -> Option<Self> {
        let mut largest: Option<Self> = None;
        for candidate in Candidate::all(backend).into_iter().filter(|other| !but.contains(&(other.name)().as_str())) {
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

    pub(super) fn load(
        platform: Box<dyn Platform>,
        backend: &'static str,
        device: String,
        fault: Option<Fault>,
        lock: &'static ContextLock,
    ) -> std::result::Result<Self, String> {
        let faults = fault.map(|fault| Rc::new(Faults::new(fault)));
        platform.make_current().map_err(|failed| failed.reason)?;
        let current = Current::new(&*platform, faults.as_ref(), None);
        let loaded = load_functions(&*platform, faults.as_deref(), backend, device);
        drop(current);
        let gl = loaded?;
        let lock = gl.info.is_software().then_some(lock);
        Ok(Self { platform: ManuallyDrop::new(platform), gl: Rc::new(gl), faults, lock })
    }

    /// Waits until other contexts of the same screen are idle.
    fn lock_context(&self) -> Option<ContextGuard> {
        self.lock.map(ContextLock::lock)
    }

    /// Resizes the surface; an error if the size exceeds the context's limits.
    pub(crate) fn resize(&mut self, size: Size) -> Result<()> {
        if !self.draws(size) {
            return Err(self.too_large(size, self.info().largest_picture));
        }
        let failed = |reason: String| Error::gl(format!("making a surface of {size} pixels"), reason);
        let guard = self.lock_context();
        self.platform.resize(size).map_err(failed)?;
        drop(guard);
        #[cfg(any(target_os = "macos", test))]
        if let Some(surface) = &self.gl.surface {
            let _current = self.enter()?;
            surface.resize(&self.gl.glow, size).map_err(failed)?;
        }
        Ok(())
    }

    /// Makes the context current until the guard is dropped, after waiting for its lock. A thread has at most one such guard.
    /// Contexts of both platforms share one dispatch table inside Mesa, so none stays current while another may be entered.
    pub(crate) fn enter(&self) -> Result<Current<'_>> {
        let guard = self.lock_context();
        self.platform.make_current().map_err(|NotCurrent { is_lost, reason }| {
            let during = "making the context current";
            match is_lost {
                true => Error::ContextLost { during: during.to_owned(), what: reason },
                false => Error::gl(during, reason),
            }
        })?;
        Ok(Current::new(&**self.platform, self.faults.as_ref(), guard))
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        let _guard = self.lock_context();
        // SAFETY: only this code drops it, and later code does not use it.
        unsafe { ManuallyDrop::drop(&mut self.platform) };
    }
}

/// A guard that keeps its context current.
pub(crate) struct Current<'a> {
    platform: &'a dyn Platform,
    /// Dropped after the context has been released, below.
    _guard: Option<ContextGuard>,
}

impl<'a> Current<'a> {
    fn new(platform: &'a dyn Platform, faults: Option<&Rc<Faults>>, guard: Option<ContextGuard>) -> Self {
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
