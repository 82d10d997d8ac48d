//! Soups made by hand, and the meshes that come of them.

use super::*;
use crate::mesh::soup::direction;
use crate::mesh::{Normals, UpAxis};
use glam::Vec2;

fn square() -> Soup {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
    let corners = (0..4).map(Corner::at).collect();
    Soup { positions, corners, polygon_sizes: vec![4], ..Soup::default() }
}

fn mesh(soup: Soup) -> Mesh {
    soup.into_mesh("test", &LoadOptions::default()).unwrap()
}

#[test]
fn a_square_becomes_two_triangles_over_four_positions() {
    let mesh = mesh(square());
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
    assert!(mesh.defects.is_empty());
}

#[test]
fn triangles_know_the_polygon_that_they_are_cut_from() {
    let mut soup = square();
    soup.positions.push(DVec3::X * 2.0);
    let mut face = |indices: &[u32]| {
        soup.corners.extend(indices.iter().map(|index| Corner::at(*index)));
        soup.polygon_sizes.push(indices.len() as u32);
    };
    face(&[0, 1, 4]); // on one line
    face(&[2, 1, 4]);
    face(&[1, 4, 2]); // repeats it, turned
    face(&[3, 2, 1, 0]);
    let mixed = mesh(soup);
    assert_eq!(mixed.file_faces, [0, 0, 2, 4, 4]);
    assert_eq!((0..5).map(|triangle| mixed.file_face(triangle)).collect::<Vec<_>>(), mixed.file_faces);
    let alone = mesh(Soup { corners: [0, 1, 2].map(Corner::at).to_vec(), polygon_sizes: Vec::new(), ..square() });
    assert!(alone.file_faces.is_empty() && alone.file_face(0) == 0);
}

#[test]
fn defects_are_counted_and_left_out() {
    let mut soup = square();
    soup.positions.extend([DVec3::splat(9.0), DVec3::new(f64::NAN, 0.0, 0.0), DVec3::X * 2.0]);
    let mut face = |indices: &[u32]| {
        soup.corners.extend(indices.iter().map(|index| Corner::at(*index)));
        soup.polygon_sizes.push(indices.len() as u32);
    };
    face(&[1, 2, 0]); // half of the square, which is another polygon
    face(&[2, 0, 1]); // repeats it, turned
    face(&[2, 1, 0]); // its other side
    face(&[0, 1, 1]);
    face(&[0, 1, 6]); // on one line
    face(&[0, 1, 5]); // not finite
    let mesh = mesh(soup);
    assert_eq!(mesh.triangles.len(), 4);
    let expected = Defects {
        degenerate_triangles: 2,
        duplicate_triangles: 1,
        doubled_triangles: 1,
        non_finite_vertices: 1,
        unused_vertices: 1,
        ..Defects::default()
    };
    assert_eq!(mesh.defects, expected);
    assert_eq!(mesh.file_vertices, [0, 1, 2, 3]);
}

#[test]
fn normals_of_any_length_have_their_direction_and_others_are_computed_and_counted() {
    let expected = Vec3::new(0.6, 0.0, 0.8);
    for length in [1e-320, 1e-100, 1e-30, 1e-3, 1.0, 1e20, 1e38, 1e100, 1e307] {
        let mut soup = square();
        soup.normals = vec![direction(DVec3::new(0.6, 0.0, 0.8) * length)];
        soup.corners.iter_mut().for_each(|corner| corner.normal = 0);
        let mesh = mesh(soup);
        // Of 1e-320 a few digits are left.
        assert!(mesh.normals[0].distance(expected) < if length < 1e-300 { 1e-3 } else { 1e-6 }, "{length}");
        assert!(mesh.defects.is_empty(), "{length}");
    }
    for normal in [DVec3::ZERO, DVec3::NAN, DVec3::new(0.0, f64::INFINITY, 1.0)] {
        let mut soup = square();
        soup.normals = vec![direction(normal), Vec3::Z];
        for (number, corner) in soup.corners.iter_mut().enumerate() {
            corner.normal = u32::from(number > 1);
        }
        let mesh = mesh(soup);
        assert_eq!((mesh.defects.unusable_normals, mesh.defects.unusable_texture_coordinates), (2, 0));
        assert!(mesh.normals.iter().all(|normal| *normal == Vec3::Z));
    }
}

#[test]
fn scaling_a_normal_rounds_nothing() {
    for normal in [Vec3::new(0.1, -0.7, 0.3), Vec3::new(3.0, 1e-3, 200.0), Vec3::new(1.0, 1.0, 1.0)] {
        assert_eq!(direction(normal.as_dvec3()).normalize(), normal.normalize());
    }
}

#[test]
fn texture_coordinates_that_are_no_numbers_are_left_out_and_counted() {
    for wrong in [f32::NAN, f32::INFINITY] {
        let mut soup = square();
        soup.texture_coordinates = vec![Vec2::new(0.5, wrong), Vec2::ONE];
        for (number, corner) in soup.corners.iter_mut().enumerate() {
            corner.texture = u32::from(number > 0);
        }
        let mesh = mesh(soup);
        assert_eq!(mesh.triangle_texture_coordinates, [[NONE, 1, 1], [NONE, 1, 1]]);
        assert_eq!(mesh.defects.to_string(), "1 corner without usable texture coordinates");
    }
}

#[test]
fn a_corner_twice_in_a_row_is_said_and_no_reason_to_refuse() {
    let corners = [[2.0, 4.0], [2.0, 2.0], [4.0, 2.0], [4.0, 0.0], [0.0, 0.0], [0.0, 4.0]];
    let positions: Vec<DVec3> = corners.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect();
    let strict = LoadOptions { strict: true, ..LoadOptions::default() };
    for (polygon, triangles) in
        [(vec![0, 1, 2, 3, 4, 5, 0], 4), (vec![0, 0, 1, 2, 2, 3, 4, 5], 4), (vec![0, 1, 2, 2], 1)]
    {
        let soup = Soup {
            positions: positions[..polygon.iter().max().map_or(0, |last| *last as usize + 1)].to_vec(),
            polygon_sizes: vec![polygon.len() as u32],
            corners: polygon.into_iter().map(Corner::at).collect(),
            ..Soup::default()
        };
        let mesh = soup.into_mesh("test", &strict).unwrap();
        assert_eq!((mesh.triangles.len(), mesh.defects.degenerate_triangles), (triangles, 0));
        assert_eq!(mesh.defects.to_string(), "1 polygon that names a corner twice in a row (harmless)");
        assert!(mesh.defects.is_empty() && mesh.defects != Defects::default());
    }
    let soup = Soup { positions, corners: [0, 1, 1].map(Corner::at).to_vec(), ..Soup::default() };
    assert!(soup.into_mesh("test", &strict).is_err(), "a triangle of two corners");
}

#[test]
fn why_nothing_is_left_is_said_and_no_other_defect() {
    let message = |soup: Soup| soup.into_mesh("a", &LoadOptions::default()).unwrap_err().to_string();
    let (mut soup, mut empty) = (square(), square());
    soup.corners.clear();
    soup.polygon_sizes.clear();
    soup.defects.missing_materials = 1;
    let sentence = "a: it holds 4 vertices but no faces; export it with its faces";
    assert_eq!(message(soup), sentence);
    empty.positions = vec![DVec3::ZERO; 4];
    empty.defects.missing_materials = 1;
    let sentence = "a: nothing is left to draw (2 degenerate triangles); export it again with faces that have area";
    assert_eq!(message(empty), sentence);
}

#[test]
fn strict_makes_a_defect_an_error_that_counts_it() {
    let mut soup = square();
    soup.positions.push(DVec3::splat(9.0));
    let error = soup.into_mesh("a.obj", &LoadOptions { strict: true, ..LoadOptions::default() }).unwrap_err();
    assert!(error.to_string().starts_with("a.obj: 1 unused vertex;"), "{error}");
}

#[test]
fn a_tiny_triangle_has_area_and_a_huge_one_too() {
    for size in [1e-160, 1e-30, 1.0, 1e30, 1e59] {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| p * size).to_vec();
        let soup = Soup { positions, corners: (0..3).map(Corner::at).collect(), ..Soup::default() };
        assert_eq!(mesh(soup).normals, [Vec3::Z; 3], "size {size}");
    }
}

#[test]
fn a_stray_vertex_does_not_weld_a_far_away_model_together() {
    let mut soup = square();
    soup.positions.iter_mut().for_each(|position| *position += DVec3::new(5e5, 4.6e6, 0.0));
    soup.positions.push(DVec3::ZERO);
    let mesh = mesh(soup);
    assert_eq!((mesh.triangles.len(), mesh.defects.unused_vertices), (2, 1));
}

#[test]
fn needles_have_unit_normals_and_coordinates_beyond_reason_are_refused() {
    let soup = |points: [DVec3; 3]| Soup {
        positions: points.to_vec(),
        corners: (0..3).map(Corner::at).collect(),
        ..Soup::default()
    };
    let needle = mesh(soup([DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-200, 0.0)]));
    assert_eq!(needle.normals, [Vec3::Z; 3]);
    let huge = soup([DVec3::ZERO, DVec3::X * 1e200, DVec3::Y]);
    let message = huge.into_mesh("huge.obj", &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.starts_with("huge.obj: its coordinates reach beyond"), "{message}");
}

#[test]
fn by_the_articles_rule_there_is_one_normal_a_vertex_whatever_the_file_says() {
    let options = LoadOptions { normals: Normals::Dachsbacher, ..LoadOptions::default() };
    let mut soup = square();
    soup.normals = vec![Vec3::X];
    soup.corners.iter_mut().for_each(|corner| corner.normal = 0);
    // A wall along one side, its two corners given again, and a face without area.
    soup.positions.extend([DVec3::ZERO, DVec3::Y, DVec3::Z]);
    soup.corners.extend([4, 5, 6, 0, 1, 1].map(Corner::at));
    soup.polygon_sizes.extend([3, 3]);
    let mesh = soup.into_mesh("test", &options).unwrap();
    assert_eq!((mesh.positions.len(), mesh.normals.len()), (5, 5));
    assert_eq!(mesh.triangle_normals, mesh.triangles);
    assert_eq!((mesh.defects.degenerate_triangles, mesh.normals[1]), (1, Vec3::Z));
    // The square is cut from the first corner: two of its triangles meet the wall's there, and one at the other.
    assert!(mesh.normals[0].distance(Vec3::new(1.0, 0.0, 2.0).normalize()) < 1e-6, "{}", mesh.normals[0]);
    assert!(mesh.normals[3].distance(Vec3::new(1.0, 0.0, 1.0).normalize()) < 1e-6, "{}", mesh.normals[3]);
}

#[test]
fn a_model_that_is_z_up_is_turned_to_stand_with_its_front_towards_z() {
    let options = LoadOptions { up_axis: UpAxis::Z, ..LoadOptions::default() };
    let mut soup = square();
    soup.normals = vec![Vec3::Z];
    soup.corners.iter_mut().for_each(|corner| corner.normal = 0);
    let mesh = soup.into_mesh("test", &options).unwrap();
    assert_eq!(mesh.normals, [Vec3::Y]);
    assert_eq!(mesh.positions[3], DVec3::NEG_Z, "the model's back, +y, is away from the front view");
}

#[test]
fn normals_that_only_repeat_the_faces_are_computed_where_creases_are_to_last() {
    // Two triangles that meet at 20 degrees, each with its own normal in the file; then with one that leans.
    let tilt = 20f64.to_radians();
    let normals = [DVec3::Z, DVec3::new(tilt.sin(), 0.0, tilt.cos())].map(|normal| normal.as_vec3());
    let shared = |normals: [Vec3; 2]| {
        let mut soup = Soup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(-tilt.cos(), 0.0, tilt.sin())],
            normals: normals.to_vec(),
            ..Soup::default()
        };
        for (normal, face) in [[0, 1, 2], [0, 2, 3]].into_iter().enumerate() {
            let corner = |position| Corner { normal: normal as u32, ..Corner::at(position) };
            soup.corners.extend(face.map(corner));
        }
        let options = LoadOptions { normals: Normals::Lasting, ..LoadOptions::default() };
        let mesh = soup.into_mesh("test", &options).unwrap();
        mesh.triangle_normals[0][0] == mesh.triangle_normals[1][0]
    };
    assert!(shared(normals), "computed, smooth at 20 degrees");
    assert!(!shared([Vec3::Z, Vec3::new(0.5, 0.0, 1.0)]), "the file's own");
}

#[test]
fn a_part_that_welding_leaves_nothing_of_is_told_from_a_sliver() {
    // A slab, and a box of this size on it.
    let slab_with = |size: DVec3, weld: f64| {
        let corner = |number: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(number >> axis & 1)));
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let of = |low: DVec3, size: DVec3| (0..8).map(move |number| low + corner(number) * size);
        let slab = of(DVec3::new(-1e6, -1.0, -1e6), DVec3::new(2e6, 1.0, 2e6));
        let positions: Vec<DVec3> = slab.chain(of(DVec3::new(10.0, 0.0, 20.0), size)).collect();
        let corners = [0, 8].into_iter().flat_map(|first| sides.map(|side| side.map(|it| Corner::at(it + first))));
        let corners = corners.flatten().collect();
        let soup = Soup { positions, corners, polygon_sizes: vec![4; 12], ..Soup::default() };
        let mesh = soup.into_mesh("slab", &LoadOptions { weld, ..LoadOptions::default() }).unwrap();
        (mesh.defects.vanished_triangles, mesh.defects.degenerate_triangles, mesh.defects.consequence().is_some())
    };
    assert_eq!(slab_with(DVec3::splat(2e-3), 1e-7), (12, 0, true));
    assert_eq!(slab_with(DVec3::splat(2e-3), 0.0), (0, 0, false));
    assert_eq!(slab_with(DVec3::new(2e-3, 2e-3, 9.0), 1e-7), (12, 0, true), "a needle becomes a line");
    assert_eq!(slab_with(DVec3::splat(9.0), 1e-7), (0, 0, false));
    // A fan with a sliver, whose corners stay where its neighbours end.
    let mut soup = square();
    soup.positions.push(DVec3::new(1.0, 1.0 + 1e-8, 0.0));
    soup.corners = [0, 1, 2, 0, 2, 4, 0, 4, 3].map(Corner::at).to_vec();
    soup.polygon_sizes = Vec::new();
    let mesh = mesh(soup);
    assert_eq!((mesh.defects.vanished_triangles, mesh.defects.degenerate_triangles), (0, 1));
    assert_eq!((mesh.triangles.len(), mesh.defects.consequence()), (2, None));
}

#[test]
fn crossing_polygons_are_counted_in_every_piece() {
    let bow = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 1.0], [1.0, 3.0]];
    const COUNT: u32 = 40_000;
    let at = |number: u32| bow.map(|[x, y]| DVec3::new(x + f64::from(number) * 3.0, y, 0.0));
    let soup = Soup {
        positions: (0..COUNT).flat_map(at).collect(),
        corners: (0..COUNT * 5).map(Corner::at).collect(),
        polygon_sizes: vec![5; COUNT as usize],
        ..Soup::default()
    };
    assert_eq!(mesh(soup).defects.crossing_polygons, COUNT as usize);
}
