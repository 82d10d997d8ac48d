//! Corners inside straight sides of polygons, as exact as a file's digits, change no line and no class.

use crate::same::difference;
use crate::support::lines::{assert_near, lines, scene_of, scenes_wanted, total, view};
use crate::support::shapes::Random;
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use tinta::mesh::read_bytes;
use tinta::{CameraSettings, LoadOptions, Mesh, Scene};

fn read(text: &str, weld: f64) -> Mesh {
    let options = LoadOptions { weld, ..LoadOptions::default() };
    read_bytes(text.as_bytes(), "model.obj", &[], &options).unwrap().mesh
}

fn drawn(text: &str) -> Scene {
    scene_of(vec![read(text, LoadOptions::default().weld)], CameraSettings::default())
}

#[test]
fn two_corners_inside_a_side_draw_no_line_across_a_flat_face() {
    let vertices = "v -.3 -.1 0\nv -.5 -1.3 0\nv -.6 -1.9 0\nv -.7 -2.5 0\nv .1 -1.4 0\nv -1.1 -1.2 0\n";
    for polygon in ["4 5 1 2 3", "5 1 2 3 4", "1 2 3 4 5", "2 3 4 5 1", "3 4 5 1 2"] {
        let mesh = read(&format!("{vertices}f {polygon}\nf 6 4 1\n"), LoadOptions::default().weld);
        assert_near(total(&lines(&scene_of(vec![mesh], view("front", false))), true), 1067.8, 0.05, polygon);
    }
}

#[test]
fn a_corner_that_digits_move_beside_its_side_draws_no_line_across_a_flat_face() {
    let plate = |middle: &str| {
        format!(
            "v 0 0 0\nv .263669 .226026 .937758\n{middle}\nv -.682536 .730682 .015794\nv -.418866 .956708 .953552\n\
             v .682536 -.730682 -.015794\nv .946205 -.504655 .921965\nf 1 3 2 5 4\nf 2 1 6 7\n"
        )
    };
    // Six digits always serve, four where --weld says so.
    for (middle, weld) in [("v .131835 .113013 .468879", 1e-7), ("v .1319 .1130 .4690", 1e-4)] {
        let scene = scene_of(vec![read(&plate(middle), weld)], view("30,20", false));
        assert_near(total(&lines(&scene), true), 1138.9, 0.05, middle);
    }
}

/// Polygons over points.
#[derive(Clone, Default)]
struct Solid {
    points: Vec<DVec3>,
    faces: Vec<Vec<usize>>,
}

impl Solid {
    /// A polygon in a plane across z, extruded along it.
    fn extruded(outline: &[(f64, f64)], height: f64) -> Self {
        let count = outline.len();
        let ring = |z: f64| outline.iter().map(move |(x, y)| DVec3::new(*x, *y, z));
        let sides = (0..count).map(|i| vec![i, (i + 1) % count, count + (i + 1) % count, count + i]);
        let caps = [(0..count).rev().collect(), (count..2 * count).collect()];
        Self { points: ring(0.0).chain(ring(height)).collect(), faces: sides.chain(caps).collect() }
    }

    fn random(random: &mut Random) -> Self {
        let size = |random: &mut Random| 0.3 + random.number();
        let [x, y, z, w] = [(); 4].map(|()| size(random));
        match random.whole(0, 4) {
            0 => Self::extruded(&[(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)], z),
            1 => {
                let count = random.whole(3, 8);
                let corner = |i: i32| (TAU * f64::from(i) / f64::from(count)).sin_cos();
                Self::extruded(&(0..count).map(corner).map(|(sin, cos)| (x * cos, x * sin)).collect::<Vec<_>>(), z)
            }
            // An L, with its concave corner anywhere.
            2 => Self::extruded(&[(0.0, 0.0), (x + z, 0.0), (x + z, y), (x, y), (x, y + w), (0.0, y + w)], z),
            // Open plates at an edge, flat or at any angle.
            3 => {
                let angle = if random.number() < 0.5 { 0.0 } else { random.number() * 2.0 };
                let aside = DVec3::new(-y * angle.cos(), 0.0, y * angle.sin());
                let along = DVec3::Y * z;
                let points = vec![DVec3::ZERO, along, DVec3::X * x, DVec3::X * x + along, aside, aside + along];
                Self { points, faces: vec![vec![0, 2, 3, 1], vec![0, 1, 5, 4]] }
            }
            _ => {
                let base = [DVec3::ZERO, DVec3::X * x, DVec3::new(x, y, 0.0), DVec3::Y * y];
                let tip = DVec3::new(w * 0.5, w * 0.5, z);
                let sides = (0..4).map(|i| vec![i, (i + 1) % 4, 4]);
                Self { points: [&base[..], &[tip]].concat(), faces: sides.chain([vec![3, 2, 1, 0]]).collect() }
            }
        }
    }

    /// Some solids that do not touch one another, turned at random.
    fn scene(random: &mut Random) -> Self {
        let mut all = Self::default();
        // Around the origin, as digits count from there.
        let count = random.whole(1, 3);
        for number in 0..count {
            let one = Self::random(random);
            let turn = DMat3::from_axis_angle(random.direction(), random.number() * TAU);
            let first = all.points.len();
            all.points.extend(
                one.points
                    .iter()
                    .map(|point| turn * *point + DVec3::X * (4.0 * f64::from(number) - 2.0 * f64::from(count - 1))),
            );
            all.faces.extend(one.faces.iter().map(|face| face.iter().map(|corner| corner + first).collect::<Vec<_>>()));
        }
        all
    }

    /// Rounds all coordinates from one point on.
    fn round(&mut self, first: usize, digits: usize) {
        let rounded = |number: f64| format!("{number:.*e}", digits - 1).parse().unwrap();
        for point in &mut self.points[first..] {
            *point = DVec3::from_array(point.to_array().map(rounded));
        }
    }

    /// Puts up to five corners inside a side of a face and, if asked, of the face on its other side.
    fn divide(&mut self, random: &mut Random, digits: usize) {
        let face = random.below(self.faces.len() as u32) as usize;
        let side = random.below(self.faces[face].len() as u32) as usize;
        let [from, to] = [side, side + 1].map(|place| self.faces[face][place % self.faces[face].len()]);
        let mut places: Vec<f64> = (0..random.whole(1, 5)).map(|_| 0.03 + 0.94 * random.number()).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|later, earlier| *later - *earlier < 0.02);
        let first = self.points.len();
        let [start, end] = [from, to].map(|corner| self.points[corner]);
        if start.distance(end) < 0.2 {
            return;
        }
        self.points.extend(places.iter().map(|place| start.lerp(end, *place)));
        self.round(first, digits);
        let new: Vec<usize> = (first..self.points.len()).collect();
        let of_both = random.number() < 0.5;
        for (number, corners) in self.faces.iter_mut().enumerate() {
            let count = corners.len();
            let place = |from: usize, to: usize| {
                (0..count).find(|place| corners[*place] == from && corners[(place + 1) % count] == to)
            };
            if let (true, Some(place)) = (number == face, place(from, to)) {
                corners.splice(place + 1..place + 1, new.iter().copied());
            } else if let (true, Some(place)) = (of_both, place(to, from)) {
                corners.splice(place + 1..place + 1, new.iter().rev().copied());
            }
        }
    }

    /// As a file, each face from any of its corners.
    fn text(&self, random: &mut Random) -> String {
        let mut text: String = self.points.iter().map(|DVec3 { x, y, z }| format!("v {x:?} {y:?} {z:?}\n")).collect();
        for face in &self.faces {
            let mut corners = face.clone();
            corners.rotate_left(random.below(face.len() as u32) as usize);
            text += &format!("f{}\n", corners.iter().map(|corner| format!(" {}", corner + 1)).collect::<String>());
        }
        text
    }

    /// Whether no face is seen so much from its edge that digits decide which side it shows.
    fn is_clear_from(&self, eye: DVec3) -> bool {
        self.faces.iter().all(|face| {
            let [a, b, c] = [0, 1, 2].map(|place| self.points[face[place]]);
            (b - a).cross(c - a).normalize().dot((eye - a).normalize()).abs() > 1e-3
        })
    }
}

/// Compares a scene with the same one with corners inside some sides; `None` if they are the same.
fn failure(seed: u64) -> Option<String> {
    let mut random = Random::seeded(seed);
    let digits = random.whole(6, 17) as usize;
    let mut solid = Solid::scene(&mut random);
    solid.round(0, digits);
    let plain = solid.clone();
    for _ in 0..random.whole(1, 4) {
        solid.divide(&mut random, digits);
    }
    let [before, after] = [&plain, &solid].map(|solid| solid.text(&mut random));
    let camera = loop {
        let eye = random.direction() * 20.0;
        if plain.is_clear_from(eye) {
            let up = Some(random.direction());
            break CameraSettings { eye: Some(eye), target: Some(DVec3::ZERO), up, ..CameraSettings::default() };
        }
    };
    let scene = |text: &str| scene_of(vec![read(text, LoadOptions::default().weld)], camera.clone());
    let difference = difference(&lines(&scene(&before)), &lines(&scene(&after)), false)?;
    Some(format!("seed {seed}, {digits} digits: {difference}\n{camera:?}\n{after}"))
}

fn check(count: u64) {
    let failures: Vec<String> = (1..=count).filter_map(failure).collect();
    println!("{} of {count} scenes differ", failures.len());
    assert!(
        failures.is_empty(),
        "{} of {count} scenes differ: {}",
        failures.len(),
        failures[..failures.len().min(4)].join("\n")
    );
}

#[test]
fn corners_inside_sides_leave_lines_and_classes_as_they_are_briefly() {
    check(scenes_wanted().unwrap_or(240));
}

#[test]
#[ignore = "exhaustive: 2,000 scenes, or as many as TINTA_LINE_SCENES says"]
fn corners_inside_sides_leave_lines_and_classes_of_many_scenes_as_they_are() {
    check(scenes_wanted().unwrap_or(2000));
}

#[test]
fn a_cube_with_middle_corners_in_one_of_both_faces_has_creases_once() {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let mut cube = Solid::extruded(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], 1.0);
    cube.points.iter_mut().for_each(|point| *point = turn * *point);
    let plain = cube.clone();
    for side in 0..4 {
        let [from, to] = [side, (side + 1) % 4];
        cube.points.push((cube.points[from] + cube.points[to]) * 0.5);
        let middle = cube.points.len() - 1;
        let place = cube.faces[side].iter().position(|corner| *corner == to).unwrap();
        cube.faces[side].insert(place, middle);
    }
    let texts = [plain, cube].map(|mut solid| {
        let rounded = |number: f64| format!("{number:.6}").parse().unwrap();
        solid.points.iter_mut().for_each(|point| *point = DVec3::from_array(point.to_array().map(rounded)));
        solid.text(&mut Random::seeded(1))
    });
    let [plain, divided] = texts.map(|text| lines(&drawn(&text)));
    assert_eq!(difference(&plain, &divided, false), None);
    assert_eq!((divided.edges.boundary, divided.edges.non_manifold), (0, 0));
}
