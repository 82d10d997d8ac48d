//! Every figure of the three texts, drawn again or named with why not, and their claims: lists of plain data, and what draws,
//! measures and shows them.
//!
//! In: a picture size and a renderer. Out: pictures, measured numbers ([`Numbers`]), what is found of each claim
//! ([`ClaimRecord`]) and a page with all of it ([`page::page`]). The list knows neither GL nor clap: a panel is a scene's settings
//! and a style, and beside them the words that make `tinta` draw the same, which a test holds against each other.
//!
//! ```
//! use tinta::Size;
//! use tinta_lab::figures::figures;
//!
//! let size = Size { width: 256, height: 256 };
//! let tones = figures(size).into_iter().find(|figure| figure.id == "evangelista-5").expect("figure 5");
//! assert_eq!(tones.panels().len(), 4, "Phong, one, two and three tones");
//! ```

mod claims;
mod dachsbacher;
mod draw;
mod evangelista;
mod filters;
mod measure;
mod mix;
mod others;
pub mod page;
mod passes;
pub mod plot;
mod reasons;
mod throughput;
mod valente;

pub use claims::{Claim, ClaimRecord, Finding, Number, Verdict, claims, markdown, measure_claims, tally};
pub use draw::Artist;
pub use filters::{Kernel, kernels};
pub use measure::{
    ARTICLE, Article, BackgroundRow, FilterRow, FrameRow, HowToMeasure, MixRow, Numbers, Reason, Turn, measure,
    triangles_a_turn,
};
pub use mix::{Mix, TRIANGLES};
pub use passes::{PassColumn, PassSteps, pass_columns};
pub use reasons::Host;
pub use throughput::{SHADERS, ShaderRow};

use tinta::camera::CameraSettings;
use tinta::error::{Error, Result};
use tinta::mesh::Normals;
use tinta::scene::Size;
use tinta::styles::{Show, Style};
use tinta::textures::ContrastTexture;

/// Which of the three texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Text {
    /// Evangelista, Silva, Nery, Mota 2005.
    Evangelista,
    /// Valente 2007.
    Valente,
    /// Dachsbacher, *Beethoven aus Bits und Bytes*.
    Dachsbacher,
}

impl Text {
    /// All three, in the page's order.
    pub const ALL: [Self; 3] = [Self::Evangelista, Self::Valente, Self::Dachsbacher];

    /// Authors and year, as a heading.
    pub fn name(self) -> &'static str {
        match self {
            Self::Evangelista => "Evangelista et al. 2005",
            Self::Valente => "Valente 2007",
            Self::Dachsbacher => "Dachsbacher",
        }
    }

    /// The text's own title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Evangelista => {
                "Renderização de cenas tridimensionais não-fotorealistas explorando hardware programável"
            }
            Self::Valente => "Explorando “Charcoal Rendering”",
            Self::Dachsbacher => "Beethoven aus Bits und Bytes",
        }
    }
}

/// A figure of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What `--only` takes, and how its files' names begin.
    pub id: &'static str,
    /// Where it stands.
    pub text: Text,
    /// The text's own number, or what takes its place where the text has none.
    pub number: &'static str,
    /// What it is of, a few words.
    pub title: &'static str,
    /// What the text's figure shows and what ours shows in its stead.
    pub caption: &'static str,
    /// What is drawn or measured.
    pub content: Content,
}

/// What a figure is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Pictures side by side.
    Pictures(Vec<Panel>),
    /// Figure 13: frames per second over triangles.
    Frames,
    /// The numbers the text prints outside its figures.
    OtherNumbers,
    /// Figure 7: the passes as plans have them.
    Passes,
    /// The text's claims, measured.
    Claims(Text),
    /// Nothing, for this reason.
    NotDrawn(&'static str),
}

/// One picture of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The file's name.
    pub file: String,
    /// What tells it from its neighbours.
    pub label: &'static str,
    /// How it is drawn.
    pub drawing: Drawing,
}

/// How a picture is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// A model in a style.
    Scene(Box<SceneDrawing>),
    /// A texture of grains.
    Grains {
        /// Its settings.
        texture: ContrastTexture,
        /// The file `tinta textures` writes it to.
        name: &'static str,
    },
    /// The built-in ramp.
    Ramp,
}

/// A model in a style.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDrawing {
    /// What is drawn.
    pub model: Model,
    /// By which rule its normals are made.
    pub normals: Normals,
    /// How often.
    pub copies: u32,
    /// From where.
    pub camera: CameraSettings,
    /// How.
    pub style: Style,
    /// Which of the style's pictures.
    pub show: Show,
    /// The options of `tinta render` that say all this.
    pub options: String,
}

/// What a panel draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// A built-in model by its whole name, `builtin:…`.
    Builtin(&'static str),
    /// The user's model with a picture on it; there is none built in.
    Textured,
}

/// All figures, drawn or not, and each text's claims, for pictures of this size.
pub fn figures(size: Size) -> Vec<Figure> {
    [
        others::complete(Text::Evangelista, evangelista::figures()),
        others::complete(Text::Valente, valente::figures(size)),
        others::complete(Text::Dachsbacher, dachsbacher::figures()),
    ]
    .concat()
}

/// Those of these ids, in the list's order; all of them for none.
///
/// # Errors
///
/// [`Error::Setting`] for an id that no figure has.
pub fn only(figures: Vec<Figure>, ids: &[String]) -> Result<Vec<Figure>> {
    let known: Vec<&str> = figures.iter().map(|figure| figure.id).collect();
    if let Some(unknown) = ids.iter().find(|id| !known.contains(&id.as_str())) {
        return Err(Error::value(
            "only",
            unknown,
            format!("there is no such figure; choose from {}", known.join(", ")),
        ));
    }
    Ok(figures.into_iter().filter(|figure| ids.is_empty() || ids.iter().any(|id| id == figure.id)).collect())
}

impl Figure {
    /// Its pictures; none where it is measured.
    pub fn panels(&self) -> &[Panel] {
        match &self.content {
            Content::Pictures(panels) => panels,
            Content::Frames | Content::OtherNumbers | Content::Passes | Content::Claims(_) | Content::NotDrawn(_) => {
                &[]
            }
        }
    }

    /// Whether section 5 of Evangelista et al. has to be measured for it.
    pub fn needs_numbers(&self) -> bool {
        matches!(self.content, Content::Frames | Content::OtherNumbers | Content::Claims(Text::Evangelista))
    }

    /// The claims it shows.
    pub fn claims(&self) -> Vec<Claim> {
        match self.content {
            Content::Claims(text) => claims(text),
            _ => Vec::new(),
        }
    }
}

impl Claim {
    /// The pictures that show it.
    pub fn panels(&self) -> Vec<Panel> {
        (self.panels)()
    }
}

impl Panel {
    /// The command that draws this picture by itself; `textured` is the user's model and its skin.
    pub fn command(&self, size: Size, textured: Option<&str>) -> String {
        match &self.drawing {
            Drawing::Scene(scene) => {
                let model = scene.model.name(textured);
                // Without a style a look would be drawn.
                let style = if scene.options.contains("--style ") { "" } else { " --style three-pass" };
                format!("tinta render {model} -o {}{style} --size {size} {}", self.file, scene.options)
                    .trim_end()
                    .to_owned()
            }
            Drawing::Grains { name, .. } => format!("tinta textures -o textures --size {size}  # textures/{name}"),
            Drawing::Ramp => "tinta textures -o textures  # textures/ramp.png".to_owned(),
        }
    }

    /// Whether it needs a model with a picture on it, which the user must bring.
    pub fn needs_texture(&self) -> bool {
        matches!(&self.drawing, Drawing::Scene(scene) if scene.model == Model::Textured)
    }
}

impl Model {
    fn name(self, textured: Option<&str>) -> &str {
        match self {
            Self::Builtin(name) => name,
            Self::Textured => textured.unwrap_or("MODEL"),
        }
    }
}

/// Why panels that need a texture are left out.
pub const NO_TEXTURED_MODEL: &str =
    "it shows a game's character with its own texture; name one with --model FILE, or builtin:soldier";

/// A panel of a built-in model seen as `shot` says.
fn panel(file: &str, label: &'static str, model: &'static str, shot: Shot, style: Style, options: &str) -> Panel {
    let shown = SceneDrawing {
        model: Model::Builtin(model),
        normals: Normals::File,
        copies: 1,
        camera: shot.camera,
        style,
        show: Show::Final,
        options: [shot.options, options].iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(" "),
    };
    Panel { file: format!("{file}.png"), label, drawing: Drawing::Scene(Box::new(shown)) }
}

impl Panel {
    /// The same scene, another of its style's pictures; `option` is what `--show` says.
    fn showing(mut self, show: Show, option: &str) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.show = show;
            scene.options.push_str(&format!(" --show {option}"));
        }
        self
    }

    /// So many of the model.
    fn times(mut self, copies: u32) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.copies = copies;
            scene.options.push_str(&format!(" --copies {copies}"));
        }
        self
    }

    /// The user's textured model instead.
    fn textured(mut self) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.model = Model::Textured;
        }
        self
    }
}

/// A camera and the options that say it.
#[derive(Debug, Clone)]
struct Shot {
    camera: CameraSettings,
    options: &'static str,
}

impl Shot {
    /// The default camera.
    fn whole() -> Self {
        Self { camera: CameraSettings::default(), options: "" }
    }

    /// By its angles.
    fn view(azimuth_degrees: f64, elevation_degrees: f64, options: &'static str) -> Self {
        let view = tinta::camera::View { azimuth_degrees, elevation_degrees };
        Self { camera: CameraSettings { view, ..CameraSettings::default() }, options }
    }

    /// By its eye, target and field of view.
    fn eye(eye: [f64; 3], target: [f64; 3], fov_y_degrees: f64, options: &'static str) -> Self {
        let (eye, target) = (Some(eye.into()), Some(target.into()));
        Self { camera: CameraSettings { eye, target, fov_y_degrees, ..CameraSettings::default() }, options }
    }

    /// The bust's head and shoulders.
    fn face() -> Self {
        Self::eye([3.2, 5.0, 6.4], [0.1, 4.0, 0.0], 34.0, "--eye 3.2,5.0,6.4 --target 0.1,4.0,0 --fov 34")
    }
}
