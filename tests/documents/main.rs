//! The documents, licences and sources themselves. One binary, to link once.

mod adding_a_style;
mod corpus;
mod docs;
mod docs_run;
mod floors;
#[cfg(unix)]
mod installing;
#[cfg(unix)]
mod licence_texts;
mod licences;
mod readme;
mod reports;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod workflows;
