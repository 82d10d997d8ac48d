//! The worst of all groups together, drawn at random from a seed.

use super::case::{Case, Demand, Drawing, Group};
use crate::stress::{Shape, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;
use tinta::random::Random;
use tinta::scene::Size;

/// The shapes of the mixes.
const SHAPES: [Shape; 16] = [
    Shape::Ball(3),
    Shape::InsideOut(2),
    Shape::Cube,
    Shape::CubeAndSmaller(1e6),
    Shape::CubeAndSmaller(1e3),
    Shape::Needle(1e6),
    Shape::Needle(1e9),
    Shape::ZeroAreas,
    Shape::OppositeDuplicates,
    Shape::Fins(5),
    Shape::Moebius,
    Shape::TJunction,
    Shape::Contact,
    Shape::Piercing,
    Shape::Flat(12),
    Shape::Fan(300),
];

pub(super) fn cases(seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed, "stiff mixes");
    (0..count).map(|number| mix(&mut random, seed, number)).collect()
}

fn mix(random: &mut Random, seed: u64, number: usize) -> Case {
    let shape = SHAPES[random.below(SHAPES.len())];
    let scale = 10f64.powf(random.signed_f64() * 30.0);
    let point = |random: &mut Random| DVec3::new(random.signed_f64(), random.signed_f64(), random.signed_f64());
    // Up to a million times the model's own size away.
    let offset = point(random) * scale * 10f64.powf(random.signed_f64() * 6.0);
    let camera = camera(random, point);
    let sides = [1, 2, 3, 17, 64, 99, 128, 201];
    let size = Size { width: sides[random.below(sides.len())], height: sides[random.below(sides.len())] };
    let mut variants = Variant::all();
    let first = random.below(variants.len());
    variants.rotate_left(first);
    variants.truncate(3);
    let drawing = Drawing { shape, scale, offset, camera, size, variants, ..Drawing::default() };
    let case = Case::rendered(Group::Mixes, format!("mix {number} of seed {seed}"), drawing);
    Case { expected: Demand::Either(&["setting"]), ..case }
}

/// Fitted, or somewhere in or around the unit cube, with any angle and planes.
fn camera(random: &mut Random, point: impl Fn(&mut Random) -> DVec3) -> CameraSettings {
    let mut camera = CameraSettings { parallel: random.below(4) == 0, ..CameraSettings::default() };
    camera.view.azimuth_degrees = random.signed_f64() * 180.0;
    camera.view.elevation_degrees = random.signed_f64() * 90.0;
    if random.below(3) == 0 {
        let reach = 10f64.powf(random.signed_f64() * 3.0);
        camera.eye = Some(DVec3::splat(0.5) + point(random) * reach);
        camera.target = Some(DVec3::splat(0.5) + point(random) * 0.2);
    }
    if random.below(3) == 0 {
        camera.fov_y_degrees = 90.0 + random.signed_f64() * 89.9;
    }
    if random.below(4) == 0 {
        camera.near = Some(10f64.powf(random.signed_f64() * 6.0));
    }
    if random.below(4) == 0 {
        camera.far = Some(10f64.powf(random.signed_f64() * 6.0));
    }
    camera
}
