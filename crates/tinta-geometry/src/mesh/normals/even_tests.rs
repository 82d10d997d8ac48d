//! Bumps go, edges and large faces stay.

use super::*;

const COS_40: f64 = 0.766;

/// A square of `side` x `side` cells in the unit square, two triangles each, with every pair of triangles that share an edge.
fn sheet(side: usize) -> Vec<[u32; 2]> {
    let face = |x: usize, y: usize, half: usize| ((y * side + x) * 2 + half) as u32;
    let mut pairs = Vec::new();
    for y in 0..side {
        for x in 0..side {
            pairs.push([face(x, y, 0), face(x, y, 1)]);
            if x + 1 < side {
                pairs.push([face(x, y, 0), face(x + 1, y, 1)]);
            }
            if y + 1 < side {
                pairs.push([face(x, y, 1), face(x, y + 1, 0)]);
            }
        }
    }
    pairs
}

/// Normals about `up`, each turned by up to about 15 degrees, as if at random.
fn bumpy(up: DVec3, count: usize) -> Vec<DVec3> {
    let noise = |place: usize| ((place as f64 * 12.9898).sin() * 43758.5453).fract();
    (0..count)
        .map(|face| (up + 0.25 * DVec3::from_array([0, 1, 2].map(|axis| noise(3 * face + axis)))).normalize())
        .collect()
}

fn mean_angle(normals: &[DVec3], to: DVec3) -> f64 {
    normals.iter().map(|normal| normal.angle_between(to).to_degrees()).sum::<f64>() / normals.len() as f64
}

#[test]
fn bumps_of_small_faces_go() {
    let side = 200;
    let pairs = sheet(side);
    let count = 2 * side * side;
    let neighbours = Neighbours::new(count, pairs.iter().copied());
    let normals = bumpy(DVec3::Y, count);
    let areas = vec![0.5 / (side * side) as f64; count];
    let evened = even(&normals, &areas, &neighbours, 2f64.sqrt(), COS_40);
    let (before, after) = (mean_angle(&normals, DVec3::Y), mean_angle(&evened, DVec3::Y));
    assert!(before > 8.0 && after < before / 4.0, "{before} became {after}");
    assert!(evened.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
}

#[test]
fn an_edge_sharper_than_the_angle_stays() {
    let side = 100;
    let pairs = sheet(side);
    let count = 2 * side * side;
    let neighbours = Neighbours::new(count, pairs.iter().copied());
    // The upper half stands upright.
    let normals: Vec<DVec3> = (0..count).map(|face| if face < count / 2 { DVec3::Y } else { DVec3::Z }).collect();
    let evened = even(&normals, &vec![0.5 / (side * side) as f64; count], &neighbours, 2f64.sqrt(), COS_40);
    let farthest = normals.iter().zip(&evened).map(|(a, b)| a.angle_between(*b)).fold(0.0, f64::max);
    assert!(farthest < 1e-6, "{farthest}");
}

#[test]
fn large_faces_stay_and_lend_their_normals() {
    let side = 10;
    let pairs = sheet(side);
    let count = 2 * side * side;
    let neighbours = Neighbours::new(count, pairs.iter().copied());
    let normals = bumpy(DVec3::Y, count);
    assert_eq!(even(&normals, &vec![0.005; count], &neighbours, 2f64.sqrt(), COS_40), normals);
    // One small face between large ones that agree comes to agree with them.
    let mut normals = vec![DVec3::Y; count];
    let mut areas = vec![0.005; count];
    (normals[90], areas[90]) = (DVec3::new(0.3, 1.0, 0.0).normalize(), 1e-6);
    let evened = even(&normals, &areas, &neighbours, 2f64.sqrt(), COS_40);
    assert!(evened[90].angle_between(DVec3::Y) < 1e-3, "{}", evened[90]);
}

#[test]
fn nothing_is_asked_of_no_faces_and_of_alien_angles() {
    let none = Neighbours::new(0, std::iter::empty());
    assert!(even(&[], &[], &none, 1.0, COS_40).is_empty());
    let two = Neighbours::new(2, [[0, 1]].into_iter());
    for cosine in [-1.0, 0.0, 1.0, 2.0] {
        let normals = [DVec3::Y, DVec3::new(0.1, 1.0, 0.0).normalize()];
        let evened = even(&normals, &[1e-9, 1e-9], &two, 1.0, cosine);
        assert!(evened.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6), "{cosine}: {evened:?}");
    }
}
