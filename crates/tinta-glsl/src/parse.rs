//! From lexemes to a [`Shader`]: recursive descent, as chapter 9 of the GLSL 1.20 specification orders it.

use crate::mistake::Mistake;
use crate::preprocess::{Lexeme, lexemes};
use crate::state;
use crate::syntax::{
    Expression, ExpressionKind, Function, Global, Loop, Parameter, Shader, Statement, StatementKind, Storage,
};
use crate::tokens::{Kind, is_whole};
use crate::value::{Type, Value};

/// Operators of two operands, those that bind least first.
const LEVELS: [&[&str]; 7] =
    [&["||"], &["^^"], &["&&"], &["==", "!="], &["<", ">", "<=", ">="], &["+", "-"], &["*", "/"]];

/// Assignments, with the operator that each carries out first.
const ASSIGNMENTS: [(&str, Option<&str>); 5] =
    [("=", None), ("+=", Some("+")), ("-=", Some("-")), ("*=", Some("*")), ("/=", Some("/"))];

/// The names of components, by place.
const COMPONENTS: [&str; 3] = ["xyzw", "rgba", "stpq"];

/// How deep brackets, blocks and operators may stand within each other.
const DEEPEST: u32 = 200;

type ParseResult<T> = Result<T, Mistake>;

/// Parses a shader; `path` names it in messages.
pub(crate) fn parse(path: &str, text: &str) -> ParseResult<Shader> {
    let mut parser = Parser { path, lexemes: lexemes(path, text)?, place: 0, depth: 0 };
    let mut shader = Shader { path: path.to_owned(), globals: Vec::new(), functions: Vec::new() };
    while parser.place < parser.lexemes.len() {
        parser.outer_declaration(&mut shader)?;
    }
    Ok(shader)
}

struct Parser<'a> {
    path: &'a str,
    lexemes: Vec<Lexeme>,
    place: usize,
    depth: u32,
}

impl Parser<'_> {
    fn text(&self) -> &str {
        self.lexemes.get(self.place).map_or("", |lexeme| lexeme.text.as_str())
    }

    fn line(&self) -> u32 {
        let place = self.place.min(self.lexemes.len().saturating_sub(1));
        self.lexemes.get(place).map_or(1, |lexeme| lexeme.line)
    }

    fn fail<T>(&self, problem: impl Into<String>) -> ParseResult<T> {
        Err(Mistake { path: self.path.to_owned(), line: self.line(), problem: problem.into() })
    }

    /// Takes the next lexeme if it is this one.
    fn takes(&mut self, text: &str) -> bool {
        let is_next = self.text() == text && self.place < self.lexemes.len();
        self.place += usize::from(is_next);
        is_next
    }

    fn expect(&mut self, text: &str) -> ParseResult<()> {
        if self.takes(text) {
            return Ok(());
        }
        match self.text() {
            "" => self.fail(format!("the shader ends where {text} is expected")),
            found => self.fail(format!("{text} is expected, not {found}")),
        }
    }

    fn name(&mut self) -> ParseResult<String> {
        match self.lexemes.get(self.place) {
            Some(Lexeme { kind: Kind::Word, text, .. }) => {
                self.place += 1;
                Ok(text.clone())
            }
            _ => self.fail(format!("a name is expected, not {}", self.text())),
        }
    }

    fn next_is_type(&self) -> bool {
        self.text() == "const" || Type::named(self.text()).is_some()
    }

    fn type_name(&mut self) -> ParseResult<Type> {
        let name = self.name()?;
        match Type::named(&name) {
            Some(of) => Ok(of),
            None => {
                self.place -= 1;
                self.fail(format!("{name} is no type that is understood"))
            }
        }
    }

    fn outer_declaration(&mut self, shader: &mut Shader) -> ParseResult<()> {
        while self.takes("invariant") || self.takes("centroid") {}
        let line = self.line();
        let storage = match self.text() {
            "uniform" => Storage::Uniform,
            "varying" | "attribute" => Storage::Passed,
            _ => Storage::Own,
        };
        if storage != Storage::Own || self.text() == "const" {
            self.place += 1;
        }
        let of = self.type_name()?;
        let mut name = self.name()?;
        if storage == Storage::Own && self.takes("(") {
            let parameters = self.parameters()?;
            let body = if self.takes(";") { None } else { Some(self.block()?) };
            shader.functions.push(Function { of, name, parameters, body });
            return Ok(());
        }
        loop {
            self.refuse_array()?;
            let value = if self.takes("=") { Some(self.expression()?) } else { None };
            shader.globals.push(Global { storage, of, name, value, line });
            if !self.takes(",") {
                return self.expect(";");
            }
            name = self.name()?;
        }
    }

    fn refuse_array(&self) -> ParseResult<()> {
        if self.text() == "[" { self.fail("arrays of a shader's own are not understood") } else { Ok(()) }
    }

    fn parameters(&mut self) -> ParseResult<Vec<Parameter>> {
        let mut parameters = Vec::new();
        if self.text() == "void" {
            self.place += 1;
        }
        while !self.takes(")") {
            self.takes("const");
            let is_out = match self.text() {
                "in" | "out" | "inout" => {
                    self.place += 1;
                    self.lexemes[self.place - 1].text != "in"
                }
                _ => false,
            };
            let of = self.type_name()?;
            let name = if self.text() == "," || self.text() == ")" { String::new() } else { self.name()? };
            self.refuse_array()?;
            parameters.push(Parameter { of, name, is_out });
            if self.text() != ")" {
                self.expect(",")?;
            }
        }
        Ok(parameters)
    }

    /// Runs a part of the parser one level deeper.
    fn deeper<T>(&mut self, part: impl FnOnce(&mut Self) -> ParseResult<T>) -> ParseResult<T> {
        if self.depth >= DEEPEST {
            return self.fail(format!("more than {DEEPEST} brackets, blocks and operators stand within each other"));
        }
        self.depth += 1;
        let parsed = part(self);
        self.depth -= 1;
        parsed
    }

    fn block(&mut self) -> ParseResult<Vec<Statement>> {
        self.expect("{")?;
        let mut statements = Vec::new();
        while !self.takes("}") {
            statements.push(self.deeper(Self::statement)?);
        }
        Ok(statements)
    }

    fn statement(&mut self) -> ParseResult<Statement> {
        let line = self.line();
        let word = self.text().to_owned();
        if word == "{" {
            return Ok(Statement { line, kind: StatementKind::Block(self.block()?) });
        }
        let simple = match word.as_str() {
            "" => return self.fail("the shader ends within a function"),
            "discard" => Some(StatementKind::Discard),
            "break" => Some(StatementKind::Break),
            "continue" => Some(StatementKind::Continue),
            ";" => return self.expect(";").map(|()| Statement { line, kind: StatementKind::Block(Vec::new()) }),
            _ => None,
        };
        if let Some(kind) = simple {
            self.place += 1;
            self.expect(";")?;
            return Ok(Statement { line, kind });
        }
        let keyword: fn(&mut Self) -> ParseResult<StatementKind> = match word.as_str() {
            "if" => Self::branch,
            "for" => Self::for_loop,
            "while" => Self::while_loop,
            "do" => Self::do_loop,
            "return" => Self::return_statement,
            _ => return self.simple_statement(),
        };
        self.place += 1;
        Ok(Statement { line, kind: keyword(self)? })
    }

    fn branch(&mut self) -> ParseResult<StatementKind> {
        let condition = self.in_brackets()?;
        let then = Box::new(self.deeper(Self::statement)?);
        let otherwise = if self.takes("else") { Some(Box::new(self.deeper(Self::statement)?)) } else { None };
        Ok(StatementKind::If(condition, then, otherwise))
    }

    fn for_loop(&mut self) -> ParseResult<StatementKind> {
        self.expect("(")?;
        let before = if self.takes(";") { None } else { Some(Box::new(self.simple_statement()?)) };
        let condition = if self.text() == ";" { None } else { Some(self.expression()?) };
        self.expect(";")?;
        let after = if self.text() == ")" { None } else { Some(self.expression()?) };
        self.expect(")")?;
        let body = Box::new(self.deeper(Self::statement)?);
        Ok(StatementKind::Loop(Loop { before, condition, after, body, begins_with_body: false }))
    }

    fn while_loop(&mut self) -> ParseResult<StatementKind> {
        let condition = Some(self.in_brackets()?);
        let body = Box::new(self.deeper(Self::statement)?);
        Ok(StatementKind::Loop(Loop { before: None, condition, after: None, body, begins_with_body: false }))
    }

    fn do_loop(&mut self) -> ParseResult<StatementKind> {
        let body = Box::new(self.deeper(Self::statement)?);
        self.expect("while")?;
        let condition = Some(self.in_brackets()?);
        self.expect(";")?;
        Ok(StatementKind::Loop(Loop { before: None, condition, after: None, body, begins_with_body: true }))
    }

    fn return_statement(&mut self) -> ParseResult<StatementKind> {
        let value = if self.text() == ";" { None } else { Some(self.expression()?) };
        self.expect(";")?;
        Ok(StatementKind::Return(value))
    }

    fn in_brackets(&mut self) -> ParseResult<Expression> {
        self.expect("(")?;
        let inside = self.expression()?;
        self.expect(")")?;
        Ok(inside)
    }

    /// A declaration or an expression, with its semicolon.
    fn simple_statement(&mut self) -> ParseResult<Statement> {
        let line = self.line();
        let is_constructor = self.lexemes.get(self.place + 1).is_some_and(|next| next.text == "(");
        if !self.next_is_type() || is_constructor {
            let kind = StatementKind::Expression(self.expression()?);
            return self.expect(";").map(|()| Statement { line, kind });
        }
        self.takes("const");
        let of = self.type_name()?;
        let mut variables = Vec::new();
        loop {
            let name = self.name()?;
            self.refuse_array()?;
            let value = if self.takes("=") { Some(self.expression()?) } else { None };
            variables.push((name, value));
            if !self.takes(",") {
                self.expect(";")?;
                return Ok(Statement { line, kind: StatementKind::Declare(of, variables) });
            }
        }
    }

    fn expression(&mut self) -> ParseResult<Expression> {
        let target = self.deeper(Self::conditional)?;
        let Some((_, operator)) = ASSIGNMENTS.iter().find(|(text, _)| *text == self.text()) else {
            return Ok(target);
        };
        let line = self.line();
        self.place += 1;
        let value = self.deeper(Self::expression)?;
        Ok(Expression { line, kind: ExpressionKind::Assign(*operator, Box::new(target), Box::new(value)) })
    }

    fn conditional(&mut self) -> ParseResult<Expression> {
        let condition = self.binary(0)?;
        if !self.takes("?") {
            return Ok(condition);
        }
        let line = condition.line;
        let first = self.expression()?;
        self.expect(":")?;
        let second = self.expression()?;
        let kind = ExpressionKind::Conditional(Box::new(condition), Box::new(first), Box::new(second));
        Ok(Expression { line, kind })
    }

    fn binary(&mut self, level: usize) -> ParseResult<Expression> {
        let Some(operators) = LEVELS.get(level) else {
            return self.deeper(Self::unary);
        };
        let mut left = self.binary(level + 1)?;
        while let Some(operator) = operators.iter().find(|operator| **operator == self.text()) {
            let line = self.line();
            self.place += 1;
            let right = self.binary(level + 1)?;
            left = Expression { line, kind: ExpressionKind::Binary(operator, Box::new(left), Box::new(right)) };
        }
        Ok(left)
    }

    fn unary(&mut self) -> ParseResult<Expression> {
        let line = self.line();
        for operator in ["-", "+", "!"] {
            if self.takes(operator) {
                let operand = Box::new(self.deeper(Self::unary)?);
                return Ok(Expression { line, kind: ExpressionKind::Unary(operator, operand) });
            }
        }
        for (operator, by) in [("++", 1.0), ("--", -1.0)] {
            if self.takes(operator) {
                let target = Box::new(self.deeper(Self::unary)?);
                return Ok(Expression { line, kind: ExpressionKind::Increment { by, target, is_before: false } });
            }
        }
        self.postfix()
    }

    fn postfix(&mut self) -> ParseResult<Expression> {
        let mut expression = self.primary()?;
        loop {
            let line = self.line();
            let kind = if self.takes(".") {
                let name = self.name()?;
                if let Some(state) = state_member(&expression, &name) {
                    expression = Expression { line, kind: state };
                    continue;
                }
                let set = COMPONENTS.iter().find(|set| name.chars().all(|letter| set.contains(letter)));
                let places: Vec<usize> =
                    set.map_or_else(Vec::new, |set| name.chars().filter_map(|letter| set.find(letter)).collect());
                if places.is_empty() || places.len() > 4 {
                    self.place -= 1;
                    return self.fail(format!(".{name} names no components"));
                }
                ExpressionKind::Swizzle(Box::new(expression), places)
            } else if self.takes("[") {
                let index = self.expression()?;
                self.expect("]")?;
                match (&expression.kind, &index.kind) {
                    // GL's own arrays are variables, one for each number.
                    (ExpressionKind::Variable(name), ExpressionKind::Constant(number))
                        if name == "gl_TexCoord" || name == "gl_FragData" =>
                    {
                        ExpressionKind::Variable(format!("{name}[{number}]"))
                    }
                    _ => ExpressionKind::Index(Box::new(expression), Box::new(index)),
                }
            } else if self.takes("++") {
                ExpressionKind::Increment { by: 1.0, target: Box::new(expression), is_before: true }
            } else if self.takes("--") {
                ExpressionKind::Increment { by: -1.0, target: Box::new(expression), is_before: true }
            } else {
                return Ok(expression);
            };
            expression = Expression { line, kind };
        }
    }

    fn primary(&mut self) -> ParseResult<Expression> {
        let Some(Lexeme { kind, text, line }) = self.lexemes.get(self.place).cloned() else {
            return self.fail("the shader ends within an expression");
        };
        if text == "(" {
            return self.in_brackets();
        }
        let kind = match (kind, text.as_str()) {
            (Kind::Number, _) => {
                let number = text.trim_end_matches(['f', 'F']).parse::<f64>().ok().filter(|number| number.is_finite());
                match number {
                    Some(number) if is_whole(&text) => ExpressionKind::Constant(Value::new(Type::INT, &[number])),
                    Some(number) => ExpressionKind::Constant(Value::floats(&[number])),
                    None => return self.fail(format!("{text} is no number")),
                }
            }
            (Kind::Word, "true" | "false") => ExpressionKind::Constant(Value::bool(text == "true")),
            (Kind::Word, _) => {
                self.place += 1;
                if !self.takes("(") {
                    return Ok(Expression { line, kind: ExpressionKind::Variable(text) });
                }
                let mut arguments = Vec::new();
                if self.text() == "void" {
                    self.place += 1;
                }
                while !self.takes(")") {
                    arguments.push(self.expression()?);
                    if self.text() != ")" {
                        self.expect(",")?;
                    }
                }
                return Ok(Expression { line, kind: ExpressionKind::Call(text, arguments) });
            }
            _ => return self.fail(format!("a value is expected, not {text}")),
        };
        self.place += 1;
        Ok(Expression { line, kind })
    }
}

/// The member of GL's state that a name after a dot means; `None` behind any other expression.
fn state_member(of: &Expression, member: &str) -> Option<ExpressionKind> {
    let (structure, number) = match &of.kind {
        ExpressionKind::Variable(name) => (name, None),
        ExpressionKind::Index(of, number) => match &of.kind {
            ExpressionKind::Variable(name) => (name, Some(number.clone())),
            _ => return None,
        },
        _ => return None,
    };
    (state::is_array_of_structures(structure)? == number.is_some()).then(|| ExpressionKind::State {
        structure: structure.clone(),
        number,
        member: member.to_owned(),
    })
}
