//! Faces that meet in ways a textbook's do not.

use super::case::{Case, Drawing, Group, Study};
use crate::stress::{Shape, Variant};

pub(super) fn cases() -> Vec<Case> {
    let rendered = |name: &str, shape| Case::rendered(Group::Topology, name, Drawing { shape, ..Drawing::default() });
    let large = |name: &str, shape| {
        let variants = Variant::of_lines();
        Case::rendered(Group::Topology, name, Drawing { shape, variants, study: Study::Picture, ..Drawing::default() })
    };
    let infinite = f64::INFINITY;
    vec![
        rendered("one triangle", Shape::Triangle(1.0)).with("boundary", 3.0, 3.0),
        // Its base lies on a side of the triangle, which is split there: their common side is no boundary.
        rendered("a needle a million times as long as wide", Shape::Needle(1e6)).with("boundary", 5.0, 5.0),
        rendered("triangles without area among others", Shape::ZeroAreas).with("boundary", 0.0, 0.0),
        rendered("triangles with next to no area among others", Shape::Slivers),
        rendered("each triangle three times", Shape::Duplicates).with("non_manifold", 0.0, 0.0),
        // The exact lines take two faces back to back for one sheet: the cube's own lines remain.
        rendered("each triangle also the other way round", Shape::OppositeDuplicates)
            .with("non_manifold", 0.0, 0.0)
            .with("doubled_pairs", 12.0, 12.0),
        // Bars are thin, too, and no two sides of one sheet.
        rendered("a fence of 30 bars", Shape::Fence(30)).with("doubled_pairs", 0.0, 0.0),
        rendered("five faces on an edge", Shape::Fins(5)).with("non_manifold", 1.0, 1.0),
        rendered("a Moebius strip", Shape::Moebius).with("boundary", 128.0, 128.0),
        rendered("inside out", Shape::InsideOut(3)).with("boundary", 0.0, 0.0),
        rendered("T-junctions", Shape::TJunction),
        // Both squares between them are inside.
        rendered("cubes with a side in common", Shape::Touching).with("areas", 1.0, 1.0).with(
            "doubled_pairs",
            0.0,
            0.0,
        ),
        rendered("cubes that share part of a face", Shape::Contact),
        rendered("cubes that pass through one another", Shape::Piercing).with("intersection", 1.0, 40.0),
        rendered("a vertex that is not a number", Shape::BadVertex(f64::NAN)).with("boundary", 0.0, 0.0),
        rendered("a vertex at infinity", Shape::BadVertex(infinite)).with("boundary", 0.0, 0.0),
        // Next to that the rest of the cube is a point.
        Case::refused(
            Group::Topology,
            "a vertex 1e50 away",
            Drawing { shape: Shape::BadVertex(1e50), ..Drawing::default() },
            "model",
            "nothing is left to draw",
        ),
        large("a fan of 100,000 triangles", Shape::Fan(100_000)),
        large("a million triangles that share nothing", Shape::Isolated(1_000_000)),
    ]
}
