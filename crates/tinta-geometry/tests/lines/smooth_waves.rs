//! Smooth silhouettes of an open wavy surface, compared with a mesh with eighteen times as many faces: short contours
//! with little bend, ends on the rim, and counted breaks.

use crate::support::lines::{distance, scene_of, view};
use crate::support::shapes::{Random, mesh};
use glam::{DVec2, DVec3};
use tinta::Mesh;
use tinta::edges::{Class, SilhouetteRule};
use tinta::lines::{LineSettings, VisibleLines};

/// Excluded range around each change of visibility on the true contour, pixels: lines end slightly earlier or later
/// there.
const AROUND_CHANGES_PX: f64 = 3.0;

/// Cells along each side: 9,800 triangles, and 180,000 for the truth.
const CELLS: u32 = 70;
const FINE_CELLS: u32 = 300;

/// The waves, with inner vertices moved by up to a share of a cell.
fn waves(cells: u32, share: f64, random: &mut Random) -> Mesh {
    let mut positions = Vec::new();
    for place in (0..=cells).flat_map(|i| (0..=cells).map(move |j| [i, j])) {
        let [x, z] = place.map(|number| {
            let aside = (random.number() * 2.0 - 1.0) * share;
            let is_inner = number > 0 && number < cells;
            (f64::from(number) + if is_inner { aside } else { 0.0 }) / f64::from(cells) * 2.0 - 1.0
        });
        positions.push(DVec3::new(x, 0.18 * (5.0 * x).sin() * (4.0 * z).cos() + 0.1 * x * z, z));
    }
    let corners = (0..cells).flat_map(|i| (0..cells).map(move |j| i * (cells + 1) + j));
    let triangles = corners.flat_map(|a| [[a, a + 1, a + cells + 2], [a, a + cells + 2, a + cells + 1]]).collect();
    mesh(positions, triangles)
}

fn lines(mesh: Mesh, name: &str) -> VisibleLines {
    let settings = LineSettings { silhouette: SilhouetteRule::Smooth, counts_changes: true, ..LineSettings::default() };
    VisibleLines::of(&scene_of(vec![mesh], view(name, false)), &settings).unwrap()
}

fn pieces(lines: &VisibleLines, is_visible: bool, is_asked: impl Fn(Class) -> bool) -> Vec<[DVec2; 2]> {
    let asked = lines.segments.iter().filter(|piece| piece.is_visible == is_visible && is_asked(piece.class));
    asked.map(|piece| piece.ends_px).collect()
}

/// The largest distance of points of some segments from the nearest other segment; `is_left_out` excludes points.
fn worst(of: &[[DVec2; 2]], from: &[[DVec2; 2]], is_left_out: impl Fn(DVec2) -> bool) -> f64 {
    let nearest = |point: DVec2| from.iter().map(|ends| distance(point, *ends)).fold(f64::INFINITY, f64::min);
    let points = of.iter().flat_map(|[a, b]| [*a, a.midpoint(*b)]).filter(|point| !is_left_out(*point));
    points.map(nearest).fold(0.0, f64::max)
}

#[test]
fn away_from_where_waves_begin_and_end_to_hide_them_their_contours_are_met_within_a_pixel() {
    for name in ["200,20", "0,5", "45,35", "30,15"] {
        let truth = lines(waves(FINE_CELLS, 0.0, &mut Random(1)), name);
        let silhouette = |class: Class| class == Class::Silhouette;
        let [seen, hidden] = [true, false].map(|is_visible| pieces(&truth, is_visible, silhouette));
        let all = pieces(&truth, true, |_| true);
        let is_hidden = |end: &DVec2| hidden.as_flattened().iter().any(|other| other.distance(*end) < 1e-6);
        let changes: Vec<DVec2> = seen.as_flattened().iter().copied().filter(is_hidden).collect();
        let is_change = |point: DVec2| changes.iter().any(|change| change.distance(point) < AROUND_CHANGES_PX);
        for seed in 0..3 {
            let share = if seed == 0 { 0.0 } else { 0.25 };
            let found = lines(waves(CELLS, share, &mut Random(1234 << 20 | (2 * seed + 1))), name);
            let drawn = pieces(&found, true, |_| true);
            let [missed, invented] =
                [worst(&seen, &drawn, is_change), worst(&pieces(&found, true, silhouette), &all, is_change)];
            assert!(missed < 1.0 && invented < 1.0, "{name}, seed {seed}: {missed} px missed, {invented} invented");
            // Away from the counted breaks no line is missing.
            let breaks = found.changes.unwrap().places;
            let is_elsewhere = |point: DVec2| !breaks.iter().any(|at| DVec2::from(at.px).distance(point) < 10.0);
            let missed = worst(&seen, &drawn, is_elsewhere);
            assert!(missed < 1.0, "{name}, seed {seed}: {missed} px missed at one of {} breaks", breaks.len());
        }
    }
}
