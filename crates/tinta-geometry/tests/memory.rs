//! Memory at the peak, counted by the allocator and never by a clock or the system: of the exact lines and of reading files.
//!
//! One test in a process of its own, because everything counts.

#![expect(unsafe_code, reason = "an allocator that counts can only be written so")]

use glam::DVec3;
use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use tinta_geometry::{LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines, load};

/// The system's allocator, counting.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn grow(bytes: usize) {
    let held = HELD.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(held, Ordering::Relaxed);
}

// SAFETY: every call is passed on to the system's allocator as it is; counting touches no memory that is given out.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        grow(layout.size());
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        grow(layout.size());
        // SAFETY: as the caller promises.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(place, layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // While it moves both are there.
        grow(size);
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// What some work returns, and how many bytes more than before were held at most meanwhile.
fn peak<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = HELD.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let result = work();
    (result, PEAK.load(Ordering::Relaxed) - before)
}

/// A sphere with bumps, a closed mesh of about so many triangles.
fn sphere(triangles: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let rows = ((triangles as f64) / 4.0).sqrt().round() as u32;
    let columns = rows * 2;
    let mut positions = vec![DVec3::Y, DVec3::NEG_Y];
    for row in 1..rows {
        for column in 0..columns {
            let (polar, around) = (PI * f64::from(row) / f64::from(rows), TAU * f64::from(column) / f64::from(columns));
            let direction = DVec3::new(polar.sin() * around.sin(), polar.cos(), polar.sin() * around.cos());
            positions.push(direction * (1.0 + 0.2 * (9.0 * polar).sin() * (7.0 * around).sin()));
        }
    }
    let at = |row: u32, column: u32| match row {
        0 => 0,
        row if row == rows => 1,
        row => 2 + (row - 1) * columns + column % columns,
    };
    let mut faces = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
            faces.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    (positions, faces)
}

/// The mesh as files of three formats.
fn files(positions: &[DVec3], triangles: &[[u32; 3]], folder: &std::path::Path) -> [(String, std::path::PathBuf); 3] {
    let mut obj = String::new();
    for DVec3 { x, y, z } in positions {
        writeln!(obj, "v {x:.6} {y:.6} {z:.6}").unwrap();
    }
    for [a, b, c] in triangles {
        writeln!(obj, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    let mut ply = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        triangles.len()
    )
    .into_bytes();
    positions.iter().for_each(|point| ply.extend(point.to_array().map(|x| (x as f32).to_le_bytes()).as_flattened()));
    for triangle in triangles {
        ply.push(3);
        ply.extend(triangle.map(u32::to_le_bytes).as_flattened());
    }
    let mut stl = vec![0; 80];
    stl.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        stl.extend([0; 12]);
        for corner in triangle {
            let point = positions[*corner as usize];
            stl.extend(point.to_array().map(|x| (x as f32).to_le_bytes()).as_flattened());
        }
        stl.extend([0; 2]);
    }
    [("obj", obj.into_bytes()), ("ply", ply), ("stl", stl)].map(|(name, bytes)| {
        let path = folder.join(format!("sphere.{name}"));
        std::fs::write(&path, bytes).unwrap();
        (name.to_owned(), path)
    })
}

/// Most bytes a triangle, beyond the model itself for the lines, and with it for the readers.
const MOST_OF_LINES: usize = 300;
const MOST_OF_READERS: [(&str, usize); 3] = [("obj", 160), ("ply", 150), ("stl", 310)];

#[test]
fn lines_and_readers_hold_few_bytes_a_triangle_at_the_peak() {
    let (positions, triangles) = sphere(200_000);
    let count = triangles.len();
    let folder = tempfile::tempdir().unwrap();
    let mut failures = Vec::new();
    for ((name, path), (_, most)) in files(&positions, &triangles, folder.path()).into_iter().zip(MOST_OF_READERS) {
        let (loaded, bytes) = peak(|| load(path.to_str().unwrap(), &LoadOptions::default()).unwrap());
        assert_eq!(loaded.mesh.triangles.len(), count, "{name}");
        println!("{name}: {} bytes a triangle", bytes / count);
        if bytes / count > most {
            failures.push(format!("{name}: {} bytes a triangle, not {most}", bytes / count));
        }
    }
    let file_vertices = (0..positions.len() as u32).collect();
    let (normals, triangle_normals) = (Vec::new(), Vec::new());
    let mesh = Mesh { positions, file_vertices, triangles, normals, triangle_normals, ..Mesh::triangle() };
    let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap();
    let settings = LineSettings { finds_hidden: false, ..LineSettings::default() };
    let (lines, bytes) = peak(|| VisibleLines::of(&scene, &settings).unwrap());
    assert!(lines.segments.len() > 1_000);
    println!("lines: {} bytes a triangle", bytes / count);
    if bytes / count > MOST_OF_LINES {
        failures.push(format!("lines: {} bytes a triangle, not {MOST_OF_LINES}", bytes / count));
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
