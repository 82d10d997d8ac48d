//! The work of a style for GL, as plain data: passes of steps, each with all the state it needs.
//!
//! A style makes the plan from a scene and `gl` carries it out. A plan can be printed, compared and checked without a GPU. Beside
//! each draw a style states facts about its shaders ([`Facts`]); [`prune`] uses them to drop steps that a scene does not need.
//!
//! ```
//! # fn main() -> tinta::Result<()> {
//! use std::sync::Arc;
//! use tinta::{LoadOptions, Scene, SceneSettings, Show, Style, StyleName, load};
//!
//! let mesh = load("builtin:bust", &LoadOptions::default())?.mesh;
//! let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
//!
//! let plan = Style::named(StyleName::ThreePass).plan(&scene, Show::Final)?;
//! let passes: Vec<&str> = plan.passes.iter().map(|pass| pass.name).collect();
//! assert_eq!(passes, ["map", "tones", "border"]);
//! // A plan prints as its steps.
//! assert!(plan.to_string().contains("copy the framebuffer into the texture BorderMap"));
//! // `{:#}` also prints the facts that a style states of its draws.
//! assert!(format!("{plan:#}").contains("reads no further than 2 px"));
//! # Ok(())
//! # }
//! ```

mod check;
mod display;
mod facts;
mod program;
pub mod prune;
mod submission;
mod target;
mod tiles;

pub use check::Flaw;
pub use facts::{Facts, Shorter, WhereEven};
pub(crate) use program::TOOTH;
pub use program::{PlanPicture, Program, Sampling, Texture, Uniform, Value};
pub use submission::Submission;
pub(crate) use target::DEPTH_COPY;
pub use target::{Attachment, Attachments, Format, SettingValue, Target, TextureName};
pub use tiles::{Tile, TileLimits};

use crate::culling::DrawnFaces;
use crate::mesh::VertexArrays;
use crate::scene::{Color, Object, Rectangle, Scene};
use std::fmt;
use std::sync::Arc;

/// The steps of one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// In order; timings use the name of each pass.
    pub passes: Vec<Pass>,
    /// The tables that [`Texture::Table`] numbers.
    pub tables: Vec<PlanTable>,
    /// The pictures that [`Texture::Picture`] numbers.
    pub pictures: Vec<PlanPicture>,
    /// Supersampling factor, from 1. Above 1 the plan ends by drawing
    /// [`Geometry::PictureSquare`], which fills the picture.
    pub supersample: u32,
    /// How its vertices are passed to GL.
    pub submission: Submission,
    /// The part of [`Plan::picture_target`] that is the picture.
    pub output: Output,
}

/// Steps that belong together. Reports and dumps use its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    /// `map`, `tones`, `border` …
    pub name: &'static str,
    /// The target that the pass draws into.
    pub target: Target,
    /// The pixels that its steps may clear, draw and copy; `None` for all. A step's own scissor lies within it.
    pub scissor: Option<Rectangle>,
    /// In order.
    pub steps: Vec<Step>,
}

/// One operation of GL.
#[expect(clippy::large_enum_variant, reason = "most steps draw, and a plan has about ten: a box would save nothing")]
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Step {
    /// Clear colour and depth.
    Clear {
        /// Red, green, blue, alpha; `None` keeps the colour.
        color: Option<[f32; 4]>,
        /// Whether to clear depth, to the farthest value.
        depth: bool,
    },
    /// Clear each of the pass's textures to its given colour, and depth.
    ClearEach {
        /// Red, green, blue and alpha for each texture, in the order of [`Attachments::colors`].
        colors: Vec<[f32; 4]>,
    },
    /// Draw something.
    Draw(Draw),
    /// glCopyTexImage2D: the framebuffer becomes the texture [`Texture::BorderMap`], RGBA.
    CopyFramebuffer,
    /// glCopyTexImage2D: the depth buffer becomes the texture [`Texture::DepthMap`]. Clear the depth buffer before it is used again:
    /// a browser takes the depth and leaves the target another buffer.
    CopyDepth,
}

/// One draw with all the state it needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// The geometry to draw.
    pub geometry: Geometry,
    /// Its shaders; `None` for the fixed-function pipeline, without lighting.
    pub program: Option<Program>,
    /// The uniforms of that program.
    pub uniforms: Vec<Uniform>,
    /// The textures it reads, by the name of their sampler. Each gets its own texture unit, in this order. Without a fragment
    /// shader the units' colours are multiplied with each other and with the geometry's.
    pub textures: Vec<(&'static str, Texture)>,
    /// How it uses the depth buffer.
    pub depth: Depth,
    /// How the colour is combined with the target's.
    pub blend: Blend,
    /// Whether to skip faces turned away from the eye (clockwise in the picture).
    pub cull_back_faces: bool,
    /// Whether of doubled faces, two that lie on each other, the one turned away is skipped ([`crate::mesh::Part::is_doubled`]).
    pub culls_doubled_faces: bool,
    /// Draw nothing but the edges of faces turned away from the eye, as lines of this width in pixels (glPolygonMode).
    pub back_faces_as_lines: Option<f32>,
    /// glPolygonOffset's factor and units: how far faces are pushed back, by their slope and in steps of depth.
    pub polygon_offset: Option<[f32; 2]>,
    /// The pixels it may change; `None` for all.
    pub scissor: Option<Rectangle>,
    /// The faces of [`Geometry::Objects`] to draw, an entry for each of the scene's objects; `None` for all.
    pub faces: Option<Arc<Vec<Faces>>>,
    /// Facts about its shaders that others may rely on.
    pub facts: Facts,
}

/// The faces of an object to draw.
#[derive(Debug, Clone, PartialEq)]
pub enum Faces {
    /// All.
    All,
    /// None.
    None,
    /// These.
    Listed(Arc<DrawnFaces>),
}

impl Draw {
    /// Returns a draw that only tests and writes depth and states no facts about its shaders.
    pub fn new(geometry: Geometry, program: Option<Program>) -> Self {
        Self {
            geometry,
            program,
            uniforms: Vec::new(),
            textures: Vec::new(),
            depth: Depth::TestAndWrite,
            blend: Blend::Replace,
            cull_back_faces: false,
            culls_doubled_faces: false,
            back_faces_as_lines: None,
            polygon_offset: None,
            scissor: None,
            faces: None,
            facts: Facts::default(),
        }
    }

    /// The unit of the materials' own pictures, and whether they are averaged; `None` if it reads none.
    pub(crate) fn material_unit(&self) -> Option<(usize, bool)> {
        self.textures.iter().enumerate().find_map(|(unit, (_, texture))| match texture {
            Texture::Material { is_averaged } => Some((unit, *is_averaged)),
            _ => None,
        })
    }
}

/// Geometry to draw.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Geometry {
    /// All objects of the scene.
    Objects(Paint),
    /// Edges of the objects.
    Edges {
        /// The edges, in runs of one object and colour.
        runs: Arc<Vec<EdgeRun>>,
        /// Lines, or points at their ends.
        mark: Mark,
        /// Width of the lines, or size of the points, pixels.
        width_px: f32,
        /// Whether GL smooths them.
        is_smooth: bool,
        /// How lines get their width.
        line_drawing: LineDrawing,
    },
    /// A square behind everything, facing the eye, in parallel projection, of this colour.
    BackgroundSquare {
        /// Red, green, blue, alpha.
        color: [f32; 4],
    },
    /// A square over the whole picture at the near plane, its vertices in clip space.
    ScreenSquare,
    /// The same over the lower left corner, which holds the picture of a supersampled plan.
    PictureSquare,
}

/// The colour of the objects' vertices.
#[derive(Debug, Clone, PartialEq)]
pub enum Paint {
    /// Each material in its colour.
    Materials,
    /// One colour for all: red, green, blue, alpha.
    Uniform([f32; 4]),
    /// White, with a coordinate for each vertex for the first texture unit: a list per object, in the scene's order, with an
    /// entry for each of [`crate::mesh::VertexArrays::vertices`].
    Coordinates(Arc<Vec<Arc<Vec<[f32; 2]>>>>),
    /// A colour for each vertex, mixed across each face: red, green, blue, alpha, in lists like those of coordinates.
    Colors(Arc<Vec<Arc<Vec<[f32; 4]>>>>),
}

impl Paint {
    /// The colour of an object's faces of a material, where their vertices do not colour them.
    pub(crate) fn color(&self, scene: &Scene, object: &Object, material: u32) -> [f32; 4] {
        match self {
            Self::Materials => {
                let Color([red, green, blue]) = scene.material_color(&object.mesh, material);
                [red, green, blue, 1.0]
            }
            Self::Uniform(color) => *color,
            Self::Coordinates(_) | Self::Colors(_) => [1.0; 4],
        }
    }
}

/// Edges of one object in one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeRun {
    /// The object's number in the scene.
    pub object: usize,
    /// The name of their class of edges.
    pub name: &'static str,
    /// Red, green, blue, alpha.
    pub color: [f32; 4],
    /// Both ends of each, as indices into [`EdgeRun::vertices`].
    pub ends: Vec<[u32; 2]>,
    /// Separate vertices for lines that run through faces or belong to none, in the form of [`crate::mesh::VertexArrays::vertices`]; `None` for
    /// lines on the object's vertices.
    pub own_vertices: Option<Vec<[f32; 6]>>,
}

impl EdgeRun {
    /// Returns the vertices that its ends index, given the object's arrays.
    pub fn vertices<'a>(&'a self, arrays: &'a VertexArrays) -> &'a [[f32; 6]] {
        self.own_vertices.as_ref().unwrap_or(&arrays.vertices)
    }
}

/// The parts of an edge to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// GL_LINES
    Lines,
    /// GL_POINTS at both ends.
    Points,
}

tinta_geometry::choices! {
    /// How lines get their width.
    #[derive(Default)]
    pub enum LineDrawing {
        /// As GL draws lines and points; as quads if the driver cannot draw the width.
        #[default]
        Gl = "gl",
        /// As quads facing the eye, computed on the CPU; not smoothed.
        Quads = "quads",
    }
}

/// How a draw uses the depth buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Drawn if nearer than the stored depth (GL_LESS), and written.
    TestAndWrite,
    /// Drawn if nearer than the stored depth (GL_LESS), not written.
    TestOnly,
    /// Drawn if exactly at the stored depth (GL_EQUAL), not written: over the visible pixels of an earlier draw.
    Equal,
    /// Neither tested nor written.
    Ignore,
}

/// How a colour is combined with the target's.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Blend {
    /// It takes its place.
    #[default]
    Replace,
    /// Drawn over the target, by its alpha.
    Over,
    /// Multiplied with the target's colour; alpha stays.
    Multiply,
}

/// Two functions of one number as a one-dimensional texture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanTable {
    /// Its name for readers of the plan.
    pub name: &'static str,
    /// Luminance and alpha, in 1/255, for the numbers 0 to 1 at the texels' centres.
    pub texels: Vec<[u8; 2]>,
}

/// The part of the target that the picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// All four channels.
    Rgba,
    /// Red, green and blue, opaque: the normals of the map.
    Rgb,
    /// Alpha as grey, opaque: the depth of the map, near dark.
    AlphaAsGrey,
}

impl Plan {
    /// Returns a plan of these passes without tables and pictures, drawn from buffers at the picture's size.
    pub fn new(passes: Vec<Pass>) -> Self {
        let (tables, pictures) = (Vec::new(), Vec::new());
        Self { passes, tables, pictures, supersample: 1, submission: Submission::Buffers, output: Output::Rgba }
    }

    /// Returns all steps with the name of their pass.
    pub fn steps(&self) -> impl Iterator<Item = (&'static str, &Step)> {
        self.passes.iter().flat_map(|pass| pass.steps.iter().map(|step| (pass.name, step)))
    }
}

impl Pass {
    /// Returns a pass of steps into the framebuffer.
    pub fn new(name: &'static str, steps: Vec<Step>) -> Self {
        Self { name, target: Target::Framebuffer, scissor: None, steps }
    }
}

impl Step {
    /// Returns a step that clears colour, to red, green, blue, alpha, and depth.
    pub fn clear(color: [f32; 4]) -> Self {
        Self::Clear { color: Some(color), depth: true }
    }

    /// Returns a short name for files and tables.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Clear { .. } | Self::ClearEach { .. } => "clear",
            Self::CopyFramebuffer => "copy",
            Self::CopyDepth => "copy-depth",
            Self::Draw(draw) => match draw.geometry {
                Geometry::Objects(_) => "objects",
                Geometry::Edges { mark: Mark::Lines, .. } => "lines",
                Geometry::Edges { mark: Mark::Points, .. } => "points",
                Geometry::BackgroundSquare { .. } => "background",
                Geometry::ScreenSquare => "square",
                Geometry::PictureSquare => "shrink",
            },
        }
    }
}

impl Draw {
    /// Whether vertices are drawn at the camera's projection of them: stated, or by the fixed-function pipeline.
    pub(crate) fn keeps_places(&self) -> bool {
        self.program.is_none() || self.facts.keeps_places
    }

    /// Whether every pixel of a face is drawn at the face's depth: stated, or by the fixed-function pipeline.
    pub(crate) fn keeps_pixels(&self) -> bool {
        let is_fixed = self.program.as_ref().is_none_or(|program| program.fragments.is_empty());
        self.back_faces_as_lines.is_none() && (is_fixed || self.facts.keeps_pixels)
    }
}

impl Plan {
    /// Drops the facts of draws that use any of these shaders, because their texts were replaced.
    pub(crate) fn forget_facts_of(&mut self, shaders: &[String]) {
        let has_one = |program: &Program| shaders.iter().any(|path| program.has_shader(path));
        let steps = self.passes.iter_mut().flat_map(|pass| &mut pass.steps);
        for draw in steps.filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None }) {
            if draw.program.as_ref().is_some_and(has_one) {
                draw.facts = Facts::default();
            }
            draw.facts.shorter.take_if(|shorter| has_one(&shorter.program));
        }
    }
}

impl Plan {
    /// The target that holds the picture: that of the last pass.
    pub fn picture_target(&self) -> Target {
        self.passes.last().map_or(Target::Framebuffer, |pass| pass.target)
    }

    /// Returns every set of textures that its passes draw into, once.
    pub(crate) fn attachments(&self) -> Vec<&'static Attachments> {
        let mut all = Vec::new();
        for pass in &self.passes {
            if let Target::Textures(attachments) = pass.target
                && !all.contains(&attachments)
            {
                all.push(attachments);
            }
        }
        all
    }

    /// Writes the picture's description.
    fn write_picture(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let holder = match self.picture_target() {
            Target::Framebuffer => "the framebuffer".to_owned(),
            Target::Textures(attachments) => format!("the texture {}", attachments.colors[0].name),
        };
        match self.output {
            Output::Rgba => writeln!(out, "picture: {holder}"),
            Output::Rgb => writeln!(out, "picture: {holder}'s red, green and blue"),
            Output::AlphaAsGrey => writeln!(out, "picture: {holder}'s alpha as grey"),
        }
    }
}
