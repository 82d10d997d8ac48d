//! Lines that are too short to draw, on hand-made lines and on models: never a line that closes an outline.

use crate::support::drawn::{lines, segment};
use crate::support::lines::{distance, length, lines_with, scene_of, view};
use crate::support::shapes::icosphere;
use crate::support::{builtin, public_meshes};
use glam::DVec2;
use tinta::edges::Class::{Boundary, Crease, Material, Silhouette};
use tinta::lines::{Length, LineSegment, LineSettings};
use tinta::{DrawingSettings, Scene, VisibleLines};

/// The ends of the pieces that stay; lines are 2 pixels wide.
fn kept_with(segments: &[LineSegment], settings: &DrawingSettings) -> Vec<[DVec2; 2]> {
    let kept = lines(segments.to_vec()).without_specks(settings).unwrap().segments;
    kept.iter().map(|segment| segment.ends_px).collect()
}

fn kept(segments: &[LineSegment]) -> Vec<[DVec2; 2]> {
    kept_with(segments, &DrawingSettings::default())
}

/// The sides of a square from 20, 20 to 60, 60.
fn square() -> Vec<LineSegment> {
    let corners = [[20.0, 20.0], [60.0, 20.0], [60.0, 60.0], [20.0, 60.0]];
    (0..4).map(|k| segment(Silhouette, true, corners[k], corners[(k + 1) % 4])).collect()
}

fn with(more: &[LineSegment]) -> Vec<LineSegment> {
    square().into_iter().chain(more.iter().cloned()).collect()
}

/// Asserts how many of these additional pieces stay; the square always stays.
#[track_caller]
fn assert_stays(more: &[LineSegment], expected: usize) {
    let all = kept(&with(more));
    assert_eq!(all[..4], square().iter().map(|segment| segment.ends_px).collect::<Vec<_>>()[..]);
    assert_eq!(all.len(), 4 + expected, "{:?}", &all[4..]);
}

#[test]
fn specks_and_barbs_below_the_strokes_width_go_and_longer_ones_stay() {
    let speck = |length: f64| segment(Silhouette, true, [30.0, 30.0], [30.0 + length, 30.0]);
    assert_stays(&[speck(1.9)], 0);
    assert_stays(&[speck(2.1)], 1);
    let barb = |length: f64| segment(Silhouette, true, [20.0, 20.0], [20.0 + length, 20.0 + length]);
    assert_stays(&[barb(1.0)], 0);
    assert_stays(&[barb(1.5)], 1);
    // From the middle of a side, which is not cut there.
    let stub = |length: f64| segment(Boundary, true, [40.0, 20.0], [40.0, 20.0 + length]);
    assert_stays(&[stub(1.9)], 0);
    assert_stays(&[stub(2.1)], 1);
    // Several pieces count together.
    let bent = [stub(1.5), segment(Boundary, true, [40.0, 21.5], [41.0, 21.5])];
    assert_stays(&bent, 2);
    // All that there is of something tiny, closed or not.
    let tiny = [[30.0, 30.0], [30.5, 30.0], [30.0, 30.5]];
    let triangle = [0, 1, 2].map(|k| segment(Silhouette, true, tiny[k], tiny[(k + 1) % 3]));
    assert_stays(&triangle, 0);
}

#[test]
fn creases_that_hang_on_nothing_go_up_to_eight_widths_and_edges_of_a_shape_stay() {
    let fold = |length: f64| segment(Crease, true, [30.0, 30.0], [30.0 + length, 30.0]);
    assert_stays(&[fold(15.9)], 0);
    assert_stays(&[fold(16.1)], 1);
    // Between two lines, also where these are not cut.
    assert_stays(&[segment(Crease, true, [20.0, 25.0], [25.0, 20.0])], 1);
    assert_stays(
        &[segment(Crease, true, [20.0, 20.0], [21.5, 21.5]), segment(Material, true, [21.5, 21.5], [60.0, 60.0])],
        2,
    );
}

#[test]
fn what_closes_a_line_stays_however_short_its_parts_are() {
    // A square of pieces of half a pixel, in turn of two classes and two objects.
    let corners = [[20.0, 20.0], [30.0, 20.0], [30.0, 30.0], [20.0, 30.0]].map(DVec2::from_array);
    let mut parts: Vec<LineSegment> = Vec::new();
    for k in 0..4 {
        for step in 0..20 {
            let at = |step: u32| corners[k].lerp(corners[(k + 1) % 4], f64::from(step) / 20.0).to_array();
            let class = if step % 2 == 0 { Silhouette } else { Boundary };
            parts.push(LineSegment { object: step % 3, ..segment(class, true, at(step), at(step + 1)) });
        }
    }
    assert_eq!(kept(&parts).len(), 80);
    // A bridge between two lines without other ends.
    let left = segment(Silhouette, true, [10.0, 40.0], [30.0, 40.0]);
    let right = segment(Silhouette, true, [31.0, 40.0], [50.0, 40.0]);
    let bridge = segment(Boundary, true, [30.0, 40.0], [31.0, 40.0]);
    assert_eq!(kept(&[left.clone(), right.clone(), bridge.clone()]).len(), 3);
    // The same where the three only touch: each ends in the middle of an upright.
    let upright = |x: f64| segment(Silhouette, true, [x, 30.0], [x, 50.0]);
    assert_eq!(kept(&[upright(30.0), upright(31.0), bridge]).len(), 3);
    // Up to the picture's border, where the rest of it is outside.
    assert_eq!(
        kept(&[segment(Silhouette, true, [0.0, 40.0], [1.0, 40.0]), segment(Boundary, true, [1.0, 30.0], [1.0, 50.0])])
            .len(),
        2
    );
}

/// A line through these points.
fn way(points: &[[f64; 2]]) -> Vec<LineSegment> {
    points.windows(2).map(|pair| segment(Silhouette, true, pair[0], pair[1])).collect()
}

#[test]
fn of_a_slivers_two_sides_one_stays() {
    let [from, to] = [[40.0, 20.0], [41.0, 20.0]];
    let sliver = [way(&[from, [40.5, 20.4], to]), way(&[from, to])].concat();
    let ends = [segment(Silhouette, true, [10.0, 20.0], from), segment(Silhouette, true, to, [70.0, 20.0])];
    let all: Vec<LineSegment> = sliver.iter().chain(&ends).cloned().collect();
    let stays = kept(&all);
    assert_eq!(stays.len(), 4, "the shorter side goes: {stays:?}");
    // A larger one is not a sliver.
    let large = [way(&[from, [40.5, 26.0], to]), way(&[from, to])].concat();
    let all: Vec<LineSegment> = large.iter().chain(&ends).cloned().collect();
    assert_eq!(kept(&all).len(), 5);
}

#[test]
fn a_slivers_side_stays_if_its_way_around_is_long_narrow_or_in_a_crowd() {
    let [from, to] = [[40.0, 20.0], [41.0, 20.0]];
    let line = [way(&[[10.0, 20.0], from]), way(&[from, to]), way(&[to, [70.0, 20.0]])].concat();
    let stays = |more: &[LineSegment], settings: &DrawingSettings| {
        kept_with(&[&line[..], more].concat(), settings).contains(&[from, to].map(DVec2::from_array))
    };
    let settings = DrawingSettings::default();
    let bent = |y: f64| way(&[from, [40.2, y], [40.5, y], to]);
    assert!(!stays(&bent(20.5), &settings));
    // All of it is within a width of the side.
    let winding = way(&[from, [40.3, 20.7], [40.5, 20.1], [40.7, 20.7], to]);
    assert!(stays(&winding, &settings), "2.8 pixels, lines of 2");
    let as_boundary = |line: Vec<LineSegment>| -> Vec<LineSegment> {
        line.into_iter().map(|segment| LineSegment { class: Boundary, ..segment }).collect()
    };
    let narrow = DrawingSettings { class_widths: "boundary=1.9".parse().unwrap(), ..DrawingSettings::default() };
    assert!(!stays(&as_boundary(bent(20.5)), &settings));
    assert!(stays(&as_boundary(bent(20.5)), &narrow));
    // Many lines from one corner of the sliver.
    let crowd = |count: u32| -> Vec<LineSegment> {
        let ray = |k: u32| way(&[from, [10.0 + f64::from(k), 70.0]]);
        [(0..count).flat_map(ray).collect(), bent(20.5)].concat()
    };
    assert!(!stays(&crowd(40), &settings));
    assert!(stays(&crowd(80), &settings));
}

#[test]
fn a_slivers_side_goes_beside_a_line_that_is_not_cut_there() {
    let long = way(&[[10.0, 20.0], [70.0, 20.0]]);
    let beside = way(&[[40.0, 20.0], [40.5, 20.4], [41.0, 20.0]]);
    let far = way(&[[40.0, 20.0], [40.5, 22.0], [41.0, 20.0]]);
    assert_eq!(kept(&[&long[..], &beside].concat()).len(), 1);
    assert_eq!(kept(&[long, far].concat()).len(), 3);
}

#[test]
fn min_length_is_in_pixels_or_millimetres_and_nothing_goes_at_0() {
    let speck = |length: f64| with(&[segment(Silhouette, true, [30.0, 30.0], [30.0 + length, 30.0])]);
    let of = |text: &str| DrawingSettings { min_length: Some(text.parse().unwrap()), ..DrawingSettings::default() };
    assert_eq!(kept_with(&speck(0.1), &of("0")).len(), 5);
    assert_eq!(kept_with(&speck(9.0), &of("8")).len(), 5);
    assert_eq!(kept_with(&speck(7.0), &of("8")).len(), 4);
    // The picture is 120 pixels wide: two pixels a millimetre.
    let on_paper = DrawingSettings { page_size: tinta::lines::PageSize::WidthMm(60.0), ..of("4mm") };
    assert_eq!((kept_with(&speck(7.9), &on_paper).len(), kept_with(&speck(8.1), &on_paper).len()), (4, 5));
    // Creases: eight times that up to a width, and at most the setting beyond eight widths; polygons smaller than it stay closed.
    let fold = |length: f64| with(&[segment(Crease, true, [30.0, 30.0], [30.0 + length, 30.0])]);
    for (text, length) in [("0.5", 4.0), ("2", 16.0), ("8", 16.0), ("20", 20.0)] {
        assert_eq!(kept_with(&fold(length - 0.1), &of(text)).len(), 4, "{text}");
        assert_eq!(kept_with(&fold(length + 0.1), &of(text)).len(), 5, "{text}");
    }
    assert_eq!(kept_with(&fold(0.1), &of("0")).len(), 5);
    assert_eq!(kept_with(&square(), &of("50")).len(), 4);
    // Wider lines, longer specks.
    let wide = DrawingSettings { line_width: Some(Length::Px(6.0)), ..DrawingSettings::default() };
    assert_eq!((kept_with(&speck(5.9), &wide).len(), kept_with(&speck(6.1), &wide).len()), (4, 5));
}

#[test]
fn hidden_lines_are_judged_among_themselves() {
    let hidden = |length: f64| with(&[segment(Silhouette, false, [20.0, 20.0], [20.0 + length, 20.0])]);
    assert_eq!(kept(&hidden(0.9)).len(), 4);
    assert_eq!(kept(&hidden(1.1)).len(), 5, "their lines are half as wide");
    let across = with(&[
        segment(Silhouette, true, [30.0, 30.0], [31.0, 30.0]),
        segment(Silhouette, false, [30.0, 30.0], [50.0, 30.0]),
    ]);
    assert_eq!(kept(&across).len(), 5, "a visible speck does not hang on what may not be shown");
}

/// Whether an end lies on some other piece, or on the picture's border.
fn is_held(pieces: &[LineSegment], number: usize, end: DVec2, size: f64, reach: f64) -> bool {
    let on_border = end.min_element() < reach || (size - end).min_element() < reach;
    on_border || pieces.iter().enumerate().any(|(other, piece)| other != number && distance(end, piece.ends_px) < reach)
}

/// Asserts that no end of an outline is free that was not before.
fn assert_outlines_stay_closed(found: &VisibleLines, settings: &DrawingSettings, what: &str) -> (f64, f64) {
    let visible = |lines: &VisibleLines| -> Vec<LineSegment> {
        lines.segments.iter().filter(|segment| segment.is_visible).cloned().collect()
    };
    let (before, after) = (visible(found), visible(&found.without_specks(settings).unwrap()));
    let size = f64::from(found.size.width);
    for (number, piece) in after.iter().enumerate().filter(|(_, piece)| piece.is_outline) {
        for end in piece.ends_px {
            if !is_held(&after, number, end, size, 0.02) {
                let was = before.iter().position(|other| other == piece).unwrap();
                assert!(!is_held(&before, was, end, size, 0.02), "{what}: the outline is open at {end}");
            }
        }
    }
    let total = |pieces: &[LineSegment]| pieces.iter().map(length).sum::<f64>();
    (total(&before), total(&after))
}

fn outlined(scene: &Scene) -> VisibleLines {
    lines_with(scene, &LineSettings { finds_outline: true, ..LineSettings::default() })
}

#[test]
fn nothing_that_closes_an_outline_goes() {
    let settings = DrawingSettings::default();
    let long = DrawingSettings { min_length: Some(Length::Px(12.0)), ..DrawingSettings::default() };
    for name in ["ant", "gear", "open-box", "bust"] {
        let found = outlined(&scene_of(vec![builtin(name)], view("iso", false)));
        let (before, after) = assert_outlines_stay_closed(&found, &settings, name);
        assert!(after > 0.98 * before, "{name}: {after} of {before}");
        assert_outlines_stay_closed(&found, &long, name);
    }
    let ball = outlined(&scene_of(vec![icosphere(4)], view("33,12", true)));
    assert_outlines_stay_closed(&ball, &settings, "a ball");
    assert_outlines_stay_closed(&ball, &long, "a ball");
}

#[test]
fn of_public_models_specks_go_and_outlines_stay() {
    let least = [0.8, 0.9, 0.995, 0.97];
    let meshes = public_meshes(&["cow.obj", "suzanne.obj", "fandisk.obj", "teapot.obj"]);
    for ((file, mesh), least) in meshes.into_iter().zip(least) {
        let found = outlined(&scene_of(vec![mesh], view("iso", false)));
        let (before, after) = assert_outlines_stay_closed(&found, &DrawingSettings::default(), file);
        println!("{file}: {:.2} % of the visible length stays", after / before * 100.0);
        assert!(after < before && after > least * before, "{file}: {after} of {before}");
    }
}

/// A square whose sides are outline, 4 pixels wide, and more lines of 2: how many of these stay.
fn kept_beside_outline(more: &[LineSegment]) -> usize {
    let side = |segment: LineSegment| LineSegment { is_outline: true, background: [true, false], ..segment };
    let mut settings = DrawingSettings { line_width: Some(Length::Px(2.0)), ..DrawingSettings::default() };
    settings.class_widths.0.set_outline(Length::Px(4.0));
    let all: Vec<LineSegment> = square().into_iter().map(side).chain(more.iter().cloned()).collect();
    kept_with(&all, &settings).len() - 4
}

#[test]
fn a_line_whose_ink_touches_the_outline_all_along_is_not_drawn() {
    let beside = |distance: f64| segment(Crease, true, [20.0 + distance, 20.0], [20.0 + distance, 60.0]);
    assert_eq!(kept_beside_outline(&[beside(2.9)]), 0);
    assert_eq!(kept_beside_outline(&[beside(3.1)]), 1, "paper between the two");
    // A face nearly edge-on, with another edge from its corner.
    let far = segment(Crease, true, [22.5, 40.0], [60.0, 45.0]);
    let near = [[20.0, 20.0], [22.5, 40.0], [20.0, 60.0]];
    let bent = [0, 1].map(|k| segment(Crease, true, near[k], near[k + 1]));
    assert_eq!(kept_beside_outline(&[bent[0].clone(), bent[1].clone(), far]), 1);
    // A line leaves the outline: all of it stays, with its part in the ink.
    let leaving = [[20.0, 20.0], [21.0, 40.0], [40.0, 58.0]];
    let leaving = [0, 1].map(|k| segment(Crease, true, leaving[k], leaving[k + 1]));
    assert_eq!(kept_beside_outline(&leaving), 2);
    // A short line from the outline inwards is no double, nor is a line beside another inner line.
    assert_eq!(kept_beside_outline(&[segment(Boundary, true, [40.0, 20.0], [40.0, 22.9])]), 1);
    let inner = [40.0, 42.0].map(|x| segment(Crease, true, [x, 25.0], [x, 55.0]));
    assert_eq!(kept_beside_outline(&inner), 2);
    // Around a corner, and hidden.
    let around = [[22.0, 58.0], [22.0, 22.0], [58.0, 22.0]];
    let around = [0, 1].map(|k| segment(Crease, true, around[k], around[k + 1]));
    assert_eq!(kept_beside_outline(&around), 0);
    assert_eq!(kept_beside_outline(&[LineSegment { is_visible: false, ..beside(2.0) }]), 1);
}
