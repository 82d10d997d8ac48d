//! A journal entry: the result of a job, as far as its files do not tell it.

use super::job::Job;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Why a job failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// [`crate::Error::kind`], `check` for a check that found a difference, `crash` for a worker that ended.
    pub kind: String,
    /// The command's error; paths in the batch's folder are relative to it.
    pub problem: String,
}

/// The result of a job.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Outcome {
    /// Why it failed; `None` if its outputs are there, whole.
    pub error: Option<Failure>,
    /// Remarks of the command, a sentence each.
    pub remarks: Vec<String>,
    /// The command's standard output: a record where the job has `json`.
    pub printed: Option<String>,
    /// How often it was tried: a second time where the GL context was lost or the worker ended.
    pub tries: u32,
}

impl Outcome {
    /// The outcome of a job that failed for this reason.
    pub(crate) fn failed(kind: &str, problem: impl Into<String>) -> Self {
        Self { error: Some(Failure { kind: kind.to_owned(), problem: problem.into() }), ..Self::default() }
    }
}

/// A job and its result: a line of a slice's file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The job's line of the list: a line that has been changed since is another job.
    pub job: BTreeMap<String, Value>,
    /// Its result.
    #[serde(flatten)]
    pub outcome: Outcome,
}

impl Entry {
    /// Makes the entry of a job.
    pub(crate) fn new(job: &Job, outcome: Outcome) -> Self {
        // A job's text is JSON.
        Self { job: serde_json::from_str(&job.json).unwrap_or_default(), outcome }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_is_the_line_and_its_result() {
        let job = Job::parse(br#"{"output": "a.png", "id": 7}"#).unwrap();
        let entry = Entry::new(&job, Outcome::failed("model", "no"));
        let text = serde_json::to_string(&entry).unwrap();
        assert!(
            text.starts_with(r#"{"job":{"id":7,"output":"a.png"},"error":{"kind":"model","problem":"no"}"#),
            "{text}"
        );
        assert_eq!(serde_json::from_str::<Entry>(&text).unwrap(), entry);
    }
}
