//! How a pixel is recomputed: as exact arithmetic has it, or as a driver does.

use crate::gl::ContextInfo;
use tinta_glsl::Precision;

tinta_geometry::choices! {
    /// How textures are read between their texels.
    #[derive(Default)]
    pub enum Filtering {
        /// By real weights, as GL defines it.
        #[default]
        Exact = "exact",
        /// By weights rounded to 1/256, each mixture of two texels rounded to 8 bits: as llvmpipe reads textures of 8 bits.
        Bytes = "bytes",
    }
}

/// How a pixel is recomputed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recomputation {
    /// How floats are kept.
    pub precision: Precision,
    /// How textures are read between their texels.
    pub filtering: Filtering,
    /// Parts of a pixel, as bits, that the driver places corners at ([`crate::gl::ContextInfo::subpixel_bits`]).
    pub subpixel_bits: u32,
}

impl Recomputation {
    /// Returns how this context computes: in 32 bits, with textures and corners as its driver has them.
    pub fn like(context: &ContextInfo) -> Self {
        let filtering = if context.renderer.contains("llvmpipe") { Filtering::Bytes } else { Filtering::Exact };
        // softpipe says 4 and places corners as floats.
        let subpixel_bits = if context.renderer.contains("softpipe") { 16 } else { context.subpixel_bits };
        Self { precision: Precision::Single, filtering, subpixel_bits }
    }
}
