//! The edge list: exact counts on solids everybody can count, agreement with slow and obvious twins and with other
//! libraries, silhouettes against rational arithmetic.

use crate::support::{public_models, skip};
use glam::DVec3;
use num_rational::BigRational;
use proptest::prelude::*;
use std::collections::BTreeMap;
use tinta::edges::{
    Class, ClassCounts, ClassSet, Classes, CreaseAngle, Eye, Incidence, NormalCones, Side, SilhouetteRule, Silhouettes,
    side_of_face,
};
use tinta::{EdgeList, LoadOptions, Mesh, load};

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { positions, triangles, normals: Vec::new(), triangle_normals: Vec::new(), ..Mesh::triangle() }
}

fn counts(mesh: &Mesh) -> (EdgeList, ClassCounts) {
    let edges = EdgeList::new(mesh);
    let classes = Classes::new(mesh, &edges, CreaseAngle::default(), ClassSet::ALL);
    let counts = classes.counts();
    (edges, counts)
}

/// A box, two triangles a side, wound outwards.
pub fn cuboid(low: DVec3, high: DVec3) -> Mesh {
    let corner = |i: u32| {
        let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
        DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    mesh((0..8).map(corner).collect(), triangles)
}

/// Meshes put together, equal positions joined.
fn joined(meshes: &[Mesh]) -> Mesh {
    let mut all = mesh(Vec::new(), Vec::new());
    for one in meshes {
        let mut number = |position: &DVec3| {
            all.positions.iter().position(|known| known == position).unwrap_or_else(|| {
                all.positions.push(*position);
                all.positions.len() - 1
            }) as u32
        };
        let numbers: Vec<u32> = one.positions.iter().map(&mut number).collect();
        all.triangles.extend(one.triangles.iter().map(|triangle| triangle.map(|corner| numbers[corner as usize])));
    }
    all
}

/// A sphere from an icosahedron, each triangle cut into four `levels` times.
pub fn icosphere(levels: u32) -> Mesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let (g, o, z) = (golden, 1.0, 0.0);
    let corners = [
        [-o, g, z],
        [o, g, z],
        [-o, -g, z],
        [o, -g, z],
        [z, -o, g],
        [z, o, g],
        [z, -o, -g],
        [z, o, -g],
        [g, z, -o],
        [g, z, o],
        [-g, z, -o],
        [-g, z, o],
    ];
    let mut positions: Vec<DVec3> = corners.iter().map(|corner| DVec3::from_array(*corner).normalize()).collect();
    let mut triangles: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..levels {
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    positions.push((positions[a as usize] + positions[b as usize]).normalize());
                    positions.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    mesh(positions, triangles)
}

/// The loops that edges form: `None` if at some position other than two of them meet.
fn loops(edges: &EdgeList, chosen: &[u32]) -> Option<usize> {
    let mut neighbours: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for edge in chosen {
        let [a, b] = edges.positions()[*edge as usize];
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    if neighbours.values().any(|ends| ends.len() != 2) {
        return None;
    }
    let mut count = 0;
    while let Some((&start, _)) = neighbours.first_key_value() {
        let mut next = Some(start);
        while let Some(at) = next {
            let ends = neighbours.remove(&at).unwrap_or_default();
            next = ends.into_iter().find(|end| neighbours.contains_key(end));
        }
        count += 1;
    }
    Some(count)
}

#[test]
fn a_box_has_twelve_creases_and_six_flat_diagonals() {
    let (edges, counts) = counts(&cuboid(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(edges.len(), 18);
    assert_eq!(counts, ClassCounts { crease: 12, ..ClassCounts::default() });
}

#[test]
fn the_boundary_edges_of_an_open_box_are_found() {
    let open_box = load("builtin:open-box", &LoadOptions::default()).unwrap().mesh;
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
fn the_silhouette_of_a_sphere_is_one_closed_loop_from_any_eye_outside() {
    let sphere = icosphere(3);
    let edges = EdgeList::new(&sphere);
    let silhouettes = Silhouettes::new(&sphere, &edges);
    let cones = NormalCones::new(&sphere, &edges, &silhouettes);
    let mut random = Random(7);
    for _ in 0..1000 {
        let eye = random.direction() * (1.001 + 5.0 * random.number().powi(3));
        for eye in [Eye::Point(eye), Eye::Direction(eye)] {
            let found = silhouettes.find(&sphere, &edges, eye, SilhouetteRule::Exact);
            assert_eq!(loops(&edges, &found), Some(1), "{eye:?}");
            assert_eq!(cones.find(&sphere, &edges, &silhouettes, eye, SilhouetteRule::Exact), found, "{eye:?}");
        }
    }
    let inside = Eye::Point(DVec3::new(0.1, 0.2, -0.3));
    assert!(silhouettes.find(&sphere, &edges, inside, SilhouetteRule::Exact).is_empty());
}

#[test]
fn the_silhouette_is_closed_even_where_faces_are_seen_exactly_edge_on() {
    let box_mesh = cuboid(DVec3::ZERO, DVec3::ONE);
    let edges = EdgeList::new(&box_mesh);
    let silhouettes = Silhouettes::new(&box_mesh, &edges);
    let find = |eye| silhouettes.find(&box_mesh, &edges, eye, SilhouetteRule::Exact);
    for direction in [DVec3::Z, DVec3::NEG_X, DVec3::Y] {
        let found = find(Eye::Direction(direction));
        assert_eq!((found.len(), loops(&edges, &found)), (4, Some(1)), "{direction}");
    }
    // In the plane of the top: of the three sides around that corner only one is seen.
    let found = find(Eye::Point(DVec3::new(3.0, 1.0, 0.5)));
    assert_eq!((found.len(), loops(&edges, &found)), (4, Some(1)));
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
    // Equal values under different numbers are no seam.
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
    let cones = NormalCones::new(&loose, &edges, &silhouettes);
    for eye in [Eye::Point(DVec3::Z), Eye::Direction(DVec3::ZERO), Eye::Point(DVec3::NAN), Eye::Point(DVec3::MAX)] {
        for (_, rule) in SilhouetteRule::ALL {
            let found = silhouettes.find(&loose, &edges, eye, rule);
            assert_eq!(cones.find(&loose, &edges, &silhouettes, eye, rule), found, "{eye:?} {rule:?}");
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

/// The listing's silhouette test of one edge, f32 as there.
fn listing_silhouette(mesh: &Mesh, faces: &[u32], view: DVec3) -> f32 {
    let along_view = |face: &u32| {
        let [a, b, c] = mesh.triangles[*face as usize].map(|corner| mesh.positions[corner as usize]);
        let normal = (b - a).cross(c - a).normalize().as_vec3();
        normal.dot(view.normalize().as_vec3())
    };
    along_view(&faces[0]) * along_view(&faces[1])
}

fn random_mesh(positions: usize, faces: usize) -> impl Strategy<Value = Mesh> {
    let position =
        prop::array::uniform3(-8i32..8).prop_map(|[x, y, z]| DVec3::new(x.into(), y.into(), z.into()) * 0.37);
    let corner = 0..positions as u32;
    let triangle =
        [corner.clone(), corner.clone(), corner].prop_filter("three corners", |[a, b, c]| a != b && b != c && c != a);
    (prop::collection::vec(position, positions), prop::collection::vec(triangle, 1..faces))
        .prop_map(|(positions, triangles)| mesh(positions, triangles))
}

fn random_eye() -> impl Strategy<Value = Eye> {
    let vector =
        prop::array::uniform3(-20i32..20).prop_map(|[x, y, z]| DVec3::new(x.into(), y.into(), z.into()) * 0.25);
    (vector, any::<bool>()).prop_map(|(vector, parallel)| match parallel {
        true => Eye::Direction(if vector == DVec3::ZERO { DVec3::Z } else { vector }),
        false => Eye::Point(vector),
    })
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

    #[test]
    fn exact_silhouettes_are_those_of_rational_arithmetic(mesh in random_mesh(30, 120), eye in random_eye()) {
        let edges = EdgeList::new(&mesh);
        let silhouettes = Silhouettes::new(&mesh, &edges);
        let found = silhouettes.find(&mesh, &edges, eye, SilhouetteRule::Exact);
        for (edge, incidence) in edges.incidence().iter().enumerate() {
            let side = |face: u32| rational_side(corners(&mesh, face), eye);
            let expected = match (incidence, edges.faces(edge as u32)) {
                (Incidence::Inner, [a, b]) => (side(*a) == Side::Front) != (side(*b) == Side::Front),
                (Incidence::InnerReversed, [a, b]) => (side(*a) == Side::Front) != (side(*b) == Side::Back),
                _ => false,
            };
            prop_assert_eq!(found.binary_search(&(edge as u32)).is_ok(), expected, "edge {}", edge);
        }
        let cones = NormalCones::new(&mesh, &edges, &silhouettes);
        prop_assert_eq!(cones.find(&mesh, &edges, &silhouettes, eye, SilhouetteRule::Exact), found);
    }

    #[test]
    fn silhouettes_by_the_papers_rule_are_the_listings(mesh in random_mesh(30, 120), eye in random_eye()) {
        let edges = EdgeList::new(&mesh);
        let silhouettes = Silhouettes::new(&mesh, &edges);
        let (Eye::Point(view) | Eye::Direction(view)) = eye;
        let view = if view == DVec3::ZERO { DVec3::Z } else { view };
        let found = silhouettes.find(&mesh, &edges, Eye::Direction(view), SilhouetteRule::Paper);
        for (edge, incidence) in edges.incidence().iter().enumerate() {
            // The normal of a face without area is rounding noise, in the listing as here.
            let has_area = |face: &u32| {
                let [a, b, c] = corners(&mesh, *face);
                (b - a).cross(c - a).length() > 1e-9
            };
            let is_inner = matches!(incidence, Incidence::Inner | Incidence::InnerReversed);
            if is_inner && edges.faces(edge as u32).iter().all(has_area) {
                let product = listing_silhouette(&mesh, edges.faces(edge as u32), view);
                // Rounding may decide within a few places of the bound.
                if (product - 1e-8).abs() > 1e-6 {
                    prop_assert_eq!(found.binary_search(&(edge as u32)).is_ok(), product <= 1e-8, "edge {}", edge);
                }
            }
        }
        let cones = NormalCones::new(&mesh, &edges, &silhouettes);
        prop_assert_eq!(cones.find(&mesh, &edges, &silhouettes, Eye::Direction(view), SilhouetteRule::Paper), found);
    }
}

fn corners(mesh: &Mesh, face: u32) -> [DVec3; 3] {
    mesh.triangles[face as usize].map(|corner| mesh.positions[corner as usize])
}

/// The side by rational numbers: no rounding anywhere.
fn rational_side([a, b, c]: [DVec3; 3], eye: Eye) -> Side {
    let exact = |vector: DVec3| vector.to_array().map(|number| BigRational::from_float(number).unwrap());
    let minus = |p: &[BigRational; 3], q: &[BigRational; 3]| [0, 1, 2].map(|i| &p[i] - &q[i]);
    let [a, b, c] = [a, b, c].map(exact);
    let (u, v) = (minus(&b, &a), minus(&c, &a));
    let towards_eye = match eye {
        Eye::Point(eye) => minus(&exact(eye), &a),
        Eye::Direction(direction) => exact(direction),
    };
    let cross = |i: usize, j: usize| &u[i] * &v[j] - &u[j] * &v[i];
    let determinant = &towards_eye[0] * cross(1, 2) + &towards_eye[1] * cross(2, 0) + &towards_eye[2] * cross(0, 1);
    match determinant.cmp(&BigRational::default()) {
        std::cmp::Ordering::Greater => Side::Front,
        std::cmp::Ordering::Less => Side::Back,
        std::cmp::Ordering::Equal => Side::Edge,
    }
}

#[test]
fn faces_seen_all_but_edge_on_are_judged_as_rational_arithmetic_does() {
    let mut random = Random(3);
    let mut sides = [0usize; 3];
    for case in 0..20_000 {
        // Every fourth lies on a grid, where what is in the plane is so exactly.
        let is_on_grid = case % 4 == 0;
        let on_grid = |vector: DVec3| if is_on_grid { (vector * 256.0).round() / 256.0 } else { vector };
        let origin = on_grid(random.direction() * [0.0, 1.0, 1e6][case % 3]);
        let [a, u, v] = [(); 3].map(|()| on_grid(random.direction()));
        let a = a + origin;
        // A needle now and then.
        let v = if case % 5 == 1 && !is_on_grid { u * 0.5 + v * 1e-9 } else { v };
        let corners = [a, a + u, a + v];
        let [s, t] = [(); 2].map(|()| random.number() * 8.0 - 4.0).map(|x| if is_on_grid { x.round() } else { x });
        // In the plane but for rounding, then moved by a few units in the last place.
        let nudged = |x: f64, steps: i64| f64::from_bits((x.to_bits() as i64 + steps) as u64);
        let steps = if is_on_grid { 0 } else { (random.number() * 5.0) as i64 - 2 };
        let nudge = |vector: DVec3| DVec3::new(nudged(vector.x, steps), vector.y, nudged(vector.z, -steps));
        for eye in [Eye::Point(nudge(a + u * s + v * t)), Eye::Direction(nudge(u * s + v * t))] {
            let expected = rational_side(corners, eye);
            assert_eq!(side_of_face(corners, eye), expected, "{corners:?} {eye:?}");
            sides[expected as usize] += 1;
            let mesh = mesh(
                corners.into_iter().chain([a + u.cross(v) * 0.3 + (u + v) * 0.2]).collect(),
                vec![[0, 1, 2], [0, 3, 1]],
            );
            let edges = EdgeList::new(&mesh);
            let found = Silhouettes::new(&mesh, &edges).find(&mesh, &edges, eye, SilhouetteRule::Exact);
            let other = rational_side([corners[0], mesh.positions[3], corners[1]], eye);
            assert_eq!(found.len() == 1, (expected == Side::Front) != (other == Side::Front), "{corners:?} {eye:?}");
        }
    }
    assert!(sides.iter().all(|count| *count > 30), "front, back and edge all occur: {sides:?}");
}

#[test]
fn counts_agree_with_other_libraries_on_public_models() {
    // By vtkFeatureEdges (VTK 9.7) and trimesh 5.2 after joining equal positions: edges, boundary, non-manifold, and
    // creases whose cosine is below 0.4.
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
    let Some(folder) = public_models() else { return };
    for (file, expected) in expected {
        let path = folder.join(file);
        if !path.is_file() {
            skip(&format!("{file}: not in {}", folder.display()));
            continue;
        }
        let mesh = load(path.to_str().unwrap(), &LoadOptions { weld: 0.0, ..LoadOptions::default() }).unwrap().mesh;
        let (edges, counts) = counts(&mesh);
        assert_eq!([edges.len(), counts.boundary, counts.non_manifold, counts.crease], expected, "{file}");
        let silhouettes = Silhouettes::new(&mesh, &edges);
        let cones = NormalCones::new(&mesh, &edges, &silhouettes);
        let (low, high) = mesh.bounds();
        let mut random = Random(11);
        for _ in 0..20 {
            let away = random.direction() * (high - low).length() * (0.4 + random.number());
            for eye in [Eye::Point((low + high) * 0.5 + away), Eye::Direction(away)] {
                for (_, rule) in SilhouetteRule::ALL {
                    let plain = silhouettes.find(&mesh, &edges, eye, rule);
                    assert_eq!(cones.find(&mesh, &edges, &silhouettes, eye, rule), plain, "{file} {eye:?} {rule:?}");
                }
            }
        }
    }
}

/// Numbers that look random and are the same every time (xorshift).
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A unit vector.
    fn direction(&mut self) -> DVec3 {
        loop {
            let vector = DVec3::new(self.number(), self.number(), self.number()) * 2.0 - DVec3::ONE;
            if (0.01..1.0).contains(&vector.length_squared()) {
                return vector.normalize();
            }
        }
    }
}
