//! The fast search for visible lines against the reference that tests each piece against all faces and lines.

use crate::support::builtin;
use crate::support::growth::FAMILIES;
use crate::support::lines::{scene_of, view, without_equal};
use crate::support::shapes::mesh;
use tinta::edges::SilhouetteRule;
use tinta::lines::LineSegment;
use tinta::tolerances::SHORTEST_LINE;
use tinta::{LineSettings, Scene, VisibleLines};

/// How far an end may be off, pixels: a piece below the shortest length joins its neighbour, and lines that are farther away cut one
/// only in the reference.
const SAME_PX: f64 = SHORTEST_LINE * 512.0;

/// The differences between the visible pieces of both.
fn differences(name: &str, scene: &Scene, finds_hidden: bool) -> Vec<String> {
    let of = |reference| {
        let settings = LineSettings { finds_hidden, reference, ..LineSettings::default() };
        VisibleLines::of(scene, &settings).unwrap().segments
    };
    let (fast, reference) = (of(false), of(true));
    let visible = [&fast, &reference].map(|all| all.iter().filter(|segment| segment.is_visible).collect::<Vec<_>>());
    let [fast, reference] = &visible;
    assert!(!reference.is_empty(), "{name}");
    let mut found = Vec::new();
    for (whose, segments, others) in [("search", fast, reference), ("reference", reference, fast)] {
        for LineSegment { class, edge, ends_px: [a, b], .. } in without_equal(segments, others, SAME_PX) {
            found.push(format!(
                "{name}, hidden {finds_hidden}, only {whose}: {class:?} {edge:?} {a:?} {b:?} long {}",
                a.distance(*b)
            ));
        }
    }
    // A piece of the search alone is shown too much, one of the reference alone is missing.
    if !found.is_empty() {
        found.sort_by_key(|line| !line.contains("only search"));
        found.truncate(FEW);
        let px = |lines: &[&LineSegment]| lines.iter().map(|it| it.ends_px[0].distance(it.ends_px[1])).sum::<f64>();
        found.insert(
            0,
            format!("{name}, hidden {finds_hidden}: {:.1} px by search, {:.1} by reference", px(fast), px(reference)),
        );
    }
    found
}

/// Differences that are printed of a scene.
const FEW: usize = 6;

/// Fails with the differences of the first scenes.
fn assert_none(failures: &[String]) {
    let few: Vec<&str> = failures.iter().take(5 * FEW).map(String::as_str).collect();
    assert!(failures.is_empty(), "{} lines, the first:\n{}", failures.len(), few.join("\n"));
}

#[test]
fn the_search_shows_of_every_family_what_the_reference_shows() {
    let mut failures = Vec::new();
    for family in &FAMILIES {
        for camera in [view("30,20", false), view("0,0", true)] {
            for count in [60, 100] {
                let shape = (family.make)(count);
                let scene = scene_of(vec![mesh(shape.positions, shape.triangles)], camera.clone());
                for finds_hidden in [true, false] {
                    failures.extend(differences(&format!("{} of {count}", family.name), &scene, finds_hidden));
                }
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn the_search_shows_of_models_what_the_reference_shows() {
    let mut failures = Vec::new();
    for name in ["open-box", "gear"] {
        let mesh = builtin(name);
        for (at, parallel) in [("30,20", false), ("30,20", true), ("0,0", true)] {
            let scene = scene_of(vec![mesh.clone()], view(at, parallel));
            for finds_hidden in [true, false] {
                failures.extend(differences(name, &scene, finds_hidden));
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn the_reference_refuses_smooth_silhouettes_and_finds_outlines() {
    let mesh = builtin("open-box");
    let scene = scene_of(vec![mesh], view("30,20", false));
    let settings = LineSettings { reference: true, finds_outline: true, ..LineSettings::default() };
    let [found, fast] = [true, false].map(|reference| {
        let lines = VisibleLines::of(&scene, &LineSettings { reference, ..settings.clone() }).unwrap();
        lines.segments.into_iter().filter(|segment| segment.is_outline).count()
    });
    assert_eq!(found, fast);
    let smooth = LineSettings { silhouette: SilhouetteRule::Smooth, ..settings };
    assert!(VisibleLines::of(&scene, &smooth).unwrap_err().to_string().contains("ask for exact ones"));
}
