//! An interpreter of GLSL 1.20: runs one vertex or one pixel on the CPU and records what each statement did.
//!
//! Today's shader debuggers refuse this version of the language. A [`Stage`] is parsed from the texts of one or several shaders.
//! [`Stage::run`] takes the values of uniforms and inputs and returns the outputs with a trace: the line of each statement, the
//! variables it set, the branches it took and the texels it read. Numbers are kept in 64 bits or, as drivers do, in 32.
//!
//! Not understood: arrays and structures of a shader's own, `#if`.
//!
//! ```
//! use tinta_glsl::{Settings, Stage, Trace, Value, What};
//!
//! let text = "#version 120\nuniform float threshold;\nvoid main() {\n    float tone = 0.25;\n    if (tone < threshold) discard;\n}";
//! let stage = Stage::new(&[("tone.frag", text)]).expect("a shader");
//! let inputs = [("threshold", Value::floats(&[0.5]))];
//! let run = stage.run(&inputs, &(), &Settings { trace: Trace::Everything, ..Settings::default() }).expect("a run");
//! assert!(run.is_discarded);
//! assert_eq!(run.events[0].line, 4);
//! let What::Branched { is_taken: true, compared: Some(tone) } = &run.events[1].what else { panic!("no branch") };
//! assert_eq!((tone.left, tone.operator, tone.right), (0.25, "<", 0.5));
//! ```

mod value;
mod arithmetic;
mod mistake;
pub mod tokens;
mod preprocess;
mod syntax;
mod state;
mod parse;
mod program;
mod variables;
mod trace;
mod machine;
mod stage;

pub use arithmetic::Precision;
pub use mistake::Mistake;
pub use stage::Stage;
pub use trace::{Comparison, Event, Run, Sample, Settings, Texel, Textures, Trace, What};
pub use value::{Base, Type, Value};
