//! Draws larger than the picture and averages: edges are smooth, lines finer than a pixel.

use crate::plan::{Depth, Draw, Geometry, Pass, Plan, Program, Step, Target, Texture, Uniform, Value};
use crate::scene::Size;
use crate::settings::Setting;

tinta_geometry::choices! {
    /// The factor from the picture's sides to the drawing's.
    #[derive(Default)]
    pub enum Supersample {
        /// As large as the picture, as published.
        #[default]
        One = "1",
        /// 4 samples a pixel.
        Two = "2",
        /// 9 samples a pixel.
        Three = "3",
        /// 16 samples a pixel.
        Four = "4",
    }
}

impl Supersample {
    /// The setting's help text.
    pub(super) const HELP: &'static str = "Smooth edges: draw 1 to 4 times larger and shrink";

    /// Returns the setting of a style that always has a factor.
    pub(super) fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        Setting::field("supersample", "N", Self::HELP, field).said("1; ink --quality best: 2")
    }

    /// The factor.
    pub fn factor(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Three => 3,
            Self::Four => 4,
        }
    }

    /// Returns the size of the drawing surface for a picture of this size.
    pub(super) fn surface(self, picture: Size) -> Size {
        picture.times(self.factor())
    }

    /// Converts a plan drawn at [`Supersample::surface`]'s size into one of the picture.
    pub(super) fn finish(self, plan: Plan, picture: Size) -> Plan {
        if self == Self::One {
            return plan;
        }
        // A picture drawn into a texture is read from that texture.
        let (mut steps, samples) = match plan.picture_target() {
            Target::Framebuffer => (vec![Step::CopyFramebuffer], Texture::BorderMap),
            Target::Textures(attachments) => (Vec::new(), Texture::Drawn(attachments.colors[0].name)),
        };
        let program = Program::new("evangelista/border.vert", ["improved/box-filter.frag"]);
        let square = Draw {
            uniforms: vec![
                texture_unit(self.surface(picture)),
                Uniform::new("count", Value::Int(self.factor() as i32)),
            ],
            textures: vec![("samples", samples)],
            depth: Depth::Ignore,
            ..Draw::new(Geometry::PictureSquare, Some(program))
        };
        let mut plan = Plan { supersample: self.factor(), ..plan };
        steps.push(Step::Draw(square));
        plan.passes.push(Pass::new("shrink", steps));
        plan
    }
}

/// Returns the distance between texels of a texture of this size.
pub(super) fn texture_unit(size: Size) -> Uniform {
    Uniform::new("textureUnit", Value::texel_size(size))
}
