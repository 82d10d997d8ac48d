//! Scenes as drawings have them: flat faces, seen along the axes or at multiples of 15 degrees, lines on one another, solids
//! that touch.

use super::lines::scene_of;
use super::random_scenes::random_scene;
use super::shapes::{Random, cuboid, joined, mesh};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use tinta::{CameraSettings, Mesh, Scene};

/// A scene of a family, made at random.
pub type Family = fn(&mut Random) -> Scene;

/// All families.
pub const FAMILIES: [(&str, Family); 8] = [
    ("boxes on a lattice", lattice),
    ("bars in one plane", bars),
    ("bars in several planes", bars_in_planes),
    ("regular prisms", prisms),
    ("boxes flush at a corner", flush),
    ("stacks", stacks),
    ("sheets in planes", sheets),
    ("stairs", stairs),
];

/// The families, and four kinds of randomly oriented scenes.
pub const KINDS: usize = FAMILIES.len() + 4;

/// A scene of one of these kinds, numbered across all of them, with the kind's name.
pub fn scene_of_kind(number: usize, random: &mut Random) -> (String, Scene) {
    match FAMILIES.get(number % KINDS) {
        Some((name, make)) => ((*name).to_owned(), make(random)),
        None => {
            let kind = number % KINDS - FAMILIES.len();
            (format!("random scenes {kind}"), random_scene(kind as u32, random))
        }
    }
}

/// A camera along an axis, at multiples of 15 degrees, or in the middle of things.
pub fn camera(random: &mut Random) -> CameraSettings {
    let parallel = random.number() < 0.7;
    let view = match random.whole(0, 3) {
        0 | 1 => random.one_of(&["front", "back", "left", "right", "top", "bottom"]).to_owned(),
        _ => format!("{},{}", 15 * random.whole(0, 23), 15 * random.whole(-5, 5)),
    };
    CameraSettings { view: view.parse().unwrap(), parallel, ..CameraSettings::default() }
}

/// A convex polygon in a plane across x, extruded along it; its caps are fans.
pub fn extruded(polygon: &[(f64, f64)], from: f64, to: f64) -> Mesh {
    let count = polygon.len() as u32;
    let ring = |x: f64| polygon.iter().map(move |(y, z)| DVec3::new(x, *y, *z));
    let mut triangles = Vec::new();
    for corner in 0..count {
        let next = (corner + 1) % count;
        triangles.extend([[corner, next, count + next], [corner, count + next, count + corner]]);
    }
    for corner in 1..count - 1 {
        triangles.extend([[0, corner + 1, corner], [count, count + corner, count + corner + 1]]);
    }
    mesh(ring(from).chain(ring(to)).collect(), triangles)
}

/// The axes in another order, to let shapes made along x lie along any axis.
fn with_axes(random: &mut Random, meshes: Vec<Mesh>) -> Vec<Mesh> {
    let turn = random.one_of(&[
        DMat3::IDENTITY,
        DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
        DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
    ]);
    let turned = |mesh: Mesh| Mesh { positions: mesh.positions.iter().map(|point| turn * *point).collect(), ..mesh };
    meshes.into_iter().map(turned).collect()
}

/// Several meshes as separate objects, or as one, its corners welded; some of them turned inside out.
fn together(random: &mut Random, meshes: Vec<Mesh>) -> Vec<Mesh> {
    let mut meshes = with_axes(random, meshes);
    if random.number() < 0.2 {
        meshes.iter_mut().for_each(|mesh| mesh.triangles.iter_mut().for_each(|corners| corners.reverse()));
    }
    let order = random.whole(0, meshes.len() as i32 - 1) as usize;
    meshes.rotate_left(order);
    if random.number() < 0.5 { vec![joined(&meshes)] } else { meshes }
}

fn made(random: &mut Random, meshes: Vec<Mesh>) -> Scene {
    let meshes = together(random, meshes);
    let camera = camera(random);
    scene_of(meshes, camera)
}

fn integer_box(random: &mut Random, reach: i32, size: i32) -> Mesh {
    let low = [(); 3].map(|()| f64::from(random.whole(0, reach)));
    let high = low.map(|low| low + f64::from(random.whole(1, size)));
    cuboid(DVec3::from_array(low), DVec3::from_array(high))
}

fn lattice(random: &mut Random) -> Scene {
    let meshes = (0..random.whole(2, 7)).map(|_| integer_box(random, 5, 4)).collect();
    made(random, meshes)
}

fn parallelogram(random: &mut Random) -> Vec<(f64, f64)> {
    loop {
        let [y, z, a, b, c, d] =
            [(0, 8), (0, 8), (-8, 8), (-8, 8), (-2, 2), (-2, 2)].map(|(low, high)| f64::from(random.whole(low, high)));
        if a * d - b * c != 0.0 {
            return vec![(y, z), (y + a, z + b), (y + a + c, z + b + d), (y + c, z + d)];
        }
    }
}

fn bars(random: &mut Random) -> Scene {
    let meshes = (0..random.whole(2, 5)).map(|_| extruded(&parallelogram(random), 0.0, 1.0)).collect();
    made(random, meshes)
}

fn bars_in_planes(random: &mut Random) -> Scene {
    let meshes = (0..random.whole(2, 6))
        .map(|_| {
            let from = f64::from(random.whole(0, 3));
            extruded(&parallelogram(random), from, from + f64::from(random.whole(1, 2)))
        })
        .collect();
    made(random, meshes)
}

/// A regular prism of so many sides, its height along x.
pub fn prism(sides: i32, radius: f64, from: f64, to: f64, start: f64) -> Mesh {
    let corner = |side: i32| {
        let angle = start + TAU * f64::from(side) / f64::from(sides);
        (radius * angle.cos(), radius * angle.sin())
    };
    extruded(&(0..sides).map(corner).collect::<Vec<_>>(), from, to)
}

fn prisms(random: &mut Random) -> Scene {
    let (sides, start) = (random.whole(3, 64), TAU / 24.0 * f64::from(random.whole(0, 23)));
    let mut meshes = vec![prism(sides, 1.0, -1.0, 1.0, start)];
    if random.number() < 0.5 {
        // On one another, like nuts on a bolt.
        meshes.push(prism(random.one_of(&[sides, 6, 8, 12]), random.one_of(&[1.0, 0.5, 2.0]), 1.0, 2.0, start));
    }
    made(random, meshes)
}

fn flush(random: &mut Random) -> Scene {
    let boxes: Vec<Mesh> = (0..random.whole(2, 4))
        .map(|_| {
            let size = [(); 3].map(|()| f64::from(random.whole(1, 4)));
            let sign = if random.number() < 0.5 { DVec3::ONE } else { DVec3::new(1.0, -1.0, 1.0) };
            let high = DVec3::from_array(size) * sign;
            cuboid(high.min(DVec3::ZERO), high.max(DVec3::ZERO))
        })
        .collect();
    made(random, boxes)
}

fn stacks(random: &mut Random) -> Scene {
    let mut height = 0.0;
    let mut boxes = Vec::new();
    for _ in 0..random.whole(2, 6) {
        let thickness = f64::from(random.whole(1, 3));
        let low = DVec3::new(f64::from(random.whole(0, 2)), height, f64::from(random.whole(0, 2)));
        let size = DVec3::new(f64::from(random.whole(1, 4)), thickness, f64::from(random.whole(1, 4)));
        boxes.push(cuboid(low, low + size));
        height += thickness;
    }
    made(random, boxes)
}

/// Rectangles in planes of whole numbers across x, that overlap, touch and lie on one another.
fn sheets(random: &mut Random) -> Scene {
    let sheets: Vec<Mesh> = (0..random.whole(2, 8))
        .map(|_| {
            let x = f64::from(random.whole(0, 2));
            let (y, z) = (f64::from(random.whole(0, 5)), f64::from(random.whole(0, 5)));
            let (height, width) = (f64::from(random.whole(1, 5)), f64::from(random.whole(1, 5)));
            let corners = [(y, z), (y + height, z), (y + height, z + width), (y, z + width)];
            mesh(corners.map(|(y, z)| DVec3::new(x, y, z)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
        })
        .collect();
    let sheets = with_axes(random, sheets);
    let camera = camera(random);
    scene_of(sheets, camera)
}

/// Steps, one of them seen edge-on from some side: one solid whose faces go up and down.
fn stairs(random: &mut Random) -> Scene {
    let mut profile = vec![(0.0, 0.0)];
    for _ in 0..random.whole(2, 7) {
        let (y, z) = profile[profile.len() - 1];
        let (rise, run) = random.one_of(&[(0, 1), (1, 0), (1, 1), (2, 1), (-1, 1), (0, 2), (1, 2)]);
        profile.push((y + f64::from(rise), z + f64::from(run)));
    }
    // A strip of that profile, closed below by the corresponding quads.
    let count = profile.len() as u32;
    let floor = profile.iter().map(|(y, _)| *y).fold(f64::INFINITY, f64::min) - 1.0;
    let mut positions = Vec::new();
    for x in [0.0, f64::from(random.whole(1, 4))] {
        positions.extend(profile.iter().map(|(y, z)| DVec3::new(x, *y, *z)));
        positions.extend(profile.iter().map(|(_, z)| DVec3::new(x, floor, *z)));
    }
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| {
        let is_face =
            [a, b, c, d].iter().all(|corner| [a, b, c, d].iter().filter(|other| *other == corner).count() == 1);
        if is_face {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    };
    let other = 2 * count;
    for step in 0..count - 1 {
        quad([step, step + 1, other + step + 1, other + step]);
        let has_run = profile[step as usize].1 != profile[step as usize + 1].1;
        if has_run {
            quad([count + step, other + count + step, other + count + step + 1, count + step + 1]);
            quad([step, count + step, count + step + 1, step + 1]);
            quad([other + step, other + step + 1, other + count + step + 1, other + count + step]);
        }
    }
    quad([0, other, other + count, count]);
    quad([count - 1, 2 * count - 1, other + 2 * count - 1, other + count - 1]);
    let solid = mesh(positions, triangles);
    made(random, vec![solid])
}
