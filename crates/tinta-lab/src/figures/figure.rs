//! A figure of a text and a picture of it: the settings that draw it, and the words that make `tinta` draw the same.

use tinta::camera::CameraSettings;
use tinta::mesh::Normals;
use tinta::scene::Size;
use tinta::styles::{Show, Style};
use tinta::textures::ContrastTexture;

/// One of the three texts.
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
    /// Its name for `--only`, and the prefix of its files' names.
    pub id: &'static str,
    /// Its text.
    pub text: Text,
    /// The text's own number, or its substitute where the text has none.
    pub number: &'static str,
    /// Its subject, a few words.
    pub title: &'static str,
    /// The contents of the text's figure and of ours.
    pub caption: &'static str,
    /// The drawing or measurement.
    pub content: Content,
}

/// The contents of a figure.
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
    /// Not drawn, for this reason.
    NotDrawn(&'static str),
}

/// One picture of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The file's name.
    pub file: String,
    /// Its label among its neighbours.
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
    Grains(ContrastTexture),
    /// The built-in ramp.
    Ramp,
}

/// A model in a style.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDrawing {
    /// The model.
    pub model: Model,
    /// How its normals are made.
    pub normals: Normals,
    /// How often.
    pub copies: u32,
    /// From where.
    pub camera: CameraSettings,
    /// How.
    pub style: Style,
    /// The style's picture to draw.
    pub show: Show,
    /// The options of `tinta render` that say all this.
    pub options: String,
}

/// The model of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// A built-in model by its whole name, `builtin:…`.
    Builtin(&'static str),
    /// The user's model with a picture on it; no built-in model has one.
    Textured,
}

impl Figure {
    /// Its pictures; empty if it is measured.
    pub fn panels(&self) -> &[Panel] {
        match &self.content {
            Content::Pictures(panels) => panels,
            Content::Frames | Content::OtherNumbers | Content::Passes | Content::NotDrawn(_) => &[],
        }
    }
}

impl Panel {
    /// The command that draws this picture alone; `textured` is the user's model and its skin.
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
            Drawing::Grains(_) | Drawing::Ramp => {
                format!("tinta figures -o figures --size {size}  # figures/{}", self.file)
            }
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

/// A panel of a built-in model in the view of `shot`.
pub(super) fn panel(
    file: &str,
    label: &'static str,
    model: &'static str,
    shot: Shot,
    style: Style,
    options: &str,
) -> Panel {
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
    /// The same scene, another of its style's pictures; `option` is its name for `--show`.
    pub(super) fn showing(mut self, show: Show, option: &str) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.show = show;
            scene.options.push_str(&format!(" --show {option}"));
        }
        self
    }

    /// With so many copies of the model.
    pub(super) fn times(mut self, copies: u32) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.copies = copies;
            scene.options.push_str(&format!(" --copies {copies}"));
        }
        self
    }

    /// The user's textured model instead.
    pub(super) fn textured(mut self) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.model = Model::Textured;
        }
        self
    }
}

/// A camera and the options that say it.
#[derive(Debug, Clone)]
pub(super) struct Shot {
    pub(super) camera: CameraSettings,
    pub(super) options: &'static str,
}

impl Shot {
    /// The default camera.
    pub(super) fn whole() -> Self {
        Self { camera: CameraSettings::default(), options: "" }
    }

    /// A view by its angles.
    pub(super) fn view(azimuth_degrees: f64, elevation_degrees: f64, options: &'static str) -> Self {
        let view = tinta::camera::View { azimuth_degrees, elevation_degrees };
        Self { camera: CameraSettings { view, ..CameraSettings::default() }, options }
    }

    /// A view by its eye, target and field of view.
    pub(super) fn eye(eye: [f64; 3], target: [f64; 3], fov_y_degrees: f64, options: &'static str) -> Self {
        let (eye, target) = (Some(eye.into()), Some(target.into()));
        Self { camera: CameraSettings { eye, target, fov_y_degrees, ..CameraSettings::default() }, options }
    }

    /// The bust's head and shoulders.
    pub(super) fn face() -> Self {
        Self::eye([3.2, 5.0, 6.4], [0.1, 4.0, 0.0], 34.0, "--eye 3.2,5.0,6.4 --target 0.1,4.0,0 --fov 34")
    }
}
