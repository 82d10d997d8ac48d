//! From a shader's text to its lexemes: comments dropped, macros replaced, operators of two signs joined, each with its line.

use crate::mistake::Mistake;
use crate::tokens::{Kind, Token, tokens};
use std::collections::HashMap;

/// A word, number or operator of a shader, macros replaced.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lexeme {
    pub(crate) kind: Kind,
    pub(crate) text: String,
    /// Counted from 1, in the text as written.
    pub(crate) line: u32,
}

/// `#define`: its parameters, if it has any brackets, and the text that it stands for.
struct Macro {
    parameters: Option<Vec<String>>,
    body: Vec<Lexeme>,
}

/// Operators of two signs.
pub(crate) const PAIRS: [&str; 14] =
    ["++", "--", "+=", "-=", "*=", "/=", "<=", ">=", "==", "!=", "&&", "||", "^^", "##"];

/// How deep macros may stand within each other.
const DEEPEST: u32 = 64;

/// Returns a shader's lexemes.
pub(crate) fn lexemes(path: &str, text: &str) -> Result<Vec<Lexeme>, Mistake> {
    let mistake = |line, problem: String| Mistake { path: path.to_owned(), line, problem };
    let (mut macros, mut expanded, mut plain, mut directive) = (HashMap::new(), Vec::new(), Vec::new(), Vec::new());
    let mut line = 1;
    let mut may_join = false;
    for token in tokens(text) {
        if token.is_directive {
            // A macro's brackets touch its name, so its spaces count.
            directive.push((token, line));
        } else if token.kind != Kind::Between {
            push_joined(&mut plain, token, line, may_join);
        }
        may_join = token.kind == Kind::Sign;
        if token.text == "\n" && !directive.is_empty() {
            // A macro is known from here on.
            expanded.extend(expand(&plain, &macros, 0).map_err(|problem| mistake(line, problem))?);
            plain.clear();
            read_directive(&std::mem::take(&mut directive), &mut macros).map_err(|problem| mistake(line, problem))?;
        }
        line += token.text.matches('\n').count() as u32;
    }
    expanded.extend(expand(&plain, &macros, 0).map_err(|problem| mistake(line, problem))?);
    Ok(expanded)
}

/// Adds a lexeme, or joins a sign with the one before it.
fn push_joined(lexemes: &mut Vec<Lexeme>, token: Token<'_>, line: u32, may_join: bool) {
    if token.kind == Kind::Sign
        && may_join
        && let Some(last) = lexemes.last_mut()
        && last.kind == Kind::Sign
        && PAIRS.contains(&format!("{}{}", last.text, token.text).as_str())
    {
        last.text.push_str(token.text);
        return;
    }
    lexemes.push(Lexeme { kind: token.kind, text: token.text.to_owned(), line });
}

/// Carries a directive out: `#define` and `#undef` change the macros, `#version` and `#extension` say nothing new.
fn read_directive(tokens: &[(Token<'_>, u32)], macros: &mut HashMap<String, Macro>) -> Result<(), String> {
    let solid = |place: &usize| tokens[*place].0.kind != Kind::Between;
    let mut places = (0..tokens.len()).filter(solid).skip(1);
    let Some(command) = places.next() else { return Ok(()) };
    let argument = places.next();
    match (tokens[command].0.text, argument) {
        ("version" | "extension" | "pragma", _) => Ok(()),
        ("undef", Some(name)) => {
            macros.remove(tokens[name].0.text);
            Ok(())
        }
        ("define", Some(name)) => {
            let mut body = name + 1;
            let parameters = (tokens.get(body).is_some_and(|(token, _)| token.text == "(")).then(|| {
                let inside = tokens[body..].iter().take_while(|(token, _)| token.text != ")");
                let count = inside.clone().count();
                let names = inside.filter(|(token, _)| token.kind == Kind::Word);
                let names = names.map(|(token, _)| token.text.to_owned()).collect();
                body += count + 1;
                names
            });
            let mut lexemes = Vec::new();
            let mut may_join = false;
            for (token, line) in tokens.get(body..).unwrap_or_default() {
                if token.kind != Kind::Between {
                    push_joined(&mut lexemes, *token, *line, may_join);
                }
                may_join = token.kind == Kind::Sign;
            }
            macros.insert(tokens[name].0.text.to_owned(), Macro { parameters, body: lexemes });
            Ok(())
        }
        (other, _) => Err(format!("#{other} is not understood; only #version, #extension, #define and #undef are")),
    }
}

/// Replaces macros, also those that others stand for. A replacement is on the line where the macro's name is.
fn expand(lexemes: &[Lexeme], macros: &HashMap<String, Macro>, depth: u32) -> Result<Vec<Lexeme>, String> {
    if depth > DEEPEST {
        return Err("a macro stands for itself".to_owned());
    }
    let mut expanded = Vec::with_capacity(lexemes.len());
    let mut place = 0;
    while let Some(lexeme) = lexemes.get(place) {
        place += 1;
        let Some(found) = macros.get(&lexeme.text) else {
            expanded.push(lexeme.clone());
            continue;
        };
        let mut arguments: Vec<Vec<Lexeme>> = Vec::new();
        if let Some(parameters) = &found.parameters {
            if lexemes.get(place).is_none_or(|next| next.text != "(") {
                expanded.push(lexeme.clone());
                continue;
            }
            let length = bracket_length(&lexemes[place..]).ok_or("a bracket of a macro is not closed")?;
            arguments = split_arguments(&lexemes[place + 1..place + length - 1]);
            place += length;
            if arguments.len() != parameters.len() {
                return Err(format!("{} takes {} arguments, not {}", lexeme.text, parameters.len(), arguments.len()));
            }
        }
        let parameters = found.parameters.as_deref().unwrap_or_default();
        let mut replacement = Vec::new();
        for part in &found.body {
            match parameters.iter().position(|name| *name == part.text) {
                Some(number) => replacement.extend(arguments[number].iter().cloned()),
                None => replacement.push(Lexeme { line: lexeme.line, ..part.clone() }),
            }
        }
        expanded.extend(expand(&replacement, macros, depth + 1)?);
    }
    Ok(expanded)
}

/// Returns how many lexemes there are from an opening bracket to its closing one.
fn bracket_length(lexemes: &[Lexeme]) -> Option<usize> {
    let mut open = 0;
    for (place, lexeme) in lexemes.iter().enumerate() {
        match lexeme.text.as_str() {
            "(" => open += 1,
            ")" => open -= 1,
            _ => {}
        }
        if open == 0 {
            return Some(place + 1);
        }
    }
    None
}

/// Splits at commas outside of brackets.
fn split_arguments(lexemes: &[Lexeme]) -> Vec<Vec<Lexeme>> {
    let (mut arguments, mut open) = (vec![Vec::new()], 0);
    for lexeme in lexemes {
        match lexeme.text.as_str() {
            "," if open == 0 => {
                arguments.push(Vec::new());
                continue;
            }
            "(" => open += 1,
            ")" => open -= 1,
            _ => {}
        }
        if let Some(last) = arguments.last_mut() {
            last.push(lexeme.clone());
        }
    }
    arguments
}
