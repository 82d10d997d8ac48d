//! Shaders that replace the fixed-function pipeline on drivers without one: those in `glsl/fixed/`.

use crate::plan::{Draw, Geometry, LineDrawing, Mark, Program};

/// Vertices without lighting.
const VERTEX: &str = "fixed/transform.vert";

/// Fragments, by the number of enabled texture units.
const FRAGMENTS: [&str; 3] = ["fixed/untextured.frag", "fixed/one-texture.frag", "fixed/two-textures.frag"];

/// The names of their samplers.
const SAMPLERS: [&str; 2] = ["texture0", "texture1"];

/// The program for smoothed lines and points.
pub(super) fn smooth(mark: Mark) -> Program {
    let fragment = match mark {
        Mark::Lines => "fixed/smooth-line.frag",
        Mark::Points => "fixed/smooth-point.frag",
    };
    Program::new(VERTEX, [fragment])
}

/// Returns the program of a draw; `None` for the pipeline.
pub(crate) fn program_of(draw: &Draw, has_pipeline: bool) -> Option<Program> {
    let fragments = || vec![FRAGMENTS[draw.textures.len().min(FRAGMENTS.len() - 1)]];
    match &draw.program {
        program if has_pipeline => program.clone(),
        Some(program) if !program.fragments.is_empty() => Some(program.clone()),
        Some(program) => Some(Program::new(program.vertex.clone(), fragments())),
        None => match draw.geometry {
            Geometry::Edges { mark, is_smooth: true, line_drawing: LineDrawing::Gl, .. } => Some(smooth(mark)),
            _ => Some(Program::new(VERTEX, fragments())),
        },
    }
}

/// The sampler name of a texture unit, if the program is one of these.
pub(crate) fn sampler(draw: &Draw, program: &Program, unit: u32) -> Option<&'static str> {
    if draw.program.as_ref() == Some(program) { None } else { SAMPLERS.get(unit as usize).copied() }
}

#[cfg(test)]
mod tests;
