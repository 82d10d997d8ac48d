//! Peak memory of exact lines and of reading files, counted by the allocator, never by a clock or the system.
//!
//! It is the only test of its process, because every allocation counts.

#![expect(unsafe_code, reason = "an allocator that counts can only be written so")]

mod big;

use big::{Counting, files, peak, sphere};
use std::sync::Arc;
use tinta_geometry::mesh::VertexArrays;
use tinta_geometry::{LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines, load};

#[global_allocator]
static COUNTING: Counting = Counting;

/// Most bytes per triangle: for the lines in addition to the model, for the readers including it.
const MOST_OF_LINES: usize = 300;
const MOST_OF_READERS: [(&str, usize); 5] =
    [("OBJ", 160), ("PLY, binary", 120), ("PLY, text", 130), ("STL, binary", 200), ("GLB", 150)];

/// Most bytes per triangle that creating the vertex arrays needs in addition to the mesh.
const MOST_OF_ARRAYS: usize = 100;

#[test]
fn lines_and_readers_hold_few_bytes_a_triangle_at_the_peak() {
    let (positions, triangles) = sphere(200_000);
    let count = triangles.len();
    let folder = tempfile::tempdir().unwrap();
    let mut failures = Vec::new();
    let files = files(&positions, &triangles, folder.path()).unwrap();
    for ((name, path), (expected, most)) in files.into_iter().zip(MOST_OF_READERS) {
        assert_eq!(name, expected);
        let (loaded, bytes) = peak(|| load(path.to_str().unwrap(), &LoadOptions::default()).unwrap());
        assert_eq!(loaded.mesh.triangles.len(), count, "{name}");
        println!("{name}: {} bytes a triangle", bytes / count);
        if bytes / count > most {
            failures.push(format!("{name}: {} bytes a triangle, not {most}", bytes / count));
        }
        if name == "OBJ" {
            let (arrays, bytes) = peak(|| VertexArrays::new(&loaded.mesh, 1.0));
            assert_eq!(arrays.indices.len(), count * 3);
            println!("vertex arrays: {} bytes a triangle", bytes / count);
            if bytes / count > MOST_OF_ARRAYS {
                failures.push(format!("vertex arrays: {} bytes a triangle, not {MOST_OF_ARRAYS}", bytes / count));
            }
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
