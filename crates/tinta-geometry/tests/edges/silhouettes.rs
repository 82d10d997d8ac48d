//! Silhouettes: closed loops on closed solids, rational arithmetic, the listing's rule.

use crate::random::{random_eye, random_mesh};
use crate::support::shapes::{Random, cuboid, icosphere, loops, mesh};
use glam::DVec3;
use num_rational::BigRational;
use proptest::prelude::*;
use tinta::edges::{Eye, Incidence, Side, SilhouetteRule, Silhouettes, side_of_face};
use tinta::{EdgeList, Mesh};

#[test]
fn the_silhouette_of_a_sphere_is_one_closed_loop_from_any_eye_outside() {
    let sphere = icosphere(3);
    let edges = EdgeList::new(&sphere);
    let silhouettes = Silhouettes::new(&sphere, &edges);
    let mut random = Random(7);
    for _ in 0..1000 {
        let eye = random.direction() * (1.001 + 5.0 * random.number().powi(3));
        for eye in [Eye::Point(eye), Eye::Direction(eye)] {
            let found = silhouettes.find(&sphere, &edges, eye, SilhouetteRule::Exact);
            assert_eq!(loops(&edges, &found), Some(1), "{eye:?}");
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
    // In the plane of the top: of the three sides around that corner only one is visible.
    let found = find(Eye::Point(DVec3::new(3.0, 1.0, 0.5)));
    assert_eq!((found.len(), loops(&edges, &found)), (4, Some(1)));
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

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
    }

    #[test]
    fn silhouettes_by_the_papers_rule_are_the_listings(mesh in random_mesh(30, 120), eye in random_eye()) {
        let edges = EdgeList::new(&mesh);
        let silhouettes = Silhouettes::new(&mesh, &edges);
        let (Eye::Point(view) | Eye::Direction(view)) = eye;
        let view = if view == DVec3::ZERO { DVec3::Z } else { view };
        let found = silhouettes.find(&mesh, &edges, Eye::Direction(view), SilhouetteRule::Published);
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

fn check_edge_on(cases: usize, least_of_each: usize) {
    let mut random = Random(3);
    let mut sides = [0usize; 3];
    for case in 0..cases {
        // Every fourth lies on a grid, where points in the plane are exactly in it.
        let is_on_grid = case % 4 == 0;
        let on_grid = |vector: DVec3| if is_on_grid { (vector * 256.0).round() / 256.0 } else { vector };
        let origin = on_grid(random.direction() * [0.0, 1.0, 1e6][case % 3]);
        let [a, u, v] = [(); 3].map(|()| on_grid(random.direction()));
        let a = a + origin;
        // A needle now and then.
        let v = if case % 5 == 1 && !is_on_grid { u * 0.5 + v * 1e-9 } else { v };
        let corners = [a, a + u, a + v];
        let [s, t] = [(); 2].map(|()| random.number() * 8.0 - 4.0).map(|x| if is_on_grid { x.round() } else { x });
        // In the plane up to rounding, then moved by a few units in the last place.
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
    assert!(sides.iter().all(|count| *count > least_of_each), "front, back and edge all occur: {sides:?}");
}

#[test]
fn a_thousand_faces_seen_all_but_edge_on_are_judged_as_rational_arithmetic_does_briefly() {
    check_edge_on(1000, 2);
}

#[test]
#[ignore = "exhaustive: 20,000 faces in rational arithmetic"]
fn faces_seen_all_but_edge_on_are_judged_as_rational_arithmetic_does() {
    check_edge_on(20_000, 30);
}

/// A bowl, or a dome seen from inside out: rings of a sphere's cap up to this angle from its pole, in degrees.
fn cap(degrees: f64, rings: u32) -> Mesh {
    let sides = 24;
    let point = |ring: u32, side: u32| {
        let (polar, around) = (
            degrees.to_radians() * f64::from(ring) / f64::from(rings),
            f64::from(side) / f64::from(sides) * std::f64::consts::TAU,
        );
        DVec3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos())
    };
    let positions = [DVec3::Z].into_iter().chain((1..=rings).flat_map(|r| (0..sides).map(move |s| point(r, s))));
    let number = |ring: u32, side: u32| if ring == 0 { 0 } else { 1 + (ring - 1) * sides + side % sides };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for side in 0..sides {
            let (a, b) = (number(ring, side), number(ring, side + 1));
            let (c, d) = (number(ring + 1, side), number(ring + 1, side + 1));
            triangles.push([a, c, d]);
            if ring > 0 {
                triangles.push([a, d, b]);
            }
        }
    }
    mesh(positions.collect(), triangles)
}

/// The silhouette edges of a mesh wound one way, each face's side computed separately.
fn by_sides(mesh: &Mesh, edges: &EdgeList, eye: Eye) -> Vec<u32> {
    let is_front = |face: &u32| side_of_face(corners(mesh, *face), eye) == Side::Front;
    let is_silhouette = |edge: &u32| match edges.faces(*edge) {
        [first, second] => is_front(first) != is_front(second),
        _ => false,
    };
    (0..edges.len() as u32).filter(is_silhouette).collect()
}

fn check_close_eyes(cases: usize) {
    let mut random = Random(5);
    let mut silhouettes_found = 0;
    for degrees in [5.0, 30.0, 60.0, 80.0, 89.0, 120.0] {
        for rings in [1, 2, 5] {
            let cap = cap(degrees, rings);
            let edges = EdgeList::new(&cap);
            let silhouettes = Silhouettes::new(&cap, &edges);
            for case in 0..cases {
                let face = cap.triangles[case % cap.triangles.len()].map(|corner| cap.positions[corner as usize]);
                let normal = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
                let away = [1e-6, 1e-4, 1e-2, 0.1, 1.0][case % 5] * if case % 2 == 0 { 1.0 } else { -1.0 };
                let near = (face[0] + face[1] + face[2]) / 3.0 + normal * away + random.direction() * away * 0.5;
                let across = normal.any_orthonormal_vector() + normal * away + random.direction() * 1e-3;
                for eye in [Eye::Point(near), Eye::Point(DVec3::Z * (1.0 + away)), Eye::Direction(across)] {
                    let found = silhouettes.find(&cap, &edges, eye, SilhouetteRule::Exact);
                    assert_eq!(found, by_sides(&cap, &edges, eye), "{degrees} degrees, {rings} rings, {eye:?}");
                    silhouettes_found += found.len();
                }
            }
        }
    }
    assert!(silhouettes_found > 25 * cases, "{silhouettes_found}");
}

#[test]
fn silhouettes_from_a_few_eyes_close_to_a_surface_are_those_of_its_faces_sides_briefly() {
    check_close_eyes(40);
}

#[test]
#[ignore = "exhaustive: 21,600 eyes"]
fn every_silhouette_from_eyes_close_to_a_surface_is_that_of_its_faces_sides() {
    check_close_eyes(400);
}

#[test]
fn the_papers_rule_takes_edges_between_faces_that_are_both_edge_on_and_the_exact_one_does_not() {
    // Errata D4: two faces whose normals' components along the view have the same sign and this product.
    let roof = |first: f64, second: f64| {
        let (left, right) = (first.asin(), second.asin());
        mesh(
            vec![
                DVec3::ZERO,
                DVec3::Y,
                DVec3::new(-left.sin(), 0.5, left.cos()),
                DVec3::new(-right.sin(), 0.5, -right.cos()),
            ],
            vec![[0, 1, 2], [1, 0, 3]],
        )
    };
    let found = |mesh: &Mesh, rule| {
        let edges = EdgeList::new(mesh);
        Silhouettes::new(mesh, &edges).find(mesh, &edges, Eye::Direction(DVec3::Z), rule).len()
    };
    for (first, second, paper) in [(5e-5, 1e-4, 1), (2e-4, 4e-5, 1), (2e-4, 1e-4, 0), (0.5, 1e-9, 1), (0.5, 1e-7, 0)] {
        let roof = roof(first, -second);
        let dots = roof.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|corner| roof.positions[corner as usize]);
            (b - a).cross(c - a).normalize().z
        });
        let product: f64 = dots.product();
        assert!((product - first * second).abs() < 1e-3 * first * second, "{product:e}");
        assert_eq!(found(&roof, SilhouetteRule::Published), paper, "{first} {second}");
        assert_eq!(found(&roof, SilhouetteRule::Exact), 0, "{first} {second}");
    }
}

#[test]
fn a_thin_blade_seen_along_its_flat_has_the_silhouette_of_its_faces_sides() {
    let blade = mesh(
        vec![DVec3::ZERO, DVec3::Z, DVec3::new(-1.0, 2e-4, 0.5), DVec3::new(-1.0, -2e-4, 0.5)],
        vec![[0, 1, 2], [1, 0, 3]],
    );
    let edges = EdgeList::new(&blade);
    let silhouettes = Silhouettes::new(&blade, &edges);
    for y in [1e-4, 1e-3, 2.4e-3, 3e-3, 0.1] {
        let eye = Eye::Direction(DVec3::new(10.0, y, 0.0));
        let found = silhouettes.find(&blade, &edges, eye, SilhouetteRule::Exact);
        assert_eq!(found, by_sides(&blade, &edges, eye), "{y}");
    }
}
