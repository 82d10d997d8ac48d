//! Probes whether a driver follows OpenGL where the styles depend on it: alpha, copies, polygon offset, smoothed lines.
//!
//! In: a current context with a surface of [`SIDE`] pixels. Out: a [`Probe`] with counts for each feature.

use super::Gl;
use super::immediate::{Places, Vertices};
use super::legacy::{self, MODELVIEW, PROJECTION, QUADS};
use super::objects::Texture;
use crate::error::{Error, Result};
use crate::plan::Sampling;
use glow::HasContext;
use serde::Serialize;
use std::rc::Rc;

/// Width and height of the surface, pixels.
pub(crate) const SIDE: u32 = 64;

/// Columns of different colours, or depths, that test copies.
const COLUMNS: i32 = 16;

/// Least and most ink of a smoothed line, as a share of its length times its width: drivers weight pixels differently, and may or
/// may not count its ends.
const LINE_SHARE: [f64; 2] = [0.8, 1.25];

/// A test of a driver, and its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Probe {
    /// The probed feature.
    pub name: &'static str,
    /// Whether the driver passed.
    pub passed: bool,
    /// The counts.
    pub counted: String,
}

impl Probe {
    fn none_of(name: &'static str, wrong: usize, all: usize, what: &str) -> Self {
        Self { name, passed: wrong == 0, counted: format!("{wrong} of {all} {what} wrong") }
    }
}

/// Runs all probes.
pub(crate) fn probes(gl: &Rc<Gl>) -> Result<Vec<Probe>> {
    let side = SIDE as i32;
    // SAFETY: the context is current and in its initial state, except for the viewport.
    unsafe {
        gl.legacy.load_matrix(MODELVIEW, &glam::Mat4::IDENTITY);
        gl.legacy.load_matrix(PROJECTION, &glam::Mat4::IDENTITY);
        for feature in [glow::BLEND, glow::CULL_FACE, glow::SCISSOR_TEST, glow::TEXTURE_2D, glow::DITHER] {
            gl.glow.disable(feature);
        }
        gl.glow.bind_framebuffer(glow::FRAMEBUFFER, gl.own_framebuffer());
        gl.glow.use_program(None);
        gl.glow.viewport(0, 0, side, side);
        gl.glow.color_mask(true, true, true, true);
        gl.glow.depth_mask(true);
    }
    let found = vec![alpha(gl), color_copy(gl)?, depth_copy(gl)?, polygon_offset(gl)?, smooth_line(gl)?];
    gl.check("probing the driver")?;
    Ok(found)
}

/// The surface's pixels, RGBA, bottom row first.
fn pixels(gl: &Gl) -> Vec<u8> {
    let mut pixels = vec![0; (SIDE * SIDE * 4) as usize];
    // SAFETY: the context is current, and the buffer has room for the bytes.
    unsafe {
        let into = glow::PixelPackData::Slice(Some(&mut pixels));
        gl.glow.read_pixels(0, 0, SIDE as i32, SIDE as i32, glow::RGBA, glow::UNSIGNED_BYTE, into);
    }
    pixels
}

/// Each of the 256 alphas reads back as the value it was cleared to.
fn alpha(gl: &Gl) -> Probe {
    let comes_back = |value: &u8| {
        // SAFETY: the context is current.
        unsafe {
            gl.glow.clear_color(0.0, 0.0, 0.0, f32::from(*value) / 255.0);
            gl.glow.clear(glow::COLOR_BUFFER_BIT);
        }
        pixels(gl).chunks_exact(4).all(|pixel| pixel[3] == *value)
    };
    Probe::none_of("8-bit alpha", (0..=u8::MAX).filter(|value| !comes_back(value)).count(), 256, "values are")
}

/// Clears columns, each to a different shade of colour or depth.
fn clear_columns(gl: &Gl, clear: impl Fn(u8)) {
    let width = SIDE as i32 / COLUMNS;
    // SAFETY: the context is current.
    unsafe { gl.glow.enable(glow::SCISSOR_TEST) };
    for column in 0..COLUMNS {
        // SAFETY: as above.
        unsafe { gl.glow.scissor(column * width, 0, width, SIDE as i32) };
        clear((column * 17) as u8);
    }
    // SAFETY: as above.
    unsafe { gl.glow.disable(glow::SCISSOR_TEST) };
}

/// Returns a texture's contents after copying the whole surface into it.
fn copied(gl: &Rc<Gl>, format: u32, bytes_per_pixel: u32) -> Result<Vec<u8>> {
    let texture = Texture::new(gl, glow::TEXTURE_2D, Sampling::NearestClamped)?;
    texture.bind(0);
    let side = SIDE as i32;
    let mut texels = vec![0; (SIDE * SIDE * bytes_per_pixel) as usize];
    // SAFETY: the context is current and the texture bound; there is room for as many bytes.
    unsafe {
        gl.glow.copy_tex_image_2d(glow::TEXTURE_2D, 0, format, 0, 0, side, side, 0);
        gl.legacy.read_texture(&gl.glow, texture.id(), [side; 2], bytes_per_pixel == 1, &mut texels);
    }
    Ok(texels)
}

fn color_copy(gl: &Rc<Gl>) -> Result<Probe> {
    clear_columns(gl, |shade| {
        let part = |number: u8| f32::from(number) / 255.0;
        // SAFETY: the context is current.
        unsafe {
            gl.glow.clear_color(part(shade), part(255 - shade), part(shade / 2), part(shade));
            gl.glow.clear(glow::COLOR_BUFFER_BIT);
        }
    });
    let (drawn, copied) = (pixels(gl), copied(gl, legacy::RGBA, 4)?);
    let wrong = drawn.iter().zip(&copied).filter(|(drawn, copied)| drawn != copied).count();
    Ok(Probe::none_of("texture copies of colour", wrong, copied.len(), "bytes are"))
}

fn depth_copy(gl: &Rc<Gl>) -> Result<Probe> {
    clear_columns(gl, |shade| {
        // SAFETY: the context is current.
        unsafe {
            gl.glow.clear_depth(f64::from(shade) / 255.0);
            gl.glow.clear(glow::DEPTH_BUFFER_BIT);
        }
    });
    let texels = copied(gl, glow::DEPTH_COMPONENT24, 1)?;
    let column = |place: usize| (place as u32 % SIDE / (SIDE / COLUMNS as u32)) as u8;
    // 24 bits are read as 8; drivers may truncate or round.
    let is_wrong = |(place, texel): &(usize, &u8)| texel.abs_diff(column(*place) * 17) > 1;
    let wrong = texels.iter().enumerate().filter(is_wrong).count();
    Ok(Probe::none_of("texture copies of depth", wrong, texels.len(), "texels are"))
}

/// Draws vertices in clip space in one colour.
fn draw(gl: &Gl, mode: u32, places: &[[f32; 4]], color: [f32; 4]) -> Result<()> {
    let immediate =
        gl.immediate.as_ref().map_err(|name| Error::gl("probing the driver", format!("it has no {name}")))?;
    let indices: Vec<u32> = (0..places.len() as u32).collect();
    // SAFETY: the context is current, and every index is one of a place.
    unsafe {
        gl.legacy.color(color);
        immediate.send(&Vertices::new(mode, Places::Clip(places), &indices));
    }
    Ok(())
}

/// A steep square drawn with an offset lies everywhere behind the same square without one; with no offset, nowhere.
fn polygon_offset(gl: &Gl) -> Result<Probe> {
    const SQUARE: [[f32; 4]; 4] =
        [[-1.0, -1.0, -0.9, 1.0], [1.0, -1.0, 0.7, 1.0], [1.0, 1.0, 0.9, 1.0], [-1.0, 1.0, -0.7, 1.0]];
    let mut behind = [0; 2];
    for (count, offset) in behind.iter_mut().zip([true, false]) {
        // SAFETY: the context is current.
        unsafe {
            gl.glow.clear_color(0.0, 0.0, 0.0, 0.0);
            gl.glow.clear_depth(1.0);
            gl.glow.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.glow.enable(glow::DEPTH_TEST);
            gl.glow.depth_func(glow::LESS);
            gl.glow.polygon_offset(1.0, 1.0);
            if offset {
                gl.glow.enable(glow::POLYGON_OFFSET_FILL);
            }
        }
        draw(gl, QUADS, &SQUARE, [1.0, 0.0, 0.0, 1.0])?;
        // SAFETY: as above.
        unsafe { gl.glow.disable(glow::POLYGON_OFFSET_FILL) };
        draw(gl, QUADS, &SQUARE, [0.0, 1.0, 0.0, 1.0])?;
        // SAFETY: as above.
        unsafe { gl.glow.disable(glow::DEPTH_TEST) };
        *count = pixels(gl).chunks_exact(4).filter(|pixel| pixel[..2] == [0, 255]).count();
    }
    let all = (SIDE * SIDE) as usize;
    let counted = format!("{} of {all} pixels behind with an offset, {} without", behind[0], behind[1]);
    Ok(Probe { name: "polygon offset", passed: behind == [all, 0], counted })
}

/// A slanted line one pixel wide has partly covered pixels, and its total ink equals its length.
fn smooth_line(gl: &Gl) -> Result<Probe> {
    const ENDS: [[f32; 4]; 2] = [[-0.75, -0.5, 0.0, 1.0], [0.75, 0.25, 0.0, 1.0]];
    // SAFETY: the context is current.
    unsafe {
        gl.glow.clear_color(0.0, 0.0, 0.0, 0.0);
        gl.glow.clear(glow::COLOR_BUFFER_BIT);
        gl.glow.enable(glow::LINE_SMOOTH);
        gl.glow.enable(glow::BLEND);
        gl.glow.blend_func(glow::SRC_ALPHA, glow::ONE_MINUS_SRC_ALPHA);
        gl.glow.line_width(1.0);
    }
    draw(gl, glow::LINES, &ENDS, [1.0; 4])?;
    // SAFETY: as above.
    unsafe {
        gl.glow.disable(glow::LINE_SMOOTH);
        gl.glow.disable(glow::BLEND);
    }
    let ink: Vec<u8> = pixels(gl).chunks_exact(4).map(|pixel| pixel[0]).collect();
    let partly = ink.iter().filter(|ink| (1..255).contains(*ink)).count();
    let sum: f64 = ink.iter().map(|ink| f64::from(*ink) / 255.0).sum();
    let across = |axis: usize| f64::from(ENDS[1][axis] - ENDS[0][axis]) * f64::from(SIDE) / 2.0;
    let share = sum / across(0).hypot(across(1));
    let passed = partly > 0 && (LINE_SHARE[0]..=LINE_SHARE[1]).contains(&share);
    let counted = format!("{partly} pixels partly covered, {share:.2} of the line's area in all");
    Ok(Probe { name: "smoothed lines", passed, counted })
}
