//! What is left out, against rays in f64 and against arithmetic.

use super::*;
use crate::camera::{CameraSettings, View};
use crate::lines::first_hits;
use crate::mesh::{Defects, LoadOptions, load};
use crate::scene::{Scene, SceneSettings, Size};
use std::collections::HashMap;
use std::sync::Arc;

const SIZE: Size = Size { width: 160, height: 160 };

/// A mesh with a normal a face.
fn mesh_of(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    let normal = |triangle: &[u32; 3]| {
        triangle_normal(triangle.map(|point| positions[point as usize])).unwrap_or(DVec3::Z).as_vec3()
    };
    Mesh {
        name: "a test".to_owned(),
        file_vertices: (0..positions.len() as u32).collect(),
        normals: triangles.iter().map(normal).collect(),
        triangle_normals: (0..triangles.len() as u32).map(|face| [face; 3]).collect(),
        texture_coordinates: Vec::new(),
        triangle_texture_coordinates: Vec::new(),
        materials: Vec::new(),
        triangle_materials: Vec::new(),
        position_colors: Vec::new(),
        defects: Defects::default(),
        positions,
        triangles,
    }
}

/// An octahedron whose faces are cut in four so many times, on the unit sphere.
fn sphere(cuts: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut positions = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mut triangles = vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..cuts {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        let cut = |[a, b, c]: [u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    (positions, triangles)
}

fn scene_of(mesh: Mesh, view: (f64, f64)) -> Scene {
    let view = View { azimuth_degrees: view.0, elevation_degrees: view.1 };
    let camera = CameraSettings { view, ..CameraSettings::default() };
    scene_with(mesh, camera)
}

fn scene_with(mesh: Mesh, camera: CameraSettings) -> Scene {
    Scene::new(vec![Arc::new(mesh)], &SceneSettings { camera, size: SIZE, ..SceneSettings::default() }).unwrap()
}

/// Which of the mesh's triangles are drawn in this view; checks that no ray meets another one first.
fn drawn_triangles(scene: &Scene, hiding: &Hiding) -> Vec<bool> {
    let object = &scene.objects[0];
    let arrays = scene.arrays(object);
    let Some(drawn) = hiding.faces_to_draw(&scene.view_of(object), SIZE, 8) else {
        return vec![true; object.mesh.triangles.len()];
    };
    let mut is_drawn = vec![false; object.mesh.triangles.len()];
    let mut next = drawn.indices.chunks_exact(3).peekable();
    for (triangle, corners) in arrays.order.iter().zip(arrays.indices.chunks_exact(3)) {
        is_drawn[*triangle as usize] = next.next_if_eq(&corners).is_some();
    }
    assert_eq!(next.next(), None, "the drawn faces come in the arrays' order");
    assert_eq!(is_drawn.iter().filter(|is_drawn| !**is_drawn).count(), drawn.left_out);
    for hit in first_hits(scene).into_iter().flatten() {
        assert!(is_drawn[hit.face as usize], "face {} is seen and left out", hit.face);
    }
    is_drawn
}

/// The share of faces left out.
fn share(scene: &Scene) -> f64 {
    let hiding = Hiding::new(&scene.objects[0].mesh, scene.arrays(&scene.objects[0]));
    let is_drawn = drawn_triangles(scene, &hiding);
    is_drawn.iter().filter(|is_drawn| !**is_drawn).count() as f64 / is_drawn.len() as f64
}

#[test]
fn nearly_half_of_a_sphere_is_left_out_and_no_ray_meets_any_of_it_first() {
    for view in [(0.0, 0.0), (30.0, 15.0), (-100.0, 70.0)] {
        let (positions, triangles) = sphere(4);
        let share = share(&scene_of(mesh_of(positions, triangles), view));
        // From the fitted distance a sphere shows less than half of itself.
        assert!((0.4..0.62).contains(&share), "{share}");
    }
}

#[test]
fn a_cube_with_three_sides_shown_keeps_all_faces_that_touch_them() {
    let (low, high) = (-1.0, 1.0);
    let positions: Vec<DVec3> =
        (0..8).map(|i| DVec3::from_array([0, 1, 2].map(|bit| if i >> bit & 1 == 1 { high } else { low }))).collect();
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let scene = scene_of(mesh_of(positions, triangles), (30.0, 20.0));
    let counts = Hiding::new(&scene.objects[0].mesh, scene.arrays(&scene.objects[0])).counts();
    assert_eq!((counts.shells, counts.sound_shells, counts.hideable_faces), (1, 1, 12));
    // Only faces at no corner but the hidden one could go, and a cube has none.
    assert_eq!(share(&scene), 0.0);
}

#[test]
fn an_inside_out_sphere_leaves_out_nothing() {
    let (positions, mut triangles) = sphere(3);
    triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert_eq!(share(&scene_of(mesh_of(positions, triangles), (10.0, 20.0))), 0.0);
}

#[test]
fn a_sheet_without_thickness_leaves_out_nothing() {
    // A flattened sphere: its two sides lie on one another.
    let (mut positions, triangles) = sphere(3);
    positions.iter_mut().for_each(|position| position.z = 0.0);
    for view in [(10.0, 20.0), (180.0, 20.0)] {
        assert_eq!(share(&scene_of(mesh_of(positions.clone(), triangles.clone()), view)), 0.0);
    }
}

#[test]
fn of_a_figure_eight_only_the_lobe_that_is_the_right_way_round_leaves_out_faces() {
    // A ring whose section is an eight: its upper lobe runs counter-clockwise, its lower one clockwise.
    let (rows, columns) = (60u32, 64u32);
    let angle = |number: u32, count: u32| std::f64::consts::TAU * (f64::from(number) + 0.5) / f64::from(count);
    let point = |row: u32, column: u32| {
        let (sin, cos) = angle(row, rows).sin_cos();
        let (sin_turn, cos_turn) = angle(column, columns).sin_cos();
        let radius = 2.0 + sin * cos;
        DVec3::new(radius * sin_turn, sin, radius * cos_turn)
    };
    let positions: Vec<DVec3> =
        (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).map(|(r, c)| point(r, c)).collect();
    let at = |row: u32, column: u32| row % rows * columns + column % columns;
    let mut triangles = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    for view in [(0.0, 10.0), (77.0, -20.0)] {
        let scene = scene_of(mesh_of(positions.clone(), triangles.clone()), view);
        let mesh = scene.objects[0].mesh.clone();
        let hiding = Hiding::new(&mesh, scene.arrays(&scene.objects[0]));
        assert_eq!((hiding.counts().shells, hiding.counts().sound_shells), (1, 1));
        let is_drawn = drawn_triangles(&scene, &hiding);
        let left_out: Vec<_> = mesh.triangles.iter().zip(&is_drawn).filter(|(_, is_drawn)| !**is_drawn).collect();
        assert!(left_out.len() > triangles.len() / 20, "{}", left_out.len());
        for (triangle, _) in left_out {
            let height: f64 = triangle.iter().map(|point| mesh.positions[*point as usize].y).sum();
            assert!(height > 0.0, "a face of the lobe that is inside out is left out");
        }
    }
}

fn hemisphere() -> Mesh {
    let (positions, mut triangles) = sphere(4);
    triangles.retain(|triangle| triangle.iter().all(|point| positions[*point as usize].y > -1e-9));
    mesh_of(positions, triangles)
}

#[test]
fn a_hemisphere_leaves_out_its_back_but_nothing_that_its_opening_shows() {
    let scene = scene_of(hemisphere(), (20.0, 25.0));
    let counts = Hiding::new(&scene.objects[0].mesh, scene.arrays(&scene.objects[0])).counts();
    assert_eq!((counts.shells, counts.sound_shells, counts.capped_holes), (1, 1, 1));
    assert!(share(&scene) > 0.1, "{}", share(&scene));
    let view = View { azimuth_degrees: 20.0, elevation_degrees: 90.0 };
    let from_above = scene_with(hemisphere(), CameraSettings { view, parallel: true, ..CameraSettings::default() });
    assert_eq!(share(&from_above), 0.0, "from above, in parallel projection, there is no back");
    assert_eq!(share(&scene_of(hemisphere(), (20.0, -90.0))), 0.0, "from below all of the inside is seen");
    let shares = [-10.0, -20.0, -30.0, -60.0].map(|elevation| share(&scene_of(hemisphere(), (20.0, elevation))));
    assert!(shares.is_sorted_by(|a, b| a >= b), "the more of the inside is seen, the less is left out: {shares:?}");
}

#[test]
fn two_spheres_that_pass_through_each_other_both_leave_out_faces() {
    let (mut positions, mut triangles) = sphere(4);
    let (points, faces) = (positions.len() as u32, triangles.len());
    positions.extend_from_within(..);
    positions[points as usize..].iter_mut().for_each(|position| position.x += 0.8);
    let moved: Vec<[u32; 3]> = triangles.iter().map(|triangle| triangle.map(|point| point + points)).collect();
    triangles.extend(moved);
    let scene = scene_of(mesh_of(positions, triangles), (10.0, 20.0));
    let hiding = Hiding::new(&scene.objects[0].mesh, scene.arrays(&scene.objects[0]));
    let is_drawn = drawn_triangles(&scene, &hiding);
    for half in is_drawn.chunks(faces) {
        assert!(half.iter().filter(|is_drawn| !**is_drawn).count() > faces / 3);
    }
}

#[test]
fn a_sphere_with_a_fin_or_a_face_turned_round_leaves_out_nothing() {
    let (positions, triangles) = sphere(3);
    let mut with_fin = (positions.clone(), triangles.clone());
    with_fin.1.push([triangles[0][0], triangles[0][1], positions.len() as u32]);
    with_fin.0.push(DVec3::splat(1.0));
    let mut turned = (positions, triangles);
    turned.1[5].swap(0, 1);
    for (positions, triangles) in [with_fin, turned] {
        assert_eq!(share(&scene_of(mesh_of(positions, triangles), (10.0, 20.0))), 0.0);
    }
}

#[test]
fn an_eye_inside_leaves_out_nothing() {
    let (positions, triangles) = sphere(3);
    let camera = CameraSettings { eye: Some(DVec3::splat(0.1)), target: Some(DVec3::X), ..CameraSettings::default() };
    assert_eq!(share(&scene_with(mesh_of(positions, triangles), camera)), 0.0);
}

#[test]
fn a_near_plane_that_cuts_the_object_leaves_out_nothing() {
    let (positions, triangles) = sphere(3);
    let whole = scene_of(mesh_of(positions.clone(), triangles.clone()), (0.0, 0.0));
    let near = Some((whole.camera.eye - whole.centre).length() - 0.8);
    let camera = CameraSettings {
        view: View { azimuth_degrees: 0.0, elevation_degrees: 0.0 },
        near,
        ..CameraSettings::default()
    };
    assert!(share(&whole) > 0.3);
    assert_eq!(share(&scene_with(mesh_of(positions, triangles), camera)), 0.0);
}

#[test]
fn a_surface_too_coarse_for_the_faces_leaves_out_nothing() {
    let (positions, triangles) = sphere(4);
    let scene = scene_of(mesh_of(positions, triangles), (0.0, 0.0));
    let object = &scene.objects[0];
    let hiding = Hiding::new(&object.mesh, scene.arrays(object));
    let left_out = |side: u32, bits: u32| {
        hiding
            .faces_to_draw(&scene.view_of(object), Size { width: side, height: side }, bits)
            .map_or(0, |drawn| drawn.left_out)
    };
    assert!(left_out(512, 8) > left_out(64, 8) && left_out(64, 8) > left_out(64, 6), "coarser pixels ask for more");
    assert_eq!(left_out(4, 4), 0);
}

#[test]
fn every_part_of_the_ant_keeps_its_material_and_its_order() {
    let mesh = load("../../models/ant.obj", &LoadOptions::default()).unwrap().mesh;
    let scene = scene_of(mesh, (30.0, 15.0));
    let object = &scene.objects[0];
    let arrays = scene.arrays(object);
    let hiding = Hiding::new(&object.mesh, arrays);
    drawn_triangles(&scene, &hiding);
    let drawn = hiding.faces_to_draw(&scene.view_of(object), SIZE, 8).unwrap();
    let mut materials = vec![NONE; arrays.vertices.len()];
    for part in &arrays.parts {
        for vertex in &arrays.indices[part.first as usize..][..part.count as usize] {
            materials[*vertex as usize] = part.material;
        }
    }
    let mut next = 0;
    for part in &drawn.parts {
        assert_eq!(part.first, next);
        next += part.count;
        let own = &drawn.indices[part.first as usize..][..part.count as usize];
        assert!(part.count > 0 && own.iter().all(|vertex| materials[*vertex as usize] == part.material));
    }
    assert_eq!(next as usize, drawn.indices.len());
    assert!(drawn.parts.windows(2).all(|pair| pair[0].material < pair[1].material));
}

#[test]
fn no_ray_meets_first_what_random_views_of_built_in_models_leave_out() {
    for model in ["../../models/bust.obj", "../../models/ant.obj"] {
        let mesh = Arc::new(load(model, &LoadOptions::default()).unwrap().mesh);
        let mut hiding = None;
        let mut most = 0;
        for number in 0..12 {
            let turn = f64::from(number);
            let view = View { azimuth_degrees: turn * 137.5, elevation_degrees: 80.0 * (turn * 1.7).sin() };
            let camera = CameraSettings { view, parallel: number % 3 == 1, ..CameraSettings::default() };
            let settings = SceneSettings { camera, size: SIZE, ..SceneSettings::default() };
            let scene = Scene::new(vec![mesh.clone()], &settings).unwrap();
            let hiding = hiding.get_or_insert_with(|| Hiding::new(&mesh, scene.arrays(&scene.objects[0])));
            let is_drawn = drawn_triangles(&scene, hiding);
            most = most.max(is_drawn.iter().filter(|is_drawn| !**is_drawn).count());
        }
        assert!(most > mesh.triangles.len() / 20, "{model}: {most}");
    }
}
