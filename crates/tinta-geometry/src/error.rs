//! The errors that this library returns, one sentence each.
//!
//! A message names the file, option or driver, states the problem and says how to solve it. The library returns errors and
//! never prints or exits; `main` prints them and exits with code 2.
//!
//! ```
//! let error = tinta_geometry::load("nowhere.obj", &tinta_geometry::LoadOptions::default()).map(drop).unwrap_err();
//! assert_eq!(error.to_string(), "nowhere.obj: there is no such file; check the name");
//! assert_eq!(error.kind(), "model");
//! assert!(error.is_missing_file());
//! ```

use std::io;
use std::path::PathBuf;

/// The result of a fallible function of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a text cannot be parsed: describes the expected form, without the text itself.
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

/// The role of a faulty file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileKind {
    /// A model to draw.
    Model,
    /// A picture to read, such as a model's skin.
    Picture,
    /// A preset to read.
    Preset,
    /// Measured rows to read.
    Rows,
    /// A list of jobs, or a batch's records.
    Batch,
    /// Something to write.
    Output,
}

/// Why tinta failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be read, has the wrong content, or cannot be written.
    #[error("{}{}: {problem}", path.display(), line.map(|line| format!(": line {line}")).unwrap_or_default())]
    File {
        /// The file's role.
        kind: FileKind,
        /// The file as the user named it; `-` for standard output, `builtin:…` for a built-in model.
        path: PathBuf,
        /// The line at fault, 1-based, where the format has lines and the reader knows it.
        line: Option<u64>,
        /// The problem and its solution.
        problem: String,
        /// The system's error, if any; `problem` repeats it.
        #[source]
        cause: Option<io::Error>,
    },
    /// A model has defects and `--strict` is set.
    #[error("{}: {defects}; repair the model, or leave out --strict to draw it all the same", path.display())]
    Strict {
        /// The file as the user named it.
        path: PathBuf,
        /// The defects with their counts, in words.
        defects: String,
    },
    /// A setting is invalid.
    #[error("{name}{}: {problem}", value.as_ref().map(|value| format!(" {value}")).unwrap_or_default())]
    Setting {
        /// The setting's name, without dashes: a key of presets and jobs, and with dashes an option.
        name: String,
        /// Its value, as a user writes it; `None` if the value does not matter or is too long to show.
        value: Option<String>,
        /// The problem and its solution.
        problem: String,
    },
    /// Settings are nonsense together.
    #[error("{}: {problem}", in_a_row(names))]
    Settings {
        /// Their names, without dashes.
        names: Vec<String>,
        /// The problem and its solution.
        problem: String,
    },
    /// Computed exact lines cannot be written: a fault of this library.
    #[error("{problem}")]
    Lines {
        /// The problem and its solution.
        problem: String,
    },
    /// A text cannot be parsed as the expected type.
    #[error(transparent)]
    Text(#[from] ParseError),
    /// The command line is not understood.
    #[error("{problem}{}", if problem.ends_with('?') { "" } else { "; see --help" })]
    CommandLine {
        /// The problem.
        problem: String,
    },
    /// Another run is at work on the same slice of a batch.
    #[error("{}: another run is working on this; wait until it ends, or take another --slice", path.display())]
    Busy {
        /// The slice's file.
        path: PathBuf,
    },
    /// The caller cancelled the work.
    #[error("the drawing was cancelled; ask for it again")]
    Cancelled,
    /// The work exceeded its time limit.
    #[error("not done within {seconds} s; give it more time, or ask for less")]
    OutOfTime {
        /// The time limit, seconds.
        seconds: f64,
    },
    /// Every attempt to create an OpenGL 2.1 context failed.
    #[error(
        "no OpenGL 2.1 context could be made (tried {}); {INSTALL}",
        attempts.join("; ")
    )]
    NoContext {
        /// Each attempt and why it failed.
        attempts: Vec<String>,
    },
    /// No window can be opened.
    #[error(
        "no window can be opened ({reason}); start tinta view where DISPLAY or WAYLAND_DISPLAY names a display with OpenGL, or draw without one: tinta render"
    )]
    NoWindow {
        /// The attempt and why it failed.
        reason: String,
    },
    /// The picture is larger than the context can draw.
    #[error(
        "size {width}x{height}: the largest picture {renderer} can draw is {limit_width}x{limit_height}; ask for a smaller one, or see `tinta info` for a --backend that draws larger ones"
    )]
    PictureTooLarge {
        /// Requested width, pixels.
        width: u32,
        /// Requested height, pixels.
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
        /// The problem: a `Flaw` of tinta's plans.
        #[source]
        flaw: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The driver refused one of our shaders.
    #[error("glsl/{path}: the driver rejects this shader ({log}); another driver may accept it: see `tinta info`")]
    Shader {
        /// The shader, or the shaders linked together, below `glsl/`.
        path: String,
        /// The driver's log, on one line.
        log: String,
    },
    /// A pixel cannot be recomputed at a statement of a shader.
    #[error("{path}, line {line}: {problem}")]
    Statement {
        /// The shader's file; a built-in one begins with `glsl/`.
        path: String,
        /// The line, from 1.
        line: u32,
        /// The problem with its solution.
        problem: String,
    },
    /// GL reported an error after a plan, or lost its data.
    #[error("the GL driver failed in {during} ({what}); try another --backend, or a smaller --size")]
    Gl {
        /// The pass or call.
        during: String,
        /// The GL error by name.
        what: String,
    },
    /// The driver has taken the GL context away, for example after a device hang or a driver update.
    #[error(
        "the GL context was lost in {during} ({what}): the driver reset its device; draw again, and if that fails too, \
         try another --backend or a smaller --size"
    )]
    ContextLost {
        /// The pass or call.
        during: String,
        /// GL's name for the evidence of the loss.
        what: String,
    },
}

/// The advice of [`Error::NoContext`], by system.
const INSTALL: &str = if cfg!(windows) {
    "install your graphics card's driver, or Mesa's opengl32.dll beside tinta.exe"
} else if cfg!(target_os = "macos") {
    "log in where macOS has a screen"
} else {
    "install Mesa's software renderer, on Debian: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri"
};

/// Joins names for a sentence: `a`, `a and b`, `a, b and c`.
fn in_a_row(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

impl Error {
    /// Returns the kind of error in one word, for records.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::File { .. } if self.is_disk_full() => "disk-full",
            Self::File { kind, .. } => match kind {
                FileKind::Model => "model",
                FileKind::Picture => "picture",
                FileKind::Preset => "preset",
                FileKind::Rows => "rows",
                FileKind::Batch => "batch",
                FileKind::Output => "output",
            },
            Self::Strict { .. } => "strict",
            Self::Setting { .. } | Self::Settings { .. } => "setting",
            Self::Lines { .. } => "lines",
            Self::CommandLine { .. } => "command-line",
            Self::Text(_) => "text",
            Self::Busy { .. } => "busy",
            Self::Cancelled => "cancelled",
            Self::OutOfTime { .. } => "out-of-time",
            Self::NoContext { .. } => "no-context",
            Self::NoWindow { .. } => "no-window",
            Self::PictureTooLarge { .. } => "picture-too-large",
            Self::Plan { .. } => "plan",
            Self::Shader { .. } | Self::Statement { .. } => "shader",
            Self::Gl { .. } => "gl",
            Self::ContextLost { .. } => "context-lost",
        }
    }

    /// Creates an error for a file, from its role, its name and the problem with its solution.
    pub fn file(kind: FileKind, path: impl Into<PathBuf>, problem: impl Into<String>) -> Self {
        Self::File { kind, path: path.into(), line: None, problem: problem.into(), cause: None }
    }

    /// Creates an error for a model.
    pub fn model(path: impl Into<PathBuf>, problem: impl Into<String>) -> Self {
        Self::file(FileKind::Model, path, problem)
    }

    /// Creates an error for a picture to read.
    pub fn picture(path: impl Into<PathBuf>, problem: impl Into<String>) -> Self {
        Self::file(FileKind::Picture, path, problem)
    }

    /// Creates an error for an output that cannot be written.
    pub fn output(path: impl Into<PathBuf>, problem: impl Into<String>) -> Self {
        Self::file(FileKind::Output, path, problem)
    }

    /// Adds the line of the file, 1-based; other errors stay unchanged.
    #[must_use]
    pub fn at(mut self, number: impl Into<Option<u64>>) -> Self {
        if let Self::File { line, .. } = &mut self {
            *line = number.into();
        }
        self
    }

    /// Adds the system's error, whose kind `io_kind` returns; other errors stay unchanged.
    #[must_use]
    pub fn because(mut self, error: &io::Error) -> Self {
        if let Self::File { cause, .. } = &mut self {
            *cause = Some(error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error));
        }
        self
    }

    /// Returns the kind of the system's error, for a file with one.
    fn io_kind(&self) -> Option<io::ErrorKind> {
        match self {
            Self::File { cause, .. } => cause.as_ref().map(io::Error::kind),
            _ => None,
        }
    }

    /// Whether a file is missing, rather than unreadable or damaged.
    pub fn is_missing_file(&self) -> bool {
        self.io_kind() == Some(io::ErrorKind::NotFound)
    }

    /// Whether an output cannot be written because the disk, or the user's share of it, is full.
    pub(crate) fn is_disk_full(&self) -> bool {
        matches!(self.io_kind(), Some(io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded))
    }

    /// Creates an error for a setting, whatever its value.
    pub fn setting(name: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), value: None, problem: problem.into() }
    }

    /// Creates an error for a setting's value.
    pub fn value(name: impl Into<String>, value: impl ToString, problem: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), value: Some(value.to_string()), problem: problem.into() }
    }

    /// Settings are nonsense together.
    pub fn settings(names: &[&str], problem: impl Into<String>) -> Self {
        Self::Settings { names: names.iter().map(|name| (*name).to_owned()).collect(), problem: problem.into() }
    }

    /// Returns the sentence for a command line, with the settings at fault as options: `--tones 4`. The error's own text names them
    /// without dashes; the options that it advises have dashes in both.
    pub fn with_dashes(&self) -> String {
        match self {
            Self::Setting { name, .. } if name.len() == 1 => format!("-{self}"),
            Self::Setting { .. } | Self::PictureTooLarge { .. } => format!("--{self}"),
            Self::Settings { names, problem } => {
                format!("{}: {problem}", in_a_row(&names.iter().map(|name| format!("--{name}")).collect::<Vec<_>>()))
            }
            _ => self.to_string(),
        }
    }

    /// Creates a GL error.
    pub fn gl(during: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Gl { during: during.into(), what: what.into() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_missing_is_told_from_one_that_is_wrong() {
        use std::error::Error as _;
        let missing = Error::model("a.obj", "there is none").because(&io::ErrorKind::NotFound.into());
        let wrong = Error::model("a.obj", "it is damaged").at(7);
        assert_eq!(
            (missing.to_string(), wrong.to_string()),
            ("a.obj: there is none".into(), "a.obj: line 7: it is damaged".into())
        );
        assert!(missing.is_missing_file() && missing.source().is_some() && missing.kind() == "model");
        assert!(!wrong.is_missing_file() && wrong.source().is_none() && wrong.kind() == "model");
        let full = Error::output("a.png", "no room").because(&io::ErrorKind::StorageFull.into());
        assert!(full.is_disk_full() && full.kind() == "disk-full" && Error::Cancelled.io_kind().is_none());
    }

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
                 for a --backend that draws larger ones",
                "--size 9000x10: the largest picture Voodoo 2 can draw is 4096x4096; ask for a smaller one, or see `tinta info` \
                 for a --backend that draws larger ones",
            ),
            (
                strict,
                "a.obj: 2 empty faces; repair the model, or leave out --strict to draw it all the same",
                "a.obj: 2 empty faces; repair the model, or leave out --strict to draw it all the same",
            ),
            (
                Error::gl("drawing", "GL_SIZE"),
                "the GL driver failed in drawing (GL_SIZE); try another --backend, or a smaller --size",
                "the GL driver failed in drawing (GL_SIZE); try another --backend, or a smaller --size",
            ),
            (
                lost,
                "the GL context was lost in drawing (GL_OUT_OF_MEMORY): the driver reset its device; draw again, and \
                 if that fails too, try another --backend or a smaller --size",
                "the GL context was lost in drawing (GL_OUT_OF_MEMORY): the driver reset its device; draw again, and \
                 if that fails too, try another --backend or a smaller --size",
            ),
        ] {
            assert_eq!((error.to_string(), error.with_dashes()), (plain.to_owned(), dashed.to_owned()));
        }
    }
}
