//! The variables of a run: those of all shaders, and the locals of the functions that run.

use crate::value::{Base, Type, Value};

/// Variables, by name.
pub(crate) struct Variables<'a> {
    /// Those of one shader, by its number, and those of all.
    globals: Vec<(Option<usize>, &'a str, Value)>,
    locals: Vec<(&'a str, Value)>,
    /// The first local of the function that runs.
    first_local: usize,
    /// The shader whose function runs.
    pub(crate) shader: usize,
}

/// A variable, or some of its numbers.
#[derive(Debug, Clone)]
pub(crate) struct Place {
    is_global: bool,
    number: usize,
    components: Option<Vec<usize>>,
}

/// Where a function was called.
pub(crate) struct Caller {
    first_local: usize,
    shader: usize,
    count: usize,
}

/// Returns the type of GL's own variables that a shader may write.
fn output_type(name: &str) -> Option<Type> {
    match name {
        "gl_FragDepth" | "gl_PointSize" | "gl_FogFragCoord" => Some(Type::FLOAT),
        "gl_Position"
        | "gl_ClipVertex"
        | "gl_FrontColor"
        | "gl_BackColor"
        | "gl_FrontSecondaryColor"
        | "gl_BackSecondaryColor"
        | "gl_FragColor" => Some(Type::vector(Base::Float, 4)),
        _ if name.starts_with("gl_TexCoord[") || name.starts_with("gl_FragData[") => Some(Type::vector(Base::Float, 4)),
        _ => None,
    }
}

impl<'a> Variables<'a> {
    /// Returns the variables that a run is given.
    pub(crate) fn given(inputs: &[(&'a str, Value)]) -> Self {
        let globals = inputs.iter().map(|(name, value)| (None, *name, *value)).collect();
        Self { globals, locals: Vec::new(), first_local: 0, shader: 0 }
    }

    /// Returns the global variables by name, as they are now.
    pub(crate) fn into_globals(self) -> Vec<(String, Value)> {
        self.globals.into_iter().map(|(_, name, value)| (name.to_owned(), value)).collect()
    }

    /// Returns the global variable of this name.
    pub(crate) fn global(&self, name: &str) -> Option<Value> {
        self.globals.iter().find(|(_, known, _)| *known == name).map(|(_, _, value)| *value)
    }

    /// Adds a global variable, of one shader or of all.
    pub(crate) fn add_global(&mut self, owner: Option<usize>, name: &'a str, value: Value) {
        self.globals.push((owner, name, value));
    }

    /// Adds a local variable.
    pub(crate) fn add(&mut self, name: &'a str, value: Value) {
        self.locals.push((name, value));
    }

    /// Returns a local of the running function, counted from its first parameter.
    pub(crate) fn local(&self, number: usize) -> Value {
        self.locals[self.first_local + number].1
    }

    /// How many locals there are.
    pub(crate) fn count(&self) -> usize {
        self.locals.len()
    }

    /// Forgets the locals from this one on.
    pub(crate) fn forget_from(&mut self, count: usize) {
        self.locals.truncate(count);
    }

    /// Begins a function of a shader, which sees no locals of its caller.
    pub(crate) fn enter(&mut self, shader: usize) -> Caller {
        let caller = Caller { first_local: self.first_local, shader: self.shader, count: self.locals.len() };
        (self.first_local, self.shader) = (self.locals.len(), shader);
        caller
    }

    /// Returns to the caller.
    pub(crate) fn leave(&mut self, Caller { first_local, shader, count }: Caller) {
        (self.first_local, self.shader) = (first_local, shader);
        self.locals.truncate(count);
    }

    /// Finds a variable that the running function sees. GL's own outputs exist once they are named.
    pub(crate) fn find(&mut self, name: &'a str) -> Option<Place> {
        let local = self.locals[self.first_local..].iter().rposition(|(known, _)| *known == name);
        if let Some(number) = local {
            return Some(Place { is_global: false, number: self.first_local + number, components: None });
        }
        let is_seen = |owner: Option<usize>| owner.is_none_or(|owner| owner == self.shader);
        let global = self.globals.iter().position(|(owner, known, _)| *known == name && is_seen(*owner));
        let number = match global {
            Some(number) => number,
            None => {
                self.globals.push((None, name, Value::new(output_type(name)?, &[])));
                self.globals.len() - 1
            }
        };
        Some(Place { is_global: true, number, components: None })
    }

    /// Returns some components of a place; `None` if it has not all of them.
    pub(crate) fn narrowed(&self, place: Place, places: &[usize]) -> Option<Place> {
        let within: Vec<usize> =
            place.components.clone().unwrap_or_else(|| (0..self.whole(&place).1.of.count()).collect());
        let components: Option<Vec<usize>> = places.iter().map(|number| within.get(*number).copied()).collect();
        Some(Place { components: Some(components?), ..place })
    }

    fn whole(&self, place: &Place) -> (&'a str, Value) {
        if place.is_global {
            let (_, name, value) = self.globals[place.number];
            (name, value)
        } else {
            self.locals[place.number]
        }
    }

    /// Returns the value at a place.
    pub(crate) fn value(&self, place: &Place) -> Value {
        let (_, value) = self.whole(place);
        match &place.components {
            None => value,
            Some(components) => {
                let numbers: Vec<f64> = components.iter().map(|number| value.numbers()[*number]).collect();
                Value::new(Type::vector(value.of.base, numbers.len() as u8), &numbers)
            }
        }
    }

    /// Sets a place to a value of its type, and returns the variable's name and its whole value.
    pub(crate) fn set(&mut self, place: &Place, value: Value) -> (&'a str, Value) {
        let (name, mut whole) = self.whole(place);
        match &place.components {
            None => whole = value,
            Some(components) => {
                for (number, given) in components.iter().zip(value.numbers()) {
                    whole.numbers_mut()[*number] = *given;
                }
            }
        }
        if place.is_global {
            self.globals[place.number].2 = whole;
        } else {
            self.locals[place.number].1 = whole;
        }
        (name, whole)
    }
}
