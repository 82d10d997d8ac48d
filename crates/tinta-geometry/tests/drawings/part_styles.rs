//! Styles of parts over random scenes: a ghost hides nothing, an occluder is not drawn, and colours change no geometry.

use crate::support::lines::without_equal;
use crate::support::random_scenes::random_scene;
use crate::support::shapes::{Random, cuboid, joined};
use glam::DVec3;
use std::cell::Cell;
use std::sync::Arc;
use tinta::edges::{Class, ClassSet};
use tinta::lines::{HiddenLines, LineSegment, PageSize, PartRules, drawn_layers, svg};
use tinta::mesh::NamedPart;
use tinta::settings::Value as _;
use tinta::{CameraSettings, DrawingSettings, LineSettings, Mesh, Scene, SceneSettings, VisibleLines};

/// Kinds of random scenes: separate triangles, boxes, spheres, triangles over common points.
const KINDS: u32 = 4;

/// How far an end may be off by the order of additions, pixels.
const SAME_PX: f64 = 1e-6;

const NAMES: [&str; 3] = ["arm", "bolt 1", "bolt 2"];

/// A mesh whose triangles belong to these parts, by the numbers of their names.
fn with_parts(mesh: &Mesh, of_triangle: impl Fn(usize) -> u32) -> Mesh {
    let parts = NAMES.map(|name| NamedPart { name: name.to_owned(), within: tinta::mesh::NONE }).to_vec();
    Mesh {
        parts,
        triangle_parts: (0..mesh.triangles.len()).map(|face| of_triangle(face) % 3).collect(),
        ..mesh.clone()
    }
}

/// A random scene with parts: whole meshes, or in scenes of one mesh the triangles and in spheres both sides.
fn scene(kind: u32, random: &mut Random) -> Scene {
    let mut scene = random_scene(kind, random);
    for (number, object) in scene.objects.iter_mut().enumerate() {
        let mesh = &object.mesh;
        let parted = match kind {
            1 => with_parts(mesh, |_| number as u32),
            2 => with_parts(mesh, |face| {
                number as u32 + u32::from(mesh.positions[mesh.triangles[face][0] as usize].x > object.offset.x)
            }),
            _ => with_parts(mesh, |face| face as u32),
        };
        *object = object.with_mesh(Arc::new(parted));
    }
    scene
}

fn settings(rules: &str) -> LineSettings {
    LineSettings { parts: PartRules::parse(rules).ok().unwrap(), ..LineSettings::default() }
}

fn found(scene: &Scene, rules: &str) -> VisibleLines {
    VisibleLines::of(scene, &settings(rules)).unwrap()
}

fn visible(lines: &VisibleLines) -> Vec<&LineSegment> {
    lines.segments.iter().filter(|segment| segment.is_visible).collect()
}

fn name<'a>(lines: &'a VisibleLines, segment: &LineSegment) -> &'a str {
    &lines.parts[segment.part as usize].name
}

/// Calls a check with scenes of all kinds.
fn for_scenes(count: u64, check: impl Fn(&Scene, &str, u32)) {
    for kind in 0..KINDS {
        for seed in 0..count {
            let random = &mut Random(0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(1000 * u64::from(kind) + seed + 1));
            check(&scene(kind, random), &format!("kind {kind}, seed {seed}"), kind);
        }
    }
}

#[test]
fn ghosts_are_visible_everywhere() {
    for_scenes(40, |scene, which, _| {
        let lines = found(scene, "*: ghost");
        assert!(lines.segments.iter().all(|segment| segment.is_visible), "{which}");
        let smooth = LineSettings { silhouette: tinta::edges::SilhouetteRule::Smooth, ..settings("*: ghost") };
        let smooth = VisibleLines::of(scene, &smooth).unwrap();
        assert!(smooth.segments.iter().all(|segment| segment.is_visible), "{which}, smooth");
    });
}

#[test]
fn other_parts_are_drawn_as_if_ghosts_were_not_there() {
    let changed = Cell::new(0);
    for_scenes(40, |scene, which, _| {
        let mut without = scene.clone();
        for object in &mut without.objects {
            let mesh = &object.mesh;
            let kept: Vec<usize> = (0..mesh.triangles.len()).filter(|face| mesh.triangle_parts[*face] != 0).collect();
            let of_kept = |list: &[u32]| kept.iter().map(|face| list[*face]).collect();
            let rest = Mesh {
                triangles: kept.iter().map(|face| mesh.triangles[*face]).collect(),
                triangle_parts: of_kept(&mesh.triangle_parts),
                ..(**mesh).clone()
            };
            *object = object.with_mesh(Arc::new(rest));
        }
        changed.set(
            changed.get()
                + without_equal(&visible(&found(scene, "arm: ghost")), &visible(&found(scene, "")), SAME_PX).len(),
        );
        // An edge that both share ends a surface where the other part is taken away.
        let is_shared = |segment: &LineSegment| {
            let mesh = &scene.objects[segment.object as usize].mesh;
            let arms = mesh.triangles.iter().zip(&mesh.triangle_parts).filter(|(_, part)| **part == 0);
            let ends = segment.edge.unwrap();
            arms.into_iter().any(|(corners, _)| {
                ends.iter().all(|end| corners.iter().any(|corner| mesh.file_vertices[*corner as usize] == *end))
            })
        };
        for others in ["", "bolt 1: occlude-only"] {
            let (ghosted, without) = (found(scene, &format!("{others}; arm: ghost")), found(&without, others));
            let is_compared = |lines: &VisibleLines, segment: &LineSegment| {
                name(lines, segment) != "arm" && segment.class != Class::Intersection && !is_shared(segment)
            };
            let [with, without] = [&ghosted, &without].map(|lines| {
                let mut visible = visible(lines);
                visible.retain(|segment| is_compared(lines, segment));
                visible
            });
            let only: Vec<_> =
                [without_equal(&with, &without, SAME_PX), without_equal(&without, &with, SAME_PX)].concat();
            assert!(only.is_empty(), "{which}, {others}: {only:#?}");
        }
    });
    assert!(changed.get() > 100, "ghosts show what they hid: {} lines", changed.get());
}

#[test]
fn an_occluder_loses_its_lines_and_others_keep_theirs() {
    let mut lost = 0;
    for_scenes(40, |scene, which, _| {
        let (before, after) = (found(scene, ""), found(scene, "bolt*: occlude-only"));
        let [all, rest] = [&before, &after].map(visible);
        assert!(without_equal(&rest, &all, SAME_PX).is_empty(), "{which}: new lines");
        assert!(rest.iter().all(|segment| name(&after, segment) == "arm"), "{which}");
        let gone = without_equal(&all, &rest, SAME_PX);
        assert!(gone.iter().all(|segment| name(&before, segment) != "arm"), "{which}: lost lines");
    });
    let random = &mut Random(7);
    let scene = scene(1, random);
    lost += found(&scene, "").segments.len() - found(&scene, "bolt*: occlude-only").segments.len();
    assert!(lost > 0);
}

#[test]
fn looks_change_no_geometry() {
    for_scenes(24, |scene, which, _| {
        let plain = found(scene, "");
        let styled = found(scene, "bolt*: color=red, line-width=3; bolt 2: hidden=dashed, color=blue; *: solid");
        let without_look = |lines: &VisibleLines| -> Vec<LineSegment> {
            lines.segments.iter().map(|segment| LineSegment { look: 0, ..segment.clone() }).collect()
        };
        assert_eq!(without_look(&plain), without_look(&styled), "{which}");
        assert_eq!(plain.looks.len(), 1, "{which}");
        let drawing = DrawingSettings { min_length: Some("0".parse().unwrap()), ..DrawingSettings::default() };
        let length = |lines: &VisibleLines| -> f64 {
            let drawn = drawn_layers(lines, &drawing).unwrap();
            let visible = drawn.iter().filter(|layer| layer.layer.is_visible());
            let paths = visible.flat_map(|layer| &layer.paths);
            paths
                .flat_map(|path| &path.segments)
                .map(|piece| {
                    let [a, b] = lines.segments[*piece].ends_px;
                    a.distance(b)
                })
                .sum()
        };
        assert!((length(&plain) - length(&styled)).abs() < 1e-6, "{which}");
        let text = svg(&styled, &drawing).unwrap();
        let mut ids: Vec<&str> = text.split("<g id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), count, "{which}");
    });
}

#[test]
fn classes_and_crease_angles_are_those_of_the_part() {
    for_scenes(24, |scene, which, _| {
        let rules = "arm: classes=silhouette+intersection; bolt 1: crease-angle=0; bolt 2: crease-angle=170";
        let (plain, lines) = (found(scene, ""), found(scene, rules));
        for segment in &lines.segments {
            let is_allowed = match name(&lines, segment) {
                "arm" => ClassSet::of(&[Class::Silhouette, Class::Intersection]).contains(segment.class),
                "bolt 2" => segment.class != Class::Crease || segment.angle_degrees.unwrap() > 169.0,
                _ => true,
            };
            assert!(is_allowed, "{which}: {segment:?}");
        }
        let creases = |lines: &VisibleLines| {
            lines.segments.iter().filter(|it| it.class == Class::Crease && name(lines, it) == "bolt 1").count()
        };
        assert!(creases(&lines) >= creases(&plain), "{which}");
    });
}

#[test]
fn the_search_shows_what_the_reference_shows() {
    for_scenes(16, |scene, which, _| {
        for rules in ["arm: ghost; bolt 1: occlude-only", "bolt*: ghost"] {
            for finds_hidden in [true, false] {
                let of = |reference| {
                    VisibleLines::of(scene, &LineSettings { reference, finds_hidden, ..settings(rules) }).unwrap()
                };
                let (fast, reference) = (of(false), of(true));
                let [fast, reference] = [&fast, &reference].map(visible);
                let only =
                    [without_equal(&fast, &reference, SAME_PX), without_equal(&reference, &fast, SAME_PX)].concat();
                assert!(only.is_empty(), "{which}, {rules}, hidden {finds_hidden}: {only:#?}");
            }
        }
    });
}

#[test]
fn the_last_rule_of_each_setting_counts_and_hidden_lines_follow() {
    let random = &mut Random(3);
    let lines = found(&scene(1, random), "*: color=red, hidden=dashed; arm: color=blue; arm: line-width=4");
    let drawing = DrawingSettings { min_length: Some("0".parse().unwrap()), ..DrawingSettings::default() };
    let layers = drawn_layers(&lines, &drawing).unwrap();
    let [arm, others]: [Vec<_>; 2] =
        [true, false].map(|is_arm| layers.iter().filter(|it| it.part.contains("arm") == is_arm).collect());
    assert!(arm.iter().any(|layer| !layer.layer.is_visible() && !layer.dash_px.is_empty() && layer.width_px == 2.0));
    assert!(
        arm.iter().filter(|it| it.layer.is_visible()).all(|it| it.color.to_string() == "#0000ff" && it.width_px == 4.0)
    );
    assert!(others.iter().filter(|it| it.layer.is_visible()).all(|it| it.color.to_string() == "#ff0000"));
    assert_eq!(lines.drawing(0, &drawing).hidden, HiddenLines::None);
}

#[test]
fn on_paper_hidden_lines_are_dashed_and_ghosts_chain_lines_in_line_widths() {
    let random = &mut Random(3);
    let lines = found(&scene(1, random), "arm: ghost");
    let paper = PageSize::Paper("A4".parse().unwrap());
    for (page_size, ghost, hidden) in [(PageSize::Unset, 0, 6.0), (paper, 6, 11.0)] {
        let drawing = DrawingSettings {
            page_size,
            hidden: HiddenLines::Dashed,
            min_length: Some("0".parse().unwrap()),
            ..DrawingSettings::default()
        };
        let layers = drawn_layers(&lines, &drawing).unwrap();
        let (mut ghosts, mut dashed) = (0, 0);
        for layer in &layers {
            let widths: Vec<f64> = layer.dash_px.iter().map(|length| length / layer.width_px).collect();
            if layer.layer.is_visible() {
                assert_eq!(widths.len(), if layer.part.contains("arm") { ghost } else { 0 }, "{layer:?}");
                ghosts += usize::from(layer.part.contains("arm"));
            } else {
                assert!((widths[0] - hidden).abs() < 1e-9 && widths.len() == 2, "{widths:?}");
                dashed += 1;
            }
        }
        assert!(ghosts > 0 && dashed > 0);
    }
}

/// A wall of blocks side by side along x, a part each, and the same wall as one block.
fn wall(cuts: &[f64]) -> [Mesh; 2] {
    let block = |from: f64, to: f64| cuboid(DVec3::new(from, 0.0, 0.0), DVec3::new(to, 1.0, 0.5));
    let blocks: Vec<Mesh> = cuts.windows(2).map(|ends| block(ends[0], ends[1])).collect();
    [with_parts(&joined(&blocks), |face| (face / 12) as u32), block(cuts[0], cuts[cuts.len() - 1])]
}

fn visible_px(mesh: Mesh, settings: &LineSettings, view: &str) -> f64 {
    let camera = CameraSettings { view: view.parse().unwrap(), ..CameraSettings::default() };
    let scene = Scene::new([Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap();
    let lines = VisibleLines::of(&scene, settings).unwrap();
    visible(&lines).iter().map(|segment| segment.ends_px[0].distance(segment.ends_px[1])).sum()
}

#[test]
fn joined_blocks_are_drawn_as_one_and_blocks_of_other_materials_are_not() {
    let random = &mut Random(11);
    let joins = LineSettings { joins_parts: true, ..LineSettings::default() };
    for count in [2, 2, 3, 3, 4, 5] {
        let mut cuts = vec![0.0];
        (0..count).for_each(|number| cuts.push(cuts[number] + 0.3 + random.number()));
        let view = format!("{},{}", (random.number() * 360.0).round(), 10.0 + (random.number() * 60.0).round());
        let [blocks, whole] = wall(&cuts);
        let px = |mesh: &Mesh, settings: &LineSettings| visible_px(mesh.clone(), settings, &view);
        let plain = px(&whole, &joins);
        assert!((px(&blocks, &joins) - plain).abs() < 1e-3, "{count} blocks from {view}");
        assert!(px(&blocks, &LineSettings::default()) > plain + 10.0, "{count} blocks from {view}");
        let materials = (0..blocks.triangles.len()).map(|face| (face / 12) as u32).collect();
        let painted =
            Mesh { materials: vec![tinta::mesh::Material::default(); count], triangle_materials: materials, ..blocks };
        assert!(px(&painted, &joins) > plain + 10.0, "{count} materials from {view}");
    }
}

#[test]
fn lines_between_parts_are_a_class() {
    let between = LineSettings { classes: ClassSet::of(&[Class::Part]), ..LineSettings::default() };
    for_scenes(24, |scene, which, kind| {
        let found = |classes: &[Class]| {
            let settings = LineSettings { classes: ClassSet::of(classes), ..LineSettings::default() };
            VisibleLines::of(scene, &settings).unwrap()
        };
        let [alone, both, crossing] =
            [vec![Class::Part], vec![Class::Part, Class::Intersection], vec![Class::Intersection]]
                .map(|classes| found(&classes));
        let count = |lines: &VisibleLines, class| lines.edges.clone().of(class).to_owned();
        assert_eq!(count(&alone, Class::Part), count(&both, Class::Part), "{which}");
        if kind == 1 {
            // Whole boxes: what is between parts is an intersection, and of one box with itself there is none.
            assert_eq!(count(&alone, Class::Part), count(&crossing, Class::Intersection), "{which}");
        }
    });
    let [blocks, _] = wall(&[0.0, 1.0, 2.0]);
    // Open at the seam, so that each edge there has two faces.
    let open = Mesh {
        triangles: blocks.triangles.iter().filter(|corners| !lies_at(&blocks, **corners, 1.0)).copied().collect(),
        triangle_parts: (0..20).map(|face| face / 10).collect(),
        ..blocks.clone()
    };
    assert!(visible_px(open, &between, "20,30") > 10.0);
}

/// Whether all corners of a triangle have this x.
fn lies_at(mesh: &Mesh, corners: [u32; 3], x: f64) -> bool {
    corners.iter().all(|corner| mesh.positions[*corner as usize].x == x)
}

#[test]
fn lines_of_ghosts_that_lie_on_one_another_are_drawn_once() {
    /// Pixels; overlaps are found up to 0.005 aside and at ends.
    const MOST: f64 = 0.02;
    let (mut doubled, mut drawn_px) = (0, 0.0);
    for seed in 1..=40 {
        let mut random = Random(seed);
        // Boxes in steps, so that edges lie behind edges in views along an axis.
        let mut step = |most: u32| (random.number() * f64::from(most)).floor();
        let boxes: Vec<Arc<Mesh>> = (0..4)
            .map(|number| {
                let low = DVec3::new(step(4), step(4), step(4));
                let high = low + DVec3::ONE + DVec3::new(step(2), step(2), step(2));
                Arc::new(with_parts(&cuboid(low, high), |_| number))
            })
            .collect();
        let view = ["front", "top", "right"][seed as usize % 3].parse().unwrap();
        let camera = CameraSettings { view, parallel: true, ..CameraSettings::default() };
        let scene = Scene::new(boxes, &SceneSettings { camera, ..SceneSettings::default() }).unwrap();
        let rules = if seed % 2 == 0 { "*: ghost" } else { "arm: ghost" };
        let lines = found(&scene, rules);
        let (drawn, left_out): (Vec<_>, Vec<_>) = visible(&lines).into_iter().partition(|segment| !segment.is_covered);
        let on = |segment: &LineSegment, point: glam::DVec2| {
            let [a, b] = segment.ends_px;
            let along = (b - a) / (b - a).length_squared();
            let place = (point - a).dot(along).clamp(0.0, 1.0);
            (a + (b - a) * place).distance(point) <= MOST
        };
        let length = |segment: &LineSegment| segment.ends_px[0].distance(segment.ends_px[1]);
        let middle = |segment: &LineSegment| (segment.ends_px[0] + segment.ends_px[1]) * 0.5;
        for (number, segment) in drawn.iter().enumerate().filter(|(_, segment)| length(segment) > 4.0 * MOST) {
            let quarter = segment.ends_px[0].lerp(segment.ends_px[1], 0.25);
            let twice = |other: &&&LineSegment| on(other, middle(segment)) && on(other, quarter);
            let again = drawn[number + 1..].iter().find(twice);
            assert!(again.is_none(), "seed {seed}, {rules}: {segment:?} and {again:?}");
            drawn_px += length(segment);
        }
        for segment in &left_out {
            assert!(drawn.iter().any(|other| on(other, middle(segment))), "seed {seed}, {rules}: {segment:?} is lost");
        }
        doubled += left_out.len();
    }
    assert!(doubled > 400 && drawn_px > 20_000.0, "{doubled} pieces on others, {drawn_px} pixels drawn");
}
