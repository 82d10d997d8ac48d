//! Large synthetic models, their files in all formats that can hold them, and a counting allocator: for the memory
//! test and the reading benchmark.

use std::alloc::{GlobalAlloc, Layout, System};
use std::f64::consts::{PI, TAU};
use std::fs::File;
use std::io::{BufWriter, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use tinta_geometry::glam::DVec3;

/// The system's allocator with a counter.
pub struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn grow(bytes: usize) {
    let held = HELD.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(held, Ordering::Relaxed);
}

// SAFETY: every call is passed on to the system's allocator unchanged; counting touches no allocated memory.
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
        // During the move both blocks exist.
        grow(size);
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.realloc(place, layout, size) }
    }
}

/// Runs some work; returns its result and the peak of additional bytes held.
pub fn peak<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = HELD.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let result = work();
    (result, PEAK.load(Ordering::Relaxed) - before)
}

/// A sphere with bumps: a closed mesh with about this many triangles.
pub fn sphere(triangles: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
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

type Writer = fn(&mut BufWriter<File>, &[DVec3], &[[u32; 3]]) -> Result<()>;

/// The formats that hold any number of triangles: name, file extension and writer.
const FORMATS: [(&str, &str, Writer); 5] = [
    ("OBJ", "obj", write_obj),
    ("PLY, binary", "ply", write_ply),
    ("PLY, text", "text.ply", write_text_ply),
    ("STL, binary", "stl", write_stl),
    ("GLB", "glb", write_glb),
];

pub fn files(positions: &[DVec3], triangles: &[[u32; 3]], folder: &Path) -> Result<Vec<(&'static str, PathBuf)>> {
    let written = |(name, ending, write): (&'static str, &str, Writer)| {
        let path = folder.join(format!("sphere.{ending}"));
        let mut file = BufWriter::new(File::create(&path)?);
        write(&mut file, positions, triangles)?;
        file.flush()?;
        Ok((name, path))
    };
    FORMATS.into_iter().map(written).collect()
}

fn floats(point: DVec3) -> [u8; 12] {
    let mut bytes = [0; 12];
    bytes.copy_from_slice(point.to_array().map(|x| (x as f32).to_le_bytes()).as_flattened());
    bytes
}

fn write_obj(file: &mut BufWriter<File>, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<()> {
    positions.iter().try_for_each(|DVec3 { x, y, z }| writeln!(file, "v {x:.6} {y:.6} {z:.6}"))?;
    triangles.iter().try_for_each(|[a, b, c]| writeln!(file, "f {} {} {}", a + 1, b + 1, c + 1))
}

fn write_ply_header(file: &mut BufWriter<File>, encoding: &str, vertices: usize, faces: usize) -> Result<()> {
    write!(
        file,
        "ply\nformat {encoding} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn write_ply(file: &mut BufWriter<File>, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<()> {
    write_ply_header(file, "binary_little_endian", positions.len(), triangles.len())?;
    positions.iter().try_for_each(|point| file.write_all(&floats(*point)))?;
    triangles.iter().try_for_each(|triangle| {
        file.write_all(&[3])?;
        file.write_all(triangle.map(u32::to_le_bytes).as_flattened())
    })
}

fn write_text_ply(file: &mut BufWriter<File>, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<()> {
    write_ply_header(file, "ascii", positions.len(), triangles.len())?;
    positions.iter().try_for_each(|DVec3 { x, y, z }| writeln!(file, "{x:.6} {y:.6} {z:.6}"))?;
    triangles.iter().try_for_each(|[a, b, c]| writeln!(file, "3 {a} {b} {c}"))
}

fn write_stl(file: &mut BufWriter<File>, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<()> {
    file.write_all(&[0; 80])?;
    file.write_all(&(triangles.len() as u32).to_le_bytes())?;
    triangles.iter().try_for_each(|triangle| {
        file.write_all(&[0; 12])?;
        triangle.iter().try_for_each(|corner| file.write_all(&floats(positions[*corner as usize])))?;
        file.write_all(&[0; 2])
    })
}

fn write_glb(file: &mut BufWriter<File>, positions: &[DVec3], triangles: &[[u32; 3]]) -> Result<()> {
    let (places, indices) = (positions.len() * 12, triangles.len() * 12);
    let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min).to_array();
    let high = positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max).to_array();
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":
        [{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"buffers":[{{"byteLength":{}}}],"bufferViews":
        [{{"buffer":0,"byteLength":{places}}},{{"buffer":0,"byteOffset":{places},"byteLength":{indices}}}],"accessors":
        [{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":{low:?},"max":{high:?}}},
        {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]}}"#,
        places + indices,
        positions.len(),
        triangles.len() * 3,
    );
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let chunk = |length: usize, kind: &[u8; 4]| [&(length as u32).to_le_bytes(), kind.as_slice()].concat();
    file.write_all(b"glTF\x02\0\0\0")?;
    file.write_all(&((12 + 8 + json.len() + 8 + places + indices) as u32).to_le_bytes())?;
    file.write_all(&chunk(json.len(), b"JSON"))?;
    file.write_all(json.as_bytes())?;
    file.write_all(&chunk(places + indices, b"BIN\0"))?;
    positions.iter().try_for_each(|point| file.write_all(&floats(*point)))?;
    triangles.iter().try_for_each(|triangle| file.write_all(triangle.map(u32::to_le_bytes).as_flattened()))
}
