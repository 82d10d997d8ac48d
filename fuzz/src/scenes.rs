//! The duty of every drawing for small scenes of any bytes: drawn, or refused in one sentence, without a panic, without infinite
//! numbers or NaN.
//!
//! The bytes choose parts: balls, boxes, slivers, sheets and fans, tiny and huge, far apart and repeated. For the fuzz target, for
//! `tests/documents/corpus.rs`, and for pictures of a few hundred of them.

use std::fmt::Write as _;
use std::sync::Arc;
use tinta::lines::DrawingFormat;
use tinta::mesh::read_bytes;
use tinta::request::{DrawingFile, Request, WantedLines, layers};
use tinta::settings::{OptionValue, Options};
use tinta::{Result, Scene};

/// The most triangles of a scene.
const TRIANGLES: usize = 600;

/// Bytes that choose a part.
const PART: usize = 7;

/// The drawings of each scene: options over the default look.
pub const DRAWINGS: [&[(&str, &str)]; 4] = [
    &[],
    &[("style", "lines"), ("silhouette", "smooth")],
    &[("hatch", "auto")],
    &[("style", "lines"), ("normals", "lasting"), ("classes", "boundary,silhouette,crease,tangent,intersection")],
];

/// Draws a scene as SVG in each way.
pub fn drawing(bytes: &[u8]) {
    for options in DRAWINGS {
        match svg(bytes, options) {
            Ok(svg) => assert!(!svg.contains("NaN") && !svg.contains("inf "), "{options:?}: {svg:.2000}"),
            Err(error) => {
                let sentence = error.to_string();
                assert!(
                    sentence.len() > 8 && sentence.len() < 2000 && !sentence.contains('\n'),
                    "{options:?}: {sentence}"
                );
            }
        }
    }
}

fn svg(bytes: &[u8], options: &[(&str, &str)]) -> Result<String> {
    let (request, scene) = scene(bytes, options)?;
    let drawn = request.still(scene, true)?.drawn_lines(WantedLines::default(), &Default::default())?;
    let svg = drawn.written(DrawingFormat::SVG, None, None).and_then(DrawingFile::bytes)?;
    Ok(String::from_utf8_lossy(&svg).into_owned())
}

/// A scene of any bytes, and the request of its drawing.
pub fn scene(bytes: &[u8], options: &[(&str, &str)]) -> Result<(Request, Scene)> {
    let size = ("size", "96x64");
    let given = options.iter().chain([&size]).map(|(name, value)| ((*name).to_owned(), OptionValue::text(*value)));
    let given: Options = given.collect();
    let (request, _) = Request::from_layers(&layers(None, Vec::new(), given, false))?;
    let mesh = read_bytes(obj(bytes).as_bytes(), "fuzz.obj", &[], &request.read)?.mesh;
    let scene = Scene::new([Arc::new(mesh)], &request.scene)?;
    Ok((request, scene))
}

/// The scene as an OBJ file.
pub fn obj(bytes: &[u8]) -> String {
    let mut scene = Obj::default();
    for part in bytes.chunks_exact(PART) {
        let [kind, size, x, y, z, repeats, form] = *part else { break };
        let size = 10f64.powi(i32::from(size % 10) - 6) * (1.0 + f64::from(size / 10) / 10.0);
        let place = [x, y, z].map(|at| f64::from(i32::from(at & 63) - 32) * 10f64.powi(i32::from(at >> 6) - 2));
        let step = size * [0.0, 0.5, 1.0, 4.0][usize::from(repeats >> 6)];
        for copy in 0..=repeats % 16 {
            let at = [place[0] + step * f64::from(copy), place[1], place[2]];
            scene.add(kind, size, at, f64::from(form) / 255.0);
        }
    }
    scene.text
}

#[derive(Default)]
struct Obj {
    text: String,
    vertices: usize,
    triangles: usize,
}

impl Obj {
    fn add(&mut self, kind: u8, size: f64, at: [f64; 3], form: f64) {
        let flat = 10f64.powf(-6.0 * form);
        match kind % 7 {
            0 => self.grid(size, at, [6, 4], |u, v| {
                let (around, down) = (u * std::f64::consts::TAU, v * std::f64::consts::PI);
                [around.cos() * down.sin(), around.sin() * down.sin(), down.cos() * (0.2 + form)]
            }),
            1 => self.grid(size, at, [4, 1], |u, v| {
                let around = (u + 0.125) * std::f64::consts::TAU;
                [around.cos(), around.sin() * (0.1 + form), v]
            }),
            2 => self.polygons(
                size,
                at,
                &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, flat]],
                &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]],
            ),
            3 => self.polygons(size, at, &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, flat, 0.0]], &[&[0, 1, 2]]),
            // Three faces at one edge, one of them with a sliver.
            4 => self.polygons(
                size,
                at,
                &[[500.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -flat, 0.0], [2.0, 0.0, 0.0], [0.0; 3]],
                &[&[2, 1, 5], &[1, 5, 4], &[5, 3, 0, 1]],
            ),
            5 => self.grid(size, at, [5, 5], |u, v| [u, v, form * (u * 9.0).sin() * (v * 7.0).cos()]),
            _ => self.grid(size, at, [8, 1], |u, v| {
                let around = u * std::f64::consts::PI * (0.5 + form);
                [around.cos(), around.sin(), v * flat]
            }),
        }
    }

    /// A sheet of quads over the unit square.
    fn grid(&mut self, size: f64, at: [f64; 3], [columns, rows]: [usize; 2], place: impl Fn(f64, f64) -> [f64; 3]) {
        let number = |index: usize| (index % (columns + 1), index / (columns + 1));
        let places: Vec<[f64; 3]> = (0..(columns + 1) * (rows + 1))
            .map(|index| {
                let (column, row) = number(index);
                place(column as f64 / columns as f64, row as f64 / rows as f64)
            })
            .collect();
        let quads: Vec<[usize; 4]> = (0..columns * rows)
            .map(|quad| {
                let first = quad / columns * (columns + 1) + quad % columns;
                [first, first + 1, first + columns + 2, first + columns + 1]
            })
            .collect();
        let faces: Vec<&[usize]> = quads.iter().map(|quad| &quad[..]).collect();
        self.polygons(size, at, &places, &faces);
    }

    fn polygons(&mut self, size: f64, at: [f64; 3], places: &[[f64; 3]], faces: &[&[usize]]) {
        self.triangles += faces.iter().map(|face| face.len() - 2).sum::<usize>();
        if self.triangles > TRIANGLES {
            return;
        }
        for place in places {
            let [x, y, z] = [0, 1, 2].map(|axis| at[axis] + size * place[axis]);
            let _ = writeln!(self.text, "v {x} {y} {z}");
        }
        for face in faces {
            let corners: Vec<String> = face.iter().map(|corner| (self.vertices + corner + 1).to_string()).collect();
            let _ = writeln!(self.text, "f {}", corners.join(" "));
        }
        self.vertices += places.len();
    }
}
