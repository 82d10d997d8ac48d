//! Outlines: the pieces of visible lines beyond which there is only background, on shapes whose outline is known and against a
//! twin that casts rays beside points of lines.

use crate::lines_support::{assert_near, length, lines, lines_with, pierce, px, scene_of, total, view};
use crate::shapes::{Random, cuboid, icosphere, mesh};
use glam::{DMat4, DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use tinta::edges::Class;
use tinta::lines::{LineSegment, LineSettings, VisibleLines};
use tinta::{Mesh, Scene};

const NEAR: f64 = 1e-6;

fn outlined(scene: &Scene) -> VisibleLines {
    lines_with(scene, &LineSettings { finds_outline: true, ..LineSettings::default() })
}

fn outline_of(lines: &VisibleLines, object: Option<u32>) -> f64 {
    let is_meant = |s: &&LineSegment| s.is_outline && object.is_none_or(|object| s.object == object);
    lines.segments.iter().filter(is_meant).map(length).sum()
}

/// The length of the convex hull's border, by Andrew's chain.
fn hull_length(mut points: Vec<DVec2>) -> f64 {
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
        hull.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>()
    };
    chain(&mut points.iter()) + chain(&mut points.iter().rev())
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
        // A bar that sticks out at the right, in front of the big one or behind it: its own outline is what sticks out, and
        // the big one's has a gap there, also where its edge is seen.
        for z in [2.0, -2.0] {
            let seen = scene(&bar(z));
            let unit = px(&seen, DVec3::X).x - px(&seen, DVec3::ZERO).x;
            let found = outlined(&seen);
            assert_near(outline_of(&found, Some(number(1))), 1.4 * unit, NEAR, &format!("the bar at {z}"));
            assert_near(outline_of(&found, Some(number(0))), 7.6 * unit, NEAR, &format!("beside a bar at {z}"));
            let beyond = found.segments.iter().filter(|s| s.is_visible && !s.is_outline).map(length).sum::<f64>();
            // In front the bar's other half and its end are drawn, behind the big one's edge is.
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
    // From the side there is no hole.
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
            let aside = (b - a).perp().normalize() * 1e-4;
            // Near both ends too: a cut at the wrong place is seen there.
            for share in [0.02, 0.37, 0.98] {
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
                        && last.is_outline != segment.is_outline
                        && [last.is_visible, segment.is_visible] == [true; 2]
                        && (last.edge, last.object) == (segment.edge, segment.object) =>
                {
                    last.ends_px[1] = segment.ends_px[1];
                    last.ends_world[1] = segment.ends_world[1];
                    last.is_outline = segment.is_outline;
                }
                _ => joined.push(segment),
            }
        }
        joined.iter_mut().for_each(|segment| segment.is_outline = false);
        assert_eq!(joined, without.segments, "scene {number}");
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
