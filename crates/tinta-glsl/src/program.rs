//! The shaders of a stage together: their functions, by name and types.

use crate::syntax::{Function, Shader};
use crate::value::{Base, Type};

/// Shaders that call each other's functions.
#[derive(Debug, Clone)]
pub(crate) struct Program {
    pub(crate) shaders: Vec<Shader>,
}

impl Program {
    /// Returns a function's definition, and the number of its shader.
    pub(crate) fn function(&self, name: &str, arguments: &[Type]) -> Option<(usize, &Function)> {
        let fits = |function: &Function, converts: bool| {
            let has = |(of, given): (&Type, &Type)| {
                of == given
                    || (converts && of.base == Base::Float && given.base == Base::Int && of.count() == given.count())
            };
            function.name == name
                && function.body.is_some()
                && function.parameters.len() == arguments.len()
                && function.parameters.iter().map(|parameter| &parameter.of).zip(arguments).all(has)
        };
        let all =
            || self.shaders.iter().enumerate().flat_map(|(n, shader)| shader.functions.iter().map(move |f| (n, f)));
        all().find(|(_, function)| fits(function, false)).or_else(|| all().find(|(_, function)| fits(function, true)))
    }
}
