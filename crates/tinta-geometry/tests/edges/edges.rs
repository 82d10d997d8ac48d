//! The edge list: exact counts on solids everybody can count, agreement with a slow and obvious twin and with other
//! libraries.

use crate::random::{random_eye, random_mesh};
use crate::support::shapes::{Random, cuboid, joined, loops, mesh};
use crate::support::{builtin, public_meshes_with};
use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeMap;
use tinta::edges::{Class, ClassCounts, ClassSet, Classes, CreaseAngle, Eye, Incidence, SilhouetteRule, Silhouettes};
use tinta::{EdgeList, LoadOptions, Mesh, load};

fn counts(mesh: &Mesh) -> (EdgeList, ClassCounts) {
    let edges = EdgeList::new(mesh);
    let classes = Classes::new(mesh, &edges, CreaseAngle::default(), ClassSet::ALL);
    let counts = classes.counts();
    (edges, counts)
}

#[test]
fn a_box_has_twelve_creases_and_six_flat_diagonals() {
    let (edges, counts) = counts(&cuboid(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(edges.len(), 18);
    assert_eq!(counts, ClassCounts { crease: 12, convex_crease: 12, ..ClassCounts::default() });
}

#[test]
fn of_an_angle_iron_one_long_crease_is_concave() {
    let iron = angle_iron(1.0);
    let (edges, counts) = counts(&iron);
    assert_eq!((counts.crease, counts.convex_crease, counts.concave_crease), (18, 17, 1));
    let only = ClassSet::of(&[Class::ConcaveCrease]);
    let classes = Classes::new(&iron, &edges, CreaseAngle::default(), only);
    let ends = edges.positions()[classes.marked[0] as usize].map(|end| iron.positions[end as usize].truncate());
    assert_eq!((classes.marked.len(), ends), (1, [glam::DVec2::splat(0.5); 2]));
    assert_eq!(classes.of_edges[classes.marked[0] as usize], only);
}

/// The angle iron of the test before: 17 convex creases and one that is concave.
fn angle_iron(scale: f64) -> Mesh {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let corner = |[x, y]: [f64; 2], z: f64| (DVec3::new(x, y, z) - DVec3::new(0.5, 0.5, 1.5)) * scale;
    let positions = [0.0, 3.0].into_iter().flat_map(|z| outline.map(|of| corner(of, z))).collect();
    let mut corners = vec![5, 4, 3, 2, 1, 0, 6, 7, 8, 9, 10, 11];
    (0..6).for_each(|side: u32| corners.extend([side, (side + 1) % 6, (side + 1) % 6 + 6, side + 6]));
    Mesh::of_polygons("iron", positions, &corners, vec![6, 6, 4, 4, 4, 4, 4, 4], &LoadOptions::default()).unwrap()
}

/// The convex and the concave creases.
fn turns(mesh: &Mesh) -> (usize, usize) {
    let (_, counts) = counts(mesh);
    (counts.convex_crease, counts.concave_crease)
}

/// A mesh with some of its faces turned round.
fn turned(mesh: &Mesh, is_turned: impl Fn(usize) -> bool) -> Mesh {
    let turn = |(face, [a, b, c]): (usize, &[u32; 3])| if is_turned(face) { [*a, *c, *b] } else { [*a, *b, *c] };
    Mesh { triangles: mesh.triangles.iter().enumerate().map(turn).collect(), ..mesh.clone() }
}

#[test]
fn which_creases_are_convex_follows_from_the_outside_and_not_from_the_winding() {
    let (iron, mut random) = (angle_iron(1.0), Random(5));
    assert_eq!(turns(&iron), (17, 1));
    assert_eq!(turns(&turned(&iron, |_| true)), (17, 1), "inside out");
    for face in 0..iron.triangles.len() {
        assert_eq!(turns(&turned(&iron, |other| other == face)), (17, 1), "face {face} turned");
    }
    for round in 0..20 {
        let which: Vec<bool> = iron.triangles.iter().map(|_| random.number() < 0.5).collect();
        assert_eq!(turns(&turned(&iron, |face| which[face])), (17, 1), "round {round}");
    }
    // A hollow of the same shape: a convex outside is a concave inside, whichever way either is wound.
    for (outer, inner) in [(false, false), (false, true), (true, false), (true, true)] {
        let hollow = joined(&[turned(&iron, |_| outer), turned(&angle_iron(0.1), |_| inner)]);
        assert_eq!(turns(&hollow), (18, 18), "{outer} {inner}");
    }
}

#[test]
fn an_open_shells_creases_are_convex_as_it_is_wound() {
    let open_box = builtin("open-box");
    let (convex, concave) = turns(&open_box);
    assert_eq!((convex + concave, convex.min(concave)), (8, 0));
    assert_eq!(turns(&turned(&open_box, |_| true)), (concave, convex));
}

#[test]
fn the_boundary_edges_of_an_open_box_are_found() {
    let open_box = builtin("open-box");
    let (edges, counts) = counts(&open_box);
    // 8 corners - edges + 10 triangles = 1, the Euler characteristic of a disc.
    assert_eq!(edges.len(), 17);
    assert_eq!((counts.boundary, counts.crease, counts.non_manifold), (4, 8, 0));
}

#[test]
fn a_moebius_strip_has_one_boundary_and_one_edge_where_its_faces_disagree() {
    let turns = 24u32;
    let rim = |i: u32, side: f64| {
        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(turns);
        let radius = 2.0 + side * 0.5 * (angle * 0.5).cos();
        DVec3::new(radius * angle.cos(), radius * angle.sin(), side * 0.5 * (angle * 0.5).sin())
    };
    let positions = (0..turns).flat_map(|i| [rim(i, -1.0), rim(i, 1.0)]).collect();
    let triangles = (0..turns).flat_map(|i| {
        let (a, b) = (2 * i, 2 * i + 1);
        // After a whole turn the sides have changed places.
        let (c, d) = if i + 1 < turns { (a + 2, b + 2) } else { (1, 0) };
        [[a, c, b], [b, c, d]]
    });
    let strip = mesh(positions, triangles.collect());
    let (edges, counts) = counts(&strip);
    assert_eq!(edges.len() as u32, 4 * turns);
    assert_eq!(edges.reversed_edges(), 1);
    let expected = ClassCounts { boundary: 2 * turns as usize, ..ClassCounts::default() };
    assert_eq!(counts, expected, "the edge where the faces disagree is no crease: the strip is smooth there");
    let boundary: Vec<u32> =
        (0..edges.len() as u32).filter(|edge| edges.incidence()[*edge as usize] == Incidence::Boundary).collect();
    assert_eq!(loops(&edges, &boundary), Some(1));
}

#[test]
fn three_faces_on_one_edge_are_all_kept() {
    let positions = vec![DVec3::ZERO, DVec3::Z, DVec3::X, DVec3::Y, DVec3::NEG_X];
    let book = mesh(positions, vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]]);
    let (edges, counts) = counts(&book);
    assert_eq!((edges.len(), counts.non_manifold, counts.boundary), (7, 1, 6));
    let spine = edges.positions().iter().position(|positions| *positions == [0, 1]).unwrap() as u32;
    assert_eq!(edges.faces(spine), [0, 1, 2]);
    assert_eq!(edges.faces(99), [0u32; 0], "there is no such edge");
}

#[test]
fn two_boxes_sharing_an_edge_share_one_edge_of_four_faces() {
    let boxes = [cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, 2.0, 1.0))];
    let (edges, counts) = counts(&joined(&boxes));
    assert_eq!(edges.len(), 18 + 18 - 1);
    assert_eq!((counts.non_manifold, counts.crease, counts.boundary), (1, 22, 0));
    let shared = edges.incidence().iter().position(|incidence| *incidence == Incidence::NonManifold).unwrap();
    assert_eq!(edges.faces(shared as u32).len(), 4);
}

#[test]
fn a_strip_of_coplanar_quads_has_a_rim_and_no_lines_within() {
    let quads = 30u32;
    let positions = (0..=quads).flat_map(|i| [DVec3::X * f64::from(i), DVec3::X * f64::from(i) + DVec3::Y]).collect();
    let triangles = (0..quads).map(|i| 2 * i).flat_map(|a| [[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]).collect();
    let strip = mesh(positions, triangles);
    let (edges, counts) = counts(&strip);
    assert_eq!(edges.len() as u32, 4 * quads + 1);
    assert_eq!(counts, ClassCounts { boundary: 2 * quads as usize + 2, ..ClassCounts::default() });
    let silhouettes = Silhouettes::new(&strip, &edges);
    for eye in [DVec3::new(3.0, 0.5, 2.0), DVec3::new(3.0, 0.5, -2.0), DVec3::new(-5.0, 0.5, 0.0)] {
        assert_eq!(silhouettes.find(&strip, &edges, Eye::Point(eye), SilhouetteRule::Exact), [0u32; 0], "{eye}");
    }
}

#[test]
fn inner_edges_between_materials_texture_coordinates_and_normals_are_seams() {
    let mut quad = mesh(vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y], vec![[0, 1, 2], [0, 2, 3]]);
    quad.triangle_materials = vec![0, 1];
    quad.texture_coordinates = vec![glam::Vec2::ZERO, glam::Vec2::X, glam::Vec2::ONE, glam::Vec2::Y, glam::Vec2::ZERO];
    quad.triangle_texture_coordinates = vec![[0, 1, 2], [4, 2, 3]];
    quad.normals = vec![glam::Vec3::Z, glam::Vec3::X];
    quad.triangle_normals = vec![[0, 0, 0], [0, 1, 0]];
    let counts_of = |quad: &Mesh| counts(quad).1;
    // Equal values under different numbers form no seam.
    let expected = ClassCounts { boundary: 4, material: 1, normal: 1, ..ClassCounts::default() };
    assert_eq!(counts_of(&quad), expected);
    quad.texture_coordinates[4] = glam::Vec2::new(0.5, 0.0);
    assert_eq!(counts_of(&quad), ClassCounts { texture: 1, ..expected });
    let only = Classes::new(&quad, &EdgeList::new(&quad), CreaseAngle::default(), ClassSet::of(&[Class::Texture]));
    assert_eq!(only.counts(), ClassCounts { texture: 1, ..ClassCounts::default() });
}

#[test]
fn a_hub_of_many_edges_is_matched_as_a_small_one_is() {
    let spokes = 100_000u32;
    let rim = (0..spokes).map(|i| {
        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(spokes);
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    });
    let positions: Vec<DVec3> = [DVec3::Z].into_iter().chain(rim).collect();
    let wheel = mesh(positions, (0..spokes).map(|i| [0, 1 + i, 1 + (i + 1) % spokes]).collect());
    let (edges, counts) = counts(&wheel);
    assert_eq!(edges.len() as u32, 2 * spokes);
    assert_eq!((counts.boundary as u32, counts.non_manifold), (spokes, 0));
}

#[test]
fn loose_and_degenerate_faces_have_no_edges_and_never_panic() {
    let mut loose = mesh(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X * 2.0, DVec3::NAN], Vec::new());
    assert!(EdgeList::new(&loose).is_empty());
    // Twice one corner, out of range, without area, not a number.
    loose.triangles = vec![[0, 0, 1], [0, 1, 9], [0, 1, 3], [0, 1, 4], [0, 1, 2]];
    let (edges, counts) = counts(&loose);
    assert_eq!(edges.degenerate_faces(), 2);
    assert_eq!((counts.non_manifold, counts.crease), (1, 0));
    let silhouettes = Silhouettes::new(&loose, &edges);
    for eye in [Eye::Point(DVec3::Z), Eye::Direction(DVec3::ZERO), Eye::Point(DVec3::NAN), Eye::Point(DVec3::MAX)] {
        for (_, rule) in SilhouetteRule::ALL {
            silhouettes.find(&loose, &edges, eye, rule);
        }
    }
    assert!(CreaseAngle::from_degrees(f64::NAN).is_err() && CreaseAngle::from_degrees(181.0).is_err());
    assert!((CreaseAngle::default().degrees() - 66.42).abs() < 0.01);
}

/// The listing's edge list, by linear search: positions, number of faces, its first two faces.
fn listing(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], (usize, Vec<u32>)> {
    let mut list: Vec<([u32; 2], Vec<u32>)> = Vec::new();
    for (face, [a, b, c]) in triangles.iter().enumerate() {
        for (from, to) in [(a, b), (a, c), (b, c)] {
            let key = [*from.min(to), *from.max(to)];
            match list.iter_mut().find(|(known, _)| *known == key) {
                Some((_, faces)) => faces.push(face as u32),
                None => list.push((key, vec![face as u32])),
            }
        }
    }
    list.into_iter().map(|(key, faces)| (key, (faces.len(), faces))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_list_is_the_listings_on_any_triangles(mesh in random_mesh(9, 60)) {
        let edges = EdgeList::new(&mesh);
        let expected = listing(&mesh.triangles);
        prop_assert_eq!(edges.len(), expected.len());
        for (edge, positions) in edges.positions().iter().enumerate() {
            let (count, faces) = &expected[positions];
            prop_assert_eq!(edges.faces(edge as u32), &faces[..]);
            prop_assert_eq!(edges.incidence()[edge] == Incidence::Boundary, *count == 1);
            prop_assert_eq!(edges.incidence()[edge] == Incidence::NonManifold, *count > 2);
        }
    }

    #[test]
    fn the_number_of_threads_changes_nothing(mesh in random_mesh(40, 90), eye in random_eye()) {
        let one = EdgeList::with_threads(&mesh, 1);
        let classes = Classes::with_threads(&mesh, &one, CreaseAngle::default(), ClassSet::ALL, 1);
        let silhouettes = Silhouettes::new(&mesh, &one);
        for threads in [2, 3, 7] {
            prop_assert_eq!(&EdgeList::with_threads(&mesh, threads), &one);
            let other = Classes::with_threads(&mesh, &one, CreaseAngle::default(), ClassSet::ALL, threads);
            prop_assert_eq!(&other, &classes);
            for (_, rule) in SilhouetteRule::ALL {
                let found = [1, threads].map(|threads| silhouettes.find_with_threads(&mesh, &one, eye, rule, threads));
                prop_assert_eq!(&found[0], &found[1]);
            }
        }
    }
}

#[test]
fn counts_agree_with_other_libraries_on_public_models() {
    // By vtkFeatureEdges (VTK 9.7) and trimesh 5.2 after joining equal positions: edges, boundary, non-manifold, and creases with
    // a cosine below 0.4.
    let expected = [
        ("ant.ply", [1368, 0, 0, 299]),
        ("beethoven.obj", [31_326, 0, 0, 174]),
        ("cow.obj", [8706, 0, 0, 204]),
        ("fandisk.obj", [19_419, 0, 0, 696]),
        ("spot/spot_triangulated.obj", [8784, 0, 0, 4]),
        ("stanford-bunny.obj", [104_288, 223, 0, 68]),
        ("suzanne.obj", [1472, 42, 1, 217]),
        ("teapot.obj", [9560, 160, 0, 4]),
    ];
    let options = LoadOptions { weld: 0.0, ..LoadOptions::default() };
    let meshes = public_meshes_with(&expected.map(|(file, _)| file), &options);
    for (file, mesh) in meshes {
        let (_, expected) = expected.into_iter().find(|(name, _)| *name == file).unwrap();
        let (edges, counts) = counts(&mesh);
        assert_eq!([edges.len(), counts.boundary, counts.non_manifold, counts.crease], expected, "{file}");
    }
}

#[test]
fn unused_vertices_do_not_keep_the_others_from_being_welded() {
    let jitter = |i: usize| (i % 3) as f64 * 1e-9;
    let cube = cuboid(DVec3::ZERO, DVec3::ONE);
    let mut text = String::new();
    for (i, corner) in cube.triangles.iter().flatten().enumerate() {
        let DVec3 { x, y, z } = cube.positions[*corner as usize] + DVec3::splat(jitter(i));
        text.push_str(&format!("v {x} {y} {z}\n"));
    }
    text.push_str("v 0.5 0.5 0.5\n");
    (0..12).for_each(|i| text.push_str(&format!("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3)));
    let file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
    std::fs::write(file.path(), text).unwrap();
    let mesh = load(file.path().to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
    assert_eq!((mesh.positions.len(), mesh.defects.unused_vertices), (8, 1));
    assert_eq!(EdgeList::new(&mesh).len(), 18);
}

#[test]
fn non_manifold_edges_around_a_hub_are_matched_in_linear_time_and_in_order() {
    // Each spoke has four faces, and the hub more edges than are searched one by one.
    let spokes = 3000u32;
    let positions =
        (0..spokes * 4 + 1).map(|i| DVec3::new(f64::from(i % 97), f64::from(i % 89), f64::from(i))).collect();
    let triangles: Vec<[u32; 3]> = (0..4)
        .flat_map(|side| (0..spokes).map(move |spoke| [0, 1 + spoke, 1 + spokes + (spoke * 4 + side) % (spokes * 3)]))
        .collect();
    let expected = listing(&triangles[..]);
    let fan = mesh(positions, triangles);
    for threads in [1, 2, 5] {
        let edges = EdgeList::with_threads(&fan, threads);
        assert_eq!(edges.len(), expected.len());
        for (edge, positions) in edges.positions().iter().enumerate() {
            assert_eq!(edges.faces(edge as u32), &expected[positions].1[..]);
        }
    }
}

#[test]
fn a_crease_angle_of_zero_makes_no_creases_of_flat_surfaces() {
    let sheet = builtin("gear");
    let edges = EdgeList::new(&sheet);
    let creases = |degrees: f64| {
        let angle = CreaseAngle::from_degrees(degrees).unwrap();
        Classes::new(&sheet, &edges, angle, ClassSet::of(&[Class::Crease])).counts().crease
    };
    assert_eq!(creases(0.0), creases(0.01));
}
