//! The properties that a context reports.

use crate::scene::Size;
use serde::Serialize;

/// Fewest bits of the framebuffer's alpha, which holds the map's depth.
const ALPHA_BITS: i32 = 8;

/// Smallest depth buffer, bits: with fewer, surfaces of a fitted scene show through each other.
const DEPTH_BITS: i32 = 24;

/// Sub-pixel bits that OpenGL promises.
pub(super) const LEAST_SUBPIXEL_BITS: i32 = 4;

/// Whether this GL_RENDERER draws on the processor.
pub fn is_software(renderer: &str) -> bool {
    let renderer = renderer.to_lowercase();
    ["llvmpipe", "softpipe", "swrast", "swiftshader", "software", "gdi generic"].iter().any(|n| renderer.contains(n))
}

/// The properties that a context reports.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContextInfo {
    /// `egl`, `surfaceless`, `osmesa`, `wgl` or `cgl`; in a browser `webgl`.
    pub backend: &'static str,
    /// The library, and the device if there are several.
    pub device: String,
    /// GL_VENDOR
    pub vendor: String,
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION
    pub version: String,
    /// GL_SHADING_LANGUAGE_VERSION
    pub glsl_version: String,
    /// Bits of the framebuffer's alpha, which holds the map's depth.
    pub alpha_bits: i32,
    /// Bits of the depth buffer.
    pub depth_bits: i32,
    /// Narrowest and widest line without smoothing, pixels.
    pub aliased_line_width: [f32; 2],
    /// Narrowest and widest smoothed line, pixels.
    pub smooth_line_width: [f32; 2],
    /// Smallest and largest point without smoothing, pixels.
    pub aliased_point_size: [f32; 2],
    /// Smallest and largest smoothed point, pixels.
    pub smooth_point_size: [f32; 2],
    /// Largest width and height of a texture, pixels.
    pub largest_texture: u32,
    /// Number of textures a fragment shader can read; OpenGL 2.1 promises 2.
    pub texture_units: u32,
    /// Largest picture in one piece, pixels: the smallest of viewport, texture and surface limits. Larger ones need tiles.
    pub largest_picture: Size,
    /// Largest viewport, pixels.
    pub largest_viewport: Size,
    /// Whether passes can draw into textures (ARB_framebuffer_object).
    pub framebuffer_objects: bool,
    /// Number of textures that a pass can draw into at once (ARB_draw_buffers).
    pub draw_buffers: u32,
    /// Whether passes can draw into floating-point textures.
    pub float_targets: bool,
    /// Bits of a vertex's position within a pixel; OpenGL promises 4.
    pub subpixel_bits: u32,
    /// Whether passes can be timed on the device.
    pub timer_queries: bool,
}

impl ContextInfo {
    /// Why its framebuffer lacks bits that the styles need; `None` if it has them.
    pub(super) fn lacks_bits(&self) -> Option<String> {
        (self.alpha_bits < ALPHA_BITS || self.depth_bits < DEPTH_BITS).then(|| {
            format!(
                "its framebuffer has {} alpha and {} depth bits, fewer than {ALPHA_BITS} and {DEPTH_BITS}",
                self.alpha_bits, self.depth_bits
            )
        })
    }

    /// Whether it draws on the processor, where CPU work before drawing competes with the drawing.
    pub fn is_software(&self) -> bool {
        is_software(&self.renderer)
    }

    /// Whether GL draws lines of this width without smoothing.
    pub(crate) fn draws_lines(&self, width_px: f32) -> bool {
        let [narrowest, widest] = self.aliased_line_width;
        (narrowest..=widest).contains(&width_px)
    }

    /// Whether GL draws lines, and points to join them, at this width; it draws other widths at the nearest it can.
    pub(crate) fn draws_edges(&self, width_px: f32, is_smooth: bool) -> bool {
        let ranges = match is_smooth {
            false => [self.aliased_line_width, self.aliased_point_size],
            true => [self.smooth_line_width, self.smooth_point_size],
        };
        ranges.iter().all(|[narrowest, widest]| (*narrowest..=*widest).contains(&width_px))
    }
}
