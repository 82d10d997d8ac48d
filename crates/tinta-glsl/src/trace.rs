//! What a run is given and what it returns: its settings, texels, outputs, and what each statement did.

use crate::arithmetic::Precision;
use crate::value::Value;
use serde::Serialize;

/// How a run computes and what it records.
#[derive(Debug, Clone, Copy, Default)]
pub struct Settings<'a> {
    /// How floats are kept.
    pub precision: Precision,
    /// What to record.
    pub trace: Trace,
    /// For each value in [`Run::asked`], in order: its change to the pixel on the right and to the pixel above.
    pub changes: &'a [[Value; 2]],
}

/// What a run records as events.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Trace {
    /// Nothing.
    #[default]
    Nothing,
    /// What every statement does.
    Everything,
}

/// The result of a run.
#[derive(Debug, Clone, Default)]
pub struct Run {
    /// Varyings and GL's own variables, by name, as the run left them.
    pub outputs: Vec<(String, Value)>,
    /// Whether the pixel was discarded.
    pub is_discarded: bool,
    /// What happened, in order, if traced.
    pub events: Vec<Event>,
    /// The arguments of `dFdx`, `dFdy` and `fwidth`, in order: what neighbouring pixels must be asked for.
    pub asked: Vec<Value>,
}

impl Run {
    /// Returns an output; `None` if the run never named it.
    pub fn output(&self, name: &str) -> Option<Value> {
        self.outputs.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
    }
}

/// One thing that a statement did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Event {
    /// The shader's name, as given.
    pub shader: String,
    /// The line in it, counted from 1.
    pub line: u32,
    /// What happened.
    #[serde(flatten)]
    pub what: What,
}

impl Comparison {
    /// The comparison with this many decimals, or with as many more as tell its numbers apart.
    pub fn in_words(&self, decimals: usize) -> String {
        /// As many as tell any two numbers apart that a shader compares.
        const MOST: usize = 17;
        let text = |decimals: usize| [self.left, self.right].map(|number| format!("{number:.decimals$}"));
        let differ = |decimals: &usize| self.left == self.right || text(*decimals)[0] != text(*decimals)[1];
        let [left, right] = text((decimals..MOST).find(differ).unwrap_or(MOST));
        format!("{left} {} {right}", self.operator)
    }
}

/// What a statement did.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// A variable got a value.
    Set {
        /// Its name.
        variable: String,
        /// All of its value, also where a part was set.
        value: Value,
    },
    /// A condition of `if` or `?:` was tested.
    Branched {
        /// Whether it was true.
        is_taken: bool,
        /// The numbers compared, if the condition is one comparison.
        #[serde(skip_serializing_if = "Option::is_none")]
        compared: Option<Comparison>,
    },
    /// A texture was read.
    Read {
        /// The name of its sampler.
        texture: String,
        /// The coordinate.
        at: Value,
        /// The result.
        sample: Sample,
    },
    /// A function of the shader's own returned.
    Returned {
        /// Its name.
        function: String,
        /// Its result.
        value: Value,
    },
    /// The pixel was discarded.
    Discarded,
}

/// A comparison of two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Comparison {
    /// The number on the left.
    pub left: f64,
    /// `<`, `>`, `<=` or `>=`.
    pub operator: &'static str,
    /// The number on the right.
    pub right: f64,
}

/// What a texture returns for a coordinate.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Sample {
    /// Red, green, blue, alpha.
    pub value: [f64; 4],
    /// The texels it comes from.
    pub texels: Vec<Texel>,
}

/// A texel and its share in a sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Texel {
    /// Column and row, from the lower left, counted from 0.
    pub place: [u32; 2],
    /// Its weight; all weights add up to 1.
    pub weight: f64,
    /// Red, green, blue, alpha.
    pub value: [f64; 4],
}

/// The textures that samplers number.
pub trait Textures {
    /// Reads a texture at a coordinate, x and y; `None` if there is no such texture.
    fn read(&self, sampler: usize, at: [f64; 2]) -> Option<Sample>;
}

/// No textures.
impl Textures for () {
    fn read(&self, _: usize, _: [f64; 2]) -> Option<Sample> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_differ_are_told_apart() {
        let told = |left: f64, right: f64| Comparison { left, operator: ">=", right }.in_words(4);
        assert_eq!(told(0.25, 0.8), "0.2500 >= 0.8000");
        assert_eq!(told(0.8, 0.8), "0.8000 >= 0.8000");
        assert_eq!(told(0.799_999_6, 0.8), "0.7999996 >= 0.8000000");
        assert_eq!(told(f64::NAN, 0.8), "NaN >= 0.8000");
    }
}
