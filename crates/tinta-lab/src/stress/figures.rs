//! The figures measured in a case.

use crate::compare::InkMask;
use crate::measure::{Reference, ReferenceLight};
use glam::Vec3;
use std::collections::{BTreeMap, BTreeSet};
use tinta::edges::Class;
use tinta::error::Result;
use tinta::lines::{LineSettings, Regions, VisibleLines};
use tinta::picture::Picture;
use tinta::scene::Scene;
use tinta::styles::Style;

/// Figures that compare with a right answer wherever they are known, and the most that each may be.
pub(super) const ANSWERS: [(&str, f64); 3] =
    [("off_closed_form", 0.02), ("shades_differing", 0.01), ("look_lines_off", 0.03)];

/// Figures by name.
pub(super) type Figures = BTreeMap<&'static str, f64>;

/// Classes of lines, with the figures that count their edges and those of them that are seen.
pub(super) const LINES: [(&str, &str, Class); 5] = [
    ("boundary", "seen_boundary", Class::Boundary),
    ("non_manifold", "seen_non_manifold", Class::NonManifold),
    ("silhouette", "seen_silhouette", Class::Silhouette),
    ("crease", "seen_crease", Class::Crease),
    ("intersection", "seen_intersection", Class::Intersection),
];

/// How far a channel may move before it is a change, of 255: a grey step that an eye sees.
const SEEN: u8 = 8;

/// Distance within which ink and shades may move without having come or gone, pixels.
const MOVED_PX: u32 = 1;

/// A scene with its exact lines.
#[derive(Debug)]
pub(super) struct Exact {
    /// The scene.
    pub scene: Scene,
    /// Its lines.
    pub reference: Reference,
    /// Its light.
    light: ReferenceLight,
}

impl Exact {
    /// Computes both without GL.
    pub(super) fn of(scene: Scene) -> Result<Self> {
        let reference = Reference::of(&scene, &LineSettings::as_published())?;
        let light = ReferenceLight::of(&scene);
        Ok(Self { scene, reference, light })
    }

    /// The pixels that visible lines pass through.
    pub(super) fn lines(&self) -> InkMask {
        InkMask::of_points(self.scene.size, self.reference.samples.iter().map(|sample| sample.px))
    }

    /// A style's shading; `None` for a style whose shading is not computed in f64.
    pub(super) fn shading(&self, style: &Style) -> Result<Option<Picture>> {
        self.light.picture(style, &self.scene)
    }

    /// The figures of the scene in any style: edges and visible lines by class, visible length, connected areas of surface, numbers
    /// that are not finite.
    pub(super) fn figures(&self) -> Result<Figures> {
        let lines = &self.reference.lines;
        let mut counts = lines.edges;
        let mut figures = Figures::new();
        for (name, seen, class) in LINES {
            figures.insert(name, *counts.of(class) as f64);
            let of_class = lines.segments.iter().filter(|segment| segment.is_visible && segment.class == class);
            // An edge may be visible in several pieces; an intersection has no edge.
            let edges = of_class.enumerate().map(|(number, segment)| {
                segment.edge.map_or([u32::MAX, number as u32, 0], |[from, to]| [segment.object, from, to])
            });
            figures.insert(seen, edges.collect::<BTreeSet<_>>().len() as f64);
        }
        let surfaces = Regions::of(&self.scene)?.joined(|seen| seen.map(|_| ())).regions;
        figures.extend([
            ("areas", surfaces.len() as f64),
            ("areas_px", surfaces.iter().map(|surface| surface.area_px).sum()),
            ("lines_px", self.reference.length_px()),
            ("non_finite", (non_finite(&self.scene) + non_finite_ends(lines)) as f64),
        ]);
        Ok(figures)
    }
}

/// Numbers that GL is given and that are not finite.
pub(super) fn non_finite(scene: &Scene) -> usize {
    let mut count = usize::from(!scene.clip_from_view().is_finite());
    for object in &scene.objects {
        let arrays = scene.arrays(object);
        count += usize::from(!scene.view_from_object(object, arrays.centre).is_finite());
        count += arrays.vertices.iter().flatten().filter(|number| !number.is_finite()).count();
        count += arrays.texture_coordinates.iter().flatten().filter(|number| !number.is_finite()).count();
        // A normal is a direction: a vector without length is invalid.
        let normal = |vertex: &&[f32; 6]| (Vec3::from_slice(&vertex[3..]).length() - 1.0).abs() > 1e-3;
        count += arrays.vertices.iter().filter(normal).count();
    }
    count
}

fn non_finite_ends(lines: &VisibleLines) -> usize {
    lines.segments.iter().flat_map(|segment| segment.ends_px).filter(|end| !end.is_finite()).count()
}

/// How much ink came or went from one picture to the next, as a share of both pictures' ink: pixels without ink of the other
/// picture in them or next to them.
pub(super) fn popped(before: &InkMask, after: &InkMask) -> f64 {
    let all = before.count() + after.count();
    let popped = before.count_far_from(after, MOVED_PX) + after.count_far_from(before, MOVED_PX);
    if all == 0 { 0.0 } else { popped as f64 / all as f64 }
}

/// Pixels with a colour that the other picture has neither there nor next to it, as a share of those that either covers: changes
/// other than movement.
pub(super) fn shades_popped(before: &Picture, after: &Picture) -> f64 {
    let covered = |picture: &Picture, index: usize| picture.pixels[index * 4..index * 4 + 3] != [u8::MAX; 3];
    let all = (0..before.size.pixel_count()).filter(|&index| covered(before, index) || covered(after, index)).count();
    let popped = colors_gone(before, after) + colors_gone(after, before);
    if all == 0 { 0.0 } else { popped as f64 / (2 * all) as f64 }
}

/// Pixels of the first picture with a colour that is nowhere near in the second.
fn colors_gone(first: &Picture, second: &Picture) -> usize {
    let (width, height) = (i64::from(first.size.width), i64::from(first.size.height));
    let near = i64::from(MOVED_PX);
    let is_seen = |a: [u8; 4], b: [u8; 4]| (0..3).any(|channel| a[channel].abs_diff(b[channel]) > SEEN);
    let is_gone = |x: i64, y: i64| {
        let color = first.pixel(x, y);
        let mut others = (y - near..=y + near).flat_map(|y| (x - near..=x + near).map(move |x| (x, y)));
        others.all(|(x, y)| {
            let is_outside = x < 0 || y < 0 || x >= width || y >= height;
            is_outside || is_seen(color, second.pixel(x, y))
        })
    };
    (0..height).map(|y| (0..width).filter(|x| is_gone(*x, y)).count()).sum()
}

/// Number of different pixels.
pub(super) fn differing_px(first: &Picture, second: &Picture) -> f64 {
    first.difference(second).map_or(f64::NAN, |difference| difference.pixels as f64)
}

/// Pixels that are not white.
pub(super) fn covered_px(picture: &Picture) -> f64 {
    picture.pixels.chunks_exact(4).filter(|pixel| pixel[..3] != [u8::MAX; 3]).count() as f64
}

/// How dark a picture is: 0 white, 1 black.
pub(super) fn darkness(picture: &Picture) -> f64 {
    let sum: f64 = picture.pixels.chunks_exact(4).flat_map(|pixel| &pixel[..3]).map(|byte| f64::from(*byte)).sum();
    1.0 - sum / (255.0 * 3.0 * picture.size.pixel_count() as f64)
}

/// The pairs of faces that lie on each other, in all meshes.
pub(super) fn doubled_pairs(scene: &Scene) -> usize {
    scene.objects.iter().map(|object| object.mesh.defects.doubled_triangles).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    const SIZE: Size = Size { width: 5, height: 1 };

    fn grey(levels: [u8; 5]) -> Picture {
        Picture { size: SIZE, pixels: levels.iter().flat_map(|level| [*level, *level, *level, 255]).collect() }
    }

    #[test]
    fn ink_that_moves_by_a_pixel_has_not_popped_and_ink_that_moves_by_two_has() {
        let mask = |levels: [u8; 5]| InkMask::of(&grey(levels));
        let at_0 = mask([0, 255, 255, 255, 255]);
        assert_eq!(popped(&at_0, &at_0), 0.0);
        assert_eq!(popped(&at_0, &mask([255, 0, 255, 255, 255])), 0.0);
        assert_eq!(popped(&at_0, &mask([255, 255, 0, 255, 255])), 1.0);
        // Two pixels stay, one comes: one in five of both pictures' ink.
        assert_eq!(popped(&mask([0, 0, 255, 255, 255]), &mask([0, 0, 255, 255, 0])), 0.2);
    }

    #[test]
    fn shades_that_move_have_not_popped_and_new_ones_have() {
        let before = grey([100, 100, 200, 200, 255]);
        assert_eq!(shades_popped(&before, &before), 0.0);
        assert_eq!(shades_popped(&before, &grey([100, 200, 200, 200, 255])), 0.0);
        assert_eq!(shades_popped(&before, &grey([104, 100, 196, 200, 255])), 0.0);
        // One of four covered pixels has a new colour, and every old colour is still in a neighbour.
        assert_eq!(shades_popped(&before, &grey([100, 150, 200, 200, 255])), 0.125);
    }
}
