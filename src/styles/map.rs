//! The map of the cartoon styles: how normals and depth are stored between the passes (errata E6 to E8).

use crate::names::find;
use crate::plan::{FloatBits, Program, Target, Texture};
use serde::Serialize;
use std::str::FromStr;

/// How normals and depth are stored.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MapEncoding {
    /// Normals clamped to [0, 1], depth in the 8 bits of alpha: the listing's.
    #[default]
    Paper,
    /// Normals as 0.5 n + 0.5, depth in 8 bits.
    Biased,
    /// Both as they are, 16 bits each, in a floating-point target.
    Float16,
    /// The same with 32 bits.
    Float,
    /// Normals as 0.5 n + 0.5, depth from a copy of the depth buffer.
    DepthTexture,
}

impl MapEncoding {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 5] = [
        ("paper", Self::Paper),
        ("biased", Self::Biased),
        ("float16", Self::Float16),
        ("float", Self::Float),
        ("depth-texture", Self::DepthTexture),
    ];

    /// The shaders that write it.
    pub(super) fn program(self) -> Program {
        let (vertex, fragment) = match self {
            Self::Paper => ("evangelista/map.vert", "evangelista/map.frag"),
            Self::Biased | Self::DepthTexture => ("improved/map-biased.vert", "evangelista/map.frag"),
            Self::Float16 | Self::Float => ("improved/map-float.vert", "improved/map-float.frag"),
        };
        Program { vertex, fragments: vec![fragment] }
    }

    /// What a pixel of the map holds where nothing is drawn and no square either: no normal, farthest depth.
    pub(super) fn empty(self) -> [f32; 4] {
        match self {
            Self::Paper | Self::Float16 | Self::Float => [0.0, 0.0, 0.0, 1.0],
            Self::Biased | Self::DepthTexture => [0.5, 0.5, 0.5, 1.0],
        }
    }

    /// What it is written into.
    pub(super) fn target(self) -> Target {
        match self {
            Self::Paper | Self::Biased | Self::DepthTexture => Target::Framebuffer,
            Self::Float16 => Target::FloatMap(FloatBits::Half),
            Self::Float => Target::FloatMap(FloatBits::Single),
        }
    }

    /// The textures a filter reads it from.
    pub(super) fn textures(self) -> Vec<(&'static str, Texture)> {
        match self {
            Self::Paper | Self::Biased => vec![("borderMap", Texture::BorderMap)],
            Self::Float16 | Self::Float => vec![("borderMap", Texture::FloatMap)],
            Self::DepthTexture => vec![("borderMap", Texture::BorderMap), ("depthMap", Texture::DepthMap)],
        }
    }

    /// The fragment shader by which a filter reads it.
    pub(super) fn shader(self) -> &'static str {
        match self {
            Self::Paper | Self::Float16 | Self::Float => "evangelista/texel-map.frag",
            Self::Biased => "improved/texel-biased.frag",
            Self::DepthTexture => "improved/texel-depth-texture.frag",
        }
    }

    /// The step between the depths it tells apart.
    pub(super) fn depth_step(self) -> f32 {
        match self {
            Self::Paper | Self::Biased => 1.0 / 255.0,
            // The last of 11 binary digits between 0.5 and 1, where most of a scene's window depth lies.
            Self::Float16 => 1.0 / 2048.0,
            Self::Float | Self::DepthTexture => 1.0 / 16_777_216.0,
        }
    }
}

impl FromStr for MapEncoding {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}
