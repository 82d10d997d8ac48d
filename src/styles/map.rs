//! The map of the cartoon styles: how normals and depth are stored between the passes (errata E6 to E8).

use crate::plan::{Attachment, Attachments, Format, Paint, Program, SettingValue, Target, Texture, TextureName};
use crate::settings::Setting;

tinta_geometry::choices! {
    /// How normals and depth are stored.
    #[derive(Default)]
    pub enum MapEncoding {
        /// Normals clamped to [0, 1], depth in the 8 bits of alpha: the listing's.
        #[default]
        Published = "paper",
        /// Normals as 0.5 n + 0.5, depth in 8 bits.
        Biased = "biased",
        /// Both unencoded, 16 bits each, in a floating-point target.
        Float16 = "float16",
        /// The same with 32 bits.
        Float = "float",
        /// Normals as 0.5 n + 0.5, depth from a copy of the depth buffer.
        DepthTexture = "depth-texture",
        /// Normals as 0.5 n + 0.5 and, instead of depth, a number for each object and material: the map of Mitchell 2002, whose
        /// filter sees where two objects touch.
        Numbers = "numbers",
    }
}

impl MapEncoding {
    /// The setting's help text.
    pub(super) const HELP: &'static str = "Storage of normals and depth: paper, biased (0.5 n + 0.5), float16, float, \
         depth-texture (biased, depth from the depth buffer), numbers (biased, objects' numbers instead of depth); mrt has paper only";

    /// Returns the shaders that write it.
    pub(super) fn program(self) -> Program {
        let (vertex, fragment) = match self {
            Self::Published => ("evangelista/map.vert", "evangelista/map.frag"),
            Self::Biased | Self::DepthTexture => ("improved/map-biased.vert", "evangelista/map.frag"),
            Self::Float16 | Self::Float => ("improved/map-float.vert", "improved/map-float.frag"),
            Self::Numbers => ("improved/map-numbers.vert", "improved/map-numbers.frag"),
        };
        Program::new(vertex, [fragment])
    }

    /// What the objects are drawn in.
    pub(super) fn paint(self) -> Paint {
        if self == Self::Numbers { Paint::Numbers } else { Paint::Materials }
    }

    /// The map's value for a pixel that neither object nor square covers: no normal, farthest depth.
    pub(super) fn empty(self) -> [f32; 4] {
        match self {
            Self::Published | Self::Float16 | Self::Float => [0.0, 0.0, 0.0, 1.0],
            Self::Biased | Self::DepthTexture | Self::Numbers => [0.5, 0.5, 0.5, 1.0],
        }
    }

    /// The map's value under the background square: its normal in eye space, and the depth of the far plane.
    pub(super) fn background(self) -> [f32; 4] {
        match self {
            Self::Published | Self::Float16 | Self::Float => [0.0, 0.0, 1.0, 1.0],
            Self::Biased | Self::DepthTexture | Self::Numbers => [0.5, 0.5, 1.0, 1.0],
        }
    }

    /// The target that the map is written into.
    pub(super) fn target(self, map_target: MapTarget) -> Target {
        match self {
            Self::Float16 => Target::Textures(&FLOAT16_MAP),
            Self::Float => Target::Textures(&FLOAT_MAP),
            Self::Published | Self::Biased | Self::DepthTexture | Self::Numbers => map_target.target(),
        }
    }

    /// Returns the textures that a filter reads it from.
    pub(super) fn textures(self, map_target: MapTarget) -> Vec<(&'static str, Texture)> {
        let mut textures = vec![("borderMap", map_texture(self.target(map_target)))];
        if self == Self::DepthTexture {
            textures.push(("depthMap", Texture::DepthMap));
        }
        textures
    }

    /// The fragment shader that lets a filter read the map.
    pub(super) fn shader(self) -> &'static str {
        match self {
            Self::Published | Self::Float16 | Self::Float => "evangelista/texel-map.frag",
            Self::Biased | Self::Numbers => "improved/texel-biased.frag",
            Self::DepthTexture => "improved/texel-depth-texture.frag",
        }
    }

    /// Returns the smallest step of its depths.
    pub(super) fn depth_step(self) -> f32 {
        match self {
            Self::Published | Self::Biased | Self::Numbers => 1.0 / 255.0,
            // The last of 11 binary digits between 0.5 and 1, where most of a scene's window depth lies.
            Self::Float16 => 1.0 / 2048.0,
            Self::Float | Self::DepthTexture => 1.0 / 16_777_216.0,
        }
    }
}

tinta_geometry::choices! {
    /// How the map gets from the pass that draws it to the one that reads it.
    #[derive(Default)]
    pub enum MapTarget {
        /// Drawn into the framebuffer and copied into a texture: the listing's.
        #[default]
        Copy = "copy",
        /// Drawn into a texture by a framebuffer object; maps in floating point always are.
        Texture = "texture",
    }
}

impl MapTarget {
    /// Returns the setting of a style that has one.
    pub(super) fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let help = "Copy the map into its texture (copy) or draw it there with a framebuffer object (texture); \
                    pictures differ by rounding only; mrt always draws it there";
        Setting::field("map-target", "HOW", help, field)
    }

    /// The target of a map with 8 bits per channel.
    pub(super) fn target(self) -> Target {
        match self {
            Self::Copy => Target::Framebuffer,
            Self::Texture => Target::Textures(&MAP),
        }
    }
}

/// The texture that holds a map drawn into this target.
pub(super) fn map_texture(target: Target) -> Texture {
    match target {
        Target::Framebuffer => Texture::BorderMap,
        Target::Textures(_) => Texture::Drawn(MAP_TEXTURE),
    }
}

/// Normals and depth.
pub(super) const MAP_TEXTURE: TextureName = TextureName("Map");

const MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Unorm8 }],
    has_depth: true,
    asked_by: SettingValue { setting: "map-target", value: "texture" },
    instead: SettingValue { setting: "map-target", value: "copy" },
    instead_draws: None,
};

const FLOAT16_MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Float16 }],
    has_depth: true,
    asked_by: SettingValue { setting: "map-encoding", value: "float16" },
    instead: SettingValue { setting: "map-encoding", value: "biased" },
    instead_draws: None,
};

const FLOAT_MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Float32 }],
    asked_by: SettingValue { setting: "map-encoding", value: "float" },
    ..FLOAT16_MAP
};
