//! The error of a command line in one sentence: clap's without usage lines and hints, or a better one where possible, such as a
//! suggested name.

use super::groups::inside_now;
use super::help::options;
use crate::choice::{meant_or, nearest, no_option};
use crate::files::shown;
use crate::request::{Request, is_drawn_into};
use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;
use std::path::Path;

/// The longest part of clap's message that is printed, in characters.
const LONGEST_SENTENCE: usize = 400;

/// Turns clap's error about these words, the program's name first, into a sentence; `whole` is the command that parsed them.
pub(super) fn sentence(error: &clap::Error, whole: &Command, words: &[OsString]) -> String {
    let command = words.iter().skip(1).find_map(|word| whole.find_subcommand(word)).unwrap_or(whole);
    let better = match error.kind() {
        ErrorKind::InvalidSubcommand => unknown_command(error, whole),
        ErrorKind::UnknownArgument => unknown_option(error, command, words),
        ErrorKind::InvalidValue => unknown_value(error),
        ErrorKind::MissingRequiredArgument => missing(error, whole, command, words),
        ErrorKind::InvalidUtf8 => words.iter().find(|word| word.to_str().is_none()).map(not_utf_8),
        _ => None,
    };
    better.unwrap_or_else(|| first_paragraph(&error.to_string()))
}

fn not_utf_8(word: &OsString) -> String {
    format!(
        "{} is not in UTF-8; rename the file, or give a model as - on standard input",
        shown(&word.to_string_lossy())
    )
}

/// The first paragraph of a message on one line, which is not without end: a value may be as long as a file.
fn first_paragraph(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or_default();
    let sentence = paragraph.split_whitespace().collect::<Vec<_>>().join(" ");
    shortened(sentence.strip_prefix("error: ").unwrap_or(&sentence))
}

/// Its beginning and its end, which name the option and what is wrong, if it is long.
fn shortened(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let surplus = letters.len().saturating_sub(LONGEST_SENTENCE);
    let (start, end) = letters.split_at(letters.len().min(LONGEST_SENTENCE / 2));
    let omitted = if surplus > 0 { "…" } else { "" };
    format!("{}{omitted}{}", String::from_iter(start), String::from_iter(&end[surplus..]))
}

/// A text that clap's error holds.
fn text(error: &clap::Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    }
}

/// A list of texts of the error.
fn texts(error: &clap::Error, kind: ContextKind) -> Option<&[String]> {
    match error.get(kind) {
        Some(ContextValue::Strings(texts)) => Some(texts),
        _ => None,
    }
}

fn unknown_command(error: &clap::Error, whole: &Command) -> Option<String> {
    let name = text(error, ContextKind::InvalidSubcommand)?;
    if is_drawn_into(name) {
        let model = ["obj", "stl", "ply", "glb"].map(|ending| Path::new(name).with_extension(ending));
        if let Some(model) = model.iter().find(|model| model.is_file()) {
            return Some(format!("{} is no model; did you mean {}?", shortened(name), model.display()));
        }
        return Some(format!(
            "{} is no model; tinta again {0} -o FILE draws a picture of tinta's again",
            shortened(name)
        ));
    }
    let names: Vec<&str> = whole.get_subcommands().map(Command::get_name).collect();
    let otherwise = match name {
        "view" => "cargo install --path crates/tinta-cli builds a program that has it".to_owned(),
        _ => format!("choose one of {}", names.join(", ")),
    };
    let choice = meant_or(name, &names, &otherwise);
    Some(format!("there is no command {}; {choice}", shortened(name)))
}

fn unknown_option(error: &clap::Error, command: &Command, words: &[OsString]) -> Option<String> {
    let given = text(error, ContextKind::InvalidArg)?;
    // clap sees -size as -s.
    let is_single = given.starts_with('-') && !given.starts_with("--");
    let word = words.iter().skip(1).filter_map(|word| word.to_str()).find(|word| is_single && word.starts_with(given));
    let word = word.unwrap_or(given);
    let name = word.split('=').next().unwrap_or_default();
    if !name.starts_with('-') {
        return Some(surplus(command, &shortened(word)));
    }
    let bare = name.trim_start_matches('-');
    if let Some(problem) = Request::gone(bare).map(|problem| format!("{name}: {problem}")).or_else(|| inside_now(bare))
    {
        return Some(problem);
    }
    let command_name = match command.get_name() {
        "tinta" => "tinta".to_owned(),
        name => format!("tinta {name}"),
    };
    let meant = meant_option(command, name.trim_start_matches('-')).map(|meant| format!("--{meant}"));
    Some(no_option(&command_name, &shortened(name), meant.as_deref()))
}

/// The error about a surplus word.
fn surplus(command: &Command, word: &str) -> String {
    let name = command.get_name();
    let taken: Vec<String> = command
        .get_positionals()
        .filter_map(|arg| arg.get_value_names()?.first().map(|name| name.to_lowercase()))
        .collect();
    match &taken[..] {
        [] => format!("tinta {name} takes options alone; leave out {word}"),
        taken => format!("tinta {name} takes one {}; {word} is one too many", taken.join(" and one ")),
    }
}

/// The option of a command closest to a mistyped name, without dashes.
pub(super) fn meant_option<'c>(command: &'c Command, name: &str) -> Option<&'c str> {
    let options: Vec<&str> =
        options(command).filter(|arg| !arg.is_hide_set()).filter_map(|arg| arg.get_long()).collect();
    nearest(name, &options)
}

/// The error about a value that clap knows to be one of a few names.
fn unknown_value(error: &clap::Error) -> Option<String> {
    let (value, arg) = (text(error, ContextKind::InvalidValue)?, text(error, ContextKind::InvalidArg)?);
    let names: Vec<&str> = texts(error, ContextKind::ValidValue)?.iter().map(String::as_str).collect();
    let choice = meant_or(value, &names, &format!("choose one of {}", names.join(", ")));
    (!value.is_empty()).then(|| format!("invalid value '{}' for '{arg}': {choice}", shortened(value)))
}

/// An example of the complete command line where a model or the output is missing.
fn missing(error: &clap::Error, whole: &Command, command: &Command, words: &[OsString]) -> Option<String> {
    let missing = texts(error, ContextKind::InvalidArg)?;
    let output = missing.iter().find_map(|what| what.strip_prefix("--output "));
    let others: Vec<&str> = missing.iter().map(String::as_str).filter(|what| !what.starts_with("--output ")).collect();
    let name = command.get_name();
    let is_model = matches!(others[..], ["<MODEL>..." | "<MODEL>" | "<MODEL|LIST>..."]);
    // An output's name for the model that is given, or for a cow.
    let models = models(whole, words);
    let stem = models.first().map_or("cow".to_owned(), stem);
    let into = |output: &str, stem: &str| match output {
        "<DIR>" => "results".to_owned(),
        _ if name == "page" => format!("{stem}.html"),
        _ => format!("{stem}.png"),
    };
    let what = |output: &str| match output {
        "<DIR>" => "folder to write into",
        _ if name == "page" => "page to write",
        _ => "picture to write",
    };
    // Many programs take the output as their last word.
    let meant = models.last().and_then(|last| last.to_str()).filter(|_| models.len() > 1 && others.is_empty());
    if let Some(meant) = meant.filter(|last| is_drawn_into(last)) {
        return Some(format!("--output is missing; did you mean -o {}?", shortened(meant)));
    }
    match output {
        Some(output) if others.is_empty() => {
            Some(format!("--output is missing; name the {}: -o {}", what(output), into(output, &stem)))
        }
        Some(output) if is_model => {
            Some(format!("a model and --output are missing: tinta {name} cow.obj -o {}", into(output, "cow")))
        }
        None if is_model => Some("a model is missing; name a file, or a built-in one such as builtin:bust".to_owned()),
        _ => None,
    }
}

/// The models that the words name.
fn models(whole: &Command, words: &[OsString]) -> Vec<OsString> {
    let matches = whole.clone().ignore_errors(true).try_get_matches_from(words).ok();
    let given = matches.as_ref().and_then(|matches| matches.subcommand()).map(|(_, given)| given);
    let named = |id| given.filter(|given| given.try_contains_id(id).is_ok_and(|is_there| is_there))?.get_raw(id);
    named("models").or_else(|| named("model")).into_iter().flatten().map(OsString::from).collect()
}

/// A possible name for a picture of a model, without its ending; `None` for names that a shell would split.
fn stem(model: &OsString) -> String {
    let model = model.to_string_lossy();
    let name = model.strip_prefix("builtin:").unwrap_or(&model);
    let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_' || c == '.';
    match !stem.is_empty() && !stem.starts_with('-') && stem.chars().all(is_plain) && stem.len() <= 64 {
        true => stem,
        false => "picture".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Program;

    fn said(line: &str) -> String {
        Program::default().check(line.split(' ').map(Into::into)).unwrap_err()
    }

    #[test]
    fn a_long_value_leaves_the_option_and_the_advice_in_sight() {
        let said = said(&format!("tinta render a.obj -o a.png --color {}", "a".repeat(3_000)));
        assert!(
            said.starts_with("invalid value 'aaa") && said.chars().count() <= super::LONGEST_SENTENCE + 20,
            "{said}"
        );
        assert!(said.contains("…a") && said.contains("a' for '--color <COLOR>': "), "{said}");
    }

    #[test]
    fn what_was_meant_is_said() {
        for (line, sentence) in [
            ("tinta redner", "there is no command redner; did you mean render?"),
            (
                "tinta a/cow.png",
                "a/cow.png is no model; tinta again a/cow.png -o FILE draws a picture of tinta's again; see --help",
            ),
            (
                "tinta cow.svg",
                "cow.svg is no model; tinta again cow.svg -o FILE draws a picture of tinta's again; see --help",
            ),
            ("tinta render a.obj -o a.png --colour red", "tinta render has no option --colour; did you mean --color?"),
            ("tinta render a.obj -o a.png -size=64", "tinta render has no option -size; did you mean --size?"),
            (
                "tinta info a.obj --crease_angel 30",
                "tinta info has no option --crease_angel; did you mean --crease-angle?",
            ),
            ("tinta info a.obj --seed 3", "tinta info has no option --seed; see --help"),
            ("tinta --versoin", "tinta has no option --versoin; did you mean --version?"),
            ("tinta generate bahs", "invalid value 'bahs' for '<WHAT>': did you mean bash?"),
            (
                "tinta generate nushell",
                "invalid value 'nushell' for '<WHAT>': choose one of bash, zsh, fish, powershell, man; see --help",
            ),
            (
                "tinta render a.obj -o a.png --style three_pass",
                "invalid value 'three_pass' for '--style <STYLE>': did you mean three-pass?",
            ),
            (
                "tinta render a.obj -o a.png --style technical",
                "invalid value 'technical' for '--style <STYLE>': this is a look; write --look technical; see --help",
            ),
            (
                "tinta render a.obj -o a.png --light top",
                "invalid value 'top' for '--light <WHERE>': choose one of cpu, vertex-shader, or write NAME=VALUE with one of \
                 tone-light, light-1, light-2; see --help",
            ),
            (
                "tinta render a.obj -o a.png --classes crease,boundry",
                "invalid value 'crease,boundry' for '--classes <CLASSES>': did you mean boundary?",
            ),
            (
                "tinta render a.obj -o a.png --smooth offf",
                "invalid value 'offf' for '--smooth <ON|OFF>': did you mean off?",
            ),
            ("tinta render a.obj -o a.png --view tpo", "invalid value 'tpo' for '--view <VIEW>': did you mean top?"),
            (
                "tinta render a.obj -o a.png --backend ogl",
                "invalid value 'ogl' for '--backend <BACKEND>': did you mean egl?",
            ),
        ] {
            assert_eq!(said(line), sentence, "{line}");
        }
    }

    #[test]
    fn an_output_that_is_missing_gets_the_models_name() {
        let picture = |name: &str| format!("--output is missing; name the picture to write: -o {name}.png; see --help");
        for (line, sentence) in [
            ("tinta render dir/old.cow.obj", picture("old.cow")),
            ("tinta render --size 64 builtin:gear cow.obj", picture("gear")),
            ("tinta render -", picture("picture")),
            (
                "tinta page dir/cow.obj",
                "--output is missing; name the page to write: -o cow.html; see --help".to_owned(),
            ),
            ("tinta render cow.obj a.png", "--output is missing; did you mean -o a.png?".to_owned()),
            ("tinta render cow.obj b.obj a.svg", "--output is missing; did you mean -o a.svg?".to_owned()),
            ("tinta render a;b.obj", picture("picture")),
            (
                "tinta render",
                "a model and --output are missing: tinta render cow.obj -o cow.png; see --help".to_owned(),
            ),
        ] {
            assert_eq!(said(line), sentence, "{line}");
        }
    }
}
