//! A job: one line of a list, read without knowledge of the options.

use crate::error::ParseError;
use crate::files::shown;
use crate::limits::JOB_BYTES;
use crate::settings::{OptionValue, Options};
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Formatter;

/// The options that name a file or folder to write.
pub(crate) const OUTPUTS: [&str; 3] = ["output", "dump", "save-preset"];

tinta_geometry::choices! {
    /// The commands that jobs may be.
    pub enum JobCommand {
        /// `tinta render`
        Render = "render",
        /// `tinta compare`
        Compare = "compare",
        /// `tinta measure`
        Measure = "measure",
    }
}

/// The contents of one line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// What messages call it. Default its output.
    pub id: String,
    /// Its line number, 1-based; 0 outside of a list.
    pub line: u64,
    /// The command to run.
    pub command: JobCommand,
    /// The models.
    pub models: Vec<String>,
    /// Every other key.
    pub options: Options,
    /// The content as JSON on one line, its keys sorted: blanks and the order of its keys do not count.
    pub json: String,
}

impl Job {
    /// Parses a line.
    ///
    /// # Errors
    ///
    /// A sentence without the file's name.
    pub fn parse(line: &[u8]) -> Result<Self, String> {
        let mut keys = keys(line)?;
        let json = serde_json::to_string(&keys).map_err(|error| error.to_string())?;
        let id = keys.remove("id").map(|id| if let Value::String(id) = id { id } else { id.to_string() });
        let command = match keys.remove("command") {
            Some(Value::String(name)) => name.parse().map_err(|problem: ParseError| format!("command: {problem}"))?,
            Some(_) => return Err("command: write render, compare or measure".to_owned()),
            None => JobCommand::Render,
        };
        let models: Vec<String> = match keys.remove("model") {
            None => Vec::new(),
            Some(Value::String(model)) => vec![model],
            Some(models) => {
                serde_json::from_value(models).map_err(|_| "model: write a text, or several in brackets".to_owned())?
            }
        };
        let options = keys.into_iter().map(|(key, value)| {
            let value = job_value(value).map_err(|problem| format!("{}: {problem}", shown(&key)))?;
            Ok((key, value))
        });
        let options: Options = options.collect::<Result<_, String>>()?;
        if models.iter().any(|model| model == "-") {
            return Err("model: - is standard input, which jobs lack; name a file".to_owned());
        }
        let output = match options.get("output") {
            Some(OptionValue::Text(output)) => output.clone(),
            Some(_) => return Err("output: write the name of a file, as a text".to_owned()),
            None => return Err("it has no output; name the file to write".to_owned()),
        };
        Ok(Self { id: id.unwrap_or(output), line: 0, command, models, options, json })
    }

    /// The options that name output files, with those names.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = (&'static str, &str)> {
        OUTPUTS.into_iter().filter_map(|option| match self.options.get(option)? {
            OptionValue::Text(output) => Some((option, output.as_str())),
            _ => None,
        })
    }
}

/// A line's keys.
fn keys(line: &[u8]) -> Result<BTreeMap<String, Value>, String> {
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

/// A line's keys, none of them twice: JSON itself would silently keep the last one of each.
struct Keys(BTreeMap<String, Value>);

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Each;
        impl<'de> Visitor<'de> for Each {
            type Value = Keys;

            fn expecting(&self, to: &mut Formatter<'_>) -> std::fmt::Result {
                to.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
                let mut keys = BTreeMap::new();
                while let Some((key, value)) = map.next_entry::<String, Value>()? {
                    if keys.contains_key(&key) {
                        return Err(A::Error::custom(format!("the key {} is given twice", shown(&key))));
                    }
                    keys.insert(key, value);
                }
                Ok(Keys(keys))
            }
        }
        from.deserialize_map(Each)
    }
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
        assert_eq!(job.options, expected.map(|(key, value)| (key.to_owned(), value)).into());
    }

    #[test]
    fn a_jobs_content_is_known_whatever_its_order_and_blanks() {
        let json = |line: &str| Job::parse(line.as_bytes()).unwrap().json;
        let one = r#"{"command":"render","id":"a","model":"m","output":"a.png","size":64}"#;
        assert_eq!(json(one), one);
        assert_eq!(json(r#" { "size" : 64, "output":"a.png", "model":"m" ,"command":"render", "id":"a" } "#), one);
        assert_ne!(json(&one.replace("64", "65")), one);
    }

    #[test]
    fn a_model_and_an_output_are_enough() {
        let job = Job::parse(br#"{"model": "a.obj", "output": "a.svg"}"#).unwrap();
        assert_eq!((job.id.as_str(), job.command), ("a.svg", JobCommand::Render));
        let named = |id: &str| Job::parse(format!(r#"{{"id": {id}, "output": "a.svg"}}"#).as_bytes()).unwrap().id;
        assert_eq!([named("7"), named("\"front\"")], ["7", "front"]);
    }

    #[test]
    fn lines_that_are_no_jobs_say_what_they_lack() {
        for (line, words) in [
            ("", "this is not a job (EOF"),
            ("[1, 2]", "this is not a job (invalid type: sequence, expected an object)"),
            ("{} {}", "this is not a job (trailing characters"),
            (r#"{"id": "a"}"#, "it has no output; name the file to write"),
            (r#"{"output": true}"#, "output: write the name of a file"),
            (r#"{"id": "a", "command": "view"}"#, "command: choose one of render, compare, measure"),
            (r#"{"id": "a", "command": 3}"#, "command: write render, compare or measure"),
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
        assert!(refused(&"[".repeat(10_000)).contains("this is not a job"));
        assert!(refused(&" ".repeat(JOB_BYTES + 1)).contains("longer than"));
        assert!(Job::parse(b"{\"id\": \"\xff\"}").unwrap_err().contains("UTF-8"));
        let deep = format!(r#"{{"id": "a", "command": "render", "x": {}1{}}}"#, "[".repeat(200), "]".repeat(200));
        assert!(refused(&deep).contains("recursion limit"), "{}", refused(&deep));
    }

    proptest::proptest! {
        #[test]
        fn no_line_makes_the_reader_panic(line in "\\{(\"(id|command|model|output|[a-z]{1,4})\": ?(\"\\PC{0,6}\"|[0-9.e-]{1,5}|true|null|\\[1,2\\]),?){0,5}\\}?|\\PC*") {
            if let Ok(job) = Job::parse(line.as_bytes()) {
                let again = Job::parse(job.json.as_bytes()).unwrap();
                assert_eq!(again, job);
            }
        }
    }
}
