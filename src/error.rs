//! Everything that can go wrong with what a user gave us, one sentence each.
//!
//! A message names the file, option or driver concerned, says what is wrong and what to do about it.
//! The library returns these and never prints or exits; `main` prints them and exits with code 2.
//!
//! ```
//! let error = tinta::load("nowhere.obj", &tinta::LoadOptions::default()).map(drop).unwrap_err();
//! assert_eq!(error.to_string(), "nowhere.obj: there is no such file; check the name");
//! assert_eq!(error.kind(), "model");
//! ```

/// The result of anything in this crate that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a text is no value of a type: what it would have to be, without the text itself.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ParseError(pub String);

impl From<String> for ParseError {
    fn from(problem: String) -> Self {
        Self(problem)
    }
}

impl From<ParseError> for String {
    fn from(ParseError(problem): ParseError) -> Self {
        problem
    }
}

/// Why tinta could not do what was asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A model file could not be read or holds nothing to draw.
    #[error("{path}{}: {problem}", line.map(|line| format!(": line {line}")).unwrap_or_default())]
    Model {
        /// The file as the user named it.
        path: String,
        /// The line at fault, 1-based, where the format has lines and the reader knows it.
        line: Option<u64>,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A picture file, such as a model's skin, could not be read.
    #[error("{path}: {problem}")]
    Picture {
        /// The file as the user or a model named it.
        path: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A model has defects and `--strict` was asked for.
    #[error("{path}: {defects}; mend the model, or leave out strict to draw it without them")]
    Strict {
        /// The file as the user named it.
        path: String,
        /// The defects with their counts, in words.
        defects: String,
    },
    /// A setting is nonsense.
    #[error("{name}{}: {problem}", value.as_ref().map(|value| format!(" {value}")).unwrap_or_default())]
    Setting {
        /// The setting's name, without dashes: a key of presets and jobs, and with dashes an option.
        name: String,
        /// Its value, as a user writes it; `None` where it is no matter of the value, or is too long to say.
        value: Option<String>,
        /// What is wrong and what to do.
        problem: String,
    },
    /// Settings are nonsense together.
    #[error("{}: {problem}", in_a_row(names))]
    Settings {
        /// Their names, without dashes.
        names: Vec<String>,
        /// What is wrong and what to do.
        problem: String,
    },
    /// Exact lines that were computed cannot be written: a fault of this library.
    #[error("{problem}")]
    Lines {
        /// What is wrong and what to do.
        problem: String,
    },
    /// A text is no value of the type it was to be read as.
    #[error(transparent)]
    Text(#[from] ParseError),
    /// A preset cannot be read, or sets what cannot be set so.
    #[error("{path}{}: {problem}", line.map(|line| format!(": line {line}")).unwrap_or_default())]
    Preset {
        /// The file as the user named it, or `paper:…`.
        path: String,
        /// The line at fault, 1-based; `None` for the preset as a whole.
        line: Option<u64>,
        /// The option by its long name, what is wrong and what to do.
        problem: String,
    },
    /// The command line is not understood.
    #[error("{problem}; see --help")]
    CommandLine {
        /// What is wrong with it.
        problem: String,
    },
    /// The output file cannot be written.
    #[error("{path}: {problem}")]
    Output {
        /// The file as the user named it.
        path: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// The output file cannot be written because the disk, or the user's share of it, is full.
    #[error("{path}: {problem}")]
    DiskFull {
        /// The file as the user named it.
        path: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// Measured rows cannot be read.
    #[error("{path}{}: {problem}", line.map(|line| format!(": line {line}")).unwrap_or_default())]
    Rows {
        /// The file as the user named it.
        path: String,
        /// The line at fault, 1-based; `None` for the file as a whole.
        line: Option<u64>,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A list of jobs, or what was written down of them, cannot be read.
    #[error("{path}{}: {problem}", line.map(|line| format!(": line {line}")).unwrap_or_default())]
    Batch {
        /// The file as the user named it.
        path: String,
        /// The line at fault, 1-based; `None` for the file as a whole.
        line: Option<u64>,
        /// What is wrong and what to do.
        problem: String,
    },
    /// Another run is at work on the same slice of a batch.
    #[error("{path}: another run is at work on this; wait for its end, or take another slice")]
    Busy {
        /// The slice's file.
        path: String,
    },
    /// Nobody waits for the work any more.
    #[error("the work was given up because nobody waits for it any more; ask for it again")]
    Cancelled,
    /// No way to an OpenGL 2.1 context worked.
    #[error(
        "no OpenGL 2.1 context could be made (tried {}); install Mesa's software renderer, on Debian: apt-get install libegl1 libgl1-mesa-dri libosmesa6",
        attempts.join("; ")
    )]
    NoContext {
        /// What was tried and why each attempt failed.
        attempts: Vec<String>,
    },
    /// There is no window to show a model in.
    #[error(
        "no window can be opened ({reason}); start tinta view where DISPLAY or WAYLAND_DISPLAY names a display with OpenGL, or draw without one: tinta render"
    )]
    NoWindow {
        /// What was tried and why it failed.
        reason: String,
    },
    /// The picture is larger than the context can draw.
    #[error(
        "size {width}x{height}: the largest picture {renderer} can draw is {limit_width}x{limit_height}; ask for a smaller one, or see `tinta info` for a backend that draws larger ones"
    )]
    PictureTooLarge {
        /// Width asked for, pixels.
        width: u32,
        /// Height asked for, pixels.
        height: u32,
        /// Largest width, pixels.
        limit_width: u32,
        /// Largest height, pixels.
        limit_height: u32,
        /// GL_RENDERER of the context.
        renderer: String,
    },
    /// A plan cannot be drawn for this scene.
    #[error("the plan cannot be drawn: {flaw}")]
    Plan {
        /// What is wrong with it: a [`Flaw`](crate::plan::Flaw).
        #[source]
        flaw: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The driver refused one of our shaders.
    #[error("glsl/{path}: the driver refuses this shader ({log}); another driver may take it: see `tinta info`")]
    Shader {
        /// The shader, or the shaders linked together, below `glsl/`.
        path: String,
        /// The driver's log, on one line.
        log: String,
    },
    /// GL reported an error after a plan, or lost what it was given.
    #[error("the GL driver failed in {during} ({what}); try the backend osmesa, or a smaller size")]
    Gl {
        /// The pass or call.
        during: String,
        /// The GL error by name.
        what: String,
    },
    /// The driver has taken the GL context away, as it does when a device hangs or its driver is replaced.
    #[error(
        "the GL context was lost in {during} ({what}): the driver has reset its device; draw again, and if that fails too, try the backend osmesa or a smaller size"
    )]
    ContextLost {
        /// The pass or call.
        during: String,
        /// What said so, by GL's name.
        what: String,
    },
}

/// What [`Error::PictureTooLarge`] ends with.
const BACKEND_FOR_LARGER: &str = "a backend that draws larger ones";

/// What [`Error::Gl`] and [`Error::ContextLost`] advise.
const ANOTHER_BACKEND: &str = "the backend osmesa";

/// Names as a sentence has them: `a`, `a and b`, `a, b and c`.
fn in_a_row(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

impl Error {
    /// What kind of error this is, in a word: for records, where the sentence would say too much.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Model { .. } => "model",
            Self::Picture { .. } => "picture",
            Self::Strict { .. } => "strict",
            Self::Setting { .. } | Self::Settings { .. } => "setting",
            Self::Lines { .. } => "lines",
            Self::CommandLine { .. } => "command-line",
            Self::Text(_) => "text",
            Self::Preset { .. } => "preset",
            Self::Output { .. } => "output",
            Self::DiskFull { .. } => "disk-full",
            Self::Rows { .. } => "rows",
            Self::Batch { .. } => "batch",
            Self::Busy { .. } => "busy",
            Self::Cancelled => "cancelled",
            Self::NoContext { .. } => "no-context",
            Self::NoWindow { .. } => "no-window",
            Self::PictureTooLarge { .. } => "picture-too-large",
            Self::Plan { .. } => "plan",
            Self::Shader { .. } => "shader",
            Self::Gl { .. } => "gl",
            Self::ContextLost { .. } => "context-lost",
        }
    }

    /// Of an output that cannot be written for this cause: [`Error::DiskFull`] where that is it, [`Error::Output`] otherwise.
    pub fn output(path: impl Into<String>, cause: &std::io::Error, problem: impl Into<String>) -> Self {
        use std::io::ErrorKind::{QuotaExceeded, StorageFull};
        let (path, problem) = (path.into(), problem.into());
        match cause.kind() {
            StorageFull | QuotaExceeded => Self::DiskFull { path, problem },
            _ => Self::Output { path, problem },
        }
    }

    /// A model error without a line.
    pub(crate) fn model(path: &str, problem: impl Into<String>) -> Self {
        Self::Model { path: path.to_owned(), line: None, problem: problem.into() }
    }

    /// A picture error.
    pub(crate) fn picture(path: &std::path::Path, problem: impl Into<String>) -> Self {
        Self::Picture { path: path.display().to_string(), problem: problem.into() }
    }

    /// A setting is nonsense, whatever its value.
    pub fn setting(name: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), value: None, problem: problem.into() }
    }

    /// A setting's value is nonsense.
    pub fn value(name: impl Into<String>, value: impl ToString, problem: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), value: Some(value.to_string()), problem: problem.into() }
    }

    /// Settings are nonsense together.
    pub(crate) fn settings(names: &[&str], problem: impl Into<String>) -> Self {
        Self::Settings { names: names.iter().map(|name| (*name).to_owned()).collect(), problem: problem.into() }
    }

    /// The sentence for a command line, where settings are options: `--tones 4`. The error's own text has no dashes.
    pub fn with_dashes(&self) -> String {
        let sentence = self.to_string();
        let dash = |name: &str| if name.len() == 1 { format!("-{name}") } else { format!("--{name}") };
        match self {
            Self::Setting { name, .. } => sentence.replacen(name.as_str(), &dash(name), 1),
            Self::Settings { names, problem } => {
                format!("{}: {problem}", in_a_row(&names.iter().map(|name| dash(name)).collect::<Vec<_>>()))
            }
            Self::Strict { path, defects } => {
                format!("{path}: {defects}; mend the model, or leave out --strict to draw it without them")
            }
            Self::Busy { path } => {
                format!("{path}: another run is at work on this; wait for its end, or take another --slice")
            }
            Self::PictureTooLarge { .. } => {
                let sentence = sentence.replacen("size", "--size", 1);
                sentence
                    .strip_suffix(BACKEND_FOR_LARGER)
                    .map_or_else(|| sentence.clone(), |start| format!("{start}a --backend that draws larger ones"))
            }
            Self::Gl { .. } | Self::ContextLost { .. } => match sentence.rsplit_once(ANOTHER_BACKEND) {
                Some((start, end)) => format!("{start}--backend osmesa{}", end.replacen("size", "--size", 1)),
                None => sentence,
            },
            _ => sentence,
        }
    }

    /// A GL error.
    pub(crate) fn gl(during: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Gl { during: during.into(), what: what.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_command_line_speaks_of_dashes() {
        let too_large = Error::PictureTooLarge {
            width: 9000,
            height: 10,
            limit_width: 4096,
            limit_height: 4096,
            renderer: "Voodoo 2".to_owned(),
        };
        let strict = Error::Strict { path: "a.obj".into(), defects: "2 empty faces".to_owned() };
        let lost = Error::ContextLost { during: "drawing".to_owned(), what: "GL_OUT_OF_MEMORY".to_owned() };
        for (error, plain, dashed) in [
            (Error::value("tones", 4, "too many"), "tones 4: too many", "--tones 4: too many"),
            (Error::setting("o", "it is taken"), "o: it is taken", "-o: it is taken"),
            (
                Error::settings(&["fov", "near", "far"], "wrong"),
                "fov, near and far: wrong",
                "--fov, --near and --far: wrong",
            ),
            (
                too_large,
                "size 9000x10: the largest picture Voodoo 2 can draw is 4096x4096; ask for a smaller one, or see `tinta info` \
                 for a backend that draws larger ones",
                "--size 9000x10: the largest picture Voodoo 2 can draw is 4096x4096; ask for a smaller one, or see `tinta info` \
                 for a --backend that draws larger ones",
            ),
            (
                strict,
                "a.obj: 2 empty faces; mend the model, or leave out strict to draw it without them",
                "a.obj: 2 empty faces; mend the model, or leave out --strict to draw it without them",
            ),
            (
                Error::gl("drawing", "GL_SIZE"),
                "the GL driver failed in drawing (GL_SIZE); try the backend osmesa, or a smaller size",
                "the GL driver failed in drawing (GL_SIZE); try --backend osmesa, or a smaller --size",
            ),
            (
                lost,
                "the GL context was lost in drawing (GL_OUT_OF_MEMORY): the driver has reset its device; draw again, and if \
                 that fails too, try the backend osmesa or a smaller size",
                "the GL context was lost in drawing (GL_OUT_OF_MEMORY): the driver has reset its device; draw again, and if \
                 that fails too, try --backend osmesa or a smaller --size",
            ),
        ] {
            assert_eq!((error.to_string(), error.with_dashes()), (plain.to_owned(), dashed.to_owned()));
        }
    }
}
