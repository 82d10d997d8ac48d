//! Render targets besides the framebuffer: copies of its colour and depth, and textures drawn into by
//! framebuffer objects.

mod framebuffer;

use super::context::ContextInfo;
use super::objects::Texture;
use super::{Gl, legacy};
use crate::error::{Error, Result};
use crate::plan::{Attachment, Attachments, DEPTH_COPY, Format, Plan, Sampling, Step, Target, TextureName};
use crate::scene::{Rectangle, Size};
pub(super) use framebuffer::clear_each;
use framebuffer::{DepthBuffer, Framebuffer, Renderbuffer};
use glow::HasContext;
use std::rc::Rc;

/// The textures that connect passes.
pub(super) struct Targets {
    border_map: Option<TextureCopy>,
    depth_map: Option<TextureCopy>,
    drawn: Option<TextureTargets>,
    /// Stands in for the framebuffer while depth is taken from it.
    surface: Option<TextureTargets>,
    takes_depth: bool,
    /// The target of the current pass.
    current: Target,
    /// Whether depth is copied as in OpenGL. Otherwise a copy takes the target's depth texture and leaves it another, as in a browser.
    copies_depth: bool,
}

impl Default for Targets {
    fn default() -> Self {
        Self::copying_depth(legacy::COPIES_DEPTH)
    }
}

impl Targets {
    /// Without textures, and with this way to have depth in one.
    pub(super) fn copying_depth(copies_depth: bool) -> Self {
        Self {
            border_map: None,
            depth_map: None,
            drawn: None,
            surface: None,
            takes_depth: false,
            current: Target::Framebuffer,
            copies_depth,
        }
    }
}

/// A framebuffer as a framebuffer object.
const SURFACE: Attachments = Attachments {
    colors: &[Attachment { name: TextureName("Framebuffer"), format: Format::Unorm8 }],
    has_depth: true,
    asked_by: DEPTH_COPY[0],
    instead: DEPTH_COPY[1],
    instead_draws: None,
};

impl Targets {
    /// Makes the plan's targets, unless they exist at this size.
    pub(super) fn prepare(&mut self, gl: &Rc<Gl>, plan: &Plan, size: Size) -> Result<()> {
        check(&gl.info, plan)?;
        let takes_depth = !self.copies_depth && plan.steps().any(|(_, step)| *step == Step::CopyDepth);
        if takes_depth && !gl.legacy.has_depth_textures() {
            let [asked_by, instead] = DEPTH_COPY;
            let problem =
                format!("{} has no depth textures; use --{} {}", gl.info.renderer, instead.setting, instead.value);
            return Err(Error::value(asked_by.setting, asked_by.value, problem));
        }
        self.takes_depth = takes_depth;
        if takes_depth {
            prepare(gl, &mut self.surface, size, vec![&SURFACE], true)?;
        }
        let attachments = plan.attachments();
        if attachments.is_empty() { Ok(()) } else { prepare(gl, &mut self.drawn, size, attachments, takes_depth) }
    }

    /// Makes the target current for the following draws.
    pub(super) fn begin(&mut self, gl: &Gl, target: Target) -> Result<()> {
        self.current = target;
        self.bind(gl)
    }

    fn bind(&self, gl: &Gl) -> Result<()> {
        let framebuffer = match self.current {
            Target::Framebuffer if !self.takes_depth => None,
            Target::Framebuffer => self.surface.as_ref().and_then(|surface| surface.framebuffer(&SURFACE)),
            Target::Textures(attachments) => {
                let drawn = self.drawn.as_ref().and_then(|drawn| drawn.framebuffer(attachments));
                Some(drawn.ok_or_else(|| Error::gl("drawing", "a plan was carried out without being prepared"))?)
            }
        };
        // Without framebuffer objects the framebuffer is the only target.
        if gl.info.framebuffer_objects {
            framebuffer::bind(gl, framebuffer);
        }
        Ok(())
    }

    /// Copies the framebuffer's colour, all of it or this part.
    pub(super) fn copy_color(&mut self, gl: &Rc<Gl>, size: Size, part: Option<Rectangle>) -> Result<()> {
        copy(gl, &mut self.border_map, legacy::RGBA, size, part)
    }

    /// Copies the target's depth, all of it or this part, or takes all of it.
    pub(super) fn copy_depth(&mut self, gl: &Rc<Gl>, size: Size, part: Option<Rectangle>) -> Result<()> {
        if self.copies_depth {
            return copy(gl, &mut self.depth_map, glow::DEPTH_COMPONENT24, size, part);
        }
        let of_target = match self.current {
            Target::Framebuffer => &mut self.surface,
            Target::Textures(_) => &mut self.drawn,
        };
        let spare = self.depth_map.take().filter(|(present, _)| *present == size).map(|(_, texture)| texture);
        let spare = spare.map_or_else(|| depth_texture(gl, size), Ok)?;
        let taken = of_target.as_mut().and_then(|targets| targets.take_depth(gl, spare));
        self.depth_map = taken.map(|texture| (size, texture));
        self.bind(gl)
    }

    /// The copy of the colour.
    pub(super) fn border_map(&self) -> Option<&Texture> {
        self.border_map.as_ref().map(|(_, texture)| texture)
    }

    /// The copy of the depth.
    pub(super) fn depth_map(&self) -> Option<&Texture> {
        self.depth_map.as_ref().map(|(_, texture)| texture)
    }

    /// Returns the texture of this name that a framebuffer object drew into.
    pub(super) fn drawn(&self, name: TextureName) -> Option<&Texture> {
        self.drawn.as_ref()?.textures.iter().find(|(other, ..)| *other == name).map(|(.., texture)| texture)
    }
}

/// Returns an error, with the option at fault, if this context lacks framebuffer objects, draw buffers or texture formats for a
/// plan.
pub(super) fn check(info: &ContextInfo, plan: &Plan) -> Result<()> {
    for attachments in plan.attachments() {
        let count = attachments.colors.len();
        let lack = if !info.framebuffer_objects {
            "has no framebuffer objects (ARB_framebuffer_object)".to_owned()
        } else if count > info.draw_buffers as usize {
            format!("draws into {} buffer at once, not {count} (ARB_draw_buffers)", info.draw_buffers)
        } else if !info.float_targets && attachments.colors.iter().any(|color| color.format.is_float()) {
            "cannot draw into floating-point textures (ARB_texture_float)".to_owned()
        } else {
            continue;
        };
        return Err(refused(info, attachments, &lack));
    }
    Ok(())
}

fn refused(info: &ContextInfo, attachments: &Attachments, lack: &str) -> Error {
    let Attachments { asked_by, instead, .. } = attachments;
    let draws = attachments.instead_draws.map(|what| format!(", which draws {what}")).unwrap_or_default();
    let problem = format!("{} {lack}; use --{} {}{draws}", info.renderer, instead.setting, instead.value);
    Error::value(asked_by.setting, asked_by.value, problem)
}

/// A texture copied from a framebuffer of this size.
type TextureCopy = (Size, Texture);

fn copy(gl: &Rc<Gl>, copied: &mut Option<TextureCopy>, format: u32, size: Size, part: Option<Rectangle>) -> Result<()> {
    let (width, height) = (size.width as i32, size.height as i32);
    if let (Some((present, texture)), Some(part)) = (&copied, part)
        && *present == size
    {
        texture.bind(0);
        let [x, y, width, height] = [part.x, part.y, part.width, part.height].map(|number| number as i32);
        // SAFETY: the context is current and the texture bound; the part lies within the framebuffer and the texture, which
        // are of one size.
        unsafe { gl.glow.copy_tex_sub_image_2d(glow::TEXTURE_2D, 0, x, y, x, y, width, height) };
        return Ok(());
    }
    let (present, texture) = match copied {
        Some(copied) => copied,
        None => copied.insert((size, Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?)),
    };
    *present = size;
    texture.bind(0);
    // SAFETY: the context is current and the texture bound; the rectangle is the whole framebuffer.
    unsafe { gl.glow.copy_tex_image_2d(glow::TEXTURE_2D, 0, format, 0, 0, width, height, 0) };
    Ok(())
}

/// Makes targets with these attachments, unless they exist at this size.
fn prepare(
    gl: &Rc<Gl>,
    targets: &mut Option<TextureTargets>,
    size: Size,
    attachments: Vec<&'static Attachments>,
    reads_depth: bool,
) -> Result<()> {
    let is_there = |targets: &TextureTargets| {
        targets.size == size && targets.attachments == attachments && targets.reads_depth == reads_depth
    };
    if targets.as_ref().is_some_and(is_there) {
        return Ok(());
    }
    // Drop the old targets first: at the largest sizes the memory cannot hold both.
    *targets = None;
    *targets = Some(TextureTargets::new(gl, size, attachments, reads_depth)?);
    Ok(())
}

/// The textures a plan's passes draw into, one per name, and the framebuffer objects that share them and a depth buffer.
struct TextureTargets {
    size: Size,
    attachments: Vec<&'static Attachments>,
    /// Whether their depth is a texture.
    reads_depth: bool,
    /// One for each of `attachments`; dropped before the textures they draw into.
    framebuffers: Vec<Framebuffer>,
    textures: Vec<(TextureName, Format, Texture)>,
    depth: Option<DepthBuffer>,
}

impl TextureTargets {
    fn new(gl: &Rc<Gl>, size: Size, attachments: Vec<&'static Attachments>, reads_depth: bool) -> Result<Self> {
        let mut textures: Vec<(TextureName, Format, Texture)> = Vec::new();
        for color in attachments.iter().flat_map(|attachments| attachments.colors) {
            match textures.iter().find(|(name, ..)| *name == color.name) {
                None => textures.push((color.name, color.format, empty_texture(gl, size, color.format)?)),
                Some((_, format, _)) if *format == color.format => {}
                Some(_) => return Err(Error::gl("setting up", "a plan draws into one texture in two formats")),
            }
        }
        let needs_depth = attachments.iter().any(|attachments| attachments.has_depth);
        let depth = match (needs_depth, reads_depth) {
            (false, _) => None,
            (true, false) => Some(DepthBuffer::Unread(Renderbuffer::depth(gl, size)?)),
            (true, true) => Some(DepthBuffer::Texture(depth_texture(gl, size)?)),
        };
        let texture = |name| textures.iter().find(|(other, ..)| *other == name).map(|(.., texture)| texture);
        let mut framebuffers = Vec::new();
        for attachments in &attachments {
            let colors: Vec<&Texture> = attachments.colors.iter().filter_map(|color| texture(color.name)).collect();
            let framebuffer = Framebuffer::new(gl, &colors, depth.as_ref().filter(|_| attachments.has_depth))?;
            gl.check("making a framebuffer object")?;
            if !framebuffer.is_complete() {
                return Err(refused(&gl.info, attachments, "cannot draw into such textures"));
            }
            framebuffers.push(framebuffer);
        }
        Ok(Self { size, attachments, reads_depth, framebuffers, textures, depth })
    }

    /// Gives the framebuffers another depth texture; returns the former one, with all that was drawn into it.
    fn take_depth(&mut self, gl: &Gl, spare: Texture) -> Option<Texture> {
        for (attachments, framebuffer) in self.attachments.iter().zip(&self.framebuffers) {
            if attachments.has_depth {
                framebuffer.attach_depth(gl, &spare);
            }
        }
        match self.depth.replace(DepthBuffer::Texture(spare)) {
            Some(DepthBuffer::Texture(taken)) => Some(taken),
            _ => None,
        }
    }

    fn framebuffer(&self, attachments: &Attachments) -> Option<&Framebuffer> {
        let place = self.attachments.iter().position(|other| *other == attachments)?;
        self.framebuffers.get(place)
    }
}

fn empty_texture(gl: &Rc<Gl>, size: Size, format: Format) -> Result<Texture> {
    let texture = Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?;
    let [bytes, halves, floats] = legacy::DRAWN_TEXELS;
    let (format, kind) = match format {
        Format::Unorm8 => bytes,
        Format::Float16 => halves,
        Format::Float32 => floats,
    };
    let (width, height) = (size.width as i32, size.height as i32);
    // SAFETY: the context is current, the texture just bound; the null pointer makes GL read no texels.
    unsafe {
        let none = glow::PixelUnpackData::Slice(None);
        let (target, format) = (glow::TEXTURE_2D, format as i32);
        gl.glow.tex_image_2d(target, 0, format, width, height, 0, glow::RGBA, kind, none);
    }
    Ok(texture)
}

/// An empty texture that is a depth buffer of 24 bits.
fn depth_texture(gl: &Rc<Gl>, size: Size) -> Result<Texture> {
    let texture = Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?;
    let [internal, format, kind] = legacy::DEPTH_TEXELS;
    let (width, height) = (size.width as i32, size.height as i32);
    // SAFETY: the context is current, the texture just bound; the null pointer makes GL read no texels.
    unsafe {
        let none = glow::PixelUnpackData::Slice(None);
        gl.glow.tex_image_2d(glow::TEXTURE_2D, 0, internal as i32, width, height, 0, format, kind, none);
    }
    Ok(texture)
}

#[cfg(test)]
mod tests;
