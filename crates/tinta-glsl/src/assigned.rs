//! The variables that a program's statements set.

use crate::program::Program;
use crate::syntax::{Expression, ExpressionKind, Statement, StatementKind};

/// Returns their names, each once, in the order of the text.
pub(crate) fn assigned(program: &Program) -> Vec<&str> {
    let mut names = Vec::new();
    let bodies = program.shaders.iter().flat_map(|shader| &shader.functions).filter_map(|f| f.body.as_ref());
    bodies.flatten().for_each(|statement| of_statement(statement, &mut names));
    let mut once: Vec<&str> = Vec::new();
    names.into_iter().for_each(|name| {
        if !once.contains(&name) {
            once.push(name)
        }
    });
    once
}

fn of_statement<'a>(statement: &'a Statement, names: &mut Vec<&'a str>) {
    match &statement.kind {
        StatementKind::Declare(_, variables) => {
            for (name, value) in variables {
                if let Some(value) = value {
                    names.push(name);
                    of_expression(value, names);
                }
            }
        }
        StatementKind::Expression(expression) | StatementKind::Return(Some(expression)) => {
            of_expression(expression, names);
        }
        StatementKind::Block(statements) => {
            statements.iter().for_each(|statement| of_statement(statement, names));
        }
        StatementKind::If(condition, then, otherwise) => {
            of_expression(condition, names);
            [Some(then), otherwise.as_ref()].into_iter().flatten().for_each(|branch| of_statement(branch, names));
        }
        StatementKind::Loop(parts) => {
            parts.before.iter().for_each(|before| of_statement(before, names));
            parts.condition.iter().chain(&parts.after).for_each(|expression| of_expression(expression, names));
            of_statement(&parts.body, names);
        }
        StatementKind::Return(None) | StatementKind::Discard | StatementKind::Break | StatementKind::Continue => {}
    }
}

/// Assignments within an expression.
fn of_expression<'a>(expression: &'a Expression, names: &mut Vec<&'a str>) {
    match &expression.kind {
        ExpressionKind::Assign(_, target, value) => {
            names.extend(root(target));
            of_expression(value, names);
        }
        ExpressionKind::Increment { target, .. } => names.extend(root(target)),
        ExpressionKind::Binary(_, left, right) => {
            [left, right].into_iter().for_each(|side| of_expression(side, names));
        }
        ExpressionKind::Conditional(condition, first, second) => {
            [condition, first, second].into_iter().for_each(|part| of_expression(part, names));
        }
        ExpressionKind::Call(_, arguments) => arguments.iter().for_each(|argument| of_expression(argument, names)),
        ExpressionKind::Unary(_, of) | ExpressionKind::Swizzle(of, _) | ExpressionKind::Index(of, _) => {
            of_expression(of, names);
        }
        ExpressionKind::State { number, .. } => number.iter().for_each(|number| of_expression(number, names)),
        ExpressionKind::Constant(_) | ExpressionKind::Variable(_) => {}
    }
}

/// The variable whose part an expression names.
fn root(expression: &Expression) -> Option<&str> {
    match &expression.kind {
        ExpressionKind::Variable(name) => Some(name),
        ExpressionKind::Swizzle(of, _) | ExpressionKind::Index(of, _) => root(of),
        _ => None,
    }
}
