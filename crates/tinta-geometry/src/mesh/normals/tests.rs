use super::*;
use crate::mesh::triangle_normal;
use std::collections::HashSet;
use std::f64::consts::TAU;

fn computed(positions: &[DVec3], triangles: &[[u32; 3]], angle: f64) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    split(positions, triangles, Splitting { cos_smooth: angle.to_radians().cos(), cos_beside: None, reach: 0.021 })
}

/// Split along creases of 40 degrees that last.
fn lasting(positions: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let [cos_smooth, cos_beside] = [40.0f64, 80.0 / 3.0].map(|angle| angle.to_radians().cos());
    split(positions, triangles, Splitting { cos_smooth, cos_beside: Some(cos_beside), reach: 0.021 })
}

fn split(positions: &[DVec3], triangles: &[[u32; 3]], splitting: Splitting) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (mut normals, mut indices) = (Vec::new(), vec![[NONE; 3]; triangles.len()]);
    let corners = |triangle: &[u32; 3]| triangle.map(|index| positions[index as usize]);
    let face_normals: Vec<DVec3> = triangles.iter().map(|t| triangle_normal(corners(t)).unwrap()).collect();
    fill_missing(positions, triangles, &face_normals, splitting, &mut normals, &mut indices);
    (normals, indices)
}

fn cube() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let positions = (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64)).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    (positions, triangles)
}

/// The largest angle between a corner's normal and its face, degrees.
fn farthest(positions: &[DVec3], triangles: &[[u32; 3]], (normals, indices): &(Vec<Vec3>, Vec<[u32; 3]>)) -> f64 {
    let angles = triangles.iter().zip(indices).flat_map(|(triangle, corners)| {
        let face = triangle_normal(triangle.map(|index| positions[index as usize])).unwrap();
        corners.map(|normal| face.angle_between(normals[normal as usize].as_dvec3()))
    });
    angles.fold(0.0, f64::max).to_degrees()
}

/// A cube whose twelve edges and eight corners are cut off, as its faces' corners' hull: faces meet chamfers at 45 degrees and
/// chamfers the corners' triangles at 35.
fn chamfered() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut positions = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let sides = [-1.0, 1.0];
    let corner = |axis: usize, signs: [f64; 3]| {
        let mut place = DVec3::from_array(signs) * 0.8;
        place[axis] = signs[axis];
        place
    };
    let mut add = |corners: &[DVec3]| {
        let first = positions.len() as u32;
        let middle: DVec3 = corners.iter().sum();
        let outward = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(middle) > 0.0;
        positions.extend(corners);
        for number in 1..corners.len() as u32 - 1 {
            let [b, c] = if outward { [number, number + 1] } else { [number + 1, number] };
            triangles.push([first, first + b, first + c]);
        }
    };
    for axis in 0..3 {
        let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
        for side in sides {
            let at = |a: f64, b: f64| {
                let mut signs = [side; 3];
                (signs[next], signs[last]) = (a, b);
                signs
            };
            add(&[at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)].map(|signs| corner(axis, signs)));
            for other in sides {
                // The chamfer between this side and one of the next axis.
                let [a, b] = [at(other, -1.0), at(other, 1.0)];
                add(&[corner(axis, a), corner(axis, b), corner(next, b), corner(next, a)]);
                if axis == 0 {
                    sides.iter().for_each(|third| add(&[0, 1, 2].map(|axis| corner(axis, at(other, *third)))));
                }
            }
        }
    }
    // Welded.
    let mut welded: Vec<DVec3> = Vec::new();
    let index: Vec<u32> = positions
        .iter()
        .map(|place| {
            let known = welded.iter().position(|other| other == place);
            known.unwrap_or_else(|| {
                welded.push(*place);
                welded.len() - 1
            }) as u32
        })
        .collect();
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = index[*vertex as usize]);
    (welded, triangles)
}

#[test]
fn chamfers_at_45_degrees_keep_their_own_normals_beside_smoother_corners() {
    let (positions, triangles) = chamfered();
    assert_eq!((positions.len(), triangles.len()), (24, 44));
    // By the angle alone a chamfer leans towards its corners, and its edges fade in the middle.
    let by_angle = farthest(&positions, &triangles, &computed(&positions, &triangles, 40.0));
    assert!(by_angle > 15.0, "{by_angle}");
    let split = farthest(&positions, &triangles, &lasting(&positions, &triangles));
    assert!(split < 1e-3, "{split}");
}

#[test]
fn a_box_on_a_part_keeps_its_edges_however_small_it_is() {
    // Its corners are 1.7 apart, and those of the plate beside it 141.
    let (mut positions, mut triangles) = cube();
    let first = positions.len() as u32;
    positions.extend([[9.0, 0.0], [109.0, 0.0], [109.0, 100.0], [9.0, 100.0]].map(|[x, y]| DVec3::new(x, y, 0.0)));
    triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|corner| corner + first)));
    let split = farthest(&positions, &triangles, &lasting(&positions, &triangles));
    assert!(split < 1e-3, "{split}");
}

/// A square of so many cells a side, each of two triangles, its height at each point.
fn grid(cells: usize, height: impl Fn(usize, usize) -> f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (side, at) = (cells + 1, |x: usize, y: usize| (y * (cells + 1) + x) as u32);
    let positions =
        (0..side * side).map(|n| DVec3::new((n % side) as f64, (n / side) as f64, height(n % side, n / side)));
    let triangles = (0..cells * cells).flat_map(|n| {
        let (x, y) = (n % cells, n / cells);
        [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)]]
    });
    (positions.collect(), triangles.collect())
}

#[test]
fn a_single_sharp_edge_of_a_fine_model_is_smoothed_and_one_that_lasts_is_not() {
    let normals_at = |height: fn(usize, usize) -> f64, vertex: (usize, usize)| {
        let (positions, triangles) = grid(120, height);
        let place = (vertex.1 * 121 + vertex.0) as u32;
        [computed(&positions, &triangles, 40.0), lasting(&positions, &triangles)].map(|(_, indices)| {
            let corners = triangles.as_flattened().iter().zip(indices.as_flattened());
            let mut here: Vec<u32> = corners.filter(|(vertex, _)| **vertex == place).map(|(_, n)| *n).collect();
            here.sort_unstable();
            here.dedup();
            here.len()
        })
    };
    // A ridge of two edges, of 60 degrees, and the same across the whole square.
    let short = |x: usize, y: usize| if x == 30 && (29..=31).contains(&y) { 0.6 } else { 0.0 };
    let long = |x: usize, _: usize| if x == 30 { 0.6 } else { 0.0 };
    assert_eq!(normals_at(short, (30, 30)), [2, 1]);
    assert_eq!(normals_at(long, (30, 30)), [2, 2]);
}

#[test]
fn a_triangle_turned_over_keeps_its_own_side_among_smooth_ones() {
    let (positions, mut triangles) = grid(20, |x, y| 0.02 * (x * x + y) as f64);
    triangles[417].swap(1, 2);
    let (normals, indices) = lasting(&positions, &triangles);
    for (corners, triangle) in indices.iter().zip(&triangles) {
        let face = triangle_normal(triangle.map(|index| positions[index as usize])).unwrap().as_vec3();
        assert!(corners.iter().all(|corner| normals[*corner as usize].dot(face) > 0.5), "{triangle:?}");
    }
}

#[test]
fn a_flat_face_stays_flat_beside_a_chamfer() {
    // Two flat halves, and between them a strip at 30 degrees.
    let slope = 30f64.to_radians().tan();
    let (positions, triangles) = grid(60, |x, _| if x <= 30 { 0.0 } else { slope * (x.min(31) - 30) as f64 });
    let of_faces = |(normals, indices): (Vec<Vec3>, Vec<[u32; 3]>)| {
        let is_flat = |triangle: &[u32; 3]| triangle.iter().all(|vertex| positions[*vertex as usize].x <= 30.0);
        let flat = triangles.iter().zip(&indices).filter(|(triangle, _)| is_flat(triangle));
        flat.flat_map(|(_, corners)| corners)
            .map(|normal| normals[*normal as usize].as_dvec3().angle_between(DVec3::Z).to_degrees())
            .fold(0.0, f64::max)
    };
    let [by_angle, lasting] =
        [of_faces(computed(&positions, &triangles, 40.0)), of_faces(lasting(&positions, &triangles))];
    assert!(by_angle > 10.0 && lasting < 1.5, "{by_angle} {lasting}");
}

#[test]
fn a_cube_gets_flat_faces_below_its_right_angle() {
    let (positions, triangles) = cube();
    let (normals, indices) = computed(&positions, &triangles, 60.0);
    for (triangle, corners) in triangles.iter().zip(&indices) {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        let face = (b - a).cross(c - a).normalize().as_vec3();
        for corner in corners {
            assert!(normals[*corner as usize].distance(face) < 1e-6);
        }
    }
    assert_eq!(normals.len(), 24, "three faces at each of eight corners");
}

#[test]
fn a_cube_gets_its_diagonals_above_its_right_angle_whatever_way_its_squares_are_cut() {
    let (positions, triangles) = cube();
    let (normals, indices) = computed(&positions, &triangles, 91.0);
    assert_eq!(normals.len(), 8);
    for (vertex, normal) in triangles.as_flattened().iter().zip(indices.as_flattened()) {
        let diagonal = (positions[*vertex as usize] - DVec3::splat(0.5)).normalize().as_vec3();
        assert!(normals[*normal as usize].distance(diagonal) < 1e-6);
    }
}

#[test]
fn a_sheet_drawn_from_both_sides_keeps_both_normals() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let (normals, indices) = computed(&positions, &[[0, 1, 2], [0, 2, 1]], 180.0);
    assert_eq!(normals[indices[0][0] as usize], Vec3::Z);
    assert_eq!(normals[indices[1][0] as usize], Vec3::NEG_Z);
}

/// The article's normals.
fn of_the_article(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let corners = |triangle: &[u32; 3]| triangle.map(|index| positions[index as usize]);
    let face_normals: Vec<DVec3> = triangles.iter().map(|t| triangle_normal(corners(t)).unwrap()).collect();
    one_a_position(positions.len(), triangles, &face_normals)
}

#[test]
fn by_the_article_a_cubes_corner_leans_to_the_squares_whose_diagonal_ends_there() {
    let (positions, triangles) = cube();
    let normals = of_the_article(&positions, &triangles);
    assert_eq!(normals.len(), 8, "one normal a corner");
    // Outward along x, y and z; a square with a diagonal at the corner has two triangles there.
    let expected = |corner: usize, counts: [f64; 3]| {
        let outward = (positions[corner] - DVec3::splat(0.5)).signum();
        (outward * DVec3::from_array(counts)).normalize().as_vec3()
    };
    // The cube's squares are cut from 0 and from 7 three times each, and once to each of the others.
    let corners = [
        (0, [2.0, 2.0, 2.0]),
        (7, [2.0, 2.0, 2.0]),
        (3, [1.0, 1.0, 2.0]),
        (4, [1.0, 1.0, 2.0]),
        (5, [1.0, 2.0, 1.0]),
        (2, [1.0, 2.0, 1.0]),
        (6, [2.0, 1.0, 1.0]),
        (1, [2.0, 1.0, 1.0]),
    ];
    for (corner, counts) in corners {
        assert!(normals[corner].distance(expected(corner, counts)) < 1e-6, "{corner}: {}", normals[corner]);
    }
    assert!(normals[7].distance(Vec3::splat(3f32.sqrt().recip())) < 1e-6, "the diagonal");
    assert!(normals[3].distance(Vec3::new(1.0, 1.0, -2.0) / 6f32.sqrt()) < 1e-6, "not the diagonal");
}

#[test]
fn by_the_article_a_cones_apex_points_along_its_axis_and_its_rim_along_its_slope() {
    let (sides, height) = (12u32, 2.0);
    let rim = |side: u32| {
        let turn = f64::from(side) / f64::from(sides) * std::f64::consts::TAU;
        DVec3::new(turn.cos(), 0.0, turn.sin())
    };
    let positions: Vec<DVec3> = std::iter::once(DVec3::Y * height).chain((0..sides).map(rim)).collect();
    let triangles: Vec<[u32; 3]> = (0..sides).map(|side| [0, 1 + (side + 1) % sides, 1 + side]).collect();
    let normals = of_the_article(&positions, &triangles);
    assert!(normals[0].distance(Vec3::Y) < 1e-6);
    // Each side's normal is (height, inradius) across and up; two of them, half a side to the left and right, add up.
    let half = std::f64::consts::PI / f64::from(sides);
    let (across, up) = (height * half.cos(), half.cos());
    let expected = DVec3::new(across, up, 0.0).normalize().as_vec3();
    assert!(normals[1].distance(expected) < 1e-6, "{} instead of {expected}", normals[1]);
}

#[test]
fn the_article_counts_triangles_where_the_default_weighs_them() {
    // A square on the floor, cut at the origin, and one triangle of a wall.
    let positions = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y, DVec3::Z];
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4]];
    let counted = of_the_article(&positions, &triangles)[0];
    assert!(counted.distance(Vec3::new(1.0, 0.0, 2.0) / 5f32.sqrt()) < 1e-6, "{counted}");
    let (weighed, indices) = computed(&positions, &triangles, 180.0);
    let weighed = weighed[indices[0][0] as usize];
    assert!(weighed.distance(Vec3::new(1.0, 0.0, 1.0) / 2f32.sqrt()) < 1e-6, "{weighed}");
}

#[test]
fn where_the_articles_sum_is_nothing_the_first_triangle_counts() {
    let sheet = [DVec3::ZERO, DVec3::X, DVec3::Y];
    assert_eq!(of_the_article(&sheet, &[[0, 1, 2], [0, 2, 1]]), [Vec3::Z; 3]);
    assert_eq!(of_the_article(&sheet, &[[0, 2, 1], [0, 1, 2]]), [Vec3::NEG_Z; 3]);
    // Three wings around the z axis, turned alike: their sum is 0 but for rounding.
    let wing = |turn: f64| DVec3::new(turn.to_radians().cos(), turn.to_radians().sin(), 0.0);
    let positions = [DVec3::ZERO, DVec3::Z, wing(0.0), wing(120.0), wing(240.0)];
    let normals = of_the_article(&positions, &[[0, 2, 1], [0, 3, 1], [0, 4, 1]]);
    assert_eq!(normals[..3], [Vec3::NEG_Y; 3], "the axis has the first wing's normal");
}

#[test]
fn a_fan_of_a_hundred_thousand_triangles_is_done_in_the_time_of_a_sort() {
    let count = 100_000;
    let rim = |i: u32| {
        let turn = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
        DVec3::new(turn.cos(), 0.0, turn.sin())
    };
    let positions: Vec<DVec3> = std::iter::once(DVec3::Y * 2.0).chain((0..count).map(rim)).collect();
    let triangles: Vec<[u32; 3]> = (0..count).map(|i| [0, 1 + (i + 1) % count, 1 + i]).collect();
    let backwards: Vec<[u32; 3]> = triangles.iter().rev().copied().collect();
    for triangles in [triangles, backwards] {
        // Neighbours differ by little here, but the whole fan by more than the angle, so edges are looked at.
        let (normals, indices) = computed(&positions, &triangles, 100.0);
        let tip = indices.iter().zip(&triangles).map(|(normals, corners)| (corners[0], normals[0]));
        assert!(tip.clone().all(|(corner, normal)| corner == 0 && normal == indices[0][0]), "one group at the tip");
        assert!(normals[indices[0][0] as usize].distance(Vec3::Y) < 1e-3);
    }
}

#[test]
fn normals_of_a_bowl_whose_vertices_were_moved_come_nearer_to_the_bowls() {
    let moved = |x: f64, y: f64| 0.05 * ((x * 12.9898 + y * 78.233).sin() * 43758.5453).fract();
    let (positions, triangles) = grid(20, |x, y| {
        let [x, y] = [x, y].map(|at| at as f64 - 10.0);
        0.05 * (x * x + y * y) + moved(x, y)
    });
    let off = |(normals, indices): (Vec<Vec3>, Vec<[u32; 3]>)| {
        // Away from the rim, where normals lean to one side before and after.
        let is_inner = |vertex: u32| [vertex % 21, vertex / 21].iter().all(|at| (2..19).contains(at));
        let corners = triangles.as_flattened().iter().zip(indices.as_flattened()).filter(|(it, _)| is_inner(**it));
        let angles = corners.map(|(vertex, normal)| {
            let place = positions[*vertex as usize];
            let of_bowl = DVec3::new(-0.1 * (place.x - 10.0), -0.1 * (place.y - 10.0), 1.0);
            normals[*normal as usize].as_dvec3().angle_between(of_bowl)
        });
        angles.sum::<f64>()
    };
    let (by_angle, calmed) = (off(computed(&positions, &triangles, 40.0)), off(lasting(&positions, &triangles)));
    assert!(calmed < 0.8 * by_angle, "{calmed} instead of {by_angle}");
}

#[test]
fn normals_of_uneven_cylinders_stay() {
    // Strips that turn by a third of a degree and by eight, by turns.
    let profile = |x: f64| 0.02 * (x - 10.0).powi(2) + if (x as u32).is_multiple_of(2) { 0.036 } else { 0.0 };
    let (positions, triangles) = grid(20, |x, _| profile(x as f64));
    let (normals, indices) = lasting(&positions, &triangles);
    for (vertex, normal) in triangles.as_flattened().iter().zip(indices.as_flattened()) {
        let x = f64::from(vertex % 21);
        if !(1.0..20.0).contains(&x) {
            continue;
        }
        let strip = |from: f64| DVec3::new(profile(from) - profile(from + 1.0), 0.0, 1.0);
        // Strips weigh in with their areas.
        let mean = strip(x - 1.0) + strip(x);
        let angle = normals[*normal as usize].as_dvec3().angle_between(mean).to_degrees();
        assert!(angle < 0.2, "{angle} degrees at {x}");
    }
}

/// A shaft of so many sides in rows of rectangles, its top chamfered at an angle to its flat end.
fn shaft(sides: u32, rows: u32, degrees: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let chamfer = (0.8, 3.0 + 0.2 * degrees.to_radians().tan());
    let rings = (0..=rows).map(|row| (1.0, 3.0 * f64::from(row) / f64::from(rows))).chain([chamfer]);
    let ring = |(radius, height): (f64, f64)| {
        (0..sides).map(move |side| {
            let turn = f64::from(side) / f64::from(sides) * std::f64::consts::TAU;
            DVec3::new(radius * turn.cos(), radius * turn.sin(), height)
        })
    };
    let positions: Vec<DVec3> = rings.flat_map(ring).collect();
    let mut triangles = Vec::new();
    for row in 0..=rows {
        for side in 0..sides {
            let [a, b] = [side, (side + 1) % sides].map(|side| row * sides + side);
            triangles.extend([[a, b, b + sides], [a, b + sides, a + sides]]);
        }
    }
    let top = (rows + 1) * sides;
    triangles.extend((1..sides - 1).map(|side| [top, top + side, top + side + 1]));
    (positions, triangles)
}

#[test]
fn a_chamfer_of_thirty_degrees_ends_at_the_flat_face_and_facets_stay_round() {
    for sides in [12, 24, 60] {
        for degrees in [28.0, 30.0, 38.0] {
            let (positions, triangles) = shaft(sides, 6, degrees);
            let (normals, indices) = lasting(&positions, &triangles);
            let top = triangles.len() - (sides as usize - 2);
            for normal in indices[top..].as_flattened().iter().map(|index| normals[*index as usize]) {
                assert!(normal.z > 0.999_999, "{sides} sides, {degrees} degrees: the flat end has {normal}");
            }
            // Facets of 30 degrees with many triangles, too: neither side of such an edge is larger.
            let side = &indices[..12 * sides as usize];
            let off = farthest(&positions, &triangles[..side.len()], &(normals.clone(), side.to_vec()));
            let half = 180.0 / f64::from(sides);
            assert!((off - half).abs() < 1e-3, "{sides} sides: {off} degrees instead of {half}");
        }
        // 24 degrees are below the angle: the flat end and its chamfer share their normals.
        let (positions, triangles) = shaft(sides, 6, 24.0);
        let (_, indices) = lasting(&positions, &triangles);
        let normals_at = |vertex: u32| {
            let corners = triangles.as_flattened().iter().zip(indices.as_flattened());
            corners.filter(|(corner, _)| **corner == vertex).map(|(_, normal)| *normal).collect::<HashSet<u32>>()
        };
        assert_eq!(normals_at(7 * sides).len(), 1, "{sides} sides");
    }
}

/// A height over a square: a wave of this length, in cells.
fn wavy(length: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    grid(60, |x, y| 0.6 * ((x as f64 * TAU / length).sin() + (y as f64 * TAU / length).cos()))
}

#[test]
fn averaged_normals_are_shorter_where_a_surface_bends_within_the_reach_and_hardly_where_it_does_not() {
    let least = |(positions, triangles): (Vec<DVec3>, Vec<[u32; 3]>)| {
        let (normals, indices) = lasting(&positions, &triangles);
        let lengths = indices.as_flattened().iter().map(|index| normals[*index as usize].length());
        assert!(lengths.clone().all(|length| length <= 1.0 + 1e-5));
        f64::from(lengths.fold(1.0, f32::min))
    };
    // The reach is 0.021 of the diagonal, 1.8 cells.
    let [short, long] = [least(wavy(6.0)), least(wavy(60.0))];
    assert!(short < 0.93 && long > 0.99, "{short}, {long}");
}

#[test]
fn a_shorter_reach_averages_less_and_none_averages_nothing() {
    let (positions, triangles) = wavy(6.0);
    let mean = |reach: f64| {
        let [cos_smooth, cos_beside] = [40.0f64, 80.0 / 3.0].map(|angle| angle.to_radians().cos());
        let (normals, _) = split(&positions, &triangles, Splitting { cos_smooth, cos_beside: Some(cos_beside), reach });
        normals.iter().map(|normal| f64::from(normal.length())).sum::<f64>() / normals.len() as f64
    };
    let [none, short, long] = [0.0, 0.01, 0.021].map(mean);
    assert!((none - 1.0).abs() < 1e-6 && none > short && short > long, "{none}, {short}, {long}");
}

#[test]
fn a_finer_mesh_of_the_same_form_has_the_same_averages() {
    let form = |x: f64, y: f64| 0.02 * ((x * 14.0).sin() + (y * 11.0).cos());
    let at_middle = |cells: usize| {
        let (positions, triangles) =
            grid(cells, |x, y| cells as f64 * form(x as f64 / cells as f64, y as f64 / cells as f64));
        let (normals, indices) = lasting(&positions, &triangles);
        let side = cells as u32 + 1;
        [1u32, 2, 3].map(|part| {
            let vertex = (side / 2) * side + cells as u32 * part / 4;
            let corner = triangles.as_flattened().iter().position(|corner| *corner == vertex).unwrap();
            normals[indices.as_flattened()[corner] as usize]
        })
    };
    // Patches are made of corners, then of patches: the coarsest mesh has one corner in each, the finest hundreds.
    let [coarse, fine, finest] = [48, 160, 480].map(at_middle);
    for (one, other) in coarse.iter().zip(fine).chain(fine.iter().zip(finest)) {
        assert!(one.distance(other) < 0.03, "{one} and {other}");
    }
}

/// A ball of rows of triangles around an axis.
fn ball(centre: DVec3, radius: f64, (positions, triangles): &mut (Vec<DVec3>, Vec<[u32; 3]>)) {
    let (around, rows, first) = (12u32, 8u32, positions.len() as u32);
    for row in 0..=rows {
        let (sin, cos) = (f64::from(row) * TAU / 2.0 / f64::from(rows)).sin_cos();
        let place = |step: u32| (f64::from(step) * TAU / f64::from(around)).sin_cos();
        positions.extend(
            (0..around).map(|step| centre + radius * DVec3::new(sin * place(step).1, sin * place(step).0, cos)),
        );
    }
    for (row, step) in (0..rows).flat_map(|row| (0..around).map(move |step| (row, step))) {
        let [a, b] = [step, (step + 1) % around].map(|step| first + row * around + step);
        let sides = [[a, a + around, b], [b, a + around, b + around]];
        let is_at_pole = [row == 0, row + 1 == rows];
        triangles.extend(sides.into_iter().zip(is_at_pole).filter(|(_, is_at_pole)| !is_at_pole).map(|(t, _)| t));
    }
}

#[test]
fn small_round_parts_far_apart_are_averaged_whatever_their_sizes_are() {
    for radius in [1e-12, 1e-6, 1e-3, 5e-3, 0.3] {
        for count in [1, 2, 9, 100] {
            let mut model = cube();
            for number in 0..count {
                ball(DVec3::new(f64::from(number), 0.5, 3.0), radius * f64::from(1 + number % 3), &mut model);
            }
            let (normals, indices) = lasting(&model.0, &model.1);
            assert!(indices.as_flattened().iter().all(|index| normals[*index as usize].length() <= 1.0 + 1e-5));
        }
    }
    let sliver = [DVec3::ZERO, DVec3::X, DVec3::new(2.0, 1e-4, 0.0)];
    assert_eq!(lasting(&sliver, &[[0, 1, 2]]).0, [Vec3::Z; 3]);
}

#[test]
fn a_large_surface_among_small_balls_is_averaged_no_less_than_alone() {
    let (positions, triangles) = wavy(6.0);
    let (alone, of_alone) = lasting(&positions, &triangles);
    let mut model = (positions, triangles.clone());
    for number in 0..400 {
        ball(DVec3::new(f64::from(number % 20) * 3.0, f64::from(number / 20) * 3.0, 0.0), 1e-3, &mut model);
    }
    let (among, of_among) = lasting(&model.0, &model.1);
    for (one, other) in of_alone.as_flattened().iter().zip(of_among.as_flattened()) {
        let [one, other] = [alone[*one as usize].length(), among[*other as usize].length()];
        assert!(other < one + 0.02, "{one} alone, {other} among small balls");
    }
}

#[test]
fn a_box_keeps_its_normals_exactly() {
    let (positions, triangles) = cube();
    let (normals, indices) = lasting(&positions, &triangles);
    for (triangle, corners) in triangles.iter().zip(&indices) {
        let face = triangle_normal(triangle.map(|index| positions[index as usize])).unwrap().as_vec3();
        assert!(corners.iter().all(|corner| normals[*corner as usize] == face));
    }
}
