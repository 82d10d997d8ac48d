//! The parts of a shader: what the parser makes and the interpreter runs.

use crate::value::{Type, Value};

/// A parsed shader.
#[derive(Debug, Clone)]
pub(crate) struct Shader {
    /// Its name in messages: a path.
    pub(crate) path: String,
    pub(crate) globals: Vec<Global>,
    pub(crate) functions: Vec<Function>,
}

/// A variable outside of functions.
#[derive(Debug, Clone)]
pub(crate) struct Global {
    pub(crate) storage: Storage,
    pub(crate) of: Type,
    pub(crate) name: String,
    pub(crate) value: Option<Expression>,
    pub(crate) line: u32,
}

/// Who sets a global variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Storage {
    Uniform,
    /// Passed from vertices to pixels, or from the caller to a vertex.
    Passed,
    /// The shader itself.
    Own,
}

/// A function, or its declaration alone.
#[derive(Debug, Clone)]
pub(crate) struct Function {
    pub(crate) of: Type,
    pub(crate) name: String,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) body: Option<Vec<Statement>>,
}

#[derive(Debug, Clone)]
pub(crate) struct Parameter {
    pub(crate) of: Type,
    pub(crate) name: String,
    /// Whether the caller's variable gets its value when the function returns.
    pub(crate) is_out: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct Statement {
    pub(crate) line: u32,
    pub(crate) kind: StatementKind,
}

#[derive(Debug, Clone)]
pub(crate) enum StatementKind {
    Declare(Type, Vec<(String, Option<Expression>)>),
    Expression(Expression),
    Block(Vec<Statement>),
    If(Expression, Box<Statement>, Option<Box<Statement>>),
    /// All three kinds of loop.
    Loop(Loop),
    Return(Option<Expression>),
    Discard,
    Break,
    Continue,
}

#[derive(Debug, Clone)]
pub(crate) struct Loop {
    pub(crate) before: Option<Box<Statement>>,
    pub(crate) condition: Option<Expression>,
    pub(crate) after: Option<Expression>,
    pub(crate) body: Box<Statement>,
    /// Whether the body runs before the first test: do … while.
    pub(crate) begins_with_body: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct Expression {
    pub(crate) line: u32,
    pub(crate) kind: ExpressionKind,
}

#[derive(Debug, Clone)]
pub(crate) enum ExpressionKind {
    Constant(Value),
    Variable(String),
    /// `-`, `+` or `!`.
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    /// `=` has no operator; `+=` has `+`.
    Assign(Option<&'static str>, Box<Expression>, Box<Expression>),
    /// `++` adds 1, `--` subtracts it; the value before the change, or after it.
    Increment {
        by: f64,
        target: Box<Expression>,
        is_before: bool,
    },
    Conditional(Box<Expression>, Box<Expression>, Box<Expression>),
    Call(String, Vec<Expression>),
    /// Places of components, from `.xyz`, `.rgb` or `.stp`.
    Swizzle(Box<Expression>, Vec<usize>),
    Index(Box<Expression>, Box<Expression>),
    /// A member of a structure of GL's state, or of the structure of this number in an array.
    State {
        structure: String,
        number: Option<Box<Expression>>,
        member: String,
    },
}
