//! Tangent edges: found on solids whose roundings are known, and nowhere on shapes that have none.

use crate::support::public_meshes;
use crate::support::shapes::{icosphere, mesh};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};
use tinta::edges::{Class, ClassSet, Classes, CreaseAngle};
use tinta::{EdgeList, LineSettings, Mesh, Scene, SceneSettings, VisibleLines};

mod kernel;
mod surfaces;

/// A solid whose every face belongs to a patch of one kind: flat, cylinder, sphere, torus.
#[derive(Default)]
struct Solid {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    patches: Vec<usize>,
}

impl Solid {
    /// Adds a convex polygon, its front away from the origin.
    fn add(&mut self, patch: usize, corners: &[DVec3]) {
        self.add_towards(patch, corners, corners.iter().sum::<DVec3>());
    }

    fn add_towards(&mut self, patch: usize, corners: &[DVec3], front: DVec3) {
        let mut corners: Vec<DVec3> = corners.to_vec();
        corners.dedup_by(|a, b| a.distance(*b) < 1e-12);
        if (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(front) < 0.0 {
            corners.reverse();
        }
        let known = |solid: &mut Self, corner: &DVec3| {
            let place = solid.positions.iter().position(|other| other.distance(*corner) < 1e-12);
            place.unwrap_or_else(|| {
                solid.positions.push(*corner);
                solid.positions.len() - 1
            }) as u32
        };
        let numbers: Vec<u32> = corners.iter().map(|corner| known(self, corner)).collect();
        for triangle in 2..numbers.len() {
            self.triangles.push([numbers[0], numbers[triangle - 1], numbers[triangle]]);
            self.patches.push(patch);
        }
    }

    /// The length of its tangent edges, that of those found, and that of others found.
    fn found(self) -> [f64; 3] {
        let (mesh, patches) = (mesh(self.positions, self.triangles), self.patches);
        let edges = EdgeList::new(&mesh);
        let found = tangents(&mesh, &edges);
        let length = |edge: &u32| {
            let [from, to] = edges.positions()[*edge as usize].map(|end| mesh.positions[end as usize]);
            from.distance(to)
        };
        let is_true = |edge: &u32| {
            let faces = edges.faces(*edge);
            assert_eq!(faces.len(), 2, "a closed solid");
            patches[faces[0] as usize] != patches[faces[1] as usize]
        };
        let all: f64 = (0..edges.len() as u32).filter(is_true).map(|edge| length(&edge)).sum();
        let (right, wrong): (Vec<u32>, Vec<u32>) = found.into_iter().partition(is_true);
        [all, right.iter().map(length).sum(), wrong.iter().map(length).sum()]
    }
}

fn tangents(mesh: &Mesh, edges: &EdgeList) -> Vec<u32> {
    let wanted = ClassSet::of(&[Class::Tangent]);
    let classes = Classes::new(mesh, edges, CreaseAngle::of_drawings(), wanted);
    assert!(classes.marked.iter().all(|edge| classes.of_edges[*edge as usize] == wanted));
    classes.marked
}

/// A block with all edges and corners rounded, of so many facets a quarter turn.
fn rounded_block(half: DVec3, radius: f64, facets: usize) -> Solid {
    let mut solid = Solid::default();
    let corner = |signs: DVec3, i: usize, j: usize| {
        let [up, around] = [i, j].map(|step| FRAC_PI_2 * step as f64 / facets as f64);
        let direction = DVec3::new(up.cos() * around.cos(), up.sin(), up.cos() * around.sin());
        // The cosine of a right angle is not quite 0.
        let direction = direction.map(|component| if component < 1e-12 { 0.0 } else { component });
        signs * (half + direction * radius)
    };
    let sign = |of: usize, axis: usize| if of >> axis & 1 == 0 { 1.0 } else { -1.0 };
    for octant in 0..8 {
        let signs = DVec3::new(sign(octant, 0), sign(octant, 1), sign(octant, 2));
        let flip = |axis: usize| signs.with_axis(axis);
        for i in 0..facets {
            for j in 0..facets {
                let of = |i: usize, j: usize| corner(signs, i, j);
                solid.add(octant, &[of(i, j), of(i, j + 1), of(i + 1, j + 1), of(i + 1, j)]);
            }
        }
        for step in 0..facets {
            // From each octant to the one beyond a plane of symmetry.
            for (axis, at) in [
                (1, [[0, step], [0, step + 1]]),
                (2, [[step, 0], [step + 1, 0]]),
                (0, [[step, facets], [step + 1, facets]]),
            ] {
                if signs[axis] > 0.0 {
                    let [a, b] = at.map(|[i, j]| corner(signs, i, j));
                    let [c, d] = at.map(|[i, j]| corner(flip(axis), i, j));
                    solid.add(8 + 8 * axis + octant, &[a, b, d, c]);
                }
            }
        }
        for (axis, [i, j]) in [(0, [0, 0]), (1, [facets, 0]), (2, [0, facets])] {
            let others = [(axis + 1) % 3, (axis + 2) % 3];
            if others.iter().all(|other| signs[*other] > 0.0) {
                let [one, two] = others;
                let around = [signs, flip(one), flip(one).with_axis(two), flip(two)];
                solid.add(40 + 2 * axis + usize::from(signs[axis] < 0.0), &around.map(|signs| corner(signs, i, j)));
            }
        }
    }
    solid
}

trait Flip {
    fn with_axis(self, axis: usize) -> Self;
}

impl Flip for DVec3 {
    fn with_axis(mut self, axis: usize) -> Self {
        self[axis] = -self[axis];
        self
    }
}

/// A round rod whose ends are rounded, of so many sides.
fn rounded_rod(radius: f64, rounding: f64, half_length: f64, facets: usize, sides: usize) -> Solid {
    let mut solid = Solid::default();
    let mut profile = vec![(DVec2::new(0.0, half_length + rounding), 0)];
    for step in 0..=facets {
        let angle = FRAC_PI_2 * step as f64 / facets as f64;
        let of = if step == 0 { 0 } else { 1 };
        profile
            .push((DVec2::new(radius - rounding + rounding * angle.sin(), half_length + rounding * angle.cos()), of));
    }
    for step in (0..=facets).rev() {
        let (point, _) = profile[1 + step];
        profile.push((point * DVec2::new(1.0, -1.0), if step == facets { 2 } else { 3 }));
    }
    profile.push((DVec2::new(0.0, -half_length - rounding), 4));
    for ends in profile.windows(2) {
        for side in 0..sides {
            let at = |(point, _): (DVec2, usize), side: usize| {
                let angle = TAU * (side % sides) as f64 / sides as f64;
                DVec3::new(point.x * angle.cos(), point.y, point.x * angle.sin())
            };
            solid.add(ends[1].1, &[at(ends[0], side), at(ends[0], side + 1), at(ends[1], side + 1), at(ends[1], side)]);
        }
    }
    solid
}

#[test]
fn a_rounded_block_has_its_tangent_edges_from_four_facets_a_quarter_turn_on() {
    for facets in [4, 5, 6, 8, 12] {
        for (half, radius) in [(DVec3::new(3.0, 2.0, 1.0), 0.5), (DVec3::ONE, 1.0), (DVec3::new(4.0, 0.3, 2.0), 0.7)] {
            let [all, right, wrong] = rounded_block(half, radius, facets).found();
            println!("{facets} facets, {half}, {radius}: {:.4} found, {wrong} wrong", right / all);
            assert!(right >= 0.95 * all && wrong <= 0.001 * all, "{facets} {half} {radius}: {all} {right} {wrong}");
        }
    }
}

#[test]
fn a_rod_with_rounded_ends_has_two_rings_at_each() {
    for (facets, sides) in [(4, 16), (5, 40), (8, 64), (16, 96)] {
        for rounding in [0.2, 0.5] {
            let [all, right, wrong] = rounded_rod(2.0, rounding, 1.5, facets, sides).found();
            println!("{facets} facets, {sides} sides, {rounding}: {:.4} found, {wrong} wrong", right / all);
            assert!(right >= 0.95 * all && wrong <= 0.001 * all, "{facets} {sides} {rounding}: {all} {right} {wrong}");
        }
    }
}

/// A bar whose profile is an L with a rounding inside and one outside.
fn angle_bar(radius: f64, facets: usize) -> Solid {
    let arc = |middle: DVec2, radius: f64, patch: usize| {
        let at = move |step: usize| middle - DVec2::from_angle(FRAC_PI_2 * step as f64 / facets as f64) * radius;
        (0..=facets).map(move |step| (at(step), if step == 0 { patch - 1 } else { patch }))
    };
    let corner = DVec2::splat(radius + 1.0);
    let mut profile = vec![(DVec2::new(0.0, 9.0), 0)];
    profile.extend(arc(corner, radius + 1.0, 2));
    profile.extend([(DVec2::new(9.0, 0.0), 3), (DVec2::new(9.0, 1.0), 4)]);
    let mut inner: Vec<(DVec2, usize)> = arc(corner, radius, 6).collect();
    inner.reverse();
    profile.extend(inner.iter().enumerate().map(|(step, (point, _))| (*point, if step == 0 { 5 } else { 6 })));
    profile.extend([(DVec2::new(1.0, 9.0), 7), (DVec2::new(0.0, 9.0), 8)]);
    let mut solid = Solid::default();
    let place = |point: DVec2, z: f64| DVec3::new(point.x, point.y, z);
    for sides in profile.windows(2) {
        let [from, to] = [sides[0].0, sides[1].0];
        let outwards = DVec3::new(to.y - from.y, from.x - to.x, 0.0);
        solid.add_towards(
            sides[1].1,
            &[place(from, 0.0), place(to, 0.0), place(to, 20.0), place(from, 20.0)],
            -outwards,
        );
    }
    for (z, patch) in [(0.0, 9), (20.0, 10)] {
        // From the outer side to the inner one.
        let outer: Vec<DVec2> = profile[..facets + 3].iter().map(|(point, _)| *point).collect();
        let inner: Vec<DVec2> = profile[facets + 3..].iter().rev().map(|(point, _)| *point).skip(1).collect();
        for step in 0..facets + 2 {
            let corners = [outer[step], outer[step + 1], inner[step + 1], inner[step]].map(|point| place(point, z));
            solid.add_towards(patch, &corners, DVec3::Z * (z - 10.0));
        }
    }
    solid
}

#[test]
fn roundings_along_a_bar_have_tangent_edges_from_crease_to_crease() {
    for facets in [4, 6, 10] {
        for radius in [0.5, 2.0] {
            let solid = angle_bar(radius, facets);
            let (mesh, patches) = (mesh(solid.positions, solid.triangles), solid.patches);
            let edges = EdgeList::new(&mesh);
            let mut sides: Vec<Vec<usize>> = tangents(&mesh, &edges)
                .into_iter()
                .map(|edge| edges.faces(edge).iter().map(|face| patches[*face as usize]).collect())
                .collect();
            sides.iter_mut().for_each(|sides| sides.sort_unstable());
            sides.sort_unstable();
            assert_eq!(sides, [[1, 2], [2, 3], [5, 6], [6, 7]], "{facets} facets, radius {radius}");
        }
    }
}

#[test]
fn drawings_with_lasting_creases_have_the_same() {
    let solid = rounded_block(DVec3::new(3.0, 2.0, 1.0), 0.5, 4);
    let scene = Scene::new([mesh(solid.positions, solid.triangles)], &SceneSettings::default()).unwrap();
    let count = |lasting_creases: bool| {
        let crease_angle = CreaseAngle::from_degrees(29.0).unwrap();
        let settings = LineSettings {
            classes: ClassSet::of(&[Class::Tangent]),
            crease_angle,
            lasting_creases,
            ..LineSettings::default()
        };
        VisibleLines::of(&scene, &settings).unwrap().edges.tangent
    };
    assert!(count(true) == count(false) && count(true) > 100, "{} {}", count(true), count(false));
}

/// A torus of quadrilaterals.
fn torus(tube: f64, around: usize, across: usize) -> Solid {
    let mut solid = Solid::default();
    let at = |i: usize, j: usize| {
        let [a, b] = [(i % around, around), (j % across, across)].map(|(step, count)| TAU * step as f64 / count as f64);
        let out = 1.0 + tube * b.cos();
        DVec3::new(out * a.cos(), tube * b.sin(), out * a.sin())
    };
    for i in 0..around {
        (0..across).for_each(|j| solid.add(0, &[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    }
    solid
}

/// A sphere of meridians and parallels.
fn globe(across: usize, around: usize) -> Solid {
    let mut solid = Solid::default();
    let at = |i: usize, j: usize| {
        let [up, turn] =
            [FRAC_PI_2 * (2.0 * i as f64 / across as f64 - 1.0), TAU * (j % around) as f64 / around as f64];
        DVec3::new(up.cos() * turn.cos(), up.sin(), up.cos() * turn.sin())
            .map(|of| if of.abs() < 1e-12 { 0.0 } else { of })
    };
    for i in 0..across {
        (0..around).for_each(|j| solid.add(0, &[at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]));
    }
    solid
}

#[test]
fn balls_and_rings_have_none() {
    for levels in 2..=5 {
        let ball = icosphere(levels);
        assert_eq!(tangents(&ball, &EdgeList::new(&ball)), [0; 0], "an icosphere of {levels} levels");
    }
    for (across, around) in [(8, 16), (12, 24), (18, 20), (24, 64), (40, 40)] {
        assert_eq!(globe(across, around).found()[2], 0.0, "a globe of {across} x {around}");
    }
    for (tube, around, across) in [(0.3, 24, 16), (0.5, 40, 24), (0.2, 64, 13), (0.8, 96, 32), (0.05, 200, 12)] {
        assert_eq!(torus(tube, around, across).found()[2], 0.0, "a torus of {tube}, {around} x {across}");
    }
}

/// A scan and figures without turned parts.
const SCANS: [&str; 6] =
    ["stanford-bunny.obj", "cow.obj", "suzanne.obj", "spot/spot_triangulated.obj", "faerie.md2", "ant.ply"];

#[test]
fn scans_have_none() {
    for (name, mesh) in public_meshes(&SCANS) {
        let found = tangents(&mesh, &EdgeList::new(&mesh));
        assert_eq!(found, [0; 0], "{name}: of {} faces", mesh.triangles.len());
    }
}
