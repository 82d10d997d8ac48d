//! The position of the textures on the picture: the sizes passed to the shaders' parts.
//!
//! In: the textures and the picture's size. Out: uniforms.

use super::pictures::CharcoalTextures;
use crate::plan::{Uniform, Value};
use crate::scene::Size;

/// The textures' places.
pub(super) struct Layout {
    picture: Size,
    /// Samples along a side of one of its pixels.
    samples: u32,
    noise: Size,
    cet: Size,
    /// The shares of the textures that the picture's width and height cover.
    noise_spread: [f32; 2],
    paper_spread: [f32; 2],
}

impl Layout {
    /// The layout of these textures: stretched once over the picture, or each in its own proportions.
    pub(super) fn of(made: &CharcoalTextures, picture: Size, samples: u32, is_even: bool) -> Self {
        let spread = |texture: Size| if is_even { even(picture, texture) } else { [1.0; 2] };
        Self {
            picture,
            samples,
            noise: made.noise.size,
            cet: made.cet.size,
            noise_spread: spread(made.noise.size),
            paper_spread: spread(made.paper.size),
        }
    }

    /// Returns the uniforms of spread-* and grain-*.
    pub(super) fn places(&self) -> Vec<Uniform> {
        vec![
            vec2("noiseSpread", self.noise_spread),
            vec2("paperSpread", self.paper_spread),
            Uniform::new("samples", Value::Float(self.samples as f32)),
        ]
    }

    /// Returns the uniforms that the parts read.
    pub(super) fn uniforms(&self) -> Vec<Uniform> {
        let (picture, shorter) = (self.picture, shorter(self.picture));
        let sides = [picture.width, picture.height].map(|side| side as f32);
        // About as many texels a pixel as on the screen, where the scene's radius is about half the picture.
        let [x, y] = self.noise_spread;
        let across = [x * shorter / sides[0] * 0.5, y * shorter / sides[1] * 0.5];
        let mut uniforms = self.places();
        uniforms.extend([
            Uniform::new("cetTexel", Value::Float(1.0 / self.cet.height as f32)),
            vec2("textureUnit", sides.map(|side| 1.0 / (side * self.samples as f32))),
            Uniform::new("corner", Value::PixelPlace([0.0; 2])),
            vec2("noiseScale", across),
            vec2("noiseSize", [self.noise.width as f32, self.noise.height as f32]),
            vec2("strokeScale", sides.map(|side| side / shorter)),
        ]);
        uniforms
    }
}

fn vec2(name: &'static str, value: [f32; 2]) -> Uniform {
    Uniform::new(name, Value::Vec2(value))
}

fn shorter(picture: Size) -> f32 {
    picture.width.min(picture.height) as f32
}

/// Returns the share of a texture, along each side, that covers the picture unstretched: all of it along one side.
fn even(picture: Size, texture: Size) -> [f32; 2] {
    let pixels_a_texel =
        [f64::from(picture.width) / f64::from(texture.width), f64::from(picture.height) / f64::from(texture.height)];
    let larger = pixels_a_texel[0].max(pixels_a_texel[1]);
    pixels_a_texel.map(|pixels| (pixels / larger) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    #[test]
    fn a_texture_in_its_own_proportion_covers_the_picture_and_its_texels_stay_square() {
        assert_eq!(even(size(900, 400), size(512, 512)), [1.0, (400.0f64 / 900.0) as f32]);
        assert_eq!(even(size(300, 900), size(512, 512)), [(1.0f64 / 3.0) as f32, 1.0]);
        assert_eq!(even(size(640, 640), size(512, 512)), [1.0; 2], "nothing changes where both are square");
        assert_eq!(even(size(600, 300), size(200, 100)), [1.0; 2]);
        for (picture, texture) in [(size(900, 400), size(300, 700)), (size(31, 77), size(100, 3))] {
            let [x, y] = even(picture, texture);
            // Picture pixels per texel, along both sides.
            let across = picture.width as f32 / (x * texture.width as f32);
            let down = picture.height as f32 / (y * texture.height as f32);
            assert!((across / down - 1.0).abs() < 1e-5, "{across} {down}");
            assert!(x.max(y) == 1.0 && x.min(y) > 0.0);
        }
    }
}
