//! A step's shader as text, each line with its effect at the pixel.

use super::{Event, Explanation, What};

/// A line of a shader at one pixel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedLine {
    /// Its number in the shader, from 1.
    pub number: u32,
    /// Its text.
    pub text: String,
    /// The values that it set, read or compared, in words; empty without any.
    pub values: Vec<String>,
    /// Whether it ran.
    pub state: LineState,
}

/// Whether a line ran at a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineState {
    /// It did.
    Ran,
    /// Its condition was false.
    NotTaken,
    /// It is a statement that did not run: within a branch not taken, or after the pixel was discarded.
    Skipped,
    /// It is no statement.
    Other,
}

impl Explanation {
    /// Returns the lines of each fragment shader of a step, from the first that ran to the last, with the shader's path; none if no
    /// triangle decides on the pixel.
    pub fn listing(&self, step: usize) -> Vec<(String, Vec<ListedLine>)> {
        let Some(fragment) = self.steps.get(step).and_then(|step| step.decisive()) else { return Vec::new() };
        let mut paths: Vec<&str> = Vec::new();
        for event in &fragment.events {
            if !paths.contains(&event.shader.as_str()) {
                paths.push(&event.shader);
            }
        }
        let of_shader = |path: &str| {
            let events: Vec<&Event> = fragment.events.iter().filter(|event| event.shader == path).collect();
            let first = events.iter().map(|event| event.line).min().unwrap_or(1);
            let end = self.last_statement(path).max(first);
            let lines = (1..).zip(self.text(path).lines());
            let within = lines.skip_while(|(number, _)| *number < first).take_while(|(number, _)| *number <= end);
            within.map(|(number, text)| self.listed(number, text, &events)).collect()
        };
        paths.iter().map(|path| ((*path).to_owned(), of_shader(path))).collect()
    }

    /// The last line of a shader that is a statement.
    fn last_statement(&self, path: &str) -> u32 {
        (1..)
            .zip(self.text(path).lines())
            .filter(|(_, text)| is_statement(text))
            .map(|(number, _)| number)
            .last()
            .unwrap_or(1)
    }

    fn listed(&self, number: u32, text: &str, events: &[&Event]) -> ListedLine {
        let here = || events.iter().filter(|event| event.line == number);
        let is_false = here().any(|event| matches!(event.what, What::Branched { is_taken: false, .. }));
        let is_true = here().any(|event| matches!(event.what, What::Branched { is_taken: true, .. }));
        // What a function returns is told where it is called, and texels by the variable they set.
        let is_told = |event: &&&&Event| match event.what {
            What::Returned { .. } => false,
            What::Read { .. } => !here().any(|other| matches!(other.what, What::Set { .. })),
            _ => true,
        };
        let state = match here().next() {
            Some(_) if is_false && !is_true => LineState::NotTaken,
            Some(_) => LineState::Ran,
            None if is_statement(text) => LineState::Skipped,
            None => LineState::Other,
        };
        let values = here().filter(|event| is_told(&event)).map(|event| self.in_words(event)).collect();
        ListedLine { number, text: text.trim_end().to_owned(), values, state }
    }
}

/// Whether a line of text holds a statement, rather than a comment, a declaration outside of functions, a brace or nothing.
fn is_statement(text: &str) -> bool {
    let text = text.trim();
    // What a return gives is told where the function is called.
    let is_none = ["//", "/*", "*", "#", "uniform ", "varying ", "const ", "attribute ", "return "];
    text.contains(';') && !is_none.iter().any(|start| text.starts_with(start))
}
