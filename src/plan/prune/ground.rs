//! Skips filters over pixels that hold a single value, where they find nothing.

use crate::plan::{Blend, Depth, Draw, Geometry, Step, Target, Texture, WhereEven};
use crate::scene::Rectangle;

/// The parts of a plan that hold one value wherever no object is near, after the steps followed so far.
#[derive(Default)]
pub(super) struct Ground {
    /// The colours that are uniform farther than this many pixels from the objects.
    colors: Vec<(Place, u32)>,
    /// The depth buffers, likewise.
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
    /// Returns the distance from the objects, in pixels, beyond which all textures of passes that a draw reads are uniform;
    /// `None` if one of them may be uniform nowhere.
    pub(super) fn even_beyond(&self, draw: &Draw) -> Option<u32> {
        let is_of_passes =
            |texture: &Texture| matches!(texture, Texture::BorderMap | Texture::DepthMap | Texture::Drawn(_));
        draw.textures
            .iter()
            .filter(|(_, texture)| is_of_passes(texture))
            .map(|(_, texture)| self.color_beyond(&Place::Texture(*texture)))
            .try_fold(0, |farthest, beyond| Some(farthest.max(beyond?)))
    }

    fn color_beyond(&self, place: &Place) -> Option<u32> {
        self.colors.iter().find(|(other, _)| other == place).map(|(_, beyond)| *beyond)
    }

    /// Follows one step of a pass that draws into this target, within these pixels.
    pub(super) fn follow(&mut self, step: &Step, target: Target, scissor: Option<Rectangle>) {
        let places = places(target);
        let depth_buffer = match target {
            Target::Framebuffer => DepthBuffer::Framebuffer,
            Target::Textures(_) => DepthBuffer::Textures,
        };
        let beyond = places.first().and_then(|place| self.color_beyond(place));
        let is_whole = scissor.is_none();
        let is_depth_even = self.depths.contains(&depth_buffer);
        match step {
            Step::Clear { color, depth } => {
                if color.is_some() {
                    self.set_colors(&places, is_whole.then_some(0));
                }
                if *depth {
                    self.set_depth(depth_buffer, is_whole);
                }
            }
            Step::ClearEach { .. } => {
                self.set_colors(&places, is_whole.then_some(0));
                self.set_depth(depth_buffer, is_whole);
            }
            Step::CopyFramebuffer => {
                self.set_colors(&[Place::Texture(Texture::BorderMap)], beyond.filter(|_| is_whole));
            }
            Step::CopyDepth => {
                self.set_colors(&[Place::Texture(Texture::DepthMap)], (is_depth_even && is_whole).then_some(0));
            }
            Step::Draw(draw) if stays_in_objects(draw) || draw.facts.adds_nothing.is_some() => {}
            Step::Draw(draw) => {
                let is_constant = draw.facts.constant_color.is_some() && covers(draw) && is_whole;
                let even = match is_constant {
                    true => Some(0),
                    false => beyond.zip(self.unchanged_beyond(draw)).map(|(before, after)| before.max(after)),
                };
                self.set_colors(&places, even.filter(|_| places.len() == 1));
                if draw.depth == Depth::TestAndWrite {
                    self.set_depth(depth_buffer, false);
                }
            }
        }
    }

    /// Returns the distance from the objects beyond which a draw leaves all pixels unchanged; `None` if it may change any.
    fn unchanged_beyond(&self, draw: &Draw) -> Option<u32> {
        let reach = draw.facts.reach_px.filter(|_| draw.facts.where_even == Some(WhereEven::Unchanged))?;
        self.even_beyond(draw)?.checked_add(reach)
    }

    /// Records that they are uniform beyond this many pixels, or nowhere.
    fn set_colors(&mut self, places: &[Place], beyond: Option<u32>) {
        self.colors.retain(|(place, _)| !places.contains(place));
        if let Some(beyond) = beyond {
            self.colors.extend(places.iter().map(|place| (*place, beyond)));
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
    draw.is_of_objects() && draw.keeps_places() && draw.back_faces_as_lines.is_none()
}

/// Whether a draw is a square that gives every pixel a colour, whatever it held.
pub(super) fn covers(draw: &Draw) -> bool {
    matches!(draw.geometry, Geometry::ScreenSquare | Geometry::BackgroundSquare { .. })
        && draw.depth == Depth::Ignore
        && draw.blend == Blend::Replace
        && draw.scissor.is_none()
        && draw.keeps_places()
        && draw.keeps_pixels()
}
