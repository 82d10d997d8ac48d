//! The shaders that a draw runs, and the uniforms they read.

use super::target::TextureName;
use crate::picture::Picture;
use crate::scene::Size;
use std::borrow::Cow;
use std::sync::Arc;

/// A vertex shader and the fragment shaders linked with it, by their paths below `glsl/`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Program {
    /// The vertex shader.
    pub vertex: Cow<'static, str>,
    /// The fragment shaders: one with `main`, the others with the functions it declares; none for fixed-function fragments.
    pub fragments: Vec<Cow<'static, str>>,
}

/// A value for a shader.
#[derive(Debug, Clone, PartialEq)]
pub struct Uniform {
    /// Its name in the shader.
    pub name: Cow<'static, str>,
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
    /// int
    Int(i32),
    /// vec2: the distance between texels of a pass's result, 1 / its size in pixels. In a tile it is the tile's.
    TexelSize([f32; 2]),
    /// vec2: a place on the surface, in pixels from its lower left corner. In a tile it is counted from the tile's.
    PixelPlace([f32; 2]),
}

impl Program {
    /// A vertex shader with fragment shaders.
    pub fn new<S: Into<Cow<'static, str>>>(
        vertex: impl Into<Cow<'static, str>>,
        fragments: impl IntoIterator<Item = S>,
    ) -> Self {
        Self { vertex: vertex.into(), fragments: fragments.into_iter().map(Into::into).collect() }
    }
}

impl Uniform {
    /// A uniform with its value.
    pub fn new(name: impl Into<Cow<'static, str>>, value: Value) -> Self {
        Self { name: name.into(), value }
    }
}

impl Value {
    /// Returns the [`Value::TexelSize`] of a surface of this size.
    pub(crate) fn texel_size(size: Size) -> Self {
        Self::TexelSize([1.0 / size.width as f32, 1.0 / size.height as f32])
    }
}

/// The textures a plan can read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Texture {
    /// The framebuffer at the last [`Step::CopyFramebuffer`](super::Step::CopyFramebuffer); NEAREST, CLAMP_TO_EDGE (errata E12).
    BorderMap,
    /// The texture that passes into [`Target::Textures`](super::Target::Textures) drew; NEAREST, CLAMP_TO_EDGE.
    Drawn(TextureName),
    /// The depth buffer at the last [`Step::CopyDepth`](super::Step::CopyDepth), window z in red; NEAREST, CLAMP_TO_EDGE.
    DepthMap,
    /// The plan's table of this number, one-dimensional; NEAREST, CLAMP_TO_EDGE.
    Table(usize),
    /// The plan's picture of this number.
    Picture(usize),
    /// The texture of each material, by the model's own texture coordinates, LINEAR, GL_REPEAT; white for materials without one.
    Material {
        /// Whether one finer than the pixels is averaged first.
        is_averaged: bool,
    },
}

impl Program {
    /// Whether this is one of its shaders.
    pub(crate) fn has_shader(&self, path: &str) -> bool {
        self.vertex == path || self.fragments.iter().any(|fragment| fragment == path)
    }
}

/// A picture as a texture, its lowest row at coordinate 0.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanPicture {
    /// Its name for readers of the plan.
    pub name: &'static str,
    /// The picture.
    pub picture: Arc<Picture>,
    /// How it is read.
    pub sampling: Sampling,
}

/// The name of a plan's picture of the paper's height: lines that are laid over the plan's picture are rubbed off by it.
pub(crate) const TOOTH: &str = "tooth";

/// The reading of a texture between and beyond its texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sampling {
    /// NEAREST, CLAMP_TO_EDGE.
    NearestClamped,
    /// LINEAR, GL_REPEAT.
    LinearRepeated,
    /// LINEAR_MIPMAP_LINEAR if reduced, LINEAR if enlarged, GL_REPEAT.
    MipmapRepeated,
}
