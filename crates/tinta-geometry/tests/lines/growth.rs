//! How the exact lines' time grows, counted in boxes looked at, never by a clock; and lines that end before they are done.

use crate::support::drawn::{self, segment};
use crate::support::growth::{FAMILIES, Family};
use crate::support::lines::{lines, lines_with, scene_of, scene_of_family, view};
use crate::support::shapes::{Random, mesh};
use glam::DVec3;
use std::time::Duration;
use tinta::edges::Class;
use tinta::lines::{DrawingSettings, LineSettings, Phase, Progress, VisibleLines};
use tinta::{Error, Scene, Size};

fn family(name: &str) -> &'static Family {
    FAMILIES.iter().find(|family| family.name == name).unwrap()
}

/// Only the visible lines, the usual request of a drawing.
fn seen(scene: &Scene) -> VisibleLines {
    lines_with(scene, &LineSettings { finds_hidden: false, ..LineSettings::default() })
}

#[test]
fn every_family_has_about_as_many_triangles_as_asked_and_corners_that_there_are() {
    for family in &FAMILIES {
        for wanted in [1_000, 5_000] {
            let shape = (family.make)(wanted);
            let count = shape.triangles.len();
            assert!(
                count * 4 > wanted * 3 && count * 3 < wanted * 4,
                "{} ({}): {count} of {wanted}",
                family.name,
                family.what
            );
            let corners = shape.triangles.as_flattened();
            assert!(corners.iter().all(|corner| (*corner as usize) < shape.positions.len()), "{}", family.name);
        }
    }
}

#[test]
fn without_hidden_lines_the_same_is_seen_of_every_family() {
    for family in &FAMILIES {
        let scene = scene_of_family(family, 300);
        let visible = |lines: VisibleLines| -> f64 {
            lines.segments.iter().filter(|segment| segment.is_visible).map(crate::support::lines::length).sum()
        };
        let (all, alone) = (visible(lines(&scene)), visible(seen(&scene)));
        assert!((all - alone).abs() <= 1e-4 * all, "{}: {all} px and {alone} px", family.name);
    }
}

/// Boxes looked at for each triangle and each piece that is seen.
const MOST_BOXES: f64 = 1_500.0;

fn check_growth(sizes: &[usize]) {
    let mut failures = Vec::new();
    for family in &FAMILIES {
        for &triangles in sizes {
            let scene = scene_of_family(family, triangles);
            let found = seen(&scene);
            let each = found.times.compared as f64 / (scene.triangle_count() + found.segments.len()) as f64;
            println!("{} of {triangles}: {each:.0} boxes each, {} pieces", family.name, found.segments.len());
            // Around one corner or axis, in a heap and where cubes coincide everything lies in the same place.
            let most = match family.name {
                "fan" | "spokes" | "sticks" => 10.0 * MOST_BOXES,
                "twins" => 50.0 * MOST_BOXES,
                _ => MOST_BOXES,
            };
            if each > most {
                failures.push(format!("{} of {triangles}: {each:.0} boxes for each triangle and piece", family.name));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn time_grows_with_what_is_there_and_what_is_seen_briefly() {
    check_growth(&[250]);
}

#[test]
#[ignore = "exhaustive: up to 1,000 triangles of each family"]
fn time_grows_with_what_is_there_and_what_is_seen() {
    check_growth(&[250, 1_000]);
}

#[test]
fn the_outline_of_triangles_around_one_edge_takes_a_few_times_the_boxes_of_their_lines() {
    let scene = scene_of_family(family("book"), 1_000);
    let compared = |finds_outline: bool| {
        let settings = LineSettings { finds_hidden: false, finds_outline, ..LineSettings::default() };
        lines_with(&scene, &settings).times.compared as f64
    };
    let ratio = compared(true) / compared(false);
    assert!(ratio < 10.0, "{ratio} times the boxes");
}

#[test]
fn the_same_boxes_are_looked_at_every_time() {
    let scene = scene_of_family(family("hair"), 200);
    let compared = || seen(&scene).times.compared;
    assert_eq!(compared(), compared());
}

#[test]
fn within_any_time_all_lines_are_found_or_none() {
    let scene = scene_of_family(family("hair"), 400);
    let found =
        |limit: Duration| VisibleLines::with_progress(&scene, &LineSettings::default(), &Progress::within(limit));
    assert!(matches!(found(Duration::ZERO), Err(Error::OutOfTime { .. })));
    // However fast the machine is, one of these times is over in the midst of it.
    let mut milliseconds = 1.0;
    let segments = loop {
        match found(Duration::from_secs_f64(milliseconds / 1e3)) {
            Ok(whole) => break whole.segments,
            Err(Error::OutOfTime { .. }) => milliseconds *= 1.2,
            Err(error) => panic!("{error}"),
        }
    };
    assert_eq!(segments, lines(&scene).segments);
}

#[test]
fn work_is_given_up_while_it_looks_for_intersections() {
    let scene = scene_of_family(family("soup"), 1_500);
    let progress = Progress::default();
    let ended = std::thread::scope(|scope| {
        let work = scope.spawn(|| VisibleLines::with_progress(&scene, &LineSettings::default(), &progress));
        while matches!(progress.phase(), Phase::Reading | Phase::Preparing) && !work.is_finished() {
            std::thread::yield_now();
        }
        assert_eq!(progress.phase(), Phase::Intersections);
        progress.cancel();
        work.join().unwrap()
    });
    assert!(matches!(ended, Err(Error::Cancelled)));
    assert_eq!(progress.phase(), Phase::Intersections, "it went on to the lines");
}

#[test]
fn planes_through_one_axis_have_one_line_there() {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for plane in 0..5 {
        let (sin, cos) = (0.1 + std::f64::consts::PI * f64::from(plane) / 5.0).sin_cos();
        let first = positions.len() as u32;
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        positions.extend(corners.map(|(along, up)| DVec3::new(cos * along, up, sin * along)));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let found = lines(&scene_of(vec![mesh(positions, triangles)], view("30,20", false)));
    // Each square's diagonal cuts it in the middle; without counting once there would be ten times as many.
    assert_eq!(found.edges.intersection, 2);
    let drawn = found.segments.iter().filter(|segment| segment.class == Class::Intersection);
    assert_eq!(drawn.count(), 2);
}

#[test]
fn leaving_out_specks_ends_when_asked() {
    let found = seen(&scene_of_family(family("hair"), 200));
    let settings = DrawingSettings::default();
    let ended = |progress: &Progress| found.without_specks_with_progress(&settings, progress);
    let cancelled = Progress::default();
    cancelled.cancel();
    assert!(matches!(ended(&cancelled), Err(Error::Cancelled)));
    assert!(matches!(ended(&Progress::within(Duration::ZERO)), Err(Error::OutOfTime { .. })));
    let whole = found.without_specks(&settings).unwrap();
    assert!(whole.segments.len() < found.segments.len(), "nothing to leave out");
    assert_eq!(ended(&Progress::within(Duration::from_secs(3_600))).unwrap().segments, whole.segments);
    let late = Progress::within(Duration::ZERO);
    late.cancel();
    assert!(matches!(ended(&late), Err(Error::Cancelled)));
}

/// A square lattice of so many lines each way, cut at the crossings, and as many long lines across it. Its cells are narrower than
/// its lines, so every piece is a sliver's side. Lines are hidden, because progress ends with the counts of the hidden ones.
fn lattice_with_long_lines(count: usize) -> VisibleLines {
    let at = |number: usize| 10.0 + 0.5 * number as f64;
    let mut segments = Vec::new();
    for line in 0..=count {
        for piece in 0..count {
            let (from, to, across) = (at(piece), at(piece + 1), at(line));
            segments.push(segment(Class::Crease, false, [from, across], [to, across]));
            segments.push(segment(Class::Crease, false, [across, from], [across, to]));
        }
        segments.push(segment(Class::Crease, false, [at(0), at(line) + 0.1], [at(count), at(line) + 0.7]));
    }
    VisibleLines { size: Size { width: 500, height: 500 }, ..drawn::lines(segments) }
}

#[test]
fn specks_are_looked_for_in_time_that_follows_the_lines() {
    let compared = |count: usize| {
        let lines = lattice_with_long_lines(count);
        let progress = Progress::default();
        lines.without_specks_with_progress(&DrawingSettings::default(), &progress).unwrap();
        assert_eq!(progress.phase(), Phase::TooShort);
        let (done, total) = progress.state();
        assert_eq!(done, total, "all that counts is done");
        let each = progress.compared() as f64 / lines.segments.len() as f64;
        println!("{} lines: {each:.1} boxes each", lines.segments.len());
        each
    };
    let (few, many) = (compared(20), compared(80));
    assert!(few > 0.0, "the lattice has no sides to look at");
    assert!(many <= 4.0 * few.max(50.0), "{few} boxes for each line, then {many}");
}

/// During a phase of a scene's lines: the share of its steps done, and the share of the phase's boxes tested. Empty if the phase
/// ends before a sample.
fn shares_on_the_way(scene: &Scene, phase: Phase) -> Vec<[f64; 2]> {
    let progress = Progress::default();
    let mut seen: Vec<(usize, usize, u64)> = Vec::new();
    std::thread::scope(|scope| {
        let work = scope.spawn(|| VisibleLines::with_progress(scene, &LineSettings::default(), &progress));
        while !work.is_finished() {
            if progress.phase() == phase {
                let ((done, total), compared) = (progress.state(), progress.compared());
                let is_new = seen.last().is_none_or(|last| done > last.0);
                if progress.phase() == phase && total > 0 && is_new {
                    seen.push((done, total, compared));
                }
            }
            std::thread::yield_now();
        }
    });
    // A phase without comparisons takes no time.
    let is_whole = |(done, total, all): &&(usize, usize, u64)| done == total && *all > 0;
    let Some(&(_, _, all)) = seen.last().filter(is_whole) else { return Vec::new() };
    let share =
        |(done, total, compared): (usize, usize, u64)| [done as f64 / total as f64, compared as f64 / all as f64];
    seen.into_iter().map(share).collect()
}

fn check_time_left(families: &[(&str, usize)]) {
    let mut places = 0;
    for &(name, triangles) in families {
        let scene = scene_of_family(family(name), triangles);
        for phase in [Phase::Intersections, Phase::Lines] {
            for [done, compared] in shares_on_the_way(&scene, phase) {
                if (0.25..=0.9).contains(&done) {
                    // The remaining work as estimated there, against the actual one: boxes stand for time.
                    let ratio = compared * (1.0 - done) / done / (1.0 - compared).max(1e-9);
                    assert!((0.5..=2.0).contains(&ratio), "{name} {phase:?}: {ratio} times what remains at {done}");
                    places += 1;
                }
            }
        }
    }
    // The soup alone has some thousand lines, and sampling them takes no time compared with computing one.
    assert!(places > 20, "{places}");
}

#[test]
fn the_time_left_follows_from_what_is_done_briefly() {
    check_time_left(&[("soup", 1_000)]);
}

#[test]
#[ignore = "exhaustive: five families"]
fn the_time_left_follows_from_what_is_done() {
    check_time_left(&[("soup", 1_000), ("book", 1_000), ("confetti", 3_000), ("waffle", 200), ("rail", 2_000)]);
}

#[test]
fn triangles_of_one_plane_seen_edge_on_are_one_line_whose_cuts_are_those_of_what_is_near() {
    let mut random = Random::seeded(11);
    let corners: Vec<DVec3> = (0..900).map(|_| DVec3::new(random.number(), random.number(), 0.0)).collect();
    let triangles = (0..300).map(|face| [face * 3, face * 3 + 1, face * 3 + 2]).collect();
    let scene = scene_of(vec![mesh(corners, triangles)], view("top", false));
    let found = seen(&scene);
    let mut ranges: Vec<[f64; 2]> = found
        .segments
        .iter()
        .map(|segment| segment.ends_px.map(|end| end.x))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut drawn, mut end) = (0.0, ranges[0][0]);
    for range in &ranges {
        drawn += (range[1] - range[0].max(end)).max(0.0);
        end = end.max(range[1]);
    }
    let extent = end - ranges[0][0];
    assert!(extent > 400.0 && extent - drawn < 0.01, "{drawn} px of {extent}");
    let twice = ranges.iter().map(|[from, to]| to - from).sum::<f64>() - drawn;
    assert!(twice < 0.05, "{twice} px are drawn twice");
    // All 900 edges overlap: each is tested once for all, not once for each of their ends.
    let each = found.times.compared as f64 / 900.0;
    println!("{each:.0} boxes for each edge, {} pieces", found.segments.len());
    assert!(each < 600.0, "{each:.0} boxes for each edge");
}
