//! Composes the panes into one picture, for screenshots.

use crate::picture::Picture;
use crate::scene::Size;
use crate::window::values::event::Side;
use crate::window::values::state::{Content, ViewerState};

/// The colour between panes.
const GAP: [u8; 4] = [128, 128, 128, 255];

/// Returns the drawing area as shown; `None` until every visible side has a picture.
pub(crate) fn composed(state: &ViewerState, picture: impl Fn(Side) -> Option<Picture>) -> Option<Picture> {
    let panes = state.panes();
    let parts: Vec<(u32, Picture)> = panes
        .iter()
        .map(|pane| {
            let shown = match pane.content {
                Content::Picture(side) => picture(side)?,
                Content::Cut(column) => cut(&picture(Side::Left)?, &picture(Side::Right)?, column),
                Content::Difference => difference(&picture(Side::Left)?, &picture(Side::Right)?),
            };
            Some((pane.left, shown))
        })
        .collect::<Option<_>>()?;
    if let [(0, _)] = parts[..] {
        return parts.into_iter().next().map(|(_, picture)| picture);
    }
    let width = parts.iter().map(|(left, picture)| left + picture.size.width).max()?;
    let height = parts.iter().map(|(_, picture)| picture.size.height).max()?;
    let size = Size { width, height };
    let mut pixels = GAP.repeat(size.pixel_count());
    for (left, picture) in &parts {
        let row = picture.size.width as usize * 4;
        for (y, pixels_of_row) in picture.pixels.chunks_exact(row).enumerate() {
            let start = (y * width as usize + *left as usize) * 4;
            pixels[start..start + row].copy_from_slice(pixels_of_row);
        }
    }
    Some(Picture { size, pixels })
}

/// The left picture up to a column, the right picture beyond it.
fn cut(left: &Picture, right: &Picture, column: u32) -> Picture {
    if left.size != right.size {
        return left.clone();
    }
    let (row, cut) = (left.size.width as usize * 4, column.min(left.size.width) as usize * 4);
    let mut pixels = left.pixels.clone();
    for (pixels, right) in pixels.chunks_exact_mut(row).zip(right.pixels.chunks_exact(row)) {
        pixels[cut..].copy_from_slice(&right[cut..]);
    }
    Picture { size: left.size, pixels }
}

/// White where both are the same, darker in a channel the more it differs.
pub(in crate::window) fn difference(left: &Picture, right: &Picture) -> Picture {
    // While the size changes one may be there before the other.
    if left.size != right.size {
        return left.clone();
    }
    let pairs = left.pixels.chunks_exact(4).zip(right.pixels.chunks_exact(4));
    let pixels = pairs.flat_map(|(a, b)| {
        let channel = |index: usize| u8::MAX - a[index].abs_diff(b[index]);
        [channel(0), channel(1), channel(2), u8::MAX]
    });
    Picture { size: left.size, pixels: pixels.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::window::values::event::{Layout, ViewerEvent};

    fn flat(size: Size, value: u8) -> Picture {
        Picture { size, pixels: [value, value, value, 255].repeat(size.pixel_count()) }
    }

    fn shown(layout: Layout, width: u32) -> Picture {
        let mut state = ViewerState::default();
        for event in [ViewerEvent::Resize([width, 2]), ViewerEvent::Layout(layout), ViewerEvent::Divide(0.25)] {
            state.update(event);
        }
        let size = state.picture_size();
        composed(&state, |side| Some(flat(size, if side == Side::Left { 10 } else { 30 }))).unwrap()
    }

    fn row(picture: &Picture) -> Vec<u8> {
        picture.pixels[..picture.size.width as usize * 4].chunks_exact(4).map(|pixel| pixel[0]).collect()
    }

    #[test]
    fn a_split_has_each_style_on_its_side_of_the_divider() {
        assert_eq!(row(&shown(Layout::Single, 8)), [10; 8]);
        assert_eq!(row(&shown(Layout::Split, 8)), [10, 10, 30, 30, 30, 30, 30, 30]);
    }

    #[test]
    fn a_difference_is_the_third_pane() {
        let picture = shown(Layout::Difference, 10);
        assert_eq!(row(&picture), [10, 10, 128, 128, 30, 30, 128, 128, 235, 235]);
        assert_eq!(picture.size.height, 2);
    }

    #[test]
    fn nothing_is_put_together_of_a_side_without_a_picture() {
        let state = ViewerState { layout: Layout::Split, ..ViewerState::default() };
        let left = |side| (side == Side::Left).then(|| flat(state.area, 0));
        assert_eq!(composed(&state, left), None);
    }
}
