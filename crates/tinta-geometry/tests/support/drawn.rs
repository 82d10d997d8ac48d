//! Lines made by hand.

use tinta::edges::Class;
use tinta::lines::LineSegment;
use tinta::{Size, VisibleLines};

/// A piece between pixels, named after its ends.
pub fn segment(class: Class, is_visible: bool, a: [f64; 2], b: [f64; 2]) -> LineSegment {
    let edge = (class != Class::Intersection).then_some([a[0] as u32, b[0] as u32]);
    LineSegment {
        class,
        is_visible,
        is_outline: false,
        background: [false; 2],
        is_covered: false,
        ends_px: [a.into(), b.into()],
        ends_world: [a, b].map(|[x, y]| glam::DVec3::new(x, y, 0.0)),
        edge,
        angle_degrees: edge.map(|_| 45.25),
        object: 0,
        part: 0,
        look: 0,
    }
}

/// A drawing of these pieces alone.
pub fn lines(segments: Vec<LineSegment>) -> VisibleLines {
    VisibleLines { segments, ..VisibleLines::none(Size { width: 120, height: 80 }) }
}
