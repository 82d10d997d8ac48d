//! Presets: settings kept in a TOML file under the long names of the command line's options, and those that ship.
//!
//! A preset is exactly a command line kept in a file: `line-width = 3` is `--line-width 3`. The structs' settings declare names
//! and values, see [`crate::settings`]; this module reads and writes the file.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use tinta::Preset;
//! use tinta::preset::{OptionValue, to_toml};
//!
//! let preset = Preset::parse("ink.toml", "style = \"inking\"\nline-width = 3\n")?;
//! assert_eq!(preset.options["line-width"], OptionValue::text("3"));
//! assert_eq!(Preset::parse("again.toml", &to_toml(&preset.options, ""))?.options, preset.options);
//! # Ok(())
//! # }
//! ```

mod looks;
mod shipped;

use crate::settings::rule_text;
pub use crate::settings::{OptionValue, Options};
pub use looks::{LOOKS, Look, StyleOrLook};
pub use shipped::SHIPPED;

use crate::choice::nearest;
use crate::error::{Error, FileKind, Result};
use crate::files::shown;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::Read;
use std::path::Path;
use toml::de::{DeArray, DeTable, DeValue};

/// The longest preset read, bytes: some hundred times the size of all options.
pub(crate) const LARGEST_BYTES: u64 = 64 << 10;

/// How the names of presets that ship begin.
pub const PREFIX: &str = "paper:";

/// A preset: the options it sets, with their lines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Preset {
    /// The file as the user named it, or `paper:…`.
    pub name: String,
    /// The options it sets.
    pub options: Options,
    lines: BTreeMap<String, u64>,
}

impl Preset {
    /// Reads a file, or one of [`SHIPPED`] by its name `paper:…`.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when it is missing, not a regular file, longer than `LARGEST_BYTES`, or no flat table of TOML; for
    /// an unknown name with those there are.
    pub fn read(name: &str) -> Result<Self> {
        if let Some(short) = name.strip_prefix(PREFIX) {
            let found = SHIPPED.iter().find(|(known, _)| *known == name);
            return match found {
                Some((_, text)) => Self::parse(name, text),
                None => {
                    let without_prefix = |name: &'static str| name.strip_prefix(PREFIX).unwrap_or(name);
                    let names = SHIPPED.map(|(known, _)| without_prefix(known));
                    let choice = match nearest(short, &names) {
                        Some(meant) => format!("did you mean {PREFIX}{meant}?"),
                        None => format!("there are {}", shipped_names()),
                    };
                    Err(refused(name, format!("no shipped preset has this name; {choice}")))
                }
            };
        }
        let path = Path::new(name);
        let cannot_read = |error: std::io::Error| {
            let problem = match error.kind() {
                std::io::ErrorKind::NotFound => {
                    format!("there is no such file; name a preset, or one that ships: {}", shipped_names())
                }
                _ => format!("it cannot be read ({error}); check the file"),
            };
            refused(name, problem).because(&error)
        };
        // Only files: a pipe or device would never end.
        if !path.metadata().map_err(cannot_read)?.is_file() {
            return Err(refused(name, "this is not a regular file; name a preset file"));
        }
        if crate::mesh::is_model_name(name) {
            return Err(refused(name, "this is a model, not a preset; name it without --preset"));
        }
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(cannot_read)?;
        file.take(LARGEST_BYTES + 1).read_to_end(&mut bytes).map_err(cannot_read)?;
        if bytes.len() as u64 > LARGEST_BYTES {
            return Err(refused(name, format!("it is longer than {LARGEST_BYTES} bytes, the limit for a preset")));
        }
        let text = String::from_utf8(bytes).map_err(|_| refused(name, "it is not UTF-8 text; save it as UTF-8"))?;
        Self::parse(name, &text)
    }

    /// Reads a preset's text; `name` is its name in errors.
    ///
    /// # Errors
    ///
    /// [`Error::File`] with the line for invalid TOML, a table that is no rule for parts, or a value that no option takes.
    pub fn parse(name: &str, text: &str) -> Result<Self> {
        let line_of = |offset: usize| {
            let before = text.as_bytes().iter().take(offset);
            1 + before.filter(|byte| **byte == b'\n').count() as u64
        };
        let at =
            |offset: usize, problem: String| Error::file(FileKind::Preset, name, problem).at(Some(line_of(offset)));
        let table = DeTable::parse(text).map_err(|error| {
            let message = error.message().split_whitespace().collect::<Vec<_>>().join(" ");
            let offset = error.span().map_or(0, |span| span.start);
            at(offset, format!("this is not TOML ({}); write lines such as line-width = 3", shown(&message)))
        })?;
        let mut preset = Self { name: name.to_owned(), options: Options::new(), lines: BTreeMap::new() };
        for (key, value) in table.into_inner() {
            let start = key.span().start;
            let key = key.into_inner().into_owned();
            let value =
                option_value(value.get_ref()).map_err(|problem| at(start, format!("{}: {problem}", shown(&key))))?;
            preset.lines.insert(key.clone(), line_of(start));
            preset.options.insert(key, value);
        }
        Ok(preset)
    }

    /// Options from another source; `name` is its name in errors.
    pub fn of_options(name: &str, options: Options) -> Self {
        Self { name: name.to_owned(), options, lines: BTreeMap::new() }
    }

    /// The same with these of its options alone.
    #[must_use]
    pub fn of(mut self, is_wanted: impl Fn(&str) -> bool) -> Self {
        self.options.retain(|name, _| is_wanted(name));
        self
    }

    /// The line of an option, 1-based.
    pub(crate) fn line_of(&self, option: &str) -> Option<u64> {
        self.lines.get(option).copied()
    }

    /// An error about one of its options.
    pub fn refuse(&self, option: &str, problem: impl Into<String>) -> Error {
        Error::file(FileKind::Preset, self.name.clone(), problem.into()).at(self.line_of(option))
    }
}

/// The names of all presets that ship, with commas between.
fn shipped_names() -> String {
    SHIPPED.map(|(name, _)| name).join(", ")
}

/// A preset's text: a line for each option, the style first, with `comment` above them.
pub fn to_toml(options: &Options, comment: &str) -> String {
    let mut text = String::new();
    comment.lines().for_each(|line| {
        let _ = writeln!(text, "# {line}");
    });
    let style = |(name, _): &(&String, &OptionValue)| *name == "style";
    for (name, value) in options.iter().filter(style).chain(options.iter().filter(|option| !style(option))) {
        let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        let name = if !name.is_empty() && name.chars().all(is_bare) { name.clone() } else { quoted(name) };
        let _ = match value {
            OptionValue::Switch(switch) => writeln!(text, "{name} = {switch}"),
            OptionValue::Texts(values) => writeln!(text, "{name} = {}", quoted(&values.join(","))),
            OptionValue::Text(value) if is_number(value) => writeln!(text, "{name} = {value}"),
            OptionValue::Text(value) => writeln!(text, "{name} = {}", quoted(value)),
        };
    }
    text
}

fn refused(name: &str, problem: impl Into<String>) -> Error {
    Error::file(FileKind::Preset, name, problem.into())
}

/// The error for anything else in place of a value.
const NO_VALUE: &str = "write a text, a number, true or false, or several numbers or texts in brackets; only rules for parts are \
                        tables: [part.\"bolt*\"]";

/// A value of the file as an option takes it.
fn option_value(value: &DeValue<'_>) -> std::result::Result<OptionValue, String> {
    match value {
        DeValue::Boolean(switch) => Ok(OptionValue::Switch(*switch)),
        DeValue::Array(values) => scalars(values).map(|texts| OptionValue::Text(texts.join(","))),
        DeValue::Table(rules) => {
            let rule = |(name, value): (&str, &DeValue<'_>)| match value {
                DeValue::Table(settings) => {
                    let setting = |(name, value): (&str, &DeValue<'_>)| Ok((name.to_owned(), setting_of_rule(value)?));
                    let settings = in_order(settings).map(setting).collect::<std::result::Result<Vec<_>, String>>()?;
                    Ok(rule_text(name, settings))
                }
                _ => Err(NO_VALUE.to_owned()),
            };
            in_order(rules).map(rule).collect::<std::result::Result<_, String>>().map(OptionValue::Texts)
        }
        value => scalar(value).map(OptionValue::Text),
    }
}

/// A table's entries in the file's order.
fn in_order<'t>(table: &'t DeTable<'_>) -> impl Iterator<Item = (&'t str, &'t DeValue<'t>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries.into_iter().map(|(key, value)| (key.get_ref().as_ref(), value.get_ref()))
}

/// A setting's value in a rule's table.
fn setting_of_rule(value: &DeValue<'_>) -> std::result::Result<OptionValue, String> {
    match value {
        DeValue::Boolean(switch) => Ok(OptionValue::Switch(*switch)),
        DeValue::Array(values) => scalars(values).map(OptionValue::Texts),
        value => scalar(value).map(OptionValue::Text),
    }
}

fn scalars(values: &DeArray<'_>) -> std::result::Result<Vec<String>, String> {
    values.iter().map(|value| scalar(value.get_ref())).collect()
}

fn scalar(value: &DeValue<'_>) -> std::result::Result<String, String> {
    match value {
        DeValue::String(text) => Ok(text.clone().into_owned()),
        DeValue::Integer(number) => i128::from_str_radix(number.as_str(), number.radix())
            .map(|number| number.to_string())
            .map_err(|_| "this number is too long; write a shorter one".to_owned()),
        DeValue::Float(number) => Ok(number.as_str().trim_start_matches('+').to_owned()),
        _ => Err(NO_VALUE.to_owned()),
    }
}

/// Whether TOML reads the text as a number and gives the same text back.
fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let (whole, fraction) = digits.split_once('.').map_or((digits, "0"), |(whole, fraction)| (whole, fraction));
    let is_plain = |part: &str| (1..=15).contains(&part.len()) && part.bytes().all(|byte| byte.is_ascii_digit());
    is_plain(whole) && is_plain(fraction) && (whole == "0" || !whole.starts_with('0')) && text != "-0"
}

/// A text as TOML writes it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", letter as u32);
            }
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Preset {
        Preset::parse("a.toml", text).unwrap()
    }

    #[test]
    fn an_error_names_the_preset_and_the_line_of_the_option() {
        let preset = Preset::parse("far.toml", "line-width = 3\n\ntones = 2\n").unwrap();
        assert!(preset.refuse("tones", "wrong").to_string().starts_with("far.toml: line 3: wrong"));
        assert!(preset.refuse("eye", "wrong").to_string().starts_with("far.toml: wrong"));
        assert_eq!(preset.of(|name| name == "tones").options.len(), 1);
    }

    #[test]
    fn every_kind_of_value_becomes_what_the_command_line_takes() {
        let text = "# mine\nstyle = \"inking\"\ntones = 2\nweld = 1e-7\nparallel = true # flat\n\
                    tone-levels = [0.5, 1, \"2\"]\nseed = 0xFF\nfov = -1_0.5\neye = \"1,2,3\"\n";
        let preset = parsed(text);
        let expected = [
            ("eye", OptionValue::text("1,2,3")),
            ("fov", OptionValue::text("-10.5")),
            ("parallel", OptionValue::Switch(true)),
            ("seed", OptionValue::text("255")),
            ("style", OptionValue::text("inking")),
            ("tone-levels", OptionValue::text("0.5,1,2")),
            ("tones", OptionValue::text("2")),
            ("weld", OptionValue::text("1e-7")),
        ];
        assert_eq!(preset.options, expected.map(|(name, value)| (name.to_owned(), value)).into());
        assert_eq!((preset.line_of("style"), preset.line_of("eye"), preset.line_of("no")), (Some(2), Some(9), None));
    }

    #[test]
    fn names_that_are_no_bare_keys_are_written_in_quotes() {
        let options: Options =
            ["a key with \u{7} and \" in it", "", "tones"].map(|name| (name.to_owned(), OptionValue::text("2"))).into();
        assert_eq!(parsed(&to_toml(&options, "")).options, options);
    }

    #[test]
    fn what_is_no_preset_is_refused_with_its_line() {
        let message = |text: &str| Preset::parse("a.toml", text).unwrap_err().to_string();
        for (text, start) in [
            ("style = \"inking\"\ntones =\n", "a.toml: line 2: this is not TOML"),
            ("tones = 1\ntones = 2\n", "a.toml: line 2: this is not TOML"),
            ("\n\n[style]\ntones = 2\n", "a.toml: line 3: style: write a text"),
            ("tones = 1\nstyle.tones = 2\n", "a.toml: line 2: style: write a text"),
            ("size = 1979-05-27\n", "a.toml: line 1: size: write a text"),
            ("tone-levels = [[1, 2], 3]\n", "a.toml: line 1: tone-levels: write a text"),
            ("\u{0}\u{ffff}", "a.toml: line 1: this is not TOML"),
        ] {
            let message = message(text);
            assert!(message.starts_with(start) && message.lines().count() == 1, "{message}");
        }
    }

    #[test]
    fn files_that_are_none_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let message = |name: &str| Preset::read(name).unwrap_err().to_string();
        assert!(message(folder.path().to_str().unwrap()).contains("not a regular file"));
        let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        assert!(message(&at("none.toml")).contains("no such file"));
        std::fs::write(at("long.toml"), vec![b'#'; LARGEST_BYTES as usize + 1]).unwrap();
        assert!(message(&at("long.toml")).contains("longer than 65536 bytes"));
        std::fs::write(at("long.toml"), vec![b'#'; LARGEST_BYTES as usize]).unwrap();
        assert_eq!(Preset::read(&at("long.toml")).unwrap().options.len(), 0);
        std::fs::write(at("latin.toml"), b"# caf\xe9").unwrap();
        assert!(message(&at("latin.toml")).contains("UTF-8"));
        let unknown = message("paper:nobody");
        assert!(SHIPPED.iter().all(|(name, _)| unknown.contains(name)), "{unknown}");
    }

    proptest::proptest! {
        #[test]
        fn what_is_written_is_read_back(
            texts in proptest::collection::btree_map("[a-z]{1,8}(-[a-z]{1,5})?", "\\PC*|[-0-9.e]{1,9}|[\u{0}-\u{ff}]*", 0..8),
            switch in proptest::bool::ANY,
        ) {
            let mut options: Options = texts.into_iter().map(|(name, text)| (name, OptionValue::Text(text))).collect();
            options.insert("style".to_owned(), OptionValue::Switch(switch));
            let text = to_toml(&options, "two\nlines");
            assert!(text.starts_with("# two\n# lines\nstyle = "), "{text}");
            assert_eq!(parsed(&text).options, options, "{text}");
        }

        #[test]
        fn no_text_makes_the_reader_panic(text in "[a-z0-9=\"'\\[\\]{}.,# \n\u{0}-\u{1f}-]{0,60}|\\PC*") {
            let _ = Preset::parse("a.toml", &text);
        }
    }
}
