//! Runs a stage for one vertex or pixel.

use crate::Mistake;
use crate::arithmetic::{Precision, binary, call, construct, promoted, unary};
use crate::parse::parse;
use crate::syntax::{Expression, ExpressionKind, Function, Loop, Shader, Statement, StatementKind, Storage};
use crate::value::{Base, Type, Value};
use serde::Serialize;

/// How many statements a run may carry out, so that a loop without end is refused.
const MOST_STATEMENTS: u32 = 200_000;

/// How many events a run records.
const MOST_EVENTS: usize = 10_000;

/// How deep functions may call each other; GLSL has no recursion.
const DEEPEST_CALL: u32 = 64;

/// The shaders of one stage: one of them has `main`, the others have functions that it declares.
#[derive(Debug, Clone)]
pub struct Stage {
    shaders: Vec<Shader>,
    asks_neighbours: bool,
}

/// How a run computes and what it records.
#[derive(Debug, Clone, Copy, Default)]
pub struct Settings<'a> {
    /// How floats are kept.
    pub precision: Precision,
    /// Whether to record events.
    pub is_traced: bool,
    /// For each value in [`Run::asked`], in order: its change to the pixel on the right and to the pixel above.
    pub changes: &'a [[Value; 2]],
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

impl Run {
    /// Returns an output; `None` if the run never named it.
    pub fn output(&self, name: &str) -> Option<Value> {
        self.outputs.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
    }
}

impl Stage {
    /// Parses the shaders of a stage, each given by its name and text.
    ///
    /// # Errors
    ///
    /// The first [`Mistake`]; also if no shader has a `main`.
    pub fn new(texts: &[(&str, &str)]) -> Result<Self, Mistake> {
        let shaders: Vec<Shader> = texts.iter().map(|(path, text)| parse(path, text)).collect::<Result<_, _>>()?;
        let asks_neighbours =
            texts.iter().any(|(_, text)| ["dFdx", "dFdy", "fwidth"].iter().any(|name| text.contains(name)));
        let stage = Self { shaders, asks_neighbours };
        if stage.function("main", &[]).is_none() {
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
        for global in self.shaders.iter().flat_map(|shader| &shader.globals) {
            if global.storage == Storage::Passed && !names.contains(&global.name.as_str()) {
                names.push(&global.name);
            }
        }
        names
    }

    /// Runs `main`. `inputs` gives uniforms, GL's own variables and, for pixels, varyings; samplers are [`Base::Sampler`] numbers
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
        let mut machine = Machine {
            stage: self,
            textures,
            settings,
            globals: inputs.iter().map(|(name, value)| (None, *name, *value)).collect(),
            locals: Vec::new(),
            first_local: 0,
            shader: 0,
            statements: 0,
            calls: 0,
            run: Run::default(),
        };
        match machine.start() {
            Ok(()) => {}
            Err(Stop::Discard) => machine.run.is_discarded = true,
            Err(Stop::Mistake(mistake)) => return Err(*mistake),
        }
        let Machine { globals, mut run, .. } = machine;
        run.outputs = globals.into_iter().map(|(_, name, value)| (name.to_owned(), value)).collect();
        Ok(run)
    }

    /// Returns a function's definition, and the number of its shader.
    fn function(&self, name: &str, arguments: &[Type]) -> Option<(usize, &Function)> {
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

/// Why a run ends early.
enum Stop {
    Discard,
    Mistake(Box<Mistake>),
}

/// What follows a statement.
enum Flow {
    Next,
    Break,
    Continue,
    Return(Option<Value>),
}

/// A variable, or some of its numbers.
struct Place {
    is_global: bool,
    number: usize,
    components: Option<Vec<usize>>,
}

type Stepped<T> = Result<T, Stop>;

/// A stage while it runs.
struct Machine<'a> {
    stage: &'a Stage,
    textures: &'a dyn Textures,
    settings: &'a Settings<'a>,
    /// Those of one shader, by its number, and those of all.
    globals: Vec<(Option<usize>, &'a str, Value)>,
    locals: Vec<(&'a str, Value)>,
    /// The first local of the function that runs.
    first_local: usize,
    /// The shader whose function runs.
    shader: usize,
    statements: u32,
    calls: u32,
    run: Run,
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

impl<'a> Machine<'a> {
    fn start(&mut self) -> Stepped<()> {
        let stage = self.stage;
        for (number, shader) in stage.shaders.iter().enumerate() {
            self.shader = number;
            for global in &shader.globals {
                let given = self.globals.iter().any(|(_, name, _)| *name == global.name);
                if given && global.storage != Storage::Own {
                    continue;
                }
                let mut value = Value::new(global.of, &[]);
                if let Some(expression) = &global.value {
                    value = self.evaluate(expression)?;
                    value = self.fitting(value, global.of, global.line)?;
                }
                let owner = (global.storage == Storage::Own).then_some(number);
                self.globals.push((owner, &global.name, value));
            }
        }
        let Some((number, main)) = stage.function("main", &[]) else { return Ok(()) };
        self.shader = number;
        self.run_body(main).map(drop)
    }

    fn fail<T>(&self, line: u32, problem: impl Into<String>) -> Stepped<T> {
        let path = self.stage.shaders[self.shader].path.clone();
        Err(Stop::Mistake(Box::new(Mistake { path, line, problem: problem.into() })))
    }

    fn computed(&self, line: u32, value: Result<Value, String>) -> Stepped<Value> {
        value.or_else(|problem| self.fail(line, problem))
    }

    fn record(&mut self, line: u32, what: impl FnOnce() -> What) {
        if self.settings.is_traced && self.run.events.len() < MOST_EVENTS {
            let shader = self.stage.shaders[self.shader].path.clone();
            self.run.events.push(Event { shader, line, what: what() });
        }
    }

    /// Returns a value as this type, an int as a float where needed.
    fn fitting(&self, value: Value, of: Type, line: u32) -> Stepped<Value> {
        let value = promoted(value, of);
        if value.of == of { Ok(value) } else { self.fail(line, format!("{of} cannot hold {}", value.of)) }
    }

    fn run_body(&mut self, function: &'a Function) -> Stepped<Option<Value>> {
        match self.block(function.body.as_deref().unwrap_or_default())? {
            Flow::Return(value) => Ok(value),
            _ => Ok(None),
        }
    }

    /// Runs statements; what they declare ends with them.
    fn block(&mut self, statements: &'a [Statement]) -> Stepped<Flow> {
        let count = self.locals.len();
        let mut flow = Flow::Next;
        for statement in statements {
            flow = self.statement(statement)?;
            if !matches!(flow, Flow::Next) {
                break;
            }
        }
        self.locals.truncate(count);
        Ok(flow)
    }

    fn statement(&mut self, statement: &'a Statement) -> Stepped<Flow> {
        let line = statement.line;
        self.statements += 1;
        if self.statements > MOST_STATEMENTS {
            return self.fail(line, format!("it still runs after {MOST_STATEMENTS} statements; end its loop"));
        }
        match &statement.kind {
            StatementKind::Declare(of, variables) => {
                for (name, value) in variables {
                    let value = match value {
                        Some(expression) => {
                            let value = self.evaluate(expression)?;
                            let value = self.fitting(value, *of, expression.line)?;
                            self.record(line, || What::Set { variable: name.clone(), value });
                            value
                        }
                        None => Value::new(*of, &[]),
                    };
                    self.locals.push((name, value));
                }
                Ok(Flow::Next)
            }
            StatementKind::Expression(expression) => self.evaluate(expression).map(|_| Flow::Next),
            StatementKind::Block(statements) => self.block(statements),
            StatementKind::If(condition, then, otherwise) => {
                let is_taken = self.condition(condition)?;
                self.record(line, || What::Branched { is_taken });
                let count = self.locals.len();
                let flow = match (is_taken, otherwise) {
                    (true, _) => self.statement(then),
                    (false, Some(otherwise)) => self.statement(otherwise),
                    (false, None) => Ok(Flow::Next),
                };
                self.locals.truncate(count);
                flow
            }
            StatementKind::Loop(parts) => {
                let count = self.locals.len();
                let flow = self.repeat(parts);
                self.locals.truncate(count);
                flow
            }
            StatementKind::Return(None) => Ok(Flow::Return(None)),
            StatementKind::Return(Some(value)) => self.evaluate(value).map(|value| Flow::Return(Some(value))),
            StatementKind::Discard => {
                self.record(line, || What::Discarded);
                Err(Stop::Discard)
            }
            StatementKind::Break => Ok(Flow::Break),
            StatementKind::Continue => Ok(Flow::Continue),
        }
    }

    fn repeat(&mut self, parts: &'a Loop) -> Stepped<Flow> {
        if let Some(before) = &parts.before {
            self.statement(before)?;
        }
        let mut is_first = parts.begins_with_body;
        loop {
            let may_go_on = match &parts.condition {
                Some(condition) if !is_first => self.condition(condition)?,
                _ => true,
            };
            is_first = false;
            if !may_go_on {
                return Ok(Flow::Next);
            }
            let count = self.locals.len();
            let flow = self.statement(&parts.body)?;
            self.locals.truncate(count);
            match flow {
                Flow::Break => return Ok(Flow::Next),
                Flow::Return(value) => return Ok(Flow::Return(value)),
                Flow::Next | Flow::Continue => {}
            }
            if let Some(after) = &parts.after {
                self.evaluate(after)?;
            }
        }
    }

    fn condition(&mut self, expression: &'a Expression) -> Stepped<bool> {
        let value = self.evaluate(expression)?;
        if value.of == Type::BOOL {
            Ok(value.is_true())
        } else {
            self.fail(expression.line, format!("a condition is a bool, not {}", value.of))
        }
    }

    fn evaluate(&mut self, expression: &'a Expression) -> Stepped<Value> {
        let line = expression.line;
        let precision = self.settings.precision;
        match &expression.kind {
            ExpressionKind::Constant(value) => Ok(precision.keep(*value)),
            ExpressionKind::Variable(_) => {
                let place = self.place(expression)?;
                Ok(self.value_at(&place))
            }
            ExpressionKind::Unary(operator, operand) => {
                let operand = self.evaluate(operand)?;
                self.computed(line, unary(operator, operand))
            }
            ExpressionKind::Binary(operator @ ("&&" | "||" | "^^"), left, right) => {
                let left = self.condition(left)?;
                match *operator {
                    "&&" if !left => Ok(Value::bool(false)),
                    "||" if left => Ok(Value::bool(true)),
                    "^^" => Ok(Value::bool(left != self.condition(right)?)),
                    _ => self.condition(right).map(Value::bool),
                }
            }
            ExpressionKind::Binary(operator, left, right) => {
                let (left, right) = (self.evaluate(left)?, self.evaluate(right)?);
                self.computed(line, binary(operator, left, right, precision))
            }
            ExpressionKind::Assign(operator, target, value) => {
                let mut value = self.evaluate(value)?;
                let place = self.place(target)?;
                if let Some(operator) = operator {
                    let before = self.value_at(&place);
                    value = self.computed(line, binary(operator, before, value, precision))?;
                }
                self.set(&place, value, line)?;
                Ok(value)
            }
            ExpressionKind::Increment { by, target, is_before } => {
                let place = self.place(target)?;
                let before = self.value_at(&place);
                let after = precision.keep(before.map(|number| number + by));
                self.set(&place, after, line)?;
                Ok(if *is_before { before } else { after })
            }
            ExpressionKind::Conditional(condition, first, second) => {
                let is_taken = self.condition(condition)?;
                self.record(line, || What::Branched { is_taken });
                self.evaluate(if is_taken { first } else { second })
            }
            ExpressionKind::Swizzle(of, places) => {
                let of = self.evaluate(of)?;
                self.part(&of, places, line)
            }
            ExpressionKind::Index(of, index) => {
                let of = self.evaluate(of)?;
                let index = self.evaluate(index)?;
                let places = self.indexed(of.of, index, line)?;
                self.part(&of, &places, line)
            }
            ExpressionKind::Call(name, arguments) => self.call(name, arguments, line),
        }
    }

    /// Returns some components of a value, as a vector.
    fn part(&self, of: &Value, places: &[usize], line: u32) -> Stepped<Value> {
        let numbers: Option<Vec<f64>> = places.iter().map(|place| of.numbers().get(*place).copied()).collect();
        match numbers {
            Some(numbers) => Ok(Value::new(Type::vector(of.of.base, numbers.len() as u8), &numbers)),
            None => self.fail(line, format!("{} has no such component", of.of)),
        }
    }

    /// Returns the places of a vector's component or a matrix's column.
    fn indexed(&self, of: Type, index: Value, line: u32) -> Stepped<Vec<usize>> {
        let length = if of.is_matrix() { usize::from(of.rows) } else { 1 };
        let first = index.first() * length as f64;
        if index.of != Type::INT || of.is_scalar() || first < 0.0 || first as usize >= of.count() {
            return self.fail(line, format!("{of} has no element {index}"));
        }
        Ok((first as usize..first as usize + length).collect())
    }

    /// Finds the variable that an expression names.
    fn place(&mut self, expression: &'a Expression) -> Stepped<Place> {
        let line = expression.line;
        match &expression.kind {
            ExpressionKind::Variable(name) => {
                let local = self.locals[self.first_local..].iter().rposition(|(known, _)| known == name);
                if let Some(number) = local {
                    return Ok(Place { is_global: false, number: self.first_local + number, components: None });
                }
                let is_seen = |owner: Option<usize>| owner.is_none_or(|owner| owner == self.shader);
                let global = self.globals.iter().position(|(owner, known, _)| known == name && is_seen(*owner));
                let number = match (global, output_type(name)) {
                    (Some(number), _) => number,
                    (None, Some(of)) => {
                        self.globals.push((None, name, Value::new(of, &[])));
                        self.globals.len() - 1
                    }
                    (None, None) => return self.fail(line, format!("there is no variable {name}")),
                };
                Ok(Place { is_global: true, number, components: None })
            }
            ExpressionKind::Swizzle(of, places) => {
                let place = self.place(of)?;
                self.narrowed(place, places, line)
            }
            ExpressionKind::Index(of, index) => {
                let place = self.place(of)?;
                let index = self.evaluate(index)?;
                let places = self.indexed(self.value_at(&place).of, index, line)?;
                self.narrowed(place, &places, line)
            }
            _ => self.fail(line, "only a variable can be set"),
        }
    }

    /// Returns some components of a place.
    fn narrowed(&self, place: Place, places: &[usize], line: u32) -> Stepped<Place> {
        let within: Vec<usize> =
            place.components.clone().unwrap_or_else(|| (0..self.value_at(&place).of.count()).collect());
        let components: Option<Vec<usize>> = places.iter().map(|number| within.get(*number).copied()).collect();
        match components {
            Some(components) => Ok(Place { components: Some(components), ..place }),
            None => self.fail(line, format!("{} has no such component", self.value_at(&place).of)),
        }
    }

    fn whole(&self, place: &Place) -> (&'a str, Value) {
        if place.is_global {
            let (_, name, value) = self.globals[place.number];
            (name, value)
        } else {
            self.locals[place.number]
        }
    }

    fn value_at(&self, place: &Place) -> Value {
        let (_, value) = self.whole(place);
        match &place.components {
            None => value,
            Some(components) => {
                let numbers: Vec<f64> = components.iter().map(|number| value.numbers()[*number]).collect();
                Value::new(Type::vector(value.of.base, numbers.len() as u8), &numbers)
            }
        }
    }

    fn set(&mut self, place: &Place, value: Value, line: u32) -> Stepped<()> {
        let value = self.fitting(value, self.value_at(place).of, line)?;
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
        self.record(line, || What::Set { variable: name.to_owned(), value: whole });
        Ok(())
    }

    fn call(&mut self, name: &'a str, arguments: &'a [Expression], line: u32) -> Stepped<Value> {
        let values: Vec<Value> = arguments.iter().map(|argument| self.evaluate(argument)).collect::<Stepped<_>>()?;
        let precision = self.settings.precision;
        if let Some(of) = Type::named(name) {
            return self.computed(line, construct(of, &values));
        }
        let types: Vec<Type> = values.iter().map(|value| value.of).collect();
        if let Some((shader, function)) = self.stage.function(name, &types) {
            return self.call_own(shader, function, arguments, values, line);
        }
        match (name, values.as_slice()) {
            ("ftransform", []) => {
                let given = |wanted: &str| self.globals.iter().find(|(_, name, _)| *name == wanted);
                match (given("gl_ModelViewProjectionMatrix"), given("gl_Vertex")) {
                    (Some((_, _, matrix)), Some((_, _, vertex))) => {
                        self.computed(line, binary("*", *matrix, *vertex, precision))
                    }
                    _ => self.fail(line, "only a vertex shader has ftransform()"),
                }
            }
            ("dFdx" | "dFdy" | "fwidth", [value]) => {
                let [right, up] = self.changes(*value);
                Ok(match name {
                    "dFdx" => right,
                    "dFdy" => up,
                    _ => {
                        let sum = right.numbers().iter().zip(up.numbers()).map(|(x, y)| x.abs() + y.abs());
                        precision.keep(Value::new(value.of, &sum.collect::<Vec<f64>>()))
                    }
                })
            }
            ("texture1D" | "texture2D", [sampler, at, ..]) if sampler.of.base == Base::Sampler => {
                let pair = [at.first(), at.numbers().get(1).copied().unwrap_or(0.5)];
                let Some(mut sample) = self.textures.read(sampler.first() as usize, pair) else {
                    return self.fail(line, format!("{name} reads a texture that is not given"));
                };
                let value = precision.keep(Value::floats(&sample.value));
                sample.value.copy_from_slice(value.numbers());
                let texture = match arguments.first().map(|argument| &argument.kind) {
                    Some(ExpressionKind::Variable(name)) => name.clone(),
                    _ => String::new(),
                };
                let at = *at;
                self.record(line, || What::Read { texture, at, sample });
                Ok(value)
            }
            _ => match call(name, &values, precision) {
                Some(value) => self.computed(line, value),
                None => self.fail(line, format!("there is no function {name} for these arguments")),
            },
        }
    }

    /// Notes a value that neighbouring pixels are asked for, and returns its changes.
    fn changes(&mut self, value: Value) -> [Value; 2] {
        let number = self.run.asked.len();
        self.run.asked.push(value);
        self.settings.changes.get(number).copied().unwrap_or_else(|| [value.map(|_| 0.0); 2])
    }

    fn call_own(
        &mut self,
        shader: usize,
        function: &'a Function,
        arguments: &'a [Expression],
        values: Vec<Value>,
        line: u32,
    ) -> Stepped<Value> {
        if self.calls >= DEEPEST_CALL {
            return self.fail(line, format!("{} calls itself", function.name));
        }
        // Found before the call, because they are the caller's.
        let mut outs = Vec::new();
        for (number, parameter) in function.parameters.iter().enumerate() {
            if parameter.is_out {
                outs.push((number, self.place(&arguments[number])?));
            }
        }
        let caller = (self.first_local, self.shader, self.locals.len());
        (self.first_local, self.shader) = (self.locals.len(), shader);
        for (parameter, value) in function.parameters.iter().zip(values) {
            self.locals.push((&parameter.name, promoted(value, parameter.of)));
        }
        self.calls += 1;
        let result = self.run_body(function)?;
        self.calls -= 1;
        let first = self.first_local;
        let set: Vec<Value> = outs.iter().map(|(number, _)| self.locals[first + number].1).collect();
        let value = match result {
            Some(value) => self.fitting(value, function.of, line)?,
            None => Value::new(function.of, &[]),
        };
        let length;
        (self.first_local, self.shader, length) = caller;
        self.locals.truncate(length);
        for ((_, place), value) in outs.iter().zip(set) {
            self.set(place, value, line)?;
        }
        self.record(line, || What::Returned { function: function.name.clone(), value });
        Ok(value)
    }
}
