//! What passes draw into and read from besides the framebuffer: copies of its colour and depth, and a floating-point texture.

use super::objects::{Live, Texture, out_of_names};
use super::{Gl, legacy};
use crate::error::{Error, Result};
use crate::plan::{FloatBits, Plan, Sampling, Target};
use crate::scene::Size;
use glow::HasContext;
use std::rc::Rc;

/// The textures that passes leave for each other.
#[derive(Default)]
pub struct Targets {
    border_map: Option<Texture>,
    depth_map: Option<Texture>,
    float_map: Option<FloatMap>,
}

impl Targets {
    /// Makes the floating-point texture where the plan draws into one and there is none of this size yet.
    pub fn prepare(&mut self, gl: &Rc<Gl>, plan: &Plan, size: Size) -> Result<()> {
        for pass in &plan.passes {
            let Target::FloatMap(bits) = pass.target else { continue };
            if !gl.info.float_targets {
                let problem = format!("{} cannot draw into floating-point textures; use biased", gl.info.renderer);
                return Err(Error::setting("--map-encoding float", problem));
            }
            if self.float_map.as_ref().is_none_or(|map| (map.size, map.bits) != (size, bits)) {
                // The old one first: at the largest sizes there is no room for two.
                self.float_map = None;
                self.float_map = Some(FloatMap::new(gl, size, bits)?);
            }
        }
        Ok(())
    }

    /// What is drawn next goes there.
    pub fn begin(&self, gl: &Gl, target: Target) -> Result<()> {
        let framebuffer = match target {
            Target::Framebuffer => None,
            Target::FloatMap(_) => match &self.float_map {
                Some(map) => Some(map.framebuffer.id),
                None => return Err(Error::gl("drawing", "a plan was carried out without being prepared")),
            },
        };
        // A driver without framebuffer objects has nothing else to draw into.
        if gl.info.float_targets {
            // SAFETY: the context is current and the framebuffer alive.
            unsafe { gl.glow.bind_framebuffer(glow::FRAMEBUFFER, framebuffer) }
        }
        Ok(())
    }

    /// Copies the framebuffer's colour.
    pub fn copy_color(&mut self, gl: &Rc<Gl>, size: Size) -> Result<()> {
        copy(gl, &mut self.border_map, legacy::RGBA, size)
    }

    /// Copies the framebuffer's depth.
    pub fn copy_depth(&mut self, gl: &Rc<Gl>, size: Size) -> Result<()> {
        copy(gl, &mut self.depth_map, glow::DEPTH_COMPONENT24, size)
    }

    /// The copy of the colour.
    pub fn border_map(&self) -> Option<&Texture> {
        self.border_map.as_ref()
    }

    /// The copy of the depth.
    pub fn depth_map(&self) -> Option<&Texture> {
        self.depth_map.as_ref()
    }

    /// The floating-point texture.
    pub fn float_map(&self) -> Option<&Texture> {
        self.float_map.as_ref().map(|map| &map.texture)
    }
}

fn copy(gl: &Rc<Gl>, texture: &mut Option<Texture>, format: u32, size: Size) -> Result<()> {
    let texture = match texture {
        Some(texture) => texture,
        None => texture.insert(Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?),
    };
    texture.bind(0);
    let (width, height) = (size.width as i32, size.height as i32);
    // SAFETY: the context is current and the texture bound; the rectangle is the whole framebuffer.
    unsafe { gl.glow.copy_tex_image_2d(glow::TEXTURE_2D, 0, format, 0, 0, width, height, 0) };
    Ok(())
}

/// A floating-point texture with a depth buffer, to draw into.
struct FloatMap {
    framebuffer: Framebuffer,
    /// Kept for the framebuffer, which draws into it.
    _depth: Renderbuffer,
    texture: Texture,
    size: Size,
    bits: FloatBits,
}

impl FloatMap {
    fn new(gl: &Rc<Gl>, size: Size, bits: FloatBits) -> Result<Self> {
        let texture = Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?;
        let format = match bits {
            FloatBits::Half => glow::RGBA16F,
            FloatBits::Single => glow::RGBA32F,
        };
        let (width, height) = (size.width as i32, size.height as i32);
        // SAFETY: the context is current, the texture just bound; no texels are given, so none are read.
        unsafe {
            let none = glow::PixelUnpackData::Slice(None);
            let (target, format) = (glow::TEXTURE_2D, format as i32);
            gl.glow.tex_image_2d(target, 0, format, width, height, 0, glow::RGBA, glow::FLOAT, none);
        }
        let (framebuffer, depth) = (Framebuffer::new(gl)?, Renderbuffer::new(gl)?);
        // SAFETY: the context is current and has framebuffer objects, as `Targets::prepare` has checked; all three are alive.
        let is_complete = unsafe {
            let gl = &gl.glow;
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(depth.id));
            gl.renderbuffer_storage(glow::RENDERBUFFER, glow::DEPTH_COMPONENT24, width, height);
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer.id));
            let color = glow::COLOR_ATTACHMENT0;
            gl.framebuffer_texture_2d(glow::FRAMEBUFFER, color, glow::TEXTURE_2D, Some(texture.id()), 0);
            let attachment = glow::DEPTH_ATTACHMENT;
            gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(depth.id));
            let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
            gl.bind_framebuffer(glow::FRAMEBUFFER, None);
            status == glow::FRAMEBUFFER_COMPLETE
        };
        gl.check("making a floating-point texture")?;
        if is_complete {
            return Ok(Self { framebuffer, _depth: depth, texture, size, bits });
        }
        let problem = format!("{} cannot draw into such a texture; use another", gl.info.renderer);
        Err(Error::setting("--map-encoding float", problem))
    }
}

/// A framebuffer object.
struct Framebuffer {
    live: Live,
    id: glow::Framebuffer,
}

impl Framebuffer {
    fn new(gl: &Rc<Gl>) -> Result<Self> {
        // SAFETY: the context is current and has framebuffer objects.
        let id = unsafe { gl.glow.create_framebuffer() }.map_err(out_of_names)?;
        Ok(Self { live: Live::new(gl), id })
    }
}

impl Drop for Framebuffer {
    fn drop(&mut self) {
        // SAFETY: the context is current and this framebuffer alive and ours.
        unsafe { self.live.gl().delete_framebuffer(self.id) }
    }
}

/// A buffer that is drawn into and never read as a texture.
struct Renderbuffer {
    live: Live,
    id: glow::Renderbuffer,
}

impl Renderbuffer {
    fn new(gl: &Rc<Gl>) -> Result<Self> {
        // SAFETY: the context is current and has framebuffer objects.
        let id = unsafe { gl.glow.create_renderbuffer() }.map_err(out_of_names)?;
        Ok(Self { live: Live::new(gl), id })
    }
}

impl Drop for Renderbuffer {
    fn drop(&mut self) {
        // SAFETY: the context is current and this buffer alive and ours.
        unsafe { self.live.gl().delete_renderbuffer(self.id) }
    }
}
