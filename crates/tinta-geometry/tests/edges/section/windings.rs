//! Cuts of closed shells wound either way, against slices that know the solids and not the mesh's winding.

use super::{both, made, regular, square, volume};
use crate::support::shapes::Random;
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use tinta::Mesh;
use tinta::mesh::{Cut, NamedPart, SectionPlane};

/// A closed shell: its corners and triangles, the solid at their backs.
#[derive(Clone)]
struct Shell(Vec<DVec3>, Vec<[u32; 3]>);

impl Shell {
    /// Rings of corners, each joined to the next; closed by flat ends, or into a frame.
    fn of_rings(rings: &[Vec<DVec3>], is_frame: bool) -> Self {
        let count = rings[0].len() as u32;
        let mut positions = rings.concat();
        let mut triangles = Vec::new();
        let quads = if is_frame { rings.len() } else { rings.len() - 1 } as u32;
        for ring in 0..quads {
            let other = (ring + 1) % rings.len() as u32;
            for at in 0..count {
                let next = (at + 1) % count;
                let [a, b, c, d] = [ring * count + at, ring * count + next, other * count + next, other * count + at];
                // The shorter diagonal: those of a frame's ends do not leave them.
                let length = |from: u32, to: u32| positions[from as usize].distance(positions[to as usize]);
                let is_other = length(b, d) < length(a, c) - 1e-9;
                triangles.extend(if is_other { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] });
            }
        }
        if !is_frame {
            // Around a corner in the middle: the ends may be stars.
            let last = rings.len() as u32 - 1;
            for (ring, is_last) in [(0, false), (last, true)] {
                let middle = positions.len() as u32;
                positions.push(rings[ring as usize].iter().sum::<DVec3>() / f64::from(count));
                for at in 0..count {
                    let [a, b] = [ring * count + at, ring * count + (at + 1) % count];
                    triangles.push(if is_last { [middle, a, b] } else { [middle, b, a] });
                }
            }
        }
        Self(positions, triangles)
    }

    fn reversed(mut self) -> Self {
        self.1.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        self
    }

    fn moved(mut self, scale: f64, by: DVec3) -> Self {
        self.0.iter_mut().for_each(|position| *position = *position * scale + by);
        self
    }

    fn mesh(&self) -> Mesh {
        made(self.0.clone(), self.1.as_flattened(), Vec::new())
    }

    /// The area of the slice just behind a plane, by the sum over its sides.
    fn slice(&self, plane: &SectionPlane, tolerance: f64) -> f64 {
        let normal = plane.normal.normalize();
        let height = |at: u32| {
            let height = normal.dot(self.0[at as usize]) - plane.offset / plane.normal.length();
            if height.abs() <= tolerance { 0.0 } else { height }
        };
        let mut sum = DVec3::ZERO;
        for triangle in &self.1 {
            let (mut up, mut down) = (None, None);
            for at in 0..3 {
                let [a, b] = [triangle[at], triangle[(at + 1) % 3]];
                let [first, second] = [a, b].map(height);
                if (first < 0.0) != (second < 0.0) {
                    let point = self.0[a as usize].lerp(self.0[b as usize], first / (first - second));
                    *(if first < 0.0 { &mut up } else { &mut down }) = Some(point);
                }
            }
            if let (Some(up), Some(down)) = (up, down) {
                sum += down.cross(up);
            }
        }
        sum.dot(normal) / 2.0
    }
}

/// A ring over a polygon at a height, which may be sheared.
fn ring(polygon: &[DVec2], height: f64, shear: f64) -> Vec<DVec3> {
    polygon.iter().map(|it| DVec3::new(it.x + shear * height, height, -it.y)).collect()
}

fn star(points: u32, lattice: bool) -> Vec<DVec2> {
    if lattice {
        let corners = [[3, 0], [1, 1], [0, 3], [-1, 1], [-3, 0], [-1, -1], [0, -3], [1, -1]];
        return corners.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y))).to_vec();
    }
    let outer = regular(2 * points, 3.0);
    outer.iter().enumerate().map(|(at, it)| if at.is_multiple_of(2) { *it } else { *it * 0.4 }).collect()
}

/// The shells of a random solid, the hollows' fronts in the hollow; all corners on a lattice for half of them.
fn solid(random: &mut Random) -> Vec<Shell> {
    let lattice = random.below(2) == 0;
    let base = match random.below(3) {
        0 => square(3.0),
        1 => star(3 + random.below(4), lattice),
        _ if lattice => {
            [[3, -1], [3, 2], [0, 3], [-3, 1], [-2, -3]].map(|[x, y]| DVec2::new(x.into(), y.into())).to_vec()
        }
        _ => regular(3 + random.below(9), 3.0),
    };
    let shear = f64::from(random.below(2));
    let prism = |size: f64| {
        let scaled: Vec<DVec2> = base.iter().map(|it| *it * size).collect();
        Shell::of_rings(&[-4.0, 0.0, 4.0].map(|height| ring(&scaled, height * size, shear)), false)
    };
    let bipyramid = || {
        let waist: Vec<DVec2> = base.iter().map(|it| *it * 0.5).collect();
        let rings = [(&waist, -4.0), (&base, 0.0), (&waist, 4.0)];
        Shell::of_rings(&rings.map(|(polygon, height)| ring(polygon, height, shear)), false)
    };
    match random.below(5) {
        0 => vec![prism(1.0)],
        1 => vec![bipyramid()],
        2 => vec![prism(1.0), prism(0.5).reversed()],
        3 => vec![prism(1.0), prism(0.5).reversed(), prism(0.25)],
        // A block with a square hole through it, corners to sides, as a frame of four rings.
        _ => {
            let turned: Vec<DVec2> = square(2.0).iter().map(|it| DVec2::new(it.x - it.y, it.x + it.y) / 4.0).collect();
            let outer = square(2.0);
            let rings = [(&turned, 4.0), (&turned, 0.0), (&outer, 0.0), (&outer, 4.0)];
            vec![Shell::of_rings(&rings.map(|(polygon, height)| ring(polygon, height, 0.0)), true)]
        }
    }
}

/// A plane through the shells: through corners, along an edge or in a face for every third.
fn cutting(random: &mut Random, shells: &[Shell], number: u32) -> SectionPlane {
    let shell = &shells[random.below(shells.len() as u32) as usize];
    let triangle = shell.1[random.below(shell.1.len() as u32) as usize].map(|at| shell.0[at as usize]);
    let any = DVec3::new(random.signed(), random.signed(), random.signed());
    let whole = DVec3::new(random.below(5).into(), random.below(5).into(), random.below(5).into()) - DVec3::splat(2.0);
    let [a, b, c] = triangle;
    let normal = match number % 9 {
        0 if whole != DVec3::ZERO => whole,
        3 => (b - a).cross(any),
        6 => (b - a).cross(c - a),
        _ => any,
    };
    let through = if number.is_multiple_of(3) { a } else { a.lerp(b, 0.5 + 0.4 * random.signed()).lerp(c, 0.3) };
    SectionPlane { normal, offset: normal.dot(through), is_of_file: false }
}

/// The area of a mesh's faces in a plane, and whether an edge of the mesh has an odd number of faces.
fn in_plane(mesh: &Mesh, plane: &SectionPlane, tolerance: f64) -> (f64, bool) {
    let normal = plane.normal.normalize();
    let is_in = |at: u32| {
        (normal.dot(mesh.positions[at as usize]) - plane.offset / plane.normal.length()).abs() <= 10.0 * tolerance
    };
    let mut area = 0.0;
    let mut faces: HashMap<[u32; 2], u32> = HashMap::new();
    for [a, b, c] in mesh.triangles.iter().copied() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *faces.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
        if [a, b, c].into_iter().all(is_in) {
            let [a, b, c] = [a, b, c].map(|at| mesh.positions[at as usize]);
            area += (b - a).cross(c - a).length() / 2.0;
        }
    }
    (area, faces.values().any(|count| count % 2 == 1))
}

#[test]
fn areas_of_cuts_are_those_of_slices_whichever_way_500_solids_are_wound() {
    let mut random = Random::seeded(7);
    let (mut cuts, mut turned, mut wrong) = (0, 0, Vec::new());
    for number in 0..500 {
        let mut shells = solid(&mut random);
        if random.below(3) == 0 {
            // A second solid beside or across the first one, larger than any hollow.
            let by = DVec3::new(random.below(7).into(), random.below(7).into(), random.below(7).into());
            shells.extend(solid(&mut random).into_iter().map(|it| it.moved(1.25, by + DVec3::splat(0.5))));
        }
        let plane = cutting(&mut random, &shells, number);
        let mut mesh: Option<Mesh> = None;
        assert!(volume(&shells[0].mesh()) > 0.0);
        for shell in &shells {
            let is_turned = random.below(2) == 0;
            turned += u32::from(is_turned);
            let shell = if is_turned { shell.clone().reversed() } else { shell.clone() };
            mesh = Some(mesh.map_or_else(|| shell.mesh(), |mesh| both(&mesh, &shell.mesh())));
        }
        let mesh = mesh.unwrap();
        let (low, high) = mesh.bounds();
        let tolerance = (high - low).length() * 1e-11;
        let right: f64 = shells.iter().map(|shell| shell.slice(&plane, tolerance)).sum();
        let (cut, how) = mesh.section(&[plane], Some(0.0)).unwrap();
        if how == Cut::Missed || how == Cut::Gone {
            assert!(how == Cut::Missed || right.abs() < 1e-6, "{number}: {right}");
            continue;
        }
        cuts += 1;
        let (found, is_open) = in_plane(&cut, &plane, tolerance);
        let is_right = (found - right).abs() < 1e-7 * right.max(1.0) && how == Cut::Closed && !is_open;
        let sizes: Vec<usize> = shells.iter().map(|shell| shell.1.len()).collect();
        let told =
            || format!("{number}: shells of {sizes:?}, {plane:?}: {found} for {right}, {how:?}, open: {is_open}");
        wrong.extend((!is_right).then(told));
    }
    assert!(wrong.is_empty(), "{} of {cuts}: {wrong:#?}", wrong.len());
    assert!(cuts > 450 && turned > 300, "{cuts} {turned}");
}

/// A box between two corners.
fn block(low: f64, high: f64) -> Shell {
    let ends = [low, high].map(|height| ring(&square(1.0), height, 0.0));
    Shell::of_rings(
        &ends.map(|end| end.into_iter().map(|it| DVec3::new(it.x * high, it.y, it.z * high)).collect()),
        false,
    )
}

#[test]
fn a_box_and_a_hollow_one_are_closed_alike_inwards_and_outwards() {
    let plane = SectionPlane { normal: DVec3::X, offset: 0.0, is_of_file: false };
    let (outer, inner) = (block(-2.0, 2.0), block(-1.0, 1.0));
    let cases: [(&str, Vec<Shell>, f64); 7] = [
        ("out", vec![outer.clone()], 16.0),
        ("in", vec![outer.clone().reversed()], 16.0),
        ("hollow", vec![outer.clone(), inner.clone().reversed()], 12.0),
        ("hollow, inwards", vec![outer.clone().reversed(), inner.clone()], 12.0),
        ("hollow, all outwards", vec![outer.clone(), inner.clone()], 12.0),
        ("hollow, all inwards", vec![outer.clone().reversed(), inner.clone().reversed()], 12.0),
        ("one beside the other", vec![outer.moved(1.0, DVec3::Z * 8.0), inner.reversed()], 20.0),
    ];
    for (what, shells, right) in cases {
        let mesh = shells.iter().map(Shell::mesh).reduce(|all, next| both(&all, &next)).unwrap();
        let (mut cut, how) = mesh.section(&[plane], Some(0.0)).unwrap();
        assert_eq!((in_plane(&cut, &plane, 1e-10), how), ((right, false), Cut::Closed), "{what}");
        // A cap is wound as its shell is: a shell of one winding stays one.
        if shells.len() == 1 {
            super::assert_closed(&cut, what);
        }
        // An insert of another part, wound as what holds it, is another solid.
        if what == "hollow, all outwards" {
            cut = shells.iter().map(Shell::mesh).reduce(|all, next| both(&all, &next)).unwrap();
            cut.parts = ["block", "insert"].map(|name| NamedPart { name: name.to_owned(), within: u32::MAX }).to_vec();
            cut.triangle_parts = [vec![0; shells[0].1.len()], vec![1; shells[1].1.len()]].concat();
            let (cut, _) = cut.section(&[plane], Some(0.0)).unwrap();
            assert_eq!(in_plane(&cut, &plane, 1e-10), (20.0, false), "two parts");
        }
    }
}

#[test]
fn boxes_that_touch_in_an_edge_or_a_face_are_closed_each() {
    let plane = SectionPlane { normal: DVec3::Y, offset: 0.5, is_of_file: false };
    let cube = block(-1.0, 1.0);
    for (by, turns) in [(DVec3::new(2.0, 0.0, 2.0), [false, true]), (DVec3::new(2.0, 0.0, 0.0), [false, false])] {
        for is_turned in [false, true] {
            let shells = [cube.clone(), cube.clone().moved(1.0, by)];
            let wound = shells
                .into_iter()
                .zip(turns)
                .map(|(shell, turned)| if turned != is_turned { shell.reversed() } else { shell });
            let mesh = wound.map(|shell| shell.mesh()).reduce(|all, next| both(&all, &next)).unwrap();
            let (cut, how) = mesh.section(&[plane], Some(0.0)).unwrap();
            assert_eq!((in_plane(&cut, &plane, 1e-10), how), ((8.0, false), Cut::Closed), "{by} {is_turned}");
        }
    }
}

#[test]
fn a_cut_through_the_corner_of_a_hole_and_one_of_an_open_box_wound_inwards_close() {
    let frame = |half: f64, turn: f64, height: f64| {
        let corners = regular(4, half).into_iter().map(|it| DVec2::from_angle(turn).rotate(it)).collect::<Vec<_>>();
        ring(&corners, height, 0.0)
    };
    let eighth = std::f64::consts::FRAC_PI_4;
    let rings =
        [frame(1.0, 0.0, 0.0), frame(8f64.sqrt(), eighth, 0.0), frame(8f64.sqrt(), eighth, 4.0), frame(1.0, 0.0, 4.0)];
    let shell = Shell::of_rings(&rings, true);
    for offset in [0.999, 1.0, 1.001] {
        let plane = SectionPlane { normal: DVec3::new(1.0, 1.0, 0.0), offset, is_of_file: false };
        for mesh in [shell.mesh(), shell.clone().reversed().mesh()] {
            let (cut, how) = mesh.section(&[plane], Some(0.0)).unwrap();
            let (area, is_open) = in_plane(&cut, &plane, 1e-10);
            assert_eq!((how, is_open), (Cut::Closed, false), "{offset}");
            super::assert_near(area, shell.slice(&plane, 1e-10).abs(), "area");
        }
    }
    let mut open = block(-1.0, 1.0).reversed();
    open.1.retain(|triangle| !triangle.iter().all(|corner| open.0[*corner as usize].y < 0.0));
    let (cut, how) =
        open.mesh().section(&[SectionPlane { normal: DVec3::Y, offset: 0.5, is_of_file: false }], Some(0.0)).unwrap();
    assert_eq!((super::cap_area(&cut), how), (4.0, Cut::Closed), "open elsewhere");
}
