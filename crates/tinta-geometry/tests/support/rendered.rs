//! SVG drawn by a renderer that is not ours.

use resvg::{tiny_skia, usvg};

/// The pixels of an SVG, so many to one of its own.
pub fn rendered(text: &str, zoom: f32) -> tiny_skia::Pixmap {
    let tree = usvg::Tree::from_str(text, &usvg::Options::default()).unwrap();
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|side| (side * zoom).round() as u32);
    let mut pixels = tiny_skia::Pixmap::new(width, height).unwrap();
    resvg::render(&tree, tiny_skia::Transform::from_scale(zoom, zoom), &mut pixels.as_mut());
    pixels
}
