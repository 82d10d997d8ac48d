//! A counting allocator: an input that takes too much memory for its size counts as a crash.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

/// The system's allocator, which counts the current and the largest use of memory.
pub struct Counting;

fn add(bytes: usize) {
    let now = NOW.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(now, Ordering::Relaxed);
}

// SAFETY: all is done by the system's allocator; only sizes are counted here.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: the caller's promises hold.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: the caller's promises hold.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promises hold.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        add(size);
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promises hold.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Runs a reader and panics if it uses more than `most` bytes at once.
pub fn within(most: usize, read: impl FnOnce()) {
    let before = NOW.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    read();
    let peak = PEAK.load(Ordering::Relaxed).saturating_sub(before);
    assert!(peak <= most, "{peak} bytes were taken, more than {most}");
}

/// Memory of the smallest model: mostly the buffers of threads and parsers.
const SLACK_BYTES: usize = 1 << 20;

/// Most memory for a model, or any input except pictures: 20 times the file.
pub fn of_model(bytes: &[u8]) -> usize {
    bytes.len() * tinta::limits::MEMORY_FACTOR + SLACK_BYTES
}

/// Most memory for a possible glTF file, whose accessors may be zeros without any bytes: the additional memory that
/// docs/dev/limits.md allows is legitimate. Primitives and nodes may repeat it, each as often as its words are
/// there. `None` if they repeat it so often that only the free memory bounds it: tests do that.
pub fn of_gltf(bytes: &[u8]) -> Option<usize> {
    const MOST_COPIES: usize = 16;
    let words = |word: &[u8]| bytes.windows(word.len()).filter(|window| *window == word).count();
    let copies = words(b"\"mesh\"").max(1) * words(b"\"attributes\"").max(1);
    let has_instances = words(b"EXT_mesh_gpu_instancing") > 0;
    match bytes.contains(&b'{') {
        true if copies > MOST_COPIES || has_instances => None,
        true => Some(
            (bytes.len() * tinta::limits::MEMORY_FACTOR + tinta::limits::MEMORY_SLACK_BYTES).saturating_mul(copies),
        ),
        false => Some(of_model(bytes)),
    }
}

/// Most memory for a possible 3MF file, which may unpack to 64 MiB. `None` if it puts objects so often that only the free memory
/// bounds it: tests do that.
pub fn of_three_mf(bytes: &[u8]) -> Option<usize> {
    const MOST_PLACES: usize = 8;
    let places = bytes.windows(8).filter(|word| *word == b"objectid").count();
    let most = of_model(bytes) + 2 * tinta::limits::MEMORY_SLACK_BYTES;
    (places <= MOST_PLACES).then_some(most)
}

/// Most memory for a list of jobs: a line of 27 bytes may be a job, with separate strings for its name, content and hash.
pub fn of_list(bytes: &[u8]) -> usize {
    64 * bytes.len() + SLACK_BYTES
}

/// Most memory for a picture: its pixels at 12 bytes each (16 bits a channel in the file, 8 bits after it), as many as the
/// file can hold and as are read.
pub fn of_picture(bytes: &[u8]) -> usize {
    let pixels = (bytes.len() as u64 * tinta::limits::PIXELS_A_BYTE).min(tinta::limits::PICTURE_BYTES / 4);
    of_model(bytes) + 12 * pixels as usize
}

/// Most memory for drawings of a small scene.
pub const OF_DRAWING: usize = 256 << 20;
