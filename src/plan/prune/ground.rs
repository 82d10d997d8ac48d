//! Skips filters over pixels that hold a single value, where they find nothing.

use crate::plan::{Blend, Depth, Draw, Geometry, Step, Target, Texture};
use crate::scene::Rectangle;

/// What of a plan holds one value wherever no object reaches, as far as its steps have been followed.
#[derive(Default)]
pub(super) struct Ground {
    /// Of these colours all that is outside the objects is the same.
    colors: Vec<Place>,
    /// Of these depth buffers likewise.
    depths: Vec<DepthBuffer>,
}

/// Where colours are.
#[derive(PartialEq, Eq, Clone, Copy)]
enum Place {
    Framebuffer,
    Texture(Texture),
}

/// The two depth buffers of a plan: the framebuffer's, and that of all passes into textures.
#[derive(PartialEq, Eq, Clone, Copy)]
enum DepthBuffer {
    Framebuffer,
    Textures,
}

impl Ground {
    /// Whether all textures that a draw reads and passes leave are even.
    pub(super) fn is_even_for(&self, draw: &Draw) -> bool {
        let is_of_passes =
            |texture: &Texture| matches!(texture, Texture::BorderMap | Texture::DepthMap | Texture::Drawn(_));
        draw.textures
            .iter()
            .filter(|(_, texture)| is_of_passes(texture))
            .all(|(_, texture)| self.colors.contains(&Place::Texture(*texture)))
    }

    /// Follows one step of a pass that draws into this target, within these pixels.
    pub(super) fn follow(&mut self, step: &Step, target: Target, scissor: Option<Rectangle>) {
        let places = places(target);
        let depth_buffer = match target {
            Target::Framebuffer => DepthBuffer::Framebuffer,
            Target::Textures(_) => DepthBuffer::Textures,
        };
        let is_even = places.first().is_some_and(|place| self.colors.contains(place));
        let is_depth_even = self.depths.contains(&depth_buffer);
        match step {
            Step::Clear { color, depth } => {
                if color.is_some() {
                    self.set_colors(&places, scissor.is_none());
                }
                if *depth {
                    self.set_depth(depth_buffer, scissor.is_none());
                }
            }
            Step::ClearEach { .. } => {
                self.set_colors(&places, scissor.is_none());
                self.set_depth(depth_buffer, scissor.is_none());
            }
            Step::CopyFramebuffer => {
                self.set_colors(&[Place::Texture(Texture::BorderMap)], is_even && scissor.is_none());
            }
            Step::CopyDepth => {
                self.set_colors(&[Place::Texture(Texture::DepthMap)], is_depth_even && scissor.is_none());
            }
            Step::Draw(draw) if stays_in_objects(draw) || draw.facts.adds_nothing.is_some() => {}
            Step::Draw(draw) => {
                let is_constant = draw.facts.constant_color.is_some() && covers(draw) && scissor.is_none();
                self.set_colors(&places, is_constant && places.len() == 1);
                if draw.depth == Depth::TestAndWrite {
                    self.set_depth(depth_buffer, false);
                }
            }
        }
    }

    fn set_colors(&mut self, places: &[Place], is_even: bool) {
        self.colors.retain(|place| !places.contains(place));
        if is_even {
            self.colors.extend(places);
        }
    }

    fn set_depth(&mut self, buffer: DepthBuffer, is_even: bool) {
        self.depths.retain(|other| *other != buffer);
        if is_even {
            self.depths.push(buffer);
        }
    }
}

fn places(target: Target) -> Vec<Place> {
    match target {
        Target::Framebuffer => vec![Place::Framebuffer],
        Target::Textures(attachments) => {
            let texture = |color: &crate::plan::Attachment| Place::Texture(Texture::Drawn(color.name));
            attachments.colors.iter().map(texture).collect()
        }
    }
}

/// Whether a draw changes pixels only where the camera has objects.
pub(super) fn stays_in_objects(draw: &Draw) -> bool {
    draw.is_of_objects() && draw.keeps_places()
}

/// Whether a draw is a square that gives every pixel a colour, whatever was there.
pub(super) fn covers(draw: &Draw) -> bool {
    matches!(draw.geometry, Geometry::ScreenSquare | Geometry::BackgroundSquare { .. })
        && draw.depth == Depth::Ignore
        && draw.blend == Blend::Replace
        && draw.scissor.is_none()
        && draw.keeps_places()
        && draw.keeps_pixels()
}
