//! A framebuffer object in place of a surface, for contexts without one, as on macOS.
//!
//! Like a surface it has 8 bits of alpha and 24 of depth. It is bound wherever another context binds its own framebuffer.
//! Drawing, copying and reading back give the same results except for lines, which Mesa draws from below there; a test compares
//! by EGL.

use super::super::legacy;
use crate::scene::Size;
use glow::HasContext;

/// The framebuffer object and its attachments; it is destroyed with its context.
pub(in crate::gl) struct SurfaceFramebuffer {
    id: glow::Framebuffer,
    color: glow::Renderbuffer,
    depth: glow::Renderbuffer,
}

impl SurfaceFramebuffer {
    /// Makes a framebuffer of one pixel and binds it. The context is current; the error says why it failed.
    pub(in crate::gl) fn new(gl: &glow::Context) -> Result<Self, String> {
        // SAFETY: the context is current, and a driver without framebuffer objects reports an error instead of a name.
        let made = unsafe {
            let (id, color, depth) = (gl.create_framebuffer()?, gl.create_renderbuffer()?, gl.create_renderbuffer()?);
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(id));
            for (attachment, buffer) in [(glow::COLOR_ATTACHMENT0, color), (legacy::DEPTH_BUFFER.1, depth)] {
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(buffer));
            }
            Self { id, color, depth }
        };
        made.resize(gl, Size { width: 1, height: 1 })?;
        Ok(made)
    }

    /// Resizes it and leaves it bound; the context is current.
    pub(in crate::gl) fn resize(&self, gl: &glow::Context, size: Size) -> Result<(), String> {
        let (width, height) = (size.width as i32, size.height as i32);
        // SAFETY: the context is current, and both buffers are alive and this framebuffer's.
        let status = unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.id));
            for (format, buffer) in [(glow::RGBA8, self.color), (legacy::DEPTH_BUFFER.0, self.depth)] {
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.renderbuffer_storage(glow::RENDERBUFFER, format, width, height);
            }
            gl.check_framebuffer_status(glow::FRAMEBUFFER)
        };
        match status {
            glow::FRAMEBUFFER_COMPLETE => Ok(()),
            status => Err(format!("its framebuffer object of {size} pixels cannot be drawn into (0x{status:X})")),
        }
    }

    /// The framebuffer's name.
    pub(in crate::gl) fn id(&self) -> glow::Framebuffer {
        self.id
    }
}
