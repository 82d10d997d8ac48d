//! A picture's recipe: all that is needed to make it again, carried in the picture itself.
//!
//! PNG stores it in a `tEXt` chunk, SVG in an element of `<metadata>`; both hold the same JSON in ASCII. It contains neither a
//! date nor the output path: the same drawing is the same bytes.
//!
//! ```
//! use tinta::Recipe;
//!
//! let recipe = Recipe {
//!     version: "0.1.0".to_owned(),
//!     command: "render".to_owned(),
//!     style: "inking".to_owned(),
//!     size: [64, 64],
//!     models: vec!["my cow.obj".to_owned()],
//!     options: Default::default(),
//!     files: Vec::new(),
//!     gl: None,
//! };
//! assert!(recipe.command_line("cow.png").contains("'my cow.obj'"), "as a shell takes it");
//! ```

use crate::error::{Error, FileKind, Result};
use crate::files::{Failure, shown};
use crate::gl::ContextInfo;
use crate::markup::{RECIPE_BEGIN, RECIPE_END};
use crate::mesh::LoadOptions;
use crate::picture::{Note, png_text};
use crate::scene::{Scene, SceneSettings};
use crate::settings::{HasSettings, OptionValue, Options};
use crate::shell;
use crate::styles::Style;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The keyword of the PNG chunk.
pub const KEYWORD: &str = "tinta-recipe";

/// The longest recipe written or read, bytes of JSON.
pub(crate) const LARGEST_BYTES: usize = 256 << 10;

/// Options that a recipe alone cannot grant, and their purposes.
const NOT_GRANTED: [(&str, &str); 2] =
    [("allow-external", "for files outside its model's folder"), ("glsl", "for shaders that come with it")];

/// How much of an SVG is searched: its metadata is near its beginning.
const HEAD_BYTES: u64 = 2 << 20;

/// Everything needed to make a picture again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Recipe {
    /// tinta's version.
    pub version: String,
    /// The command: `render`.
    pub command: String,
    /// The style's name, given or by default.
    pub style: String,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The models as the user named them.
    pub models: Vec<String>,
    /// Every option given, by its long name; the others are the version's defaults.
    pub options: Options,
    /// The files read: models, their materials, pictures that were drawn with.
    pub files: Vec<FileRecord>,
    /// The driver; `None` for lines, which need none.
    pub gl: Option<Driver>,
}

/// A file's state when it was read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// As named by the user or a model.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, hexadecimal.
    pub sha256: String,
}

/// Who drew.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Driver {
    /// `egl`, `wgl`, `osmesa`, …
    pub backend: String,
    /// The library, and the device if there are several.
    pub device: String,
    /// GL_VENDOR
    pub vendor: String,
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION
    pub version: String,
}

impl Driver {
    /// A context's.
    pub fn new(context: &ContextInfo) -> Self {
        Self {
            backend: context.backend.to_owned(),
            device: context.device.clone(),
            vendor: context.vendor.clone(),
            renderer: context.renderer.clone(),
            version: context.version.clone(),
        }
    }
}

impl FileRecord {
    /// Reads the file through.
    ///
    /// # Errors
    ///
    /// Reads a file's record.
    pub fn of(path: &Path) -> std::io::Result<Self> {
        Self::of_reader(&path.to_string_lossy(), File::open(path)?)
    }

    /// The record of bytes already read from `path`.
    pub fn of_bytes(path: &str, bytes: &[u8]) -> Self {
        let sha256 = in_hexadecimal(Sha256::digest(bytes).as_slice());
        Self { path: path.to_owned(), bytes: bytes.len() as u64, sha256 }
    }

    fn of_reader(path: &str, mut from: impl Read) -> std::io::Result<Self> {
        let (mut hash, mut bytes, mut buffer) = (Sha256::new(), 0, vec![0; 1 << 16]);
        loop {
            match from.read(&mut buffer)? {
                0 => break,
                count => {
                    hash.update(&buffer[..count]);
                    bytes += count as u64;
                }
            }
        }
        Ok(Self { path: path.to_owned(), bytes, sha256: in_hexadecimal(hash.finalize().as_slice()) })
    }
}

/// Bytes as hexadecimal digits.
fn in_hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The picture files that a style was given.
fn files_of(style: &Style) -> Vec<PathBuf> {
    match style {
        Style::Inking(inking) => inking.ramp.path.iter().cloned().collect(),
        Style::Charcoal(charcoal) | Style::Sand(charcoal) => {
            let sources = [&charcoal.cet, &charcoal.noise_texture, &charcoal.paper];
            sources.into_iter().filter_map(|source| source.path()).map(Path::to_path_buf).collect()
        }
        _ => Vec::new(),
    }
}

/// Whether a style draws with the pictures on the models.
fn draws_with_textures(style: &Style, scene: &Scene) -> bool {
    match style {
        _ if scene.has_textured_surfaces() => true,
        Style::Inking(inking) => inking.has_texture,
        Style::Sand(_) => true,
        _ => false,
    }
}

/// Returns the files that a picture was made from, each once: the models, the files they refer to, and the files of the style, if
/// one drew the picture. `scene` begins with the models; built-in models are not files.
pub(crate) fn files_read(models: &[String], beside: &[PathBuf], scene: &Scene, style: Option<&Style>) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> =
        models.iter().filter(|model| !model.starts_with("builtin:")).map(PathBuf::from).collect();
    paths.extend(beside.iter().cloned());
    if let Some(style) = style {
        if draws_with_textures(style, scene) {
            let objects = scene.objects.iter().take(models.len());
            let materials = objects.flat_map(|object| &object.mesh.materials);
            paths.extend(materials.filter_map(|material| material.texture.clone()));
        }
        paths.extend(files_of(style));
    }
    let mut seen = std::collections::HashSet::new();
    paths.retain(|path| seen.insert(path.clone()));
    paths
}

impl Recipe {
    /// Says which of its options only the user can grant, unless given anew: a recipe may come from anyone.
    pub fn not_granted(&self, given: &Options) -> Option<String> {
        let is_refused = |name: &str| self.options.contains_key(name) && !given.contains_key(name);
        let (name, what) = NOT_GRANTED.iter().find(|(name, _)| is_refused(name))?;
        Some(format!("its recipe has --{name}, {what}; give that option yourself"))
    }

    /// The recipe as ASCII JSON on one line; `None` when it is longer than `LARGEST_BYTES`.
    pub fn json(&self) -> Option<String> {
        let text = serde_json::to_string(self).ok()?;
        let mut ascii = String::with_capacity(text.len());
        let mut units = [0; 2];
        for letter in text.chars() {
            // Outside of texts JSON is ASCII, and in them every letter may be written by its number.
            match letter {
                ' '..='~' => ascii.push(letter),
                letter => letter.encode_utf16(&mut units).iter().for_each(|unit| ascii += &format!("\\u{unit:04x}")),
            }
        }
        (ascii.len() <= LARGEST_BYTES).then_some(ascii)
    }

    /// The recipe as a PNG carries it; `None` as [`Recipe::json`].
    pub fn note(&self) -> Option<Note> {
        self.json().map(|text| Note { keyword: KEYWORD, text })
    }

    /// Finds the recipe in a PNG or SVG file.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when the file cannot be read, is of another kind, or has no valid recipe.
    pub fn read(path: &Path) -> Result<Self> {
        let failed = |problem: String| Error::picture(path, problem);
        let cannot_read =
            |error: std::io::Error| Failure::System(error).into_error(FileKind::Picture, path, "a picture");
        // Only files: a pipe or device would never end.
        if !path.metadata().map_err(cannot_read)?.is_file() {
            return Err(failed("this is not a regular file; name a picture".to_owned()));
        }
        let mut head = Vec::new();
        File::open(path).and_then(|file| file.take(HEAD_BYTES).read_to_end(&mut head)).map_err(cannot_read)?;
        Self::in_bytes(&head).map_err(failed)
    }

    /// Finds the recipe in a picture's bytes; `name` is its name in errors.
    ///
    /// # Errors
    ///
    /// [`Error::File`] when it is of another kind, or has no valid recipe.
    pub fn of_bytes(bytes: &[u8], name: &str) -> Result<Self> {
        let head = &bytes[..bytes.len().min(HEAD_BYTES as usize)];
        Self::in_bytes(head).map_err(|problem| Error::picture(Path::new(name), problem))
    }

    /// Finds the recipe at the beginning of a PNG or SVG; the error is a sentence without the file's name.
    fn in_bytes(head: &[u8]) -> std::result::Result<Self, String> {
        let json = match png_text::is_png(head) {
            true => png_text::find(head, KEYWORD)?,
            false => in_svg(head)?,
        };
        let none = "it carries no recipe; single .png and .svg pictures that tinta draws without --no-recipe do";
        let json = json.ok_or_else(|| none.to_owned())?;
        if json.len() > LARGEST_BYTES {
            return Err(format!("its recipe is longer than {LARGEST_BYTES} bytes, the limit for one"));
        }
        let recipe: Self = serde_json::from_str(&json).map_err(|error| {
            format!("its recipe cannot be understood ({}); draw it again with tinta render", shown(&error.to_string()))
        })?;
        Ok(recipe)
    }

    /// Returns a shell command line that makes the picture.
    pub fn command_line(&self, output: &str) -> String {
        let mut words = vec![self.command.clone()];
        // A name that begins with a dash would be taken for an option.
        let is_plain = |model: &String| !model.starts_with('-');
        words.extend(self.models.iter().filter(|model| is_plain(model)).cloned());
        words.extend(["-o".to_owned(), output.to_owned()]);
        words.extend(self.options.iter().flat_map(|(name, value)| option_words(name, value)));
        let (plain, others): (Vec<_>, Vec<_>) = self.models.iter().partition(|model| is_plain(model));
        if plain.len() < self.models.len() {
            words.push("--".to_owned());
            words.extend(others.into_iter().cloned());
        }
        shell::command_line(words.into_iter())
    }

    /// Returns one sentence for each difference from `self`: version, files, driver, size.
    pub fn differences(&self, now: &Self) -> Vec<String> {
        let mut all = Vec::new();
        let mut say = |what: &str, then: &dyn std::fmt::Display, now: &dyn std::fmt::Display| {
            all.push(format!("{what} was {then} and is {now} now"));
        };
        if self.version != now.version {
            say("tinta's version", &self.version, &now.version);
        }
        if self.files.len() != now.files.len() {
            say("the number of files read", &self.files.len(), &now.files.len());
        }
        for (then, now) in self.files.iter().zip(&now.files) {
            if (then.bytes, &then.sha256) != (now.bytes, &now.sha256) {
                let content = |file: &FileRecord| {
                    format!("{} bytes with SHA-256 {}…", file.bytes, file.sha256.chars().take(16).collect::<String>())
                };
                say(&now.path, &content(then), &content(now));
            }
        }
        let none = || Driver {
            backend: "none".to_owned(),
            device: "none".to_owned(),
            vendor: "none".to_owned(),
            renderer: "none".to_owned(),
            version: "none".to_owned(),
        };
        let (then, is) = (self.gl.clone().unwrap_or_else(none), now.gl.clone().unwrap_or_else(none));
        for (what, then, now) in [
            ("the backend", &then.backend, &is.backend),
            ("the device", &then.device, &is.device),
            ("the driver's vendor", &then.vendor, &is.vendor),
            ("the driver", &then.renderer, &is.renderer),
            ("the driver's version", &then.version, &is.version),
        ] {
            if then != now {
                say(what, then, now);
            }
        }
        if self.size != now.size {
            let text = |[width, height]: [u32; 2]| format!("{width}x{height}");
            say("the size", &text(self.size), &text(now.size));
        }
        all
    }
}

/// The same as one word: `--page=margin=3mm`.
pub fn option_word(name: &str, value: &OptionValue) -> Option<String> {
    let words = option_words(name, value);
    (!words.is_empty()).then(|| words.join("="))
}

/// The words that give an option on the command line; empty for a switch that is off.
pub fn option_words(name: &str, value: &OptionValue) -> Vec<String> {
    fn group<T: HasSettings>(name: &str) -> Option<&'static str> {
        T::table().settings.iter().find(|setting| setting.name == name)?.group
    }
    let group = group::<Style>(name).or_else(|| group::<SceneSettings>(name)).or_else(|| group::<LoadOptions>(name));
    match (value, group) {
        (OptionValue::Switch(false), _) => Vec::new(),
        (OptionValue::Switch(true), Some(group)) => vec![format!("--{group}"), name.to_owned()],
        (OptionValue::Switch(true), None) => vec![format!("--{name}")],
        (OptionValue::Texts(values), _) => option_words(name, &OptionValue::Text(values.join(","))),
        (OptionValue::Text(value), Some(group)) => vec![format!("--{group}"), format!("{name}={value}")],
        // As a separate word it would be parsed as an option.
        (OptionValue::Text(value), None) if value.starts_with('-') => vec![format!("--{name}={value}")],
        (OptionValue::Text(value), None) => vec![format!("--{name}"), value.clone()],
    }
}

fn in_svg(head: &[u8]) -> std::result::Result<Option<String>, String> {
    let text = String::from_utf8_lossy(head);
    if !text.contains("<svg") {
        return Err("this is neither PNG nor SVG, and other files carry no recipe".to_owned());
    }
    let inner = text.split_once(RECIPE_BEGIN).and_then(|(_, rest)| rest.split_once(RECIPE_END));
    Ok(inner.map(|(json, _)| {
        let plain = [("&quot;", "\""), ("&lt;", "<"), ("&gt;", ">"), ("&#39;", "'"), ("&amp;", "&")];
        plain.iter().fold(json.to_owned(), |text, (written, letter)| text.replace(written, letter))
    }))
}

#[cfg(test)]
mod tests;
