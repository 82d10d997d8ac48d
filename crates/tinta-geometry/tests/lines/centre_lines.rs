//! Centre lines of cylinders, holes, spheres and shafts, by formula; none on boxes and short arcs.

use crate::support::families::{extruded, prism};
use crate::support::lines::{assert_near, distance, length, lines_with, px, scene_of, view};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use tinta::edges::{Class, ClassSet, SilhouetteRule};
use tinta::lines::{LineSettings, VisibleLines};
use tinta::mesh::SectionPlane;
use tinta::settings::Value;
use tinta::{CameraSettings, Mesh, Scene};

/// How far a line goes beyond its surface: a share of the scene's radius.
const BEYOND: f64 = 0.02;

fn centre_lines(scene: &Scene) -> Vec<tinta::lines::LineSegment> {
    let mut settings = LineSettings::default();
    settings.classes = settings.classes.or(ClassSet::of(&[Class::Centre]));
    lines_with(scene, &settings).segments.into_iter().filter(|segment| segment.class == Class::Centre).collect()
}

fn count(mesh: Mesh, camera: &str) -> usize {
    centre_lines(&scene_of(vec![mesh], view(camera, true))).len()
}

/// A part of a disc of 24 facets, as a wedge along x.
fn wedge(facets: u32) -> Mesh {
    let arc = (0..=facets).map(|facet| (TAU / 24.0 * f64::from(facet)).sin_cos());
    let polygon: Vec<(f64, f64)> =
        std::iter::once((0.0, 0.0)).chain(arc.map(|(sine, cosine)| (cosine, sine))).collect();
    extruded(&polygon[usize::from(facets == 12)..], -1.0, 1.0)
}

/// A square plate with a round hole through it along x, wound outwards.
fn holed(sides: u32, radius: f64, half: f64, depth: f64) -> Mesh {
    let ring = |x: f64, radius: f64, is_square: bool| {
        (0..sides).map(move |side| {
            let (sine, cosine) = (TAU / f64::from(sides) * f64::from(side)).sin_cos();
            let scale = if is_square { 1.0 / cosine.abs().max(sine.abs()) } else { 1.0 };
            DVec3::new(x, cosine * radius * scale, sine * radius * scale)
        })
    };
    let positions = ring(0.0, radius, false).chain(ring(depth, radius, false)).chain(ring(0.0, half, true));
    let positions = positions.chain(ring(depth, half, true)).collect();
    let mut triangles = Vec::new();
    for side in 0..sides {
        let next = (side + 1) % sides;
        for [from, to] in [[0, 2], [2, 3], [3, 1], [1, 0]] {
            let [a, b, c, d] = [from * sides + side, from * sides + next, to * sides + next, to * sides + side];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(positions, triangles)
}

#[test]
fn an_axis_is_a_line_from_the_side_and_a_cross_end_on() {
    let mut random = Random::seeded(20_261_129);
    for _ in 0..40 {
        let (radius, half) = (0.2 + random.number(), 0.2 + 2.0 * random.number());
        let turn = DMat3::from_axis_angle(random.direction(), TAU * random.number());
        let mut mesh = prism(13 + random.whole(0, 40), radius, -half, half, random.number());
        mesh.positions.iter_mut().for_each(|point| *point = turn * *point);
        let axis = turn * DVec3::X;
        let seen_along = |direction: DVec3, up: DVec3| {
            let camera = CameraSettings { parallel: true, height: Some(6.0), ..CameraSettings::default() };
            let camera =
                CameraSettings { eye: Some(direction * 20.0), target: Some(DVec3::ZERO), up: Some(up), ..camera };
            scene_of(vec![mesh.clone()], camera)
        };
        let scene = seen_along(axis.any_orthogonal_vector().normalize(), axis);
        let found = centre_lines(&scene);
        assert_eq!(found.len(), 1);
        let ends = [-1.0, 1.0].map(|side| px(&scene, axis * side * (half + scene.radius * BEYOND)));
        for end in found[0].ends_px {
            assert!(ends[0].distance(end).min(ends[1].distance(end)) < 1e-3, "{end} {ends:?}");
        }
        let scene = seen_along(axis, axis.any_orthogonal_vector());
        let found = centre_lines(&scene);
        assert_eq!(found.len(), 2);
        for line in &found {
            let expected = 2.0
                * (radius + scene.radius * BEYOND)
                * px(&scene, DVec3::ZERO).distance(px(&scene, axis.any_orthonormal_vector()));
            assert_near(length(line), expected, 1e-3 * expected, "cross");
            assert!(distance(px(&scene, DVec3::ZERO), line.ends_px) < 1e-3);
        }
    }
}

#[test]
fn what_goes_half_around_has_an_axis_and_what_does_not_has_none() {
    for facets in 5..=24 {
        assert_eq!(count(wedge(facets.min(23)), "front"), usize::from(facets >= 12), "{facets} of 24 facets");
    }
    for mesh in [cuboid(DVec3::ZERO, DVec3::ONE), prism(6, 1.0, 0.0, 1.0, 0.0), prism(8, 1.0, 0.0, 1.0, 0.3)] {
        assert_eq!(count(mesh, "30,20"), 0);
    }
    assert_eq!(count(holed(48, 0.5, 1.0, 0.4), "front"), 1);
    assert_eq!(count(holed(48, 0.5, 1.0, 0.4), "right"), 2);
    assert_eq!(count(icosphere(3), "30,20"), 2);
    let cap = |height: f64| {
        icosphere(4).section(&[SectionPlane::parse(&format!("y={height}")).unwrap()], Some(0.0)).unwrap().0
    };
    assert_eq!([0.3, -0.5].map(|height| count(cap(height), "30,20")), [2, 0]);
}

#[test]
fn steps_of_a_shaft_share_one_line_and_a_cut_through_it_keeps_it() {
    let shaft = joined(&[prism(48, 1.0, 0.0, 2.0, 0.0), prism(48, 0.6, 2.0, 5.0, 0.1), prism(36, 0.3, 5.0, 6.0, 0.0)]);
    let scene = scene_of(vec![shaft.clone()], view("front", true));
    let found = centre_lines(&scene);
    let ends = [-BEYOND * scene.radius, 6.0 + BEYOND * scene.radius].map(|x| px(&scene, DVec3::X * x));
    assert_eq!(found.len(), 1);
    assert_near(length(&found[0]), ends[0].distance(ends[1]), 1e-3, "shaft");
    for plane in ["z=0", "z=0.01", "y=0", "0,1,0.3=0"] {
        let cut = shaft.clone().section(&[SectionPlane::parse(plane).unwrap()], Some(0.0)).unwrap().0;
        assert_eq!(count(cut, "front"), 1, "{plane}");
    }
}

#[test]
fn the_line_of_a_hidden_hole_is_hidden() {
    // A blind hole, seen from its open side and from the other.
    let plate = holed(48, 0.5, 1.0, 0.4);
    let bottom = cuboid(DVec3::new(-0.5, -1.0, -1.0), DVec3::new(0.0, 1.0, 1.0));
    let both = joined(&[plate, bottom]);
    for (camera, is_visible) in [("right", true), ("left", false)] {
        let found = centre_lines(&scene_of(vec![both.clone()], view(camera, true)));
        assert_eq!(found.iter().map(|line| line.is_visible).collect::<Vec<_>>(), [is_visible; 2], "{camera}");
    }
}

#[test]
fn a_centre_line_needs_no_other_line_and_no_edge_that_is_drawn() {
    let alone = |mesh: Mesh, settings: LineSettings| {
        let found = VisibleLines::of(&scene_of(vec![mesh], view("iso", true)), &settings).unwrap().segments;
        found.into_iter().filter(|line| line.class == Class::Centre && line.is_visible).count()
    };
    let only = LineSettings { classes: ClassSet::of(&[Class::Centre]), ..LineSettings::default() };
    assert_eq!(alone(holed(48, 0.5, 1.0, 0.4), only), 1, "aslant a line, however short");
    let mut smooth = LineSettings { silhouette: SilhouetteRule::Smooth, ..LineSettings::default() };
    smooth.classes = smooth.classes.or(ClassSet::of(&[Class::Centre]));
    assert_eq!(alone(icosphere(3), smooth), 2);
}
