//! Values of GLSL 1.20: scalars, vectors and matrices of up to four rows and columns.

use serde::{Serialize, Serializer};
use std::fmt;

/// What a value's numbers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// Nothing: what a function without a result returns.
    Void,
    /// 0 or 1.
    Bool,
    /// Whole numbers.
    Int,
    /// Floating point.
    Float,
    /// A texture, by its number among the program's samplers.
    Sampler,
}

/// A type: scalars have one column and one row, vectors one column, matrices of n columns n rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Type {
    /// Of each number.
    pub base: Base,
    /// From 1 to 4.
    pub columns: u8,
    /// From 1 to 4.
    pub rows: u8,
}

/// A value: its numbers column by column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// Its type.
    pub of: Type,
    numbers: [f64; 16],
}

impl Type {
    /// The type of no value.
    pub(crate) const VOID: Self = Self::vector(Base::Void, 1);
    /// bool
    pub(crate) const BOOL: Self = Self::vector(Base::Bool, 1);
    /// int
    pub const INT: Self = Self::vector(Base::Int, 1);
    /// float
    pub const FLOAT: Self = Self::vector(Base::Float, 1);

    /// Returns the type of a vector, or of a scalar where `rows` is 1.
    pub const fn vector(base: Base, rows: u8) -> Self {
        Self { base, columns: 1, rows }
    }

    /// Returns the type of this name; `None` for any other word.
    pub fn named(name: &str) -> Option<Self> {
        let sized = |base, prefix: &str| {
            let rows = name.strip_prefix(prefix)?.parse().ok().filter(|rows| (2..=4).contains(rows))?;
            Some(Self::vector(base, rows))
        };
        match name {
            "void" => Some(Self::VOID),
            "bool" => Some(Self::BOOL),
            "int" => Some(Self::INT),
            "float" => Some(Self::FLOAT),
            "sampler1D" | "sampler2D" => Some(Self::vector(Base::Sampler, 1)),
            _ => sized(Base::Float, "vec")
                .or_else(|| sized(Base::Int, "ivec"))
                .or_else(|| sized(Base::Bool, "bvec"))
                .or_else(|| sized(Base::Float, "mat").map(|of| Self { columns: of.rows, ..of })),
        }
    }

    /// How many numbers a value has.
    pub fn count(self) -> usize {
        usize::from(self.columns) * usize::from(self.rows)
    }

    /// Whether it is one number.
    pub(crate) fn is_scalar(self) -> bool {
        self.count() == 1
    }

    /// Whether it has several columns.
    pub fn is_matrix(self) -> bool {
        self.columns > 1
    }
}

impl fmt::Display for Type {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scalar, prefix) = match self.base {
            Base::Void => ("void", ""),
            Base::Bool => ("bool", "b"),
            Base::Int => ("int", "i"),
            Base::Float => ("float", ""),
            Base::Sampler => ("sampler", ""),
        };
        match (self.columns, self.rows) {
            (1, 1) => out.write_str(scalar),
            (1, rows) => write!(out, "{prefix}vec{rows}"),
            (columns, _) => write!(out, "mat{columns}"),
        }
    }
}

impl Value {
    /// Returns a value of this type; missing numbers are 0, surplus ones are dropped.
    pub fn new(of: Type, given: &[f64]) -> Self {
        let mut numbers = [0.0; 16];
        let count = of.count().min(given.len());
        numbers[..count].copy_from_slice(&given[..count]);
        Self { of, numbers }
    }

    /// Returns a float, or a vector of as many floats as given, at most four.
    pub fn floats(given: &[f64]) -> Self {
        Self::new(Type::vector(Base::Float, given.len().clamp(1, 4) as u8), given)
    }

    /// Returns a bool.
    pub fn bool(given: bool) -> Self {
        Self::new(Type::BOOL, &[f64::from(u8::from(given))])
    }

    /// Returns an int.
    pub fn int(given: i32) -> Self {
        Self::new(Type::INT, &[f64::from(given)])
    }

    /// Returns a square matrix of these numbers, column by column: 4, 9 or 16.
    pub fn matrix(given: &[f64]) -> Self {
        let side = [2, 3].into_iter().find(|side| side * side == given.len()).unwrap_or(4) as u8;
        Self::new(Type { base: Base::Float, columns: side, rows: side }, given)
    }

    /// Its numbers, column by column.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.of.count()]
    }

    /// The same to change.
    pub fn numbers_mut(&mut self) -> &mut [f64] {
        &mut self.numbers[..self.of.count()]
    }

    /// Its first number.
    pub fn first(&self) -> f64 {
        self.numbers[0]
    }

    /// Whether its first number is not 0.
    pub fn is_true(&self) -> bool {
        self.first() != 0.0
    }

    /// Returns a value of the same shape with each number changed.
    #[must_use]
    pub fn map(mut self, change: impl Fn(f64) -> f64) -> Self {
        self.numbers_mut().iter_mut().for_each(|number| *number = change(*number));
        self
    }

    /// Returns the same numbers as another base: bools become 0 or 1, floats lose their fraction as ints.
    #[must_use]
    pub(crate) fn as_base(mut self, base: Base) -> Self {
        self.of.base = base;
        match base {
            Base::Bool => self.map(|number| f64::from(u8::from(number != 0.0))),
            Base::Int => self.map(f64::trunc),
            _ => self,
        }
    }
}

impl fmt::Display for Value {
    /// Six digits after the point; vectors and matrices in brackets.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |number: &f64| match self.of.base {
            Base::Bool if *number == 0.0 => "false".to_owned(),
            Base::Bool => "true".to_owned(),
            Base::Int | Base::Sampler => format!("{number}"),
            Base::Void | Base::Float => format!("{:.6}", number + 0.0),
        };
        let numbers: Vec<String> = self.numbers().iter().map(number).collect();
        if self.of.is_scalar() { out.write_str(&numbers[0]) } else { write!(out, "({})", numbers.join(", ")) }
    }
}

/// A number, or a list of numbers; bools as such.
impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match (self.of.base, self.of.is_scalar()) {
            (Base::Bool, true) => serializer.serialize_bool(self.is_true()),
            (_, true) => serializer.serialize_f64(self.first()),
            _ => serializer.collect_seq(self.numbers()),
        }
    }
}
