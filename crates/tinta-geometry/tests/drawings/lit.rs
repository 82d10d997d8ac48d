//! Tones by a far light: straight borders on round forms, the side that is seen, patches that are too small to draw, and the light
//! that is chosen.

use crate::support::lines::view;
use crate::support::shapes::icosphere;
use glam::DVec3;
use tinta::camera::Framing;
use tinta::lines::{Progress, Regions, SeenNormals, Sight, ToneLight, ToneRule, TonedSurface};
use tinta::{CameraSettings, Mesh, Scene, SceneSettings, Size};

const THRESHOLDS: [f64; 2] = [0.2, 0.56];

/// A view straight from the front, without perspective.
fn seen(mesh: Mesh, name: &str) -> Scene {
    seen_all([mesh], name)
}

fn seen_all<const N: usize>(meshes: [Mesh; N], name: &str) -> Scene {
    let camera = CameraSettings { framing: Framing::Outline, ..view(name, true) };
    let size = Size { width: 480, height: 480 };
    Scene::new(meshes, &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap()
}

fn toned(scene: &Scene, light: [f64; 3]) -> Regions<Option<TonedSurface>> {
    let rule = ToneRule { light: ToneLight::Far(DVec3::from_array(light).normalize()), thresholds: THRESHOLDS };
    Regions::toned(&Sight::of(scene), &rule, &Progress::default()).unwrap()
}

/// The scene as a light shows it.
fn lit(scene: &Scene, light: [f32; 3]) -> Scene {
    SeenNormals::of(scene).lit(scene, light, THRESHOLDS)
}

/// The shares of the three tones in what is seen.
fn shares(regions: &Regions<Option<TonedSurface>>) -> [f64; 3] {
    let mut areas = [0.0; 3];
    regions.regions.iter().for_each(|region| {
        if let Some(surface) = region.seen {
            areas[usize::from(surface.tone)] += region.area_px;
        }
    });
    let all: f64 = areas.iter().sum();
    areas.map(|area| area / all)
}

/// A ball whose normals have this length.
fn ball(length: f32) -> Mesh {
    let mesh = icosphere(5);
    let normals: Vec<_> = mesh.positions.iter().map(|position| position.normalize().as_vec3() * length).collect();
    Mesh { normals, triangle_normals: mesh.triangles.clone(), ..mesh }
}

#[test]
fn the_borders_of_tones_on_a_ball_are_circles_that_lie_straight_beside_the_light() {
    // A light from the left: a border is a circle seen from its side, a straight line. Averaged normals only move it.
    for length in [1.0, 0.95] {
        let scene = seen(ball(length), "0,0");
        let regions = toned(&scene, [-1.0, 0.0, 0.0]);
        let corners =
            || regions.regions.iter().filter(|region| region.seen.is_some()).flat_map(|region| region.loops.concat());
        let [left, right] =
            [f64::min as fn(f64, f64) -> f64, f64::max].map(|of| corners().map(|px| px.x).reduce(of).unwrap());
        let (middle, radius) = ((left + right) * 0.5, (right - left) * 0.5);
        let is_inside = |px: &glam::DVec2| (*px - glam::DVec2::new(middle, 240.0)).length() < 0.98 * radius;
        let expected = THRESHOLDS.map(|threshold| middle - radius * threshold / f64::from(length));
        let (mut count, mut farthest) = (0, 0.0f64);
        for px in corners().filter(is_inside) {
            count += 1;
            let off = expected.iter().map(|x| (px.x - x).abs()).fold(f64::INFINITY, f64::min);
            farthest = farthest.max(off);
        }
        assert!(count > 200 && farthest < 1.0, "{count} corners, {farthest} px off");
    }
}

/// A square of so many cells a side at these heights, smooth.
fn sheet(cells: u32, height: impl Fn(f64, f64) -> f64) -> Mesh {
    let side = cells + 1;
    let place = |n: u32| {
        let [x, y] = [n % side, n / side].map(|at| 2.0 * f64::from(at) / f64::from(cells) - 1.0);
        DVec3::new(x, y, height(x, y))
    };
    let slope = |p: DVec3| {
        let step = 1e-4;
        let [dx, dy] = [height(p.x + step, p.y) - p.z, height(p.x, p.y + step) - p.z];
        DVec3::new(-dx / step, -dy / step, 1.0).normalize().as_vec3()
    };
    let positions: Vec<DVec3> = (0..side * side).map(place).collect();
    let triangles: Vec<[u32; 3]> = (0..cells * cells)
        .flat_map(|n| {
            let a = n / cells * side + n % cells;
            [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]
        })
        .collect();
    let normals = positions.iter().map(|p| slope(*p)).collect();
    let file_vertices = (0..positions.len() as u32).collect();
    Mesh { positions, file_vertices, normals, triangle_normals: triangles.clone(), triangles, ..Mesh::triangle() }
}

#[test]
fn a_dent_too_small_to_draw_has_the_tone_around_it_and_a_larger_one_keeps_its_own() {
    for (width, is_drawn) in [(0.03, false), (0.3, true)] {
        let mesh = sheet(100, |x, y| 1.5 * width * (-(x * x + y * y) / (width * width)).exp());
        let scene = seen(mesh, "0,0");
        let light = [-0.4f32, 1.0, 1.2];
        let before = toned(&scene, light.map(f64::from));
        let lit = lit(&scene, light);
        let after = toned(&lit, light.map(f64::from));
        let count =
            |regions: &Regions<Option<TonedSurface>>| regions.regions.iter().filter(|it| it.seen.is_some()).count();
        assert!(count(&before) > 1, "{width}");
        assert_eq!(count(&after) > 1, is_drawn, "{width}: {:?}", shares(&after));
        assert_eq!(lit.objects[0].mesh.positions, scene.objects[0].mesh.positions);
    }
}

#[test]
fn no_patch_of_a_tone_is_left_that_is_smaller_than_a_five_hundredth_of_a_rough_sheet() {
    let mesh =
        sheet(120, |x, y| 0.04 * (9.0 * x).sin() * (7.0 * y).cos() + 0.012 * (31.0 * x + 3.0).sin() * (29.0 * y).cos());
    let scene = seen(mesh, "0,0");
    let light = [-0.5f32, 0.65, 0.6];
    let smallest = |scene: &Scene| {
        let regions = toned(scene, light.map(f64::from));
        let areas = regions.regions.iter().filter(|it| it.seen.is_some()).map(|it| it.area_px);
        (areas.clone().fold(f64::INFINITY, f64::min) / areas.clone().sum::<f64>(), areas.count())
    };
    let (before, after) = (smallest(&scene), smallest(&lit(&scene, light)));
    // A share is counted in the pixels of a small picture.
    assert!(before.0 < 0.0015 && after.0 > 0.0015 && after.1 > 3, "{before:?}, {after:?}");
}

#[test]
fn a_flat_face_keeps_its_tone_however_small_it_is() {
    // Two squares that meet in no corner, a small one turned to the light.
    let mut mesh = sheet(1, |_, _| 0.0);
    let first = mesh.positions.len() as u32;
    let small = sheet(1, |_, _| 0.0);
    mesh.positions.extend(small.positions.iter().map(|p| DVec3::new(0.02 * p.x, 0.02 * p.y, 0.5)));
    mesh.file_vertices = (0..mesh.positions.len() as u32).collect();
    mesh.triangles.extend(small.triangles.iter().map(|t| t.map(|corner| corner + first)));
    mesh.normals = vec![glam::Vec3::Z, glam::Vec3::new(0.0, 1.0, 0.2).normalize()];
    mesh.triangle_normals = vec![[0; 3], [0; 3], [1; 3], [1; 3]];
    let light = [0.0f32, 1.0, 0.5];
    let scene = lit(&seen(mesh.clone(), "0,0"), light);
    assert_eq!(scene.objects[0].mesh.normals, mesh.normals);
    assert_eq!(toned(&scene, light.map(f64::from)).regions.iter().filter(|it| it.seen.is_some()).count(), 2);
}

#[test]
fn a_small_round_part_keeps_the_tones_that_are_a_large_part_of_it() {
    let round = ball(1.0);
    let small = Mesh { positions: round.positions.iter().map(|p| 0.025 * *p + DVec3::Z * 0.5).collect(), ..round };
    let light = [-1.0f32, 0.3, 0.6];
    let scene = seen_all([sheet(1, |_, _| 0.0), small.clone()], "0,0");
    let lit = lit(&scene, light);
    let light = light.map(f64::from);
    assert_eq!(shares(&toned(&lit, light)), shares(&toned(&scene, light)));
}

/// A pixel is mixed by how far its light is from a threshold and how fast light changes there.
#[test]
fn light_keeps_away_from_thresholds_at_corners_where_no_border_of_tones_is() {
    let mesh = sheet(120, |x, y| 0.08 * (9.0 * x).sin() * (7.0 * y).cos());
    let light = [-0.5f32, 0.65, 0.6];
    let lit = lit(&seen(mesh, "0,0"), light);
    let mesh = &lit.objects[0].mesh;
    let light = glam::Vec3::from_array(light).normalize();
    let lights: Vec<f64> = mesh.normals.iter().map(|normal| f64::from(normal.dot(light))).collect();
    let mut borders = 0;
    for threshold in THRESHOLDS {
        let mut at_border = vec![false; lights.len()];
        for corners in &mesh.triangle_normals {
            let is_above = corners.map(|corner| lights[corner as usize] >= threshold);
            if is_above != [is_above[0]; 3] {
                corners.iter().for_each(|corner| at_border[*corner as usize] = true);
            }
        }
        let used = || mesh.triangle_normals.as_flattened().iter().map(|corner| *corner as usize);
        let near = used().filter(|corner| !at_border[*corner] && (lights[*corner] - threshold).abs() < 0.0199).count();
        assert_eq!(near, 0, "{threshold}");
        borders += used().filter(|corner| at_border[*corner]).count();
    }
    assert!(borders > 100, "{borders}");
}

#[test]
fn the_side_that_is_seen_is_lit_from_the_front_from_behind_and_with_a_twin() {
    let light = [-0.4, 0.8, 0.8];
    let tones = |mesh: Mesh, view: &str| shares(&toned(&seen(mesh, view), light));
    let bent = |x: f64, y: f64| 0.2 * x * x + 0.1 * y;
    let front = tones(sheet(30, bent), "20,10");
    // The same surface wound the other way is lit as before, for the side that is seen is the same.
    let turned = |mesh: &Mesh| {
        let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let normals = mesh.normals.iter().map(|normal| -*normal).collect();
        Mesh { triangle_normals: triangles.clone(), triangles, normals, ..mesh.clone() }
    };
    let sheet = sheet(30, bent);
    let back = turned(&sheet);
    assert_eq!(tones(back.clone(), "20,10"), front);
    let twin = Mesh {
        triangles: [sheet.triangles.clone(), back.triangles.clone()].concat(),
        normals: [sheet.normals.clone(), back.normals.clone()].concat(),
        triangle_normals: sheet
            .triangle_normals
            .iter()
            .copied()
            .chain(back.triangle_normals.iter().map(|t| t.map(|n| n + sheet.normals.len() as u32)))
            .collect(),
        ..sheet.clone()
    };
    let of_twin = tones(twin.clone(), "20,10");
    assert!(of_twin.iter().zip(front).all(|(a, b)| (a - b).abs() < 1e-6), "{of_twin:?} instead of {front:?}");
    let behind = tones(sheet, "200,10");
    let of_twin = tones(twin, "200,10");
    assert!(of_twin.iter().zip(behind).all(|(a, b)| (a - b).abs() < 1e-6), "{of_twin:?} instead of {behind:?}");
}

#[test]
fn the_light_that_is_chosen_leaves_about_a_fifth_of_a_ball_dark_from_above() {
    for view in ["0,0", "30,23", "200,-20"] {
        let scene = seen(ball(1.0), view);
        let light = SeenNormals::of(&scene).best_light(THRESHOLDS);
        assert!(light[1] > 0.0 && light[2] > 0.0, "{light:?}");
        let [dark, ..] = shares(&toned(&lit(&scene, light), light.map(f64::from)));
        assert!((0.12..=0.28).contains(&dark), "{dark} of {view}");
    }
}
