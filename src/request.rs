//! One requested drawing: models, how to read them, scene and camera, style, and output.
//!
//! Every door makes a [`Request`] of layers of options, each beating those below it, and hands it to a [`Session`]: the command
//! line, a batch, a recipe, the window, Python and the browser differ in where the options come from and where the drawing goes.
//!
//! ```
//! use tinta::request::{OptionLayer, Request};
//! use tinta::settings::{OptionValue, Options};
//! use tinta::preset::LOOKS;
//!
//! # fn main() -> tinta::Result<()> {
//! let given: Options = [("tones".to_owned(), OptionValue::text("2"))].into();
//! let (request, remarks) = Request::from_layers(&[OptionLayer::Look(LOOKS[0]), OptionLayer::Given(given)])?;
//! assert_eq!(request.style.name(), "ink");
//! assert_eq!(request.options["tones"], OptionValue::text("2"));
//! assert!(remarks.is_empty());
//! # Ok(())
//! # }
//! ```

mod around;
mod draw;
mod drawing;
mod emptiness;
mod format;
mod gone;
mod layers;
mod model_cache;
mod resolve;
mod session;

pub use around::{Around, LINES_AT_ONCE_MS};
pub use draw::{DrawnPicture, ReadModels, Times};
pub use drawing::{DrawingFile, DrawnLines};
pub use emptiness::empty_remark;
pub use format::WantedLines;
#[cfg(feature = "cli")]
pub(crate) use format::{endings_of_lines, is_drawn_into};
pub use layers::{OptionLayer, ignored_remark, layers};
#[cfg(feature = "cli")]
pub(crate) use layers::{is_of_camera, unknown};
pub use model_cache::{Model, ModelCache};
pub use resolve::Resolved;
pub use session::Session;

use crate::camera;
use crate::choice::Choice;
use crate::error::{Error, FileKind, Result};
use crate::gl::Backend;
use crate::glsl::BUILT_IN;
#[cfg(feature = "cli")]
use crate::lines::LIGHTS;
use crate::mesh::LoadOptions;
use crate::plan::prune::{Pruning, Rule};
use crate::recipe::{Driver, FileRecord, Recipe, files_read};
use crate::renderer::Renderer;
use crate::scene::{Scene, SceneSettings, Size};
#[cfg(feature = "cli")]
use crate::settings::Value as _;
use crate::settings::{HasSettings, Kind, OptionValue, Options, Setting, Table, names_of, under, within};
use crate::styles::{Show, Style, StyleName, is_of_lines_alone};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A requested drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Request {
    /// The models, as the user named them. Default empty.
    pub models: Vec<String>,
    /// How they are read.
    pub read: LoadOptions,
    /// How the models are arranged, the camera, and the picture's size.
    pub scene: SceneSettings,
    /// The style with its settings. Default three-pass as published.
    pub style: Style,
    /// The style's picture to draw. Default the finished one.
    pub show: Show,
    /// Whether the view's exact lines are drawn over the picture, in place of the style's own borders. Default no.
    pub exact_lines: bool,
    /// The ground below the models. Default nothing.
    pub ground: Ground,
    /// The views or frames to draw.
    pub animation: AnimationSettings,
    /// The way to OpenGL. Default the first that works.
    pub backend: Backend,
    /// A folder laid out like `glsl/`, whose shaders are drawn with instead of those built in. Default `None`.
    pub glsl: Option<String>,
    /// What to leave out of the published plan.
    pub pruning: PruneSettings,
    /// The drawing's title. Default the models' names without their folders.
    pub title: Option<String>,
    /// The options that the request was made from. Recipes and presets keep them.
    pub options: Options,
    /// Where options that come from a look or a file stand.
    pub(crate) sources: BTreeMap<String, Source>,
}

tinta_geometry::choices! {
    /// What models stand on.
    #[derive(Default)]
    pub enum Ground {
        /// Nothing.
        #[default]
        None = "none",
        /// A plane below the lowest point that shows the models' shadow alone.
        Shadow = "shadow",
        /// The shadow of models that stand, in a still picture; nothing below others.
        Auto = "auto",
    }
}

/// The source of an option.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    name: String,
    line: Option<u64>,
}

impl Source {
    fn refuse(&self, problem: String) -> Error {
        Error::file(FileKind::Preset, self.name.clone(), problem).at(self.line)
    }
}

/// The views of a turn, or the frames of a model, to draw.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AnimationSettings {
    /// Views of a full turn. Default `None`: one picture.
    pub turntable: Option<u32>,
    /// The prefix of the frames' names; an empty text selects all. Default `None`: one picture.
    pub animate: Option<String>,
    /// How long each is shown, milliseconds. Default 100 for an animated model; for a turn 2500 shared by all pictures, at most 200 each.
    pub frame_delay_ms: Option<u32>,
}

impl AnimationSettings {
    /// Whether one picture is drawn.
    pub fn is_still(&self) -> bool {
        self.turntable.is_none() && self.animate.is_none()
    }
}

/// What to leave out of a plan.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PruneSettings {
    /// Whether to prune nothing. Default no.
    pub is_full: bool,
    /// Rules to skip. Default none.
    pub keep: Vec<Rule>,
}

impl PruneSettings {
    /// The pruning for this renderer; `None` to prune nothing.
    pub(crate) fn pruning(&self, renderer: &Renderer) -> Option<Pruning> {
        (!self.is_full).then(|| Pruning { keep: self.keep.clone(), ..renderer.pruning() })
    }
}

impl HasSettings for Request {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<Request>> = LazyLock::new(|| Table {
            settings: settings(),
            defaults: StyleName::ALL.map(|(_, style)| Request::of_style(style)).into(),
        });
        &TABLE
    }
}

/// The heading of options for animations.
const ANIMATION: &str =
    "Animation, into FILE.gif, FILE.apng or numbered files such as frame-%04d.png; lines: frame-%04d.svg";

fn settings() -> Vec<Setting<Request>> {
    let style = Setting::of(
        "style",
        "STYLE",
        Kind::Choice(names_of::<StyleName>()),
        style_help(),
        |request: &Request| request.style.name().to_owned(),
        |request, text| {
            request.style = Style::named(gone::style_of(text)?);
            Ok(())
        },
    )
    .said("three-pass; into files of lines such as .dxf: lines")
    .common()
    .first();
    let show = Setting::field(
        "show",
        "PICTURE",
        "Picture to show: final, borders, tones; of three-pass, two-pass and mrt also normals, depth, map; of ink also map; of \
         charcoal and sand only final, diffuse, cem, cet, paper",
        |request: &mut Request| &mut request.show,
    );
    let exact_lines = Setting::flag(
        EXACT_LINES,
        "Draw exact lines over the picture; they replace the borders that --no-borders leaves out",
        |request: &Request| request.exact_lines,
        |request, is_on| request.exact_lines = is_on,
    )
    .labelled("exact lines")
    .common();
    let ground = Setting::field(
        "ground",
        "GROUND",
        "Ground below the models: none, shadow (the shadow that they cast on it, one grey area), or auto (a shadow for models that stand)",
        |request: &mut Request| &mut request.ground,
    );
    let title = Setting::open_field(
        "title",
        "TEXT",
        "the models' names",
        "Title of the drawing, in the file, and on a --sheet in a title block with a frame",
        |request: &mut Request| &mut request.title,
    )
    .like("BRACKET");
    let scene = || within(SceneSettings::settings(), |request: &mut Request| Some(&mut request.scene));
    let of_camera = |setting: &Setting<Request>| setting.heading == camera::HEADING;
    let read = within(LoadOptions::settings(), |request: &mut Request| Some(&mut request.read));
    let styles = within(crate::styles::settings(), |request: &mut Request| Some(&mut request.style));
    [style]
        .into_iter()
        .chain(scene().filter(|setting| !of_camera(setting)))
        .chain(scene().filter(of_camera))
        .chain(under("All styles", vec![show, exact_lines, ground, title]))
        .chain(styles)
        .chain(read)
        .chain(under(ANIMATION, of_animation()))
        .chain(under("Skipping work that cannot change the picture", of_pruning()))
        .chain(under("Running", vec![backend(), glsl()]))
        .collect()
}

/// The option of exact lines over a picture.
pub(crate) const EXACT_LINES: &str = "exact-lines";

/// The help of `--style`.
fn style_help() -> &'static str {
    static HELP: LazyLock<String> = LazyLock::new(|| format!("Style: {}", StyleName::list()));
    &HELP
}

/// The value that turns an option off.
const OFF: &str = "off";

fn of_animation() -> Vec<Setting<Request>> {
    vec![
        Setting::open_field(
            "turntable",
            "N",
            OFF,
            "Draw N views of a full turn around the models",
            |request: &mut Request| &mut request.animation.turntable,
        )
        .whole(1..=10_000)
        .range(1.0, 360.0, 0)
        .common(),
        Setting::open_field(
            "animate",
            "MOVEMENT",
            OFF,
            "Draw all frames of an animated model (MD2), or those of one movement, such as --animate=run",
            |request: &mut Request| &mut request.animation.animate,
        )
        .like("run")
        .standing_alone(),
        Setting::open_field(
            "frame-delay",
            "MS",
            "auto",
            "Time for which each picture is shown, in milliseconds",
            |request: &mut Request| &mut request.animation.frame_delay_ms,
        )
        .whole(20..=60_000)
        .range(1.0, 1000.0, 0)
        .said("100 for an animated model; for a turn 2500 shared by all pictures, at most 200 each"),
    ]
}

fn of_pruning() -> Vec<Setting<Request>> {
    let full = Setting::flag(
        "full",
        "Draw everything as published",
        |request: &Request| request.pruning.is_full,
        |request, is_on| request.pruning.is_full = is_on,
    )
    .said("off, work that cannot change the picture is skipped");
    static HELP: LazyLock<String> = LazyLock::new(|| {
        let rules = names_of::<Rule>().join(", ");
        format!("Work not to skip (docs/results/pruning.md explains each): {rules}")
    });
    let keep = Setting::of(
        "keep",
        "NAMES",
        Kind::Several(names_of::<Rule>()),
        &HELP,
        |request: &Request| match &request.pruning.keep[..] {
            [] => NONE.to_owned(),
            rules => rules.iter().map(|rule| rule.name()).collect::<Vec<_>>().join(","),
        },
        |request, text| {
            let rules = text.split(',').filter(|name| *name != NONE).map(Rule::of_name);
            request.pruning.keep = rules.collect::<std::result::Result<_, _>>()?;
            Ok(())
        },
    );
    vec![full, keep]
}

/// No rule.
const NONE: &str = "none";

/// The setting of the way to OpenGL.
fn backend() -> Setting<Request> {
    let help = "OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works)";
    Setting::field("backend", "BACKEND", help, |request: &mut Request| &mut request.backend)
}

/// The setting of a folder of shaders.
fn glsl() -> Setting<Request> {
    let help = "Draw with the shaders of this folder, laid out like glsl/, instead of the built-in ones; in the window, edits show at once";
    Setting::open_field("glsl", "DIR", "none", help, |request: &mut Request| &mut request.glsl)
}

impl Request {
    /// All settings at their defaults, in this style as published.
    pub fn of_style(style: StyleName) -> Self {
        Self { style: Style::named(style), ..Self::default() }
    }

    /// With these models.
    #[must_use]
    pub fn with_models(self, models: Vec<String>) -> Self {
        Self { models, ..self }
    }

    /// The title in a sheet's title block: one that is an option.
    pub(crate) fn title_block(&self) -> Option<&str> {
        self.title.as_deref().filter(|_| self.options.contains_key("title"))
    }

    /// The title of the drawing.
    pub fn title(&self) -> String {
        if let Some(title) = &self.title {
            return title.clone();
        }
        let names = self.models.iter().map(|model| match Path::new(model).file_name() {
            Some(name) => name.to_string_lossy(),
            None => model.into(),
        });
        names.collect::<Vec<_>>().join(", ")
    }

    /// The recipe of a drawing of this request in a scene that begins with its models. `beside` are the files read besides the
    /// models; `gl` is who drew, `None` for lines. `record` is given each file's path once; a file without a record, such as one
    /// that is gone since it was read, is left out, and drawing the recipe reports the difference. Only the request of
    /// [`Resolved`] names the view and the light that were chosen.
    pub fn recipe(
        &self,
        scene: &Scene,
        beside: &[PathBuf],
        gl: Option<Driver>,
        record: impl Fn(&Path) -> Option<FileRecord>,
    ) -> Recipe {
        let Size { width, height } = self.scene.size;
        let paths = files_read(&self.models, beside, scene, gl.as_ref().map(|_| &self.style));
        Recipe {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: "render".to_owned(),
            style: self.style.name().to_owned(),
            size: [width, height],
            models: self.models.clone(),
            options: self.kept_options(gl.is_some()),
            files: paths.iter().filter_map(|path| record(path)).collect(),
            gl,
        }
    }

    /// The options that a recipe keeps, of pixels or of lines.
    fn kept_options(&self, of_pixels: bool) -> Options {
        let mut options = self.options.clone();
        if self.style.style_name().draws_lines() {
            // A file's name does not ask for it.
            options.entry("style".to_owned()).or_insert_with(|| OptionValue::text(self.style.name()));
        }
        if of_pixels && self.contents(false).is_ok_and(|contents| contents.lines.is_none()) {
            // A picture without the exact lines that its look draws.
            options.retain(|option, _| !(self.is_of_look(option) && is_of_lines_alone(option)));
        }
        options
    }

    /// Whether a recipe has this request's options, and besides those only the light and the ground that drawing chooses. `None` where
    /// its view is either the one that suits the models, which drawing chooses, or another request's.
    #[cfg(feature = "cli")]
    pub(crate) fn is_kept_in(&self, recipe: &Recipe) -> Option<bool> {
        let mut options = self.kept_options(recipe.gl.is_some());
        let is_chosen = |light: &&OptionValue| LIGHTS.iter().any(|known| **light == OptionValue::text(known.text()));
        let chooses_light = self.style.far_tones().is_some_and(|(light, _)| light.known().is_none());
        let light = recipe.options.get("tone-light").filter(is_chosen).filter(|_| chooses_light);
        let ground = recipe.options.get("ground").filter(|_| self.ground == Ground::Auto);
        let chosen = [("tone-light", light), ("ground", ground)];
        options.extend(chosen.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?.clone()))));
        let view =
            recipe.options.get("view").filter(|view| self.is_of_look("view") && options.get("view") != Some(*view));
        options.extend(view.map(|view| ("view".to_owned(), view.clone())));
        if options == recipe.options { view.is_none().then_some(true) } else { Some(false) }
    }

    /// Whether the picture has no background.
    pub fn is_transparent(&self) -> bool {
        self.scene.background == crate::scene::Background::Transparent
    }

    /// Returns the same request in another style, with the options that apply to it.
    ///
    /// # Errors
    ///
    /// As [`Style::with_options`].
    pub fn in_style(&self, style: StyleName) -> Result<Self> {
        Ok(Self { style: Style::with_options(style, &self.options)?, ..self.clone() })
    }

    /// The style's name for messages: its look, or its own name.
    pub(crate) fn style_said(&self) -> String {
        match self.sources.get("style") {
            Some(source) if self.is_of_look("style") => source.name.clone(),
            _ => format!("style {}", self.style.name()),
        }
    }

    /// Whether a look gives this option.
    pub(crate) fn is_of_look(&self, option: &str) -> bool {
        self.sources.get(option).is_some_and(|source| source.name.starts_with("look "))
    }

    /// An error about an option that a look or a file gave, with its name and line.
    pub fn attributed(&self, error: Error) -> Error {
        let names = match &error {
            Error::Setting { name, .. } => std::slice::from_ref(name),
            Error::Settings { names, .. } => names,
            Error::Statement { .. } => return self.in_own_shader(error),
            _ => return error,
        };
        match names.iter().find_map(|name| self.sources.get(name)) {
            Some(source) => source.refuse(error.to_string()),
            None => error,
        }
    }
}

impl Request {
    /// Names a statement's file in the request's own folder of shaders.
    fn in_own_shader(&self, error: Error) -> Error {
        match (error, &self.glsl) {
            (Error::Statement { path, line, problem }, Some(folder)) => {
                let own = path.strip_prefix(BUILT_IN).map(|below| Path::new(folder).join(below));
                let path = own.filter(|own| own.is_file()).map_or(path, |own| own.display().to_string());
                Error::Statement { path, line, problem }
            }
            (error, _) => error,
        }
    }
}

/// Files that the options of a request name.
#[cfg(feature = "cli")]
pub(crate) fn files_named(options: &Options) -> Vec<(&'static str, PathBuf)> {
    let settings = Request::table().of(None).into_iter().filter(|setting| setting.kind == Kind::File);
    let path = |name: &'static str| match options.get(name) {
        Some(OptionValue::Text(path)) => Some((name, PathBuf::from(path))),
        _ => None,
    };
    settings.filter_map(|setting| path(setting.name)).collect()
}
