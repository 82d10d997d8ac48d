//! Hidden lines as drawn: never under a visible line, and each once; independent of the order in which a scene is written.

use crate::support::lines::{assert_near, length, lines, px, scene_of, shuffled, view};
use crate::support::shapes::{Random, cuboid, joined, mesh};
use glam::DVec3;
use std::collections::BTreeMap;
use tinta::edges::Class;
use tinta::lines::{HiddenLines, Layer, LineSettings, VisibleLines, chain, drawn_layers, svg};
use tinta::mesh::SectionPlane;
use tinta::{DrawingSettings, Mesh, Scene};

const NEAR: f64 = 1e-6;

/// The length of the hidden lines drawn, and of those replaced by others.
fn hidden(lines: &VisibleLines) -> [f64; 2] {
    [false, true].map(|is_covered| {
        let of_it = lines.segments.iter().filter(|segment| !segment.is_visible && segment.is_covered == is_covered);
        of_it.map(length).sum()
    })
}

/// Pixels of a unit in the middle of a scene seen straight.
fn unit(scene: &Scene, along: DVec3) -> f64 {
    px(scene, along).distance(px(scene, DVec3::ZERO))
}

#[track_caller]
fn assert_hidden(scene: &Scene, expected_units: [f64; 2], what: &str) {
    let (found, unit) = (hidden(&lines(scene)), unit(scene, DVec3::X));
    for (found, expected) in found.into_iter().zip(expected_units) {
        assert_near(found, expected * unit, NEAR * unit, what);
    }
}

fn bar(low: [f64; 3], high: [f64; 3]) -> Mesh {
    cuboid(low.into(), high.into())
}

#[test]
fn no_hidden_line_is_drawn_under_a_visible_one() {
    let from = |meshes: Vec<Mesh>, name: &str| scene_of(meshes, view(name, true));
    let cube = || vec![bar([0.0; 3], [1.0; 3])];
    assert_hidden(&from(cube(), "front"), [0.0, 4.0], "the back of a cube lies under its front");
    let sheet = |z: f64| mesh([[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]].map(DVec3::from).into(), vec![[0, 1, 2]]);
    assert_hidden(&from(vec![sheet(0.0), sheet(-1.0)], "front"), [0.0, 2.0 + 2f64.sqrt()], "one sheet behind another");
    // A beam under a slab: of its eight long and short edges and four upright ones the drawing has only the rectangle.
    let slab = bar([0.0, 1.0, 0.0], [4.0, 1.2, 4.0]);
    let beam = bar([0.5, 0.5, 1.9], [3.5, 0.7, 2.1]);
    assert_hidden(&from(vec![slab.clone(), beam.clone()], "top"), [6.4, 16.0 + 6.4], "a beam under a slab");
    // A second one below, shorter at one end: the part that does not lie under the first.
    let lower = bar([0.53, 0.0, 1.9], [3.5, 0.2, 2.1]);
    assert_hidden(&from(vec![slab, beam, lower], "top"), [6.4 + 0.2, 16.0 + 6.4 + 6.34 * 2.0 - 0.2], "two beams");
}

#[test]
fn a_hidden_line_is_drawn_from_where_no_other_lies_on_it() {
    // A wide sheet behind a narrow one: their lower rims overlap, then the wide one's continues.
    let sheet = |x: f64, y: f64, z: f64| {
        mesh([[0.0, 0.0, z], [x, 0.0, z], [x, y, z], [0.0, y, z]].map(DVec3::from).into(), vec![[0, 1, 2], [0, 2, 3]])
    };
    let before = sheet(6.0, 6.0, 2.0);
    let scene = scene_of(vec![before, sheet(2.0, 3.0, 1.0), sheet(5.0, 2.0, 0.0)], view("front", true));
    let found = lines(&scene);
    // The left and the lower rim of both lie under the first one's. The right and upper rim remain of each; they cross without
    // overlapping.
    let unit = unit(&scene, DVec3::X);
    assert_near(hidden(&found)[0], (3.0 + 2.0 + 2.0 + 5.0) * unit, NEAR, "drawn");
    let drawn: f64 =
        drawn_layers(&found, &DrawingSettings { hidden: HiddenLines::Dashed, ..DrawingSettings::default() })
            .unwrap()
            .iter()
            .filter(|layer| !layer.layer.is_visible())
            .flat_map(|layer| &layer.paths)
            .flat_map(|path| path.points_px.windows(2).map(|pair| pair[0].distance(pair[1])).collect::<Vec<_>>())
            .sum();
    assert_near(drawn, 12.0 * unit, 1e-3, "in layers");
}

#[test]
fn of_hidden_lines_on_one_another_the_first_class_is_drawn() {
    // Behind a wall the crease of a roof lies under the rim of a sheet, as long as that is.
    let wall = bar([-3.0, -3.0, 5.0], [3.0, 3.0, 5.1]);
    let roof = mesh(
        [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, -1.0, -1.0], [-2.0, -1.0, -1.0], [2.0, 1.0, -1.0], [-2.0, 1.0, -1.0]]
            .map(DVec3::from)
            .into(),
        vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [0, 4, 5]],
    );
    let sheet = mesh([[-1.0, 0.0, -3.0], [1.0, 0.0, -3.0], [0.0, 2.0, -3.0]].map(DVec3::from).into(), vec![[0, 1, 2]]);
    for order in [[0, 1, 2], [2, 1, 0]] {
        let meshes = order.map(|k| [&wall, &roof, &sheet][k].clone());
        let scene = scene_of(meshes.to_vec(), view("front", true));
        let (found, unit) = (lines(&scene), unit(&scene, DVec3::X));
        let of = |class: Class, is_covered: bool| -> f64 {
            let is_meant =
                |s: &&tinta::lines::LineSegment| (s.is_visible, s.class, s.is_covered) == (false, class, is_covered);
            found.segments.iter().filter(is_meant).map(length).sum::<f64>() / unit
        };
        assert_near(of(Class::Crease, true), 2.0, NEAR, "the crease under the rim");
        assert_near(of(Class::Crease, false), 2.0, NEAR, "the crease beside it");
        assert_near(of(Class::Boundary, true), 0.0, NEAR, "rims");
    }
}

#[test]
fn what_is_covered_is_in_no_path_and_no_file() {
    let scene = scene_of(vec![bar([0.0; 3], [1.0; 3])], view("front", true));
    let found = lines(&scene);
    assert!(found.segments.iter().filter(|segment| !segment.is_visible).all(|segment| segment.is_covered));
    assert!(chain(&found.segments).iter().all(|path| path.is_visible));
    for hidden in [HiddenLines::Dashed, HiddenLines::Ghost] {
        for is_for_pen in [false, true] {
            let settings = DrawingSettings { hidden, is_for_pen, ..DrawingSettings::default() };
            let layers = drawn_layers(&found, &settings).unwrap();
            assert_eq!(layers.iter().map(|layer| layer.layer).collect::<Vec<_>>(), [Layer::Visible(Class::Silhouette)]);
            assert!(!svg(&found, &settings).unwrap().contains("hidden-"));
        }
    }
}

/// Length of the hidden lines drawn, by class.
fn drawn_by_class(lines: &VisibleLines) -> BTreeMap<Class, f64> {
    let mut sums = BTreeMap::new();
    for segment in lines.segments.iter().filter(|segment| !segment.is_visible && !segment.is_covered) {
        *sums.entry(segment.class).or_default() += length(segment);
    }
    sums
}

/// Boxes and steps on a lattice, which have many lines on one another.
fn blocks(random: &mut Random) -> Vec<Mesh> {
    let mut number = |count: f64| (random.number() * count).floor();
    let count = 2 + number(4.0) as usize;
    let block = |_| {
        let low = DVec3::new(number(4.0), number(4.0), number(4.0));
        let size = DVec3::new(number(3.0), number(3.0), number(3.0)) + 1.0;
        cuboid(low, low + size)
    };
    (0..count).map(block).collect()
}

/// The same block with other diagonals: every face begins at its next corner.
fn cut_otherwise(block: &Mesh) -> Mesh {
    let pairs = block.triangles.chunks(2);
    let cut = pairs.flat_map(|pair| {
        // In the faces 0 1 2 and 0 2 3 the diagonal is 0 to 2; in 0 1 3 and 1 2 3 it is the other.
        let [first, second] = [pair[0], pair[1]];
        let common: Vec<u32> = first.into_iter().filter(|corner| second.contains(corner)).collect();
        let apex = |of: [u32; 3]| of.iter().position(|corner| !common.contains(corner)).unwrap();
        let [mut first, mut second] = [first, second];
        let (turn_first, turn_second) = (apex(first), apex(second));
        first.rotate_left(turn_first);
        second.rotate_left(turn_second);
        // first is p, a, b and second q, b, a.
        [[first[0], first[1], second[0]], [second[0], second[1], first[0]]]
    });
    Mesh { triangles: cut.collect(), ..block.clone() }
}

fn inside_out(block: &Mesh) -> Mesh {
    Mesh { triangles: block.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect(), ..block.clone() }
}

#[test]
fn the_hidden_lines_that_are_drawn_do_not_change_with_how_a_scene_is_written() {
    let mut random = Random(77 << 40 | 3);
    let views = ["front", "top", "right", "iso", "30,15", "45,45", "0,30"];
    for number in 0..60 {
        let blocks = blocks(&mut random);
        let camera = view(views[number % views.len()], number % 3 != 0);
        let expected = drawn_by_class(&lines(&scene_of(blocks.clone(), camera.clone())));
        let rewritten = [
            ("in another order", blocks.iter().rev().cloned().collect()),
            ("with other diagonals", blocks.iter().map(cut_otherwise).collect()),
            (
                "with one part inside out",
                blocks.iter().enumerate().map(|(k, b)| if k == 0 { inside_out(b) } else { b.clone() }).collect(),
            ),
            (
                "with faces in another order",
                blocks.iter().map(|block| shuffled(block, &mut random)).collect::<Vec<Mesh>>(),
            ),
        ];
        for (what, meshes) in rewritten {
            let actual = drawn_by_class(&lines(&scene_of(meshes, camera.clone())));
            let classes: std::collections::BTreeSet<Class> = expected.keys().chain(actual.keys()).copied().collect();
            for class in classes {
                let [a, b] = [&expected, &actual].map(|sums| sums.get(&class).copied().unwrap_or_default());
                assert!((a - b).abs() <= 0.05, "scene {number} {what}: {class:?} {b} px instead of {a}");
            }
        }
    }
}

#[test]
fn one_object_or_several_have_the_same_hidden_lines() {
    // Apart, to prevent a third face on an edge when corners are joined.
    let parts = [
        bar([0.0, 0.0, 0.0], [4.0, 3.0, 1.0]),
        bar([1.0, 1.0, -2.0], [3.0, 2.0, -1.0]),
        bar([1.0, 1.0, -5.0], [2.0, 2.0, -4.0]),
    ];
    for name in ["front", "top", "right", "30,15"] {
        let [one, several] =
            [vec![joined(&parts)], parts.to_vec()].map(|meshes| hidden(&lines(&scene_of(meshes, view(name, true)))));
        assert_near(one[0], several[0], 1e-6, name);
        assert!(one[1] > 0.0 || name == "30,15", "{name}: some lie on others");
    }
}

#[test]
fn strokes_of_a_cut_seen_edge_on_are_covered_by_its_outline() {
    let plane = SectionPlane { normal: DVec3::Y, offset: 0.5, is_of_file: false };
    let (cut, _) = cuboid(DVec3::ZERO, DVec3::ONE).section(&[plane], Some(0.1)).unwrap();
    for (at, is_edge_on) in [("front", true), ("30,0", true), ("30,20", false)] {
        let scene = scene_of(vec![cut.clone()], view(at, true));
        let found = VisibleLines::of(&scene, &LineSettings::default()).unwrap();
        let strokes = || found.segments.iter().filter(|segment| segment.class == Class::Curve && segment.is_visible);
        assert!(strokes().count() > 5 && strokes().all(|stroke| stroke.is_covered == is_edge_on), "{at}");
    }
}
