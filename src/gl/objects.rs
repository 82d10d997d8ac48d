//! GL objects with one owner each. An object is deleted when its owner is dropped, which must happen while its context is
//! current.

use super::sources::Source;
use super::{Gl, sources};
use crate::error::{Error, Result};
use crate::plan::{self, Sampling};
use glow::HasContext;
use std::borrow::Cow;
use std::collections::HashMap;
use std::rc::Rc;

/// Counts an object; uncounts it when dropped.
pub(super) struct Live(Rc<Gl>);

impl Live {
    pub(super) fn new(gl: &Rc<Gl>) -> Self {
        gl.live_objects.set(gl.live_objects.get() + 1);
        Self(gl.clone())
    }

    pub(super) fn gl(&self) -> &glow::Context {
        &self.0.glow
    }

    /// As [`Gl::own_framebuffer`].
    pub(super) fn own_framebuffer(&self) -> Option<glow::Framebuffer> {
        self.0.own_framebuffer()
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.0.live_objects.set(self.0.live_objects.get() - 1);
    }
}

pub(super) fn out_of_names(error: String) -> Error {
    Error::gl("making a GL object", error)
}

/// A vertex or index buffer.
pub(super) struct Buffer {
    live: Live,
    id: glow::Buffer,
    target: u32,
}

impl Buffer {
    /// Uploads bytes once, for drawing; `target` is GL_ARRAY_BUFFER or GL_ELEMENT_ARRAY_BUFFER.
    pub(super) fn new(gl: &Rc<Gl>, target: u32, bytes: &[u8]) -> Result<Self> {
        // SAFETY: the context is current, as it must be to call `Resources`' methods; the bytes outlive the call.
        unsafe {
            let id = gl.glow.create_buffer().map_err(out_of_names)?;
            let buffer = Self { live: Live::new(gl), id, target };
            gl.glow.bind_buffer(target, Some(id));
            gl.glow.buffer_data_u8_slice(target, bytes, glow::STATIC_DRAW);
            gl.check("uploading a model")?;
            Ok(buffer)
        }
    }

    pub(super) fn bind(&self) {
        // SAFETY: the context is current and this buffer alive.
        unsafe { self.live.0.glow.bind_buffer(self.target, Some(self.id)) }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: the context is current and this buffer alive and ours.
        unsafe { self.live.0.glow.delete_buffer(self.id) }
    }
}

/// A texture.
pub(super) struct Texture {
    live: Live,
    id: glow::Texture,
    target: u32,
}

impl Texture {
    /// Makes an empty texture; `target` is GL_TEXTURE_1D or GL_TEXTURE_2D.
    pub(super) fn new(gl: &Rc<Gl>, target: u32, sampling: Sampling) -> Result<Self> {
        let (smaller, larger, wrap) = match sampling {
            Sampling::NearestClamped => (glow::NEAREST, glow::NEAREST, glow::CLAMP_TO_EDGE),
            Sampling::LinearRepeated => (glow::LINEAR, glow::LINEAR, glow::REPEAT),
            Sampling::MipmapRepeated => (glow::LINEAR_MIPMAP_LINEAR, glow::LINEAR, glow::REPEAT),
        };
        // SAFETY: the context is current; the parameters are those of every texture of GL 2.1.
        unsafe {
            let id = gl.glow.create_texture().map_err(out_of_names)?;
            let texture = Self { live: Live::new(gl), id, target };
            gl.glow.bind_texture(target, Some(id));
            for (name, value) in [
                (glow::TEXTURE_MIN_FILTER, smaller),
                (glow::TEXTURE_MAG_FILTER, larger),
                (glow::TEXTURE_WRAP_S, wrap),
                (glow::TEXTURE_WRAP_T, wrap),
            ] {
                gl.glow.tex_parameter_i32(target, name, value as i32);
            }
            if sampling == Sampling::MipmapRepeated {
                gl.legacy.keep_mipmaps(&gl.glow);
            }
            Ok(texture)
        }
    }

    /// The texture's name, for attaching it.
    pub(super) fn id(&self) -> glow::Texture {
        self.id
    }

    pub(super) fn bind(&self, unit: u32) {
        // SAFETY: the context is current and this texture alive; `Resources::prepare` has checked the number of units.
        unsafe {
            self.live.0.glow.active_texture(glow::TEXTURE0 + unit);
            self.live.0.glow.bind_texture(self.target, Some(self.id));
        }
    }
}

impl Drop for Texture {
    fn drop(&mut self) {
        // SAFETY: the context is current and this texture alive and ours.
        unsafe { self.live.0.glow.delete_texture(self.id) }
    }
}

/// A linked program and the locations of its uniforms.
pub(super) struct Program {
    live: Live,
    id: glow::Program,
    locations: HashMap<Cow<'static, str>, Option<glow::UniformLocation>>,
    /// Whether it last drew into textures; `None` before its first draw.
    into_textures: Option<bool>,
    /// Whether a uniform must change before the next draw.
    is_stale: bool,
}

impl Program {
    /// Compiles and links the shaders a plan names.
    pub(super) fn new(gl: &Rc<Gl>, program: &plan::Program) -> Result<Self> {
        // SAFETY: the context is current; shaders are attached, detached and deleted in that order.
        unsafe {
            let id = gl.glow.create_program().map_err(out_of_names)?;
            let linked =
                Self { live: Live::new(gl), id, locations: HashMap::new(), into_textures: None, is_stale: false };
            let sources = sources::of_program(gl, program)?;
            let shaders: Vec<Shader> = sources.iter().map(|source| Shader::new(gl, source)).collect::<Result<_>>()?;
            for shader in &shaders {
                gl.glow.attach_shader(id, shader.id);
            }
            gl.legacy.before_linking(&gl.glow, id);
            gl.glow.link_program(id);
            for shader in &shaders {
                gl.glow.detach_shader(id, shader.id);
            }
            if gl.glow.get_program_link_status(id) {
                return Ok(linked);
            }
            let path = format!("{} + {}", program.vertex, program.fragments.join(" + "));
            Err(Error::Shader { path, log: one_line(&gl.glow.get_program_info_log(id)) })
        }
    }

    /// Makes this the program that draws, into textures or the framebuffer.
    ///
    /// Mesa's framebuffer is upside down, so Mesa flips `dFdy` and `gl_FragCoord` by a constant of the program. Mesa 22 updates
    /// that constant only when a uniform changes: a program that switches between textures and framebuffer needs its uniforms set
    /// again.
    pub(super) fn bind(&mut self, into_textures: bool) {
        self.is_stale = self.into_textures.is_some_and(|before| before != into_textures);
        self.into_textures = Some(into_textures);
        // SAFETY: the context is current and this program alive.
        unsafe { self.live.0.glow.use_program(Some(self.id)) }
        self.live.0.legacy.program_bound(self.id);
    }

    /// Sets a uniform of this program, which is bound; a uniform that the driver optimised away is no error.
    pub(super) fn set(&mut self, name: Cow<'static, str>, value: plan::Value) {
        let gl = &self.live.0.glow;
        let id = self.id;
        // SAFETY: the context is current, this program alive and bound.
        let location =
            self.locations.entry(name).or_insert_with_key(|name| unsafe { gl.get_uniform_location(id, name) }).as_ref();
        let other = |x: f32| if x == 0.0 { 1.0 } else { 0.0 };
        // SAFETY: as above; the value has the type the shader declares, which a test of every program checks.
        unsafe {
            if location.is_some() && std::mem::take(&mut self.is_stale) {
                match value {
                    plan::Value::Int(x) => gl.uniform_1_i32(location, i32::from(x == 0)),
                    plan::Value::Float(x) => gl.uniform_1_f32(location, other(x)),
                    plan::Value::Vec2([x, y]) | plan::Value::TexelSize([x, y]) | plan::Value::PixelPlace([x, y]) => {
                        gl.uniform_2_f32(location, other(x), y);
                    }
                    plan::Value::Vec3([x, y, z]) => gl.uniform_3_f32(location, other(x), y, z),
                }
            }
            match value {
                plan::Value::Int(x) => gl.uniform_1_i32(location, x),
                plan::Value::Float(x) => gl.uniform_1_f32(location, x),
                plan::Value::Vec2([x, y]) | plan::Value::TexelSize([x, y]) | plan::Value::PixelPlace([x, y]) => {
                    gl.uniform_2_f32(location, x, y);
                }
                plan::Value::Vec3([x, y, z]) => gl.uniform_3_f32(location, x, y, z),
            }
        }
    }

    /// Points a sampler of this program, which is bound, at a texture unit.
    pub(super) fn set_sampler(&mut self, name: &'static str, unit: u32) {
        let gl = &self.live.0.glow;
        let id = self.id;
        // SAFETY: the context is current, this program alive and bound.
        unsafe {
            let location =
                self.locations.entry(name.into()).or_insert_with(|| gl.get_uniform_location(id, name)).as_ref();
            gl.uniform_1_i32(location, unit as i32);
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.live.0.legacy.program_deleted(self.id);
        // SAFETY: the context is current and this program alive and ours.
        unsafe { self.live.0.glow.delete_program(self.id) }
    }
}

/// A compiled shader, needed until its program is linked.
pub(super) struct Shader {
    live: Live,
    id: glow::Shader,
}

impl Shader {
    /// Compiles a shader.
    pub(super) fn new(gl: &Rc<Gl>, source: &Source) -> Result<Self> {
        let Source { kind, path, text, .. } = source;
        // SAFETY: the context is current.
        unsafe {
            let id = gl.glow.create_shader(*kind).map_err(out_of_names)?;
            let shader = Self { live: Live::new(gl), id };
            gl.glow.shader_source(id, text);
            gl.glow.compile_shader(id);
            if gl.glow.get_shader_compile_status(id) {
                return Ok(shader);
            }
            Err(Error::Shader {
                path: path.clone(),
                log: one_line(&source.explained(&gl.glow.get_shader_info_log(id))),
            })
        }
    }
}

impl Drop for Shader {
    fn drop(&mut self) {
        // SAFETY: the context is current and this shader alive and ours.
        unsafe { self.live.0.glow.delete_shader(self.id) }
    }
}

/// A query of elapsed time on the device.
pub(crate) struct TimerQuery {
    live: Live,
    id: glow::Query,
}

impl TimerQuery {
    pub(crate) fn new(gl: &Rc<Gl>) -> Result<Self> {
        // SAFETY: the context is current.
        let id = unsafe { gl.glow.create_query() }.map_err(out_of_names)?;
        Ok(Self { live: Live::new(gl), id })
    }

    pub(crate) fn begin(&self) {
        // SAFETY: the context is current, this query alive and no other of its kind running.
        unsafe { self.live.0.glow.begin_query(glow::TIME_ELAPSED, self.id) }
    }

    pub(crate) fn end(&self) {
        // SAFETY: the context is current and this query running.
        unsafe { self.live.0.glow.end_query(glow::TIME_ELAPSED) }
    }

    /// Waits for the device and returns the elapsed milliseconds.
    pub(crate) fn milliseconds(&self) -> f64 {
        // SAFETY: the context is current and this query ended. 32 bits of nanoseconds last four seconds.
        let nanoseconds = unsafe { self.live.0.glow.get_query_parameter_u32(self.id, glow::QUERY_RESULT) };
        f64::from(nanoseconds) * 1e-6
    }
}

impl Drop for TimerQuery {
    fn drop(&mut self) {
        // SAFETY: the context is current and this query alive and ours.
        unsafe { self.live.0.glow.delete_query(self.id) }
    }
}

pub(super) fn one_line(log: &str) -> String {
    log.trim().lines().map(str::trim).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::context::{Context, witnesses};

    #[test]
    fn dropping_the_owner_deletes_the_object() {
        for backend in witnesses() {
            let context = Context::open(backend, None).unwrap_or_else(|error| panic!("{error}"));
            let _current = context.enter().unwrap();
            let gl = context.gl();
            let buffer = Buffer::new(gl, glow::ARRAY_BUFFER, &[0; 24]).unwrap();
            let texture = Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped).unwrap();
            let shaders = plan::Program::new("evangelista/map.vert", ["evangelista/map.frag"]);
            let program = Program::new(gl, &shaders).unwrap();
            let query = TimerQuery::new(gl).unwrap();
            query.begin();
            query.end();
            let (buffer_id, texture_id, program_id) = (buffer.id, texture.id, program.id);
            // SAFETY: the context is current; querying a name is safe whether or not it is alive.
            let alive = || unsafe {
                let glow = &gl.glow;
                [glow.is_buffer(buffer_id), glow.is_texture(texture_id), glow.is_program(program_id)]
            };
            assert_eq!(alive(), [true; 3], "{backend:?}");
            assert_eq!(gl.live_objects.get(), 4, "the shaders went with the linking");
            drop((buffer, texture, program, query));
            assert_eq!(alive(), [false; 3], "{backend:?}");
            assert_eq!(gl.live_objects.get(), 0);
        }
    }

    #[test]
    fn a_gl_error_is_reported_once_with_its_name_and_place() {
        for backend in witnesses() {
            let context = Context::open(backend, None).unwrap_or_else(|error| panic!("{error}"));
            let _current = context.enter().unwrap();
            let gl = context.gl();
            gl.check("before").unwrap();
            // SAFETY: the context is current; names GL does not know leave an error and change nothing.
            unsafe {
                gl.glow.enable(0xFFFF);
                gl.glow.enable(0xFFFF);
            }
            let message = gl.check("a test").unwrap_err().to_string();
            assert!(message.contains("a test") && message.contains("GL_INVALID_ENUM"), "{message}");
            gl.check("after").unwrap();
        }
    }
}
