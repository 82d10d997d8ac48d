//! A stage: its shaders, parsed once and run for one vertex or pixel at a time.

use crate::machine::run;
use crate::mistake::Mistake;
use crate::parse::parse;
use crate::program::Program;
use crate::syntax::Storage;
use crate::trace::{Run, Settings, Textures};
use crate::value::Value;

/// The shaders of one stage: one of them has `main`, the others have functions that it declares.
#[derive(Debug, Clone)]
pub struct Stage {
    program: Program,
    asks_neighbours: bool,
}

impl Stage {
    /// Parses the shaders of a stage, each given by its name and text.
    ///
    /// # Errors
    ///
    /// The first [`Mistake`]; also if no shader has a `main`.
    pub fn new(texts: &[(&str, &str)]) -> Result<Self, Mistake> {
        let shaders = texts.iter().map(|(path, text)| parse(path, text)).collect::<Result<_, _>>()?;
        let asks_neighbours =
            texts.iter().any(|(_, text)| ["dFdx", "dFdy", "fwidth"].iter().any(|name| text.contains(name)));
        let stage = Self { program: Program { shaders }, asks_neighbours };
        if stage.program.function("main", &[]).is_none() {
            let path = texts.first().map_or_else(String::new, |(path, _)| (*path).to_owned());
            return Err(Mistake { path, line: 1, problem: "no shader has a main function".to_owned() });
        }
        Ok(stage)
    }

    /// Whether it computes derivatives, so that [`Settings::changes`] matters.
    pub fn asks_neighbours(&self) -> bool {
        self.asks_neighbours
    }

    /// Returns the names of its varyings, or of a vertex's attributes, each once.
    pub fn varyings(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for global in self.program.shaders.iter().flat_map(|shader| &shader.globals) {
            if global.storage == Storage::Passed && !names.contains(&global.name.as_str()) {
                names.push(&global.name);
            }
        }
        names
    }

    /// Runs `main`. `inputs` gives uniforms, GL's own variables and, for pixels, varyings; samplers are [`crate::Base::Sampler`] numbers
    /// that `textures` understands. What is not given is 0.
    ///
    /// # Errors
    ///
    /// A [`Mistake`] with the line that cannot be carried out: a type that does not fit, an unknown name, a loop without end.
    pub fn run(
        &self,
        inputs: &[(&str, Value)],
        textures: &dyn Textures,
        settings: &Settings<'_>,
    ) -> Result<Run, Mistake> {
        run(&self.program, inputs, textures, settings)
    }
}
