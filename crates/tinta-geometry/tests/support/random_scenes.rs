//! Random scenes for the tests of the visible lines.

use super::shapes::{Random, cuboid, icosphere, mesh};
use glam::{DMat3, DVec3};
use tinta::{CameraSettings, Mesh, Scene, SceneSettings, Size};

/// A vector with components from -1 to 1.
fn vector(random: &mut Random) -> DVec3 {
    DVec3::new(random.number(), random.number(), random.number()) * 2.0 - DVec3::ONE
}

/// A mesh randomly turned, scaled and placed.
fn placed(mesh: Mesh, random: &mut Random) -> Mesh {
    let turn = DMat3::from_axis_angle(random.direction(), random.number() * 6.0);
    let (size, place) = (0.15 + 0.6 * random.number(), vector(random) * 0.7);
    Mesh { positions: mesh.positions.iter().map(|point| turn * *point * size + place).collect(), ..mesh }
}

fn random_meshes(kind: u32, random: &mut Random) -> Vec<Mesh> {
    match kind {
        // Separate triangles of all sizes, every third a needle.
        0 => {
            let count = 10 + (random.number() * 70.0) as u32;
            let triangle = |number: u32| {
                let size = 0.05 + 0.9 * random.number();
                let a = vector(random);
                let (u, v) = (random.direction() * size, random.direction() * size);
                [a, a + u, a + if number.is_multiple_of(3) { u * 0.4 + v * 0.02 } else { v }]
            };
            let positions = (0..count).flat_map(triangle).collect();
            vec![mesh(positions, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())]
        }
        // Boxes through one another.
        1 => (0..3 + (random.number() * 4.0) as u32)
            .map(|_| placed(cuboid(-DVec3::ONE, DVec3::new(1.0, 0.2 + random.number(), random.number())), random))
            .collect(),
        // Spheres, most of them open.
        2 => (0..2 + (random.number() * 3.0) as u32)
            .map(|number| {
                let mut sphere = icosphere(1 + number % 2);
                let (side, limit) = (random.direction(), random.number() * 1.6);
                sphere.triangles.retain(|corners| {
                    corners.map(|corner| sphere.positions[corner as usize]).iter().any(|p| p.dot(side) < limit)
                });
                placed(sphere, random)
            })
            .collect(),
        // Any three of some points: edges of many faces, faces that share corners and pass through one another.
        _ => {
            let count = 12 + (random.number() * 10.0) as u32;
            let mut triangles: Vec<[u32; 3]> = Vec::new();
            while triangles.len() < 2 * count as usize {
                let mut corners = [(); 3].map(|()| (random.number() * f64::from(count)) as u32);
                let is_known = |known: &[u32; 3]| corners.iter().all(|corner| known.contains(corner));
                let [a, b, c] = corners;
                if a != b && b != c && c != a && !triangles.iter().any(is_known) {
                    corners.rotate_left(1);
                    triangles.push(corners);
                }
            }
            vec![mesh((0..count).map(|_| vector(random)).collect(), triangles)]
        }
    }
}

/// A scene seen from anywhere, now and then from within.
pub fn random_scene(kind: u32, random: &mut Random) -> Scene {
    let meshes = random_meshes(kind, random);
    let distance = if random.number() < 0.4 { random.number() } else { 1.5 + 3.0 * random.number() };
    let camera = CameraSettings {
        eye: Some(random.direction() * distance),
        target: Some(vector(random) * 0.2),
        up: Some(random.direction()),
        fov_y_degrees: 20.0 + 80.0 * random.number(),
        parallel: random.number() < 0.4,
        near: Some(0.01 + 0.3 * random.number().powi(2)),
        far: Some(if random.number() < 0.3 { 0.8 + distance } else { 20.0 }),
        ..CameraSettings::default()
    };
    let size = Size { width: 640, height: 400 };
    Scene::new(meshes, &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap()
}
