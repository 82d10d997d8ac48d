//! Mesa's off-screen library: a context that draws into our memory, without any device. Mesa 25.1 removed it.

use super::platform::{NotCurrent, Platform};
use crate::scene::Size;
use libloading::{Library, Symbol};
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, c_char, c_void};
use std::ptr;
use std::sync::OnceLock;

type Handle = *mut c_void;
type CreateContext = unsafe extern "system" fn(*const i32, Handle) -> Handle;
type DestroyContext = unsafe extern "system" fn(Handle);
type MakeCurrent = unsafe extern "system" fn(Handle, *mut c_void, u32, i32, i32) -> u8;
type GetInteger = unsafe extern "system" fn(i32, *mut i32);
type GetProcAddress = unsafe extern "system" fn(*const c_char) -> *const c_void;

/// The library's functions used here.
struct Functions {
    /// The library's file name.
    library: &'static str,
    create_context: CreateContext,
    destroy_context: DestroyContext,
    make_current: MakeCurrent,
    get_integer: GetInteger,
    get_proc_address: GetProcAddress,
}

/// Its file names from Mesa and from packagers.
#[cfg(windows)]
const LIBRARIES: [&str; 1] = ["osmesa.dll"];
#[cfg(target_os = "macos")]
const LIBRARIES: [&str; 2] = ["libOSMesa.8.dylib", "libOSMesa.dylib"];
#[cfg(not(any(windows, target_os = "macos")))]
const LIBRARIES: [&str; 3] = ["libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"];

/// The library, loaded once and never unloaded: Mesa leaves threads and exit handlers behind.
fn functions() -> Result<&'static Functions, String> {
    static FUNCTIONS: OnceLock<Result<Functions, String>> = OnceLock::new();
    FUNCTIONS.get_or_init(load).as_ref().map_err(Clone::clone)
}

/// Whether the library is installed, with the driver that GALLIUM_DRIVER names.
pub(super) fn is_there() -> bool {
    functions().is_ok() && check_driver(asked_driver().as_deref()).is_ok()
}

/// The value of GALLIUM_DRIVER.
fn asked_driver() -> Option<String> {
    std::env::var_os("GALLIUM_DRIVER").map(|name| name.to_string_lossy().into_owned())
}

/// The name to display: OSMesa and its library.
pub(super) fn name() -> String {
    functions().map_or("OSMesa".to_owned(), |functions| format!("OSMesa {}", functions.library))
}

fn load() -> Result<Functions, String> {
    let mut reasons = Vec::new();
    for name in LIBRARIES {
        // SAFETY: loading Mesa runs its initialisers, which have no preconditions.
        match unsafe { Library::new(name) } {
            // The library is never unloaded.
            Ok(library) => return find_functions(name, Box::leak(Box::new(library))),
            Err(error) => reasons.push(error.to_string()),
        }
    }
    Err(format!(
        "the library is not installed ({}); Mesa dropped it in 25.1, and tinta needs it only if no other backend works",
        reasons[0]
    ))
}

fn find_functions(name: &'static str, library: &'static Library) -> Result<Functions, String> {
    let missing = |error: libloading::Error| format!("the library lacks a function ({error})");
    // SAFETY: the symbols are those of Mesa's osmesa.h, of the types given there.
    unsafe {
        let get = |name: &[u8]| library.get::<*const c_void>(name).map(|symbol: Symbol<'_, *const c_void>| *symbol);
        Ok(Functions {
            library: name,
            create_context: std::mem::transmute::<*const c_void, CreateContext>(
                get(b"OSMesaCreateContextAttribs\0").map_err(missing)?,
            ),
            destroy_context: std::mem::transmute::<*const c_void, DestroyContext>(
                get(b"OSMesaDestroyContext\0").map_err(missing)?,
            ),
            make_current: std::mem::transmute::<*const c_void, MakeCurrent>(
                get(b"OSMesaMakeCurrent\0").map_err(missing)?,
            ),
            get_integer: std::mem::transmute::<*const c_void, GetInteger>(
                get(b"OSMesaGetIntegerv\0").map_err(missing)?,
            ),
            get_proc_address: std::mem::transmute::<*const c_void, GetProcAddress>(
                get(b"OSMesaGetProcAddress\0").map_err(missing)?,
            ),
        })
    }
}

/// The drivers inside OSMesa; GALLIUM_DRIVER may choose one.
const DRIVERS: [&str; 3] = ["", "llvmpipe", "softpipe"];

/// Refuses a GALLIUM_DRIVER that OSMesa lacks: Mesa would continue without a driver and crash.
fn check_driver(chosen: Option<&str>) -> Result<(), String> {
    match chosen {
        Some(chosen) if !DRIVERS.contains(&chosen) => Err(format!(
            "it has no driver {chosen:?}, which GALLIUM_DRIVER asks for; choose llvmpipe or softpipe, or unset it"
        )),
        _ => Ok(()),
    }
}

/// A context and the memory it draws into.
pub(super) struct OsMesaContext {
    functions: &'static Functions,
    context: Handle,
    size: Size,
    /// RGBA8, bottom row first; Mesa writes here whenever the context is flushed while current.
    memory: RefCell<Vec<u32>>,
    /// The size at which it was last made current.
    made_current: Cell<Size>,
}

/// Small blocks of memory, held while a surface of another size is made current.
///
/// OSMesa then frees its record of the old surface and allocates one for the new. Mesa knows a surface by its record's address.
/// If the new record gets the old address, Mesa takes the old surface for one still in use and keeps its textures: 170 KB leak
/// with every other picture of 64 and 128 pixels. C allocators first return the block freed last; glibc's `calloc` returns it
/// only if its list of freed blocks of that size, seven long, is full. So all free blocks of such sizes are taken first.
struct SmallBlocks {
    _blocks: Vec<Vec<u8>>,
}

impl SmallBlocks {
    /// The record has 56 bytes in Mesa 22.3; other versions differ by eight.
    const BYTES: [usize; 4] = [40, 56, 72, 88];

    /// More than the most blocks ever found free, because other lists refill the first one.
    const OF_EACH: usize = 256;

    fn take() -> Self {
        let sizes = Self::BYTES.into_iter().flat_map(|size| std::iter::repeat_n(size, Self::OF_EACH));
        Self { _blocks: sizes.map(Vec::with_capacity).collect() }
    }
}

impl OsMesaContext {
    /// Opens a compatibility context of this version of OpenGL with a surface of one pixel.
    pub(super) fn open((major, minor): (u8, u8)) -> Result<Self, String> {
        let functions = functions()?;
        check_driver(asked_driver().as_deref())?;
        let [major, minor] = [major, minor].map(i32::from);
        // OSMESA_FORMAT RGBA, DEPTH_BITS 24, STENCIL_BITS 0, ACCUM_BITS 0, PROFILE compatibility, VERSION, end.
        let attributes = [0x22, 0x1908, 0x30, 24, 0x31, 0, 0x32, 0, 0x33, 0x35, 0x36, major, 0x37, minor, 0, 0];
        // SAFETY: the list ends with 0, and the context shares no objects with another.
        let context = unsafe { (functions.create_context)(attributes.as_ptr(), ptr::null_mut()) };
        if context.is_null() {
            return Err(format!("making a GL {major}.{minor} context failed"));
        }
        let size = Size { width: 1, height: 1 };
        Ok(Self { functions, context, size, memory: RefCell::new(vec![0]), made_current: Cell::new(size) })
    }
}

impl Platform for OsMesaContext {
    fn resize(&mut self, size: Size) -> Result<(), String> {
        let mut memory = Vec::new();
        memory.try_reserve_exact(size.pixel_count()).map_err(|_| "not enough memory".to_owned())?;
        memory.resize(size.pixel_count(), 0);
        *self.memory.borrow_mut() = memory;
        self.size = size;
        Ok(())
    }

    fn make_current(&self) -> Result<(), NotCurrent> {
        let _elsewhere = (self.made_current.replace(self.size) != self.size).then(SmallBlocks::take);
        let mut memory = self.memory.borrow_mut();
        let (width, height) = (self.size.width as i32, self.size.height as i32);
        // SAFETY: the context is alive, and the memory holds width x height RGBA8 pixels and is only replaced while the
        // context is not current: `resize` needs `&mut self`, which no guard of `Context::enter` leaves.
        let made = unsafe {
            (self.functions.make_current)(self.context, memory.as_mut_ptr().cast(), glow::UNSIGNED_BYTE, width, height)
        };
        match made {
            0 => {
                Err(NotCurrent { is_lost: false, reason: format!("it cannot be made current at {} pixels", self.size) })
            }
            _ => Ok(()),
        }
    }

    fn release(&self) {
        // SAFETY: no context, no memory: Mesa flushes and releases both.
        unsafe { (self.functions.make_current)(ptr::null_mut(), ptr::null_mut(), glow::UNSIGNED_BYTE, 0, 0) };
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        // SAFETY: the name ends with 0.
        unsafe { (self.functions.get_proc_address)(name.as_ptr()) }
    }

    fn largest_surface(&self) -> Size {
        const MAX_WIDTH: i32 = 0x24;
        const MAX_HEIGHT: i32 = 0x25;
        let limit = |name: i32| {
            let mut value = 0;
            // SAFETY: both names are one integer.
            unsafe { (self.functions.get_integer)(name, &mut value) };
            if value <= 0 { u32::MAX } else { value as u32 }
        };
        Size { width: limit(MAX_WIDTH), height: limit(MAX_HEIGHT) }
    }
}

impl Drop for OsMesaContext {
    fn drop(&mut self) {
        // SAFETY: the context is alive and, without guards, not current.
        unsafe { (self.functions.destroy_context)(self.context) };
    }
}
