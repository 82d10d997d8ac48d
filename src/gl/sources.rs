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
    /// The shaders that the text is made of, in the order of their numbers in a browser's log; empty where the log names no others.
    parts: Vec<String>,
}

impl Source {
    /// A driver's log, with the shader and its line where a browser writes the number of a part.
    pub(super) fn explained(&self, log: &str) -> String {
        let named = |line: &str| -> Option<String> {
            let (part, rest) = line.trim().strip_prefix("ERROR: ")?.split_once(':')?;
            Some(format!("{}:{rest}", self.parts.get(part.parse::<usize>().ok()?)?))
        };
        let lines = log.trim_end_matches('\0').lines();
        lines.map(|line| named(line).unwrap_or_else(|| line.to_owned())).collect::<Vec<_>>().join("\n")
    }
}

/// Returns a program's shaders, one text each. A browser gets one text per stage, because its language is rewritten and cannot
/// link parts.
pub(super) fn of_program(gl: &Gl, program: &plan::Program) -> Result<Vec<Source>> {
    if HAS_PIPELINE {
        return [&program.vertex].into_iter().chain(&program.fragments).map(|path| of_shader(gl, path)).collect();
    }
    [(Stage::Vertex, std::slice::from_ref(&program.vertex)), (Stage::Fragment, &program.fragments[..])]
        .into_iter()
        .map(|(stage, paths)| {
            let texts: Vec<String> = paths.iter().map(|path| original(gl, path)).collect::<Result<_>>()?;
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let (path, parts) = (paths.join(" + "), paths.iter().map(|path| path.to_string()).collect());
            let refused = |log| Error::Shader { path: path.clone(), log };
            Ok(Source { kind: kind(stage), text: es::linked(stage, &texts).map_err(refused)?, path, parts })
        })
        .collect()
}

/// A single shader.
pub(super) fn of_shader(gl: &Gl, path: &str) -> Result<Source> {
    let (stage, text) = (Stage::of(path), original(gl, path)?);
    let refused = |log| Error::Shader { path: path.to_owned(), log };
    let text = if HAS_PIPELINE { text } else { es::linked(stage, &[&text]).map_err(refused)? };
    Ok(Source { kind: kind(stage), path: path.to_owned(), text, parts: Vec::new() })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_browsers_log_names_the_shader_and_the_line() {
        let parts = vec!["a.frag".to_owned(), "b.frag".to_owned()];
        let source =
            Source { kind: glow::FRAGMENT_SHADER, path: "a.frag + b.frag".to_owned(), text: String::new(), parts };
        let log = "ERROR: 1:4: 'foo' : undeclared identifier\nERROR: 0:12: 'x' : no such\nERROR: 7:1: none\n1 more\0";
        let expected = "b.frag:4: 'foo' : undeclared identifier\na.frag:12: 'x' : no such\nERROR: 7:1: none\n1 more";
        assert_eq!(source.explained(log), expected);
    }
}
