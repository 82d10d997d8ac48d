//! Outlines: the pieces of visible lines with only background on one side, on shapes with a known outline and against a twin that
//! casts rays beside points of lines.

use crate::support::builtin;
use crate::support::lines::{
    assert_near, distance, length, lines, lines_with, pierce, px, scene_of, shuffled, total, view,
};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use glam::{DMat4, DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use tinta::edges::{Class, SilhouetteRule};
use tinta::lines::{ClassWidths, LineSegment, LineSettings, VisibleLines};
use tinta::mesh::SectionPlane;
use tinta::settings::Value as _;
use tinta::{DrawingSettings, Mesh, Scene};

const NEAR: f64 = 1e-6;

fn outlined(scene: &Scene) -> VisibleLines {
    lines_with(scene, &LineSettings { finds_outline: true, ..LineSettings::default() })
}

fn outline_of(lines: &VisibleLines, object: Option<u32>) -> f64 {
    let is_meant = |s: &&LineSegment| s.is_outline && object.is_none_or(|object| s.object == object);
    lines.segments.iter().filter(is_meant).map(length).sum()
}

/// The corners of the convex hull in their order, by Andrew's chain.
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut hull: Vec<DVec2> = Vec::new();
        for point in points {
            while hull.len() > 1
                && (hull[hull.len() - 1] - hull[hull.len() - 2]).perp_dot(*point - hull[hull.len() - 1]) <= 0.0
            {
                hull.pop();
            }
            hull.push(*point);
        }
        hull.pop();
        hull
    };
    let mut there = chain(&mut points.iter());
    there.extend(chain(&mut points.iter().rev()));
    there
}

/// The length of the convex hull's border.
fn hull_length(points: Vec<DVec2>) -> f64 {
    let corners = hull(points);
    (0..corners.len()).map(|k| corners[k].distance(corners[(k + 1) % corners.len()])).sum()
}

#[test]
fn the_outline_of_a_cube_is_its_hexagon() {
    for name in ["iso", "30,15", "200,-35", "front"] {
        for parallel in [false, true] {
            let cube = cuboid(DVec3::ZERO, DVec3::ONE);
            let corners = cube.positions.clone();
            let scene = scene_of(vec![cube], view(name, parallel));
            let found = outlined(&scene);
            let expected = hull_length(corners.iter().map(|corner| px(&scene, *corner)).collect());
            assert_near(outline_of(&found, None), expected, NEAR, &format!("{name} {parallel}"));
            let pieces = found.segments.iter().filter(|segment| segment.is_outline);
            assert_eq!(pieces.count(), if name == "front" { 4 } else { 6 }, "{name}: an edge each");
            assert!(found.segments.iter().all(|segment| segment.is_visible || !segment.is_outline));
        }
    }
}

#[test]
fn what_is_in_front_of_something_else_is_no_outline_there_whatever_the_order() {
    let big = cuboid(DVec3::new(-1.0, -1.0, -1.0), DVec3::ONE);
    let inner = cuboid(DVec3::new(-0.5, -0.4, 2.0), DVec3::new(0.5, 0.4, 2.5));
    let bar = |z: f64| cuboid(DVec3::new(0.5, -0.2, z), DVec3::new(1.5, 0.2, z + 0.5));
    for order in [[0, 1], [1, 0]] {
        let scene = |other: &Mesh| scene_of(order.map(|k| [&big, other][k].clone()).to_vec(), view("front", true));
        let number = |k: usize| order.iter().position(|object| *object == k).unwrap() as u32;
        let seen = scene(&inner);
        let unit = px(&seen, DVec3::X).x - px(&seen, DVec3::ZERO).x;
        let found = outlined(&seen);
        assert_eq!(outline_of(&found, Some(number(1))), 0.0, "the small one is in front of the big one");
        assert_near(outline_of(&found, Some(number(0))), 8.0 * unit, NEAR, "the big one's");
        // A bar that sticks out at the right, in front of the big one or behind it: its own outline is the part outside, and the
        // big one's has a gap there, even where its edge is visible.
        for z in [2.0, -2.0] {
            let seen = scene(&bar(z));
            let unit = px(&seen, DVec3::X).x - px(&seen, DVec3::ZERO).x;
            let found = outlined(&seen);
            assert_near(outline_of(&found, Some(number(1))), 1.4 * unit, NEAR, &format!("the bar at {z}"));
            assert_near(outline_of(&found, Some(number(0))), 7.6 * unit, NEAR, &format!("beside a bar at {z}"));
            let beyond = found.segments.iter().filter(|s| s.is_visible && !s.is_outline).map(length).sum::<f64>();
            // In front, the bar's other half and its end are drawn; behind, the big one's edge is.
            assert_near(beyond, if z > 0.0 { 1.4 } else { 0.4 } * unit, NEAR, &format!("inner lines at {z}"));
        }
    }
}

/// A torus around the z axis; an even number of points on each circle.
fn torus(large: f64, small: f64, around: u32, tube: u32) -> Mesh {
    let point = |i: u32, j: u32| {
        let [a, b] = [(i, around), (j, tube)].map(|(k, count)| f64::from(k) / f64::from(count) * TAU);
        let reach = large + small * b.cos();
        DVec3::new(reach * a.cos(), reach * a.sin(), small * b.sin())
    };
    let number = |i: u32, j: u32| (i % around) * tube + j % tube;
    let quads = (0..around).flat_map(|i| (0..tube).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    mesh((0..around).flat_map(|i| (0..tube).map(move |j| point(i, j))).collect(), triangles.collect())
}

#[test]
fn the_hole_of_a_torus_has_an_outline_too() {
    let (large, small, around) = (1.0, 0.3, 64);
    let scene = scene_of(vec![torus(large, small, around, 24)], view("front", true));
    let unit = px(&scene, DVec3::X).x - px(&scene, DVec3::ZERO).x;
    let found = outlined(&scene);
    let polygon = |radius: f64| f64::from(around) * 2.0 * radius * (TAU / f64::from(around) * 0.5).sin() * unit;
    assert_near(outline_of(&found, None), polygon(large + small) + polygon(large - small), 1e-5, "both circles");
    // From the side the hole is hidden.
    let scene = scene_of(vec![torus(large, small, around, 24)], view("90,0", true));
    let found = outlined(&scene);
    let hull = hull_length(torus(large, small, around, 24).positions.iter().map(|p| px(&scene, *p)).collect());
    assert_near(outline_of(&found, None), hull, 1e-5, "from the side it is its hull");
}

/// Whether a ray through a pixel meets any face.
fn meets(scene: &Scene, world_from_clip: &DMat4, at: DVec2) -> bool {
    let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
    let ndc = DVec2::new(at.x / size.x * 2.0 - 1.0, 1.0 - at.y / size.y * 2.0);
    let [near, far] = [-1.0, 1.0].map(|depth| world_from_clip.project_point3(ndc.extend(depth)));
    scene.objects.iter().any(|object| {
        let corner = |number: u32| object.mesh.positions[number as usize] + object.offset;
        object.mesh.triangles.iter().any(|triangle| pierce(near, far - near, triangle.map(corner)).is_some())
    })
}

/// Boxes and balls at random.
fn random_scene(random: &mut Random, parallel: bool) -> Scene {
    let count = 2 + (random.number() * 3.0) as usize;
    let meshes = (0..count).map(|k| {
        let centre = random.direction() * random.number();
        let extent = DVec3::new(random.number(), random.number(), random.number()) * 0.8 + 0.1;
        let one = if k % 2 == 0 { cuboid(-extent, extent) } else { icosphere(1) };
        let turn = glam::DQuat::from_axis_angle(random.direction().normalize(), random.number() * TAU);
        let positions = one.positions.iter().map(|point| centre + turn * *point * 0.7).collect();
        mesh(positions, one.triangles)
    });
    let meshes: Vec<Mesh> = meshes.collect();
    let angles = format!("{:.3},{:.3}", random.number() * 360.0, random.number() * 150.0 - 75.0);
    scene_of(meshes, view(&angles, parallel))
}

#[test]
fn rays_beside_points_of_lines_find_the_same_outline() {
    let mut random = Random(21 << 40 | 7);
    let (mut checked, mut outline) = (0, 0);
    for number in 0..60 {
        let scene = random_scene(&mut random, number % 2 == 0);
        let camera = scene.camera.clip_from_view(scene.size.aspect()) * scene.camera.view_from_world();
        let world_from_clip = camera.inverse();
        for segment in outlined(&scene).segments.iter().filter(|segment| segment.is_visible && length(segment) > 0.01) {
            let [a, b] = segment.ends_px;
            // The distance beside a line that counts as background.
            let aside = (b - a).perp().normalize() * 512.0 * tinta::tolerances::BESIDE;
            // Near both ends too: a cut at the wrong place is visible there. Parts shorter than five times that distance are
            // ignored.
            let end = 6.0 * aside.length() / length(segment);
            for share in [end, 0.37, 1.0 - end].into_iter().filter(|_| end < 0.37) {
                let at = a.lerp(b, share);
                let is_covered = [at + aside, at - aside].map(|point| meets(&scene, &world_from_clip, point));
                let is_outline = is_covered != [true; 2];
                assert_eq!(segment.is_outline, is_outline, "scene {number} at {at}: {segment:?}");
                checked += 1;
                outline += usize::from(is_outline);
            }
        }
    }
    assert!(checked > 3000 && outline > checked / 5 && outline < checked * 4 / 5, "{outline} of {checked}");
}

#[test]
fn with_outlines_there_are_the_same_lines_as_without() {
    let mut random = Random(22 << 40 | 7);
    for number in 0..20 {
        let scene = random_scene(&mut random, number % 2 == 0);
        let (with, without) = (outlined(&scene), lines(&scene));
        assert!(without.segments.iter().all(|segment| !segment.is_outline));
        assert_near(total(&with, true), total(&without, true), 1e-8, "visible");
        // Piece by piece: those cut at an outline's ends put together again are the others, with the same ends.
        let mut joined: Vec<LineSegment> = Vec::new();
        for segment in with.segments {
            match joined.last_mut() {
                Some(last)
                    if last.ends_px[1] == segment.ends_px[0]
                        && last.background != segment.background
                        && [last.is_visible, segment.is_visible] == [true; 2]
                        && (last.edge, last.object) == (segment.edge, segment.object) =>
                {
                    last.ends_px[1] = segment.ends_px[1];
                    last.ends_world[1] = segment.ends_world[1];
                    last.background = segment.background;
                }
                _ => joined.push(segment),
            }
        }
        joined.iter_mut().for_each(|segment| (segment.is_outline, segment.background) = (false, [false; 2]));
        assert_eq!(joined, without.segments, "scene {number}");
    }
}

#[test]
fn smooth_silhouettes_are_the_same_with_outlines_and_hidden_lines_as_without() {
    for name in ["gear", "ant", "pawn"] {
        let cut = builtin(name).section(&[SectionPlane::parse("x=0.3").unwrap()], None).unwrap().0;
        for (mesh, camera) in [(builtin(name), "310,-20"), (cut.clone(), "310,-20"), (cut, "45,30")] {
            let scene = scene_of(vec![mesh], view(camera, false));
            let found = |finds_outline: bool, finds_hidden: bool| {
                let silhouette = SilhouetteRule::Smooth;
                let settings = LineSettings { silhouette, finds_outline, finds_hidden, ..LineSettings::default() };
                let mut lines = VisibleLines::of(&scene, &settings).unwrap();
                lines.segments.retain(|segment| segment.is_visible && segment.class == Class::Silhouette);
                lines
            };
            let alone = found(false, false);
            for (finds_outline, finds_hidden) in [(false, true), (true, false), (true, true)] {
                let others = found(finds_outline, finds_hidden);
                let what = format!("{name}, {camera}, outlines {finds_outline}, hidden {finds_hidden}");
                assert_near(total(&others, true), total(&alone, true), 1e-8, &what);
                let ends = |lines: &VisibleLines| -> BTreeSet<[u64; 2]> {
                    lines.segments.iter().flat_map(|s| s.ends_px).map(|px| px.to_array().map(f64::to_bits)).collect()
                };
                assert!(ends(&others).is_superset(&ends(&alone)), "{what}");
            }
        }
    }
}

#[test]
fn a_sheets_border_is_outline_where_nothing_is_behind_it() {
    let sheet = |size: f64, z: f64| {
        let corner = |x: f64, y: f64| DVec3::new(x * size, y * size, z);
        mesh(
            vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            vec![[0, 1, 2], [0, 2, 3]],
        )
    };
    let scene = scene_of(vec![sheet(0.5, 1.0), sheet(1.0, 0.0)], view("front", true));
    let unit = px(&scene, DVec3::X).x - px(&scene, DVec3::ZERO).x;
    let mut by_object: BTreeMap<(u32, bool), f64> = BTreeMap::new();
    for segment in outlined(&scene).segments {
        assert_eq!(segment.class, Class::Boundary);
        *by_object.entry((segment.object, segment.is_outline)).or_default() += length(&segment);
    }
    assert_near(by_object[&(0, false)], 4.0 * unit, NEAR, "in front of the other");
    assert_near(by_object[&(1, true)], 8.0 * unit, NEAR, "the outer one");
    assert_eq!(by_object.len(), 2);
}

/// A prism with a regular polygon's corners, its axis upright; numbers as a file of f32 has them.
fn prism(sides: u32, height: f64) -> Mesh {
    let corner = |k: u32, y: f64| {
        let angle = f64::from(k) / f64::from(sides) * TAU;
        DVec3::new(f64::from((10.0 * angle.cos()) as f32), y, f64::from((10.0 * angle.sin()) as f32))
    };
    let positions = [0.0, height].into_iter().flat_map(|y| (0..sides).map(move |k| corner(k, y))).collect();
    let ends = (1..sides - 1).flat_map(|k| [[0, k, k + 1], [sides, sides + k + 1, sides + k]]);
    let around = (0..sides).flat_map(|k| {
        let next = (k + 1) % sides;
        [[k, sides + k, sides + next], [k, sides + next, next]]
    });
    mesh(positions, ends.chain(around).collect())
}

#[test]
fn a_rim_is_outline_also_where_a_face_beside_it_is_edge_on_but_for_rounding() {
    for sides_count in [6, 8, 12] {
        for name in ["30,15", "90,15", "0,15", "0,90", "29.99999,15", "30.00001,20", "15,0"] {
            for parallel in [true, false] {
                let part = prism(sides_count, 7.0);
                let corners = part.positions.clone();
                let scene = scene_of(vec![part], view(name, parallel));
                let found = outlined(&scene);
                let outline: Vec<[DVec2; 2]> =
                    found.segments.iter().filter(|s| s.is_outline).map(|s| s.ends_px).collect();
                let around = hull(corners.iter().map(|corner| px(&scene, *corner)).collect());
                let sides: Vec<[DVec2; 2]> =
                    (0..around.len()).map(|k| [around[k], around[(k + 1) % around.len()]]).collect();
                // Two rims may be closer together than the distance of background.
                let what = format!("{sides_count} sides from {name}, parallel {parallel}");
                for (of, others) in [(&sides, &outline), (&outline, &sides)] {
                    for at in of.iter().flat_map(|[a, b]| (0..=50).map(|k| a.lerp(*b, f64::from(k) / 50.0))) {
                        let nearest = others.iter().map(|ends| distance(at, *ends)).fold(f64::MAX, f64::min);
                        assert!(nearest < 0.06, "{what}: {nearest} px between the outline and the hull at {at}");
                    }
                }
            }
        }
    }
}

/// The drawn lines with an outline so many pixels wide, otherwise complete.
fn drawn(lines: &VisibleLines, width: &str) -> VisibleLines {
    let class_widths: ClassWidths = format!("outline={width}").parse().unwrap();
    let min_length = Some("0".parse().unwrap());
    lines.without_specks(&DrawingSettings { class_widths, min_length, ..DrawingSettings::default() }).unwrap()
}

/// Upright boxes in a row, 4 units high and 2 wide, with so many units of background between them.
fn row(gaps: &[f64]) -> Vec<Mesh> {
    let mut x = 0.0;
    let mut boxes = Vec::new();
    for gap in gaps.iter().chain([&0.0]) {
        boxes.push(cuboid(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 2.0, 4.0, 1.0)));
        x += 2.0 + gap;
    }
    boxes
}

#[test]
fn what_borders_on_a_slit_that_ink_would_fill_is_no_outline() {
    let scene = scene_of(row(&[0.05, 1.0]), view("front", true));
    let unit = px(&scene, DVec3::X).x - px(&scene, DVec3::ZERO).x;
    let found = outlined(&scene);
    // Three boxes of 12 each have background all around.
    assert_near(outline_of(&found, None), 36.0 * unit, NEAR, "as it is");
    let slit = 0.05 * unit;
    for (width, expected) in [(slit / 2.0, 36.0), (slit / 1.4, 28.0), (slit * 2.0, 28.0)] {
        let drawn = drawn(&found, &width.to_string());
        assert_near(
            outline_of(&drawn, None),
            expected * unit,
            0.05,
            &format!("{width} px wide, {slit} px of background"),
        );
        assert_near(total(&drawn, true), 36.0 * unit, NEAR, "nothing is left out");
    }
}

/// Pieces along one line with their lengths, outline or not.
fn chained(lengths: &[(f64, bool)], is_ring: bool) -> VisibleLines {
    let mut found = outlined(&scene_of(vec![cuboid(DVec3::ZERO, DVec3::ONE)], view("front", true)));
    let all: f64 = lengths.iter().map(|(length, _)| length).sum();
    let at = |along: f64| match is_ring {
        true => DVec2::splat(256.0) + DVec2::from_angle(along / all * TAU) * (all / TAU),
        false => DVec2::new(10.0 + along, 50.0),
    };
    let mut from = 0.0;
    let one = found.segments.iter().find(|segment| segment.is_visible).unwrap().clone();
    found.segments = Vec::new();
    for (length, is_outline) in lengths {
        let steps = if is_ring { 40 } else { 1 };
        for step in 0..steps {
            let ends = [step, step + 1].map(|end| from + length * f64::from(end) / f64::from(steps));
            let ends_px = ends.map(|end| at(if end >= all - 1e-9 && is_ring { 0.0 } else { end }));
            let background = [*is_outline, false];
            found.segments.push(LineSegment { is_outline: *is_outline, background, ends_px, ..one.clone() });
        }
        from += length;
    }
    found
}

#[test]
fn of_two_outlines_with_background_on_one_side_the_outer_one_stays_unless_its_run_is_short() {
    // Below a line with background below it, others: each from and to, how far below, whether its background lies below it, too.
    let below = |others: &[(f64, f64, f64, bool)], is_turned: bool| {
        let mut found = chained(&[(100.0, true)], false);
        for (from, to, down, is_same_side) in others {
            let ends = [*from, *to].map(|x| DVec2::new(x, 50.0 + down));
            let ends_px = if is_turned { [ends[1], ends[0]] } else { ends };
            let background = [*is_same_side != is_turned, *is_same_side == is_turned];
            found.segments.push(LineSegment { ends_px, background, ..found.segments[0].clone() });
        }
        outline_of(&drawn(&found, "3"), None)
    };
    for is_turned in [false, true] {
        let near = |others: &[(f64, f64, f64, bool)], expected: f64| {
            assert_near(below(others, is_turned), expected, NEAR, &format!("{others:?} {is_turned}"));
        };
        near(&[(40.0, 80.0, 1.0, false)], 60.0);
        near(&[(40.0, 80.0, 1.0, true)], 100.0);
        near(&[(40.0, 50.0, 0.1, true), (50.0, 60.0, 0.2, true), (60.0, 70.0, 0.1, true)], 130.0);
    }
}

#[test]
fn a_run_shorter_than_four_widths_is_what_those_on_either_side_are() {
    let outline = |lengths: &[(f64, bool)], is_ring: bool| {
        let lines = chained(lengths, is_ring);
        outline_of(&drawn(&lines, "3"), None) / total(&lines, true)
    };
    let near = |actual: f64, expected: f64| assert!((actual - expected).abs() < 1e-9, "{actual} instead of {expected}");
    near(outline(&[(50.0, true), (11.0, false), (39.0, true)], false), 1.0);
    near(outline(&[(50.0, true), (13.0, false), (37.0, true)], false), 0.87);
    near(outline(&[(50.0, false), (11.0, true), (39.0, false)], false), 0.0);
    near(outline(&[(50.0, false), (13.0, true), (37.0, false)], false), 0.13);
    // The shortest first: the rest is then long enough.
    near(outline(&[(40.0, true), (10.0, false), (5.0, true), (10.0, false), (35.0, true)], false), 0.75);
    // An end has no neighbour that decides its width.
    near(outline(&[(5.0, true), (95.0, false)], false), 0.05);
    // Around the end of a ring, too.
    near(outline(&[(3.0, true), (90.0, false), (7.0, true)], true), 0.0);
    near(outline(&[(3.0, false), (90.0, true), (7.0, false)], true), 1.0);
    near(outline(&[(50.0, true)], true), 1.0);
    near(outline(&[(8.0, true)], true), 0.0);
}

#[test]
fn the_outline_goes_around_what_looks_out_by_a_little() {
    // A bar across a wide plate, before it; its end looks out.
    let plate = cuboid(DVec3::ZERO, DVec3::new(8.0, 6.0, 1.0));
    let bar = |end: f64| cuboid(DVec3::new(4.0, 2.0, 2.0), DVec3::new(8.0 + end, 3.0, 3.0));
    for end in [0.05, 2.0] {
        let scene = scene_of(vec![plate.clone(), bar(end)], view("front", true));
        let unit = px(&scene, DVec3::X).x - px(&scene, DVec3::ZERO).x;
        for found in [outlined(&scene), drawn(&outlined(&scene), "3")] {
            assert_near(
                outline_of(&found, Some(1)),
                (2.0 * end + 1.0) * unit,
                NEAR,
                &format!("the bar's end, {end} long"),
            );
            assert_near(outline_of(&found, Some(0)), (28.0 - 1.0) * unit, NEAR, "the plate");
        }
    }
}

#[test]
fn a_corner_of_the_outline_that_is_nearly_closed_stays_outline() {
    // An angle of 60 degrees seen from the front: near its inner corner background is as narrow as one likes.
    let arm = |angle: f64| {
        let turn = glam::DQuat::from_rotation_z(angle);
        let one = cuboid(DVec3::new(0.0, 0.0, 0.0), DVec3::new(6.0, 0.5, 1.0));
        mesh(one.positions.iter().map(|point| turn * *point).collect(), one.triangles)
    };
    let scene = scene_of(vec![arm(0.0), arm(TAU / 6.0)], view("front", true));
    let found = outlined(&scene);
    let all = outline_of(&found, None);
    assert_near(outline_of(&drawn(&found, "3"), None), all, NEAR, "60 degrees");
}

#[test]
fn the_outline_of_a_narrow_opening_turns_its_corners() {
    // A gate: posts below a rail before them, whose lower side is outline in the openings alone.
    let mut gate = row(&[1.0; 4]);
    gate.push(cuboid(DVec3::new(-1.0, 3.0, 1.0), DVec3::new(15.0, 5.0, 2.0)));
    let scene = scene_of(gate, view("front", true));
    let unit = px(&scene, DVec3::X).x - px(&scene, DVec3::ZERO).x;
    let found = outlined(&scene);
    let all = outline_of(&found, None);
    // Five posts with two sides and a foot each, and the rail without what lies before them.
    assert_near(all, (5.0 * 8.0 + 2.0 * 18.0 - 5.0 * 2.0) * unit, NEAR, "as it is");
    for widths in [1.7, 2.5, 3.9] {
        let drawn = drawn(&found, &(unit / widths).to_string());
        assert_near(outline_of(&drawn, None), all, NEAR, &format!("openings of {widths} widths"));
    }
}

#[test]
fn a_drawing_without_a_word_on_its_outline_keeps_all_of_it() {
    let found = outlined(&scene_of(row(&[0.05]), view("front", true)));
    let settings = DrawingSettings { min_length: Some("0".parse().unwrap()), ..DrawingSettings::default() };
    assert_eq!(found.without_specks(&settings).unwrap().segments, found.segments);
}

/// The outline's length as found and as drawn three pixels wide.
fn outlines(meshes: Vec<Mesh>, camera: &tinta::CameraSettings) -> [f64; 2] {
    let found = outlined(&scene_of(meshes, camera.clone()));
    [outline_of(&found, None), outline_of(&drawn(&found, "3"), None)]
}

#[test]
fn the_outline_does_not_change_with_how_a_scene_is_written() {
    let mut random = Random(41 << 40 | 9);
    let views = ["front", "top", "iso", "30,15", "0,15", "45,45", "90,20"];
    let turned = |mesh: &Mesh, is_turned: &mut dyn FnMut() -> bool| {
        let turn = |[a, b, c]: &[u32; 3]| if is_turned() { [*a, *c, *b] } else { [*a, *b, *c] };
        Mesh { triangles: mesh.triangles.iter().map(turn).collect(), ..mesh.clone() }
    };
    for number in 0..40 {
        let count = 2 + (random.number() * 3.0) as usize;
        let mut parts: Vec<Mesh> = Vec::new();
        for k in 0..count {
            // Apart, to prevent a third face on an edge when parts become one object.
            let low = DVec3::new(random.number() * 4.0, random.number() * 4.0, 3.0 * k as f64);
            let one = match (number + k) % 2 {
                0 => cuboid(DVec3::ZERO, DVec3::new(1.0 + random.number() * 3.0, 2.0, 2.0)),
                _ => {
                    let one = prism(6 + (k as u32 % 3) * 2, 2.0 + random.number() * 10.0);
                    mesh(one.positions.iter().map(|point| *point * 0.1 + 1.0).collect(), one.triangles)
                }
            };
            parts.push(mesh(one.positions.iter().map(|point| *point + low).collect(), one.triangles));
        }
        let camera = view(views[number % views.len()], number % 3 != 0);
        let expected = outlines(parts.clone(), &camera);
        let rewritten = [
            ("in another order", parts.iter().rev().cloned().collect()),
            ("one part inside out", parts.iter().enumerate().map(|(k, part)| turned(part, &mut || k == 0)).collect()),
            (
                "some faces turned",
                parts.iter().map(|part| turned(part, &mut || random.number() < 0.3)).collect::<Vec<Mesh>>(),
            ),
            ("faces in another order", parts.iter().map(|part| shuffled(part, &mut random)).collect()),
            ("one object", vec![joined(&parts)]),
        ];
        for (what, meshes) in rewritten {
            let actual = outlines(meshes, &camera);
            for (k, how) in ["found", "drawn"].into_iter().enumerate() {
                assert_near(actual[k], expected[k], 0.05, &format!("scene {number}, {what}, {how}"));
            }
        }
    }
}
