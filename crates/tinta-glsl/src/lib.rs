//! An interpreter of GLSL 1.20: runs one vertex or one pixel on the CPU and records what each statement did.
//!
//! Today's shader debuggers refuse this version of the language. A [`Stage`] is parsed from the texts of one or several shaders.
//! [`Stage::run`] takes the values of uniforms and inputs and returns the outputs with a trace: the line of each statement, the
//! variables it set, the branches it took and the texels it read. Numbers are kept in 64 bits or, as drivers do, in 32.
//!
//! Not understood: arrays and structures of a shader's own, `#if`.
//!
//! ```
//! use tinta_glsl::{Settings, Stage, Value, What};
//!
//! let text = "#version 120\nuniform float threshold;\nvoid main() {\n    float tone = 0.25;\n    if (tone < threshold) discard;\n}";
//! let stage = Stage::new(&[("tone.frag", text)]).expect("a shader");
//! let inputs = [("threshold", Value::floats(&[0.5]))];
//! let run = stage.run(&inputs, &(), &Settings { is_traced: true, ..Settings::default() }).expect("a run");
//! assert!(run.is_discarded);
//! assert_eq!(run.events[0].line, 4);
//! assert_eq!(run.events[1].what, What::Branched { is_taken: true });
//! ```

mod arithmetic;
mod parse;
mod preprocess;
mod run;
mod syntax;
pub mod tokens;
mod value;

pub use arithmetic::Precision;
pub use run::{Event, Run, Sample, Settings, Stage, Texel, Textures, What};
pub use value::{Base, Type, Value};

/// What is wrong with a shader, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{path}, line {line}: {problem}")]
pub struct Mistake {
    /// The shader's name, as given.
    pub path: String,
    /// Counted from 1, in the text as written.
    pub line: u32,
    /// What is wrong, a sentence without its full stop.
    pub problem: String,
}
