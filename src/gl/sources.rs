//! The shader texts that programs are compiled from: those of `glsl/` or their replacements, in the driver's language.

use super::Gl;
use super::legacy::HAS_PIPELINE;
use crate::error::{Error, Result};
use crate::glsl::es::{self, Stage};
use crate::plan;

/// A shader's text.
pub(super) struct Source {
    /// GL_VERTEX_SHADER or GL_FRAGMENT_SHADER.
    pub(super) kind: u32,
    /// The name for error messages.
    pub(super) path: String,
    /// The text to compile.
    pub(super) text: String,
}

/// Returns a program's shaders, one text each. A browser gets one text per stage, because its language is rewritten and cannot
/// link parts.
pub(super) fn of_program(gl: &Gl, program: &plan::Program) -> Result<Vec<Source>> {
    if HAS_PIPELINE {
        return [program.vertex].iter().chain(&program.fragments).map(|path| of_shader(gl, path)).collect();
    }
    [(Stage::Vertex, &[program.vertex][..]), (Stage::Fragment, &program.fragments)]
        .into_iter()
        .map(|(stage, paths)| {
            let texts: Vec<String> = paths.iter().map(|path| original(gl, path)).collect::<Result<_>>()?;
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let path = paths.join(" + ");
            let refused = |log| Error::Shader { path: path.clone(), log };
            Ok(Source { kind: kind(stage), text: es::linked(stage, &texts).map_err(refused)?, path })
        })
        .collect()
}

/// A single shader.
pub(super) fn of_shader(gl: &Gl, path: &str) -> Result<Source> {
    let (stage, text) = (Stage::of(path), original(gl, path)?);
    let refused = |log| Error::Shader { path: path.to_owned(), log };
    let text = if HAS_PIPELINE { text } else { es::linked(stage, &[&text]).map_err(refused)? };
    Ok(Source { kind: kind(stage), path: path.to_owned(), text })
}

fn kind(stage: Stage) -> u32 {
    match stage {
        Stage::Vertex => glow::VERTEX_SHADER,
        Stage::Fragment => glow::FRAGMENT_SHADER,
    }
}

/// A shader's text, in GLSL 1.20.
fn original(gl: &Gl, path: &str) -> Result<String> {
    let replaced = gl.replaced_shaders.borrow();
    let text = replaced.get(path).map(String::as_str).or_else(|| crate::glsl::source(path)).map(str::to_owned);
    text.ok_or_else(|| Error::Shader { path: path.to_owned(), log: "it is not part of this program".to_owned() })
}
