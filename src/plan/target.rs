//! Render targets of passes: the framebuffer, or textures by a framebuffer object.

use std::fmt;

/// The target of a pass.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Target {
    /// The framebuffer, 8 bits a channel.
    #[default]
    Framebuffer,
    /// Textures as large as the surface, with a depth buffer that all passes into textures share.
    Textures(&'static Attachments),
}

/// The textures of one framebuffer object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attachments {
    /// In the order of gl_FragData; the first holds the pass's picture.
    pub colors: &'static [Attachment],
    /// Whether it has a depth buffer.
    pub has_depth: bool,
    /// The setting that needs them, named in the error of a driver without them.
    pub asked_by: SettingValue,
    /// The alternative for such a driver.
    pub instead: SettingValue,
    /// The picture that the alternative draws, if it differs.
    pub instead_draws: Option<&'static str>,
}

/// A texture that is drawn into: RGBA, NEAREST, CLAMP_TO_EDGE. Within a plan each name has one format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attachment {
    /// The name that steps read it by.
    pub name: TextureName,
    /// The format of its channels.
    pub format: Format,
}

/// The name of a texture that is drawn into, chosen by the style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TextureName(pub &'static str);

/// A value of a setting, in the user's notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SettingValue {
    /// The setting's name.
    pub setting: &'static str,
    /// Its value.
    pub value: &'static str,
}

/// The setting that needs a copy of the depth buffer, and the alternative for drivers without one.
pub(crate) const DEPTH_COPY: [SettingValue; 2] = [
    SettingValue { setting: "map-encoding", value: "depth-texture" },
    SettingValue { setting: "map-encoding", value: "float" },
];

/// The format of the channels of a texture that is drawn into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 8 bits, from 0 to 1, as in the framebuffer.
    Unorm8,
    /// 16 bits of floating point with 11 significant bits; not clamped.
    Float16,
    /// 32 bits of floating point; not clamped.
    Float32,
}

impl Format {
    /// Whether it needs floating-point textures.
    pub(crate) fn is_float(self) -> bool {
        self != Self::Unorm8
    }
}

impl Target {
    /// Returns the texture that holds a pass's picture, the first of the target's textures; `None` for the framebuffer.
    pub(crate) fn picture(self) -> Option<TextureName> {
        match self {
            Self::Framebuffer => None,
            Self::Textures(attachments) => attachments.colors.first().map(|color| color.name),
        }
    }
}

impl Target {
    /// Returns how many colours a pass into it draws at once.
    pub(super) fn color_count(self) -> usize {
        match self {
            Self::Framebuffer => 1,
            Self::Textures(attachments) => attachments.colors.len(),
        }
    }
}

impl fmt::Display for TextureName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.0)
    }
}

impl fmt::Display for Target {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Textures(attachments) = self else { return Ok(()) };
        write!(out, ", into the texture{}", if attachments.colors.len() > 1 { "s" } else { "" })?;
        for (index, Attachment { name, format }) in attachments.colors.iter().enumerate() {
            let and = if index > 0 { " and" } else { "" };
            let bits = match format {
                Format::Unorm8 => 8,
                Format::Float16 => 16,
                Format::Float32 => 32,
            };
            write!(out, "{and} {name}, {bits} bits a channel")?;
        }
        Ok(())
    }
}
