//! Tapered ends: which ends they are, what stays of the line, and that all files have them alike.

use crate::support::drawn::{lines, segment};
use crate::support::lines::{lines_with, scene_of, view};
use crate::support::{builtin, public_meshes};
use glam::DVec2;
use tinta::edges::Class::{Boundary, Crease, Curve, Silhouette};
use tinta::lines::{LineSegment, LineSettings, Strokes, drawn_layers, dxf, strokes, svg};
use tinta::{DrawingSettings, VisibleLines};

/// Lines are 2 pixels wide, so a tip is 24 pixels long.
fn tapering() -> DrawingSettings {
    DrawingSettings { tapers: true, min_length: Some("0".parse().unwrap()), ..DrawingSettings::default() }
}

fn layers(segments: &[LineSegment]) -> Vec<Strokes> {
    strokes(&lines(segments.to_vec()), &tapering()).unwrap()
}

/// The last points of all tips, in order.
fn points(segments: &[LineSegment]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> =
        layers(segments).iter().flat_map(|layer| &layer.tips).map(|tip| tip.last().unwrap().to_array()).collect();
    points.sort_by(|a, b| a.partial_cmp(b).unwrap());
    points
}

#[test]
fn only_ends_that_no_other_ink_covers_and_that_lie_in_the_picture_taper() {
    let crease = segment(Crease, true, [20.0, 50.0], [80.0, 50.0]);
    assert_eq!(points(std::slice::from_ref(&crease)), [[20.0, 50.0], [80.0, 50.0]]);
    // Another line's end, its middle, and its ink.
    for other in [[[80.0, 50.0], [80.0, 75.0]], [[80.0, 20.0], [80.0, 75.0]], [[80.9, 20.0], [80.9, 75.0]]] {
        assert_eq!(points(&[crease.clone(), segment(Silhouette, true, other[0], other[1])])[0], [20.0, 50.0]);
        assert!(!points(&[crease.clone(), segment(Silhouette, true, other[0], other[1])]).contains(&[80.0, 50.0]));
    }
    // Beside the ink, below hidden lines, and at the picture's border.
    let beside = segment(Silhouette, true, [82.0, 20.0], [82.0, 75.0]);
    assert!(points(&[crease.clone(), beside]).contains(&[80.0, 50.0]));
    let hidden = segment(Silhouette, false, [80.0, 20.0], [80.0, 75.0]);
    assert!(points(&[crease, hidden]).contains(&[80.0, 50.0]));
    assert_eq!(points(&[segment(Crease, true, [0.0, 50.0], [80.0, 50.0])]), [[80.0, 50.0]]);
}

#[test]
fn a_models_own_curve_does_not_taper() {
    assert!(points(&[segment(Curve, true, [20.0, 50.0], [80.0, 50.0])]).is_empty());
}

#[test]
fn a_ring_has_no_tip_and_a_line_that_ends_on_itself_has_one() {
    let corners = [[20.0, 20.0], [60.0, 20.0], [60.0, 60.0], [20.0, 60.0]];
    let ring: Vec<LineSegment> = (0..4).map(|k| segment(Boundary, true, corners[k], corners[(k + 1) % 4])).collect();
    assert!(points(&ring).is_empty());
    let six = [[80.0, 10.0], [40.0, 10.0], [40.0, 60.0], [70.0, 60.0], [70.0, 40.0], [40.5, 40.0]];
    let six: Vec<LineSegment> = six.windows(2).map(|pair| segment(Boundary, true, pair[0], pair[1])).collect();
    assert_eq!(points(&six), [[80.0, 10.0]]);
}

#[test]
fn a_tip_continues_its_line_and_is_at_most_a_third_of_it() {
    for (length, expected) in [(75.0, 24.0), (30.0, 10.0)] {
        let all = layers(&[segment(Crease, true, [10.0, 50.0], [10.0 + length, 50.0])]);
        let [layer] = &all[..] else { panic!("one layer") };
        assert_eq!((layer.polylines[0].points_px.len(), layer.tips.len()), (2, 2));
        for tip in &layer.tips {
            assert!((tip[0].distance(tip[1]) - expected).abs() < 1e-9);
            assert!(layer.polylines[0].points_px.contains(&tip[0]));
        }
    }
}

#[test]
fn over_models_tips_are_as_long_as_what_their_lines_lost() {
    let mut tips = 0;
    let own = ["bust", "ant", "gear"].map(|name| (name, builtin(name)));
    for (name, mesh) in own.into_iter().chain(public_meshes(&["cow.obj", "suzanne.obj", "teapot.obj"])) {
        let scene = scene_of(vec![mesh], view("30,23", false));
        let found: VisibleLines = lines_with(&scene, &LineSettings::default());
        let [whole, tapered] =
            [false, true].map(|tapers| strokes(&found, &DrawingSettings { tapers, ..tapering() }).unwrap());
        assert_eq!(whole.len(), tapered.len(), "{name}");
        for (whole, tapered) in whole.iter().zip(&tapered) {
            tips += tapered.tips.len();
            let lengths = |lines: &[Vec<DVec2>]| -> f64 {
                lines.iter().flat_map(|line| line.windows(2)).map(|pair| pair[0].distance(pair[1])).sum()
            };
            let [before, after] =
                [whole, tapered].map(|strokes| strokes.polylines.iter().map(|line| line.length_px()).sum::<f64>());
            let gone = lengths(&tapered.tips);
            assert!((before - after - gone).abs() < 0.01 * (1.0 + before), "{name}: {before} {after} {gone}");
        }
    }
    assert!(tips > 20, "{tips}");
}

#[test]
fn a_pen_dxf_and_plain_values_keep_whole_lines() {
    let lines = lines(vec![segment(Crease, true, [20.0, 50.0], [80.0, 50.0])]);
    let tips = |settings: &DrawingSettings| svg(&lines, settings).unwrap().matches("stroke=\"none\"").count();
    assert_eq!(tips(&tapering()), 1);
    assert_eq!(tips(&DrawingSettings { is_for_pen: true, ..tapering() }), 0);
    let whole = DrawingSettings { tapers: false, ..tapering() };
    assert_eq!(dxf(&lines, &tapering()).unwrap(), dxf(&lines, &whole).unwrap());
    assert_eq!(drawn_layers(&lines, &tapering()).unwrap(), drawn_layers(&lines, &whole).unwrap());
}
