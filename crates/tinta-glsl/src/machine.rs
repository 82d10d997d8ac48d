//! Runs a program for one vertex or pixel: its statements and expressions.

use crate::arithmetic::{binary, call, construct, promoted, unary};
use crate::mistake::Mistake;
use crate::program::Program;
use crate::state;
use crate::syntax::{Expression, ExpressionKind, Function, Loop, Statement, StatementKind, Storage};
use crate::trace::{Comparison, Event, Run, Settings, Textures, Trace, What};
use crate::value::{Base, Type, Value};
use crate::variables::{Place, Variables};

/// How many statements a run may carry out, so that a loop without end is refused.
const MOST_STATEMENTS: u32 = 200_000;

/// How many events a run records.
const MOST_EVENTS: usize = 10_000;

/// How deep functions may call each other; GLSL has no recursion.
const DEEPEST_CALL: u32 = 64;

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

type StepResult<T> = Result<T, Stop>;

/// A stage while it runs.
struct Machine<'a> {
    program: &'a Program,
    textures: &'a dyn Textures,
    settings: &'a Settings<'a>,
    variables: Variables<'a>,
    statements: u32,
    calls: u32,
    /// The operator of two numbers that was evaluated last.
    compared: Option<Comparison>,
    run: Run,
}

/// Runs `main`: see [`crate::Stage::run`].
pub(crate) fn run(
    program: &Program,
    inputs: &[(&str, Value)],
    textures: &dyn Textures,
    settings: &Settings<'_>,
) -> Result<Run, Mistake> {
    let variables = Variables::given(inputs);
    let mut machine = Machine {
        program,
        textures,
        settings,
        variables,
        statements: 0,
        calls: 0,
        compared: None,
        run: Run::default(),
    };
    match machine.start() {
        Ok(()) => {}
        Err(Stop::Discard) => machine.run.is_discarded = true,
        Err(Stop::Mistake(mistake)) => return Err(*mistake),
    }
    let Machine { variables, mut run, .. } = machine;
    run.outputs = variables.into_globals();
    Ok(run)
}

impl<'a> Machine<'a> {
    fn start(&mut self) -> StepResult<()> {
        let program = self.program;
        for (number, shader) in program.shaders.iter().enumerate() {
            self.variables.shader = number;
            for global in &shader.globals {
                let given = self.variables.global(&global.name).is_some();
                if given && global.storage != Storage::Own {
                    continue;
                }
                let mut value = Value::new(global.of, &[]);
                if let Some(expression) = &global.value {
                    value = self.evaluate(expression)?;
                    value = self.fitting(value, global.of, global.line)?;
                }
                let owner = (global.storage == Storage::Own).then_some(number);
                self.variables.add_global(owner, &global.name, value);
            }
        }
        let Some((number, main)) = program.function("main", &[]) else { return Ok(()) };
        self.variables.shader = number;
        self.run_body(main).map(drop)
    }

    fn fail<T>(&self, line: u32, problem: impl Into<String>) -> StepResult<T> {
        let path = self.program.shaders[self.variables.shader].path.clone();
        Err(Stop::Mistake(Box::new(Mistake { path, line, problem: problem.into() })))
    }

    fn computed(&self, line: u32, value: Result<Value, String>) -> StepResult<Value> {
        value.or_else(|problem| self.fail(line, problem))
    }

    fn record(&mut self, line: u32, what: impl FnOnce() -> What) {
        if self.settings.trace == Trace::Everything {
            self.push(line, what());
        }
    }

    fn record_set(&mut self, line: u32, name: &str, value: Value) {
        self.record(line, || What::Set { variable: name.to_owned(), value });
    }

    fn record_branch(&mut self, condition: &Expression, line: u32, is_taken: bool) {
        let is_comparison = matches!(condition.kind, ExpressionKind::Binary("<" | ">" | "<=" | ">=", ..));
        let compared = self.compared.take().filter(|_| is_comparison);
        self.record(line, || What::Branched { is_taken, compared });
    }

    fn push(&mut self, line: u32, what: What) {
        if self.run.events.len() < MOST_EVENTS {
            let shader = self.program.shaders[self.variables.shader].path.clone();
            self.run.events.push(Event { shader, line, what });
        }
    }

    /// Returns a value as this type, an int as a float where needed.
    fn fitting(&self, value: Value, of: Type, line: u32) -> StepResult<Value> {
        let value = promoted(value, of);
        if value.of == of { Ok(value) } else { self.fail(line, format!("{of} cannot hold {}", value.of)) }
    }

    fn run_body(&mut self, function: &'a Function) -> StepResult<Option<Value>> {
        match self.block(function.body.as_deref().unwrap_or_default())? {
            Flow::Return(value) => Ok(value),
            _ => Ok(None),
        }
    }

    /// Runs statements; what they declare ends with them.
    fn block(&mut self, statements: &'a [Statement]) -> StepResult<Flow> {
        let count = self.variables.count();
        let mut flow = Flow::Next;
        for statement in statements {
            flow = self.statement(statement)?;
            if !matches!(flow, Flow::Next) {
                break;
            }
        }
        self.variables.forget_from(count);
        Ok(flow)
    }

    fn statement(&mut self, statement: &'a Statement) -> StepResult<Flow> {
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
                            self.record_set(line, name, value);
                            value
                        }
                        None => Value::new(*of, &[]),
                    };
                    self.variables.add(name, value);
                }
                Ok(Flow::Next)
            }
            StatementKind::Expression(expression) => self.evaluate(expression).map(|_| Flow::Next),
            StatementKind::Block(statements) => self.block(statements),
            StatementKind::If(condition, then, otherwise) => {
                let is_taken = self.condition(condition)?;
                self.record_branch(condition, line, is_taken);
                let count = self.variables.count();
                let flow = match (is_taken, otherwise) {
                    (true, _) => self.statement(then),
                    (false, Some(otherwise)) => self.statement(otherwise),
                    (false, None) => Ok(Flow::Next),
                };
                self.variables.forget_from(count);
                flow
            }
            StatementKind::Loop(parts) => {
                let count = self.variables.count();
                let flow = self.repeat(parts);
                self.variables.forget_from(count);
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

    fn repeat(&mut self, parts: &'a Loop) -> StepResult<Flow> {
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
            let count = self.variables.count();
            let flow = self.statement(&parts.body)?;
            self.variables.forget_from(count);
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

    fn condition(&mut self, expression: &'a Expression) -> StepResult<bool> {
        let value = self.evaluate(expression)?;
        if value.of == Type::BOOL {
            Ok(value.is_true())
        } else {
            self.fail(expression.line, format!("a condition is a bool, not {}", value.of))
        }
    }

    fn evaluate(&mut self, expression: &'a Expression) -> StepResult<Value> {
        let line = expression.line;
        let precision = self.settings.precision;
        match &expression.kind {
            ExpressionKind::Constant(value) => Ok(precision.keep(*value)),
            ExpressionKind::Variable(_) => {
                let place = self.place(expression)?;
                Ok(self.variables.value(&place))
            }
            ExpressionKind::Unary(operator, operand) => {
                let operand = self.evaluate(operand)?;
                self.computed(line, unary(operator, operand))
            }
            ExpressionKind::Binary(operator @ ("&&" | "||" | "^^"), left, right) => self.logical(operator, left, right),
            ExpressionKind::Binary(operator, left, right) => {
                let (left, right) = (self.evaluate(left)?, self.evaluate(right)?);
                self.compared = Some(Comparison { left: left.first(), operator, right: right.first() });
                self.computed(line, binary(operator, left, right, precision))
            }
            ExpressionKind::Assign(operator, target, value) => self.assign(*operator, target, value, line),
            ExpressionKind::Increment { by, target, is_before } => {
                let place = self.place(target)?;
                let before = self.variables.value(&place);
                let after = precision.keep(before.map(|number| number + by));
                self.set(&place, after, line)?;
                Ok(if *is_before { before } else { after })
            }
            ExpressionKind::Conditional(condition, first, second) => {
                let is_taken = self.condition(condition)?;
                self.record_branch(condition, line, is_taken);
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
            ExpressionKind::State { structure, number, member } => {
                let number = number.as_ref().map(|number| self.evaluate(number)).transpose()?;
                let value = state::member(structure, number.map(|number| number.first()), member);
                value.map_or_else(
                    || self.fail(line, format!("{structure} has no .{member} that all drivers agree on")),
                    |it| Ok(precision.keep(it)),
                )
            }
            ExpressionKind::Call(name, arguments) => self.call(name, arguments, line),
        }
    }

    /// An operator of bools, which may skip its second operand.
    fn logical(&mut self, operator: &str, left: &'a Expression, right: &'a Expression) -> StepResult<Value> {
        let left = self.condition(left)?;
        match operator {
            "&&" if !left => Ok(Value::bool(false)),
            "||" if left => Ok(Value::bool(true)),
            "^^" => Ok(Value::bool(left != self.condition(right)?)),
            _ => self.condition(right).map(Value::bool),
        }
    }

    /// `target = value`, or `target += value` and the like.
    fn assign(
        &mut self,
        operator: Option<&'static str>,
        target: &'a Expression,
        value: &'a Expression,
        line: u32,
    ) -> StepResult<Value> {
        let mut value = self.evaluate(value)?;
        let place = self.place(target)?;
        if let Some(operator) = operator {
            let before = self.variables.value(&place);
            value = self.computed(line, binary(operator, before, value, self.settings.precision))?;
        }
        self.set(&place, value, line)?;
        Ok(value)
    }

    /// Returns some components of a value, as a vector.
    fn part(&self, of: &Value, places: &[usize], line: u32) -> StepResult<Value> {
        let numbers: Option<Vec<f64>> = places.iter().map(|place| of.numbers().get(*place).copied()).collect();
        match numbers {
            Some(numbers) => Ok(Value::new(Type::vector(of.of.base, numbers.len() as u8), &numbers)),
            None => self.fail(line, format!("{} has no such component", of.of)),
        }
    }

    /// Returns the places of a vector's component or a matrix's column.
    fn indexed(&self, of: Type, index: Value, line: u32) -> StepResult<Vec<usize>> {
        let length = if of.is_matrix() { usize::from(of.rows) } else { 1 };
        let first = index.first() * length as f64;
        if index.of != Type::INT || of.is_scalar() || first < 0.0 || first as usize >= of.count() {
            return self.fail(line, format!("{of} has no element {index}"));
        }
        Ok((first as usize..first as usize + length).collect())
    }

    /// Finds the variable that an expression names.
    fn place(&mut self, expression: &'a Expression) -> StepResult<Place> {
        let line = expression.line;
        match &expression.kind {
            ExpressionKind::Variable(name) => {
                self.variables.find(name).map_or_else(|| self.fail(line, format!("there is no variable {name}")), Ok)
            }
            ExpressionKind::Swizzle(of, places) => {
                let place = self.place(of)?;
                self.narrowed(place, places, line)
            }
            ExpressionKind::Index(of, index) => {
                let place = self.place(of)?;
                let index = self.evaluate(index)?;
                let places = self.indexed(self.variables.value(&place).of, index, line)?;
                self.narrowed(place, &places, line)
            }
            _ => self.fail(line, "only a variable can be set"),
        }
    }

    /// Returns some components of a place.
    fn narrowed(&self, place: Place, places: &[usize], line: u32) -> StepResult<Place> {
        let of = self.variables.value(&place).of;
        let narrowed = self.variables.narrowed(place, places);
        narrowed.map_or_else(|| self.fail(line, format!("{of} has no such component")), Ok)
    }

    fn set(&mut self, place: &Place, value: Value, line: u32) -> StepResult<()> {
        let value = self.fitting(value, self.variables.value(place).of, line)?;
        let (name, whole) = self.variables.set(place, value);
        self.record_set(line, name, whole);
        Ok(())
    }

    fn call(&mut self, name: &'a str, arguments: &'a [Expression], line: u32) -> StepResult<Value> {
        let values: Vec<Value> = arguments.iter().map(|argument| self.evaluate(argument)).collect::<StepResult<_>>()?;
        let precision = self.settings.precision;
        if let Some(of) = Type::named(name) {
            return self.computed(line, construct(of, &values));
        }
        let types: Vec<Type> = values.iter().map(|value| value.of).collect();
        if let Some((shader, function)) = self.program.function(name, &types) {
            return self.call_own(shader, function, arguments, values, line);
        }
        match (name, values.as_slice()) {
            ("ftransform", []) => {
                let given = |name: &str| self.variables.global(name);
                match (given("gl_ModelViewProjectionMatrix"), given("gl_Vertex")) {
                    (Some(matrix), Some(vertex)) => self.computed(line, binary("*", matrix, vertex, precision)),
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
    ) -> StepResult<Value> {
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
        let caller = self.variables.enter(shader);
        for (parameter, value) in function.parameters.iter().zip(values) {
            self.variables.add(&parameter.name, promoted(value, parameter.of));
        }
        self.calls += 1;
        let result = self.run_body(function)?;
        self.calls -= 1;
        let set: Vec<Value> = outs.iter().map(|(number, _)| self.variables.local(*number)).collect();
        let value = match result {
            Some(value) => self.fitting(value, function.of, line)?,
            None => Value::new(function.of, &[]),
        };
        self.variables.leave(caller);
        for ((_, place), value) in outs.iter().zip(set) {
            self.set(place, value, line)?;
        }
        self.record(line, || What::Returned { function: function.name.clone(), value });
        Ok(value)
    }
}
