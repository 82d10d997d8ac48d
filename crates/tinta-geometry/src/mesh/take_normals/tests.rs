//! Which normals meshes take, on cubes with averaged normals and on sheets written twice.

use super::*;
use crate::mesh::Defects;
use crate::mesh::soup::{Corner, Soup};
use proptest::prelude::*;

/// A cube's corners by the bits of x, y and z, and its sides, counter-clockwise from outside.
const SIDES: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn corner(number: u32) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| f64::from(number >> axis & 1) * 2.0 - 1.0))
}

/// A cube whose first sides, so many, have averaged normals at their corners; the others have their own.
fn cube(averaged: usize) -> Soup {
    let mut soup = Soup { positions: (0..8).map(corner).collect(), ..Soup::default() };
    soup.normals = (0..8).map(|number| corner(number).as_vec3()).collect();
    for (side, corners) in SIDES.into_iter().enumerate() {
        let own = corners.map(corner).iter().sum::<DVec3>();
        soup.normals.push(own.as_vec3());
        let normal = |position| if side < averaged { position } else { 8 + side as u32 };
        soup.corners.extend(corners.map(|position| Corner { normal: normal(position), ..Corner::at(position) }));
        soup.polygon_sizes.push(4);
    }
    soup
}

/// The mesh of a soup with these normals, and the remarks.
fn made(soup: Soup, normals: Normals) -> (Mesh, Vec<String>) {
    let options = LoadOptions { normals, ..LoadOptions::default() };
    let mut remarks = Vec::new();
    let mesh = soup.into_mesh_watched("cube.obj", &options, &mut remarks, &|_| {}).unwrap();
    (mesh, remarks)
}

/// The normal at each corner of each triangle.
fn normals_of(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    mesh.triangle_normals.iter().map(|corners| corners.map(|normal| mesh.normals[normal as usize])).collect()
}

#[test]
fn normals_averaged_over_sharp_edges_are_taken_only_where_they_are_asked_for() {
    let (smooth, _) = made(cube(6), Normals::Smooth);
    for checked in [Normals::Checked, Normals::Lasting] {
        let (mesh, remarks) = made(cube(6), checked);
        assert_eq!(normals_of(&mesh), normals_of(&smooth));
        assert!(mesh.defects == Defects::default() && remarks.len() == 1, "{remarks:?}");
        assert!(
            remarks[0].starts_with("cube.obj: 36 of the file's 36 normals") && remarks[0].contains("--normals file")
        );
    }
    let (file, remarks) = made(cube(6), Normals::File);
    assert!(normals_of(&file).iter().flatten().all(|normal| normal.abs().min_element() > 0.5) && remarks.is_empty());
    assert_eq!(file.defects, Defects { averaged_normals: 36, ..Defects::default() });
    assert!(file.defects.is_empty(), "the file may mean it");
}

#[test]
fn a_few_averaged_normals_are_believed_and_so_are_those_of_faces_that_run_the_wrong_way() {
    // A sixth of the corners is too many; of eleven sides one is not.
    let with_more = |sides: usize| {
        let mut soup = cube(1);
        for _ in 0..sides {
            let first = soup.positions.len() as u32;
            soup.positions.extend([0, 2, 3, 1].map(|number| corner(number) + DVec3::Z * (3.0 + f64::from(first))));
            soup.corners.extend((first..first + 4).map(|position| Corner { normal: 8, ..Corner::at(position) }));
            soup.polygon_sizes.push(4);
        }
        made(soup, Normals::Checked).1.len()
    };
    assert_eq!([with_more(0), with_more(4), with_more(5)], [1, 0, 0], "at a tenth they are still believed");
    let mut turned = cube(0);
    turned.corners.reverse();
    let (mesh, remarks) = made(turned, Normals::Checked);
    assert!(remarks.is_empty());
    let [a, b, c] = mesh.triangles[0].map(|position| mesh.positions[position as usize]);
    assert!((b - a).cross(c - a).dot(normals_of(&mesh)[0][0].as_dvec3()) < 0.0, "the file's, not the faces'");
}

/// A puck: the outer half of a torus, of radii 2 and 0.3, with its own normals, between two flat fans whose normals lean 50 degrees
/// outwards.
fn puck(rings: u32) -> Soup {
    const COLUMNS: u32 = 20;
    let around =
        |column: u32| DVec3::X.rotate_axis(DVec3::Z, f64::from(column) / f64::from(COLUMNS) * std::f64::consts::TAU);
    let mut soup = Soup::default();
    for ring in 0..=rings {
        let (up, out) = ((f64::from(ring) / f64::from(rings) - 0.5) * std::f64::consts::PI).sin_cos();
        for column in 0..COLUMNS {
            let normal = around(column) * out + DVec3::Z * up;
            soup.positions.push(around(column) * 2.0 + normal * 0.3);
            soup.normals.push(normal.as_vec3());
        }
    }
    let add = |soup: &mut Soup, face: &[u32], first_normal: u32| {
        soup.corners.extend(face.iter().map(|at| Corner { normal: first_normal.wrapping_add(*at), ..Corner::at(*at) }));
        soup.polygon_sizes.push(face.len() as u32);
    };
    for place in 0..rings * COLUMNS {
        let next = if place % COLUMNS + 1 < COLUMNS { place + 1 } else { place + 1 - COLUMNS };
        add(&mut soup, &[place, next, next + COLUMNS, place + COLUMNS], 0);
    }
    for (end, up) in [(0, -1.0), (rings * COLUMNS, 1.0)] {
        let mut cap: Vec<u32> = (end..end + COLUMNS).collect();
        if end == 0 {
            cap.reverse();
        }
        let first = soup.normals.len() as u32;
        let (sine, cosine) = 50f64.to_radians().sin_cos();
        soup.normals.extend((0..COLUMNS).map(|column| (around(column) * sine + DVec3::Z * up * cosine).as_vec3()));
        add(&mut soup, &cap, first.wrapping_sub(end));
    }
    soup
}

#[test]
fn few_averaged_normals_on_much_of_the_surface_are_not_believed() {
    for (rings, of_all) in [(9, 1188), (8, 1068)] {
        let (mesh, remarks) = made(puck(rings), Normals::Checked);
        let sentence = format!("cube.obj: 108 of the file's {of_all} normals");
        assert!(remarks.len() == 1 && remarks[0].starts_with(&sentence), "{remarks:?}");
        assert_eq!(normals_of(&mesh), normals_of(&made(puck(rings), Normals::Smooth).0));
    }
}

#[test]
fn sides_that_share_the_fronts_normals_get_their_own_unless_the_files_are_asked_for() {
    let both = || {
        let mut soup = cube(0);
        soup.corners.extend(soup.corners.clone().into_iter().rev());
        soup.polygon_sizes.extend([4; 6]);
        soup
    };
    let leans = |normals| {
        let (mesh, remarks) = made(both(), normals);
        assert!(remarks.is_empty() && mesh.defects.doubled_triangles == 12);
        let is_inward = |(triangle, normals): (&[u32; 3], [Vec3; 3])| {
            let [a, b, c] = triangle.map(|position| mesh.positions[position as usize]);
            normals.iter().all(|normal| (b - a).cross(c - a).dot(normal.as_dvec3()) < 0.0)
        };
        mesh.triangles.iter().zip(normals_of(&mesh)).filter(|it| is_inward(*it)).count()
    };
    assert_eq!([leans(Normals::File), leans(Normals::Checked), leans(Normals::Smooth)], [12, 0, 0]);
}

/// A hilly sheet of quads over a grid, the faces of its front; some are missing, some are triangles. Holes lie apart from each
/// other: sides that meet in a corner alone may be either's fronts.
fn sheet(heights: &[f64], missing: u64) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    const COLUMNS: u32 = 6;
    let at = |place: u32| DVec3::new(f64::from(place % COLUMNS), heights[place as usize], -f64::from(place / COLUMNS));
    let positions = (0..heights.len() as u32).map(at).collect();
    let places = (0..heights.len() as u32 - COLUMNS).filter(|place| place % COLUMNS + 1 < COLUMNS);
    let may_be_hole = |place: u32| (place % COLUMNS).is_multiple_of(2) && (place / COLUMNS).is_multiple_of(2);
    let is_hole = |place: &u32| missing >> (place * 2) & 3 == 0 && may_be_hole(*place);
    let faces = places.filter(|place| !is_hole(place)).flat_map(|place| {
        let [a, b, c, d] = [place, place + 1, place + COLUMNS + 1, place + COLUMNS];
        if missing >> (place * 2) & 3 == 1 { vec![vec![a, b, c], vec![a, c, d]] } else { vec![vec![a, b, c, d]] }
    });
    (positions, faces.collect())
}

fn mesh_of(positions: &[DVec3], faces: &[Vec<u32>], normals: Normals) -> Mesh {
    let options = LoadOptions { normals, smooth_angle_degrees: 34.0, ..LoadOptions::default() };
    let sizes = faces.iter().map(|face| face.len() as u32).collect();
    Mesh::of_polygons("sheet", positions.to_vec(), &faces.concat(), sizes, &options).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn each_side_of_a_sheet_has_the_normals_that_it_has_alone(
        heights in prop::collection::vec(-0.6f64..0.6, 30), missing: u64, order: u64, turns: u64
    ) {
        let (positions, faces) = sheet(&heights, missing | 2);
        let mut both = Vec::new();
        for (number, face) in faces.iter().enumerate() {
            let mut back = face.clone();
            back.reverse();
            // From the same first corner, so that both are cut along the same diagonal if the back comes first.
            back.rotate_right(1);
            let mut sides = [face.clone(), back];
            if order >> (number % 64) & 1 == 1 {
                sides.reverse();
            }
            let len = face.len();
            sides[1].rotate_left((turns >> (number % 32) & 3) as usize % len);
            both.extend(sides);
        }
        for normals in [Normals::File, Normals::Lasting] {
            let alone = mesh_of(&positions, &faces, normals);
            let mesh = mesh_of(&positions, &both, normals);
            prop_assert_eq!((mesh.triangles.len(), mesh.defects.doubled_triangles), (alone.triangles.len() * 2, alone.triangles.len()));
            prop_assert!(!mesh.defects.is_empty());
            let mut expected: HashMap<[u32; 3], [Vec3; 3]> = HashMap::new();
            for (triangle, normals) in alone.triangles.iter().zip(normals_of(&alone)) {
                let ([a, b, c], [x, y, z]) = (*triangle, normals);
                expected.extend([([a, b, c], [x, y, z]), ([b, c, a], [y, z, x]), ([c, a, b], [z, x, y])]);
                expected.extend([([c, b, a], [-z, -y, -x]), ([b, a, c], [-y, -x, -z]), ([a, c, b], [-x, -z, -y])]);
            }
            for (triangle, normals) in mesh.triangles.iter().zip(normals_of(&mesh)) {
                let farthest = expected[triangle].iter().zip(normals).map(|(a, b)| a.distance(b)).fold(0.0, f32::max);
                prop_assert!(farthest < 1e-6, "{triangle:?}: {normals:?} for {:?}", expected[triangle]);
            }
        }
    }

    #[test]
    fn what_a_reader_leaves_out_does_not_change_the_mesh(
        heights in prop::collection::vec(-0.6f64..0.6, 30), missing: u64, extra in prop::collection::vec(any::<(u8, u8)>(), 1..12)
    ) {
        let (positions, faces) = sheet(&heights, missing | 2);
        let (mut more_positions, mut more) = (positions.clone(), faces.clone());
        more_positions.push(DVec3::splat(0.5));
        for (what, which) in extra {
            let which = usize::from(which) % faces.len();
            let mut face = faces[which].clone();
            let count = face.len();
            match what % 4 {
                // Polygons that come again are not those that name a corner twice.
                0 if which % 2 == 0 => continue,
                2 if which % 2 == 1 => continue,
                // Again, from another corner.
                0 => face.rotate_left(usize::from(what) % count),
                // No area.
                1 => face = vec![face[0], face[1], face[0]],
                // A corner named twice in a row.
                2 => face.push(face[0]),
                _ => continue,
            }
            if what % 4 == 2 {
                more[which] = face;
            } else {
                more.push(face);
            }
        }
        for normals in [Normals::File, Normals::Lasting] {
            let (clean, mesh) = (mesh_of(&positions, &faces, normals), mesh_of(&more_positions, &more, normals));
            prop_assert_eq!(mesh.defects.consequence(), None);
            prop_assert_eq!(&mesh.triangles, &clean.triangles);
            prop_assert_eq!((&mesh.positions, normals_of(&mesh)), (&clean.positions, normals_of(&clean)));
        }
    }
}
