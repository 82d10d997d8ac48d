//! Framebuffer objects and renderbuffers with one owner each.

use super::super::objects::{Live, Texture, out_of_names};
use super::super::{Gl, legacy};
use crate::error::Result;
use crate::scene::Size;
use glow::HasContext;
use std::rc::Rc;

/// A framebuffer object.
pub(super) struct Framebuffer {
    live: Live,
    id: glow::Framebuffer,
}

/// Makes this framebuffer the target of draws and the source of copies and read-back; `None` is the context's own.
pub(super) fn bind(gl: &Gl, framebuffer: Option<&Framebuffer>) {
    // SAFETY: the context is current and has framebuffer objects; this one is alive.
    unsafe {
        let id = framebuffer.map_or(gl.own_framebuffer(), |framebuffer| Some(framebuffer.id));
        gl.glow.bind_framebuffer(glow::FRAMEBUFFER, id)
    }
}

/// Clears each of the bound framebuffer's textures to its given colour, and depth to 1.
pub(crate) fn clear_each(gl: &Gl, colors: &[[f32; 4]]) {
    for (index, [red, green, blue, alpha]) in colors.iter().enumerate() {
        let mut buffers = vec![glow::NONE; colors.len()];
        buffers[index] = glow::COLOR_ATTACHMENT0 + index as u32;
        let depth = if index == 0 { glow::DEPTH_BUFFER_BIT } else { 0 };
        // SAFETY: the context is current and has as many draw buffers as the bound framebuffer has colours, as
        // `Targets::prepare` has checked. Clearing obeys the masks, so both are opened.
        unsafe {
            gl.legacy.draw_buffers(&gl.glow, &buffers);
            gl.glow.depth_mask(true);
            gl.glow.clear_color(*red, *green, *blue, *alpha);
            gl.glow.clear_depth(1.0);
            gl.glow.clear(glow::COLOR_BUFFER_BIT | depth);
        }
    }
    draw_into_all(gl, colors.len());
}

/// Lets the bound framebuffer's program write all of its colours.
fn draw_into_all(gl: &Gl, count: usize) {
    let buffers: Vec<u32> = (0..count as u32).map(|index| glow::COLOR_ATTACHMENT0 + index).collect();
    // SAFETY: the context is current and has as many draw buffers, as `Targets::prepare` has checked.
    unsafe { gl.legacy.draw_buffers(&gl.glow, &buffers) }
}

impl Framebuffer {
    /// Makes a framebuffer of these textures and this depth buffer, all of one size.
    pub(super) fn new(gl: &Rc<Gl>, colors: &[&Texture], depth: Option<&DepthBuffer>) -> Result<Self> {
        // SAFETY: the context is current and has framebuffer objects, as `Targets::prepare` has checked.
        let id = unsafe { gl.glow.create_framebuffer() }.map_err(out_of_names)?;
        let framebuffer = Self { live: Live::new(gl), id };
        bind(gl, Some(&framebuffer));
        // SAFETY: as above; the textures and the depth buffer are alive.
        unsafe {
            for (index, texture) in (0..).zip(colors) {
                let attachment = glow::COLOR_ATTACHMENT0 + index;
                let texture = Some(texture.id());
                gl.glow.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, texture, 0);
            }
            if let Some(DepthBuffer::Unread(depth)) = depth {
                let (attachment, kind) = (legacy::DEPTH_BUFFER.1, glow::RENDERBUFFER);
                gl.glow.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, kind, Some(depth.id));
            }
        }
        if let Some(DepthBuffer::Texture(texture)) = depth {
            framebuffer.attach_depth(gl, texture);
        }
        if colors.len() > 1 {
            draw_into_all(gl, colors.len());
        }
        bind(gl, None);
        Ok(framebuffer)
    }

    /// Draws depth into this texture from now on, and leaves the framebuffer bound.
    pub(super) fn attach_depth(&self, gl: &Gl, texture: &Texture) {
        bind(gl, Some(self));
        let (attachment, id) = (legacy::DEPTH_BUFFER.1, Some(texture.id()));
        // SAFETY: the context is current, this framebuffer and the texture are alive and of one size.
        unsafe { gl.glow.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, id, 0) };
    }

    /// Whether the driver can draw into these attachments.
    pub(super) fn is_complete(&self) -> bool {
        // SAFETY: the context is current, this framebuffer alive; the context's own is bound again.
        unsafe {
            let gl = self.live.gl();
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.id));
            let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
            gl.bind_framebuffer(glow::FRAMEBUFFER, self.live.own_framebuffer());
            status == glow::FRAMEBUFFER_COMPLETE
        }
    }
}

impl Drop for Framebuffer {
    fn drop(&mut self) {
        // SAFETY: the context is current and this framebuffer alive and ours.
        unsafe { self.live.gl().delete_framebuffer(self.id) }
    }
}

/// The depth buffer of framebuffer objects.
pub(super) enum DepthBuffer {
    /// Never read. Kept for the framebuffers, which draw into it.
    Unread(Renderbuffer),
    /// Read by later draws.
    Texture(Texture),
}

/// A buffer for drawing that is never read as a texture.
pub(super) struct Renderbuffer {
    live: Live,
    id: glow::Renderbuffer,
}

impl Renderbuffer {
    /// Makes a buffer with 24 bits of depth, as in the framebuffer.
    pub(super) fn depth(gl: &Rc<Gl>, size: Size) -> Result<Self> {
        // SAFETY: the context is current and has framebuffer objects, as `Targets::prepare` has checked.
        let id = unsafe { gl.glow.create_renderbuffer() }.map_err(out_of_names)?;
        let buffer = Self { live: Live::new(gl), id };
        let (width, height) = (size.width as i32, size.height as i32);
        // SAFETY: as above; the buffer is alive.
        unsafe {
            gl.glow.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer.id));
            gl.glow.renderbuffer_storage(glow::RENDERBUFFER, legacy::DEPTH_BUFFER.0, width, height);
        }
        Ok(buffer)
    }
}

impl Drop for Renderbuffer {
    fn drop(&mut self) {
        // SAFETY: the context is current and this buffer alive and ours.
        unsafe { self.live.gl().delete_renderbuffer(self.id) }
    }
}
