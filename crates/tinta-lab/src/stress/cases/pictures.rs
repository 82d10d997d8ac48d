//! Pictures of one pixel, of odd sizes, of the largest size that is drawn in one piece and one more.

use super::case::{Case, Drawing, Group, LARGEST, Study};
use crate::stress::{Shape, Variant, WrittenShape};
use tinta::scene::Size;
use tinta::styles::StyleName;

/// The longest side of a strip that Mesa's software renderer draws by every backend, pixels; each context reports its own limit,
/// and [`LARGEST`] stands for it.
const STRIP: u32 = 4096;

pub(super) fn cases() -> Vec<Case> {
    let sized = |width, height| Drawing {
        shape: Shape::Written(WrittenShape::Skin(16, 16)),
        size: Size { width, height },
        variants: styles(),
        study: Study::Picture,
        ..Drawing::default()
    };
    let rendered = |name: String, drawing| Case::rendered(Group::Pictures, name, drawing);
    let mut all = Vec::new();
    for (width, height) in [(1, 1), (1, 2), (1, 100), (100, 1), (3, 5), (127, 63), (257, 3), (2, STRIP), (STRIP, 2)] {
        all.push(rendered(format!("{width}x{height} pixels"), sized(width, height)));
    }
    all.push(rendered("the widest picture".to_owned(), sized(LARGEST, 8)));
    all.push(rendered("the highest picture".to_owned(), sized(8, LARGEST)));
    for (name, width, height) in [("one pixel wider", LARGEST + 1, 8), ("one pixel higher", 8, LARGEST + 1)] {
        // In tiles. Charcoal and sand as published need the whole picture in one viewport.
        let mut wider = sized(width, height);
        wider.variants = Variant::all();
        wider.variants.retain(|variant| variant.name != StyleName::Charcoal.name());
        all.push(rendered(name.to_owned(), wider));
    }
    for (name, width, height) in [("no pixel wide", 0, 8), ("no pixel high", 8, 0)] {
        all.push(Case::refused(Group::Pictures, name, sized(width, height), "setting", "--size"));
    }
    all
}

/// All styles, `sand` among them.
fn styles() -> Vec<Variant> {
    let mut styles = Variant::all();
    styles.push(Variant::published(StyleName::Sand));
    styles
}
