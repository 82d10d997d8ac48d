//! Pictures in tiles: parts of the surface, drawn one after the other, for pictures larger than a driver can draw at once.
//!
//! In: a plan, the surface's size, the driver's limits. Out: [`Tile`]s that cover the surface, each with the margin that the
//! plan's filters read. A tile is drawn with the whole picture's viewport, shifted. Its pixels therefore sample the same places
//! of the model as in one piece.

use super::{Geometry, Plan, Step, Texture, Value};
use crate::scene::{Rectangle, Size};
use glam::{DMat4, DVec3, Mat4};

/// A part of the surface, in pixels of the whole, counted from its lower left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tile {
    /// The size of the whole.
    pub whole: Size,
    /// The rectangle to draw: `kept`, and the margin that filters read.
    pub drawn: Rectangle,
    /// The part of it that enters the picture.
    pub kept: Rectangle,
    /// The viewport: the whole, or as much of it around the tile as the driver's viewport can span.
    pub viewport: Rectangle,
}

/// The largest surface and viewport that a driver can draw at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileLimits {
    /// Largest surface.
    pub surface: Size,
    /// Largest viewport.
    pub viewport: Size,
}

/// Tiles begin and end at multiples of this many pixels: of all factors of supersampling, and of the pairs and blocks of pixels
/// that drivers draw together.
const STEP_PX: u32 = 48;

impl Tile {
    /// All in one piece.
    pub(crate) fn whole(whole: Size) -> Self {
        let all = Rectangle { x: 0, y: 0, width: whole.width, height: whole.height };
        Self { whole, drawn: all, kept: all, viewport: all }
    }

    /// Whether it is all.
    pub(crate) fn is_whole(&self) -> bool {
        *self == Self::whole(self.whole)
    }

    /// The size of the drawn rectangle.
    pub(crate) fn size(&self) -> Size {
        Size { width: self.drawn.width, height: self.drawn.height }
    }

    /// Returns the part of a rectangle of the whole that lies in this tile, counted from the tile's own corner; `None` if empty.
    pub(crate) fn part(&self, of: Rectangle) -> Option<Rectangle> {
        let common = of.within(self.drawn)?;
        Some(Rectangle { x: common.x - self.drawn.x, y: common.y - self.drawn.y, ..common })
    }

    /// Returns the matrix from the picture's clip space to that of the tile's viewport; `None` if they are equal.
    pub(crate) fn clip_from_picture(&self) -> Option<Mat4> {
        let Rectangle { x, y, width, height } = self.viewport;
        if (width, height) == (self.whole.width, self.whole.height) {
            return None;
        }
        let along = |whole: u32, start: u32, length: u32| {
            let [whole, start, length] = [whole, start, length].map(f64::from);
            [whole / length, (whole - 2.0 * start - length) / length]
        };
        let ([scale_x, shift_x], [scale_y, shift_y]) =
            (along(self.whole.width, x, width), along(self.whole.height, y, height));
        let scale = DMat4::from_scale(DVec3::new(scale_x, scale_y, 1.0));
        Some((DMat4::from_translation(DVec3::new(shift_x, shift_y, 0.0)) * scale).as_mat4())
    }

    /// Converts a uniform of the whole to this tile.
    pub(crate) fn value(&self, value: Value) -> Value {
        match value {
            Value::TexelSize(_) if !self.is_whole() => Value::texel_size(self.size()),
            Value::PixelPlace([x, y]) => Value::PixelPlace([x - self.drawn.x as f32, y - self.drawn.y as f32]),
            other => other,
        }
    }
}

impl Plan {
    /// Returns the tiles that cover a surface of this size, from the top row down and each row from the left: a single one if the
    /// driver can draw it at once. `None` if it cannot, and the plan must be drawn in one piece or does not state how far its
    /// filters read.
    pub fn tiles(&self, surface: Size, limits: TileLimits) -> Option<Vec<Tile>> {
        if surface.width <= limits.surface.width && surface.height <= limits.surface.height {
            return Some(vec![Tile::whole(surface)]);
        }
        let largest = self.largest_surface(limits);
        if largest.is_some_and(|largest| surface.width > largest.width || surface.height > largest.height) {
            return None;
        }
        let margin = self.margin_px()?;
        let columns = spans(surface.width, limits.surface.width, margin, limits.viewport.width)?;
        let rows = spans(surface.height, limits.surface.height, margin, limits.viewport.height)?;
        let mut tiles = Vec::new();
        for row in rows.iter().rev() {
            for column in &columns {
                let rectangle = |part: fn(&Span) -> [u32; 2]| {
                    let ([x, width], [y, height]) = (part(column), part(row));
                    Rectangle { x, y, width, height }
                };
                tiles.push(Tile {
                    whole: surface,
                    drawn: rectangle(|span| span.drawn),
                    kept: rectangle(|span| span.kept),
                    viewport: rectangle(|span| span.viewport),
                });
            }
        }
        Some(tiles)
    }

    /// Returns the largest surface that such a driver can draw in tiles; `None` for any.
    pub(crate) fn largest_surface(&self, limits: TileLimits) -> Option<Size> {
        let reads_clip_place = |step: &Step| matches!(step, Step::Draw(draw) if draw.facts.reads_clip_place);
        match self.margin_px() {
            None => Some(limits.surface),
            Some(_) if self.steps().any(|(_, step)| reads_clip_place(step)) => Some(limits.viewport),
            Some(_) => None,
        }
    }

    /// Returns how many pixels around a tile its filters read, including reads of other filters' results; `None` if that is not
    /// stated.
    fn margin_px(&self) -> Option<u32> {
        // Shaders that use derivatives between pixels need a neighbour.
        let mut margin = 2u32;
        for (_, step) in self.steps() {
            let Step::Draw(draw) = step else { continue };
            let reads = |(_, texture): &(_, Texture)| {
                matches!(texture, Texture::BorderMap | Texture::DepthMap | Texture::Drawn(_))
            };
            // The last step of supersampling reads only its own pixels.
            if draw.geometry != Geometry::PictureSquare && draw.textures.iter().any(reads) {
                margin = margin.checked_add(draw.facts.reach_px?)?;
            }
        }
        margin.checked_next_multiple_of(STEP_PX)
    }
}

/// A tile's start and length along a side.
struct Span {
    drawn: [u32; 2],
    kept: [u32; 2],
    viewport: [u32; 2],
}

/// Cuts a side into about equal lengths; none exceeds `largest`, margins included.
fn spans(side: u32, largest: u32, margin: u32, viewport: u32) -> Option<Vec<Span>> {
    let most = match side <= largest {
        true => side,
        false => largest.checked_sub(2 * margin)? / STEP_PX * STEP_PX,
    };
    let count = side.checked_add(most.checked_sub(1)?)? / most;
    let each = if count == 1 { side } else { side.div_ceil(count).next_multiple_of(STEP_PX).min(most) };
    let span = |start: u32| {
        let end = side.min(start + each);
        let (first, last) = (start.saturating_sub(margin), side.min(end + margin));
        // The viewport surrounds the tile's middle but stays within the picture.
        let length = side.min(viewport);
        let middle = (first + last) / 2;
        let around = middle.saturating_sub(length / 2).min(side - length);
        Span { drawn: [first, last - first], kept: [start, end - start], viewport: [around, length] }
    };
    Some((0..side).step_by(each as usize).map(span).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Draw, Facts, Pass, Program};

    fn plan(reach_px: Option<u32>) -> Plan {
        let program = Program::new("a.vert", ["a.frag"]);
        let filter = Draw {
            textures: vec![("map", Texture::BorderMap)],
            facts: Facts { reach_px, ..Facts::default() },
            ..Draw::new(Geometry::ScreenSquare, Some(program))
        };
        Plan::new(vec![Pass::new("a", vec![Step::CopyFramebuffer, Step::Draw(filter)])])
    }

    fn limits(surface: u32, viewport: u32) -> TileLimits {
        let square = |side| Size { width: side, height: side };
        TileLimits { surface: square(surface), viewport: square(viewport) }
    }

    #[test]
    fn kept_parts_cover_every_pixel_once_and_drawn_ones_hold_the_margins_and_fit() {
        for (width, height, largest) in [(1000, 700, 256), (257, 90, 256), (4961, 3507, 1024), (400, 5000, 300)] {
            let whole = Size { width, height };
            let tiles = plan(Some(17)).tiles(whole, limits(largest, 16_384)).unwrap();
            let mut counts = vec![0u8; whole.pixel_count()];
            for tile in &tiles {
                for y in tile.kept.y..tile.kept.y + tile.kept.height {
                    let row = (y * width) as usize;
                    let (start, end) = (tile.kept.x as usize, (tile.kept.x + tile.kept.width) as usize);
                    counts[row + start..row + end].iter_mut().for_each(|count| *count += 1);
                }
                assert!(tile.drawn.width <= largest && tile.drawn.height <= largest, "{tile:?}");
                assert_eq!(tile.kept.grown(48, whole), tile.drawn, "17 and 2 pixels, to the next step");
                assert!([tile.kept.x, tile.kept.y, tile.drawn.x, tile.drawn.y].iter().all(|place| place % 48 == 0));
                assert_eq!(tile.clip_from_picture(), None);
            }
            assert!(counts.iter().all(|count| *count == 1), "{whole}");
        }
    }

    #[test]
    fn what_fits_is_one_tile_and_what_nobody_knows_the_reach_of_is_none() {
        let small = Size { width: 256, height: 100 };
        assert_eq!(plan(None).tiles(small, limits(256, 256)), Some(vec![Tile::whole(small)]));
        let large = Size { width: 257, height: 100 };
        assert_eq!(plan(None).tiles(large, limits(256, 256)), None);
        // The margins leave no pixels between them.
        assert_eq!(plan(Some(128)).tiles(large, limits(256, 16_384)), None);
        assert!(plan(Some(60)).tiles(large, limits(256, 16_384)).is_some());
    }

    #[test]
    fn a_part_of_the_picture_in_a_smaller_viewport_lies_on_the_same_pixels() {
        let whole = Size { width: 3000, height: 500 };
        let tiles = plan(Some(1)).tiles(whole, limits(600, 1024)).unwrap();
        for tile in tiles {
            let clip = tile.clip_from_picture().unwrap();
            for pixel in [tile.drawn.x, tile.drawn.x + tile.drawn.width] {
                let place = f64::from(pixel) / 1500.0 - 1.0;
                let found = clip.project_point3(glam::Vec3::new(place as f32, 0.25, 0.0));
                let in_viewport = f64::from(found.x + 1.0) * f64::from(tile.viewport.width) / 2.0;
                let expected = f64::from(pixel) - f64::from(tile.viewport.x);
                assert!((in_viewport - expected).abs() < 1e-3, "{tile:?}: {in_viewport} {expected}");
                assert_eq!(found.y, 0.25, "the height fits");
                assert!((-0.5..=1024.5).contains(&expected), "the tile lies in its viewport");
            }
        }
    }

    #[test]
    fn a_shader_that_takes_the_picture_from_clip_space_needs_all_of_it_in_the_viewport() {
        let mut plan = plan(Some(1));
        let Some(Step::Draw(draw)) = plan.passes[0].steps.last_mut() else { panic!("a draw") };
        draw.facts.reads_clip_place = true;
        let size = Size { width: 2000, height: 10 };
        assert!(plan.tiles(size, limits(600, 2000)).is_some());
        assert_eq!(plan.tiles(size, limits(600, 1999)), None);
    }

    #[test]
    fn what_a_uniform_says_of_the_whole_is_said_of_the_tile() {
        let whole = Size { width: 1000, height: 1000 };
        let tile = plan(Some(1)).tiles(whole, limits(400, 1000)).unwrap().pop().unwrap();
        let middle = Value::PixelPlace([500.0, 500.0]);
        assert_eq!(tile.value(middle), Value::PixelPlace([500.0 - tile.drawn.x as f32, 500.0 - tile.drawn.y as f32]));
        assert_eq!(tile.value(Value::texel_size(whole)), Value::texel_size(tile.size()));
        assert_eq!(tile.value(Value::Vec2([500.0, 500.0])), Value::Vec2([500.0, 500.0]));
        assert_eq!(Tile::whole(whole).value(middle), middle);
    }
}
