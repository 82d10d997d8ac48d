//! Scenes of open faces that mostly touch, lie in one plane or cross along mesh lines.

use crate::support::families::{Family, camera};
use crate::support::lines::scene_of;
use crate::support::shapes::{Random, joined, mesh};
use glam::{DMat3, DVec3};
use tinta::{Mesh, Scene};

pub const CROSSINGS: [(&str, Family); 2] =
    [("open faces crossing along mesh lines", crossing), ("open faces on a lattice", on_a_lattice)];

/// A convex polygon as a fan.
fn polygon(corners: &[DVec3]) -> Mesh {
    let fan = (1..corners.len() as u32 - 1).map(|corner| [0, corner, corner + 1]).collect();
    mesh(corners.to_vec(), fan)
}

fn whole(random: &mut Random, low: i32, high: i32) -> f64 {
    f64::from(random.whole(low, high))
}

/// Two faces with mesh lines along x at both sides of it, flat or bent, and a face that passes through them along x: from a
/// corner to a side, to a corner or to an inner point, or from side to side.
fn crossing(random: &mut Random) -> Scene {
    let end = DVec3::X * whole(random, 2, 4);
    let aside = |random: &mut Random, up: DVec3| up * whole(random, 1, 2) + DVec3::X * whole(random, -1, 3);
    let (first, mut second) = (aside(random, DVec3::Y), aside(random, DVec3::NEG_Y));
    if random.number() < 0.3 {
        second.z = whole(random, -1, 1);
    }
    let mut faces = match random.number() < 0.5 {
        true => vec![polygon(&[DVec3::ZERO, first, end]), polygon(&[end, second, DVec3::ZERO])],
        false => vec![polygon(&[DVec3::ZERO, DVec3::Y, end, DVec3::NEG_Y])],
    };
    let through = |random: &mut Random| DVec3::new(whole(random, -1, 1), whole(random, -1, 1), whole(random, 1, 2));
    let (at_start, at_end) = (through(random), through(random));
    let share = if random.number() < 0.5 { 1.0 } else { 0.5 };
    faces.push(match random.whole(0, 4) {
        0 | 1 => polygon(&[DVec3::ZERO, end + at_end, end - at_end * share]),
        2 => polygon(&[DVec3::ZERO, end * 0.5 + at_end, end, end * 0.5 - at_end * share]),
        3 => polygon(&[DVec3::ZERO, end * 1.5 + at_end, end * 1.5 - at_end * share]),
        _ => polygon(&[at_start, end + at_end, end - at_end, -at_start]),
    });
    if random.number() < 0.3 {
        faces.push(lattice_face(random));
    }
    made(random, &faces)
}

/// A triangle or a parallelogram with corners on a lattice.
fn lattice_face(random: &mut Random) -> Mesh {
    loop {
        let [a, b, c] = [(); 3].map(|()| DVec3::from_array([(); 3].map(|()| whole(random, 0, 3))));
        if (b - a).cross(c - a) != DVec3::ZERO {
            return if random.number() < 0.5 { polygon(&[a, b, c]) } else { polygon(&[a, b, b + c - a, c]) };
        }
    }
}

fn on_a_lattice(random: &mut Random) -> Scene {
    let faces: Vec<Mesh> = (0..random.whole(2, 4)).map(|_| lattice_face(random)).collect();
    made(random, &faces)
}

fn made(random: &mut Random, faces: &[Mesh]) -> Scene {
    let mut all = joined(faces);
    if random.number() < 0.5 {
        let turn = DMat3::from_axis_angle(random.direction(), random.number() * 6.0);
        all.positions.iter_mut().for_each(|point| *point = turn * *point);
    }
    let camera = camera(random);
    scene_of(vec![all], camera)
}
