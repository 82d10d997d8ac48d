//! Writes a model as Wavefront OBJ text with its MTL colours.
//!
//! In: named parts, each a mesh with a material. Out: `NAME.obj` and, when
//! the parts have materials, `NAME.mtl` beside it, with coordinates rounded
//! to five decimals.

use crate::mesh::Mesh;
use crate::vector::{Vec3, v};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// A name and the diffuse colour (`Kd`, 0 to 1 a channel) of a surface.
#[derive(Clone, Copy)]
pub struct Material {
    pub name: &'static str,
    pub colour: [f64; 3],
}

/// How the file shades a part.
pub enum Shading {
    /// No normals in the file: whoever draws the part makes them.
    Unstated,
    /// Smooth over edges flatter than the angle with this cosine.
    Smooth { crease_cosine: f64 },
    /// A unit normal for every corner of every triangle.
    Given(Vec<[Vec3; 3]>),
}

pub struct Part {
    pub name: String,
    pub material: Option<Material>,
    pub shading: Shading,
    /// A closed part is checked before it is written.
    pub closed: bool,
    pub mesh: Mesh,
}

pub struct Model {
    pub name: &'static str,
    /// One line that says what the model is, for the head of the file.
    pub title: &'static str,
    pub parts: Vec<Part>,
}

impl Model {
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|p| p.mesh.triangles.len()).sum()
    }
}

/// Writes the model's files, or says in one sentence why it could not.
pub fn write(model: &Model, folder: &Path) -> Result<(), String> {
    let materials = materials(model);
    save(&folder.join(format!("{}.obj", model.name)), &obj_text(model, &materials)?)?;
    if !materials.is_empty() {
        save(&folder.join(format!("{}.mtl", model.name)), &mtl_text(model, &materials))?;
    }
    Ok(())
}

fn save(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

fn materials(model: &Model) -> Vec<Material> {
    let mut found: Vec<Material> = Vec::new();
    for material in model.parts.iter().filter_map(|part| part.material) {
        if found.iter().all(|other| other.name != material.name) {
            found.push(material);
        }
    }
    found
}

fn mtl_text(model: &Model, materials: &[Material]) -> String {
    let mut text = format!("# Colours of {}.obj, written by make-models.\n", model.name);
    for material in materials {
        let [red, green, blue] = material.colour;
        let _ = write!(text, "\nnewmtl {}\n", material.name);
        let _ = writeln!(text, "Kd {red:.3} {green:.3} {blue:.3}");
        text.push_str("Ka 0 0 0\nKs 0 0 0\nillum 1\n");
    }
    text
}

fn obj_text(model: &Model, materials: &[Material]) -> Result<String, String> {
    let mut text = format!(
        "# {}\n# Written by make-models (models/make.rs); {} triangles.\n",
        model.title,
        model.triangle_count()
    );
    if !materials.is_empty() {
        let _ = writeln!(text, "mtllib {}.mtl", model.name);
    }
    let mut first_position = 1;
    let mut normals = Normals::default();
    for part in &model.parts {
        let mesh = rounded(&part.mesh);
        if let Some(fault) = mesh.closed_fault().filter(|_| part.closed) {
            return Err(format!("part {} of {} is not sound: {fault}", part.name, model.name));
        }
        let _ = writeln!(text, "o {}", part.name);
        for p in &mesh.positions {
            let _ = writeln!(text, "v {}", decimals(*p, 5));
        }
        let corners = match &part.shading {
            Shading::Unstated => None,
            Shading::Smooth { crease_cosine } => Some(mesh.corner_normals(*crease_cosine)),
            Shading::Given(normals) => Some(normals.clone()),
        };
        let mut faces = String::new();
        if let Some(material) = part.material {
            let _ = writeln!(faces, "usemtl {}", material.name);
        }
        for (face, triangle) in mesh.triangles.iter().enumerate() {
            faces.push('f');
            for corner in 0..3 {
                let _ = write!(faces, " {}", first_position + triangle[corner]);
                if let Some(corners) = &corners {
                    let number = normals.number(corners[face][corner], &mut text);
                    let _ = write!(faces, "//{number}");
                }
            }
            faces.push('\n');
        }
        text.push_str(&faces);
        first_position += mesh.positions.len();
    }
    Ok(text)
}

/// The `vn` lines so far; equal directions share one line.
#[derive(Default)]
struct Normals {
    numbers: BTreeMap<String, usize>,
}

impl Normals {
    fn number(&mut self, normal: Vec3, text: &mut String) -> usize {
        let written = decimals(normal, 3);
        let next = self.numbers.len() + 1;
        *self.numbers.entry(written).or_insert_with_key(|line| {
            let _ = writeln!(text, "vn {line}");
            next
        })
    }
}

/// The mesh as a reader of the file will see it.
fn rounded(mesh: &Mesh) -> Mesh {
    let round = |x: f64| (x * 1e5).round() / 1e5;
    Mesh {
        positions: mesh.positions.iter().map(|p| v(round(p.x), round(p.y), round(p.z))).collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// Three fixed-point numbers without a negative zero or trailing zeros.
fn decimals(p: Vec3, places: usize) -> String {
    let number = |x: f64| {
        let fixed = format!("{x:.places$}");
        let short = fixed.trim_end_matches('0').trim_end_matches('.');
        if short == "-0" { "0".to_owned() } else { short.to_owned() }
    };
    format!("{} {} {}", number(p.x), number(p.y), number(p.z))
}
