//! What a style wants GL to do, as plain data: passes of steps, each with all the state it needs.
//!
//! A style makes it from a scene, `gl` carries it out, and anybody can print, compare or check it without a GPU.

use std::fmt;

/// The steps of one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// In order; each pass is timed by its name.
    pub passes: Vec<Pass>,
    /// The table of tones that [`Texture::ToneTable`] stands for, if a step reads it.
    pub tone_table: Option<ToneTable>,
    /// What of the framebuffer is the picture.
    pub output: Output,
}

/// Steps that belong together, under the name by which reports and dumps know them.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    /// `map`, `tones`, `border` …
    pub name: &'static str,
    /// In order.
    pub steps: Vec<Step>,
}

/// One thing for GL to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Clear colour and depth.
    Clear {
        /// Red, green, blue, alpha.
        color: [f32; 4],
    },
    /// Draw something.
    Draw(Draw),
    /// glCopyTexImage2D: the framebuffer becomes the texture [`Texture::BorderMap`], RGBA.
    CopyFramebuffer,
}

/// One draw with all the state it needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// What is drawn.
    pub geometry: Geometry,
    /// With which shaders.
    pub program: Program,
    /// The uniforms of that program.
    pub uniforms: Vec<Uniform>,
    /// The textures it reads, by the name of their sampler; each gets a texture unit of its own.
    pub textures: Vec<(&'static str, Texture)>,
    /// How it meets the depth buffer.
    pub depth: Depth,
    /// Whether the colour is blended over what is there by its alpha.
    pub blend: bool,
    /// Whether faces turned away from the eye (clockwise in the picture) are left out.
    pub cull_back_faces: bool,
}

/// What can be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Geometry {
    /// All objects of the scene, each material in its colour.
    Objects,
    /// A square behind everything, facing the eye, in parallel projection, of this colour.
    BackgroundSquare {
        /// Red, green, blue, alpha.
        color: [f32; 4],
    },
    /// A square over the whole picture at the near plane, its vertices in clip space.
    ScreenSquare,
}

/// A vertex shader and the fragment shaders linked with it, by their paths below `glsl/`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Program {
    /// The vertex shader.
    pub vertex: &'static str,
    /// The fragment shaders: one with `main`, the others with the functions it declares.
    pub fragments: Vec<&'static str>,
}

/// A value for a shader.
#[derive(Debug, Clone, PartialEq)]
pub struct Uniform {
    /// Its name in the shader.
    pub name: &'static str,
    /// Its value.
    pub value: Value,
}

/// A uniform's value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// float
    Float(f32),
    /// vec2
    Vec2([f32; 2]),
    /// vec3
    Vec3([f32; 3]),
}

/// The textures a plan can read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Texture {
    /// The framebuffer as the last [`Step::CopyFramebuffer`] left it; NEAREST, CLAMP_TO_EDGE (errata E12).
    BorderMap,
    /// The plan's [`ToneTable`], one-dimensional; NEAREST, CLAMP_TO_EDGE.
    ToneTable,
}

/// How a draw meets the depth buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Drawn where nearer than what is there (GL_LESS), and written.
    TestAndWrite,
    /// Neither tested nor written.
    Ignore,
}

/// Tones as a one-dimensional texture: (tone of a diffuse value, tone of a specular value or 0) a texel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ToneTable {
    /// Values in 1/255, for the light values 0 to 1 at the texels' centres.
    pub texels: Vec<[u8; 2]>,
}

/// What of the framebuffer the picture shows.
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
    /// All steps with the name of their pass.
    pub fn steps(&self) -> impl Iterator<Item = (&'static str, &Step)> {
        self.passes.iter().flat_map(|pass| pass.steps.iter().map(|step| (pass.name, step)))
    }
}

impl Step {
    /// A short name for files and tables.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Clear { .. } => "clear",
            Self::CopyFramebuffer => "copy",
            Self::Draw(draw) => match draw.geometry {
                Geometry::Objects => "objects",
                Geometry::BackgroundSquare { .. } => "background",
                Geometry::ScreenSquare => "square",
            },
        }
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, pass) in self.passes.iter().enumerate() {
            writeln!(out, "pass {}: {}", number + 1, pass.name)?;
            for step in &pass.steps {
                writeln!(out, "  {step}")?;
            }
        }
        let output = match self.output {
            Output::Rgba => "the framebuffer",
            Output::Rgb => "the framebuffer's red, green and blue",
            Output::AlphaAsGrey => "the framebuffer's alpha as grey",
        };
        writeln!(out, "picture: {output}")
    }
}

impl fmt::Display for Step {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clear { color: [r, g, b, a] } => write!(out, "clear to ({r}, {g}, {b}, {a}), depth to 1"),
            Self::CopyFramebuffer => write!(out, "copy the framebuffer into the texture BorderMap"),
            Self::Draw(draw) => draw.fmt(out),
        }
    }
}

impl fmt::Display for Draw {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.geometry {
            Geometry::Objects => write!(out, "draw the objects")?,
            Geometry::BackgroundSquare { color: [r, g, b, a] } => {
                write!(out, "draw the background square in ({r}, {g}, {b}, {a})")?;
            }
            Geometry::ScreenSquare => write!(out, "draw the screen square")?,
        }
        write!(out, " with {} + {}", self.program.vertex, self.program.fragments.join(" + "))?;
        for uniform in &self.uniforms {
            match uniform.value {
                Value::Float(x) => write!(out, ", {} = {x}", uniform.name)?,
                Value::Vec2([x, y]) => write!(out, ", {} = ({x}, {y})", uniform.name)?,
                Value::Vec3([x, y, z]) => write!(out, ", {} = ({x}, {y}, {z})", uniform.name)?,
            }
        }
        for (sampler, texture) in &self.textures {
            write!(out, ", {sampler} = {texture:?}")?;
        }
        if self.depth == Depth::Ignore {
            write!(out, ", no depth test")?;
        }
        if self.cull_back_faces {
            write!(out, ", back faces left out")?;
        }
        if self.blend {
            write!(out, ", blended")?;
        }
        Ok(())
    }
}
