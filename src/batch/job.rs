//! A job: one line of a list, read without knowledge of the options.

use crate::files::shown;
use crate::limits::{JOB_BYTES, JOB_ID_BYTES};
use crate::settings::OptionValue;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::fmt::{Formatter, Write};

/// The options that name a file or folder to write.
pub const OUTPUTS: [&str; 3] = ["output", "dump", "save-preset"];

/// The commands that jobs may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum JobCommand {
    /// `tinta render`
    Render,
    /// `tinta compare`
    Compare,
    /// `tinta measure`
    Measure,
}

impl JobCommand {
    /// All of them, with their names in lists.
    pub const ALL: [(&'static str, Self); 3] =
        [("render", Self::Render), ("compare", Self::Compare), ("measure", Self::Measure)];

    /// Its name in lists.
    pub fn name(self) -> &'static str {
        match self {
            Self::Render => "render",
            Self::Compare => "compare",
            Self::Measure => "measure",
        }
    }
}

/// The contents of one line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// Its name, the same from run to run.
    pub id: String,
    /// Its line number, 1-based; 0 outside of a list.
    pub line: u64,
    /// The command to run.
    pub command: JobCommand,
    /// The models.
    pub models: Vec<String>,
    /// Every other key, by name, as the line has it.
    pub options: Vec<(String, OptionValue)>,
    /// SHA-256 of its content, hexadecimal: blanks and the order of its keys do not count.
    pub sha256: String,
    /// The content as JSON on one line, its keys sorted.
    pub json: String,
}

impl Job {
    /// Parses a line.
    ///
    /// # Errors
    ///
    /// A sentence without the file's name.
    pub fn parse(line: &[u8]) -> Result<Self, String> {
        let keys = keys(line)?;
        let json = sorted(&keys);
        let sha256 = hexadecimal(&Sha256::digest(json.as_bytes()));
        let Asked { id, command, models, options } = Asked::of_keys(keys)?;
        Ok(Self { id, line: 0, command, models, options, sha256, json })
    }
}

/// A line without its number and digest: enough to check it.
pub(super) struct Asked {
    pub id: String,
    pub command: JobCommand,
    models: Vec<String>,
    options: Vec<(String, OptionValue)>,
}

impl Asked {
    /// Takes a job's command and options.
    pub(super) fn of_job(job: &Job) -> Self {
        let Job { id, command, options, .. } = job.clone();
        Self { id, command, models: Vec::new(), options }
    }

    /// Reads a line and refuses what [`Job::parse`] does.
    pub(super) fn of_line(line: &[u8]) -> Result<Self, String> {
        Self::of_keys(keys(line)?)
    }

    /// The options that name output files, with those names.
    pub(super) fn outputs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.options.iter().filter_map(|(key, value)| match value {
            OptionValue::Text(output) if OUTPUTS.contains(&key.as_str()) => Some((key.as_str(), output.as_str())),
            _ => None,
        })
    }

    /// The text that an option is given.
    pub(super) fn text(&self, option: &str) -> Option<&str> {
        self.options.iter().find_map(|(key, value)| match value {
            OptionValue::Text(text) if key == option => Some(text.as_str()),
            _ => None,
        })
    }

    fn of_keys(mut keys: Vec<(String, Value)>) -> Result<Self, String> {
        let mut take = |name: &str| {
            let place = keys.iter().position(|(key, _)| key == name)?;
            Some(keys.remove(place).1)
        };
        let id = match take("id") {
            Some(Value::String(id)) => id,
            Some(Value::Number(id)) if id.is_u64() || id.is_i64() => id.to_string(),
            Some(_) => return Err("id: write a text or a whole number".to_owned()),
            None => return Err("it has no id; give each job its own".to_owned()),
        };
        check_id(&id)?;
        let command = match take("command") {
            Some(Value::String(name)) => JobCommand::ALL
                .iter()
                .find(|(known, _)| *known == name)
                .map(|(_, command)| *command)
                .ok_or_else(|| format!("command: {} is not render, compare or measure", shown(&name)))?,
            Some(_) => return Err("command: write render, compare or measure".to_owned()),
            None => return Err("it has no command; write render, compare or measure".to_owned()),
        };
        let models = match take("model") {
            None => Vec::new(),
            Some(Value::String(model)) => vec![model],
            Some(Value::Array(models)) => models
                .into_iter()
                .map(|model| match model {
                    Value::String(model) => Ok(model),
                    _ => Err("model: write a text, or several in brackets".to_owned()),
                })
                .collect::<Result<_, _>>()?,
            Some(_) => return Err("model: write a text, or several in brackets".to_owned()),
        };
        let options = keys.into_iter().map(|(key, value)| {
            let value = job_value(value).map_err(|problem| format!("{}: {problem}", shown(&key)))?;
            Ok((key, value))
        });
        let options = options.collect::<Result<_, String>>()?;
        if models.iter().any(|model| model == "-") {
            return Err("model: - is standard input, which jobs lack; name a file".to_owned());
        }
        Ok(Self { id, command, models, options })
    }
}

/// A line's keys in their order.
fn keys(line: &[u8]) -> Result<Vec<(String, Value)>, String> {
    if line.len() > JOB_BYTES {
        return Err(format!("the line is longer than {JOB_BYTES} bytes, the limit for a job; make it shorter"));
    }
    let text = std::str::from_utf8(line).map_err(|_| "it is not UTF-8 text; save the list as UTF-8".to_owned())?;
    let keys: Keys = serde_json::from_str(text).map_err(|error| {
        let said = error.to_string();
        let said = said.split(" at line ").next().unwrap_or(&said);
        format!("this is not a job ({}); write one JSON object per line", shown(said))
    })?;
    Ok(keys.0)
}

/// A name that a message, a terminal and a table can show.
fn check_id(id: &str) -> Result<(), String> {
    if id.is_empty() || id.len() > JOB_ID_BYTES {
        return Err(format!("id: it has {} bytes; give it 1 to {JOB_ID_BYTES}", id.len()));
    }
    match id.chars().any(char::is_control) {
        true => Err(format!("id: {} contains a control character; remove it", shown(id))),
        false => Ok(()),
    }
}

fn job_value(value: Value) -> Result<OptionValue, String> {
    match value {
        Value::Bool(switch) => Ok(OptionValue::Switch(switch)),
        Value::Array(values) => values.into_iter().map(scalar).collect::<Result<_, _>>().map(OptionValue::Texts),
        value => scalar(value).map(OptionValue::Text),
    }
}

fn scalar(value: Value) -> Result<String, String> {
    match value {
        Value::String(text) => Ok(text),
        Value::Number(number) => Ok(number.to_string()),
        _ => Err("write a text, a number, true or false, or several texts or numbers in brackets".to_owned()),
    }
}

/// A line's keys in their order, without repetition: JSON itself would silently keep the last one of each.
struct Keys(Vec<(String, Value)>);

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Each;
        impl<'de> Visitor<'de> for Each {
            type Value = Keys;

            fn expecting(&self, to: &mut Formatter<'_>) -> std::fmt::Result {
                to.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
                let mut keys: Vec<(String, Value)> = Vec::new();
                while let Some(key) = map.next_entry::<String, Value>()? {
                    keys.push(key);
                }
                let mut names: Vec<&str> = keys.iter().map(|(key, _)| key.as_str()).collect();
                names.sort_unstable();
                match names.windows(2).find(|pair| pair[0] == pair[1]) {
                    Some(pair) => Err(serde::de::Error::custom(format!("the key {} is given twice", shown(pair[0])))),
                    None => Ok(Keys(keys)),
                }
            }
        }
        from.deserialize_map(Each)
    }
}

/// The same content gives the same text in any order of keys.
fn sorted(keys: &[(String, Value)]) -> String {
    let mut keys: Vec<&(String, Value)> = keys.iter().collect();
    keys.sort_by(|one, other| one.0.cmp(&other.0));
    let text = |(key, value): &&(String, Value)| format!("{}:{value}", Value::String(key.clone()));
    format!("{{{}}}", keys.iter().map(text).collect::<Vec<_>>().join(","))
}

/// Bytes as hexadecimal digits.
pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(bytes.len() * 2), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(line: &str) -> String {
        Job::parse(line.as_bytes()).unwrap_err()
    }

    #[test]
    fn every_kind_of_value_is_kept_as_the_command_line_takes_it() {
        let line = r#"{"id": 7, "command": "render", "model": ["a.obj", "b.ply"], "output": "a.png", "weld": 1e-7,
            "seed": 18446744073709551615, "parallel": true, "tone-levels": [0.5, 1, "2"], "fov": -10.50}"#;
        let job = Job::parse(line.as_bytes()).unwrap();
        assert_eq!(
            (job.id.as_str(), job.command, job.models),
            ("7", JobCommand::Render, vec!["a.obj".to_owned(), "b.ply".to_owned()])
        );
        let text = |text: &str| OptionValue::Text(text.to_owned());
        let expected = [
            ("output", text("a.png")),
            ("weld", text("1e-7")),
            ("seed", text("18446744073709551615")),
            ("parallel", OptionValue::Switch(true)),
            ("tone-levels", OptionValue::Texts(["0.5", "1", "2"].map(str::to_owned).to_vec())),
            ("fov", text("-10.5")),
        ];
        assert_eq!(job.options, expected.map(|(key, value)| (key.to_owned(), value)));
    }

    #[test]
    fn a_jobs_content_is_known_whatever_its_order_and_blanks() {
        let hash = |line: &str| Job::parse(line.as_bytes()).unwrap().sha256;
        let one = hash(r#"{"id":"a","command":"render","model":"m","size":64}"#);
        assert_eq!(one, hash(r#" { "size" : 64, "model":"m" ,"command":"render", "id":"a" } "#));
        assert_ne!(one, hash(r#"{"id":"a","command":"render","model":"m","size":65}"#));
        assert_eq!(one.len(), 64);
        let again = Job::parse(one_json().as_bytes()).unwrap();
        assert_eq!(again.json, one_json());
    }

    fn one_json() -> &'static str {
        r#"{"command":"render","id":"a","model":"m","size":64}"#
    }

    #[test]
    fn lines_that_are_no_jobs_say_what_they_lack() {
        for (line, words) in [
            ("", "this is not a job (EOF"),
            ("[1, 2]", "this is not a job (invalid type: sequence, expected an object)"),
            ("{} {}", "this is not a job (trailing characters"),
            (r#"{"id": "a"}"#, "it has no command"),
            (r#"{"command": "render"}"#, "it has no id"),
            (r#"{"id": "a", "command": "view"}"#, "command: view is not render, compare or measure"),
            (r#"{"id": "a", "command": 3}"#, "command: write render, compare or measure"),
            (r#"{"id": 1.5, "command": "render"}"#, "id: write a text or a whole number"),
            (r#"{"id": "", "command": "render"}"#, "id: it has 0 bytes"),
            (r#"{"id": "a\u0000b", "command": "render"}"#, "id: a\\u{0}b contains a control character"),
            (r#"{"id": "a", "id": "b", "command": "render"}"#, "the key id is given twice"),
            (r#"{"id": "a", "command": "render", "size": {"x": 1}}"#, "size: write a text"),
            (r#"{"id": "a", "command": "render", "size": null}"#, "size: write a text"),
            (r#"{"id": "a", "command": "render", "size": [[1]]}"#, "size: write a text"),
            (r#"{"id": "a", "command": "render", "model": [1]}"#, "model: write a text"),
            (r#"{"id": "a", "command": "render", "model": ["a", "-"]}"#, "model: - is standard input, which"),
        ] {
            let said = refused(line);
            assert!(said.contains(words) && said.len() < 300, "{line}: {said}");
        }
        assert!(
            refused(&format!(r#"{{"id": "{}", "command": "render"}}"#, "x".repeat(300))).contains("it has 300 bytes")
        );
        assert!(refused(&"[".repeat(10_000)).contains("this is not a job"));
        assert!(refused(&" ".repeat(JOB_BYTES + 1)).contains("longer than"));
        assert!(Job::parse(b"{\"id\": \"\xff\"}").unwrap_err().contains("UTF-8"));
        let deep = format!(r#"{{"id": "a", "command": "render", "x": {}1{}}}"#, "[".repeat(200), "]".repeat(200));
        assert!(refused(&deep).contains("recursion limit"), "{}", refused(&deep));
    }

    proptest::proptest! {
        #[test]
        fn no_line_makes_the_reader_panic(line in "\\{(\"(id|command|model|[a-z]{1,4})\": ?(\"\\PC{0,6}\"|[0-9.e-]{1,5}|true|null|\\[1,2\\]),?){0,5}\\}?|\\PC*") {
            if let Ok(job) = Job::parse(line.as_bytes()) {
                let again = Job::parse(job.json.as_bytes()).unwrap();
                assert_eq!((again.sha256, again.json), (job.sha256, job.json));
            }
        }
    }
}
